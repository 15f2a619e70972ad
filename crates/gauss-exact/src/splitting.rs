//! Splitting methods for one body: free motion between kicks.
//!
//! The kinetic energy alone moves a body as if nothing acted, which is integrable; the potential alone changes momenta
//! by the force at a fixed place. Both are done exactly (or to order 10), in turn, and how fast the body spins costs
//! nothing (McLachlan 1993; Celledoni, Fassò, Säfström & Zanna 2008).

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::{
    IntegrationErrorKind, OneStep, Problem, Properties, Rates, RunPart, State, Step, check_contacts,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;
use nalgebra::Matrix3;

use crate::configuration::{BodyConfiguration, DriftingBody, SplittingError};
use crate::free_flow::FreeFlow;
use crate::inertia::{FreeMotion, PrincipalAxes};
use crate::moser_veselov::MoserVeselov;
use crate::scheme::Scheme;

/// A splitting method for one body, for [`Fixed::by`](gauss_runtime::integrate::Fixed::by).
///
/// For kernels whose quasi-velocities are the body's in its own axes (`chart = left_invariant`), about a fixed point,
/// or free with O in the centre of mass; inertia with products too. Forces may depend on time and configuration, not on
/// velocities: an input is called with velocities zero. Symmetric; with exact free motion symplectic; momenta that
/// belong to a symmetry of the forces, such as that about gravity, are kept up to rounding, and so is the energy of a
/// free body.
///
/// A step evaluates the forces as many times as its [`Scheme`] gives, and once more. It belongs to the kernel that it
/// was made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splitting<T, M> {
    body: DriftingBody<T, M>,
    scheme: Scheme,
}

impl Splitting<f64, FreeFlow> {
    /// Over the exact free motion.
    ///
    /// # Errors
    /// When the system is not such a body.
    pub fn exact<S>(system: &S, scheme: Scheme) -> Result<Self, SplittingError>
    where
        S: GaussSystem<Scalar = f64, Input: Default>,
        S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
    {
        Self::with(system, scheme, FreeFlow::new)
    }
}

impl<T: Real> Splitting<T, MoserVeselov<T>> {
    /// Over the discrete Moser–Veselov method of order 10: cheaper, no elementary functions, for steps that turn the
    /// body by less than about 1 rad.
    ///
    /// # Errors
    /// When the system is not such a body.
    pub fn discrete<S>(system: &S, scheme: Scheme) -> Result<Self, SplittingError>
    where
        S: GaussSystem<Scalar = T, Input: Default>,
        S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
    {
        Self::with(system, scheme, MoserVeselov::new)
    }
}

impl<T: Real, M: FreeMotion<T>> Splitting<T, M> {
    /// Over any free motion, made from the principal moments.
    ///
    /// # Errors
    /// When the system is not such a body.
    pub fn with<S>(system: &S, scheme: Scheme, motion: impl FnOnce([T; 3]) -> M) -> Result<Self, SplittingError>
    where
        S: GaussSystem<Scalar = T, Input: Default>,
        S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
    {
        let samples = S::Configuration::samples();
        let (mass, tensor) = constant_body(system, &samples)?;
        let axes = PrincipalAxes::of(&tensor).ok_or(SplittingError::NotPositive)?;
        try_system(system, &samples)?;
        Ok(Self { body: DriftingBody { axes, motion: motion(axes.moments()), mass }, scheme })
    }
}

/// Mass and inertia about O, which are to be the same at every configuration and time.
pub(crate) fn constant_body<S>(
    system: &S,
    samples: &[S::Configuration; 3],
) -> Result<(S::Scalar, Matrix3<S::Scalar>), SplittingError>
where
    S: GaussSystem,
    S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
{
    let inertia = |t: S::Scalar, q: &S::Configuration| S::Configuration::mass_and_inertia(&system.mass_matrix(t, q));
    let (mass, tensor) = inertia(S::Scalar::zero(), &samples[0])?;
    let unit = tensor.data.0.as_flattened().iter().fold(0.0_f64, |m, c| m.max(c.lane(0).abs()));
    for (n, q) in samples.iter().enumerate() {
        let (other_mass, other) = inertia(S::Scalar::from_f64(n as f64), q)?;
        let off = (0..9).fold(Real::abs((other_mass - mass).lane(0) / mass.lane(0)), |m, i| {
            m.max(Real::abs((other.data.0[i / 3][i % 3] - tensor.data.0[i / 3][i % 3]).lane(0)) / unit)
        });
        if off > 16.0 * S::Scalar::EPSILON {
            return Err(SplittingError::MassMatrixNotConstant);
        }
    }
    Ok((mass, tensor))
}

