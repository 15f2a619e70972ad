//! What the example `kirchhoff_vs_newton_euler` is made of; here and not beside it, so that a test can run it too. And what
//! other examples draw with.
//!
//! | module | holds |
//! |---|---|
//! | [`vehicle`] | the REMUS 100 from its published parameters, once for each chart |
//! | [`simulate`] | runs: one initial state, every chart, two integrators, two scenes |
//! | [`measure`] | agreement of runs, drift of what should be constant |
//! | [`timing`] | nanoseconds per evaluation |
//! | [`report`] | the text |
//! | [`figure`] | the picture, its panels in [`panels`] |
//! | [`rolling`] | the picture of `rolling_disk` |
//! | [`stage`] | what several pages that play show: a cart with its pole, a torpedo, links |
//! | [`statistics`] | random numbers, quartiles |
//! | [`plots`] | plots with plain axes, and where pictures are written |

pub mod figure;
pub mod measure;
pub mod panels;
pub mod plots;
pub mod report;
pub mod rolling;
pub mod simulate;
pub mod stage;
pub mod statistics;
pub mod timing;
pub mod vehicle;

/// How often a study is repeated: so often, or as the environment says in `RUNS`, for a first look.
pub fn runs(otherwise: usize) -> usize {
    std::env::var("RUNS").ok().and_then(|number| number.parse().ok()).unwrap_or(otherwise)
}
