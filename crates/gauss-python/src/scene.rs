//! A struct as Python sees it.

use gauss_runtime::error::{ParameterError, ParameterWarnings};
use gauss_runtime::prelude::{Configuration, GaussSystem, VectorSpace};
use gauss_runtime::simd::Packed;

use crate::description::Description;
use crate::methods::{System, Table};
use crate::steps::Methods;

/// The scalar of a system.
pub type ScalarOf<S> = <S as GaussSystem>::Scalar;

/// The configuration of a system.
pub type ConfigurationOf<S> = <S as GaussSystem>::Configuration;

/// The speeds of a system.
pub type SpeedsOf<S> = <S as GaussSystem>::Speeds;

/// A struct with `#[gauss(python)]`: implemented by [`scene!`](crate::scene), which its derive calls.
pub trait Scene: Sized + 'static {
    /// The kernel of one state.
    type Single: System<Scalar = f64>;
    /// The kernel of several states; the same where the struct is not generic in its scalar.
    type Packed: System<
            Configuration: Packed<Single: Configuration<Scalar = f64> + Send> + Send,
            Speeds: Packed<Single: VectorSpace<f64> + Send> + Send,
        >;

    /// The struct in words.
    fn description() -> Description;

    /// The kernel with these parameters.
    ///
    /// # Errors
    /// Parameters that no body can have.
    fn single(numbers: &[f64]) -> Result<Self::Single, ParameterError>;

    /// The same in lanes.
    ///
    /// # Errors
    /// Parameters that no body can have, in any lane.
    fn packed(numbers: &[ScalarOf<Self::Packed>]) -> Result<Self::Packed, ParameterError>;

    /// Warnings of what is likely not meant.
    fn warnings(numbers: &[f64]) -> ParameterWarnings;

    /// The state at rest in the origin.
    fn at_rest() -> (<Self::Single as GaussSystem>::Configuration, <Self::Single as GaussSystem>::Speeds);

    /// The methods that were asked for, and those of integration.
    fn offer(single: &mut Table<Self::Single>, packed: &mut Table<Self::Packed>) -> Methods<Self::Single>;
}

/// Code that the derive calls for a struct with `#[gauss(python)]`: the struct in words, and its kernels.
#[doc(hidden)]
#[macro_export]
macro_rules! scene {
    (
        scene $name:ident [$($scalar:ident)?] $documentation:literal;
        kernel $kernel:ident; state $state:ident;
        fields { $($field:ident [$ty:ty] $word:literal $unit:literal $label:literal;)* }
        coordinates { $($coordinate:tt)* }
        speeds { $($speed:tt)* }
        inputs { $($input:tt)* }
        offers { $($offer:ident)* }
        steps { $($step:ident)* }
        remarks { $($remark:literal $ignored:literal;)* }
    ) => {
        const _: () = {
            $crate::__from_numbers! { $name [$($scalar)?] $($field [$ty])* }
            type Struct = $crate::__in_scalar!($name [$($scalar)?] ::core::primitive::f64);
            type Packs = $crate::__in_scalar!($name [$($scalar)?] $crate::Pack);
            type State = $crate::__in_scalar!($state [$($scalar)?] ::core::primitive::f64);

            impl $crate::Scene for Struct {
                type Single = $crate::__in_scalar!($kernel [$($scalar)?] ::core::primitive::f64);
                type Packed = $crate::__in_scalar!($kernel [$($scalar)?] $crate::Pack);

                fn description() -> $crate::Description {
                    $(type $scalar = ::core::primitive::f64;)?
                    $crate::Description {
                        name: ::core::stringify!($name),
                        documentation: $documentation,
                        fields: ::std::vec![$($crate::Field {
                            name: $word,
                            unit: $unit,
                            documentation: $label,
                            shape: <$ty as $crate::Parameter<::core::primitive::f64>>::SHAPE,
                        }),*],
                        coordinates: $crate::__parts!($($coordinate)*),
                        speeds: $crate::__parts!($($speed)*),
                        inputs: $crate::__parts!($($input)*),
                        remarks: ::std::vec![$($crate::Remark { text: $remark, ignored: $ignored }),*],
                    }
                }

                fn single(
                    numbers: &[::core::primitive::f64],
                ) -> ::core::result::Result<Self::Single, $crate::ParameterError> {
                    <Struct as $crate::FromNumbers<_>>::from_numbers(&mut $crate::Numbers::of(numbers)).kernel()
                }

                fn packed(
                    numbers: &[$crate::ScalarOf<Self::Packed>],
                ) -> ::core::result::Result<Self::Packed, $crate::ParameterError> {
                    <Packs as $crate::FromNumbers<_>>::from_numbers(&mut $crate::Numbers::of(numbers)).kernel()
                }

                fn warnings(numbers: &[::core::primitive::f64]) -> $crate::ParameterWarnings {
                    <Struct as $crate::FromNumbers<_>>::from_numbers(&mut $crate::Numbers::of(numbers)).warnings()
                }

                fn at_rest() -> ($crate::ConfigurationOf<Self::Single>, $crate::SpeedsOf<Self::Single>) {
                    let state = <State as ::core::default::Default>::default();
                    (state.q(), state.z())
                }

                fn offer(
                    single: &mut $crate::Table<Self::Single>,
                    packed: &mut $crate::Table<Self::Packed>,
                ) -> $crate::Methods<Self::Single> {
                    let _ = (&single, &packed);
                    type Kernel = $crate::__in_scalar!($kernel [$($scalar)?] ::core::primitive::f64);
                    $(
                        single.$offer();
                        packed.$offer();
                    )*
                    $crate::__steps!(Kernel Absent NoTaylor $($step)*)
                }
            }
        };
    };
}

