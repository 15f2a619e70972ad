//! Formulas in MathML, which browsers and rustdoc set without scripts, fonts or a network.
//!
//! Read from the LaTeX that the printer writes, so that names and formulas have one typeset form: braces, scripts,
//! fractions, roots, accents, brackets that grow, and letters. Any other LaTeX is shown as it is written.

/// The elements of a formula of `latex`, in math mode: what stands in `<math>…</math>`.
pub fn mathml(latex: &str) -> String {
    LatexReader { rest: latex }.row(End::Line)
}

/// Lines of equations, which stand in `align*` environments.
pub fn lines(latex: &str) -> impl Iterator<Item = &str> {
    let equations = latex.lines().filter(|line| !matches!(*line, "\\begin{align*}" | "\\end{align*}"));
    equations.map(|line| line.strip_suffix(" \\\\[1ex]").or(line.strip_suffix(" \\\\")).unwrap_or(line))
}

/// A line `left = a + b` with `&` before the sign of equality, as HTML that breaks before signs of outermost sums.
pub fn line(latex: &str) -> String {
    let (left, right) = latex.split_once('&').unwrap_or(("", latex));
    let (left, right) = (terms(left), terms(right));
    // A sum on the left breaks before the sign of equality, too; anything else stays with it.
    let (alone, with) = if left.len() > 1 { (&left[..], "") } else { (&left[..0], left[0]) };
    let first = format!("<math>{}{}</math>\n", mathml(with), mathml(right[0]));
    let set = |terms: &[&str]| terms.iter().map(|term| format!("<math>{}</math>\n", mathml(term))).collect::<String>();
    format!("{}{first}{}", set(alone), set(&right[1..]))
}

/// Words with formulas between dollars, as HTML.
pub fn words(text: &str) -> String {
    let piece = |(k, piece): (usize, &str)| match k % 2 {
        0 => escaped(&piece.replace("\\_", "_")),
        _ => format!("<math>{}</math>", mathml(piece)),
    };
    text.split('$').enumerate().map(piece).collect()
}

/// Text in HTML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The outermost sum in its terms, each with its sign.
pub(crate) fn terms(latex: &str) -> Vec<&str> {
    let (mut depth, mut begin, mut out) = (0_i32, 0, Vec::new());
    let bytes = latex.as_bytes();
    for at in 0..bytes.len() {
        let rest = &bytes[at..];
        match rest[0] {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            b'\\' if rest.starts_with(b"\\left") => depth += 1,
            b'\\' if rest.starts_with(b"\\right") => depth -= 1,
            b' ' if depth == 0 && (rest.starts_with(b" + ") || rest.starts_with(b" - ")) => {
                out.push(&latex[begin..at]);
                begin = at;
            }
            _ => {}
        }
    }
    out.push(&latex[begin..]);
    out
}

/// Ends of a row.
#[derive(Clone, Copy, PartialEq)]
enum End {
    Line,
    Brace,
    Right,
}

struct LatexReader<'a> {
    rest: &'a str,
}

/// Letters by their names.
const LETTERS: [(&str, &str); 38] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ϵ"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "ϕ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("varphi", "φ"),
    ("vartheta", "ϑ"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
    ("partial", "∂"),
    ("infty", "∞"),
    ("ell", "ℓ"),
];

/// Accents by their commands.
const ACCENTS: [(&str, &str); 3] = [("hat", "^"), ("dot", "˙"), ("ddot", "¨")];

/// Functions whose argument follows.
const FUNCTIONS: [&str; 14] = [
    "sin",
    "cos",
    "tan",
    "exp",
    "ln",
    "tanh",
    "sinh",
    "cosh",
    "arcsin",
    "arccos",
    "arctan",
    "min",
    "max",
    "operatorname",
];

const APPLIED: &str = "<mo>&#x2061;</mo>";

