//! The methods by name.

/// The number of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Id {
    Acceleration,
    InverseDynamics,
    NonlinearEffects,
    MassMatrix,
    Kinematics,
    Rates,
    Momentum,
    Velocity,
    MomentumRate,
    KineticEnergy,
    PotentialEnergy,
    Energy,
    Regularity,
    Retract,
    Difference,
    Linearize,
    LinearizeInverse,
    Hessian,
    Pose,
    Twist,
    Jacobian,
    Bias,
    JacobianRate,
    Multipliers,
    GravityTorques,
    CenterOfMass,
    CentroidalMomentum,
    CentroidalMatrix,
    CenterJacobian,
    Reaction,
    DrivingForces,
    Tangent,
    ByParameters,
}

impl Id {
    /// All, in their order.
    pub const ALL: [Self; COUNT] = [
        Self::Acceleration,
        Self::InverseDynamics,
        Self::NonlinearEffects,
        Self::MassMatrix,
        Self::Kinematics,
        Self::Rates,
        Self::Momentum,
        Self::Velocity,
        Self::MomentumRate,
        Self::KineticEnergy,
        Self::PotentialEnergy,
        Self::Energy,
        Self::Regularity,
        Self::Retract,
        Self::Difference,
        Self::Linearize,
        Self::LinearizeInverse,
        Self::Hessian,
        Self::Pose,
        Self::Twist,
        Self::Jacobian,
        Self::Bias,
        Self::JacobianRate,
        Self::Multipliers,
        Self::GravityTorques,
        Self::CenterOfMass,
        Self::CentroidalMomentum,
        Self::CentroidalMatrix,
        Self::CenterJacobian,
        Self::Reaction,
        Self::DrivingForces,
        Self::Tangent,
        Self::ByParameters,
    ];
}

/// Number of methods.
pub const COUNT: usize = SPECS.len();

/// Which of the arrays of a call an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The configuration.
    Q,
    /// Speeds, or momenta.
    Z,
    /// The argument that only some methods have.
    X,
    /// The input.
    U,
}

/// Count of the numbers of a vector, or length of an axis of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Components of the configuration.
    Configuration,
    /// Speeds.
    Speeds,
    /// Components of an increment of the configuration.
    Increment,
    /// Inputs.
    Input,
    /// Increment and speeds.
    State,
    /// Configuration and speeds.
    Flat,
    /// Multipliers.
    Multipliers,
    /// Driven coordinates.
    Motions,
    /// Numbers of parameters that there are derivatives by.
    Parameters,
    /// So many.
    Exactly(usize),
}

/// An argument of a method.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Its name in Python.
    pub name: &'static str,
    /// Array of the call in which it is handed over.
    pub slot: Slot,
    /// Count of its numbers.
    pub size: Size,
}

/// An array that a method gives: its name, and its axes behind those of the batch.
#[derive(Clone, Copy, Debug)]
pub struct Result {
    /// Its name.
    pub name: &'static str,
    /// Its axes.
    pub axes: &'static [Size],
}

/// Description of a method in Python.
#[derive(Clone, Copy, Debug)]
pub struct Spec {
    /// Its name.
    pub name: &'static str,
    /// Whether the name of a frame comes first.
    pub frame: bool,
    /// Its arguments besides time.
    pub arguments: &'static [Argument],
    /// Arrays that it gives.
    pub results: &'static [Result],
    /// The clause of the struct that it needs; empty of those that every kernel has.
    pub clause: &'static str,
    /// Text about it, for the stubs.
    pub documentation: &'static str,
}

