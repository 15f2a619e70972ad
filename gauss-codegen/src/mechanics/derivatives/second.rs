//! Second derivatives of `μ · ∂C/∂ż` of links by recursion, μ a generalised velocity that does not depend on the state.
//!
//! With the virtual velocities w_P that μ gives, `μ · ∂C/∂ż = ∫(a_P − g)·w_P dm`. What displaces a joint changes, as
//! all that hangs on it sees it, accelerations by `e + α′ × x + 2 W × y` (see [`rigid`](super::rigid)) and virtual
//! velocities by `ε + η × x`. So the derivative along one joint's change is linear in (e, α′, 2W, ε, η), with the
//! coefficients P = ∫w dm, Π = ∫x × w dm, Q = ∫y × w dm, and the force F and torque M that hangs there. A change of a
//! joint above is such a field again: it changes what the joint adds through the motion of the parent, and the
//! coefficients through moments that are gathered once, those and ∫w xᵀ dm. So a second derivative is a row of five
//! vectors, carried toward the root, times a change of five vectors there. What a joint adds to itself is
//! differentiated as it stands, with the parent's motion held.

use crate::algebra::{Expr, Graph, Map, Rational, Substitution};

use crate::mechanics::derivatives::rigid::{
    JointChange, JointMotion, Pair, Rates, ResidualMotion, ResidualRow, relative_velocity,
};
use crate::mechanics::kinematics::turn::{inward, outward};
use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, cross_matrix, dot, is_zero, scale, subtract};
use crate::mechanics::links::link::Link;

/// Contribution of one joint to the changes of all that hangs on it, virtual velocities among them.
struct Shift<'g> {
    change: JointChange<'g>,
    /// ε and η.
    of_virtual: Pair<'g>,
}

/// A row of five vectors: of a change of all that hangs on a link.
struct LongRow<'g> {
    row: ResidualRow<'g>,
    /// Coefficients of ε and η.
    of_virtual: Pair<'g>,
}

/// Virtual velocities of all that hangs on a link.
#[derive(Clone)]
struct VirtualMoments<'g> {
    /// P = ∫w dm, Π = ∫x × w dm, Q = ∫y × w dm, C = ∫w xᵀ dm.
    linear: Triple<'g>,
    angular: Triple<'g>,
    turning: Triple<'g>,
    mixed: [Triple<'g>; 3],
}

/// A motion, and μ.
pub struct WeightedMotion<'a, 'g> {
    motion: &'a ResidualMotion<'a, 'g>,
    weights: &'a [Expr<'g>],
    /// w_O and ν of every link, working axes.
    velocities: Vec<Pair<'g>>,
    sums: Vec<VirtualMoments<'g>>,
    held: JointSymbols<'g>,
}

/// Symbols in place of what a joint is told of the motion of its parent, and of its own.
struct JointSymbols<'g> {
    told: JointMotion<'g>,
    of_virtual: Pair<'g>,
}

