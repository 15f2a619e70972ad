//! A leg that hops in a plane, its controller, and its steps in time, with a push that may come at any moment.

use std::sync::OnceLock;

use gauss_contact::{ContactError, ContactStepper, Mode};
use gauss_runtime::prelude::*;

/// A hull with a leg: it turns about the hip and has a spring in it. Angles are about the observer's second axis, from
/// upright; k₃ points up and the ground is z = 0. Toe and hull touch it; the leg has stops of its length and of the
/// hip.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, pitch, hip, length),
    input(motor = "N m", thrust = "N", push_x = "N", push_z = "N", turn = "N m", mu),
    body(hull, position = [x, 0, z], rotation = rotation_y(pitch), mass = m, inertia = j),
    body(leg, parent = hull, rotation = rotation_y(hip), mass = upper, center_of_mass = [0, 0, -l / 4],
        inertia_about_center_of_mass = upper * l * l / 48),
    body(foot, parent = leg, position = [0, 0, -length], mass = lower, center_of_mass = [0, 0, l / 4],
        inertia_about_center_of_mass = lower * l * l / 48),
    spring(coil, along = length, stiffness = k, length = l, damping = c),
    drive(hip = motor),
    drive(length = thrust),
    force(push, body = hull, value = [push_x, 0, push_z], axes = observer),
    torque(turning, body = hull, value = [0, turn, 0]),
    point(rear, body = hull, at = [-half, 0, 0]),
    point(front, body = hull, at = [half, 0, 0]),
    contact(toe, point = foot.position, friction = mu),
    contact(shell, point = rear, end = front, radius = r, friction = mu),
    range(length, from = l / 2, to = l),
    range(hip, from = -1.2, to = 1.2),
)]
pub struct Hopper {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(unit = "kg m^2")]
    pub j: f64,
    /// Of the leg, above and below its spring.
    #[gauss(unit = "kg")]
    pub upper: f64,
    #[gauss(unit = "kg")]
    pub lower: f64,
    /// The leg at its longest.
    #[gauss(unit = "m")]
    pub l: f64,
    #[gauss(unit = "N/m")]
    pub k: f64,
    #[gauss(unit = "N s/m")]
    pub c: f64,
    /// The hull is a capsule: half the distance of its ends, and its radius.
    #[gauss(unit = "m")]
    pub half: f64,
    #[gauss(unit = "m")]
    pub r: f64,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
}

/// The hopper of the page: 9 kg, half a metre high.
pub const HOPPER: Hopper =
    Hopper { m: 8.0, j: 0.4, upper: 0.6, lower: 0.4, l: 0.5, k: 3000.0, c: 6.0, half: 0.17, r: 0.08, g: 9.81 };

/// The length of a step, s.
pub const STEP: f64 = 1e-3;
/// So long it lies before it is set up again, s.
pub const LIES: f64 = 2.0;
/// Contacts that have a place: the toe, and both ends of the hull. Behind them stand the stops.
pub const PLACED: usize = 3;

/// What the person before the page wants.
#[derive(Clone, Copy)]
pub struct Wanted {
    /// m/s
    pub speed: f64,
    /// By how much the hull rises above a leg that stands, m.
    pub height: f64,
    /// The coefficient of friction of the ground.
    pub friction: f64,
}

/// At first.
pub const WANTED: Wanted = Wanted { speed: 0.6, height: 0.15, friction: 0.8 };

/// A force on the hull, N, observer's first and third axes, and the point where it acts, in axes of the hull.
#[derive(Clone, Copy, Default)]
pub struct Push {
    pub force: [f64; 2],
    pub at: [f64; 2],
}

type Coordinates = SVector<f64, 5>;
type Inputs = SVector<f64, 6>;

