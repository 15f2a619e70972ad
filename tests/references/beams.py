"""Integrals of the modes of uniform cantilevers, as files of `modes(…, file = …)`.

Bending modes are those of Euler and Bernoulli, of unit modal mass; stretching is the shape that a centrifugal load
has, φ = (3ξ − ξ³)/2, of tip displacement 1. A deflection shortens the beam: ψ_kl(x) = −∫₀ˣ φ_k′·φ_l′ ds along the
axis. Everything else is the definition of the integrals, evaluated by Gauss–Legendre quadrature with 40 digits.

    python beams.py            writes the files
    python beams.py spin       prints frequencies of spinning beams, found without modes (for tests/flexible)
"""

import json
import sys
from pathlib import Path

from mpmath import cos, cosh, findroot, mp, mpf, sin, sinh, sqrt

mp.dps = 40
ROOT = Path(__file__).resolve().parents[2]
PIECES, ORDER = 24, 14
X, Y, Z = range(3)


def legendre(n):
    """Nodes and weights on [−1, 1]."""

    def polynomial(x):
        """P_n and its derivative."""
        before, now = mpf(1), x
        for k in range(2, n + 1):
            before, now = now, ((2 * k - 1) * x * now - (k - 1) * before) / k
        return now, n * (x * now - before) / (x**2 - 1)

    rule = []
    for k in range(n):
        x = cos(mp.pi * (k + mpf(3) / 4) / (n + mpf(1) / 2))
        for _ in range(8):
            value, slope = polynomial(x)
            x -= value / slope
        rule.append((x, 2 / ((1 - x**2) * polynomial(x)[1] ** 2)))
    return sorted(rule)


RULE = legendre(ORDER)


def nodes(length):
    """Nodes with weights on [0, length]."""
    h = length / PIECES
    return [(h * (k + (1 + x) / 2), w * h / 2) for k in range(PIECES) for x, w in RULE]


class Bending:
    """The k-th mode of a clamped beam, deflecting along an axis."""

    def __init__(self, k, axis, length, density, stiffness):
        guess = (k - mpf(1) / 2) * mp.pi if k > 1 else mpf("1.8751")
        root = findroot(lambda b: cos(b) * cosh(b) + 1, guess)
        self.axis, self.beta = axis, root / length
        self.sigma = (cosh(root) + cos(root)) / (sinh(root) + sin(root))
        self.norm = 1 / sqrt(density * length)
        self.omega = self.beta**2 * sqrt(stiffness / density)

    def value(self, x):
        b = self.beta * x
        return self.norm * (cosh(b) - cos(b) - self.sigma * (sinh(b) - sin(b)))

    def slope(self, x):
        b = self.beta * x
        return self.norm * self.beta * (sinh(b) + sin(b) - self.sigma * (cosh(b) - cos(b)))


class Stretching:
    """What a centrifugal load does, of tip displacement 1."""

    def __init__(self, length):
        self.axis, self.length = X, length

    def value(self, x):
        xi = x / self.length
        return (3 * xi - xi**3) / 2


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def symmetric(a, b):
    """The bilinear form of the inertia: xx, yy, zz, xy, xz, yz of a·b 1 − (a bᵀ + b aᵀ)/2."""
    pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
    return [(dot(a, b) if i == j else 0) - (a[i] * b[j] + a[j] * b[i]) / 2 for i, j in pairs]


def integrals(modes, length, density):
    points = nodes(length)
    bends = [k for k, mode in enumerate(modes) if mode.axis != X]
    shortening = {}
    for k in bends:
        for l in bends:
            if modes[k].axis == modes[l].axis and k <= l:
                shortening[k, l] = shortenings(modes[k], modes[l], [x for x, _ in points])
    unit = [[mpf(int(i == axis)) for i in range(3)] for axis in range(3)]
    shape = [[[mode.value(x) * e for e in unit[mode.axis]] for x, _ in points] for mode in modes]
    n = len(modes)
    weights = [density * w for _, w in points]
    place = [[x, mpf(0), mpf(0)] for x, _ in points]
    zero = [[mpf(0)] * 3 for _ in points]

    def short(k, l):
        own = shortening.get((min(k, l), max(k, l)))
        return zero if own is None else [[s, mpf(0), mpf(0)] for s in own]

    def integral(f):
        values = [f(p) for p in range(len(points))]
        return [sum(w * v[i] for w, v in zip(weights, values)) for i in range(len(values[0]))]

    def pair(k, l):
        psi = short(k, l)
        return (
            integral(lambda p: psi[p]),
            integral(lambda p: [a + b for a, b in zip(cross(shape[l][p], shape[k][p]), cross(place[p], psi[p]))]),
            integral(
                lambda p: [
                    2 * (a + b)
                    for a, b in zip(symmetric(shape[k][p], shape[l][p]), symmetric(place[p], psi[p]))
                ]
            ),
        )

    pairs = [[pair(k, l) for l in range(n)] for k in range(n)]
    return {
        "translation": [integral(lambda p: shape[k][p]) for k in range(n)],
        "rotation": [integral(lambda p: cross(place[p], shape[k][p])) for k in range(n)],
        "mass": [[integral(lambda p: [dot(shape[k][p], shape[l][p])])[0] for l in range(n)] for k in range(n)],
        "inertia": [integral(lambda p: [2 * e for e in symmetric(place[p], shape[k][p])]) for k in range(n)],
        "shortening": [[pairs[k][l][0] for l in range(n)] for k in range(n)],
        "gyroscopic": [[pairs[k][l][1] for l in range(n)] for k in range(n)],
        "second_inertia": [[pairs[k][l][2] for l in range(n)] for k in range(n)],
    }


