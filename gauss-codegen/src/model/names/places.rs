//! Places of expressions: which kind of value is needed there, and which names may stand there.

pub use super::holder::Holder;
use super::scope::Meaning;
use crate::model::language::kind::ValueKind;
use crate::model::scene::clauses::{ConstraintLevel, CoordinateKind};
use crate::model::scene::elements::ElementKind;
use crate::model::scene::expression::FunctionName;
use crate::terms::{Role, Shape};
use proc_macro2::Ident;

/// Place of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum ExpressionPlace {
    /// The rate of a coordinate; of `None` it is not known which.
    Kinematics(Option<CoordinateKind>),
    /// The rate of a state.
    State,
    /// Position of a body or a frame.
    Position,
    /// Rotation of a body or a frame.
    Rotation,
    /// Position of a particle, without a parent or relative to one.
    Particle {
        parent: bool,
    },
    Mass,
    /// Mass data of a body, in a clause.
    Role(Role),
    /// Position of a point in its body.
    At,
    Potential,
    Constraint(ConstraintLevel),
    /// Gap of a contact.
    Gap,
    /// Velocity along a tangent of a contact.
    Slip,
    /// The coefficient of friction of a contact.
    Friction,
    /// The largest force of dry friction.
    Bound,
    /// The arm of rolling resistance of a contact.
    Rolling,
    /// The point of a contact, or of what it touches.
    Touching,
    /// The normal or a tangent of a plane, the axis of a rim.
    Direction,
    /// Height of a plane.
    Height,
    /// Expression that stays in a range, and the end of the range.
    Limited,
    Limit,
    /// Position of the point where a force acts, in observer axes.
    ForcePoint,
    /// Position of the point where a force acts, in its body; `bound`: there is no other way to say where it acts.
    ForceAt {
        bound: bool,
    },
    /// The components of a force.
    Force,
    /// The components of a torque.
    Torque,
    /// The velocity of matter relative to its body where it leaves or enters it.
    FlowVelocity,
    /// The generalised force on the rate of a coordinate.
    Drive,
    /// Begin or end of the extent of a spring or a stop.
    End(Holder),
    /// The extent of a spring or a stop.
    Along(Holder),
    /// A constant, such as the stiffness of a spring.
    Constant {
        word: &'static str,
        of: Holder,
    },
    /// Rayleigh's.
    Dissipation,
    /// One of the six coefficients of a drag.
    Coefficient(Holder),
    /// The velocity of the medium.
    Medium,
    /// Center that central gravity attracts to.
    Center,
    /// The function of time that a coordinate is.
    Motion,
    /// An expression with a name: what it may contain depends on where the name stands.
    Definition,
}

impl ExpressionPlace {
    /// Whether values of this kind are what is needed.
    pub fn accepts(self, kind: ValueKind) -> bool {
        match self {
            ExpressionPlace::Kinematics(None) => true,
            ExpressionPlace::Kinematics(Some(CoordinateKind::Scalar))
            | ExpressionPlace::Mass
            | ExpressionPlace::Potential => kind == ValueKind::Scalar,
            ExpressionPlace::Gap
            | ExpressionPlace::Slip
            | ExpressionPlace::Friction
            | ExpressionPlace::Bound
            | ExpressionPlace::Rolling => kind == ValueKind::Scalar,
            ExpressionPlace::Limited | ExpressionPlace::Limit | ExpressionPlace::State => kind == ValueKind::Scalar,
            ExpressionPlace::Drive
            | ExpressionPlace::Along(_)
            | ExpressionPlace::Constant { .. }
            | ExpressionPlace::Dissipation
            | ExpressionPlace::Motion
            | ExpressionPlace::Coefficient(_) => kind == ValueKind::Scalar,
            ExpressionPlace::Kinematics(Some(CoordinateKind::Pose)) => kind == ValueKind::Twist,
            ExpressionPlace::Kinematics(Some(CoordinateKind::Rotation))
            | ExpressionPlace::Position
            | ExpressionPlace::Particle { .. }
            | ExpressionPlace::At => kind == ValueKind::Vector,
            ExpressionPlace::ForcePoint
            | ExpressionPlace::ForceAt { .. }
            | ExpressionPlace::Force
            | ExpressionPlace::Torque
            | ExpressionPlace::FlowVelocity
            | ExpressionPlace::End(_) => kind == ValueKind::Vector,
            ExpressionPlace::Medium
            | ExpressionPlace::Center
            | ExpressionPlace::Touching
            | ExpressionPlace::Direction => kind == ValueKind::Vector,
            ExpressionPlace::Height => kind == ValueKind::Scalar,
            ExpressionPlace::Rotation => kind == ValueKind::Rotation,
            ExpressionPlace::Role(role) => match kind {
                ValueKind::Scalar => role.takes(Shape::Scalar),
                ValueKind::Vector => role.takes(Shape::Vector3),
                _ => false,
            },
            ExpressionPlace::Constraint(_) => matches!(kind, ValueKind::Scalar | ValueKind::Vector),
            ExpressionPlace::Definition => kind != ValueKind::Twist,
        }
    }