const Q: Argument = Argument { name: "q", slot: Slot::Q, size: Size::Configuration };
const Z: Argument = Argument { name: "z", slot: Slot::Z, size: Size::Speeds };
const P: Argument = Argument { name: "p", slot: Slot::Z, size: Size::Speeds };
const U: Argument = Argument { name: "input", slot: Slot::U, size: Size::Input };
const RATES: Argument = Argument { name: "acceleration", slot: Slot::X, size: Size::Speeds };
const SIGMA: Argument = Argument { name: "increment", slot: Slot::X, size: Size::Increment };
const CHANGE: Argument = Argument { name: "change", slot: Slot::X, size: Size::Configuration };
const OTHER: Argument = Argument { name: "other", slot: Slot::X, size: Size::Configuration };
const WEIGHTS: Argument = Argument { name: "weights", slot: Slot::X, size: Size::State };

const fn one(axes: &'static [Size]) -> Result {
    Result { name: "", axes }
}

const SPEEDS: &[Result] = &[one(&[Size::Speeds])];
const NUMBER: &[Result] = &[one(&[])];
const TWIST: &[Result] = &[one(&[Size::Exactly(6)])];
const JACOBIAN: &[Result] = &[one(&[Size::Exactly(6), Size::Speeds])];

const fn spec(
    name: &'static str,
    arguments: &'static [Argument],
    results: &'static [Result],
    documentation: &'static str,
) -> Spec {
    Spec { name, frame: false, arguments, results, clause: "", documentation }
}

impl Spec {
    /// Whether it is about forces: then it has the input among its arguments, and those of contacts are not in it.
    #[must_use]
    pub fn has_forces(&self) -> bool {
        self.arguments.iter().any(|argument| argument.slot == Slot::U)
    }

    /// The class of its results, where there are several: `LinearizeInverse`.
    #[must_use]
    pub fn class_name(&self) -> String {
        let capital = |word: &str| {
            let mut letters = word.chars();
            letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
        };
        self.name.split('_').map(capital).collect()
    }

    const fn by(self, clause: &'static str) -> Self {
        Self { clause, ..self }
    }

    const fn of_frame(self) -> Self {
        Self { frame: true, clause: "frames(…)", ..self }
    }
}

