//! Definitions: where they may stand depends on what they contain, and nothing of them is left in the model.

use super::super::{Mistake, check};
use super::{show, shown, system};

/// A pendulum on a cart, with more `clauses`.
fn pendulum(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, theta), speeds(v, w), {clauses})] \
         struct Scene {{ #[gauss(body)] cart: RigidBody<f64>, #[gauss(body)] rod: RigidBody<f64>, l: f64, k: f64 }}"
    )
}

const PLACED: &str = "kinematics(x = v, theta = w), body(cart, position = [x, 0, 0]), \
    body(rod, parent = cart, rotation = rotation_z(theta))";

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&pendulum(&format!("{PLACED}, {clauses}")), expected);
}

#[test]
fn accepted() {
    let model = system(&pendulum(
        "input(thrust), define(turn = rotation_z(theta), arm = turn * [l, 0, 0], ahead = v), \
         define(tip = [x, 0, 0] + arm, height = tip.y, r#rate_of_tip = rate(tip)), \
         kinematics(x = ahead, theta = w), body(cart, position = [x, 0, 0]), body(rod, parent = cart, rotation = turn), \
         particle(mass = 1, position = tip), constraint(position = height - l), potential = k * height, \
         force(at = tip, value = -thrust * rate_of_tip), drag(body = cart, linear = [ahead, 0, 0, 0, 0, 0])",
    ));
    let tip = "(Add [x 0 0] (Multiply (rotation_z theta) [l 0 0]))";
    assert_eq!(show(&model.kinematics[0].1), "v");
    assert_eq!(model.bodies[1].rotation.as_ref().map(show), Some("(rotation_z theta)".into()));
    assert_eq!(show(&model.particles[0].position), tip);
    assert_eq!(show(&model.constraints[0].expression), format!("(Subtract {tip}[1] l)"));
    assert_eq!(model.potential.as_ref().map(show), Some(format!("(Multiply k {tip}[1])")));
    assert_eq!(
        model.forces.iter().map(shown).collect::<Vec<_>>(),
        [
            format!("force -: at {tip}, value (Multiply (-thrust) (rate {tip}))"),
            "drag -: body cart, linear [v 0 0 0 0 0]".to_owned()
        ]
    );
    // A vector constraint by definition is three.
    let model =
        system(&pendulum(&format!("define(gap = cart.position - rod.position), {PLACED}, constraint(position = gap)")));
    assert!(model.constraints[0].vector);
}

#[test]
fn order_and_use() {
    mistakes(
        "define(a = b + 1, b = c * x, d = d), potential = a * b, drive(x = d)",
        &[
            ("b", "`b` is defined later; move its definition up"),
            (
                "c",
                "unknown name `c`; declare it by `input(c)` if it arrives at run time, or write a coordinate (`x` or \
                 `theta`), a speed (`v` or `w`), a definition (`a` or `d`), a field (`l` or `k`), a body (`cart` or \
                 `rod`) or `t`",
            ),
            ("d", "`d` is defined by itself; define it without `d`"),
        ],
    );
    mistakes(
        "define(a = x, b = 2 * k, used = k), define(c = used), drive(x = c)",
        &[("a", "`a` is defined and never used; remove it"), ("b", "`b` is defined and never used; remove it")],
    );
    mistakes(
        "define(stretch = x), potential = strech",
        &[("strech", "unknown name `strech`; did you mean the definition `stretch`?")],
    );
    let doubled: Vec<String> = (0..20).map(|k| format!("a{} = a{k} * a{k}", k + 1)).collect();
    mistakes(
        &format!("define(a0 = x, {}), drive(x = a20)", doubled.join(", ")),
        &[(
            "a15",
            "up to `a15` expressions have more than 100000 parts when definitions are written out; name them less often",
        )],
    );
}

#[test]
fn forbidden_where_it_is_used() {
    mistakes(
        "input(thrust), define(u = 2 * v, e = abs(x) * u, push = thrust * x), potential = k * u * u + e + push, \
         spring(along = u, stiffness = x), force(at = [u, 0, 0], value = [push + e, 0, 0])",
        &[
            (
                "v",
                "in the definition of `u`, which a potential uses: `v` is a speed, and a potential depends on \
                 coordinates, fields and `t` only; write what depends on velocities as `force(…)` or `damping = …`",
            ),
            (
                "abs",
                "in the definition of `e`, which a potential uses: the derivative of `abs` jumps, and a potential \
                 is differentiated; only values of forces can contain it",
            ),
            (
                "thrust",
                "in the definition of `push`, which a potential uses: `thrust` is an input, whose value is not \
                 known before run time, and whose rate is never; inputs stand in values of `force`, `torque`, \
                 `wrench` and `drive`, in coefficients of `drag`, and in `damping`",
            ),
            (
                "v",
                "in the definition of `u`, which the extent of a spring uses: `v` is a speed, and the extent of a \
                 spring depends on coordinates, fields and `t` only; speeds stand in values of forces",
            ),
            ("x", "`x` varies, and the stiffness of a spring is constant; write numbers and fields only"),
            (
                "v",
                "in the definition of `u`, which the point of a force uses: `v` is a speed, and the point of a \
                 force depends on coordinates, fields and `t` only; speeds stand in values of forces",
            ),
        ],
    );
}

