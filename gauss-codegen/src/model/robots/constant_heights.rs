//! Points of links that no motion brings nearer to a plane, or away from it: a ball on a column that turns about its
//! own axis, a cart on a level rail.

use super::clauses::Robot;
use gauss_robots::collision::{Collision, Shape};
use gauss_robots::description::JointKind;
use gauss_robots::rotation::{Matrix, Triple, turned};

/// A plane in observer's axes, whose direction and height are numbers.
#[derive(Clone, Copy)]
pub struct LevelPlane {
    pub normal: Triple,
    pub height: f64,
}

/// A link in some states, as a plane sees it.
pub struct LinkStates {
    level: LevelPlane,
    /// None where the link moves in more ways than joints with one coordinate let it.
    states: Vec<(Triple, Matrix)>,
}

/// States that are looked at, at values of the coordinates that are never whole turns of one another.
const STATES: u32 = 4;
/// Roundings of sums of lengths along a chain, as part of them.
const SLACK: f64 = 1e-12;

impl Robot<'_> {
    /// A link as a plane sees it, if what holds the file stays where it is.
    pub fn seen(&self, link: usize, level: LevelPlane) -> Option<LinkStates> {
        let held = !self.is_floating() && self.clauses.mount.is_none();
        let mut chain = std::iter::successors(Some(link), |&link| self.structure.parent_of[link]);
        let joint = |link: usize| Some(self.description.joints[self.structure.joint_of[link]?].kind);
        let few = chain.all(|link| joint(link).is_none_or(|kind| kind == JointKind::Fixed || kind.is_scalar()));
        if !held || !few {
            return None;
        }
        let joints = &self.description.joints;
        let value = |state: u32, name: &str| {
            let index = joints.iter().position(|joint| joint.name == name)?;
            let coupling = self.structure.coupling_of[index];
            if let Some(number) = self.lock_of(index).and_then(|lock| lock.number) {
                return Some(coupling.multiplier * number + coupling.offset - joints[index].reference);
            }
            let q = (f64::from(state) + 0.5) * (1.0 + 0.618_033_988_749_894_9 * (coupling.joint as f64 + 1.0));
            Some(coupling.multiplier * (q.fract() - 0.5) + coupling.offset - joints[index].reference)
        };
        let place =
            |state| self.structure.moved(self.description, link, |joint| value(state, &joint.name).unwrap_or(0.0));
        Some(LinkStates { level, states: (0..STATES).map(place).collect() })
    }
}

impl LinkStates {
    /// The height of a point over the plane, if it stays.
    fn height(&self, point: &Triple) -> Option<f64> {
        let over = |(at, matrix): &(Triple, Matrix)| {
            let moved = turned(matrix, point);
            let along = |i: usize| self.level.normal[i] * (at[i] + moved[i]);
            let size = (0..3).map(|i| at[i].abs() + moved[i].abs()).fold(self.level.height.abs(), f64::max);
            ((0..3).map(along).sum::<f64>() - self.level.height, size)
        };
        self.same(over)
    }

    /// The part of a direction of length one that points out of the plane, if that stays.
    fn slope(&self, direction: &Triple) -> Option<f64> {
        self.same(|(_, matrix)| {
            let turned = turned(matrix, direction);
            ((0..3).map(|i| self.level.normal[i] * turned[i]).sum(), 1.0)
        })
    }

    /// A value, with the size of what it is the sum of, that is the same in all states.
    fn same(&self, value: impl Fn(&(Triple, Matrix)) -> (f64, f64)) -> Option<f64> {
        let all: Vec<(f64, f64)> = self.states.iter().map(value).collect();
        let (first, _) = *all.first()?;
        all.iter().all(|(value, size)| (value - first).abs() <= SLACK * size.max(1.0)).then_some(first)
    }

    /// Whether a ball about a point stays clear of the plane.
    pub fn is_clear(&self, center: &Triple, radius: f64) -> bool {
        self.height(center).is_some_and(|height| height > radius)
    }

    /// Whether a shape that touches with a round side stays clear of the plane.
    pub fn is_round_and_clear(&self, collision: &Collision) -> bool {
        let axes = [0, 1, 2].map(|k| self.slope(&collision.rotation.map(|row| row[k])));
        let lowest = match (&collision.shape, axes) {
            (Shape::Cylinder { radius, half }, [_, _, Some(z)]) => {
                half * z.abs() + radius * (1.0 - z * z).max(0.0).sqrt()
            }
            (Shape::Ellipsoid { semi_axes: [a, b, c] }, [Some(x), Some(y), Some(z)]) => {
                ((a * x).powi(2) + (b * y).powi(2) + (c * z).powi(2)).sqrt()
            }
            _ => return false,
        };
        self.is_clear(&collision.position, lowest)
    }
}
