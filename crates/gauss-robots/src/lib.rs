#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

mod at;
pub mod collision;
pub mod description;
mod hull;
mod mesh;
mod mimic;
mod mjcf;
mod names;
mod polygon;
mod reference;
pub mod rotation;
mod structure;
mod text;
mod urdf;
mod urdf_reference;
mod xml;

use std::path::Path;

use description::{At, Description, Fault};
pub use mimic::Coupling;
pub use names::unknown;
pub use structure::Structure;
pub use text::{Text, Written};

/// The language of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `<robot>`, <https://wiki.ros.org/urdf/XML>.
    Urdf,
    /// `<mujoco>`, <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.
    Mjcf,
}

/// The robot of a file.
///
/// # Errors
/// Why the file, or one that it includes, cannot be read, or everything that is wrong in it:
/// `arm.urdf:12:3: message`.
pub fn load(format: Format, path: impl AsRef<Path>) -> Result<Description, Vec<String>> {
    let path = path.as_ref();
    let main = Written::read(path.display().to_string(), path.to_owned()).map_err(|error| vec![error])?;
    let text = whole(format, main)?;
    read(format, &text).map_err(|faults| all_located(&text.names(), &faults))
}

/// The text of a file with those that it includes.
///
/// # Errors
/// Why one of them cannot be read, each at the place where it is included.
pub fn whole(format: Format, main: Written) -> Result<Text, Vec<String>> {
    match format {
        Format::Urdf => Ok(Text::of(main)),
        Format::Mjcf => {
            let (text, faults) = mjcf::included(main);
            if faults.is_empty() { Ok(text) } else { Err(all_located(&text.names(), &faults)) }
        }
    }
}

/// The robot of a text.
///
/// # Errors
/// Everything that is wrong in it.
pub fn read(format: Format, text: &Text) -> Result<Description, Vec<Fault>> {
    let mut description = match format {
        Format::Urdf => urdf::read(text),
        Format::Mjcf => mjcf::read(text),
    }?;
    mimic::hold_followers_of_fixed(&mut description);
    Ok(description)
}

/// `robots/arm.urdf:12:3: message`; `names` are those of the files, [`Text::names`].
#[must_use]
pub fn located(names: &[String], at: At, message: &str) -> String {
    let name = names.get(at.file as usize).map_or("", String::as_str);
    match at {
        At { line: 0, .. } => format!("{name}: {message}"),
        At { line, column, .. } => format!("{name}:{line}:{column}: {message}"),
    }
}

/// Every fault with its place, as [`located`].
#[must_use]
pub fn all_located(names: &[String], faults: &[Fault]) -> Vec<String> {
    faults.iter().map(|fault| located(names, fault.at, &fault.message)).collect()
}
