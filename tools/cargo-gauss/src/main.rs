//! `cargo gauss`: what is derived from a struct, without a program around it.

mod charts;
mod create;
mod page;
mod robots;
mod show;
mod structs;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// As Cargo calls it: `cargo-gauss gauss …`.
#[derive(Parser)]
#[command(name = "cargo", bin_name = "cargo")]
enum Cargo {
    /// Equations of motion of structs with `#[derive(GaussDynamics)]`.
    #[command(version)]
    Gauss {
        #[command(subcommand)]
        command: Command,
    },
}

#[derive(Subcommand)]
enum Command {
    /// Prints the equations, what they cost, and how many digits they keep.
    Show(Show),
    /// Makes a package that runs: a body, its equations, a run, a table for plots.
    New(New),
}

/// Which struct, and what of it.
#[derive(Args)]
struct Show {
    /// A Rust file.
    file: PathBuf,
    /// Names of structs in it; without any, all structs with `#[derive(GaussDynamics)]`.
    names: Vec<String>,
    /// What is printed.
    #[arg(long = "as", value_enum, default_value_t = Form::Text)]
    form: Form,
    /// In these charts in place of the chart of the struct, such as `left_invariant,jet(euler_zyx)`, side by side in a page.
    #[arg(long, value_delimiter = ',')]
    charts: Vec<String>,
    /// With `--as program`: one method alone.
    #[arg(long)]
    method: Option<String>,
    /// Writes to this file in place of the terminal.
    #[arg(long, short)]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Form {
    /// The equations, the operations of every method, and what they lose to rounding.
    Text,
    /// The equations, a LaTeX environment for each struct.
    Latex,
    /// A typeset page without network or scripts.
    Html,
    /// The programs, one instruction a line.
    Program,
    /// A source file in C99.
    C,
    /// What the derive writes.
    Rust,
    /// Functions of `f64` in Rust that need nothing else.
    Functions,
}

/// Where the package goes.
#[derive(Args)]
struct New {
    /// A folder that is made; its last part is the name of the package.
    folder: PathBuf,
    /// A clone of Gauss, whose crates the package uses; without it the published ones.
    #[arg(long)]
    gauss: Option<PathBuf>,
}

fn main() -> ExitCode {
    let Cargo::Gauss { command } = Cargo::parse();
    let done = match command {
        Command::Show(wanted) => show::show(&wanted),
        Command::New(wanted) => create::create(&wanted),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(mistakes) => {
            eprintln!("{mistakes}");
            ExitCode::FAILURE
        }
    }
}
