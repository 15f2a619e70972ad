//! What each element that acts costs: the operation counts of one body as elements are switched on, one at a time, and
//! the table of them in docs/benchmarks/operations.md. That a clause leaves nothing behind when it is taken out again
//! is tested where the code is made, in `gauss-codegen/src/emit/specialisation_tests.rs`.

use std::fmt::Write as _;

use gauss_runtime::description::{OperationCount, Operations};
use gauss_tests::pages::keep;

/// The same body with the same clauses in four charts.
macro_rules! in_charts {
    ($($module:ident: [$($clause:tt)*] { $($field:tt)* })+) => {$(
        mod $module {
            use gauss_runtime::description::Operations;
            use gauss_runtime::prelude::*;

            in_charts!(@one Left, [left_invariant], [$($clause)*], $($field)*);
            in_charts!(@one Right, [right_invariant], [$($clause)*], $($field)*);
            in_charts!(@one Hybrid, [hybrid], [$($clause)*], $($field)*);
            in_charts!(@one Jet, [jet(euler_zyx)], [$($clause)*], $($field)*);

            pub fn operations() -> [Operations; 4] {
                [LeftKernel::OPERATIONS, RightKernel::OPERATIONS, HybridKernel::OPERATIONS, JetKernel::OPERATIONS]
            }
        }
    )+};
    (@one $name:ident, [$($chart:tt)*], [$($clause:tt)*], $($field:tt)*) => {
        #[derive(GaussDynamics)]
        #[gauss(chart = $($chart)*, $($clause)*)]
        #[allow(dead_code, reason = "only counts are asked for")]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(inertia)]
            inertia: Vector3<f64>,
            $($field)*
        }
    };
}

