//! `<replicate count="3" …>`: copies of the elements in it, each in a frame, with numbers after the names.
//!
//! As `mjXReader::Body` of MuJoCo's `src/xml/xml_native_reader.cc` has it: copy i is turned by i times the angles, and
//! moved from the one before by the offset in the axes of that. What refers to a copied element is copied with it, and
//! stands after the others of its kind. Of replicates in each other the inner one is first.

use std::collections::BTreeSet;
use std::ops::Range;

use roxmltree::Node;

use super::labels::{Affix, NamedElement, SECTIONS, name_of, references};
use super::reference::ELEMENTS;
use super::rotations::Angles;
use crate::description::Fault;
use crate::rotation::{Triple, turned};
use crate::text::{MOST_OF_TEXT, Text};
use crate::xml::{Reading, own_descendants, own_elements, parse, shown};

const REPLICATE: &str = "replicate";

/// Attributes of `<replicate>` that are read. MuJoCo's schema has `prefix`, too.
const KNOWN: [&str; 5] = ["count", "offset", "euler", "sep", "childclass"];

/// Copies of one element.
const MOST_COPIES: usize = 1000;

/// Replicates of a file; the text is read once for each.
const MOST: usize = 100;

/// The text with all copies written out, and what is wrong: counts that are none, and what cannot be copied.
pub fn replicated(mut text: Text) -> (Text, Vec<Fault>) {
    for _ in 0..=MOST {
        match once(&text) {
            Ok(Some(next)) => text = next.of_files(text),
            Ok(None) => return (text, Vec::new()),
            Err(fault) => return (text, vec![fault]),
        }
    }
    let at = text.whole.find("<replicate").map(|offset| text.at(offset)).unwrap_or_default();
    let message = format!("a file has {MOST} <replicate> at most");
    (text, vec![Fault { at, message }])
}

/// Writes the copies of one element out; `None` if there is none.
fn once(text: &Text) -> Result<Option<Text>, Fault> {
    // What is no XML is told by whoever reads it next.
    let Ok(document) = parse(&text.whole) else { return Ok(None) };
    let root = document.root_element();
    let innermost = |node: &Node<'_, '_>| !own_descendants(*node).skip(1).any(|inner| inner.has_tag_name(REPLICATE));
    let mut replicates = own_descendants(root).filter(|node| node.has_tag_name(REPLICATE));
    let Some(node) = replicates.find(innermost) else { return Ok(None) };
    let mut reading = Reading::new(&document, text, ELEMENTS);
    let angles = Angles::read(root, &mut reading);
    // Those are told when the whole is read.
    let others = reading.faults.len();
    let copies = Copies::read(node, &angles, &mut reading);
    let mut named = BTreeSet::new();
    own_descendants(node).skip(1).for_each(|inner| named.extend(name_of(inner)));
    let mut referring = Vec::new();
    for section in SECTIONS {
        let all = own_elements(root).filter(|child| child.has_tag_name(section));
        for element in all.flat_map(own_elements) {
            if own_descendants(element).any(|inner| references(inner).iter().any(|(_, own)| named.contains(own))) {
                named.extend(name_of(element));
                referring.push((section, element));
            }
        }
    }
    if let Some(fault) = reading.faults.into_iter().nth(others) {
        return Err(fault);
    }
    let bytes = |node: &Node<'_, '_>| node.range().len();
    let size = copies.count * (bytes(&node) + referring.iter().map(|(_, element)| bytes(element)).sum::<usize>());
    if text.whole.len() + size > MOST_OF_TEXT as usize {
        let message = format!("{}: with its copies the file is larger than {} MiB", shown(node), MOST_OF_TEXT >> 20);
        return Err(Fault { at: text.at(node.range().start), message });
    }
    Ok(Some(copies.written(text, (root, node), &named, &referring)))
}

/// The attributes of the element.
struct Copies<'a> {
    count: usize,
    separator: &'a str,
    class: Option<&'a str>,
    /// Position of each copy, and its angles as they are written in the file.
    places: Vec<[Triple; 2]>,
}

impl<'a> Copies<'a> {
    fn read(node: Node<'a, 'a>, angles: &Angles, reading: &mut Reading<'a>) -> Self {
        let count = reading.required_number(node, "count").unwrap_or(1.0);
        if !(count >= 1.0 && count <= MOST_COPIES as f64 && count.fract() == 0.0) {
            reading.fault(node, format!("`count` is a whole number from 1 to {MOST_COPIES}, found `{count}`"));
        }
        // Nobody sees the element after this.
        for attribute in node.attributes().filter(|attribute| !KNOWN.contains(&attribute.name())) {
            reading.fault(node, format!("the attribute `{}` is not read", attribute.name()));
        }
        for inner in reading.elements(node) {
            let tag = inner.tag_name().name();
            if matches!(tag, "joint" | "freejoint" | "inertial") {
                reading.fault(node, format!("a <{tag}> cannot stand in it; put it into a <body>"));
            }
        }
        if own_descendants(node).any(|inner| inner.has_tag_name("attach")) {
            reading.fault(node, "an <attach> cannot stand in it");
        }
        let offset: Triple = reading.numbers(node, "offset").unwrap_or_default();
        let turn: Triple = reading.numbers(node, "euler").unwrap_or_default();
        let mut position = [0.0; 3];
        let places = (0..count.clamp(1.0, MOST_COPIES as f64) as usize).map(|index| {
            let turn = turn.map(|angle| index as f64 * angle);
            let here = position;
            let moved = turned(&angles.of_sequence(turn), &offset);
            position = std::array::from_fn(|i| here[i] + moved[i]);
            [here, turn]
        });
        let places: Vec<[Triple; 2]> = places.collect();
        let separator = node.attribute("sep").unwrap_or_default();
        Copies { count: places.len(), separator, class: node.attribute("childclass"), places }
    }

