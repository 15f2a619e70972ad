//! A step that was made, made again in dual numbers: decisions are those of the step, and all that follows from them
//! has its derivatives.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem, ImpulseDynamics};
use gauss_runtime::dual::Dual;
use gauss_runtime::forces::Columns;
use gauss_runtime::system::GaussSystem;

use crate::dense::Matrix;
use crate::error::ContactErrorKind;
use crate::friction::Bounds;
use crate::lockstep::Lockstep;
use crate::mode::{Mode, after_impulses};

use super::active::{Active, LEFT, NOTHING, Solvable, inverse, largest_slope, multiplied};
use super::bounds::Touched;
use super::edges::{self, AtChange, Known};
use super::motion::{self, Mean, Middle, Rule};
use super::projection::{Closed, Projection};
use super::report::StepScheme;
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
        let attempt = Attempt { kernel, input, state, middle, t: part.t, h };
        attempt.end(taken, same)
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
        let wanted = rule.mean.of(kernel, (t, h), [(&state.q, &z), (q, after)], input);
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

/// One attempt at a part of a step.
struct Attempt<'a, L: ContactSystem> {
    kernel: &'a L,
    input: &'a L::Input,
    state: &'a State<L>,
    middle: Middle<L>,
    t: f64,
    h: f64,
}

/// The end of an attempt: the configuration and the speeds.
type Moved<L> = Result<(<L as GaussSystem>::Configuration, <L as GaussSystem>::Speeds), ContactErrorKind>;

