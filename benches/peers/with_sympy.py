"""C by SymPy's Kane and Lagrange methods and `cse`: `python with_sympy.py FOLDER [--arm]`.

The arm takes minutes, and is left out unless it is asked for.
"""

import sys
from pathlib import Path

import sympy as sp
import sympy.physics.mechanics as me
from sympy.printing.c import C99CodePrinter

from equations import solve
from scenes import GRAVITY, S1, S2, S4, S5, S6, S7, SIZES, about_pole, diagonal
from straight_lines import HEADER, function

TIME = me.dynamicsymbols._t


class Printer(C99CodePrinter):
    """Whole powers as products, which compilers make of them only sometimes."""

    def _print_Pow(self, power):
        if power.exp.is_Integer and 1 < power.exp <= 4:
            return "(" + "*".join([self.parenthesize(power.base, 100)] * int(power.exp)) + ")"
        return super()._print_Pow(power)


def number(x):
    return sp.Float(repr(float(x)), 17) if x else sp.Integer(0)


def rows(matrix):
    return [[number(x) for x in row] for row in matrix]


def dyadic(frame, tensor):
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = rows(tensor)
    return me.inertia(frame, xx, yy, zz, xy, yz, xz)


def along(frame, components):
    return sum((c * axis for c, axis in zip(components, (frame.x, frame.y, frame.z))), me.Vector(0))


class Model:
    """What both methods are given."""

    def __init__(self, coordinates, speeds=None):
        self.space, self.origin = me.ReferenceFrame("N"), me.Point("O")
        self.origin.set_vel(self.space, 0)
        self.q = me.dynamicsymbols(" ".join(coordinates))
        self.u = me.dynamicsymbols(" ".join(speeds or [f"rate_{name}" for name in coordinates]))
        self.kinematics = [u - q.diff(TIME) for q, u in zip(self.q, self.u)]
        self.bodies, self.loads = [], []

    def body(self, frame, center, mass, inertia):
        """A body with its weight; the inertia is about its centre of mass."""
        mass = number(mass)
        self.bodies.append(me.RigidBody(f"body{len(self.bodies)}", center, frame, mass, (dyadic(frame, inertia), center)))
        self.loads.append((center, -mass * number(GRAVITY) * self.space.z))

    def kane(self):
        method = me.KanesMethod(self.space, q_ind=self.q, u_ind=self.u, kd_eqs=self.kinematics)
        method.kanes_equations(self.bodies, self.loads)
        return method.mass_matrix, method.forcing, list(self.q) + list(self.u)

    def lagrange(self):
        for body in self.bodies:
            body.potential_energy = body.mass * number(GRAVITY) * body.masscenter.pos_from(self.origin).dot(self.space.z)
        method = me.LagrangesMethod(me.Lagrangian(self.space, *self.bodies), self.q)
        method.form_lagranges_equations()
        rates = [q.diff(TIME) for q in self.q]
        named = dict(zip(rates, self.u))
        return method.mass_matrix.subs(named), method.forcing.subs(named), list(self.q) + list(self.u)


def one_body(scene, center):
    """A free body: a unit quaternion, position of O, and (u, omega) in body axes as quasi-velocities."""
    model = Model("qx qy qz qw px py pz".split(), "u1 u2 u3 w1 w2 w3".split())
    x, y, z, w = model.q[:4]
    u, omega = model.u[:3], model.u[3:]
    frame, pole, gravity_center = me.ReferenceFrame("B"), me.Point("P"), me.Point("G")
    frame.orient_explicit(
        model.space,
        sp.Matrix(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        ),
    )
    frame.set_ang_vel(model.space, along(frame, omega))
    pole.set_vel(model.space, along(frame, u))
    gravity_center.set_pos(pole, along(frame, [number(c) for c in center]))
    gravity_center.v2pt_theory(pole, model.space, frame)
    half = sp.Rational(1, 2)
    a, b, c = omega
    turned = [half * (w * a + y * c - z * b), half * (w * b + z * a - x * c), half * (w * c + x * b - y * a)]
    turned.append(-half * (x * a + y * b + z * c))
    velocity = frame.dcm(model.space).T * sp.Matrix(u)
    model.kinematics = [q.diff(TIME) - rate for q, rate in zip(model.q, turned + list(velocity))]
    model.body(frame, gravity_center, scene["mass"], scene["inertia"] if center[0] else diagonal(scene["inertia"]))
    return model


def s1():
    model = one_body(S1, [0, 0, 0])
    model.loads = []
    return model


def s2():
    return one_body(S2, S2["center_of_mass"])


def s4():
    model = Model(["a", "b", "c"])
    frame, center = me.ReferenceFrame("B"), me.Point("G")
    frame.orient_body_fixed(model.space, model.q, "ZXZ")
    # As a person writes it: angular velocity in terms of the speeds.
    frame.set_ang_vel(model.space, frame.ang_vel_in(model.space).subs({q.diff(TIME): u for q, u in zip(model.q, model.u)}))
    center.set_pos(model.origin, number(S4["center_of_mass"][2]) * frame.z)
    center.v2pt_theory(model.origin, model.space, frame)
    model.body(frame, center, S4["mass"], diagonal(S4["inertia"]))
    return model


def pendulum(jointed):
    model = Model(["a", "b"])
    upper, lower = S5["links"]
    point, before = model.origin, model.space
    for k, (link, angle) in enumerate(zip((upper, lower), model.q)):
        frame, center, end = me.ReferenceFrame(f"B{k}"), me.Point(f"G{k}"), me.Point(f"E{k}")
        parent = before if jointed else model.space
        frame.orient_axis(parent, parent.y, -angle)
        turn = -model.u[k] - (model.u[0] if jointed and k else 0)
        frame.set_ang_vel(model.space, turn * model.space.y)
        center.set_pos(point, -number(link["center"]) * frame.z)
        center.v2pt_theory(point, model.space, frame)
        if k == 0:
            end.set_pos(point, -number(link["length"]) * frame.z)
            end.v2pt_theory(point, model.space, frame)
        model.body(frame, center, link["mass"], diagonal([0.0, link["inertia"], 0.0]))
        point, before = end, frame
    return model


