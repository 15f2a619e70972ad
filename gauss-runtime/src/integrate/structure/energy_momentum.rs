//! An energy–momentum method on the group, for bodies in the left-invariant chart.
//!
//! With Z the mean of the velocities at both ends, `Z = ½(z₀ + z₁)`, the step is the screw motion
//! `q(s) = q₀ ∘ exp(s h Z)`, `0 ≤ s ≤ 1`, and momenta in space change by the mean of the wrench along it:
//!
//! `p₁ = Ad*(hZ) p₀ + h ∫ Ad*((1−s) h Z) f(q(s)) ds`, where `Ad*(σ)` takes the components of one momentum in space from
//! the axes and pole of q to those of q ∘ exp(σ).
//!
//! *Momentum*: whatever component of momentum in space the wrench leaves alone is kept, since means of wrenches that do
//! not have it do not have it. *Energy*: `T₁ − T₀ = Z·(p₁ − p₀)`, A being symmetric and constant; Z is not moved by
//! Ad(hZ), so the free part contributes nothing, and the rest is `∫ hZ·f(q(s)) ds = V(q₀) − V(q₁)`: the mean of the
//! force is a discrete gradient.
//!
//! With the Cayley map instead of exp and forces at fixed places this is the method of Simo & Wong (Int. J. Numer.
//! Meth. Eng. 31, 1991) and Lewis & Simo (J. Nonlinear Sci. 4, 1994); discrete gradients: O. Gonzalez (J. Nonlinear
//! Sci. 6, 1996), as means: McLachlan, Quispel & Robidoux (Phil. Trans. R. Soc. A 357, 1999). With exp the proof is the
//! same on every group.

use nalgebra::{Isometry2, Isometry3, SVector, UnitQuaternion};

use crate::chart::Chart;
use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::iteration::{Convergence, relative_change, worst};
use crate::integrate::step::one_step::{IncrementStep, OneStep, Properties, Step, check_contacts};
use crate::lie::se3::{join, split};
use crate::lie::{coefficients, se2, se3, so3};
use crate::real::Real;
use crate::system::GaussSystem;
use crate::triple::{Triple, add, cross, dot, quaternion, rotate_back, scaled, sub, triple};

/// A group that acts on momenta: what the same momentum in space is, seen from a body that has moved.
///
/// Momenta are dual to body twists: Γ_O, (Q, Γ_O), or (Q₁, Q₂, Γ_O), body axes, pole O.
pub trait CoadjointAction: Configuration {
    /// Computes the change of the components of a momentum in space when they are taken in q ∘ exp(σ) instead of q: the
    /// change itself, so that its rounding is relative to it.
    fn coadjoint_change(momentum: &Self::Tangent, sigma: &Self::Tangent) -> Self::Tangent;

    /// The same per unit of time for a body with the twist z: ad*_z p, which is ṗ without forces.
    fn coadjoint_rate(momentum: &Self::Tangent, z: &Self::Tangent) -> Self::Tangent;

    /// The square of the angle by which an increment turns, lane by lane.
    fn square_of_angle(sigma: &Self::Tangent) -> Self::Scalar;
}

/// `Rᵀv − v`.
#[inline(always)]
fn turned_back<T: Real>([x, y, z, w]: [T; 4], v: Triple<T>) -> Triple<T> {
    let axis = [x, y, z];
    let twice = cross(axis, v);
    let twice = add(twice, twice);
    sub(cross(axis, twice), scaled(w, twice))
}

impl<T: Real> CoadjointAction for UnitQuaternion<T> {
    #[inline]
    fn coadjoint_change(momentum: &SVector<T, 3>, sigma: &SVector<T, 3>) -> SVector<T, 3> {
        SVector::from(turned_back(quaternion(&so3::exp(sigma)), triple(momentum)))
    }

    #[inline]
    fn coadjoint_rate(momentum: &SVector<T, 3>, z: &SVector<T, 3>) -> SVector<T, 3> {
        SVector::from(cross(triple(momentum), triple(z)))
    }

