//! The ground: planes of the struct, or of the file, and the links that touch them.

use proc_macro2::Ident;

use super::clauses::Robot;
use super::constant_heights::LevelPlane;
use super::touching::ContactClauses;
use crate::model::language::context::Context;
use crate::model::language::ground::Ground;
use crate::model::scene::contacts::Counterpart;
use crate::model::scene::expression::{Expression, ExpressionKind};
use gauss_robots::collision::{Collision, Shape, Surface, Touch};
use gauss_robots::description::{At, Description, Note};
use gauss_robots::rotation::{Triple, direction, turned};
use gauss_robots::unknown;

/// Name of the body that holds all bodies of an MJCF file.
pub const WORLD: &str = "world";

/// A plane, with the shape of the file that it is.
struct Plane<'a> {
    against: Counterpart,
    /// Level of the plane, if numbers say it.
    level: Option<LevelPlane>,
    of: Option<&'a Collision>,
}

impl Robot<'_> {
    /// Contacts of links with planes, as far as they are asked for.
    pub fn touching(&mut self, context: &mut Context) -> ContactClauses {
        let of_joints = self.ranges().into_iter().chain(self.dry_friction()).flat_map(|clause| clause.names);
        let mut made = ContactClauses::new(self.names.clone(), of_joints, self.writer);
        let mut notes = self.notes_of_surfaces();
        notes.extend(self.notes_of_shapes());
        for ground in &self.clauses.grounds {
            let links = self.links_on(ground, context);
            let planes = self.planes(ground);
            let (earlier, mut own, mut clear) = (made.count(), Vec::new(), Vec::new());
            for collision in self.shapes() {
                let Some(link) = self.link_of(collision).filter(|link| links.contains(link)) else { continue };
                for plane in &planes {
                    let Some(touch) = touch(collision, plane.of, self.description) else { continue };
                    match &collision.shape {
                        Shape::Plane => own.push(unread(collision, "a plane of a link that moves")),
                        Shape::Unread(what) => own.push(unread(collision, what)),
                        _ => {
                            let seen = plane.level.and_then(|level| self.seen(link, level));
                            let (what, against) = ((collision, &self.links[link]), (&plane.against, seen.as_ref()));
                            clear.extend(made.add(what, against, ground, &touch).then_some(collision));
                            own.extend(beyond(collision, plane.of, &touch));
                        }
                    }
                }
            }
            own.extend(self.steps(ground));
            own.extend(clear.first().map(|first| told_of_clear(first, clear.len())));
            own.dedup();
            match made.count() - earlier {
                0 => self.refuse_idle(ground, &own, context),
                count => notes.extend(self.told(count)),
            }
            notes.extend(own);
        }
        self.notes.extend(notes);
        self.touching_each_other(&mut made, context);
        made
    }

    /// Surfaces that stick or move by themselves.
    fn notes_of_surfaces(&self) -> Vec<Note> {
        let surfaces = self.description.collisions.iter().filter_map(|own| Some((own.at, own.surface.as_ref()?)));
        let driving = surfaces.flat_map(|(at, surface)| surface.unread.iter().map(move |name| (at, *name)));
        driving.filter(|(_, name)| DRIVING.contains(name)).map(|(at, name)| unread_attribute(at, name)).collect()
    }

    /// Notes that shapes touch nothing, where nothing is said of them.
    fn notes_of_shapes(&self) -> Vec<Note> {
        let mut shapes = self.description.collisions.iter().filter(|collision| {
            collision.shape != Shape::Plane && self.link_of(collision).is_some_and(|link| self.moves(link))
        });
        let is_idle = self.clauses.grounds.is_empty() && self.clauses.self_contacts.is_empty();
        let first = shapes.next().filter(|_| is_idle);
        let text = |count: usize| {
            format!(
                "shapes that touch nothing: {count}; `ground(…)` lets them touch a plane, `self_contact(…)` each other"
            )
        };
        first.map(|first| Note::told(first.at, text(1 + shapes.count()))).into_iter().collect()
    }

    /// Shapes of the file that touch, and those that pairs alone let touch.
    fn shapes(&self) -> impl Iterator<Item = &Collision> {
        let in_pair = |own: &&Collision| {
            let is_own = |shape: &Collision| shape.at == own.at && shape.link == own.link;
            self.description.pairs.iter().any(|pair| pair.shapes.iter().any(is_own))
        };
        self.description.collisions.iter().chain(self.description.hidden.iter().filter(in_pair))
    }

    fn told(&self, count: usize) -> Option<Note> {
        let first = self.description.collisions.first()?;
        let text = format!("contacts with the ground: {count}; `links = […]` chooses those of some links");
        Some(Note::told(first.at, text))
    }

    pub fn link_of(&self, collision: &Collision) -> Option<usize> {
        self.description.links.iter().position(|link| link.name == collision.link)
    }

    /// Links that a ground names, or all that move.
    fn links_on(&self, ground: &Ground, context: &mut Context) -> Vec<usize> {
        match &ground.links {
            Some(names) => self.named_links(names, "ground", true, context),
            None => (0..self.links.len()).filter(|link| self.moves(*link)).collect(),
        }
    }

    /// Links by their names, in a clause that is about links with shapes, perhaps those that move alone.
    pub fn named_links(&self, names: &[Ident], clause: &str, moving: bool, context: &mut Context) -> Vec<usize> {
        let mut chosen = Vec::new();
        for name in names {
            let Some(link) = self.links.iter().position(|link| link == name) else {
                let word = name.to_string();
                let known: Vec<String> = self.links.iter().map(Ident::to_string).collect();
                let renamed = self.renamed_links().into_iter().find(|(name, _)| *name == word);
                let which = match renamed {
                    Some((_, called)) => format!("`{word}`; this link of the file is called `{called}`"),
                    None => unknown("link", &word, known.iter().map(String::as_str)),
                };
                context.error(name.span(), format!("`{clause}` is touched by {which}"));
                continue;
            };
            let has_shape = self.shapes().any(|collision| self.link_of(collision) == Some(link));
            if chosen.contains(&link) {
                context.error(name.span(), format!("`{name}` is named twice; remove one of the two"));
            } else if moving && !self.moves(link) {
                context.error(name.span(), format!("the link `{name}` does not move; remove it"));
            } else if !has_shape {
                context.error(
                    name.span(),
                    format!(
                        "the link `{name}` has no shape that touches; remove it, or write `contact(…)` of a point of it"
                    ),
                );
            }
            chosen.push(link);
        }
        chosen
    }

    /// The plane that a ground says, those of the file, or that through Ω.
    fn planes(&self, ground: &Ground) -> Vec<Plane<'_>> {
        let writer = self.writer;
        let plane = |normal, height| Counterpart::Plane { normal, height, along: ground.along.clone() };
        let own = || {
            let against = plane(ground.normal.clone(), ground.height.clone());
            vec![Plane { against, level: level(ground), of: None }]
        };
        if ground.normal.is_some() || ground.height.is_some() {
            return own();
        }
        let fixed = self.shapes().filter_map(|collision| {
            let link = self.link_of(collision).filter(|link| !self.moves(*link))?;
            if collision.shape != Shape::Plane {
                return None;
            }
            let (at, matrix) = self.structure.at_rest(self.description, link);
            let moved = turned(&matrix, &collision.position);
            let place: Triple = std::array::from_fn(|i| at[i] + moved[i]);
            let normal = turned(&matrix, &collision.rotation.map(|row| row[2]));
            let height: f64 = (0..3).map(|i| normal[i] * place[i]).sum();
            let level = Some(LevelPlane { normal, height });
            let is_flat = normal == [0.0, 0.0, 1.0];
            let height = (height != 0.0).then(|| writer.number(height));
            let normal = writer.triple(&normal).filter(|_| !is_flat);
            Some(Plane { against: plane(normal, height), level, of: Some(collision) })
        });
        let fixed: Vec<_> = fixed.collect();
        if fixed.is_empty() { own() } else { fixed }
    }

    /// Shapes of the world that are no planes, where its planes are asked for, and links do not touch such shapes.
    fn steps(&self, ground: &Ground) -> Vec<Note> {
        if ground.normal.is_some() || ground.height.is_some() || !self.clauses.self_contacts.is_empty() {
            return Vec::new();
        }
        let is_step = |collision: &&Collision| {
            let of_world = collision.surface.is_some() && self.link_of(collision) == Some(self.structure.root);
            of_world && !self.moves(self.structure.root) && collision.shape != Shape::Plane
        };
        let steps = self.description.collisions.iter().filter(is_step);
        steps.map(|collision| unread(collision, "a shape of the world that is no plane")).collect()
    }

    fn refuse_idle(&self, ground: &Ground, notes: &[Note], context: &mut Context) {
        let mut why = self.pairs_without_law(true);
        why.extend(notes.iter().map(|note| note.text.clone()));
        context.error(
            ground.span,
            format!(
                "nothing of the file touches this ground{}; a link that moves needs a sphere, box, capsule, cylinder \
                 or ellipsoid, or write `contact(…)` of your own points",
                in_brackets(&why)
            ),
        );
    }
}

