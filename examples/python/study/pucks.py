"""Where thrown pucks stop: an ensemble with contacts, from event to event and in steps.

A puck is thrown onto a floor: it bounces ever lower, slides and stays. Friction, restitution, height and speed are
random. `thrown(seed, count)` gives the parameters and starts of runs, `stops` runs them on all threads, and `formula`
is what impacts by Newton's law with Coulomb's friction and sliding by it come to, in closed form: an impact of normal
speed v takes mu (1 + e) v of the speed along the floor, or all of it, and infinitely many of them end at one time.

`python pucks.py` compares both ways of running with it.
"""

import time

import numpy as np
import scenes

G = 9.81


def thrown(seed, count):
    """Parameters of each run, and its first q and z."""
    random = np.random.default_rng(seed)
    parameters = {"friction": random.uniform(0.05, 0.6, count), "restitution": random.uniform(0.1, 0.8, count)}
    q, z = np.zeros((2, count, 2))
    q[:, 1], z[:, 0] = random.uniform(0.2, 1.5, count), random.uniform(1.0, 10.0, count)
    return parameters, q, z


def stops(parameters, q, z, seconds=30.0, **how):
    """The ends of all runs; `how` chooses contacts from event to event or in steps."""
    puck = scenes.Puck(mass=0.3, friction=0.0, restitution=0.0, g=G)
    return puck.ensemble(q, z, (0.0, seconds), input=[0.0], parameters=parameters, **how)


def formula(parameters, q, z):
    """The places where they stop."""
    friction, restitution = parameters["friction"], parameters["restitution"]
    height, speed = q[:, 1], z[:, 0].copy()
    x, impact = speed * np.sqrt(2 * height / G), np.sqrt(2 * G * height)
    # 0.8 to the power of 200 is below rounding.
    for _ in range(200):
        speed = np.maximum(speed - friction * (1 + restitution) * impact, 0.0)
        impact *= restitution
        x += speed * 2 * impact / G
    return x + speed**2 / (2 * friction * G)


def main():
    given = thrown(7, 500)
    expected = formula(*given)
    print(f"{len(expected)} pucks stop at {expected.mean():.3f} m in the mean, {expected.std():.3f} m apart")
    for how in ({"rtol": 1e-9, "atol": 1e-9}, {"contacts": "steps", "step": 2e-3}):
        begin = time.perf_counter()
        ends = stops(*given, **how)
        taken = time.perf_counter() - begin
        off = abs(ends.q[:, 0] - expected)
        words = ", ".join(f"{name}={value}" for name, value in how.items())
        print(f"{words}: off by {off.max():.1e} m at most, {len(ends.errors)} errors, {taken:.1f} s")
        print(f"  {ends['impacts'].sum():.0f} impacts, laws kept to {ends['velocity_residual'].max():.1e} m/s")


if __name__ == "__main__":
    main()
