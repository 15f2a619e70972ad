//! Values that runs are given in Python: inputs, events, states, methods, controllers.

use gauss_contact::{Impact, StepLaw, StepScheme};
use gauss_runtime::integrate::{Method, StepSetting};
use gauss_runtime::prelude::Crossing;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::arrays::{self, shown, vector};
use crate::calls::Calls;
use crate::kernels::{AnyKernel, AnyScene};
use crate::steps::{Control, Effect, Function, Jumped, Table, Until, Watched};

/// An input as given in Python.
pub enum GivenInput {
    /// The same at all times.
    Numbers(Vec<f64>),
    /// Over time.
    Table(Table),
    /// A function of (t, q, z).
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

/// A value that passes through zero at an event or an end, as given in Python.
pub enum GivenEnd {
    /// A number of q, or behind these of z, less a value.
    Number(usize, f64),
    /// A function of (t, q, z).
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

/// The times between which a run goes: any pair of numbers, a tuple, a list or an array.
pub fn interval(given: &Bound<'_, PyAny>) -> PyResult<(f64, f64)> {
    let times: Option<Vec<f64>> =
        given.try_iter().ok().and_then(|times| times.map(|time| time.ok()?.extract().ok()).collect());
    match times.as_deref() {
        Some(&[start, end]) => Ok((start, end)),
        _ => Err(PyTypeError::new_err("the interval is a pair of times, (0, 10)")),
    }
}

/// Finite times, and positive tolerances and lengths of steps.
pub fn checked(
    interval: (f64, f64),
    (rtol, atol): (Option<f64>, Option<f64>),
    (step, largest): (Option<f64>, Option<f64>),
) -> PyResult<()> {
    let wrong = |why: String| Err(PyValueError::new_err(why));
    if !(interval.0.is_finite() && interval.1.is_finite()) {
        return wrong("the interval is a pair of finite times".to_owned());
    }
    let all = [("rtol", rtol), ("atol", atol), ("step", step), ("largest_step", largest)];
    let given = all.into_iter().filter_map(|(name, value)| Some((name, value?)));
    if let Some((name, value)) = given.into_iter().find(|(_, value)| value.is_nan() || *value <= 0.0) {
        return wrong(format!("{name} must be positive, found {value}"));
    }
    match rtol.filter(|rtol| *rtol < f64::EPSILON) {
        Some(rtol) => wrong(format!(
            "rtol is {rtol:e}, and numbers of 64 bits have rounding of {:.1e}: no step can keep it",
            f64::EPSILON
        )),
        None => Ok(()),
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

/// The words of Python for a method and its steps.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    /// The method.
    pub method: Option<&'a str>,
    /// The one length of steps.
    pub step: Option<f64>,
    /// Relative and absolute tolerance, the longest step.
    pub tolerances: (Option<f64>, Option<f64>, Option<f64>),
    /// Way in which contacts are followed.
    pub contacts: Option<&'a str>,
    /// The law of impacts.
    pub impact: Option<&'a str>,
    /// The law of friction in steps.
    pub friction: Option<&'a str>,
    /// The motion between impacts in steps.
    pub scheme: Option<&'a str>,
}

fn wrong<R>(why: &str) -> PyResult<R> {
    Err(PyValueError::new_err(why.to_owned()))
}

/// Relative and absolute tolerance where nothing is said.
const TOLERANCE: f64 = 1e-9;

/// One of some words.
fn word<T: Copy>(name: &str, given: &str, known: &[(&str, T)]) -> PyResult<T> {
    match known.iter().find(|(word, _)| *word == given) {
        Some((_, value)) => Ok(*value),
        None => {
            let all: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
            wrong(&format!("{name} is {given:?}; there are {}", all.join(", ")))
        }
    }
}

/// The method and its steps: their one length, or tolerances and the longest one. `touches` says whether contacts act.
pub fn control(name: &str, touches: bool, words: Words<'_>) -> PyResult<Control> {
    let Words { method, step, tolerances: (rtol, atol, largest), contacts, impact, friction, scheme } = words;
    if step.is_some() && largest.is_some() {
        return wrong("steps are of the length step, or at most of largest_step: give one of them");
    }
    let tolerates = rtol.is_some() || atol.is_some();
    let (rtol, atol) = (rtol.unwrap_or(TOLERANCE), atol.unwrap_or(TOLERANCE));
    let largest = largest.unwrap_or(f64::INFINITY);
    if touches {
        return touching(words, (rtol, atol, largest), tolerates);
    }
    let of_contacts =
        [("contacts", contacts), ("impact", impact), ("friction", friction), ("scheme", scheme)].into_iter();
    if let Some((word, _)) = of_contacts.clone().find(|(_, given)| given.is_some()) {
        return Err(PyTypeError::new_err(format!("{word} is of contacts, and none act in this {name}")));
    }
    let method = match method {
        None => Method::DormandPrince8,
        Some(name) => name.parse().map_err(|error| PyValueError::new_err(format!("{name:?} is {error}")))?,
    };
    match step {
        Some(_) if !method.takes_length() => {
            wrong(&format!("the method {method} chooses its steps by rtol and atol, and takes no step"))
        }
        Some(_) if tolerates => wrong("steps of one length, step, keep no rtol and atol: give one or the other"),
        Some(step) => Ok(Control::Smooth(method, StepSetting::Equal(step))),
        None if !method.keeps_tolerances() => {
            wrong(&format!("the method {method} needs step: its steps are of one length"))
        }
        None => {
            let largest = Some(largest).filter(|largest| largest.is_finite());
            Ok(Control::Smooth(method, StepSetting::Tolerant { relative: rtol, absolute: atol, largest }))
        }
    }
}

const LAWS: [(&str, Impact); 4] = [
    ("newton", Impact::Newton),
    ("moreau", Impact::Moreau),
    ("poisson", Impact::Poisson),
    ("sequential", Impact::Sequential),
];
const FRICTIONS: [(&str, StepLaw); 2] = [("coulomb", StepLaw::Coulomb), ("relaxed", StepLaw::ConvexRelaxation)];
const SCHEMES: [(&str, StepScheme); 2] = [("midpoint", StepScheme::Midpoint), ("moreau_jean", StepScheme::MoreauJean)];

/// Contacts from event to event, or in steps.
fn touching(words: Words<'_>, (rtol, atol, largest): (f64, f64, f64), tolerates: bool) -> PyResult<Control> {
    let Words { method, step, contacts, impact, friction, scheme, .. } = words;
    if word("contacts", contacts.unwrap_or("events"), &[("events", true), ("steps", false)])? {
        return match (step, friction.or(scheme), method.unwrap_or("dormand_prince")) {
            (Some(_), ..) => wrong("step is that of contacts=\"steps\": from event to event rtol and atol choose it"),
            (_, Some(_), _) => wrong("friction and scheme are those of contacts=\"steps\""),
            (.., "dormand_prince") => {
                Ok(Control::ContactEvents(rtol, atol, largest, word("impact", impact.unwrap_or("newton"), &LAWS)?))
            }
            (.., name) => wrong(&format!("with contacts the method is dormand_prince, and not {name}")),
        };
    }
    match (step, method, impact.filter(|law| *law != "newton")) {
        _ if largest.is_finite() => wrong("steps of contacts are of the length step, and have no largest_step"),
        (None, ..) => wrong("contacts=\"steps\" needs step, their length"),
        (_, Some(_), _) => wrong("contacts=\"steps\" is a method of its own: leave out method"),
        (.., Some(_)) => wrong("impacts in steps go by Newton's law: leave out impact, or take contacts=\"events\""),
        (Some(step), None, None) => Ok(Control::ContactSteps(
            step,
            tolerates.then_some((rtol, atol)),
            word("scheme", scheme.unwrap_or("midpoint"), &SCHEMES)?,
            word("friction", friction.unwrap_or("coulomb"), &FRICTIONS)?,
        )),
    }
}

/// A controller that samples, as given in Python: its function, period and delay.
pub struct GivenController {
    /// Function of (t, q, z).
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
pub fn watch<'a>(event: &'a GivenEvent, calls: &'a Calls) -> impl Fn(f64, &[f64], &[f64]) -> f64 + Sync + 'a {
    move |t, q, z| match &event.end {
        GivenEnd::Function(function) => {
            calls.call(function, (t, q, z), |value| value.extract::<f64>()).unwrap_or(f64::NAN)
        }
        GivenEnd::Number(..) => f64::NAN,
    }
}

/// The jump at an event: a function of Python, which may give None.
pub fn jump<'a>(
    event: &'a GivenEvent,
    calls: &'a Calls,
    kernel: &'a dyn AnyKernel,
) -> impl Fn(f64, &[f64], &[f64]) -> Jumped + Sync + 'a {
    let sizes = kernel.scene().sizes();
    let read = move |value: &Bound<'_, PyAny>| {
        if value.is_none() {
            return Ok(None);
        }
        let Ok((q, z)) = value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() else {
            return Err(PyTypeError::new_err("a jump gives (q, z), or None where the state stays as it is"));
        };
        let state = (vector("q", &q, sizes.configuration)?, vector("z", &z, sizes.speeds)?);
        kernel.check(&state.0, &state.1).map_err(PyValueError::new_err)?;
        Ok(Some(state))
    };
    move |t, q, z| match &event.effect {
        GivenEffect::Jumps(function, _) => calls.call(function, (t, q, z), read).unwrap_or_else(|| {
            // The run ends with the last state before it.
            Some((vec![f64::NAN; sizes.configuration], vec![f64::NAN; sizes.speeds]))
        }),
        GivenEffect::None | GivenEffect::Ends => None,
    }
}

/// An event of a run with its effect, and the functions of Python that it calls.
pub fn until_of<'a>(given: &GivenEvent, (watched, jump): (Function<'a, f64>, Function<'a, Jumped>)) -> Until<'a> {
    let watched = match given.end {
        GivenEnd::Number(place, value) => Watched::Number(place, value),
        GivenEnd::Function(_) => Watched::Function(watched),
    };
    let effect = match given.effect {
        GivenEffect::None => Effect::None,
        GivenEffect::Jumps(_, through) => Effect::Jumps(jump, through),
        GivenEffect::Ends => Effect::Ends,
    };
    Until { watched, crossing: given.crossing, effect }
}

/// Effect of an event on a run, as given in Python.
pub enum GivenEffect {
    /// It goes on.
    None,
    /// The state jumps, by a function of (t, q, z); whether it may go on through zero.
    Jumps(Py<PyAny>, bool),
    /// It ends.
    Ends,
}

/// An event as given in Python.
pub struct GivenEvent {
    /// The value that is watched.
    pub end: GivenEnd,
    /// In which direction.
    pub crossing: Crossing,
    /// Effect on the run.
    pub effect: GivenEffect,
}

/// Pairs of an event and a function, or a list of such, with the word "through" where the event may pass.
pub fn jumps(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<GivenEvent>> {
    let one = |given: &Bound<'_, PyAny>| {
        let pair = given.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>().map(|(event, jump)| (event, jump, None));
        let all = pair.or_else(|_| given.extract().map(|(event, jump, word)| (event, jump, Some::<String>(word))));
        match all {
            Ok((event, jump, through))
                if jump.is_callable() && through.as_deref().is_none_or(|word| word == "through") =>
            {
                let (end, crossing) = self::end(scene, &event)?;
                Ok(GivenEvent { end, crossing, effect: GivenEffect::Jumps(jump.unbind(), through.is_some()) })
            }
            _ => Err(PyTypeError::new_err(
                "a jump is (event, function), or (event, function, \"through\"), and its function of (t, q, z) gives \
                 (q, z)",
            )),
        }
    };
    match given {
        None => Ok(Vec::new()),
        Some(given) => match given.cast::<PyList>() {
            Ok(list) => list.iter().map(|given| one(&given)).collect(),
            Err(_) => Ok(vec![one(given)?]),
        },
    }
}

/// Events without an effect, or ends.
pub fn events(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>, ends: bool) -> PyResult<Vec<GivenEvent>> {
    let of = |(end, crossing)| {
        let effect = if ends { GivenEffect::Ends } else { GivenEffect::None };
        GivenEvent { end, crossing, effect }
    };
    Ok(self::ends(scene, given)?.into_iter().map(of).collect())
}

/// The end of an ensemble: none, or one number.
pub fn one_end<'a>(mut ends: Vec<(GivenEnd, Crossing)>) -> PyResult<Option<Until<'a>>> {
    match (ends.pop(), ends.is_empty()) {
        (None, _) => Ok(None),
        (Some((GivenEnd::Number(place, value), crossing)), true) => {
            Ok(Some(Until { watched: Watched::Number(place, value), crossing, effect: Effect::Ends }))
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
        let fields = &scene.description().fields;
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
