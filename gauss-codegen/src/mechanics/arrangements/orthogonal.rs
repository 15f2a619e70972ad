//! C of (3.1) as the sum of squares that it is: masses times squares of accelerations of centres of mass, and inertias
//! about these times those of angular accelerations, all affine in ż. Orthogonalised element by element, the light keep
//! their digits beside the heavy, and what is far from O is not squared; A is never formed.
//!
//! Where all axes are parallel the unknown of a hinge is not its own rate but the angular acceleration of its link:
//! what turns an ancestor then moves the joint alone, and a long link does not hide a short lever before it.

use crate::algebra::{Expr, LeastSquares};

use crate::mechanics::kinematics::turn::inward;
use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, dot, is_zero, subtract};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::{Force, Loads};
use crate::mechanics::tidy::sums;

/// Elements of inertia.
pub struct Elements<'a, 'g> {
    tree: &'a Tree<'g>,
    /// The axis that every turn is about.
    planar: Option<usize>,
    squares: LeastSquares<'g>,
    shares: Vec<Share<'g>>,
    /// Which link, and how the row is made of a motion of it.
    forms: Vec<(usize, MotionComponent<'g>)>,
}

/// Share of the rate of another speed in the unknown of a hinge.
struct Share<'g> {
    hinge: usize,
    other: usize,
    share: Expr<'g>,
}

/// A linear and an angular part at O, working axes.
type Motion<'g> = (Triple<'g>, Triple<'g>);

/// A component of the motion of a link, working axes: of the velocity of G, or of Lᵀω with its row of factors.
enum MotionComponent<'g> {
    Center(usize, Triple<'g>),
    Turn(usize, Triple<'g>),
}

impl<'g> MotionComponent<'g> {
    fn of(&self, linear: &Triple<'g>, angular: &Triple<'g>) -> Expr<'g> {
        match self {
            MotionComponent::Center(axis, center) => linear[*axis] + cross(angular, center)[*axis],
            MotionComponent::Turn(_, factors) => dot(factors, angular),
        }
    }
}

impl<'a, 'g> Elements<'a, 'g> {
    /// Elements of all matter; `None` where fluid is moved or displaced: its impulse is no sum of squares of this kind.
    /// `planar` is the axis that every turn is about, if there is one.
    pub fn new(tree: &'a Tree<'g>, planar: Option<usize>) -> Option<Self> {
        let dry =
            |link: &Link<'g>| link.body().is_none_or(|body| body.added_mass.is_none() && body.displaced.is_none());
        if !tree.links.iter().all(dry) {
            return None;
        }
        let (mut rows, mut weights, mut forms) = (Vec::new(), Vec::new(), Vec::new());
        let (motions, shares) = motions(tree, planar);
        for (k, motions) in motions.iter().enumerate() {
            for (weight, form) in forms_of(planar, &tree.links[k]) {
                let row: Vec<Expr<'g>> = motions.iter().map(|(v, w)| form.of(v, w).group()).collect();
                if row.iter().any(|e| !e.is_zero()) {
                    rows.push(row);
                    weights.push(weight);
                    forms.push((k, form));
                }
            }
        }
        Some(Self { tree, planar, squares: LeastSquares::new(rows, &weights), shares, forms })
    }