impl<'a, 'g> WeightedMotion<'a, 'g> {
    /// `weights` are symbols.
    pub fn new(motion: &'a ResidualMotion<'a, 'g>, weights: &'a [Expr<'g>]) -> Self {
        let velocities = velocities(motion, weights);
        let sums = VirtualMoments::gathered(motion, &velocities);
        let held = JointSymbols::new(motion.tree.graph);
        Self { motion, weights, velocities, sums, held }
    }

    /// Along the first direction of each pair and then along the second.
    pub fn second_derivatives(&self, directions: &[Rates<'g>], pairs: &[(usize, usize)]) -> Vec<Expr<'g>> {
        let links = 0..self.motion.tree.links.len();
        let shifts: Vec<Vec<Option<Shift<'g>>>> =
            links.clone().map(|k| directions.iter().map(|d| self.shift(k, d)).collect()).collect();
        let mut derivatives = vec![self.motion.tree.graph.zero(); pairs.len()];
        for k in links {
            self.add_own(k, directions, &shifts[k], pairs, &mut derivatives);
            self.add_from_above(k, &shifts, pairs, &mut derivatives);
        }
        derivatives
    }

    /// Adds the second-order contribution of a joint alone.
    fn add_own(
        &self,
        k: usize,
        directions: &[Rates<'g>],
        shifts: &[Option<Shift<'g>>],
        pairs: &[(usize, usize)],
        derivatives: &mut [Expr<'g>],
    ) {
        let rows: Vec<Option<LongRow<'g>>> =
            shifts.iter().map(|shift| Some(self.row_of_moments(k, shift.as_ref()?))).collect();
        let alone: Vec<Option<Shift<'g>>> =
            directions.iter().zip(shifts).map(|(d, shift)| shift.as_ref().map(|_| self.held_shift(k, d))).collect();
        for (&(first, second), out) in pairs.iter().zip(derivatives) {
            if let (Some(row), Some(own), Some(after)) = (&rows[first], &alone[first], &shifts[second]) {
                let again = self.changed(k, own, &directions[second], after);
                *out = *out + row.times(after) + self.coefficients(k).times(&again);
            }
        }
    }

    /// Adds the contribution of a joint together with those that it hangs on.
    fn add_from_above(
        &self,
        k: usize,
        shifts: &[Vec<Option<Shift<'g>>>],
        pairs: &[(usize, usize)],
        derivatives: &mut [Expr<'g>],
    ) {
        let links = &self.motion.tree.links;
        let mut rows: Vec<Option<LongRow<'g>>> =
            shifts[k].iter().map(|shift| Some(self.row(k, shift.as_ref()?))).collect();
        let mut at = k;
        while let Some(parent) = links[at].parent {
            for row in rows.iter_mut().flatten() {
                *row = self.row_above(at, parent, row);
            }
            at = parent;
            for (&(first, second), out) in pairs.iter().zip(&mut *derivatives) {
                for (own, other) in [(first, second), (second, first)] {
                    if let (Some(row), Some(shift)) = (&rows[own], &shifts[at][other]) {
                        *out = *out + row.times(shift);
                    }
                }
            }
        }
    }

    fn shift(&self, k: usize, direction: &Rates<'g>) -> Option<Shift<'g>> {
        let link = &self.motion.tree.links[k];
        let shift = match link.parent {
            None => self.shift_of_root(k, direction),
            Some(parent) => {
                let told = self.motion.above(k, parent);
                self.shift_below(k, parent, &told, &self.velocities[parent], direction)
            }
        };
        (!shift.is_zero()).then_some(shift)
    }

    /// The same with the motion of the parent held.
    fn held_shift(&self, k: usize, direction: &Rates<'g>) -> Shift<'g> {
        match self.motion.tree.links[k].parent {
            None => self.shift_of_root(k, direction),
            Some(parent) => self.shift_below(k, parent, &self.held.told, &self.held.of_virtual, direction),
        }
    }

    fn shift_of_root(&self, k: usize, direction: &Rates<'g>) -> Shift<'g> {
        let link = &self.motion.tree.links[k];
        let change = self.motion.change_of_root(k, self.motion.displacement(link, direction), direction);
        let of_virtual = self.own_rows(link, direction, &change.turn);
        Shift { change, of_virtual }
    }

    fn shift_below(
        &self,
        k: usize,
        parent: usize,
        told: &JointMotion<'g>,
        (linear, angular): &Pair<'g>,
        direction: &Rates<'g>,
    ) -> Shift<'g> {
        let link = &self.motion.tree.links[k];
        let change = self.motion.change_below(k, parent, told, self.motion.displacement(link, direction), direction);
        let turns = &link.joint.turns;
        let named = |a: Triple<'g>| a.map(Expr::group);
        let linear = inward(turns, &named(add(linear, &cross(angular, &link.joint.offset))));
        let angular = inward(turns, angular);
        let (own_linear, own_angular) = self.own_rows(link, direction, &change.turn);
        let moved = add(&cross(&linear, &change.turn), &cross(&angular, &change.shift));
        let of_virtual = (named(add(&moved, &own_linear)), named(add(&cross(&angular, &change.turn), &own_angular)));
        Shift { change, of_virtual }
    }

    /// Changes of partial velocities, with μ.
    fn own_rows(&self, link: &Link<'g>, direction: &Rates<'g>, turn: &Triple<'g>) -> Pair<'g> {
        let none = [self.motion.tree.graph.zero(); 3];
        let moved = (0..self.weights.len()).filter(|&speed| link.is_moved_by(speed));
        moved.fold((none, none), |(linear, angular), speed| {
            let (a, o) = self.motion.change_of_row(link, speed, direction, turn);
            let weight = self.weights[speed];
            (add(&linear, &scale(weight, &a)), add(&angular, &scale(weight, &o)))
        })
    }

    /// The change along a direction, by the joint alone, of what it adds along another.
    fn changed(&self, k: usize, own: &Shift<'g>, direction: &Rates<'g>, after: &Shift<'g>) -> Shift<'g> {
        let motion = self.motion;
        let beyond = self.turn_beyond_axes(k, direction);
        let mut direction = direction.clone();
        let mut back = Map::default();
        if let Some(parent) = motion.tree.links[k].parent {
            let (told, held) = (motion.above(k, parent), &self.held);
            let none = [motion.tree.graph.zero(); 3];
            let above = self.turn_beyond_axes(parent, &direction);
            let (linear, angular) = &self.velocities[parent];
            let spin = half(&after.change.twice_spin);
            // What the parent sees stays as it is.
            for (symbols, value, seen, beyond) in [
                (&held.told.spin, &told.spin, &none, &above),
                (&held.told.spin_rate, &told.spin_rate, &none, &above),
                (&held.of_virtual.0, linear, &none, &above),
                (&held.of_virtual.1, angular, &none, &above),
                (&held.told.acceleration, &told.acceleration, &after.change.linear, &beyond),
                (&held.told.own_spin, &told.own_spin, &spin, &beyond),
            ] {
                let rates = subtract(seen, &cross(value, beyond));
                direction.extend(symbols.iter().map(|s| s.key()).zip(rates));
                back.extend(symbols.iter().map(|s| s.key()).zip(value.map(Expr::group)));
            }
        }
        let real = Substitution::new(back);
        own.map(|part| {
            let rate = part.map(|e| real.of(motion.rate(e, &direction)));
            let left = cross(&part.map(|e| real.of(e)), &beyond);
            add(&rate, &left).map(Expr::group)
        })
    }

    /// Angles by which a link is turned along a direction beyond its working axes, which may stand still.
    fn turn_beyond_axes(&self, k: usize, direction: &Rates<'g>) -> Triple<'g> {
        let link = &self.motion.tree.links[k];
        let (turn, _) = self.motion.displacement(link, direction);
        let own = subtract(&turn, &self.motion.turned(&link.joint.turns, direction));
        let Some(parent) = link.parent else { return own };
        let above = self.turn_beyond_axes(parent, direction);
        add(&inward(&link.joint.turns, &above), &own).map(Expr::group)
    }

    /// Coefficients of the changes that a joint adds, in `μ · ∂C/∂ż`.
    fn coefficients(&self, k: usize) -> LongRow<'g> {
        let VirtualMoments { linear, angular, turning, .. } = &self.sums[k];
        let row = ResidualRow { linear: *linear, angular: *angular, twice_spin: *turning };
        LongRow { row, of_virtual: self.motion.forces[k] }
    }

    /// Effect of a change of all that hangs on a link on the coefficients, as a row for the change that its joint adds.
    fn row_of_moments(&self, k: usize, shift: &Shift<'g>) -> LongRow<'g> {
        let gathered = &self.motion.gathered[k];
        let none = [self.motion.tree.graph.zero(); 3];
        let (e, o) = &shift.of_virtual;
        let (linear, angular) = gathered.moments.momentum(e, o);
        let linear = add(&scale(gathered.moments.mass, e), &linear);
        let mixed = &self.sums[k].mixed;
        let trace = mixed[0][0] + mixed[1][1] + mixed[2][2];
        let spin = half(&shift.change.twice_spin);
        let turned: Triple<'g> = std::array::from_fn(|i| dot(&mixed[i], &spin) - trace.group() * spin[i]);
        let twice_spin = add(&gathered.response(&shift.of_virtual), &turned);
        let still = JointChange { turn: none, shift: none, ..shift.change.clone() };
        let of_virtual = gathered.force(&still, &self.motion.forces[k]);
        LongRow { row: ResidualRow { linear, angular, twice_spin }, of_virtual }.named()
    }

    /// Effect of a change that comes from the parent on the contribution of a joint.
    fn row(&self, k: usize, shift: &Shift<'g>) -> LongRow<'g> {
        let JointChange { turn, shift: moved, drift, twice_spin, .. } = &shift.change;
        let VirtualMoments { linear: p, angular: pi, turning: q, .. } = &self.sums[k];
        let (force, torque) = &self.motion.forces[k];
        let LongRow { row, of_virtual } = self.row_of_moments(k, shift);
        let spin = half(twice_spin);
        let own = add(&cross(turn, q), &add(&cross(&spin, pi), &cross(drift, p)));
        let row = ResidualRow {
            linear: add(&row.linear, &cross(turn, p)),
            angular: add(&row.angular, &add(&cross(turn, pi), &cross(moved, p))),
            twice_spin: add(&row.twice_spin, &own),
        };
        let angular = add(&of_virtual.1, &add(&cross(turn, torque), &cross(moved, force)));
        LongRow { row, of_virtual: (add(&of_virtual.0, &cross(turn, force)), angular) }.named()
    }

    /// The same function of a change of the parent.
    fn row_above(&self, k: usize, parent: usize, row: &LongRow<'g>) -> LongRow<'g> {
        let (linear, angular) = self.motion.tree.carried(k, &row.of_virtual.0, &row.of_virtual.1);
        LongRow { row: self.motion.row_above(k, parent, &row.row), of_virtual: (linear, angular) }.named()
    }
}

impl<'g> JointSymbols<'g> {
    fn new(graph: &'g Graph) -> Self {
        let symbols = |name: &str| std::array::from_fn(|_| graph.symbol(name, name, false));
        let told = JointMotion {
            spin: symbols("ω"),
            spin_rate: symbols("α"),
            acceleration: symbols("a"),
            own_spin: symbols("ω"),
        };
        Self { told, of_virtual: (symbols("w"), symbols("ν")) }
    }
}

impl<'g> Shift<'g> {
    fn is_zero(&self) -> bool {
        let JointChange { turn, shift, drift, linear, angular, twice_spin } = &self.change;
        let parts = [turn, shift, drift, linear, angular, twice_spin, &self.of_virtual.0, &self.of_virtual.1];
        parts.into_iter().all(is_zero)
    }

    fn map(&self, f: impl Fn(&Triple<'g>) -> Triple<'g>) -> Self {
        let JointChange { turn, shift, drift, linear, angular, twice_spin } = &self.change;
        let change = JointChange {
            turn: f(turn),
            shift: f(shift),
            drift: f(drift),
            linear: f(linear),
            angular: f(angular),
            twice_spin: f(twice_spin),
        };
        Self { change, of_virtual: (f(&self.of_virtual.0), f(&self.of_virtual.1)) }
    }
}

impl<'g> LongRow<'g> {
    fn times(&self, shift: &Shift<'g>) -> Expr<'g> {
        let (linear, angular) = &self.of_virtual;
        self.row.times(&shift.change) + dot(linear, &shift.of_virtual.0) + dot(angular, &shift.of_virtual.1)
    }

    fn named(self) -> Self {
        let named = |a: Triple<'g>| a.map(Expr::group);
        let ResidualRow { linear, angular, twice_spin } = self.row;
        let row = ResidualRow { linear: named(linear), angular: named(angular), twice_spin: named(twice_spin) };
        Self { row, of_virtual: (named(self.of_virtual.0), named(self.of_virtual.1)) }
    }
}

impl<'g> VirtualMoments<'g> {
    /// Sums over a link by itself. `∫(ω × x) × (ν × x) dm = J (ω × ν)`.
    fn of(motion: &ResidualMotion<'_, 'g>, k: usize, (w, nu): &Pair<'g>) -> Self {
        let link = &motion.tree.links[k];
        let (omega, moments) = (&link.angular_velocity, link.moments);
        let (first, second) = (&moments.first, &moments.second);
        let (beside, angular) = moments.momentum(w, nu);
        let linear = add(&scale(moments.mass, w), &beside);
        let turned = cross(omega, nu).map(Expr::group);
        let turning = add(&cross(&cross(omega, first), w), &second.map(|row| dot(&row, &turned)));
        let field = cross_matrix(nu);
        let mixed = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own: Expr<'g> = (0..3).map(|l| field[i][l] * second[l][j]).sum();
                (w[i] * first[j] + own).group()
            })
        });
        let named = |a: Triple<'g>| a.map(Expr::group);
        Self { linear: named(linear), angular: named(angular), turning: named(turning), mixed }
    }

    /// Sums over all links, leaves first.
    fn gathered(motion: &ResidualMotion<'_, 'g>, velocities: &[Pair<'g>]) -> Vec<Self> {
        let tree = motion.tree;
        let mut sums: Vec<Self> = velocities.iter().enumerate().map(|(k, pair)| Self::of(motion, k, pair)).collect();
        for k in (0..sums.len()).rev() {
            let Some(parent) = tree.links[k].parent else { continue };
            let (turns, r) = (&tree.links[k].joint.turns, &tree.links[k].joint.offset);
            let d = relative_velocity(tree, k, parent);
            let below = sums[k].clone();
            let (linear, angular) = tree.carried(k, &below.linear, &below.angular);
            let turning = add(&outward(turns, &below.turning), &cross(&d, &linear));
            let mixed = turns.iter().rev().fold(below.mixed, |mixed, turn| turn.mixed(&mixed));
            let above = &mut sums[parent];
            above.linear = add(&above.linear, &linear).map(Expr::group);
            above.angular = add(&above.angular, &angular).map(Expr::group);
            above.turning = add(&above.turning, &turning).map(Expr::group);
            above.mixed = std::array::from_fn(|i| {
                std::array::from_fn(|j| (above.mixed[i][j] + mixed[i][j] + linear[i] * r[j]).group())
            });
        }
        sums
    }
}

/// The velocities that μ gives.
pub(super) fn velocities<'g>(motion: &ResidualMotion<'_, 'g>, weights: &[Expr<'g>]) -> Vec<Pair<'g>> {
    let none = [motion.tree.graph.zero(); 3];
    let mut velocities: Vec<Pair<'g>> = Vec::with_capacity(motion.tree.links.len());
    for link in &motion.tree.links {
        let (mut linear, mut angular) = (none, none);
        if let Some(parent) = link.parent {
            let (w, nu) = &velocities[parent];
            let moved = add(w, &cross(nu, &link.joint.offset)).map(Expr::group);
            (linear, angular) = (inward(&link.joint.turns, &moved), inward(&link.joint.turns, nu));
        }
        for speed in (0..weights.len()).filter(|&speed| link.is_moved_by(speed)) {
            let row = link.frame.resolve(&link.linear_rows[speed], Axes::Body);
            linear = add(&linear, &scale(weights[speed], &row));
            angular = add(&angular, &scale(weights[speed], &link.angular_rows[speed]));
        }
        velocities.push((linear.map(Expr::group), angular.map(Expr::group)));
    }
    velocities
}

fn half<'g>(a: &Triple<'g>) -> Triple<'g> {
    a.map(|e| e.scale(Rational::new(1, 2)))
}
