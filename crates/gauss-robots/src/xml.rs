//! Elements and attributes of an XML file, with what is wrong in them and where.

use std::cell::RefCell;
use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;

use roxmltree::{Document, Node, NodeId};

use super::description::{At, Fault, Note, lines};
use super::names::unknown;
use super::reference::{Element, Verdict};
use super::text::{Text, options};

/// A file while it is read.
pub struct Reading<'a> {
    document: &'a Document<'a>,
    text: &'a Text,
    pub faults: Vec<Fault>,
    pub notes: Vec<Note>,
    /// Elements that were looked at; what else there is has been ignored.
    seen: RefCell<HashSet<NodeId>>,
    /// Elements of which all that matters is noted elsewhere.
    passed: RefCell<HashSet<NodeId>>,
    /// Verdicts on every element and attribute of the format.
    elements: &'static [Element],
}

/// Elements within elements that are read: what walks them calls itself once a level, on the stack of a macro. A chain
/// of as many bodies is beyond the operations that a struct can have.
pub const DEEPEST: usize = 256;

/// # Errors
/// What is no XML, or is nested too deep, and where.
pub fn parse(text: &str) -> Result<Document<'_>, Fault> {
    let document = Document::parse_with_options(text, options()).map_err(|error| {
        let roxmltree::TextPos { row, col } = error.pos();
        // The place stands before the message.
        let text = error.to_string();
        let text = text.split(" at ").next().unwrap_or_default();
        Fault { at: At { line: row, column: col, ..At::default() }, message: format!("this is no XML: {text}") }
    })?;
    match beyond(&document) {
        None => Ok(document),
        Some(node) => {
            let roxmltree::TextPos { row, col } = document.text_pos_at(node.range().start);
            let message = format!("{} is nested more than {DEEPEST} levels deep", shown(node));
            Err(Fault { at: At { line: row, column: col, ..At::default() }, message })
        }
    }
}

/// The first element that is nested too deep.
fn beyond<'a>(document: &'a Document<'a>) -> Option<Node<'a, 'a>> {
    // A parent comes before what is in it.
    let mut depths: Vec<usize> = Vec::new();
    document.descendants().find(|node| {
        let around = node.parent().map_or(0, |parent| depths[parent.id().get_usize()]);
        depths.push(around + 1);
        node.is_element() && around > DEEPEST
    })
}

/// Whether an element belongs to another language, by a prefix or by other means: then its name has no meaning here.
pub fn is_foreign(node: Node<'_, '_>) -> bool {
    let own = node.document().root_element().tag_name().namespace();
    node.is_element() && node.tag_name().namespace() != own
}

/// The elements of the format in an element.
pub fn own_elements<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(|child| child.is_element() && !is_foreign(*child))
}

/// An element and the elements of the format in it, each before what is in it; of another language nothing.
pub fn own_descendants<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    let inside = move |inner: &Node<'a, 'a>| inner.ancestors().take_while(|around| *around != node).any(is_foreign);
    node.descendants().filter(move |inner| inner.is_element() && !inside(inner))
}

/// `drake:joint`, as it is written.
fn qualified<'a>(node: Node<'a, 'a>) -> &'a str {
    let written = node.document().input_text().get(node.range()).unwrap_or_default();
    let name = written.trim_start_matches('<');
    name.split(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).next().unwrap_or_default()
}

impl<'a> Reading<'a> {
    /// Begins to read a text that is parsed.
    pub fn new(document: &'a Document<'a>, text: &'a Text, elements: &'static [Element]) -> Self {
        let reading = Self {
            document,
            text,
            faults: Vec::new(),
            notes: Vec::new(),
            seen: RefCell::default(),
            passed: RefCell::default(),
            elements,
        };
        reading.see(document.root_element());
        reading
    }

    pub fn at(&self, node: Node<'a, 'a>) -> At {
        self.place(node.range())
    }

    fn place(&self, range: Range<usize>) -> At {
        self.text.at(range.start)
    }

    /// Notes what is wrong with an element.
    pub fn fault(&mut self, node: Node<'a, 'a>, message: impl std::fmt::Display) {
        self.fault_at(self.at(node), format!("{}: {message}", shown(node)));
    }

    /// Once, however often an element is read.
    fn fault_at(&mut self, at: At, message: String) {
        let fault = Fault { at, message };
        if !self.faults.contains(&fault) {
            self.faults.push(fault);
        }
    }

    /// Notes what is wrong with the value of an attribute.
    pub fn fault_of_value(&mut self, node: Node<'a, 'a>, name: &str, message: impl std::fmt::Display) {
        let at = node.attribute_node(name).map_or_else(|| node.range(), |attribute| attribute.range_value());
        self.fault_at(self.place(at), format!("{}: {message}", shown(node)));
    }

