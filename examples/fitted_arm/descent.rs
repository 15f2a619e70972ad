//! A function of many numbers made least by its gradient: limited-memory BFGS (J. Nocedal & S. J. Wright, *Numerical
//! Optimization*, algorithm 7.5), with steps halved until the function falls.

use std::collections::VecDeque;
use std::error::Error;

use gauss_runtime::nalgebra::SVector;

/// Differences of points and of gradients that are remembered.
const MEMORY: usize = 20;

/// The numbers, the value there, and how many gradients it took.
pub struct Least<const P: usize> {
    pub numbers: [f64; P],
    pub value: f64,
    pub gradients: usize,
}

/// From a start to where an iteration promises less than a part of the value.
///
/// # Errors
/// Those of the function.
pub fn descend<const P: usize, E: Error + 'static>(
    start: [f64; P],
    part: f64,
    function: impl Fn(&[f64; P]) -> Result<(f64, [f64; P]), E>,
) -> Result<Least<P>, Box<dyn Error>> {
    let at = |x: &SVector<f64, P>| function(&(*x).into()).map(|(value, slopes)| (value, SVector::from(slopes)));
    let mut x = SVector::from(start);
    let (mut value, mut slopes) = at(&x)?;
    let (mut gradients, mut pairs) = (1, VecDeque::<(SVector<f64, P>, SVector<f64, P>)>::new());
    for _ in 0..2000 {
        let way = -two_loops(&pairs, slopes);
        let promised = -way.dot(&slopes);
        if promised < part * value {
            break;
        }
        // The first step has no scale of its own.
        let mut length = if pairs.is_empty() { 1.0 / slopes.norm() } else { 1.0 };
        let mut next = at(&(x + way * length));
        gradients += 1;
        // A run that fails went too far.
        while !next.as_ref().is_ok_and(|(found, _)| *found <= value - 1e-4 * length * promised) {
            length *= 0.5;
            if length < 1e-12 {
                return Ok(Least { numbers: x.into(), value, gradients });
            }
            next = at(&(x + way * length));
            gradients += 1;
        }
        let (found, there) = next?;
        let (step, change) = (way * length, there - slopes);
        if step.dot(&change) > 0.0 {
            pairs.push_front((step, change));
            pairs.truncate(MEMORY);
        }
        (x, value, slopes) = (x + step, found, there);
    }
    Ok(Least { numbers: x.into(), value, gradients })
}

/// The inverse Hessian that the pairs tell, times a vector.
fn two_loops<const P: usize>(
    pairs: &VecDeque<(SVector<f64, P>, SVector<f64, P>)>,
    mut vector: SVector<f64, P>,
) -> SVector<f64, P> {
    let mut along = Vec::new();
    for (step, change) in pairs {
        let part = step.dot(&vector) / step.dot(change);
        vector -= change * part;
        along.push(part);
    }
    if let Some((step, change)) = pairs.front() {
        vector *= step.dot(change) / change.norm_squared();
    }
    for ((step, change), part) in pairs.iter().zip(along).rev() {
        vector += step * (part - change.dot(&vector) / step.dot(change));
    }
    vector
}
