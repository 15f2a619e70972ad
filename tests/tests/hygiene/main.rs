//! The derive works wherever a struct can be written: renamed runtime, no prelude, shadowed names, inside functions,
//! generic, behind aliases, under the strictest lints.

#![deny(warnings, missing_docs)]

pub mod forces;

use gauss_runtime::prelude::{GaussSystem, RigidBodySystem};

/// The runtime under another name, reached through a path of the user's.
pub mod vendored {
    pub use gauss_runtime as dynamics;
}

/// `crate = path`.
mod renamed {
    use super::vendored::dynamics as engine;

    #[derive(engine::GaussDynamics)]
    #[gauss(crate = super::vendored::dynamics, chart = hybrid)]
    pub(super) struct Body {
        #[gauss(mass)]
        pub(super) mass: f64,
        #[gauss(inertia)]
        pub(super) inertia: engine::prelude::Vector3<f64>,
    }

    /// The name `gauss_runtime` means something else here.
    pub(super) mod gauss_runtime {
        #[derive(super::engine::GaussDynamics)]
        #[gauss(crate = crate::vendored::dynamics, motion = fixed_point, chart = jet(euler_zxz))]
        pub struct Top {
            #[gauss(mass)]
            pub mass: f64,
            #[gauss(inertia)]
            pub inertia: f64,
        }
    }
}

#[test]
fn the_runtime_may_have_another_name() {
    let body = renamed::Body { mass: 1.0, inertia: [1.0, 2.0, 2.5].into() };
    assert!(body.kernel().is_ok());
    assert!(renamed::gauss_runtime::Top { mass: 1.0, inertia: 1.0 }.kernel().is_ok());
}

/// No implicit prelude: not even `Option`, `Ok`, `Clone` or `Into` are in scope.
mod without_prelude {
    #![no_implicit_prelude]

    #[derive(::gauss_runtime::GaussDynamics)]
    #[gauss(chart = jet(modified_rodrigues))]
    pub(super) struct Body {
        #[gauss(mass)]
        pub(super) mass: f64,
        #[gauss(center_of_mass)]
        pub(super) center: ::gauss_runtime::prelude::Vector3<f64>,
        #[gauss(inertia)]
        pub(super) inertia: ::gauss_runtime::prelude::Matrix3<f64>,
        #[gauss(added_mass)]
        pub(super) added: ::gauss_runtime::prelude::Matrix6<f64>,
        #[gauss(gravity)]
        pub(super) gravity: f64,
    }

    #[derive(::gauss_runtime::GaussDynamics)]
    #[gauss(chart = right_invariant, motion = planar)]
    pub(super) struct Flat<T> {
        #[gauss(mass)]
        pub(super) mass: T,
        #[gauss(inertia)]
        pub(super) inertia: T,
    }
}

#[test]
fn no_prelude_is_needed() {
    use gauss_runtime::prelude::{Matrix3, Matrix6};
    let body = without_prelude::Body {
        mass: 1.0,
        center: [0.1, 0.0, 0.0].into(),
        inertia: Matrix3::identity(),
        added: Matrix6::identity(),
        gravity: 9.81,
    };
    assert!(body.kernel().is_ok());
    assert!(without_prelude::Flat { mass: 1.0_f32, inertia: 2.0 }.kernel().is_ok());
}

/// Everything that generated code could name carelessly means something else.
mod shadowed {
    #![allow(dead_code, non_camel_case_types)]

    use gauss_runtime::GaussDynamics;
    // The real types under the names that the derive reads: the last segment decides.
    mod real {
        pub use ::core::primitive::f64;
        pub use gauss_runtime::prelude::{Matrix3, Vector3};
    }

