//! Robots whose files have shapes that touch a ground: which contacts they have, and that they stand.

use gauss_contact::{ContactErrorKind, ContactRun, EventKind, Mode};
use gauss_runtime::contact::Contact;
use gauss_runtime::forces::Columns;
use gauss_runtime::prelude::*;

const G: f64 = 9.81;
const EPSILON: f64 = f64::EPSILON;

/// On its feet, in joints with one input each.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/quadruped.urdf",
    base = floating,
    gravity = 9.81,
    ground(links = [lf_foot, rf_foot, lh_foot, rh_foot], friction = mu),
)]
struct Quadruped {
    mu: f64,
}

/// Thighs forward, shanks backward by as much: feet are below their hips.
fn crouched(angle: f64, above: f64) -> (Isometry3<f64>, SVector<f64, 8>) {
    let height = 0.4 * angle.cos() + 0.02 + above;
    let legs = SVector::from_fn(|k, _| if k % 2 == 0 { angle } else { -2.0 * angle });
    (Isometry3::translation(0.0, 0.0, height), legs)
}

#[test]
fn a_quadruped_stands_on_its_feet() {
    let names: Vec<&str> = QuadrupedKernel::CONTACTS.iter().map(|contact| contact.name).collect();
    assert_eq!(names, ["lf_foot", "rf_foot", "lh_foot", "rh_foot"]);
    let kernel = Quadruped { mu: 0.7 }.kernel().unwrap();
    let (pose, legs) = crouched(0.5, 0.01);
    let law = move |_t: f64, q: &(Isometry3<f64>, SVector<f64, 8>), z: &SVector<f64, 14>| {
        (legs - q.1) * 400.0 - z.fixed_rows::<8>(6) * 12.0
    };
    let run = ContactRun::new(&kernel).input(law).adaptive(1e-10, 1e-10);
    let run = run.run((pose, legs), SVector::zeros(), 0.0..2.0).unwrap();
    // All feet land at once, after a fall of 1 cm.
    let lands = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))).unwrap().time;
    assert!((lands - (2.0 * 0.01 / G).sqrt()).abs() < 1e-9, "{lands}");
    assert_eq!(run.modes(1.9).unwrap(), [Mode::Sticks; 4]);

    // Where feet stick nothing slips: velocities of parts that move at some m/s, to rounding; gaps are closed to
    // rounding. Feet roll as their shanks turn: places less that keep within the tolerance of some hundred steps.
    let place = |foot: usize, q: &(Isometry3<f64>, SVector<f64, 8>)| {
        let turn = q.0.rotation.euler_angles().1 + q.1[2 * foot] + q.1[2 * foot + 1];
        kernel.contact_frame(foot, 0.0, q).unwrap().point - Vector3::x() * (0.02 * turn)
    };
    let early = run.at(0.1).unwrap();
    for t in [0.1, 0.15, 0.3, 1.0, 2.0] {
        let now = run.at(t).unwrap();
        assert!(kernel.contact_rates(t, &now.q, &now.z).amax() < 64.0 * EPSILON);
        assert!(kernel.gaps(t, &now.q).amax() < 16.0 * EPSILON);
        let moved = (0..4).map(|foot| (place(foot, &now.q) - place(foot, &early.q)).amax()).fold(0.0, f64::max);
        assert!(moved < 1e-8, "{moved:e} until {t}");
    }
    // At rest the feet bear the weight of 8 kg and four legs of 0.9 kg, and their moment about Ω is that of the weight.
    // What is left of the motion is 400 N m times the tolerance of angles.
    let end = run.last().unwrap();
    let weight = Vector3::new(0.0, 0.0, 11.6 * G);
    let forces = run.forces(2.0).unwrap().vectors();
    let sum: Vector3<f64> = forces.iter().map(|force| force.force).sum();
    assert!((sum - weight).amax() < 1e-6, "{sum}");
    let moment: Vector3<f64> = forces.iter().map(|force| force.point.cross(&force.force)).sum();
    assert!((moment - center(&end.q).cross(&weight)).amax() < 1e-6, "{moment}");
}

