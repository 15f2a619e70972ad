"""Runs and ensembles."""

import os
import signal
import threading

import numpy as np
import pytest
import scenes


def period(angle, length=0.5, g=9.81):
    """Of a pendulum, by the mean of Gauss."""
    a, b = 1.0, np.cos(angle / 2)
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return 2 * np.pi / a * np.sqrt(length / g)


def test_a_pendulum_comes_back(pendulum):
    end = 3 * period(1.0)
    run = pendulum.simulate([1.0], [0.0], (0.0, end), rtol=1e-11, atol=1e-11, input=[0.0])
    # Steps keep the tolerance; a hundred of them.
    assert abs(run.q[-1, 0] - 1.0) < 1e-9 and abs(run.z[-1, 0]) < 1e-8
    energy = run.kinetic_energy + run.potential_energy
    assert np.ptp(energy) < 1e-9
    assert run.t[0] == 0.0 and run.t[-1] == end and len(run) == len(run.t) == run.steps + 1
    fixed = pendulum.simulate([1.0], [0.0], (0.0, end), step=0.01, input=[0.0])
    assert abs(fixed.q[-1, 0] - 1.0) < 1e-9
    # Order 8: (0.01 ω)⁸ is below rounding.
    assert fixed.steps == int(np.ceil(end / 0.01))


def test_times_that_are_asked_for(pendulum):
    times = np.linspace(0, 2, 21)
    run = pendulum.simulate([1.0], [0.0], (0, 2), input=[0.0], times=times)
    assert np.array_equal(run.t, times)
    alone = pendulum.simulate([1.0], [0.0], (0, times[7]), rtol=1e-12, atol=1e-12, input=[0.0])
    assert abs(run.q[7] - alone.q[-1]) < 1e-7
    with pytest.raises(ValueError, match="outside of the run"):
        pendulum.simulate([1.0], [0.0], (0, 2), input=[0.0], times=[3.0])


def test_inputs(pendulum):
    constant = pendulum.simulate([0.1], [0.0], (0, 1), input=[0.7]).q[-1]
    called = pendulum.simulate([0.1], [0.0], (0, 1), input=lambda t, q, z: [0.7]).q[-1]
    table = pendulum.simulate([0.1], [0.0], (0, 1), input=([0.0, 1.0], [[0.7], [0.7]])).q[-1]
    assert np.array_equal(constant, called) and np.array_equal(constant, table)
    ramp = pendulum.simulate([0.1], [0.0], (0, 1), input=([0.0, 1.0], [0.0, 2.0])).q[-1]
    by_hand = pendulum.simulate([0.1], [0.0], (0, 1), input=lambda t, q, z: [2.0 * t]).q[-1]
    assert abs(ramp - by_hand) < 1e-8
    with pytest.raises(ValueError, match="do not increase at number 1"):
        pendulum.simulate([0.1], [0.0], (0, 1), input=([0.0, 0.0], [0.0, 2.0]))
    with pytest.raises(TypeError, match="needs an input: motor"):
        pendulum.simulate([0.1], [0.0], (0, 1))
    with pytest.raises(ValueError, match=r"input has shape \(2,\)"):
        pendulum.simulate([0.1], [0.0], (0, 1), input=lambda t, q, z: [1.0, 2.0])
    with pytest.raises(ZeroDivisionError):
        pendulum.simulate([0.1], [0.0], (0, 1), input=lambda t, q, z: [1 / 0])


def test_ends_before_the_time(pendulum):
    quarter = period(1.0) / 4
    for until in [("angle", 0.0), ("angle", 0.0, "falling"), lambda t, q, z: q[0], (lambda t, q, z: q[0], "falling")]:
        run = pendulum.simulate([1.0], [0.0], (0, 9), rtol=1e-11, atol=1e-11, input=[0.0], until=until)
        assert run.stopped_by == 0 and abs(run.t[-1] - quarter) < 1e-9
    rising = [("angle_dot", 0.0, "rising"), ("angle", 0.0, "rising")]
    run = pendulum.simulate([1.0], [-1e-9], (0, 9), rtol=1e-11, atol=1e-11, input=[0.0], until=rising)
    assert run.stopped_by == 0 and abs(run.t[-1] - 2 * quarter) < 1e-7
    with pytest.raises(KeyError, match="no number of a state is called height"):
        pendulum.simulate([1.0], [0.0], (0, 9), input=[0.0], until=("height", 0.0))


