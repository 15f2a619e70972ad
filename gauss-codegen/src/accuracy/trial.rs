//! The loss of programs at sample states: their error beside results in 106 binary digits, in units of what a change of
//! every input and parameter in its last place does to these.

use crate::algebra::{Doubled, Evaluation, Expr, Function, Map, Number, Scalar};
use crate::program::Code;

use super::random::Random;
use super::tape::Tape;

/// A state where a function, or a derivative (`None`), loses much that another form of it keeps.
pub struct DecidingState {
    pub function: Option<usize>,
    pub point: Point,
}

/// Relative change of inputs: far above 2⁻¹⁰⁴, and so little that results change in proportion.
const CHANGE: f64 = 1.0 / (1_u64 << 30) as f64;
/// Changes of all inputs at once, each by something else.
const CHANGES: u64 = 2;

/// One state: what a kernel is given, the same without its rounding, and with every number changed a little.
#[derive(Clone)]
pub struct Point {
    given: Map<u32, f64>,
    exact: Map<u32, Doubled>,
    changed: Vec<Map<u32, Doubled>>,
}

impl Point {
    /// Symbols, numbers that tell how they are changed, and their values. Those of each of `units` are scaled to have
    /// the norm 1; `definitions` are symbols that stand for expressions of the others.
    pub fn new<'g>(values: &[(u32, u64, f64)], units: &[Vec<Expr<'g>>], definitions: &Map<u32, Expr<'g>>) -> Self {
        let whole = |mut point: Map<u32, Doubled>| {
            for unit in units {
                let norm = norm(unit, &point);
                for symbol in unit {
                    if let Some(value) = point.get_mut(&symbol.key()) {
                        *value = *value / norm;
                    }
                }
            }
            let mut evaluation = Evaluation::new(&point);
            let defined: Vec<_> = definitions.iter().map(|(&key, e)| (key, evaluation.value(*e))).collect();
            point.extend(defined);
            point
        };
        let exact = whole(values.iter().map(|&(key, _, value)| (key, Doubled::number(value))).collect());
        let change =
            |n: u64| whole(values.iter().map(|&(key, name, _)| (key, exact[&key] * factor(name, n))).collect());
        Self {
            given: exact.iter().map(|(&key, value)| (key, value.to_f64())).collect(),
            changed: (0..CHANGES).map(change).collect(),
            exact,
        }
    }
}

fn norm(unit: &[Expr<'_>], point: &Map<u32, Doubled>) -> Doubled {
    let squares = unit.iter().map(|symbol| point[&symbol.key()] * point[&symbol.key()]);
    squares.fold(Doubled::number(0.0), |sum, square| sum + square).call(Function::Sqrt)
}

/// 1 and a change of the mean square one, which depends on the number of the symbol and on that of the change. Changes
/// of one size would leave out what two of them cancel in. What a program computes from numbers of the scene is not
/// changed by itself: 1.1² and 1.1/2 change together, or not at all, where the scene has 1.1.
fn factor(place: u64, n: u64) -> Doubled {
    let share = 2.0 * Random::new(place.wrapping_mul(CHANGES).wrapping_add(n)).fraction() - 1.0;
    Doubled::number(1.0) + Doubled::number(CHANGE * 3.0_f64.sqrt() * share)
}

/// Exact values of a function at one state, and the effect of a change of everything in its last place on them.
struct ReferenceValues {
    values: Vec<Doubled>,
    units: Vec<f64>,
}

/// Losses of one function at all states where it has a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loss(pub Vec<f64>);

impl Loss {
    /// The largest; zero of none.
    pub fn worst(&self) -> f64 {
        self.0.iter().copied().fold(0.0, f64::max)
    }

    /// The one in the middle; zero of none.
    pub fn median(&self) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }

    /// Whether a program of that loss may be replaced by one of this, whose sums are in another order.
    pub fn keeps(&self, before: &Self) -> bool {
        self.0.iter().zip(&before.0).all(|(loss, before)| *loss <= REORDERED * before.max(1.0))
    }

    /// Whether nobody needs to pay for more.
    pub fn is_tolerable(&self) -> bool {
        self.is_within(TOLERABLE)
    }

    fn is_within(&self, tolerable: f64) -> bool {
        self.worst() <= tolerable && self.median() <= ORDINARY
    }
}

