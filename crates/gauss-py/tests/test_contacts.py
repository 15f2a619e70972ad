"""Contacts of models at run time: closed forms, a robot of a file on its feet, and what no room is large enough for."""

import pickle
from pathlib import Path

import gauss
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
G = 9.81
BALL = "coordinates(x, y), particle(mass = 1, position = [x, 0, y]), contact(floor, gap = y, restitution = 0.5), gravity = 9.81"


def test_a_bouncing_ball_comes_to_rest_when_galileo_says():
    ball = gauss.scene(BALL)()
    run = ball.simulate([0.0, 1.0], [0.0, 0.0], (0, 2), rtol=1e-10, atol=1e-10)
    first = np.sqrt(2 / G)
    # Each flight takes half of the time of the one before: 2 e + 2 e² + … = 2 for e = 1/2.
    times = [event.t for event in run.contact_events]
    np.testing.assert_allclose(times[0], first, atol=1e-9)
    assert run.contact_events[0].kind == "impact" and run.contact_events[-1].kind == "rests"
    np.testing.assert_allclose(times[-1], 3 * first, atol=1e-6)
    np.testing.assert_allclose(run.q[-1], [0, 0], atol=1e-9)
    steps = ball.simulate([0.0, 1.0], [0.0, 0.0], (0, 2), contacts="steps", step=1e-4)
    np.testing.assert_allclose(steps.q[-1], [0, 0], atol=1e-9)
    held = ball.in_contact([0.0, 0.0], [0.0, 0.0])
    assert held.modes == {"floor": "closed"}
    np.testing.assert_allclose(held.forces["floor"], [G])
    np.testing.assert_allclose(held.acceleration, [0, 0], atol=1e-14)
    again = pickle.loads(pickle.dumps(ball))
    np.testing.assert_array_equal(again.simulate([0.0, 1.0], [0.0, 0.0], (0, 2), rtol=1e-10, atol=1e-10).q, run.q)
    flight = ball.without_contacts().simulate([0, 1], [0, 0], (0, 1))
    np.testing.assert_allclose(flight.q[-1], [0, 1 - G / 2], atol=1e-9)
    with pytest.raises(gauss.ContactError, match="`in_contact` and `simulate` have them"):
        ball.acceleration([0.0, 1.0], [0.0, 0.0])



def test_functions_for_casadi_say_that_they_leave_contacts_out(tmp_path):
    ball = gauss.scene(BALL)
    with pytest.raises(gauss.ContactError, match="^acceleration would have no forces of contacts, .* has floor; say"):
        ball.casadi(tmp_path / "ball.c", ["acceleration", "mass_matrix"])
    assert not (tmp_path / "ball.c").exists()
    ball.casadi(tmp_path / "ball.c", ["gaps", "mass_matrix"])
    ball.casadi(tmp_path / "open.c", ["acceleration"], without_contacts=True)
    assert "_acceleration(" in (tmp_path / "open.c").read_text()


def test_ensembles_of_blocks_stop_where_coulomb_says():
    text = """coordinates(x, z), particle(mass = m, position = [x, 0, z]), gravity = 9.81,
        contact(floor, gap = z, slip = rate(x), friction = mu)"""
    block = gauss.scene(text, m=None, mu=None)
    speeds, frictions = np.linspace(0.5, 3, 8), np.linspace(0.2, 0.9, 8)
    starts = np.stack([speeds, np.zeros(8)], axis=1)
    ends = block(m=2, mu=0.5).ensemble(np.zeros((8, 2)), starts, (0, 3), parameters={"mu": frictions}, rtol=1e-9, atol=1e-9)
    assert not ends.errors
    np.testing.assert_allclose(ends.q[:, 0], speeds**2 / (2 * frictions * G), rtol=1e-8)


def test_a_robot_of_a_file_stands_on_its_feet():
    feet = [("LF", 1, 1), ("RF", 1, -1), ("LH", -1, 1), ("RH", -1, -1)]
    clauses = [f"point(p{leg}, body = {leg}_KFE_link, at = [{0.033 * x}, {0.01305 * y}, -0.33797])" for leg, x, y in feet]
    clauses += [f"contact({leg}_foot, point = p{leg}, radius = 0.031, friction = 0.8)" for leg, _, _ in feet]
    robot = gauss.load(ROOT / "tests/robots/anymal.urdf", clauses=["base = floating", *clauses], gravity=G)
    assert robot.contact_names == ["LF_foot", "RF_foot", "LH_foot", "RH_foot"]
    legs = np.array([[0, 0.4, -0.8] if x > 0 else [0, -0.4, 0.8] for _, x, _ in [feet[0], feet[2], feet[1], feet[3]]]).ravel()
    q, hold = np.concatenate([[0, 0, 0, 1, 0, 0, 0.6], legs]), legs.copy()
    lowest = min(np.ravel(robot.gaps(q)))
    q[6] -= lowest
    stiffness, damping = 200.0, 8.0
    run = robot.simulate(
        q, np.zeros(18), (0, 1.5), contacts="steps", step=1e-3,
        input=lambda t, q, z: stiffness * (hold - q[7:]) - damping * z[6:],
    )
    names = [f"{name} force" for name in robot.contact_names]
    carried = sum(run[name][-1] for name in names)
    mass = robot.mass_matrix(run.q[-1])[0, 0]
    weight = mass * G
    # It has come to rest: its feet carry it, and nothing moves.
    np.testing.assert_allclose(carried, weight, rtol=1e-3)
    assert np.abs(run.z[-1]).max() < 0.05 and run.contact_report["penetration"] < 1e-6
    state = robot.in_contact(run.q[-1], np.zeros(18), stiffness * (hold - run.q[-1, 7:]))
    np.testing.assert_allclose(sum(force[0] for force in state.forces.values()), weight, rtol=0.2)


