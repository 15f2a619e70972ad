//! An arm of seven joints (Franka Emika Panda): accelerations at given states from recursive Newton–Euler in
//! multiprecision arithmetic, what an evaluation costs, what holds at every state, and which of its masses a motion
//! tells.

use std::fs;
use std::path::Path;

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Sizes, System, Time, corresponds, laws, least};
use gauss_tests::random::Random;
use gauss_tests::trajectory::{number, numbers, reference, triple};
use proptest::prelude::*;
use serde_json::Value;

macro_rules! arm {
    ($(#[$documentation:meta])* $name:ident [$($clause:tt)+]) => {
        $(#[$documentation])*
        #[derive(GaussDynamics)]
        #[gauss($($clause)+)]
        struct $name {
            #[gauss(body)]
            b1: RigidBody<f64>,
            #[gauss(body)]
            b2: RigidBody<f64>,
            #[gauss(body)]
            b3: RigidBody<f64>,
            #[gauss(body)]
            b4: RigidBody<f64>,
            #[gauss(body)]
            b5: RigidBody<f64>,
            #[gauss(body)]
            b6: RigidBody<f64>,
            #[gauss(body)]
            b7: RigidBody<f64>,
            #[gauss(gravity)]
            g: f64,
        }

        impl $name {
            fn of([b1, b2, b3, b4, b5, b6, b7]: [RigidBody<f64>; 7], g: f64) -> Self {
                Self { b1, b2, b3, b4, b5, b6, b7, g }
            }
        }
    };
}

arm!(
    /// The frames of the public description: every joint turns about the third axis of its link.
    Arm [
        linearize(parameters, inverse),
        regressor,
        coordinates(q1, q2, q3, q4, q5, q6, q7),
        body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1)),
        body(b2, parent = b1, rotation = rotation_x(-1.5707963267948966) * rotation_z(q2)),
        body(b3, parent = b2, position = [0, -0.316, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q3)),
        body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q4)),
        body(b5, parent = b4, position = [-0.0825, 0.384, 0], rotation = rotation_x(-1.5707963267948966) * rotation_z(q5)),
        body(b6, parent = b5, rotation = rotation_x(1.5707963267948966) * rotation_z(q6)),
        body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_x(1.5707963267948966) * rotation_z(q7))
    ]
);

arm!(
    /// Axes of all links parallel to those of the base when the angles are zero.
    StraightArm [
        coordinates(q1, q2, q3, q4, q5, q6, q7),
        body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1)),
        body(b2, parent = b1, rotation = rotation_y(q2)),
        body(b3, parent = b2, position = [0, 0, 0.316], rotation = rotation_z(q3)),
        body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_y(-q4)),
        body(b5, parent = b4, position = [-0.0825, 0, 0.384], rotation = rotation_z(q5)),
        body(b6, parent = b5, rotation = rotation_y(-q6)),
        body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_z(-q7))
    ]
);

arm!(
    /// Speeds of its own: sums of the joints' rates from the base on, which for parallel axes are angular velocities in
    /// space.
    ArmByOtherSpeeds [
        coordinates(q1, q2, q3, q4, q5, q6, q7),
        speeds(s1, s2, s3, s4, s5, s6, s7),
        kinematics(q1 = s1, q2 = s2 - s1, q3 = s3 - s2, q4 = s4 - s3, q5 = s5 - s4, q6 = s6 - s5, q7 = s7 - s6),
        body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1)),
        body(b2, parent = b1, rotation = rotation_y(q2)),
        body(b3, parent = b2, position = [0, 0, 0.316], rotation = rotation_z(q3)),
        body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_y(-q4)),
        body(b5, parent = b4, position = [-0.0825, 0, 0.384], rotation = rotation_z(q5)),
        body(b6, parent = b5, rotation = rotation_y(-q6)),
        body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_z(-q7))
    ]
);

type Joints = SVector<f64, 7>;

