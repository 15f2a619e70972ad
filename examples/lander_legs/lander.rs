//! A lander on four legs, one touchdown of it, and the speed above which it tips over where it touches flat.

use std::f64::consts::TAU;

use gauss_contact::{ContactError, ContactStepper, Mode};
use gauss_runtime::prelude::*;
use gauss_study::{Declaration, Draw, Parameter, normal, uniform};

/// A hull on four struts; each has a foot that touches the ground, and is crushed where more than a force loads it, as
/// honeycomb is: dry friction along the strut, between two stops. The observer's axes are those of the ground, z = 0;
/// gravity is a vector in them, so that a slope is a weight that leans.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, s1, s2, s3, s4),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = [j, j, j3]),
    body(foot1, parent = hull, position = [a, a, s1 - h], mass = foot, inertia = 0),
    body(foot2, parent = hull, position = [-a, a, s2 - h], mass = foot, inertia = 0),
    body(foot3, parent = hull, position = [-a, -a, s3 - h], mass = foot, inertia = 0),
    body(foot4, parent = hull, position = [a, -a, s4 - h], mass = foot, inertia = 0),
    contact(pad1, point = foot1.position, friction = mu),
    contact(pad2, point = foot2.position, friction = mu),
    contact(pad3, point = foot3.position, friction = mu),
    contact(pad4, point = foot4.position, friction = mu),
    contact(belly, point = hull.position, radius = h / 2, friction = mu),
    dry_friction(s1, bound = crush), range(s1, from = 0, to = stroke),
    dry_friction(s2, bound = crush), range(s2, from = 0, to = stroke),
    dry_friction(s3, bound = crush), range(s3, from = 0, to = stroke),
    dry_friction(s4, bound = crush), range(s4, from = 0, to = stroke),
)]
#[derive(Clone)]
pub struct Lander {
    /// kg, kg m²: the hull.
    pub m: f64,
    pub j: f64,
    pub j3: f64,
    /// kg: each foot.
    pub foot: f64,
    /// m: half the distance of neighbouring feet, and the hull's center of mass above them.
    pub a: f64,
    pub h: f64,
    /// N: what a strut bears before it is crushed; m: by how much it can be.
    pub crush: f64,
    pub stroke: f64,
    /// Of the ground, and m/s², ground axes.
    pub mu: f64,
    #[gauss(gravity)]
    pub weight: Vector3<f64>,
}

/// m/s²: of the Moon.
pub const G: f64 = 1.62;
/// How many pads there are; they come first.
pub const PADS: usize = 4;
/// The length of a step, s, and how long a touchdown may take.
pub const STEP: f64 = 2e-3;
pub const LONGEST: f64 = 12.0;
/// What counts as a slide, m, and the cosine of the tilt against the ground at which it counts as over.
const SLIDE: f64 = 0.5;
const OVER: f64 = 0.5;

impl Lander {
    /// Of 1040 kg, with feet 2.5 m apart.
    #[must_use]
    pub fn small(mu: f64, slope: f64) -> Self {
        let weight = G * Vector3::new(slope.sin(), 0.0, -slope.cos());
        let (m, j, j3, foot) = (1000.0, 1200.0, 1500.0, 10.0);
        Self { m, j, j3, foot, a: 1.25, h: 2.0, crush: 2500.0, stroke: 0.4, mu, weight }
    }

    /// Where it touches flat on level ground with its front feet abreast, falls at `fall` m/s and moves forward, and
    /// its feet stick and its struts hold: the forward speed, m/s, above which it tips over.
    ///
    /// The touch turns the momentum about the line of the front feet, `M (c v − a w)`, into a turn about it; what is
    /// over it then is the least of the energies that lift the center of mass above that line.
    #[must_use]
    pub fn tips_above(&self, fall: f64) -> f64 {
        let Lever { mass, height, inertia, .. } = self.lever();
        let lift = self.a.hypot(height) - height;
        (2.0 * inertia * mass * G * lift).sqrt() / (mass * height) + self.a * fall / height
    }

