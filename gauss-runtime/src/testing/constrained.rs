//! Constrained systems typed by hand: N coordinates with q̇ = z, masses along them, K constraints as functions. What
//! the derive generates for such systems is written out here by other means, with an elimination at run time.

use nalgebra::{SMatrix, SVector};

use crate::chart::Chart;
use crate::configuration::VectorSpace;
use crate::constraint::{ConstrainedSystem, ConstraintLevel, ProjectionError, project};
use crate::real::Real;
use crate::system::GaussSystem;

/// A function of time, coordinates and speeds.
type Function<T, const N: usize, const M: usize> = fn(T, [T; N], [T; N]) -> [T; M];

/// One scalar constraint.
#[derive(Clone, Copy)]
pub(crate) struct Constraint<T, const N: usize> {
    pub(crate) level: ConstraintLevel,
    /// φ of a position constraint; not looked at for others.
    pub(crate) position: fn(T, [T; N]) -> T,
    /// dφ/dt, or φ of a velocity constraint.
    pub(crate) velocity: fn(T, [T; N], [T; N]) -> T,
    /// Its row of J.
    pub(crate) row: fn(T, [T; N]) -> [T; N],
    /// Its γ in `J ż = γ`.
    pub(crate) bias: fn(T, [T; N], [T; N]) -> T,
}

/// `m_i q̈_i = f_i + (Jᵀλ)_i`, `φ_k = 0`.
#[derive(Clone, Copy)]
pub(crate) struct Hand<T, const N: usize, const K: usize> {
    pub(crate) mass: [T; N],
    pub(crate) force: Function<T, N, N>,
    pub(crate) potential: fn([T; N]) -> T,
    pub(crate) constraints: [Constraint<T, N>; K],
}

impl<T: Real, const N: usize, const K: usize> Hand<T, N, K> {
    /// `J A⁻¹Jᵀ λ = right` by elimination; rows of other levels than the one given, if any is, have λ = 0.
    fn solve(&self, t: T, q: &SVector<T, N>, mut right: [T; K], only: Option<ConstraintLevel>) -> [T; K] {
        let rows = self.constraints.map(|c| (c.row)(t, q.data.0[0]));
        let included = self.constraints.map(|c| only.is_none_or(|level| level == c.level));
        let mut matrix: [[T; K]; K] = core::array::from_fn(|i| {
            core::array::from_fn(|j| match (included[i] && included[j], i == j) {
                (true, _) => (0..N).fold(T::zero(), |sum, n| sum + rows[i][n] * rows[j][n] / self.mass[n]),
                (false, true) => T::one(),
                (false, false) => T::zero(),
            })
        });
        for i in 0..K {
            if !included[i] {
                right[i] = T::zero();
            }
        }
        for pivot in 0..K {
            for i in pivot + 1..K {
                let factor = matrix[i][pivot] / matrix[pivot][pivot];
                for j in pivot..K {
                    let above = matrix[pivot][j];
                    matrix[i][j] -= factor * above;
                }
                let above = right[pivot];
                right[i] -= factor * above;
            }
        }
        for pivot in (0..K).rev() {
            for j in pivot + 1..K {
                let below = right[j];
                right[pivot] -= matrix[pivot][j] * below;
            }
            right[pivot] /= matrix[pivot][pivot];
        }
        right
    }

    /// `A⁻¹(f + Jᵀλ)`.
    fn respond(&self, t: T, q: &SVector<T, N>, force: [T; N], multipliers: [T; K]) -> SVector<T, N> {
        let rows = self.constraints.map(|c| (c.row)(t, q.data.0[0]));
        SVector::from(core::array::from_fn(|n| {
            (0..K).fold(force[n], |sum, k| sum + rows[k][n] * multipliers[k]) / self.mass[n]
        }))
    }

    fn correction(
        &self,
        t: T,
        q: &SVector<T, N>,
        residual: &SVector<T, K>,
        only: Option<ConstraintLevel>,
    ) -> SVector<T, N> {
        let multipliers = self.solve(t, q, residual.data.0[0].map(|r| -r), only);
        self.respond(t, q, [T::zero(); N], multipliers)
    }
}

