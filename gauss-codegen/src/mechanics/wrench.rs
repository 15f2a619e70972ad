//! What acts on one body in a chart: wrenches about O, formed once for all charts in terms of the pose and the velocities as
//! symbols, which each chart then replaces by what they are in it.

use crate::algebra::{Expr, Graph, Map};

use super::accounts::{Account, GRAVITY, account_formulas};
use super::chart::Kinematics;
use super::forces::{Action, Element, Force};
use super::formula::Formula;
use super::names::Name;
use super::rotation::poisson;
use super::vector::{Axes, Frame, Triple, Vector, add, cross, dot};

/// Symbols for the motion of a body: its pose, and its velocities in both frames, so that what is written in the one or in the
/// other is never turned there and back.
pub struct Observed<'g> {
    pub graph: &'g Graph,
    pub time: Expr<'g>,
    pub rotation: [Triple<'g>; 3],
    /// b = O − Ω, observer's components.
    pub position: Triple<'g>,
    /// ḃ, observer's components, and u = Rᵀḃ.
    pub velocity: Triple<'g>,
    pub body_velocity: Triple<'g>,
    /// ω̂ = R ω and ω.
    pub angular_velocity: Triple<'g>,
    pub body_angular_velocity: Triple<'g>,
    /// Rates of t, R and b.
    pub rates: Map<u32, Expr<'g>>,
}

/// A resultant and a torque about O.
#[derive(Clone, Copy)]
pub struct Wrench<'g> {
    pub force: Vector<'g>,
    pub torque: Vector<'g>,
}

/// One element on the body of a chart.
struct Load<'g> {
    name: String,
    potential: Option<Expr<'g>>,
    wrench: Wrench<'g>,
}

/// Everything that acts on the body of a chart beside weight and buoyancy.
pub struct Acting<'g> {
    pub time: Expr<'g>,
    /// Values that arrive at run time.
    pub inputs: Vec<Expr<'g>>,
    loads: Vec<Load<'g>>,
}

impl<'g> Observed<'g> {
    /// With the given symbols of the pose.
    pub fn new(graph: &'g Graph, time: Expr<'g>, rotation: [Triple<'g>; 3], position: Triple<'g>) -> Self {
        let symbols = |name: Name| -> Triple<'g> {
            std::array::from_fn(|i| graph.symbol(name.index(i).text, name.index(i).latex, false))
        };
        let (velocity, spin) = (symbols(Name::new("b", "b").dot()), symbols(Name::new("ω", "\\omega")));
        let mut rates = Map::from_iter([(time.key(), graph.one())]);
        rates.extend(poisson(&rotation, &spin));
        rates.extend(position.iter().zip(velocity).map(|(b, rate)| (b.key(), rate)));
        Self {
            graph,
            time,
            rotation,
            position,
            velocity,
            body_velocity: symbols(Name::new("u", "u")),
            angular_velocity: symbols(Name::new("ω", "\\omega").hat()),
            body_angular_velocity: spin,
            rates,
        }
    }

