//! Places of expressions: which kind of value is needed there, and which names may stand there.

use super::scope::Meaning;
use crate::model::language::kind::Kind;
use crate::model::language::words;
use crate::model::scene::clauses::{ConstraintKind, CoordinateKind};
use crate::model::scene::elements::{ElementKind, Row};
use crate::model::scene::expression::FunctionName;
use crate::terms::{Role, Shape};
use proc_macro2::Ident;

/// Owners of ends, an extent, constants or coefficients.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    Element(&'static Row),
    Armature,
    Modes,
    AddedMass,
    Inertia,
    Contact,
}

impl Holder {
    /// Noun in messages, with its article.
    fn noun(self) -> String {
        match self {
            Holder::Element(row) => words::a(row.noun),
            Holder::Armature => "an armature".into(),
            Holder::Modes => "modes".into(),
            Holder::AddedMass => "an added mass".into(),
            Holder::Inertia => "an inertia".into(),
            Holder::Contact => "a contact".into(),
        }
    }

    /// Words for its constants.
    fn constant(self) -> String {
        match self {
            Holder::Element(_) | Holder::Contact => format!("a constant of {}", self.noun()),
            Holder::Armature | Holder::Modes | Holder::AddedMass | Holder::Inertia => self.noun(),
        }
    }
}

/// Place of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Place {
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
    Constraint(ConstraintKind),
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
    /// An expression with a name: what it may contain depends on where the name stands.
    Definition,
}

impl Place {
    /// Whether values of this kind are what is needed.
    pub fn accepts(self, kind: Kind) -> bool {
        match self {
            Place::Kinematics(None) => true,
            Place::Kinematics(Some(CoordinateKind::Scalar)) | Place::Mass | Place::Potential => kind == Kind::Scalar,
            Place::Gap | Place::Slip | Place::Friction | Place::Bound | Place::Rolling => kind == Kind::Scalar,
            Place::Limited | Place::Limit | Place::State => kind == Kind::Scalar,
            Place::Drive | Place::Along(_) | Place::Constant { .. } | Place::Dissipation | Place::Coefficient(_) => {
                kind == Kind::Scalar
            }
            Place::Kinematics(Some(CoordinateKind::Pose)) => kind == Kind::Twist,
            Place::Kinematics(Some(CoordinateKind::Rotation))
            | Place::Position
            | Place::Particle { .. }
            | Place::At => kind == Kind::Vector,
            Place::ForcePoint | Place::ForceAt { .. } | Place::Force | Place::Torque | Place::End(_) => {
                kind == Kind::Vector
            }
            Place::Medium | Place::Center | Place::Touching | Place::Direction => kind == Kind::Vector,
            Place::Height => kind == Kind::Scalar,
            Place::Rotation => kind == Kind::Rotation,
            Place::Role(role) => match kind {
                Kind::Scalar => role.takes(Shape::Scalar),
                Kind::Vector => role.takes(Shape::Vector3),
                _ => false,
            },
            Place::Constraint(_) => matches!(kind, Kind::Scalar | Kind::Vector),
            Place::Definition => kind != Kind::Twist,
        }
    }

