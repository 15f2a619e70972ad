//! The declaration as text, and how two of them differ.

use serde_json::Value;

use super::content::Declaration;

impl Declaration {
    /// As it is kept beside the results: JSON.
    pub(crate) fn to_json(&self) -> String {
        // A plain struct of numbers and words: nothing of it can be refused but numbers that were checked to be finite.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Differences from a kept declaration: a line for each field, as it is kept and as it is here.
    pub(crate) fn differences(&self, kept: &str) -> Result<Vec<String>, serde_json::Error> {
        let (kept, here) = (serde_json::from_str(kept)?, serde_json::from_str(&self.to_json())?);
        let mut differences = Vec::new();
        compare("", &kept, &here, &mut differences);
        Ok(differences)
    }
}

fn compare(place: &str, kept: &Value, here: &Value, differences: &mut Vec<String>) {
    match (kept, here) {
        (Value::Object(kept), Value::Object(here)) => {
            let more = here.keys().filter(|key| !kept.contains_key(*key));
            for key in kept.keys().chain(more) {
                let at = |object: &serde_json::Map<String, Value>| object.get(key).cloned().unwrap_or(Value::Null);
                let inner = if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
                compare(&inner, &at(kept), &at(here), differences);
            }
        }
        (Value::Array(kept), Value::Array(here)) => {
            for n in 0..kept.len().max(here.len()) {
                let at = |array: &[Value]| array.get(n).cloned().unwrap_or(Value::Null);
                let (kept, here) = (at(kept), at(here));
                let name = kept.get("name").or(here.get("name")).and_then(Value::as_str);
                let inner = name.map_or_else(|| format!("{place}[{n}]"), |name| format!("{place}[{n}, `{name}`]"));
                compare(&inner, &kept, &here, differences);
            }
        }
        _ if kept == here => {}
        _ => differences.push(format!("{place}: {kept} there, {here} here")),
    }
}
