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
//! So a step looks back (`agreement`). In flight forces at the mean speeds are to do what those did that were taken:
//! what does not depend on speeds pays nothing for that. Beside contacts, where a step
//! costs more, speeds may differ by a part of themselves, or by what would not change one by more than a part
//! [`ALLOWED`] of it: what is left is a growth by at most that part, of a body that turns of its power 4/3: 10⁻⁸. What
//! dampers differ by there shrinks by itself as long as it is smaller than the difference of the speeds. Else the step
//! is made again from the end that it had, until speeds agree; where it is too long for that, it is made in parts, and
//! refused in the end: so this check is the watch over the energy of a step, since forces at the mean speeds do the
//! work that they should. Forces that are not linear may agree with speeds to which no motion leads: how much they
//! change between those of the first attempt and the last tells. Where springs are stiff a step takes them at the mean
//! place as well (`stiffness`).
//!
//! A step that is made again uses `z̄ − h/12 (a⁺ − a⁻)` with the accelerations at both ends, which is the mean over
//! time to fourth order: where a body spins evenly, h ω errs by (ωh)⁵/720, in place of (ωh)³/12, by which a ball in the
//! air would leave its way. Energy is kept as well: of z' = iωz that is the Padé approximation of degrees (2, 2).

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;

use crate::error::{ContactError, ContactErrorKind};

use super::agreement::{ALLOWED, Attempts};
use super::motion::{self, Mean, Middle, Rule};
use super::outcome::{Attempt, Refused, has_no_end};
use super::report::{StepReport, StepScheme};
use super::stepper::ContactStepper;
use super::used::{PART, Used};
use super::watch::Watch;

/// The part of a speed that may be left of a difference in a step that has no other end: where it cannot be shorter and
/// contacts do one thing at some speeds and another one at those that follow from it, or where no impulses are found at
/// these. It comes once, and not from step to step.
const MILD: f64 = 1e-2;
/// The number of times a step is made again, at most.
const CORRECTIONS: usize = 48;
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

/// A step that was made again, and what it would be refused for.
type Corrected<K> = (Middle<K>, Attempt<K>, Option<ContactError>);

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
            let used = self.used(h, &middle, &made);
            let is_mild = !made.end.flies() && used.is_within(MILD, [&made.acceleration, &at_mean]);
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

    /// The error of a step that has no end in parts of some length: that of its forces, where these change speeds that
    /// lead to its places more than a part can follow.
    pub(super) fn named(&self, part: f64, error: ContactError, input: &K::Input) -> ContactError {
        if !has_no_end(&error) {
            return error;
        }
        let (kernel, half) = (self.kernel, 0.5 * part);
        let q = motion::half_way::<K>(part, &self.q, &kernel.kinematics(self.t, &self.q, &self.z));
        let change = |z: &K::Speeds| kernel.acceleration(self.t + half, &q, z, input).scale(half);
        let (zero, free) = (K::Speeds::zero(), change(&self.z));
        let by = change(&self.z.add_scaled(1.0, &free)).add_scaled(-1.0, &free);
        let [free, by] = [free, by].map(|z| self.difference([z, zero], None));
        if by.size() > STIFF_AT_LAST * free.size() { self.too_stiff(part, by.speed()) } else { error }
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
        let (kernel, used, flies) = (self.kernel, self.used(h, middle, made), made.end.flies());
        if used.is_plain(flies) && !self.last.is_stiff() || !made.end.z.is_finite() {
            return true;
        }
        let mean = motion::mean(&self.z, &made.end.z);
        let at_mean = kernel.acceleration(middle.t, &middle.q, &mean, input);
        if !self.holds_at_mean(&used, flies, &at_mean) {
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
        let (mut part, mut attempts, mut struck) = (1.0, Attempts::default(), made.end.struck);
        let mut before = None;
        let sizes = (!made.end.flies()).then(|| self.used(h, &middle, &made).sizes(PART));
        for n in 0..CORRECTIONS {
            let how = if made.end.struck { Mean::Ends } else { Mean::Curved };
            let free = || *before.get_or_insert_with(|| self.kernel.acceleration(self.t, &self.q, &self.z, input));
            let wanted = how.of(self.kernel, (self.t, h), (&self.z, free), (&made.end.q, &made.end.z), input);
            let (used, way) = (self.used(h, &middle, &made), motion::mean(&self.z, &made.end.z));
            let of_way = if middle.is_mean { way.add_scaled(-1.0, &middle.way) } else { K::Speeds::zero() };
            attempts.add(self.difference([wanted.add_scaled(-1.0, &middle.z), of_way], sizes.as_ref()), &used);
            let settled = !made.end.z.is_finite() || self.has_settled(&used, made.end.flies(), &attempts);
            // The second difference tells how much forces depend on speeds.
            let leaves = n == 1 && !settled && attempts.leaves(used.least) > most(attempts.opposes(), last);
            let looks = !middle.is_mean && (n == 1 || n > 1 && settled);
            if leaves || looks && self.is_too_steep(&used, (&attempts, sizes.as_ref()), last) {
                break;
            }
            if settled {
                watch.settles();
                return Ok((middle, made, None));
            }
            part = if n > 1 { attempts.relaxation(part, LEAST_PART) } else { 1.0 };
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
        let cause = self.too_stiff(h, attempts.speed());
        if last && made.end.struck { Ok((middle, made, Some(cause))) } else { Err(cause) }
    }

    /// Whether forces change by more than attempts may follow between the speeds of the first of them and others: of
    /// what is not linear attempts may settle where no motion leads.
    fn is_too_steep(
        &self,
        used: &Used<K::Speeds>,
        (attempts, sizes): (&Attempts<K::Speeds>, Option<&K::Speeds>),
        last: bool,
    ) -> bool {
        let Some((z, acceleration)) = attempts.first else { return false };
        let (zero, off) = (K::Speeds::zero(), used.used.add_scaled(-1.0, &z));
        if off.max_norm() <= used.least {
            return false;
        }
        let off = self.difference([off, zero], sizes);
        let by = used.acceleration.add_scaled(-1.0, &acceleration).scale(0.5 * used.h);
        let by = self.difference([by, zero], sizes);
        by.size() > most(off.is_opposed_by(&by), last) * off.size()
    }
}

/// The part of a difference that may be left in the next one, by whether that is against it.
fn most(opposes: bool, last: bool) -> f64 {
    match (opposes, last) {
        (true, true) => STIFFEST,
        (false, true) => STIFF_AT_LAST,
        (_, false) => STIFF,
    }
}
