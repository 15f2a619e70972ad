"""Scenes of examples/contact_scenes in MuJoCo and Drake: that program starts this one, and asks it line by line.

The first line has the scenes: starts, gains, targets and sizes are those of the program that asks, links those of
tests/robots. The answer has the names of the programs for each. Then come `[scene, program, what, number]`: to
`restart`, for the microseconds a step of a `batch`, for the `quality` of a whole run. MuJoCo: Newton's solver with
elliptic cones, and the same with a tolerance of 1e-12 and a hundred iterations of NoSlip. Drake, where it is installed:
contact_scenes_drake.py. Steps between targets are counted by the loops of these programs.
"""

import importlib.util
import json
import sys
import time

import mujoco
import numpy as np

from contact_steps import ROBOTS, body, sphere, text

STAYS = 'contype="1" conaffinity="2"'


def links_of(name):
    links = json.loads((ROBOTS / f"{name}.json").read_text())["links"]
    return links, next(link for link in links if link["parent"] is None)


def anymal(scene):
    """Bodies, and the joints that are led."""
    links, root = links_of("anymal")
    feet = {
        f"{side}{end}_KFE": sphere(x, y, -0.33797, 0.031)
        for side, y in [("L", 0.01305), ("R", -0.01305)]
        for end, x in [("F", 0.033), ("H", -0.033)]
    }
    ground = f'<geom type="plane" size="5 5 0.1" {STAYS}/>'
    return ground + body(links, root, feet, 0.0), [link["name"] for link in links if link["parent"] is not None]


def pusher(scene, corners=False):
    """The box on the plane by itself, or by spheres at its corners: for what knows one point of two shapes."""
    p = scene["parameters"]
    links, root = links_of("panda")
    tips = {f"panda_finger_joint{k}": sphere(0.0, 0.0, p["tip"], p["r"]) for k in [1, 2]}
    moment = p["m"] * p["a"] ** 2 / 6
    # The box touches the table and the tips, which do not touch the table: its corners do in the other program.
    half = p["a"] / 2
    below = "".join(sphere(x, y, -half, 1e-6) for x in [-half, half] for y in [-half, half]) if corners else ""
    cargo = (
        f'<geom name="table" type="plane" pos="0 0 {p["h"]}" size="5 5 0.1" contype="4" conaffinity="0"/>'
        f'<body name="free"><freejoint/><geom name="box" type="box" size="{text(*3 * [half])}" mass="0" contype="1" '
        f'conaffinity="6"/>{below}<inertial pos="0 0 0" mass="{p["m"]}" diaginertia="{text(*3 * [moment])}"/></body>'
    )
    return cargo + body(links, root, tips, 0.0), [link["name"] for link in links]


def hand(scene):
    p = scene["parameters"]
    names, fingers = [], ""
    for k in range(4):
        turn = k * np.pi / 2
        links = [("a", [0, 0, 0], "1 0 0", 0.0)]
        places = [[0, 0, 0], [0, 0, -p["lengths"][0]], [0, 0, -p["lengths"][1]]]
        links += [(name, at, "0 1 0", length) for name, at, length in zip("bcd", places, p["lengths"])]
        inside = sphere(0.0, 0.0, -p["lengths"][2], p["w"])
        for name, at, axis, length in reversed(links):
            moment = p["m"] * (length**2 / 12 if length else p["w"] ** 2)
            inside = (
                f'<body pos="{text(*at)}"><joint name="{name}{k}" axis="{axis}"/>'
                f'<inertial pos="{text(0, 0, -length / 2)}" mass="{p["m"]}" diaginertia="{text(*3 * [moment])}"/>'
                f"{inside}</body>"
            )
        at = (p["out"] * np.cos(turn), p["out"] * np.sin(turn), p["up"])
        quaternion = (np.cos(turn / 2), 0, 0, np.sin(turn / 2))
        fingers += f'<body pos="{text(*at)}" quat="{text(*quaternion)}">{inside}</body>'
        names += [f"{name}{k}" for name, *_ in links]
    moment = 0.4 * p["heavy"] * p["r"] ** 2
    ball = (
        f'<body name="free"><freejoint/><geom type="sphere" size="{p["r"]}" mass="0" {STAYS}/><inertial pos="0 0 0" '
        f'mass="{p["heavy"]}" diaginertia="{text(*3 * [moment])}"/></body>'
    )
    return ball + fingers, names


