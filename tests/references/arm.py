"""Forward dynamics of a seven-joint arm: recursive Newton–Euler in one arithmetic, maximal coordinates in another."""

import json
from decimal import Decimal
from fractions import Fraction

from arithmetic import Mpfr, Mpmath, as_mpmath
from multibody import Body, Coincide, Perpendicular, Point, System
from scene import DATA, nested, text
from vectors import (
    add,
    apply,
    apply_transposed,
    cross,
    dot,
    matrix,
    quaternion_product,
    scale,
    solve_symmetric,
    sub,
    turn,
)

# Joint origin in the parent's frame (m), its turn about the parent's axis 1 in right angles, mass (kg), centre of mass
# (m), and inertia about it (kg m²: xx, xy, xz, yy, yz, zz); every joint turns about axis 3 of its own frame.
LINKS = [
    (
        ("0", "0", "0.333"),
        0,
        "4.970684",
        ("0.003875", "0.002081", "-0.04762"),
        ("0.70337", "-0.000139", "0.006772", "0.70661", "0.019169", "0.009117"),
    ),
    (
        ("0", "0", "0"),
        -1,
        "0.646926",
        ("-0.003141", "-0.02872", "0.003495"),
        ("0.007962", "-0.003925", "0.010254", "0.02811", "0.000704", "0.025995"),
    ),
    (
        ("0", "-0.316", "0"),
        1,
        "3.228604",
        ("0.027518", "0.039252", "-0.066502"),
        ("0.037242", "-0.004761", "-0.011396", "0.036155", "-0.012805", "0.01083"),
    ),
    (
        ("0.0825", "0", "0"),
        1,
        "3.587895",
        ("-0.05317", "0.104419", "0.027454"),
        ("0.025853", "0.007796", "-0.001332", "0.019552", "0.008641", "0.028323"),
    ),
    (
        ("-0.0825", "0.384", "0"),
        -1,
        "1.225946",
        ("-0.011953", "0.041065", "-0.038437"),
        ("0.035549", "-0.002117", "-0.004037", "0.029474", "0.000229", "0.008627"),
    ),
    (
        ("0", "0", "0"),
        1,
        "1.666555",
        ("0.060149", "-0.014117", "-0.010517"),
        ("0.001964", "0.000109", "-0.001158", "0.004354", "0.000341", "0.005433"),
    ),
    (
        ("0.088", "0", "0"),
        1,
        "0.735522",
        ("0.010517", "-0.004252", "0.061597"),
        ("0.012516", "-0.000428", "-0.001196", "0.010027", "-0.000741", "0.004815"),
    ),
]
GRAVITY = "9.81"
# Angles (rad) and rates (rad/s): at rest stretched out, at rest bent, slow, fast.
STATES = [
    ((0, 0, 0, 0, 0, 0, 0), (0, 0, 0, 0, 0, 0, 0)),
    (("0", "-0.785", "0", "-2.356", "0", "1.571", "0.785"), (0, 0, 0, 0, 0, 0, 0)),
    (("0.3", "0.7", "-0.4", "-1.2", "0.5", "1.9", "-0.6"), ("0.1", "-0.2", "0.3", "-0.4", "0.5", "-0.6", "0.7")),
    (("-1.1", "1.3", "2.2", "-2.9", "-1.7", "0.2", "2.5"), ("1.3", "0.8", "-1.9", "2.1", "-0.7", "1.6", "-2.4")),
    (("2.6", "-1.6", "1.4", "-0.3", "2.7", "3.4", "-2.2"), ("-2.1", "2.1", "1.5", "-1.8", "2.6", "-2.5", "2.4")),
    (("-0.9", "0.4", "-2.5", "-1.8", "1.2", "2.8", "1.1"), ("0.6", "-1.4", "2", "0.9", "-2.2", "1.1", "0.3")),
    (("1.7", "1.1", "0.8", "-2.2", "-2.4", "1", "-1.3"), ("-1", "1", "-1", "1", "-1", "1", "-1")),
    (("0.05", "-1.2", "-1.6", "-0.7", "0.9", "0.6", "2.1"), ("1.9", "0", "0", "-2", "0", "0", "1.2")),
    (("-2.4", "-0.3", "1.9", "-1.5", "-0.2", "2.3", "0.4"), ("0", "1.8", "-2.1", "0", "2.4", "-2.6", "0")),
    (("0.8", "1.5", "-1", "-2.6", "1.6", "1.4", "-2.7"), ("-1.5", "-1.1", "2.1", "1.7", "-2", "2.2", "-1.6")),
]


