//! Units as they are written, `"N s/m"`, and the dimensions that they have: powers of kg, m and s. Only coherent units
//! of the SI are taken, since values are used as they are.
//!
//! Factors are joined by a space, `*` or `·`. What follows `/` divides, as in `m/s/s`; since `kg/m s` is read in two
//! ways, several factors after one `/` stand in brackets: `kg/(m s)`. Powers are whole: `m^2`, `s^-1`, `m²`.

use super::words;
use std::fmt;
use std::iter::Peekable;
use std::str::Chars;

/// Powers of kg, m and s, doubled, so that a square root has whole powers. A radian is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension([i32; 3]);

impl Dimension {
    pub const NONE: Dimension = Dimension::new(0, 0, 0);
    pub const TIME: Dimension = Dimension::new(0, 0, 1);

    pub const fn new(kg: i32, m: i32, s: i32) -> Dimension {
        Dimension([2 * kg, 2 * m, 2 * s])
    }

    /// `None` where a power is too large to count, here and below.
    pub fn times(self, other: Dimension) -> Option<Dimension> {
        let [a, b, c] = self.0;
        let [d, e, f] = other.0;
        Some(Dimension([a.checked_add(d)?, b.checked_add(e)?, c.checked_add(f)?]))
    }

    pub fn over(self, other: Dimension) -> Option<Dimension> {
        self.times(other.to_the(-1)?)
    }

    pub fn to_the(self, power: i32) -> Option<Dimension> {
        let [a, b, c] = self.0;
        Some(Dimension([a.checked_mul(power)?, b.checked_mul(power)?, c.checked_mul(power)?]))
    }

    /// `None` for the root of a root of an odd power.
    pub fn root(self) -> Option<Dimension> {
        let even = self.0.iter().all(|power| power % 2 == 0);
        even.then(|| Dimension(self.0.map(|power| power / 2)))
    }
}

/// Quantities whose unit is shorter than its factors.
const SHORT: &[(&str, Dimension)] = &[
    ("N", Dimension::new(1, 1, -2)),
    ("N m", Dimension::new(1, 2, -2)),
    ("W", Dimension::new(1, 2, -3)),
    ("Pa", Dimension::new(1, -1, -2)),
    ("N/m", Dimension::new(1, 0, -2)),
    ("N s", Dimension::new(1, 1, -1)),
    ("N s/m", Dimension::new(1, 0, -1)),
    ("N m s", Dimension::new(1, 2, -1)),
];

impl fmt::Display for Dimension {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((unit, _)) = SHORT.iter().find(|(_, dimension)| dimension == self) {
            return formatter.write_str(unit);
        }
        let named = || self.0.into_iter().zip(["kg", "m", "s"]);
        let above: Vec<String> =
            named().filter(|(power, _)| *power > 0).map(|(power, unit)| raised(unit, power)).collect();
        let below: Vec<String> =
            named().filter(|(power, _)| *power < 0).map(|(power, unit)| raised(unit, -power)).collect();
        formatter.write_str(&if above.is_empty() { "1".into() } else { above.join(" ") })?;
        match below.as_slice() {
            [] => Ok(()),
            [one] => write!(formatter, "/{one}"),
            _ => write!(formatter, "/({})", below.join(" ")),
        }
    }
}

/// A unit to half of a positive power.
fn raised(unit: &str, doubled: i32) -> String {
    match doubled {
        2 => unit.into(),
        even if even % 2 == 0 => format!("{unit}^{}", even / 2),
        odd => format!("{unit}^({odd}/2)"),
    }
}

/// The units, each with what is measured in it.
const UNITS: &[(&str, (Dimension, &str))] = &[
    ("kg", (Dimension::new(1, 0, 0), "masses")),
    ("m", (Dimension::new(0, 1, 0), "lengths")),
    ("s", (Dimension::TIME, "times")),
    ("N", (Dimension::new(1, 1, -2), "forces")),
    ("J", (Dimension::new(1, 2, -2), "energies")),
    ("W", (Dimension::new(1, 2, -3), "powers")),
    ("Pa", (Dimension::new(1, -1, -2), "pressures")),
    ("Hz", (Dimension::new(0, 0, -1), "frequencies")),
    ("rad", (Dimension::NONE, "angles")),
];

