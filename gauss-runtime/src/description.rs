//! The description of a generated kernel: its equations as text, the costs of its methods, their losses to rounding.

use core::fmt;

use crate::accuracy::Accuracy;
use crate::methods::by_method;

/// The equations of a system, the costs of its methods and their losses to rounding, as constants. Generated for every
/// kernel. No computation uses them.
pub trait DescribedSystem {
    /// The equations, as they were derived.
    const EQUATIONS: Equations = Equations::new("", "");

    /// Cost of each method.
    const OPERATIONS: Operations = Operations::NONE;

    /// Loss of each method to rounding.
    const ACCURACY: Accuracy = Accuracy::NONE;

    /// Names of the numbers that a configuration consists of, in their order; nothing where they have no names.
    const COORDINATE_NAMES: &'static [&'static str] = &[];

    /// Names of the speeds, component by component; nothing where they have no names.
    const SPEED_NAMES: &'static [&'static str] = &[];
}

/// The equations of motion as printed by the derivation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Equations {
    /// Plain text, one equation a line.
    pub text: &'static str,
    /// LaTeX: `align*` environments of amsmath, whose lines fit a page of 16 cm at 10 pt. Long ones go on below.
    pub latex: &'static str,
}

impl Equations {
    /// From plain text and LaTeX.
    #[must_use]
    pub const fn new(text: &'static str, latex: &'static str) -> Self {
        Self { text, latex }
    }
}

impl fmt::Display for Equations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)
    }
}

/// The cost of one generated function, counted on the straight-line program that was emitted.
///
/// Subtractions count as additions, a sine–cosine pair as two transcendental calls; negations are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct OperationCount {
    /// Additions and subtractions.
    pub additions: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub roots: u32,
    /// Transcendental functions.
    pub transcendentals: u32,
}

impl OperationCount {
    /// A count from its parts, in the order of the fields.
    #[must_use]
    pub const fn new(additions: u32, multiplications: u32, divisions: u32, roots: u32, transcendentals: u32) -> Self {
        Self { additions, multiplications, divisions, roots, transcendentals }
    }

    /// All operations together.
    #[must_use]
    pub const fn total(&self) -> u32 {
        self.additions + self.multiplications + self.divisions + self.roots + self.transcendentals
    }
}

impl fmt::Display for OperationCount {
    /// `12 add, 9 mul`: counts of zero are left out; `0` when all are.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.additions, "add"),
            (self.multiplications, "mul"),
            (self.divisions, "div"),
            (self.roots, "sqrt"),
            (self.transcendentals, "trans"),
        ];
        let mut separator = "";
        for (count, name) in parts {
            if count > 0 {
                write!(f, "{separator}{count} {name}")?;
                separator = ", ";
            }
        }
        if separator.is_empty() { f.write_str("0") } else { Ok(()) }
    }
}

by_method! {
    /// The cost of every method of a kernel; zero for a method that the kernel does not have.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    #[non_exhaustive]
    Operations of OperationCount = OperationCount::new(0, 0, 0, 0, 0);
    /// Cost of `kernel()`: work done once, when the kernel is made.
    kernel,
    /// Cost of [`GaussSystem::kinematics`](crate::system::GaussSystem::kinematics).
    kinematics,
    /// Cost of [`GaussSystem::acceleration`](crate::system::GaussSystem::acceleration).
    acceleration,
    /// Cost of [`GaussSystem::momentum`](crate::system::GaussSystem::momentum).
    momentum,
    /// Cost of [`GaussSystem::velocity`](crate::system::GaussSystem::velocity).
    velocity,
    /// Cost of [`GaussSystem::momentum_rate`](crate::system::GaussSystem::momentum_rate).
    momentum_rate,
    /// Cost of [`GaussSystem::mass_matrix`](crate::system::GaussSystem::mass_matrix).
    mass_matrix,
    /// Cost of [`GaussSystem::kinetic_energy`](crate::system::GaussSystem::kinetic_energy).
    kinetic_energy,
    /// Cost of [`GaussSystem::potential_energy`](crate::system::GaussSystem::potential_energy).
    potential_energy,
    /// Cost of [`GaussSystem::gauss_residual`](crate::system::GaussSystem::gauss_residual).
    gauss_residual,
    /// Cost of [`GaussSystem::constraint_function`](crate::system::GaussSystem::constraint_function).
    constraint_function,
    /// Cost of [`GaussSystem::evaluate`](crate::system::GaussSystem::evaluate).
    evaluate,
    /// Cost of [`GaussSystem::configuration_rates`](crate::system::GaussSystem::configuration_rates), where elements
    /// have states; else it is that of the kinematics.
    configuration_rates,
    /// Cost of [`ConstrainedSystem::multipliers`](crate::constraint::ConstrainedSystem::multipliers); none without
    /// constraints.
    multipliers,
    /// Cost of [`ForcedSystem::powers`](crate::forces::ForcedSystem::powers); none where nothing acts.
    powers,
    /// Cost of [`LinearizedSystem::linearize`](crate::linearize::LinearizedSystem::linearize).
    linearize,
    /// Cost of [`ParametricSystem::by_parameters`](crate::identification::ParametricSystem::by_parameters).
    by_parameters,
    /// Cost of
    /// [`InverseLinearizedSystem::linearize_inverse`](crate::inverse::InverseLinearizedSystem::linearize_inverse).
    linearize_inverse,
    /// Cost of [`HessianSystem::hessian`](crate::hessian::HessianSystem::hessian).
    hessian,
    /// Cost of [`InertialRegressor::regressor`](crate::identification::InertialRegressor::regressor).
    regressor,
    /// Cost of [`FramedSystem::frames`](crate::frames::FramedSystem::frames).
    frames,
    /// Cost of [`Reactions::reactions_at`](crate::reactions::Reactions::reactions_at): of all joints together.
    reactions_at,
    /// Cost of [`ContactReactions::contact_reactions`](crate::reactions::ContactReactions::contact_reactions).
    contact_reactions,
    /// Cost of [`DrivenSystem::driving_forces_at`](crate::driven::DrivenSystem::driving_forces_at): of all motions
    /// together.
    driving_forces_at,
    /// Cost of [`CentroidalSystem::center_of_mass`](crate::centroidal::CentroidalSystem::center_of_mass).
    center_of_mass,
    /// Cost of [`CentroidalSystem::centroidal_momentum`](crate::centroidal::CentroidalSystem::centroidal_momentum).
    centroidal_momentum,
    /// Cost of [`CentroidalSystem::centroidal_matrix`](crate::centroidal::CentroidalSystem::centroidal_matrix).
    centroidal_matrix,
    /// Cost of [`CentroidalSystem::centroidal_bias`](crate::centroidal::CentroidalSystem::centroidal_bias).
    centroidal_bias,
    /// Cost of [`GaussSystem::nonlinear_effects`](crate::system::GaussSystem::nonlinear_effects), where it is a program
    /// of its own.
    nonlinear_effects,
    /// Cost of [`GravityTorques::gravity_torques`](crate::centroidal::GravityTorques::gravity_torques).
    gravity_torques,
    /// Cost of [`ContactSystem::gaps`](crate::contact::ContactSystem::gaps); none without contacts.
    gaps,
    /// Cost of [`ContactSystem::contact_rates`](crate::contact::ContactSystem::contact_rates).
    contact_rates,
    /// Cost of [`ContactSystem::contact_jacobian`](crate::contact::ContactSystem::contact_jacobian).
    contact_jacobian,
    /// Cost of [`ContactSystem::contact_frame`](crate::contact::ContactSystem::contact_frame): of all contacts
    /// together.
    contact_frames,
    /// Cost of [`ContactSystem::friction`](crate::contact::ContactSystem::friction).
    friction,
    /// Cost of [`ContactSystem::impulse_response`](crate::contact::ContactSystem::impulse_response).
    impulse_response,
    /// Cost of [`ContactSystem::impulse_dynamics`](crate::contact::ContactSystem::impulse_dynamics).
    impulse_dynamics,
    /// Cost of [`ContactSystem::impulse_velocities`](crate::contact::ContactSystem::impulse_velocities), of long trees.
    impulse_velocities,
    ;
    /// Costs of the other methods of [`FramedSystem`](crate::frames::FramedSystem), frame by frame in their order.
    of_frames: &'static [FrameOperations] = &[]
}

