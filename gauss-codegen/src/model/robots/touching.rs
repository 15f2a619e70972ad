//! A shape against a plane → contacts, and the points that they are of.

use std::collections::HashSet;
use std::f64::consts::TAU;

use proc_macro2::Ident;
use syn::ext::IdentExt;

use super::constant_heights::LinkStates;
use super::joints::ExpressionWriter;
use super::names::{self, RobotNames};
use crate::model::language::ground::Ground;
use crate::model::language::self_contact::SelfContact;
use crate::model::language::words::UNNAMED;
use crate::model::names::naming::is_reserved;
use crate::model::scene::clauses::{BodyClause, PointClause};
use crate::model::scene::contacts::{ContactClause, ContactGeometry, Copies, Counterpart, PointContact};
use crate::model::scene::expression::{Expression, Property};
use gauss_robots::collision::{Collision, Shape, Touch};
use gauss_robots::rotation::{Matrix, Rotation, Triple, sine_and_cosine, turned};

/// Clauses as they are made, with the names that are taken.
pub struct ContactClauses {
    pub points: Vec<PointClause>,
    /// Frames of shapes that need axes of their own.
    pub frames: Vec<BodyClause>,
    pub contacts: Vec<ContactClause>,
    /// Names of contacts.
    taken: HashSet<String>,
    /// Prefixes of contact names, one for each shape.
    shapes: HashSet<String>,
    /// Names of all that expressions name.
    names: RobotNames,
    writer: ExpressionWriter,
}

/// Points at which a shape touches.
enum TouchingPoints {
    /// At points, each of them the centre of a sphere.
    Spheres(Vec<Triple>, f64),
    /// The two of a capsule.
    Ends([Triple; 2], f64),
    /// The corners of a box along the axes of its link.
    Corners(Triple, Triple),
    /// Rims of a radius about an axis, with their distance.
    Rims(Triple, f64, Triple, f64),
    /// At the lowest point of an ellipsoid; its axes, where they are not those of the link.
    Ellipsoid(Triple, Option<Matrix>, Triple),
}

/// Two links that touch, and how.
pub struct LinkPair<'a> {
    pub links: [&'a Ident; 2],
    pub clause: &'a SelfContact,
    pub friction: Option<Expression>,
}

impl ContactClauses {
    /// Contacts are not to have the names of those that are `taken`.
    pub fn new(names: RobotNames, taken: impl IntoIterator<Item = Ident>, writer: ExpressionWriter) -> Self {
        let (points, frames, contacts) = (Vec::new(), Vec::new(), Vec::new());
        let taken = taken.into_iter().map(|name| name.unraw().to_string()).collect();
        Self { points, frames, contacts, taken, shapes: HashSet::new(), names, writer }
    }

    /// Number of the contacts.
    pub fn count(&self) -> usize {
        self.contacts.iter().map(|clause| clause.names.len()).sum()
    }

    /// Contacts of one shape of a link with one plane; whether all of it, or points of it, stay clear of that.
    pub fn add(
        &mut self,
        (collision, link): (&Collision, &Ident),
        (against, seen): (&Counterpart, Option<&LinkStates>),
        ground: &Ground,
        touch: &Touch,
    ) -> bool {
        let writer = self.writer;
        let called = collision.name.as_ref().unwrap_or(&collision.link);
        let size = |length: f64| (length != 0.0).then(|| writer.number(length));
        let Some(form) = form(collision, ground.points) else { return false };
        let (form, is_clear) = without_clear(form, collision, seen);
        let Some(form) = form else { return true };
        let mut contacts: Vec<(Vec<Ident>, PointContact)> = Vec::new();
        match form {
            TouchingPoints::Spheres(centers, radius) => {
                let names = self.named(called, centers.len());
                for (center, name) in centers.into_iter().zip(names) {
                    let point = self.point(link, &name, center);
                    let contact = self.contact(point, size(radius), against);
                    contacts.push((vec![name], contact));
                }
            }
            TouchingPoints::Ends([first, last], radius) => {
                let names = self.named(called, 2);
                let (point, end) = (self.point(link, &names[0], first), self.point(link, &names[1], last));
                let contact = self.contact(point, size(radius), against);
                contacts.push((names, PointContact { copies: Copies::Ends(end), ..contact }));
            }
            TouchingPoints::Corners(center, edges) => {
                let copies = Copies::Corners(edges.map(|edge| writer.number(edge)));
                let names = self.named(called, copies.count());
                let point = self.point(link, &names[0], center);
                contacts.push((names, PointContact { copies, ..self.contact(point, None, against) }));
            }
            TouchingPoints::Rims(center, radius, axis, length) => {
                let copies = if length == 0.0 { Copies::One } else { Copies::Rims(writer.number(length)) };
                let names = self.named(called, copies.count());
                let point = self.point(link, &names[0], center);
                let rim = Some([writer.number(radius), writer.vector(axis.map(|c| writer.number(c)))]);
                contacts.push((names, PointContact { copies, rim, ..self.contact(point, None, against) }));
            }
            TouchingPoints::Ellipsoid(center, axes, semi_axes) => {
                let names = self.named(called, 1);
                let point = match axes {
                    Some(axes) => self.frame(link, &names[0], center, &axes),
                    None => self.point(link, &names[0], center),
                };
                let semi_axes = Some(semi_axes.map(|length| writer.number(length)));
                contacts.push((names, PointContact { semi_axes, ..self.contact(point, None, against) }));
            }
        }
        let friction = match ground.friction.as_slice() {
            [] => size(touch.friction).into_iter().collect(),
            own => own.to_vec(),
        };
        let clause = |(names, contact)| of_ground(names, contact, friction.clone(), ground, link);
        self.contacts.extend(contacts.into_iter().map(clause));
        is_clear
    }

