//! `kernel()` refuses what no body is: each rule by its own typed error that names the field, several at once together.

use crate::common::body::Scene;
use crate::common::parameters::parameters;
use gauss_runtime::error::{Rule, Violation};
use gauss_runtime::prelude::*;
use proptest::prelude::*;

#[derive(GaussDynamics, Clone)]
#[gauss(chart = left_invariant)]
struct Vehicle {
    #[gauss(mass)]
    weight: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    tensor: Matrix3<f64>,
    #[gauss(added_mass)]
    fluid: Matrix6<f64>,
    #[gauss(gravity)]
    pull: Vector3<f64>,
    #[gauss(displaced_mass)]
    water: f64,
    #[gauss(center_of_buoyancy)]
    lift: Vector3<f64>,
}

fn vehicle() -> Vehicle {
    Vehicle {
        weight: 2.0,
        center: Vector3::new(0.1, -0.2, 0.3),
        tensor: Matrix3::new(1.0, 0.1, 0.0, 0.1, 1.2, -0.1, 0.0, -0.1, 1.1),
        fluid: Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 3.0, 0.1, 0.2, 0.3)),
        pull: Vector3::new(0.0, 0.0, -9.81),
        water: 2.5,
        lift: Vector3::new(0.0, 0.0, 0.1),
    }
}

/// Violations of a vehicle that was spoilt.
fn violations(spoil: impl FnOnce(&mut Vehicle)) -> Vec<Violation> {
    let mut vehicle = vehicle();
    spoil(&mut vehicle);
    vehicle.kernel().expect_err("spoilt").violations().to_vec()
}

/// The only violation of a vehicle that was spoilt.
fn only(spoil: impl FnOnce(&mut Vehicle)) -> Violation {
    let list = violations(spoil);
    assert_eq!(list.len(), 1, "{list:?}");
    list[0]
}

#[test]
fn a_body_is_accepted() {
    assert!(vehicle().kernel().is_ok());
}

#[test]
fn each_rule_has_its_own_error() {
    let found = only(|v| v.weight = 0.0);
    assert_eq!((found.field, found.value, found.rule), ("weight", 0.0, Rule::PositiveMass));
    assert!(found.to_string().contains("also where it has added mass"), "{found}");
    let found = only(|v| v.weight = -3.0);
    assert_eq!((found.field, found.value, found.rule), ("weight", -3.0, Rule::PositiveMass));
    let found = only(|v| v.water = -0.5);
    assert_eq!((found.field, found.value, found.rule), ("water", -0.5, Rule::NonNegative));

    let found = only(|v| v.tensor[(0, 2)] = 0.25);
    assert_eq!((found.field, found.value), ("tensor", 0.25));
    assert_eq!(found.rule, Rule::SymmetricInertia { row: 0, col: 2 });

    let found = only(|v| {
        v.center = Vector3::zeros();
        v.tensor = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -0.5));
    });
    assert_eq!((found.field, found.value, found.rule), ("tensor", -0.5, Rule::PositiveDefiniteInertia));

    // A sphere of moments 1 with its centre of mass at distance 1: m|c|² = 2 is more than it has.
    let found = only(|v| {
        v.center = Vector3::new(1.0, 0.0, 0.0);
        v.tensor = Matrix3::identity();
    });
    assert_eq!((found.field, found.value, found.rule), ("tensor", -1.0, Rule::InertiaAboutCenterOfMass));

    let found = only(|v| {
        v.center = Vector3::zeros();
        v.tensor = Matrix3::from_diagonal(&Vector3::new(1.0, 4.0, 2.0));
    });
    assert_eq!((found.field, found.value), ("tensor", 4.0));
    let rule = Rule::TriangleInequality { axis: 1, sum: 3.0, excess: 1.0, about_center_of_mass: false };
    assert_eq!(found.rule, rule);

    // About O the moments (2, 2, 1) are those of a body; about G, m|c|² = 1 away, (2, 1, 0) are not.
    let found = only(|v| {
        v.weight = 1.0;
        v.center = Vector3::new(1.0, 0.0, 0.0);
        v.tensor = Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 1.0));
    });
    assert_eq!((found.field, found.value), ("tensor", 2.0));
    let rule = Rule::TriangleInequality { axis: 0, sum: 1.0, excess: 1.0, about_center_of_mass: true };
    assert_eq!(found.rule, rule);

    let found = only(|v| v.fluid[(1, 5)] = 0.5);
    assert_eq!((found.field, found.value), ("fluid", 0.5));
    assert_eq!(found.rule, Rule::SymmetricAddedMass { row: 1, col: 5 });

    let found = only(|v| v.fluid[(0, 0)] = -5.0);
    assert_eq!((found.field, found.value, found.rule), ("fluid", -3.0, Rule::PositiveDefiniteKineticMatrix));

    // u₁ and u₂ coupled so that the mode (1, −1) has no inertia: m + X₁₁ = 3, X₁₂ = 3 with m + X₂₂ = 3.
    let found = only(|v| {
        v.center = Vector3::zeros();
        v.fluid[(1, 1)] = 1.0;
        v.fluid[(0, 1)] = 3.0;
        v.fluid[(1, 0)] = 3.0;
    });
    assert_eq!(found.field, "fluid");
    assert!(matches!(found.rule, Rule::ConditionedKineticMatrix { .. }), "{found:?}");
}

