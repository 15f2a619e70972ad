//! Classes of defaults: where an attribute is written that an element does not have itself.

use roxmltree::Node;

use crate::model::robots::names::unknown;
use crate::model::robots::xml::Reading;

/// The class of what names none.
const MAIN: &str = "main";

/// One `<default>`.
struct Class<'a> {
    name: &'a str,
    parent: Option<usize>,
    node: Node<'a, 'a>,
}

/// All of them; the first is that of elements without a class.
pub struct Classes<'a> {
    all: Vec<Class<'a>>,
}

impl<'a> Classes<'a> {
    pub fn read(root: Node<'a, 'a>, reading: &Reading<'a>) -> Self {
        let mut classes = Self { all: Vec::new() };
        for node in reading.children(root, "default") {
            let top = if classes.all.is_empty() { None } else { Some(0) };
            classes.add(node, top, reading);
        }
        classes
    }

    fn add(&mut self, node: Node<'a, 'a>, parent: Option<usize>, reading: &Reading<'a>) {
        let index = self.all.len();
        let name = reading.text(node, "class").unwrap_or(MAIN);
        self.all.push(Class { name, parent, node });
        for child in reading.children(node, "default") {
            self.add(child, Some(index), reading);
        }
    }

    /// A class that an element names is one of the file; `main` is there always.
    pub fn refuse_strange(&self, root: Node<'a, 'a>, reading: &mut Reading<'a>) {
        let is_default = |node: &Node<'a, 'a>| node.tag_name().name() == "default";
        let outside = |node: &Node<'a, 'a>| node.is_element() && !is_default(node);
        for node in root.descendants().filter(outside) {
            for name in ["class", "childclass"] {
                let Some(class) = node.attribute(name).map(str::trim) else { continue };
                if class != MAIN && !self.all.iter().any(|known| known.name == class) {
                    let which = unknown("class", class, self.all.iter().map(|known| known.name));
                    reading.fault(node, format!("its `{name}` is {which}"));
                }
            }
        }
    }

    /// The element that has an attribute: `node`, or the nearest default of its class, or of that of the body that it
    /// is in, of an element with one of the names in `tags`.
    pub fn carrier(
        &self,
        (node, tags): (Node<'a, 'a>, &[&str]),
        name: &'static str,
        class: Option<&str>,
        reading: &Reading<'a>,
    ) -> Option<Node<'a, 'a>> {
        let named = |node: &Node<'a, 'a>| tags.contains(&node.tag_name().name());
        // What elements are asked for their defaults are, too.
        for child in self.all.iter().flat_map(|class| class.node.children()).filter(named) {
            reading.see(child);
            reading.text(child, name);
        }
        if reading.text(node, name).is_some() {
            return Some(node);
        }
        let class = reading.text(node, "class").or(class);
        let known = class.and_then(|class| self.all.iter().position(|other| other.name == class));
        let mut next = known.or((!self.all.is_empty()).then_some(0));
        while let Some(index) = next {
            let Class { node, parent, .. } = &self.all[index];
            let element = node.children().find(|child| named(child) && child.attribute(name).is_some());
            if element.is_some() {
                return element;
            }
            next = *parent;
        }
        None
    }
}
