"""Robots that stand in MuJoCo, as examples/contact_steps has them: `python benches/peers/contact_steps.py`.

The same links (tests/robots), feet, gains, friction and steps of a millisecond. Newton's solver with elliptic cones, and
the same with 1e-10 for its tolerance and a hundred iterations of NoSlip. Times are of `mj_step` in batches of 100 steps,
counted by its own loop. The feet are those of the last of three seconds.
"""

import json
import sys
import time
from pathlib import Path

import mujoco
import numpy as np

ROBOTS = Path(__file__).parents[2] / "tests" / "robots"
STEP, BATCH, COUNT = 1e-3, 100, 3000


def text(*numbers):
    return " ".join(repr(float(x)) for x in np.ravel(numbers))


def body(links, link, feet, height):
    """A link with all that hang on it."""
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ravel(link["rotation"]).astype(float))
    floating = link["joint"] == "floating"
    place = [0.0, 0.0, height] if floating else link["position"]
    inertia = link["inertia_about_center_of_mass"]
    moments = text(*(inertia[k] for k in ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"]))
    kind = {"revolute": "hinge", "prismatic": "slide"}.get(link["joint"])
    joint = (
        "<freejoint/>"
        if floating
        else f'<joint name="{link["name"]}" type="{kind}" axis="{text(link["axis"])}" damping="0" armature="0"/>'
    )
    inside = "".join(body(links, child, feet, 0.0) for child in links if child["parent"] == link["name"])
    return (
        f'<body name="{link["name"]}" pos="{text(place)}" quat="{text(quaternion)}">{joint}'
        f'<inertial pos="{text(link["center_of_mass"])}" mass="{link["mass"]}" fullinertia="{moments}"/>'
        f"{feet.get(link['name'], '')}{inside}</body>"
    )


def scene(name, feet, height, gains, noslip):
    links = json.loads((ROBOTS / f"{name}.json").read_text())["links"]
    joints = [link["name"] for link in links if link["parent"] is not None]
    actuators = "".join(
        f'<position joint="{joint}" kp="{gains(k)[0]}" kv="{gains(k)[1]}"/>' for k, joint in enumerate(joints)
    )
    root = next(link for link in links if link["parent"] is None)
    solver = 'noslip_iterations="100" noslip_tolerance="1e-12" tolerance="1e-12"' if noslip else ""
    return (
        f'<mujoco model="{name}"><compiler angle="radian" balanceinertia="false" boundmass="0"/>'
        f'<option timestep="{STEP}" solver="Newton" cone="elliptic" {solver}/>'
        f'<default><geom condim="3" friction="0.8 0.005 0.0001"/></default>'
        f'<worldbody><geom type="plane" size="5 5 0.1" contype="1" conaffinity="2"/>'
        f"{body(links, root, feet, height)}</worldbody><actuator>{actuators}</actuator></mujoco>"
    )


def stand(name, feet, height, gains, angles, noslip):
    robot = mujoco.MjModel.from_xml_string(scene(name, feet, height, gains, noslip))
    data = mujoco.MjData(robot)
    data.qpos[7:] = angles
    data.ctrl[:] = angles
    mujoco.mj_forward(robot, data)
    touching = [k for k in range(robot.ngeom) if robot.geom_type[k] != mujoco.mjtGeom.mjGEOM_PLANE]
    radius = robot.geom_size[touching, 0]
    data.qpos[2] -= (data.geom_xpos[touching, 2] - radius).min()
    times, start, lowest = [], None, 0.0
    for batch in range(COUNT // BATCH):
        if batch * BATCH == 2 * COUNT // 3:
            mujoco.mj_kinematics(robot, data)
            start = data.geom_xpos[touching].copy()
        before = time.perf_counter()
        mujoco.mj_step(robot, data, nstep=BATCH)
        times.append(1e6 * (time.perf_counter() - before) / BATCH)
        if start is not None:
            lowest = min([lowest, *data.contact.dist])
    way = np.abs(data.geom_xpos[touching] - start).max()
    low, half, high = np.percentile(times, [25, 50, 75])
    solver = "NoSlip" if noslip else "Newton"
    print(
        f"{name}, {solver}: {half:.2f} µs a step ({low:.2f} to {high:.2f}); lowest gap {lowest:.0e} m, feet move "
        f"{way:.0e} m in a second; {data.ncon} contacts, base at {data.qpos[2]:.3f} m"
    )


def sphere(x, y, z, radius):
    return f'<geom type="sphere" size="{radius}" pos="{text(x, y, z)}" contype="2" conaffinity="1" mass="0"/>'


def anymal(stand, **options):
    feet = {
        f"{side}{end}_KFE": sphere(x, y, -0.33797, 0.031)
        for side, y in [("L", 0.01305), ("R", -0.01305)]
        for end, x in [("F", 0.033), ("H", -0.033)]
    }
    leg = [0.0, 0.6, -1.1]
    angles = [sign * angle for sign in [1, -1, 1, -1] for angle in leg]
    stand("anymal", feet, 0.6, lambda k: (200.0, 4.0), angles, **options)


def talos(stand, **options):
    corners = "".join(sphere(x, y, -0.107, 1e-6) for x in [-0.1, 0.1] for y in [-0.06, 0.06])
    feet = {"leg_left_6_joint": corners, "leg_right_6_joint": corners}
    angles = np.zeros(32)
    for leg in [0, 6]:
        angles[leg + 2 : leg + 5] = [-0.4, 0.8, -0.4]

    def gains(k):
        if k < 14:
            return 2000.0, 20.0
        if k in (21, 29):
            return 5.0, 0.05
        return (100.0, 1.0) if k < 30 else (20.0, 0.2)

    stand("talos", feet, 1.1, gains, angles, **options)


if __name__ == "__main__":
    print(f"MuJoCo {mujoco.__version__}, {sys.version.split()[0]}")
    for noslip in [False, True]:
        anymal(stand, noslip=noslip)
        talos(stand, noslip=noslip)
