//! The rounding errors of the methods of a kernel in double precision, measured when it was derived.

use core::fmt;

use crate::methods::by_method;

/// The loss of one method: its error in double precision, in units of what a change of every parameter and argument in
/// its last place does to the result. A loss of 1 is what no method can do without; of 10 one decimal place more.
///
/// Of a component y of a result that is ε (|y| + c), ε = 2⁻⁵², where ε c is the root mean square of the changes of y
/// when every parameter, argument and number that the scene keeps as a constant is changed by some ε of its own size at
/// once, independently of the others. What the kernel computes from such numbers is not changed by itself: its rounding
/// is an error. The loss of a result is that of its worst component. A component that vanishes whatever the numbers are
/// has no unit of its own: its error is divided by the largest unit of the result.
///
/// Both numbers are rounded up to 1, 2 or 5 times a power of ten, 0.1 at least; 1e16 means that no digit is left, or
/// that the method divides by zero where there is a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[non_exhaustive]
pub struct Loss {
    /// The largest that a search over states of the scene found.
    pub worst: f64,
    /// The one in the middle, of six sample states between ordinary and extreme.
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
    /// Both numbers, from 10⁴ on with an exponent.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let figure = |f: &mut fmt::Formatter<'_>, loss: f64| {
            if loss < 1e4 { write!(f, "{loss}") } else { write!(f, "{loss:e}") }
        };
        figure(f, self.worst)?;
        f.write_str(" (median ")?;
        figure(f, self.median)?;
        f.write_str(")")
    }
}

by_method! {
    /// The losses of the methods of a kernel; zero for a method that the kernel does not have.
    ///
    /// A search of bounded length looks for the states at which each method loses most. It begins at sample states and
    /// moves on by what makes digits cancel: parameters, speeds, rates and inputs of sizes up to 10⁹ apart, coordinates
    /// from 10⁻⁹ to 10⁷, angles near quarter turns, sums of the scene and of momenta as near zero as 10⁻⁹ of their
    /// terms, masses of links and lengths between them that grow by up to 10⁶ from one to the next, in both directions.
    /// Masses are positive and moments of inertia those of a body. Where the masses of a chain are fields, `worst` is
    /// that of masses which grow so: from four links on hardly a digit is left. It says nothing of links that are
    /// alike, of which `median` does; masses that are numbers of the scene stay what they are. A scene of ordinary
    /// numbers has a loss of about `median`; the kernel's documentation names the numbers that lead to `worst`. A
    /// function of the scene's own and a table are taken for functions that are rounded once: what they lose inside is
    /// theirs, and not in the figure.
    /// Derivatives and `evaluate` are tried where the other methods lose most. A figure is an estimate to first order
    /// of the largest loss at the states that the search tried: right within a factor of ten where it was compared with
    /// 106 digits, and other states may be worse. The scalar of the crate `gauss-bounded` bounds the loss at a given
    /// state.
    ///
    /// Of the arrangements of a method the cheapest is taken that loses little more than the best of them at every
    /// sample state.
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    #[non_exhaustive]
    Accuracy of Loss = Loss::NONE;
    /// Loss of [`GaussSystem::kinematics`](crate::system::GaussSystem::kinematics).
    kinematics,
    /// Loss of [`GaussSystem::acceleration`](crate::system::GaussSystem::acceleration).
    acceleration,
    /// Loss of [`GaussSystem::momentum`](crate::system::GaussSystem::momentum).
    momentum,
    /// Loss of [`GaussSystem::velocity`](crate::system::GaussSystem::velocity).
    velocity,
    /// Loss of [`GaussSystem::momentum_rate`](crate::system::GaussSystem::momentum_rate).
    momentum_rate,
    /// Loss of [`GaussSystem::mass_matrix`](crate::system::GaussSystem::mass_matrix).
    mass_matrix,
    /// Loss of [`GaussSystem::kinetic_energy`](crate::system::GaussSystem::kinetic_energy).
    kinetic_energy,
    /// Loss of [`GaussSystem::potential_energy`](crate::system::GaussSystem::potential_energy).
    potential_energy,
    /// Loss of [`GaussSystem::gauss_residual`](crate::system::GaussSystem::gauss_residual).
    gauss_residual,
    /// Loss of [`GaussSystem::constraint_function`](crate::system::GaussSystem::constraint_function).
    constraint_function,
    /// Loss of [`GaussSystem::configuration_rates`](crate::system::GaussSystem::configuration_rates), where elements
    /// have states.
    configuration_rates,
    /// Loss of [`ConstrainedSystem::multipliers`](crate::constraint::ConstrainedSystem::multipliers).
    multipliers,
    /// Loss of [`ForcedSystem::powers`](crate::forces::ForcedSystem::powers).
    powers,
    /// Loss of [`GaussSystem::evaluate`](crate::system::GaussSystem::evaluate).
    evaluate,
    /// Loss of [`LinearizedSystem::linearize`](crate::linearize::LinearizedSystem::linearize).
    linearize,
    /// Loss of [`ParametricSystem::by_parameters`](crate::identification::ParametricSystem::by_parameters).
    by_parameters,
    /// Loss of
    /// [`InverseLinearizedSystem::linearize_inverse`](crate::inverse::InverseLinearizedSystem::linearize_inverse).
    linearize_inverse,
    /// Loss of [`HessianSystem::hessian`](crate::hessian::HessianSystem::hessian).
    hessian,
    /// Loss of [`InertialRegressor::regressor`](crate::identification::InertialRegressor::regressor).
    regressor,
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
            Accuracy { acceleration: Loss::new(1e13, 0.2), velocity: Loss::new(5000.0, 2e4), ..Accuracy::NONE };
        let rows = ["acceleration        1e13 (median 0.2)", "velocity            5000 (median 2e4)"];
        assert_eq!(accuracy.to_string(), rows.join("\n"));
        assert_eq!(Accuracy::NONE.to_string(), "");
    }
}
