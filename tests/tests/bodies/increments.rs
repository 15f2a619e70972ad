//! Increments of states as flat vectors: the same as those of the parts, and their names.

use gauss_runtime::configuration::{Configuration, Product, VectorSpace};
use gauss_runtime::prelude::*;

/// A pose, a rotation and two scalars, one of them declared before the others.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(reach, craft: Pose, dish: Rotation, angle),
    speeds(u: Vector3, w: Vector3, spin, turn: Vector3, slide),
    kinematics(craft = twist(u, w), dish = turn, angle = spin, reach = slide),
    body(hull, pose = craft, mass = 10, inertia = 0.2),
    body(wheel, parent = hull, rotation = rotation_z(angle), mass = 0.5, inertia = [0.001, 0.001, along]),
    body(antenna, parent = hull, rotation = dish, position = [0, 0, 1], mass = 0.1, inertia = 0.01),
    particle(mass = 0.2, position = [reach, 0, 0], parent = hull),
    linearize,
)]
struct Craft {
    along: f64,
}

/// Six of the pose, three of the rotation, two scalars; as many speeds.
const N: usize = 22;

fn increment(seed: usize) -> SVector<f64, N> {
    SVector::from_fn(|i, _| (0.7 * (i + seed) as f64).sin())
}

fn start() -> (<CraftKernel as GaussSystem>::Configuration, <CraftKernel as GaussSystem>::Speeds) {
    let state = CraftState {
        craft: Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, 0.2, -0.4)),
        dish: UnitQuaternion::from_euler_angles(0.2, -0.1, 0.7),
        angle: 0.4,
        reach: 0.3,
        spin: 5.0,
        ..Default::default()
    };
    (state.q(), state.z())
}

#[test]
fn there_and_back() {
    let kernel = Craft { along: 0.002 }.kernel().unwrap();
    let (q, z) = start();
    for seed in 0..5 {
        let x = increment(seed);
        let (there, speeds) = kernel.retract(&q, &z, &x);
        let back: SVector<f64, N> = kernel.difference((&q, &z), (&there, &speeds));
        // A few roundings of numbers up to 5, and of logarithms of angles up to 1.7.
        assert!((back - x).amax() < 1e-14, "{seed}: {:e}", (back - x).amax());
    }
}

#[test]
fn names_lead_to_their_parts() {
    let kernel = Craft { along: 0.002 }.kernel().unwrap();
    let origin = CraftState::default();
    let x = increment(1);
    let (q, z) = kernel.retract(&origin.q(), &origin.z(), &x);
    let state = CraftState::of(&q, &z);
    assert_eq!((state.angle, state.reach), (x[CraftIndex::angle], x[CraftIndex::reach]));
    assert_eq!((state.spin, state.slide), (x[CraftIndex::spin], x[CraftIndex::slide]));
    let range = |range: std::ops::Range<usize>| x.rows_range(range).into_owned();
    assert_eq!(state.w.as_slice(), range(CraftIndex::w).as_slice());
    assert_eq!(state.turn.as_slice(), range(CraftIndex::turn).as_slice());
    let [pose, dish] = [range(CraftIndex::craft), range(CraftIndex::dish)];
    // From the identity exp is all there is; it is rounded once more where the norm is held.
    let expected = Isometry3::identity().retract(&Vector6::from_column_slice(pose.as_slice()));
    assert!((expected.to_homogeneous() - state.craft.to_homogeneous()).amax() < 1e-15);
    let expected = UnitQuaternion::identity().retract(&Vector3::from_column_slice(dish.as_slice()));
    assert!(expected.angle_to(&state.dish) < 1e-15);
    // Every place has one name.
    let mut places: Vec<usize> = [CraftIndex::angle, CraftIndex::reach, CraftIndex::spin, CraftIndex::slide].to_vec();
    let ranges = [CraftIndex::craft, CraftIndex::dish, CraftIndex::u, CraftIndex::w, CraftIndex::turn];
    places.extend(ranges.into_iter().flatten());
    places.sort_unstable();
    assert_eq!(places, (0..N).collect::<Vec<_>>());
    // The order is that of the derivatives: ḋ(angle) by spin is 1.
    let linear = kernel.linearize(0.0, &q, &z, &());
    assert_eq!(linear.by_state[(CraftIndex::angle, CraftIndex::spin)], 1.0);
    assert_eq!(linear.by_state[(CraftIndex::reach, CraftIndex::slide)], 1.0);
}

/// What `dexp` says of small changes is what the states do.
#[test]
fn changes_are_carried() {
    let kernel = Craft { along: 0.002 }.kernel().unwrap();
    let (q, z) = start();
    let x = increment(3);
    let moved = kernel.retract(&q, &z, &x);
    let carried: SMatrix<f64, N, N> = kernel.dexp(&x);
    let h = 1e-6;
    for column in 0..N {
        let end = |sign: f64| {
            let mut changed = x;
            changed[column] += sign * h;
            let (q, z) = kernel.retract(&q, &z, &changed);
            kernel.difference::<N>((&moved.0, &moved.1), (&q, &z))
        };
        let slope = (end(1.0) - end(-1.0)) / (2.0 * h);
        // Truncation h² times third derivatives of order 1, rounding 1e-16 · 5 / h.
        assert!((slope - carried.column(column)).amax() < 1e-9, "{column}");
    }
}

#[test]
fn pairs_are_flat_where_one_says_so() {
    let flat = SVector::<f64, 4>::new(1.0, 2.0, 3.0, 4.0);
    let pair: Product<Vector3<f64>, SVector<f64, 1>> = flat.into();
    assert_eq!((pair.first, pair.second[0]), (Vector3::new(1.0, 2.0, 3.0), 4.0));
    assert_eq!(SVector::<f64, 4>::from(pair), flat);
    assert_eq!(VectorSpace::<f64>::flat::<4>(&pair), flat);
    // Where the configuration alone is moved.
    let q = (UnitQuaternion::<f64>::identity(), SVector::<f64, 1>::from([1.0]));
    assert_eq!(q.retract(&flat.into()).1[0], 5.0);
}