/// The centre of mass of the quadruped, from the numbers of its file.
fn center((pose, angles): &(Isometry3<f64>, SVector<f64, 8>)) -> Vector3<f64> {
    let below = |length: f64, angle: f64| Vector3::new(-length * angle.sin(), 0.0, -length * angle.cos());
    let mut sum = 8.0 * pose.translation.vector;
    for (leg, (x, y)) in [(0.2, 0.15), (0.2, -0.15), (-0.2, 0.15), (-0.2, -0.15)].into_iter().enumerate() {
        let (hip, knee) = (angles[2 * leg], angles[2 * leg] + angles[2 * leg + 1]);
        let origin = Vector3::new(x, y, 0.0);
        let of = |own: Vector3<f64>| pose.translation.vector + pose.rotation * (origin + own);
        sum += 0.6 * of(below(0.1, hip)) + 0.3 * of(below(0.2, hip) + below(0.1, knee));
    }
    sum / 11.6
}

/// The same by clauses of the struct beside the file.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/quadruped.urdf",
    base = floating,
    gravity = 9.81,
    inputs = none,
    contact(paw, point = lf_foot.position, radius = 0.02, friction = mu),
    point(sole, body = rh_shank, at = [0, 0, -0.2]),
    contact(hoof, point = sole, radius = 0.02, friction = mu),
)]
struct WithContacts {
    mu: f64,
}

#[test]
fn contacts_beside_a_file() {
    let (file, own) = (Quadruped { mu: 0.7 }.kernel().unwrap(), WithContacts { mu: 0.7 }.kernel().unwrap());
    let (pose, legs) = crouched(0.3, 0.05);
    let q = (pose * Isometry3::new(Vector3::new(0.1, 0.2, 0.0), Vector3::new(0.3, -0.2, 0.5)), legs);
    let [gaps, others] = [file.gaps(0.0, &q).as_slice().to_vec(), own.gaps(0.0, &q).as_slice().to_vec()];
    // Sums of some tens of products of numbers below one.
    assert!((gaps[0] - others[0]).abs() <= 64.0 * EPSILON && (gaps[3] - others[1]).abs() <= 64.0 * EPSILON);
}

/// All shapes of a file against a plane that is no level.
#[derive(GaussDynamics)]
#[gauss(urdf = "robots/shapes.urdf", base = floating, ground(friction = 0.5, plane = [1, 2, 2], height = -0.2))]
struct Shapes;

/// What the same shapes are in clauses: places and axes by rotations of the language.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 3, inertia = [0.2, 0.3, 0.4]),
    contact(hull, point = hull.position, radius = 0.3, friction = 0.5, plane = [1, 2, 2], height = -0.2),
    point(cargo_center, body = hull, at = [0.1, 0.2, -0.3]),
    contact(cargo, point = cargo_center, edges = [0.2, 0.4, 0.6], friction = 0.5, plane = [1, 2, 2], height = -0.2),
    frame(
        brick, parent = hull, position = [-0.4, 0, 0.1],
        rotation = rotation_z(0.7) * rotation_y(-0.5) * rotation_x(0.3)
    ),
    contact(brick, point = brick.position, edges = [0.6, 0.2, 0.4], friction = 0.5, plane = [1, 2, 2], height = -0.2),
    frame(wheel, parent = hull, position = [0, 0.5, 0], rotation = rotation_x(pi / 2)),
    contact(
        wheel, point = wheel.position, rim = 0.25, axis = [0, 0, 1], length = 0.1, friction = 0.5, plane = [1, 2, 2],
        height = -0.2
    ),
    frame(bone, parent = hull, position = [0, -0.5, 0.2], rotation = rotation_y(pi / 6)),
    point(knee, body = bone, at = [0, 0, -0.2]),
    point(ankle, body = bone, at = [0, 0, 0.2]),
    contact(bone, point = knee, end = ankle, radius = 0.05, friction = 0.5, plane = [1, 2, 2], height = -0.2),
)]
struct ShapesInClauses {}

#[test]
fn every_shape_touches_as_in_clauses() {
    let names: Vec<&str> = ShapesKernel::CONTACTS.iter().map(|contact| contact.name).collect();
    let others: Vec<&str> = ShapesInClausesKernel::CONTACTS.iter().map(|contact| contact.name).collect();
    assert_eq!((names.len(), &names), (21, &others));
    let (file, clauses) = (Shapes.kernel().unwrap(), ShapesInClauses {}.kernel().unwrap());
    for k in 1..6 {
        let part = |n: i32| f64::from(n * k).sin();
        let turn = UnitQuaternion::from_euler_angles(part(1), part(2), part(3));
        let q = Isometry3::from_parts(Translation3::new(part(4), part(5), 1.0 + part(6)), turn);
        let z = SVector::from_fn(|i, _| part(7 + i as i32));
        let [a, b] = [file.gaps(0.0, &q), clauses.gaps(0.0, &q)];
        // Places are sums of some products of numbers of order one; rims have a root besides.
        assert!((a - b).amax() < 64.0 * EPSILON, "{}", a - b);
        let [a, b] = [file.contact_rates(0.0, &q, &z), clauses.contact_rates(0.0, &q, &z)];
        assert!((a - b).amax() < 256.0 * EPSILON, "{}", a - b);
        let columns = [file.contact_jacobian(0.0, &q), clauses.contact_jacobian(0.0, &q)];
        for row in 0..63 {
            let [a, b]: [SVector<f64, 6>; 2] = [columns[0].nth(row).unwrap(), columns[1].nth(row).unwrap()];
            assert!((a - b).amax() < 256.0 * EPSILON, "{row}: {}", a - b);
        }
    }
}