/// A leg on its way.
pub struct Leg {
    stepper: ContactStepper<'static, HopperKernel>,
    /// When the toe has touched last, and how long stances last, s.
    touched: f64,
    stance: f64,
    /// Since when the hull lies on the ground.
    down: Option<f64>,
    /// Since the start: the worst residual of the laws, m/s, the largest gap below zero before and after the
    /// projection of a step, m, and how far the toe has moved in all steps in which it sticks, m.
    pub worst: [f64; 4],
    /// How often it was set up again.
    pub falls: u32,
}

fn kernel() -> Result<&'static HopperKernel, String> {
    static KERNEL: OnceLock<Result<HopperKernel, String>> = OnceLock::new();
    KERNEL.get_or_init(|| HOPPER.kernel().map_err(|error| error.to_string())).as_ref().map_err(Clone::clone)
}

/// Above the ground, with a straight leg, at a place.
fn above(t: f64, x: f64) -> Result<ContactStepper<'static, HopperKernel>, String> {
    let q = Coordinates::from([x, HOPPER.l + 0.1, 0.0, 0.0, HOPPER.l]);
    ContactStepper::new(kernel()?, t, q, Coordinates::zeros()).map_err(|error| error.to_string())
}

impl Leg {
    /// Above the ground, at rest.
    ///
    /// # Errors
    /// None with the parameters of this file.
    pub fn new() -> Result<Self, String> {
        let stepper = above(0.0, 0.0)?;
        Ok(Self { stepper, touched: 0.0, stance: 0.2, down: None, worst: [0.0; 4], falls: 0 })
    }

    /// So many steps, with a push that stays.
    ///
    /// # Errors
    /// Where a step finds no impulses that satisfy the laws.
    pub fn advance(&mut self, steps: u32, wanted: &Wanted, push: &Push) -> Result<(), String> {
        for _ in 0..steps {
            self.step(wanted, push).map_err(|error| error.to_string())?;
            if self.down.is_some_and(|since| self.time() - since > LIES) {
                self.stepper = above(self.time(), self.stepper.configuration()[0])?;
                (self.down, self.falls) = (None, self.falls + 1);
            }
        }
        Ok(())
    }

    fn step(&mut self, wanted: &Wanted, push: &Push) -> Result<(), ContactError> {
        let input = self.input(wanted, push);
        let (before, stood, stuck) = (self.toe(), self.stands(), self.sticks());
        let report = self.stepper.step(STEP, &input)?;
        let (t, stands) = (self.time(), self.stands());
        match (stood, stands) {
            (false, true) => self.touched = t,
            (true, false) => self.stance = (t - self.touched).clamp(0.05, 0.5),
            _ => (),
        }
        let lies = self.stepper.modes()[1..PLACED].iter().any(|mode| mode.is_closed());
        self.down = lies.then(|| self.down.unwrap_or(t));
        let lowest = self.gaps().iter().copied().fold(0.0, f64::min);
        let moved = if stuck && self.sticks() { (self.toe() - before).norm() } else { 0.0 };
        let residual = report.residual;
        let laws = residual.signorini.max(residual.coulomb).max(residual.dissipation);
        let [worst, deepest, below, _] = self.worst;
        self.worst = [worst.max(laws), deepest.max(report.penetration), below.max(-lowest), self.worst[3] + moved];
        Ok(())
    }

