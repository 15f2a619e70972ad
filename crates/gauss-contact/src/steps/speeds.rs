//! The speeds at which a step takes its forces.
//!
//! Forces are taken once, at half of a step. With the *mean* speeds of the step, `z̄ = (z + z⁺)/2`, gyroscopic forces
//! do no work however far a step turns, and forces against the speeds take energy away however stiff they are:
//! `z̄·A(z⁺ − z)` is the work of the forces that were taken. But z⁺ is not known before: speeds at half of a step are
//! foreseen by the acceleration of the step before, or are those before the step. Forces that depend on speeds then
//! work on other speeds than they were taken at, and some make these grow without bound, by (ωh)⁴/4 a step where a body
//! turns by ωh. Steps without a memory are made three times instead: from speeds that the acceleration without contacts
//! foresees, and then twice from the mean ones; of what turns by x = ωh a step then takes away x⁶/32, and gives none.
//!
//! So a step looks back. Where the speeds that were used are the mean ones to a part `NEAR`, or forces at the mean
//! ones would not change a speed by more than a part [`ALLOWED`] of it, it is taken as it is: what is left is a growth
//! by at most that part, of a body that turns of its power 4/3: 10⁻⁸. What dampers differ by shrinks by itself as long
//! as it is smaller than the difference of the speeds. Else the step is made again from the end that it had, until
//! speeds agree; where it is too long for that, it is made in parts, and refused in the end: so this check is the watch
//! over the energy of a step, since forces at the mean speeds do the work that they should. Where springs are stiff it
//! takes them at the mean place as well (`stiffness`).
//!
//! A step that is made again uses `z̄ − h/12 (a⁺ − a⁻)` with the accelerations at both ends, which is the mean over
//! time to fourth order: where a body spins evenly, h ω errs by (ωh)⁵/720, in place of (ωh)³/12, by which a ball in the
//! air would leave its way. Energy is kept as well: of z' = iωz that is the Padé approximation of degrees (2, 2).

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use crate::error::{ContactError, ContactErrorKind};

use super::motion::{self, Mean, Middle, Rule};
use super::outcome::{Attempt, End, Refused, has_no_end};
use super::report::{StepReport, StepScheme};
use super::stepper::ContactStepper;
use super::used::{ALLOWED, Used};
use super::watch::Watch;

/// The same where a step is made again.
const SETTLED: f64 = 1e-9;
/// The part of a speed by which those at which forces were taken may differ from the mean ones then.
const NEARLY: f64 = 3e-8;
/// The part of a speed that may be left of a difference in a step that has no other end: where it cannot be shorter and
/// contacts do one thing at some speeds and another one at those that follow from it, or where no impulses are found at
/// these. It comes once, and not from step to step.
const MILD: f64 = 1e-2;
/// The number of times a step is made again, at most.
const CORRECTIONS: usize = 24;
/// Part of the first difference above which the second one has a step made in parts: where a body turns by a fifth of a
/// radian in it, so that places err by its square over 24, or a speed is damped by a fifth.
const STIFF: f64 = 0.1;
/// The same where parts cannot be shorter.
const STIFF_AT_LAST: f64 = 0.5;
/// The same of damping where parts cannot be shorter: of a speed that is damped to 4 · 10⁻³ in one, an eighth is left.
const STIFFEST: f64 = 8.0;
/// The part of a speed by which forces may change it in a step with an impact, for what they differ by at both ends:
/// the square of ωh at which attempts settle as [`STIFF`] has it.
const FOLLOWED: f64 = 4.0 * STIFF;
/// Roundings of places in a step.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// The least part of a difference by which speeds are changed.
const LEAST_PART: f64 = 0.02;

/// The differences of speeds at half of a step to others: of those at which forces are taken, and of those that lead to
/// the place where they are.
type Off<V> = [V; 2];

/// A step that was made again, and what it would be refused for.
type Corrected<K> = (Middle<K>, Attempt<K>, Option<ContactError>);

/// The largest component, and its place.
fn largest<V: VectorSpace<f64>>(off: &Off<V>) -> (f64, usize) {
    let larger = |worst: (f64, usize), (off, i): (f64, usize)| if off > worst.0 { (off, i) } else { worst };
    off.iter().flat_map(|off| (0..V::DIM).map(|i| (off.component(i).abs(), i))).fold((0.0, 0), larger)
}

fn product<V: VectorSpace<f64>>(a: &Off<V>, b: &Off<V>) -> f64 {
    let each = a.iter().zip(b).flat_map(|(a, b)| (0..V::DIM).map(|i| a.component(i) * b.component(i)));
    each.sum()
}

/// Whether a difference is against the one before, as of a speed that is damped; where a body turns they are across.
fn opposes<V: VectorSpace<f64>>(before: &Off<V>, after: &Off<V>) -> bool {
    product(before, after) < -0.7 * Real::sqrt(product(before, before) * product(after, after))
}

