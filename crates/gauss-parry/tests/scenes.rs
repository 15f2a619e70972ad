//! Scenes whose contacts a collision library finds: beside closed forms, at rest, on terrain, pushed.

#[path = "scenes/arm.rs"]
mod arm;
#[path = "scenes/flat.rs"]
mod flat;
#[path = "scenes/plane.rs"]
mod plane;
#[path = "scenes/refused.rs"]
mod refused;
#[path = "scenes/terrain.rs"]
mod terrain;