/// Sample states at which programs are tried.
#[derive(Default)]
pub struct Trial {
    points: Vec<Point>,
    /// The only functions that are tried at the last of them, `None` of derivatives, and which of them is tried now.
    deciding: Vec<Option<usize>>,
    function: Option<usize>,
    /// Number of constants that have their values.
    defined: usize,
}

impl Trial {
    pub fn new(points: Vec<Point>) -> Self {
        Self { points, ..Self::default() }
    }

    /// Adds states where one function each is tried as well.
    pub fn with(mut self, deciding: &[DecidingState]) -> Self {
        self.deciding = deciding.iter().map(|deciding| deciding.function).collect();
        self.points.extend(deciding.iter().map(|deciding| deciding.point.clone()));
        self
    }

    /// From here on programs of that function are tried, or those of derivatives.
    pub fn begin(&mut self, function: Option<usize>) {
        self.function = function;
    }

    /// Whether a state that was sought for a function or for derivatives decides for what is tried now: derivatives
    /// have the states of all functions where they have none of their own.
    fn decides(&self, sought: Option<usize>) -> bool {
        sought == self.function || self.function.is_none() && !self.deciding.contains(&None)
    }

    /// Whether derivatives are tried, also at states that were sought.
    pub fn decides_derivatives(&self) -> bool {
        self.function.is_none() && !self.deciding.is_empty()
    }

