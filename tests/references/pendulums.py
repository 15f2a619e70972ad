"""Cart-pole, Foucault's pendulum, spatial double pendulums: particles on massless rods, rods on universal joints."""

import sys

from multibody import Body, Coincide, Distance, Particle, Perpendicular, Point, System
from scene import Scene, publish
from vectors import add, apply, apply_transposed, cross, dot, matrix, quaternion_product, relative, scale, sub, turn


def hanging(arithmetic, a, b, length):
    """R_x(a) R_y(b) (0, 0, −length) and its partial derivatives by a and b."""
    (sa, ca), (sb, cb) = ((arithmetic.sin(x), arithmetic.cos(x)) for x in (a, b))
    along = scale(length, [-sb, sa * cb, -ca * cb])
    return along, scale(length, [0 * sb, ca * cb, sa * cb]), scale(length, [-cb, -sa * sb, ca * sb])


def angle_rates_of_rod(arithmetic, d, rate):
    """The rates of a and b for a rod along d = R_x(a) R_y(b) (0, 0, −|d|) that changes at the given rate."""
    flat = d[1] * d[1] + d[2] * d[2]
    cosine = arithmetic.sqrt(flat)
    cosine_rate = (d[1] * rate[1] + d[2] * rate[2]) / cosine
    return [(d[1] * rate[2] - rate[1] * d[2]) / flat, (d[0] * cosine_rate - rate[0] * cosine) / dot(d, d)]


class CartPole(Scene):
    """The rod's tension and the rail's reactions are multipliers."""

    name, kind, script = "cart_pole", "particles", "pendulums.py"
    description = (
        "Cart on a horizontal rail (x axis) and a point mass on a massless rod, in the plane x z, z up. q = (x, "
        "theta): bob at (x + l sin theta, 0, -l cos theta), theta from the downward vertical. No force on the "
        "cart."
    )
    source = (
        "textbook system; Newton's equations of both particles with the rod's tension and the rail's reactions as "
        "multipliers"
    )
    parameters = {"cart": "2", "bob": "0.3", "l": "0.8", "g": "9.81"}
    coordinates, speeds = ("x", "theta"), ("x_rate", "theta_rate")
    start, duration = ("0.5", "2.8", "0.2", "0.5"), "5"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        cart, bob = (Particle(arithmetic, self.parameters[key]) for key in ("cart", "bob"))
        rail = Point(None, [0, 0, 0])
        zero, g = arithmetic("0"), self.number("g")
        across = ((0, 1, 0), (0, 0, 1))
        constraints = [
            Coincide(Point(0), rail, across),
            Coincide(Point(1), rail, across[:1]),
            Distance(Point(0), Point(1)),
        ]
        self.system = System([cart, bob], constraints, lambda t: [zero, zero, -g], self.angle_rate)
        self.rates = self.system.rates

    def place(self, start, t):
        x, theta, x_rate, theta_rate = start
        s, c, l, zero = self.arithmetic.sin(theta), self.arithmetic.cos(theta), self.number("l"), 0 * x
        bob, velocity = [x + l * s, zero, -l * c], [x_rate + l * c * theta_rate, zero, l * s * theta_rate]
        return [x, zero, zero, x_rate, zero, zero] + bob + velocity + [theta]

    def angle_rate(self, t, poses):
        """θ̇ from the motion of the rod."""
        d, rate = sub(poses[1].position, poses[0].position), sub(poses[1].velocity, poses[0].velocity)
        return [(-rate[0] * d[2] + d[0] * rate[2]) / dot(d, d)]

    def reduced(self, t, y):
        poses = self.system.poses(y)
        z = [poses[0].velocity[0]] + self.angle_rate(t, poses)
        return z, z

    def observe(self, t, y):
        cart, bob = self.system.poses(y)
        return {
            "q": [cart.position[0]] + self.system.extra(y),
            "z": self.reduced(t, y)[1],
            "x1": cart.position,
            "x2": bob.position,
            "v1": cart.velocity,
            "v2": bob.velocity,
        }

    def conserved(self, t, y):
        return {"energy": self.system.energy(t, y), "momentum_x": self.system.momenta(y)[0][0]}

    def residuals(self, t, y):
        cart, bob = self.system.poses(y)
        theta, l = self.system.extra(y)[0], self.number("l")
        d = sub(bob.position, cart.position)
        return {
            "length": dot(d, d) - l * l,
            "rail": abs(cart.position[1]) + abs(cart.position[2]) + abs(bob.position[1]),
            "angle": abs(d[0] - l * self.arithmetic.sin(theta)) + abs(d[2] + l * self.arithmetic.cos(theta)),
        }


