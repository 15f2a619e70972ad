//! Where expressions stand: which kind of value is needed there, and which names may stand there.

use super::kinds::Kind;
use super::scope::Meaning;
use super::{ConstraintKind, CoordinateKind};
use proc_macro2::Ident;

/// Where an expression stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// The rate of a coordinate; of `None` it is not known which.
    Kinematics(Option<CoordinateKind>),
    /// Of a body or a frame.
    Position,
    /// Of a body or a frame.
    Rotation,
    /// Of a particle, without a parent or relative to one.
    Particle {
        parent: bool,
    },
    Mass,
    /// Of a point in its body.
    At,
    Potential,
    Constraint(ConstraintKind),
}

impl Place {
    /// Whether values of this kind are what is needed.
    pub(super) fn accepts(self, kind: Kind) -> bool {
        match self {
            Place::Kinematics(None) => true,
            Place::Kinematics(Some(CoordinateKind::Scalar)) | Place::Mass | Place::Potential => kind == Kind::Scalar,
            Place::Kinematics(Some(CoordinateKind::Pose)) => kind == Kind::Twist,
            Place::Kinematics(Some(CoordinateKind::Rotation))
            | Place::Position
            | Place::Particle { .. }
            | Place::At => kind == Kind::Vector,
            Place::Rotation => kind == Kind::Rotation,
            Place::Constraint(_) => matches!(kind, Kind::Scalar | Kind::Vector),
        }
    }

    /// What to say of an expression of another kind.
    pub(super) fn mismatch(self, found: Kind) -> String {
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
            Place::At => ("the place of a point in its body is a vector", "write `[x, y, z]`"),
            Place::Rotation => ("expected a rotation", "write `rotation_z(theta)`, or a product of such turns"),
            Place::Mass => ("the mass of a particle is a scalar", "write one number or the name of a field"),
            Place::Potential => ("a potential is a scalar", "write one number, such as `k * x * x / 2`"),
            Place::Constraint(_) => (
                "a constraint is a scalar or a vector that is zero",
                "write numbers that vanish when it holds, such as products of unit vectors",
            ),
        };
        format!("{needed}, found {}; {remedy}", found.noun())
    }

    /// Whether a name with this meaning may stand here.
    pub(super) fn allows(self, meaning: &Meaning) -> bool {
        match meaning {
            Meaning::Scalar | Meaning::Vector | Meaning::Unusable(_) => true,
            Meaning::Time | Meaning::Coordinate(_) => !self.is_constant(),
            Meaning::Speed(_) => self.of_velocities(),
            Meaning::Body | Meaning::Frame | Meaning::Point => {
                matches!(self, Place::Particle { parent: false } | Place::Potential | Place::Constraint(_))
            }
        }
    }

    /// Speeds may stand here.
    fn of_velocities(self) -> bool {
        matches!(self, Place::Kinematics(_) | Place::Constraint(ConstraintKind::Velocity))
    }

    /// Nothing that changes may stand here.
    fn is_constant(self) -> bool {
        matches!(self, Place::Mass | Place::At)
    }

    /// What to say of a name that may not stand here.
    pub(super) fn refusal(self, name: &Ident, meaning: &Meaning) -> String {
        let what = meaning.described();
        match (self, meaning) {
            (Place::Kinematics(_), _) => format!(
                "`{name}` is {what}, and its velocity follows from the kinematics, not the kinematics from it; \
                 write rates in coordinates, speeds, fields and `t`"
            ),
            (Place::Mass, _) => {
                format!("`{name}` varies, and the mass of a particle is constant; write numbers and fields only")
            }
            (Place::At, Meaning::Body | Meaning::Frame | Meaning::Point) => format!(
                "`{name}` is {what}, and a point is given in the axes of its own body; write numbers and fields only"
            ),
            (Place::At, _) => {
                format!("`{name}` varies, and a point is fixed in its body; write numbers and fields only")
            }
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
                let (subject, remedy) = match place {
                    Place::Potential => ("a potential", format!("write the potential without `{name}`")),
                    Place::Rotation => ("a rotation", "speeds stand in `kinematics`".into()),
                    Place::Constraint(_) => ("a constraint of positions", "write `constraint(velocity = …)`".into()),
                    _ => ("a position", "speeds stand in `kinematics`".into()),
                };
                format!("`{name}` is a speed, and {subject} depends on coordinates, fields and `t` only; {remedy}")
            }
        }
    }

    /// What to say of a velocity, `written` so, where none may stand.
    pub(super) fn refuses_velocity(self, written: &str) -> Option<String> {
        let remedy = match self {
            Place::Constraint(ConstraintKind::Velocity) => return None,
            Place::Constraint(ConstraintKind::Position) => "write `constraint(velocity = …)`",
            Place::Kinematics(_) => "the rates of coordinates are written in speeds",
            _ => "remove it",
        };
        Some(format!("`{written}` is a velocity, which only `constraint(velocity = …)` can contain; {remedy}"))
    }
}
