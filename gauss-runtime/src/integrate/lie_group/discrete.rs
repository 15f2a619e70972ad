//! Exact derivatives of a step, for filters and regulators in discrete time.

use core::fmt;

use nalgebra::{SMatrix, SVector};

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::lie_group::commutator_free::{CommutatorFree4, Path, STAGE_TIMES, halves};
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::checks::check_chart;
use crate::linearize::{Linearization, LinearizedSystem};
use crate::real::Real;
use crate::system::GaussSystem;

/// The end of a step with an input that is held, and its derivatives. D counts the components of (σ, δz), U those of
/// the input.
///
/// Ends of neighbouring steps are compared in the same coordinates as their starts, those of [`Linearization`]:
/// `q ∘ exp(σ)`, seen from the body (for a pose σ moves O along body axes, then turns about them), and `z + δz`. To
/// first order
///
/// `(σ₁, δz₁) = by_state · (σ₀, δz₀) + by_input · δinput + by_time · δt + by_step · δh`.
///
/// # Which derivatives for what
///
/// - A regulator or filter that acts *at every instant*, about a rest or a steady motion, is designed with
///   [`error_matrix`](crate::linearize::error_matrix): a Riccati equation in continuous time.
/// - What is *sampled* wants the derivatives of the step: a regulator in a computer that holds its input until the next
///   sample, a Kalman filter between two measurements, multiple shooting. `by_state` is its transition matrix,
///   `by_input` its input matrix. They belong to the very states that the steps make, so that iterations over many
///   steps (Gauss–Newton, smoothers) converge as they should.
/// - `1 + h F`, with F of [`error_matrix`](crate::linearize::error_matrix), agrees with them up to h². It will do where
///   a step turns the body by no more than some hundredths of a radian, and is wrong by ½ θ² where it turns it by θ.
///
/// A random input that is held over each step enters as `by_input · C · by_inputᵀ`, C its covariance: for white noise
/// of spectral density S that is S/h.
#[non_exhaustive]
pub struct DiscreteLinearization<S: GaussSystem, const D: usize, const U: usize> {
    /// The time at the end, t + h.
    pub t: S::Scalar,
    /// The configuration at the end.
    pub q: S::Configuration,
    /// The quasi-velocities at the end.
    pub z: S::Speeds,
    /// ∂(σ₁, z₁)/∂(σ₀, z₀).
    pub by_state: SMatrix<S::Scalar, D, D>,
    /// ∂(σ₁, z₁)/∂input.
    pub by_input: SMatrix<S::Scalar, D, U>,
    /// ∂(σ₁, z₁)/∂t, of steps of the same length that start later: 0 where the equations do not name the time.
    pub by_time: SVector<S::Scalar, D>,
    /// ∂(σ₁, z₁)/∂h.
    pub by_step: SVector<S::Scalar, D>,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
impl<S: GaussSystem, const D: usize, const U: usize> Clone for DiscreteLinearization<S, D, U> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: GaussSystem, const D: usize, const U: usize> Copy for DiscreteLinearization<S, D, U> {}

impl<S: GaussSystem, const D: usize, const U: usize> fmt::Debug for DiscreteLinearization<S, D, U> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DiscreteLinearization")
            .field("t", &self.t)
            .field("q", &self.q)
            .field("z", &self.z)
            .field("by_state", &self.by_state)
            .field("by_input", &self.by_input)
            .field("by_time", &self.by_time)
            .field("by_step", &self.by_step)
            .finish()
    }
}

impl<S: GaussSystem, const D: usize, const U: usize> DiscreteLinearization<S, D, U> {
    /// This step and the `next` one, which starts where it ends, as one: with the same input held over both.
    ///
    /// `by_step` is that of the next one: a run is made longer at its end.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            t: next.t,
            q: next.q,
            z: next.z,
            by_state: product(&next.by_state, &self.by_state),
            by_input: sum(&product(&next.by_state, &self.by_input), &next.by_input),
            by_time: sum(&product(&next.by_state, &self.by_time), &next.by_time),
            by_step: next.by_step,
        }
    }
}

