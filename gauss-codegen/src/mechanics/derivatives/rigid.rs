//! Derivatives of ∂C/∂ż of links by recursion: whatever displaces a joint moves all that hangs on it rigidly.
//!
//! Changes are taken as a link sees them, δ̂y = δy − Φ × y with its turn Φ. In a link that hangs on a displaced joint
//! nothing changes then but how the whole moves: its angular velocity by W, and the accelerations of its points by
//! `e + α′ × x + 2 W × (v_P − v_O)`. So the change of the forces of inertia of all that hangs there is linear in (e,
//! α′, W), and the coefficients are moments that are gathered once: m, ∫x dm, ∫x xᵀ dm, and with y = v_P − v_O ∫y dm,
//! ∫y xᵀ dm. Beyond the joint, toward the root, all of it acts as one force, turned and moved with the joint.
//!
//! The same holds along a speed or time, where joints are not displaced but move in another way. Branches that do not
//! meet have nothing in common, and no term. (With joints of one degree of freedom, and partial derivatives by angles,
//! these are the sums of Singh, Russell & Wensing, Efficient analytical derivatives of rigid body dynamics using
//! spatial vector algebra, 2022.)

use crate::algebra::{Expr, Map, Rational, Substitution};

use crate::mechanics::kinematics::turn::{Turn, inward, outward};
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, cross_matrix, dot, is_zero, scale};
use crate::mechanics::links::floating::Floating;
use crate::mechanics::links::inertia::Inertia;
use crate::mechanics::links::link::Link;
use crate::mechanics::links::tree::{Pairs, Tree};
use crate::mechanics::loads::forces::Loads;
use crate::mechanics::matter::moments::Moments;

/// Rates of symbols, by their keys.
pub type Rates<'g> = Map<u32, Expr<'g>>;

/// A linear and an angular part.
pub type Pair<'g> = (Triple<'g>, Triple<'g>);

/// Contribution of one joint to the changes of all that hangs on it.
#[derive(Clone)]
pub struct JointChange<'g> {
    /// Turn of the link and displacement of its O beyond its parent's, in its axes.
    pub turn: Triple<'g>,
    pub shift: Triple<'g>,
    /// Change of v_O beyond its parent's.
    pub drift: Triple<'g>,
    /// e, α′ and 2W.
    pub linear: Triple<'g>,
    pub angular: Triple<'g>,
    pub twice_spin: Triple<'g>,
}

/// Motion of two links as their joint reads it.
pub struct JointMotion<'g> {
    /// ω and ω̇ of the parent, in its axes.
    pub spin: Triple<'g>,
    pub spin_rate: Triple<'g>,
    /// a_O − g and ω of the link, in its own.
    pub acceleration: Triple<'g>,
    pub own_spin: Triple<'g>,
}

/// Moments of all that hangs on a link, about its O: of its matter, and with velocities relative to O.
#[derive(Clone)]
pub struct SubtreeMoments<'g> {
    pub moments: Moments<'g>,
    /// ∫y dm and ∫y xᵀ dm.
    pub momentum: Triple<'g>,
    pub mixed: [Triple<'g>; 3],
}

/// A row of ∂C/∂ż as a linear function of a change of all that hangs on a link.
pub struct ResidualRow<'g> {
    pub linear: Triple<'g>,
    pub angular: Triple<'g>,
    pub twice_spin: Triple<'g>,
}

/// ż, by its symbols, and what it is beyond what links that float take of their accelerations at once.
pub struct RateSymbols<'a, 'g> {
    pub rates: Rates<'g>,
    pub relative: &'a [Expr<'g>],
}

