//! Derivatives of ż by parameters: `−A⁻¹ ∂(∂C/∂ż)/∂p` at fixed ż, with the residual of links differentiated by
//! recursion.
//!
//! What a parameter does to joints, partial velocities and gravity is a change like that along a coordinate (see
//! [`rigid`](super::rigid)), and loads are differentiated as they are written. What it does to matter is a change of
//! moments: the forces of inertia are linear in these, so each link whose moments change is pushed, where it moves as
//! it does, by forces of inertia of matter that has the derivatives for its moments. How such a push on a link moves a
//! speed is, by the symmetry of A, the virtual velocity that the link has under a column of A⁻¹: found once for all
//! links and speeds, it takes six products a speed for any parameter, in place of a projection and a substitution.

use crate::algebra::{Expr, Graph};

use crate::mechanics::derivatives::implicit::Factors;
use crate::mechanics::derivatives::rigid::{Pair, Rates, ResidualMotion};
use crate::mechanics::derivatives::second::velocities;
use crate::mechanics::kinematics::vector::{Triple, add, cross, dot, is_zero, scale};
use crate::mechanics::links::inertia::{Inertia, acceleration_gradient, apply};
use crate::mechanics::links::link::Link;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::system::System;
use crate::mechanics::tidy::{sums, tidy};

/// Ways in which pushes on links are solved for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum PushSolution {
    /// Gathered and projected, then as any other right-hand side.
    Projected,
    /// Paired with what links do under the columns of A⁻¹.
    Paired,
}

/// Changes of ∂C/∂ż along one direction.
struct Change<'g> {
    rows: Vec<Expr<'g>>,
    /// Forces of inertia of links that have more of matter, at their O.
    pushes: Vec<(usize, Pair<'g>)>,
    /// Part that the speeds of floating links take of the change of their accelerations at once.
    taken: Vec<Expr<'g>>,
}

