//! Scenes in which something acts, stamped by chart and motion.
//!
//! | macro | stamps |
//! |---|---|
//! | `scene_of!` | a body with the given clauses |
//! | `all_on!` | a body on which everything acts that the language has a clause for |
//! | `the_four_charts!` | a scene in the charts that are compared |

use gauss_runtime::prelude::*;

use crate::common::body::Parts;
use crate::common::parameters::Parameters;

/// Values of all inputs of a scene.
pub trait Inputs<T>: Copy {
    /// From the first of some numbers.
    fn read(values: &[f64]) -> Self;
}

impl<T> Inputs<T> for () {
    fn read(_: &[f64]) {}
}

impl<T: Real, const N: usize> Inputs<T> for SVector<T, N> {
    fn read(values: &[f64]) -> Self {
        Self::from(std::array::from_fn(|i| T::from_f64(values[i])))
    }
}

/// A kernel of one body, whatever acts on it.
pub trait Body<T: Real>: RigidBodySystem<Scalar = T, Configuration: Parts<T>, Input: Inputs<T>> {}

impl<T: Real, K> Body<T> for K where K: RigidBodySystem<Scalar = T, Configuration: Parts<T>, Input: Inputs<T>> {}

/// A derived struct, generic over the scalar, on which something acts.
pub trait Scene {
    /// Its kernel.
    type Kernel<T: Real>: Body<T> + ForcedSystem;
    /// The kernel for given parameters.
    fn kernel<T: Real>(parameters: &Parameters, loads: &Loads<T>) -> Self::Kernel<T>;
}

/// Numbers for what acts: those of the random body under other names, so that every case has others.
#[derive(Clone, Copy, Debug)]
pub struct Loads<T> {
    /// A point of the body, body axes from O.
    pub at: Vector3<T>,
    /// A point of the observer's, farther from Ω than the body ever is.
    pub anchor: Vector3<T>,
    /// A force or a torque.
    pub pull: Vector3<T>,
    /// A velocity of the medium.
    pub stream: Vector3<T>,
    /// How fast that changes.
    pub surge: Vector3<T>,
    /// Linear drag: symmetric and positive, as it happens, and full.
    pub linear: Matrix6<T>,
    /// Quadratic drag.
    pub quadratic: Vector6<T>,
    /// A stiffness.
    pub stiff: T,
    /// A length.
    pub length: T,
    /// A damping.
    pub damped: T,
    /// A gravitational parameter.
    pub mu: T,
}

impl<T: Real> Loads<T> {
    /// For a random body.
    pub fn of(p: &Parameters) -> Self {
        let triple = |v: [f64; 3], scale: f64| Vector3::from(v.map(|x| T::from_f64(scale * x)));
        Self {
            at: triple(p.buoyancy, 1.5),
            anchor: triple([9.0, -8.0, 10.0], 1.0),
            pull: triple(p.field, 0.5),
            stream: triple(p.c, 2.0),
            surge: triple(p.field, 0.125),
            linear: p.fluid(),
            quadratic: p.diagonal_fluid(),
            stiff: T::from_f64(2.0 * p.m),
            length: T::from_f64(14.0 + p.g / 4.0),
            damped: T::from_f64(0.5 + p.displaced),
            mu: T::from_f64(40.0 * p.g),
        }
    }

    /// All that acts is zero; places are as they are.
    pub fn without_effect(&self) -> Self {
        let (none, zero) = (Vector3::from([T::zero(); 3]), T::zero());
        let (linear, quadratic) = (Matrix6::from([[zero; 6]; 6]), Vector6::from([zero; 6]));
        Self { pull: none, stream: none, surge: none, linear, quadratic, stiff: zero, damped: zero, mu: zero, ..*self }
    }
}

/// A body of a kind, and the given clauses; its name and that of its kernel first.
macro_rules! scene_of {
    // Everything that a body can have.
    ($name:ident $kernel:ident, wet, $clauses:tt) => {
        scene_of!(@ $name $kernel, $clauses, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia inertia: ::gauss_runtime::prelude::Matrix3<T>,
            added_mass fluid: ::gauss_runtime::prelude::Matrix6<T>,
            gravity field: ::gauss_runtime::prelude::Vector3<T>,
            displaced_mass displaced: T,
            center_of_buoyancy buoyancy: ::gauss_runtime::prelude::Vector3<T>
        });
    };
    // No fluid and no weight.
    ($name:ident $kernel:ident, dry, $clauses:tt) => {
        scene_of!(@ $name $kernel, $clauses, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia inertia: ::gauss_runtime::prelude::Matrix3<T>
        });
    };
    (@ $name:ident $kernel:ident, [$($clauses:tt)+], { $($role:ident $field:ident: $type:ty),+ }) => {
        #[derive(::gauss_runtime::GaussDynamics)]
        #[gauss($($clauses)+)]
        pub struct $name<T> {
            $(#[gauss($role)] $field: $type,)+
            at: ::gauss_runtime::prelude::Vector3<T>,
            anchor: ::gauss_runtime::prelude::Vector3<T>,
            pull: ::gauss_runtime::prelude::Vector3<T>,
            stream: ::gauss_runtime::prelude::Vector3<T>,
            surge: ::gauss_runtime::prelude::Vector3<T>,
            linear: ::gauss_runtime::prelude::Matrix6<T>,
            quadratic: ::gauss_runtime::prelude::Vector6<T>,
            stiff: T,
            length: T,
            damped: T,
            mu: T,
        }

        impl $name<()> {
            /// The kernel for given parameters.
            pub fn of<T: ::gauss_runtime::prelude::Real>(
                p: &$crate::common::parameters::Parameters,
                loads: &$crate::acting::scenes::Loads<T>,
            ) -> $kernel<T> {
                let $crate::acting::scenes::Loads {
                    at, anchor, pull, stream, surge, linear, quadratic, stiff, length, damped, mu,
                } = *loads;
                let scene = $name {
                    $($field: p.$field(),)+
                    at, anchor, pull, stream, surge, linear, quadratic, stiff, length, damped, mu,
                };
                scene.kernel().expect("random bodies are physical")
            }
        }
    };
}

