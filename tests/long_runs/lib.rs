//! Tests that run for long: optimised, where those of `gauss-tests` are not.
