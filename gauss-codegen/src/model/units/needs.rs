//! What is needed in which unit: forces in N, torques in N m, positions in m, and so on.

use std::collections::HashMap;

use super::dimensions::{Checker, Dimensions, Found};
use super::need::{
    ADDED_MASS, ANGULAR_VELOCITY, COEFFICIENTS, ENERGY, FORCE, GRAVITATION, LENGTH, MASS, Need, POWER, TORQUE, VELOCITY,
};
use crate::model::language::context::Context;
use crate::model::language::fields::ReadField;
use crate::model::language::statements::Statements;
use crate::model::language::units::{self, Dimension};
use crate::model::language::words::{PI, TIME, same};
use crate::model::scene::clauses::{Coefficients, CoordinateKind, Extent, ForceKind};
use crate::model::scene::expression::{Expression, ExpressionKind, FunctionName};
use crate::model::scene::roles::Role;
use proc_macro2::Ident;

/// Notes where dimensions disagree with one another or with what is needed. Names and kinds are right.
pub fn check(statements: &Statements, fields: &[ReadField<'_>], context: &mut Context) {
    let inputs = || statements.inputs.iter().flat_map(|names| &names.names);
    let units: Vec<(&Ident, &str)> = fields
        .iter()
        .filter_map(|field| Some((field.ident, field.unit.as_deref()?)))
        .chain(inputs().filter_map(|input| Some((&input.ident, input.unit.as_deref()?))))
        .collect();
    if units.is_empty() {
        return;
    }
    let mut checker = Checker { units, names: HashMap::new(), context };
    checker.name_as(TIME.into(), Dimensions::of(Dimension::TIME));
    checker.name_as(PI.into(), Dimensions::of(Dimension::NONE));
    for field in fields {
        let implied = field.role.as_ref().and_then(|claim| Role::unit(claim.role)).map(|(_, dimension)| dimension);
        let written = field.unit.as_ref().and_then(|unit| units::read(unit).ok());
        checker.add(field.ident, implied.or(written).map_or(Dimensions::UNKNOWN, Dimensions::of));
    }
    for input in inputs() {
        let written = input.unit.as_ref().and_then(|unit| units::read(unit).ok());
        checker.add(&input.ident, written.map_or(Dimensions::UNKNOWN, Dimensions::of));
    }
    for coordinate in statements.coordinates.iter().flat_map(|names| &names.names) {
        let rotation = coordinate.kind == CoordinateKind::Rotation;
        checker.add(&coordinate.ident, if rotation { Dimensions::Rotation } else { Dimensions::UNKNOWN });
    }
    for point in &statements.points {
        checker.add(&point.name, Dimensions::of(LENGTH.1));
    }
    for definition in &statements.definitions {
        let value = definition.expression.as_ref().map_or(Dimensions::UNKNOWN, |expression| checker.value(expression));
        checker.add(&definition.name, value);
    }
    checker.places(statements);
    for (index, clause) in statements.forces.iter().enumerate() {
        // Numbers of a file are in units of the SI: they need not say so.
        let has_numbers = matches!(clause.kind, ForceKind::Dissipation(_) | ForceKind::Wrench { .. });
        if index < statements.forces_of_file && has_numbers {
            continue;
        }
        checker.force(&clause.kind);
    }
    for constraint in &statements.constraints {
        checker.value(&constraint.expression);
    }
}

impl Checker<'_> {
    /// What moves and what has mass.
    pub fn places(&mut self, statements: &Statements) {
        let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
        for (name, rate) in statements.kinematics.iter().flat_map(|kinematics| &kinematics.rates) {
            let Some(rate) = rate else { continue };
            let kind = coordinates().find(|coordinate| same(&coordinate.ident, name)).map(|coordinate| coordinate.kind);
            match (&rate.kind, kind) {
                (ExpressionKind::Call(FunctionName::Twist, parts), _) => {
                    let needs = [
                        ("the velocity of a twist is", VELOCITY),
                        ("the angular velocity of a twist is", ANGULAR_VELOCITY),
                    ];
                    for (part, (what, unit)) in parts.iter().zip(needs) {
                        self.require(part, &Need::new(what, unit));
                    }
                }
                (_, Some(CoordinateKind::Rotation)) => {
                    self.require(rate, &Need::new("an angular velocity is", ANGULAR_VELOCITY));
                }
                _ => {
                    self.value(rate);
                }
            }
        }
        for body in &statements.bodies {
            self.optional(&body.position, &Need::new("positions are", LENGTH));
            if let Some(rotation) = &body.rotation {
                self.value(rotation);
            }
        }
        for clause in statements.all_role_clauses() {
            for (index, (_, value)) in clause.expressions().into_iter().enumerate() {
                match clause.role.unit() {
                    Some(unit) => self.require(value, &Need::new(format!("`{}` is", clause.role.word()), unit)),
                    None => {
                        let part = usize::from(index >= 3);
                        let what = format!("the {} three entries of an added mass are", ["first", "last"][part]);
                        self.require(value, &Need::new(what, ADDED_MASS[part]));
                    }
                }
            }
        }
        for particle in &statements.particles {
            self.require(&particle.mass, &Need::new("the mass of a particle is", MASS));
            self.require(&particle.position, &Need::new("positions are", LENGTH));
        }
        for point in &statements.points {
            self.require(&point.at, &Need::new("the place of a point is", LENGTH));
        }
        if let Some((_, potential)) = &statements.potential {
            self.optional(potential, &Need::new("a potential is", ENERGY));
        }
        if let Some((_, velocity)) = &statements.medium {
            self.optional(velocity, &Need::new("the velocity of the medium is", VELOCITY));
        }
        for (_, inertia) in &statements.armatures {
            self.value(inertia);
        }
        for clause in &statements.attractions {
            self.require(&clause.mu, &Need::new("a gravitational parameter is", GRAVITATION));
            self.optional(&clause.center, &Need::new("a center of gravity is", LENGTH));
        }
    }

    /// What acts.
    pub fn force(&mut self, kind: &ForceKind) {
        let at_need = Need::new("the place where a force acts is", LENGTH);
        let force_need = Need::new("the components of a force are", FORCE);
        let torque_need = Need::new("the components of a torque are", TORQUE);
        match kind {
            ForceKind::AtPoint { at, value } => {
                self.require(at, &at_need);
                self.require(value, &force_need);
            }
            ForceKind::OnBody { at, value, .. } => {
                self.optional(at, &at_need);
                self.require(value, &force_need);
            }
            ForceKind::Torque { value, .. } => self.require(value, &torque_need),
            ForceKind::Wrench { at, force, torque, .. } => {
                self.optional(at, &at_need);
                self.optional(force, &force_need);
                self.optional(torque, &torque_need);
            }
            ForceKind::Drive { rates } => rates.iter().for_each(|(_, value)| {
                self.value(value);
            }),
            ForceKind::Spring { extent, stiffness, length, damping } => {
                let constants = self.extent("a spring", extent);
                self.constant(Some(stiffness), "stiffness", constants.as_ref(), 0);
                self.constant(length.as_ref(), "length", constants.as_ref(), 1);
                self.constant(damping.as_ref(), "damping", constants.as_ref(), 2);
            }
            ForceKind::Stop { extent, least, most, stiffness, width, damping } => {
                let constants = self.extent("a stop", extent);
                self.constant(least.as_ref(), "lower limit", constants.as_ref(), 1);
                self.constant(most.as_ref(), "upper limit", constants.as_ref(), 1);
                self.constant(Some(stiffness), "stiffness", constants.as_ref(), 0);
                self.constant(Some(width), "width", constants.as_ref(), 1);
                self.constant(damping.as_ref(), "damping", constants.as_ref(), 2);
            }
            ForceKind::Friction { extent, viscous, dry, width } => self.friction(extent, viscous, dry, width),
            ForceKind::Drag { linear, quadratic, .. } => {
                let both = [("linear", linear), ("quadratic", quadratic)];
                for ((word, coefficients), units) in both.into_iter().zip(COEFFICIENTS) {
                    let Some(Coefficients::Diagonal(entries)) = coefficients else { continue };
                    for (index, entry) in entries.iter().enumerate() {
                        let part = usize::from(index >= 3);
                        let what = format!("the {} three {word} coefficients of a drag are", ["first", "last"][part]);
                        self.require(entry, &Need::new(what, units[part]));
                    }
                }
            }
            ForceKind::Dissipation(function) => self.require(function, &Need::new("a dissipation function is", POWER)),
        }
    }

    /// Viscous: force over rate; dry: force; its width: a rate.
    fn friction(
        &mut self,
        extent: &Extent,
        viscous: &Option<Expression>,
        dry: &Option<Expression>,
        width: &Option<Expression>,
    ) {
        let constants = self.extent("friction", extent);
        self.constant(viscous.as_ref(), "viscous part", constants.as_ref(), 2);
        // Units of the force, and of the rate.
        let derived = |pair: [usize; 2], combine: fn(Dimension, Dimension) -> Option<Dimension>| {
            let (noun, units) = constants.as_ref()?;
            let dimension = combine(units[pair[0]].1, units[pair[1]].1)?;
            let unit = (dimension.to_string(), dimension);
            Some((noun.clone(), [unit.clone(), unit.clone(), unit]))
        };
        self.constant(dry.as_ref(), "dry part", derived([0, 1], Dimension::times).as_ref(), 0);
        let rate = |extent: Dimension, _| extent.over(Dimension::TIME);
        self.constant(width.as_ref(), "width", derived([1, 1], rate).as_ref(), 0);
    }

    /// What the constants of `noun` are needed in, if that is known: stiffness, the extent itself, damping.
    fn extent(&mut self, noun: &str, extent: &Extent) -> Option<(String, [(String, Dimension); 3])> {
        match extent {
            Extent::Between { from, to } => {
                let need = Need::new(format!("the ends of {noun} are"), LENGTH);
                self.require(from, &need);
                self.require(to, &need);
                let units = [("N/m", Dimension::new(1, 0, -2)), LENGTH, ("N s/m", Dimension::new(1, 0, -1))];
                Some((noun.into(), units.map(|(unit, dimension)| (unit.into(), dimension))))
            }
            Extent::Along(along) => {
                let Found::Known(dimension) = self.value(along).parts()[0] else { return None };
                let named = if dimension == Dimension::NONE {
                    "an angle".into()
                } else if dimension == LENGTH.1 {
                    "a length".into()
                } else {
                    format!("a coordinate in {dimension}")
                };
                let own = if dimension == Dimension::NONE { "rad".into() } else { dimension.to_string() };
                let stiffness = ENERGY.1.over(dimension)?.over(dimension)?;
                let damping = stiffness.times(Dimension::TIME)?;
                let units = [(stiffness.to_string(), stiffness), (own, dimension), (damping.to_string(), damping)];
                Some((format!("{noun} along {named}"), units))
            }
        }
    }

    /// A constant of a spring or a stop, whose unit is the one at `index` of the list that [`Self::extent`] gives.
    fn constant(
        &mut self,
        value: Option<&Expression>,
        word: &str,
        needs: Option<&(String, [(String, Dimension); 3])>,
        index: usize,
    ) {
        let Some(value) = value else { return };
        let Some((noun, units)) = needs else {
            self.value(value);
            return;
        };
        let (unit, dimension) = &units[index];
        self.require(value, &Need::new(format!("the {word} of {noun} is"), (unit, *dimension)));
    }

    fn optional(&mut self, expression: &Option<Expression>, need: &Need) {
        if let Some(expression) = expression {
            self.require(expression, need);
        }
    }

    /// Compares the unit of an expression with the unit that its place needs, and notes a mistake where they differ. A
    /// vector that is written out is compared component by component, so that the mistake is at the component.
    fn require(&mut self, expression: &Expression, need: &Need) {
        match &expression.kind {
            ExpressionKind::Vector(components) => {
                components.iter().for_each(|component| self.require(component, need));
            }
            ExpressionKind::Negate(inner) => self.require(inner, need),
            _ => {
                let value = self.value(expression);
                self.compare(expression, value, need);
            }
        }
    }
}
