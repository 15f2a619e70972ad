//! Contacts and ranges.

use super::super::{Mistake, check};
use super::{show, system};
use crate::model::{ContactGeometry, Counterpart};

/// A body in space with a hinged arm, with more `clauses`.
fn arm(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(pose: Pose, theta), speeds(u: Vector3, w: Vector3, v), kinematics(pose = twist(u, w), theta = v), \
         body(hull, position = pose.position, rotation = pose.rotation), body(arm, parent = hull, rotation = rotation_x(theta)), \
         frame(quay), point(tip, body = arm, at = [0, 0, l]), {clauses})] \
         struct Scene {{ #[gauss(body)] hull: RigidBody<f64>, #[gauss(body)] arm: RigidBody<f64>, l: f64, k: f64, \
         c: Vector3<f64> }}"
    )
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&arm(clauses), expected);
}

#[test]
fn accepted() {
    let model = system(&arm(
        "input(grip), contact(floor, gap = tip.z - l * t, slip = [tip.velocity.x, rate(tip.y)], friction = k + abs(grip)), \
         contact(wall, gap = theta, slip = v, friction = k, restitution = 0.5), contact(post, gap = l - tip.x), \
         range(theta, from = -k, to = k, restitution = k), range(reach, along = tip.x, to = l * t), \
         contact(ball, point = hull.position, radius = l, plane = c, height = l * t, along = [1, 0, 0], friction = k), \
         contact(disk, point = tip, rim = l, axis = c), contact(both, point = tip, other = hull.position, other_radius = l), \
         contact(limb, point = hull.position, other = arm.position, other_end = tip, other_radius = l), \
         contact(rub, point = tip, radius = l, other = hull.position, other_radius = l, along = c, friction = k), \
         contact(case, point = tip, edges = [l, 0.0, 2 * l], friction = k), contact(shin, point = tip, end = hull.position), \
         contact(drum, point = tip, rim = l, axis = c, length = k), \
         contact(egg, point = tip, semi_axes = [l, 2 * l, k], plane = c, height = l * t), \
         contact(hill, point = tip, height = k * sin(x) + theta_0 * t, over = [x, theta_0]), \
         dry_friction(theta, bound = k), dry_friction(v, bound = k * abs(v)), \
         dry_friction(brake, slip = [v - k, tip.velocity.x], bound = [k, k + abs(grip)])",
    ));
    let shown = model.contacts.iter().map(|clause| {
        let names: Vec<String> = clause.names.iter().map(ToString::to_string).collect();
        let touching = match &clause.touching {
            ContactGeometry::Gap { gap, slips, .. } => {
                format!("gap {}, slips {:?}", show(gap), slips.iter().map(show).collect::<Vec<_>>())
            }
            ContactGeometry::Slip { slips, .. } => {
                let all = [slips, &clause.friction].map(|all| all.iter().map(show).collect::<Vec<_>>());
                format!("slips {:?}, bounds {:?}", all[0], all[1])
            }
            ContactGeometry::Range { along, from, to } => {
                format!("{} from {:?} to {:?}", show(along), from.as_ref().map(show), to.as_ref().map(show))
            }
            ContactGeometry::Point(contact) => match &contact.against {
                Counterpart::Plane { normal, .. } => {
                    format!("{} above {:?}", show(&contact.point), normal.as_ref().map(show))
                }
                Counterpart::Ground(height) => format!("{} over {}", show(&contact.point), show(height)),
                Counterpart::Sphere { center, .. } => format!("{} and {}", show(&contact.point), show(center)),
            },
        };
        format!("{}: {touching}", names.join(", "))
    });
    assert_eq!(
        shown.collect::<Vec<_>>(),
        [
            "floor: gap (Subtract tip[2] (Multiply l t)), slips [\"tip.Velocity[0]\", \"(rate tip[1])\"]",
            "wall: gap theta, slips [\"v\"]",
            "post: gap (Subtract l tip[0]), slips []",
            "theta_from, theta_to: theta from Some(\"(-k)\") to Some(\"k\")",
            "reach_to: tip[0] from None to Some(\"(Multiply l t)\")",
            "ball: hull.Position above Some(\"c\")",
            "disk: tip above None",
            "both: tip and hull.Position",
            "limb: hull.Position and arm.Position",
            "rub: tip and hull.Position",
            "case_0, case_1, case_2, case_3: tip above None",
            "shin_0, shin_1: tip above None",
            "drum_0, drum_1: tip above None",
            "egg: tip above Some(\"c\")",
            "hill: tip over (Add (Multiply k (sin place 0)) (Multiply place 1 t))",
            "theta: slips [\"(rate theta)\"], bounds [\"k\"]",
            "v: slips [\"v\"], bounds [\"(Multiply k (abs v))\"]",
            "brake: slips [\"(Subtract v k)\", \"tip.Velocity[0]\"], bounds [\"k\", \"(Add k (abs grip))\"]",
        ]
    );
}

