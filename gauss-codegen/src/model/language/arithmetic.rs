//! Rust expressions → [`Expression`]s.
//!
//! syn reads the Rust; what is left once the forms outside the language are refused is small. All of them are noted,
//! not only the first.

use super::context::Context;
use super::functions::{FUNCTIONS, FunctionCall, PROPERTIES};
use super::words::{self, INPUT};
use super::{attributes, chains, nesting};
use crate::model::scene::clauses::Coefficients;
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName};
use crate::terms::number;
use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::punctuated::Punctuated;
use syn::{
    BinOp, Expr, ExprArray, ExprBinary, ExprCall, ExprField, ExprGroup, ExprIndex, ExprMethodCall, ExprParen, Lit,
    Member, Token, UnOp,
};

/// Parts of expressions that there are, for messages about those that there are not.
pub const ALLOWED: &str = "expressions are made of numbers, names, `+ - * /`, brackets, vectors `[a, b, c]`, \
     components `a.x` or `a[0]`, positions and rotations such as `arm.position`, and the functions sin, cos, tan, exp, \
     ln, sqrt, powi, powf, asin, acos, atan, tanh, atan2, dot, cross, rotation_x, rotation_y, rotation_z, inverse, twist, rate, abs, min, max, hypot, \
     signum, clamp and smooth_step";

/// More factors than any law of forces has.
pub const LARGEST_EXPONENT: u32 = 100;

/// Message about powers of more.
pub fn too_many_factors() -> String {
    format!("powers become products, of {LARGEST_EXPONENT} factors at most; write `powf`")
}

/// Reads the tokens that `owner` is said to be.
pub fn read(owner: &str, tokens: &[TokenTree], context: &mut Context) -> Option<Expression> {
    let expression = convert(&parse(owner, tokens, context)?, context)?;
    if nesting::depth(&expression, &|_| 0) > nesting::LEVELS {
        context.error(expression.span, nested(owner));
        return None;
    }
    Some(expression)
}

fn nested(owner: &str) -> String {
    format!(
        "`{owner}` is nested more than {} levels deep; name parts of it by `define(…)`, or write it with fewer",
        nesting::DEEPEST
    )
}

/// Whether the tokens are `[xx, xy, xz, yy, yz, zz]`.
pub fn is_list_of_six(tokens: &[TokenTree]) -> bool {
    match attributes::flat(tokens.iter().cloned().collect()).as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => {
            attributes::pieces(group.stream(), "", &mut Context::default()).len() == 6
        }
        _ => false,
    }
}

/// Reads the tokens of six coefficients, called `what` in messages: a list of six, or the name of a field.
pub fn read_coefficients(owner: &str, what: &str, tokens: &[TokenTree], context: &mut Context) -> Option<Coefficients> {
    const REMEDY: &str = "write six scalars `[a, b, c, d, e, f]` in the order (u, ω), or the name of a field that is a \
         `Vector6` or a `Matrix6`";
    let parsed = parse(owner, tokens, context)?;
    let mut bare = &parsed;
    while let Expr::Group(ExprGroup { expr, .. }) | Expr::Paren(ExprParen { expr, .. }) = bare {
        bare = expr;
    }
    match bare {
        Expr::Array(array) => {
            let entries: Vec<_> = array.elems.iter().map(|entry| convert(entry, context)).collect();
            let count = entries.len();
            let entries: Vec<Expression> = entries.into_iter().collect::<Option<_>>()?;
            match <[Expression; 6]>::try_from(entries) {
                Ok(entries) => return Some(Coefficients::Diagonal(entries.map(Box::new))),
                Err(_) => {
                    context.error(array.bracket_token.span.open(), format!("{what} six, found {count}; {REMEDY}"))
                }
            }
        }
        Expr::Path(path) if path.qself.is_none() && path.path.get_ident().is_some() => {
            return path.path.get_ident().cloned().map(Coefficients::Field);
        }
        other => context.error(
            other.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| attributes::start(&token)),
            format!("{what} six, one for each component; {REMEDY}"),
        ),
    }
    None
}

