//! Values of expressions.

use crate::algebra::{Expr, Graph, Map};
use crate::mechanics::{Tree, Turn, about_axis, add, common, identity, point_seen_from, subtract, turned};

type Triple<'g> = [Expr<'g>; 3];

/// Value of an expression.
#[derive(Clone)]
pub enum Value<'g> {
    Scalar(Expr<'g>),
    /// Observer's axes, or those in which it was written.
    Vector(Triple<'g>),
    /// A vector of which a link knows the components in its axes.
    Local(Local<'g>),
    /// A product.
    Rotation(Vec<RotationFactor<'g>>),
    /// R and b.
    Pose(RotationFactor<'g>, Triple<'g>),
    /// (u, ω), or the force and the torque of a wrench.
    Twist(Triple<'g>, Triple<'g>),
}

impl<'g> Value<'g> {
    /// A vector in observer's axes, whoever knows it in others.
    pub fn observed(self) -> Self {
        match self {
            Value::Local(local) => Value::Vector(local.observed),
            other => other,
        }
    }
}

/// A vector, or a point from Ω, that a link knows in its own axes: between links of one tree the observer's need not be
/// gone through.
#[derive(Clone, Copy)]
pub struct Local<'g> {
    pub link: usize,
    /// A point of the link, whose components are from O; else they are the vector's.
    pub is_point: bool,
    pub components: Triple<'g>,
    /// Observer's components.
    pub observed: Triple<'g>,
}

impl<'g> Local<'g> {
    pub fn point(link: usize, components: Triple<'g>, observed: Triple<'g>) -> Self {
        Self { link, is_point: true, components, observed }
    }

    /// A vector in the axes of a link.
    pub fn turned(link: usize, components: Triple<'g>, tree: &Tree<'g>) -> Self {
        Self::vector(link, components, tree.links[link].axes().to_space(&components))
    }

    fn vector(link: usize, components: Triple<'g>, observed: Triple<'g>) -> Self {
        Self { link, is_point: false, components, observed }
    }

    /// A function of its components that does not depend on the axes.
    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Option<Self> {
        (!self.is_point).then(|| Self::vector(self.link, self.components.map(&f), self.observed.map(&f)))
    }

    /// The components in the axes of another link of the tree.
    pub fn seen_by(&self, link: usize, tree: &Tree<'g>) -> Option<Triple<'g>> {
        if self.is_point { None } else { turned(&tree.links, [self.link, link], &self.components) }
    }

    /// Components of two vectors in the axes of the last link that both hang on.
    pub fn together(&self, other: &Self, tree: &Tree<'g>) -> Option<(usize, [Triple<'g>; 2])> {
        let link = common(&tree.links, [self.link, other.link])?;
        Some((link, [self.seen_by(link, tree)?, other.seen_by(link, tree)?]))
    }

    pub fn plus(&self, other: &Self, tree: &Tree<'g>) -> Option<Self> {
        let observed = add(&self.observed, &other.observed);
        let (to, vector) = match (self.is_point, other.is_point) {
            (true, true) => return None,
            (false, true) => (other, self),
            (true, false) => (self, other),
            (false, false) => {
                let (link, [a, b]) = self.together(other, tree)?;
                return Some(Self::vector(link, add(&a, &b), observed));
            }
        };
        let components = add(&to.components, &vector.seen_by(to.link, tree)?);
        Some(Self::point(to.link, components, observed))
    }

    pub fn minus(&self, other: &Self, tree: &Tree<'g>) -> Option<Self> {
        if !(self.is_point && other.is_point) {
            return self.plus(&other.map(|e| -e)?, tree);
        }
        let link = common(&tree.links, [self.link, other.link])?;
        let [end, start] = [self, other].map(|p| point_seen_from(&tree.links, [p.link, link], &p.components));
        Some(Self::vector(link, subtract(&end, &start), subtract(&self.observed, &other.observed)))
    }
}

/// One factor of a rotation.
#[derive(Clone, Copy)]
pub enum RotationFactor<'g> {
    /// A turn by an angle about an axis.
    About(usize, Expr<'g>),
    /// A coordinate, or a quarter turn, whose entries are integers.
    Given(Turn<'g>),
}

impl<'g> RotationFactor<'g> {
    pub fn quarters(graph: &'g Graph, axis: usize, quarters: usize) -> Self {
        let (cos, sin) = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarters % 4];
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut matrix = identity(graph);
        matrix[a][a] = graph.integer(cos);
        matrix[b][b] = graph.integer(cos);
        matrix[a][b] = graph.integer(-sin);
        matrix[b][a] = graph.integer(sin);
        RotationFactor::Given(Turn::given(matrix, [graph.zero(); 3]))
    }

    pub fn turn(&self, graph: &'g Graph, rates: &Map<u32, Expr<'g>>) -> Turn<'g> {
        match *self {
            RotationFactor::About(axis, angle) => Turn::about(graph, axis, angle, rates),
            RotationFactor::Given(turn) => turn,
        }
    }

    pub fn matrix(&self, graph: &'g Graph) -> [Triple<'g>; 3] {
        match self {
            RotationFactor::About(axis, angle) => about_axis(graph, *axis, *angle),
            RotationFactor::Given(turn) => turn.matrix,
        }
    }

    pub fn inverse(&self) -> Self {
        match *self {
            RotationFactor::About(axis, angle) => RotationFactor::About(axis, -angle),
            RotationFactor::Given(turn) => RotationFactor::Given(turn.inverse()),
        }
    }
}
