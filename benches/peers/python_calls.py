"""What a call from Python costs, and a batch of a hundred thousand states, beside other libraries: the arm of two
joints of examples/python, accelerations, one thread. Each is timed in turn, the least of the rounds is told; a batch
several times in a row, so that all find their arrays in the caches as the last call left them.

    bash benches/peers/python_calls.sh

builds the package for the processor at hand, as heyoka's code is, installs what can be installed of the others, and
prints the table. One state: a row of the arrays goes in, so that taking rows is part of all calls.
"""

import pathlib
import sys
import time

import numpy as np

# Beside this file there is another `scenes`.
sys.path.pop(0)
import scenes  # noqa: E402

URDF = pathlib.Path(__file__).resolve().parents[2] / "examples/python/arm.urdf"
COUNT, ROUNDS, IN_A_ROW = 100_000, 7, 15
rng = np.random.default_rng(1)
Q, Z, U = (rng.standard_normal((COUNT, 2)) for _ in range(3))


def gauss():
    arm = scenes.Arm(g=9.81)
    out, one = np.empty((COUNT, 2)), np.empty(2)
    single = lambda i: arm.acceleration(Q[i], Z[i], U[i], out=one)
    return single, lambda: arm.acceleration(Q, Z, U, out=out)


def pinocchio():
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(URDF))
    data = model.createData()
    # Continuous joints have a cosine and a sine.
    q = np.stack([np.cos(Q), np.sin(Q)], axis=2).reshape(COUNT, 4)
    single = lambda i: pinocchio.aba(model, data, q[i], Z[i], U[i])
    return single, lambda: np.array([pinocchio.aba(model, data, q[i], Z[i], U[i]) for i in range(COUNT)])


def mujoco():
    import mujoco

    model = mujoco.MjModel.from_xml_string(
        URDF.read_text().replace(
            "<robot name=\"arm\">", "<robot name=\"arm\"><mujoco><compiler fusestatic=\"false\"/></mujoco>"
        )
    )
    data = mujoco.MjData(model)

    def single(i):
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = Q[i], Z[i], U[i]
        mujoco.mj_forward(model, data)
        return data.qacc.copy()

    return single, lambda: np.array([single(i) for i in range(COUNT)])


def casadi_function():
    """Accelerations as an expression: q″ from mass matrix and bias of two rods in the plane, as a textbook has them."""
    import casadi

    q, z, u = (casadi.SX.sym(name, 2) for name in "qzu")
    a, b = q[0], q[0] + q[1]
    wa, wb = z[0], z[0] + z[1]
    velocity = lambda r, s: (r * wa * casadi.cos(a) + s * wb * casadi.cos(b), -r * wa * casadi.sin(a) - s * wb * casadi.sin(b))
    kinetic = 0
    for mass, inertia, r, s, w in [(2.0, 0.03, 0.2, 0.0, wa), (1.0, 0.01, 0.4, 0.15, wb)]:
        vx, vz = velocity(r, s)
        kinetic += mass / 2 * (vx**2 + vz**2) + inertia / 2 * w**2
    potential = 9.81 * (2.0 * 0.2 * casadi.cos(a) + 0.4 * casadi.cos(a) + 0.15 * casadi.cos(b))
    lagrange = kinetic - potential
    momentum = casadi.gradient(lagrange, z)
    mass = casadi.jacobian(momentum, z)
    right = u + casadi.gradient(lagrange, q) - casadi.jtimes(momentum, q, z)
    return q, z, u, casadi.solve(mass, right)


def casadi():
    import casadi as library

    *arguments, result = casadi_function()
    function = library.Function("f", arguments, [result])
    mapped = function.map(COUNT)
    return lambda i: function(Q[i], Z[i], U[i]), lambda: np.array(mapped(Q.T, Z.T, U.T)).T


def heyoka():
    import heyoka as library

    # The same expressions, by CasADi's operations on heyoka's symbols would not go: written once more.
    q, z, u = ([library.make_vars(f"{name}{k}") for k in range(2)] for name in "qzu")
    a, b, wa, wb = q[0], q[0] + q[1], z[0], z[0] + z[1]
    sin, cos = library.sin, library.cos
    m11, m12, m22 = 2.0 * 0.04 + 0.03 + 0.16, 0.4 * 0.15, 0.15**2 + 0.01
    c, s = cos(a - b), sin(a - b)
    # In angles of the rods from the vertical, A (α″, β″) = F; torques of joints act on them by differences.
    fa = u[0] - u[1] - m12 * s * wb * wb + 9.81 * (2.0 * 0.2 + 0.4) * sin(a)
    fb = u[1] + m12 * s * wa * wa + 9.81 * 0.15 * sin(b)
    determinant = m11 * m22 - m12 * m12 * c * c
    alpha, beta = (m22 * fa - m12 * c * fb) / determinant, (m11 * fb - m12 * c * fa) / determinant
    function = library.cfunc([alpha, beta - alpha], vars=[*q, *z, *u])
    inputs = np.ascontiguousarray(np.hstack([Q, Z, U]).T)
    column, out, one = np.ascontiguousarray(inputs.T), np.empty((2, COUNT)), np.empty(2)
    return lambda i: function(column[i], outputs=one), lambda: function(inputs, outputs=out).T


def least(call, calls=1, times=1):
    """The least time of some calls in a row."""
    found = []
    for _ in range(times):
        begin = time.perf_counter()
        call()
        found.append((time.perf_counter() - begin) / calls)
    return min(found)


def main():
    made, expected = {}, None
    for make in (gauss, pinocchio, casadi, heyoka, mujoco):
        try:
            made[make.__name__] = make()
        except Exception as error:
            print(f"{make.__name__}: left out, {error}")
            continue
        found = np.array([np.array(made[make.__name__][0](i)).ravel() for i in range(100)])
        expected = found if expected is None else expected
        print(f"{make.__name__}: agrees to {abs(found - expected).max() / abs(expected).max():.0e}")
    singles, batches = {name: [] for name in made}, {name: [] for name in made}
    rust = []
    arm = scenes.Arm(g=9.81)
    for _ in range(ROUNDS):
        for name, (single, batch) in made.items():
            singles[name].append(least(lambda: [single(i) for i in range(10_000)], 10_000))
            # What takes long does not gain by caches.
            batches[name].append(least(batch, COUNT, IN_A_ROW if name in ("gauss", "heyoka") else 1))
        rust.append(arm._batch_seconds(Q, Z, U[0]) / COUNT)
    empty = min(least(lambda: [(Q[i], Z[i], U[i]) for i in range(10_000)], 10_000) for _ in range(ROUNDS))
    print(f"rows taken from the arrays alone: {1e9 * empty:.0f} ns, in all calls below")
    for name in made:
        print(f"{name:10} {1e9 * min(singles[name]):8.0f} ns a call   {1e9 * min(batches[name]):8.2f} ns a state of a batch")
    print(f"{'in Rust':10} {'':8}                {1e9 * min(rust):8.2f} ns a state of a batch (gauss-batch, one thread)")


if __name__ == "__main__":
    main()
