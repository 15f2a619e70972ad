"""What a call from Python costs, and a state of a batch, beside other libraries: accelerations of the arm of two joints
of examples/python, in a batch of a hundred thousand states, and of a Panda, in one of ten thousand; one thread. Each is
timed in turn, the least of the rounds is told; a batch several times in a row, so that all find their arrays in the
caches as the last call left them.

    bash benches/peers/python_calls.sh

builds the packages for the processor at hand, as heyoka's code is, installs what can be installed of the others, and
prints the tables. One state: a row of the arrays goes in, so that taking rows is part of all calls.
"""

import pathlib
import sys
import time
from types import SimpleNamespace

import numpy as np

ROUNDS, IN_A_ROW = 7, 15
HERE = pathlib.Path(__file__).resolve().parent
# Beside this file there is another `scenes`.
sys.path.pop(0)
import scenes  # noqa: E402

sys.path.append(str(HERE))
import articulated  # noqa: E402


def two_joints(q, z, u, sin, cos):
    """By hand. In angles of the rods from the vertical, A (α″, β″) = F; torques of joints act on them by differences."""
    a, b, wa, wb = q[0], q[0] + q[1], z[0], z[0] + z[1]
    m11, m12, m22 = 2.0 * 0.04 + 0.03 + 0.16, 0.4 * 0.15, 0.15**2 + 0.01
    c, s = cos(a - b), sin(a - b)
    fa = u[0] - u[1] - m12 * s * wb * wb + 9.81 * (2.0 * 0.2 + 0.4) * sin(a)
    fb = u[1] + m12 * s * wa * wa + 9.81 * 0.15 * sin(b)
    determinant = m11 * m22 - m12 * m12 * c * c
    alpha, beta = (m22 * fa - m12 * c * fb) / determinant, (m11 * fb - m12 * c * fa) / determinant
    return [alpha, beta - alpha]


def scene(name, file, kernel, equations, joints, count):
    q, z, u = (np.random.default_rng(1).standard_normal((3, count, joints)))
    return SimpleNamespace(**locals())


def all_scenes():
    yield scene("arm of two joints", HERE / "../../examples/python/arm.urdf", scenes.Arm(g=9.81), two_joints, 2, 100_000)
    # As python_calls.sh makes it: the hand is closed.
    import panda

    file = HERE / "../../target/peers/python/panda/panda.urdf"
    robot = articulated.Robot(file)
    yield scene("Panda, seven joints", file, panda.Robot(g=9.81), robot.accelerations, 7, 10_000)


def gauss(of):
    out, one = np.empty((of.count, of.joints)), np.empty(of.joints)
    single = lambda i: of.kernel.acceleration(of.q[i], of.z[i], of.u[i], out=one)
    return single, lambda: of.kernel.acceleration(of.q, of.z, of.u, out=out)


def pinocchio(of):
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(of.file))
    data = model.createData()
    # Continuous joints have a cosine and a sine.
    q = np.stack([np.cos(of.q), np.sin(of.q)], axis=2).reshape(of.count, 2 * of.joints)
    single = lambda i: pinocchio.aba(model, data, q[i], of.z[i], of.u[i])
    return single, lambda: np.array([single(i) for i in range(of.count)])


def mujoco(of):
    import re

    import mujoco

    text = of.file.read_text()
    if "<mujoco>" not in text:
        keep = "<mujoco><compiler fusestatic=\"false\" discardvisual=\"true\"/></mujoco>"
        text = re.sub(r"(<robot [^>]*>)", rf"\1{keep}", text, count=1)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)

    def single(i):
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = of.q[i], of.z[i], of.u[i]
        mujoco.mj_forward(model, data)
        return data.qacc.copy()

    return single, lambda: np.array([single(i) for i in range(of.count)])


