//! Units of fields and inputs, and what follows from them for expressions.

use super::systems::system;
use super::{Mistake, check, model, read, with};

/// A body in a chart with `clauses` and fields that have units.
fn body(clauses: &str) -> String {
    format!(
        "#[gauss({clauses})] struct Body {{ #[gauss(mass, unit = \"kg\")] m: f64, #[gauss(inertia)] j: Vector3<f64>, \
         #[gauss(gravity)] g: f64, #[gauss(unit = \"m\")] l: f64, #[gauss(unit = \"N/m\")] k: f64, \
         #[gauss(unit = \"N s²/m²\")] c: f64, #[gauss(unit = \"m/s\")] w: Vector3<f64>, free: f64, \
         d: Matrix6<f64> }}"
    )
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&body(clauses), expected);
}

#[track_caller]
fn accepted(clauses: &str) {
    if let Err(error) = read(&body(clauses)) {
        let all: Vec<String> = error.into_iter().map(|error| error.to_string()).collect();
        panic!("{clauses}: {}", all.join("\n"));
    }
}

#[test]
fn units_are_kept_as_they_are_written() {
    let model = model(&body(
        "input(thrust = \"N\", rudder = \"rad\", wind: Vector3 = \"m/s\", gust: Wrench, plain), \
         force(at = [l, 0, 0], value = [thrust, c * wind.x * wind.x * rudder, plain]), \
         force(body = body, value = gust.force)",
    ));
    let units: Vec<Option<&str>> = model.item.fields.iter().map(|field| field.unit.as_deref()).collect();
    assert_eq!(units, [Some("kg"), None, None, Some("m"), Some("N/m"), Some("N s²/m²"), Some("m/s"), None, None]);
    let of_inputs: Vec<Option<&str>> = model.item.inputs.iter().map(|input| input.unit.as_deref()).collect();
    assert_eq!(of_inputs, [Some("N"), Some("rad"), Some("m/s"), None, None]);
}

#[test]
fn how_units_are_written() {
    mistakes(
        "unit = \"N\", input(a = N, b = , p: \"N\", q: Vector3 = 3, e: Wrench = \"N\", f = \"deg\", h = \"Nm\", i: Vector3<f64> = \
         \"km\"), force(body = body, value = [a + b + p, f + h, 0])",
        &[
            (
                "unit",
                "units are those of fields and inputs; write `#[gauss(unit = \"N\")]` on a field, or \
                 `input(thrust = \"N\")`",
            ),
            ("N", "a unit stands in quotes after `=`; write `a = \"N\"`"),
            ("=", "a unit stands in quotes after `=`; write `b = \"N s/m\"`"),
            (":", "a unit follows `=`; write `p = \"N\"`"),
            ("3", "a unit stands in quotes after `=`; write `q = \"3\"`"),
            ("\"deg\"", "values are used as they are, and angles are in rad: 1 deg = 0.0174533 rad"),
            ("\"Nm\"", "unknown unit `Nm`; did you mean `N m`?"),
            ("\"km\"", "values are used as they are, and lengths are in m: 1 km = 1000 m"),
            ("Vector3", "`Vector3<f64>` is written as one word; write `i: Vector3`"),
            (
                "\"N\"",
                "a wrench has two units, N of its force and N m of its torque, without being told; write `e: Wrench`",
            ),
        ],
    );
    check(
        &with(
            "#[gauss(unit)] a: f64, #[gauss(unit(N))] b: f64, #[gauss(unit = kg*m)] c: f64, #[gauss(units = \"N\")] d: f64, \
             #[gauss(unit = \"m\", unit = \"m\")] e: f64, #[gauss(unit = 'N')] f: f64",
        ),
        &[
            ("unit", "a unit stands in quotes after `=`; write `unit = \"N s/m\"`"),
            ("unit", "a unit stands in quotes after `=`; write `unit = \"N s/m\"`"),
            ("kg", "a unit stands in quotes after `=`; write `unit = \"kg*m\"`"),
            ("units", "unknown role `units`; did you mean `unit`?"),
            ("unit", "the unit of the field `e` is given twice; keep one of the two"),
            ("'N'", "a unit stands in quotes after `=`; write `unit = \"N s/m\"`"),
        ],
    );
}