    /// The same, unless something is said of it already.
    pub fn other_fault_of_value(&mut self, node: Node<'a, 'a>, name: &str, message: impl std::fmt::Display) {
        let at = node.attribute_node(name).map_or_else(|| node.range(), |attribute| attribute.range_value());
        let places = [self.at(node), self.place(at)];
        let quoted = format!("`{name}`");
        if !self.faults.iter().any(|fault| places.contains(&fault.at) && fault.message.contains(&quoted)) {
            self.fault_of_value(node, name, message);
        }
    }

    /// Notes what a reader of the equations should know.
    pub fn note(&mut self, node: Node<'a, 'a>, text: impl std::fmt::Display) {
        self.notes.push(Note::told(self.at(node), text.to_string()));
    }

    /// Notes an element or attribute that acts in the file and not in the equations.
    pub fn ignored(&mut self, node: Node<'a, 'a>, text: impl std::fmt::Display) {
        self.notes.push(Note::ignored(self.at(node), node.tag_name().name(), text.to_string()));
    }

    /// Somebody looks at an element.
    pub fn see(&self, node: Node<'a, 'a>) {
        self.seen.borrow_mut().insert(node.id());
    }

    /// Marks an element, with all that is in it, as one of which nothing more is to be noted.
    pub fn pass(&self, node: Node<'a, 'a>) {
        self.passed.borrow_mut().insert(node.id());
    }