    /// Message about an expression of another kind.
    pub fn mismatch(self, found: ValueKind) -> String {
        let (needed, remedy) = match self {
            ExpressionPlace::Kinematics(Some(CoordinateKind::Pose)) => (
                "a pose changes by `twist(linear, angular)`, two vectors in body axes",
                "write `twist(u, w)` with speeds `u: Vector3, w: Vector3`",
            ),
            ExpressionPlace::Kinematics(Some(CoordinateKind::Rotation)) => (
                "a rotation changes by its angular velocity, a vector in body axes",
                "write `[w1, w2, w3]`, or the name of a speed `w: Vector3`",
            ),
            ExpressionPlace::Kinematics(_) => {
                ("the rate of a coordinate is a scalar", "write one number, such as `v * cos(theta)`")
            }
            ExpressionPlace::Position | ExpressionPlace::Particle { .. } => {
                ("a position is a vector", "write `[x, y, z]`")
            }
            ExpressionPlace::State => ("the rate of a state is a scalar", "write one number, such as `(u - x) / tau`"),
            ExpressionPlace::At => ("the place of a point in its body is a vector", "write `[x, y, z]`"),
            ExpressionPlace::Rotation => {
                ("expected a rotation", "write `rotation_z(theta)`, or a product of such turns")
            }
            ExpressionPlace::Mass => ("the mass of a particle is a scalar", "write one number or the name of a field"),
            ExpressionPlace::Role(role) => {
                let remedy = match (role.takes(Shape::Scalar), role.takes(Shape::Vector3)) {
                    (true, true) => "write one number or `[a, b, c]`",
                    (false, _) => "write `[x, y, z]`",
                    _ => "write one number",
                };
                return format!("{}, found {}; {remedy}", role.reason(), found.noun());
            }
            ExpressionPlace::Potential => ("a potential is a scalar", "write one number, such as `k * x * x / 2`"),
            ExpressionPlace::Constraint(_) => (
                "a constraint is a scalar or a vector that is zero",
                "write numbers that vanish when it holds, such as products of unit vectors",
            ),
            ExpressionPlace::Gap => ("a gap is a scalar", "write one number, such as `ball.position.z - r`"),
            ExpressionPlace::Slip => ("a slip is a scalar", "write one number, such as `dot(tip.velocity, [1, 0, 0])`"),
            ExpressionPlace::Friction => {
                ("a coefficient of friction is a scalar", "write one number or the name of a field")
            }
            ExpressionPlace::Rolling => {
                ("the arm of rolling resistance is a scalar", "write one number or the name of a field")
            }
            ExpressionPlace::Bound => {
                ("the bound of dry friction is a scalar", "write one number or the name of a field")
            }
            ExpressionPlace::Touching => {
                ("the point of a contact is a vector", "write the name of a point, `arm.position` or `[x, y, z]`")
            }
            ExpressionPlace::Direction => ("a direction is a vector", "write `[a, b, c]`"),
            ExpressionPlace::Height => ("the height of a plane is a scalar", "write one number or the name of a field"),
            ExpressionPlace::Limited if found == ValueKind::Rotation => (
                "what stays in a range is a scalar",
                "how far it may turn from an axis is a gap: `contact(limit, gap = dot(turn * [0, 0, 1], [0, 0, 1]) - \
                 cos(a))`",
            ),
            ExpressionPlace::Limited => {
                ("what stays in a range is a scalar", "write one number, such as the angle of a joint")
            }
            ExpressionPlace::Limit => ("the limit of a range is a scalar", "write one number or the name of a field"),
            ExpressionPlace::ForcePoint => {
                ("the point of a force is a vector", "write the name of a point, `arm.position` or `[x, y, z]`")
            }
            ExpressionPlace::ForceAt { .. } => ("the point of a force in its body is a vector", "write `[x, y, z]`"),
            ExpressionPlace::Force => ("a force is a vector", "write `[fx, fy, fz]`"),
            ExpressionPlace::Torque => ("a torque is a vector", "write `[mx, my, mz]`"),
            ExpressionPlace::FlowVelocity => ("the velocity of a mass flow is a vector", "write `[ux, uy, uz]`"),
            ExpressionPlace::Drive => {
                ("the generalised force on the rate of a scalar coordinate is a scalar", "write one number")
            }
            ExpressionPlace::End(holder) => {
                return format!(
                    "the end of {} is a vector, found {}; write the name of a point, `arm.position` or `[x, y, z]`",
                    holder.noun(),
                    found.noun()
                );
            }
            ExpressionPlace::Along(Holder::Element(row))
                if found == ValueKind::Rotation && row.kind == ElementKind::Friction =>
            {
                (
                    "the extent of a friction law is a scalar",
                    "what brakes a turn is `damping = c * dot(turn.body_angular_velocity, turn.body_angular_velocity) / 2`",
                )
            }
            ExpressionPlace::Along(holder) if found == ValueKind::Rotation => {
                return format!(
                    "the extent of {} is a scalar, found a rotation; how far it may turn from an axis is the cosine \
                     `along = dot(turn * [0, 0, 1], [0, 0, 1])`",
                    holder.noun()
                );
            }
            ExpressionPlace::Along(holder) => {
                return format!(
                    "the extent of {} is a scalar, found {}; write one number such as an angle, or `from = …` and \
                     `to = …` for the distance of two points",
                    holder.noun(),
                    found.noun()
                );
            }
            ExpressionPlace::Constant { word, of } => {
                return format!(
                    "the {word} of {} is a scalar, found {}; write one number or the name of a field",
                    of.noun(),
                    found.noun()
                );
            }
            ExpressionPlace::Coefficient(holder) => {
                return format!(
                    "a coefficient of {} is a scalar, found {}; write one number",
                    holder.noun(),
                    found.noun()
                );
            }
            ExpressionPlace::Medium => ("the velocity of the medium is a vector", "write `[cx, cy, cz]`"),
            ExpressionPlace::Center => ("the center of gravity is a vector", "write `[x, y, z]`"),
            ExpressionPlace::Motion => ("a motion is a scalar", "write one number for every time, such as `w * t`"),
            ExpressionPlace::Definition => ("a definition is a scalar, a vector or a rotation", "write one of them"),
            ExpressionPlace::Dissipation => {
                ("a dissipation function is a scalar", "write one number, such as `c * v * v / 2`")
            }
        };
        format!("{needed}, found {}; {remedy}", found.noun())
    }

