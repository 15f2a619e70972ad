//! Elements and attributes of an XML file, with what is wrong in them and where.

use std::ops::Range;

use roxmltree::{Document, Node};

use super::description::{At, Fault, Note};

/// A file while it is read.
pub struct Reading<'a> {
    document: &'a Document<'a>,
    pub faults: Vec<Fault>,
    pub notes: Vec<Note>,
}

/// # Errors
/// What is no XML, and where.
pub fn parse(text: &str) -> Result<Document<'_>, Fault> {
    let options = roxmltree::ParsingOptions { allow_dtd: false, ..Default::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let roxmltree::TextPos { row, col } = error.pos();
        // The place stands before the message.
        let text = error.to_string();
        let text = text.split(" at ").next().unwrap_or_default();
        Fault { at: At { line: row, column: col }, message: format!("this is no XML: {text}") }
    })
}

impl<'a> Reading<'a> {
    pub fn new(document: &'a Document<'a>) -> Self {
        Self { document, faults: Vec::new(), notes: Vec::new() }
    }

    pub fn at(&self, node: Node<'a, 'a>) -> At {
        self.place(node.range())
    }

    fn place(&self, range: Range<usize>) -> At {
        let roxmltree::TextPos { row, col } = self.document.text_pos_at(range.start);
        At { line: row, column: col }
    }

    /// Notes what is wrong with an element.
    pub fn fault(&mut self, node: Node<'a, 'a>, message: impl std::fmt::Display) {
        let message = format!("{}: {message}", shown(node));
        self.faults.push(Fault { at: self.at(node), message });
    }

    /// Notes what is wrong with the value of an attribute.
    fn fault_of_value(&mut self, node: Node<'a, 'a>, name: &str, message: impl std::fmt::Display) {
        let at = node.attribute_node(name).map_or_else(|| node.range(), |attribute| attribute.range_value());
        self.faults.push(Fault { at: self.place(at), message: format!("{}: {message}", shown(node)) });
    }

    /// Notes what a reader of the equations should know.
    pub fn note(&mut self, node: Node<'a, 'a>, ignored: bool, text: impl std::fmt::Display) {
        self.notes.push(Note { at: self.at(node), text: text.to_string(), ignored });
    }

    /// The elements of that name in an element.
    pub fn children(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
        node.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
    }

    /// The one element of that name; a second is a fault.
    pub fn child(&mut self, node: Node<'a, 'a>, name: &'static str) -> Option<Node<'a, 'a>> {
        let mut all = Self::children(node, name);
        let first = all.next();
        if let Some(second) = all.next() {
            self.fault(second, format!("{} has a second <{name}>", shown(node)));
        }
        first
    }

    /// The text of an attribute that must be there and not empty.
    pub fn required(&mut self, node: Node<'a, 'a>, name: &str) -> Option<String> {
        let value = node.attribute(name).map(str::trim).filter(|value| !value.is_empty());
        if value.is_none() {
            self.fault(node, format!("the attribute `{name}` is missing"));
        }
        value.map(str::to_owned)
    }

    /// Exactly `N` finite numbers, separated by blanks; `None` without the attribute, or where it is wrong.
    pub fn numbers<const N: usize>(&mut self, node: Node<'a, 'a>, name: &str) -> Option<[f64; N]> {
        let text = node.attribute(name)?;
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
    pub fn number(&mut self, node: Node<'a, 'a>, name: &str) -> Option<f64> {
        self.numbers::<1>(node, name).map(|[number]| number)
    }

    /// One number that must be there.
    pub fn required_number(&mut self, node: Node<'a, 'a>, name: &str) -> Option<f64> {
        if node.attribute(name).is_none() {
            self.fault(node, format!("the attribute `{name}` is missing"));
        }
        self.number(node, name)
    }

    /// One number that is not negative, zero where it is not said.
    pub fn amount(&mut self, node: Node<'a, 'a>, name: &str) -> f64 {
        match self.number(node, name) {
            Some(number) if number < 0.0 => {
                self.fault_of_value(node, name, format!("`{name}` is zero or more, found `{number}`"));
                0.0
            }
            number => number.unwrap_or(0.0),
        }
    }
}

/// `<joint name="elbow">`.
pub fn shown(node: Node<'_, '_>) -> String {
    let tag = node.tag_name().name();
    match node.attribute("name") {
        Some(name) => format!("<{tag} name=\"{name}\">"),
        None => format!("<{tag}>"),
    }
}
