"""Free bodies that carry something: a flywheel, or a load on a cable."""

import sys

from multibody import Body, Coincide, Distance, Particle, Perpendicular, Point, System
from scene import Scene, publish
from vectors import (
    add,
    apply,
    apply_transposed,
    cross,
    dot,
    matrix,
    quaternion_product,
    relative,
    scale,
    sub,
    turn,
    unit,
)

FRAME_NUMBERS = ("b_1", "b_2", "b_3", "quaternion_w", "quaternion_x", "quaternion_y", "quaternion_z")


class BodyWithFlywheel(Scene):
    """A hinge holds the flywheel: a point and an axis."""

    name, kind, script = "body_with_flywheel", "free bodies", "free_bodies.py"
    description = (
        "Free gyrostat: a body with a balanced symmetric flywheel whose axis passes beside all centres of mass; "
        "no forces. Body: pose (R, b). Flywheel: O at `wheel_position` of the body, rotation R R_y(tilt) "
        "R_z(phi), turns freely. Pose of the body, then phi; body twist (u, omega), then phi_rate."
    )
    source = (
        "textbook gyrostat (e.g. J. Wittenburg, Dynamics of Multibody Systems); Newton-Euler equations of "
        "both bodies with the reactions of the bearing as multipliers"
    )
    parameters = {
        "body": {
            "mass": "3",
            "centre_of_mass_body_from_O": ["0.05", "-0.02", "0.03"],
            "inertia_about_O": [["0.2", "0.01", "-0.02"], ["0.01", "0.25", "0.015"], ["-0.02", "0.015", "0.15"]],
        },
        "wheel": {
            "mass": "0.8",
            "centre_of_mass_body_from_O": ["0", "0", "0"],
            "inertia_about_O": [["0.006", "0", "0"], ["0", "0.006", "0"], ["0", "0", "0.011"]],
        },
        "wheel_position": ["0.3", "0.1", "-0.2"],
        "tilt": "0.4",
    }
    coordinates, speeds = ("pose", "phi"), ("u", "omega", "phi_rate")
    # b, the quaternion of R before normalisation, φ; u, ω, φ̇.
    start = ("0.1", "0.2", "-0.3", "4", "1", "-2", "2", "0.2", "0.5", "-0.2", "0.3", "0.7", "-0.4", "0.9", "25")
    quaternion, duration = 3, "4"
    extra = {
        "independent_numbers": [*FRAME_NUMBERS, "phi", "u_1", "u_2", "u_3", "omega_1", "omega_2", "omega_3", "phi_rate"]
    }

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        bodies = [
            Body(arithmetic, p["mass"], p["centre_of_mass_body_from_O"], p["inertia_about_O"])
            for p in (self.parameters["body"], self.parameters["wheel"])
        ]
        self.at, self.tilt = self.number("wheel_position"), turn(arithmetic, 1, self.number("tilt"))
        r, zero = matrix(self.tilt), arithmetic("0")
        constraints = [Coincide(Point(0, bodies[0].from_g(self.at)), Point(1, bodies[1].from_g([0, 0, 0])))]
        axis = apply(r, [0, 0, 1])
        constraints += [Perpendicular(0, axis, 1, other) for other in ([1, 0, 0], [0, 1, 0])]
        self.system = System(bodies, constraints, lambda t: [zero] * 3, self.angle_rates)
        self.rates = self.system.rates

    def place(self, start, t):
        b, quaternion, phi = start[:3], unit(self.arithmetic, start[3:7]), start[7]
        u, omega, rate = start[8:11], list(start[11:14]), start[14]
        r = matrix(quaternion)
        velocity = apply(r, u)
        body, wheel = self.system.parts
        state = body.place(b, quaternion, velocity, omega)
        hinge = quaternion_product(self.tilt, turn(self.arithmetic, 2, phi))
        spin = add(apply_transposed(matrix(hinge), omega), [0 * rate, 0 * rate, rate])
        position, motion = add(b, apply(r, self.at)), add(velocity, apply(r, cross(omega, self.at)))
        return state + wheel.place(position, quaternion_product(quaternion, hinge), motion, spin) + [phi]

    def hinge(self, poses):
        """Rotation of the wheel, and its angular velocity in its axes, as the body sees them."""
        body, wheel = poses
        r = relative(body.rotation, wheel.rotation)
        return r, sub(wheel.omega, apply_transposed(r, body.omega))

    def angle_rates(self, t, poses):
        """φ̇."""
        return [self.hinge(poses)[1][2]]

    def reduced(self, t, y):
        poses = self.system.poses(y)
        b_rate = poses[0].origin()[1]
        quaternion_rate = [c / 2 for c in quaternion_product(poses[0].quaternion, [0] + poses[0].omega)]
        phi_rate = self.angle_rates(t, poses)
        return b_rate + quaternion_rate + phi_rate, apply_transposed(poses[0].rotation, b_rate) + poses[
            0
        ].omega + phi_rate

    def observe(self, t, y):
        poses = self.system.poses(y)
        b, rate = poses[0].origin()
        return {
            "R": poses[0].rotation,
            "b": b,
            "body_u": apply_transposed(poses[0].rotation, rate),
            "body_omega": poses[0].omega,
            "phi": self.system.extra(y),
            "phi_rate": self.angle_rates(t, poses),
            "wheel_R": poses[1].rotation,
        }

    def conserved(self, t, y):
        linear, angular = self.system.momenta(y)
        return {
            "energy": self.system.energy(t, y),
            "momentum": linear,
            "angular_momentum_about_Omega": angular,
            **self.spin(y),
        }

    def spin(self, y):
        """The flywheel's angular momentum about its axis, which nothing changes when it is balanced and symmetric."""
        return {"wheel_omega_3": self.system.poses(y)[1].omega[2]}

    def residuals(self, t, y):
        poses = self.system.poses(y)
        r, omega = self.hinge(poses)
        wanted = matrix(quaternion_product(self.tilt, turn(self.arithmetic, 2, self.system.extra(y)[0])))
        b, rotation = poses[0].origin()[0], poses[0].rotation
        return {
            "point": max(map(abs, sub(add(b, apply(rotation, self.at)), poses[1].origin()[0]))),
            "axis": max(abs(a - c) for rows in zip(r, wanted) for a, c in zip(*rows)),
            "omega": abs(omega[0]) + abs(omega[1]),
        }


