//! Limbs of a tree that are alike: bodies that hang on one another by the same expressions, but for numbers and for
//! what coordinates are called. They are found by their clauses, not by their names.
//!
//! Mirrored limbs differ in the signs of numbers, and what is computed of them would differ in where it adds and where
//! it subtracts. So a number that is not the same in all of them is a constant of its own in each ([`Twin`]).

use std::collections::HashMap;

use proc_macro2::Ident;

use super::clauses::{BodyClause, Coefficients, CoordinateClause, CoordinateKind, RoleValue};
use super::expression::{Expression, ExpressionKind};
use crate::algebra::Rational;
use crate::terms::Twin;

/// Joints that a limb has at least: what is computed of shorter ones is little.
const JOINTS: usize = 3;

/// Limbs that are computed together at most: lanes of a vector.
const TOGETHER: usize = 4;

/// Limbs that are alike.
#[derive(Clone, Default)]
pub struct Limbs {
    /// Coordinates, and what they are.
    pub coordinates: Vec<(Ident, Twin)>,
    /// Number of slots of their numbers and coordinates.
    slots: usize,
    limbs: usize,
}

/// Limbs that may turn out to be alike: for each of their bodies those of all limbs, limb by limb.
#[derive(Default)]
struct LimbCandidates {
    bodies: Vec<Vec<usize>>,
    coordinates: Vec<Vec<Ident>>,
}

impl Limbs {
    /// Finds the limbs of a tree, whose numbers become twins where they differ.
    pub fn found(bodies: &mut [BodyClause], coordinates: &[CoordinateClause]) -> Self {
        let mut limbs = Self::default();
        if coordinates.len() < 2 * JOINTS {
            return limbs;
        }
        let mut children: HashMap<String, Vec<usize>> = HashMap::new();
        let mut roots = Vec::new();
        for (k, body) in bodies.iter().enumerate() {
            match &body.parent {
                Some(parent) => children.entry(parent.to_string()).or_default().push(k),
                None => roots.push(k),
            }
        }
        let tree = LimbTree { bodies, coordinates, children: &children };
        let mut all = Vec::new();
        roots.iter().for_each(|&root| tree.limbs_below(root, &mut all));
        for found in &all {
            limbs.add(found, bodies);
        }
        limbs
    }

    fn add(&mut self, found: &LimbCandidates, bodies: &mut [BodyClause]) {
        let first = self.limbs;
        self.limbs += found.coordinates.first().map_or(0, Vec::len);
        for names in &found.coordinates {
            let slot = self.slots;
            self.slots += 1;
            let own = names.iter().enumerate().map(|(limb, name)| (name.clone(), Twin { slot, limb: first + limb }));
            self.coordinates.extend(own);
        }
        let mut slots: HashMap<Vec<Rational>, usize> = HashMap::new();
        for alike in &found.bodies {
            let each: Vec<Vec<Rational>> = alike.iter().map(|&k| numbers(&mut bodies[k])).collect();
            for (limb, &body) in alike.iter().enumerate() {
                let mut number = 0;
                each_number(&mut bodies[body], &mut |e| {
                    let values: Vec<Rational> = each.iter().map(|own| own[number]).collect();
                    number += 1;
                    if values[0].is_zero() {
                        return;
                    }
                    // Up to sign: the first of them is positive.
                    let negative = values[0].is_negative();
                    let signed = |value: Rational| if negative { -value } else { value };
                    let slot = *slots.entry(values.iter().copied().map(signed).collect()).or_insert_with(|| {
                        self.slots += 1;
                        self.slots - 1
                    });
                    let twin = Some(Twin { slot, limb: first + limb });
                    let own = ExpressionKind::Number { value: signed(values[limb]), twin };
                    let own = Expression { kind: own, span: e.span };
                    let kind = if negative { ExpressionKind::Negate(Box::new(own)) } else { own.kind };
                    e.kind = kind;
                });
            }
        }
    }
}

struct LimbTree<'a> {
    bodies: &'a [BodyClause],
    coordinates: &'a [CoordinateClause],
    children: &'a HashMap<String, Vec<usize>>,
}

