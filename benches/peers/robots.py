"""Robots from their files, beside Pinocchio and MuJoCo: `python robots.py [--csv FILE] [NAME…]`.

Every URDF file with inertia that the packages example-robot-data and pybullet carry (in the virtual environment of
install.sh, with `pip install -r requirements-robots.txt`) is read by gauss-codegen and by both simulators. At random states these
are compared: mass matrix, forward and inverse dynamics, momenta of all matter; poses, twists, Jacobians and bias
accelerations of every frame (Pinocchio); mass matrix and inverse dynamics again (MuJoCo). Names select files by a part
of their path. A table of what each costs and how far the answers are apart is written, in units of ε; the exit status
says whether all agree.

Nothing is compiled but the reader: programs are run by the interpreter of gauss-codegen (`--example robot -- --values`).
"""

import argparse
import csv
import multiprocessing
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import xml.etree.ElementTree as xml

import mujoco
import numpy as np
import pinocchio as pin

ROOT = pathlib.Path(__file__).resolve().parents[2]
READER = pathlib.Path(os.environ.get("ROBOT_READER", ROOT / "target/release/examples/robot"))
SITE = pathlib.Path(sysconfig.get_paths()["purelib"])
FOLDERS = [SITE / "cmeel.prefix/share/example-robot-data/robots", SITE / "pybullet_data"]
# Objects, a thousand random things, parts of robots.
LEFT_OUT = re.compile(r"random_urdfs|/xarm/(base|link)|/objects/|_com\.urdf|deform|cloth")
# What stands on legs or flies.
FLOATING = re.compile(
    r"/(a1|aliengo|alex|anymal|b1|bolt|borinot|centauro|g1|go1|go2|hector|hextilt|human|hyq|icub|iris|laikago|mini_cheetah|"
    r"quadruped|romeo|simple_humanoid|solo|talos_full|talos_reduced|vision60|spirit|minitaur|microtaur)[^/]*$"
)
EPSILON = np.finfo(float).eps
STATES = 6
GRAVITY = 9.81
# How far answers may be apart, in units of ε of what they are made of (see `Comparison`): each entry is a sum of some ten
# products of a joint and a state, over a chain of up to fifteen joints. MuJoCo turns inertias to their principal axes and
# stops at 1e-12 of them.
PINOCCHIO = ("mass_matrix", "inverse", "forward", "whole", "frames")
MUJOCO = ("mujoco", "mjcf")
MOST = dict.fromkeys(PINOCCHIO, 150) | dict.fromkeys(MUJOCO, 5e4)
# Some links have inertias that no body has; equations can be compared all the same.
WAIVE = "waive(triangle_inequality)"
# Files that are no URDF, or mean nothing.
MISTAKEN = {
    "alex_psyonic_hands": "joints mimic joints that are not there",
    "romeo": "fingers move that have no inertia",
    "romeo_laas_small": "grippers move that have no inertia",
    "bike": "commas between numbers",
    "husky": "numbers of environment variables",
    "microtaur": "four angles of three axes",
    "spirit40newer": "two axes of a joint",
    "humanoid": "no XML",
    "biped2d_pybullet": "no XML: blanks before its declaration",
    "diff_ring": "no XML: blanks before its declaration",
}


def files(words):
    found = sorted(file for folder in FOLDERS for file in folder.rglob("*.urdf"))
    found = [file for file in found if not LEFT_OUT.search(str(file))]
    return [file for file in found if not words or any(word in str(file) for word in words)]


