//! Loads in the joints: damping, dry friction, the inertia of rotors; weights that are held.

use proc_macro2::Ident;

use super::clauses::Robot;
use crate::model::language::robots::Friction;
use crate::model::scene::clauses::{RoleClause, RoleValue};
use crate::model::scene::elements::FORCE;
use crate::model::scene::elements::argument::{AT, AXES, BODY, VALUE};
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
use crate::model::scene::forces::{ForceAxes, ForceClause};
use gauss_robots::description::{Joint, JointKind, Note};

impl Robot<'_> {
    /// Loads in the joints.
    pub fn forces(&mut self, gravity: Option<&RoleClause>) -> Vec<ForceClause> {
        let span = self.writer.span;
        let name = |name: &str| Some(Ident::new(name, span));
        let mut forces = Vec::new();
        let efforts = self.efforts();
        if !efforts.is_empty() {
            forces.push(ForceClause::drive(name("efforts"), efforts, span));
        }
        forces.extend(self.thrusts());
        forces.extend(self.turning());
        let damping = self.damping();
        forces.extend(damping.map(|function| ForceClause::dissipation(name("joint_damping"), function, span)));
        forces.extend(self.springs());
        let (turns, mut of_turns) = self.springs_of_turns();
        forces.extend(turns);
        self.notes.append(&mut of_turns);
        forces.extend(self.cables());
        let (tendons, mut of_tendons) = self.tendons();
        forces.extend(tendons);
        self.notes.append(&mut of_tendons);
        let (bent, mut of_springs) = self.nonlinear_springs();
        forces.extend(bent);
        self.notes.append(&mut of_springs);
        let (held, mut of_weights) = self.held(gravity);
        forces.extend(held);
        self.notes.append(&mut of_weights);
        let (friction, mut notes) = self.friction();
        if !friction.is_empty() {
            forces.push(ForceClause::drive(name("joint_friction"), friction, span));
        }
        forces.extend(self.stops());
        notes.extend(self.notes_of_limits());
        notes.extend(self.notes_of_ranges());
        self.notes.extend(notes);
        forces
    }

    /// Joints with one coordinate, each with that of the joint that it follows, and how many times its rate is that
    /// one's.
    pub fn scalar_joints(&self) -> impl Iterator<Item = (usize, &Joint, &Ident, f64)> {
        self.description.joints.iter().enumerate().filter_map(|(index, joint)| {
            let coupling = self.structure.coupling_of[index];
            match (joint.kind, self.coordinates[coupling.joint].as_slice()) {
                (JointKind::Turning | JointKind::Sliding, [q]) => Some((index, joint, &q.ident, coupling.multiplier)),
                _ => None,
            }
        })
    }

    /// Σ ½ d (m q̇)² over joints, Σ ½ d ω² over balls, Σ ½ d (v² + ω²) over free joints.
    fn damping(&self) -> Option<Expression> {
        let writer = self.writer;
        let terms =
            self.scalar_joints().filter(|(_, joint, ..)| joint.damping > 0.0).map(|(_, joint, q, multiplier)| {
                let rate = writer.call(FunctionName::Rate, vec![writer.name(q)]);
                let factor = writer.number(joint.damping * multiplier * multiplier / 2.0);
                writer.times(factor, writer.times(rate.clone(), rate))
            });
        let of_groups = self.groups().filter(|(joint, _)| joint.damping > 0.0).flat_map(|(joint, q)| {
            let moving = (joint.kind == JointKind::Floating).then_some(Property::Velocity);
            moving.into_iter().chain([Property::BodyAngularVelocity]).map(move |velocity| {
                let rate = writer.property(q, velocity);
                let square = writer.call(FunctionName::Dot, vec![rate.clone(), rate]);
                writer.times(writer.number(joint.damping / 2.0), square)
            })
        });
        terms.chain(of_groups).reduce(|a, b| writer.plus(a, b))
    }

    /// Joints whose coordinate is a rotation or a pose.
    pub fn groups(&self) -> impl Iterator<Item = (&Joint, &Ident)> {
        self.description.joints.iter().zip(&self.coordinates).filter_map(|(joint, own)| {
            match (joint.kind, own.as_slice()) {
                (JointKind::Ball | JointKind::Floating, [q]) => Some((joint, &q.ident)),
                _ => None,
            }
        })
    }

    /// Inertia of the rates of coordinates: m² times the armature of every joint that moves with one.
    pub fn armatures(&self) -> Vec<(Ident, f64)> {
        let mut all: Vec<(Ident, f64)> = Vec::new();
        for (_, joint, q, multiplier) in self.scalar_joints().filter(|(_, joint, ..)| joint.armature > 0.0) {
            let inertia = joint.armature * multiplier * multiplier;
            match all.iter_mut().find(|(name, _)| name == q) {
                Some((_, sum)) => *sum += inertia,
                None => all.push((q.clone(), inertia)),
            }
        }
        let of_groups = self.groups().filter(|(joint, _)| joint.armature > 0.0);
        all.extend(of_groups.map(|(joint, q)| (q.clone(), joint.armature)));
        all
    }

    /// Σ c q of joints, as a sum of coordinates.
    pub fn length(&self, along: &[(String, f64)]) -> Option<Expression> {
        let writer = self.writer;
        let terms = along.iter().filter_map(|(name, factor)| {
            let joint = self.description.joints.iter().position(|joint| joint.name == *name)?;
            self.description.joints[joint].kind.is_scalar().then_some(())?;
            let value = self.values(joint, 0.0).into_iter().next()?;
            Some(if *factor == 1.0 { value } else { writer.times(writer.number(*factor), value) })
        });
        terms.reduce(|a, b| writer.plus(a, b))
    }

    /// Forces that hold a part of the weight of links, at their centres of mass; `gravity` is that of the struct, if it
    /// has one.
    fn held(&self, gravity: Option<&RoleClause>) -> (Vec<ForceClause>, Vec<Note>) {
        let writer = self.writer;
        let (mut forces, mut notes) = (Vec::new(), Vec::new());
        let gravity = match gravity.map(|clause| &clause.value) {
            None if self.gravity_in_field => None,
            None => self.description.gravity.map(|g| writer.triple(&g)),
            Some(RoleValue::Expression(down)) => match (&down.kind, down.literal()) {
                (_, Some(down)) => Some(writer.triple(&[0.0, 0.0, -down])),
                (ExpressionKind::Vector(_), None) => Some(Some(down.clone())),
                _ => None,
            },
            Some(RoleValue::Coefficients(_)) => None,
        };
        for (link, own) in self.description.links.iter().enumerate() {
            let Some(data) = own.inertial.filter(|data| own.held != 0.0 && self.moves(link) && data.mass > 0.0) else {
                continue;
            };
            match &gravity {
                Some(gravity) if !self.in_field[link] => forces.extend(gravity.as_ref().map(|gravity| {
                    let value = writer.times(writer.number(-data.mass * own.held), gravity.clone());
                    let body = self.links[link].clone();
                    let at = writer.triple(&data.center);
                    let force = ForceClause::new(&FORCE, None, writer.span).with(AT, at).with(VALUE, Some(value));
                    force.with(BODY, Some(body)).with(AXES, Some(ForceAxes::Observer))
                })),
                _ => {
                    let text = format!(
                        "`gravcomp` of `{}` does not act: its mass and gravity are to be numbers, not fields",
                        own.name
                    );
                    notes.push(Note::ignored(own.at, "gravcomp", text).about("gravcomp"));
                }
            }
        }
        (forces, notes)
    }

    /// −f v/√(v² + w²) of every joint with dry friction, where a width is said.
    fn friction(&self) -> (Vec<(Ident, Expression)>, Vec<Note>) {
        let writer = self.writer;
        let (mut rates, mut notes): (Vec<(Ident, Expression)>, _) = (Vec::new(), Vec::new());
        for (_, joint, q, multiplier) in self.scalar_joints().filter(|(_, joint, ..)| joint.friction > 0.0) {
            let width = match &self.clauses.friction {
                Some(Friction::Smooth(width)) => width,
                Some(Friction::Dry | Friction::None) => continue,
                None => {
                    let text = format!(
                        "the dry friction of the joint `{}` does not act; write `joint_friction = dry` for exact \
                         friction, which a `ContactRun` runs, `joint_friction = smooth(width)` for a law that is \
                         smooth over this width of its rate, or `joint_friction = none`",
                        joint.name
                    );
                    notes.push(Note::ignored(joint.at, "dynamics", text).about("friction"));
                    continue;
                }
            };
            let rate = writer.call(FunctionName::Rate, vec![writer.name(q)]);
            let rate = if multiplier == 1.0 { rate } else { writer.times(writer.number(multiplier), rate) };
            let squares = [&rate, width].map(|e| writer.times(e.clone(), e.clone()));
            let [rate_squared, width_squared] = squares;
            let root = writer.call(FunctionName::Sqrt, vec![writer.plus(rate_squared, width_squared)]);
            let ratio = writer.binary(BinaryOperator::Divide, rate, root);
            let value = writer.times(writer.number(-joint.friction * multiplier), ratio);
            match rates.iter_mut().find(|(name, _)| name == q) {
                Some((_, sum)) => *sum = writer.plus(sum.clone(), value),
                None => rates.push((q.clone(), value)),
            }
        }
        (rates, notes)
    }
}
