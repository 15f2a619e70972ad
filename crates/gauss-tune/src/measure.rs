//! Which method is cheapest for a scene: measured on the scene itself.
//!
//! A reference comes first: the pair of order 8 in both forms, at tolerances that are tightened until the two agree to
//! a tenth of the error that is wanted. Then every [`Method`] is run in both forms, and its step or tolerance varied
//! until the measured error is just below the one wanted. What meets it in the shortest time wins; without a clock,
//! what takes the fewest operations of the kernel.
//!
//! Errors are those of the whole run, not of a step, at sixteen times spread evenly over the interval.

use core::cell::Cell;
use core::ops::{ControlFlow, Range};

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::description::DescribedSystem;
use gauss_runtime::integrate::{
    Control, Form, InputSource, IntegrationError, IntegrationErrorKind, Rates, Simulation, State, SystemProblem,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::method::{EitherForm, Family, Method};
use crate::tuned::{Candidate, Measured, TuneError, Tuned};

/// An increment of the configuration of S.
type TangentOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

fn candidate<S: GaussSystem + DescribedSystem>(
    measured: Measured<Method<S::Scalar>>,
    form: EitherForm,
) -> Candidate<S::Scalar> {
    let Measured { control: method, error, evaluations, steps, seconds } = measured;
    Candidate { method, form, error, evaluations, steps, seconds, operations: evaluations * operations::<S>(form) }
}

/// Counts the calls of the source: one for each evaluation.
struct Counted<'a, I> {
    source: &'a I,
    count: &'a Cell<u64>,
}

impl<S: GaussSystem, I: InputSource<S>> InputSource<S> for Counted<'_, I> {
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.count.set(self.count.get() + 1);
        self.source.input(t, q, z)
    }
}

/// Times at which errors are measured, the end included.
const CHECKPOINTS: usize = 16;

/// Runs of more steps are given up: a method that needs so many is not the cheapest, or the interval is longer than it
/// need be to tell.
const MOST_STEPS: u64 = 100_000;

/// Trials of one method in one form.
const TRIALS: usize = 8;

/// What is run, how often, and against what.
struct Bench<'a, S: GaussSystem, I> {
    system: &'a S,
    input: &'a I,
    q: S::Configuration,
    z: S::Speeds,
    interval: Range<S::Scalar>,
    limit: u64,
    relative: f64,
    absolute: f64,
}

/// A run looked at.
struct Seen<S: GaussSystem> {
    /// Configuration and quasi-velocities at the checkpoints.
    states: Vec<(S::Configuration, S::Speeds)>,
    evaluations: u64,
    steps: u64,
}

impl<'a, S: GaussSystem, I: InputSource<S>> Bench<'a, S, I> {
    /// The scene of a simulation, from this state and over this interval.
    fn of<F, C, O, E>(
        scene: &'a Simulation<SystemProblem<'_, S, F, I>, C, O, E>,
        (q, z): (S::Configuration, S::Speeds),
        interval: Range<S::Scalar>,
        relative: f64,
        absolute: f64,
    ) -> Result<Self, TuneError> {
        let usable = |tolerance: f64| tolerance.is_finite() && tolerance >= 0.0;
        if !(usable(relative) && usable(absolute) && relative + absolute > 0.0) {
            return Err(TuneError::InvalidTolerance);
        }
        let SystemProblem { system, input, .. } = scene.problem();
        Ok(Self {
            system,
            input,
            q,
            z,
            interval,
            limit: scene.limit().map_or(MOST_STEPS, |limit| limit.min(MOST_STEPS)),
            relative,
            absolute,
        })
    }

    fn start<F: Form<S>>(&self, form: F) -> State<S> {
        let (t, q) = (self.interval.start, self.q.renormalise());
        State { t, q, y: form.variables(self.system, t, &q, &self.z) }
    }

    fn span(&self) -> f64 {
        (self.interval.end - self.interval.start).lane(0)
    }