    /// A model that can be attached.
    pub fn model(&self, name: &str) -> Result<&'a Text, String> {
        let models = &self.text.models;
        let names = || models.iter().map(|(name, _)| name.as_str());
        models.iter().find(|(own, _)| own == name).map(|(_, text)| text).ok_or_else(|| unknown("model", name, names()))
    }

    /// The whole text.
    pub fn whole(&self) -> &'a Text {
        self.text
    }

    /// The folder of the first file.
    pub fn folder(&self) -> &'a Path {
        let first = self.text.files.first().map(|file| file.path.as_path());
        first.and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// All elements in an element, which are looked at by that.
    pub fn elements(&self, node: Node<'a, 'a>) -> Vec<Node<'a, 'a>> {
        own_elements(node).inspect(|child| self.see(*child)).collect()
    }

    /// The elements of that name in an element.
    pub fn children(&self, node: Node<'a, 'a>, name: &'static str) -> Vec<Node<'a, 'a>> {
        let named = |child: &Node<'a, 'a>| child.tag_name().name() == name;
        own_elements(node).filter(named).inspect(|child| self.see(*child)).collect()
    }

    /// The one element of that name; a second is a fault.
    pub fn child(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<Node<'a, 'a>> {
        let all = self.children(node, name);
        if let [_, second, ..] = all.as_slice() {
            self.fault(*second, format!("{} has a second <{name}>", shown(node)));
        }
        all.first().copied()
    }

    /// An attribute as it is written.
    pub fn text(&self, node: Node<'a, 'a>, name: &'static str) -> Option<&'a str> {
        node.attribute(name).map(str::trim)
    }

    /// The text of an attribute that must be there and not empty.
    pub fn required(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<String> {
        let value = self.text(node, name).filter(|value| !value.is_empty());
        if value.is_none() {
            self.fault(node, format!("the attribute `{name}` is missing"));
        }
        value.map(str::to_owned)
    }

    /// Finite numbers, separated by blanks; `None` without the attribute, or where it is wrong.
    pub fn list(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<Vec<f64>> {
        let text = self.text(node, name)?;
        let read = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(read).collect();
        if numbers.is_none() {
            self.fault_of_value(node, name, format!("`{name}` is numbers, found `{text}`"));
        }
        numbers
    }

    /// Exactly `N` finite numbers, separated by blanks; `None` without the attribute, or where it is wrong.
    pub fn numbers<const N: usize>(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<[f64; N]> {
        let text = self.text(node, name)?;
        let read = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(read).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        if numbers.is_none() {
            let expected = if N == 1 { "one number".to_owned() } else { format!("{N} numbers") };
            self.fault_of_value(node, name, format!("`{name}` is {expected}, found `{text}`"));
        }
        numbers
    }

    /// One number.
    pub fn number(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<f64> {
        self.numbers::<1>(node, name).map(|[number]| number)
    }

    /// One number that must be there.
    pub fn required_number(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<f64> {
        if node.attribute(name).is_none() {
            self.fault(node, format!("the attribute `{name}` is missing"));
        }
        self.number(node, name)
    }

    /// One number that is not negative, zero where the file gives none.
    pub fn amount(&mut self, node: Node<'a, 'a>, name: &'static str) -> f64 {
        match self.number(node, name) {
            Some(number) if number < 0.0 => {
                self.fault_of_value(node, name, format!("`{name}` is zero or more, found `{number}`"));
                0.0
            }
            number => number.unwrap_or(0.0),
        }
    }

    /// Notes everything that nobody looked at: what is harmless in one note, what may act as ignored, once for each
    /// name.
    pub fn note_unread(&mut self) {
        let (mut quiet, mut acting) = (Unread::default(), Unread::default());
        self.unread(self.document.root_element(), &mut quiet, &mut acting);
        for Kind { key, first, shown, places } in acting.kinds {
            let others =
                if places.len() > 1 { format!("; likewise in {}", lines(first, &places[1..])) } else { String::new() };
            self.notes.push(Note::ignored(first, key, format!("{shown}{others}")));
        }
        if let Some(Kind { first, .. }) = quiet.kinds.first() {
            let names: Vec<String> =
                quiet.kinds.iter().map(|kind| format!("{} ({})", kind.key, kind.places.len())).collect();
            let text = format!("not read, as it has no part in the motion, how many times: {}", names.join(", "));
            self.notes.push(Note::told(*first, text));
        }
    }

    fn unread(&self, node: Node<'a, 'a>, quiet: &mut Unread<'a>, acting: &mut Unread<'a>) {
        let tag = node.tag_name().name();
        if self.passed.borrow().contains(&node.id()) {
            return;
        }
        if is_foreign(node) && !self.seen.borrow().contains(&node.id()) {
            // All of one language together.
            let language = qualified(node).split(':').next().unwrap_or_default();
            return acting.add(language, self.at(node), || format!("{} is not read", shown(node)));
        }
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        let element = Element::find(self.elements, parent, tag);
        match element.map(|element| element.verdict) {
            Some(Verdict::Harmless(_)) => return quiet.add(tag, self.at(node), String::new),
            Some(Verdict::Warned(words, _)) => {
                return acting.add(tag, self.at(node), || format!("{} does not act: {words}", shown(node)));
            }
            Some(Verdict::Acts) if self.seen.borrow().contains(&node.id()) => {}
            _ => return acting.add(tag, self.at(node), || format!("{} is not read", shown(node))),
        }
        for attribute in node.attributes() {
            let name = attribute.name();
            let is_own = attribute.namespace().is_none();
            let at = || self.place(attribute.range());
            let what = || format!("the attribute `{name}` of {}", shown(node));
            match element.and_then(|element| element.of(name)).filter(|_| is_own) {
                Some(Verdict::Acts) => {}
                // Names are not told of.
                Some(Verdict::Harmless(_)) if name == "name" => {}
                Some(Verdict::Harmless(_)) => quiet.add(name, at(), String::new),
                Some(Verdict::Warned(_, usual)) if is_usual(attribute.value(), usual) => {
                    quiet.add(name, at(), String::new);
                }
                Some(Verdict::Warned(words, _)) => {
                    acting.add(name, at(), || format!("{} does not act: {words}", what()))
                }
                None => acting.add(name, at(), || format!("{} is not read", what())),
            }
        }
        node.children().filter(Node::is_element).for_each(|child| self.unread(child, quiet, acting));
    }
}

/// A value is one of those that do nothing: numbers all of that size, or the word.
fn is_usual(value: &str, usual: &str) -> bool {
    let same = |word: &str, other: &str| match (word.parse::<f64>(), other.parse::<f64>()) {
        (Ok(a), Ok(b)) => a == b,
        _ => word == other,
    };
    value.split_whitespace().all(|word| usual.split_whitespace().any(|other| same(word, other)))
}

/// Elements and attributes that are not read, by their names.
#[derive(Default)]
struct Unread<'a> {
    kinds: Vec<Kind<'a>>,
}

struct Kind<'a> {
    key: &'a str,
    first: At,
    shown: String,
    places: Vec<At>,
}

impl<'a> Unread<'a> {
    fn add(&mut self, key: &'a str, at: At, shown: impl Fn() -> String) {
        match self.kinds.iter_mut().find(|kind| kind.key == key) {
            Some(kind) => kind.places.push(at),
            None => self.kinds.push(Kind { key, first: at, shown: shown(), places: vec![at] }),
        }
    }
}

/// `<joint name="elbow">`.
pub fn shown<'a>(node: Node<'a, 'a>) -> String {
    let tag = qualified(node);
    match node.attribute("name") {
        Some(name) => format!("<{tag} name=\"{name}\">"),
        None => format!("<{tag}>"),
    }
}
