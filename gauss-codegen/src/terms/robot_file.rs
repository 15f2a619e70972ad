//! The file that a scene comes from.

use proc_macro2::{Ident, Span};

/// A robot that was read from a file.
#[derive(Clone)]
pub struct RobotFile {
    /// Paths of the file and of those that it includes: the generated code names them, so that an edit compiles the
    /// struct anew.
    pub paths: Vec<String>,
    /// As it is written.
    pub file: String,
    /// The string of the clause.
    pub span: Span,
    /// Remarks on the file for a reader of the equations.
    pub remarks: Vec<FileRemark>,
    /// Names of the bodies and frames in the file, where they differ from those here.
    pub called: Vec<(Ident, String)>,
    /// Bodies that are fields, with the mass data of the file.
    pub bodies: Vec<BodyOfFile>,
    pub states: Vec<StateOfFile>,
}

/// Mass data of a body, in its axes; the inertia about the centre of mass.
#[derive(Clone)]
pub struct BodyOfFile {
    pub field: Ident,
    pub mass: f64,
    pub center: [f64; 3],
    pub inertia: [[f64; 3]; 3],
}

/// A state that the file names.
#[derive(Clone)]
pub struct StateOfFile {
    pub name: Ident,
    /// As it is called in the file.
    pub written: String,
    /// Coordinates and speeds that it has values of.
    pub values: Vec<(Ident, ValueOfState)>,
    /// Inputs, as they are called outside of expressions, that it has values of.
    pub inputs: Vec<(Ident, f64)>,
}

#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
#[derive(Clone, Copy)]
pub enum ValueOfState {
    Scalar(f64),
    Vector([f64; 3]),
    /// (w, x, y, z), of any length.
    Rotation([f64; 4]),
    Pose([f64; 3], [f64; 4]),
}

/// Something to know of a file, with its place in it.
#[derive(Clone)]
pub struct FileRemark {
    pub text: String,
    /// Something that acts in the file does not act in the equations.
    pub ignored: bool,
}
