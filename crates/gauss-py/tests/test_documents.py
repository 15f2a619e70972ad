"""Kernels as MJCF and URDF: what is written, what is refused, the same accelerations in MuJoCo and Pinocchio."""

from xml.etree import ElementTree

import gauss
import numpy as np
import pytest

SCENE = """coordinates(angle), input(torque), drive(angle = torque),
    body(arm, rotation = rotation_y(angle), mass = m, center_of_mass = [0, 0, -l], inertia = [1, 1, 0.1])"""


@pytest.fixture(scope="module")
def arm():
    return gauss.scene(SCENE, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity"))(m=2, l=0.5, g=9.81)


def test_the_document_has_the_numbers_of_the_kernel(arm):
    root = ElementTree.fromstring(arm.mjcf())
    assert root.find(".//joint").get("name") == "angle" and root.find(".//motor").get("joint") == "angle"
    assert root.find(".//inertial").get("mass") == "2" and root.find("option").get("gravity") == "0 0 -9.81"


def test_what_has_no_counterpart_is_refused():
    kernel = gauss.scene("coordinates(x), particle(mass = 1, position = [x, 0, 0]), potential = x * x * x * x")()
    with pytest.raises(ValueError, match="`potential`"):
        kernel.mjcf()


def test_mujoco_moves_alike(arm):
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: `pip install mujoco`")
    model = mujoco.MjModel.from_xml_string(arm.mjcf())
    data = mujoco.MjData(model)
    for angle, rate, torque in np.random.default_rng(3).uniform(-2, 2, (10, 3)):
        data.qpos[0], data.qvel[0], data.ctrl[0] = angle, rate, torque
        mujoco.mj_forward(model, data)
        expected = arm.acceleration([angle], [rate], input=[torque])
        # A few roundings of numbers of the size 10.
        assert abs(data.qacc[0] - expected[0]) < 1e-13


def test_urdf_has_links_and_joints(arm):
    root = ElementTree.fromstring(arm.urdf())
    joint = root.find("joint")
    assert (joint.get("name"), joint.get("type"), joint.find("child").get("link")) == ("angle", "continuous", "arm")
    assert root.find("link/inertial/mass").get("value") == "2" and "gravity is lost, (0, 0, -9.81)" in arm.urdf()
    assert root.find("transmission/actuator").get("name") == "torque"
    ball = gauss.scene("coordinates(turn: Rotation), body(top, rotation = turn, mass = 1, inertia = 1)")()
    with pytest.raises(ValueError, match="URDF has no ball joints"):
        ball.urdf()


def test_pinocchio_moves_alike(arm):
    pinocchio = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: `pip install pin`")
    model = pinocchio.buildModelFromXML(arm.urdf())
    data = model.createData()
    for angle, rate, torque in np.random.default_rng(3).uniform(-2, 2, (10, 3)):
        q = np.array([np.cos(angle), np.sin(angle)])
        found = pinocchio.aba(model, data, q, np.array([rate]), np.array([torque]))
        # A few roundings of numbers of the size 10.
        assert abs(found[0] - arm.acceleration([angle], [rate], input=[torque])[0]) < 1e-13
