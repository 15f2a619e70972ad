//! Files of robots, which a struct names from the folder of its package.

use std::path::{Path, PathBuf};

use proc_macro2::{Group, Literal, TokenStream, TokenTree};
use syn::{DeriveInput, LitStr, Meta, parse2};

/// The folder of the package that a source file belongs to: the nearest one above it with a manifest.
pub fn package_of(file: &Path) -> Option<PathBuf> {
    let file = std::path::absolute(file).ok()?;
    file.ancestors().skip(1).find(|folder| folder.join("Cargo.toml").is_file()).map(Path::to_owned)
}

/// `urdf = "…"` and `mjcf = "…"` by whole paths: whoever looks for the files is in no package.
pub fn by_whole_paths(item: &mut DeriveInput, package: &Path) {
    for attribute in item.attrs.iter_mut().filter(|attribute| attribute.path().is_ident("gauss")) {
        if let Meta::List(list) = &mut attribute.meta {
            list.tokens = whole(std::mem::take(&mut list.tokens), package);
        }
    }
}

fn whole(tokens: TokenStream, package: &Path) -> TokenStream {
    let mut named = false;
    let each = |token: TokenTree| match token {
        TokenTree::Ident(ident) => {
            named = ident == "urdf" || ident == "mjcf";
            TokenTree::Ident(ident)
        }
        TokenTree::Punct(punct) => {
            named &= punct.as_char() == '=';
            TokenTree::Punct(punct)
        }
        TokenTree::Literal(literal) if std::mem::take(&mut named) => TokenTree::Literal(joined(literal, package)),
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), whole(group.stream(), package));
            inner.set_span(group.span());
            TokenTree::Group(inner)
        }
        TokenTree::Literal(literal) => TokenTree::Literal(literal),
    };
    tokens.into_iter().map(each).collect()
}

/// A path that is whole stays what it is; so does what is no path.
fn joined(literal: Literal, package: &Path) -> Literal {
    let Ok(written) = parse2::<LitStr>(TokenTree::Literal(literal.clone()).into()) else { return literal };
    let path = package.join(written.value());
    let mut whole = Literal::string(&path.to_string_lossy());
    whole.set_span(literal.span());
    whole
}
