//! A step that was made, made again in dual numbers: decisions are those of the step, and all that follows from them
//! has its derivatives.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem, ImpulseDynamics};
use gauss_runtime::dual::Dual;
use gauss_runtime::forces::Columns;

use crate::dense::Matrix;
use crate::error::ContactErrorKind;
use crate::friction::Bounds;
use crate::lockstep::Lockstep;
use crate::mode::{Mode, after_impulses};

use super::active::{Active, LEFT, NOTHING, Solvable, inverse, largest_slope, multiplied};
use super::bounds::{Touched, contact_at};
use super::edges::{self, AtChange, Known};
use super::motion::{self, Mean, Middle, Rule};
use super::projection::{Closed, Projection};
use super::report::StepScheme;
use super::step::{Contacted, Decisions, Moved, Step, StepDynamics, Stopped};
use super::watch::{Part, Taken};

/// A state with derivatives.
pub(super) struct State<L: ContactSystem> {
    pub(super) q: L::Configuration,
    pub(super) z: L::Speeds,
    /// Acceleration of the part before, between impacts.
    pub(super) acceleration: Option<L::Speeds>,
}

/// Number of attempts that are added for derivatives where values have settled: they begin with those of speeds that
/// were foreseen.
const FURTHER: usize = 8;

/// Roundings of equations, as a part of their terms.
const ROUNDING: f64 = 1e-6;

/// Data that are the same for all directions.
pub(super) struct Same {
    pub(super) scheme: StepScheme,
    pub(super) tolerance: f64,
    /// Whether changes of modes are looked for, and the first that was found.
    pub(super) looks: bool,
    pub(super) at_change: Option<AtChange>,
    /// Equations of attempts that were solved once, in their order.
    pub(super) solvable: Vec<Solvable>,
    /// Number of attempts of this pass that solved equations so far.
    pub(super) solved: usize,
}

/// A part of a step from a state at its start.
pub(super) fn part<const N: usize, L: ContactSystem<Scalar = Dual<N>>>(
    kernel: &L,
    input: &L::Input,
    (part, same): (&Part, &mut Same),
    state: &State<L>,
) -> Result<State<L>, ContactErrorKind> {
    let (h, number) = (part.h, Dual::constant);
    let (t, z) = (number(part.t), state.z);
    let scheme = same.scheme;
    let half = motion::half_way::<L>(h, &state.q, &kernel.kinematics(t, &state.q, &z));
    let plain = |used: L::Speeds| Middle::new((t, h), half, z, used);
    let to_mean = |way: L::Speeds, used| plain(used).with_mean(kernel, (t, h), (&state.q, way), used);
    let attempt = |same: &mut Same, taken: &Taken, middle: Middle<L>| {
        let step = Step { kernel, h, end: number(part.t + h), z: &z, middle: &middle };
        Replay { state, t: part.t, taken, same }.end(&step, input)
    };
    let foreseen = match (scheme, state.acceleration) {
        (StepScheme::Midpoint, Some(acceleration)) => z.add_scaled(number(0.5 * h), &acceleration),
        (StepScheme::Midpoint, None) => z,
        (StepScheme::MoreauJean, _) => {
            z.add_scaled(number(0.5 * h), &kernel.acceleration(t + number(0.5 * h), &half, &z, input))
        }
    };
    let mut middle = if part.by_mean { to_mean(foreseen, foreseen) } else { plain(foreseen) };
    let next = |rule: Rule, (way, used): (L::Speeds, L::Speeds), (q, after): &(L::Configuration, L::Speeds)| {
        let before = || kernel.acceleration(t, &state.q, &z, input);
        let wanted = rule.mean.of(kernel, (t, h), (&z, before), (q, after), input);
        let way = motion::towards(&way, &motion::mean(&z, after), rule.part);
        let used = motion::towards(&used, &wanted, rule.part);
        if rule.at_mean_place { to_mean(way, used) } else { plain(used) }
    };
    let mut rule = Rule { mean: Mean::Ends, part: 1.0, at_mean_place: part.by_mean };
    for (taken, of) in &part.before {
        let speeds = (middle.way, middle.z);
        rule = *of;
        middle = next(rule, speeds, &attempt(same, taken, middle)?);
    }
    let (mut speeds, solved) = ((middle.way, middle.z), same.solved);
    let made = attempt(same, &part.taken, middle)?;
    let (mut q, mut after) = made;
    if part.settled {
        let mut further = made;
        let (mut first, mut last) = (None, 0.0);
        for _ in 0..FURTHER {
            middle = next(rule, speeds, &further);
            speeds = (middle.way, middle.z);
            same.solved = solved;
            let found = attempt(same, &part.taken, middle)?;
            last = slopes_of(&found.1.add_scaled(number(-1.0), &further.1));
            (first, further) = (first.or(Some(last)), found);
        }
        // Where values settled by parts of differences, derivatives may not by the last of these.
        if first.is_some_and(|first| last <= first) {
            let components = with_values_of(&q.components(), &further.0.components());
            (q, after) = (L::Configuration::from_components(&components), with_values_of(&after, &further.1));
        }
    }
    let changed = after.add_scaled(number(-1.0), &z).scale(number(1.0 / h));
    Ok(State { q, z: after, acceleration: (!part.taken.struck).then_some(changed) })
}

