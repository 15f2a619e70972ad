"""Contacts, ranges and dry friction from Python; jumps of the state."""

import pathlib
import pickle
import sys

import numpy as np
import pytest
import scenes

from test_runs import interrupted_after

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "study"))
import pucks  # noqa: E402

G, MU, E = 9.81, 0.3, 0.6


@pytest.fixture(scope="module")
def puck():
    return scenes.Puck(mass=0.5, friction=MU, restitution=E, g=G)


@pytest.fixture(scope="module")
def gate():
    return scenes.Gate(mass=2.0, width=0.8, most=0.5, restitution=0.4, rub=1.5)


def test_answers_without_contact_forces_are_refused(puck, gate):
    rest = puck.state()
    assert puck.contact_names == ["floor"] and len(gate.contact_names) == 3
    for call in (puck.acceleration, puck.inverse_dynamics, puck.nonlinear_effects, puck.rates, puck.linearize):
        arrays = [*rest, *([np.zeros(2)] if call == puck.inverse_dynamics else []), [0.0]]
        with pytest.raises(scenes.ContactError, match=f"{call.__name__} has no forces of contacts, and the scene has floor"):
            call(*arrays)
    with pytest.raises(scenes.ContactError, match=r"`kernel.without_contacts\(\).acceleration`") as caught:
        gate.acceleration(*gate.state(), [0.0])
    assert caught.value.contacts == gate.contact_names
    assert pickle.loads(pickle.dumps(caught.value)).contacts == gate.contact_names
    # What has no forces in it stays.
    assert puck.mass_matrix(rest[0]).shape == (2, 2) and puck.kinetic_energy(*rest) == 0.0


def test_open_gaps_are_asked_for_by_a_word(puck):
    free = puck.without_contacts()
    assert np.array_equal(free.acceleration(*puck.state(), [1.0]), [2.0, -G])
    assert free != puck and free == free.without_contacts() and repr(free).endswith(".without_contacts()")
    assert pickle.loads(pickle.dumps(free)) == free and hash(free) == hash(pickle.loads(pickle.dumps(free)))
    assert isinstance(free, scenes.Puck) and free.parameters == puck.parameters
    run = free.simulate(*puck.state(), (0, 1), input=[0.0])
    assert abs(run.q[-1, 1] + G / 2) < 1e-9 and run.contact_report == {} and run.contact_events == []
    ends = free.ensemble(*puck.state(), (0, 1), input=[0.0])
    assert abs(ends.q[0, 1] + G / 2) < 1e-9
    with pytest.raises(TypeError, match="impact is of contacts, and none act in this run"):
        free.simulate(*puck.state(), (0, 1), input=[0.0], impact="moreau")


def test_functions_of_jax_are_those_of_open_gaps_by_a_word(puck):
    pytest.importorskip("jax")
    with pytest.raises(scenes.ContactError, match=r"jax\(kernel.without_contacts\(\)\)"):
        scenes.jax(puck)
    assert scenes.jax(puck.without_contacts()).acceleration(*puck.state(), np.zeros(1)).shape == (2,)


def test_forces_at_a_state(puck, gate):
    # It lies, and is pushed with less than friction holds; with more; it slides; it flies.
    weight = 0.5 * G
    held = puck.in_contact(*puck.state(), [1.0])
    assert held.modes == {"floor": "sticks"} and abs(held.acceleration).max() < 1e-12
    assert np.allclose(held.forces["floor"], [weight, -1.0], atol=1e-12)
    pushed = puck.in_contact(*puck.state(), [3.0])
    assert pushed.modes == {"floor": "slides"}
    assert np.allclose(pushed.acceleration, [3.0 / 0.5 - MU * G, 0.0], atol=1e-12)
    slides = puck.in_contact(*puck.state(x_dot=-2.0), [0.0])
    assert np.allclose(slides.acceleration, [MU * G, 0.0], atol=1e-12)
    flies = puck.in_contact(*puck.state(z=1.0, x_dot=-2.0), [0.0])
    assert flies.modes == {"floor": "open"} and np.array_equal(flies.acceleration, [0.0, -G])
    with pytest.raises(ValueError, match="contact floor is closing: velocities jump there"):
        puck.in_contact(*puck.state(z_dot=-1.0), [0.0])
    assert gate.in_contact(*gate.state(), [1.0]).modes["hinge"] == "sticks"
    with pytest.raises(TypeError, match="acceleration has all forces"):
        puck.without_contacts().in_contact(*puck.state(), [0.0])


