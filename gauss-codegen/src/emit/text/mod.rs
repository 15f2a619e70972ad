//! Equations, costs and files of a scene in words: rustdoc, and `DescribedSystem`.

pub mod description;
pub mod documentation;
pub mod file;
