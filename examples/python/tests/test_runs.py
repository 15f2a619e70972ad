"""Runs and ensembles."""

import contextlib
import json
import os
import re
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
    for call in (pendulum.simulate, pendulum.ensemble):
        with pytest.raises(ValueError, match="rtol must be positive"):
            call([1.0], [0.0], (0, 1), rtol=0.0, input=[0.0])
        with pytest.raises(ValueError, match="rtol is 1e-30, and numbers of 64 bits have rounding of 2.2e-16"):
            call([1.0], [0.0], (0, 1), rtol=1e-30, input=[0.0])
        # What is near zero has no relative error to speak of.
        call([1.0], [0.0], (0, 0.1), rtol=1e-12, atol=1e-30, input=[0.0])


def test_causes_are_told_in_words_of_python(pendulum):
    # At ten steps in a second, a tenth of a day; the default is ten million steps.
    with pytest.raises(scenes.IntegrationError, match="10000000 steps do not reach the end; allow more with `max_steps`"):
        pendulum.simulate([1.0], [0.0], (0, 1e6), input=[0.0])
    with pytest.raises(scenes.IntegrationError, match="100 steps do not reach the end; allow more with `max_steps`"):
        pendulum.simulate([1.0], [0.0], (0, 1e6), input=[0.0], max_steps=100)
    ends = pendulum.ensemble([1.0], [0.0], (0, 1e6), input=[0.0], max_steps=100)
    ((number, why),) = ends.errors
    assert number == 0 and "100 steps do not reach the end; allow more with `max_steps`" in why
    assert len(pendulum.ensemble([1.0], [0.0], (0, 100), input=[0.0], max_steps=10**6).errors) == 0
    wire = scenes.Wire(block={"mass": 2.0, "inertia": [0.1, 0.2, 0.3]}, radius=1.5, g=[0, -9.81, 0])
    q, z = wire.state(x=1.0, y=1.0, y_dot=1.0)
    with pytest.raises(scenes.IntegrationError, match="start from `q, z = kernel.project\\(q, z\\)`"):
        wire.simulate(q, z, (0, 1))
    # The remedy works.
    q, z = wire.project(q, z)
    assert abs(np.hypot(*q[4:]) - 1.5) < 1e-14 and len(wire.simulate(q, z, (0, 0.1))) > 1


def test_states_that_are_none_are_told_with_all_mistakes(torpedo, pendulum):
    q, z = torpedo.state()
    q[1], q[4], z[2] = np.nan, np.inf, -np.inf
    for call in (torpedo.simulate, torpedo.project):
        with pytest.raises(ValueError) as caught:
            call(q, z, *([(0, 1)] if call == torpedo.simulate else []))
        told = str(caught.value)
        assert all(word in told for word in ["q[1] (pose_j) is NaN", "q[4] (pose_x) is inf", "z[2] ("]), told
    q, z = torpedo.state()
    with pytest.raises(ValueError, match=r"q\[0:4\] \(pose\) is no rotation: squares of its numbers add up to 4"):
        torpedo.simulate(2 * q, z, (0, 1))


