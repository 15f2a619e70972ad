//! Actuators: controls along joints and tendons, and of wrenches at sites.

use roxmltree::Node;

use super::File;
use crate::model::robots::description::Drive;
use crate::model::robots::names::unknown;
use crate::model::robots::rotation::Triple;

/// Elements of defaults that all set the same.
const ACTUATOR: &[&str] =
    &["general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle", "adhesion"];

/// What an actuator acts on.
enum ActsOn {
    /// With what its length changes by each.
    Joints(Vec<(String, f64)>),
    /// With the force and the torque there.
    Link(String, [Triple; 2]),
}

impl<'a> File<'a> {
    pub fn actuators(&mut self, section: Node<'a, 'a>) {
        for node in self.reading.elements(section) {
            let drive = self.acts_on(node).and_then(|on| self.drive(node, on));
            // Keyframes count those that are not read as well.
            self.controls.push(drive.as_ref().map(|_| self.description.drives.len()));
            self.description.drives.extend(drive);
        }
    }

    fn drive(&mut self, node: Node<'a, 'a>, on: ActsOn) -> Option<Drive> {
        let (gain, bias) = self.law(node)?;
        let (along, at_link) = match on {
            ActsOn::Joints(along) => (along, None),
            ActsOn::Link(link, wrench) => (Vec::new(), Some((link, wrench))),
        };
        let named = self.reading.text(node, "name").map(str::to_owned);
        let first = along.first().map(|(joint, _)| joint).or(at_link.as_ref().map(|(link, _)| link)).cloned();
        Some(Drive { name: named.or(first)?, at: self.reading.at(node), along, at_link, gain, bias })
    }

    fn acts_on(&mut self, node: Node<'a, 'a>) -> Option<ActsOn> {
        let gears = self.list(node, ACTUATOR, "gear", None).unwrap_or_default();
        let Some(site) = self.reading.text(node, "site") else { return self.along(node, &gears).map(ActsOn::Joints) };
        if self.reading.text(node, "refsite").is_some() {
            self.ignored(node, "a `refsite` is not read; of sites alone the wrench at `site` is");
            return None;
        }
        let Some((_, link)) = self.sites.iter().find(|(name, _)| name == site) else {
            let message = unknown("site", site, self.sites.iter().map(|(name, _)| name.as_str()));
            self.reading.fault(node, format!("it acts at {message}"));
            return None;
        };
        let usual = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let gear = |k: usize| gears.get(k).copied().unwrap_or(if gears.is_empty() { usual[k] } else { 0.0 });
        Some(ActsOn::Link(link.clone(), [[0, 1, 2], [3, 4, 5]].map(|part| part.map(gear))))
    }

    /// The joints that an actuator acts on, with what its length changes by those.
    fn along(&mut self, node: Node<'a, 'a>, gears: &[f64]) -> Option<Vec<(String, f64)>> {
        let gear = gears.first().copied().unwrap_or(1.0);
        let named = |name: &str| self.description.tendons.iter().find(|tendon| tendon.name.as_deref() == Some(name));
        let joint = self.reading.text(node, "joint").or(self.reading.text(node, "jointinparent"));
        let along = match (joint, self.reading.text(node, "tendon")) {
            (Some(joint), _) => vec![(joint.to_owned(), gear)],
            (None, Some(tendon)) if named(tendon).is_some() => {
                let along = named(tendon).map(|tendon| tendon.along.clone()).unwrap_or_default();
                along.into_iter().map(|(joint, factor)| (joint, gear * factor)).collect()
            }
            _ => {
                self.ignored(node, "it acts on no joint, no site, and no tendon that is read");
                return None;
            }
        };
        let several =
            |joint: &str| self.description.joints.iter().any(|other| other.name == joint && !other.kind.is_scalar());
        if along.iter().any(|(joint, _)| several(joint)) {
            self.ignored(node, "its joint has not one coordinate; `wrench(…)` of the struct can act on the body");
            return None;
        }
        Some(along)
    }

    /// Gain and bias; `None` of what is not linear in the control, or has a state of its own.
    fn law(&mut self, node: Node<'a, 'a>) -> Option<(f64, Triple)> {
        let number = |file: &mut Self, name: &'static str, or: f64| {
            file.numbers::<1>(node, ACTUATOR, name, None).map_or(or, |[number]| number)
        };
        let law = match node.tag_name().name() {
            "motor" => (1.0, [0.0; 3]),
            "position" => {
                let [kp, kv] = [number(self, "kp", 1.0), number(self, "kv", 0.0)];
                if number(self, "dampratio", 0.0) != 0.0 || number(self, "timeconst", 0.0) != 0.0 {
                    self.ignored(node, "`dampratio` and `timeconst` are not read; write `kv`");
                    return None;
                }
                (kp, [0.0, -kp, -kv])
            }
            "velocity" => {
                let kv = number(self, "kv", 1.0);
                (kv, [0.0, 0.0, -kv])
            }
            "general" => {
                let word = |name: &'static str, usual| {
                    self.text(node, ACTUATOR, name, None).is_none_or(|word: &str| word == usual)
                };
                let linear = word("dyntype", "none") && word("gaintype", "fixed");
                let biased = self.text(node, ACTUATOR, "biastype", None);
                let gains = self.list(node, ACTUATOR, "gainprm", None);
                let biases = self.list(node, ACTUATOR, "biasprm", None).unwrap_or_default();
                if !linear || !matches!(biased, None | Some("none" | "affine")) {
                    self.ignored(node, "it is not linear in its control, or has a state of its own");
                    return None;
                }
                let affine = biased == Some("affine");
                let bias = |k: usize| biases.get(k).copied().filter(|_| affine).unwrap_or(0.0);
                (gains.and_then(|gains| gains.first().copied()).unwrap_or(1.0), [bias(0), bias(1), bias(2)])
            }
            _ => {
                self.ignored(node, "it is not linear in its control, or has a state of its own");
                return None;
            }
        };
        Some(law)
    }
}
