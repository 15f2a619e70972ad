//! Units that places need: forces in N, torques in N m, positions in m, and so on.

use std::collections::HashMap;

use super::dimensions::{Dimensions, InferredDimension, UnitChecker};
use super::need::{ADDED_MASS, ANGULAR_VELOCITY, ENERGY, FORCE, LENGTH, MASS, Need, POWER, TORQUE, VELOCITY};
use crate::model::language::context::Context;
use crate::model::language::declarations::Origin;
use crate::model::language::fields::ReadField;
use crate::model::language::statements::Statements;
use crate::model::language::units::{self, Dimension, read};
use crate::model::language::words::{self, PI, TIME, same};
use crate::model::scene::clauses::CoordinateKind;
use crate::model::scene::contacts::{ContactClause, ContactGeometry};
use crate::model::scene::elements::{ArgumentType, ElementArgument, Unit};
use crate::model::scene::expression::{Expression, ExpressionKind, FunctionName};
use crate::model::scene::forces::ForceClause;
use crate::terms::Role;
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
    let mut checker = UnitChecker { units, names: HashMap::new(), number: InferredDimension::Number, context };
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
    for state in &statements.states {
        checker.add(&state.name, Dimensions::UNKNOWN);
    }
    for point in &statements.points {
        checker.add(&point.name, Dimensions::of(LENGTH.1));
    }
    for definition in &statements.definitions {
        // Numbers of a motion are in whatever unit makes it right, as `sin(2 * t)`.
        let driven = definition.origin == Origin::Motion;
        checker.number = if driven { InferredDimension::Unknown } else { InferredDimension::Number };
        let value = definition.expression.as_ref().map_or(Dimensions::UNKNOWN, |expression| checker.value(expression));
        checker.add(&definition.name, value);
    }
    checker.number = InferredDimension::Number;
    checker.places(statements);
    let number = |of_file: bool| if of_file { InferredDimension::Unknown } else { InferredDimension::Number };
    for (index, clause) in statements.forces.iter().enumerate() {
        checker.number = number(index < statements.forces_of_file);
        checker.element(clause);
    }
    for (index, constraint) in statements.constraints.iter().enumerate() {
        checker.number = number(index < statements.constraints_of_file);
        checker.value(&constraint.expression);
    }
    checker.number = InferredDimension::Number;
    statements.contacts.iter().for_each(|clause| checker.contact(clause));
}