@contextlib.contextmanager
def interrupted_after(seconds):
    """Ctrl-C in a while; what runs in the background of a shell ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            yield caught
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


def test_interruption_is_raised_with_what_there_is(pendulum):
    with interrupted_after(0.5) as caught:
        pendulum.simulate([1.0], [0.0], (0.0, 1e9), input=[0.0], max_steps=10**12)
    run = caught.value.run
    assert run.interrupted and run.error is None and 0.0 < run.t[-1] < 1e9
    # Many runs one after the other, each of some milliseconds, and longer ones.
    for end in (1.0, 1000.0):
        with interrupted_after(0.5):
            while True:
                pendulum.simulate([1.0], [0.0], (0.0, end), input=[0.0])
    with interrupted_after(0.5) as caught:
        pendulum.ensemble(np.ones((50, 1)), [0.0], (0.0, 1e9), input=[0.0], max_steps=10**12)
    ends = caught.value.ends
    assert ends.interrupted and len(ends) == 50 and (ends.t < 1e9).all()


def test_exceptions_of_functions_have_what_there_is(pendulum):
    with pytest.raises(ZeroDivisionError) as caught:
        pendulum.simulate([1.0], [0.0], (0, 1), input=lambda t, q, z: [1 / 0 if t > 0.5 else 0.0])
    assert 0.0 < caught.value.run.t[-1] <= 0.5 and caught.value.run.interrupted


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
    with pytest.raises(ValueError, match="q has 2 runs, length has 19"):
        pendulum.ensemble([[1.0], [2.0]], [0.0], (0, 1), input=[0.0], parameters={"length": lengths})


def test_runs_that_cannot_begin_are_errors_of_their_own(torpedo, pendulum, random):
    count = 45
    q, z = random.standard_normal((2, count, 1))
    lengths, masses = np.linspace(0.3, 0.9, count), np.full(count, 2.0)
    expected = pendulum.ensemble(q, z, (0, 1), input=[0.1], parameters={"length": lengths, "mass": masses})
    lengths[7], masses[7], q[8], lengths[44], z[44] = np.nan, -1.0, np.inf, 0.0, np.nan
    done = []
    ends = pendulum.ensemble(q, z, (0, 1), input=[0.1], parameters={"length": lengths, "mass": masses}, progress=done.append)
    told = dict(ends.errors)
    assert list(told) == [7, 8, 44] and done[-1] == count
    assert "length" in told[7] and "mass" in told[7] and "q[0] (angle) is inf" in told[8]
    assert "z[0] (angle_dot) is NaN" in told[44]
    good = np.delete(np.arange(count), [7, 8, 44])
    # Others have the bits that they have without these.
    assert np.array_equal(ends.q[good], expected.q[good]) and np.array_equal(ends.steps[good], expected.steps[good])
    assert np.isnan(ends.q[[7, 8, 44]]).all() and np.isnan(ends.t[[7, 8, 44]]).all() and not ends.stopped.any()
    # All of them.
    ends = pendulum.ensemble(np.full((9, 1), np.nan), [0.0], (0, 1), input=[0.0])
    assert len(ends) == 9 and [number for number, _ in ends.errors] == list(range(9)) and np.isnan(ends.q).all()
    start, still = torpedo.state()
    rows = np.tile(start, (3, 1))
    rows[1, 3] = 1.1
    ends = torpedo.ensemble(rows, still, (0, 1))
    ((number, why),) = ends.errors
    assert number == 1 and "q[0:4] (pose) is no rotation: squares of its numbers add up to 1.21" in why


def test_an_ensemble_of_nothing_is_empty(pendulum, torpedo):
    for kernel, inputs in ((pendulum, {"input": [0.0]}), (torpedo, {})):
        q, z = kernel.state()
        ends = kernel.ensemble(np.empty((0, len(q))), z, (0, 1), **inputs)
        assert len(ends) == 0 and ends.t.shape == (0,) and ends.q.shape == (0, len(q)) and ends.errors == []
        assert ends.steps.shape == ends.stopped.shape == (0,) and list(ends) == [] and ends.columns[0] == "t"
    ends = pendulum.ensemble([1.0], [0.0], (0, 1), input=[0.0], parameters={"length": []})
    assert len(ends) == 0 and ends.z.shape == (0, 1)
    pyarrow = pytest.importorskip("pyarrow")
    assert pyarrow.table(ends).num_rows == 0


def test_runs_are_sequences_of_states(pendulum):
    run = pendulum.simulate([1.0], [0.0], (0, 1), input=[0.0])
    states = list(run)
    assert len(states) == len(run) and list(states[0]) == run.columns
    assert states[0]["angle"] == 1.0 and states[-1] == run[-1] == run[len(run) - 1]
    assert [state["t"] for state in run] == run.t.tolist()
    assert "angle" in run and "height" not in run
    for wrong in (len(run), -len(run) - 1):
        with pytest.raises(IndexError, match="there is no row"):
            run[wrong]
    with pytest.raises(TypeError, match="columns are asked for by a name, rows by a number"):
        run[0.5]
    ends = pendulum.ensemble([[1.0], [0.5]], [0.0], (0, 1), input=[0.0])
    assert [end["angle"] for end in ends] == ends.q[:, 0].tolist() and ends[1]["steps"] == ends.steps[1]


def test_runs_are_tables_of_pandas(pendulum):
    pandas = pytest.importorskip("pandas")
    run = pendulum.simulate([1.0], [0.0], (0, 1), input=[0.0])
    ends = pendulum.ensemble([[1.0], [0.5]], [0.0], (0, 1), input=[0.0])
    for table in (run, ends):
        frame = pandas.DataFrame(table)
        assert list(frame.columns) == table.columns
        assert all(np.array_equal(frame[name], table[name]) for name in table.columns)


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


def test_states_of_elements_and_tables():
    cart = scenes.Cart(mass=3.0, lag=0.5)
    assert cart.coordinate_names == ["x", "thrust"] and cart.speed_names == ["x_dot"]
    # The motor is full from the start on: 3 v' = 2 - v / 5, a straight line of the table.
    q, z = cart.state(thrust=1.0)
    run = cart.simulate(q, z, (0, 3), rtol=1e-11, atol=1e-11, input=[1.0])
    assert abs(run.z[-1, 0] - 10 * (1 - np.exp(-3 / 15))) < 1e-9 and abs(run.q[-1, 1] - 1.0) < 1e-12
    # It comes to its thrust by the lag alone, and lanes and batches have that rate.
    run = cart.simulate(*cart.state(), (0, 1), rtol=1e-11, atol=1e-11, input=[0.7])
    assert abs(run.q[-1, 1] - 0.7 * (1 - np.exp(-2.0))) < 1e-9
    ends = cart.ensemble(np.zeros((9, 2)), [0.0], (0, 1), rtol=1e-11, atol=1e-11, input=[0.7])
    assert abs(ends.q - run.q[-1]).max() < 1e-9
    rates = cart.rates(np.tile([0.0, 0.2], (9, 1)), np.zeros((9, 1)), [0.7])
    assert np.allclose(rates, [0.0, 0.5 / 0.5, 0.4 / 3.0], atol=1e-15)
    # Rates of x, of the thrust, of the speed, by these and by the throttle.
    linear = cart.linearize([0.0, 0.2], [1.0], [0.7])
    assert np.allclose(linear.by_state, [[0, 0, 1], [0, -2, 0], [0, 1.8 / 3, -0.2 * 0.2 / 3]], atol=1e-15)
    assert np.allclose(linear.by_input, [[0], [2], [0]], atol=1e-15)


def test_constraints_that_depend_on_one_another():
    bead = scenes.Bead(mass=0.2, radius=0.5, g=9.81)
    q, z = bead.state(x=0.5 * np.sin(1.0), z=-0.5 * np.cos(1.0))
    run = bead.simulate(q, z, (0, period(1.0)), rtol=1e-11, atol=1e-11)
    # It swings as a pendulum of that length.
    assert abs(run.q[-1] - q).max() < 1e-8 and abs(np.hypot(*run.q.T) - 0.5).max() < 1e-12
    assert np.allclose(bead.acceleration(q, z), -9.81 * np.sin(1.0) * np.array([np.cos(1.0), np.sin(1.0)]), atol=1e-12)


def test_runs_are_pages(pendulum, arm, tmp_path):
    run = arm.simulate([0.3, 0.2], [0.0, 0.0], (0, 1), input=[0.0, 0.0], times=np.linspace(0, 1, 50))
    page = run.page(kernel=arm, title="An <arm>", traces=["tool", ("tool", [0.1, 0, 0])], follow="tool", up=[0, 0, 1])
    assert page.startswith("<!DOCTYPE html>") and "<arm>" not in page
    data = json.loads(re.search(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.S)[1])
    assert data["title"] == "An <arm>" and data["times"] == run.t.tolist()
    assert [body["name"] for body in data["bodies"]] == ["tool"] and len(data["traces"]) == 2
    # Poses are those of the kernel, as numbers of a screen: b, then the quaternion.
    for number, pose in zip((0, 20, 49), np.array(data["bodies"][0]["poses"])[[0, 20, 49]]):
        expected = arm.pose("tool", run.q[number])
        assert abs(pose[:3] - expected[:3, 3]).max() < 1e-6
        x, y, z, w = pose[3:]
        turned = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
        assert abs(turned - expected[:3, 0]).max() < 1e-6
    panels = {panel["title"]: [curve["name"] for curve in panel["curves"]] for panel in data["panels"]}
    assert panels == {
        "configuration": ["shoulder", "elbow"],
        "speeds": ["shoulder_dot", "elbow_dot"],
        "energy": ["kinetic_energy", "potential_energy"],
    }
    # Without a kernel curves alone; written whole.
    swing = pendulum.simulate([0.3], [0.0], (0, 1), input=[0.0])
    assert swing.page(tmp_path / "new" / "swing.html") is None
    assert "A run" in (tmp_path / "new" / "swing.html").read_text()


def test_pages_of_contacts():
    puck = scenes.Puck(mass=0.5, friction=0.3, restitution=0.6, g=9.81)
    start = puck.state(z=0.3, x_dot=2.0)
    for how in ({}, dict(contacts="steps", step=5e-3)):
        run = puck.simulate(*start, (0, 1), input=[0.0], **how)
        page = run.page(kernel=puck)
        data = json.loads(re.search(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.S)[1])
        panels = {panel["title"]: panel["curves"] for panel in data["panels"]}
        assert list(panels) == ["configuration", "speeds", "energy", "contacts", "forces"]
        # Forces of steps are those of the step before.
        known = np.isfinite(run["floor force"])
        assert data["times"] == run.t[known].tolist() and known[1:].all()
        assert panels["forces"][0]["values"] == run["floor force"][known].tolist()


def test_mistakes_with_pages(pendulum, arm, tmp_path):
    run = pendulum.simulate([0.3], [0.0], (0, 1), input=[0.0])
    with pytest.raises(ValueError, match="the run is not one of Arm: it has other columns"):
        run.page(kernel=arm)
    with pytest.raises(ValueError, match="no body is called `bob`"):
        run.page(kernel=pendulum, rods=[("bob", "bob")], traces=["bob"])
    with pytest.raises(ValueError, match="the direction that is up is zero"):
        run.page(up=[0, 0, 0])
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="the page cannot be written"):
        run.page(tmp_path / "file" / "swing.html")
