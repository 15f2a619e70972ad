//! The table of force elements: of each its words, and of each argument what stands there, in which unit, and whether
//! it is required. Clauses are read, checked and listed by this table; `translate` makes forces of them.

use crate::terms::LawKind;

/// Kinds of elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    Force,
    Torque,
    Wrench,
    Drive,
    Spring,
    Stop,
    Drag,
    Friction,
    Coupling,
    TorsionalSpring,
    Bushing,
    Dissipation,
    MassFlow,
    Attraction,
}

/// One element.
pub struct Row {
    pub kind: ElementKind,
    /// First word of its clause. Elements without a name are called so, too.
    pub word: &'static str,
    /// Noun in messages.
    pub noun: &'static str,
    pub form: ClauseForm,
    /// In the order in which messages list them.
    pub arguments: &'static [ElementArgument],
    /// Rules among the arguments.
    pub rules: &'static [ArgumentRule],
    /// Words that are refused in a way of their own.
    pub refused: &'static [(&'static str, &'static str)],
    /// All that stands in its brackets.
    pub example: &'static str,
    /// One argument, for messages.
    pub argument: &'static str,
}

impl PartialEq for Row {
    fn eq(&self, other: &Row) -> bool {
        self.kind == other.kind
    }
}

impl Eq for Row {}

impl Row {
    /// The argument with this word.
    pub fn find(&self, word: &str) -> Option<&'static ElementArgument> {
        self.arguments.iter().find(|argument| argument.word == word)
    }

    /// The words of its arguments.
    pub fn words(&self) -> Vec<(&'static str, ())> {
        self.arguments.iter().map(|argument| (argument.word, ())).collect()
    }
}

/// Forms of a clause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClauseForm {
    /// `spring(name, along = …, stiffness = …)`.
    Arguments,
    /// `drive(name, theta = …)`: the words are coordinates.
    Rates,
    /// `damping = …`.
    Value,
}

/// One argument.
#[derive(Clone, Copy)]
pub struct ElementArgument {
    pub word: &'static str,
    pub takes: ArgumentType,
    /// Example of a value, for messages.
    pub example: &'static str,
    /// Part that the element lacks without it, for messages; `None`: it may be left out.
    pub required: Option<&'static str>,
}

impl ElementArgument {
    const fn optional(word: &'static str, takes: ArgumentType, example: &'static str) -> ElementArgument {
        ElementArgument { word, takes, example, required: None }
    }

    const fn required(
        word: &'static str,
        takes: ArgumentType,
        example: &'static str,
        what: &'static str,
    ) -> ElementArgument {
        ElementArgument { word, takes, example, required: Some(what) }
    }

    const fn constant(word: &'static str, called: &'static str, unit: Unit, example: &'static str) -> ElementArgument {
        ElementArgument::optional(word, ArgumentType::Constant { called, unit, law: None }, example)
    }

    /// A constant that `kernel()` checks.
    const fn checked(
        word: &'static str,
        called: &'static str,
        unit: Unit,
        example: &'static str,
        law: LawKind,
    ) -> ElementArgument {
        ElementArgument::optional(word, ArgumentType::Constant { called, unit, law: Some(law) }, example)
    }

    /// It may not be left out.
    const fn needed(self, what: &'static str) -> ElementArgument {
        ElementArgument { required: Some(what), ..self }
    }
}