impl CommutatorFree4 {
    /// One step of length h from (q, z) with the input held, and the exact derivatives of that step itself, as
    /// [`Fixed`](crate::integrate::Fixed) makes it. They agree with the derivatives of the motion up to the order of
    /// the method.
    ///
    /// Each exponential of the step passes on what its start moves by (by the adjoint) and what its velocity changes by
    /// (by the differential of exp), so nothing but the derivatives of the equations at the four stages is needed. It
    /// costs four calls of [`linearize`](LinearizedSystem::linearize) and products of matrices of that size; nothing is
    /// allocated.
    ///
    /// Of a scene with constraints these are the step and the derivatives *before* the state is brought back onto them,
    /// as in [`OneStep::step`](crate::integrate::step::one_step::OneStep::step): increments that violate the
    /// constraints are carried along as the equations have it. Make states consistent by
    /// [`project`](GaussSystem::project), and use increments that the constraints admit.
    ///
    /// # Errors
    /// Those of the step, and [`IntegrationErrorKind::NonFinite`] where a derivative is not finite.
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
```
use gauss_runtime::prelude::*;

/// A mass on a spring, pushed.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    input(push),
    drive(x = push),
    spring(along = x, stiffness = k),
)]
struct Spring {
    m: f64,
    k: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Spring { m: 1.0, k: 4.0 }.kernel()?;
let (x, v, push) = (SVector::from([0.3]), SVector::from([0.0]), SVector::from([1.0]));
let step = CommutatorFree4.step_linearized(&kernel, 0.0, &x, &v, &push, 0.01)?;
// The motion is a turn of (2x, v) by 2t about the rest at push/k; the step agrees with it up to h⁵.
let (sine, cosine) = 0.02_f64.sin_cos();
assert!((step.by_state - SMatrix::from([[cosine, -2.0 * sine], [0.5 * sine, cosine]])).amax() < 1e-9);
assert!((step.by_input - SMatrix::from([[0.25 * (1.0 - cosine), 0.5 * sine]])).amax() < 1e-9);
// Two steps as one: the transition over a longer time.
let next = CommutatorFree4.step_linearized(&kernel, step.t, &step.q, &step.z, &push, 0.01)?;
assert!((step.then(&next).by_state[(0, 0)] - 0.04_f64.cos()).abs() < 1e-9);
# Ok(())
# }
```
"##
    )]
    pub fn step_linearized<T: Real, S, const D: usize, const U: usize>(
        &self,
        system: &S,
        t: T,
        q: &S::Configuration,
        z: &S::Speeds,
        input: &S::Input,
        h: T,
    ) -> Result<DiscreteLinearization<S, D, U>, IntegrationErrorKind>
    where
        S: LinearizedSystem<Scalar = T, Linearization = Linearization<T, D, U>>,
    {
        let start = State { t, q: *q, y: *z };
        let mut stages = [system.linearize(t, q, z, input); 4];
        let first = split::<S, D>(&stages[0].rate);
        let Path { increments, end } = Path::new(&start, &first, h, |n, stage: &State<S>| {
            stages[n] = system.linearize(stage.t, &stage.q, &stage.y, input);
            split::<S, D>(&stages[n].rate)
        })?;
        check_chart(system, &start, &end)?;
        let mut factors = [Exponential::unset(); 5];
        for (factor, v) in factors.iter_mut().zip(&increments) {
            factor.set::<S::Configuration>(v);
        }
        let chain = Chain::<S, D, U> { h, stages: &stages, factors: &factors };

        let axes = Rows::from_fn(|i, k| if i == k { T::one() } else { T::zero() });
        let by_state = chain.block(&axes, |_, _| Rows::zero());
        let by_input = chain.block(&Rows::zero(), |stage, _| Rows::from_fn(|i, k| h * stage.by_input.data.0[k][i]));
        let by_times = chain.block(&Rows::zero(), |stage, time| {
            let later: [_; 2] = [stage.by_time.scale(h), stage.rate.add_scaled(time * h, &stage.by_time)];
            Rows::from_fn(|i, k| later[k].component(i))
        });
        let (by_state, by_input) = (by_state.matrix(), by_input.matrix());
        let [by_time, by_step] = by_times.matrix().data.0.map(SVector::from);
        let derivatives = finite(&by_state) && finite(&by_input) && finite(&by_time) && finite(&by_step);
        if !(derivatives && end.q.is_finite() && end.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok(DiscreteLinearization { t: end.t, q: end.q, z: end.y, by_state, by_input, by_time, by_step })
    }
}

