//! Runs of one state, the type of their system forgotten: numbers in, columns of numbers out.

mod one;
mod request;
mod stoppable;

pub use one::{Methods, Outcome};
pub use request::{Control, Function, Held, Input, Request, Table, Until, Watched};
pub use stoppable::Stoppable;

use gauss_runtime::prelude::{Configuration, VectorSpace};

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
