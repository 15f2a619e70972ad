//! `python`: what has to be known of a struct to make a class of it, as the call of one macro of the crate
//! `gauss-python`. Nothing here knows how classes are made.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use crate::emit::derived::Derived;
use crate::emit::records::record::{Part, PartKind, number_names};
use crate::emit::records::{input, state};
use crate::methods::DerivativeKind;
use crate::terms::{Field, FileRemark, OptionalMethod, Scalar};
use crate::words::Unraw;

/// The call; nothing where no Python is wanted.
pub fn scene(derived: &Derived<'_, '_>) -> TokenStream {
    let item = derived.item();
    let Some(clause) = &item.wanted.python else { return TokenStream::new() };
    let (name, documentation, kernel) = (&item.ident, &item.documentation, derived.kernel_name());
    let state = state::state_name(derived.item());
    let scalar = match &item.scalar {
        Scalar::Parameter(ident) => quote!(#ident),
        Scalar::F64 | Scalar::F32 => TokenStream::new(),
    };
    let fields = item.fields.iter().map(field);
    let [coordinates, speeds, inputs] = parts(derived).map(|parts| parts.iter().map(part).collect::<Vec<_>>());
    let (offers, steps) = (offers(derived), steps(derived));
    let remarks = item.described.iter().flat_map(|file| &file.remarks);
    let remarks = remarks.map(|FileRemark { text, ignored }| {
        let text = without_rust(text);
        quote!(#text #ignored;)
    });
    // Where the crate is missing, the clause is to blame.
    let path = quote_spanned!(clause.span()=> ::gauss_python::scene!);
    quote! {
        #path {
            scene #name [#scalar] #documentation;
            kernel #kernel; state #state;
            fields { #(#fields)* }
            coordinates { #(#coordinates)* }
            speeds { #(#speeds)* }
            inputs { #(#inputs)* }
            offers { #(#offers)* }
            steps { #(#steps)* }
            remarks { #(#remarks)* }
        }
    }
}

/// Coordinates, speeds and inputs by name.
pub fn parts(derived: &Derived<'_, '_>) -> [Vec<Part>; 3] {
    let [coordinates, speeds] = state::parts(derived);
    [coordinates, speeds, input::parts(derived.item())]
}

/// Names of the numbers of each of these, which are those of a state, of coordinates that are scalars last, or inputs.
pub fn numbers(parts: &[Part]) -> Vec<(String, Vec<String>)> {
    let (scalars, others): (Vec<&Part>, Vec<&Part>) = parts.iter().partition(|part| part.kind == PartKind::Scalar);
    let ordered = [others, scalars].concat();
    let words = ordered.iter().map(|part| part.ident.unraw().to_string());
    words.zip(number_names(&ordered)).collect()
}

/// A remark without words of Rust: runs with contacts are those of `simulate`.
pub fn without_rust(text: &str) -> String {
    text.replace(", which a `ContactRun` runs,", ",")
}

/// `mass [f64] "mass" "kg" "of the hull";`
fn field(Field { ident, ty, unit, documentation, .. }: &Field) -> TokenStream {
    let (word, unit) = (ident.unraw().to_string(), unit.as_deref().unwrap_or_default());
    quote!(#ident [#ty] #word #unit #documentation;)
}

/// `"craft" 7 4 "R and b";`: the numbers that it consists of, and how many of them in the beginning have norm 1.
fn part(part: &Part) -> TokenStream {
    let [size, unit] = [part.names().len(), part.kind.unit_components()].map(Literal::usize_unsuffixed);
    let (word, label) = (part.ident.unraw().to_string(), &part.label);
    quote!(#word #size #unit #label;)
}

/// The traits that the kernel has besides those of every kernel, a word for each.
fn offers(derived: &Derived<'_, '_>) -> Vec<proc_macro2::Ident> {
    let wanted = &derived.item().wanted;
    let derivatives = derived.kernel.derivatives.iter().filter_map(|derivative| match derivative.kind {
        DerivativeKind::Regressor => None,
        kind => Some(kind.name()),
    });
    let mut words: Vec<&str> = derivatives.collect();
    words.extend((!wanted.frames.is_empty()).then_some("frames"));
    let of_methods = wanted.methods.iter().filter_map(|method| match method {
        OptionalMethod::Centroidal => Some("centroidal"),
        OptionalMethod::GravityTorques => Some("gravity_torques"),
        OptionalMethod::JacobianRates => Some("jacobian_rates"),
        OptionalMethod::NonlinearEffects => None,
    });
    words.extend(of_methods);
    words.extend((!derived.subject.constraints.is_empty()).then_some("constraints"));
    words.extend((!wanted.reactions.is_empty()).then_some("reactions"));
    words.extend((!wanted.motions.is_empty()).then_some("motions"));
    words.into_iter().map(|word| format_ident!("{}", word)).collect()
}

/// Words for the kinds of runs that the kernel has besides those of every kernel.
fn steps(derived: &Derived<'_, '_>) -> Vec<proc_macro2::Ident> {
    let has_jacobian = derived.kernel.derivatives.iter().any(|other| matches!(other.kind, DerivativeKind::ByState));
    let touches = !derived.subject.system.contacts.is_empty();
    let words =
        [(derived.item().wanted.taylor.is_some(), "taylor"), (has_jacobian, "rosenbrock"), (touches, "contacts")];
    words.into_iter().filter(|(has, _)| *has).map(|(_, word)| format_ident!("{}", word)).collect()
}

#[cfg(test)]
mod tests {
    use super::without_rust;

    #[test]
    fn remedies_are_those_of_python() {
        let told = "3:1: the limits of joints do not act; write `limits = range` for exact stops, which a `ContactRun` \
                    runs, `limits = stop(…)` for stops that give way, or `limits = none`";
        let expected = "3:1: the limits of joints do not act; write `limits = range` for exact stops, \
                        `limits = stop(…)` for stops that give way, or `limits = none`";
        assert_eq!(without_rust(told), expected);
        assert_eq!(without_rust("<antenna/> is not read"), "<antenna/> is not read");
    }
}