#[test]
fn clauses() {
    mistakes(
        "contact, contact(), contact(gap = theta), contact(a), contact(b, gp = theta), contact(c1, gap = theta, friction = k), \
         contact(d, gap = theta, slip = v), contact(f, gap = theta, slip = [v, v, v], friction = k), \
         contact(g, gap = theta, mu = k), contact(h, gap = theta, gap = v), range(theta), range(theta, least = 1), \
         range(from = 1), contact(i, point = tip, gap = theta), contact(j, point = tip, slip = v), \
         contact(m, gap = theta, radius = l), contact(n, point = tip, radius = l, rim = k), \
         contact(o, point = tip, edges = l), contact(p, point = tip, length = l, other = hull.position), \
         contact(q, gap = theta, edges = [l, l, l]), contact(r, point = tip, height = k, over = [x, y, z]), \
         contact(s, point = tip, radius = l, height = k * x, over = x), contact(u, point = tip, over = [x, y]), \
         contact(v, point = tip, height = k, over = [2, y]), contact(w, point = tip, edges = [l, l, l], end = tip)",
        &[
            ("contact", "`contact` is empty; write `contact(name, gap = …)`"),
            ("(", "`contact()` is empty; write `contact(name, gap = …)` or remove it"),
            ("contact", "a contact needs a name, by which a run tells its forces; write `contact(name, gap = …)`"),
            (
                "contact",
                "a contact needs what may not become negative, or a point that touches; add `gap = z - r` or `point = tip`",
            ),
            ("gp", "unknown argument of `contact`: `gp`; did you mean `gap`?"),
            (
                "friction",
                "friction acts along a slip; add `slip = v`, the velocity along the tangent, or `slip = [u, v]` of two \
                 tangents that are normal to each other",
            ),
            ("slip", "without friction the slip does nothing; add `friction = mu`, or remove `slip`"),
            ("[", "`slip` is one scalar or two, one for each tangent, found 3; write `slip = v` or `slip = [u, v]`"),
            ("mu", "unknown argument of `contact`: `mu`; write `friction`"),
            ("gap", "`gap` is given twice; keep one of the two"),
            ("range", "a range needs a limit; add `from = a`, `to = b`, or both"),
            ("least", "unknown argument of `range`: `least`; write `from`"),
            (
                "range",
                "a range needs the coordinate that it limits, or a name of its own with `along = …`; write \
                 `range(x, from = a, to = b)`",
            ),
            ("gap", "`point` already gives the gap; remove `gap`, or remove `point`"),
            (
                "slip",
                "the slip of a point follows from its motion; remove `slip`, or write the gap in place of `point` as \
                 well: `gap = …, slip = …`",
            ),
            ("radius", "`radius` goes with `point = …`; add it, or remove `radius`"),
            ("rim", "`rim` goes with `axis = …`; add it, or remove `rim`"),
            ("rim", "`rim` is the radius of a disk and `radius` that of a sphere; keep one of the two"),
            ("l", "the edges of a box are three lengths in brackets; write `edges = [a, b, c]`"),
            ("length", "`length` goes with `rim = …`; add it, or remove `length`"),
            ("edges", "`edges` goes with `point = …`; add it, or remove `edges`"),
            (
                "[",
                "`over` is one name or two, those of the horizontal coordinates, found 3; write `over = x` or `over = [x, y]`",
            ),
            ("radius", "which point of a sphere is nearest to such a ground has no closed form; remove `radius`"),
            ("over", "`over` goes with `height = …`; add it, or remove `over`"),
            ("2", "`over` gives names to the horizontal coordinates; write `over = [x, y]`"),
            ("edges", "a box has corners and a capsule has two ends; write a clause for each"),
        ],
    );
}

