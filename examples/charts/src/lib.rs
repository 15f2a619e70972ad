//! What the example `kirchhoff_vs_newton_euler` is made of; here and not next to it, so that a test can run it too.
//!
//! A package of its own, so that the first program that a stranger runs waits for few others. The other examples draw
//! with [`drawing`], and take random numbers from [`statistics`].
//!
//! | module | holds |
//! |---|---|
//! | [`vehicle`] | the REMUS 100 from its published parameters, once for each chart |
//! | [`simulate`] | runs: one initial state, every chart, two integrators, two scenes |
//! | [`measure`] | agreement of runs, drift of what should be constant |
//! | [`timing`] | nanoseconds per evaluation |
//! | [`report`] | the text |
//! | [`figure`] | the picture, its panels in [`panels`], and the page that plays |
//! | [`drawing`] | colours, text, with the feature `png` from SVG to pixels |
//! | [`statistics`] | random numbers, quartiles |

pub mod drawing;
pub mod figure;
pub mod measure;
pub mod panels;
pub mod report;
pub mod simulate;
pub mod statistics;
pub mod timing;
pub mod vehicle;
