//! Systems of bodies and particles in coordinates of their own: velocities by differentiation along ψ (3.2), and the
//! Gauss condition (3.3), (3.4) summed over all of them.

use crate::algebra::{Expr, Graph, Map, solve_symmetric};

use super::body::Body;
use super::equations::tidy;
use super::methods::{Formula, Method};
use super::momentum::{KineticMatrix, Weight};
use super::names::Name;
use super::rotation::{about_axis, product};
use super::vector::{Axes, Frame, Motion, Triple, Vector, add, apply_block, cross, dot, is_zero, scale};

/// A turn by an angle about an axis of the already turned frame; a rotation is a product of turns.
#[derive(Clone, Copy, Debug)]
pub struct Turn<'g> {
    pub axis: usize,
    pub angle: Expr<'g>,
}

/// A body as it is given: relative to its parent's O and axes, or to Ω and k.
pub struct Link<'g> {
    pub body: Body<'g>,
    pub parent: Option<usize>,
    pub position: Triple<'g>,
    pub turns: Vec<Turn<'g>>,
}

/// A particle (3.3).
pub struct Particle<'g> {
    pub mass: Expr<'g>,
    pub position: Triple<'g>,
}

/// A system as it is given: every expression in terms of t, q, z and parameters.
pub struct SystemScene<'g> {
    pub graph: &'g Graph,
    pub time: Expr<'g>,
    pub coordinates: Vec<Expr<'g>>,
    pub coordinate_names: Vec<Name>,
    pub speeds: Vec<Expr<'g>>,
    pub speed_names: Vec<Name>,
    pub speed_rates: Vec<Expr<'g>>,
    pub momenta: Vec<Expr<'g>>,
    /// ψ, one for each coordinate, affine in z.
    pub kinematics: Vec<Expr<'g>>,
    pub links: Vec<Link<'g>>,
    pub particles: Vec<Particle<'g>>,
    pub potential: Option<Expr<'g>>,
    /// Acceleration of free fall, observer's axes.
    pub gravity: Option<Triple<'g>>,
}

/// A body with its motion.
pub struct MovingBody<'g> {
    pub frame: Frame<'g>,
    /// O − Ω, observer's components.
    pub position: Triple<'g>,
    pub velocity: Vector<'g>,
    /// Body axes.
    pub angular_velocity: Triple<'g>,
    /// ∂v_O/∂z^α and ∂ω/∂z^α.
    linear_rows: Vec<Vector<'g>>,
    angular_rows: Vec<Triple<'g>>,
    matrix: KineticMatrix<'g>,
    weight: Option<Weight<'g>>,
}

/// A system with the motion of all its parts.
pub struct System<'g> {
    pub scene: SystemScene<'g>,
    pub bodies: Vec<MovingBody<'g>>,
    /// Rates of t and q, and those with ż.
    pub rates: Map<u32, Expr<'g>>,
    pub along: Map<u32, Expr<'g>>,
    /// Velocities of the particles, and ∂v/∂z^α.
    particles: Vec<(Triple<'g>, Vec<Triple<'g>>)>,
    /// A, tidied, so that what vanishes is seen to.
    pub matrix: Vec<Vec<Expr<'g>>>,
}

impl<'g> SystemScene<'g> {
    /// Rates of t and q: ψ.
    pub fn rates(&self) -> Map<u32, Expr<'g>> {
        let q = self.coordinates.iter().zip(&self.kinematics).map(|(q, rate)| (q.key(), *rate));
        q.chain([(self.time.key(), self.graph.one())]).collect()
    }

    /// Coordinates whose ψ is not affine in z: velocities would then not be linear in z, and (3.4) not this one.
    pub fn coordinates_not_affine(&self) -> Vec<usize> {
        let affine = |rate: &Expr<'g>| {
            self.speeds.iter().all(|&z| {
                let partial = rate.partial(z);
                self.speeds.iter().all(|&w| tidy(partial.partial(w)).is_zero())
            })
        };
        (0..self.kinematics.len()).filter(|&k| !affine(&self.kinematics[k])).collect()
    }
}