def bounced(height, speed):
    """When bounces from a height end, and where the puck then stops."""
    fall = np.sqrt(2 * height / G)
    # Each impact takes mu (1 + e) v of the speed, as long as there is some.
    impact, t, x = np.sqrt(2 * G * height), fall, speed * fall
    for _ in range(200):
        speed = max(speed - MU * (1 + E) * impact, 0.0)
        impact *= E
        t, x = t + 2 * impact / G, x + speed * 2 * impact / G
    return t, x + speed**2 / (2 * MU * G)


def test_from_event_to_event(puck):
    end, stop = bounced(1.0, 9.0)
    run = puck.simulate(*puck.state(z=1.0, x_dot=9.0), (0, 4), rtol=1e-11, atol=1e-11, input=[0.0])
    # What is left out of infinitely many bounces is of the size of the tolerance.
    assert abs(run.q[-1, 0] - stop) < 1e-8 and abs(run.q[-1, 1]) < 1e-10 and abs(run.z[-1]).max() < 1e-12
    impacts = [event for event in run.contact_events if event.kind == "impact"]
    assert abs(impacts[0].t - np.sqrt(2 / G)) < 1e-9 and impacts[0].contact == "floor"
    before, after = impacts[0].before, impacts[0].after
    assert abs(after[0] + E * before[0]) < 1e-9 and np.allclose(impacts[0].impulse, 0.5 * (after - before), atol=1e-12)
    lost = 0.25 * (before @ before - after @ after)
    assert abs(impacts[0].energy_lost - lost) < 1e-12
    rests = [event.t for event in run.contact_events if event.kind == "rests"]
    assert len(rests) == 1 and abs(rests[0] - end) < 1e-4
    assert [event.kind for event in run.contact_events][-1] == "sticks"
    # Forces: none in the air, the weight and friction on the floor; two states at the time of an impact.
    weight = 0.5 * G
    flying, slid = run.t < impacts[0].t, (run.t > end + 1e-3) & (run.z[:, 0] > 1e-3)
    assert (run["floor force"][flying] == 0).all() and slid.any()
    assert np.allclose(run["floor force"][slid], weight) and np.allclose(run["floor friction"][slid], -MU * weight)
    assert (np.diff(run.t) == 0).sum() >= len(impacts) and np.array_equal(run["floor gap"], run.q[:, 1])
    report = run.contact_report
    assert report["impacts"] == len(impacts)
    assert report["velocity_residual"] <= report["velocity_rounding"] < 1e-9
    assert report["acceleration_residual"] <= report["acceleration_rounding"] < 1e-9
    assert run.sampled_gaps == []


def test_states_between_and_events_of_ones_own(puck):
    times = np.linspace(0, 2, 41)
    start = puck.state(z=1.0, x_dot=9.0)
    run = puck.simulate(*start, (0, 2), input=[0.0], times=times, events=[("z", 0.5, "falling"), ("z", 0.1, "rising")])
    assert np.array_equal(run.t, times)
    air = times < np.sqrt(2 / G)
    assert np.allclose(run.q[air, 1], 1 - G * times[air] ** 2 / 2, atol=1e-8)
    # Every bounce is 0.36 times as high as that before.
    assert len(run.events[0].t) == 1 and len(run.events[1].t) == 2 and abs(run.events[0].t[0] - np.sqrt(1 / G)) < 1e-9
    run = puck.simulate(*start, (0, 2), input=[0.0], events=("z", 0.5), until=[("z", -1.0), ("x", 3.0)])
    assert run.stopped_by == 1 and abs(run.q[-1, 0] - 3.0) < 1e-9 and run.t[-1] < 2


