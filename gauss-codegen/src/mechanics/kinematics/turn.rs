//! Turns of axes: the links of a chain are turned one after the other, vectors and tensors with them.

use crate::algebra::{Expr, Graph, Map, Rational};

use crate::mechanics::kinematics::rotation::{about_axis, poisson};
use crate::mechanics::kinematics::vector::{Frame, Triple, add, cross};

/// A turn of the axes, and how fast it goes on.
#[derive(Clone, Copy)]
pub struct Turn<'g> {
    /// From components in the turned axes to those before.
    pub matrix: [Triple<'g>; 3],
    /// Angular velocity of the turned axes relative to those before, in the turned axes.
    pub spin: Triple<'g>,
    /// Axis and angle where it is about an axis of its own.
    about: Option<(usize, Expr<'g>)>,
}

impl<'g> Turn<'g> {
    /// Turn by an angle about an axis of the axes before (and after).
    pub fn about(graph: &'g Graph, axis: usize, angle: Expr<'g>, rates: &Map<u32, Expr<'g>>) -> Self {
        let rate = angle.derivative(rates);
        let spin = std::array::from_fn(|i| if i == axis { rate } else { graph.zero() });
        Self { matrix: about_axis(graph, axis, angle), spin, about: Some((axis, angle)) }
    }

    /// Any rotation, with its angular velocity in the turned axes.
    pub fn given(matrix: [Triple<'g>; 3], spin: Triple<'g>) -> Self {
        Self { matrix, spin, about: None }
    }

    /// The same turn, going on as fast as is said.
    pub fn with_spin(self, spin: Triple<'g>) -> Self {
        Self { spin, ..self }
    }

    /// The turn back.
    pub fn inverse(&self) -> Self {
        let matrix = std::array::from_fn(|i| std::array::from_fn(|j| self.matrix[j][i]));
        let spin = self.vector(&self.spin).map(|e| -e);
        Self { matrix, spin, about: self.about.map(|(axis, angle)| (axis, -angle)) }
    }

    /// Angles by which it is turned on in a direction, in the turned axes: the axial vector of RᵀδR, where R is
    /// orthogonal.
    pub fn displacement(&self, direction: &Map<u32, Expr<'g>>) -> Triple<'g> {
        let graph = self.spin[0].graph();
        let unit =
            |axis: usize| -> Triple<'g> { std::array::from_fn(|i| if i == axis { graph.one() } else { graph.zero() }) };
        if let Some((axis, angle)) = self.about {
            let rate = angle.derivative(direction).group();
            return unit(axis).map(|e| e * rate);
        }
        let rates = self.matrix.map(|row| row.map(|e| e.derivative(direction)));
        // Of a coordinate the axes are the directions.
        let along = |axis: &usize| {
            let expected = poisson(&self.matrix, &unit(*axis));
            expected.zip(rates.iter().flatten()).all(|((_, expected), rate)| expected == *rate)
        };
        if let Some(axis) = (0..3).find(along) {
            return unit(axis);
        }
        let entry = |i: usize, j: usize| (0..3).map(|l| self.matrix[l][i] * rates[l][j]).sum::<Expr<'g>>().group();
        [entry(2, 1), entry(0, 2), entry(1, 0)]
    }

    /// A product of turns with neighbours about one axis put together.
    pub fn merged(turns: Vec<Self>, rates: &Map<u32, Expr<'g>>) -> Vec<Self> {
        let mut merged: Vec<Self> = Vec::with_capacity(turns.len());
        for turn in turns {
            match (merged.last().and_then(|last| last.about), turn.about) {
                (Some((before, a)), Some((axis, b))) if before == axis => {
                    merged.pop();
                    merged.push(Self::about(turn.spin[0].graph(), axis, a + b, rates));
                }
                _ => merged.push(turn),
            }
        }
        merged
    }

    /// Axis and angle, when it is about one of the axes.
    pub fn axis_and_angle(&self) -> Option<(usize, Expr<'g>)> {
        self.about
    }

    fn frame(&self) -> Frame<'g> {
        Frame { graph: self.spin[0].graph(), rotation: self.matrix }
    }

    /// Components before the turn, of a vector given in the turned axes.
    pub fn vector(&self, a: &Triple<'g>) -> Triple<'g> {
        self.frame().to_space(a)
    }

    /// Components in the turned axes, of a vector given in those before.
    pub fn back(&self, a: &Triple<'g>) -> Triple<'g> {
        self.frame().to_body(a)
    }

    /// A symmetric tensor of the turned axes, in those before: R J Rᵀ. About an axis it is
    /// `J_aa − sin·w, J_bb + sin·w, cos·w − J_ab` with `w = sin (J_aa − J_bb) + 2 cos J_ab` in the plane of the turn,
    /// because cos² = 1 − sin²: half the work of the two products.
    pub fn tensor(&self, j: &[Triple<'g>; 3]) -> [Triple<'g>; 3] {
        let Some((axis, _)) = self.about else {
            let half: [Triple<'g>; 3] = std::array::from_fn(|k| self.vector(&j[k]).map(Expr::group));
            // half[k] = R (row k of J); the other side turns the index k.
            let columns: [Triple<'g>; 3] =
                std::array::from_fn(|i| self.vector(&std::array::from_fn(|k| half[k][i])).map(Expr::group));
            return std::array::from_fn(|i| std::array::from_fn(|k| columns[i.min(k)][i.max(k)]));
        };
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let (cos, sin) = (self.matrix[a][a], self.matrix[b][a]);
        let w = (sin * (j[a][a] - j[b][b]).group() + cos * j[a][b].scale(Rational::from_integer(2))).group();
        let mut turned = *j;
        turned[a][a] = j[a][a] - sin * w;
        turned[b][b] = j[b][b] + sin * w;
        turned[a][b] = cos * w - j[a][b];
        turned[b][a] = turned[a][b];
        let rows = self.vector(&std::array::from_fn(|i| if i == axis { j[0][0].graph().zero() } else { j[axis][i] }));
        for i in [a, b] {
            turned[axis][i] = rows[i].group();
            turned[i][axis] = turned[axis][i];
        }
        turned
    }

    /// Any tensor of the turned axes, in those before. About an axis its part in the plane of the turn is a multiple of
    /// 1, one of the quarter turn, and a symmetric part that turns twice as far, as in [`tensor`](Self::tensor).
    pub fn mixed(&self, y: &[Triple<'g>; 3]) -> [Triple<'g>; 3] {
        let transposed =
            |m: &[Triple<'g>; 3]| -> [Triple<'g>; 3] { std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])) };
        let Some((axis, _)) = self.about else {
            let rows = y.map(|row| self.vector(&row).map(Expr::group));
            return transposed(&transposed(&rows).map(|column| self.vector(&column).map(Expr::group)));
        };
        let zero = y[0][0].graph().zero();
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let (cos, sin) = (self.matrix[a][a], self.matrix[b][a]);
        let w = (sin * (y[a][a] - y[b][b]).group() + cos * (y[a][b] + y[b][a]).group()).group();
        let mut turned = *y;
        turned[a][a] = y[a][a] - sin * w;
        turned[b][b] = y[b][b] + sin * w;
        turned[a][b] = cos * w - y[b][a];
        turned[b][a] = cos * w - y[a][b];
        let beside = |e: &dyn Fn(usize) -> Expr<'g>| {
            self.vector(&std::array::from_fn(|i| if i == axis { zero } else { e(i) })).map(Expr::group)
        };
        let (row, column) = (beside(&|i| y[axis][i]), beside(&|i| y[i][axis]));
        for i in [a, b] {
            turned[axis][i] = row[i];
            turned[i][axis] = column[i];
        }
        turned
    }
}

/// Through several turns, from the innermost axes out.
pub fn outward<'g>(turns: &[Turn<'g>], a: &Triple<'g>) -> Triple<'g> {
    turns.iter().rev().fold(*a, |a, turn| turn.vector(&a).map(Expr::group))
}

/// Through several turns, from the outermost axes in.
pub fn inward<'g>(turns: &[Turn<'g>], a: &Triple<'g>) -> Triple<'g> {
    turns.iter().fold(*a, |a, turn| turn.back(&a).map(Expr::group))
}

/// Angular velocity in the innermost axes, from that of the outermost.
pub fn angular_velocity<'g>(turns: &[Turn<'g>], outer: &Triple<'g>) -> Triple<'g> {
    turns.iter().fold(*outer, |omega, turn| add(&turn.back(&omega).map(Expr::group), &turn.spin).map(Expr::group))
}

/// Angular acceleration in the innermost axes: each turn adds `ω × spin + d(spin)/dt`, ω that of the axes before.
pub fn angular_acceleration<'g>(
    turns: &[Turn<'g>],
    [outer, outer_rate]: [&Triple<'g>; 2],
    along: &Map<u32, Expr<'g>>,
) -> Triple<'g> {
    let (mut omega, mut alpha) = (*outer, *outer_rate);
    for turn in turns {
        omega = turn.back(&omega).map(Expr::group);
        let gained = add(&cross(&omega, &turn.spin), &turn.spin.map(|e| e.derivative(along)));
        alpha = add(&turn.back(&alpha).map(Expr::group), &gained).map(Expr::group);
        omega = add(&omega, &turn.spin).map(Expr::group);
    }
    alpha
}
