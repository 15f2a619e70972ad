//! Constraints on velocities that cannot be integrated, and the forces of constraints: several ways to write each
//! system against one another, against reference solutions and against closed forms.

mod nonlinear;
mod reactions;
mod sleigh;
mod suslov;
