//! Constraints that depend on one another: everywhere, as those of a table on four legs and of a door on three hinges,
//! or where the mechanism can be alone, as those of Bricard's. The motion is that of as many as are independent.

use gauss_runtime::constraint::ProjectionFailure;
use gauss_runtime::monitor::EnergyMonitor;
use gauss_runtime::prelude::*;

macro_rules! bricards {
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
            #[gauss(gravity)]
            g: Vector3<f64>,
        }

        impl $name {
            /// Rods of a metre and a kilogram.
            fn of_rods() -> Self {
                let rod = RigidBody {
                    mass: 1.0,
                    center_of_mass: Vector3::new(0.5, 0.0, 0.0),
                    inertia: Matrix3::from_diagonal(&Vector3::new(1e-4, 1.0 / 3.0, 1.0 / 3.0)),
                };
                Self { b1: rod, b2: rod, b3: rod, b4: rod, b5: rod, g: Vector3::new(2.0, -9.0, 3.0) }
            }
        }
    };
}

bricards!(
    /// Five rods and the ground in a loop of six hinges at right angles: five equations for five angles, of which one
    /// follows from the others wherever the loop is closed, and nowhere else.
    Bricard [
        coordinates(t1, t2, t3, t4, t5),
        body(b1, rotation = rotation_z(t1)),
        body(b2, parent = b1, position = [1, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(t2)),
        body(b3, parent = b2, position = [1, 0, 0], rotation = rotation_x(-pi / 2) * rotation_z(t3)),
        body(b4, parent = b3, position = [1, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(t4)),
        body(b5, parent = b4, position = [1, 0, 0], rotation = rotation_x(-pi / 2) * rotation_z(t5)),
        point(end, body = b5, at = [1, 0, 0]),
        constraint(position = end + [1, 0, 0]),
        constraint(position = dot(b5.rotation * [0, -1, 0], [1, 0, 0])),
        constraint(position = dot(b5.rotation * [0, -1, 0], [0, 0, 1])),
        redundant,
    ]
);

bricards!(
    /// Its motion in closed form: every other angle is s, and those between them have cos φ = −cos s/(1 + cos s).
    BricardByAngle [
        coordinates(s),
        define(phi = acos(-cos(s) / (1 + cos(s)))),
        body(b1, rotation = rotation_z(s)),
        body(b2, parent = b1, position = [1, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(phi)),
        body(b3, parent = b2, position = [1, 0, 0], rotation = rotation_x(-pi / 2) * rotation_z(s)),
        body(b4, parent = b3, position = [1, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(phi)),
        body(b5, parent = b4, position = [1, 0, 0], rotation = rotation_x(-pi / 2) * rotation_z(s)),
    ]
);

fn bricard_at(t: f64, rate: f64) -> (SVector<f64, 5>, SVector<f64, 5>) {
    let (s, c) = t.sin_cos();
    let cosine = -c / (1.0 + c);
    // −sin φ φ̇ = sin t ṫ/(1 + cos t)².
    let slope = -s / ((1.0 + c).powi(2) * (1.0 - cosine * cosine).sqrt());
    let phi = cosine.acos();
    (SVector::from([t, phi, t, phi, t]), SVector::from([1.0, slope, 1.0, slope, 1.0]) * rate)
}

#[test]
fn bricards_mechanism_moves_as_in_closed_form() {
    let (kernel, by_angle) = (Bricard::of_rods().kernel().unwrap(), BricardByAngle::of_rods().kernel().unwrap());
    // Accelerations at states all along the motion: κ of five rows near one another, and roundings of some hundred
    // terms.
    for (t, rate) in [(1.2, 0.0), (0.5, 1.3), (1.57, -2.0), (1.9, 0.7), (0.1, -0.4)] {
        let (q, z) = bricard_at(t, rate);
        let found = kernel.acceleration(0.0, &q, &z, &());
        let expected = by_angle.acceleration(0.0, &SVector::from([t]), &SVector::from([rate]), &())[0];
        let error = (found[0] - expected).abs();
        assert!(error <= 1e-11 * found.amax().max(1.0), "{t}: {found} {expected}");
        assert!(kernel.multipliers(0.0, &q, &z, &()).amax().is_finite());
    }
    let (q, z) = bricard_at(1.2, 0.0);
    let (mut open, mut monitor) = (0.0_f64, EnergyMonitor::new());
    let end = Simulation::new(&kernel)
        .adaptive(1e-11, 1e-11)
        .observe(|sample| {
            open = open.max(kernel.position_residual(sample.t, &sample.q).amax());
            monitor.watch(&kernel, sample);
        })
        .run_to_end(q, z, 0.0..0.5)
        .unwrap();
    let start = (SVector::from([1.2]), SVector::from([0.0]));
    let expected = Simulation::new(&by_angle).adaptive(1e-12, 1e-12).run_to_end(start.0, start.1, 0.0..0.5).unwrap();
    assert!((end.q[0] - expected.q[0]).abs() <= 1e-9, "{} {}", end.q, expected.q);
    assert!((end.q[0] - 1.2).abs() > 0.1, "it moves: {}", end.q);
    assert!(open <= 64.0 * f64::EPSILON, "{open:e}");
    assert!(monitor.energy.largest() <= 1e-9 * kernel.kinetic_energy(0.0, &end.q, &end.z).max(1.0), "{monitor}");
}

/// A table on four legs that cannot leave the ground.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(top, position = pose.position, rotation = pose.rotation, mass = m, inertia = [ix, iy, iz]),
    point(leg1, body = top, at = [a, b, -h]),
    point(leg2, body = top, at = [-a, b, -h]),
    point(leg3, body = top, at = [-a, -b, -h]),
    point(leg4, body = top, at = [a, -b, -h]),
    point(load, body = top, at = [x, y, 0]),
    constraint(position = dot(leg1, [0, 0, 1])),
    constraint(position = dot(leg2, [0, 0, 1])),
    constraint(position = dot(leg3, [0, 0, 1])),
    constraint(position = dot(leg4, [0, 0, 1])),
    force(value = [0, 0, -w], at = load),
    redundant,
)]
struct Table {
    m: f64,
    ix: f64,
    iy: f64,
    iz: f64,
    a: f64,
    b: f64,
    h: f64,
    x: f64,
    y: f64,
    w: f64,
    #[gauss(gravity)]
    g: f64,
}

/// By symmetry the four weights of the norm are equal. Forces without a resultant are multiples of (1, −1, 1, −1), and
/// the least ones have none of it: `N = (m g + W)/4 + W x/(4 a) ± …`.
#[test]
fn a_table_on_four_legs_shares_its_load() {
    let (m, a, b, x, y, w, g) = (12.0, 0.6, 0.4, 0.2, -0.1, 150.0, 9.81);
    let table = Table { m, ix: 1.0, iy: 1.7, iz: 2.4, a, b, h: 0.7, x, y, w, g };
    let kernel = table.kernel().unwrap();
    let pose = Isometry3::translation(0.3, -0.2, 0.7);
    let (q, z) = kernel.project(0.0, &pose, &SVector::zeros()).unwrap();
    let (along, across) = (w * x / (4.0 * a), w * y / (4.0 * b));
    let signs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let found = kernel.multipliers(0.0, &q, &z, &());
    for (force, [i, j]) in found.iter().zip(signs) {
        let expected = (m * g + w) / 4.0 + i * along + j * across;
        assert!((force - expected).abs() <= 1e-12 * expected, "{force} {expected}");
    }
    assert!(kernel.acceleration(0.0, &q, &z, &()).amax() <= 1e-12 * g);
    // It slides and spins over the ground and does not leave it.
    let z = SVector::from([0.5, -0.3, 0.0, 0.0, 0.0, 2.0]);
    let end = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run_to_end(q, z, 0.0..2.0).unwrap();
    assert!((end.q.translation.vector[2] - 0.7).abs() <= 8.0 * f64::EPSILON);
    assert!((end.z[5] - 2.0).abs() <= 1e-12);
}

/// A table with a leg of its own length: on a flat floor it does not stand on all four.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(top, position = pose.position, rotation = pose.rotation, mass = m, inertia = [i, i, i]),
    point(leg1, body = top, at = [a, a, -h]),
    point(leg2, body = top, at = [-a, a, -h]),
    point(leg3, body = top, at = [-a, -a, -h]),
    point(leg4, body = top, at = [a, -a, -last]),
    constraint(position = w * dot(leg1, [0, 0, 1])),
    constraint(position = w * dot(leg2, [0, 0, 1])),
    constraint(position = w * dot(leg3, [0, 0, 1])),
    constraint(position = w * dot(leg4, [0, 0, 1])),
    redundant,
)]
struct Uneven {
    m: f64,
    i: f64,
    a: f64,
    h: f64,
    last: f64,
    w: f64,
}

