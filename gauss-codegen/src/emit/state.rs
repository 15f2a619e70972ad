//! `NameState`: coordinates and speeds by name, and the way to and from configurations and speeds, which costs nothing.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::model::{Chart, CoordinateKind, InChart, Motion, SpeedKind};
use crate::words::Unraw;

use super::derived::{Derived, KernelGenerics};
use super::record::{Part, PartKind, from_numbers, record, to_numbers};

/// The name of the type.
pub fn state_name(derived: &Derived<'_, '_>) -> Ident {
    format_ident!("{}State", derived.item().ident)
}

/// Coordinates, then speeds, each in their order, with different names.
pub fn parts(derived: &Derived<'_, '_>) -> [Vec<Part>; 2] {
    let mut all = [coordinates(derived), speeds(derived)];
    let mut taken: Vec<String> = Vec::new();
    for part in all.iter_mut().flatten() {
        let word = part.ident.unraw().to_string();
        let numbered = (2..).map(|n| format!("{word}_{n}"));
        let free = std::iter::once(word.clone()).chain(numbered).find(|name| !taken.contains(name));
        let free = free.unwrap_or_default();
        if free != word {
            part.ident = Ident::new(&free, part.ident.span());
        }
        taken.push(free);
    }
    all
}

/// What every number of a state is called: those of the configuration, scalars behind all others, and the speeds.
pub fn component_names(derived: &Derived<'_, '_>) -> [Vec<String>; 2] {
    let [mut coordinates, speeds] = parts(derived);
    coordinates.sort_by_key(|part| part.kind == PartKind::Scalar);
    [coordinates, speeds].map(|parts| parts.iter().flat_map(Part::names).collect())
}

fn coordinates(derived: &Derived<'_, '_>) -> Vec<Part> {
    let model = derived.subject.model;
    let named = |word: &str| Ident::new(word, Span::call_site());
    let mut parts = Vec::new();
    if let Some(own) = model.in_chart {
        match (own.coordinate_words(), own.motion) {
            (Some(words), _) => {
                let part = |word: &String| Part::new(named(word), PartKind::Scalar, "a coordinate of the chart");
                parts.extend(words.iter().map(part));
            }
            (None, Motion::Free) => {
                parts.push(Part::new(named("pose"), PartKind::Pose, "R and b of the body: x̂ = R x + b"))
            }
            (None, Motion::FixedPoint) => {
                parts.push(Part::new(named("rotation"), PartKind::Rotation, "R of the body"));
            }
            (None, Motion::Planar) => {
                parts.push(Part::new(named("pose"), PartKind::Plane, "angle and place of the body in the plane"));
            }
        }
    }
    parts.extend(model.coordinates.iter().map(|coordinate| {
        let (kind, label) = match coordinate.kind {
            CoordinateKind::Scalar => (PartKind::Scalar, "coordinate"),
            CoordinateKind::Pose => (PartKind::Pose, "coordinate: an element of SE(3)"),
            CoordinateKind::Rotation => (PartKind::Rotation, "coordinate: an element of SO(3)"),
        };
        Part::new(coordinate.ident.clone(), kind, label)
    }));
    parts
}

/// Speeds as they are declared; without `speeds` the rates of the coordinates. Of those that constraints determine none.
fn speeds(derived: &Derived<'_, '_>) -> Vec<Part> {
    let model = derived.subject.model;
    let mut all: Vec<Part> = Vec::new();
    for word in model.in_chart.map(InChart::speed_words).unwrap_or_default() {
        match all.last_mut().filter(|last| last.ident == word) {
            Some(last) => last.kind = PartKind::Vector(last.size() + 1),
            None => {
                let label = model.in_chart.map_or_else(String::new, |own| speed_label(own, &word));
                all.push(Part::new(Ident::new(&word, Span::call_site()), PartKind::Scalar, label));
            }
        }
    }
    match &model.speeds {
        Some(speeds) => all.extend(speeds.iter().map(|speed| match speed.kind {
            SpeedKind::Scalar => Part::new(speed.ident.clone(), PartKind::Scalar, "speed"),
            SpeedKind::Vector => Part::new(speed.ident.clone(), PartKind::Vector(3), "speed"),
        })),
        None => all.extend(model.coordinates.iter().flat_map(|q| {
            let word = q.ident.unraw();
            let part = |end: &str, kind, label: &str| Part::new(format_ident!("{}_{}", word, end), kind, label);
            let turns =
                || part("omega", PartKind::Vector(3), &format!("angular velocity of `{word}`, in its own axes"));
            match q.kind {
                CoordinateKind::Scalar => vec![part("dot", PartKind::Scalar, &format!("rate of `{word}`"))],
                CoordinateKind::Rotation => vec![turns()],
                CoordinateKind::Pose => {
                    let moves = format!("velocity of `{word}`, in its own axes");
                    vec![part("u", PartKind::Vector(3), &moves), turns()]
                }
            }
        })),
    }
    kept(derived, all)
}

