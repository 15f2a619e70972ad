//! The command line.

use std::path::PathBuf;

use clap::{ArgGroup, Args, Parser, Subcommand, ValueEnum};

/// As Cargo calls it: `cargo-gauss gauss …`.
#[derive(Parser)]
#[command(name = "cargo", bin_name = "cargo")]
pub enum Cargo {
    /// Equations of motion of structs with `#[derive(GaussDynamics)]`.
    #[command(version)]
    Gauss {
        #[command(subcommand)]
        command: Command,
    },
}

#[derive(Subcommand)]
pub enum Command {
    /// Prints the equations, what they cost, and how many digits they keep.
    Show(Show),
    /// Makes a package that runs: a body, its equations, a run, a table for plots; or one for Python; or an FMU.
    #[command(visible_alias = "create")]
    New(New),
}

/// Which struct, and what of it.
#[derive(Args)]
pub struct Show {
    /// A Rust file; with `mjcf` and `urdf` also one of a robot, URDF or MJCF.
    pub file: PathBuf,
    /// Names of structs in it; without any, all structs with `#[derive(GaussDynamics)]`.
    pub names: Vec<String>,
    /// What is printed.
    #[arg(long = "as", value_enum, default_value_t = Form::Text)]
    pub form: Form,
    /// In these charts in place of the chart of the struct, such as `left_invariant,jet(euler_zyx)`, side by side in a
    /// page.
    #[arg(long, value_delimiter = ',')]
    pub charts: Vec<String>,
    /// With `program`, `c`, `header`, `cpp`, `casadi` and `functions`: these methods alone, with commas.
    #[arg(long = "method", value_delimiter = ',')]
    pub methods: Vec<String>,
    /// Numbers are of single precision, with `c` and `header`.
    #[arg(long)]
    pub single: bool,
    /// With `mjcf` and `urdf`: a parameter in its unit, `m=1.5`; of vectors and matrices all numbers; several times.
    #[arg(long)]
    pub set: Vec<String>,
    /// With `mjcf` and `urdf`, of a robot's file: a further clause, such as `base = floating`; several times.
    #[arg(long)]
    pub clause: Vec<String>,
    /// Writes to this file in place of the terminal.
    #[arg(long, short)]
    pub output: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum Form {
    /// The equations, the operations of every method, and what they lose to rounding.
    Text,
    /// The equations in LaTeX, whose lines fit 16 cm at 10 pt.
    Latex,
    /// A typeset page without network or scripts.
    Html,
    /// The programs, one instruction a line.
    Program,
    /// A source file in C99.
    C,
    /// Its header: declarations, sizes of arrays, places of their numbers by name; for C++ as well.
    Header,
    /// A header of templates in C++17: arrays and numbers of any type.
    Cpp,
    /// C99 with derivatives, for `external` of CasADi.
    Casadi,
    /// A model of MuJoCo, by the numbers of `--set`, with comments about what MuJoCo does in another way.
    Mjcf,
    /// Links and joints of URDF, by the numbers of `--set`, with comments about what URDF does not have.
    Urdf,
    /// What the derive writes.
    Rust,
    /// Functions of `f64` in Rust that need nothing else.
    Functions,
}

impl Form {
    /// Whether it is made of methods, of which some may be chosen.
    pub fn has_methods(self) -> bool {
        matches!(self, Self::Program | Self::C | Self::Header | Self::Cpp | Self::Casadi | Self::Functions)
    }
}

/// Where the package goes, or the FMU.
#[derive(Args)]
#[command(group(ArgGroup::new("kind").args(["python", "fmu"])))]
pub struct New {
    /// A folder that is made; its last part is the name of the package. Of an FMU a file, `.fmu` or without that.
    pub folder: PathBuf,
    /// A clone of Gauss, whose crates the package uses. Without it they are those of the clone that this command was
    /// built from, or the published ones.
    #[arg(long)]
    pub gauss: Option<PathBuf>,
    /// A package for Python, which `pip install .` builds.
    #[arg(long)]
    pub python: bool,
    /// An FMU of the robot or of the scene, with source code, and a binary where there is a C compiler.
    #[arg(long)]
    pub fmu: bool,
    /// With `--python` or `--fmu`: the robot of this file, URDF or MJCF. It is derived, and copied with all files that
    /// it reads.
    #[arg(long, requires = "kind")]
    pub robot: Option<PathBuf>,
    #[command(flatten)]
    pub of_fmu: OfFmu,
}

/// The scene of an FMU.
#[derive(Args)]
pub struct OfFmu {
    /// With `--fmu`: a Rust file with the struct of the scene.
    #[arg(long, requires = "fmu", conflicts_with = "robot")]
    pub scene: Option<PathBuf>,
    /// The name of the struct in that file, where several derive their dynamics.
    #[arg(long, requires = "scene")]
    pub of: Option<String>,
    /// With `--robot`: a further clause, such as `frames(hand)` or `base = floating`; several times.
    #[arg(long, requires = "fmu", requires = "robot")]
    pub clause: Vec<String>,
    /// A parameter in its unit, `m=1.5`; of vectors and matrices all numbers, `arm.center_of_mass=0,0,0.1`; several
    /// times.
    #[arg(long, requires = "fmu")]
    pub set: Vec<String>,
    /// The start value of a state, `elbow=0.3`; several times.
    #[arg(long, requires = "fmu")]
    pub start: Vec<String>,
    /// The version of FMI, 2 or 3.
    #[arg(long, requires = "fmu", default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    pub fmi: u8,
}
