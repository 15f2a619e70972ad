//! The whole way: the attributes and the fields of a struct in, its model out.

use crate::model::assembly;
use crate::model::language::context::Context;
use crate::model::language::fields::Reader;
use crate::model::language::robots::Format;
use crate::model::language::struct_clauses::Clauses;
use crate::model::language::{fields, nesting, struct_clauses};
use crate::model::locks;
#[cfg(feature = "modes")]
use crate::model::modes;
use crate::model::names::inputs;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
use crate::model::robots;
use crate::model::scene::model::Model;
use crate::terms::{Item, KernelOptions, RobotFile, Scalar};
use proc_macro2::{Span, TokenStream};
use syn::ext::IdentExt;
use syn::punctuated::Punctuated;
use syn::token::Brace;
use syn::{Data, DeriveInput, Error, Fields, FieldsNamed, GenericParam, Generics};

/// The item of a derive, if it is not nested deeper than can be read.
///
/// # Errors
/// The token that is too deep; what is no item.
pub fn item(tokens: TokenStream) -> Result<DeriveInput, Error> {
    match nesting::item_too_deep(tokens.clone()) {
        Some(span) => Err(Error::new(span, format!("nested more than {} levels deep", nesting::DEEPEST))),
        None => syn::parse2(tokens),
    }
}

/// Reads and checks a struct.
///
/// # Errors
/// All mistakes of the struct combined, each at the token that is wrong.
pub fn parse(input: &DeriveInput) -> Result<Model, Error> {
    let mut context = Context::default();
    let mut clauses = struct_clauses::read(&input.attrs, fields::any_body(input), &mut context);
    check_generics(&input.generics, &mut context);
    let none = FieldsNamed { brace_token: Brace::default(), named: Punctuated::new() };
    let without = clauses.robot.file.is_some().then_some(&none);
    let model = named_fields(input, without, &mut context).and_then(|named| {
        let reader = fields::read(named, &input.generics, clauses.own, &mut context);
        let described = robot_of_file(&mut clauses, &reader, &mut context);
        let tracked = modes_of_files(&mut clauses, &mut context);
        locks::apply(&mut clauses.statements, &mut context);
        inputs::name(&mut clauses.statements, &reader.fields, &mut context);
        let mut model = assembly::model(input, clauses, reader, &mut context)?;
        check_python(&model.item, &input.generics, &mut context);
        check_derivatives(&model.item.wanted, !model.contacts.is_empty(), &mut context);
        model.item.described = described;
        model.item.tracked = tracked;
        Some(model)
    });
    context.finish(model)
}

/// Puts the clauses of a robot's file before those of the struct. `None` without a file, or where it has a mistake,
/// which is noted.
fn robot_of_file(clauses: &mut Clauses, reader: &Reader<'_>, context: &mut Context) -> Option<RobotFile> {
    let Clauses { robot, statements, wanted, .. } = clauses;
    let file = robot.file.as_ref()?;
    let (feature, is_read) = match file.format {
        Format::Urdf => ("urdf", cfg!(feature = "urdf")),
        Format::Mjcf => ("mjcf", cfg!(feature = "mjcf")),
    };
    if !is_read {
        // Whatever else seems to be missing is what the file was to say.
        statements.missed = true;
        let remedy = format!("such files are read with the feature `{feature}` of gauss-runtime; add it in Cargo.toml");
        context.error(file.span, format!("{}: {remedy}", file.path));
        return None;
    }
    #[cfg(any(feature = "urdf", feature = "mjcf"))]
    return robots::compose(file, robot, reader, (statements, &mut wanted.reactions), context);
    #[cfg(not(any(feature = "urdf", feature = "mjcf")))]
    {
        let _ = (reader, wanted);
        None
    }
}

