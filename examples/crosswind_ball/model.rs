//! A football in gusty air, and the same ball as a mass point by hand.

use gauss_runtime::prelude::*;

/// A spinning ball; k₁ along the kick, k₂ to the left, k₃ up.
///
/// Drag is quadratic in the whole velocity against the air, −c |v| v: for a sphere not component by component. The
/// Magnus force is l ω × v. The air also carries the weight of what the ball displaces, moves with the ball as added
/// mass, and pushes with its gradient of pressure where the wind freshens.
#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    define(v = body.relative_velocity),
    medium(velocity = wind * (1 + gustiness * sin(gust_rate * t))),
    force(drag, at = [0, 0, 0], value = -c * sqrt(dot(v, v)) * v),
    force(magnus, at = [0, 0, 0], value = l * cross(body.body_angular_velocity, v)),
)]
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// About any axis through the centre, kg m².
    #[gauss(inertia)]
    pub inertia: f64,
    /// m/s².
    #[gauss(gravity)]
    pub g: f64,
    /// Of the air around the ball, order (u, ω), kg and kg m².
    #[gauss(added_mass)]
    pub added_mass: Vector6<f64>,
    /// kg.
    #[gauss(displaced_mass)]
    pub displaced_mass: f64,
    /// ½ρ C_D A: drag over speed squared, kg/m.
    pub c: f64,
    /// ½ρ A r C_L/S with S = rω/v: Magnus force over ω v, kg.
    pub l: f64,
    /// Mean velocity of the wind, observer axes, m/s.
    pub wind: Vector3<f64>,
    /// How much the wind swells and abates, relative to its mean.
    pub gustiness: f64,
    /// How fast it does, rad/s.
    pub gust_rate: f64,
}

impl Ball {
    /// A football in the middle of what FIFA's Law 2 allows: 0.43 kg, 0.69 m around. C_D = 0.2 (J. E. Goff, M. J.
    /// Carré, Am. J. Phys. 77 (2009) 1020–1027, fitted to the range of a kick without spin), taken as the same at every
    /// speed. C_L = S is a round number chosen here, not a measurement. Air of 1.2 kg/m³. A thin shell has ⅔ m r²; the
    /// added mass of a sphere is half of what it displaces. Gusts of 30 %, every three seconds.
    pub fn football(wind: Vector3<f64>) -> Self {
        let (mass, air, radius) = (0.43, 1.2, 0.69 / std::f64::consts::TAU);
        let area = std::f64::consts::PI * radius * radius;
        let displaced_mass = air * 4.0 / 3.0 * area * radius;
        let half = 0.5 * displaced_mass;
        Self {
            mass,
            inertia: 2.0 / 3.0 * mass * radius * radius,
            g: 9.81,
            added_mass: Vector6::new(half, half, half, 0.0, 0.0, 0.0),
            displaced_mass,
            c: 0.5 * air * 0.2 * area,
            l: 0.5 * air * area * radius,
            wind,
            gustiness: 0.3,
            gust_rate: std::f64::consts::TAU / 3.0,
        }
    }

    /// Velocity and acceleration of the air, observer axes, m/s and m/s².
    pub fn air(&self, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (sin, cos) = (self.gust_rate * t).sin_cos();
        (self.wind * (1.0 + self.gustiness * sin), self.wind * (self.gustiness * self.gust_rate * cos))
    }

    /// Weight less buoyancy, N.
    pub fn heaviness(&self) -> f64 {
        (self.mass - self.displaced_mass) * self.g
    }

    /// Mass with the added one, kg.
    pub fn total_mass(&self) -> f64 {
        self.mass + self.added_mass[0]
    }

    /// The speed at which drag carries the ball, m/s.
    pub fn terminal_speed(&self) -> f64 {
        (self.heaviness() / self.c).sqrt()
    }
}

/// The acceleration of the mass point by hand, observer axes; ω is that of the ball, which nothing changes.
pub fn acceleration(ball: &Ball, t: f64, velocity: &Vector3<f64>, omega: &Vector3<f64>) -> Vector3<f64> {
    let (wind, freshening) = ball.air(t);
    let relative = velocity - wind;
    let drag = relative * (-ball.c * relative.norm());
    let magnus = omega.cross(&relative) * ball.l;
    // Buoyancy of an accelerating stream, and of the air that moves with the ball the part that came with the stream.
    let stream = freshening * (ball.displaced_mass + ball.added_mass[0]);
    (drag + magnus + stream - Vector3::z() * ball.heaviness()) / ball.total_mass()
}

/// Position and velocity of the mass point after each of `steps` classical Runge–Kutta steps of length `h`, from the
/// origin.
pub fn fly_by_hand(
    ball: &Ball,
    velocity: Vector3<f64>,
    omega: Vector3<f64>,
    h: f64,
    steps: usize,
) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let (mut x, mut v) = (Vector3::zeros(), velocity);
    let mut all = vec![(x, v)];
    for n in 0..steps {
        let t = n as f64 * h;
        let a1 = acceleration(ball, t, &v, &omega);
        let (v2, half) = (v + a1 * (0.5 * h), t + 0.5 * h);
        let a2 = acceleration(ball, half, &v2, &omega);
        let v3 = v + a2 * (0.5 * h);
        let a3 = acceleration(ball, half, &v3, &omega);
        let v4 = v + a3 * h;
        let a4 = acceleration(ball, t + h, &v4, &omega);
        x += (v + v2 * 2.0 + v3 * 2.0 + v4) * (h / 6.0);
        v += (a1 + a2 * 2.0 + a3 * 2.0 + a4) * (h / 6.0);
        all.push((x, v));
    }
    all
}

/// The flight from the origin, with a spin in observer axes, for so many seconds. Steps of at most 5 ms.
///
/// # Errors
/// When the run does not reach the end.
pub fn fly(
    kernel: &BallKernel,
    velocity: Vector3<f64>,
    omega: Vector3<f64>,
    seconds: f64,
) -> Result<Trajectory<'_, BallKernel>, IntegrationError> {
    // The hybrid chart takes ḃ and ω; at the start both axes are the same.
    let z = SVector::from([velocity.x, velocity.y, velocity.z, omega.x, omega.y, omega.z]);
    let run = Simulation::new(kernel).adaptive(1e-11, 1e-12).largest_step(5e-3);
    run.run(Isometry3::identity(), z, 0.0..seconds)
}
