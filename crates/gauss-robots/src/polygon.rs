//! Faces with more than three corners, cut into triangles.

use super::rotation::Triple;

/// Parts of the square of the size of a face that are taken as no area.
const FLAT: f64 = 1e-12;

/// Triangles of a face, with its corners in their order: of four by the shorter diagonal, as MuJoCo cuts them, of more
/// by ears. What lies between corners that are in no plane depends on it. `None` of a
/// face that crosses itself so that it has no ear.
pub fn cut(face: &[usize], points: &[Triple]) -> Option<Vec<[usize; 3]>> {
    match *face {
        [a, b, c, d] => {
            let is_first = square_in_single(&points[a], &points[c]) < square_in_single(&points[b], &points[d]);
            Some(if is_first { vec![[a, b, c], [a, c, d]] } else { vec![[a, b, d], [b, c, d]] })
        }
        _ => ears(face, points),
    }
}

/// As MuJoCo compares lengths: it reads files in single precision.
fn square_in_single(a: &Triple, b: &Triple) -> f32 {
    (0..3).map(|i| (a[i] as f32) - (b[i] as f32)).map(|c| c * c).sum()
}

/// An ear is a triangle of three corners in a row that holds no other corner, seen along the normal.
fn ears(face: &[usize], points: &[Triple]) -> Option<Vec<[usize; 3]>> {
    let normal = twice_area(face, points);
    let none = FLAT * square_of_size(face, points);
    let along = (0..3).fold(0, |best, k| if normal[k].abs() > normal[best].abs() { k } else { best });
    if normal[along].abs() <= none {
        // Without an area it has no part in any sum, however it is cut.
        return Some(face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]).collect());
    }
    let [x, y] = if normal[along] > 0.0 { [1, 2] } else { [2, 1] }.map(|k| (along + k) % 3);
    let area = |a: usize, b: usize, c: usize| {
        let [u, v] = [b, c].map(|end| [x, y].map(|i| points[end][i] - points[a][i]));
        u[0] * v[1] - u[1] * v[0]
    };
    let (mut left, mut triangles, mut start) = (face.to_vec(), Vec::new(), 0);
    while left.len() > 3 {
        let count = left.len();
        let corners = |k: usize| [k, k + 1, k + 2].map(|k| left[k % count]);
        let is_ear = |k: &usize| {
            let [a, b, c] = corners(*k);
            // Files have corners twice where a face has a hole.
            let is_corner = |p: usize| [a, b, c].iter().any(|&corner| points[corner] == points[p]);
            let holds = |p: usize| area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
            area(a, b, c) >= -none && !left.iter().any(|&p| !is_corner(p) && holds(p))
        };
        start = (start..start + count).find(is_ear)? % count;
        triangles.push(corners(start));
        left.remove((start + 1) % count);
    }
    triangles.push([left[0], left[1], left[2]]);
    Some(triangles)
}

/// The volume between the planes along the mean normal that hold a face between them: what cutting can change.
pub fn bent(face: &[usize], points: &[Triple]) -> f64 {
    let normal = twice_area(face, points);
    let heights = face.iter().map(|&corner| (0..3).map(|i| normal[i] * points[corner][i]).sum::<f64>());
    let [least, most] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], h| [a.min(h), b.max(h)]);
    (most - least) / 2.0
}

/// Along the mean normal, whatever is cut how.
fn twice_area(face: &[usize], points: &[Triple]) -> Triple {
    let mut sum = [0.0; 3];
    for pair in face[1..].windows(2) {
        let [u, v]: [Triple; 2] =
            [pair[0], pair[1]].map(|end| std::array::from_fn(|i| points[end][i] - points[face[0]][i]));
        for (i, entry) in sum.iter_mut().enumerate() {
            *entry += u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
        }
    }
    sum
}

fn square_of_size(face: &[usize], points: &[Triple]) -> f64 {
    let square = |&corner: &usize| (0..3).map(|i| (points[corner][i] - points[face[0]][i]).powi(2)).sum::<f64>();
    face.iter().map(square).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the areas of triangles in the plane of the first two axes.
    fn areas(face: &[usize], points: &[Triple]) -> Option<Vec<f64>> {
        let cut = cut(face, points)?;
        Some(cut.into_iter().map(|own| twice_area(&own, points)[2]).collect())
    }

    /// Stars of random radii, from any corner on, seen from above and from below: no triangle is turned over, and all
    /// together are the whole.
    #[test]
    fn faces_that_are_not_convex() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for count in [5, 6, 8, 12, 40] {
            for _ in 0..50 {
                let place = [random() - 0.5, random() - 0.5, random()];
                let corner = |k: usize, turn: f64, radius: f64| {
                    let (sine, cosine) = (std::f64::consts::TAU * (k as f64 + 0.8 * turn) / count as f64).sin_cos();
                    [place[0] + radius * cosine, place[1] + radius * sine, place[2]]
                };
                let points: Vec<Triple> = (0..count).map(|k| corner(k, random(), 0.3 + 0.7 * random())).collect();
                let from = (random() * count as f64) as usize;
                let mut face: Vec<usize> = (0..count).map(|k| (k + from) % count).collect();
                let whole = twice_area(&face, &points)[2];
                for side in [1.0, -1.0] {
                    let found = areas(&face, &points).expect("a face that does not cross itself");
                    assert!(found.len() == count - 2 && found.iter().all(|area| side * area >= -FLAT), "{found:?}");
                    // Some roundings of areas of size one each.
                    let off = found.iter().sum::<f64>() - side * whole;
                    assert!(off.abs() < 16.0 * count as f64 * f64::EPSILON, "{off:e}");
                    face.reverse();
                }
            }
        }
    }

    /// A square with a square hole, along a line that is there twice; corners on edges; no area; one that crosses
    /// itself.
    #[test]
    fn other_faces() {
        let square = |half: f64| [[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]];
        let points: Vec<Triple> = square(2.0).into_iter().chain(square(1.0)).collect();
        let found = areas(&[0, 1, 2, 3, 0, 4, 7, 6, 5, 4], &points).expect("a ring");
        assert!(found.iter().all(|area| *area >= 0.0) && found.iter().sum::<f64>() == 24.0, "{found:?}");
        let halved: Vec<Triple> =
            (0..5).map(|k| [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]][k]).collect();
        assert_eq!(areas(&[0, 1, 2, 3, 4], &halved).map(|found| found.iter().sum()), Some(4.0));
        let line: Vec<Triple> = (0..5).map(|k| [f64::from(k), 0.0, 0.0]).collect();
        assert_eq!(areas(&[0, 1, 2, 3, 4], &line).map(|found| found.len()), Some(3));
        let bow = [[4.0, 4.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 0.0], [2.0, 4.0, 0.0], [4.0, 1.0, 0.0]];
        assert_eq!(cut(&[0, 1, 2, 3, 4], &bow), None);
    }

    #[test]
    fn what_is_bent() {
        let points = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 2.0, 1.0], [1.0, 3.0, 1.0], [0.0, 2.0, 1.0]];
        assert_eq!(bent(&[0, 1, 2, 3, 4], &points), 0.0);
        let mut lifted = points;
        lifted[3][2] = 1.5;
        // About the area, 5, times how far a corner is off.
        let found = bent(&[0, 1, 2, 3, 4], &lifted);
        assert!((1.0..3.0).contains(&found), "{found}");
    }
}