impl<'g> System<'g> {
    /// The derivatives of ż along directions of parameters, one after the other, in the ways that are worth trying.
    /// None where the residual is not that of links alone.
    pub fn accelerations_by_parameters(&self, directions: &[Rates<'g>]) -> Vec<Vec<Expr<'g>>> {
        if !self.is_sum_over_links() || !self.rotors_are_plain() {
            return Vec::new();
        }
        let Some(&inertia) = self.scene.tree.inertias(self.is_long()).first() else { return Vec::new() };
        let way = |factors: &Factors<'g>| self.ways_by_parameters(inertia, factors, directions);
        Factors::of(self).iter().filter_map(way).flatten().collect()
    }

    fn ways_by_parameters(
        &self,
        inertia: Inertia,
        factors: &Factors<'g>,
        directions: &[Rates<'g>],
    ) -> Option<[Vec<Expr<'g>>; 2]> {
        let (_, motion) = self.solved(inertia, factors)?;
        let changes = self.changes(&motion, directions);
        let ways = [PushSolution::Projected, PushSolution::Paired];
        Some(ways.map(|pushed| solutions(&motion, factors, &changes, pushed).concat()))
    }

    fn changes(&self, motion: &ResidualMotion<'_, 'g>, directions: &[Rates<'g>]) -> Vec<Change<'g>> {
        let beside = self.beside();
        let accelerated: Vec<AccelerationField<'g>> =
            (0..motion.tree.links.len()).map(|k| AccelerationField::of(motion, k)).collect();
        let derivatives = motion.derivatives(directions).into_iter().zip(directions);
        let changes = derivatives.map(|(change, direction)| {
            let beside: Vec<Expr<'g>> = beside.iter().map(|e| motion.rate(*e, direction)).collect();
            Change {
                rows: sums(&change.residual, &beside),
                pushes: pushes(motion, &accelerated, direction),
                taken: change.taken,
            }
        });
        changes.collect()
    }
}

/// Acceleration field of a link, which acts on its moments.
struct AccelerationField<'g> {
    acceleration: Triple<'g>,
    spin_rate: Triple<'g>,
    spin: Triple<'g>,
    /// Ξ.
    field: [Triple<'g>; 3],
}

impl<'g> AccelerationField<'g> {
    fn of(motion: &ResidualMotion<'_, 'g>, k: usize) -> Self {
        let (acceleration, spin_rate) = motion.acceleration(k);
        let spin = motion.tree.links[k].angular_velocity;
        Self { acceleration, spin_rate, spin, field: acceleration_gradient(&spin, &spin_rate) }
    }

    /// `∫(a_P − g) dm` and `∫x × (a_P − g) dm`.
    fn force(&self, moments: &Moments<'g>) -> Pair<'g> {
        let first = &moments.first;
        let tensor = moments.inertia().map(|row| row.map(tidy));
        let linear = add(&scale(moments.mass, &self.acceleration), &apply(&self.field, first));
        let turning = cross(&self.spin, &apply(&tensor, &self.spin));
        let angular = add(&add(&cross(first, &self.acceleration), &apply(&tensor, &self.spin_rate)), &turning);
        (linear.map(Expr::group), angular.map(Expr::group))
    }
}

/// Pushes on links by the moments of each link by itself: matter that moves with a parent as well is left where it is.
/// Joints that change, which say what moves with a parent, by those that are left.
fn pushes<'g>(
    motion: &ResidualMotion<'_, 'g>,
    accelerated: &[AccelerationField<'g>],
    direction: &Rates<'g>,
) -> Vec<(usize, Pair<'g>)> {
    let links = &motion.tree.links;
    let displaced = |link: &Link<'g>| {
        let (turn, shift) = motion.displacement(link, direction);
        !is_zero(&turn) || !is_zero(&shift)
    };
    let regrouped = links.iter().any(displaced);
    let push = |(k, link): (usize, &Link<'g>)| {
        let moments = if regrouped { link.moments_in_body } else { link.matter.moments(motion.tree.graph) };
        let more = moments.map(|e| e.derivative(direction));
        (!more.is_zero()).then(|| (k, accelerated[k].force(&link.turned_moments(&more))))
    };
    links.iter().enumerate().filter_map(push).collect()
}

/// The derivatives of ż, direction by direction.
fn solutions<'g>(
    motion: &ResidualMotion<'_, 'g>,
    factors: &Factors<'g>,
    changes: &[Change<'g>],
    pushed: PushSolution,
) -> Vec<Vec<Expr<'g>>> {
    let whole = |change: &Change<'g>| match pushed {
        PushSolution::Projected => projected(motion, change),
        PushSolution::Paired => change.rows.clone(),
    };
    let rights: Vec<Vec<Expr<'g>>> =
        changes.iter().map(|change| whole(change).into_iter().map(|e| -e).collect()).collect();
    let moved = match pushed {
        PushSolution::Projected => factors.solve_each(&rights),
        PushSolution::Paired => paired(motion, factors, &rights, changes),
    };
    moved.iter().zip(changes).map(|(solution, change)| sums(solution, &change.taken)).collect()
}

/// Rows with those of what pushes links.
fn projected<'g>(motion: &ResidualMotion<'_, 'g>, change: &Change<'g>) -> Vec<Expr<'g>> {
    let tree = motion.tree;
    let mut rows = change.rows.clone();
    for &(link, (mut linear, mut angular)) in &change.pushes {
        let mut at = link;
        loop {
            let above = &tree.links[at];
            for speed in (0..rows.len()).filter(|&speed| above.is_moved_by(speed)) {
                rows[speed] = rows[speed] + above.project(speed, &above.frame.body_vector(linear), &angular);
            }
            let Some(parent) = above.parent else { break };
            (linear, angular) = tree.carried(at, &linear, &angular);
            (linear, angular) = (linear.map(Expr::group), angular.map(Expr::group));
            at = parent;
        }
    }
    rows
}

/// A⁻¹ times the rows, and what pushes links, by what links do under the columns of A⁻¹.
fn paired<'g>(
    motion: &ResidualMotion<'_, 'g>,
    factors: &Factors<'g>,
    rights: &[Vec<Expr<'g>>],
    changes: &[Change<'g>],
) -> Vec<Vec<Expr<'g>>> {
    let count = motion.tree.speed_count();
    let units: Vec<Vec<Expr<'g>>> = (0..count).map(|k| unit(motion.tree.graph, k, count)).collect();
    let inverse = factors.solve_each(&units);
    let inverse: Vec<Vec<Expr<'g>>> = inverse.iter().map(|column| column.iter().map(|e| e.group()).collect()).collect();
    let motions: Vec<Vec<Pair<'g>>> = inverse.iter().map(|column| velocities(motion, column)).collect();
    let of_change = |(right, change): (&Vec<Expr<'g>>, &Change<'g>)| {
        let of_speed = |(column, motions): (&Vec<Expr<'g>>, &Vec<Pair<'g>>)| {
            let own: Expr<'g> = column.iter().zip(right).map(|(a, b)| *a * *b).sum();
            let pushes = change.pushes.iter();
            pushes.fold(own, |sum, (k, push)| sum - dot(&motions[*k].0, &push.0) - dot(&motions[*k].1, &push.1))
        };
        inverse.iter().zip(&motions).map(of_speed).collect()
    };
    rights.iter().zip(changes).map(of_change).collect()
}

fn unit<'g>(graph: &'g Graph, k: usize, count: usize) -> Vec<Expr<'g>> {
    (0..count).map(|i| if i == k { graph.one() } else { graph.zero() }).collect()
}
