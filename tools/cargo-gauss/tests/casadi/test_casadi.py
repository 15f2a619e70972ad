"""Scenes as functions of CasADi: values and derivatives beside CasADi's own of equations by Lagrange, and an optimal
control problem solved with both."""

import os
import re
import subprocess
from pathlib import Path

import pytest

np = pytest.importorskip("numpy")
ca = pytest.importorskip("casadi", reason="CasADi is not installed: `pip install casadi`")

HERE = Path(__file__).parent
ROOT = HERE.parents[3]
COMMAND = os.environ.get("CARGO_GAUSS", ROOT / "target/debug/cargo-gauss")
SCENE = ROOT / "examples/cart_pole.rs"
METHODS = "acceleration,mass_matrix,kinetic_energy"
PARAMETERS = [1.0, 0.2, 0.6, 9.81]
# Some hundred roundings of numbers below a hundred, whose derivatives divide by a mass matrix of condition ten.
ROUNDING = 1e-10


def show(*arguments):
    return subprocess.run([COMMAND, "gauss", "show", *arguments], capture_output=True, text=True)


def compiled(file):
    library = str(file.with_suffix(".so"))
    try:
        made = subprocess.run(["cc", "-O1", "-shared", "-fPIC", file, "-o", library, "-lm"], capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("no C compiler")
    assert made.returncode == 0, made.stderr
    return library


@pytest.fixture(scope="session")
def library(tmp_path_factory):
    if not Path(COMMAND).is_file():
        pytest.skip(f"{COMMAND} is not built: `cargo build -p cargo-gauss`")
    file = tmp_path_factory.mktemp("casadi") / "cart_pole.c"
    made = show(SCENE, "CartPole", "--as", "casadi", "--method", METHODS, "-o", file)
    assert made.returncode == 0, made.stderr
    return compiled(file)


def symbols(kind):
    return [kind.sym(name, n) for name, n in [("p", 4), ("q", 2), ("z", 2), ("u", 1)]]


@pytest.fixture(scope="session")
def lagrange():
    """The accelerations and the mass matrix of the same scene as CasADi derives them from T - V."""
    p, q, z, u = symbols(ca.SX)
    cart, bob, length, g = ca.vertsplit(p)
    place = ca.vertcat(q[0] + length * ca.sin(q[1]), length * ca.cos(q[1]))
    velocity = ca.jtimes(place, q, z)
    lagrangian = (cart * z[0] ** 2 + bob * ca.dot(velocity, velocity)) / 2 - bob * g * place[1]
    momenta = ca.gradient(lagrangian, z)
    forces = ca.gradient(lagrangian, q) + ca.vertcat(u, 0) - ca.jtimes(momenta, q, z)
    mass_matrix = ca.jacobian(momenta, z)
    return ca.Function("lagrange", [p, q, z, u], [ca.solve(mass_matrix, forces), mass_matrix])


@pytest.fixture(scope="session")
def gauss(library):
    """The same of the scene, at t = 0."""
    acceleration = ca.external("cart_pole_acceleration", library)
    mass_matrix = ca.external("cart_pole_mass_matrix", library)
    p, q, z, u = symbols(ca.MX)
    return ca.Function("gauss", [p, q, z, u], [acceleration(p, 0, q, z, u), mass_matrix(p, 0, q)])


def states():
    random = np.random.default_rng(5)
    for _ in range(20):
        yield [PARAMETERS * random.uniform(0.5, 2, 4), *(random.uniform(-2, 2, n) for n in [2, 2, 1])]


def compare(ours, theirs):
    ours, theirs = np.array(ours), np.array(theirs)
    assert ours.shape == theirs.shape
    assert np.abs(ours - theirs).max() <= ROUNDING * (1 + np.abs(theirs).max())


def test_names_and_shapes(library):
    acceleration = ca.external("cart_pole_acceleration", library)
    assert acceleration.name_in() == ["parameters", "t", "q", "z", "input"]
    assert [acceleration.size_in(k) for k in range(5)] == [(4, 1), (1, 1), (2, 1), (2, 1), (1, 1)]
    assert acceleration.name_out() == ["acceleration"]
    assert ca.external("cart_pole_mass_matrix", library).size_out(0) == (2, 2)
    # A Jacobian has places for what can change alone: accelerations know nothing of x and t.
    entries = ca.external("jac_cart_pole_acceleration", library)
    assert entries.nnz_out("jac_acceleration_t") == 0 and entries.nnz_out("jac_acceleration_q") == 2


def test_values_and_derivatives(gauss, lagrange):
    for state in states():
        for ours, theirs in zip(gauss(*state), lagrange(*state)):
            compare(ours, theirs)
        for ours, theirs in zip(gauss.jacobian()(*state, 0, 0), lagrange.jacobian()(*state, 0, 0)):
            compare(ours, theirs)


def test_second_derivatives(gauss, lagrange):
    def hessian(function, kind):
        arguments, weights = symbols(kind), kind.sym("w", 2)
        return ca.Function("hessian", [*arguments, weights], [
            ca.jacobian(ca.gradient(ca.dot(weights, function(*arguments)[0]), a), b)
            for a in arguments for b in arguments
        ])

    ours, theirs = hessian(gauss, ca.MX), hessian(lagrange, ca.SX)
    for state in states():
        for own, other in zip(ours(*state, [0.3, -0.7]), theirs(*state, [0.3, -0.7])):
            compare(own, other)


def test_directions(gauss, lagrange):
    for state in states():
        along = [[0.1, 0, 0.2, 0], [1, -1], [0, 2], [0.5]]
        compare(gauss.forward(1)(*state, 0, 0, *along)[0], lagrange.forward(1)(*state, 0, 0, *along)[0])
        weights = [ca.DM([1, -2]), ca.DM([[0.5, 0], [0, 0.1]])]
        for own, other in zip(gauss.reverse(1)(*state, 0, 0, *weights), lagrange.reverse(1)(*state, 0, 0, *weights)):
            compare(own, other)


def test_arguments_that_are_not_given_are_zero(library):
    energy = ca.external("cart_pole_kinetic_energy", library)
    names = dict(zip(energy.name_in(), [PARAMETERS, 0, [0.1, 0.2], [1.0, 0.0]]))
    assert float(energy.call(names)["kinetic_energy"]) == pytest.approx(0.6, abs=1e-15)
    del names["z"]
    assert float(energy.call(names)["kinetic_energy"]) == 0


def swing_up(dynamics):
    """The least effort by which the pole comes up within 2 s: forty steps of Runge and Kutta's method."""
    opti, steps = ca.Opti(), 40
    h = 2 / steps
    q, z, u = opti.variable(2, steps + 1), opti.variable(2, steps + 1), opti.variable(1, steps)
    rate = lambda q, z, u: (z, dynamics(PARAMETERS, q, z, u)[0])
    for k in range(steps):
        at, moving = (q[:, k], z[:, k]), u[k]
        k1 = rate(*at, moving)
        k2 = rate(*(a + h / 2 * b for a, b in zip(at, k1)), moving)
        k3 = rate(*(a + h / 2 * b for a, b in zip(at, k2)), moving)
        k4 = rate(*(a + h * b for a, b in zip(at, k3)), moving)
        ends = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(at, k1, k2, k3, k4)]
        opti.subject_to(q[:, k + 1] == ends[0])
        opti.subject_to(z[:, k + 1] == ends[1])
    opti.subject_to(ca.vertcat(q[:, 0], z[:, 0]) == ca.vertcat(0, np.pi, 0, 0))
    opti.subject_to(ca.vertcat(q[:, -1], z[:, -1]) == 0)
    opti.subject_to(opti.bounded(-20, u, 20))
    effort = h * ca.sumsqr(u)
    opti.minimize(effort)
    opti.set_initial(q[1, :], np.linspace(np.pi, 0, steps + 1))
    opti.solver("ipopt", {"print_time": False}, {"print_level": 0, "sb": "yes", "tol": 1e-10})
    solution = opti.solve()
    return solution.value(effort), solution.stats()["iter_count"]