    /// With its struts as they were.
    #[must_use]
    pub fn lever(&self) -> Lever {
        let mass = self.m + 4.0 * self.foot;
        let height = self.m * self.h / mass;
        // About the line of the front feet: of the hull, and of the rear feet.
        let inertia = self.j + self.m * (self.a.powi(2) + self.h.powi(2)) + 2.0 * self.foot * (2.0 * self.a).powi(2);
        Lever { mass, height, inertia }
    }
}

/// The lander as one body: kg, m above the feet, kg m² about the line of two neighbouring feet.
pub struct Lever {
    pub mass: f64,
    pub height: f64,
    pub inertia: f64,
}

/// How a touchdown ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It rests, less than half a metre from where it touched.
    Stands,
    /// It came to rest further away, or slides on.
    Slides,
    /// It leans by more than 60° against the ground.
    Tips,
}

pub type State = ((Isometry3<f64>, SVector<f64, 4>), SVector<f64, 10>);

/// A touchdown before it begins.
pub struct Approach {
    /// m/s: along the ground that is level, and downward.
    pub lateral: f64,
    pub fall: f64,
    /// rad: of the ground; of the hull against the vertical.
    pub slope: f64,
    pub tilt: f64,
    pub mu: f64,
    pub start: State,
}

/// The velocity along the ground that is level, m/s: in two directions, or how much and whither.
pub enum Along {
    Parts([Parameter; 2]),
    Polar { speed: Parameter, direction: Parameter },
}

/// What is random in a touchdown.
pub struct Parameters {
    slope: Parameter,
    along: Along,
    mu: Parameter,
    heading: Parameter,
    tilts: [Parameter; 2],
    fall: Parameter,
    spin: [Parameter; 3],
}

/// A touchdown.
pub struct Landing {
    pub outcome: Outcome,
    /// Whether it rests.
    pub rests: bool,
    /// m: the longest way of a strut, and how far the feet went from where they touched.
    pub crushed: f64,
    pub slid: f64,
    /// m/s: the worst residual of the laws; m: the lowest gap at the end of a step.
    pub residual: f64,
    pub lowest: f64,
}

impl Parameters {
    /// Of a study that has declared slope and velocity.
    pub fn declare(study: &mut Declaration, slope: Parameter, along: Along) -> Self {
        let degrees = |deviation: f64| normal(0.0, deviation.to_radians());
        Self {
            slope,
            along,
            mu: study.parameter("mu", "", uniform(0.3, 0.9)),
            heading: study.parameter("heading", "rad", uniform(0.0, TAU)),
            tilts: ["tilt_x", "tilt_y"].map(|name| study.parameter(name, "rad", degrees(3.0))),
            fall: study.parameter("fall", "m/s", uniform(1.0, 1.5)),
            spin: ["spin_x", "spin_y", "spin_z"].map(|name| study.parameter(name, "rad/s", degrees(2.0))),
        }
    }

    /// Any slope up to 15°, and a velocity that is normal.
    pub fn declare_all(study: &mut Declaration) -> Self {
        let slope = study.parameter("slope", "rad", uniform(0.0, 15.0_f64.to_radians()));
        let along = ["along_x", "along_y"].map(|name| study.parameter(name, "m/s", normal(0.0, 1.1)));
        Self::declare(study, slope, Along::Parts(along))
    }

    /// The approach of one run.
    #[must_use]
    pub fn approach(&self, draw: &Draw) -> Approach {
        let [slope, mu, heading, fall] = [self.slope, self.mu, self.heading, self.fall].map(|name| draw[name]);
        let (tilts, spin) = (self.tilts.map(|tilt| draw[tilt]), self.spin.map(|spin| draw[spin]));
        let along = match &self.along {
            Along::Parts(parts) => parts.map(|part| draw[part]),
            Along::Polar { speed, direction } => {
                [draw[*speed] * draw[*direction].cos(), draw[*speed] * draw[*direction].sin()]
            }
        };
        // From axes whose third is vertical to those of the ground, whose first points downhill.
        let level = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
        let lean = UnitQuaternion::from_scaled_axis(Vector3::new(tilts[0], tilts[1], 0.0));
        let velocity = level * Vector3::new(along[0], along[1], -fall);
        let start = above_ground(&Lander::small(mu, slope), level * lean * turned, velocity, Vector3::from(spin));
        Approach { lateral: along[0].hypot(along[1]), fall, slope, tilt: tilts[0].hypot(tilts[1]), mu, start }
    }
}