/// The motion whose residual is differentiated.
pub struct ResidualMotion<'a, 'g> {
    pub tree: &'a Tree<'g>,
    loads: &'a Loads<'g>,
    /// Rates of t, q and z, with symbols for ż.
    along: &'a Rates<'g>,
    /// ż in place of its symbols, where it is known.
    solved: Substitution<'g>,
    /// Accelerations of all links, with ż.
    accelerations: Pairs<'g>,
    /// Inertia of all that hangs on a link, at its O.
    pub forces: Vec<Pair<'g>>,
    pub gathered: Vec<SubtreeMoments<'g>>,
    floating: Vec<Option<Floating<'g>>>,
}

/// The derivatives along one direction.
pub struct ResidualDerivative<'g> {
    /// Rows of ∂C/∂ż, but for what `taken` has of it.
    pub residual: Vec<Expr<'g>>,
    /// Part that the speeds of floating links take of the change of their accelerations at once.
    pub taken: Vec<Expr<'g>>,
}

impl<'a, 'g> ResidualMotion<'a, 'g> {
    /// `along` has symbols for ż: at the ż that `solved` gives for each of them, or at any, where links that float take
    /// nothing of their accelerations at once. `None` where fluid moves with links.
    pub fn new(
        tree: &'a Tree<'g>,
        loads: &'a Loads<'g>,
        along: &'a Rates<'g>,
        solved: Option<RateSymbols<'_, 'g>>,
        inertia: Inertia,
    ) -> Option<Self> {
        let wet = |link: &Link<'g>| link.body().is_some_and(|b| b.added_mass.is_some() || b.displaced.is_some());
        if tree.links.iter().any(wet) {
            return None;
        }
        let floating = match &solved {
            Some(_) => Floating::of(&tree.links, tree.speed_count()),
            None => Vec::new(),
        };
        let (values, relative) = match solved {
            Some(RateSymbols { rates, relative }) => (rates, Some(relative)),
            None => (Rates::default(), None),
        };
        let substituted = |rate: &Expr<'g>| values.get(&rate.key()).copied().unwrap_or(*rate);
        let with_values: Rates<'g> = along.iter().map(|(&key, rate)| (key, substituted(rate))).collect();
        let (accelerations, forces) = tree.forces_of_inertia(&with_values, inertia, loads, relative);
        let body = |(k, (linear, angular)): (usize, (Vector<'g>, Triple<'g>))| {
            (tree.links[k].frame.resolve(&linear, Axes::Body), angular)
        };
        let forces = forces.into_iter().enumerate().map(body).collect();
        let gathered = gathered(tree);
        let solved = Substitution::new(values);
        Some(Self { tree, loads, along, solved, accelerations, forces, gathered, floating })
    }

