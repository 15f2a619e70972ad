//! `<include file="…"/>`: what is in the root of another file stands in its place.
//!
//! Paths are relative to the folder of the first file, or else to that of the file that includes, and each file is
//! included once, as MuJoCo's reader has it (`IncludeXML` in `src/xml/xml.cc`).

use std::path::{Path, PathBuf};

use roxmltree::Node;

use super::replicate::replicated;
use crate::description::{At, Fault};
use crate::text::{MOST_OF_TEXT, Text, Written};
use crate::xml::{is_foreign, own_elements, parse, shown};

const INCLUDE: &str = "include";

/// Files of which each is included by the one before.
const MOST_OPEN: usize = 32;

/// Models that a file attaches, with those that these attach.
const MOST_MODELS: usize = 32;

/// The text with all that it includes, with the copies that it asks for and the models that it attaches; and what is
/// wrong: files that are no XML or cannot be read, that include themselves, or are included twice.
pub fn included(main: Written) -> (Text, Vec<Fault>) {
    gathered(main, 0, &mut Models { around: Vec::new(), left: MOST_MODELS })
}

fn gathered(main: Written, first: usize, models: &mut Models) -> (Text, Vec<Fault>) {
    models.around.push(main.path.clone());
    let mut text = Text::empty(main);
    text.first = first;
    let mut gathering = Gathering { text, open: vec![0], faults: Vec::new() };
    gathering.file(0);
    let Gathering { text, faults, .. } = gathering;
    let (text, faults) = if faults.is_empty() { replicated(text) } else { (text, faults) };
    let read = if faults.is_empty() { models.of(text) } else { (text, faults) };
    models.around.pop();
    read
}

/// Models that others attach, `<asset><model name="…" file="…"/></asset>`, while they are read.
struct Models {
    /// Files each of which is attached by the one before.
    around: Vec<PathBuf>,
    /// Number of models that may still be read.
    left: usize,
}

impl Models {
    /// The text with those that it attaches, and what is wrong in them.
    fn of(&mut self, mut text: Text) -> (Text, Vec<Fault>) {
        let whole = text.whole.clone();
        // What is no XML is told by whoever reads it next.
        let Ok(document) = parse(&whole) else { return (text, Vec::new()) };
        let sections = own_elements(document.root_element()).filter(|node| node.has_tag_name("asset"));
        let mut faults = Vec::new();
        for node in sections.flat_map(own_elements).filter(|node| node.has_tag_name("model")) {
            match self.model(&text, node) {
                Ok((name, model, own)) => {
                    text.models.push((name, model));
                    faults.extend(own);
                }
                Err(message) => {
                    let at = text.at(node.range().start);
                    faults.push(Fault { at, message: format!("{}: {message}", shown(node)) });
                }
            }
        }
        (text, faults)
    }

    /// One, by its name, and what is wrong in it.
    fn model(&mut self, text: &Text, node: Node<'_, '_>) -> Result<(String, Text, Vec<Fault>), String> {
        let file = node.attribute("file").map(str::trim).filter(|name| !name.is_empty());
        let file = file.ok_or("the attribute `file` is missing")?;
        let main = &text.files[0];
        let path = main.path.parent().unwrap_or(&main.path).join(file);
        if self.around.iter().any(|other| is_same(other, &path)) {
            return Err(format!("`{file}` attaches itself, or what attaches it"));
        }
        self.left = self.left.checked_sub(1).ok_or_else(|| format!("more than {MOST_MODELS} models are attached"))?;
        let written = Written::read(beside(&main.shown, file), path)?;
        let own = parse(&written.text).ok().and_then(|own| own.root_element().attribute("model").map(str::to_owned));
        let name = node.attribute("name").map(|name| name.trim().to_owned()).or(own).unwrap_or_default();
        let (model, faults) = gathered(written, text.first + text.names().len(), self);
        Ok((name, model, faults))
    }
}

/// Two paths lead to one file.
fn is_same(path: &Path, other: &Path) -> bool {
    path == other || path.canonicalize().is_ok_and(|path| other.canonicalize().is_ok_and(|other| path == other))
}

/// Name of a file in the folder of another, as messages show it.
fn beside(shown: &str, name: &str) -> String {
    Path::new(shown).with_file_name(name).to_string_lossy().into_owned()
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
                let at = At { file: u32::try_from(self.text.first + file).unwrap_or(u32::MAX), ..fault.at };
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
            let at = self.text.files[by].place(self.text.first + by, node.range().start);
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
        if let Some(known) = self.text.files.iter().position(|file| is_same(&file.path, &path)) {
            return Err(self.again(known, name));
        }
        let shown = beside(&self.text.files[0].shown, name);
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
        let in_folder = |file: usize| {
            let path = &self.text.files[file].path;
            path.parent().unwrap_or(path).join(name)
        };
        let first = in_folder(0);
        let other = Some(in_folder(by)).filter(|other| !first.exists() && other.exists());
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
