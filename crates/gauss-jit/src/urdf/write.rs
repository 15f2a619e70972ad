//! The document: links and joints from the root on, then transmissions.

use std::f64::consts::FRAC_PI_2;

use gauss_codegen::LinkKind;
use gauss_runtime::nalgebra::{Isometry3, UnitQuaternion};

use crate::joints::JointScene;
use crate::joints::motions::Motion;
use crate::joints::parts::JointAttributes;
use crate::joints::tag::{OF_TURNS, Tag, comment};

/// A limit in the place of one that URDF wants and the scene has not: a zero would be one to some programs.
const FAR: f64 = 1e9;

/// A document that is written.
pub struct UrdfDocument<'a> {
    own: &'a mut JointScene,
    /// Rounding of places.
    error: f64,
    /// Names of links that no body of the scene has, and of fixed joints.
    names: Vec<String>,
    out: String,
}

/// The link that others hang on, and its axes where all joints are at 0.
struct Parent<'a> {
    link: &'a str,
    axes: Isometry3<f64>,
}

impl<'a> UrdfDocument<'a> {
    pub fn new(own: &'a mut JointScene) -> Self {
        let error = own.error_of_places();
        Self { own, error, names: Vec::new(), out: String::new() }
    }

    /// The document. Whatever is found to be wrong on the way is among the mistakes of the parts.
    pub fn written(mut self) -> String {
        // A frame of that name that stands still at the origin is the root itself.
        let bodies = &self.own.scene.bodies.list;
        let still = |k: usize| self.own.tree.carriers[k].is_none() && bodies[k].kind == LinkKind::Frame;
        let is_root = |k: &usize| bodies[*k].name == "world" && still(*k) && self.is_near(&self.own.tree.places[*k]);
        let root = (0..bodies.len()).find(is_root);
        let link = if root.is_some() { "world".to_owned() } else { self.free_name("world") };
        self.out += &Tag::new(1, "link").word("name", &link).close();
        let parent = Parent { link: &link, axes: Isometry3::identity() };
        self.members(None, root, &parent);
        self.children(None).into_iter().for_each(|k| self.joint(k, &parent));
        self.transmissions();
        let mut out = Tag::new(0, "robot").word("name", self.own.scene.kernel.model().name()).open();
        out += &comment("written by Gauss, with parameters as numbers; lengths in m, angles in rad, masses in kg");
        self.own.parts.lost.iter().for_each(|line| out += &comment(line));
        format!("<?xml version=\"1.0\"?>\n{out}{}</robot>\n", self.out)
    }

    fn is_near(&self, pose: &Isometry3<f64>) -> bool {
        pose.translation.vector.amax() <= self.error && pose.rotation.angle() <= 4.0 * OF_TURNS
    }

    /// A name that neither a body nor a joint has, nor another link: that word, or with a number.
    fn free_name(&mut self, word: &str) -> String {
        let bodies = self.own.scene.bodies.list.iter().map(|own| &own.name);
        let taken: Vec<&String> = bodies.chain(&self.own.tree.names).chain(&self.names).collect();
        let numbered = (2..).map(|k| format!("{word}_{k}"));
        let name = std::iter::once(word.to_owned()).chain(numbered).find(|name| !taken.contains(&name));
        let name = name.unwrap_or_default();
        self.names.push(name.clone());
        name
    }

    fn children(&self, parent: Option<usize>) -> Vec<usize> {
        (0..self.own.tree.joints.len()).filter(|&k| self.own.tree.parents[k] == parent).collect()
    }

    fn carried(&self, by: Option<usize>) -> Vec<usize> {
        (0..self.own.tree.places.len()).filter(|&body| self.own.tree.carriers[body] == by).collect()
    }

    /// A joint with its link, and all that hangs on it.
    fn joint(&mut self, k: usize, parent: &Parent<'_>) {
        let Some(main) = self.main(k) else { return self.joint_of(k, (None, parent.axes), parent) };
        self.joint_of(k, (Some(main), self.own.tree.places[main]), parent);
    }

    /// The body whose axes a joint has: a rigid one, else a particle, else a frame.
    fn main(&self, k: usize) -> Option<usize> {
        let rank = |body: &usize| match self.own.scene.bodies.list[*body].kind {
            LinkKind::Rigid { .. } => 0,
            LinkKind::Particle => 1,
            LinkKind::Frame => 2,
        };
        self.carried(Some(k)).into_iter().min_by_key(rank)
    }

