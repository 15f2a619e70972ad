//! Boxes, capsules, cylinders, grounds and spheres that rub: gaps and rates against their geometry.

use super::{ball, laws, same};
use gauss_runtime::contact::Contact;
use gauss_runtime::prelude::*;

/// Two free bodies: of the first a capsule, a cylinder, a sphere and a point.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a: Pose, b: Pose),
    body(one, position = a.position, rotation = a.rotation),
    body(two, position = b.position, rotation = b.rotation),
    point(knee, body = one, at = [0.3, -0.2, 0.1]),
    point(toe, body = one, at = [-0.1, 0.4, 0.5]),
    contact(shin, point = knee, end = toe, radius = r, plane = [1, 2, 2], height = 0.3 * t, friction = 0.5),
    contact(drum, point = toe, rim = 2 * r, axis = [1, 0, 1], length = s, friction = 0.4),
    contact(pair, point = knee, radius = r, other = two.position, other_radius = s, along = [0, 1, 1], friction = 0.3),
    contact(hill, point = knee, height = 0.2 * sin(2 * x) * cos(y) + 0.1 * t * x, over = [x, y], friction = 0.2),
)]
struct Two {
    #[gauss(body)]
    one: RigidBody<f64>,
    #[gauss(body)]
    two: RigidBody<f64>,
    r: f64,
    s: f64,
}

/// A box in a chart, or by coordinates of its own.
macro_rules! boxes {
    ($($name:ident: $body:ident [$($clause:tt)+];)+) => {$(
        #[derive(GaussDynamics)]
        #[gauss(
            $($clause)+,
            point(middle, body = $body, at = [0.1, 0.2, -0.3]),
            contact(case, point = middle, edges = [a, 2 * a, 0.5], plane = [0, 3, 4], height = -1, friction = 0.5),
            contact(hill, point = middle, height = 0.3 * x * x, over = x, friction = 0.4),
        )]
        struct $name {
            m: f64,
            c: Vector3<f64>,
            i: Vector3<f64>,
            a: f64,
        }

        impl $name {
            fn sample() -> Self {
                let data = ball().ball;
                Self { m: data.mass, c: data.center_of_mass, i: data.inertia.diagonal(), a: 0.7 }
            }
        }
    )+};
}

boxes! {
    InChart: body [chart = hybrid, mass = m, center_of_mass = c, inertia = i];
    ByPose: cargo [
        coordinates(pose: Pose),
        body(cargo, position = pose.position, rotation = pose.rotation, mass = m, center_of_mass = c, inertia = i)
    ];
}

/// What a collision library says of one contact.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.3, 0.4, 0.5]),
    point(nearest, body = hull, at = at),
    contact(found, point = nearest, plane = normal, height = height, along = along, friction = 0.5),
)]
struct Found {
    at: Vector3<f64>,
    normal: Vector3<f64>,
    height: f64,
    along: Vector3<f64>,
}

/// A body as it moves: its pose, u and ω in its axes.
struct Moving {
    pose: Isometry3<f64>,
    u: Vector3<f64>,
    w: Vector3<f64>,
}

impl Moving {
    fn place(&self, at: [f64; 3]) -> Vector3<f64> {
        self.pose.rotation * Vector3::from(at) + self.pose.translation.vector
    }

    /// Of the material point that is at a place.
    fn velocity(&self, place: Vector3<f64>) -> Vector3<f64> {
        self.pose.rotation * self.u + (self.pose.rotation * self.w).cross(&(place - self.pose.translation.vector))
    }
}

fn one() -> Moving {
    let pose = Isometry3::new(Vector3::new(0.4, -0.3, 0.8), Vector3::new(0.5, -0.2, 0.3));
    Moving { pose, u: Vector3::new(0.3, -0.2, 0.5), w: Vector3::new(1.0, -0.7, 0.4) }
}

fn two() -> Moving {
    let pose = Isometry3::new(Vector3::new(-0.2, 0.7, 1.9), Vector3::new(-0.1, 0.6, 0.2));
    Moving { pose, u: Vector3::new(-0.4, 0.1, 0.2), w: Vector3::new(0.3, 0.8, -0.6) }
}

const R: f64 = 0.15;
const S: f64 = 0.35;
const T: f64 = 0.4;

type Both = ((Isometry3<f64>, Isometry3<f64>), SVector<f64, 12>);

fn state(one: &Moving, two: &Moving) -> Both {
    let z = [one.u, one.w, two.u, two.w];
    ((one.pose, two.pose), SVector::from_fn(|k, _| z[k / 3][k % 3]))
}

fn kernel() -> TwoKernel {
    Two { one: ball().ball, two: ball().ball, r: R, s: S }.kernel().unwrap()
}

/// The rate of a gap and the size of the slip, from the velocity of what touches relative to what it touches.
fn rubs(rates: &[f64], normal: Vector3<f64>, velocity: Vector3<f64>) {
    let along = normal.dot(&velocity);
    same(&[rates[0], rates[1].hypot(rates[2])], &[along, (velocity - normal * along).norm()]);
}