/// The links of the reference under one of its two keys, moments about O.
fn links(key: &str) -> [RigidBody<f64>; 7] {
    let scene = reference("seven_joint_arm");
    std::array::from_fn(|k| {
        let link = &scene["parameters"][key][k];
        RigidBody {
            mass: number(&link["mass"]),
            center_of_mass: triple(&link["centre_of_mass_body_from_O"]),
            inertia: Matrix3::from_row_slice(&numbers(&link["inertia_about_O"])),
        }
    })
}

fn arms() -> (ArmKernel, StraightArmKernel, ArmByOtherSpeedsKernel) {
    let (links, straight) = (links("links"), links("straight_links"));
    (
        Arm::of(links, 9.81).kernel().unwrap(),
        StraightArm::of(straight, 9.81).kernel().unwrap(),
        ArmByOtherSpeeds::of(straight, 9.81).kernel().unwrap(),
    )
}

/// A ∂ż = −∂τ at the ż of the motion: solved for in columns, and not solved for at all. Both programs add some hundred
/// products for every entry, and the substitution is backward stable.
#[test]
fn accelerations_and_forces_have_derivatives_that_agree() {
    let (arm, ..) = arms();
    let mut random = Random(5);
    for _ in 0..20 {
        let (q, z): (Joints, Joints) = (random.vector(3.0), random.vector(2.0));
        let linear = arm.linearize(0.0, &q, &z, &());
        let rate = linear.rate.fixed_rows::<7>(7).into_owned();
        let inverse = arm.linearize_inverse(0.0, &q, &z, &rate, &());
        let matrix = inverse.by_acceleration;
        for (first, by) in [(0, inverse.by_configuration), (7, inverse.by_speeds)] {
            let rates = linear.by_state.fixed_view::<7, 7>(7, first).into_owned();
            let error = (matrix * rates + by).norm();
            let size = matrix.norm() * rates.norm() + by.norm();
            assert!(error <= 500.0 * f64::EPSILON * size, "{error:e} of {size:e}");
        }
    }
}

