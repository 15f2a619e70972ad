//! Mass data in clauses: the same motion as with fields, less code.

use std::f64::consts::FRAC_PI_2;

use gauss_runtime::description::OperationCount;
use gauss_runtime::error::Rule;
use gauss_runtime::prelude::*;
use proptest::prelude::*;

/// Rounding of some tens of operations on numbers of order ten, of which sums may cancel.
const ROUNDING: f64 = 1e-12;

mod literal {
    use super::*;

    #[derive(GaussDynamics)]
    #[gauss(chart = hybrid, mass = 2.5, center_of_mass = [0.1, -0.2, 0.3], inertia = [1.1, 1.2, 1.3], gravity = 9.80665)]
    pub struct Clauses {}

    #[derive(GaussDynamics)]
    #[gauss(chart = hybrid)]
    pub struct Fields {
        #[gauss(mass)]
        pub m: f64,
        #[gauss(center_of_mass)]
        pub c: Vector3<f64>,
        #[gauss(inertia)]
        pub i: Vector3<f64>,
        #[gauss(gravity)]
        pub g: f64,
    }

    pub fn fields() -> Fields {
        Fields { m: 2.5, c: Vector3::new(0.1, -0.2, 0.3), i: Vector3::new(1.1, 1.2, 1.3), g: 9.80665 }
    }

    /// Of any scalar literals are fractions until the kernel is made, also of more than 64 bits.
    #[derive(GaussDynamics)]
    #[gauss(mass = 2.5, inertia = [a, a, 0.3], gravity = 9.80665000000000000000001, center_of_mass = [0, 0, l])]
    pub struct AnyScalar<T> {
        pub a: T,
        pub l: T,
    }
}

mod top {
    use super::*;

    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zxz), motion = fixed_point, center_of_mass = [0, 0, l], inertia = [a, a, c])]
    pub struct Symmetric {
        #[gauss(mass)]
        pub m: f64,
        pub l: f64,
        pub a: f64,
        pub c: f64,
        #[gauss(gravity)]
        pub g: f64,
    }

    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zxz), motion = fixed_point)]
    pub struct General {
        #[gauss(mass)]
        pub m: f64,
        #[gauss(center_of_mass)]
        pub l: Vector3<f64>,
        #[gauss(inertia)]
        pub i: Vector3<f64>,
        #[gauss(gravity)]
        pub g: f64,
    }
}

mod pitch {
    use super::*;

    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zyx), motion = fixed_point, inertia = a)]
    pub struct Ball {
        #[gauss(mass)]
        pub m: f64,
        pub a: f64,
    }

    /// Symmetric about e₁.
    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zyx), motion = fixed_point, inertia = [c, a, a])]
    pub struct Dart {
        #[gauss(mass)]
        pub m: f64,
        pub a: f64,
        pub c: f64,
    }

    #[derive(GaussDynamics)]
    #[gauss(chart = jet(euler_zyx), motion = fixed_point)]
    pub struct General {
        #[gauss(mass)]
        pub m: f64,
        #[gauss(inertia)]
        pub i: Vector3<f64>,
    }
}

mod pendulum {
    use super::*;

    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(a, b),
        body(upper, rotation = rotation_y(a), mass = m, center_of_mass = [0, 0, -l / 2], inertia = j),
        body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b), mass = 2 * m, center_of_mass = [0, 0, -l / 3], inertia = [j, j, j / 4]),
    )]
    pub struct Clauses {
        pub m: f64,
        pub l: f64,
        pub j: f64,
        #[gauss(gravity)]
        pub g: f64,
    }

    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(a, b),
        body(upper, rotation = rotation_y(a)),
        body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
    )]
    pub struct Fields {
        pub l: f64,
        #[gauss(body)]
        pub upper: RigidBody<f64>,
        #[gauss(body)]
        pub lower: RigidBody<f64>,
        #[gauss(gravity)]
        pub g: f64,
    }

    pub fn both(m: f64, l: f64, j: f64, g: f64) -> (Clauses, Fields) {
        let link = |mass: f64, at: f64, moments: [f64; 3]| RigidBody {
            mass,
            center_of_mass: Vector3::new(0.0, 0.0, at),
            inertia: Matrix3::from_diagonal(&Vector3::from(moments)),
        };
        let fields = Fields { l, upper: link(m, -l / 2.0, [j; 3]), lower: link(2.0 * m, -l / 3.0, [j, j, j / 4.0]), g };
        (Clauses { m, l, j, g }, fields)
    }
}