/// Reads the tokens of one scalar, or of a list `[a, b]` of one or two.
pub fn read_one_or_two(
    owner: &str,
    (of, example): (&str, [&str; 2]),
    tokens: &[TokenTree],
    context: &mut Context,
) -> Option<Vec<Expression>> {
    let flat = attributes::flat(tokens.iter().cloned().collect());
    let [TokenTree::Group(group)] = flat.as_slice() else {
        return read(owner, tokens, context).map(|expression| vec![expression]);
    };
    if group.delimiter() != Delimiter::Bracket {
        return read(owner, tokens, context).map(|expression| vec![expression]);
    }
    let pieces = attributes::pieces(group.stream(), "", context);
    if !matches!(pieces.len(), 1 | 2) {
        let message = format!(
            "`{owner}` is one {of}, found {}; write `{owner} = {}` or `{owner} = {}`",
            pieces.len(),
            example[0],
            example[1]
        );
        context.error(group.span_open(), message);
        return None;
    }
    let read: Vec<_> = pieces.iter().map(|piece| read(owner, piece, context)).collect();
    read.into_iter().collect()
}

fn parse(owner: &str, tokens: &[TokenTree], context: &mut Context) -> Option<Expr> {
    if let Some(span) = nesting::too_deep(tokens.iter().cloned().collect()) {
        context.error(span, nested(owner));
        return None;
    }
    match syn::parse2::<Expr>(tokens.iter().cloned().collect::<TokenStream>()) {
        Ok(expression) => Some(expression),
        Err(error) => {
            let text = error.to_string();
            if text.starts_with("unexpected end of input") {
                let last = tokens.last().map_or_else(Span::call_site, |token| match token {
                    TokenTree::Group(group) => group.span_close(),
                    other => other.span(),
                });
                context.error(last, format!("the expression of `{owner}` breaks off here; write its other part"));
            } else if let Some((point, digits)) = point_without_zero(tokens.iter().cloned()) {
                context
                    .error(point, format!("a number begins with a digit; write `0.{digits}` in place of `.{digits}`"));
            } else {
                context.error(error.span(), format!("`{owner}` is no expression: {text}; {ALLOWED}"));
            }
            None
        }
    }
}

/// The first number like `.5`, at its point, with its digits.
fn point_without_zero(tokens: impl IntoIterator<Item = TokenTree>) -> Option<(Span, String)> {
    let (mut point, mut is_after_operand) = (None, false);
    for token in tokens {
        let found = match (&token, point) {
            (TokenTree::Literal(digits), Some(span)) => Some((span, digits.to_string())),
            (TokenTree::Group(group), _) => point_without_zero(group.stream()),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
        (point, is_after_operand) = match &token {
            // The second point of a range is none of a number.
            TokenTree::Punct(sign) if sign.as_char() == '.' => ((!is_after_operand).then(|| sign.span()), true),
            TokenTree::Punct(_) => (None, false),
            _ => (None, true),
        };
    }
    None
}

fn convert(expression: &Expr, context: &mut Context) -> Option<Expression> {
    let (kind, span) = match expression {
        Expr::Group(group) => return convert(&group.expr, context),
        Expr::Paren(paren) => return convert(&paren.expr, context),
        Expr::Lit(literal) => (literal_number(&literal.lit, context)?, literal.lit.span()),
        Expr::Path(path) => match path.path.get_ident() {
            Some(name) if path.qself.is_none() => (ExpressionKind::Name(name.clone()), name.span()),
            _ if path.path.segments.last().is_some_and(|last| last.ident == "PI") => {
                context.error_at(&path.path, "π is `pi` in expressions; write `pi`");
                return None;
            }
            _ => return refuse(expression, "a path", context),
        },
        Expr::Unary(unary) => match unary.op {
            UnOp::Neg(minus) => (ExpressionKind::Negate(Box::new(convert(&unary.expr, context)?)), minus.spans[0]),
            UnOp::Deref(star) => {
                context.error(
                    star.spans[0],
                    "nothing stands before this `*`; a product is written `a * b`, a power `powi(a, 2)`",
                );
                return None;
            }
            _ => return refuse(expression, "`!`", context),
        },
        Expr::Binary(binary) => return convert_binary(binary, context),
        Expr::Array(array) => return vector(array, context),
        Expr::Field(field) => return member(field, context),
        Expr::Index(index) => return component(index, context),
        Expr::Call(call) => return convert_call(call, context),
        Expr::MethodCall(call) => return convert_method(call, context),
        Expr::Cast(cast) => return refuse(cast.as_token, "`as`", context),
        Expr::Range(range) => {
            context.error_at(range.limits, format!("a range is outside the language of expressions; {ALLOWED}"));
            return None;
        }
        Expr::Assign(assign) => {
            context.error(assign.eq_token.spans[0], format!("a second `=` has no meaning here; {ALLOWED}"));
            return None;
        }
        Expr::If(_) => return refuse(expression, "`if`", context),
        Expr::Match(_) => return refuse(expression, "`match`", context),
        Expr::Closure(_) => return refuse(expression, "a closure", context),
        Expr::Block(_) => return refuse(expression, "a block", context),
        Expr::Tuple(_) => return refuse(expression, "a tuple", context),
        Expr::Macro(_) => return refuse(expression, "a macro", context),
        Expr::Reference(_) => return refuse(expression, "a reference", context),
        Expr::Repeat(_) => return refuse(expression, "a repeated component", context),
        Expr::Struct(_) => return refuse(expression, "a struct", context),
        Expr::Try(question) => return refuse(question.question_token, "`?`", context),
        other => return refuse(other, "this form", context),
    };
    Some(Expression { kind, span })
}

/// Notes a form outside the language, at its first token.
fn refuse(tokens: impl ToTokens, form: &str, context: &mut Context) -> Option<Expression> {
    let span = tokens.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| match token {
        TokenTree::Group(group) => group.span_open(),
        other => other.span(),
    });
    context.error(span, format!("{form} is outside the language of expressions; {ALLOWED}"));
    None
}

