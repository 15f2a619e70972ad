//! What sensors at contacts measure: of robots that stand, of blocks with closed forms, and what is refused.

use gauss_contact::{ContactRun, ContactStepper, ContactSteps, SensorError};
use gauss_runtime::centroidal::CentroidalSystem;
use gauss_runtime::prelude::*;

const G: f64 = 9.81;
const EPSILON: f64 = f64::EPSILON;

/// A quadruped on spheres of 31 mm, as in `benches/examples/contact_steps`.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/anymal.urdf", base = floating, gravity = 9.81, methods(centroidal),
    point(lf, body = LF_KFE_link, at = [0.033, 0.01305, -0.33797]),
    point(lh, body = LH_KFE_link, at = [-0.033, 0.01305, -0.33797]),
    point(rf, body = RF_KFE_link, at = [0.033, -0.01305, -0.33797]),
    point(rh, body = RH_KFE_link, at = [-0.033, -0.01305, -0.33797]),
    contact(lf_foot, point = lf, radius = 0.031, friction = 0.8),
    contact(lh_foot, point = lh, radius = 0.031, friction = 0.8),
    contact(rf_foot, point = rf, radius = 0.031, friction = 0.8),
    contact(rh_foot, point = rh, radius = 0.031, friction = 0.8),
)]
struct Anymal;

type Posture<const N: usize> = (Isometry3<f64>, SVector<f64, N>);

/// Down by the lowest gap.
fn landed<K, const N: usize>(kernel: &K, (mut base, angles): Posture<N>) -> Posture<N>
where
    K: ContactSystem<Scalar = f64, Configuration = Posture<N>>,
{
    let gaps = kernel.gaps(0.0, &(base, angles));
    base.translation.z -= (0..kernel.contacts().len()).map(|i| gaps.component(i)).fold(f64::INFINITY, f64::min);
    (base, angles)
}

#[test]
fn anymal_stands_on_its_weight() {
    let kernel = Anymal.kernel().unwrap();
    let leg = |side: f64| [0.0, 0.6 * side, -1.1 * side];
    let angles: Vec<f64> = [1.0, -1.0, 1.0, -1.0].into_iter().flat_map(leg).collect();
    let angles = SVector::<f64, 12>::from_column_slice(&angles);
    let start = landed(&kernel, (Isometry3::translation(0.0, 0.0, 0.6), angles));
    let law = move |_: f64, q: &Posture<12>, z: &SVector<f64, 18>| 200.0 * (angles - q.1) - 4.0 * z.fixed_rows::<12>(6);
    let h = 1e-3;
    let run = ContactSteps::new(&kernel, h).input(law).run(start, SVector::zeros(), 0.0..6.0).unwrap();
    let weight = kernel.total_mass() * G;
    let [before, step] = [&run[run.len() - 2], &run[run.len() - 1]];
    let forces = step.forces(&kernel);
    let (t, q) = (step.state.t, &step.state.q);

    // What is left of the motion: the speeds of parts of a metre, over a step.
    let change = |a: &SVector<f64, 18>, b: &SVector<f64, 18>| (a - b).amax() / h;
    let left = kernel.total_mass() * change(&step.state.z, &before.state.z);
    let rounding = 256.0 * weight * EPSILON / (h * G);
    let bound = 4.0 * left + rounding;
    assert!(bound < 1e-6 * weight, "it stands still: {left:e}");
    let center = kernel.center_of_mass(t, q);
    let wrench = forces.wrench(0..4, &center).unwrap();
    assert!((wrench.force - Vector3::z() * weight).amax() < bound, "{}", wrench.force);
    assert!(wrench.moment.amax() < bound, "{}", wrench.moment);
    // The pressure centre is where the weight is: moments by forces of its size, at the height of the ground.
    let pressure = forces.center_of_pressure(0..4).unwrap().unwrap();
    let height = center.z;
    assert!((pressure - center).xy().amax() < bound * (1.0 + height) / weight, "{pressure} {center}");
    assert!(pressure.z.abs() < 64.0 * EPSILON, "{pressure}");

    // Each foot by itself: along its frame and in the world, on the ground below its centre.
    for foot in 0..4 {
        let (own, frame) = (forces.in_world(foot).unwrap(), kernel.contact_frame(foot, t, q).unwrap());
        let [normal, first, second] = forces.in_frame(foot).unwrap();
        assert!(normal > 0.1 * weight && first.hypot(second) <= 0.8 * normal * (1.0 + 4.0 * EPSILON));
        let along = [&frame.normal, &frame.tangents()[0], &frame.tangents()[1]].map(|axis| axis.dot(&own.force));
        assert!((Vector3::from(along) - Vector3::new(normal, first, second)).amax() < 8.0 * EPSILON * weight);
        assert_eq!((own.point, own.contact), (frame.point, foot));
        let below = forces.center_of_pressure([foot]).unwrap().unwrap();
        assert!((below - frame.point).amax() < 16.0 * EPSILON);
    }
}

