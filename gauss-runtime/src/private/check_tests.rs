//! Every rule of the parameters, once broken and once at its edge.

use std::string::{String, ToString};
use std::vec::Vec;

use super::*;
use crate::simd::Lanes;

fn diagonal(moments: [f64; 3]) -> [[f64; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { moments[i] } else { 0.0 }))
}

fn identity<const N: usize>() -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// The violations that a sequence of checks finds.
fn found(checks: impl FnOnce(&mut ParameterCheck<f64>)) -> Vec<Violation> {
    let mut check = ParameterCheck::new();
    checks(&mut check);
    check.finish().map_or_else(|error| error.violations().to_vec(), |()| Vec::new())
}

#[track_caller]
fn only(checks: impl FnOnce(&mut ParameterCheck<f64>)) -> Violation {
    let list = found(checks);
    assert_eq!(list.len(), 1, "{list:?}");
    list[0]
}

#[test]
fn a_body_passes() {
    let list = found(|check| {
        check.mass("mass", 2.0);
        check.finite("center", &[0.1, 0.0, -0.2]);
        check.non_negative("displaced", 0.0);
        check.inertia("inertia", &diagonal([1.0, 2.0, 3.0]));
        check.central_inertia("inertia", 2.0, [0.1, 0.0, -0.2], &diagonal([1.0, 2.0, 2.5]));
        check.symmetric("added", &identity());
        check.kinetic_matrix("added", &identity::<6>());
    });
    assert!(list.is_empty(), "{list:?}");
}

#[test]
fn masses_and_plain_values() {
    assert_eq!(only(|check| check.mass("mass", -1.0)).rule, Rule::PositiveMass);
    assert_eq!(only(|check| check.mass("mass", 0.0)).value, 0.0);
    assert_eq!(only(|check| check.mass("mass", f64::NAN)).rule, Rule::Finite);
    assert_eq!(only(|check| check.non_negative("displaced", -0.5)).rule, Rule::NonNegative);
    let violation = only(|check| check.finite("center", &[0.0, f64::NEG_INFINITY, f64::NAN]));
    assert_eq!((violation.field, violation.value, violation.rule), ("center", f64::NEG_INFINITY, Rule::Finite));
}

#[test]
fn coefficients_and_directions_of_contacts() {
    let none = found(|check| {
        [0.0, 0.5, 1.0].into_iter().for_each(|e| check.restitution("e", e));
        check.direction("n", 1e-30);
    });
    assert!(none.is_empty(), "{none:?}");
    assert!(found(|check| check.positive_length("stone.semi_axes", 1e-150)).is_empty());
    // Of the last one the square is 0.
    for wrong in [0.0, -0.2, 1e-200] {
        let violation = only(|check| check.positive_length("stone.semi_axes", wrong));
        assert_eq!((violation.value, violation.rule), (wrong, Rule::PositiveLength));
    }
    assert_eq!(only(|check| check.positive_length("stone.semi_axes", 1e200)).rule, Rule::Finite);
    for wrong in [-0.1, 1.0 + f64::EPSILON, 7.0] {
        let violation = only(|check| check.restitution("e", wrong));
        assert_eq!((violation.value, violation.rule), (wrong, Rule::Restitution));
    }
    assert_eq!(only(|check| check.restitution("e", f64::NAN)).rule, Rule::Finite);
    assert_eq!(only(|check| check.direction("n", 0.0)).rule, Rule::Direction);
    let violation = only(|check| check.direction("n", f64::INFINITY));
    assert_eq!(violation.rule, Rule::Finite);
    assert!(
        only(|check| check.direction("floor.plane", 0.0)).to_string().starts_with("`floor.plane` has no direction")
    );
}