impl LimbTree<'_> {
    fn children(&self, body: usize) -> &[usize] {
        let name = self.bodies[body].name.as_ref();
        name.and_then(|name| self.children.get(&name.to_string())).map_or(&[], Vec::as_slice)
    }

    /// Limbs that hang on a body, or farther out. What hangs on limbs that are alike is part of them.
    fn limbs_below(&self, root: usize, all: &mut Vec<LimbCandidates>) {
        let mut open = vec![root];
        while let Some(body) = open.pop() {
            let mut left: Vec<usize> = self.children(body).to_vec();
            while let Some(&first) = left.first() {
                let is_alike = |other: &usize| self.coordinates_of(&[first, *other]).is_some();
                let others = left[1..].iter().copied().filter(is_alike).take(TOGETHER - 1);
                let limbs: Vec<usize> = std::iter::once(first).chain(others).collect();
                let found = self.found(limbs.clone());
                if found.coordinates.len() < JOINTS {
                    open.push(first);
                    left.remove(0);
                } else {
                    left.retain(|other| !limbs.contains(other));
                    all.push(found);
                }
            }
        }
    }

    /// Finds the parts of these limbs that are alike, joint by joint outward.
    fn found(&self, limbs: Vec<usize>) -> LimbCandidates {
        let mut found = LimbCandidates::default();
        let mut open = vec![limbs];
        while let Some(alike) = open.pop() {
            let Some(coordinates) = self.coordinates_of(&alike).filter(|_| alike.len() > 1) else { continue };
            let mut taken: Vec<Vec<usize>> = Vec::new();
            for &child in self.children(alike[0]) {
                let mut group = vec![child];
                for &other in &alike[1..] {
                    let is_free = |k: &usize| !taken.iter().flatten().any(|taken| taken == k);
                    let twin = self.children(other).iter().copied().filter(is_free);
                    group.extend(twin.filter(|&k| self.coordinates_of(&[child, k]).is_some()).take(1));
                }
                if group.len() == alike.len() && self.coordinates_of(&group).is_some() {
                    taken.push(group);
                }
            }
            open.extend(taken);
            // Joints may follow one another.
            let new = coordinates.into_iter().filter(|names| !found.coordinates.contains(names)).collect::<Vec<_>>();
            found.coordinates.extend(new);
            found.bodies.push(alike);
        }
        found
    }

    /// Coordinates that correspond to one another in bodies whose clauses are alike; none where these are not.
    fn coordinates_of(&self, alike: &[usize]) -> Option<Vec<Vec<Ident>>> {
        let each: Vec<Vec<&Expression>> = alike.iter().map(|&k| expressions(&self.bodies[k])).collect::<Option<_>>()?;
        let said = |k: usize| {
            let body = &self.bodies[k];
            let roles: Vec<_> = body.role_clauses.iter().map(|clause| clause.role).collect();
            (body.massless, body.position.is_some(), body.rotation.is_some(), roles)
        };
        let same = alike.iter().all(|&k| said(k) == said(alike[0])) && each.iter().all(|e| e.len() == each[0].len());
        let mut names = Vec::new();
        let are_alike = same
            && (0..each[0].len()).all(|e| {
                let turned = self.bodies[alike[0]].rotation.as_ref().is_some_and(|own| std::ptr::eq(own, each[0][e]));
                self.are_alike(&each.iter().map(|own| own[e]).collect::<Vec<_>>(), turned, &mut names)
            });
        are_alike.then_some(names)
    }

    /// Whether expressions are alike: numbers may differ where they are not zero and turn nothing.
    fn are_alike(&self, all: &[&Expression], turn: bool, names: &mut Vec<Vec<Ident>>) -> bool {
        let numbers: Vec<Option<Rational>> = all.iter().map(|e| e.number()).collect();
        if numbers.iter().any(Option::is_some) {
            let zero = |number: &Option<Rational>| number.is_none_or(|number| number.is_zero());
            let equal = numbers.iter().all(|number| *number == numbers[0]);
            return equal || !(turn || numbers.iter().any(zero));
        }
        if let ExpressionKind::Name(first) = &all[0].kind {
            let own =
                all.iter().map(|e| if let ExpressionKind::Name(name) = &e.kind { Some(name.clone()) } else { None });
            let Some(own) = own.collect::<Option<Vec<Ident>>>() else { return false };
            if own.iter().all(|name| name == first) {
                return !self.is_coordinate(first);
            }
            let distinct = (1..own.len()).all(|k| !own[..k].contains(&own[k]));
            let coordinates = own.iter().all(|name| self.is_coordinate(name));
            if distinct && coordinates && !names.contains(&own) {
                names.push(own);
            }
            return distinct && coordinates;
        }
        let word = |e: &Expression| match &e.kind {
            ExpressionKind::Binary(operator, ..) => format!("{operator:?}"),
            ExpressionKind::Call(function, arguments) => format!("{function:?} {}", arguments.len()),
            ExpressionKind::Power(_, exponent) => format!("power {exponent}"),
            ExpressionKind::Negate(_) => "negative".to_owned(),
            ExpressionKind::Vector(_) => "vector".to_owned(),
            _ => String::new(),
        };
        let first = word(all[0]);
        if first.is_empty() || !all.iter().all(|e| word(e) == first) {
            return false;
        }
        let parts: Vec<Vec<&Expression>> = all.iter().map(|e| parts(e)).collect();
        (0..parts[0].len()).all(|k| self.are_alike(&parts.iter().map(|own| own[k]).collect::<Vec<_>>(), turn, names))
    }

    fn is_coordinate(&self, name: &Ident) -> bool {
        self.coordinates.iter().any(|q| q.ident == *name && q.kind == CoordinateKind::Scalar)
    }
}

