//! The scenes of the benchmarks, as a user writes them.
//!
//! S1–S6 are small enough to be written by hand well; S7 is the arm of the public description of the Franka Emika
//! Panda. SI units, angles in radians; gravity is 9.81 m/s² along −k₃.

use gauss_runtime::prelude::*;
use serde_json::Value;

/// m/s².
pub const G: f64 = 9.81;

/// S1. A free body about its centre of mass, in principal axes.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct FreeBody {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

/// S2. A body whose O is not its centre of mass, with weight.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct HeavyBody {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Matrix3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// S3. A body in fluid: all 21 moments, weight and buoyancy at different points.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct Immersed {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Matrix6<f64>,
    #[gauss(gravity)]
    g: f64,
    #[gauss(displaced_mass)]
    displaced: f64,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<f64>,
}

/// S4. A heavy top with three different moments, in Euler angles; its centre of mass is on the third axis.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = jet(euler_zxz), motion = fixed_point, center_of_mass = [0, 0, distance])]
pub struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    distance: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The two double pendulums: the centres of mass are on the lines of the links.
macro_rules! pendulum {
    ($(#[$documentation:meta])* $name:ident [$coordinates:meta, $lower:ident: $($place:tt)+]) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, GaussDynamics)]
        #[gauss(
            $coordinates,
            body(
                upper, rotation = rotation_y(-a),
                mass = m1, center_of_mass = [0, 0, -c1], inertia_about_center_of_mass = i1
            ),
            body(
                $lower, $($place)+,
                mass = m2, center_of_mass = [0, 0, -c2], inertia_about_center_of_mass = i2
            ),
        )]
        pub struct $name {
            m1: f64,
            c1: f64,
            i1: f64,
            m2: f64,
            c2: f64,
            i2: f64,
            length: f64,
            #[gauss(gravity)]
            g: f64,
        }

        impl $name {
            fn new() -> Self {
                let ((m1, c1, i1), (m2, c2, i2)) = (numbers::UPPER, numbers::LOWER);
                Self { m1, c1, i1, m2, c2, i2, length: numbers::LENGTH, g: G }
            }
        }
    };
}

pendulum!(
    /// S5. A double pendulum in the plane, angles from the vertical.
    DoublePendulum [
        coordinates(a, b),
        lower: position = [length * sin(a), 0, -length * cos(a)], rotation = rotation_y(-b)
    ]
);

pendulum!(
    /// S5′. The same with the angle of the joint.
    JointedPendulum [
        coordinates(a, c),
        lower: parent = upper, position = [0, 0, -length], rotation = rotation_y(-c)
    ]
);

/// S6. A cart and a pole; the angle is zero where the pole stands upright.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    body(
        pole, position = [x, 0, 0], rotation = rotation_y(theta),
        mass = m, center_of_mass = [0, 0, distance], inertia_about_center_of_mass = moment
    ),
)]
pub struct CartPole {
    cart: f64,
    m: f64,
    /// About the centre of mass.
    moment: f64,
    distance: f64,
    #[gauss(gravity)]
    g: f64,
}

