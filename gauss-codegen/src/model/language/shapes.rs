//! The written type of a field → its shape and its scalar.
//!
//! A derive sees tokens, not types, so the last segment of the path decides: `nalgebra::Vector3<f64>` is a vector of
//! three whatever `nalgebra` is. An unknown name is taken for an alias, and the word of the role must give the shape.

use crate::terms::Scalar;
use crate::terms::Shape;
use proc_macro2::Span;
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::{
    AngleBracketedGenericArguments, Expr, ExprLit, GenericArgument, GenericParam, Generics, Lit, Path, PathArguments,
    PathSegment, Stmt, Type,
};

/// Properties that a written type shows.
pub struct Reading {
    pub kind: TypeKind,
    pub element: ScalarType,
    /// The type in a message: `` `Matrix6` `` or `a tuple`.
    pub name: String,
}

/// Kinds of written types.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum TypeKind {
    /// One of the shapes that roles take.
    Known(Shape),
    /// A name that could stand for any of them.
    Alias,
    /// Certainly none of them.
    Foreign,
}

/// The scalar that a written type shows.
pub enum ScalarType {
    /// A scalar and where it is written.
    Shown(Scalar, Span),
    /// None: it is behind an alias.
    Hidden,
    /// A type that is no scalar, and where it is written.
    Wrong(String, Span),
}

/// Names that are certainly none of the shapes; any other name could be an alias of one.
const FOREIGN: &[&str] = &[
    "bool",
    "char",
    "str",
    "u8",
    "u16",
    "u32",
    "u64",
    "u128",
    "usize",
    "i8",
    "i16",
    "i32",
    "i64",
    "i128",
    "isize",
    "String",
    "Vec",
    "VecDeque",
    "Option",
    "Result",
    "Box",
    "Rc",
    "Arc",
    "Cell",
    "RefCell",
    "Cow",
    "PhantomData",
    "HashMap",
    "BTreeMap",
    "Vector1",
    "Vector2",
    "Vector4",
    "Vector5",
    "Matrix1",
    "Matrix2",
    "Matrix4",
    "Matrix5",
    "RowVector3",
    "RowVector6",
    "DVector",
    "DMatrix",
    "Point2",
    "Point3",
    "Quaternion",
    "UnitQuaternion",
    "Rotation2",
    "Rotation3",
    "Isometry2",
    "Isometry3",
    "Translation2",
    "Translation3",
    "UnitVector3",
];

/// Reads a type.
pub fn read(ty: &Type, generics: &Generics) -> Reading {
    let foreign = |name: &str| Reading { kind: TypeKind::Foreign, element: ScalarType::Hidden, name: name.into() };
    match bare(ty) {
        Type::Path(path) if path.qself.is_none() => read_path(&path.path, generics),
        // `<A as B>::C` and `shape!()` are known to later passes of the compiler only.
        Type::Path(_) => Reading { kind: TypeKind::Alias, ..foreign("an associated type") },
        Type::Macro(_) => Reading { kind: TypeKind::Alias, ..foreign("a macro") },
        Type::Array(_) | Type::Slice(_) => foreign("an array"),
        Type::Tuple(_) => foreign("a tuple"),
        Type::Reference(_) => foreign("a reference"),
        Type::Ptr(_) => foreign("a pointer"),
        Type::FnPtr(_) => foreign("a function"),
        _ => foreign("a type of another kind"),
    }
}

fn read_path(path: &Path, generics: &Generics) -> Reading {
    let Some(last) = path.segments.last() else {
        return Reading { kind: TypeKind::Alias, element: ScalarType::Hidden, name: "an empty path".into() };
    };
    let reading = |kind, element| Reading { kind, element, name: format!("`{}`", last.ident) };
    if let Some(scalar) = scalar(path, generics) {
        return reading(TypeKind::Known(Shape::Scalar), ScalarType::Shown(scalar, last.ident.span()));
    }
    let kind = match last.ident.unraw().to_string().as_str() {
        "Vector3" => TypeKind::Known(Shape::Vector3),
        "Matrix3" => TypeKind::Known(Shape::Matrix3),
        "Vector6" => TypeKind::Known(Shape::Vector6),
        "Matrix6" => TypeKind::Known(Shape::Matrix6),
        "RigidBody" => TypeKind::Known(match types(last).nth(1) {
            Some(Type::Path(path)) if path.path.segments.last().is_some_and(|s| s.ident == "AboutCenterOfMass") => {
                Shape::CentralBody
            }
            _ => Shape::RigidBody,
        }),
        "SVector" => sized(&dimensions(last), 1),
        "SMatrix" => sized(&dimensions(last), 2),
        name if FOREIGN.contains(&name) => TypeKind::Foreign,
        _ => {
            // `Moments<f32>` hides the shape but shows the scalar; what else its arguments are is its own business.
            let shown = types(last).find_map(|ty| match element(ty, generics) {
                ScalarType::Wrong(..) | ScalarType::Hidden => None,
                shown => Some(shown),
            });
            return reading(TypeKind::Alias, shown.unwrap_or(ScalarType::Hidden));
        }
    };
    match kind {
        TypeKind::Known(_) | TypeKind::Alias => {
            reading(kind, types(last).next().map_or(ScalarType::Hidden, |ty| element(ty, generics)))
        }
        TypeKind::Foreign => reading(kind, ScalarType::Hidden),
    }
}