/// (V, ż) as the integrators have them.
#[inline(always)]
fn split<S: GaussSystem, const D: usize>(rate: &SVector<S::Scalar, D>) -> Rates<S> {
    let (mut configuration, mut variables) = (TangentOf::<S>::zero(), S::Speeds::zero());
    let positions = <TangentOf<S> as VectorSpace<S::Scalar>>::DIM;
    for i in 0..D {
        let component = rate.component(i);
        if i < positions {
            configuration.set_component(i, component);
        } else {
            variables.set_component(i - positions, component);
        }
    }
    Rates { configuration, variables }
}

/// Small changes of the state in C directions at once: a row for each component of (σ, δz).
// Sums are made in place and row by row: rows fill the registers of the machine, and what closures make of whole
// matrices is copied about, which takes longer than the sums.
#[derive(Clone, Copy)]
struct Rows<T, const D: usize, const C: usize>([[T; C]; D]);

impl<T: Real, const D: usize, const C: usize> Rows<T, D, C> {
    #[inline(always)]
    fn zero() -> Self {
        Self([[T::zero(); C]; D])
    }

    #[inline(always)]
    fn from_fn(entry: impl Fn(usize, usize) -> T) -> Self {
        let mut rows = Self::zero();
        for i in 0..D {
            for k in 0..C {
                rows.0[i][k] = entry(i, k);
            }
        }
        rows
    }

    /// Adds `factor` times row `from` of `other` to row `to`.
    #[inline(always)]
    fn add_row(&mut self, to: usize, factor: T, other: &Self, from: usize) {
        for (sum, &entry) in self.0[to].iter_mut().zip(&other.0[from]) {
            *sum = factor.fma(entry, *sum);
        }
    }

    #[inline(always)]
    fn add(&mut self, factor: T, other: &Self) {
        for i in 0..D {
            self.add_row(i, factor, other, i);
        }
    }

    #[inline(always)]
    fn matrix(&self) -> SMatrix<T, D, C> {
        let mut columns = [[T::zero(); D]; C];
        for i in 0..D {
            for k in 0..C {
                columns[k][i] = self.0[i][k];
            }
        }
        SMatrix::from(columns)
    }
}

/// A factor exp(v) of a step. The product `q ∘ exp(σ) ∘ exp(v + δv)` is
/// `q ∘ exp(v) ∘ exp(carried · σ + differential · δv)` to first order, with `carried = exp(−ad_v) = 1 − dexp_v ad_v`
/// and `differential = dexp_v`.
#[derive(Clone, Copy)]
struct Exponential<T, const D: usize> {
    /// Rows and columns of both matrices that are used: the components of σ.
    positions: usize,
    carried: [[T; D]; D],
    differential: [[T; D]; D],
}

impl<T: Real, const D: usize> Exponential<T, D> {
    /// Room for both matrices.
    #[inline]
    fn unset() -> Self {
        Self { positions: 0, carried: [[T::zero(); D]; D], differential: [[T::zero(); D]; D] }
    }

    /// Both matrices of exp(v), column by column.
    #[inline]
    fn set<C: Configuration<Scalar = T>>(&mut self, v: &C::Tangent) {
        self.positions = C::Tangent::DIM;
        let dexp = C::dexp(v);
        for k in 0..C::Tangent::DIM {
            let mut axis = C::Tangent::zero();
            axis.set_component(k, T::one());
            let slope = dexp(&axis);
            let turned = axis.add_scaled(-T::one(), &dexp(&C::bracket(v, &axis)));
            for i in 0..C::Tangent::DIM {
                self.carried[i][k] = turned.component(i);
                self.differential[i][k] = slope.component(i);
            }
        }
    }

