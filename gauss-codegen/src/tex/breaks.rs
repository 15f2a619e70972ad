//! Places where a formula may be broken: before signs of a sum, between factors, inside brackets, which then have a
//! fixed size; a long fraction becomes a product or a quotient in one line, a long root a power.

use super::read::{Piece, PieceKind};
use super::width::{bracket, fractions, width, width_of};

/// Part of a formula that stays in one line.
#[derive(Clone, Debug)]
pub struct FormulaPart {
    pub tex: String,
    pub width: f64,
    /// Joint between it and the part before it in one line.
    pub joint: PartJoint,
    /// Brackets that are open where it begins.
    pub level: usize,
    /// It begins a line: the first part of a term that is longer than one.
    pub begins: bool,
}

/// Joints between two parts in one line, and the begin of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartJoint {
    /// A sign of a sum, which the part begins with, or a sign of equality.
    Sign,
    /// `\,`; a line begins with `\cdot`.
    Product,
    /// Nothing, as after a comma.
    Nothing,
}

impl PartJoint {
    /// In one line.
    pub fn within(self) -> (&'static str, f64) {
        match self {
            PartJoint::Sign => (" ", 2.3),
            PartJoint::Product => (" \\, ", 3.4),
            PartJoint::Nothing => (" ", 1.7),
        }
    }

    /// At the begin of a line.
    pub fn at_begin(self) -> (&'static str, f64) {
        match self {
            PartJoint::Product => (" \\cdot ", 7.4),
            PartJoint::Sign => (" ", 2.3),
            PartJoint::Nothing => (" ", 0.0),
        }
    }
}

/// Indentation of continuations: one `\quad` and one for each open bracket, up to this.
pub const DEEPEST: usize = 6;
pub const QUAD: f64 = 10.1;

/// Text before and after a formula without a break.
#[derive(Clone, Default)]
struct SurroundingText {
    before: String,
    after: String,
    width: [f64; 2],
}

/// Parts of a formula, none wider than a line of that room, as far as it can be broken.
pub fn parts(row: &[Piece<'_>], room: f64) -> Vec<FormulaPart> {
    let mut breaker = Breaker { room, parts: Vec::new() };
    breaker.sum(row, 0, PartJoint::Sign, &SurroundingText::default());
    breaker.parts
}

struct Breaker {
    /// Room of a line that is not indented.
    room: f64,
    parts: Vec<FormulaPart>,
}

/// Terms of a sum with their signs; items of a list with their commas.
fn terms<'p, 'a>(row: &'p [Piece<'a>]) -> Vec<&'p [Piece<'a>]> {
    let mut ends = Vec::new();
    for (k, piece) in row.iter().enumerate() {
        let sign = matches!(piece.kind, PieceKind::Sign | PieceKind::Equals);
        if sign && k > 0 && !matches!(row[k - 1].kind, PieceKind::Sign | PieceKind::Equals | PieceKind::Times) {
            ends.push(k);
        }
        if matches!(piece.kind, PieceKind::Comma) {
            ends.push(k + 1);
        }
    }
    cut(row, ends)
}

/// Factors of a product, without what is between them.
fn factors<'p, 'a>(term: &'p [Piece<'a>]) -> Vec<&'p [Piece<'a>]> {
    term.split(|piece| matches!(piece.kind, PieceKind::Thin)).filter(|factor| !factor.is_empty()).collect()
}

fn cut<'p, 'a>(row: &'p [Piece<'a>], ends: Vec<usize>) -> Vec<&'p [Piece<'a>]> {
    let mut begin = 0;
    let mut out = Vec::new();
    for end in ends.into_iter().chain([row.len()]) {
        if end > begin {
            out.push(&row[begin..end]);
        }
        begin = end;
    }
    out
}

