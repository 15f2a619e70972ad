//! Equations of motion as one types them with nalgebra: matrices and vectors as in a textbook, a Cholesky factorisation
//! a call.

use gauss_runtime::prelude::*;
use nalgebra::{Matrix2, Vector2};

use crate::Dynamics;
use crate::scenes::{G, numbers};

/// S1–S3: Kirchhoff's equations with a kinetic matrix, weight and buoyancy.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    kinetic: Matrix6<f64>,
    weight: f64,
    center: Vector3<f64>,
    buoyancy: f64,
    center_of_buoyancy: Vector3<f64>,
}

impl Body {
    fn of(mass: f64, center: Vector3<f64>, inertia: Matrix3<f64>, weight: f64) -> Self {
        // The kinetic matrix of a body about O, inertia about its centre of mass.
        let moment = center.cross_matrix() * mass;
        let mut kinetic = Matrix6::zeros();
        kinetic.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * mass));
        kinetic.fixed_view_mut::<3, 3>(0, 3).copy_from(&-moment);
        kinetic.fixed_view_mut::<3, 3>(3, 0).copy_from(&moment);
        kinetic.fixed_view_mut::<3, 3>(3, 3).copy_from(&(inertia - moment * center.cross_matrix()));
        Self { kinetic, weight, center, buoyancy: 0.0, center_of_buoyancy: Vector3::zeros() }
    }

    /// S1.
    pub fn free() -> Self {
        let (mass, inertia) = numbers::FREE_BODY;
        Self::of(mass, Vector3::zeros(), Matrix3::from_diagonal(&inertia.into()), 0.0)
    }

    /// S2.
    pub fn heavy() -> Self {
        let (mass, center, inertia) = numbers::heavy_body();
        Self::of(mass, center, inertia, mass * G)
    }

    /// S3.
    pub fn immersed() -> Self {
        let ((weight, center), (buoyancy, center_of_buoyancy)) = (numbers::WEIGHT, numbers::BUOYANCY);
        Self {
            kinetic: Matrix6::from_fn(|i, j| numbers::KINETIC[i][j]),
            weight,
            center: center.into(),
            buoyancy,
            center_of_buoyancy: center_of_buoyancy.into(),
        }
    }
}

impl Dynamics for Body {
    type Configuration = Isometry3<f64>;
    type Speeds = Vector6<f64>;

    #[inline]
    fn acceleration(&self, q: &Isometry3<f64>, z: &Vector6<f64>) -> Vector6<f64> {
        let momentum = self.kinetic * z;
        let (u, w) = (z.fixed_rows::<3>(0).into_owned(), z.fixed_rows::<3>(3).into_owned());
        let linear = momentum.fixed_rows::<3>(0).into_owned();
        let angular = momentum.fixed_rows::<3>(3).into_owned();
        let up = q.rotation.inverse() * Vector3::z();
        let (weight, buoyancy) = (-self.weight * up, self.buoyancy * up);
        let force = linear.cross(&w) + weight + buoyancy;
        let moments = self.center.cross(&weight) + self.center_of_buoyancy.cross(&buoyancy);
        let torque = linear.cross(&u) + angular.cross(&w) + moments;
        let right = Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z);
        let factors = self.kinetic.cholesky().expect("the kinetic matrix is positive definite");
        factors.solve(&right)
    }
}

/// S4: ω = W(q) q̇, A = WᵀI W.
#[derive(Clone, Copy, Debug)]
pub struct Top {
    inertia: Matrix3<f64>,
    weight: f64,
    center: Vector3<f64>,
}

impl Top {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let (mass, distance, moments) = numbers::top();
        let center = Vector3::new(0.0, 0.0, distance);
        Self { inertia: Matrix3::from_diagonal(&moments), weight: mass * G, center }
    }
}

impl Dynamics for Top {
    type Configuration = Vector3<f64>;
    type Speeds = Vector3<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector3<f64>, z: &Vector3<f64>) -> Vector3<f64> {
        let ((st, ct), (sp, cp)) = (q[1].sin_cos(), q[2].sin_cos());
        let kinematics = Matrix3::new(st * sp, cp, 0.0, st * cp, -sp, 0.0, ct, 0.0, 1.0);
        let rate = Matrix3::new(
            ct * sp * z[1] + st * cp * z[2],
            -sp * z[2],
            0.0,
            ct * cp * z[1] - st * sp * z[2],
            -cp * z[2],
            0.0,
            -st * z[1],
            0.0,
            0.0,
        );
        let w = kinematics * z;
        let up = Vector3::new(st * sp, st * cp, ct);
        let torque = self.center.cross(&(-self.weight * up)) - w.cross(&(self.inertia * w));
        let right = kinematics.transpose() * (torque - self.inertia * (rate * z));
        let mass = kinematics.transpose() * self.inertia * kinematics;
        mass.cholesky().expect("the mass matrix is positive definite").solve(&right)
    }
}

/// S5: A ż = f.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

impl Dynamics for DoublePendulum {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let ((m1, c1, i1), (m2, c2, i2), l) = (numbers::UPPER, numbers::LOWER, numbers::LENGTH);
        let coupling = m2 * l * c2;
        let (sine, cosine) = (q[0] - q[1]).sin_cos();
        let mass =
            Matrix2::new(i1 + m1 * c1 * c1 + m2 * l * l, coupling * cosine, coupling * cosine, i2 + m2 * c2 * c2);
        let right = Vector2::new(
            -coupling * sine * z[1] * z[1] - (m1 * c1 + m2 * l) * G * q[0].sin(),
            coupling * sine * z[0] * z[0] - m2 * c2 * G * q[1].sin(),
        );
        mass.cholesky().expect("the mass matrix is positive definite").solve(&right)
    }
}

/// S5′: from the angle of the joint to those from the vertical and back.
#[derive(Clone, Copy, Debug)]
pub struct JointedPendulum;

impl Dynamics for JointedPendulum {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let sum = |v: &Vector2<f64>| Vector2::new(v[0], v[0] + v[1]);
        let rates = DoublePendulum.acceleration(&sum(q), &sum(z));
        Vector2::new(rates[0], rates[1] - rates[0])
    }
}

/// S6.
#[derive(Clone, Copy, Debug)]
pub struct CartPole;

impl Dynamics for CartPole {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let (m, c, i) = numbers::POLE;
        let (sine, cosine) = q[1].sin_cos();
        let off = m * c * cosine;
        let mass = Matrix2::new(numbers::CART + m, off, off, i + m * c * c);
        let right = Vector2::new(m * c * sine * z[1] * z[1], m * c * G * sine);
        mass.cholesky().expect("the mass matrix is positive definite").solve(&right)
    }
}

impl Default for Top {
    fn default() -> Self {
        Self::new()
    }
}