/// Shape of `SVector<S, N>` or `SMatrix<S, R, C>`; a dimension that is not a number could be anything.
fn sized(dimensions: &[Option<usize>], expected: usize) -> TypeKind {
    if dimensions.len() != expected {
        return TypeKind::Alias;
    }
    let mut numbers = dimensions.iter().copied();
    let (Some(Some(rows)), Some(columns)) = (numbers.next(), numbers.next().unwrap_or(Some(1))) else {
        return TypeKind::Alias;
    };
    match (rows, columns) {
        (3, 1) => TypeKind::Known(Shape::Vector3),
        (3, 3) => TypeKind::Known(Shape::Matrix3),
        (6, 1) => TypeKind::Known(Shape::Vector6),
        (6, 6) => TypeKind::Known(Shape::Matrix6),
        _ => TypeKind::Foreign,
    }
}

/// The arguments after the first as numbers, `None` for those that are not written as numbers.
fn dimensions(segment: &PathSegment) -> Vec<Option<usize>> {
    arguments(segment).into_iter().flat_map(|arguments| arguments.args.iter().skip(1)).map(number).collect()
}

/// `3` or `{ 3 }`.
fn number(argument: &GenericArgument) -> Option<usize> {
    let GenericArgument::Const(expression) = argument else {
        return None;
    };
    let inner = match expression {
        Expr::Block(block) => match block.block.stmts.as_slice() {
            [Stmt::Expr(inner, None)] => inner,
            _ => return None,
        },
        other => other,
    };
    match inner {
        Expr::Lit(ExprLit { lit: Lit::Int(number), .. }) => number.base10_parse().ok(),
        _ => None,
    }
}

/// The scalar that `ty` is, when it stands where a scalar belongs.
fn element(ty: &Type, generics: &Generics) -> ScalarType {
    let ty = bare(ty);
    let reading = read(ty, generics);
    let span = ty.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| token.span());
    match (reading.kind, reading.element) {
        (TypeKind::Known(Shape::Scalar), shown) => shown,
        (TypeKind::Alias, _) => ScalarType::Hidden,
        (TypeKind::Known(_) | TypeKind::Foreign, _) => ScalarType::Wrong(reading.name, span),
    }
}

/// `f32` and `f64` however qualified, or a type parameter of the struct. Parameters come first: they shadow.
fn scalar(path: &Path, generics: &Generics) -> Option<Scalar> {
    let last = path.segments.last()?;
    if !matches!(last.arguments, PathArguments::None) {
        return None;
    }
    if let Some(ident) = path.get_ident() {
        let parameter = generics
            .params
            .iter()
            .any(|parameter| matches!(parameter, GenericParam::Type(parameter) if parameter.ident == *ident));
        if parameter {
            return Some(Scalar::Parameter(ident.clone()));
        }
    }
    if last.ident == "f32" {
        Some(Scalar::F32)
    } else if last.ident == "f64" {
        Some(Scalar::F64)
    } else {
        None
    }
}

/// The type arguments of a segment.
fn types(segment: &PathSegment) -> impl Iterator<Item = &Type> {
    arguments(segment).into_iter().flat_map(|arguments| arguments.args.iter()).filter_map(|argument| match argument {
        GenericArgument::Type(ty) => Some(ty),
        _ => None,
    })
}

fn arguments(segment: &PathSegment) -> Option<&AngleBracketedGenericArguments> {
    match &segment.arguments {
        PathArguments::AngleBracketed(arguments) => Some(arguments),
        _ => None,
    }
}

/// The type without parentheses and without the invisible groups of `macro_rules!`.
fn bare(ty: &Type) -> &Type {
    match ty {
        Type::Group(group) => bare(&group.elem),
        Type::Paren(paren) => bare(&paren.elem),
        other => other,
    }
}