macro_rules! chain {
    ($name:ident [$($clause:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss(
            linearize,
            coordinates(q1, q2, q3, q4, q5, q6, q7),
            $($clause)*
            body(b1, rotation = rotation_y(q1), mass = 1, center_of_mass = [0, 0, 0.5], inertia = [0.4, 0.4, 0.1]),
            body(b2, parent = b1, position = [0, 0, 1], rotation = rotation_y(q2), mass = 1, inertia = 0.1),
            body(b3, parent = b2, position = [0, 0, 1], rotation = rotation_y(q3), mass = 1, inertia = 0.1),
            body(b4, parent = b3, position = [0, 0, 1], rotation = rotation_y(q4), mass = 1, inertia = 0.1),
            body(b5, parent = b4, position = [0, 0, 1], rotation = rotation_y(q5), mass = 1, inertia = 0.1),
            body(b6, parent = b5, position = [0, 0, 1], rotation = rotation_y(q6), mass = 1, inertia = 0.1),
            body(b7, parent = b6, position = [0, 0, 1], rotation = rotation_y(q7), mass = 1, inertia = 0.1),
        )]
        struct $name {
            #[gauss(gravity)]
            g: f64,
        }
    };
}

// Fourteen columns of derivatives are solved for, and one more for each motor: bundles of eight with every number of
// columns to spare.
chain!(Chain0 []);
chain!(Chain1 [input(u1), drive(q1 = u1),]);
chain!(Chain2 [input(u1, u2), drive(q1 = u1), drive(q2 = u2),]);
chain!(Chain3 [input(u1, u2, u3), drive(q1 = u1), drive(q2 = u2), drive(q3 = u3),]);
chain!(Chain4 [input(u1, u2, u3, u4), drive(q1 = u1), drive(q2 = u2), drive(q3 = u3), drive(q4 = u4),]);
chain!(Chain5 [
    input(u1, u2, u3, u4, u5), drive(q1 = u1), drive(q2 = u2), drive(q3 = u3), drive(q4 = u4), drive(q5 = u5),
]);
chain!(Chain6 [
    input(u1, u2, u3, u4, u5, u6),
    drive(q1 = u1), drive(q2 = u2), drive(q3 = u3), drive(q4 = u4), drive(q5 = u5), drive(q6 = u6),
]);
chain!(Chain7 [
    input(u1, u2, u3, u4, u5, u6, u7),
    drive(q1 = u1), drive(q2 = u2), drive(q3 = u3), drive(q4 = u4), drive(q5 = u5), drive(q6 = u6), drive(q7 = u7),
]);

/// What motors add is solved for beside the rest, which stays what it is: A ∂ż is the same for each, and 1 along its
/// own motor. The substitution is backward stable, with some hundred products for every entry.
#[test]
fn derivatives_in_bundles_of_columns() {
    let mut random = Random(11);
    let plain = Chain0 { g: 9.81 }.kernel().unwrap();
    for _ in 0..5 {
        let (q, z): (Joints, Joints) = (random.vector(3.0), random.vector(2.0));
        let matrix = plain.mass_matrix(0.0, &q);
        let alone = plain.linearize(0.0, &q, &z, &()).by_state;
        macro_rules! with_motors {
            ($($name:ident: $count:literal),*) => {$(
                let kernel = $name { g: 9.81 }.kernel().unwrap();
                let linear = kernel.linearize(0.0, &q, &z, &SVector::<f64, $count>::zeros());
                let apart = (linear.by_state - alone).fixed_rows::<7>(7).into_owned();
                let (error, size) = ((matrix * apart).norm(), matrix.norm() * alone.norm());
                assert!(error <= 500.0 * f64::EPSILON * size, "{}: {error:e} of {size:e}", $count);
                let rates = linear.by_input.fixed_rows::<7>(7).into_owned();
                let error = (matrix * rates - SMatrix::<f64, 7, $count>::identity()).norm();
                let size = matrix.norm() * rates.norm();
                assert!(error <= 500.0 * f64::EPSILON * size, "{}: {error:e} of {size:e}", $count);
            )*};
        }
        with_motors!(Chain1: 1, Chain2: 2, Chain3: 3, Chain4: 4, Chain5: 5, Chain6: 6, Chain7: 7);
    }
}

/// The reference has the masses of the public description; moments go from G to O by Steiner's theorem.
#[test]
fn the_reference_is_about_the_described_arm() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/panda_chain.json");
    let chain: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    for (k, link) in links("links").iter().enumerate() {
        let described = &chain["links"][k];
        let mass = described["mass"].as_f64().unwrap();
        let c = Vector3::from_fn(|i, _| described["center_of_mass"][i].as_f64().unwrap());
        let about_center = &described["inertia_about_center_of_mass"];
        let names = [["ixx", "ixy", "ixz"], ["ixy", "iyy", "iyz"], ["ixz", "iyz", "izz"]];
        let about_center = Matrix3::from_fn(|i, j| about_center[names[i][j]].as_f64().unwrap());
        let inertia = about_center + (Matrix3::identity() * c.dot(&c) - c * c.transpose()) * mass;
        assert_eq!((link.mass, link.center_of_mass), (mass, c));
        assert!((link.inertia - inertia).amax() <= 4.0 * f64::EPSILON, "link {k}");
    }
}

#[test]
fn accelerations_as_in_the_reference() {
    let (arm, straight, _) = arms();
    let scene = reference("seven_joint_arm");
    let states = scene["states"].as_array().unwrap();
    assert!(states.len() >= 8);
    for state in states {
        let list = |key: &str| Joints::from_iterator(numbers(&state[key]));
        let (q, z) = (list("q"), list("q_rate"));
        let (acceleration, momentum) = (list("q_acceleration"), list("momentum"));
        let (kinetic, potential) = (number(&state["kinetic_energy"]), number(&state["potential_energy"]));
        compare(&arm, &q, &z, (acceleration, momentum), (kinetic, potential));
        compare(&straight, &q, &z, (acceleration, momentum), (kinetic, potential));
    }
}