    pub struct f64;
    pub struct f32;
    pub struct usize;
    pub struct u32;
    pub struct Vector3;
    pub struct Matrix3;
    pub struct SVector;
    pub struct SMatrix;
    pub struct Isometry3;
    pub struct UnitQuaternion;
    pub enum Option {
        Some,
        None,
    }
    pub enum Result {
        Ok,
        Err,
    }
    pub struct Ok;
    pub struct Err;
    pub struct Some;
    pub struct None;
    pub struct String;
    pub struct Vec;
    pub struct Box;
    pub struct Self_;
    pub struct Chart;
    pub struct RotationChart;
    pub struct Operations;
    pub struct ParameterError;
    pub struct ParameterCheck;
    pub trait Clone {}
    pub trait Copy {}
    pub trait Debug {}
    pub trait Real {}
    pub trait GaussSystem {}
    pub trait RigidBodySystem {}
    pub trait Configuration {}
    pub trait Into {}
    pub trait From {}
    pub mod core {}
    pub mod std {}
    pub mod gauss_runtime_ {}
    pub mod prelude {}

    macro_rules! shadow {
        ($($name:ident)+) => { $(#[allow(unused_macros)] macro_rules! $name { () => { compile_error!("shadowed") }; })+ };
    }
    shadow!(vec format panic assert write matches);

    #[derive(GaussDynamics)]
    #[gauss(chart = hybrid)]
    pub(super) struct Body {
        #[gauss(mass)]
        pub(super) mass: real::f64,
        #[gauss(center_of_mass)]
        pub(super) center: real::Vector3<real::f64>,
        #[gauss(inertia)]
        pub(super) inertia: real::Matrix3<real::f64>,
        #[gauss(gravity)]
        pub(super) gravity: real::f64,
    }
}

#[test]
fn names_may_be_shadowed() {
    use gauss_runtime::prelude::Matrix3;
    let body =
        shadowed::Body { mass: 1.0, center: [0.1, 0.0, 0.0].into(), inertia: Matrix3::identity(), gravity: 9.81 };
    assert!(body.kernel().is_ok());
}

/// Constants, statics and structs of the user's that a name in a pattern would be taken for.
mod patterns {
    #![allow(dead_code, non_camel_case_types, non_upper_case_globals)]

    use gauss_runtime::prelude::*;

    macro_rules! constants {
        ($($name:ident)+) => { $(const $name: u8 = 0;)+ };
    }
    constants!(t z acceleration twist residual order series kernel check k v w a b c s x y order_ rates values);
    static p: u8 = 0;
    static input: u8 = 0;
    struct q;
    struct pose(u8);
    struct momentum;

    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zyx), taylor, linearize(parameters), regressor, drag(linear = d))]
    pub(super) struct Free {
        #[gauss(mass)]
        pub(super) mass: f64,
        #[gauss(inertia)]
        pub(super) inertia: Vector3<f64>,
        #[gauss(added_mass)]
        pub(super) added: Vector6<f64>,
        pub(super) d: Vector6<f64>,
    }

    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(angle, height), input(push), body(rod, rotation = rotation_y(angle)), drive(height = push),
        particle(mass = rider, position = [0, 0, height]), constraint(position = height * height - angle),
    )]
    pub(super) struct Held {
        #[gauss(body)]
        pub(super) rod: RigidBody<f64>,
        pub(super) rider: f64,
    }

    #[derive(GaussDynamics)]
    #[gauss(coordinates(attitude: Rotation), body(rotation = attitude))]
    pub(super) struct Placed {
        #[gauss(mass)]
        pub(super) mass: f64,
        #[gauss(inertia)]
        pub(super) inertia: f64,
    }
}

#[test]
fn names_may_be_those_of_constants() {
    use gauss_runtime::prelude::*;
    let free =
        patterns::Free { mass: 1.0, inertia: [1.0, 2.0, 2.5].into(), added: Vector6::zeros(), d: Vector6::zeros() };
    assert!(free.kernel().is_ok());
    let rod = RigidBody { mass: 1.0, center_of_mass: Vector3::x(), inertia: Matrix3::identity() * 2.0 };
    assert!(patterns::Held { rod, rider: 1.0 }.kernel().is_ok());
    assert!(patterns::Placed { mass: 1.0, inertia: 1.0 }.kernel().is_ok());
}

#[test]
fn structs_may_be_local() {
    use gauss_runtime::prelude::*;
    #[derive(GaussDynamics)]
    struct Local {
        #[gauss(mass)]
        mass: f64,
        #[gauss(inertia)]
        inertia: f64,
    }
    let kernel = Local { mass: 2.0, inertia: 1.0 }.kernel().expect("a ball");
    assert_eq!(kernel.kinetic_energy(0.0, &Isometry3::identity(), &Vector6::from([1.0; 6])), 4.5);
}