/// Units that are not coherent, with the coherent ones and the factors between them.
const FOREIGN: &[(&str, &str, &str)] = &[
    ("deg", "rad", "0.0174533"),
    ("°", "rad", "0.0174533"),
    ("rev", "rad", "6.28319"),
    ("turn", "rad", "6.28319"),
    ("rpm", "rad/s", "0.104720"),
    ("t", "kg", "1000"),
    ("lb", "kg", "0.453592"),
    ("in", "m", "0.0254"),
    ("ft", "m", "0.3048"),
    ("mi", "m", "1609.344"),
    ("nmi", "m", "1852"),
    ("min", "s", "60"),
    ("h", "s", "3600"),
    ("kn", "m/s", "0.514444"),
    ("knot", "m/s", "0.514444"),
    ("kph", "m/s", "0.277778"),
    ("mph", "m/s", "0.44704"),
    ("lbf", "N", "4.44822"),
    ("kgf", "N", "9.80665"),
    ("bar", "Pa", "100000"),
    ("atm", "Pa", "101325"),
    ("l", "m^3", "0.001"),
    ("L", "m^3", "0.001"),
    ("%", "1", "0.01"),
];

/// Decimal prefixes with their powers of ten.
const PREFIXES: &[(&str, i32)] = &[
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("µ", -6),
    ("μ", -6),
    ("u", -6),
    ("n", -9),
];

/// Names of units in full.
const WORDS: &[(&str, &str)] = &[
    ("kilogram", "kg"),
    ("meter", "m"),
    ("metre", "m"),
    ("sec", "s"),
    ("second", "s"),
    ("newton", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("radian", "rad"),
];

/// The dimension of a unit.
///
/// # Errors
/// What is wrong with it.
pub fn read(text: &str) -> Result<Dimension, String> {
    let mut reader = UnitReader { text, rest: text.chars().peekable(), depth: 0 };
    reader.skip_spaces();
    if reader.rest.peek().is_none() {
        return Err(
            "an empty unit has no meaning; write `1` for numbers without dimension, or leave the unit out".into()
        );
    }
    let dimension = reader.quotient()?;
    match reader.rest.next() {
        None => Ok(dimension),
        Some(_) => Err(format!("`{text}` has a closing bracket too many")),
    }
}

struct UnitReader<'a> {
    text: &'a str,
    rest: Peekable<Chars<'a>>,
    /// Brackets that are open.
    depth: usize,
}

impl UnitReader<'_> {
    /// Factors, up to the end or a closing bracket.
    fn quotient(&mut self) -> Result<Dimension, String> {
        let mut total = self.factor()?;
        let mut divided = false;
        loop {
            self.skip_spaces();
            let divides = match self.rest.peek() {
                None | Some(')') => return Ok(total),
                Some('/') => true,
                _ if divided => {
                    return Err(format!(
                        "in `{}` it is not clear what divides; write several factors after `/` in brackets, such as \
                         `kg/(m s)`",
                        self.text
                    ));
                }
                Some('*' | '·' | '⋅') => false,
                // A space multiplies, and nothing at all after a bracket or a power.
                Some(_) => {
                    total = self.product(total, 1)?;
                    continue;
                }
            };
            self.rest.next();
            divided |= divides;
            total = self.product(total, if divides { -1 } else { 1 })?;
        }
    }

    /// Multiplies what is read so far by one more factor to a power.
    fn product(&mut self, total: Dimension, power: i32) -> Result<Dimension, String> {
        let factor = self.factor()?;
        factor.to_the(power).and_then(|factor| total.times(factor)).ok_or_else(|| self.too_large())
    }

    /// A unit, 1 or something in brackets, with its power.
    fn factor(&mut self) -> Result<Dimension, String> {
        self.skip_spaces();
        let base = match self.rest.peek() {
            Some('(') if self.depth > 20 => return Err(format!("`{}` has too many brackets", self.text)),
            Some('(') => {
                self.rest.next();
                self.depth += 1;
                let inner = self.quotient()?;
                self.depth -= 1;
                if self.rest.next() != Some(')') {
                    return Err(format!("a bracket of `{}` is not closed; add `)`", self.text));
                }
                inner
            }
            Some(digit) if digit.is_ascii_digit() => {
                let number = self.take(|c| c.is_ascii_digit() || matches!(c, '.' | '_'));
                if number != "1" {
                    return Err(format!(
                        "`{number}` is a factor, and values are used as they are; write the unit that they are in without it"
                    ));
                }
                Dimension::NONE
            }
            Some(c) if is_letter(*c) => {
                let name = self.take(is_letter);
                if self.rest.peek().is_some_and(char::is_ascii_digit) {
                    return Err(format!("a power follows `^`; write `{name}^{}`", self.take(|c| c.is_ascii_digit())));
                }
                unit(&name)?
            }
            Some('*') => return Err("a power follows `^`; write `m^2` or `m²`".into()),
            Some(other) => return Err(format!("`{other}` in `{}` stands where a unit belongs; {EXPECTED}", self.text)),
            None => return Err(format!("`{}` breaks off; write its last unit", self.text)),
        };
        let power = self.power()?;
        base.to_the(power).ok_or_else(|| self.too_large())
    }

    /// `^2`, `^-1`, `²`; 1 if none is written.
    fn power(&mut self) -> Result<i32, String> {
        let mut digits = self.take(|c| plain(c).is_some());
        if digits.is_empty() {
            if self.rest.peek() != Some(&'^') {
                return Ok(1);
            }
            self.rest.next();
            digits = self.take(|c| c.is_ascii_digit() || matches!(c, '-' | '.' | '_'));
        } else {
            digits = digits.chars().filter_map(plain).collect();
        }
        match digits.parse::<i32>() {
            Ok(power) if power.abs() <= 100 => Ok(power),
            Ok(_) => Err(self.too_large()),
            Err(_) => Err(format!("powers of units are whole numbers, such as `m^2` or `s^-1`; found `{}`", self.text)),
        }
    }

    fn take(&mut self, accepts: impl Fn(char) -> bool) -> String {
        std::iter::from_fn(|| self.rest.next_if(|c| accepts(*c))).collect()
    }

    fn skip_spaces(&mut self) {
        self.take(char::is_whitespace);
    }

    fn too_large(&self) -> String {
        format!("the powers in `{}` are too large", self.text)
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '°' | '%')
}