def tensor(six):
    """Rows of a symmetric matrix from xx, xy, xz, yy, yz, zz."""
    xx, xy, xz, yy, yz, zz = six
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


def right_angles(count, v):
    """R_x(count · 90°) v, exactly."""
    return [v[0], -count * v[2], count * v[1]] if count else list(v)


class RecursiveNewtonEuler:
    """Torques from accelerations, link by link (Luh, Walker and Paul 1980)."""

    def __init__(self, arithmetic):
        self.arithmetic = arithmetic
        self.links = [
            (
                nested(arithmetic, origin),
                turns,
                arithmetic(mass),
                nested(arithmetic, center),
                nested(arithmetic, tensor(inertia)),
            )
            for origin, turns, mass, center, inertia in LINKS
        ]
        self.zero, self.gravity = arithmetic("0"), arithmetic(GRAVITY)

    def into_link(self, turns, angle, v):
        """Components in the link's axes of a vector given in its parent's."""
        v = right_angles(-turns, v)
        s, c = self.arithmetic.sin(angle), self.arithmetic.cos(angle)
        return [c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]]

    def out_of_link(self, turns, angle, v):
        """The way back."""
        s, c = self.arithmetic.sin(angle), self.arithmetic.cos(angle)
        return right_angles(turns, [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]])

    def torques(self, q, rates, accelerations, gravity):
        """What the motors must do."""
        zero = self.zero
        omega, alpha, a = [zero] * 3, [zero] * 3, [zero, zero, gravity]
        motion = []
        for (origin, turns, mass, center, inertia), angle, rate, acceleration in zip(
            self.links, q, rates, accelerations
        ):
            a = add(a, cross(alpha, origin), cross(omega, cross(omega, origin)))
            omega, alpha, a = (self.into_link(turns, angle, v) for v in (omega, alpha, a))
            alpha = add(alpha, cross(omega, [zero, zero, rate]), [zero, zero, acceleration])
            omega = add(omega, [zero, zero, rate])
            center_acceleration = add(a, cross(alpha, center), cross(omega, cross(omega, center)))
            spin = apply(inertia, omega)
            motion.append((scale(mass, center_acceleration), add(apply(inertia, alpha), cross(omega, spin))))
        force, torque, result = [zero] * 3, [zero] * 3, []
        for i in reversed(range(7)):
            # `force`, `torque` (about the next origin) on the next link, in its axes.
            if i < 6:
                origin, turns = self.links[i + 1][:2]
                force, torque = (self.out_of_link(turns, q[i + 1], v) for v in (force, torque))
                torque = add(torque, cross(origin, force))
            own_force, own_torque = motion[i]
            torque = add(torque, own_torque, cross(self.links[i][3], own_force))
            force = add(force, own_force)
            result.append(torque[2])
        return result[::-1]

    def forward(self, q, rates):
        """q̈ without torques, and the momenta ∂T/∂q̇."""
        still = [self.zero] * 7
        bias = self.torques(q, rates, still, self.gravity)
        columns = []
        for i in range(7):
            unit = [self.zero + int(i == j) for j in range(7)]
            columns.append(self.torques(q, still, unit, self.zero))
        return solve_symmetric(columns, scale(-1, bias)), apply(columns, rates)


