//! What acts on one rigid body, element by element: the same in every chart, by itself and with everything else on; the
//! same as the scene written as a system; and the balance of momentum and energy.

#[macro_use]
mod scenes;
mod alone;
mod charts;
mod observed;
mod scalars;
