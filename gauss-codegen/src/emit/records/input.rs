//! `NameInput`: inputs by name, and the way to and from vectors, which costs nothing.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::records::record::{Part, PartKind, from_numbers, record, to_numbers};
use crate::terms::{InputKind, InputName, Item};
use crate::words::Unraw;

/// The name of the type.
pub fn input_name(item: &Item) -> Ident {
    format_ident!("{}Input", item.ident)
}

/// In their order: one number, a vector, or of a wrench two.
pub fn parts(item: &Item) -> Vec<Part> {
    let part = |input: &InputName| {
        let ident = input.called.clone();
        let unit = input.unit.as_deref().map(|unit| format!(", in {unit}")).unwrap_or_default();
        let of_wrench =
            |end: &str, label: &str| Part::new(format_ident!("{}_{}", ident.unraw(), end), PartKind::Vector(3), label);
        match input.kind {
            InputKind::Scalar => vec![Part::new(ident, PartKind::Scalar, format!("input{unit}"))],
            InputKind::Vector => vec![Part::new(ident, PartKind::Vector(3), format!("input{unit}"))],
            InputKind::Wrench => vec![of_wrench("force", "input, in N"), of_wrench("torque", "input, in N m")],
        }
    };
    item.inputs.iter().flat_map(part).collect()
}

/// The type, and what it implements; nothing without inputs.
pub fn input(derived: &Derived<'_, '_>) -> [TokenStream; 2] {
    let parts = parts(derived.item());
    if parts.is_empty() {
        return [TokenStream::new(), TokenStream::new()];
    }
    let (private, name, kernel) = (derived.private(), input_name(derived.item()), derived.kernel_name());
    let documentation = format!(
        "Inputs of [`{kernel}`] by name.\n\n`{name} {{ … }}` has them in any order, `..Default::default()` those that are \
         zero; `input()` is what kernels take, `{name}::of(&input)` is the way back."
    );
    let [declaration, traits] =
        record(derived, &name, [&documentation, "All zero."], &parts.iter().collect::<Vec<_>>());
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let (visibility, input) = (&derived.item().visibility, quote!(<#kernel #used as #private::GaussSystem>::Input));
    let (fields, numbers) = (from_numbers(&private, &parts, |k| quote!(__all[#k])), to_numbers(&private, &parts));
    let conversions = quote! {
        #[allow(clippy::all, clippy::pedantic)]
        #[allow(dead_code)]
        impl #bounded #name #used {
            /// The inputs of a vector.
            #[inline(always)]
            #visibility fn of(__input: &#input) -> Self {
                let __all = #private::components(__input);
                Self { #(#fields),* }
            }

            /// One vector, in their order.
            #[inline(always)]
            #visibility fn input(&self) -> #input { #private::vector([#(#numbers),*]) }
        }
    };
    [declaration, quote!(#conversions #traits)]
}