class MaximalCoordinates:
    """The same arm as seven free bodies with hinges.

    `links` are (origin, right angles before the joint, axis, sign, mass, centre of mass, inertia about O).
    """

    def __init__(self, arithmetic, links):
        self.arithmetic, self.links, zero = arithmetic, links, arithmetic("0")
        bodies, constraints = [], []
        for i, (origin, turns, axis, sign, mass, center, inertia) in enumerate(links):
            bodies.append(Body(arithmetic, mass, center, inertia))
            parent = None if i == 0 else i - 1
            at = nested(arithmetic, origin)
            hinge = Point(None, at) if parent is None else Point(parent, bodies[parent].from_g(at))
            constraints.append(Coincide(hinge, Point(i, bodies[i].from_g([zero] * 3))))
            e = [[int(j == k) for k in range(3)] for j in range(3)]
            fixed = right_angles(turns, scale(sign, e[axis]))
            constraints += [Perpendicular(parent, fixed, i, e[other]) for other in range(3) if other != axis]
        g = arithmetic(GRAVITY)
        self.system = System(bodies, constraints, lambda t: [zero, zero, -g])

    def place(self, q, rates):
        """The state of the bodies."""
        a, zero = self.arithmetic, self.arithmetic("0")
        half = a.sqrt(a("1/2"))
        quaternion, position, velocity, omega, state = (
            [zero + 1, zero, zero, zero],
            [zero] * 3,
            [zero] * 3,
            [zero] * 3,
            [],
        )
        for body, (origin, turns, axis, sign, *_), angle, rate in zip(self.system.parts, self.links, q, rates):
            r, origin = matrix(quaternion), nested(a, origin)
            position, velocity = add(position, apply(r, origin)), add(velocity, apply(r, cross(omega, origin)))
            step = turn(a, axis, sign * angle)
            if turns:
                step = quaternion_product([half, turns * half, zero, zero], step)
            quaternion = quaternion_product(quaternion, step)
            omega = apply_transposed(matrix(step), omega)
            omega[axis] = omega[axis] + sign * rate
            state += body.place(position, quaternion, velocity, omega)
        return state

    def forward(self, q, rates):
        """q̈ without torques, kinetic energy, potential energy from the base, and O of the last link."""
        y = self.place(q, rates)
        poses = self.system.poses(y)
        accelerations, _ = self.system.accelerations(self.arithmetic("0"), poses)
        result, before = [], [0, 0, 0]
        for (_, turning), pose, (_, _, axis, sign, *_) in zip(accelerations, poses, self.links):
            # The axis a is fixed in the link and in its parent: d/dt (ω − ω′)·a = (ω̇ − ω̇′)·a.
            space = apply(pose.rotation, turning)
            result.append(sign * dot(sub(space, before), [row[axis] for row in pose.rotation]))
            before = space
        kinetic = sum(pose.kinetic_energy() for pose in poses)
        potential = self.system.energy(self.arithmetic("0"), y) - kinetic
        return result, kinetic, potential, poses[6].origin()[0]


def about_origin(mass, center, inertia):
    """Inertia about O as exact fractions."""
    m, c, rows = Fraction(mass), [Fraction(x) for x in center], tensor([Fraction(x) for x in inertia])
    return [[rows[i][j] + m * ((dot(c, c) if i == j else 0) - c[i] * c[j]) for j in range(3)] for i in range(3)]


def decimal(value):
    """An exact decimal of a fraction whose denominator is a product of twos and fives."""
    power = 0
    while (value * 10**power).denominator != 1:
        power += 1
    return format(Decimal((value * 10**power).numerator).scaleb(-power), "f") if value else "0"


def straight_links():
    """The links in axes that are parallel to the base's when all angles are zero: no right angles are left."""
    columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    links = []

    def rotate(v):
        return [sum(columns[j][i] * v[j] for j in range(3)) for i in range(3)]

    for origin, turns, mass, center, inertia in LINKS:
        offset = rotate([Fraction(x) for x in origin])
        columns = [rotate(right_angles(turns, [int(i == j) for i in range(3)])) for j in range(3)]
        rows = about_origin(mass, center, inertia)
        half = [rotate(row) for row in rows]
        turned = [rotate([half[i][j] for i in range(3)]) for j in range(3)]
        links.append(
            {
                "mass": mass,
                "joint_origin": nested(decimal, offset),
                "joint_axis": columns[2],
                "centre_of_mass_body_from_O": nested(decimal, rotate([Fraction(x) for x in center])),
                "inertia_about_O": nested(decimal, turned),
            }
        )
    return links


