"""Kinetic and potential energies, from which CasADi's differentiation makes the accelerations: what a user writes who does not derive by hand."""

import casadi
import numpy as np

from equations import Turn, add, cross, dot, solve, times, vertical
from scenes import GRAVITY, S1, S2, S3, S4, S5, S6, S7, about_pole, diagonal


def kinetic_matrix(mass, center, inertia):
    """Of a body about O, order (u, omega)."""
    x, y, z = center
    moment = mass * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.block([[mass * np.eye(3), -moment], [moment, np.array(about_pole(mass, center, inertia))]])


def body(kinetic, force, torque_arm):
    """A body in its axes: momenta are derivatives of the kinetic energy, `force` acts along the vertical, `torque_arm` is its moment."""

    def accelerations(x, f):
        speeds = casadi.vertcat(*x[7:13])
        # Entries of Steiner's theorem that cancel leave rounding behind.
        matrix = casadi.sparsify(casadi.DM(np.where(abs(kinetic) < 1e-15, 0.0, kinetic)))
        momenta = casadi.gradient(casadi.bilin(matrix, speeds, speeds) / 2, speeds)
        p, pi, u, w = momenta[:3], momenta[3:], speeds[:3], speeds[3:]
        up = casadi.vertcat(*vertical(x)) if force or any(torque_arm) else casadi.SX(3, 1)
        forces = casadi.cross(p, w) + force * up
        torques = casadi.cross(pi, w) + casadi.cross(p, u) + casadi.cross(casadi.DM(torque_arm), up)
        inverse = np.linalg.inv(matrix.full())
        return casadi.vertsplit(casadi.sparsify(casadi.DM(np.where(abs(inverse) < 1e-15, 0.0, inverse))) @ casadi.vertcat(forces, torques))

    return accelerations


def lagrange(energies):
    """Lagrange's equations for `energies(q, rates) -> (T, U)`, mass matrix eliminated without what is zero."""

    def accelerations(x, f):
        n = len(x) // 2
        q, rates = casadi.vertcat(*x[:n]), casadi.vertcat(*x[n:])
        kinetic, potential = energies(x[:n], x[n:])
        matrix, momenta = casadi.hessian(kinetic, rates)
        right = casadi.gradient(kinetic - potential, q) - casadi.jtimes(momenta, q, rates)
        lower = [[0.0 if matrix[i, j].is_zero() else matrix[i, j] for j in range(i + 1)] for i in range(n)]
        return solve(lower, casadi.vertsplit(right))

    return accelerations


def top(q, rates):
    s, c, sp, cp = casadi.sin(q[1]), casadi.cos(q[1]), casadi.sin(q[2]), casadi.cos(q[2])
    omega = [rates[0] * s * sp + rates[1] * cp, rates[0] * s * cp - rates[1] * sp, rates[0] * c + rates[2]]
    moments = np.diag(about_pole(S4["mass"], S4["center_of_mass"], diagonal(S4["inertia"]))).tolist()
    return sum(i * w**2 for i, w in zip(moments, omega)) / 2, S4["mass"] * GRAVITY * S4["center_of_mass"][2] * c


def pendulum(jointed):
    def energies(q, rates):
        angles, turns = ([q[0], q[0] + q[1]], [rates[0], rates[0] + rates[1]]) if jointed else (q, rates)
        z, vx, vz, kinetic, potential = 0.0, 0.0, 0.0, 0.0, 0.0
        for link, a, w in zip(S5["links"], angles, turns):
            s, c, length, mass = casadi.sin(a), casadi.cos(a), link["center"], link["mass"]
            kinetic += mass * ((vx + length * w * c) ** 2 + (vz + length * w * s) ** 2) / 2 + link["inertia"] * w**2 / 2
            potential += mass * GRAVITY * (z - length * c)
            length = link.get("length", 0.0)
            z, vx, vz = z - length * c, vx + length * w * c, vz + length * w * s
        return kinetic, potential

    return energies


def cart(q, rates):
    pole, s, c = S6["pole"], casadi.sin(q[1]), casadi.cos(q[1])
    vx, vz = rates[0] + pole["center"] * rates[1] * c, -pole["center"] * rates[1] * s
    kinetic = S6["cart"] * rates[0] ** 2 / 2 + pole["mass"] * (vx**2 + vz**2) / 2 + pole["inertia"] * rates[1] ** 2 / 2
    return kinetic, pole["mass"] * GRAVITY * pole["center"] * c


def arm(q, rates):
    velocity, turning, up, height, kinetic, potential = [0.0] * 3, [0.0] * 3, [0.0, 0.0, 1.0], 0.0, 0.0, 0.0
    for link, angle, rate in zip(S7, q, rates):
        turn = Turn(link, casadi.sin(angle), casadi.cos(angle))
        velocity = turn.outward(add(velocity, cross(turning, turn.position)))
        turning = add(turn.outward(turning), [0.0, 0.0, rate])
        height, up = dot([1.0, 1.0], [height, dot(up, turn.position)]), turn.outward(up)
        moment = [link["mass"] * c for c in link["center"]]
        spin = dot(turning, times(about_pole(link["mass"], link["center"], link["inertia"]), turning))
        kinetic += link["mass"] / 2 * dot(velocity, velocity) + dot(velocity, cross(turning, moment)) + spin / 2
        potential += GRAVITY * (link["mass"] * height + dot(moment, up))
    return kinetic, potential


_LIFT = S3["buoyancy"] - S3["weight"]
_ARM = [S3["buoyancy"] * b - S3["weight"] * c for b, c in zip(S3["center_of_buoyancy"], S3["center_of_mass"])]
_WEIGHT = -S2["mass"] * GRAVITY

SCENES = {
    "s1": body(kinetic_matrix(S1["mass"], [0.0] * 3, diagonal(S1["inertia"])), 0.0, [0.0] * 3),
    "s2": body(kinetic_matrix(S2["mass"], S2["center_of_mass"], S2["inertia"]), _WEIGHT, [_WEIGHT * c for c in S2["center_of_mass"]]),
    "s3": body(np.array(S3["kinetic_matrix"]), _LIFT, _ARM),
    "s4": lagrange(top),
    "s5": lagrange(pendulum(False)),
    "s5_jointed": lagrange(pendulum(True)),
    "s6": lagrange(cart),
    "s7": lagrange(arm),
}