    fn joint_of(&mut self, k: usize, (main, place): (Option<usize>, Isometry3<f64>), parent: &Parent<'_>) {
        let motion = self.own.tree.joints[k].motion;
        let axes = match motion {
            Motion::Hinge { axis, anchor } => {
                // The point of the axis that is nearest.
                let arm = place.translation.vector - anchor;
                let foot = anchor + axis * axis.dot(&arm);
                if (foot - place.translation.vector).amax() <= self.error {
                    place
                } else {
                    Isometry3::from_parts(foot.into(), place.rotation)
                }
            }
            Motion::Slide { .. } => place,
            Motion::Free(axes) => axes,
            Motion::Ball(_) => {
                let text = format!("`{}` turns about a point, and URDF has no ball joints", self.own.tree.names[k]);
                return self.own.parts.mistakes.push(text);
            }
        };
        // A body whose O is elsewhere hangs on a link of its own.
        let main = main.filter(|_| self.is_near(&(axes.inverse() * place)));
        let link = match main {
            Some(main) => self.own.scene.bodies.list[main].name.clone(),
            None => self.free_name(&format!("{}_link", self.own.tree.names[k])),
        };
        self.moving_joint(k, &link, &axes, parent);
        match main {
            Some(main) => self.link(main),
            None => self.out += &Tag::new(1, "link").word("name", &link).close(),
        }
        let own = Parent { link: &link, axes };
        self.members(Some(k), main, &own);
        self.children(Some(k)).into_iter().for_each(|child| self.joint(child, &own));
    }

    fn moving_joint(&mut self, k: usize, link: &str, axes: &Isometry3<f64>, parent: &Parent<'_>) {
        let (joint, name) = (self.own.tree.joints[k], self.own.tree.names[k].clone());
        let JointAttributes { range, damping, friction_loss, .. } = self.own.parts.joints[k];
        let leader = joint.follows(k).then_some(joint.variable);
        // What follows has the limits of what it follows.
        let range = leader.map_or(range, |leader| {
            self.own.parts.joints[leader].range.map(|side| side.map(|side| joint.ratio * side))
        });
        let (kind, axis) = match joint.motion {
            Motion::Hinge { axis, .. } if range == [None; 2] => ("continuous", Some(axis)),
            Motion::Hinge { axis, .. } => ("revolute", Some(axis)),
            Motion::Slide { axis } => ("prismatic", Some(axis)),
            Motion::Free(_) | Motion::Ball(_) => ("floating", None),
        };
        self.joint_element((&name, kind), link, axes, parent);
        if let Some(axis) = axis {
            let seen = axes.rotation.inverse() * axis;
            self.out += &Tag::new(2, "axis").numbers("xyz", seen.iter(), OF_TURNS).close();
        }
        if matches!(kind, "revolute" | "prismatic") {
            let [lower, upper] = [range[0].unwrap_or(-FAR), range[1].unwrap_or(FAR)];
            let tag = Tag::new(2, "limit").number("lower", lower).number("upper", upper);
            self.out += &tag.number("effort", FAR).number("velocity", FAR).close();
            let missing = ["lower limit", "upper limit"].into_iter().zip(range).filter(|(_, side)| side.is_none());
            let missing = missing.map(|(word, _)| word).chain(["effort", "velocity"]).collect::<Vec<_>>().join(", ");
            let text = format!("`{name}` has no bounds of these, which URDF wants: {missing}; {FAR:e} stands there");
            self.own.parts.lost.push(text);
        }
        if damping != 0.0 && axis.is_some() || friction_loss != 0.0 {
            let tag = Tag::new(2, "dynamics").some("damping", damping).some("friction", friction_loss);
            self.out += &tag.close();
        }
        if let Some(leader) = leader {
            let tag = Tag::new(2, "mimic").word("joint", &self.own.tree.names[leader]);
            self.out += &tag.number("multiplier", joint.ratio).close();
        }
        self.out += "  </joint>\n";
    }

    /// A joint up to what its kind has.
    fn joint_element(&mut self, (name, kind): (&str, &str), link: &str, axes: &Isometry3<f64>, parent: &Parent<'_>) {
        self.out += &Tag::new(1, "joint").word("name", name).word("type", kind).open();
        self.out += &Tag::new(2, "parent").word("link", parent.link).close();
        self.out += &Tag::new(2, "child").word("link", link).close();
        let seen = parent.axes.inverse() * axes;
        if !self.is_near(&seen) {
            let tag = Tag::new(2, "origin").numbers("xyz", seen.translation.vector.iter(), self.error);
            let is_turned = seen.rotation.angle() > 4.0 * OF_TURNS;
            let tag = if is_turned { tag.numbers("rpy", &angles(&seen.rotation), 0.0) } else { tag };
            self.out += &tag.close();
        }
    }