fn parts(e: &Expression) -> Vec<&Expression> {
    match &e.kind {
        ExpressionKind::Negate(inner) | ExpressionKind::Power(inner, _) => vec![inner],
        ExpressionKind::Binary(_, a, b) => vec![a, b],
        ExpressionKind::Call(_, arguments) => arguments.iter().collect(),
        ExpressionKind::Vector(components) => components.iter().map(|component| &**component).collect(),
        _ => Vec::new(),
    }
}

/// Place and mass data of a body; none where a field has them.
fn expressions(body: &BodyClause) -> Option<Vec<&Expression>> {
    if !body.massless && !body.has_matter() {
        return None;
    }
    let mut all: Vec<&Expression> = body.position.iter().chain(&body.rotation).collect();
    for clause in &body.role_clauses {
        match &clause.value {
            RoleValue::Expression(e) => all.push(e),
            RoleValue::Coefficients(Coefficients::Diagonal(entries)) => all.extend(entries.iter().map(|e| &**e)),
            RoleValue::Coefficients(Coefficients::Field(_)) => return None,
        }
    }
    Some(all)
}

/// The numbers of a body, but for those of its rotation, in order.
fn each_number(body: &mut BodyClause, change: &mut dyn FnMut(&mut Expression)) {
    body.position.iter_mut().for_each(|e| each_number_of(e, change));
    for clause in &mut body.role_clauses {
        match &mut clause.value {
            RoleValue::Expression(e) => each_number_of(e, change),
            RoleValue::Coefficients(all) => all.each_expression(&mut |e| each_number_of(e, change)),
        }
    }
}

fn each_number_of(e: &mut Expression, change: &mut dyn FnMut(&mut Expression)) {
    match e.number() {
        Some(_) => change(e),
        None => e.each_part(&mut |part| each_number_of(part, change)),
    }
}

