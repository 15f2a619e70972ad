//! Tests that run for long: optimised, where those of `gauss-tests` are not.

/// How many steps a run has: a quarter of what it is meant for, or all with `LONG_RUNS` in the environment. What is
/// allowed grows with the steps as rounding does, so that a shorter run is no weaker a test of one step.
pub fn steps(all: u32) -> u32 {
    if std::env::var_os("LONG_RUNS").is_some() { all } else { all / 4 }
}
