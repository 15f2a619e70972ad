//! The equations for people.

pub mod equations;
pub mod names;
pub mod rows;
pub mod sections;
pub mod shown;
