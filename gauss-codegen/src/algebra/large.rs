//! Fractions that 64-bit integers do not hold.
//!
//! Each distinct one is kept once for the life of the process, so that a coefficient stays two words that are copied
//! freely, and equal coefficients are equal words. They are rare: they arise where dozens of literals or high powers
//! are multiplied out.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

/// Numerators and denominators up to this length are exact: products of a hundred literals of three digits.
const EXACT_BITS: u64 = 1024;

/// Binary digits that are left of longer ones. Rounding by 2⁻²⁵⁶ is sixty decimal places below that of double
/// precision. A sum that would be zero in exact arithmetic becomes a few such units instead, which the check of a
/// system takes for the zero that it is.
const ROUNDED_BITS: i64 = 256;

/// Powers of two between which numbers are numbers: four times the exponents of double precision, for what comes back
/// into them.
const RANGE: i64 = 4096;

/// All that were ever needed, by index and by value.
#[derive(Default)]
struct FractionTable {
    values: Vec<&'static BigRational>,
    index: Option<HashMap<&'static BigRational, i64>>,
}

static KEPT: Mutex<FractionTable> = Mutex::new(FractionTable { values: Vec::new(), index: None });

/// The index of a fraction.
pub fn keep(value: BigRational) -> i64 {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(&known) = kept.index.get_or_insert_default().get(&value) {
        return known;
    }
    let value: &'static BigRational = Box::leak(Box::new(value));
    let next = kept.values.len() as i64;
    kept.values.push(value);
    kept.index.get_or_insert_default().insert(value, next);
    next
}

/// The fraction of an index.
pub fn kept(index: i64) -> &'static BigRational {
    KEPT.lock().unwrap_or_else(PoisonError::into_inner).values[index as usize]
}

/// The fraction itself, or the nearest one of bounded length; `None` beyond any use in double precision.
pub fn bounded(value: BigRational) -> Option<BigRational> {
    let length = |n: &BigInt| n.bits() as i64;
    let exponent = length(value.numer()) - length(value.denom());
    if exponent.abs() > RANGE {
        return None;
    }
    if value.numer().bits().max(value.denom().bits()) <= EXACT_BITS {
        return Some(value);
    }
    let shift = ROUNDED_BITS - exponent;
    Some(scaled(&value, shift).round() * power_of_two(-shift))
}

/// The leading digits of a fraction as a sum of `count` terms m·2ⁿ with 62-bit m, the largest first.
pub fn leading_terms(value: &BigRational, count: usize) -> Vec<(i64, i64)> {
    let mut rest = value.clone();
    let mut terms = Vec::new();
    while terms.len() < count && *rest.numer() != BigInt::ZERO {
        let exponent = rest.numer().bits() as i64 - rest.denom().bits() as i64 - 61;
        let mantissa = scaled(&rest, -exponent).trunc();
        rest -= &mantissa * power_of_two(exponent);
        // Below 2^62 by the choice of the exponent.
        let Ok(mantissa) = i64::try_from(mantissa.numer()) else { break };
        terms.push((mantissa, exponent));
    }
    terms
}

fn scaled(value: &BigRational, exponent: i64) -> BigRational {
    value * power_of_two(exponent)
}

fn power_of_two(exponent: i64) -> BigRational {
    let power = BigInt::from(BigUint::from(1_u8) << exponent.unsigned_abs());
    let one = BigInt::from(1);
    if exponent < 0 { BigRational::new_raw(one, power) } else { BigRational::new_raw(power, one) }
}
