//! What a file says of a robot, whatever its format: plain data in SI units.

use super::rotation::{Matrix, Rotation, Triple};

/// A place in the file, counted from one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct At {
    pub line: u32,
    pub column: u32,
}

/// What is wrong, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    pub at: At,
    pub message: String,
}

/// What a reader of the equations should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    pub at: At,
    pub text: String,
    /// Something that acts in the file does not act in the equations.
    pub ignored: bool,
}

/// A robot: a tree of links.
#[derive(Clone, Debug, Default)]
pub struct Description {
    pub links: Vec<Link>,
    /// In the order of the file.
    pub joints: Vec<Joint>,
    /// Joints that a transmission or an actuator drives.
    pub driven: Vec<String>,
    /// The others are driven by nothing.
    pub only_driven: bool,
    /// Links that are joined beside the tree.
    pub closures: Vec<Closure>,
    /// The acceleration of free fall in observer's axes, where the file says so.
    pub gravity: Option<Triple>,
    pub notes: Vec<Note>,
}

/// A body with axes of its own.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    pub at: At,
    pub inertial: Option<Inertial>,
}

/// Mass data in the axes of the link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    pub mass: f64,
    /// From O.
    pub center: Triple,
    /// About the centre of mass.
    pub inertia: Matrix,
}

/// What a link moves by, relative to its parent.
#[derive(Clone, Debug)]
pub struct Joint {
    pub name: String,
    pub at: At,
    pub kind: JointKind,
    /// Names of links.
    pub parent: String,
    pub child: String,
    /// Where the child is while the coordinates are zero, in the axes of the parent.
    pub position: Triple,
    pub rotation: Rotation,
    /// Of length one, in the axes of the child; of a plane its normal.
    pub axis: Triple,
    pub mimic: Option<Mimic>,
    /// The least and the most value of the coordinate.
    pub limits: [Option<f64>; 2],
    /// Force by rate.
    pub damping: f64,
    /// The force of dry friction.
    pub friction: f64,
    /// Force by coordinate beyond the rest of a spring.
    pub stiffness: f64,
    pub rest: f64,
    /// Inertia of the joint alone, such as that of a rotor behind gears.
    pub armature: f64,
    /// The value of the coordinate where nothing is turned or moved.
    pub reference: f64,
}

impl Joint {
    /// Without laws and limits, at the origin of its parent.
    pub fn new(name: String, at: At, kind: JointKind, parent: String, child: String) -> Joint {
        Joint {
            name,
            at,
            kind,
            parent,
            child,
            position: [0.0; 3],
            rotation: Rotation::none(),
            axis: [0.0, 0.0, 1.0],
            mimic: None,
            limits: [None; 2],
            damping: 0.0,
            friction: 0.0,
            stiffness: 0.0,
            rest: 0.0,
            armature: 0.0,
            reference: 0.0,
        }
    }
}

/// Two links that have a point in common, which is at `anchor` in the axes of the first.
#[derive(Clone, Debug)]
pub struct Closure {
    pub at: At,
    pub links: [String; 2],
    pub anchor: Triple,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    Fixed,
    /// About the axis.
    Turning,
    /// Along the axis.
    Sliding,
    /// Two ways and a turn in the plane normal to the axis.
    Planar,
    /// About the origin.
    Ball,
    Floating,
}

/// The coordinate is `multiplier` times that of another joint, and `offset`.
#[derive(Clone, Debug)]
pub struct Mimic {
    pub at: At,
    pub joint: String,
    pub multiplier: f64,
    pub offset: f64,
}
