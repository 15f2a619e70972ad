//! Roles of fields, and the shapes of their values.

/// Shape of a field's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// Three numbers.
    Vector3,
    /// Three by three.
    Matrix3,
    /// Six numbers, order (linear, angular).
    Vector6,
    /// Six by six, order (linear, angular).
    Matrix6,
    /// Mass, centre of mass and inertia of a body.
    RigidBody,
    /// The same with the inertia about the centre of mass.
    CentralBody,
    /// Anything else: only plain parameters have it.
    Other,
}

impl Shape {
    /// Whether it is that of a whole body.
    pub fn is_body(self) -> bool {
        matches!(self, Shape::RigidBody | Shape::CentralBody)
    }
}

/// Role of a field in the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The mass m: scalar.
    Mass,
    /// G − O in body axes: vector.
    CenterOfMass,
    /// About O, body axes: scalar (spherical), vector (principal) or matrix (full).
    Inertia,
    /// The same about G.
    CentralInertia,
    /// Six by six about O, body axes: vector (diagonal) or matrix (full).
    AddedMass,
    /// Scalar along −k₃, or a vector in observer axes.
    Gravity,
    /// Mass of the displaced fluid: scalar.
    DisplacedMass,
    /// The point where buoyancy acts, body axes from O: vector.
    CenterOfBuoyancy,
    /// A body, named like the field.
    Body,
}

impl Role {
    /// It is of the body itself, not of the fluid about it.
    pub fn is_of_matter(self) -> bool {
        matches!(self, Role::Mass | Role::CenterOfMass | Role::Inertia | Role::CentralInertia)
    }

    /// The word in `#[gauss(word)]`.
    pub fn word(self) -> &'static str {
        match self {
            Role::Mass => "mass",
            Role::CenterOfMass => "center_of_mass",
            Role::Inertia => "inertia",
            Role::CentralInertia => "inertia_about_center_of_mass",
            Role::AddedMass => "added_mass",
            Role::Gravity => "gravity",
            Role::DisplacedMass => "displaced_mass",
            Role::CenterOfBuoyancy => "center_of_buoyancy",
            Role::Body => "body",
        }
    }
}
