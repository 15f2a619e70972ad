//! A kernel, a form and an input as one ordinary differential equation on flat vectors.

use alloc::{vec, vec::Vec};

use crate::ways::{Differences, JacobianFunction};
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::{
    Feedback, Form, InputSource, MomentumForm, Problem, Rates, Sample, State, SystemProblem, WithoutContacts,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// A kernel, a form and an input as `ẋ = f(t, x)`, with x the components of the configuration
/// ([`Configuration::Components`]) and then those of y: quasi-velocities z, or momenta p in the momentum form.
///
/// A rotation's components may have any length: the equations of motion use the normalised components, and their rates
/// are proportional to the length, so the exact solution keeps it. When an integrator changes the length, the rotation
/// has no error from that; the velocity of O has one of the order of the tolerance.
///
/// Made like a [`Simulation`](gauss_runtime::integrate::Simulation). It does not bring a state back onto constraints
/// while it runs, as those do: accelerations satisfy constraints that were differentiated, so states leave them slowly,
/// and [`GaussSystem::project`] of the final state repairs a short run. `f` never fails; undefined results are NaN.
/// Contact forces are not in it: a scene with [contacts](GaussSystem::HAS_CONTACTS) is refused by the compiler, but for
/// [`without_contacts`](Self::without_contacts). `InMode` of the crate `gauss-contact` is the system in closed
/// contacts, as long as they stay so.
///
/// J is the way in which ∂f/∂x is computed for implicit methods.
///
/// One step by hand:
///
/// ```
/// use gauss_adapters::FlatSystem;
/// use gauss_runtime::prelude::*;
///
/// /// A heavy top that turns about O.
/// #[derive(GaussDynamics)]
/// #[gauss(motion = fixed_point)]
/// struct Top {
///     #[gauss(mass)]           mass: f64,
///     #[gauss(center_of_mass)] center: Vector3<f64>,
///     #[gauss(inertia)]        inertia: Vector3<f64>,
///     #[gauss(gravity)]        g: f64,
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
/// let kernel = top.kernel()?;
/// let system = FlatSystem::new(&kernel);
/// // The quaternion x, y, z, w, then ω in body axes.
/// let mut x: [f64; 7] = system.vector(0.0, &UnitQuaternion::identity(), &Vector3::new(0.0, 0.1, 20.0));
/// let mut slope = [0.0; 7];
/// system.rates(0.0, &x, &mut slope);
/// for i in 0..7 {
///     x[i] += 1e-3 * slope[i];
/// }
/// let after = system.sample(1e-3, &x);
/// assert!((after.q.norm() - 1.0).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
///
/// Contacts are left out on purpose, or not at all:
///
/// ```compile_fail,E0080
/// # use gauss_adapters::FlatSystem;
/// # use gauss_runtime::prelude::*;
/// # #[derive(GaussDynamics)]
/// # #[gauss(coordinates(height), particle(mass = m, position = [0, 0, height]), contact(floor, gap = height))]
/// # struct Ball { m: f64 }
/// # let kernel = Ball { m: 1.0 }.kernel().unwrap();
/// let system = FlatSystem::new(&kernel); // with `.without_contacts()` it compiles
/// system.rates(0.0, &[1.0, 0.0], &mut [0.0; 2]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FlatSystem<P, J = Differences> {
    problem: P,
    pub(crate) jacobian: J,
}

impl<'k, S: GaussSystem> FlatSystem<SystemProblem<'k, S>> {
    /// The velocity form without inputs.
    #[must_use]
    pub fn new(system: &'k S) -> Self {
        Self { problem: SystemProblem::new(system), jacobian: Differences }
    }
}

impl<'k, S: GaussSystem, F, I, J> FlatSystem<SystemProblem<'k, S, F, I>, J> {
    /// Integrates the variables of the given form.
    #[must_use]
    pub fn form<G: Form<S>>(self, form: G) -> FlatSystem<SystemProblem<'k, S, G, I>, J> {
        FlatSystem { problem: self.problem.form(form), jacobian: self.jacobian }
    }

    /// Integrates momenta.
    #[must_use]
    pub fn momentum_form(self) -> FlatSystem<SystemProblem<'k, S, MomentumForm, I>, J> {
        self.form(MomentumForm)
    }

    /// Takes the equations of a scene with contacts as if all of its gaps stayed open: nothing touches, and nothing
    /// refuses to go on where a gap has closed.
    #[must_use]
    pub fn without_contacts(self) -> FlatSystem<SystemProblem<'k, S, WithoutContacts<F>, I>, J> {
        FlatSystem { problem: self.problem.without_contacts(), jacobian: self.jacobian }
    }

    /// Takes the input from a function of time, configuration and quasi-velocities.
    #[must_use]
    pub fn input<G>(self, input: G) -> FlatSystem<SystemProblem<'k, S, F, Feedback<G>>, J>
    where
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
    {
        self.input_from(Feedback(input))
    }

    /// Takes the input from a source.
    #[must_use]
    pub fn input_from<K: InputSource<S>>(self, input: K) -> FlatSystem<SystemProblem<'k, S, F, K>, J> {
        FlatSystem { problem: self.problem.input_from(input), jacobian: self.jacobian }
    }

    /// Takes `∂f/∂x · v` from `product(t, x, v, result)`, where it is known better than by [`Differences`].
    #[must_use]
    pub fn jacobian<G>(self, product: G) -> FlatSystem<SystemProblem<'k, S, F, I>, JacobianFunction<G>>
    where
        G: Fn(S::Scalar, &[S::Scalar], &[S::Scalar], &mut [S::Scalar]),
    {
        FlatSystem { problem: self.problem, jacobian: JacobianFunction(product) }
    }

    /// The kernel.
    #[must_use]
    pub fn system(&self) -> &'k S {
        self.problem.system
    }
}