    /// Computes constants, symbols and what they stand for, beyond those that are known.
    pub fn define<'g>(&mut self, constants: &[(Expr<'g>, Expr<'g>)]) {
        let fresh = &constants[self.defined..];
        self.defined = constants.len();
        if fresh.is_empty() {
            return;
        }
        for point in &mut self.points {
            define_in(&mut point.given, fresh);
            define_in(&mut point.exact, fresh);
            point.changed.iter_mut().for_each(|changed| define_in(changed, fresh));
        }
    }

    /// The same of constants that a program computes from parameters.
    pub fn compute(&mut self, symbols: &[Expr<'_>], program: &Code<Expr<'_>>) {
        let (tape, keys): (Tape, Vec<u32>) = (Tape::new(program), symbols.iter().map(|symbol| symbol.key()).collect());
        for point in &mut self.points {
            compute_in(&mut point.given, &tape, &keys);
            compute_in(&mut point.exact, &tape, &keys);
            point.changed.iter_mut().for_each(|changed| compute_in(changed, &tape, &keys));
        }
    }

    /// Compares programs that should compute the same functions with a reference: the best of these programs, run in
    /// 106 binary digits. The reference has 53 digits more than the programs, so it may lose nearly 53 before its error
    /// counts; where it loses more, another program becomes the reference.
    pub fn tried(&self, programs: &[&Code<Expr<'_>>]) -> TrialResult {
        let tapes: Vec<Tape> = programs.iter().map(|program| Tape::new(program)).collect();
        let mut best = 0;
        let mut tried = self.tried_beside(&tapes, best);
        // Of a form that loses nearly everything the longer numbers are not sure either.
        for _ in 1..tapes.len() {
            let losses = &tried.losses;
            let least = (0..tapes.len()).min_by(|&a, &b| losses[a].worst().total_cmp(&losses[b].worst()));
            let Some(least) = least.filter(|&least| least != best && losses[best].worst() > UNSURE) else { break };
            best = least;
            tried = self.tried_beside(&tapes, best);
        }
        tried
    }

    fn tried_beside(&self, tapes: &[Tape], reference: usize) -> TrialResult {
        let mut tried = TrialResult { losses: vec![Loss::default(); tapes.len()], there: Vec::new(), samples: 0 };
        let samples = self.points.len() - self.deciding.len();
        for (k, point) in self.points.iter().enumerate() {
            if k >= samples && !self.decides(self.deciding[k - samples]) {
                continue;
            }
            let found: Vec<Vec<f64>> = tapes.iter().map(|tape| tape.run(&point.given)).collect();
            let Some(expected) = point.reference(&tapes[reference], &found) else { continue };
            tried.losses.iter_mut().zip(&found).for_each(|(loss, found)| loss.0.push(expected.loss_of(found)));
            tried.there.push((k, expected));
            tried.samples += usize::from(k < samples);
        }
        tried
    }

    /// The loss of another program that should compute the same as those that were tried.
    pub fn loss_of(&self, tried: &TrialResult, program: &Code<Expr<'_>>) -> Loss {
        let tape = Tape::new(program);
        let loss = |(k, expected): &(usize, ReferenceValues)| expected.loss_of(&tape.run(&self.points[*k].given));
        Loss(tried.there.iter().map(loss).collect())
    }
}

/// Programs that were tried.
pub struct TrialResult {
    pub losses: Vec<Loss>,
    /// States where there is a value, by their numbers, with what it should be.
    there: Vec<(usize, ReferenceValues)>,
    /// Number of them that are sample states.
    samples: usize,
}

impl TrialResult {
    /// Which programs may be taken.
    pub fn usable(&self) -> Vec<bool> {
        usable(&self.losses)
    }

    /// Without the programs that are not among those.
    pub fn only(mut self, those: &[bool]) -> Self {
        let mut those = those.iter();
        self.losses.retain(|_| those.next().is_some_and(|&is| is));
        self
    }

    fn sampled(&self) -> Vec<Loss> {
        self.losses.iter().map(|loss| Loss(loss.0[..self.samples].to_vec())).collect()
    }

    /// Chooses one of the programs with their costs: by all states, unless that costs more than [`DEAR`] times the
    /// choice by the sample states.
    pub fn taken(&self, costs: &[u32]) -> usize {
        let ordinary = taken(&self.sampled(), costs);
        if self.samples == self.there.len() {
            return ordinary;
        }
        let affordable: Vec<usize> = (0..costs.len()).filter(|&k| costs[k] <= DEAR * costs[ordinary]).collect();
        let losses: Vec<Loss> = affordable.iter().map(|&k| self.losses[k].clone()).collect();
        let costs: Vec<u32> = affordable.iter().map(|&k| costs[k]).collect();
        let best = taken(&losses, &costs);
        // Of those that cost the same, what is lost least at the states that were sought.
        let lost = |k: usize| losses[k].0[self.samples..].iter().copied().fold(0.0, f64::max);
        let ties = usable(&losses).into_iter().enumerate().filter(|&(k, usable)| usable && costs[k] == costs[best]);
        let least = ties.map(|(k, _)| k).min_by(|&a, &b| lost(a).total_cmp(&lost(b)));
        affordable[least.filter(|&k| lost(k) < lost(best)).unwrap_or(best)]
    }
}

/// Ratio to the loss of the best that a program may have at a state, and the loss that may be had anyhow. The errors of
/// n roundings that do not amplify each other add up to some √n, and now and then to the one or to n: of programs of up
/// to a thousand operations two that are equally good differ by that much, and at the next state the other way round.
const FACTOR: f64 = 32.0;
/// The same of a program whose sums are in another order: each partial sum is bounded by three that were rounded
/// before, and is rounded itself.
const REORDERED: f64 = 4.0;
/// Results below this share of the error of double precision vanish identically: of terms whose roundings are 2⁻⁵³,
/// those of 106 digits are 2⁻⁷⁴ of a change, and some of either are small by chance.
const VANISHING: f64 = 1.0 / 1024.0;

/// Three decimal places may go at an extreme state where keeping them costs a quarter more: nobody pays for them who
/// has ordinary numbers. One may at half of the states: where more do, it is the scene that is extreme, not the state.
/// Where keeping them costs [`DEAR`] times as much, some more may go.
const TOLERABLE: f64 = 1e3;
const TOLERABLE_WHERE_DEAR: f64 = 1e5;
const ORDINARY: f64 = 10.0;

/// Largest ratio of costs of a form that keeps digits at a state that was sought, where nearly all are lost otherwise.
const DEAR: u32 = 2;

/// The program that is taken of those with these costs: the cheapest that keeps the digits; or, where that is dear, the
/// cheapest whose loss is tolerable.
fn taken(losses: &[Loss], costs: &[u32]) -> usize {
    let cheapest = |flags: Vec<bool>| {
        let allowed = costs.iter().zip(flags).enumerate().filter(|(_, (_, allowed))| *allowed);
        allowed.map(|(k, (cost, _))| (k, *cost)).min_by_key(|(_, cost)| *cost)
    };
    let within = |tolerable: f64| cheapest(losses.iter().map(|loss| loss.is_within(tolerable)).collect());
    let (best, cost) = cheapest(accurate(losses)).expect("a function has at least one arrangement");
    match (within(TOLERABLE), within(TOLERABLE_WHERE_DEAR)) {
        (Some((other, less)), _) if 5 * less < 4 * cost => other,
        (_, Some((other, less))) if DEAR * less < cost => other,
        _ => best,
    }
}

/// Which programs may be taken.
fn usable(losses: &[Loss]) -> Vec<bool> {
    accurate(losses).into_iter().zip(losses).map(|(accurate, loss)| accurate || loss.is_tolerable()).collect()
}

/// Which programs keep the digits: at every state not much more is lost than by the best there. Where each of them
/// loses somewhere what another keeps, those that come closest, within the same factor.
fn accurate(losses: &[Loss]) -> Vec<bool> {
    let states = losses.first().map_or(0, |loss| loss.0.len());
    let least = |state: usize| losses.iter().map(|loss| loss.0[state]).fold(f64::INFINITY, f64::min);
    let allowed: Vec<f64> = (0..states).map(|state| FACTOR * least(state).max(1.0)).collect();
    let excess = |loss: &Loss| loss.0.iter().zip(&allowed).map(|(loss, allowed)| loss / allowed).fold(0.0, f64::max);
    let excesses: Vec<f64> = losses.iter().map(excess).collect();
    let limit = match excesses.iter().copied().fold(f64::INFINITY, f64::min) {
        least if least <= 1.0 => 1.0,
        least => FACTOR * least,
    };
    excesses.into_iter().map(|excess| excess <= limit).collect()
}

/// The loss from which on a form is no reference.
const UNSURE: f64 = (1_u64 << 30) as f64;

fn define_in<'g, N: Number>(values: &mut Map<u32, N>, constants: &[(Expr<'g>, Expr<'g>)]) {
    let mut evaluation = Evaluation::new(values);
    let known: Vec<_> = constants.iter().map(|(symbol, e)| (symbol.key(), evaluation.value(*e))).collect();
    values.extend(known);
}

