//! Forces and filters that a file switches off.

/// Forces and filters that `<option>` and its `<flag>` switch off.
#[derive(Clone, Default, PartialEq)]
pub struct Disabled {
    pub actuation: bool,
    /// Groups of actuators.
    pub groups: Vec<f64>,
    /// Controls have no ranges.
    pub clamps: bool,
    pub springs: bool,
    pub dampers: bool,
    pub equalities: bool,
    pub frictions: bool,
    pub limits: bool,
    pub contacts: bool,
    /// The filter that keeps bodies from touching their parents.
    pub parents_touch: bool,
}
