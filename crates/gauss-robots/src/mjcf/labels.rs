//! Names of elements, and what refers to them, in the text of a file: copies and parts of models have names of their
//! own.

use std::collections::BTreeSet;
use std::ops::Range;

use roxmltree::Node;

use crate::text::Text;
use crate::xml::own_descendants;

/// Sections whose elements refer to bodies, joints and sites, in this order: actuators and equalities refer to tendons.
pub const SECTIONS: [&str; 4] = ["tendon", "equality", "contact", "actuator"];

/// An element with a name, as others refer to it: what it is, and its name.
pub type NamedElement<'a> = (&'static str, &'a str);

/// Prefix and suffix of names, and of references to them.
pub struct Affix<'n> {
    pub named: &'n BTreeSet<NamedElement<'n>>,
    pub before: String,
    pub after: String,
}

impl Affix<'_> {
    /// Puts a range of an element to the end of another text.
    pub fn renamed<'a>(&self, text: &Text, node: Node<'a, 'a>, range: Range<usize>, out: &mut Text) {
        let mut start = range.start;
        for inner in own_descendants(node).filter(|inner| range.contains(&inner.range().start)) {
            let own = name_of(inner).map(|own| ("name", own));
            let all: Vec<(&str, NamedElement<'a>)> = own.into_iter().chain(references(inner)).collect();
            // In the order of the text.
            for attribute in inner.attributes().filter(|attribute| attribute.namespace().is_none()) {
                let is_named =
                    |(name, own): &(&str, NamedElement<'a>)| *name == attribute.name() && self.named.contains(own);
                // What a model attaches in its turn has both prefixes.
                let is_prefix = attribute.name() == "prefix" && inner.has_tag_name("attach");
                if is_prefix || all.iter().any(is_named) {
                    let value = attribute.range_value();
                    let written = text.whole[value.clone()].trim();
                    let begin = value.end - text.whole[value].trim_start().len();
                    out.copy(text, start..begin);
                    out.add(&self.before, text, begin);
                    out.copy(text, begin..begin + written.len());
                    out.add(&self.after, text, begin);
                    start = begin + written.len();
                }
            }
        }
        out.copy(text, start..range.end);
    }
}

/// Kind and name of an element of a tree, or of a section.
pub fn name_of<'a>(node: Node<'a, 'a>) -> Option<NamedElement<'a>> {
    let around = node.parent_element().map_or("", |parent| parent.tag_name().name());
    let kind = match node.tag_name().name() {
        _ if matches!(around, "equality" | "contact" | "actuator") => "other",
        "joint" | "freejoint" => "joint",
        "fixed" | "spatial" => "tendon",
        "body" => "body",
        "site" => "site",
        "geom" => "geom",
        "frame" => "frame",
        "camera" => "camera",
        "light" => "light",
        _ => return None,
    };
    Some((kind, node.attribute("name")?.trim()))
}

/// References of an element to others, by its attributes.
pub fn references<'a>(node: Node<'a, 'a>) -> Vec<(&'static str, NamedElement<'a>)> {
    /// Kinds with the attributes that refer to them, in the elements of trees and sections.
    const ALL: [(&str, &[&str]); 5] = [
        ("joint", &["joint", "jointinparent", "joint1", "joint2"]),
        ("body", &["body", "body1", "body2", "target"]),
        ("site", &["site", "site1", "site2", "refsite", "cranksite", "slidersite", "sidesite"]),
        ("geom", &["geom", "geom1", "geom2"]),
        ("tendon", &["tendon", "tendon1", "tendon2"]),
    ];
    let of = |&(kind, names): &(&'static str, &'static [&'static str])| {
        names.iter().filter_map(move |name| Some((*name, (kind, node.attribute(*name)?.trim()))))
    };
    ALL.iter().flat_map(of).collect()
}