class Robot:
    """A URDF file, of which what has no part in the motion is taken away."""

    def __init__(self, file):
        self.name = file.stem if len(file.stem) > 5 else f"{file.parent.name}/{file.stem}"
        # Blanks before the declaration, which some files have, are no XML.
        tree = xml.fromstring(file.read_text().strip())
        for link in tree.iter("link"):
            for part in link.findall("visual") + link.findall("collision"):
                link.remove(part)
        for part in [part for part in tree if part.tag not in ("link", "joint")]:
            tree.remove(part)
        for joint in tree.iter("joint"):
            if joint.find("limit") is None and joint.get("type") in ("revolute", "prismatic"):
                xml.SubElement(joint, "limit", {"effort": "0", "velocity": "0", "lower": "-9", "upper": "9"})
        self.tree = tree
        self.floating = bool(FLOATING.search(str(file).removeprefix(str(SITE))))
        self.links = [link.get("name") for link in tree.iter("link")]
        self.moving = [joint for joint in tree.iter("joint") if joint.get("type") != "fixed"]
        self.own = [joint.get("name") for joint in self.moving if joint.find("mimic") is None]
        self.kinds = {joint.get("type") for joint in self.moving}

    def has_inertia(self):
        return bool(self.own) and any(True for _ in self.tree.iter("inertial"))

    def couplings(self):
        """Of each moving joint: the index of the one that it follows, the multiplier, the offset."""
        joints = {joint.get("name"): joint for joint in self.moving}

        def of(name):
            mimic = joints[name].find("mimic")
            if mimic is None:
                return self.own.index(name), 1.0, 0.0
            leader, factor, offset = of(mimic.get("joint"))
            own = float(mimic.get("multiplier", 1))
            return leader, own * factor, own * offset + float(mimic.get("offset", 0))

        return {name: of(name) for name in joints}

    def text(self):
        return xml.tostring(self.tree, encoding="unicode")


class Ours:
    """What gauss-codegen makes of the file: costs, and the answers of every method at states."""

    def __init__(self, robot, file, states, frames=(), clauses=()):
        clauses = [*clauses, "joint_friction=none", "limits=none", "limit=5000000", "methods(centroidal)", WAIVE]
        if not str(file).endswith(".xml"):
            clauses += [f"gravity={GRAVITY}", f"base={'floating' if robot.floating else 'fixed'}"]
        clauses += [f"frames({', '.join(frames)})"] if frames else []
        lines = "".join(" | ".join(" ".join(repr(float(x)) for x in part) for part in state.parts()) + "\n" for state in states)
        run = subprocess.run([READER, file, *clauses, "--values"], input=lines, capture_output=True, text=True, timeout=600)
        if run.returncode:
            raise ValueError(run.stderr.strip())
        head, *answers = run.stdout.rstrip("\n").split("\n\n")
        head = [line.split(" ", 1) for line in head.splitlines()]
        self.seconds = float(dict(head)["seconds"])
        self.remarks = [rest for key, rest in head if key == "remark"]
        costs = [rest.split() for key, rest in head if key == "operations"]
        self.operations = {name: [int(count) for count in counts] for name, *counts in costs}
        split = [[line.split() for line in answer.splitlines()] for answer in answers]
        self.at = [{name: np.array(numbers, float) for name, *numbers in answer} for answer in split]

    def names_of_links(self, robot):
        changed = re.compile(r"the link `(.*)` is called `(.*)`")
        found = [changed.search(remark) for remark in self.remarks]
        names = {match[1]: match[2] for match in found if match}
        return {link: names.get(link, link) for link in robot.links}


class State:
    """Numbers of any size below one or so, angles of all sizes."""

    def __init__(self, robot, random):
        count = len(robot.own)
        self.q, self.v, self.a = random.uniform(-2.5, 2.5, count), random.normal(size=count), random.normal(size=count)
        self.effort = random.normal(size=count) * 3
        free = 6 if robot.floating else 0
        turn = random.normal(size=4)
        self.position, self.turn = random.normal(size=3), turn / np.linalg.norm(turn)
        self.speeds = np.concatenate([random.normal(size=free), self.v])
        self.rates = np.concatenate([random.normal(size=free), self.a])
        self.forces = np.concatenate([np.zeros(free), self.effort])
        self.base = np.concatenate([self.turn, self.position]) if free else np.zeros(0)

    def parts(self):
        return [[0.0], np.concatenate([self.base, self.q]), self.speeds, self.rates, self.effort]


def random_states(robot):
    """The same numbers every time."""
    random = np.random.default_rng(len(robot.own))
    return [State(robot, random) for _ in range(STATES)]