impl UnitChecker<'_> {
    /// Checks the units of all that moves and of all that has mass.
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
        for rate in statements.states.iter().filter_map(|state| state.rate.as_ref()) {
            self.value(rate);
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
        self.of_any_unit(statements);
        statements.attractions.iter().for_each(|clause| self.element(clause));
    }

    /// Armatures are in the unit of their coordinate, integrals of modes in one of their author's: kg^½ m, m, none.
    fn of_any_unit(&mut self, statements: &Statements) {
        let of_modes = statements.modes.iter().flat_map(|read| read.clause.expressions());
        for free in statements.armatures.iter().map(|(_, inertia)| inertia).chain(of_modes) {
            self.value(free);
        }
    }

    /// Slips are in the unit of the rate of their gap, limits in that of what they limit; coefficients have none.
    fn contact(&mut self, clause: &ContactClause) {
        const NONE: (&str, Dimension) = ("no unit", Dimension::NONE);
        let extent = |found: Dimensions| match found.parts()[0] {
            InferredDimension::Known(dimension) => Some(Extent { dimension, named: String::new() }),
            _ => None,
        };
        if let ContactGeometry::Slip { slips, .. } = &clause.touching {
            return self.dry_friction(slips, &clause.friction);
        }
        let (first, others, what, unit) = match &clause.touching {
            ContactGeometry::Slip { .. } => return,
            ContactGeometry::Gap { gap, slips, .. } => {
                (gap, slips.iter().collect(), "a slip with this gap is", Unit::Rate)
            }
            ContactGeometry::Point(contact) => {
                let lengths = Need::new("points, radii and heights of a contact are", LENGTH);
                contact.lengths().into_iter().for_each(|e| self.require(e, &lengths));
                (&contact.point, Vec::new(), "", Unit::Extent)
            }
            ContactGeometry::Range { along, from, to } => {
                (along, from.iter().chain(to).collect::<Vec<_>>(), "the limit of this range is", Unit::Extent)
            }
        };
        let of_gap = extent(self.value(first));
        let needed = of_gap.as_ref().and_then(|extent| extent.unit(unit));
        for other in others {
            match &needed {
                Some((text, dimension)) => self.require(other, &Need::new(what, (text, *dimension))),
                None => {
                    self.value(other);
                }
            }
        }
        self.turns(clause, of_gap.and_then(|extent| extent.unit(Unit::Extent)));
        let friction = clause.friction.iter().map(|e| (e, "a coefficient of friction is"));
        let restitution = clause.restitution.iter().map(|e| (e, "a coefficient of restitution is"));
        for (e, what) in friction.chain(restitution) {
            self.require(e, &Need::new(what, NONE));
        }
    }

    /// Spins are angular velocities; the radius of drilling and the arm of rolling resistance are in the unit of the
    /// gap.
    fn turns(&mut self, clause: &ContactClause, of_gap: Option<(String, Dimension)>) {
        if let ContactGeometry::Gap { spin, rolls, .. } = &clause.touching {
            let rate = Need::new("a spin and a roll are", ANGULAR_VELOCITY);
            spin.iter().chain(rolls).for_each(|e| self.require(e, &rate));
        }
        let arm = match (&clause.touching, &of_gap) {
            (ContactGeometry::Point(_), _) => Some(LENGTH),
            (_, Some((text, dimension))) => Some((&text[..], *dimension)),
            _ => None,
        };
        for e in clause.drilling.iter().chain(&clause.rolling) {
            match arm {
                Some(arm) => self.require(e, &Need::new("radii of drilling and arms of rolling resistance are", arm)),
                None => {
                    self.value(e);
                }
            }
        }
    }

    /// Bounds of dry friction are in the unit of power by slip.
    fn dry_friction(&mut self, slips: &[Expression], bounds: &[Expression]) {
        let found: Vec<Dimensions> = slips.iter().map(|slip| self.value(slip)).collect();
        let of = |found: &Dimensions| match found.parts()[0] {
            InferredDimension::Known(dimension) => POWER.1.over(dimension),
            _ => None,
        };
        for (k, bound) in bounds.iter().enumerate() {
            match found.get(k).and_then(of) {
                Some(needed) => {
                    let what = "the bound of this dry friction is";
                    self.require(bound, &Need::new(what, (&needed.to_string(), needed)));
                }
                None => {
                    self.value(bound);
                }
            }
        }
    }

    /// The arguments of a force element.
    fn element(&mut self, clause: &ForceClause) {
        let mut extent = None;
        for (argument, index, expression) in clause.expressions() {
            match self.need(clause, (argument, index), extent.as_ref()) {
                Some(need) => self.require(expression, &need),
                None => {
                    let found = self.value(expression);
                    if let (ArgumentType::Along, InferredDimension::Known(dimension)) =
                        (argument.takes, found.parts()[0])
                    {
                        extent = Some(Extent { dimension, named: named(dimension) });
                    }
                }
            }
            if argument.takes == ArgumentType::End {
                extent = Some(Extent { dimension: LENGTH.1, named: String::new() });
            }
        }
    }

    /// Unit that an argument needs, if that is known: of six coefficients the one at `index`.
    fn need(
        &self,
        clause: &ForceClause,
        (argument, index): (&ElementArgument, usize),
        extent: Option<&Extent>,
    ) -> Option<Need> {
        let noun = words::a(clause.noun());
        Some(match argument.takes {
            ArgumentType::Point => Need::new("the place where a force acts is", LENGTH),
            ArgumentType::Force => Need::new("the components of a force are", FORCE),
            ArgumentType::Torque => Need::new("the components of a torque are", TORQUE),
            ArgumentType::FlowVelocity => Need::new("the velocity of a mass flow is", VELOCITY),
            ArgumentType::Dissipation => Need::new("a dissipation function is", POWER),
            ArgumentType::End => Need::new(format!("the ends of {noun} are"), LENGTH),
            ArgumentType::Center => Need::new("a center of gravity is", LENGTH),
            ArgumentType::Constant { called, unit: Unit::Is(unit), .. } => {
                Need::new(format!("the {called} of {noun} is"), (unit, units::read(unit).ok()?))
            }
            ArgumentType::Constant { called, unit, .. } => {
                let (text, dimension) = extent?.unit(unit)?;
                let named = &extent?.named;
                Need::new(format!("the {called} of {noun}{named} is"), (&text, dimension))
            }
            ArgumentType::Coefficients(units) | ArgumentType::Matrix { units, .. } => {
                let part = usize::from(index >= 3);
                let (which, word) = (["first", "last"][part], argument.word);
                let what = format!("the {which} three {word} coefficients of {noun} are");
                Need::new(what, (units[part], read(units[part]).ok()?))
            }
            ArgumentType::Body
            | ArgumentType::Other
            | ArgumentType::Axes
            | ArgumentType::Drive
            | ArgumentType::Along => return None,
        })
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

/// Extent along which an element acts.
struct Extent {
    dimension: Dimension,
    /// `along an angle`, where it is a scalar.
    named: String,
}

impl Extent {
    /// The unit of a constant, where one is known.
    fn unit(&self, unit: Unit) -> Option<(String, Dimension)> {
        let force = ENERGY.1.over(self.dimension)?;
        let stiffness = force.over(self.dimension)?;
        let dimension = match unit {
            Unit::Is(text) => units::read(text).ok()?,
            Unit::Extent => self.dimension,
            Unit::ForceByExtent => stiffness,
            Unit::ForceByRate => stiffness.times(Dimension::TIME)?,
            Unit::Force => force,
            Unit::Rate => self.dimension.over(Dimension::TIME)?,
        };
        let angle = unit == Unit::Extent && dimension == Dimension::NONE;
        Some((if angle { "rad".into() } else { dimension.to_string() }, dimension))
    }
}

/// Words for a scalar extent, for messages.
fn named(dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        " along an angle".into()
    } else if dimension == LENGTH.1 {
        " along a length".into()
    } else {
        format!(" along a coordinate in {dimension}")
    }
}
