//! Methods of a kernel by name, and the derivatives that it has on request.

/// The methods that a kernel has, in the order in which they are generated and counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    /// q̇ with states of elements standing still.
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
    /// q̇ with the rates of the states; only where elements have states.
    ConfigurationRates,
    /// λ; only with constraints.
    Multipliers,
    /// One for each element of the loads, as are the columns of the generalised forces; dE/dt. Only where there are
    /// elements.
    Powers,
    ElementForces,
    SuppliedPower,
    BodyTwist,
    Speeds,
    BodyMomentum,
    /// R, row by row, and b of the only body; the twist (u, ω) that each component of an increment of the configuration
    /// makes. Only where the configuration is not that pose in a chart of its own.
    Pose,
    PoseByConfiguration,
    /// A numerator and the square of its denominator; only in charts with a singularity.
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
    /// A quantity of one frame that is wanted, by its number; the quantities of all of them, one after the other.
    OfFrame(FrameQuantity, usize),
    Frames,
    /// Quantities of all matter, by words of `methods(…)`: its mass and centre, momenta about that, and what they
    /// depend on.
    TotalMass,
    CenterOfMass,
    CentroidalMomentum,
    CentroidalMatrix,
    CentroidalBias,
    /// Force and torque of the joints that are wanted, one after the other.
    Reactions,
    /// Change of these forces and torques by unit contact forces, row by row; only with contacts, and without
    /// constraints.
    ContactReactions,
    /// The force of each motion and its power, one after the other; only with motions.
    DrivingForces,
    /// ∂C/∂ż at ż = 0; what holds weight and buoyancy.
    NonlinearEffects,
    GravityTorques,
    /// g; ġ and s; Wᵀ; of each contact whose place is known its point, normal and tangents; μ; e. Only with contacts.
    Gaps,
    ContactRates,
    ContactJacobian,
    ContactFrames,
    Friction,
    Restitution,
    /// A⁻¹Wᵀ, of long trees its halves, and D = W A⁻¹Wᵀ; ż without contact forces, b = W ż + γ, and these.
    ImpulseResponse,
    ImpulseDynamics,
    /// A⁻¹WᵀP from the halves of A⁻¹Wᵀ; of long trees.
    ImpulseVelocities,
}

/// A quantity of a frame. Components are in its own axes, the pole is its origin.
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
    /// Rate of the Jacobian, row by row, as the observer sees it; by `methods(jacobian_rates)`.
    JacobianRate,
}

impl FrameQuantity {
    /// Quantities of every frame that is wanted, in their order.
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
    /// Quantities of all matter, for momenta about the centre of mass.
    pub const CENTROIDAL: [Self; 5] =
        [Self::TotalMass, Self::CenterOfMass, Self::CentroidalMomentum, Self::CentroidalMatrix, Self::CentroidalBias];

    /// Methods that a kernel has on request, but single frames, and with contacts.
    pub const ASKED_FOR: [Self; 18] = [
        Self::Frames,
        Self::Reactions,
        Self::ContactReactions,
        Self::DrivingForces,
        Self::CenterOfMass,
        Self::CentroidalMomentum,
        Self::CentroidalMatrix,
        Self::CentroidalBias,
        Self::NonlinearEffects,
        Self::GravityTorques,
        Self::Gaps,
        Self::ContactRates,
        Self::ContactJacobian,
        Self::ContactFrames,
        Self::Friction,
        Self::ImpulseResponse,
        Self::ImpulseDynamics,
        Self::ImpulseVelocities,
    ];

    /// Name of the generated method.
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
            Method::ConfigurationRates => "configuration_rates",
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
            Method::Reactions => "reactions_at",
            Method::ContactReactions => "contact_reactions",
            Method::DrivingForces => "driving_forces_at",
            Method::TotalMass => "total_mass",
            Method::CenterOfMass => "center_of_mass",
            Method::CentroidalMomentum => "centroidal_momentum",
            Method::CentroidalMatrix => "centroidal_matrix",
            Method::CentroidalBias => "centroidal_bias",
            Method::NonlinearEffects => "nonlinear_effects",
            Method::GravityTorques => "gravity_torques",
            Method::Gaps => "gaps",
            Method::ContactRates => "contact_rates",
            Method::ContactJacobian => "contact_jacobian",
            Method::ContactFrames => "contact_frames",
            Method::Friction => "friction",
            Method::Restitution => "restitution",
            Method::ImpulseResponse => "impulse_response",
            Method::ImpulseDynamics => "impulse_dynamics",
            Method::ImpulseVelocities => "impulse_velocities",
        }
    }
}

/// Something for each method of a kernel: the methods that every kernel has by name, then the others in the order in
/// which they are generated.
#[derive(Clone)]
pub struct Methods<T> {
    pub kinematics: T,
    pub acceleration: T,
    pub momentum: T,
    pub velocity: T,
    pub momentum_rate: T,
    pub mass_matrix: T,
    pub kinetic_energy: T,
    pub potential_energy: T,
    pub gauss_residual: T,
    pub constraint_function: T,
    /// Each method once; in tests several times.
    pub others: Vec<(Method, T)>,
}

