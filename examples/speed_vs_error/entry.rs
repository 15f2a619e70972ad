//! What is measured: one method on one set of equations, to be run with any step or tolerance.

use std::cell::Cell;
use std::error::Error;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::rc::Rc;

use gauss_runtime::integrate::{Control, Form, InputSource, NoInput, Problem, Rates, State};
use gauss_runtime::prelude::*;

use crate::scene::Target;

/// Whose method it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// A method of Gauss on a derived kernel.
    Gauss,
    /// A method of another library, or one typed as it is often found, on equations written by hand.
    Baseline,
}

/// What one setting means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// The length of the steps, s, of a method of this order.
    Step(u32),
    /// The relative and absolute tolerance.
    Tolerance,
    /// Nothing: the motion is exact, and one call goes to the end.
    Once,
}

/// What a run is asked for.
pub enum Ask<'a> {
    /// Nothing: it is timed.
    Time,
    /// The error at the end.
    Error(&'a mut f64),
    /// Time and energy after every step.
    Energy(&'a mut dyn FnMut(f64, f64)),
}

type Run = dyn Fn(f64, f64, Ask<'_>) -> Result<u64, Box<dyn Error>>;

/// A method on one set of equations.
pub struct Entry {
    /// Its name.
    pub method: &'static str,
    /// The chart or the coordinates.
    pub chart: &'static str,
    /// `velocity` or `momentum`.
    pub form: &'static str,
    /// Whose it is.
    pub side: Side,
    /// What a setting means.
    pub setting: Setting,
    /// Evaluations for each one that is counted.
    weight: u64,
    run: Box<Run>,
}

impl Entry {
    /// A method whose runs are a function of the setting, the duration in s, and what is asked.
    pub fn new(
        (method, chart, form): (&'static str, &'static str, &'static str),
        side: Side,
        setting: Setting,
        run: impl Fn(f64, f64, Ask<'_>) -> Result<u64, Box<dyn Error>> + 'static,
    ) -> Self {
        Self { method, chart, form, side, setting, weight: 1, run: Box::new(run) }
    }

    /// Runs it; the number of evaluations of the equations.
    ///
    /// # Errors
    /// When it does not reach the end.
    pub fn run(&self, setting: f64, duration: f64, ask: Ask<'_>) -> Result<u64, Box<dyn Error>> {
        Ok(self.weight * (self.run)(setting, duration, ask)?)
    }

    /// For a method that looks at the equations in its own ways: so many evaluations for each one that is counted.
    #[must_use]
    pub fn with_evaluations(self, weight: u64) -> Self {
        Self { weight, ..self }
    }

    /// The error at the end, and the number of evaluations.
    ///
    /// # Errors
    /// When the end is not reached.
    pub fn error(&self, setting: f64, duration: f64) -> Result<(f64, u64), Box<dyn Error>> {
        let mut error = f64::INFINITY;
        let evaluations = self.run(setting, duration, Ask::Error(&mut error))?;
        Ok((error, evaluations))
    }
}

/// A kernel without inputs, over numbers of double precision.
pub trait Kernel: GaussSystem<Scalar = f64, Input = ()> + Copy + 'static {}

impl<S: GaussSystem<Scalar = f64, Input = ()> + Copy + 'static> Kernel for S {}

/// A kernel with its start, and what is seen of its configurations.
pub struct Setup<S: GaussSystem> {
    /// The chart or the coordinates, as they are called in the report.
    pub chart: &'static str,
    /// The kernel.
    pub kernel: S,
    /// q and z at the time 0.
    pub start: (S::Configuration, S::Speeds),
    /// What the target knows.
    pub observe: Rc<dyn Fn(&S::Configuration) -> Vec<Vec<f64>>>,
    /// Where the motion ends.
    pub target: Rc<Target>,
}

/// The most steps of a run: a safeguard, nothing comes near it.
const MOST_STEPS: u64 = 50_000_000;

impl<S: Kernel> Setup<S> {
    /// A method in one form; `control` makes it from a setting.
    pub fn entry<F: Form<S> + 'static, C: Control<S>>(
        &self,
        (method, setting): (&'static str, Setting),
        (name, form): (&'static str, F),
        control: impl Fn(f64) -> C + 'static,
    ) -> Entry {
        let Setup { chart, kernel, start: (q, z), .. } = *self;
        let (observe, target) = (Rc::clone(&self.observe), Rc::clone(&self.target));
        Entry::new((method, chart, name), Side::Gauss, setting, move |value, duration, ask| {
            let count = Cell::new(0);
            let kernel = black_box(&kernel);
            let problem = Problem { system: kernel, form: Counted { form, count: &count }, input: NoInput };
            let start = State { t: 0.0, q, y: form.variables(kernel, 0.0, &q, &z) };
            let control = control(value);
            match ask {
                Ask::Time => {
                    let emit = &mut |_: &State<S>, _: &Rates<S>| ControlFlow::Continue(());
                    black_box(control.drive(&problem, black_box(start), duration, MOST_STEPS, emit)?);
                }
                Ask::Error(error) => {
                    let emit = &mut |_: &State<S>, _: &Rates<S>| ControlFlow::Continue(());
                    let end = control.drive(&problem, start, duration, MOST_STEPS, emit)?;
                    *error = target.error(&observe(&end.q));
                }
                Ask::Energy(see) => {
                    let emit = &mut |state: &State<S>, _: &Rates<S>| {
                        let z = form.speeds(kernel, state.t, &state.q, &state.y);
                        see(state.t, kernel.energy(state.t, &state.q, &z));
                        ControlFlow::Continue(())
                    };
                    control.drive(&problem, start, duration, MOST_STEPS, emit)?;
                }
            }
            Ok(count.get())
        })
    }
}

/// A form that counts the evaluations of the right-hand side. Runs that are timed count too, as those of the baselines do.
#[derive(Clone, Copy)]
struct Counted<'c, F> {
    form: F,
    count: &'c Cell<u64>,
}

impl<S: GaussSystem, F: Form<S>> Form<S> for Counted<'_, F> {
    #[inline(always)]
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.form.variables(system, t, q, z)
    }

    #[inline(always)]
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.form.speeds(system, t, q, y)
    }

    #[inline(always)]
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.form.momentum(system, t, q, y)
    }

    #[inline(always)]
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        self.form.of_momentum(system, t, q, p)
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        self.count.set(self.count.get() + 1);
        self.form.rates(system, input, state)
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        self.form.both_rates(system, input, state, known)
    }
}