#[test]
fn numbers_are_finite() {
    type Spoiler = (&'static str, fn(&mut Vehicle, f64));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let spoilers: [Spoiler; 7] = [
            ("weight", |v, x| v.weight = x),
            ("center", |v, x| v.center[1] = x),
            ("tensor", |v, x| v.tensor[(2, 2)] = x),
            ("fluid", |v, x| v.fluid[(5, 5)] = x),
            ("pull", |v, x| v.pull[0] = x),
            ("water", |v, x| v.water = x),
            ("lift", |v, x| v.lift[2] = x),
        ];
        for (field, spoil) in spoilers {
            let found = only(|v| spoil(v, bad));
            assert_eq!((found.field, found.rule), (field, Rule::Finite));
            assert_eq!(found.value.to_bits(), bad.to_bits());
        }
        // Also where a full matrix has an entry that only its mirror image is used of.
        assert_eq!(only(|v| v.tensor[(0, 1)] = bad).rule, Rule::Finite);
        assert_eq!(only(|v| v.fluid[(0, 1)] = bad).rule, Rule::Finite);
    }
}

#[test]
fn several_mistakes_are_reported_together() {
    let list = violations(|v| {
        v.weight = -1.0;
        v.center[0] = f64::NAN;
        v.tensor[(1, 0)] = 7.0;
        v.fluid[(2, 3)] = 1.0;
        v.pull[2] = f64::INFINITY;
        v.water = -1.0;
        v.lift[0] = f64::NAN;
    });
    let mut fields: Vec<_> = list.iter().map(|v| v.field).collect();
    fields.sort_unstable();
    assert_eq!(fields, ["center", "fluid", "lift", "pull", "tensor", "water", "weight"]);
    let mut spoilt = vehicle();
    spoilt.weight = -1.0;
    spoilt.water = -2.0;
    let text = spoilt.kernel().expect_err("spoilt").to_string();
    assert!(text.contains("`weight` is -1") && text.contains("`water` is -2"), "{text}");
}

