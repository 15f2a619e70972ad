//! The expressions of a scene, each with its place.

use super::places::Place;
use crate::model::language::statements::Statements;
use crate::model::language::words::same;
use crate::model::scene::clauses::{Coefficients, Extent, ForceClause, ForceKind, RoleClause, RoleValue};
use crate::model::scene::expression::Expression;
use crate::model::scene::roles::Role;
use proc_macro2::Ident;

/// Every expression, with its place; those of constraints come after the others.
pub fn all(statements: &Statements) -> Vec<(Place, &Expression)> {
    let mut all = Vec::new();
    let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
    for (name, rate) in statements.kinematics.iter().flat_map(|kinematics| &kinematics.rates) {
        let kind = coordinates().find(|coordinate| same(&coordinate.ident, name)).map(|coordinate| coordinate.kind);
        all.extend(rate.as_ref().map(|rate| (Place::Kinematics(kind), rate)));
    }
    for body in &statements.bodies {
        all.extend(body.position.as_ref().map(|position| (Place::Position, position)));
        all.extend(body.rotation.as_ref().map(|rotation| (Place::Rotation, rotation)));
    }
    let clauses = statements.all_role_clauses();
    all.extend(clauses.flat_map(RoleClause::expressions));
    for particle in &statements.particles {
        all.push((Place::Mass, &particle.mass));
        all.push((Place::Particle { parent: particle.parent.is_some() }, &particle.position));
    }
    all.extend(statements.points.iter().map(|point| (Place::At, &point.at)));
    if let Some((_, Some(potential))) = &statements.potential {
        all.push((Place::Potential, potential));
    }
    if let Some((_, Some(velocity))) = &statements.medium {
        all.push((Place::Medium, velocity));
    }
    for clause in &statements.attractions {
        all.push((Place::Constant { word: "gravitational parameter", noun: "central gravity" }, &clause.mu));
        all.extend(clause.center.as_ref().map(|center| (Place::Center, center)));
    }
    let armature = Place::Constant { word: "inertia", noun: "an armature" };
    all.extend(statements.armatures.iter().map(|(_, inertia)| (armature, inertia)));
    for clause in &statements.forces {
        let on = clause.kind.body();
        for (place, expression) in clause.expressions() {
            match place {
                // The name of a point of the same body stands for its place in the body.
                Place::ForceAt { .. } if on.is_some_and(|body| statements.own_point(body, expression).is_some()) => {}
                Place::ForceAt { .. } if statements.in_chart => all.push((Place::ForceAt { bound: true }, expression)),
                place => all.push((place, expression)),
            }
        }
    }
    all.extend(statements.constraints.iter().map(|clause| (Place::Constraint(clause.kind), &clause.expression)));
    all
}

impl Statements {
    /// Whether some expression names `word`.
    pub fn name(&self, word: &str) -> bool {
        let definitions = self.definitions.iter().filter_map(|definition| definition.expression.as_ref());
        let all = all(self);
        all.iter().map(|(_, expression)| *expression).chain(definitions).any(|expression| expression.names(word))
    }

    /// Calls `change` with every expression.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        let rates = self.kinematics.iter_mut().flat_map(|kinematics| &mut kinematics.rates);
        rates.filter_map(|(_, rate)| rate.as_mut()).for_each(&mut *change);
        for body in &mut self.bodies {
            body.position.iter_mut().chain(&mut body.rotation).for_each(&mut *change);
        }
        let of_bodies = self.bodies.iter_mut().flat_map(|body| &mut body.role_clauses);
        self.role_clauses.iter_mut().chain(of_bodies).for_each(|clause| clause.each_expression(change));
        for particle in &mut self.particles {
            change(&mut particle.mass);
            change(&mut particle.position);
        }
        self.points.iter_mut().for_each(|point| change(&mut point.at));
        self.constraints.iter_mut().for_each(|constraint| change(&mut constraint.expression));
        for (_, value) in self.potential.iter_mut().chain(&mut self.medium) {
            value.iter_mut().for_each(&mut *change);
        }
        for clause in &mut self.attractions {
            change(&mut clause.mu);
            clause.center.iter_mut().for_each(&mut *change);
        }
        self.armatures.iter_mut().for_each(|(_, inertia)| change(inertia));
        self.forces.iter_mut().for_each(|clause| clause.kind.each_expression(change));
    }

    /// Writes the places of points in the place of their names, where forces act in the axes of the body that has them.
    pub fn place_at_points(&mut self) {
        let mut forces = std::mem::take(&mut self.forces);
        for clause in &mut forces {
            let Some(body) = clause.kind.body().cloned() else { continue };
            if let ForceKind::OnBody { at: Some(at), .. } | ForceKind::Wrench { at: Some(at), .. } = &mut clause.kind
                && let Some(point) = self.own_point(&body, at)
            {
                *at = point.at.clone();
            }
        }
        self.forces = forces;
    }
}

impl RoleClause {
    /// Its expressions, with their places.
    pub fn expressions(&self) -> Vec<(Place, &Expression)> {
        match &self.value {
            RoleValue::Expression(value) => vec![(Place::Role(self.role), value)],
            RoleValue::Coefficients(value) => value.entries().map(|e| (entry(self.role), e)).collect(),
        }
    }

    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.value {
            RoleValue::Expression(value) => change(value),
            RoleValue::Coefficients(value) => value.each_expression(change),
        }
    }
}