/// A [`Scene`] of a chart.
macro_rules! in_chart {
    ($name:ident $kernel:ident, $motion:ident, $body:ident, [$($chart:tt)+], [$($clauses:tt)*]) => {
        scene_of!($name $kernel, $body, [chart = $($chart)+, motion = $motion, $($clauses)*]);

        impl $crate::acting::scenes::Scene for $name<()> {
            type Kernel<T: ::gauss_runtime::prelude::Real> = $kernel<T>;
            fn kernel<T: ::gauss_runtime::prelude::Real>(
                parameters: &$crate::common::parameters::Parameters,
                loads: &$crate::acting::scenes::Loads<T>,
            ) -> Self::Kernel<T> {
                $name::of(parameters, loads)
            }
        }
    };
}

/// The clauses in the four charts of a motion.
macro_rules! the_four_charts {
    (planar, $body:ident, $clauses:tt) => { the_four_charts!(@ planar, $body, (jet), $clauses); };
    ($motion:ident, $body:ident, $clauses:tt) => {
        the_four_charts!(@ $motion, $body, (jet(euler_zyx)), $clauses);
    };
    (@ $motion:ident, $body:ident, ($($jet:tt)+), $clauses:tt) => {
        in_chart!(Left LeftKernel, $motion, $body, [left_invariant], $clauses);
        in_chart!(Right RightKernel, $motion, $body, [right_invariant], $clauses);
        in_chart!(Hybrid HybridKernel, $motion, $body, [hybrid], $clauses);
        in_chart!(Jet JetKernel, $motion, $body, [$($jet)+], $clauses);
    };
}

/// Calls a macro with everything that can act, in brackets, after what is given.
macro_rules! all_on {
    ($macro:ident!, $($head:tt)*) => {
        $macro!($($head)*, [
            input(thrust, side: Vector3, gust: Wrench),
            point(tip, body = body, at = at),
            define(u = body.relative_velocity, w = body.body_angular_velocity),
            define(dynamic = 0.5 * dot(u, u)),
            force(push, body = body, at = at, value = pull),
            force(tug, body = body, at = at, value = pull + side, axes = observer),
            force(lift, body = body, at = at, value = damped * [thrust * w.z, dynamic * clamp(u.x, -1, 1), -u.x * u.z]),
            torque(turn, body = body, value = [min(w.x, u.y), signum(u.z) * damped, max(thrust, w.y)]),
            torque(steer, body = body, value = smooth_step(t, 0, 2) * pull, axes = observer),
            wrench(blow, body = body, at = at, force = gust.force, torque = gust.torque, axes = observer),
            wrench(jet, body = body, force = gust.torque, torque = thrust * gust.force),
            spring(cord, from = anchor, to = tip, stiffness = stiff, length = length, damping = damped),
            stop(fence, along = dot(tip, anchor), most = length, stiffness = 0.125, width = 3, damping = 0.0625),
            drag(water, body = body, linear = linear, quadratic = quadratic),
            medium(velocity = stream * cos(t) + surge * t),
            central_gravity(planet, mu = mu, center = -anchor),
            potential = stiff * sin(body.position.x - t) + dot(body.rotation * at, pull) * body.position.y,
            damping = 0.5 * damped * dot(body.velocity, body.velocity) + 0.25 * mu * (rate(tip.x)).powi(2)
        ]);
    };
}

pub mod free {
    //! O moves and turns freely.
    all_on!(the_four_charts!, free, wet);
}

pub mod fixed_point {
    //! O stays at Ω.
    all_on!(the_four_charts!, fixed_point, wet);
}

pub mod planar {
    //! In the plane k₁k₂.
    all_on!(the_four_charts!, planar, wet);
}

pub mod system {
    //! A pose as the coordinate of a system: the free motion, in the variables of the left-invariant chart.
    macro_rules! of_a_pose {
        (, [$($clauses:tt)+]) => {
            scene_of!(Posed PosedKernel, wet, [
                coordinates(pose: Pose),
                body(position = pose.position, rotation = pose.rotation),
                $($clauses)+
            ]);
        };
    }
    all_on!(of_a_pose!,);
}
