//! A search for the states at which programs lose most: from sample states on, by moves that make digits cancel. It is
//! the same in every run, and bounded in the number of states.

use std::ops::Range;

use crate::algebra::{Doubled, Expr, Map, Number, Scalar};
use crate::mechanics::Matter;
use crate::program::Code;

use super::figure::{Figure, NO_DIGIT};
use super::flat::{Flat, Slot, Trace, TracedNumber, unit};
use super::moves::{Draft, Move, Moves};
use super::random::Random;
use super::states::{PROFILES, Samples, States};
use super::trial::{DecidingState, Loss};

/// The programs whose losses are sought, and what they read.
pub struct LossSearchInput<'a, 'g> {
    /// Constants, computed from parameters, and their symbols.
    pub constants: &'a Code<Expr<'g>>,
    pub symbols: &'a [Expr<'g>],
    /// Constants that literals alone determine, with their definitions.
    pub folded: &'a [(Expr<'g>, Expr<'g>)],
    /// Programs with their losses at sample states, by measurement.
    pub functions: Vec<&'a Code<Expr<'g>>>,
    pub measured: Vec<&'a Loss>,
    /// Which of them gives p.
    pub momentum: Option<usize>,
    /// All functions in one program, which is tried at the states that are found, and derivatives.
    pub besides: Vec<&'a Code<Expr<'g>>>,
}

/// Figures of programs; none of those that have no value at any state.
#[derive(Default)]
pub struct LossFigures {
    pub functions: Vec<Option<Figure>>,
    pub besides: Vec<Option<Figure>>,
}

/// Forms that could be taken in place of a program, by its number in the lists of [`LossSearchInput`].
pub struct Forms<'f, 'g> {
    pub of_function: &'f dyn Fn(usize) -> Vec<Vec<Expr<'g>>>,
    /// Forms of derivatives, as programs that read parameters, not constants.
    pub of_derivative: &'f dyn Fn(usize) -> Vec<Code<Expr<'g>>>,
}

/// The largest loss so far, and where.
#[derive(Clone, Copy, Default)]
pub(super) struct Best {
    pub loss: f64,
    pub state: usize,
}

/// Steps that all states together may take, of functions and then of all derivatives, and the least and the largest
/// number of states; those of derivatives may be fewer.
const STEPS: usize = 100_000;
const LEAST: usize = 24;
const MOST: usize = 96;
/// At most a third as many states again, or so many, are those where several numbers change at once.
const OF_MANY: usize = 3;
const SOME: usize = 20;
/// The loss up to which no more is sought after half of the states: nothing cancels in these scenes.
const ORDINARY: f64 = 10.0;
/// The loss from which on other forms of a function are tried, six digits, and how many times less they have to lose:
/// what equally good programs differ by.
const MUCH: f64 = 1e6;
const LESS: f64 = 32.0;
/// Factor by which a result is smaller than its error, or than other components, at every sample state where it
/// vanishes identically.
const NOTHING: f64 = (1_u64 << 40) as f64;

/// Programs whose losses are sought: their outputs, and the steps that they take, once p is known.
struct Goal<'l> {
    lists: &'l [Vec<Slot>],
    steps: Range<usize>,
}

pub(super) struct Search<'s, 'a, 'g> {
    states: &'s States<'a, 'g>,
    moves: Moves<'s, 'a, 'g>,
    pub flat: Flat,
    /// Steps until p is known, until the functions are, and all of them.
    ends: [usize; 3],
    momenta: Vec<(Slot, Slot)>,
    pub outputs: Vec<Vec<Slot>>,
    pub besides: Vec<Vec<Slot>>,
    /// The steps of each of these.
    spans: Vec<Range<usize>>,
    /// Whether what is in a slot is a component that vanishes identically.
    vanishing: Vec<bool>,
}