/// S7. An arm of seven joints in the frames of its description: every joint turns about the third axis of its link.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(q1, q2, q3, q4, q5, q6, q7),
    body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1)),
    body(b2, parent = b1, rotation = rotation_x(-1.5707963267948966) * rotation_z(q2)),
    body(b3, parent = b2, position = [0, -0.316, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q3)),
    body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q4)),
    body(b5, parent = b4, position = [-0.0825, 0.384, 0], rotation = rotation_x(-1.5707963267948966) * rotation_z(q5)),
    body(b6, parent = b5, rotation = rotation_x(1.5707963267948966) * rotation_z(q6)),
    body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q7))
)]
pub struct Arm {
    #[gauss(body)]
    b1: RigidBody<f64>,
    #[gauss(body)]
    b2: RigidBody<f64>,
    #[gauss(body)]
    b3: RigidBody<f64>,
    #[gauss(body)]
    b4: RigidBody<f64>,
    #[gauss(body)]
    b5: RigidBody<f64>,
    #[gauss(body)]
    b6: RigidBody<f64>,
    #[gauss(body)]
    b7: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// I_O of a body with the inertia tensor `inertia` about its centre of mass `c`, from O (Steiner).
pub fn about_pole(mass: f64, c: Vector3<f64>, inertia: Matrix3<f64>) -> Matrix3<f64> {
    inertia + (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * mass
}

/// The same of S1 to S6 for those who write equations themselves.
pub mod numbers {
    use super::{Matrix3, Matrix6, Vector3, about_pole};

    /// S1: mass and principal moments about the centre of mass.
    pub const FREE_BODY: (f64, [f64; 3]) = (2.0, [1.0, 2.0, 3.0]);

    /// S2: mass, centre of mass from O, inertia about the centre of mass.
    pub fn heavy_body() -> (f64, Vector3<f64>, Matrix3<f64>) {
        let inertia = Matrix3::new(1.0, 0.1, -0.05, 0.1, 2.0, 0.2, -0.05, 0.2, 2.5);
        (2.0, Vector3::new(0.1, -0.05, 0.2), inertia)
    }

    /// S3: the kinetic matrix of body and fluid, order (u, ω), pole O, body axes.
    pub const KINETIC: [[f64; 6]; 6] = [
        [
            42.24162348661463,
            0.5976659860336111,
            -2.845280284892573,
            3.0025595677435652,
            -2.8122464340075446,
            -4.174242291831991,
        ],
        [
            0.5976659860336111,
            72.29029379834085,
            0.28476662138065134,
            0.9589266122064827,
            0.590031205915479,
            -1.5786570258946877,
        ],
        [
            -2.845280284892573,
            0.28476662138065134,
            72.4941377769405,
            0.41149843670847913,
            3.8614973879639765,
            -0.28280801774165837,
        ],
        [
            3.0025595677435652,
            0.9589266122064827,
            0.41149843670847913,
            8.895293902831202,
            6.451810513972074,
            -0.9192485706464316,
        ],
        [
            -2.8122464340075446,
            0.590031205915479,
            3.8614973879639765,
            6.451810513972074,
            31.455870421332268,
            -8.280730016520312,
        ],
        [
            -4.174242291831991,
            -1.5786570258946877,
            -0.28280801774165837,
            -0.9192485706464316,
            -8.280730016520312,
            30.793420703845005,
        ],
    ];

    /// S3: weight and buoyancy, N, and where they act, from O.
    pub const WEIGHT: (f64, [f64; 3]) = (294.3, [0.01, 0.0, 0.02]);
    /// See [`WEIGHT`].
    pub const BUOYANCY: (f64, [f64; 3]) = (297.243, [0.02, 0.0, -0.03]);

    /// S3: the share of the fluid, for a body of the given mass data (principal moments about O).
    pub fn added_mass(mass: f64, c: Vector3<f64>, inertia: Vector3<f64>) -> Matrix6<f64> {
        let moment = c.cross_matrix() * mass;
        let mut body = Matrix6::zeros();
        body.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * mass));
        body.fixed_view_mut::<3, 3>(0, 3).copy_from(&-moment);
        body.fixed_view_mut::<3, 3>(3, 0).copy_from(&moment);
        body.fixed_view_mut::<3, 3>(3, 3).copy_from(&Matrix3::from_diagonal(&inertia));
        Matrix6::from_fn(|i, j| KINETIC[i][j]) - body
    }

    /// S4: mass, distance of the centre of mass from O along e₃, principal moments about O.
    pub fn top() -> (f64, f64, Vector3<f64>) {
        let (mass, c) = (1.0, Vector3::new(0.0, 0.0, 0.5));
        let inertia = about_pole(mass, c, Matrix3::from_diagonal(&Vector3::new(0.75, 0.95, 0.3)));
        (mass, c.z, inertia.diagonal())
    }

