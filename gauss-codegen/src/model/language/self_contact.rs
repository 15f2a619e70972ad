//! `self_contact(links = […], friction = mu, along = […], restitution = e)`: links of a robot's file that touch each
//! other.

use super::arguments::{self, known};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::ground;
use super::words::Table;
use crate::model::scene::expression::Expression;
use proc_macro2::{Ident, Span};

const SELF_CONTACT: &Table<()> = &[("links", ()), ("along", ()), ("friction", ()), ("restitution", ())];

/// Which links touch each other, and how.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub struct SelfContact {
    /// The word `self_contact`.
    pub span: Span,
    /// Links that touch, if not all.
    pub links: Option<Vec<Ident>>,
    /// A direction that no line of centers has.
    pub along: Option<Expression>,
    /// One coefficient; that of the file where it is not given.
    pub friction: Option<Expression>,
    pub restitution: Option<Expression>,
}

/// `None` if something is wrong, which is noted.
pub fn read(clause: &Clause, context: &mut Context) -> Option<SelfContact> {
    let span = clause.name.span();
    let mut read = SelfContact { span, links: None, along: None, friction: None, restitution: None };
    let earlier = context.count();
    let arguments = match &clause.value {
        Content::Absent => Vec::new(),
        Content::Malformed => return None,
        Content::Brackets(group) => {
            let owner = Owner::Action { word: "self_contact", example: "an argument such as `friction = mu`" };
            arguments::arguments(group, owner, context).0
        }
        Content::Equals(tokens) => {
            let span = tokens.first().map_or(span, attributes::start);
            let text = "`self_contact` takes brackets, not `=`; write `self_contact(links = [left_hand, trunk])`, or \
                        `self_contact` alone";
            context.error(span, text);
            return None;
        }
    };
    let mut given = Vec::new();
    for argument in &arguments {
        if !known(argument, "self_contact", SELF_CONTACT, &mut given, context) {
            continue;
        }
        match argument.word().as_str() {
            "links" => read.links = ground::links(argument, context),
            "along" => read.along = arguments::value(argument, "[0, 0, 1]", context),
            "friction" => read.friction = arguments::value(argument, "mu", context),
            _ => read.restitution = arguments::value(argument, "e", context),
        }
    }
    (context.count() == earlier).then_some(read)
}