impl<'s, 'g> Samples<'s, '_, 'g> {
    /// Looks for the states where functions and derivatives lose most; those of them where another form would keep what
    /// is lost.
    pub fn seek(&self, sought: &LossSearchInput<'_, 'g>, forms: &Forms<'_, 'g>) -> (LossFigures, Vec<DecidingState>) {
        let mut search = Search::new(self, sought);
        let mut traces = search.rooms();
        let (mut drafts, best) = search.searched(self, &mut traces);
        let sampled = sampled(&drafts);
        let mut ordinary: Vec<Vec<f64>> = vec![Vec::new(); search.outputs.len()];
        let mut besides: Vec<Vec<Best>> = vec![Vec::new(); search.besides.len()];
        for state in search.states_for_others(drafts.len(), sampled, &best) {
            let (of_functions, of_besides) = search.losses_at(&drafts[state], &mut traces);
            for (losses, loss) in ordinary.iter_mut().zip(of_functions) {
                losses.extend(loss.filter(|_| state < sampled));
            }
            for (losses, loss) in besides.iter_mut().zip(of_besides) {
                losses.extend(loss.map(|loss| Best { loss, state }));
            }
        }
        search.seek_for_derivatives(&mut drafts, &mut besides, &mut traces);
        let at = |state: usize| drafts.get(state).map_or(Vec::new(), |draft| search.moves.described(&draft.moves));
        let functions = best.iter().zip(ordinary).zip(&sought.measured).map(|((best, ordinary), measured)| {
            match (ordinary.is_empty(), measured.0.is_empty()) {
                (_, true) => None,
                // No sample state is one that the scene can be in.
                (true, false) => Some(Figure { worst: measured.worst(), median: measured.median(), at: Vec::new() }),
                _ => Some(Figure { worst: best.loss, median: Loss(ordinary).median(), at: at(best.state) }),
            }
        });
        let worst: Vec<Option<Best>> = besides.iter().map(|losses| worst(losses)).collect();
        let of_besides = besides.iter().zip(&worst).map(|(losses, worst)| {
            let ordinary = losses.iter().filter(|best| best.state < sampled).map(|best| best.loss).collect();
            let Best { loss, state } = (*worst)?;
            Some(Figure { worst: loss, median: Loss(ordinary).median(), at: at(state) })
        });
        let found = LossFigures { functions: functions.collect(), besides: of_besides.collect() };
        let deciding = search.deciding(&drafts, &best, &worst, forms).into_iter().map(|(function, draft)| {
            let mut values = draft.values;
            self.states.finish(&mut values);
            DecidingState { function, point: self.states.point(&values) }
        });
        (found, deciding.collect())
    }
}