class Pinocchio:
    """The same by Pinocchio: its joints all move by themselves, and those that follow are then tied to the others."""

    def __init__(self, robot):
        free = [pin.JointModelFreeFlyer()] if robot.floating else []
        self.robot, self.model = robot, pin.buildModelFromXML(robot.text(), *free)
        self.model.gravity.linear = np.array([0.0, 0.0, -GRAVITY])
        self.data, offset = self.model.createData(), 6 if robot.floating else 0
        self.ties = np.zeros((self.model.nv, offset + len(robot.own)))
        self.ties[:offset, :offset] = np.eye(offset)
        for name, (leader, factor, _) in robot.couplings().items():
            self.ties[self.joint(name).idx_v, offset + leader] = factor

    def joint(self, name):
        return self.model.joints[self.model.getJointId(name)]

    def configuration(self, state):
        q = pin.neutral(self.model)
        if self.robot.floating:
            q[:7] = np.concatenate([state.position, state.turn])
        for name, (leader, factor, offset) in self.robot.couplings().items():
            joint, value = self.joint(name), factor * state.q[leader] + offset
            q[joint.idx_q : joint.idx_q + joint.nq] = [np.cos(value), np.sin(value)] if joint.nq == 2 else [value]
        return q

    def answers(self, state):
        model, data, ties = self.model, self.data, self.ties
        q, v = self.configuration(state), ties @ state.speeds
        drag = np.array([0.0] * model.nv)
        for joint in self.robot.moving:
            of = joint.find("dynamics")
            drag[self.joint(joint.get("name")).idx_v] = float(of.get("damping", 0)) if of is not None else 0.0
        mass = np.triu(pin.crba(model, data, q))
        mass = ties.T @ (mass + np.triu(mass, 1).T) @ ties
        loss = ties.T @ (drag * v)
        inverse = ties.T @ pin.rnea(model, data, q, v, ties @ state.rates) + loss
        if len(self.robot.own) == len(self.robot.moving):
            forward = pin.aba(model, data, q, v, ties @ (state.forces - loss))
            forward = ties.T @ forward
        else:
            bias = ties.T @ pin.rnea(model, data, q, v, np.zeros(model.nv))
            forward = np.linalg.solve(mass, state.forces - loss - bias)
        pin.computeCentroidalMomentum(model, data, q, v)
        center = data.com[0].copy()
        momentum = data.hg.vector.copy()
        pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        frames = {}
        for link in self.robot.links:
            frame = model.getFrameId(link, pin.FrameType.BODY)
            pose, axes = data.oMf[frame], pin.ReferenceFrame.LOCAL
            frames[link] = {
                "pose_of": np.concatenate([pose.translation, pose.rotation.ravel()]),
                "twist_of": pin.getFrameVelocity(model, data, frame, axes).vector,
                "jacobian_of": (pin.getFrameJacobian(model, data, frame, axes).reshape(6, -1) @ ties).ravel(),
                "bias_of": pin.getFrameClassicalAcceleration(model, data, frame, axes).vector,
            }
        whole = {"center_of_mass": center, "centroidal_momentum": momentum}
        return {"mass_matrix": mass, "inverse": inverse, "acceleration": forward, "frames": frames} | whole


class Comparison:
    """How far answers are apart, in units of ε: the worst of all states.

    Speeds are scaled by the roots of the diagonal of the mass matrix, so that rows of metres and of small angles count
    alike; forward dynamics are measured by the condition of that matrix as well, which any way of solving loses.
    """

    def __init__(self):
        self.worst = {}

    def note(self, name, difference):
        difference = float(difference) / EPSILON
        self.worst[name] = max(self.worst.get(name, 0.0), difference if np.isfinite(difference) else np.inf)

    def mass(self, name, ours, theirs):
        scale = np.sqrt(np.diag(theirs))
        self.note(name, np.max(np.abs(ours.reshape(theirs.shape) - theirs) / np.outer(scale, scale)))

    def forces(self, name, left, theirs, mass, given):
        """What is left of the equations is what the efforts that are given do not do."""
        scale = 1 / np.sqrt(np.diag(mass))
        size = np.max(scale * (np.abs(theirs) + np.abs(given)))
        self.note(name, np.max(np.abs(scale * (left + given - theirs))) / size)

    def rates(self, name, ours, theirs, mass):
        scale = np.sqrt(np.diag(mass))
        condition = np.linalg.cond(mass / np.outer(scale, scale))
        self.note(name, np.max(np.abs(scale * (ours - theirs))) / np.max(np.abs(scale * theirs)) / condition)

    def values(self, name, ours, theirs):
        self.note(name, np.max(np.abs(ours - theirs)) / max(1.0, np.max(np.abs(theirs))))


