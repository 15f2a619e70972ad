//! `cargo gauss create --fmu`: a robot or a scene as an FMU.

use std::fs;
use std::path::Path;

use gauss_codegen::Derivation;
use gauss_fmu::{Fmu, FmuError, Version};
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::Error;

use crate::arguments::New;
use crate::{python, robots, structs};

/// Acceleration of free fall, in m/s², of robots where nothing else is given.
pub const GRAVITY: f64 = 9.81;

/// Writes the FMU, and says for which platform it has a binary.
///
/// # Errors
/// Mistakes of the scene, each with its place; clauses that FMI has no counterpart for; numbers that are missing, or
/// those of no body; an error of the operating system.
pub fn create(wanted: &New) -> Result<(), String> {
    let own = &wanted.of_fmu;
    let mut parameters = own.set.iter().map(|text| numbers(text)).collect::<Result<Vec<_>, _>>()?;
    let source = match (&wanted.robot, &own.scene) {
        (Some(robot), _) => {
            if parameters.iter().all(|(name, _)| *name != "g") {
                parameters.push(("g", vec![GRAVITY]));
            }
            of_robot(robot, &own.clause)?
        }
        (None, Some(scene)) => of_scene(scene, own.of.as_deref(), "`--of NAME`")?,
        (None, None) => {
            return Err("`--robot FILE` or `--scene FILE.rs`: an FMU is one of a robot or of a scene".to_owned());
        }
    };
    let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, list)| (*name, &list[..])).collect();
    let single = |text: &String| match numbers(text)? {
        (name, list) if list.len() == 1 => Ok((name.to_owned(), list[0])),
        _ => Err(format!("`{text}`: a state is one number")),
    };
    let start = own.start.iter().map(single).collect::<Result<Vec<_>, _>>()?;
    let start: Vec<(&str, f64)> = start.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let version = if own.fmi == 3 { Version::Three } else { Version::Two };
    let said = |error: FmuError| error.to_string();
    let fmu = Fmu::new(&source, &parameters).and_then(|fmu| fmu.start(&start)).map_err(said)?.version(version);
    fmu.remarks().iter().for_each(|remark| println!("{remark}"));
    let mut file = wanted.folder.clone();
    if file.extension().is_none_or(|end| end != "fmu") {
        file.as_mut_os_string().push(".fmu");
    }
    let written = fmu.write(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    match written.platform {
        Some(platform) => println!("made {}: source code, and a binary for {platform}", file.display()),
        None => println!("made {}: source code alone, since there is no C compiler (`cc`) here", file.display()),
    }
    Ok(())
}

/// `name=1,2,3`.
pub fn numbers(text: &str) -> Result<(&str, Vec<f64>), String> {
    let (name, list) = text.split_once('=').ok_or_else(|| format!("`{text}`: write `name=number`"))?;
    let number = |word: &str| word.trim().parse::<f64>().map_err(|_| format!("`{text}`: `{word}` is no number"));
    Ok((name.trim(), list.split(',').map(number).collect::<Result<_, _>>()?))
}

/// The text of a struct of a robot's file, with the acceleration of free fall for a field.
pub fn of_robot(file: &Path, clauses: &[String]) -> Result<String, String> {
    let format = python::format_of(file)?;
    let whole = file.canonicalize().map_err(|error| format!("{}: {error}", file.display()))?;
    let clauses: String = clauses.iter().map(|clause| format!(", {clause}")).collect();
    Ok(format!(
        "/// The robot of {}.\n#[gauss({format} = {:?}{clauses})]\nstruct Robot {{\n    \
         /// Acceleration of free fall.\n    #[gauss(gravity, unit = \"m/s^2\")]\n    g: f64,\n}}\n",
        file.file_name().unwrap_or_default().to_string_lossy(),
        whole.display().to_string()
    ))
}

/// The text of the struct. It is derived here for its mistakes, which have their places in the file. `how` says how one
/// of several is chosen.
pub fn of_scene(file: &Path, name: Option<&str>, how: &str) -> Result<String, String> {
    let text = fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let located = |mistakes: Error| structs::located(file, &mistakes);
    let tokens = text.parse::<TokenStream>().map_err(|error| located(Error::new(error.span(), "this is no Rust")))?;
    let names: Vec<String> = name.map(str::to_owned).into_iter().collect();
    let mut items = structs::find(tokens, &names).map_err(located)?;
    if items.len() > 1 {
        let names: Vec<String> = items.iter().map(|item| item.ident.to_string()).collect();
        return Err(format!("{}: it has several structs; {how} takes one of {}", file.display(), names.join(", ")));
    }
    let Some(mut item) = items.pop() else { return Err(format!("{}: it has no struct", file.display())) };
    if let Some(package) = robots::package_of(file) {
        robots::by_whole_paths(&mut item, &package);
    }
    Derivation::new(&item).map_err(located)?;
    Ok(item.into_token_stream().to_string())
}
