//! Motion by a kernel of Gauss inside Bevy: physics at a rate of its own, poses for every frame between its steps.
//!
//! - [`Moving`] is a component with a kernel and its state, in `f64`; [`GaussPlugin`] moves it in `FixedUpdate`.
//! - After `FixedUpdate` the `Transform` of the entity is set: between the last two steps, as far as the clock of
//!   frames has gone beyond the clock of physics, along the one screw motion that joins both poses.
//! - Gauss' scenes choose their axes; here k₃ points up, in Bevy y does. [`shown`] is the only place that knows.

use std::marker::PhantomData;

use bevy_app::{App, FixedUpdate, Plugin, RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec3};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use gauss_runtime::prelude::{
    Configuration, GaussDynamics, GaussSystem, IntegrationError, Isometry3, RigidBodySystem, Simulation, Vector3,
    VectorSpace,
};

/// A body with a handle, spun about its middle axis: it turns over again and again.
#[derive(GaussDynamics, Clone)]
#[gauss(chart = left_invariant)]
pub struct Handle {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// kg m², about G.
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
}

/// A state at a time.
type State<S> = (<S as GaussSystem>::Configuration, <S as GaussSystem>::Speeds);

/// What moves by a kernel.
#[derive(Component)]
#[require(Transform)]
pub struct Moving<S>
where
    S: GaussSystem<Scalar = f64, Input = (), Configuration: Send + Sync, Speeds: Send + Sync> + Send + Sync + 'static,
{
    kernel: S,
    t: f64,
    now: State<S>,
    /// One step ago.
    before: State<S>,
}

/// What a [`Moving`] component needs of its kernel.
pub trait Movable:
    RigidBodySystem<Scalar = f64, Input = (), Configuration: Send + Sync, Speeds: Send + Sync> + Send + Sync + 'static
{
}

impl<S> Movable for S where
    S: RigidBodySystem<Scalar = f64, Input = (), Configuration: Send + Sync, Speeds: Send + Sync>
        + Send
        + Sync
        + 'static
{
}

impl<S: Movable> Moving<S> {
    /// At t = 0.
    pub fn new(kernel: S, q: S::Configuration, z: S::Speeds) -> Self {
        Self { kernel, t: 0.0, now: (q, z), before: (q, z) }
    }

    /// Where it is after the last step.
    pub fn pose(&self) -> Isometry3<f64> {
        self.kernel.pose(self.t, &self.now.0)
    }

    /// The time of the last step, s.
    pub fn time(&self) -> f64 {
        self.t
    }

    fn advance(&mut self, seconds: f64) -> Result<(), IntegrationError> {
        let (q, z) = self.now;
        let end = Simulation::new(&self.kernel).fixed_step(seconds).run_to_end(q, z, self.t..self.t + seconds)?;
        (self.before, self.now, self.t) = ((q, z), (end.q, end.z), end.t);
        Ok(())
    }

    /// Between the last two steps: 0 is the one before, 1 the last.
    pub fn between(&self, part: f64) -> Isometry3<f64> {
        let (from, to) = (&self.before.0, &self.now.0);
        self.kernel.pose(self.t, &from.retract(&from.difference(to).scale(part)))
    }
}

/// A pose of a scene whose k₃ points up, where y does.
pub fn shown(pose: &Isometry3<f64>) -> Transform {
    let (position, orientation): (Vec3, Quat) = pose.cast::<f32>().into();
    let up = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    Transform { translation: up * position, rotation: up * orientation, ..Transform::IDENTITY }
}

/// Moves every [`Moving<S>`]. The rate is that of Bevy: `Time::<Fixed>::from_hz(…)`.
pub struct GaussPlugin<S>(PhantomData<fn() -> S>);

impl<S> Default for GaussPlugin<S> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<S: Movable> Plugin for GaussPlugin<S> {
    fn build(&self, app: &mut App) {
        app.add_systems(FixedUpdate, advance::<S>);
        app.add_systems(RunFixedMainLoop, show::<S>.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop));
    }
}

/// One step of physics. A state that cannot be advanced is an error with its time, for Bevy's handler of errors.
fn advance<S: Movable>(time: Res<Time<Fixed>>, mut bodies: Query<&mut Moving<S>>) -> Result {
    for mut body in &mut bodies {
        body.advance(time.delta_secs_f64())?;
    }
    Ok(())
}

/// One frame.
fn show<S: Movable>(time: Res<Time<Fixed>>, mut bodies: Query<(&Moving<S>, &mut Transform)>) {
    for (body, mut transform) in &mut bodies {
        *transform = shown(&body.between(time.overstep_fraction_f64()));
    }
}