/// Ellipsoids of a file against a plane that is no level.
#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/pebbles.xml", ground(plane = [1, 2, 2], height = -0.2))]
struct Pebbles;

/// The same in clauses; of the grain the third axis is from its second end to the first, so along −x of the body.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(flight: Pose),
    body(stone, position = flight.position, rotation = flight.rotation, mass = 3, inertia = [0.2, 0.3, 0.4]),
    contact(egg, point = stone.position, semi_axes = [0.3, 0.2, 0.5], friction = 1, plane = [1, 2, 2], height = -0.2),
    point(core, body = stone, at = [0.1, -0.4, 0.2]),
    contact(pip, point = core, semi_axes = [0.1, 0.2, 0.3], friction = 1, plane = [1, 2, 2], height = -0.2),
    frame(
        hull, parent = stone, position = [-0.4, 0, 0.1],
        rotation = rotation_z(0.7) * rotation_y(-0.5) * rotation_x(0.3)
    ),
    contact(bean, point = hull.position, semi_axes = [0.6, 0.2, 0.4], plane = [1, 2, 2], height = -0.2),
    frame(husk, parent = stone, position = [0.2, -0.5, -0.2], rotation = rotation_y(-pi / 2)),
    contact(grain, point = husk.position, semi_axes = [0.05, 0.05, 0.2], friction = 1, plane = [1, 2, 2], height = -0.2),
    point(seed, body = stone, at = [0.2, 0.3, 0.1]),
    contact(pea, point = seed, radius = 0.25, friction = 1, plane = [1, 2, 2], height = -0.2),
)]
struct PebblesInClauses {}

#[test]
fn ellipsoids_touch_as_in_clauses() {
    let of = |contacts: &[Contact]| contacts.iter().map(|own| (own.name, own.rows().len())).collect::<Vec<_>>();
    let rows = [("egg", 3), ("pip", 3), ("bean", 1), ("grain", 3), ("pea", 3)];
    assert_eq!((of(PebblesKernel::CONTACTS), of(PebblesInClausesKernel::CONTACTS)), (rows.to_vec(), rows.to_vec()));
    let (file, clauses) = (Pebbles.kernel().unwrap(), PebblesInClauses {}.kernel().unwrap());
    for k in 1..6 {
        let part = |n: i32| f64::from(n * k).sin();
        let turn = UnitQuaternion::from_euler_angles(part(1), part(2), part(3));
        let q = Isometry3::from_parts(Translation3::new(part(4), part(5), 1.0 + part(6)), turn);
        let z = SVector::from_fn(|i, _| part(7 + i as i32));
        // Sums of some tens of products of numbers of order one, with a root; semi-axes differ by up to eight times.
        let [a, b] = [file.gaps(0.0, &q), clauses.gaps(0.0, &q)];
        assert!((a - b).amax() < 64.0 * EPSILON, "{}", a - b);
        let [a, b] = [file.contact_rates(0.0, &q, &z), clauses.contact_rates(0.0, &q, &z)];
        assert!((a - b).amax() < 256.0 * EPSILON, "{}", a - b);
    }
}

/// Planes, bits, exclusions and friction of the file.
#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/footed.xml", ground)]
struct Footed;

