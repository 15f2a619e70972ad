//! Names of models that outlive them.

use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

/// A name, kept once as long as the process runs: those in messages of the runtime, and of classes of Python, are not
/// freed.
pub fn kept(name: &str) -> &'static str {
    static NAMES: Mutex<Option<HashSet<&'static str>>> = Mutex::new(None);
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    let names = names.get_or_insert_default();
    if let Some(known) = names.get(name) {
        return known;
    }
    let kept: &'static str = Box::leak(name.to_owned().into_boxed_str());
    names.insert(kept);
    kept
}