#[test]
fn inertia_alone() {
    assert_eq!(only(|check| check.inertia("j", &diagonal([1.0, f64::NAN, 1.0]))).rule, Rule::Finite);

    let mut skew = diagonal([1.0, 1.0, 1.0]);
    skew[0][2] = 0.1;
    let violation = only(|check| check.inertia("j", &skew));
    assert_eq!((violation.value, violation.rule), (0.1, Rule::SymmetricInertia { row: 0, col: 2 }));
    // Rounding is not asymmetry.
    skew[0][2] = 1e-16;
    assert!(found(|check| check.inertia("j", &skew)).is_empty());

    let violation = only(|check| check.inertia("j", &diagonal([2.0, -1.0, 2.0])));
    assert_eq!((violation.value, violation.rule), (-1.0, Rule::PositiveDefiniteInertia));
    assert_eq!(only(|check| check.inertia("j", &diagonal([1.0, 0.0, 1.0]))).rule, Rule::PositiveDefiniteInertia);
    // Products of inertia that are too large: the diagonal alone looks well.
    let coupled = [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let violation = only(|check| check.inertia("j", &coupled));
    assert!((violation.value + 1.0).abs() < 1e-15);

    let violation = only(|check| check.inertia("j", &diagonal([1.0, 3.5, 2.0])));
    let rule = Rule::TriangleInequality { axis: 1, sum: 3.0, excess: 0.5, about_center_of_mass: false };
    assert_eq!((violation.value, violation.rule), (3.5, rule));
    // A lamina lies on the edge, also when rounding puts it beyond, and so does a turned needle.
    assert!(found(|check| check.inertia("j", &diagonal([0.1, 0.2, 0.1 + 0.2 + 2e-16]))).is_empty());
    assert!(found(|check| check.inertia("j", &diagonal([1e-6, 1.0, 1.0]))).is_empty());
}

#[test]
fn inertia_about_another_point() {
    // A sphere of radius 1, mass 1, whose centre is 2 away: about O 0.4 + 4 across, 0.4 along.
    let about_o = diagonal([0.4, 4.4, 4.4]);
    assert!(found(|check| check.central_inertia("j", 1.0, [2.0, 0.0, 0.0], &about_o)).is_empty());
    // The inertia about the centre of mass given in its place.
    let violation = only(|check| check.central_inertia("j", 1.0, [2.0, 0.0, 0.0], &diagonal([0.4; 3])));
    assert_eq!(violation.rule, Rule::InertiaAboutCenterOfMass);
    assert!((violation.value + 3.6).abs() < 1e-15);
    // Without a lever it is the inertia about the centre of mass itself.
    let violation = only(|check| check.central_inertia("j", 1.0, [0.0; 3], &diagonal([1.0, 1.0, 3.0])));
    assert!(matches!(violation.rule, Rule::TriangleInequality { axis: 2, about_center_of_mass: true, .. }));
    // Far away the difference is rounding, and must not be held against the body.
    let c = [3e7, 4e7, 0.0];
    let mut far: [[f64; 3]; 3] =
        core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 25e14 - c[i] * c[i] } else { -c[i] * c[j] }));
    (0..3).for_each(|i| far[i][i] += 0.4);
    assert!(found(|check| check.central_inertia("j", 1.0, c, &far)).is_empty());
    // Mass and centre report for themselves.
    let list = found(|check| {
        check.mass("mass", -1.0);
        check.central_inertia("j", -1.0, [f64::NAN, 0.0, 0.0], &diagonal([1.0; 3]));
    });
    assert_eq!(list.len(), 1);
}

