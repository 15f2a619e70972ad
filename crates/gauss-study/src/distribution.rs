//! Distributions from which parameters are drawn.

use serde::Serialize;

use crate::normal::{normal_probability, normal_quantile, truncated_quantile};

/// Distribution from which a parameter is drawn: made by [`fixed`], [`uniform`], [`normal`], [`truncated_normal`],
/// [`log_normal`], [`triangular`], [`list`] and [`grid`].
///
/// Each is an increasing function of one uniform number (a list: of its place), so that plans that fill the unit cube
/// evenly do so here, too. Numbers that make no distribution are refused by
/// [`Declaration::study`](crate::Declaration::study).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// The same in every run.
    Fixed {
        /// The number.
        value: f64,
    },
    /// Any number between two bounds, all alike.
    Uniform {
        /// The lower bound.
        from: f64,
        /// The upper bound.
        to: f64,
    },
    /// The normal distribution.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
    },
    /// The normal distribution between two bounds, of which mean and deviation are those before it was cut.
    TruncatedNormal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
        /// The lower bound.
        from: f64,
        /// The upper bound.
        to: f64,
    },
    /// A number whose logarithm is normal.
    LogNormal {
        /// Half of the numbers are below it.
        median: f64,
        /// The standard deviation of the natural logarithm.
        deviation: f64,
    },
    /// Between two bounds, likeliest at a third number.
    Triangular {
        /// The lower bound.
        from: f64,
        /// The likeliest number.
        mode: f64,
        /// The upper bound.
        to: f64,
    },
    /// One of some numbers, all alike.
    List {
        /// The numbers.
        values: Vec<f64>,
    },
    /// Numbers of equal distances, gone through run by run: nothing is random.
    Grid {
        /// The first number.
        from: f64,
        /// The last number.
        to: f64,
        /// Number of the values.
        count: u32,
    },
}

/// The same number in every run.
#[must_use]
pub fn fixed(value: f64) -> Distribution {
    Distribution::Fixed { value }
}

/// Any number between two bounds.
#[must_use]
pub fn uniform(from: f64, to: f64) -> Distribution {
    Distribution::Uniform { from, to }
}

/// A normal distribution by its mean and its standard deviation.
#[must_use]
pub fn normal(mean: f64, deviation: f64) -> Distribution {
    Distribution::Normal { mean, deviation }
}

/// The same between two bounds; mean and deviation are those before it was cut. One bound may be infinite.
#[must_use]
pub fn truncated_normal(mean: f64, deviation: f64, from: f64, to: f64) -> Distribution {
    Distribution::TruncatedNormal { mean, deviation, from, to }
}

/// A number whose logarithm is normal, by its median and the standard deviation of the natural logarithm.
#[must_use]
pub fn log_normal(median: f64, deviation: f64) -> Distribution {
    Distribution::LogNormal { median, deviation }
}

/// Between two bounds, likeliest at `mode`.
#[must_use]
pub fn triangular(from: f64, mode: f64, to: f64) -> Distribution {
    Distribution::Triangular { from, mode, to }
}

/// One of some numbers, all alike.
#[must_use]
pub fn list(values: impl IntoIterator<Item = f64>) -> Distribution {
    Distribution::List { values: values.into_iter().collect() }
}

/// A sweep: `count` numbers of equal distances, both ends among them. Of several sweeps the first one declared goes
/// through its numbers fastest, and all combinations come before the first is repeated.
#[must_use]
pub fn grid(from: f64, to: f64, count: u32) -> Distribution {
    Distribution::Grid { from, to, count }
}

