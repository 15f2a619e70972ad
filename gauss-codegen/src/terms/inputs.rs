//! Values that arrive at run time.

use proc_macro2::Ident;

/// One value that arrives at run time, or several under one name.
#[derive(Clone)]
pub struct InputName {
    /// Its name.
    pub ident: Ident,
    /// Number of values that it stands for.
    pub kind: InputKind,
    /// The unit, if one is written; a wrench is in N and N m.
    pub unit: Option<String>,
    /// Name outside of expressions.
    pub called: Ident,
}

/// Number of values under one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// One.
    Scalar,
    /// Three.
    Vector,
    /// Six: a force, then a torque, each a vector of its own in expressions.
    Wrench,
}