in_charts! {
    nothing: [] {}
    weight: [] { #[gauss(gravity)] g: f64 }
    center_off: [] { #[gauss(center_of_mass)] center: Vector3<f64> }
    weight_off: [] { #[gauss(gravity)] g: f64, #[gauss(center_of_mass)] center: Vector3<f64> }
    buoyancy: [] {
        #[gauss(gravity)] g: f64, #[gauss(displaced_mass)] displaced: f64, #[gauss(center_of_buoyancy)] center: Vector3<f64>
    }
    central: [central_gravity(attraction, mu = mu, center = [0, 0, 0])] { mu: f64 }
    added: [] { #[gauss(added_mass)] fluid: Vector6<f64> }
    added_full: [] { #[gauss(added_mass)] fluid: Matrix6<f64> }
    linear: [drag(linear = d)] { d: Vector6<f64> }
    linear_full: [drag(linear = d)] { d: Matrix6<f64> }
    quadratic: [drag(quadratic = d)] { d: Vector6<f64> }
    quadratic_full: [drag(quadratic = d)] { d: Matrix6<f64> }
    stream: [medium(velocity = [c.x, c.y, c.z]), drag(linear = d)] { c: Vector3<f64>, d: Vector6<f64> }
    added_stream: [medium(velocity = [c.x, c.y, c.z])] { c: Vector3<f64>, #[gauss(added_mass)] fluid: Vector6<f64> }
    thrust: [input(thrust), force(body = body, value = [thrust, 0, 0])] {}
    thruster: [input(thrust), force(at = at, value = [thrust, 0, 0])] { at: Vector3<f64> }
    towed: [input(rope: Vector3), force(at = at, value = rope, axes = observer)] { at: Vector3<f64> }
    spring: [point(hook, body = body, at = at), spring(from = [0, 0, 0], to = hook, stiffness = k, length = rest)] {
        at: Vector3<f64>, k: f64, rest: f64
    }
    motor: [input(motor: Vector3), torque(value = motor)] {}
    gust: [input(gust: Wrench), wrench(force = gust.force, torque = gust.torque)] {}
    lift: [force(body = body, value = [0, 0, -c * body.body_velocity.x * body.body_velocity.z])] { c: f64 }
    all: [
        input(thrust, gust: Wrench),
        medium(velocity = [c.x, c.y, c.z]),
        drag(linear = d, quadratic = dd),
        force(thruster, at = at, value = [thrust, 0, 0]),
        wrench(force = gust.force, torque = gust.torque)
    ] {
        #[gauss(center_of_mass)] center: Vector3<f64>,
        #[gauss(gravity)] g: f64,
        #[gauss(displaced_mass)] displaced: f64,
        #[gauss(center_of_buoyancy)] buoyancy: Vector3<f64>,
        #[gauss(added_mass)] fluid: Matrix6<f64>,
        c: Vector3<f64>,
        d: Matrix6<f64>,
        dd: Vector6<f64>,
        at: Vector3<f64>
    }
}

/// The counts of a scene, chart by chart.
struct Costs {
    name: &'static str,
    /// The scene that is this one without its last element, by position in [`scenes`].
    without: Option<usize>,
    charts: [Operations; 4],
}

const CHARTS: [&str; 4] = ["left_invariant", "right_invariant", "hybrid", "jet(euler_zyx)"];

fn scenes() -> Vec<Costs> {
    let row = |name, without, charts| Costs { name, without, charts };
    vec![
        row("nothing", None, nothing::operations()),
        row("weight", Some(0), weight::operations()),
        row("no weight, but the centre of mass off O", Some(0), center_off::operations()),
        row("weight, the centre of mass off O", Some(2), weight_off::operations()),
        row("weight, and buoyancy off O", Some(1), buoyancy::operations()),
        row("central attraction with its gradient torque", Some(0), central::operations()),
        row("added mass, diagonal", Some(0), added::operations()),
        row("added mass, 6×6", Some(6), added_full::operations()),
        row("added mass, diagonal, in a stream", Some(6), added_stream::operations()),
        row("linear drag, diagonal", Some(0), linear::operations()),
        row("linear drag, 6×6", Some(9), linear_full::operations()),
        row("linear drag, diagonal, in a stream", Some(9), stream::operations()),
        row("quadratic drag, diagonal", Some(0), quadratic::operations()),
        row("quadratic drag, 6×6", Some(12), quadratic_full::operations()),
        row("lift ∝ u₁ u₃ at O", Some(0), lift::operations()),
        row("an input for a force along e₁ at O", Some(0), thrust::operations()),
        row("the same at a point of the body", Some(15), thruster::operations()),
        row("an input for a force in observer's axes at a point of the body", Some(0), towed::operations()),
        row("an input for a torque", Some(0), motor::operations()),
        row("an input for a wrench", Some(18), gust::operations()),
        row("a spring from Ω to a point of the body", Some(0), spring::operations()),
        row("a vehicle in a stream", Some(7), all::operations()),
    ]
}

#[test]
fn an_element_never_makes_acceleration_cheaper() {
    let scenes = scenes();
    for scene in &scenes {
        let Some(without) = scene.without.map(|n| &scenes[n]) else { continue };
        for (chart, (more, less)) in CHARTS.iter().zip(scene.charts.iter().zip(&without.charts)) {
            let (more, less) = (more.acceleration, less.acceleration);
            let names = (scene.name, without.name);
            assert!(more.total() >= less.total(), "{chart}: {names:?} cost {more} and {less}");
        }
    }
}

/// With principal axes at the centre of mass in body axes each component of force and torque has one line of its own.
#[test]
fn a_component_in_its_own_axes_is_one_sum_and_one_product() {
    let cost = |operations: [Operations; 4]| {
        let OperationCount { additions, multiplications, .. } = operations[0].acceleration;
        [additions, multiplications]
    };
    let [additions, multiplications] = cost(nothing::operations());
    let with = |lines: u32, products: u32| [additions + lines, multiplications + products];
    assert_eq!(cost(thrust::operations()), with(1, 1));
    assert_eq!(cost(motor::operations()), with(3, 3));
    assert_eq!(cost(gust::operations()), with(6, 6));
    // |V| V is one product more than V.
    let [a, m] = cost(linear::operations());
    let [b, n] = cost(quadratic::operations());
    assert_eq!(b - a, 6, "a magnitude counts as an addition");
    assert_eq!(n - m, 6);
}

/// The section of that page between the markers: additions + multiplications of `acceleration`, and what else there
/// is.
fn table() -> String {
    let mut out = String::from("| what acts |");
    CHARTS.iter().for_each(|chart| write!(out, " `{chart}` |").expect("a string"));
    out += "\n|---|---|---|---|---|\n";
    let scenes = scenes();
    for scene in &scenes {
        write!(out, "| {} |", scene.name).expect("a string");
        for (operations, bare) in scene.charts.iter().zip(&scenes[0].charts) {
            let count = operations.acceleration;
            write!(out, " {} + {}", count.additions, count.multiplications).expect("a string");
            out += &" ÷".repeat((count.divisions - bare.acceleration.divisions) as usize);
            out += &" √".repeat(count.roots as usize);
            out += " |";
        }
        out += "\n";
    }
    out
}

#[test]
fn benchmarks_shows_what_elements_cost() {
    keep("docs/benchmarks/operations.md", "specialisation", &table());
}

/// The section of the guide: what some of them add, in body axes and in Euler angles.
#[test]
fn readme_shows_what_elements_add() {
    const SHOWN: [[&str; 3]; 5] = [
        ["weight", "role `gravity`", "weight"],
        ["a spring to a point of the body", "`spring`", "a spring from Ω to a point of the body"],
        ["drag, six coefficients", "`drag`", "quadratic drag, diagonal"],
        ["a thruster at a point of the body", "`input`, `force`", "the same at a point of the body"],
        ["added mass, six numbers", "role `added_mass`", "added mass, diagonal"],
    ];
    let scenes = scenes();
    let mut out = String::from("| what acts | by | body axes | Euler angles |\n|---|---|---|---|\n");
    for [shown, by, name] in SHOWN {
        let scene = scenes.iter().find(|scene| scene.name == name).expect(name);
        let [left, jet] = [0, 3].map(|chart: usize| {
            let (more, bare) = (scene.charts[chart].acceleration, scenes[0].charts[chart].acceleration);
            let root = " √".repeat((more.roots - bare.roots) as usize);
            let division = " ÷".repeat((more.divisions - bare.divisions) as usize);
            let (sums, products) = (more.additions - bare.additions, more.multiplications - bare.multiplications);
            format!("{sums} + {products}{division}{root}")
        });
        writeln!(out, "| {shown} | {by} | {left} | {jet} |").expect("a string");
    }
    keep("guide/src/loads.md", "acting", &out);
}