    /// Whether a name with this meaning may stand here.
    pub fn allows(self, meaning: &Meaning) -> bool {
        match meaning {
            Meaning::Scalar | Meaning::Vector | Meaning::Definition(_) | Meaning::Unusable(_) => true,
            Meaning::Pi | Meaning::Function(_) => true,
            Meaning::Time => !self.is_constant() || self.is_of_matter(),
            Meaning::Coordinate(_) => !self.is_constant() && !self.is_given(),
            Meaning::Speed(_) => self.of_velocities(),
            Meaning::Input(_) | Meaning::State => self.is_action(),
            Meaning::Body | Meaning::Frame | Meaning::Point => {
                self.is_action()
                    || matches!(
                        self,
                        ExpressionPlace::Particle { parent: false }
                            | ExpressionPlace::Potential
                            | ExpressionPlace::Constraint(_)
                            | ExpressionPlace::Gap
                            | ExpressionPlace::Touching
                            | ExpressionPlace::Slip
                            | ExpressionPlace::Limited
                            | ExpressionPlace::Limit
                            | ExpressionPlace::ForcePoint
                            | ExpressionPlace::End(_)
                            | ExpressionPlace::Along(_)
                    )
            }
        }
    }

    /// Tells whether it is a load: a function of all that is known at an instant.
    fn is_action(self) -> bool {
        matches!(
            self,
            ExpressionPlace::Force
                | ExpressionPlace::Torque
                | ExpressionPlace::FlowVelocity
                | ExpressionPlace::Drive
                | ExpressionPlace::State
                | ExpressionPlace::Dissipation
                | ExpressionPlace::Coefficient(_)
                | ExpressionPlace::Friction
                | ExpressionPlace::Bound
                | ExpressionPlace::Rolling
                | ExpressionPlace::Definition
        )
    }

