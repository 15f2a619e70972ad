"""From a scene to its JSON file: two integrations with different arithmetic, order and steps, and what double precision
reaches."""

import json
import math
import time
from pathlib import Path

import mpmath
import scipy.integrate

from arithmetic import Double, Mpfr, Mpmath, as_mpmath, digits
from extrapolation import integrate
from vectors import unit

DATA = Path(__file__).resolve().parent.parent / "data" / "reference"
DIGITS = 36
CONVENTIONS = (
    "R: body->space (rows listed), xhat = R x + b, u = R^T bdot, omega body angular velocity; gravity along -k3 "
    "unless the description says otherwise; inertias about O, body axes; q and z in the order of `coordinates` "
    "and `speeds`, angles not reduced; all parameters and the initial state exact"
)


class Scene:
    """What a scene defines. `arithmetic` makes its numbers; everything else is the class's."""

    name = kind = description = source = script = ""
    parameters, coordinates, speeds, start, duration = {}, (), (), (), "1"
    # Where `start` has a quaternion, which need not be of unit length.
    quaternion = None
    extra = {}

    def __init__(self, arithmetic):
        self.arithmetic = arithmetic

    def number(self, key):
        """A parameter, or a nested list of them."""
        return nested(self.arithmetic, self.parameters[key])

    def place(self, start, t):
        """The state of the integration that belongs to numbers like those of `start` at the time t."""
        raise NotImplementedError

    def rates(self, t, y):
        """ẏ."""
        raise NotImplementedError

    def reduced(self, t, y):
        """Numbers like those of `start` in two lists: the rates of the coordinates among them, and the speeds."""
        raise NotImplementedError

    def observe(self, t, y):
        """What the file lists: key → numbers, nested."""
        raise NotImplementedError

    def conserved(self, t, y):
        """Quantities that the motion keeps: key → number or list."""
        raise NotImplementedError

    def residuals(self, t, y):
        """What vanishes along the motion: key → number."""
        return {}

    def further(self, t, y):
        """More for the file, from the final state."""
        return {}


def nested(function, value):
    """Applies a function to the leaves of nested lists."""
    return [nested(function, item) for item in value] if isinstance(value, (list, tuple)) else function(value)


def leaves(value):
    """The leaves of nested lists in order."""
    return [leaf for item in value for leaf in leaves(item)] if isinstance(value, (list, tuple)) else [value]


def run(kind, arithmetic, tolerance, k):
    """Initial and final state of one integration, with the scene that understands them."""
    scene = kind(arithmetic)
    start = scene.place([arithmetic(text) for text in kind.start], arithmetic("0"))
    began = time.time()
    last, steps = integrate(scene.rates, start, arithmetic(kind.duration), arithmetic(tolerance), k, arithmetic("1/64"))
    print(f"  {arithmetic.name}, order {2 * k}: {steps} steps, {time.time() - began:.0f} s", flush=True)
    return scene, start, last, steps


def distance(found, expected):
    """The largest error over the keys, relative to the largest number of the key or to 1."""
    worst = mpmath.mpf(0)
    for key, value in expected.items():
        wanted = [as_mpmath(x) for x in leaves(value)]
        size = max([mpmath.mpf(1)] + [abs(x) for x in wanted])
        errors = [abs(as_mpmath(a) - b) / size for a, b in zip(leaves(found[key]), wanted)]
        worst = max([worst] + errors)
    return worst