#[test]
fn capsules_that_are_touched() {
    mistakes(
        "contact(a, point = tip, other_end = hull.position), \
         contact(b, point = tip, end = hull.position, other = quay.position, other_end = hull.position), \
         contact(d, point = tip, rim = l, axis = c, other = quay.position, other_end = quay.position)",
        &[
            ("other_end", "`other_end` goes with `other = …`; add it, or remove `other_end`"),
            ("end", "the distance of two capsules has a kink where they are parallel; write spheres of one of them"),
            (
                "end",
                "of a sphere and a capsule the sphere comes first: write its center as `point`, `other` and `other_end`",
            ),
            ("rim", "a rim touches a plane alone; write the gap to another sphere as `gap = …`"),
        ],
    );
    let one_body = "a capsule is one body: write `other` and `other_end` as points of one, or as `hull.position`";
    mistakes(
        "contact(a, point = tip, other = quay.position, other_end = hull.position), \
         contact(b, point = tip, other = [0, 0, 0], other_end = [0, 0, 1])",
        &[("position", one_body), ("[", one_body)],
    );
}

#[test]
fn ellipsoids() {
    mistakes(
        "contact(a, point = tip, semi_axes = l), contact(b, gap = theta, semi_axes = [l, l, l]), \
         contact(d, point = tip, semi_axes = [l, l, l], radius = l), \
         contact(e, point = tip, semi_axes = [l, l, l], rim = l, axis = c), \
         contact(f, point = tip, semi_axes = [l, l, l], edges = [l, l, l]), \
         contact(g, point = tip, semi_axes = [l, l, l], end = hull.position), \
         contact(h, point = tip, semi_axes = [l, l, l], other = hull.position), \
         contact(i, point = tip, semi_axes = [l, l, l], height = x, over = x), contact(j, point = tip, semi_axis = [l, l, l])",
        &[
            ("l", "the semi-axes of an ellipsoid are three lengths in brackets; write `semi_axes = [a, b, c]`"),
            ("semi_axes", "`semi_axes` goes with `point = …`; add it, or remove `semi_axes`"),
            ("semi_axes", "an ellipsoid has three semi-axes and a sphere a radius; keep one of the two"),
            ("semi_axes", "an ellipsoid has three semi-axes and a disk has a rim; write a clause for each"),
            ("semi_axes", "an ellipsoid has no corners; write a clause for each"),
            ("semi_axes", "a capsule has spheres at its ends; write a clause for each ellipsoid"),
            ("semi_axes", "an ellipsoid touches a plane alone: its distance from a sphere has no closed form"),
            (
                "semi_axes",
                "which point of an ellipsoid is nearest to such a ground has no closed form; remove `semi_axes`",
            ),
            ("semi_axis", "unknown argument of `contact`: `semi_axis`; did you mean `semi_axes`?"),
        ],
    );
    mistakes(
        "contact(a, point = tip, semi_axes = [l, theta, c]), contact(b, point = tip, semi_axes = [l, k, t])",
        &[
            ("theta", "`theta` varies, and the semi-axis of a contact is constant; write numbers and fields only"),
            ("c", "the semi-axis of a contact is a scalar, found a vector; write one number or the name of a field"),
            ("t", "`t` varies, and the semi-axis of a contact is constant; write numbers and fields only"),
        ],
    );
    mistakes(
        "contact(a, point = [0, 0, theta], semi_axes = [l, l, l])",
        &[(
            "[",
            "a box, a rim, an ellipsoid, or a sphere with friction, turns with its body; write `point = ball.position` of \
             the body, or the name of a point that is fixed in it",
        )],
    );
}

