//! Sources of the values of the input during a run.

use core::cell::Cell;

use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// Source of the values of the input during a run: a closure
/// ([`Simulation::input`](crate::integrate::Simulation::input)), or a type of your own
/// ([`Simulation::input_from`](crate::integrate::Simulation::input_from)). It is called at every stage of every step,
/// also of steps that are rejected: its value should depend on the arguments only, and smoothly. What changes something
/// when it is called, as an integral does, is a [`Controller`](crate::integrate::Controller).
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
A wrench that depends on the state, in the frame and at the pole that the scene declares:

```
use gauss_runtime::prelude::*;

/// A vehicle in free space with thrusters that can push and turn it anywhere.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation),
    input(push: Vector3, turn: Vector3),
    force(body = hull, value = push, axes = observer),
    torque(body = hull, value = turn, axes = observer),
)]
struct Vehicle {
    #[gauss(body)]
    hull: RigidBody<f64>,
}

/// Draws O to a place and stops turning. Components in the observer's axes k, pole O, as declared in the scene.
struct StationKeeping {
    place: Vector3<f64>,
    stiffness: f64,
    damping: f64,
}

impl InputSource<VehicleKernel> for StationKeeping {
    fn input(&self, _t: f64, pose: &Isometry3<f64>, z: &SVector<f64, 6>) -> SVector<f64, 6> {
        // z is the twist (u, ω) in body axes.
        let (u, omega) = (Vector3::new(z[0], z[1], z[2]), Vector3::new(z[3], z[4], z[5]));
        let push = (self.place - pose.translation.vector) * self.stiffness - pose.rotation * u * self.damping;
        let turn = pose.rotation * omega * -self.damping;
        SVector::from([push.x, push.y, push.z, turn.x, turn.y, turn.z])
    }
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let hull = RigidBody { mass: 10.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() * 2.0 };
let kernel = Vehicle { hull }.kernel()?;
let controller = StationKeeping { place: Vector3::new(1.0, 2.0, 0.0), stiffness: 40.0, damping: 40.0 };
let tumbling = SVector::from([0.0, 0.0, 0.5, 0.3, -0.2, 0.8]);
let run = Simulation::new(&kernel).input_from(controller).adaptive(1e-9, 1e-9);
let end = run.run_to_end(Isometry3::identity(), tumbling, 0.0..20.0)?;
assert!((end.q.translation.vector - Vector3::new(1.0, 2.0, 0.0)).norm() < 1e-6 && end.z.norm() < 1e-6);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not give the inputs of `{S}`",
    label = "this needs a function of time, configuration and speeds that returns the inputs",
    note = "write the closure within the call, `.input(|t, q, z| SVector::from([…]))`, or give its arguments types where it \
            stands alone: `let motor = |t: f64, q: &_, z: &_| SVector::from([…]);`"
)]
pub trait InputSource<S: GaussSystem> {
    /// The input at time t in the state (q, z).
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;

    /// The part that controllers hold, where there are some that sample.
    #[doc(hidden)]
    #[inline(always)]
    fn held(&self) -> Option<&Cell<S::Input>> {
        None
    }
}

/// The source of a scene without inputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoInput;

impl<S: GaussSystem<Input: EmptyInput>> InputSource<S> for NoInput {
    #[inline(always)]
    fn input(&self, _: S::Scalar, _: &S::Configuration, _: &S::Speeds) -> S::Input {
        S::Input::NONE
    }
}

/// The inputs of a scene that has none.
#[diagnostic::on_unimplemented(
    message = "the inputs of the scene have no source in this run",
    label = "this run has no `.input(…)`",
    note = "add `.input(|t, q, z| SVector::from([…]))` before the run, with a number for each input in the order of the scene"
)]
pub trait EmptyInput: Sealed {
    /// Nothing.
    const NONE: Self;
}

impl Sealed for () {}

impl EmptyInput for () {
    const NONE: Self = ();
}

/// An input given by a function of time and state: a control law, or a table.
#[derive(Clone, Copy, Debug)]
pub struct Feedback<G>(pub G);

impl<S: GaussSystem, G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input> InputSource<S> for Feedback<G> {
    #[inline(always)]
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        (self.0)(t, q, z)
    }
}