fn compare<S>(kernel: &S, q: &Joints, z: &Joints, expected: (Joints, Joints), (kinetic, potential): (f64, f64))
where
    S: System<Configuration = Joints, Speeds = Joints>,
{
    let sizes = Sizes::of(kernel, 0.0, q, z);
    // The condition of A is in the size of the accelerations.
    let rounding = sizes.rounding;
    let found = kernel.acceleration(0.0, q, z, &());
    let error = (found - expected.0).amax();
    assert!(error <= rounding * sizes.acceleration, "{error:e}: {found} {}", expected.0);
    let error = (kernel.momentum(0.0, q, z) - expected.1).amax();
    assert!(error <= rounding * sizes.momentum, "{error:e}");
    let error = kernel.kinetic_energy(0.0, q, z) - kinetic;
    assert!(error.abs() <= rounding * sizes.energy, "{error:e}");
    let error = kernel.potential_energy(0.0, q) - potential;
    assert!(error.abs() <= rounding * sizes.energy, "{error:e}");
}

#[test]
fn an_evaluation_costs_what_composite_inertias_cost() {
    for (name, cost) in [
        ("in the frames of the description", ArmKernel::OPERATIONS.acceleration),
        ("in straight frames", StraightArmKernel::OPERATIONS.acceleration),
        ("by other speeds", ArmByOtherSpeedsKernel::OPERATIONS.acceleration),
    ] {
        assert!(cost.additions + cost.multiplications <= 1500, "{name}: {cost}");
        // One for each joint at most.
        assert!(cost.divisions <= 7, "{name}: {cost}");
        // The angle of the first joint does not enter: the base does not move, and gravity is along its axis.
        assert_eq!((cost.transcendentals, cost.roots), (12, 0), "{name}: {cost}");
    }
}

/// Recursive Newton–Euler, customised and with base parameters, takes 92n − 127 multiplications and 81n − 117 additions
/// for a general robot of n hinges (W. Khalil & J.-F. Kleinfinger, *Minimum operations and minimum parameters of the
/// dynamic models of tree structure robots*, IEEE J. Robotics and Automation 3, 1987). The arm is not general: its
/// joints are at right angles.
#[test]
fn inverse_dynamics_costs_less_than_recursive_newton_euler() {
    let published = (92 * 7 - 127, 81 * 7 - 117);
    for (name, cost) in [
        ("in the frames of the description", ArmKernel::OPERATIONS.gauss_residual),
        ("in straight frames", StraightArmKernel::OPERATIONS.gauss_residual),
    ] {
        assert!(cost.multiplications <= published.0 && cost.additions <= published.1, "{name}: {cost}");
        assert_eq!((cost.divisions, cost.roots), (0, 0), "{name}: {cost}");
    }
}

/// Lengths of what is left of the columns beside those before, the longest first (Gram–Schmidt twice, with pivots): a
/// gap among them is at the rank.
fn pivots(mut columns: Vec<Vec<f64>>) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut lengths = Vec::new();
    while !columns.is_empty() {
        let squares: Vec<f64> = columns.iter().map(|column| dot(column, column)).collect();
        let best = (0..columns.len()).max_by(|&i, &j| squares[i].total_cmp(&squares[j])).unwrap();
        let pivot = columns.swap_remove(best);
        let square = squares[best];
        lengths.push(square.sqrt());
        if square == 0.0 {
            continue;
        }
        for column in &mut columns {
            for _ in 0..2 {
                let share = dot(column, &pivot) / square;
                column.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= share * y);
            }
        }
    }
    lengths
}

