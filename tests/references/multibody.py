"""Newton–Euler equations in maximal coordinates with multipliers.

Each rigid body has the position of its centre of mass G, a quaternion, the velocity of G (observer's axes) and the
angular velocity (body axes); each particle a position and a velocity. Joints, rods and rolling contacts are reactions:
every constraint of velocities contributes rows (a, α)·row = γ for the accelerations of G and the angular accelerations,
and the reactions follow from m a = m g + Σ λ row, I ω̇ + ω × I ω = Σ λ row. There are no generalised coordinates, no
kinetic energy that is differentiated and no virtual work: nothing in common with the Gauss condition but the laws of
motion.

Angles and other coordinates that a test uses ride along: their rates are read from the motion of the bodies.
"""

from vectors import (
    add,
    apply,
    apply_transposed,
    cross,
    dot,
    inverse3,
    matrix,
    outer_inertia,
    quaternion_product,
    scale,
    solve_symmetric,
    sub,
)


class Body:
    """A rigid body: mass, G − O and the inertia about O, in body axes with the origin O of the test's body."""

    size = 13

    def __init__(self, arithmetic, mass, center, inertia_about_o):
        self.mass = arithmetic(mass)
        self.center = [arithmetic(c) for c in center]
        steiner = outer_inertia(self.mass, self.center)
        self.inertia = [[arithmetic(x) - s for x, s in zip(row, shift)] for row, shift in zip(inertia_about_o, steiner)]
        self.inverse = inverse3(self.inertia)

    def from_g(self, point):
        """Body components of a point from G, given from O."""
        return sub(point, self.center)

    def place(self, position, quaternion, velocity, omega):
        """The state, from position and velocity of O in observer's axes, the quaternion and ω in body axes."""
        r = matrix(quaternion)
        spin = apply(r, cross(omega, self.center))
        return add(position, apply(r, self.center)) + list(quaternion) + add(velocity, spin) + list(omega)


class Particle:
    """A point with mass."""

    size = 6

    def __init__(self, arithmetic, mass):
        self.mass = arithmetic(mass)


class Pose:
    """One body or particle at one instant, with what the constraints ask of it."""

    def __init__(self, part, y):
        self.part = part
        self.position = y[:3]
        self.rigid = isinstance(part, Body)
        if self.rigid:
            self.velocity, self.omega = y[7:10], y[10:13]
            self.quaternion, self.rotation = y[3:7], matrix(y[3:7])
            self.space_omega = apply(self.rotation, self.omega)
        else:
            self.velocity = y[3:6]

    def origin(self):
        """O of the body: position and velocity in observer's axes."""
        arm = apply(self.rotation, self.part.center)
        return sub(self.position, arm), sub(self.velocity, cross(self.space_omega, arm))

    def kinetic_energy(self):
        """½ m v_G² + ½ ω·I_G ω."""
        energy = self.part.mass * dot(self.velocity, self.velocity) / 2
        if self.rigid:
            energy = energy + dot(self.omega, apply(self.part.inertia, self.omega)) / 2
        return energy

    def momentum(self):
        """Linear momentum."""
        return scale(self.part.mass, self.velocity)

    def angular_momentum(self):
        """About Ω, observer's axes."""
        orbital = cross(self.position, self.momentum())
        if not self.rigid:
            return orbital
        return add(orbital, apply(self.rotation, apply(self.part.inertia, self.omega)))


class Point:
    """A point of a body (components from G), a particle, or a fixed point of the observer (`part` is None)."""

    def __init__(self, part, at=None):
        self.part, self.at = part, at

    def now(self, poses):
        """Arm from G, position, velocity, and the part of the acceleration that does not contain accelerations."""
        if self.part is None:
            zero = scale(0, self.at)
            return None, self.at, zero, zero
        pose = poses[self.part]
        if self.at is None:
            return None, pose.position, pose.velocity, scale(0, pose.position)
        arm = apply(pose.rotation, self.at)
        spin = cross(pose.space_omega, arm)
        return arm, add(pose.position, arm), add(pose.velocity, spin), cross(pose.space_omega, spin)

    def row(self, arm, direction, sign):
        """Coefficients of the accelerations in sign · direction · (acceleration of the point)."""
        if self.part is None:
            return []
        direction = scale(sign, direction)
        return [(self.part, direction, None if arm is None else cross(arm, direction))]


class Coincide:
    """Two points stay together, in all directions or in some."""

    def __init__(self, first, second, directions=((1, 0, 0), (0, 1, 0), (0, 0, 1))):
        self.first, self.second, self.directions = first, second, directions

    def rows(self, poses):
        """Pairs (coefficients of the accelerations, γ)."""
        (arm, _, _, centripetal), (other_arm, _, _, other) = self.first.now(poses), self.second.now(poses)
        for direction in self.directions:
            row = self.first.row(arm, direction, 1) + self.second.row(other_arm, direction, -1)
            yield row, dot(direction, sub(other, centripetal))


class Distance:
    """Two points stay at one distance: a massless rod."""

    def __init__(self, first, second):
        self.first, self.second = first, second

    def rows(self, poses):
        """d·d̈ + ḋ² = 0."""
        (arm, x, v, a), (other_arm, other_x, other_v, other_a) = self.first.now(poses), self.second.now(poses)
        d, rate = sub(other_x, x), sub(other_v, v)
        row = self.first.row(arm, d, -1) + self.second.row(other_arm, d, 1)
        yield row, -dot(rate, rate) - dot(d, sub(other_a, a))


