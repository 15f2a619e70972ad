//! Scenes on which something acts derive wherever a struct can be written: without any prelude, among shadowed names,
//! behind aliases, inside macros, generic, with fields of any name, under the strictest lints.

#![deny(warnings, missing_docs)]

use gauss_runtime::prelude::{ForcedSystem, GaussSystem};

/// The clauses of a scene with everything on, for the struct that follows.
macro_rules! everything_on {
    ($(#[$attribute:meta])* $visibility:vis struct $($rest:tt)*) => {
        $(#[$attribute])*
        #[gauss(
            input(thrust, gust: Wrench),
            point(tip, body = body, at = at),
            define(u = body.relative_velocity),
            force(push, at = at, value = [thrust, clamp(u.x, -1, 1), signum(u.y)]),
            torque(turn, value = min(u.z, 1) * smooth_step(t, 0, 1) * at, axes = observer),
            wrench(blow, at = at, force = gust.force, torque = gust.torque),
            spring(from = [5, 5, 5], to = tip, stiffness = k, length = 1, damping = k),
            stop(along = body.position.z, least = -1, stiffness = k, width = 0.5, damping = k),
            drag(linear = d, quadratic = [k, k, k, k, k, k]),
            medium(velocity = [cos(t), k, k * t]),
            central_gravity(mu = k, center = [9, 9, 9]),
            potential = k * sin(body.position.x),
            damping = 0.5 * k * dot(body.velocity, body.velocity)
        )]
        $visibility struct $($rest)*
    };
}

/// No implicit prelude: not even `Option`, `Ok`, `Clone` or `Into` are in scope.
mod without_prelude {
    #![no_implicit_prelude]

    everything_on! {
        #[derive(::gauss_runtime::GaussDynamics)]
        #[gauss(chart = hybrid, linearize(parameters), regressor)]
        pub(super) struct Body<T> {
            #[gauss(mass)]
            pub(super) mass: T,
            #[gauss(inertia)]
            pub(super) inertia: T,
            pub(super) at: ::gauss_runtime::prelude::Vector3<T>,
            pub(super) d: ::gauss_runtime::prelude::Matrix6<T>,
            pub(super) k: T,
        }
    }
}

#[test]
fn no_prelude_is_needed() {
    use gauss_runtime::prelude::{Isometry3, Matrix6, SVector};
    let body =
        without_prelude::Body { mass: 1.0, inertia: 0.5, at: [0.1, 0.0, 0.0].into(), d: Matrix6::identity(), k: 1.0 };
    assert!(body.warnings().is_empty());
    let kernel = body.kernel().expect("a ball");
    let (q, z) = (Isometry3::identity(), SVector::from([0.5; 6]));
    assert!(kernel.powers(0.5, &q, &z, &SVector::from([1.0; 7])).amax() > 0.0);
    let body = without_prelude::Body {
        mass: 1.0_f32,
        inertia: 0.5,
        at: [0.1, 0.0, 0.0].into(),
        d: Matrix6::identity(),
        k: 1.0,
    };
    assert!(body.kernel().is_ok());
}

/// Everything that generated code could name carelessly means something else.
mod shadowed {
    #![allow(dead_code, non_camel_case_types)]

    use gauss_runtime::GaussDynamics;
    /// The real types under the names that the derive reads: the last segment decides.
    mod real {
        pub use ::core::primitive::f64;
        pub use gauss_runtime::prelude::{Matrix6, Vector3};
    }

    pub struct f64;
    pub struct f32;
    pub struct str;
    pub struct bool;
    pub struct usize;
    pub struct SVector;
    pub struct SMatrix;
    pub struct Option;
    pub struct Ok;
    pub struct Err;
    pub struct Some;
    pub struct None;
    pub struct Element;
    pub struct Smoothness;
    pub struct DragKind;
    pub struct WarningCheck;
    pub struct ParameterWarnings;
    pub trait Real {}
    pub trait GaussSystem {}
    pub trait ForcedSystem {}
    pub trait Columns {}
    pub trait Into {}
    pub mod core {}
    pub mod std {}
    pub mod forces {}
    pub mod error {}