/// The rank of stacked regressors is the number of base parameters: 43 of the 70 (C. Gaz, M. Cognetti, A. Oliva, P.
/// Robuffo Giordano & A. De Luca, *Dynamic identification of the Franka Emika Panda robot with retrieval of feasible
/// parameters using penalty-based optimization*, IEEE Robotics and Automation Letters 4, 2019).
#[test]
fn base_parameters_can_be_told_apart() {
    let (arm, ..) = arms();
    let mut random = Random(3);
    let mut columns = vec![Vec::new(); ArmKernel::INERTIAL_PARAMETERS.len()];
    for _ in 0..40 {
        let [q, z, rate]: [Joints; 3] = [3.0, 2.0, 3.0].map(|size| random.vector(size));
        let regressor = arm.regressor(0.0, &q, &z, &rate);
        columns.iter_mut().enumerate().for_each(|(k, column)| column.extend(regressor.column(k).iter()));
    }
    // Columns of one length, so that units do not decide what is small.
    for column in &mut columns {
        let norm = column.iter().map(|x| x * x).sum::<f64>().sqrt();
        column.iter_mut().for_each(|x| *x /= norm.max(f64::MIN_POSITIVE));
    }
    let lengths = pivots(columns);
    // A rounding for each of the 280 rows; the shortest that is more than that is not short at all.
    let rank = lengths.iter().filter(|&&length| length > 280.0 * f64::EPSILON).count();
    assert_eq!((lengths.len(), rank), (70, 43));
    assert!(lengths[42] > 0.1, "{}", lengths[42]);
}

/// `A ż + … = Y π`, differentiated at a motion without forces: `A ∂ż/∂p = −Y ∂π/∂p`, where π has m c for c.
#[test]
fn derivatives_by_parameters_are_in_the_regressor() {
    let (arm, ..) = arms();
    let links = links("links");
    let mut random = Random(8);
    for _ in 0..20 {
        let (q, z): (Joints, Joints) = (random.vector(3.0), random.vector(2.0));
        let by_parameters = arm.by_parameters(0.0, &q, &z, &());
        let regressor = arm.regressor(0.0, &q, &z, &arm.acceleration(0.0, &q, &z, &()));
        let mass_matrix = arm.mass_matrix(0.0, &q);
        let eigenvalues = mass_matrix.symmetric_eigenvalues();
        // Accelerations, and their derivatives once more, are known as well as A can be inverted; 8√N roundings of N
        // operations.
        let rounding = 8.0 * f64::from(ArmKernel::OPERATIONS.by_parameters.total()).sqrt() * f64::EPSILON;
        let rounding = rounding * eigenvalues.max() / eigenvalues.min();
        for (link, body) in links.iter().enumerate() {
            for k in 0..10 {
                let column = 10 * link + k;
                let of = |k: usize| Joints::from(regressor.column(10 * link + k));
                let (change, terms) = match k {
                    0 => {
                        let moments: Vec<Joints> = (0..3).map(|i| of(1 + i) * body.center_of_mass[i]).collect();
                        (
                            of(0) + moments.iter().sum::<Joints>(),
                            of(0).amax() + moments.iter().map(|y| y.amax()).sum::<f64>(),
                        )
                    }
                    1..=3 => (of(k) * body.mass, of(k).amax() * body.mass),
                    _ => (of(k), of(k).amax()),
                };
                let rate = Joints::from_fn(|i, _| by_parameters[(7 + i, column)]);
                let error = (mass_matrix * rate + change).amax();
                let size = 7.0 * mass_matrix.amax() * rate.amax() + terms;
                assert!(error <= rounding * size, "{}: {error:e} of {size:e}", ArmKernel::PARAMETERS[column]);
            }
        }
    }
}

fn to_sums(q: &Joints, z: &Joints) -> (Joints, Joints) {
    let mut sums = *z;
    (1..7).for_each(|k| sums[k] += sums[k - 1]);
    (*q, sums)
}

proptest! {
    // An evaluation is a thousand operations, and a state takes some hundred of them.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arms_at_random(q in prop::array::uniform7(-3.0..3.0_f64), z in prop::array::uniform7(-2.0..2.0_f64)) {
        let (arm, straight, sums) = arms();
        let (q, z) = (SVector::from(q), SVector::from(z));
        laws(&arm, 0.0, &q, &z, Time::Absent);
        least(&arm, 0.0, &q, &z);
        laws(&straight, 0.0, &q, &z, Time::Absent);
        corresponds(&arm, &straight, 0.0, (&q, &z), |_, q, z| (*q, *z));
        corresponds(&straight, &sums, 0.0, (&q, &z), |_, q, z| to_sums(q, z));
        let (q, z) = to_sums(&q, &z);
        laws(&sums, 0.0, &q, &z, Time::Absent);
        least(&sums, 0.0, &q, &z);
    }
}
