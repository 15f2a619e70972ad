//! Three ellipses on hinges in a perfect fluid: the scene, and where it goes by hand.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

/// Semi-axes of each ellipse, and from its middle to a hinge.
pub const LONG: f64 = 1.0;
pub const SHORT: f64 = 0.1;
pub const REACH: f64 = 1.1;

/// E. Kanso, J. E. Marsden, C. W. Rowley and J. B. Melli-Huber, *Locomotion of articulated bodies in a perfect fluid*,
/// Journal of Nonlinear Science 15 (2005), section 5: neutrally buoyant ellipses, each with its own added mass (what
/// they do to one another through the water is left out), in the plane. The middle one moves freely; the others are
/// turned against it as functions of time.
///
/// Nothing acts. From rest the impulse of bodies and water stays zero, and the fish swims all the same.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    motion = planar,
    define(front = amplitude * sin(t), rear = amplitude * sin(t - lag)),
    frame(neck, parent = body, position = [reach, 0, 0], rotation = rotation_z(front)),
    body(
        head, parent = neck, position = [reach, 0, 0],
        mass = mass, inertia = moment, added_mass = [lengthwise, across, 0, 0, 0, turning],
    ),
    frame(waist, parent = body, position = [-reach, 0, 0], rotation = rotation_z(rear)),
    body(
        tail, parent = waist, position = [-reach, 0, 0],
        mass = mass, inertia = moment, added_mass = [lengthwise, across, 0, 0, 0, turning],
    ),
)]
pub struct Fish {
    /// Of each ellipse, per depth; its moment about the middle.
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub moment: f64,
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    /// Water carried along, along and across the long axis and in turning.
    pub lengthwise: f64,
    pub across: f64,
    pub turning: f64,
    pub reach: f64,
    /// How far the hinges turn, and how much later the rear one does.
    pub amplitude: f64,
    pub lag: f64,
}

impl Fish {
    /// Density 1. Added mass of an ellipse: ρπb², ρπa², ρπ(a² − b²)²/8 (H. Lamb, *Hydrodynamics*, section 71).
    pub fn new(amplitude: f64, lag: f64) -> Self {
        let (a, b) = (LONG, SHORT);
        let mass = PI * a * b;
        let (lengthwise, across, turning) = (PI * b * b, PI * a * a, PI * (a * a - b * b).powi(2) / 8.0);
        Self {
            mass,
            moment: mass * (a * a + b * b) / 4.0,
            added: Vector6::new(lengthwise, across, 0.0, 0.0, 0.0, turning),
            lengthwise,
            across,
            turning,
            reach: REACH,
            amplitude,
            lag,
        }
    }

    /// Angles of the hinges and their rates.
    pub fn shape(&self, t: f64) -> [(f64, f64); 2] {
        [t, t - self.lag].map(|phase| (self.amplitude * phase.sin(), self.amplitude * phase.cos()))
    }

    /// Poses of head, middle and tail.
    pub fn poses(&self, t: f64, middle: &Isometry2<f64>) -> [Isometry2<f64>; 3] {
        let [(front, _), (rear, _)] = self.shape(t);
        let hung = |side: f64, angle: f64| {
            let along = Vector3::new(side * self.reach, 0.0, 0.0).xy();
            let turn = UnitComplex::new(angle);
            middle * Isometry2::from_parts((along + turn * along).into(), turn)
        };
        [hung(1.0, front), *middle, hung(-1.0, rear)]
    }

    /// The twist of the middle that a change of shape asks for when the impulse of everything is zero: the kinematic
    /// connection of the paper, `−(Σ XᵀMX)⁻¹ Σ XᵀM S α̇`, with X from the twist of the middle to that of a body, both
    /// in their own axes.
    ///
    /// # Panics
    /// Never: the matrix is that of a kinetic energy.
    pub fn connection(&self, t: f64) -> Vector3<f64> {
        let matter = Matrix3::from_diagonal(&Vector3::new(
            self.mass + self.lengthwise,
            self.mass + self.across,
            self.moment + self.turning,
        ));
        let (mut locked, mut driven) = (matter, Vector3::zeros());
        for (side, (angle, rate)) in [1.0, -1.0].into_iter().zip(self.shape(t)) {
            let (sin, cos) = angle.sin_cos();
            // The middle of the body from the middle of the fish, axes of the middle; its velocity there, then in its
            // own axes.
            let place = Vector3::new(side * self.reach * (1.0 + cos), side * self.reach * sin, 0.0);
            let back = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
            let carried = back * Matrix3::new(1.0, 0.0, -place.y, 0.0, 1.0, place.x, 0.0, 0.0, 1.0);
            let own = Vector3::new(0.0, side * self.reach, 1.0) * rate;
            locked += carried.transpose() * matter * carried;
            driven += carried.transpose() * matter * own;
        }
        -locked.lu().solve(&driven).expect("bodies have mass")
    }

    /// Where the middle is at the end of a time, from the identity at t = 0: the connection integrated by the classical
    /// Runge–Kutta method.
    pub fn by_hand(&self, end: f64, steps: u32) -> Isometry2<f64> {
        let h = end / f64::from(steps);
        let mut state = Vector3::zeros();
        let rate = |t: f64, s: &Vector3<f64>| {
            let v = self.connection(t);
            let (sin, cos) = s.z.sin_cos();
            Vector3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z)
        };
        for n in 0..steps {
            let t = h * f64::from(n);
            let k1 = rate(t, &state);
            let k2 = rate(t + 0.5 * h, &(state + k1 * (0.5 * h)));
            let k3 = rate(t + 0.5 * h, &(state + k2 * (0.5 * h)));
            let k4 = rate(t + h, &(state + k3 * h));
            state += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
        Isometry2::from_parts(state.xy().into(), UnitComplex::new(state.z))
    }
}

/// The middle moves from the start as the connection says, so that the impulse is zero.
pub fn start(fish: &Fish) -> (Isometry2<f64>, SVector<f64, 3>) {
    (Isometry2::identity(), fish.connection(0.0))
}
