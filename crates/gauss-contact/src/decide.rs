//! What becomes of a state at an event: impacts, then the modes of the contacts.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::forces::Columns;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::{Real, largest_derivative};
use gauss_runtime::system::GaussSystem;

use crate::dense::{Matrix, dot, epsilon, norm, size, sum, value};
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

/// What a run tells apart.
pub(crate) struct Scales {
    pub(crate) tolerance: Tolerance,
    /// The largest speed at an event so far.
    pub(crate) largest: f64,
    pub(crate) law: Impact,
    /// The start of the run.
    pub(crate) start: f64,
    /// The rounding of values.
    pub(crate) epsilon: f64,
}

impl Scales {
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
    /// Whether a contact that slides into Painlevé's paradox is stopped by an impulse.
    pub(crate) jams: bool,
}

/// What is known of the contacts while modes are chosen.
struct Choice<T> {
    /// Gap and its rate are zero.
    resting: Vec<bool>,
    /// Opens although it is on zero: its force has fallen to zero.
    leaves: Option<usize>,
    /// Begins to slide in this direction: friction has reached its bound.
    slides: Option<(usize, [T; 3])>,
    /// Slips below are zero.
    still: Vec<f64>,
    /// The slip is zero whatever its number is.
    stuck: Vec<bool>,
}

/// Whether impacts act on it: not on dry friction, whose force is bounded.
fn takes_impulses(contact: &Contact) -> bool {
    contact.has_gap() || contact.rolls_on().is_some()
}

/// A contact with the resistance to rolling on it.
fn with_rolling<K: ContactSystem>(i: usize) -> impl Iterator<Item = usize> {
    (0..K::CONTACTS.len()).filter(move |&n| carrier(K::CONTACTS, n) == i)
}

impl<'k, K: ContactSystem> Instant<'k, K> {
    fn error(&self, contact: Option<usize>, kind: ContactErrorKind) -> ContactError {
        ContactError { contact: contact.map(|i| K::CONTACTS[i].name), time: value(self.t), kind }
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
        let mut rounding = vec![0.0; K::CONTACTS.len()];
        for i in 0..TangentOf::<K>::DIM {
            let mut sigma = TangentOf::<K>::zero();
            sigma.set_component(i, K::Scalar::from_f64(16.0 * epsilon::<K::Scalar>() * size));
            let moved = kernel.gaps(*t, &q.retract(&sigma));
            (0..rounding.len()).for_each(|n| rounding[n] += value(moved.component(n) - here.component(n)).abs());
        }
        let late = 4.0 * scales.resolution(value(*t));
        let within =
            |(contact, rounding): (&Contact, &f64)| late.fma(value(rates.component(contact.normal)).abs(), *rounding);
        let of_gap = K::CONTACTS.iter().zip(&rounding).map(within).collect();
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
        let slides = self.begins_to_slide(made);
        let closed = self.closed(scales)?;
        let before = self.sizes(scales);
        let noise = self.impacts(&closed, scales, made)?;
        let struck = noise.is_some();
        let now = self.sizes(scales);
        let mut still: Vec<f64> = before.of_rate.iter().zip(&now.of_rate).map(|(a, b)| a.max(*b)).collect();
        still.iter_mut().zip(noise.iter().flatten()).for_each(|(still, noise)| *still += noise);
        let rests = |i: usize| {
            let i = carrier(K::CONTACTS, i);
            let contact = &K::CONTACTS[i];
            closed[i] && (!contact.has_gap() || value(now.rates.component(contact.normal)) <= still[contact.normal])
        };
        let stuck = |i: usize| match self.fired {
            Some(Watched::Speed(n, _)) if n == i => true,
            Some(Watched::Slip(n)) if n == i => {
                tangents(&K::CONTACTS[i]).len() == 1 || size(&slip(&K::CONTACTS[i], &now.rates)) <= scales.rest()
            }
            _ => matches!(self.modes[i], Mode::Sticks),
        };
        let contacts = 0..K::CONTACTS.len();
        let mut choice = Choice {
            resting: contacts.clone().map(rests).collect(),
            leaves: self.fired.and_then(|fired| if let Watched::Force(i) = fired { Some(i) } else { None }),
            slides,
            stuck: contacts.clone().map(|i| !struck && (stuck(i) || jammed == Some(i))).collect(),
            still,
        };
        let old = self.modes.clone();
        let mut events = Vec::new();
        loop {
            let accelerations = self.choose(&mut choice, scales.law, made)?;
            let next = contacts.clone().find_map(|i| {
                let candidate = struck && closed[i] && !choice.resting[i] && K::CONTACTS[i].has_gap();
                let kind = candidate.then(|| self.comes_to_rest(i, &accelerations, scales))??;
                Some((i, kind))
            });
            let Some((i, kind)) = next else { break };
            with_rolling::<K>(i).for_each(|n| choice.resting[n] = true);
            self.leave_out_bounces(i, &choice, made)?;
            events.push(ContactEvent { time: value(self.t), contact: i, kind });
        }
        if !self.first {
            self.changes(&old, &choice.stuck, &mut events);
        }
        made.events.append(&mut events);
        Ok(())
    }