impl<T: Real, const N: usize, const K: usize> ConstrainedSystem for Hand<T, N, K> {
    type Multipliers = SVector<T, K>;

    fn multipliers(&self, t: T, q: &SVector<T, N>, z: &SVector<T, N>, (): &()) -> SVector<T, K> {
        let (x, v) = (q.data.0[0], z.data.0[0]);
        let force = (self.force)(t, x, v);
        let rows = self.constraints.map(|c| (c.row)(t, x));
        let right = core::array::from_fn(|k| {
            (0..N).fold((self.constraints[k].bias)(t, x, v), |sum, n| sum - rows[k][n] * force[n] / self.mass[n])
        });
        SVector::from(self.solve(t, q, right, None))
    }
    fn position_residual(&self, t: T, q: &SVector<T, N>) -> SVector<T, K> {
        SVector::from(self.constraints.map(|c| match c.level {
            ConstraintLevel::Position => (c.position)(t, q.data.0[0]),
            ConstraintLevel::Velocity => T::zero(),
        }))
    }
    fn velocity_residual(&self, t: T, q: &SVector<T, N>, z: &SVector<T, N>) -> SVector<T, K> {
        SVector::from(self.constraints.map(|c| (c.velocity)(t, q.data.0[0], z.data.0[0])))
    }
    fn position_correction(&self, t: T, q: &SVector<T, N>, residual: &SVector<T, K>) -> SVector<T, N> {
        self.correction(t, q, residual, Some(ConstraintLevel::Position))
    }
    fn velocity_correction(
        &self,
        t: T,
        q: &SVector<T, N>,
        _: &SVector<T, N>,
        residual: &SVector<T, K>,
    ) -> SVector<T, N> {
        self.correction(t, q, residual, None)
    }
}

impl<T: Real, const N: usize, const K: usize> GaussSystem for Hand<T, N, K> {
    type Scalar = T;
    type Configuration = SVector<T, N>;
    type Speeds = SVector<T, N>;
    type MassMatrix = SMatrix<T, N, N>;
    type Input = ();
    const DOF: usize = N;
    const CHART: Chart = Chart::Own;
    const CONSTRAINED: bool = K > 0;

    fn kinematics(&self, _: T, _: &SVector<T, N>, z: &SVector<T, N>) -> SVector<T, N> {
        *z
    }
    fn acceleration(&self, t: T, q: &SVector<T, N>, z: &SVector<T, N>, (): &()) -> SVector<T, N> {
        let multipliers = self.multipliers(t, q, z, &());
        self.respond(t, q, (self.force)(t, q.data.0[0], z.data.0[0]), multipliers.data.0[0])
    }
    fn momentum(&self, _: T, _: &SVector<T, N>, z: &SVector<T, N>) -> SVector<T, N> {
        SVector::from(core::array::from_fn(|n| self.mass[n] * z.data.0[0][n]))
    }
    fn velocity(&self, _: T, _: &SVector<T, N>, p: &SVector<T, N>) -> SVector<T, N> {
        SVector::from(core::array::from_fn(|n| p.data.0[0][n] / self.mass[n]))
    }
    fn momentum_rate(&self, t: T, q: &SVector<T, N>, p: &SVector<T, N>, (): &()) -> SVector<T, N> {
        self.momentum(t, q, &self.acceleration(t, q, &self.velocity(t, q, p), &()))
    }
    fn mass_matrix(&self, _: T, _: &SVector<T, N>) -> SMatrix<T, N, N> {
        SMatrix::from_fn(|i, j| if i == j { self.mass[i] } else { T::zero() })
    }
    fn kinetic_energy(&self, t: T, q: &SVector<T, N>, z: &SVector<T, N>) -> T {
        let momentum = self.momentum(t, q, z);
        T::ratio(1, 2) * (0..N).fold(T::zero(), |sum, n| sum + momentum.component(n) * z.component(n))
    }
    fn potential_energy(&self, _: T, q: &SVector<T, N>) -> T {
        (self.potential)(q.data.0[0])
    }
    fn gauss_residual(
        &self,
        t: T,
        q: &SVector<T, N>,
        z: &SVector<T, N>,
        acceleration: &SVector<T, N>,
        (): &(),
    ) -> SVector<T, N> {
        self.momentum(t, q, &acceleration.add_scaled(-T::one(), &self.acceleration(t, q, z, &())))
    }
    fn constraint_function(
        &self,
        t: T,
        q: &SVector<T, N>,
        z: &SVector<T, N>,
        acceleration: &SVector<T, N>,
        (): &(),
    ) -> T {
        let free = self.respond(t, q, (self.force)(t, q.data.0[0], z.data.0[0]), [T::zero(); K]);
        self.kinetic_energy(t, q, &acceleration.add_scaled(-T::one(), &free))
    }
    fn project(
        &self,
        t: T,
        q: &SVector<T, N>,
        z: &SVector<T, N>,
    ) -> Result<(SVector<T, N>, SVector<T, N>), ProjectionError> {
        project(self, t, q, z)
    }
}

