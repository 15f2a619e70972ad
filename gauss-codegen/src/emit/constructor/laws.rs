//! Constants of springs and stops in `kernel()`, and `warnings()`: what is likely not meant, although a kernel can be
//! made of it.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::Program;
use crate::mass_laws::MassLaws;
use crate::terms::LawKind;
use crate::translate::{DragMatrix, Law};

use crate::emit::constructor::locals::{local_of_datum, parameters_read, symbols_of_parameters};
use crate::emit::derived::Derived;
use crate::emit::dialect::program::{ScalarTokens, statements};

/// States at which a dissipation function is looked at.
const STATES: usize = 4;

/// Checks of the masses of particles.
pub fn masses(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    written(derived, symbols, |kind| kind == LawKind::MassInSum)
}

/// Checks of the constants of springs and stops.
pub fn checked(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    written(derived, symbols, |kind| kind != LawKind::MassInSum)
}

fn written(
    derived: &Derived<'_, '_>,
    symbols: &Map<u32, TokenStream>,
    of_kind: impl Fn(LawKind) -> bool,
) -> TokenStream {
    let check = |law: &Law<'_>| {
        let label = &law.label;
        let check = match law.kind {
            LawKind::Stiffness => quote!(stiffness),
            LawKind::Width => quote!(width),
            LawKind::Limits => quote!(limits),
            LawKind::NonNegative | LawKind::Friction => quote!(non_negative),
            LawKind::Armature => quote!(armature),
            LawKind::Length => quote!(positive_length),
            LawKind::Restitution => quote!(restitution),
            LawKind::Direction => quote!(direction),
            LawKind::MassInSum => quote!(mass_in_sum),
            LawKind::StiffnessMatrix => quote!(stiffness_matrix),
            LawKind::DampingMatrix => quote!(damping_matrix),
            LawKind::Modes => quote!(modes),
            LawKind::Damping | LawKind::Attraction => quote!(finite),
            LawKind::Dissipation => return None,
        };
        // Of a state nothing is known when the kernel is made.
        let (compute, values) = of_parameters(&derived.scalar(), symbols, &law.values)?;
        Some(match law.kind {
            LawKind::Stiffness
            | LawKind::Width
            | LawKind::NonNegative
            | LawKind::Armature
            | LawKind::Length
            | LawKind::Friction
            | LawKind::Restitution
            | LawKind::Direction
            | LawKind::MassInSum => {
                quote!({ #compute __check.#check(#label, #(#values)*); })
            }
            LawKind::Limits => quote!({ #compute __check.#check(#label, [#(#values),*]); }),
            LawKind::StiffnessMatrix | LawKind::DampingMatrix | LawKind::Modes => {
                let rows = rows_of(&values);
                quote!({ #compute __check.#check(#label, #rows); })
            }
            _ => quote!({ #compute __check.#check(#label, &[#(#values),*]); }),
        })
    };
    derived.subject.provenance.laws.iter().filter(|law| of_kind(law.kind)).filter_map(check).collect()
}

/// A square matrix.
fn rows_of(entries: &[TokenStream]) -> TokenStream {
    let rows = entries.chunks(entries.len().isqrt().max(1)).map(|row| quote!([#(#row),*]));
    quote!(&[#(#rows),*])
}

/// `warnings()`.
pub fn warnings(derived: &Derived<'_, '_>) -> TokenStream {
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let visibility = &derived.item().visibility;
    let symbols = symbols_of_parameters(derived);
    let read = parameters_read(derived, &symbols);
    let of_elements = [drags(derived, &symbols), laws(derived, &symbols)];
    let of_mass_data = [gravity(derived.mass_laws).unwrap_or_default(), added_masses(derived, &symbols)];
    quote! {
        /// What is likely not meant, although a kernel can be made of it: drag and damping that feed energy, gravity
        /// that points upward, added mass with the sign of hydrodynamic derivatives.
        #[allow(unused_variables, unused_mut, dead_code, clippy::all, clippy::pedantic)]
        #visibility fn warnings(&self) -> #private::ParameterWarnings {
            #read
            let mut __warnings = #private::WarningCheck::<#ty>::new();
            #(#of_elements)*
            #(#of_mass_data)*
            __warnings.finish()
        }
    }
}

/// Matrices of drag. Coefficients that depend on the state are no matrix that could be judged here.
fn drags(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let private = derived.private();
    let check = |drag: &DragMatrix<'_>| {
        let (compute, outputs) = of_parameters(&derived.scalar(), symbols, &drag.entries.concat())?;
        let rows = rows_of(&outputs);
        let (label, kind) = (&drag.label, if drag.quadratic { quote!(Quadratic) } else { quote!(Linear) });
        Some(quote!({
            #compute
            __warnings.drag(#label, #private::DragKind::#kind, #rows);
        }))
    };
    derived.subject.provenance.drags.iter().filter_map(check).collect()
}

/// Damping and attraction.
fn laws(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let find = |law: &Law<'_>| {
        let label = &law.label;
        let (check, values) = match law.kind {
            LawKind::Damping => (quote!(damping), law.values.clone()),
            LawKind::Attraction => (quote!(center), law.values.clone()),
            LawKind::DampingMatrix => (quote!(damping_matrix), law.values.clone()),
            LawKind::Dissipation => (quote!(dissipation), in_states(law.values[0], &|key| symbols.contains_key(&key))),
            LawKind::Stiffness
            | LawKind::Width
            | LawKind::Limits
            | LawKind::NonNegative
            | LawKind::Armature
            | LawKind::Length
            | LawKind::StiffnessMatrix
            | LawKind::Modes
            | LawKind::Friction
            | LawKind::Restitution
            | LawKind::Direction
            | LawKind::MassInSum => {
                return None;
            }
        };
        let (compute, values) = of_parameters(&derived.scalar(), symbols, &values)?;
        Some(match law.kind {
            LawKind::Dissipation => quote!({ #compute __warnings.#check(#label, &[#(#values),*]); }),
            LawKind::DampingMatrix => {
                let rows = rows_of(&values);
                quote!({ #compute __warnings.#check(#label, #rows); })
            }
            _ => quote!({ #compute __warnings.#check(#label, #(#values)*); }),
        })
    };
    derived.subject.provenance.laws.iter().filter_map(find).collect()
}

/// A function of the state at a few states of general position: small fractions in place of what is no parameter.
pub fn in_states<'g>(function: Expr<'g>, is_known: &dyn Fn(u32) -> bool) -> Vec<Expr<'g>> {
    let graph = function.graph();
    let program = Program::lower(&[function]);
    let of_state: Vec<_> = program.symbols().into_iter().filter(|s| !is_known(s.key())).collect();
    let at = |state: usize| {
        let number = |k: usize| {
            let numerator = [7, -5, 11, -13][(state + k) % 4] + 2 * (k as i64 % 3);
            graph.number(Rational::new(numerator, 8 + state as i64))
        };
        let values = of_state.iter().enumerate().map(|(k, symbol)| (symbol.key(), number(k))).collect();
        function.substitute(&values)
    };
    (0..STATES).map(at).collect()
}

/// A gravity of one number.
fn gravity(mass_laws: &MassLaws<'_>) -> Option<TokenStream> {
    let (label, gravity) = mass_laws.gravity.as_ref()?;
    let name = local_of_datum(*gravity);
    Some(quote!(__warnings.gravity(#label, #name);))
}

/// Diagonals of added masses.
fn added_masses(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let find = |(label, diagonal): &(String, Vec<Expr<'_>>)| {
        let (compute, values) = of_parameters(&derived.scalar(), symbols, diagonal)?;
        Some(quote!({ #compute __warnings.added_mass(#label, &[#(#values),*]); }))
    };
    derived.mass_laws.added_masses.iter().filter_map(find).collect()
}

/// The values of expressions of parameters; `None` where the state enters.
fn of_parameters(
    scalar: &ScalarTokens<'_>,
    symbols: &Map<u32, TokenStream>,
    expressions: &[Expr<'_>],
) -> Option<(TokenStream, Vec<TokenStream>)> {
    let program = Program::lower(expressions);
    let known = program.symbols().iter().all(|symbol| symbols.contains_key(&symbol.key()));
    known.then(|| statements(&program, symbols, scalar))
}