def test_rooms_say_what_they_are_too_small_for():
    corners = "".join(
        f"contact(c{k}, point = case.position + case.rotation * [{0.01 * k}, 0, -0.1], friction = 0.4), " for k in range(33)
    )
    box = gauss.scene(
        "coordinates(pose: Pose), body(case, pose = pose, mass = 2, inertia = [0.03, 0.04, 0.05]), " + corners + "gravity = 9.81"
    )()
    with pytest.raises(ValueError, match="at most 64 numbers .* and 96 rows of contacts, .* has 7 and 99 rows"):
        box.simulate([0, 0, 0, 1, 0, 0, 1], np.zeros(6), (0, 0.1))
    free = gauss.scene("coordinates(x), particle(mass = 1, position = [x, 0, 0])")()
    with pytest.raises((ValueError, TypeError), match="contact"):
        free.simulate([0.0], [0.0], (0, 1), contacts="steps", step=1e-3)


def test_what_steps_leave_is_at_rest():
    """States of a run in steps, whose gaps and rates are rounding, have the forces of rest."""
    robot = gauss.load(
        ROOT / "tests/robots/quadruped.urdf", gravity=G,
        clauses=["base = floating", "ground(links = [lf_foot, rf_foot, lh_foot, rh_foot], friction = 0.7)"],
    )
    legs = np.array([0.5, -1.0] * 4)
    q, z = robot.state()
    q[7:] = legs
    q[6] -= robot.gaps(q).min()
    law = lambda t, q, z: (legs - q[7:]) * 400 - z[6:] * 12
    run = robot.simulate(q, z, (0, 1.0), input=law, contacts="steps", step=1e-3, times=np.linspace(0.7, 1, 16))
    weight = robot.mass_matrix(q)[0, 0] * G
    for q, z in zip(run.q, run.z):
        found = robot.in_contact(q, z, law(0, q, z))
        assert set(found.modes.values()) <= {"sticks", "slides"}
        # It moves by less than a millimetre a second.
        np.testing.assert_allclose(sum(force[0] for force in found.forces.values()), weight, rtol=1e-2)


def test_pushes_by_tables_are_seen_at_rest():
    """Half a kilogram, pushed with 100 N for 10 ms at 7 s, slides on until friction stops it."""
    block = gauss.scene(
        "coordinates(x, z), particle(mass = 0.5, position = [x, 0, z]), gravity = 9.81, input(u), drive(x = u), "
        "contact(floor, gap = z, slip = rate(x), friction = 0.3)"
    )()
    times, values = [0, 7, 7.0001, 7.0099, 7.01, 10], [0, 0, 100, 100, 0, 0]
    push = (times, [[u] for u in values])
    # The impulse of 0.99 N s, less what friction takes meanwhile.
    friction = 0.3 * G
    speed = 0.99 / 0.5 - friction * 0.01
    run = block.simulate([0, 0], [0, 0], (0, 10), input=push)
    np.testing.assert_allclose(run.q[-1, 0], 0.5 * speed * 0.01 + speed**2 / (2 * friction), rtol=1e-3)
    ends = block.ensemble([[0, 0]] * 2, [0, 0], (0, 10), input=push)
    np.testing.assert_allclose(ends.q[:, 0], run.q[-1, 0], rtol=1e-6)
    free = block.without_contacts().ensemble([[0, 0]] * 2, [0, 0], (0, 10), input=push)
    np.testing.assert_allclose(free.z[:, 0], 1.98, rtol=1e-6)


def test_drives_give_energy_in_steps():
    wall = gauss.scene("coordinates(x), particle(mass = 1, position = [x, 0, 0]), contact(wall, gap = x - 3*t, restitution = 0.5)")()
    for step in (1e-2, 1e-3, 1e-4):
        run = wall.simulate([0.1], [0], (0, 0.5), contacts="steps", step=step)
        np.testing.assert_allclose(run.z[-1], 4.5, rtol=1e-9)


def test_gaps_that_are_no_numbers_end_a_run():
    root = gauss.scene("coordinates(x), particle(mass = 1, position = [x, 0, 0]), contact(w, gap = sqrt(x))")()
    with pytest.raises(gauss.IntegrationError, match="w"):
        root.simulate([0.5], [-1.0], (0, 2), contacts="steps", step=1e-3)


def test_kernels_with_contacts_can_be_looked_at():
    ball = gauss.scene(BALL)()
    assert "gaps" in dir(ball) and hasattr(ball, "constraint_function") and ball.evaluate.__doc__
    with pytest.raises(gauss.ContactError):
        ball.constraint_function([0, 1], [0, 0], [0, 0])