impl<T> Methods<T> {
    /// The methods that `evaluate` computes together.
    pub fn evaluated(&self) -> [&T; 4] {
        [self.configuration_rates(), &self.acceleration, &self.kinetic_energy, &self.potential_energy]
    }

    /// Value of q̇: that of the kinematics, where no element has states.
    pub fn configuration_rates(&self) -> &T {
        self.get(Method::ConfigurationRates).unwrap_or(&self.kinematics)
    }

    /// `None` of a method that this kernel does not have.
    pub fn get(&self, method: Method) -> Option<&T> {
        self.iter().find(|(own, _)| *own == method).map(|(_, of_method)| of_method)
    }

    /// All of them in order.
    pub fn iter(&self) -> impl Iterator<Item = (Method, &T)> {
        self.each_ref().into_iter()
    }

    pub fn each_ref(&self) -> Methods<&T> {
        Methods {
            kinematics: &self.kinematics,
            acceleration: &self.acceleration,
            momentum: &self.momentum,
            velocity: &self.velocity,
            momentum_rate: &self.momentum_rate,
            mass_matrix: &self.mass_matrix,
            kinetic_energy: &self.kinetic_energy,
            potential_energy: &self.potential_energy,
            gauss_residual: &self.gauss_residual,
            constraint_function: &self.constraint_function,
            others: self.others.iter().map(|(method, of_method)| (*method, of_method)).collect(),
        }
    }

    pub fn each_mut(&mut self) -> Methods<&mut T> {
        Methods {
            kinematics: &mut self.kinematics,
            acceleration: &mut self.acceleration,
            momentum: &mut self.momentum,
            velocity: &mut self.velocity,
            momentum_rate: &mut self.momentum_rate,
            mass_matrix: &mut self.mass_matrix,
            kinetic_energy: &mut self.kinetic_energy,
            potential_energy: &mut self.potential_energy,
            gauss_residual: &mut self.gauss_residual,
            constraint_function: &mut self.constraint_function,
            others: self.others.iter_mut().map(|(method, of_method)| (*method, of_method)).collect(),
        }
    }

    /// Something else for each of them, made in their order.
    pub fn map<U>(self, mut f: impl FnMut(Method, T) -> U) -> Methods<U> {
        Methods {
            kinematics: f(Method::Kinematics, self.kinematics),
            acceleration: f(Method::Acceleration, self.acceleration),
            momentum: f(Method::Momentum, self.momentum),
            velocity: f(Method::Velocity, self.velocity),
            momentum_rate: f(Method::MomentumRate, self.momentum_rate),
            mass_matrix: f(Method::MassMatrix, self.mass_matrix),
            kinetic_energy: f(Method::KineticEnergy, self.kinetic_energy),
            potential_energy: f(Method::PotentialEnergy, self.potential_energy),
            gauss_residual: f(Method::GaussResidual, self.gauss_residual),
            constraint_function: f(Method::ConstraintFunction, self.constraint_function),
            others: self.others.into_iter().map(|(method, of_method)| (method, f(method, of_method))).collect(),
        }
    }
}

impl<T> IntoIterator for Methods<T> {
    type Item = (Method, T);
    type IntoIter = std::iter::Chain<std::array::IntoIter<(Method, T), 10>, std::vec::IntoIter<(Method, T)>>;

    fn into_iter(self) -> Self::IntoIter {
        let of_every_kernel = [
            (Method::Kinematics, self.kinematics),
            (Method::Acceleration, self.acceleration),
            (Method::Momentum, self.momentum),
            (Method::Velocity, self.velocity),
            (Method::MomentumRate, self.momentum_rate),
            (Method::MassMatrix, self.mass_matrix),
            (Method::KineticEnergy, self.kinetic_energy),
            (Method::PotentialEnergy, self.potential_energy),
            (Method::GaussResidual, self.gauss_residual),
            (Method::ConstraintFunction, self.constraint_function),
        ];
        of_every_kernel.into_iter().chain(self.others)
    }
}

/// A derivative of the equations that a kernel has on request, in the order in which they are generated and counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DerivativeKind {
    /// q̇ and ż by the state, time and the inputs.
    ByState,
    /// q̇ and ż by the parameters.
    ByParameters,
    /// Inverse dynamics by the state, ż, time and the inputs.
    OfInverse,
    /// The forces of inertia by inertial parameters, in which they are linear.
    Regressor,
    /// Second derivatives of weighted q̇ and ż.
    Hessian,
}

impl DerivativeKind {
    /// The name of the generated method.
    pub fn name(self) -> &'static str {
        match self {
            DerivativeKind::ByState => "linearize",
            DerivativeKind::ByParameters => "by_parameters",
            DerivativeKind::OfInverse => "linearize_inverse",
            DerivativeKind::Regressor => "regressor",
            DerivativeKind::Hessian => "hessian",
        }
    }
}
