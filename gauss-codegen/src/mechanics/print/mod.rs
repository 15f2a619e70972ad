//! The equations for people.

pub mod equations;
pub mod names;
pub mod sections;
pub mod shown;