def model(scene, noslip, **options):
    """The MJCF, and the joints that are led."""
    bodies, joints = {"anymal": anymal, "pusher": pusher, "hand": hand}[scene["name"]](scene, **options)
    gains = zip(joints, scene["stiffness"], scene["damping"])
    actuators = "".join(f'<position joint="{joint}" kp="{k!r}" kv="{d!r}"/>' for joint, k, d in gains)
    solver = 'noslip_iterations="100" noslip_tolerance="1e-12" tolerance="1e-12"' if noslip else ""
    return (
        f'<mujoco model="{scene["name"]}"><compiler angle="radian" balanceinertia="false" boundmass="0"/>'
        f'<option timestep="{scene["step"]}" solver="Newton" cone="elliptic" gravity="0 0 -9.81" {solver}/>'
        f'<default><geom condim="3" friction="{scene["friction"]} 0.005 0.0001"/></default>'
        f"<worldbody>{bodies}</worldbody><actuator>{actuators}</actuator></mujoco>"
    ), joints


class MuJoCo:
    def __init__(self, scene, noslip):
        self.scene, self.name = scene, "MuJoCo, NoSlip" if noslip else "MuJoCo"
        file, joints = model(scene, noslip)
        self.model = mujoco.MjModel.from_xml_string(file)
        self.data = mujoco.MjData(self.model)
        free = self.model.joint(int(np.flatnonzero(self.model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)[0]))
        self.free = int(free.qposadr[0])
        self.places = [int(self.model.joint(name).qposadr[0]) for name in joints]
        self.rates = [int(self.model.joint(name).dofadr[0]) for name in joints]
        self.targets = np.array(scene["targets"])

    def restart(self):
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[self.free : self.free + 7] = self.scene["pose"]
        self.data.qpos[self.places] = self.scene["joints"]
        mujoco.mj_forward(self.model, self.data)

    def batch(self, number):
        each, held = self.scene["batch"], self.scene["held"]
        targets, control = self.targets[number * each : (number + 1) * each], self.data.ctrl
        before = time.perf_counter()
        for target in targets:
            control[:] = target
            mujoco.mj_step(self.model, self.data, nstep=held)
        return 1e6 * (time.perf_counter() - before) / (each * held)

    def energy(self):
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_energyPos(self.model, self.data)
        mujoco.mj_energyVel(self.model, self.data)
        return sum(self.data.energy)

    def slips(self):
        """Of the material points of spheres on the ground that bear a load, at the start of a step."""
        found, twist, force = [], np.zeros(6), np.zeros(6)
        for k in range(self.data.ncon):
            contact = self.data.contact[k]
            mujoco.mj_contactForce(self.model, self.data, k, force)
            if force[0] > 0.0:
                geom = max(contact.geom)
                mujoco.mj_objectVelocity(self.model, self.data, mujoco.mjtObj.mjOBJ_GEOM, geom, twist, 0)
                arm = contact.pos - self.data.geom_xpos[geom]
                found.append(np.linalg.norm((twist[3:] + np.cross(twist[:3], arm))[:2]))
        return found

    def quality(self):
        scene, data, work, done, lowest, slips = self.scene, self.data, 0.0, 0.0, 0.0, []
        self.restart()
        before, rested = self.energy(), None
        seconds = round(1 / (scene["step"] * scene["held"]))
        for n, target in enumerate(self.targets):
            if n + seconds == len(self.targets):
                rested = data.qpos[self.free : self.free + 3].copy()
            data.ctrl[:] = target
            for _ in range(scene["held"]):
                rates, joints = data.qvel.copy(), data.qpos[self.places]
                mujoco.mj_step(self.model, data)
                by_motors = data.qfrc_actuator[self.rates] * (data.qpos[self.places] - joints)
                by_contacts = 0.5 * scene["step"] * data.qfrc_constraint @ (rates + data.qvel)
                work += by_motors.sum() + by_contacts
                done += np.abs(by_motors).sum() + abs(by_contacts)
                lowest = min([lowest, *data.contact.dist])
                if scene["sticks"] == "feet":
                    slips += self.slips()
        end = data.qpos[self.free : self.free + 3]
        creep = np.median(slips) if scene["sticks"] == "feet" else np.linalg.norm(end - rested)
        unaccounted = abs(self.energy() - before - work) / done
        way = np.linalg.norm(end - scene["pose"][:3])
        return {"lowest": float(lowest), "creep": float(creep), "unaccounted": float(unaccounted), "way": float(way)}


def programs(scene):
    found = [MuJoCo(scene, False), MuJoCo(scene, True)]
    if importlib.util.find_spec("pydrake") is not None:
        from contact_scenes_drake import Drake

        options = {"corners": True} if scene["name"] == "pusher" else {}
        found.append(Drake(scene, *model(scene, False, **options)))
    return found


if __name__ == "__main__":
    matches = [programs(scene) for scene in json.loads(sys.stdin.readline())]
    print(json.dumps([[program.name for program in match] for match in matches]), flush=True)
    for line in sys.stdin:
        scene, program, what, number = json.loads(line)
        program = matches[scene][program]
        answer = program.batch(number) if what == "batch" else getattr(program, what)()
        print(json.dumps(answer), flush=True)
