//! `stepper` of the class: a run that makes a step when it is asked to.

use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, MutexGuard, PoisonError};

use gauss_runtime::integrate::StepOutcome;
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::vector;
use crate::class::Kernel;
use crate::errors;
use crate::given::{self, GivenEnd, GivenInput, Words};
use crate::steps::{AnyStepper, Effect, Input, Request, Until, Watched};

/// A run that makes a step when it is asked to.
#[pyclass(frozen, module = "gauss_python")]
pub struct Stepper {
    steps: Mutex<Course>,
    configuration: usize,
    input: usize,
}

/// The run, and what came of its last step.
struct Course {
    stepper: Box<dyn AnyStepper>,
    outcome: StepOutcome,
}

type State<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

impl Stepper {
    // Nothing is left half done where a thread panics.
    fn course(&self) -> MutexGuard<'_, Course> {
        self.steps.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn pair<'py>(&self, py: Python<'py>, row: &[f64]) -> State<'py> {
        let (q, z) = row[1..].split_at(self.configuration);
        (PyArray1::from_slice(py, q), PyArray1::from_slice(py, z))
    }

    fn state<'py>(&self, py: Python<'py>) -> State<'py> {
        self.pair(py, &self.course().stepper.state())
    }
}

#[pymethods]
impl Stepper {
    /// Makes a step: "step" where the run goes on, "until" where one of its ends came, "end" at the end of its
    /// interval. A run that is over stays where it is. `u` is the input from here on; steps begin anew where it is
    /// another one than before.
    #[pyo3(signature = (u=None))]
    fn step(&self, py: Python<'_>, u: Option<&Bound<'_, PyAny>>) -> PyResult<&'static str> {
        let input = u.map(|input| vector("u", input, self.input)).transpose()?;
        let stepped = py.detach(|| {
            let mut course = self.course();
            input.map_or(Ok(()), |input| course.stepper.act(&input))?;
            course.outcome = course.stepper.step()?;
            Ok(course.outcome)
        });
        match stepped {
            Ok(StepOutcome::Stop(_)) => Ok("until"),
            Ok(StepOutcome::End) => Ok("end"),
            Ok(_) => Ok("step"),
            Err(why) => Err(errors::new(py, "IntegrationError", why, ("run", py.None()))),
        }
    }

    /// The state (q, z) at a time within the last step, as accurate as its ends.
    fn interpolate<'py>(&self, py: Python<'py>, t: f64) -> PyResult<State<'py>> {
        let row = py.detach(|| self.course().stepper.at(t)).map_err(PyValueError::new_err)?;
        Ok(self.pair(py, &row))
    }

    /// The time where the run is.
    #[getter]
    fn t(&self) -> f64 {
        self.course().stepper.state()[0]
    }

    /// The configuration where the run is.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.state(py).0
    }

    /// The speeds where the run is.
    #[getter]
    fn z<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.state(py).1
    }

    /// The end that it came to before its time, by its number in `until`.
    #[getter]
    fn stopped_by(&self) -> Option<usize> {
        if let StepOutcome::Stop(number) = self.course().outcome { Some(number) } else { None }
    }

    /// The steps so far.
    #[getter]
    fn steps(&self) -> u64 {
        self.course().stepper.counts()[0]
    }

    /// The steps that were tried in vain.
    #[getter]
    fn rejected(&self) -> u64 {
        self.course().stepper.counts()[1]
    }
}

#[pymethods]
impl Kernel {
    /// Begins a run that makes its steps one at a time, each when it is asked to: those of `simulate`, to the last bit.
    /// `input` is an array, and each step may have another; `until` is (name, value), (name, value, "falling"), or a
    /// list of such. Scenes with contacts are of `without_contacts()`.
    #[pyo3(signature = (q, z, interval, *, rtol=None, atol=None, step=None, largest_step=None, method=None, input=None,
        until=None, max_steps=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn stepper(
        &self,
        py: Python<'_>,
        q: &Bound<'_, PyAny>,
        z: &Bound<'_, PyAny>,
        interval: &Bound<'_, PyAny>,
        rtol: Option<f64>,
        atol: Option<f64>,
        step: Option<f64>,
        largest_step: Option<f64>,
        method: Option<&str>,
        input: Option<&Bound<'_, PyAny>>,
        until: Option<&Bound<'_, PyAny>>,
        max_steps: Option<u64>,
    ) -> PyResult<Stepper> {
        self.knows_all_forces(py, ("stepper", "kernel.without_contacts().stepper"))?;
        let interval = given::interval(interval)?;
        given::checked(interval, (rtol, atol), (step, largest_step))?;
        let (scene, sizes) = (self.scene(), self.scene().sizes());
        let tolerances = (rtol, atol, largest_step);
        let words = Words { method, step, tolerances, contacts: None, impact: None, friction: None, scheme: None };
        let GivenInput::Numbers(numbers) = given::input(scene, input, false)? else {
            return Err(PyTypeError::new_err("the input of steps is an array; each step takes another: step(u)"));
        };
        let ends = given::ends(scene, until)?.into_iter().map(|(end, crossing)| match end {
            GivenEnd::Number(place, value) => {
                Ok(Until { watched: Watched::Number(place, value), crossing, effect: Effect::Ends })
            }
            GivenEnd::Function(_) => Err(PyTypeError::new_err(
                "an end of steps is (name, value), with a direction or not; look at functions between the steps",
            )),
        });
        let request = Request {
            q: &vector("q", q, sizes.configuration)?,
            z: &vector("z", z, sizes.speeds)?,
            interval,
            control: given::control("run", false, words)?,
            input: &Input::Constant(numbers),
            controller: None,
            until: &ends.collect::<PyResult<Vec<_>>>()?,
            times: None,
            limit: max_steps,
            stop: &AtomicBool::new(false),
            look: &|_| (),
        };
        let stepper = py.detach(|| self.kernel().stepper(&request)).map_err(PyValueError::new_err)?;
        let steps = Mutex::new(Course { stepper, outcome: StepOutcome::Step });
        Ok(Stepper { steps, configuration: sizes.configuration, input: sizes.input })
    }
}