/// g of the pendulum and of the skate.
pub(crate) const GRAVITY: f64 = 9.81;

/// Stays at distance 1 from the origin: φ = x² + y² − 1.
pub(crate) fn circle<T: Real>() -> Constraint<T, 2> {
    Constraint {
        level: ConstraintLevel::Position,
        position: |_, [x, y]| x * x + y * y - T::one(),
        velocity: |_, [x, y], [u, v]| T::from_f64(2.0) * (x * u + y * v),
        row: |_, [x, y]| [x + x, y + y],
        bias: |_, _, [u, v]| -T::from_f64(2.0) * (u * u + v * v),
    }
}

/// A pendulum of length 1 in the vertical plane, y upwards.
pub(crate) fn pendulum<T: Real>(mass: f64) -> Hand<T, 2, 1> {
    let mass = T::from_f64(mass);
    Hand {
        mass: [mass, mass],
        // Weight for m = 2; other masses are used without it.
        force: |_, _, _| [T::zero(), T::from_f64(-2.0 * GRAVITY)],
        potential: |[_, y]| T::from_f64(2.0 * GRAVITY) * y,
        constraints: [circle()],
    }
}

/// The same pendulum by its angle from the downward vertical, which needs no constraint.
pub(crate) fn pendulum_by_angle() -> Hand<f64, 1, 0> {
    Hand {
        mass: [2.0],
        force: |_, [angle], _| [-2.0 * GRAVITY * angle.sin()],
        potential: |[angle]| -2.0 * GRAVITY * angle.cos(),
        constraints: [],
    }
}

/// A skate (x, y, θ) that does not slip across its edge, on a plane that falls towards +x.
pub(crate) fn skate() -> Hand<f64, 3, 1> {
    Hand {
        mass: [1.5, 1.5, 0.2],
        force: |_, _, _| [1.5 * GRAVITY, 0.0, 0.0],
        potential: |[x, _, _]| -1.5 * GRAVITY * x,
        constraints: [Constraint {
            level: ConstraintLevel::Velocity,
            position: |_, _| f64::NAN,
            velocity: |_, [_, _, angle], [u, v, _]| v * angle.cos() - u * angle.sin(),
            row: |_, [_, _, angle]| [-angle.sin(), angle.cos(), 0.0],
            bias: |_, [_, _, angle], [u, v, turn]| (u * angle.cos() + v * angle.sin()) * turn,
        }],
    }
}

/// x = a, where a is 2, or moves with the time.
pub(crate) fn line(position: fn(f64, [f64; 2]) -> f64, rate: fn(f64, [f64; 2], [f64; 2]) -> f64) -> Constraint<f64, 2> {
    Constraint {
        level: ConstraintLevel::Position,
        position,
        velocity: rate,
        row: |_, _| [1.0, 0.0],
        bias: |_, _, _| 0.0,
    }
}

/// Two constraints on a mass in the plane, without forces.
pub(crate) fn on_both(first: Constraint<f64, 2>, second: Constraint<f64, 2>) -> Hand<f64, 2, 2> {
    Hand { mass: [1.0, 1.0], force: |_, _, _| [0.0; 2], potential: |_| 0.0, constraints: [first, second] }
}
