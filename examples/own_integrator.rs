//! A method of your own in twenty lines: `cargo run --release --example own_integrator`.
//!
//! Heun's method on the group, of order 2: an Euler step to look ahead, then a step with the mean of both rates. It
//! knows nothing of bodies, charts or forces: any kernel runs with it, in velocity and in momentum form.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::{
    Fixed, IntegrationErrorKind, OneStep, Problem, Properties, Rates, RunPart, State, Step,
};
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

/// Heun's method.
struct Heun;

impl<S: GaussSystem> OneStep<S> for Heun {
    fn properties(&self) -> Properties {
        Properties::of_order(2)
    }

    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        let moved = |rates: &Rates<S>| State {
            t: state.t + h,
            q: state.q.advance(&rates.configuration.scale(h)),
            y: state.y.add_scaled(h, &rates.variables),
        };
        let ahead = problem.rates(&moved(rates));
        // To this order dexp⁻¹ is the identity in the mean: its first correction is odd in h.
        let half = S::Scalar::from_f64(0.5);
        let mean = Rates {
            configuration: rates.configuration.add_scaled(S::Scalar::from_f64(1.0), &ahead.configuration).scale(half),
            variables: rates.variables.add_scaled(S::Scalar::from_f64(1.0), &ahead.variables).scale(half),
        };
        let end = moved(&mean);
        if !(Configuration::is_finite(&end.q) && VectorSpace::is_finite(&end.y)) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        let unknown = Rates { configuration: VectorSpace::zero(), variables: VectorSpace::zero() };
        Ok(Step::new(end, unknown))
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
    let kernel = top.kernel()?;
    let start = (UnitQuaternion::from_euler_angles(0.5, 0.0, 0.0), Vector3::new(0.1, 0.0, 20.0));
    let run = Simulation::new(&kernel);
    let exact = run.adaptive(1e-12, 1e-13).run_to_end(start.0, start.1, 0.0..1.0)?;
    println!("A heavy top for one second by Heun's method on the group, against an adaptive run at 1e-12:\n");
    println!("{:>8}{:>12}{:>8}", "step, s", "error, rad", "ratio");
    let mut before = None;
    for steps in [250, 500, 1000, 2000, 4000] {
        let h = 1.0 / f64::from(steps);
        let end = run.control(Fixed::by(Heun, h)).run_to_end(start.0, start.1, 0.0..1.0)?;
        let error = end.q.angle_to(&exact.q);
        let ratio = before.map_or(String::new(), |last: f64| format!("{:.2}", last / error));
        println!("{h:>8}{error:>12.2e}{ratio:>8}");
        before = Some(error);
    }
    println!("\nHalving the step divides the error by 4: order 2.");
    Ok(())
}
