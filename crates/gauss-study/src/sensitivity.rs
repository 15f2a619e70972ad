//! Which parameter matters: Sobol' indices of a result, from the runs of [`Plan::Saltelli`](crate::Plan::Saltelli).

/// Share of a parameter in the variance of a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// The share that would go if the parameter were known: by itself.
    pub first: f64,
    /// The share that would stay if all others were known: with all its interactions.
    pub total: f64,
    /// Standard errors of both, as if points were independent; those of a Sobol' sequence are closer.
    pub errors: [f64; 2],
}

/// The indices of each parameter, from one result of all runs in the order of their numbers: groups of A, A with a
/// parameter of B for each, and B, as of [`Plan::Saltelli`](crate::Plan::Saltelli).
///
/// First order by Saltelli and others (2010), (b) of table 2, about the mean of all runs; total by Jansen (1999), (f);
/// the variance is that of A and B. SALib forms the same. Groups in which a value is missing are left out.
///
/// Nothing is returned where less than two groups are whole, or where the result does not vary.
#[must_use]
pub fn sobol_indices(values: &[Option<f64>], parameters: usize) -> Option<Vec<Index>> {
    let groups: Vec<Vec<f64>> =
        values.chunks_exact(parameters + 2).filter_map(|group| group.iter().copied().collect()).collect();
    if groups.len() < 2 || parameters == 0 {
        return None;
    }
    let ends = || groups.iter().flat_map(|group| [group[0], group[parameters + 1]]);
    let count = 2.0 * groups.len() as f64;
    let mean_of_ends = ends().sum::<f64>() / count;
    let variance = ends().map(|value| (value - mean_of_ends).powi(2)).sum::<f64>() / count;
    let mean = groups.iter().flatten().sum::<f64>() / (groups.len() * (parameters + 2)) as f64;
    // What is left of equal values is their rounding.
    let rounding = count * f64::EPSILON * mean.abs();
    if variance.is_nan() || variance <= rounding * rounding {
        return None;
    }
    let of = |parameter: usize| {
        let first = mean_and_error(groups.iter().map(|group| {
            let (a, mixed, b) = (group[0], group[parameter + 1], group[parameters + 1]);
            (b - mean) * (mixed - a) / variance
        }));
        let total =
            mean_and_error(groups.iter().map(|group| 0.5 * (group[0] - group[parameter + 1]).powi(2) / variance));
        Index { first: first.0, total: total.0, errors: [first.1, total.1] }
    };
    Some((0..parameters).map(of).collect())
}

/// The mean of some numbers, two at least, and its standard error.
fn mean_and_error(numbers: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = numbers.clone().count() as f64;
    let mean = numbers.clone().sum::<f64>() / count;
    let squares = numbers.map(|number| (number - mean).powi(2)).sum::<f64>();
    (mean, (squares / (count - 1.0) / count).sqrt())
}
