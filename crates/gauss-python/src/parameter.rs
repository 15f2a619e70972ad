//! Types of fields: how a value is made from plain numbers.

use gauss_runtime::nalgebra::{SMatrix, SVector, UnitQuaternion};
use gauss_runtime::prelude::{Matrix3, Real, RigidBody, Vector3};

use crate::description::Shape;

/// The numbers of all parameters, one after the other, as they are read.
#[derive(Debug)]
pub struct Numbers<'a, T>(core::slice::Iter<'a, T>);

impl<'a, T: Copy> Numbers<'a, T> {
    /// From the first.
    #[must_use]
    pub fn of(numbers: &'a [T]) -> Self {
        Self(numbers.iter())
    }

    /// The next one; 0 behind the last, which whoever counts them by [`Shape::size`] does not meet.
    fn next(&mut self) -> T
    where
        T: Real,
    {
        self.0.next().copied().unwrap_or_else(T::zero)
    }
}

/// A type that a field may have in a struct with `#[gauss(python)]`.
#[diagnostic::on_unimplemented(
    message = "a field of type `{Self}` has no value in Python",
    label = "Python gives numbers, vectors, matrices and bodies",
    note = "types are `{T}`, `Vector3<{T}>`, `Vector6<{T}>`, `Matrix3<{T}>`, `Matrix6<{T}>`, arrays of `{T}`, \
            `RigidBody<{T}>` and `UnitQuaternion<{T}>`"
)]
pub trait Parameter<T> {
    /// Shape of its values.
    const SHAPE: Shape;

    /// The value made of the next numbers.
    fn read(numbers: &mut Numbers<'_, T>) -> Self;
}

/// A struct whose fields all have values in Python; implemented by [`scene!`](crate::scene).
pub trait FromNumbers<T> {
    /// The struct with these numbers, field by field.
    fn from_numbers(numbers: &mut Numbers<'_, T>) -> Self;
}

impl<T: Real> Parameter<T> for T {
    const SHAPE: Shape = Shape::Array(&[]);

    fn read(numbers: &mut Numbers<'_, T>) -> Self {
        numbers.next()
    }
}

impl<T: Real, const N: usize> Parameter<T> for [T; N] {
    const SHAPE: Shape = Shape::Array(&[N]);

    fn read(numbers: &mut Numbers<'_, T>) -> Self {
        core::array::from_fn(|_| numbers.next())
    }
}

impl<T: Real, const R: usize, const C: usize> Parameter<T> for SMatrix<T, R, C> {
    const SHAPE: Shape = if C == 1 { Shape::Array(&[R]) } else { Shape::Array(&[R, C]) };

    fn read(numbers: &mut Numbers<'_, T>) -> Self {
        let rows: [[T; C]; R] = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        Self::from_fn(|i, j| rows[i][j])
    }
}

impl<T: Real> Parameter<T> for UnitQuaternion<T> {
    const SHAPE: Shape = Shape::Rotation;

    fn read(numbers: &mut Numbers<'_, T>) -> Self {
        let components: SVector<T, 4> = Parameter::read(numbers);
        gauss_runtime::prelude::Configuration::from_components(&components)
    }
}

impl<T: Real> Parameter<T> for RigidBody<T> {
    const SHAPE: Shape = Shape::Body;

    fn read(numbers: &mut Numbers<'_, T>) -> Self {
        let mass = numbers.next();
        let center_of_mass: Vector3<T> = Parameter::read(numbers);
        let inertia: Matrix3<T> = Parameter::read(numbers);
        Self { mass, center_of_mass, inertia }
    }
}