impl Approach {
    /// What comes of it.
    ///
    /// # Errors
    /// Where a step is one, or a parameter.
    pub fn touch_down(&self) -> Result<Landing, Box<dyn std::error::Error>> {
        let kernel = Lander::small(self.mu, self.slope).kernel()?;
        Ok(touch_down(&kernel, self.start, (STEP, LONGEST), |_| ())?)
    }
}

/// With its lowest foot on the ground; the velocity is that of the hull in ground axes, the spin in the hull's.
#[must_use]
pub fn above_ground(lander: &Lander, turn: UnitQuaternion<f64>, velocity: Vector3<f64>, spin: Vector3<f64>) -> State {
    let feet = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let height = |[x, y]: [f64; 2]| (turn * Vector3::new(x * lander.a, y * lander.a, -lander.h)).z;
    let lowest = feet.into_iter().map(height).fold(f64::INFINITY, f64::min);
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, -lowest), turn);
    let state = LanderState { pose, pose_u: turn.inverse() * velocity, pose_omega: spin, ..Default::default() };
    (state.q(), state.z())
}

/// The middle of the feet, ground axes.
fn feet(kernel: &LanderKernel, q: &(Isometry3<f64>, SVector<f64, 4>)) -> Vector3<f64> {
    let points = (0..PADS).filter_map(|i| kernel.contact_frame(i, 0.0, q)).map(|frame| frame.point);
    points.sum::<Vector3<f64>>() / PADS as f64
}

/// A touchdown in steps of this length, s, for no longer than that, each end of a step handed to `see`.
///
/// # Errors
/// Where a step is one.
pub fn touch_down(
    kernel: &LanderKernel,
    (q, z): State,
    (h, longest): (f64, f64),
    mut see: impl FnMut(&ContactStepper<'_, LanderKernel>),
) -> Result<Landing, ContactError> {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z)?;
    let (mut residual, mut lowest, mut touched) = (0.0_f64, 0.0_f64, None);
    let (mut rests, mut over) = (false, false);
    while stepper.time() < longest && !rests && !over {
        let report = stepper.step(h, &())?.residual;
        residual = residual.max(report.signorini).max(report.coulomb).max(report.dissipation);
        lowest = lowest.min(kernel.gaps(0.0, stepper.configuration()).min());
        let (q, z) = (stepper.configuration(), stepper.speeds());
        let stands = stepper.modes()[..PADS].iter().filter(|mode| **mode == Mode::Sticks).count() >= 3;
        if stepper.modes()[..PADS].iter().any(|mode| mode.is_closed()) {
            touched.get_or_insert_with(|| feet(kernel, q));
        }
        rests = stands && z.amax() < 1e-9;
        over = (q.0.rotation * Vector3::z()).z < OVER;
        see(&stepper);
    }
    let q = stepper.configuration();
    let slid = touched.map_or(0.0, |before| (feet(kernel, q) - before).xy().norm());
    let outcome = match (over, rests && slid < SLIDE) {
        (true, _) => Outcome::Tips,
        (false, true) => Outcome::Stands,
        (false, false) => Outcome::Slides,
    };
    Ok(Landing { outcome, rests, crushed: q.1.max(), slid, residual, lowest })
}

/// One run: what was random, and what came of it.
pub type Run = (Approach, Landing);

/// Outcomes in words.
pub const OUTCOMES: [(Outcome, &str); 3] =
    [(Outcome::Stands, "stands"), (Outcome::Slides, "slides"), (Outcome::Tips, "tips over")];

/// Where a probability lies of which `hits` of `count` runs tell, with 95 % (E. B. Wilson 1927).
pub fn wilson(hits: usize, count: usize) -> (f64, f64) {
    let (n, z) = (count as f64, 1.96);
    let share = hits as f64 / n;
    let middle = share + z * z / (2.0 * n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    ((middle - half) / whole, (middle + half) / whole)
}
