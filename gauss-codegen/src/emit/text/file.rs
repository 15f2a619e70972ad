//! The file that a scene comes from: named, so that an edit compiles the struct anew; what of it does not act.

use proc_macro2::{Ident, TokenStream};
use quote::{quote, quote_spanned};

use crate::terms::{FileRemark, Generics, Item, RobotFile};

/// Beside what is derived, where it is compiled: the file as a constant that nobody reads, and a warning for
/// everything that acts in it and not in the equations.
pub fn file(item: &Item) -> TokenStream {
    let tracked = &item.tracked;
    let Some(RobotFile { paths, span, remarks, .. }) = &item.described else {
        return quote!(#(const _: &[::core::primitive::u8] = ::core::include_bytes!(#tracked);)*);
    };
    let ignored: Vec<&FileRemark> = remarks.iter().filter(|remark| remark.ignored).collect();
    // The compiler warns of what is deprecated, in the words of its note and with its name; macros have no other way
    // to. Only at a token of the user's: what a macro brings along is not warned of.
    let warning = |(n, FileRemark { text, .. }): (usize, &&FileRemark)| {
        let number = if ignored.len() > 1 { format!("_{}", n + 1) } else { String::new() };
        let [name, told] = ["NOT_IN_THE_EQUATIONS", "TOLD"].map(|name| Ident::new(&format!("{name}{number}"), *span));
        quote_spanned! {*span=>
            #[deprecated(note = #text)]
            const #name: () = ();
            const #told: () = Self::#name;
        }
    };
    let warnings = ignored.iter().enumerate().map(warning);
    let Item { ident, generics: Generics { declared, used, predicates }, .. } = item;
    let told = (!ignored.is_empty()).then(|| {
        quote! {
            #[allow(dead_code)]
            impl #declared #ident #used where #predicates {
                #(#warnings)*
            }
        }
    });
    quote! {
        #(const _: &[::core::primitive::u8] = ::core::include_bytes!(#paths);)*
        #(const _: &[::core::primitive::u8] = ::core::include_bytes!(#tracked);)*
        #told
    }
}

/// Remarks on the file, for the page of the kernel.
pub fn documentation(item: &Item) -> String {
    let Some(RobotFile { file, remarks, .. }) = &item.described else { return String::new() };
    let mut out = format!("\n# The file\n\nBodies, joints and inputs are those of `{file}`.\n\n");
    remarks.iter().for_each(|remark| out.push_str(&format!("- {}\n", remark.text)));
    out
}