/// Contacts of a file, which know their links.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/quadruped.urdf", base = floating, gravity = 9.81, methods(centroidal),
    ground(links = [lf_foot, rf_foot, lh_foot, rh_foot], friction = 0.7),
)]
struct Quadruped;

#[test]
fn contacts_of_a_file_by_their_links() {
    let kernel = Quadruped.kernel().unwrap();
    let links = ["lf_foot", "rf_foot", "lh_foot", "rh_foot"];
    assert!(QuadrupedKernel::CONTACTS.iter().map(|own| own.bodies).eq(links.map(|link| [Some(link), None])));
    let legs = SVector::from_fn(|k, _| if k % 2 == 0 { 0.5 } else { -1.0 });
    let start = landed(&kernel, (Isometry3::translation(0.0, 0.0, 0.5), legs));
    let law = move |_: f64, q: &Posture<8>, z: &SVector<f64, 14>| (legs - q.1) * 400.0 - z.fixed_rows::<8>(6) * 12.0;
    let run = ContactSteps::new(&kernel, 1e-3).input(law).run(start, SVector::zeros(), 0.0..0.3).unwrap();
    let forces = run.last().unwrap().forces(&kernel);
    let pole = Vector3::new(0.3, -0.2, 0.1);
    let whole = forces.wrench(0..4, &pole).unwrap();
    let parts = links.map(|link| forces.wrench_on(link, &pole).unwrap());
    let sum = |of: fn(&gauss_contact::ContactWrench) -> Vector3<f64>| parts.iter().map(of).sum::<Vector3<f64>>();
    // Sums of four terms of the size of the weight, 114 N.
    assert!((sum(|part| part.force) - whole.force).amax() < 16.0 * EPSILON * 114.0);
    assert!((sum(|part| part.moment) - whole.moment).amax() < 16.0 * EPSILON * 114.0);
    assert_eq!(forces.of_body("lh_foot").unwrap().collect::<Vec<_>>(), [2]);
    let error = forces.wrench_on("lf_shank", &pole).unwrap_err();
    assert_eq!(error, SensorError::NoSuchBody { body: "lf_shank".to_owned() });
    assert!(forces.of_body("lf_shank").is_err());
}

/// A crate on a slope: its weight leans down along the first axis.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = 0.05),
    contact(floor, point = hull.position, edges = [0.5, 0.4, 0.2], friction = 0.9),
)]
struct Crate {
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn a_crate_on_a_slope_presses_below_its_weight() {
    let (down, aside) = (0.4, 0.25);
    let g = Vector3::new(down, aside, -1.0) * G;
    let kernel = Crate { g }.kernel().unwrap();
    let place = Vector3::new(0.3, -0.7, 0.1);
    let pose = Isometry3::from_parts(place.into(), UnitQuaternion::identity());
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(pose, SVector::zeros(), 0.0..0.1).unwrap();
    let mut stepper = ContactStepper::new(&kernel, 0.0, pose, SVector::zeros()).unwrap();
    stepper.step(0.01, &()).unwrap();
    // Along g from the centre of mass to the floor, 0.1 below; within the rounding of a step of 10 ms, and that of
    // solutions which hold to 1e-12 of the largest rate, g h.
    let below = place + Vector3::new(down, aside, -1.0) * 0.1;
    for (forces, tolerance) in [(run.forces(0.05).unwrap(), 1e-12), (stepper.forces(), 1e-11)] {
        let pressure = forces.center_of_pressure(0..8).unwrap().unwrap();
        assert!((pressure - below).amax() < tolerance, "{pressure}");
        let wrench = forces.wrench_on("hull", &below).unwrap();
        assert!((wrench.force + 2.0 * g).amax() < 20.0 * tolerance, "{}", wrench.force);
        assert!(wrench.moment.amax() < 20.0 * tolerance, "{}", wrench.moment);
    }
    // About another pole: the moment of the sum.
    let (forces, pole) = (stepper.forces(), Vector3::new(1.0, 2.0, 3.0));
    let [there, here] = [pole, below].map(|pole| forces.wrench(0..8, &pole).unwrap());
    assert!((there.moment - here.moment - (below - pole).cross(&here.force)).amax() < 1e-12);
}

#[test]
fn no_force_no_pressure() {
    let kernel = Crate { g: Vector3::z() * -G }.kernel().unwrap();
    let [low, high] = [0.1, 0.2].map(|z| Isometry3::translation(0.0, 0.0, z));
    let mut flying = ContactStepper::new(&kernel, 0.0, high, SVector::zeros()).unwrap();
    let resting = ContactStepper::new(&kernel, 0.0, low, SVector::zeros()).unwrap();
    flying.step(1e-3, &()).unwrap();
    // In flight, and before the first step.
    for forces in [flying.forces(), resting.forces()] {
        assert_eq!(forces.center_of_pressure(0..8), Ok(None));
        let wrench = forces.wrench(0..8, &Vector3::x()).unwrap();
        assert_eq!((wrench.force, wrench.moment), (Vector3::zeros(), Vector3::zeros()));
        let count = 8;
        assert_eq!(forces.in_world(8), Err(SensorError::NoSuchContact { contact: 8, count }));
        assert_eq!(forces.center_of_pressure([11]), Err(SensorError::NoSuchContact { contact: 11, count }));
    }
}

/// Two balls that are pressed together, on a floor, by a wall.
#[derive(GaussDynamics)]
#[gauss(
    gravity = [4, 0, -9.81],
    coordinates(a: Pose, b: Pose),
    body(one, position = a.position, rotation = a.rotation, mass = 1, inertia = 0.004),
    body(two, position = b.position, rotation = b.rotation, mass = 1, inertia = 0.004),
    contact(pair, point = one.position, radius = 0.1, other = two.position, other_radius = 0.1),
    contact(left, point = one.position, radius = 0.1),
    contact(right, point = two.position, radius = 0.1, friction = 0.2, drilling = 0.01, rolling = 0.001),
    contact(wall, point = two.position, radius = 0.1, plane = [-1, 0, 0], height = -1),
    contact(stop, gap = 1 - b.position.x),
)]
struct Balls {}

