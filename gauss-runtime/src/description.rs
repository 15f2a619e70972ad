//! What a generated kernel says of itself: its equations as text, what its methods cost, and what they lose to rounding.

use core::fmt;

use crate::accuracy::Accuracy;

/// A system that says what its equations are, what its methods cost and what they lose. Generated for every kernel; nothing is computed
/// with it, and a system that is written by hand needs it only to be [tuned](crate::integrate::Simulation::tune):
/// `impl Described for MySystem {}`.
pub trait Described {
    /// The equations, as they were derived.
    const EQUATIONS: Equations = Equations::new("", "");

    /// What each method costs.
    const OPERATIONS: Operations = Operations::NONE;

    /// What each method loses to rounding.
    const ACCURACY: Accuracy = Accuracy::NONE;

    /// What the numbers are called that a configuration consists of, in their order; nothing where they have no names.
    const COORDINATE_NAMES: &'static [&'static str] = &[];

    /// What the speeds are called, component by component; nothing where they have no names.
    const SPEED_NAMES: &'static [&'static str] = &[];
}

/// The equations of motion as printed by the derivation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Equations {
    /// Plain text, one equation a line.
    pub text: &'static str,
    /// LaTeX, for display mode.
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
    /// `12 add, 9 mul`: what is zero is left out; `0` when everything is.
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

/// The cost of every method of a kernel; nothing of what it does not offer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Operations {
    /// Of `kernel()`: work done once, when the kernel is made.
    pub kernel: OperationCount,
    /// Of [`GaussSystem::kinematics`](crate::system::GaussSystem::kinematics).
    pub kinematics: OperationCount,
    /// Of [`GaussSystem::acceleration`](crate::system::GaussSystem::acceleration).
    pub acceleration: OperationCount,
    /// Of [`GaussSystem::momentum`](crate::system::GaussSystem::momentum).
    pub momentum: OperationCount,
    /// Of [`GaussSystem::velocity`](crate::system::GaussSystem::velocity).
    pub velocity: OperationCount,
    /// Of [`GaussSystem::momentum_rate`](crate::system::GaussSystem::momentum_rate).
    pub momentum_rate: OperationCount,
    /// Of [`GaussSystem::mass_matrix`](crate::system::GaussSystem::mass_matrix).
    pub mass_matrix: OperationCount,
    /// Of [`GaussSystem::kinetic_energy`](crate::system::GaussSystem::kinetic_energy).
    pub kinetic_energy: OperationCount,
    /// Of [`GaussSystem::potential_energy`](crate::system::GaussSystem::potential_energy).
    pub potential_energy: OperationCount,
    /// Of [`GaussSystem::evaluate`](crate::system::GaussSystem::evaluate).
    pub evaluate: OperationCount,
    /// Of [`GaussSystem::gauss_residual`](crate::system::GaussSystem::gauss_residual).
    pub gauss_residual: OperationCount,
    /// Of [`GaussSystem::constraint_function`](crate::system::GaussSystem::constraint_function).
    pub constraint_function: OperationCount,
    /// Of [`ConstrainedSystem::multipliers`](crate::constraint::ConstrainedSystem::multipliers); none without constraints.
    pub multipliers: OperationCount,
    /// Of [`ForcedSystem::powers`](crate::forces::ForcedSystem::powers); none where nothing acts.
    pub powers: OperationCount,
    /// Of [`LinearizedSystem::linearize`](crate::linearize::LinearizedSystem::linearize).
    pub linearize: OperationCount,
    /// Of [`ParametricSystem::by_parameters`](crate::identification::ParametricSystem::by_parameters).
    pub by_parameters: OperationCount,
    /// Of [`InverseLinearizedSystem::linearize_inverse`](crate::inverse::InverseLinearizedSystem::linearize_inverse).
    pub linearize_inverse: OperationCount,
    /// Of [`InertialRegressor::regressor`](crate::identification::InertialRegressor::regressor).
    pub regressor: OperationCount,
    /// Of [`FramedSystem::frames`](crate::frames::FramedSystem::frames).
    pub frames: OperationCount,
    /// Of [`CentroidalSystem::center_of_mass`](crate::centroidal::CentroidalSystem::center_of_mass).
    pub center_of_mass: OperationCount,
    /// Of [`CentroidalSystem::centroidal_momentum`](crate::centroidal::CentroidalSystem::centroidal_momentum).
    pub centroidal_momentum: OperationCount,
    /// Of [`CentroidalSystem::centroidal_matrix`](crate::centroidal::CentroidalSystem::centroidal_matrix).
    pub centroidal_matrix: OperationCount,
    /// Of [`CentroidalSystem::centroidal_bias`](crate::centroidal::CentroidalSystem::centroidal_bias).
    pub centroidal_bias: OperationCount,
    /// Of [`GaussSystem::nonlinear_effects`](crate::system::GaussSystem::nonlinear_effects), where it is a program of its own.
    pub nonlinear_effects: OperationCount,
    /// Of [`GravityTorques::gravity_torques`](crate::centroidal::GravityTorques::gravity_torques).
    pub gravity_torques: OperationCount,
    /// Of the other methods of [`FramedSystem`](crate::frames::FramedSystem), frame by frame in their order.
    pub of_frames: &'static [FrameOperations],
}