class SpatialDoublePendulum(Scene):
    """Two tensions as multipliers."""

    name, kind, script = "spatial_double_pendulum", "particles", "pendulums.py"
    description = (
        "Two point masses on massless rods, in space, z up. q = (a1, b1, a2, b2), all from the vertical: rod i along "
        "R_x(a_i) R_y(b_i) (0, 0, -l_i); x1 = rod 1, x2 = rod 1 + rod 2."
    )
    source = "textbook system; Newton's equations of both particles with the tensions of the rods as multipliers"
    parameters = {"m1": "1", "m2": "0.7", "l1": "1", "l2": "0.6", "g": "9.81"}
    coordinates = ("a1", "b1", "a2", "b2")
    speeds = tuple(f"{c}_rate" for c in coordinates)
    start, duration = ("0.9", "0.5", "-0.4", "1", "0.3", "-1.2", "2", "0.7"), "3"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        parts = [Particle(arithmetic, self.parameters[key]) for key in ("m1", "m2")]
        zero, g = arithmetic("0"), self.number("g")
        constraints = [Distance(Point(None, [0, 0, 0]), Point(0)), Distance(Point(0), Point(1))]
        self.system = System(parts, constraints, lambda t: [zero, zero, -g], self.angle_rates)
        self.rates = self.system.rates

    def place(self, start, t):
        position, velocity, parts = [0 * start[0]] * 3, [0 * start[0]] * 3, []
        for i, key in enumerate(("l1", "l2")):
            a, b, a_rate, b_rate = start[2 * i], start[2 * i + 1], start[4 + 2 * i], start[5 + 2 * i]
            along, by_a, by_b = hanging(self.arithmetic, a, b, self.number(key))
            position, velocity = add(position, along), add(velocity, scale(a_rate, by_a), scale(b_rate, by_b))
            parts += position + velocity
        return parts + list(start[:4])

    def angle_rates(self, t, poses):
        """The rates of a1, b1, a2, b2."""
        first, second = poses
        d, rate = sub(second.position, first.position), sub(second.velocity, first.velocity)
        upper = angle_rates_of_rod(self.arithmetic, first.position, first.velocity)
        return upper + angle_rates_of_rod(self.arithmetic, d, rate)

    def reduced(self, t, y):
        z = self.angle_rates(t, self.system.poses(y))
        return z, z

    def observe(self, t, y):
        poses = self.system.poses(y)
        first, second = poses
        return {
            "q": self.system.extra(y),
            "z": self.reduced(t, y)[1],
            "x1": first.position,
            "x2": second.position,
            "v1": first.velocity,
            "v2": second.velocity,
        }

    def conserved(self, t, y):
        return {"energy": self.system.energy(t, y), "L_z": self.system.momenta(y)[1][2]}

    def residuals(self, t, y):
        first, second = self.system.poses(y)
        d, l1, l2 = sub(second.position, first.position), self.number("l1"), self.number("l2")
        angles = self.system.extra(y)
        rods = [hanging(self.arithmetic, *angles[:2], l1)[0], hanging(self.arithmetic, *angles[2:], l2)[0]]
        return {
            "length_1": dot(first.position, first.position) - l1 * l1,
            "length_2": dot(d, d) - l2 * l2,
            "angles_1": max(map(abs, sub(rods[0], first.position))),
            "angles_2": max(map(abs, sub(rods[1], d))),
        }


