//! Bodies that roll without slipping: each written in several ways, against one another, against reference solutions
//! and against closed forms.

mod ball;
mod disk;
mod disk_forces;
mod rattleback;
