"""The functions of JAX: against those of arrays, and their derivatives against differences."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
import scenes

from test_batches import EPS, states

jax = pytest.importorskip("jax", reason="NOT TESTED: jax is not installed")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

# Of central differences: second order in the step, and rounding over the step.
STEP = EPS ** (1 / 3)
ERROR = STEP**2 + EPS / STEP


@pytest.mark.parametrize("name", ["pendulum", "torpedo", "arm", "wire"])
def test_functions_have_the_bits_of_methods(name, request, random):
    kernel = request.getfixturevalue(name)
    functions = scenes.jax(kernel)
    q, z = states(kernel, random, (3, 400))
    u = random.standard_normal((3, 400, len(kernel.input_names)))
    inputs = [u] if kernel.input_names else []
    for method, arguments in [
        ("acceleration", (q, z, *inputs)),
        ("mass_matrix", (q,)),
        ("energy", (q, z)),
        ("inverse_dynamics", (q, z, np.flip(z), *inputs)),
        ("retract", (q, 0.1 * z)),
    ]:
        found = getattr(functions, method)(*arguments, t=0.5)
        expected = getattr(kernel, method)(*arguments, t=0.5)
        assert found.dtype == jnp.float64 and np.array_equal(found, expected)


def test_results_with_names_and_frames(pendulum, arm, random):
    q, z = states(pendulum, random, (20,))
    found, expected = scenes.jax(pendulum).linearize(q, z, [0.3]), pendulum.linearize(q, z, [0.3])
    assert found._fields == expected._fields
    assert all(np.array_equal(a, b) for a, b in zip(found, expected))
    # One class for both, which pickles find in the package.
    again = pickle.loads(pickle.dumps(found))
    assert type(again) is type(found) is type(expected)
    assert all(np.array_equal(a, b) for a, b in zip(again, expected))
    q, z = states(arm, random, (20,))
    functions = scenes.jax(arm)
    assert np.array_equal(functions.pose("tool", q), arm.pose("tool", q))
    assert np.array_equal(functions.jacobian("tool", q=q), arm.jacobian("tool", q))
    assert np.array_equal(functions.reaction("elbow", q, z, [1.0, 2.0]), arm.reaction("elbow", q, z, [1.0, 2.0]))


def test_jit_and_vmap_are_batches(torpedo, random):
    functions = scenes.jax(torpedo)
    q, z = states(torpedo, random, (6, 50))
    expected = torpedo.acceleration(q, z)
    twice = jax.jit(jax.vmap(jax.vmap(functions.acceleration)))
    assert np.array_equal(twice(q, z), expected)
    # One configuration for all.
    one = jax.vmap(functions.acceleration, in_axes=(None, 0))(q[0, 0], z[0])
    assert np.array_equal(one, torpedo.acceleration(q[0, 0], z[0]))
    # A batch is one call, and no loop: as many as the text of the program has.
    assert jax.jit(jax.vmap(functions.acceleration)).lower(q, z).as_text().count("custom_call @gauss_") == 1


def test_derivatives_of_accelerations(pendulum, random):
    function = scenes.jax(pendulum).acceleration
    q, z, u = (random.standard_normal((30, 1)) for _ in range(3))
    whole = jax.vmap(jax.jacfwd(function, argnums=(0, 1, 2)))(q, z, u)
    linear = pendulum.linearize(q, z, u)
    expected = linear.by_state[:, 1:, :1], linear.by_state[:, 1:, 1:], linear.by_input[:, 1:]
    assert all(np.array_equal(a, b) for a, b in zip(whole, expected))
    back = jax.vmap(jax.grad(lambda q, z, u: function(q, z, u)[0], argnums=(0, 1, 2)))(q, z, u)
    assert all(np.array_equal(a, b[:, 0]) for a, b in zip(back, expected))


def along(function, point, direction):
    """The derivative along a direction, by differences."""
    ahead, behind = ([x + s * STEP * d for x, d in zip(point, direction)] for s in (1, -1))
    return (function(*ahead) - function(*behind)) / (2 * STEP)


def unit(q):
    """Rotations of norm 1."""
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def test_derivatives_by_rotations(torpedo, random):
    function = scenes.jax(torpedo).acceleration
    q, z = states(torpedo, random, (30,))
    dq, dz = random.standard_normal(q.shape), random.standard_normal(z.shape)
    primal, tangent = jax.jvp(function, (jnp.array(q), jnp.array(z)), (jnp.array(dq), jnp.array(dz)))
    # What leads off the rotations is no change of a configuration.
    by_numbers = lambda q, z: torpedo.acceleration(np.concatenate([unit(q[:, :4]), q[:, 4:]], axis=1), z)
    expected = along(by_numbers, (q, z), (dq, dz))
    # Third derivatives of terms up to some hundreds.
    size = 1000 * (1 + abs(expected).max())
    assert abs(primal - torpedo.acceleration(q, z)).max() <= 100 * EPS * abs(primal).max()
    assert abs(tangent - expected).max() <= size * ERROR
    # Backwards: the same numbers.
    weights = random.standard_normal(primal.shape)
    back = jax.grad(lambda q, z: (weights * function(q, z)).sum(), argnums=(0, 1))(jnp.array(q), jnp.array(z))
    total = sum((part * change).sum() for part, change in zip(back, (dq, dz)))
    assert abs(total - (weights * tangent).sum()) <= 1e4 * EPS * abs(weights * tangent).sum()


def test_derivatives_of_inverse_dynamics_and_rates(pendulum, random):
    functions = scenes.jax(pendulum)
    point = [random.standard_normal((30, 1)) for _ in range(4)]
    direction = [random.standard_normal((30, 1)) for _ in range(4)]
    q, z, a, u = point
    for name, arguments in [("inverse_dynamics", 4), ("rates", 3)]:
        given = point if arguments == 4 else [q, z, u]
        to = direction if arguments == 4 else direction[:3]
        _, tangent = jax.jvp(getattr(functions, name), tuple(map(jnp.array, given)), tuple(map(jnp.array, to)))
        expected = along(getattr(pendulum, name), given, to)
        assert abs(tangent - expected).max() <= 200 * (1 + abs(expected).max()) * ERROR


def test_a_gradient_through_a_run(pendulum):
    """The sensitivity of a swing to its length of time and motor, by steps that JAX makes."""
    rates = scenes.jax(pendulum).rates

    @jax.jit
    def end(u):
        def step(y, _):
            f = lambda y: rates(y[:1], y[1:], u)
            a = f(y)
            b = f(y + 0.005 * a)
            return y + 0.01 * b, None

        y, _ = jax.lax.scan(step, jnp.array([1.0, 0.0]), None, length=50)
        return y[0]

    u = jnp.array([0.3])
    expected = (end(u + STEP) - end(u - STEP)) / (2 * STEP)
    assert abs(jax.grad(end)(u)[0] - expected) <= 10 * ERROR


def test_single_precision(pendulum, torpedo):
    functions = scenes.jax(pendulum)
    q, z, u = (jnp.array([value], dtype=jnp.float32) for value in (0.1, 0.2, 0.3))
    found = functions.acceleration(q, z, u, t=jnp.float32(0))
    assert found.dtype == jnp.float32
    # Computed in 64 bits, and rounded once.
    exact = pendulum.acceleration(*(np.asarray(array, dtype=float) for array in (q, z, u)))
    assert np.array_equal(found, exact.astype(np.float32))
    jax.config.update("jax_enable_x64", False)
    try:
        assert functions.acceleration([0.1], [0.2], [0.3]).dtype == jnp.float32
        with pytest.raises(TypeError, match="rotations need float64"):
            scenes.jax(torpedo).acceleration(*torpedo.state())
    finally:
        jax.config.update("jax_enable_x64", True)


def test_mistakes(pendulum, torpedo, arm):
    functions = scenes.jax(pendulum)
    with pytest.raises(ValueError, match=r"q has shape \(2,\); expected \(\.\.\., 1\)"):
        functions.acceleration([0.0, 0.0], [0.0], [0.0])
    with pytest.raises(TypeError, match="acceleration needs input"):
        functions.acceleration([0.0], [0.0])
    with pytest.raises(TypeError, match="no further argument force"):
        functions.acceleration([0.0], [0.0], force=[0.0])
    with pytest.raises(TypeError, match="acceleration has 3 arrays: q, z, input"):
        functions.acceleration([0.0], [0.0], [0.0], [0.0])
    with pytest.raises(TypeError, match="real numbers"):
        functions.acceleration([0.0j], [0.0], [0.0])
    with pytest.raises(AttributeError):
        functions.multipliers
    with pytest.raises(KeyError, match="pose is of tool"):
        scenes.jax(arm).pose("hand", [0.0, 0.0])
    with pytest.raises(Exception, match="row 1 of q is no rotation: squares of its numbers add up to 4"):
        q, z = torpedo.state()
        scenes.jax(torpedo).acceleration(np.stack([q, 2 * q]), z)
    with pytest.raises(TypeError, match=r"energy has no derivatives in JAX here; .* acceleration \(clause linearize\)"):
        jax.grad(lambda q: functions.energy(q, [0.0]))(jnp.zeros(1))
    # An arm without the clause.
    with pytest.raises(TypeError, match="acceleration has no derivatives"):
        jax.jacfwd(lambda q: scenes.jax(arm).acceleration(q, [0.0, 0.0], [0.0, 0.0]))(jnp.zeros(2))
    for given in [(), (pendulum, 1)]:
        with pytest.raises(TypeError, match="takes a kernel, and nothing else"):
            scenes.jax(*given)
    with pytest.raises(TypeError, match="those of a kernel"):
        scenes.jax(3)


def test_what_is_no_number_stays_none(pendulum):
    assert jnp.isnan(scenes.jax(pendulum).acceleration([np.nan], [0.0], [0.0])).all()


def test_kernels_work_without_jax():
    program = """