impl<'a> LatexReader<'a> {
    /// Everything up to the end.
    fn row(&mut self, end: End) -> String {
        let mut out = String::new();
        loop {
            self.rest = self.rest.trim_start();
            if self.rest.is_empty() {
                return out;
            }
            if end == End::Brace && self.take("}") || end == End::Right && self.take("\\right") {
                return out;
            }
            out.push_str(&self.scripted());
        }
    }

    fn take(&mut self, text: &str) -> bool {
        let rest = self.rest.strip_prefix(text);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// One thing with its primes, index and power; after a function comes the sign that applies it.
    fn scripted(&mut self) -> String {
        let function = FUNCTIONS.iter().any(|name| self.rest.strip_prefix('\\').is_some_and(|r| r.starts_with(name)));
        let base = self.atom();
        let (mut below, mut above) = (None, String::new());
        loop {
            if self.take("'") {
                above.push_str("<mo>′</mo>");
            } else if self.take("_") {
                below = Some(self.group());
            } else if self.take("^") {
                above.push_str(&self.group());
            } else {
                break;
            }
        }
        let above = (!above.is_empty()).then(|| format!("<mrow>{above}</mrow>"));
        let set = match (below, above) {
            (None, None) => base,
            (Some(below), None) => format!("<msub>{base}{below}</msub>"),
            (None, Some(above)) => format!("<msup>{base}{above}</msup>"),
            (Some(below), Some(above)) => format!("<msubsup>{base}{below}{above}</msubsup>"),
        };
        if function { set + APPLIED } else { set }
    }

    /// `{…}`, or one thing without braces, as one element.
    fn group(&mut self) -> String {
        self.rest = self.rest.trim_start();
        if self.take("{") { format!("<mrow>{}</mrow>", self.row(End::Brace)) } else { self.atom() }
    }

    /// The text in braces as it is written.
    fn raw(&mut self) -> String {
        let Some(inside) = self.rest.strip_prefix('{') else { return String::new() };
        let (mut depth, mut length) = (1, inside.len());
        for (at, sign) in inside.char_indices() {
            depth += i32::from(sign == '{') - i32::from(sign == '}');
            if depth == 0 {
                length = at;
                break;
            }
        }
        self.rest = inside.get(length + 1..).unwrap_or_default();
        escaped(&inside[..length].replace("\\_", "_"))
    }

    /// One element.
    fn atom(&mut self) -> String {
        if self.rest.starts_with('{') {
            return self.group();
        }
        if let Some(rest) = self.rest.strip_prefix('\\') {
            let letters = rest.chars().take_while(char::is_ascii_alphabetic).count();
            let length = if letters == 0 { rest.chars().next().map_or(0, char::len_utf8) } else { letters };
            let (name, rest) = rest.split_at(length);
            self.rest = rest;
            return self.command(name);
        }
        let digits = self.rest.bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b'.').count();
        if digits > 0 {
            let (number, rest) = self.rest.split_at(digits);
            self.rest = rest;
            return format!("<mn>{number}</mn>");
        }
        let Some(sign) = self.rest.chars().next() else { return "<mrow></mrow>".into() };
        self.rest = &self.rest[sign.len_utf8()..];
        match sign {
            '-' => "<mo form=\"infix\">−</mo>".into(),
            '+' => "<mo form=\"infix\">+</mo>".into(),
            sign if sign.is_alphabetic() => format!("<mi>{sign}</mi>"),
            sign => format!("<mo>{}</mo>", escaped(&sign.to_string())),
        }
    }

