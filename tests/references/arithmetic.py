"""Numbers of three kinds behind one interface: MPFR (gmpy2), mpmath, and double precision (real or complex).

The mechanics of this folder is written once, for any of them: two multiprecision libraries check each other, and double
precision shows what an ordinary integrator reaches.
"""

import cmath
import math
from fractions import Fraction

import gmpy2
import mpmath


class Mpfr:
    """MPFR floating point with the given number of bits."""

    def __init__(self, bits):
        self.bits = bits
        self.name = f"MPFR, {bits} bits"
        gmpy2.get_context().precision = bits
        self.sqrt, self.sin, self.cos, self.atan2 = gmpy2.sqrt, gmpy2.sin, gmpy2.cos, gmpy2.atan2

    def __call__(self, text):
        """The number nearest to an exact decimal or fraction `p/q`."""
        return gmpy2.mpfr(gmpy2.mpq(Fraction(text)), self.bits)


class Mpmath:
    """mpmath's floating point with the given number of decimal digits."""

    def __init__(self, digits):
        self.name = f"mpmath, {digits} digits"
        mpmath.mp.dps = digits
        self.sqrt, self.sin, self.cos, self.atan2 = mpmath.sqrt, mpmath.sin, mpmath.cos, mpmath.atan2

    def __call__(self, text):
        """The number nearest to an exact decimal or fraction `p/q`."""
        value = Fraction(text)
        return mpmath.mpf(value.numerator) / value.denominator


def either(name):
    """A function of real or complex numbers."""
    real, imaginary = getattr(math, name), getattr(cmath, name)
    return staticmethod(lambda x: imaginary(x) if isinstance(x, complex) else real(x))


class Double:
    """Double precision; complex numbers are let through, for derivatives by a complex step."""

    name = "double precision"
    sqrt, sin, cos = either("sqrt"), either("sin"), either("cos")
    atan2 = staticmethod(math.atan2)

    def __call__(self, text):
        """The number nearest to an exact decimal or fraction `p/q`."""
        return float(Fraction(text))


def digits(value, count):
    """A number of any kind as a decimal with `count` digits; what is below 10^-count is zero to that accuracy."""
    with mpmath.workdps(count + 30):
        exact = mpmath.mpf(str(value)) if not isinstance(value, mpmath.mpf) else value
        if abs(exact) < mpmath.mpf(10) ** -count:
            return "0.0"
        return mpmath.nstr(exact, count)


def as_mpmath(value):
    """A number of any kind in mpmath, without loss at the precision that is set."""
    return value if isinstance(value, mpmath.mpf) else mpmath.mpf(str(value))
