"""Corrections of the preprocessed discrete Moser-Veselov method (Hairer & Vilmart 2006), to order 10.

The method turns a free body by the Cayley transform of c, with

    Ĩ_i c_i = (1 + |c|²) (h/2) y_i + (Ĩ_j - Ĩ_k) c_j c_k        (i, j, k cyclic)

and modified moments 1/Ĩ_i = s/I_i + d. The exact motion has a vector c(h) of its own, a power series. Put into the three
equations it leaves three linear ones for Ĩ(h); that 1/Ĩ is of the form s/I + d, with one pair (s, d) for three axes, is
checked. s and d are polynomials in N = h²|y|²/2 and H = h²T(y), whose coefficients are symmetric in the moments,

    s: Σ P(e1, e2, e3)/e3^(m+n) N^m H^n,  P of weight m + 2n,     d: the same with P of weight m + 2n - 1,

where e1, e2, e3 are the elementary symmetric functions of I, of weights 1, 2, 3. The rational numbers in P are found from
samples in exact arithmetic, and tested on samples that did not take part. Orders 4 and 6 are those of the paper.

Run: `python moser_veselov.py`; standard library only, a few seconds. It prints the tables of
`gauss-exact/src/corrections.rs`.
"""

from fractions import Fraction
from random import Random

HALF_ORDER = 4  # s and d to (N, H)^4: order 10
TERMS = 2 * HALF_ORDER + 4  # of power series in h


def product(a, b):
    out = [Fraction(0)] * TERMS
    for i, x in enumerate(a):
        if x:
            for j in range(TERMS - i):
                out[i + j] += x * b[j]
    return out


def add(*series):
    return [sum(terms) for terms in zip(*series)]


def scale(factor, a):
    return [factor * x for x in a]


def quotient(a, b):
    """a/b, where b starts with a constant."""
    out = []
    for n in range(TERMS):
        out.append((a[n] - sum((b[k] * out[n - k] for k in range(1, n + 1)), Fraction(0))) / b[0])
    return out


def exact_cayley_vector(inertia, y):
    """c(h)/h of the exact motion: vector part over scalar part of the quaternion."""
    momenta = [[y[i]] for i in range(3)]
    q = [[Fraction(v)] for v in (0, 0, 0, 1)]
    for n in range(TERMS):
        def coefficient(a, b):
            return sum(a[k] * b[n - k] for k in range(n + 1))

        omega = [[v / inertia[i] for v in momenta[i]] for i in range(3)]
        rate = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            rate.append(coefficient(momenta[j], omega[k]) - coefficient(momenta[k], omega[j]))
        x, w = q[:3], q[3]
        turn = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            turn.append((coefficient(w, omega[i]) + coefficient(x[j], omega[k]) - coefficient(x[k], omega[j])) / 2)
        turn.append(-sum(coefficient(x[i], omega[i]) for i in range(3)) / 2)
        for i in range(3):
            momenta[i].append(rate[i] / (n + 1))
        for i in range(4):
            q[i].append(turn[i] / (n + 1))
    w = q[3][:TERMS]
    return [quotient(q[i][1 : TERMS + 1], w) for i in range(3)]


