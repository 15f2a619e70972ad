"""Models at run time from Python: from a file to the first number, calls, rows of batches, runs.

`pip install ./crates/gauss-py` first (a release wheel); then `python benches/peers/loaded.py`. With SciPy the same
pendulum is integrated by `solve_ivp`, over `rates`, at the same tolerances. Medians, in one process.
"""

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
    pendulum()
