"""States of scenes beside MuJoCo's: accelerations, the kinetic energy, which its mass matrix makes, and gaps."""

import json
import sys

import mujoco
import numpy as np

# A document is right to 2e-16 of its largest numbers, and a mass matrix of condition 1e5, as of legs on a trunk, loses
# five digits of that. A particle on joints has 1e-14 kg m² in the place of 0, beside moments of 1e-3 and more.
ROUNDING = 1e-10
POINT = 1e-6

# A constraint of the impedance d leaves 1 - d of what it takes away of the acceleration; of several that share joints
# each row has its own part.
IMPEDANCE = 0.9999
LEFT = 10 * (1 - IMPEDANCE)

flags = mujoco.mjtDisableBit
SOFT = flags.mjDSBL_CONTACT | flags.mjDSBL_LIMIT | flags.mjDSBL_FRICTIONLOSS


def couplings(model):
    """Joints that follow others, with these and their polynomials."""
    of_joints = model.eq_type == mujoco.mjtEq.mjEQ_JOINT
    return list(zip(model.eq_obj1id[of_joints], model.eq_obj2id[of_joints], model.eq_data[of_joints]))


def followers(model):
    """Rates of all joints by those that follow none."""
    rates = np.eye(model.nv)
    for one, other, data in couplings(model):
        rates[model.jnt_dofadr[one]] = data[1] * rates[model.jnt_dofadr[other]]
    return rates


wrong = []
for scene in json.load(open(sys.argv[1])):
    try:
        model = mujoco.MjModel.from_xml_string(scene["xml"])
    except ValueError as error:
        wrong.append(f"{scene['name']}: {error}\n{scene['xml']}")
        continue
    model.eq_solimp[:, :2] = IMPEDANCE
    data, largest, gaps, soft = mujoco.MjData(model), 0.0, 0, 0.0
    by_free = followers(model)
    for state in scene["states"]:
        expected = np.zeros(model.nv)
        for name, place, rates, accelerations in state["joints"]:
            joint = model.joint(name)
            q, v = joint.qposadr[0], joint.dofadr[0]
            data.qpos[q : q + len(place)] = place
            data.qvel[v : v + len(rates)] = rates
            expected[v : v + len(rates)] = accelerations
        for name, value in zip(scene["inputs"], state["u"]):
            data.ctrl[model.actuator(name).id] = value
        for one, other, polynomial in couplings(model):
            data.qpos[model.jnt_qposadr[one]] = polynomial[1] * data.qpos[model.jnt_qposadr[other]]
        data.qvel, expected = by_free @ data.qvel, by_free @ expected
        # What is soft in MuJoCo is left out.
        model.opt.disableflags = flags.mjDSBL_CONSTRAINT
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        energy = data.qvel @ mass @ data.qvel / 2
        size, found = 1 + np.abs(expected).max(), data.qacc.copy()
        if model.neq > 0:
            model.opt.disableflags = SOFT
            mujoco.mj_forward(model, data)
            # Equalities that are held exactly, by multipliers, and by MuJoCo, which leaves out the derivative of J: of
            # loops that move J q̈ is taken as it is.
            rows = data.efc_J.reshape(-1, model.nv)
            away = rows @ expected
            zero = [data.efc_pos, rows @ data.qvel]
            if len(couplings(model)) == model.neq or not data.qvel.any():
                zero.append(away)
                soft = max(soft, np.abs(data.qacc - expected).max() / (size + np.abs(found - expected).max()))
            apart = np.abs(np.concatenate(zero)).max() / (size + np.abs(data.qpos).max() + np.abs(data.qvel).max())
            exact = np.block([[mass, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
            free = data.qfrc_passive + data.qfrc_actuator - data.qfrc_bias
            held = np.linalg.lstsq(exact, np.concatenate([free, away]), rcond=1e-12)[0][: model.nv]
            largest = max(largest, apart)
            found = held
        found = np.abs(found - expected).max() / size
        largest = max(largest, found, abs(energy - state["energy"]) / (1 + energy))
        for name, gap in state["gaps"]:
            pair = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_PAIR, name)
            # Ranges and dry friction are no pairs.
            if pair >= 0:
                plane, sphere = model.pair_geom1[pair], model.pair_geom2[pair]
                distance = mujoco.mj_geomDistance(model, data, plane, sphere, 100, None)
                # Points are spheres of a millionth.
                distance += POINT if model.geom_size[sphere][0] == POINT else 0
                largest, gaps = max(largest, abs(distance - gap)), gaps + 1
    more = (f", with {gaps} gaps" if gaps else "") + (f", by soft equalities {soft:.1e}" if model.neq > 0 else "")
    print(f"{scene['name']}: {largest:.1e}{more}")
    if not (largest <= ROUNDING and soft <= LEFT):
        wrong.append(f"{scene['name']} differs by {largest} and {soft}")
if wrong:
    sys.exit("\n".join(wrong))
print("compared")
