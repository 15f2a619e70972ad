//! A scene pays for nothing that it lacks: the operation counts of the generated code, feature by feature, and the
//! table of them in docs/benchmarks/operations.md.

use std::fmt::Write as _;

use crate::common::body::Scene;
use gauss_runtime::accuracy::Accuracy;
use gauss_runtime::description::{OperationCount, Operations};
use gauss_runtime::prelude::*;
use gauss_tests::pages::keep;

macro_rules! charts {
    ($($module:ident: { $($role:ident $field:ident: $type:ty),+ })+) => {$(
        mod $module {
            scene!(Left LeftKernel, free, [left_invariant], { $($role $field: $type),+ });
            scene!(Right RightKernel, free, [right_invariant], { $($role $field: $type),+ });
            scene!(Hybrid HybridKernel, free, [hybrid], { $($role $field: $type),+ });
            scene!(Jet JetKernel, free, [jet(euler_zyx)], { $($role $field: $type),+ });
        }
    )+};
}

// Each scene adds one feature to, or generalises one feature of, a scene above it.
charts! {
    spherical: { mass mass: T, inertia spherical: T }
    principal: { mass mass: T, inertia principal: super::Vector3<T> }
    full: { mass mass: T, inertia inertia: super::Matrix3<T> }
    heavy: { mass mass: T, inertia principal: super::Vector3<T>, gravity g: T }
    field: { mass mass: T, inertia principal: super::Vector3<T>, gravity field: super::Vector3<T> }
    off_center: { mass mass: T, center_of_mass center: super::Vector3<T>, inertia principal: super::Vector3<T> }
    off_center_full: { mass mass: T, center_of_mass center: super::Vector3<T>, inertia inertia: super::Matrix3<T> }
    off_center_heavy: {
        mass mass: T, center_of_mass center: super::Vector3<T>, inertia inertia: super::Matrix3<T>, gravity g: T
    }
    immersed: { mass mass: T, inertia principal: super::Vector3<T>, added_mass diagonal_fluid: super::Vector6<T> }
    immersed_full: { mass mass: T, inertia principal: super::Vector3<T>, added_mass fluid: super::Matrix6<T> }
    everything: {
        mass mass: T, center_of_mass center: super::Vector3<T>, inertia inertia: super::Matrix3<T>,
        added_mass fluid: super::Matrix6<T>, gravity g: T
    }
}

/// The counts of a scene, chart by chart, in the order of [`CHARTS`].
struct Costs {
    name: &'static str,
    charts: [Operations; 4],
    losses: [Accuracy; 4],
}

const CHARTS: [&str; 4] = ["left_invariant", "right_invariant", "hybrid", "jet(euler_zyx)"];

fn operations<S: Scene>() -> Operations {
    <S::Kernel<f64> as DescribedSystem>::OPERATIONS
}

fn accuracy<S: Scene>() -> Accuracy {
    <S::Kernel<f64> as DescribedSystem>::ACCURACY
}

macro_rules! costs {
    ($name:literal, $module:ident) => {
        Costs {
            name: $name,
            charts: [
                operations::<$module::Left<()>>(),
                operations::<$module::Right<()>>(),
                operations::<$module::Hybrid<()>>(),
                operations::<$module::Jet<()>>(),
            ],
            losses: [
                accuracy::<$module::Left<()>>(),
                accuracy::<$module::Right<()>>(),
                accuracy::<$module::Hybrid<()>>(),
                accuracy::<$module::Jet<()>>(),
            ],
        }
    };
}

fn scenes() -> Vec<Costs> {
    vec![
        costs!("spherical", spherical),
        costs!("principal axes", principal),
        costs!("full inertia", full),
        costs!("principal axes, gravity", heavy),
        costs!("principal axes, gravity in any direction", field),
        costs!("principal axes, centre of mass off O", off_center),
        costs!("full inertia, centre of mass off O", off_center_full),
        costs!("full inertia, centre of mass off O, gravity", off_center_heavy),
        costs!("principal axes, diagonal added mass", immersed),
        costs!("principal axes, full added mass", immersed_full),
        costs!("everything", everything),
    ]
}

/// (the poorer scene, the richer one), by position in [`scenes`].
const RICHER: [(usize, usize); 14] = [
    (0, 1),
    (1, 2),
    (1, 3),
    (3, 4),
    (1, 5),
    (2, 6),
    (5, 6),
    (6, 7),
    (1, 8),
    (8, 9),
    (2, 10),
    (6, 10),
    (7, 10),
    (9, 10),
];

/// Chart, method, and two scenes of which the poorer is given the dearer form, because the cheaper one loses digits
/// there: the loss of every form is measured scene by scene.
const DEARER_FOR_ACCURACY: [[&str; 4]; 0] = [];

