//! The methods of the class that are methods of kernels: each hands its arrays to [`call`], which knows what they are.
//! One for each line of [`SPECS`](crate::methods::SPECS), whose words the stubs have.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::call::{Given, call};
use crate::class::Kernel;
use crate::methods::{Id, SPECS};

type Any<'py> = Bound<'py, PyAny>;
type Result<'py> = PyResult<Bound<'py, PyAny>>;

/// A method by its name and number, what Python gives it (the [name] of a frame, arrays, after a semicolon one that may
/// be left out) and these by their slots. All have `t` and `out` besides, and parameters of rows.
macro_rules! methods {
    ($($method:ident $id:ident ($([$frame:ident])? $($array:ident),* $(; $optional:ident)?) [$($slot:expr),*];)*) => {
        #[pymethods]
        #[allow(clippy::too_many_arguments)] // Keywords.
        impl Kernel {$(
            #[pyo3(signature = ($($frame,)? $($array,)* $($optional=None,)? *, t=None, out=None, **parameters))]
            fn $method<'py>(
                &self,
                py: Python<'py>,
                $($frame: &str,)?
                $($array: &Any<'py>,)*
                $($optional: Option<&Any<'py>>,)?
                t: Option<&Any<'py>>,
                out: Option<&Any<'py>>,
                parameters: Option<&Bound<'py, PyDict>>,
            ) -> Result<'py> {
                if SPECS[Id::$id as usize].has_forces() {
                    let way = concat!("kernel.without_contacts().", stringify!($method));
                    self.knows_all_forces(py, (stringify!($method), way))?;
                }
                let frames: &[usize] = &[$(self.$frame($frame)?)?];
                let frame = frames.first().copied().unwrap_or(0);
                call(py, self.kernel(), Id::$id, &Given { arguments: [$($slot),*], t, frame, out, parameters })
            }
        )*}
    };
}

methods! {
    acceleration Acceleration (q, z; input) [Some(q), Some(z), None, input];
    inverse_dynamics InverseDynamics (q, z, acceleration; input) [Some(q), Some(z), Some(acceleration), input];
    nonlinear_effects NonlinearEffects (q, z; input) [Some(q), Some(z), None, input];
    mass_matrix MassMatrix (q) [Some(q), None, None, None];
    kinematics Kinematics (q, z) [Some(q), Some(z), None, None];
    rates Rates (q, z; input) [Some(q), Some(z), None, input];
    momentum Momentum (q, z) [Some(q), Some(z), None, None];
    velocity Velocity (q, p) [Some(q), Some(p), None, None];
    momentum_rate MomentumRate (q, p; input) [Some(q), Some(p), None, input];
    kinetic_energy KineticEnergy (q, z) [Some(q), Some(z), None, None];
    potential_energy PotentialEnergy (q) [Some(q), None, None, None];
    energy Energy (q, z) [Some(q), Some(z), None, None];
    regularity Regularity (q) [Some(q), None, None, None];
    retract Retract (q, increment) [Some(q), None, Some(increment), None];
    difference Difference (q, other) [Some(q), None, Some(other), None];
    linearize Linearize (q, z; input) [Some(q), Some(z), None, input];
    linearize_inverse LinearizeInverse (q, z, acceleration; input) [Some(q), Some(z), Some(acceleration), input];
    hessian Hessian (q, z, weights; input) [Some(q), Some(z), Some(weights), input];
    pose Pose ([frame] q) [Some(q), None, None, None];
    twist Twist ([frame] q, z) [Some(q), Some(z), None, None];
    jacobian Jacobian ([frame] q) [Some(q), None, None, None];
    bias Bias ([frame] q, z) [Some(q), Some(z), None, None];
    jacobian_rate JacobianRate ([frame] q, z) [Some(q), Some(z), None, None];
    multipliers Multipliers (q, z; input) [Some(q), Some(z), None, input];
    gravity_torques GravityTorques (q) [Some(q), None, None, None];
    center_of_mass CenterOfMass (q) [Some(q), None, None, None];
    centroidal_momentum CentroidalMomentum (q, z) [Some(q), Some(z), None, None];
    centroidal_matrix CentroidalMatrix (q) [Some(q), None, None, None];
    center_jacobian CenterJacobian (q) [Some(q), None, None, None];
    reaction Reaction ([joint] q, z; input) [Some(q), Some(z), None, input];
    driving_forces DrivingForces (q, z; input) [Some(q), Some(z), None, input];
    tangent Tangent (q, change) [Some(q), None, Some(change), None];
    by_parameters ByParameters (q, z; input) [Some(q), Some(z), None, input];
}
