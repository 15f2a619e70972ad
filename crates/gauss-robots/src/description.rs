//! The description of a robot, the same for every format of files: plain data in SI units.

use std::path::PathBuf;

pub use super::at::At;
use super::collision::{Collision, Pair};
use super::rotation::{Matrix, Rotation, Triple};

/// A mistake and its place in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Place of the mistake.
    pub at: At,
    /// The mistake, and how it can be mended.
    pub message: String,
}

/// A remark for a reader of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Place that the note is about.
    pub at: At,
    /// Words of the note.
    pub text: String,
    /// Something that acts in the file does not act in the equations: what it is called there.
    pub ignored: Option<String>,
    /// Topic, where one note can stand for many.
    pub topic: Option<&'static str>,
}

impl Note {
    /// One that tells what was made of something.
    pub fn told(at: At, text: impl Into<String>) -> Note {
        Note { at, text: text.into(), ignored: None, topic: None }
    }

    /// One of those about `topic`.
    pub fn about(self, topic: &'static str) -> Note {
        Note { topic: Some(topic), ..self }
    }

    /// One about `what`, which acts in the file and not in the description.
    pub fn ignored(at: At, what: &str, text: impl Into<String>) -> Note {
        Note { at, text: text.into(), ignored: Some(what.to_owned()), topic: None }
    }

    /// In the order of the file; of many about one thing the first, with the lines of the others.
    pub fn gathered(mut all: Vec<Note>) -> Vec<Note> {
        const FEW: usize = 2;
        all.sort_by_key(|note| note.at);
        let alike = |note: &Note, other: &Note| note.topic.is_some() && note.topic == other.topic;
        let mut gathered: Vec<Note> = Vec::new();
        for note in &all {
            let places: Vec<At> = all.iter().filter(|other| alike(note, other)).map(|other| other.at).collect();
            if places.len() <= FEW {
                gathered.push(note.clone());
            } else if !gathered.iter().any(|earlier| alike(earlier, note)) {
                let text = format!("{}; likewise in {}", note.text, lines(note.at, &places[1..]));
                gathered.push(Note { text, ..note.clone() });
            }
        }
        gathered
    }
}

/// `lines 12, 30, 31, 44 and 4 more`, in the words of a message about the place `here`.
pub fn lines(here: At, places: &[At]) -> String {
    const SHOWN: usize = 4;
    let lines: Vec<String> = places.iter().take(SHOWN).map(|at| at.line_from(here)).collect();
    let more = if places.len() > SHOWN { format!(" and {} more", places.len() - SHOWN) } else { String::new() };
    format!("line{} {}{more}", if places.len() == 1 { "" } else { "s" }, lines.join(", "))
}

/// A robot: a tree of links.
#[derive(Clone, Debug, Default)]
pub struct Description {
    /// In the order of the file.
    pub links: Vec<Link>,
    /// In the order of the file.
    pub joints: Vec<Joint>,
    /// Drives of transmissions and actuators, in the order of the file.
    pub drives: Vec<Drive>,
    /// The others are driven by nothing.
    pub only_driven: bool,
    /// Links that are joined by more than the tree: loops.
    pub closures: Vec<Closure>,
    /// Relations among coordinates.
    pub polynomials: Vec<Polynomial>,
    /// Springs along sums of coordinates.
    pub tendons: Vec<Tendon>,
    /// Springs along sums of distances.
    pub cables: Vec<Cable>,
    /// Shapes of links that touch others.
    pub collisions: Vec<Collision>,
    /// Shapes of links that touch nothing but what a pair says.
    pub hidden: Vec<Collision>,
    /// Shapes that touch by pairs.
    pub pairs: Vec<Pair>,
    /// Names of links of which no two touch.
    pub excluded: Vec<[String; 2]>,
    /// A link may touch the one that it hangs on.
    pub parents_touch: bool,
    /// States with names.
    pub postures: Vec<Posture>,
    /// The acceleration of free fall in observer's axes, if the file gives one.
    pub gravity: Option<Triple>,
    /// Notes on everything that was left out, renamed or assumed.
    pub notes: Vec<Note>,
    /// Files besides those of the text, such as meshes, whose numbers the description holds.
    pub files: Vec<PathBuf>,
}

impl Description {
    /// Whether the file keeps two links from touching.
    #[must_use]
    pub fn excludes(&self, links: [&str; 2]) -> bool {
        let [a, b] = links;
        self.excluded.iter().any(|[c, d]| (c == a && d == b) || (c == b && d == a))
    }
}

