//! A kernel as a function that is called. In a module of its own compilers have one caller of the kernel in the loop of
//! accelerations, and put it there, where it saves a quarter of the time.

use super::system::System;

/// The rates of the speeds.
#[inline(never)]
pub fn acceleration<S: System>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
    z: &S::Speeds,
    input: &S::Input,
) -> S::Speeds {
    system.acceleration(t, q, z, input)
}
