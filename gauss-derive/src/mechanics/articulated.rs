//! A x = r solved link by link: a quadratic function of the motion of all links is minimised over the speeds of the leaves
//! first, which leaves a quadratic function of their parents' motion alone. The work grows with the number of links, where
//! that of a factorisation of A grows with its cube.
//!
//! This is Gaussian elimination in an order that never forms A, and the *articulated-body inertia* of a link (Featherstone,
//! Rigid Body Dynamics Algorithms, chapter 7) is what the elimination leaves at it.

use crate::algebra::Expr;

use super::link::Link;
use super::moments::Moments;
use super::tree::Tree;
use super::turn::{Turn, inward};
use super::vector::{Axes, Triple, add, cross, cross_matrix, dot, subtract};

type Matrix<'g> = [Triple<'g>; 3];

/// `F = linear·a + mixed·α`, `N = mixedᵀ·a + angular·α`: what a motion (a, α) of O asks for.
#[derive(Clone, Copy)]
struct Inertia<'g> {
    linear: Matrix<'g>,
    mixed: Matrix<'g>,
    angular: Matrix<'g>,
}

/// A linear and an angular part at O, working axes.
type Pair<'g> = (Triple<'g>, Triple<'g>);

/// A speed when it is eliminated: its partial velocity, what that asks for, and the reciprocal of the pivot.
struct Pivot<'g> {
    speed: usize,
    row: Pair<'g>,
    response: Pair<'g>,
    inverse: Expr<'g>,
}

/// Pivots of every link, in the order of elimination.
pub struct Articulated<'a, 'g> {
    tree: &'a Tree<'g>,
    pivots: Vec<Vec<Pivot<'g>>>,
}

impl<'a, 'g> Articulated<'a, 'g> {
    /// `None` when a speed moves several links in ways of their own, or there is fluid.
    pub fn new(tree: &'a Tree<'g>) -> Option<Self> {
        let count = tree.speed_count();
        let once = |speed: usize| tree.links.iter().filter(|link| link.is_moved_by(speed)).count() == 1;
        let dry = |link: &Link<'g>| link.body().is_none_or(|body| body.added_mass.is_none());
        if !(0..count).all(once) || !tree.links.iter().all(dry) {
            return None;
        }
        let mut inertias: Vec<Inertia<'g>> = tree.links.iter().map(|link| Inertia::of(&link.moments)).collect();
        let mut pivots: Vec<Vec<Pivot<'g>>> = tree.links.iter().map(|_| Vec::new()).collect();
        for k in (0..tree.links.len()).rev() {
            let link = &tree.links[k];
            for speed in (0..count).filter(|&speed| link.is_moved_by(speed)) {
                let row = (link.frame.resolve(&link.linear_rows[speed], Axes::Body), link.angular_rows[speed]);
                let pivot = Pivot::new(speed, row, &inertias[k]);
                inertias[k] = inertias[k].without(&pivot);
                pivots[k].push(pivot);
            }
            if let Some(parent) = link.parent {
                let carried = inertias[k].turned(&link.joint.turns).shifted(&link.joint.offset);
                inertias[parent] = inertias[parent].plus(&carried);
            }
        }
        Some(Self { tree, pivots })
    }

    /// x with A x = right.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let zero = self.tree.graph.zero();
        let links = &self.tree.links;
        let nothing: Pair<'g> = ([zero; 3], [zero; 3]);
        let mut asked = vec![nothing; links.len()];
        let mut reduced = right.to_vec();
        for k in (0..links.len()).rev() {
            for pivot in &self.pivots[k] {
                let rest = right[pivot.speed] - pair(&pivot.row, &asked[k]);
                reduced[pivot.speed] = rest.group();
                let share = (reduced[pivot.speed] * pivot.inverse).group();
                asked[k] = moved(&asked[k], share, &pivot.response);
            }
            if let Some(parent) = links[k].parent {
                let (linear, angular) = self.tree.carried(k, &asked[k].0, &asked[k].1);
                asked[parent] =
                    (add(&asked[parent].0, &linear).map(Expr::group), add(&asked[parent].1, &angular).map(Expr::group));
            }
        }
        let mut solution = vec![zero; right.len()];
        let mut motions: Vec<Pair<'g>> = Vec::with_capacity(links.len());
        for (k, link) in links.iter().enumerate() {
            let mut motion = match link.parent {
                None => nothing,
                Some(parent) => {
                    let (linear, angular) = &motions[parent];
                    let joint = &link.joint;
                    let carried = add(linear, &cross(angular, &joint.offset)).map(Expr::group);
                    (inward(&joint.turns, &carried), inward(&joint.turns, angular))
                }
            };
            for pivot in self.pivots[k].iter().rev() {
                let rest = reduced[pivot.speed] - pair(&pivot.response, &motion);
                solution[pivot.speed] = (rest.group() * pivot.inverse).group();
                motion = moved(&motion, solution[pivot.speed], &pivot.row);
            }
            motions.push(motion);
        }
        solution
    }
}