class SpatialDoublePendulumOfRods(Scene):
    """Universal joints: a ball joint, and axis 1 of the parent stays perpendicular to axis 2 of the child."""

    name, kind, script = "spatial_double_pendulum_of_rods", "bodies", "pendulums.py"
    description = (
        "Two rigid rods with thickness on universal joints, z up. Upper: R1 = R_x(a1) R_y(b1), O at Omega. Lower: "
        "O at the upper's (0, 0, -l1), R2 = R1 R_x(a2) R_y(b2). q = (a1, b1, a2, b2)."
    )
    source = "textbook system; Newton-Euler equations of both rods with the reactions of the joints as multipliers"
    parameters = {
        "l1": "0.9",
        "g": "9.81",
        "upper": {
            "mass": "1.5",
            "centre_of_mass_body_from_O": ["0.01", "-0.02", "-0.45"],
            "inertia_about_O": [["0.42", "0.001", "0.008"], ["0.001", "0.41", "-0.012"], ["0.008", "-0.012", "0.03"]],
        },
        "lower": {
            "mass": "0.8",
            "centre_of_mass_body_from_O": ["0", "0.015", "-0.3"],
            "inertia_about_O": [["0.11", "0", "0.002"], ["0", "0.105", "0.004"], ["0.002", "0.004", "0.009"]],
        },
    }
    coordinates = ("a1", "b1", "a2", "b2")
    speeds = tuple(f"{c}_rate" for c in coordinates)
    start, duration = ("0.8", "0.5", "-0.6", "0.4", "0.3", "-1.2", "2", "0.7"), "3"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        bodies = [self.body(self.parameters[key]) for key in ("upper", "lower")]
        zero, g = arithmetic("0"), self.number("g")
        below = [0, 0, -self.number("l1")]
        origins = [Point(i, body.from_g([0, 0, 0])) for i, body in enumerate(bodies)]
        constraints = [
            Coincide(Point(None, [0, 0, 0]), origins[0]),
            Perpendicular(None, [1, 0, 0], 0, [0, 1, 0]),
            Coincide(Point(0, bodies[0].from_g(below)), origins[1]),
            Perpendicular(0, [1, 0, 0], 1, [0, 1, 0]),
        ]
        self.below = below
        self.system = System(bodies, constraints, lambda t: [zero, zero, -g], self.angle_rates)
        self.rates = self.system.rates

    def body(self, data):
        """A rod."""
        return Body(self.arithmetic, data["mass"], data["centre_of_mass_body_from_O"], data["inertia_about_O"])

    def place(self, start, t):
        arithmetic, zero = self.arithmetic, 0 * start[0]
        one = zero + 1
        quaternion, position, velocity, omega = [one, zero, zero, zero], [zero] * 3, [zero] * 3, [zero] * 3
        state = []
        for i, body in enumerate(self.system.parts):
            for axis, angle, rate in ((0, start[2 * i], start[4 + 2 * i]), (1, start[2 * i + 1], start[5 + 2 * i])):
                rotation = turn(arithmetic, axis, angle)
                quaternion = quaternion_product(quaternion, rotation)
                omega = apply_transposed(matrix(rotation), omega)
                omega[axis] = omega[axis] + rate
            state += body.place(position, quaternion, velocity, omega)
            r = matrix(quaternion)
            position, velocity = add(position, apply(r, self.below)), add(velocity, apply(r, cross(omega, self.below)))
        return state + list(start[:4])

    def joints(self, poses):
        """Rotation and angular velocity of each rod as its parent sees them, in the axes of the rod."""
        upper, lower = poses
        r = relative(upper.rotation, lower.rotation)
        return [(upper.rotation, upper.omega), (r, sub(lower.omega, apply_transposed(r, upper.omega)))]

    def angle_rates(self, t, poses):
        """ω = ȧ (cos b, 0, sin b) + ḃ e₂, and (cos b, 0, sin b) is the first row of R_x(a) R_y(b)."""
        return [rate for r, omega in self.joints(poses) for rate in (dot(r[0], omega), omega[1])]

    def reduced(self, t, y):
        z = self.angle_rates(t, self.system.poses(y))
        return z, z

    def observe(self, t, y):
        poses = self.system.poses(y)
        upper, lower = poses
        return {
            "q": self.system.extra(y),
            "z": self.reduced(t, y)[1],
            "upper_R": upper.rotation,
            "upper_omega": upper.omega,
            "lower_b": lower.origin()[0],
            "lower_bdot": lower.origin()[1],
            "lower_R": lower.rotation,
            "lower_omega": lower.omega,
        }

    def conserved(self, t, y):
        return {"energy": self.system.energy(t, y)}

    def residuals(self, t, y):
        upper, lower = poses = self.system.poses(y)
        joint = add(upper.origin()[0], apply(upper.rotation, self.below))
        table = {
            "ball_1": max(map(abs, upper.origin()[0])),
            "ball_2": max(map(abs, sub(lower.origin()[0], joint))),
        }
        angles = self.system.extra(y)
        for i, (r, omega) in enumerate(self.joints(poses)):
            rotation = matrix(
                quaternion_product(turn(self.arithmetic, 0, angles[2 * i]), turn(self.arithmetic, 1, angles[2 * i + 1]))
            )
            table[f"angles_{i + 1}"] = max(abs(a - b) for rows in zip(r, rotation) for a, b in zip(*rows))
            table[f"twist_{i + 1}"] = r[0][0] * omega[2] - r[0][2] * omega[0]
        return table


