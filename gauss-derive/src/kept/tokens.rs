//! Tokens as bytes and back, with the places of the user's tokens among them.

use std::cell::Cell;
use std::collections::HashMap;
use std::str::FromStr;

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

const DELIMITERS: [Delimiter; 4] = [Delimiter::Parenthesis, Delimiter::Brace, Delimiter::Bracket, Delimiter::None];

/// Kind of a token, as a byte; that of a group is `GROUP` and the place of its delimiter in `DELIMITERS`.
const END: u64 = 0;
const IDENT: u64 = 1;
const LITERAL: u64 = 2;
const ALONE: u64 = 3;
const JOINT: u64 = 4;
const GROUP: u64 = 5;

/// The tokens of a struct one by one, without places: equal for equal structs alone.
///
/// Text is not: the compiler prints the invisible groups that a `macro_rules!` puts around an expression as nothing.
pub fn text_of(tokens: TokenStream) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.stream(tokens, &|_| 0);
    writer.whole()
}

/// Every place that code of a struct can have: of the macro's own tokens, of each token of the struct, and of these
/// with the names of the macro. In the same order for equal structs.
pub struct Places(Vec<Span>);

impl Places {
    pub fn of(input: TokenStream) -> Self {
        let mut places = vec![Span::call_site(), Span::mixed_site()];
        collect(input, &mut places);
        Self(places)
    }

    /// The number of a place. The compiler does not compare places, but prints different ones differently.
    fn numbers(&self) -> HashMap<String, u64> {
        let mut numbers = HashMap::new();
        for (k, place) in (0..).zip(&self.0) {
            numbers.entry(format!("{place:?}")).or_insert(k);
        }
        numbers
    }
}

fn collect(tokens: TokenStream, places: &mut Vec<Span>) {
    for token in tokens {
        let mut spans = vec![token.span()];
        if let TokenTree::Group(group) = &token {
            spans.extend([group.span_open(), group.span_close()]);
        }
        for span in spans {
            places.extend([span, span.resolved_at(Span::mixed_site()), span.resolved_at(Span::call_site())]);
        }
        if let TokenTree::Group(group) = token {
            collect(group.stream(), places);
        }
    }
}

/// Code as bytes.
///
/// None where a token has a place of its own, which could not be found again.
pub fn written(code: TokenStream, places: &Places) -> Option<Vec<u8>> {
    let numbers = places.numbers();
    let lost = Cell::new(false);
    let number = |span: Span| {
        numbers.get(&format!("{span:?}")).copied().unwrap_or_else(|| {
            lost.set(true);
            0
        })
    };
    let mut writer = Writer::default();
    writer.stream(code, &number);
    (!lost.get()).then(|| writer.whole())
}

/// Code from its bytes, at the places of a struct that is equal to the one that it was derived from.
///
/// None where these are not bytes of `written`.
pub fn read(bytes: &[u8], places: &Places) -> Option<TokenStream> {
    let mut bytes = Bytes(bytes);
    let words = (0..bytes.number()?).map(|_| bytes.text()).collect::<Option<Vec<_>>>()?;
    let literals = words.iter().map(|_| None).collect();
    let mut reader = Reader { bytes, words, literals, places: &places.0 };
    let code = reader.stream()?;
    reader.bytes.0.is_empty().then_some(code)
}

/// The files that code names to the compiler: those that it is derived from.
pub fn files(code: TokenStream) -> Vec<String> {
    let mut files = Vec::new();
    let mut last = String::new();
    for token in code {
        match token {
            TokenTree::Group(group) if last == "include_bytes!" => {
                files.extend(syn::parse2::<syn::LitStr>(group.stream()).map(|file| file.value()));
            }
            TokenTree::Group(group) => files.extend(self::files(group.stream())),
            TokenTree::Punct(punct) if punct.as_char() == '!' => last.push('!'),
            token => last = token.to_string(),
        }
    }
    files
}

/// Numbers in base 128, least digits first; texts behind their length.
#[derive(Default)]
pub struct Output(pub Vec<u8>);

impl Output {
    pub fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.0.push(number as u8 | 0x80);
            number >>= 7;
        }
        self.0.push(number as u8);
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        self.number(bytes.len() as u64);
        self.0.extend_from_slice(bytes);
    }
}

/// Rest of the bytes of `Output`.
pub struct Bytes<'a>(pub &'a [u8]);

impl<'a> Bytes<'a> {
    pub fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let (&byte, rest) = self.0.split_first()?;
            self.0 = rest;
            number |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    }

    pub fn bytes(&mut self) -> Option<&'a [u8]> {
        let length = usize::try_from(self.number()?).ok()?;
        let (bytes, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(bytes)
    }

    pub fn text(&mut self) -> Option<&'a str> {
        str::from_utf8(self.bytes()?).ok()
    }
}

/// Each word once, and a token as its kind, its word and its place.
#[derive(Default)]
struct Writer {
    words: HashMap<String, u64>,
    order: Output,
    tokens: Output,
}

impl Writer {
    fn word(&mut self, word: String) {
        let next = self.words.len() as u64;
        let number = *self.words.entry(word).or_insert_with_key(|word| {
            self.order.bytes(word.as_bytes());
            next
        });
        self.tokens.number(number);
    }

