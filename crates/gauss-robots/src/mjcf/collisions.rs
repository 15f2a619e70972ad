//! Geoms that touch, and bodies that are kept from touching.

use roxmltree::Node;

use super::rotations::to_direction;
use super::{File, Place};
use crate::collision::{Collision, Shape, Surface};
use crate::names::unknown;
use crate::rotation::{Matrix, Rotation, Triple, multiply, turned};

const GEOM: &[&str] = &["geom"];

impl<'a> File<'a> {
    /// Reads how a geom of a link touches; one without bits touches nothing, such as one that is only seen.
    pub fn collision(&mut self, node: Node<'a, 'a>, link: &str, class: Option<&'a str>, (at, matrix): &Place) {
        self.reading.see(node);
        let surface = self.touching(node, class);
        if surface.kind == 0 && surface.affinity == 0 {
            return;
        }
        let (position, rotation, half) = self.geom_place(node, class);
        let moved = turned(matrix, &position);
        let shape = self.shape(node, class, half);
        self.description.collisions.push(Collision {
            name: self.reading.text(node, "name").filter(|name| !name.is_empty()).map(str::to_owned),
            at: self.reading.at(node),
            link: link.to_owned(),
            position: std::array::from_fn(|i| at[i] + moved[i]),
            // Without what rounding left of zeros.
            rotation: Rotation::from_matrix(&multiply(matrix, &rotation)).matrix,
            shape,
            surface: Some(surface),
        });
    }

    /// Centre and axes of a geom, and half its length where its ends say that. The third axis is from the second end
    /// to the first, as `mjCGeom::Compile` of MuJoCo's `src/user/user_objects.cc` has it.
    fn geom_place(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> (Triple, Matrix, Option<f64>) {
        if let Some([a, b, c, d, e, f]) = self.numbers(node, GEOM, "fromto", class) {
            let along: Triple = [a - d, b - e, c - f];
            let length = along.iter().map(|c| c * c).sum::<f64>().sqrt();
            let matrix = to_direction(along).unwrap_or(Rotation::none().matrix);
            return ([(a + d) / 2.0, (b + e) / 2.0, (c + f) / 2.0], matrix, Some(length / 2.0));
        }
        (self.triple(node, "geom", "pos", class), self.rotation(node, GEOM, class).matrix, None)
    }

    fn shape(&mut self, node: Node<'a, 'a>, class: Option<&'a str>, half: Option<f64>) -> Shape {
        let kind = self.text(node, GEOM, "type", class).unwrap_or("sphere");
        let size = self.list(node, GEOM, "size", class).unwrap_or_default();
        let unread = || Shape::Unread(format!("a geom of type `{kind}`"));
        if self.text(node, GEOM, "mesh", class).is_some() && kind != "mesh" {
            return Shape::Unread(format!("a geom of type `{kind}` that is fitted to a mesh"));
        }
        let size_at = |k: usize| size.get(k).copied().filter(|size| *size > 0.0);
        // Between ends a box has the first size across.
        let edges = match half {
            Some(half) => size_at(0).map(|across| [across, across, half]),
            None => size_at(0).zip(size_at(1)).zip(size_at(2)).map(|((x, y), z)| [x, y, z]),
        };
        let round = size_at(0).zip(half.or(size_at(1)));
        let shape = match kind {
            "sphere" => size_at(0).map(|radius| Shape::Sphere { radius }),
            "capsule" => round.map(|(radius, half)| Shape::Capsule { radius, half }),
            "cylinder" => round.map(|(radius, half)| Shape::Cylinder { radius, half }),
            "box" => edges.map(|half| Shape::Box { half }),
            "ellipsoid" => edges.filter(|[x, y, z]| x == y && y == z).map(|[radius, ..]| Shape::Sphere { radius }),
            "plane" => Some(Shape::Plane),
            _ => None,
        };
        shape.unwrap_or_else(unread)
    }

    fn touching(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Surface {
        let usual = Surface::default();
        let bits = |own: Option<i64>, usual: u32| own.map_or(usual, |own| own as u32);
        let kind = bits(self.whole(node, "contype", class), usual.kind);
        let affinity = bits(self.whole(node, "conaffinity", class), usual.affinity);
        let dimension = bits(self.whole(node, "condim", class), usual.dimension);
        if !matches!(dimension, 1 | 3 | 4 | 6) {
            self.reading.fault(node, format!("`condim` is 1, 3, 4 or 6, found `{dimension}`"));
        }
        let priority = self.whole(node, "priority", class).unwrap_or(usual.priority);
        let own = self.list(node, GEOM, "friction", class).unwrap_or_default();
        if own.len() > 3 || own.iter().any(|coefficient| *coefficient < 0.0) {
            self.reading.fault(node, "`friction` is three numbers at most, which are zero or more");
        }
        let friction = own.first().copied().unwrap_or(usual.friction);
        let mut unread = Vec::new();
        for name in ["margin", "gap", "adhesion", "surfacevel"] {
            let acts = self.list(node, GEOM, name, class).unwrap_or_default().iter().any(|number| *number != 0.0);
            unread.extend(acts.then_some(name));
        }
        Surface { kind, affinity, dimension, priority, friction, unread }
    }

    fn whole(&mut self, node: Node<'a, 'a>, name: &'static str, class: Option<&'a str>) -> Option<i64> {
        let [number] = self.numbers::<1>(node, GEOM, name, class)?;
        if number.fract() != 0.0 || number.abs() > f64::from(u32::MAX) {
            self.reading.fault(node, format!("`{name}` is a whole number, found `{number}`"));
            return None;
        }
        Some(number as i64)
    }

    /// `<exclude body1="…" body2="…"/>`.
    pub fn exclusions(&mut self, section: Node<'a, 'a>) {
        for node in self.reading.children(section, "exclude") {
            let ends = ["body1", "body2"].map(|name| self.reading.required(node, name));
            let strange = ends.iter().flatten().find(|name| !self.has_link(name));
            if let Some(name) = strange {
                let which = unknown("body", name, self.description.links.iter().map(|link| link.name.as_str()));
                self.reading.fault(node, format!("it is about {which}"));
            } else if let [Some(first), Some(second)] = ends {
                self.description.excluded.push([first, second]);
            }
        }
    }

    fn has_link(&self, name: &str) -> bool {
        self.description.links.iter().any(|link| link.name == name)
    }
}
