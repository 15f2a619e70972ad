//! A x = r solved link by link: a quadratic function of the motion of all links is minimised over the speeds of the
//! leaves first, which leaves a quadratic function of their parents' motion alone. The work grows with the number of
//! links, where that of a factorisation of A grows with its cube.
//!
//! Where a speed moves several links in ways of their own — angles from the vertical turn the next joint back — the
//! joints' own speeds, sums of those of the user, are eliminated in their place.
//!
//! This is Gaussian elimination in an order that never forms A, and the *articulated-body inertia* of a link
//! (Featherstone, Rigid Body Dynamics Algorithms, chapter 7) is what the elimination leaves at it. His three passes:
//!
//! 1. outward: velocities and partial velocities of all links, which a [`Tree`] has;
//! 2. inward: articulated inertias ([`eliminated`](Articulated::eliminated)), which depend on A alone, and bias forces
//!    ([`bias_forces`](Articulated::bias_forces)), which depend on r;
//! 3. outward: accelerations ([`accelerations`](Articulated::accelerations)).

use crate::algebra::{Expr, FactoredColumns, Factorisation, Rational};

use crate::mechanics::kinematics::turn::{Turn, inward};
use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, cross_matrix, dot, subtract};
use crate::mechanics::links::link::Link;
use crate::mechanics::links::tree::{Pairs, Tree};
use crate::mechanics::matter::moments::Moments;

type Matrix<'g> = [Triple<'g>; 3];

/// `F = linear·a + mixed·α`, `N = mixedᵀ·a + angular·α`: the wrench about O that a motion (a, α) of O needs.
#[derive(Clone, Copy)]
struct ArticulatedInertia<'g> {
    linear: Matrix<'g>,
    mixed: Matrix<'g>,
    angular: Matrix<'g>,
}

/// A linear and an angular part at O, working axes.
type Pair<'g> = (Triple<'g>, Triple<'g>);

/// A speed of a joint: its partial velocity, and what it is in terms of the user's speeds.
struct JointSpeed<'g> {
    link: usize,
    row: Pair<'g>,
    combination: Vec<(usize, Rational)>,
}

/// A speed of a joint when it is eliminated: its partial velocity, the wrench that this needs, and the reciprocal of
/// the pivot.
struct Pivot<'g> {
    speed: usize,
    row: Pair<'g>,
    response: Pair<'g>,
    /// Contribution of rotors to the pivot.
    armature: Expr<'g>,
    inverse: Expr<'g>,
}

/// A tree with its inertias eliminated: the pivots of every link, in the order of elimination.
pub struct Articulated<'a, 'g> {
    tree: &'a Tree<'g>,
    joints: Vec<JointSpeed<'g>>,
    pivots: Vec<Vec<Pivot<'g>>>,
}

impl<'a, 'g> Articulated<'a, 'g> {
    /// The inward elimination of articulated inertias: the speeds of each link are eliminated, and the inertia that is
    /// left is added to that of its parent. `None` when no joint has speeds of its own that determine those of the
    /// user, or there is fluid.
    pub fn eliminated(tree: &'a Tree<'g>) -> Option<Self> {
        let dry = |link: &Link<'g>| link.body().is_none_or(|body| body.added_mass.is_none());
        let joints = joint_speeds(tree).filter(|_| tree.links.iter().all(dry))?;
        // Modes couple what they move with all the way to the root.
        if !tree.deformations.is_empty() {
            return None;
        }
        let armatures = armatures(tree, &joints)?;
        let mut inertias: Vec<ArticulatedInertia<'g>> =
            tree.links.iter().map(|link| ArticulatedInertia::of(&link.moments)).collect();
        let mut pivots: Vec<Vec<Pivot<'g>>> = tree.links.iter().map(|_| Vec::new()).collect();
        for k in (0..tree.links.len()).rev() {
            let link = &tree.links[k];
            for (speed, joint) in joints.iter().enumerate().filter(|(_, joint)| joint.link == k) {
                let pivot = Pivot::new(speed, joint.row, &inertias[k], armatures[speed]);
                inertias[k] = inertias[k].without(&pivot);
                pivots[k].push(pivot);
            }
            if let Some(parent) = link.parent {
                let carried = inertias[k].turned(&link.joint.turns).shifted(&link.joint.offset);
                inertias[parent] = inertias[parent].plus(&carried);
            }
        }
        Some(Self { tree, joints, pivots })
    }