def double_run(kind, start):
    """The observed final state of DOP853 in double precision on the independent numbers, and the number of evaluations.

    The speeds change at the rate at which the motion of the bodies changes them, found by a complex step.
    """
    scene = kind(Double())
    if kind.quaternion is not None:
        part = slice(kind.quaternion, kind.quaternion + 4)
        start = list(start)
        start[part] = unit(scene.arithmetic, start[part])
    tiny = 1e-40

    def rates(t, numbers):
        y = scene.place(list(numbers), t)
        coordinate_rates, _ = scene.reduced(t, y)
        shifted = [a + 1j * tiny * b for a, b in zip(y, scene.rates(t, y))]
        _, speeds = scene.reduced(t + 1j * tiny, shifted)
        return list(coordinate_rates) + [z.imag / tiny for z in speeds]

    end = float(kind.duration)
    solution = scipy.integrate.solve_ivp(rates, (0.0, end), start, "DOP853", rtol=1e-13, atol=1e-15)
    return scene.observe(end, scene.place([float(x) for x in solution.y[:, -1]], end)), solution.nfev


def guide(kind, final):
    """Sensitivity to one rounding of the initial data, and the error of DOP853 with the relative tolerance 1e-13."""
    start = [Double()(text) for text in kind.start]
    base, evaluations = double_run(kind, start)
    square, size = 0.0, 1e-6
    for index, value in enumerate(start):
        if value != 0.0:
            moved, _ = double_run(kind, [x * (1 + size) if i == index else x for i, x in enumerate(start)])
            square += float(distance(moved, base)) ** 2
    return {
        "change_if_initial_state_perturbed_by_2em53_relative": f"{math.sqrt(square) / size * 2.0**-53:.1e}",
        "scipy_DOP853_rtol1e_13": {
            "independent_coordinates": {
                "error_rel": f"{float(distance(base, final)):.1e}",
                "rhs_evaluations": evaluations,
            },
        },
    }


def publish(kind, tolerance="1e-42"):
    """Computes a scene and writes its file."""
    print(kind.name, flush=True)
    scene, start, last, steps = run(kind, Mpfr(240), tolerance, 22)
    end = scene.arithmetic(kind.duration)
    zero = end * 0
    final = scene.observe(end, last)
    other_scene, _, other_last, other_steps = run(kind, Mpmath(66), tolerance, 19)
    difference = distance(other_scene.observe(other_scene.arithmetic(kind.duration), other_last), final)
    agreeing = float(-mpmath.log10(difference))
    assert agreeing > DIGITS + 1, f"only {agreeing} digits"
    scene.arithmetic = Mpfr(240)
    conserved = {}
    after = scene.conserved(end, last)
    for key, value in scene.conserved(zero, start).items():
        drift = max(abs(a - b) for a, b in zip(leaves(after[key]), leaves(value)))
        conserved[key] = {"value_t0": nested(text, value), "drift_at_T": f"{float(drift):.2e}"}
        assert drift < 1e-36, f"{key} drifts by {drift}"
    for key, value in scene.residuals(end, last).items():
        assert abs(value) < 1e-36, f"{key} is {value}"
    report = {
        "name": kind.name,
        "kind": kind.kind,
        "description": kind.description,
        "source": kind.source,
        "script": f"tests/references/{kind.script}",
        "parameters": kind.parameters,
        "conventions": CONVENTIONS,
        "coordinates": list(kind.coordinates),
        "speeds": list(kind.speeds),
        "T": kind.duration,
        "initial": nested_text(scene.observe(zero, start)),
        "final": nested_text(final),
        "conserved": conserved,
        **kind.extra,
        **scene.further(end, last),
        "verification": {
            "agreeing_digits_relative": round(agreeing, 1),
            "runs": [
                f"MPFR 240 bits, extrapolation of order 44, {steps} steps",
                f"mpmath 66 digits, extrapolation of order 38, {other_steps} steps",
            ],
            "residuals_at_T": {key: f"{float(abs(v)):.1e}" for key, v in scene.residuals(end, last).items()},
        },
        "double_precision_guide": guide(kind, final),
    }
    (DATA / f"{kind.name}.json").write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n")
    print(f"  {agreeing:.1f} digits; {report['double_precision_guide']}", flush=True)


def text(value):
    """A number of the file."""
    return digits(value, DIGITS)


def nested_text(table):
    """The numbers of the file, key by key."""
    return {key: nested(text, value) for key, value in table.items()}
