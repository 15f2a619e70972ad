//! The document: bodies in bodies, with their joints, then tendons, actuators and contacts.

use gauss_codegen::LinkKind;
use gauss_runtime::nalgebra::{Isometry3, Matrix3, Quaternion, Vector3};

use crate::joints::JointScene;
use crate::joints::motions::{Joint, Motion, ROUNDING};
use crate::joints::numbers::MassData;
use crate::joints::parts::{Motor, Obstacle, SphereContact, Transmission};
use crate::joints::tag::{OF_TURNS, Tag, comment, section};
use crate::joints::tree::JointTree;

use super::masses::{self, LEAST};

/// A side of a range that nobody gave: MuJoCo has none with one side.
const FAR: f64 = 1e9;

/// The radius of what touches as a point: MuJoCo has no geoms without size.
pub const POINT: f64 = 1e-6;

/// A document that is written.
pub struct MjcfDocument<'a> {
    own: &'a mut JointScene,
    /// Rounding of places.
    error: f64,
}

impl<'a> MjcfDocument<'a> {
    pub fn new(own: &'a mut JointScene) -> Self {
        let error = own.error_of_places();
        Self { own, error }
    }

    /// The document. Whatever is found to be wrong on the way is among the mistakes of the parts.
    pub fn written(mut self) -> String {
        let mut world = String::new();
        self.members(None, (None, &Isometry3::identity()), 2, &mut world);
        world += &self.ends_of_loops(None, &Isometry3::identity(), 2);
        self.children(None).into_iter().for_each(|k| self.body(k, &Isometry3::identity(), 2, &mut world));
        let mut out = Tag::new(0, "mujoco").word("model", self.own.scene.kernel.model().name()).open();
        out += &comment("written by Gauss, with parameters as numbers; lengths in m, angles in rad, masses in kg");
        self.own.parts.lost.iter().for_each(|line| out += &comment(line));
        let compiler = Tag::new(1, "compiler").word("angle", "radian").word("autolimits", "true");
        out += &compiler.word("inertiafromgeom", "false").close();
        out += &Tag::new(1, "option").numbers("gravity", self.own.scene.gravity().iter(), 0.0).close();
        if !self.own.parts.contacts.is_empty() {
            out += "  <default><geom contype=\"0\" conaffinity=\"0\"/></default>\n";
        }
        section("worldbody", &(self.planes() + &world), &mut out);
        section("tendon", &self.tendons(), &mut out);
        section("equality", &self.equalities(), &mut out);
        section("actuator", &self.motors(), &mut out);
        section("contact", &self.pairs(), &mut out);
        out + "</mujoco>\n"
    }

    fn name(&self, body: usize) -> &str {
        &self.own.scene.bodies.list[body].name
    }

    fn children(&self, parent: Option<usize>) -> Vec<usize> {
        (0..self.own.tree.joints.len()).filter(|&k| self.own.tree.parents[k] == parent).collect()
    }

    fn carried(&self, by: Option<usize>, wanted: impl Fn(LinkKind) -> bool) -> Vec<usize> {
        let list = &self.own.scene.bodies.list;
        (0..list.len()).filter(|&k| self.own.tree.carriers[k] == by && wanted(list[k].kind)).collect()
    }

    /// A joint with those below it between which there is no mass and no branch: MuJoCo has several joints at a body.
    fn joined(&mut self, first: usize) -> Vec<usize> {
        let mut joints = vec![first];
        loop {
            let last = joints[joints.len() - 1];
            let has_mass = !self.carried(Some(last), |kind| kind != LinkKind::Frame).is_empty();
            let is_scalar = |k: usize| self.own.tree.joints[k].motion.is_scalar();
            match self.children(Some(last))[..] {
                [only] if !has_mass && is_scalar(last) && is_scalar(only) => {
                    for frame in self.carried(Some(last), |_| true) {
                        let name = self.name(frame).to_owned();
                        self.own.parts.lost.push(format!("the frame `{name}` is left out: no mass moves with it"));
                        if self.has_marks(frame) {
                            let text = format!("`{name}`, at which something acts or touches, has no mass");
                            self.own.parts.mistakes.push(text);
                        }
                    }
                    joints.push(only);
                }
                _ => return joints,
            }
        }
    }

