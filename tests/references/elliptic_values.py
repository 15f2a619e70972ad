"""Jacobi's functions and the integrals of the first and third kind, for the tests of `gauss-exact`.

Run: `pip install mpmath`, then `python elliptic_values.py`. It writes the tables
`crates/gauss-exact/tests/data/elliptic_*.csv`.
"""

from pathlib import Path
from random import Random

from mpmath import atan2, cos, ellipf, ellipfun, ellipk, elliprj, mp, mpf, sin, sqrt

mp.dps = 40


def functions():
    for complement in map(mpf, (1.0, 0.9, 0.5, 0.1, 0.001, 1e-6, 1e-9, 1e-14)):
        m = 1 - complement**2
        for fraction in (1e-9, 0.01, 0.3, 0.7, 0.95, 1.02, 1.6, 2.3, 3.7, 11.3):
            u = mpf(float(fraction * ellipk(m)))
            if fraction < 5 or complement > 1e-5:
                yield complement, u, *(ellipfun(name, u, m=m) for name in ("sn", "cn", "dn"))


def integrals():
    random = Random(3)
    for complement in map(mpf, (1.0, 0.9, 0.3, 0.001, 1e-9)):
        for g in (random.random(), 3.0, 1e6):
            g = mpf(g) if g > 1 else mpf(float(g * complement**2))
            for phase in map(mpf, (1e-8, 0.2, 1.1, 1.57, 1.5706)):
                # The smaller of sine and cosine is a rounded number, so that rounding the other one loses nothing.
                if phase < 1:
                    sn = mpf(float(sin(phase)))
                    cn = sqrt(1 - sn**2)
                else:
                    cn = mpf(float(cos(phase)))
                    sn = sqrt(1 - cn**2)
                square = cn**2 + complement**2 * sn**2
                first = ellipf(atan2(sn, cn), 1 - complement**2)
                third = sn**3 * elliprj(cn**2, square, 1, cn**2 + g * sn**2) / 3
                yield complement, g, sn, cn, sqrt(square), first, third


DATA = Path(__file__).parents[2] / "crates/gauss-exact/tests/data"
TABLES = {
    "functions": ("k',u,sn,cn,dn", functions()),
    "integrals": ("k',g,sn,cn,dn,first kind,third kind", integrals()),
}
for name, (heading, rows) in TABLES.items():
    lines = [heading, *(",".join(repr(float(value)) for value in row) for row in rows)]
    (DATA / f"elliptic_{name}.csv").write_text("\n".join(lines) + "\n")
