//! Agreement of the speeds at which a step takes its forces with its mean ones, by measures that no unit changes.
//!
//! Speeds of a system have units of their own: beside 200 rad/s a metre per second is little and a micrometre per
//! second nothing, by numbers alone. So in flight each speed is judged by its own size, with what forces add to it in
//! the step: one that turns passes through zero where forces change it most. Differences of all speeds are told by the
//! kinetic energy that they would have, which is how they are compared from one attempt to the next.
//!
//! In flight, where an attempt costs little, forces at the mean speeds are to do what those did that were taken, to
//! [`ALONE`]; where they do not, speeds settle to [`TIGHT`]: nothing is lost or given then but by the order of the
//! method, for any length of run. A step flies where no contact acts, whether or not gaps were looked at: feet that lie
//! on zero, or above it by a rounding, and press nothing are to make one step, or a run is no smooth function of its
//! inputs. A speed that is zero but for rounding has no digits of its own: where it comes no nearer, it is judged by
//! what the energy of all that moves would make of it. Beside contacts a step is solved anew each time, and joints pass
//! through zero: there sizes have a part of the largest speed, in whatever unit, and what they may be off by is more.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use super::stepper::ContactStepper;
use super::used::{PART, SMALL, Used};

/// The part of a speed by which those at which forces were taken may differ from the mean ones in flight, after which
/// the forces of another attempt would differ by less.
const TIGHT: f64 = 1e-12;
/// The same of a step with contacts that is made again.
const SETTLED: f64 = 1e-9;
/// The part of a speed by which those at which forces were taken may differ from the mean ones then.
const NEARLY: f64 = 3e-8;
/// The part of a speed by which forces may change it for having been taken at another one that was foreseen, beside
/// contacts.
pub(super) const ALLOWED: f64 = 1e-6;
/// The same in flight, of a speed by itself. What turns by x in a step differs by x³/2 where speeds were foreseen, and
/// gains x⁴/4 of its energy then, 6 · 10⁻¹³; or by x⁵/16 after three attempts, and loses x⁶/32 then, 10⁻¹¹.
const ALONE: f64 = 1e-9;
/// The part of the speed with all the energy that is rounding.
const ROUNDING: f64 = 1e-13;
/// The same where attempts come no nearer.
const STALLED: f64 = 1e-10;
/// The number of attempts after which those come no nearer that may not.
const MANY: usize = 32;
/// The part of the larger of two differences that is left in the third where attempts come nearer.
const NEARER: f64 = 0.5;

/// The differences of speeds at half of a step to others: of those at which forces are taken, and of those that lead to
/// the place where they are.
pub(super) type Off<V> = [V; 2];

fn is_zero<V: VectorSpace<f64>>(z: &V) -> bool {
    (0..V::DIM).all(|i| z.component(i) == 0.0)
}

/// Differences, with their momenta.
#[derive(Clone, Copy)]
pub(super) struct Difference<V> {
    off: Off<V>,
    momenta: Off<V>,
}

impl<V: VectorSpace<f64>> Difference<V> {
    /// From differences and how momenta follow from them.
    pub(super) fn new(off: Off<V>, momentum: impl Fn(&V) -> V) -> Self {
        let momentum = |z: &V| if is_zero(z) { V::zero() } else { momentum(z) };
        Self { off, momenta: [momentum(&off[0]), momentum(&off[1])] }
    }

    fn product(&self, other: &Self) -> f64 {
        let each = self.off.iter().zip(&other.momenta);
        each.flat_map(|(off, p)| (0..V::DIM).map(|i| off.component(i) * p.component(i))).sum()
    }

    /// Its size: the root of twice its kinetic energy.
    pub(super) fn size(&self) -> f64 {
        Real::sqrt(self.product(self).max(0.0))
    }

    /// The speed with most of its energy.
    pub(super) fn speed(&self) -> usize {
        let energy = |i: usize| {
            self.off.iter().zip(&self.momenta).map(|(off, p)| (off.component(i) * p.component(i)).abs()).sum::<f64>()
        };
        (0..V::DIM).fold(0, |most, i| if energy(i) > energy(most) { i } else { most })
    }

    /// Whether a later one is against it, as of a speed that is damped; where a body turns they are across.
    pub(super) fn is_opposed_by(&self, later: &Self) -> bool {
        self.product(later) < -0.7 * self.size() * later.size()
    }

    /// Part of a difference by which speeds are changed next, from the part before and the differences before and after
    /// it (A. C. Aitken; B. Irons & R. Tuck 1969): of one linear force that is all that is left, whatever its sign.
    pub(super) fn relaxation(&self, part: f64, later: &Self, least: f64) -> f64 {
        let less = |a: &Off<V>, b: &Off<V>| core::array::from_fn(|k| a[k].add_scaled(-1.0, &b[k]));
        let change = Self { off: less(&later.off, &self.off), momenta: less(&later.momenta, &self.momenta) };
        let next = -part * self.product(&change) / change.product(&change);
        if next.is_finite() { next.clamp(least, 1.0) } else { 1.0 }
    }

    fn at(&self, i: usize) -> f64 {
        self.off[0].component(i).abs().max(self.off[1].component(i).abs())
    }
}

/// The attempts at a step so far.
pub(super) struct Attempts<V> {
    count: usize,
    /// Speeds at which the first one took its forces, with their acceleration.
    pub(super) first: Option<(V, V)>,
    /// Differences of the last ones, the latest first.
    off: [Option<Difference<V>>; 3],
    /// Part of a difference that is left in the next one.
    left: f64,
}

