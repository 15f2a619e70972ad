//! What double precision loses in the methods of a kernel, measured when it was derived.

use core::fmt;

use crate::methods::by_method;

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

by_method! {
    /// The losses of the methods of a kernel; nothing of what it does not offer.
    ///
    /// Sample states have numbers of many sizes, differences whose sides are close to each other, angles near quarter turns and far outside, bodies
    /// far from Ω, fast spins. The reference has 106 binary digits. Of the arrangements of a method the cheapest is taken that loses little more
    /// than the best of them at every state. What a certain state loses is said by [`Bounded`](crate::bounded).
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    #[non_exhaustive]
    Accuracy of Loss = Loss::NONE;
    /// Of [`GaussSystem::kinematics`](crate::system::GaussSystem::kinematics).
    kinematics,
    /// Of [`GaussSystem::acceleration`](crate::system::GaussSystem::acceleration).
    acceleration,
    /// Of [`GaussSystem::momentum`](crate::system::GaussSystem::momentum).
    momentum,
    /// Of [`GaussSystem::velocity`](crate::system::GaussSystem::velocity).
    velocity,
    /// Of [`GaussSystem::momentum_rate`](crate::system::GaussSystem::momentum_rate).
    momentum_rate,
    /// Of [`GaussSystem::mass_matrix`](crate::system::GaussSystem::mass_matrix).
    mass_matrix,
    /// Of [`GaussSystem::kinetic_energy`](crate::system::GaussSystem::kinetic_energy).
    kinetic_energy,
    /// Of [`GaussSystem::potential_energy`](crate::system::GaussSystem::potential_energy).
    potential_energy,
    /// Of [`GaussSystem::gauss_residual`](crate::system::GaussSystem::gauss_residual).
    gauss_residual,
    /// Of [`GaussSystem::constraint_function`](crate::system::GaussSystem::constraint_function).
    constraint_function,
    /// Of [`ConstrainedSystem::multipliers`](crate::constraint::ConstrainedSystem::multipliers).
    multipliers,
    /// Of [`ForcedSystem::powers`](crate::forces::ForcedSystem::powers).
    powers,
}

impl fmt::Display for Accuracy {
    /// A row for each method that was tried.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for (name, loss) in self.rows().filter(|(_, loss)| *loss != Loss::NONE) {
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
