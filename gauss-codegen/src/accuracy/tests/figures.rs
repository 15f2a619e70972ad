//! Figures for losses: beside 106 binary digits at the states that are found, and beside states that are known to be
//! bad.

use crate::accuracy::flat::{Slot, Trace};
use crate::accuracy::loss_search::Search;
use crate::accuracy::moves::Draft;
use crate::algebra::{Doubled, Graph, Notation, Number, Scalar, print};
use crate::formulation::Formulation;
use crate::kernel::Passes;
use crate::lowering::{Lowered, lower, states};
use crate::model;
use crate::translate::translate;

use super::Random;

/// Errors to first order and those of 106 digits are of different roundings, and changes of different signs.
const WITHIN: f64 = 10.0;
/// The loss from which on first order is not enough to say more.
const ALL: f64 = 1e12;
/// Bound of the changes of a result that vanishes identically: they are roundings of 106 digits, 2⁻¹⁰⁴, over what
/// inputs are changed by; those of double precision are their 2⁵⁹ times, by chance some of them less.
const VANISHING: f64 = 1.0 / (1_u64 << 55) as f64;
/// Loss up to which nothing is said.
const LITTLE: f64 = 10.0;

/// A method of a scene, with its figure before it is rounded, its loss where the search found it, and its loss at a
/// state that is given in part; of derivatives that is the worst at all states of the search.
struct MethodFigures {
    method: &'static str,
    figure: f64,
    estimated: f64,
    there: f64,
    given: f64,
}

/// Losses of functions and of the programs besides by measurement: beside 106 digits, and the effects of changes of all
/// inputs.
fn measured(search: &Search<'_, '_, '_>, draft: &Draft<'_>, trace: &mut Trace) -> [Vec<f64>; 2] {
    // Far below what sums are near zero by, and far above 2⁻¹⁰⁴.
    const CHANGE: f64 = 1.0 / (1_u64 << 45) as f64;
    search.try_all_at(draft, trace);
    let one = |_: Slot| Doubled::number(1.0);
    let exact = search.exact(draft, trace, search.flat.len(), one);
    let changed = [1, 2, 3, 4].map(|n: u64| {
        search.exact(draft, trace, search.flat.len(), |slot| {
            let share = 2.0 * Random::new(7 * u64::from(slot) + n).fraction() - 1.0;
            Doubled::number(1.0) + Doubled::number(CHANGE * 3.0_f64.sqrt() * share)
        })
    });
    let units = |slot: Slot| {
        let k = slot as usize;
        let change = changed.each_ref().map(|changed| ((changed[k] - exact[k]).to_f64() / CHANGE).powi(2));
        f64::EPSILON * (exact[k].to_f64().abs() + (change.iter().sum::<f64>() / change.len() as f64).sqrt())
    };
    let of = |outputs: &Vec<Slot>| {
        let largest = outputs.iter().map(|slot| units(*slot)).fold(0.0, f64::max);
        let loss = outputs.iter().map(|&slot| {
            let found = trace.slots()[slot as usize].value;
            let error = (Doubled::number(found) - exact[slot as usize]).to_f64().abs();
            let unit = units(slot);
            if !found.is_finite() && exact[slot as usize].is_finite() {
                return f64::INFINITY;
            }
            error / if unit <= error * VANISHING || unit <= 1e-18 * largest { largest } else { unit }
        });
        loss.fold(0.0, |a: f64, b: f64| if b.is_nan() { a } else { a.max(b) })
    };
    [&search.outputs, &search.besides].map(|lists| lists.iter().map(of).collect())
}

