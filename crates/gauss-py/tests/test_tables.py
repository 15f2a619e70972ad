"""Tables at run time: arrays of NumPy by the names of the constants in clauses."""

import copy
import pickle

import gauss
import numpy as np
import pytest

#: A glider of one mass: lift by two numbers, thrust by one, a well by a spline.
SCENE = """coordinates(x, y), particle(mass = m, position = [x, y, 0]), input(throttle),
table(thrust, points = aero::THRUST), table(lift, axes = [X, Y], values = LIFT, kind = hermite),
table(well, points = WELL, kind = cubic),
drive(first, x = throttle * thrust(rate(x))), drive(second, y = lift(x, y)), potential = well(x)"""
X, Y = np.array([-1.0, -0.2, 0.5, 1.3]), np.array([0.0, 1.0, 2.5])
LIFT = np.add.outer(0.3 * X**2 - X, np.zeros(3)) * (0.2 * Y**2 + 1)
THRUST = [[-1, 3], [0, 2], [4, 0]]
# The natural spline through them is 1 - 3 u²/2 + |u|³/2 at the distance u from 3.
WELL = [[2, 0], [3, 1], [4, 0]]
TABLES = {"aero::THRUST": THRUST, "X": X, "Y": Y, "LIFT": LIFT, "WELL": WELL}


@pytest.fixture(scope="module")
def model():
    return gauss.scene(SCENE, tables=TABLES, m="kg")


def test_forces_are_those_of_formulas(model):
    glider = model(m=2)
    random = np.random.default_rng(4)
    # Within the grid, where Hermite's cubics are the parabolas that their points are on.
    q = np.stack([random.uniform(-1, 1.3, 50), random.uniform(0, 2.5, 50)], -1)
    z = random.uniform(-1, 4, (50, 2))
    lift = (0.3 * q[:, 0] ** 2 - q[:, 0]) * (0.2 * q[:, 1] ** 2 + 1)
    thrust = np.interp(z[:, 0], [-1, 0, 4], [3, 2, 0])
    # Before its points the spline is straight, with the slope 3/2 of u = -1.
    force = np.stack([0.5 * thrust - 1.5, lift], -1)
    # Some thirty sums of numbers below ten.
    near = dict(rtol=0, atol=300 * np.finfo(float).eps)
    np.testing.assert_allclose(glider.acceleration(q, z, [0.5]), force / 2, **near)
    u = random.uniform(-1, 1, 50)
    energies = glider.potential_energy(np.stack([u + 3, q[:, 1]], -1))
    np.testing.assert_allclose(energies, 1 - 1.5 * u**2 + 0.5 * abs(u) ** 3, **near)
    assert "lift(x, y)" in model.equations


def test_runs_go_on_with_tables():
    cart = gauss.scene(
        "coordinates(x), particle(mass = 2, position = [x, 0, 0]), table(thrust, points = THRUST), drive(x = thrust(rate(x)))",
        tables={"THRUST": [[0, 2], [4, 0]]},
    )()
    # 2 v' = 2 - v / 2.
    run = cart.simulate([0.0], [0.0], (0, 3), rtol=1e-11, atol=1e-11)
    assert abs(run.z[-1, 0] - 4 * (1 - np.exp(-3 / 4))) < 1e-9
    ends = cart.ensemble([0.0], np.zeros((9, 1)), (0, 3), rtol=1e-11, atol=1e-11)
    assert abs(ends.z - run.z[-1]).max() < 1e-12


def test_models_are_equal_by_their_tables(model):
    assert gauss.scene(SCENE, tables=dict(TABLES), m="kg") is model
    other = gauss.scene(SCENE, tables=TABLES | {"aero::THRUST": [[0.0, 1.0], [1.0, 1.0]]}, m="kg")
    assert other != model and other(m=1).acceleration([0, 0], [0, 0], [1.0])[0] == -0.5
    for again in (pickle.loads(pickle.dumps(other)), copy.deepcopy(other)):
        assert again == other and again.tables["aero::THRUST"].tolist() == [[0.0, 1.0], [1.0, 1.0]]
    kernel = pickle.loads(pickle.dumps(other(m=1)))
    assert kernel.acceleration([0, 0], [0, 0], [1.0])[0] == -0.5
    assert model.tables["LIFT"].shape == (4, 3) and not model.tables["LIFT"].flags.writeable


