//! Gauss–Legendre collocation on the group: implicit, symmetric, of orders 2, 4 and 6.
//!
//! The equations are written in the chart `q = m ∘ exp(σ)` about the middle m of the step, `σ̇ = dexp_inv(σ, V)`, and
//! solved by Gauss' method with s stages. The end of the step is `m ∘ exp(σ₁)`, its start `m ∘ exp(−σ₁)`: which m that
//! is, is found together with the stages. About the start instead of the middle the method would not be symmetric,
//! because a step back uses another chart than the step there (Zanna, Engø & Munthe-Kaas, *Adjoint and selfadjoint
//! Lie-group methods*, BIT 41, 2001). About the middle both use the same one, where Gauss' method itself is symmetric.
//! The order is 2s, that of Gauss' method in any one chart.
//!
//! The stages are `σ_i = Σ_j ω_ij F_j` with `F_j = h b_j σ̇_j`, and `σ₁ = ½ΣF_j`; those of y likewise about the middle
//! `y₀ + ½ΣG_j`, `G_j = h b_j ẏ_j`. Here `ω_ij = a_ij/b_j − ½`, which is skew for Gauss' methods, and that is why they
//! keep quadratic integrals. Skew numbers stay skew when they are rounded, so coefficients that are not exact cost
//! nothing, and weights are exact fractions: no error is the same in every step, and so none grows in proportion to
//! time (Hairer, McLachlan & Razakarivony, *Achieving Brouwer's law with implicit Runge–Kutta methods*, BIT 48, 2008).

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::iteration::{Convergence, relative_change, worst};
use crate::integrate::step::one_step::{IncrementStep, OneStep, Properties, Step, check_contacts};
use crate::real::Real;
use crate::system::GaussSystem;

/// Gauss' method of S stages and order 2S on the group: 1, 2 or 3 stages.
///
/// Symmetric. In the momentum form it keeps every quadratic integral of equations for the momenta alone up to rounding:
/// T and |π|² of the free body, T, p², p·π and the integrals of Clebsch and Steklov of a body in fluid. It is not
/// symplectic on the cotangent bundle, so energies with a potential are kept to the error of the method alone; where
/// the motion is reversible, as a top's, that does not drift, elsewhere (a body in a fluid with weight) it does.
///
/// The stages are found by fixed-point iteration down to rounding. Where the equations change little in a step that
/// takes 10 to 15 sweeps of S evaluations. It takes more the longer the step, and beyond a step times the steepest
/// derivative of the equations (for a spring, its angular frequency) of about 1, 1.8 and 2.8 with one, two and three
/// stages the step ends with
/// [`IntegrationErrorKind::NotConverged`]: a shorter one will do.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::integrate::{Composed, Composition, Fixed};
use gauss_runtime::prelude::*;

/// A body that turns freely about its centre of mass.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct Satellite {
    #[gauss(mass)]    mass: f64,
    #[gauss(inertia)] inertia: Vector3<f64>,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Satellite { mass: 1.0, inertia: Vector3::new(0.5, 0.85, 1.0) }.kernel()?;
let (q, z) = (UnitQuaternion::identity(), Vector3::new(0.01, 2.0, 0.3));
let energy = kernel.energy(0.0, &q, &z);
let end = Simulation::new(&kernel)
    .momentum_form()
    .control(Fixed::by(Collocation::order_4(), 0.1))
    .run_to_end(q, z, 0.0..1000.0)?;
assert!((kernel.energy(end.t, &end.q, &end.z) / energy - 1.0).abs() < 1e-13);

