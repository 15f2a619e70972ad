//! Loads other than weight and buoyancy: potentials, and forces, each of which enters through `∫∂v_P/∂z·dF` of (3.4),
//! at the point where it acts; nothing else is ever said about it.

use crate::algebra::Expr;

use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, Vector, add, cross};
use crate::mechanics::loads::wrench::Wrench;

/// One element of the loads, under the name by which its power and its generalised force are known.
#[derive(Clone)]
pub struct Element<'g> {
    pub name: String,
    pub action: Action<'g>,
    /// The link that all of it acts on, and its wrench there, where that is known in the axes where each part arises.
    pub on_link: Option<(usize, Wrench<'g>)>,
}

impl<'g> Element<'g> {
    pub fn new(name: String, action: Action<'g>) -> Self {
        Self { name, action, on_link: None }
    }

    /// The element with other expressions in place of those that it is made of.
    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        let action = match &self.action {
            Action::Potential(potential) => Action::Potential(f(*potential)),
            Action::Field(field) => Action::Field(field.map(&f)),
            Action::Forces(forces) => Action::Forces(forces.iter().map(|force| force.map(&f)).collect()),
        };
        let on_link = self.on_link.map(|(link, wrench)| (link, wrench.map(&f)));
        Self { name: self.name.clone(), action, on_link }
    }
}

/// Ways in which an element acts.
#[derive(Clone)]
pub enum Action<'g> {
    /// A potential, a function of t and q: part of the energy.
    Potential(Expr<'g>),
    /// A potential of which the forces are known, in part, link by link.
    Field(ForceField<'g>),
    /// Forces that act together.
    Forces(Vec<Force<'g>>),
}

/// A field with its potential.
#[derive(Clone)]
pub struct ForceField<'g> {
    /// All of it.
    pub potential: Expr<'g>,
    /// Part that acts by its derivatives.
    pub rest: Expr<'g>,
    /// Loads of the remainder.
    pub loads: Loads<'g>,
}

impl<'g> ForceField<'g> {
    /// The field with other expressions in place of those that it is made of.
    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        let uniform = self.loads.uniform.iter().map(|&(root, field)| (root, field.map(&f)));
        let forces = self.loads.forces.iter().map(|force| force.map(&f));
        let loads = Loads { forces: forces.collect(), uniform: uniform.collect() };
        Self { potential: f(self.potential), rest: f(self.rest), loads }
    }
}

/// Loads on links.
#[derive(Clone, Default)]
pub struct Loads<'g> {
    pub forces: Vec<Force<'g>>,
    /// Accelerations that all matter on a root has from a field, observer's axes.
    pub uniform: Vec<(usize, Triple<'g>)>,
}

impl<'g> Loads<'g> {
    /// Loads of all elements together.
    pub fn of(elements: &[Element<'g>]) -> Self {
        let mut all = Self::default();
        for element in elements {
            match &element.action {
                Action::Potential(_) => {}
                Action::Field(field) => {
                    all.forces.extend(&field.loads.forces);
                    all.uniform.extend(&field.loads.uniform);
                }
                Action::Forces(forces) => all.forces.extend(forces),
            }
        }
        all
    }

    pub fn of_forces(forces: &[Force<'g>]) -> Self {
        Self { forces: forces.to_vec(), uniform: Vec::new() }
    }

    /// The acceleration that the matter on a root has.
    pub fn field_on(&self, root: usize) -> Option<Triple<'g>> {
        let own = self.uniform.iter().filter(|(other, _)| *other == root).map(|(_, field)| *field);
        own.reduce(|sum, field| add(&sum, &field))
    }
}

/// The sum of all potentials.
pub fn potential_of<'g>(elements: &[Element<'g>]) -> Option<Expr<'g>> {
    let potentials = elements.iter().filter_map(|element| match element.action {
        Action::Potential(potential) => Some(potential),
        Action::Field(ref field) => Some(field.potential),
        Action::Forces(_) => None,
    });
    potentials.reduce(|sum, potential| sum + potential)
}

/// Potential that acts by its derivatives.
pub fn potential_of_forces<'g>(elements: &[Element<'g>]) -> Option<Expr<'g>> {
    let potentials = elements.iter().filter_map(|element| match element.action {
        Action::Potential(potential) => Some(potential),
        Action::Field(ref field) => Some(field.rest),
        Action::Forces(_) => None,
    });
    potentials.reduce(|sum, potential| sum + potential)
}

/// All forces, of whichever element.
pub fn forces_of<'g>(elements: &[Element<'g>]) -> Vec<Force<'g>> {
    let forces = elements.iter().filter_map(|element| match &element.action {
        Action::Potential(_) | Action::Field(_) => None,
        Action::Forces(forces) => Some(forces),
    });
    forces.flatten().copied().collect()
}

/// One force, by how it acts.
#[derive(Clone, Copy)]
pub enum Force<'g> {
    /// A force at a point that moves, both in observer's axes from Ω.
    AtPoint { at: Triple<'g>, force: Triple<'g> },
    /// A force at a point fixed in a link (body axes from O), and a torque; components in the given axes.
    OnLink { link: usize, at: Triple<'g>, force: Triple<'g>, torque: Triple<'g>, axes: Axes },
    /// A torque on the first of two links of one tree, in its body axes, and its reaction on the second.
    Between { links: [usize; 2], torque: Triple<'g> },
    /// A generalised force on a rate (of a coordinate): power = force · rate.
    OnRate { rate: Expr<'g>, force: Expr<'g> },
    /// Rayleigh's dissipation function R: −∂R/∂z.
    Dissipation(Expr<'g>),
}

impl<'g> Force<'g> {
    /// Wrench of a force on a link, each part in the axes in which it is given.
    pub fn wrench(&self, frame: &Frame<'g>) -> Option<Wrench<'g>> {
        let Force::OnLink { at, force, torque, axes, .. } = self else { return None };
        Some(match axes {
            Axes::Body => Wrench {
                force: frame.body_vector(*force),
                torque: frame.body_vector(add(torque, &cross(at, &force.map(Expr::group)))),
            },
            Axes::Space => {
                let arm = at.iter().any(|e| !e.is_zero());
                let turned = if arm { frame.to_body(&force.map(Expr::group)) } else { frame.zero().body };
                let moment = cross(at, &turned.map(Expr::group));
                Wrench { force: frame.space_vector(*force), torque: Vector { body: moment, space: *torque } }
            }
        })
    }

    /// The force with other expressions in place of those that it is made of.
    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        match *self {
            Force::AtPoint { at, force } => Force::AtPoint { at: at.map(&f), force: force.map(&f) },
            Force::OnLink { link, at, force, torque, axes } => {
                Force::OnLink { link, at: at.map(&f), force: force.map(&f), torque: torque.map(&f), axes }
            }
            Force::Between { links, torque } => Force::Between { links, torque: torque.map(&f) },
            Force::OnRate { rate, force } => Force::OnRate { rate: f(rate), force: f(force) },
            Force::Dissipation(function) => Force::Dissipation(f(function)),
        }
    }
}
