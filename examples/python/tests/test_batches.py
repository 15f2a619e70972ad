"""Methods over arrays: against formulas and against one state at a time, to the last bit."""

import threading

import numpy as np
import pytest
import scenes

EPS = np.finfo(float).eps


def states(kernel, random, shape):
    """Random configurations and speeds; rotations of norm 1."""
    rest, _ = kernel.state()
    q = random.standard_normal((*shape, len(rest)))
    for k, name in enumerate(kernel.coordinate_names):
        if name.endswith("_i"):
            q[..., k : k + 4] /= np.linalg.norm(q[..., k : k + 4], axis=-1, keepdims=True)
    return q, random.standard_normal((*shape, kernel.dof))


def test_accelerations_of_a_pendulum(pendulum, random):
    q, z, u = (random.standard_normal((1000, 1)) for _ in range(3))
    expected = -9.81 / 0.5 * np.sin(q) + u / (2 * 0.5**2)
    # Five roundings of terms of this size.
    size = 9.81 / 0.5 + abs(u) / 0.5
    assert (abs(pendulum.acceleration(q, z, u) - expected) <= 5 * EPS * size).all()


@pytest.mark.parametrize("name", ["pendulum", "torpedo", "arm", "wire"])
def test_batches_have_the_bits_of_single_states(name, request, random):
    kernel = request.getfixturevalue(name)
    q, z = states(kernel, random, (3, 7))
    u = random.standard_normal((3, 7, len(kernel.input_names)))
    inputs = [u] if kernel.input_names else []
    calls = {
        kernel.acceleration: (q, z, *inputs),
        kernel.mass_matrix: (q,),
        kernel.rates: (q, z, *inputs),
        kernel.energy: (q, z),
        kernel.inverse_dynamics: (q, z, np.flip(z), *inputs),
    }
    for method, arguments in calls.items():
        whole = method(*arguments, t=0.5)
        assert whole.shape[:2] == (3, 7)
        for i, j in np.ndindex(3, 7):
            alone = method(*(argument[i, j] for argument in arguments), t=0.5)
            assert np.array_equal(alone, whole[i, j])


def test_inverse_dynamics_is_inverse(arm, random):
    q, z = states(arm, random, (500,))
    u, wanted = random.standard_normal((2, 500, 2))
    force = arm.inverse_dynamics(q, z, wanted, u)
    mass = arm.mass_matrix(q)
    residual = np.einsum("nij,nj->ni", mass, wanted - arm.acceleration(q, z, u)) - force
    # Some dozens of roundings, times the condition of the mass matrix.
    bound = 100 * EPS * np.linalg.cond(mass)[:, None] * (1 + abs(force).max(axis=1, keepdims=True))
    assert (abs(residual) <= bound).all()


def test_leading_axes_are_the_batch(pendulum):
    q, z, u = np.zeros((4, 5, 1)), np.ones((4, 5, 1)), np.full(1, 0.3)
    assert pendulum.acceleration(q, z, u).shape == (4, 5, 1)
    assert pendulum.energy(q, z).shape == (4, 5)
    assert pendulum.mass_matrix(q).shape == (4, 5, 1, 1)
    assert pendulum.acceleration(q[:0], z[:0], u).shape == (0, 5, 1)
    assert pendulum.acceleration([0.0], [0.0], [0.3]).shape == (1,)
    assert pendulum.acceleration(np.zeros(1, dtype=np.float32), [0], [0]).dtype == np.float64
    # Neither order of memory nor strides matter.
    far = np.arange(24.0).reshape(4, 6, 1)[:, ::2]
    assert np.array_equal(pendulum.potential_energy(far), pendulum.potential_energy(far.copy()))
    assert np.array_equal(pendulum.potential_energy(np.asfortranarray(far)), pendulum.potential_energy(far))


def misaligned(array):
    """The same numbers a byte beside where numbers of 64 bits lie, as arrays from a wire have them."""
    memory = np.zeros(array.nbytes + 9, dtype=np.uint8)
    off = 1 if memory.ctypes.data % 8 == 0 else 0
    found = memory[off : off + array.nbytes].view(np.float64).reshape(array.shape)
    found[...] = array
    assert not found.flags.aligned
    return found


