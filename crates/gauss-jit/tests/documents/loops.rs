//! Loops as equalities of MJCF: points that two bodies share, and constraints that are none.

use gauss_jit::{DocumentError, Mjcf};

use crate::scenes::examples;

/// Two arms whose ends meet; the second is turned where it hangs.
const ARMS: &str = "coordinates(a, b, turn: Rotation), gravity = 9.81,
    body(one, rotation = rotation_x(a), mass = 1, inertia = 1),
    body(two, parent = one, position = [0, 0, 1], rotation = turn, mass = 1, inertia = 1),
    body(three, position = [0.5, 0, 0], rotation = rotation_y(b) * rotation_z(0.3), mass = 1, inertia = 1),
    point(hand, body = two, at = [0.1, 0.2, 0.3]), point(other, body = three, at = [0, 0.4, 1])";

fn made(clauses: &str) -> Result<Mjcf, DocumentError> {
    Mjcf::new(&format!("#[gauss({clauses})] struct Scene {{}}"), &[])
}

#[test]
fn shared_points_are_sites_that_are_connected() {
    let parallelogram = examples().iter().find(|own| own.name == "parallelogram").expect("a scene").mjcf();
    for part in [
        "<site name=\"loop_1_from\" pos=\"0.5 0 0\"/>",
        "<site name=\"loop_1_to\" pos=\"0.3 0 0\"/>",
        "<connect name=\"loop_1\" site1=\"loop_1_from\" site2=\"loop_1_to\"/>",
    ] {
        assert!(parallelogram.xml().contains(part), "{part}\n{}", parallelogram.xml());
    }
    assert!(parallelogram.lost().iter().any(|line| line.contains("soft equalities")));
    // In whatever axes, and two at once.
    for residual in ["hand - other", "other - hand", "inverse(two.rotation) * (hand - other)"] {
        let made =
            made(&format!("{ARMS}, constraint(position = {residual})")).unwrap_or_else(|error| panic!("{error}"));
        let sites =
            made.xml().lines().filter(|line| line.contains("<site")).map(str::trim).collect::<Vec<_>>().join("");
        assert!(sites.contains("pos=\"0.1 0.2 0.3\"") && sites.contains("pos=\"0 0.4 1\""), "{residual}: {sites}");
    }
}

#[test]
fn other_constraints_are_refused() {
    let ball = "coordinates(x, y), particle(mass = 1, position = [x, y, 0])";
    for (clauses, words) in [
        (format!("{ball}, constraint(position = x * x + y * y - 1)"), "equation 1 of 1 is none of a point"),
        (format!("{ball}, constraint(velocity = rate(x) - y * rate(y))"), "equation 1 of 1 is one of velocities"),
        (format!("{ball}, constraint(position = x - sin(t))"), "depends on the time"),
        // Two bodies that share a point anyway, with a constraint of their rates.
        (
            "coordinates(a, b), body(one, rotation = rotation_x(a), mass = 1, inertia = 1),
             body(two, rotation = rotation_x(b), mass = 1, inertia = 1), constraint(velocity = rate(a) - 2 * rate(b))"
                .to_owned(),
            "equation 1 of 1 is one of velocities",
        ),
        (format!("{ARMS}, constraint(position = hand - other), constraint(position = a - b)"), "equation 4 of 4"),
    ] {
        match made(&clauses) {
            Err(DocumentError::NoCounterpart { list, .. }) => assert!(list[0].contains(words), "{clauses}: {list:?}"),
            other => panic!("{clauses}: {other:?}"),
        }
    }
}