    /// What motor and spring do (M. H. Raibert, *Legged Robots That Balance*, 1986): in the air the foot goes where the
    /// stance that follows keeps the speed; on the ground the hip holds the hull level, and the leg makes up, on its
    /// way out, for the energy that is missing for the height.
    fn input(&self, wanted: &Wanted, push: &Push) -> Inputs {
        let (q, z) = (self.stepper.configuration(), self.stepper.speeds());
        let Hopper { m, upper, lower, l, k, g, .. } = HOPPER;
        let [speed, height] = [z[0], q[1]];
        let (motor, thrust) = if self.down.is_some() {
            (0.0, 0.0)
        } else if self.stands() {
            let weight = (m + upper + lower) * g;
            let short = l - q[4];
            let energy = weight * height + 0.5 * (m + upper) * (speed.powi(2) + z[1].powi(2)) + 0.5 * k * short.powi(2);
            let missing = weight * (l + wanted.height) + 0.5 * (m + upper) * speed.powi(2) - energy;
            let thrust = if z[4] > 0.0 { 1.2 * missing / short.max(0.02) } else { 0.0 };
            ((80.0 * q[2] + 14.0 * z[2]).clamp(-40.0, 40.0), thrust.clamp(0.0, 250.0))
        } else {
            let ahead = 0.5 * speed * self.stance + 0.05 * (speed - wanted.speed);
            let angle = -(ahead / l).clamp(-0.5, 0.5).asin();
            ((60.0 * (angle - q[2] - q[3]) - 3.0 * (z[2] + z[3])).clamp(-40.0, 40.0), 0.0)
        };
        let [force_x, force_z] = push.force;
        // Where the push acts, observer's axes from the middle of the hull.
        let (sine, cosine) = q[2].sin_cos();
        let [at_x, at_z] = [cosine * push.at[0] + sine * push.at[1], cosine * push.at[1] - sine * push.at[0]];
        Inputs::from([motor, thrust, force_x, force_z, at_z * force_x - at_x * force_z, wanted.friction])
    }

    /// The time, s.
    pub fn time(&self) -> f64 {
        self.stepper.time()
    }

    /// The coordinates: place of the hull, its pitch, the hip, the length of the leg.
    pub fn coordinates(&self) -> &Coordinates {
        self.stepper.configuration()
    }

    /// Their rates.
    pub fn rates(&self) -> &Coordinates {
        self.stepper.speeds()
    }

    /// Whether the toe is on the ground.
    pub fn stands(&self) -> bool {
        self.stepper.modes()[0].is_closed()
    }

    fn sticks(&self) -> bool {
        self.stepper.modes()[0] == Mode::Sticks
    }

    fn gaps(&self) -> Vec<f64> {
        let gaps = kernel().map(|kernel| kernel.gaps(self.time(), self.coordinates()));
        gaps.map_or(Vec::new(), |gaps| gaps.iter().copied().collect())
    }

    fn frame(&self, contact: usize) -> Option<gauss_runtime::contact::ContactFrame<f64>> {
        kernel().ok()?.contact_frame(contact, self.time(), self.coordinates())
    }

    fn toe(&self) -> Vector3<f64> {
        self.frame(0).map_or_else(Vector3::zeros, |frame| frame.point)
    }

    /// What the page shows: time, coordinates, forward speed, falls, contacts that are closed, corrections of the last
    /// step, what `worst` has; then of each contact with a place what it does, where, and its force (x and z); then
    /// what the stops do. Modes are 0 open, 1 closed, 2 sticks, 3 slides.
    pub fn numbers(&self) -> Vec<f64> {
        let report = self.stepper.report();
        let mut numbers = vec![self.time()];
        numbers.extend(self.coordinates().iter());
        numbers.extend([self.rates()[0], f64::from(self.falls), report.closed as f64, f64::from(report.corrections)]);
        numbers.extend(self.worst);
        let modes = self.stepper.modes();
        for (i, contact) in HopperKernel::CONTACTS.iter().enumerate().take(PLACED) {
            let rows: Vec<f64> = contact.rows().map(|row| self.stepper.impulses()[row] / STEP).collect();
            let [point, force] = self.frame(i).map_or([Vector3::zeros(); 2], |frame| [frame.point, frame.force(&rows)]);
            numbers.extend([code(&modes[i]), point.x, point.z, force.x, force.z]);
        }
        numbers.extend(modes[PLACED..].iter().map(code));
        numbers
    }
}

fn code(mode: &Mode) -> f64 {
    match mode {
        Mode::Open => 0.0,
        Mode::Closed => 1.0,
        Mode::Sticks => 2.0,
        Mode::Slides(_) => 3.0,
    }
}
