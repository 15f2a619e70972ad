"""Accelerations of a robot by the articulated-body algorithm (Featherstone 2008, table 7.1), over numbers of any kind:
floats, CasADi's or heyoka's expressions. It reads a URDF of turning, sliding and fixed joints.

Vectors are (angular, linear) in axes of the link, about its origin.
"""

import xml.etree.ElementTree as xml

import numpy as np

GRAVITY = 9.81


def numbers(text, default="0 0 0"):
    return np.array([float(word) for word in (text or default).split()])


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turn(rpy):
    """Columns are the axes of the turned frame."""
    (a, b, c), (x, y, z) = np.cos(rpy), np.sin(rpy)
    about_x = np.array([[1, 0, 0], [0, a, -x], [0, x, a]])
    about_y = np.array([[b, 0, y], [0, 1, 0], [-y, 0, b]])
    about_z = np.array([[c, -z, 0], [z, c, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def motion(rotation, place):
    """Takes vectors of the parent to the child, whose axes are the columns of the rotation, and which is at the place."""
    child = rotation.T
    return np.block([[child, np.zeros((3, 3))], [-child @ skew(place), child]])


def spatial_inertia(link):
    inertial = link.find("inertial")
    if inertial is None:
        return np.zeros((6, 6))
    mass, about = float(inertial.find("mass").get("value")), inertial.find("inertia")
    origin = inertial.find("origin")
    center = numbers(None if origin is None else origin.get("xyz"))
    axes = turn(numbers(None if origin is None else origin.get("rpy")))
    names = [["ixx", "ixy", "ixz"], ["ixy", "iyy", "iyz"], ["ixz", "iyz", "izz"]]
    moments = axes @ np.array([[float(about.get(name)) for name in row] for row in names]) @ axes.T
    c = skew(center)
    return np.block([[moments - mass * c @ c, mass * c], [-mass * c, mass * np.eye(3)]])


class Robot:
    """Links with their parents, from the base on; inertias of fixed links are added to what carries them."""

    def __init__(self, file):
        root = xml.parse(file).getroot()
        links = {link.get("name"): link for link in root.findall("link")}
        joints = root.findall("joint")
        children = {joint.find("child").get("link") for joint in joints}
        (base,) = set(links) - children
        self.names, self.parents, self.fixed, self.axes, self.slides, self.inertias = [], [], [], [], [], []

        def visit(name, carrier, placed):
            # `placed`: from the moving link that carries it.
            if carrier is not None:
                self.inertias[carrier] = self.inertias[carrier] + placed.T @ spatial_inertia(links[name]) @ placed
            for joint in (joint for joint in joints if joint.find("parent").get("link") == name):
                origin, axis = joint.find("origin"), joint.find("axis")
                get = lambda word: numbers(None if origin is None else origin.get(word))
                there = motion(turn(get("rpy")), get("xyz")) @ placed
                child = joint.find("child").get("link")
                if joint.get("type") == "fixed":
                    visit(child, carrier, there)
                    continue
                self.names.append(joint.get("name"))
                self.parents.append(carrier)
                self.fixed.append(there)
                self.axes.append(numbers(None if axis is None else axis.get("xyz"), "1 0 0"))
                self.slides.append(joint.get("type") == "prismatic")
                self.inertias.append(np.zeros((6, 6)))
                visit(child, len(self.names) - 1, np.eye(6))

        visit(base, None, np.eye(6))

    def accelerations(self, q, z, u, sin=np.sin, cos=np.cos):
        count = len(self.names)
        across, axis, velocity, bias, inertia, force = ([None] * count for _ in range(6))
        for i in range(count):
            moved = np.eye(6, dtype=object)
            s = np.zeros(6)
            if self.slides[i]:
                s[3:] = self.axes[i]
                moved = motion(np.eye(3), q[i] * self.axes[i].astype(object))
            else:
                s[:3] = self.axes[i]
                a = skew(self.axes[i])
                moved = motion(np.eye(3) + sin(q[i]) * a.astype(object) + (1 - cos(q[i])) * (a @ a).astype(object), np.zeros(3))
            across[i], axis[i] = moved @ self.fixed[i], s
            before = np.zeros(6) if self.parents[i] is None else across[i] @ velocity[self.parents[i]]
            velocity[i] = before + s.astype(object) * z[i]
            w, v = skew(velocity[i][:3]), skew(velocity[i][3:])
            cross = np.block([[w, np.zeros((3, 3))], [v, w]])
            bias[i] = cross @ (s.astype(object) * z[i])
            inertia[i] = self.inertias[i]
            force[i] = -cross.T @ (self.inertias[i] @ velocity[i])
        pushed, divisor, left = ([None] * count for _ in range(3))
        for i in reversed(range(count)):
            pushed[i] = inertia[i] @ axis[i]
            divisor[i] = axis[i] @ pushed[i]
            left[i] = u[i] - axis[i] @ force[i]
            if self.parents[i] is not None:
                k = self.parents[i]
                apparent = inertia[i] - np.outer(pushed[i], pushed[i] / divisor[i])
                acting = force[i] + apparent @ bias[i] + pushed[i] * (left[i] / divisor[i])
                inertia[k] = inertia[k] + across[i].T @ apparent @ across[i]
                force[k] = force[k] + across[i].T @ acting
        result, acceleration = [None] * count, [None] * count
        for i in range(count):
            k = self.parents[i]
            before = np.array([0, 0, 0, 0, 0, GRAVITY]) if k is None else acceleration[k]
            carried = across[i] @ before + bias[i]
            result[i] = (left[i] - pushed[i] @ carried) / divisor[i]
            acceleration[i] = carried + axis[i].astype(object) * result[i]
        return result