    /// Where a sliding contact that was pushed apart by its force no longer is: the contact, if it is stopped there;
    /// else that is an error.
    fn check_paradox(
        &mut self,
        scales: &Scales,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<Option<usize>, ContactError> {
        let Some(Watched::Pushes(i)) = self.fired else { return Ok(None) };
        let input = (made.input)(self.t, &self.q, &self.z);
        let bias = self.kernel.contact_dynamics(self.t, &self.q, &self.z, &input).bias;
        let presses = value(bias.component(K::CONTACTS[i].normal)) < 0.0;
        if presses && self.jams {
            let closed =
                (0..K::CONTACTS.len()).filter(|&n| self.modes[n].is_closed() && takes_impulses(&K::CONTACTS[n]));
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
        let rows = rows::<K>(contacts);
        let laws = contacts.iter().map(|&n| {
            let contact = &K::CONTACTS[n];
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

    /// The direction in which a contact that stuck begins to slide: against its friction.
    fn begins_to_slide(&self, made: &ContactTrajectory<'k, K>) -> Option<(usize, [K::Scalar; 3])> {
        let Some(Watched::Cone(i)) = self.fired else { return None };
        let system = InMode::new(self.kernel, &self.modes);
        let loads = system.loads(self.t, &self.q, &self.z, &(made.input)(self.t, &self.q, &self.z));
        let contact = &K::CONTACTS[i];
        let friction = self.kernel.friction(self.t, &self.q, &self.z, &(made.input)(self.t, &self.q, &self.z));
        let along = Bounds::of(contact, &friction).gives_way(&loads.forces[tangents(contact)])?;
        Some((i, along))
    }

    /// The contacts whose gap is zero. Where one has just closed, the state goes back by as much of the time as the gap
    /// is beyond zero, less than what times are told apart by: else each bounce would be a little lower than zero.
    fn closed(&mut self, scales: &Scales) -> Result<Vec<bool>, ContactError> {
        let gaps = self.kernel.gaps(self.t, &self.q);
        let sizes = self.sizes(scales);
        let landed = if let Some(Watched::Gap(i)) = self.fired { Some(i) } else { None };
        let closed: Vec<bool> = (0..K::CONTACTS.len())
            .map(|i| self.modes[i].is_closed() || landed == Some(i) || value(gaps.component(i)) <= sizes.of_gap[i])
            .collect();
        // A rim that lies flat on the ground has no rate, whose rounding would hide that the gap is zero.
        let is_unknown = |&i: &usize| {
            let (contact, gap) = (&K::CONTACTS[i], value(gaps.component(i)));
            contact.has_gap() && gap <= sizes.rounding[i] && !sizes.rates.component(contact.normal).is_finite()
        };
        if let Some(unknown) = (0..closed.len()).find(is_unknown) {
            return Err(self.error(Some(unknown), ContactErrorKind::NonFinite));
        }
        // What else closes at this time has to do so nearby, too.
        let known = |i: usize| {
            let late = value(sizes.rates.component(K::CONTACTS[i].normal)).abs() * largest_derivative(self.t);
            UNCLOSED * late.max(largest_derivative_of(&self.q))
        };
        let comes = |&i: &usize| closed[i] && !self.first && landed != Some(i) && !self.modes[i].is_closed();
        let apart = (0..closed.len()).filter(comes).find(|&i| largest_derivative(gaps.component(i)) > known(i));
        if let Some(apart) = apart {
            return Err(self.error(Some(apart), ContactErrorKind::Together));
        }
        if let Some(i) = landed {
            let (gap, rate) = (gaps.component(i), sizes.rates.component(K::CONTACTS[i].normal));
            if value(gap) < 0.0 && value(rate) < -sizes.of_rate[K::CONTACTS[i].normal] {
                let velocity = self.kernel.kinematics(self.t, &self.q, &self.z);
                self.q = self.q.retract(&velocity.scale(-gap / rate)).renormalise();
            }
        }
        Ok(closed)
    }

    /// Friction of all contacts, checked.
    fn friction(&self, made: &ContactTrajectory<'k, K>) -> Result<K::ContactRows, ContactError> {
        let friction = self.kernel.friction(self.t, &self.q, &self.z, &(made.input)(self.t, &self.q, &self.z));
        for (i, contact) in K::CONTACTS.iter().enumerate() {
            if let Some(friction) = invalid(contact, &friction) {
                return Err(self.error(Some(i), ContactErrorKind::InvalidFriction { friction }));
            }
        }
        Ok(friction)
    }

    /// Impacts until no closed gap closes further. Where there were any: what the rounding of their impulses makes of
    /// rates, since impulses that cancel leave no rate to tell it from.
    fn impacts(
        &mut self,
        closed: &[bool],
        scales: &Scales,
        made: &mut ContactTrajectory<'k, K>,
    ) -> Result<Option<Vec<f64>>, ContactError> {
        let friction = self.friction(made)?;
        let mut noise = vec![0.0; K::ContactRows::DIM];
        let restitution = self.kernel.restitution();
        let most = if scales.law == Impact::Sequential { 10_000 } else { 100 };
        for count in 0..=most {
            let sizes = self.sizes(scales);
            let rate = |i: usize| value(sizes.rates.component(K::CONTACTS[i].normal));
            let rounding = |row: usize| sizes.of_rate[row] + noise[row];
            let touches = |&i: &usize| closed[carrier(K::CONTACTS, i)] && takes_impulses(&K::CONTACTS[i]);
            let strikes =
                |i: &usize| touches(i) && K::CONTACTS[*i].has_gap() && rate(*i) < -rounding(K::CONTACTS[*i].normal);
            let fastest = (0..closed.len()).filter(strikes).min_by(|&a, &b| rate(a).total_cmp(&rate(b)));
            let Some(fastest) = fastest else { return Ok((count > 0).then_some(noise)) };
            if count == most {
                return Err(self.error(Some(fastest), ContactErrorKind::Zeno { impacts: count }));
            }
            let contacts: Vec<usize> = match scales.law {
                Impact::Sequential => with_rolling::<K>(fastest).collect(),
                _ => (0..closed.len()).filter(touches).collect(),
            };
            let response = self.kernel.contact_response(self.t, &self.q);
            let struck = Struck {
                contacts: &contacts,
                response: &response,
                rates: &sizes.rates,
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
        Ok(Some(noise))
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
            let contact = &K::CONTACTS[i];
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
                made.events.push(ContactEvent { time: value(self.t), contact: i, kind });
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

    /// Whether the bounces of a gap that has just been left at a small rate are over: they would end after
    /// 2 ġ/(|g̈| (1 − e)).
    fn comes_to_rest(&self, i: usize, accelerations: &[f64], scales: &Scales) -> Option<EventKind> {
        let normal = K::CONTACTS[i].normal;
        let sizes = self.sizes(scales);
        let (speed, fall) = (value(sizes.rates.component(normal)), -accelerations[normal]);
        let e = value(self.kernel.restitution().component(i));
        if !(fall > 0.0 && e < 1.0) {
            return None;
        }
        let (height, remaining) = (speed * speed / (2.0 * fall), 2.0 * speed / (fall * (1.0 - e)));
        let over = speed <= scales.rest()
            || height <= 8.0 * sizes.rounding[i]
            || remaining <= 16.0 * scales.resolution(value(self.t));
        over.then_some(EventKind::Rests { speed, height, remaining })
    }

    /// Takes the rate of a gap away at which bounces are left out. In all of them together the contact passes on what
    /// it would at rest in that time, less this momentum; so friction of a contact that slides is less by as much.
    fn leave_out_bounces(
        &mut self,
        i: usize,
        choice: &Choice<K::Scalar>,
        made: &ContactTrajectory<'k, K>,
    ) -> Result<(), ContactError> {
        let (contact, rates) = (&K::CONTACTS[i], self.kernel.contact_rates(self.t, &self.q, &self.z));
        let response = self.kernel.contact_response(self.t, &self.q);
        let mut impulses = vec![K::Scalar::zero(); K::ContactRows::DIM];
        impulses[contact.normal] = K::Scalar::one();
        for contact in with_rolling::<K>(i).map(|n| &K::CONTACTS[n]) {
            let along = slip(contact, &rates);
            if size(&along) > norm(&choice.still[tangents(contact)]) {
                let length = norm(&along);
                let against = Bounds::of(contact, &self.friction(made)?).against(along.map(|s| s / length));
                tangents(contact).zip(against).for_each(|(row, force)| impulses[row] = force);
            }
        }
        let unit = impulses.iter().enumerate().map(|(row, part)| response.delassus[(contact.normal, row)] * *part);
        let lifted = sum(unit);
        // Else the gap's rate alone is taken away, with the projection.
        if value(lifted) > 0.0 {
            let by = -rates.component(contact.normal) / lifted;
            impulses.iter_mut().for_each(|part| *part *= by);
            self.z = after::<K>(&response, &self.z, &impulses);
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
        // Each time one of the two that are forced is given up.
        loop {
            let stays = |i: usize| choice.resting[i] && choice.leaves != Some(carrier(K::CONTACTS, i));
            let contacts: Vec<usize> = (0..K::CONTACTS.len()).filter(|&i| stays(i)).collect();
            let laws = self.bring_to_rest(&contacts, choice, made)?;
            let input = (made.input)(self.t, &self.q, &self.z);
            let dynamics = self.kernel.contact_dynamics(self.t, &self.q, &self.z, &input);
            let rows = rows::<K>(&contacts);
            let delassus = &dynamics.response.delassus;
            let matrix = Matrix::from_fn(rows.len(), |i, j| delassus[(rows[i], rows[j])]);
            let bias = rows.iter().map(|&row| dynamics.bias.component(row)).collect();
            let solver = Contacts::new(laws.clone(), matrix, bias);
            let solution = match solver.solve() {
                // A contact is stopped once: then its slip is not known to go on.
                Err(Failure::Inconsistent(n)) if self.jams && laws[n].along().is_some() => {
                    let gaps = contacts.iter().copied().filter(|&i| takes_impulses(&K::CONTACTS[i]));
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
            let falls_back = choice.leaves.is_some_and(|i| {
                let (rate, rounding) = accelerations[K::CONTACTS[i].normal];
                choice.resting[i] && rate < -rounding
            });
            let slides_back = choice.slides.is_some_and(|(i, along)| {
                let each = tangents(&K::CONTACTS[i]).zip(along);
                each.clone().map(|(row, s)| accelerations[row].0 * value(s)).sum::<f64>()
                    < -each.map(|(row, _)| accelerations[row].1).sum::<f64>()
            });
            if falls_back || slides_back {
                choice.leaves = choice.leaves.filter(|_| !falls_back);
                choice.slides = choice.slides.filter(|_| !slides_back);
                continue;
            }
            let mut modes = vec![Mode::Open; K::CONTACTS.len()];
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
            let mut modes = vec![Mode::Open; K::CONTACTS.len()];
            for (&i, slip) in contacts.iter().zip(&slips) {
                modes[i] = match (tangents(&K::CONTACTS[i]).len(), slip) {
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
            let contact = &K::CONTACTS[i];
            let forced = choice.slides.filter(|(n, _)| *n == i).map(|(_, along)| along);
            let along = slip.or(forced).filter(|_| !tangents(contact).is_empty());
            Law::new(contact, Bounds::of(contact, &friction), along).among(contact, contacts)
        };
        Ok(contacts.iter().zip(slips).map(law).collect())
    }

    /// The direction in which a contact slides.
    fn slides(&self, i: usize, choice: &Choice<K::Scalar>) -> Option<[K::Scalar; 3]> {
        let contact = &K::CONTACTS[i];
        let along = slip(contact, &self.kernel.contact_rates(self.t, &self.q, &self.z));
        let moves = !choice.stuck[i] && size(&along) > norm(&choice.still[tangents(contact)]);
        moves.then(|| {
            let length = norm(&along);
            along.map(|s| s / length)
        })
    }

    /// Changes of modes as events.
    fn changes(&self, old: &[Mode<K::Scalar>], stopped: &[bool], events: &mut Vec<ContactEvent>) {
        for (contact, (old, new)) in old.iter().zip(&self.modes).enumerate() {
            let reverses = |a: &[K::Scalar; 3], b: &[K::Scalar; 3]| value(dot(a, b)) < 0.0;
            let several = |i: usize| tangents(&K::CONTACTS[i]).len() > 1;
            let turned = |i: usize| self.fired == Some(Watched::Slip(i)) && several(i) && !stopped[i];
            let kind = match (old, new) {
                (Mode::Open, Mode::Sticks | Mode::Slides(_)) | (Mode::Sticks | Mode::Slides(_), Mode::Open)
                    if !K::CONTACTS[contact].has_gap() =>
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
            events.push(ContactEvent { time: value(self.t), contact, kind });
        }
    }
}