    /// The body that a joint carries.
    fn body(&mut self, first: usize, above: &Isometry3<f64>, depth: usize, out: &mut String) {
        let joints = self.joined(first);
        let last = joints[joints.len() - 1];
        let rigid = self.carried(Some(last), |kind| matches!(kind, LinkKind::Rigid { .. }));
        let particles = self.carried(Some(last), |kind| kind == LinkKind::Particle);
        let main = rigid.first().or(particles.first()).copied();
        let axes = match (&self.own.tree.joints[last].motion, main) {
            (Motion::Ball(axes) | Motion::Free(axes), _) => *axes,
            (_, Some(main)) => self.own.tree.places[main],
            (Motion::Hinge { anchor, .. }, None) => Isometry3::translation(anchor.x, anchor.y, anchor.z),
            (Motion::Slide { .. }, None) => *above,
        };
        let name = main.map_or_else(|| self.name_of_none(last), |main| self.name(main).to_owned());
        *out += &placed(Tag::new(depth, "body").word("name", &name), &(above.inverse() * axes), self.error).open();
        joints.iter().for_each(|&k| self.joint(k, &axes, depth + 1, out));
        match main {
            Some(main) => {
                self.inertial((main, true), &axes, depth + 1, out);
                self.marks(main, &axes, depth + 1, out);
            }
            None => {
                let text = format!("`{name}` has a mass of {LEAST:e} kg, since in MuJoCo nothing without mass moves");
                self.own.parts.lost.push(text);
                let tag = Tag::new(depth + 1, "inertial").word("pos", "0 0 0").number("mass", LEAST);
                *out += &tag.numbers("diaginertia", &[LEAST; 3], 0.0).close();
            }
        }
        self.members(Some(last), (main, &axes), depth + 1, out);
        self.children(Some(last)).into_iter().for_each(|k| self.body(k, &axes, depth + 1, out));
        *out += &format!("{}</body>\n", "  ".repeat(depth));
    }

    /// The name of a body that the scene does not have.
    fn name_of_none(&self, joint: usize) -> String {
        self.free_name(&format!("{}_link", self.own.tree.names[joint]))
    }

    /// A name that no body has: that word, or with a number.
    fn free_name(&self, word: &str) -> String {
        let taken = |word: &String| self.own.scene.bodies.list.iter().any(|own| own.name == *word);
        let numbered = (2..).map(|k| format!("{word}_{k}"));
        std::iter::once(word.to_owned()).chain(numbered).find(|word| !taken(word)).unwrap_or_default()
    }

    /// Bodies, particles and frames that move with a body, or stand still.
    fn members(
        &mut self,
        carrier: Option<usize>,
        (main, axes): (Option<usize>, &Isometry3<f64>),
        depth: usize,
        out: &mut String,
    ) {
        for k in self.carried(carrier, |_| true).into_iter().filter(|k| Some(*k) != main) {
            let name = self.name(k);
            let own = self.own.tree.places[k];
            let place = axes.inverse() * own;
            if self.own.scene.bodies.list[k].kind == LinkKind::Frame {
                if name != "world" {
                    *out += &placed(Tag::new(depth, "site").word("name", name), &place, self.error).close();
                }
                self.marks(k, axes, depth, out);
                continue;
            }
            *out += &placed(Tag::new(depth, "body").word("name", name), &place, self.error).open();
            self.inertial((k, false), &own, depth + 1, out);
            self.marks(k, &own, depth + 1, out);
            *out += &format!("{}</body>\n", "  ".repeat(depth));
        }
    }