fn numbers(body: &mut BodyClause) -> Vec<Rational> {
    let mut all = Vec::new();
    each_number(body, &mut |e| all.extend(e.number()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Model, parse};

    /// A base with limbs of hinges: of each the axis of its last hinge, and the sides that its numbers are on.
    fn model(limbs: &[(&str, &str, f64)], joints: usize) -> Model {
        let (mut names, mut bodies) = (vec!["base".to_owned()], String::new());
        for (limb, axis, side) in limbs {
            let mut parent = "trunk".to_owned();
            for k in 0..joints {
                let name = format!("{limb}{k}");
                let turn = if k + 1 == joints { axis } else { "x" };
                bodies += &format!(
                    ", body({name}_link, parent = {parent}, position = [0.25, {y}, 0], rotation = rotation_{turn}({name}), \
                     mass = 1.5, center_of_mass = [0, {c}, 0.1], inertia_about_center_of_mass = 0.01)",
                    y = side * 0.5,
                    c = side * 0.04,
                );
                names.push(name.clone());
                parent = format!("{name}_link");
            }
        }
        let source = format!(
            "#[gauss(coordinates(base: Pose, {}), body(trunk, position = base.position, rotation = base.rotation, \
             mass = 9, inertia_about_center_of_mass = 0.3){bodies})] struct Robot {{ #[gauss(gravity)] g: f64 }}",
            names[1..].join(", ")
        );
        parse(&syn::parse_str(&source).expect("the snippet is Rust")).expect("a robot")
    }

    fn of(model: &Model) -> Vec<(String, usize)> {
        model.limbs.coordinates.iter().map(|(name, twin)| (name.to_string(), twin.limb)).collect()
    }

    #[test]
    fn mirrored_limbs_are_alike_whatever_they_are_called() {
        let found = of(&model(&[("port", "y", 1.0), ("other", "y", -1.0)], 3));
        let own = |limb: &str, number: usize| (0..3).map(move |k| (format!("{limb}{k}"), number)).collect::<Vec<_>>();
        let mut expected = [own("port", 0), own("other", 1)].concat();
        expected.sort();
        let mut sorted = found.clone();
        sorted.sort();
        assert_eq!(sorted, expected);
        // Joint by joint.
        for pair in found.chunks(2) {
            assert_eq!(pair[0].0.trim_start_matches("port"), pair[1].0.trim_start_matches("other"));
        }
    }

    #[test]
    fn numbers_of_mirrored_limbs_are_one_slot_up_to_sign() {
        let model = model(&[("left", "y", 1.0), ("right", "y", -1.0)], 3);
        let mut twins = Vec::new();
        for body in &model.bodies {
            each_number(&mut body.clone(), &mut |e| {
                e.walk(&mut |part| {
                    if let ExpressionKind::Number { value, twin: Some(twin) } = &part.kind {
                        twins.push((value.to_f64(), *twin));
                    }
                });
            });
        }
        let lateral: Vec<_> = twins.iter().filter(|(value, _)| value.abs() == 0.5).collect();
        assert_eq!(lateral.len(), 6);
        assert!(lateral.iter().all(|(_, twin)| twin.slot == lateral[0].1.slot), "{lateral:?}");
        assert!(lateral.iter().all(|(value, twin)| (*value > 0.0) == (twin.limb == 0)), "{lateral:?}");
    }

    #[test]
    fn limbs_that_differ_or_are_short_are_not_alike() {
        // The last hinge turns about another axis, and what is left is too short.
        assert_eq!(of(&model(&[("left", "y", 1.0), ("right", "z", -1.0)], 3)), []);
        assert_eq!(of(&model(&[("left", "y", 1.0), ("right", "y", -1.0)], 2)), []);
        // A number is zero in one of them alone.
        assert_eq!(of(&model(&[("left", "y", 1.0), ("right", "y", 0.0)], 3)), []);
    }

    #[test]
    fn one_more_joint_at_the_end_does_not_matter() {
        let found = of(&model(&[("left", "y", 1.0), ("right", "z", -1.0)], 4));
        assert_eq!(found.len(), 6);
        assert!(found.iter().all(|(name, _)| !name.ends_with('3')), "{found:?}");
    }

    #[test]
    fn five_limbs_are_four_and_one() {
        let limbs = ["a", "b", "c", "d", "e"].map(|name| (name, "y", 1.0));
        let found = of(&model(&limbs, 3));
        assert_eq!(found.len(), 12);
        assert!(found.iter().all(|(_, limb)| *limb < 4), "{found:?}");
    }
}
