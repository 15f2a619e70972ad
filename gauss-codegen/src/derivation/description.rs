//! The names of a scene as plain data.

use crate::description::{Description, Quantity, Remark};
use crate::emit::{Derived, numbers, parts, without_rust};
use crate::translate::NamedQuantity as Part;
use crate::words::Unraw;

/// The names of what is derived.
pub fn description(derived: &Derived<'_, '_>) -> Description {
    let item = derived.item();
    let [coordinates, speeds, inputs] = parts(derived);
    // Numbers of a state are told apart among all of them.
    let state = numbers(&[coordinates.clone(), speeds.clone()].concat());
    let [coordinates, speeds] = [coordinates, speeds].map(|parts| quantities(&parts, &state));
    let inputs = quantities(&inputs, &numbers(&inputs));
    let remarks = item.described.iter().flat_map(|file| &file.remarks);
    Description {
        documentation: item.documentation.clone(),
        coordinates,
        speeds,
        inputs,
        frames: derived.frames().iter().map(|frame| frame.unraw().to_string()).collect(),
        joints: item.wanted.reactions.iter().map(|joint| joint.name.unraw().to_string()).collect(),
        motions: item.wanted.motions.iter().map(|motion| motion.unraw().to_string()).collect(),
        contacts: derived.subject.contacts(),
        factors: derived.subject.system.halves().map(|halves| halves.first_of_rows()),
        keeps_energy: derived.keeps_energy(),
        remarks: remarks.map(|own| Remark { text: without_rust(&own.text), ignored: own.ignored }).collect(),
        is_constrained: derived.subject.can_drift,
        states: derived.subject.system.scene.states.len(),
    }
}

/// Parts with the names of their numbers.
fn quantities(parts: &[Part], numbers: &[(String, Vec<String>)]) -> Vec<Quantity> {
    let quantity = |part: &Part| {
        let name = part.ident.unraw().to_string();
        let own = numbers.iter().find(|(word, _)| *word == name).map(|(_, names)| names.clone());
        Quantity { name, kind: part.kind, label: part.label.clone(), numbers: own.unwrap_or_default() }
    };
    parts.iter().map(quantity).collect()
}
