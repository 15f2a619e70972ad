//! What is to be moved, step by step: a pole on a cart, and an arm from its file.

use gauss_examples::ddp::{Expansion, Matrix, Plant, Vector};
use gauss_runtime::hessian::Hessian;
use gauss_runtime::integrate::{Feedback, OneStep, Problem, State, SystemProblem};
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::*;

/// A cart on a rail, and a pole on its hinge; the angle is from upright.
#[derive(GaussDynamics)]
#[gauss(
    linearize(hessian),
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    particle(mass = bob, position = [x + length * sin(theta), 0, length * cos(theta)]),
    input(push),
    drive(x = push)
)]
pub struct CartPole {
    /// kg
    pub cart: f64,
    /// kg
    pub bob: f64,
    /// m
    pub length: f64,
    /// m/s²
    #[gauss(gravity)]
    pub g: f64,
}

/// An arm of seven joints with two fingers, an effort in each.
#[derive(GaussDynamics)]
#[gauss(urdf = "../tests/robots/panda.urdf", gravity = 9.81, linearize(hessian))]
pub struct Arm;

/// A kernel of N scalar coordinates.
pub trait Scalar<const N: usize, const D: usize, const U: usize>:
    HessianSystem<
        Scalar = f64,
        Configuration = Vector<N>,
        Speeds = Vector<N>,
        Input = Vector<U>,
        Linearization = Linearization<f64, D, U>,
        Hessian = Hessian<f64, D, U>,
    >
{
}

impl<K, const N: usize, const D: usize, const U: usize> Scalar<N, D, U> for K where
    K: HessianSystem<
            Scalar = f64,
            Configuration = Vector<N>,
            Speeds = Vector<N>,
            Input = Vector<U>,
            Linearization = Linearization<f64, D, U>,
            Hessian = Hessian<f64, D, U>,
        >
{
}

/// q and z.
pub fn parts<const N: usize, const D: usize>(x: &Vector<D>) -> (Vector<N>, Vector<N>) {
    (x.fixed_rows::<N>(0).into_owned(), x.fixed_rows::<N>(N).into_owned())
}

pub fn joined<const N: usize, const D: usize>(q: &Vector<N>, z: &Vector<N>) -> Vector<D> {
    Vector::from_fn(|i, _| if i < N { q[i] } else { z[i - N] })
}

/// Steps of h seconds of a kernel of N coordinates, D = 2 N, with its exact derivatives.
pub struct Exact<'k, K, const N: usize> {
    pub kernel: &'k K,
    pub h: f64,
}

impl<K: Scalar<N, D, U>, const N: usize, const D: usize, const U: usize> Plant<D, U> for Exact<'_, K, N> {
    type Stages = ();

    fn step(&self, x: &Vector<D>, u: &Vector<U>) -> Vector<D> {
        let Exact { kernel, h } = *self;
        let (q, y) = parts::<N, D>(x);
        let held = |_: f64, _: &Vector<N>, _: &Vector<N>| *u;
        let problem = SystemProblem { system: kernel, form: VelocityForm, input: Feedback(held) };
        let start = State { t: 0.0, q, y };
        let rates = problem.rates(&start);
        match CommutatorFree4.step(&problem, &start, &rates, h) {
            Ok(step) => joined(&step.state.q, &step.state.y),
            Err(_) => Vector::repeat(f64::NAN),
        }
    }

    fn expansion(&self, x: &Vector<D>, u: &Vector<U>) -> Expansion<(), D, U> {
        let (q, z) = parts::<N, D>(x);
        let (by_state, by_input) = match CommutatorFree4.step_linearized(self.kernel, 0.0, &q, &z, u, self.h) {
            Ok(step) => (step.by_state, step.by_input),
            Err(_) => (Matrix::repeat(f64::NAN), Matrix::repeat(f64::NAN)),
        };
        Expansion { by_state, by_input, stages: () }
    }
}

/// The same steps with derivatives by central differences: 2 (D + U) steps each.
pub struct Differences<P>(pub P);

/// The third root of ε: what is left out and what is rounded are then alike.
const APART: f64 = 6e-6;

fn apart<const N: usize>(k: usize) -> Vector<N> {
    Vector::from_fn(|i, _| if i == k { APART } else { 0.0 })
}

impl<P: Plant<D, U>, const D: usize, const U: usize> Plant<D, U> for Differences<P> {
    type Stages = ();

    fn step(&self, x: &Vector<D>, u: &Vector<U>) -> Vector<D> {
        self.0.step(x, u)
    }

    fn expansion(&self, x: &Vector<D>, u: &Vector<U>) -> Expansion<(), D, U> {
        let column = |dx: Vector<D>, du: Vector<U>| {
            let [there, back] = [1.0, -1.0].map(|way| self.0.step(&(x + dx * way), &(u + du * way)));
            (there - back) / (2.0 * APART)
        };
        let (mut a, mut b) = (Matrix::<D, D>::zeros(), Matrix::<D, U>::zeros());
        for k in 0..D {
            a.set_column(k, &column(apart(k), Vector::zeros()));
        }
        for k in 0..U {
            b.set_column(k, &column(Vector::zeros(), apart(k)));
        }
        Expansion { by_state: a, by_input: b, stages: () }
    }
}