def for_bodies():
    """Both descriptions as `MaximalCoordinates` takes them."""
    original = [
        (origin, turns, 2, 1, mass, center, about_origin(mass, center, inertia))
        for origin, turns, mass, center, inertia in LINKS
    ]
    straight = []
    for link in straight_links():
        axis = [abs(x) for x in link["joint_axis"]].index(1)
        straight.append(
            (
                link["joint_origin"],
                0,
                axis,
                link["joint_axis"][axis],
                link["mass"],
                link["centre_of_mass_body_from_O"],
                link["inertia_about_O"],
            )
        )
    return original, straight


def main():
    """Writes seven_joint_arm.json."""
    first, second = Mpfr(200), Mpmath(60)
    states, worst = [], 0
    for q, rates in STATES:
        recursive = RecursiveNewtonEuler(first)
        numbers, speeds = nested(first, q), nested(first, rates)
        accelerations, momenta = recursive.forward(numbers, speeds)
        size = as_mpmath(max(1, max(abs(x) for x in accelerations)))
        for links in for_bodies():
            bodies = MaximalCoordinates(second, links)
            other, kinetic, potential, last = bodies.forward(nested(second, q), nested(second, rates))
            # The accelerations by both methods, and T = ½ p·q̇.
            errors = [abs(as_mpmath(a) - b) / size for a, b in zip(accelerations, other)]
            errors.append(abs(as_mpmath(dot(momenta, speeds)) / 2 - kinetic))
            worst = max(errors + [worst])
        states.append(
            {
                "q": [str(x) for x in q],
                "q_rate": [str(x) for x in rates],
                "q_acceleration": nested(text, accelerations),
                "momentum": nested(text, momenta),
                "kinetic_energy": text(kinetic),
                "potential_energy": text(potential),
                "position_of_last_link": nested(text, last),
            }
        )
    assert worst < 1e-45, worst
    print(f"seven_joint_arm: two methods differ by {float(worst):.1e}")
    report = {
        "name": "seven_joint_arm",
        "kind": "serial chain of bodies",
        "description": "Franka Emika Panda without gripper, seven revolute joints without torques, gravity along "
        "-z of the base. Accelerations of the joints at given states. `links`: every joint turns "
        "about axis 3 of its frame, R_parent R_x(right_angles 90 deg) R_z(q); `straight_links`: "
        "the same arm in axes that are parallel to the base's when all angles are zero, R_parent "
        "R_axis(q), with joint_axis = +-e2 or +-e3 and joint_origin in the parent's straight axes. "
        "Right angles are exact. Potential energy from the base.",
        "source": "parameters: public URDF description of the arm (example-robot-data, panda.urdf); "
        "accelerations: recursive Newton-Euler (J. Y. S. Luh, M. W. Walker, R. P. C. Paul, On-line "
        "computational scheme for mechanical manipulators, 1980) with a dense solve, MPFR with 200 "
        "bits, checked by Newton-Euler equations of seven free bodies with the reactions of the hinges "
        "as multipliers, mpmath with 60 digits",
        "script": "tests/references/arm.py",
        "parameters": {
            "gravity": GRAVITY,
            "links": [
                {
                    "joint_origin": origin,
                    "right_angles": turns,
                    "mass": mass,
                    "centre_of_mass_body_from_O": center,
                    "inertia_about_centre_of_mass": tensor(inertia),
                    "inertia_about_O": nested(decimal, about_origin(mass, center, inertia)),
                }
                for origin, turns, mass, center, inertia in LINKS
            ],
            "straight_links": straight_links(),
        },
        "states": states,
        "verification": {"largest_difference_of_two_methods": f"{float(worst):.1e}"},
    }
    (DATA / "seven_joint_arm.json").write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
