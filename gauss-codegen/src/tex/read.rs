//! LaTeX in pieces, each with the text that it was read from.

/// One thing with its index and its power.
#[derive(Clone, Debug)]
pub struct Piece<'a> {
    /// As it is written, scripts included.
    pub tex: &'a str,
    /// A space is before it.
    pub spaced: bool,
    pub kind: PieceKind<'a>,
    /// Primes, index and power as they are written.
    pub scripts: &'a str,
    pub below: Vec<Piece<'a>>,
    pub above: Vec<Piece<'a>>,
    pub primes: usize,
}

/// Kind of a piece.
#[derive(Clone, Debug)]
pub enum PieceKind<'a> {
    Letter(char),
    /// Digits, with a point among them.
    Number(&'a str),
    /// A command without arguments: a Greek letter, `\infty`.
    Symbol(&'a str),
    /// + or −.
    Sign,
    /// `\cdot`.
    Times,
    Equals,
    Comma,
    /// `\,`, between factors.
    Thin,
    /// `\sin`.
    Function(&'a str),
    /// Letters of `\operatorname`, `\mathrm`.
    Name(&'a str),
    /// Letters of `\mathit`.
    Italic(&'a str),
    /// Letters of `\text`.
    Words(&'a str),
    Row(Vec<Piece<'a>>),
    Fraction([Vec<Piece<'a>>; 2]),
    Root(Vec<Piece<'a>>),
    Accent(Vec<Piece<'a>>),
    /// `\left( … \right)`.
    Bracket {
        open: &'a str,
        inside: Vec<Piece<'a>>,
        close: &'a str,
    },
    /// Any other sign.
    Other(char),
}

/// Functions that are commands.
const FUNCTIONS: [&str; 13] =
    ["sin", "cos", "tan", "exp", "ln", "tanh", "sinh", "cosh", "arcsin", "arccos", "arctan", "min", "max"];

/// A formula, in math mode. What is not closed ends with the text.
pub fn read(tex: &str) -> Vec<Piece<'_>> {
    TexReader { rest: tex }.row(None)
}

struct TexReader<'a> {
    rest: &'a str,
}

impl<'a> TexReader<'a> {
    fn take(&mut self, text: &str) -> bool {
        let rest = self.rest.strip_prefix(text);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// Text that has been read since.
    fn since(&self, begin: &'a str) -> &'a str {
        &begin[..begin.len() - self.rest.len()]
    }

    fn row(&mut self, end: Option<&str>) -> Vec<Piece<'a>> {
        let mut pieces = Vec::new();
        loop {
            let spaced = self.rest.starts_with(' ');
            self.rest = self.rest.trim_start();
            if self.rest.is_empty() || end.is_some_and(|end| self.take(end)) {
                return pieces;
            }
            pieces.push(Piece { spaced, ..self.piece() });
        }
    }

    fn piece(&mut self) -> Piece<'a> {
        let begin = self.rest;
        let kind = self.kind();
        let (mut below, mut above, mut primes) = (Vec::new(), Vec::new(), 0);
        let scripts = self.rest;
        loop {
            if self.take("'") {
                primes += 1;
            } else if self.take("_") {
                below = self.group();
            } else if self.take("^") {
                above = self.group();
            } else {
                break;
            }
        }
        Piece { tex: self.since(begin), spaced: false, kind, scripts: self.since(scripts), below, above, primes }
    }

    /// `{…}`, or one thing without braces.
    fn group(&mut self) -> Vec<Piece<'a>> {
        self.rest = self.rest.trim_start();
        if self.take("{") { self.row(Some("}")) } else { self.bare().into_iter().collect() }
    }

    /// One thing without scripts of its own.
    fn bare(&mut self) -> Option<Piece<'a>> {
        let begin = self.rest;
        (!begin.is_empty()).then(|| {
            let kind = self.kind();
            let (below, above) = (Vec::new(), Vec::new());
            Piece { tex: self.since(begin), spaced: false, kind, scripts: "", below, above, primes: 0 }
        })
    }

    /// The text in braces as it is written.
    fn raw(&mut self) -> &'a str {
        let Some(inside) = self.rest.strip_prefix('{') else { return "" };
        let mut depth = 1;
        let end = inside.char_indices().find(|&(_, sign)| {
            depth += i32::from(sign == '{') - i32::from(sign == '}');
            depth == 0
        });
        let length = end.map_or(inside.len(), |(at, _)| at);
        self.rest = inside.get(length + 1..).unwrap_or_default();
        &inside[..length]
    }

    fn kind(&mut self) -> PieceKind<'a> {
        if self.take("{") {
            return PieceKind::Row(self.row(Some("}")));
        }
        let digits = self.rest.bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b'.').count();
        if digits > 0 {
            let (number, rest) = self.rest.split_at(digits);
            self.rest = rest;
            return PieceKind::Number(number);
        }
        let mut signs = self.rest.chars();
        let sign = signs.next().unwrap_or(' ');
        if sign == '\\' {
            let name = self.command();
            return self.argument(name);
        }
        self.rest = signs.as_str();
        match sign {
            '+' | '-' => PieceKind::Sign,
            '=' => PieceKind::Equals,
            ',' => PieceKind::Comma,
            sign if sign.is_alphabetic() => PieceKind::Letter(sign),
            sign => PieceKind::Other(sign),
        }
    }

    /// The name of a command, which is passed; of `\,` and the like the sign.
    fn command(&mut self) -> &'a str {
        let rest = &self.rest[1..];
        let letters = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        let length = if letters == 0 { rest.chars().next().map_or(0, char::len_utf8) } else { letters };
        self.rest = &rest[length..];
        &rest[..length]
    }

    fn argument(&mut self, name: &'a str) -> PieceKind<'a> {
        match name {
            "frac" => PieceKind::Fraction([self.group(), self.group()]),
            "sqrt" => PieceKind::Root(self.group()),
            "hat" | "dot" | "ddot" => PieceKind::Accent(self.group()),
            "operatorname" | "mathrm" => PieceKind::Name(self.raw()),
            "mathit" => PieceKind::Italic(self.raw()),
            "text" => PieceKind::Words(self.raw()),
            "left" => {
                let open = self.delimiter();
                let inside = self.row(Some("\\right"));
                PieceKind::Bracket { open, inside, close: self.delimiter() }
            }
            "cdot" => PieceKind::Times,
            "," => PieceKind::Thin,
            name if FUNCTIONS.contains(&name) => PieceKind::Function(name),
            name => PieceKind::Symbol(name),
        }
    }

    fn delimiter(&mut self) -> &'a str {
        let length = self.rest.chars().next().map_or(0, char::len_utf8);
        let (sign, rest) = self.rest.split_at(length);
        self.rest = rest;
        sign
    }
}
