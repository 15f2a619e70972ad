//! What a program reads that it does not compute.

/// An input of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Input {
    /// A component of an argument, both by their index.
    Component {
        /// Index among the arguments.
        argument: usize,
        /// Index among the components of that argument.
        component: usize,
    },
    /// A number of the program, by its index.
    Number(usize),
}
