//! Actuators: controls along joints and tendons, and of wrenches at sites.

use roxmltree::Node;

use super::File;
use super::gains::{ACTUATOR, Gains};
use crate::description::{Description, Drive, JointKind, Turned};
use crate::names::unknown;
use crate::rotation::Triple;
use crate::xml::shown;

/// Joints or link that an actuator acts on.
enum ActsOn {
    /// Joints, with the change of its length by each.
    Joints(Vec<(String, f64)>),
    /// A link, with the force and the torque there.
    Link(String, [Triple; 2]),
    /// A ball or a joint that moves freely.
    Turned(Turned),
}

impl<'a> File<'a> {
    pub fn actuators(&mut self, section: Node<'a, 'a>) {
        let all = self.reading.elements(section);
        // Ratios of damping are of the inertia with all of these.
        all.iter().for_each(|node| self.reflect(*node));
        for node in all {
            let drive = self.drive(node);
            // Keyframes count those that are not read as well.
            self.controls.push(drive.as_ref().map(|_| self.description.drives.len()));
            self.description.drives.extend(drive);
        }
    }

    fn drive(&mut self, node: Node<'a, 'a>) -> Option<Drive> {
        let gains = self.gains(node);
        if self.disabled.actuation || self.disabled.groups.contains(&gains.group) {
            self.reading.note(node, format!("{} is switched off by <option>", shown(node)));
            self.reading.pass(node);
            return None;
        }
        if !gains.is_affine() {
            self.ignored(node, "it is not linear in its control, or has a state of its own");
            return None;
        }
        let (mut along, mut at_link, mut at_joint) = (Vec::new(), None, None);
        match self.acts_on(node, &gains.gear)? {
            ActsOn::Joints(joints) => along = joints,
            ActsOn::Link(link, wrench) => at_link = Some((link, wrench)),
            ActsOn::Turned(turned) => at_joint = Some(turned),
        }
        let named = self.reading.text(node, "name").map(str::to_owned);
        let of_wrench = at_link.as_ref().map(|(link, _)| link).or(at_joint.as_ref().map(|turned| &turned.name));
        let first = along.first().map(|(joint, _)| joint).or(of_wrench).cloned();
        let [gain, mut bias] = gains.acting();
        if let Some(ratio) = gains.ratio() {
            bias[2] = -self.damping(node, &along, (gain[0], ratio))?;
        }
        let [controls, forces] = self.ranges(node, &gains, &along);
        let at = self.reading.at(node);
        Some(Drive { name: named.or(first)?, at, along, at_link, at_joint, gain, bias, controls, forces })
    }

    /// Adds what an actuator has of damping and inertia of its own to its joint or tendon, by the square of its gear,
    /// also where the actuator is switched off (`mj_actuatorDamping` of MuJoCo's `src/engine/engine_core_util.c`).
    fn reflect(&mut self, node: Node<'a, 'a>) {
        let gear = self.list(node, ACTUATOR, "gear", None).and_then(|gear| gear.first().copied()).unwrap_or(1.0);
        let damping = self.polynomial(node, ACTUATOR, "damping", None).map(|own| own * gear * gear);
        let armature = self.numbers::<1>(node, ACTUATOR, "armature", None).map_or(0.0, |[own]| own * gear * gear);
        if damping == [0.0; 3] && armature == 0.0 {
            return;
        }
        let joint = self.reading.text(node, "joint").or(self.reading.text(node, "jointinparent"));
        let tendon = self.reading.text(node, "tendon").filter(|_| joint.is_none());
        let Description { joints, tendons, cables, .. } = &mut self.description;
        let is_named = |name: &Option<String>| name.as_deref() == tendon && tendon.is_some();
        let laws = if let Some(joint) = joints.iter_mut().find(|own| Some(own.name.as_str()) == joint) {
            joint.armature += armature;
            Some((joint.kind.is_scalar(), true, &mut joint.damping, &mut joint.nonlinear))
        } else if let Some(own) = tendons.iter_mut().find(|own| is_named(&own.name)) {
            Some((true, armature == 0.0, &mut own.damping, &mut own.nonlinear))
        } else {
            let cable = cables.iter_mut().find(|own| is_named(&own.name));
            cable.map(|own| (true, armature == 0.0, &mut own.damping, &mut own.nonlinear))
        };
        let Some((has_one_rate, has_inertia, linear, nonlinear)) = laws else {
            let text = format!(
                "`damping` and `armature` of {} do not act: they are those of a joint or a tendon",
                shown(node)
            );
            return self.reading.ignored(node, text);
        };
        *linear += damping[0];
        let is_read = has_inertia && (has_one_rate || damping[1..] == [0.0; 2]);
        if has_one_rate {
            nonlinear.damping = [0, 1].map(|k| nonlinear.damping[k] + damping[k + 1]);
        }
        if !is_read {
            let text = format!(
                "of `damping` and `armature` of {} a part does not act: inertia of tendons, and damping that is not \
                 linear where there is not one coordinate",
                shown(node)
            );
            self.reading.ignored(node, text);
        }
    }

