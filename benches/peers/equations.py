"""Equations of motion as an expert hands them to a generator: constants and inverses beforehand, no product with zero.

Every function takes the state as a list of expressions and returns the accelerations; `f` has `sin` and `cos` for them.
"""

import numpy as np

from scenes import GRAVITY, S1, S2, S3, S4, S5, S6, S7, about_pole, diagonal


def dot(a, b):
    """Sum of products, without those with the number zero."""
    total = 0.0
    for x, y in zip(a, b):
        if (isinstance(x, float) and x == 0.0) or (isinstance(y, float) and y == 0.0):
            continue
        total = x * y if isinstance(total, float) and total == 0.0 else total + x * y
    return total


def cross(a, b):
    return [dot([a[1], -a[2]], [b[2], b[1]]), dot([a[2], -a[0]], [b[0], b[2]]), dot([a[0], -a[1]], [b[1], b[0]])]


def add(*vectors):
    return [dot([1.0] * len(parts), parts) for parts in zip(*vectors)]


def scaled(s, v):
    return [dot([s], [x]) for x in v]


def times(matrix, v):
    return [dot([float(x) if isinstance(x, (int, np.floating)) else x for x in row], v) for row in matrix]


def vertical(q):
    """The upward vertical in body axes."""
    x, y, z, w = q[:4]
    return [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)]


def s1(x, f):
    u, w = x[7:10], x[10:13]
    a, b, c = (float(moment) for moment in S1["inertia"])
    return cross(u, w) + [(b - c) / a * (w[1] * w[2]), (c - a) / b * (w[2] * w[0]), (a - b) / c * (w[0] * w[1])]


def s2(x, f):
    u, w = x[7:10], x[10:13]
    inertia = np.array(S2["inertia"])
    rate = times(np.linalg.inv(inertia), cross(times(inertia, w), w))
    c = [float(component) for component in S2["center_of_mass"]]
    velocity = add(u, cross(w, c))
    return add(scaled(-GRAVITY, vertical(x)), cross(velocity, w), cross(c, rate)) + rate


def s3(x, f):
    u, w = x[7:10], x[10:13]
    kinetic = np.array(S3["kinetic_matrix"])
    p = times(kinetic, x[7:13])
    lift = S3["buoyancy"] - S3["weight"]
    arm = [float(S3["buoyancy"] * b - S3["weight"] * c) for b, c in zip(S3["center_of_buoyancy"], S3["center_of_mass"])]
    up = vertical(x)
    force = add(cross(p[:3], w), scaled(lift, up))
    torque = add(cross(p[3:], w), cross(p[:3], u), cross(arm, up))
    return times(np.linalg.inv(kinetic), force + torque)


def s4(x, f):
    (_, nutation_angle, spin_angle), (precession, nutation, spin) = x[:3], x[3:]
    distance = S4["center_of_mass"][2]
    a, b, c = np.diag(about_pole(S4["mass"], S4["center_of_mass"], diagonal(S4["inertia"]))).tolist()
    weight = S4["mass"] * GRAVITY * distance
    st, ct, sp, cp = f.sin(nutation_angle), f.cos(nutation_angle), f.sin(spin_angle), f.cos(spin_angle)
    across = precession * st
    w1, w2, w3 = across * sp + nutation * cp, across * cp - nutation * sp, precession * ct + spin
    a1 = (b - c) / a * w2 * w3 + weight / a * (st * cp)
    a2 = (c - a) / b * w3 * w1 - weight / b * (st * sp)
    a3 = (a - b) / c * (w1 * w2)
    along = a1 * cp - a2 * sp - across * spin
    across_rate = a1 * sp + a2 * cp + nutation * spin
    turning = precession * nutation
    first = (across_rate - turning * ct) / st
    return [first, along, a3 - first * ct + turning * st]


