//! A capsule that creeps through thick oil, by explicit steps and by linearly implicit ones:
//! `cargo run --release --example stiff_drag`.
//!
//! Its own motions die out within a ten-thousandth of a second; what there is to see takes ten seconds. Explicit
//! methods follow the first all along, because longer steps are unstable. `#[gauss(linearize)]` has the derive write
//! the Jacobian that a linearly implicit method needs: steps are then as long as the creeping allows.

use std::error::Error;
use std::time::{Duration, Instant};

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::Control;
use gauss_runtime::prelude::*;

/// A capsule on a spring, in oil.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    drag(linear = [c, c, 2 * c, b, b, b]),
    spring(from = [1, 2, 3], to = body.position + body.rotation * [0, 0, 0.3], stiffness = k),
)]
struct Capsule {
    #[gauss(mass, unit = "kg")]
    m: f64,
    #[gauss(inertia, unit = "kg m^2")]
    inertia: Vector3<f64>,
    #[gauss(center_of_mass, unit = "m")]
    center: Vector3<f64>,
    #[gauss(gravity, unit = "m/s^2")]
    g: f64,
    /// Drag along and across, and against turning.
    #[gauss(unit = "N s/m")]
    c: f64,
    #[gauss(unit = "N m s")]
    b: f64,
    #[gauss(unit = "N/m")]
    k: f64,
}

/// How long a run takes in the oil.
const SPAN: f64 = 10.0;

/// A run: where it ends, how many steps it takes, and how long they take.
struct Outcome {
    pose: Isometry3<f64>,
    steps: u64,
    time: Duration,
}

fn run<C: Control<CapsuleKernel>>(kernel: &CapsuleKernel, control: C) -> Result<Outcome, IntegrationError> {
    let mut samples = 0_u64;
    let clock = Instant::now();
    let spin = Vector6::from([0.1, 0.0, 0.0, 0.0, 0.3, 0.0]);
    let simulation = Simulation::new(kernel).control(control).observe(|_| samples += 1);
    let end = simulation.run_to_end(Isometry3::identity(), spin, 0.0..SPAN)?;
    Ok(Outcome { pose: end.q, steps: samples - 1, time: clock.elapsed() })
}

fn main() -> Result<(), Box<dyn Error>> {
    let (inertia, center) = (Vector3::new(1.0, 1.2, 0.8), Vector3::new(0.0, 0.01, -0.02));
    let kernel = Capsule { m: 1.0, inertia, center, g: 9.81, c: 1e4, b: 1e4, k: 1e3 }.kernel()?;
    let (once, linearized) = (CapsuleKernel::OPERATIONS.acceleration, CapsuleKernel::OPERATIONS.linearize);
    println!("operations: {} for accelerations, {} for all derivatives as well\n", once.total(), linearized.total());

    let exact = run(&kernel, Adaptive::by(Rosenbrock, 1e-12, 1e-12))?;
    let mut disagreement = 0.0_f64;
    println!("tolerance  method                     steps        time  error at the end");
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let explicit = run(&kernel, Adaptive::with(&Tableau::DORMAND_PRINCE_5, tolerance, tolerance))?;
        let implicit = run(&kernel, Adaptive::by(Rosenbrock, tolerance, tolerance))?;
        for (name, outcome) in [("Dormand–Prince 5(4)", &explicit), ("linearly implicit 4(3)", &implicit)] {
            let error = exact.pose.difference(&outcome.pose).amax();
            println!("{tolerance:9.0e}  {name:<22} {:>9} {:>11.1?}  {error:.1e}", outcome.steps, outcome.time);
            disagreement = disagreement.max(error / (outcome.steps as f64 * tolerance));
        }
        println!("           {} times fewer steps", explicit.steps / implicit.steps.max(1));
    }
    // Errors of steps add up at worst: nothing grows in oil.
    if disagreement > 1.0 {
        return Err("the methods disagree by more than their tolerances".into());
    }
    write_page("stiff_drag", &page(&kernel)?)
}

/// The capsule, the spring, and what the oil and the spring do.
fn page(kernel: &CapsuleKernel) -> Result<Playback<CapsuleKernel>, IntegrationError> {
    let control = Adaptive::by(Rosenbrock, 1e-8, 1e-8);
    let path =
        Simulation::new(kernel).control(control).run(Isometry3::identity(), Vector6::zeros(), 0.0..20.0 * SPAN)?;
    let eye = Vector3::new(0.0, 0.0, 0.3);
    let mut page = Playback::new("A capsule creeps through thick oil", &path)?
        .si()
        .body("capsule", |s| s.q, [Shape::ellipsoid([0.15, 0.15, 0.3])])
        .body("eye", |s| s.q * Isometry3::from(Translation3::from(eye)), [])
        .body("hook", |_| Isometry3::translation(1.0, 2.0, 3.0), [Shape::ball(0.05).colour("#444444")])
        .rod("hook", "eye", 0.01)
        .trace("capsule", [0.0; 3]);
    for (k, element) in CapsuleKernel::ELEMENTS.iter().enumerate() {
        // The speeds are (u, ω): what acts on them are a force in body axes and a torque.
        let force = |s: &Sample<CapsuleKernel>| -> Vector3<f64> {
            kernel.element_forces(s.t, &s.q, &s.z, &()).fixed_view::<3, 1>(0, k).into()
        };
        page = page.arrow(element.name, 4e-4, |s| (s.q.translation.vector, s.q.rotation * force(s))).curve(
            "force / N",
            element.name,
            |s| force(s).norm(),
        );
    }
    Ok(page.energy(kernel))
}