fn literal_number(literal: &Lit, context: &mut Context) -> Option<ExpressionKind> {
    let (digits, suffix) = match literal {
        Lit::Int(number) => (number.base10_digits(), number.suffix()),
        Lit::Float(number) => (number.base10_digits(), number.suffix()),
        other => {
            let message = format!("`{}` is no number; {ALLOWED}", other.to_token_stream());
            context.error(other.span(), message);
            return None;
        }
    };
    if !matches!(suffix, "" | "f32" | "f64") {
        context.error(
            literal.span(),
            format!(
                "`{}` counts in `{suffix}`, but expressions are real numbers; write `{digits}`",
                literal.to_token_stream()
            ),
        );
        return None;
    }
    match number::exact(digits) {
        Some(value) => Some(ExpressionKind::Number { value, twin: None }),
        None => {
            context.error(
                literal.span(),
                format!(
                    "`{}` is beyond the range of double precision, which is from 1e-308 to 1e308",
                    literal.to_token_stream()
                ),
            );
            None
        }
    }
}

/// A chain of operators, which syn nests to the left: `a + b + c` is `(a + b) + c`.
fn convert_binary(binary: &ExprBinary, context: &mut Context) -> Option<Expression> {
    let (mut first, mut chain) = (&*binary.left, vec![binary]);
    while let Expr::Binary(inner) = first {
        chain.push(inner);
        first = &inner.left;
    }
    let first = convert(first, context);
    let links: Vec<Option<chains::Link>> = chain.into_iter().rev().map(|link| convert_link(link, context)).collect();
    Some(chains::joined(first?, links.into_iter().collect::<Option<_>>()?))
}

/// An operator and what comes after it.
fn convert_link(binary: &ExprBinary, context: &mut Context) -> Option<chains::Link> {
    let (operator, span) = match &binary.op {
        BinOp::Add(plus) => (Some(BinaryOperator::Add), plus.spans[0]),
        BinOp::Sub(minus) => (Some(BinaryOperator::Subtract), minus.spans[0]),
        BinOp::Mul(star) => (Some(BinaryOperator::Multiply), star.spans[0]),
        BinOp::Div(slash) => (Some(BinaryOperator::Divide), slash.spans[0]),
        BinOp::BitXor(caret) => {
            context.error(caret.spans[0], "`^` is no power; write `powi(a, 2)`");
            (None, caret.spans[0])
        }
        other => {
            let text = other.to_token_stream().to_string();
            context.error_at(other, format!("`{text}` is outside the language of expressions; {ALLOWED}"));
            (None, Span::call_site())
        }
    };
    let right = convert(&binary.right, context);
    let (operator, right) = (operator?, right?);
    if operator == BinaryOperator::Divide && right.is_zero() {
        context.error(right.span, "division by zero");
        return None;
    }
    Some((operator, span, right))
}

fn vector(array: &ExprArray, context: &mut Context) -> Option<Expression> {
    let components: Vec<_> = array.elems.iter().map(|element| convert(element, context)).collect();
    let span = array.bracket_token.span.open();
    let count = components.len();
    let components: Vec<_> = components.into_iter().collect::<Option<_>>()?;
    match <[Expression; 3]>::try_from(components) {
        Ok(components) => Some(Expression { kind: ExpressionKind::Vector(components.map(Box::new)), span }),
        Err(_) => {
            let remedy = match count {
                2 => "; in a plane write `[x, y, 0]`",
                4 => {
                    "; a rotation by a quaternion is one coordinate, `coordinates(turn: Rotation)` with `rotation = turn`"
                }
                6 => {
                    "; six of a wrench are two vectors, `wrench(body = …, force = [fx, fy, fz], torque = [mx, my, mz])`"
                }
                _ => "",
            };
            context.error(span, format!("a vector has three components, found {count}{remedy}"));
            None
        }
    }
}

