//! Loads, and values that arrive at run time.

use super::super::{Mistake, check};
use super::{particle, shown, system};
use crate::terms::InputKind;

/// A body on a turning arm, a base at rest in the observer's frame, a particle and an attitude, with more `clauses`.
fn acted_on(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, theta, phi: Rotation, pose: Pose), speeds(v, w, turn: Vector3, u: Vector3, s: Vector3), \
         kinematics(x = v, theta = w, phi = turn, pose = twist(u, s)), particle(mass = m, position = [x, 0, 0]), \
         body(arm, position = [x, 0, 0], rotation = rotation_z(theta)), body(gyro, parent = arm, rotation = phi), \
         body(ship, position = pose.position, rotation = pose.rotation), frame(wall, position = [l * t, 0, 0]), \
         point(tip, body = arm, at = [l, 0, 0]), point(nail, body = wall, at = [l, 0, 0]), {clauses})] \
         struct Scene {{ #[gauss(body)] arm: RigidBody<f64>, #[gauss(body)] gyro: RigidBody<f64>, \
         #[gauss(body)] ship: RigidBody<f64>, m: f64, l: f64, k: f64, c: Vector3<f64> }}"
    )
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&acted_on(clauses), expected);
}

#[track_caller]
fn mistake(clauses: &str, token: &str, message: &str) {
    mistakes(clauses, &[(token, message)]);
}

#[test]
fn accepted() {
    let model = system(&acted_on(
        "input(thrust, wind: Vector3), \
         force(pull, at = tip, value = [thrust, 0, 0]), \
         force(at = arm.position + [0, 0, l], value = -k * abs(v) * wind), \
         force(jet, body = arm, at = [l, 0, 0], value = min(thrust, k) * c), \
         force(body = ship, value = ship.velocity - wind, axes = observer), \
         torque(body = gyro, value = rate(tip) + arm.angular_velocity, reaction = arm), \
         torque(motor, body = arm, value = [0, 0, max(w, hypot(w, 1))], axes = observer), \
         drive(servo, theta = thrust - k * w, x = -x), \
         spring(from = tip, to = nail, stiffness = k), \
         spring(damper, from = [0, 0, 0], to = tip, stiffness = 2 * k, length = l, damping = 1), \
         damping = k * v * v / 2 + rate(theta) * w",
    ));
    let inputs: Vec<_> = model.item.inputs.iter().map(|input| (input.ident.to_string(), input.kind)).collect();
    assert_eq!(inputs, [("thrust".into(), InputKind::Scalar), ("wind".into(), InputKind::Vector)]);
    let forces: Vec<String> = model.forces.iter().map(shown).collect();
    assert_eq!(
        forces,
        [
            "force pull: at tip, value [thrust 0 0]",
            "force -: at (Add arm.Position [0 0 l]), value (Multiply (Multiply (-k) (abs v)) wind)",
            "force jet: at [l 0 0], value (Multiply (min thrust k) c), body arm",
            "force -: value (Subtract ship.Velocity wind), body ship, axes observer",
            "torque -: body gyro, value (Add (rate tip) arm.AngularVelocity), reaction arm",
            "torque motor: body arm, value [0 0 (max w (hypot w 1))], axes observer",
            "drive servo: theta (Subtract thrust (Multiply k w)), x (-x)",
            "spring -: from tip, to nail, stiffness k",
            "spring damper: from [0 0 0], to tip, stiffness (Multiply 2 k), length l, damping 1",
            "damping -: value (Add (Divide (Multiply (Multiply k v) v) 2) (Multiply (rate theta) w))",
        ]
    );
    // A field that only forces name is computed with.
    check(
        &particle("force(at = [x, y, 0], value = [k, 0, 0])", "k: f32"),
        &[(
            "f32",
            "the scalar of `k` is `f32`, but that of `m` is `f64`; one scalar serves the whole system: write `f64`",
        )],
    );
}

