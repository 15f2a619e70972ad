//! States carried between hand-made kernels of several charts and motions, which know kinematics only.

use nalgebra::{Isometry2, Isometry3, SMatrix, SVector, UnitQuaternion};

use crate::chart::{Chart, ChartError, MotionRule, convert};
use crate::configuration::Configuration;
use crate::lie::{se3, so3};
use crate::monitor::BodyMonitor;
use crate::private;
use crate::system::{GaussSystem, RigidBodySystem};

type V3 = SVector<f64, 3>;
type V6 = SVector<f64, 6>;

/// A body of unit mass and unit inertia whose dynamics nobody asks for.
macro_rules! kinematic_body {
    ($name:ident: $chart:expr, $configuration:ty, $dof:literal;
     $pose:expr; $configuration_of:expr; $twist:expr; $speeds:expr) => {
        struct $name;

        impl GaussSystem for $name {
            type Scalar = f64;
            type Configuration = $configuration;
            type Speeds = SVector<f64, $dof>;
            type MassMatrix = SMatrix<f64, $dof, $dof>;
            type Input = ();
            const DOF: usize = $dof;
            const CHART: Chart = $chart;

            fn kinematics(
                &self,
                _: f64,
                _: &$configuration,
                _: &Self::Speeds,
            ) -> <$configuration as Configuration>::Tangent {
                unreachable!()
            }
            fn acceleration(&self, _: f64, _: &$configuration, _: &Self::Speeds, (): &()) -> Self::Speeds {
                unreachable!()
            }
            fn momentum(&self, _: f64, _: &$configuration, _: &Self::Speeds) -> Self::Speeds {
                unreachable!()
            }
            fn velocity(&self, _: f64, _: &$configuration, _: &Self::Speeds) -> Self::Speeds {
                unreachable!()
            }
            fn momentum_rate(&self, _: f64, _: &$configuration, _: &Self::Speeds, (): &()) -> Self::Speeds {
                unreachable!()
            }
            fn mass_matrix(&self, _: f64, _: &$configuration) -> Self::MassMatrix {
                unreachable!()
            }
            fn kinetic_energy(&self, t: f64, q: &$configuration, z: &Self::Speeds) -> f64 {
                0.5 * self.body_twist(t, q, z).norm_squared()
            }
            fn potential_energy(&self, _: f64, _: &$configuration) -> f64 {
                0.0
            }
            fn gauss_residual(
                &self,
                _: f64,
                _: &$configuration,
                _: &Self::Speeds,
                _: &Self::Speeds,
                (): &(),
            ) -> Self::Speeds {
                unreachable!()
            }
            fn constraint_function(
                &self,
                _: f64,
                _: &$configuration,
                _: &Self::Speeds,
                _: &Self::Speeds,
                (): &(),
            ) -> f64 {
                unreachable!()
            }
        }

        impl RigidBodySystem for $name {
            fn pose(&self, _: f64, q: &$configuration) -> Isometry3<f64> {
                $pose(q)
            }
            fn body_twist(&self, _: f64, q: &$configuration, z: &Self::Speeds) -> V6 {
                $twist(q, z)
            }
            fn speeds(&self, _: f64, q: &$configuration, twist: &V6) -> Self::Speeds {
                $speeds(q, twist)
            }
            fn body_momentum(&self, t: f64, q: &$configuration, z: &Self::Speeds) -> V6 {
                self.body_twist(t, q, z)
            }
            fn configuration_at(&self, _: f64, pose: &Isometry3<f64>) -> Result<$configuration, ChartError> {
                $configuration_of(pose)
            }
        }
    };
}

kinematic_body!(Left: Chart::LeftInvariant, Isometry3<f64>, 6;
    |q: &Isometry3<f64>| *q;
    |pose: &Isometry3<f64>| Ok(*pose);
    |_: &Isometry3<f64>, z: &V6| *z;
    |_: &Isometry3<f64>, twist: &V6| *twist);

// ξ̂ = R u + b × ω̂: the adjoint action.
kinematic_body!(Right: Chart::RightInvariant, Isometry3<f64>, 6;
    |q: &Isometry3<f64>| *q;
    |pose: &Isometry3<f64>| Ok(*pose);
    |q: &Isometry3<f64>, z: &V6| se3::adjoint(&q.inverse(), z);
    |q: &Isometry3<f64>, twist: &V6| se3::adjoint(q, twist));

kinematic_body!(Pivot: Chart::LeftInvariant, UnitQuaternion<f64>, 3;
    private::pose_of_rotation;
    private::rotation_of_pose;
    |_: &UnitQuaternion<f64>, z: &V3| V6::from([0.0, 0.0, 0.0, z[0], z[1], z[2]]);
    |_: &UnitQuaternion<f64>, twist: &V6| V3::from([twist[3], twist[4], twist[5]]));