#[test]
fn units_of_roles() {
    check(
        "struct Body { #[gauss(mass, unit = \"N\")] m: f64, #[gauss(unit = \"kg m\", inertia)] j: Matrix3<f64>, \
         #[gauss(gravity, unit = \"N/kg\")] g: f64, #[gauss(added_mass, unit = \"kg\")] a: Matrix6<f64>, \
         #[gauss(unit = \"N\")] d: Vector6<f64>, #[gauss(unit = \"kg\")] r: RigidBody<f64> }",
        &[
            ("\"N\"", "`mass` is in kg, and the unit of `m` is N; write `unit = \"kg\"`"),
            ("\"kg m\"", "`inertia` is in kg m^2, and the unit of `j` is kg m; write `unit = \"kg m^2\"`"),
            ("\"kg\"", "`a` has no one unit: the blocks of an added mass are in kg, kg m and kg m^2; remove `unit`"),
            (
                "\"N\"",
                "`d` has no one unit: what has six components belongs to forces and torques, which have different \
                 units; remove `unit`",
            ),
            (
                "\"kg\"",
                "`r` has no one unit: a rigid body has a mass in kg, a centre of mass in m and an inertia in kg m^2; \
                 remove `unit`",
            ),
        ],
    );
}

#[test]
fn what_has_no_unit_agrees_with_everything() {
    accepted(
        "input(thrust = \"N\", plain), medium(velocity = [free * t, 0.5, w.x]), \
         force(body = body, value = [thrust + 3, 2, free * thrust]), \
         force(body = body, value = free * body.velocity + [thrust, plain, -thrust]), \
         torque(value = [plain * thrust, 0, sin(t * free) * free]), drag(linear = [1, 2, 3, 4, free, plain])",
    );
    // Where no unit is written, not even the unit of time is asked for.
    model(
        "#[gauss(force(body = body, value = [sin(2 * t), t, 0] + body.velocity))] struct Body { #[gauss(mass)] m: f64, \
         #[gauss(inertia)] j: Vector3<f64> }",
    );
}

#[test]
fn what_agrees() {
    accepted(
        "input(a = \"N\", b = \"kg m/s^2\", angle = \"rad\", turns = \"Hz\"), \
         define(speed = sqrt(dot(body.velocity, body.velocity)), way = body.position - [l, l, 0]), \
         force(body = body, value = -c * speed * body.body_velocity + [a, max(a, b), hypot(a, clamp(b, 0, 5))]), \
         force(at = [l, 0, -l / 2], value = body.rotation * [a, b, m * g * sin(turns * t)]), \
         torque(value = cross(way, [a, b, 0]) + l * [a * abs(angle), k * way.x * smooth_step(t, 0, 1), 0]), \
         torque(value = [atan2(way.y, way.x) * k * powi(l, 2), j.x * powi(turns, 2), c * powi(l, 3) * powi(t, -2)]), \
         potential = k * dot(way, way) / 2 + m * g * way.z, damping = c * speed * dot(body.velocity, body.velocity), \
         medium(velocity = w + [l, 0, 0] / t), central_gravity(mu = g * l * l, center = w * t), \
         drag(linear = [c * w.x, 0, 0, 0, 0, k * l * l * free], quadratic = [c, c, c, c * powi(l, 3), 0, 0]), \
         spring(from = body.position, to = [l, 0, 0], stiffness = k, length = l, damping = c * w.x), \
         spring(along = atan2(way.y, way.x), stiffness = k * l * l, length = 1), \
         stop(along = way.z, least = -l, most = l, stiffness = k, width = l / 10), \
         wrench(force = [a, a * exp(-t * turns), signum(speed) * b], torque = body.angular_velocity * j.x * turns)",
    );
}

