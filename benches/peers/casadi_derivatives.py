"""Accelerations of a chain, their Jacobian, and the Hessian of a weighted sum of them, in CasADi: functions that
`cargo gauss show --as casadi` writes, and expressions of CasADi by urdf2casadi, in its virtual machine and as C.

`pip install casadi urdf2casadi` and a C compiler; then `python benches/peers/casadi_derivatives.py`. The chain is the
Panda of `tests/robots` without its second finger, for urdf2casadi knows chains alone. Medians, in one process.
"""

import subprocess
import tempfile
import time
from pathlib import Path
from xml.etree import ElementTree

import casadi as ca
import numpy as np
import urdf2casadi.urdfparser as u2c

ROOT = Path(__file__).parents[2]
STRUCT = '#[derive(GaussDynamics)]\n#[gauss(urdf = "{}", gravity = 9.81)]\nstruct Chain {{}}\n'


def chain(folder):
    tree = ElementTree.parse(ROOT / "tests/robots/panda.urdf")
    for element in list(tree.getroot()):
        if "finger_joint2" in element.get("name", ""):
            tree.getroot().remove(element)
    tree.write(folder / "chain.urdf")
    return folder / "chain.urdf"


def library(source):
    start = time.perf_counter()
    subprocess.run(["cc", "-O1", "-shared", "-fPIC", source, "-o", source.with_suffix(".so"), "-lm"], check=True)
    lines = len(source.read_text().splitlines())
    print(f"{source.name}: {lines} lines, compiled in {time.perf_counter() - start:.1f} s")
    return str(source.with_suffix(".so"))


def ours(folder, robot):
    (folder / "chain.rs").write_text(STRUCT.format(robot))
    command = [ROOT / "target/release/cargo-gauss", "gauss", "show", folder / "chain.rs", "--as", "casadi"]
    subprocess.run([*command, "--method", "acceleration", "-o", folder / "chain.c"], check=True)
    function = ca.external("chain_acceleration", library(folder / "chain.c"))
    return lambda q, z, u: function(0, q, z, u)


def theirs(robot):
    parser = u2c.URDFparser()
    parser.from_file(str(robot))
    tip = "panda_finger_joint1_link"
    dynamics = parser.get_forward_dynamics_aba("base_link", tip, gravity=[0, 0, -9.81])
    return parser.get_n_joints("base_link", tip), dynamics


def functions(dynamics, kind, n):
    x, w = kind.sym("x", 3 * n), kind.sym("w", n)
    value = dynamics(x[:n], x[n:2 * n], x[2 * n:])
    return [
        ca.Function("accelerations", [x], [value]),
        ca.Function("jacobian", [x], [ca.jacobian(value, x)]),
        ca.Function("hessian", [x, w], [ca.jacobian(ca.gradient(ca.dot(w, value), x), x)]),
    ]


def as_c(own, folder):
    code = ca.CodeGenerator("expressions.c")
    for function in own:
        code.add(function)
    code.generate(f"{folder}/")
    file = library(folder / "expressions.c")
    return [ca.external(function.name(), file) for function in own]


def timed(function, arguments):
    """The median of seven times of a call in microseconds, without what Python adds."""
    buffer, call = function.buffer()
    held = [np.ascontiguousarray(argument, dtype=float) for argument in arguments]
    for place, argument in enumerate(held):
        buffer.set_arg(place, memoryview(argument))
    result = np.zeros(function.nnz_out(0))
    buffer.set_res(0, memoryview(result))
    start = time.perf_counter()
    call()
    count = max(10, int(0.1 / (time.perf_counter() - start)))
    spans = []
    for _ in range(7):
        start = time.perf_counter()
        for _ in range(count):
            call()
        spans.append((time.perf_counter() - start) / count)
    return 1e6 * float(np.median(spans))


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        robot = chain(folder)
        n, dynamics = theirs(robot)
        own = functions(ours(folder, robot), ca.MX, n)
        machine = functions(dynamics, ca.SX, n)
        compiled = as_c(machine, folder)
        random = np.random.default_rng(0)
        x, w = random.uniform(-1, 1, 3 * n), random.uniform(-1, 1, n)
        for mine, interpreted, code, arguments in zip(own, machine, compiled, [[x], [x], [x, w]]):
            wanted = np.array(interpreted(*arguments))
            off = np.abs(np.array(mine(*arguments)) - wanted).max() / np.abs(wanted).max()
            times = [timed(function, arguments) for function in [mine, interpreted, code]]
            print("{}: {:.2f} µs; of urdf2casadi {:.1f} in the virtual machine, {:.2f} as C; apart {:.1e}".format(
                mine.name(), *times, off))


if __name__ == "__main__":
    main()
