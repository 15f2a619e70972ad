//! Whether LaTeX is what TeX can set and a reader understands, seen from its structure alone: no TeX is needed.

use gauss_codegen::mathml;

/// A token of a formula.
#[derive(Clone, Debug, PartialEq)]
enum Token {
    /// `\name`, without the backslash; of `\{` and the like the sign.
    Command(String),
    /// A letter, a digit, a sign.
    Sign(char),
    /// The contents of `\text{…}`.
    Words(String),
}

/// What is wrong with equations: `align*` environments.
pub fn complaints(latex: &str) -> Vec<String> {
    let body = latex.strip_prefix("\\begin{align*}\n").and_then(|body| body.strip_suffix("\\end{align*}\n"));
    let Some(body) = body else { return vec!["it is no `align*` environment".into()] };
    if body.matches("\\end{align*}\n\\begin{align*}\n").count() != body.matches("{align*}").count() / 2 {
        return vec!["environments do not follow one another".into()];
    }
    mathml::lines(latex).filter_map(|line| line_is_right(line).err().map(|error| format!("{error}: {line}"))).collect()
}

fn line_is_right(line: &str) -> Result<(), String> {
    let tokens = tokens(line)?;
    if tokens.iter().filter(|token| **token == Token::Sign('&')).count() != 1 {
        return Err("not one alignment".into());
    }
    Reader { tokens: &tokens, at: 0 }.formula(None)
}

fn tokens(line: &str) -> Result<Vec<Token>, String> {
    let mut out = Vec::new();
    let mut rest = line;
    while let Some(sign) = rest.chars().next() {
        rest = &rest[sign.len_utf8()..];
        if !sign.is_ascii() {
            return Err(format!("`{sign}` is no sign of TeX's fonts"));
        }
        if sign == ' ' {
            continue;
        }
        if sign != '\\' {
            out.push(Token::Sign(sign));
            continue;
        }
        let letters = rest.chars().take_while(char::is_ascii_alphabetic).count().max(1);
        let (name, after) = rest.split_at(letters.min(rest.len()));
        rest = after;
        if name == "text" {
            let (words, after) = in_braces(rest)?;
            check_words(words)?;
            out.push(Token::Words(words.to_owned()));
            rest = after;
        } else {
            out.push(Token::Command(name.to_owned()));
        }
    }
    Ok(out)
}

/// What stands in braces, and what follows.
fn in_braces(text: &str) -> Result<(&str, &str), String> {
    let mut depth = 0;
    for (at, sign) in text.char_indices() {
        match sign {
            '{' => depth += 1,
            '}' if depth == 1 => return Ok((&text[1..at], &text[at + 1..])),
            '}' => depth -= 1,
            _ if depth == 0 => break,
            _ => {}
        }
    }
    Err("words without braces".into())
}

/// Formulas in words stand between dollars; underscores are escaped elsewhere.
fn check_words(words: &str) -> Result<(), String> {
    for (n, part) in words.split('$').enumerate() {
        if n % 2 == 1 {
            Reader { tokens: &tokens(part)?, at: 0 }.formula(None)?;
        } else if part.replace("\\_", "").contains(['_', '^', '&', '#', '%', '\\']) {
            return Err(format!("a sign of formulas in words: {part}"));
        }
    }
    if words.matches('$').count() % 2 == 1 { Err("an odd number of dollars".into()) } else { Ok(()) }
}

/// Operators whose argument follows without brackets of its own: a power belongs between the two.
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

/// Letters, spaces and relations: they take nothing.
const SYMBOLS: [&str; 43] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega", "varphi", "vartheta", "Gamma", "Omega", "cdot", ",",
    "_", "partial", "Delta", "Sigma", "Lambda", "Phi", "Psi", "quad", "big", "bigl", "bigr", "biggl", "biggr", "Biggl",
    "Biggr",
];

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
}

impl Reader<'_> {
    fn next(&mut self) -> Option<&Token> {
        self.at += 1;
        self.tokens.get(self.at - 1)
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn sees(&self, sign: char) -> bool {
        self.peek() == Some(&Token::Sign(sign))
    }

    /// Up to the end: `}`, `\right`, or that of the line.
    fn formula(&mut self, end: Option<&Token>) -> Result<(), String> {
        let mut after_function = false;
        while let Some(token) = self.peek() {
            if Some(token) == end {
                self.at += 1;
                return Ok(());
            }
            let function = matches!(token, Token::Command(name) if FUNCTIONS.contains(&name.as_str()));
            let scripts = self.atom()?;
            if after_function && !function && scripts.contains('^') {
                return Err("a power after the argument of a function".into());
            }
            after_function = function;
        }
        end.map_or(Ok(()), |end| Err(format!("{end:?} is missing")))
    }

    /// One thing with its indices and powers, which are returned.
    fn atom(&mut self) -> Result<String, String> {
        let token = self.next().cloned();
        match token {
            Some(Token::Sign('{')) => self.formula(Some(&Token::Sign('}')))?,
            Some(Token::Sign(sign @ ('}' | '_' | '^' | '$' | '#' | '%'))) => {
                return Err(format!("`{sign}` where something should stand"));
            }
            Some(Token::Sign(_) | Token::Words(_)) => {}
            Some(Token::Command(name)) => match name.as_str() {
                "frac" => {
                    self.group()?;
                    self.group()?;
                }
                "sqrt" | "hat" | "dot" | "ddot" | "mathit" | "operatorname" | "mathrm" => self.group()?,
                "left" => {
                    self.next().ok_or("a bracket is missing")?;
                    self.formula(Some(&Token::Command("right".into())))?;
                    self.next().ok_or("a bracket is missing")?;
                }
                name if FUNCTIONS.contains(&name) || SYMBOLS.contains(&name) => {}
                name => return Err(format!("\\{name} is not known to the check")),
            },
            None => return Err("something is missing".into()),
        }
        let mut scripts = String::new();
        while self.sees('\'') {
            self.at += 1;
        }
        while let Some(Token::Sign(sign @ ('_' | '^'))) = self.peek().cloned() {
            self.at += 1;
            if scripts.contains(sign) {
                return Err(format!("two `{sign}` on one thing"));
            }
            scripts.push(sign);
            self.group()?;
        }
        Ok(scripts)
    }

    fn group(&mut self) -> Result<(), String> {
        // `\dot z` and `x^2` are fine: one thing without braces.
        if self.sees('{') {
            self.at += 1;
            return self.formula(Some(&Token::Sign('}')));
        }
        self.next().map(|_| ()).ok_or_else(|| "something is missing".to_owned())
    }
}