/// All methods of a scene; the state that is given is the ordinary sample state but for the symbols that are named.
fn seen(clauses: &str, fields: &str, given: &[(&str, f64)]) -> Vec<MethodFigures> {
    let source = format!("#[gauss({clauses})] struct Scene {{ {fields} }}");
    let input = syn::parse_str(&source).expect("the source is a struct");
    let model = model::parse(&input).unwrap_or_else(|error| panic!("{error}: {source}"));
    let graph = Graph::new();
    let translated = translate(&graph, &model).expect("a scene");
    let formulation = Formulation::of(translated).expect("equations");
    let Lowered { formulation, kernel, .. } = lower(formulation, Passes::default()).expect("a kernel");
    let states = states(&formulation);
    let samples = states.samples();
    let sought = kernel.sought();
    let mut search = Search::new(&samples, &sought);
    let mut traces = search.rooms();
    let (drafts, best) = search.searched(&samples, &mut traces);
    let [mut trace, mut again] = traces;
    let mut own = drafts[0].clone();
    for (name, value) in given {
        let symbol = search.symbol(|symbol| print(symbol, Notation::Text) == *name);
        own.values.put(symbol.unwrap_or_else(|| panic!("no {name}: {source}")), *value);
    }
    let [of_given, _] = measured(&search, &own, &mut trace);
    let functions = kernel.functions.iter().enumerate().filter_map(|(k, (method, function))| {
        let figure = function.figure.as_ref()?;
        let there = measured(&search, &drafts[best[k].state], &mut trace)[0][k];
        let (method, figure) = (method.name(), figure.worst);
        Some(MethodFigures { method, figure, estimated: best[k].loss, there, given: of_given[k] })
    });
    let mut all: Vec<MethodFigures> = functions.collect();
    let besides = kernel.derivatives.iter().map(|derivative| &derivative.figure);
    for (k, figure) in std::iter::once(&kernel.figure_of_joined).chain(besides).enumerate() {
        let Some(figure) = figure else { continue };
        let mut derivatives =
            MethodFigures { method: DERIVATIVES, figure: figure.worst, estimated: -1.0, there: 0.0, given: 0.0 };
        for draft in &drafts {
            let [_, besides] = measured(&search, draft, &mut trace);
            derivatives.given = derivatives.given.max(besides[k]);
            search.try_all_at(draft, &mut again);
            let slots = &search.besides[k];
            let estimated = search.loss_as_of(&[&trace, &again], slots, slots).unwrap_or(f64::INFINITY);
            if estimated > derivatives.estimated {
                (derivatives.estimated, derivatives.there) = (estimated, besides[k]);
            }
        }
        all.push(derivatives);
    }
    all
}

/// Name of the programs beside methods: all of them together, and derivatives.
const DERIVATIVES: &str = "derivatives";

