//! `ground(friction = mu, restitution = e, …)`: a plane that the shapes of a robot's file touch.

use super::arguments::{self, equals, known};
use super::arithmetic;
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::words::Table;
use crate::model::scene::expression::Expression;
use proc_macro2::{Delimiter, Ident, Span, TokenTree};

const GROUND: &Table<()> = &[
    ("links", ()),
    ("plane", ()),
    ("height", ()),
    ("along", ()),
    ("friction", ()),
    ("restitution", ()),
    ("cylinders", ()),
];
const LINKS: &str = "[left_foot, right_foot]";

/// A plane, and what touches it.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub struct Ground {
    /// The word `ground`.
    pub span: Span,
    /// Links that touch, if not all.
    pub links: Option<Vec<Ident>>,
    /// As of `contact(…)`; without it and `height` the planes of the file, if there are some.
    pub normal: Option<Expression>,
    pub height: Option<Expression>,
    pub along: Option<Expression>,
    /// One coefficient for each tangent; none where it is not given.
    pub friction: Vec<Expression>,
    pub restitution: Option<Expression>,
    /// Points on each rim of a cylinder, which stand for it.
    pub points: Option<u32>,
}

/// `None` if something is wrong, which is noted.
pub fn read(clause: &Clause, context: &mut Context) -> Option<Ground> {
    let mut ground = Ground {
        span: clause.name.span(),
        links: None,
        normal: None,
        height: None,
        along: None,
        friction: Vec::new(),
        restitution: None,
        points: None,
    };
    let earlier = context.count();
    let arguments = match &clause.value {
        Content::Absent => Vec::new(),
        Content::Malformed => return None,
        Content::Brackets(group) => {
            let owner = Owner::Action { word: "ground", example: "an argument such as `friction = mu`" };
            arguments::arguments(group, owner, context).0
        }
        Content::Equals(tokens) => {
            let span = tokens.first().map_or(ground.span, attributes::start);
            context.error(span, "`ground` takes brackets, not `=`; write `ground(friction = mu)`, or `ground` alone");
            return None;
        }
    };
    let mut given = Vec::new();
    for argument in &arguments {
        if known(argument, "ground", GROUND, &mut given, context) {
            ground.take(argument, context);
        }
    }
    (context.count() == earlier).then_some(ground)
}

impl Ground {
    fn take(&mut self, argument: &Clause, context: &mut Context) {
        let mut value = |example: &str| arguments::value(argument, example, context);
        match argument.word().as_str() {
            "plane" => self.normal = value("[0, 0, 1]"),
            "height" => self.height = value("h"),
            "along" => self.along = value("[1, 0, 0]"),
            "restitution" => self.restitution = value("e"),
            "friction" => self.friction = coefficients(argument, context).unwrap_or_default(),
            "links" => self.links = links(argument, context),
            _ => self.points = points(argument, context),
        }
    }
}

fn coefficients(argument: &Clause, context: &mut Context) -> Option<Vec<Expression>> {
    let wording = ("scalar or two, one for each tangent", ["mu", "[mu, nu]"]);
    arithmetic::read_one_or_two("friction", wording, equals(argument, "mu", context)?, context)
}

/// Names in brackets.
pub(super) fn links(argument: &Clause, context: &mut Context) -> Option<Vec<Ident>> {
    let tokens = attributes::flat(equals(argument, LINKS, context)?.to_vec().into_iter().collect());
    let names: Option<Vec<Ident>> = match tokens.as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => {
            let pieces = attributes::pieces(group.stream(), "the name of a link", context);
            let name = |piece: &Vec<TokenTree>| match piece.as_slice() {
                [TokenTree::Ident(name)] => Some(name.clone()),
                _ => None,
            };
            pieces.iter().map(name).collect()
        }
        _ => None,
    };
    let names = names.filter(|names| !names.is_empty());
    if names.is_none() {
        let span = tokens.first().map_or(argument.name.span(), attributes::start);
        context.error(span, format!("`links` is names of links of the file in brackets; write `links = {LINKS}`"));
    }
    names
}

/// The word `rims`, or how many points stand for a rim.
fn points(argument: &Clause, context: &mut Context) -> Option<u32> {
    const FEWEST: u32 = 3;
    const MOST: u32 = 64;
    let tokens = attributes::flat(equals(argument, "8", context)?.to_vec().into_iter().collect());
    let number = match tokens.as_slice() {
        [TokenTree::Ident(word)] if word == "rims" => return None,
        [TokenTree::Literal(literal)] => literal.to_string().parse::<u32>().ok(),
        _ => None,
    };
    let number = number.filter(|number| (FEWEST..=MOST).contains(number));
    if number.is_none() {
        let span = tokens.first().map_or(argument.name.span(), attributes::start);
        context.error(
            span,
            format!(
                "`cylinders` is `rims`, or how many points stand for each rim, {FEWEST} to {MOST}; write `cylinders = 8`"
            ),
        );
    }
    number
}