#[test]
fn forces() {
    let pointless = "a force needs the point where it acts; add `at = …`, or `body = …` for a point of a body";
    let components = "a force needs its components; add `value = [fx, fy, fz]`";
    mistakes(
        "force, force(), force(pull), force(value = c), force(at = tip), force(positon, value = c)",
        &[
            ("force", "`force` is empty; write `force(at = …, value = [fx, fy, fz])`"),
            ("(", "`force()` is empty; write `force(at = …, value = [fx, fy, fz])` or remove it"),
            ("force", pointless),
            ("force", components),
            ("force", pointless),
            ("force", components),
            ("force", pointless),
        ],
    );
    mistakes(
        "force(at = tip, valeu = c), force(bodi = arm, value = c, axes = body), force(at = tip, value = c, point = tip), \
         force(at = tip, at = nail, value = c), force(at, value = c), force(tip = at = nail, value = c)",
        &[
            ("valeu", "unknown argument of `force`: `valeu`; did you mean `value`?"),
            ("bodi", "unknown argument of `force`: `bodi`; did you mean `body`?"),
            ("point", "unknown argument of `force`: `point`; expected `at`, `value`, `body` or `axes`"),
            ("at", "`at` is given twice; keep one of the two"),
            ("at", "`at` needs a value; write `at = [l, 0, 0]`"),
            ("tip", "unknown argument of `force`: `tip`; expected `at`, `value`, `body` or `axes`"),
            ("force", pointless),
        ],
    );
    mistakes("force([1, 0, 0])", &[("[", "expected an argument such as `value = [0, 0, f]`, found `[`")]);
    mistakes(
        "force(body = army, value = c), force(body = tip, value = c), force(body = 3, value = c)",
        &[
            ("3", "`body` is the name of a body or a frame, found the literal `3`"),
            ("army", "no body or frame is called `army`; did you mean `arm`?"),
            ("tip", "`tip` is a point, not a body or frame; expected `arm`, `gyro`, `ship` or `wall`"),
        ],
    );
}

#[test]
fn axes() {
    mistakes(
        "force(body = arm, value = c, axes = boby), force(body = arm, value = c, axes = ship), \
         force(body = arm, value = c, axes = \"body\"), torque(body = arm, value = c, axes = body(arm))",
        &[
            ("boby", "unknown axes `boby`; did you mean `body`?"),
            ("ship", "unknown axes `ship`; expected `body` or `observer`"),
            ("\"body\"", "`axes` takes a bare word, not a string; write `axes = body`"),
            ("(", "`body` takes nothing in brackets; write `axes = body`"),
        ],
    );
    mistake(
        "force(at = tip, value = c, axes = body)",
        "axes",
        "without `body` a force is in observer axes; add `body = …`, or remove `axes`",
    );
}

#[test]
fn torques() {
    mistakes(
        "torque(motor), torque(body = arm, at = tip, value = c), torque(body = arm, value = c, reaction = arm), \
         torque(body = arm, value = c, reaction = gyroo)",
        &[
            ("torque", "a torque needs the body that it acts on; add `body = …`"),
            ("torque", "a torque needs its components; add `value = [mx, my, mz]`"),
            ("at", "a torque has no point: it does the same wherever it acts on its body; remove `at`"),
            ("gyroo", "no body or frame is called `gyroo`; did you mean `gyro`?"),
            ("arm", "the torque on `arm` and its reaction on `arm` cancel; name another body"),
        ],
    );
    check(
        "#[gauss(coordinates(q), body(arm, rotation = rotation_x(q)), \
         torque(body = arm, value = [1, 0, 0], reaction = ground))] \
         struct Scene { #[gauss(body)] arm: RigidBody<f64> }",
        &[("ground", "no body or frame is called `ground`; there is no other: leave `reaction` out")],
    );
    // The only body needs no name.
    let model = system(
        "#[gauss(coordinates(q), body(rotation = rotation_x(q)), torque(body = body, value = -body.angular_velocity))] \
         struct Scene { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
    );
    assert_eq!(
        model.forces.iter().map(shown).collect::<Vec<_>>(),
        ["torque -: body body, value (-body.AngularVelocity)"]
    );
}

