//! A car as a single track whose tyres slip, at several speeds: `cargo run --release --example single_track`.
//!
//! Two checks are not of this library: how fast it turns in the end, and the speed at which a car that oversteers
//! cannot be held any more (Riekert & Schunck, *Zur Fahrmechanik des gummibereiften Kraftfahrzeugs*, Ingenieur-Archiv
//! 11, 1940).

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// A car in the plane: O is its centre of mass, e₁ forward, e₂ to the left. What a tyre does is its stiffness times the
/// angle between where it points and where it goes.
// ANCHOR: car
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    motion = planar,
    chart = left_invariant,
    define(v = body.body_velocity, turn = body.body_angular_velocity.z),
    input(steer = "rad"),
    force(front, at = [a, 0, 0], axes = body, value = front_stiffness * (steer - atan2(v.y + a * turn, v.x))
        * [-sin(steer), cos(steer), 0]),
    force(rear, at = [-b, 0, 0], axes = body, value = -rear_stiffness * atan2(v.y - b * turn, v.x) * [0, 1, 0]),
    // The engine holds the speed.
    force(engine, body = body, value = [hold * (speed - v.x), 0, 0]),
)]
struct Car {
    #[gauss(mass, unit = "kg")]
    mass: f64,
    #[gauss(inertia, unit = "kg m^2")]
    inertia: f64,
    /// From O to the front axle.
    #[gauss(unit = "m")]
    a: f64,
    /// From O to the rear axle.
    #[gauss(unit = "m")]
    b: f64,
    #[gauss(unit = "N/rad")]
    front_stiffness: f64,
    #[gauss(unit = "N/rad")]
    rear_stiffness: f64,
    #[gauss(unit = "N s/m")]
    hold: f64,
    #[gauss(unit = "m/s")]
    speed: f64,
}
// ANCHOR_END: car

impl Car {
    /// What the steering has to give more than L/R for each m/s² of lateral acceleration, rad s²/m: above 0 it
    /// understeers.
    fn understeer(&self) -> f64 {
        let Self { mass, a, b, front_stiffness: front, rear_stiffness: rear, .. } = self;
        mass * (b * rear - a * front) / ((a + b) * front * rear)
    }

    /// δ V/(L + K V²): how fast it turns in the end, for small angles.
    fn turns(&self, steer: f64) -> f64 {
        steer * self.speed / (self.a + self.b + self.understeer() * self.speed.powi(2))
    }
}

/// The largest real part of what disturbances of (v, r) straight ahead grow with, from the trace and the determinant.
fn growth(kernel: &CarKernel, speed: f64) -> f64 {
    let along = Vector3::new(speed, 0.0, 0.0);
    let linear = kernel.linearize(0.0, &Isometry2::identity(), &along, &SVector::from([0.0])).by_state;
    let rows = linear.fixed_view::<2, 2>(4, 4);
    let (half, determinant) = (0.5 * rows.trace(), rows.determinant());
    half + (half * half - determinant).max(0.0).sqrt()
}

fn main() -> Result<(), Box<dyn Error>> {
    let car = |front_stiffness: f64, speed: f64| Car {
        mass: 1500.0,
        inertia: 2500.0,
        a: 1.2,
        b: 1.5,
        front_stiffness,
        rear_stiffness: 100e3,
        hold: 1e5,
        speed,
    };
    let steer = 1e-3;
    println!(" speed  front stiffness   turns/(rad/s)   by formula   growth/(1/s)");
    for (front, speed) in [(90e3, 10.0), (90e3, 30.0), (150e3, 10.0), (150e3, 25.0)] {
        let car = car(front, speed);
        let kernel = car.kernel()?;
        let run = Simulation::new(&kernel).input(move |_t, _q, _z| SVector::from([steer])).adaptive(1e-10, 1e-12);
        let end = run.run_to_end(Isometry2::identity(), Vector3::new(speed, 0.0, 0.0), 0.0..20.0)?;
        let (turns, expected) = (end.z[2], car.turns(steer));
        println!("{speed:6.1} {front:16.0} {turns:15.6} {expected:12.6} {:14.3}", growth(&kernel, speed));
        // What the formula leaves out is of the second order in the angles, 10⁻³ and less.
        if (turns / expected - 1.0).abs() > 1e-4 {
            return Err("it does not turn as it should".into());
        }
    }

    // Stiffer in front it oversteers, and beyond √(−L/K) a straight run is unstable: found by halving.
    let oversteering = car(150e3, 20.0);
    let critical = (-(oversteering.a + oversteering.b) / oversteering.understeer()).sqrt();
    let (mut stable, mut unstable) = (1.0, 200.0);
    while unstable - stable > 1e-9 {
        let speed = 0.5 * (stable + unstable);
        let grows = growth(&car(150e3, speed).kernel()?, speed) > 0.0;
        (stable, unstable) = if grows { (stable, speed) } else { (speed, unstable) };
    }
    println!("unstable beyond {stable:.6} m/s; √(−L/K) = {critical:.6} m/s");
    if (stable / critical - 1.0).abs() > 1e-9 {
        return Err("the critical speed is another".into());
    }
    write_page("single_track", &page(&car(90e3, 55.0), &car(150e3, 55.0))?)
}