    #[inline]
    fn square_of_angle(sigma: &SVector<T, 3>) -> T {
        dot(triple(sigma), triple(sigma))
    }
}

impl<T: Real> CoadjointAction for Isometry3<T> {
    #[inline]
    fn coadjoint_change(momentum: &SVector<T, 6>, sigma: &SVector<T, 6>) -> SVector<T, 6> {
        let (moved, (linear, angular)) = (se3::exp(sigma), split(momentum));
        let rotation = quaternion(&moved.rotation);
        // Γ_Ω = R Γ_O + b × Q̂ in space: the lever of Q grows by the displacement.
        let lever = rotate_back(rotation, cross(triple(&moved.translation.vector), linear));
        join(turned_back(rotation, linear), sub(turned_back(rotation, angular), lever))
    }

    #[inline]
    fn coadjoint_rate(momentum: &SVector<T, 6>, z: &SVector<T, 6>) -> SVector<T, 6> {
        let ((linear, angular), (u, omega)) = (split(momentum), split(z));
        join(cross(linear, omega), add(cross(angular, omega), cross(linear, u)))
    }

    #[inline]
    fn square_of_angle(sigma: &SVector<T, 6>) -> T {
        let (_, angular) = split(sigma);
        dot(angular, angular)
    }
}

impl<T: Real> CoadjointAction for Isometry2<T> {
    #[inline]
    fn coadjoint_change(momentum: &SVector<T, 3>, sigma: &SVector<T, 3>) -> SVector<T, 3> {
        let ([q1, q2, _], angle) = (momentum.data.0[0], sigma.data.0[0][2]);
        let [d1, d2] = se2::exp(sigma).translation.vector.data.0[0];
        // cos θ − 1 without cancellation.
        let ((half, _), sine) = ((T::ratio(1, 2) * angle).sin_cos(), angle.sin_cos().0);
        let less = -(half * half + half * half);
        SVector::from([less * q1 + sine * q2, less * q2 - sine * q1, d2 * q1 - d1 * q2])
    }

    #[inline]
    fn coadjoint_rate(momentum: &SVector<T, 3>, z: &SVector<T, 3>) -> SVector<T, 3> {
        let ([q1, q2, _], [u1, u2, omega]) = (momentum.data.0[0], z.data.0[0]);
        SVector::from([q2 * omega, -q1 * omega, q1 * u2 - q2 * u1])
    }

    #[inline]
    fn square_of_angle(sigma: &SVector<T, 3>) -> T {
        let angle = sigma.data.0[0][2];
        angle * angle
    }
}

/// The energy–momentum method of order 2 for one body in the left-invariant chart: held at a point, free or in the
/// plane, added mass and all. Where forces have a potential it keeps the energy, and with it the momenta of the scene's
/// symmetries. The mean of the force is taken at N points of each step:
///
/// - [`new`](Self::new), N = 2: exactly for no forces and for weight and buoyancy, whatever their points of attack. The
///   two points are those of Gauss, moved so that what turns with the body is integrated exactly. For other potentials
///   momenta are kept to rounding all the same, and energy to order h⁴, without drift.
/// - [`with_points`](Self::with_points): Gauss' rule, whose error in energy is of order h^(2N): from four to six points
///   on it is below rounding for steps that turn the body by half a radian.
///
/// Symmetric; [`Composed`](crate::integrate::Composed) raises the order, and keeps the same integrals. Not symplectic.
/// Forces of any other kind are taken at the mean velocity of the step: their work over the step is that of their mean.
/// Run it in the momentum form, or by [`Compensated`](crate::integrate::Compensated), where every digit of a long run
/// counts.
///
/// z₁ is found by fixed-point iteration down to rounding; beyond a turn of about 2 rad in a step, less for slender
/// bodies, that ends with [`IntegrationErrorKind::NotConverged`]. Other charts, where momenta are not those of the
/// group, are refused when the program is compiled.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::integrate::{EnergyMomentum, Fixed};
use gauss_runtime::prelude::*;

