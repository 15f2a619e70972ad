//! Elements of XML. Names are identifiers of the scene, so that nothing needs to be escaped.

use std::fmt::{Display, Write};

use super::numbers::shortest;

/// Rounding of directions and quaternions.
pub const OF_TURNS: f64 = 4e-16;

/// An element up to its end.
pub struct Tag(String);

/// A number in decimals, a far one with its exponent.
fn decimal(x: f64) -> String {
    if x != 0.0 && !(1e-5..1e16).contains(&x.abs()) { format!("{x:e}") } else { (x + 0.0).to_string() }
}

impl Tag {
    pub fn new(depth: usize, name: &str) -> Self {
        Self(format!("{}<{name}", "  ".repeat(depth)))
    }

    pub fn word(mut self, name: &str, value: impl Display) -> Self {
        write!(self.0, " {name}=\"{value}\"").ok();
        self
    }

    pub fn number(self, name: &str, value: f64) -> Self {
        self.word(name, decimal(value))
    }

    /// The same, where it is not 0.
    pub fn some(self, name: &str, value: f64) -> Self {
        if value == 0.0 { self } else { self.number(name, value) }
    }

    /// Numbers, each with the fewest digits within an error: what rounding added is none.
    pub fn numbers<'a>(self, name: &str, list: impl IntoIterator<Item = &'a f64>, error: f64) -> Self {
        let list: Vec<String> = list.into_iter().map(|x| decimal(shortest(*x, error))).collect();
        self.word(name, list.join(" "))
    }

    /// The element without content.
    pub fn close(self) -> String {
        self.0 + "/>\n"
    }

    /// Its first tag.
    pub fn open(self) -> String {
        self.0 + ">\n"
    }
}

/// An element with content, where there is some.
pub fn section(name: &str, content: &str, out: &mut String) {
    if !content.is_empty() {
        *out += &format!("  <{name}>\n{content}  </{name}>\n");
    }
}

/// A line of a comment, in which no two hyphens may follow each other.
pub fn comment(text: &str) -> String {
    let mut text = text.to_owned();
    while text.contains("--") {
        text = text.replace("--", "- -");
    }
    format!("  <!-- {} -->\n", text.trim_end_matches('-'))
}
