//! Classes of defaults: where an attribute is written that an element does not have itself.

use roxmltree::Node;

use crate::names::unknown;
use crate::xml::{Reading, own_descendants};

/// The class of elements that name none.
const MAIN: &str = "main";

/// A class of defaults.
struct Class<'a> {
    /// The class that it is in, with how many elements of that it began with: what comes there later is not its own.
    parent: Option<(usize, usize)>,
    /// Elements that set defaults, in their order.
    elements: Vec<Node<'a, 'a>>,
}

/// All of them; the first is that of elements without a class.
pub struct Classes<'a> {
    all: Vec<Class<'a>>,
    /// Names of the classes, with their indices.
    names: Vec<(&'a str, usize)>,
}

impl<'a> Classes<'a> {
    /// Every `<default>` in the root adds to one class, `main`, in the order of the file. A class in it begins with
    /// what that is then, as MuJoCo's `mjXReader::Default` has it: elements of a `<default>` come before the classes in
    /// it.
    pub fn read(root: Node<'a, 'a>, reading: &mut Reading<'a>) -> Self {
        let main = Class { parent: None, elements: Vec::new() };
        let mut classes = Self { all: vec![main], names: vec![(MAIN, 0)] };
        for node in reading.children(root, "default") {
            // Before version 4 the root could be called otherwise.
            let name = reading.text(node, "class").filter(|name| *name != MAIN);
            classes.names.extend(name.map(|name| (name, 0)));
            classes.add(node, 0, reading);
        }
        classes
    }

    /// Adds the elements of a `<default>` to a class.
    fn add(&mut self, node: Node<'a, 'a>, index: usize, reading: &mut Reading<'a>) {
        let is_class = |child: &Node<'a, 'a>| child.tag_name().name() == "default";
        let (inner, own): (Vec<_>, Vec<_>) = reading.elements(node).into_iter().partition(is_class);
        self.all[index].elements.extend(own);
        for child in inner {
            let Some(name) = reading.text(child, "class").filter(|name| !name.is_empty()) else {
                reading.fault(child, "a class in another has a name; write `class=\"…\"`");
                continue;
            };
            if self.names.iter().any(|(known, _)| *known == name) {
                reading.fault(child, format!("a second class is called `{name}`"));
            }
            let new = self.all.len();
            let parent = Some((index, self.all[index].elements.len()));
            self.all.push(Class { parent, elements: Vec::new() });
            self.names.push((name, new));
            self.add(child, new, reading);
        }
    }

    /// A class that an element names is one of the file; `main` is there always.
    pub fn refuse_strange(&self, root: Node<'a, 'a>, reading: &mut Reading<'a>) {
        for node in own_descendants(root).filter(|node| !node.has_tag_name("default")) {
            for name in ["class", "childclass"] {
                let Some(class) = node.attribute(name).map(str::trim) else { continue };
                if !self.names.iter().any(|(known, _)| *known == class) {
                    let which = unknown("class", class, self.names.iter().map(|(known, _)| *known));
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
        self.nearest((node, tags), class, reading).find(|element| element.attribute(name).is_some())
    }

    /// An element, then what sets defaults of it, the nearest first: of the same default the last.
    pub fn nearest(
        &self,
        (node, tags): (Node<'a, 'a>, &[&str]),
        class: Option<&str>,
        reading: &Reading<'a>,
    ) -> impl Iterator<Item = Node<'a, 'a>> {
        let class = reading.text(node, "class").or(class);
        let known = class.and_then(|class| self.names.iter().find(|(name, _)| *name == class));
        let first = known.map_or(0, |(_, index)| *index);
        let whole = Some((first, self.all[first].elements.len()));
        let chain = std::iter::successors(whole, |(index, _)| self.all[*index].parent);
        let defaults = chain.flat_map(|(index, count)| self.all[index].elements[..count].iter().rev().copied());
        [node].into_iter().chain(defaults.filter(|element| tags.contains(&element.tag_name().name())))
    }
}
