//! Links of a file that touch each other: which of their shapes the file lets touch, and which have a distance in
//! closed form.

use super::clauses::Robot;
use super::ground::{WORLD, beyond, in_brackets};
use super::touching::{ContactClauses, LinkPair};
use crate::model::language::context::Context;
use crate::model::language::self_contact::SelfContact;
use gauss_robots::collision::{Collision, Shape, Touch};
use gauss_robots::description::{Description, JointKind, Note};

/// Two shapes that touch, if they can.
struct Candidate<'a> {
    shapes: [&'a Collision; 2],
    touch: Touch,
}

impl Robot<'_> {
    /// Contacts of links with one another, as far as they are asked for.
    pub fn touching_each_other(&mut self, made: &mut ContactClauses, context: &mut Context) {
        let mut notes = self.notes_of_pairs();
        for clause in &self.clauses.self_contacts {
            let links = match &clause.links {
                Some(names) => self.named_links(names, "self_contact", false, context),
                None => (0..self.links.len()).collect(),
            };
            let (earlier, mistakes, mut unread) = (made.count(), context.count(), Vec::new());
            for candidate in self.candidates(&links) {
                let Some(shapes) = sphere_first(candidate.shapes) else {
                    unread.push(candidate.shapes);
                    continue;
                };
                let of_file = Some(candidate.touch.friction).filter(|friction| *friction > 0.0);
                let friction = clause.friction.clone().or(of_file.map(|friction| self.writer.number(friction)));
                let friction = friction.filter(|friction| friction.literal() != Some(0.0));
                if friction.is_some() && clause.along.is_none() {
                    refuse_friction(clause, shapes, context);
                    break;
                }
                let [first, second] = shapes.map(|shape| self.link_of(shape).map(|link| &self.links[link]));
                if let (Some(first), Some(second)) = (first, second) {
                    let between = LinkPair { links: [first, second], clause, friction };
                    made.add_pair(shapes, &between);
                }
                notes.extend(beyond(shapes[0], Some(shapes[1]), &candidate.touch));
            }
            let count = made.count() - earlier;
            notes.extend(self.told_of_pairs(count, &unread));
            if count == 0 && context.count() == mistakes {
                let why = in_brackets(&self.pairs_without_law(false));
                let text = format!(
                    "no links of the file touch each other here{why}; those that do are spheres, or a sphere and a \
                     capsule, of two links that the file lets touch and of which one moves"
                );
                context.error(clause.span, text);
            }
        }
        self.notes.extend(notes);
    }

    /// Why pairs of the file do not touch whose law is not read: those with a plane, or the others.
    pub fn pairs_without_law(&self, with_plane: bool) -> Vec<String> {
        let pairs = self.description.pairs.iter();
        let asked = pairs.filter(|pair| pair.shapes.iter().any(|own| own.shape == Shape::Plane) == with_plane);
        let told = asked.filter_map(|pair| {
            let ([a, b], why) = (pair.shapes.each_ref().map(named), pair.touch.as_ref().err()?);
            Some(format!("the pair of {a} and {b} does not touch: {why}"))
        });
        told.collect()
    }

    /// Pairs of the file, where no links touch each other.
    fn notes_of_pairs(&self) -> Vec<Note> {
        let between = |pair: &&gauss_robots::collision::Pair| pair.shapes.iter().all(|own| own.shape != Shape::Plane);
        let pairs = self.description.pairs.iter();
        let idle = pairs.clone().find(between).filter(|_| self.clauses.self_contacts.is_empty());
        let idle = idle.map(|pair| {
            let text = "pairs of shapes do not act; `self_contact(…)` lets links touch each other, `ground(…)` planes";
            Note::ignored(pair.at, "pair", text).about("pairs")
        });
        let unread = pairs.flat_map(|pair| pair.unread.iter().map(move |name| (pair.at, *name)));
        let unread = unread.map(|(at, name)| {
            Note::ignored(at, name, format!("`{name}` of pairs does not act: they touch where they meet")).about(name)
        });
        idle.into_iter().chain(unread).collect()
    }

    fn told_of_pairs(&self, count: usize, unread: &[[&Collision; 2]]) -> Vec<Note> {
        let first = self.description.collisions.first();
        let told = first.filter(|_| count > 0).map(|first| {
            let text = format!("contacts of links with one another: {count}; `links = […]` chooses some links");
            Note::told(first.at, text)
        });
        let unread = unread.first().map(|[a, b]| {
            let text = format!(
                "pairs of shapes that do not touch: {}, first {} and {}: spheres touch spheres and capsules alone",
                unread.len(),
                named(a),
                named(b)
            );
            Note::ignored(a.at, "pair", text).about("pairs")
        });
        told.into_iter().chain(unread).collect()
    }

    /// Shapes that the file lets touch: those of its pairs, then those whose bits and links permit it.
    fn candidates(&self, links: &[usize]) -> Vec<Candidate<'_>> {
        let pairs = &self.description.pairs;
        let mut all: Vec<Candidate<'_>> = Vec::new();
        for pair in pairs {
            let shapes = pair.shapes.each_ref();
            let meet = shapes.iter().all(|own| own.shape != Shape::Plane) && self.may_meet(shapes, links);
            let touch = pair.touch.as_ref().ok().filter(|_| meet).cloned();
            all.extend(touch.map(|touch| Candidate { shapes, touch }));
        }
        let shapes: Vec<&Collision> =
            self.description.collisions.iter().filter(|own| own.shape != Shape::Plane).collect();
        for (k, first) in shapes.iter().enumerate() {
            for second in &shapes[k + 1..] {
                let by_pair = pairs.iter().any(|pair| pair.is_of([first, second]));
                if by_pair || !self.may_meet([first, second], links) || self.hangs_together([first, second]) {
                    continue;
                }
                let touch = match (&first.surface, &second.surface) {
                    (Some(a), Some(b)) if !a.meets(b) || self.description.excludes([&first.link, &second.link]) => {
                        continue;
                    }
                    (Some(a), Some(b)) => a.with(b),
                    _ => Touch { friction: 0.0, turns: false },
                };
                all.push(Candidate { shapes: [first, second], touch });
            }
        }
        all
    }

    /// Whether two shapes are of chosen links that move relative to each other.
    fn may_meet(&self, shapes: [&Collision; 2], chosen: &[usize]) -> bool {
        let [Some(a), Some(b)] = shapes.map(|shape| self.link_of(shape)) else { return false };
        let owners = [a, b].map(|link| self.structure.owner_of[link]);
        chosen.contains(&a) && chosen.contains(&b) && owners[0] != owners[1] && (self.moves(a) || self.moves(b))
    }

    /// Whether one hangs on the other: such do not touch, unless a file says so, or the world is one of them.
    fn hangs_together(&self, shapes: [&Collision; 2]) -> bool {
        let [Some(a), Some(b)] = shapes.map(|shape| self.link_of(shape)) else { return false };
        let owners = [a, b].map(|link| self.structure.owner_of[link]);
        let is_world = |owner: usize| owner == self.structure.root && self.description.links[owner].name == WORLD;
        let above = owners.map(|owner| self.above(owner));
        !self.description.parents_touch
            && !owners.iter().any(|owner| is_world(*owner))
            && (above[0] == Some(owners[1]) || above[1] == Some(owners[0]))
    }

    /// The link on which another one hangs, past those that stand between the joints of one body. They are where their
    /// joints are, which move; a body whose last joint has a place of its own is mounted where it is itself.
    fn above(&self, owner: usize) -> Option<usize> {
        let Description { links, joints, .. } = self.description;
        let mut parent = self.structure.parent_of[owner]?;
        while let Some(joint) = self.structure.joint_of[parent]
            && joints[joint].kind != JointKind::Fixed
            && links[parent].at == joints[joint].at
        {
            parent = self.structure.parent_of[parent]?;
        }
        Some(self.structure.owner_of[parent])
    }
}

/// A sphere, and a sphere or a capsule; `None` of others.
fn sphere_first([a, b]: [&Collision; 2]) -> Option<[&Collision; 2]> {
    let is_sphere = |own: &Collision| matches!(own.shape, Shape::Sphere { .. });
    let is_round = |own: &Collision| is_sphere(own) || matches!(own.shape, Shape::Capsule { .. });
    match (is_sphere(a), is_sphere(b)) {
        (true, _) if is_round(b) => Some([a, b]),
        (_, true) if is_round(a) => Some([b, a]),
        _ => None,
    }
}

fn refuse_friction(clause: &SelfContact, [a, b]: [&Collision; 2], context: &mut Context) {
    let text = format!(
        "{} and {} rub, and tangents turn with their line of centers: add `along = [0, 0, 1]`, a direction that no such \
         line has, or `friction = 0`",
        named(a),
        named(b)
    );
    context.error(clause.span, text);
}

/// A shape in messages.
fn named(shape: &Collision) -> String {
    match &shape.name {
        Some(name) => format!("`{name}` of `{}`", shape.link),
        None => format!("a shape of `{}`", shape.link),
    }
}
