"""The numbers of the scenes, from the files that everything reads: SI units, angles in radians."""

import json
from pathlib import Path

_HERE = Path(__file__).resolve().parent
_DATA = json.loads((_HERE / "scenes.json").read_text())
GRAVITY = 9.81

S1, S2, S3, S4, S5, S6 = (_DATA[name] for name in ("S1", "S2", "S3", "S4", "S5", "S6"))

# Lengths of what a function reads and writes. A body: unit quaternion x y z w (body to space), position of O, then (u, omega) in body axes.
# Otherwise the coordinates, then their rates.
SIZES = {"s1": (13, 6), "s2": (13, 6), "s3": (13, 6), "s4": (6, 3), "s5": (4, 2), "s5_jointed": (4, 2), "s6": (4, 2), "s7": (14, 7)}

# Robots: the file of tests/robots, and how many numbers the configuration and the speeds have. Their functions `NAME_forward` and `NAME_inverse` read
# (position of O and unit quaternion x y z w of a base that floats, joints), the speeds (u, omega in body axes, joints), and forces or accelerations.
ROBOTS = {"s7_fingers": ("panda", 9, 9), "s8": ("anymal", 19, 18), "s9": ("talos", 39, 38)}
SIZES |= {f"{name}_{what}": (nq + 2 * nv, nv) for name, (_, nq, nv) in ROBOTS.items() for what in ("forward", "inverse")}


def about_pole(mass, c, inertia):
    """Inertia about O of a body with the tensor `inertia` about its centre of mass `c` (Steiner)."""
    square = sum(x * x for x in c)
    return [[inertia[i][j] + mass * ((square if i == j else 0.0) - c[i] * c[j]) for j in range(3)] for i in range(3)]


def diagonal(moments):
    return [[moments[i] if i == j else 0.0 for j in range(3)] for i in range(3)]


def _link(described):
    named = described["inertia_about_center_of_mass"]
    rows = [["ixx", "ixy", "ixz"], ["ixy", "iyy", "iyz"], ["ixz", "iyz", "izz"]]
    # All fixed turns of this arm are quarter turns about the first axis; an inertia is given in the axes of its link.
    assert described["origin_rpy"][1:] == [0.0, 0.0] and described["inertia_rpy"] == [0.0] * 3 and described["axis"] == [0.0, 0.0, 1.0]
    return {
        "position": described["origin_xyz"],
        # 0, 1 or -1 quarter turns about x, then the joint's turn about z.
        "quarter_turns": round(described["origin_rpy"][0] / 1.5707963267948966),
        "mass": described["mass"],
        "center": described["center_of_mass"],
        "inertia": [[named[name] for name in row] for row in rows],
    }


S7 = [_link(link) for link in json.loads((_HERE / "../../tests/data/panda_chain.json").read_text())["links"]]


def robot(name):
    """Links of a robot, a parent by its index or None: rotation and position in the parent, without what rounding left of quarter turns."""
    described = json.loads((_HERE / f"../../tests/robots/{ROBOTS[name][0]}.json").read_text())["links"]
    places = {link["name"]: k for k, link in enumerate(described)}
    settled = lambda x: float(round(x)) if abs(x - round(x)) < 1e-15 else x  # noqa: E731
    rows = [["ixx", "ixy", "ixz"], ["ixy", "iyy", "iyz"], ["ixz", "iyz", "izz"]]
    return [
        {
            "parent": places.get(link["parent"]),
            "joint": link["joint"],
            "axis": [settled(x) for x in link.get("axis") or []],
            "rotation": [[settled(x) for x in row] for row in link.get("rotation") or diagonal([1.0, 1.0, 1.0])],
            "position": link.get("position") or [0.0, 0.0, 0.0],
            "mass": link["mass"],
            "center": link["center_of_mass"],
            "inertia": [[link["inertia_about_center_of_mass"][one] for one in row] for row in rows],
        }
        for link in described
    ]
