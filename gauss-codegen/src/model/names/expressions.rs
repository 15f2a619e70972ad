//! The expressions of a scene, each with its place.

use super::places::{ExpressionPlace, Holder};
use crate::model::language::statements::Statements;
use crate::model::language::words::{same, word};
use crate::model::scene::clauses::{RoleClause, RoleValue};
use crate::model::scene::contacts::{ContactClause, ContactGeometry, Copies, Counterpart, PointContact};
use crate::model::scene::elements::{ArgumentType, ElementArgument};
use crate::model::scene::expression::{Expression, ExpressionKind, FunctionName};
use crate::model::scene::forces::{ArgumentContent, ForceClause};
use crate::terms::Role;

/// Every expression, with its place; those of constraints and contacts come after the others.
pub fn all(statements: &Statements) -> Vec<(ExpressionPlace, &Expression)> {
    let mut all = Vec::new();
    let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
    for (name, rate) in statements.kinematics.iter().flat_map(|kinematics| &kinematics.rates) {
        let kind = coordinates().find(|coordinate| same(&coordinate.ident, name)).map(|coordinate| coordinate.kind);
        all.extend(rate.as_ref().map(|rate| (ExpressionPlace::Kinematics(kind), rate)));
    }
    all.extend(statements.states.iter().filter_map(|state| Some((ExpressionPlace::State, state.rate.as_ref()?))));
    for body in &statements.bodies {
        all.extend(body.position.as_ref().map(|position| (ExpressionPlace::Position, position)));
        all.extend(body.rotation.as_ref().map(|rotation| (ExpressionPlace::Rotation, rotation)));
    }
    let clauses = statements.all_role_clauses();
    all.extend(clauses.flat_map(RoleClause::expressions));
    for particle in &statements.particles {
        all.push((ExpressionPlace::Mass, &particle.mass));
        all.push((ExpressionPlace::Particle { parent: particle.parent.is_some() }, &particle.position));
    }
    all.extend(statements.points.iter().map(|point| (ExpressionPlace::At, &point.at)));
    if let Some((_, Some(potential))) = &statements.potential {
        all.push((ExpressionPlace::Potential, potential));
    }
    if let Some((_, Some(velocity))) = &statements.medium {
        all.push((ExpressionPlace::Medium, velocity));
    }
    all.extend(statements.attractions.iter().flat_map(|clause| clause.placed(statements.in_chart)));
    let armature = ExpressionPlace::Constant { word: "inertia", of: Holder::Armature };
    all.extend(statements.armatures.iter().map(|(_, inertia)| (armature, inertia)));
    let integral = ExpressionPlace::Constant { word: "integral", of: Holder::Modes };
    let of_modes = statements.modes.iter().flat_map(|read| read.clause.expressions());
    all.extend(of_modes.map(|entry| (integral, entry)));
    for clause in &statements.forces {
        let on = clause.body();
        // The name of a point of the same body stands for its place in the body.
        let named = |place: &ExpressionPlace, e: &Expression| {
            let point = on.and_then(|body| statements.own_point(body, e));
            matches!(place, ExpressionPlace::ForceAt { .. }) && point.is_some()
        };
        let placed = clause.placed(statements.in_chart).into_iter();
        all.extend(placed.filter(|(place, expression)| !named(place, expression)));
    }
    all.extend(
        statements.constraints.iter().map(|clause| (ExpressionPlace::Constraint(clause.kind), &clause.expression)),
    );
    all.extend(statements.contacts.iter().flat_map(ContactClause::placed));
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
        self.states.iter_mut().filter_map(|state| state.rate.as_mut()).for_each(&mut *change);
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
        self.contacts.iter_mut().for_each(|clause| clause.each_expression(change));
        for (_, value) in self.potential.iter_mut().chain(&mut self.medium) {
            value.iter_mut().for_each(&mut *change);
        }
        self.attractions.iter_mut().for_each(|clause| clause.each_expression(change));
        self.armatures.iter_mut().for_each(|(_, inertia)| change(inertia));
        let integrals = self.modes.iter_mut().flat_map(|read| &mut read.clause.integrals);
        integrals.flat_map(|given| &mut given.entries).for_each(&mut *change);
        self.forces.iter_mut().for_each(|clause| clause.each_expression(change));
    }

    /// Writes the rate of a coordinate in the place of its name, where dry friction resists it.
    pub fn name_rates(&mut self) {
        let coordinates = self.coordinates.iter().flat_map(|names| &names.names);
        let coordinates: Vec<String> = coordinates.map(|coordinate| word(&coordinate.ident)).collect();
        for clause in &mut self.contacts {
            let ContactGeometry::Slip { slips, named: true } = &mut clause.touching else { continue };
            for slip in slips {
                if matches!(&slip.kind, ExpressionKind::Name(name) if coordinates.contains(&word(name))) {
                    let kind = ExpressionKind::Call(FunctionName::Rate, vec![slip.clone()]);
                    *slip = Expression { kind, span: slip.span };
                }
            }
        }
    }

    /// Writes the places of points in the place of their names, where forces act in the axes of the body that has them.
    pub fn place_at_points(&mut self) {
        let mut forces = std::mem::take(&mut self.forces);
        for clause in &mut forces {
            let Some(body) = clause.body().cloned() else { continue };
            for given in clause.given.iter_mut().filter(|given| given.argument.takes == ArgumentType::Point) {
                if let ArgumentContent::Expression(at) = &mut given.value
                    && let Some(point) = self.own_point(&body, at)
                {
                    *at = point.at.clone();
                }
            }
        }
        self.forces = forces;
    }
}

