//! Methods that a kernel has if its struct asks for them: a function for each word in `offers` of
//! [`scene!`](crate::scene).

use gauss_runtime::hessian::Hessian;
use gauss_runtime::inverse::InverseLinearization;
use gauss_runtime::linearize::LinearModel;
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

use super::called;
use super::system::System;
use super::table::{Table, Writer};
use super::words::Id;

/// Second derivatives whose sizes are known.
pub trait SecondDerivatives {
    #[doc(hidden)]
    fn write(&self, out: &mut Writer<'_>);
}

impl<T: Real + Packed<Single = f64>, const D: usize, const U: usize> SecondDerivatives for Hessian<T, D, U> {
    #[inline(always)]
    fn write(&self, out: &mut Writer<'_>) {
        out.matrix([D, D], |i, j| self.by_state[(i, j)]);
        out.next();
        out.matrix([U, D], |i, j| self.by_input_and_state[(i, j)]);
        out.next();
        out.matrix([U, U], |i, j| self.by_input[(i, j)]);
    }
}

/// Derivatives of inverse dynamics whose sizes are known.
pub trait InverseDerivatives {
    #[doc(hidden)]
    fn write(&self, out: &mut Writer<'_>);
}

impl<T: Real + Packed<Single = f64>, const C: usize, const N: usize, const U: usize> InverseDerivatives
    for InverseLinearization<T, C, N, U>
{
    #[inline(always)]
    fn write(&self, out: &mut Writer<'_>) {
        out.matrix([1, N], |_, j| self.force[j]);
        out.next();
        out.matrix([N, C], |i, j| self.by_configuration[(i, j)]);
        out.next();
        out.matrix([N, N], |i, j| self.by_speeds[(i, j)]);
        out.next();
        out.matrix([N, N], |i, j| self.by_acceleration[(i, j)]);
        out.next();
        out.matrix([1, N], |_, j| self.by_time[j]);
        out.next();
        out.matrix([N, U], |i, j| self.by_input[(i, j)]);
    }
}

impl<S: System> Table<S> {
    /// Derivatives by the state.
    pub fn linearize(&mut self)
    where
        S: LinearizedSystem,
    {
        self.add(Id::Linearize, |s, at, out| {
            let linear = s.linearize(at.t(), &at.q(), &at.z(), &at.input());
            let size = <<S::Linearization as LinearModel<S::Scalar>>::Vector as VectorSpace<S::Scalar>>::DIM;
            out.vector(linear.rate());
            out.next();
            out.matrix([size, size], |i, j| linear.by_state(i, j));
            out.next();
            out.vector(linear.by_time());
            out.next();
            out.matrix([size, <S::Input as VectorSpace<S::Scalar>>::DIM], |i, j| linear.by_input(i, j));
        });
    }

    /// Derivatives by the parameters.
    pub fn by_parameters(&mut self)
    where
        S: ParametricSystem,
    {
        self.parameters = S::PARAMETERS;
        self.add(Id::ByParameters, |s, at, out| {
            let found = s.by_parameters(at.t(), &at.q(), &at.z(), &at.input());
            let size = <<S::Linearization as LinearModel<S::Scalar>>::Vector as VectorSpace<S::Scalar>>::DIM;
            out.matrix([size, S::PARAMETERS.len()], |i, j| found[(i, j)]);
        });
    }

    /// Derivatives of inverse dynamics.
    pub fn linearize_inverse(&mut self)
    where
        S: InverseLinearizedSystem<InverseLinearization: InverseDerivatives>,
    {
        self.add(Id::LinearizeInverse, |s, at, out| {
            s.linearize_inverse(at.t(), &at.q(), &at.z(), &at.x(), &at.input()).write(out);
        });
    }

    /// Second derivatives.
    pub fn hessian(&mut self)
    where
        S: HessianSystem<Hessian: SecondDerivatives>,
    {
        self.add(Id::Hessian, |s, at, out| s.hessian(at.t(), &at.q(), &at.z(), &at.input(), &at.x()).write(out));
    }

