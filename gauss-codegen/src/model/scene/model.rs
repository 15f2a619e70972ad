//! A scene as the user wrote it, checked: coordinates and speeds, or the chart of a body; bodies, particles,
//! constraints and forces.

use super::clauses::{
    BodyClause, Coefficients, ConstraintClause, CoordinateClause, ElementState, ParticleClause, PointClause,
    RoleClause, RoleValue, Speed, SpeedPart,
};
use super::contacts::ContactClause;
use super::expression::Expression;
use super::forces::ForceClause;
use super::limbs::Limbs;
use super::modes::ModesClause;
use crate::terms::{BodyChart, Item};
use std::collections::HashSet;
use syn::Ident;
use syn::ext::IdentExt;

/// Any system that the Gauss condition covers.
#[derive(Clone)]
pub struct Model {
    /// The struct, and what is taken from it as it is written.
    pub item: Item,
    /// The chart and the motion of the body without a name, which is then among [`bodies`](Self::bodies) without a
    /// place: the first coordinates, speeds and components of ψ are those of its chart.
    pub in_chart: Option<BodyChart>,
    /// The coordinates q, in order; in a chart, those after the chart's.
    pub coordinates: Vec<CoordinateClause>,
    /// The speeds z, in order; `None` for the rates of the coordinates: ẋ of a scalar, ω (body axes) of a rotation, the
    /// twist (u, ω) (body axes, pole O) of a pose.
    pub speeds: Option<Vec<Speed>>,
    /// q̇ = ψ(t, q, z) of (3.2): one for each coordinate, in the order of the coordinates; empty without speeds. A
    /// scalar for a scalar, ω in body axes for a rotation, a call of [`Twist`](super::FunctionName::Twist) for a pose.
    pub kinematics: Vec<(Ident, Expression)>,
    /// States of elements, in order: components of the configuration behind all others, with rates of their own.
    pub states: Vec<ElementState>,
    /// Coordinates that are driven, in the order of the clauses: the function of time that each is, and its name for
    /// how far it is from there, which is zero.
    pub motions: Vec<(Ident, Expression)>,
    /// The bodies and frames, in the order in which they are written: a parent may come after its child.
    pub bodies: Vec<BodyClause>,
    /// The particles of (3.3).
    pub particles: Vec<ParticleClause>,
    /// Named points of bodies and frames.
    pub points: Vec<PointClause>,
    /// Constraints on the motion.
    pub constraints: Vec<ConstraintClause>,
    /// Constraints may depend on one another.
    pub redundant: bool,
    /// Contacts of the scene.
    pub contacts: Vec<ContactClause>,
    /// The speeds that stay when the constraints are solved for the others at compile time; `None`: multipliers.
    pub independent: Option<Vec<SpeedPart>>,
    /// The potential energy besides that of gravity: a scalar of t and q.
    pub potential: Option<Expression>,
    /// Mass data of the only body without a name, and gravity, where they are no fields.
    pub role_clauses: Vec<RoleClause>,
    /// The velocity of the medium: a vector of t, fields and numbers, observer axes; `None`: at rest.
    pub medium: Option<Expression>,
    /// Central gravity: each acts on every body and every particle.
    pub attractions: Vec<ForceClause>,
    /// Loads besides gravity and the potential, in the order in which it is written.
    pub forces: Vec<ForceClause>,
    /// Inertia of the rates of scalar coordinates: a scalar of fields and numbers for each.
    pub armatures: Vec<(Ident, Expression)>,
    /// Bodies that deform.
    pub modes: Vec<ModesClause>,
    /// Bodies whose principal moments need not obey the triangle inequality; `None`: all of them.
    pub formal: Vec<Option<Ident>>,
    /// Limbs that are alike.
    pub limbs: Limbs,
    /// Expressions of the names of `define`, each written out, in order: for printed equations alone.
    pub definitions: Vec<(Ident, Expression)>,
}

impl Model {
    /// One body in a chart, which nothing is attached to and nothing constrains, and which is all of the state.
    pub fn chart_of_all(&self) -> Option<BodyChart> {
        let alone = self.bodies.len() == 1
            && self.coordinates.is_empty()
            && self.states.is_empty()
            && self.particles.is_empty()
            && self.constraints.is_empty();
        self.in_chart.filter(|_| alone)
    }

    /// Something acts besides weight and buoyancy.
    pub fn is_acted_upon(&self) -> bool {
        let by_elements = !self.forces.is_empty() || !self.attractions.is_empty();
        by_elements || self.potential.is_some() || self.medium.is_some() || !self.item.inputs.is_empty()
    }

    /// Whether there is any expression, of forces or of mass data.
    pub fn has_expressions(&self) -> bool {
        let clauses = !self.role_clauses.is_empty() || !self.points.is_empty() || !self.contacts.is_empty();
        self.is_acted_upon() || clauses
    }

    /// Whether the field is the added mass that some clause names.
    pub fn is_added_mass(&self, field: &Ident) -> bool {
        let all = self.role_clauses.iter().chain(self.bodies.iter().flat_map(|body| &body.role_clauses));
        let named = |clause: &RoleClause| matches!(&clause.value, RoleValue::Coefficients(Coefficients::Field(name)) if name == field);
        all.into_iter().any(named)
    }

    /// Whether the principal moments of the body of that name (the unnamed one) need not obey the triangle inequality.
    pub fn waives_triangle_inequality(&self, body: Option<&Ident>) -> bool {
        let same = |formal: &Ident| body.map_or_else(|| formal == "body", |body| body.unraw() == formal.unraw());
        self.formal.iter().any(|formal| formal.as_ref().is_none_or(same))
    }

    /// Whether mass data are functions of time.
    pub fn mass_varies(&self) -> bool {
        let mut names = HashSet::new();
        self.particles.iter().for_each(|particle| particle.mass.put_names(&mut names));
        let all = self.role_clauses.iter().chain(self.bodies.iter().flat_map(|body| &body.role_clauses));
        for clause in all.filter(|clause| clause.role.is_of_matter()) {
            match &clause.value {
                RoleValue::Expression(value) => value.put_names(&mut names),
                RoleValue::Coefficients(entries) => entries.entries().for_each(|entry| entry.put_names(&mut names)),
            }
        }
        names.contains("t")
    }

    /// Whether the body is the one that moves in the chart of the model.
    pub fn is_in_chart(&self, body: &BodyClause) -> bool {
        self.in_chart.is_some() && body.name.is_none()
    }
}
