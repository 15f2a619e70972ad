//! Decisions about a state at an event: impacts, then the modes of the contacts.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactDynamics, ContactSystem};
use gauss_runtime::forces::Columns;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::{Real, largest_derivative};
use gauss_runtime::system::GaussSystem;

use crate::dense::{Matrix, dot, epsilon, norm, size, value};
use crate::error::{ContactError, ContactErrorKind};
use crate::friction::{Bounds, invalid};
use crate::history::{ContactEvent, EventKind, ImpactRecord, SolveRecord};
use crate::impact::{Impact, Struck, after, rows};
use crate::law::{Law, carrier};
use crate::mode::{InMode, Mode, UNCLOSED, largest_derivative_of, slip, tangents, terms};
use crate::rounding::Rounding;
use crate::solution::{Failure, State};
use crate::solver::Contacts;
use crate::trajectory::ContactTrajectory;
use crate::witness::Watched;

/// Scales by which a run tells values from zero.
pub(crate) struct Scales {
    pub(crate) tolerance: Tolerance,
    /// The largest speed at an event so far.
    pub(crate) largest: f64,
    /// The largest rounding of each row at an event so far: what is left of speeds that end is no less.
    pub(crate) of_rate: Vec<f64>,
    pub(crate) law: Impact,
    /// The start of the run.
    pub(crate) start: f64,
    /// The rounding of values.
    pub(crate) epsilon: f64,
}

impl Scales {
    /// The scales of a run in numbers of this kind that starts at that time.
    pub(crate) fn new<T: Real>(tolerance: Tolerance, law: Impact, start: T) -> Self {
        let (start, epsilon) = (value(start), epsilon::<T>());
        Self { tolerance, largest: 0.0, of_rate: Vec::new(), law, start, epsilon }
    }

    /// Speeds below are rest.
    pub(crate) fn rest(&self) -> f64 {
        self.tolerance.relative.fma(self.largest, self.tolerance.absolute)
    }

    /// Events are found to four roundings of the time or of a step, which is no longer than the run up to now.
    pub(crate) fn resolution(&self, t: f64) -> f64 {
        4.0 * self.epsilon * (t.abs() + self.start.abs())
    }
}

/// Rates of contacts, and what is rounding of them.
pub(crate) struct Sizes<K: ContactSystem> {
    pub(crate) rates: K::ContactRows,
    pub(crate) of_rate: Vec<f64>,
    /// Gaps below are closed: rounding, and what the gap changes by within the resolution of the time.
    pub(crate) of_gap: Vec<f64>,
    pub(crate) rounding: Vec<f64>,
}

/// A state with the modes that led to it.
pub(crate) struct Instant<'k, K: ContactSystem> {
    pub(crate) kernel: &'k K,
    pub(crate) t: K::Scalar,
    pub(crate) q: K::Configuration,
    pub(crate) z: K::Speeds,
    pub(crate) modes: Vec<Mode<K::Scalar>>,
    pub(crate) fired: Option<Watched>,
    pub(crate) first: bool,
    /// Whether an event of the user has made the state jump: slips that had ended may go on.
    pub(crate) jumped: bool,
    /// Whether a contact that slides into Painlevé's paradox is stopped by an impulse.
    pub(crate) jams: bool,
}

/// State of the contacts while their modes are chosen.
pub(crate) struct Choice<T> {
    /// Gap and its rate are zero.
    pub(crate) resting: Vec<bool>,
    /// Open although they are on zero: their force has fallen to zero.
    leaves: Vec<usize>,
    /// Begin to slide in these directions: friction has reached its bound.
    slides: Vec<(usize, [T; 3])>,
    /// Rates below are zero.
    pub(crate) still: Vec<f64>,
    /// Slips of several rows below are: in which direction they go is less than what steps err.
    slow: f64,
    /// The slip is zero whatever its number is.
    stuck: Vec<bool>,
}

/// Impacts at an event.
pub(crate) struct Strike {
    /// Errors of rates by the rounding of the impulses: impulses that cancel leave no rate to tell them from.
    noise: Vec<f64>,
    /// The contact that struck first, and how fast its gap closed.
    pub(crate) first: (usize, f64),
}

/// Whether impacts act on it: not on dry friction, whose force is bounded.
pub(crate) fn takes_impulses(contact: &Contact) -> bool {
    contact.has_gap() || contact.rolls_on().is_some()
}