def shortenings(a, b, places):
    """−∫₀ˣ φ_a′ φ_b′ ds at all places, which ascend."""
    total, last, values = mpf(0), mpf(0), []
    for x in places:
        half = (x - last) / 2
        total -= sum(w * half * a.slope(s) * b.slope(s) for s, w in ((last + half * (1 + t), w) for t, w in RULE))
        last = x
        values.append(total)
    return values


def rounded(value):
    """17 digits; what is zero up to the quadrature is zero."""
    if isinstance(value, list):
        return [rounded(entry) for entry in value]
    return 0 if abs(value) < mpf("1e-22") else float(value)


def write(path, comment, rigid, modes, stiffness, length, density, damping=None, second=True):
    found = integrals(modes, length, density)
    if not second:
        found = {key: found[key] for key in ("translation", "rotation", "mass")}
    found["stiffness"] = stiffness
    if damping is not None:
        found["damping"] = damping
    lines = [f'  "comment": {json.dumps(comment)},']
    lines += [f'  "{key}": {json.dumps(rounded(value))},' for key, value in rigid.items()]
    lines.append('  "modes": {')
    lines.append(",\n".join(f'    "{key}": {json.dumps(rounded(value))}' for key, value in found.items()))
    lines.append("  }")
    (ROOT / path).write_text("{\n" + "\n".join(lines) + "\n}\n")
    print(path)


def kane():
    """The beam of the spin-up manoeuvre: L 10, ρA 1.2, EI 1.4e4, EA 2.8e7."""
    length, density, bending, axial = mpf(10), mpf("1.2"), mpf(14000), mpf(28000000)
    mass = density * length
    slender = {"mass": mass, "center_of_mass": [length / 2, mpf(0), mpf(0)]}
    slender["inertia"] = [mpf(0), mass * length**2 / 3, mass * length**2 / 3]
    in_plane = [Bending(k, Y, length, density, bending) for k in (1, 2, 3)]
    write(
        "tests/flexible/spin_up.json",
        "The spin-up beam: stretching, then three bending modes in the plane",
        slender,
        [Stretching(length), *in_plane],
        [mpf(6) / 5 * axial / length, *(mode.omega**2 for mode in in_plane)],
        length,
        density,
    )
    across = [Bending(k, Z, length, density, bending) for k in (1, 2, 3, 4)]
    stiffness = [mode.omega**2 for mode in across]
    comment = "The spin-up beam: four bending modes across the plane"
    write("tests/flexible/flap.json", comment, slender, across, stiffness, length, density)


def array():
    """A solar array: 6 m by 1.6 m, 15 kg, its hinge line along e₂; out of its plane softer than in it."""
    length, width, mass = mpf(6), mpf("1.6"), mpf(15)
    density = mass / length
    out, within = mpf(700), mpf(24000)
    modes = [Bending(k, Z, length, density, out) for k in (1, 2)] + [Bending(1, Y, length, density, within)]
    edge = mass * width**2 / 12
    rigid = {
        "mass": mass,
        "center_of_mass": [length / 2, mpf(0), mpf(0)],
        "inertia": [edge, mass * length**2 / 3, mass * length**2 / 3 + edge],
    }
    stiffness = [mode.omega**2 for mode in modes]
    damping = [2 * mpf("0.005") * mode.omega for mode in modes]
    comment = "A solar array, 6 m by 1.6 m, 15 kg: two modes out of its plane, one in it; damping ratio 0.005"
    write("examples/data/array.json", comment, rigid, modes, stiffness, length, density, damping)


def spin():
    """Flapping of a beam that spins about its root: w⁗ − γ² ((1 − ξ²)/2 w′)′ = λ² w, by power series about the tip.

    γ and λ are the rates of spin and of flapping in units of √(EI/ρAL⁴). With s = 1 − ξ the tension is s − s²/2.
    """

    def residual(gamma, lam):
        columns = []
        for start in ([1, 0], [0, 1]):
            a = [mpf(start[0]), mpf(start[1]), mpf(0), mpf(0)]
            # Σ a_n sⁿ: n(n−1)(n−2)(n−3) a_n sⁿ⁻⁴ = γ² ((s − s²/2) w′)′ + λ² w.
            for n in range(4, 90):
                m = n - 4
                tension = (m + 1) ** 2 * a[m + 1] - mpf(m * (m + 1)) / 2 * a[m]
                a.append((gamma**2 * tension + lam**2 * a[m]) / (n * (n - 1) * (n - 2) * (n - 3)))
            columns.append([sum(a), sum(n * c for n, c in enumerate(a))])
        return columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0]

    for gamma in (0, 2, 4, 6):
        roots = []
        lam, step = mpf("0.5"), mpf("0.05")
        last = residual(gamma, lam)
        while len(roots) < 2:
            now = residual(gamma, lam + step)
            if last * now < 0:
                roots.append(findroot(lambda x: residual(gamma, x), (lam, lam + step), solver="anderson"))
            lam, last = lam + step, now
        print(gamma, *(mp.nstr(root, 17) for root in roots))


if __name__ == "__main__":
    if sys.argv[1:] == ["spin"]:
        spin()
    else:
        kane()
        array()
