"""Runs of models that are derived while the test runs, beside formulas and solvers of others."""

from pathlib import Path

import gauss
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
PENDULUM = "coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)])"
TOP = """#[gauss(chart = hybrid, methods(centroidal))]
struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64>, #[gauss(gravity)] g: f64 }"""


@pytest.fixture(scope="module")
def pendulum():
    model = gauss.scene(PENDULUM, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity"))
    return model(m=2, l=0.5, g=9.81)


def test_the_period_of_a_pendulum(pendulum):
    # By the arithmetic-geometric mean, from rest at 1 rad: C. F. Gauss.
    a, b = 1.0, np.cos(0.5)
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)
    period = 2 * np.pi * np.sqrt(0.5 / 9.81) / a
    run = pendulum.simulate([1.0], [0.0], (0, 10), events=("angle_dot", 0.0, "falling"), rtol=1e-12, atol=1e-12)
    times = run.events[0].t
    # Tolerances of 1e-12, over some hundred steps.
    np.testing.assert_allclose(np.diff(times), period, atol=1e-9)
    energy = run["kinetic_energy"] + run["potential_energy"]
    assert np.ptp(energy) < 1e-9 and run.columns[:3] == ["t", "angle", "angle_dot"]
    at = pendulum.simulate([1.0], [0.0], (0, period), times=[period / 2, period], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(at.q[:, 0], [-1, 1], atol=1e-9)


@pytest.mark.parametrize("way", [{}, {"step": 1e-2}, {"step": 2e-2, "method": "collocation"}])
def test_a_free_top_keeps_its_momentum(way):
    top = gauss.scene(TOP)(m=2, i=[0.1, 0.2, 0.25], g=0)
    q, z = top.state(pose_x=1.0)
    z[:] = [0.1, -0.2, 0.3, 2.0, 3.0, -1.0]
    run = top.simulate(q, z, (0, 5), **way)
    assert run.q.shape[1] == 7 and run.z.shape[1] == 6
    np.testing.assert_allclose(np.square(run.q[:, :4]).sum(1), 1, atol=8 * np.finfo(float).eps)
    momentum = top.centroidal_momentum(run.q, run.z)
    turned = np.empty((len(run), 3))
    for k, (x, y, z, w) in enumerate(run.q[:, :4]):
        axis = np.array([x, y, z])
        own = np.array([0.1, 0.2, 0.25]) * run.z[k, 3:]
        turned[k] = own + 2 * np.cross(axis, np.cross(axis, own) + w * own)
    # Steps of order 8 and 6 that turn by less than a tenth of a radian.
    np.testing.assert_allclose(turned, turned[:1].repeat(len(run), 0), atol=1e-6)
    np.testing.assert_allclose(momentum[:, :3], momentum[:1, :3].repeat(len(run), 0), atol=1e-6)


def test_robots_of_every_room():
    """Chains of so many hinges fill rooms of 4 to 128 in part: energy, and the way of another solver, are kept."""
    integrate = pytest.importorskip("scipy.integrate")
    for links in (1, 3, 6, 20):
        names = [f"a{k}" for k in range(links)]
        bodies = [
            f"body(b{k}, {f'parent = b{k - 1}, position = [0, 0, -0.3], ' if k else ''}rotation = rotation_y({name}), "
            "mass = 1, center_of_mass = [0, 0, -0.15], inertia = [0.03, 0.03, 0.001])"
            for k, name in enumerate(names)
        ]
        chain = gauss.scene(f"coordinates({', '.join(names)}), {', '.join(bodies)}, gravity = 9.81")()
        q, z = np.full(links, 0.2), np.zeros(links)
        run = chain.simulate(q, z, (0, 0.5), rtol=1e-10, atol=1e-10)
        assert np.ptp(run["kinetic_energy"] + run["potential_energy"]) < 1e-7
        steps = chain.stepper(q, z, (0, 0.5), rtol=1e-10, atol=1e-10)
        while steps.step() == "step":
            pass
        assert np.array_equal(steps.q, run.q[-1]) and np.array_equal(steps.z, run.z[-1]) and steps.steps == run.steps
        rates = lambda t, x: chain.rates(x[:links], x[links:])  # noqa: B023
        other = integrate.solve_ivp(rates, (0, 0.5), np.r_[q, z], method="DOP853", rtol=1e-11, atol=1e-11)
        # Both have errors of some tolerances, which chains of 20 links multiply by less than a thousand in 0.5 s.
        np.testing.assert_allclose(np.r_[run.q[-1], run.z[-1]], other.y[:, -1], atol=1e-6)


def test_models_beyond_all_rooms_are_refused():
    many = 129
    names = ", ".join(f"x{k}" for k in range(many))
    points = ", ".join(f"particle(mass = 1, position = [x{k}, 0, 0])" for k in range(many))
    cloud = gauss.scene(f"coordinates({names}), {points}")()
    assert cloud.acceleration(np.zeros(many), np.zeros(many)).shape == (many,)
    with pytest.raises(ValueError, match="such runs are of at most 128 numbers of q, of z and of the input, and this model has 129"):
        cloud.simulate(np.zeros(many), np.zeros(many), (0, 1))


def test_floating_robots_fall():
    drone = gauss.load(ROOT / "tests/robots/quadrotor.xml", ["methods(centroidal)"])
    q, z = drone.state()
    run = drone.simulate(q, z, (0, 1), input=np.zeros(len(drone.input_names)))
    before, after = drone.center_of_mass(run.q[[0, -1]])
    np.testing.assert_allclose(after - before, [0, 0, -9.81 / 2], atol=1e-8)
    by = np.full(len(z), 0.1)
    np.testing.assert_allclose(drone.difference(q, drone.retract(q, by)), by, atol=16 * np.finfo(float).eps)


def test_loops_are_closed():
    text = "coordinates(x, y), particle(mass = m, position = [x, 0, y]), constraint(position = x*x + y*y - 1)"
    bead = gauss.scene(text + ", gravity = 9.81", m="kg")(m=0.5)
    q, z = bead.project([0.6, -0.79], [0.0, 0.0])
    np.testing.assert_allclose(np.square(q).sum(), 1, atol=4 * np.finfo(float).eps)
    run = bead.simulate(q, z, (0, 3))
    np.testing.assert_allclose(np.square(run.q).sum(1), 1, atol=8 * np.finfo(float).eps)
    with pytest.raises(gauss.IntegrationError, match="constraint"):
        bead.simulate([0.7, -0.8], [0, 0], (0, 1))


def test_rooms_have_place_for_inputs_and_multipliers():
    # More inputs than numbers of q; three constraints of which two are independent.
    text = "coordinates(x, y), particle(mass=1, position=[x, y, 0]), constraint(position = x*x + y*y - 1)"
    driven = gauss.scene(text + ", input(a, b, c, d, e), drive(x = a + b + c + d + e)")()
    q, z = driven.project([1.0, 0.0], [0.0, 1.0])
    assert q.tolist() == [1, 0] and z.tolist() == [0, 1]
    run = driven.simulate(q, z, (0, 1), input=np.zeros(5))
    np.testing.assert_allclose(run.q[-1], [np.cos(1), np.sin(1)], atol=1e-8)


def test_names_that_occur_twice_are_told_apart():
    body = "body(b, position = [r_i, 0, 0], rotation = r, mass = 1, inertia = [1, 1, 1])"
    scene = gauss.scene(f"coordinates(r: Rotation, r_i), {body}")()
    assert scene.coordinate_names == ["r_i_2", "r_j", "r_k", "r_w", "r_i"]
    q, z = scene.state(r_i=7.0)
    z[scene.speed_names.index("r_i_dot")] = 0.5
    run = scene.simulate(q, z, (0, 1), until=("r_i", 7.2))
    np.testing.assert_allclose([run["r_i"][-1], run.t[-1]], [7.2, 0.4], atol=1e-9)
    assert run[-1]["r_i"] == run["r_i"][-1] and len(set(run.columns)) == len(run.columns)
    assert scene.states(3, r_i=1.0)["r_i"].tolist() == [1, 1, 1]
    energy = gauss.scene("coordinates(kinetic_energy), particle(mass=2, position=[kinetic_energy,0,0])")()
    run = energy.simulate([1.0], [10.0], (0, 1))
    assert run["kinetic_energy"][-1] == run.q[-1, 0] and run.kinetic_energy.tolist() == run["kinetic_energy_2"].tolist()
    np.testing.assert_allclose(run.kinetic_energy, 100, atol=1e-10)
    steps = gauss.scene("coordinates(steps), particle(mass=2, position=[steps,0,0])")()
    ends = steps.ensemble([[5.0]], [0.0], (0, 1))
    assert ends.steps[0] == ends["steps_2"][0] and ends["steps"][0] == 5


def test_what_rests_in_the_origin_falls():
    body = gauss.scene("chart = hybrid, mass = 1, inertia = [1, 1, 1], gravity = 9.81")()
    run = body.simulate(*body.state(), (0, 1), method="collocation", step=0.01)
    np.testing.assert_allclose(run.q[-1, 6], -9.81 / 2, atol=1e-12)


def test_events_and_jumps_have_the_numbers_of_the_model():
    """A ball that turns, and a plane that throws it back: functions see what the model has, and no room."""
    ball = gauss.scene(TOP)(m=2, i=[0.1, 0.1, 0.1], g=9.81)
    q, z = ball.state(pose_z=1.0)
    z[3:] = [1.0, 2.0, 3.0]

    def height(t, q, z):
        assert q.shape == (7,) and z.shape == (6,)
        return q[6]

    def back(t, q, z):
        return q, np.r_[z[:2], abs(z[2]), z[3:]]

    run = ball.simulate(q, z, (0, 3), jumps=[((height, "falling"), back)], until=("pose_x", 1.0))
    fall = np.sqrt(2 / 9.81)
    np.testing.assert_allclose(run.jumps[0].t, [fall, 3 * fall, 5 * fall], atol=1e-8)
    assert run.jumps[0].q.shape == (3, 7) and run.stopped_by is None
    stopped = ball.simulate(q, z, (0, 3), until=("pose_z", 0.5))
    np.testing.assert_allclose([stopped.t[-1], stopped.q[-1][6]], [np.sqrt(1 / 9.81), 0.5], atol=1e-9)
    assert stopped.stopped_by == 0


def test_inputs_of_every_kind(pendulum):
    text = PENDULUM + ", input(motor), drive(angle = motor)"
    driven = gauss.scene(text, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity"))(m=2, l=0.5, g=9.81)
    free = pendulum.simulate([1.0], [0.0], (0, 1)).q[-1]
    table = (np.array([0.0, 0.5, 1.0]), np.array([[0.0], [0.0], [0.0]]))
    for given in ([0.0], table, lambda t, q, z: np.zeros(1)):
        np.testing.assert_allclose(driven.simulate([1.0], [0.0], (0, 1), input=given).q[-1], free, atol=1e-8)
    held = driven.simulate([1.0], [0.0], (0, 1), controller=lambda t, q, z: 2 * 9.81 * 0.5 * np.sin(q), period=1e-2)
    np.testing.assert_allclose(held.q[-1], [1.0], atol=1e-9)
    with pytest.raises(TypeError, match="the run needs an input: motor"):
        driven.simulate([1.0], [0.0], (0, 1))


def test_ensembles(pendulum):
    starts = np.linspace(0.1, 2, 50)[:, None]
    ends = pendulum.ensemble(starts, [0.0], (0, 1), parameters={"l": np.linspace(0.4, 0.6, 50)})
    for k in (0, 17, 49):
        one = pendulum.model(m=2, l=np.linspace(0.4, 0.6, 50)[k], g=9.81).simulate(starts[k], [0.0], (0, 1))
        assert (ends.q[k] == one.q[-1]).all() and ends.steps[k] == one.steps
    ends = pendulum.ensemble(starts, [0.0], (0, 1), parameters={"m": np.where(np.arange(50) == 3, -1.0, 2.0)})
    ((number, why),) = ends.errors
    assert number == 3 and "`m`" in why and np.isfinite(ends.q[4]).all()


def test_stiff_scenes():
    text = "coordinates(x, y), linearize, particle(mass = 1, position = [x, 0, y]), gravity = 9.81"
    scene = gauss.scene(text + ", spring(along = x, stiffness = 100, damping = c), spring(along = y, stiffness = k)", c=None, k=None)
    slow = scene(c=1e5, k=50)
    run = slow.simulate([1.0, 0.0], [0.0, 0.0], (0, 3), method="rosenbrock", rtol=1e-8, atol=1e-8)
    # x creeps by exp(-k/c t), y swings about where the spring holds the weight.
    np.testing.assert_allclose(run.q[-1, 0], np.exp(-3e-3), atol=1e-6)
    np.testing.assert_allclose(run.q[-1, 1], -9.81 / 50 * (1 - np.cos(np.sqrt(50) * 3)), atol=1e-5)
    assert run.steps < 3000 < 3 * 1e5 / 3.3
    with pytest.raises(gauss.IntegrationError):
        slow.simulate([1.0, 0.0], [0.0, 0.0], (0, 3), max_steps=3000)


def test_beams_bend():
    """A free beam that turns: energy is kept, and it bends by what the turning asks for."""
    beam = gauss.scene("""coordinates(angle, s),
        body(beam, rotation = rotation_z(angle), mass = 2, center_of_mass = [0.5, 0, 0], inertia = [0, 2 / 3, 2 / 3]),
        modes(beam, coordinates = [s], translation = [[1.25, 0, 0]], mass = [34 / 35], stiffness = [300],
            inertia = [[0, 1.6, 1.6, 0, 0, 0]])""")()
    run = beam.simulate([0.0, 0.02], [2.0, 0.0], (0, 2), rtol=1e-11, atol=1e-11)
    energy = run.kinetic_energy + run.potential_energy
    # Tolerances of 1e-11, over some hundred steps of numbers of order 1.
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
    assert np.ptp(run["s"]) > 0.01


def test_rockets_burn_their_fuel():
    """Tsiolkovsky's velocity, by runs of every kind."""
    rocket = gauss.scene("""coordinates(height), body(hull, position = [0, 0, height], mass = start - burn * t, inertia = 1),
        mass_flow(jet, body = hull, at = [0, 0, -2], velocity = [0, 0, -exhaust]), gravity = g""",
        start="kg", burn="kg/s", exhaust="m/s", g="m/s^2")(start=5, burn=0.4, exhaust=300, g=9.81)
    expected = 300 * np.log(5 / (5 - 0.4 * 10)) - 98.1
    ways = [{"rtol": 1e-11, "atol": 1e-11}, {"step": 1e-2, "method": "collocation"}]
    ends = [rocket.simulate([0.0], [0.0], (0, 10), **way).z[-1, 0] for way in ways]
    ends += list(rocket.ensemble([[0.0], [0.0]], [[0.0], [0.0]], (0, 10), rtol=1e-11, atol=1e-11).z[:, 0])
    # Errors of a hundred steps of 1e-11; of order six of a thousand.
    np.testing.assert_allclose(ends, expected, rtol=1e-8)


def test_what_is_not_there_is_refused(pendulum):
    with pytest.raises(ValueError, match="the method taylor is one of compiled kernels"):
        pendulum.simulate([1.0], [0.0], (0, 1), method="taylor")
    with pytest.raises(ValueError, match="the method rosenbrock needs `#.gauss.linearize"):
        pendulum.simulate([1.0], [0.0], (0, 1), method="rosenbrock")


def test_plots_have_a_line_for_each_column(pendulum):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    run = pendulum.simulate([1.0], [0.0], (0, 2))
    lines = lambda axes: [[line.get_label() for line in own.get_lines()] for own in axes]
    assert lines(run.plot()) == [["angle"], ["angle_dot"], ["kinetic_energy", "potential_energy"]]
    axes = run.plot("angle_dot", ["angle", "kinetic_energy"])
    assert lines(axes) == [["angle_dot"], ["angle", "kinetic_energy"]]
    np.testing.assert_array_equal(axes[0].get_lines()[0].get_ydata(), run["angle_dot"])
    with pytest.raises(KeyError, match="no column speed; it has t, angle, angle_dot"):
        run.plot("speed")
    with pytest.raises(ValueError, match="a panel has no columns"):
        run.plot("angle", [])
    matplotlib.pyplot.close("all")
