//! Momentum of body and fluid, the forces that act, and the balance in body axes solved for the accelerations.

use crate::algebra::{Expr, Graph, Map, Substitution, inverse_of_symmetric, solve_symmetric};

use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::vector::{
    Axes, Frame, Triple, Vector, add, apply_block, cross, cross_matrix, is_zero, scale, subtract,
};
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::matter::body::{AffineField, Body, integrate_product};
use crate::mechanics::matter::weight::Weight;

/// Terms that a component of a balance may have before it is left as it is.
const LIMIT: usize = 600;

/// `(Q, Γ_O) = M (u, ω)`, body axes, pole O: the body's inertia by moments, plus the added mass.
pub struct KineticMatrix<'g> {
    pub entries: Vec<Vec<Expr<'g>>>,
    /// μ when the translational block is μ·1 on the motion's axes: linear momentum then needs no body axes.
    pub isotropic: Option<Expr<'g>>,
    /// I when the rotational block is I·1 on the motion's axes and nothing couples it to the translation: the same for
    /// the angular momentum.
    pub spherical: Option<Expr<'g>>,
}

impl<'g> KineticMatrix<'g> {
    /// M = ∂²T/∂(u, ω)∂(u, ω) of `T = ½∫|u + ω × x|² dm`, and the fluid's matrix on top.
    /// Axes are indices into (u, ω).
    pub fn new(graph: &'g Graph, body: &Body<'g>, linear_axes: &[usize], angular_axes: &[usize]) -> Self {
        let unit = |k: usize| -> AffineField<'g> {
            let zero = [graph.zero(); 3];
            let mut axis = zero;
            axis[k % 3] = graph.one();
            if k < 3 {
                return AffineField { constant: axis, linear: [zero; 3] };
            }
            // ω × x is linear in x with the columns of [ω]×.
            let turn = cross_matrix(&axis);
            AffineField { constant: zero, linear: std::array::from_fn(|j| std::array::from_fn(|i| turn[i][j])) }
        };
        let entries: Vec<Vec<Expr<'g>>> = (0..6)
            .map(|i| {
                (0..6)
                    .map(|j| {
                        let rigid = integrate_product(body, &unit(i), &unit(j));
                        let added = body.added_mass.as_ref().map_or(graph.zero(), |m| m[i][j]);
                        (rigid + added).collected(LIMIT)
                    })
                    .collect()
            })
            .collect();
        let uncoupled = linear_axes.iter().all(|&i| angular_axes.iter().all(|&j| entries[i][j].is_zero()));
        let spherical = multiple_of_identity(&entries, angular_axes).filter(|_| uncoupled);
        // The translation is eliminated from all that the rotation couples with: it must be free there.
        let held = |i: usize| !linear_axes.contains(&i) && angular_axes.iter().any(|&j| !entries[i][j].is_zero());
        let isotropic = multiple_of_identity(&entries, linear_axes).filter(|_| !(0..3).any(held));
        Self { isotropic, spherical, entries }
    }

    pub fn block(&self, row: usize, column: usize, a: &Triple<'g>) -> Triple<'g> {
        apply_block(&self.entries, row, column, a)
    }

    /// A block times a factor that may cancel in its entries, applied to components.
    fn scaled_block(&self, factor: Expr<'g>, row: usize, column: usize, a: &Triple<'g>) -> Triple<'g> {
        std::array::from_fn(|i| (0..3).map(|j| factor * self.entries[row + i][column + j] * a[j]).sum())
    }

    /// Q, as `μ v_O + M₁₂ ω` when that is all there is, else in body axes.
    pub fn linear_momentum(&self, frame: &Frame<'g>, velocity: &Vector<'g>, omega: &Triple<'g>) -> Vector<'g> {
        let coupling = self.block(0, 3, omega);
        match self.isotropic {
            Some(mu) => velocity.times(mu).plus(&frame.body_vector(coupling)),
            None => {
                let u = frame.resolve(velocity, Axes::Body);
                frame.body_vector(add(&self.block(0, 0, &u), &coupling))
            }
        }
    }

    /// Γ_O in body axes.
    pub fn angular_momentum(&self, u: &Triple<'g>, omega: &Triple<'g>) -> Triple<'g> {
        add(&self.block(3, 0, u), &self.block(3, 3, omega))
    }

    /// Γ_O, as `I ω` in the axes of ω when that is all there is, else in body axes.
    pub fn angular_momentum_vector(
        &self,
        frame: &Frame<'g>,
        u: &Triple<'g>,
        angular_velocity: &Vector<'g>,
        omega: &Triple<'g>,
    ) -> Vector<'g> {
        match self.spherical {
            Some(inertia) => angular_velocity.times(inertia),
            None => frame.body_vector(self.angular_momentum(u, omega)),
        }
    }

    /// Whether translation is solved for together with rotation, or several components of one of the two with each
    /// other.
    pub fn is_coupled(&self, active: &[usize]) -> bool {
        let coupled = |i: &usize| active.iter().any(|j| i != j && !self.entries[*i][*j].is_zero());
        self.isotropic.is_none() && active.iter().any(coupled)
    }

    fn submatrix(&self, axes: &[usize]) -> Vec<Vec<Expr<'g>>> {
        axes.iter().map(|&i| axes.iter().map(|&j| self.entries[i][j]).collect()).collect()
    }
}