/// The largest derivative of numbers.
fn slopes_of<const N: usize, V: VectorSpace<Dual<N>>>(of: &V) -> f64 {
    (0..V::DIM).map(|i| largest_slope(&of.component(i))).fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) })
}

/// The derivatives of numbers, with the values of others.
fn with_values_of<const N: usize, V: VectorSpace<Dual<N>>>(values: &V, slopes: &V) -> V {
    let mut both = *slopes;
    (0..V::DIM).for_each(|i| {
        both.set_component(i, Dual { value: values.component(i).value, ..slopes.component(i) });
    });
    both
}

/// Decisions of an attempt at a part of a step, which follow one that was made.
struct Replay<'a, L: ContactSystem> {
    state: &'a State<L>,
    t: f64,
    taken: &'a Taken,
    same: &'a mut Same,
}

/// Impulses with derivatives, and what contacts that act begin with.
struct Replayed<const N: usize, L: ContactSystem> {
    impulses: L::ContactRows,
    /// Rates before the part.
    before: L::ContactRows,
    /// Rates that contacts with restitution pass on.
    passes: Vec<Option<Dual<N>>>,
}

impl<const N: usize, L: ContactSystem<Scalar = Dual<N>>> Replay<'_, L> {
    /// The end of an attempt.
    fn end(&mut self, step: &Step<L>, input: &L::Input) -> Result<Moved<L>, ContactErrorKind> {
        if self.taken.modes.is_none()
            && let Some((end, _)) = step.flight(input, self)?
        {
            return Ok(end);
        }
        step.touching(input, self).map(|Contacted { closed, stopped, .. }| (closed.q, stopped.0))
    }

    /// Whether changes of modes are looked for.
    fn looks(&self) -> bool {
        self.same.looks && self.same.at_change.is_none()
    }

    /// Mode of a contact after the attempt.
    fn mode(&self, i: usize) -> Mode {
        self.taken.modes.as_ref().map_or(Mode::Open, |modes| modes[i])
    }

    /// The contact at a change of its mode, from gaps before the step and rates before and without impulses after it.
    fn at_change(
        &self,
        step: &Step<L>,
        [before, free]: [&L::ContactRows; 2],
        find: impl FnOnce(&Known) -> Option<AtChange>,
    ) -> Option<AtChange> {
        let gaps = step.kernel.gaps(Dual::constant(self.t), &self.state.q);
        let e = step.kernel.restitution();
        find(&Known {
            contacts: step.kernel.contacts(),
            gaps: &|i| gaps.component(i).value,
            restitution: &|i| e.component(i).value,
            before: &|row| before.component(row).value,
            free: &|row| free.component(row).value,
            h: step.h,
            tolerance: self.same.tolerance,
        })
    }

    /// The rates that contacts with restitution pass on, whose gaps do not open before the step, or are closed by
    /// others alone. Of an approach of zero derivatives are those of an approach.
    fn passes(&self, step: &Step<L>, rates: &[L::ContactRows; 2]) -> Vec<Option<Dual<N>>> {
        let (e, [before, free]) = (step.kernel.restitution(), rates);
        let gaps = step.kernel.gaps(Dual::constant(self.t), &self.state.q);
        let size = |row: usize| before.component(row).value.abs().max(free.component(row).value.abs());
        let nothing = self.same.tolerance * (0..L::ContactRows::DIM).map(size).fold(0.0, f64::max);
        let fastest = motion::fastest::<L>(rates).value;
        let of = |(i, contact): (usize, &Contact)| {
            let [before, free] = [before, free].map(|rates| rates.component(contact.normal));
            let end = gaps.component(i).value + 0.5 * step.h * (before.value + free.value);
            let e = e.component(i);
            let passes = before.value <= nothing || motion::reversed(before.value, end, fastest) > 0.0;
            (contact.has_gap() && e.value > 0.0 && passes).then_some(-e * before)
        };
        step.kernel.contacts().iter().enumerate().map(of).collect()
    }

    /// The contacts that act, from friction and rates after the step without impulses.
    fn active<'d>(
        &self,
        &StepDynamics { step, friction, impulses, .. }: &StepDynamics<'d, L>,
        passes: &[Option<Dual<N>>],
        mut free: L::ContactRows,
    ) -> Active<'d, L> {
        let contacts = step.kernel.contacts();
        for (i, contact) in contacts.iter().enumerate().filter(|(_, contact)| contact.has_gap()) {
            if let (true, Some(passed)) = (self.mode(i).is_closed(), passes[i]) {
                free.set_component(contact.normal, free.component(contact.normal) - passed);
            }
        }
        Active {
            contacts,
            delassus: &impulses.response.delassus,
            b: (0..L::ContactRows::DIM).map(|row| free.component(row)).collect(),
            bounds: contacts.iter().map(|contact| Bounds::of(contact, friction)).collect(),
            h: step.h,
        }
    }

    /// The change of speeds by impulses in these rows that takes away what is left of the derivatives of their rates.
    fn cancelling(
        StepDynamics { step, impulses, .. }: &StepDynamics<L>,
        q: &L::Configuration,
        rows: &[usize],
        rate: impl Fn(usize) -> Dual<N>,
    ) -> L::Speeds {
        let mut sum = L::Speeds::zero();
        if rows.is_empty() {
            return sum;
        }
        let jacobian = step.kernel.contact_jacobian(step.end, q);
        let columns = step.kernel.contact_columns(&impulses.response.factors);
        let product = |i: usize, j: usize| {
            let (Some(row), Some(column)) = (jacobian.nth(rows[i]), columns.nth(rows[j])) else { return 0.0 };
            (0..L::Speeds::DIM).map(|k| row.component(k).value * column.component(k).value).sum::<f64>()
        };
        let matrix = Matrix::from_fn(rows.len(), product);
        let left: Vec<Dual<N>> = rows.iter().map(|row| Dual { value: 0.0, ..rate(*row) }).collect();
        let impulses = multiplied(&inverse(&matrix, |i| matrix.at(i, i)), &left);
        for (row, impulse) in rows.iter().zip(impulses) {
            if let Some(column) = columns.nth(*row) {
                sum = sum.add_scaled(-impulse, &column);
            }
        }
        sum
    }
}

