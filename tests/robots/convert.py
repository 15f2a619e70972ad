#!/usr/bin/env python3
"""Links and joints of NAME.json as a URDF file, NAME.urdf: `python3 tests/robots/convert.py panda anymal talos`.

The numbers are those of the published descriptions that the key `source` names, read and merged by Pinocchio, which also made
the states beside them. A link is called like its joint, with `_link`; the root `base_link`.
"""

import json
import math
import pathlib
import sys


def angles(rotation):
    """Roll, pitch, yaw of R = Rz(yaw) Ry(pitch) Rx(roll), without what rounding left of zeros and quarter turns."""
    r = rotation
    pitch = math.atan2(-r[2][0], math.hypot(r[2][1], r[2][2]))
    if math.hypot(r[2][1], r[2][2]) > 1e-12:
        found = [math.atan2(r[2][1], r[2][2]), pitch, math.atan2(r[1][0], r[0][0])]
    else:
        found = [0.0, pitch, math.atan2(-r[0][1], r[1][1])]
    quarter = math.pi / 2
    settled = lambda angle: round(angle / quarter) * quarter
    return [settled(a) if abs(a - settled(a)) < 1e-15 else a for a in found]


def shown(numbers):
    return " ".join(repr(float(number) + 0.0) for number in numbers)


def link(name, described):
    if described is None:
        return [f'  <link name="{name}"/>']
    moments = " ".join(f'{entry}="{value!r}"' for entry, value in described["inertia_about_center_of_mass"].items())
    return [
        f'  <link name="{name}">',
        "    <inertial>",
        f'      <origin xyz="{shown(described["center_of_mass"])}"/>',
        f'      <mass value="{described["mass"]!r}"/>',
        f"      <inertia {moments}/>",
        "    </inertial>",
        "  </link>",
    ]


def joint(described, parent):
    return [
        f'  <joint name="{described["name"]}" type="{"continuous" if described["joint"] == "revolute" else "prismatic"}">',
        f'    <parent link="{parent}"/>',
        f'    <child link="{described["name"]}_link"/>',
        f'    <origin xyz="{shown(described["position"])}" rpy="{shown(angles(described["rotation"]))}"/>',
        f'    <axis xyz="{shown(described["axis"])}"/>',
        "  </joint>",
    ]


def convert(name):
    folder = pathlib.Path(__file__).parent
    robot = json.loads((folder / f"{name}.json").read_text())
    floating = robot["links"][0]["joint"] == "floating"
    lines = [
        '<?xml version="1.0"?>',
        f"<!-- {robot['source']}. Made from {name}.json by convert.py. -->",
        f'<robot name="{name}">',
        *link("base_link", robot["links"][0] if floating else None),
    ]
    for described in robot["links"][1 if floating else 0 :]:
        parent = described["parent"]
        at_base = parent is None or (floating and parent == robot["links"][0]["name"])
        lines += joint(described, "base_link" if at_base else f"{parent}_link")
        lines += link(f"{described['name']}_link", described)
    lines += ["</robot>", ""]
    (folder / f"{name}.urdf").write_text("\n".join(lines))


for argument in sys.argv[1:]:
    convert(argument)