class Foucault(Scene):
    """An inertial observer, a turning vertical and one tension: no Coriolis force is written anywhere."""

    name, kind, script = "foucault_pendulum", "particle", "pendulums.py"
    description = (
        "Pendulum on a rotating Earth (turning far too fast, so that all terms count). The local axes (x east, y "
        "north, z up) are turned by R(t) = R_z(rate t) R_x(pi/2 - latitude) from inertial axes with k3 along the "
        "polar axis; the point of suspension is the common origin of both; gravity is plain, -g z. q = (x, y), "
        "horizontal local coordinates of the bob; local position (x, y, -sqrt(l^2 - x^2 - y^2)). `inertial_x`, "
        "`inertial_v` are in inertial axes."
    )
    source = (
        "textbook system; Newton's equation in inertial axes with the tension of the rod as multiplier and "
        "gravity turning with the Earth"
    )
    parameters = {"m": "0.7", "l": "1.2", "g": "9.81", "rate": "0.3", "latitude": "0.85"}
    coordinates, speeds = ("x", "y"), ("x_rate", "y_rate")
    start, duration = ("0.5", "-0.2", "0.1", "0.4"), "10"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        bob = Particle(arithmetic, self.parameters["m"])
        self.system = System([bob], [Distance(Point(None, [0, 0, 0]), Point(0))], self.gravity)
        self.rates = self.system.rates

    def east_north_up(self, t):
        """The local axes at the time t, as rows of inertial components."""
        rate, latitude = self.number("rate"), self.number("latitude")
        s, c = self.arithmetic.sin(rate * t), self.arithmetic.cos(rate * t)
        sl, cl = self.arithmetic.sin(latitude), self.arithmetic.cos(latitude)
        return [[c, s, 0 * t], [-s * sl, c * sl, cl], [s * cl, -c * cl, sl]]

    def gravity(self, t):
        """Down, in inertial axes."""
        return scale(-self.number("g"), self.east_north_up(t)[2])

    def spin(self):
        """The Earth's angular velocity, inertial axes."""
        return [0, 0, self.number("rate")]

    def place(self, start, t):
        x, y, x_rate, y_rate = start
        l = self.number("l")
        z = -self.arithmetic.sqrt(l * l - x * x - y * y)
        axes = self.east_north_up(t)
        position = apply_transposed(axes, [x, y, z])
        velocity = apply_transposed(axes, [x_rate, y_rate, -(x * x_rate + y * y_rate) / z])
        return position + add(velocity, cross(self.spin(), position))

    def local(self, t, y):
        """Position and velocity that the Earth sees, local axes."""
        axes, position, velocity = self.east_north_up(t), y[:3], y[3:6]
        return apply(axes, position), apply(axes, sub(velocity, cross(self.spin(), position)))

    def reduced(self, t, y):
        z = self.local(t, y)[1][:2]
        return z, z

    def observe(self, t, y):
        x, v = self.local(t, y)
        return {"q": x[:2], "z": v[:2], "local_x": x, "local_v": v, "inertial_x": y[:3], "inertial_v": y[3:6]}

    def conserved(self, t, y):
        # In axes that turn uniformly about the suspension: energy minus rate times the angular momentum about the axis.
        energy = self.system.energy(t, y)
        return {"energy_minus_rate_times_polar_momentum": energy - self.number("rate") * self.system.momenta(y)[1][2]}

    def residuals(self, t, y):
        l = self.number("l")
        return {"length": dot(y[:3], y[:3]) - l * l}