    /// A step of about the given length of which a whole number fills the interval.
    fn whole(&self, step: f64) -> S::Scalar {
        let span = self.span().abs();
        S::Scalar::from_f64(span / Real::max((span / step) as u64 as f64, 1.0))
    }

    /// Where steps of one length are looked for from.
    fn mean_step(&self, reference: &Seen<S>) -> f64 {
        self.span().abs() / reference.steps.max(1) as f64
    }

    fn run<C: Control<S>, F: Form<S>>(&self, method: &C, form: F) -> Result<Seen<S>, IntegrationError> {
        let count = Cell::new(0);
        let problem = SystemProblem { system: self.system, form, input: Counted { source: self.input, count: &count } };
        let mut seen = Seen { states: Vec::with_capacity(CHECKPOINTS), evaluations: 0, steps: 0 };
        let time = |n: usize| {
            let part = S::Scalar::ratio(n as i64, CHECKPOINTS as i64);
            part.fma(self.interval.end - self.interval.start, self.interval.start)
        };
        let direction = self.span().signum();
        let mut before: Option<(State<S>, Rates<S>)> = None;
        let mut failure = None;
        let outcome =
            method.drive(&problem, self.start(form), self.interval.end, self.limit, &mut |state, rates, _| {
                if let Some((from, slopes)) = &before {
                    seen.steps += 1;
                    while seen.states.len() + 1 < CHECKPOINTS {
                        let next = time(seen.states.len() + 1);
                        if direction * (state.t - next).lane(0) < 0.0 {
                            break;
                        }
                        // Looking is not counted.
                        let evaluations = count.get();
                        match method.within(&problem, from, slopes, next - from.t) {
                            Ok(at) => seen.states.push((at.q, form.speeds(self.system, at.t, &at.q, &at.y))),
                            Err(kind) => {
                                failure = Some(IntegrationError::at(&problem, from, kind));
                                return ControlFlow::Break(());
                            }
                        }
                        count.set(evaluations);
                    }
                }
                before = Some((*state, *rates));
                ControlFlow::Continue(())
            });
        if let Some(error) = failure {
            return Err(error);
        }
        let end = outcome?;
        seen.states.push((end.q, form.speeds(self.system, end.t, &end.q, &end.y)));
        seen.evaluations = count.get();
        Ok(seen)
    }

    /// The largest difference of two runs, each component against `absolute + relative·size`, where the size is the
    /// largest that the component of the reference has at any checkpoint.
    fn distance(&self, found: &Seen<S>, reference: &Seen<S>) -> f64 {
        let mut worst = 0.0_f64;
        let mut see = |difference: f64, size: f64| {
            let tolerance = self.absolute + self.relative * size;
            if difference != 0.0 {
                worst = worst.max(difference.abs() / tolerance.max(f64::MIN_POSITIVE));
            }
        };
        for i in 0..TangentOf::<S>::DIM {
            let size = reference.states.iter().map(|(q, _)| q.magnitude(i)).fold(0.0, f64::max);
            for ((q, _), (exact, _)) in found.states.iter().zip(&reference.states) {
                let difference = exact.difference(q).component(i);
                (0..S::Scalar::LANES).for_each(|lane| see(difference.lane(lane), size));
            }
        }
        for i in 0..S::Speeds::DIM {
            for lane in 0..S::Scalar::LANES {
                let size = reference.states.iter().map(|(_, z)| z.component(i).lane(lane).abs()).fold(0.0, f64::max);
                for ((_, z), (_, exact)) in found.states.iter().zip(&reference.states) {
                    see((z.component(i) - exact.component(i)).lane(lane), size);
                }
            }
        }
        worst
    }

