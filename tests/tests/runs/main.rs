//! Runs: methods and their steps, what happens within them, how they end, and many at once.

mod adapters;
mod batch;
mod between;
mod by_name;
mod endings;
mod events;
mod higher_precision;
mod integrators;
mod lanes;
mod sampled;
mod splitting;
mod taylor;
