//! A kernel in the integrators of other crates:
//! `cargo run --release -p gauss-comparisons --example other_integrators`.
//!
//! A heavy top for two seconds by `ode_solvers` and `differential-equations` beside our own run, and a door with a
//! strong damper, which is stiff, by the implicit methods of `diffsol`. The tolerance of a step is the same everywhere.

use std::cell::Cell;
use std::time::Instant;

use gauss_adapters::FlatSystem;
use gauss_runtime::prelude::*;

/// A heavy top about its fixed point.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// A door that a spring shuts against a damper.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    body(leaf, rotation = rotation_z(angle)),
    spring(closer, along = angle, stiffness = spring, damping = damper),
)]
struct Door {
    #[gauss(body)]
    leaf: RigidBody<f64>,
    spring: f64,
    damper: f64,
}

const TOLERANCE: f64 = 1e-10;

/// A run: what it reached, the evaluations of the equations, its time in µs.
type Run<S> = (Sample<S>, u64, f64);

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// The result of a run, the evaluations that `count` was told of, and the shortest time of twenty, in µs.
fn measured<T>(count: &Cell<u64>, run: impl Fn() -> Outcome<T>) -> Outcome<(T, u64, f64)> {
    let mut shortest = f64::INFINITY;
    for _ in 0..19 {
        let clock = Instant::now();
        run()?;
        shortest = shortest.min(clock.elapsed().as_secs_f64() * 1e6);
    }
    count.set(0);
    let result = run()?;
    Ok((result, count.get(), shortest))
}

fn print<S>(name: &str, (end, evaluations, time): &Run<S>, exact: &Sample<S>)
where
    S: GaussSystem<Scalar = f64>,
{
    let error = exact.q.difference(&end.q).max_norm().max(end.z.add_scaled(-1.0, &exact.z).max_norm());
    println!("{name:<46}{error:>10.1e}{evaluations:>13}{time:>10.0}");
}

fn heading(scene: &str) {
    println!("\n{scene}\n{:<46}{:>10}{:>13}{:>10}", "", "error", "evaluations", "µs");
}

fn top() -> Outcome<()> {
    let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
    let kernel = top.kernel()?;
    let (tilted, spinning, end) = (UnitQuaternion::from_euler_angles(0.5, 0.0, 0.0), Vector3::new(0.1, 0.0, 20.0), 2.0);
    let exact = Simulation::new(&kernel).adaptive(1e-14, 1e-14).run_to_end(tilted, spinning, 0.0..end)?;
    heading("A heavy top for two seconds");

    let count = Cell::new(0);
    let counted = |_: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| count.set(count.get() + 1);
    let ours = Simulation::new(&kernel).input(counted);
    let method = Adaptive::with(&Tableau::DORMAND_PRINCE_8, TOLERANCE, TOLERANCE);
    let run = measured(&count, || Ok(ours.control(method).run_to_end(tilted, spinning, 0.0..end)?.sample))?;
    print("gauss-runtime, Dormand–Prince 8 on the group", &run, &exact);

    let system = FlatSystem::new(&kernel).input(counted);
    let start: [f64; 7] = system.vector(0.0, &tilted, &spinning);
    let run = measured(&count, || {
        use ode_solvers::{Dop853, OutputType, SVector};
        let start = SVector::<f64, 7>::from(start);
        let mut run = Dop853::new(system, 0.0, end, end, start, TOLERANCE, TOLERANCE);
        run.set_output(OutputType::Sparse);
        run.integrate()?;
        Ok(system.sample(end, run.y_out().last().ok_or("no output")?.as_slice()))
    })?;
    print("ode_solvers, DOP853", &run, &exact);

    let run = measured(&count, || {
        use differential_equations::prelude::{ExplicitRungeKutta, IVP};
        let method = ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(TOLERANCE);
        let solution = IVP::ode(&system, 0.0, end, start).method(method).solve().map_err(|e| format!("{e:?}"))?;
        let (t, x) = solution.last().map_err(|e| format!("{e:?}"))?;
        Ok(system.sample(*t, x))
    })?;
    print("differential-equations, DOP853", &run, &exact);
    Ok(())
}

fn door() -> Outcome<()> {
    let leaf = RigidBody {
        mass: 20.0,
        center_of_mass: Vector3::new(0.4, 0.0, 0.0),
        inertia: Matrix3::from_diagonal(&Vector3::new(1.6, 6.0, 7.0)),
    };
    let door = Door { leaf, spring: 50.0, damper: 5e4 };
    let kernel = door.kernel()?;
    let (open, at_rest, end) = (SVector::from([1.2]), SVector::from([0.0]), 200.0);
    // Linear: exact by the two rates of 6 θ̈ + c θ̇ + k θ = 0, which are four orders of ten apart and more.
    let half = 0.5 * door.damper / 6.0;
    let fast = half + (half * half - door.spring / 6.0).sqrt();
    let slow = door.spring / 6.0 / fast;
    let angle = 1.2 * (fast * (-slow * end).exp() - slow * (-fast * end).exp()) / (fast - slow);
    let exact =
        Sample { t: end, q: SVector::from([angle]), z: SVector::from([-slow * angle]), p: SVector::from([0.0]) };
    heading("A door that creeps shut for 200 seconds, rates 1e-3 and 8e3 per second");

    let count = Cell::new(0);
    let counted = |_: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| count.set(count.get() + 1);
    let ours = Simulation::new(&kernel).input(counted).adaptive(TOLERANCE, TOLERANCE);
    let (_, evaluations, time) = measured(&count, || Ok(ours.run_to_end(open, at_rest, 0.0..1.0)?))?;
    println!("{:<46}{:>10}{evaluations:>13}{time:>10.0}", "gauss-runtime, explicit, the first second only", "");

    use diffsol::{NalgebraLU, NalgebraMat, OdeSolverMethod, VectorCommon};
    let system = FlatSystem::new(&kernel).input(counted);
    let problem = system.diffsol::<NalgebraMat<f64>>(0.0, &open, &at_rest).rtol(TOLERANCE).atol([TOLERANCE]).build()?;
    let run = measured(&count, || {
        let mut run = problem.bdf::<NalgebraLU<f64>>()?;
        run.solve(end)?;
        Ok(system.sample(end, run.state().y.inner().as_slice()))
    })?;
    print("diffsol, backward differentiation", &run, &exact);
    let run = measured(&count, || {
        let mut run = problem.esdirk34::<NalgebraLU<f64>>()?;
        run.solve(end)?;
        Ok(system.sample(end, run.state().y.inner().as_slice()))
    })?;
    print("diffsol, ESDIRK 4(3)", &run, &exact);
    Ok(())
}

fn main() -> Outcome<()> {
    println!("Tolerance {TOLERANCE:e} in every run; errors against a run at 1e-14 and the exact solution.");
    top()?;
    door()
}
