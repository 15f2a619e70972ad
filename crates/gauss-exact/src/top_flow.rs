//! The exact motion of Lagrange's top over any span of time: a heavy body of revolution about a point of its axis.

use core::fmt;

use gauss_runtime::__crates_0_1_0::{
    Triple, add, axpy, compose, conjugate, cross, dot, quaternion, rotate, rotate_back, scaled, triple, unit_quaternion,
};
use gauss_runtime::integrate::{
    IntegrationErrorKind, OneStep, Problem, Properties, Rates, RunPart, State, Step, check_contacts,
};
use gauss_runtime::lie::so3;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;
use nalgebra::{SMatrix, SVector, UnitQuaternion};

use crate::configuration::{BodyConfiguration, SplittingError};
use crate::splitting::{constant_body, try_system};
use crate::top_orbit::Top;

/// The exact motion of a body about a fixed point of its axis, with equal moments across it, under a weight: Lagrange's
/// top, and with no spin the spherical pendulum. One call for any span of time, of some thousand operations; for
/// [`Fixed::by`](gauss_runtime::integrate::Fixed::by), in velocity form or momentum form, with steps as long as states
/// are wanted; where events are looked for, steps that resolve the motion.
///
/// Errors: some roundings of the angles through which the body spins, precesses and nutates, times how much the motion
/// depends on them. What a step is made of is read from the kernel: inertia, the moment of the weight and its
/// direction.
///
/// Where the kinetic energy is more than 10⁶⁰ times that of the weight, powers overflow, and the step is refused:
/// `FreeFlow` is that motion.
///
/// For `f64`: the number of operations depends on the state. It belongs to the kernel that it was made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TopFlow {
    /// Ratio of the moments of inertia, across to along the axis.
    ratio: f64,
    /// √(2 P A) and √(2 P/A), P the weight times its lever.
    momentum: f64,
    rate: f64,
    /// From e₃ to the axis of the body.
    axis: [f64; 4],
    /// From the direction against which the weight acts to k₃.
    level: [f64; 4],
}

/// A system that is not a heavy body of revolution about a point of its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TopError {
    /// Not one body with a constant inertia, under forces that do not depend on its velocities.
    NotABody(SplittingError),
    /// Nothing acts: a free body has a motion of its own ([`FreeFlow`](crate::free_flow::FreeFlow)).
    Free,
    /// The load is not the moment of one constant force at one point of the body.
    NotAWeight,
    /// The moments of inertia across the line from O to the weight differ, or it is no principal axis.
    NotOfRevolution,
}

impl fmt::Display for TopError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotABody(error) => error.fmt(f),
            Self::Free => f.write_str("nothing acts on the body: its motion is `FreeFlow`"),
            Self::NotAWeight => {
                f.write_str("the load is not one constant force at one point of the body; use `Splitting`, or order 8")
            }
            Self::NotOfRevolution => f.write_str(
                "the weight does not act on an axis across which all moments of inertia are equal; use `Splitting`, or order 8",
            ),
        }
    }
}

impl core::error::Error for TopError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        if let Self::NotABody(error) = self { Some(error) } else { None }
    }
}

