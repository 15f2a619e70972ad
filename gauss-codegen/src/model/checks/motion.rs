//! Rules between coordinates, speeds and kinematics.

use crate::model::language::context::Context;
use crate::model::language::declarations::{KinematicsClause, Names};
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, same, word};
use crate::model::names::naming::is_reserved;
use crate::model::names::places::ExpressionPlace;
use crate::model::scene::clauses::{CoordinateClause, CoordinateKind, Speed, SpeedKind};
use crate::model::scene::expression::Expression;
use proc_macro2::Ident;
use std::collections::HashSet;
use syn::ext::IdentExt;

/// Checks that a system with speeds of its own has one equation for each coordinate, and without them none.
pub fn check_kinematics(statements: &Statements, uncertain: bool, context: &mut Context) {
    let coordinates = statements.coordinates.as_ref();
    if statements.in_chart && coordinates.is_none() {
        return refuse_beside_chart(statements, context);
    }
    if !uncertain {
        refuse_half(statements, coordinates, context);
    }
    let (Some(kinematics), Some(coordinates)) = (&statements.kinematics, coordinates) else { return };
    let meant = refuse_strangers(statements, kinematics, coordinates, context);
    if kinematics.complete && statements.speeds.is_some() {
        refuse_missing(kinematics, coordinates, &meant, context);
    }
}

/// A chart alone has speeds and kinematics of its own.
fn refuse_beside_chart(statements: &Statements, context: &mut Context) {
    let speeds = statements.speeds.iter().map(|speeds| &speeds.clause);
    for clause in speeds.chain(statements.kinematics.iter().map(|kinematics| &kinematics.clause)) {
        context.error(
            clause.span(),
            format!(
                "the chart has speeds and kinematics of its own, and `{clause}` is for coordinates besides those of \
                 the chart; add `coordinates(…)` of what else moves, remove `{clause}`, or remove `chart` and `motion`"
            ),
        );
    }
}

/// Speeds and kinematics come together.
fn refuse_half(statements: &Statements, coordinates: Option<&Names<CoordinateClause>>, context: &mut Context) {
    match (&statements.speeds, &statements.kinematics) {
        (Some(speeds), None) => {
            let equations: Vec<String> = coordinates.iter().flat_map(|names| &names.names).map(equation).collect();
            let equations = if equations.is_empty() { "x = …".into() } else { equations.join(", ") };
            context.error(
                speeds.clause.span(),
                format!("`speeds` do not say how the coordinates change; add `kinematics({equations})`"),
            );
        }
        (None, Some(kinematics)) => context.error(
            kinematics.clause.span(),
            "`kinematics` needs `speeds`, which it expresses the rates of the coordinates in; \
             add `speeds(…)`, or remove `kinematics` to have these rates for speeds",
        ),
        (None, None) | (Some(_), Some(_)) => {}
    }
}

/// Each equation is that of a coordinate, and the only one of it. Gives back the coordinates that misspelt ones mean.
fn refuse_strangers(
    statements: &Statements,
    kinematics: &KinematicsClause,
    coordinates: &Names<CoordinateClause>,
    context: &mut Context,
) -> Vec<String> {
    let table: Vec<(String, ())> = coordinates.names.iter().map(|name| (name.ident.unraw().to_string(), ())).collect();
    let table: Vec<(&str, ())> = table.iter().map(|(name, ())| (name.as_str(), ())).collect();
    let mut meant: Vec<String> = Vec::new();
    for (index, (name, _)) in kinematics.rates.iter().enumerate() {
        let word = name.unraw().to_string();
        if kinematics.rates[..index].iter().any(|(earlier, _)| same(earlier, name)) {
            context.error(name.span(), format!("`{word}` has kinematics twice; keep one of the two"));
            continue;
        }
        if table.iter().any(|(known, ())| *known == word) {
            continue;
        }
        let is_speed = statements.speeds.iter().flat_map(|speeds| &speeds.names).any(|speed| same(&speed.ident, name));
        // Between single letters every name is near; a speed is no misspelt coordinate.
        let near = if is_speed || word.chars().count() == 1 { None } else { words::nearest(&word, &table) };
        meant.extend(near.map(|(near, ())| near.to_owned()));
        if coordinates.complete {
            let problem = if is_speed { "is a speed, not a coordinate" } else { "is no coordinate" };
            let remedy = match near {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None if table.is_empty() => "add it to `coordinates(…)`".into(),
                None => format!("expected {}", words::list(&table)),
            };
            context.error(name.span(), format!("`{word}` {problem}; {remedy}"));
        }
    }
    meant
}