import sys
import scenes
assert "jax" not in sys.modules
sys.modules["jax"] = None
try:
    scenes.jax(scenes.Arm(g=9.81))
except ImportError as error:
    assert "pip install jax" in str(error)
else:
    raise AssertionError
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_parameters_of_rows(pendulum, torpedo, random):
    functions = scenes.jax(pendulum)
    q, z = states(pendulum, random, (40,))
    lengths = np.linspace(0.3, 0.8, 40)
    expected = pendulum.acceleration(q, z, [0.3], length=lengths, mass=1.5)
    assert np.array_equal(functions.acceleration(q, z, [0.3], length=lengths, mass=1.5), expected)
    batched = jax.jit(jax.vmap(lambda q, z, length: functions.acceleration(q, z, jnp.array([0.3]), length=length, mass=1.5)))
    assert np.array_equal(batched(q, z, lengths), expected)
    # Vectors have their own axes behind those of the batch.
    added = np.linspace(1, 2, 5)[:, None] * np.array([0.9, 35, 35, 0.07, 4.9, 4.9])
    rest = torpedo.state()[0]
    assert np.array_equal(scenes.jax(torpedo).mass_matrix(rest, added=added), torpedo.mass_matrix(rest, added=added))


def test_gradients_by_parameters(pendulum, torpedo, random):
    functions = scenes.jax(pendulum)

    def acceleration(length, g):
        return functions.acceleration(jnp.array([0.7]), jnp.array([0.2]), jnp.array([0.3]), length=length, g=g)[0]

    # u / (m l²) − g sin(angle) / l.
    by_length, by_g = jax.grad(acceleration, (0, 1))(0.4, 9.0)
    assert abs(by_length - (-2 * 0.3 / (2.0 * 0.4**3) + 9.0 * np.sin(0.7) / 0.4**2)) < 200 * EPS
    assert abs(by_g + np.sin(0.7) / 0.4) < 10 * EPS
    # What reaches a parameter by the state as well.
    whole = jax.jit(jax.grad(lambda length: functions.rates(length[None], 0.1 * length[None], [0.0], length=length)[1]))
    assert abs(whole(0.4) - (-9.81 * np.cos(0.4) / 0.4 + 9.81 * np.sin(0.4) / 0.4**2)) < 200 * EPS
    # By vectors, at a pose, beside differences: in any direction, and the matrix that they are taken from.
    functions = scenes.jax(torpedo)
    q, z = states(torpedo, random, ())
    added = jnp.array([0.9, 35, 35, 0.07, 4.9, 4.9])
    matrix = jax.jacobian(lambda added, lift: functions.acceleration(q, z, added=added, lift=lift), (0, 1))(added, 60.0)
    names = torpedo.parameter_names
    by_parameters = torpedo.by_parameters(q, z)[6:]
    columns = [names.index(f"added[{k}]") for k in range(6)]
    assert np.array_equal(matrix[0], by_parameters[:, columns])
    assert np.array_equal(matrix[1], by_parameters[:, names.index("lift")])
    for k in range(6):
        step = np.zeros(6)
        step[k] = STEP * added[k]
        ends = [torpedo.acceleration(q, z, added=added + sign * step) for sign in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * step[k])
        # Of accelerations of order ten, over steps of a parameter of its own size.
        assert abs(matrix[0][:, k] - difference).max() < 1e3 * ERROR * (1 + abs(ends[0]).max()) / added[k]


def test_mistakes_with_parameters_of_rows(pendulum):
    functions = scenes.jax(pendulum)
    q, z, u = jnp.zeros(1), jnp.zeros(1), jnp.zeros(1)
    with pytest.raises(ValueError, match=r"length has shape \(2, 1\)|shape"):
        functions.acceleration(jnp.zeros((3, 1)), jnp.zeros((3, 1)), u, length=jnp.ones(2))
    with pytest.raises(Exception, match="parameters of row 1 are of no body: .*mass"):
        functions.acceleration(q, z, u, mass=jnp.array([1.0, -1.0]))
    with pytest.raises(TypeError, match="inverse_dynamics has no derivatives by parameters; acceleration has them"):
        jax.grad(lambda mass: functions.inverse_dynamics(q, z, q, u, mass=mass)[0])(1.0)
    with pytest.raises(TypeError, match=r"derivatives by parameters need the clause linearize\(parameters\)"):
        cart = scenes.jax(scenes.Cart(mass=3.0, lag=0.5))
        jax.grad(lambda mass: cart.acceleration(jnp.ones(2), jnp.zeros(1), jnp.zeros(1), mass=mass)[0])(3.0)
