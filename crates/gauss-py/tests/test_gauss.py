"""Scenes and robots that are derived while the test runs: values, batches, mistakes, pickles, processes."""

import gc
import os
import pickle
import subprocess
import sys
from pathlib import Path

import gauss
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
ARM = ROOT / "examples/python/arm.urdf"
CLAUSES = ["linearize(inverse, hessian)", "frames(tool)", "methods(centroidal, nonlinear_effects, gravity_torques)"]
SCENE = "coordinates(angle),\nparticle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)])"
FREE = """#[gauss(chart = hybrid, linearize)]
struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64>, #[gauss(gravity)] g: f64 }"""
EPS = np.finfo(float).eps


@pytest.fixture(scope="module")
def model():
    return gauss.scene(SCENE, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity", doc="Of free fall."))


@pytest.fixture(scope="module")
def pendulum(model):
    return model(m=2, l=0.5, g=9.81)


@pytest.fixture(scope="module")
def arm():
    return gauss.load(ARM, CLAUSES, gravity=9.81)


def test_pendulum_in_closed_form(model, pendulum):
    q, z = np.linspace(-3, 3, 101)[:, None], np.full((101, 1), 1.5)
    # A handful of roundings each, of terms of this size.
    near = dict(rtol=8 * EPS, atol=8 * EPS * 20)
    np.testing.assert_allclose(pendulum.acceleration(q, z), -9.81 / 0.5 * np.sin(q), **near)
    np.testing.assert_allclose(pendulum.mass_matrix(q), np.full((101, 1, 1), 0.5), **near)
    np.testing.assert_allclose(pendulum.kinetic_energy(q, z), np.full(101, 0.5 * 0.5 * 1.5**2), **near)
    np.testing.assert_allclose(pendulum.potential_energy(q), -2 * 9.81 * 0.5 * np.cos(q[:, 0]), **near)
    np.testing.assert_allclose(pendulum.inverse_dynamics(q, z, 0 * q), 2 * 9.81 * 0.5 * np.sin(q), **near)
    assert pendulum.kinetic_energy([1], [1]).shape == () and pendulum.mass_matrix([1]).shape == (1, 1)
    assert model.parameters == {"m": (1, "kg", ""), "l": (1, "m", ""), "g": (1, "m/s^2", "Of free fall.")}
    assert pendulum.parameters == {"m": 2.0, "l": 0.5, "g": 9.81} and pendulum.coordinate_names == ["angle"]
    assert "sin(angle)" in model.equations and model._repr_latex_().startswith("$$\n\\begin{align")
    assert model.operations["acceleration"]["transcendentals"] >= 1 and model.accuracy["acceleration"][0] < 10


def test_arm_is_that_of_two_rods(arm):
    """An independent formula: moments about the joints, with the terms of Coriolis by hand."""
    random = np.random.default_rng(3)
    q, z, tau = random.uniform(-2, 2, (3, 50, 2))
    alpha = 0.01 + 1.0 * 0.15**2
    coupled = 1.0 * 0.4 * 0.15 * np.cos(q[:, 1])
    mass = np.empty((50, 2, 2))
    mass[:, 0, 0] = 0.03 + 2 * 0.2**2 + 0.4**2 + alpha + 2 * coupled
    mass[:, 0, 1] = mass[:, 1, 0] = alpha + coupled
    mass[:, 1, 1] = alpha
    h = 0.4 * 0.15 * np.sin(q[:, 1])
    coriolis = np.stack([-h * (2 * z[:, 0] + z[:, 1]) * z[:, 1], h * z[:, 0] ** 2], -1)
    lower = 9.81 * 0.15 * np.sin(q.sum(1))
    gravity = np.stack([9.81 * (2 * 0.2 + 0.4) * np.sin(q[:, 0]) + lower, lower], -1)
    expected = np.linalg.solve(mass, (tau - coriolis + gravity)[..., None])[..., 0]
    # The condition of the mass matrix is below 100, and its terms round a few dozen times.
    np.testing.assert_allclose(arm.acceleration(q, z, tau), expected, rtol=0, atol=EPS * 100 * 50 * 20)
    np.testing.assert_allclose(arm.mass_matrix(q), mass, rtol=0, atol=50 * EPS)
    held = arm.inverse_dynamics(q, z, arm.acceleration(q, z, tau), tau)
    np.testing.assert_allclose(held, 0 * q, atol=EPS * 100 * 50 * 20)
    pose = arm.pose("tool", [0.3, 0.2])
    expected = [0.4 * np.sin(0.3) + 0.3 * np.sin(0.5), 0, 0.1 + 0.4 * np.cos(0.3) + 0.3 * np.cos(0.5)]
    np.testing.assert_allclose(pose[:3, 3], expected, atol=8 * EPS)
    turned = [[np.cos(0.5), 0, np.sin(0.5)], [0, 1, 0], [-np.sin(0.5), 0, np.cos(0.5)]]
    np.testing.assert_allclose(pose[:3, :3], turned, atol=8 * EPS)
    with pytest.raises(KeyError, match="has no frame hand; those of `frames"):
        arm.pose("hand", q)
    assert arm.pose("tool", q).shape == (50, 4, 4) and arm.twist("tool", q, z).shape == (50, 6)
    assert arm.jacobian("tool", q).shape == (50, 6, 2) and arm.input_names == ["shoulder", "elbow"]


def test_derivatives_are_those_of_differences(arm):
    q, z, tau = np.array([0.3, -0.8]), np.array([0.5, 1.0]), np.array([1.0, 2.0])
    linear, h = arm.linearize(q, z, tau), 1e-5
    step = np.eye(2) * h
    by_q = (arm.acceleration(q + step, z, tau) - arm.acceleration(q - step, z, tau)).T / (2 * h)
    by_z = (arm.acceleration(q, z + step, tau) - arm.acceleration(q, z - step, tau)).T / (2 * h)
    # Central differences: h² by third derivatives of some thousands, and rounding by 1/h.
    np.testing.assert_allclose(linear.by_state[2:], np.hstack([by_q, by_z]), atol=h**2 * 5e3 + 1e4 * EPS / h)
    assert linear.rate.shape == (4,) and linear.by_input.shape == (4, 2)


def test_batches_are_their_rows_to_the_bit(arm):
    random = np.random.default_rng(5)
    count = 7
    for method in arm.methods:
        plan = arm._plan(method)
        rows = {name: random.uniform(-1, 1, (count, size)) for name, size in plan.sizes.items()}
        t = random.uniform(0, 1, count)
        as_tuple = lambda found: found if isinstance(found, tuple) else (found,)
        expected = [as_tuple(arm.call(method, t=t[k], **{n: a[k] for n, a in rows.items()})) for k in range(count)]
        awkward = {name: twisted(array) for name, array in rows.items()}
        for given in (rows, awkward):
            for threads in (1, 3):
                found = as_tuple(arm.call(method, t=t, threads=threads, **given))
                for place, array in enumerate(found):
                    assert array.dtype == np.float64 and array.flags.c_contiguous
                    assert array.tobytes() == np.stack([own[place] for own in expected]).tobytes(), method
    q = random.uniform(-1, 1, (2, 3, 2))
    assert arm.acceleration(q, [0, 0], [1, 2]).shape == (2, 3, 2)
    assert arm.acceleration(np.zeros((0, 2)), [0, 0], [1, 2]).shape == (0, 2)
    assert "shoulder: coordinate" in arm.__doc__ and "reactions_at" not in dir(arm)
    # A program that is no method of the class, beside a method that is.
    assert len(dir(arm)) == len(set(dir(arm)))
    assert "evaluate" in dir(arm) and "q (..., 2): shoulder, elbow" in arm.evaluate.__doc__
    both = arm.evaluate(q, [0, 0], [1, 2])
    assert both[1].tobytes() == arm.acceleration(q, [0, 0], [1, 2]).tobytes()


def same(found, expected):
    """The same bits, but for the sign and the digits of what is no number."""
    found, expected = (np.where(np.isnan(array), np.nan, array) for array in (found, expected))
    return found.tobytes() == expected.tobytes()


@pytest.mark.parametrize("count", [1, 3, 8, 9, 64, 77, 700])
def test_rows_in_lanes_have_the_bits_of_rows_alone(model, arm, count):
    """Whole vectors, what is left behind them, rows that vectors leave out: angles at quarter turns, large, no numbers."""
    random = np.random.default_rng(count)
    for kernel in (model(m=2, l=0.5, g=9.81), arm):
        size = len(kernel.coordinate_names)
        q, z = random.uniform(-4, 4, (2, count, size))
        special = [np.pi / 2, -1.5 * np.pi, 2e5, np.nan, np.inf, -0.0]
        rows = range(1, min(count, 2 * len(special)), 2)
        for row, value in zip(rows, special):
            q[row, row % size] = value
        for name, given in (
            ("acceleration", (q, z)), ("rates", (q, z)), ("energy", (q, z)), ("mass_matrix", (q,)),
            ("inverse_dynamics", (q, z, z)), ("retract", (q, z)), ("difference", (q, z)), ("nonlinear_effects", (q, z)),
            *([("center_jacobian", (q,)), ("linearize", (q, z))] if kernel is arm else []),
        ):
            input = {"input": [0.25] * len(kernel.input_names)} if name in INPUTS and kernel.input_names else {}
            method = getattr(kernel, name)
            found, alone = method(*given, **input), [method(*(own[k] for own in given), **input) for k in range(count)]
            parts = (found, np.stack(alone)) if isinstance(found, np.ndarray) else None
            for found, expected in [parts] if parts else zip(found, map(np.stack, zip(*alone))):
                assert same(found, expected), (name, count)
        # One configuration for all rows, and results over the speeds.
        expected = np.stack([kernel.kinetic_energy(q[0], own) for own in z])
        assert same(kernel.kinetic_energy(q[0], z), expected)


INPUTS = ["acceleration", "rates", "inverse_dynamics", "nonlinear_effects", "linearize"]


def twisted(array):
    """The same numbers in memory that is neither in order nor aligned."""
    memory = np.zeros(array.size * 2 * 8 + 1, np.uint8)[1:]
    other = memory.view(np.float64).reshape(array.shape[::-1] + (2,))[..., 0].T
    other[...] = array
    return other


def test_brackets_and_functions_of_python():
    point = "coordinates(x), particle(mass = m, position = %s)"
    for clauses, mistakes in [
        (point % "[x, 0, 0", [(1, 47, "nothing closes this `[` before the next `)`")]),
        ((point % "[x, 0, 0]")[:-1], [(1, 25, "nothing closes this `(`")]),
        (point % "[x, 0, 0])", [(1, 57, "this `)` closes nothing")]),
        (point % "[np.sin(x), 0, 0]", [(1, 51, "`sin` takes one argument, found 2 (`np` before the dot is one); write `sin(x)`")]),
    ]:
        with pytest.raises(gauss.SceneError) as caught:
            gauss.scene(clauses, m="kg")
        assert caught.value.mistakes == mistakes, caught.value.mistakes


def test_mistakes_come_all_at_once():
    with pytest.raises(gauss.SceneError) as caught:
        gauss.scene("coordinates(x),\n particle(mass = m, position = [x, 0, y]),\n spring(along = x)", m="kg")
    assert [(line, column) for line, column, _ in caught.value.mistakes] == [(2, 39), (3, 2)]
    assert "unknown name `y`" in str(caught.value) and caught.value.source.startswith("coordinates(x),\n")
    with pytest.raises(gauss.SceneError, match="unknown clause `nonsense`") as caught:
        gauss.load(ARM, ["nonsense"], gravity=9.81)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.mistakes == caught.value.mistakes and str(again) == str(caught.value)
    with pytest.raises(TypeError, match="says nothing of gravity"):
        gauss.load(ARM)
    with pytest.raises(FileNotFoundError):
        gauss.load("no.urdf", gravity=9.81)
    with pytest.raises(ValueError, match="expected a finite number"):
        gauss.load(ARM, gravity=np.nan)


def test_parameters_that_no_body_has(model):
    with pytest.raises(gauss.ParameterError) as caught:
        model(m=-1, l=np.inf, g=9.81)
    assert {own[:3] for own in caught.value.violations} == {("m", -1.0, "PositiveMass"), ("l", np.inf, "Finite")}
    assert {name for name, _ in caught.value.fields} == {"m", "l"}
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.violations == caught.value.violations and str(again) == str(caught.value)
    with pytest.raises(gauss.ParameterError, match="(?s)g is missing .m/s.2.: Of free fall.*k is no parameter"):
        model(m=1, l=1, k=2)
    with pytest.raises(gauss.ParameterError, match=r"m has shape \(2,\); expected one number"):
        model(m=[1, 2], l=1, g=1)


def test_arguments_of_other_shapes(pendulum, arm):
    for arguments, message in [
        (([1, 2], [0]), r"q has shape \(2,\); expected \(..., 1\)"),
        ((1.0, [0]), r"q has shape \(\); expected \(..., 1\)"),
        ((np.zeros((2, 1)), np.zeros((3, 1))), r"leading axes differ: \(2,\) of q, \(3,\) of z"),
    ]:
        with pytest.raises(ValueError, match=message):
            pendulum.acceleration(*arguments)
    with pytest.raises(TypeError, match="needs input: shoulder .input, in N m., elbow"):
        arm.acceleration([0, 0], [0, 0])
    for value in ("a", [1j], [None]):
        with pytest.raises(TypeError, match="q is no array of real numbers"):
            pendulum.acceleration(value, [0])
    masked = np.ma.array([[1.0], [2.0]], mask=[[False], [True]])
    for call in (pendulum.acceleration, pendulum.momentum, lambda q, *_: pendulum.simulate(q[1], [0], (0, 1))):
        with pytest.raises(TypeError, match="q has masked entries, and every number counts"):
            call(masked, np.zeros((2, 1)))
    assert (pendulum.acceleration(masked[:1], [[0]]) == pendulum.acceleration([[1.0]], [[0]])).all()
    with pytest.raises(AttributeError, match="no `regressor`"):
        pendulum.regressor
    with pytest.raises(TypeError, match="no frames: its struct does not say"):
        pendulum.pose("bob", [0])
    with pytest.raises(TypeError, match="acceleration has no argument u, and Robot no parameter of that name"):
        arm.acceleration([0, 0], [0, 0], u=[0, 0])
    # As of compiled classes.
    assert np.isnan(pendulum.acceleration([np.nan], [0])).all() and np.isnan(pendulum.acceleration([np.inf], [0])).all()


def test_rotations_that_are_none():
    body = gauss.scene(FREE)(m=2, i=[0.1, 0.2, 0.3], g=9.81)
    assert body.coordinate_names[:4] == ["pose_i", "pose_j", "pose_k", "pose_w"]
    falling = body.acceleration([0, 0, 0, 1, 5, 6, 7], np.zeros(6))
    np.testing.assert_allclose(falling, [0, 0, -9.81, 0, 0, 0], atol=4 * EPS * 9.81)
    states = np.tile([0, 0, 0, 1.0, 0, 0, 0], (3, 1))
    for wrong in (2.0, np.nan):
        states[1, 3] = wrong
        with pytest.raises(ValueError, match=r"q\[1, 0:4\] is no rotation"):
            body.acceleration(states, np.zeros(6))


def test_forces_of_contacts_are_not_forgotten():
    ball = gauss.scene(
        "coordinates(x, y), particle(mass = m, position = [x, 0, y]), gravity = 9.81, contact(ground, gap = y)", m="kg"
    )(m=1)
    with pytest.raises(gauss.ContactError, match="without_contacts"):
        ball.acceleration([0, 0], [0, 0])
    free = pickle.loads(pickle.dumps(ball.without_contacts()))
    np.testing.assert_allclose(free.acceleration([0, 0], [0, 0]), [0, -9.81], atol=4 * EPS * 9.81)
    assert ball.gaps([0, 3]) == [3] and free != ball
    with pytest.raises(gauss.ContactError):
        pickle.loads(pickle.dumps(ball)).acceleration([0, 0], [0, 0])


@pytest.mark.parametrize("clause", ["range(x, from = 0, to = 1)", "dry_friction(x, bound = 2)"])
def test_ranges_and_dry_joints_are_contacts(clause):
    scene = gauss.scene(f"coordinates(x), particle(mass = m, position = [x, 0, 0]), {clause}", m="kg")
    with pytest.raises(gauss.ContactError):
        scene(m=1).acceleration([0], [0])
    assert scene(m=1).without_contacts().acceleration([0], [0]) == [0] and scene(m=1).mass_matrix([0]) == [[1]]


def test_bodies_are_mappings():
    text = "coordinates(angle), gravity = 9.81, body(rod, position = [0, 0, 0], rotation = rotation_y(angle))"
    model = gauss.scene(text, rod=gauss.Field(type="RigidBody<f64>", role="body"))
    assert list(model.parameters) == ["rod.mass", "rod.center_of_mass", "rod.inertia"]
    rod = model(rod={"mass": 2, "center_of_mass": [0, 0, -0.5], "inertia": [0.6, 0.7, 0.2]})
    np.testing.assert_allclose(rod.mass_matrix([0.3]), [[0.7]], rtol=4 * EPS)
    np.testing.assert_allclose(rod.acceleration([0.3], [0]), [-2 * 9.81 * 0.5 * np.sin(0.3) / 0.7], rtol=16 * EPS)
    full = model(rod={"mass": 2, "center_of_mass": [0, 0, -0.5], "inertia": np.diag([0.6, 0.7, 0.2])})
    assert full == rod == pickle.loads(pickle.dumps(rod)) and model(rod={"mass": 2, "inertia": [1, 1, 1]}) != rod


def test_scenes_may_read_files(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_bytes(ARM.read_bytes())
    model = gauss.scene(f'#[gauss(urdf = "{file}")] struct Arm {{ #[gauss(gravity)] g: f64 }}')
    kernel = pickle.loads(pickle.dumps(model))(g=9.81)
    assert (kernel.acceleration([1, 2], [0, 0], [0, 0]) == model(g=9.81).acceleration([1, 2], [0, 0], [0, 0])).all()
    kept = pickle.dumps(model)
    file.unlink()
    # A model that is in use is the same.
    assert pickle.loads(kept) is model
    del model, kernel
    gc.collect()
    with pytest.raises(OSError, match="not as it was"):
        pickle.loads(kept)


def test_joints_are_locked():
    """The motion of what is left needs no force in the whole but in the joint that is held."""
    whole, bent = gauss.load(ARM, gravity=9.81), gauss.load(ARM, ["lock(elbow = 0.7)"], gravity=9.81)
    assert bent.coordinate_names == bent.input_names == ["shoulder"]
    q, z, tau = np.random.default_rng(4).uniform(-2, 2, (3, 20, 1))
    both, speeds, efforts = np.hstack([q, 0 * q + 0.7]), np.hstack([z, 0 * z]), np.hstack([tau, 0 * tau])
    np.testing.assert_allclose(bent.mass_matrix(q), whole.mass_matrix(both)[:, :1, :1], rtol=0, atol=50 * EPS)
    rates = np.hstack([bent.acceleration(q, z, tau), 0 * q])
    rest = whole.inverse_dynamics(both, speeds, rates, efforts)
    # Torques of up to 20 N m, each of a few dozen products.
    np.testing.assert_allclose(rest[:, 0], 0, atol=50 * 20 * EPS)
    assert np.abs(rest[:, 1]).max() > 1
    with pytest.raises(gauss.SceneError, match="is no coordinate, and a lock holds one; did you mean `elbow`"):
        gauss.load(ARM, ["lock(elbo = 0.7)"], gravity=9.81)


def test_gravity_has_three_components_or_one():
    q = [0.3, 0.2]
    down, none = gauss.load(ARM, gravity=[0, 0, -9.81]), gauss.load(ARM, gravity=0)
    assert down.potential_energy(q) == gauss.load(ARM, gravity=9.81).potential_energy(q) != 0
    assert (none.acceleration(q, [0, 0], [0, 0]) == 0).all()


def test_mjcf_has_its_own_gravity():
    balls = gauss.load(ROOT / "tests/robots/balls.xml")
    assert balls.coordinate_names and pickle.loads(pickle.dumps(balls)) == balls


def test_pickles_are_texts(tmp_path, model, pendulum):
    for own in (model, pendulum):
        again = pickle.loads(pickle.dumps(own))
        assert again == own and hash(again) == hash(own)
    assert pickle.loads(pickle.dumps(pendulum)).acceleration([1], [0]) == pendulum.acceleration([1], [0])
    file = tmp_path / "arm.urdf"
    file.write_bytes(ARM.read_bytes())
    arm = gauss.load(file, gravity=9.81)
    kept, expected = pickle.dumps(arm), arm.acceleration([0.3, 0.2], [1, 2], [0, 0]).tobytes()
    # The file may be gone, or another: what was read is in the pickle.
    for change in (lambda: file.write_text(file.read_text().replace('value="2.0"', 'value="3.0"')), file.unlink):
        change()
        again = pickle.loads(kept)
        assert again.acceleration([0.3, 0.2], [1, 2], [0, 0]).tobytes() == expected and again == arm


FORKED = f"""
import os, sys
import numpy as np
import gauss

arm = gauss.load({str(ARM)!r}, gravity=9.81)
q = np.linspace(-1, 1, 2000).reshape(-1, 2)

def computed():
    # One method is compiled before the fork, the other within it.
    return arm.acceleration(q, [0, 0], [1, 2]).tobytes()

expected = computed()
child = os.fork()
if child == 0:
    os._exit(0 if computed() == expected and arm.mass_matrix(q).shape == (1000, 2, 2) else 1)
sys.exit(0 if os.waitpid(child, 0)[1] == 0 and computed() == expected else 1)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_forks_compute():
    # What hangs is ended after minutes; it takes a second.
    assert subprocess.run([sys.executable, "-c", FORKED], timeout=300).returncode == 0


LEFT = """
import os, pathlib, signal, sys, threading
import gauss

os.environ["GAUSS_CACHE"] = ""
signal.signal(signal.SIGINT, signal.default_int_handler)
ends = [" + ".join(f"l*{of}(a{i})" for i in range(number + 1)) for number in range(14) for of in ("sin", "cos")]
bodies = ", ".join(f"particle(mass = m, position = [{x}, {y}, 0])" for x, y in zip(ends[::2], ends[1::2]))
chain = f"coordinates({', '.join(f'a{i}' for i in range(14))}), {bodies}, linearize(hessian)"
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    gauss.scene(chain, m="kg", l="m")
except KeyboardInterrupt:
    # The derivation, of many seconds, goes on; other scenes are derived meanwhile.
    names = [(task / "comm").read_text().strip() for task in pathlib.Path("/proc/self/task").iterdir()]
    other = gauss.scene("coordinates(x), particle(mass = m, position = [x, 0, 0])", m="kg")(m=2.0)
    os._exit(0 if "gauss-derivatio" in names and other.acceleration([0.0], [0.0]) == [0.0] else 1)
sys.exit(2)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="threads have no names in files")
def test_derivations_are_left_by_interruptions():
    assert subprocess.run([sys.executable, "-c", LEFT], timeout=300).returncode == 0


def test_the_command_shows_a_file():
    shown = [sys.executable, "-m", "gauss", "show", str(ARM)]
    text = subprocess.run(shown, capture_output=True, text=True, check=True).stdout
    assert "shoulder_ddot" in text and "Gravity: 9.81" in text and "`effort`) does not act" in text
    wrong = subprocess.run([*shown, "--clause", "nonsense"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "unknown clause" in wrong.stderr and "Traceback" not in wrong.stderr


def test_stubs_are_those_of_the_module(tmp_path):
    assert (Path(gauss.__file__).parent / "_native.pyi").read_text() == gauss._native.stubs()
    mypy = pytest.importorskip("mypy.api")
    file = tmp_path / "use.py"
    file.write_text(
        "import gauss\narm = gauss.load('a.urdf', gravity=9.81)\nx = arm.linearize([1], [0]).by_state.shape\n"
        "y = gauss.scene('', m='kg')(m=1).acceleration([1], [0]).sum()\n"
    )
    told, _, code = mypy.run(["--strict", "--cache-dir", str(tmp_path), str(file)])
    assert code == 0, told


def test_kernels_never_change(pendulum):
    with pytest.raises(AttributeError, match="`m` cannot be set: a kernel never changes"):
        pendulum.m = 3
    with pytest.raises(AttributeError):
        pendulum.acceleration = None


def test_programs_have_parameters_of_rows():
    scene = "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), potential = k[0] * x + k[1] * y)]"
    model = gauss.scene(scene + " struct Mass { m: f64, k: Vector3<f64> }")
    mass = model(m=2.0, k=[1.0, 2.0, 3.0])
    q, z = np.random.default_rng(5).normal(size=(2, 40, 2))
    k = np.random.default_rng(6).normal(size=(40, 3))
    # The forces of the elements of one row after another, as kernels of their own have them.
    alone = np.array([model(m=2.0, k=own).element_forces(*row) for own, *row in zip(k, q, z)])
    assert np.array_equal(mass.element_forces(q, z, k=k), alone)
    assert np.array_equal(mass.element_forces(q, z, k=k, threads=3), alone)
    several = [model(m=2.0, k=own).element_forces(q[0], z[0]) for own in k[:5]]
    assert np.array_equal(mass.element_forces(q[0], z[0], k=k[:5]), several)
    assert np.array_equal(mass.element_forces(q, z, k=k[0]), model(m=2.0, k=k[0]).element_forces(q, z))
    assert not np.array_equal(mass.element_forces(q, z), alone)
    with pytest.raises(ValueError, match=r"k has shape \(40, 2\); expected \(..., 3\)"):
        mass.element_forces(q, z, k=k[:, :2])
    with pytest.raises(ValueError, match=r"leading axes differ: \(40,\) of z, \(39,\) of m"):
        mass.element_forces(q, z, m=np.ones(39))
    with pytest.raises(gauss.ParameterError, match=r"m.*, in row 1$") as raised:
        mass.element_forces(q[:3], z[:3], m=[1.0, -1.0, 1.0])
    assert [name for name, _ in raised.value.fields] == ["m"]
    with pytest.raises(TypeError, match="`l` is none of them"):
        mass.element_forces(q, z, l=1.0)


def test_driving_forces():
    """Force and power of a trolley that a motion drives, in rows: the row of inverse dynamics of the whole."""
    clauses = (
        "coordinates(x, angle), gravity = 9.81, body(trolley, position = [x, 0, 0], mass = 2, inertia = 1), "
        "body(bob, parent = trolley, rotation = rotation_y(angle), mass = 0.7, center_of_mass = [0, 0, -0.4], "
        "inertia_about_center_of_mass = 0)"
    )
    driven, whole = gauss.scene(clauses + ", motion(x = 0.3 * sin(2.5 * t))")(), gauss.scene(clauses)()
    t, q, z = np.array([0.1, 0.7, -0.4]), np.array([[0.3], [1.0], [-2.0]]), np.array([[0.5], [-3.0], [1.0]])
    found = driven.driving_forces(q, z, t=t)
    assert driven.motions == ["x"] and found.shape == (3, 1, 2) and whole.motions == []
    x, v = 0.3 * np.sin(2.5 * t), 0.75 * np.cos(2.5 * t)
    at, rate = np.column_stack([x, q]), np.column_stack([v, z])
    rates = np.column_stack([-6.25 * x, driven.acceleration(q, z, t=t)])
    # Some fifty products of forces up to ten.
    force = whole.inverse_dynamics(at, rate, rates, t=t)
    np.testing.assert_allclose(found[:, 0, 0], force[:, 0], rtol=0, atol=1e-13)
    np.testing.assert_allclose(found[:, 0, 1], force[:, 0] * v, rtol=0, atol=1e-13)
    np.testing.assert_allclose(force[:, 1], 0, rtol=0, atol=1e-13)


def test_values_are_not_taken_for_units():
    text = "coordinates(x), particle(mass = m, position = [x, 0, 0])"
    with pytest.raises(TypeError, match=r"m, k: a scene takes the unit .* scene\(..., m=None\)\(m=1.5\)"):
        gauss.scene(text + ", drive(x = -k * x)", m=1.5, k=2)
    free = gauss.scene(text, m=None)(m=1.5)
    for interval in ([0, 1], np.array([0.0, 1.0])):
        # Rounding of some steps.
        assert abs(free.simulate([0.0], [2.0], interval).q[-1, 0] - 2.0) < 1e-13
    for wrong in (5, [0, 1, 2], "01", [0, None]):
        with pytest.raises(TypeError, match="the interval is a pair of times"):
            free.simulate([0.0], [2.0], wrong)