    everything_on! {
        #[derive(GaussDynamics)]
        #[gauss(chart = jet(euler_zyx), linearize(parameters), regressor)]
        pub(super) struct Body {
            #[gauss(mass)]
            pub(super) mass: real::f64,
            #[gauss(inertia)]
            pub(super) inertia: real::Vector3<real::f64>,
            pub(super) at: real::Vector3<real::f64>,
            pub(super) d: real::Matrix6<real::f64>,
            pub(super) k: real::f64,
        }
    }
}

#[test]
fn names_may_be_shadowed() {
    let moments = [1.0, 1.5, 2.0].into();
    let d = gauss_runtime::prelude::Matrix6::identity();
    let body = shadowed::Body { mass: 1.0, inertia: moments, at: [0.1, 0.0, 0.0].into(), d, k: 1.0 };
    assert!(body.warnings().is_empty() && body.kernel().is_ok());
}

/// Names of fields, inputs, elements and definitions are the user's, also those that generated code uses inside, and
/// raw ones.
#[test]
fn anything_may_have_any_name() {
    use gauss_runtime::prelude::*;
    #[derive(GaussDynamics)]
    #[gauss(
        chart = left_invariant,
        motion = planar,
        linearize(parameters),
        regressor,
        input(z, r#loop: Vector3, powers),
        define(q = z * powers, p0 = 2 * q),
        force(r#match, at = self_, value = p0 * r#fn + r#loop),
        torque(input, value = [0, 0, c0]),
        drag(q0, linear = r#type)
    )]
    struct Odd {
        #[gauss(mass)]
        k0: f64,
        #[gauss(inertia)]
        kernel: f64,
        self_: Vector3<f64>,
        r#fn: Vector3<f64>,
        c0: f64,
        r#type: Vector6<f64>,
    }
    let odd = |entry: f64| Odd {
        k0: 2.0,
        kernel: 0.5,
        self_: Vector3::new(0.0, 0.25, 0.0),
        r#fn: Vector3::new(1.0, 0.0, 0.0),
        c0: 1.0,
        r#type: Vector6::from([entry; 6]),
    };
    let kernel = odd(0.0).kernel().expect("a ball");
    let (pose, still) = (Isometry2::identity(), SVector::from([0.0; 3]));
    // 2 · 3 · 0.5 and 1 along e₁ at 0.25 to the left of it: (4, 0) N and 1 − 1 N m.
    let input = SVector::from([3.0, 1.0, 0.0, 0.0, 0.5]);
    assert_eq!(kernel.acceleration(0.0, &pose, &still, &input), SVector::from([2.0, 0.0, 0.0]));
    let names: Vec<&str> = <OddKernel as ForcedSystem>::ELEMENTS.iter().map(|element| element.name).collect();
    assert_eq!(names, ["match", "input", "q0"]);
    let parameters = <OddKernel as ParametricSystem>::PARAMETERS;
    assert_eq!(parameters[..3], ["k0", "kernel", "self_[0]"]);
    assert_eq!(parameters[5..10], ["fn[0]", "fn[1]", "fn[2]", "c0", "type[0]"]);
    assert_eq!(<OddKernel as InertialRegressor>::INERTIAL_PARAMETERS, ["k0", "kernel"]);
    assert_eq!(odd(-1.0).warnings().as_slice()[0].field, "type");
}

/// A public struct, documented: nothing generated lacks a doc comment.
#[derive(gauss_runtime::GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    input(push),
    drive(x = push),
    spring(along = x, stiffness = k, damping = k)
)]
pub struct Documented {
    /// The mass.
    pub m: f64,
    /// The stiffness, and the damping.
    pub k: f64,
}

#[test]
fn documented_structs_pass_strict_lints() {
    let kernel: DocumentedKernel = Documented { m: 2.0, k: 1.0 }.kernel().expect("a mass");
    let one = gauss_runtime::prelude::SVector::from([1.0]);
    assert_eq!(kernel.acceleration(0.0, &one, &one, &one)[0], -0.5);
}