    /// `a_O − g` and ω̇ of a link, working axes.
    pub fn acceleration(&self, k: usize) -> Pair<'g> {
        let (linear, angular) = &self.accelerations[k];
        (self.tree.links[k].frame.resolve(linear, Axes::Body), *angular)
    }

    /// Along each of the directions, rates of symbols that moments of links do not depend on.
    pub fn derivatives(&self, directions: &[Rates<'g>]) -> Vec<ResidualDerivative<'g>> {
        let (tree, zero) = (self.tree, self.tree.graph.zero());
        let count = tree.speed_count();
        let nothing = || ResidualDerivative { residual: vec![zero; count], taken: vec![zero; count] };
        let mut derivatives: Vec<ResidualDerivative<'g>> = directions.iter().map(|_| nothing()).collect();
        let along_each = directions.iter().zip(&mut derivatives);
        let changes: Vec<Vec<Option<JointChange<'g>>>> =
            along_each.map(|(d, out)| self.changes(d, &mut out.taken)).collect();
        for k in 0..tree.links.len() {
            for speed in (0..count).filter(|&speed| tree.links[k].is_moved_by(speed)) {
                self.add_from_above(k, speed, &changes, &mut derivatives);
            }
        }
        for ((direction, changes), out) in directions.iter().zip(&changes).zip(&mut derivatives) {
            self.add_from_below(direction, changes, &mut out.residual);
        }
        derivatives
    }

    /// Changes by every joint that changes.
    fn changes(&self, direction: &Rates<'g>, taken: &mut [Expr<'g>]) -> Vec<Option<JointChange<'g>>> {
        (0..self.tree.links.len()).map(|k| self.change(k, direction, taken)).collect()
    }

    fn change(&self, k: usize, direction: &Rates<'g>, taken: &mut [Expr<'g>]) -> Option<JointChange<'g>> {
        let link = &self.tree.links[k];
        let own = self.displacement(link, direction);
        let mut change = match link.parent {
            None => self.change_of_root(k, own, direction),
            Some(parent) => self.change_below(k, parent, &self.above(k, parent), own, direction),
        };
        if let Some(Some(floating)) = self.floating.get(k)
            && !is_zero(&change.linear)
        {
            let held = vec![false; taken.len()];
            let mut rates = vec![self.tree.graph.zero(); taken.len()];
            let rest = floating.taken_from(link, &link.frame.body_vector(change.linear), &held, &mut rates);
            taken.iter_mut().zip(rates).for_each(|(sum, rate)| *sum = *sum + rate);
            change.linear = link.frame.resolve(&rest, Axes::Body);
        }
        let parts = [&change.turn, &change.shift, &change.linear, &change.angular, &change.twice_spin];
        let changes = parts.into_iter().any(|part| !is_zero(part));
        changes.then_some(change)
    }

    /// The turn of a link beyond its parent's, in its axes, and the displacement of its O in its parent's.
    pub fn displacement(&self, link: &Link<'g>, direction: &Rates<'g>) -> Pair<'g> {
        let turn = self.turned(&link.own_joint.turns, direction);
        (turn, link.own_joint.offset.map(|e| self.rate(e, direction)))
    }

    /// Angles by which turns are turned along a direction, in the innermost axes.
    pub fn turned(&self, turns: &[Turn<'g>], direction: &Rates<'g>) -> Triple<'g> {
        let none = [self.tree.graph.zero(); 3];
        turns.iter().fold(none, |sum, turn| add(&turn.back(&sum), &turn.displacement(direction)).map(Expr::group))
    }

    /// A derivative at the ż of the motion.
    pub fn rate(&self, e: Expr<'g>, direction: &Rates<'g>) -> Expr<'g> {
        self.solved.of(e.derivative(direction)).group()
    }

    /// The change of a vector as the link sees it, which is turned by as much.
    fn seen(&self, link: &Link<'g>, a: &Vector<'g>, turn: &Triple<'g>, direction: &Rates<'g>) -> Triple<'g> {
        let rate = |part: &Triple<'g>| part.map(|e| self.rate(e, direction));
        let frame = &link.frame;
        let left_behind = frame.resolve(&Vector { body: [self.tree.graph.zero(); 3], space: a.space }, Axes::Body);
        let left_behind = if link.works_in_body_axes() { left_behind } else { add(&left_behind, &a.body) };
        let change = frame.resolve(&Vector { body: rate(&a.body), space: rate(&a.space) }, Axes::Body);
        add(&change, &cross(&self.triple(left_behind), turn)).map(Expr::group)
    }

    fn triple(&self, a: Triple<'g>) -> Triple<'g> {
        a.map(|e| self.solved.of(e).group())
    }

    pub fn change_of_root(&self, k: usize, (turn, shift): Pair<'g>, direction: &Rates<'g>) -> JointChange<'g> {
        let link = &self.tree.links[k];
        let frame = &link.frame;
        let omega = &link.angular_velocity;
        let observed = frame.derivative(&link.velocity, self.along, &frame.body_vector(*omega));
        let fields = self.tree.gravity.into_iter().chain(self.loads.field_on(k));
        let a = fields.fold(observed, |a, g| a.minus(&frame.space_vector(g)));
        let spin = self.seen(link, &frame.body_vector(*omega), &turn, direction);
        let alpha = omega.map(|e| e.derivative(self.along));
        let turning = self.seen(link, &frame.body_vector(alpha), &turn, direction);
        JointChange {
            turn,
            shift,
            drift: shift.map(|_| self.tree.graph.zero()),
            linear: self.seen(link, &a, &turn, direction),
            angular: add(&turning, &cross(omega, &spin)).map(Expr::group),
            twice_spin: twice(&spin),
        }
    }

    /// Motion of two links as it is.
    pub fn above(&self, k: usize, parent: usize) -> JointMotion<'g> {
        let link = &self.tree.links[k];
        JointMotion {
            spin: self.tree.links[parent].angular_velocity,
            spin_rate: self.accelerations[parent].1,
            acceleration: link.frame.resolve(&self.accelerations[k].0, Axes::Body),
            own_spin: link.angular_velocity,
        }
    }

    /// Change by a joint between two links.
    pub fn change_below(
        &self,
        k: usize,
        parent: usize,
        told: &JointMotion<'g>,
        (turn, shift): Pair<'g>,
        direction: &Rates<'g>,
    ) -> JointChange<'g> {
        let (link, above) = (&self.tree.links[k], &self.tree.links[parent]);
        let turns = &link.joint.turns;
        let named = |a: Triple<'g>| a.map(Expr::group);
        let above_axes = |a: &Triple<'g>| named(above.in_working_axes(a, Axes::Body));
        // The motion of the parent, in the axes of the link.
        let (omega, alpha) = (inward(turns, &told.spin), inward(turns, &told.spin_rate));
        let rate = |a: &Triple<'g>| a.map(|e| self.rate(e, direction));
        let spin_rate = link.spin.map(|e| e.derivative(self.along));
        let (more_spin, more_spin_rate) = (rate(&link.spin), rate(&spin_rate));
        let offset_rate = &link.own_joint.offset_rate;
        let more_rate = above_axes(&rate(offset_rate));
        let more_acceleration = above_axes(&rate(&offset_rate.map(|e| e.derivative(self.along))));
        let shift = above_axes(&shift);
        let turned = named(cross(&omega, &turn));
        let spin = named(add(&turned, &more_spin));
        let both = add(&omega, &told.own_spin);
        let angular =
            [cross(&alpha, &turn), cross(&omega, &turned), named(cross(&named(both), &more_spin)), more_spin_rate];
        let angular = angular.iter().skip(1).fold(angular[0], |sum, part| add(&sum, part));
        let moved =
            |w: &Triple<'g>, alpha: &Triple<'g>, r: &Triple<'g>| add(&cross(alpha, r), &cross(w, &named(cross(w, r))));
        let own = add(&moved(&told.spin, &told.spin_rate, &shift), &more_acceleration);
        let own = add(&own, &twice(&named(cross(&told.spin, &more_rate))));
        let linear = add(&cross(&told.acceleration, &turn), &inward(turns, &named(own)));
        JointChange {
            turn,
            shift: inward(turns, &shift),
            drift: inward(turns, &named(add(&cross(&told.spin, &shift), &more_rate))),
            linear: named(linear),
            angular: named(angular),
            twice_spin: twice(&spin),
        }
    }

    /// Adds the effect of changes of a link and of its ancestors on one row of the link.
    fn add_from_above(
        &self,
        k: usize,
        speed: usize,
        changes: &[Vec<Option<JointChange<'g>>>],
        derivatives: &mut [ResidualDerivative<'g>],
    ) {
        let links = &self.tree.links;
        let link = &links[k];
        let own = (link.frame.resolve(&link.linear_rows[speed], Axes::Body), link.angular_rows[speed]);
        let (linear, angular) = link.momentum(&self.gathered[k].moments, &link.linear_rows[speed], &own.1);
        let linear = link.frame.resolve(&linear, Axes::Body);
        let mut row = ResidualRow { linear, angular, twice_spin: self.gathered[k].response(&own) };
        let mut at = k;
        loop {
            for (changes, out) in changes.iter().zip(&mut *derivatives) {
                if let Some(change) = &changes[at] {
                    out.residual[speed] = out.residual[speed] + row.times(change);
                }
            }
            let Some(parent) = links[at].parent else { break };
            row = self.row_above(at, parent, &row);
            at = parent;
        }
    }

    /// The same function of a change of the parent.
    pub fn row_above(&self, k: usize, parent: usize, row: &ResidualRow<'g>) -> ResidualRow<'g> {
        let (linear, angular) = self.tree.carried(k, &row.linear, &row.angular);
        let turns = &self.tree.links[k].joint.turns;
        let (linear, angular) = (linear.map(Expr::group), angular.map(Expr::group));
        let spin = outward(turns, &row.twice_spin);
        let spin = add(&spin, &cross(&relative_velocity(self.tree, k, parent), &linear)).map(Expr::group);
        ResidualRow { linear, angular, twice_spin: spin }
    }

    /// Adds the effect of changes of joints on the rows of the links that they hang on, and of changes of partial
    /// velocities on their own.
    fn add_from_below(&self, direction: &Rates<'g>, changes: &[Option<JointChange<'g>>], residual: &mut [Expr<'g>]) {
        let links = &self.tree.links;
        let mut pending: Vec<Option<Pair<'g>>> = vec![None; links.len()];
        for k in (0..links.len()).rev() {
            let link = &links[k];
            for speed in (0..residual.len()).filter(|&speed| link.is_moved_by(speed)) {
                if let Some((linear, angular)) = &pending[k] {
                    let linear = link.frame.body_vector(*linear);
                    residual[speed] = residual[speed] + link.project(speed, &linear, angular);
                }
                let turn = changes[k].as_ref().map_or([self.tree.graph.zero(); 3], |change| change.turn);
                let (a, o) = self.change_of_row(link, speed, direction, &turn);
                residual[speed] = residual[speed] + dot(&a, &self.forces[k].0) + dot(&o, &self.forces[k].1);
            }
            let Some(parent) = link.parent else { continue };
            let own = changes[k].as_ref().map(|change| self.gathered[k].force(change, &self.forces[k]));
            let Some((linear, angular)) = sum(pending[k], own) else { continue };
            let (linear, angular) = self.tree.carried(k, &linear, &angular);
            pending[parent] = sum(pending[parent], Some((linear.map(Expr::group), angular.map(Expr::group))));
        }
    }

    /// As the link sees it.
    pub fn change_of_row(&self, link: &Link<'g>, speed: usize, direction: &Rates<'g>, turn: &Triple<'g>) -> Pair<'g> {
        let z = self.tree.speed(speed);
        if link.parent.is_none() {
            let seen = |a: &Vector<'g>| self.seen(link, a, turn, direction);
            return (seen(&link.linear_rows[speed]), seen(&link.frame.body_vector(link.angular_rows[speed])));
        }
        let rate = |a: &Triple<'g>| link.in_working_axes(&a.map(|e| self.rate(e.partial(z), direction)), Axes::Body);
        (rate(&link.velocity_beyond), link.spin.map(|e| self.rate(e.partial(z), direction)))
    }
}

impl<'g> SubtreeMoments<'g> {
    /// Moments of a link by itself: y = ω × x.
    fn of(link: &Link<'g>) -> Self {
        let (omega, moments) = (&link.angular_velocity, link.moments);
        let turn = cross_matrix(omega);
        let mixed = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|l| turn[i][l] * moments.second[l][j]).sum::<Expr<'g>>().group())
        });
        Self { moments, momentum: cross(omega, &moments.first).map(Expr::group), mixed }
    }

    /// ∂(row)/∂(2W), of a partial velocity (a, o): `∫y dm × a + tr(∫y xᵀ dm) o − (∫x yᵀ dm) o`.
    pub fn response(&self, (a, o): &Pair<'g>) -> Triple<'g> {
        let pushed = cross(&self.momentum, a);
        let mixed = &self.mixed;
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let own = (mixed[j][j] + mixed[k][k]).group() * o[i] - mixed[j][i] * o[j] - mixed[k][i] * o[k];
            (pushed[i] + own).group()
        })
    }

    /// Change of the forces that the joint hands on, about the O that is displaced; `forces` are those of now.
    pub fn force(&self, change: &JointChange<'g>, forces: &Pair<'g>) -> Pair<'g> {
        let Moments { mass, first, .. } = self.moments;
        let inertia = self.moments.inertia();
        let mixed = &self.mixed;
        let (e, alpha, spin) = (&change.linear, &change.angular, &change.twice_spin);
        let linear =
            [scale(mass, e), cross(alpha, &first), cross(spin, &self.momentum), cross(&change.turn, &forces.0)];
        let turning = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            (mixed[j][j] + mixed[k][k]).group() * spin[i] - mixed[i][j] * spin[j] - mixed[i][k] * spin[k]
        });
        let tensor = inertia.map(|row| dot(&row.map(Expr::group), alpha));
        let angular =
            [cross(&first, e), tensor, turning, cross(&change.turn, &forces.1), cross(&change.shift, &forces.0)];
        let total = |parts: &[Triple<'g>]| -> Triple<'g> {
            parts[1..].iter().fold(parts[0], |sum, part| add(&sum, part)).map(Expr::group)
        };
        (total(&linear), total(&angular))
    }
}

