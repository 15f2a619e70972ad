//! Shapes of links that touch, and which of them touch each other.

use super::at::At;
use super::rotation::{Matrix, Triple};

/// A shape of a link.
#[derive(Clone, Debug)]
pub struct Collision {
    /// As the file has it.
    pub name: Option<String>,
    /// Its element.
    pub at: At,
    /// The name of its link.
    pub link: String,
    /// Its centre in the axes of the link.
    pub position: Triple,
    /// From its axes to those of the link.
    pub rotation: Matrix,
    /// Form and size of the shape.
    pub shape: Shape,
    /// Contact parameters of its surface, where the format gives them.
    pub surface: Option<Surface>,
}

/// Lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// About the centre.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A cylinder along the third axis with half spheres at its ends.
    Capsule {
        /// Radius of the half spheres.
        radius: f64,
        /// Half the distance of their centres.
        half: f64,
    },
    /// Along the third axis.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Half its length.
        half: f64,
    },
    /// Along its axes.
    Box {
        /// Half of its edges.
        half: Triple,
    },
    /// Along its axes.
    Ellipsoid {
        /// Half of its widths; not all are equal.
        semi_axes: Triple,
    },
    /// All that lies below, the third axis being out of it.
    Plane,
    /// A shape that is not read, in words: `a mesh`.
    Unread(String),
}

/// Two shapes of which a file says that they touch, whatever else it says of either.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Its element.
    pub at: At,
    /// Both, in the order of the file.
    pub shapes: [Collision; 2],
    /// The law by which they touch, or why that is not read: then they do not, whatever else the file says of them.
    pub touch: Result<Touch, &'static str>,
    /// Attributes that act where they touch, and are not read.
    pub unread: Vec<&'static str>,
}

impl Pair {
    /// Whether it is of these two shapes, whichever is first.
    #[must_use]
    pub fn is_of(&self, shapes: [&Collision; 2]) -> bool {
        // Copies of an element have its place, but links of their own.
        let same = |a: &Collision, b: &Collision| a.at == b.at && a.link == b.link;
        let [a, b] = &self.shapes;
        (same(a, shapes[0]) && same(b, shapes[1])) || (same(a, shapes[1]) && same(b, shapes[0]))
    }
}

/// Contact parameters that MJCF gives for a geom.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Bits of which another shape is to have one in its `affinity`.
    pub kind: u32,
    /// Bits of which another shape is to have one in its `kind`.
    pub affinity: u32,
    /// 1 without friction, 3 with friction of sliding, 4 and 6 also of turning and rolling.
    pub dimension: u32,
    /// Priority: of two surfaces the one with more gives all parameters.
    pub priority: i64,
    /// The coefficient of friction of sliding.
    pub friction: f64,
    /// Attributes that act where it touches, and are not read.
    pub unread: Vec<&'static str>,
}

/// Law by which two shapes touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch {
    /// The coefficient of friction of sliding.
    pub friction: f64,
    /// There is friction of turning, and perhaps of rolling, besides.
    pub turns: bool,
}

impl Default for Surface {
    /// Surface of a geom that gives no parameters.
    fn default() -> Self {
        Surface { kind: 1, affinity: 1, dimension: 3, priority: 0, friction: 1.0, unread: Vec::new() }
    }
}

impl Surface {
    /// Whether the bits of two surfaces let them touch.
    #[must_use]
    pub fn meets(&self, other: &Surface) -> bool {
        self.kind & other.affinity != 0 || other.kind & self.affinity != 0
    }

    /// The surface by itself, against one of which nothing is known.
    #[must_use]
    pub fn alone(&self) -> Touch {
        Touch { friction: if self.dimension > 1 { self.friction } else { 0.0 }, turns: self.dimension > 3 }
    }

    /// As MuJoCo puts two together: all of the one with the higher priority, else the larger of each.
    #[must_use]
    pub fn with(&self, other: &Surface) -> Touch {
        let larger = Surface {
            dimension: self.dimension.max(other.dimension),
            friction: self.friction.max(other.friction),
            ..Surface::default()
        };
        match self.priority.cmp(&other.priority) {
            std::cmp::Ordering::Greater => self.alone(),
            std::cmp::Ordering::Less => other.alone(),
            std::cmp::Ordering::Equal => larger.alone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Surface, Touch};

    #[test]
    fn bits_of_one_and_of_the_other() {
        let of = |kind, affinity| Surface { kind, affinity, ..Surface::default() };
        assert!(of(1, 1).meets(&of(1, 1)) && of(4, 0).meets(&of(0, 6)) && of(0, 6).meets(&of(4, 0)));
        assert!(!of(1, 2).meets(&of(1, 4)) && !of(0, 0).meets(&of(7, 7)));
    }

    /// MuJoCo's `mj_contactParam`: a priority decides about all, else each is the larger one.
    #[test]
    fn two_surfaces_together() {
        let of = |priority, dimension, friction| Surface { priority, dimension, friction, ..Surface::default() };
        let touch = |friction, turns| Touch { friction, turns };
        assert_eq!(of(0, 3, 0.4).with(&of(0, 3, 0.7)), touch(0.7, false));
        assert_eq!(of(0, 1, 0.4).with(&of(0, 3, 0.7)), touch(0.7, false));
        assert_eq!(of(0, 1, 0.4).with(&of(0, 1, 0.7)), touch(0.0, false));
        assert_eq!(of(1, 1, 0.4).with(&of(0, 3, 0.7)), touch(0.0, false));
        assert_eq!(of(-1, 3, 0.7).with(&of(0, 6, 0.2)), touch(0.2, true));
        assert_eq!(of(0, 4, 0.3).alone(), touch(0.3, true));
    }
}
