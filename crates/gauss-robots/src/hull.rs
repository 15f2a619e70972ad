//! The convex hull of points.

use super::rotation::Triple;

/// Points against faces that are looked at.
const MOST_TESTS: usize = 100_000_000;

/// What is in front of a face by less, as part of the size of all, is taken as in its plane.
const FLAT: f64 = 1e-10;

/// Faces around all points, counter-clockwise as seen from outside: points are added one by one, each in place of the
/// faces that it is in front of. `None` of points in a plane, and of more than can be looked at.
pub fn hull(points: &[Triple]) -> Option<Vec<[usize; 3]>> {
    let size = points.iter().flatten().fold(0.0, |size: f64, c| size.max(c.abs()));
    let mut faces = first(points, FLAT * size)?;
    let mut tests = 0;
    for point in 0..points.len() {
        tests += faces.len();
        if tests > MOST_TESTS {
            return None;
        }
        let (before, behind): (Vec<[usize; 3]>, Vec<[usize; 3]>) =
            faces.iter().partition(|&&face| height(points, face, point) > FLAT * size);
        if before.is_empty() {
            continue;
        }
        // Edges between both: those of the first kind that no other of them has the other way around.
        let edges: Vec<[usize; 2]> = before.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let rim = edges.iter().filter(|&&[a, b]| !edges.contains(&[b, a])).map(|&[a, b]| [a, b, point]);
        faces = behind.into_iter().chain(rim).collect();
    }
    Some(faces)
}

/// Four points that are far from each other.
fn first(points: &[Triple], flat: f64) -> Option<Vec<[usize; 3]>> {
    let farthest = |measure: &dyn Fn(usize) -> f64| {
        (0..points.len()).max_by(|&a, &b| measure(a).total_cmp(&measure(b))).filter(|&best| measure(best) > flat)
    };
    let a = 0;
    let b = farthest(&|k| length(&minus(&points[k], points.first().unwrap_or(&[0.0; 3]))))?;
    let along = minus(&points[b], &points[a]);
    let c = farthest(&|k| length(&cross(&along, &minus(&points[k], &points[a]))) / length(&along))?;
    let d = farthest(&|k| height(points, [a, b, c], k).abs())?;
    let [b, c] = if height(points, [a, b, c], d) > 0.0 { [c, b] } else { [b, c] };
    Some(vec![[a, b, c], [a, c, d], [c, b, d], [b, a, d]])
}

/// How far a point is in front of a face.
fn height(points: &[Triple], [a, b, c]: [usize; 3], point: usize) -> f64 {
    let from = |k: usize| minus(&points[k], &points[a]);
    let normal = cross(&from(b), &from(c));
    let over = from(point);
    let length = length(&normal);
    if length > 0.0 { (0..3).map(|i| normal[i] * over[i]).sum::<f64>() / length } else { 0.0 }
}

fn minus(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| a[i] - b[i])
}

fn cross(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn length(a: &Triple) -> f64 {
    a.iter().map(|c| c * c).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Mesh, Rule};

    fn volume(points: Vec<Triple>) -> Option<f64> {
        let faces = hull(&points)?;
        let mesh = Mesh { vertices: points, faces };
        assert!(mesh.is_convex(), "{mesh:?}");
        mesh.inertial(Rule::Exact).ok().map(|own| own.mass)
    }

    /// Corners of a box, with points inside, in faces and on edges.
    #[test]
    fn boxes() {
        let grid =
            |n: i32| (0..(n + 1).pow(3)).map(move |k| [k % (n + 1), k / (n + 1) % (n + 1), k / (n + 1) / (n + 1)]);
        for n in 1..5 {
            let points: Vec<Triple> =
                grid(n).map(|p| [0, 1, 2].map(|i| f64::from(p[i]) * [0.1, 0.3, 0.7][i])).collect();
            let expected = f64::from(n).powi(3) * 0.021;
            let found = volume(points).expect("a hull");
            // What is taken as flat, on each of six sides.
            assert!((found / expected - 1.0).abs() < 1e-8, "{n}: {found} {expected}");
        }
    }

    /// Points of a ball, whose volume is approached from below, and none of what is flat.
    #[test]
    fn balls_and_what_is_flat() {
        // Spirals of equal steps in height.
        let ball = |count: u32| -> Vec<Triple> {
            (0..count)
                .map(|k| {
                    let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
                    let (sine, cosine) = (2.399963 * f64::from(k)).sin_cos();
                    let across = (1.0 - z * z).sqrt();
                    [across * cosine, across * sine, z]
                })
                .collect()
        };
        let whole = 4.0 / 3.0 * std::f64::consts::PI;
        let lacking = [100, 400].map(|count| 1.0 - volume(ball(count)).expect("a hull") / whole);
        // As the area of a face: a quarter of it with four times the points, up to the ends of the spiral.
        assert!(lacking[0] > 0.0 && (lacking[0] / lacking[1] - 4.0).abs() < 0.5, "{lacking:?}");
        let flat: Vec<Triple> = ball(50).into_iter().map(|[x, y, _]| [x, y, x + y]).collect();
        assert_eq!(hull(&flat), None);
        assert_eq!(hull(&[]), None);
        assert_eq!(hull(&[[1.0; 3]; 9]), None);
    }
}
