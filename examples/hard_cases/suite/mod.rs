//! The suite of hard cases: what is measured, what a naive program gets, the target, and the figure reached.

mod bodies;
mod digits;
mod groups;
mod long_runs;
mod measure;
mod methods;
mod naive;
mod refusals;
pub mod scenes;
mod tops;
pub mod truth;

use std::error::Error;

pub use measure::{Effort, Measure, Verdict};

type Run = fn(Effort) -> Result<Vec<Measure>, Box<dyn Error>>;

/// A case: what it goes by, what is hard about it, and its measurements.
pub struct Case {
    pub name: &'static str,
    pub about: &'static str,
    pub run: Run,
}

const fn case(name: &'static str, about: &'static str, run: Run) -> Case {
    Case { name, about, run }
}

/// All of them, in the order of the report.
pub const CASES: [Case; 25] = [
    case("small_angles", "exp and its inverse derivative near the identity", groups::small_angles),
    case("half_turn", "logarithms near half a turn, where the cosine says nothing", groups::half_turn),
    case("many_turns", "attitudes beyond 2π, where dexp⁻¹ has a pole", groups::many_turns),
    case("large_step", "more than half a turn in a step", tops::large_step),
    case("separatrix", "rotation 1e-9 beside the intermediate axis: it flips", tops::separatrix),
    case("flips", "how often a body flips", tops::flips),
    case("gimbal_lock", "a top that passes through the upright", tops::gimbal_lock),
    case("sleeping_top", "a spin just below and just above what keeps a top upright", tops::sleeping_top),
    case("fast_top", "tops that turn by 0.6 rad in a step", tops::fast_top),
    case("chaos", "a heavy asymmetric top, compared as long as rounding lets one", tops::chaos),
    case("far_away", "a body 4e6 m from the origin", bodies::far_away),
    case("far_center", "a centre of mass 50 body sizes from O", bodies::far_center),
    case("needle", "moments of inertia 1 : 1e6", bodies::needle),
    case("light_body", "a light body in a heavy fluid: a nearly singular mass matrix", bodies::light_body),
    case("differences", "small differences of large numbers, as they are written", digits::differences),
    case("orbit", "a craft and its wheel in orbit: 1e-6 rad/s² beside 8 m/s²", digits::orbit),
    case("heavy_load", "masses 1 : 1e6 on links that are nearly in line", digits::heavy_load),
    case("free_fall", "a base that falls: gravity moves none of its joints", digits::free_fall),
    case("near_gimbal_lock", "a solution that divides by 1 − sin² near its zero", digits::near_gimbal_lock),
    case("unit_quaternion", "the norm of quaternions over many steps", long_runs::unit_quaternion),
    case("energy", "energy and momentum over many steps", long_runs::energy),
    case("rolling", "constraints over many steps", long_runs::rolling),
    case("stiff_drag", "drag that brakes a thousand times faster than one looks", refusals::stiff_drag),
    case("units", "units of 1e±150", refusals::units),
    case("bad_input", "numbers that are none, and inertia that no body has", refusals::bad_input),
];