/// Puts what files say of modes into their clauses; gives back where they are.
fn modes_of_files(clauses: &mut Clauses, context: &mut Context) -> Vec<String> {
    #[cfg(feature = "modes")]
    return modes::compose(&mut clauses.statements, context);
    #[cfg(not(feature = "modes"))]
    {
        for file in clauses.statements.modes.iter().filter_map(|read| read.file.as_ref()) {
            let remedy = "such files are read with the feature `modes` of gauss-runtime; add it in Cargo.toml";
            context.error(file.span, format!("{}: {remedy}", file.path));
        }
        clauses.statements.missed |= clauses.statements.modes.iter().any(|read| read.file.is_some());
        Vec::new()
    }
}

/// The fields of a struct with named fields, or none of a unit struct where it can be `without`; anything else is a
/// mistake at its name.
fn named_fields<'a>(
    input: &'a DeriveInput,
    without: Option<&'a FieldsNamed>,
    context: &mut Context,
) -> Option<&'a FieldsNamed> {
    let found = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(named) => return Some(named),
            Fields::Unnamed(_) => "a tuple struct",
            Fields::Unit => match without {
                Some(none) => return Some(none),
                None => "a unit struct",
            },
        },
        Data::Enum(_) => "an enum",
        Data::Union(_) => "a union",
    };
    let name = &input.ident;
    let fields = match found {
        "a unit struct" => "{}",
        _ => "{ #[gauss(mass)] mass: f64, #[gauss(inertia)] inertia: f64 }",
    };
    context.error(
        name.span(),
        format!(
            "`GaussDynamics` is derived for structs with named fields, and `{name}` is {found}; \
             write `struct {name} {fields}`"
        ),
    );
    None
}

/// A kernel holds numbers of one scalar type, so type parameters are all that it can carry over.
fn check_generics(generics: &Generics, context: &mut Context) {
    for parameter in &generics.params {
        match parameter {
            GenericParam::Type(_) => {}
            GenericParam::Lifetime(parameter) => context.error_at(
                &parameter.lifetime,
                format!(
                    "the lifetime parameter `{}` is not supported; \
                     a kernel outlives the struct that it is made from: write fields that own their values",
                    parameter.lifetime
                ),
            ),
            GenericParam::Const(parameter) => context.error(
                parameter.ident.span(),
                format!(
                    "the const parameter `{}` is not supported; \
                     the shape of every role is fixed: write the number where it is used",
                    parameter.ident
                ),
            ),
        }
    }
}

/// Python makes the struct from numbers of 64 bits, so nothing else may be open in its type.
fn check_python(item: &Item, generics: &Generics, context: &mut Context) {
    let Some(clause) = &item.wanted.python else { return };
    if item.scalar == Scalar::F32 {
        context
            .error(clause.span(), "`python` computes in `f64`; write the fields in `f64` or in a type parameter `T`");
    }
    let other = |parameter: &&syn::TypeParam| item.scalar != Scalar::Parameter(parameter.ident.clone());
    for parameter in generics.type_params().filter(other) {
        let name = &parameter.ident;
        context.error(name.span(), format!("with `python` the scalar is the only type parameter; `{name}` is none"));
    }
}

/// Derivatives of the equations have no contact forces: that is asked for by a word where there are contacts, and
/// nowhere else.
fn check_derivatives(wanted: &KernelOptions, has_contacts: bool, context: &mut Context) {
    let Some(clause) = wanted.linearize.as_ref().filter(|_| wanted.without_contacts != has_contacts) else { return };
    let message = if has_contacts {
        "the scene has contacts, whose forces are not in the equations that `linearize` differentiates: write \
         `linearize(without_contacts)` where all gaps are open, and for what rests, slides or sticks take \
         `gauss_adapters::linearize` of `InMode` of gauss-contact, without this clause"
    } else {
        "`linearize(without_contacts)` is for scenes with contacts, and this one has none; leave the word out"
    };
    context.error(clause.span(), message);
}