    fn stream(&mut self, tokens: TokenStream, place: &dyn Fn(Span) -> u64) {
        for token in tokens {
            let at = place(token.span());
            match token {
                TokenTree::Ident(ident) => {
                    self.tokens.number(IDENT);
                    self.word(ident.to_string());
                }
                TokenTree::Literal(literal) => {
                    self.tokens.number(LITERAL);
                    self.word(literal.to_string());
                }
                TokenTree::Punct(punct) => {
                    self.tokens.number(if punct.spacing() == Spacing::Joint { JOINT } else { ALONE });
                    self.tokens.number(punct.as_char().into());
                }
                TokenTree::Group(group) => {
                    let delimiter = DELIMITERS.iter().position(|delimiter| *delimiter == group.delimiter());
                    self.tokens.number(GROUP + delimiter.unwrap_or(0) as u64);
                    self.stream(group.stream(), place);
                }
            }
            self.tokens.number(at);
        }
        self.tokens.number(END);
    }

    fn whole(self) -> Vec<u8> {
        let mut whole = Output::default();
        whole.number(self.words.len() as u64);
        whole.0.extend(self.order.0);
        whole.0.extend(self.tokens.0);
        whole.0
    }
}

struct Reader<'a> {
    bytes: Bytes<'a>,
    words: Vec<&'a str>,
    /// Words as literals, each asked of the compiler once.
    literals: Vec<Option<Literal>>,
    places: &'a [Span],
}

impl Reader<'_> {
    fn stream(&mut self) -> Option<TokenStream> {
        let mut tokens: Vec<TokenTree> = Vec::new();
        loop {
            let kind = self.bytes.number()?;
            let mut token = match kind {
                END => return Some(tokens.into_iter().collect()),
                IDENT => self.ident()?.into(),
                LITERAL => self.literal()?.into(),
                ALONE | JOINT => {
                    let spacing = if kind == JOINT { Spacing::Joint } else { Spacing::Alone };
                    Punct::new(char::from_u32(u32::try_from(self.bytes.number()?).ok()?)?, spacing).into()
                }
                _ => {
                    let delimiter = DELIMITERS.get(usize::try_from(kind - GROUP).ok()?)?;
                    TokenTree::Group(Group::new(*delimiter, self.stream()?))
                }
            };
            let place = usize::try_from(self.bytes.number()?).ok()?;
            token.set_span(*self.places.get(place)?);
            tokens.push(token);
        }
    }

    fn ident(&mut self) -> Option<Ident> {
        let word = *self.words.get(usize::try_from(self.bytes.number()?).ok()?)?;
        Some(match word.strip_prefix("r#") {
            Some(raw) => Ident::new_raw(raw, Span::call_site()),
            None => Ident::new(word, Span::call_site()),
        })
    }

    fn literal(&mut self) -> Option<Literal> {
        let word = usize::try_from(self.bytes.number()?).ok()?;
        let known = self.literals.get_mut(word)?;
        if known.is_none() {
            *known = Literal::from_str(self.words[word]).ok();
        }
        known.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CODE: &str = r##"
        #[doc = " a body"] pub struct r#Type<'a, T: 'static> { x: &'a [T; 2] }
        fn f(x: f64) -> u8 { let _ = (x - -1.5e-300, b"bytes\0", c"text", r#"raw "text""#, 'c', b'\n', 1_u64 << 3, ..=2); 7u8 }
        const _: &[u8] = ::core::include_bytes!("a.urdf"); const _: &str = concat!("b.urdf");
        mod inner { const _: &[u8] = include_bytes!("c \"d\".xml"); }
    "##;

    fn code() -> TokenStream {
        let mut code: TokenStream = CODE.parse().unwrap();
        let invisible = TokenTree::Group(Group::new(Delimiter::None, "1 + 2".parse().unwrap()));
        code.extend(["const _: u8 = ".parse().unwrap(), TokenStream::from(invisible), ";".parse().unwrap()]);
        code
    }

    #[test]
    fn tokens_come_back() {
        let code = code();
        let places = Places::of(code.clone());
        let bytes = written(code.clone(), &places).unwrap();
        let back = read(&bytes, &places).unwrap();
        assert_eq!(text_of(back.clone()), text_of(code.clone()));
        assert_eq!(back.to_string(), code.to_string());
        let spans = |tokens| Places::of(tokens).0.iter().map(|span| format!("{span:?}")).collect::<Vec<_>>();
        assert_eq!(spans(back), spans(code));
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length], &places).is_none(), "{length} bytes");
        }
    }

    #[test]
    fn tokens_from_nowhere_are_not_kept() {
        let places = Places::of("struct Body;".parse().unwrap());
        assert!(written("struct Other;".parse().unwrap(), &places).is_none());
        // At places of the macro and of the struct.
        let own = quote::quote!(
            fn f() {}
        );
        assert!(written(own, &places).is_some());
    }

    #[test]
    fn invisible_groups_are_seen() {
        let of = |delimiter| TokenStream::from(TokenTree::Group(Group::new(delimiter, "a + b".parse().unwrap())));
        assert_ne!(text_of(of(Delimiter::None)), text_of("a + b".parse().unwrap()));
        assert_ne!(text_of(of(Delimiter::None)), text_of(of(Delimiter::Parenthesis)));
        assert_ne!(text_of("a += b".parse().unwrap()), text_of("a + = b".parse().unwrap()));
    }

    #[test]
    fn files_of_code_are_found() {
        assert_eq!(files(code()), ["a.urdf", "c \"d\".xml"]);
    }
}
