//! A disk that rolls on the plane z = 0 and falls. Its axis is e₃, O its centre; the contact is at ρ = −r (k₃ − (k₃·e₃)
//! e₃)/|…|.
//!
//! Euler angles: R = R_z(φ) R_x(θ) R_z(ψ), θ the angle between the axis and the vertical, w the angular velocity in the
//! axes of R_z(φ) R_x(θ), of which the second points from the contact to the centre.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least};
use gauss_tests::nonholonomic::{rigid_state, state_of_twist, twist};
use gauss_tests::trajectory::{Run, Seen};
use proptest::prelude::*;

/// Speeds that solve the rolling.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, phi, theta, psi),
    speeds(w1, w2, w3),
    kinematics(
        x = r * (w1 * sin(theta) * sin(phi) - w3 * cos(phi)),
        y = -r * (w1 * sin(theta) * cos(phi) + w3 * sin(phi)),
        phi = w2 / sin(theta),
        theta = w1,
        psi = w3 - w2 / tan(theta),
    ),
    body(position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi))
)]
pub struct OwnSpeeds {
    #[gauss(mass)]
    pub m: f64,
    #[gauss(inertia)]
    pub j: Vector3<f64>,
    pub r: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// The same without angles: ω in body axes, the contact from the vertical in body axes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(w: Vector3),
    kinematics(
        x = r * (attitude * cross(w, [(inverse(attitude) * [0, 0, 1]).x, (inverse(attitude) * [0, 0, 1]).y, 0])).x
            / sqrt(1 - (attitude * [0, 0, 1]).z.powi(2)),
        y = r * (attitude * cross(w, [(inverse(attitude) * [0, 0, 1]).x, (inverse(attitude) * [0, 0, 1]).y, 0])).y
            / sqrt(1 - (attitude * [0, 0, 1]).z.powi(2)),
        attitude = w,
    ),
    body(position = [x, y, r * sqrt(1 - (attitude * [0, 0, 1]).z.powi(2))], rotation = attitude)
)]
struct WithoutAngles {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The material point at the contact rests: three constraints on velocities, one of which happens to be integrable.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(disk, position = pose.position, rotation = pose.rotation),
    constraint(velocity = disk.velocity - cross(
        disk.angular_velocity,
        r * ([0, 0, 1] - (pose.rotation * [0, 0, 1]).z * (pose.rotation * [0, 0, 1]))
            / sqrt(1 - (pose.rotation * [0, 0, 1]).z.powi(2)),
    )),
)]
pub struct OnVelocities {
    #[gauss(body)]
    pub disk: RigidBody<f64>,
    pub r: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// The height as a constraint on positions, the rest on velocities.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(disk, position = pose.position, rotation = pose.rotation),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity,
        r * ([0, 0, 1] - (pose.rotation * [0, 0, 1]).z * (pose.rotation * [0, 0, 1]))
            / sqrt(1 - (pose.rotation * [0, 0, 1]).z.powi(2)),
    )).x),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity,
        r * ([0, 0, 1] - (pose.rotation * [0, 0, 1]).z * (pose.rotation * [0, 0, 1]))
            / sqrt(1 - (pose.rotation * [0, 0, 1]).z.powi(2)),
    )).y),
    constraint(position = disk.position.z - r * sqrt(1 - (pose.rotation * [0, 0, 1]).z.powi(2))),
)]
pub struct OnBoth {
    #[gauss(body)]
    pub disk: RigidBody<f64>,
    pub r: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// Euler angles and all three coordinates of the centre.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z, phi, theta, psi),
    body(disk, position = [x, y, z], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity, r * (rotation_z(phi) * [0, cos(theta), sin(theta)])
    )).x),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity, r * (rotation_z(phi) * [0, cos(theta), sin(theta)])
    )).y),
    constraint(position = z - r * sin(theta)),
)]
struct InAngles {
    #[gauss(body)]
    disk: RigidBody<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The rolling solved for the velocity of the centre by the derive.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, phi, theta, psi),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, phi = w2 / sin(theta), theta = w1, psi = w3 - w2 / tan(theta)),
    body(disk, position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity, r * (rotation_z(phi) * [0, cos(theta), sin(theta)])
    )).x),
    constraint(velocity = (disk.velocity - cross(
        disk.angular_velocity, r * (rotation_z(phi) * [0, cos(theta), sin(theta)])
    )).y),
    independent(w1, w2, w3),
)]
struct Eliminated {
    #[gauss(body)]
    disk: RigidBody<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

pub const MASS: f64 = 1.0;
pub const RADIUS: f64 = 0.5;
/// Across the axis.
pub const ACROSS: f64 = 0.0625;
/// About the axis.
pub const ALONG: f64 = 0.125;
pub const G: f64 = 9.81;

fn body() -> RigidBody<f64> {
    let inertia = Matrix3::from_diagonal(&Vector3::new(ACROSS, ACROSS, ALONG));
    RigidBody { mass: MASS, center_of_mass: Vector3::zeros(), inertia }
}

pub fn own_speeds() -> OwnSpeedsKernel {
    OwnSpeeds { m: MASS, j: Vector3::new(ACROSS, ACROSS, ALONG), r: RADIUS, g: G }.kernel().unwrap()
}

fn without_angles() -> WithoutAnglesKernel {
    WithoutAngles { m: MASS, j: Vector3::new(ACROSS, ACROSS, ALONG), r: RADIUS, g: G }.kernel().unwrap()
}

pub fn on_velocities() -> OnVelocitiesKernel {
    OnVelocities { disk: body(), r: RADIUS, g: G }.kernel().unwrap()
}

pub fn on_both() -> OnBothKernel {
    OnBoth { disk: body(), r: RADIUS, g: G }.kernel().unwrap()
}

fn in_angles() -> InAnglesKernel {
    InAngles { disk: body(), r: RADIUS, g: G }.kernel().unwrap()
}

fn eliminated() -> EliminatedKernel {
    Eliminated { disk: body(), r: RADIUS, g: G }.kernel().unwrap()
}

/// A state of rolling, from the coordinates and speeds of [`OwnSpeeds`], in all the others.
#[derive(Clone, Copy, Debug)]
pub struct Rolling {
    /// x, y, φ, θ, ψ.
    pub q: SVector<f64, 5>,
    /// w.
    pub w: Vector3<f64>,
}

impl Rolling {
    /// R_z(φ) R_x(θ).
    fn axes(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.q[2])
            * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.q[3])
    }

    fn spin(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.q[4])
    }

    fn height(&self) -> f64 {
        RADIUS * self.q[3].sin()
    }

    pub fn pose(&self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::new(self.q[0], self.q[1], self.height()), self.axes() * self.spin())
    }

    /// ḃ in observer's axes.
    fn velocity(&self) -> Vector3<f64> {
        self.axes() * self.w.cross(&Vector3::new(0.0, RADIUS, 0.0))
    }

    /// ω in body axes.
    fn omega(&self) -> Vector3<f64> {
        self.spin().inverse() * self.w
    }

    /// φ̇, θ̇, ψ̇.
    fn rates(&self) -> Vector3<f64> {
        let precession = self.w.y / self.q[3].sin();
        Vector3::new(precession, self.w.x, self.w.z - precession * self.q[3].cos())
    }

    /// (u, ω).
    pub fn twist(&self) -> SVector<f64, 6> {
        twist(&self.pose().rotation, self.velocity(), self.axes() * self.w)
    }

    /// The coordinates and speeds of [`WithoutAngles`].
    fn without_angles(&self) -> (Planar, Vector3<f64>) {
        ((self.pose().rotation, SVector::from([self.q[0], self.q[1]])), self.omega())
    }

    /// The coordinates and their rates of [`InAngles`].
    fn in_angles(&self) -> (SVector<f64, 6>, SVector<f64, 6>) {
        let [x, y, phi, theta, psi]: [f64; 5] = self.q.into();
        let (v, rates) = (self.velocity(), self.rates());
        let z = SVector::from([v.x, v.y, v.z, rates.x, rates.y, rates.z]);
        (SVector::from([x, y, self.height(), phi, theta, psi]), z)
    }

    fn observed(&self) -> Seen {
        rigid_state(&self.pose(), self.velocity(), self.omega())
    }
}

