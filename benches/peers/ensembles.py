"""Trajectories A, B and C of `cargo bench --bench ensembles` by heyoka: `python ensembles.py`, with `pip install heyoka`.

Microseconds a trajectory and simulated second on one thread, the fastest of many rounds, alone and with as many lanes as
the processor has, and the largest error of the attitude at the end.
"""

import time

import heyoka as hy
import numpy as np

from scenes import GRAVITY, S3


def rates_of_attitude(q, w):
    """The derivative of a quaternion (x, y, z, w) from body to space; w: angular velocity in body axes."""
    x, y, z, s = q
    a, b, c = w
    return [
        0.5 * (s * a + y * c - z * b),
        0.5 * (s * b + z * a - x * c),
        0.5 * (s * c + x * b - y * a),
        -0.5 * (x * a + y * b + z * c),
    ]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def vertical(q):
    """The vertical in body axes."""
    x, y, z, s = q
    return [2.0 * (x * z - y * s), 2.0 * (y * z + x * s), 1.0 - 2.0 * (x * x + y * y)]


def top(moments, weight):
    """A body that turns about O; `weight` is m g l along the third axis."""
    names = hy.make_vars("x", "y", "z", "s", "a", "b", "c")
    q, w = names[:4], names[4:]
    momentum = [i * v for i, v in zip(moments, w)]
    torque = cross(momentum, w)
    if weight:
        up = vertical(q)
        torque = [torque[0] + weight * up[1], torque[1] - weight * up[0], torque[2]]
    return list(zip(names, rates_of_attitude(q, w) + [t / i for t, i in zip(torque, moments)]))


def immersed():
    names = hy.make_vars("x", "y", "z", "s", "a", "b", "c", "u", "v", "w", "X", "Y", "Z")
    q, omega, u = names[:4], names[4:7], names[7:10]
    matrix = np.array(S3["kinetic_matrix"])
    inverse = np.linalg.inv(matrix)
    twist = u + omega
    total = [sum((matrix[i, j] * twist[j] for j in range(1, 6)), matrix[i, 0] * twist[0]) for i in range(6)]
    p, pi = total[:3], total[3:]
    up = vertical(q)
    weight, buoyancy, center, point = S3["weight"], S3["buoyancy"], S3["center_of_mass"], S3["center_of_buoyancy"]
    net = [(buoyancy - weight) * n for n in up]
    lever = [buoyancy * b - weight * c for b, c in zip(point, center)]
    force = [a + b for a, b in zip(cross(p, omega), net)]
    torque = [a + b + c for a, b, c in zip(cross(pi, omega), cross(p, u), cross(lever, up))]
    load = force + torque
    rates = [sum((inverse[i, j] * load[j] for j in range(1, 6)), inverse[i, 0] * load[0]) for i in range(6)]
    x, y, z, s = q
    # R u, column by column.
    place = [
        (1 - 2 * (y * y + z * z)) * u[0] + 2 * (x * y - z * s) * u[1] + 2 * (x * z + y * s) * u[2],
        2 * (x * y + z * s) * u[0] + (1 - 2 * (x * x + z * z)) * u[1] + 2 * (y * z - x * s) * u[2],
        2 * (x * z - y * s) * u[0] + 2 * (y * z + x * s) * u[1] + (1 - 2 * (x * x + y * y)) * u[2],
    ]
    return list(zip(names, rates_of_attitude(q, omega) + rates[3:] + rates[:3] + place))


# Equations, duration, start, attitude at the end; tolerance.
CASES = {
    "A": (
        top([1.0, 2.0, 3.0], 0.0),
        100.0,
        [0.0, 0.0, 0.0, 1.0, 0.01, 1.0, 0.01],
        [0.9654395742742695, -7.971609403978595e-05, -0.260156908801055, -0.015646241514854095],
        1e-12,
    ),
    "B": (
        top([1.0, 1.0, 0.3], 0.5 * GRAVITY),
        20.0,
        [0.24740395925452294, 0.0, 0.0, 0.9689124217106447, 0.0, 0.0, 15.0],
        [-0.24875095621040977, -0.003645005941271747, -0.5907343441740279, -0.7675562587389774],
        1e-12,
    ),
    "C": (
        immersed(),
        10.0,
        [0.0, 0.0, 0.0, 1.0, 0.5, -0.3, 0.4, 1.0, 0.2, -0.1, 0.0, 0.0, 0.0],
        [-0.14624540214346288, -0.09108370747518893, 0.7755064251707701, -0.607376180882428],
        1e-12,
    ),
}


def error(attitude, exact):
    """The angle between two attitudes."""
    q, e = attitude / np.linalg.norm(attitude), np.array(exact)
    return 2.0 * min(np.linalg.norm(q - e), np.linalg.norm(q + e))


def fastest(integrator, to_the_start, start, duration, rounds):
    least = float("inf")
    for _ in range(rounds):
        to_the_start()
        integrator.state[:] = start
        begun = time.perf_counter()
        integrator.propagate_until(duration)
        least = min(least, time.perf_counter() - begun)
    return least * 1e6 / duration


def main():
    width = hy.recommended_simd_size()
    print(f"| | heyoka {hy.__version__}, tolerance | one | {width} lanes | error |\n|---|---|---|---|---|")
    for name, (equations, duration, start, exact, tolerance) in CASES.items():
        one = hy.taylor_adaptive(equations, start, tol=tolerance, compact_mode=False)
        starts = np.repeat(np.array(start)[:, None], width, axis=1)
        lanes = hy.taylor_adaptive_batch(equations, starts, tol=tolerance, compact_mode=False)
        alone = fastest(one, lambda: setattr(one, "time", 0.0), start, duration, 60)
        together = fastest(lanes, lambda: lanes.set_time(0.0), starts, duration, 60) / width
        print(f"| {name} | {tolerance} | {alone:.2f} | {together:.3f} | {error(one.state[:4], exact):.0e} |")


if __name__ == "__main__":
    main()
