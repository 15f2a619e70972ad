//! The reference scenes of one body, at their initial and final states, and some steps of a run from each.

use gauss_tests::scene::{Scene as Reference, State as Published};

use crate::common::body::rotation_matrix;
use crate::common::parameters::Parameters;
use crate::common::states::State;
use crate::compare::Excess;
use crate::random::holds;

const FREE: [&str; 12] = [
    "free_asym_top",
    "free_near_separatrix",
    "hlw_free_body",
    "free_far_from_Omega",
    "projectile_offcentre",
    "needle_free",
    "kirchhoff_case_symmetric",
    "kirchhoff_clebsch",
    "kirchhoff_nonintegrable",
    "kirchhoff_buoyant",
    "full_added_mass",
    "drag_body",
];

const HELD: [&str; 11] = [
    "free_asym_top",
    "free_near_separatrix",
    "hlw_free_body",
    "bruls_heavy_top",
    "gimbal_crossing_top",
    "heavy_asym_top",
    "hlw_heavy_top",
    "kovalevskaya",
    "lagrange_top",
    "simo_wong_top",
    "goryachev_chaplygin",
];

mod free {
    usual_charts!(everything, free);
}

mod held {
    usual_charts!(heavy, fixed_point);
}

fn parameters(scene: &Reference) -> Parameters {
    let p = &scene.parameters;
    Parameters {
        m: p.mass,
        c: p.center.into(),
        principal: p.principal.into(),
        full: std::array::from_fn(|i| std::array::from_fn(|j| p.inertia[(i, j)])),
        diagonal_fluid: std::array::from_fn(|i| p.added[(i, i)]),
        fluid: std::array::from_fn(|i| std::array::from_fn(|j| p.added[(i, j)])),
        g: p.gravity,
        field: [0.0, 0.0, -p.gravity],
        displaced: p.displaced,
        buoyancy: p.buoyancy.into(),
    }
}

fn state(at: &Published) -> State {
    let rotation = at.pose().rotation.coords.into();
    State { rotation, position: at.b.into(), twist: at.twist().into(), direction: [0.0; 6] }
}

macro_rules! every_chart {
    ($module:ident, $names:ident) => {{
        let mut excess = Excess::default();
        for name in $names {
            let scene = Reference::load(name);
            let parameters = parameters(&scene);
            for at in [&scene.initial, &scene.last] {
                let state = state(at);
                // A thirtieth of a radian, as fixed steps are.
                let step = Some(0.03 / at.omega.norm().max(1.0));
                macro_rules! chart {
                    ($chart:ident) => {
                        let what = format!("{name}, {}", stringify!($chart));
                        holds::<$module::$chart<()>>(&what, &parameters, &state, step, &mut excess);
                    };
                }
                chart!(Left);
                chart!(Right);
                chart!(Hybrid);
                chart!(Modified);
            }
        }
        assert!(excess.report(concat!("references, ", stringify!($module))) < 200.0);
    }};
}

#[test]
fn free_bodies() {
    every_chart!(free, FREE);
}

#[test]
fn held_bodies() {
    every_chart!(held, HELD);
}

#[test]
fn states_are_read_as_published() {
    let scene = Reference::load("heavy_asym_top");
    let matrix = rotation_matrix(&state(&scene.initial).rotation);
    assert!((0..9).all(|i| (matrix[i / 3][i % 3] - scene.initial.rotation[(i / 3, i % 3)]).abs() < 4.0 * f64::EPSILON));
}