/// Bound of the rounding of what is computed with numbers of the sizes of the result.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl TopFlow {
    /// The motion of a kernel in the left-invariant chart.
    ///
    /// # Errors
    /// When the system is not such a body.
    pub fn new<S>(system: &S) -> Result<Self, TopError>
    where
        S: GaussSystem<Scalar = f64, Input = (), Configuration = UnitQuaternion<f64>>,
        S: GaussSystem<Speeds = SVector<f64, 3>, MassMatrix = SMatrix<f64, 3, 3>>,
    {
        let samples = <UnitQuaternion<f64> as BodyConfiguration>::samples();
        let (_, inertia) = constant_body(system, &samples).map_err(TopError::NotABody)?;
        try_system(system, &samples).map_err(TopError::NotABody)?;
        let torque =
            |t: f64, q: [f64; 4]| triple(&system.momentum_rate(t, &unit_quaternion(q), &SVector::zeros(), &()));
        // The turns of a tetrahedron, over which every direction is evenly spread; then others, at other times.
        let halves = [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let thirds = [[0.0, 0.0, 0.0, 1.0], [0.5; 4], [-0.5, -0.5, -0.5, 0.5]];
        let turns: [[f64; 4]; 12] = core::array::from_fn(|i| compose(halves[i % 4], thirds[i / 4]));
        let others = [quaternion(&samples[1]), quaternion(&samples[2])];
        let seen = turns.map(|q| torque(0.0, q));
        let later = [(others[0], torque(1.0, others[0])), (others[1], torque(2.0, others[1]))];
        if !seen.iter().chain(later.iter().map(|(_, torque)| torque)).flatten().all(|c| Real::is_finite(*c)) {
            return Err(TopError::NotAWeight);
        }
        let largest = seen.iter().fold(0.0_f64, |most, torque| most.max(Real::sqrt(dot(*torque, *torque))));
        if largest == 0.0 {
            return Err(TopError::Free);
        }
        // All are across the axis.
        let normals = (0..12).flat_map(|i| (0..i).map(move |j| cross(seen[j], seen[i])));
        let normal = normals.fold([0.0; 3], |most, n| if dot(n, n) > dot(most, most) { n } else { most });
        let length = Real::sqrt(dot(normal, normal));
        if length <= ROUNDING * largest * largest {
            return Err(TopError::NotAWeight);
        }
        let axis = scaled(1.0 / length, normal);
        // Torques are P (Rᵀn) × a: turned back and summed, with what of n is across a left out of each, 8 P n.
        let sum = turns.iter().zip(seen).fold([0.0; 3], |sum, (q, torque)| add(sum, rotate(*q, cross(axis, torque))));
        let size = Real::sqrt(dot(sum, sum));
        let (double, up) = (0.25 * size, scaled(1.0 / size, sum));
        let off = |q: [f64; 4], torque: Triple<f64>| {
            let expected = cross(rotate_back(q, up), scaled(0.5 * double, axis));
            axpy(-1.0, expected, torque).iter().fold(0.0, |most: f64, c| most.max(c.abs()))
        };
        let worst = turns.into_iter().zip(seen).chain(later).fold(0.0, |worst: f64, (q, seen)| worst.max(off(q, seen)));
        if worst > ROUNDING * double {
            return Err(TopError::NotAWeight);
        }
        Self::of(&inertia, axis, double, up).ok_or(TopError::NotOfRevolution)
    }

    /// From the inertia, the axis, twice the weight times its lever, and the direction against which it acts.
    fn of(inertia: &SMatrix<f64, 3, 3>, axis: Triple<f64>, double: f64, up: Triple<f64>) -> Option<Self> {
        let entry = inertia.data.0;
        let about = entry.map(|column| dot(column, axis));
        let along = dot(about, axis);
        let across = 0.5 * (entry[0][0] + entry[1][1] + entry[2][2] - along);
        let even = (0..3).all(|i| {
            (0..3).all(|j| {
                let of_revolution = if i == j { across } else { 0.0 } + (along - across) * axis[i] * axis[j];
                (entry[j][i] - of_revolution).abs() <= ROUNDING * across.max(along)
            })
        });
        let positive = across > 0.0 && along > 0.0 && Real::is_finite(across + along);
        (even && positive).then(|| Self {
            ratio: across / along,
            momentum: Real::sqrt(double * across),
            rate: Real::sqrt(double / across),
            axis: to_vertical(axis),
            level: conjugate(to_vertical(up)),
        })
    }

    /// The attitude and the momentum about O, body axes, after a time.
    fn after(&self, q: [f64; 4], momentum: Triple<f64>, t: f64) -> Option<([f64; 4], Triple<f64>)> {
        let [x, y, z, w] = compose(compose(self.level, q), self.axis);
        let [m1, m2, along] = scaled(1.0 / self.momentum, rotate_back(self.axis, momentum));
        let top = Top { alpha: [w, z], beta: [y, -x], across: [m1, m2], along };
        let Top { alpha, beta, across, along } = top.after(t * self.rate, self.ratio);
        let turned =
            compose(compose(conjugate(self.level), [-beta[1], beta[0], alpha[1], alpha[0]]), conjugate(self.axis));
        let momentum = rotate(self.axis, scaled(self.momentum, [across[0], across[1], along]));
        let all = turned.iter().chain(&momentum).fold(true, |all, c| all & Real::is_finite(*c));
        all.then_some((turned, momentum))
    }
}

/// A rotation that takes k₃ to a direction of length 1.
fn to_vertical([x, y, z]: Triple<f64>) -> [f64; 4] {
    let w = Real::sqrt(0.5 * (1.0 + z));
    if w > 0.5 {
        [-0.5 * y / w, 0.5 * x / w, 0.0, w]
    } else {
        let across = Real::sqrt(0.5 * (1.0 - z));
        let over = 0.5 / across;
        // Axis k₃ × v, or any across where v is opposite.
        let size = Real::sqrt(x * x + y * y);
        if size > 0.0 { [-across * y / size, across * x / size, 0.0, over * size] } else { [1.0, 0.0, 0.0, 0.0] }
    }
}

impl<S> OneStep<S> for TopFlow
where
    S: GaussSystem<Scalar = f64, Input = (), Configuration = UnitQuaternion<f64>, Speeds = SVector<f64, 3>>,
{
    fn properties(&self) -> Properties {
        let mut properties = Properties::of_order(u32::MAX);
        properties.symmetric = true;
        properties.symplectic = true;
        properties.keeps_momentum = true;
        properties.keeps_energy = true;
        properties
    }

    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        _: &Rates<S>,
        h: f64,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let momentum = problem.momentum(state.t, &state.q, &state.y);
        let (q, momentum) = self
            .after(quaternion(&state.q), triple(&momentum), h)
            .ok_or(IntegrationErrorKind::NonFinite { part: RunPart::Step })?;
        let (t, q) = (state.t + h, so3::renormalise(&unit_quaternion(q)));
        let y = problem.of_momentum(t, &q, &SVector::from(momentum));
        let error = Rates { configuration: SVector::zeros(), variables: SVector::zeros() };
        Ok(Step::new(State { t, q, y }, error))
    }
}