def test_arrays_are_copied():
    points = np.array([[0.0, 1.0], [1.0, 1.0]])
    clauses = "coordinates(x), particle(mass = 1, position = [x, 0, 0]), table(f, points = P), drive(x = f(x))"
    kernel = gauss.scene(clauses, tables={"P": points})()
    points[:] = 7.0
    assert kernel.acceleration([0.5], [0.0]) == [1.0]
    # Other orders of memory, and other numbers.
    for own in (np.asfortranarray([[0.0, 1.0], [1.0, 1.0]]), [[0, 1], [1, 1]], np.float32([[0, 1], [1, 1]])):
        assert gauss.scene(clauses, tables={"P": own})().acceleration([0.5], [0.0]) == [1.0]


def test_robots_have_tables_too(tmp_path):
    text = """<robot name="arm"><link name="base"/><link name="rod"><inertial><mass value="1"/><origin xyz="0 0 -0.5"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="hinge" type="continuous">
    <parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"""
    (tmp_path / "arm.urdf").write_text(text)
    clauses = ["table(brake, points = BRAKE)", "drive(hinge = brake(rate(hinge)))"]
    arm = gauss.load(tmp_path / "arm.urdf", clauses, gravity=0, tables={"BRAKE": [[-1, 3], [1, -3]]})
    # 3 N m on 1 + 1/4 kg m^2.
    assert abs(arm.acceleration([0.2], [1.0], [0.0])[0] + 3 / 1.25) < 1e-14
    assert pickle.loads(pickle.dumps(arm)).acceleration([0.2], [1.0], [0.0]) == arm.acceleration([0.2], [1.0], [0.0])
    with pytest.raises(gauss.ParameterError, match="`BRAKE`, the constant of a table, is not given"):
        gauss.load(tmp_path / "arm.urdf", clauses, gravity=0)


def test_all_mistakes_of_arrays_come_at_once():
    wrong = TABLES | {"Y": [0.0, 2.0, 1.0], "LIFT": LIFT.T, "aero::THRUST": [[0, 1, 2]], "Z": [1.0, 2.0]}
    del wrong["WELL"]
    with pytest.raises(gauss.ParameterError) as raised:
        gauss.scene(SCENE, tables=wrong, m="kg")
    assert [name for name, _ in raised.value.fields] == ["Z", "WELL", "aero::THRUST", "LIFT"]
    told = str(raised.value)
    for words in (
        "`Z` is no constant of a table; there are aero::THRUST, X, Y, LIFT, WELL",
        "`WELL`, the constant of a table, is not given",
        "`aero::THRUST` has shape (1, 3); expected (n, 2)",
        "`LIFT` has shape (3, 4); expected (4, 3)",
    ):
        assert words in told
    assert pickle.loads(pickle.dumps(raised.value)).fields == raised.value.fields
    with pytest.raises(gauss.ParameterError, match="`Y`: the numbers of an axis of a table increase, and number 2"):
        gauss.scene(SCENE, tables=TABLES | {"Y": [0.0, 2.0, 1.0]}, m="kg")
    with pytest.raises(gauss.ParameterError, match="`WELL`: the numbers of a table are finite, and value 0 is inf"):
        gauss.scene(SCENE, tables=TABLES | {"WELL": [[0, np.inf], [1, 1]]}, m="kg")
    with pytest.raises(TypeError, match=r"tables\['X'\] is no array of real numbers"):
        gauss.scene(SCENE, tables=TABLES | {"X": "alpha"}, m="kg")
    # Mistakes of the text come first.
    with pytest.raises(gauss.SceneError, match="unknown kind of table"):
        gauss.scene(SCENE.replace("hermite", "round"), m="kg")


def test_no_fmu_has_tables(model, tmp_path):
    with pytest.raises(ValueError, match="a function of Rust or a table: no FMU has it"):
        model(m=1).fmu(tmp_path / "glider.fmu")