fn agree<const N: usize>(a: &SVector<f64, N>, b: &SVector<f64, N>, scale: f64) {
    assert!((a - b).amax() <= ROUNDING * scale, "{a} and {b}");
}

#[test]
fn literals_are_no_fields_of_the_kernel() {
    assert_eq!(size_of::<literal::ClausesKernel>(), 0);
    assert_eq!(literal::ClausesKernel::OPERATIONS.kernel, OperationCount::default());
}

proptest! {
    #[test]
    fn literals_are_what_fields_are(
        angles in prop::array::uniform3(-3.0..3.0),
        z in prop::array::uniform6(-2.0..2.0),
        rate in prop::array::uniform6(-2.0..2.0),
    ) {
        let (folded, read) = (literal::Clauses {}.kernel().expect("a body"), literal::fields().kernel().expect("a body"));
        let q = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::from(angles));
        let (z, rate) = (SVector::from(z), SVector::from(rate));
        agree(&folded.acceleration(0.0, &q, &z, &()), &read.acceleration(0.0, &q, &z, &()), 100.0);
        agree(&folded.momentum(0.0, &q, &z), &read.momentum(0.0, &q, &z), 100.0);
        agree(&folded.velocity(0.0, &q, &z), &read.velocity(0.0, &q, &z), 100.0);
        agree(&folded.momentum_rate(0.0, &q, &z, &()), &read.momentum_rate(0.0, &q, &z, &()), 100.0);
        agree(&folded.gauss_residual(0.0, &q, &z, &rate, &()), &read.gauss_residual(0.0, &q, &z, &rate, &()), 100.0);
        prop_assert!((folded.energy(0.0, &q, &z) - read.energy(0.0, &q, &z)).abs() <= ROUNDING * 100.0);
    }

    /// Symmetry is used, and nothing changes: also 1e-6 from the singularity, where errors grow like its reciprocal.
    #[test]
    fn symmetric_tops_are_tops(
        q in prop::array::uniform3(-3.0..3.0),
        z in prop::array::uniform3(-2.0..2.0),
        closeness in -6.0..0.0,
        (a, c) in (0.5..2.0, 0.2..1.0),
    ) {
        let (m, l, g) = (1.5, 0.3, 9.81);
        let symmetric = top::Symmetric { m, l, a, c, g }.kernel().expect("a top");
        let general = top::General { m, l: Vector3::new(0.0, 0.0, l), i: Vector3::new(a, a, c), g };
        let general = general.kernel().expect("a top");
        let q = SVector::from([q[0], 10.0_f64.powf(closeness), q[2]]);
        let z = SVector::from(z);
        let near = 1.0 / q[1].sin().abs();
        agree(&symmetric.acceleration(0.0, &q, &z, &()), &general.acceleration(0.0, &q, &z, &()), 100.0 * near);
        agree(&symmetric.momentum(0.0, &q, &z), &general.momentum(0.0, &q, &z), 10.0);
        // Momenta of moderate velocities: those of others diverge with the reciprocal of the square.
        let p = general.momentum(0.0, &q, &z);
        agree(&symmetric.velocity(0.0, &q, &p), &general.velocity(0.0, &q, &p), 10.0 * near * near);
        agree(&symmetric.gauss_residual(0.0, &q, &z, &z, &()), &general.gauss_residual(0.0, &q, &z, &z, &()), 100.0);
        let entries = |matrix: SMatrix<f64, 3, 3>| SVector::<f64, 9>::from_column_slice(matrix.as_slice());
        agree(&entries(symmetric.mass_matrix(0.0, &q)), &entries(general.mass_matrix(0.0, &q)), 10.0);
    }

    /// Where the singular point is a zero of a cosine.
    #[test]
    fn symmetric_bodies_in_yaw_pitch_and_roll(
        q in prop::array::uniform3(-3.0..3.0),
        z in prop::array::uniform3(-2.0..2.0),
        closeness in -6.0..0.0,
        (a, c) in (0.5..1.0, 0.2..1.0),
    ) {
        let general = |along: f64, across: f64| {
            let body = pitch::General { m: 1.5, i: Vector3::new(along, across, across) };
            body.kernel().expect("a body")
        };
        let q = SVector::from([q[0], FRAC_PI_2 - 10.0_f64.powf(closeness), q[2]]);
        let z = SVector::from(z);
        let near = 1.0 / q[1].cos().abs();
        let check = |found: SVector<f64, 3>, other: SVector<f64, 3>| agree(&found, &other, 100.0 * near);
        let ball = pitch::Ball { m: 1.5, a }.kernel().expect("a ball");
        check(ball.acceleration(0.0, &q, &z, &()), general(a, a).acceleration(0.0, &q, &z, &()));
        let dart = pitch::Dart { m: 1.5, a, c }.kernel().expect("a body");
        check(dart.acceleration(0.0, &q, &z, &()), general(c, a).acceleration(0.0, &q, &z, &()));
    }

    #[test]
    fn links_of_clauses_are_rigid_bodies(q in prop::array::uniform2(-3.0..3.0), z in prop::array::uniform2(-2.0..2.0)) {
        let (clauses, fields) = pendulum::both(1.2, 0.7, 0.6, 9.81);
        let (clauses, fields) = (clauses.kernel().expect("a pendulum"), fields.kernel().expect("a pendulum"));
        let (q, z) = (SVector::from(q), SVector::from(z));
        agree(&clauses.acceleration(0.0, &q, &z, &()), &fields.acceleration(0.0, &q, &z, &()), 100.0);
        agree(&clauses.momentum(0.0, &q, &z), &fields.momentum(0.0, &q, &z), 100.0);
        prop_assert!((clauses.energy(0.0, &q, &z) - fields.energy(0.0, &q, &z)).abs() <= ROUNDING * 100.0);
    }
}

