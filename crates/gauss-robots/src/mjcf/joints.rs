//! The joints of a body.

use std::f64::consts::PI;

use roxmltree::Node;

use super::{File, WORLD};
use crate::description::{Joint, JointKind, Nonlinear};
use crate::rotation::{Matrix, Rotation, Triple, direction, turned};
use crate::xml::shown;

const JOINT: &[&str] = &["joint"];

impl<'a> File<'a> {
    /// The joints of a body, in their order.
    pub fn joints(
        &mut self,
        node: Node<'a, 'a>,
        name: &str,
        parent: &str,
        (mut position, mut rotation): (Triple, Rotation),
        class: Option<&'a str>,
    ) {
        let all = self.framed(node, class, &["joint", "freejoint"]);
        let mut parent = parent.to_owned();
        for (index, (element, class, place)) in all.iter().enumerate() {
            let (element, class) = (*element, *class);
            self.reading.see(element);
            let own = match self.reading.text(element, "name") {
                Some(own) => own.to_owned(),
                None if all.len() == 1 => format!("{name}_joint"),
                None => format!("{name}_joint_{}", index + 1),
            };
            let is_free = element.tag_name().name() == "freejoint";
            if is_free || self.text(element, JOINT, "type", class) == Some("free") {
                // Its pose is that in the world, whatever frames it stands in.
                if parent != WORLD {
                    self.reading.fault(element, "a body that moves freely hangs in the world, not on another body");
                }
                self.hang(element, own, (&parent, name), JointKind::Floating, ([0.0; 3], Rotation::none()));
                // `<freejoint>` has no defaults.
                let laws = if is_free { None } else { Some(self.laws_of_group(element, class)) };
                let (damping, armature, stiffness) = laws.unwrap_or_default();
                if let Some(joint) = self.description.joints.last_mut() {
                    *joint = Joint { start: (position, rotation), damping, armature, stiffness, ..joint.clone() };
                }
                return;
            }
            let anchor = self.triple(element, "joint", "pos", class);
            let (origin, axes) = place;
            let turned_anchor = turned(axes, &anchor);
            let anchor: Triple = std::array::from_fn(|i| origin[i] + turned_anchor[i]);
            let moved = turned(&rotation.matrix, &anchor);
            position = std::array::from_fn(|i| position[i] + moved[i]);
            let last = index + 1 == all.len() && anchor == [0.0; 3];
            let child = if last { name.to_owned() } else { format!("{own}_frame") };
            if !last {
                self.link(child.clone(), element, None);
            }
            self.joint(element, own, (&parent, &child), ((position, rotation), axes), class);
            (parent, position, rotation) = (child, anchor.map(|c| -c), Rotation::none());
        }
        if parent != name {
            self.hang(node, format!("{name} mount"), (&parent, name), JointKind::Fixed, (position, rotation));
        }
    }

