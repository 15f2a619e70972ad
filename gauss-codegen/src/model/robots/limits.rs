//! Limits of joints and tendons, and dry friction of joints, as contacts; stops that give way.

use std::collections::HashSet;

use proc_macro2::Ident;
use quote::format_ident;
use syn::ext::IdentExt;

use super::clauses::Robot;
use super::names;
use crate::model::language::robots::{Friction, Limits};
use crate::model::scene::contacts::{ContactClause, ContactGeometry};
use crate::model::scene::elements::STOP;
use crate::model::scene::elements::argument::{ALONG, DAMPING, LEAST, MOST, STIFFNESS, WIDTH};
use crate::model::scene::expression::Expression;
use crate::model::scene::forces::ForceClause;
use gauss_robots::description::{At, Joint, Note};
use gauss_robots::rotation::Rotation;

/// A joint or a tendon with limits.
struct LimitedMotion {
    at: At,
    along: Expression,
    limits: [Option<f64>; 2],
    /// Coordinate of a joint that follows no other.
    coordinate: Option<Ident>,
    /// Name where it is no coordinate.
    called: String,
}

impl Robot<'_> {
    /// Joints, then tendons along joints, then tendons through sites. Of balls what has a limit is −cos φ/sin φ₀, which
    /// is smooth also where they are not turned, and near φ₀ beyond it by as much as the angle φ.
    fn limited(&self) -> Vec<LimitedMotion> {
        let writer = self.writer;
        let mut limited = Vec::new();
        let is_limited = |index: usize, joint: &Joint| joint.limits != [None; 2] && !self.is_driven(index);
        for (index, joint, ..) in self.scalar_joints().filter(|(index, joint, ..)| is_limited(*index, joint)) {
            let own = self.structure.coupling_of[index].joint == index;
            let coordinate = self.coordinates[index].first().filter(|_| own).map(|q| q.ident.clone());
            let along = self.values(index, 0.0).into_iter().next();
            let (at, limits, called) = (joint.at, joint.limits, joint.name.clone());
            limited.extend(along.map(|along| LimitedMotion { at, along, limits, coordinate, called }));
        }
        for (joint, q) in self.groups() {
            let [None, Some(most)] = joint.limits else { continue };
            let turn = self.turn(&writer.name(q), &Rotation::none());
            let along = writer.times(writer.number(-1.0 / most.sin()), turn.cosine);
            let (at, limits, called) = (joint.at, [None, Some(-1.0 / most.tan())], joint.name.clone());
            limited.push(LimitedMotion { at, along, limits, coordinate: Some(q.clone()), called });
        }
        let named = |name: &Option<String>| name.clone().unwrap_or_else(|| "tendon".to_owned());
        let mut add = |at: At, along: Option<Expression>, limits: Option<[f64; 2]>, called: String| {
            let found = along.zip(limits.map(|limits| limits.map(Some)));
            limited.extend(found.map(|(along, limits)| LimitedMotion { at, along, limits, coordinate: None, called }));
        };
        for tendon in &self.description.tendons {
            let along = self.length(&tendon.along).filter(|_| !self.is_given(&tendon.along));
            add(tendon.at, along, tendon.limits, named(&tendon.name));
        }
        for cable in &self.description.cables {
            let length = self.moving_parts(cable).map(|parts| self.length_of(&parts));
            add(cable.at, length, cable.limits, named(&cable.name));
        }
        limited
    }

    /// Note that limits do not act, where nothing is said of them.
    pub fn notes_of_limits(&self) -> Option<Note> {
        let first = self.limited().into_iter().next().filter(|_| self.clauses.limits.is_none())?;
        let text = "the limits of joints and tendons do not act; write `limits = range` for exact stops, which a \
                    `ContactRun` runs, `limits = stop(stiffness = …, width = …)` for stops that give way, or `limits = none`";
        Some(Note::ignored(first.at, "limit", text))
    }

    /// Stops that give way, where their law is said.
    pub fn stops(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let Some(Limits::Stop { stiffness, width, damping }) = &self.clauses.limits else { return Vec::new() };
        let stop = |limited: LimitedMotion| {
            let [least, most] = limited.limits.map(|limit| limit.map(|limit| writer.number(limit)));
            let name = limited.coordinate.map(|q| format_ident!("{}_limits", q.unraw()));
            let stop = ForceClause::new(&STOP, name, writer.span).with(ALONG, Some(limited.along));
            let stop = stop.with(LEAST, least).with(MOST, most).with(STIFFNESS, Some(stiffness.clone()));
            stop.with(WIDTH, Some(width.clone())).with(DAMPING, damping.clone())
        };
        self.limited().into_iter().map(stop).collect()
    }

    /// Exact stops, where they are asked for: contacts by the names of coordinates, of joints that follow others, and
    /// of tendons.
    pub fn ranges(&self) -> Vec<ContactClause> {
        let writer = self.writer;
        if !matches!(self.clauses.limits, Some(Limits::Range)) {
            return Vec::new();
        }
        let coordinates = self.coordinates.iter().flatten().map(|q| q.ident.unraw().to_string());
        let mut taken: HashSet<String> = coordinates.collect();
        let range = |limited: LimitedMotion| {
            let name = limited.coordinate.map(|q| q.unraw().to_string()).unwrap_or_else(|| {
                let free = names::free(&limited.called, "limits", |word| !taken.contains(word));
                taken.insert(free.clone());
                free
            });
            let [from, to] = limited.limits.map(|limit| limit.map(|limit| writer.number(limit)));
            let ends = [("from", &from), ("to", &to)].into_iter().filter(|(_, limit)| limit.is_some());
            let names = ends.map(|(end, _)| format_ident!("{name}_{end}", span = writer.span)).collect();
            let touching = ContactGeometry::Range { along: limited.along, from, to };
            ContactClause {
                names,
                touching,
                friction: Vec::new(),
                restitution: None,
                drilling: None,
                rolling: None,
                of_file: true,
                links: [None, None],
            }
        };
        self.limited().into_iter().map(range).collect()
    }

    /// Exact dry friction, where it is asked for: contacts without a normal, by the names of coordinates. A joint that
    /// moves m times as far as a coordinate resists it by |m| times its own force.
    pub fn dry_friction(&self) -> Vec<ContactClause> {
        let writer = self.writer;
        if !matches!(self.clauses.friction, Some(Friction::Dry)) {
            return Vec::new();
        }
        let mut bounds: Vec<(&Ident, f64)> = Vec::new();
        for (_, joint, q, multiplier) in self.scalar_joints() {
            let bound = joint.friction * multiplier.abs();
            match bounds.iter_mut().find(|(name, _)| *name == q) {
                Some((_, sum)) => *sum += bound,
                None => bounds.push((q, bound)),
            }
        }
        let clause = |(q, bound): (&Ident, f64)| ContactClause {
            names: vec![q.clone()],
            touching: ContactGeometry::Slip { slips: vec![writer.name(q)], named: true },
            friction: vec![writer.number(bound)],
            restitution: None,
            drilling: None,
            rolling: None,
            of_file: true,
            links: [None, None],
        };
        bounds.into_iter().filter(|(_, bound)| *bound > 0.0).map(clause).collect()
    }
}