#[test]
fn what_is_known_makes_code_shorter() {
    let cost = |count: OperationCount| count.total();
    let symmetric = top::SymmetricKernel::OPERATIONS;
    // Nothing turns with the spin: half of the sines and cosines are gone, and more than half of the rest.
    assert_eq!(symmetric.acceleration.transcendentals, 2);
    assert!(2 * cost(symmetric.acceleration) < cost(top::GeneralKernel::OPERATIONS.acceleration));
    assert_eq!(symmetric.mass_matrix.transcendentals, 2);
    // What is across the links' axes is zero.
    assert!(
        cost(pendulum::ClausesKernel::OPERATIONS.acceleration) < cost(pendulum::FieldsKernel::OPERATIONS.acceleration)
    );
}

#[test]
fn generic_scalars_take_literals() {
    let wide = literal::AnyScalar { a: 0.5_f64, l: 0.25 }.kernel().expect("a body");
    let narrow = literal::AnyScalar { a: 0.5_f32, l: 0.25 }.kernel().expect("a body");
    let z = [0.3, -0.2, 0.5, 1.0, -0.7, 0.4];
    let of_wide = wide.acceleration(0.0, &Isometry3::identity(), &SVector::from(z), &());
    let of_narrow = narrow.acceleration(0.0, &Isometry3::identity(), &SVector::from(z.map(|x| x as f32)), &());
    // Some tens of roundings.
    assert!((of_wide - of_narrow.map(f64::from)).amax() <= 64.0 * f64::from(f32::EPSILON) * of_wide.amax());
}

#[test]
fn values_are_checked() {
    let error = pendulum::Clauses { m: -1.0, l: 1.0, j: 1.0, g: 9.81 }.kernel().expect_err("negative masses");
    let fields: Vec<_> = error.violations().iter().map(|v| (v.field, v.rule)).collect();
    assert!(
        fields.contains(&("upper.mass", Rule::PositiveMass)) && fields.contains(&("lower.mass", Rule::PositiveMass)),
        "{fields:?}"
    );
    let flat = top::Symmetric { m: 1.0, l: 0.1, a: 0.1, c: 0.3, g: 9.81 }.kernel().expect_err("0.3 > 0.1 + 0.1");
    assert!(
        matches!(flat.violations()[0].rule, Rule::TriangleInequality { .. }) && flat.violations()[0].field == "inertia"
    );
}