#[test]
fn forces_and_torques() {
    mistakes(
        "input(thrust = \"N\", rudder = \"rad\", gain = \"1\", gust: Wrench), \
         force(at = [l, k, 0], value = [thrust, rudder, thrust + rudder]), \
         torque(value = [gain, thrust - l, -k]), wrench(at = w, force = gust.torque, torque = gust.force), \
         force(body = body, value = -2 * body.velocity)",
        &[
            (
                "k",
                "`k` is in N/m, and the place where a force acts is in m; multiply it by a coefficient in m s^2/kg, or \
                 correct its unit",
            ),
            (
                "rudder",
                "`rudder` is in rad (dimensionless), and the components of a force are in N; multiply it by a \
                 coefficient in N (N/rad)",
            ),
            (
                "+",
                "the sum of `thrust` (N) and `rudder` (rad): terms of a sum have one unit; multiply the latter by a \
                 coefficient in N",
            ),
            (
                "gain",
                "`gain` is dimensionless, and the components of a torque are in N m; multiply it by a coefficient in \
                 N m, or correct its unit",
            ),
            (
                "-",
                "the difference of `thrust` (N) and `l` (m): the two sides of `-` have one unit; multiply the latter by \
                 a coefficient in N/m",
            ),
            (
                "k",
                "`k` is in N/m, and the components of a torque are in N m; multiply it by a coefficient in m^2, or \
                 correct its unit",
            ),
            (
                "w",
                "`w` is in m/s, and the place where a force acts is in m; multiply it by a coefficient in s, or correct \
                 its unit",
            ),
            (
                "torque",
                "`gust.torque` is in N m, and the components of a force are in N; multiply it by a coefficient in 1/m",
            ),
            (
                "force",
                "`gust.force` is in N, and the components of a torque are in N m; multiply it by a coefficient in m",
            ),
            (
                "*",
                "this product is in m/s, and the components of a force are in N; multiply it by a coefficient in N s/m, \
                 such as a field with this unit: numbers have none",
            ),
        ],
    );
}

#[test]
fn energies_streams_and_drags() {
    mistakes(
        "potential = k * l, damping = k * l * l, medium(velocity = [t, 3, w.y]), central_gravity(mu = g, center = w * t), \
         drag(linear = [c, 1, 0, free, k, 0], quadratic = [c, 0, 0, c, 0, 0])",
        &[
            ("*", "this product is in N, and a potential is in J; multiply it by a coefficient in m"),
            ("t", "`t` is in s, and the velocity of the medium is in m/s; multiply it by a coefficient in m/s^2"),
            (
                "g",
                "`g` is in m/s^2, and the gravitational parameter of an attraction is in m^3/s^2; multiply it by a \
             coefficient in m^2",
            ),
            ("*", "this product is in N m, and a dissipation function is in W; multiply it by a coefficient in 1/s"),
            (
                "c",
                "`c` is in N s²/m², and the first three linear coefficients of a drag are in N s/m; multiply it by a \
                 coefficient in m/s, or correct its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the last three linear coefficients of a drag are in N m s; multiply it by a \
                 coefficient in m^2 s, or correct its unit",
            ),
            (
                "c",
                "`c` is in N s²/m², and the last three quadratic coefficients of a drag are in N m s^2; multiply it by a \
                 coefficient in m^3, or correct its unit",
            ),
        ],
    );
}

#[test]
fn springs_and_stops() {
    mistakes(
        "spring(from = w, to = [0, 0, l], stiffness = c, length = k, damping = k), \
         spring(along = atan2(body.position.y, body.position.x), stiffness = k, length = l), \
         stop(along = body.position.z, least = k, most = l, stiffness = k, width = l, damping = k), \
         spring(along = free * body.position.x, stiffness = sin(l) * c)",
        &[
            (
                "w",
                "`w` is in m/s, and the ends of a spring are in m; multiply it by a coefficient in s, or correct its unit",
            ),
            (
                "c",
                "`c` is in N s²/m², and the stiffness of a spring is in N/m; multiply it by a coefficient in m/s^2, or \
                 correct its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the length of a spring is in m; multiply it by a coefficient in m s^2/kg, or correct \
                 its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the damping of a spring is in N s/m; multiply it by a coefficient in s, or correct \
                 its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the stiffness of a spring along an angle is in N m; multiply it by a coefficient in \
                 m^2, or correct its unit",
            ),
            (
                "l",
                "`l` is in m, and the length of a spring along an angle is in rad; multiply it by a coefficient in 1/m, \
                 or correct its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the lower limit of a stop along a length is in m; multiply it by a coefficient in \
                 m s^2/kg, or correct its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the damping of a stop along a length is in N s/m; multiply it by a coefficient in s, \
                 or correct its unit",
            ),
            (
                "l",
                "`l` is in m, and `sin` takes angles in rad (dimensionless); multiply it by a coefficient in 1/m, or \
                 correct its unit",
            ),
        ],
    );
}

