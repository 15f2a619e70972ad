//! Classes of defaults: where an attribute is written that an element does not have itself.

use roxmltree::Node;

use crate::model::robots::xml::Reading;

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
    pub fn read(root: Node<'a, 'a>) -> Self {
        let mut classes = Self { all: Vec::new() };
        for node in Reading::children(root, "default") {
            let top = if classes.all.is_empty() { None } else { Some(0) };
            classes.add(node, top);
        }
        classes
    }

    fn add(&mut self, node: Node<'a, 'a>, parent: Option<usize>) {
        let index = self.all.len();
        self.all.push(Class { name: node.attribute("class").unwrap_or("main"), parent, node });
        for child in Reading::children(node, "default") {
            self.add(child, Some(index));
        }
    }

    /// The element that has an attribute: `node`, or the nearest default of its class, or of that of the body that it
    /// is in.
    pub fn carrier(&self, node: Node<'a, 'a>, tag: &str, name: &str, class: Option<&str>) -> Option<Node<'a, 'a>> {
        if node.attribute(name).is_some() {
            return Some(node);
        }
        let class = node.attribute("class").or(class);
        let named = class.and_then(|class| self.all.iter().position(|other| other.name == class));
        let mut next = named.or((!self.all.is_empty()).then_some(0));
        while let Some(index) = next {
            let Class { node, parent, .. } = &self.all[index];
            let element =
                node.children().find(|child| child.tag_name().name() == tag && child.attribute(name).is_some());
            if element.is_some() {
                return element;
            }
            next = *parent;
        }
        None
    }
}