/// Each coordinate has an equation, but those that misspelt ones mean.
fn refuse_missing(
    kinematics: &KinematicsClause,
    coordinates: &Names<CoordinateClause>,
    meant: &[String],
    context: &mut Context,
) {
    for (index, coordinate) in coordinates.names.iter().enumerate() {
        let CoordinateClause { ident, .. } = coordinate;
        let word = ident.unraw().to_string();
        // A name that must change, or go, needs no kinematics yet.
        let refused =
            is_reserved(&word) || coordinates.names[..index].iter().any(|earlier| same(&earlier.ident, ident));
        if !refused && !kinematics.rates.iter().any(|(name, _)| same(name, ident)) && !meant.contains(&word) {
            let equation = equation(coordinate);
            context.error(
                ident.span(),
                format!("the coordinate `{word}` has no kinematics; add `{equation}` to `kinematics(…)`"),
            );
        }
    }
}

/// Speeds that no rate depends on, and coordinates that no mass depends on, have no equation of motion: A of (3.4) is
/// singular. What this sees in the names alone is said here; the rest shows when A is formed.
///
/// What is named as a whole, or in any part, counts as named; `all` is every expression with its place.
pub fn check_dependence(statements: &Statements, all: &[(ExpressionPlace, &Expression)], context: &mut Context) {
    let Some(coordinates) = &statements.coordinates else { return };
    let named = |at: &dyn Fn(ExpressionPlace) -> bool| {
        let mut names = HashSet::new();
        all.iter().filter(|(place, _)| at(*place)).for_each(|(_, expression)| expression.put_names(&mut names));
        names
    };
    match &statements.speeds {
        Some(speeds) => {
            let named = named(&|place: ExpressionPlace| matches!(place, ExpressionPlace::Kinematics(_)));
            for Speed { ident, .. } in speeds.names.iter().filter(|speed| !named.contains(&word(&speed.ident))) {
                context.error(
                    ident.span(),
                    format!(
                        "no velocity depends on the speed `{ident}`, so nothing determines its rate; \
                         name it in `kinematics(…)` or remove it"
                    ),
                );
            }
            let dimension: usize = coordinates.names.iter().map(|coordinate| coordinate.kind.dimension()).sum();
            let mut count = 0;
            let mut excess = None;
            for speed in &speeds.names {
                count += speed.kind.dimension();
                excess = excess.or((count > dimension).then_some(&speed.ident));
            }
            if let Some(excess) = excess {
                // Poses and rotations have as many rates as they have degrees of freedom.
                let scalar = coordinates.names.iter().all(|coordinate| coordinate.kind == CoordinateKind::Scalar);
                let what = if scalar { "coordinates" } else { "degrees of freedom of the coordinates" };
                context.error(
                    excess.span(),
                    format!(
                        "there are more speeds ({count}) than {what} ({dimension}), so the velocities do not \
                         determine them; remove {}",
                        count - dimension
                    ),
                );
            }
        }
        None => {
            let named = named(&is_motion);
            let geared = statements.armatures.iter().map(|(name, _)| word(name));
            let heavy: HashSet<String> = statements.modal_coordinates().map(word).chain(geared).collect();
            let idle = |ident: &Ident| !named.contains(&word(ident)) && !heavy.contains(&word(ident));
            for CoordinateClause { ident, .. } in coordinates.names.iter().filter(|name| idle(&name.ident)) {
                context.error(
                    ident.span(),
                    format!(
                        "no position and no rotation depends on the coordinate `{ident}`, so nothing determines its \
                         acceleration; name it in one of them, give it an `armature`, or remove it"
                    ),
                );
            }
        }
    }
}

/// The expression places matter, or constrains it.
fn is_motion(place: ExpressionPlace) -> bool {
    use ExpressionPlace::{Constraint, Particle, Position, Rotation};
    matches!(place, Position | Rotation | Particle { .. } | Constraint(_))
}

/// The form of a coordinate's kinematics.
fn equation(coordinate: &CoordinateClause) -> String {
    let rate = match coordinate.kind {
        CoordinateKind::Scalar | CoordinateKind::Rotation => "…",
        CoordinateKind::Pose => "twist(…, …)",
    };
    format!("{} = {rate}", coordinate.ident.unraw())
}

impl CoordinateKind {
    /// Number of its independent rates.
    fn dimension(self) -> usize {
        match self {
            CoordinateKind::Scalar => 1,
            CoordinateKind::Pose => 6,
            CoordinateKind::Rotation => 3,
        }
    }
}

impl SpeedKind {
    /// Number of its components.
    pub fn dimension(self) -> usize {
        match self {
            SpeedKind::Scalar => 1,
            SpeedKind::Vector => 3,
        }
    }
}