def _pendulum(sines, sine, cosine, speeds):
    """Rates of the links' angular velocities; `sine` and `cosine` of what the lower link is ahead."""
    upper, lower = S5["links"]
    length = upper["length"]
    first = upper["inertia"] + upper["mass"] * upper["center"] ** 2 + lower["mass"] * length**2
    second = lower["inertia"] + lower["mass"] * lower["center"] ** 2
    coupling = lower["mass"] * length * lower["center"]
    weights = [(upper["mass"] * upper["center"] + lower["mass"] * length) * GRAVITY, lower["mass"] * lower["center"] * GRAVITY]
    off, turning = coupling * cosine, coupling * sine
    f1 = turning * (speeds[1] * speeds[1]) - weights[0] * sines[0]
    f2 = -turning * (speeds[0] * speeds[0]) - weights[1] * sines[1]
    reciprocal = 1.0 / (first * second - off * off)
    return [(second * f1 - off * f2) * reciprocal, (first * f2 - off * f1) * reciprocal]


def s5(x, f):
    sa, ca, sb, cb = f.sin(x[0]), f.cos(x[0]), f.sin(x[1]), f.cos(x[1])
    return _pendulum([sa, sb], sb * ca - cb * sa, sa * sb + ca * cb, x[2:])


def s5_jointed(x, f):
    sa, ca, sc, cc = f.sin(x[0]), f.cos(x[0]), f.sin(x[1]), f.cos(x[1])
    first, second = _pendulum([sa, sa * cc + ca * sc], sc, cc, [x[2], x[2] + x[3]])
    return [first, second - first]


def s6(x, f):
    pole = S6["pole"]
    mass, moment = S6["cart"] + pole["mass"], pole["inertia"] + pole["mass"] * pole["center"] ** 2
    arm = pole["mass"] * pole["center"]
    s, c = f.sin(x[1]), f.cos(x[1])
    off = arm * c
    force, torque = arm * s * (x[3] * x[3]), arm * GRAVITY * s
    reciprocal = 1.0 / (mass * moment - off * off)
    return [(moment * force - off * torque) * reciprocal, (mass * torque - off * force) * reciprocal]


class Turn:
    """From the axes of a link of the arm to its parent's: quarter turns about x, then the joint's turn about z."""

    def __init__(self, link, sine, cosine):
        self.n, self.s, self.c, self.position = link["quarter_turns"], sine, cosine, [float(x) for x in link["position"]]

    def _quarter(self, v, n):
        return v if n == 0 else [v[0], -v[2], v[1]] if n == 1 else [v[0], v[2], -v[1]]

    def outward(self, v):
        x, y, z = self._quarter(v, -self.n)
        return [dot([self.c, self.s], [x, y]), dot([self.c, -self.s], [y, x]), z]

    def inward(self, v):
        turned = [dot([self.c, -self.s], [v[0], v[1]]), dot([self.s, self.c], [v[0], v[1]]), v[2]]
        return self._quarter(turned, self.n)

    def inward_tensor(self, t):
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = t
        s, c = self.s, self.c
        along, across = c * xx - s * xy, c * xy - s * yy
        first, mixed = c * along - s * across, s * along + c * across
        second = xx + yy - first
        third = [c * xz - s * yz, s * xz + c * yz, zz]
        turned = [[first, mixed, third[0]], [mixed, second, third[1]], third]
        columns = [self._quarter(row, self.n) for row in turned]
        return [self._quarter([column[i] for column in columns], self.n) for i in range(3)]


