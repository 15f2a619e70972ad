//! `hessian` against dual numbers through `linearize` of the same scene, in the kinds of scene that differ in how they
//! come to their accelerations: equal up to the bounds that both carry on their own rounding.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{Parts, speeds};
use crate::common::dual::Dual;
use crate::common::groups::{Random, random_configuration};
use gauss_runtime::hessian::Hessian;
use gauss_runtime::linearize::LinearModel;
use gauss_runtime::prelude::*;

fn constants(values: &[Bounded]) -> Vec<Dual<Bounded>> {
    values.iter().map(|&value| Dual::new(value, Bounded::zero())).collect()
}

fn along(values: &[Bounded], k: usize) -> Vec<Dual<Bounded>> {
    let mut duals = constants(values);
    duals[k].rate = Bounded::one();
    duals
}

/// The kernel in both kinds of numbers.
macro_rules! kernels {
    ($name:ident) => {
        (&$name::<Bounded>::sample().kernel().unwrap(), &$name::<Dual<Bounded>>::sample().kernel().unwrap())
    };
}

/// Second derivatives of a weighted sum of the rates beside dual numbers through `linearize`, at random states: of
/// components of one rotation the mean of both orders.
fn check<C, B, D, const S: usize, const U: usize>(origin: &C, (bounded, dual): (&B, &D))
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: HessianSystem<
            Scalar = Bounded,
            Configuration: Parts<Bounded>,
            Linearization: LinearModel<Bounded, Vector: VectorSpace<Bounded>>,
            Hessian = Hessian<Bounded, S, U>,
        >,
    D: LinearizedSystem<Scalar = Dual<Bounded>, Configuration: Parts<Dual<Bounded>>>,
    D::Input: VectorSpace<Dual<Bounded>>,
{
    let mut random = Random(13);
    let (positions, mut told) = (S - B::DOF, 0);
    for _ in 0..4 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw =
            |count: usize| -> Vec<Bounded> { (0..count).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, input, weights, t) = (draw(B::DOF), draw(U), draw(S), draw(1)[0]);
        let found = bounded.hessian(t, &q, &speeds(&z), &speeds(&input), &speeds(&weights));
        let parts = q.parts();
        // Along one direction of the first derivatives along all.
        let row = |i: usize| -> Vec<Bounded> {
            let moving = |values: &[Bounded], first: usize| match i.checked_sub(first) {
                Some(k) if k < values.len() => along(values, k),
                _ => constants(values),
            };
            let moved: Vec<Dual<Bounded>> = if i < positions {
                let mut axis = <B::Configuration as Configuration>::Tangent::zero();
                axis.set_component(i, Bounded::one());
                parts.iter().zip(q.rates(&axis)).map(|(&x, rate)| Dual::new(x, rate)).collect()
            } else {
                constants(&parts)
            };
            let (z, input) = (moving(&z, positions), moving(&input, S));
            let t = Dual::new(t, Bounded::zero());
            let linear = dual.linearize(t, &D::Configuration::assemble(&moved), &speeds(&z), &speeds(&input));
            let slope = |row: usize, j: usize| match j.checked_sub(S) {
                None => linear.by_state(row, j).rate,
                Some(k) => linear.by_input(row, k).rate,
            };
            let sum = |j: usize| (0..S).fold(Bounded::zero(), |sum, row| sum + weights[row] * slope(row, j));
            (0..S + U).map(sum).collect()
        };
        let rows: Vec<Vec<Bounded>> = (0..S + U).map(row).collect();
        for i in 0..S + U {
            let half = Bounded::from_f64(0.5);
            let expected: Vec<Bounded> = (0..S + U).map(|j| half * (rows[i][j] + rows[j][i])).collect();
            let entry = |j: usize| match (i.checked_sub(S), j.checked_sub(S)) {
                (None, None) => found.by_state[(i, j)],
                (Some(u), None) => found.by_input_and_state[(u, j)],
                (None, Some(u)) => found.by_input_and_state[(u, i)],
                (Some(u), Some(v)) => found.by_input[(u, v)],
            };
            let row: Vec<Bounded> = (0..S + U).map(entry).collect();
            equal(&format!("row {i}"), &row, &expected).unwrap();
            let size = row.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            told += usize::from(row.iter().all(|x| x.bound <= 1e-9 * size));
        }
    }
    assert!(10 * told >= 9 * 4 * (S + U), "only {told} of {} rows are known to 1e-9", 4 * (S + U));
}

