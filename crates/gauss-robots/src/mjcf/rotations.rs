//! The ways in which MJCF writes rotations.

use roxmltree::Node;

use crate::rotation::{Matrix, Rotation, Triple, about, direction, multiply, of_quaternion};
use crate::xml::Reading;

/// The attributes that write a rotation.
pub const ORIENTATION: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// Units and conventions of the angles in a file.
pub struct Angles {
    /// Size of a unit of angle in radians.
    pub unit: f64,
    /// The axes of `euler`, in the order in which they are turned about; `fixed` are those of the parent.
    sequence: [usize; 3],
    fixed: bool,
}

impl Angles {
    pub fn read<'a>(root: Node<'a, 'a>, reading: &mut Reading<'a>) -> Self {
        let mut angles = Angles { unit: std::f64::consts::PI / 180.0, sequence: [0, 1, 2], fixed: false };
        for compiler in reading.children(root, "compiler") {
            match reading.text(compiler, "angle") {
                Some("radian") => angles.unit = 1.0,
                Some("degree") | None => {}
                Some(word) => reading.fault(compiler, format!("an angle is in `radian` or `degree`, found `{word}`")),
            }
            let Some(word) = reading.text(compiler, "eulerseq") else { continue };
            let axes: Vec<usize> = word.chars().filter_map(|c| "xyz".find(c.to_ascii_lowercase())).collect();
            let fixed = word.chars().all(|c| c.is_ascii_uppercase());
            match <[usize; 3]>::try_from(axes) {
                Ok(sequence) if fixed || word.chars().all(|c| c.is_ascii_lowercase()) => {
                    (angles.sequence, angles.fixed) = (sequence, fixed);
                }
                _ => reading.fault(compiler, format!("`eulerseq` is three of x y z, or of X Y Z, found `{word}`")),
            }
        }
        angles
    }

    /// The rotation of an element, the identity if the element gives none.
    pub fn of<'a>(&self, node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Rotation {
        let matrix = if let Some(quaternion) = reading.numbers::<4>(node, "quat") {
            of_quaternion(quaternion)
        } else if let Some([x, y, z, angle]) = reading.numbers::<4>(node, "axisangle") {
            let half = angle * self.unit / 2.0;
            direction([x, y, z])
                .and_then(|n| of_quaternion([half.cos(), n[0] * half.sin(), n[1] * half.sin(), n[2] * half.sin()]))
        } else if let Some(angles) = reading.numbers::<3>(node, "euler") {
            Some(self.of_sequence(angles))
        } else if let Some([a, b, c, d, e, f]) = reading.numbers::<6>(node, "xyaxes") {
            of_axes([a, b, c], [d, e, f])
        } else if let Some(axis) = reading.numbers::<3>(node, "zaxis") {
            to_direction(axis)
        } else {
            return Rotation::none();
        };
        match matrix {
            Some(matrix) => Rotation::from_matrix(&matrix),
            None => {
                reading.fault(node, "its rotation has no direction");
                Rotation::none()
            }
        }
    }

    /// Turns by angles as they are written, about the axes of the sequence.
    pub fn of_sequence(&self, angles: Triple) -> Matrix {
        let mut matrix = Rotation::none().matrix;
        for (axis, angle) in self.sequence.into_iter().zip(angles) {
            let turn = about(axis, crate::rotation::settled(angle * self.unit));
            matrix = if self.fixed { multiply(&turn, &matrix) } else { multiply(&matrix, &turn) };
        }
        matrix
    }
}

/// The least turn that brings the third axis to a direction; about the first where that is opposite.
pub fn to_direction(axis: Triple) -> Option<Matrix> {
    let [x, y, z] = direction(axis)?;
    let across = x.hypot(y);
    if across == 0.0 {
        return of_quaternion(if z < 0.0 { [0.0, 1.0, 0.0, 0.0] } else { [1.0, 0.0, 0.0, 0.0] });
    }
    let half = across.atan2(z) / 2.0;
    of_quaternion([half.cos(), -y / across * half.sin(), x / across * half.sin(), 0.0])
}

/// The first axis, and another that spans a plane with it.
fn of_axes(x: Triple, y: Triple) -> Option<Matrix> {
    let x = direction(x)?;
    let along: f64 = (0..3).map(|i| x[i] * y[i]).sum();
    let y = direction(std::array::from_fn(|i| y[i] - along * x[i]))?;
    let z: Triple = std::array::from_fn(|i| x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3]);
    Some(std::array::from_fn(|i| [x[i], y[i], z[i]]))
}
