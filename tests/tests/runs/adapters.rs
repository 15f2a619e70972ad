//! Kernels in the integrators of other crates against our own runs: a free body in space and in fluid, a pendulum, in
//! both forms; with the feature `adapters`.

use gauss_adapters::FlatSystem;
use gauss_runtime::integrate::{NoInput, Problem, SystemProblem};
use gauss_runtime::prelude::*;

/// A body that turns freely about its centre of mass.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct FreeTop {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

/// A body in fluid.
#[derive(GaussDynamics)]
#[gauss(motion = free)]
struct Kirchhoff {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Matrix6<f64>,
}

/// A pendulum whose angle is the coordinate, pushed by a torque.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    body(bob, rotation = rotation_x(angle)),
    input(push),
    drive(push, angle = push),
)]
struct Pendulum {
    #[gauss(body)]
    bob: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn free_top() -> FreeTopKernel {
    FreeTop { mass: 1.0, inertia: Vector3::new(0.5, 0.85, 1.0) }.kernel().expect("a top")
}

fn ellipsoid() -> KirchhoffKernel {
    let added = Matrix6::from_diagonal(&Vector6::new(0.3, 0.9, 1.4, 0.02, 0.1, 0.06));
    Kirchhoff { mass: 1.0, inertia: Vector3::new(0.1, 0.2, 0.25), added }.kernel().expect("a body in fluid")
}

fn pendulum() -> PendulumKernel {
    let bob = RigidBody {
        mass: 2.0,
        center_of_mass: Vector3::new(0.0, 0.0, -0.5),
        inertia: Matrix3::from_diagonal(&Vector3::new(0.6, 0.6, 0.1)),
    };
    Pendulum { bob, g: 9.81 }.kernel().expect("a pendulum")
}

/// What another crate reached, given the system and the start.
trait Foreign {
    fn run<S, P, const N: usize>(&self, system: &FlatSystem<P>, start: [f64; N], end: f64) -> Vec<f64>
    where
        S: GaussSystem<Scalar = f64>,
        P: Problem<System = S> + Copy;
}

struct DifferentialEquations;

impl Foreign for DifferentialEquations {
    fn run<S, P, const N: usize>(&self, system: &FlatSystem<P>, start: [f64; N], end: f64) -> Vec<f64>
    where
        S: GaussSystem<Scalar = f64>,
        P: Problem<System = S> + Copy,
    {
        use differential_equations::prelude::{ExplicitRungeKutta, IVP};
        let method = ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(TOLERANCE);
        let solution = IVP::ode(system, 0.0, end, start).method(method).solve().expect("runs");
        solution.last().expect("not empty").1.to_vec()
    }
}

struct OdeSolvers;

impl Foreign for OdeSolvers {
    fn run<S, P, const N: usize>(&self, system: &FlatSystem<P>, start: [f64; N], end: f64) -> Vec<f64>
    where
        S: GaussSystem<Scalar = f64>,
        P: Problem<System = S> + Copy,
    {
        let start = ode_solvers::SVector::<f64, N>::from(start);
        let mut run = ode_solvers::Dop853::new(*system, 0.0, end, end, start, TOLERANCE, TOLERANCE);
        run.set_output(ode_solvers::OutputType::Sparse);
        run.integrate().expect("runs");
        let dynamic = ode_solvers::DVector::from_column_slice(start.as_slice());
        let mut again = ode_solvers::Dop853::new(*system, 0.0, end, end, dynamic, TOLERANCE, TOLERANCE);
        again.set_output(ode_solvers::OutputType::Sparse);
        again.integrate().expect("runs");
        let (x, y) = (run.y_out().last().expect("some"), again.y_out().last().expect("some"));
        assert_eq!(x.as_slice(), y.as_slice());
        x.as_slice().to_vec()
    }
}

struct Diffsol {
    implicit: bool,
}

impl Foreign for Diffsol {
    fn run<S, P, const N: usize>(&self, system: &FlatSystem<P>, start: [f64; N], end: f64) -> Vec<f64>
    where
        S: GaussSystem<Scalar = f64>,
        P: Problem<System = S> + Copy,
    {
        use diffsol::{NalgebraLU, NalgebraMat, OdeSolverMethod, VectorCommon};
        let first = system.sample(0.0, &start);
        let builder = system.diffsol::<NalgebraMat<f64>>(0.0, &first.q, &first.z);
        let problem = builder.rtol(TOLERANCE).atol([TOLERANCE]).build().expect("a problem");
        if self.implicit {
            let mut run = problem.bdf::<NalgebraLU<f64>>().expect("a solver");
            run.solve(end).expect("runs");
            run.state().y.inner().as_slice().to_vec()
        } else {
            let mut run = problem.tsit45().expect("a solver");
            run.solve(end).expect("runs");
            run.state().y.inner().as_slice().to_vec()
        }
    }
}

/// Of a step, in every run.
const TOLERANCE: f64 = 1e-10;

/// How far apart two states are: entries of the increment between configurations, and speeds.
fn distance<S: GaussSystem<Scalar = f64>>(a: &(S::Configuration, S::Speeds), b: &(S::Configuration, S::Speeds)) -> f64 {
    a.0.difference(&b.0).max_norm().max(a.1.add_scaled(-1.0, &b.1).max_norm())
}

/// Errors of a step add up over a few hundred steps of an explicit method, and these motions double them a few times:
/// 1e-7. Low orders take thousands of steps.
fn same_end<X: Foreign>(foreign: &X, push: Push, bound: f64) {
    let (top, spin) = (free_top(), Vector3::new(0.01, 2.0, 0.3));
    let start = (UnitQuaternion::from_euler_angles(0.3, 0.2, -1.0), spin);
    let ours =
        Simulation::new(&top).adaptive(TOLERANCE, TOLERANCE).run_to_end(start.0, start.1, 0.0..5.0).expect("ours");
    let by_velocity = FlatSystem::new(&top);
    let by_momentum = by_velocity.momentum_form();
    let x: [f64; 7] = by_velocity.vector(0.0, &start.0, &start.1);
    let y: [f64; 7] = by_momentum.vector(0.0, &start.0, &start.1);
    let found = [
        by_velocity.sample(5.0, &foreign.run(&by_velocity, x, 5.0)),
        by_momentum.sample(5.0, &foreign.run(&by_momentum, y, 5.0)),
    ];
    for end in found {
        let off = distance::<FreeTopKernel>(&(end.q, end.z), &(ours.q, ours.z));
        assert!(off < bound, "top: {off:e}");
        assert!((end.q.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
    }

    let body = ellipsoid();
    let start = (Isometry3::translation(1.0, -2.0, 0.5), Vector6::new(1.0, 0.2, 0.0, 0.3, 0.1, -0.4));
    let ours =
        Simulation::new(&body).adaptive(TOLERANCE, TOLERANCE).run_to_end(start.0, start.1, 0.0..5.0).expect("ours");
    let system = FlatSystem::new(&body).momentum_form();
    let x: [f64; 13] = system.vector(0.0, &start.0, &start.1);
    let end = system.sample(5.0, &foreign.run(&system, x, 5.0));
    let off = distance::<KirchhoffKernel>(&(end.q, end.z), &(ours.q, ours.z));
    assert!(off < bound, "body in fluid: {off:e}");

    let (kernel, start) = (pendulum(), (SVector::from([2.5]), SVector::from([0.0])));
    let ours = Simulation::new(&kernel)
        .input_from(push)
        .adaptive(TOLERANCE, TOLERANCE)
        .run_to_end(start.0, start.1, 0.0..5.0)
        .expect("ours");
    let system = FlatSystem::new(&kernel).input_from(push);
    let x: [f64; 2] = system.vector(0.0, &start.0, &start.1);
    let end = system.sample(5.0, &foreign.run(&system, x, 5.0));
    let off = distance::<PendulumKernel>(&(end.q, end.z), &(ours.q, ours.z));
    assert!(off < bound, "pendulum: {off:e}");
}

/// A torque that depends on the state, and on time where that is told.
#[derive(Clone, Copy)]
struct Push {
    amplitude: f64,
}

impl InputSource<PendulumKernel> for Push {
    fn input(&self, t: f64, _: &SVector<f64, 1>, z: &SVector<f64, 1>) -> SVector<f64, 1> {
        SVector::from([self.amplitude * (2.0 * t).sin() - 0.1 * z[0]])
    }
}

const SWAYING: Push = Push { amplitude: 0.3 };

#[test]
fn differential_equations() {
    same_end(&DifferentialEquations, SWAYING, 1e-7);
}

/// The twelfth stage of its method of order 8 has the time of the first in version 0.6.2, which the order suffers from
/// where equations depend on time: so here they do not.
#[test]
fn ode_solvers_of_fixed_and_dynamic_size() {
    same_end(&OdeSolvers, Push { amplitude: 0.0 }, 1e-7);
}

#[test]
fn diffsol_explicit_and_implicit() {
    same_end(&Diffsol { implicit: false }, SWAYING, 1e-7);
    same_end(&Diffsol { implicit: true }, SWAYING, 1e-6);
}

/// The matrix that its implicit methods ask for, against differences of `f` in each component.
#[test]
fn differential_equations_get_the_jacobian() {
    use differential_equations::ode::ODE;
    let kernel = free_top();
    let system = FlatSystem::new(&kernel);
    let x: [f64; 7] =
        system.vector(0.0, &UnitQuaternion::from_euler_angles(0.3, 0.2, -1.0), &Vector3::new(0.5, 2.0, 0.3));
    let mut matrix = differential_equations::linalg::Matrix::zeros(7, 7);
    ODE::<f64, [f64; 7]>::jacobian(&system, 0.0, &x, &mut matrix);
    // Euler's equations: ∂ω̇₁/∂ω₂ = (I₂ − I₃)/I₁ ω₃.
    assert!((matrix[(4, 5)] - (0.85 - 1.0) / 0.5 * 0.3).abs() < 1e-9);
    let exact = system.jacobian(|_, _: &[f64], v: &[f64], product: &mut [f64]| {
        product.fill(0.0);
        product[0] = v[6];
    });
    ODE::<f64, [f64; 7]>::jacobian(&exact, 0.0, &x, &mut matrix);
    assert_eq!((matrix[(0, 6)], matrix[(4, 5)]), (1.0, 0.0));
}

/// Without inputs the source is [`NoInput`], also for functions over all systems.
#[test]
fn defaults_are_the_velocity_form_without_inputs() {
    fn dimension<S>(_: FlatSystem<SystemProblem<'_, S, VelocityForm, NoInput>>) -> usize
    where
        S: GaussSystem<Input = ()>,
    {
        FlatSystem::<SystemProblem<'_, S, VelocityForm, NoInput>>::DIM
    }
    assert_eq!((dimension(FlatSystem::new(&free_top())), dimension(FlatSystem::new(&ellipsoid()))), (7, 13));
}