/// A contact with the resistance to rolling on it.
pub(crate) fn with_rolling<K: ContactSystem>(kernel: &K, i: usize) -> impl Iterator<Item = usize> + use<K> {
    let contacts = kernel.contacts();
    (0..contacts.len()).filter(move |&n| carrier(contacts, n) == i)
}

impl<'k, K: ContactSystem> Instant<'k, K> {
    fn error(&self, contact: Option<usize>, kind: ContactErrorKind) -> ContactError {
        ContactError { contact: contact.map(|i| self.kernel.contacts()[i].name), time: value(self.t), kind }
    }

    fn failed(&self, contacts: &[usize], failure: Failure) -> ContactError {
        match failure {
            Failure::NonFinite => self.error(None, ContactErrorKind::NonFinite),
            Failure::Inconsistent(n) => self.error(Some(contacts[n]), ContactErrorKind::Inconsistent),
            Failure::Indeterminate(n) => self.error(Some(contacts[n]), ContactErrorKind::Indeterminate),
            Failure::NotFound(residual) => self.error(None, ContactErrorKind::Unsolved { residual }),
        }
    }

    /// Rates here with what is rounding of them, 64 roundings of each of their terms.
    pub(crate) fn sizes(&self, scales: &Scales) -> Sizes<K> {
        let Self { kernel, t, q, z, .. } = self;
        let (jacobian, rates) = (kernel.contact_jacobian(*t, q), kernel.contact_rates(*t, q, z));
        let of_row = |row: usize| jacobian.nth(row).map_or(0.0, |column| terms(&column, z));
        let of_rate = (0..K::ContactRows::DIM).map(|row| of_row(row) * 64.0 * epsilon::<K::Scalar>());
        let Rounding { size, .. } = Rounding::of::<K>(q);
        let here = kernel.gaps(*t, q);
        let mut rounding = vec![0.0; self.kernel.contacts().len()];
        for i in 0..TangentOf::<K>::DIM {
            let mut sigma = TangentOf::<K>::zero();
            sigma.set_component(i, K::Scalar::from_f64(16.0 * epsilon::<K::Scalar>() * size));
            let moved = kernel.gaps(*t, &q.retract(&sigma));
            (0..rounding.len()).for_each(|n| rounding[n] += value(moved.component(n) - here.component(n)).abs());
        }
        let later = *t * K::Scalar::from_f64(1.0 + 16.0 * epsilon::<K::Scalar>());
        let moved = kernel.gaps(later, q);
        (0..rounding.len()).for_each(|n| rounding[n] += value(moved.component(n) - here.component(n)).abs());
        let late = 4.0 * scales.resolution(value(*t));
        let within =
            |(contact, rounding): (&Contact, &f64)| late.fma(value(rates.component(contact.normal)).abs(), *rounding);
        let of_gap = self.kernel.contacts().iter().zip(&rounding).map(within).collect();
        Sizes { of_rate: of_rate.collect(), of_gap, rounding, rates }
    }

