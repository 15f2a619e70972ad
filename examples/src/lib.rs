//! What several examples plan and draw with; colours and pixels are those of `gauss-charts`, the package of the first
//! example.
//!
//! | module | holds |
//! |---|---|
//! | [`ddp`] | plans by differential dynamic programming |
//! | [`rolling`] | the picture of `rolling_disk` |
//! | [`stage`] | what several pages that play show: a cart with its pole, links |
//! | [`plots`] | plots with plain axes, and where pictures are written |

pub mod ddp;
pub mod plots;
pub mod rolling;
pub mod stage;

/// How often a study is repeated: so often, or as the environment says in `RUNS`, for a first look.
pub fn runs(otherwise: usize) -> usize {
    std::env::var("RUNS").ok().and_then(|number| number.parse().ok()).unwrap_or(otherwise)
}
