//! Checks of mass data in `kernel()`, as the laws say.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use crate::algebra::{Map, Rational};
use crate::kernel::Program;
use crate::mass_laws::{Datum, Group, InertiaRule, InertiaRules, MassLaw, MassRule};
use crate::terms::Shape;

use crate::emit::constructor::locals::{clause_local, local_of_datum};
use crate::emit::derived::Derived;
use crate::emit::dialect::program::statements;

/// Checks, group by group; a group with values of its own has them as locals of a block.
pub fn checked<'g>(derived: &Derived<'_, 'g>, groups: &[Group<'g>], symbols: &Map<u32, TokenStream>) -> TokenStream {
    let group = |Group { values, laws }: &Group<'g>| {
        let read = values
            .iter()
            .map(|own| clause_local(&derived.scalar(), &local_of_datum(Datum::Own(own.quantity)), own, symbols));
        let checks: TokenStream = laws.iter().map(|law| check(derived, law, symbols)).collect();
        match values.is_empty() {
            true => checks,
            false => quote!({ #(#read)* #checks }),
        }
    };
    groups.iter().map(group).collect()
}

fn check<'g>(derived: &Derived<'_, 'g>, law: &MassLaw<'g>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let label = &law.label;
    match &law.rule {
        MassRule::Mass(mass) => {
            let mass = local_of_datum(*mass);
            quote!(__check.mass(#label, #mass);)
        }
        MassRule::MassInSum(mass) => {
            let mass = local_of_datum(*mass);
            quote!(__check.mass_in_sum(#label, #mass);)
        }
        MassRule::NonNegative(number) => {
            let number = local_of_datum(*number);
            quote!(__check.non_negative(#label, #number);)
        }
        MassRule::Finite(datum, shape) => {
            let name = local_of_datum(*datum);
            match shape {
                Shape::Scalar => quote!(__check.finite(#label, &[#name]);),
                Shape::Vector3 | Shape::Vector6 => quote!(__check.finite(#label, &#name);),
                _ => quote!(for __row in &#name { __check.finite(#label, __row); }),
            }
        }
        MassRule::Symmetric(matrix) => {
            let matrix = local_of_datum(*matrix);
            quote!(__check.symmetric(#label, &#matrix);)
        }
        MassRule::Inertia(rules) => inertia(derived, label, rules),
        MassRule::KineticMatrix(rows) => {
            let (compute, outputs) = statements(&Program::lower(&rows.concat()), symbols, &derived.scalar());
            let rows = outputs.chunks(rows.len()).map(|row| quote!([#(#row),*]));
            let check = quote!({ #compute __check.kinetic_matrix(#label, &[#(#rows),*]); });
            // Of one among several it says nothing where others make up for what it lacks: their sum is checked then.
            match derived.mass_laws.in_sum {
                true => quote!(if __check.massless().is_none() #check),
                false => check,
            }
        }
    }
}

fn inertia(derived: &Derived<'_, '_>, label: &str, rules: &InertiaRules) -> TokenStream {
    let zero = derived.scalar().number(&Rational::zero());
    let mass = rules.mass.map_or_else(|| zero.clone(), quote_local);
    let center = rules.center.map_or_else(|| quote!([#zero; 3]), quote_local);
    let (name, rows) = match rules.tensor {
        Datum::Part(..) => (local_of_datum(rules.tensor), None),
        tensor => {
            (Ident::new("__inertia", Span::call_site()), Some(rows(derived, rules.shape, &local_of_datum(tensor))))
        }
    };
    let check = |rule: &InertiaRule| match rule {
        InertiaRule::Alone => quote!(__check.inertia(#label, &#name);),
        InertiaRule::Central => quote!(__check.central_inertia(#label, #mass, #center, &#name);),
        InertiaRule::Planar => quote! {
            let __moment = #name[2usize][2usize];
            __check.inertia(#label, &[[__moment, #zero, #zero], [#zero, __moment, #zero], [#zero, #zero, __moment]]);
        },
        InertiaRule::AboutAxis(axis) => quote!(__check.inertia_about_axis(#label, #axis, (#mass, #center), &#name);),
        InertiaRule::Still => quote!(for __row in &#name { __check.finite(#label, __row); }),
        InertiaRule::InSum => quote!(__check.inertia_in_sum(#label, #mass, #center, &#name);),
    };
    let mut checks: TokenStream = rules.rules.iter().map(check).collect();
    if rules.is_formal {
        checks = quote! {
            __check.waive_triangle_inequality(true);
            #checks
            __check.waive_triangle_inequality(false);
        };
    }
    match rows {
        Some(rows) => quote!({ let #name = #rows; #checks }),
        None => checks,
    }
}

fn quote_local(datum: Datum) -> TokenStream {
    let name = local_of_datum(datum);
    quote!(#name)
}

/// An inertia as a matrix, from its shape.
fn rows(derived: &Derived<'_, '_>, shape: Shape, name: &Ident) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    let zero = quote!(<#ty as #real>::zero());
    let rows = (0..3usize).map(|i| {
        let row = (0..3usize).map(|j| match shape {
            Shape::Scalar if i == j => quote!(#name),
            Shape::Vector3 if i == j => quote!(#name[#i]),
            Shape::Matrix3 => quote!(#name[#i][#j]),
            _ => zero.clone(),
        });
        quote!([#(#row),*])
    });
    quote!([#(#rows),*])
}
