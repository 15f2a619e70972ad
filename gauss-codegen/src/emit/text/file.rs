//! The file that a scene comes from: named, so that an edit compiles the struct anew; what of it does not act.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};

use crate::terms::{Described, Remark};

use crate::emit::derived::Derived;

/// Beside what is derived, where it is compiled: the file as a constant that nobody reads, and a warning for
/// everything that acts in it and not in the equations.
pub fn file(derived: &Derived<'_, '_>) -> TokenStream {
    let Some(Described { paths, span, remarks, .. }) = &derived.item().described else {
        return TokenStream::new();
    };
    // The compiler warns of what is deprecated, in the words of its note; macros have no other way to. Only at a
    // token of the user's: what a macro brings along is not warned of.
    let warning = |Remark { text, .. }: &Remark| {
        quote_spanned!(*span=> const _: () = {
            #[deprecated(note = #text)]
            const IGNORED: () = ();
            IGNORED
        };)
    };
    let warnings = remarks.iter().filter(|remark| remark.ignored).map(warning);
    quote! {
        #(const _: &[::core::primitive::u8] = ::core::include_bytes!(#paths);)*
        #(#warnings)*
    }
}

/// What is to be known of the file, for the page of the kernel.
pub fn documentation(derived: &Derived<'_, '_>) -> String {
    let Some(Described { file, remarks, .. }) = &derived.item().described else { return String::new() };
    let mut out = format!("\n# The file\n\nBodies, joints and inputs are those of `{file}`.\n\n");
    remarks.iter().for_each(|remark| out.push_str(&format!("- {}\n", remark.text)));
    out
}
