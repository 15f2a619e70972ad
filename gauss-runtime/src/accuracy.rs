//! What double precision loses in the methods of a kernel, measured when it was derived.

use core::fmt;

/// The loss of one method: its error at sample states, in units of what a change of every parameter and argument in its last place does to the
/// result. A loss of 1 is what no method can do without; of 10 one decimal place more.
///
/// Bounds of round numbers: both are rounded up to 1, 2 or 5 times a power of ten, 0.1 at least.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[non_exhaustive]
pub struct Loss {
    /// The largest.
    pub worst: f64,
    /// The one in the middle.
    pub median: f64,
}

impl Loss {
    /// No state was tried.
    pub const NONE: Self = Self::new(0.0, 0.0);

    /// From the largest and the one in the middle.
    #[must_use]
    pub const fn new(worst: f64, median: f64) -> Self {
        Self { worst, median }
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (median {})", self.worst, self.median)
    }
}

/// The losses of the methods of a kernel; nothing of what it does not offer.
///
/// Sample states have numbers of many sizes, differences whose sides are close to each other, angles near quarter turns and far outside, bodies
/// far from Ω, fast spins. The reference has 106 binary digits. Of the arrangements of a method the cheapest is taken that loses little more
/// than the best of them at every state. What a certain state loses is said by [`Bounded`](crate::bounded).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Accuracy {
    /// Of [`GaussSystem::kinematics`](crate::system::GaussSystem::kinematics).
    pub kinematics: Loss,
    /// Of [`GaussSystem::acceleration`](crate::system::GaussSystem::acceleration).
    pub acceleration: Loss,
    /// Of [`GaussSystem::momentum`](crate::system::GaussSystem::momentum).
    pub momentum: Loss,
    /// Of [`GaussSystem::velocity`](crate::system::GaussSystem::velocity).
    pub velocity: Loss,
    /// Of [`GaussSystem::momentum_rate`](crate::system::GaussSystem::momentum_rate).
    pub momentum_rate: Loss,
    /// Of [`GaussSystem::mass_matrix`](crate::system::GaussSystem::mass_matrix).
    pub mass_matrix: Loss,
    /// Of [`GaussSystem::kinetic_energy`](crate::system::GaussSystem::kinetic_energy).
    pub kinetic_energy: Loss,
    /// Of [`GaussSystem::potential_energy`](crate::system::GaussSystem::potential_energy).
    pub potential_energy: Loss,
    /// Of [`GaussSystem::gauss_residual`](crate::system::GaussSystem::gauss_residual).
    pub gauss_residual: Loss,
    /// Of [`GaussSystem::constraint_function`](crate::system::GaussSystem::constraint_function).
    pub constraint_function: Loss,
    /// Of [`ConstrainedSystem::multipliers`](crate::constraint::ConstrainedSystem::multipliers).
    pub multipliers: Loss,
    /// Of [`ForcedSystem::powers`](crate::forces::ForcedSystem::powers).
    pub powers: Loss,
}

impl Accuracy {
    /// Nothing is known: to begin with, where methods are named one by one.
    pub const NONE: Self = {
        let none = Loss::NONE;
        Self {
            kinematics: none,
            acceleration: none,
            momentum: none,
            velocity: none,
            momentum_rate: none,
            mass_matrix: none,
            kinetic_energy: none,
            potential_energy: none,
            gauss_residual: none,
            constraint_function: none,
            multipliers: none,
            powers: none,
        }
    };
}

impl fmt::Display for Accuracy {
    /// A row for each method that was tried.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = [
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
            ("multipliers", self.multipliers),
            ("powers", self.powers),
        ];
        let mut separator = "";
        for (name, loss) in rows.into_iter().filter(|(_, loss)| *loss != Loss::NONE) {
            write!(f, "{separator}{name:<20}{loss}")?;
            separator = "\n";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn methods_that_were_tried_are_listed() {
        let accuracy =
            Accuracy { acceleration: Loss::new(5.0, 0.2), velocity: Loss::new(1000.0, 1.0), ..Accuracy::NONE };
        let rows = ["acceleration        5 (median 0.2)", "velocity            1000 (median 1)"];
        assert_eq!(accuracy.to_string(), rows.join("\n"));
        assert_eq!(Accuracy::NONE.to_string(), "");
    }
}
