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
    /// A numerator and the square of what it is divided by; only in charts with a singularity.
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
    /// Of one frame that is asked for, by its number; of all of them, one after the other.
    OfFrame(FrameQuantity, usize),
    Frames,
    /// Of all matter, by words of `methods(…)`: its mass and centre, momenta about that, and what they depend on.
    TotalMass,
    CenterOfMass,
    CentroidalMomentum,
    CentroidalMatrix,
    CentroidalBias,
    /// ∂C/∂ż at ż = 0; what holds weight and buoyancy.
    NonlinearEffects,
    GravityTorques,
}

/// What is asked of a frame. Components are in its own axes, the pole is its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FrameQuantity {
    /// b and R, row by row, in observer's axes.
    Pose,
    /// u and ω.
    Twist,
    /// ∂(u, ω)/∂z, row by row.
    Jacobian,
    /// The acceleration of the origin and ω̇ at ż = 0.
    Bias,
    /// Of the Jacobian, row by row, as the observer sees it; by `methods(jacobian_rates)`.
    JacobianRate,
}

impl FrameQuantity {
    /// Those that every frame has which is asked for, in their order.
    pub const ALL: [Self; 4] = [Self::Pose, Self::Twist, Self::Jacobian, Self::Bias];

    fn name(self) -> &'static str {
        match self {
            FrameQuantity::Pose => "pose_of",
            FrameQuantity::Twist => "twist_of",
            FrameQuantity::Jacobian => "jacobian_of",
            FrameQuantity::Bias => "bias_of",
            FrameQuantity::JacobianRate => "jacobian_rate_of",
        }
    }
}

impl Method {
    /// Those of [`System::centroidal_formulas`](crate::mechanics::System::centroidal_formulas).
    pub const CENTROIDAL: [Self; 5] =
        [Self::TotalMass, Self::CenterOfMass, Self::CentroidalMomentum, Self::CentroidalMatrix, Self::CentroidalBias];

    /// What a kernel has on request, but single frames.
    pub const ASKED_FOR: [Self; 7] = [
        Self::Frames,
        Self::CenterOfMass,
        Self::CentroidalMomentum,
        Self::CentroidalMatrix,
        Self::CentroidalBias,
        Self::NonlinearEffects,
        Self::GravityTorques,
    ];

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
            Method::OfFrame(quantity, _) => quantity.name(),
            Method::Frames => "frames",
            Method::TotalMass => "total_mass",
            Method::CenterOfMass => "center_of_mass",
            Method::CentroidalMomentum => "centroidal_momentum",
            Method::CentroidalMatrix => "centroidal_matrix",
            Method::CentroidalBias => "centroidal_bias",
            Method::NonlinearEffects => "nonlinear_effects",
            Method::GravityTorques => "gravity_torques",
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
