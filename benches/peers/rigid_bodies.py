"""The scenes as lists of bodies, for simulators: `python rigid_bodies.py FOLDER` writes `models.hpp` and `models_xml.h`."""

import sys
from pathlib import Path

from scenes import GRAVITY, ROBOTS, S1, S2, S4, S5, S6, S7, diagonal, robot

X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def body(joints, mass, center, inertia, position=(0.0, 0.0, 0.0), quarter_turns=0, inside=True):
    """`joints`: "free", or pairs of a kind and an axis; `quarter_turns`: about x, before the joints; `inside` the body before it."""
    return locals()


def models():
    upper, lower = S5["links"]
    pole = S6["pole"]
    ball = lambda moment: diagonal([float(moment)] * 3)  # noqa: E731  (planar: the other moments do not enter)
    swing = [("hinge", Y)]
    pendulum = [
        body(swing, upper["mass"], [0, 0, -upper["center"]], ball(upper["inertia"])),
        body(swing, lower["mass"], [0, 0, -lower["center"]], ball(lower["inertia"]), (0.0, 0.0, -upper["length"])),
    ]
    return {
        "s1": [body("free", S1["mass"], [0, 0, 0], diagonal(S1["inertia"]))],
        "s2": [body("free", S2["mass"], S2["center_of_mass"], S2["inertia"])],
        "s4": [body([("hinge", Z), ("hinge", X), ("hinge", Z)], S4["mass"], S4["center_of_mass"], diagonal(S4["inertia"]))],
        # The angles are those of a right-handed turn about y with the other sign: the functions convert them.
        "s5_jointed": pendulum,
        "s6": [
            body([("slide", X)], S6["cart"], [0, 0, 0], ball(1.0)),
            body([("hinge", Y)], pole["mass"], [0, 0, pole["center"]], ball(pole["inertia"])),
        ],
        "s7": [body([("hinge", Z)], k["mass"], k["center"], k["inertia"], k["position"], k["quarter_turns"]) for k in S7],
    }


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def xml(name, bodies):
    text, ends = "", ""
    for index, b in enumerate(bodies):
        half = 0.7071067811865476
        turn = {0: "1 0 0 0", 1: f"{half} {half} 0 0", -1: f"{half} {-half} 0 0"}[b["quarter_turns"]]
        i = b["inertia"]
        moments = numbers([i[0][0], i[1][1], i[2][2], i[0][1], i[0][2], i[1][2]])
        text += f"<body name='b{index}' pos='{numbers(b['position'])}' quat='{turn}'>"
        text += f"<inertial pos='{numbers(b['center'])}' mass='{b['mass']}' fullinertia='{moments}'/>"
        if b["joints"] == "free":
            text += "<freejoint/>"
        else:
            text += "".join(f"<joint type='{kind}' axis='{numbers(axis)}'/>" for kind, axis in b["joints"])
        ends += "</body>"
    gravity = 0.0 if name == "s1" else -GRAVITY
    return world(gravity, text + ends)


def world(gravity, bodies):
    # All that a scene without contacts and constraints does not need is switched off.
    return (
        f"<mujoco><compiler angle='radian'/><option gravity='0 0 {gravity}'>"
        "<flag constraint='disable' contact='disable' sensor='disable' actuation='disable'/></option>"
        f"<worldbody>{bodies}</worldbody></mujoco>"
    )


def calls(name, bodies):
    """The same for Pinocchio: `add` is that of `pinocchio_models.hpp`."""
    lines = []
    for b in bodies:
        center, inertia = numbers(b["center"]).replace(" ", ", "), numbers(sum(b["inertia"], [])).replace(" ", ", ")
        position = numbers(b["position"]).replace(" ", ", ")
        joints = ["Free"] if b["joints"] == "free" else [joint(kind, axis) for kind, axis in b["joints"]]
        for k, one in enumerate(joints):
            place = f"{{{position}}}, {b['quarter_turns']}" if k == 0 else "{0, 0, 0}, 0"
            mass = b["mass"] if k == len(joints) - 1 else 0.0
            lines.append(f"  add(model, Kind::{one}, {place}, {mass!r}, {{{center}}}, {{{inertia}}});")
    gravity = 0.0 if name == "s1" else -GRAVITY
    body_text = "\n".join(lines)
    return f"inline void build_{name}(pinocchio::Model &model) {{\n{body_text}\n  model.gravity.linear() << 0, 0, {gravity};\n}}\n"