    /// Computes (σ, δz) behind the factor, when v and z change by `change`.
    #[inline(always)]
    fn behind<const C: usize>(&self, state: &Rows<T, D, C>, change: &Rows<T, D, C>) -> Rows<T, D, C> {
        let mut sum = Rows::zero();
        for i in 0..D {
            if i < self.positions {
                for k in 0..self.positions {
                    sum.add_row(i, self.carried[i][k], state, k);
                    sum.add_row(i, self.differential[i][k], change, k);
                }
            } else {
                sum.0[i] = state.0[i];
                sum.add_row(i, T::one(), change, i);
            }
        }
        sum
    }
}

/// The step as a chain of stages and exponentials, each of which passes small changes on.
struct Chain<'s, S: GaussSystem, const D: usize, const U: usize> {
    h: S::Scalar,
    stages: &'s [Linearization<S::Scalar, D, U>; 4],
    factors: &'s [Exponential<S::Scalar, D>; 5],
}

impl<T: Real, S: LinearizedSystem<Scalar = T>, const D: usize, const U: usize> Chain<'_, S, D, U> {
    /// Computes the change of the end when the start moves by (σ, δz), and h times the rates (V, ż) of each stage
    /// change by `forced` of the stage and its time over h beside their change with the state.
    #[inline]
    fn block<const C: usize>(
        &self,
        start: &Rows<T, D, C>,
        forced: impl Fn(&Linearization<T, D, U>, T) -> Rows<T, D, C>,
    ) -> Rows<T, D, C> {
        let change = |n: usize, state: &Rows<T, D, C>| {
            let (stage, (p, q)) = (&self.stages[n], STAGE_TIMES[n]);
            let mut sum = forced(stage, T::ratio(p, q));
            for i in 0..D {
                for k in (0..D).filter(|&k| S::STATE_PATTERN[i][k]) {
                    sum.add_row(i, self.h * stage.by_state.data.0[k][i], state, k);
                }
            }
            sum
        };
        let weighted = |terms: &[(T, &Rows<T, D, C>)]| {
            let mut sum = Rows::zero();
            for &(weight, term) in terms {
                sum.add(weight, term);
            }
            sum
        };
        let (one, half) = (T::one(), T::ratio(1, 2));
        let [to_second, to_third, to_fourth, before, after] = self.factors;
        let first = change(0, start);
        let early = to_second.behind(start, &weighted(&[(half, &first)]));
        let second = change(1, &early);
        let third = change(2, &to_third.behind(start, &weighted(&[(half, &second)])));
        let fourth = change(3, &to_fourth.behind(&early, &weighted(&[(one, &third), (-half, &first)])));
        let combined = |[a, b, c, d]: [T; 4]| weighted(&[(a, &first), (b, &second), (c, &third), (d, &fourth)]);
        let [inner, outer] = halves();
        after.behind(&before.behind(start, &combined(inner)), &combined(outer))
    }
}

#[inline(always)]
fn columns<T: Real, const R: usize, const C: usize>(column: impl Fn(usize) -> SVector<T, R>) -> SMatrix<T, R, C> {
    SMatrix::from(core::array::from_fn::<_, C, _>(|k| column(k).data.0[0]))
}

#[inline(always)]
fn column<T: Real, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>, k: usize) -> SVector<T, R> {
    SVector::from(matrix.data.0[k])
}

#[inline(always)]
fn product<T: Real, const R: usize, const K: usize, const C: usize>(
    left: &SMatrix<T, R, K>,
    right: &SMatrix<T, K, C>,
) -> SMatrix<T, R, C> {
    columns(|c| (0..K).fold(SVector::<T, R>::zero(), |sum, k| sum.add_scaled(right.data.0[c][k], &column(left, k))))
}

#[inline(always)]
fn sum<T: Real, const R: usize, const C: usize>(left: &SMatrix<T, R, C>, right: &SMatrix<T, R, C>) -> SMatrix<T, R, C> {
    columns(|k| column(left, k).add_scaled(T::one(), &column(right, k)))
}

#[inline(always)]
fn finite<T: Real, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>) -> bool {
    matrix.data.0.iter().flatten().all(|entry| entry.is_finite())
}