    /// A contact of a sphere with a sphere or a capsule.
    pub fn add_pair(&mut self, shapes: [&Collision; 2], between: &LinkPair<'_>) {
        let writer = self.writer;
        let [first, second] = shapes.map(|shape| shape.name.as_ref().unwrap_or(&shape.link));
        let Some(name) = self.named(&format!("{first}_{second}"), 1).pop() else { return };
        let [own, other] = between.links;
        let Some(TouchingPoints::Spheres(centers, radius)) = form(shapes[0], None) else { return };
        let mut place = |link: &Ident, end: &str, at: Triple| self.point_called(link, &format!("{name}_{end}"), at);
        let point = place(own, "point", centers[0]);
        let (center, end, other_radius) = match form(shapes[1], None) {
            Some(TouchingPoints::Spheres(centers, radius)) => (place(other, "other", centers[0]), None, radius),
            Some(TouchingPoints::Ends([first, last], radius)) => {
                (place(other, "other", first), Some(place(other, "other_end", last)), radius)
            }
            _ => return,
        };
        let along = between.clause.along.clone().filter(|_| between.friction.is_some());
        let against = Counterpart::Sphere { center, end, radius: Some(writer.number(other_radius)), along };
        let contact = self.contact(point, Some(writer.number(radius)), &against);
        self.contacts.push(ContactClause {
            names: vec![name],
            touching: ContactGeometry::Point(Box::new(contact)),
            friction: between.friction.clone().into_iter().collect(),
            restitution: between.clause.restitution.clone(),
            drilling: None,
            rolling: None,
            of_file: true,
            links: between.links.map(|link| Some(link.clone())),
        });
    }

    fn contact(&self, point: Expression, radius: Option<Expression>, against: &Counterpart) -> PointContact {
        PointContact { point, radius, rim: None, semi_axes: None, copies: Copies::One, against: against.clone() }
    }

    /// A point of a link: its origin, or one with the name of the contact and `_point`.
    fn point(&mut self, link: &Ident, contact: &Ident, at: Triple) -> Expression {
        self.point_called(link, &format!("{contact}_point"), at)
    }

    fn point_called(&mut self, link: &Ident, called: &str, at: Triple) -> Expression {
        let writer = self.writer;
        let Some(at) = writer.triple(&at) else { return writer.property(link, Property::Position) };
        let name = self.names.chosen(called);
        let expression = writer.name(&name);
        self.points.push(PointClause { name, body: link.clone(), at, span: writer.span });
        expression
    }

    /// The origin of a frame of a link, with the name of the contact and `_frame`.
    fn frame(&mut self, link: &Ident, contact: &Ident, at: Triple, axes: &Matrix) -> Expression {
        let writer = self.writer;
        let name = self.names.chosen(&format!("{contact}_frame"));
        let expression = writer.property(&name, Property::Position);
        self.frames.push(BodyClause {
            name: Some(name),
            massless: true,
            parent: Some(link.clone()),
            position: writer.triple(&at),
            rotation: writer.rotation(&Rotation::from_matrix(axes)),
            role_clauses: Vec::new(),
            span: writer.span,
        });
        expression
    }

    /// Names of the contacts of one shape: its own, or with numbers from zero; what is taken gets a number before.
    fn named(&mut self, called: &str, count: usize) -> Vec<Ident> {
        let word = names::free(called, "contact", |word| word != UNNAMED && !is_reserved(word));
        let all = |word: &String| match count {
            1 => vec![word.clone()],
            _ => (0..count).map(|k| format!("{word}_{k}")).collect(),
        };
        let is_free =
            |word: &String| !self.shapes.contains(word) && all(word).iter().all(|name| !self.taken.contains(name));
        let numbered = (2..).map(|n| format!("{word}_{n}"));
        let chosen = [word.clone()].into_iter().chain(numbered).find(is_free).unwrap_or_default();
        let names = all(&chosen);
        self.taken.extend(names.iter().cloned());
        self.shapes.insert(chosen);
        names.iter().map(|name| Ident::new(name, self.writer.span)).collect()
    }
}

/// A contact of a link with a ground.
fn of_ground(
    names: Vec<Ident>,
    contact: PointContact,
    friction: Vec<Expression>,
    ground: &Ground,
    link: &Ident,
) -> ContactClause {
    ContactClause {
        names,
        touching: ContactGeometry::Point(Box::new(contact)),
        friction,
        restitution: ground.restitution.clone(),
        drilling: None,
        rolling: None,
        of_file: true,
        links: [Some(link.clone()), None],
    }
}