class FoucaultSmall(Foucault):
    """The Panthéon's dimensions, a small swing, and the real Earth."""

    name = "foucault_precession"
    description = Foucault.description.replace(
        "(turning far too fast, so that all terms count)",
        "of the size of the one in the Pantheon, released at rest on the Earth with an amplitude of a hundredth "
        "of its length",
    )
    parameters = {"m": "28", "l": "67", "g": "9.81", "rate": "0.00007292115", "latitude": "0.8526"}
    start, duration = ("0.67", "0", "0", "0"), "600"

    def azimuth(self, t, y):
        """Of the swing: major axis of the osculating ellipse about the plumb line, in axes not turning about it."""
        x, v = self.local(t, y)
        rate, latitude = self.number("rate"), self.number("latitude")
        vertical, level = rate * self.arithmetic.sin(latitude), rate * self.arithmetic.cos(latitude)
        square = self.number("l") / self.number("g")
        # The Earth's axis goes through the suspension, so that the bob at rest is a little north of it.
        x = [x[0], x[1] - vertical * level * self.number("l") * square]
        v = [v[0] - vertical * x[1], v[1] + vertical * x[0]]
        return (
            self.arithmetic.atan2(
                2 * (x[0] * x[1] + square * v[0] * v[1]), x[0] ** 2 - x[1] ** 2 + square * (v[0] ** 2 - v[1] ** 2)
            )
            / 2
        )

    def further(self, t, y):
        start = self.place([self.arithmetic(text) for text in self.start], 0 * t)
        change = self.azimuth(t, y) - self.azimuth(0 * t, start)
        foucault = -self.number("rate") * self.arithmetic.sin(self.number("latitude")) * t
        l, a = self.number("l"), self.arithmetic(self.start[0])
        return {
            "precession": {
                "change_of_azimuth_of_swing": f"{float(change):.12e}",
                "minus_rate_sin_latitude_T": f"{float(foucault):.12e}",
                "relative_difference": f"{float(change / foucault - 1):.3e}",
                "three_eighths_amplitude_over_length_squared": f"{float(3 * a * a / (8 * l * l)):.3e}",
                "note": "azimuth = 1/2 atan2(2 (x y + l/g vx vy), x^2 - y^2 + l/g (vx^2 - vy^2)), with y from the "
                "plumb line at rate^2 sin(latitude) cos(latitude) l^2/g and the velocity seen from axes that "
                "do not turn about the vertical: vx = x_rate - rate sin(latitude) y, vy = y_rate + rate "
                "sin(latitude) x. An ellipse of half-axes a, b turns by 3/8 a b/l^2 sqrt(g/l) in the unit of "
                "time, here against the Earth, hence the relative difference",
            }
        }


SCENES = [CartPole, SpatialDoublePendulum, SpatialDoublePendulumOfRods, Foucault, FoucaultSmall]

if __name__ == "__main__":
    for scene in SCENES:
        if len(sys.argv) < 2 or scene.name in sys.argv[1:]:
            publish(scene)