impl<const N: usize, L: ContactSystem<Scalar = Dual<N>>> Attempt<'_, L> {
    fn end(&self, taken: &Taken, same: &mut Same) -> Moved<L> {
        match &taken.modes {
            None => self.flight(same),
            Some(modes) => self.touching(taken, modes, same),
        }
    }

    fn flight(&self, same: &mut Same) -> Moved<L> {
        let Self { kernel, input, state, middle, h, .. } = self;
        let acceleration = kernel.acceleration(middle.t, &middle.q, &middle.z, input);
        let z = state.z.add_scaled(Dual::constant(*h), &acceleration);
        if same.looks && same.at_change.is_none() {
            let t = Dual::constant(self.t);
            let gaps = kernel.gaps(t, &state.q);
            let rates = [state.z, z].map(|z| kernel.contact_rates(middle.t, &middle.q, &z));
            let known = Known {
                contacts: self.kernel.contacts(),
                gaps: &|i| gaps.component(i).value,
                restitution: &|_| 0.0,
                before: &|row| rates[0].component(row).value,
                free: &|row| rates[1].component(row).value,
                h: *h,
                tolerance: same.tolerance,
            };
            same.at_change = known.in_flight();
        }
        self.second_half(z)
    }

    fn second_half(&self, z: L::Speeds) -> Moved<L> {
        let Self { kernel, middle, .. } = self;
        let rate = kernel.kinematics(middle.t, &middle.half, &z);
        let end = motion::second_half(*kernel, (Dual::constant(self.t), self.h), middle, (z, &rate));
        end.map_err(ContactErrorKind::Projection)
    }

    fn touching(&self, taken: &Taken, modes: &[Mode], same: &mut Same) -> Moved<L> {
        let Self { kernel, input, state, middle, h, .. } = self;
        let friction = kernel.friction(middle.t, &middle.q, &middle.z, input);
        let dynamics = kernel.impulse_dynamics(middle.t, &middle.q, &middle.z, input);
        let t = Dual::constant(self.t);
        let before = kernel.contact_rates(t, &state.q, &state.z);
        let free = state.z.add_scaled(Dual::constant(*h), &dynamics.acceleration);
        let free_and_bias = (&free, &dynamics.bias);
        let rates = motion::free_rates(
            *kernel,
            *h,
            middle,
            (&state.z, &before),
            free_and_bias,
            (taken.dependent, |i| taken.opened[i]),
        );
        let gaps = kernel.gaps(t, &state.q);
        let passes = self.passes(same.tolerance, &gaps, &rates);
        let active = self.active((modes, &passes), (&friction, &dynamics), rates[1]);
        let impulses: Vec<Dual<N>> = taken.impulses.iter().copied().map(Dual::constant).collect();
        if same.solvable.len() == same.solved {
            same.solvable.push(active.solvable(modes, &impulses));
        }
        if same.looks && same.at_change.is_none() {
            let e = kernel.restitution();
            let known = Known {
                contacts: self.kernel.contacts(),
                gaps: &|i| gaps.component(i).value,
                restitution: &|i| e.component(i).value,
                before: &|row| rates[0].component(row).value,
                free: &|row| rates[1].component(row).value,
                h: *h,
                tolerance: same.tolerance,
            };
            same.at_change = known.among(modes, &active, &impulses);
        }
        let part = ROUNDING + 100.0 * same.tolerance;
        let impulses = active.solve((&same.solvable[same.solved], part), impulses)?;
        same.solved += 1;
        let mut rows = L::ContactRows::zero();
        impulses.iter().enumerate().for_each(|(row, impulse)| rows.set_component(row, *impulse));
        let z = after_impulses(&Lockstep::default(), *kernel, &free, (&dynamics.response.factors, &rows));
        let (q, z) = self.second_half(z)?;
        self.projected((q, z), (&dynamics, [&rows, &before]), (taken, modes, &passes), same)
    }

    /// The rates that contacts with restitution pass on, whose gaps do not open before the step, or are closed by
    /// others alone. Of an approach of zero derivatives are those of an approach.
    fn passes(&self, tolerance: f64, gaps: &L::Gaps, rates: &[L::ContactRows; 2]) -> Vec<Option<Dual<N>>> {
        let (e, [before, free]) = (self.kernel.restitution(), rates);
        let size = |row: usize| before.component(row).value.abs().max(free.component(row).value.abs());
        let nothing = tolerance * (0..L::ContactRows::DIM).map(size).fold(0.0, f64::max);
        let fastest = motion::fastest::<L>(rates).value;
        let of = |(i, contact): (usize, &Contact)| {
            let [before, free] = [before, free].map(|rates| rates.component(contact.normal));
            let end = gaps.component(i).value + 0.5 * self.h * (before.value + free.value);
            let e = e.component(i);
            let passes = before.value <= nothing || motion::reversed(before.value, end, fastest) > 0.0;
            (contact.has_gap() && e.value > 0.0 && passes).then_some(-e * before)
        };
        self.kernel.contacts().iter().enumerate().map(of).collect()
    }

    /// The contacts that act, from friction and rates before the step and after it without impulses.
    fn active<'d>(
        &self,
        (modes, passes): (&[Mode], &[Option<Dual<N>>]),
        (friction, dynamics): (&L::ContactRows, &'d ImpulseDynamics<L>),
        mut free: L::ContactRows,
    ) -> Active<'d, L> {
        for (i, contact) in self.kernel.contacts().iter().enumerate().filter(|(_, contact)| contact.has_gap()) {
            if let (true, Some(passed)) = (modes[i].is_closed(), passes[i]) {
                free.set_component(contact.normal, free.component(contact.normal) - passed);
            }
        }
        Active {
            contacts: self.kernel.contacts(),
            delassus: &dynamics.response.delassus,
            b: (0..L::ContactRows::DIM).map(|row| free.component(row)).collect(),
            bounds: self.kernel.contacts().iter().map(|contact| Bounds::of(contact, friction)).collect(),
            h: self.h,
        }
    }

    /// Closed gaps, their rates and the slips of what sticks at zero, with their derivatives.
    fn projected(
        &self,
        (q, z): (L::Configuration, L::Speeds),
        (dynamics, [impulses, rates]): (&ImpulseDynamics<L>, [&L::ContactRows; 2]),
        (taken, modes, passes): (&Taken, &[Mode], &[Option<Dual<N>>]),
        same: &mut Same,
    ) -> Moved<L> {
        let (kernel, t) = (self.kernel, Dual::constant(self.t + self.h));
        let mut memory = vec![Dual::constant(0.0); Projection::<L>::MEMORY];
        let mut projection = Projection::new(kernel, &mut memory);
        let before = kernel.gaps(t, &q);
        let touched = Touched { closed: &taken.closed, impulses, rates, h: self.h };
        let closed = projection.close((t, q, before), (&dynamics.response, motion::magnitude(&q)), &touched);
        let Closed { mut q, gaps, .. } = closed.map_err(|not_closed| not_closed.kind)?;
        if same.looks && same.at_change.is_none() {
            let nothing = same.tolerance * self.h * (1.0 + z.max_norm());
            same.at_change = edges::of_gaps(kernel, (&before, &gaps), &taken.rests, nothing);
        }
        let held = |(i, _): &(usize, &Contact)| projection.held[*i];
        let normals: Vec<usize> =
            self.kernel.contacts().iter().enumerate().filter(held).map(|(_, contact)| contact.normal).collect();
        let gap_of =
            |row: usize| self.kernel.contacts().iter().position(|contact| contact.normal == row && contact.has_gap());
        let gap = |gaps: &L::Gaps, row: usize| gap_of(row).map_or(Dual::constant(0.0), |i| gaps.component(i));
        let zero = L::Speeds::zero();
        let moved = self.cancelling((t, &q), dynamics, &normals, |row| gap(&gaps, row));
        let still = kernel.kinematics(t, &q, &zero);
        q = q.advance(&kernel.kinematics(t, &q, &moved).add_scaled(Dual::constant(-1.0), &still));
        let after = kernel.gaps(t, &q);
        let gone = |row: &usize| [gap(&after, *row), gap(&gaps, *row)];
        is_gone(normals.iter().map(gone), 1.0)?;

        let mode = |i: usize| if taken.rests[i] { modes[i] } else { Mode::Open };
        let rates = kernel.contact_rates(t, &q, &z);
        let (mut z, rates) = projection.stop((t, &q, z, rates), &dynamics.response, (mode, Dual::constant(0.0)));
        let stopped: Vec<usize> =
            self.kernel.contacts().iter().enumerate().flat_map(|(i, contact)| stopped(contact, &mode(i))).collect();
        let passed = |row: usize| gap_of(row).and_then(|i| passes[i]).unwrap_or(Dual::constant(0.0));
        let by = self.cancelling((t, &q), dynamics, &stopped, |row| rates.component(row) - passed(row));
        z = z.add_scaled(Dual::constant(1.0), &by);
        let after = kernel.contact_rates(t, &q, &z);
        let speeds = z.max_norm().max(self.state.z.max_norm());
        is_gone(stopped.iter().map(|row| [after.component(*row) - passed(*row), rates.component(*row)]), speeds)?;
        Ok((q, z))
    }

    /// The change of speeds by impulses in these rows that takes away what is left of the derivatives of their rates.
    fn cancelling(
        &self,
        (t, q): (Dual<N>, &L::Configuration),
        dynamics: &ImpulseDynamics<L>,
        rows: &[usize],
        rate: impl Fn(usize) -> Dual<N>,
    ) -> L::Speeds {
        let mut sum = L::Speeds::zero();
        if rows.is_empty() {
            return sum;
        }
        let jacobian = self.kernel.contact_jacobian(t, q);
        let columns = self.kernel.contact_columns(&dynamics.response.factors);
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
