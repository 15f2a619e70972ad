//! Beginning of a run: fewer and longer steps of a Runge–Kutta method than are wanted, and states between their ends by
//! Hermite's polynomial through all of these.
//!
//! A step of an Adams method is a third of what a Runge–Kutta method of order 8 needs for the same error, so two or
//! three are one of the latter: 12 evaluations, and one for each state between. The polynomial through m + 1 ends and
//! the derivatives there is wrong by `h^(2m+2) y^(2m+2)/(2m+2)! Π(t − tᵢ)²`: the steps at either end are short, because
//! there the product is largest.

use super::formula::MOST;
use crate::configuration::Configuration;
use crate::integrate::drive::fixed::Advanced;
use crate::integrate::drive::projection::accept;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::runge_kutta::components::{ComponentsOf, Point, RungeKutta};
use crate::integrate::runge_kutta::tableau::{DormandPrince5, DormandPrince8};
use crate::integrate::step::checks::check_chart;
use crate::integrate::step::one_step::OneStep;
use crate::real::Real;
use crate::system::GaussSystem;

/// Ends of the long steps, with that of none.
const ENDS: usize = 7;

/// A state between: what it is made of the states at the ends and the derivatives there.
#[derive(Clone, Copy)]
struct InterpolatedState {
    /// Number of short steps from the start.
    at: usize,
    /// The end next to it.
    near: usize,
    /// Weights of the differences of all ends from that.
    values: [f64; ENDS],
    /// Weights of the derivatives, for steps of length 1.
    slopes: [f64; ENDS],
}

/// The first states of an Adams method of K steps.
pub(super) struct Beginning<const K: usize>;

impl<const K: usize> Beginning<K> {
    /// Lengths of the steps, K − 1 altogether. Methods of few steps begin with as many of a method of order 5.
    const LENGTHS: &'static [usize] = match K {
        6 => &[1, 2, 2],
        7 => &[2, 2, 2],
        8 => &[2, 3, 2],
        9 => &[2, 2, 2, 2],
        10 => &[2, 3, 2, 2],
        11 => &[2, 2, 2, 2, 2],
        12 => &[2, 2, 2, 2, 2, 1],
        _ => &[],
    };

    /// Short steps until the ends.
    const NODES: [usize; ENDS] = {
        let (mut nodes, mut i) = ([0; ENDS], 0);
        while i < Self::LENGTHS.len() {
            nodes[i + 1] = nodes[i] + Self::LENGTHS[i];
            i += 1;
        }
        nodes
    };

    /// The states between, and how many there are.
    const BETWEEN: ([InterpolatedState; MOST], usize) = {
        let ends = Self::LENGTHS.len() + 1;
        let none = InterpolatedState { at: 0, near: 0, values: [0.0; ENDS], slopes: [0.0; ENDS] };
        let (mut all, mut count, mut at, mut end) = ([none; MOST], 0, 1, 1);
        while end < ends {
            if at == Self::NODES[end] {
                end += 1;
            } else {
                let mut between = InterpolatedState { at, near: end - 1, ..none };
                let mut i = 0;
                while i < ends {
                    (between.values[i], between.slopes[i]) = Self::weights(at, i);
                    i += 1;
                }
                between.values[between.near] = 0.0;
                (all[count], count) = (between, count + 1);
            }
            at += 1;
        }
        (all, count)
    };

    /// Weights of the value and of the slope at an end, in Hermite's polynomial: `(1 − 2(t − tᵢ)ℓᵢ′(tᵢ)) ℓᵢ²` and `(t −
    /// tᵢ) ℓᵢ²`.
    const fn weights(at: usize, i: usize) -> (f64, f64) {
        let (t, own) = (at as f64, Self::NODES[i] as f64);
        let (mut lagrange, mut slope, mut j) = (1.0, 0.0, 0);
        while j <= Self::LENGTHS.len() {
            let other = Self::NODES[j] as f64;
            if j != i {
                lagrange *= (t - other) / (own - other);
                slope += 1.0 / (own - other);
            }
            j += 1;
        }
        ((1.0 - 2.0 * (t - own) * slope) * lagrange * lagrange, (t - own) * lagrange * lagrange)
    }
}

/// A state, and the derivatives there.
type StateWithRates<S> = (State<S>, Rates<S>);

/// The first K − 1 states of a run, and the derivatives there.
pub struct StartingStates<S: GaussSystem, const K: usize>([StateWithRates<S>; MOST]);

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<S: GaussSystem, const K: usize> Clone for StartingStates<S, K> {
    fn clone(&self) -> Self {
        Self(self.0)
    }
}

impl<S: GaussSystem, const K: usize> StartingStates<S, K> {
    /// Whether a run of so many steps begins so.
    pub fn serves(steps: u64) -> bool {
        !S::CONSTRAINED && !Beginning::<K>::LENGTHS.is_empty() && steps >= K as u64
    }