/// λ when the block on the given axes is λ·1.
fn multiple_of_identity<'g>(entries: &[Vec<Expr<'g>>], axes: &[usize]) -> Option<Expr<'g>> {
    let lambda = entries[*axes.first()?][axes[0]];
    let fits = |i: usize, j: usize| if i == j { entries[i][j] == lambda } else { entries[i][j].is_zero() };
    axes.iter().all(|&i| axes.iter().all(|&j| fits(i, j))).then_some(lambda)
}

/// Weight and buoyancy, and the weight in a field that is uniform over the matter: where the translation is eliminated
/// it leaves the balance of torques before numbers are put in.
#[derive(Default)]
pub struct Weights<'g> {
    pub gravity: Option<Weight<'g>>,
    pub field: Option<Weight<'g>>,
}

impl<'g> Weights<'g> {
    fn iter(&self) -> impl Iterator<Item = &Weight<'g>> {
        self.gravity.iter().chain(&self.field)
    }

    /// Weights with the formal components of each acceleration.
    fn with<'a>(&'a self, formal: &'a FormalComponents<'g>) -> impl Iterator<Item = (&'a Weight<'g>, &'a Triple<'g>)> {
        let gravity = self.gravity.iter().map(|weight| (weight, &formal.gravity));
        gravity.chain(self.field.iter().map(|weight| (weight, &formal.field)))
    }

    pub fn resultant(&self, frame: &Frame<'g>) -> Vector<'g> {
        self.iter().fold(frame.zero(), |sum, weight| sum.plus(&weight.resultant(frame)))
    }

    pub fn torque(&self, frame: &Frame<'g>, axes: Axes) -> Triple<'g> {
        self.iter().fold(frame.zero().body, |sum, weight| add(&sum, &weight.torque(frame, axes)))
    }
}

/// Formal components in body axes, in which the balance is solved once for all charts.
pub struct FormalComponents<'g> {
    pub u: Triple<'g>,
    pub omega: Triple<'g>,
    /// ĝ, and the acceleration of a field.
    pub gravity: Triple<'g>,
    pub field: Triple<'g>,
    /// Load beside the weights: its resultant, the parts that are given in body and in observer's axes, and its torque
    /// about O.
    pub force: Triple<'g>,
    pub observed_force: Triple<'g>,
    pub torque: Triple<'g>,
}

