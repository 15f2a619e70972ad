//! Coordinates, speeds and kinematics; clauses that contradict a system or are written wrongly.

use super::super::{ALL_CLAUSES, check};
use super::{particle, system};

/// A particle on a line, with other clauses of motion.
fn moving(clauses: &str) -> String {
    format!("#[gauss({clauses}, particle(mass = m, position = [x, y, 0]))] struct Scene {{ m: f64 }}")
}

#[test]
fn declarations() {
    check(&moving("coordinates(x, y, x)"), &[("x", "the coordinate `x` is declared twice; remove one of the two")]);
    check(
        &moving("coordinates(x, y, m, t, sin)"),
        &[
            ("m", "`m` names a field and a coordinate; rename one of the two"),
            ("t", "`t` is time in expressions and cannot name a coordinate; rename it"),
            ("sin", "`sin` is a function of expressions and cannot name a coordinate; rename it"),
        ],
    );
    check(
        &moving("coordinates(x, y), speeds(x, v), kinematics(x = v, y = v)"),
        &[("x", "`x` names a coordinate and a speed; rename one of the two")],
    );
    check(
        &particle("", "cross: f64").replace(", )]", ")]"),
        &[("cross", "`cross` is a function of expressions and cannot name a field; rename it")],
    );
    check(&moving("coordinates(x: f64, y)"), &[(":", "a scalar coordinate has no type; write `x`")]);
    check(&moving("coordinates(x y)"), &[("y", "expected `,` after `x`, found `y`; separate names by commas")]);
    check(&moving("coordinates(x, 2)"), &[("2", "expected the name of a coordinate, found the literal `2`")]);
    check(&moving("coordinates(x, y, if)"), &[("if", "`if` is a keyword of Rust and cannot name a coordinate")]);
    check(
        &moving("coordinates()"),
        &[("(", "`coordinates()` is empty; write `coordinates(x, y, theta)` or remove it")],
    );
    check(
        &moving("coordinates = x"),
        &[("x", "`coordinates` takes brackets, not `=`; write `coordinates(x, y, theta)`")],
    );
    check(
        &moving("coordinates(x, y), coordinates(x)"),
        &[("coordinates", "`coordinates` is given twice; write all of it in one")],
    );
}

#[test]
fn missing() {
    check(
        "#[gauss(particle(mass = m, position = [x, y, 0]))] struct Scene { m: f64 }",
        &[("particle", "the system has no coordinates; add `coordinates(…)` with their names")],
    );
    check(
        "#[gauss(coordinates(x), potential = k * x)] struct Scene { k: f64 }",
        &[(
            "coordinates",
            "the system has no body and no particle, so nothing in it has mass; \
             add `body(position = […], rotation = …)` or `particle(mass = …, position = […])`",
        )],
    );
    check(
        "#[gauss(coordinates(x), particle(), particle(mass = m), particle(position = [x, 0, 0], mas = m))] \
         struct Scene { m: f64 }",
        &[
            ("(", "`particle()` is empty; write `particle(mass = m, position = [x, y, z])` or remove it"),
            ("particle", "a particle needs its position; add `position = [x, y, z]`"),
            ("mas", "unknown argument of `particle`: `mas`; did you mean `mass`?"),
        ],
    );
}

#[test]
fn kinematics() {
    check(
        &moving("coordinates(x, y), speeds(v)"),
        &[("speeds", "`speeds` do not say how the coordinates change; add `kinematics(x = …, y = …)`")],
    );
    check(
        &moving("coordinates(x, y), kinematics(x = v, y = v)"),
        &[(
            "kinematics",
            "`kinematics` needs `speeds`, which it expresses the rates of the coordinates in; \
             add `speeds(…)`, or remove `kinematics` to have these rates for speeds",
        )],
    );
    check(
        &moving("coordinates(x, y), speeds(v), kinematics(x = v)"),
        &[("y", "the coordinate `y` has no kinematics; add `y = …` to `kinematics(…)`")],
    );
    check(
        &moving("coordinates(x, y, theta), speeds(v), kinematics(x = v, y = v, x = 2 * v, thta = v, v = 1, w = v)"),
        &[
            ("x", "`x` has kinematics twice; keep one of the two"),
            ("thta", "`thta` is no coordinate; did you mean `theta`?"),
            ("v", "`v` is a speed, not a coordinate; expected `x`, `y` or `theta`"),
            ("w", "`w` is no coordinate; expected `x`, `y` or `theta`"),
        ],
    );
    check(
        &moving("coordinates(x, y), speeds(v), kinematics(x: v, y)"),
        &[(":", "expected `=` or `,` after `x`, found `:`"), ("y", "`y` needs a value; write `y = v`")],
    );
    check(
        &moving("coordinates(x, y), speeds(v, w), kinematics(x = v, y = v)"),
        &[(
            "w",
            "no velocity depends on the speed `w`, so nothing determines its rate; \
             name it in `kinematics(…)` or remove it",
        )],
    );
    check(
        &moving("coordinates(x, y), speeds(v, w, u), kinematics(x = v + u, y = w)"),
        &[("u", "there are more speeds (3) than coordinates (2), so the velocities do not determine them; remove 1")],
    );
    check(
        &moving("coordinates(x, y, theta)"),
        &[(
            "theta",
            "no position and no rotation depends on the coordinate `theta`, so nothing determines its acceleration; \
             name it in one of them, give it an `armature`, or remove it",
        )],
    );
}

