//! Keyframes: states with names.

use roxmltree::Node;

use super::File;
use crate::description::{JointKind, Posture};

/// Numbers of the coordinates and of the rates of a joint.
fn sizes(kind: JointKind) -> [usize; 2] {
    match kind {
        JointKind::Fixed => [0, 0],
        JointKind::Floating => [7, 6],
        JointKind::Ball => [4, 3],
        _ => [1, 1],
    }
}

/// Numbers that say where a joint is, with a quaternion of length one; that of no length is none, as `mju_normalize4`
/// of MuJoCo's `src/engine/engine_util_blas.c` has it.
fn with_turn(kind: JointKind, numbers: &[f64]) -> Vec<f64> {
    const LEAST: f64 = 1e-15;
    let count = if matches!(kind, JointKind::Floating | JointKind::Ball) { 4 } else { 0 };
    let (place, turn) = numbers.split_at(numbers.len() - count);
    let length = turn.iter().fold(0.0, |length: f64, c| length.hypot(*c));
    let unit: Vec<f64> = match length < LEAST {
        true => [1.0, 0.0, 0.0, 0.0].into_iter().take(count).collect(),
        false => turn.iter().map(|c| c / length).collect(),
    };
    [place, &unit].concat()
}

impl<'a> File<'a> {
    pub fn keys(&mut self, section: Node<'a, 'a>) {
        for (index, node) in self.reading.children(section, "key").into_iter().enumerate() {
            let name = self.reading.text(node, "name").map_or(format!("key_{index}"), str::to_owned);
            let [values, rates] = [("qpos", 0), ("qvel", 1)].map(|(word, which)| {
                // An attribute without numbers is as good as none.
                let numbers = self.reading.list(node, word).filter(|numbers| !numbers.is_empty())?;
                let joints = &self.description.joints;
                let expected: usize = joints.iter().map(|joint| sizes(joint.kind)[which]).sum();
                if numbers.len() != expected {
                    let found = numbers.len();
                    self.reading.fault(node, format!("`{word}` is {expected} numbers in this file, found {found}"));
                    return None;
                }
                let mut rest = numbers.as_slice();
                let parts = joints.iter().map(|joint| {
                    let (own, after) = rest.split_at(sizes(joint.kind)[which]);
                    rest = after;
                    let own = if which == 0 { with_turn(joint.kind, own) } else { own.to_vec() };
                    (joint.name.clone(), own)
                });
                Some(parts.collect::<Vec<_>>())
            });
            let (values, rates) = (values.unwrap_or_default(), rates.unwrap_or_default());
            let controls = self.reading.list(node, "ctrl").map_or(Vec::new(), |all| self.controls_of(node, &all));
            self.description.postures.push(Posture { name, values, rates, controls });
        }
    }

    /// Drives with their controls; those of actuators that are not read are left out.
    fn controls_of(&mut self, node: Node<'a, 'a>, numbers: &[f64]) -> Vec<(usize, f64)> {
        let (expected, found) = (self.controls.len(), numbers.len());
        if expected != found {
            self.reading.fault(node, format!("`ctrl` is {expected} numbers in this file, found {found}"));
        }
        self.controls.iter().zip(numbers).filter_map(|(drive, value)| Some(((*drive)?, *value))).collect()
    }
}