/// `a.x`, `arm.position`.
fn member(field: &ExprField, context: &mut Context) -> Option<Expression> {
    if let Expr::Path(base) = &*field.base
        && base.path.is_ident("self")
    {
        let name = field.member.to_token_stream();
        context.error_at(&base.path, format!("expressions name fields without `self`; write `{name}`"));
        return None;
    }
    let base = convert(&field.base, context);
    let name = match &field.member {
        Member::Named(name) => name,
        Member::Unnamed(index) => {
            context.error(
                index.span,
                format!("`.{}` is no component; write `[0]`, `[1]` or `[2]`, or `.x`, `.y` or `.z`", index.index),
            );
            return None;
        }
    };
    let word = name.unraw().to_string();
    let kind = if let Some(index) = ["x", "y", "z"].iter().position(|component| *component == word) {
        ExpressionKind::Component(Box::new(base?), index)
    } else if let Some(&(_, property)) = PROPERTIES.iter().find(|(known, _)| *known == word) {
        ExpressionKind::Property(Box::new(base?), property)
    } else if matches!(&*field.base, Expr::Path(base) if base.path.is_ident(INPUT)) {
        ExpressionKind::Input(name.clone())
    } else {
        let message = if FUNCTIONS.iter().any(|(function, _)| *function == word) {
            format!("the function `{word}` needs brackets; write `.{word}()`")
        } else if let Some((near, _)) = words::nearest(&word, PROPERTIES) {
            format!("there is no `.{word}`; did you mean `.{near}`?")
        } else {
            format!(
                "there is no `.{word}`; the components of a vector are `.x`, `.y` and `.z`, bodies have `.position`, \
                 `.rotation`, `.velocity`, `.angular_velocity`, `.body_velocity`, `.body_angular_velocity` and \
                 `.relative_velocity`, and inputs that are wrenches have `.force` and `.torque`"
            )
        };
        context.error(name.span(), message);
        return None;
    };
    Some(Expression { kind, span: name.span() })
}

/// `a[0]`.
fn component(expression: &ExprIndex, context: &mut Context) -> Option<Expression> {
    let base = convert(&expression.expr, context);
    let index = match integer(&expression.index) {
        Some(index @ 0..=2) => usize::try_from(index).ok(),
        _ => {
            context.error_at(&expression.index, "a vector has the components 0, 1 and 2; write `[0]`, `[1]` or `[2]`");
            None
        }
    };
    let span = expression.bracket_token.span.open();
    Some(Expression { kind: ExpressionKind::Component(Box::new(base?), index?), span })
}

/// An integer literal, with its sign, in whatever groups.
fn integer(expression: &Expr) -> Option<i32> {
    match expression {
        Expr::Group(group) => integer(&group.expr),
        Expr::Paren(paren) => integer(&paren.expr),
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(number) if matches!(number.suffix(), "" | "i32") => number.base10_parse().ok(),
            _ => None,
        },
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => integer(&unary.expr).map(i32::wrapping_neg),
        _ => None,
    }
}

/// `sin(a)`.
fn convert_call(call: &ExprCall, context: &mut Context) -> Option<Expression> {
    let path = match &*call.func {
        Expr::Path(path) if path.qself.is_none() => &path.path,
        other => return refuse(other, "a call of anything but a function", context),
    };
    match path.get_ident() {
        Some(name) => apply(name, None, &call.args, context),
        None => {
            let segments: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
            let arguments = call.args.to_token_stream();
            match segments.as_slice() {
                [.., ty, new] if ty == "Vector3" && new == "new" => {
                    context.error_at(path, format!("vectors are written in square brackets; write `[{arguments}]`"));
                }
                [.., function] if FUNCTIONS.iter().any(|(word, _)| word == function) => {
                    context.error_at(path, format!("functions are called by their own names; write `{function}(…)`"));
                }
                _ => context.error_at(path, format!("a path is outside the language of expressions; {ALLOWED}")),
            }
            None
        }
    }
}