def test_arrays_need_not_be_aligned(pendulum, random):
    q, z = random.standard_normal((2, 600, 1))
    u = np.array([0.3])
    for odd in (misaligned, lambda array: array.astype(">f8"), np.asfortranarray):
        p, v = odd(q), odd(z)
        p.flags.writeable = False
        assert np.array_equal(pendulum.acceleration(p, v, odd(u)), pendulum.acceleration(q, z, u))
        ends = pendulum.ensemble(p[:20], v[:20], (0, 0.1), input=odd(u), parameters={"length": odd(np.full(20, 0.5))})
        assert np.array_equal(ends.q, pendulum.ensemble(q[:20], z[:20], (0, 0.1), input=u).q)
        run = pendulum.simulate(p[0], v[0], (0, 0.1), input=odd(u), times=odd(np.array([0.05])))
        assert np.array_equal(run.q, pendulum.simulate(q[0], z[0], (0, 0.1), input=u, times=[0.05]).q)
    with pytest.raises(ValueError, match="out must be in C order, and aligned"):
        pendulum.acceleration(q, z, u, out=misaligned(q))


def test_results_are_written_where_they_are_wanted(pendulum, random):
    q, z, u = (random.standard_normal((100, 1)) for _ in range(3))
    out = np.full((100, 1), np.nan)
    assert pendulum.acceleration(q, z, u, out=out) is out
    assert np.array_equal(out, pendulum.acceleration(q, z, u))
    linear = pendulum.linearize(q, z, u)
    given = tuple(np.empty_like(array) for array in linear)
    assert pendulum.linearize(q, z, u, out=given) is given
    assert all(np.array_equal(a, b) for a, b in zip(linear, given))


def test_results_in_single_precision(pendulum, random):
    q, z, u = (random.standard_normal((700, 1)).astype(np.float32) for _ in range(3))
    exact = pendulum.acceleration(q, z, u)
    assert exact.dtype == np.float64
    out = np.full((700, 1), np.nan, dtype=np.float32)
    assert pendulum.acceleration(q, z, u, out=out) is out
    # Computed in 64 bits, and rounded once.
    assert np.array_equal(out, exact.astype(np.float32))
    # Any order and strides; an argument may be written over.
    wide = np.zeros((700, 3), dtype=np.float32)
    pendulum.acceleration(q, z, u, out=wide[:, 1:2])
    assert np.array_equal(wide[:, 1:2], out) and not wide[:, [0, 2]].any()
    assert pendulum.acceleration(q, z, u, out=z) is z and np.array_equal(z, out)
    linear = pendulum.linearize(q, z, u)
    given = tuple(np.empty(array.shape, dtype=np.float32) for array in linear)
    assert pendulum.linearize(q, z, u, out=given) is given
    assert all(np.array_equal(a, b.astype(np.float32)) for a, b in zip(given, linear))
    # Too large for 32 bits, as NumPy rounds.
    with np.errstate(over="ignore"):
        pendulum.kinetic_energy([0.0], [1e30], out=(large := np.zeros((), dtype=np.float32)))
    assert large == np.inf


def test_mistakes_in_single_precision(pendulum):
    q, z, u = np.zeros((6, 1)), np.zeros((6, 1)), np.zeros((6, 1))
    with pytest.raises(ValueError, match=r"out has shape \(5, 1\); expected \(6, 1\)"):
        pendulum.acceleration(q, z, u, out=np.zeros((5, 1), dtype=np.float32))
    frozen = np.zeros((6, 1), dtype=np.float32)
    frozen.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        pendulum.acceleration(q, z, u, out=frozen)
    single, *others = (np.zeros(array.shape, dtype=np.float32) for array in pendulum.linearize(q, z, u))
    with pytest.raises(ValueError, match="by_time has shape"):
        pendulum.linearize(q, z, u, out=(single, others[0], others[1][:2], others[2]))
    # All in one type, or none.
    with pytest.raises(TypeError, match="by_state is an array of float32; out has arrays of float64, or of float32"):
        pendulum.linearize(q, z, u, out=(single.astype(float), *others))
    with pytest.raises(ValueError, match="by_time shares memory with rate"):
        pendulum.linearize(q, z, u, out=(single, others[0], single, others[2]))