impl<const N: usize, L: ContactSystem<Scalar = Dual<N>>> Decisions<L> for Replay<'_, L> {
    type Pushed = Replayed<N, L>;
    type Refusal = ContactErrorKind;

    fn stays_open(&mut self, step: &Step<L>, z: &L::Speeds) -> Result<bool, ContactErrorKind> {
        if self.looks() {
            let middle = step.middle;
            let [before, free] = [step.z, z].map(|z| step.kernel.contact_rates(middle.t, &middle.q, z));
            self.same.at_change = self.at_change(step, [&before, &free], |known| known.in_flight());
        }
        Ok(true)
    }

    fn push(&mut self, at: &StepDynamics<L>) -> Result<(Replayed<N, L>, L::Speeds), ContactErrorKind> {
        let StepDynamics { step, free, impulses: ImpulseDynamics { bias, response, .. }, .. } = at;
        let (kernel, taken) = (step.kernel, self.taken);
        let before = kernel.contact_rates(Dual::constant(self.t), &self.state.q, &self.state.z);
        let decided = (taken.dependent, |i: usize| taken.opened[i]);
        let rates = motion::free_rates(kernel, step.h, step.middle, (&self.state.z, &before), (free, bias), decided);
        let passes = self.passes(step, &rates);
        let active = self.active(at, &passes, rates[1]);
        let impulses: Vec<Dual<N>> = taken.impulses.iter().copied().map(Dual::constant).collect();
        let modes = taken.modes.as_deref().unwrap_or_default();
        if self.same.solvable.len() == self.same.solved {
            self.same.solvable.push(active.solvable(modes, &impulses));
        }
        if self.looks() {
            let among = |known: &Known| known.among(modes, &active, &impulses);
            self.same.at_change = self.at_change(step, [&rates[0], &rates[1]], among);
        }
        let part = ROUNDING + 100.0 * self.same.tolerance;
        let solved = active.solve((&self.same.solvable[self.same.solved], part), impulses)?;
        self.same.solved += 1;
        let mut impulses = L::ContactRows::zero();
        solved.iter().enumerate().for_each(|(row, impulse)| impulses.set_component(row, *impulse));
        let z = after_impulses(&Lockstep::default(), kernel, free, (&response.factors, &impulses));
        Ok((Replayed { impulses, before, passes }, z))
    }

    fn project(&mut self, step: &Step<L>, (q, z): Moved<L>) -> Result<Moved<L>, ContactErrorKind> {
        step.kernel.project(step.end, &q, &z).map_err(ContactErrorKind::Projection)
    }

    /// Closed gaps at zero, with their derivatives.
    fn close(
        &mut self,
        at: &StepDynamics<L>,
        pushed: &mut Replayed<N, L>,
        (q, z): &Moved<L>,
    ) -> Result<Closed<L>, ContactErrorKind> {
        let StepDynamics { step: Step { kernel, h, end: t, .. }, impulses, .. } = at;
        let (kernel, t, taken) = (*kernel, *t, self.taken);
        let mut memory = vec![Dual::constant(0.0); Projection::<L>::MEMORY];
        let mut projection = Projection::new(kernel, &mut memory);
        let touched = Touched { closed: &taken.closed, impulses: &pushed.impulses, rates: &pushed.before, h: *h };
        let closed = projection.close((t, *q), &impulses.response, &touched);
        let closed = closed.map_err(|not_closed| not_closed.kind)?;
        if self.looks() {
            let nothing = self.same.tolerance * h * (1.0 + z.max_norm());
            self.same.at_change = edges::of_gaps(kernel, (&kernel.gaps(t, q), &closed.gaps), &taken.rests, nothing);
        }
        let held = kernel.contacts().iter().enumerate().filter(|(i, _)| projection.held[*i]);
        let normals: Vec<usize> = held.map(|(_, contact)| contact.normal).collect();
        let gap =
            |gaps: &L::Gaps, row: usize| contact_at(kernel, row).map_or(Dual::constant(0.0), |i| gaps.component(i));
        let moved = Self::cancelling(at, &closed.q, &normals, |row| gap(&closed.gaps, row));
        let still = kernel.kinematics(t, &closed.q, &L::Speeds::zero());
        let moved = kernel.kinematics(t, &closed.q, &moved).add_scaled(Dual::constant(-1.0), &still);
        let q = closed.q.advance(&moved);
        let after = kernel.gaps(t, &q);
        is_gone(normals.iter().map(|row| [gap(&after, *row), gap(&closed.gaps, *row)]), 1.0)?;
        Ok(Closed { q, ..closed })
    }

    /// Rates of closed gaps, and slips of what sticks, at zero with their derivatives.
    fn stop(
        &mut self,
        at: &StepDynamics<L>,
        (pushed, Closed { q, .. }): (&Replayed<N, L>, &Closed<L>),
        (z, rates): Stopped<L>,
    ) -> Result<Stopped<L>, ContactErrorKind> {
        let (kernel, t) = (at.step.kernel, at.step.end);
        let mut memory = vec![Dual::constant(0.0); Projection::<L>::MEMORY];
        let mut projection = Projection::new(kernel, &mut memory);
        let mode = |i: usize| if self.taken.rests[i] { self.mode(i) } else { Mode::Open };
        let (z, rates) = projection.stop((t, q, z, rates), &at.impulses.response, (mode, Dual::constant(0.0)));
        let each = kernel.contacts().iter().enumerate();
        let stopped: Vec<usize> = each.flat_map(|(i, contact)| stopped(contact, &mode(i))).collect();
        let passed = |row| contact_at(kernel, row).and_then(|i| pushed.passes[i]).unwrap_or(Dual::constant(0.0));
        let z = z.add_scaled(
            Dual::constant(1.0),
            &Self::cancelling(at, q, &stopped, |row| rates.component(row) - passed(row)),
        );
        let after = kernel.contact_rates(t, q, &z);
        let speeds = z.max_norm().max(self.state.z.max_norm());
        is_gone(stopped.iter().map(|row| [after.component(*row) - passed(*row), rates.component(*row)]), speeds)?;
        Ok((z, after))
    }
}

/// The rows that are at rest after a step in a mode.
fn stopped(contact: &Contact, mode: &Mode) -> core::ops::Range<usize> {
    match mode {
        Mode::Open => 0..0,
        Mode::Sticks => contact.rows(),
        Mode::Closed | Mode::Slides(_) => contact.normal..contact.friction_rows().start,
    }
}

/// Whether derivatives are gone that were to be taken away: of contacts that depend on one another, but not nearby,
/// some stay.
fn is_gone<const N: usize>(
    after_and_before: impl Iterator<Item = [Dual<N>; 2]>,
    size: f64,
) -> Result<(), ContactErrorKind> {
    let mut largest = [0.0_f64; 2];
    for pair in after_and_before {
        largest = core::array::from_fn(|k| {
            let slope = largest_slope(&pair[k]);
            if slope.is_nan() { f64::NAN } else { largest[k].max(slope) }
        });
    }
    // Written so that what is not a number is not gone.
    if largest[0] <= LEFT * largest[1] + NOTHING * (1.0 + size) { Ok(()) } else { Err(ContactErrorKind::NoDerivative) }
}