#[test]
fn functions() {
    mistakes(
        "define(u = [l, g, t], r = rotation_z(l), e = exp(k)), force(body = body, value = r * u), \
         force(body = body, value = cross(u, u)), torque(value = u), torque(value = dot(u, u) * w * e), \
         force(body = body, value = [min(l, g), clamp(k * l, 0, t), sqrt(l)]), \
         force(body = body, value = [smooth_step(l, 0, t), atan2(l, t), 5 * sin(2 * t)]), \
         torque(value = rate(body.position)), torque(value = w.z * [l, 0, signum(l)])",
        &[
            (
                "l",
                "`l` is in m, and `rotation_z` takes angles in rad (dimensionless); multiply it by a coefficient in 1/m, \
                 or correct its unit",
            ),
            (
                "k",
                "`k` is in N/m, and the argument of `exp` is dimensionless; multiply it by a coefficient in s^2/kg, or \
                 correct its unit",
            ),
            (
                "*",
                "a rotation mixes the components of a vector, and here one is in m and another in m/s^2; give them one \
                 unit",
            ),
            (
                "cross",
                "`cross(…).x` is in m/s, and the components of a force are in N; multiply it by a coefficient in N s/m",
            ),
            ("u", "`u.x` is in m, and the components of a torque are in N m; multiply it by a coefficient in N"),
            (
                "dot",
                "`dot` adds products of components, and here one is in m^2 and another in m^2/s^4; give the components \
                 of each vector one unit",
            ),
            (
                "min",
                "`min` of `l` (m) and `g` (m/s^2): its arguments have one unit; multiply the latter by a coefficient in \
                 s^2",
            ),
            (
                "clamp",
                "`clamp` of a product (N) and `t` (s): its arguments have one unit; multiply the latter by a coefficient \
                 in kg m/s^3",
            ),
            (
                "sqrt",
                "`sqrt(…)` is in m^(1/2), and the components of a force are in N; multiply it by a coefficient in \
                 kg m^(1/2)/s^2",
            ),
            (
                "smooth_step",
                "`smooth_step` of `l` (m) and `t` (s): its arguments have one unit; multiply the latter by a coefficient \
                 in m/s",
            ),
            (
                "atan2",
                "`atan2` of `l` (m) and `t` (s): its arguments have one unit; multiply the latter by a coefficient in m/s",
            ),
            (
                "*",
                "this product is in s, and `sin` takes angles in rad (dimensionless); multiply it by a coefficient in \
                 1/s, such as a field with this unit: numbers have none",
            ),
            (
                "rate",
                "`rate(…)` is in m/s, and the components of a torque are in N m; multiply it by a coefficient in N s",
            ),
            (
                "*",
                "the first component of this product is in m^2/s, and the components of a torque are in N m; multiply it by \
                 a coefficient in N s/m",
            ),
        ],
    );
}

#[test]
fn systems() {
    let scene = |clauses: &str| {
        format!(
            "#[gauss(coordinates(x, attitude: Rotation, pose: Pose), speeds(v, w: Vector3, u: Vector3, n: Vector3), \
             kinematics(x = v, {clauses}), body(hull, position = pose.position, rotation = pose.rotation), \
             body(top, rotation = attitude, position = [x, 0, 0])) ] struct Scene {{ #[gauss(body)] hull: RigidBody<f64>, #[gauss(body)] top: RigidBody<f64>, #[gauss(unit = \"m\")] l: f64, \
             #[gauss(unit = \"1/s\")] rate_of_turn: f64, }}"
        )
    };
    system(&scene("attitude = w + [0, 0, rate_of_turn], pose = twist(u + [l * rate_of_turn, 0, 0], n)"));
    check(
        &scene("attitude = w + [0, 0, l], pose = twist([l, u.y, u.z], [n.x, n.y, n.z + l])"),
        &[
            (
                "+",
                "the third component of this sum is in m, and an angular velocity is in rad/s; multiply it by a \
                 coefficient in 1/(m s)",
            ),
            (
                "l",
                "`l` is in m, and the velocity of a twist is in m/s; multiply it by a coefficient in 1/s, or correct its \
                 unit",
            ),
            (
                "+",
                "this sum is in m, and the angular velocity of a twist is in rad/s; multiply it by a coefficient in \
                 1/(m s)",
            ),
        ],
    );
}