fn compute_in<N: Number>(values: &mut Map<u32, N>, tape: &Tape, symbols: &[u32]) {
    let computed = tape.run(values);
    values.extend(symbols.iter().copied().zip(computed));
}

impl Point {
    /// Reference by one program, beside what it and others found in double precision; `None` where the function has no
    /// value.
    fn reference(&self, tape: &Tape, found: &[Vec<f64>]) -> Option<ReferenceValues> {
        let values = tape.run(&self.exact);
        let mut squares = vec![0.0; values.len()];
        for changed in &self.changed {
            let moved = tape.run(changed);
            for (square, (moved, value)) in squares.iter_mut().zip(moved.iter().zip(&values)) {
                let change = (*moved - *value).to_f64() / CHANGE;
                *square += change * change / CHANGES as f64;
            }
        }
        let sizes = squares.into_iter().zip(&values).map(|(square, value)| value.to_f64().abs() + square.sqrt());
        let mut sizes: Vec<f64> = sizes.collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        // What vanishes whatever the numbers are has no size of its own, but that of the roundings of the longer
        // numbers.
        for (k, size) in sizes.iter_mut().enumerate() {
            let error =
                found.iter().map(|found| (Doubled::number(found[k]) - values[k]).to_f64().abs()).fold(0.0, f64::max);
            if *size <= VANISHING * error || *size == 0.0 {
                *size = largest;
            }
        }
        let units: Vec<f64> = sizes.into_iter().map(|size| f64::EPSILON * size).collect();
        let there =
            values.iter().all(|value| value.is_finite()) && units.iter().all(|unit| unit.is_finite() && *unit > 0.0);
        there.then_some(ReferenceValues { values, units })
    }
}

impl ReferenceValues {
    fn loss_of(&self, found: &[f64]) -> f64 {
        let loss = |((found, value), unit): ((&f64, &Doubled), &f64)| {
            let error = (Doubled::number(*found) - *value).to_f64().abs();
            if error.is_nan() {
                f64::INFINITY
            } else if error == 0.0 {
                0.0
            } else {
                error / unit
            }
        };
        found.iter().zip(&self.values).zip(&self.units).map(loss).fold(0.0, f64::max)
    }
}
