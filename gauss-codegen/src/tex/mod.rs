//! Widths of formulas on paper, and lines that fit a page.
//!
//! Read from the LaTeX that the printer writes, as [`mathml`](crate::mathml) does. No TeX is run: widths are estimated
//! from those of the letters of Computer Modern at 10 pt, a little too large rather than too small.
//!
//! - `read`: LaTeX → `Piece`s.
//! - `letters`: widths of letters and signs; `width`: of formulas.
//! - `breaks`: where a sum, a product or a bracket may be broken, and what stands there then.
//! - `lines`: equations in `align*` environments, no line wider than a page.

mod breaks;
mod letters;
mod lines;
mod read;
#[cfg(test)]
mod tests;
mod width;

pub use lines::environments;
