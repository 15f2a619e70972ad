"""The equations of this folder on scenes whose solutions were computed elsewhere, from other formulations: final states
agree as far as 36 digits of the initial states allow."""

import json

import mpmath

from arithmetic import Mpfr, as_mpmath
from extrapolation import integrate
from multibody import Body, Coincide, Distance, Particle, Point, Rolling, System
from scene import DATA, leaves, nested
from vectors import apply, apply_transposed


def quaternion_of(arithmetic, r):
    """The unit quaternion of a rotation matrix, from the largest of its components."""
    trace = r[0][0] + r[1][1] + r[2][2]
    squares = [1 + trace] + [1 - trace + 2 * r[i][i] for i in range(3)]
    largest = max(range(4), key=lambda i: squares[i])
    products = [[None] * 4 for _ in range(4)]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[0][1 + i] = products[1 + i][0] = r[k][j] - r[j][k]
        products[1 + j][1 + k] = products[1 + k][1 + j] = r[j][k] + r[k][j]
    products[largest][largest] = squares[largest]
    return [p / (2 * arithmetic.sqrt(squares[largest])) for p in products[largest]]


def disc(arithmetic, radius):
    """Lowest point of a thin disc with the axis e₃, from its centre, and its rate."""

    def contact(up, rate):
        size = arithmetic.sqrt(up[0] * up[0] + up[1] * up[1])
        change = (up[0] * rate[0] + up[1] * rate[1]) / size
        point = [-radius * up[0] / size, -radius * up[1] / size, 0 * size]
        return point, [-(radius * rate[i] + point[i] * change) / size for i in range(2)] + [0 * size]

    return contact


def ball(radius):
    """Lowest point of a ball from its centre, and its rate."""
    return lambda up, rate: ([-radius * x for x in up], [-radius * x for x in rate])


def of_body(arithmetic, data, constraints):
    """System and initial state of a scene of one body; `constraints(body)` holds it."""
    p, start = (
        data["parameters"],
        nested(arithmetic, [data["initial"][key] for key in ("R", "b", "body_u", "body_omega")]),
    )
    r, b, u, omega = start
    body = Body(arithmetic, p["mass"], p["centre_of_mass_body_from_O"], p["inertia_about_O"])
    zero, g = arithmetic("0"), arithmetic(p["gravity"])
    system = System([body], constraints(body), lambda t: [zero, zero, -g])

    def observe(y):
        pose = system.poses(y)[0]
        position, velocity = pose.origin()
        return {
            "R": pose.rotation,
            "b": position,
            "body_u": apply_transposed(pose.rotation, velocity),
            "body_omega": pose.omega,
        }

    return system, body.place(b, quaternion_of(arithmetic, r), apply(r, u), omega), observe


def of_particles(arithmetic, data):
    """System and initial state of the planar double pendulum (x, y up)."""
    p = data["parameters"]
    parts = [Particle(arithmetic, p[key]) for key in ("m1", "m2")]
    zero, g = arithmetic("0"), arithmetic(p["g"])
    fixed = Point(None, [zero] * 3)
    constraints = [Distance(fixed, Point(0)), Distance(Point(0), Point(1))]
    system = System(parts, constraints, lambda t: [zero, -g, zero])
    start = nested(arithmetic, [data["initial"][key] + ["0"] for key in ("x1", "v1", "x2", "v2")])

    def observe(y):
        return {"x1": y[0:2], "v1": y[3:5], "x2": y[6:8], "v2": y[9:11]}

    return system, [x for part in start for x in part], observe


def main():
    """Runs the scenes. Their initial states are rounded to 36 digits, and so are the motions."""
    arithmetic = Mpfr(240)
    cases = {
        "double_pendulum": of_particles,
        "heavy_asym_top": lambda a, data: of_body(
            a,
            data,
            lambda body: [Coincide(Point(None, nested(a, data["initial"]["b"])), Point(0, body.from_g([0, 0, 0])))],
        ),
        "chaplygin_ball": lambda a, data: of_body(
            a, data, lambda body: [Rolling(0, ball(a(data["parameters"]["radius"])))]
        ),
        "rolling_disk_falling": lambda a, data: of_body(
            a, data, lambda body: [Rolling(0, disc(a, a(data["parameters"]["radius"])))]
        ),
    }
    for name, build in cases.items():
        data = json.loads((DATA / f"{name}.json").read_text())
        system, start, observe = build(arithmetic, data)
        last, steps = integrate(system.rates, start, arithmetic(data["T"]), arithmetic("1e-40"), 22, arithmetic("1/64"))
        worst = mpmath.mpf(0)
        with mpmath.workdps(60):
            for key, found in observe(last).items():
                wanted = [mpmath.mpf(x) for x in leaves(data["final"][key])]
                size = max([mpmath.mpf(1)] + [abs(x) for x in wanted])
                worst = max([worst] + [abs(as_mpmath(a) - b) / size for a, b in zip(leaves(found), wanted)])
        print(f"{name}: {steps} steps, off by {float(worst):.1e}", flush=True)
        # 36 digits of the initial state, magnified by the motion (`double_precision_guide`), and of the final one.
        magnification = (
            float(data["double_precision_guide"]["change_if_initial_state_perturbed_by_2em53_relative"]) * 2.0**53
        )
        assert worst < 1e-35 * max(1.0, magnification), name


if __name__ == "__main__":
    main()