impl Distribution {
    /// The number at `u`, between 0 and 1.
    pub(crate) fn at(&self, u: f64) -> f64 {
        match self {
            Self::Fixed { value } => *value,
            Self::Uniform { from, to } => from + u * (to - from),
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(u),
            Self::TruncatedNormal { mean, deviation, from, to } => {
                let bounds = [from, to].map(|bound| (bound - mean) / deviation);
                (mean + deviation * truncated_quantile(u, bounds)).clamp(*from, *to)
            }
            Self::LogNormal { median, deviation } => median * (deviation * normal_quantile(u)).exp(),
            Self::Triangular { from, mode, to } => {
                let (length, rise) = (to - from, mode - from);
                if u * length < rise {
                    from + (u * length * rise).sqrt()
                } else {
                    to - ((1.0 - u) * length * (to - mode)).sqrt()
                }
            }
            Self::List { values } => values[place(u, values.len())],
            Self::Grid { count, .. } => self.step(place(u, *count as usize) as u64),
        }
    }

    /// Number of the values of a sweep; none of other distributions.
    pub(crate) fn steps(&self) -> Option<u64> {
        match self {
            Self::Grid { count, .. } => Some(u64::from(*count)),
            _ => None,
        }
    }

    /// Number `k` of a sweep.
    pub(crate) fn step(&self, k: u64) -> f64 {
        match self {
            Self::Grid { from, to, count } if *count > 1 => from + (to - from) * (k as f64 / f64::from(*count - 1)),
            Self::Grid { from, .. } => *from,
            other => other.at(0.5),
        }
    }

    /// Whether few numbers are drawn, which a file keeps in a dictionary.
    pub(crate) fn has_few_values(&self) -> bool {
        matches!(self, Self::Fixed { .. } | Self::List { .. } | Self::Grid { .. })
    }

    /// Mistake in the numbers, which makes them no distribution.
    pub(crate) fn mistake(&self) -> Option<&'static str> {
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        match self {
            Self::Fixed { value } if !value.is_finite() => Some("the number should be finite"),
            Self::Uniform { from, to } if !(finite(&[*from, *to]) && from < to && (to - from).is_finite()) => {
                Some("`from` should be less than `to`, both finite")
            }
            Self::Normal { mean, deviation } if !(finite(&[*mean, *deviation]) && *deviation > 0.0) => {
                Some("mean and deviation should be finite, the deviation more than 0")
            }
            Self::TruncatedNormal { mean, deviation, .. } if !(finite(&[*mean, *deviation]) && *deviation > 0.0) => {
                Some("mean and deviation should be finite, the deviation more than 0")
            }
            Self::TruncatedNormal { mean, deviation, from, to } => cut_mistake([*mean, *deviation], [*from, *to]),
            Self::LogNormal { median, deviation }
                if !(finite(&[*median, *deviation]) && *median > 0.0 && *deviation > 0.0) =>
            {
                Some("median and deviation should be finite and more than 0")
            }
            Self::Triangular { from, mode, to }
                if !(finite(&[*from, *to]) && from < to && (from..=to).contains(&mode)) =>
            {
                Some("`from` should be less than `to`, and `mode` between them")
            }
            Self::List { values } if values.is_empty() || !finite(values) => {
                Some("a list should have one number at least, all finite")
            }
            Self::Grid { from, to, count } if !(finite(&[*from, *to]) && *count > 0) => {
                Some("a grid should have one number at least, both ends finite")
            }
            _ => None,
        }
    }
}

/// Mistake in the bounds of a truncated normal distribution: they leave nothing.
fn cut_mistake([mean, deviation]: [f64; 2], bounds: [f64; 2]) -> Option<&'static str> {
    let [from, to] = bounds;
    if from.is_nan() || to.is_nan() || from >= to {
        return Some("`from` should be less than `to`");
    }
    let [low, high] = bounds.map(|bound| (bound - mean) / deviation);
    // In the lower tail, where probabilities keep their digits.
    let (low, high) = if low > 0.0 { (-high, -low) } else { (low, high) };
    let within = normal_probability(high) - normal_probability(low);
    (within <= f64::MIN_POSITIVE).then_some("no number of the normal distribution lies between the bounds")
}