def with_pinocchio(robot, states, ours, framed, names, comparison):
    peer = Pinocchio(robot)
    for state, at, of_frames in zip(states, ours.at, framed.at):
        theirs = peer.answers(state)
        mass = theirs["mass_matrix"]
        comparison.mass("mass_matrix", at["mass_matrix"], mass)
        comparison.forces("inverse", at["gauss_residual"], theirs["inverse"], mass, state.forces)
        comparison.rates("forward", at["acceleration"], theirs["acceleration"], mass)
        for name in ("center_of_mass", "centroidal_momentum"):
            comparison.values("whole", at[name], theirs[name])
        for link, answers in theirs["frames"].items():
            for quantity, value in answers.items():
                comparison.values("frames", of_frames[f"{quantity}_{names[link]}"], value)


class Mujoco:
    """The same by MuJoCo, whose free joint has its velocity in observer's axes, and all of whose joints move by themselves."""

    def __init__(self, robot, model):
        self.robot, self.model, self.data = robot, model, mujoco.MjData(model)
        offset = 6 if robot.floating else 0
        self.ties = np.zeros((model.nv, offset + len(robot.own)))
        self.ties[:offset, :offset] = np.eye(offset)
        for name, (leader, factor, _) in robot.couplings().items():
            self.ties[model.joint(name).dofadr[0], offset + leader] = factor

    def answers(self, state):
        model, data, ties, free = self.model, self.data, self.ties.copy(), self.robot.floating
        q, drift = model.qpos0.copy(), np.zeros(model.nv)
        for name, (leader, factor, offset) in self.robot.couplings().items():
            q[model.joint(name).qposadr[0]] = factor * state.q[leader] + offset
        if free:
            q[:7] = np.concatenate([state.position, np.roll(state.turn, 1)])
            turn = pin.Quaternion(*np.roll(state.turn, 1)).toRotationMatrix()
            ties[:3, :3] = turn
            drift[:3] = turn @ np.cross(state.speeds[3:6], state.speeds[:3])
        data.qpos[:], data.qvel[:] = q, ties @ state.speeds
        mujoco.mj_forward(model, data)
        mass, forces = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
        mujoco.mj_fullM(model, data, mass)
        data.qacc[:] = ties @ state.rates + drift
        mujoco.mj_rne(model, data, 1, forces)
        return {"mass_matrix": ties.T @ mass @ ties, "inverse": ties.T @ (forces + model.dof_damping * data.qvel)}


def as_mujoco_reads(robot):
    """The URDF, nothing merged, moved or mended."""
    tree = xml.fromstring(robot.text())
    plain = {"fusestatic": "false", "balanceinertia": "false", "boundmass": "0", "boundinertia": "0"}
    xml.SubElement(xml.SubElement(tree, "mujoco"), "compiler", plain)
    specification = mujoco.MjSpec.from_string(xml.tostring(tree, encoding="unicode"))
    for equality in specification.equalities:
        specification.delete(equality)
    if robot.floating:
        specification.worldbody.first_body().add_freejoint()
    return specification, specification.compile()


class Rewritten:
    """The robot that MuJoCo writes: joints in the order of its tree, and none follows another."""

    def __init__(self, robot, model):
        names = [model.joint(k).name for k in range(model.njnt)]
        self.floating, self.own = robot.floating, [name for name in names if name in {j.get("name") for j in robot.moving}]

    def couplings(self):
        return {name: (k, 1.0, 0.0) for k, name in enumerate(self.own)}


def with_mujoco(robot, states, ours, comparison):
    """The URDF by both; then MuJoCo writes what it read as MJCF, and both read that."""
    specification, model = as_mujoco_reads(robot)
    compare_to_mujoco("mujoco", Mujoco(robot, model), states, ours, comparison)
    # Written in six digits: what counts is that both mean the same by it.
    text = specification.to_xml()
    model = mujoco.MjModel.from_xml_string(text)
    robot = Rewritten(robot, model)
    states = random_states(robot)
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(text)
        file.flush()
        ours = Ours(robot, file.name, states, clauses=["inputs=all"])
    compare_to_mujoco("mjcf", Mujoco(robot, model), states, ours, comparison)


def compare_to_mujoco(name, peer, states, ours, comparison):
    for state, at in zip(states, ours.at):
        theirs = peer.answers(state)
        mass = theirs["mass_matrix"]
        comparison.mass(name, at["mass_matrix"], mass)
        comparison.forces(name, at["gauss_residual"], theirs["inverse"], mass, state.forces)


