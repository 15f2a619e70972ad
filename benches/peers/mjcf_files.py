"""MJCF files beside MuJoCo: `python mjcf_files.py [WORD…]`, WORD a part of a path as in robots.py.

Models of dm_control (its suite), gymnasium and pybullet (requirements-robots.txt), most of them without <inertial>:
masses come from the geoms. At random states the mass matrix and inverse dynamics with springs, dampers and armature are
compared; contacts, limits, dry friction and the surrounding fluid act in neither.
"""

import sys

import mujoco
import numpy as np
from robots import EPSILON, MOST, SITE, Comparison, Ours

FOLDERS = ["dm_control/suite", "dm_control/third_party", "gymnasium/envs/mujoco/assets", "pybullet_data/mjcf"]
# What is read without something that counts, and says so.
NAMED = {
    "dog": "masses of meshes are not read",
    "jaco_arm": "masses of meshes are not read",
    "jaco_hand": "masses of meshes are not read",
}
STATES = 6
FREE, BALL = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)


def unit(random):
    turn = random.normal(size=4)
    return turn / np.linalg.norm(turn)


class State:
    """Of every joint its coordinates, of rotations x y z w; rotations and poses stand before all others."""

    def __init__(self, model, random):
        self.model, self.speeds, self.rates = model, random.normal(size=model.nv), random.normal(size=model.nv)
        self.turns = {k: unit(random) for k in range(model.njnt) if model.jnt_type[k] in (FREE, BALL)}
        self.places = {k: random.normal(size=3) for k in self.turns if model.jnt_type[k] == FREE}
        self.scalars = {k: random.uniform(-1.5, 1.5) for k in range(model.njnt) if k not in self.turns}

    def parts(self):
        groups = [[*turn, *self.places.get(k, [])] for k, turn in self.turns.items()]
        return [[0.0], [*sum(groups, []), *self.scalars.values()], self.speeds, self.rates, []]

    def answers(self, data):
        """Mass matrix and forces, with velocities of free bodies in their own axes."""
        model, q, axes, drift = self.model, self.model.qpos0.copy(), np.eye(self.model.nv), np.zeros(self.model.nv)
        for k, turn in self.turns.items():
            start, v = model.jnt_qposadr[k], model.jnt_dofadr[k]
            start += 3 if k in self.places else 0
            q[start : start + 4] = np.roll(turn, 1)
            if k in self.places:
                q[start - 3 : start] = self.places[k]
                matrix = np.zeros(9)
                mujoco.mju_quat2Mat(matrix, np.roll(turn, 1))
                axes[v : v + 3, v : v + 3] = matrix.reshape(3, 3)
                drift[v : v + 3] = matrix.reshape(3, 3) @ np.cross(self.speeds[v + 3 : v + 6], self.speeds[v : v + 3])
        for k, value in self.scalars.items():
            q[model.jnt_qposadr[k]] = value
        data.qpos[:], data.qvel[:], data.qacc[:] = q, axes @ self.speeds, axes @ self.rates + drift
        mujoco.mj_inverse(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        return axes.T @ mass @ axes, axes.T @ data.qfrc_inverse


def study(file):
    if file.stem in NAMED:
        return f"left out: {NAMED[file.stem]}"
    try:
        model = mujoco.MjModel.from_xml_path(str(file))
    except ValueError as error:
        return f"left out: MuJoCo refuses it: {error}".splitlines()[0]
    if model.nv == 0 or model.neq > 0:
        return "left out: nothing moves" if model.nv == 0 else "left out: joints or bodies are tied"
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    model.opt.density = model.opt.viscosity = 0.0
    random, data, comparison = np.random.default_rng(model.nv), mujoco.MjData(model), Comparison()
    states = [State(model, random) for _ in range(STATES)]
    try:
        ours = Ours(None, file, states, clauses=["inputs=none"])
        for state, at in zip(states, ours.at):
            mass, forces = state.answers(data)
            comparison.mass("mass_matrix", at["mass_matrix"], mass)
            comparison.forces("inverse", at["gauss_residual"], forces, mass, np.zeros(model.nv))
    except ValueError as error:
        return f"WRONG {error}".splitlines()[0]
    worst = ", ".join(f"{name} {value:.1f} ε" for name, value in comparison.worst.items())
    sums = {name: sum(counts[:2]) for name, counts in ours.operations.items()}
    shown = f"{model.nv} degrees of freedom, {sums['acceleration']} and {sums['gauss_residual']} operations: {worst}"
    right = all(value <= MOST["mjcf"] for value in comparison.worst.values())
    return shown if right else f"WRONG {shown}"


def main():
    words, wrong = sys.argv[1:], 0
    for folder in FOLDERS:
        for file in sorted((SITE / folder).rglob("*.xml")):
            if not words or any(word in str(file) for word in words):
                said = study(file)
                wrong += said.startswith("WRONG")
                print(f"{file.relative_to(SITE)}: {said}", flush=True)
    print(f"{wrong} wrong, in units of ε = {EPSILON:.1e}")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
