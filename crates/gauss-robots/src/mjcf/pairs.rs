//! Pairs of geoms that touch because the file says so.

use roxmltree::Node;

use super::File;
use crate::collision::{Collision, Pair, Touch};
use crate::names::unknown;

const PAIR: &[&str] = &["pair"];

/// Why a pair is not read.
const TWO_FRICTIONS: &str = "its friction differs along both tangents, whose directions are MuJoCo's own";

impl<'a> File<'a> {
    /// Reads the pairs that touch by themselves, and those that do not, once all geoms are known; nothing where
    /// contacts are switched off.
    pub fn contacts(&mut self, root: Node<'a, 'a>) {
        for section in self.reading.children(root, "contact") {
            self.exclusions(section);
            self.pairs(section);
        }
        if self.disabled.contacts {
            self.description.collisions.clear();
            self.description.pairs.clear();
        }
    }

    /// `<pair geom1="…" geom2="…"/>`. What it does not say is as MuJoCo has it (`mjs_defaultPair` of
    /// `src/user/user_init.c`), not as its geoms have it.
    fn pairs(&mut self, section: Node<'a, 'a>) {
        for node in self.reading.children(section, "pair") {
            let names = ["geom1", "geom2"].map(|name| self.reading.required(node, name));
            let shapes = names.map(|name| name.map(|name| self.shape_called(&name)));
            if let Some(which) = shapes.iter().flatten().find_map(|shape| shape.as_ref().err()) {
                self.reading.fault(node, format!("it is about {which}"));
            }
            let dimension = self.whole(node, PAIR, "condim", None).unwrap_or(3);
            if !matches!(dimension, 1 | 3 | 4 | 6) {
                self.reading.fault(node, format!("`condim` is 1, 3, 4 or 6, found `{dimension}`"));
            }
            let own = self.list(node, PAIR, "friction", None).unwrap_or_default();
            if own.len() > 5 || own.iter().any(|coefficient| *coefficient < 0.0) {
                self.reading.fault(node, "`friction` is five numbers at most, which are zero or more");
            }
            let friction = own.first().copied().unwrap_or(1.0);
            let is_read = dimension == 1 || own.get(1).is_none_or(|second| *second == friction);
            if !is_read {
                self.ignored(node, &format!("{TWO_FRICTIONS}: these two do not touch"));
            }
            let mut unread = Vec::new();
            for name in ["margin", "gap", "adhesion"] {
                let acts = self.list(node, PAIR, name, None).unwrap_or_default().iter().any(|number| *number != 0.0);
                unread.extend(acts.then_some(name));
            }
            let friction = if dimension > 1 { friction } else { 0.0 };
            let touch = if is_read { Ok(Touch { friction, turns: dimension > 3 }) } else { Err(TWO_FRICTIONS) };
            if let [Some(Ok(first)), Some(Ok(second))] = shapes {
                let at = self.reading.at(node);
                self.description.pairs.push(Pair { at, shapes: [first, second], touch, unread });
            }
        }
    }

    /// A geom by its name, or which name that is.
    fn shape_called(&self, name: &str) -> Result<Collision, String> {
        let all = || self.description.collisions.iter().chain(&self.description.hidden);
        let found = all().find(|own| own.name.as_deref() == Some(name)).cloned();
        found.ok_or_else(|| unknown("geom", name, all().filter_map(|own| own.name.as_deref())))
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use crate::collision::Touch;
    use crate::description::{Description, Fault};
    use crate::mjcf::read;
    use crate::text::{Text, Written};

    fn described(pair: &str) -> Result<Description, Vec<Fault>> {
        let text = format!(
            r#"<mujoco><default><pair condim="6"/><default class="c"><pair friction="0.3"/></default></default>
            <worldbody><body name="a"><joint/><geom name="f" size="1" friction="0.5"/></body>
            <body name="b"><joint/><geom name="g" size="2" contype="0" conaffinity="0" mass="1"/></body></worldbody>
            <contact><pair {pair}/></contact></mujoco>"#
        );
        read(&Text::of(Written::new(String::new(), PathBuf::new(), text)))
    }

    #[test]
    fn pairs_say_all_themselves() {
        let touch =
            |more: &str| described(&format!(r#"geom1="g" geom2="f" {more}"#)).unwrap().pairs.remove(0).touch.unwrap();
        assert_eq!(touch(""), Touch { friction: 1.0, turns: true });
        assert_eq!(touch(r#"class="c" condim="3""#), Touch { friction: 0.3, turns: false });
        assert_eq!(touch(r#"condim="1" friction="0.2 0.4""#), Touch { friction: 0.0, turns: false });
        let read = described(r#"geom1="g" geom2="f" margin="0.1" gap="0""#).unwrap();
        let pair = &read.pairs[0];
        assert_eq!(pair.shapes.each_ref().map(|own| own.link.as_str()), ["b", "a"]);
        assert_eq!(pair.unread, ["margin"]);
        // The one that is only seen touches by the pair alone.
        assert_eq!((read.collisions.len(), read.hidden.len()), (1, 1));
    }

    #[test]
    fn what_is_refused() {
        let message = |pair: &str| described(pair).unwrap_err()[0].message.clone();
        assert!(message(r#"geom1="g""#).contains("the attribute `geom2` is missing"));
        assert!(message(r#"geom1="g" geom2="h""#).contains("it is about `h`, which is no geom"));
        assert!(message(r#"geom1="g" geom2="f" condim="2""#).contains("`condim` is 1, 3, 4 or 6, found `2`"));
        let read = described(r#"geom1="g" geom2="f" friction="0.2 0.4""#).unwrap();
        // Nor do they touch by their own bits.
        assert!(
            read.pairs[0].touch.is_err() && read.notes.iter().any(|note| note.text.contains("along both tangents"))
        );
    }
}