fn pair<'g>(a: &Pair<'g>, b: &Pair<'g>) -> Expr<'g> {
    dot(&a.0, &b.0) + dot(&a.1, &b.1)
}

/// `a + factor·b`.
fn moved<'g>(a: &Pair<'g>, factor: Expr<'g>, b: &Pair<'g>) -> Pair<'g> {
    let sum = |a: &Triple<'g>, b: &Triple<'g>| std::array::from_fn(|i| (a[i] + factor * b[i]).group());
    (sum(&a.0, &b.0), sum(&a.1, &b.1))
}

impl<'g> Pivot<'g> {
    fn new(speed: usize, row: Pair<'g>, inertia: &Inertia<'g>) -> Self {
        let response = inertia.apply(&row);
        let inverse = pair(&row, &response).group().recip();
        Self { speed, row, response, inverse }
    }
}

impl<'g> Inertia<'g> {
    fn of(moments: &Moments<'g>) -> Self {
        let zero = moments.mass.graph().zero();
        let linear = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { moments.mass } else { zero }));
        let mixed = cross_matrix(&moments.first.map(|e| -e));
        Self { linear, mixed, angular: moments.inertia().map(|row| row.map(Expr::group)) }
    }

    fn plus(&self, other: &Self) -> Self {
        let sum = |a: &Matrix<'g>, b: &Matrix<'g>| std::array::from_fn(|i| add(&a[i], &b[i]).map(Expr::group));
        Self {
            linear: sum(&self.linear, &other.linear),
            mixed: sum(&self.mixed, &other.mixed),
            angular: sum(&self.angular, &other.angular),
        }
    }

    fn apply(&self, (a, alpha): &Pair<'g>) -> Pair<'g> {
        let product = |m: &Matrix<'g>, v: &Triple<'g>| -> Triple<'g> { std::array::from_fn(|i| dot(&m[i], v)) };
        let force = add(&product(&self.linear, a), &product(&self.mixed, alpha)).map(Expr::group);
        let torque = add(&product(&transposed(&self.mixed), a), &product(&self.angular, alpha)).map(Expr::group);
        (force, torque)
    }

    /// What is left when the speed takes the value that is best for every motion of the rest.
    fn without(&self, pivot: &Pivot<'g>) -> Self {
        let (force, torque) = &pivot.response;
        let share = |a: &Triple<'g>| a.map(|e| (e * pivot.inverse).group());
        let (force_share, torque_share) = (share(force), share(torque));
        let symmetric = |m: &Matrix<'g>, part: &Triple<'g>, a: &Triple<'g>| -> Matrix<'g> {
            mirrored(|i, j| (m[i][j] - part[i] * a[j]).group())
        };
        Self {
            linear: symmetric(&self.linear, &force_share, force),
            mixed: std::array::from_fn(|i| {
                std::array::from_fn(|j| (self.mixed[i][j] - force[i] * torque_share[j]).group())
            }),
            angular: symmetric(&self.angular, &torque_share, torque),
        }
    }

    /// In the axes before the turns.
    fn turned(&self, turns: &[Turn<'g>]) -> Self {
        turns.iter().rev().fold(*self, |inertia, turn| {
            let rows: Matrix<'g> = std::array::from_fn(|i| turn.vector(&inertia.mixed[i]).map(Expr::group));
            let columns = transposed(&rows).map(|column| turn.vector(&column).map(Expr::group));
            Self {
                linear: turn.tensor(&inertia.linear),
                mixed: transposed(&columns),
                angular: turn.tensor(&inertia.angular),
            }
        })
    }

    /// About a pole from which the old one is at r: `a` of the old is `a + α × r` of the new, and `r × F` joins the torque.
    fn shifted(&self, r: &Triple<'g>) -> Self {
        let turn = cross_matrix(r);
        let product = |a: &Matrix<'g>, b: &Matrix<'g>| -> Matrix<'g> {
            std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
        };
        let pulled = product(&self.linear, &turn);
        let mixed: Matrix<'g> = std::array::from_fn(|i| subtract(&self.mixed[i], &pulled[i]).map(Expr::group));
        let (back, lifted) = (product(&transposed(&self.mixed), &turn), product(&turn, &mixed));
        let angular = mirrored(|i, j| (self.angular[i][j] - back[i][j] + lifted[i][j]).group());
        Self { linear: self.linear, mixed, angular }
    }
}

fn transposed<'g>(m: &Matrix<'g>) -> Matrix<'g> {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// A symmetric matrix from its upper triangle.
fn mirrored<'g>(entry: impl Fn(usize, usize) -> Expr<'g>) -> Matrix<'g> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i.min(j), i.max(j))))
}
