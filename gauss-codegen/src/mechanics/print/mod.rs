//! The equations for people.

pub mod equations;
pub mod readings;
pub mod rows;
pub mod sections;