def test_a_pole_swings_up_alike(gauss, lagrange):
    (ours, steps), (theirs, their_steps) = swing_up(gauss), swing_up(lagrange)
    # The tolerance of the solver, and as many steps: with Hessians that were wrong it would take others.
    assert ours == pytest.approx(theirs, rel=1e-7) and abs(steps - their_steps) <= 2


def test_methods_that_are_not_there_are_told(tmp_path):
    told = show(SCENE, "CartPole", "--as", "casadi", "--method", "acceleration,nonsense", "-o", tmp_path / "none.c")
    assert told.returncode != 0 and "CartPole has no method `nonsense`; it has " in told.stderr
    assert not (tmp_path / "none.c").exists()


ARM = ROOT / "examples/python/arm.urdf"


def test_a_robot_that_python_loaded(tmp_path):
    own = pytest.importorskip("gauss", reason="the package `gauss` is not installed")
    arm = own.load(ARM, ["linearize"], gravity=9.81)
    arm.model.casadi(tmp_path / "arm.c", "acceleration")
    name = re.search(r"^int jac_(\w+_acceleration)\(", (tmp_path / "arm.c").read_text(), re.MULTILINE).group(1)
    function = ca.external(name, compiled(tmp_path / "arm.c"))
    random = np.random.default_rng(1)
    for _ in range(10):
        state = {"q": random.uniform(-2, 2, 2), "z": random.uniform(-2, 2, 2), "input": random.uniform(-2, 2, 2)}
        assert set(function.name_in()) == {"t", *state}
        compare(np.array(function(**state)["acceleration"]).ravel(), arm.acceleration(*state.values()))
        jacobian = function.jacobian()(**state)
        exact = arm.linearize(*state.values())
        by_state = np.hstack([np.array(jacobian[f"jac_acceleration_{part}"]) for part in "qz"])
        compare(by_state, np.asarray(exact.by_state)[2:])
        compare(jacobian["jac_acceleration_input"], np.asarray(exact.by_input)[2:])
    with pytest.raises(ValueError, match="has no method `nonsense`; it has .*inverse_dynamics"):
        arm.model.casadi(tmp_path / "none.c", ["nonsense"])
    with pytest.raises(OSError):
        arm.model.casadi(tmp_path / "nowhere/arm.c")