#[test]
fn a_feature_never_makes_a_method_cheaper() {
    type Method = (&'static str, fn(&Operations) -> OperationCount);
    let methods: [Method; 6] = [
        ("acceleration", |o| o.acceleration),
        ("momentum", |o| o.momentum),
        ("velocity", |o| o.velocity),
        ("momentum_rate", |o| o.momentum_rate),
        ("kinetic_energy", |o| o.kinetic_energy),
        ("potential_energy", |o| o.potential_energy),
    ];
    let scenes = scenes();
    let mut wrong = String::new();
    for (poorer, richer) in RICHER.map(|(a, b)| (&scenes[a], &scenes[b])) {
        for (chart, (a, b)) in CHARTS.iter().zip(poorer.charts.iter().zip(&richer.charts)) {
            for (method, count) in methods {
                let (poorer, richer, a, b) = (poorer.name, richer.name, count(a), count(b));
                // What is listed has to be so.
                let listed = DEARER_FOR_ACCURACY.contains(&[*chart, method, poorer, richer]);
                if (a.total() > b.total()) != listed {
                    writeln!(wrong, "{chart} {method}: `{poorer}` costs {a}, `{richer}` {b}").expect("a string");
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn what_is_absent_costs_nothing() {
    let scenes = scenes();
    for scene in &scenes {
        let [left, right, hybrid, jet] = &scene.charts;
        let heavy = scene.name.contains("gravity") || scene.name == "everything";
        for operations in [left, right, hybrid, jet] {
            assert_eq!(operations.potential_energy.total() > 0, heavy, "{}", scene.name);
            // Divisions by what is constant are made once, in `kernel()`; angles leave one by a cosine.
            assert_eq!(operations.potential_energy.divisions, 0, "{}", scene.name);
        }
        // Neither angles nor roots where the configuration is a pose.
        for operations in [left, right, hybrid] {
            assert_eq!(operations.acceleration.transcendentals, 0, "{}", scene.name);
            assert_eq!(operations.acceleration.roots, 0, "{}", scene.name);
            assert_eq!(operations.acceleration.divisions, 0, "{}", scene.name);
        }
        // Conserved in space without forces: no code at all.
        assert_eq!(right.momentum_rate.total() > 0, heavy, "{}", scene.name);
    }
    // A ball in empty space: u̇ = u × ω and nothing else in body axes, no acceleration at all in the observer's.
    let [left, _, hybrid, _] = &scenes[0].charts;
    assert_eq!((left.acceleration.additions, left.acceleration.multiplications), (3, 6));
    assert_eq!(hybrid.acceleration.total(), 0);
    // Euler's equations: ω̇₁ = k₁ ω₂ω₃ is two multiplications a line.
    let [left, _, hybrid, _] = &scenes[1].charts;
    assert_eq!((left.acceleration.additions, left.acceleration.multiplications), (3, 12));
    assert_eq!((hybrid.acceleration.additions, hybrid.acceleration.multiplications), (0, 6));
}

/// The section of that page between the markers: additions + multiplications of each method, and what two of them
/// lose.
fn table() -> String {
    let mut out = String::from(
        "| scene | chart | acceleration | momentum rate | kinetic energy | loss of acceleration | of momentum rate |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for scene in scenes() {
        for ((chart, operations), losses) in CHARTS.iter().zip(&scene.charts).zip(&scene.losses) {
            let cell = |count: OperationCount| format!("{} + {}", count.additions, count.multiplications);
            let (acceleration, rate, energy) =
                (cell(operations.acceleration), cell(operations.momentum_rate), cell(operations.kinetic_energy));
            let name = scene.name;
            let (of_acceleration, of_rate) = (losses.acceleration, losses.momentum_rate);
            writeln!(
                out,
                "| {name} | `{chart}` | {acceleration} | {rate} | {energy} | {of_acceleration} | {of_rate} |"
            )
            .expect("a string");
        }
    }
    out
}

#[test]
fn benchmarks_shows_the_counts() {
    keep("docs/benchmarks/operations.md", "operations", &table());
}

/// The section of the README: what the same body costs in each chart, and what else there is to it.
#[test]
fn readme_shows_what_charts_cost() {
    const SHOWN: [&str; 3] =
        ["principal axes", "full inertia, centre of mass off O, gravity", "principal axes, full added mass"];
    const CONSEQUENCES: [[&str; 2]; 4] = [
        ["u, ω in body axes", "the mass matrix is constant"],
        ["ξ, ω̂ about Ω", "without forces momenta are kept to the last bit"],
        ["ḃ, ω", "a weight costs nothing; far from Ω all digits stay"],
        ["ḃ, ψ̇ θ̇ φ̇", "singular at a pitch of 90°, which is a typed error"],
    ];
    let scenes = scenes();
    let mut out = String::from(
        "| chart | z | at G | off G, weight | added mass 6×6 | |\n\
         |---|---|---|---|---|---|\n",
    );
    for (n, (chart, [speeds, consequence])) in CHARTS.iter().zip(CONSEQUENCES).enumerate() {
        write!(out, "| `{chart}` | {speeds} |").expect("a string");
        for name in SHOWN {
            let scene = scenes.iter().find(|scene| scene.name == name).expect(name);
            let count = scene.charts[n].acceleration;
            write!(out, " {} + {} |", count.additions, count.multiplications).expect("a string");
        }
        writeln!(out, " {consequence} |").expect("a string");
    }
    out += "| own: `speeds`, `kinematics` | yours | | | | speeds that solve a constraint need no multiplier |\n";
    keep("README.md", "charts", &out);
}
