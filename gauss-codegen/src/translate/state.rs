//! Parts of a state, as its author calls them: coordinates, speeds.

use proc_macro2::{Ident, Span};
use quote::format_ident;

pub use crate::description::QuantityKind;
use crate::model::{CoordinateKind, Model, SpeedKind};
use crate::terms::{BodyChart, Chart, Motion};
use crate::words::Unraw;

/// A number, a vector or an element of a group that has a name.
#[derive(Clone)]
pub struct NamedQuantity {
    pub ident: Ident,
    pub kind: QuantityKind,
    /// Description in words.
    pub label: String,
}

impl NamedQuantity {
    pub fn new(ident: Ident, kind: QuantityKind, label: impl Into<String>) -> Self {
        Self { ident, kind, label: label.into() }
    }

    /// Number of components of a vector; else 1.
    pub fn size(&self) -> usize {
        if let QuantityKind::Vector(size) = self.kind { size } else { 1 }
    }
}

/// Coordinates, with states of elements behind them, then the speeds with these indices (`None`: all), each in their
/// order. Names may be there twice.
pub(super) fn quantities(model: &Model, kept: Option<&[usize]>) -> [Vec<NamedQuantity>; 2] {
    [coordinates(model), speeds(model, kept)]
}

fn coordinates(model: &Model) -> Vec<NamedQuantity> {
    let named = |word: &str| Ident::new(word, Span::call_site());
    let mut parts = Vec::new();
    if let Some(own) = model.in_chart {
        match (own.coordinate_words(), own.motion) {
            (Some(words), _) => {
                let part =
                    |word: &String| NamedQuantity::new(named(word), QuantityKind::Scalar, "a coordinate of the chart");
                parts.extend(words.iter().map(part));
            }
            (None, Motion::Free) => {
                parts.push(NamedQuantity::new(named("pose"), QuantityKind::Pose, "R and b of the body: x̂ = R x + b"))
            }
            (None, Motion::FixedPoint) => {
                parts.push(NamedQuantity::new(named("rotation"), QuantityKind::Rotation, "R of the body"));
            }
            (None, Motion::Planar) => {
                parts.push(NamedQuantity::new(
                    named("pose"),
                    QuantityKind::Plane,
                    "angle and place of the body in the plane",
                ));
            }
        }
    }
    parts.extend(model.coordinates.iter().map(|coordinate| {
        let (kind, label) = match coordinate.kind {
            CoordinateKind::Scalar => (QuantityKind::Scalar, "coordinate"),
            CoordinateKind::Pose => (QuantityKind::Pose, "coordinate: an element of SE(3)"),
            CoordinateKind::Rotation => (QuantityKind::Rotation, "coordinate: an element of SO(3)"),
        };
        NamedQuantity::new(coordinate.ident.clone(), kind, label)
    }));
    parts.extend(
        model
            .states
            .iter()
            .map(|state| NamedQuantity::new(state.ident.clone(), QuantityKind::Scalar, "state of an element")),
    );
    parts
}

/// Speeds as they are declared; without `speeds` the rates of the coordinates. Of those that constraints determine
/// none.
fn speeds(model: &Model, kept: Option<&[usize]>) -> Vec<NamedQuantity> {
    let mut all: Vec<NamedQuantity> = Vec::new();
    for word in model.in_chart.map(BodyChart::speed_words).unwrap_or_default() {
        match all.last_mut().filter(|last| last.ident == word) {
            Some(last) => last.kind = QuantityKind::Vector(last.size() + 1),
            None => {
                let label = model.in_chart.map_or_else(String::new, |own| speed_label(own, &word));
                all.push(NamedQuantity::new(Ident::new(&word, Span::call_site()), QuantityKind::Scalar, label));
            }
        }
    }
    match &model.speeds {
        Some(speeds) => all.extend(speeds.iter().map(|speed| match speed.kind {
            SpeedKind::Scalar => NamedQuantity::new(speed.ident.clone(), QuantityKind::Scalar, "speed"),
            SpeedKind::Vector => NamedQuantity::new(speed.ident.clone(), QuantityKind::Vector(3), "speed"),
        })),
        None => all.extend(model.coordinates.iter().flat_map(|q| {
            let word = q.ident.unraw();
            let part =
                |end: &str, kind, label: &str| NamedQuantity::new(format_ident!("{}_{}", word, end), kind, label);
            let turns =
                || part("omega", QuantityKind::Vector(3), &format!("angular velocity of `{word}`, in its own axes"));
            match q.kind {
                CoordinateKind::Scalar => vec![part("dot", QuantityKind::Scalar, &format!("rate of `{word}`"))],
                CoordinateKind::Rotation => vec![turns()],
                CoordinateKind::Pose => {
                    let moves = format!("velocity of `{word}`, in its own axes");
                    vec![part("u", QuantityKind::Vector(3), &moves), turns()]
                }
            }
        })),
    }
    match kept {
        Some(kept) => those_of(kept, all),
        None => all,
    }
}

/// Which velocity a speed of a chart is, and in which axes.
fn speed_label(BodyChart { chart, .. }: BodyChart, word: &str) -> String {
    let of = match word {
        "u" => "velocity of O, body axes",
        "xi" => "velocity of the body's point at Ω, observer's axes",
        "b_dot" => "velocity of O, observer's axes",
        "omega" if chart == Chart::RightInvariant => "angular velocity, observer's axes",
        "omega" => "angular velocity, body axes",
        _ => return format!("rate of `{}`", word.trim_end_matches("_dot")),
    };
    of.to_owned()
}

/// The speeds that stay where constraints are solved for the others: whole vectors, or single components.
fn those_of(kept: &[usize], all: Vec<NamedQuantity>) -> Vec<NamedQuantity> {
    let mut next = 0;
    let mut parts = Vec::new();
    for part in all {
        let own: Vec<usize> = (0..part.size()).filter(|k| kept.contains(&(next + k))).collect();
        next += part.size();
        if own.len() == part.size() {
            parts.push(part);
            continue;
        }
        parts.extend(own.into_iter().map(|k| {
            let ident = format_ident!("{}_{}", part.ident.unraw(), ["x", "y", "z"][k % 3]);
            NamedQuantity::new(ident, QuantityKind::Scalar, format!("component {k} of `{}`", part.ident))
        }));
    }
    parts
}
