//! Runs of shapes: a box that falls on a face, a cylinder that rolls, a bead on hills, spheres that rub; and of robots
//! whose files have limits.

use gauss_contact::{ContactRun, EventKind, ImpactRecord, Mode};
use gauss_runtime::prelude::*;

const G: f64 = 9.81;

/// A box on a table.
#[derive(GaussDynamics)]
#[gauss(
    gravity = 9.81,
    coordinates(pose: Pose),
    body(cargo, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.1, 0.2, 0.25]),
    contact(table, point = cargo.position, edges = [1.0, 0.6, 0.4], friction = mu),
)]
struct Cargo {
    mu: f64,
}

#[test]
fn a_box_falls_on_a_face_and_rests() {
    // Tilted about its long edge, with the box turned about the vertical, which friction does not feel.
    let slid = [0.0, 0.7].map(|yaw| {
        let kernel = Cargo { mu: 0.1 }.kernel().unwrap();
        let tilted = UnitQuaternion::from_euler_angles(0.3, 0.0, yaw);
        let start = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.6), tilted);
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..1.0).unwrap();
        // The lower edge lands after a free fall; the box turns about it until the other edge of the face lands.
        let lands = run.events().first().unwrap().time;
        let fall = 0.6 - 0.3 * 0.3_f64.sin() - 0.2 * 0.3_f64.cos();
        assert!((lands - (2.0 * fall / G).sqrt()).abs() < 1e-12, "{lands}");
        assert_eq!(run.modes(lands + 0.01).unwrap().iter().filter(|mode| mode.is_closed()).count(), 2);
        let end = run.last().unwrap();
        let gaps = kernel.gaps(1.0, &end.q);
        assert!(end.z.amax() == 0.0 && gaps.as_slice()[..4].iter().all(|gap| gap.abs() < 1e-15), "{} {gaps}", end.z);
        assert!(end.q.rotation.angle_to(&UnitQuaternion::from_euler_angles(0.0, 0.0, yaw)) < 1e-7);
        assert_eq!(run.modes(0.9).unwrap(), [[Mode::Sticks; 4], [Mode::Open; 4]].concat());
        // Least norm: the corners bear the weight alike, and nothing along the table.
        let forces = *run.forces(0.9).unwrap();
        let bears = |row: usize| if row < 12 && row.is_multiple_of(3) { 0.5 * G } else { 0.0 };
        assert!((0..24).all(|row| (forces[row] - bears(row)).abs() < 1e-12), "{forces}");
        end.q.translation.vector.xy().norm()
    });
    assert!(slid[0] > 5e-3 && (slid[0] - slid[1]).abs() < 1e-9, "{slid:?}");
}

/// A cylinder on a slope, down along the first axis.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(drum, position = pose.position, rotation = pose.rotation, mass = 3, inertia = [0.2, 1.5 * r * r, 0.2]),
    contact(slope, point = drum.position, rim = r, axis = [0, 1, 0], length = 0.8, friction = mu),
)]
struct Drum {
    r: f64,
    mu: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn a_cylinder_rolls_down_a_slope() {
    let (incline, r, t) = (0.4_f64, 0.2, 1.5);
    let (down, onto) = (G * incline.sin(), G * incline.cos());
    // It rolls where μ is at least a third of the slope, with 2/3 of the acceleration without friction; else it slides.
    for mu in [0.3, 0.1] {
        let kernel = Drum { r, mu, g: Vector3::new(down, 0.0, -onto) }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
        let run = run.run(Isometry3::translation(0.0, 0.0, r), SVector::zeros(), 0.0..t).unwrap();
        let rolls = mu > incline.tan() / 3.0;
        let friction = if rolls { down } else { 3.0 * mu * onto };
        let (v, w) = ((down - friction / 3.0) * t, friction / (1.5 * r) * t);
        let end = run.last().unwrap();
        let velocity = end.q.rotation * Vector3::new(end.z[0], end.z[1], end.z[2]);
        // A hundred tolerances of speeds of some m/s and rad/s.
        assert!((velocity - Vector3::x() * v).amax() < 1e-8 && (end.z[4] - w).abs() < 1e-8, "{velocity} {}", end.z);
        assert_eq!(run.modes(1.0).unwrap().iter().all(|mode| *mode == Mode::Sticks), rolls);
        let forces = *run.forces(1.0).unwrap();
        // In the middle between both rims: half of the weight and of the friction each.
        let sizes = [forces[0], forces[1].hypot(forces[2]), forces[3], forces[4].hypot(forces[5])];
        let half = [1.5 * onto, 0.5 * friction, 1.5 * onto, 0.5 * friction];
        assert!(sizes.iter().zip(half).all(|(force, half)| (force - half).abs() < 1e-9), "{sizes:?} {half:?}");
        assert!(kernel.gaps(t, &end.q).amax() < 1e-15);
    }
}

/// A bead on hills.
#[derive(GaussDynamics)]
#[gauss(
    gravity = 9.81,
    coordinates(x, y, z),
    particle(mass = 0.3, position = [x, y, z]),
    contact(hills, point = [x, y, z], height = 0.2 * cos(2 * u) + 0.1 * v * v, over = [u, v]),
)]
struct Bead {}