def s7(x, f):
    """Recursive Newton-Euler for the bias, composite bodies for the mass matrix, LDL' from the last joint."""
    rates = x[7:]
    turns = [Turn(link, f.sin(x[k]), f.cos(x[k])) for k, link in enumerate(S7)]
    moments = [[float(link["mass"] * c) for c in link["center"]] for link in S7]
    inertias = [about_pole(link["mass"], link["center"], link["inertia"]) for link in S7]
    # Outward; the observer accelerates upward with g.
    velocity, rate, acceleration = [0.0] * 3, [0.0] * 3, [0.0, 0.0, GRAVITY]
    forces, torques = [], []
    for turn, link, h, inertia, speed in zip(turns, S7, moments, inertias, rates):
        at_joint = add(acceleration, cross(rate, turn.position), cross(velocity, cross(velocity, turn.position)))
        acceleration, carried = turn.outward(at_joint), turn.outward(velocity)
        rate = add(turn.outward(rate), cross(carried, [0.0, 0.0, speed]))
        velocity = add(carried, [0.0, 0.0, speed])
        forces.append(add(scaled(link["mass"], acceleration), cross(rate, h), cross(velocity, cross(velocity, h))))
        torques.append(add(times(inertia, rate), cross(velocity, times(inertia, velocity)), cross(h, acceleration)))
    bias = [0.0] * 7
    for k in reversed(range(7)):
        bias[k] = torques[k][2]
        if k > 0:
            turn, force = turns[k], turns[k].inward(forces[k])
            forces[k - 1] = add(forces[k - 1], force)
            torques[k - 1] = add(torques[k - 1], turn.inward(torques[k]), cross(turn.position, force))
    # Composite bodies, and what a unit acceleration of one joint asks of those before it.
    matrix = [[0.0] * 7 for _ in range(7)]
    mass, h, inertia = 0.0, [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for k in reversed(range(7)):
        mass += S7[k]["mass"]
        h = add(h, moments[k])
        inertia = [add(a, b) for a, b in zip(inertia, inertias[k])]
        matrix[k][k] = inertia[2][2]
        force, torque = [-h[1], h[0], 0.0], [row[2] for row in inertia]
        for j in reversed(range(k)):
            turn = turns[j + 1]
            force = turn.inward(force)
            torque = add(turn.inward(torque), cross(turn.position, force))
            matrix[k][j] = torque[2]
        if k > 0:
            turn, p = turns[k], turns[k].position
            h = turn.inward(h)
            inertia = turn.inward_tensor(inertia)
            middle = add(h, scaled(mass / 2.0, p))
            both = 2.0 * dot(p, middle) if any(p) else 0.0
            outer = [[dot([p[i], p[j]], [middle[j], middle[i]]) for j in range(3)] for i in range(3)]
            inertia = [[inertia[i][j] + ((both if i == j else 0.0) - outer[i][j]) for j in range(3)] for i in range(3)]
            h = add(h, scaled(mass, p))
    return solve([matrix[i][: i + 1] for i in range(7)], [-b for b in bias])


def solve(lower, right):
    """Solution of A x = b by LDL' without square roots; `lower` holds the rows of A up to the diagonal, zeros are passed over."""
    n = len(right)
    factor, pivots, reciprocals, x = [[0.0] * n for _ in range(n)], [0.0] * n, [0.0] * n, list(right)
    for i in range(n):
        scaled_row = [0.0] * n
        for j in range(i):
            rest = dot(scaled_row[:j], factor[j][:j])
            scaled_row[j] = lower[i][j] if isinstance(rest, float) and rest == 0.0 else lower[i][j] - rest
            factor[i][j] = dot([scaled_row[j]], [reciprocals[j]])
        rest = dot(scaled_row[:i], factor[i][:i])
        pivots[i] = lower[i][i] if isinstance(rest, float) and rest == 0.0 else lower[i][i] - rest
        reciprocals[i] = 1.0 / pivots[i]
        x[i] = x[i] - dot(factor[i][:i], x[:i])
    for i in reversed(range(n)):
        x[i] = dot([x[i]], [reciprocals[i]]) - dot([factor[k][i] for k in range(i + 1, n)], x[i + 1 :])
    return x


SCENES = {"s1": s1, "s2": s2, "s3": s3, "s4": s4, "s5": s5, "s5_jointed": s5_jointed, "s6": s6, "s7": s7}
