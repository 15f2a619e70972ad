//! The bodies of the scenes, each derived in every chart: what varies is which fields there are.

use gauss_runtime::integrate::{MomentumForm, VelocityForm};
use gauss_runtime::prelude::*;
use gauss_tests::compare::{Outcome, Refusal, run};
use gauss_tests::order8::Order8;
use gauss_tests::scene::Scene;

/// One chart and form of a body over a scene.
pub struct Row {
    /// The chart of the kernel.
    pub chart: Chart,
    /// Momenta were integrated, not velocities.
    pub momentum: bool,
    /// What came of it.
    pub outcome: Result<Outcome, Refusal>,
}

/// A body in one chart, with the clauses of what acts on it.
macro_rules! body {
    (
        $name:ident, ($($chart:tt)*), $motion:ident, [$($clauses:tt)*],
        { $([$($role:tt)*] $field:ident: ($($type:tt)*)),* $(,)? }
    ) => {
        #[derive(GaussDynamics)]
        #[gauss(chart = $($chart)*, motion = $motion, $($clauses)*)]
        struct $name {
            $(#[gauss($($role)*)] $field: $($type)*),*
        }

        impl $name {
            fn of(scene: &Scene) -> Self {
                Self { $($field: scene.parameters.$field),* }
            }
        }
    };
}

/// A body in every chart, and `rows`, which runs them all over a scene in both forms.
macro_rules! every_chart {
    ($(#[$documentation:meta])* $module:ident, $motion:ident, $fields:tt) => {
        every_chart! { $(#[$documentation])* $module, $motion, [], $fields }
    };
    ($(#[$documentation:meta])* $module:ident, $motion:ident, $clauses:tt, $fields:tt) => {
        $(#[$documentation])*
        pub mod $module {
            use super::*;

            every_chart!(@ $motion, $clauses, $fields,
                Left = (left_invariant),
                Right = (right_invariant),
                Hybrid = (hybrid),
                Zyx = (jet(euler_zyx)),
                Zxz = (jet(euler_zxz)),
                Rodrigues = (jet(rodrigues)),
                ModifiedRodrigues = (jet(modified_rodrigues)),
            );
        }
    };
    (@ $motion:ident, $clauses:tt, $fields:tt, $($name:ident = $chart:tt),* $(,)?) => {
        $(body!($name, $chart, $motion, $clauses, $fields);)*

        /// The kernels whose configuration is a group, for runs in velocity form with any steps.
        #[allow(dead_code)] // The order is measured on two of the bodies.
        pub fn on_the_group(scene: &Scene, control: Order8) -> [Result<Outcome, Refusal>; 3] {
            let left = Left::of(scene).kernel().expect("a body");
            let right = Right::of(scene).kernel().expect("a body");
            let hybrid = Hybrid::of(scene).kernel().expect("a body");
            [
                run(scene, &left, &left, VelocityForm, control),
                run(scene, &left, &right, VelocityForm, control),
                run(scene, &left, &hybrid, VelocityForm, control),
            ]
        }

        /// Every chart over the scene, in velocity form and in momentum form.
        pub fn rows(scene: &Scene, control: Order8) -> Vec<Row> {
            let left = Left::of(scene).kernel().expect("a body");
            let mut rows = Vec::new();
            $({
                let kernel = $name::of(scene).kernel().expect("a body");
                let chart = chart_of(&kernel);
                let outcome = run(scene, &left, &kernel, VelocityForm, control);
                rows.push(Row { chart, momentum: false, outcome });
                let outcome = run(scene, &left, &kernel, MomentumForm, control);
                rows.push(Row { chart, momentum: true, outcome });
            })*
            rows
        }
    };
}

fn chart_of<S: GaussSystem>(_: &S) -> Chart {
    S::CHART
}

every_chart! {
    /// No forces, principal axes, O the centre of mass and fixed.
    free_top, fixed_point, {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
    }
}

every_chart! {
    /// The same, not held.
    free_body, free, {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
    }
}

every_chart! {
    /// A fixed point and weight.
    heavy_top, fixed_point, {
        [mass] mass: (f64),
        [center_of_mass] center: (Vector3<f64>),
        [inertia] inertia: (Matrix3<f64>),
        [gravity] gravity: (f64),
    }
}

every_chart! {
    /// No forces, O anywhere.
    drifting_body, free, {
        [mass] mass: (f64),
        [center_of_mass] center: (Vector3<f64>),
        [inertia] inertia: (Matrix3<f64>),
    }
}

every_chart! {
    /// Weight, O anywhere.
    projectile, free, {
        [mass] mass: (f64),
        [center_of_mass] center: (Vector3<f64>),
        [inertia] inertia: (Matrix3<f64>),
        [gravity] gravity: (f64),
    }
}

every_chart! {
    /// Weight at O, principal axes.
    needle, free, {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
        [gravity] gravity: (f64),
    }
}

every_chart! {
    /// Kirchhoff's body: a fluid, no forces.
    kirchhoff, free, {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
        [added_mass] added: (Matrix6<f64>),
    }
}

every_chart! {
    /// A fluid, weight and buoyancy.
    submerged, free, {
        [mass] mass: (f64),
        [center_of_mass] center: (Vector3<f64>),
        [inertia] inertia: (Matrix3<f64>),
        [added_mass] added: (Matrix6<f64>),
        [gravity] gravity: (f64),
        [displaced_mass] displaced: (f64),
        [center_of_buoyancy] buoyancy: (Vector3<f64>),
    }
}

every_chart! {
    /// Weight, linear drag and a push of the observer's at a point off O, each by the clause that is made for it.
    dragged, free, [
        drag(linear = [0.4, 0.4, 0.4, 0.05, 0.05, 0.05]),
        force(push, at = [0.2, 0, 0.1], value = [1, 2, 0.5], axes = observer),
    ], {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
        [gravity] gravity: (f64),
    }
}

every_chart! {
    /// The same as forces and torques by formulas: drag as a wrench in the velocities, the push by its lever.
    dragged_by_formulas, free, [
        define(u = body.body_velocity, w = body.body_angular_velocity),
        define(push = inverse(body.rotation) * [1, 2, 0.5]),
        wrench(friction, force = -0.4 * u, torque = -0.05 * w),
        force(push_at_o, body = body, value = push),
        torque(lever, value = cross([0.2, 0, 0.1], push)),
    ], {
        [mass] mass: (f64),
        [inertia] principal: (Vector3<f64>),
        [gravity] gravity: (f64),
    }
}