def test_mistakes_in_arrays(pendulum, torpedo):
    q, z, u = np.zeros((6, 1)), np.zeros((6, 1)), np.zeros((6, 1))
    with pytest.raises(ValueError, match=r"q has shape \(6, 2\); expected \(\.\.\., 1\)"):
        pendulum.acceleration(np.zeros((6, 2)), z, u)
    with pytest.raises(ValueError, match=r"leading axes differ: \(6,\) of q, \(5,\) of z"):
        pendulum.acceleration(q, z[:5], u)
    with pytest.raises(TypeError, match=r"acceleration needs input: motor \(input, in N m\)"):
        pendulum.acceleration(q, z)
    with pytest.raises(TypeError, match="no array of real numbers"):
        pendulum.acceleration(q * 1j, z, u)
    for out, why in [(np.zeros((5, 1)), "has shape"), (np.zeros((6, 2))[:, :1], "C order"), (q, "shares memory with q")]:
        with pytest.raises(ValueError, match=why):
            pendulum.acceleration(q, z, u, out=out)
    with pytest.raises(TypeError, match="out must be an array of float64 or float32, found one of int64"):
        pendulum.acceleration(q, z, u, out=np.zeros((6, 1), dtype=np.int64))
    frozen = np.zeros((6, 1))
    frozen.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        pendulum.acceleration(q, z, u, out=frozen)
    with pytest.raises(TypeError, match="has no frames: its struct does not say"):
        pendulum.pose("tool", q)
    with pytest.raises(TypeError, match=r"has no joints: its struct does not say `#\[gauss\(reactions"):
        pendulum.reaction("hinge", q, z, u)
    with pytest.raises(TypeError, match=r"has no multipliers: its struct does not say `#\[gauss\(constraint"):
        pendulum.multipliers(q, z, u)
    with pytest.raises(ValueError, match=r"q\[2, 1, 0:4\] is no rotation: squares of its numbers add up to 4"):
        poses = np.zeros((3, 5, 7)) + torpedo.state()[0]
        poses[2, 1, 3] = 2.0
        torpedo.acceleration(poses, np.zeros(6))


def test_what_is_no_number_stays_none(pendulum, torpedo):
    assert np.isnan(pendulum.acceleration([np.nan], [0.0], [0.0])).all()
    assert np.isnan(torpedo.energy(torpedo.state()[0], np.full(6, np.nan)))
    # But a rotation is none that is not a number, also where no result depends on it.
    turned = np.tile(torpedo.state()[0], (3, 1))
    turned[2, 1] = np.nan
    with pytest.raises(ValueError, match=r"q\[2, 0:4\] is no rotation: squares of its numbers add up to NaN"):
        torpedo.potential_energy(turned)


def test_derivatives_against_differences(pendulum, random):
    q, z, u = (random.standard_normal((50, 1)) for _ in range(3))
    linear = pendulum.linearize(q, z, u)
    step = EPS ** (1 / 3)
    by_q = (pendulum.acceleration(q + step, z, u) - pendulum.acceleration(q - step, z, u)) / (2 * step)
    # Second order in the step, and rounding over the step, of terms up to g/l.
    bound = 20 * (step**2 + EPS / step)
    assert (abs(linear.by_state[:, 1, :1] - by_q) <= bound).all()
    weights = np.array([0.0, 3.0])
    second = pendulum.hessian(q, z, weights, u)
    assert np.allclose(second.by_state[:, 0, 0], 3 * 9.81 / 0.5 * np.sin(q[:, 0]), rtol=0, atol=60 * 10 * EPS)
    inverse = pendulum.linearize_inverse(q, z, z, u)
    assert np.array_equal(inverse.force, pendulum.inverse_dynamics(q, z, z, u))


