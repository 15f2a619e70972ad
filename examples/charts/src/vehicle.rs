//! The REMUS 100 autonomous underwater vehicle in an ideal fluid, once for each chart.
//!
//! Source of every number: T. Prestero, *Verification of a six-degree of freedom simulation model for the REMUS
//! autonomous underwater vehicle*, MIT/WHOI 2001, appendix C. Body axes: e₁ forward, e₂ starboard, e₃ down, O at the
//! centre of buoyancy. Observer: k₁ north, k₂ east, k₃ down. SI units.

use gauss_runtime::prelude::*;

/// Length of the hull in metres.
pub const LENGTH: f64 = 1.33;

/// Physical parameters, whatever the chart.
#[derive(Clone, Copy, Debug)]
pub struct Parameters {
    /// m, kg.
    pub mass: f64,
    /// G − O, body axes, m.
    pub center: Vector3<f64>,
    /// Principal moments of inertia about O, kg m².
    pub inertia: Vector3<f64>,
    /// Added mass in the order (u, ω), pole O.
    pub added: Matrix6<f64>,
    /// Mass of the displaced water, kg.
    pub displaced: f64,
    /// Acceleration of free fall, observer's axes, m/s².
    pub gravity: Vector3<f64>,
}

impl Parameters {
    /// The published values. Weight and buoyancy are given there in newtons.
    #[must_use]
    pub fn published() -> Self {
        let g = 9.81;
        let (weight, buoyancy) = (299.0, 306.0);
        // The derivatives of the force by the acceleration: what Prestero tabulates is −M_A.
        let (x_du, y_dv, z_dw) = (-0.930, -35.5, -35.5);
        let (k_dp, m_dq, n_dr) = (-0.0704, -4.88, -4.88);
        let (y_dr, z_dq) = (1.93, -1.93);
        let mut added = -Matrix6::from_diagonal(&Vector6::new(x_du, y_dv, z_dw, k_dp, m_dq, n_dr));
        (added[(1, 5)], added[(5, 1)]) = (-y_dr, -y_dr);
        (added[(2, 4)], added[(4, 2)]) = (-z_dq, -z_dq);
        Self {
            mass: weight / g,
            center: Vector3::new(0.0, 0.0, 0.0196),
            inertia: Vector3::new(0.177, 3.45, 3.45),
            added,
            displaced: buoyancy / g,
            gravity: Vector3::new(0.0, 0.0, g),
        }
    }
}

/// The same body in another chart is another word in one attribute: everything else is the same text.
macro_rules! vehicle {
    ($(#[$doc:meta])* $name:ident, $($chart:tt)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, GaussDynamics)]
        #[gauss(chart = $($chart)*)]
        pub struct $name {
            /// m, kg.
            #[gauss(mass)]
            pub mass: f64,
            /// G − O, body axes, m.
            #[gauss(center_of_mass)]
            pub center: Vector3<f64>,
            /// Principal moments of inertia about O, kg m².
            #[gauss(inertia)]
            pub inertia: Vector3<f64>,
            /// Added mass in the order (u, ω), pole O.
            #[gauss(added_mass)]
            pub added: Matrix6<f64>,
            /// Mass of the displaced water, kg; buoyancy acts at O.
            #[gauss(displaced_mass)]
            pub displaced: f64,
            /// Acceleration of free fall, observer's axes, m/s².
            #[gauss(gravity)]
            pub gravity: Vector3<f64>,
        }

        impl From<&Parameters> for $name {
            fn from(p: &Parameters) -> Self {
                let Parameters { mass, center, inertia, added, displaced, gravity } = *p;
                Self { mass, center, inertia, added, displaced, gravity }
            }
        }
    };
}

vehicle!(
    /// Kirchhoff's equations.
    Kirchhoff, left_invariant
);
vehicle!(
    /// The Newton–Euler equations about Ω.
    NewtonEuler, right_invariant
);
vehicle!(
    /// Linear balance in space, angular balance in the body.
    Hybrid, hybrid
);
vehicle!(
    /// Lagrange's equations in yaw, pitch and roll.
    Lagrange, jet(euler_zyx)
);

/// The same without weight and buoyancy: no force is left, so all six momenta in space are constant.
macro_rules! weightless {
    ($(#[$doc:meta])* $name:ident, $chart:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, GaussDynamics)]
        #[gauss(chart = $chart)]
        pub struct $name {
            /// m, kg.
            #[gauss(mass)]
            pub mass: f64,
            /// G − O, body axes, m.
            #[gauss(center_of_mass)]
            pub center: Vector3<f64>,
            /// Principal moments of inertia about O, kg m².
            #[gauss(inertia)]
            pub inertia: Vector3<f64>,
            /// Added mass in the order (u, ω), pole O.
            #[gauss(added_mass)]
            pub added: Matrix6<f64>,
        }

        impl From<&Parameters> for $name {
            fn from(p: &Parameters) -> Self {
                let Parameters { mass, center, inertia, added, .. } = *p;
                Self { mass, center, inertia, added }
            }
        }
    };
}

weightless!(
    /// Kirchhoff's equations without gravity.
    WeightlessKirchhoff, left_invariant
);
weightless!(
    /// The Newton–Euler equations without gravity.
    WeightlessNewtonEuler, right_invariant
);

/// The state that every run starts from: motor off in a turn at 1.5 m/s, 70 m under the surface.
///
/// Given as pose and body twist (u, ω): it belongs to no chart.
#[must_use]
pub fn initial_state() -> (Isometry3<f64>, Vector6<f64>) {
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, 70.0), UnitQuaternion::identity());
    (pose, Vector6::new(1.5, 0.4, -0.25, -0.4, -0.25, -0.2))
}
