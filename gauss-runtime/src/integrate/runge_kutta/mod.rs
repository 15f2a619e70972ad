//! Explicit Runge–Kutta methods: their coefficients, and steps on the components of a configuration.

pub mod components;
pub mod tableau;
