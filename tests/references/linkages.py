"""A planar four-bar linkage: three bars, four hinges, one freedom."""

import sys

from multibody import Body, Coincide, Perpendicular, Point, System
from scene import Scene, publish
from vectors import add, apply, cross, matrix, scale, sub, turn


class FourBarLinkage(Scene):
    """All bars are free bodies in space; the hinges hold them."""

    name, kind, script = "four_bar_linkage", "bodies in a closed loop", "linkages.py"
    description = (
        "Planar four-bar linkage (crank-rocker), x horizontal, y up (gravity -y). Bar i has its axis e1 at the "
        "angle theta_i from x, O at its first end. Bar 1 (crank) from (0, 0) to A, bar 2 (coupler) from A to B, "
        "bar 3 (rocker) from (d, 0) to B. q = (theta1, theta2, theta3); the loop l1 e(theta1) + l2 e(theta2) - l3 "
        "e(theta3) = (d, 0) holds with B above the line from A to (d, 0). Only what turns about k3 enters the "
        "motion."
    )
    source = (
        "textbook linkage (Grashof's crank-rocker); Newton-Euler equations of the three bars with the "
        "reactions of the four hinges as multipliers"
    )
    parameters = {
        "lengths": ["0.4", "1", "0.8"],
        "d": "1",
        "g": "9.81",
        "masses": ["0.6", "1.2", "1"],
        "centres_of_mass_body_from_O": [["0.2", "0", "0"], ["0.5", "0.05", "0"], ["0.4", "0", "0"]],
        "inertias_about_O": [
            [["0.001", "0", "0"], ["0", "0.032", "0"], ["0", "0", "0.032"]],
            [["0.004", "-0.03", "0"], ["-0.03", "0.4", "0"], ["0", "0", "0.403"]],
            [["0.001", "0", "0"], ["0", "0.21", "0"], ["0", "0", "0.21"]],
        ],
    }
    coordinates = ("theta1", "theta2", "theta3")
    speeds = tuple(f"{c}_rate" for c in coordinates)
    # θ₁ and its rate; the rest follows.
    start, duration = ("0.7", "6"), "2"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        p = self.parameters
        self.lengths, self.base = self.number("lengths"), self.number("d")
        bodies = [
            Body(arithmetic, *data)
            for data in zip(p["masses"], p["centres_of_mass_body_from_O"], p["inertias_about_O"])
        ]
        zero, g = arithmetic("0"), self.number("g")
        first = [Point(i, body.from_g([0, 0, 0])) for i, body in enumerate(bodies)]
        last = [Point(i, body.from_g([length, 0, 0])) for i, (body, length) in enumerate(zip(bodies, self.lengths))]
        constraints = [
            Coincide(Point(None, [zero] * 3), first[0]),
            Coincide(last[0], first[1]),
            Coincide(Point(None, [self.base, zero, zero]), first[2]),
            # The loop is planar already: two directions close it.
            Coincide(last[1], last[2], ((1, 0, 0), (0, 1, 0))),
        ]
        for i, parent in enumerate((None, 0, None)):
            constraints += [Perpendicular(parent, [0, 0, 1], i, axis) for axis in ([1, 0, 0], [0, 1, 0])]
        self.system = System(bodies, constraints, lambda t: [zero, -g, zero], self.angle_rates)
        self.rates = self.system.rates

    def angles(self, theta):
        """θ₁, θ₂, θ₃ of the upper branch, from the triangle A, B, (d, 0)."""
        a, (l1, l2, l3) = self.arithmetic, self.lengths
        x, y = self.base - l1 * a.cos(theta), -l1 * a.sin(theta)
        square = x * x + y * y
        # B = A + along (x, y) + height (−y, x), in units of the side from A to (d, 0).
        along = (square + l2 * l2 - l3 * l3) / (2 * square)
        height = a.sqrt(l2 * l2 / square - along * along)
        coupler = [along * x - height * y, along * y + height * x]
        return [theta, a.atan2(coupler[1], coupler[0]), a.atan2(coupler[1] - y, coupler[0] - x)]

    def rates_of_angles(self, angles, rate):
        """Rates of all angles from that of the crank: the time derivative of the loop."""
        (l1, l2, l3), sine = self.lengths, self.arithmetic.sin
        second = -l1 * sine(angles[0] - angles[2]) / (l2 * sine(angles[1] - angles[2])) * rate
        third = l1 * sine(angles[0] - angles[1]) / (l3 * sine(angles[2] - angles[1])) * rate
        return [rate, second, third]

    def place(self, start, t):
        zero = 0 * start[0]
        angles = self.angles(start[0])
        rates = self.rates_of_angles(angles, start[1])
        first, motion, state = [zero] * 3, [zero] * 3, []
        for i, (body, angle, rate, length) in enumerate(zip(self.system.parts, angles, rates, self.lengths)):
            if i == 2:
                first, motion = [zero + self.base, zero, zero], [zero] * 3
            quaternion, omega = turn(self.arithmetic, 2, angle), [zero, zero, rate]
            state += body.place(first, quaternion, motion, omega)
            bar = scale(length, apply(matrix(quaternion), [1, 0, 0]))
            first, motion = add(first, bar), add(motion, cross(omega, bar))
        return state + angles

    def angle_rates(self, t, poses):
        """ω₃ of every bar."""
        return [pose.omega[2] for pose in poses]

    def reduced(self, t, y):
        rate = self.system.poses(y)[0].omega[2:]
        return rate, rate

    def observe(self, t, y):
        poses = self.system.poses(y)
        ends = [add(*point) for point in self.ends(poses)]
        return {"q": self.system.extra(y), "z": self.angle_rates(t, poses), "A": ends[0][:2], "B": ends[1][:2]}

    def ends(self, poses):
        """O and the bar of each body."""
        return [(pose.origin()[0], apply(pose.rotation, [length, 0, 0])) for pose, length in zip(poses, self.lengths)]

    def conserved(self, t, y):
        return {"energy": self.system.energy(t, y)}

    def residuals(self, t, y):
        poses = self.system.poses(y)
        ends, angles = self.ends(poses), self.system.extra(y)
        bars = [
            scale(length, [self.arithmetic.cos(a), self.arithmetic.sin(a), 0])
            for length, a in zip(self.lengths, angles)
        ]
        return {
            "hinges": max(
                largest(ends[0][0]),
                largest(sub(add(*ends[0]), ends[1][0])),
                largest(sub(ends[2][0], [self.base, 0, 0])),
            ),
            "loop": largest(sub(add(*ends[1]), add(*ends[2]))),
            "angles": max(largest(sub(bar, end[1])) for bar, end in zip(bars, ends)),
            "triangle": largest([self.arithmetic.sin(a - b) for a, b in zip(angles, self.angles(angles[0]))]),
        }


def largest(v):
    """The largest component."""
    return max(map(abs, v))


SCENES = [FourBarLinkage]

if __name__ == "__main__":
    for scene in SCENES:
        if len(sys.argv) < 2 or scene.name in sys.argv[1:]:
            publish(scene)