/// What it costs to ask for one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameOperations {
    /// The name of the frame.
    pub name: &'static str,
    /// Of `pose_of`.
    pub pose: OperationCount,
    /// Of `twist_of`.
    pub twist: OperationCount,
    /// Of `jacobian_of`.
    pub jacobian: OperationCount,
    /// Of `bias_of`.
    pub bias: OperationCount,
}

impl FrameOperations {
    /// From the costs of pose, twist, Jacobian and bias.
    #[must_use]
    pub const fn new(name: &'static str, [pose, twist, jacobian, bias]: [OperationCount; 4]) -> Self {
        Self { name, pose, twist, jacobian, bias }
    }
}

impl Operations {
    /// Nothing is known: to begin with, where methods are named one by one.
    pub const NONE: Self = {
        let none = OperationCount::new(0, 0, 0, 0, 0);
        Self {
            kernel: none,
            kinematics: none,
            acceleration: none,
            momentum: none,
            velocity: none,
            momentum_rate: none,
            mass_matrix: none,
            kinetic_energy: none,
            potential_energy: none,
            evaluate: none,
            gauss_residual: none,
            constraint_function: none,
            multipliers: none,
            powers: none,
            linearize: none,
            by_parameters: none,
            linearize_inverse: none,
            regressor: none,
            frames: none,
            center_of_mass: none,
            centroidal_momentum: none,
            centroidal_matrix: none,
            centroidal_bias: none,
            nonlinear_effects: none,
            gravity_torques: none,
            of_frames: &[],
        }
    };
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = [
            ("kernel", self.kernel),
            ("kinematics", self.kinematics),
            ("acceleration", self.acceleration),
            ("momentum", self.momentum),
            ("velocity", self.velocity),
            ("momentum_rate", self.momentum_rate),
            ("mass_matrix", self.mass_matrix),
            ("kinetic_energy", self.kinetic_energy),
            ("potential_energy", self.potential_energy),
            ("gauss_residual", self.gauss_residual),
            ("constraint_function", self.constraint_function),
            ("evaluate", self.evaluate),
        ];
        for (n, (name, count)) in rows.into_iter().enumerate() {
            if n > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{name:<20}{count}")?;
        }
        // A row only where there are constraints, where something acts, and of what was asked for.
        let others = [
            ("multipliers", self.multipliers),
            ("powers", self.powers),
            ("linearize", self.linearize),
            ("by_parameters", self.by_parameters),
            ("linearize_inverse", self.linearize_inverse),
            ("regressor", self.regressor),
            ("frames", self.frames),
            ("center_of_mass", self.center_of_mass),
            ("centroidal_momentum", self.centroidal_momentum),
            ("centroidal_matrix", self.centroidal_matrix),
            ("centroidal_bias", self.centroidal_bias),
            ("nonlinear_effects", self.nonlinear_effects),
            ("gravity_torques", self.gravity_torques),
        ];
        for (name, count) in others {
            if count != OperationCount::default() {
                write!(f, "\n{name:<20}{count}")?;
            }
        }
        for FrameOperations { name, pose, twist, jacobian, bias } in self.of_frames {
            write!(f, "\n{name:<20}pose {pose}; twist {twist}; jacobian {jacobian}; bias {bias}")?;
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