/// An armature is inertia of its own: what has one needs no body, and the others still do.
#[test]
fn armatures_are_inertia() {
    let clauses =
        "coordinates(x, y, ball: Rotation), armature(y = m, ball = 2), particle(mass = m, position = [x, 0, 0])";
    assert_eq!(system(&format!("#[gauss({clauses})] struct Scene {{ m: f64 }}")).armatures.len(), 2);
    let alone = "#[gauss(coordinates(y), armature(y = m))] struct Scene { m: f64 }";
    assert_eq!(system(alone).coordinates.len(), 1);
    check(
        "#[gauss(coordinates(x, y, w), armature(y = m), particle(mass = m, position = [x, 0, 0]))] \
         struct Scene { m: f64 }",
        &[(
            "w",
            "no position and no rotation depends on the coordinate `w`, so nothing determines its acceleration; \
             name it in one of them, give it an `armature`, or remove it",
        )],
    );
}

#[test]
fn places_of_speeds() {
    check(
        "#[gauss(coordinates(x), speeds(v), kinematics(x = v), potential = v * v, \
         body(position = [v, 0, 0], rotation = rotation_x(v)), particle(mass = m * x, position = [x, v, t]))] \
         struct Scene { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
        &[
            (
                "v",
                "`v` is a speed, and a position depends on coordinates, fields and `t` only; \
                 speeds stand in `kinematics`",
            ),
            (
                "v",
                "`v` is a speed, and a rotation depends on coordinates, fields and `t` only; \
                 speeds stand in `kinematics`",
            ),
            (
                "x",
                "`x` moves with the system, and the mass of a particle is given beforehand; write it in `t`, fields \
                 and numbers",
            ),
            (
                "v",
                "`v` is a speed, and a position depends on coordinates, fields and `t` only; \
                 speeds stand in `kinematics`",
            ),
            (
                "v",
                "`v` is a speed, and a potential depends on coordinates, fields and `t` only; \
                 write what depends on velocities as `force(…)` or `damping = …`",
            ),
            (
                "v",
                "`v` is a speed, and a potential depends on coordinates, fields and `t` only; \
                 write what depends on velocities as `force(…)` or `damping = …`",
            ),
        ],
    );
}

#[test]
fn charts_without_a_body_and_unknown_clauses() {
    check(
        &particle("chart = hybird, motion = planar", ""),
        &[
            ("hybird", "unknown chart `hybird`; did you mean `hybrid`?"),
            (
                "chart",
                "`chart` moves a body without a name, and `Scene` has no mass data of one; add `#[gauss(mass)] mass: f64` \
                 and `#[gauss(inertia)] inertia: Vector3<f64>`, or remove `chart`: what else moves is said by \
                 `coordinates` and `speeds`",
            ),
        ],
    );
    check(&particle("foo = 1", ""), &[("foo", &format!("unknown clause `foo`; {ALL_CLAUSES}"))]);
    // A misspelt clause is not missing as well.
    check(
        "#[gauss(coordinats(x), particle(mass = m, position = [x, 0, 0]))] struct Scene { m: f64 }",
        &[("coordinats", "unknown clause `coordinats`; did you mean `coordinates`?")],
    );
    check(
        &particle("potential(x)", ""),
        &[("(", "the value of `potential` follows `=`, without brackets; write `potential = k * x * x / 2`")],
    );
}