class Plain:
    """A number of CasADi that NumPy takes for one: of CasADi's own it makes matrices."""

    def __init__(self, number):
        self.number = number

    @staticmethod
    def of(number):
        return number.number if isinstance(number, Plain) else float(number)

    def operation(compute):
        # An array does what there is to do with each of its own.
        return lambda a, b: NotImplemented if isinstance(b, np.ndarray) else Plain(compute(a.number, Plain.of(b)))

    __add__ = __radd__ = operation(lambda a, b: a + b)
    __mul__ = __rmul__ = operation(lambda a, b: a * b)
    __sub__, __rsub__ = operation(lambda a, b: a - b), operation(lambda a, b: b - a)
    __truediv__ = operation(lambda a, b: a / b)
    __neg__ = lambda a: Plain(-a.number)


def casadi(of):
    import casadi as library

    q, z, u = (library.SX.sym(name, of.joints) for name in "qzu")
    sin, cos = (lambda a: Plain(library.sin(a.number))), (lambda a: Plain(library.cos(a.number)))
    result = of.equations(*([Plain(x) for x in library.vertsplit(v)] for v in (q, z, u)), sin, cos)
    function = library.Function("f", [q, z, u], [library.vertcat(*map(Plain.of, result))], {"cse": True})
    mapped = function.map(of.count)
    return lambda i: function(of.q[i], of.z[i], of.u[i]), lambda: np.array(mapped(of.q.T, of.z.T, of.u.T)).T


def heyoka(of):
    import heyoka as library

    q, z, u = ([library.make_vars(f"{name}{k}") for k in range(of.joints)] for name in "qzu")
    function = library.cfunc(of.equations(q, z, u, library.sin, library.cos), vars=[*q, *z, *u])
    inputs = np.ascontiguousarray(np.hstack([of.q, of.z, of.u]).T)
    column, out, one = np.ascontiguousarray(inputs.T), np.empty((of.joints, of.count)), np.empty(of.joints)
    return lambda i: function(column[i], outputs=one), lambda: function(inputs, outputs=out).T


def least(call, calls=1, times=1):
    """The least time of some calls in a row."""
    found = []
    for _ in range(times):
        begin = time.perf_counter()
        call()
        found.append((time.perf_counter() - begin) / calls)
    return min(found)


def measure(of):
    print(f"\n{of.name}, a batch of {of.count} states")
    made, expected = {}, None
    for make in (gauss, pinocchio, casadi, heyoka, mujoco):
        try:
            made[make.__name__] = make(of)
        except Exception as error:
            print(f"{make.__name__}: left out, {error}")
            continue
        found = np.array([np.array(made[make.__name__][0](i)).ravel() for i in range(100)])
        expected = found if expected is None else expected
        print(f"{make.__name__}: agrees to {abs(found - expected).max() / abs(expected).max():.0e}")
    singles, batches, rust = {name: [] for name in made}, {name: [] for name in made}, []
    for _ in range(ROUNDS):
        for name, (single, batch) in made.items():
            singles[name].append(least(lambda: [single(i) for i in range(10_000)], 10_000))
            # What takes long does not gain by caches.
            batches[name].append(least(batch, of.count, IN_A_ROW if name in ("gauss", "heyoka") else 1))
        rust.append(of.kernel._batch_seconds(of.q, of.z, of.u[0]) / of.count)
    empty = min(least(lambda: [(of.q[i], of.z[i], of.u[i]) for i in range(10_000)], 10_000) for _ in range(ROUNDS))
    print(f"rows taken from the arrays alone: {1e9 * empty:.0f} ns, in all calls below")
    for name in made:
        print(f"{name:10} {1e9 * min(singles[name]):8.0f} ns a call   {1e9 * min(batches[name]):8.2f} ns a state of a batch")
    print(f"{'in Rust':10} {'':8}                {1e9 * min(rust):8.2f} ns a state of a batch (gauss-batch, one thread)")
    out = np.empty((of.count, of.joints))
    inverse = lambda: of.kernel.inverse_dynamics(of.q, of.z, of.u, of.u, out=out)
    print(f"inverse dynamics by gauss       {1e9 * least(inverse, of.count, ROUNDS * IN_A_ROW):8.2f} ns a state of a batch")


if __name__ == "__main__":
    for each in all_scenes():
        measure(each)