    /// x with A x = right.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let none = [self.tree.graph.zero(); 3];
        let nothing = vec![(none, none); self.tree.links.len()];
        self.combinations().solve(right, |right| self.joint_rates(right, nothing.clone(), |_| None))
    }

    /// x with A x = right less the wrenches on the links along the speeds: on the way to the root they are gathered
    /// together with the wrenches that the motion needs. Along the axis of a hinge the sum is then known, and the
    /// motion relative to the parent is found last; in [`solve`](Self::solve) it is first, since the motion of all
    /// links is wanted besides.
    pub fn solve_under(&self, wrenches: &Pairs<'g>, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let links = self.tree.links.iter().zip(wrenches);
        let wrenches: Vec<Pair<'g>> =
            links.map(|(link, (linear, angular))| (link.frame.resolve(linear, Axes::Body), *angular)).collect();
        self.combinations().solve(right, |right| self.joint_rates(right, wrenches.clone(), Pivot::axis))
    }

    fn combinations(&self) -> Combinations {
        let rows: Vec<Vec<(usize, Rational)>> = self.joints.iter().map(|j| j.combination.clone()).collect();
        let mut columns: Vec<Vec<(usize, Rational)>> = vec![Vec::new(); rows.len()];
        for (joint, combination) in rows.iter().enumerate() {
            combination.iter().for_each(|&(speed, c)| columns[speed].push((joint, c)));
        }
        Combinations { rows, columns }
    }

    /// A as LDLᵀ in the speeds of the joints, by the pivots of the inward elimination: what is left of a column is the
    /// response of its joint, carried to the joints that it hangs on. For many right-hand sides: each is solved for
    /// without a motion of any link.
    pub fn joint_factors(&self) -> JointFactors<'g> {
        let links = &self.tree.links;
        let sequence: Vec<(usize, &Pivot<'g>)> =
            (0..links.len()).rev().flat_map(|k| self.pivots[k].iter().map(move |pivot| (k, pivot))).collect();
        let zero = self.tree.graph.zero();
        let mut rest = vec![vec![zero; sequence.len()]; sequence.len()];
        for (column, &(from, pivot)) in sequence.iter().enumerate() {
            let (mut at, mut response) = (from, pivot.response);
            loop {
                for (row, (_, other)) in sequence.iter().enumerate().skip(column).filter(|(_, (k, _))| *k == at) {
                    rest[row][column] = pair(&other.row, &response).group();
                }
                let Some(parent) = links[at].parent else { break };
                let (linear, angular) = self.tree.carried(at, &response.0, &response.1);
                response = (linear.map(Expr::group), angular.map(Expr::group));
                at = parent;
            }
        }
        for (k, (_, pivot)) in sequence.iter().enumerate() {
            rest[k][k] = (rest[k][k] + pivot.armature).group();
        }
        let order = sequence.iter().map(|(_, pivot)| pivot.speed).collect();
        JointFactors { combinations: self.combinations(), factored: Factorisation::of_columns(order, rest) }
    }

    /// y with A_y y = right less what wrenches on the links give along the speeds of the joints; where a pivot is that
    /// of an axis, along that.
    fn joint_rates(
        &self,
        right: &[Expr<'g>],
        wrenches: Vec<Pair<'g>>,
        axis: impl Fn(&Pivot<'g>) -> Option<usize>,
    ) -> Vec<Expr<'g>> {
        self.accelerations(&self.bias_forces(right, wrenches, &axis), axis)
    }

    /// The inward pass of bias forces: the right-hand sides less the articulated bias forces along each speed. These
    /// are wrenches on the links about their O, in working axes, gathered toward the root together with what the
    /// speeds that are eliminated add to them.
    fn bias_forces(
        &self,
        right: &[Expr<'g>],
        mut wrenches: Vec<Pair<'g>>,
        axis: impl Fn(&Pivot<'g>) -> Option<usize>,
    ) -> Vec<Expr<'g>> {
        let links = &self.tree.links;
        let mut reduced = right.to_vec();
        for k in (0..links.len()).rev() {
            for pivot in &self.pivots[k] {
                let rest = right[pivot.speed] - pair(&pivot.row, &wrenches[k]);
                reduced[pivot.speed] = rest.group();
                let share = (reduced[pivot.speed] * pivot.inverse).group();
                wrenches[k] = moved(&wrenches[k], share, &pivot.response);
                if let Some(axis) = axis(pivot) {
                    *component(&mut wrenches[k], axis) = right[pivot.speed];
                }
            }
            if let Some(parent) = links[k].parent {
                let (linear, angular) = self.tree.carried(k, &wrenches[k].0, &wrenches[k].1);
                let (force, torque) = &wrenches[parent];
                wrenches[parent] = (add(force, &linear).map(Expr::group), add(torque, &angular).map(Expr::group));
            }
        }
        reduced
    }

    /// The outward pass of accelerations: from the root on, each speed's rate from what is left for it and from the
    /// motion (a, α) of its link at O, working axes, which the parent and the speeds before give it.
    fn accelerations(&self, reduced: &[Expr<'g>], axis: impl Fn(&Pivot<'g>) -> Option<usize>) -> Vec<Expr<'g>> {
        let zero = self.tree.graph.zero();
        let links = &self.tree.links;
        let nothing: Pair<'g> = ([zero; 3], [zero; 3]);
        let mut solution = vec![zero; reduced.len()];
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
                if let Some(axis) = axis(pivot) {
                    let before = std::mem::replace(component(&mut motion, axis), zero);
                    let rest = reduced[pivot.speed] - pair(&pivot.response, &motion);
                    let whole = (rest.group() * pivot.inverse).group();
                    solution[pivot.speed] = (whole - before).group();
                    *component(&mut motion, axis) = whole;
                    continue;
                }
                let rest = reduced[pivot.speed] - pair(&pivot.response, &motion);
                solution[pivot.speed] = (rest.group() * pivot.inverse).group();
                motion = moved(&motion, solution[pivot.speed], &pivot.row);
            }
            motions.push(motion);
        }
        solution
    }
}