/// Names of fields are the user's, also those that generated code uses inside, and raw ones.
#[test]
fn fields_may_have_any_name() {
    use gauss_runtime::prelude::*;
    #[derive(GaussDynamics)]
    #[gauss(chart = left_invariant)]
    struct Odd {
        #[gauss(mass)]
        r#type: f64,
        #[gauss(center_of_mass)]
        check: Vector3<f64>,
        #[gauss(inertia)]
        p0: Matrix3<f64>,
        #[gauss(gravity)]
        k0: f64,
        #[gauss(displaced_mass)]
        r#fn: f64,
    }
    let odd = |r#fn: f64| Odd { r#type: 2.0, check: Vector3::zeros(), p0: Matrix3::identity(), k0: 9.81, r#fn };
    let kernel = odd(2.0).kernel().expect("a ball");
    let q = Isometry3::identity();
    // The weight is what the buoyancy is: nothing accelerates.
    assert_eq!(kernel.acceleration(0.0, &q, &Vector6::zeros(), &()).amax(), 0.0);
    // An error names the field as the user would say it.
    let error = odd(-1.0).kernel().expect_err("negative");
    assert_eq!(error.violations()[0].field, "fn");
}

/// Plain parameters of any type are carried by the struct and left alone.
#[test]
fn plain_parameters_may_be_of_any_type() {
    use gauss_runtime::prelude::*;
    #[derive(GaussDynamics, Clone)]
    #[gauss(chart = right_invariant)]
    struct Labelled<T, L: Clone>
    where
        L: std::fmt::Debug,
    {
        #[gauss(mass)]
        mass: T,
        #[gauss(inertia)]
        inertia: Vector3<T>,
        label: L,
        history: Vec<Option<T>>,
        callback: fn(T) -> T,
    }
    let labelled = Labelled {
        mass: 1.0_f32,
        inertia: Vector3::new(1.0, 1.5, 2.0),
        label: "a name",
        history: vec![None],
        callback: |x| x,
    };
    let kernel = labelled.kernel().expect("a body");
    assert!(kernel.momentum(0.0, &Isometry3::identity(), &Vector6::zeros()).amax() == 0.0);
    let Labelled { label, history, callback, .. } = labelled;
    assert_eq!((label, history.len(), callback(1.0)), ("a name", 1, 1.0));
}

/// Bounds and defaults on the parameter are kept, also an unusual name for it.
#[test]
fn parameters_may_have_bounds_and_defaults() {
    use gauss_runtime::prelude::*;
    #[derive(GaussDynamics)]
    #[gauss(chart = jet(rodrigues))]
    struct Bounded<Scalar: Real + PartialOrd = f64>
    where
        Scalar: From<f32>,
    {
        #[gauss(mass)]
        mass: Scalar,
        #[gauss(inertia)]
        inertia: Vector3<Scalar>,
    }
    let bounded: Bounded = Bounded { mass: 1.0, inertia: Vector3::new(1.0, 1.5, 2.0) };
    let kernel: BoundedKernel<f64> = bounded.kernel().expect("a body");
    assert_eq!(kernel.kinetic_energy(0.0, &Vector6::zeros(), &Vector6::x()), 0.5);
}

