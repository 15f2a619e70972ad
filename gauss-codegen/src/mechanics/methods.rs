//! Every method of a kernel as expressions of its arguments, in the chosen chart.

use std::cmp::Ordering;

use crate::algebra::{Expr, Graph, Map, Solver};

use super::accounts::Account;
use super::body::{Assigned, Body, BodyShape};
use super::chart::{ConfigurationKind, Kinematics};
use super::formula::{Formula, Method};
use super::momentum::{
    ARRANGEMENTS, Arrangement, Balance, Formal, KineticMatrix, LinearAcceleration, Weight, solve_balance,
    twist_of_momentum,
};
use super::names::Name;
use super::vector::{Axes, Triple, Vector, add, cross, dot, is_zero, subtract};
use super::wrench::{Acting, Wrench};
use crate::model::{Chart, Motion};

/// Terms that a volume of partial angular velocities may have on the way to its normal form.
const VOLUME_LIMIT: usize = 2000;

/// Linear momentum and the like, in the axes in which the rows of the kinematics are written.
#[derive(Clone, Copy)]
struct Pair<'g> {
    linear: Triple<'g>,
    angular: Triple<'g>,
}

/// A scene: one rigid body in one chart.
pub struct Scene<'g> {
    pub kinematics: Kinematics<'g>,
    pub body: Body<'g>,
    pub matrix: KineticMatrix<'g>,
    pub weight: Option<Weight<'g>>,
    /// What acts beside weight and buoyancy, and its wrench about O.
    pub acting: Option<Acting<'g>>,
    load: Wrench<'g>,
    /// Formal arguments: momenta p, and a twist of O in body axes.
    pub momenta: Vec<Expr<'g>>,
    pub twist: [Expr<'g>; 6],
    formal: Formal<'g>,
    /// Axes in which v_O and ω depend on z most simply, and the rows ∂v_O/∂z, ∂ω/∂z there.
    linear_in: Axes,
    angular_in: Axes,
    linear_rows: Vec<Triple<'g>>,
    angular_rows: Vec<Triple<'g>>,
    /// z from the twist, and (Q, Γ) from p: the rows and their transpose, on the motion's axes.
    from_twist: Solver<'g>,
    from_momenta: Solver<'g>,
}

/// What the balance of a body is made of.
#[derive(Clone, Copy)]
struct Terms<'a, 'g> {
    matrix: &'a KineticMatrix<'g>,
    weight: Option<&'a Weight<'g>>,
    load: &'a Wrench<'g>,
    formal: &'a Formal<'g>,
}

/// The chain z → (u, ω) → (Q, Γ_O) → p, each link in terms of the names of the one before; body axes.
pub struct PrintedMomenta<'g> {
    pub twist: [Expr<'g>; 6],
    pub linear: Triple<'g>,
    pub angular: Triple<'g>,
    pub conjugate: Vec<Expr<'g>>,
}

