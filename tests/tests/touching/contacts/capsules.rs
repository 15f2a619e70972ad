//! Spheres against capsules: gap, place and rates beside many points of the axis, over its middle and over its ends.

use super::{laws, same};
use gauss_runtime::prelude::*;

/// Two free bodies: of the first a sphere about one of its points, of the second a capsule.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a: Pose, b: Pose),
    body(one, position = a.position, rotation = a.rotation, mass = 1.3, inertia = [0.02, 0.03, 0.04]),
    body(two, position = b.position, rotation = b.rotation, mass = 0.7, inertia = [0.05, 0.03, 0.04]),
    point(tip, body = one, at = [0.3, -0.2, 0.1]),
    point(knee, body = two, at = [-0.1, 0.4, 0.5]),
    point(ankle, body = two, at = [0.2, 0.1, -0.3]),
    contact(limb, point = tip, radius = r, other = knee, other_end = ankle, other_radius = s, along = [0, 1, 1],
            friction = 0.3),
    contact(joint, point = tip, radius = r, other = knee, other_radius = s, along = [0, 1, 1], friction = 0.3),
)]
struct Limb {
    r: f64,
    s: f64,
}

const ENDS: [[f64; 3]; 2] = [[-0.1, 0.4, 0.5], [0.2, 0.1, -0.3]];

/// The sphere beside the capsule: before its first end, over its middle, and behind its last end.
fn state(along: f64) -> ((Isometry3<f64>, Isometry3<f64>), SVector<f64, 12>) {
    let b = Isometry3::new(Vector3::new(0.4, -0.3, 0.8), Vector3::new(0.5, -0.2, 0.3));
    let turn = UnitQuaternion::from_euler_angles(0.2, -0.4, 0.7);
    let [first, last] = ENDS.map(|end| b.rotation * Vector3::from(end) + b.translation.vector);
    let aside = (last - first).cross(&Vector3::new(1.0, 0.5, -0.2)).normalize() * 0.5;
    let tip = first + (last - first) * along + aside;
    let place = tip - turn * Vector3::new(0.3, -0.2, 0.1);
    ((Isometry3::from_parts(place.into(), turn), b), SVector::from_fn(|i, _| (1.7 * i as f64 + 0.3).sin()))
}

#[test]
fn a_sphere_beside_the_nearest_point_of_an_axis() {
    let (r, s) = (0.05, 0.08);
    let kernel = Limb { r, s }.kernel().unwrap();
    for along in [-0.4, 0.3, 0.8, 1.6] {
        let (q, z) = state(along);
        let of = |pose: &Isometry3<f64>, at: [f64; 3]| pose.rotation * Vector3::from(at) + pose.translation.vector;
        let tip = of(&q.0, [0.3, -0.2, 0.1]);
        let [first, last] = ENDS.map(|end| of(&q.1, end));
        let nearest = first + (last - first) * along.clamp(0.0, 1.0);
        // No point of many of the axis is nearer.
        let points = (0..=1000).map(|k| (tip - first - (last - first) * (f64::from(k) / 1000.0)).norm());
        let distance = (tip - nearest).norm();
        assert!(points.fold(f64::INFINITY, f64::min) > distance - 1e-15);
        same(&[kernel.gaps(0.0, &q)[0]], &[distance - r - s]);
        let frame = kernel.contact_frame(0, 0.0, &q).unwrap();
        let normal = (tip - nearest) / distance;
        same(frame.normal.as_slice(), normal.as_slice());
        same(frame.point.as_slice(), (tip - normal * r).as_slice());
        // Velocities of the material points that touch, along normal and tangents.
        let at = |pose: &Isometry3<f64>, z: &[f64], point: Vector3<f64>| {
            let [u, w] = [0, 3].map(|k| pose.rotation * Vector3::from_column_slice(&z[k..k + 3]));
            u + w.cross(&(point - pose.translation.vector))
        };
        let own = at(&q.0, &z.as_slice()[..6], frame.point);
        let other = at(&q.1, &z.as_slice()[6..], nearest + normal * s);
        let tangents = frame.tangents();
        let rates = kernel.contact_rates(0.0, &q, &z);
        let expected = [normal, tangents[0], tangents[1]].map(|axis| axis.dot(&(own - other)));
        same(&rates.as_slice()[..3], &expected);
        assert!(frame.tangents()[0].dot(&Vector3::new(0.0, 1.0, 1.0)).abs() < 1e-15);
        // D, W and b of both, b against rates along the motion: the accelerations of the nearest point with it.
        laws(&kernel, &q, &z, &(), 0.0);
        // Before the first end it is a sphere about that.
        if along < 0.0 {
            same(&rates.as_slice()[..3], &rates.as_slice()[3..]);
            same(&[kernel.gaps(0.0, &q)[0]], &[kernel.gaps(0.0, &q)[1]]);
        }
    }
}
