//! Poles and axes by which the sums over links are formed: a choice, since no sum depends on it.
//!
//! - The pole of a link that turns about an axis may be anywhere on this axis: where it takes away components of what
//!   is between joints (the common normals of Denavit and Hartenberg).
//! - Nothing but the moments of a link shows how far it has turned, if all that hangs on it turns about the same axis:
//!   it works in the axes that it has before it turns. Its moments are turned there, once, and not velocities,
//!   accelerations, forces, and inertias of all that hangs on it. Those of a rotor that is symmetric about its axis are
//!   not even turned: its angle drops out.

use crate::algebra::Expr;

use crate::mechanics::kinematics::turn::{Turn, outward};
use crate::mechanics::kinematics::vector::{Triple, add, is_zero, subtract};
use crate::mechanics::links::link::{Joint, Link, WorkingFrame, identity};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::{Force, Loads};
use crate::mechanics::tidy::tidy;

/// Number of rounds through the poles; a pole that has not settled by then is as good as it is.
const ROUNDS: usize = 4;

/// The axis of a link that turns about it, with O on it.
#[derive(Clone, Copy)]
struct Hinge {
    /// Axis of the link.
    axis: usize,
    /// The axis of the parent that it is, if it is one and at rest there with O, and whether it points the other way.
    in_parent: Option<(usize, bool)>,
}

impl Hinge {
    fn of(link: &Link<'_>) -> Option<Self> {
        link.parent?;
        let wet = link.body().is_some_and(|body| body.added_mass.is_some() || body.displaced.is_some());
        let (last, fixed) = link.own_joint.turns.split_last()?;
        let (axis, _) = last.axis_and_angle()?;
        let still =
            fixed.iter().all(|turn| is_zero(&turn.spin) && turn.matrix.iter().flatten().all(|e| e.is_constant()));
        let at_rest = link.own_joint.offset.iter().all(|e| e.is_constant());
        if wet || is_zero(&last.spin) {
            return None;
        }
        let graph = last.spin[0].graph();
        let unit = std::array::from_fn(|i| if i == axis { graph.one() } else { graph.zero() });
        let seen = outward(fixed, &unit);
        let mut there = (0..3).filter(|&i| !seen[i].is_zero());
        let (one, others) = (there.next(), there.next());
        let along_it = |i: usize| others.is_none() && (seen[i] == graph.one() || -seen[i] == graph.one());
        let in_parent = one.filter(|&i| still && at_rest && along_it(i));
        Some(Self { axis, in_parent: in_parent.map(|i| (i, seen[i] != graph.one())) })
    }

    /// Vector along the axis, components in the parent's axes.
    fn along<'g>(&self, way: Expr<'g>) -> Triple<'g> {
        let zero = way.graph().zero();
        let component = |i: usize| match self.in_parent {
            Some((axis, turned)) if axis == i => {
                if turned {
                    -way
                } else {
                    way
                }
            }
            _ => zero,
        };
        std::array::from_fn(component)
    }
}

/// Distances by which the pole of each link is moved along its axis.
struct Poles<'a, 'g> {
    tree: &'a Tree<'g>,
    hinges: Vec<Option<Hinge>>,
    ways: Vec<Expr<'g>>,
}

impl<'a, 'g> Poles<'a, 'g> {
    /// At the O of every link.
    fn given(tree: &'a Tree<'g>) -> Self {
        let hinges = tree.links.iter().map(Hinge::of).collect();
        Self { tree, hinges, ways: vec![tree.graph.zero(); tree.links.len()] }
    }

    fn new(tree: &'a Tree<'g>) -> Self {
        let mut poles = Self::given(tree);
        for _ in 0..ROUNDS {
            let before = poles.ways.clone();
            (0..tree.links.len()).for_each(|k| poles.settle(k));
            if poles.ways == before {
                break;
            }
        }
        poles
    }

    /// P − O of a link, its own axes.
    fn shift(&self, k: usize) -> Triple<'g> {
        let zero = self.tree.graph.zero();
        let along = |axis: usize| std::array::from_fn(|i| if i == axis { self.ways[k] } else { zero });
        self.hinges[k].map_or([zero; 3], |hinge| along(hinge.axis))
    }

    /// From the parent's pole to that of a link, the parent's axes.
    fn offset(&self, k: usize) -> Triple<'g> {
        let link = &self.tree.links[k];
        let moved = self.hinges[k]
            .map_or(link.own_joint.offset, |hinge| add(&link.own_joint.offset, &hinge.along(self.ways[k])));
        match link.parent {
            Some(parent) => subtract(&moved, &self.shift(parent)).map(Expr::group),
            None => moved,
        }
    }

    fn children(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.tree.links.len()).filter(move |&child| self.tree.links[child].parent == Some(k))
    }

    /// Components that are not zero.
    fn components(&self, k: usize) -> usize {
        self.offset(k).iter().filter(|e| !e.is_zero()).count()
    }

    /// Moves the pole of one link to where fewest components are left.
    fn settle(&mut self, k: usize) {
        let Some(hinge) = self.hinges[k] else { return };
        let Some((axis, turned)) = hinge.in_parent else { return };
        let own = self.offset(k)[axis];
        let present = self.ways[k];
        let mut choices = vec![present, if turned { present + own } else { present - own }];
        choices.extend(self.children(k).map(|child| present + self.offset(child)[hinge.axis]));
        let mut best: Option<(usize, Expr<'g>)> = None;
        for choice in choices {
            self.ways[k] = choice;
            let left = self.components(k) + self.children(k).map(|child| self.components(child)).sum::<usize>();
            if best.is_none_or(|(least, _)| left < least) {
                best = Some((left, choice));
            }
        }
        if let Some((_, way)) = best {
            self.ways[k] = way;
        }
    }
}