#[test]
fn a_bead_keeps_its_energy_on_hills() {
    let kernel = Bead {}.kernel().unwrap();
    let start = SVector::from([0.6, 0.5, 0.2 * 1.2_f64.cos() + 0.1 * 0.25]);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start, SVector::zeros(), 0.0..6.0).unwrap();
    assert!(run.events().is_empty(), "{:?}", run.events());
    let before = kernel.energy(0.0, &start, &SVector::zeros());
    let mut fastest = 0.0_f64;
    for k in 1..60 {
        let now = run.at(0.1 * f64::from(k)).unwrap();
        fastest = fastest.max(kernel.kinetic_energy(now.t, &now.q, &now.z));
        // Some hundred steps of tolerance 1e-11, energies of half a joule; the gap is a constraint.
        assert!((kernel.energy(now.t, &now.q, &now.z) - before).abs() < 1e-10);
        assert!(
            kernel.gaps(now.t, &now.q)[0].abs() < 1e-15 && kernel.contact_rates(now.t, &now.q, &now.z)[0].abs() < 1e-14
        );
    }
    assert!(fastest > 0.5, "{fastest}");
}

/// Two billiard balls without weight.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a: Pose, b: Pose),
    body(one, position = a.position, rotation = a.rotation, mass = m, inertia = 0.4 * m * r * r),
    body(two, position = b.position, rotation = b.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(balls, point = one.position, radius = r, other = two.position, other_radius = r, along = [0, 0, 1],
            friction = mu, restitution = e),
)]
struct Balls {
    m: f64,
    r: f64,
    mu: f64,
    e: f64,
}

/// The momenta of two balls, and those about Ω.
fn momenta(m: f64, r: f64, (a, b): &(Isometry3<f64>, Isometry3<f64>), z: &SVector<f64, 12>) -> [Vector3<f64>; 2] {
    let of = |pose: &Isometry3<f64>, at: usize| {
        let part = |k: usize| pose.rotation * Vector3::new(z[at + k], z[at + k + 1], z[at + k + 2]);
        let momentum = m * part(0);
        [momentum, pose.translation.vector.cross(&momentum) + 0.4 * m * r * r * part(3)]
    };
    let ([p, l], [other_p, other_l]) = (of(a, 0), of(b, 6));
    [p + other_p, l + other_l]
}

#[test]
fn balls_exchange_spin() {
    let (m, r, e, v) = (0.17_f64, 0.028_f64, 0.9, 0.5);
    let line = Vector3::new(0.8, 0.6, 0.0);
    let beyond: Vector3<f64> = line * (3.0 * r);
    let q = (Isometry3::identity(), Isometry3::translation(beyond.x, beyond.y, beyond.z));
    let spin = Vector3::new(-6.0, 8.0, 5.0);
    let mut z = SVector::<f64, 12>::zeros();
    z.fixed_rows_mut::<3>(0).copy_from(&(v * line));
    z.fixed_rows_mut::<3>(3).copy_from(&spin);
    let slip: Vector3<f64> = spin.cross(&(line * r));
    // Along the line two masses of a ball in series; across it also their inertia: 2/m + 2 r²/(2/5 m r²) = 7/m.
    let push = 0.5 * m * (1.0 + e) * v;
    for mu in [0.9, 0.02] {
        let kernel = Balls { m, r, mu, e }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(q, z, 0.0..0.2).unwrap();
        let impact = run.events().iter().find_map(|event| match &event.kind {
            EventKind::Impact(impact) => Some(*impact),
            _ => None,
        });
        let ImpactRecord { impulse, energy_lost, .. } = impact.unwrap();
        let rub = (m * slip.norm() / 7.0).min(mu * push);
        assert!((impulse[0] - push).abs() < 1e-12 && (impulse[1].hypot(impulse[2]) - rub).abs() < 1e-12, "{impulse:?}");
        let end = run.last().unwrap();
        let [before, after] = [momenta(m, r, &q, &z), momenta(m, r, &end.q, &end.z)];
        // Steps of tolerance 1e-11, momenta below 0.1.
        assert!((0..2).all(|k| (before[k] - after[k]).amax() < 1e-12), "{before:?} {after:?}");
        let lost = kernel.kinetic_energy(0.0, &q, &z) - kernel.kinetic_energy(0.2, &end.q, &end.z);
        assert!((lost - energy_lost).abs() < 1e-12, "{lost} {energy_lost}");
        // The second ball is left with the spin that friction gave it, along that of the first.
        let given = end.q.1.rotation * Vector3::new(end.z[9], end.z[10], end.z[11]);
        let expected = line.cross(&slip.normalize()) * -(r * rub / (0.4 * m * r * r));
        assert!((given - expected).amax() < 1e-9, "{given} {expected}");
    }
}

