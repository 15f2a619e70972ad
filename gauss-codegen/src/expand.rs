//! The pipeline on one screen: parse → translate → derive → lower → emit.

use proc_macro2::TokenStream;
use quote::quote;
use syn::DeriveInput;

use crate::algebra::Graph;
use crate::emit::{Derived, Equations, emit, file};
use crate::error::Result;
use crate::formulation::Formulation;
use crate::kernel::Passes;
use crate::lowering::{Lowered, lower};
use crate::mistakes::{most_operations, refuse_exhausted};
use crate::model::{self, Model};
use crate::translate::translate;

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    lowered(input, |lowered| Ok(written(&Derived::new(lowered).with_vectors())))
}

/// Expands one struct whose code is compiled for processors without vectors of products that are rounded once: methods
/// are written number by number alone.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand_without_vectors(input: &DeriveInput) -> syn::Result<TokenStream> {
    derive(input, |derived| Ok(written(derived)))
}

fn written(derived: &Derived<'_, '_>) -> TokenStream {
    let (code, file) = (emit(derived, &Equations::of(derived)), file(derived.item()));
    quote!(#code #file)
}

/// Derives one struct, and hands everything that is known of it to whoever writes it down.
pub fn derive<R>(input: &DeriveInput, write: impl FnOnce(&Derived<'_, '_>) -> Result<R>) -> syn::Result<R> {
    lowered(input, |lowered| write(&Derived::new(lowered)))
}

/// Derives one struct up to its programs.
fn lowered<R>(input: &DeriveInput, of: impl FnOnce(&Lowered<'_>) -> Result<R>) -> syn::Result<R> {
    let model = model::parse(input)?;
    let graph = Graph::new();
    graph.allow(most_operations(&model.item));
    // Every body and particle has partial velocities, a row for each speed.
    graph.spend((model.bodies.len() + model.particles.len()).saturating_mul(model.coordinates.len()));
    refuse_exhausted(&model.item, &graph)?;
    let derived = lower_model(&graph, &model).and_then(|lowered| of(&lowered));
    // Whatever else was found then means nothing.
    refuse_exhausted(&model.item, &graph)?;
    Ok(derived?)
}

fn lower_model<'g>(graph: &'g Graph, model: &Model) -> Result<Lowered<'g>> {
    let translated = translate(graph, model)?;
    let formulation = Formulation::of(translated)?;
    lower(formulation, Passes::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rational;
    use crate::mechanics::{Claims, System, SystemFault, check_system_against_definition};

    const SCENES: [&str; 5] = [
        "#[gauss(chart = jet(euler_zyx), linearize(parameters), regressor, force(at = c, value = [m * c.x, 0, 0]))]
         struct Body { #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>,
             #[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: f64 }",
        "#[gauss(coordinates(a, b), taylor, linearize, body(one, rotation = rotation_y(a)),
             body(two, parent = one, position = [l, 0, 0], rotation = rotation_y(b)), stop(along = b, least = 0.1, stiffness = l,
             width = 0.1))]
         struct Arms { #[gauss(body)] one: RigidBody<f64>, #[gauss(body)] two: RigidBody<f64>, l: f64, #[gauss(gravity)] g: f64 }",
        "#[gauss(coordinates(x, y, s), speeds(v, w, u), kinematics(x = v, y = w, s = u),
             body(sleigh, position = [x, y, 0], rotation = rotation_z(s)), independent(v, u),
             constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])))]
         struct Sleigh { #[gauss(body)] sleigh: RigidBody<f64> }",
        "#[gauss(coordinates(x, y, z), particle(mass = m, position = [x, y, z]), constraint(position = x * x + y * y - z),
             potential = ln(1 + x * x) / (2 + sin(y)), central_gravity(mu = m))]
         struct Bowl { m: f64 }",
        "#[gauss(coordinates(x, turn: Rotation), body(disk, position = [x, 0, 0], rotation = turn, mass = 1, inertia = [a, b, b]),
             contact(rim, point = disk.position, rim = a, axis = [1, 0, 0], friction = b), range(x, from = a, to = b))]
         struct Disk { a: f64, b: f64 }",
    ];

    fn mistakes(clauses: &str) -> Vec<(String, String)> {
        let source = format!(
            "#[gauss(coordinates(x, y, a), speeds(v, w, s), kinematics(x = v, y = w, a = s),
                 particle(mass = 1, position = [x, y, 0]), body(wheel, rotation = rotation_z(a), mass = 1, inertia = 1),
                 point(hub, body = wheel, at = [0, 0, 1]), {clauses})] struct Scene {{}}"
        );
        let input: DeriveInput = syn::parse_str(&source).expect("a struct");
        let error = expand(&input).expect_err("a mistake");
        error.into_iter().map(|e| (e.span().source_text().unwrap_or_default(), e.to_string())).collect()
    }

    /// Each number that a kernel says of its contacts is held to the definition.
    #[test]
    fn what_is_wrong_about_contacts_is_found() {
        let source = "#[gauss(coordinates(a, b, x), particle(mass = m, position = [cos(a), 0, sin(a)]),
             body(rod, rotation = rotation_y(b), mass = m, inertia = m), particle(mass = m, position = [x, 0, 0]),
             constraint(position = cos(a) + 2 * cos(b) - x), range(x, to = m),
             contact(floor, gap = a + t * b, slip = rate(x * a), friction = m, spin = rate(x), drilling = m, roll = rate(b), rolling = m), dry_friction(brake, slip = rate(b * x), bound = m),
             range(b, from = m))] struct Crank { m: f64 }";
        let input: DeriveInput = syn::parse_str(source).expect("a struct");
        let model = model::parse(&input).expect("a valid scene");
        let graph = Graph::new();
        let translated = crate::translate::translate(&graph, &model).expect("a scene");
        let system = System::new(translated.scene);
        let formulas = system.formulas();
        let claims = Claims::of(&formulas);
        assert!(check_system_against_definition(&system, &claims).is_ok());
        let [right, ..] = claims.contacts else { panic!("no way to form the motion") };
        // Three accelerations, seven rows, three by seven columns, seven by seven of D.
        assert_eq!(right.len(), 3 + 7 + 21 + 49);
        for k in 0..right.len() {
            let mut wrong = right.clone();
            wrong[k] = wrong[k] + graph.number(Rational::new(1, 1000));
            let claims = Claims { contacts: &[wrong], ..Claims::of(&formulas) };
            let faults = check_system_against_definition(&system, &claims).expect_err("a fault");
            assert!(matches!(faults.as_slice(), [SystemFault::Disagreement(_)]), "{k}: {faults:?}");
        }
    }

    /// Mistakes in gaps and slips that only the derivation sees are told all at once, each at its place.
    #[test]
    fn contacts_that_nothing_changes() {
        let found = mistakes(
            "contact(o, point = hub, plane = [1, 0, 0]), contact(flat, point = [x, y, 0], plane = [0, 1, 0], friction = 1),
             contact(p, gap = x - x + y - y, slip = v, friction = 1), contact(q, gap = y, slip = [v * w, s - s], friction = 1),
             range(r, along = hub.z, to = 2), contact(u, point = hub, plane = [1, 0, 0]),
             dry_friction(b, slip = [s - s, w * w], bound = 1)",
        );
        let found: Vec<(&str, &str)> = found.iter().map(|(place, message)| (&place[..], &message[..])).collect();
        let curved = "this slip of `q` is not affine in the speeds; write the component of a velocity along a tangent";
        let gap = |name: &str| format!("no speed changes the gap of `{name}`, so no force closes or opens it");
        assert_eq!(
            found,
            [
                ("hub", &gap("o")[..]),
                ("-", &gap("p")[..]),
                ("*", curved),
                ("-", "no speed changes this slip of `q`; leave it out"),
                ("z", &gap("r_to")),
                ("hub", &gap("u")),
                ("-", "no speed changes this slip of `b`; leave it out"),
                ("*", &curved.replace("`q`", "`b`")),
            ]
        );
        let found = mistakes(
            "contact(p, gap = y, slip = v, friction = 1, spin = s - s, drilling = 2, roll = [v, w * w], rolling = 1)",
        );
        let [drills, rolls] = &found[..] else { panic!("{found:?}") };
        assert_eq!(*drills, ("-".to_owned(), "no speed changes this slip of `p`; leave it out".to_owned()));
        assert_eq!(*rolls, ("*".to_owned(), curved.replace("`q`", "`p_rolling`")));
        let found = mistakes(
            "point(edge, body = wheel, at = [1, 0, 0]),
             contact(o, point = edge, plane = [0, 1, 0], friction = 1, drilling = 2, rolling = 1),
             contact(u, point = edge, friction = 1, drilling = 1, rolling = 3)",
        );
        let spins = "nothing spins about the normal of `o`, so drilling does nothing; remove `drilling`";
        let rolls = "nothing rolls along `u`, so rolling does nothing; remove `rolling`";
        assert_eq!(found, [("2".to_owned(), spins.to_owned()), ("3".to_owned(), rolls.to_owned())]);
        let found = mistakes("contact(o, point = hub, height = x, over = x, friction = 2), contact(p, gap = y)");
        let idle = "nothing slips along `o`, so friction does nothing; remove `friction`";
        assert_eq!(found, [("2".to_owned(), idle.to_owned())]);
    }

    /// A frame that turns with `b` carries a body; the other body that turns with `b` is not free by itself.
    #[test]
    fn speeds_that_move_frames_move_what_hangs_on_them() {
        let source = "#[gauss(coordinates(a, b), frame(turned, rotation = rotation_z(a)),
             frame(tilted, parent = turned, rotation = rotation_y(b)),
             body(arm, parent = tilted, mass = 1.0, inertia = [1, 2, 3]),
             body(rotor, rotation = rotation_z(b), mass = 1.0, inertia = [1, 1, 1]))]
         struct Geared {}";
        let input: DeriveInput = syn::parse_str(source).expect("a struct");
        // Every row is held to the Gauss condition.
        expand(&input).expect("equations of motion");
    }

    /// The first source has accelerations link by link only, the second as well, with powers besides.
    #[test]
    fn some_arrangement_is_left() {
        let springs = "k * powi(a - d, 2) + k * powi(b - e, 2) + k * powi(f - i, 2)";
        let sources = [
            "#[gauss(coordinates(x, turn: Rotation), frame(hull), particle(parent = hull, mass = m, position = [x, 0, 0]),
                 body(ball, rotation = turn, mass = 1, inertia = 1), linearize)] struct Scene { m: f64 }"
                .to_owned(),
            format!(
                "#[gauss(coordinates(a, b, c, d, e, f, g, h, i), particle(mass = m, position = [a, b, c]),
                     particle(mass = m, position = [d, e, f]), particle(mass = m, position = [g, h, i]),
                     potential = {springs}, taylor, linearize(parameters, hessian, inverse))] struct Scene {{ m: f64, k: f64 }}"
            ),
        ];
        for source in sources {
            let input: DeriveInput = syn::parse_str(&source).expect("a struct");
            if let Err(error) = expand(&input) {
                panic!("{error}");
            }
        }
    }

    /// Wherever the last node is made, the derivation ends with one message and without a panic.
    #[test]
    fn what_is_too_large_is_refused_wherever_that_is_found() {
        for source in SCENES {
            let input: DeriveInput = syn::parse_str(source).expect("a struct");
            let model = model::parse(&input).expect("a valid scene");
            for size in (2..14).map(|power| 1 << power).chain([700, 1400, 3000, 6000, 12_000]) {
                let graph = Graph::new();
                graph.restrict(size);
                let derived = lower_model(&graph, &model).map(|lowered| written(&Derived::new(&lowered)));
                assert!(refuse_exhausted(&model.item, &graph).is_err() || derived.is_ok(), "{size}: {source}");
            }
        }
    }
}