/// Kinds of values of arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentType {
    /// The name of the body or frame that it acts on. In a chart it may be left out.
    Body,
    /// The name of another body or frame, on which the reaction acts.
    Other,
    /// `body` or `observer`: the axes of the components.
    Axes,
    /// Point where a force acts: with `body` a vector of fields and numbers, body axes from O, or the name of a point
    /// of the body; else a vector of t and q, observer axes from Ω.
    Point,
    /// A vector.
    Force,
    /// A vector.
    Torque,
    /// The velocity of matter relative to the body where it leaves or enters it: a vector.
    FlowVelocity,
    /// The generalised force on the rate of a scalar coordinate: a scalar.
    Drive,
    /// Rayleigh's dissipation function: a scalar whose negative partial derivatives by z are the generalised forces.
    Dissipation,
    /// One of two points whose distance is the extent: a vector of t and q, observer axes from Ω.
    End,
    /// The extent: a scalar of t and q, such as the angle of a joint.
    Along,
    /// A scalar of fields and numbers, called so in messages.
    Constant { called: &'static str, unit: Unit, law: Option<LawKind> },
    /// Coefficients in body axes, pole O, order (u, ω), in these units for forces and for torques: six scalars that may
    /// depend on all that forces do, or a field that is a `Vector6` (diagonal) or a `Matrix6`.
    Coefficients([&'static str; 2]),
    /// Constant coefficients, in these units for forces and for torques: six scalars of fields and numbers, or a field
    /// that is a `Vector6` (diagonal) or a symmetric `Matrix6`; called so in messages.
    Matrix { called: &'static str, units: [&'static str; 2], law: LawKind },
    /// The centre of a field: a vector of t, fields and numbers, observer axes from Ω.
    Center,
}

/// The unit of a constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// This one.
    Is(&'static str),
    /// Unit of the extent.
    Extent,
    /// Generalised force by extent.
    ForceByExtent,
    /// Generalised force by rate of the extent.
    ForceByRate,
    /// Generalised force: energy by extent.
    Force,
    /// Unit of the rate of the extent.
    Rate,
}

/// Rules among the arguments of an element.
#[derive(Clone, Copy)]
pub enum ArgumentRule {
    /// `along`, or `from` with `to`.
    Extent,
    /// `at` or `body`; `axes` only with `body`.
    Somewhere,
    /// One of the two, or both; the message ends with both of them.
    OneOf([&'static str; 2], &'static str),
    /// The first needs the second; the words say so.
    With([&'static str; 2], &'static str),
    /// The first only with the second; the message.
    OnlyWith([&'static str; 2], &'static str),
}

/// Words of arguments.
pub mod argument {
    pub const BODY: &str = "body";
    pub const AT: &str = "at";
    pub const VALUE: &str = "value";
    pub const AXES: &str = "axes";
    pub const REACTION: &str = "reaction";
    pub const OTHER: &str = "other";
    pub const ANGLE: &str = "angle";
    pub const FORCE: &str = "force";
    pub const TORQUE: &str = "torque";
    pub const LINEAR: &str = "linear";
    pub const QUADRATIC: &str = "quadratic";
    pub const FROM: &str = "from";
    pub const TO: &str = "to";
    pub const ALONG: &str = "along";
    pub const STIFFNESS: &str = "stiffness";
    pub const LENGTH: &str = "length";
    pub const DAMPING: &str = "damping";
    pub const VISCOUS: &str = "viscous";
    pub const DRY: &str = "dry";
    pub const WIDTH: &str = "width";
    pub const LEAST: &str = "least";
    pub const MOST: &str = "most";
    pub const MU: &str = "mu";
    pub const CENTER: &str = "center";
    pub const VELOCITY: &str = "velocity";
    pub const THRUST: &str = "thrust";
}

use argument::{
    ALONG, ANGLE, AT, AXES, BODY, CENTER, DAMPING, DRY, FORCE as OF_FORCE, FROM, LEAST, LENGTH, LINEAR, MOST, MU,
    OTHER, QUADRATIC, REACTION, STIFFNESS, THRUST, TO, TORQUE as OF_TORQUE, VALUE, VELOCITY, VISCOUS, WIDTH,
};

const ON_BODY: ElementArgument = ElementArgument::required(BODY, ArgumentType::Body, "…", "the body that it acts on");
const ON_OTHER: ElementArgument =
    ElementArgument::required(OTHER, ArgumentType::Other, "…", "the body on which its reaction acts");
const IN_AXES: ElementArgument = ElementArgument::optional(AXES, ArgumentType::Axes, "body");
const FROM_POINT: ElementArgument = ElementArgument::optional(FROM, ArgumentType::End, "arm.position");
const TO_POINT: ElementArgument = ElementArgument::optional(TO, ArgumentType::End, "[0, 0, h]");
const ALONG_SCALAR: ElementArgument = ElementArgument::optional(ALONG, ArgumentType::Along, "theta");
const STIFF: ElementArgument =
    ElementArgument::checked(STIFFNESS, "stiffness", Unit::ForceByExtent, "k", LawKind::Stiffness);
const DAMPED: ElementArgument = ElementArgument::checked(DAMPING, "damping", Unit::ForceByRate, "c", LawKind::Damping);

/// All elements that are force clauses, in the order in which messages list them.
pub static ELEMENTS: &[&Row] = &[
    &FORCE,
    &TORQUE,
    &WRENCH,
    &DRIVE,
    &SPRING,
    &STOP,
    &DRAG,
    &FRICTION,
    &COUPLING,
    &TORSIONAL_SPRING,
    &BUSHING,
    &DISSIPATION,
    &MASS_FLOW,
];

/// At the point that has the position `at`, or at a point of `body`.
pub static FORCE: Row = Row {
    kind: ElementKind::Force,
    word: "force",
    noun: "force",
    form: ClauseForm::Arguments,
    arguments: &[
        ElementArgument::optional(AT, ArgumentType::Point, "[l, 0, 0]"),
        ElementArgument::required(VALUE, ArgumentType::Force, "[fx, fy, fz]", "its components"),
        ElementArgument::optional(BODY, ArgumentType::Body, "…"),
        IN_AXES,
    ],
    rules: &[ArgumentRule::Somewhere],
    refused: &[
        ("force", "the components of a force are its value; write `value = [fx, fy, fz]`"),
        ("torque", "a force with a torque is a wrench; write `wrench(body = …, at = …, force = […], torque = […])`"),
        (
            "reaction",
            "a force acts on one body; the other side is a `force(…)` of its own at the same point, with the opposite \
             value",
        ),
    ],
    example: "at = …, value = [fx, fy, fz]",
    argument: "an argument such as `value = [0, 0, f]`",
};

/// On a body, and the opposite one on another; `axes` are those of `body`, never of `reaction`.
pub static TORQUE: Row = Row {
    kind: ElementKind::Torque,
    word: "torque",
    noun: "torque",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ElementArgument::required(VALUE, ArgumentType::Torque, "[mx, my, mz]", "its components"),
        IN_AXES,
        ElementArgument::optional(REACTION, ArgumentType::Other, "…"),
    ],
    rules: &[],
    refused: &[
        ("at", "a torque has no point: it does the same wherever it acts on its body; remove `at`"),
        ("torque", "the components of a torque are its value; write `value = [mx, my, mz]`"),
        (
            "force",
            "a force with a torque is a wrench, `wrench(body = …, force = […], torque = […])`; a reaction has the torque \
             alone, `torque(body = …, value = […], reaction = …)`",
        ),
    ],
    example: "body = …, value = [mx, my, mz]",
    argument: "an argument such as `value = [0, 0, f]`",
};

const PARTS: &str =
    "a wrench has two parts; write `force = […], torque = […]`, of an input `push.force` and `push.torque`";

/// A force at a point of a body, a torque on it, or both.
pub static WRENCH: Row = Row {
    kind: ElementKind::Wrench,
    word: "wrench",
    noun: "wrench",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ElementArgument::optional(AT, ArgumentType::Point, "[l, 0, 0]"),
        ElementArgument::optional(OF_FORCE, ArgumentType::Force, "[fx, fy, fz]"),
        ElementArgument::optional(OF_TORQUE, ArgumentType::Torque, "[mx, my, mz]"),
        IN_AXES,
    ],
    rules: &[
        ArgumentRule::OneOf(
            [OF_FORCE, OF_TORQUE],
            "its components; add `force = [fx, fy, fz]`, `torque = [mx, my, mz]`",
        ),
        ArgumentRule::OnlyWith(
            [AT, OF_FORCE],
            "a torque has no point: it does the same wherever it acts on its body; add `force = …`, or remove `at`",
        ),
    ],
    refused: &[
        (
            "reaction",
            "a wrench acts on one body; a torque between two is `torque(body = …, value = […], reaction = …)`, and the \
             force on the other a `force(…)` of its own",
        ),
        ("value", PARTS),
        ("wrench", PARTS),
    ],
    example: "body = …, force = [fx, fy, fz], torque = [mx, my, mz]",
    argument: "an argument such as `force = [0, 0, f]`",
};

/// Generalised forces; each one delivers the power of its value times the rate of its coordinate.
pub static DRIVE: Row = Row {
    kind: ElementKind::Drive,
    word: "drive",
    noun: "drive",
    form: ClauseForm::Rates,
    arguments: &[ElementArgument::optional(VALUE, ArgumentType::Drive, "k * theta")],
    rules: &[],
    refused: &[],
    example: "theta = …",
    argument: "a generalised force such as `theta = -k * theta`",
};

/// Against elongation, and its rate.
pub static SPRING: Row = Row {
    kind: ElementKind::Spring,
    word: "spring",
    noun: "spring",
    form: ClauseForm::Arguments,
    arguments: &[
        FROM_POINT,
        TO_POINT,
        ALONG_SCALAR,
        STIFF.needed("its force by elongation"),
        ElementArgument::constant(LENGTH, "length", Unit::Extent, "l"),
        DAMPED,
    ],
    rules: &[ArgumentRule::Extent],
    refused: &[],
    example: "from = …, to = …, stiffness = k",
    argument: "an argument such as `stiffness = k`",
};

/// Pushes the extent back between two limits; `width` is the distance over which it sets in.
pub static STOP: Row = Row {
    kind: ElementKind::Stop,
    word: "stop",
    noun: "stop",
    form: ClauseForm::Arguments,
    arguments: &[
        FROM_POINT,
        TO_POINT,
        ALONG_SCALAR,
        ElementArgument::constant(LEAST, "lower limit", Unit::Extent, "a"),
        ElementArgument::constant(MOST, "upper limit", Unit::Extent, "b"),
        STIFF.needed("its force by distance beyond the limit"),
        ElementArgument::checked(WIDTH, "width", Unit::Extent, "e", LawKind::Width)
            .needed("the distance over which it sets in smoothly"),
        DAMPED,
    ],
    rules: &[ArgumentRule::Extent, ArgumentRule::OneOf([LEAST, MOST], "a limit; add `least = …`, `most = …`")],
    refused: &[],
    example: "along = …, least = a, most = b, stiffness = k, width = e",
    argument: "an argument such as `stiffness = k`",
};

/// Against the velocity relative to the medium; `quadratic` by velocity times its magnitude, component by component.
pub static DRAG: Row = Row {
    kind: ElementKind::Drag,
    word: "drag",
    noun: "drag",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ElementArgument::optional(LINEAR, ArgumentType::Coefficients(["N s/m", "N m s"]), SIX),
        ElementArgument::optional(QUADRATIC, ArgumentType::Coefficients(["N s^2/m^2", "N m s^2"]), SIX),
    ],
    rules: &[ArgumentRule::OneOf([LINEAR, QUADRATIC], "its coefficients; add `linear = …`, `quadratic = …`")],
    refused: &[],
    example: "body = …, linear = …, quadratic = …",
    argument: "an argument such as `linear = d`",
};

/// Against the rate of the extent; `width` is the rate at which the dry part is 0.7 of its force.
pub static FRICTION: Row = Row {
    kind: ElementKind::Friction,
    word: "friction",
    noun: "friction law",
    form: ClauseForm::Arguments,
    arguments: &[
        FROM_POINT,
        TO_POINT,
        ALONG_SCALAR,
        ElementArgument::checked(VISCOUS, "viscous part", Unit::ForceByRate, "d", LawKind::Damping),
        ElementArgument::checked(DRY, "dry part", Unit::Force, "f", LawKind::NonNegative),
        ElementArgument::checked(WIDTH, "width", Unit::Rate, "w", LawKind::Width),
    ],
    rules: &[
        ArgumentRule::Extent,
        ArgumentRule::OneOf([VISCOUS, DRY], "a coefficient; add `viscous = …`, `dry = …` with `width = …`"),
        ArgumentRule::With([DRY, WIDTH], "the speed over which the dry part sets in smoothly"),
        ArgumentRule::OnlyWith([WIDTH, DRY], "the width is that of dry friction; add `dry = …`, or remove `width`"),
    ],
    refused: &[],
    example: "along = …, viscous = d",
    argument: "an argument such as `viscous = d`",
};

/// The torque −c (ω − ω′) on `body`, with the angular velocities of `body` and `other`, and its reaction on `other`.
pub static COUPLING: Row = Row {
    kind: ElementKind::Coupling,
    word: "coupling",
    noun: "coupling",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ON_OTHER,
        ElementArgument::checked(VISCOUS, "coefficient", Unit::Is("N m s"), "c", LawKind::Damping)
            .needed("its torque by relative angular velocity"),
    ],
    rules: &[],
    refused: &[],
    example: "body = …, other = …, viscous = c",
    argument: "an argument such as `viscous = c`",
};