/// Plain character of a raised digit or sign.
fn plain(c: char) -> Option<char> {
    match c {
        '⁻' => Some('-'),
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip('0'..='9').find(|(raised, _)| *raised == c).map(|(_, digit)| digit),
    }
}

const EXPECTED: &str = "units are products of kg, m, s, N, J, W, Pa, Hz, rad and 1, such as `N s/m`";

/// The dimension of one unit.
fn unit(name: &str) -> Result<Dimension, String> {
    if let Some((_, (dimension, _))) = UNITS.iter().find(|(known, _)| *known == name) {
        return Ok(*dimension);
    }
    if let Some((coherent, factor)) = conversion(name) {
        let measured = match coherent.as_str() {
            "rad/s" => "angular velocities",
            "m/s" => "velocities",
            "m^3" => "volumes",
            "1" => "ratios",
            unit => UNITS.iter().find(|(known, _)| *known == unit).map_or("values", |(_, (_, measured))| measured),
        };
        return Err(format!(
            "values are used as they are, and {measured} are in {coherent}: 1 {name} = {factor} {coherent}"
        ));
    }
    let remedy = match split(name) {
        Some(parts) => format!("did you mean `{parts}`?"),
        None => match nearest(name) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("{EXPECTED}: leave the unit out if it is none of these"),
        },
    };
    Err(format!("unknown unit `{name}`; {remedy}"))
}

/// The coherent unit for one that is not, and how many of the former are one of the latter.
fn conversion(name: &str) -> Option<(String, String)> {
    if let Some((_, coherent, factor)) = FOREIGN.iter().find(|(known, ..)| *known == name) {
        return Some(((*coherent).into(), (*factor).into()));
    }
    if name == "g" {
        return Some(("kg".into(), "0.001".into()));
    }
    let (base, power) = PREFIXES.iter().find_map(|(prefix, power)| Some((name.strip_prefix(prefix)?, *power)))?;
    let (coherent, power) = match base {
        "g" => ("kg", power - 3),
        "kg" => return None,
        base => (UNITS.iter().find(|(known, _)| *known == base)?.0, power),
    };
    let zeros = "0".repeat(power.unsigned_abs().saturating_sub(u32::from(power < 0)) as usize);
    Some((coherent.into(), if power < 0 { format!("0.{zeros}1") } else { format!("1{zeros}") }))
}

/// Units written without spaces between them: `N m` for `Nm`.
fn split(name: &str) -> Option<String> {
    if name.is_empty() || name.chars().count() > 8 {
        return None;
    }
    UNITS.iter().find_map(|(unit, _)| match name.strip_prefix(unit)? {
        "" => Some((*unit).to_string()),
        rest => split(rest).map(|rest| format!("{unit} {rest}")),
    })
}