/// Points at which a shape touches, without those that stay clear of a plane, and whether some do.
fn without_clear(
    form: TouchingPoints,
    collision: &Collision,
    seen: Option<&LinkStates>,
) -> (Option<TouchingPoints>, bool) {
    let Some(seen) = seen else { return (Some(form), false) };
    let (points, radius) = match &form {
        TouchingPoints::Spheres(points, radius) => (points.clone(), *radius),
        TouchingPoints::Ends(ends, radius) => (ends.to_vec(), *radius),
        TouchingPoints::Corners(center, edges) => {
            let corners = corners(edges.map(|edge| edge / 2.0)).into_iter();
            (corners.map(|corner| std::array::from_fn(|i| center[i] + corner[i])).collect(), 0.0)
        }
        TouchingPoints::Rims(..) | TouchingPoints::Ellipsoid(..) if seen.is_round_and_clear(collision) => {
            return (None, true);
        }
        TouchingPoints::Rims(..) | TouchingPoints::Ellipsoid(..) => return (Some(form), false),
    };
    let left: Vec<Triple> = points.iter().copied().filter(|point| !seen.is_clear(point, radius)).collect();
    match left.len() {
        count if count == points.len() => (Some(form), false),
        0 => (None, true),
        _ => (Some(TouchingPoints::Spheres(left, radius)), true),
    }
}

/// Points at which a shape touches; rims by some points, if so many are given.
fn form(collision: &Collision, points: Option<u32>) -> Option<TouchingPoints> {
    let center = collision.position;
    let placed = |own: Triple| -> Triple {
        let moved = turned(&collision.rotation, &own);
        std::array::from_fn(|i| center[i] + moved[i])
    };
    let ends = |half: f64, radius: f64| match half {
        0.0 => TouchingPoints::Spheres(vec![center], radius),
        _ => TouchingPoints::Ends([placed([0.0, 0.0, -half]), placed([0.0, 0.0, half])], radius),
    };
    let is_along = collision.rotation == Rotation::none().matrix;
    Some(match collision.shape {
        Shape::Sphere { radius } => TouchingPoints::Spheres(vec![center], radius),
        Shape::Capsule { radius, half } => ends(half, radius),
        Shape::Cylinder { radius: 0.0, half } => ends(half, 0.0),
        Shape::Cylinder { radius, half } => match points {
            Some(points) => TouchingPoints::Spheres(rims(radius, half, points).into_iter().map(placed).collect(), 0.0),
            None => TouchingPoints::Rims(center, radius, collision.rotation.map(|row| row[2]), 2.0 * half),
        },
        Shape::Box { half } if is_along => TouchingPoints::Corners(center, half.map(|half| 2.0 * half)),
        Shape::Box { half } => TouchingPoints::Spheres(corners(half).into_iter().map(placed).collect(), 0.0),
        Shape::Ellipsoid { semi_axes } => {
            TouchingPoints::Ellipsoid(center, (!is_along).then_some(collision.rotation), semi_axes)
        }
        Shape::Plane | Shape::Unread(_) => return None,
    })
}

/// The corners of a box, in the order of those of `edges = …`.
fn corners(half: Triple) -> Vec<Triple> {
    let mut all = vec![[0.0; 3]];
    for (k, half) in half.into_iter().enumerate().filter(|(_, half)| *half != 0.0) {
        let moved = |corner: &Triple, by: f64| std::array::from_fn(|i| if i == k { by } else { corner[i] });
        all = [-half, half].into_iter().flat_map(|by| all.iter().map(move |corner| moved(corner, by))).collect();
    }
    all
}

/// Points of the rims of a cylinder, the lower first.
fn rims(radius: f64, half: f64, points: u32) -> Vec<Triple> {
    let ends = if half == 0.0 { vec![0.0] } else { vec![-half, half] };
    let around = |z: f64| {
        (0..points).map(move |k| {
            let [sine, cosine] = sine_and_cosine(TAU * f64::from(k) / f64::from(points));
            [radius * cosine, radius * sine, z]
        })
    };
    ends.into_iter().flat_map(around).collect()
}

#[cfg(test)]
mod tests {
    use super::{corners, rims};

    #[test]
    fn corners_count_as_bits_do() {
        let all = corners([1.0, 2.0, 3.0]);
        let side = |number: usize, bit: usize| if number >> bit & 1 == 0 { -1.0 } else { 1.0 };
        for (number, corner) in all.iter().enumerate() {
            let expected = [0, 1, 2].map(|bit| side(number, bit) * [1.0, 2.0, 3.0][bit]);
            assert_eq!(*corner, expected, "{number}");
        }
        assert_eq!(corners([1.0, 0.0, 3.0]).len(), 4);
    }

    #[test]
    fn points_of_rims() {
        let all = rims(2.0, 3.0, 4);
        assert_eq!(all[..2], [[2.0, 0.0, -3.0], [0.0, 2.0, -3.0]]);
        assert_eq!((all.len(), all[7], rims(1.0, 0.0, 5).len()), (8, [0.0, -2.0, 3.0], 5));
    }
}