#[test]
fn names() {
    mistakes(
        "contact(floor, gap = theta), contact(floor, gap = -theta), range(theta, to = k), contact(theta_to, gap = theta), \
         contact(shin, point = tip, end = hull.position), contact(shin_1, gap = theta)",
        &[
            ("floor", "two contacts are called `floor`; rename one of the two"),
            ("theta_to", "two contacts are called `theta_to`; rename one of the two"),
            ("shin_1", "two contacts are called `shin_1`; rename one of the two"),
        ],
    );
    mistakes(
        "range(knee, from = k), contact(a, point = nail), contact(b, gap = hul.position.z)",
        &[
            (
                "knee",
                "unknown name `knee`; expected a coordinate (`pose` or `theta`), a field (`l`, `k` or `c`), a body (`hull` or `arm`), a frame (`quay`), a point (`tip`) or `t`",
            ),
            (
                "nail",
                "unknown name `nail`; expected a coordinate (`pose` or `theta`), a field (`l`, `k` or `c`), a body (`hull` or `arm`), a frame (`quay`), a point (`tip`) or `t`",
            ),
            ("hul", "unknown name `hul`; did you mean the body `hull`?"),
        ],
    );
}

#[test]
fn what_stands_where() {
    mistakes(
        "contact(a, gap = v), contact(b, gap = tip), contact(d, gap = tip.velocity.z), \
         contact(e, gap = theta, slip = tip.velocity, friction = k), contact(f, gap = theta, slip = v, friction = c), \
         contact(g, gap = theta, restitution = theta), contact(h, gap = abs(theta)), contact(i, point = tip, plane = tip), \
         contact(j, point = tip, height = theta), range(theta, from = c), \
         contact(o, point = tip, height = x + y + theta, over = x), contact(p, point = tip, edges = [l, theta, c]), \
         contact(q, point = tip, height = abs(x), over = [x, y])",
        &[
            (
                "v",
                "`v` is a speed, and a gap depends on coordinates, fields and `t` only; its rate is formed from it; \
                 velocities stand in `slip = …`",
            ),
            ("tip", "a gap is a scalar, found a vector; write one number, such as `ball.position.z - r`"),
            (
                "velocity",
                "`tip.velocity` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; its \
                 rate is formed from it; velocities stand in `slip = …`",
            ),
            (
                "velocity",
                "a slip is a scalar, found a vector; write one number, such as `dot(tip.velocity, [1, 0, 0])`",
            ),
            ("c", "a coefficient of friction is a scalar, found a vector; write one number or the name of a field"),
            (
                "theta",
                "`theta` varies, and the coefficient of restitution of a contact is constant; write numbers and fields only",
            ),
            ("abs", "the derivative of `abs` jumps, and a gap is differentiated; only values of forces can contain it"),
            (
                "tip",
                "`tip` varies, and a direction is constant; write numbers and fields only, or the whole gap as `gap = …`",
            ),
            (
                "theta",
                "`theta` moves with the system, and the height of a plane is given beforehand; write it in `t`, fields and \
                 numbers, or the whole gap as `gap = …`",
            ),
            ("c", "the limit of a range is a scalar, found a vector; write one number or the name of a field"),
            ("y", "unknown name `y`; expected a field (`l`, `k` or `c`) or `t`"),
            (
                "theta",
                "`theta` moves with the system, and the height of a plane is given beforehand; write it in `t`, fields and \
                 numbers, or the whole gap as `gap = …`",
            ),
            ("theta", "`theta` varies, and the edge of a contact is constant; write numbers and fields only"),
            ("c", "the edge of a contact is a scalar, found a vector; write one number or the name of a field"),
            (
                "abs",
                "the derivative of `abs` jumps, and the height of a plane is differentiated; only values of forces can contain it",
            ),
        ],
    );
}