impl<'g> FormalComponents<'g> {
    pub fn new(kinematics: &Kinematics<'g>, load: &Wrench<'g>) -> Self {
        let graph = kinematics.frame.graph;
        let on = |axes: &[usize], text: &str, latex: &str| -> Triple<'g> {
            std::array::from_fn(|i| {
                if axes.contains(&i) {
                    graph.symbol(format!("{text}{}", i + 1), format!("{latex}_{{{}}}", i + 1), false)
                } else {
                    graph.zero()
                }
            })
        };
        let there = |a: &Triple<'g>| -> Vec<usize> { (0..3).filter(|&i| !a[i].is_zero()).collect() };
        let whole = |a: &Triple<'g>| if is_zero(a) { Vec::new() } else { vec![0, 1, 2] };
        let torque = kinematics.frame.resolve(&load.torque, Axes::Body);
        Self {
            u: on(&kinematics.linear_axes(), "u", "u"),
            omega: on(&kinematics.angular_axes(), "ω", "\\omega"),
            gravity: on(&[0, 1, 2], "gb", "\\hat g"),
            field: on(&[0, 1, 2], "γ", "\\gamma"),
            force: on(&there(&load.force.body), "R", "R"),
            observed_force: on(&whole(&load.force.space), "Rb", "\\hat R"),
            torque: on(&there(&torque), "M", "M"),
        }
    }

    /// Replaces the formal components by what they are in a chart.
    pub fn realisation(
        &self,
        kinematics: &Kinematics<'g>,
        weights: &Weights<'g>,
        load: &Wrench<'g>,
    ) -> Substitution<'g> {
        let frame = &kinematics.frame;
        let u = frame.resolve(&kinematics.velocity, Axes::Body);
        let omega = frame.resolve(&kinematics.angular_velocity, Axes::Body);
        let observed = frame.resolve(&frame.space_vector(load.force.space), Axes::Body);
        let torque = frame.resolve(&load.torque, Axes::Body);
        let mut map = Map::default();
        let in_body = |w: &Weight<'g>| frame.resolve(&frame.space_vector(w.gravity), Axes::Body);
        let accelerations = weights.with(self).map(|(weight, formal)| (formal, in_body(weight)));
        let pairs = [
            (&self.u, u),
            (&self.omega, omega),
            (&self.force, load.force.body),
            (&self.observed_force, observed),
            (&self.torque, torque),
        ];
        for (formal, real) in accelerations.chain(pairs) {
            map.extend(formal.iter().zip(real).filter(|(f, _)| !f.is_zero()).map(|(f, r)| (f.key(), r.group())));
        }
        Substitution::new(map)
    }
}

/// Forms in which the balance is solved; the cheapest result wins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BalanceForm {
    /// Momentum and force components stay quantities of their own.
    Structured,
    /// Right-hand sides are multiplied out and collected: what cancels is gone.
    Collected,
    /// Collected once more after the solve, so that the inverse is folded into constant coefficients.
    Folded,
    /// As collected, where the matrix of the unknowns is not diagonal, with LDLᵀ substituted in place of its inverse.
    Eliminated,
    /// As collected, with ω × (μ u + M₁₂ ω) as one product where the translation is isotropic: dQ/dt = Q̇ + ω × Q.
    Whole,
}

pub const ARRANGEMENTS: [BalanceForm; 3] = [BalanceForm::Structured, BalanceForm::Collected, BalanceForm::Folded];

/// The translational unknown of the balance, solved.
pub enum LinearAcceleration<'g> {
    /// dv_O/dt for the observer, each part in its natural axes.
    Observed(Vector<'g>),
    /// u̇: rates of the body components.
    Relative(Triple<'g>),
}

/// Accelerations from the balance, in formal body components (see [`FormalComponents`]).
pub struct Balance<'g> {
    /// Values of `dQ/dt` and of `dΓ_O/dt + v_O × Q` when the unknown accelerations are zero, minus the forces; body
    /// axes. Without the space part of the forces where the translation is isotropic.
    pub linear_bias: Triple<'g>,
    pub angular_bias: Triple<'g>,
    pub linear: LinearAcceleration<'g>,
    /// ω̇, body axes.
    pub angular: Triple<'g>,
}

