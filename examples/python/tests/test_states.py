"""States by name: structured arrays, and the views of them that kernels read."""

import tracemalloc

import numpy as np
import pytest


def filled(torpedo, random, shape):
    """Random states; rotations of norm 1."""
    states = torpedo.states(shape)
    for name in states.dtype.names:
        states[name] = random.standard_normal(shape)
    q, _ = torpedo.views(states)
    q[..., :4] /= np.linalg.norm(q[..., :4], axis=-1, keepdims=True)
    return states


def test_fields_are_coordinates_and_speeds(torpedo):
    states = torpedo.states((3, 2), pose_z=-5.0)
    assert states.shape == (3, 2) and states.dtype == torpedo.dtype
    assert list(states.dtype.names) == torpedo.coordinate_names + torpedo.speed_names
    assert (states["pose_z"] == -5.0).all()
    q, z = torpedo.state(pose_z=-5.0)
    for found, expected in zip(torpedo.views(torpedo.states(4, pose_z=-5.0)), (q, z)):
        assert found.shape == (4, len(expected)) and (found == expected).all()
    one = torpedo.states()
    assert one.shape == () and all(np.array_equal(a, b) for a, b in zip(torpedo.views(one), torpedo.state()))


def test_views_share_memory(torpedo, random):
    states = filled(torpedo, random, (5,))
    q, z = torpedo.views(states)
    assert np.shares_memory(q, states) and np.shares_memory(z, states)
    states["pose_z"] = 7.0
    assert (q[:, torpedo.coordinate_names.index("pose_z")] == 7.0).all()
    z[2] = 3.0
    assert all(states[name][2] == 3.0 for name in torpedo.speed_names)


@pytest.mark.parametrize("shape", [(), (1,), (7,), (3, 11), (2, 700)])
def test_views_have_the_bits_of_copies(torpedo, random, shape):
    states = filled(torpedo, random, shape)
    q, z = torpedo.views(states)
    for method in (torpedo.acceleration, torpedo.rates, torpedo.energy):
        assert np.array_equal(method(q, z), method(q.copy(), z.copy()))
    out = np.empty((*shape, 6))
    torpedo.acceleration(q, z, out=out)
    assert np.array_equal(out, torpedo.acceleration(q.copy(), z.copy()))


@pytest.mark.parametrize("count", [1, 2, 7, 8, 9, 127, 128, 129, 512, 513, 1025])
def test_rows_are_gathered_whatever_their_number(torpedo, pendulum, random, count):
    states = filled(torpedo, random, (count,))
    q, z = torpedo.views(states)
    expected = torpedo.acceleration(q.copy(), z.copy())
    assert np.array_equal(torpedo.acceleration(q, z), expected)
    # One row for all, of each argument in turn, beside rows that lie apart.
    whole = np.repeat(q[:1].copy(), count, axis=0)
    assert np.array_equal(torpedo.acceleration(q[0], z), torpedo.acceleration(whole, z.copy()))
    whole = np.repeat(z[:1].copy(), count, axis=0)
    assert np.array_equal(torpedo.acceleration(q, z[0]), torpedo.acceleration(q.copy(), whole))
    times, u = random.standard_normal(count), random.standard_normal((count, 1))
    found = pendulum.acceleration([0.5], [0.1], u, t=times)
    assert np.array_equal(found, pendulum.acceleration(np.full((count, 1), 0.5), np.full((count, 1), 0.1), u, t=times))


def test_parts_of_structured_arrays(torpedo, pendulum, random):
    states = filled(torpedo, random, (20, 3))
    for part in (states[::2], states[:, 1], states[3:5], states[::-1], states.T, states[:0]):
        q, z = torpedo.views(part)
        assert np.shares_memory(q, states) or part.size == 0
        assert np.array_equal(torpedo.acceleration(q, z), torpedo.acceleration(q.copy(), z.copy()))
    # Of one coordinate and one speed.
    swings = pendulum.states(600)
    swings["angle"], swings["angle_dot"] = random.standard_normal((2, 600))
    q, z = pendulum.views(swings)
    expected = pendulum.acceleration(swings["angle"].copy()[:, None], swings["angle_dot"].copy()[:, None], [0.3])
    assert np.array_equal(pendulum.acceleration(q, z, [0.3]), expected)


def test_results_into_structured_arrays(pendulum):
    states = pendulum.states(10, angle=0.5)
    q, z = pendulum.views(states)
    # Results are rows that follow each other; what they overlap is told.
    with pytest.raises(ValueError, match="C order"):
        pendulum.acceleration(q, z, [0.0], out=z)
    numbers = states.view(("f8", 2)).reshape(20, 1)[:10]
    with pytest.raises(ValueError, match="shares memory with q"):
        pendulum.acceleration(q, z, [0.0], out=numbers)
    numbers = np.empty(30)
    first = numbers[:20].view(pendulum.dtype)
    first["angle"], first["angle_dot"] = 0.5, 0.0
    found = pendulum.acceleration(*pendulum.views(first), [0.0], out=numbers[20:].reshape(10, 1))
    assert np.array_equal(found, pendulum.acceleration(q, z, [0.0]))


def test_views_are_read_where_they_are(torpedo, random):
    states, out = filled(torpedo, random, (20_000,)), np.empty((20_000, 6))
    q, z = torpedo.views(states)
    tracemalloc.start()
    torpedo.acceleration(q, z, out=out)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # NumPy tells of what it allocates; a copy of z alone would be a million bytes.
    assert peak < 100_000


def test_mistakes_in_structured_arrays(torpedo, pendulum):
    with pytest.raises(ValueError, match="expected `dtype` of Torpedo"):
        torpedo.views(pendulum.states(3))
    with pytest.raises(TypeError, match="structured array"):
        torpedo.views([1.0, 2.0])
    with pytest.raises(ValueError, match="expected `dtype` of Torpedo"):
        torpedo.views(np.zeros((3, 13)))
    with pytest.raises(TypeError, match="no coordinate or speed is called height"):
        torpedo.states(3, height=1.0)
    with pytest.raises(ValueError):
        torpedo.states(-1)