    /// It is looked at together with the other expressions of its contact.
    pub fn is_of_contact(self) -> bool {
        let constant = matches!(self, ExpressionPlace::Constant { of: Holder::Contact, .. });
        let of_point = matches!(self, ExpressionPlace::Touching | ExpressionPlace::Direction | ExpressionPlace::Height);
        let of_gap = matches!(
            self,
            ExpressionPlace::Gap | ExpressionPlace::Slip | ExpressionPlace::Limited | ExpressionPlace::Limit
        );
        constant
            || of_point
            || of_gap
            || matches!(self, ExpressionPlace::Friction | ExpressionPlace::Bound | ExpressionPlace::Rolling)
    }

    /// Nothing that moves with the system may stand here, but time may.
    fn is_given(self) -> bool {
        use ExpressionPlace::{Center, Height, Medium, Motion};
        matches!(self, Medium | Center | Height | Motion)
    }

    /// Speeds may stand here.
    fn of_velocities(self) -> bool {
        self.is_action()
            || matches!(
                self,
                ExpressionPlace::Kinematics(_)
                    | ExpressionPlace::Constraint(ConstraintLevel::Velocity)
                    | ExpressionPlace::Slip
            )
    }

    /// Nothing that changes may stand here.
    fn is_constant(self) -> bool {
        matches!(
            self,
            ExpressionPlace::Mass
                | ExpressionPlace::Role(_)
                | ExpressionPlace::At
                | ExpressionPlace::ForceAt { .. }
                | ExpressionPlace::Constant { .. }
                | ExpressionPlace::Direction
        )
    }

    /// Mass data, which may be functions of time.
    fn is_of_matter(self) -> bool {
        match self {
            ExpressionPlace::Mass => true,
            ExpressionPlace::Role(role) => role.is_of_matter(),
            ExpressionPlace::Constant { of, .. } => of == Holder::Inertia,
            _ => false,
        }
    }

    /// Noun of the expression here, for messages.
    pub fn subject(self) -> String {
        let subject = match self {
            ExpressionPlace::Kinematics(_) => "the rate of a coordinate",
            ExpressionPlace::State => "the rate of a state",
            ExpressionPlace::Position | ExpressionPlace::Particle { .. } => "a position",
            ExpressionPlace::Rotation => "a rotation",
            ExpressionPlace::Mass => "a mass",
            ExpressionPlace::Role(_) => "a parameter of a body",
            ExpressionPlace::At => "a point of a body",
            ExpressionPlace::Potential => "a potential",
            ExpressionPlace::Constraint(ConstraintLevel::Position) => "a constraint of positions",
            ExpressionPlace::Constraint(ConstraintLevel::Velocity) => "a constraint of velocities",
            ExpressionPlace::Gap => "a gap",
            ExpressionPlace::Slip => "a slip",
            ExpressionPlace::Friction => "a coefficient of friction",
            ExpressionPlace::Bound => "the bound of dry friction",
            ExpressionPlace::Rolling => "the arm of rolling resistance",
            ExpressionPlace::Touching => "the point of a contact",
            ExpressionPlace::Direction => "a direction",
            ExpressionPlace::Height => "the height of a plane",
            ExpressionPlace::Limited => "what stays in a range",
            ExpressionPlace::Limit => "the limit of a range",
            ExpressionPlace::ForcePoint | ExpressionPlace::ForceAt { .. } => "the point of a force",
            ExpressionPlace::Force => "a force",
            ExpressionPlace::Torque => "a torque",
            ExpressionPlace::FlowVelocity => "the velocity of a mass flow",
            ExpressionPlace::Drive => "a generalised force",
            ExpressionPlace::End(holder) => return format!("the end of {}", holder.noun()),
            ExpressionPlace::Along(holder) => return format!("the extent of {}", holder.noun()),
            ExpressionPlace::Constant { of, .. } => return of.constant(),
            ExpressionPlace::Dissipation => "a dissipation function",
            ExpressionPlace::Coefficient(holder) => return format!("a coefficient of {}", holder.noun()),
            ExpressionPlace::Medium => "the velocity of the medium",
            ExpressionPlace::Center => "a center of gravity",
            ExpressionPlace::Motion => "a motion",
            ExpressionPlace::Definition => "a definition",
        };
        subject.into()
    }

