//! A class in words.

use gauss_runtime::contact::ContactKind;

use crate::arrays::shown;
use crate::description::Shape;
use crate::kernels::AnyScene;
use crate::parameters::described;

/// The class in words: the struct's doc comment, its parameters, coordinates, speeds, inputs and contacts, and what of
/// its file does not act.
pub fn documentation(scene: &dyn AnyScene) -> String {
    let description = scene.description();
    let mut text = description.documentation.to_owned();
    if !description.fields.is_empty() {
        text.push_str("\n\nParameters:\n");
        for field in &description.fields {
            let shape = match field.shape {
                Shape::Array([]) => "number".to_owned(),
                Shape::Array(axes) => format!("array {}", shown(axes)),
                Shape::Rotation => "unit quaternion x, y, z, w".to_owned(),
                Shape::Body => "mapping of mass, center_of_mass, inertia".to_owned(),
            };
            text.push_str(&format!("  {}: {shape}{}\n", field.name, described(field)));
        }
    }
    let parts =
        [("Coordinates", &description.coordinates), ("Speeds", &description.speeds), ("Inputs", &description.inputs)];
    for (title, parts) in parts.into_iter().filter(|(_, parts)| !parts.is_empty()) {
        text.push_str(&format!("\n{title}:\n"));
        for part in parts {
            let numbers = if part.size == 1 { String::new() } else { format!(" ({} numbers)", part.size) };
            text.push_str(&format!("  {}{numbers}: {}\n", part.name, part.label));
        }
    }
    if !scene.contacts().is_empty() {
        text.push_str("\nContacts, whose forces `simulate`, `ensemble` and `in_contact` have:\n");
        for contact in scene.contacts() {
            let what = match contact.kind {
                ContactKind::Gap => "a gap",
                ContactKind::DryFriction => "dry friction",
                _ => "resistance to rolling",
            };
            text.push_str(&format!("  {}: {what}\n", contact.name));
        }
    }
    if !description.remarks.is_empty() {
        text.push_str("\nThe file:\n");
        description.remarks.iter().for_each(|remark| text.push_str(&format!("  {}\n", remark.text)));
    }
    text
}
