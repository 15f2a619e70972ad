//! What a kernel offers, method by method, and the expressions that each is made from.

use crate::algebra::Expr;

/// The methods that a kernel has, in the order in which they are generated and counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    Kinematics,
    Acceleration,
    Momentum,
    Velocity,
    MomentumRate,
    MassMatrix,
    KineticEnergy,
    PotentialEnergy,
    GaussResidual,
    ConstraintFunction,
    /// λ; only with constraints.
    Multipliers,
    /// One for each element of what acts, as are the columns of the generalised forces; dE/dt. Only where there are elements.
    Powers,
    ElementForces,
    SuppliedPower,
    BodyTwist,
    Speeds,
    BodyMomentum,
    /// R, row by row, and b of the only body; the twist (u, ω) that each component of an increment of the configuration makes.
    /// Only where the configuration is not that pose in a chart of its own.
    Pose,
    PoseByConfiguration,
    /// det ∂ω/∂q̇ and the product of the squared lengths of its columns; only in charts with a singularity.
    Regularity,
    /// φ of positions, and on the level of velocities; what cancels them to first order. Only with constraints.
    PositionResidual,
    VelocityResidual,
    PositionCorrection,
    VelocityCorrection,
    /// Rates of the components of the configuration, then ż; only where power series are wanted.
    ComponentRates,
    /// π, and the generalised forces that are no part of Y π; only where the regressor is wanted.
    InertialParameters,
    OtherForces,
}

impl Method {
    /// What callers want at once.
    pub const EVALUATED: [Self; 4] = [Self::Kinematics, Self::Acceleration, Self::KineticEnergy, Self::PotentialEnergy];

    /// What the generated method is called.
    pub fn name(self) -> &'static str {
        match self {
            Method::Kinematics => "kinematics",
            Method::Acceleration => "acceleration",
            Method::Momentum => "momentum",
            Method::Velocity => "velocity",
            Method::MomentumRate => "momentum_rate",
            Method::MassMatrix => "mass_matrix",
            Method::KineticEnergy => "kinetic_energy",
            Method::PotentialEnergy => "potential_energy",
            Method::GaussResidual => "gauss_residual",
            Method::ConstraintFunction => "constraint_function",
            Method::BodyTwist => "body_twist",
            Method::Speeds => "speeds",
            Method::BodyMomentum => "body_momentum",
            Method::Pose => "pose",
            Method::PoseByConfiguration => "pose_by_configuration",
            Method::Regularity => "regularity",
            Method::Multipliers => "multipliers",
            Method::PositionResidual => "position_residual",
            Method::VelocityResidual => "velocity_residual",
            Method::PositionCorrection => "position_correction",
            Method::VelocityCorrection => "velocity_correction",
            Method::ComponentRates => "expand",
            Method::Powers => "powers",
            Method::ElementForces => "element_forces",
            Method::SuppliedPower => "supplied_power",
            Method::InertialParameters => "inertial_parameters",
            Method::OtherForces => "other_forces",
        }
    }
}

/// The outputs of one method. Where the same result can be arranged in several ways, all are given, and the kernel
/// takes the one that costs least.
#[derive(Clone)]
pub struct Formula<'g> {
    pub method: Method,
    pub arrangements: Vec<Vec<Expr<'g>>>,
}
