//! The items that most simulations need: `use gauss_runtime::prelude::*;`. The other methods are in
//! [`integrate`](crate::integrate), many states at once in the crate `gauss-batch`, reports on energy and momenta in
//! [`monitor`](mod@crate::monitor). Names that other preludes have as well, and those that few programs write, are
//! taken from their modules.

#[cfg(feature = "derive")]
pub use gauss_derive::GaussDynamics;

pub use crate::centroidal::{CentroidalSystem, GravityTorques};
pub use crate::chart::Chart;
pub use crate::configuration::{Configuration, Product, VectorSpace};
pub use crate::constraint::ConstrainedSystem;
pub use crate::contact::ContactSystem;
pub use crate::description::DescribedSystem;
pub use crate::driven::DrivenSystem;
pub use crate::error::ParameterError;
pub use crate::forces::ForcedSystem;
pub use crate::frames::{FrameName, FramedSystem, JacobianRates};
pub use crate::hessian::HessianSystem;
pub use crate::identification::{InertialRegressor, ParametricSystem};
pub use crate::increments::Increments;
pub use crate::integrate::{
    Adaptive, Classical4, Collocation, CommutatorFree4, Crossing, DormandPrince5, DormandPrince8, InputSource,
    IntegrationError, IntegrationErrorKind, MomentumForm, Rosenbrock, RungeKutta, Sample, Simulation, Tableau, Taylor,
    VelocityForm, Verner9,
};
#[cfg(feature = "alloc")]
pub use crate::integrate::{RunRecord, Trajectory};
pub use crate::inverse::InverseLinearizedSystem;
pub use crate::linearize::LinearizedSystem;
pub use crate::reactions::{ContactReactions, Reactions};
pub use crate::real::Real;
pub use crate::series::TaylorSystem;
pub use crate::simd::Lanes;
pub use crate::system::{AboutCenterOfMass, GaussSystem, RigidBody, RigidBodySystem, Smoothness};
#[doc(hidden)]
pub use crate::without_clause::{
    OfClauseConstraint as _, OfClauseContact as _, OfClauseForce as _, OfClauseFrames as _, OfClauseLinearize as _,
    OfClauseLinearizeHessian as _, OfClauseLinearizeInverse as _, OfClauseLinearizeParameters as _,
    OfClauseMethodsCentroidal as _, OfClauseMethodsGravityTorques as _, OfClauseMethodsJacobianRates as _,
    OfClauseMotion as _, OfClauseReactions as _, OfClauseReactionsBesideContacts as _, OfClauseRegressor as _,
    OfClauseTaylor as _, OfOneBody as _,
};
pub use nalgebra::{
    Isometry2, Isometry3, Matrix3, Matrix6, Quaternion, SMatrix, SVector, Translation3, UnitComplex, UnitQuaternion,
    Vector2, Vector3, Vector6,
};