/// Two cars faster than the critical speed of the second, each steered for a moment: what its tyres give.
fn page(understeers: &Car, oversteers: &Car) -> Result<Playback<CarKernel>, Box<dyn Error>> {
    let steer = |t: f64| SVector::from([0.01 * (-8.0 * (t - 1.0).powi(2)).exp()]);
    let kernels = [understeers.kernel()?, oversteers.kernel()?];
    let follow = |kernel: &CarKernel, car: &Car| {
        let start = (Isometry2::identity(), Vector3::new(car.speed, 0.0, 0.0));
        let run = Simulation::new(kernel).input(move |t, _q: &_, _z: &_| steer(t)).adaptive(1e-9, 1e-9);
        run.run(start.0, start.1, 0.0..4.0)?.at_times((0..600).map(|n| 4.0 * f64::from(n) / 599.0))
    };
    let paths = [follow(&kernels[0], understeers)?, follow(&kernels[1], oversteers)?];
    let names = ["soft in front", "stiff in front"];
    let mut page =
        Playback::of_samples("Two cars steered for a moment, above the critical speed", paths[0].clone()).si();
    for (((name, kernel), path), car) in names.into_iter().zip(&kernels).zip(&paths).zip([understeers, oversteers]) {
        // Both are sampled at the same times.
        let of = |s: &Sample<CarKernel>| path[path.partition_point(|other| other.t < s.t).min(path.len() - 1)];
        let pose = |s: &Sample<CarKernel>| kernel.pose(s.t, &of(s).q);
        let tyre = |(x, side): (f64, f64)| {
            Shape::cuboid([0.6, 0.2, 0.6]).at(&Isometry3::translation(x, side, -0.1)).colour("#444444")
        };
        let hull = Shape::cuboid([4.2, 1.6, 0.7]).at(&Isometry3::translation(0.0, 0.0, 0.4));
        let tyres = [(car.a, 0.8), (car.a, -0.8), (-car.b, 0.8), (-car.b, -0.8)].map(tyre);
        page = page.body(name, pose, [hull].into_iter().chain(tyres)).trace(name, [0.0; 3]);
        for (axle, at) in [("front", car.a), ("rear", -car.b)] {
            let Some(k) = CarKernel::ELEMENTS.iter().position(|element| element.name == axle) else { continue };
            // The speeds are (u, v, r): what acts on them are a force in body axes and a torque.
            page = page.arrow(&format!("{axle} tyres, {name}"), 2e-4, |s| {
                let forces = kernel.element_forces(s.t, &of(s).q, &of(s).z, &steer(s.t));
                let pose = pose(s);
                let place = pose.translation.vector + pose.rotation * Vector3::new(at, 0.0, 0.0);
                (place, pose.rotation * Vector3::new(forces[(0, k)], forces[(1, k)], 0.0))
            });
        }
        page = page
            .curve("turn / (°/s)", name, |s| of(s).z[2].to_degrees())
            .curve("drift / °", name, |s| of(s).z[1].atan2(of(s).z[0]).to_degrees())
            .curve("kinetic energy / kJ", name, |s| 1e-3 * kernel.kinetic_energy(s.t, &of(s).q, &of(s).z));
    }
    Ok(page.from_above().follow(names[1]))
}
