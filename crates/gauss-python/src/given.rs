//! What runs are given in Python: inputs, events, states, methods, controllers.

use gauss_runtime::prelude::Crossing;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::arrays::{self, shown};
use crate::calls::Calls;
use crate::kernels::AnyScene;
use crate::steps::{Control, Function, Table, Until, Watched};

/// What an input may be in Python.
pub enum GivenInput {
    /// The same at all times.
    Numbers(Vec<f64>),
    /// Over time.
    Table(Table),
    /// Of (t, q, z).
    Function(Py<PyAny>),
}

/// The input; zeros may stand for one that is left out beside a controller.
pub fn input(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>, controlled: bool) -> PyResult<GivenInput> {
    let size = scene.sizes().input;
    let Some(given) = given else {
        if size == 0 || controlled {
            return Ok(GivenInput::Numbers(vec![0.0; size]));
        }
        let words: Vec<&str> = scene.description().inputs.iter().map(|part| part.name).collect();
        return Err(PyTypeError::new_err(format!("the run needs an input: {}", words.join(", "))));
    };
    if given.is_callable() {
        return Ok(GivenInput::Function(given.clone().unbind()));
    }
    if let Ok(pair) = given.cast::<PyTuple>()
        && pair.len() == 2
        && pair.get_item(0)?.extract::<f64>().is_err()
    {
        return table(&pair.get_item(0)?, &pair.get_item(1)?, size).map(GivenInput::Table);
    }
    let (numbers, axes) = arrays::numbers("input", given)?;
    match axes[..] {
        [count] if count == size => Ok(GivenInput::Numbers(numbers)),
        _ => Err(PyValueError::new_err(format!("input has shape {}; expected ({size},)", shown(&axes)))),
    }
}

fn table(times: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>, size: usize) -> PyResult<Table> {
    let ((times, of_times), (values, of_values)) =
        (arrays::numbers("times of the input", times)?, arrays::numbers("values of the input", values)?);
    let rows = times.len();
    let fits = of_times == [rows] && (of_values == [rows, size] || size == 1 && of_values == [rows]);
    if rows == 0 || !fits {
        let (of_times, of_values) = (shown(&of_times), shown(&of_values));
        return Err(PyValueError::new_err(format!(
            "an input over time is (times, values) of shapes (n,) and (n, {size}); found {of_times} and {of_values}"
        )));
    }
    // What is not a number does not increase.
    let increases = |k: usize| times[k - 1].partial_cmp(&times[k]).is_some_and(core::cmp::Ordering::is_lt);
    if let Some(k) = (1..rows).find(|&k| !increases(k)) {
        return Err(PyValueError::new_err(format!("times of the input do not increase at number {k}")));
    }
    Ok(Table { times, values })
}

/// What happens in a run or ends it, as given in Python.
pub enum GivenEnd {
    /// A number of q, or behind these of z, less a value.
    Number(usize, f64),
    /// Of (t, q, z).
    Function(Py<PyAny>),
}

fn crossing(word: &str) -> PyResult<Crossing> {
    match word {
        "any" => Ok(Crossing::Any),
        "rising" => Ok(Crossing::Rising),
        "falling" => Ok(Crossing::Falling),
        _ => Err(PyValueError::new_err(format!("{word:?} is no direction; there are any, rising, falling"))),
    }
}