/// The plane that a clause says by numbers, or that through Ω.
fn level(ground: &Ground) -> Option<LevelPlane> {
    let written = match ground.normal.as_ref().map(|normal| &normal.kind) {
        None => Some([0.0, 0.0, 1.0]),
        Some(ExpressionKind::Vector(entries)) => {
            let [x, y, z] = entries.each_ref().map(|entry| entry.literal());
            Some([x?, y?, z?])
        }
        Some(_) => None,
    };
    let height = ground.height.as_ref().map_or(Some(0.0), Expression::literal)?;
    Some(LevelPlane { normal: direction(written?)?, height })
}

fn told_of_clear(first: &Collision, count: usize) -> Note {
    let text = format!(
        "shapes of which points stay clear of the ground, whatever moves, and make no contacts: {count}, first of `{}`",
        first.link
    );
    Note::told(first.at, text)
}

/// Law by which a shape touches a plane, or one that says nothing: `None` if the file keeps them from touching.
fn touch(collision: &Collision, plane: Option<&Collision>, description: &Description) -> Option<Touch> {
    let Some(own) = &collision.surface else { return Some(Touch { friction: 0.0, turns: false }) };
    let pairs = || description.pairs.iter();
    if let Some(pair) = plane.and_then(|plane| pairs().find(|pair| pair.is_of([collision, plane]))) {
        return pair.touch.clone().ok();
    }
    let link = plane.map_or(WORLD, |plane| plane.link.as_str());
    let of_plane = plane.and_then(|plane| plane.surface.as_ref());
    let meets = own.meets(of_plane.unwrap_or(&Surface::default()));
    let meets = meets && !description.excludes([&collision.link, link]);
    meets.then(|| of_plane.map_or_else(|| own.alone(), |plane| own.with(plane)))
}