/// All methods, in the order of [`Id`].
pub const SPECS: [Spec; 33] = [
    spec("acceleration", &[Q, Z, U], SPEEDS, "The rates of the speeds."),
    spec(
        "inverse_dynamics",
        &[Q, Z, RATES, U],
        SPEEDS,
        "The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.",
    ),
    spec("nonlinear_effects", &[Q, Z, U], SPEEDS, "Inverse dynamics at acceleration zero."),
    spec("mass_matrix", &[Q], &[one(&[Size::Speeds, Size::Speeds])], "Second derivatives of the kinetic energy by z."),
    spec("kinematics", &[Q, Z], &[one(&[Size::Increment])], "The velocity of the configuration, seen from the body."),
    spec("rates", &[Q, Z, U], &[one(&[Size::Flat])], "Rates of the numbers of q, then those of z, for any solver."),
    spec("momentum", &[Q, Z], SPEEDS, "Derivatives of the kinetic energy by z."),
    spec("velocity", &[Q, P], SPEEDS, "The speeds with these momenta."),
    spec("momentum_rate", &[Q, P, U], SPEEDS, "The rates of the momenta."),
    spec("kinetic_energy", &[Q, Z], NUMBER, "The kinetic energy, that of a fluid included."),
    spec("potential_energy", &[Q], NUMBER, "The potential energy."),
    spec("energy", &[Q, Z], NUMBER, "Kinetic and potential energy."),
    spec("regularity", &[Q], NUMBER, "The distance from a singularity of the coordinates: 0 there, 1 at best."),
    spec(
        "retract",
        &[Q, SIGMA],
        &[one(&[Size::Configuration])],
        "The configuration moved by an increment that is seen from the body.",
    ),
    spec("difference", &[Q, OTHER], &[one(&[Size::Increment])], "The shortest increment from q to the other."),
    spec(
        "linearize",
        &[Q, Z, U],
        &[
            Result { name: "rate", axes: &[Size::State] },
            Result { name: "by_state", axes: &[Size::State, Size::State] },
            Result { name: "by_time", axes: &[Size::State] },
            Result { name: "by_input", axes: &[Size::State, Size::Input] },
        ],
        "Velocity and acceleration with their derivatives by (increment, z), time and input.",
    )
    .by("linearize"),
    spec(
        "linearize_inverse",
        &[Q, Z, RATES, U],
        &[
            Result { name: "force", axes: &[Size::Speeds] },
            Result { name: "by_configuration", axes: &[Size::Speeds, Size::Increment] },
            Result { name: "by_speeds", axes: &[Size::Speeds, Size::Speeds] },
            Result { name: "by_acceleration", axes: &[Size::Speeds, Size::Speeds] },
            Result { name: "by_time", axes: &[Size::Speeds] },
            Result { name: "by_input", axes: &[Size::Speeds, Size::Input] },
        ],
        "Inverse dynamics with its derivatives.",
    )
    .by("linearize(inverse)"),
    spec(
        "hessian",
        &[Q, Z, WEIGHTS, U],
        &[
            Result { name: "by_state", axes: &[Size::State, Size::State] },
            Result { name: "by_input_and_state", axes: &[Size::Input, Size::State] },
            Result { name: "by_input", axes: &[Size::Input, Size::Input] },
        ],
        "Second derivatives of the weighted sum of velocity and acceleration.",
    )
    .by("linearize(hessian)"),
    spec(
        "pose",
        &[Q],
        &[one(&[Size::Exactly(4), Size::Exactly(4)])],
        "Rotation and origin of a frame as a matrix of four rows, frame to observer.",
    )
    .of_frame(),
    spec("twist", &[Q, Z], TWIST, "Velocity of a frame's origin, then angular velocity, in axes of the frame.")
        .of_frame(),
    spec("jacobian", &[Q], JACOBIAN, "Derivatives of a frame's twist by z, in axes of the frame.").of_frame(),
    spec("bias", &[Q, Z], TWIST, "Acceleration of a frame's origin, then angular, at acceleration zero; its axes.")
        .of_frame(),
    Spec {
        frame: true,
        ..spec("jacobian_rate", &[Q, Z], JACOBIAN, "The rate of a frame's Jacobian.")
            .by("frames(…), methods(jacobian_rates)")
    },
    spec("multipliers", &[Q, Z, U], &[one(&[Size::Multipliers])], "Lagrange multipliers.").by("constraint(…)"),
    spec("gravity_torques", &[Q], SPEEDS, "The generalised forces that balance weight and buoyancy.")
        .by("methods(gravity_torques)"),
    spec("center_of_mass", &[Q], &[one(&[Size::Exactly(3)])], "The centre of mass, in observer's axes.")
        .by("methods(centroidal)"),
    spec("centroidal_momentum", &[Q, Z], TWIST, "Momentum, then angular momentum about the centre of mass.")
        .by("methods(centroidal)"),
    spec("centroidal_matrix", &[Q], JACOBIAN, "Derivatives of the centroidal momentum by z.").by("methods(centroidal)"),
    spec("center_jacobian", &[Q], &[one(&[Size::Exactly(3), Size::Speeds])], "Derivatives of the centre's velocity.")
        .by("methods(centroidal)"),
    Spec {
        frame: true,
        ..spec(
            "reaction",
            &[Q, Z, U],
            TWIST,
            "Force, then torque about its origin, with which a joint holds what it carries, in axes of that.",
        )
        .by("reactions(…)")
    },
    spec(
        "driving_forces",
        &[Q, Z, U],
        &[one(&[Size::Motions, Size::Exactly(2)])],
        "Force and power that drive each coordinate of `motions`.",
    )
    .by("motion(…)"),
    spec(
        "tangent",
        &[Q, CHANGE],
        &[one(&[Size::Increment])],
        "The increment seen from the body that changes the numbers of q by so much, to first order.",
    ),
    spec(
        "by_parameters",
        &[Q, Z, U],
        &[one(&[Size::State, Size::Parameters])],
        "Derivatives of velocity and acceleration by `parameter_names`.",
    )
    .by("linearize(parameters)"),
];
