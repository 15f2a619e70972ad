//! Answers that a run has of its request while it goes on: inputs, events, jumps.

use gauss_runtime::prelude::*;

use super::request::{Effect, Function, Input, Request, Until, Watched};
use super::{components, numbers_of, vector};

/// Requirements that a run has of a system.
pub trait Moving: GaussSystem<Scalar = f64, Input: VectorSpace<f64>> {}

impl<S: GaussSystem<Scalar = f64, Input: VectorSpace<f64>>> Moving for S {}

/// A function that is watched.
pub(super) type Watch<'a, Q, Z> = Box<dyn Fn(f64, &Q, &Z) -> f64 + 'a>;

/// The input of a run.
pub(super) fn input<S: Moving>(request: &Request<'_>, t: f64, q: &S::Configuration, z: &S::Speeds) -> S::Input {
    match request.input {
        Input::Function(function) => of_numbers(*function, t, q, z),
        input => input.at(t, |number| number(0)),
    }
}

/// All events, each with its direction, whether it ends the run, whether the state jumps there, and whether it may go
/// on after that.
pub(super) fn watched<'a, S: Moving>(
    request: &'a Request<'_>,
) -> impl Iterator<Item = (Watch<'a, S::Configuration, S::Speeds>, Crossing, [bool; 3])> {
    let jumps = |until: &Until<'_>| match until.effect {
        Effect::Jumps(_, through) => [true, through],
        _ => [false; 2],
    };
    request.until.iter().map(move |until| {
        let [jumps, through] = jumps(until);
        (watch::<S>(until), until.crossing, [until.ends(), jumps, through])
    })
}

/// Makes the jump of an event in a state; returns whether it did.
pub(super) fn jump<S: Moving>(request: &Request<'_>, place: usize, state: &mut Sample<S>) -> bool {
    let Some(Effect::Jumps(function, _)) = request.until.get(place).map(|until| &until.effect) else { return false };
    let Some((q, z)) = function(state.t, &numbers_of(&state.q), &components(&state.z)) else { return false };
    // Numbers that are no state end the run: these have been looked at, or are those of a function that failed.
    // Numbers are put into the vectors that are there: of models at run time these know what q consists of.
    let mut components = state.q.components();
    q.iter().enumerate().for_each(|(i, &number)| components.set_component(i, number));
    (state.q, state.z) = (S::Configuration::from_components(&components).renormalise(), vector(&z));
    true
}

/// The input that a function gives.
pub(super) fn of_numbers<Q: Configuration<Scalar = f64>, Z: VectorSpace<f64>, U: VectorSpace<f64>>(
    function: Function<'_, Vec<f64>>,
    t: f64,
    q: &Q,
    z: &Z,
) -> U {
    vector(&function(t, &numbers_of(q), &components(z)))
}

/// The function of an event.
pub(super) fn watch<'a, S: Moving>(until: &'a Until<'_>) -> Watch<'a, S::Configuration, S::Speeds> {
    match until.watched {
        Watched::Number(place, value) => Box::new(number::<S>(place, value)),
        Watched::Function(function) => Box::new(move |t, q, z| function(t, &numbers_of(q), &components(z))),
    }
}

/// A number of q, or behind these of z, less a value.
pub(super) fn number<S: Moving>(
    place: usize,
    value: f64,
) -> impl Fn(f64, &S::Configuration, &S::Speeds) -> f64 + Send + 'static {
    move |_, q, z| {
        let size = <<S::Configuration as Configuration>::Components as VectorSpace<f64>>::DIM;
        let number = if place < size { q.components().component(place) } else { z.component(place - size) };
        number - value
    }
}