/// Whatever stands around the name: what a function gives is known even where its argument is nothing.
#[test]
fn definitions_of_themselves() {
    let expressions = [
        "inverse(u)",
        "[u, 0, 0]",
        "sin(u)",
        "dot(u, [1, 0, 0])",
        "powf(u, 2)",
        "powf(2, u)",
        "hypot(x, u)",
        "rotation_x(u)",
        "powi(u, 2)",
        "-u",
        "u + x",
        "u.x",
        "abs([0, u, 0].y)",
    ];
    for expression in expressions {
        mistakes(
            &format!("define(u = {expression}), potential = k * x"),
            &[("u", "`u` is defined by itself; define it without `u`")],
        );
    }
}

/// Each circle once, with all its names and at the token that leads around; what is wrong besides is found as well.
#[test]
fn circles() {
    mistakes(
        "define(a = x + b, b = 2 * a), potential = a",
        &[(
            "b",
            "the definitions `a` and `b` name each other, so that neither has a value; write one of them without the other",
        )],
    );
    mistakes(
        "define(a = k * b.y, b = [x, c, sin(u)]), define(c = dot(d, d), d = [a, a, 0]), potential = d.x",
        &[
            (
                "b",
                "the definitions `a`, `b`, `c` and `d` name one another in a circle, so that none has a value; write one of \
                 them without the others",
            ),
            (
                "u",
                "unknown name `u`; declare it by `input(u)` if it arrives at run time, or write a coordinate (`x` or \
                 `theta`), a speed (`v` or `w`), a definition (`a`, `c` or `d`), a field (`l` or `k`), a body (`cart` \
                 or `rod`) or `t`",
            ),
        ],
    );
    // Two circles; a name within a circle that also names itself; one that leads into a circle and is in none.
    mistakes(
        "define(into = a, a = b, b = a + a, c = d + c, d = c), potential = into + c",
        &[
            (
                "b",
                "the definitions `a` and `b` name each other, so that neither has a value; write one of them without the \
                 other",
            ),
            (
                "d",
                "the definitions `c` and `d` name each other, so that neither has a value; write one of them without the \
                 other",
            ),
            ("a", "`a` is defined later; move its definition up"),
            ("c", "`c` is defined by itself; define it without `c`"),
        ],
    );
    // Two circles through one name: once that of each name that was in none before.
    mistakes(
        "define(a = b + c, b = a, c = a), potential = a",
        &[
            (
                "b",
                "the definitions `a` and `b` name each other, so that neither has a value; write one of them without the \
                 other",
            ),
            (
                "a",
                "the definitions `c` and `a` name each other, so that neither has a value; write one of them without the \
                 other",
            ),
        ],
    );
}

#[test]
fn kinds_and_names() {
    mistakes(
        "define(u = [1, 0, 0], s = x, place = cart, sum = u + s, both = twist(u, u), x = 1, sin = 2, l = 3, s = 4, t = 5), \
         potential = u, drive(x = u.y + s.y)",
        &[
            ("x", "`x` names a coordinate and a definition; rename one of the two"),
            ("sin", "`sin` is a function of expressions and cannot name a definition; rename it"),
            ("l", "`l` names a field and a definition; rename one of the two"),
            ("s", "the definition `s` is declared twice; remove one of the two"),
            ("t", "`t` is time in expressions and cannot name a definition; rename it"),
            ("cart", "`cart` is a body; write `cart.position` or `cart.rotation`"),
            (
                "twist",
                "a twist is no part of another expression; write `pose = twist(linear, angular)` in `kinematics(…)`",
            ),
            ("u", "a potential is a scalar, found a vector; write one number, such as `k * x * x / 2`"),
        ],
    );
    mistakes(
        "define, define(), define(u), define(u = ), define(3), define(if = x), define(v = x) ",
        &[
            ("define", "`define` is empty; write `define(name = …)`"),
            ("(", "`define()` is empty; write `define(name = …)` or remove it"),
            ("u", "`u` needs a value; write `u = …`"),
            ("=", "nothing follows `u =`; write a value or remove the clause"),
            ("3", "`define` takes words, found 3; write a definition such as `u = body.relative_velocity`"),
            ("if", "`if` is a keyword of Rust and cannot name a definition"),
            ("u", "the definition `u` is declared twice; remove one of the two"),
            ("v", "`v` names a speed and a definition; rename one of the two"),
        ],
    );
}