    /// Bodies, particles and frames that a joint carries beside the body of its link, or that stand still.
    fn members(&mut self, carrier: Option<usize>, main: Option<usize>, parent: &Parent<'_>) {
        for body in self.carried(carrier).into_iter().filter(|body| Some(*body) != main) {
            let name = self.own.scene.bodies.list[body].name.clone();
            let joint = self.free_name(&format!("{name}_fixed"));
            let place = self.own.tree.places[body];
            self.joint_element((&joint, "fixed"), &name, &place, parent);
            self.out += "  </joint>\n";
            self.link(body);
        }
    }

    /// The link of a body, with its mass data.
    fn link(&mut self, body: usize) {
        let (own, data) = (&self.own.scene.bodies.list[body], &self.own.masses[body]);
        let tag = Tag::new(1, "link").word("name", &own.name);
        if own.kind == LinkKind::Frame {
            return self.out += &tag.close();
        }
        self.out += &tag.open();
        self.out += "    <inertial>\n";
        if data.center.amax() > 0.0 {
            self.out += &Tag::new(3, "origin").numbers("xyz", data.center.iter(), 0.0).close();
        }
        self.out += &Tag::new(3, "mass").number("value", data.mass).close();
        // The inertia may be a difference of that about O and that of the centre of mass.
        let error = 4e-16 * (data.inertia.amax() + data.mass * data.center.norm_squared());
        let parts =
            [("ixx", (0, 0)), ("iyy", (1, 1)), ("izz", (2, 2)), ("ixy", (0, 1)), ("ixz", (0, 2)), ("iyz", (1, 2))];
        let element = Tag::new(3, "inertia");
        let with = |tag: Tag, (name, place): (&str, (usize, usize))| tag.numbers(name, &[data.inertia[place]], error);
        self.out += &parts.into_iter().fold(element, with).close();
        self.out += "    </inertial>\n  </link>\n";
    }

    /// Inputs along single joints, with what the joint has for a rotor; rotors of other joints.
    fn transmissions(&mut self) {
        let JointScene { tree, parts, .. } = &*self.own;
        let mut rest: Vec<f64> = parts.joints.iter().map(|joint| joint.armature).collect();
        let mut list = Vec::new();
        for (name, (joint, gear)) in parts.motors.iter().filter_map(|own| Some((own.name.clone(), own.joint()?))) {
            list.push((name, joint, gear, std::mem::take(&mut rest[joint]) / (gear * gear)));
        }
        for (joint, rotor) in rest.into_iter().enumerate().filter(|(_, rotor)| *rotor > 0.0) {
            list.push((format!("{}_rotor", tree.names[joint]), joint, 1.0, rotor));
        }
        for (name, joint, gear, rotor) in list {
            let joint = self.own.tree.names[joint].clone();
            let element =
                |depth: usize, word: &str, text: &str| format!("{}<{word}>{text}</{word}>\n", "  ".repeat(depth));
            self.out += &Tag::new(1, "transmission").word("name", &name).open();
            self.out += &element(2, "type", "transmission_interface/SimpleTransmission");
            self.out += &Tag::new(2, "joint").word("name", &joint).open();
            self.out += &element(3, "hardwareInterface", "hardware_interface/EffortJointInterface");
            self.out += "    </joint>\n";
            self.out += &Tag::new(2, "actuator").word("name", &name).open();
            self.out += &element(3, "mechanicalReduction", &gear.to_string());
            if rotor > 0.0 {
                self.out += &element(3, "rotorInertia", &rotor.to_string());
                let text = format!(
                    "the armature of `{joint}` is a rotor of the transmission `{name}`, which not all programs read"
                );
                self.own.parts.lost.push(text);
            }
            self.out += "    </actuator>\n  </transmission>\n";
        }
    }
}

/// Roll, pitch and yaw. Near a pitch of a quarter turn, where yaw is any, roll is what that leaves.
fn angles(turn: &UnitQuaternion<f64>) -> [f64; 3] {
    let r = turn.to_rotation_matrix();
    let pitch = (-r[(2, 0)]).atan2(r[(0, 0)].hypot(r[(1, 0)]));
    let yaw = r[(1, 0)].atan2(r[(0, 0)]);
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r[(0, 2)] - cos * r[(1, 2)]).atan2(cos * r[(1, 1)] - sin * r[(0, 1)]);
    // Rounding of quarter turns.
    let clean = |angle: f64| {
        let near = (angle / FRAC_PI_2).round() * FRAC_PI_2;
        if (angle - near).abs() <= 4.0 * OF_TURNS { near } else { angle }
    };
    [roll, pitch, yaw].map(clean)
}