/// A uniform rod about its end, 1/3 with 1/4 for its centre of mass: by its moment, by three equal ones, with others
/// that no body has.
#[test]
fn inertia_about_one_axis() {
    let about =
        |tensor: [[f64; 3]; 3]| found(|check| check.inertia_about_axis("j", 2, (1.0, [0.5, 0.0, 0.0]), &tensor));
    let moment = 1.0 / 3.0;
    for others in [[0.0; 2], [moment; 2], [1e-6, moment], [0.1, 0.1], [-1.0, 7.0]] {
        assert!(about(diagonal([others[0], others[1], moment])).is_empty(), "{others:?}");
    }
    // About its centre of mass 1/12 is left of 1/3, and of 1/12 nothing.
    let found = &about(diagonal([0.0, 0.0, 1.0 / 12.0]))[0];
    assert_eq!((found.field, found.rule), ("j", Rule::InertiaAboutCenterOfMass));
    assert!((found.value + 1.0 / 6.0).abs() < 1e-15, "{found:?}");
    assert_eq!(about(diagonal([1.0, 1.0, -0.1]))[0].rule, Rule::PositiveDefiniteInertia);
    let skew = [[1.0, 0.2, 0.0], [0.1, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(about(skew)[0].rule, Rule::SymmetricInertia { row: 0, col: 1 });
}

#[test]
fn stiffness_of_bushings() {
    assert!(found(|check| check.stiffness_matrix("k", &identity::<6>())).is_empty());
    // No stiffness along one direction, here the sum of the first two displacements, is allowed.
    let mut matrix = identity::<6>();
    (matrix[0][1], matrix[1][0]) = (-1.0, -1.0);
    assert!(found(|check| check.stiffness_matrix("k", &matrix)).is_empty());
    // A coupling larger than both coefficients: [[1, −2], [−2, 1]] has −1 and 3, up to some roundings of 3.
    (matrix[0][1], matrix[1][0]) = (-2.0, -2.0);
    let violation = only(|check| check.stiffness_matrix("k", &matrix));
    assert!((violation.value + 1.0).abs() < 16.0 * f64::EPSILON, "{violation:?}");
    assert_eq!(violation.rule, Rule::SemidefiniteStiffness);
    assert!(violation.to_string().contains("a stiffness matrix has none below 0"), "{violation}");
    matrix = identity();
    matrix[5][5] = -0.5;
    let violation = only(|check| check.stiffness_matrix("k", &matrix));
    assert_eq!((violation.value, violation.rule), (-0.5, Rule::SemidefiniteStiffness));
    // Reported once, by the first rule that is broken.
    matrix[0][1] = 0.5;
    let violation = only(|check| check.stiffness_matrix("k", &matrix));
    assert_eq!(violation.rule, Rule::SymmetricCoefficients { row: 0, col: 1 });
    matrix[0][1] = f64::NAN;
    assert_eq!(only(|check| check.stiffness_matrix("k", &matrix)).rule, Rule::Finite);
}

#[test]
fn added_mass_and_the_matrix_of_body_and_fluid() {
    let mut added = identity::<6>();
    added[1][4] = 0.25;
    let violation = only(|check| check.symmetric("added", &added));
    assert_eq!(violation.rule, Rule::SymmetricAddedMass { row: 1, col: 4 });
    let violation = only(|check| check.damping_matrix("added", &added));
    assert_eq!(violation.rule, Rule::SymmetricCoefficients { row: 1, col: 4 });

    let mut matrix = identity::<6>();
    matrix[2][2] = -0.5;
    let violation = only(|check| check.kinetic_matrix("added", &matrix));
    assert_eq!((violation.value, violation.rule), (-0.5, Rule::PositiveDefiniteKineticMatrix));
    let violation = only(|check| check.kinetic_matrix("added", &[[1.0, 2.0], [2.0, 1.0]]));
    assert!((violation.value + 1.0).abs() < 1e-15);
    assert_eq!(violation.rule, Rule::PositiveDefiniteKineticMatrix);
    // Singular: the sign of the vanishing eigenvalue means nothing.
    let violation = only(|check| check.kinetic_matrix("added", &[[1.0, 1.0], [1.0, 1.0]]));
    assert!(matches!(violation.rule, Rule::ConditionedKineticMatrix { .. }), "{violation:?}");
    // Different units are not bad condition.
    assert!(found(|check| check.kinetic_matrix("added", &[[1e20, 1.0], [1.0, 1e-18]])).is_empty());
    let violation = only(|check| check.kinetic_matrix("added", &[[f64::INFINITY, 0.0], [0.0, 1.0]]));
    assert_eq!(violation.rule, Rule::Finite);
}

#[test]
fn one_report_for_each_field_and_no_consequences() {
    let list = found(|check| {
        check.mass("mass", f64::NAN);
        check.inertia("j", &diagonal([f64::NAN; 3]));
        check.central_inertia("j", f64::NAN, [0.0; 3], &diagonal([f64::NAN; 3]));
        check.kinetic_matrix("mass", &[[f64::NAN; 6]; 6]);
        check.kinetic_matrix("added", &[[f64::NAN; 6]; 6]);
    });
    let fields: Vec<_> = list.iter().map(|violation| (violation.field, violation.rule)).collect();
    assert_eq!(fields, [("mass", Rule::Finite), ("j", Rule::Finite)]);
}

#[test]
fn all_lanes_count_and_the_list_is_bounded() {
    let mut check = ParameterCheck::new();
    check.mass("mass", Lanes([1.0, -2.0]));
    let error = check.finish().unwrap_err();
    assert_eq!(error.violations()[0].value, -2.0);

    let names = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
    let list = found(|check| names.iter().for_each(|name| check.mass(name, 0.0)));
    assert_eq!(list.len(), crate::error::MOST_VIOLATIONS);
}

#[test]
fn single_precision_has_its_own_rounding() {
    let mut check = ParameterCheck::<f32>::new();
    check.inertia("j", &[[0.1, 1e-8, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.300_000_04]]);
    assert!(check.finish().is_ok());
}

#[test]
fn messages_say_value_rule_and_remedy() {
    let mut check = ParameterCheck::<f64>::new();
    check.mass("mass", -1.0);
    assert_eq!(
        check.finish().unwrap_err().to_string(),
        "`mass` is -1: a mass must be greater than 0; give the mass of the body in your units"
    );
    check.inertia("inertia", &diagonal([1.0, 1.0, 3.0]));
    let text = check.finish().unwrap_err().to_string();
    assert!(text.starts_with("2 parameters are not those of a body:\n- `mass` is -1"), "{text}");
    assert!(text.contains("the principal moment 3 (axis 2) exceeds the sum 2 of the other two by 1"), "{text}");
    // Every rule has a text of its own.
    let rules = [
        Rule::Finite,
        Rule::PositiveMass,
        Rule::NonNegative,
        Rule::PositiveLength,
        Rule::SymmetricInertia { row: 0, col: 1 },
        Rule::PositiveDefiniteInertia,
        Rule::InertiaAboutCenterOfMass,
        Rule::TriangleInequality { axis: 0, sum: 1.0, excess: 1.0, about_center_of_mass: true },
        Rule::SymmetricAddedMass { row: 0, col: 1 },
        Rule::SymmetricCoefficients { row: 0, col: 1 },
        Rule::PositiveDefiniteKineticMatrix,
        Rule::ConditionedKineticMatrix { limit: 1.0 },
    ];
    let texts: Vec<String> = rules.iter().map(|&rule| Violation { field: "f", value: 2.0, rule }.to_string()).collect();
    for (n, text) in texts.iter().enumerate() {
        assert!(text.contains("`f`") && text.contains(';') && !texts[..n].contains(text), "{text}");
    }
}