/// A force at the point of a contact, along its normal and tangents, has the generalised force that W gives it.
fn frames_work_as_rows<K>(kernel: &K, q: &K::Configuration, count: usize)
where
    K: ContactSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = SVector<f64, 6>>,
{
    let columns = kernel.contact_jacobian(0.0, q);
    let mut seen = 0;
    for (i, contact) in kernel.contacts().iter().enumerate() {
        let frame = kernel.contact_frame(i, 0.0, q).unwrap();
        let rows: Vec<f64> = contact.rows().map(|row| 0.7 - 0.4 * (row % 5) as f64).collect();
        let force = frame.force(&rows);
        // Of u and ω in body axes, with the pole at O.
        let arm = frame.point - q.translation.vector;
        let wrench = [force, arm.cross(&force)].map(|v| q.rotation.inverse() * v);
        let expected = contact.rows().zip(&rows).fold(SVector::<f64, 6>::zeros(), |sum, (row, force)| {
            sum + gauss_runtime::forces::Columns::nth(&columns, row).unwrap() * *force
        });
        let found = SVector::<f64, 6>::from_fn(|k, _| wrench[k / 3][k % 3]);
        // Products of numbers of order one, some tens of roundings.
        assert!((found - expected).amax() < 64.0 * f64::EPSILON, "{contact}: {found} {expected}");
        assert!((frame.normal.norm() - 1.0).abs() < 8.0 * f64::EPSILON);
        seen += 1;
    }
    assert_eq!(seen, count);
}

#[test]
fn frames_of_contacts_are_where_their_forces_act() {
    let rotation = UnitQuaternion::from_euler_angles(0.4, -0.3, 1.1);
    let pose = Isometry3::from_parts(Translation3::new(0.3, -0.2, 0.5), rotation);
    frames_work_as_rows(&Cargo { mu: 0.1 }.kernel().unwrap(), &pose, 8);
    let drum = Drum { r: 0.2, mu: 0.3, g: Vector3::new(0.0, 0.0, -G) };
    frames_work_as_rows(&drum.kernel().unwrap(), &pose, 2);

    // What a run gives: the box that rests is borne by its four lower corners.
    let kernel = Cargo { mu: 0.1 }.kernel().unwrap();
    let start = Isometry3::translation(1.0, 2.0, 0.2);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..0.1).unwrap();
    let vectors = run.forces(0.05).unwrap().vectors();
    assert_eq!(vectors.iter().map(|vector| vector.contact).collect::<Vec<_>>(), [0, 1, 2, 3]);
    for vector in vectors {
        assert!((vector.force - Vector3::new(0.0, 0.0, 0.5 * G)).amax() < 1e-12);
        let corner = (vector.point - Vector3::new(1.0, 2.0, 0.0)).abs();
        assert!((corner - Vector3::new(0.5, 0.3, 0.0)).amax() < 1e-12, "{corner}");
    }
}

/// Limits of a file: of a joint, of a tendon along a joint, and of a rope.
#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/limited.xml", limits = range)]
struct Limited;

#[test]
fn limits_of_a_file_are_stops() {
    let names: Vec<&str> = LimitedKernel::CONTACTS.iter().map(|contact| contact.name).collect();
    assert_eq!(names, ["elbow_from", "elbow_to", "reach_from", "reach_to", "rope_from", "rope_to"]);
    let kernel = Limited.kernel().unwrap();
    let q = SVector::from([0.1, 0.2, -0.05]);
    let ends = [-60.0_f64.to_radians(), 40.0_f64.to_radians()];
    // The rope is from 1 to 0.8 + drop.
    let gaps = [0.1 - ends[0], ends[1] - 0.1, 0.4 + 1.0, 1.2 - 0.4, 0.25, 0.7 - 0.25];
    assert!((kernel.gaps(0.0, &q) - SVector::from(gaps)).amax() < 1e-15);
    // Turns about the second axis lower what lies along the first one.
    let run =
        ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(SVector::zeros(), SVector::zeros(), 0.0..1.0).unwrap();
    let end = run.last().unwrap();
    assert_eq!(end.z.amax(), 0.0);
    let gaps = kernel.gaps(1.0, &end.q);
    assert!([1, 3, 5].iter().all(|&k| gaps[k].abs() < 1e-15), "{gaps}");
    // A moment of m g l cos q; half of it along a tendon that is 2 q; the weight.
    let held = [2.0 * 0.5 * G * ends[1].cos(), 0.5 * 0.3 * G * 0.6_f64.cos(), 3.0 * G];
    let forces = *run.forces(1.0).unwrap();
    assert!((0..3).all(|k| (forces[2 * k + 1] - held[k]).abs() < 1e-12 && forces[2 * k] == 0.0), "{forces} {held:?}");
}