impl<'g> System<'g> {
    pub fn new(scene: SystemScene<'g>) -> Self {
        let rates = scene.rates();
        let mut along = rates.clone();
        along.extend(scene.speeds.iter().zip(&scene.speed_rates).map(|(z, rate)| (z.key(), *rate)));
        let mut moving: Vec<Option<MovingBody<'g>>> = scene.links.iter().map(|_| None).collect();
        // Parents may be written after their children.
        while let Some(next) = (0..scene.links.len())
            .find(|&k| moving[k].is_none() && scene.links[k].parent.is_none_or(|parent| moving[parent].is_some()))
        {
            let parent = scene.links[next].parent.and_then(|parent| moving[parent].as_ref());
            moving[next] = Some(MovingBody::new(&scene, &scene.links[next], parent, &rates));
        }
        let bodies: Vec<MovingBody<'g>> = moving.into_iter().flatten().collect();
        let particles: Vec<(Triple<'g>, Vec<Triple<'g>>)> = scene
            .particles
            .iter()
            .map(|particle| {
                let velocity = particle.position.map(|e| e.derivative(&rates));
                (velocity, scene.speeds.iter().map(|&z| velocity.map(|e| e.partial(z))).collect())
            })
            .collect();
        let mut system = Self { scene, bodies, rates, along, particles, matrix: Vec::new() };
        system.matrix = system.mass_matrix();
        system
    }

    fn degrees(&self) -> std::ops::Range<usize> {
        0..self.scene.speeds.len()
    }