#[test]
fn a_list_of_parts() {
    let names = ["shin_0", "shin_1", "drum_0", "drum_1", "pair", "hill"].into_iter().enumerate();
    let touched = |name: &str| if name == "pair" { Some("two") } else { None };
    // What the shin and the hill may touch rises with the time.
    let rising =
        |name: &str, contact: Contact| if "shin_0 shin_1 hill".contains(name) { contact.moving() } else { contact };
    let contact = |(k, name)| rising(name, Contact::new(name, 3 * k, 2).between([Some("one"), touched(name)]));
    let all: Vec<Contact> = names.map(contact).collect();
    assert_eq!(TwoKernel::CONTACTS, all);
    assert_eq!(ByPoseKernel::CONTACTS[7], Contact::new("case_7", 21, 2).between([Some("cargo"), None]));
}

#[test]
fn a_capsule_and_a_cylinder() {
    let (kernel, one) = (kernel(), one());
    let (q, z) = state(&one, &two());
    let (gaps, rates) = (kernel.gaps(T, &q), kernel.contact_rates(T, &q, &z));
    laws(&kernel, &q, &z, &(), T);
    let normal = Vector3::new(1.0, 2.0, 2.0) / 3.0;
    let ends = [one.place([0.3, -0.2, 0.1]), one.place([-0.1, 0.4, 0.5])];
    for (k, end) in ends.iter().enumerate() {
        same(&[gaps[k]], &[normal.dot(end) - 0.3 * T - R]);
        // The plane rises along its normal.
        let velocity = one.velocity(end - R * normal) - 0.3 * normal;
        rubs(&rates.as_slice()[3 * k..], normal, velocity);
    }
    // The nearest of many points of two circles: each lower by at most r Δ²/8.
    let axis = Vector3::new(1.0, 0.0, 1.0).normalize();
    let count = 20_000;
    for (k, side) in [-0.5, 0.5].into_iter().enumerate() {
        let middle = Vector3::new(-0.1, 0.4, 0.5) + side * S * axis;
        let rim = (0..count).map(|k| {
            let (sine, cosine) = (f64::from(k) / f64::from(count) * std::f64::consts::TAU).sin_cos();
            let across = Vector3::y() * cosine + axis.cross(&Vector3::y()) * sine;
            one.place((middle + 2.0 * R * across).into())
        });
        let lowest = rim.min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
        let coarse = 2.0 * R * (std::f64::consts::TAU / f64::from(count)).powi(2) / 8.0;
        assert!((gaps[2 + k]..gaps[2 + k] + coarse + 1e-14).contains(&(lowest.z + 1e-15)), "{lowest} {}", gaps[2 + k]);
        let sized = [rates[6 + 3 * k], rates[7 + 3 * k].hypot(rates[8 + 3 * k])];
        let velocity = one.velocity(lowest);
        // That point is off by half a step of the angle.
        let off = 2.0 * R * std::f64::consts::TAU / f64::from(count) * one.w.norm();
        assert!((sized[0] - velocity.z).abs() < off && (sized[1] - velocity.xy().norm()).abs() < off);
    }
}

#[test]
fn two_spheres_that_rub() {
    let (kernel, one, two) = (kernel(), one(), two());
    let (q, z) = state(&one, &two);
    let knee = one.place([0.3, -0.2, 0.1]);
    let apart = knee - two.pose.translation.vector;
    let normal = apart.normalize();
    same(&[kernel.gaps(T, &q)[4]], &[apart.norm() - R - S]);
    let rates = kernel.contact_rates(T, &q, &z);
    let velocity = one.velocity(knee - R * normal) - two.velocity(two.pose.translation.vector + S * normal);
    rubs(&rates.as_slice()[12..15], normal, velocity);
    // The first tangent is normal to `along`.
    let first = Vector3::new(0.0, 1.0, 1.0).cross(&normal).normalize();
    same(&[rates[13], rates[14]], &[first.dot(&velocity), normal.cross(&first).dot(&velocity)]);
    // Equal and opposite: neither linear momentum nor that about Ω changes, of spheres that touch.
    let touching = Moving { pose: Isometry3::from_parts((knee - (R + S) * normal).into(), two.pose.rotation), ..two };
    let (q, _) = state(&one, &touching);
    let wrenches = kernel.contact_jacobian(T, &q);
    for row in 12..15 {
        let force = |at: usize, body: &Moving| {
            let part =
                |k| Vector3::new(wrenches[(at + k, row)], wrenches[(at + k + 1, row)], wrenches[(at + k + 2, row)]);
            let (force, torque) = (body.pose.rotation * part(0), body.pose.rotation * part(3));
            (force, torque + body.pose.translation.vector.cross(&force))
        };
        let (a, b) = (force(0, &one), force(6, &touching));
        assert!((a.0 + b.0).amax() < 1e-14 && (a.1 + b.1).amax() < 1e-14, "{a:?} {b:?}");
    }
    let parallel = Two { one: ball().ball, two: ball().ball, r: -R, s: S }.kernel().unwrap_err().to_string();
    assert!(parallel.contains("`r` is -0.15"), "{parallel}");
}