    /// Message about an expression of another kind.
    pub fn mismatch(self, found: Kind) -> String {
        let (needed, remedy) = match self {
            Place::Kinematics(Some(CoordinateKind::Pose)) => (
                "a pose changes by `twist(linear, angular)`, two vectors in body axes",
                "write `twist(u, w)` with speeds `u: Vector3, w: Vector3`",
            ),
            Place::Kinematics(Some(CoordinateKind::Rotation)) => (
                "a rotation changes by its angular velocity, a vector in body axes",
                "write `[w1, w2, w3]`, or the name of a speed `w: Vector3`",
            ),
            Place::Kinematics(_) => {
                ("the rate of a coordinate is a scalar", "write one number, such as `v * cos(theta)`")
            }
            Place::Position | Place::Particle { .. } => ("a position is a vector", "write `[x, y, z]`"),
            Place::State => ("the rate of a state is a scalar", "write one number, such as `(u - x) / tau`"),
            Place::At => ("the place of a point in its body is a vector", "write `[x, y, z]`"),
            Place::Rotation => ("expected a rotation", "write `rotation_z(theta)`, or a product of such turns"),
            Place::Mass => ("the mass of a particle is a scalar", "write one number or the name of a field"),
            Place::Role(role) => {
                let remedy = match (role.takes(Shape::Scalar), role.takes(Shape::Vector3)) {
                    (true, true) => "write one number or `[a, b, c]`",
                    (false, _) => "write `[x, y, z]`",
                    _ => "write one number",
                };
                return format!("{}, found {}; {remedy}", role.reason(), found.noun());
            }
            Place::Potential => ("a potential is a scalar", "write one number, such as `k * x * x / 2`"),
            Place::Constraint(_) => (
                "a constraint is a scalar or a vector that is zero",
                "write numbers that vanish when it holds, such as products of unit vectors",
            ),
            Place::Gap => ("a gap is a scalar", "write one number, such as `ball.position.z - r`"),
            Place::Slip => ("a slip is a scalar", "write one number, such as `dot(tip.velocity, [1, 0, 0])`"),
            Place::Friction => ("a coefficient of friction is a scalar", "write one number or the name of a field"),
            Place::Rolling => ("the arm of rolling resistance is a scalar", "write one number or the name of a field"),
            Place::Bound => ("the bound of dry friction is a scalar", "write one number or the name of a field"),
            Place::Touching => {
                ("the point of a contact is a vector", "write the name of a point, `arm.position` or `[x, y, z]`")
            }
            Place::Direction => ("a direction is a vector", "write `[a, b, c]`"),
            Place::Height => ("the height of a plane is a scalar", "write one number or the name of a field"),
            Place::Limited if found == Kind::Rotation => (
                "what stays in a range is a scalar",
                "how far it may turn from an axis is a gap: `contact(limit, gap = dot(turn * [0, 0, 1], [0, 0, 1]) - \
                 cos(a))`",
            ),
            Place::Limited => ("what stays in a range is a scalar", "write one number, such as the angle of a joint"),
            Place::Limit => ("the limit of a range is a scalar", "write one number or the name of a field"),
            Place::ForcePoint => {
                ("the point of a force is a vector", "write the name of a point, `arm.position` or `[x, y, z]`")
            }
            Place::ForceAt { .. } => ("the point of a force in its body is a vector", "write `[x, y, z]`"),
            Place::Force => ("a force is a vector", "write `[fx, fy, fz]`"),
            Place::Torque => ("a torque is a vector", "write `[mx, my, mz]`"),
            Place::Drive => {
                ("the generalised force on the rate of a scalar coordinate is a scalar", "write one number")
            }
            Place::End(holder) => {
                return format!(
                    "the end of {} is a vector, found {}; write the name of a point, `arm.position` or `[x, y, z]`",
                    holder.noun(),
                    found.noun()
                );
            }
            Place::Along(Holder::Element(row)) if found == Kind::Rotation && row.kind == ElementKind::Friction => (
                "the extent of a friction law is a scalar",
                "what brakes a turn is `damping = c * dot(turn.body_angular_velocity, turn.body_angular_velocity) / 2`",
            ),
            Place::Along(holder) if found == Kind::Rotation => {
                return format!(
                    "the extent of {} is a scalar, found a rotation; how far it may turn from an axis is the cosine \
                     `along = dot(turn * [0, 0, 1], [0, 0, 1])`",
                    holder.noun()
                );
            }
            Place::Along(holder) => {
                return format!(
                    "the extent of {} is a scalar, found {}; write one number such as an angle, or `from = …` and \
                     `to = …` for the distance of two points",
                    holder.noun(),
                    found.noun()
                );
            }
            Place::Constant { word, of } => {
                return format!(
                    "the {word} of {} is a scalar, found {}; write one number or the name of a field",
                    of.noun(),
                    found.noun()
                );
            }
            Place::Coefficient(holder) => {
                return format!(
                    "a coefficient of {} is a scalar, found {}; write one number",
                    holder.noun(),
                    found.noun()
                );
            }
            Place::Medium => ("the velocity of the medium is a vector", "write `[cx, cy, cz]`"),
            Place::Center => ("the center of gravity is a vector", "write `[x, y, z]`"),
            Place::Definition => ("a definition is a scalar, a vector or a rotation", "write one of them"),
            Place::Dissipation => ("a dissipation function is a scalar", "write one number, such as `c * v * v / 2`"),
        };
        format!("{needed}, found {}; {remedy}", found.noun())
    }

    /// Whether a name with this meaning may stand here.
    pub fn allows(self, meaning: &Meaning) -> bool {
        match meaning {
            Meaning::Scalar | Meaning::Vector | Meaning::Definition(_) | Meaning::Unusable(_) => true,
            Meaning::Pi | Meaning::Function(_) => true,
            Meaning::Time => !self.is_constant(),
            Meaning::Coordinate(_) => !self.is_constant() && !self.is_given(),
            Meaning::Speed(_) => self.of_velocities(),
            Meaning::Input(_) | Meaning::State => self.is_action(),
            Meaning::Body | Meaning::Frame | Meaning::Point => {
                self.is_action()
                    || matches!(
                        self,
                        Place::Particle { parent: false }
                            | Place::Potential
                            | Place::Constraint(_)
                            | Place::Gap
                            | Place::Touching
                            | Place::Slip
                            | Place::Limited
                            | Place::Limit
                            | Place::ForcePoint
                            | Place::End(_)
                            | Place::Along(_)
                    )
            }
        }
    }

