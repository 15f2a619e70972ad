"""Models at run time from Python: from a file to the first number, calls, rows of batches, runs.

`pip install ./crates/gauss-py` first (a release wheel); then `python benches/peers/loaded.py`. With SciPy the same
pendulum is integrated by `solve_ivp`, over `rates`, at the same tolerances. Medians, in one process; what comes from the
cache in processes of their own.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import gauss
import numpy as np

ROBOTS = Path(__file__).parents[2] / "tests/robots"
PENDULUM = "coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)])"


def timed(call, times):
    """The median time of a call, in microseconds."""
    spans = []
    for _ in range(times):
        start = time.perf_counter()
        call()
        spans.append(time.perf_counter() - start)
    return 1e6 * float(np.median(spans))


def robot(file, clauses):
    start = time.perf_counter()
    kernel = gauss.load(ROBOTS / file, clauses, gravity=9.81)
    (q, z), u = kernel.state(), np.zeros(len(kernel.input_names))
    loaded = time.perf_counter()
    kernel.acceleration(q, z, u)
    first = time.perf_counter()
    print(f"{file}: loaded in {1e3 * (loaded - start):.0f} ms, first acceleration {1e3 * (first - loaded):.1f} ms later")
    rows, speeds = np.tile(q, (10_000, 1)), np.tile(z, (10_000, 1))
    call = timed(lambda: kernel.acceleration(q, z, u), 5000)
    row = timed(lambda: kernel.acceleration(rows, speeds, u), 30) / 10_000
    run = kernel.simulate(q, z, (0, 1), input=u)
    second = timed(lambda: kernel.simulate(q, z, (0, 1), input=u), 10)
    print(f"  a call {call:.2f} µs, a row of 10,000 {1e3 * row:.0f} ns, a run of 1 s {second:.0f} µs ({run.steps} steps)")


#: From a file to its first acceleration in a process of its own, without its start.
FIRST = """
import sys, time, gauss
start = time.perf_counter()
kernel = gauss.load(sys.argv[1], sys.argv[2:], gravity=9.81)
kernel.acceleration(*kernel.state(), [0.0] * len(kernel.input_names))
print(1e3 * (time.perf_counter() - start))
"""


def cached(file, clauses):
    """The time to the first acceleration without a cache and from one that has the model, by turns."""
    with tempfile.TemporaryDirectory() as folder:
        def first(cache):
            command = [sys.executable, "-c", FIRST, str(ROBOTS / file), *clauses]
            run = subprocess.run(command, env=os.environ | {"GAUSS_CACHE": cache}, capture_output=True, check=True)
            return float(run.stdout)

        first(folder)
        derived, known = zip(*((first(""), first(folder)) for _ in range(7)))
    print(f"{file}: first acceleration {np.median(derived):.0f} ms, from the cache {np.median(known):.1f} ms")


def touching():
    """A puck on a floor and a robot on four feet: a step with contacts."""
    puck = gauss.scene(
        "coordinates(x, y), particle(mass = 1, position = [x, 0, y]), gravity = 9.81, "
        "contact(floor, gap = y, slip = rate(x), friction = 0.4)"
    )()
    feet = [f"contact({leg}, point = p{leg}, radius = 0.031, friction = 0.8)" for leg in ("LF", "LH", "RF", "RH")]
    places = {"LF": (1, 1), "LH": (-1, 1), "RF": (1, -1), "RH": (-1, -1)}
    points = [
        f"point(p{leg}, body = {leg}_KFE_link, at = [{0.033 * x}, {0.01305 * y}, -0.33797])" for leg, (x, y) in places.items()
    ]
    legs = np.ravel([[0, 0.4 * x, -0.8 * x] for x, _ in places.values()])
    robot = gauss.load(ROBOTS / "anymal.urdf", ["base = floating", *points, *feet], gravity=9.81)
    q = np.concatenate([[0, 0, 0, 1, 0, 0, 0.6], legs])
    q[6] -= robot.gaps(q).min()
    for name, kernel, start, input in (("puck", puck, ([0, 0], [1, 0]), []), ("ANYmal", robot, (q, np.zeros(18)), np.zeros(12))):
        run = lambda: kernel.simulate(*start, (0, 0.2), contacts="steps", step=1e-3, input=input, times=[])
        print(f"{name}: {timed(run, 20) / 200:.2f} µs a step with contacts")


def pendulum():
    model = gauss.scene(PENDULUM, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity"))
    kernel = model(m=1, l=0.5, g=9.81)
    one = timed(lambda: kernel.simulate([1.0], [0.0], (0, 10)), 50)
    starts = np.linspace(0.1, 1, 1000)[:, None]
    many = timed(lambda: kernel.ensemble(starts, [0.0], (0, 10)), 5) / 1000
    print(f"pendulum, 10 s at 1e-9: {one:.0f} µs; in an ensemble of 1,000 {many:.0f} µs a run")
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        return
    rates = lambda t, x: kernel.rates(x[:1], x[1:])
    solve = lambda: solve_ivp(rates, (0, 10), [1.0, 0.0], method="DOP853", rtol=1e-9, atol=1e-9)
    print(f"  by SciPy's DOP853 over `rates`: {timed(solve, 5):.0f} µs")


if __name__ == "__main__":
    robot("panda.urdf", [])
    robot("anymal.urdf", ["base = floating"])
    cached("panda.urdf", [])
    cached("anymal.urdf", ["base = floating"])
    cached("talos.urdf", ["base = floating"])
    touching()
    pendulum()