    /// Damping, armature and stiffness of a joint with several speeds, and what it has not.
    fn laws_of_group(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> (f64, f64, f64) {
        let (stiffness, damping, nonlinear) = self.springs_of(node, JOINT, class);
        if nonlinear != Nonlinear::default() {
            let text = format!(
                "of `stiffness` and `damping` of {} the first numbers act: it has not one coordinate",
                shown(node)
            );
            self.reading.ignored(node, text);
        }
        if self.amount(node, "frictionloss", class) > 0.0 {
            let text = format!("`frictionloss` of {} does not act: it has not one coordinate", shown(node));
            self.reading.ignored(node, text);
        }
        (damping, self.amount(node, "armature", class), stiffness)
    }

    /// Stiffness and damping, of which each is up to three numbers: of x, x², x³, and of v, v |v|, v³.
    pub fn springs_of(&mut self, node: Node<'a, 'a>, tags: &[&str], class: Option<&'a str>) -> (f64, f64, Nonlinear) {
        let [[stiffness, b, c], [damping, e, f]] =
            ["stiffness", "damping"].map(|name| self.polynomial(node, tags, name, class));
        (stiffness, damping, Nonlinear { stiffness: [b, c], damping: [e, f] })
    }

    /// Up to three numbers, of which the first is not negative.
    pub fn polynomial(
        &mut self,
        node: Node<'a, 'a>,
        tags: &[&str],
        name: &'static str,
        class: Option<&'a str>,
    ) -> Triple {
        let all = self.list(node, tags, name, class).unwrap_or_default();
        if all.len() > 3 {
            self.reading.fault(node, format!("`{name}` is three numbers at most"));
        }
        if all.first().is_some_and(|first| *first < 0.0) {
            self.reading.fault(node, format!("`{name}` is zero or more, found `{}`", all[0]));
        }
        std::array::from_fn(|k| all.get(k).copied().unwrap_or(0.0))
    }

    fn joint(
        &mut self,
        node: Node<'a, 'a>,
        name: String,
        (parent, child): (&str, &str),
        ((position, rotation), axes): ((Triple, Rotation), &Matrix),
        class: Option<&'a str>,
    ) {
        let kind = match self.text(node, JOINT, "type", class) {
            None | Some("hinge") => JointKind::Turning,
            Some("slide") => JointKind::Sliding,
            Some("ball") => JointKind::Ball,
            Some(word) => {
                self.reading.fault(node, format!("a joint is free, ball, slide or hinge, found `{word}`"));
                return;
            }
        };
        let axis: Triple = self.numbers(node, JOINT, "axis", class).unwrap_or([0.0, 0.0, 1.0]);
        let Some(axis) = direction(turned(axes, &axis)) else {
            self.reading.fault(node, "its axis is zero and has no direction");
            return;
        };
        let joint = Joint::new(name, self.reading.at(node), kind, parent.to_owned(), child.to_owned());
        let joint = Joint { position, rotation, axis, ..joint };
        let joint = if kind == JointKind::Ball {
            let (damping, armature, stiffness) = self.laws_of_group(node, class);
            let range = self.range_of(node, self.angles.unit, class);
            if range.is_some_and(|[least, _]| least != 0.0) {
                self.reading.fault(node, "the range of a ball is that of the angle of its turn, from 0");
            }
            // No turn is by more than half a revolution.
            let most = range.map(|[_, most]| most).filter(|most| *most < PI);
            Joint { damping, armature, stiffness, limits: [None, most], ..joint }
        } else {
            self.with_laws(node, joint, class)
        };
        // What is not more than zero is none.
        if let Some(tuned) = self.numbers(node, JOINT, "springdamper", class).filter(|[t, r]| *t > 0.0 && *r > 0.0) {
            self.tuned.push((node, joint.name.clone(), tuned));
        }
        self.description.joints.push(joint);
    }

    /// The range of a joint, if it limits.
    fn range_of(&mut self, node: Node<'a, 'a>, unit: f64, class: Option<&'a str>) -> Option<[f64; 2]> {
        let range = self.numbers::<2>(node, JOINT, "range", class).unwrap_or_default();
        let word = self.text(node, JOINT, "limited", class);
        self.limited(node, range.map(|limit| limit * unit), word)
    }

    fn amount(&mut self, node: Node<'a, 'a>, name: &'static str, class: Option<&'a str>) -> f64 {
        match self.classes.carrier((node, JOINT), name, class, &self.reading) {
            Some(carrier) => self.reading.amount(carrier, name),
            None => 0.0,
        }
    }

    /// Damping, springs, limits of a joint with one coordinate.
    fn with_laws(&mut self, node: Node<'a, 'a>, joint: Joint, class: Option<&'a str>) -> Joint {
        let (stiffness, damping, nonlinear) = self.springs_of(node, JOINT, class);
        let [friction, armature] = ["frictionloss", "armature"].map(|name| self.amount(node, name, class));
        let unit = if joint.kind == JointKind::Turning { self.angles.unit } else { 1.0 };
        let [reference, rest] = ["ref", "springref"]
            .map(|name| self.numbers::<1>(node, JOINT, name, class).map_or(0.0, |[number]| number * unit));
        let limits = self.range_of(node, unit, class).map_or([None; 2], |range| range.map(Some));
        let efforts = self.numbers::<2>(node, JOINT, "actuatorfrcrange", class);
        let word = self.text(node, JOINT, "actuatorfrclimited", class);
        let efforts = efforts.and_then(|range| self.limited(node, range, word));
        Joint { damping, friction, stiffness, nonlinear, armature, rest, reference, limits, efforts, ..joint }
    }
}