#[test]
fn what_does_not_move() {
    mistakes(
        "contact(a, gap = l - t), contact(b, gap = theta, slip = theta, friction = k), range(reach, along = l, to = k), \
         contact(d, point = quay.position), contact(e, point = [theta, 0, 0], radius = l, friction = k), \
         contact(f, point = tip, plane = c, friction = k), contact(g, point = [0, 0, theta], edges = [l, l, l]), \
         contact(h, point = tip, other = [0, theta, 0], other_radius = l, friction = k)",
        &[
            (
                "-",
                "the gap names nothing that moves, so it never closes; name a coordinate, or a body or point that moves",
            ),
            (
                "theta",
                "the slip contains no velocity of anything that moves; write `tip.velocity`, a speed, or the time \
                 derivative `rate(…)`",
            ),
            (
                "l",
                "the range is that of nothing that moves, as a locked coordinate is; name a coordinate, or a body or point \
                 that moves",
            ),
            (
                "position",
                "the point does not move, so it never touches; name a coordinate, or a body or point that moves",
            ),
            (
                "[",
                "a box, a rim, an ellipsoid, or a sphere with friction, turns with its body; write `point = ball.position` of \
                 the body, or the name of a point that is fixed in it",
            ),
            (
                "c",
                "the tangents of a normal that is not written in numbers are not known; add `along = [1, 0, 0]`, a \
                 direction that is not that of the normal",
            ),
            (
                "[",
                "a box, a rim, an ellipsoid, or a sphere with friction, turns with its body; write `point = ball.position` of \
                 the body, or the name of a point that is fixed in it",
            ),
            (
                "[",
                "a box, a rim, an ellipsoid, or a sphere with friction, turns with its body; write `point = ball.position` of \
                 the body, or the name of a point that is fixed in it",
            ),
            (
                "[",
                "the tangents of two spheres turn with their line of centers; add `along = [0, 0, 1]`, a direction that this \
                 line never has",
            ),
        ],
    );
}

#[test]
fn units() {
    let scene = |clauses: &str| {
        format!(
            "#[gauss(coordinates(x), particle(mass = 1, position = [x * l, 0, 0]), {clauses})] struct Scene {{ \
             #[gauss(unit = \"m\")] l: f64, #[gauss(unit = \"s\")] s: f64, #[gauss(unit = \"N\")] f: f64 }}"
        )
    };
    system(&scene("contact(a, gap = l * sin(x), slip = l / s + rate(x), friction = l / l, restitution = 0.5)"));
    system(&scene(
        "contact(a, gap = l * sin(x), slip = l / s + rate(x), friction = 1, spin = 1 / s + rate(x), drilling = l, \
         roll = 1 / s + rate(x), rolling = l)",
    ));
    check(
        &scene(
            "contact(a, gap = l * sin(x), slip = l / s + rate(x), friction = 1, spin = l / s + rate(x), drilling = s, \
             roll = 1 / s + rate(x), rolling = 1 / l)",
        ),
        &[
            ("+", "this sum is in m/s, and a spin and a roll are in rad/s; multiply it by a coefficient in 1/m"),
            (
                "s",
                "`s` is in s, and radii of drilling and arms of rolling resistance are in m; multiply it by a coefficient in \
                 m/s, or correct its unit",
            ),
            (
                "/",
                "this quotient is in 1/m, and radii of drilling and arms of rolling resistance are in m; multiply it by a \
                 coefficient in m^2, such as a field with this unit: numbers have none",
            ),
        ],
    );
    system(&scene("dry_friction(x, bound = f * l), dry_friction(belt, slip = l / s + rate(x), bound = f)"));
    check(
        &scene("dry_friction(belt, slip = [l / s + rate(x), 1 / s + rate(x)], bound = [f * l, f * l])"),
        &[(
            "*",
            "this product is in N m, and the bound of this dry friction is in N; multiply it by a coefficient in 1/m",
        )],
    );
    check(
        &scene(
            "contact(a, gap = l * sin(x), slip = f * rate(x), friction = l), range(b, along = l * sin(x), to = s), \
             contact(d, point = [l * x, 0, 0], height = f), contact(e, point = [l * x, 0, 0], height = s * u, over = u)",
        ),
        &[
            (
                "l",
                "`l` is in m, and a coefficient of friction is in no unit; multiply it by a coefficient in 1/m, or correct its unit",
            ),
            (
                "s",
                "`s` is in s, and the limit of this range is in m; multiply it by a coefficient in m/s, or correct its unit",
            ),
            (
                "f",
                "`f` is in N, and points, radii and heights of a contact are in m; multiply it by a coefficient in s^2/kg, or correct its unit",
            ),
            (
                "*",
                "this product is in m s, and points, radii and heights of a contact are in m; multiply it by a coefficient in 1/s",
            ),
        ],
    );
}