    /// Suffix of the names of a copy: its index, with as many digits as the count has.
    fn affix<'n>(&self, named: &'n BTreeSet<NamedElement<'n>>, index: usize) -> Affix<'n> {
        let digits = self.count.to_string().len();
        Affix { named, before: String::new(), after: format!("{}{index:0digits$}", self.separator) }
    }

    fn written(
        &self,
        text: &Text,
        (root, node): (Node<'a, 'a>, Node<'a, 'a>),
        named: &BTreeSet<NamedElement<'_>>,
        referring: &[(&str, Node<'a, 'a>)],
    ) -> Text {
        let mut out = Text::default();
        let mut left: Vec<Range<usize>> = referring.iter().map(|(_, element)| element.range()).collect();
        left.push(node.range());
        left.sort_by_key(|range| range.start);
        let mut start = 0;
        for range in left {
            out.copy(text, start..range.start);
            if range == node.range() {
                self.frames(text, node, named, &mut out);
            }
            start = range.end;
        }
        let end = text.whole[..root.range().end].rfind("</").unwrap_or(start);
        out.copy(text, start..end);
        for section in SECTIONS {
            for index in 0..self.count {
                for (_, element) in referring.iter().filter(|(own, _)| *own == section) {
                    let place = element.range().start;
                    out.add(&format!("<{section}>"), text, place);
                    self.affix(named, index).renamed(text, *element, element.range(), &mut out);
                    out.add(&format!("</{section}>"), text, place);
                }
            }
        }
        out.copy(text, end..text.whole.len());
        out
    }

    fn frames(&self, text: &Text, node: Node<'a, 'a>, named: &BTreeSet<NamedElement<'_>>, out: &mut Text) {
        let (Some(first), Some(last)) = (node.first_child(), node.last_child()) else { return };
        let place = node.range().start;
        let class = self.class.map(|class| format!(" childclass=\"{class}\"")).unwrap_or_default();
        for (index, [[x, y, z], [a, b, c]]) in self.places.iter().enumerate() {
            let open = format!("<frame pos=\"{x:?} {y:?} {z:?}\" euler=\"{a:?} {b:?} {c:?}\"{class}>");
            out.add(&open, text, place);
            self.affix(named, index).renamed(text, node, first.range().start..last.range().end, out);
            out.add("</frame>", text, place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mjcf::read;
    use crate::rotation::of_quaternion;
    use crate::text::Written;

    /// The places are those that MuJoCo 4.0.0 prints (`body_pos`, `body_quat`) of the same file.
    #[test]
    fn places_of_copies() {
        let text = "<mujoco><worldbody><replicate count=\"4\" offset=\"0 1 0\" euler=\"0 30 90\">\
                    <body name=\"b\" pos=\"1 0 0\" euler=\"10 20 30\"><joint name=\"j\"/></body></replicate></worldbody></mujoco>";
        let main = Written::new("main.xml".to_owned(), "main.xml".into(), text.to_owned());
        let (text, faults) = replicated(Text::of(main));
        assert_eq!(faults, []);
        let joints = read(&text).expect("a tree").joints;
        let expected = [
            ([1.0, 0.0, 0.0], [0.943714364147489, 0.12767944069578063, 0.14487812541736914, 0.2685358227515692]),
            ([0.0, 2.0, 0.0], [0.4112740232229402, 0.21011026195305987, 0.3097265287726246, 0.8311298532831639]),
            (
                [-1.3660254037844388, 1.0, 1.3660254037844386],
                [-0.2963985646769044, 0.34638904500963474, -0.023694272192249816, 0.8897196759766886],
            ),
            (
                [-0.8660254037844388, -1.0, 0.5],
                [-0.5975257510887348, 0.20131048764138507, -0.6147244358103232, 0.4738680537545349],
            ),
        ];
        assert_eq!(joints.len(), 4);
        for (joint, (position, quaternion)) in joints.iter().zip(expected) {
            let matrix = of_quaternion(quaternion).expect("a rotation");
            for i in 0..3 {
                // Some ten products and sums of numbers of size one, in each of both programs.
                assert!((joint.position[i] - position[i]).abs() < 32.0 * f64::EPSILON, "{joint:?}");
                let off = |j: usize| (joint.rotation.matrix[i][j] - matrix[i][j]).abs();
                assert!((0..3).all(|j| off(j) < 32.0 * f64::EPSILON), "{joint:?}");
            }
        }
    }
}
