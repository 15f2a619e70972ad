//! Units of the scene as those of FMI: a name, and exponents of the base units of the SI.

/// Base units of FMI that scenes have, in the order of their exponents.
pub const BASE: [&str; 4] = ["kg", "m", "s", "rad"];

/// Units with a name of their own, by their exponents.
const NAMED: [(&str, [i32; 4]); 10] = [
    ("kg", [1, 0, 0, 0]),
    ("m", [0, 1, 0, 0]),
    ("s", [0, 0, 1, 0]),
    ("rad", [0, 0, 0, 1]),
    ("1", [0; 4]),
    ("N", [1, 1, -2, 0]),
    ("J", [1, 2, -2, 0]),
    ("W", [1, 2, -3, 0]),
    ("Pa", [1, -1, -2, 0]),
    ("Hz", [0, 0, -1, 0]),
];

/// The exponents of a unit such as `N s^2/m^2` or `kg/(m s)`; `None` of one that is written in another way, which has
/// a name and nothing else.
pub fn exponents(unit: &str) -> Option<[i32; 4]> {
    let (mut total, mut sign) = ([0; 4], 1);
    let spaced = unit.replace('/', " / ").replace('(', " ( ").replace(')', " ) ").replace(['*', '·', '⋅'], " ");
    let mut is_open = false;
    for word in spaced.split_whitespace() {
        match word {
            "/" if sign == 1 => sign = -1,
            "(" if sign == -1 && !is_open => is_open = true,
            ")" if is_open => (is_open, sign) = (false, 1),
            "/" | "(" | ")" => return None,
            _ => {
                let (name, power) = word.split_once('^').unwrap_or((word, "1"));
                let power = power.parse::<i32>().ok()? * sign;
                let (_, own) = NAMED.iter().find(|(known, _)| *known == name)?;
                total.iter_mut().zip(own).for_each(|(total, own)| *total += own * power);
                sign = if is_open { sign } else { 1 };
            }
        }
    }
    (!is_open).then_some(total)
}

#[cfg(test)]
mod tests {
    use super::exponents;

    #[test]
    fn units_as_scenes_write_them() {
        assert_eq!(exponents("N m"), Some([1, 2, -2, 0]));
        assert_eq!(exponents("N s^2/m^2"), Some([1, -1, 0, 0]));
        assert_eq!(exponents("kg/(m s)"), Some([1, -1, -1, 0]));
        assert_eq!(exponents("m/s^2"), Some([0, 1, -2, 0]));
        assert_eq!(exponents("rad/s"), Some([0, 0, -1, 1]));
        assert_eq!(exponents("furlong"), None);
    }
}
