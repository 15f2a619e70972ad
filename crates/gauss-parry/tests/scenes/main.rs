//! Scenes whose contacts a collision library finds: beside closed forms, at rest, on terrain, pushed.

mod arm;
mod flat;
mod plane;
mod refused;
mod stack;
mod terrain;
