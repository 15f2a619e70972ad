//! Names of a file as identifiers, each with one meaning.

use std::collections::HashSet;

use proc_macro2::{Ident, Span};

use crate::model::language::words::UNNAMED;
use crate::model::names::naming::is_reserved;
use gauss_robots::description::{At, Note};

/// Identifiers that are taken.
#[derive(Clone)]
pub struct RobotNames {
    span: Span,
    taken: HashSet<String>,
    /// Words of the file: nothing has one of them that is not called so there.
    own: HashSet<String>,
    pub notes: Vec<Note>,
}

impl RobotNames {
    /// Names for a file that calls its joints and links so.
    pub fn new<'a>(span: Span, own: impl IntoIterator<Item = &'a String>) -> Self {
        Self { span, taken: HashSet::new(), own: own.into_iter().cloned().collect(), notes: Vec::new() }
    }

    /// The identifier of a name, which differs from it where it is none or is taken: then `noun` is added, or a number.
    pub fn identifier(&mut self, name: &str, noun: &str, at: At) -> Ident {
        let free = self.free(name, noun);
        if free != name {
            self.notes.push(Note::told(at, format!("the {noun} `{name}` is called `{free}`")));
        }
        free
    }

    /// The identifier of a name that is not in the file.
    pub fn chosen(&mut self, name: &str) -> Ident {
        self.free(name, "coordinate")
    }

    fn free(&mut self, name: &str, noun: &str) -> Ident {
        let free = free(name, noun, |word| self.is_free(word) && (word == name || !self.own.contains(word)));
        self.taken.insert(free.clone());
        Ident::new(&free, self.span)
    }

    fn is_free(&self, word: &str) -> bool {
        !self.taken.contains(word) && word != UNNAMED && !is_reserved(word)
    }
}

/// The first word for a name that is free: itself, or with a noun or a number.
pub fn free(name: &str, noun: &str, is_free: impl Fn(&str) -> bool) -> String {
    let mut word: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    if !word.starts_with(|c: char| c.is_alphabetic() || c == '_') || word.trim_matches('_').is_empty() {
        word = format!("{noun}_{word}");
    }
    let numbered = (2..).map(|n| format!("{word}_{n}"));
    let candidates = [word.clone(), format!("{word}_{noun}")].into_iter().chain(numbered);
    let is_word = |word: &String| syn::parse_str::<Ident>(word).is_ok();
    candidates.into_iter().find(|word| is_word(word) && is_free(word)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers() {
        let mut names = RobotNames::new(Span::call_site(), &[]);
        let mut of = |name: &str, noun: &str| names.identifier(name, noun, At::default()).to_string();
        assert_eq!(of("elbow", "joint"), "elbow");
        assert_eq!(of("elbow", "link"), "elbow_link");
        assert_eq!(of("elbow", "link"), "elbow_2");
        assert_eq!(of("left foot/toe-1", "link"), "left_foot_toe_1");
        assert_eq!(of("1", "joint"), "joint_1");
        assert_eq!(of("type", "joint"), "type_joint");
        assert_eq!(of("body", "link"), "body_link");
        assert_eq!(of("pi", "joint"), "pi_joint");
        assert_eq!(of("LF_HAA", "joint"), "LF_HAA");
        assert_eq!(of("-", "joint"), "joint__");
        assert_eq!(names.notes.len(), 8);
    }

    /// Whichever comes first, what is called so in the file keeps its name.
    #[test]
    fn names_of_the_file_come_first() {
        let own = ["left-hip", "left_hip", "arm", "arm_link"].map(str::to_owned);
        let mut names = RobotNames::new(Span::call_site(), &own);
        let mut of = |name: &str, noun: &str| names.identifier(name, noun, At::default()).to_string();
        assert_eq!(of("left-hip", "joint"), "left_hip_joint");
        assert_eq!(of("left_hip", "joint"), "left_hip");
        assert_eq!(of("arm", "joint"), "arm");
        assert_eq!(of("arm", "link"), "arm_2");
        assert_eq!(of("arm_link", "link"), "arm_link");
    }
}
