"""The rattleback: an ellipsoid that rolls without slipping, its principal axes of inertia turned against its own."""

import sys

from multibody import Body, Rolling, System
from scene import Scene, publish
from vectors import apply, apply_transposed, cross, dot, matrix, quaternion_product, scale, turn


def lowest_point(arithmetic, squares, center):
    """Contact of an ellipsoid with the plane below it, from G, and its rate: squares of half-axes, and G − centre."""

    def contact(up, rate):
        weighted = [s * g for s, g in zip(squares, up)]
        height = arithmetic.sqrt(dot(weighted, up))
        height_rate = dot(weighted, rate) / height
        point = [-w / height - c for w, c in zip(weighted, center)]
        moving = [-(s * r - w * height_rate / height) / height for s, r, w in zip(squares, rate, weighted)]
        return point, moving

    return contact


class Rattleback(Scene):
    """The force at the contact is the multiplier."""

    name, kind, script = "rattleback", "nonholonomic", "rolling.py"
    description = (
        "Ellipsoid x1^2/a1^2 + x2^2/a2^2 + x3^2/a3^2 = 1 (centre O, body axes, e3 up at rest) that rolls without "
        "slipping on the plane z = 0; centre of mass below the centre; a product of inertia turns the principal "
        "axes against the axes of the ellipsoid. q = (x, y, yaw, roll, pitch): x, y of O, R = R_z(yaw) R_x(roll) "
        "R_y(pitch), height of O = sqrt(sum a_i^2 gamma_i^2) with gamma = R^T k3; z = omega in body axes. "
        "Constraint: bdot + omega x (lowest point - O) = 0, lowest point - a_i^2 gamma_i / height. It is started "
        "against its preferred sense, and the spin about the vertical is reversed at T."
    )
    source = (
        "T. R. Kane, D. A. Levinson, Realistic mathematical modeling of the rattleback, Int. J. Non-Linear "
        "Mechanics 17 (1982) 175-186: half-axes 20, 3, 2 cm, centre of mass 1 cm below the centre, moments of "
        "inertia about it 2, 16, 17, product 0.2 (cm^2 times the mass, here 1 kg); their axis 3 points down, ours "
        "up, so that the product has the other sign. Motion: Newton-Euler equations with the force at the contact "
        "as multiplier"
    )
    parameters = {
        "mass": "1",
        "centre_of_mass_body_from_O": ["0", "0", "-0.01"],
        "half_axes": ["0.2", "0.03", "0.02"],
        "inertia_about_centre_of_mass": [["0.0002", "0.00002", "0"], ["0.00002", "0.0016", "0"], ["0", "0", "0.0017"]],
        "inertia_about_O": [["0.0003", "0.00002", "0"], ["0.00002", "0.0017", "0"], ["0", "0", "0.0017"]],
        "gravity": "9.81",
    }
    coordinates, speeds = ("x", "y", "yaw", "roll", "pitch"), ("omega_1", "omega_2", "omega_3")
    start, duration = ("0", "0", "0", "0.009", "0.009", "0", "0", "5"), "5"

    def __init__(self, arithmetic):
        super().__init__(arithmetic)
        p = self.parameters
        body = Body(arithmetic, p["mass"], p["centre_of_mass_body_from_O"], p["inertia_about_O"])
        self.squares = [a * a for a in self.number("half_axes")]
        self.contact = lowest_point(arithmetic, self.squares, body.center)
        zero, g = arithmetic("0"), self.number("gravity")
        self.system = System([body], [Rolling(0, self.contact)], lambda t: [zero, zero, -g], self.angle_rates)
        self.rates = self.system.rates

    def place(self, start, t):
        zero = 0 * start[0]
        quaternion = [zero + 1, zero, zero, zero]
        for axis, angle in zip((2, 0, 1), start[2:5]):
            quaternion = quaternion_product(quaternion, turn(self.arithmetic, axis, angle))
        omega, up = list(start[5:]), matrix(quaternion)[2]
        weighted = [s * g for s, g in zip(self.squares, up)]
        height = self.arithmetic.sqrt(dot(weighted, up))
        velocity = apply(matrix(quaternion), cross(omega, scale(1 / height, weighted)))
        body = self.system.parts[0]
        return body.place([start[0], start[1], height], quaternion, velocity, omega) + list(start[2:5])

    def angle_rates(self, t, poses):
        """Of yaw, roll and pitch: with γ = Rᵀk₃ = (−cos r sin p, sin r, cos r cos p)."""
        up, w = poses[0].rotation[2], poses[0].omega
        flat = up[0] * up[0] + up[2] * up[2]
        yaw = (up[0] * w[0] + up[2] * w[2]) / flat
        roll = (up[2] * w[0] - up[0] * w[2]) / self.arithmetic.sqrt(flat)
        return [yaw, roll, w[1] - yaw * up[1]]

    def reduced(self, t, y):
        poses = self.system.poses(y)
        return poses[0].origin()[1][:2] + self.angle_rates(t, poses), poses[0].omega

    def observe(self, t, y):
        pose = self.system.poses(y)[0]
        b, rate = pose.origin()
        return {
            "q": b[:2] + self.system.extra(y),
            "z": pose.omega,
            "R": pose.rotation,
            "b": b,
            "body_u": apply_transposed(pose.rotation, rate),
            "body_omega": pose.omega,
            "space_bdot": rate,
            "space_omega": pose.space_omega,
        }

    def conserved(self, t, y):
        return {"energy": self.system.energy(t, y)}

    def residuals(self, t, y):
        pose = self.system.poses(y)[0]
        point, _ = self.contact(pose.rotation[2], scale(0, pose.omega))
        arm = apply(pose.rotation, point)
        slip = [a + b for a, b in zip(pose.velocity, cross(pose.space_omega, arm))]
        wanted = [1, 0, 0, 0]
        for axis, angle in zip((2, 0, 1), self.system.extra(y)):
            wanted = quaternion_product(wanted, turn(self.arithmetic, axis, angle))
        angles = max(abs(a - b) for rows in zip(pose.rotation, matrix(wanted)) for a, b in zip(*rows))
        return {"height": pose.position[2] + arm[2], "slip": max(map(abs, slip)), "angles": angles}


SCENES = [Rattleback]

if __name__ == "__main__":
    for scene in SCENES:
        if len(sys.argv) < 2 or scene.name in sys.argv[1:]:
            publish(scene)