/// A body with axes of its own.
#[derive(Clone, Debug)]
pub struct Link {
    /// As the file has it.
    pub name: String,
    /// Its element.
    pub at: At,
    /// Its own mass data, without those of links that are fixed to it.
    pub inertial: Option<Inertial>,
    /// Notes on the masses of its parts: to be told where it moves.
    pub mass_notes: Vec<Note>,
    /// Part of its weight that is held by a force at its centre of mass.
    pub held: f64,
}

/// Mass data in the axes of the link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// In kg.
    pub mass: f64,
    /// From O.
    pub center: Triple,
    /// About the centre of mass.
    pub inertia: Matrix,
}

impl Inertial {
    /// Moments of a body that is smaller than this are what rounding left of those of a point, in metres.
    const LEAST: f64 = 1e-8;

    /// Scales the density by a factor.
    pub fn scaled(self, factor: f64) -> Inertial {
        let inertia = self.inertia.map(|row| row.map(|entry| entry * factor));
        Inertial { mass: self.mass * factor, inertia, ..self }
    }

    /// Without what rounding left of zeros, of which one can be negative.
    pub fn settled(self) -> Inertial {
        let least = self.mass * Self::LEAST * Self::LEAST;
        let is_point = self.inertia.iter().flatten().all(|entry| entry.abs() < least);
        Inertial { inertia: if is_point { [[0.0; 3]; 3] } else { self.inertia }, ..self }
    }
}

/// Nonlinear terms of a spring and a damper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nonlinear {
    /// Force by x² and by x³, of the coordinate or length x beyond the rest.
    pub stiffness: [f64; 2],
    /// Force by v |v| and by v³, of its rate v.
    pub damping: [f64; 2],
}

/// The motion of a link relative to its parent.
#[derive(Clone, Debug)]
pub struct Joint {
    /// As the file has it.
    pub name: String,
    /// Its element.
    pub at: At,
    /// Way in which the child moves.
    pub kind: JointKind,
    /// Names of links.
    pub parent: String,
    /// The link that hangs by it.
    pub child: String,
    /// Position of the child while the coordinates are zero, in the axes of the parent.
    pub position: Triple,
    /// From axes of the child to those of the parent.
    pub rotation: Rotation,
    /// Axis of length one, in the axes of the child; of a plane its normal.
    pub axis: Triple,
    /// The joint that this one follows.
    pub mimic: Option<Mimic>,
    /// The least and the most value of the coordinate.
    pub limits: [Option<f64>; 2],
    /// Force by rate.
    pub damping: f64,
    /// The force of dry friction.
    pub friction: f64,
    /// Force by coordinate beyond the rest of a spring.
    pub stiffness: f64,
    /// The nonlinear terms of both.
    pub nonlinear: Nonlinear,
    /// The coordinate at which the spring has no force.
    pub rest: f64,
    /// The least and the most of all efforts that are put in.
    pub efforts: Option<[f64; 2]>,
    /// Inertia of the joint alone, such as that of a rotor behind gears.
    pub armature: f64,
    /// The value of the coordinate where nothing is turned or moved.
    pub reference: f64,
    /// Position and rotation of a floating link in the world while nothing moves.
    pub start: (Triple, Rotation),
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
            nonlinear: Nonlinear::default(),
            rest: 0.0,
            efforts: None,
            armature: 0.0,
            reference: 0.0,
            start: ([0.0; 3], Rotation::none()),
        }
    }
}

/// A drive of joints by a control u: along the length l = Σ c q the force (g₀ + g₁ l + g₂ l̇) u + b₀ + b₁ l + b₂ l̇; or
/// by a wrench on a frame, whose l stays zero, or at a joint with several coordinates.
#[derive(Clone, Debug)]
pub struct Drive {
    /// As the file has it.
    pub name: String,
    /// Its element.
    pub at: At,
    /// Joints, with the c of each.
    pub along: Vec<(String, f64)>,
    /// A link, and the force and torque at it, in its axes, of a unit of force of the drive; `along` is empty then.
    pub at_link: Option<(String, [Triple; 2])>,
    /// A ball or a floating joint, on whose child it acts; `along` is empty then.
    pub at_joint: Option<Turned>,
    /// g₀, g₁, g₂.
    pub gain: Triple,
    /// b₀, b₁, b₂.
    pub bias: Triple,
    /// The least and the most of the control, and of the force.
    pub controls: Option<[f64; 2]>,
    /// The least and the most of the force.
    pub forces: Option<[f64; 2]>,
}

