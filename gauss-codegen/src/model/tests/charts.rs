//! Charts beside everything else that a scene can have, and what the fluid does to any body.

use super::{check, model};
use crate::model::CoordinateKind;
use crate::terms::{BodyChart, Chart, Motion, Role, Shape};

/// A body in a chart under clauses, with more fields.
fn body(clauses: &str) -> String {
    format!(
        "#[gauss({clauses})] struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: Vector3<f64>, l: f64, \
         c: Vector3<f64>, d: Matrix6<f64>, e: Vector6<f64>, n: usize }}"
    )
}

#[test]
fn a_chart_with_all_that_systems_have() {
    let model = model(&body(
        "chart = hybrid, coordinates(bend, ring: Rotation), speeds(r, w: Vector3), kinematics(bend = 2 * r, ring = w), \
         body(arm, parent = body, rotation = rotation_z(bend), mass = l, inertia = c), frame(mast, parent = arm), \
         particle(mass = l, position = c, parent = mast), point(tip, at = c), constraint(velocity = r * l), \
         independent(b_dot, omega, w), drive(bend = -bend), limit = 1000",
    ));
    assert_eq!(model.in_chart, Some(BodyChart { chart: Chart::Hybrid, motion: Motion::Free }));
    assert!(model.chart_of_all().is_none());
    let kinds: Vec<CoordinateKind> = model.coordinates.iter().map(|coordinate| coordinate.kind).collect();
    assert_eq!(kinds, [CoordinateKind::Scalar, CoordinateKind::Rotation]);
    let own: Vec<bool> = model.bodies.iter().map(|body| model.is_in_chart(body)).collect();
    assert_eq!(own, [true, false, false]);
    assert_eq!((model.particles.len(), model.constraints.len(), model.item.limit), (1, 1, Some(1000)));
    assert_eq!(model.points[0].body, "body");
}

#[test]
fn what_the_chart_says_already() {
    let own = "and `speeds` is for coordinates besides those of the chart; add `coordinates(…)` of what else moves, \
               remove `speeds`, or remove `chart` and `motion`";
    check(
        &body("chart = hybrid, speeds(u: Vector3)"),
        &[("speeds", &format!("the chart has speeds and kinematics of its own, {own}"))],
    );
    check(
        &body(
            "chart = hybrid, body(position = c), coordinates(x), kinematics(x = 1), particle(mass = 1, position = [x, 0, 0])",
        ),
        &[
            (
                "body",
                "the body without a name moves in the chart, which gives its place; give another body a name, \
                 `body(name, …)`, write mass data as clauses of the struct, or remove `chart` and `motion`",
            ),
            (
                "kinematics",
                "`kinematics` needs `speeds`, which it expresses the rates of the coordinates in; add `speeds(…)`, or \
                 remove `kinematics` to have these rates for speeds",
            ),
        ],
    );
}

#[test]
fn speeds_of_charts_by_name() {
    let constrained = |clauses: &str| body(&format!("{clauses}, constraint(velocity = dot(c, body.angular_velocity))"));
    for (chart, names) in [
        ("left_invariant", "u"),
        ("right_invariant", "xi"),
        ("hybrid", "b_dot"),
        ("jet(euler_zyx)", "b1_dot, b2_dot, b3_dot, psi_dot, theta_dot"),
        ("jet(euler_zxz)", "phi_dot, psi_dot"),
        ("jet(modified_rodrigues)", "sigma1_dot"),
    ] {
        model(&constrained(&format!("chart = {chart}, independent({names})")));
    }
    check(
        &constrained("chart = hybrid, independent(u, omga)"),
        &[("u", "`u` is no speed; expected `b_dot` or `omega`"), ("omga", "`omga` is no speed; did you mean `omega`?")],
    );
    check(
        &constrained("chart = left_invariant, motion = fixed_point, independent(omega)"),
        &[(
            "independent",
            "all speeds are named independent, and none is left to solve the constraints for; leave out as many as \
             there are constraints",
        )],
    );
}

#[test]
fn fluid_about_any_body() {
    let model = model(
        "#[gauss(coordinates(a), body(arm, rotation = rotation_x(a), added_mass = d, displaced_mass = 2, \
         center_of_buoyancy = [0, 0, l]), body(fin, parent = arm, mass = 1, inertia = 1, added_mass = [1, l, 2, 0, 0, 1]), \
         medium(velocity = [1, 0, 0]))] \
         struct Scene { #[gauss(body)] arm: RigidBody<f64>, #[gauss(gravity)] g: f64, d: Vector6<f64>, l: f64 }",
    );
    let shapes =
        |k: usize| model.bodies[k].role_clauses.iter().map(|clause| (clause.role, clause.shape)).collect::<Vec<_>>();
    let arm = [
        (Role::AddedMass, Shape::Vector6),
        (Role::DisplacedMass, Shape::Scalar),
        (Role::CenterOfBuoyancy, Shape::Vector3),
    ];
    assert_eq!(shapes(0), arm);
    assert_eq!(shapes(1)[2], (Role::AddedMass, Shape::Vector6));
    assert!(!model.bodies[0].has_matter() && model.bodies[1].has_matter());
}

#[test]
fn fluid_that_is_none() {
    let arm = |clauses: &str| {
        format!(
            "#[gauss(coordinates(a), body(arm, rotation = rotation_x(a), {clauses}))] \
             struct Scene {{ #[gauss(body)] arm: RigidBody<f64>, l: f64, c: Vector3<f64>, n: usize }}"
        )
    };
    check(
        &arm("added_mass = c"),
        &[(
            "c",
            "the type of the field `c` is `Vector3`, and an added mass is six scalars in a list `[a, b, c, d, e, f]`, a \
             `Vector6<f64>` (diagonal) or a `Matrix6<f64>` (full)",
        )],
    );
    check(
        &arm("added_mass = [a, t, 1, 1, 1, 1]"),
        &[
            ("a", "`a` varies, and the entry of an added mass is constant; write numbers and fields only"),
            ("t", "`t` varies, and the entry of an added mass is constant; write numbers and fields only"),
        ],
    );
    check(
        &arm("displaced_mass = 1, gravity = 9.81"),
        &[
            (
                "gravity",
                "unknown argument of `body`: `gravity`; expected `position`, `rotation`, `pose`, `parent`, `mass`, \
                 `center_of_mass`, `inertia`, `inertia_about_center_of_mass`, `added_mass`, `displaced_mass` or `center_of_buoyancy`",
            ),
            (
                "displaced_mass",
                "`displaced_mass` needs a field with the role `gravity`; buoyancy is the displaced mass times gravity: \
                 add `#[gauss(gravity)] g: f64`",
            ),
        ],
    );
    check(
        &arm("center_of_buoyancy = c"),
        &[(
            "center_of_buoyancy",
            "`center_of_buoyancy` of `arm` needs `displaced_mass`; without a displaced mass nothing acts there: add \
             `displaced_mass = …`",
        )],
    );
}
