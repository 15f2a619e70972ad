//! Whether a table of verdicts is true: every row is tried in a file.

use super::{Element, Verdict};
use crate::description::{Description, Fault, Note};
use crate::text::{Text, Written};

/// A format, and a file of it in which its elements stand.
pub struct ReferenceFormat {
    pub elements: &'static [Element],
    pub read: fn(&Text) -> Result<Description, Vec<Fault>>,
    /// Text with places `@body/joint{…}` where the attributes of an element stand, those in the braces unless others
    /// are tried, and `@in/body{}` where an element comes into another.
    pub file: &'static str,
    /// Samples of every attribute that acts: its element, other attributes that it needs, itself.
    pub samples: &'static [(&'static str, &'static str, &'static str)],
}

/// The result of reading: the description without notes, and the notes of elements that do not act.
type Reading = (String, Vec<Note>);

impl ReferenceFormat {
    fn read(&self, place: &str, inside: &str) -> Result<Reading, Vec<Fault>> {
        let mut parts = self.file.split('@');
        let mut text = parts.next().unwrap().to_owned();
        let mut found = false;
        for part in parts {
            let (name, rest) = part.split_once('{').unwrap();
            let (usual, rest) = rest.split_once('}').unwrap();
            found |= name == place;
            text += if name == place { inside } else { usual };
            text += rest;
        }
        assert!(found, "the file has no place for {place}");
        let main = Written::new(String::new(), std::path::PathBuf::new(), text);
        (self.read)(&Text::of(main)).map(|mut description| {
            let notes = std::mem::take(&mut description.notes);
            (format!("{description:?}"), notes.into_iter().filter(|note| note.ignored.is_some()).collect())
        })
    }

    /// The faults of an element whose attribute has another value.
    pub fn faults(&self, place: &str, name: &str, value: &str) -> Vec<String> {
        let usual = self.usual(place);
        let start = format!(" {name}=\"");
        let others = match usual.split_once(&start) {
            Some((before, rest)) => format!("{before}{}", rest.split_once('"').map_or("", |(_, after)| after)),
            None => usual.to_owned(),
        };
        let read = self.read(place, &format!("{others} {name}=\"{value}\""));
        read.err().unwrap_or_default().into_iter().map(|fault| fault.message).collect()
    }

    /// Whether the file has a place for the attributes of an element.
    pub fn has(&self, place: &str) -> bool {
        self.file.contains(&format!("@{place}{{"))
    }

    fn usual(&self, place: &str) -> &'static str {
        let start = format!("@{place}{{");
        let after = self.file.split_once(&start).unwrap_or_else(|| panic!("the file has no place for {place}")).1;
        after.split_once('}').unwrap().0
    }

    /// Reads the file with something at a place, and without it; both texts have the same length, so that places stay.
    fn both(&self, place: &str, others: &str, own: &str) -> [Result<Reading, Vec<Fault>>; 2] {
        let blanks = " ".repeat(own.len());
        [blanks.as_str(), own].map(|own| self.read(place, &format!("{others} {own}")))
    }

    /// Verdicts that are not true.
    pub fn untrue(&self) -> Vec<String> {
        let mut found = Vec::new();
        for element in self.elements {
            match element.verdict {
                Verdict::Acts => {
                    for place in places(element, self.file) {
                        self.check_attributes(element, place, &mut found);
                    }
                }
                verdict => {
                    for name in element.names.split_whitespace() {
                        let within = element.within.split_whitespace().next().unwrap_or_default();
                        found.extend(self.not_silent(&format!("in/{within}"), "", &format!("<{name}/>"), verdict));
                    }
                }
            }
        }
        found.extend(self.samples.iter().filter_map(|(place, others, own)| self.not_acting(place, others, own)));
        found
    }

    fn check_attributes(&self, element: &Element, place: &str, found: &mut Vec<String>) {
        let all = element.attributes.iter().flat_map(|group| group.iter().map(move |attributes| (group, attributes)));
        for (group, (names, verdict)) in all {
            for name in names.split_whitespace() {
                let start = format!("{name}=\"");
                let usual = self.usual(place);
                match *verdict {
                    Verdict::Acts => {
                        // What elements have in common is tried in one of them.
                        let in_group = |at: &str| {
                            let mut rows = self.elements.iter().filter(|row| is_of(row, at));
                            rows.any(|row| row.attributes.contains(group))
                        };
                        let tried = self
                            .samples
                            .iter()
                            .any(|(at, _, own)| own.trim_start_matches('!').starts_with(&start) && in_group(at));
                        found.extend((!tried).then(|| format!("nothing tries `{name}` of {place}")));
                    }
                    verdict if !usual.contains(&format!(" {start}")) => {
                        found.extend(self.not_silent(place, usual, &format!("{start}7\""), verdict));
                    }
                    _ => {}
                }
                if let Verdict::Warned(_, values) = *verdict {
                    for value in values.split_whitespace() {
                        let quiet = Verdict::Harmless("");
                        found.extend(self.not_silent(place, usual, &format!("{start}{value}\""), quiet));
                    }
                }
            }
        }
    }

    /// Describes the mistake if something is not warned of in its words, or if what is harmless acts.
    fn not_silent(&self, place: &str, others: &str, own: &str, verdict: Verdict) -> Option<String> {
        let (without, with) = match self.both(place, others, own) {
            [Ok(without), Ok(with)] => (without, with),
            read => return Some(format!("{place} {own}: {read:?}")),
        };
        let new = new_notes(&without, &with);
        let is_true = match verdict {
            Verdict::Warned(words, _) => new.iter().any(|note| note.text.contains(words)),
            _ => new.is_empty() && without.0 == with.0,
        };
        (!is_true).then(|| format!("{place} {own}: {verdict:?}, but {new:?}"))
    }

    /// Describes the mistake if the description is the same with the attribute; with `!` one of the two is to be a
    /// mistake.
    fn not_acting(&self, place: &str, others: &str, own: &str) -> Option<String> {
        let is_mistake = own.starts_with('!');
        let own = own.trim_start_matches('!');
        let name = own.split('=').next().unwrap();
        let verdict = self.elements.iter().find(|element| is_of(element, place)).and_then(|element| element.of(name));
        let is_true = match self.both(place, others, own) {
            [Ok(_), Err(_)] | [Err(_), Ok(_)] => is_mistake,
            [Ok(without), Ok(with)] => !is_mistake && without.0 != with.0 && new_notes(&without, &with).is_empty(),
            [Err(_), Err(_)] => false,
        };
        (!is_true || verdict != Some(Verdict::Acts)).then(|| format!("{place} {own}: {verdict:?} is not true"))
    }
}

fn new_notes<'a>(without: &Reading, with: &'a Reading) -> Vec<&'a Note> {
    with.1.iter().filter(|note| !without.1.contains(note)).collect()
}

/// Places in the file that stand for an element of the table: `body/joint`.
fn places(element: &'static Element, file: &'static str) -> impl Iterator<Item = &'static str> {
    let all = file.split('@').skip(1).filter_map(|part| part.split('{').next());
    all.filter(|place| is_of(element, place))
}

fn is_of(element: &Element, place: &str) -> bool {
    place.split_once('/').is_some_and(|(parent, name)| {
        let within = element.within.is_empty() || element.within.split_whitespace().any(|other| other == parent);
        within && element.names.split_whitespace().any(|other| other == name)
    })
}
