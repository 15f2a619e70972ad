//! Words for each role, the shapes that it takes and the reasons.

use super::units::Dimension;
use super::words::Table;
use crate::terms::{Role, Shape};

/// Every role by its word.
pub const ROLES: &Table<Role> = &[
    ("mass", Role::Mass),
    ("center_of_mass", Role::CenterOfMass),
    ("inertia", Role::Inertia),
    ("inertia_about_center_of_mass", Role::CentralInertia),
    ("added_mass", Role::AddedMass),
    ("gravity", Role::Gravity),
    ("displaced_mass", Role::DisplacedMass),
    ("center_of_buoyancy", Role::CenterOfBuoyancy),
];

/// The roles in a system: its bodies are fields too.
pub const SYSTEM_ROLES: &Table<Role> = &[
    ("mass", Role::Mass),
    ("center_of_mass", Role::CenterOfMass),
    ("inertia", Role::Inertia),
    ("inertia_about_center_of_mass", Role::CentralInertia),
    ("added_mass", Role::AddedMass),
    ("gravity", Role::Gravity),
    ("displaced_mass", Role::DisplacedMass),
    ("center_of_buoyancy", Role::CenterOfBuoyancy),
    ("body", Role::Body),
];

impl Role {
    /// The words after `=` that choose among the shapes of a role; none where there is nothing to choose.
    pub fn forms(self) -> &'static Table<Shape> {
        match self {
            Role::Inertia | Role::CentralInertia => {
                &[("spherical", Shape::Scalar), ("principal", Shape::Vector3), ("full", Shape::Matrix3)]
            }
            Role::AddedMass => &[("diagonal", Shape::Vector6), ("full", Shape::Matrix6)],
            Role::Gravity => &[("vertical", Shape::Scalar), ("vector", Shape::Vector3)],
            // Without a word its inertia is about O.
            Role::Body => &[("about_center_of_mass", Shape::CentralBody)],
            Role::Mass | Role::CenterOfMass | Role::DisplacedMass | Role::CenterOfBuoyancy => &[],
        }
    }

    /// The shape of a role that has only one.
    pub fn only_shape(self) -> Option<Shape> {
        match self {
            Role::Mass | Role::DisplacedMass => Some(Shape::Scalar),
            Role::CenterOfMass | Role::CenterOfBuoyancy => Some(Shape::Vector3),
            Role::Body => Some(Shape::RigidBody),
            Role::Inertia | Role::CentralInertia | Role::AddedMass | Role::Gravity => None,
        }
    }

    /// Whether a field of this role may have the shape.
    pub fn takes(self, shape: Shape) -> bool {
        self.only_shape() == Some(shape) || self.forms().iter().any(|(_, form)| *form == shape)
    }

    /// The types that a field of this role may have, for messages.
    pub fn expected(self, scalar: &str) -> String {
        if let Some(shape) = self.only_shape() {
            return format!("`{}`", shape.written(scalar));
        }
        let forms = self.forms();
        let mut text = String::new();
        for (index, (word, shape)) in forms.iter().enumerate() {
            if index > 0 {
                text.push_str(if index + 1 == forms.len() { " or " } else { ", " });
            }
            text.push_str(&format!("`{}` ({word})", shape.written(scalar)));
        }
        text
    }

    /// Why the role has these shapes and no others.
    pub fn reason(self) -> &'static str {
        match self {
            Role::Mass => "the mass of a body is one number",
            Role::CenterOfMass => "the centre of mass is a point, in body axes from O",
            Role::Inertia => "the inertia about O is one number, three principal moments or a tensor",
            Role::CentralInertia => {
                "the inertia about the centre of mass is one number, three principal moments or a tensor"
            }
            Role::AddedMass => "added mass acts on three linear and three angular speeds",
            Role::Gravity => "gravity is a magnitude along −k₃ or a vector in observer axes",
            Role::DisplacedMass => "the mass of the displaced fluid is one number",
            Role::CenterOfBuoyancy => "the centre of buoyancy is a point, in body axes from O",
            Role::Body => "a body of a system has mass, centre of mass and inertia together",
        }
    }

    /// The unit of a role that has one, and its dimension.
    pub fn unit(self) -> Option<(&'static str, Dimension)> {
        match self {
            Role::Mass | Role::DisplacedMass => Some(("kg", Dimension::new(1, 0, 0))),
            Role::CenterOfMass | Role::CenterOfBuoyancy => Some(("m", Dimension::new(0, 1, 0))),
            Role::Inertia | Role::CentralInertia => Some(("kg m^2", Dimension::new(1, 2, 0))),
            Role::Gravity => Some(("m/s^2", Dimension::new(0, 1, -2))),
            Role::AddedMass | Role::Body => None,
        }
    }

    /// A field that plays the role, as remedy where it is missing.
    pub fn example(self, scalar: &str) -> String {
        let (name, shape) = match self {
            Role::Mass => ("mass", Shape::Scalar),
            Role::CenterOfMass => ("center", Shape::Vector3),
            Role::Inertia | Role::CentralInertia => ("inertia", Shape::Vector3),
            Role::AddedMass => ("added_mass", Shape::Matrix6),
            Role::Gravity => ("g", Shape::Scalar),
            Role::DisplacedMass => ("displaced", Shape::Scalar),
            Role::CenterOfBuoyancy => ("buoyancy_center", Shape::Vector3),
            Role::Body => ("name", Shape::RigidBody),
        };
        format!("#[gauss({})] {name}: {}", self.word(), shape.written(scalar))
    }
}

impl Shape {
    /// The type that has this shape.
    pub fn written(self, scalar: &str) -> String {
        match self {
            Shape::Scalar => scalar.into(),
            Shape::Vector3 => format!("Vector3<{scalar}>"),
            Shape::Matrix3 => format!("Matrix3<{scalar}>"),
            Shape::Vector6 => format!("Vector6<{scalar}>"),
            Shape::Matrix6 => format!("Matrix6<{scalar}>"),
            Shape::RigidBody => format!("RigidBody<{scalar}>"),
            Shape::CentralBody => format!("RigidBody<{scalar}, AboutCenterOfMass<{scalar}>>"),
            Shape::Other => "_".into(),
        }
    }
}