    /// A link of S5 and S6: mass, distance of the centre of mass from the hinge, moment about the centre of mass.
    pub type Link = (f64, f64, f64);

    /// S5: the upper link is one metre long.
    pub const UPPER: Link = (1.0, 0.5, 1.0 / 12.0);
    /// See [`UPPER`].
    pub const LENGTH: f64 = 1.0;
    /// S5.
    pub const LOWER: Link = (0.8, 0.4, 0.05);

    /// S6: mass of the cart, kg.
    pub const CART: f64 = 1.0;
    /// S6.
    pub const POLE: Link = (0.3, 0.5, 0.025);
}

/// S1.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn free_body() -> Result<FreeBodyKernel, ParameterError> {
    let (mass, inertia) = numbers::FREE_BODY;
    FreeBody { mass, inertia: inertia.into() }.kernel()
}

/// S2.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn heavy_body() -> Result<HeavyBodyKernel, ParameterError> {
    let (mass, center, inertia) = numbers::heavy_body();
    HeavyBody { mass, center, inertia: about_pole(mass, center, inertia), g: G }.kernel()
}

/// S3.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn immersed() -> Result<ImmersedKernel, ParameterError> {
    let ((weight, center), (buoyancy, point)) = (numbers::WEIGHT, numbers::BUOYANCY);
    let (mass, center, inertia) = (weight / G, Vector3::from(center), Vector3::new(1.0, 3.0, 3.0));
    let added = numbers::added_mass(mass, center, inertia);
    Immersed { mass, center, inertia, added, g: G, displaced: buoyancy / G, buoyancy: point.into() }.kernel()
}

/// S4.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn top() -> Result<TopKernel, ParameterError> {
    let (mass, distance, inertia) = numbers::top();
    Top { mass, inertia, distance, g: G }.kernel()
}

/// S5.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn double_pendulum() -> Result<DoublePendulumKernel, ParameterError> {
    DoublePendulum::new().kernel()
}

/// S5′.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn jointed_pendulum() -> Result<JointedPendulumKernel, ParameterError> {
    JointedPendulum::new().kernel()
}

/// S6.
///
/// # Errors
/// Never, for the parameters of the scenes.
pub fn cart_pole() -> Result<CartPoleKernel, ParameterError> {
    let (m, distance, moment) = numbers::POLE;
    CartPole { cart: numbers::CART, m, moment, distance, g: G }.kernel()
}

/// S7, from the description.
///
/// # Errors
/// When the description lacks a number, or a link of it is none that a body has.
pub fn arm() -> Result<ArmKernel, Box<dyn std::error::Error>> {
    let chain: Value = serde_json::from_str(include_str!("../../tests/data/panda_chain.json"))?;
    let number = |value: &Value| value.as_f64().ok_or("a number is missing in the description of the arm");
    let link = |k: usize| -> Result<RigidBody<f64>, &str> {
        let described = &chain["links"][k];
        let (mass, c, moments) =
            (number(&described["mass"])?, &described["center_of_mass"], &described["inertia_about_center_of_mass"]);
        let c = Vector3::new(number(&c[0])?, number(&c[1])?, number(&c[2])?);
        let [xx, xy, xz] = ["ixx", "ixy", "ixz"].map(|name| number(&moments[name]));
        let [yy, yz, zz] = ["iyy", "iyz", "izz"].map(|name| number(&moments[name]));
        let inertia = Matrix3::new(xx?, xy?, xz?, xy?, yy?, yz?, xz?, yz?, zz?);
        Ok(RigidBody { mass, center_of_mass: c, inertia: about_pole(mass, c, inertia) })
    };
    let arm =
        Arm { b1: link(0)?, b2: link(1)?, b3: link(2)?, b4: link(3)?, b5: link(4)?, b6: link(5)?, b7: link(6)?, g: G };
    Ok(arm.kernel()?)
}