    /// After steps of length h.
    ///
    /// # Errors
    /// Where long steps lead nowhere. Short ones may, or tell how far one gets.
    pub fn of<P: Problem<System = S>>(
        problem: &P,
        start: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Self, IntegrationErrorKind> {
        ahead::<S, P, K>(problem, start, rates, h).map(Self)
    }

    /// The end of one more step after so many.
    pub fn after(&self, made: usize) -> StateWithRates<S> {
        self.0[made]
    }
}

fn ahead<S: GaussSystem, P: Problem<System = S>, const K: usize>(
    problem: &P,
    start: &State<S>,
    rates: &Rates<S>,
    h: S::Scalar,
) -> Result<[StateWithRates<S>; MOST], IntegrationErrorKind> {
    let number = |n: usize| S::Scalar::from_f64(n as f64);
    let time = |n: usize| number(n).fma(h, start.t);
    let mut ahead = [(*start, *rates); MOST];
    let at_start = Point { components: start.q.components(), variables: start.y };
    let mut ends = [at_start; ENDS];
    let mut derivatives = [point::<S>(&start.q, rates); ENDS];
    let begun = (start, rates);
    let (mut state, mut rates) = (*start, *rates);
    for (i, &length) in Beginning::<K>::LENGTHS.iter().enumerate() {
        let node = Beginning::<K>::NODES[i + 1];
        let (mut next, known) = begin::<S, P, K>(problem, &state, &rates, number(length) * h)?;
        next.t = time(node);
        rates = accept(problem, (&state, &rates), &mut next, known)?;
        state = next;
        ahead[node - 1] = (state, rates);
        ends[i + 1] = Point { components: state.q.components(), variables: state.y };
        derivatives[i + 1] = point::<S>(&state.q, &rates);
    }
    let (between, count) = &Beginning::<K>::BETWEEN;
    for InterpolatedState { at, near, values, slopes } in &between[..*count] {
        let mut change = Point::zero();
        for end in 0..=Beginning::<K>::LENGTHS.len() {
            let difference = ends[end].add_scaled(-S::Scalar::one(), &ends[*near]);
            change = change.add_scaled(S::Scalar::from_f64(values[end]), &difference);
            change = change.add_scaled(S::Scalar::from_f64(slopes[end]) * h, &derivatives[end]);
        }
        let Point { components, variables } = ends[*near].add_scaled(S::Scalar::one(), &change);
        let q = S::Configuration::from_components(&components).renormalise();
        let mut state = State { t: time(*at), q, y: variables };
        check_chart(problem.system(), start, &state)?;
        let rates = accept(problem, begun, &mut state, None)?;
        ahead[*at - 1] = (state, rates);
    }
    Ok(ahead)
}

/// A step by the method that begins runs, of at least the order that K needs as far as there is one.
///
/// # Errors
/// When it cannot be made.
pub fn begin<S: GaussSystem, P: Problem<System = S>, const K: usize>(
    problem: &P,
    state: &State<S>,
    rates: &Rates<S>,
    h: S::Scalar,
) -> Result<Advanced<S>, IntegrationErrorKind> {
    let step = if K > 5 {
        RungeKutta(DormandPrince8).step(problem, state, rates, h)
    } else {
        RungeKutta(DormandPrince5).step(problem, state, rates, h)
    };
    step.map(|step| (step.state, step.rates))
}

/// The derivatives at a state in the space of steps.
#[inline(always)]
pub fn point<S: GaussSystem>(q: &S::Configuration, rates: &Rates<S>) -> Point<ComponentsOf<S>, S::Speeds> {
    Point { components: q.component_rates(&rates.configuration), variables: rates.variables }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hermite's polynomial is exact for powers up to 2m + 1; of the next one `Π(t − tᵢ)²` is left. Each weight, of a
    /// size up to `size`, and each sum is rounded, some hundred times in all.
    #[test]
    fn states_between_are_those_of_polynomials() {
        fn check<const K: usize>() -> f64 {
            let ends = &Beginning::<K>::NODES[..=Beginning::<K>::LENGTHS.len()];
            assert_eq!(ends.last(), Some(&(K - 1)));
            let (between, count) = &Beginning::<K>::BETWEEN;
            assert_eq!(count + ends.len(), K);
            let power = |t: usize, n: usize| (t as f64).powi(n as i32);
            let mut largest = 0.0_f64;
            for InterpolatedState { at, near, values, slopes } in &between[..*count] {
                for n in 0..=2 * ends.len() {
                    let (mut value, mut size) = (power(ends[*near], n), power(K - 1, n));
                    for (i, &end) in ends.iter().enumerate() {
                        let slope = if n == 0 { 0.0 } else { n as f64 * power(end, n - 1) };
                        let parts = [values[i] * (power(end, n) - power(ends[*near], n)), slopes[i] * slope];
                        value += parts[0] + parts[1];
                        size += parts[0].abs() + parts[1].abs();
                    }
                    let product: f64 = ends.iter().map(|&end| (*at as f64 - end as f64).powi(2)).product();
                    let left = if n == 2 * ends.len() { product } else { 0.0 };
                    let error = (power(*at, n) - value - left).abs();
                    assert!(error <= 128.0 * f64::EPSILON * size, "{K} steps, state {at}, power {n}: {error:e}");
                    let factorial: f64 = (1..=2 * ends.len()).map(|k| k as f64).product();
                    largest = largest.max(product / factorial);
                }
            }
            largest
        }
        check::<6>();
        check::<7>();
        check::<8>();
        check::<9>();
        assert!((0.010..0.0105).contains(&check::<10>()));
        check::<11>();
        check::<12>();
    }
}