/// Costs of the methods that take one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameOperations {
    /// The name of the frame.
    pub name: &'static str,
    /// Cost of `pose_of`.
    pub pose: OperationCount,
    /// Cost of `twist_of`.
    pub twist: OperationCount,
    /// Cost of `jacobian_of`.
    pub jacobian: OperationCount,
    /// Cost of `bias_of`.
    pub bias: OperationCount,
    /// Cost of `jacobian_rate_of`, with `methods(jacobian_rates)`.
    pub jacobian_rate: OperationCount,
}

impl FrameOperations {
    /// From the costs of pose, twist, Jacobian and bias.
    #[must_use]
    pub const fn new(name: &'static str, [pose, twist, jacobian, bias]: [OperationCount; 4]) -> Self {
        let jacobian_rate = OperationCount::new(0, 0, 0, 0, 0);
        Self { name, pose, twist, jacobian, bias, jacobian_rate }
    }

    /// Sets the cost of the rate of the Jacobian.
    #[must_use]
    pub const fn with_jacobian_rate(self, jacobian_rate: OperationCount) -> Self {
        Self { jacobian_rate, ..self }
    }
}

/// The rows of [`Operations`] that every kernel has.
const ALWAYS: usize = 12;

impl fmt::Display for Operations {
    /// A row for each method that every kernel has, and for each other method that this kernel has.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, (name, count)) in self.rows().enumerate() {
            if n < ALWAYS || count.total() > 0 {
                let separator = if n > 0 { "\n" } else { "" };
                write!(f, "{separator}{name:<20}{count}")?;
            }
        }
        for FrameOperations { name, pose, twist, jacobian, bias, jacobian_rate } in self.of_frames {
            write!(f, "\n{name:<20}pose {pose}; twist {twist}; jacobian {jacobian}; bias {bias}")?;
            if jacobian_rate.total() > 0 {
                write!(f, "; jacobian rate {jacobian_rate}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn counts_print_what_is_there() {
        assert_eq!(OperationCount::new(12, 9, 0, 0, 0).to_string(), "12 add, 9 mul");
        assert_eq!(OperationCount::new(0, 0, 1, 2, 3).to_string(), "1 div, 2 sqrt, 3 trans");
        assert_eq!(OperationCount::default().to_string(), "0");
        assert_eq!(OperationCount::new(1, 2, 3, 4, 5).total(), 15);
    }

    #[test]
    fn multipliers_and_powers_are_listed_where_there_are_any() {
        let free = Operations::default();
        assert!(free.to_string().ends_with("evaluate            0"), "{free}");
        let constrained = Operations { multipliers: OperationCount::new(3, 4, 1, 0, 0), ..free };
        assert!(constrained.to_string().ends_with("\nmultipliers         3 add, 4 mul, 1 div"), "{constrained}");
        let forced = Operations { powers: OperationCount::new(2, 5, 0, 0, 0), ..constrained };
        assert!(forced.to_string().ends_with("1 div\npowers              2 add, 5 mul"), "{forced}");
    }
}