#[test]
fn drives() {
    let nothing = "a drive needs a coordinate with the generalised force on its rate; write `drive(theta = …)`";
    mistakes(
        "drive(servo), drive(theta), drive(servo, x), drive(thta = k), drive(v = k), drive(q = k), \
         drive(x = k, x = l), drive(phi = k), drive(pose = k)",
        &[
            ("drive", nothing),
            ("drive", nothing),
            ("x", "`x` needs a value; write `x = k * theta`"),
            ("thta", "`thta` is no coordinate, and a drive acts on rates of scalar coordinates; did you mean `theta`?"),
            (
                "v",
                "`v` is a speed, not a coordinate, and a drive acts on rates of scalar coordinates; \
                 expected `x` or `theta`",
            ),
            ("q", "`q` is no coordinate, and a drive acts on rates of scalar coordinates; expected `x` or `theta`"),
            ("x", "`x` is driven twice in one clause; write the sum of the two"),
            (
                "phi",
                "`phi` is a rotation, and its angular velocity is driven by a torque; \
                 write `torque(body = …, value = …)`",
            ),
            (
                "pose",
                "`pose` is a pose, and its twist is driven by forces and torques; \
                 write `force(body = …, value = …)` and `torque(body = …, value = …)`",
            ),
        ],
    );
}

#[test]
fn springs() {
    mistakes(
        "spring(long), spring(from = tip, too = nail, stiffness = k), \
         spring(from = tip, to = nail, stiffness = x, length = tip, damping = c)",
        &[
            ("spring", "a spring needs its extent; add `from = …` and `to = …`, two points, or `along = …`, a scalar"),
            ("spring", "a spring needs its force by elongation; add `stiffness = k`"),
            ("too", "unknown argument of `spring`: `too`; did you mean `to`?"),
            ("x", "`x` varies, and the stiffness of a spring is constant; write numbers and fields only"),
            ("tip", "`tip` varies, and the length of a spring is constant; write numbers and fields only"),
            ("c", "the damping of a spring is a scalar, found a vector; write one number or the name of a field"),
        ],
    );
    mistake(
        "spring(from = tip, to = 0, stiffness = k)",
        "0",
        "the end of a spring is a vector, found a scalar; write the name of a point, `arm.position` or `[x, y, z]`",
    );
    mistake(
        "spring(from = [v, 0, 0], to = tip, stiffness = k)",
        "v",
        "`v` is a speed, and the end of a spring depends on coordinates, fields and `t` only; \
         speeds stand in values of forces",
    );
}

#[test]
fn kinds() {
    mistakes(
        "force(at = x, value = k), force(body = arm, at = l, value = c), torque(body = arm, value = k), drive(x = c), \
         damping = arm.velocity",
        &[
            (
                "x",
                "the point of a force is a vector, found a scalar; \
                 write the name of a point, `arm.position` or `[x, y, z]`",
            ),
            ("k", "a force is a vector, found a scalar; write `[fx, fy, fz]`"),
            ("l", "the point of a force in its body is a vector, found a scalar; write `[x, y, z]`"),
            ("k", "a torque is a vector, found a scalar; write `[mx, my, mz]`"),
            (
                "c",
                "the generalised force on the rate of a scalar coordinate is a scalar, found a vector; write one number",
            ),
            (
                "velocity",
                "a dissipation function is a scalar, found a vector; write one number, such as `c * v * v / 2`",
            ),
        ],
    );
    mistakes(
        "force(at = arm, value = c), force(body = arm, at = nail, value = c), force(body = arm, at = [x, 0, 0], value = c), \
         force(at = [v, 0, 0], value = c), force(at = rate(tip), value = c)",
        &[
            ("arm", "`arm` is a body; write `arm.position` or `arm.rotation`"),
            (
                "nail",
                "`nail` is a point, which is known in observer axes, and with `body` a force acts at a place in the axes \
                 of that body; write numbers and fields, the name of a point of that body, or leave `body` out",
            ),
            (
                "x",
                "`x` varies, and with `body` a force acts at a fixed place of that body; write numbers and fields only, \
                 or leave `body` out",
            ),
            (
                "v",
                "`v` is a speed, and the point of a force depends on coordinates, fields and `t` only; \
                 speeds stand in values of forces",
            ),
            (
                "rate",
                "`rate(…)` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; \
                 remove it",
            ),
        ],
    );
    mistake(
        "force(at = tip, value = rate(arm.velocity))",
        "velocity",
        "the time derivative of `arm.velocity` is an acceleration, which a force cannot contain; \
         write `arm.velocity` itself",
    );
}

