//! Widths of letters in Computer Modern at 10 pt, in points, as `\wd` of TeX gives them; rounded up to tenths.

/// Letters a to z, then A to Z, in tenths of points.
type Alphabet = [u8; 52];

/// As variables: cmmi10 with italic correction.
const VARIABLES: Alphabet = [
    53, 43, 44, 53, 47, 60, 52, 58, 35, 47, 56, 32, 88, 61, 49, 51, 49, 48, 47, 37, 58, 53, 75, 58, 53, 51, //
    75, 81, 79, 86, 81, 78, 79, 91, 52, 66, 92, 69, 108, 92, 80, 79, 80, 77, 67, 73, 80, 81, 109, 91, 81, 76,
];

/// Upright: cmr10.
const UPRIGHT: Alphabet = [
    51, 56, 45, 56, 45, 34, 51, 56, 28, 31, 53, 28, 84, 56, 51, 56, 53, 40, 40, 39, 56, 53, 73, 53, 53, 45, //
    76, 71, 73, 77, 69, 66, 79, 76, 37, 52, 78, 63, 92, 76, 78, 69, 78, 74, 56, 73, 76, 76, 103, 76, 76, 62,
];

/// In words of `\mathit`: cmti10, without the italic correction, which only the last letter has.
const WORDS: Alphabet = [
    52, 46, 46, 52, 46, 31, 46, 52, 31, 31, 46, 26, 82, 57, 52, 52, 46, 43, 41, 34, 54, 46, 67, 47, 49, 41, //
    75, 71, 72, 76, 68, 66, 78, 75, 39, 53, 77, 63, 90, 75, 77, 68, 77, 73, 57, 72, 75, 75, 100, 75, 75, 62,
];

/// Letters by their commands.
const COMMANDS: [(&str, u8); 38] = [
    ("alpha", 65),
    ("beta", 62),
    ("gamma", 58),
    ("delta", 49),
    ("epsilon", 41),
    ("zeta", 52),
    ("eta", 54),
    ("theta", 50),
    ("iota", 36),
    ("kappa", 58),
    ("lambda", 59),
    ("mu", 61),
    ("nu", 56),
    ("xi", 49),
    ("pi", 61),
    ("rho", 52),
    ("sigma", 61),
    ("tau", 56),
    ("upsilon", 58),
    ("phi", 60),
    ("chi", 63),
    ("psi", 69),
    ("omega", 66),
    ("varphi", 66),
    ("vartheta", 60),
    ("Gamma", 63),
    ("Delta", 84),
    ("Theta", 78),
    ("Lambda", 70),
    ("Xi", 67),
    ("Pi", 76),
    ("Sigma", 73),
    ("Phi", 73),
    ("Psi", 78),
    ("Omega", 73),
    ("partial", 59),
    ("infty", 101),
    ("ell", 42),
];

/// Width of a digit, and of anything that is not in the tables.
const DIGIT: u8 = 51;
/// Width of a space between words, and no less than of points and commas.
const SPACE: f64 = 3.4;
/// Width of `\_`.
const UNDERSCORE: u8 = 36;
/// Width of a digit in `\mathit`.
const ITALIC_DIGIT: u8 = 52;
/// The largest italic correction, after a word and before `\_`.
const CORRECTION: f64 = 1.7;

fn letter(alphabet: &Alphabet, sign: char) -> Option<f64> {
    let place = match sign {
        'a'..='z' => sign as usize - 'a' as usize,
        'A'..='Z' => 26 + sign as usize - 'A' as usize,
        _ => return None,
    };
    Some(f64::from(alphabet[place]) / 10.0)
}

/// Width of one sign of a formula.
pub fn variable(sign: char) -> f64 {
    letter(&VARIABLES, sign).unwrap_or(f64::from(DIGIT) / 10.0)
}

/// Width of a letter by its command; the widest of letters where it is not known.
pub fn command(name: &str) -> f64 {
    let known = COMMANDS.iter().find(|(command, _)| *command == name);
    known.map_or(10.9, |(_, width)| f64::from(*width) / 10.0)
}

/// Width of letters of `\text`, `\operatorname` and the names of functions.
pub fn upright(words: &str) -> f64 {
    of_words(words, &UPRIGHT, DIGIT)
}

/// Width of letters of `\mathit`.
pub fn italic(words: &str) -> f64 {
    of_words(words, &WORDS, ITALIC_DIGIT) + CORRECTION * (1 + words.matches("\\_").count()) as f64
}

/// Letters, digits, `\_`, and Greek letters as commands, which a space ends.
fn of_words(words: &str, alphabet: &Alphabet, other: u8) -> f64 {
    let mut width = 0.0;
    let mut rest = words;
    while let Some(sign) = rest.chars().next() {
        rest = &rest[sign.len_utf8()..];
        if sign != '\\' {
            let narrow = " .,;:'".contains(sign).then_some(SPACE);
            width += letter(alphabet, sign).or(narrow).unwrap_or(f64::from(other) / 10.0);
            continue;
        }
        let letters = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        let (name, after) = rest.split_at(letters.max(rest.chars().next().map_or(0, char::len_utf8)));
        width += if letters == 0 { f64::from(UNDERSCORE) / 10.0 } else { command(name) };
        rest = after.strip_prefix(' ').filter(|_| letters > 0).unwrap_or(after);
    }
    width
}