/// Tries kinematics and forces at a few states. Those where the forces are not finite (the centre of attraction, say)
/// do not count.
pub(crate) fn try_system<S>(system: &S, samples: &[S::Configuration; 3]) -> Result<(), SplittingError>
where
    S: GaussSystem<Input: Default>,
    S::Configuration: BodyConfiguration<Tangent = S::Speeds>,
{
    let less = |a: &S::Speeds, b: &S::Speeds| a.add_scaled(-S::Scalar::one(), b);
    let rounding = 64.0 * S::Scalar::EPSILON;
    let mut z = S::Speeds::zero();
    for i in 0..S::Speeds::DIM {
        // No component is zero, and no two are in a simple ratio.
        z.set_component(i, S::Scalar::ratio([7, -5, 3, 11, -13, 17][i], 8));
    }
    let times = [0, 1, 2].map(|t| S::Scalar::ratio(t, 1));
    for (&t, q) in times.iter().zip(samples) {
        if less(&system.kinematics(t, q, &z), &z).max_norm() > rounding * z.max_norm() {
            return Err(SplittingError::NotBodyVelocities);
        }
    }
    let mut tried = false;
    for (&t, q) in times.iter().zip(samples) {
        let p = system.momentum(t, q, &z);
        let rest = system.momentum_rate(t, q, &S::Speeds::zero(), &S::Input::default());
        let rate = system.momentum_rate(t, q, &p, &S::Input::default());
        if !(rest.is_finite() && rate.is_finite()) {
            continue;
        }
        tried = true;
        let inertial = S::Configuration::inertial_rate(&p, &z);
        let difference = less(&less(&rate, &rest), &inertial).max_norm();
        // The largest products that cancel in the inertial part.
        let size = rest.max_norm() + p.max_norm() * z.max_norm();
        if difference > rounding * size {
            return Err(SplittingError::ForcesDependOnVelocity { difference });
        }
    }
    if tried { Ok(()) } else { Err(SplittingError::NonFinite) }
}

impl<S, M> OneStep<S> for Splitting<S::Scalar, M>
where
    S: GaussSystem,
    S::Configuration: BodyConfiguration<Tangent = S::Speeds>,
    M: FreeMotion<S::Scalar>,
{
    fn properties(&self) -> Properties {
        let order = self.scheme.order();
        let order = self.body.motion.order().map_or(order, |of_motion| order.min(of_motion));
        let mut properties = Properties::of_order(order);
        properties.symmetric = true;
        properties.symplectic = self.body.motion.symplectic();
        properties.keeps_momentum = true;
        properties
    }

    /// Refuses what the free motion refuses, and what is infinite or undefined ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        _: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let system = problem.system();
        let at_rest = S::Speeds::zero();
        let kick = |t, q: &S::Configuration, p: &S::Speeds, length| {
            let input = problem.input(t, q, &at_rest);
            p.add_scaled(h * S::Scalar::from_f64(length), &system.momentum_rate(t, q, &at_rest, &input))
        };
        let (mut q, mut p) = (state.q, problem.momentum(state.t, &state.q, &state.y));
        let mut passed = 0.0;
        for (&push, &length) in self.scheme.kicks().iter().zip(self.scheme.drifts()) {
            p = kick(S::Scalar::from_f64(passed).fma(h, state.t), &q, &p, push);
            if !p.is_finite() {
                return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
            }
            (q, p) = q.drift(&p, &self.body, h * S::Scalar::from_f64(length))?;
            passed += length;
        }
        let t = state.t + h;
        // Turns are of norm 1 up to rounding, which adds up over the drifts of a step.
        q = q.renormalise();
        if let Some(&push) = self.scheme.kicks().last() {
            p = kick(t, &q, &p, push);
        }
        if !(q.is_finite() && p.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        let y = problem.of_momentum(t, &q, &p);
        let error =
            Rates { configuration: <S::Configuration as Configuration>::Tangent::zero(), variables: S::Speeds::zero() };
        Ok(Step::new(State { t, q, y }, error))
    }
}
