//! Runs of one state, the type of their system forgotten: numbers in, columns of numbers out.

mod causes;
mod contact_events;
mod contact_rows;
mod contact_steps;
mod contacts;
mod control;
mod one;
mod outcome;
mod request;
mod stepper;
mod stoppable;
mod watching;

pub use causes::words;
#[cfg(feature = "loaded")]
pub use contacts::{at as in_contact, run as touching};
#[cfg(feature = "loaded")]
pub use control::{lacks, no_contacts};
pub use one::Methods;
#[cfg(feature = "loaded")]
pub use one::smooth;
pub use outcome::{Event, Happening, InContact, KINDS, Outcome, Touched, column_names};
pub use request::{Control, Effect, Function, Held, Input, Jumped, Request, Table, Until, Watched, looking};
pub use stepper::AnyStepper;
#[cfg(feature = "loaded")]
pub use stepper::{OwnStepper, stepper};
pub use stoppable::Stoppable;

use gauss_runtime::prelude::{Configuration, VectorSpace};

use crate::description::Description;

/// The numbers of a vector.
pub fn components<V: VectorSpace<f64>>(vector: &V) -> Vec<f64> {
    (0..V::DIM).map(|i| vector.component(i)).collect()
}

/// The numbers of a configuration.
pub fn numbers_of<Q: Configuration<Scalar = f64>>(q: &Q) -> Vec<f64> {
    components(&q.components())
}

/// A vector of numbers.
pub fn vector<V: VectorSpace<f64>>(numbers: &[f64]) -> V {
    let mut vector = V::zero();
    numbers.iter().take(V::DIM).enumerate().for_each(|(i, &number)| vector.set_component(i, number));
    vector
}

/// The configuration that numbers are.
pub fn configuration<Q: Configuration<Scalar = f64>>(numbers: &[f64]) -> Result<Q, String> {
    let q = Q::from_components(&vector(numbers));
    match gauss_runtime::configuration::check(&q) {
        Ok(()) => Ok(q.renormalise()),
        Err(error) => Err(error.to_string()),
    }
}

/// The configuration of a state.
///
/// # Errors
/// All numbers of the state that are not finite, and all rotations that are none, by their names.
pub fn state<Q: Configuration<Scalar = f64>>(
    description: &Description,
    [coordinates, speeds]: [&[&str]; 2],
    q: &[f64],
    z: &[f64],
) -> Result<Q, Vec<String>> {
    let mistakes = mistakes(description, [coordinates, speeds], q, z);
    if mistakes.is_empty() { configuration(q).map_err(|why| vec![why]) } else { Err(mistakes) }
}

/// All numbers of a state that are not finite, and all rotations that are none, by their names.
pub fn mistakes(description: &Description, [coordinates, speeds]: [&[&str]; 2], q: &[f64], z: &[f64]) -> Vec<String> {
    let of = |letter: &'static str, names: &[&str], numbers: &[f64]| {
        let lost = names.iter().zip(numbers).enumerate().filter(|(_, (_, number))| !number.is_finite());
        let told = lost.map(|(k, (name, number))| format!("{letter}[{k}] ({name}) is {number}, and no finite number"));
        told.collect::<Vec<_>>()
    };
    let mut mistakes = of("q", coordinates, q);
    for (place, part) in description.configuration().filter(|(_, part)| part.unit > 0) {
        let (name, end) = (part.name, place + part.unit);
        let squares: f64 = q[place..end].iter().map(|number| number * number).sum();
        if squares.is_finite() && off_group(squares) {
            mistakes.push(format!("q[{place}:{end}] ({name}) is no rotation: {}", off_group_words(squares)));
        }
    }
    mistakes.extend(of("z", speeds, z));
    mistakes
}

/// Whether numbers whose squares add up to this are no rotation: in more than half of the digits, as
/// `configuration::check` has it. What is not a number is none.
pub fn off_group(squares: f64) -> bool {
    // NaN is neither near nor far.
    (squares - 1.0).abs().partial_cmp(&(2.0 * f64::EPSILON.sqrt())).is_none_or(core::cmp::Ordering::is_gt)
}

/// Why numbers with such squares are no rotation.
pub fn off_group_words(squares: f64) -> String {
    format!("squares of its numbers add up to {squares:.6}, and to 1 of every rotation")
}