/// Which links work in the axes that they have before they turn, and how far each is turned from these.
struct Angles<'g> {
    stays: Vec<bool>,
    angles: Vec<Option<Expr<'g>>>,
}

impl<'g> Angles<'g> {
    /// Angles of links of which `may_stay` is true.
    fn new(poles: &Poles<'_, 'g>, may_stay: impl Fn(usize) -> bool) -> Self {
        let (tree, hinges) = (poles.tree, &poles.hinges);
        // The axis of a child stays where it is in these axes only if it is the same.
        let parallel = |k: usize, child: usize| {
            let axes = hinges[child].and_then(|child| child.in_parent).zip(hinges[k]);
            axes.is_some_and(|((axis, _), own)| axis == own.axis)
        };
        let stays = |k: usize| hinges[k].is_some() && may_stay(k) && poles.children(k).all(|child| parallel(k, child));
        let stays: Vec<bool> = (0..tree.links.len()).map(stays).collect();
        let mut angles: Vec<Option<Expr<'g>>> = Vec::with_capacity(stays.len());
        for (k, link) in tree.links.iter().enumerate() {
            let angle = hinges[k].and_then(|hinge| {
                let (_, own) = link.own_joint.turns.last()?.axis_and_angle()?;
                let above = link.parent.filter(|&parent| stays[parent]).and_then(|parent| angles[parent]);
                let turned = hinge.in_parent.is_some_and(|(_, turned)| turned);
                Some(above.map_or(own, |above| if turned { own - above } else { own + above }))
            });
            angles.push(angle);
        }
        Self { stays, angles }
    }

    fn turn(&self, poles: &Poles<'_, 'g>, k: usize) -> Option<Turn<'g>> {
        let (hinge, angle) = poles.hinges[k].zip(self.angles[k])?;
        Some(Turn::about(poles.tree.graph, hinge.axis, angle, poles.tree.rates()))
    }

    fn description(&self, poles: &Poles<'_, 'g>, k: usize) -> WorkingFrame<'g> {
        let (link, graph) = (&poles.tree.links[k], poles.tree.graph);
        let own_offset = poles.offset(k);
        let mut joint = Joint { offset: own_offset, ..link.own_joint.clone() };
        if let Some(turn) = link.parent.filter(|&parent| self.stays[parent]).and_then(|parent| self.turn(poles, parent))
        {
            joint.offset = turn.vector(&own_offset).map(Expr::group);
        }
        let mut turned = None;
        if let (Some(turn), Some(last)) = (self.turn(poles, k), joint.turns.last_mut()) {
            let turning =
                if self.stays[k] { Turn::given(identity(graph), last.spin) } else { turn.with_spin(last.spin) };
            turned = self.stays[k].then_some(turn);
            *last = turning;
        }
        WorkingFrame { shift: poles.shift(k), own_offset, joint, turned }
    }
}

/// Whether the moments of a link are the same however far it has turned about the axis of its hinge.
fn is_symmetric(link: &Link<'_>) -> bool {
    let Some(turn) = link.own_joint.turns.last() else { return false };
    let (moments, turned) = (&link.moments_in_body, link.moments_in_body.turned(&[*turn]));
    let pairs = moments.first.iter().chain(moments.second.iter().flatten());
    pairs.zip(turned.first.iter().chain(turned.second.iter().flatten())).all(|(a, b)| tidy(*a - *b).is_zero())
}

/// A tree that describes the same motion of the same matter by other poles and axes, and the loads on it.
pub struct WorkingTree<'g> {
    pub tree: Tree<'g>,
    pub loads: Loads<'g>,
}

impl<'g> WorkingTree<'g> {
    /// `None` where there is nothing to gain.
    pub fn of(tree: &Tree<'g>, loads: &Loads<'g>) -> Option<Self> {
        if tree.planar_axis().is_some() {
            return None;
        }
        let poles = Poles::new(tree);
        let fixed = |k: usize| poles.hinges[k].is_some_and(|hinge| hinge.in_parent.is_some());
        let angles = Angles::new(&poles, |k| fixed(k) || is_symmetric(&tree.links[k]));
        Self::by(&poles, &angles, loads)
    }

    /// Only where the angles of rotors drop out; poles stay where they were given. `None` where there are none.
    pub fn of_rotors(tree: &Tree<'g>, loads: &Loads<'g>) -> Option<Self> {
        if tree.planar_axis().is_some() {
            return None;
        }
        let poles = Poles::given(tree);
        Self::by(&poles, &Angles::new(&poles, |k| is_symmetric(&tree.links[k])), loads)
    }

    fn by(poles: &Poles<'_, 'g>, angles: &Angles<'g>, loads: &Loads<'g>) -> Option<Self> {
        let tree = poles.tree;
        if poles.ways.iter().all(|way| way.is_zero()) && !angles.stays.contains(&true) {
            return None;
        }
        let moved = |force: &Force<'g>| match *force {
            Force::OnLink { link, at, force, torque, axes } => {
                Force::OnLink { link, at: subtract(&at, &poles.shift(link)), force, torque, axes }
            }
            other => other,
        };
        let loads = Loads { forces: loads.forces.iter().map(moved).collect(), uniform: loads.uniform.clone() };
        let descriptions = (0..tree.links.len()).map(|k| angles.description(poles, k)).collect();
        Some(Self { tree: tree.described(descriptions), loads })
    }
}