    /// Gains that defaults and an element give.
    fn gains(&mut self, node: Node<'a, 'a>) -> Gains<'a> {
        let mut said: Vec<Node<'a, 'a>> = self.classes.nearest((node, ACTUATOR), None, &self.reading).collect();
        said.reverse();
        let gains = Gains::of(&said, &mut self.reading);
        // Of elements of one kind all versions of MuJoCo make the same.
        let tag = node.tag_name().name();
        let strange = |element: &Node<'a, 'a>| !["general", tag].contains(&element.tag_name().name());
        if tag != "general" && said.iter().any(strange) {
            let other = said.iter().copied().find(strange).map_or("", |element| element.tag_name().name());
            said.retain(|element| !strange(element));
            let own = Gains::of(&said, &mut self.reading);
            if own.law() != gains.law() {
                let text = format!(
                    "{} has defaults of <{other}>, of which versions of MuJoCo make different things; write its gains \
                     in itself",
                    shown(node)
                );
                self.reading.ignored(node, text);
            }
        }
        gains
    }

    /// Ranges of the control, and of the force, that limit.
    fn ranges(&mut self, node: Node<'a, 'a>, gains: &Gains<'a>, along: &[(String, f64)]) -> [Option<[f64; 2]>; 2] {
        let mut ranges = gains.ranges;
        if gains.inherited() > 0.0 {
            let of_joint = match along {
                [(name, _)] => self.description.joints.iter().find(|joint| joint.name == *name),
                _ => None,
            };
            match of_joint.map(|joint| joint.limits) {
                Some([Some(least), Some(most)]) => {
                    let (mean, half) = ((least + most) / 2.0, (most - least) / 2.0 * gains.inherited());
                    ranges[0].0 = [mean - half, mean + half];
                }
                _ => self.ignored(node, "`inheritrange` is read of joints with limits"),
            }
        }
        let ranges = ranges.map(|(range, word)| self.limited(node, range, word));
        [ranges[0].filter(|_| !self.disabled.clamps), ranges[1]]
    }

    /// A range, if it limits. Without `limited` a range limits if it is not empty; MuJoCo takes one with exchanged ends
    /// for empty, too (`islimited` of `src/user/user_objects.cc`).
    pub fn limited(&mut self, node: Node<'a, 'a>, range: [f64; 2], word: Option<&str>) -> Option<[f64; 2]> {
        let limits = match word {
            Some("true") => true,
            Some("false") => false,
            _ => self.automatic && range[0] != range[1],
        };
        if limits && range[0] >= range[1] {
            let [least, most] = range;
            self.reading.fault(node, format!("a range is from its least to its most, found {least} to {most}"));
        }
        limits.then_some(range)
    }

    fn acts_on(&mut self, node: Node<'a, 'a>, gear: &[f64; 6]) -> Option<ActsOn> {
        let Some(site) = self.reading.text(node, "site") else {
            return match self.turned(node, gear) {
                Some(turned) => Some(ActsOn::Turned(turned)),
                None => self.along(node, gear[0]).map(ActsOn::Joints),
            };
        };
        let wrench = [[0, 1, 2], [3, 4, 5]].map(|part| part.map(|k| gear[k]));
        if self.reading.text(node, "refsite").is_some() {
            self.ignored(node, "a `refsite` is not read; of sites alone the wrench at `site` is");
            return None;
        }
        let Some(link) = self.link_of_site(site) else {
            let message = unknown("site", site, self.sites.iter().map(|(name, _)| name.as_str()));
            self.reading.fault(node, format!("it acts at {message}"));
            return None;
        };
        Some(ActsOn::Link(link, wrench))
    }

    /// The drive of a ball, by a torque of the first three numbers of its gear, or of a joint that moves freely, by a
    /// force and a torque, as `mj_transmission` of MuJoCo's `src/engine/engine_core_smooth.c` has it.
    fn turned(&mut self, node: Node<'a, 'a>, gear: &[f64; 6]) -> Option<Turned> {
        let own = self.reading.text(node, "joint");
        let name = own.or(self.reading.text(node, "jointinparent"))?;
        let joint = self.description.joints.iter().find(|joint| joint.name == name)?;
        let [first, second] = [[0, 1, 2], [3, 4, 5]].map(|part| part.map(|k| gear[k]));
        let wrench = match joint.kind {
            JointKind::Ball => [[0.0; 3], first],
            JointKind::Floating => [first, second],
            _ => return None,
        };
        Some(Turned { name: name.to_owned(), wrench, in_parent: own.is_none() })
    }

    /// Name of the link of a site.
    pub fn link_of_site(&self, site: &str) -> Option<String> {
        self.sites.iter().find(|(name, _)| name == site).map(|(_, link)| link.clone())
    }

    /// The joints that an actuator acts on, with what its length changes by those.
    fn along(&mut self, node: Node<'a, 'a>, gear: f64) -> Option<Vec<(String, f64)>> {
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
            self.ignored(node, "a joint of its tendon has not one coordinate");
            return None;
        }
        Some(along)
    }
}