/// A scene with its fields, a method, and a state where that is known to lose digits, or not.
type FigureCase = (&'static str, &'static str, &'static str, &'static [(&'static str, f64)]);

const SCENES: [FigureCase; 8] = [
    // A torus at its inner rim: the square of the distance from the axis is multiplied out.
    (
        "coordinates(a, b), particle(mass = 1, position = [(2 + 1.999 * cos(a)) * cos(b), (2 + 1.999 * cos(a)) * sin(b), \
         1.999 * sin(a)])",
        "",
        "mass_matrix",
        &[("a", std::f64::consts::PI - 9.3e-5)],
    ),
    (
        "coordinates(a, b), particle(mass = 1, position = [(R + r * cos(a)) * cos(b), (R + r * cos(a)) * sin(b), r * sin(a)])",
        "R: f64, r: f64",
        "acceleration",
        &[("a", std::f64::consts::PI - 6.5e-7), ("R", 1.0), ("r", 0.9999999)],
    ),
    (
        "coordinates(a, b), particle(mass = 1, position = [(R + r * cos(a)) * cos(b), (R + r * cos(a)) * sin(b), r * sin(a)])",
        "R: f64, r: f64",
        "gauss_residual",
        &[("a", std::f64::consts::PI - 6.5e-7), ("R", 1.0), ("r", 0.9999999)],
    ),
    // A ring: a length of 1000 and a distance of nearly that.
    (
        "coordinates(x, y), particle(mass = 1, position = [x, y, 0]), \
         spring(from = [0, 0, 0], to = [x, y, 0], stiffness = 10, length = 1000)",
        "",
        "potential_energy",
        &[("x", 600.0001), ("y", 800.0)],
    ),
    // A bead between two springs that pull as much.
    (
        "coordinates(x), particle(mass = 1, position = [x, 0, 0]), \
         spring(from = [-1, 0, 0], to = [x, 0, 0], stiffness = 10, length = 0.5), \
         spring(from = [1, 0, 0], to = [x, 0, 0], stiffness = 10, length = 0.5)",
        "",
        "acceleration",
        &[("x", 1.1e-8)],
    ),
    // A disk that is nearly flat.
    (
        "coordinates(x, y, yaw, lean, spin), body(disk, position = [x, y, cos(lean)], mass = 1, \
         rotation = rotation_z(yaw) * rotation_x(lean) * rotation_y(spin), inertia = [0.25, 0.5, 0.25]), gravity = 9.8",
        "",
        "acceleration",
        &[("lean", std::f64::consts::FRAC_PI_2 - 3.3e-7)],
    ),
    // Euler's equations: rates of momenta that vanish identically.
    ("chart = jet(euler_zxz), motion = fixed_point, mass = 1, inertia = [0.25, 0.25, 0.5]", "", "acceleration", &[]),
    // A craft: nothing is lost.
    (
        "coordinates(craft: Pose), body(hull, pose = craft, mass = 1000, inertia = [300, 400, 500]), gravity = 9.8",
        "",
        "acceleration",
        &[],
    ),
];

#[track_caller]
fn is_lost(seen: MethodFigures, clauses: &str) {
    let MethodFigures { method, figure, estimated, there, given } = seen;
    let agree = estimated.min(ALL) <= WITHIN * there.max(LITTLE) && there.min(ALL) <= WITHIN * estimated.max(LITTLE);
    println!("{method}: said {figure:e}, estimated {estimated:e}, measured {there:e}, given {given:e}: {clauses}");
    assert!(agree, "{method} loses {there:e}, not {estimated:e}: {clauses}");
    let enough = given.min(ALL) <= WITHIN * figure.max(LITTLE);
    assert!(enough, "{method} loses {given:e}, and {figure:e} is said: {clauses}");
}

#[test]
fn what_is_said_is_lost_where_the_search_found_it() {
    for (clauses, fields, known, given) in SCENES {
        let of_known = seen(clauses, fields, given).into_iter().filter(|seen| seen.method == known);
        of_known.for_each(|seen| is_lost(seen, clauses));
    }
}

/// Figures of derivatives by state, by parameters, and of second ones hold at the states of the search.
#[test]
fn what_is_said_of_derivatives_is_lost_at_the_states_of_the_search() {
    for (clauses, fields) in [
        (
            "coordinates(a, b), particle(mass = m, position = [(R + r * cos(a)) * cos(b), (R + r * cos(a)) * sin(b), \
             r * sin(a)]), linearize(parameters, hessian)",
            "R: f64, r: f64, m: f64",
        ),
        (
            "coordinates(x), particle(mass = 1, position = [x, 0, 0]), \
             spring(from = [-1, 0, 0], to = [x, 0, 0], stiffness = 10, length = 0.5), \
             spring(from = [1, 0, 0], to = [x, 0, 0], stiffness = 10, length = 0.5), linearize(hessian)",
            "",
        ),
        (
            "coordinates(x, y), particle(mass = 1, position = [x, y, 0]), \
             spring(from = [0, 0, 0], to = [x, y, 0], stiffness = k, length = l), linearize(parameters)",
            "k: f64, l: f64",
        ),
        (
            "coordinates(a, b), gravity = g, particle(mass = m, position = [l * sin(a), 0, -l * cos(a)]), \
             particle(mass = n, position = [l * sin(a) + k * sin(b), 0, -l * cos(a) - k * cos(b)]), \
             linearize(parameters, inverse, hessian)",
            "m: f64, n: f64, l: f64, k: f64, g: f64",
        ),
        (
            "coordinates(x, y, yaw, lean, spin), body(disk, position = [x, y, cos(lean)], mass = 1, \
             rotation = rotation_z(yaw) * rotation_x(lean) * rotation_y(spin), inertia = [0.25, 0.5, 0.25]), \
             gravity = 9.8, linearize",
            "",
        ),
        (
            "chart = jet(euler_zxz), motion = fixed_point, mass = m, inertia = [A, B, C], linearize",
            "m: f64, A: f64, B: f64, C: f64",
        ),
    ] {
        let of_derivatives = seen(clauses, fields, &[]).into_iter().filter(|seen| seen.method == DERIVATIVES);
        of_derivatives.for_each(|seen| is_lost(seen, clauses));
    }
}
