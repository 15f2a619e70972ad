//! Fewer points of a pair, by a rule that has a name.

use gauss_runtime::nalgebra::Vector3;

/// Rule by which points of a pair are left out, where that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Reduction {
    /// Keeps, of the points of a pair with one normal (to 1°), four that have nearly the largest area: the one that is
    /// farthest from the mean of all, the one that is farthest from that, and on both sides of the line through the two
    /// those that are farthest from it; and the deepest, where it is deeper than these. Where faces of boxes touch
    /// these are the corners of what they have in common if that is a rectangle, and no other point can go below zero;
    /// of others what is left out may, until it is the deepest.
    Quadrilateral,
}

/// Length, on the scale of all points, below which differences are rounding: which of two equal points is kept is then
/// not decided by it.
const SAME: f64 = 1e-7;
/// The cosine of 1°.
const ONE_NORMAL: f64 = 0.999_847_695_156_391_3;

/// A point of a pair in the axes of one of its shapes, its normal there, and its gap.
pub(crate) type Place = (Vector3<f64>, Vector3<f64>, f64);

impl Reduction {
    /// The numbers of the points that are kept, in their order.
    pub(crate) fn kept(self, places: &[Place]) -> Vec<usize> {
        let Self::Quadrilateral = self;
        let mut left: Vec<usize> = (0..places.len()).collect();
        let mut kept = Vec::new();
        while let Some(&first) = left.first() {
            let normal = places[first].1;
            let (group, rest) = left.iter().partition(|&&i| places[i].1.dot(&normal) >= ONE_NORMAL);
            left = rest;
            kept.extend(quadrilateral(places, &group, &normal));
        }
        kept.sort_unstable();
        kept
    }
}

fn quadrilateral(places: &[Place], group: &[usize], normal: &Vector3<f64>) -> Vec<usize> {
    let at = |i: usize| places[i].0;
    let mean = group.iter().map(|&i| at(i)).sum::<Vector3<f64>>() / group.len() as f64;
    let size = group.iter().map(|&i| (at(i) - mean).norm()).fold(0.0, f64::max);
    let mut kept: Vec<usize> = Vec::new();
    // The point of which something is largest, and more than that; of what is equal to rounding the first in the
    // library's order.
    let keep = |kept: &mut Vec<usize>, of: &dyn Fn(usize) -> f64, than: f64| {
        let larger = |best: Option<(usize, f64)>, i: usize| match best {
            Some((_, most)) if of(i) <= most + SAME * size => best,
            _ => Some((i, of(i))),
        };
        kept.extend(group.iter().copied().fold(None, larger).filter(|(_, most)| *most > than).map(|(i, _)| i));
    };
    keep(&mut kept, &|i| (at(i) - mean).norm(), -1.0);
    if let [first] = kept[..] {
        keep(&mut kept, &|i| (at(i) - at(first)).norm(), SAME * size);
    }
    if let [first, second] = kept[..] {
        let across = normal.cross(&(at(second) - at(first))).normalize();
        keep(&mut kept, &|i| across.dot(&(at(i) - at(first))), SAME * size);
        keep(&mut kept, &|i| -across.dot(&(at(i) - at(first))), SAME * size);
    }
    let deepest = kept.iter().map(|&i| -places[i].2).fold(f64::NEG_INFINITY, f64::max);
    keep(&mut kept, &|i| -places[i].2, deepest + SAME * size);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, y: f64, normal: Vector3<f64>, gap: f64) -> Place {
        (Vector3::new(x, y, 0.0), normal, gap)
    }

    #[test]
    fn corners_are_kept_and_twins_are_not() {
        let up = Vector3::z();
        // A long rectangle, each corner twice as rounding would have it, points on its edges, and one within.
        for (length, width) in [(1.0, 1.0), (20.0, 0.1), (0.1, 3.0)] {
            let mut places = vec![place(0.5 * length, 0.5 * width, up, 1e-17)];
            for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.5)] {
                places.push(place(x * length, y * width, up, 1e-17));
                places.push(place(x * length * (1.0 + 1e-16), y * width, up, 0.0));
            }
            assert_eq!(Reduction::Quadrilateral.kept(&places), [1, 3, 7, 9]);
        }
    }

    #[test]
    fn the_deepest_is_kept_and_so_is_each_normal() {
        let (up, side) = (Vector3::z(), Vector3::x());
        let places = [
            place(0.0, 0.0, up, 0.1),
            place(1.0, 0.0, up, 0.1),
            place(0.4, 0.0, up, -0.1),
            place(0.6, 0.0, up, 0.05),
            place(0.0, 1.0, side, 0.2),
        ];
        assert_eq!(Reduction::Quadrilateral.kept(&places), [0, 1, 2, 4]);
        assert_eq!(Reduction::Quadrilateral.kept(&places[..1]), [0]);
        assert!(Reduction::Quadrilateral.kept(&[]).is_empty());
    }
}