/// Number of the first states that are sample states.
fn sampled(drafts: &[Draft<'_>]) -> usize {
    drafts.iter().take_while(|draft| draft.moves.is_empty()).count()
}

fn worst(losses: &[Best]) -> Option<Best> {
    losses.iter().copied().max_by(|a, b| a.loss.total_cmp(&b.loss))
}

fn is_finite(exact: &[Doubled], outputs: &[Slot]) -> bool {
    outputs.iter().all(|&slot| exact[slot as usize].is_finite())
}

impl States<'_, '_> {
    /// Positive masses, and moments of inertia that a body can have, also where they are numbers of fields.
    fn is_physical(&self, draft: &Draft<'_>) -> bool {
        self.system.scene.tree.links.iter().all(|link| match &link.matter {
            Matter::Nothing => true,
            Matter::Particle(mass) => draft.values.of(*mass) > 0.0,
            Matter::Body(body) if !body.parameters.is_empty() => true,
            Matter::Body(body) => {
                let (mass, c) = (draft.values.of(body.mass), body.center_of_mass.map(|e| draft.values.of(e)));
                let own = body.inertia.map(|row| row.map(|e| draft.values.of(e)));
                let square: f64 = c.iter().map(|c| c * c).sum();
                let about_g = |i: usize, j: usize| own[i][j] - mass * (if i == j { square } else { 0.0 } - c[i] * c[j]);
                // ∫ x xᵀ dm about G, which is positive semidefinite, but for the roundings of what is subtracted.
                let half = 0.5 * (about_g(0, 0) + about_g(1, 1) + about_g(2, 2));
                let s = |i: usize, j: usize| if i == j { half - about_g(i, i) } else { -about_g(i, j) };
                let minor = |i: usize, j: usize| s(i, i) * s(j, j) - s(i, j) * s(i, j);
                let whole = s(0, 0) * minor(1, 2) - s(0, 1) * (s(0, 1) * s(2, 2) - s(0, 2) * s(1, 2))
                    + s(0, 2) * (s(0, 1) * s(1, 2) - s(0, 2) * s(1, 1));
                let size = 1e-9 * (own[0][0] + own[1][1] + own[2][2]).abs();
                mass > 0.0
                    && (0..3).all(|i| s(i, i) >= -size)
                    && [(0, 1), (0, 2), (1, 2)].iter().all(|&(i, j)| minor(i, j) >= -size * size)
                    && whole >= -size * size * size
            }
        })
    }
}

impl<'s, 'a, 'g> Search<'s, 'a, 'g> {
    pub fn new(samples: &'s Samples<'s, 'a, 'g>, sought: &LossSearchInput<'_, 'g>) -> Self {
        let Samples { states, seen, .. } = samples;
        let mut flat = Flat::default();
        states.units.iter().for_each(|unit| flat.scale(unit));
        for (key, e) in states.definitions.iter() {
            let slot = flat.expression(*e);
            flat.define(*key, slot);
        }
        for (symbol, e) in sought.folded {
            let slot = flat.expression(*e);
            flat.define(symbol.key(), slot);
        }
        let constants = flat.program(sought.constants);
        sought.symbols.iter().zip(constants).for_each(|(symbol, slot)| flat.define(symbol.key(), slot));
        let of_momentum = sought.momentum.map(|k| (k, flat.program(sought.functions[k])));
        let known = flat.len();
        let outputs = sought.functions.iter().enumerate().map(|(k, program)| match &of_momentum {
            Some((momentum, outputs)) if *momentum == k => outputs.clone(),
            _ => flat.program(program),
        });
        let outputs = outputs.collect();
        let functions = flat.len();
        let besides = sought.besides.iter().map(|program| {
            let begun = flat.len();
            (flat.program(program), begun..flat.len())
        });
        let (besides, spans) = besides.unzip();
        let momenta = of_momentum.into_iter().flat_map(|(_, outputs)| outputs).zip(&states.system.scene.momenta);
        let momenta = momenta.filter_map(|(from, p)| Some((from, flat.input(*p)?))).collect();
        let ends = [known, functions, flat.len()];
        let vanishing = vec![false; flat.slots()];
        let moves = Moves::new(states, seen, |symbol| flat.input(symbol).is_some());
        Self { states, moves, flat, ends, momenta, outputs, besides, spans, vanishing }
    }

    /// Room for the numbers with both changes. Of many results at many states one is hardly changed by chance, and said
    /// to lose much: changed in other ways as well, it is not.
    pub fn rooms(&self) -> [Trace; 2] {
        [0, 1].map(|changes| self.flat.room(changes))
    }

    /// States and the worst of them for each function: physical samples, then those that were found.
    pub fn searched(
        &mut self,
        samples: &'s Samples<'s, 'a, 'g>,
        traces: &mut [Trace; 2],
    ) -> (Vec<Draft<'s>>, Vec<Best>) {
        let drafts = samples.values.iter().zip(&PROFILES).enumerate().map(|(k, (values, profile))| Draft {
            values: values.clone(),
            masses: vec![(k as u64 ^ 1 << 50, profile.decades); self.states.bodies().count()],
            moves: Vec::new(),
            sample: 0,
        });
        let mut drafts: Vec<Draft<'s>> = drafts.filter(|draft| self.states.is_physical(draft)).collect();
        drafts.iter_mut().enumerate().for_each(|(k, draft)| draft.sample = k);
        self.find_vanishing(&drafts, &mut traces[0]);
        let mut best: Vec<Best> = vec![Best::default(); self.outputs.len()];
        let goal = self.functions();
        for (k, draft) in drafts.iter().enumerate() {
            self.note(&goal, traces, draft, k, &mut best);
        }
        let tries = (STEPS / self.ends[1].max(1)).clamp(LEAST, MOST);
        self.search(&goal, tries, &mut drafts, &mut best, traces);
        (drafts, best)
    }

    fn functions(&self) -> Goal<'_> {
        Goal { lists: &self.outputs, steps: self.ends[0]..self.ends[1] }
    }

    /// Looks for states where programs lose more than at those that are known, so many and some.
    fn search<'n>(
        &self,
        goal: &Goal<'_>,
        tries: usize,
        drafts: &mut Vec<Draft<'n>>,
        best: &mut [Best],
        traces: &mut [Trace; 2],
    ) {
        if drafts.is_empty() || self.moves.are_none() || goal.lists.iter().all(Vec::is_empty) {
            return;
        }
        let bases = sampled(drafts);
        for change in self.moves.of_many().take((tries / OF_MANY).max(SOME.min(tries))) {
            // What links lose that are unlike depends on how they are bent.
            let from: &[usize] = if matches!(change, Move::Graded(_)) { &[0, 2, 5] } else { &[0] };
            for &base in from.iter().filter(|&&base| base < bases) {
                self.try_change(goal, (base, change), drafts, best, traces);
            }
        }
        self.climb(goal, tries, drafts, best, traces);
    }

    /// Looks for states where derivatives lose more than where functions do: where digits cancel in derivatives alone.
    fn seek_for_derivatives<'n>(
        &self,
        drafts: &mut Vec<Draft<'n>>,
        besides: &mut [Vec<Best>],
        traces: &mut [Trace; 2],
    ) {
        let derivatives = 1..self.besides.len();
        for k in derivatives.clone() {
            let goal = Goal { lists: &self.besides[k..=k], steps: self.spans[k].clone() };
            let known = drafts.len();
            let mut best = [worst(&besides[k]).unwrap_or_default()];
            let tries = (STEPS / (self.ends[0] + goal.steps.len()).max(1)).min(MOST) / derivatives.len();
            self.search(&goal, tries, drafts, &mut best, traces);
            let [Best { state, .. }] = best;
            // None of them is one that the scene can be in where no sample is.
            if let Some(draft) = drafts.get(state).filter(|_| state >= known) {
                let (_, losses) = self.losses_at(draft, traces);
                for (known, loss) in besides.iter_mut().zip(losses).skip(1) {
                    known.extend(loss.map(|loss| Best { loss, state }));
                }
            }
        }
    }

    /// Losses of functions at a state, and of the programs besides; a function that has no value in double precision
    /// may have one besides.
    fn losses_at(&self, draft: &Draft<'_>, traces: &mut [Trace; 2]) -> (Vec<Option<f64>>, Vec<Option<f64>>) {
        let [trace, again] = traces;
        self.try_to(self.ends[2], draft, trace);
        let lists = || self.outputs.iter().chain(&self.besides);
        let mut losses: Vec<Option<f64>> = lists().map(|outputs| self.loss(trace, outputs)).collect();
        if losses.iter().flatten().any(|loss| *loss > ORDINARY) {
            self.try_to(self.ends[2], draft, again);
            losses = lists().map(|outputs| self.loss_as_of(&[trace, again], outputs, outputs)).collect();
        }
        let of_besides = losses.split_off(self.outputs.len());
        let mut exact = None;
        let of_besides = self.besides.iter().zip(of_besides).map(|(outputs, loss)| {
            let loss = loss.or_else(|| {
                let exact =
                    exact.get_or_insert_with(|| self.exact(draft, trace, self.ends[2], |_| Doubled::number(1.0)));
                is_finite(exact, outputs).then_some(NO_DIGIT)
            });
            loss.map(|loss| loss.min(NO_DIGIT))
        });
        let of_besides = of_besides.collect();
        (losses, of_besides)
    }

    /// States where another form would keep the digits that a function or a derivative (`None`) loses by its motion
    /// alone.
    fn deciding<'n>(
        &mut self,
        drafts: &[Draft<'n>],
        best: &[Best],
        besides: &[Option<Best>],
        forms: &Forms<'_, 'g>,
    ) -> Vec<(Option<usize>, Draft<'n>)> {
        let mut deciding = Vec::new();
        for (k, best) in best.iter().enumerate().filter(|(_, best)| best.loss > MUCH) {
            let draft = &drafts[best.state];
            if draft.moves.iter().all(|change| self.moves.is_of_motion(change)) {
                let outputs = (forms.of_function)(k);
                let form = |flat: &mut Flat, form: &Vec<Expr<'g>>| form.iter().map(|e| flat.expression(*e)).collect();
                let outputs = outputs.iter().map(|outputs| form(&mut self.flat, outputs)).collect::<Vec<_>>();
                if self.is_decided_at(&self.outputs[k], best.loss, draft, &outputs) {
                    deciding.push((Some(k), draft.clone()));
                }
            }
        }
        for (k, best) in besides.iter().enumerate().skip(1) {
            let Some(best) = best.filter(|best| best.loss > MUCH) else { continue };
            let draft = self.of_motion(&drafts[best.state], drafts);
            let mut trace = self.flat.room(0);
            self.try_to(self.ends[2], &draft, &mut trace);
            let loss = self.loss(&trace, &self.besides[k]).unwrap_or(NO_DIGIT);
            if loss > MUCH {
                let outputs: Vec<Vec<Slot>> =
                    (forms.of_derivative)(k - 1).iter().map(|program| self.flat.program(program)).collect();
                if self.is_decided_at(&self.besides[k], loss, &draft, &outputs) {
                    deciding.push((None, draft));
                }
            }
        }
        deciding
    }

    /// A state without what parameters were changed by.
    fn of_motion<'n>(&self, draft: &Draft<'n>, drafts: &[Draft<'n>]) -> Draft<'n> {
        if draft.moves.iter().all(|change| self.moves.is_of_motion(change)) {
            return draft.clone();
        }
        let mut other = drafts[draft.sample].clone();
        let moves = draft.moves.iter().filter(|change| self.moves.is_of_motion(change));
        moves.for_each(|change| self.moves.apply(*change, &mut other));
        other
    }

    /// The first of the numbers that can be moved of which something holds.
    #[cfg(test)]
    pub fn symbol(&self, is: impl Fn(Expr<'g>) -> bool) -> Option<Expr<'g>> {
        self.moves.symbols().find(|symbol| is(*symbol))
    }

    /// Sample states and the worst ones of functions; of the others that were found, which are worse than those before
    /// them, the latest, as many as are worth their time.
    fn states_for_others(&self, end: usize, sampled: usize, best: &[Best]) -> Vec<usize> {
        let latest = (STEPS / self.ends[2].max(1)).min(LEAST);
        let is_worth =
            |state: usize| state < sampled || state + latest >= end || best.iter().any(|best| best.state == state);
        (0..end).filter(|&state| is_worth(state)).collect()
    }

    /// Runs all programs at a state up to a step.
    fn try_to(&self, end: usize, draft: &Draft<'_>, trace: &mut Trace) {
        self.try_at(&(self.ends[0]..end), draft, trace);
    }

    /// Computes p at a state, and carries out steps.
    fn try_at(&self, steps: &Range<usize>, draft: &Draft<'_>, trace: &mut Trace) {
        for (key, slot) in self.flat.inputs() {
            trace.give(*slot, draft.values.map.get(key).copied().unwrap_or(f64::NAN));
        }
        trace.run(&self.flat, 0, self.ends[0]);
        for &(from, p) in &self.momenta {
            trace.give(p, trace.slots()[from as usize].value);
        }
        trace.run(&self.flat, steps.start, steps.end);
    }

    /// Runs functions and what is written besides.
    #[cfg(test)]
    pub fn try_all_at(&self, draft: &Draft<'_>, trace: &mut Trace) {
        self.try_to(self.ends[2], draft, trace);
    }

    /// Whether another form of what has that loss at a state loses much less there.
    fn is_decided_at(&self, own: &[Slot], loss: f64, draft: &Draft<'_>, forms: &[Vec<Slot>]) -> bool {
        if forms.len() < 2 {
            return false;
        }
        let mut trace = self.flat.room(0);
        self.try_to(self.flat.len(), draft, &mut trace);
        let least = forms.iter().filter_map(|outputs| self.loss_as_of(&[&trace], outputs, own)).fold(loss, f64::min);
        LESS * least.max(1.0) < loss
    }

    /// The largest of the components; `None` where there is no value.
    pub fn loss(&self, trace: &Trace, outputs: &[Slot]) -> Option<f64> {
        let slots = trace.slots();
        let (mut worst, mut vanishing) = (0.0_f64, 0.0_f64);
        // A plain loop that leaves out what cannot be the largest: it is run at every state.
        for &slot in outputs {
            let traced = &slots[slot as usize];
            let error = traced.error.abs();
            if error <= worst * f64::EPSILON * traced.value.abs() {
                continue;
            }
            let unit = unit(&[*traced]);
            if !(error + unit).is_finite() {
                return None;
            }
            if self.vanishing[slot as usize] {
                vanishing = vanishing.max(error);
            } else if error > worst * unit {
                worst = error / unit;
            }
        }
        if vanishing > 0.0 {
            let largest = outputs.iter().map(|&slot| unit(&[slots[slot as usize]])).fold(0.0, f64::max);
            worst = worst.max(vanishing / largest);
        }
        Some(worst)
    }

    /// The same of outputs that should be what others are, with the changes of several traces.
    pub fn loss_as_of(&self, traces: &[&Trace], outputs: &[Slot], others: &[Slot]) -> Option<f64> {
        let (mut worst, mut largest, mut vanishing) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (slot, other) in outputs.iter().zip(others) {
            let traced: Vec<TracedNumber> = traces.iter().map(|trace| trace.slots()[*slot as usize]).collect();
            let (error, unit) = (traced[0].error.abs(), unit(&traced));
            if !(error + unit).is_finite() {
                return None;
            }
            if self.vanishing[*other as usize] {
                vanishing = vanishing.max(error);
            } else if error > worst * unit {
                worst = error / unit;
            }
            largest = largest.max(unit);
        }
        Some(if vanishing > worst * largest { vanishing / largest } else { worst })
    }

    /// Components that have no digit at any of the states.
    fn find_vanishing(&mut self, drafts: &[Draft<'_>], trace: &mut Trace) {
        let slots: Vec<Slot> = self.outputs.iter().chain(&self.besides).flatten().copied().collect();
        let mut vanish = vec![true; slots.len()];
        for draft in drafts {
            self.try_to(self.ends[2], draft, trace);
            let mut vanish = vanish.iter_mut();
            for outputs in self.outputs.iter().chain(&self.besides) {
                let traced = || outputs.iter().map(|&slot| &trace.slots()[slot as usize]);
                let largest = traced().map(|traced| unit(&[*traced])).fold(0.0, f64::max);
                for (traced, vanish) in traced().zip(&mut vanish) {
                    *vanish &= largest.max(traced.error.abs()) >= NOTHING * unit(&[*traced]);
                }
            }
        }
        for (slot, vanish) in slots.into_iter().zip(vanish) {
            self.vanishing[slot as usize] = vanish;
        }
    }

    /// Tries programs at a state, and notes where they lose more than at the states before; whether one of them loses
    /// much more.
    fn note(
        &self,
        goal: &Goal<'_>,
        [trace, again]: &mut [Trace; 2],
        draft: &Draft<'_>,
        state: usize,
        best: &mut [Best],
    ) -> bool {
        self.try_at(&goal.steps, draft, trace);
        let (mut much, mut exact, mut is_changed_again) = (false, None, false);
        for (outputs, best) in goal.lists.iter().zip(best) {
            if outputs.is_empty() || best.loss >= NO_DIGIT {
                continue;
            }
            let loss = match self.loss(trace, outputs) {
                Some(loss) if loss > best.loss.max(ORDINARY) => {
                    if !is_changed_again {
                        self.try_at(&goal.steps, draft, again);
                        is_changed_again = true;
                    }
                    self.loss_as_of(&[trace, again], outputs, outputs).unwrap_or(loss)
                }
                Some(loss) => loss,
                None => {
                    let exact =
                        exact.get_or_insert_with(|| self.exact(draft, trace, goal.steps.end, |_| Doubled::number(1.0)));
                    if is_finite(exact, outputs) { NO_DIGIT } else { 0.0 }
                }
            };
            if loss > best.loss {
                much |= loss > 1.5 * best.loss;
                *best = Best { loss: loss.min(NO_DIGIT), state };
            }
        }
        much
    }

    /// All numbers up to a step in 106 binary digits, with what each input is multiplied by.
    pub fn exact(&self, draft: &Draft<'_>, trace: &Trace, to: usize, factor: impl Fn(Slot) -> Doubled) -> Vec<Doubled> {
        let momenta = self.momenta.iter().map(|&(from, p)| (p, trace.slots()[from as usize].value));
        let momenta: Map<Slot, f64> = momenta.collect();
        let of = |key: u32, slot: Slot| match momenta.get(&slot) {
            Some(&value) => value,
            None => draft.values.map.get(&key).copied().unwrap_or(f64::NAN),
        };
        self.flat.run(|key, slot| Doubled::number(of(key, slot)) * factor(slot), to)
    }

    fn climb<'n>(
        &self,
        goal: &Goal<'_>,
        tries: usize,
        drafts: &mut Vec<Draft<'n>>,
        best: &mut [Best],
        traces: &mut [Trace; 2],
    ) {
        let sampled = sampled(drafts);
        let mut random = Random::new(26);
        let lists: Vec<usize> = (0..goal.lists.len()).filter(|&k| !goal.lists[k].is_empty()).collect();
        let mut again: Option<(usize, Move)> = None;
        for n in 0..tries {
            if n == tries / 2 && best.iter().all(|best| best.loss < ORDINARY) {
                return;
            }
            let from = again.take().unwrap_or_else(|| {
                let best = best[lists[n % lists.len()]].state;
                let base = if random.below(4) == 0 { random.below(sampled) } else { best };
                let further = drafts[base].moves.last().filter(|_| random.below(3) == 0);
                (base, further.map_or_else(|| self.moves.any(&mut random), |last| last.further()))
            });
            let state = drafts.len();
            if self.try_change(goal, from, drafts, best, traces) {
                again = Some((state, from.1.further()));
            }
        }
    }

    /// Tries all programs at a state that is changed, which is kept where one of them loses more than before; whether
    /// one loses much more.
    fn try_change<'n>(
        &self,
        goal: &Goal<'_>,
        (base, change): (usize, Move),
        drafts: &mut Vec<Draft<'n>>,
        best: &mut [Best],
        traces: &mut [Trace; 2],
    ) -> bool {
        let mut draft = drafts[base].clone();
        self.moves.apply(change, &mut draft);
        if !self.states.is_physical(&draft) {
            return false;
        }
        let state = drafts.len();
        let much = self.note(goal, traces, &draft, state, best);
        if best.iter().any(|best| best.state == state) {
            drafts.push(draft);
        }
        much
    }
}