def test_frames(arm, random):
    q, z = states(arm, random, (40,))
    pose, jacobian = arm.pose("tool", q), arm.jacobian("tool", q)
    a, b = q[:, 0], q[:, 0] + q[:, 1]
    place = np.stack([0.4 * np.sin(a) + 0.3 * np.sin(b), 0 * a, 0.1 + 0.4 * np.cos(a) + 0.3 * np.cos(b)], axis=1)
    # A handful of roundings of lengths below 1.
    assert abs(pose[:, :3, 3] - place).max() <= 10 * EPS
    assert np.array_equal(pose[:, 3], np.tile([0.0, 0, 0, 1], (40, 1)))
    assert abs(pose[:, :3, :3] @ pose[:, :3, :3].transpose(0, 2, 1) - np.eye(3)).max() <= 10 * EPS
    assert abs(arm.twist("tool", q, z) - np.einsum("nij,nj->ni", jacobian, z)).max() <= 40 * EPS
    assert arm.bias("tool", q, z).shape == (40, 6) and arm.jacobian_rate("tool", q, z).shape == (40, 6, 2)
    assert arm.center_of_mass(q).shape == (40, 3) and arm.centroidal_matrix(q).shape == (40, 6, 2)
    with pytest.raises(KeyError, match="no frame hand"):
        arm.pose("hand", q)


def test_reactions(arm, random):
    q, z = states(arm, random, (40,))
    u = random.standard_normal((40, 2))
    rate = arm.acceleration(q, z, u)
    # Angles of the links from the vertical, with their rates.
    angles, omega, alpha = (np.stack([x[:, 0], x.sum(axis=1)], axis=1) for x in (q, z, rate))
    sine, cosine = np.sin(angles), np.cos(angles)

    def force(mass, upper, lower):
        """What carries a mass whose centre is so far along the links, in the observer's axes x and z."""
        along = np.array([upper, lower])
        x = (along * (alpha * cosine - omega**2 * sine)).sum(axis=1)
        up = (along * (-alpha * sine - omega**2 * cosine)).sum(axis=1)
        return mass * np.stack([x, up + 9.81], axis=1)

    lower = force(1.0, 0.4, 0.15)
    for k, (joint, expected) in enumerate([("shoulder", force(2.0, 0.2, 0.0) + lower), ("elbow", lower)]):
        found = arm.reaction(joint, q, z, u)
        # In axes of the link that the joint carries.
        c, s = cosine[:, k], sine[:, k]
        seen = np.stack([c * found[:, 0] + s * found[:, 2], c * found[:, 2] - s * found[:, 0]], axis=1)
        # Dozens of roundings of accelerations times lengths and masses below 3, and of the weight.
        bound = 100 * EPS * 3 * (9.81 + abs(rate).max() + (omega**2).max())
        assert abs(seen - expected).max() <= bound
        # About the hinge the motor, and nothing beside the plane.
        assert abs(found[:, 4] - u[:, k]).max() <= bound and abs(found[:, [1, 3, 5]]).max() <= bound
    with pytest.raises(KeyError, match=r"no joint wrist; those of `reactions\(…\)`: shoulder, elbow"):
        arm.reaction("wrist", q, z, u)


def test_constraints(wire):
    q, z = wire.state(x=1.5, y_dot=2.0)
    (force,) = wire.multipliers(q, z)
    # m v²/r along 2 r of the gradient.
    assert abs(abs(force) - 2.0 * 2.0**2 / 1.5 / 3.0) <= 20 * EPS
    assert abs(wire.acceleration(q, z)[wire.speed_names.index("x_dot")] + 2.0**2 / 1.5) <= 20 * EPS


def test_configurations_move(torpedo, random):
    q, _ = states(torpedo, random, (30,))
    increment = 0.3 * random.standard_normal((30, 6))
    moved = torpedo.retract(q, increment)
    assert abs(torpedo.difference(q, moved) - increment).max() <= 100 * EPS


def test_threads_share_a_kernel(torpedo, random):
    q, z = states(torpedo, random, (5000,))
    expected = torpedo.acceleration(q, z)
    results = [None] * 4

    def work(k):
        results[k] = torpedo.acceleration(q, z)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(result, expected) for result in results)


