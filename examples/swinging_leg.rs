//! A leg that swings by its weight alone, as in walking: `cargo run --release --example swinging_leg`.
//!
//! Masses, centres and radii of gyration are those of de Leva (*Adjustments to Zatsiorsky–Seluyanov's segment inertia
//! parameters*, J. Biomechanics 29, 1996, table 4, males). That no muscle is needed is Mochon & McMahon's *Ballistic
//! walking* (J. Biomechanics 13, 1980). The small oscillations are compared with those of two compound pendulums by
//! hand.

use std::error::Error;

use gauss_contact::{ContactRun, ContactTrajectory, EventKind};
use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// A thigh on a fixed hip, and a shank with its foot. Angles are about k₂: of the thigh from straight down, forward
/// positive; of the knee from straight, bent positive. The axes e₃ of both point up along the segments.
// ANCHOR: leg
#[derive(GaussDynamics)]
#[gauss(
    linearize(without_contacts),
    frames(thigh, shank),
    coordinates(hip, knee),
    body(thigh, rotation = rotation_y(-hip)),
    body(shank, parent = thigh, position = [0, 0, -length], rotation = rotation_y(knee)),
    // A knee does not bend forward.
    range(knee, from = 0),
)]
struct Leg {
    #[gauss(body = about_center_of_mass)]
    thigh: Segment,
    #[gauss(body = about_center_of_mass)]
    shank: Segment,
    length: f64,
    #[gauss(gravity)]
    g: f64,
}
// ANCHOR_END: leg

type Segment = RigidBody<f64, AboutCenterOfMass<f64>>;

/// A row of the table: mass in % of the body's, centre from the upper end, and radius of gyration about the axis of the
/// swing, both in % of the length in m.
struct Row {
    mass: f64,
    center: f64,
    radius: f64,
    length: f64,
}

const BODY: f64 = 73.0;
const THIGH: Row = Row { mass: 14.16, center: 40.95, radius: 32.9, length: 0.4222 };
const SHANK: Row = Row { mass: 4.33, center: 44.59, radius: 25.5, length: 0.4340 };
const FOOT: Row = Row { mass: 1.37, center: 44.15, radius: 25.7, length: 0.2581 };

impl Row {
    fn mass(&self) -> f64 {
        BODY * self.mass / 100.0
    }

    /// About the centre of mass.
    fn inertia(&self) -> f64 {
        self.mass() * (self.radius / 100.0 * self.length).powi(2)
    }

    /// How far the centre is from the upper end.
    fn depth(&self) -> f64 {
        self.center / 100.0 * self.length
    }
}

/// Shank and foot as one: mass, depth below the knee, inertia about their centre. The foot's centre is at the ankle:
/// what it stands out in front is left out, as in ballistic walking.
fn lower_leg() -> (f64, f64, f64) {
    let (shank, foot) = (SHANK.mass(), FOOT.mass());
    let mass = shank + foot;
    let depth = (shank * SHANK.depth() + foot * SHANK.length) / mass;
    let apart = SHANK.inertia() + shank * (SHANK.depth() - depth).powi(2);
    (mass, depth, apart + FOOT.inertia() + foot * (SHANK.length - depth).powi(2))
}

fn segment(mass: f64, depth: f64, inertia: f64) -> Segment {
    // The swing is about e₂; the other moments play no part.
    let tensor = Matrix3::from_diagonal(&Vector3::new(inertia, inertia, 0.5 * inertia));
    RigidBody::about_center_of_mass(mass, Vector3::new(0.0, 0.0, -depth), tensor)
}

/// The squares of the frequencies of small oscillations, from M and K of two compound pendulums: det(K − ω² M) = 0.
fn frequencies(m: [[f64; 2]; 2], k: [[f64; 2]; 2]) -> [f64; 2] {
    let a = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let b = k[0][0] * m[1][1] + m[0][0] * k[1][1] - k[0][1] * m[1][0] - m[0][1] * k[1][0];
    let c = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    let root = (b * b - 4.0 * a * c).sqrt();
    [(b - root) / (2.0 * a), (b + root) / (2.0 * a)]
}