/// The place of `u` among so many equal parts.
fn place(u: f64, parts: usize) -> usize {
    ((u * parts as f64) as usize).min(parts - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means and variances by the middles of many parts: of a function with bounded slope the error is of second order
    /// in their width; those of normal distributions have tails whose outermost parts lack about their probability.
    fn moments(of: &Distribution) -> [f64; 2] {
        const PARTS: u32 = 100_000;
        let numbers = || (0..PARTS).map(|k| of.at((f64::from(k) + 0.5) / f64::from(PARTS)));
        let mean = numbers().sum::<f64>() / f64::from(PARTS);
        [mean, numbers().map(|number| (number - mean).powi(2)).sum::<f64>() / f64::from(PARTS)]
    }

    #[test]
    fn means_and_variances_are_those_of_the_textbook() {
        let s: f64 = 0.3;
        // Of the standard normal cut to [0, ∞): √(2/π), 1 − 2/π.
        let half = 2.0 / std::f64::consts::PI;
        let known = [
            (fixed(2.5), [2.5, 0.0]),
            (uniform(-1.0, 3.0), [1.0, 16.0 / 12.0]),
            (normal(2.0, 0.5), [2.0, 0.25]),
            (truncated_normal(0.0, 1.0, 0.0, f64::INFINITY), [half.sqrt(), 1.0 - half]),
            (log_normal(2.0, s), {
                let mean = 2.0 * (0.5 * s * s).exp();
                [mean, mean * mean * ((s * s).exp() - 1.0)]
            }),
            (triangular(0.0, 1.0, 4.0), [5.0 / 3.0, (16.0 + 1.0 - 4.0) / 18.0]),
            (list([1.0, 2.0, 6.0]), [3.0, 14.0 / 3.0]),
            (grid(0.0, 1.0, 5), [0.5, 0.125]),
        ];
        for (distribution, [mean, variance]) in known {
            let found = moments(&distribution);
            // The outermost of 1e5 parts has 1e-5 of the probability, at 4.4 deviations: squared 19, of which the
            // middle of the part gives all but a tenth; one part of 1e5 of a list is cut.
            assert!((found[0] - mean).abs() < 2e-5 * (1.0 + mean), "{distribution:?}: {found:?}");
            assert!((found[1] - variance).abs() < 1e-4 * (1.0 + variance), "{distribution:?}: {found:?}");
        }
    }

    #[test]
    fn numbers_that_make_no_distribution_are_refused() {
        let wrong = [
            fixed(f64::NAN),
            uniform(1.0, 1.0),
            uniform(0.0, f64::INFINITY),
            uniform(-f64::MAX, f64::MAX),
            normal(0.0, 0.0),
            normal(f64::NAN, 1.0),
            truncated_normal(0.0, -1.0, 0.0, 1.0),
            truncated_normal(0.0, 1.0, 1.0, 0.0),
            truncated_normal(0.0, 1.0, 60.0, 61.0),
            truncated_normal(0.0, 1.0, f64::NAN, 1.0),
            log_normal(0.0, 1.0),
            triangular(0.0, 2.0, 1.0),
            triangular(0.0, f64::NAN, 1.0),
            list([]),
            list([1.0, f64::INFINITY]),
            grid(0.0, 1.0, 0),
        ];
        for distribution in wrong {
            assert!(distribution.mistake().is_some(), "{distribution:?}");
        }
        assert_eq!(truncated_normal(0.0, 1.0, 37.0, 61.0).mistake(), None);
        assert_eq!(grid(2.0, 1.0, 2).mistake(), None);
    }

    #[test]
    fn a_grid_has_both_ends() {
        assert_eq!([0, 1, 2].map(|k| grid(1.0, 2.0, 3).step(k)), [1.0, 1.5, 2.0]);
        assert_eq!(grid(1.0, 2.0, 1).step(0), 1.0);
    }
}
