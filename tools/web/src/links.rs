//! Links of the site that lead nowhere, and pages without a title.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

/// Scripts that pages of rustdoc ask for whether they are there or not: implementors of a trait in other crates.
const OPTIONAL: &str = "trait.impl/";
/// The folder whose pages rustdoc has made: it checks places within pages itself.
const REFERENCE: &str = "reference";
/// The table of contents that mdBook shows within other pages.
const FRAME: &str = "toc.html";

/// A page as far as links are concerned.
struct Page {
    links: BTreeSet<String>,
    /// Places that a link may lead to.
    places: BTreeSet<String>,
    title: bool,
}

impl Page {
    fn read(html: &str) -> Self {
        let mut page = Page { links: BTreeSet::new(), places: BTreeSet::new(), title: false };
        for tag in tags(html) {
            page.title |= tag == "title";
            page.links.extend(["href", "src"].iter().filter_map(|name| attribute(tag, name)));
            page.places.extend(attribute(tag, "id"));
        }
        page
    }
}

/// Faults of the pages of a folder, a line each: links to files that are not in it, links to places that a page does
/// not have, pages without a title. Links to elsewhere are not followed.
///
/// # Errors
/// Files that cannot be read.
pub fn faults(folder: &Path) -> io::Result<Vec<String>> {
    let mut files = Vec::new();
    list(folder, Path::new(""), &mut files)?;
    let mut pages = BTreeMap::new();
    for file in files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "html")) {
        pages.insert(file.clone(), Page::read(&fs::read_to_string(folder.join(file))?));
    }
    let files: BTreeSet<PathBuf> = files.into_iter().collect();
    let mut faults = Vec::new();
    for (file, page) in &pages {
        if !page.title && !file.ends_with(FRAME) {
            faults.push(format!("{} has no title", file.display()));
        }
        let dead = page.links.iter().filter(|link| !leads_somewhere(link, file, &files, &pages));
        faults.extend(dead.map(|link| format!("{} leads to {link}", file.display())));
    }
    Ok(faults)
}

fn leads_somewhere(link: &str, page: &Path, files: &BTreeSet<PathBuf>, pages: &BTreeMap<PathBuf, Page>) -> bool {
    if ["http:", "https:", "mailto:", "data:", "javascript:"].iter().any(|scheme| link.starts_with(scheme)) {
        return true;
    }
    let (address, place) = link.split_once('#').unwrap_or((link, ""));
    let address = address.split('?').next().unwrap_or("");
    if address.contains(OPTIONAL) {
        return true;
    }
    let target = if address.is_empty() { Some(page.to_owned()) } else { joined(page, &decoded(address)) };
    let index = target.as_ref().map(|target| target.join("index.html"));
    let Some(target) = [target, index].into_iter().flatten().find(|file| files.contains(file)) else { return false };
    // `#` alone is the top of a page.
    let everywhere = place.is_empty() || page.starts_with(REFERENCE);
    let has = |page: &Page| page.places.contains(place) || page.places.contains(&decoded(place));
    everywhere || pages.get(&target).is_none_or(has)
}

/// The file of an address that stands in a page, where it is within the folder.
fn joined(page: &Path, address: &str) -> Option<PathBuf> {
    let mut file = page.parent()?.to_owned();
    for part in Path::new(address).components() {
        match part {
            Component::Normal(name) => file.push(name),
            Component::ParentDir if file.pop() => {}
            Component::CurDir => {}
            _ => return None,
        }
    }
    Some(file)
}

/// All files of a folder, from `below` on.
fn list(folder: &Path, below: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder.join(below))? {
        let entry = entry?;
        let file = below.join(entry.file_name());
        if entry.file_type()?.is_dir() { list(folder, &file, files)? } else { files.push(file) }
    }
    Ok(())
}

/// Tags of a page in turn, without their brackets; what is within scripts, styles and comments is none.
fn tags(html: &str) -> Vec<&str> {
    let (mut tags, mut left) = (Vec::new(), html);
    while let Some((_, rest)) = left.split_once('<') {
        left = rest;
        if let Some(comment) = left.strip_prefix("!--") {
            left = comment.split_once("-->").map_or("", |(_, rest)| rest);
        } else if left.starts_with(|first: char| first.is_ascii_alphabetic()) {
            let tag = &left[..end_of_tag(left)];
            left = &left[tag.len()..];
            tags.push(tag);
            for name in ["script", "style"] {
                if tag.split_whitespace().next() == Some(name) {
                    left = left.find(&format!("</{name}")).map_or("", |end| &left[end..]);
                }
            }
        }
    }
    tags
}

/// The place of the first `>` that is not within quotes.
fn end_of_tag(text: &str) -> usize {
    let mut quote = None;
    for (n, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'>') => return n,
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(mark), byte) if mark == byte => quote = None,
            _ => {}
        }
    }
    text.len()
}

/// The value of an attribute, which has quotes around it.
fn attribute(tag: &str, name: &str) -> Option<String> {
    let mut left = tag;
    while let Some((before, rest)) = left.split_once('=') {
        left = rest.trim_start();
        let Some(mark) = left.chars().next().filter(|mark| matches!(mark, '"' | '\'')) else { continue };
        let (value, rest) = left[1..].split_once(mark)?;
        if before.split_whitespace().last() == Some(name) {
            return Some(value.replace("&amp;", "&"));
        }
        left = rest;
    }
    None
}

/// An address with `%20` and the like as the bytes that they stand for.
fn decoded(address: &str) -> String {
    let (mut bytes, mut left) = (Vec::new(), address.as_bytes());
    while let [first, rest @ ..] = left {
        let digits = rest.get(..2).filter(|_| *first == b'%').and_then(|digits| str::from_utf8(digits).ok());
        let code = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(code.unwrap_or(*first));
        left = if code.is_some() { &rest[2..] } else { rest };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