/// A constraint that depends on others is not looked at where the motion is formed, and one that contradicts them is no
/// rounding: the projection says so, in any unit.
#[test]
fn constraints_that_contradict_each_other_are_refused() {
    for w in [1.0, 1e-9, 1e9] {
        let project = |last: f64| {
            let kernel = Uneven { m: 1.0, i: 1.0, a: 0.5, h: 0.7, last, w }.kernel().unwrap();
            kernel.project(0.0, &Isometry3::translation(0.1, -0.2, 0.7), &SVector::zeros()).map(|_| ())
        };
        assert_eq!(project(0.7), Ok(()));
        assert_eq!(project(0.7 + 1e-15), Ok(()));
        for off in [1e-6, 1e-3, -0.1] {
            let error = project(0.7 + off).expect_err("three legs alone");
            assert_eq!(error.failure, ProjectionFailure::NotConverged, "{w:e} {off:e}: {error}");
            assert!(error.to_string().contains("contradict"), "{error}");
        }
    }
}

/// Bars of 1 m and bearings 2 m apart, flat at zero angles, where the constraints depend on one another.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, c),
    body(crank, rotation = rotation_z(a), mass = 1, inertia = 1),
    body(coupler, position = [cos(a), sin(a), 0], rotation = rotation_z(b), mass = 1, inertia = 1),
    body(rocker, position = [2, 0, 0], rotation = rotation_z(c), mass = 1, inertia = 1),
    point(end, body = coupler, at = [2, 0, 0]),
    point(tip, body = rocker, at = [1, 0, 0]),
    constraint(position = end - tip),
    redundant,
)]
struct Flat {}

