//! Directions of slip that turn.

use gauss_runtime::real::{Real, largest_derivative};

use crate::dense::{norm, value};

/// A direction of slip with two that are normal to it and to one another, in whose planes it turns. Of two rows the
/// first is along them.
#[derive(Clone, Copy)]
pub(crate) struct Frame<T> {
    pub(crate) along: [T; 3],
    pub(crate) across: [[T; 3]; 2],
}

impl<T: Real> Frame<T> {
    pub(crate) fn of(along: [T; 3]) -> Self {
        let [x, y, z] = along;
        if value(z) == 0.0 && largest_derivative(z) == 0.0 {
            return Self { along, across: [[-y, x, z], [z, z, T::one()]] };
        }
        // The axis that is farthest from the direction, times it.
        let farthest = (0..3).min_by(|&i, &j| value(along[i]).abs().total_cmp(&value(along[j]).abs())).unwrap_or(0);
        let axis = core::array::from_fn(|k| if k == farthest { T::one() } else { T::zero() });
        let first = cross(axis, along);
        let size = norm(&first);
        let first = first.map(|e| e / size);
        Self { along, across: [first, cross(along, first)] }
    }

    /// Turns the direction in the plane with one of the others.
    pub(crate) fn turn(&mut self, plane: usize, by: T) {
        let (sine, cosine) = by.sin_cos();
        let (a, b) = (self.along, self.across[plane]);
        self.along = core::array::from_fn(|k| cosine * a[k] + sine * b[k]);
        self.across[plane] = core::array::from_fn(|k| cosine * b[k] - sine * a[k]);
    }
}

fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