class Perpendicular:
    """An axis of one body (or of the observer: None) stays perpendicular to an axis of another."""

    def __init__(self, first, axis, second, other):
        self.first, self.axis, self.second, self.other = first, axis, second, other

    def rows(self, poses):
        """With n = u × w: n·(α₁ − α₂) + ṅ·(ω₁ − ω₂) = 0."""
        zero = [0, 0, 0]
        u, omega = self.axis, zero
        if self.first is not None:
            u, omega = apply(poses[self.first].rotation, u), poses[self.first].space_omega
        other_omega = poses[self.second].space_omega
        w = apply(poses[self.second].rotation, self.other)
        n = cross(u, w)
        rate = add(cross(cross(omega, u), w), cross(u, cross(other_omega, w)))
        row = [(self.second, None, scale(-1, n))]
        if self.first is not None:
            row.append((self.first, None, n))
        yield row, -dot(rate, sub(omega, other_omega))


class Rolling:
    """A body rolls without slipping on the plane through Ω across k₃.

    `contact(γ, γ̇)` gives the lowest point in body axes from G, and its rate, where γ = Rᵀk₃.
    """

    def __init__(self, part, contact):
        self.part, self.contact = part, contact

    def rows(self, poses):
        """d/dt (v_G + ω × r) = 0."""
        pose = poses[self.part]
        up = pose.rotation[2]
        r, rate = self.contact(up, cross(up, pose.omega))
        arm = apply(pose.rotation, r)
        moving = add(cross(pose.space_omega, arm), apply(pose.rotation, rate))
        gamma = scale(-1, cross(pose.space_omega, moving))
        for i, direction in enumerate(([1, 0, 0], [0, 1, 0], [0, 0, 1])):
            yield [(self.part, direction, cross(arm, direction))], gamma[i]


class System:
    """Bodies and particles with constraints in a uniform field; `gravity(t)` is the acceleration of free fall."""

    def __init__(self, parts, constraints, gravity, coordinate_rates=None):
        self.parts, self.constraints, self.gravity = parts, constraints, gravity
        self.coordinate_rates = coordinate_rates

    def poses(self, y):
        """The parts at the state y."""
        poses, start = [], 0
        for part in self.parts:
            poses.append(Pose(part, y[start : start + part.size]))
            start += part.size
        return poses

    def accelerations(self, t, poses):
        """Accelerations of G and ω̇ in body axes of every part, and the multipliers."""
        gravity = self.gravity(t)
        free = []
        for pose in poses:
            turning = None
            if pose.rigid:
                spin = apply(pose.part.inertia, pose.omega)
                turning = apply(pose.part.inverse, cross(spin, pose.omega))
            free.append((gravity, turning))
        rows, loads, right = [], [], []
        for constraint in self.constraints:
            for entries, gamma in constraint.rows(poses):
                row, load = {}, {}
                for part, linear, angular in entries:
                    pose = poses[part]
                    if angular is not None:
                        angular = apply_transposed(pose.rotation, angular)
                    row[part] = (linear, angular)
                    load[part] = (
                        None if linear is None else scale(1 / pose.part.mass, linear),
                        None if angular is None else apply(pose.part.inverse, angular),
                    )
                    gamma = gamma - pairing(row[part], free[part])
                rows.append(row)
                loads.append(load)
                right.append(gamma)
        zero = right[0] * 0 if right else 0
        lower = [
            [sum((pairing(row[part], loads[j][part]) for part in row if part in rows[j]), zero) for j in range(i + 1)]
            for i, row in enumerate(rows)
        ]
        multipliers = solve_symmetric(lower, right)
        result = [list(pair) for pair in free]
        for multiplier, load in zip(multipliers, loads):
            for part, (linear, angular) in load.items():
                if linear is not None:
                    result[part][0] = add(result[part][0], scale(multiplier, linear))
                if angular is not None:
                    result[part][1] = add(result[part][1], scale(multiplier, angular))
        return result, multipliers

    def rates(self, t, y):
        """ẏ."""
        poses = self.poses(y)
        accelerations, _ = self.accelerations(t, poses)
        result = []
        for pose, (linear, angular) in zip(poses, accelerations):
            result.extend(pose.velocity)
            if pose.rigid:
                zero = pose.omega[0] * 0
                result.extend(c / 2 for c in quaternion_product(pose.quaternion, [zero] + pose.omega))
            result.extend(linear)
            if pose.rigid:
                result.extend(angular)
        if self.coordinate_rates is not None:
            result.extend(self.coordinate_rates(t, poses))
        return result

    def extra(self, y):
        """The coordinates that ride along."""
        return y[sum(part.size for part in self.parts) :]

    def energy(self, t, y):
        """Kinetic energy minus the work of gravity from Ω."""
        poses, gravity = self.poses(y), self.gravity(t)
        terms = [pose.kinetic_energy() - pose.part.mass * dot(gravity, pose.position) for pose in poses]
        return sum(terms[1:], terms[0])

    def momenta(self, y):
        """Linear momentum, and angular momentum about Ω."""
        poses = self.poses(y)
        return add(*(pose.momentum() for pose in poses)), add(*(pose.angular_momentum() for pose in poses))


def pairing(row, acceleration):
    """row · (a, ω̇), where parts may be missing."""
    (linear, angular), (a, alpha) = row, acceleration
    parts = []
    if linear is not None and a is not None:
        parts.append(dot(linear, a))
    if angular is not None and alpha is not None:
        parts.append(dot(angular, alpha))
    return sum(parts[1:], parts[0]) if parts else 0