#[test]
fn the_projection_finds_its_way_next_to_where_rows_change() {
    let kernel = Flat {}.kernel().unwrap();
    for power in 1..12 {
        for off in [1e-3, 1e-6, 1e-9] {
            let a = 10.0_f64.powi(-power);
            let (q, z) = (SVector::from([a, 0.3 * off, a + off]), SVector::from([1.0, 0.1, 1.1]));
            let (q, z) = kernel.project(0.0, &q, &z).unwrap_or_else(|error| panic!("{a:e} {off:e}: {error}"));
            // Roundings of lengths up to 2, and of speeds of that size.
            assert!(kernel.position_residual(0.0, &q).amax() <= 4.0 * f64::EPSILON, "{a:e} {off:e}: {q}");
            assert!(kernel.velocity_residual(0.0, &q, &z).amax() <= 8.0 * f64::EPSILON, "{a:e} {off:e}: {z}");
        }
    }
}

/// A door on three hinges, each of which holds a point.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(door, position = pose.position, rotation = pose.rotation),
    point(low, body = door, at = [0, 0, 0.2]),
    point(middle, body = door, at = [0, 0, 1]),
    point(high, body = door, at = [0, 0, 1.9]),
    constraint(position = low - [0, 0, 0.2]),
    constraint(position = middle - [0, 0, 1]),
    constraint(position = high - [0, 0, 1.9]),
    redundant,
)]
struct Door {
    #[gauss(body)]
    door: RigidBody<f64>,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// The same with an angle.
#[derive(GaussDynamics)]
#[gauss(coordinates(angle), body(door, rotation = rotation_z(angle)))]
struct DoorByAngle {
    #[gauss(body)]
    door: RigidBody<f64>,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn a_door_on_three_hinges_swings_as_about_an_axle() {
    let door = RigidBody {
        mass: 30.0,
        center_of_mass: Vector3::new(0.45, 0.02, 1.1),
        inertia: Matrix3::new(45.0, -0.2, -15.0, -0.2, 50.0, -0.6, -15.0, -0.6, 9.0),
    };
    let g = Vector3::new(-0.8, 0.3, -9.7);
    let (kernel, by_angle) = (Door { door, g }.kernel().unwrap(), DoorByAngle { door, g }.kernel().unwrap());
    let (angle, rate) = (0.7, 1.5);
    let pose = Isometry3::rotation(Vector3::z() * angle);
    let (q, z) = (pose, SVector::from([0.0, 0.0, 0.0, 0.0, 0.0, rate]));
    let expected = by_angle.acceleration(0.0, &SVector::from([angle]), &SVector::from([rate]), &())[0];
    let found = kernel.acceleration(0.0, &q, &z, &());
    assert!((found[5] - expected).abs() <= 1e-11 * expected.abs().max(1.0), "{found} {expected}");
    // Multipliers are the forces that hold it: in the directions of the observer, all of them together m (a_C − g).
    let forces = kernel.multipliers(0.0, &q, &z, &());
    let sum = Vector3::from_fn(|k, _| forces[k] + forces[3 + k] + forces[6 + k]);
    let spin = Vector3::z() * rate;
    let arm = pose.rotation * door.center_of_mass;
    let acceleration = Vector3::z().cross(&arm) * expected + spin.cross(&spin.cross(&arm));
    let needed = (acceleration - g) * door.mass;
    assert!((sum - needed).amax() <= 1e-10 * needed.amax(), "{sum} {needed}");
    // None of the three goes without.
    assert!((0..3).all(|hinge| forces[3 * hinge + 2].abs() > 0.1 * needed[2].abs()), "{forces}");
    let end = Simulation::new(&kernel).adaptive(1e-10, 1e-10).run_to_end(q, z, 0.0..3.0).unwrap();
    let other = Simulation::new(&by_angle)
        .adaptive(1e-11, 1e-11)
        .run_to_end(SVector::from([angle]), SVector::from([rate]), 0.0..3.0)
        .unwrap();
    let turned = end.q.rotation.inverse() * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), other.q[0]);
    assert!(turned.angle() <= 1e-8, "{} {}", end.q, other.q);
    assert!(kernel.position_residual(0.0, &end.q).amax() <= 64.0 * f64::EPSILON);
}