    fn inertial(&mut self, (body, is_carrier): (usize, bool), axes: &Isometry3<f64>, depth: usize, out: &mut String) {
        let own = masses::taken(
            &self.own.scene,
            &self.own.tree,
            (body, is_carrier),
            &self.own.masses[body],
            &mut self.own.parts.lost,
        );
        let MassData { mass, center, inertia } = match own {
            Ok(own) => own,
            Err(mistake) => return self.own.parts.mistakes.push(mistake),
        };
        let seen = axes.inverse() * self.own.tree.places[body];
        // The inertia may be a difference of that about O and that of the centre of mass.
        let error = 4e-16 * (inertia.amax() + mass * center.norm_squared());
        let center = seen.rotation * center + seen.translation.vector;
        let turn = seen.rotation.to_rotation_matrix();
        let is_turned = seen.rotation.angle() > 4.0 * OF_TURNS;
        let inertia: Matrix3<f64> = if is_turned { turn * inertia * turn.transpose() } else { inertia };
        let [xx, yy, zz, xy, xz, yz] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|place| inertia[place]);
        let at = if is_turned || seen.translation.vector.amax() > 0.0 { self.error } else { 0.0 };
        let tag = Tag::new(depth, "inertial").numbers("pos", center.iter(), at).number("mass", mass);
        let tag = match [xy, xz, yz].iter().all(|x| x.abs() <= error) {
            true if xx.min(yy).min(zz) <= error => tag.numbers("diaginertia", &[xx, yy, zz], 0.0),
            true => tag.numbers("diaginertia", &[xx, yy, zz], error),
            false => tag.numbers("fullinertia", &[xx, yy, zz, xy, xz, yz], error),
        };
        *out += &tag.close();
    }

    fn has_marks(&self, body: usize) -> bool {
        self.has_motors(body)
            || self.own.parts.closures.iter().any(|own| own.bodies.contains(&Some(body)))
            || self.own.parts.contacts.iter().flat_map(SphereContact::spheres).any(|(_, own)| own.body == body)
    }

    fn has_motors(&self, body: usize) -> bool {
        let acts = |on: &Transmission| matches!(on, Transmission::Site { body: own, .. } if *own == body);
        self.own.parts.motors.iter().any(|motor| acts(&motor.on))
    }

    /// Sites where motors act on a body, and its spheres that touch.
    fn marks(&self, body: usize, axes: &Isometry3<f64>, depth: usize, out: &mut String) {
        let seen = axes.inverse() * self.own.tree.places[body];
        if self.has_motors(body) {
            let tag = Tag::new(depth, "site").word("name", format!("{}_motors", self.name(body)));
            *out += &placed(tag, &seen, self.error).close();
        }
        *out += &self.ends_of_loops(Some(body), &seen, depth);
        let spheres = self.own.parts.contacts.iter().flat_map(SphereContact::spheres);
        for (name, own) in spheres.filter(|(_, own)| own.body == body) {
            let at = seen.rotation * Vector3::from(own.center) + seen.translation.vector;
            let tag = Tag::new(depth, "geom").word("name", name).word("type", "sphere");
            *out += &tag.numbers("pos", at.iter(), self.error).number("size", own.radius.unwrap_or(POINT)).close();
        }
    }

    fn joint(&mut self, k: usize, axes: &Isometry3<f64>, depth: usize, out: &mut String) {
        let (name, own) = (&self.own.tree.names[k], &self.own.parts.joints[k]);
        let tag = Tag::new(depth, "joint").word("name", name);
        let along =
            |tag: Tag, axis: &Vector3<f64>| tag.numbers("axis", (axes.rotation.inverse() * axis).iter(), OF_TURNS);
        let mut tag = match &self.own.tree.joints[k].motion {
            Motion::Hinge { axis, anchor } => {
                // The point of the axis that is nearest to the body.
                let arm = anchor - axes.translation.vector;
                let at = axes.rotation.inverse() * (arm - axis * axis.dot(&arm));
                let tag = along(tag.word("type", "hinge"), axis);
                if at.amax() > self.error { tag.numbers("pos", at.iter(), self.error) } else { tag }
            }
            Motion::Slide { axis } => along(tag.word("type", "slide"), axis),
            Motion::Ball(_) => tag.word("type", "ball"),
            Motion::Free(_) if self.own.tree.parents[k].is_none() => tag.word("type", "free"),
            Motion::Free(_) => {
                let text = format!("`{}` is a pose below another joint, where MuJoCo has no free joint", name);
                return self.own.parts.mistakes.push(text);
            }
        };
        if own.stiffness > 0.0 {
            tag = tag.number("stiffness", own.stiffness).some("springref", own.force / own.stiffness);
        }
        tag = tag.some("damping", own.damping).some("armature", own.armature).some("frictionloss", own.friction_loss);
        if own.range != [None; 2] {
            tag = tag.numbers("range", &[own.range[0].unwrap_or(-FAR), own.range[1].unwrap_or(FAR)], 0.0);
        }
        *out += &tag.close();
        if own.range.iter().flatten().count() == 1 {
            let text = format!("the range of `{}` has one side; the other is {FAR:e}", name);
            self.own.parts.lost.push(text);
        }
    }

    fn tendons(&self) -> String {
        let mut out = String::new();
        for own in &self.own.parts.tendons {
            let mut tag = Tag::new(2, "fixed").word("name", &own.name);
            if own.stiffness > 0.0 {
                tag = tag.number("stiffness", own.stiffness).number("springlength", own.length);
            }
            out += &tag.some("damping", own.damping).open();
            for (k, coefficient) in &own.coefficients {
                let joint = &self.own.scene.variables[*k].name;
                out += &Tag::new(3, "joint").word("joint", joint).number("coef", *coefficient).close();
            }
            out += "    </fixed>\n";
        }
        out
    }

    /// Joints that follow others, and loops.
    fn equalities(&self) -> String {
        let JointTree { names, .. } = &self.own.tree;
        let equality = |(place, joint): (usize, &Joint)| {
            let tag = Tag::new(2, "joint").word("name", &names[place]).word("joint1", &names[place]);
            tag.word("joint2", &names[joint.variable])
                .numbers("polycoef", &[0.0, joint.ratio, 0.0, 0.0, 0.0], 0.0)
                .close()
        };
        let follows = self.own.tree.followers().map(equality);
        let connect = |k: usize| {
            let tag = Tag::new(2, "connect").word("name", self.name_of_loop(k));
            tag.word("site1", self.name_of_end(k, 0)).word("site2", self.name_of_end(k, 1)).close()
        };
        follows.chain((0..self.own.parts.closures.len()).map(connect)).collect()
    }

    fn name_of_loop(&self, k: usize) -> String {
        self.free_name(&format!("loop_{}", k + 1))
    }

    fn name_of_end(&self, k: usize, end: usize) -> String {
        self.free_name(&format!("loop_{}_{}", k + 1, ["from", "to"][end]))
    }

    /// Points of loops on a body, or on what stands still.
    fn ends_of_loops(&self, body: Option<usize>, seen: &Isometry3<f64>, depth: usize) -> String {
        let mut out = String::new();
        for (k, own) in self.own.parts.closures.iter().enumerate() {
            for end in (0..2).filter(|&end| own.bodies[end] == body) {
                let at = seen.rotation * Vector3::from(own.points[end]) + seen.translation.vector;
                let tag = Tag::new(depth, "site").word("name", self.name_of_end(k, end));
                out += &tag.numbers("pos", at.iter(), self.error).close();
            }
        }
        out
    }

    fn motors(&self) -> String {
        let motor = |own: &Motor| {
            let tag = Tag::new(2, "motor").word("name", &own.name);
            let tag = match &own.on {
                Transmission::Tendon { name } => tag.word("tendon", name),
                Transmission::Joint { variable, gear } => {
                    tag.word("joint", &self.own.scene.variables[*variable].name).numbers("gear", gear, 0.0)
                }
                Transmission::Site { body, gear } => {
                    tag.word("site", format!("{}_motors", self.name(*body))).numbers("gear", gear, 0.0)
                }
            };
            tag.close()
        };
        self.own.parts.motors.iter().map(motor).collect()
    }

    /// Planes, each once.
    fn planes(&self) -> String {
        let plane = |(k, own): (usize, &SphereContact)| match own.other {
            Obstacle::Plane { normal, height } if self.plane(k, (normal, height)) == k => {
                let at = Vector3::from(normal) * height;
                let tag = Tag::new(2, "geom").word("name", format!("{}_plane", own.name)).word("type", "plane");
                let tag = tag.word("size", "0 0 1").numbers("pos", at.iter(), self.error);
                Some(tag.numbers("zaxis", &normal, OF_TURNS).close())
            }
            _ => None,
        };
        self.own.parts.contacts.iter().enumerate().filter_map(plane).collect()
    }

    /// The first contact with the same plane, up to one.
    fn plane(&self, k: usize, (normal, height): ([f64; 3], f64)) -> usize {
        let is_same = |other: &usize| match self.own.parts.contacts[*other].other {
            Obstacle::Plane { normal: own, height: at } => {
                (Vector3::from(own) - Vector3::from(normal)).norm() + (at - height).abs() <= ROUNDING
            }
            Obstacle::Sphere(_) => false,
        };
        (0..k).find(is_same).unwrap_or(k)
    }

    fn pairs(&self) -> String {
        let pair = |(k, own): (usize, &SphereContact)| {
            let other = match own.other {
                Obstacle::Plane { normal, height } => {
                    format!("{}_plane", self.own.parts.contacts[self.plane(k, (normal, height))].name)
                }
                Obstacle::Sphere(_) => format!("{}_other", own.name),
            };
            let tag = Tag::new(2, "pair").word("name", &own.name).word("geom1", other).word("geom2", &own.name);
            match own.friction {
                mu if mu > 0.0 => tag.word("condim", 3).numbers("friction", &[mu, mu], 0.0).close(),
                _ => tag.word("condim", 1).close(),
            }
        };
        self.own.parts.contacts.iter().enumerate().map(pair).collect()
    }
}

/// `pos` and `quat`, of what is not at the origin and not upright.
fn placed(mut tag: Tag, pose: &Isometry3<f64>, error: f64) -> Tag {
    if pose.translation.vector.amax() > error {
        tag = tag.numbers("pos", pose.translation.vector.iter(), error);
    }
    if pose.rotation.angle() > 4.0 * OF_TURNS {
        let Quaternion { coords } = pose.rotation.quaternion();
        tag = tag.numbers("quat", &[coords.w, coords.x, coords.y, coords.z], OF_TURNS);
    }
    tag
}