#[test]
fn kinks() {
    let differentiated = |word: &str, what: &str| {
        format!("the derivative of `{word}` jumps, and {what} is differentiated; only values of forces can contain it")
    };
    let rate = "the derivative of `abs` jumps, and `rate` takes derivatives; take `abs` out of `rate(…)`";
    mistakes(
        "potential = abs(x), constraint(velocity = max(v, w)), force(at = [x.min(l), 0, 0], value = [rate(abs(x)), 0, 0]), \
         damping = v * v * abs(v), spring(from = tip, to = nail, stiffness = max(k, l))",
        &[
            ("abs", &differentiated("abs", "a potential")),
            ("min", &differentiated("min", "the point of a force")),
            ("abs", rate),
            (
                "abs",
                "the derivative of `abs` jumps, and forces are derivatives of a dissipation function; write the force \
                 itself as `force(…)`, `torque(…)` or `drive(…)`",
            ),
            ("max", "`max` stands in values of forces only; make the number a field of the struct"),
            ("max", &differentiated("max", "a constraint of velocities")),
        ],
    );
    mistake("drive(x = abs(c) + min(x))", "min", "`min` takes two arguments, found 1; write `min(a, b)`");
    mistake("drive(x = abs(c))", "c", "`abs` takes a scalar, found a vector");
    // Smooth but where it vanishes.
    system(&acted_on("potential = hypot(x, l) * hypot(theta, 1)"));
}

#[test]
fn inputs() {
    let message = "`thrust` is an input, whose value is not known before run time, and whose rate is never; inputs stand \
        in values of `force`, `torque`, `wrench` and `drive`, in coefficients of `drag`, and in `damping`";
    for clause in [
        "potential = thrust * x",
        "constraint(velocity = v - thrust)",
        "particle(mass = thrust, position = [x, 0, 0])",
        "particle(mass = m, position = [thrust, 0, 0])",
        "frame(hand, rotation = rotation_z(thrust))",
        "force(at = [thrust, 0, 0], value = c)",
        "force(body = arm, at = [thrust, 0, 0], value = c)",
        "spring(from = tip, to = nail, stiffness = thrust)",
    ] {
        mistake(&format!("input(thrust), {clause}"), "thrust", message);
    }
    mistake(
        "input(thrust), drive(x = rate(x * thrust))",
        "thrust",
        "`thrust` is an input, whose rate is never known; take it out of `rate(…)`, and declare an input for its rate \
         if that is known",
    );
    mistakes(
        "input(thrust, wind: Vector3, rudder), drive(x = thrust)",
        &[
            ("wind", "the input `wind` is used nowhere; name it in the value of a force, or remove it"),
            ("rudder", "the input `rudder` is used nowhere; name it in the value of a force, or remove it"),
        ],
    );
    mistakes(
        "drive(x = thrust), force(at = tipp, value = c)",
        &[
            (
                "thrust",
                "unknown name `thrust`; declare it by `input(thrust)` if it arrives at run time, or write a coordinate \
                 (`x`, `theta`, `phi` or `pose`), a speed (`v`, `w`, `turn`, `u` or `s`), a field (`m`, `l`, `k` or `c`), \
                 a body (`arm`, `gyro` or `ship`), a frame (`wall`), a point (`tip` or `nail`) or `t`",
            ),
            ("tipp", "unknown name `tipp`; did you mean the point `tip`?"),
        ],
    );
    mistake("input(thrust), drive(x = thust)", "thust", "unknown name `thust`; did you mean the input `thrust`?");
    mistakes(
        "input(thrust: f64, 3, wind: Vector), input(rudder), force(at = tip, value = wind * thrust)",
        &[
            (":", "a scalar input has no type; write `thrust`"),
            ("3", "expected the name of an input, found the literal `3`"),
            ("Vector", "unknown kind of input `Vector`; did you mean `Vector3`?"),
            ("input", "`input` is given twice; write all of it in one"),
        ],
    );
}