/// Against the twist θ of `body` relative to `other` about their third axes, and its rate: the potential ½ k (θ − θ₀)²,
/// with θ − θ₀ between −π and π. The twist is the angle of the turn about e₃ that is nearest to the relative rotation.
pub static TORSIONAL_SPRING: Row = Row {
    kind: ElementKind::TorsionalSpring,
    word: "torsional_spring",
    noun: "torsional spring",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ON_OTHER,
        ElementArgument::checked(STIFFNESS, "stiffness", Unit::Is("N m"), "k", LawKind::Stiffness)
            .needed("its torque by twist"),
        ElementArgument::constant(ANGLE, "angle", Unit::Is("rad"), "a"),
        ElementArgument::checked(DAMPING, "damping", Unit::Is("N m s"), "c", LawKind::Damping),
    ],
    rules: &[],
    refused: &[],
    example: "body = …, other = …, stiffness = k",
    argument: "an argument such as `stiffness = k`",
};

/// Bushing by the place x of `body` relative to `other`, in the axes of `other`: the displacement from O′ to O and the
/// Cardan angles (α, β, γ) of the rotation `rotation_x(α) * rotation_y(β) * rotation_z(γ)`. The potential is ½ xᵀKx,
/// the dissipation function ½ ẋᵀCẋ. The same coordinates as those of `Force::LinearBushing` of Simbody, displacement
/// first.
pub static BUSHING: Row = Row {
    kind: ElementKind::Bushing,
    word: "bushing",
    noun: "bushing",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ON_OTHER,
        ElementArgument::optional(
            STIFFNESS,
            ArgumentType::Matrix { called: "stiffness", units: ["N/m", "N m"], law: LawKind::StiffnessMatrix },
            SIX,
        ),
        ElementArgument::optional(
            DAMPING,
            ArgumentType::Matrix { called: "damping", units: ["N s/m", "N m s"], law: LawKind::DampingMatrix },
            SIX,
        ),
    ],
    rules: &[ArgumentRule::OneOf([STIFFNESS, DAMPING], "its coefficients; add `stiffness = …`, `damping = …`")],
    refused: &[],
    example: "body = …, other = …, stiffness = …, damping = …",
    argument: "an argument such as `stiffness = k`",
};