    fn reference(&self) -> Result<(Seen<S>, f64), TuneError> {
        let (mut closest, mut stopped) = (f64::INFINITY, None);
        for tightness in [1e-2, 1e-3, 1e-4, 1e-5] {
            let at = |factor: f64| Method::DormandPrince8 {
                relative: self.relative * factor,
                absolute: self.absolute * factor,
            };
            let pair = self
                .run(&at(tightness), EitherForm::Velocity)
                .and_then(|first| Ok((first, self.run(&at(0.1 * tightness), EitherForm::Momentum)?)));
            match pair {
                Ok((first, second)) => {
                    let apart = self.distance(&first, &second);
                    closest = closest.min(apart);
                    if apart <= 0.1 {
                        return Ok((second, apart));
                    }
                }
                Err(error) => {
                    let hopeless = matches!(error.kind, IntegrationErrorKind::TooManySteps { .. });
                    stopped = Some(error);
                    // Tighter tolerances would take more of them.
                    if hopeless {
                        break;
                    }
                }
            }
        }
        Err(TuneError::NoReference { disagreement: closest, stopped })
    }

    /// The coarsest setting of a method that meets the error, or the last one tried. `make` gives the method of a
    /// setting whose error goes like its power `order`. Gives up at more than ten times `budget` evaluations.
    fn search<C: Control<S>, F: Form<S>>(
        &self,
        reference: &Seen<S>,
        form: F,
        (make, order): (&dyn Fn(f64) -> C, f64),
        mut setting: f64,
        budget: f64,
    ) -> Option<Measured<C>> {
        let mut best: Option<(f64, Measured<C>)> = None;
        let mut last = None;
        for _ in 0..TRIALS {
            let control = make(setting);
            let next = match self.run(&control, form) {
                Ok(seen) => {
                    let error = self.distance(&seen, reference);
                    let Seen { evaluations, steps, .. } = seen;
                    let measured = Measured { control, error, evaluations, steps, seconds: None };
                    if error <= 1.0 && best.as_ref().is_none_or(|(coarsest, _)| setting > *coarsest) {
                        best = Some((setting, measured));
                    } else {
                        last = Some(measured);
                    }
                    if (0.2..=1.0).contains(&error) {
                        break;
                    }
                    let factor = Real::exp(Real::ln(0.5 / error.clamp(1e-12, 1e12)) * (1.0 / order)).clamp(0.01, 100.0);
                    // Not again beyond what has failed, nor below what has met the error.
                    if best.as_ref().is_some_and(|(coarsest, _)| setting * factor <= *coarsest && error > 1.0) {
                        break;
                    }
                    if evaluations as f64 / factor > 10.0 * budget {
                        break;
                    }
                    setting * factor
                }
                Err(_) => {
                    if best.is_some() {
                        break;
                    }
                    0.25 * setting
                }
            };
            if next == setting {
                break;
            }
            setting = next;
        }
        let mut found = best.map(|(_, measured)| measured).or(last)?;
        if found.error <= 1.0 {
            found.seconds = self.time(&found.control, form);
        }
        Some(found)
    }

    /// The shortest of a few runs, in seconds.
    #[cfg(not(target_family = "wasm"))]
    fn time<C: Control<S>, F: Form<S>>(&self, method: &C, form: F) -> Option<f64> {
        struct Uncounted<'a, I>(&'a I);
        impl<S: GaussSystem, I: InputSource<S>> InputSource<S> for Uncounted<'_, I> {
            fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
                self.0.input(t, q, z)
            }
        }
        let problem = SystemProblem { system: self.system, form, input: Uncounted(self.input) };
        let nobody = &mut |_: &State<S>, _: &Rates<S>, _| ControlFlow::Continue(());
        let (mut shortest, mut total) = (f64::INFINITY, 0.0);
        for _ in 0..5 {
            let clock = std::time::Instant::now();
            method.drive(&problem, self.start(form), self.interval.end, self.limit, nobody).ok()?;
            let seconds = clock.elapsed().as_secs_f64();
            (shortest, total) = (seconds.min(shortest), total + seconds);
            if total > 0.2 {
                break;
            }
        }
        Some(shortest)
    }

    #[cfg(target_family = "wasm")]
    fn time<C: Control<S>, F: Form<S>>(&self, _: &C, _: F) -> Option<f64> {
        None
    }
}