    /// Brings the state over the event: impacts, rest, modes.
    pub(crate) fn decide(
        &mut self,
        scales: &mut Scales,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<(), ContactError> {
        scales.largest = scales.largest.max(self.z.max_norm());
        let jammed = self.check_paradox(scales, made)?;
        let (leaves, slides) = self.gives_way(made);
        let closed = self.closed(scales)?;
        let before = self.sizes(scales);
        let strike = self.impacts(&closed, scales, made)?;
        let struck = strike.is_some();
        let now = self.sizes(scales);
        let mut still: Vec<f64> = before.of_rate.iter().zip(&now.of_rate).map(|(a, b)| a.max(*b)).collect();
        scales.of_rate.resize(still.len(), 0.0);
        scales.of_rate.iter_mut().zip(&still).for_each(|(most, still)| *most = most.max(*still));
        for row in self.kernel.contacts().iter().flat_map(tangents) {
            still[row] = scales.of_rate[row];
        }
        still.iter_mut().zip(strike.iter().flat_map(|strike| &strike.noise)).for_each(|(still, noise)| *still += noise);
        let rests = |i: usize| {
            let i = carrier(self.kernel.contacts(), i);
            let contact = &self.kernel.contacts()[i];
            closed[i] && (!contact.has_gap() || value(now.rates.component(contact.normal)) <= still[contact.normal])
        };
        let stuck = |i: usize| match self.fired {
            Some(Watched::Speed(n, _)) if n == i => true,
            Some(Watched::Slip(n)) if n == i => {
                tangents(&self.kernel.contacts()[i]).len() == 1
                    || size(&slip(&self.kernel.contacts()[i], &now.rates)) <= scales.rest()
            }
            _ => matches!(self.modes[i], Mode::Sticks),
        };
        let contacts = 0..self.kernel.contacts().len();
        let mut choice = Choice {
            resting: contacts.clone().map(rests).collect(),
            leaves,
            slides,
            stuck: contacts.clone().map(|i| !(struck || self.jumped) && (stuck(i) || jammed == Some(i))).collect(),
            still,
            slow: scales.rest(),
        };
        let old = self.modes.clone();
        let mut events = Vec::new();
        loop {
            let accelerations = self.choose(&mut choice, scales.law, made)?;
            let next = contacts.clone().find_map(|i| {
                let candidate = closed[i] && !choice.resting[i] && self.kernel.contacts()[i].has_gap();
                let first = strike.as_ref().filter(|_| candidate)?.first;
                Some((i, self.comes_to_rest((i, first), (&accelerations, &choice), scales)?))
            });
            let Some((i, kind)) = next else { break };
            with_rolling(self.kernel, i).for_each(|n| choice.resting[n] = true);
            self.leave_out_bounces(i, &choice, made)?;
            events.push(ContactEvent { time: value(self.t), contact: i, name: self.kernel.contacts()[i].name, kind });
        }
        if !self.first {
            self.changes(&old, &choice.stuck, &mut events);
        }
        made.events.append(&mut events);
        Ok(())
    }

    /// Checks a sliding contact that was pushed apart by its force, where it no longer is: returns the contact if it is
    /// stopped there; else that is an error.
    fn check_paradox(
        &mut self,
        scales: &Scales,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<Option<usize>, ContactError> {
        let Some(Watched::Pushes(i)) = self.fired else { return Ok(None) };
        let input = (made.input)(self.t, &self.q, &self.z);
        let bias = self.kernel.contact_dynamics(self.t, &self.q, &self.z, &input).bias;
        let presses = value(bias.component(self.kernel.contacts()[i].normal)) < 0.0;
        if presses && self.jams {
            let closed = (0..self.kernel.contacts().len())
                .filter(|&n| self.modes[n].is_closed() && takes_impulses(&self.kernel.contacts()[n]));
            self.jam(i, &closed.collect::<Vec<_>>(), scales.law, made)?;
            return Ok(Some(i));
        }
        Err(self.error(Some(i), if presses { ContactErrorKind::Inconsistent } else { ContactErrorKind::Indeterminate }))
    }

    /// Stops the slip of a contact by an impulse at a gap that is closed, with those that it makes at others: an impact
    /// without collision. With forces alone there is no motion.
    fn jam(
        &mut self,
        i: usize,
        contacts: &[usize],
        law: Impact,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<(), ContactError> {
        let friction = self.friction(made)?;
        let rates = self.kernel.contact_rates(self.t, &self.q, &self.z);
        let response = self.kernel.contact_response(self.t, &self.q);
        let rows = rows(self.kernel, contacts);
        let laws = contacts.iter().map(|&n| {
            let contact = &self.kernel.contacts()[n];
            Law::new(contact, Bounds::of(contact, &friction), None).among(contact, contacts)
        });
        let matrix = Matrix::from_fn(rows.len(), |a, b| response.delassus[(rows[a], rows[b])]);
        let before = rows.iter().map(|&row| rates.component(row)).collect();
        let solver = Contacts::new(laws.collect(), matrix, before);
        let place = contacts.iter().position(|&n| n == i).unwrap_or(0);
        let found = solver.where_sticks(place).map_err(|failure| self.failed(contacts, failure))?;
        let mut impulses = vec![K::Scalar::zero(); K::ContactRows::DIM];
        rows.iter().zip(&found.forces).for_each(|(&row, impulse)| impulses[row] = *impulse);
        self.z = after::<K>(&response, &self.z, &impulses);
        let residuals = contacts.iter().copied().zip(found.residuals).collect();
        made.solves.push(SolveRecord { time: value(self.t), impact: true, residuals });
        let impulses: Vec<f64> = impulses.iter().copied().map(value).collect();
        self.record(contacts, &rates, &impulses, (law, made))
    }

    /// The contacts whose gap is zero. Where one has just closed beyond zero, by less than what times are told apart
    /// by, gaps are brought to zero: else each bounce would be a little lower. In the metric of the energy that moves
    /// nothing by more than it has to; back along the motion it would be, at a small rate beside a large velocity, a
    /// long way.
    fn closed(&mut self, scales: &Scales) -> Result<Vec<bool>, ContactError> {
        let gaps = self.kernel.gaps(self.t, &self.q);
        let sizes = self.sizes(scales);
        let landed = if let Some(Watched::Gap(i)) = self.fired { Some(i) } else { None };
        let closed: Vec<bool> = (0..self.kernel.contacts().len())
            .map(|i| self.modes[i].is_closed() || landed == Some(i) || value(gaps.component(i)) <= sizes.of_gap[i])
            .collect();
        // A rim that lies flat on the ground has no rate, whose rounding would hide that the gap is zero.
        let is_unknown = |&i: &usize| {
            let (contact, gap) = (&self.kernel.contacts()[i], value(gaps.component(i)));
            contact.has_gap() && gap <= sizes.rounding[i] && !sizes.rates.component(contact.normal).is_finite()
        };
        if let Some(unknown) = (0..closed.len()).find(is_unknown) {
            return Err(self.error(Some(unknown), ContactErrorKind::NonFinite));
        }
        // What else closes at this time has to do so nearby, too.
        let known = |i: usize| {
            let late =
                value(sizes.rates.component(self.kernel.contacts()[i].normal)).abs() * largest_derivative(self.t);
            UNCLOSED * late.max(largest_derivative_of(&self.q))
        };
        let comes = |&i: &usize| closed[i] && !self.first && landed != Some(i) && !self.modes[i].is_closed();
        let apart = (0..closed.len()).filter(comes).find(|&i| largest_derivative(gaps.component(i)) > known(i));
        if let Some(apart) = apart {
            return Err(self.error(Some(apart), ContactErrorKind::Together));
        }
        if landed.is_some_and(|i| value(gaps.component(i)) < 0.0) {
            let zero = |i: usize| if closed[i] { Mode::Closed } else { Mode::Open };
            let modes: Vec<_> = (0..closed.len()).map(zero).collect();
            let onto = InMode::new(self.kernel, &modes).close_gaps(self.t, self.q);
            self.q = onto.map_err(|error| self.error(landed, ContactErrorKind::Projection(error)))?;
        }
        Ok(closed)
    }

    /// Friction of all contacts, checked.
    pub(crate) fn friction(&self, made: &ContactTrajectory<'k, K>) -> Result<K::ContactRows, ContactError> {
        let friction = self.kernel.friction(self.t, &self.q, &self.z, &(made.input)(self.t, &self.q, &self.z));
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            if let Some(friction) = invalid(contact, &friction) {
                return Err(self.error(Some(i), ContactErrorKind::InvalidFriction { friction }));
            }
        }
        Ok(friction)
    }

    /// Impacts until no closed gap closes further.
    fn impacts(
        &mut self,
        closed: &[bool],
        scales: &Scales,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<Option<Strike>, ContactError> {
        let friction = self.friction(made)?;
        let mut noise = vec![0.0; K::ContactRows::DIM];
        let mut first = None;
        let restitution = self.kernel.restitution();
        let most = if scales.law == Impact::Sequential { 10_000 } else { 100 };
        for count in 0..=most {
            let sizes = self.sizes(scales);
            let rate = |i: usize| value(sizes.rates.component(self.kernel.contacts()[i].normal));
            let roundings: Vec<f64> =
                sizes.of_rate.iter().zip(&noise).map(|(of_rate, noise)| of_rate + noise).collect();
            let rounding = |row: usize| roundings[row];
            let touches =
                |&i: &usize| closed[carrier(self.kernel.contacts(), i)] && takes_impulses(&self.kernel.contacts()[i]);
            let strikes = |i: &usize| {
                touches(i)
                    && self.kernel.contacts()[*i].has_gap()
                    && rate(*i) < -rounding(self.kernel.contacts()[*i].normal)
            };
            let fastest = (0..closed.len()).filter(strikes).min_by(|&a, &b| rate(a).total_cmp(&rate(b)));
            let Some(fastest) = fastest else { return Ok(first.map(|first| Strike { noise, first })) };
            first = first.or(Some((fastest, -rate(fastest))));
            if count == most {
                return Err(self.error(Some(fastest), ContactErrorKind::Zeno { impacts: count }));
            }
            let contacts: Vec<usize> = match scales.law {
                Impact::Sequential => with_rolling(self.kernel, fastest).collect(),
                _ => (0..closed.len()).filter(touches).collect(),
            };
            let response = self.kernel.contact_response(self.t, &self.q);
            let struck = Struck {
                kernel: self.kernel,
                contacts: &contacts,
                response: &response,
                rates: &sizes.rates,
                noise: &roundings,
                friction: &friction,
                restitution: &restitution,
            };
            let blow = struck.solve(scales.law).map_err(|failure| self.failed(&contacts, failure))?;
            self.z = after::<K>(&response, &self.z, &blow.impulses);
            made.solves.push(SolveRecord { time: value(self.t), impact: true, residuals: blow.residuals });
            let impulses: Vec<f64> = blow.impulses.iter().copied().map(value).collect();
            self.record(&contacts, &sizes.rates, &impulses, (scales.law, made))?;
            for (row, noise) in noise.iter_mut().enumerate() {
                let each = impulses.iter().enumerate().map(|(j, x)| (value(response.delassus[(row, j)]) * x).abs());
                *noise += 64.0 * epsilon::<K::Scalar>() * each.sum::<f64>();
            }
        }
        Ok(first.map(|first| Strike { noise, first }))
    }

    /// Records an impact, of which energy must not grow.
    fn record(
        &self,
        contacts: &[usize],
        before: &K::ContactRows,
        impulses: &[f64],
        (law, made): (Impact, &mut ContactTrajectory<'k, K>),
    ) -> Result<(), ContactError> {
        let now = self.kernel.contact_rates(self.t, &self.q, &self.z);
        let (mut lost, mut terms) = (0.0, 0.0);
        for &i in contacts {
            let contact = &self.kernel.contacts()[i];
            let first = usize::from(!contact.has_gap());
            let four = |of: &dyn Fn(usize) -> f64| {
                let mut four = [0.0; 4];
                contact.rows().zip(&mut four[first..]).for_each(|(row, entry)| *entry = of(row));
                four
            };
            let (u, v) = (four(&|row| value(before.component(row))), four(&|row| value(now.component(row))));
            let impulse = four(&|row| impulses[row]);
            let work: Vec<f64> = (0..4).map(|k| 0.5 * impulse[k] * (u[k] + v[k])).collect();
            let energy_lost = -work.iter().sum::<f64>();
            lost += energy_lost;
            terms += (0..4).map(|k| (impulse[k] * u[k]).abs() + (impulse[k] * v[k]).abs()).sum::<f64>();
            if impulse != [0.0; 4] {
                let kind = EventKind::Impact(ImpactRecord { before: u, after: v, impulse, energy_lost });
                made.events.push(ContactEvent {
                    time: value(self.t),
                    contact: i,
                    name: self.kernel.contacts()[i].name,
                    kind,
                });
            }
        }
        // Rates after are sums of R products, each with its roundings.
        if lost < -64.0 * (1 + impulses.len()) as f64 * epsilon::<K::Scalar>() * terms {
            let after = value(self.kernel.kinetic_energy(self.t, &self.q, &self.z));
            return Err(
                self.error(Some(contacts[0]), ContactErrorKind::EnergyGrows { law, before: after + lost, after })
            );
        }
        Ok(())
    }

    /// Chooses the modes of the contacts that rest, brings the state onto them; the accelerations of all rows.
    fn choose(
        &mut self,
        choice: &mut Choice<K::Scalar>,
        law: Impact,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<Vec<f64>, ContactError> {
        // Each time some of those that are forced are given up.
        loop {
            let stays = |i: usize| choice.resting[i] && !choice.leaves.contains(&carrier(self.kernel.contacts(), i));
            let contacts: Vec<usize> = (0..self.kernel.contacts().len()).filter(|&i| stays(i)).collect();
            let laws = self.bring_to_rest(&contacts, choice, made)?;
            let input = (made.input)(self.t, &self.q, &self.z);
            let dynamics = self.kernel.contact_dynamics(self.t, &self.q, &self.z, &input);
            let rows = rows(self.kernel, &contacts);
            let delassus = &dynamics.response.delassus;
            let solver = self.posed(laws.clone(), &rows, &dynamics);
            let solution = match solver.solve() {
                // A contact is stopped once: then its slip is not known to go on.
                Err(Failure::Inconsistent(n)) if self.jams && laws[n].along().is_some() => {
                    let gaps = contacts.iter().copied().filter(|&i| takes_impulses(&self.kernel.contacts()[i]));
                    self.jam(contacts[n], &gaps.collect::<Vec<_>>(), law, made)?;
                    choice.stuck[contacts[n]] = true;
                    continue;
                }
                solved => solved.map_err(|failure| self.failed(&contacts, failure))?,
            };
            let rate = |row: usize| {
                let each =
                    rows.iter().zip(&solution.forces).map(|(&column, force)| value(delassus[(row, column)] * *force));
                let free = value(dynamics.bias.component(row));
                let terms = each.clone().fold(free.abs(), |sum, term| sum + term.abs());
                (each.fold(free, |sum, term| sum + term), 256.0 * epsilon::<K::Scalar>() * terms)
            };
            let accelerations: Vec<(f64, f64)> = (0..K::ContactRows::DIM).map(rate).collect();
            let falls_back = |i: &usize| {
                let (rate, rounding) = accelerations[self.kernel.contacts()[*i].normal];
                choice.resting[*i] && rate < -rounding
            };
            let slides_back = |(i, along): &(usize, [K::Scalar; 3])| {
                let each = tangents(&self.kernel.contacts()[*i]).zip(along);
                each.clone().map(|(row, s)| accelerations[row].0 * value(*s)).sum::<f64>()
                    < -each.map(|(row, _)| accelerations[row].1).sum::<f64>()
            };
            let leaves: Vec<_> = choice.leaves.iter().copied().filter(|i| !falls_back(i)).collect();
            let slides: Vec<_> = choice.slides.iter().copied().filter(|slide| !slides_back(slide)).collect();
            if leaves.len() < choice.leaves.len() || slides.len() < choice.slides.len() {
                (choice.leaves, choice.slides) = (leaves, slides);
                continue;
            }
            let mut modes = vec![Mode::Open; self.kernel.contacts().len()];
            for ((&i, law), state) in contacts.iter().zip(&laws).zip(&solution.states) {
                modes[i] = match (state, law.along()) {
                    (State::Leaves, _) => Mode::Open,
                    (State::Closed, Some(along)) => Mode::Slides(along),
                    (State::Closed, None) => Mode::Closed,
                    (State::Sticks, _) => Mode::Sticks,
                    (State::Slides(along), _) => Mode::Slides(*along),
                };
            }
            self.modes = modes;
            let residuals = contacts.into_iter().zip(solution.residuals).collect();
            made.solves.push(SolveRecord { time: value(self.t), impact: false, residuals });
            return Ok(accelerations.into_iter().map(|(rate, _)| rate).collect());
        }
    }

    /// The laws of contacts with these rows for the accelerations.
    fn posed(&self, laws: Vec<Law<K::Scalar>>, rows: &[usize], dynamics: &ContactDynamics<K>) -> Contacts<K::Scalar> {
        let delassus = &dynamics.response.delassus;
        let matrix = Matrix::from_fn(rows.len(), |i, j| delassus[(rows[i], rows[j])]);
        let bias = rows.iter().map(|&row| dynamics.bias.component(row)).collect();
        // Accelerations are sums as rates are.
        let jacobian = self.kernel.contact_jacobian(self.t, &self.q);
        let of_row = |row: usize| jacobian.nth(row).map_or(0.0, |column| terms(&column, &dynamics.acceleration));
        let noise = rows.iter().map(|&row| 64.0 * epsilon::<K::Scalar>() * of_row(row));
        Contacts::new(laws, matrix, bias).known_to(noise)
    }

    /// Brings gaps of contacts, their rates and slips that have ended to zero; the laws for the accelerations there.
    fn bring_to_rest(
        &mut self,
        contacts: &[usize],
        choice: &mut Choice<K::Scalar>,
        made: &ContactTrajectory<'k, K>,
    ) -> Result<Vec<Law<K::Scalar>>, ContactError> {
        // Slips that depend on one another end together: what one of them stops, no other slides on by.
        let slips = loop {
            let slips: Vec<_> = contacts.iter().map(|&i| self.slides(i, choice)).collect();
            let mut modes = vec![Mode::Open; self.kernel.contacts().len()];
            for (&i, slip) in contacts.iter().zip(&slips) {
                modes[i] = match (tangents(&self.kernel.contacts()[i]).len(), slip) {
                    (0, _) => Mode::Closed,
                    (_, Some(along)) => Mode::Slides(*along),
                    _ => Mode::Sticks,
                };
            }
            let projected = InMode::new(self.kernel, &modes).project(self.t, &self.q, &self.z);
            (self.q, self.z) = projected.map_err(|error| self.error(None, ContactErrorKind::Projection(error)))?;
            let stopped = |(&i, slip): (&usize, &Option<_>)| slip.is_some() && self.slides(i, choice).is_none();
            let stopped: Vec<usize> =
                contacts.iter().zip(&slips).filter(|&pair| stopped(pair)).map(|(&i, _)| i).collect();
            if stopped.is_empty() {
                break slips;
            }
            stopped.into_iter().for_each(|i| choice.stuck[i] = true);
        };
        let friction = self.friction(made)?;
        let law = |(&i, slip): (&usize, Option<[K::Scalar; 3]>)| {
            let contact = &self.kernel.contacts()[i];
            let forced = choice.slides.iter().find(|(n, _)| *n == i).map(|(_, along)| *along);
            let along = slip.or(forced).filter(|_| !tangents(contact).is_empty());
            Law::new(contact, Bounds::of(contact, &friction), along).among(contact, contacts)
        };
        Ok(contacts.iter().zip(slips).map(law).collect())
    }

    /// The direction in which a contact slides.
    pub(crate) fn slides(&self, i: usize, choice: &Choice<K::Scalar>) -> Option<[K::Scalar; 3]> {
        let contact = &self.kernel.contacts()[i];
        let along = slip(contact, &self.kernel.contact_rates(self.t, &self.q, &self.z));
        let slow = if tangents(contact).len() > 1 { choice.slow } else { 0.0 };
        let moves = !choice.stuck[i] && size(&along) > norm(&choice.still[tangents(contact)]).max(slow);
        moves.then(|| {
            let length = norm(&along);
            along.map(|s| s / length)
        })
    }

    /// Changes of modes as events.
    fn changes(&self, old: &[Mode<K::Scalar>], stopped: &[bool], events: &mut Vec<ContactEvent>) {
        for (contact, (old, new)) in old.iter().zip(&self.modes).enumerate() {
            let reverses = |a: &[K::Scalar; 3], b: &[K::Scalar; 3]| value(dot(a, b)) < 0.0;
            let several = |i: usize| tangents(&self.kernel.contacts()[i]).len() > 1;
            let turned = |i: usize| self.fired == Some(Watched::Slip(i)) && several(i) && !stopped[i];
            let kind = match (old, new) {
                (Mode::Open, Mode::Sticks | Mode::Slides(_)) | (Mode::Sticks | Mode::Slides(_), Mode::Open)
                    if !self.kernel.contacts()[contact].has_gap() =>
                {
                    continue;
                }
                (Mode::Open, new) if new.is_closed() && events.iter().all(|event| event.contact != contact) => {
                    EventKind::Closes
                }
                (old, Mode::Open) if old.is_closed() => EventKind::Leaves,
                (Mode::Sticks, Mode::Slides(along)) => EventKind::Slides(along.map(value)),
                (Mode::Slides(_), Mode::Sticks) => EventKind::Sticks,
                // A slip of several rows may turn by as much on its way.
                (Mode::Slides(_), Mode::Slides(_)) if turned(contact) => continue,
                (Mode::Slides(before), Mode::Slides(along)) if reverses(before, along) => {
                    EventKind::Reverses(along.map(value))
                }
                _ => continue,
            };
            events.push(ContactEvent {
                time: value(self.t),
                contact,
                name: self.kernel.contacts()[contact].name,
                kind,
            });
        }
    }
}
