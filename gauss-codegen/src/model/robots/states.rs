//! States with names, and bodies that fields of the struct stand for, with the values of the file.

use proc_macro2::Ident;
use quote::format_ident;
use syn::ext::IdentExt;

use super::clauses::Robot;
use super::drives::{DriveTarget, RobotInput};
use crate::model::scene::clauses::CoordinateKind;
use crate::terms::{BodyOfFile, StateOfFile, ValueOfState};
use gauss_robots::description::{JointKind, Posture};
use gauss_robots::rotation::{Matrix, Rotation, Triple, turned};

/// The state of the file while nothing is turned or moved.
const START: &str = "start";

impl Robot<'_> {
    /// State in which the file has everything at first, unless that is at zero; then its states with names.
    pub fn states(&self) -> Vec<StateOfFile> {
        let joints = &self.description.joints;
        let start = Posture { name: START.to_owned(), ..Posture::default() };
        let moved = joints.iter().any(|joint| joint.reference != 0.0 || joint.start != ([0.0; 3], Rotation::none()));
        let all = moved.then_some(&start).into_iter().chain(&self.description.postures);
        let mut taken = ["of", "q", "z", "default", "clone"].map(str::to_owned).to_vec();
        all.map(|posture| self.state(posture, &mut taken)).collect()
    }

    fn state(&self, posture: &Posture, taken: &mut Vec<String>) -> StateOfFile {
        let free = super::names::free(&posture.name, "state", |word| !taken.iter().any(|known| known == word));
        taken.push(free.clone());
        let mut values: Vec<(Ident, ValueOfState)> = Vec::new();
        let joints = self.description.joints.iter().zip(&self.coordinates).enumerate();
        for (_, (joint, own)) in joints.filter(|(index, _)| !self.driven.contains(index)) {
            let find =
                |all: &[(String, Vec<f64>)]| all.iter().find(|(name, _)| *name == joint.name).map(|(_, v)| v.clone());
            let [q] = own.as_slice() else { continue };
            // A posture without a value for a joint has the joint at its start.
            let place = find(&posture.values).unwrap_or_else(|| at_start(joint.kind, joint.reference, &joint.start));
            let speed = |end: &str| format_ident!("{}_{}", q.ident.unraw(), end, span = q.ident.span());
            let rate = find(&posture.rates);
            match (q.kind, place.as_slice()) {
                (CoordinateKind::Scalar, [value]) => values.push((q.ident.clone(), ValueOfState::Scalar(*value))),
                (CoordinateKind::Rotation, [w, x, y, z]) => {
                    values.push((q.ident.clone(), ValueOfState::Rotation([*w, *x, *y, *z])));
                }
                (CoordinateKind::Pose, [a, b, c, w, x, y, z]) => {
                    values.push((q.ident.clone(), ValueOfState::Pose([*a, *b, *c], [*w, *x, *y, *z])));
                }
                _ => {}
            }
            match (q.kind, rate.as_deref()) {
                (CoordinateKind::Scalar, Some([value])) => values.push((speed("dot"), ValueOfState::Scalar(*value))),
                (CoordinateKind::Rotation, Some([x, y, z])) => {
                    values.push((speed("omega"), ValueOfState::Vector([*x, *y, *z])));
                }
                (CoordinateKind::Pose, Some([a, b, c, x, y, z])) => {
                    values.push((speed("u"), ValueOfState::Vector(in_own_axes(&place, &[*a, *b, *c]))));
                    values.push((speed("omega"), ValueOfState::Vector([*x, *y, *z])));
                }
                _ => {}
            }
        }
        let control = |input: &RobotInput| match input.of {
            DriveTarget::Drive(drive) => posture.controls.iter().find(|(of, _)| *of == drive).map(|(_, value)| *value),
            DriveTarget::Joint(_) => None,
        };
        let inputs =
            self.inputs.iter().filter_map(|input| Some((input.name.called.clone(), control(input)?))).collect();
        StateOfFile { name: Ident::new(&free, self.writer.span), written: posture.name.clone(), values, inputs }
    }

    /// The mass data that the file has for bodies that are fields.
    pub fn bodies_of_file(&self) -> Vec<BodyOfFile> {
        let own = |link: usize| {
            let inertial = self.description.links[link].inertial;
            let (mass, center, inertia) =
                inertial.map_or((0.0, [0.0; 3], [[0.0; 3]; 3]), |i| (i.mass, i.center, i.inertia));
            BodyOfFile { field: self.links[link].clone(), mass, center, inertia }
        };
        (0..self.links.len()).filter(|&link| self.in_field[link]).map(own).collect()
    }
}

/// The coordinates of a joint at the start, where nothing is turned or moved.
fn at_start(kind: JointKind, reference: f64, (position, rotation): &(Triple, Rotation)) -> Vec<f64> {
    match kind {
        JointKind::Turning | JointKind::Sliding => vec![reference],
        JointKind::Ball => vec![1.0, 0.0, 0.0, 0.0],
        JointKind::Floating => position.iter().copied().chain(quaternion(&rotation.matrix)).collect(),
        JointKind::Fixed | JointKind::Planar => Vec::new(),
    }
}

/// (w, x, y, z) of a rotation matrix, by its largest component.
fn quaternion(r: &Matrix) -> [f64; 4] {
    let trace = r[0][0] + r[1][1] + r[2][2];
    let squares = [1.0 + trace, 1.0 + 2.0 * r[0][0] - trace, 1.0 + 2.0 * r[1][1] - trace, 1.0 + 2.0 * r[2][2] - trace];
    let largest = (0..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    // Four times the products of the largest component with each.
    let (x, y, z) = (r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]);
    let (xy, yz, zx) = (r[0][1] + r[1][0], r[1][2] + r[2][1], r[2][0] + r[0][2]);
    let products = match largest {
        0 => [squares[0], x, y, z],
        1 => [x, squares[1], xy, zx],
        2 => [y, xy, squares[2], yz],
        _ => [z, zx, yz, squares[3]],
    };
    let length = products.iter().map(|c| c * c).sum::<f64>().sqrt();
    products.map(|c| c / length)
}

/// Rᵀ v.
fn in_own_axes(pose: &[f64], v: &Triple) -> Triple {
    let [_, _, _, w, x, y, z] = pose else { return *v };
    let square = w * w + x * x + y * y + z * z;
    let r = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    let transposed: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| r[j][i] / square));
    turned(&transposed, v)
}