fn rigid<T: Real>(mass: f64, x: f64) -> RigidBody<T> {
    let n = T::from_f64;
    let inertia = [[1.3, 0.1, -0.2], [0.1, 1.7, 0.05], [-0.2, 0.05, 2.1]];
    RigidBody {
        mass: n(mass),
        center_of_mass: SVector::from([n(x), n(0.1), n(-0.05)]),
        inertia: SMatrix::from(inertia.map(|column| column.map(n))),
    }
}

/// A hull with a rotor that slides: increments of two rotations, which do not commute, and an input that enters
/// nonlinearly.
#[derive(GaussDynamics)]
#[gauss(
    linearize(hessian),
    coordinates(s, base: Pose, wheel: Rotation),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    input(push),
    drive(s = push * push * cos(s) - 3 * rate(s)),
)]
struct Gyrostat<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    rotor: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Gyrostat<T> {
    fn sample() -> Self {
        Self { hull: rigid(2.0, 0.1), rotor: rigid(0.7, -0.2), g: T::from_f64(9.81) }
    }
}

#[test]
fn increments_that_do_not_commute() {
    let origin = (Isometry3::<f64>::identity(), (UnitQuaternion::<f64>::identity(), SVector::from([0.4])));
    check(&origin, kernels!(Gyrostat));
}

/// A rod on a cart, held at its end to a line: multipliers.
#[derive(GaussDynamics)]
#[gauss(
    linearize(hessian),
    coordinates(x, y, a),
    particle(mass = 2, position = [x, 0, y]),
    body(rod, position = [x, 0, y], rotation = rotation_y(a)),
    constraint(position = y + l * sin(a) - 0.3 * x),
    input(push),
    drive(x = push),
)]
struct Held<T> {
    #[gauss(body)]
    rod: RigidBody<T>,
    l: T,
}

impl<T: Real> Held<T> {
    fn sample() -> Self {
        Self { rod: rigid(1.0, 0.3), l: T::from_f64(0.8) }
    }
}

#[test]
fn multipliers() {
    check(&SVector::<f64, 3>::zeros(), kernels!(Held));
}

/// Every function that expressions have, on a cart.
#[derive(GaussDynamics)]
#[gauss(
    linearize(hessian),
    coordinates(x, a),
    particle(mass = 2, position = [x, 0, 0]),
    particle(mass = 1, position = [x + l * sin(a), 0, l * cos(a)]),
    input(push),
    drive(x = push * smooth_step(x, -1, 1) - clamp(3 * dx, -1, 1) + signum(x), a = max(a, 0.2) * abs(da) - min(x, t)),
    drive(a = atan2(a, 2 + x * x) + sqrt(1 + da * da) + ln(3 + sin(a)) + hypot(a, 1) + tan(0.3 * a) + tanh(x)),
    drive(x = powf(2 + sin(a), 1.5) + exp(-x * x)),
    define(dx = rate(x), da = rate(a)),
)]
struct Cart<T> {
    #[gauss(gravity)]
    g: T,
    l: T,
}

impl<T: Real> Cart<T> {
    fn sample() -> Self {
        Self { g: T::from_f64(9.81), l: T::from_f64(0.8) }
    }
}

#[test]
fn every_function() {
    check(&SVector::<f64, 2>::zeros(), kernels!(Cart));
}
