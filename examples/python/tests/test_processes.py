"""Processes that fork, and what goes from one to another."""

import copy
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
import scenes

#: Rows of a batch that all threads work on.
MANY = 20_000

#: A fork computes after its parent has, and a fork of that, with as many threads as the environment says.
FORKED = """
import os, sys
import numpy as np
import scenes

pendulum = scenes.Pendulum(mass=2.0, length=0.5, g=9.81)
q, z = np.linspace(-1, 1, 20_000)[:, None], np.zeros((20_000, 1))

def computed():
    ends = pendulum.ensemble(q[:40], z[:40], (0.0, 0.1), input=[0.0])
    run = pendulum.simulate([1.0], [0.0], (0.0, 0.1), input=[0.0])
    return pendulum.acceleration(q, z, [0.3]).tobytes(), ends.q.tobytes(), run.q.tobytes()

def generation(left):
    expected = computed()
    child = os.fork()
    if child == 0:
        same = computed() == expected
        os._exit(0 if same and (left == 0 or generation(left - 1)) else 1)
    return os.waitpid(child, 0)[1] == 0 and computed() == expected

sys.exit(0 if generation(1) else 1)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.parametrize("threads", ["1", "2", "5"])
def test_forks_have_threads_of_their_own(threads):
    # What hangs is ended after minutes; it takes a second.
    environment = os.environ | {"RAYON_NUM_THREADS": threads}
    assert subprocess.run([sys.executable, "-c", FORKED], env=environment, timeout=300).returncode == 0


def accelerations(kernel):
    """What a worker of a pool does."""
    q = np.linspace(-1, 1, MANY)[:, None]
    return kernel.linearize(q, np.zeros((MANY, 1)), [0.3])


def failing(kernel):
    """A run that ends at once."""
    return kernel.simulate([1.0], [0.0], (0, 1), input=lambda t, q, z: [np.inf if t > 0.5 else 0.0])


def refused(mass):
    """Parameters that no pendulum has."""
    return scenes.Pendulum(mass=mass, length=-np.inf, g=9.81)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_pools_of_processes(pendulum):
    import multiprocessing

    expected = accelerations(pendulum)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for found in pool.map_async(accelerations, [pendulum] * 4).get(timeout=300):
            assert type(found) is scenes.Linearize and all(np.array_equal(a, b) for a, b in zip(found, expected))
        with pytest.raises(scenes.IntegrationError, match="the next step is undefined") as caught:
            pool.apply_async(failing, (pendulum,)).get(timeout=300)
        assert 0.0 < caught.value.run.t[-1] <= 0.5
        with pytest.raises(scenes.ParameterError, match="mass") as caught:
            pool.apply_async(refused, (-1.0,)).get(timeout=300)
        assert {name for name, _ in caught.value.fields} == {"mass", "length"}


def equal(a, b):
    """Whether runs, or ends, are alike in all that they say."""
    names = ["columns", "interrupted", "error", "errors", "stopped_by", "steps", "rejected"]
    plain = all(np.array_equal(getattr(a, name, None), getattr(b, name, None), equal_nan=name == "steps") for name in names)
    arrays = all(np.array_equal(a[name], b[name], equal_nan=True) for name in a.columns)
    return plain and arrays and np.array_equal(a.q, b.q, equal_nan=True) and repr(a) == repr(b)


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_results_pickle(pendulum, protocol):
    def again(value):
        return pickle.loads(pickle.dumps(value, protocol))

    run = pendulum.simulate([1.0], [0.0], (0, 3), input=[0.0], events=("angle", 0.0), until=("angle", 0.5, "rising"))
    assert equal(again(run), run) and equal(copy.deepcopy(run), run) and again(run).stopped_by == 0
    assert all(np.array_equal(a, b) for a, b in zip(again(run.events[0]), run.events[0]))
    assert type(run.events[0]) is scenes.Events and not again(run).q.flags.writeable
    rows = np.array([[1.0], [np.nan], [0.5]])
    ends = pendulum.ensemble(rows, [0.0], (0, 3), input=[0.0], until=("angle", 0.0))
    assert equal(again(ends), ends) and np.array_equal(again(ends).stopped, ends.stopped)
    for error in (failing, refused):
        with pytest.raises(Exception) as caught:
            error(pendulum if error is failing else -1.0)
        found = again(caught.value)
        assert type(found) is type(caught.value) and str(found) == str(caught.value)
    assert equal(again(caught_run(pendulum)).run, caught_run(pendulum).run)
    assert again(scenes.ParameterError("mine")).args == ("mine",)


def caught_run(kernel):
    with pytest.raises(scenes.IntegrationError) as caught:
        failing(kernel)
    return caught.value


def test_exceptions_are_read_where_the_package_was_not_imported(tmp_path, pendulum):
    (tmp_path / "error").write_bytes(pickle.dumps(caught_run(pendulum)))
    read = "import pickle, sys; error = pickle.load(open(sys.argv[1], 'rb')); print(type(error).__name__, len(error.run))"
    done = subprocess.run([sys.executable, "-c", read, tmp_path / "error"], capture_output=True, text=True)
    assert done.stdout.split() == ["IntegrationError", str(len(caught_run(pendulum).run))], done.stderr


def test_exceptions_are_those_of_one_module():
    # Of another package they are these, whichever is imported first.
    module = sys.modules["gauss_python"]
    assert scenes.ParameterError is module.ParameterError and scenes.IntegrationError is module.IntegrationError
    assert issubclass(scenes.ParameterError, ValueError) and issubclass(scenes.IntegrationError, RuntimeError)
    assert scenes.Run.__module__ == scenes.Ends.__module__ == scenes.Kernel.__module__ == scenes.Arm.__module__