impl<'g> Scene<'g> {
    /// Of a body some of whose quantities may be `assigned` other values than parameters of their own.
    pub fn new(graph: &'g Graph, motion: Motion, chart: Chart, shape: BodyShape, assigned: &[Assigned<'g>]) -> Self {
        let up = if motion == Motion::Planar { 1 } else { 2 };
        let mut body = Body::new(graph, shape, up);
        assigned.iter().for_each(|assigned| body.assign(assigned));
        let kinematics = Kinematics::new(graph, motion, chart);
        let (linear, angular): (Vec<usize>, Vec<usize>) = kinematics.active.iter().partition(|&&k| k < 3);
        let matrix = KineticMatrix::new(graph, &body, &linear, &angular);
        let weight = Weight::new(&body);
        let load = Wrench::zero(graph);
        let formal = Formal::new(&kinematics, &load);
        let momenta = kinematics
            .momentum_names
            .iter()
            .map(|name| graph.symbol(name.text.clone(), name.latex.clone(), false))
            .collect();
        let twist = std::array::from_fn(|k| {
            let name = if k < 3 { Name::new("u", "u") } else { Name::new("ω", "\\omega") }.index(k % 3);
            graph.symbol(name.text, name.latex, false)
        });
        let rows = |velocity: &Vector<'g>| {
            let in_axes = |axes| -> Vec<Triple<'g>> {
                let resolved = kinematics.frame.resolve(velocity, axes);
                kinematics.speeds.iter().map(|&z| resolved.map(|e| e.partial(z))).collect()
            };
            let (body, space) = (in_axes(Axes::Body), in_axes(Axes::Space));
            let varying = |rows: &[Triple<'g>]| rows.iter().flatten().filter(|e| e.as_number().is_none()).count();
            let natural = if is_zero(&velocity.body) { Axes::Space } else { Axes::Body };
            match varying(&space).cmp(&varying(&body)) {
                Ordering::Less => (Axes::Space, space),
                Ordering::Equal if natural == Axes::Space => (Axes::Space, space),
                _ => (Axes::Body, body),
            }
        };
        let (linear_in, linear_rows) = rows(&kinematics.velocity);
        let (angular_in, angular_rows) = rows(&kinematics.angular_velocity);
        let rows: Vec<Vec<Expr<'g>>> = kinematics
            .active
            .iter()
            .map(|&k| {
                let rows = if k < 3 { &linear_rows } else { &angular_rows };
                rows.iter().map(|row| row[k % 3]).collect()
            })
            .collect();
        let transpose = (0..rows.len()).map(|j| rows.iter().map(|row| row[j]).collect()).collect();
        let solver = |rows| Solver::new(rows).expect("every chart of a free body is regular");
        let (from_twist, from_momenta) = (solver(rows), solver(transpose));
        Self {
            from_twist,
            from_momenta,
            kinematics,
            body,
            matrix,
            weight,
            acting: None,
            load,
            momenta,
            twist,
            formal,
            linear_in,
            angular_in,
            linear_rows,
            angular_rows,
        }
    }

    /// The same body with what acts on it beside weight and buoyancy.
    pub fn acted_upon(mut self, acting: Acting<'g>) -> Self {
        self.load = acting.total(self.kinematics.frame.graph);
        self.formal = Formal::new(&self.kinematics, &self.load);
        self.acting = Some(acting);
        self
    }

    pub fn formulas(&self) -> Vec<Formula<'g>> {
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let mut balances = Vec::from(ARRANGEMENTS.map(|arrangement| self.balance(arrangement)));
        if self.adds_momentum() {
            balances.push(self.balance(Arrangement::Whole));
        }
        let short = self.short();
        let residuals: Vec<Vec<Expr<'g>>> =
            balances[..2].iter().map(|b| self.residual(b)).chain(short.as_ref().map(|s| s.residual.clone())).collect();
        let with_short = |method, outputs, short: Option<&Vec<Expr<'g>>>| Formula {
            method,
            arrangements: [Some(outputs), short.cloned()].into_iter().flatten().collect(),
        };
        let momentum = self.momentum();
        let (pair, velocity) = self.state_of_momentum();
        let constraint = residuals.iter().map(|r| vec![self.constraint_function(r)]).collect();
        let mut formulas = vec![
            single(Method::Kinematics, self.configuration_rate()),
            Formula {
                method: Method::Acceleration,
                arrangements: balances
                    .iter()
                    .map(|b| self.acceleration(b))
                    .chain(short.as_ref().and_then(|s| s.acceleration.clone()))
                    .collect(),
            },
            single(Method::MomentumRate, self.momentum_rate(pair, &velocity)),
            with_short(Method::MassMatrix, self.mass_matrix(&momentum), short.as_ref().map(|s| &s.matrix)),
            with_short(Method::Momentum, momentum, short.as_ref().map(|s| &s.momentum)),
            with_short(Method::Velocity, velocity, short.as_ref().and_then(|s| s.velocity.as_ref())),
            with_short(Method::KineticEnergy, vec![self.kinetic_energy()], short.as_ref().map(|s| &s.kinetic_energy)),
            single(Method::PotentialEnergy, vec![self.potential_energy()]),
            Formula { method: Method::GaussResidual, arrangements: residuals },
            Formula { method: Method::ConstraintFunction, arrangements: constraint },
            single(Method::BodyTwist, self.body_twist().to_vec()),
            single(Method::Speeds, self.speeds()),
            single(Method::BodyMomentum, self.body_momentum()),
        ];
        formulas.extend(self.regularity().map(|outputs| single(Method::Regularity, outputs)));
        if let Some(acting) = &self.acting {
            formulas.extend(acting.formulas(&self.accounts(), self.kinematics.frame.graph));
        }
        formulas.sort_by_key(|f| f.method);
        formulas
    }

    /// ∂C/∂ż of another body in place of this one, without what acts beside weight and buoyancy, arranged in two ways.
    pub fn inertial_residuals(&self, body: &Body<'g>) -> Vec<Vec<Expr<'g>>> {
        let kinematics = &self.kinematics;
        let load = Wrench::zero(kinematics.frame.graph);
        let (linear, angular): (Vec<usize>, Vec<usize>) = kinematics.active.iter().partition(|&&k| k < 3);
        let weight = Weight::new(body);
        let terms = Terms {
            matrix: &KineticMatrix::new(kinematics.frame.graph, body, &linear, &angular),
            weight: weight.as_ref(),
            load: &load,
            formal: &Formal::new(kinematics, &load),
        };
        let residual = |arrangement| {
            let Terms { matrix, weight, load, formal } = terms;
            self.residual_of(&terms, &solve_balance(kinematics, matrix, weight, load, formal, arrangement))
        };
        [Arrangement::Structured, Arrangement::Collected].map(residual).into()
    }

    /// `R·a_α + M_O·o_α` of what acts beside weight and buoyancy.
    pub fn load_forces(&self) -> Vec<Expr<'g>> {
        self.project_wrench(&self.load)
    }

    /// Whether Q has parts of u and of ω that turn together: then their sum is turned once.
    fn adds_momentum(&self) -> bool {
        let coupled = || (0..3).any(|i| (3..6).any(|j| !self.matrix.entries[i][j].is_zero()));
        self.matrix.isotropic.is_some() && self.linear_in == Axes::Body && coupled()
    }

    /// One account for each element of what acts, with weight and buoyancy first; none where nothing else acts.
    pub fn accounts(&self) -> Vec<Account<'g>> {
        let frame = &self.kinematics.frame;
        let weight = self.weight.as_ref().map(|w| Wrench {
            force: w.resultant(frame),
            torque: self.vector(self.angular_in, w.torque(frame, self.angular_in)),
        });
        let accounts = |acting: &Acting<'g>| acting.accounts(&self.kinematics, weight, |w| self.project_wrench(w));
        self.acting.as_ref().map(accounts).unwrap_or_default()
    }

    /// `R·a_α + M_O·o_α` of a wrench about O.
    fn project_wrench(&self, wrench: &Wrench<'g>) -> Vec<Expr<'g>> {
        let pair = self.resolve(&wrench.force, &wrench.torque);
        self.project(Pair { linear: pair.linear.map(Expr::group), angular: pair.angular.map(Expr::group) })
    }

    /// `None` where the coordinates have no singularity: the volume that the columns of ∂ω/∂q̇ span is constant.
    fn regularity(&self) -> Option<Vec<Expr<'g>>> {
        let columns: Vec<&Triple<'g>> = self.angular_rows.iter().filter(|column| !is_zero(column)).collect();
        let [a, b, c] = columns[..] else { return None };
        let volume = dot(a, &cross(b, c)).collected(VOLUME_LIMIT);
        let lengths = [a, b, c].map(|column| dot(column, column).collected(VOLUME_LIMIT));
        let product = lengths[0] * lengths[1] * lengths[2];
        let ratio = (volume * volume * product.recip()).collected(VOLUME_LIMIT);
        ratio.as_number().is_none().then(|| vec![volume, product])
    }

    fn in_body(&self, a: &Vector<'g>) -> Triple<'g> {
        self.kinematics.frame.resolve(a, Axes::Body).map(Expr::group)
    }

    fn zero(&self) -> Triple<'g> {
        [self.kinematics.frame.graph.zero(); 3]
    }

    /// `Σ linear_k ∂v_k/∂z^α + angular_k ∂ω_k/∂z^α` for every α: pairs what is dual to the twist with a_α and o_α.
    fn project(&self, dual: Pair<'g>) -> Vec<Expr<'g>> {
        self.linear_rows
            .iter()
            .zip(&self.angular_rows)
            .map(|(a, o)| dot(a, &dual.linear) + dot(o, &dual.angular))
            .collect()
    }

    /// z from the twist (or ż from its rate): solves `Σ_α (a_α, o_α) z^α = right` on the motion's axes.
    fn lift(&self, right: Pair<'g>) -> Vec<Expr<'g>> {
        let on = |&k: &usize| if k < 3 { right.linear[k] } else { right.angular[k - 3] };
        self.from_twist.solve(&self.kinematics.active.iter().map(on).collect::<Vec<_>>())
    }

    /// The dual of `lift`: (Q, Γ) from p.
    fn momentum_pair(&self, p: &[Expr<'g>]) -> Pair<'g> {
        let mut pair = Pair { linear: self.zero(), angular: self.zero() };
        for (&k, value) in self.kinematics.active.iter().zip(self.from_momenta.solve(p)) {
            if k < 3 { pair.linear[k] = value } else { pair.angular[k - 3] = value }
        }
        pair
    }

    fn vector(&self, axes: Axes, a: Triple<'g>) -> Vector<'g> {
        match axes {
            Axes::Body => self.kinematics.frame.body_vector(a),
            Axes::Space => self.kinematics.frame.space_vector(a),
        }
    }

    /// Components in the axes of the rows.
    fn resolve(&self, linear: &Vector<'g>, angular: &Vector<'g>) -> Pair<'g> {
        let frame = &self.kinematics.frame;
        Pair { linear: frame.resolve(linear, self.linear_in), angular: frame.resolve(angular, self.angular_in) }
    }

    /// ψ: the twist (u, ω) of O in body axes for group-valued configurations, else q̇.
    fn configuration_rate(&self) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        if kinematics.kind == ConfigurationKind::Coordinates {
            return kinematics.speeds.clone();
        }
        let twist = self.body_twist();
        kinematics.active.iter().map(|&k| twist[k]).collect()
    }

    /// (u, ω), body axes, pole O.
    fn body_twist(&self) -> [Expr<'g>; 6] {
        let u = self.in_body(&self.kinematics.velocity);
        let omega = self.in_body(&self.kinematics.angular_velocity);
        [u[0], u[1], u[2], omega[0], omega[1], omega[2]]
    }

    /// z from (u, ω).
    fn speeds(&self) -> Vec<Expr<'g>> {
        let [u1, u2, u3, w1, w2, w3] = self.twist;
        let frame = &self.kinematics.frame;
        self.lift(self.resolve(&frame.body_vector([u1, u2, u3]), &frame.body_vector([w1, w2, w3])))
    }

    /// (Q, Γ_O) of body and fluid, body axes: all six components, also those that the motion's guide takes up.
    fn body_momentum(&self) -> Vec<Expr<'g>> {
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = add(&self.matrix.block(0, 0, &u), &self.matrix.block(0, 3, &omega));
        let gamma = self.matrix.angular_momentum(&u, &omega);
        q.into_iter().chain(gamma).collect()
    }

    /// p_α = Q·a_α + Γ_O·o_α.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        let frame = &self.kinematics.frame;
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = self.matrix.linear_momentum(frame, &self.kinematics.velocity, &omega);
        let spin = &self.kinematics.angular_velocity;
        let gamma = self.matrix.angular_momentum_vector(frame, &u, spin, &omega).map(Expr::group);
        let pair = self.resolve(&q, &gamma);
        self.project(Pair { linear: pair.linear.map(Expr::group), angular: pair.angular.map(Expr::group) })
    }

    /// From (q, p): (Q, Γ) by duality, the twist by M⁻¹, z by the kinematics.
    fn state_of_momentum(&self) -> (Pair<'g>, Vec<Expr<'g>>) {
        let pair = self.momentum_pair(&self.momenta);
        let linear = self.vector(self.linear_in, pair.linear.map(Expr::group));
        let gamma = self.vector(self.angular_in, pair.angular.map(Expr::group));
        let (velocity, omega) = twist_of_momentum(&self.kinematics, &self.matrix, &linear, &gamma);
        (pair, self.lift(self.resolve(&velocity, &omega)))
    }

    /// ṗ_α = Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α + R·a_α + M_O·o_α, a function of (q, p).
    fn momentum_rate(&self, pair: Pair<'g>, speeds: &[Expr<'g>]) -> Vec<Expr<'g>> {
        // The bracket is formed with formal Q, Γ and z, which are then replaced by what they are in terms of p.
        let graph = self.kinematics.frame.graph;
        let formal = |a: &Triple<'g>| a.map(|e| if e.is_zero() { e } else { graph.symbol("P", "P", false) });
        let symbols = Pair { linear: formal(&pair.linear), angular: formal(&pair.angular) };
        let bracket = self.bracket(symbols);
        let mut replacement: Map<u32, Expr<'g>> = Map::default();
        for (symbols, values) in [(symbols.linear, pair.linear), (symbols.angular, pair.angular)] {
            replacement.extend(symbols.iter().zip(values).map(|(s, v)| (s.key(), v.group())));
        }
        replacement.extend(self.kinematics.speeds.iter().zip(speeds).map(|(z, value)| (z.key(), value.group())));
        let forces = self.generalised_forces();
        bracket.into_iter().zip(forces).map(|(b, f)| (b + f).substitute(&replacement)).collect()
    }

    /// `Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α` along the flow with ż = 0; Q and Γ_O in the axes of the rows. Where a_α or o_α
    /// turns with the body, `Q·(ω × a_α) = (Q × ω)·a_α`: one cross product serves all α.
    fn bracket(&self, momentum: Pair<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let q = self.vector(self.linear_in, momentum.linear);
        let gamma = self.vector(self.angular_in, momentum.angular);
        let turning = |a: &Vector<'g>, axes: Axes| match axes {
            Axes::Body => frame.resolve(&frame.cross(a, &kinematics.angular_velocity), Axes::Body),
            Axes::Space => self.zero(),
        };
        let linear_dual = turning(&q, self.linear_in);
        let moved = frame.resolve(&frame.cross(&q, &kinematics.velocity), self.angular_in);
        let angular_dual = add(&moved, &turning(&gamma, self.angular_in));
        let constant = self.project(Pair { linear: linear_dual, angular: angular_dual });
        let rate = |row: &Triple<'g>| row.map(|e| e.derivative(&kinematics.rates));
        self.linear_rows
            .iter()
            .zip(&self.angular_rows)
            .zip(constant)
            .map(|((a, o), turned)| turned + dot(&momentum.linear, &rate(a)) + dot(&momentum.angular, &rate(o)))
            .collect()
    }

    /// The bracket for a reader: in terms of p where (Q, Γ) follow from p without division, else of Γ_O too.
    pub fn printed_bracket(&self) -> Vec<Expr<'g>> {
        if self.kinematics.kind != ConfigurationKind::Coordinates {
            return self.bracket(self.momentum_pair(&self.momenta));
        }
        let uncoupled = (0..3).all(|i| (3..6).all(|j| self.matrix.entries[i][j].is_zero()));
        // Q = μ v_O needs no name: v_O × Q is then seen to vanish. Else its components are the momenta of b.
        let mut q = self.zero();
        self.kinematics.linear_axes().into_iter().zip(&self.momenta).for_each(|(k, p)| q[k] = *p);
        let linear = match self.matrix.isotropic {
            Some(mu) if uncoupled => self.kinematics.frame.resolve(&self.kinematics.velocity.times(mu), self.linear_in),
            _ => q,
        };
        let mut gamma = self.zero();
        for i in self.kinematics.angular_axes() {
            let name = Name::new("Γ", "\\Gamma").index(i);
            gamma[i] = self.kinematics.frame.graph.symbol(name.text, name.latex, false);
        }
        self.bracket(Pair { linear, angular: gamma })
    }

    /// p in terms of names for Q and Γ_O, and their components in body axes in terms of the twist: for readers of
    /// scenes whose p would be too long in terms of z.
    pub fn printed_momenta(&self) -> PrintedMomenta<'g> {
        let frame = &self.kinematics.frame;
        let symbol = |name: Name| frame.graph.symbol(name.text, name.latex, false);
        let triple = |name: Name, axes: &[usize]| -> Triple<'g> {
            std::array::from_fn(|i| if axes.contains(&i) { symbol(name.index(i)) } else { frame.graph.zero() })
        };
        let on = |first: usize| -> Triple<'g> {
            let kept = |i: usize| self.kinematics.active.contains(&(first + i));
            std::array::from_fn(|i| if kept(i) { self.twist[first + i] } else { frame.graph.zero() })
        };
        let (u, omega) = (on(0), on(3));
        let linear = add(&self.matrix.block(0, 0, &u), &self.matrix.block(0, 3, &omega));
        let q = triple(Name::new("Q", "Q"), &self.kinematics.linear_axes());
        let gamma = triple(Name::new("Γ", "\\Gamma"), &self.kinematics.angular_axes());
        PrintedMomenta {
            twist: self.body_twist(),
            linear,
            angular: self.matrix.angular_momentum(&u, &omega),
            conjugate: self.project(self.resolve(&frame.body_vector(q), &frame.body_vector(gamma))),
        }
    }

    /// ∂C/∂ż with what cancels gone.
    pub fn collected_residual(&self) -> Vec<Expr<'g>> {
        self.residual(&self.balance(Arrangement::Collected))
    }

    /// R·a_α + M_O·o_α.
    pub fn generalised_forces(&self) -> Vec<Expr<'g>> {
        let frame = &self.kinematics.frame;
        let pair = match &self.weight {
            Some(w) => Pair {
                linear: frame.resolve(&w.resultant(frame), self.linear_in),
                angular: w.torque(frame, self.angular_in),
            },
            None => Pair { linear: self.zero(), angular: self.zero() },
        };
        let load = self.resolve(&self.load.force, &self.load.torque);
        let named = |a: &Triple<'g>, b: &Triple<'g>| if is_zero(b) { *a } else { add(a, &b.map(Expr::group)) };
        self.project(Pair { linear: named(&pair.linear, &load.linear), angular: named(&pair.angular, &load.angular) })
    }

    fn balance(&self, arrangement: Arrangement) -> Balance<'g> {
        solve_balance(&self.kinematics, &self.matrix, self.weight.as_ref(), &self.load, &self.formal, arrangement)
    }

    /// ż from the balance in body axes, through the rate of the kinematics.
    fn acceleration(&self, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let real = self.formal.realisation(kinematics, self.weight.as_ref(), &self.load);
        let realise = |e: Expr<'g>| e.substitute(&real);
        let angular = frame.body_vector(balance.angular.map(realise).map(Expr::group));
        let velocity = frame.resolve(&kinematics.velocity, self.linear_in);
        let omega = frame.resolve(&kinematics.angular_velocity, self.angular_in);
        // Rates of the components for ż = 0 go to the right-hand side.
        let still = |a: &Triple<'g>| a.map(|e| e.derivative(&kinematics.rates));
        let in_body = |a: &Vector<'g>| self.in_body(a);
        let linear = match (&balance.linear, self.linear_in) {
            (LinearAcceleration::Observed(a), Axes::Space) => frame.resolve(&a.map(realise), Axes::Space),
            (LinearAcceleration::Observed(a), Axes::Body) => {
                let drift = cross(&in_body(&kinematics.angular_velocity), &in_body(&kinematics.velocity));
                subtract(&frame.resolve(&a.map(realise), Axes::Body), &drift)
            }
            (LinearAcceleration::Relative(a), Axes::Body) => a.map(realise),
            (LinearAcceleration::Relative(a), Axes::Space) => {
                let drift = cross(&in_body(&kinematics.angular_velocity), &in_body(&kinematics.velocity));
                frame.resolve(&frame.body_vector(add(&a.map(realise), &drift)), Axes::Space)
            }
        };
        let angular = frame.resolve(&angular, self.angular_in);
        let right = Pair { linear: subtract(&linear, &still(&velocity)), angular: subtract(&angular, &still(&omega)) };
        self.lift(right)
    }

    /// A: the upper triangle is derived, ∂p_α/∂z^β, and mirrored.
    fn mass_matrix(&self, momentum: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let n = momentum.len();
        let speeds = &self.kinematics.speeds;
        let mut matrix = vec![self.kinematics.frame.graph.zero(); n * n];
        for row in 0..n {
            for column in row..n {
                let entry = momentum[row].partial(speeds[column]);
                matrix[row * n + column] = entry;
                matrix[column * n + row] = entry;
            }
        }
        matrix
    }

    /// T = ½ (Q·v_O + Γ_O·ω).
    pub fn kinetic_energy(&self) -> Expr<'g> {
        let frame = &self.kinematics.frame;
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = self.matrix.linear_momentum(frame, &self.kinematics.velocity, &omega).map(Expr::group);
        let spin = &self.kinematics.angular_velocity;
        let gamma = self.matrix.angular_momentum_vector(frame, &u, spin, &omega).map(Expr::group);
        (frame.dot(&q, &self.kinematics.velocity) + frame.dot(&gamma, spin)).half()
    }

    fn potential_energy(&self) -> Expr<'g> {
        let frame = &self.kinematics.frame;
        let weight = self.weight.as_ref().map_or(frame.graph.zero(), |w| w.potential(frame, &self.kinematics.position));
        self.acting.as_ref().and_then(Acting::potential).map_or(weight, |other| weight + other)
    }

    /// ∂C/∂ż: `(dQ/dt − R)·a_α + (dΓ_O/dt + v_O × Q − M_O)·o_α` at a given ż.
    fn residual(&self, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        self.residual_of(&self.terms(), balance)
    }

    fn terms(&self) -> Terms<'_, 'g> {
        Terms { matrix: &self.matrix, weight: self.weight.as_ref(), load: &self.load, formal: &self.formal }
    }

    fn residual_of(&self, terms: &Terms<'_, 'g>, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let real = terms.formal.realisation(kinematics, terms.weight, terms.load);
        let bias = |a: Triple<'g>| a.map(|e| e.substitute(&real));
        let along = kinematics.rates_with_accelerations();
        let omega = &kinematics.angular_velocity;
        let a = frame.derivative(&kinematics.velocity, &along, omega).map(Expr::group);
        let angular_rate = frame.resolve(omega, self.angular_in).map(|e| e.derivative(&along).group());
        let alpha = self.in_body(&self.vector(self.angular_in, angular_rate));
        let drift = cross(&self.in_body(omega), &self.in_body(&kinematics.velocity));
        let coupling = terms.matrix.block(0, 3, &alpha);
        let (linear, u_rate) = match terms.matrix.isotropic {
            Some(mu) => {
                let weight = terms.weight.map_or(frame.zero(), |w| w.resultant(frame));
                let weight = weight.plus(&frame.space_vector(terms.load.force.space));
                let in_body = add(&coupling, &bias(balance.linear_bias));
                (a.times(mu).plus(&frame.body_vector(in_body)).minus(&weight), self.in_body(&a))
            }
            None => {
                let u_rate = match self.linear_in {
                    Axes::Body => frame.resolve(&kinematics.velocity, Axes::Body).map(|e| e.derivative(&along)),
                    Axes::Space => subtract(&self.in_body(&a), &drift).map(Expr::group),
                };
                let inertia = add(&terms.matrix.block(0, 0, &u_rate), &coupling);
                (frame.body_vector(add(&inertia, &bias(balance.linear_bias))), u_rate)
            }
        };
        let angular = add(&terms.matrix.angular_momentum(&u_rate, &alpha), &bias(balance.angular_bias));
        let linear = linear.map(Expr::group);
        self.project(self.resolve(&linear, &frame.body_vector(angular.map(Expr::group))))
    }

    /// C up to a constant in ż: its gradient is linear in ż, so `C = ½ ż·(∂C/∂ż(ż) + ∂C/∂ż(0))`.
    fn constraint_function(&self, residual: &[Expr<'g>]) -> Expr<'g> {
        let graph = self.kinematics.frame.graph;
        let at_rest: Map<u32, Expr<'g>> =
            self.kinematics.speed_rates.iter().map(|dz| (dz.key(), graph.zero())).collect();
        residual
            .iter()
            .zip(&self.kinematics.speed_rates)
            .map(|(r, &dz)| dz * (*r + r.substitute(&at_rest)))
            .sum::<Expr<'g>>()
            .half()
    }
}