kinematic_body!(Plane: Chart::LeftInvariant, Isometry2<f64>, 3;
    private::pose_of_plane;
    private::plane_of_pose;
    |_: &Isometry2<f64>, z: &V3| V6::from([z[0], z[1], 0.0, 0.0, 0.0, z[2]]);
    |_: &Isometry2<f64>, twist: &V6| V3::from([twist[0], twist[1], twist[5]]));

fn pose(b: [f64; 3]) -> Isometry3<f64> {
    let q = so3::exp(&SVector::from([0.4, -1.1, 0.8]));
    private::pose_from_quaternion(private::quaternion(&q), b)
}

#[test]
fn charts_of_the_free_motion_there_and_back() {
    // Also far from Ω, where the right-invariant speeds are large.
    for far in [0.0, 1.0, 1e6] {
        let q = pose([far, -2.0 * far, 0.3]);
        let z = V6::from([0.1, -0.2, 0.3, 1.0, 2.0, -0.5]);
        let (q1, z1) = convert(&Left, &q, &z, &Right).expect("same motion");
        let (q2, z2) = convert(&Right, &q1, &z1, &Left).expect("same motion");
        assert_eq!(q2, q);
        assert!((z2 - z).amax() < 1e-14 * (1.0 + far), "{far}: {z2}");
        // What does not depend on the chart.
        // The momentum about Ω has b × Q̂ in it: the error in u times |b|.
        let error = Left.space_momentum(0.0, &q, &z) - Right.space_momentum(0.0, &q1, &z1);
        assert!(error.amax() < 1e-14 * (1.0 + far) * (1.0 + far));
    }
}

#[test]
fn motions_that_contain_one_another() {
    let z = V3::from([0.3, -0.1, 0.7]);
    let rotation = pose([0.0; 3]).rotation;
    let (q1, z1) = convert(&Pivot, &rotation, &z, &Right).expect("a free body can turn about a point");
    assert_eq!(convert(&Right, &q1, &z1, &Pivot).map(|(q, _)| q), Ok(rotation));

    let plane = Isometry2::new(nalgebra::Vector2::new(0.5, 2.0), 2.5);
    let (q1, z1) = convert(&Plane, &plane, &z, &Left).expect("a free body can move in a plane");
    let (q2, z2) = convert(&Left, &q1, &z1, &Plane).expect("in the plane still");
    assert!(Configuration::difference(&q2, &plane).amax() < 1e-15 && (z2 - z).amax() < 1e-16);
}

#[test]
fn what_a_motion_cannot_have_is_named() {
    let spin = V6::from([0.0, 0.0, 0.0, 0.3, 0.2, 0.1]);
    assert_eq!(
        convert(&Left, &pose([0.0, 0.5, 0.0]), &spin, &Pivot),
        Err(ChartError::Inexpressible { rule: MotionRule::FixedPoint { axis: 1 }, value: 0.5 })
    );
    let mut sliding = spin;
    sliding[2] = 1e-6;
    assert_eq!(
        convert(&Left, &pose([0.0; 3]), &sliding, &Pivot),
        Err(ChartError::Inexpressible { rule: MotionRule::Twist { index: 2 }, value: 1e-6 })
    );
    // Rounding is forgiven.
    sliding[2] = 1e-16;
    assert!(convert(&Left, &pose([0.0; 3]), &sliding, &Pivot).is_ok());

    assert!(matches!(
        convert(&Left, &pose([0.0; 3]), &spin, &Plane),
        Err(ChartError::Inexpressible { rule: MotionRule::Upright, .. })
    ));
    let level = Isometry3::translation(1.0, 2.0, 0.0);
    assert_eq!(
        convert(&Left, &level, &spin, &Plane),
        Err(ChartError::Inexpressible { rule: MotionRule::Twist { index: 3 }, value: 0.3 })
    );
    let bad = V6::from([0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(convert(&Left, &level, &bad, &Right).map(|(q, _)| q), Err(ChartError::NonFinite));
}

#[test]
fn the_momentum_in_space_is_watched() {
    // Unit mass at O moving uniformly: u turns against the body, b moves, (Q̂, Γ̂_Ω) stay.
    let mut monitor = BodyMonitor::new();
    let velocity = V3::from([0.2, -0.1, 0.4]);
    let omega = V3::from([0.0, 0.0, 1.5]);
    for n in 0..20 {
        let t = 0.1 * f64::from(n);
        let rotation = so3::exp(&(omega * t));
        let b = velocity * t;
        let q = private::pose_from_quaternion(private::quaternion(&rotation), [b[0], b[1], b[2]]);
        let u = rotation.inverse() * velocity;
        let z = V6::from([u[0], u[1], u[2], omega[0], omega[1], omega[2]]);
        monitor.watch(&Left, &crate::integrate::Sample { t, q, z, p: z });
    }
    assert!(monitor.energy.largest() < 1e-15);
    assert!(monitor.linear_momentum.largest() < 1e-15 && monitor.angular_momentum.largest() < 1e-15);
    assert!(monitor.linear_momentum.slope() < 1e-15);
}
