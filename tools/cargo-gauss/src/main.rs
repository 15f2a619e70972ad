//! `cargo gauss`: what is derived from a struct, without a program around it.

mod arguments;
mod charts;
mod create;
mod documents;
mod fmu;
mod package;
mod page;
mod python;
mod robots;
mod show;
mod shown;
mod structs;

use std::process::ExitCode;

use arguments::{Cargo, Command};
use clap::Parser;

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
