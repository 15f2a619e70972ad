//! Identifiers as words.

use proc_macro2::Ident;

pub trait Unraw {
    /// Without `r#`.
    fn unraw(&self) -> Ident;
}

impl Unraw for Ident {
    fn unraw(&self) -> Ident {
        let text = self.to_string();
        text.strip_prefix("r#").map_or_else(|| self.clone(), |word| Ident::new(word, self.span()))
    }
}
