//! Names of models that outlive them.

use std::collections::HashSet;
use std::hash::Hash;
use std::sync::{Mutex, PoisonError};

use gauss_codegen::description::{ContactDescription, Description};
use gauss_runtime::contact::Contact;

/// Values of which each is stored once as long as the process runs: those in messages of the runtime, and of classes of
/// Python, are not freed.
struct Pool<T: ?Sized + 'static>(Mutex<Option<HashSet<&'static T>>>);

impl<T: ?Sized + Eq + Hash> Pool<T> {
    fn of(&self, value: &T, own: impl FnOnce() -> Box<T>) -> &'static T {
        let mut values = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let values = values.get_or_insert_default();
        if let Some(known) = values.get(value) {
            return known;
        }
        let stored: &'static T = Box::leak(own());
        values.insert(stored);
        stored
    }
}

/// A name for as long as the process runs.
pub fn kept(name: &str) -> &'static str {
    static NAMES: Pool<str> = Pool(Mutex::new(None));
    NAMES.of(name, || name.into())
}

/// Axes of a parameter for as long as the process runs.
pub fn kept_axes(axes: &[usize]) -> &'static [usize] {
    static AXES: Pool<[usize]> = Pool(Mutex::new(None));
    AXES.of(axes, || axes.into())
}

/// The contacts of a model as the runtime has them, for as long as the process runs.
pub(crate) fn contacts(description: &Description) -> &'static [Contact] {
    let mut first = 0;
    let contact = |own: &ContactDescription| {
        let (name, row, tangents) = (kept(&own.name), first, own.tangents);
        first += own.rows();
        let contact = match own.rolls_on {
            _ if own.has_gap => Contact::new(name, row, tangents),
            Some(on) => Contact::rolling(name, row, tangents, on),
            None => Contact::dry_friction(name, row, tangents),
        };
        let body = |k: usize| own.bodies[k].as_deref().map(kept);
        let contact = if own.drills { contact.with_drilling() } else { contact };
        (if own.moves { contact.moving() } else { contact }).between([body(0), body(1)])
    };
    static LISTS: Pool<[Contact]> = Pool(Mutex::new(None));
    let list: Vec<Contact> = description.contacts.iter().map(contact).collect();
    LISTS.of(&list, || list.clone().into())
}
