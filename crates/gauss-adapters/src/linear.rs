//! Derivatives of the equations of any system at dual numbers.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::linearize::Linearization;
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;
use num_dual::Dual64;

use crate::DualNumber;

type Number = DualNumber<Dual64>;

/// (V, ż) with their derivatives by state, time and input, as
/// [`linearize`](gauss_runtime::linearize::LinearizedSystem::linearize) of kernels gives them, of any system: one with
/// contacts in given modes (`InMode` of `gauss-contact`), one written by hand. D counts the components of (σ, δz), U
/// those of the input; another number of either does not compile. Derivatives that the arguments carry are dropped.
///
/// Under constraints, closed contacts among them, derivatives are those of the accelerations that satisfy them;
/// deviations that violate constraints do not go away. A kernel with contacts, whose equations have no contact forces,
/// is refused by the compiler:
///
/// ```compile_fail,E0080
/// # use gauss_adapters::{DualNumber, linearize};
/// # use gauss_runtime::prelude::*;
/// # use gauss_runtime::linearize::Linearization;
/// # use num_dual::Dual64;
/// # #[derive(GaussDynamics)]
/// # #[gauss(coordinates(x), particle(mass = m, position = [0, 0, x]), contact(floor, gap = x), input(u), drive(x = u))]
/// # struct Ball<T> { m: T }
/// let number = |x: f64| DualNumber(Dual64::from_re(x));
/// let kernel = Ball { m: number(1.0) }.kernel().unwrap();
/// let (q, z, u) = ([number(1.0)].into(), [number(0.0)].into(), [number(0.0)].into());
/// let _: Linearization<f64, 2, 1> = linearize(&kernel, 0.0, &q, &z, &u);
/// ```
pub fn linearize<S, const D: usize, const U: usize>(
    system: &S,
    t: f64,
    q: &S::Configuration,
    z: &S::Speeds,
    input: &S::Input,
) -> Linearization<f64, D, U>
where
    S: GaussSystem<Scalar = Number>,
    S::Input: VectorSpace<Number>,
{
    const {
        assert!(D == <TangentOf<S> as VectorSpace<Number>>::DIM + S::Speeds::DIM, "D counts increments and speeds");
        assert!(U == <S::Input as VectorSpace<Number>>::DIM, "U counts the components of the input");
        assert!(
            !S::HAS_CONTACTS,
            "the scene has contacts, whose forces its equations do not have: linearize `InMode::new(&kernel, &modes)` \
             of gauss-contact, with `&[]` where all gaps are open"
        );
    }
    let (components, one) = (TangentOf::<S>::DIM, DualNumber(Dual64::new(0.0, 1.0)));
    let q = S::Configuration::from_components(&plain(&q.components()));
    let (z, input) = (plain(z), plain(input));
    let rates =
        |t: Number, q: &S::Configuration, z: &S::Speeds, input: &S::Input| -> SVector<Number, D> {
            let (velocity, acceleration) =
                (system.configuration_rates(t, q, z, input), system.acceleration(t, q, z, input));
            SVector::from_fn(|i, _| {
                if i < components { velocity.component(i) } else { acceleration.component(i - components) }
            })
        };
    let now = Number::from_f64(t);
    let here = rates(now, &q, &z, &input);
    let mut by_state = SMatrix::<f64, D, D>::zeros();
    for k in 0..D {
        let changed = if k < components {
            rates(now, &q.retract(&with(TangentOf::<S>::zero(), k, one)), &z, &input)
        } else {
            rates(now, &q, &with(z, k - components, one), &input)
        };
        by_state.set_column(k, &changed.map(|x| x.eps));
    }
    let by_time = rates(now + one, &q, &z, &input).map(|x| x.eps);
    let mut by_input = SMatrix::<f64, D, U>::zeros();
    for k in 0..U {
        by_input.set_column(k, &rates(now, &q, &z, &with(input, k, one)).map(|x| x.eps));
    }
    Linearization::new(here.map(|x| x.re), by_state, by_time, by_input)
}

/// The values alone.
fn plain<V: VectorSpace<Number>>(vector: &V) -> V {
    (0..V::DIM).fold(V::zero(), |sum, i| with(sum, i, Number::from_f64(vector.component(i).re)))
}

/// A vector with one component increased.
fn with<V: VectorSpace<Number>>(mut vector: V, i: usize, by: Number) -> V {
    vector.set_component(i, vector.component(i) + by);
    vector
}
