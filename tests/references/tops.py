"""Bodies about a fixed point: the Goryachev–Chaplygin top and a gyroscope in gimbals."""

import sys

from multibody import Body, Coincide, Perpendicular, Point, System
from scene import Scene, publish
from vectors import apply_transposed, cross, dot, matrix, quaternion_product, relative, sub, turn, unit


class GoryachevChaplygin(Scene):
    """The reaction at O is the multiplier."""

    name, kind, script = "goryachev_chaplygin", "heavy top", "tops.py"
    description = (
        "Goryachev-Chaplygin top: I_O = (4, 4, 1) I3, centre of mass on e1, angular momentum about k3 zero. nu = "
        "m g l / I3, gamma = R^T k3 (up). The centre of mass is near enough to O for a real body to have these "
        "moments."
    )
    source = (
        "D. N. Goryachev (Mat. Sbornik 21, 1900) and S. A. Chaplygin (1901); the third integral as in A. V. Borisov, "
        "I. S. Mamaev, Rigid Body Dynamics. Motion: Newton-Euler equations with the reaction at O as multiplier, along "
        "which the integral is constant to 40 digits"
    )
    parameters = {
        "mass": "1.5",
        "centre_of_mass_body_from_O": ["0.25", "0", "0"],
        "inertia_about_O": [["0.8", "0", "0"], ["0", "0.8", "0"], ["0", "0", "0.2"]],
        "gravity": "9.81",
    }
    coordinates, speeds, quaternion = ("R",), ("omega_1", "omega_2", "omega_3"), 0
    # R = 1/3 (2 1 2, 1 2 −2, −2 2 1): γ = (−2, 2, 1)/3, and Γ·k₃ = 0.8 (2/3) (ω₂ − ω₁) + 0.2 ω₃ / 3 = 0.
    start, duration = ("2", "1", "1", "0", "1.3", "0.8", "4"), "10"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        p = self.parameters
        body = Body(arithmetic, p["mass"], p["centre_of_mass_body_from_O"], p["inertia_about_O"])
        zero, g = arithmetic("0"), self.number("gravity")
        origin = Point(0, body.from_g([0, 0, 0]))
        self.system = System([body], [Coincide(Point(None, [zero] * 3), origin)], lambda t: [zero, zero, -g])
        self.rates = self.system.rates

    def place(self, start, t):
        quaternion, omega = unit(self.arithmetic, start[:4]), list(start[4:])
        zero = [0 * start[0]] * 3
        return self.system.parts[0].place(zero, quaternion, zero, omega)

    def reduced(self, t, y):
        return self.system.rates(t, y)[3:7], y[10:13]

    def observe(self, t, y):
        pose = self.system.poses(y)[0]
        b, rate = pose.origin()
        u = apply_transposed(pose.rotation, rate)
        return {
            "R": pose.rotation,
            "b": b,
            "body_u": u,
            "body_omega": pose.omega,
            "space_bdot": rate,
            "space_omega": pose.space_omega,
            "right_xi": sub(rate, cross(pose.space_omega, b)),
        }

    def conserved(self, t, y):
        pose, p = self.system.poses(y)[0], self.parameters
        nu = (
            self.number("mass")
            * self.number("gravity")
            * self.number("centre_of_mass_body_from_O")[0]
            / self.arithmetic(p["inertia_about_O"][2][2])
        )
        w, gamma = pose.omega, pose.rotation[2]
        third = w[2] * (w[0] * w[0] + w[1] * w[1]) - nu * w[0] * gamma[2]
        return {"energy": self.system.energy(t, y), "L_z": self.system.momenta(y)[1][2], "Goryachev_Chaplygin": third}

    def residuals(self, t, y):
        pose = self.system.poses(y)[0]
        return {"O": max(map(abs, pose.origin()[0])), "norm": dot(pose.quaternion, pose.quaternion) - 1}


