//! Scalar that carries a guaranteed bound on its own rounding: it shows how many digits of a result are right.
//!
//! Every generic kernel, [`linearize`](gauss_runtime::linearize), energies and integrators of fixed step take
//! [`Bounded`] as they take `f64`. Its `value` is, to the last bit, what the same code computes in the plain scalar;
//! its `bound` is never below the distance of that value from what exact arithmetic makes of the same inputs.
//!
//! ```
//! use gauss_bounded::{Bounded, exact};
//! use gauss_runtime::prelude::*;
//!
//! /// An arm of two links that carries a load at its end.
//! #[derive(GaussDynamics)]
//! #[gauss(
//!     coordinates(a, b),
//!     particle(mass = elbow, position = [l * cos(a), l * sin(a), 0]),
//!     particle(mass = load, position = [l * (cos(a) + cos(a + b)), l * (sin(a) + sin(a + b)), 0]),
//! )]
//! struct Arm<T> {
//!     elbow: T,
//!     load: T,
//!     l: T,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let [elbow, load, l] = exact(&[1.0, 2.0, 0.5]);
//! let arm = Arm { elbow, load, l }.kernel()?;
//! let (q, z) = (SVector::from([0.3, 1.2]), SVector::from([2.0, -1.0]));
//! let a = arm.acceleration(Bounded::exact(0.0), &exact(&q), &exact(&z), &());
//! assert!(a.iter().all(|a| a.digits() > 14.0));
//!
//! // A load that was weighed to a gram leaves three digits.
//! let arm = Arm { elbow, load: Bounded::measured(2.0, 1e-3), l }.kernel()?;
//! let a = arm.acceleration(Bounded::exact(0.0), &exact(&q), &exact(&z), &());
//! assert!(a.iter().all(|a| (2.0..4.0).contains(&a.digits())));
//! # Ok(())
//! # }
//! ```
//!
//! # What is bounded
//!
//! Running error analysis (J. H. Wilkinson; N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
//! section 3.3): each operation carries the bounds of its operands on, as they are, and adds its own rounding.
//! Correlations are forgotten, so a bound is the worst case over all signs of errors.
//!
//! - Sums add the rounding that they made, which is a floating-point number (Knuth's TwoSum), products with powers of
//!   two none: what is exact in floating point stays exact here. Other operations add half a unit in the last place.
//! - Elementary functions are taken to be within one unit in the last place (sine and cosine together), four
//!   (hyperbolic functions) or two (all others). The largest errors known of the libraries in use are 2.3 and below 1
//!   (B. Gladman, V. Innocente, J. Mather & P. Zimmermann, *Accuracy of Mathematical Functions in Single, Double,
//!   Double Extended, and Quadruple Precision*).
//! - Bounds are rounded upwards, gradual underflow included. A bound is infinite where nothing is known: after
//!   overflow, after a division by a number that may be zero, and where the value itself is not finite. It is never
//!   NaN.
//! - Where a comparison is open, because the two numbers lie within their bounds, the bound covers either outcome.
//! - What the runtime leaves out of its power series, and the rounding of the coefficients of Runge–Kutta methods and
//!   of compositions, counts.
//!
//! Exact results are those of the same steps. What a method leaves out (the error of an integrator, what is left when
//! an iteration stops, the order in which rows are eliminated) is not rounding, and not in the bound. Roots, logarithms
//! and inverse functions suppose that the exact argument lies in their domain.
//!
//! # How far bounds of a run reach
//!
//! From step to step a bound grows as `e^{βLt}`, whatever the motion does. L is the norm of the Jacobian of the rates
//! with all its signs forgotten, of an oscillator its frequency ω; β is the sum of the weights `|bᵢ|` of a Runge–Kutta
//! method: 1 for [`RK4`](gauss_runtime::integrate::Tableau::RK4), 13 for the method of order 8 that `fixed_step` takes.
//! A digit is gone every `2.3/(βL)`: of an oscillator by `RK4` nothing is left after six periods, by order 8 after half
//! a period, where the run itself has lost a digit or two. So bounds are for a function at a state (a kernel,
//! `linearize`, an energy) and for some steps; check long runs against one with more digits, or with half the step.
//!
//! # What is not
//!
//! - A splitting `Scheme` (crate `gauss-exact`) holds the lengths of its kicks and drifts in `f64`. They are
//!   taken as they are: exact results are those of the method with these numbers, not with those that they round.
//! - The elliptic functions of its `FreeFlow` are for `f64` alone, so it takes no bounded
//!   numbers, and neither does `Splitting::exact`.
//!   `Splitting::discrete` does, but forgotten correlations in its iterations
//!   make bounds that hold and say little: after five steps of a top the median is 10⁹ times the error, where that of
//!   explicit methods is below a hundred times, and some thousand times when they are
//!   [`Compensated`](gauss_runtime::integrate::Compensated).
//!
//! # Inputs
//!
//! | constructor | the number is |
//! |---|---|
//! | [`Bounded::exact`] | what is stored, to the last bit |
//! | [`Bounded::rounded`] | rounded when it was stored, as 0.1 is |
//! | [`Bounded::measured`] | known up to a given distance |
//!
//! The functions [`exact`], [`rounded`] and [`measured`] do the same to all numbers of a vector, a rotation, a pose, a
//! body or a pair of them. Of a unit quaternion they take the four components as they are; formulas that agree for unit
//! quaternions only agree up to its norm, so compare them with [`rounded`].

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod arithmetic;
mod float;
mod functions;
mod lift;
mod number;

pub use float::Float;
pub use lift::{Lift, exact, measured, rounded};
pub use number::Bounded;

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