/// The speeds of the joints in terms of the user's: y = T x, `A = Tᵀ A_y T`.
struct Combinations {
    rows: Vec<Vec<(usize, Rational)>>,
    columns: Vec<Vec<(usize, Rational)>>,
}

impl Combinations {
    fn solve<'g>(&self, right: &[Expr<'g>], joints: impl Fn(&[Expr<'g>]) -> Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let solvable = "the order of substitution was found when the joints were";
        let right = substituted(&self.columns, right).expect(solvable);
        substituted(&self.rows, &joints(&right)).expect(solvable)
    }
}

/// A, factored joint by joint.
pub struct JointFactors<'g> {
    combinations: Combinations,
    factored: Factorisation<'g>,
}

impl<'g> JointFactors<'g> {
    /// x with A x = right.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.combinations.solve(right, |right| self.factored.solve(right))
    }

    /// L⁻¹ of a right-hand side in the order of elimination, where the speeds of the joints are the user's.
    pub fn halfway(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.factored.halfway(right)
    }

    /// The factors as numbers, where the speeds of the joints are the user's.
    pub fn columns(&self) -> Option<FactoredColumns<'g>> {
        self.order().map(|_| self.factored.columns())
    }

    /// The order of elimination, where the speeds of the joints are the user's.
    pub fn order(&self) -> Option<Vec<usize>> {
        let own = |joint: usize| self.combinations.rows[joint] == [(joint, Rational::one())];
        (0..self.combinations.rows.len()).all(own).then(|| self.factored.order())
    }
}

/// The speeds of the joints, if there are as many as the user's and each set determines the other by substitution.
fn joint_speeds<'g>(tree: &Tree<'g>) -> Option<Vec<JointSpeed<'g>>> {
    let count = tree.speed_count();
    let links_moved = |speed: usize| tree.links.iter().filter(|link| link.is_moved_by(speed)).count();
    let shared: Vec<bool> = (0..count).map(|speed| links_moved(speed) > 1).collect();
    let mut joints = Vec::with_capacity(count);
    for (k, link) in tree.links.iter().enumerate() {
        let moved: Vec<usize> = (0..count).filter(|&speed| link.is_moved_by(speed)).collect();
        let row = |speed: usize| (link.frame.resolve(&link.linear_rows[speed], Axes::Body), link.angular_rows[speed]);
        if moved.iter().any(|&speed| shared[speed]) {
            // One way to move, in which all these speeds take part.
            let first = row(moved[0]);
            let parts = moved.iter().map(|&speed| Some((speed, ratio(&row(speed), &first)?)));
            joints.push(JointSpeed { link: k, row: first, combination: parts.collect::<Option<_>>()? });
        } else {
            let own =
                |&speed: &usize| JointSpeed { link: k, row: row(speed), combination: vec![(speed, Rational::one())] };
            joints.extend(moved.iter().map(own));
        }
    }
    let combinations: Vec<Vec<(usize, Rational)>> = joints.iter().map(|j| j.combination.clone()).collect();
    let zeros = vec![tree.graph.zero(); count];
    (joints.len() == count && substituted(&combinations, &zeros).is_some()).then_some(joints)
}

