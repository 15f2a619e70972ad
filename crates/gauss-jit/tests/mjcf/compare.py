"""States of scenes beside MuJoCo's: accelerations, the kinetic energy, which its mass matrix makes, and gaps."""

import json
import sys

import mujoco
import numpy as np

# A document is right to 2e-16 of its largest numbers, and a mass matrix of condition 1e5, as of legs on a trunk, loses
# five digits of that. A particle on joints has 1e-14 kg m² in the place of 0, beside moments of 1e-3 and more.
ROUNDING = 1e-10
POINT = 1e-6

wrong = []
for scene in json.load(open(sys.argv[1])):
    try:
        model = mujoco.MjModel.from_xml_string(scene["xml"])
    except ValueError as error:
        wrong.append(f"{scene['name']}: {error}\n{scene['xml']}")
        continue
    # What is soft in MuJoCo is not compared.
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data, largest, gaps = mujoco.MjData(model), 0.0, 0
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
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        energy = data.qvel @ mass @ data.qvel / 2
        found = np.abs(data.qacc - expected).max() / (1 + np.abs(expected).max())
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
    print(f"{scene['name']}: {largest:.1e}" + (f", with {gaps} gaps" if gaps else ""))
    if not largest <= ROUNDING:
        wrong.append(f"{scene['name']} differs by {largest}")
if wrong:
    sys.exit("\n".join(wrong))
print("compared")