/// The balance `dQ/dt = R`, `dΓ_O/dt + v_O × Q = M_O` — what (3.4) says for rigid partial velocities — solved for the
/// accelerations on the motion's axes.
pub fn solve_balance<'g>(
    kinematics: &Kinematics<'g>,
    matrix: &KineticMatrix<'g>,
    weights: &Weights<'g>,
    load: &Wrench<'g>,
    formal: &FormalComponents<'g>,
    arrangement: BalanceForm,
) -> Balance<'g> {
    let unsolved = BalanceProblem::new(kinematics, matrix, weights, load, formal, arrangement);
    match matrix.isotropic {
        Some(mu) => unsolved.translation_first(mu),
        None => unsolved.at_once(),
    }
}

/// The balance before its accelerations are known.
struct BalanceProblem<'a, 'g> {
    kinematics: &'a Kinematics<'g>,
    matrix: &'a KineticMatrix<'g>,
    weights: &'a Weights<'g>,
    load: &'a Wrench<'g>,
    formal: &'a FormalComponents<'g>,
    arrangement: BalanceForm,
    omega: Vector<'g>,
    /// M₁₂ ω, and Q.
    coupling: Triple<'g>,
    momentum: Triple<'g>,
    angular_bias: Triple<'g>,
    /// Weight and what else acts in observer's axes, seen in body axes.
    observed_in_body: Triple<'g>,
}

impl<'a, 'g> BalanceProblem<'a, 'g> {
    fn new(
        kinematics: &'a Kinematics<'g>,
        matrix: &'a KineticMatrix<'g>,
        weights: &'a Weights<'g>,
        load: &'a Wrench<'g>,
        formal: &'a FormalComponents<'g>,
        arrangement: BalanceForm,
    ) -> Self {
        let frame = &kinematics.frame;
        let zero = frame.zero().body;
        let omega = frame.body_vector(formal.omega);
        let torques = weights.with(formal).map(|(w, acceleration)| cross(&w.effective_moment, acceleration));
        let torque = add(&torques.fold(zero, |sum, torque| add(&sum, &torque)), &formal.torque);
        let coupling = matrix.block(0, 3, &formal.omega).map(Expr::group);
        let momentum = add(&matrix.block(0, 0, &formal.u), &matrix.block(0, 3, &formal.omega)).map(Expr::group);
        let gamma = matrix.angular_momentum(&formal.u, &formal.omega).map(Expr::group);
        // Rates of the formal components while the unknowns are zero: u̇ = a − ω × u when the unknown is a = dv_O/dt.
        let mut still = Map::default();
        if matrix.isotropic.is_some() {
            let drift = cross(&formal.u, &formal.omega);
            still.extend(formal.u.iter().zip(drift).map(|(u, rate)| (u.key(), rate)));
        }
        let angular_rate = frame.derivative(&frame.body_vector(gamma), &still, &omega).body;
        let angular_bias = subtract(&add(&angular_rate, &cross(&formal.u, &momentum)), &torque);
        let angular_bias = tidied(arrangement, angular_bias);
        let in_body = weights.with(formal).map(|(w, acceleration)| scale(w.effective_mass, acceleration));
        let weight_in_body = in_body.fold(zero, |sum, weight| add(&sum, &weight));
        let observed_in_body = add(&weight_in_body, &formal.observed_force);
        Self {
            kinematics,
            matrix,
            weights,
            load,
            formal,
            arrangement,
            omega,
            coupling,
            momentum,
            angular_bias,
            observed_in_body,
        }
    }