def test_rows_have_parameters_of_their_own(pendulum, random):
    q, z, u = random.normal(size=(3, 700, 1))
    lengths = np.linspace(0.2, 1.1, 700)
    kernels = [scenes.Pendulum(mass=2.0, length=length, g=9.81) for length in lengths]
    alone = np.array([kernel.acceleration(*row) for kernel, *row in zip(kernels, q, z, u)])
    found = pendulum.acceleration(q, z, u, length=lengths)
    # A pendulum has the bits that it has alone, in any batch, and another way are those of the formula.
    assert np.array_equal(found, alone)
    exact = (u - 2.0 * 9.81 * lengths[:, None] * np.sin(q)) / (2.0 * lengths[:, None] ** 2)
    np.testing.assert_allclose(found, exact, rtol=0, atol=20 * EPS * np.abs(exact).max())
    # Into arrays of one's own, of any type that takes results, and in any shape of the batch.
    out = np.empty_like(q)
    assert pendulum.acceleration(q, z, u, length=lengths, out=out) is out and np.array_equal(out, alone)
    single = np.empty((700, 1), dtype=np.float32)
    pendulum.acceleration(q, z, u, length=lengths, out=single)
    assert np.array_equal(single, alone.astype(np.float32))
    shaped = [own.reshape(7, 100, 1) for own in (q, z, u)]
    assert np.array_equal(pendulum.acceleration(*shaped, length=lengths.reshape(7, 100)), alone.reshape(7, 100, 1))
    # One state for all, and parameters of which one is for all.
    several = pendulum.linearize([0.3], [0.2], [0.1], length=lengths[:5], mass=3.0)
    ones = [scenes.Pendulum(mass=3.0, length=own, g=9.81).linearize([0.3], [0.2], [0.1]) for own in lengths[:5]]
    assert all(np.array_equal(part, np.stack(own)) for part, own in zip(several, zip(*ones)))
    other = scenes.Pendulum(mass=2.0, length=0.7, g=9.81)
    assert np.array_equal(pendulum.acceleration(q, z, u, length=0.7), other.acceleration(q, z, u))
    assert pendulum.energy([0.1], [0.2], length=[]).shape == (0,)


def test_parameters_of_rows_are_arrays_of_any_shape(torpedo):
    added = np.linspace(1, 2, 5)[:, None] * np.array([0.9, 35, 35, 0.07, 4.9, 4.9])
    state = torpedo.state(), np.zeros(6)
    own = dict(torpedo.parameters)
    expected = [scenes.Torpedo(**own | {"added": row}).mass_matrix(state[0][0]) for row in added]
    assert np.array_equal(torpedo.mass_matrix(state[0][0], added=added), expected)
    # Times and frames go with them.
    arm = scenes.Arm(g=9.81)
    assert np.array_equal(arm.pose("tool", [0.1, 0.2], g=[1.0, 2.0]), [arm.pose("tool", [0.1, 0.2])] * 2)


def test_mistakes_in_parameters_of_rows(pendulum, torpedo, wire):
    q, z, u = np.zeros((6, 1)), np.zeros((6, 1)), np.zeros((6, 1))
    with pytest.raises(TypeError, match=r"acceleration has no argument force, and Pendulum no parameter .* mass, length, g"):
        pendulum.acceleration(q, z, u, force=1.0)
    with pytest.raises(ValueError, match=r"leading axes differ: \(6,\) of q, \(5,\) of length"):
        pendulum.acceleration(q, z, u, length=np.ones(5))
    with pytest.raises(ValueError, match=r"added has shape \(6, 5\); expected \(\.\.\., 6\)"):
        torpedo.mass_matrix(torpedo.state()[0], added=np.ones((6, 5)))
    with pytest.raises(TypeError, match="length is no array of real numbers"):
        pendulum.acceleration(q, z, u, length="long")
    # Bodies are those of a kernel.
    with pytest.raises(TypeError, match="no parameter of that name that rows may have for themselves: there are radius, g"):
        wire.mass_matrix(wire.state()[0], block={"mass": 1.0, "inertia": [1, 1, 1]})
    # The first row that no body can have, with its place; rows on several threads too.
    lengths = np.full((20, 50), 0.5)
    lengths[3, 7], lengths[9, 1] = -1.0, np.nan
    batch = np.zeros((20, 50, 1))
    masses = np.where(lengths > 0, 2.0, lengths)
    with pytest.raises(scenes.ParameterError, match=r"mass.*, in row \[3, 7\]") as raised:
        pendulum.acceleration(batch, batch, batch, mass=masses)
    assert [field for field, _ in raised.value.fields] == ["mass"] and raised.value.violations[0][1] == -1.0
    with pytest.raises(scenes.ParameterError) as raised:
        pendulum.acceleration(q, z, u, mass=-1.0)
    assert "row" not in str(raised.value)
