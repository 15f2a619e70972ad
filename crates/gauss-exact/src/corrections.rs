//! The corrections of the discrete Moser–Veselov method as polynomials: computed in exact arithmetic by
//! `tests/references/moser_veselov.py`, orders 4 and 6 as published by Hairer & Vilmart (J. Phys. A 39, 2006).

use gauss_runtime::real::Real;

/// `p/q · e₁ᵃ e₂ᵇ e₃ᶜ/e₃^(m+n) · Nᵐ Hⁿ`: e are the elementary symmetric functions of the moments.
#[derive(Clone, Copy)]
struct Term {
    powers: (usize, usize),
    symmetric: [i32; 3],
    value: (i64, i64),
}

impl Term {
    const fn new(m: usize, n: usize, symmetric: [i32; 3], p: i64, q: i64) -> Self {
        Self { powers: (m, n), symmetric, value: (p, q) }
    }
}

/// s − 1 and d as polynomials in N and H for one body: entry [m + n − 1][n].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corrections<T> {
    s: [[T; 5]; 4],
    d: [[T; 5]; 4],
    degree: usize,
}

impl<T: Real> Corrections<T> {
    /// To the given degree ≤ 4 in N and H, for a body with these moments.
    pub(crate) fn new([a, b, c]: [T; 3], degree: usize) -> Self {
        let symmetric = [a + b + c, a * b + b * c + c * a, a * b * c];
        let gather = |terms: &[Term]| {
            let mut table = [[T::zero(); 5]; 4];
            for Term { powers: (m, n), symmetric: exponents, value: (p, q) } in terms {
                let product = (0..2).fold(T::ratio(*p, *q), |product, i| product * symmetric[i].powi(exponents[i]));
                table[m + n - 1][*n] += product * symmetric[2].powi(exponents[2] - (m + n) as i32);
            }
            table
        };
        Self { s: gather(S), d: gather(D), degree }
    }

    /// (s − 1, d) for N = h²|y|²/2, H = h²T.
    #[inline]
    pub(crate) fn at(&self, n: T, h: T) -> (T, T) {
        let form = |row: &[T; 5], degree: usize| {
            let (mut sum, mut power) = (row[0], T::one());
            for k in 1..=degree {
                power *= h;
                sum = sum * n + row[k] * power;
            }
            sum
        };
        let (mut s, mut d) = (T::zero(), T::zero());
        for degree in (1..=self.degree).rev() {
            s += form(&self.s[degree - 1], degree);
            d += form(&self.d[degree - 1], degree);
        }
        (s, d)
    }
}

