//! Equalities, which are constraints or couplings, and tendons that are linear in joints.

use roxmltree::Node;

use super::File;
use super::reference::WRAPPED;
use crate::description::{Cable, Closure, Mimic, Nonlinear, Polynomial, Tendon, Turn};
use crate::names::unknown;
use crate::rotation::of_quaternion;

/// The element of defaults.
const EQUALITY: &[&str] = &["equality"];

/// The force of a tendon by its length and its rate.
struct TendonLaw {
    stiffness: f64,
    damping: f64,
    nonlinear: Nonlinear,
    /// The least and the greatest length without force; none where they are those that joints have where their springs
    /// have no force.
    rest: Option<[f64; 2]>,
    /// The least and the greatest length.
    limits: Option<[f64; 2]>,
}

impl<'a> File<'a> {
    pub fn equalities(&mut self, section: Node<'a, 'a>) {
        for node in self.reading.elements(section) {
            let tag = node.tag_name().name();
            if self.text(node, EQUALITY, "active", None) == Some("false") {
                self.reading.note(node, format!("the equality <{tag}> is not active"));
                continue;
            }
            match tag {
                "connect" if self.reading.text(node, "body1").is_some() => self.connected(node),
                "weld" if self.reading.text(node, "body1").is_some() => self.welded(node),
                "joint" => self.coupled(node),
                "tendon" => self.tied(node),
                _ => self.ignored(node, "it joins no two bodies or joints"),
            }
        }
    }

    fn ends(&mut self, node: Node<'a, 'a>) -> Option<[String; 2]> {
        let first = self.reading.required(node, "body1")?;
        Some([first, self.reading.text(node, "body2").unwrap_or("world").to_owned()])
    }

    /// A point in common.
    fn connected(&mut self, node: Node<'a, 'a>) {
        let Some(links) = self.ends(node) else { return };
        match self.reading.numbers(node, "anchor") {
            Some(anchor) => {
                let at = self.reading.at(node);
                self.description.closures.push(Closure { at, links, anchor, turn: None });
            }
            None => self.reading.fault(node, "`anchor` is needed"),
        }
    }

    /// A point in common, and a rotation; as at rest, where `relpose` does not say it.
    fn welded(&mut self, node: Node<'a, 'a>) {
        let Some(links) = self.ends(node) else { return };
        let at = self.reading.at(node);
        let pose: Option<[f64; 7]> = self.reading.numbers(node, "relpose");
        // The anchor is in the axes of the second body, the pose that of the second in those of the first.
        let anchor: [f64; 3] = self.reading.numbers(node, "anchor").unwrap_or_default();
        let stated = pose.and_then(|[x, y, z, w, i, j, k]| Some(([x, y, z], of_quaternion([w, i, j, k])?)));
        let closure = match stated {
            Some((place, turn)) => {
                if anchor != [0.0; 3] {
                    self.reading.note(node, "the anchor of a <weld> with a pose moves nothing: both agree everywhere");
                }
                Closure { at, links, anchor: place, turn: Some(Turn::To(turn)) }
            }
            None => {
                let [first, second] = links;
                Closure { at, links: [second, first], anchor, turn: Some(Turn::AsAtRest) }
            }
        };
        self.description.closures.push(closure);
    }

    /// `joint1 = c₀ + c₁ joint2 + …`, both from their references.
    fn coupled(&mut self, node: Node<'a, 'a>) {
        let Some(first) = self.reading.required(node, "joint1") else { return };
        let coefficients = self.coefficients(node);
        let at = self.reading.at(node);
        let second = self.reading.text(node, "joint2").map(str::to_owned);
        let joints = &mut self.description.joints;
        let reference =
            |name: &str| joints.iter().find(|joint| joint.name == name).map_or(0.0, |joint| joint.reference);
        let of_second = second.as_deref().map_or(0.0, reference);
        let [offset, multiplier, rest @ ..] = coefficients;
        let offset = reference(&first) + offset - multiplier * of_second;
        let Some(joint) = joints.iter_mut().find(|joint| joint.name == first) else {
            return self.reading.fault(node, format!("`{first}` is no joint of this file"));
        };
        match second {
            // A joint follows one other at most.
            Some(joint2) if rest == [0.0; 3] && joint.mimic.is_none() => {
                joint.mimic = Some(Mimic { at, joint: joint2, multiplier, offset });
            }
            of => {
                let one = |joint: String| vec![(joint, 1.0)];
                let (along, of) = (one(first), of.map(one));
                self.description.polynomials.push(Polynomial { at, along, of, coefficients });
            }
        }
    }

    /// The coefficients of 1, x, x², x³, x⁴; those that are not written are as in x.
    fn coefficients(&mut self, node: Node<'a, 'a>) -> [f64; 5] {
        let written = self.list(node, EQUALITY, "polycoef", None).unwrap_or_default();
        if written.len() > 5 {
            self.reading.fault_of_value(node, "polycoef", "`polycoef` is five numbers at most");
        }
        let usual = [0.0, 1.0, 0.0, 0.0, 0.0];
        std::array::from_fn(|k| written.get(k).copied().unwrap_or(usual[k]))
    }

