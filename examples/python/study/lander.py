"""Touchdowns of a capsule beneath a parachute: run i is a function of the seed and of i, whoever makes it.

A capsule of some 80 kg comes down from 300 m through a wind that freshens with height; mass, canopy, air, wind and the
state at the start are random. `touchdowns(seed, start, stop)` makes runs start to stop in lanes, each until its centre
of mass is at the ground. What is modelled and what is not: `scenes.Lander`.

The numbers of a parameter are a stream of their own, as in the crate `gauss-study`: the key of the generator is made of
seed and name, the place in its sequence is the number of the run. So a chunk of runs has the numbers that its runs have
alone, and a parameter more changes none of the others. The generator is NumPy's Philox, which jumps to any place; that
of `gauss-study` is ChaCha, and its numbers are others.
"""

import hashlib

import numpy as np
import scenes
from scipy.special import ndtri

#: Of each parameter the distribution: bounds of a uniform one, or mean and standard deviation of a normal one.
PARAMETERS = {
    "mass": ("normal", 80.0, 4.0),  # kg
    "drag_area": ("uniform", 22.0, 28.0),  # m²
    "air": ("uniform", 50.0, 80.0),  # kg, some half of a sphere as wide as the canopy
    "riser": ("uniform", 5.0, 7.0),  # m
    "density": ("uniform", 1.1, 1.3),  # kg/m³
    "wind_x": ("normal", 3.0, 3.0),  # m/s
    "wind_y": ("normal", 0.0, 3.0),  # m/s
    "layer": ("uniform", 20.0, 80.0),  # m
}

#: The state at the start: velocities in m/s; Rodrigues parameters, tangents of half the angle; angular velocities in
#: rad/s about axes of the capsule.
START = {
    "drift_x": ("normal", 0.0, 4.0),
    "drift_y": ("normal", 0.0, 4.0),
    "descent": ("uniform", 5.0, 15.0),
    "tilt_x": ("normal", 0.0, 0.1),
    "tilt_y": ("normal", 0.0, 0.1),
    "swing_x": ("normal", 0.0, 0.2),
    "swing_y": ("normal", 0.0, 0.2),
}

#: Columns of the results: seconds, metres, m/s downward and along the ground, the cosine of the tilt, rad/s, steps.
RESULTS = ("t", "x", "y", "down", "along", "upright", "swing", "steps")

HEIGHT, LONGEST = 300.0, 600.0
TOLERANCES = {"rtol": 1e-7, "atol": 1e-7}

_lander = scenes.Lander(
    mass=80.0,
    inertia=[8.0, 8.0, 5.0],
    drag_area=25.0,
    air=65.0,
    riser=6.0,
    density=1.2,
    wind_x=0.0,
    wind_y=0.0,
    layer=50.0,
    g=9.81,
)


def uniform(seed, name, start, stop):
    """Numbers between 0 and 1, both excluded, one for each run from start to stop."""
    key = [seed, int.from_bytes(hashlib.blake2b(name.encode(), digest_size=8).digest(), "little")]
    # A count of the generator makes four words.
    generator = np.random.Philox(key=np.array(key, dtype=np.uint64), counter=[start // 4, 0, 0, 0])
    words = generator.random_raw(start % 4 + stop - start)[start % 4 :]
    # The middles of 2⁵² equal parts: nothing is rounded.
    return ((words >> np.uint64(12)) + 0.5) * 2.0**-52


def draw(seed, start, stop):
    """All random numbers of these runs, by name."""
    drawn = {}
    for name, (kind, a, b) in (PARAMETERS | START).items():
        u = uniform(seed, name, start, stop)
        drawn[name] = a + b * ndtri(u) if kind == "normal" else a + u * (b - a)
    return drawn


def states(drawn):
    """The states at the start: q (quaternion i j k w, place) and z (velocity, angular velocity)."""
    count = len(drawn["descent"])
    q, z = np.zeros((count, 7)), np.zeros((count, 6))
    # Only what IEEE 754 rounds exactly: a run has the same bits in any chunk, on machines that build the same kernel.
    norm = np.sqrt(drawn["tilt_x"] * drawn["tilt_x"] + drawn["tilt_y"] * drawn["tilt_y"] + 1.0)
    q[:, 0], q[:, 1], q[:, 3] = drawn["tilt_x"] / norm, drawn["tilt_y"] / norm, 1.0 / norm
    q[:, 6] = HEIGHT
    z[:, 0], z[:, 1], z[:, 2] = drawn["drift_x"], drawn["drift_y"], -drawn["descent"]
    z[:, 3], z[:, 4] = drawn["swing_x"], drawn["swing_y"]
    return q, z


def touchdowns(seed, start, stop):
    """The results of runs start to stop, a row for each; a run that fails, or never lands, is a row of NaN."""
    drawn = draw(seed, start, stop)
    parameters = {name: drawn[name] for name in PARAMETERS}
    q, z = states(drawn)
    until = ("pose_z", 0.0, "falling")
    ends = _lander.ensemble(q, z, (0.0, LONGEST), until=until, parameters=parameters, **TOLERANCES)
    (i, j), (u, v, w), (a, b, c) = ends.q[:, :2].T, ends.z[:, :3].T, ends.z[:, 3:].T
    along, swing = np.sqrt(u * u + v * v), np.sqrt(a * a + b * b + c * c)
    columns = [ends.t, ends.q[:, 4], ends.q[:, 5], -w, along, 1.0 - 2.0 * (i * i + j * j), swing, ends["steps"]]
    rows = np.stack(columns, axis=1)
    rows[~ends.stopped] = np.nan
    return rows


def flight(seed, run):
    """One run with all its steps, to look at: `scenes.Run`."""
    drawn = draw(seed, run, run + 1)
    lander = scenes.Lander(**(_lander.parameters | {name: drawn[name][0] for name in PARAMETERS}))
    q, z = states(drawn)
    return lander.simulate(q[0], z[0], (0.0, LONGEST), until=("pose_z", 0.0, "falling"), **TOLERANCES)
