//! Geoms that touch, and bodies that are kept from touching.

use roxmltree::Node;

use super::rotations::to_direction;
use super::{File, Place};
use crate::collision::{Collision, Shape, Surface};
use crate::names::unknown;
use crate::rotation::{Matrix, Rotation, Triple, multiply, turned};
use crate::xml::own_elements;

const GEOM: &[&str] = &["geom"];

impl<'a> File<'a> {
    /// Reads how a geom of a link touches; one without bits, such as one that is only seen, touches by pairs alone.
    pub fn collision(&mut self, node: Node<'a, 'a>, link: &str, class: Option<&'a str>, (at, matrix): &Place) {
        self.reading.see(node);
        self.check_geom(node, class);
        let surface = self.touching(node, class);
        let is_hidden = surface.kind == 0 && surface.affinity == 0;
        let (position, rotation, half) = self.geom_place(node, class);
        let moved = turned(matrix, &position);
        let shape = self.shape(node, class, half);
        let all = if is_hidden { &mut self.description.hidden } else { &mut self.description.collisions };
        all.push(Collision {
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

    /// Notes mistakes that MuJoCo's compiler refuses as well.
    fn check_geom(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) {
        if self.text(node, GEOM, "fromto", class).is_some() && self.text(node, GEOM, "pos", class).is_some() {
            self.reading.fault_of_value(
                node,
                "pos",
                "`fromto` says where it is, and so does `pos`; remove one of them",
            );
        }
        let moves =
            |above: Node<'a, 'a>| own_elements(above).any(|own| matches!(own.tag_name().name(), "joint" | "freejoint"));
        if self.text(node, GEOM, "type", class) == Some("plane") && node.ancestors().skip(1).any(moves) {
            self.reading.fault_of_value(
                node,
                "type",
                "a plane has no end and no mass, so it stands in bodies that do not move; write a box",
            );
        }
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
        // Between ends a box and an ellipsoid have the first size across.
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
            "ellipsoid" => edges.map(|semi_axes| match semi_axes {
                [x, y, z] if x == y && y == z => Shape::Sphere { radius: x },
                _ => Shape::Ellipsoid { semi_axes },
            }),
            "plane" => Some(Shape::Plane),
            _ => None,
        };
        shape.unwrap_or_else(unread)
    }

    fn touching(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Surface {
        let usual = Surface::default();
        let bits = |own: Option<i64>, usual: u32| own.map_or(usual, |own| own as u32);
        let kind = bits(self.whole(node, GEOM, "contype", class), usual.kind);
        let affinity = bits(self.whole(node, GEOM, "conaffinity", class), usual.affinity);
        let dimension = bits(self.whole(node, GEOM, "condim", class), usual.dimension);
        if !matches!(dimension, 1 | 3 | 4 | 6) {
            self.reading.fault(node, format!("`condim` is 1, 3, 4 or 6, found `{dimension}`"));
        }
        let priority = self.whole(node, GEOM, "priority", class).unwrap_or(usual.priority);
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

    /// A whole number of an element, or of the defaults of its class.
    pub(super) fn whole(
        &mut self,
        node: Node<'a, 'a>,
        tags: &[&str],
        name: &'static str,
        class: Option<&'a str>,
    ) -> Option<i64> {
        let [number] = self.numbers::<1>(node, tags, name, class)?;
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

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use crate::collision::{Collision, Shape, Surface};
    use crate::description::{Description, Fault};
    use crate::mjcf::read;
    use crate::text::{Text, Written};

    fn described(inside: &str) -> Result<Description, Vec<Fault>> {
        let text = format!("<mujoco>{inside}</mujoco>");
        read(&Text::of(Written::new(String::new(), PathBuf::new(), text)))
    }

    fn body(inside: &str) -> Vec<Collision> {
        let text = format!(
            r#"<default><default class="c"><geom size="0.1 0.2 0.3" condim="1" friction="0.5"/></default></default>
            <worldbody><body name="b"><joint/>{inside}</body></worldbody>"#
        );
        described(&text).expect("a file").collisions
    }

    #[test]
    fn shapes_and_their_sizes() {
        let shape = |geom: &str| body(geom).remove(0).shape;
        assert_eq!(shape(r#"<geom size="0.2"/>"#), Shape::Sphere { radius: 0.2 });
        assert_eq!(shape(r#"<geom class="c" type="capsule"/>"#), Shape::Capsule { radius: 0.1, half: 0.2 });
        assert_eq!(shape(r#"<geom class="c" type="cylinder"/>"#), Shape::Cylinder { radius: 0.1, half: 0.2 });
        assert_eq!(shape(r#"<geom class="c" type="box"/>"#), Shape::Box { half: [0.1, 0.2, 0.3] });
        assert_eq!(shape(r#"<geom type="ellipsoid" size="1 1 1"/>"#), Shape::Sphere { radius: 1.0 });
        // Between ends a box is as wide as deep.
        let ends = r#"<geom class="c" type="box" fromto="0 0 0 0 0 -1"/>"#;
        assert_eq!(shape(ends), Shape::Box { half: [0.1, 0.1, 0.5] });
        assert_eq!(shape(r#"<geom class="c" type="ellipsoid"/>"#), Shape::Ellipsoid { semi_axes: [0.1, 0.2, 0.3] });
        let ends = r#"<geom class="c" type="ellipsoid" fromto="0 0 0 0 0 -1"/>"#;
        assert_eq!(shape(ends), Shape::Ellipsoid { semi_axes: [0.1, 0.1, 0.5] });
        for (geom, what) in [
            (r#"<geom type="ellipsoid" size="0.1 0.2"/>"#, "a geom of type `ellipsoid`"),
            (r#"<geom type="capsule" size="0.1"/>"#, "a geom of type `capsule`"),
            (r#"<geom type="hfield" hfield="h"/>"#, "a geom of type `hfield`"),
        ] {
            assert_eq!(shape(geom), Shape::Unread(what.to_owned()), "{geom}");
        }
    }

    /// In frames, between ends, with the third axis from the second end to the first.
    #[test]
    fn places_of_shapes() {
        let found = body(r#"<frame pos="1 0 0" euler="0 90 0"><geom size="0.2" pos="0 0 2"/></frame>"#);
        assert_eq!((found[0].position, found[0].link.as_str()), ([3.0, 0.0, 0.0], "b"));
        let capsule = body(r#"<geom name="g" type="capsule" size="0.1" fromto="0 0 0 2 0 0"/>"#).remove(0);
        assert_eq!((capsule.position, capsule.name), ([1.0, 0.0, 0.0], Some("g".to_owned())));
        assert_eq!(capsule.rotation.map(|row| row[2]), [-1.0, 0.0, 0.0]);
        assert_eq!(capsule.shape, Shape::Capsule { radius: 0.1, half: 1.0 });
    }

    /// MuJoCo 4.0: "both pos and fromto defined in geom", "plane only allowed in static bodies".
    #[test]
    fn geoms_that_mujoco_refuses_too() {
        let plane = r#"<geom type="plane" size="1 1 1"/>"#;
        let (two, moving) = ("`fromto` says where it is, and so does `pos`", "a plane has no end and no mass");
        let default = r#"<default><default class="c"><geom pos="0 1 0"/></default></default>"#;
        for (before, inside, told) in [
            ("", r#"<body><joint/><geom size="1" fromto="0 0 0 0 0 1" pos="1 0 0"/></body>"#.to_owned(), Some(two)),
            (default, r#"<body><joint/><geom size="1" fromto="0 0 0 0 0 1" class="c"/></body>"#.to_owned(), Some(two)),
            ("", r#"<body><joint/><geom size="1" fromto="0 0 0 0 0 1" euler="1 0 0"/></body>"#.to_owned(), None),
            ("", format!(r#"<body><freejoint/><geom size="1"/>{plane}</body>"#), Some(moving)),
            ("", format!(r#"<body><joint/><geom size="1"/><body>{plane}</body></body>"#), Some(moving)),
            ("", format!(r#"<body><joint/><geom size="1"/></body><body>{plane}</body>{plane}"#), None),
        ] {
            let faults = described(&format!("{before}<worldbody>{inside}</worldbody>")).err().unwrap_or_default();
            let found: Vec<&str> = faults.iter().map(|fault| &*fault.message).collect();
            match told {
                Some(told) => assert!(found.len() == 1 && found[0].contains(told), "{inside}: {found:?}"),
                None => assert!(found.is_empty(), "{inside}: {found:?}"),
            }
        }
    }

    #[test]
    fn surfaces() {
        let surface = |geom: &str| body(geom).remove(0).surface;
        let usual = Surface::default();
        assert_eq!((usual.kind, usual.affinity, usual.dimension, usual.friction), (1, 1, 3, 1.0));
        assert_eq!(surface(r#"<geom size="1"/>"#), Some(usual.clone()));
        let said = r#"<geom class="c" contype="4" conaffinity="0" priority="-2" margin="0.01" gap="0"/>"#;
        let expected =
            Surface { kind: 4, affinity: 0, dimension: 1, priority: -2, friction: 0.5, unread: vec!["margin"] };
        assert_eq!(surface(said), Some(expected));
        // All bits, as MuJoCo has them.
        assert_eq!(surface(r#"<geom size="1" contype="-1"/>"#).unwrap().kind, u32::MAX);
        // What is only seen touches nothing.
        assert!(body(r#"<geom size="1" contype="0" conaffinity="0"/>"#).is_empty());
        let off = r#"<option><flag contact="disable"/></option><worldbody><geom size="1"/></worldbody>"#;
        assert!(described(off).unwrap().collisions.is_empty());
    }

    #[test]
    fn exclusions() {
        let world = r#"<worldbody><body name="a"><joint/><geom size="1"/></body></worldbody>"#;
        let with = |pair: &str| described(&format!("{world}<contact><exclude {pair}/></contact>"));
        let read = with(r#"body1="a" body2="world""#).unwrap();
        assert!(read.excludes(["world", "a"]) && read.excludes(["a", "world"]) && !read.excludes(["a", "a"]));
        let message = |pair: &str| with(pair).unwrap_err()[0].message.clone();
        assert_eq!(
            message(r#"body1="a" body2="b""#),
            "<exclude>: it is about `b`, which is no body; did you mean `a`?"
        );
        assert_eq!(message(r#"body1="a""#), "<exclude>: the attribute `body2` is missing");
    }

    /// Copies have exclusions of their own.
    #[test]
    fn exclusions_of_copies() {
        let text = r#"<mujoco><worldbody><replicate count="2"><body name="a"><joint/><geom size="1"/></body></replicate>
            </worldbody><contact><exclude body1="a" body2="world"/></contact></mujoco>"#;
        let (text, faults) = crate::mjcf::included(Written::new(String::new(), PathBuf::new(), text.to_owned()));
        assert!(faults.is_empty(), "{faults:?}");
        let read = read(&text).unwrap();
        assert!(read.excludes(["world", "a0"]) && read.excludes(["world", "a1"]), "{:?}", read.excluded);
    }

    #[test]
    fn what_is_refused() {
        let message = |geom: &str| {
            let text = format!("<worldbody><body name=\"b\"><joint/><geom size=\"1\" {geom}/></body></worldbody>");
            described(&text).unwrap_err()[0].message.clone()
        };
        assert_eq!(message("condim=\"2\""), "<geom>: `condim` is 1, 3, 4 or 6, found `2`");
        assert_eq!(message("contype=\"0.5\""), "<geom>: `contype` is a whole number, found `0.5`");
        assert_eq!(message("friction=\"-1\""), "<geom>: `friction` is three numbers at most, which are zero or more");
    }
}