    /// z with `A z = right`.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let nothing = vec![self.tree.graph.zero(); self.forms.len()];
        self.in_speeds(self.squares.solve(&nothing, &nothing, &self.of_unknowns(right.to_vec())))
    }

    /// Generalised forces for the unknowns, of those for the speeds.
    fn of_unknowns(&self, mut forces: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let given = forces.clone();
        for Share { hinge, other, share } in &self.shares {
            forces[*other] = (forces[*other] - *share * given[*hinge]).group();
        }
        forces
    }

    /// Rates of the speeds, of the unknowns.
    fn in_speeds(&self, mut rates: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let unknowns = rates.clone();
        for Share { hinge, other, share } in &self.shares {
            rates[*hinge] = (rates[*hinge] - *share * unknowns[*other]).group();
        }
        rates
    }

    /// ż, from the loads on links and the generalised forces of all others.
    pub fn accelerations(&self, loads: &Loads<'g>, others: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let tree = self.tree;
        let nothing = vec![false; tree.speed_count()];
        let (accelerations, taken) = tree.floating_accelerations(loads, &nothing);
        let offset = |(k, form): &(usize, MotionComponent<'g>)| {
            let (link, (a, alpha)) = (&tree.links[*k], &accelerations[*k]);
            let a = link.frame.resolve(a, Axes::Body);
            match form {
                MotionComponent::Center(axis, center) => {
                    let w = &link.angular_velocity;
                    let turning = cross(w, &cross(w, center).map(Expr::group));
                    add(&a, &add(&cross(alpha, center), &turning))[*axis].group()
                }
                MotionComponent::Turn(..) => form.of(&a, alpha).group(),
            }
        };
        let offsets: Vec<Expr<'g>> = self.forms.iter().map(offset).collect();
        let acting = self.acting(&loads.forces);
        let forces = sums(others, &self.acting_on_frames(&loads.forces)).iter().map(|e| e.group()).collect();
        let forces = self.of_unknowns(forces);
        let rates = match forces.len() {
            0..=2 => self.squares.solve(&offsets, &acting, &forces),
            _ => self.squares.refined(&offsets, &acting, &forces),
        };
        self.in_speeds(rates).iter().zip(&taken).map(|(rate, own)| *rate + *own).collect()
    }

    /// Generalised forces of the loads on links without mass, which have no elements.
    fn acting_on_frames(&self, forces: &[Force<'g>]) -> Vec<Expr<'g>> {
        let (tree, zero) = (self.tree, self.tree.graph.zero());
        let massless = |k: usize| matches!(tree.links[k].matter, Matter::Nothing);
        let on_frame = |force: &&Force<'g>| force.load(&tree.links).is_some_and(|(k, ..)| massless(k));
        let forces: Vec<Force<'g>> = forces.iter().filter(on_frame).cloned().collect();
        if forces.is_empty() {
            return vec![zero; tree.speed_count()];
        }
        let nothing = tree.links.iter().map(|link| (link.frame.zero(), [zero; 3])).collect();
        tree.acted_on_by(&forces, nothing)
    }

    /// `ω × I_G ω` and the loads on links, element by element: with `I_G = L D Lᵀ` a torque τ about G is that of `L⁻¹τ`
    /// along `Lᵀω`.
    fn acting(&self, forces: &[Force<'g>]) -> Vec<Expr<'g>> {
        let tree = self.tree;
        let mut wrenches: Vec<(Triple<'g>, Triple<'g>)> =
            tree.links.iter().map(|link| ([tree.graph.zero(); 3], gyroscopic(self.planar, link))).collect();
        for (k, force, torque) in forces.iter().filter_map(|force| force.load(&tree.links)) {
            let link = &tree.links[k];
            let (linear, angular) = &mut wrenches[k];
            let force = link.frame.resolve(&force, Axes::Body).map(Expr::group);
            let torque = subtract(&torque, &cross(&center_of(link), &force));
            *linear = subtract(linear, &force);
            *angular = subtract(angular, &torque).map(Expr::group);
        }
        for (k, (_, angular)) in wrenches.iter_mut().enumerate() {
            for (_, form) in forms_of(self.planar, &tree.links[k]) {
                let MotionComponent::Turn(own, factors) = form else { continue };
                let others = (own + 1..3).filter(|&i| !factors[i].is_zero());
                others.for_each(|i| angular[i] = (angular[i] - factors[i] * angular[own]).group());
            }
        }
        let of = |(k, form): &(usize, MotionComponent<'g>)| match form {
            MotionComponent::Center(axis, _) => wrenches[*k].0[*axis].group(),
            MotionComponent::Turn(axis, _) => wrenches[*k].1[*axis],
        };
        self.forms.iter().map(of).collect()
    }
}

/// Motions of all links by the unknowns, and what hinges have of others: x of the hinge is that of its link less these.
fn motions<'g>(tree: &Tree<'g>, planar: Option<usize>) -> (Vec<Vec<Motion<'g>>>, Vec<Share<'g>>) {
    let zero = tree.graph.zero();
    let (mut all, mut shares): (Vec<Vec<Motion<'g>>>, Vec<Share<'g>>) = (Vec::new(), Vec::new());
    for (k, link) in tree.links.iter().enumerate() {
        let joint = &link.joint;
        let carried = |(linear, angular): &Motion<'g>| {
            let moved = add(linear, &cross(angular, &joint.offset)).map(Expr::group);
            (inward(&joint.turns, &moved), inward(&joint.turns, angular))
        };
        let mut motions: Vec<Motion<'g>> = match link.parent {
            Some(parent) => all[parent].iter().map(carried).collect(),
            None => vec![([zero; 3], [zero; 3]); tree.speed_count()],
        };
        if let Some((hinge, axis)) = planar.and_then(|_| hinge_of(tree, k)) {
            let inverse = link.angular_rows[hinge][axis].recip();
            for (other, (_, angular)) in motions.iter_mut().enumerate().filter(|(_, (_, w))| !w[axis].is_zero()) {
                let share = angular[axis] * inverse;
                if share.as_number().is_some() {
                    angular[axis] = zero;
                    shares.push(Share { hinge, other, share });
                }
            }
        }
        for (speed, (linear, angular)) in motions.iter_mut().enumerate() {
            *linear = add(linear, &link.frame.resolve(&link.linear_rows[speed], Axes::Body)).map(Expr::group);
            *angular = add(angular, &link.angular_rows[speed]).map(Expr::group);
        }
        all.push(motions);
    }
    (all, shares)
}