/// Where an entry of an added mass, or of an inertia, stands.
pub fn entry(role: Role) -> Place {
    Place::Constant { word: "entry", noun: if role == Role::AddedMass { "an added mass" } else { "an inertia" } }
}

impl ForceClause {
    /// Its expressions, with their places.
    pub fn expressions(&self) -> Vec<(Place, &Expression)> {
        match &self.kind {
            ForceKind::AtPoint { at, value } => vec![(Place::ForcePoint, at), (Place::Force, value)],
            ForceKind::OnBody { at, value, .. } => {
                at.iter().map(|at| (Place::ForceAt { bound: false }, at)).chain([(Place::Force, value)]).collect()
            }
            ForceKind::Torque { value, .. } => vec![(Place::Torque, value)],
            ForceKind::Wrench { at, force, torque, .. } => {
                let at = at.iter().map(|at| (Place::ForceAt { bound: true }, at));
                let force = force.iter().map(|force| (Place::Force, force));
                at.chain(force).chain(torque.iter().map(|torque| (Place::Torque, torque))).collect()
            }
            ForceKind::Drive { rates } => rates.iter().map(|(_, value)| (Place::Drive, value)).collect(),
            ForceKind::Spring { extent, stiffness, length, damping } => {
                let constants =
                    [("stiffness", Some(stiffness)), ("length", length.as_ref()), ("damping", damping.as_ref())];
                extended("a spring", extent, &constants)
            }
            ForceKind::Stop { extent, least, most, stiffness, width, damping } => {
                let constants = [
                    ("lower limit", least.as_ref()),
                    ("upper limit", most.as_ref()),
                    ("stiffness", Some(stiffness)),
                    ("width", Some(width)),
                    ("damping", damping.as_ref()),
                ];
                extended("a stop", extent, &constants)
            }
            ForceKind::Friction { extent, viscous, dry, width } => {
                let constants =
                    [("viscous part", viscous.as_ref()), ("dry part", dry.as_ref()), ("width", width.as_ref())];
                extended("friction", extent, &constants)
            }
            ForceKind::Drag { linear, quadratic, .. } => {
                let entries = linear.iter().chain(quadratic).flat_map(Coefficients::entries);
                entries.map(|entry| (Place::Coefficient, entry)).collect()
            }
            ForceKind::Dissipation(function) => vec![(Place::Dissipation, function)],
        }
    }
}

impl ForceKind {
    /// The body or frame that it acts on, if it names one.
    pub fn body(&self) -> Option<&Ident> {
        match self {
            ForceKind::OnBody { body, .. }
            | ForceKind::Torque { body, .. }
            | ForceKind::Wrench { body, .. }
            | ForceKind::Drag { body, .. } => Some(body),
            ForceKind::AtPoint { .. }
            | ForceKind::Drive { .. }
            | ForceKind::Spring { .. }
            | ForceKind::Stop { .. }
            | ForceKind::Friction { .. }
            | ForceKind::Dissipation(_) => None,
        }
    }

    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match self {
            ForceKind::AtPoint { at, value } => [at, value].into_iter().for_each(change),
            ForceKind::OnBody { at, value, .. } => at.iter_mut().chain([value]).for_each(change),
            ForceKind::Torque { value, .. } | ForceKind::Dissipation(value) => change(value),
            ForceKind::Wrench { at, force, torque, .. } => at.iter_mut().chain(force).chain(torque).for_each(change),
            ForceKind::Drive { rates } => rates.iter_mut().for_each(|(_, value)| change(value)),
            ForceKind::Spring { extent, stiffness, length, damping } => {
                extent.each_expression(change);
                [stiffness].into_iter().chain(length).chain(damping).for_each(change);
            }
            ForceKind::Stop { extent, least, most, stiffness, width, damping } => {
                extent.each_expression(change);
                [stiffness, width].into_iter().chain(least).chain(most).chain(damping).for_each(change);
            }
            ForceKind::Friction { extent, viscous, dry, width } => {
                extent.each_expression(change);
                viscous.iter_mut().chain(dry).chain(width).for_each(change);
            }
            ForceKind::Drag { linear, quadratic, .. } => {
                linear.iter_mut().chain(quadratic).for_each(|coefficients| coefficients.each_expression(change));
            }
        }
    }
}

/// The expressions of a spring or a stop.
fn extended<'a>(
    noun: &'static str,
    extent: &'a Extent,
    constants: &[(&'static str, Option<&'a Expression>)],
) -> Vec<(Place, &'a Expression)> {
    let mut all = match extent {
        Extent::Between { from, to } => vec![(Place::End(noun), from), (Place::End(noun), to)],
        Extent::Along(along) => vec![(Place::Along(noun), along)],
    };
    let constant = |&(word, constant): &(_, Option<&'a Expression>)| Some((Place::Constant { word, noun }, constant?));
    all.extend(constants.iter().filter_map(constant));
    all
}

impl Coefficients {
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        if let Coefficients::Diagonal(entries) = self {
            entries.iter_mut().for_each(|entry| change(entry));
        }
    }

    pub fn entries(&self) -> impl Iterator<Item = &Expression> {
        let entries = match self {
            Coefficients::Diagonal(entries) => Some(entries),
            Coefficients::Field(_) => None,
        };
        entries.into_iter().flatten().map(|entry| &**entry)
    }
}

impl Extent {
    fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match self {
            Extent::Between { from, to } => [from, to].into_iter().for_each(change),
            Extent::Along(along) => change(along),
        }
    }
}