/// Text that pieces are read from, with the spaces between them.
fn tex(row: &[Piece<'_>]) -> String {
    let mut out = String::new();
    for piece in row {
        if piece.spaced && !out.is_empty() {
            out.push(' ');
        }
        out.push_str(piece.tex);
    }
    out
}

impl Breaker {
    /// Room of a line in so many brackets.
    fn room(&self, level: usize) -> f64 {
        self.room - QUAD * level.min(DEEPEST) as f64
    }

    fn push(&mut self, tex: &str, width: f64, (joint, level): (PartJoint, usize), around: &SurroundingText) {
        let tex = format!("{}{tex}{}", around.before, around.after);
        let width = around.width[0] + width + around.width[1];
        self.parts.push(FormulaPart { tex, width, joint, level, begins: false });
    }

    fn sum(&mut self, row: &[Piece<'_>], level: usize, joint: PartJoint, around: &SurroundingText) {
        let terms = terms(row);
        let count = terms.len();
        if row.is_empty() {
            return self.push("", 0.0, (joint, level), around);
        }
        for (k, term) in terms.into_iter().enumerate() {
            let own = ends_of(around, k == 0, k + 1 == count);
            let after_comma = k > 0 && !matches!(term[0].kind, PieceKind::Sign | PieceKind::Equals);
            let joint = match (k, after_comma) {
                (0, _) => joint,
                (_, true) => PartJoint::Nothing,
                (_, false) => PartJoint::Sign,
            };
            let begin = self.parts.len();
            // Signs have what is written after them on both sides.
            if width(term) + 4.6 + own.width[0] + own.width[1] <= self.room(level) {
                self.push(&tex(term), width(term) + 4.6, (joint, level), &own);
            } else {
                self.product(term, level, joint, &own);
                self.parts[begin..].iter_mut().take(1).for_each(|part| part.begins = true);
            }
        }
    }

    fn product(&mut self, term: &[Piece<'_>], level: usize, joint: PartJoint, around: &SurroundingText) {
        let sign = usize::from(matches!(term[0].kind, PieceKind::Sign | PieceKind::Equals));
        let mut around = around.clone();
        if sign == 1 {
            around.before = format!("{}{} ", around.before, term[0].tex);
            around.width[0] += 12.4;
        }
        let factors = factors(&term[sign..]);
        let count = factors.len();
        if count == 0 {
            return self.push("", 0.0, (joint, level), &around);
        }
        let mut joint = joint;
        let mut begin = 0;
        while begin < count {
            // As many as there is room for; a long one takes the short ones before it.
            let fits = |end: usize| {
                let sum: f64 = factors[begin..end].iter().map(|factor| width(factor) + 3.4).sum();
                let own = ends_of(&around, begin == 0, end == count);
                own.width[0] + sum + own.width[1] <= self.room(level)
            };
            let end = (begin..=count).rev().find(|&end| end == begin || fits(end)).unwrap_or(begin);
            let mut own = ends_of(&around, begin == 0, end >= count);
            let short: Vec<String> = factors[begin..end].iter().map(|factor| tex(factor)).collect();
            let short_width: f64 = factors[begin..end].iter().map(|factor| width(factor) + 3.4).sum();
            let next_is_long = end < count && width(factors[end]) > self.room(level) / 2.0;
            // What stands before a bracket must leave room for what is in it.
            let leaves_room = ends_of(&around, begin == 0, false).width[0] + short_width < self.room(level) / 2.0;
            if end == count || (end > begin && !(next_is_long && leaves_room)) {
                self.push(&short.join(" \\, "), short_width, (joint, level), &own);
                begin = end;
            } else {
                own = ends_of(&around, begin == 0, end + 1 == count);
                if end > begin {
                    own.before = format!("{}{} \\, ", own.before, short.join(" \\, "));
                    own.width[0] += short_width;
                }
                self.factor(factors[end], level, joint, &own);
                begin = end + 1;
            }
            joint = PartJoint::Product;
        }
    }

    /// One that does not fit: its last piece is what is broken.
    fn factor(&mut self, factor: &[Piece<'_>], level: usize, joint: PartJoint, around: &SurroundingText) {
        let broken = factor.iter().rposition(|piece| {
            matches!(piece.kind, PieceKind::Bracket { .. } | PieceKind::Fraction(_) | PieceKind::Root(_))
        });
        let Some(at) = broken else {
            return self.push(&tex(factor), width(factor), (joint, level), around);
        };
        let mut around = around.clone();
        if at > 0 {
            around.before = format!("{}{}", around.before, tex(&factor[..at]));
            around.width[0] += width(&factor[..at]) + 1.7;
        }
        if at + 1 < factor.len() {
            around.after = format!(" {}{}", tex(&factor[at + 1..]), around.after);
            around.width[1] += width(&factor[at + 1..]) + 1.7;
        }
        let piece = &factor[at];
        match &piece.kind {
            PieceKind::Bracket { open, inside, close } => {
                let scripts = (piece.scripts.to_owned(), width_of(piece) - width(inside) - 2.0 * bracket(inside));
                self.bracket(inside, [open, close], scripts, (level, joint), &around);
            }
            PieceKind::Root(inside) => {
                let power = piece.above.iter().map(|piece| piece.tex).collect::<String>();
                let half = if power.is_empty() { "^{1/2}".to_owned() } else { format!("^{{{}/2}}", power.trim()) };
                self.bracket(inside, ["(", ")"], (half, 16.0 + width(&piece.above)), (level, joint), &around);
            }
            PieceKind::Fraction(parts) => self.fraction(parts, level, joint, &around),
            _ => self.push(&tex(&factor[at..=at]), width(&factor[at..=at]), (joint, level), &around),
        }
    }

    fn bracket(
        &mut self,
        inside: &[Piece<'_>],
        [open, close]: [&str; 2],
        (scripts, scripts_width): (String, f64),
        (level, joint): (usize, PartJoint),
        around: &SurroundingText,
    ) {
        let size = ["big", "bigg", "Bigg"][fractions(inside).min(2)];
        let mut own = around.clone();
        own.before = format!("{}\\{size}l{open}", own.before);
        own.after = format!("\\{size}r{close}{scripts}{}", own.after);
        own.width[0] += bracket(inside);
        own.width[1] += bracket(inside) + scripts_width;
        self.sum(inside, level + 1, joint, &own);
    }

    /// A product with the reciprocal of a short denominator, else a quotient of brackets.
    fn fraction(
        &mut self,
        [above, below]: &[Vec<Piece<'_>>; 2],
        level: usize,
        joint: PartJoint,
        around: &SurroundingText,
    ) {
        if width(below) <= self.room(level) / 2.0 {
            let mut own = around.clone();
            own.before = format!("{}\\frac{{1}}{{{}}} \\, ", own.before, tex(below));
            own.width[0] += width(below) + 7.6;
            return self.grouped(above, level, joint, &own);
        }
        let first = SurroundingText { after: String::new(), width: [around.width[0], 0.0], ..around.clone() };
        self.grouped(above, level, joint, &first);
        let second = SurroundingText {
            before: "\\big/ ".to_owned(),
            after: around.after.clone(),
            width: [9.0, around.width[1]],
        };
        self.grouped(below, level, PartJoint::Nothing, &second);
    }

    /// In brackets where it is a sum; in brackets of its own where it is a product behind a stroke.
    fn grouped(&mut self, row: &[Piece<'_>], level: usize, joint: PartJoint, around: &SurroundingText) {
        let sum = terms(row).len() > 1;
        let behind = around.before.ends_with("/ ") && factors(row).len() > 1;
        if sum || behind {
            self.bracket(row, ["(", ")"], (String::new(), 0.0), (level, joint), around);
        } else if width(row) + around.width[0] + around.width[1] <= self.room(level) {
            self.push(&tex(row), width(row), (joint, level), around);
        } else {
            self.product(row, level, joint, around);
        }
    }
}

/// Text around one part of a sequence: the text before it at its first part, and after it at its last.
fn ends_of(around: &SurroundingText, first: bool, last: bool) -> SurroundingText {
    let mut own = around.clone();
    if !first {
        own.before.clear();
        own.width[0] = 0.0;
    }
    if !last {
        own.after.clear();
        own.width[1] = 0.0;
    }
    own
}