impl<'g> ResidualRow<'g> {
    pub fn times(&self, change: &JointChange<'g>) -> Expr<'g> {
        let spin = dot(&self.twice_spin, &change.twice_spin);
        dot(&self.linear, &change.linear) + dot(&self.angular, &change.angular) + spin
    }
}

/// Gathered moments of all links, leaves first.
fn gathered<'g>(tree: &Tree<'g>) -> Vec<SubtreeMoments<'g>> {
    let mut gathered: Vec<SubtreeMoments<'g>> = tree.links.iter().map(SubtreeMoments::of).collect();
    for k in (0..tree.links.len()).rev() {
        let link = &tree.links[k];
        let Some(parent) = link.parent else { continue };
        let turns = &link.joint.turns;
        let (r, d) = (&link.joint.offset, relative_velocity(tree, k, parent));
        let below = gathered[k].clone();
        let moments = below.moments.turned(turns).shifted(r);
        let momentum = outward(turns, &below.momentum);
        let mixed = turns.iter().rev().fold(below.mixed, |mixed, turn| turn.mixed(&mixed));
        let (mass, first) = (moments.mass, moments.first.map(Expr::group));
        let above = &mut gathered[parent];
        above.mixed = std::array::from_fn(|i| {
            std::array::from_fn(|j| (above.mixed[i][j] + mixed[i][j] + d[i] * first[j] + momentum[i] * r[j]).group())
        });
        above.momentum = add(&above.momentum, &add(&momentum, &scale(mass, &d))).map(Expr::group);
        above.moments = above.moments.plus(&moments).map(Expr::group);
    }
    gathered
}

/// v_O of a link beyond its parent's, in the parent's axes.
pub fn relative_velocity<'g>(tree: &Tree<'g>, k: usize, parent: usize) -> Triple<'g> {
    let joint = &tree.links[k].joint;
    add(&cross(&tree.links[parent].angular_velocity, &joint.offset), &joint.offset_rate).map(Expr::group)
}

pub fn twice<'g>(a: &Triple<'g>) -> Triple<'g> {
    a.map(|e| e.scale(Rational::from_integer(2)))
}

fn sum<'g>(a: Option<Pair<'g>>, b: Option<Pair<'g>>) -> Option<Pair<'g>> {
    match (a, b) {
        (Some(a), Some(b)) => Some((add(&a.0, &b.0).map(Expr::group), add(&a.1, &b.1).map(Expr::group))),
        (a, b) => a.or(b),
    }
}