#[test]
fn dry_friction() {
    mistakes(
        "dry_friction(), dry_friction(theta), dry_friction(slip = v, bound = k), dry_friction(a, slip = v, friction = k), \
         contact(f, gap = theta, slip = v, friction = [k, k, k]), brake(g, slip = v, bound = k)",
        &[
            ("(", "`dry_friction()` is empty; write `dry_friction(x, bound = f)` or remove it"),
            ("dry_friction", "dry friction needs the largest force that it has; add `bound = f`"),
            (
                "dry_friction",
                "dry friction needs the coordinate or the speed that it resists, or a name of its own with `slip = …`; write \
                 `dry_friction(x, bound = f)`",
            ),
            ("friction", "unknown argument of `dry_friction`: `friction`; write `bound`"),
            (
                "[",
                "`friction` is one scalar or two, one for each tangent, found 3; write `friction = v` or `friction = [u, v]`",
            ),
            (
                "brake",
                "unknown clause `brake`; dry friction of a bound is `dry_friction(x, bound = f)` of a coordinate, or \
                 `dry_friction(name, slip = v, bound = f)`, v the velocity relative to what rubs",
            ),
        ],
    );
    mistakes(
        "dry_friction(b, slip = v, bound = [k, k]), dry_friction(d, slip = theta, bound = k), \
         dry_friction(e, slip = v, bound = c), dry_friction(b, slip = v, bound = 1), \
         contact(g, gap = theta, slip = v, friction = [k, k])",
        &[
            ("b", "two contacts are called `b`; rename one of the two"),
            ("c", "the bound of dry friction is a scalar, found a vector; write one number or the name of a field"),
            ("k", "along one slip there is one friction; remove the second, or write `slip = [u, v]`"),
            (
                "theta",
                "the slip contains no velocity of anything that moves; write `tip.velocity`, a speed, or the time \
                 derivative `rate(…)`",
            ),
            ("k", "along one slip there is one friction; remove the second, or write `slip = [u, v]`"),
        ],
    );
    mistakes(
        "dry_friction(knee, bound = k)",
        &[(
            "knee",
            "unknown name `knee`; expected a coordinate (`pose` or `theta`), a speed (`u`, `w` or `v`), a field (`l`, `k` or \
             `c`), a body (`hull` or `arm`), a frame (`quay`), a point (`tip`) or `t`",
        )],
    );
}

