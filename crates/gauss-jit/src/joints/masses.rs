//! Velocities of bodies by rates of joints, and armatures, which are what the mass matrix has beyond that of bodies.

use gauss_runtime::nalgebra::{DMatrix, DVector, Matrix3xX, Vector3};

use super::motions::{Motion, ROUNDING};
use super::numbers::{MassData, SceneNumbers, Sequence, Value, are_small, shortest};
use super::tree::JointTree;

/// States of general position at which laws are tried.
pub const STATES: usize = 4;

/// Velocities of the O of a body and its angular velocities by the rates of joints, observer's axes, at its place.
pub fn jacobian(tree: &JointTree, body: usize, values: &[Value], scene: &SceneNumbers) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(6, scene.rates());
    let at = tree.place(body, values).translation.vector;
    // Of several joints that one coordinate moves all count.
    let mut add = |column: usize, linear: Vector3<f64>, angular: Vector3<f64>| {
        let mut own = matrix.fixed_view_mut::<3, 1>(0, column);
        own += linear;
        let mut own = matrix.fixed_view_mut::<3, 1>(3, column);
        own += angular;
    };
    for k in tree.way(tree.carriers[body]) {
        let before = tree.displacement(tree.parents[k], values);
        let joint = &tree.joints[k];
        let (first, ratio) = (scene.variables[joint.variable].rate, joint.ratio);
        let units = [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().enumerate();
        match (&joint.motion, values[joint.variable]) {
            (Motion::Slide { axis }, _) => add(first, before.rotation * axis * ratio, Vector3::zeros()),
            (Motion::Hinge { axis, anchor }, _) => {
                let (axis, arm) = (before.rotation * axis, at - (before.rotation * anchor + before.translation.vector));
                add(first, axis.cross(&arm) * ratio, axis * ratio);
            }
            (Motion::Ball(axes), Value::Rotation(turn)) => {
                let moved = before * axes * turn;
                units.for_each(|(i, unit)| {
                    let axis = moved.rotation * unit;
                    add(first + i, axis.cross(&(at - moved.translation.vector)), axis);
                });
            }
            (Motion::Free(axes), Value::Pose(pose)) => {
                let (still, moved) = (before * axes, before * axes * pose);
                units.for_each(|(i, unit)| {
                    add(first + i, still.rotation * unit, Vector3::zeros());
                    let axis = moved.rotation * unit;
                    add(first + 3 + i, axis.cross(&(at - moved.translation.vector)), axis);
                });
            }
            // No motion has a value of another kind.
            _ => {}
        }
    }
    matrix
}

/// The armature of each rate: what the mass matrix has beyond that of the masses.
///
/// # Errors
/// A sentence for each thing that has inertia beside bodies and armatures.
pub fn armatures(scene: &SceneNumbers, tree: &JointTree, masses: &[MassData]) -> Result<Vec<f64>, Vec<String>> {
    let list = &scene.bodies.list;
    let mistake = |own: &gauss_codegen::LinkData| {
        let name = &own.name;
        let fluid = "a fluid acts (`added_mass`, `displaced_mass`), in another way than MuJoCo's fluids";
        own.in_fluid
            .then(|| format!("on `{name}` {fluid}"))
            .or(own.deforms.then(|| format!("`{name}` deforms (`modes`), which no body of MJCF does")))
            .or(own.varies.then(|| format!("the mass of `{name}` varies with the time, and a file has numbers")))
    };
    let mistakes: Vec<String> = list.iter().filter_map(mistake).collect();
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let refused = |text: &str| Err(vec![text.to_owned()]);
    let mut sequence = Sequence::new();
    let mut own: Option<Vec<f64>> = None;
    for _ in 0..STATES {
        let values = scene.sample(&mut sequence);
        if scene.drifts(&values) {
            return refused("coordinates move while all speeds are 0 (`kinematics`)");
        }
        let Some(mut rest) = scene.mass_matrix(&values) else {
            return refused(
                "the speeds do not determine the rates of the joints: velocities are constrained \
                 (`constraint(velocity = …)`, `independent`, `motion`)",
            );
        };
        let size = rest.amax();
        (0..list.len()).for_each(|body| rest -= mass_matrix(scene, tree, &masses[body], (body, &values)));
        let diagonal: Vec<f64> =
            rest.diagonal().iter().map(|&a| if a.abs() <= ROUNDING * size { 0.0 } else { a }).collect();
        rest.set_diagonal(&DVector::zeros(diagonal.len()));
        let is_same = |before: &Vec<f64>| before.iter().zip(&diagonal).all(|(a, b)| (a - b).abs() <= ROUNDING * size);
        if !(are_small(rest.iter(), ROUNDING * size)
            && own.as_ref().is_none_or(is_same)
            && diagonal.iter().all(|a| *a >= 0.0))
        {
            return refused(
                "the kinetic energy has more than that of bodies and of an armature at each joint, such as a \
                 rotor that several joints turn",
            );
        }
        own = own.or(Some(diagonal.iter().map(|a| shortest(*a, 1e-14 * size)).collect()));
    }
    Ok(own.unwrap_or_default())
}

fn mass_matrix(
    scene: &SceneNumbers,
    tree: &JointTree,
    data: &MassData,
    (body, values): (usize, &[Value]),
) -> DMatrix<f64> {
    let rotation = tree.place(body, values).rotation.to_rotation_matrix();
    let rows = jacobian(tree, body, values, scene);
    let angular: Matrix3xX<f64> = Matrix3xX::from_fn(rows.ncols(), |i, j| rows[(3 + i, j)]);
    let arm = (rotation * data.center).cross_matrix();
    let linear: Matrix3xX<f64> = Matrix3xX::from_fn(rows.ncols(), |i, j| rows[(i, j)]) - arm * &angular;
    let inertia = rotation.matrix() * data.inertia * rotation.matrix().transpose();
    let sum = linear.transpose() * &linear * data.mass + angular.transpose() * (inertia * &angular);
    DMatrix::from_fn(rows.ncols(), rows.ncols(), |i, j| sum[(i, j)])
}