    fn command(&mut self, name: &str) -> String {
        if let Some((_, letter)) = LETTERS.iter().find(|(command, _)| *command == name) {
            return format!("<mi>{letter}</mi>");
        }
        if let Some((_, mark)) = ACCENTS.iter().find(|(command, _)| *command == name) {
            return format!("<mover accent=\"true\">{}<mo>{mark}</mo></mover>", self.group());
        }
        match name {
            "frac" => format!("<mfrac>{}{}</mfrac>", self.group(), self.group()),
            "sqrt" => format!("<msqrt>{}</msqrt>", self.group()),
            "left" => {
                let open = self.atom();
                let inside = self.row(End::Right);
                format!("<mrow>{open}{inside}{}</mrow>", self.atom())
            }
            "bigl" | "bigr" | "biggl" | "biggr" | "Biggl" | "Biggr" | "big" => self.atom(),
            "mathit" => format!("<mi style=\"font-style:italic\">{}</mi>", self.inner_words()),
            "operatorname" | "mathrm" => format!("<mi mathvariant=\"normal\">{}</mi>", self.raw()),
            "text" => format!("<mtext>{}</mtext>", self.raw()),
            "," => "<mspace width=\"0.17em\"></mspace>".into(),
            "quad" => "<mspace width=\"1em\"></mspace>".into(),
            "cdot" => "<mo>·</mo>".into(),
            name if FUNCTIONS.contains(&name) => format!("<mi>{name}</mi>"),
            name => format!("<mtext>\\{}</mtext>", escaped(name)),
        }
    }

    /// A word, whose Greek letters are commands.
    fn inner_words(&mut self) -> String {
        let raw = self.raw();
        LETTERS.iter().fold(raw, |word, (name, letter)| word.replace(&format!("\\{name} "), letter))
    }
}

#[cfg(test)]
mod tests {
    use super::{line, mathml, terms, words};

    #[test]
    fn formulas() {
        assert_eq!(
            mathml("\\frac{1}{2} \\, \\mathit{mass\\_of} \\, \\dot{x}_{1}^{2}"),
            "<mfrac><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></mfrac><mspace width=\"0.17em\"></mspace>\
             <mi style=\"font-style:italic\">mass_of</mi><mspace width=\"0.17em\"></mspace>\
             <msubsup><mover accent=\"true\"><mrow><mi>x</mi></mrow><mo>˙</mo></mover>\
             <mrow><mn>1</mn></mrow><mrow><mrow><mn>2</mn></mrow></mrow></msubsup>"
        );
        assert_eq!(
            mathml("\\sin^{2} \\theta"),
            "<msup><mi>sin</mi><mrow><mrow><mn>2</mn></mrow></mrow></msup><mo>&#x2061;</mo><mi>θ</mi>"
        );
        assert_eq!(
            mathml("\\left(a - b\\right)"),
            "<mrow><mo>(</mo><mi>a</mi><mo form=\"infix\">−</mo><mi>b</mi><mo>)</mo></mrow>"
        );
        assert_eq!(mathml("\\sqrt{x}"), "<msqrt><mrow><mi>x</mi></mrow></msqrt>");
    }

    #[test]
    fn lines_break_at_outermost_signs() {
        assert_eq!(
            terms(" = a + \\left(b - c\\right) - \\frac{d + e}{f}"),
            [" = a", " + \\left(b - c\\right)", " - \\frac{d + e}{f}"]
        );
        assert_eq!(line("a &= b + c").matches("<math>").count(), 2);
        assert_eq!(line("a + d &= b + c").matches("<math>").count(), 4);
    }

    #[test]
    fn what_is_not_known_is_shown_as_it_is_written() {
        assert_eq!(mathml("\\foo{x}"), "<mtext>\\foo</mtext><mrow><mi>x</mi></mrow>");
        assert_eq!(words("of the_push < $x$"), "of the_push &lt; <math><mi>x</mi></math>");
        // Braces that are missing end with the line.
        for broken in ["{x", "\\frac{1", "\\left(x", "x_", "\\", "\\text{a", "}", "x^^2", "\\mathit"] {
            let set = mathml(broken);
            let count = |text: &str| set.matches(text).count();
            assert_eq!(count("<mrow>"), count("</mrow>"), "{set}");
        }
    }
}
