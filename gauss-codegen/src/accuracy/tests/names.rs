//! Names say nothing of the motion: the same scene with other ones has the same programs and the same figures.

use crate::expand::derive;

/// The instructions of a method, its operations, its losses at the sample states, and the worst and the median figure.
type Method = (usize, u32, Vec<f64>, Option<[f64; 2]>);

/// Every method of a scene.
fn methods(source: &str) -> Vec<Method> {
    let input: syn::DeriveInput = syn::parse_str(source).expect("the source is a struct");
    let of = derive(&input, |derived| {
        let functions = derived.kernel.functions.iter().map(|(_, function)| {
            let (program, figure) = (&function.program, function.figure.as_ref());
            let said = figure.map(|figure| [figure.worst, figure.median]);
            (program.instructions.len(), program.cost().total(), function.loss.0.clone(), said)
        });
        Ok(functions.collect())
    });
    of.unwrap_or_else(|error| panic!("{error}: {source}"))
}

#[test]
fn other_names_give_the_same_programs_and_figures() {
    let pendulum = "#[gauss(coordinates(Q, P), gravity = G, particle(mass = M, position = [L * sin(Q), 0, -L * cos(Q)]), \
                    particle(mass = N, position = [L * sin(Q) + K * sin(P), 0, -L * cos(Q) - K * cos(P)]))] \
                    struct Scene { M: f64, N: f64, L: f64, K: f64, G: f64 }";
    let relative = "#[gauss(coordinates(Q, P), gravity = [0, -9.81, 0], body(one, rotation = rotation_z(Q), mass = M, \
                    inertia = [0, 0, N], center_of_mass = [L, 0, 0]), body(two, parent = one, position = [K, 0, 0], \
                    rotation = rotation_z(P), mass = G, inertia = [0, 0, N], center_of_mass = [L, 0, 0]))] \
                    struct Scene { M: f64, N: f64, L: f64, K: f64, G: f64 }";
    let curve = "#[gauss(coordinates(Q), gravity = [0, -G, 0], particle(mass = M, position = [Q, (Q - K).powi(2), 0]), \
                 potential = N * (Q - L).powi(4))] struct Scene { M: f64, N: f64, L: f64, K: f64, G: f64 }";
    let names = |source: &str, names: [&str; 7]| {
        let words = ["Q", "P", "M", "N", "L", "K", "G"];
        let written = |text: String, (word, name): (&str, &str)| {
            let mut out = String::new();
            let mut rest = text.as_str();
            while let Some(at) = rest.find(word) {
                out += &rest[..at];
                let inside = rest[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
                    || rest[at + 1..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
                out += if inside { word } else { name };
                rest = &rest[at + 1..];
            }
            out + rest
        };
        words.into_iter().zip(names).fold(source.to_owned(), written)
    };
    for source in [pendulum, relative, curve] {
        let first = methods(&names(source, ["a", "b", "m", "n", "l", "k", "g"]));
        for other in [["u", "v", "m1", "m2", "l1", "l2", "g"], ["z9", "z1", "w7", "w3", "w5", "w1", "w2"]] {
            assert_eq!(methods(&names(source, other)), first, "{other:?}: {source}");
        }
    }
}