#[test]
fn what_is_no_force_at_a_point_is_refused() {
    let kernel = Balls {}.kernel().unwrap();
    let start = [0.7, 0.9].map(|x| Isometry3::translation(x, 0.0, 0.1));
    let mut stepper = ContactStepper::new(&kernel, 0.0, start.into(), SVector::zeros()).unwrap();
    stepper.step(1e-2, &()).unwrap();
    let forces = stepper.forces();
    let names: Vec<&str> = BallsKernel::CONTACTS.iter().map(|own| own.name).collect();
    assert_eq!(names, ["pair", "left", "right", "right_rolling", "wall", "stop"]);
    // The pair pushes both apart, with 4 N of one of them; 8 N arrive at the wall and, by friction, at the floor.
    let [one, two] = ["one", "two"].map(|body| forces.of_body(body).unwrap().collect::<Vec<_>>());
    assert_eq!((one, two), (vec![0, 1], vec![2, 3, 4]));
    let pole = Vector3::new(0.8, 0.0, 0.1);
    let on_one = forces.wrench_on("one", &pole).unwrap();
    // Rates of a step of 10 ms hold to 1e-12 of g h.
    assert!((on_one.force - Vector3::new(-4.0, 0.0, G)).amax() < 1e-10, "{}", on_one.force);
    let pair = forces.wrench([0], &pole).unwrap();
    assert!((pair.force.x + 4.0).abs() < 1e-10 && pair.moment.amax() < 1e-12, "{pair:?}");
    assert!((forces.wrench([2, 4], &pole).unwrap().force.x + 8.0).abs() < 1e-10);
    assert_eq!(forces.wrench_on("two", &pole).unwrap_err(), SensorError::Torque { contact: "right_rolling" });

    let planes = SensorError::NoCommonPlane { contacts: ["left", "wall"] };
    assert_eq!(forces.center_of_pressure([1, 4]), Err(planes.clone()));
    assert!(planes.to_string().contains("`left` and `wall` bear on different planes"));
    assert_eq!(forces.in_world(5), Err(SensorError::NoPlace { contact: "stop" }));
    assert_eq!(forces.in_world(3), Err(SensorError::Torque { contact: "right_rolling" }));
    // Rows as they are, with a torque of drilling and one of rolling.
    let mut rows = *forces.rows();
    rows[BallsKernel::CONTACTS[2].friction_rows().end - 1] = 0.5;
    let drills = gauss_contact::ContactForces::new(&kernel, 0.0, *stepper.configuration(), rows);
    assert_eq!(drills.wrench([2], &pole).unwrap_err(), SensorError::Torque { contact: "right" });
    assert_eq!(drills.center_of_pressure([2]), Err(SensorError::Torque { contact: "right" }));
    rows[BallsKernel::CONTACTS[3].normal] = 0.5;
    let rolls = gauss_contact::ContactForces::new(&kernel, 0.0, *stepper.configuration(), rows);
    assert_eq!(rolls.wrench_on("two", &pole).unwrap_err(), SensorError::Torque { contact: "right" });
    assert_eq!(rolls.center_of_pressure([3]), Err(SensorError::Torque { contact: "right_rolling" }));
}
