//! The two forms of the equations of motion, seen by an integrator as one: `q̇ = q·V(t, q, y)`, `ẏ = f(t, q, y)`.
//!
//! The velocity form takes y = z; the momentum form takes y = p, and keeps what the momenta keep (in the right-invariant
//! chart without forces ṗ is zero, so every integrator keeps the momentum to the last bit).

use core::fmt;

use crate::configuration::{Configuration, VectorSpace};
use crate::system::GaussSystem;

/// The increments of a system's configuration.
pub type TangentOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// Where the values of the input come from during a run: a closure ([`Simulation::input`](crate::integrate::Simulation::input)), or a type
/// of your own ([`Simulation::input_from`](crate::integrate::Simulation::input_from)). It is asked at every stage of every step, also of
/// steps that are rejected: the answer should depend on the arguments only, and smoothly.
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

/// Draws O to a place and stops turning. Components in the observer's axes k, pole O, as the scene says.
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
pub trait InputSource<S: GaussSystem> {
    /// The input at time t in the state (q, z).
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;
}

/// The source of a scene without inputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoInput;

impl<S: GaussSystem<Input = ()>> InputSource<S> for NoInput {
    #[inline(always)]
    fn input(&self, _: S::Scalar, _: &S::Configuration, _: &S::Speeds) {}
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

/// The time derivatives of a state: the velocity of the configuration seen from the body, and ẏ.
pub struct Rates<S: GaussSystem> {
    /// V, left-trivialised.
    pub configuration: TangentOf<S>,
    /// ẏ.
    pub variables: S::Speeds,
}

impl<S: GaussSystem> Rates<S> {
    /// Whether both parts are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.configuration.is_finite() && self.variables.is_finite()
    }
}

/// A state of an integrator: time, configuration, and the variables y of the form.
pub struct State<S: GaussSystem> {
    /// Time.
    pub t: S::Scalar,
    /// Configuration.
    pub q: S::Configuration,
    /// z in the velocity form, p in the momentum form.
    pub y: S::Speeds,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
macro_rules! copy_and_debug {
    ($name:ident { $($field:ident),+ }) => {
        impl<S: GaussSystem> Copy for $name<S> {}

        impl<S: GaussSystem> Clone for $name<S> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S: GaussSystem> fmt::Debug for $name<S> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($name))$(.field(stringify!($field), &self.$field))+.finish()
            }
        }
    };
}
pub(in crate::integrate) use copy_and_debug;

copy_and_debug!(Rates { configuration, variables });
copy_and_debug!(State { t, q, y });

/// Which variables y are integrated beside the configuration.
pub trait Form<S: GaussSystem>: Copy {
    /// y of a state given by its quasi-velocities.
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds;

    /// The quasi-velocities z of y.
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds;

    /// The momenta p of y.
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds;

    /// y of a state given by its momenta.
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds;

    /// V and ẏ.
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S>;

    /// (ż, ṗ), one of which is the known ẏ.
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds);
}

/// y = z: integrate the quasi-velocities by `acceleration`.
#[derive(Clone, Copy, Debug, Default)]
pub struct VelocityForm;

/// y = p: integrate the momenta by `momentum_rate`.
#[derive(Clone, Copy, Debug, Default)]
pub struct MomentumForm;

impl<S: GaussSystem> Form<S> for VelocityForm {
    #[inline(always)]
    fn variables(self, _: &S, _: S::Scalar, _: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        *z
    }

    #[inline(always)]
    fn speeds(self, _: &S, _: S::Scalar, _: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        *y
    }

    #[inline(always)]
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        system.momentum(t, q, y)
    }

    #[inline(always)]
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        system.velocity(t, q, p)
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        let State { t, q, y } = state;
        let input = input.input(*t, q, y);
        Rates { configuration: system.kinematics(*t, q, y), variables: system.acceleration(*t, q, y, &input) }
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        let State { t, q, y } = state;
        let (input, p) = (input.input(*t, q, y), system.momentum(*t, q, y));
        (*known, system.momentum_rate(*t, q, &p, &input))
    }
}

impl<S: GaussSystem> Form<S> for MomentumForm {
    #[inline(always)]
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        system.momentum(t, q, z)
    }

    #[inline(always)]
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        system.velocity(t, q, y)
    }

    #[inline(always)]
    fn momentum(self, _: &S, _: S::Scalar, _: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        *y
    }

    #[inline(always)]
    fn of_momentum(self, _: &S, _: S::Scalar, _: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        *p
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        let State { t, q, y } = state;
        let z = system.velocity(*t, q, y);
        let input = input.input(*t, q, &z);
        Rates { configuration: system.kinematics(*t, q, &z), variables: system.momentum_rate(*t, q, y, &input) }
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        let State { t, q, y } = state;
        let z = system.velocity(*t, q, y);
        let input = input.input(*t, q, &z);
        (system.acceleration(*t, q, &z, &input), *known)
    }
}

/// A system, a form and an input: all that a method integrates.
#[derive(Debug)]
pub struct Problem<'k, S, F, I> {
    /// The kernel.
    pub system: &'k S,
    /// Velocity or momentum form.
    pub form: F,
    /// Where inputs come from.
    pub input: I,
}

// Written by hand: the system is only borrowed, and need not be `Copy`.
impl<S, F: Copy, I: Copy> Copy for Problem<'_, S, F, I> {}

impl<S, F: Clone, I: Clone> Clone for Problem<'_, S, F, I> {
    fn clone(&self) -> Self {
        Self { system: self.system, form: self.form.clone(), input: self.input.clone() }
    }
}

impl<S: GaussSystem, F: Form<S>, I: InputSource<S>> Problem<'_, S, F, I> {
    /// The time derivatives at a state.
    #[inline(always)]
    pub fn rates(&self, state: &State<S>) -> Rates<S> {
        self.form.rates(self.system, &self.input, state)
    }
}