def test_in_steps(puck):
    stop = bounced(1.0, 9.0)[1]
    start, how = puck.state(z=1.0, x_dot=9.0), {"contacts": "steps", "input": [0.0]}
    far = [abs(puck.simulate(*start, (0, 4), step=h, **how).q[-1, 0] - stop) for h in (4e-3, 1e-3)]
    # Impacts come at the end of the step: of first order, in a motion of 9 m/s.
    assert far[0] < 9.0 * 4e-3 and far[1] < 9.0 * 1e-3
    run = puck.simulate(*start, (0, 4), step=1e-3, **how)
    assert run.steps == 4000 and len(run) == 4001 and np.isnan(run["floor force"][0])
    assert np.allclose(run["floor force"][-100:], 0.5 * G, atol=1e-9)
    kinds = {event.kind for event in run.contact_events}
    assert {"slides", "sticks", "leaves"} <= kinds
    report = run.contact_report
    assert report["velocity_residual"] <= max(1e-8 * 9.0, report["velocity_rounding"]) and report["impacts"] > 3
    assert report["penetration"] < 5.0 * 1e-3 and report["work"] < 0.0
    # Events are found between the ends of steps: of a flight, which steps have to rounding, they are right.
    run = puck.simulate(*start, (0, 4), step=1e-3, until=("z", 0.5, "falling"), events=lambda t, q, z: t - 0.20037, **how)
    assert run.stopped_by == 0 and abs(run.t[-1] - np.sqrt(1 / G)) < 1e-9 and abs(run.q[-1, 1] - 0.5) < 1e-9
    assert abs(run.events[0].t[0] - 0.20037) < 1e-9
    # So are states at other times; forces are those of the step, whose mean is that of a weight at rest.
    times = np.array([0.0, 0.10037, 3.5, 3.50037])
    between = puck.simulate(*start, (0, 4), step=1e-3, times=times, **how)
    assert np.array_equal(between.t, times) and abs(between.q[1, 1] - (1 - G * times[1] ** 2 / 2)) < 1e-12
    assert np.allclose(between["floor force"], [0.0, 0.0, 0.5 * G, 0.5 * G], atol=1e-9)
    relaxed = puck.simulate(*puck.state(x_dot=1.0), (0, 0.1), step=1e-3, friction="relaxed", **how)
    assert relaxed.contact_report["from_coulomb"] > 0.1 and relaxed.q[-1, 1] > 0
    twice = [puck.simulate(*start, (0, 1), step=1e-3, scheme=scheme, **how).q[-1] for scheme in ("midpoint", "moreau_jean")]
    assert np.allclose(*twice, atol=1e-2)


def test_in_steps_that_keep_a_tolerance(puck):
    stop = bounced(1.0, 9.0)[1]
    start, how = puck.state(z=1.0, x_dot=9.0), {"contacts": "steps", "input": [0.0], "step": 0.05}
    runs = [puck.simulate(*start, (0, 4), rtol=tol, atol=tol, **how) for tol in (1e-4, 1e-6)]
    # Impacts are found to a thousandth of the longest step, in a motion of 9 m/s; a tolerance takes shorter steps.
    assert all(abs(run.q[-1, 0] - stop) < 9.0 * 0.05e-3 * 8 for run in runs)
    assert runs[0].steps < runs[1].steps and all(0.05 + 1e-12 > np.diff(run.t).max() for run in runs)
    assert all("largest_beyond" in run.contact_report for run in runs)
    assert "beyond" not in puck.simulate(*start, (0, 4), **how).contact_report
    ends = puck.ensemble(*puck.state(x_dot=2.0), (0, 4), rtol=1e-6, parameters={"friction": [0.2, 0.4]}, **how)
    assert np.allclose(ends.q[:, 0], 4.0 / (2 * G * np.array([0.2, 0.4])), atol=1e-4)


def test_inputs_of_contact_runs(puck):
    calls = []

    def push(t, q, z):
        calls.append(t)
        return [3.0 if t < 0.5 else 0.0]

    # Until 0.5 s it is pushed by 3 N, then it slides until it stops: both by Coulomb's law.
    fast = (3.0 / 0.5 - MU * G) * 0.5
    stop = fast * 0.5 / 2 + fast**2 / (2 * MU * G)
    for step in (1e-3, 5e-4):
        calls.clear()
        run = puck.simulate(*puck.state(), (0, 1.5), contacts="steps", step=step, input=push)
        assert abs(run.q[-1, 0] - stop) < fast * 2 * step and len(calls) == round(1.5 / step)
    table = ([0.0, 0.5, 0.5000001, 1.5], [3.0, 3.0, 0.0, 0.0])
    run = puck.simulate(*puck.state(), (0, 1.5), input=table, largest_step=0.05)
    assert abs(run.q[-1, 0] - stop) < 1e-5 and run.contact_events[-1].kind == "sticks"