/// Where the reference starts.
pub fn start() -> Rolling {
    Rolling { q: SVector::from([0.0, 0.0, 0.0, 0.96_f64.atan2(0.28), 0.0]), w: Vector3::new(0.3, 0.5, -6.0) }
}

type Planar = (UnitQuaternion<f64>, SVector<f64, 2>);

/// The pose and ḃ of the coordinates and speeds of [`WithoutAngles`].
fn of_contact((rotation, b): &Planar, w: &Vector3<f64>) -> (Isometry3<f64>, Vector3<f64>) {
    let up = rotation.inverse() * Vector3::z();
    let to_centre = Vector3::new(up.x, up.y, 0.0);
    let pose = Isometry3::from_parts(Translation3::new(b[0], b[1], RADIUS * to_centre.norm()), *rotation);
    (pose, rotation * (w.cross(&to_centre.normalize()) * RADIUS))
}

#[test]
fn every_way_gives_the_reference() {
    let (name, state) = ("rolling_disk_falling", start());
    let of_own = |_: f64, q: &SVector<f64, 5>, w: &Vector3<f64>| Rolling { q: *q, w: *w }.observed();
    Run { name, system: &own_speeds(), start: (state.q, state.w) }.agrees(1.0, of_own);
    Run { name, system: &eliminated(), start: (state.q, state.w) }.agrees(1.0, of_own);
    let start = (state.pose(), state.twist());
    Run { name, system: &on_velocities(), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
    Run { name, system: &on_both(), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
    Run { name, system: &without_angles(), start: state.without_angles() }.agrees(1.0, |_, q, w| {
        let (pose, velocity) = of_contact(q, w);
        rigid_state(&pose, velocity, *w)
    });
    Run { name, system: &in_angles(), start: state.in_angles() }.agrees(1.0, |_, q, z| {
        let w = Vector3::new(z[4], z[3] * q[4].sin(), z[5] + z[3] * q[4].cos());
        let state = Rolling { q: SVector::from([q[0], q[1], q[3], q[4], q[5]]), w };
        let mut pose = state.pose();
        pose.translation.vector.z = q[2];
        rigid_state(&pose, Vector3::new(z[0], z[1], z[2]), state.omega())
    });
}

/// Any state of a disk that is far enough from lying flat, where ρ jumps, for central differences to resolve its
/// motion.
fn rolling() -> impl Strategy<Value = Rolling> {
    let angle = -3.0..3.0;
    let q = (-2.0..2.0, -2.0..2.0, angle.clone(), 0.7..2.4, angle);
    (q, prop::array::uniform3(-5.0..5.0)).prop_map(|((x, y, phi, theta, psi), w)| Rolling {
        q: SVector::from([x, y, phi, theta, psi]),
        w: Vector3::from(w),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn laws_in_every_way(state in rolling()) {
        let (q, w) = (state.q, state.w);
        let own = own_speeds();
        laws(&own, 0.0, &q, &w, Time::Absent);
        least(&own, 0.0, &q, &w);
        let solved = eliminated();
        laws(&solved, 0.0, &q, &w, Time::Absent);
        least(&solved, 0.0, &q, &w);
        corresponds(&own, &solved, 0.0, (&q, &w), |_, q, w| (*q, *w));

        let (planar, omega) = state.without_angles();
        let free = without_angles();
        laws(&free, 0.0, &planar, &omega, Time::Absent);
        least(&free, 0.0, &planar, &omega);
        corresponds(&own, &free, 0.0, (&q, &w), |_, q, w| Rolling { q: *q, w: *w }.without_angles());

        let (pose, twist) = (state.pose(), state.twist());
        let (velocities, both) = (on_velocities(), on_both());
        laws(&velocities, 0.0, &pose, &twist, Time::Absent);
        constrained_laws(&velocities, 0.0, &pose, &twist);
        laws(&both, 0.0, &pose, &twist, Time::Absent);
        constrained_laws(&both, 0.0, &pose, &twist);
        let map = |_: f64, q: &SVector<f64, 5>, w: &Vector3<f64>| {
            let state = Rolling { q: *q, w: *w };
            (state.pose(), state.twist())
        };
        corresponds(&own, &velocities, 0.0, (&q, &w), map);
        corresponds(&own, &both, 0.0, (&q, &w), map);

        let angles = in_angles();
        let (there, rates) = state.in_angles();
        laws(&angles, 0.0, &there, &rates, Time::Absent);
        constrained_laws(&angles, 0.0, &there, &rates);
        corresponds(&own, &angles, 0.0, (&q, &w), |_, q, w| Rolling { q: *q, w: *w }.in_angles());
    }

    #[test]
    fn the_ground_does_what_newton_and_euler_ask(state in rolling()) {
        let (pose, twist, omega) = (state.pose(), state.twist(), state.omega());
        let velocities = on_velocities();
        let rate = velocities.acceleration(0.0, &pose, &twist, &());
        let (u, u_rate) = (Vector3::new(twist[0], twist[1], twist[2]), Vector3::new(rate[0], rate[1], rate[2]));
        let omega_rate = Vector3::new(rate[3], rate[4], rate[5]);
        // Its force moves the centre, its moment about the centre turns the disk.
        let force = MASS * (pose.rotation * (u_rate + omega.cross(&u)) + Vector3::new(0.0, 0.0, G));
        let arm = state.axes() * Vector3::new(0.0, -RADIUS, 0.0);
        let inertia = Vector3::new(ACROSS, ACROSS, ALONG);
        let moment = inertia.component_mul(&omega_rate) + omega.cross(&inertia.component_mul(&omega));
        // Some hundred roundings of accelerations as large as |ω|² and what is divided by sin θ twice.
        let allowed = 1e3 * f64::EPSILON * rate.amax().max(twist.norm_squared()).max(G);
        prop_assert!((pose.rotation * moment - arm.cross(&force)).amax() <= allowed);

        let (q, z) = state.in_angles();
        for found in [
            velocities.multipliers(0.0, &pose, &twist, &()),
            on_both().multipliers(0.0, &pose, &twist, &()),
            in_angles().multipliers(0.0, &q, &z, &()),
        ] {
            prop_assert!((found - force).amax() <= allowed, "{found} {force}");
        }
        let found = eliminated().multipliers(0.0, &state.q, &state.w, &());
        prop_assert!((found - force.fixed_rows::<2>(0)).amax() <= allowed, "{found} {force}");
    }
}
