//! Estimated widths of formulas, in points, at 10 pt in display style.

use super::letters::{command, italic, upright, variable};
use super::read::{Piece, PieceKind};

/// Sizes in TeX's four styles: formulas on their own lines, parts of their fractions, indices and powers, and theirs.
/// Letters of cmmi7 are 0.81 of those of cmmi10 in width, of cmmi5 0.70.
const SIZES: [f64; 4] = [1.0, 1.0, 0.82, 0.72];
/// `\thinmuskip`, `\medmuskip`, `\thickmuskip` beside their signs.
const THIN: f64 = 1.7;
const MEDIUM: f64 = 2.3;
const THICK: f64 = 2.8;
/// Width of + and −, and of =.
const SIGN: f64 = 7.8;
/// `\scriptspace`, and the rounding of widths of indices.
const AFTER_SCRIPTS: f64 = 0.8;
/// Part of the italic correction of a letter that is outside of its accent.
const BESIDE_ACCENT: f64 = 0.6;
/// Width that words lose by tenths of points.
const ROUNDED: f64 = 0.3;
/// `\nulldelimiterspace` on both sides of a fraction.
const BESIDE_FRACTION: f64 = 2.4;
/// Brackets around what has no fraction, fractions, fractions of fractions.
const BRACKETS: [f64; 3] = [4.6, 7.4, 9.1];
/// Brackets around letters with accents.
const AROUND_ACCENTS: f64 = 6.0;
/// A radical sign.
const RADICAL: f64 = 10.0;

/// Classes of signs that TeX puts space between.
#[derive(Clone, Copy, PartialEq)]
enum Class {
    /// Nothing yet.
    None,
    Ordinary,
    Function,
    Sign,
    Relation,
    /// Fractions, brackets that grow.
    Inner,
    Comma,
    /// A space that is written.
    Space,
}

/// Width of a formula.
pub fn width(row: &[Piece<'_>]) -> f64 {
    row_width(row, 0)
}

/// Width of one piece without what is beside it.
pub fn width_of(piece: &Piece<'_>) -> f64 {
    piece_width(piece, 0)
}

/// Width of brackets around a formula, one of two.
pub fn bracket(inside: &[Piece<'_>]) -> f64 {
    match fractions(inside) {
        0 if accented(inside) => AROUND_ACCENTS,
        deep => BRACKETS[deep.min(2)],
    }
}

fn accented(row: &[Piece<'_>]) -> bool {
    row.iter().any(|piece| match &piece.kind {
        PieceKind::Accent(_) => true,
        PieceKind::Row(inside) | PieceKind::Root(inside) | PieceKind::Bracket { inside, .. } => accented(inside),
        _ => false,
    })
}

/// Number of fractions that stand within one another.
pub fn fractions(row: &[Piece<'_>]) -> usize {
    let of = |piece: &Piece<'_>| match &piece.kind {
        PieceKind::Fraction([above, below]) => 1 + fractions(above).max(fractions(below)),
        PieceKind::Row(inside)
        | PieceKind::Root(inside)
        | PieceKind::Accent(inside)
        | PieceKind::Bracket { inside, .. } => fractions(inside),
        _ => 0,
    };
    row.iter().map(of).max().unwrap_or(0)
}

fn row_width(row: &[Piece<'_>], style: usize) -> f64 {
    let mut total = 0.0;
    let mut before = Class::None;
    for piece in row {
        let mut class = class_of(piece);
        // A space that is written adds to that between its neighbours.
        if class == Class::Space {
            total += piece_width(piece, style);
            continue;
        }
        // A sign with nothing before it is that of a number.
        if class == Class::Sign && !matches!(before, Class::Ordinary | Class::Inner) {
            class = Class::Ordinary;
        }
        total += between(before, class, style) + piece_width(piece, style);
        before = class;
    }
    total
}

fn class_of(piece: &Piece<'_>) -> Class {
    match &piece.kind {
        PieceKind::Sign | PieceKind::Times => Class::Sign,
        PieceKind::Equals => Class::Relation,
        PieceKind::Function(_) => Class::Function,
        PieceKind::Name(_) if piece.tex.starts_with("\\operatorname") => Class::Function,
        PieceKind::Fraction(_) | PieceKind::Bracket { .. } => Class::Inner,
        PieceKind::Comma => Class::Comma,
        PieceKind::Thin => Class::Space,
        _ => Class::Ordinary,
    }
}

fn between(before: Class, after: Class, style: usize) -> f64 {
    let large = |space: f64| if style < 2 { space } else { 0.0 };
    match (before, after) {
        (Class::None | Class::Space, _) | (_, Class::Space) => 0.0,
        (Class::Sign, _) | (_, Class::Sign) => large(MEDIUM),
        (Class::Relation, _) | (_, Class::Relation) => large(THICK),
        (Class::Function, _) | (_, Class::Function) => THIN,
        (Class::Inner | Class::Comma, _) | (_, Class::Inner) => large(THIN),
        _ => 0.0,
    }
}

fn piece_width(piece: &Piece<'_>, style: usize) -> f64 {
    let scale = SIZES[style];
    let own = match &piece.kind {
        PieceKind::Letter(sign) => scale * variable(*sign),
        PieceKind::Number(digits) => scale * upright(digits),
        PieceKind::Symbol(name) => scale * command(name),
        PieceKind::Sign | PieceKind::Equals => scale * SIGN,
        PieceKind::Times | PieceKind::Comma => scale * THICK,
        PieceKind::Thin => scale * THIN,
        PieceKind::Function(name) | PieceKind::Name(name) | PieceKind::Words(name) => scale * (upright(name) + ROUNDED),
        PieceKind::Italic(name) => scale * italic(name),
        PieceKind::Row(inside) => row_width(inside, style),
        PieceKind::Accent(inside) => row_width(inside, style) + BESIDE_ACCENT,
        PieceKind::Root(inside) => scale * RADICAL + row_width(inside, style),
        PieceKind::Bracket { inside, .. } => 2.0 * scale * bracket(inside) + row_width(inside, style),
        PieceKind::Fraction(parts) => {
            let [above, below] = [0, 1].map(|k| row_width(&parts[k], (style + 1).min(3)));
            above.max(below) + BESIDE_FRACTION
        }
        PieceKind::Other(sign) => scale * variable(*sign),
    };
    let smaller = if style < 2 { 2 } else { 3 };
    let primes = SIZES[smaller] * 2.9 * piece.primes as f64;
    let above = primes + row_width(&piece.above, smaller);
    let scripts = above.max(row_width(&piece.below, smaller));
    own + scripts + if scripts > 0.0 { AFTER_SCRIPTS } else { 0.0 }
}
