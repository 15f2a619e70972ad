//! The struct itself: its name, its fields and their scalar, and what is taken from it as it is written.

use proc_macro2::{Ident, TokenStream};

use super::functions::UserFunction;
use super::inputs::InputName;
use super::kernel_options::KernelOptions;
use super::robot_file::RobotFile;
use super::roles::{Role, Shape};

/// The struct, whatever it describes.
#[derive(Clone)]
pub struct Item {
    /// Name of the struct.
    pub ident: Ident,
    /// Its doc comment, trimmed; empty when it has none.
    pub documentation: String,
    /// Visibility of the struct; the kernel gets the same.
    pub visibility: TokenStream,
    /// Generics of the struct: type parameters only.
    pub generics: Generics,
    /// The one scalar of every field with a role and of every field that an expression names; `f64` if there are none.
    pub scalar: Scalar,
    /// Path by which the generated code finds the runtime: `::gauss_runtime`, or the path of `crate = path`.
    pub runtime: TokenStream,
    /// The methods and derivatives to generate besides the equations.
    pub wanted: KernelOptions,
    /// Every field of the struct, in order.
    pub fields: Vec<Field>,
    /// Values that arrive at run time, in order.
    pub inputs: Vec<InputName>,
    /// Functions of one number that the user gives.
    pub functions: Vec<UserFunction>,
    /// The most operations that the generated code may have; `None`: the limit of the derive.
    pub limit: Option<usize>,
    /// The file that describes the robot, whose clauses come before those of the struct.
    pub described: Option<RobotFile>,
    /// Other files that the scene is made of: the generated code names them, so that an edit compiles the struct anew.
    pub tracked: Vec<String>,
}

impl Item {
    /// The field that plays a role.
    pub fn field(&self, role: Role) -> Option<&Field> {
        self.fields.iter().find(|field| field.role == Some(role))
    }
}

/// Type parameters of the struct, as an `impl` writes them.
#[derive(Clone)]
pub struct Generics {
    /// Behind `impl`.
    pub declared: TokenStream,
    /// Behind the name of the struct.
    pub used: TokenStream,
    /// Behind `where`, each with its comma.
    pub predicates: TokenStream,
}

/// One field of the struct.
#[derive(Clone)]
pub struct Field {
    /// Name of the field.
    pub ident: Ident,
    /// Its type.
    pub ty: TokenStream,
    /// Role of the field in the body without a name, or a body with a name; `None` for a plain parameter.
    pub role: Option<Role>,
    /// Shape of the value. A plain parameter whose scalar is not the scalar of the struct is [`Shape::Other`].
    pub shape: Shape,
    /// The unit, if one is written.
    pub unit: Option<String>,
    /// Its doc comment, trimmed; empty when it has none.
    pub documentation: String,
}

/// The number type that kernels compute with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `f32`.
    F32,
    /// `f64`.
    F64,
    /// A type parameter of the struct.
    Parameter(Ident),
}

impl std::fmt::Display for Scalar {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Scalar::F32 => formatter.write_str("f32"),
            Scalar::F64 => formatter.write_str("f64"),
            Scalar::Parameter(ident) => ident.fmt(formatter),
        }
    }
}
