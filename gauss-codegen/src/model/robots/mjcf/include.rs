//! `<include file="…"/>`: what is in the root of another file stands in its place.
//!
//! Paths are relative to the folder of the first file, and each file is included once, as MuJoCo has it.

use roxmltree::Node;

use crate::model::robots::description::Fault;
use crate::model::robots::text::{self, Text, Written};
use crate::model::robots::xml::{parse, shown};

const INCLUDE: &str = "include";

/// The text with all that it includes.
///
/// # Errors
/// Files that are no XML or cannot be read, that include themselves, or are included twice.
pub fn included(main: Written) -> Result<Text, (Text, Vec<Fault>)> {
    let mut gathering = Gathering { text: Text::empty(main), open: vec![0], faults: Vec::new() };
    gathering.file(0);
    let Gathering { text, faults, .. } = gathering;
    if faults.is_empty() { Ok(text) } else { Err((text, faults)) }
}

struct Gathering {
    text: Text,
    /// Files that are being read, each included by the one before.
    open: Vec<usize>,
    faults: Vec<Fault>,
}

impl Gathering {
    /// Puts a file to the end: the first with its root, others without.
    fn file(&mut self, file: usize) {
        let own = self.text.files[file].text.clone();
        let document = match parse(&own) {
            Ok(document) => document,
            Err(fault) => {
                let at = crate::model::robots::description::At { file: index(file), ..fault.at };
                return self.faults.push(Fault { at, ..fault });
            }
        };
        let root = document.root_element();
        let range = match (file, root.first_child(), root.last_child()) {
            (0, ..) => 0..own.len(),
            (_, Some(first), Some(last)) => first.range().start..last.range().end,
            _ => return,
        };
        let mut start = range.start;
        for node in root.descendants().filter(|node| node.tag_name().name() == INCLUDE) {
            self.text.put(file, start..node.range().start);
            self.include(file, &own, node);
            start = node.range().end;
        }
        self.text.put(file, start..range.end);
    }

    fn include(&mut self, by: usize, own: &str, node: Node<'_, '_>) {
        let at = text::place(by, own, node.range().start);
        let mut fault =
            |message: String| self.faults.push(Fault { at, message: format!("{}: {message}", shown(node)) });
        let Some(name) = node.attribute("file").map(str::trim).filter(|name| !name.is_empty()) else {
            return fault("the attribute `file` is missing".to_owned());
        };
        let main = &self.text.files[0];
        let path = main.path.parent().unwrap_or(&main.path).join(name);
        if let Some(known) = self.text.files.iter().position(|file| file.path == path) {
            let names = |files: &[usize]| {
                let all = files.iter().map(|&file| format!("`{}`", self.text.files[file].shown));
                all.collect::<Vec<_>>().join(" includes ")
            };
            return match self.open.iter().position(|&open| open == known) {
                Some(first) => {
                    let circle: Vec<usize> = self.open[first..].iter().copied().chain([known]).collect();
                    fault(format!("files include each other in a circle: {}", names(&circle)))
                }
                None => fault(format!("`{name}` is included a second time; each file can be included once")),
            };
        }
        match text::read(&path) {
            Ok(text) => {
                let shown = std::path::Path::new(&main.shown).with_file_name(name).to_string_lossy().into_owned();
                let file = self.text.files.len();
                self.text.files.push(Written { shown, path, text });
                self.open.push(file);
                self.file(file);
                self.open.pop();
            }
            Err(message) => fault(message),
        }
    }
}

fn index(file: usize) -> u32 {
    u32::try_from(file).unwrap_or(u32::MAX)
}
