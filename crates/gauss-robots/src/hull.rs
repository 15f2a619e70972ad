//! The convex hull of points.

use std::collections::HashMap;

use super::rotation::Triple;

/// The distance in front of a face, as part of the size of all, below which a point is taken as in its plane where the
/// first face is sought.
const FLAT: f64 = 1e-10;

/// Points by integers that are the size of all over 2⁴⁰: determinants of these are exact, and so is what is in front of
/// what. Points move by less than a part in 10¹² of the size.
type Point = [i64; 3];
const STEPS: f64 = (1_u64 << 40) as f64;

/// Faces around all points, counter-clockwise as seen from outside (quickhull, Barber and others, 1996): of the points
/// in front of a face the farthest is added, in place of the faces around that it is in front of. `None` of points in a
/// plane.
pub fn hull(points: &[Triple]) -> Option<Vec<[usize; 3]>> {
    let size = points.iter().flatten().fold(0.0, |size: f64, c| size.max(c.abs()));
    let faces = first(points, FLAT * size)?;
    let points = points.iter().map(|point| point.map(|c| (c / size * STEPS).round() as i64)).collect();
    let mut hull = Hull { points, faces: Vec::new(), beside: HashMap::new() };
    for corners in faces {
        hull.add(corners)?;
    }
    hull.share((0..hull.points.len()).collect(), 0);
    let mut next = 0;
    while next < hull.faces.len() {
        match hull.faces[next].farthest() {
            Some(point) => hull.grow(next, point)?,
            None => next += 1,
        }
    }
    Some(hull.faces.iter().filter(|face| !face.is_inside).map(|face| face.corners).collect())
}

/// A hull while it grows.
struct Hull {
    points: Vec<Point>,
    faces: Vec<Face>,
    /// The face that has an edge in this direction.
    beside: HashMap<[usize; 2], usize>,
}

struct Face {
    corners: [usize; 3],
    /// Along the normal, of any length.
    normal: [i128; 3],
    /// Points in front of it, and of no earlier one, with how far they are.
    front: Vec<(usize, i128)>,
    /// Others have taken its place.
    is_inside: bool,
}

impl Face {
    fn edges(&self) -> [[usize; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }

    fn farthest(&self) -> Option<usize> {
        self.front.iter().max_by_key(|(_, height)| *height).map(|(point, _)| *point)
    }
}

impl Hull {
    fn apart(&self, from: usize, to: usize) -> [i128; 3] {
        std::array::from_fn(|i| i128::from(self.points[to][i] - self.points[from][i]))
    }

    /// `None` if a face with one of its edges is there.
    fn add(&mut self, corners: [usize; 3]) -> Option<()> {
        let [u, v] = [1, 2].map(|k| self.apart(corners[0], corners[k]));
        let normal = std::array::from_fn(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
        let face = Face { corners, normal, front: Vec::new(), is_inside: false };
        for edge in face.edges() {
            if self.beside.insert(edge, self.faces.len()).is_some() {
                return None;
            }
        }
        self.faces.push(face);
        Some(())
    }

    /// The distance of a point in front of a face, times the length of its normal.
    fn height(&self, face: usize, point: usize) -> i128 {
        let Face { corners, normal, .. } = &self.faces[face];
        let over = self.apart(corners[0], point);
        (0..3).map(|i| normal[i] * over[i]).sum()
    }

    /// Gives points to faces that they are in front of, from one on; others are within.
    fn share(&mut self, points: Vec<usize>, from: usize) {
        for point in points {
            let heights = (from..self.faces.len()).map(|face| (face, self.height(face, point)));
            if let Some((face, height)) = heights.into_iter().find(|(_, height)| *height > 0) {
                self.faces[face].front.push((point, height));
            }
        }
    }

    /// Adds a point that is in front of a face.
    fn grow(&mut self, face: usize, point: usize) -> Option<()> {
        let (mut seen, mut rim, mut orphans) = (vec![face], Vec::new(), Vec::new());
        self.faces[face].is_inside = true;
        let mut at = 0;
        while let Some(&own) = seen.get(at) {
            for [a, b] in self.faces[own].edges() {
                let other = *self.beside.get(&[b, a])?;
                if self.faces[other].is_inside {
                    continue;
                }
                if self.height(other, point) > 0 {
                    self.faces[other].is_inside = true;
                    seen.push(other);
                } else {
                    rim.push([a, b]);
                }
            }
            at += 1;
        }
        for own in seen {
            for edge in self.faces[own].edges() {
                self.beside.remove(&edge);
            }
            let front = std::mem::take(&mut self.faces[own].front);
            orphans.extend(front.into_iter().map(|(orphan, _)| orphan).filter(|orphan| *orphan != point));
        }
        let from = self.faces.len();
        for [a, b] in rim {
            self.add([a, b, point])?;
        }
        self.share(orphans, from);
        Some(())
    }
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

/// Height of a point in front of a face.
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
        let size = points.iter().flatten().fold(0.0, |size: f64, c| size.max(c.abs()));
        // Nothing is in front of a face by more than integers move it; faces without an area have no front.
        for &face in faces.iter().step_by(1 + faces.len() / 50) {
            let [u, v] = [1, 2].map(|k| length(&minus(&points[face[k]], &points[face[0]])));
            let area = twice_area(&points, face);
            let slack = 1e-11 * size * (1.0 + u * v / area.max(1e-300));
            assert!(points.iter().enumerate().all(|(k, _)| height(&points, face, k) < slack), "{face:?}");
        }
        let mesh = Mesh { vertices: points, faces, unsure: 0.0 };
        mesh.inertial(Rule::Exact).ok().map(|own| own.mass)
    }

    fn twice_area(points: &[Triple], [a, b, c]: [usize; 3]) -> f64 {
        length(&cross(&minus(&points[b], &points[a]), &minus(&points[c], &points[a])))
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

    /// A disk that bulges by less and less over a point, down to the rounding of numbers in single precision: masses of
    /// MuJoCo 4.0.0 (`inertia="convex"`), which reads such numbers.
    #[test]
    fn points_that_are_nearly_in_a_plane() {
        let masses = [
            (1e-3, 0.1054739881913103),
            (1e-5, 0.10393034526910066),
            (1e-7, 0.10391491544958745),
            (1e-8, 0.10391477051239718),
        ];
        for (bulge, expected) in masses {
            let count = 5261;
            let mut points: Vec<Triple> = (0..count)
                .map(|k| {
                    let radius = ((f64::from(k) + 0.5) / f64::from(count)).sqrt();
                    let (sine, cosine) = (2.399963 * f64::from(k)).sin_cos();
                    [radius * cosine, radius * sine, 0.1 + bulge * (1.0 - radius * radius)]
                })
                .collect();
            points.push([0.0; 3]);
            let found = volume(points).expect("a hull");
            assert!((found / expected - 1.0).abs() < 3e-7, "{bulge}: {found} {expected}");
        }
        // Above, and below, by what rounding leaves.
        let plate: Vec<Triple> = (0..6000)
            .map(|k| {
                let (x, y, side) = (f64::from(k / 2 % 50), f64::from(k / 100), f64::from(k % 2));
                [0.1 * x, 0.1 * y, 0.3 * side + 1e-9 * (x * 0.7 + y * y * 0.3).sin()]
            })
            .collect();
        let (found, expected) = (volume(plate).expect("a hull"), 4.9 * 5.9 * 0.3);
        assert!((found / expected - 1.0).abs() < 1e-7, "{found} {expected}");
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