    /// The same of the lengths of tendons that are linear in joints, from where they are at first.
    fn tied(&mut self, node: Node<'a, 'a>) {
        let coefficients = self.coefficients(node);
        let Some(first) = self.reading.required(node, "tendon1") else { return };
        let second = self.reading.text(node, "tendon2").map(str::to_owned);
        let tendons = &self.description.tendons;
        let along = |name: &String| {
            let tendon = tendons.iter().find(|tendon| tendon.name.as_ref() == Some(name))?;
            Some(tendon.along.clone()).filter(|along| !along.is_empty())
        };
        match (along(&first), second.as_ref().map(along)) {
            (Some(along), of @ (None | Some(Some(_)))) => {
                let polynomial = Polynomial { at: self.reading.at(node), along, of: of.flatten(), coefficients };
                self.description.polynomials.push(polynomial);
            }
            _ => self.ignored(node, "it ties tendons that are not linear in joints"),
        }
    }

    /// Springs and dampers along sums of coordinates, and along lengths through sites.
    pub fn tendons(&mut self, section: Node<'a, 'a>) {
        for node in self.reading.elements(section) {
            match node.tag_name().name() {
                "fixed" => self.fixed(node),
                "spatial" => self.spatial(node),
                _ => {}
            }
        }
    }

    /// The law of a tendon.
    fn law(&mut self, node: Node<'a, 'a>) -> TendonLaw {
        let tags = &["tendon"];
        let (stiffness, damping, nonlinear) = self.springs_of(node, tags, None);
        // One number is both, whatever defaults have.
        let carrier = self.classes.carrier((node, tags), "springlength", None, &self.reading);
        let written = carrier.and_then(|carrier| self.reading.list(carrier, "springlength")).unwrap_or_default();
        let rest = match written.as_slice() {
            // MuJoCo's word for that.
            [] | [-1.0] | [-1.0, -1.0, ..] => None,
            [one] => Some([*one; 2]),
            [least, most, ..] => Some([*least, *most]),
        };
        if rest.is_some_and(|[least, most]| least > most) {
            self.reading.fault(node, "`springlength` is from the least to the most");
        }
        let range = self.numbers::<2>(node, tags, "range", None);
        let word = self.text(node, tags, "limited", None);
        let limits = range.and_then(|range| self.limited(node, range, word));
        TendonLaw { stiffness, damping, nonlinear, rest, limits }
    }

    fn fixed(&mut self, node: Node<'a, 'a>) {
        let mut along = Vec::new();
        for joint in self.reading.children(node, "joint") {
            let name = self.reading.required(joint, "joint");
            let factor = self.reading.required_number(joint, "coef");
            along.extend(name.zip(factor));
        }
        let TendonLaw { stiffness, damping, nonlinear, rest, limits } = self.law(node);
        let joints = &self.description.joints;
        let at_spring = |name: &String| joints.iter().find(|joint| joint.name == *name).map_or(0.0, |joint| joint.rest);
        let at_springs: f64 = along.iter().map(|(name, factor)| factor * at_spring(name)).sum();
        let rest = rest.unwrap_or([at_springs; 2]);
        let name = self.reading.text(node, "name").map(str::to_owned);
        let at = self.reading.at(node);
        self.description.tendons.push(Tendon { name, at, along, stiffness, damping, nonlinear, rest, limits });
    }

    /// From site to site; a pulley begins a part whose length counts by its divisor.
    fn spatial(&mut self, node: Node<'a, 'a>) {
        let (mut last, mut factor): (Option<String>, f64) = (None, 1.0);
        let mut parts = Vec::new();
        for element in self.reading.elements(node) {
            match element.tag_name().name() {
                "site" => {
                    let Some(name) = self.reading.required(element, "site") else { continue };
                    let Some(link) = self.link_of_site(&name) else {
                        let message = unknown("site", &name, self.sites.iter().map(|(name, _)| name.as_str()));
                        self.reading.fault(element, format!("it runs through {message}"));
                        continue;
                    };
                    parts.extend(last.replace(link.clone()).map(|before| ([before, link], factor)));
                }
                "pulley" => {
                    last = None;
                    match self.reading.required_number(element, "divisor") {
                        Some(divisor) if divisor > 0.0 => factor = 1.0 / divisor,
                        Some(_) => self.reading.fault(element, "`divisor` is more than zero"),
                        None => {}
                    }
                }
                _ => return self.ignored(node, WRAPPED),
            }
        }
        let TendonLaw { stiffness, damping, nonlinear, rest, limits } = self.law(node);
        let name = self.reading.text(node, "name").map(str::to_owned);
        let at = self.reading.at(node);
        self.description.cables.push(Cable { name, at, parts, stiffness, damping, nonlinear, rest, limits });
    }
}
