//! Equations as `align*` environments, no line wider than a page of 16 cm.

use super::breaks::{DEEPEST, FormulaPart, PartJoint, QUAD, parts};
use super::read::{PieceKind, read};
use super::width::width;

/// A page's text, in points: 16 cm, and one point less.
const PAGE: f64 = 454.2;
/// Left sides that are wider, or sums, do not stand before the others' signs of equality.
const LEFT: f64 = 110.0;
/// `=` with its spaces.
const EQUALS: f64 = 13.4;
/// Lines of one `align*`: TeX sets it as a whole, and no box is higher than 5.7 m.
const LINES: usize = 100;

/// Headings, each with its equations `left = right`.
pub fn environments(sections: &[(String, Vec<String>)]) -> String {
    let mut lines = Vec::new();
    let equations: Vec<(&str, Vec<Sides<'_>>)> = sections
        .iter()
        .map(|(title, equations)| (title.as_str(), equations.iter().map(|equation| Sides::of(equation)).collect()))
        .collect();
    let left = equations.iter().flat_map(|(_, equations)| equations).filter(|sides| sides.aligned);
    let left = left.map(|sides| sides.width).fold(0.0, f64::max);
    for (title, equations) in &equations {
        if let Some(last) = lines.last_mut() {
            *last = format!("{last} \\\\[1ex]");
        }
        lines.extend(titled(title, PAGE - left));
        lines.extend(equations.iter().flat_map(|sides| sides.lines(PAGE - left)));
    }
    let ended = |line: String| if line.ends_with(']') && line.contains("\\\\[") { line } else { line + " \\\\" };
    let lines: Vec<String> = lines.into_iter().map(|line| ended(line) + "\n").collect();
    let environments =
        lines.chunks(LINES).map(|lines| format!("\\begin{{align*}}\n{}\\end{{align*}}\n", lines.concat()));
    environments.collect()
}

/// An equation.
struct Sides<'a> {
    left: &'a str,
    right: &'a str,
    /// Width of the left side.
    width: f64,
    /// The left side stands before the others' signs of equality.
    aligned: bool,
}

impl<'a> Sides<'a> {
    fn of(equation: &'a str) -> Self {
        let (left, right) = equation.split_once(" = ").unwrap_or(("", equation));
        let pieces = read(left);
        let width = width(&pieces);
        let is_sum = pieces.iter().any(|piece| matches!(piece.kind, PieceKind::Sign));
        Self { left, right, width, aligned: !left.is_empty() && !is_sum && width <= LEFT }
    }

    fn lines(&self, room: f64) -> Vec<String> {
        // Words in the place of an equation.
        let words = self.right.strip_prefix("\\text{").and_then(|rest| rest.strip_suffix('}'));
        if let Some(words) = words.filter(|words| self.left.is_empty() && !words.contains('}')) {
            return titled(words, room);
        }
        if self.aligned {
            // Continuations have one `\quad`, which is less than what is before the first part.
            let parts = parts(&read(self.right), room - EQUALS);
            return filled(&format!("{} &= ", self.left), EQUALS, &parts, room);
        }
        let mut all = Vec::new();
        if !self.left.is_empty() {
            all = parts(&read(self.left), room - QUAD);
        }
        let mut right = parts(&read(self.right), room - QUAD - EQUALS);
        if let Some(first) = right.first_mut().filter(|_| !self.left.is_empty()) {
            first.tex = format!("= {}", first.tex);
            first.width += EQUALS;
            first.begins = true;
        }
        let total: f64 = all.iter().chain(&right).map(|part| part.width + PartJoint::Sign.within().1).sum();
        if total <= room {
            all.iter_mut().chain(&mut right).for_each(|part| part.begins = false);
        }
        all.extend(right);
        filled("& ", 0.0, &all, room)
    }
}

/// Parts in as few lines as they fit in, which are as short as so many can be.
fn filled(begin: &str, begin_width: f64, parts: &[FormulaPart], room: f64) -> Vec<String> {
    let within = |limit: f64| line_begins(begin_width, parts, limit);
    let mut begins = within(room);
    let (mut too_small, mut large) = (0.0, room);
    for _ in 0..10 {
        let middle = f64::midpoint(too_small, large);
        let narrower = within(middle);
        let widest = parts.iter().map(|part| indentation(part).1 + part.width).fold(begin_width, f64::max);
        if narrower.len() <= begins.len() && widest <= middle {
            (begins, large) = (narrower, middle);
        } else {
            too_small = middle;
        }
    }
    let mut lines = vec![begin.to_owned()];
    for (k, part) in parts.iter().enumerate() {
        if begins.binary_search(&k).is_ok() {
            lines.push(format!("{}{}", indentation(part).0, part.tex.trim_start()));
        } else if let Some(line) = lines.last_mut() {
            line.push_str(if k == 0 { "" } else { part.joint.within().0 });
            line.push_str(&part.tex);
        }
    }
    lines.into_iter().map(|line| line.trim_end().to_owned()).collect()
}

/// Indentation of a line that begins with a part, and its width.
fn indentation(part: &FormulaPart) -> (String, f64) {
    let quads = 1 + part.level.min(DEEPEST);
    let (joint, space) = part.joint.at_begin();
    (format!("&{}{joint}", "\\quad".repeat(quads)), QUAD * quads as f64 + space)
}

/// Which parts further lines begin with, if none is wider than a limit.
fn line_begins(begin_width: f64, parts: &[FormulaPart], limit: f64) -> Vec<usize> {
    let mut begins = Vec::new();
    let mut width = begin_width;
    for (k, part) in parts.iter().enumerate() {
        let space = if k == 0 { 0.0 } else { part.joint.within().1 };
        if k > 0 && (part.begins || width + space + part.width > limit) {
            begins.push(k);
            width = indentation(part).1 + part.width;
        } else {
            width += space + part.width;
        }
    }
    begins
}

/// A heading, in as many lines as it takes: words with formulas between dollars.
fn titled(title: &str, room: f64) -> Vec<String> {
    let of = |words: &str| {
        let sizes = words.split('$').enumerate();
        let sizes = sizes.map(|(k, piece)| {
            let formula = if k % 2 == 0 { format!("\\text{{{piece}}}") } else { piece.to_owned() };
            width(&read(&formula))
        });
        sizes.sum::<f64>()
    };
    let mut lines = vec![String::new()];
    for word in words(title) {
        let last = lines.last_mut().map(std::mem::take).unwrap_or_default();
        let longer = if last.is_empty() { word.clone() } else { format!("{last} {word}") };
        if last.is_empty() || of(&longer) <= room {
            lines.pop();
            lines.push(longer);
        } else {
            lines.pop();
            lines.extend([last, word]);
        }
    }
    lines.into_iter().map(|line| format!("&\\text{{{line}}}")).collect()
}

/// Words, with formulas that are not broken.
fn words(title: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut open = false;
    for word in title.split(' ') {
        match words.last_mut().filter(|_| open) {
            Some(last) => *last = format!("{last} {word}"),
            None => words.push(word.to_owned()),
        }
        open ^= word.matches('$').count() % 2 == 1;
    }
    words
}