/// A type with its scalar, where it has a parameter for that.
#[doc(hidden)]
#[macro_export]
macro_rules! __in_scalar {
    ($name:ident [] $scalar:ty) => { $name };
    ($name:ident [$parameter:ident] $scalar:ty) => { $name<$scalar> };
}

/// The struct from numbers.
#[doc(hidden)]
#[macro_export]
macro_rules! __from_numbers {
    ($name:ident [] $($field:ident [$ty:ty])*) => {
        impl $crate::FromNumbers<::core::primitive::f64> for $name {
            fn from_numbers(numbers: &mut $crate::Numbers<'_, ::core::primitive::f64>) -> Self {
                let _ = &numbers;
                Self { $($field: <$ty as $crate::Parameter<::core::primitive::f64>>::read(numbers)),* }
            }
        }
    };
    ($name:ident [$scalar:ident] $($field:ident [$ty:ty])*) => {
        impl<$scalar: $crate::Real> $crate::FromNumbers<$scalar> for $name<$scalar> {
            fn from_numbers(numbers: &mut $crate::Numbers<'_, $scalar>) -> Self {
                Self { $($field: <$ty as $crate::Parameter<$scalar>>::read(numbers)),* }
            }
        }
    };
}

/// The ways of running: places for methods that need a clause, and contacts, with their list.
#[doc(hidden)]
#[macro_export]
macro_rules! __steps {
    ($kernel:ident $jacobian:ident $taylor:ident taylor $($step:ident)*) => {
        $crate::__steps!($kernel $jacobian Taylor $($step)*)
    };
    ($kernel:ident $jacobian:ident $taylor:ident rosenbrock $($step:ident)*) => {
        $crate::__steps!($kernel JacobianMethod $taylor $($step)*)
    };
    ($kernel:ident $jacobian:ident $taylor:ident contacts) => {
        $crate::__steps!($kernel $jacobian $taylor).with_contacts($kernel::CONTACTS)
    };
    ($kernel:ident $jacobian:ident $taylor:ident) => {
        $crate::Methods::new::<$crate::places::$jacobian, $crate::places::$taylor>()
    };
}

/// Coordinates, speeds and inputs.
#[doc(hidden)]
#[macro_export]
macro_rules! __parts {
    ($($word:literal $size:literal $unit:literal $label:literal;)*) => {
        ::std::vec![$($crate::Part { name: $word, size: $size, unit: $unit, label: $label }),*]
    };
}