impl RoleClause {
    /// Its expressions, with their places.
    pub fn expressions(&self) -> Vec<(ExpressionPlace, &Expression)> {
        match &self.value {
            RoleValue::Expression(value) => vec![(ExpressionPlace::Role(self.role), value)],
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

/// Place of an entry of an added mass, or of an inertia.
pub fn entry(role: Role) -> ExpressionPlace {
    ExpressionPlace::Constant {
        word: "entry",
        of: if role == Role::AddedMass { Holder::AddedMass } else { Holder::Inertia },
    }
}

impl ContactClause {
    /// Its expressions, with their places.
    pub fn placed(&self) -> Vec<(ExpressionPlace, &Expression)> {
        let mut placed = match &self.touching {
            ContactGeometry::Gap { gap, slips, spin, rolls } => {
                let slips = slips.iter().chain(spin).chain(rolls).map(|slip| (ExpressionPlace::Slip, slip));
                std::iter::once((ExpressionPlace::Gap, gap)).chain(slips).collect::<Vec<_>>()
            }
            ContactGeometry::Point(contact) => contact.placed(),
            ContactGeometry::Slip { slips, .. } => slips.iter().map(|slip| (ExpressionPlace::Slip, slip)).collect(),
            ContactGeometry::Range { along, from, to } => {
                let limits = from.iter().chain(to).map(|limit| (ExpressionPlace::Limit, limit));
                std::iter::once((ExpressionPlace::Limited, along)).chain(limits).collect()
            }
        };
        let bounds = if matches!(self.touching, ContactGeometry::Slip { .. }) {
            ExpressionPlace::Bound
        } else {
            ExpressionPlace::Friction
        };
        placed.extend(self.friction.iter().map(|friction| (bounds, friction)));
        let restitution = ExpressionPlace::Constant { word: "coefficient of restitution", of: Holder::Contact };
        placed.extend(self.restitution.iter().map(|value| (restitution, value)));
        let drilling = ExpressionPlace::Constant { word: "radius of drilling", of: Holder::Contact };
        placed.extend(self.drilling.iter().map(|value| (drilling, value)));
        placed.extend(self.rolling.iter().map(|value| (ExpressionPlace::Rolling, value)));
        placed
    }
}

impl PointContact {
    /// Its expressions, with their places.
    fn placed(&self) -> Vec<(ExpressionPlace, &Expression)> {
        let constant = |word| ExpressionPlace::Constant { word, of: Holder::Contact };
        let radius = constant("radius");
        let mut placed = vec![(ExpressionPlace::Touching, &self.point)];
        placed.extend(self.radius.iter().map(|value| (radius, value)));
        if let Some([of_rim, axis]) = &self.rim {
            placed.extend([(radius, of_rim), (ExpressionPlace::Direction, axis)]);
        }
        placed.extend(self.semi_axes.iter().flatten().map(|value| (constant("semi-axis"), value)));
        match &self.copies {
            Copies::One => {}
            Copies::Corners(edges) => placed.extend(edges.iter().map(|edge| (constant("edge"), edge))),
            Copies::Ends(end) => placed.push((ExpressionPlace::Touching, end)),
            Copies::Rims(length) => placed.push((constant("length"), length)),
        }
        match &self.against {
            Counterpart::Plane { normal, height, along } => {
                placed.extend(normal.iter().chain(along).map(|value| (ExpressionPlace::Direction, value)));
                placed.extend(height.iter().map(|value| (ExpressionPlace::Height, value)));
            }
            Counterpart::Ground(height) => placed.push((ExpressionPlace::Height, height)),
            Counterpart::Sphere { center, end, radius: other, along } => {
                placed.push((ExpressionPlace::Touching, center));
                placed.extend(end.iter().map(|end| (ExpressionPlace::Touching, end)));
                placed.extend(other.iter().map(|value| (radius, value)));
                placed.extend(along.iter().map(|value| (ExpressionPlace::Direction, value)));
            }
        }
        placed
    }
}

impl ForceClause {
    /// Its expressions, with their places.
    fn placed(&self, in_chart: bool) -> Vec<(ExpressionPlace, &Expression)> {
        let placed = |(argument, _, expression)| Some((self.place(argument, in_chart)?, expression));
        self.expressions().into_iter().filter_map(placed).collect()
    }

    /// Place of the expression of an argument; `None` if it is none.
    fn place(&self, argument: &ElementArgument, in_chart: bool) -> Option<ExpressionPlace> {
        let holder = Holder::Element(self.row);
        Some(match argument.takes {
            ArgumentType::Body | ArgumentType::Other | ArgumentType::Axes => return None,
            ArgumentType::Point if self.body().is_none() => ExpressionPlace::ForcePoint,
            ArgumentType::Point => {
                let needs_body = |a: &ElementArgument| a.takes == ArgumentType::Body && a.required.is_some();
                ExpressionPlace::ForceAt { bound: in_chart || self.row.arguments.iter().any(needs_body) }
            }
            ArgumentType::Force => ExpressionPlace::Force,
            ArgumentType::Torque => ExpressionPlace::Torque,
            ArgumentType::FlowVelocity => ExpressionPlace::FlowVelocity,
            ArgumentType::Drive => ExpressionPlace::Drive,
            ArgumentType::Dissipation => ExpressionPlace::Dissipation,
            ArgumentType::End => ExpressionPlace::End(holder),
            ArgumentType::Along => ExpressionPlace::Along(holder),
            ArgumentType::Constant { called, .. } | ArgumentType::Matrix { called, .. } => {
                ExpressionPlace::Constant { word: called, of: holder }
            }
            ArgumentType::Coefficients(_) => ExpressionPlace::Coefficient(holder),
            ArgumentType::Center => ExpressionPlace::Center,
        })
    }
}
