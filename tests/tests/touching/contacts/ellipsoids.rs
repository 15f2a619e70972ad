//! Ellipsoids against planes: gap, touching point and rates, beside spheres and beside points of the surface.

use super::{ball, laws, same};
use gauss_runtime::prelude::*;

const HEIGHT: f64 = -0.4;

/// A body in a chart, or by coordinates of its own, with an ellipsoid about one of its points, an ellipsoid that is
/// a sphere, and this sphere.
macro_rules! stones {
    ($($name:ident: $body:ident [$($clause:tt)+];)+) => {$(
        #[derive(GaussDynamics)]
        #[gauss(
            $($clause)+,
            point(middle, body = $body, at = [0.1, 0.2, -0.3]),
            contact(egg, point = middle, semi_axes = [a, 2 * a, 0.5], plane = [1, 2, 2], height = h * t, friction = 0.5),
            contact(round, point = middle, semi_axes = [a, a, a], plane = [0, 3, 4], height = h, friction = 0.4),
            contact(ball, point = middle, radius = a, plane = [0, 3, 4], height = h, friction = 0.4),
        )]
        struct $name {
            m: f64,
            c: Vector3<f64>,
            i: Vector3<f64>,
            a: f64,
            h: f64,
        }

        impl $name {
            fn with(a: f64) -> Self {
                let data = ball().ball;
                Self { m: data.mass, c: data.center_of_mass, i: data.inertia.diagonal(), a, h: HEIGHT }
            }
        }
    )+};
}

stones! {
    InChart: body [chart = hybrid, mass = m, center_of_mass = c, inertia = i];
    ByPose: stone [
        coordinates(pose: Pose),
        body(stone, position = pose.position, rotation = pose.rotation, mass = m, center_of_mass = c, inertia = i)
    ];
}

const A: f64 = 0.7;
const T: f64 = 0.3;

fn state() -> (Isometry3<f64>, SVector<f64, 6>) {
    let pose = Isometry3::new(Vector3::new(0.4, -0.3, 0.8), Vector3::new(0.5, -0.2, 0.3));
    (pose, SVector::from([0.3, -0.2, 0.5, 1.0, -0.7, 0.4]))
}

/// Points of the ellipsoid, by the observer: on lines of latitude and longitude.
fn surface(pose: &Isometry3<f64>, semi_axes: [f64; 3], count: i32) -> impl Iterator<Item = Vector3<f64>> {
    let (middle, semi_axes) = (Vector3::new(0.1, 0.2, -0.3), Vector3::from(semi_axes));
    let angle = move |k: i32| std::f64::consts::PI * f64::from(k) / f64::from(count);
    let place = pose.translation.vector;
    let rotation = pose.rotation;
    (0..=count).flat_map(move |i| (0..2 * count).map(move |j| (angle(i), angle(j)))).map(move |(polar, around)| {
        let unit = Vector3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos());
        rotation * (middle + semi_axes.component_mul(&unit)) + place
    })
}

#[test]
fn the_lowest_point_of_an_ellipsoid() {
    let (kernel, (q, z)) = (ByPose::with(A).kernel().unwrap(), state());
    let normal = Vector3::new(1.0, 2.0, 2.0) / 3.0;
    let frame = kernel.contact_frame(0, T, &q).unwrap();
    assert!((frame.normal - normal).norm() < 1e-15);
    // On the surface, as far from the plane as the gap says.
    let local =
        (q.inverse() * gauss_runtime::nalgebra::Point3::from(frame.point)).coords - Vector3::new(0.1, 0.2, -0.3);
    same(&[local.component_div(&Vector3::new(A, 2.0 * A, 0.5)).norm()], &[1.0]);
    same(&[kernel.gaps(T, &q)[0]], &[normal.dot(&frame.point) - HEIGHT * T]);
    // No point of the surface is lower, and the nearest of many is higher by no more than half a step of both angles
    // squared times the largest semi-axis.
    let count = 1000;
    let lowest = surface(&q, [A, 2.0 * A, 0.5], count).map(|point| normal.dot(&point)).fold(f64::INFINITY, f64::min);
    let off = lowest - normal.dot(&frame.point);
    let step = std::f64::consts::PI / f64::from(count);
    assert!((-1e-15..2.0 * A * step * step / 4.0).contains(&off), "{off}");
    // Rates are those of the material point that touches; the plane moves along its normal.
    let (u, w) = (q.rotation * z.fixed_rows::<3>(0), q.rotation * z.fixed_rows::<3>(3));
    let velocity = u + w.cross(&(frame.point - q.translation.vector)) - normal * HEIGHT;
    let rates = kernel.contact_rates(T, &q, &z);
    let tangents = frame.tangents();
    same(&rates.as_slice()[..3], &[normal, tangents[0], tangents[1]].map(|axis| axis.dot(&velocity)));
    laws(&kernel, &q, &z, &(), T);
}

#[test]
fn equal_semi_axes_are_a_sphere() {
    let (kernel, (q, z)) = (ByPose::with(A).kernel().unwrap(), state());
    let (gaps, rates) = (kernel.gaps(T, &q), kernel.contact_rates(T, &q, &z));
    same(&[gaps[1]], &[gaps[2]]);
    same(&rates.as_slice()[3..6], &rates.as_slice()[6..9]);
    let [round, ball] = [1, 2].map(|contact| kernel.contact_frame(contact, T, &q).unwrap());
    same((round.point - ball.point).as_slice(), &[0.0; 3]);
    assert!(round.normal == ball.normal && round.tangents() == ball.tangents());
}

#[test]
fn an_ellipsoid_in_two_charts() {
    let (pose, chart) = (ByPose::with(A).kernel().unwrap(), InChart::with(A).kernel().unwrap());
    let (q, twist) = state();
    let known = laws(&pose, &q, &twist, &(), T);
    let z = chart.speeds(T, &q, &twist);
    let found = laws(&chart, &q, &z, &(), T);
    same(&found.0, &known.0);
    same(&found.1, &known.1);
    same(&found.2, &known.2);
    same(chart.gaps(T, &q).as_slice(), pose.gaps(T, &q).as_slice());
}

#[test]
fn semi_axes_are_lengths() {
    for wrong in [0.0, -0.7, 1e-200] {
        let error = ByPose::with(wrong).kernel().unwrap_err().to_string();
        assert!(error.contains("a semi-axis of an ellipsoid is greater than 0"), "{error}");
    }
}
