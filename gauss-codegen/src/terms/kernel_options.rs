//! Methods and derivatives that a kernel has on request.

use proc_macro2::Ident;

/// The methods and derivatives that a kernel has on request.
#[derive(Clone, Default)]
pub struct KernelOptions {
    /// `taylor`, where it is written: power series of the motion.
    pub taylor: Option<Ident>,
    /// `linearize`, where it is written: the derivatives of the equations by the state.
    pub linearize: Option<Ident>,
    /// `linearize(without_contacts)`: on purpose those of equations without contact forces.
    pub without_contacts: bool,
    /// `linearize(parameters)`: by the parameters, too.
    pub by_parameters: bool,
    /// `linearize(inverse)`: those of inverse dynamics, too.
    pub inverse: bool,
    /// `linearize(hessian)`: second derivatives along given weights, too.
    pub hessian: bool,
    /// `regressor`, where it is written: the coefficients of the inertial parameters.
    pub regressor: Option<Ident>,
    /// `frames(…)`: bodies and frames whose poses and velocities are methods, by their names, each once.
    pub frames: Vec<Ident>,
    /// `reactions(…)`: joints whose reactions are methods, each once.
    pub reactions: Vec<ReactionJoint>,
    /// Coordinates of `motion(…)`, whose driving forces are methods, in the order of the clauses.
    pub motions: Vec<Ident>,
    /// `python`, where it is written: a class of Python.
    pub python: Option<Ident>,
    /// `methods(…)`: quantities of the system as a whole, each once.
    pub methods: Vec<OptionalMethod>,
}

/// A method, or several that belong together, that a kernel has on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionalMethod {
    /// Momenta about the centre of mass.
    Centroidal,
    /// Inverse dynamics at ż = 0.
    NonlinearEffects,
    /// The generalised forces that balance weight and buoyancy.
    GravityTorques,
    /// d/dt of the Jacobians of the frames in `frames(…)`.
    JacobianRates,
}

/// A joint whose reaction is wanted: what it is called, and the body or frame that it joins to a parent.
#[derive(Clone)]
pub struct ReactionJoint {
    pub name: Ident,
    pub link: Ident,
}
