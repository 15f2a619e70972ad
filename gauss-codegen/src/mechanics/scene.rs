//! A system as it is given: coordinates, speeds, ψ, links, constraints, contacts and loads, in symbols.

pub mod constraint;
pub mod contact;

use std::ops::Range;

use crate::algebra::{Expr, Graph, Map, Substitution};
use crate::derivatives::Direction;
use crate::terms::{BodyChart, Motion};

use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::vector::is_zero;
use crate::mechanics::links::link::{Matter, Placement};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::Element;
use crate::mechanics::matter::body::Body;
use crate::mechanics::name::Name;
use crate::mechanics::scene::constraint::Constraint;
use crate::mechanics::scene::contact::Contact;
use crate::mechanics::tidy::tidy;

/// Degrees of freedom up to which everything is also tried multiplied out: of links that hang on one another, and of
/// links that do not, where a free body must be among them.
const SMALL: [usize; 2] = [3, 6];

/// A body whose pose is given in a chart of its own.
#[derive(Clone, Copy)]
pub struct ChartedLink {
    pub link: usize,
    pub own: BodyChart,
    /// Nothing else has matter or coordinates and nothing constrains it: the configuration is its pose.
    pub alone: bool,
}

/// A system as it is given: every expression in terms of t, q, z and parameters.
pub struct SystemScene<'g> {
    pub graph: &'g Graph,
    pub time: Expr<'g>,
    /// The instant at which mass data are taken, where they vary: the time, which no velocity is differentiated by.
    /// Forces of inertia are those of the matter that is there, and it keeps its mass.
    pub matter_time: Option<Expr<'g>>,
    pub coordinates: Vec<Coordinate<'g>>,
    pub coordinate_names: Vec<Name>,
    /// Which of the coordinates are states of elements: forces may depend on them, nothing else of the motion does.
    /// Their rates are any function of t, q, z and inputs.
    pub states: Range<usize>,
    pub speeds: Vec<Expr<'g>>,
    pub charted: Option<ChartedLink>,
    /// Names of the momenta and of the forces.
    pub momentum_names: Vec<Name>,
    pub force_names: Vec<Name>,
    pub speed_rates: Vec<Expr<'g>>,
    pub momenta: Vec<Expr<'g>>,
    /// ψ: rates of scalar coordinates, twists of the others, in the order of the coordinates; affine in z, but for
    /// those of states.
    pub kinematics: Vec<Expr<'g>>,
    /// Rates of t and of the symbols of q.
    pub rates: Map<u32, Expr<'g>>,
    pub tree: Tree<'g>,
    pub constraints: Vec<Constraint<'g>>,
    /// Constraints may depend on one another.
    pub redundant: bool,
    /// Contacts of the scene.
    pub contacts: Vec<Contact<'g>>,
    /// Values that arrive at run time.
    pub inputs: Vec<Expr<'g>>,
    /// Loads other than weight and buoyancy.
    pub elements: Vec<Element<'g>>,
}

impl<'g> SystemScene<'g> {
    /// The scene of other bodies, each in place of one. Loads stay as they are.
    pub fn of_bodies(&self, other: impl Fn(&Body<'g>) -> Body<'g>) -> Self {
        let matter = |matter: &Matter<'g>| match matter {
            Matter::Body(body) => Matter::Body(Box::new(other(body))),
            _ => matter.clone(),
        };
        let placed = |p: &Placement<'g>| Placement { matter: matter(&p.matter), ..p.clone() };
        let mut tree = self.tree.changed(self.speeds.clone(), self.rates.clone(), placed);
        tree.settle();
        let kept: Vec<usize> = (0..self.speeds.len()).collect();
        let scene = self.assembled(&kept, self.kinematics.clone(), self.rates.clone(), tree, self.elements.clone());
        Self { contacts: self.contacts.clone(), ..scene }
    }

    /// The scene in which constraints are solved: of its speeds those of `kept` stay, in terms of which the replacement
    /// has the others.
    pub fn reduced(&self, replacement: &Substitution<'g>, kept: &[usize]) -> Self {
        let value = |e: Expr<'g>| replacement.of(e);
        let kinematics = self.kinematics.iter().copied().map(value).collect();
        let rates: Map<u32, Expr<'g>> = self.rates.iter().map(|(&key, &rate)| (key, value(rate))).collect();
        let speeds = kept.iter().map(|&k| self.speeds[k]).collect();
        let mut tree = self.tree.changed(speeds, rates.clone(), |placement| placement.map_velocities(value));
        tree.rotors.iter_mut().for_each(|rotor| rotor.rate = value(rotor.rate));
        tree.deformations.iter_mut().for_each(|deformation| deformation.map_rates(value));
        let elements = self.elements.iter().map(|element| element.map(value)).collect();
        tree.settle();
        let contacts = self.contacts.iter().map(|contact| contact.in_speeds(replacement)).collect();
        Self { contacts, ..self.assembled(kept, kinematics, rates, tree, elements) }
    }

