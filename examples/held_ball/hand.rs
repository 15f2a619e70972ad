//! A hand of sixteen joints around a ball, and the torques that hold it.

use gauss_contact::{ContactError, ContactStepper};
use gauss_runtime::prelude::*;

/// Four fingers of four joints hang from a palm that is fixed, a quarter turn apart; each has a knuckle that turns
/// about its way outward, and three joints that bend. Their tips are spheres, and touch a ball. k₃ points up.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, a1, b1, c1, d1, a2, b2, c2, d2, a3, b3, c3, d3, a4, b4, c4, d4),
    input(ta1, tb1, tc1, td1, ta2, tb2, tc2, td2, ta3, tb3, tc3, td3, ta4, tb4, tc4, td4),
    body(ball, position = pose.position, rotation = pose.rotation, mass = heavy, inertia = 0.4 * heavy * r * r),
    frame(base1, position = [out * cos(0), out * sin(0), up], rotation = rotation_z(0)),
    body(knuckle1, parent = base1, rotation = rotation_x(a1), mass = m, inertia = m * w * w),
    body(near1, parent = knuckle1, rotation = rotation_y(b1),
        mass = m, center_of_mass = [0, 0, -l1 / 2], inertia_about_center_of_mass = m * l1 * l1 / 12),
    body(mid1, parent = near1, position = [0, 0, -l1], rotation = rotation_y(c1),
        mass = m, center_of_mass = [0, 0, -l2 / 2], inertia_about_center_of_mass = m * l2 * l2 / 12),
    body(far1, parent = mid1, position = [0, 0, -l2], rotation = rotation_y(d1),
        mass = m, center_of_mass = [0, 0, -l3 / 2], inertia_about_center_of_mass = m * l3 * l3 / 12),
    point(tip1, body = far1, at = [0, 0, -l3]),
    contact(thumb, point = tip1, radius = w, other = ball.position, other_radius = r,
        friction = mu, along = [0, 0, 1]),
    drive(a1 = ta1), drive(b1 = tb1), drive(c1 = tc1), drive(d1 = td1),
    frame(base2, position = [out * cos(pi / 2), out * sin(pi / 2), up], rotation = rotation_z(pi / 2)),
    body(knuckle2, parent = base2, rotation = rotation_x(a2), mass = m, inertia = m * w * w),
    body(near2, parent = knuckle2, rotation = rotation_y(b2),
        mass = m, center_of_mass = [0, 0, -l1 / 2], inertia_about_center_of_mass = m * l1 * l1 / 12),
    body(mid2, parent = near2, position = [0, 0, -l1], rotation = rotation_y(c2),
        mass = m, center_of_mass = [0, 0, -l2 / 2], inertia_about_center_of_mass = m * l2 * l2 / 12),
    body(far2, parent = mid2, position = [0, 0, -l2], rotation = rotation_y(d2),
        mass = m, center_of_mass = [0, 0, -l3 / 2], inertia_about_center_of_mass = m * l3 * l3 / 12),
    point(tip2, body = far2, at = [0, 0, -l3]),
    contact(index, point = tip2, radius = w, other = ball.position, other_radius = r,
        friction = mu, along = [0, 0, 1]),
    drive(a2 = ta2), drive(b2 = tb2), drive(c2 = tc2), drive(d2 = td2),
    frame(base3, position = [out * cos(pi), out * sin(pi), up], rotation = rotation_z(pi)),
    body(knuckle3, parent = base3, rotation = rotation_x(a3), mass = m, inertia = m * w * w),
    body(near3, parent = knuckle3, rotation = rotation_y(b3),
        mass = m, center_of_mass = [0, 0, -l1 / 2], inertia_about_center_of_mass = m * l1 * l1 / 12),
    body(mid3, parent = near3, position = [0, 0, -l1], rotation = rotation_y(c3),
        mass = m, center_of_mass = [0, 0, -l2 / 2], inertia_about_center_of_mass = m * l2 * l2 / 12),
    body(far3, parent = mid3, position = [0, 0, -l2], rotation = rotation_y(d3),
        mass = m, center_of_mass = [0, 0, -l3 / 2], inertia_about_center_of_mass = m * l3 * l3 / 12),
    point(tip3, body = far3, at = [0, 0, -l3]),
    contact(middle, point = tip3, radius = w, other = ball.position, other_radius = r,
        friction = mu, along = [0, 0, 1]),
    drive(a3 = ta3), drive(b3 = tb3), drive(c3 = tc3), drive(d3 = td3),
    frame(base4, position = [out * cos(3 * pi / 2), out * sin(3 * pi / 2), up], rotation = rotation_z(3 * pi / 2)),
    body(knuckle4, parent = base4, rotation = rotation_x(a4), mass = m, inertia = m * w * w),
    body(near4, parent = knuckle4, rotation = rotation_y(b4),
        mass = m, center_of_mass = [0, 0, -l1 / 2], inertia_about_center_of_mass = m * l1 * l1 / 12),
    body(mid4, parent = near4, position = [0, 0, -l1], rotation = rotation_y(c4),
        mass = m, center_of_mass = [0, 0, -l2 / 2], inertia_about_center_of_mass = m * l2 * l2 / 12),
    body(far4, parent = mid4, position = [0, 0, -l2], rotation = rotation_y(d4),
        mass = m, center_of_mass = [0, 0, -l3 / 2], inertia_about_center_of_mass = m * l3 * l3 / 12),
    point(tip4, body = far4, at = [0, 0, -l3]),
    contact(ring, point = tip4, radius = w, other = ball.position, other_radius = r,
        friction = mu, along = [0, 0, 1]),
    drive(a4 = ta4), drive(b4 = tb4), drive(c4 = tc4), drive(d4 = td4),
    frames(
        ball, near1, mid1, far1, near2, mid2, far2, near3, mid3, far3, near4, mid4, far4,
    ),
)]
pub struct Hand {
    /// kg: the ball, each link.
    pub heavy: f64,
    pub m: f64,
    /// m: radius of the ball and of the tips, links of a finger, and where fingers begin: away from the middle, above.
    pub r: f64,
    pub w: f64,
    pub l1: f64,
    pub l2: f64,
    pub l3: f64,
    pub out: f64,
    pub up: f64,
    pub mu: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// The length of a step, s.
pub const STEP: f64 = 5e-4;
/// N: with which each finger presses. N m/rad, N m s/rad: of the joints.
const GRIP: f64 = 2.0;
pub const GAINS: [f64; 2] = [0.5, 0.002];
/// rad: knuckle and the three joints that bend, of a finger that touches.
const BENT: [f64; 4] = [0.0, -0.35, 0.85, 0.7];

pub type Place = (Isometry3<f64>, SVector<f64, 16>);
pub type Speeds = SVector<f64, 22>;

impl Hand {
    /// Around a ball of 70 mm and 150 g, whose middle is the origin.
    #[must_use]
    pub fn around_a_ball(mu: f64) -> Self {
        let (r, w, [l1, l2, l3]) = (0.035, 0.008, [0.05, 0.03, 0.025]);
        let [inward, down] = reach([l1, l2, l3], 0);
        Self { heavy: 0.15, m: 0.02, r, w, l1, l2, l3, out: r + w + inward, up: down, mu, g: 9.81 }
    }