    /// Tells whether it is a load: a function of all that is known at an instant.
    fn is_action(self) -> bool {
        matches!(
            self,
            Place::Force
                | Place::Torque
                | Place::Drive
                | Place::State
                | Place::Dissipation
                | Place::Coefficient(_)
                | Place::Friction
                | Place::Bound
                | Place::Rolling
                | Place::Definition
        )
    }

    /// It is looked at together with the other expressions of its contact.
    pub fn is_of_contact(self) -> bool {
        let constant = matches!(self, Place::Constant { of: Holder::Contact, .. });
        let of_point = matches!(self, Place::Touching | Place::Direction | Place::Height);
        let of_gap = matches!(self, Place::Gap | Place::Slip | Place::Limited | Place::Limit);
        constant || of_point || of_gap || matches!(self, Place::Friction | Place::Bound | Place::Rolling)
    }

    /// Nothing that moves with the system may stand here, but time may.
    fn is_given(self) -> bool {
        matches!(self, Place::Medium | Place::Center | Place::Height)
    }

    /// Speeds may stand here.
    fn of_velocities(self) -> bool {
        self.is_action()
            || matches!(self, Place::Kinematics(_) | Place::Constraint(ConstraintKind::Velocity) | Place::Slip)
    }

    /// Nothing that changes may stand here.
    fn is_constant(self) -> bool {
        matches!(
            self,
            Place::Mass
                | Place::Role(_)
                | Place::At
                | Place::ForceAt { .. }
                | Place::Constant { .. }
                | Place::Direction
        )
    }

    /// Noun of the expression here, for messages.
    pub fn subject(self) -> String {
        let subject = match self {
            Place::Kinematics(_) => "the rate of a coordinate",
            Place::State => "the rate of a state",
            Place::Position | Place::Particle { .. } => "a position",
            Place::Rotation => "a rotation",
            Place::Mass => "a mass",
            Place::Role(_) => "a parameter of a body",
            Place::At => "a point of a body",
            Place::Potential => "a potential",
            Place::Constraint(ConstraintKind::Position) => "a constraint of positions",
            Place::Constraint(ConstraintKind::Velocity) => "a constraint of velocities",
            Place::Gap => "a gap",
            Place::Slip => "a slip",
            Place::Friction => "a coefficient of friction",
            Place::Bound => "the bound of dry friction",
            Place::Rolling => "the arm of rolling resistance",
            Place::Touching => "the point of a contact",
            Place::Direction => "a direction",
            Place::Height => "the height of a plane",
            Place::Limited => "what stays in a range",
            Place::Limit => "the limit of a range",
            Place::ForcePoint | Place::ForceAt { .. } => "the point of a force",
            Place::Force => "a force",
            Place::Torque => "a torque",
            Place::Drive => "a generalised force",
            Place::End(holder) => return format!("the end of {}", holder.noun()),
            Place::Along(holder) => return format!("the extent of {}", holder.noun()),
            Place::Constant { of, .. } => return of.constant(),
            Place::Dissipation => "a dissipation function",
            Place::Coefficient(holder) => return format!("a coefficient of {}", holder.noun()),
            Place::Medium => "the velocity of the medium",
            Place::Center => "a center of gravity",
            Place::Definition => "a definition",
        };
        subject.into()
    }