    /// The speeds of `kept`, without constraints and contacts.
    fn assembled(
        &self,
        kept: &[usize],
        kinematics: Vec<Expr<'g>>,
        rates: Map<u32, Expr<'g>>,
        tree: Tree<'g>,
        elements: Vec<Element<'g>>,
    ) -> Self {
        let pick = |all: &[Expr<'g>]| kept.iter().map(|&k| all[k]).collect();
        let names = |all: &[Name]| kept.iter().map(|&k| all[k].clone()).collect();
        Self {
            graph: self.graph,
            time: self.time,
            matter_time: self.matter_time,
            coordinates: self.coordinates.clone(),
            coordinate_names: self.coordinate_names.clone(),
            states: self.states.clone(),
            charted: self.charted,
            momentum_names: names(&self.momentum_names),
            force_names: names(&self.force_names),
            speed_rates: pick(&self.speed_rates),
            momenta: pick(&self.momenta),
            speeds: pick(&self.speeds),
            kinematics,
            rates,
            tree,
            constraints: Vec::new(),
            redundant: false,
            contacts: Vec::new(),
            inputs: self.inputs.clone(),
            elements,
        }
    }

    /// Time as a direction: the instant at which mass data are taken goes with it.
    pub fn along_time(&self) -> Direction<'g> {
        let one = self.graph.one();
        [self.time].into_iter().chain(self.matter_time).map(|time| (time, one)).collect()
    }

    /// The chart that the configuration is, where it is the pose of the only body.
    pub fn chart(&self) -> Option<BodyChart> {
        self.charted.filter(|charted| charted.alone).map(|charted| charted.own)
    }

    fn motion_of(&self, link: usize) -> Option<Motion> {
        self.charted.filter(|charted| charted.link == link).map(|charted| charted.own.motion)
    }

    /// Components of the twist (u, ω) that a link can have, body axes.
    pub fn twist_of(&self, link: usize) -> Vec<usize> {
        match self.motion_of(link) {
            Some(Motion::Planar) => vec![0, 1, 5],
            Some(Motion::FixedPoint) => vec![3, 4, 5],
            Some(Motion::Free) | None => match self.tree.links[link].turns_about()[..] {
                [axis] => vec![(axis + 1) % 3, (axis + 2) % 3, 3 + axis],
                _ => (0..6).collect(),
            },
        }
    }

    /// Whether O of a link stays at Ω: its mass enters by m c and I_O alone.
    pub fn is_held(&self, link: usize) -> bool {
        match self.motion_of(link) {
            Some(motion) => motion == Motion::FixedPoint,
            None => self.tree.links[link].parent.is_none() && is_zero(&self.tree.links[link].position),
        }
    }

    /// Whether multiplying out would be slow and of no use.
    pub fn is_long(&self) -> bool {
        let [chained, apart] = SMALL;
        self.speeds.len() > if self.tree.is_chained() { chained } else { apart }
    }

    /// Rates whose ψ is not affine in z: velocities would then not be linear in z, and (3.4) not this one. Indices into
    /// the kinematics.
    pub fn rates_not_affine(&self) -> Vec<usize> {
        let affine = |rate: &Expr<'g>| {
            self.speeds.iter().all(|&z| {
                let partial = rate.partial(z);
                partial.as_number().is_some() || self.speeds.iter().all(|&w| tidy(partial.partial(w)).is_zero())
            })
        };
        let states = self.components_of_states();
        (0..self.kinematics.len()).filter(|k| !states.contains(k) && !affine(&self.kinematics[*k])).collect()
    }

    /// Which components of ψ are the rates of states.
    pub fn components_of_states(&self) -> Range<usize> {
        let first: usize = self.coordinates[..self.states.start].iter().map(Coordinate::size).sum();
        first..first + self.states.len()
    }

    /// ψ with states that stand still: what the speeds move, affine in them.
    pub fn motion(&self) -> Vec<Expr<'g>> {
        let states = self.components_of_states();
        let still = |(k, rate): (usize, &Expr<'g>)| if states.contains(&k) { self.graph.zero() } else { *rate };
        self.kinematics.iter().enumerate().map(still).collect()
    }
}