    fn tidy(&self, a: Triple<'g>) -> Triple<'g> {
        tidied(self.arrangement, a)
    }

    fn spread(&self, values: &[Expr<'g>], axes: &[usize]) -> Triple<'g> {
        let mut a = self.kinematics.frame.zero().body;
        axes.iter().zip(values).for_each(|(&k, v)| a[k] = *v);
        a
    }

    /// −matrix⁻¹ right.
    fn solved(&self, matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        if self.arrangement == BalanceForm::Eliminated {
            let right: Vec<Expr<'g>> = right.iter().map(|e| -*e).collect();
            return solve_symmetric(matrix, &right).into_iter().map(Expr::group).collect();
        }
        let fold = |e: Expr<'g>| if self.arrangement == BalanceForm::Folded { e.collected(LIMIT) } else { e };
        let inverse = inverse_of_symmetric(matrix);
        inverse.iter().map(|row| fold(-row.iter().zip(right).map(|(m, r)| *m * *r).sum::<Expr<'g>>()).group()).collect()
    }

    /// Translation eliminated first: a = (R − bias − M₁₂ ω̇)/μ.
    fn translation_first(&self, mu: Expr<'g>) -> Balance<'g> {
        let Self { kinematics, matrix, formal, omega, angular_bias, observed_in_body, .. } = *self;
        let frame = &kinematics.frame;
        let angular_axes = kinematics.angular_axes();
        let turning = frame.derivative(&frame.body_vector(self.coupling), &Map::default(), &omega).body;
        let linear_bias = self.tidy(subtract(&turning, &formal.force));
        let per_mass = mu.recip();
        let inner = scale(per_mass, &subtract(&linear_bias, &observed_in_body));
        let schur = schur_complement(matrix, per_mass, &angular_axes);
        let reduced = self.tidy(subtract(&angular_bias, &matrix.block(3, 0, &inner)));
        let angular = self.spread(&self.solved(&schur, &picked(&reduced, &angular_axes)), &angular_axes);
        if self.arrangement == BalanceForm::Whole {
            // (Q + M₁₂ ω̇)/μ and its like: what is divided by μ is constant.
            let momentum = add(&formal.u, &matrix.scaled_block(per_mass, 0, 3, &formal.omega)).map(Expr::group);
            let turning = frame.derivative(&frame.body_vector(momentum), &Map::default(), &omega).body;
            let acting = scale(per_mass, &add(&observed_in_body, &formal.force));
            let rest = add(&turning, &matrix.scaled_block(per_mass, 0, 3, &angular));
            let linear = LinearAcceleration::Relative(subtract(&acting, &rest).map(Expr::group));
            return Balance { linear_bias, angular_bias, linear, angular };
        }
        let rest = add(&linear_bias, &matrix.block(0, 3, &angular));
        let in_body = scale(-per_mass, &rest.map(Expr::group));
        let linear = self.observed(per_mass, in_body);
        let body_part = match linear.body {
            a if is_zero(&a) => a,
            a => a.map(Expr::group),
        };
        let linear = LinearAcceleration::Observed(Vector { body: body_part, ..linear });
        Balance { linear_bias, angular_bias, linear, angular }
    }

    /// An acceleration in body axes, and loads in observer's.
    fn observed(&self, per_mass: Expr<'g>, in_body: Triple<'g>) -> Vector<'g> {
        let frame = &self.kinematics.frame;
        let observed = frame.body_vector(in_body);
        let accelerations = self.weights.iter().map(|w| w.resultant(frame).times(per_mass));
        let linear = accelerations.fold(observed, |sum, acceleration| sum.plus(&acceleration));
        linear.plus(&frame.space_vector(self.load.force.space).times(per_mass))
    }

    /// u̇ and ω̇ together.
    fn at_once(&self) -> Balance<'g> {
        let Self { kinematics, formal, angular_bias, .. } = *self;
        let (frame, angular_axes, linear_axes) =
            (&kinematics.frame, kinematics.angular_axes(), kinematics.linear_axes());
        let linear_rate = frame.derivative(&frame.body_vector(self.momentum), &Map::default(), &self.omega).body;
        let linear_bias = self.tidy(subtract(&linear_rate, &add(&self.observed_in_body, &formal.force)));
        let mut right = picked(&linear_bias, &linear_axes);
        right.extend(picked(&angular_bias, &angular_axes));
        let solution = self.solved(&self.matrix.submatrix(&kinematics.active), &right);
        let (linear, angular) = solution.split_at(linear_axes.len());
        Balance {
            linear_bias,
            angular_bias,
            linear: LinearAcceleration::Relative(self.spread(linear, &linear_axes)),
            angular: self.spread(angular, &angular_axes),
        }
    }
}

fn tidied(arrangement: BalanceForm, a: Triple<'_>) -> Triple<'_> {
    match arrangement {
        BalanceForm::Structured => a,
        _ => a.map(|e| e.collected(LIMIT)),
    }
}

fn picked<'g>(a: &Triple<'g>, axes: &[usize]) -> Vec<Expr<'g>> {
    axes.iter().map(|&k| a[k]).collect()
}

/// `M₂₂ − M₂₁ M₁₂/μ` on the axes of rotation: the inertia that is left when the translation is eliminated.
fn schur_complement<'g>(matrix: &KineticMatrix<'g>, per_mass: Expr<'g>, axes: &[usize]) -> Vec<Vec<Expr<'g>>> {
    let entry = |i: usize, j: usize| {
        let products = (0..3).map(|k| matrix.entries[3 + i][k] * per_mass * matrix.entries[k][3 + j]);
        (matrix.entries[3 + i][3 + j] - products.sum()).collected(LIMIT).group()
    };
    axes.iter().map(|&i| axes.iter().map(|&j| entry(i, j)).collect()).collect()
}

/// Twist from momentum: v_O and ω, each part in the axes where it comes out naturally.
pub fn twist_of_momentum<'g>(
    kinematics: &Kinematics<'g>,
    matrix: &KineticMatrix<'g>,
    linear_momentum: &Vector<'g>,
    angular_momentum: &Vector<'g>,
    arrangement: BalanceForm,
) -> (Vector<'g>, Vector<'g>) {
    let frame = &kinematics.frame;
    if let (Some(inertia), true) = (matrix.spherical, matrix.isotropic.is_some() || kinematics.linear_axes().is_empty())
    {
        let per_mass = matrix.isotropic.map_or(frame.graph.one(), Expr::recip);
        return (linear_momentum.times(per_mass), angular_momentum.times(inertia.recip()));
    }
    let gamma = frame.resolve(angular_momentum, Axes::Body).map(Expr::group);
    let angular_axes = kinematics.angular_axes();
    let linear_axes = kinematics.linear_axes();
    let mut omega = frame.zero().body;
    if let Some(mu) = matrix.isotropic {
        let per_mass = mu.recip();
        let coupled = angular_axes.iter().any(|&i| linear_axes.iter().any(|&k| !matrix.entries[3 + i][k].is_zero()));
        let reduced = if coupled {
            let q = frame.resolve(linear_momentum, Axes::Body);
            subtract(&gamma, &matrix.scaled_block(per_mass, 3, 0, &q))
        } else {
            gamma
        };
        let inverse = inverse_of_symmetric(&schur_complement(matrix, per_mass, &angular_axes));
        for (row, &i) in angular_axes.iter().enumerate() {
            let terms = angular_axes.iter().enumerate().map(|(column, &j)| inverse[row][column] * reduced[j]);
            omega[i] = terms.sum::<Expr<'g>>().group();
        }
        let coupling = matrix.scaled_block(-per_mass, 0, 3, &omega);
        let velocity = linear_momentum.times(per_mass).plus(&frame.body_vector(coupling));
        return (velocity, frame.body_vector(omega));
    }
    let q = frame.resolve(linear_momentum, Axes::Body);
    let momentum: Vec<Expr<'g>> =
        linear_axes.iter().map(|&k| q[k]).chain(angular_axes.iter().map(|&k| gamma[k])).collect();
    let active = matrix.submatrix(&kinematics.active);
    let twist: Vec<Expr<'g>> = match arrangement {
        BalanceForm::Eliminated => solve_symmetric(&active, &momentum),
        _ => {
            let inverse = inverse_of_symmetric(&active);
            inverse.iter().map(|row| row.iter().zip(&momentum).map(|(m, p)| *m * *p).sum()).collect()
        }
    };
    let mut u = frame.zero().body;
    for (&k, component) in kinematics.active.iter().zip(twist) {
        if k < 3 { u[k] = component.group() } else { omega[k - 3] = component.group() }
    }
    (frame.body_vector(u), frame.body_vector(omega))
}
