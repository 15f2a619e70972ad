//! The range of an axis, and the numbers at it.

use std::ops::Range;

/// From the least to the largest number, and a little more.
#[derive(Clone, Copy)]
pub struct Axis {
    low: f64,
    high: f64,
}

impl Axis {
    /// Axis for all numbers that are finite, with a margin of this part of their range.
    pub fn of<'a>(numbers: impl IntoIterator<Item = &'a f64>, margin: f64) -> Self {
        // Beyond this differences overflow.
        let drawn = numbers.into_iter().copied().filter(|number| number.abs() < 1e300);
        let (low, high) = drawn.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            return Self { low: -1.0, high: 1.0 };
        }
        // Of what hardly changes, or does so by rounding, a band with few digits; of a zero, one.
        let largest = low.abs().max(high.abs());
        let least = if largest > 0.0 { (1e-9 * largest).max(1e-300) } else { 1.0 };
        let margin = if high - low < least { least } else { margin * (high - low) };
        Self { low: low - margin, high: high + margin }
    }

    pub fn range(&self) -> Range<f64> {
        self.low..self.high
    }

    /// A number at the axis, with the digits that tell ticks apart.
    pub fn label(&self, value: f64) -> String {
        let (span, largest) = (self.high - self.low, self.low.abs().max(self.high.abs()));
        let digits = |of: f64| (2.0 - of.log10().floor()).clamp(0.0, 15.0) as usize;
        let text = if (1e-3..1e6).contains(&largest) {
            let text = format!("{value:.*}", digits(span));
            shortened(&text).to_owned()
        } else {
            let text = format!("{value:.*e}", digits(span / largest));
            match text.split_once('e') {
                // A tick at zero is a sum of steps: what is left of their rounding is not written.
                _ if value.abs() < 1e-9 * span => "0".to_owned(),
                Some((mantissa, exponent)) => format!("{}e{exponent}", shortened(mantissa)),
                None => text,
            }
        };
        if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
    }
}

fn shortened(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(numbers: [f64; 2], values: [f64; 3]) -> [String; 3] {
        let axis = Axis::of(&numbers, 0.04);
        values.map(|value| axis.label(value))
    }

    #[test]
    fn numbers_are_short_and_different() {
        assert_eq!(labels([0.0, 10.0], [0.0, 2.5, 10.0]), ["0", "2.5", "10"]);
        assert_eq!(labels([-1e-6, 1e-6], [-5e-7, 1e-25, 1e-6]), ["−5e−7", "0", "1e−6"]);
        assert_eq!(labels([4.9999, 5.0001], [4.9999, 5.0, 5.0001]), ["4.9999", "5", "5.0001"]);
        assert_eq!(labels([1e8, 2e8], [1e8, 1.5e8, 2e8]), ["1e8", "1.5e8", "2e8"]);
        assert_eq!(labels([0.3, 0.3], [0.3, 0.3 + 3e-10, 0.3 - 1e-10]), ["0.3", "0.3000000003", "0.2999999999"]);
    }

    #[test]
    fn every_axis_has_a_width() {
        for numbers in [[0.0, 0.0], [f64::NAN, f64::INFINITY], [1e305, 1.0], [1e-320, 1e-320], [1e299, -1e299]] {
            let Range { start, end } = Axis::of(&numbers, 0.04).range();
            assert!(start < end && (end - start).is_finite(), "{numbers:?}: {start} {end}");
        }
    }
}