/// The speed that turns a link about one of its axes, and the axis, where nothing else moves it in its parent nor this
/// speed anything else.
fn hinge_of(tree: &Tree<'_>, k: usize) -> Option<(usize, usize)> {
    let link = &tree.links[k];
    let mut moved = (0..tree.speed_count()).filter(|&speed| link.is_moved_by(speed));
    let speed = moved.next().filter(|_| moved.next().is_none())?;
    let (linear, angular) = (&link.linear_rows[speed], &link.angular_rows[speed]);
    let turns_only = is_zero(&linear.body) && is_zero(&linear.space);
    let alone = !tree.links.iter().enumerate().any(|(other, link)| other != k && link.is_moved_by(speed));
    let axis = (0..3).find(|&i| !angular[i].is_zero())?;
    let about_it = (0..3).all(|i| i == axis || angular[i].is_zero());
    (turns_only && alone && about_it).then_some((speed, axis))
}

/// The elements of one link, with their weights.
fn forms_of<'g>(planar: Option<usize>, link: &Link<'g>) -> Vec<(Expr<'g>, MotionComponent<'g>)> {
    let graph = link.frame.graph;
    let mass = match &link.matter {
        Matter::Nothing => return Vec::new(),
        Matter::Particle(mass) => *mass,
        Matter::Body(body) => body.mass,
    };
    let center = center_of(link);
    let mut forms: Vec<_> = (0..3).map(|axis| (mass, MotionComponent::Center(axis, center))).collect();
    let Some(inertia) = central_inertia(link) else { return forms };
    // About one axis no other moment enters: whatever is given of them, no pivot is made of it.
    if let Some(axis) = planar.or_else(|| link.only_axis()) {
        let unit = std::array::from_fn(|i| if i == axis { graph.one() } else { graph.zero() });
        forms.push((inertia[axis][axis], MotionComponent::Turn(axis, unit)));
        return forms;
    }
    // I_G = L D Lᵀ: Σ D_j (Lᵀω)_j².
    let mut rest = inertia;
    for j in 0..3 {
        let pivot = rest[j][j];
        let factors: Triple<'g> = std::array::from_fn(|i| match i {
            _ if i < j => graph.zero(),
            _ if i == j => graph.one(),
            _ if rest[i][j].is_zero() => graph.zero(),
            _ => (rest[i][j] * pivot.recip()).opaque(),
        });
        for a in j + 1..3 {
            for b in j + 1..3 {
                if !rest[a][j].is_zero() && !rest[b][j].is_zero() {
                    rest[a][b] = (rest[a][b] - factors[a] * rest[b][j]).opaque();
                }
            }
        }
        forms.push((pivot, MotionComponent::Turn(j, factors)));
    }
    forms
}

/// G from O, working axes.
fn center_of<'g>(link: &Link<'g>) -> Triple<'g> {
    let none = [link.frame.graph.zero(); 3];
    link.body().map_or(none, |body| link.in_working_axes(&body.center_of_mass, Axes::Body).map(Expr::group))
}

/// `ω × I_G ω` of a link; about one axis it has no part along it.
fn gyroscopic<'g>(planar: Option<usize>, link: &Link<'g>) -> Triple<'g> {
    let w = &link.angular_velocity;
    let Some(inertia) = central_inertia(link).filter(|_| planar.or_else(|| link.only_axis()).is_none()) else {
        return [link.frame.graph.zero(); 3];
    };
    let spin: Triple<'g> = std::array::from_fn(|i| dot(&inertia[i], w).group());
    cross(w, &spin).map(Expr::group)
}

/// I_G of a body, working axes.
fn central_inertia<'g>(link: &Link<'g>) -> Option<[Triple<'g>; 3]> {
    let inertia = link.body()?.central_inertia();
    Some(link.turned.map_or(inertia, |turn| turn.tensor(&inertia)))
}