#[test]
fn a_file_says_what_touches_what() {
    let names: Vec<String> = FootedKernel::CONTACTS.iter().map(|contact| contact.name.to_owned()).collect();
    let corners = (0..8).map(|k| format!("sole_{k}"));
    assert_eq!(names, corners.chain(["bumper".to_owned()]).collect::<Vec<_>>());
    // The wall is without friction.
    assert_eq!(FootedKernel::CONTACTS[8].rows().len(), 1);
    let kernel = Footed.kernel().unwrap();
    let start = FootedState::start();
    let gaps = kernel.gaps(0.0, &start.q());
    // The sole is from 0.1 to 0.14, the floor at 0.1; the bumper is before the wall.
    let expected = [0.0, 0.0, 0.0, 0.0, 0.04, 0.04, 0.04, 0.04, 2.0 - 0.3 - 0.05];
    assert!((gaps - SVector::from(expected)).amax() < 8.0 * EPSILON, "{gaps}");
}

#[test]
fn a_sole_slides_by_the_friction_of_its_file() {
    let kernel = Footed.kernel().unwrap();
    let (v, mu) = (0.9, 0.6);
    let state = FootedState { flight_u: Vector3::new(v, 0.0, 0.0), ..FootedState::start() };
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(state.q(), state.z(), 0.0..0.5).unwrap();
    // The larger of 0.6 and 0.3 of the floor.
    let end = run.last().unwrap();
    let slid = end.q.translation.vector.x;
    assert!((slid - v * v / (2.0 * mu * G)).abs() < 1e-9, "{slid}");
    let stops = run.events().iter().find(|event| event.kind == EventKind::Sticks).unwrap().time;
    assert!((stops - v / (mu * G)).abs() < 1e-9, "{stops}");
    // Without weight along the ground four corners bear 4 kg.
    let forces = run.forces(0.4).unwrap().vectors();
    let sum: Vector3<f64> = forces.iter().map(|force| force.force).sum();
    assert!((sum - Vector3::new(0.0, 0.0, 4.0 * G)).amax() < 1e-10 && forces.len() == 4, "{sum}");
}

/// A fixed base, and cylinders by points.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/post.urdf",
    gravity = 9.81,
    inputs = none,
    ground(links = [post], friction = 0.5, restitution = e, height = h, cylinders = 6),
)]
struct Post {
    e: f64,
    h: f64,
}

#[test]
fn a_post_stands_on_points_of_its_rim() {
    let kernel = Post { e: 0.5, h: -0.1 }.kernel().unwrap();
    assert_eq!(PostKernel::CONTACTS.len(), 12);
    let start = SVector::from([0.25, 0.0]);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..0.3).unwrap();
    // The lower face is at −0.2 from the centre, 0.15 above the ground.
    let lands = run.events().first().unwrap().time;
    let fall = (2.0_f64 * 0.15 / G).sqrt();
    assert!((lands - fall).abs() < 1e-9, "{lands}");
    // It leaves with half of its speed: at 0.3 s it is above the ground.
    let end = run.last().unwrap();
    let up = 0.3 - fall;
    let above = 0.5 * G * fall * up - 0.5 * G * up * up;
    assert!((end.q[0] - 0.1 - above).abs() < 1e-9, "{}", end.q);
    let rest = Post { e: 0.0, h: -0.1 }.kernel().unwrap();
    let run = ContactRun::new(&rest).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..0.5).unwrap();
    let forces = *run.forces(0.4).unwrap();
    // Alike, of least norm, on the six points of the lower rim; along the rail nothing rubs.
    assert!((0..12).all(|k| (forces[k] - if k < 6 { 2.0 * G / 6.0 } else { 0.0 }).abs() < 1e-12), "{forces}");
}

/// Rims of a lever that is upright at first.
#[derive(GaussDynamics)]
#[gauss(urdf = "robots/post.urdf", gravity = 9.81, inputs = none, ground(links = [lever], friction = 0.5, height = h))]
struct Lever {
    h: f64,
}

/// A rim that lies flat harms nothing while it is above the ground; on it there is no lowest point, which a run says.
#[test]
fn a_rim_that_lies_flat() {
    let run = |h: f64, rate: f64| {
        let kernel = Lever { h }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8);
        run.run(SVector::zeros(), [0.0, rate].into(), 0.0..0.1).map(|run| run.last().unwrap().q[1])
    };
    // Its centre of mass is in the hinge, so that it turns on.
    assert_eq!(run(0.0, 0.0).unwrap(), 0.0);
    assert!((run(0.0, 2.0).unwrap() - 0.2).abs() < 1e-9);
    // Both rims at 1 ± 0.2: the lower one is on the ground.
    for rate in [0.0, 0.5] {
        let error = run(0.8, rate).unwrap_err();
        assert_eq!((error.contact, error.kind), (Some("lever_0"), ContactErrorKind::NonFinite));
    }
}
