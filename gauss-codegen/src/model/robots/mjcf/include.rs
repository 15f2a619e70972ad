//! `<include file="…"/>`: what is in the root of another file stands in its place.
//!
//! Paths are relative to the folder of the first file, or else to that of the file that includes, and each file is
//! included once, as MuJoCo's reader has it (`IncludeXML` in `src/xml/xml.cc`).

use std::path::{Path, PathBuf};

use roxmltree::Node;

use super::replicate::replicated;
use crate::model::robots::description::{At, Fault};
use crate::model::robots::text::{MOST_OF_TEXT, Text, Written};
use crate::model::robots::xml::{is_foreign, parse, shown};

const INCLUDE: &str = "include";

/// Files of which each is included by the one before.
const MOST_OPEN: usize = 32;

/// The text with all that it includes, and with the copies that it asks for.
///
/// # Errors
/// Files that are no XML or cannot be read, that include themselves, or are included twice.
pub fn included(main: Written) -> Result<Text, (Text, Vec<Fault>)> {
    let mut gathering = Gathering { text: Text::empty(main), open: vec![0], faults: Vec::new() };
    gathering.file(0);
    let Gathering { text, faults, .. } = gathering;
    if faults.is_empty() { replicated(text) } else { Err((text, faults)) }
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
                let at = At { file: u32::try_from(file).unwrap_or(u32::MAX), ..fault.at };
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
        let inside = |node: &Node<'_, '_>| node.ancestors().skip(1).any(is_include);
        for node in root.descendants().filter(|node| is_include(*node) && !inside(node)) {
            self.text.put(file, start..node.range().start);
            self.include(file, node);
            start = node.range().end;
        }
        self.text.put(file, start..range.end);
    }

    fn include(&mut self, by: usize, node: Node<'_, '_>) {
        if let Err(message) = self.included(by, node) {
            let at = self.text.files[by].place(by, node.range().start);
            self.faults.push(Fault { at, message: format!("{}: {message}", shown(node)) });
        }
    }

    fn included(&mut self, by: usize, node: Node<'_, '_>) -> Result<(), String> {
        if node.children().any(|child| child.is_element()) {
            return Err("there is nothing in an <include>; what it stands for is in its file".to_owned());
        }
        let name = node.attribute("file").map(str::trim).filter(|name| !name.is_empty());
        let name = name.ok_or("the attribute `file` is missing")?;
        if self.open.len() > MOST_OPEN {
            return Err(format!("files include each other more than {MOST_OPEN} deep"));
        }
        let path = self.path(by, name);
        let same = |other: &Path| {
            other == path || matches!((other.canonicalize(), path.canonicalize()), (Ok(a), Ok(b)) if a == b)
        };
        if let Some(known) = self.text.files.iter().position(|file| same(&file.path)) {
            return Err(self.again(known, name));
        }
        let shown = Path::new(&self.text.files[0].shown).with_file_name(name).to_string_lossy().into_owned();
        let written = Written::read(shown, path)?;
        let bytes: usize = self.text.files.iter().map(|file| file.text.len()).sum();
        if bytes + written.text.len() > MOST_OF_TEXT as usize {
            return Err(format!("with `{name}` all files together are larger than {} MiB", MOST_OF_TEXT >> 20));
        }
        let file = self.text.files.len();
        self.text.files.push(written);
        self.open.push(file);
        self.file(file);
        self.open.pop();
        Ok(())
    }

    /// In the folder of the first file; if it is not there, in that of the file that includes it.
    fn path(&self, by: usize, name: &str) -> PathBuf {
        let beside = |file: usize| {
            let path = &self.text.files[file].path;
            path.parent().unwrap_or(path).join(name)
        };
        let first = beside(0);
        let other = Some(beside(by)).filter(|other| !first.exists() && other.exists());
        other.unwrap_or(first)
    }

    /// A file that is there already.
    fn again(&self, known: usize, name: &str) -> String {
        let names = |files: &[usize]| {
            let all = files.iter().map(|&file| format!("`{}`", self.text.files[file].shown));
            all.collect::<Vec<_>>().join(" includes ")
        };
        match self.open.iter().position(|&open| open == known) {
            Some(first) => {
                let circle: Vec<usize> = self.open[first..].iter().copied().chain([known]).collect();
                format!("files include each other in a circle: {}", names(&circle))
            }
            None => format!("`{name}` is included a second time; each file can be included once"),
        }
    }
}

fn is_include(node: Node<'_, '_>) -> bool {
    node.tag_name().name() == INCLUDE && !is_foreign(node)
}
