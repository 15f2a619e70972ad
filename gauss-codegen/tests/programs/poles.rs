//! Poles and axes of links are choices of whoever describes them: no program costs more for it, and none gives other
//! numbers.

use crate::common::{Random, close, random_arguments};
use gauss_codegen::Derivation;

/// A floating trunk with three legs of three hinges about x, y and y; the poles of all links are moved along their axes
/// by these multiples of 1/32, their own and nothing else of the legs.
fn legs([hip, thigh, shank]: [i32; 3]) -> String {
    let leg = |side: &str, sign: f64| {
        let [hip, thigh, shank] = [hip, thigh, shank].map(|way| sign * f64::from(way) / 32.0);
        let body = |name: &str, parent: &str, position: [f64; 3], turn: &str, center: [f64; 3]| {
            format!(
                "body({side}_{name}, parent = {parent}, position = {position:?}, rotation = {turn}, mass = 1.5, \
                 center_of_mass = {center:?}, inertia_about_center_of_mass = [0.0625, 0.03125, 0.015625]),"
            )
        };
        let (parent, above) = (format!("{side}_hip"), format!("{side}_thigh"));
        let turns = ["x", "y", "y"].into_iter().zip(["a", "b", "c"]);
        let turns: Vec<String> = turns.map(|(axis, angle)| format!("rotation_{axis}({side}_{angle})")).collect();
        [
            body("hip", "trunk", [0.25 + hip, 0.125 * sign, 0.0], &turns[0], [0.0625 - hip, 0.0, 0.015625]),
            body("thigh", &parent, [0.0625 - hip, 0.0625 + thigh, 0.0], &turns[1], [0.0, 0.125 - thigh, -0.25]),
            body("shank", &above, [0.0, 0.125 + shank - thigh, -0.25], &turns[2], [0.0625, 0.03125 - shank, -0.125]),
        ]
        .concat()
    };
    format!(
        "#[gauss(coordinates(base: Pose, left_a, left_b, left_c, right_a, right_b, right_c, \
         rear_a, rear_b, rear_c), \
         body(trunk, position = base.position, rotation = base.rotation, mass = 16.0, \
         inertia_about_center_of_mass = [0.25, 0.5, 0.75]), {} {} {} \
         force(push, body = left_shank, at = [0, {}, -0.25], value = [1.0, 2.0, 3.0], axes = observer), \
         gravity = 9.81)] struct Legs {{}}",
        leg("left", 1.0),
        leg("right", -1.0),
        leg("rear", 1.0),
        0.03125 - f64::from(shank) / 32.0,
    )
}

fn derivation(source: &str) -> Derivation {
    Derivation::of_source(source, "Legs").unwrap_or_else(|error| panic!("{error}\n{source}"))
}

#[test]
fn legs_by_other_poles() {
    let [given, moved] = [[0, 0, 0], [5, -3, 2]].map(|ways| derivation(&legs(ways)));
    for method in ["acceleration", "gauss_residual", "mass_matrix", "momentum", "kinetic_energy"] {
        let [a, b] = [&given, &moved].map(|legs| legs.program(method).expect("a method of every system"));
        // What needs no forces may be formed by the poles that were given, where that is shorter.
        if !["momentum", "kinetic_energy"].contains(&method) {
            assert_eq!(a.code.counts(), b.code.counts(), "{method}");
        }
        let arguments = random_arguments(&given, a, &mut Random(3));
        let arguments: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let [a, b] = [a, b].map(|program| program.run(&arguments).expect("its own arguments"));
        assert!(a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| close(*a, *b)), "{method}: {a:?} {b:?}");
    }
}
