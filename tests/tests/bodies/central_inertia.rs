//! Inertia about the centre of mass: the same motions as with that about O, by field, clause and `RigidBody`.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, regressor)]
struct AboutO {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    i: Matrix3<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, regressor)]
struct AboutG {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia_about_center_of_mass)]
    i: Matrix3<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid, mass = 1.5, center_of_mass = [0.25, 0.5, -1], inertia_about_center_of_mass = [2, 3, 4], gravity = 9.0
)]
struct ByClause {}

const M: f64 = 1.5;
const C: [f64; 3] = [0.25, 0.5, -1.0];

/// I_O of the principal moments 2, 3, 4 at C.
fn about_o() -> Matrix3<f64> {
    let c = Vector3::from(C);
    Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0)) + (Matrix3::identity() * c.dot(&c) - c * c.transpose()) * M
}

fn state() -> (Isometry3<f64>, SVector<f64, 6>) {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.5, 0.7));
    let pose = Isometry3::from_parts(Vector3::new(1.0, -2.0, 0.5).into(), rotation);
    (pose, SVector::from([0.3, -0.7, 1.1, 0.6, -1.3, 0.4]))
}

/// A hundred roundings of numbers of order ten.
const ROUNDING: f64 = 1e-13;

#[test]
fn one_body_by_field_and_by_clause() {
    let (q, z) = state();
    let i = Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0));
    let known = AboutO { m: M, c: C.into(), i: about_o(), g: 9.0 }.kernel().expect("a body");
    let field = AboutG { m: M, c: C.into(), i, g: 9.0 }.kernel().expect("a body");
    let clause = ByClause {}.kernel().expect("a body");
    let expected = known.acceleration(0.0, &q, &z, &());
    assert!((field.acceleration(0.0, &q, &z, &()) - expected).norm() < ROUNDING);
    assert!((clause.acceleration(0.0, &q, &z, &()) - expected).norm() < ROUNDING);
    let momentum = known.momentum(0.0, &q, &z);
    assert!((field.momentum(0.0, &q, &z) - momentum).norm() < ROUNDING);
    assert!((field.velocity(0.0, &q, &momentum) - z).norm() < ROUNDING);
    assert!((field.kinetic_energy(0.0, &q, &z) - known.kinetic_energy(0.0, &q, &z)).abs() < ROUNDING);
}

/// Forces of inertia are linear in m, m c and I_O, whatever is given.
#[test]
fn the_regressor_is_that_about_o() {
    let (q, z) = state();
    let rates = SVector::from([0.1, 0.2, -0.3, 0.4, 0.5, -0.6]);
    let i = Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0));
    let known = AboutO { m: M, c: C.into(), i: about_o(), g: 9.0 }.kernel().expect("a body");
    let given = AboutG { m: M, c: C.into(), i, g: 9.0 }.kernel().expect("a body");
    let (a, b) = (known.regressor(0.0, &q, &z, &rates), given.regressor(0.0, &q, &z, &rates));
    let (p, r) = (known.inertial_parameters(), given.inertial_parameters());
    assert!((a - b).norm() < ROUNDING);
    assert!((p - r).norm() < ROUNDING, "{p} {r}");
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -2], rotation = rotation_x(b)),
)]
struct Arms {
    #[gauss(body = about_center_of_mass)]
    upper: Central,
    #[gauss(body)]
    lower: RigidBody<f64, AboutCenterOfMass<f64>>,
    #[gauss(gravity)]
    g: f64,
}

type Central = RigidBody<f64, AboutCenterOfMass<f64>>;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -2], rotation = rotation_x(b),
        mass = 1.5, center_of_mass = [0.25, 0.5, -1], inertia_about_center_of_mass = [2, 3, 4]),
)]
struct ArmsAboutO {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn bodies_of_a_system() {
    let moments = Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0));
    let body = RigidBody::about_center_of_mass(M, C.into(), moments);
    let given = Arms { upper: body, lower: body, g: 9.0 }.kernel().expect("bodies");
    let upper = RigidBody { mass: M, center_of_mass: C.into(), inertia: about_o() };
    let known = ArmsAboutO { upper, g: 9.0 }.kernel().expect("bodies");
    let (q, z) = (SVector::from([0.3, -1.1]), SVector::from([0.7, 1.9]));
    assert!((given.acceleration(0.0, &q, &z, &()) - known.acceleration(0.0, &q, &z, &())).norm() < ROUNDING);
    assert!((given.mass_matrix(0.0, &q) - known.mass_matrix(0.0, &q)).norm() < ROUNDING);
}

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, waive(triangle_inequality))]
struct FormalAboutG {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia_about_center_of_mass)]
    i: Matrix3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(a), body(arm, rotation = rotation_y(a)), waive(triangle_inequality))]
struct FormalArm {
    #[gauss(body)]
    arm: RigidBody<f64, AboutCenterOfMass<f64>>,
}

#[test]
fn inertia_that_no_body_has_is_refused() {
    let i = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0));
    let error = AboutG { m: M, c: C.into(), i, g: 9.0 }.kernel().expect_err("1 + 1 < 3");
    assert!(error.to_string().contains("`i`") && error.to_string().contains("centre of mass"), "{error}");
    // Of a body in a system by its name, about the same point.
    let good = RigidBody::about_center_of_mass(M, C.into(), Matrix3::identity());
    let [no_body, negative] = [[1.0, 1.0, 3.0], [1.0, -1.0, 1.0]]
        .map(|i| RigidBody::about_center_of_mass(M, C.into(), Matrix3::from_diagonal(&Vector3::from(i))));
    for (lower, rule) in [(no_body, "exceeds the sum"), (negative, "no body has a negative one")] {
        let error = Arms { upper: good, lower, g: 9.0 }.kernel().expect_err(rule).to_string();
        assert!(error.contains("`lower.inertia`") && error.contains(rule), "{error}");
    }
    // Waived by name, there and here; what is negative is refused all the same.
    let formal = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0));
    assert!(FormalArm { arm: no_body }.kernel().is_ok() && FormalArm { arm: negative }.kernel().is_err());
    assert!(FormalAboutG { m: M, c: C.into(), i: formal }.kernel().is_ok());
    assert!(FormalAboutG { m: M, c: C.into(), i: -formal }.kernel().is_err());
    // Far from O nothing speaks against it.
    let i = Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-3, 1e-3));
    assert!(AboutG { m: M, c: [1e6, -2e6, 3e6].into(), i, g: 9.0 }.kernel().is_ok());
}
