//! Steps of many contacts: the relaxed law, steps that keep a tolerance, changing over to them and back.

mod accounts;
mod adaptive;
mod changeover;
#[path = "../laws/common.rs"]
#[allow(dead_code, reason = "scenes of the other tests")]
mod common;
mod damped;
mod drag;
mod driven;
mod flying;
mod front;
mod lanes;
mod powered;
mod relaxed;
mod sampled;
mod several;
mod spinning;
mod springs;
mod whole;