def test_failures_keep_what_there_is(pendulum):
    with pytest.raises(scenes.IntegrationError) as caught:
        pendulum.simulate([1.0], [0.0], (0, 1), input=lambda t, q, z: [np.inf if t > 0.5 else 0.0])
    run = caught.value.run
    assert 0.0 < run.t[-1] <= 0.5 and run.error and not run.interrupted
    with pytest.raises(ValueError, match="rtol must be positive"):
        pendulum.simulate([1.0], [0.0], (0, 1), rtol=0.0, input=[0.0])


def test_interruption_keeps_what_there_is(pendulum):
    # What runs in the background of a shell ignores Ctrl-C.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    run = pendulum.simulate([1.0], [0.0], (0.0, 1e9), input=[0.0], max_steps=10**12)
    signal.signal(signal.SIGINT, before)
    assert run.interrupted and run.error is None and 0.0 < run.t[-1] < 1e9


def test_tables_are_read_without_a_copy(torpedo):
    pyarrow, polars = pytest.importorskip("pyarrow"), pytest.importorskip("polars")
    q, z = torpedo.state(pose_z=-5.0)
    run = torpedo.simulate(q, [1.5, 0, 0, 0.1, 0.2, 0.3], (0, 3))
    table = pyarrow.table(run)
    assert table.column_names == run.columns
    assert table.schema.field("t").metadata[b"unit"] == b"s"
    column = table["pose_z"].chunk(0)
    # The same memory, which the table keeps alive.
    address = run["pose_z"].__array_interface__["data"][0]
    assert column.buffers()[1].address + 8 * column.offset == address
    expected = run["pose_z"].copy()
    del run
    assert np.array_equal(column.to_numpy(), expected)
    again = torpedo.simulate(q, [1.5, 0, 0, 0.1, 0.2, 0.3], (0, 3))
    assert np.array_equal(polars.DataFrame(again)["pose_z"].to_numpy(), expected)


def test_arrays_of_runs_are_views(pendulum):
    run = pendulum.simulate([1.0], [0.0], (0, 1), input=[0.0])
    q = run.q
    assert not q.flags.writeable and not q.flags.owndata
    last = q[-1, 0]
    del run
    assert q[-1, 0] == last


def test_ensembles_are_runs(pendulum, random):
    q, z = random.standard_normal((2, 37, 1))
    ends = pendulum.ensemble(q, z, (0.0, 2.0), input=[0.1])
    for i in range(37):
        run = pendulum.simulate(q[i], z[i], (0.0, 2.0), input=[0.1])
        assert np.array_equal(ends.q[i], run.q[-1]) and ends["steps"][i] == run.steps
    assert len(ends) == 37 and ends.errors == [] and not ends.stopped.any()


def test_ensembles_have_parameters_and_ends_of_their_own(pendulum):
    lengths = np.linspace(0.3, 0.9, 19)
    ends = pendulum.ensemble(
        [1.0], [0.0], (0.0, 9.0), rtol=1e-11, atol=1e-11, input=[0.0], until=("angle", 0.0), parameters={"length": lengths}
    )
    assert ends.stopped.all()
    expected = [period(1.0, length) / 4 for length in lengths]
    assert abs(ends.t - expected).max() < 1e-9
    with pytest.raises(KeyError, match="size is no parameter"):
        pendulum.ensemble([1.0], [0.0], (0, 1), input=[0.0], parameters={"size": lengths})
    with pytest.raises(ValueError, match="runs 16 to 18: .*length"):
        pendulum.ensemble([1.0], [0.0], (0, 1), input=[0.0], parameters={"length": np.append(lengths[:-1], np.nan)})
    with pytest.raises(ValueError, match="q has 2 runs, length has 19"):
        pendulum.ensemble([[1.0], [2.0]], [0.0], (0, 1), input=[0.0], parameters={"length": lengths})


def test_solvers_of_others(torpedo):
    integrate = pytest.importorskip("scipy.integrate")
    q, z = torpedo.state(pose_z=-5.0)
    z[:] = [1.5, 0, 0, 0.1, 0.2, 0.3]
    n = len(q)

    def rates(t, y):
        y = y.copy()
        y[:4] /= np.linalg.norm(y[:4])
        return torpedo.rates(y[:n], y[n:], t=t)

    theirs = integrate.solve_ivp(rates, (0, 3), np.append(q, z), method="DOP853", rtol=1e-10, atol=1e-10).y[:, -1]
    ours = torpedo.simulate(q, z, (0, 3), rtol=1e-10, atol=1e-10)
    assert abs(theirs - np.append(ours.q[-1], ours.z[-1])).max() < 1e-8