#[test]
fn a_point_over_a_ground() {
    let (kernel, one) = (kernel(), one());
    let (q, z) = state(&one, &two());
    let height = |x: f64, y: f64| 0.2 * (2.0 * x).sin() * y.cos() + 0.1 * T * x;
    let foot = one.place([0.3, -0.2, 0.1]);
    let (x, y) = (foot.x, foot.y);
    let slope = Vector3::new(0.4 * (2.0 * x).cos() * y.cos() + 0.1 * T, -0.2 * (2.0 * x).sin() * y.sin(), 0.0);
    let normal = (Vector3::z() - slope).normalize();
    same(&[kernel.gaps(T, &q)[5]], &[(foot.z - height(x, y)) * normal.z]);
    // Onto the ground, and above it by d: the nearest of many points of it is at d up to d², as curvature has it.
    let lower = |d: f64| {
        let down = Translation3::new(0.0, 0.0, height(x, y) + d / normal.z - foot.z);
        Moving { pose: down * one.pose, ..one }
    };
    assert!(kernel.gaps(T, &state(&lower(0.0), &two()).0)[5].abs() < 1e-15);
    let d = 1e-3;
    let place = lower(d).place([0.3, -0.2, 0.1]);
    let near = |i: i32, j: i32| {
        let (x, y) = (x + 5e-6 * f64::from(i), y + 5e-6 * f64::from(j));
        (Vector3::new(x, y, height(x, y)) - place).norm()
    };
    let nearest = (-200..=200).flat_map(|i| (-200..=200).map(move |j| (i, j))).map(|(i, j)| near(i, j));
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    let gap = kernel.gaps(T, &state(&lower(d), &two()).0)[5];
    assert!((gap - d).abs() < 1e-15 && (nearest - d).abs() < d * d, "{gap} {nearest}");
    // On the ground, rates are those of the material point; the ground rises by 0.1 x.
    let down = lower(0.0);
    let (q, _) = state(&down, &two());
    let velocity = down.velocity(down.place([0.3, -0.2, 0.1])) - Vector3::z() * 0.1 * x;
    let rates = kernel.contact_rates(T, &q, &z);
    rubs(&rates.as_slice()[15..], normal, velocity);
    laws(&kernel, &q, &z, &(), T);
}

#[test]
fn a_box_in_two_charts() {
    let (pose, chart) = (ByPose::sample().kernel().unwrap(), InChart::sample().kernel().unwrap());
    let body = one();
    let normal = Vector3::new(0.0, 0.6, 0.8);
    let twist = SVector::from_fn(|k, _| [body.u, body.w][k / 3][k % 3]);
    let (gaps, rates) = (pose.gaps(0.0, &body.pose), pose.contact_rates(0.0, &body.pose, &twist));
    for k in 0..8 {
        let sign = |bit: usize| if k >> bit & 1 == 0 { -0.5 } else { 0.5 };
        let corner = body.place([0.1 + 0.7 * sign(0), 0.2 + 1.4 * sign(1), -0.3 + 0.5 * sign(2)]);
        same(&[gaps[k]], &[normal.dot(&corner) + 1.0]);
        rubs(&rates.as_slice()[3 * k..], normal, body.velocity(corner));
    }
    let place = body.place([0.1, 0.2, -0.3]);
    same(&[gaps[8]], &[(place.z - 0.3 * place.x * place.x) / 1.0_f64.hypot(0.6 * place.x)]);
    let known = laws(&pose, &body.pose, &twist, &(), 0.0);
    let z = chart.speeds(0.0, &body.pose, &twist);
    let found = laws(&chart, &body.pose, &z, &(), 0.0);
    same(&found.0, &known.0);
    same(&found.1, &known.1);
    same(&found.2, &known.2);
    same(chart.gaps(0.0, &body.pose).as_slice(), gaps.as_slice());
}

#[test]
fn points_and_normals_at_run_time() {
    let body = one();
    let twist = SVector::from_fn(|k, _| [body.u, body.w][k / 3][k % 3]);
    let answers = [([0.2, -0.1, 0.4], Vector3::new(0.3, -0.5, 0.8)), ([-0.3, 0.6, 0.1], Vector3::new(-1.0, 0.2, 0.1))];
    for (at, normal) in answers {
        let (at, normal) = (Vector3::from(at), normal.normalize());
        let found = body.place(at.into());
        // Any direction that is not the normal's.
        let along = normal.map(f64::abs);
        let along = Vector3::new(along.y, along.z, -along.x);
        let kernel = Found { at, normal, height: normal.dot(&found) - 0.01, along }.kernel().unwrap();
        same(kernel.gaps(0.0, &body.pose).as_slice(), &[0.01]);
        rubs(kernel.contact_rates(0.0, &body.pose, &twist).as_slice(), normal, body.velocity(found));
        laws(&kernel, &body.pose, &twist, &(), 0.0);
    }
}