/// `(name, value)`, `(name, value, direction)`, a function, `(function, direction)`.
fn end(scene: &dyn AnyScene, given: &Bound<'_, PyAny>) -> PyResult<(GivenEnd, Crossing)> {
    if given.is_callable() {
        return Ok((GivenEnd::Function(given.clone().unbind()), Crossing::Any));
    }
    if let Ok((function, word)) = given.extract::<(Bound<'_, PyAny>, String)>()
        && function.is_callable()
    {
        return Ok((GivenEnd::Function(function.unbind()), crossing(&word)?));
    }
    let named = match given.extract::<(String, f64)>() {
        Ok((name, value)) => Ok((name, value, "any".to_owned())),
        Err(_) => given.extract::<(String, f64, String)>(),
    };
    let Ok((name, value, word)) = named else {
        let what = "an event or end is (name, value), (name, value, direction), a function of (t, q, z), or (function, direction)";
        return Err(PyTypeError::new_err(what));
    };
    let names = scene.names().concat();
    match names.iter().position(|other| *other == name) {
        Some(place) => Ok((GivenEnd::Number(place, value), crossing(&word)?)),
        None => {
            Err(PyKeyError::new_err(format!("no number of a state is called {name}; there are {}", names.join(", "))))
        }
    }
}

/// One of them, or a list.
pub fn ends(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<(GivenEnd, Crossing)>> {
    match given {
        None => Ok(Vec::new()),
        Some(given) => match given.cast::<PyList>() {
            Ok(list) => list.iter().map(|given| end(scene, &given)).collect(),
            Err(_) => Ok(vec![end(scene, given)?]),
        },
    }
}

/// Finite numbers, and what else must hold of tolerances and steps. The first of them is the relative tolerance.
pub fn checked(interval: (f64, f64), positive: &[(&str, f64)]) -> PyResult<()> {
    if !(interval.0.is_finite() && interval.1.is_finite()) {
        return Err(PyValueError::new_err("the interval is a pair of finite times"));
    }
    let wrong = |why: String| Err(PyValueError::new_err(why));
    match (positive.iter().find(|(_, value)| value.is_nan() || *value <= 0.0), positive.first()) {
        (Some((name, value)), _) => wrong(format!("{name} must be positive, found {value}")),
        (None, Some((name, value))) if *value < f64::EPSILON => wrong(format!(
            "{name} is {value:e}, and numbers of 64 bits have rounding of {:.1e}: no step can keep it",
            f64::EPSILON
        )),
        (None, _) => Ok(()),
    }
}

/// Times of states that are wanted: within the interval.
pub fn times_within(given: &Bound<'_, PyAny>, (from, to): (f64, f64)) -> PyResult<Vec<f64>> {
    let (times, axes) = arrays::numbers("times", given)?;
    let (least, most) = (from.min(to), from.max(to));
    match times.iter().find(|time| !(least..=most).contains(*time)) {
        _ if axes.len() != 1 => Err(PyValueError::new_err(format!("times has shape {}; expected (n,)", shown(&axes)))),
        Some(time) => Err(PyValueError::new_err(format!("the time {time} is outside of the run"))),
        None => Ok(times),
    }
}

/// States of many runs: rows, or one for all; how many.
pub fn states(name: &'static str, given: &Bound<'_, PyAny>, size: usize) -> PyResult<(Vec<f64>, Option<usize>)> {
    let (numbers, axes) = arrays::numbers(name, given)?;
    match axes[..] {
        [count] if count == size => Ok((numbers, None)),
        [runs, count] if count == size => Ok((numbers, Some(runs))),
        _ => {
            let expected = format!("({size},) or (runs, {size})");
            Err(PyValueError::new_err(format!("{name} has shape {}; expected {expected}", shown(&axes))))
        }
    }
}

/// The method by name, and its steps: their one length, or tolerances and the longest one.
pub fn control(
    method: Option<&str>,
    step: Option<f64>,
    (rtol, atol, largest): (f64, f64, Option<f64>),
) -> PyResult<Control> {
    let wrong = |why: &str| Err(PyValueError::new_err(why.to_owned()));
    if step.is_some() && largest.is_some() {
        return wrong("steps are of the length step, or at most of largest_step: give one of them");
    }
    let largest = largest.unwrap_or(f64::INFINITY);
    match (method.unwrap_or("dormand_prince"), step) {
        ("dormand_prince", None) => Ok(Control::Adaptive(rtol, atol, largest)),
        ("dormand_prince", Some(step)) => Ok(Control::Fixed(step)),
        ("collocation", Some(step)) => Ok(Control::Implicit(step)),
        ("collocation", None) => wrong("the method collocation needs step: its steps are of one length"),
        ("rosenbrock", None) => Ok(Control::Stiff(rtol, atol, largest)),
        ("taylor", None) => Ok(Control::Taylor(rtol, atol, largest)),
        (name @ ("rosenbrock" | "taylor"), Some(_)) => {
            wrong(&format!("the method {name} chooses its steps by rtol and atol, and takes no step"))
        }
        (name, _) => {
            let all = "dormand_prince, rosenbrock, taylor, collocation";
            wrong(&format!("{name:?} is no method; there are {all}"))
        }
    }
}

/// A controller that samples, as given in Python: its function, period and delay.
pub struct GivenController {
    /// Of (t, q, z).
    pub law: Py<PyAny>,
    /// From one instant to the next.
    pub period: f64,
    /// Until the input acts.
    pub delay: f64,
}

/// The controller, with its period and delay.
pub fn controller(
    scene: &dyn AnyScene,
    law: Option<&Bound<'_, PyAny>>,
    period: Option<f64>,
    delay: f64,
) -> PyResult<Option<GivenController>> {
    let (law, period) = match (law, period) {
        (None, None) if delay != 0.0 => {
            return Err(PyTypeError::new_err("delay is that of a controller, and there is none"));
        }
        (None, None) => return Ok(None),
        (Some(law), Some(period)) => (law, period),
        (Some(_), None) => return Err(PyTypeError::new_err("a controller needs its period")),
        (None, Some(_)) => return Err(PyTypeError::new_err("period is that of a controller, and there is none")),
    };
    if !law.is_callable() {
        return Err(PyTypeError::new_err("a controller is a function of (t, q, z)"));
    }
    if scene.sizes().input == 0 {
        return Err(PyTypeError::new_err(format!("{} has no input for a controller", scene.description().name)));
    }
    match (period, delay) {
        (period, _) if !(period > 0.0 && period.is_finite()) => {
            Err(PyValueError::new_err(format!("period must be positive, found {period}")))
        }
        (_, delay) if !(delay >= 0.0 && delay.is_finite()) => {
            Err(PyValueError::new_err(format!("delay must not be negative, found {delay}")))
        }
        _ => Ok(Some(GivenController { law: law.clone().unbind(), period, delay })),
    }
}

/// A function of Python that is watched.
pub fn watch<'a>(end: &'a GivenEnd, calls: &'a Calls) -> impl Fn(f64, &[f64], &[f64]) -> f64 + Sync + 'a {
    move |t, q, z| match end {
        GivenEnd::Function(function) => {
            calls.call(function, (t, q, z), |value| value.extract::<f64>()).unwrap_or(f64::NAN)
        }
        GivenEnd::Number(..) => f64::NAN,
    }
}

/// An event of a run, or its end, with the function that is watched where it is one.
pub fn until_of<'a>((end, crossing): &(GivenEnd, Crossing), ends: bool, watched: Function<'a, f64>) -> Until<'a> {
    let watched = match end {
        GivenEnd::Number(place, value) => Watched::Number(*place, *value),
        GivenEnd::Function(_) => Watched::Function(watched),
    };
    Until { watched, crossing: *crossing, ends }
}

