//! `cargo gauss show --as mjcf` and `--as urdf`: a scene or a robot as a document of these formats.

use std::path::Path;

use gauss_jit::{Mjcf, Urdf};

use crate::arguments::{Form, Show};
use crate::{fmu, python};

/// The document. What of the file or of the scene does not act in it is said on standard error, line by line.
///
/// # Errors
/// Mistakes of the scene, each with its place; numbers that are missing, or those of no body; everything that has no
/// counterpart, with its clause.
pub fn document(wanted: &Show) -> Result<String, String> {
    let mut parameters = wanted.set.iter().map(|text| fmu::numbers(text)).collect::<Result<Vec<_>, _>>()?;
    let is_robot = wanted.file.extension().is_some_and(|end| end == "urdf" || end == "mjcf" || end == "xml");
    if !wanted.charts.is_empty() {
        return Err(
            "`--charts` has no meaning with `--as mjcf` and `--as urdf`: the joints there are what they are".to_owned()
        );
    }
    let source = if is_robot {
        of_robot(&wanted.file, &wanted.clause, &mut parameters)?
    } else if !wanted.clause.is_empty() {
        return Err("`--clause` goes with the file of a robot".to_owned());
    } else {
        match &wanted.names[..] {
            [] => fmu::of_scene(&wanted.file, None, "its name behind the file")?,
            [name] => fmu::of_scene(&wanted.file, Some(name), "")?,
            _ => return Err("`--as mjcf` and `--as urdf` take one struct at a time".to_owned()),
        }
    };
    let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, list)| (*name, &list[..])).collect();
    let made = if wanted.form == Form::Urdf {
        Urdf::new(&source, &parameters).map(|made| (made.xml().to_owned(), made.lost().to_vec()))
    } else {
        Mjcf::new(&source, &parameters).map(|made| (made.xml().to_owned(), made.lost().to_vec()))
    };
    let (text, lost) = made.map_err(|error| error.to_string())?;
    lost.iter().for_each(|line| eprintln!("remark: {line}"));
    Ok(text)
}

/// A URDF has no gravity: it is a parameter, 9.81 unless another one is set. An MJCF file has its own.
fn of_robot(file: &Path, clauses: &[String], parameters: &mut Vec<(&str, Vec<f64>)>) -> Result<String, String> {
    if python::format_of(file)? == "urdf" {
        if parameters.iter().all(|(name, _)| *name != "g") {
            parameters.push(("g", vec![fmu::GRAVITY]));
        }
        return fmu::of_robot(file, clauses);
    }
    let whole = file.canonicalize().map_err(|error| format!("{}: {error}", file.display()))?;
    let clauses: String = clauses.iter().map(|clause| format!(", {clause}")).collect();
    Ok(format!("#[gauss(mjcf = {:?}{clauses})]\nstruct Robot;\n", whole.display().to_string()))
}
