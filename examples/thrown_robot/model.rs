//! A quadruped from its file, thrown, with springs and dampers in its joints.

use gauss_runtime::prelude::*;

/// Twelve joints, each with a spring and a damper: clauses of the struct after those of the file.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/anymal.urdf",
    base = floating,
    inputs = none,
    gravity = 9.81,
    frames(
        base_link, LF_HAA_link, LF_HFE_link, LF_KFE_link, LH_HAA_link, LH_HFE_link, LH_KFE_link, RF_HAA_link, RF_HFE_link,
        RF_KFE_link, RH_HAA_link, RH_HFE_link, RH_KFE_link,
    ),
    spring(along = LF_HAA, stiffness = k, damping = c),
    spring(along = LF_HFE, stiffness = k, length = 0.7, damping = c),
    spring(along = LF_KFE, stiffness = k, length = -1.4, damping = c),
    spring(along = LH_HAA, stiffness = k, damping = c),
    spring(along = LH_HFE, stiffness = k, length = -0.7, damping = c),
    spring(along = LH_KFE, stiffness = k, length = 1.4, damping = c),
    spring(along = RF_HAA, stiffness = k, damping = c),
    spring(along = RF_HFE, stiffness = k, length = 0.7, damping = c),
    spring(along = RF_KFE, stiffness = k, length = -1.4, damping = c),
    spring(along = RH_HAA, stiffness = k, damping = c),
    spring(along = RH_HFE, stiffness = k, length = -0.7, damping = c),
    spring(along = RH_KFE, stiffness = k, length = 1.4, damping = c)
)]
pub struct Quadruped {
    /// N m/rad
    pub k: f64,
    /// N m s/rad
    pub c: f64,
}

/// m/s².
pub const G: f64 = 9.81;

/// Centre of mass, momentum and angular momentum about the centre of mass, observer's axes.
pub struct Whole {
    pub mass: f64,
    pub center: Vector3<f64>,
    pub momentum: Vector3<f64>,
    pub spin: Vector3<f64>,
}

impl Whole {
    /// The base moves all: the first six momenta are those of the whole about the origin of the base, in its axes, and
    /// the first six rows of A say where the centre of mass is, `∂Q/∂ω = −m [c]×`.
    pub fn of(kernel: &QuadrupedKernel, sample: &Sample<QuadrupedKernel>) -> Whole {
        let (pose, _) = &sample.q;
        let matrix = kernel.mass_matrix(sample.t, &sample.q);
        let mass = matrix[(0, 0)];
        let arm = pose.rotation * (Vector3::new(matrix[(1, 5)], matrix[(2, 3)], matrix[(0, 4)]) / mass);
        let p = kernel.momentum(sample.t, &sample.q, &sample.z);
        let [momentum, about_base] = [0, 3].map(|k| pose.rotation * Vector3::new(p[k], p[k + 1], p[k + 2]));
        Whole { mass, center: pose.translation.vector + arm, momentum, spin: about_base - arm.cross(&momentum) }
    }
}

/// Thrown forward and up, tumbling, with its legs at rest in their springs but for one.
pub fn thrown() -> QuadrupedState {
    QuadrupedState {
        base: Isometry3::translation(0.0, 0.0, 1.0),
        base_u: Vector3::new(2.0, 0.3, 4.0),
        base_omega: Vector3::new(3.0, -4.0, 0.5),
        LF_HAA: 0.5,
        LF_HFE: 0.7,
        LF_KFE: -1.4,
        LH_HFE: -0.7,
        LH_KFE: 1.4,
        RF_HFE: 0.7,
        RF_KFE: -1.4,
        RH_HFE: -0.7,
        RH_KFE: 1.4,
        ..Default::default()
    }
}