class GyroscopeInGimbals(Scene):
    """Three bodies and three hinges, none of them left out."""

    name, kind, script = "gyroscope_in_gimbals", "bodies", "tops.py"
    description = (
        "Gyroscope in two gimbals, all about one point O = Omega, z up. Outer gimbal: R_z(phi). Inner gimbal: "
        "R_z(phi) R_x(theta). Rotor: R_z(phi) R_x(theta) R_z(psi), its centre of mass on its axis, off O. q = "
        "(phi, theta, psi). Because the outer gimbal has inertia, theta = 0 is regular."
    )
    source = (
        "textbook system (e.g. J. Wittenburg, Dynamics of Multibody Systems; K. Magnus, Kreisel, on gyroscopes "
        "with massive gimbals); Newton-Euler equations of three bodies with the reactions of the bearings as "
        "multipliers"
    )
    parameters = {
        "outer": {
            "mass": "0.4",
            "centre_of_mass_body_from_O": ["0", "0", "0"],
            "principal_inertia_about_O": ["0.004", "0.0042", "0.0065"],
        },
        "inner": {
            "mass": "0.3",
            "centre_of_mass_body_from_O": ["0", "0", "0"],
            "principal_inertia_about_O": ["0.002", "0.0031", "0.0028"],
        },
        "rotor": {
            "mass": "0.5",
            "centre_of_mass_body_from_O": ["0", "0", "0.03"],
            "principal_inertia_about_O": ["0.0016", "0.0016", "0.0022"],
        },
        "g": "9.81",
    }
    coordinates, speeds = ("phi", "theta", "psi"), ("phi_rate", "theta_rate", "psi_rate")
    start, duration = ("0.3", "0.8", "-0.5", "0.5", "-1.5", "40"), "2"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        bodies = []
        for key in ("outer", "inner", "rotor"):
            data = self.parameters[key]
            moments = data["principal_inertia_about_O"]
            tensor = [[moments[i] if i == j else "0" for j in range(3)] for i in range(3)]
            bodies.append(Body(arithmetic, data["mass"], data["centre_of_mass_body_from_O"], tensor))
        zero, g = arithmetic("0"), self.number("g")
        e = [[int(i == j) for j in range(3)] for i in range(3)]
        constraints = []
        for i, (body, axis) in enumerate(zip(bodies, (2, 0, 2))):
            parent = None if i == 0 else i - 1
            constraints.append(Coincide(Point(None, [zero] * 3), Point(i, body.from_g([0, 0, 0]))))
            constraints += [Perpendicular(parent, e[axis], i, e[other]) for other in range(3) if other != axis]
        self.system = System(bodies, constraints, lambda t: [zero, zero, -g], self.angle_rates)
        self.rates = self.system.rates

    AXES = (2, 0, 2)

    def place(self, start, t):
        zero = 0 * start[0]
        quaternion, omega, state = [zero + 1, zero, zero, zero], [zero] * 3, []
        for body, axis, angle, rate in zip(self.system.parts, self.AXES, start[:3], start[3:]):
            rotation = turn(self.arithmetic, axis, angle)
            quaternion = quaternion_product(quaternion, rotation)
            omega = apply_transposed(matrix(rotation), omega)
            omega[axis] = omega[axis] + rate
            state += body.place([zero] * 3, quaternion, [zero] * 3, omega)
        return state + list(start[:3])

    def hinges(self, poses):
        """Rotation and angular velocity of each body as its parent sees them, in the body's axes."""
        result = [(poses[0].rotation, poses[0].omega)]
        for parent, child in zip(poses, poses[1:]):
            r = relative(parent.rotation, child.rotation)
            result.append((r, sub(child.omega, apply_transposed(r, parent.omega))))
        return result

    def angle_rates(self, t, poses):
        """The rates of φ, θ, ψ."""
        return [omega[axis] for (_, omega), axis in zip(self.hinges(poses), self.AXES)]

    def reduced(self, t, y):
        z = self.angle_rates(t, self.system.poses(y))
        return z, z

    def observe(self, t, y):
        rotor = self.system.poses(y)[2]
        return {
            "q": self.system.extra(y),
            "z": self.reduced(t, y)[1],
            "rotor_R": rotor.rotation,
            "rotor_omega": rotor.omega,
        }

    def conserved(self, t, y):
        rotor = self.system.poses(y)[2]
        return {
            "energy": self.system.energy(t, y),
            "L_z": self.system.momenta(y)[1][2],
            "rotor_omega_3": rotor.omega[2],
        }

    def residuals(self, t, y):
        poses, table = self.system.poses(y), {}
        for (r, omega), axis, angle, name in zip(
            self.hinges(poses), self.AXES, self.system.extra(y), ("outer", "inner", "rotor")
        ):
            wanted = matrix(turn(self.arithmetic, axis, angle))
            table[name] = max(abs(a - b) for rows in zip(r, wanted) for a, b in zip(*rows))
        return table


SCENES = [GoryachevChaplygin, GyroscopeInGimbals]

if __name__ == "__main__":
    for scene in SCENES:
        if len(sys.argv) < 2 or scene.name in sys.argv[1:]:
            publish(scene)