/// The struct of that name in the text of a Rust file, wherever in its modules it is.
///
/// # Errors
/// What is no Rust; the name, if there is no such struct.
pub fn struct_in(source: &str, name: &str) -> syn::Result<DeriveInput> {
    let file = syn::parse_file(source).map_err(|error| unbalanced(source).unwrap_or(error))?;
    let Some(item) = find(&file.items, name) else {
        let message = format!("there is no struct `{name}` in this file");
        return Err(syn::Error::new(Span::call_site(), message));
    };
    Ok(item.clone().into())
}

/// The only struct with a `#[gauss(…)]` attribute, its own or of a field, in a text.
///
/// # Errors
/// What is no Rust; no such struct; every further one.
pub fn only_struct_in(source: &str) -> syn::Result<DeriveInput> {
    let tokens: TokenStream =
        source.parse().map_err(|error| unbalanced(source).unwrap_or_else(|| Error::from(error)))?;
    if let Some(span) = nesting::item_too_deep(tokens.clone()) {
        return Err(Error::new(span, format!("nested more than {} levels deep", nesting::DEEPEST)));
    }
    let file: syn::File = syn::parse2(tokens)?;
    let is_gauss = |attribute: &syn::Attribute| attribute.path().is_ident("gauss");
    let is_scene = |item: &syn::ItemStruct| {
        let fields = item.fields.iter().flat_map(|field| &field.attrs);
        item.attrs.iter().chain(fields).any(is_gauss)
    };
    let scene = |item| match item {
        syn::Item::Struct(item) if is_scene(&item) => Some(item),
        _ => None,
    };
    let mut scenes = file.items.into_iter().filter_map(scene);
    let Some(first) = scenes.next() else {
        let message = "there is no struct with `#[gauss(…)]` in this text; write `#[gauss(…)] struct Name { … }`";
        return Err(Error::new(Span::call_site(), message));
    };
    let further = scenes.map(|scene| {
        let message = format!("a text has one scene, and `{}` is another; remove it", scene.ident);
        Error::new(scene.ident.span(), message)
    });
    let all = further.reduce(|mut all, mistake| {
        all.combine(mistake);
        all
    });
    all.map_or_else(|| Ok(first.into()), Err)
}

/// The bracket of a text that none closes, or that closes none: the compiler's own words name it, those of a text that
/// is read at run time do not.
fn unbalanced(source: &str) -> Option<Error> {
    let failed = |text: &str| text.parse::<TokenStream>().err().map(|error| error.span());
    let offset = |span: Span| {
        let start = span.start();
        let line: usize = source.split_inclusive('\n').take(start.line - 1).map(str::len).sum();
        let rest = source.get(line..)?;
        Some(line + rest.char_indices().nth(start.column).map_or(rest.len(), |(place, _)| place))
    };
    let bracket = |span: Span| source.get(offset(span)?..)?.chars().next();
    let first = failed(source)?;
    let (span, message) = match bracket(first)? {
        open @ ('(' | '[' | '{') => (first, format!("nothing closes this `{open}`")),
        // The text before it ends with what it was to close.
        close @ (')' | ']' | '}') => match failed(source.get(..offset(first)?)?) {
            Some(open) => (open, format!("nothing closes this `{}` before the next `{close}`", bracket(open)?)),
            None => (first, format!("this `{close}` closes nothing")),
        },
        _ => return None,
    };
    Some(Error::new(span, message))
}

fn find<'a>(items: &'a [syn::Item], name: &str) -> Option<&'a syn::ItemStruct> {
    items.iter().find_map(|item| match item {
        syn::Item::Struct(item) if item.ident.unraw() == name => Some(item),
        syn::Item::Mod(module) => find(&module.content.as_ref()?.1, name),
        _ => None,
    })
}

impl From<crate::error::Error> for syn::Error {
    fn from(mistakes: crate::error::Error) -> Self {
        let mistakes = mistakes.into_iter().map(|(span, message)| syn::Error::new(span, message));
        let all = mistakes.reduce(|mut all, mistake| {
            all.combine(mistake);
            all
        });
        all.unwrap_or_else(|| syn::Error::new(Span::call_site(), "a mistake without a name"))
    }
}