def joint(kind, axis):
    letter = "XYZ"[[abs(a) for a in axis].index(1)]
    return ("Slide" if kind == "slide" else "Turn") + letter


def robot_calls(name, links):
    """A robot for Pinocchio: `place` is that of `pinocchio_models.hpp`."""
    listed = lambda values: "{" + numbers(values).replace(" ", ", ") + "}"  # noqa: E731
    lines = []
    for link in links:
        # Joints of Pinocchio are counted from 1, the universe is 0.
        parent = 0 if link["parent"] is None else link["parent"] + 1
        kind = {"floating": "Free", "revolute": "Turn", "prismatic": "Slide"}[link["joint"]]
        lines.append(
            f"  place(model, {parent}, Kind::{kind}, {listed(link['axis'] or [0, 0, 0])}, {listed(sum(link['rotation'], []))}, {listed(link['position'])}, "
            f"{link['mass']!r}, {listed(link['center'])}, {listed(sum(link['inertia'], []))});"
        )
    body_text = "\n".join(lines)
    return f"inline void build_{name}(pinocchio::Model &model) {{\n{body_text}\n  model.gravity.linear() << 0, 0, {-GRAVITY};\n}}\n"


def quaternion(r):
    """w x y z of a rotation matrix, by its largest component."""
    w, x, y, z = 1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2], 1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]
    products = {
        "w": [w, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]],
        "x": [r[2][1] - r[1][2], x, r[0][1] + r[1][0], r[0][2] + r[2][0]],
        "y": [r[0][2] - r[2][0], r[0][1] + r[1][0], y, r[1][2] + r[2][1]],
        "z": [r[1][0] - r[0][1], r[0][2] + r[2][0], r[1][2] + r[2][1], z],
    }
    largest = max((w, "w"), (x, "x"), (y, "y"), (z, "z"))[1]
    length = sum(c * c for c in products[largest]) ** 0.5
    return [c / length for c in products[largest]]


def robot_xml(links):
    def body_of(index):
        link = links[index]
        i = link["inertia"]
        moments = numbers([i[0][0], i[1][1], i[2][2], i[0][1], i[0][2], i[1][2]])
        text = f"<body name='b{index}' pos='{numbers(link['position'])}' quat='{numbers(quaternion(link['rotation']))}'>"
        text += f"<inertial pos='{numbers(link['center'])}' mass='{link['mass']}' fullinertia='{moments}'/>"
        kind = {"floating": None, "revolute": "hinge", "prismatic": "slide"}[link["joint"]]
        text += "<freejoint/>" if kind is None else f"<joint type='{kind}' axis='{numbers(link['axis'])}'/>"
        return text + "".join(body_of(k) for k, other in enumerate(links) if other["parent"] == index) + "</body>"

    return world(-GRAVITY, "".join(body_of(k) for k, link in enumerate(links) if link["parent"] is None))


def main():
    folder = Path(sys.argv[1])
    described, robots = models(), {name: robot(name) for name in ROBOTS}
    built = [calls(name, bodies) for name, bodies in described.items()] + [robot_calls(name, links) for name, links in robots.items()]
    (folder / "models.hpp").write_text("".join(built))
    written = {name: xml(name, bodies) for name, bodies in described.items()} | {name: robot_xml(links) for name, links in robots.items()}
    texts = "".join(f'static const char *const xml_{name} = "{text}";\n' for name, text in written.items())
    (folder / "models_xml.h").write_text(texts)


if __name__ == "__main__":
    main()
