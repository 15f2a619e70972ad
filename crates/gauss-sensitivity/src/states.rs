//! States of one system in several scalars, number by number.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::State;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// The numbers that a configuration consists of.
pub(crate) type ComponentsOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Components;
/// The increments of a configuration.
pub(crate) type TangentOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// A state of a run, with the input that is held there where a controller samples.
pub(crate) struct StateWithInput<S: GaussSystem> {
    pub(crate) state: State<S>,
    pub(crate) input: Option<S::Input>,
}

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<S: GaussSystem> Clone for StateWithInput<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: GaussSystem> Copy for StateWithInput<S> {}

/// A vector with other numbers in the same places.
pub(crate) fn recast<T: Real, U: Real, V: VectorSpace<T>, W: VectorSpace<U>>(
    vector: &V,
    number: &mut impl FnMut(T) -> U,
) -> W {
    const { assert!(V::DIM == W::DIM, "a system has as many components in any scalar") }
    let mut result = W::zero();
    for i in 0..V::DIM {
        result.set_component(i, number(vector.component(i)));
    }
    result
}

/// A configuration in the scalar of a run, as a constant: what was measured, or where a run is to end.
///
/// ```
/// use gauss_runtime::dual::Dual;
/// use gauss_runtime::prelude::*;
///
/// let q = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
/// let same: UnitQuaternion<Dual<4>> = gauss_sensitivity::constant(&q);
/// assert_eq!(same.as_ref().coords[2], Dual::constant(q.as_ref().coords[2]));
/// ```
#[must_use]
pub fn constant<A: Configuration<Scalar = f64>, B: Configuration>(q: &A) -> B {
    B::from_components(&recast(&q.components(), &mut B::Scalar::from_f64))
}

/// A state of the same system in another scalar: the components of q, then z, number by number. The time is not asked
/// for, but given.
pub(crate) fn in_numbers<A: GaussSystem, B: GaussSystem>(
    state: &State<A>,
    t: B::Scalar,
    mut number: impl FnMut(A::Scalar) -> B::Scalar,
) -> State<B> {
    let components: ComponentsOf<B> = recast(&state.q.components(), &mut number);
    State { t, q: B::Configuration::from_components(&components), y: recast(&state.y, &mut number) }
}

/// The components of q, then those of z.
pub(crate) fn numbers_of<S: GaussSystem>(state: &State<S>) -> impl Iterator<Item = S::Scalar> {
    let (components, y) = (state.q.components(), state.y);
    let of_q = (0..ComponentsOf::<S>::DIM).map(move |i| components.component(i));
    of_q.chain((0..S::Speeds::DIM).map(move |i| y.component(i)))
}

/// A change of the components of q as an increment seen from the body.
pub(crate) fn increment<S: GaussSystem>(q: &S::Configuration, change: &[S::Scalar]) -> TangentOf<S> {
    let mut components = ComponentsOf::<S>::zero();
    for (i, &change) in change.iter().enumerate().take(ComponentsOf::<S>::DIM) {
        components.set_component(i, change);
    }
    q.tangent(&components)
}

/// Derivatives by the components of q as those by increments seen from the body.
pub(crate) fn by_increments<S: GaussSystem<Scalar = f64>>(q: &S::Configuration, by_components: &[f64]) -> Vec<f64> {
    (0..TangentOf::<S>::DIM)
        .map(|k| {
            let mut axis = TangentOf::<S>::zero();
            axis.set_component(k, 1.0);
            let rates = q.component_rates(&axis);
            by_components.iter().enumerate().map(|(i, by)| by * rates.component(i)).sum()
        })
        .collect()
}