/// The end of an ensemble: none, or one number.
pub fn one_end<'a>(mut ends: Vec<(GivenEnd, Crossing)>) -> PyResult<Option<Until<'a>>> {
    match (ends.pop(), ends.is_empty()) {
        (None, _) => Ok(None),
        (Some((GivenEnd::Number(place, value), crossing)), true) => {
            Ok(Some(Until { watched: Watched::Number(place, value), crossing, ends: true }))
        }
        _ => Err(PyTypeError::new_err("the end of an ensemble is one (name, value), with a direction or not")),
    }
}

/// Parameters of single runs: name, place among all numbers, and the numbers.
pub fn own_parameters(
    scene: &dyn AnyScene,
    given: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<(String, usize, Vec<f64>)>> {
    let mut own = Vec::new();
    for (name, values) in given.into_iter().flat_map(|given| given.iter()) {
        let name: String = name.extract()?;
        let fields = scene.description().fields;
        let Some(number) = fields.iter().position(|field| field.name == name && field.shape.size() == 1) else {
            let names: Vec<&str> =
                fields.iter().filter(|field| field.shape.size() == 1).map(|field| field.name).collect();
            let message = format!("{name} is no parameter that is one number; there are {}", names.join(", "));
            return Err(PyKeyError::new_err(message));
        };
        let place = fields[..number].iter().map(|field| field.shape.size()).sum();
        let (numbers, axes) = arrays::numbers(&name, &values)?;
        if axes.len() != 1 {
            return Err(PyValueError::new_err(format!("{name} has shape {}; expected (runs,)", shown(&axes))));
        }
        own.push((name, place, numbers));
    }
    Ok(own)
}

/// The number of runs that all arrays have.
pub fn common<'a>(counts: impl Iterator<Item = (&'a str, Option<usize>)>) -> PyResult<usize> {
    let mut known: Option<(&str, usize)> = None;
    for (name, count) in counts {
        let Some(count) = count else { continue };
        match known {
            Some((other, runs)) if runs != count => {
                return Err(PyValueError::new_err(format!("{other} has {runs} runs, {name} has {count}")));
            }
            _ => known = Some((name, count)),
        }
    }
    Ok(known.map_or(1, |(_, count)| count))
}