/// `a.sin()`.
fn convert_method(call: &ExprMethodCall, context: &mut Context) -> Option<Expression> {
    if let Some(turbofish) = &call.turbofish {
        context.error_at(turbofish, "functions of expressions take no types; remove them");
    }
    let word = call.method.unraw().to_string();
    if call.args.is_empty() && PROPERTIES.iter().any(|(property, _)| *property == word) {
        context.error(call.method.span(), format!("`{word}` is no function; write `.{word}` without brackets"));
        return None;
    }
    if ["float64", "float32", "int64", "int32"].contains(&word.as_str()) {
        let told = format!(
            "NumPy prints its numbers as `np.{word}(…)`; write those of Python: `{{float(x)}}`, `{{x.tolist()}}`"
        );
        context.error(call.method.span(), told);
        return None;
    }
    apply(&call.method, Some(&call.receiver), &call.args, context)
}

/// A function of its arguments; those of a method follow the value that it is called on.
fn apply(
    name: &Ident,
    receiver: Option<&Expr>,
    arguments: &Punctuated<Expr, Token![,]>,
    context: &mut Context,
) -> Option<Expression> {
    let written: Vec<&Expr> = receiver.into_iter().chain(arguments).collect();
    if !written.is_empty() && !FUNCTIONS.iter().any(|(word, _)| name == word) {
        // Whether some clause declares it, and of how many numbers, is known with the other names.
        let arguments: Vec<_> = written.iter().map(|argument| convert(argument, context)).collect();
        let arguments = arguments.into_iter().collect::<Option<_>>()?;
        return Some(Expression { kind: ExpressionKind::Own(name.clone(), arguments), span: name.span() });
    }
    let function = words::resolve("function", name, FUNCTIONS, context).ok();
    // What stands after the base of a power is an exponent, which has rules of its own.
    let values = if function == Some(FunctionCall::Power) { written.get(..1).unwrap_or_default() } else { &written };
    let values: Vec<_> = values
        .iter()
        .map(|value| match value {
            // Vector libraries have `a.dot(&b)`.
            Expr::Reference(reference) if function.is_some_and(|f| f.arguments() > 1) => {
                convert(&reference.expr, context)
            }
            value => convert(value, context),
        })
        .collect();
    let function = function?;
    if written.len() != function.arguments() {
        let takes = match function.arguments() {
            1 => "one argument",
            2 => "two arguments",
            _ => "three arguments",
        };
        let before = match receiver {
            Some(Expr::Path(path)) if written.len() > function.arguments() => {
                path.path.get_ident().map(|own| format!(" (`{own}` before the dot is one)"))
            }
            _ => None,
        };
        context.error(
            name.span(),
            format!(
                "`{name}` takes {takes}, found {}{}; write `{}`",
                written.len(),
                before.unwrap_or_default(),
                function.example()
            ),
        );
        return None;
    }
    let values: Vec<Expression> = values.into_iter().collect::<Option<_>>()?;
    let kind = match function {
        FunctionCall::Named(function) => {
            if let Some((span, message)) = wrong_limits(function, &values) {
                context.error(span, message);
                return None;
            }
            ExpressionKind::Call(function, values)
        }
        FunctionCall::Power => power(values.into_iter().next()?, written.get(1)?, context)?,
    };
    Some(Expression { kind, span: name.span() })
}

/// A power with an exponent that is a literal.
fn power(base: Expression, exponent: &Expr, context: &mut Context) -> Option<ExpressionKind> {
    let Some(power) = integer(exponent) else {
        context.error_at(
            exponent,
            "the exponent of `powi` is an integer literal, such as 2 or -1; for other powers write `powf`",
        );
        return None;
    };
    if power.unsigned_abs() > LARGEST_EXPONENT {
        context.error_at(exponent, too_many_factors());
        return None;
    }
    if power < 0 && base.is_zero() {
        context.error(base.span, "division by zero");
        return None;
    }
    Some(ExpressionKind::Power(Box::new(base), power))
}

/// Mistake in limits that are literals, and its place.
fn wrong_limits(function: FunctionName, values: &[Expression]) -> Option<(Span, &'static str)> {
    let [_, low, high] = values else { return None };
    let (a, b) = low.literal().zip(high.literal())?;
    let message = match function {
        FunctionName::SmoothStep if a == b => "a smooth step has two ends; write different numbers",
        FunctionName::Clamp if a > b => "the lower limit is above the upper limit; exchange the two",
        _ => return None,
    };
    Some((low.span, message))
}
