//! `warnings()`: drag that feeds energy is reported by field, kind and eigenvalue; drag that takes it is not.

use gauss_runtime::error::{DragKind, Finding, ParameterWarning};
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, drag(hull, linear = linear, quadratic = quadratic))]
struct Hull {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    linear: Matrix6<f64>,
    quadratic: Vector6<f64>,
}

fn hull(linear: Matrix6<f64>, quadratic: [f64; 6]) -> Hull {
    Hull { mass: 1.0, inertia: 0.4, linear, quadratic: quadratic.into() }
}

/// Symmetric and positive, with a skew part that does no work.
fn positive() -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| if i == j { 2.0 } else { 0.25 + 0.5 * (i as f64 - j as f64) })
}

#[test]
fn drag_that_takes_energy_is_not_reported() {
    let body = hull(positive(), [1.0, 0.0, 2.0, 1e-6, 0.0, 3.0]);
    assert!(body.warnings().is_empty(), "{}", body.warnings());
    assert!(body.kernel().is_ok());
    assert!(hull(Matrix6::zeros(), [0.0; 6]).warnings().is_empty());
}

#[test]
fn drag_that_feeds_energy_is_reported_with_its_eigenvalue() {
    // The block ((1, 2), (2, 1)) of surge and pitch has the eigenvalues 3 and −1.
    let mut linear = Matrix6::identity();
    (linear[(0, 4)], linear[(4, 0)]) = (2.5, 1.5);
    let body = hull(linear, [1.0, 1.0, -0.75, 1.0, 1.0, 1.0]);
    let warnings = body.warnings();
    let [first, second] = warnings.as_slice() else { panic!("two findings: {warnings}") };
    let expect = |found: &ParameterWarning, field: &str, value: f64, kind: DragKind| {
        assert_eq!((found.field, found.finding), (field, Finding::DragFeedsEnergy { kind }));
        // A few sweeps of rotations on numbers up to 3.
        assert!((found.value - value).abs() < 1e-14, "{found}");
    };
    expect(first, "linear", -1.0, DragKind::Linear);
    expect(second, "quadratic", -0.75, DragKind::Quadratic);
    let said = warnings.to_string();
    assert!(said.contains("`linear`") && said.contains("`quadratic`") && said.contains("-0.75"), "{said}");

    // It is a warning: the kernel works as given, and energy is fed along the eigenvector.
    let kernel = body.kernel().expect("a body all the same");
    let (q, along) = (Isometry3::identity(), SVector::from([1.0, 0.0, 0.0, 0.0, -1.0, 0.0]));
    // VᵀDV = −2 of the linear part, and 2 of the quadratic one.
    let power = kernel.supplied_power(0.0, &q, &along, &());
    assert!(power.abs() < 1e-14, "{power}");
    assert!(kernel.supplied_power(0.0, &q, &(along * 0.5), &()) > 0.0);
}

#[test]
fn lists_are_judged_as_matrices_are() {
    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(pose: Pose),
        body(arm, position = pose.position, rotation = pose.rotation),
        drag(body = arm, linear = [k, k, k, -k, k, k]),
    )]
    struct Listed {
        #[gauss(body)]
        arm: RigidBody<f32>,
        k: f32,
    }
    let arm = RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() };
    // In single precision, of a system; the sign of a field decides at run time.
    let listed = Listed { arm, k: 0.5 };
    let [finding] = *listed.warnings().as_slice() else { panic!("{}", listed.warnings()) };
    assert_eq!((finding.value, finding.finding), (-0.5, Finding::DragFeedsEnergy { kind: DragKind::Linear }));
    let listed = Listed { arm, k: -0.5 };
    let [finding] = *listed.warnings().as_slice() else { panic!("{}", listed.warnings()) };
    assert_eq!(finding.value, -0.5);
    let listed = Listed { arm, k: 0.0 };
    assert!(listed.warnings().is_empty() && listed.kernel().is_ok());
}
