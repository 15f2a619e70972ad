//! Pose and motion of a link: twist, its partial velocities and its acceleration at ż = 0. Components are in the axes
//! of the link, the pole is its O; the pose is seen by the observer.

use crate::algebra::Expr;

use crate::mechanics::kinematics::turn::outward;
use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, dot, is_zero};
use crate::mechanics::links::link::identity;
use crate::mechanics::links::tree::{Pairs, Tree};

/// A linear and an angular part.
type Pair<'g> = (Triple<'g>, Triple<'g>);

impl<'g> Tree<'g> {
    /// b, then R row by row.
    pub fn pose_of(&self, k: usize) -> Vec<Expr<'g>> {
        let link = &self.links[k];
        link.position.iter().chain(link.rotation.iter().flatten()).copied().collect()
    }

    /// u, then ω.
    pub fn twist_of(&self, k: usize) -> Vec<Expr<'g>> {
        let (linear, angular) = self.links[k].twist();
        linear.into_iter().chain(angular).collect()
    }

    /// The acceleration of O, then ω̇, of what all links have at ż = 0.
    pub fn bias_of(&self, k: usize, accelerations: &Pairs<'g>) -> Vec<Expr<'g>> {
        let (link, (linear, angular)) = (&self.links[k], &accelerations[k]);
        let angular = link.in_body_axes(&link.frame.body_vector(*angular));
        link.in_body_axes(linear).into_iter().chain(angular).collect()
    }

    /// ∂(u, ω)/∂z row by row, in two ways: carried outward from the links that the speeds move, and with axes and
    /// levers of these links gathered inward.
    pub fn jacobians_of(&self, k: usize) -> [Vec<Expr<'g>>; 2] {
        let outward = (0..self.speed_count()).map(|speed| self.motion(k, speed)).collect();
        [outward, self.columns_from(k)].map(|columns: Vec<Pair<'g>>| self.rows_in_axes_of(k, &columns))
    }

    /// Rate of the Jacobian as the observer sees it, with components in the axes of the link: Rᵀ d(R J)/dt, row by row.
    pub fn jacobian_rates_of(&self, k: usize) -> [Vec<Expr<'g>>; 2] {
        let (_, spin) = self.links[k].twist();
        self.jacobians_of(k).map(|rows| {
            let columns = rows.len() / 6;
            let rate = |first: usize, column: usize| -> Triple<'g> {
                let own: Triple<'g> = std::array::from_fn(|i| rows[(first + i) * columns + column]);
                add(&own.map(|e| e.derivative(self.rates())), &cross(&spin, &own)).map(Expr::group)
            };
            let rates: Vec<Pair<'g>> = (0..columns).map(|column| (rate(0, column), rate(3, column))).collect();
            rows_of(&rates)
        })
    }

    /// ∂v_O/∂z and ∂ω/∂z in working axes. On the way to the root `axes` are those of the link seen from the axes of k,
    /// row by row, and `lever` is from its O to that of k.
    fn columns_from(&self, k: usize) -> Vec<Pair<'g>> {
        let none = [self.graph.zero(); 3];
        let mut columns = vec![(none, none); self.speed_count()];
        let (mut axes, mut lever, mut next) = (identity(self.graph), none, Some(k));
        while let Some(at) = next {
            let link = &self.links[at];
            let seen = |a: &Triple<'g>| axes.map(|row| dot(&row, a).group());
            for (speed, (linear, angular)) in columns.iter_mut().enumerate() {
                if link.is_moved_by(speed) {
                    let own = seen(&link.frame.resolve(&link.linear_rows[speed], Axes::Body));
                    let turn = seen(&link.angular_rows[speed]);
                    let moved = if is_zero(&turn) { own } else { add(&own, &cross(&turn, &lever)) };
                    *linear = add(linear, &moved).map(Expr::group);
                    *angular = add(angular, &turn).map(Expr::group);
                }
            }
            axes = axes.map(|row| outward(&link.joint.turns, &row));
            let offset = axes.map(|row| dot(&row, &link.joint.offset));
            lever = add(&lever, &offset).map(Expr::group);
            next = link.parent;
        }
        columns
    }

    fn rows_in_axes_of(&self, k: usize, columns: &[Pair<'g>]) -> Vec<Expr<'g>> {
        let link = &self.links[k];
        let own = |a: &Triple<'g>| link.in_body_axes(&link.frame.body_vector(*a));
        let columns: Vec<Pair<'g>> = columns.iter().map(|(linear, angular)| (own(linear), own(angular))).collect();
        rows_of(&columns)
    }
}

/// A matrix row by row, the linear ones first.
fn rows_of<'g>(columns: &[Pair<'g>]) -> Vec<Expr<'g>> {
    let linear = (0..3).flat_map(|i| columns.iter().map(move |(linear, _)| linear[i]));
    let angular = (0..3).flat_map(|i| columns.iter().map(move |(_, angular)| angular[i]));
    linear.chain(angular).collect()
}