def s6():
    model = Model(["x", "b"])
    pole, cart = S6["pole"], me.Point("C")
    cart.set_pos(model.origin, model.q[0] * model.space.x)
    cart.set_vel(model.space, model.u[0] * model.space.x)
    frame, center = me.ReferenceFrame("B"), me.Point("G")
    frame.orient_axis(model.space, model.space.y, model.q[1])
    frame.set_ang_vel(model.space, model.u[1] * model.space.y)
    center.set_pos(cart, number(pole["center"]) * frame.z)
    center.v2pt_theory(cart, model.space, frame)
    model.body(frame, center, pole["mass"], diagonal([0.0, pole["inertia"], 0.0]))
    particle = me.Particle("cart", cart, number(S6["cart"]))
    particle.potential_energy = 0
    model.bodies.append(particle)
    return model


def s7():
    model = Model([f"q{k}" for k in range(7)])
    point, before, velocity = model.origin, model.space, me.Vector(0)
    for k, (link, angle) in enumerate(zip(S7, model.q)):
        turned, frame, pole, center = me.ReferenceFrame(f"A{k}"), me.ReferenceFrame(f"B{k}"), me.Point(f"P{k}"), me.Point(f"G{k}")
        n = link["quarter_turns"]
        turned.orient_explicit(before, sp.Matrix([[1, 0, 0], [0, 1 - abs(n), -n], [0, n, 1 - abs(n)]]))
        frame.orient_axis(turned, turned.z, angle)
        velocity = along(frame, (velocity.to_matrix(frame))) + model.u[k] * frame.z
        frame.set_ang_vel(model.space, velocity)
        pole.set_pos(point, along(before, [number(x) for x in link["position"]]))
        pole.v2pt_theory(point, model.space, before)
        center.set_pos(pole, along(frame, [number(x) for x in link["center"]]))
        center.v2pt_theory(pole, model.space, frame)
        model.body(frame, center, link["mass"], link["inertia"])
        point, before = pole, frame
    return model


def code(name, derived):
    """Shared subexpressions of mass matrix and forces, then elimination in scalars; a constant matrix is inverted beforehand."""
    matrix, forces, state = derived
    loads = [f"s{k}_" for k in range(SIZES[name][0])]
    named = dict(zip(state, sp.symbols(loads)))
    matrix, forces = matrix.xreplace(named), forces.xreplace(named)
    n = len(forces)
    if not matrix.free_symbols:
        inverse = matrix.inv().applyfunc(lambda x: sp.Integer(0) if abs(x) < 1e-15 else x)
        # Before or after the subexpressions of the forces are shared, whichever leaves less to compute.
        named_forces = sp.symbols([f"f{k}" for k in range(n)])
        multiplied = [sp.expand(x) for x in inverse * forces]
        multiplied = [sum(term for term in sp.Add.make_args(x) if abs(term.as_coeff_Mul()[0]) > 1e-15) for x in multiplied]
        shared, named_results = sp.cse(list(forces), symbols=sp.numbered_symbols("b"))
        before = (shared + list(zip(named_forces, named_results)), list(inverse * sp.Matrix(named_forces)))
        return written(name, *min(before, sp.cse(multiplied, symbols=sp.numbered_symbols("b")), key=work), loads)
    # The product with the inverse is spelt out in symbols, so that what is zero stays zero.
    definitions, (matrix, forces) = sp.cse([matrix, forces], symbols=sp.numbered_symbols("a"))
    lower = [[0.0 if matrix[i, j] == 0 else matrix[i, j] for j in range(i + 1)] for i in range(n)]
    results = solve(lower, list(forces))
    shared, results = sp.cse([sp.sympify(x) for x in results], symbols=sp.numbered_symbols("b"))
    return written(name, definitions + shared, results, loads)


def work(way):
    return sp.count_ops([e for _, e in way[0]]) + sp.count_ops(way[1])


def written(name, definitions, results, loads):
    text = Printer().doprint
    return function(name, SIZES[name][0], [(str(s), text(e)) for s, e in definitions], map(text, results), loads)


def main():
    folder, with_arm = Path(sys.argv[1]), "--arm" in sys.argv
    scenes = {"s4": s4, "s5": lambda: pendulum(False), "s5_jointed": lambda: pendulum(True), "s6": s6}
    if with_arm:
        scenes["s7"] = s7
    kane = {"s1": s1, "s2": s2, **scenes}
    text = "".join(code(name, model().kane()) for name, model in kane.items())
    (folder / "sympy_kane.c").write_text(HEADER + text)
    text = "".join(code(name, lagrangian(model())) for name, model in scenes.items() if name != "s7")
    (folder / "sympy_lagrange.c").write_text(HEADER + text)


def lagrangian(model):
    """Lagrange's method wants rates of coordinates where Kane's is given speeds."""
    rates = {u: q.diff(TIME) for q, u in zip(model.q, model.u)}
    for body in model.bodies:
        point = body.masscenter if isinstance(body, me.RigidBody) else body.point
        point.set_vel(model.space, point.vel(model.space).subs(rates))
        if isinstance(body, me.RigidBody):
            body.frame.set_ang_vel(model.space, body.frame.ang_vel_in(model.space).subs(rates))
    return model.lagrange()


if __name__ == "__main__":
    main()
