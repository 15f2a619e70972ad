//! Studies: numbers that are drawn, files that outlive kills, lanes, other processes, and what they depend on.

mod common;
mod draws;
mod files;
mod kill;
mod lanes;
mod parallel;
mod python;
mod sensitivity;
