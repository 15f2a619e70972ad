//! What is measured: one method on one set of equations, to be run with any step or tolerance.

use std::error::Error;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::rc::Rc;

use gauss_runtime::integrate::{Control, Form, NoInput, Problem, Rates, State, SystemProblem};
use gauss_runtime::prelude::*;

use super::counted::Counted;
use super::scene::Target;

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
    /// The same, where how fast the body turns costs nothing: longer steps are tried, too.
    LongStep(u32),
    /// The relative and absolute tolerance.
    Tolerance,
    /// Nothing: the motion is exact, and one call goes to the end.
    Once,
}

/// Sees time and energy.
pub type See<'a> = dyn FnMut(f64, f64) + 'a;

/// What a run is asked for.
pub enum Ask<'a> {
    /// Nothing: it is timed.
    Time,
    /// The error at the end.
    Error(&'a mut f64),
    /// Time and energy after every step.
    Energy(&'a mut See<'a>),
}

/// Of a run: the number of evaluations.
pub type Outcome = Result<u64, Box<dyn Error>>;

/// A function of the setting, of the duration in s, and of what is asked.
type Run = dyn Fn(f64, f64, Ask<'_>) -> Outcome;

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
    run: Box<Run>,
}

impl Entry {
    /// A method given by what runs it.
    pub fn new(
        (method, chart, form): (&'static str, &'static str, &'static str),
        side: Side,
        setting: Setting,
        run: impl Fn(f64, f64, Ask<'_>) -> Outcome + 'static,
    ) -> Self {
        Self { method, chart, form, side, setting, run: Box::new(run) }
    }

    /// Runs it.
    ///
    /// # Errors
    /// When it does not reach the end.
    pub fn run(&self, setting: f64, duration: f64, ask: Ask<'_>) -> Outcome {
        (self.run)(setting, duration, ask)
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

/// What is seen of a configuration, in the groups that the target knows.
pub type Observe<Q> = Rc<dyn Fn(&Q) -> Vec<Vec<f64>>>;

/// A kernel with its start, and what is seen of its configurations.
pub struct Setup<S: GaussSystem> {
    /// The chart or the coordinates, as they are called in the report.
    pub chart: &'static str,
    /// The kernel.
    pub kernel: S,
    /// q and z at the time 0.
    pub start: (S::Configuration, S::Speeds),
    /// What the target knows.
    pub observe: Observe<S::Configuration>,
    /// Where the motion ends.
    pub target: Rc<Target>,
}

/// The most steps of a run. Only runs that stay near a singularity of their coordinates come to it.
const MOST_STEPS: u64 = 150_000;

impl<S: Kernel> Setup<S> {
    /// A method in one form; `control` makes it from a setting.
    pub fn entry<F: Form<Counted<S>> + 'static, C: Control<Counted<S>>>(
        &self,
        (method, setting): (&'static str, Setting),
        (name, form): (&'static str, F),
        control: impl Fn(f64) -> C + 'static,
    ) -> Entry {
        let Setup { chart, kernel, start: (q, z), .. } = *self;
        let (observe, target) = (Rc::clone(&self.observe), Rc::clone(&self.target));
        Entry::new((method, chart, name), Side::Gauss, setting, move |value, duration, ask| {
            let kernel = Counted::new(black_box(kernel));
            let problem = SystemProblem { system: &kernel, form, input: NoInput };
            let start = problem.state(0.0, q, &z);
            let control = control(value);
            let nothing = &mut |_: &State<_>, _: &Rates<_>, _| ControlFlow::Continue(());
            match ask {
                Ask::Time => {
                    black_box(control.drive(&problem, black_box(start), duration, MOST_STEPS, nothing)?);
                }
                Ask::Error(error) => {
                    let end = control.drive(&problem, start, duration, MOST_STEPS, nothing)?;
                    *error = target.error(&observe(&end.q));
                }
                Ask::Energy(see) => {
                    let emit = &mut |state: &State<Counted<S>>, _: &Rates<_>, _| {
                        let z = form.speeds(&kernel, state.t, &state.q, &state.y);
                        see(state.t, kernel.energy(state.t, &state.q, &z));
                        ControlFlow::Continue(())
                    };
                    control.drive(&problem, start, duration, MOST_STEPS, emit)?;
                }
            }
            Ok(kernel.evaluations())
        })
    }
}
