//! What expressions stand for.

use crate::algebra::{Expr, Graph, Map};
use crate::mechanics::{Turn, about_axis, identity};

type Triple<'g> = [Expr<'g>; 3];

/// What an expression stands for.
#[derive(Clone)]
pub enum Value<'g> {
    Scalar(Expr<'g>),
    /// Observer's axes, or those in which it was written.
    Vector(Triple<'g>),
    /// A product.
    Rotation(Vec<Piece<'g>>),
    /// R and b.
    Pose(Piece<'g>, Triple<'g>),
    /// (u, ω), or the force and the torque of a wrench.
    Twist(Triple<'g>, Triple<'g>),
}

/// One factor of a rotation.
#[derive(Clone, Copy)]
pub enum Piece<'g> {
    /// By an angle about an axis.
    About(usize, Expr<'g>),
    /// A coordinate, or a quarter turn, whose entries are integers.
    Given(Turn<'g>),
}

impl<'g> Piece<'g> {
    pub fn quarters(graph: &'g Graph, axis: usize, quarters: usize) -> Self {
        let (cos, sin) = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarters % 4];
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut matrix = identity(graph);
        matrix[a][a] = graph.integer(cos);
        matrix[b][b] = graph.integer(cos);
        matrix[a][b] = graph.integer(-sin);
        matrix[b][a] = graph.integer(sin);
        Piece::Given(Turn::given(matrix, [graph.zero(); 3]))
    }

    pub fn turn(&self, graph: &'g Graph, rates: &Map<u32, Expr<'g>>) -> Turn<'g> {
        match *self {
            Piece::About(axis, angle) => Turn::about(graph, axis, angle, rates),
            Piece::Given(turn) => turn,
        }
    }

    pub fn matrix(&self, graph: &'g Graph) -> [Triple<'g>; 3] {
        match self {
            Piece::About(axis, angle) => about_axis(graph, *axis, *angle),
            Piece::Given(turn) => turn.matrix,
        }
    }

    pub fn inverse(&self) -> Self {
        match *self {
            Piece::About(axis, angle) => Piece::About(axis, -angle),
            Piece::Given(turn) => Piece::Given(turn.inverse()),
        }
    }
}
