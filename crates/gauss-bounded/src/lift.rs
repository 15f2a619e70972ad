//! States, parameters and inputs as bounded numbers.

use gauss_runtime::__crates_0_1_0::packs_of_one;
use gauss_runtime::nalgebra::{
    Isometry2, Isometry3, Quaternion, SMatrix, Translation, Unit, UnitComplex, UnitQuaternion,
};
use gauss_runtime::system::{AboutCenterOfMass, RigidBody};

use crate::{Bounded, Float};

/// Numbers and what is made of them: vectors, matrices, rotations, poses, [`RigidBody`], arrays and pairs.
pub trait Lift {
    /// Type of the numbers.
    type Number: Float;
    /// The same of bounded numbers.
    type Lifted;

    /// Each number turned into a bounded one by `bounded`.
    #[must_use]
    fn lift(&self, bounded: &impl Fn(Self::Number) -> Bounded<Self::Number>) -> Self::Lifted;
}

/// All numbers [exactly as they are](Bounded::exact).
#[must_use]
pub fn exact<X: Lift>(numbers: &X) -> X::Lifted {
    numbers.lift(&Bounded::exact)
}

/// All numbers as [rounded when they were stored](Bounded::rounded).
#[must_use]
pub fn rounded<X: Lift>(numbers: &X) -> X::Lifted {
    numbers.lift(&Bounded::rounded)
}

/// All numbers as [known up to `bound`](Bounded::measured).
#[must_use]
pub fn measured<X: Lift>(numbers: &X, bound: X::Number) -> X::Lifted {
    numbers.lift(&|number| Bounded::measured(number, bound))
}

macro_rules! numbers {
    ($($float:ty)+) => {$(
        impl Lift for $float {
            type Number = Self;
            type Lifted = Bounded<Self>;

            fn lift(&self, bounded: &impl Fn(Self) -> Bounded<Self>) -> Bounded<Self> {
                bounded(*self)
            }
        }
    )+};
}

numbers!(f32 f64);

impl<T: Float, const R: usize, const C: usize> Lift for SMatrix<T, R, C> {
    type Number = T;
    type Lifted = SMatrix<Bounded<T>, R, C>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        SMatrix::from(self.data.0.map(|column| column.map(bounded)))
    }
}

impl<T: Float> Lift for Quaternion<T> {
    type Number = T;
    type Lifted = Quaternion<Bounded<T>>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        Quaternion { coords: self.coords.lift(bounded) }
    }
}

impl<T: Float> Lift for UnitQuaternion<T> {
    type Number = T;
    type Lifted = UnitQuaternion<Bounded<T>>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        Unit::new_unchecked(self.as_ref().lift(bounded))
    }
}

impl<T: Float> Lift for UnitComplex<T> {
    type Number = T;
    type Lifted = UnitComplex<Bounded<T>>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        let (re, im) = (bounded(self.as_ref().re), bounded(self.as_ref().im));
        Unit::new_unchecked(gauss_runtime::nalgebra::Complex { re, im })
    }
}

impl<T: Float, const N: usize> Lift for Translation<T, N> {
    type Number = T;
    type Lifted = Translation<Bounded<T>, N>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        Translation { vector: self.vector.lift(bounded) }
    }
}

macro_rules! poses {
    ($($pose:ident)+) => {$(
        impl<T: Float> Lift for $pose<T> {
            type Number = T;
            type Lifted = $pose<Bounded<T>>;

            fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
                $pose { rotation: self.rotation.lift(bounded), translation: self.translation.lift(bounded) }
            }
        }
    )+};
}

poses!(Isometry2 Isometry3);

impl<T: Float> Lift for AboutCenterOfMass<T> {
    type Number = T;
    type Lifted = AboutCenterOfMass<Bounded<T>>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        AboutCenterOfMass(self.0.lift(bounded))
    }
}

impl<T: Float, I: Lift<Number = T>> Lift for RigidBody<T, I> {
    type Number = T;
    type Lifted = RigidBody<Bounded<T>, I::Lifted>;

    fn lift(&self, bounded: &impl Fn(T) -> Bounded<T>) -> Self::Lifted {
        RigidBody {
            mass: bounded(self.mass),
            center_of_mass: self.center_of_mass.lift(bounded),
            inertia: self.inertia.lift(bounded),
        }
    }
}

impl<X: Lift, const N: usize> Lift for [X; N] {
    type Number = X::Number;
    type Lifted = [X::Lifted; N];

    fn lift(&self, bounded: &impl Fn(X::Number) -> Bounded<X::Number>) -> Self::Lifted {
        core::array::from_fn(|i| self[i].lift(bounded))
    }
}

impl<A: Lift, B: Lift<Number = A::Number>> Lift for (A, B) {
    type Number = A::Number;
    type Lifted = (A::Lifted, B::Lifted);

    fn lift(&self, bounded: &impl Fn(A::Number) -> Bounded<A::Number>) -> Self::Lifted {
        (self.0.lift(bounded), self.1.lift(bounded))
    }
}

packs_of_one! {
    [T: Float] Bounded<T>;
}