/// Operations of the kernel in an evaluation.
fn operations<S: DescribedSystem>(form: EitherForm) -> u64 {
    let counts = S::OPERATIONS;
    let dynamics = match form {
        EitherForm::Velocity => counts.acceleration.total(),
        EitherForm::Momentum => counts.velocity.total() + counts.momentum_rate.total(),
    };
    u64::from(counts.kinematics.total() + dynamics).max(1)
}

/// Measures methods on the scene of a [`Simulation`].
pub trait Tune<S: GaussSystem>: Sized + crate::sealed::Sealed {
    /// A simulation by a candidate.
    type Chosen;

    /// Measures methods on this scene, with its input, from this state and over this interval. The result is the
    /// cheapest one that keeps the error of the whole run within `absolute + relative·size`, component by component,
    /// where sizes are the largest over the run: 1 for a rotation, |b| for a translation, |q| and |z| for a plain
    /// coordinate and a quasi-velocity.
    ///
    /// Every [`Method`] is tried: Dormand and Prince's pairs, Verner's, Gauss' collocation alone and composed,
    /// Runge–Kutta 4 and the commutator-free method. Methods that not every scene admits – splitting, exact free
    /// motion, variational – have to be known to fit when the program is compiled, which a function for any scene
    /// cannot: [`tune_steps`](Self::tune_steps) measures one of them in the same way.
    ///
    /// Runs the scene some eighty times, and gives up runs of more than 100,000 steps: shorten the interval where that
    /// is too long, but keep what is typical of the motion in it. Form, control, observers and events that were set are
    /// not looked at. Settings near the best ones are as good, and times vary: what is chosen may differ from call to
    /// call, its error does not.
    ///
    /// ```
    /// use gauss_runtime::prelude::*;
    /// use gauss_tune::Tune;
    ///
    /// /// A heavy top that turns about O.
    /// #[derive(GaussDynamics)]
    /// #[gauss(motion = fixed_point)]
    /// struct Top {
    ///     #[gauss(mass)]           mass: f64,
    ///     #[gauss(center_of_mass)] center: Vector3<f64>,
    ///     #[gauss(inertia)]        inertia: Vector3<f64>,
    ///     #[gauss(gravity)]        g: f64,
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
    /// let kernel = top.kernel()?;
    /// let (tilted, spinning) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.0, 0.0, 40.0));
    /// let scene = Simulation::new(&kernel);
    /// let tuned = scene.tune(tilted, spinning, 0.0..0.5, 1e-8, 1e-8)?;
    /// println!("{tuned}");
    /// let end = scene.tuned(&tuned.best).run_to_end(tilted, spinning, 0.0..10.0)?;
    /// # assert!(tuned.best.error <= 1.0 && end.t == 10.0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`TuneError`] when errors cannot be measured, or no method meets the one that is wanted.
    fn tune(
        &self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
        relative: f64,
        absolute: f64,
    ) -> Result<Tuned<S::Scalar>, TuneError>
    where
        S: DescribedSystem;

    /// Measures a method of your own that has a step, in the form that was set and against the same reference as
    /// [`tune`](Self::tune): the longest step that meets the relative and absolute tolerance, and its cost. `make`
    /// gives the method for a length of step, `order` is the order of its error.
    ///
    /// For methods that not every scene admits, and that [`tune`](Self::tune), which is for any scene, cannot try:
    ///
    /// ```
    /// use gauss_exact::{Scheme, Splitting};
    /// use gauss_runtime::integrate::Fixed;
    /// use gauss_runtime::prelude::*;
    /// use gauss_tune::Tune;
    ///
    /// /// A heavy top that turns about O.
    /// #[derive(GaussDynamics)]
    /// #[gauss(motion = fixed_point)]
    /// struct Top {
    ///     #[gauss(mass)]           mass: f64,
    ///     #[gauss(center_of_mass)] center: Vector3<f64>,
    ///     #[gauss(inertia)]        inertia: Vector3<f64>,
    ///     #[gauss(gravity)]        g: f64,
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
    /// let kernel = top.kernel()?;
    /// let (tilted, spinning) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.0, 0.0, 40.0));
    /// let scene = Simulation::new(&kernel).momentum_form();
    /// let splitting = Splitting::exact(&kernel, Scheme::BLANES_MOAN_4)?;
    /// let found = scene.tune_steps(tilted, spinning, 0.0..0.5, (1e-8, 1e-8), 4, |step| Fixed::by(splitting, step))?;
    /// println!("{} steps, {:?} s", found.steps, found.seconds);
    /// let end = scene.control(found.control).run_to_end(tilted, spinning, 0.0..10.0)?;
    /// # assert!(found.error <= 1.0 && end.t == 10.0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`TuneError`] when errors cannot be measured, or no step meets the one that is wanted.
    fn tune_steps<D: Control<S>>(
        &self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
        tolerances: (f64, f64),
        order: u32,
        make: impl Fn(S::Scalar) -> D,
    ) -> Result<Measured<D>, TuneError>;