    /// Message about a name that may not stand here.
    pub fn refusal(self, name: &Ident, meaning: &Meaning) -> String {
        let what = meaning.described();
        match (self, meaning) {
            (ExpressionPlace::Medium, Meaning::Input(_)) => format!(
                "`{name}` is an input, whose rate is never known, and bodies feel the rate of the velocity of the medium \
                 by their added mass; write it in `t`, fields and numbers"
            ),
            (ExpressionPlace::Medium, _) => format!(
                "`{name}` moves with the system, and there is no added mass in a stream that varies with the place; write \
                 the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as `force(…)`"
            ),
            (ExpressionPlace::Motion, _) => format!(
                "`{name}` is known only as the system moves, and a motion is given beforehand; write it in `t`, fields and \
                 numbers, and what holds between coordinates as `constraint(position = …)`"
            ),
            (_, Meaning::State) => format!(
                "`{name}` is a state of an element, which moves no body and stores no energy that the equations know of; \
                 states stand in values of `force`, `torque`, `wrench` and `drive`, in coefficients of `drag`, in `damping` \
                 and in the rates of `states`"
            ),
            (_, Meaning::Input(_)) => format!(
                "`{name}` is an input, whose value is not known before run time, and whose rate is never; inputs stand \
                 in values of `force`, `torque`, `wrench` and `drive`, in coefficients of `drag`, and in `damping`"
            ),
            (ExpressionPlace::Center, _) => format!(
                "`{name}` moves with the system, and the center of gravity is given beforehand; write it in `t`, fields \
                 and numbers"
            ),
            (ExpressionPlace::Height, _) => format!(
                "`{name}` moves with the system, and the height of a plane is given beforehand; write it in `t`, fields and \
                 numbers, or the whole gap as `gap = …`"
            ),
            (ExpressionPlace::Direction, _) => {
                format!(
                    "`{name}` varies, and a direction is constant; write numbers and fields only, or the whole gap as `gap = …`"
                )
            }
            (ExpressionPlace::Kinematics(_), _) => format!(
                "`{name}` is {what}, and its velocity follows from the kinematics, not the kinematics from it; \
                 write rates in coordinates, speeds, fields and `t`"
            ),
            (ExpressionPlace::Mass, _) => format!(
                "`{name}` moves with the system, and the mass of a particle is given beforehand; write it in `t`, fields \
                 and numbers"
            ),
            (ExpressionPlace::Constant { of: Holder::Inertia, .. }, _) => format!(
                "`{name}` moves with the system, and an inertia is given beforehand; write it in `t`, fields and numbers"
            ),
            (ExpressionPlace::Role(role), _) if role.is_of_matter() => format!(
                "`{name}` moves with the system, and `{}` of a body is given beforehand; write it in `t`, fields and \
                 numbers, and where the mass leaves the body as `mass_flow(…)`",
                role.word()
            ),
            (ExpressionPlace::Role(role), _) => {
                format!("`{name}` varies, and `{}` of a body is constant; write numbers and fields only", role.word())
            }
            (ExpressionPlace::Constant { word, of }, _) => {
                let of = of.noun();
                format!("`{name}` varies, and the {word} of {of} is constant; write numbers and fields only")
            }
            (ExpressionPlace::At, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, and a point is given in the axes of its own body; write numbers and fields only"
            ),
            (ExpressionPlace::At, _) => {
                format!("`{name}` varies, and a point is fixed in its body; write numbers and fields only")
            }
            (ExpressionPlace::ForceAt { bound: true }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and the place where this acts is in the axes of its \
                 body; write numbers and fields, or the name of a point of that body"
            ),
            (ExpressionPlace::ForceAt { bound: true }, _) => format!(
                "`{name}` varies, and the place where this acts is fixed in its body; write numbers and fields only"
            ),
            (ExpressionPlace::ForceAt { .. }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and with `body` a force acts at a place in the axes \
                 of that body; write numbers and fields, the name of a point of that body, or leave `body` out"
            ),
            (ExpressionPlace::ForceAt { .. }, _) => format!(
                "`{name}` varies, and with `body` a force acts at a fixed place of that body; write numbers and fields \
                 only, or leave `body` out"
            ),
            (ExpressionPlace::Position | ExpressionPlace::Rotation, Meaning::Body | Meaning::Frame) => format!(
                "`{name}` is {what}, and bodies are placed relative to one another by parents; \
                 write `parent = {name}` and what is relative to it"
            ),
            (ExpressionPlace::Position | ExpressionPlace::Rotation, Meaning::Point) => format!(
                "`{name}` is a point, and bodies are placed relative to one another by parents; \
                 write `parent = …` with its body"
            ),
            (ExpressionPlace::Particle { .. }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and the position of a particle with a parent is in \
                 the axes of the parent; leave `parent` out, or write the position without `{name}`"
            ),
            (place, _) => {
                let remedy = match place {
                    ExpressionPlace::Potential => "write what depends on velocities as `force(…)` or `damping = …`",
                    ExpressionPlace::Constraint(_) => "write `constraint(velocity = …)`",
                    ExpressionPlace::Gap | ExpressionPlace::Touching => {
                        "its rate is formed from it; velocities stand in `slip = …`"
                    }
                    ExpressionPlace::Limited | ExpressionPlace::Limit => {
                        "a constraint of velocities is `constraint(velocity = …)`"
                    }
                    ExpressionPlace::ForcePoint | ExpressionPlace::End(_) | ExpressionPlace::Along(_) => {
                        "speeds stand in values of forces"
                    }
                    _ => "speeds stand in `kinematics`",
                };
                let subject = place.subject();
                format!("`{name}` is a speed, and {subject} depends on coordinates, fields and `t` only; {remedy}")
            }
        }
    }