/// Reasons in a message: three, at most.
pub fn in_brackets(reasons: &[String]) -> String {
    if reasons.is_empty() { String::new() } else { format!(" ({})", reasons[..reasons.len().min(3)].join("; ")) }
}

/// The word by which `ignore(…)` knows it.
fn word(collision: &Collision) -> &'static str {
    if collision.surface.is_some() { "geom" } else { "collision" }
}

fn unread(collision: &Collision, what: &str) -> Note {
    let name = collision.name.as_ref().map(|name| format!(" `{name}`")).unwrap_or_default();
    let text = format!("the {}{name} of `{}` does not touch: it is {what}", word(collision), collision.link);
    Note::ignored(collision.at, word(collision), text).about("shapes")
}

/// Notes on parts of a contact in the file that are not modelled.
pub fn beyond(collision: &Collision, plane: Option<&Collision>, touch: &Touch) -> Vec<Note> {
    let turns = touch.turns.then(|| {
        let text = "there is no friction of turning and rolling (`condim` 4 and 6)";
        Note::ignored(collision.at, "condim", text).about("condim")
    });
    let surfaces = [Some(collision), plane].into_iter().flatten();
    let names = surfaces.flat_map(|own| own.surface.iter().map(move |surface| (own, surface)));
    let attributes = names.flat_map(|(own, surface)| surface.unread.iter().map(move |name| (own.at, *name)));
    let attributes = attributes.filter(|(_, name)| !DRIVING.contains(name));
    turns.into_iter().chain(attributes.map(|(at, name)| unread_attribute(at, name))).collect()
}

/// Attributes that move what touches, of which a file without contacts is told as well.
const DRIVING: [&str; 2] = ["adhesion", "surfacevel"];

fn unread_attribute(at: At, name: &'static str) -> Note {
    Note::ignored(at, name, format!("`{name}` of geoms does not act: they touch where they meet")).about(name)
}