impl<V> Default for Attempts<V> {
    fn default() -> Self {
        Self { count: 0, first: None, off: [None, None, None], left: 1.0 }
    }
}

impl<V: VectorSpace<f64>> Attempts<V> {
    /// Adds an attempt.
    pub(super) fn add(&mut self, off: Difference<V>, used: &Used<V>) {
        let [before, one, _] = self.off;
        self.first = self.first.or(Some((used.used, used.acceleration)));
        self.left = before.map_or(1.0, |before| off.size() / before.size());
        self.off = [Some(off), before, one];
        self.count += 1;
    }

    /// The speed with most of the energy of the last difference.
    pub(super) fn speed(&self) -> usize {
        self.off[0].map_or(0, |off| off.speed())
    }

    /// Part of a difference that is left in the next one, where that is more than rounding of places.
    pub(super) fn leaves(&self, least: f64) -> f64 {
        let is_more = |off: &Difference<V>| (0..V::DIM).any(|i| off.at(i) > least);
        if self.off[0].as_ref().is_some_and(is_more) { self.left } else { 0.0 }
    }

    /// Whether the last difference is against the one before.
    pub(super) fn opposes(&self) -> bool {
        matches!(&self.off, [Some(off), Some(before), _] if before.is_opposed_by(off))
    }

    /// Part of the last difference by which speeds are changed next, from the part before.
    pub(super) fn relaxation(&self, part: f64, least: f64) -> f64 {
        let [Some(off), Some(before), _] = &self.off else { return 1.0 };
        before.relaxation(part, off, least)
    }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// Differences of speeds, with their momenta at the start of the step; or with what takes their place beside
    /// contacts, by the sizes of speeds there.
    pub(super) fn difference(&self, off: Off<K::Speeds>, sizes: Option<&K::Speeds>) -> Difference<K::Speeds> {
        if let Some(sizes) = sizes {
            return Difference::new(off, |z| {
                let mut scaled = *z;
                (0..K::Speeds::DIM).for_each(|i| scaled.set_component(i, z.component(i) / sizes.component(i).powi(2)));
                scaled
            });
        }
        let momentum = |z: &K::Speeds| self.kernel.momentum(self.t, &self.q, z);
        let still = momentum(&K::Speeds::zero());
        Difference::new(off, |z| momentum(z).add_scaled(-1.0, &still))
    }

    /// Whether forces at the mean speeds, whose acceleration is given, do what those that were taken do: in flight each
    /// speed by a part of its own; beside contacts speeds may not grow by more than a part of them. Where what they
    /// differ by is against the difference of the speeds, as of dampers, these do not, unless it is as large.
    pub(super) fn holds_at_mean(&self, used: &Used<K::Speeds>, flies: bool, at_mean: &K::Speeds) -> bool {
        let allowed = match flies {
            true => used.own_sizes().scale(ALONE),
            false => used.sizes(SMALL).scale(ALLOWED),
        };
        let by = |i: usize| used.h * (used.acceleration.component(i) - at_mean.component(i));
        let differs = |i: &usize| {
            let (by, off) = (by(*i), used.used.component(*i) - used.mean(*i));
            by.abs() > allowed.component(*i) && (flies || by * off >= 0.0 || by.abs() > 0.5 * off.abs())
        };
        let mut open = (0..K::Speeds::DIM).filter(differs).peekable();
        open.peek().is_none()
            || flies && {
                let least = self.least_sizes(used, ROUNDING);
                open.all(|i| by(i).abs() <= least(i))
            }
    }

    /// Whether speeds have settled.
    pub(super) fn has_settled(&self, used: &Used<K::Speeds>, flies: bool, attempts: &Attempts<K::Speeds>) -> bool {
        let ([Some(off), one, other], left) = (&attempts.off, attempts.left) else { return false };
        // Forces change by what speeds do, times the part that is left of differences, or more where it is less by the
        // part that was taken of them.
        let [nearly, allowed] = match flies {
            true => [used.own_sizes().scale(NEARLY), used.own_sizes().scale(TIGHT)],
            false => [NEARLY, SETTLED].map(|part| used.sizes(PART).scale(part)),
        };
        let differs = |i: &usize| {
            let off = off.at(*i);
            !(off <= nearly.component(*i) && off * left.min(1.0) <= allowed.component(*i))
        };
        let mut open = (0..K::Speeds::DIM).filter(differs).peekable();
        if open.peek().is_none() {
            return true;
        }
        let (true, Some(one), Some(other)) = (flies, one, other) else { return false };
        let least = self.least_sizes(used, STALLED);
        let stalls = |i: usize| attempts.count > MANY || off.at(i) >= NEARER * one.at(i).max(other.at(i));
        open.all(|i| stalls(i) && off.at(i) <= least(i) + used.least)
    }

    /// Sizes that each speed alone would have with a part of the energy of all that moves in a step.
    fn least_sizes(&self, used: &Used<K::Speeds>, part: f64) -> impl Fn(usize) -> f64 {
        let (kernel, t, q) = (self.kernel, self.t, &self.q);
        let all = [used.before, used.after, used.acceleration.scale(used.h)];
        let energy: f64 = all.iter().map(|z| kernel.kinetic_energy(t, q, z)).sum();
        let inertia = kernel.mass_matrix(t, q);
        move |i| part * Real::sqrt(2.0 * energy / inertia[(i, i)])
    }
}