/// A drive of a joint with several coordinates. Its l̇ is the power of a unit of its force; its l is zero, of a ball
/// the component of the rotation vector along the torque.
#[derive(Clone, Debug)]
pub struct Turned {
    /// The joint.
    pub name: String,
    /// The force, in observer's axes, and the torque of a unit of force of the drive; of a ball the torque alone.
    pub wrench: [Triple; 2],
    /// The torque keeps its direction where the child turns; otherwise it is in the axes of the child.
    pub in_parent: bool,
}

impl Drive {
    /// It acts as a wrench, on no coordinate alone.
    pub fn is_wrench(&self) -> bool {
        self.at_link.is_some() || self.at_joint.is_some()
    }

    /// Its force is its control.
    pub fn is_plain(&self) -> bool {
        self.gain == Drive::DIRECT && self.bias == [0.0; 3]
    }

    /// The gain of a control that acts directly.
    pub const DIRECT: Triple = [1.0, 0.0, 0.0];
}

/// A spring with a damper along the length l = Σ c q.
#[derive(Clone, Debug)]
pub struct Tendon {
    /// As the file has it.
    pub name: Option<String>,
    /// Its element.
    pub at: At,
    /// Joints, with the c of each.
    pub along: Vec<(String, f64)>,
    /// Force by length.
    pub stiffness: f64,
    /// Force by rate.
    pub damping: f64,
    /// The nonlinear terms of both.
    pub nonlinear: Nonlinear,
    /// The least and the most length without force.
    pub rest: [f64; 2],
    /// The least and the most length.
    pub limits: Option<[f64; 2]>,
}

/// A spring with a damper along a sum of distances.
#[derive(Clone, Debug)]
pub struct Cable {
    /// As the file has it.
    pub name: Option<String>,
    /// Its element.
    pub at: At,
    /// Two links, between whose origins it runs, with what the length changes by that distance.
    pub parts: Vec<([String; 2], f64)>,
    /// Force by length.
    pub stiffness: f64,
    /// Force by rate.
    pub damping: f64,
    /// The nonlinear terms of both.
    pub nonlinear: Nonlinear,
    /// The least and the most length without force; where there are none, the length while all joints are where their
    /// springs have no force.
    pub rest: Option<[f64; 2]>,
    /// The least and the most length.
    pub limits: Option<[f64; 2]>,
}

/// A sum of coordinates, with their factors, is a polynomial of another, all from their references.
#[derive(Clone, Debug)]
pub struct Polynomial {
    /// Its element.
    pub at: At,
    /// Joints of the sum, with their factors.
    pub along: Vec<(String, f64)>,
    /// Joints of the sum x that the polynomial is of; the constant alone without it.
    pub of: Option<Vec<(String, f64)>>,
    /// Coefficients of 1, x, x², x³, x⁴.
    pub coefficients: [f64; 5],
}

/// A state of the robot with a name.
#[derive(Clone, Debug, Default)]
pub struct Posture {
    /// As the file has it.
    pub name: String,
    /// Joints with the numbers that say where they are: one, a quaternion (w, x, y, z), or a position and one. Without
    /// them they are where nothing is turned or moved.
    pub values: Vec<(String, Vec<f64>)>,
    /// Joints with their rates: one, ω in own axes, or the velocity in observer's axes and ω.
    pub rates: Vec<(String, Vec<f64>)>,
    /// Drives, by their indices, with their controls.
    pub controls: Vec<(usize, f64)>,
}

/// Two links that have a point in common, which is at `anchor` in the axes of the first.
#[derive(Clone, Debug)]
pub struct Closure {
    /// Its element.
    pub at: At,
    /// Names of links.
    pub links: [String; 2],
    /// In m.
    pub anchor: Triple,
    /// The second turns with the first as well: its rotation relative to it.
    pub turn: Option<Turn>,
}

/// A rotation relative to another link: what it is at rest, or another.
#[derive(Clone, Copy, Debug)]
pub enum Turn {
    /// The rotation while no joint is turned or moved.
    AsAtRest,
    /// This one: from axes of the second to those of the first.
    To(Matrix),
}

/// Kinds of motion of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// About the axis.
    Turning,
    /// Along the axis.
    Sliding,
    /// Two ways and a turn in the plane normal to the axis.
    Planar,
    /// About the origin.
    Ball,
    /// Freely.
    Floating,
}

/// The coordinate is `multiplier` times that of another joint, and `offset`.
#[derive(Clone, Debug)]
pub struct Mimic {
    /// Its element.
    pub at: At,
    /// The joint that is followed.
    pub joint: String,
    /// Factor of its coordinate.
    pub multiplier: f64,
    /// Constant that is added.
    pub offset: f64,
}

impl JointKind {
    /// It has one coordinate.
    pub fn is_scalar(self) -> bool {
        matches!(self, JointKind::Turning | JointKind::Sliding)
    }
}