/// Textbook tops are formal: about the fixed point their moments are those of a body, about G they need not be.
#[test]
fn formal_tops_are_accepted() {
    #[derive(GaussDynamics)]
    #[gauss(motion = fixed_point)]
    struct Top {
        #[gauss(mass)]
        m: f64,
        #[gauss(center_of_mass)]
        c: Vector3<f64>,
        #[gauss(inertia)]
        i: Vector3<f64>,
        #[gauss(gravity)]
        g: f64,
    }
    let top = |moments: [f64; 3]| Top { m: 1.0, c: Vector3::new(1.0, 0.0, 0.0), i: Vector3::from(moments), g: 1.0 };
    // S. Kovalevskaya (1889): A = B = 2C. Goryachev and Chaplygin (1900): A = B = 4C.
    assert!(top([2.0, 2.0, 1.0]).kernel().is_ok());
    assert!(top([4.0, 4.0, 1.0]).kernel().is_ok());
    let error = top([4.0, 1.0, 1.0]).kernel().expect_err("no body");
    assert!(matches!(error.violations()[0].rule, Rule::TriangleInequality { about_center_of_mass: false, .. }));
}

/// In the plane only the moment about k₃ enters, but nothing that is given may be infinite.
#[test]
fn planar_bodies_need_one_moment() {
    #[derive(GaussDynamics)]
    #[gauss(motion = planar)]
    struct Skater {
        #[gauss(mass)]
        m: f64,
        #[gauss(center_of_mass)]
        c: Vector3<f64>,
        #[gauss(inertia)]
        i: Vector3<f64>,
    }
    let skater = |m: f64, c: f64, i: [f64; 3]| {
        Skater { m, c: Vector3::new(c, 0.0, 0.0), i: Vector3::from(i) }.kernel().map_err(|e| e.violations().to_vec())
    };
    assert!(skater(1.0, 0.5, [0.0, 0.0, 1.0]).is_ok());
    assert_eq!(skater(1.0, 0.5, [f64::NAN, 0.0, 1.0]).expect_err("NaN")[0].rule, Rule::Finite);
    assert_eq!(skater(1.0, 0.5, [0.0, 0.0, -1.0]).expect_err("negative")[0].rule, Rule::PositiveDefiniteInertia);
    // I₃ = 1 < m c² = 4: about the centre of mass −3 is left, and the mass matrix is indefinite.
    let found = skater(1.0, 2.0, [0.0, 0.0, 1.0]).expect_err("indefinite")[0];
    assert_eq!((found.value, found.rule), (-3.0, Rule::InertiaAboutCenterOfMass));
    // What is stated of other axes does not enter.
    assert!(skater(1.0, 0.0, [-1.0, 1.0, 1.0]).is_ok() && skater(1.0, 0.0, [1.0, 1.0, 3.0]).is_ok());
}

everything!(Any AnyKernel, free, [hybrid]);

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// No physical body is refused, and none of its spoilt copies accepted.
    #[test]
    fn bodies_are_told_from_others(parameters in parameters(), factor in 1.1..10.0_f64, axis in 0..3_usize) {
        let _ = Any::<()>::kernel::<f64>(&parameters);
        let body = Vehicle {
            weight: parameters.mass(),
            center: parameters.center(),
            tensor: parameters.inertia(),
            fluid: parameters.fluid(),
            pull: parameters.field(),
            water: parameters.displaced(),
            lift: parameters.buoyancy(),
        };
        prop_assert!(body.kernel().is_ok());
        let negative = Vehicle { tensor: -body.tensor, ..body.clone() };
        prop_assert_eq!(negative.kernel().expect_err("negative").violations()[0].field, "tensor");
        // No moment exceeds the sum of the others, whatever is on the axis: half the trace bounds each diagonal entry.
        let mut flat = body.clone();
        flat.tensor[(axis, axis)] = factor * (body.tensor.trace() - body.tensor[(axis, axis)]);
        prop_assert!(flat.kernel().is_err());
        let mut skew = body.clone();
        skew.fluid[(axis, 3 + axis)] += factor;
        let rule = skew.kernel().expect_err("skew").violations()[0].rule;
        let told = matches!(rule, Rule::SymmetricAddedMass { .. });
        prop_assert!(told, "{rule:?}");
    }
}