/// Behind an alias the role says the shape.
#[test]
fn types_may_be_aliases() {
    use gauss_runtime::prelude::*;
    type Number = f64;
    type Moments = Vector3<Number>;
    type Tensor = Matrix3<Number>;
    type Fluid = Matrix6<Number>;
    type Diagonal = Vector6<Number>;
    #[derive(GaussDynamics)]
    struct Aliased {
        #[gauss(mass)]
        mass: f64,
        #[gauss(inertia = principal)]
        inertia: Moments,
        #[gauss(added_mass = full)]
        added: Fluid,
        #[gauss(gravity = vertical)]
        gravity: Number,
    }
    #[derive(GaussDynamics)]
    struct Other {
        #[gauss(mass)]
        mass: f64,
        #[gauss(inertia = full)]
        inertia: Tensor,
        #[gauss(added_mass = diagonal)]
        added: Diagonal,
        #[gauss(gravity = vector)]
        gravity: Moments,
    }
    let moments = Vector3::new(1.0, 1.5, 2.0);
    let aliased = Aliased { mass: 1.0, inertia: moments, added: Matrix6::identity(), gravity: 9.81 };
    let other = Other {
        mass: 1.0,
        inertia: Matrix3::from_diagonal(&moments),
        added: Vector6::from([1.0; 6]),
        gravity: Vector3::new(0.0, 0.0, -9.81),
    };
    let (aliased, other) = (aliased.kernel().expect("a body"), other.kernel().expect("a body"));
    let (q, z) = (Isometry3::identity(), Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
    let difference = aliased.acceleration(0.0, &q, &z, &()) - other.acceleration(0.0, &q, &z, &());
    // The same body: products of numbers up to 30, each rounded a few times on different ways.
    assert!(difference.amax() <= 16.0 * f64::EPSILON * 30.0, "{difference}");
}

/// `SVector` and `SMatrix` with numbers say their shapes, however qualified.
#[test]
fn types_may_be_written_out() {
    use gauss_runtime::prelude as g;
    #[allow(unused_parens, unused_braces)]
    #[derive(g::GaussDynamics)]
    struct Long {
        #[gauss(mass)]
        mass: std::primitive::f64,
        #[gauss(center_of_mass)]
        center: g::SVector<core::primitive::f64, 3>,
        #[gauss(inertia)]
        inertia: g::SMatrix<f64, 3, 3>,
        #[gauss(added_mass)]
        added: (g::SVector<f64, { 6 }>),
    }
    let long =
        Long { mass: 1.0, center: g::SVector::zeros(), inertia: g::SMatrix::identity(), added: g::SVector::zeros() };
    assert!(long.kernel().is_ok());
}

/// A public struct, documented: nothing generated lacks a doc comment, in single precision too.
#[derive(gauss_runtime::GaussDynamics)]
#[gauss(chart = jet(euler_zyx))]
#[gauss(motion = free)]
#[must_use]
pub struct Documented {
    /// The mass.
    #[gauss(mass)]
    pub mass: f32,
    /// The principal moments.
    #[gauss(inertia)]
    pub inertia: gauss_runtime::prelude::Vector3<f32>,
    /// The weight.
    #[gauss(gravity)]
    #[doc(hidden)]
    pub gravity: f32,
    /// Private, and without a role.
    #[allow(dead_code)]
    note: u8,
}

#[test]
fn single_precision_is_enough() {
    let body = Documented { mass: 2.0, inertia: [1.0, 1.5, 2.0].into(), gravity: 8.0, note: 0 };
    let kernel: DocumentedKernel = body.kernel().expect("a body");
    let rest = gauss_runtime::prelude::SVector::<f32, 6>::zeros();
    let acceleration = kernel.acceleration(0.0, &rest, &rest, &());
    assert_eq!(acceleration.data.0[0], [0.0, 0.0, -8.0, 0.0, 0.0, 0.0]);
    assert_eq!(kernel.body_momentum(0.0, &rest, &rest).amax(), 0.0);
}

/// Derived inside a macro, whose fragments arrive in invisible groups.
#[test]
fn macros_may_write_the_struct() {
    macro_rules! body {
        ($name:ident, $chart:ident, $motion:ident, $scalar:ty, $vector:ty) => {
            #[derive(gauss_runtime::GaussDynamics)]
            #[gauss(chart = $chart, motion = $motion)]
            struct $name {
                #[gauss(mass)]
                mass: $scalar,
                #[gauss(inertia)]
                inertia: $vector,
            }
        };
    }
    body!(Stamped, left_invariant, fixed_point, f64, gauss_runtime::prelude::Vector3<f64>);
    let kernel = Stamped { mass: 1.0, inertia: [1.0, 1.5, 2.0].into() }.kernel().expect("a body");
    assert_eq!(StampedKernel::DOF, 3);
    let copy = kernel;
    assert_eq!(format!("{copy:?}"), format!("{kernel:?}"));
}