/// The unit that was meant. Any two single letters are near, so that among these only the case may be wrong.
fn nearest(name: &str) -> Option<&'static str> {
    let word = name.strip_suffix('s').filter(|word| word.len() > 2).unwrap_or(name);
    if let Some((_, unit)) = words::nearest(word, WORDS).filter(|_| word.chars().count() > 2) {
        return Some(unit);
    }
    let near = |unit: &&str| unit.eq_ignore_ascii_case(name);
    let known = || UNITS.iter().map(|(unit, _)| *unit);
    known().find(near).or_else(|| match word.chars().count() {
        0..=2 => None,
        _ => words::nearest(word, UNITS).map(|(unit, _)| unit).filter(|unit| unit.len() > 1),
    })
}

#[cfg(test)]
mod tests {
    use super::{Dimension, read};

    #[test]
    fn dimensions() {
        let force = Dimension::new(1, 1, -2);
        for (text, expected) in [
            ("1", Dimension::NONE),
            ("rad", Dimension::NONE),
            ("rad/s", Dimension::new(0, 0, -1)),
            ("N", force),
            (" kg m / s^2 ", force),
            ("kg·m·s⁻²", force),
            ("kg*m/s/s", force),
            ("(kg)(m)/(s s)", force),
            ("m s^-2 kg", force),
            ("J/m", force),
            ("N s/m", Dimension::new(1, 0, -1)),
            ("N s²/m²", Dimension::new(1, -1, 0)),
            ("kg/(m s)", Dimension::new(1, -1, -1)),
            ("1/(m/s)^2", Dimension::new(0, -2, 2)),
            ("Pa m²", force),
            ("W/Hz", Dimension::new(1, 2, -2)),
            ("m²s", Dimension::new(0, 2, 1)),
        ] {
            assert_eq!(read(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn in_words() {
        for text in ["1", "N", "N m", "W", "N/m", "N s/m", "kg/m", "kg m^2", "1/s", "m/s^2", "1/(m s)", "m^3/s^2"] {
            assert_eq!(read(text).map(|dimension| dimension.to_string()), Ok(text.into()));
        }
        let area = Dimension::new(0, 1, 0).root();
        assert_eq!(area.map(|dimension| dimension.to_string()), Some("m^(1/2)".into()));
        assert_eq!(area.and_then(Dimension::root), None);
    }

    #[test]
    fn what_is_not_coherent() {
        for (text, message) in [
            ("deg", "values are used as they are, and angles are in rad: 1 deg = 0.0174533 rad"),
            ("km", "values are used as they are, and lengths are in m: 1 km = 1000 m"),
            ("g", "values are used as they are, and masses are in kg: 1 g = 0.001 kg"),
            ("N/mm", "values are used as they are, and lengths are in m: 1 mm = 0.001 m"),
            ("mg", "values are used as they are, and masses are in kg: 1 mg = 0.000001 kg"),
            ("Mg", "values are used as they are, and masses are in kg: 1 Mg = 1000 kg"),
            ("rpm", "values are used as they are, and angular velocities are in rad/s: 1 rpm = 0.104720 rad/s"),
            ("kN m", "values are used as they are, and forces are in N: 1 kN = 1000 N"),
            ("m/min", "values are used as they are, and times are in s: 1 min = 60 s"),
        ] {
            assert_eq!(read(text), Err(message.into()));
        }
    }

    #[test]
    fn what_is_no_unit() {
        for (text, start) in [
            ("", "an empty unit has no meaning"),
            ("Nm", "unknown unit `Nm`; did you mean `N m`?"),
            ("Nms", "unknown unit `Nms`; did you mean `N m s`?"),
            ("newtons", "unknown unit `newtons`; did you mean `N`?"),
            ("Kg", "unknown unit `Kg`; did you mean `kg`?"),
            ("rda", "unknown unit `rda`; did you mean `rad`?"),
            ("V", "unknown unit `V`; units are products of kg, m, s,"),
            ("m2", "a power follows `^`; write `m^2`"),
            ("m**2", "a power follows `^`"),
            ("m^0.5", "powers of units are whole numbers"),
            ("m^", "powers of units are whole numbers"),
            ("m^9999999999", "powers of units are whole numbers"),
            ("m^101", "the powers in `m^101` are too large"),
            ("((((((m^100)^100)^100)^100)^100)^100)", "the powers in"),
            ("kg/m s", "in `kg/m s` it is not clear what divides"),
            ("10 N", "`10` is a factor"),
            ("kg/(m s", "a bracket of `kg/(m s` is not closed"),
            ("kg)", "`kg)` has a closing bracket too many"),
            ("N/", "`N/` breaks off"),
            ("/s", "`/` in `/s` stands where a unit belongs"),
            (&"(".repeat(1000), "`((("),
        ] {
            let message = read(text).expect_err(text);
            assert!(message.starts_with(start), "{text}: {message}");
        }
    }
}