    /// What the joints do: they hold the fingers as they touch, and press.
    #[must_use]
    pub fn torques(&self, q: &Place, z: &Speeds) -> SVector<f64, 16> {
        let lengths = [self.l1, self.l2, self.l3];
        let pressing = |k: usize| if k == 0 { 0.0 } else { GRIP * reach(lengths, k - 1)[1] };
        SVector::from_fn(|n, _| {
            let k = n % 4;
            pressing(k) + GAINS[0] * (BENT[k] - q.1[n]) - GAINS[1] * z[6 + n]
        })
    }
}

/// How far inward of and below one of the joints that bend the tip of a finger is, m.
fn reach(lengths: [f64; 3], joint: usize) -> [f64; 2] {
    let mut angle = 0.0;
    let mut sum = [0.0; 2];
    for (k, length) in lengths.into_iter().enumerate() {
        angle += BENT[k + 1];
        if k >= joint {
            sum = [sum[0] + length * angle.sin(), sum[1] + length * angle.cos()];
        }
    }
    sum
}

/// Fingers as they touch, and the ball between them.
#[must_use]
pub fn start() -> (Place, Speeds) {
    ((Isometry3::identity(), SVector::from_fn(|n, _| BENT[n % 4])), Speeds::zeros())
}

/// A run of so many steps; `see` is shown the end of each.
///
/// # Errors
/// Where a step is one.
pub fn hold(
    hand: &Hand,
    kernel: &HandKernel,
    steps: usize,
    mut see: impl FnMut(&ContactStepper<'_, HandKernel>),
) -> Result<(), ContactError> {
    let (q, z) = start();
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z)?;
    for _ in 0..steps {
        stepper.step(STEP, &hand.torques(stepper.configuration(), stepper.speeds()))?;
        see(&stepper);
    }
    Ok(())
}
