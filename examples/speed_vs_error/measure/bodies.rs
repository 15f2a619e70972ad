//! One rigid body, derived once for each chart: the fields say what there is, and only that is computed.

use std::error::Error;
use std::rc::Rc;

use gauss_exact::TopError;
use gauss_runtime::prelude::*;

use super::baselines::baselines;
use super::by_hand::{self, body_state, coordinates};
use super::entry::{Entry, Kernel, Setup};
use super::free_motion::{FreeBody, free_motions};
use super::methods::{exact_top, explicit, further, jacobians, left_invariant, series, splitting};
use super::scene::{Scene, Target, rows};

/// A body in every chart, and `add`, which adds all methods on all charts.
macro_rules! every_chart {
    ($(#[$about:meta])* $module:ident, [$($clauses:tt)*], $fields:tt) => {
        $(#[$about])*
        mod $module {
            use super::*;

            every_chart!(@one Left, [left_invariant, taylor, linearize], [$($clauses)*], $fields);
            every_chart!(@one Right, [right_invariant], [$($clauses)*], $fields);
            every_chart!(@one Hybrid, [hybrid], [$($clauses)*], $fields);
            every_chart!(@one Angles, [jet(euler_zyx)], [$($clauses)*], $fields);
        }
    };
    (@one $name:ident, [$($chart:tt)*], [$($clauses:tt)*], { $([$($role:ident)?] $field:ident: $type:ty),* $(,)? }) => {
        #[derive(Clone, Copy, GaussDynamics)]
        #[gauss(chart = $($chart)*, $($clauses)*)]
        pub struct $name {
            $($(#[gauss($role)])? pub $field: $type),*
        }
    };
}

every_chart! {
    /// No force, O the centre of mass.
    free_top, [motion = fixed_point], { [mass] mass: f64, [inertia] inertia: Vector3<f64> }
}

every_chart! {
    /// With weight.
    heavy_top, [motion = fixed_point], {
        [mass] mass: f64, [center_of_mass] center: Vector3<f64>, [inertia] inertia: Vector3<f64>, [gravity] gravity: f64,
    }
}

every_chart! {
    /// With weight, the same whichever way it is turned about e₃.
    symmetric_top, [motion = fixed_point, center_of_mass = [0, 0, height], inertia = [across, across, along]], {
        [mass] mass: f64, [] across: f64, [] along: f64, [] height: f64, [gravity] gravity: f64,
    }
}

every_chart! {
    /// In an ideal fluid, without weight, everything diagonal.
    ideal, [motion = free], { [mass] mass: f64, [inertia] inertia: f64, [added_mass] added: Vector6<f64> }
}

every_chart! {
    /// In an ideal fluid, with weight and buoyancy, everything coupled.
    submerged, [motion = free], {
        [mass] mass: f64,
        [center_of_mass] center: Vector3<f64>,
        [inertia] inertia: Matrix3<f64>,
        [added_mass] added: Matrix6<f64>,
        [gravity] gravity: f64,
        [displaced_mass] displaced: f64,
        [center_of_buoyancy] buoyancy: Vector3<f64>,
    }
}

every_chart! {
    /// Weight, linear drag, and a force of the observer's at a point.
    dragged, [
        motion = free,
        drag(linear = [0.4, 0.4, 0.4, 0.05, 0.05, 0.05]),
        force(push, at = [0.2, 0, 0.1], value = [1, 2, 0.5], axes = observer),
    ], { [mass] mass: f64, [inertia] inertia: Vector3<f64>, [gravity] gravity: f64 }
}

/// Adds a scene in every chart: `$fields` are those of the structs of the module.
macro_rules! add_charts {
    ($module:ident, $fields:tt, $scene:expr, $target:expr, $entries:expr) => {{
        add_charts!(@one $module, Left, "body velocities", $fields, $scene, $target, $entries, further left_invariant series jacobians);
        add_charts!(@one $module, Right, "space velocities", $fields, $scene, $target, $entries);
        add_charts!(@one $module, Hybrid, "hybrid", $fields, $scene, $target, $entries);
        add_charts!(@one $module, Angles, "Euler angles", $fields, $scene, $target, $entries);
    }};
    (
        @one $module:ident, $name:ident, $chart:literal, { $($field:ident),* $(,)? },
        $scene:expr, $target:expr, $entries:expr $(, $($further:ident)+)?
    ) => {{
        let kernel = $module::$name { $($field),* }.kernel()?;
        let setup = setup($chart, kernel, $scene, $target)?;
        explicit($entries, &setup);
        $($($further($entries, &setup);)+)?
    }};
}

fn setup<S: Kernel + RigidBodySystem>(
    chart: &'static str,
    kernel: S,
    scene: &Scene,
    target: &Rc<Target>,
) -> Result<Setup<S>, Box<dyn Error>> {
    let q = kernel.configuration(&scene.pose()?)?;
    let z = kernel.speeds(0.0, &q, &scene.twist()?);
    let place = target.groups() > 1;
    let observe = move |q: &S::Configuration| {
        let pose = kernel.pose(0.0, q);
        let rotation = rows(&pose.rotation);
        if place { vec![rotation, pose.translation.vector.iter().copied().collect()] } else { vec![rotation] }
    };
    Ok(Setup { chart, kernel, start: (q, z), observe: Rc::new(observe), target: Rc::clone(target) })
}

/// Adds a body without force that turns about O.
///
/// # Errors
/// When the data are not those of one.
pub fn free_top(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let (mass, inertia) = (scene.number("parameters/mass")?, principal(scene)?);
    add_charts!(free_top, { mass, inertia }, scene, target, entries);
    let momentum = inertia.component_mul(&scene.vector("initial/body_omega")?);
    let (attitude, end) = (scene.pose()?.rotation, Rc::clone(target));
    free_motions(entries, &FreeBody { moments: inertia, attitude, momentum, target: end });
    let equations = by_hand::FreeTop(by_hand::Top::new(inertia, Vector3::zeros()));
    baselines(entries, "ω and quaternion", equations, top_state(scene)?, target);
    Ok(())
}

/// Adds a heavy top.
///
/// # Errors
/// When the data are not those of one.
pub fn heavy_top(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let (mass, inertia) = (scene.number("parameters/mass")?, principal(scene)?);
    let (center, gravity) = (center(scene)?, scene.number("parameters/gravity")?);
    add_charts!(heavy_top, { mass, center, inertia, gravity }, scene, target, entries);
    let kernel = heavy_top::Left { mass, center, inertia, gravity }.kernel()?;
    let left = setup("body velocities", kernel, scene, target)?;
    splitting(entries, &left)?;
    match exact_top(entries, &left) {
        Ok(()) | Err(TopError::NotOfRevolution) => {}
        Err(error) => return Err(error.into()),
    }
    let equations = by_hand::Top::new(inertia, center * (mass * gravity));
    baselines(entries, "ω and quaternion", equations, top_state(scene)?, target);
    Ok(())
}

/// Adds a heavy top whose centre of mass is on the axis of its symmetry.
///
/// # Errors
/// When the data are not those of one.
pub fn symmetric_top(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let (mass, inertia, center) = (scene.number("parameters/mass")?, principal(scene)?, center(scene)?);
    if inertia.x != inertia.y || center.x != 0.0 || center.y != 0.0 {
        return Err("the top is not symmetric about its third axis".into());
    }
    let (across, along, height, gravity) = (inertia.x, inertia.z, center.z, scene.number("parameters/gravity")?);
    add_charts!(symmetric_top, { mass, across, along, height, gravity }, scene, target, entries);
    let kernel = symmetric_top::Left { mass, across, along, height, gravity }.kernel()?;
    let left = setup("body velocities", kernel, scene, target)?;
    splitting(entries, &left)?;
    exact_top(entries, &left)?;
    let equations = by_hand::SymmetricTop(by_hand::Top::new(inertia, center * (mass * gravity)));
    baselines(entries, "ω and quaternion", equations, top_state(scene)?, target);
    Ok(())
}

/// Adds a body in an ideal fluid without weight.
///
/// # Errors
/// When the data are not those of one.
pub fn ideal(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let diagonal = scene.matrix::<6>("parameters/kinetic_matrix_6x6")?.diagonal();
    // Only the sum of body and fluid matters.
    let (mass, inertia) = (0.4, 0.3);
    let added = diagonal - Vector6::new(mass, mass, mass, inertia, inertia, inertia);
    add_charts!(ideal, { mass, inertia, added }, scene, target, entries);
    let start = body_state(&scene.pose()?, &scene.twist()?);
    baselines(entries, "(u, ω), quaternion, b", by_hand::Ideal::new(diagonal), start, target);
    Ok(())
}

/// Adds a body in an ideal fluid with weight and buoyancy.
///
/// # Errors
/// When the data are not those of one.
pub fn submerged(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let [mass, gravity, displaced] = [
        scene.number("parameters/mass")?,
        scene.number("parameters/gravity")?,
        scene.number("parameters/displaced_mass")?,
    ];
    let (center, buoyancy) = (center(scene)?, scene.vector("parameters/buoyancy_point")?);
    let of_body = |inertia: Matrix3<f64>| {
        let lever = center.cross_matrix() * mass;
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * mass));
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
        matrix
    };
    let (inertia, added, kinetic) = match scene.matrix::<6>("parameters/kinetic_matrix_6x6") {
        // Only the sum of body and fluid matters: a body that is nearly a point at G.
        Ok(kinetic) => {
            let inertia = Matrix3::identity() * 0.1 - center.cross_matrix() * center.cross_matrix() * mass;
            (inertia, kinetic - of_body(inertia), kinetic)
        }
        Err(_) => {
            let inertia = scene.matrix::<3>("parameters/inertia_about_O")?;
            let added = scene.matrix::<6>("parameters/added_mass_6x6")?;
            (inertia, added, of_body(inertia) + added)
        }
    };
    add_charts!(
        submerged,
        { mass, center, inertia, added, gravity, displaced, buoyancy },
        scene,
        target,
        entries
    );
    let moment = (center * mass - buoyancy * displaced) * gravity;
    let equations = by_hand::Submerged::new(kinetic, (mass - displaced) * gravity, moment, target.groups() > 1)
        .ok_or("the kinetic matrix has no inverse")?;
    let start = body_state(&scene.pose()?, &(kinetic * scene.twist()?));
    baselines(entries, "momenta, quaternion, b", equations, start, target);
    Ok(())
}

/// Adds the body with drag.
///
/// # Errors
/// When the data are not those of it.
pub fn dragged(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Result<(), Box<dyn Error>> {
    let (mass, inertia, gravity) =
        (scene.number("parameters/mass")?, principal(scene)?, scene.number("parameters/gravity")?);
    add_charts!(dragged, { mass, inertia, gravity }, scene, target, entries);
    let equations = by_hand::Dragged::new(mass, inertia.into(), gravity);
    let start = body_state(&scene.pose()?, &scene.twist()?);
    baselines(entries, "(u, ω), quaternion, b", equations, start, target);
    Ok(())
}

fn center(scene: &Scene) -> Result<Vector3<f64>, Box<dyn Error>> {
    scene.vector("parameters/centre_of_mass_body_from_O")
}

fn principal(scene: &Scene) -> Result<Vector3<f64>, Box<dyn Error>> {
    Ok(scene.matrix::<3>("parameters/inertia_about_O")?.diagonal())
}

/// ω and the quaternion.
fn top_state(scene: &Scene) -> Result<[f64; 7], Box<dyn Error>> {
    let (omega, [x, y, z, w]) = (scene.vector("initial/body_omega")?, coordinates(&scene.pose()?.rotation));
    Ok([omega.x, omega.y, omega.z, x, y, z, w])
}
