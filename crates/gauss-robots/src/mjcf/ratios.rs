//! The damping of servos, and springs of joints, that are said by times and ratios.

use roxmltree::Node;

use super::File;
use crate::description::{Description, JointKind};
use crate::rotation::{Triple, turned};
use crate::structure::{Structure, placed};
use crate::xml::shown;

impl<'a> File<'a> {
    /// The damping 2 r √(k m), a ratio r of that at which what has this stiffness does not overshoot. As m MuJoCo 3 has
    /// the sum of the inertias of the joints at rest, each by itself, by the squares of what the length changes by them
    /// (`mj_setConst`); 4 has the inertia along the length while all joints are free, which is the same of a joint
    /// alone.
    pub fn damping(
        &mut self,
        node: Node<'a, 'a>,
        along: &[(String, f64)],
        (stiffness, ratio): (f64, f64),
    ) -> Option<f64> {
        // What does not fit together is said later.
        let structure = Structure::new(&self.description).ok()?;
        let position = |name: &String| self.description.joints.iter().position(|joint| joint.name == *name);
        let acting = along.iter().filter(|(_, factor)| *factor != 0.0);
        let joints: Option<Vec<(usize, f64)>> = acting.map(|(name, factor)| Some((position(name)?, *factor))).collect();
        let joints = joints?;
        let part =
            |(joint, factor): &(usize, f64)| inertia_at_rest(&structure, &self.description, *joint) / (factor * factor);
        let damping = 2.0 * ratio * (stiffness * joints.iter().map(part).sum::<f64>()).sqrt();
        // What attaches a part may move it.
        let alone = |joint: usize| !self.is_part && moves_alone(&structure, &self.description, joint);
        if !matches!(joints.as_slice(), [(joint, _)] if alone(*joint)) {
            let text = format!(
                "`dampratio` of {} is `kv` = {damping} with the inertia of its joint by itself, as of MuJoCo 3, not of 4: \
                 write `kv`",
                shown(node)
            );
            self.reading.ignored(node, text);
        }
        Some(damping)
    }

    /// `springdamper="T r"`: the stiffness m/(T r)² and the damping 2 m/T, with the inertia m of the joint at rest
    /// while all others are free, as `AutoSpringDamper` of MuJoCo's `src/user/user_model.cc` has it.
    pub fn tune(&mut self) {
        if self.tuned.is_empty() {
            return;
        }
        let Ok(structure) = Structure::new(&self.description) else { return };
        for (node, name, [time, ratio]) in std::mem::take(&mut self.tuned) {
            let joints = &mut self.description.joints;
            let Some(joint) = joints.iter().position(|joint| joint.name == name) else { continue };
            if joints[joint].kind.is_scalar() && !self.is_part && moves_alone(&structure, &self.description, joint) {
                let inertia = inertia_at_rest(&structure, &self.description, joint);
                let joint = &mut self.description.joints[joint];
                (joint.stiffness, joint.damping) = (inertia / (time * ratio).powi(2), 2.0 * inertia / time);
            } else {
                let text = format!(
                    "`springdamper` of {} is read of joints that move alone; write the `stiffness` and `damping` that MuJoCo \
                     makes of it (`jnt_stiffness`, `dof_damping`)",
                    shown(node)
                );
                self.reading.ignored(node, text);
            }
        }
    }
}

/// Links up to the root.
fn chain(structure: &Structure, link: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(link), |&link| structure.parent_of[link])
}

/// The inertia of the rate of a joint with one coordinate while no joint is turned or moved: of all that hangs on it,
/// about or along its axis, with its own.
fn inertia_at_rest(structure: &Structure, description: &Description, joint: usize) -> f64 {
    let Some(child) = structure.joint_of.iter().position(|own| *own == Some(joint)) else { return 0.0 };
    let joint = &description.joints[joint];
    let (origin, axes) = structure.at_rest(description, child);
    let axis = turned(&axes, &joint.axis);
    let carried = (0..description.links.len()).filter(|&link| chain(structure, link).any(|other| other == child));
    let of = |link: usize| {
        let own = placed(description.links[link].inertial?, &structure.at_rest(description, link));
        let arm: Triple = std::array::from_fn(|i| own.center[i] - origin[i]);
        let along = dot(&axis, &arm);
        Some(match joint.kind {
            JointKind::Sliding => own.mass,
            _ => dot(&axis, &turned(&own.inertia, &axis)) + own.mass * (dot(&arm, &arm) - along * along),
        })
    };
    joint.armature + carried.filter_map(of).sum::<f64>()
}

/// Tells whether all that hangs on a joint moves by that alone, so that what it hangs on does not move.
fn moves_alone(structure: &Structure, description: &Description, joint: usize) -> bool {
    let joints = |link: usize| {
        let all = chain(structure, link).filter_map(|link| structure.joint_of[link]);
        all.filter(|&own| description.joints[own].kind != JointKind::Fixed)
    };
    let mut with = (0..description.links.len()).filter(|&link| joints(link).any(|own| own == joint));
    with.all(|link| joints(link).count() == 1)
}

fn dot(a: &Triple, b: &Triple) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
