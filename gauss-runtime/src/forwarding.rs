//! Systems that stand before another one and change a part of it.

/// Forwards methods of [`GaussSystem`](crate::system::GaussSystem) to a field, group by group, inside an `impl` of it.
///
/// | group | items |
/// |---|---|
/// | `types` | all types |
/// | `constants` | all constants |
/// | `motion` | `kinematics`, `configuration_rates`, `smoothness` |
/// | `dynamics` | `acceleration`, `momentum_rate` |
/// | `momenta` | `momentum`, `velocity` |
/// | `energies` | `mass_matrix`, `kinetic_energy`, `potential_energy` |
/// | `condition` | `gauss_residual`, `inverse_dynamics`, `nonlinear_effects`, `constraint_function` |
/// | `constraints` | `regularity`, `project`, `dependence` |
///
/// Methods that a later version adds come with their group, so that no system in between loses them. Attributes before
/// the type go to each method, as `#[inline(never)]` where a kernel in each stage of a method compiles too long.
///
/// A system that counts its accelerations:
///
/// ```
/// use core::cell::Cell;
/// use gauss_runtime::prelude::*;
///
/// struct Counted<S> {
///     system: S,
///     count: Cell<u64>,
/// }
///
/// impl<S: GaussSystem> GaussSystem for Counted<S> {
///     gauss_runtime::forward_system!(S => system: types constants motion momenta energies condition constraints);
///
///     fn acceleration(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Speeds {
///         self.count.set(self.count.get() + 1);
///         self.system.acceleration(t, q, z, input)
///     }
///     fn momentum_rate(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds, input: &S::Input) -> S::Speeds {
///         self.count.set(self.count.get() + 1);
///         self.system.momentum_rate(t, q, p, input)
///     }
/// }
/// ```
#[macro_export]
macro_rules! forward_system {
    (@groups $attributes:tt [$system:ty] $field:ident $($group:ident)+) => {
        $($crate::forward_system!(@$group $attributes $system, $field);)+
    };
    (@types $attributes:tt $system:ty, $field:ident) => {
        type Scalar = <$system as $crate::system::GaussSystem>::Scalar;
        type Configuration = <$system as $crate::system::GaussSystem>::Configuration;
        type Speeds = <$system as $crate::system::GaussSystem>::Speeds;
        type MassMatrix = <$system as $crate::system::GaussSystem>::MassMatrix;
        type Input = <$system as $crate::system::GaussSystem>::Input;
    };
    (@constants $attributes:tt $system:ty, $field:ident) => {
        const DOF: usize = <$system as $crate::system::GaussSystem>::DOF;
        const CHART: $crate::chart::Chart = <$system as $crate::system::GaussSystem>::CHART;
        const CONSTRAINED: bool = <$system as $crate::system::GaussSystem>::CONSTRAINED;
        const HAS_CONTACTS: bool = <$system as $crate::system::GaussSystem>::HAS_CONTACTS;
        const STATES: usize = <$system as $crate::system::GaussSystem>::STATES;
        const KEEPS_ENERGY: bool = <$system as $crate::system::GaussSystem>::KEEPS_ENERGY;
        const SMOOTHNESS: $crate::system::Smoothness = <$system as $crate::system::GaussSystem>::SMOOTHNESS;
        #[inline]
        fn keeps_energy(&self) -> bool {
            self.$field.keeps_energy()
        }
    };
    (@motion $attributes:tt $system:ty, $field:ident) => {
        #[inline]
        fn smoothness(&self) -> $crate::system::Smoothness {
            self.$field.smoothness()
        }
        #[inline]
        fn states(&self) -> usize {
            self.$field.states()
        }
        $crate::forward_system!(@method $attributes $field
            kinematics(q: &Self::Configuration, z: &Self::Speeds)
                -> <Self::Configuration as $crate::configuration::Configuration>::Tangent);
        $crate::forward_system!(@method $attributes $field
            configuration_rates(q: &Self::Configuration, z: &Self::Speeds, input: &Self::Input)
                -> <Self::Configuration as $crate::configuration::Configuration>::Tangent);
    };
    (@dynamics $attributes:tt $system:ty, $field:ident) => {
        $crate::forward_system!(@method $attributes $field
            acceleration(q: &Self::Configuration, z: &Self::Speeds, input: &Self::Input) -> Self::Speeds);
        $crate::forward_system!(@method $attributes $field
            momentum_rate(q: &Self::Configuration, p: &Self::Speeds, input: &Self::Input) -> Self::Speeds);
    };
    (@momenta $attributes:tt $system:ty, $field:ident) => {
        $crate::forward_system!(@method $attributes $field
            momentum(q: &Self::Configuration, z: &Self::Speeds) -> Self::Speeds);
        $crate::forward_system!(@method $attributes $field
            velocity(q: &Self::Configuration, p: &Self::Speeds) -> Self::Speeds);
    };
    (@energies $attributes:tt $system:ty, $field:ident) => {
        $crate::forward_system!(@method $attributes $field mass_matrix(q: &Self::Configuration) -> Self::MassMatrix);
        $crate::forward_system!(@method $attributes $field
            kinetic_energy(q: &Self::Configuration, z: &Self::Speeds) -> Self::Scalar);
        $crate::forward_system!(@method $attributes $field potential_energy(q: &Self::Configuration) -> Self::Scalar);
    };
    (@condition $attributes:tt $system:ty, $field:ident) => {
        $crate::forward_system!(@method $attributes $field
            gauss_residual(q: &Self::Configuration, z: &Self::Speeds, acceleration: &Self::Speeds, input: &Self::Input)
                -> Self::Speeds);
        $crate::forward_system!(@method $attributes $field
            inverse_dynamics(
                q: &Self::Configuration, z: &Self::Speeds, acceleration: &Self::Speeds, input: &Self::Input)
                -> Self::Speeds);
        $crate::forward_system!(@method $attributes $field
            nonlinear_effects(q: &Self::Configuration, z: &Self::Speeds, input: &Self::Input) -> Self::Speeds);
        $crate::forward_system!(@method $attributes $field
            constraint_function(
                q: &Self::Configuration, z: &Self::Speeds, acceleration: &Self::Speeds, input: &Self::Input)
                -> Self::Scalar);
    };
    (@constraints $attributes:tt $system:ty, $field:ident) => {
        $crate::forward_system!(@method $attributes $field regularity(q: &Self::Configuration) -> Self::Scalar);
        $crate::forward_system!(@method $attributes $field
            project(q: &Self::Configuration, z: &Self::Speeds)
                -> ::core::result::Result<(Self::Configuration, Self::Speeds), $crate::constraint::ProjectionError>);
        $crate::forward_system!(@method $attributes $field
            dependence(q: &Self::Configuration, z: &Self::Speeds) -> Self::Speeds);
    };
    (@method [] $($method:tt)+) => {
        $crate::forward_system!(@method [#[inline]] $($method)+);
    };
    (@method [$(#[$attribute:meta])+] $field:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty) => {
        $(#[$attribute])+
        fn $name(&self, t: Self::Scalar, $($argument: $type),*) -> $result {
            self.$field.$name(t, $($argument),*)
        }
    };
    ($(#[$attribute:meta])* $system:ty => $field:ident: $($group:ident)+) => {
        $crate::forward_system!(@groups [$(#[$attribute])*] [$system] $field $($group)+);
    };
}