const S: &[Term] = &[
    Term::new(1, 0, [1, 0, 0], 1, 6),
    Term::new(0, 1, [0, 1, 0], -1, 3),
    Term::new(2, 0, [2, 0, 0], 1, 30),
    Term::new(2, 0, [0, 1, 0], -1, 10),
    Term::new(1, 1, [1, 1, 0], -1, 30),
    Term::new(1, 1, [0, 0, 1], 2, 15),
    Term::new(0, 2, [0, 2, 0], 1, 30),
    Term::new(0, 2, [1, 0, 1], -1, 60),
    Term::new(3, 0, [3, 0, 0], 17, 2520),
    Term::new(3, 0, [1, 1, 0], -11, 420),
    Term::new(3, 0, [0, 0, 1], 5, 126),
    Term::new(2, 1, [2, 1, 0], -1, 70),
    Term::new(2, 1, [0, 2, 0], 11, 210),
    Term::new(2, 1, [1, 0, 1], -1, 84),
    Term::new(1, 2, [1, 2, 0], 1, 420),
    Term::new(1, 2, [2, 0, 1], 41, 2520),
    Term::new(1, 2, [0, 1, 1], -53, 630),
    Term::new(0, 3, [0, 3, 0], -1, 630),
    Term::new(0, 3, [1, 1, 1], 1, 630),
    Term::new(0, 3, [0, 0, 2], 1, 35),
    Term::new(4, 0, [4, 0, 0], 31, 22680),
    Term::new(4, 0, [2, 1, 0], -19, 2520),
    Term::new(4, 0, [0, 2, 0], 1, 120),
    Term::new(4, 0, [1, 0, 1], 97, 15120),
    Term::new(3, 1, [3, 1, 0], -11, 3240),
    Term::new(3, 1, [1, 2, 0], 17, 1260),
    Term::new(3, 1, [2, 0, 1], 47, 7560),
    Term::new(3, 1, [0, 1, 1], -47, 945),
    Term::new(2, 2, [2, 2, 0], 13, 3780),
    Term::new(2, 2, [0, 3, 0], -17, 1260),
    Term::new(2, 2, [3, 0, 1], 1, 2520),
    Term::new(2, 2, [1, 1, 1], 1, 252),
    Term::new(2, 2, [0, 0, 2], 53, 1260),
    Term::new(1, 3, [1, 3, 0], -1, 11340),
    Term::new(1, 3, [2, 1, 1], -11, 1890),
    Term::new(1, 3, [0, 2, 1], 23, 945),
    Term::new(1, 3, [1, 0, 2], -23, 1260),
    Term::new(0, 4, [0, 4, 0], 1, 22680),
    Term::new(0, 4, [1, 2, 1], -1, 15120),
    Term::new(0, 4, [2, 0, 2], 17, 5040),
    Term::new(0, 4, [0, 1, 2], -3, 280),
];
const D: &[Term] = &[
    Term::new(1, 0, [0, 0, 0], -1, 3),
    Term::new(0, 1, [1, 0, 0], 1, 6),
    Term::new(2, 0, [1, 0, 0], -1, 60),
    Term::new(1, 1, [2, 0, 0], -1, 60),
    Term::new(1, 1, [0, 1, 0], 2, 15),
    Term::new(0, 2, [1, 1, 0], -1, 60),
    Term::new(0, 2, [0, 0, 1], -1, 10),
    Term::new(3, 0, [2, 0, 0], -19, 2520),
    Term::new(3, 0, [0, 1, 0], 1, 35),
    Term::new(2, 1, [3, 0, 0], 1, 1260),
    Term::new(2, 1, [1, 1, 0], -1, 1260),
    Term::new(2, 1, [0, 0, 1], -22, 315),
    Term::new(1, 2, [2, 1, 0], 13, 2520),
    Term::new(1, 2, [0, 2, 0], -8, 315),
    Term::new(1, 2, [1, 0, 1], 11, 252),
    Term::new(0, 3, [1, 2, 0], 1, 1260),
    Term::new(0, 3, [2, 0, 1], -13, 1260),
    Term::new(0, 3, [0, 1, 1], 1, 42),
    Term::new(4, 0, [3, 0, 0], -61, 45360),
    Term::new(4, 0, [1, 1, 0], 3, 560),
    Term::new(4, 0, [0, 0, 1], -61, 4536),
    Term::new(3, 1, [4, 0, 0], -1, 45360),
    Term::new(3, 1, [2, 1, 0], 37, 7560),
    Term::new(3, 1, [0, 2, 0], -2, 105),
    Term::new(3, 1, [1, 0, 1], 19, 1260),
    Term::new(2, 2, [3, 1, 0], -1, 1512),
    Term::new(2, 2, [1, 2, 0], 19, 7560),
    Term::new(2, 2, [2, 0, 1], -19, 1080),
    Term::new(2, 2, [0, 1, 1], 89, 1890),
    Term::new(1, 3, [2, 2, 0], -1, 1512),
    Term::new(1, 3, [0, 3, 0], 8, 2835),
    Term::new(1, 3, [3, 0, 1], 97, 22680),
    Term::new(1, 3, [1, 1, 1], -23, 1890),
    Term::new(1, 3, [0, 0, 2], -1, 35),
    Term::new(0, 4, [1, 3, 0], -1, 45360),
    Term::new(0, 4, [2, 1, 1], -1, 7560),
    Term::new(0, 4, [0, 2, 1], -1, 360),
    Term::new(0, 4, [1, 0, 2], 17, 1680),
];