#[test]
fn drilling_and_rolling() {
    let model = system(&arm(
        "input(grip), contact(ball, point = hull.position, radius = l, friction = k, drilling = 2 * l / 3, rolling = grip), \
         contact(case, point = tip, edges = [l, 0, 0], friction = k, rolling = k * abs(v)), \
         contact(foot, point = tip, friction = k, drilling = l), \
         contact(disk, gap = theta, slip = [v, w.x], friction = k, spin = w.z, drilling = l, roll = [w.x, w.y], rolling = k)",
    ));
    let names = model.contacts.iter().map(|clause| clause.names.iter().map(ToString::to_string).collect::<Vec<_>>());
    assert_eq!(
        names.collect::<Vec<_>>(),
        [
            &["ball", "ball_rolling"][..],
            &["case_0", "case_0_rolling", "case_1", "case_1_rolling"],
            &["foot"],
            &["disk", "disk_rolling"]
        ]
    );
    let spins = "what drills or rolls turns with its body; write `point = ball.position` of the body, or the name of a point \
                 that is fixed in it";
    let still = "this contains no velocity of anything that moves; write a component of `ball.angular_velocity`, a speed, or \
                 the time derivative `rate(…)`";
    mistakes(
        "contact(a, point = tip, drilling = l), contact(b, point = tip, rolling = l), \
         contact(d, point = tip, friction = k, drilling = l, spin = v), \
         contact(e, point = tip, friction = k, rolling = l, roll = v), \
         contact(f, gap = theta, slip = v, friction = k, drilling = l), \
         contact(g, gap = theta, slip = v, friction = k, rolling = l), \
         contact(h, gap = theta, slip = v, friction = k, spin = v), contact(i, gap = theta, slip = v, friction = k, roll = v), \
         contact(m, gap = theta, slip = v, friction = k, roll = [v, v, v], rolling = l), range(theta, to = k, drilling = l), \
         contact(n, point = tip, friction = k, driling = l)",
        &[
            ("drilling", "`drilling` goes with `friction = …`; add it, or remove `drilling`"),
            ("rolling", "`rolling` goes with `friction = …`; add it, or remove `rolling`"),
            ("spin", "the spin of a point follows from the motion of its body; remove `spin`"),
            ("roll", "how a point rolls follows from the motion of its body; remove `roll`"),
            (
                "drilling",
                "friction of drilling acts along a spin; add `spin = w`, the angular velocity about the normal",
            ),
            (
                "rolling",
                "rolling resistance acts along angular velocities; add `roll = w`, that about the tangent, or `roll = [a, b]` \
                 of two tangents",
            ),
            ("spin", "`spin` goes with `drilling = …`; add it, or remove `spin`"),
            ("roll", "`roll` goes with `rolling = …`; add it, or remove `roll`"),
            ("[", "`roll` is one scalar or two, one for each tangent, found 3; write `roll = v` or `roll = [u, v]`"),
            ("drilling", "unknown argument of `range`: `drilling`; expected `along`, `from`, `to` or `restitution`"),
            ("driling", "unknown argument of `contact`: `driling`; did you mean `drilling`?"),
        ],
    );
    mistakes(
        "contact(a, point = tip, friction = [k, k], drilling = l), contact(b, point = tip, friction = k, drilling = theta), \
         contact(d, point = tip, friction = k, rolling = c), contact(e, point = [0, 0, theta], friction = k, drilling = l), \
         contact(f, point = tip, other = [0, theta, 0], along = c, friction = k, rolling = l), \
         contact(g, gap = theta, slip = v, friction = k, spin = theta, drilling = l), \
         contact(h, gap = theta, slip = v, friction = k, roll = [v, l], rolling = l), \
         contact(a_rolling, gap = theta), contact(a, gap = -theta, slip = v, friction = k, roll = v, rolling = l)",
        &[
            ("a", "two contacts are called `a`; rename one of the two"),
            ("a", "two contacts are called `a_rolling`; rename one of the two"),
            (
                "theta",
                "`theta` varies, and the radius of drilling of a contact is constant; write numbers and fields only",
            ),
            ("c", "the arm of rolling resistance is a scalar, found a vector; write one number or the name of a field"),
            (
                "k",
                "friction of drilling goes with the same friction along both tangents; write one coefficient, or remove \
                 `drilling`",
            ),
            ("[", spins),
            ("[", spins),
            ("theta", still),
            ("l", still),
        ],
    );
}

/// Derivatives of the equations have no contact forces, which is said where they are asked for.
#[test]
fn derivatives_leave_contacts_out_on_purpose() {
    let with = "the scene has contacts, whose forces are not in the equations that `linearize` differentiates: write \
                `linearize(without_contacts)` where all gaps are open, and for what rests, slides or sticks take \
                `gauss_adapters::linearize` of `InMode` of gauss-contact, without this clause";
    for clause in ["contact(floor, gap = tip.z)", "range(theta, to = k)", "dry_friction(theta, bound = k)"] {
        mistakes(&format!("linearize, {clause}"), &[("linearize", with)]);
        mistakes(&format!("{clause}, linearize(hessian, parameters)"), &[("linearize", with)]);
        let model = system(&arm(&format!("linearize(without_contacts, hessian), {clause}")));
        assert!(model.item.wanted.linearize.is_some() && model.item.wanted.hessian);
    }
    let without =
        "`linearize(without_contacts)` is for scenes with contacts, and this one has none; leave the word out";
    mistakes("linearize(without_contacts), potential = k * tip.z", &[("linearize", without)]);
}