fn main() -> Result<(), Box<dyn Error>> {
    let g = 9.81;
    let (mass, depth, inertia) = lower_leg();
    let thigh = segment(THIGH.mass(), THIGH.depth(), THIGH.inertia());
    let kernel = Leg { thigh, shank: segment(mass, depth, inertia), length: THIGH.length, g }.kernel()?;

    // By hand, in the angles of both segments from straight down.
    let about_hip = THIGH.inertia() + THIGH.mass() * THIGH.depth().powi(2) + mass * THIGH.length.powi(2);
    let coupled = mass * THIGH.length * depth;
    let by_hand = frequencies(
        [[about_hip, coupled], [coupled, inertia + mass * depth * depth]],
        [[(THIGH.mass() * THIGH.depth() + mass * THIGH.length) * g, 0.0], [0.0, mass * depth * g]],
    );
    // Without forces of the kneecap: the lower right rows of the linear equations are −M⁻¹K.
    let (down, still) = (SVector::zeros(), SVector::zeros());
    let linear = kernel.linearize(0.0, &down, &still, &()).by_state;
    let rows = linear.fixed_view::<2, 2>(2, 0);
    let (half, determinant) = (-0.5 * rows.trace(), rows.determinant());
    let root = (half * half - determinant).sqrt();
    for (derived, by_hand) in [half - root, half + root].iter().zip(by_hand) {
        println!("period of small oscillations: {:.4} s", std::f64::consts::TAU / derived.sqrt());
        if (derived / by_hand - 1.0).abs() > 1e-12 {
            return Err("the periods are not those by hand".into());
        }
    }

    // A step: the toes leave the ground with the thigh behind and the knee bent, both on their way.
    let toe_off = LegState { hip: -0.2, knee: 0.7, hip_dot: 3.0, knee_dot: 5.5 };
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(toe_off.q(), toe_off.z(), 0.0..0.6)?;
    let [straight, ..] = run.events() else { return Err("the knee stays bent".into()) };
    let EventKind::Impact(impact) = straight.kind else { return Err("the knee does not strike".into()) };
    let (swing, hip) = (run.segments()[0].trajectory(), run.at(straight.time)?.q[0]);
    println!("the knee is straight after {:.3} s, with the thigh {hip:.2} rad in front;", straight.time);
    println!("  the kneecap takes {:.2} J, and holds it straight to {:.2} rad", impact.energy_lost, end_of(&run)?.q[0]);
    let energy = |s: &Sample<_>| kernel.energy(s.t, &s.q, &s.z);
    let lost = (energy(swing.last()) - energy(swing.first())).abs();
    // Well within half a period of the slow oscillation, as a leg that swings ahead of a walker has to be; nothing
    // takes energy before the knee is straight.
    if straight.time > 0.5 || hip < 0.0 || lost > 1e-8 || end_of(&run)?.q[1] != 0.0 {
        return Err("that is no step".into());
    }
    write_page("swinging_leg", &page(&kernel, run.iter().collect()))
}

fn end_of(run: &ContactTrajectory<'_, LegKernel>) -> Result<Sample<LegKernel>, &'static str> {
    run.last().ok_or("no step was made")
}

/// The leg, and the weights of its segments.
fn page(kernel: &LegKernel, path: Vec<Sample<LegKernel>>) -> Playback<LegKernel> {
    let (mass, depth, _) = lower_leg();
    let weight = |s: &Sample<LegKernel>, frame: LegFrame, depth: f64, mass: f64| {
        let pose = kernel.pose_of(frame, s.t, &s.q);
        (pose.translation.vector - pose.rotation * Vector3::z() * depth, Vector3::z() * (-mass * 9.81))
    };
    let ankle = [0.0, 0.0, -SHANK.length];
    let foot = Shape::cuboid([FOOT.length, 0.08, 0.05]).at(&Isometry3::translation(0.08, 0.0, -SHANK.length - 0.02));
    Playback::of_samples("A leg that swings by its weight alone", path)
        .si()
        .frames(kernel)
        .from_the_side()
        .shape("thigh", Shape::ball(0.07))
        .shape("thigh", Shape::rod([0.0; 3], [0.0, 0.0, -THIGH.length], 0.06))
        .shape("shank", Shape::ball(0.06))
        .shape("shank", Shape::rod([0.0; 3], ankle, 0.045))
        .shape("shank", foot.colour("#444444"))
        .trace("shank", ankle)
        .arrow("weight of the thigh", 3e-3, |s| weight(s, LegFrame::thigh, THIGH.depth(), THIGH.mass()))
        .arrow("weight of shank and foot", 3e-3, |s| weight(s, LegFrame::shank, depth, mass))
        .curve("angle / °", "hip", |s| s.q[0].to_degrees())
        .curve("angle / °", "knee", |s| s.q[1].to_degrees())
        .energy(kernel)
}
