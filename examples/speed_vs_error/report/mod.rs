//! What is written of the studies.
//!
//! | module | holds |
//! |---|---|
//! | [`machine`] | on what the figures were taken |
//! | [`chart`] | plots on logarithmic axes as SVG |
//! | [`plots`] | what is plotted of a scene |
//! | [`page`] | the page |
//! | [`overview`] | the picture for the README |
//! | [`tables`] | CSV, JSON, console |

pub mod chart;
pub mod machine;
pub mod overview;
pub mod page;
pub mod plots;
pub mod tables;