/// Part of a difference by which speeds are changed next, from the part before and the differences before and after it
/// (A. C. Aitken; B. Irons & R. Tuck 1969): of one linear force that is all that is left, whatever its sign.
fn relaxation<V: VectorSpace<f64>>(part: f64, before: &Off<V>, after: &Off<V>) -> f64 {
    let change = core::array::from_fn(|k| after[k].add_scaled(-1.0, &before[k]));
    let next = -part * product(before, &change) / product(&change, &change);
    if next.is_finite() { next.clamp(LEAST_PART, 1.0) } else { 1.0 }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// A step that is not made in parts. `last`: whether parts would not be shorter; `accounts`: whether its impacts
    /// may gain no more than a little.
    pub(super) fn whole<W: Watch<K>>(
        &mut self,
        h: f64,
        input: &K::Input,
        (watch, last, accounts): (&mut W, bool, bool),
    ) -> Result<StepReport, Refused> {
        let dependent = self.dependent;
        let (mut middle, mut made) = self.foreseen(h, input, watch)?;
        if self.stiffens(h, (&middle, &made), input) {
            self.last.stiffen();
            if !middle.is_mean {
                (middle, made) = self.again(h, (&middle, &made), input, (watch, true))?;
            }
        }
        if let Some(speed) = self.steep(h, (&middle, &made), input) {
            return Err(self.too_stiff(h, speed).into());
        }
        let mut doubt = None;
        if !self.agrees(h, (&middle, &made), input) {
            let mean = motion::mean(&self.z, &made.end.z);
            let at_place = middle.is_mean.then(|| self.to_mean(h, &middle, mean, mean));
            let mean = at_place.unwrap_or(Middle { z: mean, ..middle });
            let at_mean = self.kernel.acceleration(mean.t, &mean.q, &mean.z, input);
            let is_mild = self.used(h, &middle, &made).is_within(MILD, [&made.acceleration, &at_mean]);
            (middle, made, doubt) = match self.corrected(h, (middle, made), input, (watch, last)) {
                // What has a solution as it was foreseen is no error for having none with forces that hardly differ.
                Err(cause) if is_mild && (last || has_no_end(&cause)) => {
                    self.dependent = dependent;
                    let (middle, made) = self.foreseen(h, input, watch)?;
                    (middle, made, Some(cause))
                }
                made => made?,
            };
        }
        if let Some(speed) = self.overshoots(h, (&middle, &made), input) {
            return Err(self.too_stiff(h, speed).into());
        }
        if self.scheme == StepScheme::MoreauJean {
            self.follows(h, (&middle, &made), input)?;
        }
        let stiff = self.strikes_stiffly(h, (&middle, &made), input).map(|speed| self.too_stiff(h, speed));
        let is_stiff = stiff.is_some();
        match stiff {
            Some(cause) if !last => return Err(cause.into()),
            stiff => doubt = doubt.or(stiff),
        }
        if made.end.struck || doubt.is_some() {
            let gain = self.gain(h, (&made, is_stiff), input);
            made.end.report.unexplained = gain.unexplained;
            if let Some(cause) = doubt.filter(|_| gain.is_much()) {
                return Err(cause.into());
            }
            let error = gain.is_more_than_all().then(|| self.error(None, gain.kind(h)));
            if error.is_some() || accounts && !gain.is_little() {
                return Err(Refused::Gains(error));
            }
        }
        watch.part((self.t, h), made.end.attempted(self.next.as_ref()));
        Ok(self.take(h, made)?)
    }

    /// The error of forces that change a speed more than a step can follow.
    fn too_stiff(&self, h: f64, speed: usize) -> ContactError {
        self.error(None, ContactErrorKind::Stiff { speed, step: h })
    }

    /// A step with forces at the speeds that are foreseen at half of it.
    fn foreseen<W: Watch<K>>(
        &mut self,
        h: f64,
        input: &K::Input,
        watch: &mut W,
    ) -> Result<(Middle<K>, Attempt<K>), ContactError> {
        let rate = self.kernel.kinematics(self.t, &self.q, &self.z);
        let (mut middle, known) = self.middle(h, &rate);
        let has_memory = self.scheme == StepScheme::Midpoint;
        if !has_memory {
            let free = self.kernel.acceleration(middle.t, &middle.q, &self.z, input);
            middle.z = self.z.add_scaled(0.5 * h, &free);
        }
        let by_mean = has_memory && known && self.last.is_stiff();
        if by_mean {
            middle = self.to_mean(h, &middle, middle.z, middle.z);
        }
        watch.begins(by_mean);
        let mut made = self.attempt(h, &middle, input)?;
        let again = match has_memory {
            true => usize::from(!known && !made.end.struck),
            false => 2,
        };
        for _ in 0..again {
            // Speeds have jumped before the step of a scheme with a memory, or it is the first: by the mean place
            // impulses do the work of their mean rates. Steps without one are to be smooth: they stay where they were.
            let at_mean_place = has_memory;
            (middle, made) = self.again(h, (&middle, &made), input, (watch, at_mean_place))?;
        }
        Ok((middle, made))
    }

    /// Whether forces change much with places in a step of which nothing is known but its start: there, or on the way
    /// to which the acceleration at half of it leads.
    fn is_stiff(&self, h: f64, middle: &Middle<K>, free: &K::Speeds, input: &K::Input) -> bool {
        let after = self.z.add_scaled(h, free);
        let used = Used { h, least: self.least(h), before: self.z, used: self.z, acceleration: *free, after };
        let of_places = |q: &K::Configuration| self.of_places(middle.t, q, input);
        let (half, far) = (of_places(&middle.half), || of_places(&self.to_mean(h, middle, middle.z, self.z).q));
        used.stiffens([&half, &of_places(&self.q)]) || used.stiffens_on_way([&half, &far()])
    }

    /// The acceleration by forces that depend on places alone: those that come with speeds, as of arms that turn, do
    /// not swing.
    pub(super) fn of_places(&self, t: f64, q: &K::Configuration, input: &K::Input) -> K::Speeds {
        self.kernel.acceleration(t, q, &K::Speeds::zero(), input)
    }

    /// The speeds that places have for rounding alone, in a step.
    pub(super) fn least(&self, h: f64) -> f64 {
        ROUNDING * motion::magnitude(&self.q) / h
    }

    /// A step with forces at the mean speeds of the attempt before, and at the mean place or where they were.
    fn again<W: Watch<K>>(
        &mut self,
        h: f64,
        (middle, made): (&Middle<K>, &Attempt<K>),
        input: &K::Input,
        (watch, at_mean_place): (&mut W, bool),
    ) -> Result<(Middle<K>, Attempt<K>), ContactError> {
        let rule = Rule { mean: Mean::Ends, part: 1.0, at_mean_place };
        watch.again(made.end.attempted(self.next.as_ref()), rule);
        let mean = motion::mean(&self.z, &made.end.z);
        let middle = if at_mean_place { self.to_mean(h, middle, mean, mean) } else { Middle { z: mean, ..*middle } };
        let made = self.attempt(h, &middle, input)?;
        Ok((middle, made))
    }

    /// The place to which speeds lead along half of a step, with those at which forces are taken there.
    fn to_mean(&self, h: f64, middle: &Middle<K>, way: K::Speeds, z: K::Speeds) -> Middle<K> {
        middle.with_mean(self.kernel, (self.t, h), (&self.q, way), z)
    }

    fn mean(&self, how: Mean, h: f64, end: &End<K>, input: &K::Input) -> K::Speeds {
        how.of(self.kernel, (self.t, h), [(&self.q, &self.z), (&end.q, &end.z)], input)
    }

    pub(super) fn used(&self, h: f64, middle: &Middle<K>, made: &Attempt<K>) -> Used<K::Speeds> {
        Used {
            h,
            least: self.least(h),
            before: self.z,
            used: middle.z,
            acceleration: made.acceleration,
            after: made.end.z,
        }
    }

    /// Whether forces change so much with places that these are to be mean ones.
    pub(super) fn stiffens(&self, h: f64, (middle, made): (&Middle<K>, &Attempt<K>), input: &K::Input) -> bool {
        if self.scheme != StepScheme::Midpoint {
            return false;
        }
        let (used, of_places) = (self.used(h, middle, made), |q: &K::Configuration| self.of_places(middle.t, q, input));
        match self.last.may_stiffen(&used) {
            Some(may) => may && used.stiffens([&of_places(&middle.q), &of_places(&self.q)]),
            None => self.is_stiff(h, middle, &made.acceleration, input),
        }
    }

    /// The speed that forces change too fast along half of a step, where they are not taken at its mean place: those
    /// that come with speeds as well, as of arms that turn by a radian.
    pub(super) fn steep(&self, h: f64, (middle, made): (&Middle<K>, &Attempt<K>), input: &K::Input) -> Option<usize> {
        let used = self.used(h, middle, made);
        if middle.is_mean || !used.is_rough() || !made.end.z.is_finite() {
            return None;
        }
        let at_start = self.kernel.acceleration(middle.t, &self.q, &middle.z, input);
        if self.scheme == StepScheme::Midpoint {
            return used.steep(&at_start);
        }
        // Steps without a memory are whole on springs, or refused.
        let [half, start] = [&middle.q, &self.q].map(|q| self.of_places(middle.t, q, input));
        used.steep(&at_start.add_scaled(1.0, &half).add_scaled(-1.0, &start))
    }

    /// The speed on which forces act that an impact takes place on, and that change more with places than a step can
    /// follow: what comes to rest at a contact has the same speed by whatever force.
    pub(super) fn strikes_stiffly(
        &self,
        h: f64,
        (middle, made): (&Middle<K>, &Attempt<K>),
        input: &K::Input,
    ) -> Option<usize> {
        if !made.end.struck || self.scheme == StepScheme::MoreauJean {
            return None;
        }
        let of_places = |q: &K::Configuration| self.of_places(middle.t, q, input);
        self.used(h, middle, made).changes_beyond(FOLLOWED, [&of_places(&self.q), &of_places(&made.end.q)])
    }

    /// Whether a step is taken as it was foreseen: not made again, nor refused or made in parts for its forces.
    pub(super) fn is_taken(&self, h: f64, at: (&Middle<K>, &Attempt<K>), input: &K::Input) -> bool {
        !self.stiffens(h, at, input)
            && self.steep(h, at, input).is_none()
            && self.strikes_stiffly(h, at, input).is_none()
            && self.overshoots(h, at, input).is_none()
            && self.agrees(h, at, input)
    }

    /// Whether speeds do not grow by forces that were taken at other speeds, or at other places where these are to be
    /// mean ones.
    pub(super) fn agrees(&self, h: f64, (middle, made): (&Middle<K>, &Attempt<K>), input: &K::Input) -> bool {
        let (kernel, used) = (self.kernel, self.used(h, middle, made));
        if used.is_plain() && !self.last.is_stiff() || !made.end.z.is_finite() {
            return true;
        }
        let mean = motion::mean(&self.z, &made.end.z);
        let at_mean = kernel.acceleration(middle.t, &middle.q, &mean, input);
        if used.grows(&at_mean) {
            return false;
        }
        let at_mean_place = || kernel.acceleration(middle.t, &self.to_mean(h, middle, mean, mean).q, &mean, input);
        !middle.is_mean || used.is_within(ALLOWED, [&at_mean, &at_mean_place()])
    }

    /// A step made again with the mean speeds of the attempt before, until they agree; or one of which they do not,
    /// with what it would be refused for.
    fn corrected<W: Watch<K>>(
        &mut self,
        h: f64,
        (mut middle, mut made): (Middle<K>, Attempt<K>),
        input: &K::Input,
        (watch, last): (&mut W, bool),
    ) -> Result<Corrected<K>, ContactError> {
        let (mut part, mut before, mut speed, mut struck) = (1.0, None, 0, made.end.struck);
        for n in 0..CORRECTIONS {
            let how = if made.end.struck { Mean::Ends } else { Mean::Curved };
            let wanted = self.mean(how, h, &made.end, input);
            let (used, way) = (self.used(h, &middle, &made), motion::mean(&self.z, &made.end.z));
            let of_way = if middle.is_mean { used.off(&middle.way, &way) } else { K::Speeds::zero() };
            let off = [used.off(&middle.z, &wanted), of_way];
            let size;
            (size, speed) = largest(&off);
            // Forces change by what speeds do, times the part that is left of differences, or more where it is less by
            // the part that was taken of them.
            let left = before.map_or(1.0, |before| size / largest(&before).0);
            let settled = size <= NEARLY && size * left.min(1.0) <= SETTLED;
            if settled || !made.end.z.is_finite() {
                watch.settles();
                return Ok((middle, made, None));
            }
            // The second difference tells how much forces depend on speeds.
            let most = match before {
                Some(before) if last && opposes(&before, &off) => STIFFEST,
                _ if last => STIFF_AT_LAST,
                _ => STIFF,
            };
            if n == 1 && left > most {
                break;
            }
            part = before.filter(|_| n > 1).map_or(1.0, |before| relaxation(part, &before, &off));
            before = Some(off);
            let rule = Rule { mean: how, part, at_mean_place: middle.is_mean };
            watch.again(made.end.attempted(self.next.as_ref()), rule);
            let (way, z) = (motion::towards(&middle.way, &way, part), motion::towards(&middle.z, &wanted, part));
            middle = if middle.is_mean { self.to_mean(h, &middle, way, z) } else { Middle { z, ..middle } };
            made = self.attempt(h, &middle, input)?;
            struck |= made.end.struck;
        }
        // Whether a gap closes in this step or in the next may depend on the speeds: both are steps. From those of a
        // flight it closes where it did before, and the impact tells what it gains.
        if last && struck && !made.end.struck {
            (middle, made) = self.again(h, (&middle, &made), input, (watch, true))?;
        }
        let cause = self.too_stiff(h, speed);
        if last && made.end.struck { Ok((middle, made, Some(cause))) } else { Err(cause) }
    }
}