    /// Runs by a candidate of [`tune`](Self::tune).
    fn tuned(self, candidate: &Candidate<S::Scalar>) -> Self::Chosen;
}

impl<'k, S, F, I, C, O, E> Tune<S> for Simulation<SystemProblem<'k, S, F, I>, C, O, E>
where
    S: GaussSystem,
    F: Form<S>,
    I: InputSource<S>,
{
    type Chosen = Simulation<SystemProblem<'k, S, EitherForm, I>, Method<S::Scalar>, O, E>;

    fn tune(
        &self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
        relative: f64,
        absolute: f64,
    ) -> Result<Tuned<S::Scalar>, TuneError>
    where
        S: DescribedSystem,
    {
        let bench = Bench::of(self, (q0, z0), interval, relative, absolute)?;
        let (reference, disagreement) = bench.reference()?;

        let mut candidates = Vec::new();
        let mut fewest = reference.evaluations as f64;
        for family in &Method::FAMILIES {
            let make = |setting: f64| match family {
                Family::Steps { of, .. } => of(bench.whole(setting)),
                Family::Tolerances { of } => of(relative * setting, absolute * setting),
            };
            let (order, setting) = match family {
                Family::Steps { order, .. } => (f64::from(*order), bench.mean_step(&reference)),
                Family::Tolerances { .. } => (1.0, 1.0),
            };
            for form in [EitherForm::Velocity, EitherForm::Momentum] {
                let Some(found) = bench.search(&reference, form, (&make, order), setting, fewest) else { continue };
                if found.error <= 1.0 {
                    fewest = Real::min(fewest, found.evaluations as f64);
                }
                candidates.push(candidate::<S>(found, form));
            }
        }
        candidates.sort_by(|a, b| (a.error > 1.0).cmp(&(b.error > 1.0)).then(a.cost().total_cmp(&b.cost())));
        match candidates.first() {
            Some(&best) if best.error <= 1.0 => Ok(Tuned { best, candidates, disagreement }),
            _ => Err(TuneError::NoCandidate),
        }
    }

    fn tune_steps<D: Control<S>>(
        &self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
        (relative, absolute): (f64, f64),
        order: u32,
        make: impl Fn(S::Scalar) -> D,
    ) -> Result<Measured<D>, TuneError> {
        let bench = Bench::of(self, (q0, z0), interval, relative, absolute)?;
        let (reference, _) = bench.reference()?;
        let make = |setting: f64| make(bench.whole(setting));
        // As many evaluations as the reference took at tolerances that are tighter by a hundred and more, and ten times
        // as many.
        let budget = 10.0 * reference.evaluations as f64;
        let setting = bench.mean_step(&reference);
        match bench.search(&reference, self.problem().form, (&make, f64::from(order)), setting, budget) {
            Some(found) if found.error <= 1.0 => Ok(found),
            _ => Err(TuneError::NoCandidate),
        }
    }

    fn tuned(self, candidate: &Candidate<S::Scalar>) -> Self::Chosen {
        self.form(candidate.form).control(candidate.method)
    }
}
