//! The bodies of the cases, and the reference solutions that they are measured by.

use std::collections::BTreeMap;
use std::error::Error;

use gauss_runtime::prelude::*;
use serde::Deserialize;

/// No forces, principal axes, turns about O.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, taylor)]
pub struct FreeTop {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
}

/// The same with speeds in the observer's axes: momentum form keeps the angular momentum bit by bit.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = right_invariant)]
pub struct FreeTopFromSpace {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
}

/// One body, one set of fields, several charts.
macro_rules! in_charts {
    ($fields:tt $($(#[$documentation:meta])* $name:ident [$($clause:tt)*])+) => {
        $(in_charts!(@ $fields $(#[$documentation])* $name [$($clause)*]);)+
    };
    (@ { $([$role:ident] $field:ident: ($($type:tt)*)),+ } $(#[$documentation:meta])* $name:ident [$($clause:tt)*]) => {
        $(#[$documentation])*
        #[derive(GaussDynamics)]
        #[gauss($($clause)*)]
        pub struct $name {
            $(#[gauss($role)] pub $field: $($type)*),+
        }
    };
}

in_charts! {
    {
        [mass] mass: (f64),
        [center_of_mass] center: (Vector3<f64>),
        [inertia] inertia: (Matrix3<f64>),
        [gravity] gravity: (f64)
    }
    /// A top under its weight.
    HeavyTop [motion = fixed_point, taylor]
    /// In the angles of precession, nutation and spin, which are one at the upright.
    TopByPrecession [motion = fixed_point, chart = jet(euler_zxz)]
    /// In yaw, pitch and roll.
    TopByYaw [motion = fixed_point, chart = jet(euler_zyx)]
    /// A body in free fall, O anywhere.
    Projectile [motion = free]
}

in_charts! {
    { [mass] mass: (f64), [center_of_mass] center: (Vector3<f64>), [inertia] inertia: (Matrix3<f64>) }
    /// A body that nothing acts on, velocities in its own axes.
    Drifting [motion = free]
    /// Pole Ω, observer's axes.
    DriftingFromSpace [motion = free, chart = right_invariant]
    /// ḃ and ω.
    DriftingHybrid [motion = free, chart = hybrid]
}

in_charts! {
    {
        [mass] mass: (f64), [center_of_mass] center: (Vector3<f64>),
        [inertia_about_center_of_mass] inertia: (Matrix3<f64>)
    }
    /// The same with its inertia about the centre of mass.
    Central [motion = free]
    /// ḃ and ω.
    CentralHybrid [motion = free, chart = hybrid]
}

in_charts! {
    { [mass] mass: (f64), [inertia] inertia: (Vector3<f64>), [added_mass] added: (Matrix6<f64>) }
    /// A body in an ideal fluid.
    Immersed [motion = free]
}

in_charts! {
    { [mass] mass: (f64), [inertia] inertia: (Vector3<f64>), [gravity] gravity: (f64) }
    /// A body in free fall, O its centre of mass.
    Falling [motion = free]
}

/// A ball that sinks in a thick liquid: `drag` in N·s/m, and N·m·s.
#[derive(GaussDynamics)]
#[gauss(linearize, drag(linear = drag))]
pub struct Sinking {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: f64,
    #[gauss(gravity)]
    pub g: f64,
    pub drag: Vector6<f64>,
}

/// A hoop that rolls: the example `rolling_disk`.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z, heading, lean, spin),
    body(hoop, position = [x, y, z], rotation = rotation_z(heading) * rotation_x(lean) * rotation_z(spin)),
    constraint(
        velocity = rate(x) * cos(heading) + rate(y) * sin(heading) + r * (rate(spin) + rate(heading) * cos(lean))
    ),
    constraint(velocity = rate(y) * cos(heading) - rate(x) * sin(heading) + r * sin(lean) * rate(lean)),
    constraint(position = z - r * sin(lean)),
)]
pub struct RollingDisk {
    #[gauss(body)]
    pub hoop: RigidBody<f64>,
    pub r: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// Pose and body twist.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct State {
    #[serde(rename = "R", deserialize_with = "rows")]
    pub rotation: Matrix3<f64>,
    #[serde(deserialize_with = "triple")]
    pub b: Vector3<f64>,
    #[serde(deserialize_with = "triple")]
    pub u: Vector3<f64>,
    #[serde(deserialize_with = "triple")]
    pub omega: Vector3<f64>,
}

/// A reference solution of `data/hard_cases.json`.
#[derive(Clone, Debug, Deserialize)]
pub struct Scene {
    pub mass: f64,
    #[serde(deserialize_with = "triple")]
    pub center: Vector3<f64>,
    #[serde(deserialize_with = "rows")]
    pub inertia: Matrix3<f64>,
    pub gravity: f64,
    #[serde(deserialize_with = "diagonal")]
    pub added_mass: Matrix6<f64>,
    pub duration: f64,
    /// What one rounding of the initial state does to the final one, relative.
    pub floor: f64,
    pub initial: State,
    #[serde(rename = "final")]
    pub last: State,
}

fn triple<'d, D: serde::Deserializer<'d>>(from: D) -> Result<Vector3<f64>, D::Error> {
    <[f64; 3]>::deserialize(from).map(Vector3::from)
}

fn rows<'d, D: serde::Deserializer<'d>>(from: D) -> Result<Matrix3<f64>, D::Error> {
    <[[f64; 3]; 3]>::deserialize(from).map(|rows| Matrix3::from(rows).transpose())
}

fn diagonal<'d, D: serde::Deserializer<'d>>(from: D) -> Result<Matrix6<f64>, D::Error> {
    <[f64; 6]>::deserialize(from).map(|entries| Matrix6::from_diagonal(&Vector6::from(entries)))
}

#[derive(Deserialize)]
struct File {
    scenes: BTreeMap<String, Scene>,
}

impl Scene {
    /// The scene of this name.
    pub fn load(name: &str) -> Result<Self, Box<dyn Error>> {
        let mut file: File = serde_json::from_str(include_str!("../../data/hard_cases.json"))?;
        file.scenes.remove(name).ok_or_else(|| format!("no scene {name}").into())
    }

    /// The scene of a top: O counts as Ω.
    pub fn top(name: &str) -> Result<Self, Box<dyn Error>> {
        let mut scene = Self::load(name)?;
        (scene.initial.b, scene.last.b) = (Vector3::zeros(), Vector3::zeros());
        Ok(scene)
    }

    /// The top of the scene under its weight.
    pub fn heavy_top(&self) -> HeavyTop {
        HeavyTop { mass: self.mass, center: self.center, inertia: self.inertia, gravity: self.gravity }
    }

    /// The top of the scene without.
    pub fn free_top(&self) -> FreeTop {
        FreeTop { mass: self.mass, inertia: self.inertia.diagonal() }
    }
}

impl State {
    /// (R, b).
    pub fn pose(&self) -> Isometry3<f64> {
        Isometry3 { rotation: quaternion(&self.rotation), translation: Translation3::from(self.b) }
    }

    /// (u, ω).
    pub fn twist(&self) -> Vector6<f64> {
        Vector6::from_fn(|i, _| if i < 3 { self.u[i] } else { self.omega[i - 3] })
    }

    /// What a kernel says of its body.
    pub fn of<S: RigidBodySystem<Scalar = f64>>(kernel: &S, q: &S::Configuration, z: &S::Speeds) -> Self {
        let (pose, twist) = (kernel.pose(0.0, q), kernel.body_twist(0.0, q, z));
        Self {
            rotation: pose.rotation.to_rotation_matrix().into_inner(),
            b: pose.translation.vector,
            u: Vector3::new(twist[0], twist[1], twist[2]),
            omega: Vector3::new(twist[3], twist[4], twist[5]),
        }
    }

    /// The largest error of an entry of R, and of b, u, ω relative to their size or 1.
    pub fn distance(&self, truth: &Self) -> f64 {
        let relative = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).amax() / b.amax().max(1.0);
        let errors = [
            (self.rotation - truth.rotation).amax(),
            relative(&self.b, &truth.b),
            relative(&self.u, &truth.u),
            relative(&self.omega, &truth.omega),
        ];
        // Written so that a NaN wins.
        errors.into_iter().fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
    }
}

/// The unit quaternion of a rotation matrix, by the largest of its components (Shepperd 1978).
pub fn quaternion(r: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let trace = r.trace();
    let squares = [0, 1, 2, 3].map(|i| if i < 3 { 1.0 - trace + 2.0 * r[(i, i)] } else { 1.0 + trace });
    let largest = (0..4).fold(3, |best, i| if squares[i] > squares[best] { i } else { best });
    let mut q = Quaternion::from([0.0; 4]);
    for i in 0..4 {
        q.coords[i] = match (i, largest) {
            _ if i == largest => squares[i],
            (3, axis) | (axis, 3) => r[((axis + 2) % 3, (axis + 1) % 3)] - r[((axis + 1) % 3, (axis + 2) % 3)],
            (a, b) => r[(a, b)] + r[(b, a)],
        };
    }
    UnitQuaternion::new_normalize(q)
}
