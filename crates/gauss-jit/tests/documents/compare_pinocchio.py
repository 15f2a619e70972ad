"""States of scenes beside Pinocchio's: accelerations by its mass matrix and its inverse dynamics, and kinetic energies."""

import json
import re
import sys
from xml.etree import ElementTree

import numpy as np
import pinocchio

# A document is right to 2e-16 of its largest numbers, and a mass matrix of condition 1e5, as of legs on a trunk, loses
# five digits of that.
ROUNDING = 1e-10

wrong = []
for scene in json.load(open(sys.argv[1])):
    model = pinocchio.buildModelFromXML(scene["xml"], mimic=True)
    # Gravity and rotors are in comments and transmissions.
    gravity = re.search(r"gravity is lost, \(([^)]*)\)", scene["xml"])
    model.gravity.linear = np.array([float(x) for x in gravity[1].split(",")]) if gravity else np.zeros(3)
    armature = np.zeros(model.nv)
    for own in ElementTree.fromstring(scene["xml"]).iter("transmission"):
        rotor, gear = own.findtext("actuator/rotorInertia"), float(own.findtext("actuator/mechanicalReduction"))
        if rotor is not None:
            armature[model.joints[model.getJointId(own.find("joint").get("name"))].idx_v] += float(rotor) * gear**2
    data, largest = model.createData(), 0.0
    for state in scene["states"]:
        q, v, expected, forces = pinocchio.neutral(model), *np.zeros((3, model.nv))
        for name, place, rates, accelerations, own in state["joints"]:
            joint = model.joints[model.getJointId(name)]
            if len(place) == 7:
                place = place[:3] + place[4:] + place[3:4]
            elif joint.nq == 2:
                place = [np.cos(place[0]), np.sin(place[0])]
            q[joint.idx_q : joint.idx_q + joint.nq] = place
            for to, numbers in (v, rates), (expected, accelerations), (forces, own):
                to[joint.idx_v : joint.idx_v + joint.nv] = numbers
        mass = pinocchio.crba(model, data, q).copy()
        mass = np.triu(mass) + np.triu(mass, 1).T + np.diag(armature)
        bias = pinocchio.rnea(model, data, q, v, np.zeros(model.nv))
        found = np.linalg.solve(mass, forces - bias)
        energy = v @ mass @ v / 2
        apart = np.abs(found - expected).max() / (1 + np.abs(expected).max())
        largest = max(largest, apart, abs(energy - state["energy"]) / (1 + energy))
    print(f"{scene['name']}: {largest:.1e}")
    if not largest <= ROUNDING:
        wrong.append(f"{scene['name']} differs by {largest}")
if wrong:
    sys.exit("\n".join(wrong))
print("compared")
