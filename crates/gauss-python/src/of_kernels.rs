//! The methods of the class that are methods of kernels: each hands its arrays to [`call`], which knows what they are.
//! One for each line of [`SPECS`](crate::methods::SPECS), whose words the stubs have.

use pyo3::prelude::*;

use crate::call::{Given, call};
use crate::class::Kernel;
use crate::methods::Id;

type Any<'py> = Bound<'py, PyAny>;
type Result<'py> = PyResult<Bound<'py, PyAny>>;

#[pymethods]
#[allow(clippy::too_many_arguments)] // Keywords.
impl Kernel {
    #[pyo3(signature = (q, z, input=None, *, t=None, out=None))]
    fn acceleration<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::Acceleration, &given)
    }

    #[pyo3(signature = (q, z, acceleration, input=None, *, t=None, out=None))]
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        acceleration: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), Some(acceleration), input], t, frame: 0, out };
        call(py, self.kernel(), Id::InverseDynamics, &given)
    }

    #[pyo3(signature = (q, z, input=None, *, t=None, out=None))]
    fn nonlinear_effects<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::NonlinearEffects, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::MassMatrix, &given)
    }

    #[pyo3(signature = (q, z, *, t=None, out=None))]
    fn kinematics<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::Kinematics, &given)
    }

    #[pyo3(signature = (q, z, input=None, *, t=None, out=None))]
    fn rates<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::Rates, &given)
    }

    #[pyo3(signature = (q, z, *, t=None, out=None))]
    fn momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::Momentum, &given)
    }

    #[pyo3(signature = (q, p, *, t=None, out=None))]
    fn velocity<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        p: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(p), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::Velocity, &given)
    }

    #[pyo3(signature = (q, p, input=None, *, t=None, out=None))]
    fn momentum_rate<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        p: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(p), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::MomentumRate, &given)
    }

    #[pyo3(signature = (q, z, *, t=None, out=None))]
    fn kinetic_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::KineticEnergy, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn potential_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::PotentialEnergy, &given)
    }

    #[pyo3(signature = (q, z, *, t=None, out=None))]
    fn energy<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::Energy, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn regularity<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::Regularity, &given)
    }

    #[pyo3(signature = (q, increment, *, t=None, out=None))]
    fn retract<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        increment: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, Some(increment), None], t, frame: 0, out };
        call(py, self.kernel(), Id::Retract, &given)
    }

    #[pyo3(signature = (q, other, *, t=None, out=None))]
    fn difference<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        other: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, Some(other), None], t, frame: 0, out };
        call(py, self.kernel(), Id::Difference, &given)
    }

    #[pyo3(signature = (q, z, input=None, *, t=None, out=None))]
    fn linearize<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::Linearize, &given)
    }

    #[pyo3(signature = (q, z, acceleration, input=None, *, t=None, out=None))]
    fn linearize_inverse<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        acceleration: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), Some(acceleration), input], t, frame: 0, out };
        call(py, self.kernel(), Id::LinearizeInverse, &given)
    }

    #[pyo3(signature = (q, z, weights, input=None, *, t=None, out=None))]
    fn hessian<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        weights: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), Some(weights), input], t, frame: 0, out };
        call(py, self.kernel(), Id::Hessian, &given)
    }

    #[pyo3(signature = (frame, q, *, t=None, out=None))]
    fn pose<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: self.frame(frame)?, out };
        call(py, self.kernel(), Id::Pose, &given)
    }

    #[pyo3(signature = (frame, q, z, *, t=None, out=None))]
    fn twist<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: self.frame(frame)?, out };
        call(py, self.kernel(), Id::Twist, &given)
    }

    #[pyo3(signature = (frame, q, *, t=None, out=None))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: self.frame(frame)?, out };
        call(py, self.kernel(), Id::Jacobian, &given)
    }

    #[pyo3(signature = (frame, q, z, *, t=None, out=None))]
    fn bias<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: self.frame(frame)?, out };
        call(py, self.kernel(), Id::Bias, &given)
    }

    #[pyo3(signature = (frame, q, z, *, t=None, out=None))]
    fn jacobian_rate<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: self.frame(frame)?, out };
        call(py, self.kernel(), Id::JacobianRate, &given)
    }

    #[pyo3(signature = (q, z, input=None, *, t=None, out=None))]
    fn multipliers<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        input: Option<&Any<'py>>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, input], t, frame: 0, out };
        call(py, self.kernel(), Id::Multipliers, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn gravity_torques<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::GravityTorques, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn center_of_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::CenterOfMass, &given)
    }

    #[pyo3(signature = (q, z, *, t=None, out=None))]
    fn centroidal_momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        z: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), Some(z), None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::CentroidalMomentum, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn centroidal_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::CentroidalMatrix, &given)
    }

    #[pyo3(signature = (q, *, t=None, out=None))]
    fn center_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Any<'py>,
        t: Option<&Any<'py>>,
        out: Option<&Any<'py>>,
    ) -> Result<'py> {
        let given = Given { arguments: [Some(q), None, None, None], t, frame: 0, out };
        call(py, self.kernel(), Id::CenterJacobian, &given)
    }
}
