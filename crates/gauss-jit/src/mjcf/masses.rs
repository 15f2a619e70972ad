//! Mass data that MuJoCo takes.

use gauss_runtime::nalgebra::{Matrix3, Vector3};

use crate::joints::masses::{STATES, jacobian};
use crate::joints::motions::ROUNDING;
use crate::joints::numbers::{MassData, SceneNumbers, Sequence};
use crate::joints::tree::JointTree;

/// The least mass and moment of inertia that a body with joints has in MuJoCo, some ten times its `mjMINVAL`.
pub const LEAST: f64 = 1e-14;

/// Mass data that MuJoCo takes, in place of those of a body that turns about one axis alone, or not at all, or has
/// none. Whatever of it changes the motion is told.
///
/// # Errors
/// An inertia that no body has, in a sentence.
pub fn taken(
    scene: &SceneNumbers,
    tree: &JointTree,
    (body, is_carrier): (usize, bool),
    data: &MassData,
    lost: &mut Vec<String>,
) -> Result<MassData, String> {
    let name = &scene.bodies.list[body].name;
    let mut data = *data;
    let least = if is_carrier { LEAST } else { 0.0 };
    let moments = data.inertia.symmetric_eigenvalues();
    let (small, large) = (moments.min(), moments.max());
    let holds = moments.sum() - large >= large * (1.0 - ROUNDING);
    if small >= least && holds && data.mass >= least {
        return Ok(data);
    }
    let axes = axes_of_turns(scene, tree, body);
    let first = axes.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or_default();
    let about_one = axes.iter().all(|axis| axis.cross(&first).norm() <= ROUNDING);
    let mut told = false;
    if first.norm() <= ROUNDING {
        data.inertia = Matrix3::identity() * least;
    } else if about_one {
        let axis = first.normalize();
        let moment = axis.dot(&(data.inertia * axis));
        told = moment < least;
        data.inertia = Matrix3::identity() * moment.max(least);
    } else if holds || large <= LEAST {
        told = true;
        data.inertia += Matrix3::identity() * (least - small.min(0.0));
    } else {
        return Err(format!("the inertia of `{name}` breaks the triangle inequality, which MuJoCo does not waive"));
    }
    if data.mass < least {
        data.mass = least;
        told = true;
    }
    if told && least > 0.0 {
        lost.push(format!(
            "`{name}` has {least:e} kg or kg m² in the place of 0: MuJoCo wants mass and inertia of what moves"
        ));
    }
    Ok(data)
}

/// Angular velocities by rates of joints, in the axes of the body.
fn axes_of_turns(scene: &SceneNumbers, tree: &JointTree, body: usize) -> Vec<Vector3<f64>> {
    let mut sequence = Sequence::new();
    let mut axes = Vec::new();
    for _ in 0..STATES {
        let values = scene.sample(&mut sequence);
        let place = tree.place(body, &values);
        // The axes of a particle have no meaning: they stay those of what carries it.
        let columns = jacobian(tree, body, &values, scene);
        let column =
            |k: usize| place.rotation.inverse() * Vector3::new(columns[(3, k)], columns[(4, k)], columns[(5, k)]);
        axes.extend((0..columns.ncols()).map(column));
    }
    axes
}