#[test]
fn names() {
    mistakes(
        "input(k, x, v, abs, t, wall), inputt, drive(k, x = 1)",
        &[
            ("inputt", "unknown clause `inputt`; did you mean `input`?"),
            (
                "k",
                "`k` is a field, whose value is fixed when the kernel is made, and an input, whose value arrives at run \
                 time; rename or remove one of the two",
            ),
            ("x", "`x` names a coordinate and an input; rename one of the two"),
            ("v", "`v` names a speed and an input; rename one of the two"),
            ("abs", "`abs` is a function of expressions and cannot name an input; rename it"),
            ("t", "`t` is time in expressions and cannot name an input; rename it"),
            ("wall", "`wall` names an input and a frame; rename one of the two"),
        ],
    );
    mistakes(
        "input(a), force(tip, at = tip, value = a * c), force(pull, at = tip, value = c), \
         force(pull, at = tip, value = c), torque(pull, body = arm, value = c), drive(a, x = 1), drive(arm, x = 1), \
         spring(hypot, from = tip, to = nail, stiffness = k), spring(if, from = tip, to = nail, stiffness = k)",
        &[
            ("if", "`if` is a keyword of Rust and cannot name a spring"),
            ("pull", "two forces are called `pull`; rename one of the two"),
            ("pull", "`pull` names a force and a torque; rename one of the two"),
            ("hypot", "`hypot` is a function of expressions and cannot name a spring; rename it"),
        ],
    );
}

#[test]
fn effect() {
    let at_rest = |noun: &str| format!("`wall` does not move, so the {noun} does nothing; name a body that moves");
    mistakes(
        "force(at = [l, 0, 0], value = c), force(at = nail, value = c), force(body = wall, value = c), \
         torque(body = wall, value = c), torque(body = wall, value = c, reaction = arm), \
         spring(from = nail, to = [0, 0, t], stiffness = k), damping = k * x * x",
        &[
            (
                "force",
                "the point of the force is at rest, where it does nothing: it names no coordinate, and no body or point \
                 that moves; add `body = …` if it is meant in the axes of a body",
            ),
            (
                "force",
                "the point of the force is at rest, where it does nothing: it names no coordinate, and no body or point \
                 that moves; add `body = …` if it is meant in the axes of a body",
            ),
            ("force", &at_rest("force")),
            ("torque", &at_rest("torque")),
            ("spring", "neither end of the spring moves; name a coordinate, or a body or point that moves"),
            (
                "damping",
                "the dissipation function contains no velocity of anything that moves, so it brakes nothing; name a \
                 speed, or a velocity such as `rate(…)`",
            ),
        ],
    );
    mistake(
        "torque(body = wall, value = c, reaction = door), frame(door)",
        "torque",
        "neither `wall` nor `door` moves, so the torque does nothing; remove it",
    );
    mistake("damping = k * v, damping = k * w", "damping", "`damping` is given twice; write the sum of the two in one");
}