    /// Message about a velocity, `written` so, where none may stand.
    pub fn refuses_velocity(self, written: &str) -> Option<String> {
        let remedy = match self {
            place if place.is_action() => return None,
            ExpressionPlace::Constraint(ConstraintLevel::Velocity) | ExpressionPlace::Slip => return None,
            ExpressionPlace::Constraint(ConstraintLevel::Position) => "write `constraint(velocity = …)`",
            ExpressionPlace::Gap | ExpressionPlace::Touching => {
                "its rate is formed from it; velocities stand in `slip = …`"
            }
            ExpressionPlace::Kinematics(_) => "the rates of coordinates are written in speeds",
            ExpressionPlace::Potential => "write what depends on velocities as `force(…)` or `damping = …`",
            _ => "remove it",
        };
        Some(format!(
            "`{written}` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; {remedy}"
        ))
    }

    /// Whether functions that are not smooth may stand here: no derivative is taken, or what is defined is looked at
    /// where it is used.
    fn takes_kinks(self) -> bool {
        matches!(
            self,
            ExpressionPlace::Force
                | ExpressionPlace::Torque
                | ExpressionPlace::FlowVelocity
                | ExpressionPlace::Drive
                | ExpressionPlace::Coefficient(_)
                | ExpressionPlace::State
                | ExpressionPlace::Friction
                | ExpressionPlace::Bound
                | ExpressionPlace::Rolling
                | ExpressionPlace::Definition
        )
    }

    /// Why nothing that is not smooth may stand here.
    pub fn refuses_kinks(self) -> Option<String> {
        match self {
            place if place.takes_kinks() => None,
            ExpressionPlace::Dissipation => Some("forces are derivatives of a dissipation function".into()),
            place if place.is_constant() => None,
            place => Some(format!("{} is differentiated", place.subject())),
        }
    }

    /// Message about a function that is not smooth, where derivatives are taken.
    pub fn refuses_kink(self, function: FunctionName) -> Option<String> {
        match self {
            place if place.takes_kinks() => None,
            place if place.is_of_matter() => Some(format!(
                "`{}` stands in values of forces only; make the number a field of the struct, or the function of time a \
                 `table(…)`",
                function.word()
            )),
            place if place.is_constant() => Some(format!(
                "`{}` stands in values of forces only; make the number a field of the struct",
                function.word()
            )),
            ExpressionPlace::Dissipation => Some(format!(
                "{}, and forces are derivatives of a dissipation function; write the force itself as `force(…)`, \
                 `torque(…)` or `drive(…)`",
                function.jump()
            )),
            place => Some(format!(
                "{}, and {} is differentiated; only values of forces can contain it",
                function.jump(),
                place.subject()
            )),
        }
    }
}