def study(file):
    """A row of the table: costs and differences, or why there are none."""
    row = {"robot": called(file)}
    if file.stem in MISTAKEN:
        return row | {"left out": MISTAKEN[file.stem]}
    try:
        robot = Robot(file)
        if not robot.has_inertia():
            return row | {"left out": "nothing moves that has inertia"}
        if robot.kinds - {"revolute", "continuous", "prismatic"}:
            return row | {"left out": f"joints of kinds that are not compared: {', '.join(sorted(robot.kinds))}"}
        states = random_states(robot)
        ours = Ours(robot, file, states)
        names = ours.names_of_links(robot)
        framed = Ours(robot, file, states, list(names.values()))
        comparison = Comparison()
        with_pinocchio(robot, states, ours, framed, names, comparison)
        try:
            with_mujoco(robot, states, ours, comparison)
        except (ValueError, KeyError) as error:
            row["remark"] = f"MuJoCo: {error}".splitlines()[0]
        sums = {name: sum(counts[:2]) for name, counts in ours.operations.items()}
        row |= {"base": "floating" if robot.floating else "fixed", "degrees": len(states[0].speeds)}
        row |= {"links": len(robot.links), "sums forward": sums["acceleration"], "sums inverse": sums["gauss_residual"]}
        row |= {"expansion": ours.seconds} | comparison.worst
        apart = [name for name, value in comparison.worst.items() if not value <= MOST[name]]
        return row | ({"wrong": f"differs in {', '.join(apart)}"} if apart else {})
    except Exception as error:  # A table of fifty robots is finished whatever one of them does.
        return row | {"wrong": f"{type(error).__name__}: {error}".splitlines()[0]}


def called(file):
    """`talos_data/talos_reduced`: the folder of the package, and the file."""
    below = next(file.relative_to(folder) for folder in FOLDERS if file.is_relative_to(folder))
    folder = below.parts[0].removesuffix("_description") if len(below.parts) > 1 else "."
    return file.stem if folder in (".", file.stem) else f"{folder}/{file.stem}"


def markdown(rows):
    """One row for all files that are the same but for their names."""
    merged = {}
    for row in rows:
        if "base" in row:
            merged.setdefault(tuple(row[key] for key in ("base", "degrees", "sums forward", "sums inverse")), []).append(row)
    yield "| robot | base | degrees | links | forward | inverse | expansion, s | Pinocchio, ε | MuJoCo, ε |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for (base, degrees, forward, inverse), same in sorted(merged.items(), key=lambda item: item[1][0]["robot"].lower()):
        worst = lambda names: max((row[name] for row in same for name in names if name in row), default=None)
        pinocchio, simulator = worst(PINOCCHIO), worst(MUJOCO)
        shown = "refuses it" if simulator is None else f"{simulator:.0f}"
        others = f" and {len(same) - 1} more" if len(same) > 1 else ""
        seconds = min(row["expansion"] for row in same)
        yield (
            f"| {same[0]['robot']}{others} | {base} | {degrees} | {same[0]['links']} | {forward:,} | {inverse:,} "
            f"| {seconds:.2f} | {pinocchio:.0f} | {shown} |"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--csv", type=pathlib.Path, help="all figures")
    parser.add_argument("--markdown", type=pathlib.Path, help="the table of docs/benchmarks/robots.md")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()
    rows = []
    with multiprocessing.Pool(arguments.jobs, maxtasksperchild=1) as pool:
        for row in pool.imap(study, files(arguments.words)):
            rows.append(row)
            shown = (f"{value:.2f}" if isinstance(value, float) else str(value) for value in row.values())
            print(" | ".join(shown), flush=True)
    if arguments.csv:
        keys = list(dict.fromkeys(key for row in rows for key in row))
        with arguments.csv.open("w", newline="") as out:
            writer = csv.DictWriter(out, keys)
            writer.writeheader()
            writer.writerows(rows)
    if arguments.markdown:
        arguments.markdown.write_text("\n".join([*markdown(rows), ""]))
    compared = [row for row in rows if "left out" not in row]
    wrong = [row for row in compared if "wrong" in row]
    print(f"{len(compared)} files compared, {len(wrong)} wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