/// Contribution of rotors to the pivot of each joint, if each turns with a single one.
fn armatures<'g>(tree: &Tree<'g>, joints: &[JointSpeed<'g>]) -> Option<Vec<Expr<'g>>> {
    let mut armatures = vec![tree.graph.zero(); joints.len()];
    for rotor in &tree.rotors {
        let moved = |speed: &usize| !tree.row_of(rotor, *speed).is_zero();
        let [speed] = (0..tree.speed_count()).filter(moved).collect::<Vec<_>>().try_into().ok()?;
        let own = |joint: &JointSpeed<'g>| joint.combination == [(speed, Rational::one())];
        let shared = joints.iter().filter(|joint| joint.combination.iter().any(|(k, _)| *k == speed)).count();
        let joint = joints.iter().position(own).filter(|_| shared == 1)?;
        armatures[joint] = armatures[joint] + rotor.inertia * tree.row_of(rotor, speed).powi(2);
    }
    Some(armatures)
}

/// The number c with a = c·b.
fn ratio<'g>(a: &Pair<'g>, b: &Pair<'g>) -> Option<Rational> {
    let mut ratio = None;
    for (x, y) in a.0.iter().chain(&a.1).zip(b.0.iter().chain(&b.1)) {
        match (x.is_zero(), y.is_zero()) {
            (true, true) => continue,
            (false, false) => {}
            _ => return None,
        }
        let own = (*x * y.recip()).as_number()?;
        if *ratio.get_or_insert(own) != own {
            return None;
        }
    }
    ratio
}

/// Solves `Σ c x = right`, row by row, each time one in which a single unknown is left; `None` when there is no such
/// row.
fn substituted<'g>(rows: &[Vec<(usize, Rational)>], right: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
    let mut known: Vec<Option<Expr<'g>>> = vec![None; right.len()];
    let mut open: Vec<usize> = (0..rows.len()).collect();
    while !open.is_empty() {
        let unknown = |row: usize| rows[row].iter().filter(|(x, _)| known[*x].is_none()).count();
        let row = open.remove(open.iter().position(|&row| unknown(row) == 1)?);
        let (mut rest, mut last) = (right[row], None);
        for &(x, c) in &rows[row] {
            match known[x] {
                Some(value) => rest = rest - value.scale(c),
                None => last = Some((x, c)),
            }
        }
        let (x, c) = last?;
        known[x] = Some(rest.group().scale(c.recip()));
    }
    known.into_iter().collect()
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
    fn new(speed: usize, row: Pair<'g>, inertia: &ArticulatedInertia<'g>, armature: Expr<'g>) -> Self {
        let response = inertia.apply(&row);
        let inverse = (pair(&row, &response) + armature).group().recip();
        Self { speed, row, response, armature, inverse }
    }

    /// The component of a motion that the speed is, where it is one and nothing but the links resists: the force needed
    /// along it is then the applied one, and the response there the pivot.
    fn axis(&self) -> Option<usize> {
        let mut there = self.row.0.iter().chain(&self.row.1).enumerate().filter(|(_, e)| !e.is_zero());
        let (axis, value) = there.next()?;
        (there.next().is_none() && *value == value.graph().one() && self.armature.is_zero()).then_some(axis)
    }
}

/// Component of a linear and an angular part, counted on.
fn component<'a, 'g>(pair: &'a mut Pair<'g>, axis: usize) -> &'a mut Expr<'g> {
    if axis < 3 { &mut pair.0[axis] } else { &mut pair.1[axis - 3] }
}

impl<'g> ArticulatedInertia<'g> {
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

    /// Inertia that is left when the speed takes the value that is best for every motion of the rest.
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
        turns.iter().rev().fold(*self, |inertia, turn| Self {
            linear: turn.tensor(&inertia.linear),
            mixed: turn.mixed(&inertia.mixed),
            angular: turn.tensor(&inertia.angular),
        })
    }

    /// About a pole from which the old one is at r: `a` of the old is `a + α × r` of the new, and `r × F` joins the
    /// torque.
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