/// A heavy top that turns about O.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct Top {
    #[gauss(mass)]           mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)]        inertia: Vector3<f64>,
    #[gauss(gravity)]        g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.1, 0.4), inertia: Vector3::new(0.2, 0.25, 0.05), g: 9.81 };
let kernel = top.kernel()?;
let (q, z) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.0, 0.0, 20.0));
let (energy, vertical) = (kernel.energy(0.0, &q, &z), kernel.space_momentum(0.0, &q, &z)[5]);
let run = Simulation::new(&kernel).momentum_form().control(Fixed::by(EnergyMomentum::new(), 0.01));
let end = run.run_to_end(q, z, 0.0..100.0)?;
assert!((kernel.energy(end.t, &end.q, &end.z) / energy - 1.0).abs() < 1e-12);
assert!((kernel.space_momentum(end.t, &end.q, &end.z)[5] / vertical - 1.0).abs() < 1e-12);
# Ok(())
# }
```
"##
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyMomentum<T, const N: usize = 2> {
    /// `s − ½`.
    offsets: [T; N],
    weights: [T; N],
    /// Whether the points move so that what turns with the body is integrated exactly.
    fitted: bool,
}

impl<T: Real> EnergyMomentum<T> {
    /// Exact with weight and buoyancy.
    #[must_use]
    pub fn new() -> Self {
        let (half, one) = (T::ratio(1, 2), T::one());
        Self { offsets: [-one, one], weights: [half, half], fitted: true }
    }
}

impl<T: Real> Default for EnergyMomentum<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const N: usize> EnergyMomentum<T, N> {
    /// Gauss' rule with N points, at least two.
    #[must_use]
    pub fn with_points() -> Self {
        const { assert!(N >= 2, "a mean over a step is taken at two points or more") };
        let (zero, one, half) = (T::zero(), T::one(), T::ratio(1, 2));
        let (mut offsets, mut weights) = ([zero; N], [zero; N]);
        for i in 0..N.div_ceil(2) {
            let middle = 2 * i + 1 == N;
            let mut x = if middle {
                zero
            } else {
                T::from_f64(core::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5)).sin_cos().1
            };
            // From three digits to all in double precision by three Newton steps, in double-double numbers by four.
            let mut slope = legendre(N, x).1;
            for _ in 0..5 {
                if !middle {
                    x -= legendre(N, x).0 / slope;
                }
                slope = legendre(N, x).1;
            }
            let weight = ((one - x * x) * slope * slope).recip();
            (offsets[i], offsets[N - 1 - i]) = (-half * x, half * x);
            (weights[i], weights[N - 1 - i]) = (weight, weight);
        }
        Self { offsets, weights, fitted: false }
    }

    /// The factor of the offsets for a step that turns the body by the angle whose square is given.
    ///
    /// Two points at ½ ± c integrate 1, s and, with `cos θc = sin(θ/2)/(θ/2)`, what turns by θ: for small angles Gauss'
    /// c = 1/√12.
    #[inline(always)]
    fn spread(&self, square: T) -> T {
        if !self.fitted {
            return T::one();
        }
        let (quarter, half) = (T::ratio(1, 4), T::ratio(1, 2));
        // 1 − sin x/x = x² (x − sin x)/x³ with x = θ/2; sin²(θc/2) is half of it.
        let slope = (half * coefficients::cubic(quarter * square)).sqrt();
        let sine = (quarter * square).sqrt() * slope;
        let smallest = T::from_f64(f64::MIN_POSITIVE);
        slope * T::select_lt(smallest, sine, sine.asin() / sine, T::one())
    }
}

/// Legendre's polynomial of degree n and its derivative, inside (−1, 1).
fn legendre<T: Real>(n: usize, x: T) -> (T, T) {
    let (mut before, mut value) = (T::one(), x);
    for k in 2..=n as i64 {
        (before, value) = (value, (T::ratio(2 * k - 1, k) * x) * value - T::ratio(k - 1, k) * before);
    }
    (value, T::from_f64(n as f64) * (before - x * value) / (T::one() - x * x))
}

impl<S: GaussSystem, const N: usize> IncrementStep<S> for EnergyMomentum<S::Scalar, N>
where
    S::Configuration: CoadjointAction<Tangent = S::Speeds>,
{
    #[inline]
    fn increment<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        _: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Rates<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        const { assert!(matches!(S::CHART, Chart::LeftInvariant), "`EnergyMomentum` needs the left-invariant chart") };
        let system = problem.system();
        let (one, half) = (S::Scalar::one(), S::Scalar::ratio(1, 2));
        let State { t, q, y } = state;
        let (p, z) = (problem.momentum(*t, q, y), problem.speeds(*t, q, y));

        // A is constant in this chart: it takes changes of z to changes of p.
        let mut faster = S::Speeds::zero();
        let mut progress = Convergence::new();
        let (sigma, change) = loop {
            let mean = z.add_scaled(half, &faster);
            let sigma = mean.scale(h);
            let spread = self.spread(S::Configuration::square_of_angle(&sigma));
            let mut change = S::Configuration::coadjoint_change(&p, &sigma);
            for (&offset, &weight) in self.offsets.iter().zip(&self.weights) {
                let (passed, left) = (half + offset * spread, half - offset * spread);
                let at = q.retract(&sigma.scale(passed));
                let force = force(problem, passed.fma(h, *t), &at, &mean);
                let carried = S::Configuration::coadjoint_change(&force, &sigma.scale(left));
                change = change.add_scaled(h * weight, &force.add_scaled(one, &carried));
            }
            let next = system.velocity(*t, q, &change);
            let residual = distance::<S>(&faster, &next, z.max_norm().max(next.max_norm()));
            faster = next;
            if progress.finished::<S::Scalar>(residual)? {
                break (z.add_scaled(half, &faster).scale(h), change);
            }
        };
        let increment = Rates { configuration: sigma, variables: problem.of_momentum(*t, q, &change) };
        check_increment::<S>(&increment)?;
        Ok(increment)
    }
}

impl<S: GaussSystem, const N: usize> OneStep<S> for EnergyMomentum<S::Scalar, N>
where
    S::Configuration: CoadjointAction<Tangent = S::Speeds>,
{
    /// The energy: of potentials whose mean the points take exactly.
    fn properties(&self) -> Properties {
        Properties { symmetric: true, keeps_momentum: true, keeps_energy: true, ..Properties::of_order(2) }
    }

    /// Refuses steps whose iteration does not converge ([`IntegrationErrorKind::NotConverged`]), that turn by more than
    /// π ([`IntegrationErrorKind::IncrementTooLarge`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        let increment = self.increment(problem, state, rates, h)?;
        let end: State<S> = State {
            t: state.t + h,
            q: state.q.advance(&increment.configuration),
            y: state.y.add_scaled(S::Scalar::one(), &increment.variables),
        };
        check_chart(problem.system(), state, &end)?;
        if !(end.q.is_finite() && end.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        let error = Rates { configuration: S::Speeds::zero(), variables: S::Speeds::zero() };
        Ok(Step { state: end, error, rates: None })
    }
}

/// The loads on a body with the velocity z, in body axes: ṗ without the term of the rotating axes.
#[inline(always)]
fn force<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    t: S::Scalar,
    q: &S::Configuration,
    z: &S::Speeds,
) -> S::Speeds
where
    S::Configuration: CoadjointAction<Tangent = S::Speeds>,
{
    let p = problem.system().momentum(t, q, z);
    let input = problem.input(t, q, z);
    let rate = problem.system().momentum_rate(t, q, &p, &input);
    rate.add_scaled(-S::Scalar::one(), &S::Configuration::coadjoint_rate(&p, z))
}

fn distance<S: GaussSystem>(old: &S::Speeds, new: &S::Speeds, size: f64) -> f64 {
    (0..S::Speeds::DIM).fold(0.0, |result, i| worst(result, relative_change(old.component(i), new.component(i), size)))
}

#[cfg(test)]
#[path = "energy_momentum_tests.rs"]
mod tests;
