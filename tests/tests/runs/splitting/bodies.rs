//! The kernels that are split, and those that cannot be.

use gauss_runtime::prelude::*;
use gauss_tests::scene::Scene;
use gauss_tests::top::{Top, TopKernel};

/// A top with products of inertia.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
pub struct Skewed {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    #[gauss(inertia)]
    pub inertia: Matrix3<f64>,
    #[gauss(gravity)]
    pub gravity: f64,
}

/// A free body with O in its centre of mass.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct Flying {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub principal: Vector3<f64>,
    #[gauss(gravity)]
    pub gravity: f64,
}

/// A free body with O elsewhere.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct OffCentre {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    #[gauss(inertia)]
    pub principal: Vector3<f64>,
    #[gauss(gravity)]
    pub gravity: f64,
}

/// A body in a fluid.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
pub struct Afloat {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub principal: Vector3<f64>,
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
}

/// A body with the velocities that an observer sees.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
pub struct Observed {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub principal: Vector3<f64>,
    #[gauss(gravity)]
    pub gravity: f64,
}

/// A body with drag.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, drag(linear = drag))]
pub struct Dragged {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub principal: Vector3<f64>,
    pub drag: Vector6<f64>,
}

/// The top of a scene; without gravity where the scene has none.
pub fn top(scene: &Scene) -> TopKernel<f64> {
    let p = &scene.parameters;
    Top { mass: p.mass, center: p.center, inertia: p.principal, g: p.gravity }.kernel().expect("a top")
}

/// The free body of a scene.
pub fn flying(scene: &Scene) -> FlyingKernel {
    let p = &scene.parameters;
    Flying { mass: p.mass, principal: p.principal, gravity: p.gravity }.kernel().expect("a body")
}

/// The largest error of an entry of R.
pub fn attitude_error(q: &UnitQuaternion<f64>, scene: &Scene) -> f64 {
    (q.to_rotation_matrix().into_inner() - scene.last.rotation).amax()
}