def corrections(inertia, y):
    """The series s(h) and d(h)."""
    c = exact_cayley_vector(inertia, y)  # over h
    zero, h, h_squared = [[Fraction(int(n == m)) for n in range(TERMS)] for m in (-1, 1, 2)]
    one = [Fraction(int(n == 0)) for n in range(TERMS)]
    square = add(*(product(x, x) for x in c))
    right = [scale(y[i] / 2, add(one, product(h_squared, square))) for i in range(3)]
    # Row i: Ĩ_i c_i - (Ĩ_j - Ĩ_k) h c_j c_k, with c over h.
    rows = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        coupling = product(h, product(c[j], c[k]))
        row = [zero] * 3
        row[i], row[j], row[k] = c[i], scale(-1, coupling), coupling
        rows.append(row)
    # The diagonal starts with constants and the rest with h: elimination without pivoting.
    for i in range(3):
        for r in range(3):
            if r != i:
                factor = quotient(rows[r][i], rows[i][i])
                rows[r] = [add(a, scale(-1, product(factor, b))) for a, b in zip(rows[r], rows[i])]
                right[r] = add(right[r], scale(-1, product(factor, right[i])))
    inverse = [quotient(rows[i][i], right[i]) for i in range(3)]
    s = scale(1 / (1 / inertia[0] - 1 / inertia[1]), add(inverse[0], scale(-1, inverse[1])))
    d = add(inverse[0], scale(-1 / inertia[0], s))
    third = add(scale(1 / inertia[2], s), d)
    usable = 2 * HALF_ORDER + 1
    assert third[:usable] == inverse[2][:usable], "one pair (s, d) does for three axes"
    assert not any(s[1:usable:2]) and not any(d[1:usable:2]), "even in h"
    return s, d


def monomials(weight):
    """Exponents (a, b, c) of e1^a e2^b e3^c of the given weight."""
    return [
        (weight - 2 * b - 3 * c, b, c)
        for c in range(weight // 3 + 1)
        for b in range((weight - 3 * c) // 2 + 1)
    ]


def solve(rows, right):
    """An overdetermined, consistent system over the rational numbers."""
    size = len(rows[0])
    table = [row + [value] for row, value in zip(rows, right)]
    for column in range(size):
        pivot = next(r for r in range(column, len(table)) if table[r][column] != 0)
        table[column], table[pivot] = table[pivot], table[column]
        lead = table[column][column]
        table[column] = [v / lead for v in table[column]]
        for r in range(len(table)):
            if r != column and table[r][column] != 0:
                factor = table[r][column]
                table[r] = [a - factor * b for a, b in zip(table[r], table[column])]
    assert all(row[size] == 0 for row in table[size:]), "the ansatz holds on the samples left over"
    return [table[i][size] for i in range(size)]


def samples(number):
    random = Random(1)
    found = []
    while True:
        inertia = [Fraction(random.randint(1, 9)) for _ in range(3)]
        y = [Fraction(random.randint(1, 9)) for _ in range(3)]
        if len(set(inertia)) == 3:
            found.append((inertia, y, *corrections(inertia, y)))
        if len(found) == number:
            return found


def polynomials(half_order, of_d, data):
    """{(m, n): {(a, b, c): coefficient}} for the terms with m + n = half_order of s, or of d."""
    unknowns = [
        (half_order - n, n, exponents)
        for n in range(half_order + 1)
        for exponents in monomials(half_order + n - of_d)
    ]
    rows, right = [], []
    for inertia, y, s, d in data[: len(unknowns) + 8]:
        i1, i2, i3 = inertia
        e1, e2, e3 = i1 + i2 + i3, i1 * i2 + i2 * i3 + i3 * i1, i1 * i2 * i3
        big_n, big_h = sum(v * v for v in y) / 2, sum(v * v / i for v, i in zip(y, inertia)) / 2
        rows.append(
            [big_n**m * big_h**n * e1**a * e2**b * e3**c / e3 ** (m + n) for m, n, (a, b, c) in unknowns]
        )
        right.append((d if of_d else s)[2 * half_order])
    out = {}
    for (m, n, exponents), value in zip(unknowns, solve(rows, right)):
        if value:
            out.setdefault((m, n), {})[exponents] = value
    return out


def main():
    data = samples(50)
    for of_d, name in ((0, "S"), (1, "D")):
        print(f"const {name}: &[Term] = &[")
        for half_order in range(1, HALF_ORDER + 1):
            for (m, n), terms in polynomials(half_order, of_d, data).items():
                for exponents, value in terms.items():
                    print(f"    Term::new({m}, {n}, {list(exponents)}, {value.numerator}, {value.denominator}),")
        print("];")


if __name__ == "__main__":
    main()
