//! States of elements: what they may stand in, what their rates may name, and mistakes in them.

use super::super::{Mistake, check, model};
use super::{show, system};

/// A cart with a motor, with more `clauses`.
fn cart(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x), input(volts), body(cart, position = [x, 0, 0]), {clauses})] \
         struct Scene {{ #[gauss(body)] cart: RigidBody<f64>, r: f64, l: f64, k: f64 }}"
    )
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&cart(clauses), expected);
}

#[test]
fn accepted() {
    let model = system(&cart(
        "states(amps = (volts - r * amps - back) / l), define(back = k * rate(x)), drive(x = k * amps), \
         states(heat = r * amps * amps, r#away = abs(cart.velocity.x) - away * t)",
    ));
    let shown: Vec<String> =
        model.states.iter().map(|state| format!("{} {}", state.ident, show(&state.rate))).collect();
    assert_eq!(
        shown,
        [
            "amps (Divide (Subtract (Subtract volts (Multiply r amps)) (Multiply k (rate x))) l)",
            "heat (Multiply (Multiply r amps) amps)",
            "r#away (Subtract (abs cart.Velocity[0]) (Multiply away t))",
        ]
    );
    assert_eq!(model.coordinates.len(), 1);
}

#[test]
fn rates() {
    mistakes(
        "states(amps, heat = r * [1, 0, 0], cold = , warm = amp)",
        &[
            ("=", "nothing follows `cold =`; write a value or remove the clause"),
            (
                "amps",
                "the state `amps` has no rate, so nothing determines it; write `amps = …` with its rate, or \
                 `coordinates(amps)` of what moves a body",
            ),
            ("*", "the rate of a state is a scalar, found a vector; write one number, such as `(u - x) / tau`"),
            ("amp", "unknown name `amp`; did you mean the state `amps`?"),
        ],
    );
    mistakes("states()", &[("(", "`states()` is empty; write `states(x = (u - x) / tau)` or remove it")]);
    mistakes("states = 1", &[("1", "`states` takes brackets, not `=`; write `states(x = (u - x) / tau)`")]);
    mistakes("states(loop = 1)", &[("loop", "`loop` is a keyword of Rust and cannot name a state")]);
    mistakes(
        "state(amps = 1)",
        &[(
            "state",
            "unknown clause `state`; the configuration is declared by `coordinates(x, pose: Pose)`, and what an element \
             remembers, with its rate, by `states(x = …)`",
        )],
    );
}

#[test]
fn one_name_one_meaning() {
    mistakes(
        "states(amps = 1, amps = 2, k = 3, volts = 4, x = 5, t = 6)",
        &[
            ("amps", "the state `amps` is declared twice; remove one of the two"),
            ("k", "`k` names a field and a state; rename one of the two"),
            ("x", "`x` names a coordinate and a state; rename one of the two"),
            ("t", "`t` is time in expressions and cannot name a state; rename it"),
            ("volts", "`volts` names a state and an input; rename one of the two"),
        ],
    );
}

#[test]
fn places() {
    const ONLY: &str = "is a state of an element, which moves no body and stores no energy that the equations know of; \
        states stand in values of `force`, `torque`, `wrench` and `drive`, in coefficients of `drag`, in `damping` and in \
        the rates of `states`";
    mistakes(
        "states(a = -a), potential = a * x, constraint(position = x - a), spring(along = x - a, stiffness = k)",
        &[("a", &format!("`a` {ONLY}")), ("a", &format!("`a` {ONLY}")), ("a", &format!("`a` {ONLY}"))],
    );
    mistakes(
        "states(a = -a), frame(moved, position = [a, 0, 0]), drive(x = rate(a))",
        &[
            ("a", &format!("`a` {ONLY}")),
            (
                "a",
                "the rate of the state `a` is what `states(a = …)` says; give that a name by `define(…)`, and write it in \
                 the place of the rate",
            ),
        ],
    );
}

#[test]
fn units() {
    let scene = |rate: &str| {
        format!(
            "#[gauss(coordinates(x), input(force = \"N\"), particle(mass = m, position = [x, 0, 0]), states(a = {rate}))] \
             struct Scene {{ m: f64, #[gauss(unit = \"s\")] tau: f64 }}"
        )
    };
    assert_eq!(model(&scene("(force - a) / tau")).states.len(), 1);
    check(
        &scene("(force - tau) / tau"),
        &[(
            "-",
            "the difference of `force` (N) and `tau` (s): the two sides of `-` have one unit; multiply the latter by a \
             coefficient in kg m/s^3",
        )],
    );
}