/// Which velocity a speed of a chart is, and in which axes.
fn speed_label(InChart { chart, .. }: InChart, word: &str) -> String {
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
fn kept(derived: &Derived<'_, '_>, all: Vec<Part>) -> Vec<Part> {
    let kept = &derived.subject.kept_speeds;
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
            Part::new(ident, PartKind::Scalar, format!("component {k} of `{}`", part.ident))
        }));
    }
    parts
}

/// The type, and what it implements.
pub fn state(derived: &Derived<'_, '_>) -> [TokenStream; 2] {
    let all = parts(derived);
    let (name, kernel) = (state_name(derived), derived.kernel_name());
    let documentation = format!(
        "Coordinates and speeds of [`{kernel}`] by name.\n\n`{name} {{ … }}` has them in any order, `..Default::default()` \
         those that are zero; `q()` and `z()` are what kernels and runs take, `{name}::of(&q, &z)` is the way back."
    );
    let fields: Vec<&Part> = all.iter().flatten().collect();
    let rest = "At rest; coordinates are zero, rotations and poses those of the observer's frame.";
    let [declaration, traits] = record(derived, &name, [&documentation, rest], &fields);
    let conversions = conversions(derived, &all);
    [declaration, quote!(#conversions #traits)]
}

/// To and from configurations and speeds.
fn conversions(derived: &Derived<'_, '_>, all: &[Vec<Part>; 2]) -> TokenStream {
    let (private, name, kernel) = (derived.private(), state_name(derived), derived.kernel_name());
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let visibility = derived.item().visibility;
    let system = quote!(<#kernel #used as #private::GaussSystem>);
    let of = conversion_from(derived, all);
    let (q, z) = (configuration_of(derived, &all[0]), speeds_of(derived, &all[1]));
    quote! {
        #[allow(clippy::all, clippy::pedantic)]
        #[allow(dead_code)]
        impl #bounded #name #used {
            /// The state that has this configuration and these speeds.
            #[inline(always)]
            #visibility fn of(__q: &#system::Configuration, __speeds: &#system::Speeds) -> Self { #of }

            /// The configuration.
            #[inline(always)]
            #visibility fn q(&self) -> #system::Configuration { #q }

            /// The speeds, in their order.
            #[inline(always)]
            #visibility fn z(&self) -> #system::Speeds { #z }
        }
    }
}

/// A literal of the state, from the factors of q and the components of z.
fn conversion_from(derived: &Derived<'_, '_>, [coordinates, speeds]: &[Vec<Part>; 2]) -> TokenStream {
    let private = derived.private();
    let places = derived.subject.places_of_coordinates(&private);
    let of_q = coordinates.iter().zip(places).map(|(Part { ident, .. }, place)| quote!(#ident: #place));
    let of_z = from_numbers(&private, speeds, |k| quote!(__z[#k]));
    quote! {
        let __z = #private::components(__speeds);
        Self { #(#of_q,)* #(#of_z),* }
    }
}

fn configuration_of(derived: &Derived<'_, '_>, coordinates: &[Part]) -> TokenStream {
    let values = coordinates.iter().map(|Part { ident, .. }| quote!(self.#ident)).collect::<Vec<_>>();
    derived.subject.configuration_of(&derived.private(), &values)
}

fn speeds_of(derived: &Derived<'_, '_>, speeds: &[Part]) -> TokenStream {
    let private = derived.private();
    let components = to_numbers(&private, speeds);
    quote!(#private::vector([#(#components),*]))
}