// The same by compositions of the implicit midpoint rule, to order 8.
let composed = Composed::new(&Composition::KAHAN_LI_8, Collocation::midpoint());
let end = Simulation::new(&kernel).momentum_form().control(Fixed::by(composed, 0.5)).run_to_end(q, z, 0.0..1000.0)?;
assert!((kernel.energy(end.t, &end.q, &end.z) / energy - 1.0).abs() < 1e-13);
# Ok(())
# }
```
"##
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collocation<T, const S: usize> {
    /// `a_ij/b_j − ½`, skew.
    omega: [[T; S]; S],
    /// `b_j` times the denominator.
    numerators: [T; S],
    denominator: T,
    /// `c_i − ½`.
    times: [T; S],
}

impl<T: Real> Collocation<T, 1> {
    /// The implicit midpoint rule `q ∘ exp(hV)`, V at the middle: order 2.
    #[must_use]
    pub fn midpoint() -> Self {
        Self { omega: [[T::zero()]], numerators: [T::one()], denominator: T::one(), times: [T::zero()] }
    }
}

impl<T: Real> Collocation<T, 2> {
    /// Two stages, order 4.
    #[must_use]
    pub fn order_4() -> Self {
        let (zero, one) = (T::zero(), T::one());
        let root = T::from_f64(3.0).sqrt();
        let (omega, time) = (root / T::from_f64(3.0), root / T::from_f64(6.0));
        Self {
            omega: [[zero, -omega], [omega, zero]],
            numerators: [one, one],
            denominator: T::from_f64(2.0),
            times: [-time, time],
        }
    }
}

impl<T: Real> Collocation<T, 3> {
    /// Three stages, order 6.
    #[must_use]
    pub fn order_6() -> Self {
        let zero = T::zero();
        let root = T::from_f64(15.0).sqrt();
        let near = T::from_f64(3.0) * root / T::from_f64(20.0);
        let far = T::from_f64(3.0) * root / T::from_f64(25.0);
        let time = root / T::from_f64(10.0);
        Self {
            omega: [[zero, -near, -far], [near, zero, -near], [far, near, zero]],
            numerators: [5.0, 8.0, 5.0].map(T::from_f64),
            denominator: T::from_f64(18.0),
            times: [-time, zero, time],
        }
    }
}

impl<T: Real, const S: usize> Collocation<T, S> {
    /// `h b_j K`, with a rounding that changes from step to step.
    #[inline(always)]
    fn weighted<Sys: GaussSystem<Scalar = T>>(&self, j: usize, h: T, rates: &Rates<Sys>) -> Rates<Sys> {
        let by = |x: T| h * x * self.numerators[j] / self.denominator;
        let mut result = *rates;
        for i in 0..TangentOf::<Sys>::DIM {
            result.configuration.set_component(i, by(rates.configuration.component(i)));
        }
        for i in 0..Sys::Speeds::DIM {
            result.variables.set_component(i, by(rates.variables.component(i)));
        }
        result
    }
}

impl<Sys: GaussSystem, const S: usize> OneStep<Sys> for Collocation<Sys::Scalar, S> {
    fn properties(&self) -> Properties {
        Properties { symmetric: true, ..Properties::of_order(2 * S as u32) }
    }

    /// Refuses steps whose iteration does not converge ([`IntegrationErrorKind::NotConverged`]), that turn by more than
    /// π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of the coordinates
    /// ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<Step<Sys>, IntegrationErrorKind> {
        let one = Sys::Scalar::one();
        let sum = self.increment(problem, state, rates, h)?;
        let end: State<Sys> = State {
            t: state.t + h,
            q: state.q.advance(&sum.configuration),
            y: state.y.add_scaled(one, &sum.variables),
        };
        check_chart(problem.system(), state, &end)?;
        if !(end.q.is_finite() && end.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok(Step { state: end, error: null(), rates: None })
    }
}

impl<Sys: GaussSystem, const S: usize> IncrementStep<Sys> for Collocation<Sys::Scalar, S> {
    #[inline]
    fn increment<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<Rates<Sys>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let one = Sys::Scalar::one();
        let half = Sys::Scalar::ratio(1, 2);
        let middle_time = h.fma(half, state.t);
        let mut parts: [Rates<Sys>; S] = core::array::from_fn(|j| self.weighted(j, h, rates));
        let mut sum = total(&parts);

        let mut progress = Convergence::new();
        loop {
            let middle = state.q.retract(&sum.configuration.scale(half));
            let y = state.y.add_scaled(half, &sum.variables);
            let mut residual = 0.0_f64;
            // Each stage with the latest values of those before it: fewer sweeps, and the result is the same up to
            // rounding.
            for i in 0..S {
                let mut sigma: Rates<Sys> = null();
                for j in 0..S {
                    if j != i {
                        sigma.configuration = sigma.configuration.add_scaled(self.omega[i][j], &parts[j].configuration);
                        sigma.variables = sigma.variables.add_scaled(self.omega[i][j], &parts[j].variables);
                    }
                }
                let stage: State<Sys> = State {
                    t: self.times[i].fma(h, middle_time),
                    q: middle.retract(&sigma.configuration),
                    y: y.add_scaled(one, &sigma.variables),
                };
                let found = problem.rates(&stage);
                let found = Rates {
                    configuration: Sys::Configuration::dexp_inv(&sigma.configuration, &found.configuration),
                    variables: found.variables,
                };
                let next = self.weighted(i, h, &found);
                residual = worst(residual, change(state, &sum, &parts[i], &next));
                parts[i] = next;
            }
            sum = total(&parts);
            if progress.finished::<Sys::Scalar>(residual)? {
                break;
            }
        }
        check_increment::<Sys>(&sum)?;
        Ok(sum)
    }
}

fn null<S: GaussSystem>() -> Rates<S> {
    Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() }
}

#[inline(always)]
fn total<S: GaussSystem, const N: usize>(parts: &[Rates<S>; N]) -> Rates<S> {
    let mut sum = parts[0];
    for part in &parts[1..] {
        sum.configuration = sum.configuration.add_scaled(S::Scalar::one(), &part.configuration);
        sum.variables = sum.variables.add_scaled(S::Scalar::one(), &part.variables);
    }
    sum
}

/// Change of a part of the increment, relative to the state, its increment and that part: angles to 1 rad, translations
/// to the distance from the origin, variables to the largest of them. At rest in the origin there is nothing but the
/// part that comes.
fn change<S: GaussSystem>(state: &State<S>, sum: &Rates<S>, old: &Rates<S>, new: &Rates<S>) -> f64 {
    let mut result = 0.0_f64;
    let mut see = |old, new, size| result = worst(result, relative_change(old, new, size));
    let moved = sum.configuration.max_norm().max(new.configuration.max_norm());
    for i in 0..TangentOf::<S>::DIM {
        see(old.configuration.component(i), new.configuration.component(i), state.q.magnitude(i).max(moved));
    }
    let size = state.y.max_norm().max(sum.variables.max_norm()).max(new.variables.max_norm());
    for i in 0..S::Speeds::DIM {
        see(old.variables.component(i), new.variables.component(i), size);
    }
    result
}