def test_controllers_in_steps_of_contacts(puck):
    called, how = [], {"contacts": "steps", "step": 1e-3}

    def law(t, q, z):
        called.append(t)
        return 3.0 * (1.0 - z)[:1] + 2.0

    start = puck.state(z=0.1, x_dot=2.0)
    run = puck.simulate(*start, (0.2, 1.2), controller=law, period=0.02, **how)
    assert np.allclose(called, 0.2 + 0.02 * np.arange(50), atol=1e-9)
    # It has the bits of an input that holds the same.
    held = {}

    def holds(t, q, z):
        # The time is that at the middle of a step.
        return held.setdefault(int((t - 0.2) / 1e-3) // 20, 3.0 * (1.0 - z)[:1] + 2.0)

    alone = puck.simulate(*start, (0.2, 1.2), input=holds, **how)
    assert np.array_equal(run.q, alone.q) and np.array_equal(run["floor force"][1:], alone["floor force"][1:])
    # Later by half a period; before that the input alone acts.
    late = puck.simulate(*puck.state(), (0, 0.1), controller=lambda t, q, z: [3.0], period=0.02, delay=0.03, **how)
    moves = late.t[np.flatnonzero(late.q[:, 0] > 0)[0]]
    assert abs(moves - 0.031) < 1e-9
    # An instant that is no end of a step cuts one.
    called.clear()
    puck.simulate(*start, (0, 0.1), controller=law, period=0.0015, **how)
    assert np.allclose(called, 0.0015 * np.arange(67), atol=1e-12)


def test_controllers_from_event_to_event(puck):
    called = []

    def law(t, q, z):
        called.append(t)
        return [3.0 if t < 0.05 else 0.0]

    late = puck.simulate(*puck.state(), (0, 0.2), controller=law, period=0.02, delay=0.03, rtol=1e-10, atol=1e-10)
    assert np.allclose(called, 0.02 * np.arange(10), atol=1e-12)
    steps = puck.simulate(
        *puck.state(), (0, 0.2), controller=law, period=0.02, delay=0.03, contacts="steps", step=1e-4
    )
    # Nothing acts for 30 ms, then what was sampled before 50 ms, until 90 ms.
    assert late.q[np.searchsorted(late.t, 0.03, "right") - 1, 0] == 0.0
    assert late.q[-1, 0] > 1e-5 and abs(late.q[-1, 0] - steps.q[-1, 0]) < 1e-5


def test_ranges_and_dry_friction(gate):
    inertia = 2.0 * 0.8**2
    # The hinge holds what is less than its bound, and takes it from what is more.
    for how in ({}, {"contacts": "steps", "step": 1e-3}):
        assert abs(gate.simulate(*gate.state(), (0, 1), input=[1.4], **how).q[-1]) < 1e-12
        run = gate.simulate(*gate.state(), (0, 0.5), input=[2.0], **how)
        tolerance = 1e-8 if not how else 0.5 / inertia * 0.5 * 1e-3
        assert abs(run.q[-1] - 0.5 * (0.5 / inertia) * 0.25) < tolerance
        run = gate.simulate(*gate.state(angle_dot=3.0), (0, 3), input=[0.0], **how)
        assert abs(run.z[-1]) < 1e-12 and (abs(run.q) < 0.5 + 3.0 * 1e-3).all()
    run = gate.simulate(*gate.state(angle_dot=3.0), (0, 3), input=[0.0], rtol=1e-11, atol=1e-11)
    before = np.sqrt(9.0 - 2 * 1.5 / inertia * 0.5)
    impact = next(event for event in run.contact_events if event.kind == "impact")
    assert abs(abs(impact.before[0]) - before) < 1e-9 and abs(abs(impact.after[0]) - 0.4 * before) < 1e-9
    left = 0.4 * before
    assert abs(run.q[-1] - (0.5 - left**2 / (2 * 1.5 / inertia))) < 1e-8


def test_words_that_do_not_go_together(puck, pendulum):
    start = puck.state(z=1.0)
    wrong = [
        (dict(step=1e-3), ValueError, 'step is that of contacts="steps"'),
        (dict(contacts="steps"), ValueError, "needs step"),
        (dict(contacts="steps", step=1e-3, rtol=0.0), ValueError, "rtol must be positive"),
        (dict(contacts="exact"), ValueError, "contacts is 'exact'|\"exact\"; there are events, steps"),
        (dict(impact="hertz"), ValueError, "there are newton, moreau, poisson, sequential"),
        (dict(friction="relaxed"), ValueError, 'friction and scheme are those of contacts="steps"'),
        (dict(method="taylor"), ValueError, "with contacts the method is dormand_prince"),
        (dict(contacts="steps", step=1e-3, impact="moreau"), ValueError, "impacts in steps go by Newton's law"),
    ]
    for words, error, told in wrong:
        with pytest.raises(error, match=told):
            puck.simulate(*start, (0, 1), **{"input": [0.0], **words})
    with pytest.raises(TypeError, match="contacts is of contacts, and none act in this run"):
        pendulum.simulate([0.0], [0.0], (0, 1), input=[0.0], contacts="events")
    with pytest.raises(TypeError, match="step is of contacts, and none act in this ensemble"):
        pendulum.ensemble([0.0], [0.0], (0, 1), input=[0.0], step=0.1)


def test_failures_of_contact_runs_keep_what_there_is(puck):
    for how in ({}, {"contacts": "steps", "step": 1e-3}):
        with pytest.raises(scenes.IntegrationError, match="contact floor: the gap starts at -1e0") as caught:
            puck.simulate(*puck.state(z=-1.0), (0, 1), input=[0.0], **how)
        with pytest.raises(scenes.IntegrationError, match="10 steps do not reach the end.*`max_steps`") as caught:
            puck.simulate(*puck.state(z=1.0), (0, 5), input=[0.0], max_steps=10, **how)
        run = pickle.loads(pickle.dumps(caught.value)).run
        assert 0 < len(run) <= 20 and "floor gap" in run and run.error and run.contact_report
        with pytest.raises(ZeroDivisionError) as caught:
            puck.simulate(*puck.state(z=1.0), (0, 5), input=lambda t, q, z: [1 / (t < 0.3)], **how)
        assert caught.value.run.interrupted and caught.value.run.t[-1] < 0.31
    bounced = puck.simulate(*puck.state(z=1.0), (0, 3), input=[0.0])
    kept = pickle.loads(pickle.dumps(bounced))
    assert [event[:3] for event in kept.contact_events] == [event[:3] for event in bounced.contact_events]
    assert kept.contact_report == bounced.contact_report and np.array_equal(kept["floor force"], bounced["floor force"])


def test_contact_runs_are_interrupted(puck):
    start = puck.state(z=1.0, x_dot=1.0)
    for how in ({"largest_step": 1e-3}, {"contacts": "steps", "step": 1e-4}):
        with interrupted_after(0.5) as caught:
            puck.simulate(*start, (0, 1e5), input=[0.0], max_steps=10**12, **how)
        assert caught.value.run.interrupted and 0 < caught.value.run.t[-1] < 1e5
        with interrupted_after(0.5) as caught:
            puck.ensemble(np.array([[0.0, 1.0]] * 9), start[1], (0, 1e5), input=[0.0], max_steps=10**12, **how)
        assert caught.value.ends.interrupted and len(caught.value.ends) == 9


def test_ensembles_with_contacts(puck, gate):
    heights = np.linspace(0.2, 2.0, 40)
    q = np.stack([np.zeros(40), heights], axis=1)
    stops = np.array([bounced(height, 5.0)[1] for height in heights])
    ends = puck.ensemble(q, [5.0, 0.0], (0, 8), rtol=1e-10, atol=1e-10, input=[0.0])
    assert abs(ends.q[:, 0] - stops).max() < 1e-7 and ends.errors == [] and (ends["impacts"] > 3).all()
    assert (ends["velocity_residual"] < 1e-12).all() and (ends.steps > 0).all()
    # Every row is the run that it is alone.
    alone = puck.simulate(q[7], [5.0, 0.0], (0, 8), rtol=1e-10, atol=1e-10, input=[0.0])
    assert np.array_equal(ends.q[7], alone.q[-1]) and ends.steps[7] == alone.steps
    how = {"contacts": "steps", "step": 2e-3, "input": [0.0]}
    stepped = puck.ensemble(q, [5.0, 0.0], (0, 8), **how)
    assert np.array_equal(stepped.q[7], puck.simulate(q[7], [5.0, 0.0], (0, 8), **how).q[-1])
    assert abs(stepped.q[:, 0] - stops).max() < 5.0 * 2e-3 * 3
    # Parameters and ends of one's own; rows that cannot begin stop no other.
    frictions = np.linspace(0.1, 0.5, 6)
    slid = puck.ensemble([0.0, 0.0], [2.0, 0.0], (0, 9), input=[0.0], parameters={"friction": frictions})
    assert np.allclose(slid.q[:, 0], 4.0 / (2 * frictions * G), atol=1e-7)
    stopped = puck.ensemble(q, [5.0, 0.0], (0, 8), input=[0.0], until=("x", 1.0))
    assert stopped.stopped.all() and np.allclose(stopped.q[:, 0], 1.0, atol=1e-9)
    masses, start = np.array([1.0, -1.0, 1.0, 1.0]), np.array([[0, 1], [0, 1], [0, -1], [0, np.nan]], dtype=float)
    ends = puck.ensemble(start, [0.0, 0.0], (0, 1), input=[0.0], parameters={"mass": masses})
    assert [number for number, _ in ends.errors] == [1, 2, 3] and np.isnan(ends.q[1]).all()
    told = dict(ends.errors)
    assert "mass" in told[1] and "the gap starts at -1e0" in told[2] and "q[1] (z) is NaN" in told[3]
    assert abs(ends.z[0, 1]) < 5 and ends.steps[0] > 0 and len(puck.ensemble(np.zeros((0, 2)), [0.0, 0.0], (0, 1), input=[0.0])) == 0
    held = gate.ensemble([0.0], np.linspace(-1, 1, 5)[:, None], (0, 3), input=[0.0])
    assert (abs(held.z) < 1e-12).all() and held.errors == []


def test_jumps_go_with_contacts(puck):
    """A wall of one's own before a puck that slides: its way is v²/(2 μ g), folded at the wall."""
    wall = (("x", 1.0, "rising"), lambda t, q, z: (q, [-z[0], z[1]]))
    start, way = puck.state(x_dot=3.0), 9.0 / (2 * MU * G)
    for words, near in ((dict(rtol=1e-10, atol=1e-10), 1e-8), (dict(contacts="steps", step=1e-3), 1e-4)):
        run = puck.simulate(*start, (0, 2), input=[0.0], jumps=wall, **words)
        assert abs(run.q[-1, 0] - (2.0 - way)) < near and abs(run.z[-1]).max() < 1e-9
        assert len(run.jumps[0].t) == 1 and abs(run.jumps[0].q[0, 0] - 1.0) < 1e-12
        same = np.flatnonzero(np.diff(run.t) == 0.0)
        assert any(abs(run.z[n, 0] + run.z[n + 1, 0]) < 1e-12 for n in same)
        # None leaves the state, and the run goes on.
        seen = puck.simulate(*start, (0, 2), input=[0.0], jumps=(("x", 0.7, "rising"), lambda t, q, z: None), **words)
        assert abs(seen.q[-1, 0] - way) < near and seen.t[-1] == 2.0 and len(seen.jumps[0].t) == 1
    with pytest.raises(scenes.IntegrationError, match="leaves the gap"):
        puck.simulate(*start, (0, 2), input=[0.0], jumps=(("x", 1.0, "rising"), lambda t, q, z: ([q[0], -1.0], z)))


def test_jumps_of_the_state(pendulum):
    # A pendulum that a clock kicks whenever it passes the bottom from the left.
    kick = (("angle", 0.0, "rising"), lambda t, q, z: (q, 1.1 * z), "through")
    run = pendulum.simulate([-0.5], [0.0], (0, 3), rtol=1e-11, atol=1e-11, input=[0.0], jumps=kick)
    before = run.jumps[0]
    assert len(before.t) >= 2 and run.events == []
    places = [np.flatnonzero(run.t == t) for t in before.t]
    for k, place in enumerate(places):
        first, second = place[0], place[-1]
        assert len(place) == 2 and np.array_equal(run.z[first], before.z[k])
        assert np.array_equal(run.z[second], 1.1 * run.z[first]) and np.array_equal(run.q[first], run.q[second])
    energy = run.kinetic_energy + run.potential_energy
    assert abs(energy[places[0][0]] - energy[0]) < 1e-9 and abs(energy[places[1][0]] - energy[places[0][-1]]) < 1e-9


def test_a_wall_of_ones_own_turns_back(pendulum):
    # Two walls, whose restitution is the function's; beside an event, an end and a controller.
    walls = [(("angle", 0.3, "rising"), lambda t, q, z: (q, -0.9 * z)), ((lambda t, q, z: q[0] + 0.2, "falling"), lambda t, q, z: (q, -z))]
    run = pendulum.simulate(
        [0.0], [4.0], (0, 2), input=[0.0], jumps=walls, events=("angle", 0.0), until=lambda t, q, z: t - 1.5,
        controller=lambda t, q, z: [0.0], period=0.1,
    )
    assert run.stopped_by == 0 and abs(run.t[-1] - 1.5) < 1e-9 and run.q.max() < 0.3 + 1e-9 and run.q.min() > -0.2 - 1e-9
    assert len(run.jumps[0].t) > 2 and len(run.jumps[1].t) > 2 and len(run.events[0].t) > 4
    kept = pickle.loads(pickle.dumps(run))
    assert np.array_equal(kept.jumps[1].t, run.jumps[1].t) and kept.steps == run.steps
    # None leaves the state; a jump that does not turn back would pass the wall unseen.
    seen = pendulum.simulate([0.0], [1.0], (0, 2), input=[0.0], jumps=(("angle", 0.1), lambda t, q, z: None))
    assert len(seen.jumps[0].t) >= 2
    with pytest.raises(scenes.IntegrationError, match='"through"'):
        pendulum.simulate([0.0], [1.0], (0, 2), input=[0.0], jumps=(("angle", 0.1, "rising"), lambda t, q, z: (q, 0.5 * z)))


def test_jumps_that_are_none(pendulum, wire):
    def run(jump):
        return pendulum.simulate([0.0], [1.0], (0, 2), input=[0.0], jumps=(("angle", 0.1), jump))

    for jump, error, told in [
        (lambda t, q, z: q, TypeError, r"a jump gives \(q, z\)"),
        (lambda t, q, z: (q, [np.nan]), ValueError, "angle_dot\\) is NaN"),
        (lambda t, q, z: (q, [1.0, 2.0]), ValueError, r"z has shape \(2,\)"),
        (lambda t, q, z: 1 / 0, ZeroDivisionError, "division by zero"),
    ]:
        with pytest.raises(error, match=told) as caught:
            run(jump)
        assert 0 < caught.value.run.t[-1] < 0.2
    for wrong in [("angle", 0.1), (("angle", 0.1), lambda t, q, z: (q, z), "past"), [lambda t, q, z: 0.0]]:
        with pytest.raises(TypeError, match=r"a jump is \(event, function\)"):
            pendulum.simulate([0.0], [1.0], (0, 2), input=[0.0], jumps=wrong)
    q, z = wire.project(*wire.state(x=1.0, y=1.0))
    with pytest.raises(ValueError, match="is no rotation"):
        wire.simulate(q, z, (0, 2), jumps=(("y", 0.5), lambda t, q, z: (2 * q, z)))


def test_the_study_of_pucks_stops_where_the_formula_says():
    given = pucks.thrown(3, 60)
    expected = pucks.formula(*given)
    ends = pucks.stops(*given)
    assert ends.errors == [] and abs(ends.q[:, 0] - expected).max() < 1e-6
    # Each impact, of at most mu (1 + e) v of the speed, comes up to a step late, at 10 m/s.
    stepped = pucks.stops(*given, contacts="steps", step=5e-3)
    assert stepped.errors == [] and abs(stepped.q[:, 0] - expected).max() < 10.0 * 5e-3 * 3