    /// What the symbols are in a chart.
    fn in_chart(&self, kinematics: &Kinematics<'g>) -> Map<u32, Expr<'g>> {
        let frame = &kinematics.frame;
        let entries = |matrix: &[Triple<'g>; 3]| matrix.iter().flatten().copied().collect::<Vec<_>>();
        let (v, omega) = (&kinematics.velocity, &kinematics.angular_velocity);
        let pairs = [
            (entries(&self.rotation), entries(&frame.rotation)),
            (self.position.to_vec(), kinematics.position.to_vec()),
            (self.velocity.to_vec(), frame.resolve(v, Axes::Space).to_vec()),
            (self.body_velocity.to_vec(), frame.resolve(v, Axes::Body).to_vec()),
            (self.angular_velocity.to_vec(), frame.resolve(omega, Axes::Space).to_vec()),
            (self.body_angular_velocity.to_vec(), frame.resolve(omega, Axes::Body).to_vec()),
        ];
        let pairs = pairs.into_iter().flat_map(|(symbols, values)| symbols.into_iter().zip(values));
        pairs.map(|(symbol, value)| (symbol.key(), value.group())).collect()
    }

    /// The wrench dual to the velocities in a power, which is linear in them, or in a dissipation function: its derivatives
    /// by them.
    fn dual(&self, power: Expr<'g>) -> Wrench<'g> {
        let by = |symbols: &Triple<'g>| symbols.map(|v| power.partial(v));
        Wrench {
            force: Vector { body: by(&self.body_velocity), space: by(&self.velocity) },
            torque: Vector { body: by(&self.body_angular_velocity), space: by(&self.angular_velocity) },
        }
    }

    fn wrench_of(&self, force: &Force<'g>) -> Wrench<'g> {
        let zero = [self.graph.zero(); 3];
        match force {
            Force::OnLink { at, force, torque, axes: Axes::Body, .. } => Wrench {
                force: Vector { body: *force, space: zero },
                torque: Vector { body: add(torque, &cross(at, &force.map(Expr::group))), space: zero },
            },
            Force::OnLink { at, force, torque, axes: Axes::Space, .. } => {
                let frame = Frame { graph: self.graph, rotation: self.rotation };
                let turned = if at.iter().all(|e| e.is_zero()) { zero } else { frame.to_body(&force.map(Expr::group)) };
                Wrench {
                    force: Vector { body: zero, space: *force },
                    torque: Vector { body: cross(at, &turned.map(Expr::group)), space: *torque },
                }
            }
            // Linear in the velocities with the force as its coefficients.
            Force::AtPoint { at, force } => {
                let partials = at.map(|e| self.dual(e.derivative(&self.rates)));
                let weighted = partials.iter().zip(force).map(|(w, f)| w.map(|e| e * f.group()));
                weighted.fold(Wrench::zero(self.graph), |sum, w| sum.plus(&w))
            }
            Force::OnRate { rate, force } => self.dual(*rate).map(|e| e * force.group()),
            Force::Dissipation(function) => self.dual(*function).map(|e| -e),
        }
    }
}

impl<'g> Wrench<'g> {
    pub fn zero(graph: &'g Graph) -> Self {
        let zero = [graph.zero(); 3];
        let none = Vector { body: zero, space: zero };
        Self { force: none, torque: none }
    }

    fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self { force: self.force.map(&f), torque: self.torque.map(&f) }
    }

    fn plus(&self, other: &Self) -> Self {
        Self { force: self.force.plus(&other.force), torque: self.torque.plus(&other.torque) }
    }
}

impl<'g> Acting<'g> {
    /// The elements, given in terms of the observed symbols and of `parameters`, whose symbols in the chart's body follow.
    pub fn new(
        observed: &Observed<'g>,
        kinematics: &Kinematics<'g>,
        parameters: &Map<u32, Expr<'g>>,
        elements: &[Element<'g>],
        inputs: Vec<Expr<'g>>,
    ) -> Self {
        let mut replacement = observed.in_chart(kinematics);
        replacement.extend(parameters.iter().map(|(key, e)| (*key, *e)));
        let in_chart = |e: Expr<'g>| e.substitute(&replacement);
        let loads = elements.iter().map(|element| {
            let (potential, wrench) = match &element.action {
                Action::Potential(potential) => {
                    (Some(*potential), observed.dual(potential.derivative(&observed.rates)).map(|e| -e))
                }
                Action::Forces(forces) => {
                    let wrenches = forces.iter().map(|force| observed.wrench_of(force));
                    (None, wrenches.fold(Wrench::zero(observed.graph), |sum, w| sum.plus(&w)))
                }
            };
            let potential = potential.map(in_chart);
            Load { name: element.name.clone(), potential, wrench: wrench.map(in_chart) }
        });
        Self { time: observed.time, inputs, loads: loads.collect() }
    }

    /// Of all elements together.
    pub fn total(&self, graph: &'g Graph) -> Wrench<'g> {
        self.loads.iter().fold(Wrench::zero(graph), |sum, load| sum.plus(&load.wrench))
    }

    /// The sum of all potentials.
    pub fn potential(&self) -> Option<Expr<'g>> {
        self.loads.iter().filter_map(|load| load.potential).reduce(|sum, potential| sum + potential)
    }

    /// `∫∂v_P/∂z^α·dF` once more, for the check of a scene: forces on the velocity of O and on the axes e as they are
    /// differentiated from the pose, potentials by their power.
    pub fn by_definition(&self, kinematics: &Kinematics<'g>) -> Vec<Expr<'g>> {
        let (frame, rates) = (&kinematics.frame, &kinematics.rates);
        let zero = frame.graph.zero();
        let velocity = kinematics.position.map(|e| e.derivative(rates));
        let axes: [Triple<'g>; 3] = std::array::from_fn(|j| std::array::from_fn(|i| frame.rotation[i][j]));
        let axis_rates = axes.map(|axis| axis.map(|e| e.derivative(rates)));
        let row = |z: Expr<'g>| {
            let a = velocity.map(|e| e.partial(z));
            // o_α = ½ Σ e_j × ∂ė_j/∂z^α.
            let turns = (0..3).map(|j| cross(&axes[j], &axis_rates[j].map(|e| e.partial(z))));
            let o = turns.fold([zero; 3], |sum, turn| add(&sum, &turn)).map(Expr::half);
            let terms = self.loads.iter().map(|load| match load.potential {
                Some(potential) => -potential.derivative(rates).partial(z),
                None => {
                    let force = frame.resolve(&load.wrench.force, Axes::Space);
                    dot(&force, &a) + dot(&frame.resolve(&load.wrench.torque, Axes::Space), &o)
                }
            });
            terms.fold(zero, |sum, e| sum + e)
        };
        kinematics.speeds.iter().map(|&z| row(z)).collect()
    }

    /// Accounts of all elements; `weight` is that of weight and buoyancy, `project` pairs a wrench with the partial velocities.
    pub fn accounts(
        &self,
        kinematics: &Kinematics<'g>,
        weight: Option<Wrench<'g>>,
        project: impl Fn(&Wrench<'g>) -> Vec<Expr<'g>>,
    ) -> Vec<Account<'g>> {
        let account = |name: &str, conservative: bool, wrench: &Wrench<'g>| Account {
            name: name.to_owned(),
            conservative,
            forces: project(wrench),
            power: kinematics.frame.dot(&wrench.force.map(Expr::group), &kinematics.velocity)
                + kinematics.frame.dot(&wrench.torque.map(Expr::group), &kinematics.angular_velocity),
        };
        let mut accounts: Vec<Account<'g>> = weight.iter().map(|wrench| account(GRAVITY, true, wrench)).collect();
        let loads = self.loads.iter().map(|load| account(&load.name, load.potential.is_some(), &load.wrench));
        accounts.extend(loads);
        accounts.sort_by_key(|account| !account.conservative);
        accounts
    }

    /// What the kernel says of its elements.
    pub fn formulas(&self, accounts: &[Account<'g>], graph: &'g Graph) -> Vec<Formula<'g>> {
        let explicit = self.potential().map_or(graph.zero(), |potential| potential.partial(self.time));
        account_formulas(accounts, explicit)
    }
}
