//! Verdicts on every element and attribute of a format: one table for each, which the readers go by.
//!
//! What is in no table is a warning of the compiler: nothing is left out in silence. Tests read the tables, too: each
//! attribute that acts changes the description, each of the others does not.

#[cfg(test)]
pub mod checks;

/// Effect of an element or an attribute on the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The description depends on it.
    Acts,
    /// It acts in the file and not in the equations, which is said with these words; but for values of these words,
    /// with which it does nothing.
    Warned(&'static str, &'static str),
    /// The motion does not depend on it, for this reason.
    Harmless(&'static str),
}

/// Attributes, separated by blanks, with one verdict.
pub type Attributes = (&'static str, Verdict);

/// An element of a format.
#[derive(Debug)]
pub struct Element {
    /// The elements that it is in, separated by blanks; any, if there are none.
    pub within: &'static str,
    /// Names, separated by blanks.
    pub names: &'static str,
    /// Verdict on the element itself. What is in it has verdicts of its own only if it acts.
    pub verdict: Verdict,
    pub attributes: &'static [&'static [Attributes]],
}

/// One that acts.
pub const fn element(
    within: &'static str,
    names: &'static str,
    attributes: &'static [&'static [Attributes]],
) -> Element {
    Element { within, names, verdict: Verdict::Acts, attributes }
}

/// One that does not, with all that is in it.
pub const fn whole(within: &'static str, names: &'static str, verdict: Verdict) -> Element {
    Element { within, names, verdict, attributes: &[] }
}

impl Element {
    /// The first that stands for an element in another.
    pub fn find(all: &'static [Element], parent: &str, name: &str) -> Option<&'static Element> {
        all.iter().find(|element| {
            let inside = element.within.is_empty() || has(element.within, parent);
            inside && has(element.names, name)
        })
    }

    /// Verdict on an attribute; none where it is not in the table.
    pub fn of(&self, name: &str) -> Option<Verdict> {
        let all = self.attributes.iter().copied().flatten();
        all.copied().find(|(names, _)| has(names, name)).map(|(_, verdict)| verdict)
    }
}

fn has(words: &str, word: &str) -> bool {
    words.split_whitespace().any(|other| other == word)
}
