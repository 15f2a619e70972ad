//! Loads on one body in a chart: wrenches about O, formed once for all charts in terms of the pose and the velocities
//! as symbols, which each chart then replaces by what they are in it.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::rotation::poisson;
use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, Vector};
use crate::mechanics::loads::forces::{Action, Element, Force};
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::name::Name;

/// Symbols for the motion of a body: its pose, and its velocities in both frames, so that what is written in the one or
/// in the other is never turned there and back.
#[derive(Clone)]
pub struct MotionSymbols<'g> {
    graph: &'g Graph,
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

impl<'g> MotionSymbols<'g> {
    pub fn new(graph: &'g Graph, time: Expr<'g>) -> Self {
        let entry = |i: usize, j: usize| graph.symbol(format!("E{}{}", i + 1, j + 1), "E", false);
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let position = std::array::from_fn(|i| graph.symbol(format!("B{}", i + 1), "B", false));
        let symbols = |name: Name| -> Triple<'g> {
            std::array::from_fn(|i| graph.symbol(name.index(i).text, name.index(i).latex, false))
        };
        let (velocity, spin) = (symbols(Name::new("b", "b").dot()), symbols(Name::new("ω", "\\omega")));
        let mut rates = Map::from_iter([(time.key(), graph.one())]);
        rates.extend(poisson(&rotation, &spin));
        rates.extend(position.iter().zip(velocity).map(|(b, rate)| (b.key(), rate)));
        Self {
            graph,
            rotation,
            position,
            velocity,
            body_velocity: symbols(Name::new("u", "u")),
            angular_velocity: symbols(Name::new("ω", "\\omega").hat()),
            body_angular_velocity: spin,
            rates,
        }
    }

    /// The elements, given in terms of these symbols, as they are in a motion: elements on the only link.
    pub fn in_motion(&self, kinematics: &Kinematics<'g>, element: &Element<'g>) -> Element<'g> {
        let replacement = self.values(kinematics);
        let real = |e: Expr<'g>| e.substitute(&replacement);
        let (action, wrench) = match &element.action {
            Action::Potential(potential) => {
                let wrench = self.dual(potential.derivative(&self.rates)).map(|e| -e);
                (Action::Potential(real(*potential)), wrench)
            }
            Action::Field(field) => {
                let wrench = self.dual(field.potential.derivative(&self.rates)).map(|e| -e);
                (Action::Field(field.map(real)), wrench)
            }
            Action::Forces(forces) => {
                let wrenches = forces.iter().map(|force| self.wrench_of(force));
                let wrench = wrenches.fold(Wrench::zero(self.graph), |sum, w| sum.plus(&w));
                (Action::Forces(forces.iter().map(|force| force.map(real)).collect()), wrench)
            }
        };
        Element { name: element.name.clone(), action, on_link: Some((0, wrench.map(real))) }
    }

    /// Values of the symbols in a chart.
    fn values(&self, kinematics: &Kinematics<'g>) -> Map<u32, Expr<'g>> {
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

    /// The wrench dual to the velocities in a power, which is linear in them, or in a dissipation function: its
    /// derivatives by them.
    fn dual(&self, power: Expr<'g>) -> Wrench<'g> {
        let by = |symbols: &Triple<'g>| symbols.map(|v| power.partial(v));
        Wrench {
            force: Vector { body: by(&self.body_velocity), space: by(&self.velocity) },
            torque: Vector { body: by(&self.body_angular_velocity), space: by(&self.angular_velocity) },
        }
    }

    fn wrench_of(&self, force: &Force<'g>) -> Wrench<'g> {
        match force {
            Force::OnLink { .. } => {
                let frame = Frame { graph: self.graph, rotation: self.rotation };
                force.wrench(&frame).unwrap_or_else(|| Wrench::zero(self.graph))
            }
            // Linear in the velocities with the force as its coefficients.
            Force::AtPoint { at, force } => {
                let partials = at.map(|e| self.dual(e.derivative(&self.rates)));
                let weighted = partials.iter().zip(force).map(|(w, f)| w.map(|e| e * f.group()));
                weighted.fold(Wrench::zero(self.graph), |sum, w| sum.plus(&w))
            }
            // One link has none between it and another.
            Force::Between { .. } => Wrench::zero(self.graph),
            Force::OnRate { rate, force } => self.dual(*rate).map(|e| e * force.group()),
            Force::Dissipation(function) => self.dual(*function).map(|e| -e),
        }
    }
}