class BodyWithUnbalancedWheel(BodyWithFlywheel):
    """The same with a wheel that shakes the body."""

    name = "body_with_unbalanced_wheel"
    description = BodyWithFlywheel.description.replace(
        "a balanced symmetric flywheel", "an unbalanced, unsymmetric flywheel"
    )
    parameters = {
        **BodyWithFlywheel.parameters,
        "wheel": {
            "mass": "0.8",
            "centre_of_mass_body_from_O": ["0.03", "0.01", "0.02"],
            "inertia_about_O": [
                ["0.006", "0.0004", "-0.0006"],
                ["0.0004", "0.009", "0.0003"],
                ["-0.0006", "0.0003", "0.012"],
            ],
        },
    }

    def spin(self, y):
        return {}


class QuadrotorWithSlungLoad(Scene):
    """The tension of the cable is the multiplier."""

    name, kind, script = "quadrotor_slung_load", "free body and particle", "free_bodies.py"
    description = (
        "A quadrotor's frame without thrust, tumbling, with a point load on a massless rigid cable; z up. Frame: "
        "pose (R, b). Load at b + R hook + R_x(a1) R_y(a2) (0, 0, -l): the angles of the cable are from the "
        "vertical, not from the frame. Pose, then a1, a2; body twist (u, omega), then a1_rate, a2_rate."
    )
    source = (
        "textbook system (e.g. K. Sreenath, T. Lee, V. Kumar, Geometric control and differential flatness "
        "of a quadrotor UAV with a cable-suspended load, CDC 2013); Newton-Euler equations with the tension "
        "as multiplier"
    )
    parameters = {
        "frame": {
            "mass": "1.2",
            "centre_of_mass_body_from_O": ["0.01", "-0.02", "0.03"],
            "inertia_about_O": [
                ["0.02", "0.001", "-0.0005"],
                ["0.001", "0.025", "0.0008"],
                ["-0.0005", "0.0008", "0.035"],
            ],
        },
        "hook": ["0.05", "0.02", "-0.1"],
        "load": "0.5",
        "l": "0.8",
        "g": "9.81",
    }
    coordinates, speeds = ("pose", "a1", "a2"), ("u", "omega", "a1_rate", "a2_rate")
    start = (
        "0.3",
        "-0.4",
        "10",
        "5",
        "1",
        "-1",
        "3",
        "0.6",
        "-0.4",
        "1",
        "-0.5",
        "0.8",
        "2",
        "-1.5",
        "0.8",
        "1.5",
        "2",
    )
    quaternion, duration = 3, "2"
    extra = {
        "independent_numbers": [
            *FRAME_NUMBERS,
            "a1",
            "a2",
            "u_1",
            "u_2",
            "u_3",
            "omega_1",
            "omega_2",
            "omega_3",
            "a1_rate",
            "a2_rate",
        ]
    }

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        p = self.parameters["frame"]
        body = Body(arithmetic, p["mass"], p["centre_of_mass_body_from_O"], p["inertia_about_O"])
        self.hook, self.length, zero, g = self.number("hook"), self.number("l"), arithmetic("0"), self.number("g")
        cable = Distance(Point(0, body.from_g(self.hook)), Point(1))
        load = Particle(arithmetic, self.parameters["load"])
        self.system = System([body, load], [cable], lambda t: [zero, zero, -g], self.angle_rates)
        self.rates = self.system.rates

    def place(self, start, t):
        a = self.arithmetic
        b, quaternion, (a1, a2) = start[:3], unit(a, start[3:7]), start[7:9]
        u, omega, (a1_rate, a2_rate) = start[9:12], list(start[12:15]), start[15:]
        r = matrix(quaternion)
        velocity = apply(r, u)
        state = self.system.parts[0].place(b, quaternion, velocity, omega)
        s1, c1, s2, c2 = a.sin(a1), a.cos(a1), a.sin(a2), a.cos(a2)
        cable = scale(self.length, [-s2, s1 * c2, -c1 * c2])
        rate = scale(
            self.length, [-c2 * a2_rate, c1 * c2 * a1_rate - s1 * s2 * a2_rate, s1 * c2 * a1_rate + c1 * s2 * a2_rate]
        )
        position = add(b, apply(r, self.hook), cable)
        return state + position + add(velocity, apply(r, cross(omega, self.hook)), rate) + [a1, a2]

    def cable(self, poses):
        """The vector from the hook to the load, and its rate."""
        frame, load = poses
        b, rate = frame.origin()
        arm = apply(frame.rotation, self.hook)
        return (sub(load.position, add(b, arm)), sub(load.velocity, add(rate, cross(frame.space_omega, arm))))

    def angle_rates(self, t, poses):
        """Of a1 and a2; the cable is along (−sin a2, sin a1 cos a2, −cos a1 cos a2)."""
        d, rate = self.cable(poses)
        flat = d[1] * d[1] + d[2] * d[2]
        return [(d[1] * rate[2] - d[2] * rate[1]) / flat, -rate[0] / self.arithmetic.sqrt(flat)]

    def reduced(self, t, y):
        poses = self.system.poses(y)
        b_rate = poses[0].origin()[1]
        quaternion_rate = [c / 2 for c in quaternion_product(poses[0].quaternion, [0] + poses[0].omega)]
        angle_rates = self.angle_rates(t, poses)
        return b_rate + quaternion_rate + angle_rates, apply_transposed(poses[0].rotation, b_rate) + poses[
            0
        ].omega + angle_rates

    def observe(self, t, y):
        poses = self.system.poses(y)
        b, rate = poses[0].origin()
        return {
            "R": poses[0].rotation,
            "b": b,
            "body_u": apply_transposed(poses[0].rotation, rate),
            "body_omega": poses[0].omega,
            "angles": self.system.extra(y),
            "angle_rates": self.angle_rates(t, poses),
            "load": poses[1].position,
            "load_velocity": poses[1].velocity,
        }

    def conserved(self, t, y):
        poses = self.system.poses(y)
        linear, _ = self.system.momenta(y)
        mass = sum(pose.part.mass for pose in poses)
        center = scale(1 / mass, add(*(scale(pose.part.mass, pose.position) for pose in poses)))
        about = sub(self.system.momenta(y)[1], cross(center, linear))
        falling = [linear[0], linear[1], linear[2] + mass * self.number("g") * t]
        return {
            "energy": self.system.energy(t, y),
            "momentum_plus_weight_times_t": falling,
            "angular_momentum_about_common_centre_of_mass": about,
        }

    def residuals(self, t, y):
        d, _ = self.cable(self.system.poses(y))
        a1, a2 = self.system.extra(y)
        a = self.arithmetic
        wanted = scale(self.length, [-a.sin(a2), a.sin(a1) * a.cos(a2), -a.cos(a1) * a.cos(a2)])
        return {"length": dot(d, d) - self.length * self.length, "angles": max(map(abs, sub(d, wanted)))}


SCENES = [BodyWithFlywheel, BodyWithUnbalancedWheel, QuadrotorWithSlungLoad]

if __name__ == "__main__":
    for scene in SCENES:
        if len(sys.argv) < 2 or scene.name in sys.argv[1:]:
            publish(scene)
