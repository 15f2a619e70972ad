//! Increments of a whole state as one flat vector, whatever the configuration consists of: for filters, smoothers,
//! regulators, optimisers.

use nalgebra::{SMatrix, SVector};

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::GaussSystem;

type Tangent<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// Increments (σ, δz) of a state (q, z): σ first, seen from the body, in the order of [`Configuration::Tangent`], then
/// those of the speeds. That is the order of [`Linearization`](crate::linearize::Linearization) and of the derivatives
/// of steps; `NameIndex`, which the derive generates, has the places by name: `x[CraftIndex::spin]`,
/// `x.rows_range(CraftIndex::w)`.
///
/// The length N of a vector is that of the state; another one does not compile.
///
/// All systems have these methods.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, angle),
    speeds(u: Vector3, w: Vector3, spin),
    kinematics(craft = twist(u, w), angle = spin),
    body(hull, pose = craft, mass = 10, inertia = 0.2),
    body(wheel, parent = hull, rotation = rotation_z(angle), mass = 0.5, inertia = [0.001, 0.001, along]),
)]
struct Craft { along: f64 }

# fn main() -> Result<(), ParameterError> {
let kernel = Craft { along: 0.002 }.kernel()?;
let (q, z) = (CraftState::default().q(), CraftState::default().z());

// Seven numbers move the configuration, seven the speeds.
let mut x = SVector::<f64, 14>::zeros();
x[CraftIndex::spin] = 2.0;
x.rows_range_mut(CraftIndex::craft).copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.3]);
let (there, speeds) = kernel.retract(&q, &z, &x);
let state = CraftState::of(&there, &speeds);
assert!(state.spin == 2.0 && (state.craft.rotation.angle() - 0.3).abs() < 1e-15);

let back: SVector<f64, 14> = kernel.difference((&q, &z), (&there, &speeds));
assert!((back - x).norm() < 1e-15);
# Ok(())
# }
```

```compile_fail,E0080
# use gauss_runtime::prelude::*;
# #[derive(GaussDynamics)]
# #[gauss(coordinates(angle), particle(mass = m, position = [sin(angle), 0, -cos(angle)]))]
# struct Pendulum { m: f64 }
# let kernel = Pendulum { m: 1.0 }.kernel().unwrap();
# let (q, z) = (SVector::from([0.0]), SVector::from([0.0]));
let _ = kernel.retract(&q, &z, &Vector3::zeros()); // a pendulum has one angle and one rate: two components
```
"##
)]
#[doc(alias = "boxplus")]
#[doc(alias = "boxminus")]
#[doc(alias = "error state")]
#[doc(alias = "kalman")]
pub trait Increments: GaussSystem {
    /// The state that an increment leads to: `q ∘ exp(σ)`, with its rotations at norm 1, and z + δz.
    #[must_use]
    #[inline]
    fn retract<const N: usize>(
        &self,
        q: &Self::Configuration,
        z: &Self::Speeds,
        increment: &SVector<Self::Scalar, N>,
    ) -> (Self::Configuration, Self::Speeds) {
        const { holds::<Self>(N) };
        let (sigma, change) = split::<Self, N>(increment);
        (q.advance(&sigma), z.add_scaled(Self::Scalar::one(), &change))
    }

    /// The shortest increment from one state to another: [`retract`](Self::retract) of it leads back there.
    #[must_use]
    #[inline]
    fn difference<const N: usize>(
        &self,
        (q, z): (&Self::Configuration, &Self::Speeds),
        to: (&Self::Configuration, &Self::Speeds),
    ) -> SVector<Self::Scalar, N> {
        const { holds::<Self>(N) };
        join::<Self, N>(&q.difference(to.0), &to.1.add_scaled(-Self::Scalar::one(), z))
    }

    /// Matrix by which small changes ε of an increment move the state that it leads to, seen from there: `retract(x +
    /// ε)` is `retract(retract(x), dexp(x) ε)` to first order. A filter that has moved its estimate by x carries its
    /// covariance by it, `J P Jᵀ`. Blocks of scalars and speeds are the identity.
    #[must_use]
    fn dexp<const N: usize>(&self, increment: &SVector<Self::Scalar, N>) -> SMatrix<Self::Scalar, N, N> {
        const { holds::<Self>(N) };
        let (zero, one) = (Self::Scalar::zero(), Self::Scalar::one());
        let (sigma, _) = split::<Self, N>(increment);
        let along = <Self::Configuration as Configuration>::dexp(&sigma);
        let mut matrix = SMatrix::from_fn(|row, column| if row == column { one } else { zero });
        for column in 0..Tangent::<Self>::DIM {
            let mut unit = Tangent::<Self>::zero();
            unit.set_component(column, one);
            let moved = along(&unit);
            (0..Tangent::<Self>::DIM).for_each(|row| matrix[(row, column)] = moved.component(row));
        }
        matrix
    }
}

impl<S: GaussSystem> Increments for S {}

const fn holds<S: GaussSystem + ?Sized>(length: usize) {
    assert!(
        length == Tangent::<S>::DIM + S::Speeds::DIM,
        "the flat vector of an increment has as many components as the increments of the configuration and the speeds \
         of this system together: those of `by_state`"
    );
}

#[inline]
fn split<S: GaussSystem + ?Sized, const N: usize>(flat: &SVector<S::Scalar, N>) -> (Tangent<S>, S::Speeds) {
    let (mut sigma, mut change) = (Tangent::<S>::zero(), S::Speeds::zero());
    (0..Tangent::<S>::DIM).for_each(|i| sigma.set_component(i, flat[i]));
    (0..S::Speeds::DIM).for_each(|i| change.set_component(i, flat[Tangent::<S>::DIM + i]));
    (sigma, change)
}

#[inline]
fn join<S: GaussSystem + ?Sized, const N: usize>(sigma: &Tangent<S>, change: &S::Speeds) -> SVector<S::Scalar, N> {
    let of_q = Tangent::<S>::DIM;
    SVector::from_fn(|i, _| if i < of_q { sigma.component(i) } else { change.component(i - of_q) })
}