    /// Message about a name that may not stand here.
    pub fn refusal(self, name: &Ident, meaning: &Meaning) -> String {
        let what = meaning.described();
        match (self, meaning) {
            (Place::Medium, Meaning::Input(_)) => format!(
                "`{name}` is an input, whose rate is never known, and bodies feel the rate of the velocity of the medium \
                 by their added mass; write it in `t`, fields and numbers"
            ),
            (Place::Medium, _) => format!(
                "`{name}` moves with the system, and there is no added mass in a stream that varies with the place; write \
                 the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as `force(…)`"
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
            (Place::Center, _) => format!(
                "`{name}` moves with the system, and the center of gravity is given beforehand; write it in `t`, fields \
                 and numbers"
            ),
            (Place::Height, _) => format!(
                "`{name}` moves with the system, and the height of a plane is given beforehand; write it in `t`, fields and \
                 numbers, or the whole gap as `gap = …`"
            ),
            (Place::Direction, _) => {
                format!(
                    "`{name}` varies, and a direction is constant; write numbers and fields only, or the whole gap as `gap = …`"
                )
            }
            (Place::Kinematics(_), _) => format!(
                "`{name}` is {what}, and its velocity follows from the kinematics, not the kinematics from it; \
                 write rates in coordinates, speeds, fields and `t`"
            ),
            (Place::Mass, _) => format!(
                "`{name}` varies, and the mass of a particle is constant; write numbers and fields only; a particle that \
                 loses mass moves as one of mass 1 does on which every force is divided by m(t)"
            ),
            (Place::Role(role), _) => {
                format!("`{name}` varies, and `{}` of a body is constant; write numbers and fields only", role.word())
            }
            (Place::Constant { word, of }, _) => {
                let of = of.noun();
                format!("`{name}` varies, and the {word} of {of} is constant; write numbers and fields only")
            }
            (Place::At, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, and a point is given in the axes of its own body; write numbers and fields only"
            ),
            (Place::At, _) => {
                format!("`{name}` varies, and a point is fixed in its body; write numbers and fields only")
            }
            (Place::ForceAt { bound: true }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and the place where this acts is in the axes of its \
                 body; write numbers and fields, or the name of a point of that body"
            ),
            (Place::ForceAt { bound: true }, _) => format!(
                "`{name}` varies, and the place where this acts is fixed in its body; write numbers and fields only"
            ),
            (Place::ForceAt { .. }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and with `body` a force acts at a place in the axes \
                 of that body; write numbers and fields, the name of a point of that body, or leave `body` out"
            ),
            (Place::ForceAt { .. }, _) => format!(
                "`{name}` varies, and with `body` a force acts at a fixed place of that body; write numbers and fields \
                 only, or leave `body` out"
            ),
            (Place::Position | Place::Rotation, Meaning::Body | Meaning::Frame) => format!(
                "`{name}` is {what}, and bodies are placed relative to one another by parents; \
                 write `parent = {name}` and what is relative to it"
            ),
            (Place::Position | Place::Rotation, Meaning::Point) => format!(
                "`{name}` is a point, and bodies are placed relative to one another by parents; \
                 write `parent = …` with its body"
            ),
            (Place::Particle { .. }, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, which is known in observer axes, and the position of a particle with a parent is in \
                 the axes of the parent; leave `parent` out, or write the position without `{name}`"
            ),
            (place, _) => {
                let remedy = match place {
                    Place::Potential => "write what depends on velocities as `force(…)` or `damping = …`",
                    Place::Constraint(_) => "write `constraint(velocity = …)`",
                    Place::Gap | Place::Touching => "its rate is formed from it; velocities stand in `slip = …`",
                    Place::Limited | Place::Limit => "a constraint of velocities is `constraint(velocity = …)`",
                    Place::ForcePoint | Place::End(_) | Place::Along(_) => "speeds stand in values of forces",
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
            Place::Constraint(ConstraintKind::Velocity) | Place::Slip => return None,
            Place::Constraint(ConstraintKind::Position) => "write `constraint(velocity = …)`",
            Place::Gap | Place::Touching => "its rate is formed from it; velocities stand in `slip = …`",
            Place::Kinematics(_) => "the rates of coordinates are written in speeds",
            Place::Potential => "write what depends on velocities as `force(…)` or `damping = …`",
            _ => "remove it",
        };
        Some(format!(
            "`{written}` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; {remedy}"
        ))
    }

    /// Why nothing that is not smooth may stand here.
    pub fn refuses_kinks(self) -> Option<String> {
        match self {
            Place::Force | Place::Torque | Place::Drive | Place::Coefficient(_) | Place::State => None,
            Place::Friction | Place::Bound | Place::Rolling | Place::Definition => None,
            Place::Dissipation => Some("forces are derivatives of a dissipation function".into()),
            place if place.is_constant() => None,
            place => Some(format!("{} is differentiated", place.subject())),
        }
    }

    /// Message about a function that is not smooth, where derivatives are taken.
    pub fn refuses_kink(self, function: FunctionName) -> Option<String> {
        match self {
            Place::Force | Place::Torque | Place::Drive | Place::Coefficient(_) | Place::State => None,
            Place::Friction | Place::Bound | Place::Rolling | Place::Definition => None,
            place if place.is_constant() => Some(format!(
                "`{}` stands in values of forces only; make the number a field of the struct",
                function.word()
            )),
            Place::Dissipation => Some(format!(
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