/// Rayleigh's.
pub static DISSIPATION: Row = Row {
    kind: ElementKind::Dissipation,
    word: "damping",
    noun: "dissipation function",
    form: ClauseForm::Value,
    arguments: &[ElementArgument::optional(VALUE, ArgumentType::Dissipation, "c * v * v / 2")],
    rules: &[],
    refused: &[],
    example: "c * v * v / 2",
    argument: "a dissipation function",
};

/// Matter that a body of varying mass loses or takes up at the place `at`, where it moves with `velocity` relative to
/// the body: the force ṁ u there, and what matter that flows toward the place does to a body that turns. `thrust` is a
/// force at the same place, of the pressure there or, in the place of the velocity, all of it.
pub static MASS_FLOW: Row = Row {
    kind: ElementKind::MassFlow,
    word: "mass_flow",
    noun: "mass flow",
    form: ClauseForm::Arguments,
    arguments: &[
        ON_BODY,
        ElementArgument::optional(AT, ArgumentType::Point, "[l, 0, 0]"),
        ElementArgument::optional(VELOCITY, ArgumentType::FlowVelocity, "[ux, uy, uz]"),
        ElementArgument::optional(THRUST, ArgumentType::Force, "[fx, fy, fz]"),
        IN_AXES,
    ],
    rules: &[ArgumentRule::OneOf(
        [VELOCITY, THRUST],
        "the velocity relative to the body with which matter leaves or enters it; add `velocity = [ux, uy, uz]`, \
         `thrust = [fx, fy, fz]`",
    )],
    refused: &[
        ("value", "the force of a mass flow follows from `velocity`; a force that is known is `thrust = [fx, fy, fz]`"),
        ("mass", "how much flows is the rate of the `mass` of the body: `body(…, mass = m - burn * t)`"),
        ("rate", "how much flows is the rate of the `mass` of the body: `body(…, mass = m - burn * t)`"),
    ],
    example: "body = …, at = …, velocity = [ux, uy, uz]",
    argument: "an argument such as `velocity = [-c, 0, 0]`",
};

/// The acceleration `−mu d/|d|³` of everything with mass, d from the centre. It is no force clause: it acts on all.
pub static ATTRACTION: Row = Row {
    kind: ElementKind::Attraction,
    word: "central_gravity",
    noun: "attraction",
    form: ClauseForm::Arguments,
    arguments: &[
        ElementArgument::checked(MU, "gravitational parameter", Unit::Is("m^3/s^2"), "gm", LawKind::Attraction)
            .needed("its gravitational parameter"),
        ElementArgument::optional(CENTER, ArgumentType::Center, "[x, y, z]"),
    ],
    rules: &[],
    refused: &[],
    example: "mu = gm",
    argument: "an argument such as `mu = gm`",
};

/// Form of six coefficients.
const SIX: &str = "[a, b, c, d, e, f]";
