//! Single bodies: what is given of their masses, what acts on them, and their motions in closed form.

#[macro_use]
#[path = "../common/mod.rs"]
mod common;

mod central_gravity;
mod central_inertia;
mod drag_warnings;
mod forces;
mod free_bodies;
mod increments;
mod mass_clauses;
mod media;
mod remus;
mod robustness;
mod states;
mod tops;