impl<S, P, J> FlatSystem<P, J>
where
    S: GaussSystem,
    P: Problem<System = S>,
{
    /// The length of x.
    pub const DIM: usize = Self::COMPONENTS + S::Speeds::DIM;

    /// Number of those that are components of the configuration.
    const COMPONENTS: usize = <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM;

    /// x of a state as an array. Its length is checked when the program is compiled.
    #[must_use]
    pub fn vector<const N: usize>(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> [S::Scalar; N] {
        const { assert!(N == Self::DIM, "the vector has as many components as configuration and speeds together") };
        let mut x = [S::Scalar::zero(); N];
        self.write(t, q, z, &mut x);
        x
    }

    /// x of a state as a [`Vec`].
    #[must_use]
    pub fn to_vec(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> Vec<S::Scalar> {
        let mut x = vec![S::Scalar::zero(); Self::DIM];
        self.write(t, q, z, &mut x);
        x
    }

    /// x of a state, into the first [`DIM`](Self::DIM) numbers of a slice.
    ///
    /// # Panics
    /// When the slice is shorter.
    pub fn write(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, x: &mut [S::Scalar]) {
        let y = self.problem.variables(t, q, z);
        let components = q.components();
        for i in 0..Self::COMPONENTS {
            x[i] = components.component(i);
        }
        for i in 0..S::Speeds::DIM {
            x[Self::COMPONENTS + i] = y.component(i);
        }
    }

    /// The state at x, with rotations brought to length 1; quasi-velocities and momenta both.
    ///
    /// # Panics
    /// When x is shorter than [`DIM`](Self::DIM).
    #[must_use]
    pub fn sample(&self, t: S::Scalar, x: &[S::Scalar]) -> Sample<S> {
        self.problem.sample(&Self::state(t, |i| x[i]).1)
    }

    /// `f(t, x)`.
    ///
    /// # Panics
    /// When a slice is shorter than [`DIM`](Self::DIM).
    #[inline]
    pub fn rates(&self, t: S::Scalar, x: &[S::Scalar], slope: &mut [S::Scalar]) {
        self.rates_by(t, |i| x[i], |i, value| slope[i] = value);
    }

    /// `f(t, x)` for vectors of any type: x is read by `get`, each component of f is handed to `put` with its number,
    /// once.
    #[inline]
    pub fn rates_by(&self, t: S::Scalar, get: impl Fn(usize) -> S::Scalar, mut put: impl FnMut(usize, S::Scalar)) {
        const {
            assert!(
                !S::HAS_CONTACTS || P::LEAVES_CONTACTS_OUT,
                "the scene has contacts, whose forces its equations do not have: leave contacts out on purpose by \
                 `without_contacts()`, take `InMode` of gauss-contact for the motion in closed contacts, or run it by \
                 `Simulation` with contacts"
            )
        }
        let (unbound, state) = Self::state(t, get);
        let Rates { configuration, variables } = self.problem.rates(&state);
        let rates = unbound.component_rates(&configuration);
        for i in 0..Self::COMPONENTS {
            put(i, rates.component(i));
        }
        for i in 0..S::Speeds::DIM {
            put(Self::COMPONENTS + i, variables.component(i));
        }
    }

    /// The configuration with the components as they are, and the state that they stand for.
    #[inline]
    fn state(t: S::Scalar, get: impl Fn(usize) -> S::Scalar) -> (S::Configuration, State<S>) {
        let mut components = <S::Configuration as Configuration>::Components::zero();
        for i in 0..Self::COMPONENTS {
            components.set_component(i, get(i));
        }
        let unbound = S::Configuration::from_components(&components);
        let mut y = S::Speeds::zero();
        for i in 0..S::Speeds::DIM {
            y.set_component(i, get(Self::COMPONENTS + i));
        }
        (unbound, State { t, q: unbound.renormalise(), y })
    }
}