    /// Frames by their names.
    pub fn frames(&mut self)
    where
        S: FramedSystem,
    {
        self.frames = S::Frame::ALL.iter().map(|frame| frame.name()).collect();
        self.add(Id::Pose, |s, at, out| {
            let pose = s.pose_of(at.frame(), at.t(), &at.q());
            let (rotation, origin) = (pose.rotation.matrix(), &pose.translation.vector);
            let last = |j| if j < 3 { S::Scalar::zero() } else { S::Scalar::one() };
            out.matrix([4, 4], |i, j| match (i, j) {
                (3, j) => last(j),
                (i, 3) => origin[i],
                (i, j) => rotation[(i, j)],
            });
        });
        self.add(Id::Twist, |s, at, out| out.vector(&s.twist_of(at.frame(), at.t(), &at.q(), &at.z())));
        self.add(Id::Bias, |s, at, out| out.vector(&s.bias_of(at.frame(), at.t(), &at.q(), &at.z())));
        self.add(Id::Jacobian, |s, at, out| {
            let jacobian = s.jacobian_of(at.frame(), at.t(), &at.q());
            out.matrix([6, S::DOF], |i, j| jacobian[(i, j)]);
        });
    }

    /// Reactions of joints by their names.
    pub fn reactions(&mut self)
    where
        S: Reactions,
    {
        self.joints = S::Joint::ALL.iter().map(|joint| joint.name()).collect();
        self.add(Id::Reaction, |s, at, out| {
            // As `reaction`, but for the function that is called: see there.
            let (t, q, z, input) = (at.t(), at.q(), at.z(), at.input());
            let all = s.reactions_at(t, &q, &z, &called::acceleration(s, t, &q, &z, &input), &input);
            out.vector(&all[at.frame()]);
        });
    }

    /// Driving forces of motions.
    pub fn motions(&mut self)
    where
        S: DrivenSystem,
    {
        self.motions = S::Motion::ALL.iter().map(|motion| motion.name()).collect();
        self.add(Id::DrivingForces, |s, at, out| {
            let (t, q, z, input) = (at.t(), at.q(), at.z(), at.input());
            let all = s.driving_forces_at(t, &q, &z, &called::acceleration(s, t, &q, &z, &input), &input);
            out.matrix([S::Motion::ALL.len(), 2], |i, j| {
                let own = all[S::Motion::ALL[i]];
                if j == 0 { own.force } else { own.power }
            });
        });
    }

    /// Rates of Jacobians.
    pub fn jacobian_rates(&mut self)
    where
        S: JacobianRates,
    {
        self.add(Id::JacobianRate, |s, at, out| {
            let rate = s.jacobian_rate_of(at.frame(), at.t(), &at.q(), &at.z());
            out.matrix([6, S::DOF], |i, j| rate[(i, j)]);
        });
    }

    /// Multipliers.
    pub fn constraints(&mut self)
    where
        S: ConstrainedSystem,
    {
        self.multipliers = <S::Multipliers as VectorSpace<S::Scalar>>::DIM;
        self.add(Id::Multipliers, |s, at, out| out.vector(&s.multipliers(at.t(), &at.q(), &at.z(), &at.input())));
    }

    /// Adds the generalised forces that balance weight and buoyancy.
    pub fn gravity_torques(&mut self)
    where
        S: GravityTorques,
    {
        self.add(Id::GravityTorques, |s, at, out| out.vector(&s.gravity_torques(at.t(), &at.q())));
    }

    /// The system as a whole.
    pub fn centroidal(&mut self)
    where
        S: CentroidalSystem,
    {
        self.add(Id::CenterOfMass, |s, at, out| out.vector(&s.center_of_mass(at.t(), &at.q())));
        self.add(Id::CentroidalMomentum, |s, at, out| out.vector(&s.centroidal_momentum(at.t(), &at.q(), &at.z())));
        self.add(Id::CentroidalMatrix, |s, at, out| {
            let matrix = s.centroidal_matrix(at.t(), &at.q());
            out.matrix([6, S::DOF], |i, j| matrix[(i, j)]);
        });
        self.add(Id::CenterJacobian, |s, at, out| {
            let matrix = s.center_jacobian(at.t(), &at.q());
            out.matrix([3, S::DOF], |i, j| matrix[(i, j)]);
        });
    }
}
