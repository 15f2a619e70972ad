"""Runs that make their steps when they are asked to."""

import os
import pickle
import threading

import numpy as np
import pytest
import scenes


def together(kernel, start, interval, **way):
    """A run as a whole, and its states step by step, with what each step said."""
    run, steps = kernel.simulate(*start, interval, **way), kernel.stepper(*start, interval, **way)
    states, said = [(steps.t, steps.q, steps.z)], []
    while not said or said[-1] == "step":
        said.append(steps.step())
        if said[-1] != "end" or steps.t != states[-1][0]:
            states.append((steps.t, steps.q, steps.z))
    return run, steps, states, said


WAYS = [
    {},
    {"rtol": 1e-6, "atol": 1e-4, "largest_step": 0.3},
    {"step": 0.013},
    {"method": "collocation", "step": 0.05},
    {"method": "dormand_prince_5"},
    {"method": "rosenbrock"},
    {"method": "radau"},
    {"method": "adams_12", "step": 0.01},
    {"until": ("angle", -0.9, "falling")},
    {"until": [("angle_dot", 99.0), ("angle", -0.5)]},
]


@pytest.mark.parametrize("way", WAYS)
def test_steps_have_the_bits_of_the_run(pendulum, way):
    run, steps, states, said = together(pendulum, ([1.0], [0.2]), (0.5, 2.0), input=[0.3], **way)
    assert np.array_equal(run.t, [t for t, _, _ in states])
    assert np.array_equal(run.q, [q for _, q, _ in states]) and np.array_equal(run.z, [z for _, _, z in states])
    assert (steps.steps, steps.rejected, steps.stopped_by) == (run.steps, run.rejected, run.stopped_by)
    assert said[-1] == ("end" if run.stopped_by is None else "until") and set(said[:-1]) <= {"step"}
    # What is over stays where it is.
    assert steps.step() == said[-1] and steps.t == run.t[-1]


def test_steps_of_poses_and_constraints(torpedo, wire):
    q, z = torpedo.state()
    z[:] = [1.0, 0.1, -0.1, 0.2, 0.3, -0.1]
    for kernel, start in [(torpedo, (q, z)), (wire, wire.project(*wire.state(x=1.0, y=1.0, y_dot=1.0)))]:
        count = len(kernel.input_names)
        own = {"input": np.linspace(0.1, 0.7, count)} if count else {}
        run, steps, states, _ = together(kernel, start, (0.0, 1.0), **own)
        assert np.array_equal(run.q, [q for _, q, _ in states]) and np.array_equal(run.z, [z for _, _, z in states])
        assert steps.q.shape == (len(kernel.coordinate_names),) and steps.z.shape == (len(kernel.speed_names),)


def test_states_within_the_last_step(pendulum):
    steps = pendulum.stepper([1.0], [0.0], (0, 2), input=[0.0], rtol=1e-11, atol=1e-11)
    for _ in range(4):
        before = (steps.t, steps.q, steps.z)
        assert steps.step() == "step"
        middle = 0.5 * (before[0] + steps.t)
        whole = pendulum.simulate([1.0], [0.0], (0, 2), input=[0.0], rtol=1e-11, atol=1e-11, times=[middle])
        q, z = steps.interpolate(middle)
        assert np.array_equal(q, whole.q[0]) and np.array_equal(z, whole.z[0])
        for t, q, z in (before, (steps.t, steps.q, steps.z)):
            assert np.array_equal(steps.interpolate(t), (q, z))
        # It is still where it was.
        assert steps.t > middle
    with pytest.raises(ValueError, match="the time 0 is outside of the last step"):
        steps.interpolate(0.0)


def test_inputs_of_steps(pendulum):
    steps = pendulum.stepper([0.1], [0.0], (0, 3), input=[0.7])
    run = pendulum.simulate([0.1], [0.0], (0, 3), input=[0.7])
    # The same numbers change nothing.
    for k in range(1, 4):
        assert steps.step([0.7]) == "step" and steps.t == run.t[k] and np.array_equal(steps.q, run.q[k])
    # Others act from there on: as a run that begins in that state.
    other = pendulum.simulate(steps.q, steps.z, (steps.t, 3), input=[-0.4])
    for k in range(1, 4):
        steps.step([-0.4])
        assert steps.t == other.t[k] and np.array_equal(steps.q, other.q[k]) and np.array_equal(steps.z, other.z[k])
    with pytest.raises(ValueError, match=r"u has shape \(2,\)"):
        steps.step([1.0, 2.0])
    with pytest.raises(TypeError, match="needs an input: motor"):
        pendulum.stepper([0.1], [0.0], (0, 1))
    with pytest.raises(TypeError, match="the input of steps is an array; each step takes another"):
        pendulum.stepper([0.1], [0.0], (0, 1), input=lambda t, q, z: [0.0])


def test_mistakes_with_steps(pendulum):
    with pytest.raises(ValueError, match="rtol must be positive"):
        pendulum.stepper([1.0], [0.0], (0, 1), input=[0.0], rtol=0.0)
    with pytest.raises(ValueError, match="no finite number"):
        pendulum.stepper([np.nan], [0.0], (0, 1), input=[0.0])
    with pytest.raises(TypeError, match="an end of steps is \\(name, value\\)"):
        pendulum.stepper([1.0], [0.0], (0, 1), input=[0.0], until=lambda t, q, z: q[0])
    with pytest.raises(KeyError, match="no number of a state is called height"):
        pendulum.stepper([1.0], [0.0], (0, 1), input=[0.0], until=("height", 0.0))
    limited = pendulum.stepper([1.0], [0.0], (0, 1e3), input=[0.0], max_steps=3)
    assert [limited.step() for _ in range(3)] == ["step"] * 3
    at = limited.t
    for _ in range(2):
        with pytest.raises(scenes.IntegrationError, match="3 steps do not reach the end") as caught:
            limited.step()
        assert limited.t == at and str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)
    with pytest.raises(TypeError, match="pickle"):
        pickle.dumps(limited)
    puck = scenes.Puck(mass=0.5, friction=0.3, restitution=0.6, g=9.81)
    start = puck.state(z=1.0, x_dot=9.0)
    with pytest.raises(scenes.ContactError, match="without_contacts"):
        puck.stepper(*start, (0, 1), input=[0.0])
    open_gaps = puck.without_contacts()
    run, _, states, _ = together(open_gaps, start, (0, 1), input=[0.0])
    assert np.array_equal(run.q, [q for _, q, _ in states])


def test_steppers_outlive_their_kernels_and_go_between_threads():
    steps = scenes.Pendulum(mass=2.0, length=0.5, g=9.81).stepper([1.0], [0.0], (0, 5), input=[0.0])
    run = scenes.Pendulum(mass=2.0, length=0.5, g=9.81).simulate([1.0], [0.0], (0, 5), input=[0.0])
    own = [threading.Thread(target=steps.step) for _ in range(8)]
    for thread in own:
        thread.start()
    for thread in own:
        thread.join()
    assert steps.steps == 8 and steps.t == run.t[8] and np.array_equal(steps.z, run.z[8])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_steppers_go_on_in_forks(pendulum):
    steps = pendulum.stepper([1.0], [0.0], (0, 5), input=[0.0])
    run = pendulum.simulate([1.0], [0.0], (0, 5), input=[0.0])
    steps.step()
    child = os.fork()
    steps.step()
    same = steps.t == run.t[2] and np.array_equal(steps.q, run.q[2])
    if child == 0:
        os._exit(0 if same else 1)
    assert os.waitpid(child, 0)[1] == 0 and same
