//! Dimensions that values must have.

use crate::model::language::units::Dimension;

/// Dimension that a value must have, with its words.
pub struct Need {
    /// `the components of a force are`.
    pub what: String,
    /// `N`.
    pub unit: String,
    pub dimension: Dimension,
}

impl Need {
    pub fn new(what: impl Into<String>, (unit, dimension): (&str, Dimension)) -> Need {
        Need { what: what.into(), unit: unit.into(), dimension }
    }
}

pub const LENGTH: (&str, Dimension) = ("m", Dimension::new(0, 1, 0));
pub const VELOCITY: (&str, Dimension) = ("m/s", Dimension::new(0, 1, -1));
pub const ANGULAR_VELOCITY: (&str, Dimension) = ("rad/s", Dimension::new(0, 0, -1));
pub const ANGLE: (&str, Dimension) = ("rad (dimensionless)", Dimension::NONE);
pub const MASS: (&str, Dimension) = ("kg", Dimension::new(1, 0, 0));
pub const FORCE: (&str, Dimension) = ("N", Dimension::new(1, 1, -2));
pub const TORQUE: (&str, Dimension) = ("N m", Dimension::new(1, 2, -2));
pub const ENERGY: (&str, Dimension) = ("J", Dimension::new(1, 2, -2));
pub const POWER: (&str, Dimension) = ("W", Dimension::new(1, 2, -3));
/// The diagonal of an added mass.
pub const ADDED_MASS: [(&str, Dimension); 2] = [MASS, ("kg m^2", Dimension::new(1, 2, 0))];
