//! Units: dimensions of expressions that follow from those of fields and inputs, and which are needed where.

pub mod dimensions;
pub mod need;
pub mod needs;