    fn zeros(&self) -> Vec<Expr<'g>> {
        vec![self.scene.graph.zero(); self.scene.speeds.len()]
    }

    pub fn formulas(&self) -> Vec<Formula<'g>> {
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let residual = self.residual();
        let collected: Vec<Expr<'g>> = residual.iter().map(|e| tidy(*e)).collect();
        let residuals = vec![residual, collected];
        let momentum = self.momentum();
        let velocity = self.velocity(&momentum);
        let rate = self.momentum_rate(&velocity);
        vec![
            single(Method::Kinematics, self.scene.kinematics.clone()),
            Formula {
                method: Method::Acceleration,
                arrangements: residuals.iter().map(|r| self.acceleration(r)).collect(),
            },
            Formula {
                method: Method::Momentum,
                arrangements: vec![momentum.iter().map(|p| tidy(*p)).collect(), momentum],
            },
            single(Method::Velocity, velocity),
            single(Method::MomentumRate, rate),
            single(Method::MassMatrix, self.matrix.iter().flatten().copied().collect()),
            self.energy(Method::KineticEnergy, self.kinetic_energy()),
            self.energy(Method::PotentialEnergy, self.potential_energy()),
            Formula {
                method: Method::ConstraintFunction,
                arrangements: residuals.iter().map(|r| vec![self.constraint_function(r)]).collect(),
            },
            Formula { method: Method::GaussResidual, arrangements: residuals },
        ]
    }

    fn energy(&self, method: Method, e: Expr<'g>) -> Formula<'g> {
        Formula { method, arrangements: vec![vec![tidy(e)], vec![e]] }
    }

    /// p_α = ∂T/∂z^α = Σ Q·a_α + Γ_O·o_α, and m v·a_α for particles.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        let mut p = self.zeros();
        for body in &self.bodies {
            let (q, gamma) = body.momentum(&body.velocity, &body.angular_velocity);
            for k in self.degrees() {
                p[k] = p[k] + body.project(k, &q, &gamma);
            }
        }
        for (particle, (velocity, rows)) in self.scene.particles.iter().zip(&self.particles) {
            let momentum = scale(particle.mass, velocity);
            for k in self.degrees() {
                p[k] = p[k] + dot(&momentum, &rows[k]);
            }
        }
        p
    }

    /// A_αβ = ∂p_α/∂z^β: the momentum that the partial velocities of β alone have.
    fn mass_matrix(&self) -> Vec<Vec<Expr<'g>>> {
        let n = self.scene.speeds.len();
        let mut matrix = vec![self.zeros(); n];
        for column in self.degrees() {
            let mut entries = self.zeros();
            for body in &self.bodies {
                let (q, gamma) = body.momentum(&body.linear_rows[column], &body.angular_rows[column]);
                for row in 0..=column {
                    entries[row] = entries[row] + body.project(row, &q, &gamma);
                }
            }
            for (particle, (_, rows)) in self.scene.particles.iter().zip(&self.particles) {
                for row in 0..=column {
                    entries[row] = entries[row] + particle.mass * dot(&rows[column], &rows[row]);
                }
            }
            for row in 0..=column {
                matrix[row][column] = tidy(entries[row]);
                matrix[column][row] = matrix[row][column];
            }
        }
        matrix
    }

    /// Speeds that no velocity depends on: their rows of A are zero.
    pub fn idle_speeds(&self) -> Vec<usize> {
        self.degrees().filter(|&k| self.matrix[k].iter().all(|e| e.is_zero())).collect()
    }

    /// R·a_α + M_O·o_α of weight and buoyancy, and −∂(dU/dt)/∂z^α of the potential.
    pub fn generalised_forces(&self) -> Vec<Expr<'g>> {
        let mut forces = self.zeros();
        for body in &self.bodies {
            let Some(weight) = &body.weight else { continue };
            let resultant = weight.resultant(&body.frame);
            let torque = weight.torque(&body.frame, Axes::Body);
            for k in self.degrees() {
                forces[k] = forces[k] + body.project(k, &resultant, &torque);
            }
        }
        if let Some(gravity) = &self.scene.gravity {
            for (particle, (_, rows)) in self.scene.particles.iter().zip(&self.particles) {
                for k in self.degrees() {
                    forces[k] = forces[k] + particle.mass * dot(gravity, &rows[k]);
                }
            }
        }
        if let Some(potential) = self.scene.potential {
            let power = potential.derivative(&self.rates);
            for k in self.degrees() {
                forces[k] = forces[k] - power.partial(self.scene.speeds[k]);
            }
        }
        forces
    }

    /// ∂C/∂ż: `Σ dQ/dt·a_α + (dΓ_O/dt + v_O × Q)·o_α − forces` at a given ż.
    pub fn residual(&self) -> Vec<Expr<'g>> {
        let mut residual = self.zeros();
        for (body, link) in self.bodies.iter().zip(&self.scene.links) {
            let (force, torque) = body.inertia_forces(&link.body, &self.along);
            for k in self.degrees() {
                residual[k] = residual[k] + body.project(k, &force, &torque);
            }
        }
        for (particle, (velocity, rows)) in self.scene.particles.iter().zip(&self.particles) {
            let rate = velocity.map(|e| (particle.mass * e.derivative(&self.along)).group());
            for k in self.degrees() {
                residual[k] = residual[k] + dot(&rate, &rows[k]);
            }
        }
        residual.into_iter().zip(self.generalised_forces()).map(|(r, f)| r - f).collect()
    }

    fn at_rest(&self) -> Map<u32, Expr<'g>> {
        self.scene.speed_rates.iter().map(|rate| (rate.key(), self.scene.graph.zero())).collect()
    }

    /// A ż = −∂C/∂ż(ż = 0).
    fn acceleration(&self, residual: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let at_rest = self.at_rest();
        let right: Vec<Expr<'g>> = residual.iter().map(|r| -r.substitute(&at_rest)).collect();
        solve_symmetric(&self.matrix, &right)
    }

    /// z from p = A z + p(z = 0).
    fn velocity(&self, momentum: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let still: Map<u32, Expr<'g>> = self.scene.speeds.iter().map(|z| (z.key(), self.scene.graph.zero())).collect();
        let right: Vec<Expr<'g>> = momentum
            .iter()
            .zip(&self.scene.momenta)
            .map(|(value, symbol)| *symbol - tidy(value.substitute(&still)))
            .collect();
        solve_symmetric(&self.matrix, &right)
    }

    /// `Σ Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α`, and m v·ȧ_α for particles.
    pub fn bracket(&self) -> Vec<Expr<'g>> {
        let mut bracket = self.zeros();
        for body in &self.bodies {
            let frame = &body.frame;
            let omega = frame.body_vector(body.angular_velocity);
            let (q, gamma) = body.momentum(&body.velocity, &body.angular_velocity);
            let moved = frame.resolve(&frame.cross(&body.impulse_beside_velocity(&q), &body.velocity), Axes::Body);
            let gamma_turned = add(&cross(&gamma, &body.angular_velocity), &moved);
            for k in self.degrees() {
                let a = frame.derivative(&body.linear_rows[k], &self.rates, &omega);
                let o = body.angular_rows[k].map(|e| e.derivative(&self.rates));
                let turned = dot(&gamma_turned, &body.angular_rows[k]);
                bracket[k] = bracket[k] + frame.dot(&q, &a) + dot(&gamma, &o) + turned;
            }
        }
        for (particle, (velocity, rows)) in self.scene.particles.iter().zip(&self.particles) {
            for k in self.degrees() {
                let rate = rows[k].map(|e| e.derivative(&self.rates));
                bracket[k] = bracket[k] + particle.mass * dot(velocity, &rate);
            }
        }
        bracket
    }

    /// ṗ as a function of (t, q, p).
    fn momentum_rate(&self, velocity: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let of_momenta: Map<u32, Expr<'g>> =
            self.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
        let rows = self.bracket().into_iter().zip(self.generalised_forces());
        rows.map(|(bracket, force)| tidy(bracket).substitute(&of_momenta) + force).collect()
    }

    /// T = ½ Σ (Q·v_O + Γ_O·ω) + ½ Σ m v².
    fn kinetic_energy(&self) -> Expr<'g> {
        let mut twice = self.scene.graph.zero();
        for body in &self.bodies {
            let (q, gamma) = body.momentum(&body.velocity, &body.angular_velocity);
            twice = twice + body.frame.dot(&q, &body.velocity) + dot(&gamma, &body.angular_velocity);
        }
        for (particle, (velocity, _)) in self.scene.particles.iter().zip(&self.particles) {
            twice = twice + particle.mass * dot(velocity, velocity);
        }
        twice.half()
    }

    fn potential_energy(&self) -> Expr<'g> {
        let mut energy = self.scene.potential.unwrap_or_else(|| self.scene.graph.zero());
        for body in &self.bodies {
            if let Some(weight) = &body.weight {
                energy = energy + weight.potential(&body.frame, &body.position);
            }
        }
        if let Some(gravity) = &self.scene.gravity {
            for particle in &self.scene.particles {
                energy = energy - particle.mass * dot(gravity, &particle.position);
            }
        }
        energy
    }

    /// C up to a constant in ż: its gradient is affine in ż, so `C = ½ ż·(∂C/∂ż(ż) + ∂C/∂ż(0))`.
    fn constraint_function(&self, residual: &[Expr<'g>]) -> Expr<'g> {
        let at_rest = self.at_rest();
        let terms = residual.iter().zip(&self.scene.speed_rates);
        terms.map(|(r, &rate)| rate * (*r + r.substitute(&at_rest))).sum::<Expr<'g>>().half()
    }
}

impl<'g> MovingBody<'g> {
    fn new(scene: &SystemScene<'g>, link: &Link<'g>, parent: Option<&Self>, rates: &Map<u32, Expr<'g>>) -> Self {
        let graph = scene.graph;
        let zero = [graph.zero(); 3];
        let grouped = |a: Triple<'g>| a.map(Expr::group);
        let (mut omega, mut rotation) = match parent {
            Some(parent) => (parent.angular_velocity, Some(parent.frame.rotation)),
            None => (zero, None),
        };
        let mut relative: Option<[Triple<'g>; 3]> = None;
        for turn in &link.turns {
            let matrix = about_axis(graph, turn.axis, turn.angle);
            // ω in the turned axes, and what the turn itself adds about its axis.
            omega = grouped(Frame { graph, rotation: matrix }.to_body(&omega));
            omega[turn.axis] = omega[turn.axis] + turn.angle.derivative(rates);
            let after = |before: Option<[Triple<'g>; 3]>| before.map_or(matrix, |r| product(&r, &matrix).map(grouped));
            rotation = Some(after(rotation));
            relative = Some(after(relative));
        }
        let identity =
            || std::array::from_fn(|i| std::array::from_fn(|j| if i == j { graph.one() } else { graph.zero() }));
        let frame = Frame { graph, rotation: rotation.unwrap_or_else(identity) };
        let rate = link.position.map(|e| e.derivative(rates));
        let (position, velocity) = match parent {
            None => (link.position, frame.space_vector(rate)),
            Some(parent) => {
                let position = add(&parent.position, &grouped(parent.frame.to_space(&link.position)));
                let u = parent.frame.resolve(&parent.velocity, Axes::Body);
                let carried = add(&u, &add(&cross(&parent.angular_velocity, &link.position), &rate));
                let own = Frame { graph, rotation: relative.unwrap_or_else(identity) };
                (position, frame.body_vector(grouped(own.to_body(&grouped(carried)))))
            }
        };
        let speeds = &scene.speeds;
        let (linear_rows, angular_rows) = speeds
            .iter()
            .map(|&z| (velocity.partial(z).map(|e| tidy(e).group()), omega.map(|e| tidy(e.partial(z)).group())))
            .unzip();
        let matrix = KineticMatrix::new(graph, &link.body, &[0, 1, 2], &[0, 1, 2]);
        let weight = Weight::new(&link.body);
        Self { frame, position, velocity, angular_velocity: omega, linear_rows, angular_rows, matrix, weight }
    }

    /// `linear·a_α + angular·o_α`.
    fn project(&self, k: usize, linear: &Vector<'g>, angular: &Triple<'g>) -> Expr<'g> {
        self.frame.dot(linear, &self.linear_rows[k]) + dot(angular, &self.angular_rows[k])
    }

    /// (Q, Γ_O) of a velocity and an angular velocity.
    fn momentum(&self, velocity: &Vector<'g>, omega: &Triple<'g>) -> (Vector<'g>, Triple<'g>) {
        let q = self.matrix.linear_momentum(&self.frame, velocity, omega).map(Expr::group);
        // What vanishes with O ≠ G or added mass need not be turned.
        let coupled = (0..3).any(|i| (3..6).any(|j| !self.matrix.entries[i][j].is_zero()));
        let u = if coupled { self.frame.resolve(velocity, Axes::Body) } else { [self.frame.graph.zero(); 3] };
        (q, self.matrix.angular_momentum(&u, omega).map(Expr::group))
    }

    /// Q up to a multiple of v_O, which drops out of v_O × Q.
    fn impulse_beside_velocity(&self, q: &Vector<'g>) -> Vector<'g> {
        match self.matrix.isotropic {
            Some(_) => self.frame.body_vector(self.matrix.block(0, 3, &self.angular_velocity)),
            None => *q,
        }
    }

    /// `dQ/dt` and `dΓ_O/dt + v_O × Q`: from a_O and ω̇ for the body, so that nothing cancels, and from the impulse of the
    /// fluid.
    fn inertia_forces(&self, body: &Body<'g>, along: &Map<u32, Expr<'g>>) -> (Vector<'g>, Triple<'g>) {
        let frame = &self.frame;
        let w = self.angular_velocity;
        let omega = frame.body_vector(w);
        let acceleration = frame.derivative(&self.velocity, along, &omega).map(Expr::group);
        let alpha = w.map(|e| e.derivative(along).group());
        let first = body.first_moment();
        let mut force = acceleration.times(body.mass);
        let inertia = |a: &Triple<'g>| -> Triple<'g> { std::array::from_fn(|i| dot(&body.inertia[i], a)) };
        let mut torque = add(&inertia(&alpha), &cross(&w, &inertia(&w).map(Expr::group)));
        if !is_zero(&first) {
            let turning = add(&cross(&alpha, &first), &cross(&w, &cross(&w, &first).map(Expr::group)));
            force = force.plus(&frame.body_vector(turning));
            torque = add(&torque, &cross(&first, &frame.resolve(&acceleration, Axes::Body)));
        }
        if let Some(added) = &body.added_mass {
            let u = frame.resolve(&self.velocity, Axes::Body);
            let impulse = |row| add(&apply_block(added, row, 0, &u), &apply_block(added, row, 3, &w)).map(Expr::group);
            let (q, gamma) = (impulse(0), impulse(3));
            let rate = |a: &Triple<'g>| add(&a.map(|e| e.derivative(along)), &cross(&w, a));
            force = force.plus(&frame.body_vector(rate(&q)));
            torque = add(&torque, &add(&rate(&gamma), &cross(&u, &q)));
        }
        (force.map(Expr::group), torque.map(Expr::group))
    }

    /// ω as a vector, for what works on motions.
    pub fn angular_velocity_vector(&self) -> Vector<'g> {
        self.frame.body_vector(self.angular_velocity)
    }

    pub fn motion<'a>(&'a self, omega: &'a Vector<'g>) -> Motion<'a, 'g> {
        Motion { frame: &self.frame, velocity: &self.velocity, angular_velocity: omega }
    }
}
