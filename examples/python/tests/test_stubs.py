"""Stubs: kept beside the package, and true."""

import pathlib
import subprocess
import sys

import pytest
import scenes

FILE = pathlib.Path(__file__).parent.parent / "scenes.pyi"

USE = """
import numpy as np
import scenes

arm = scenes.Arm(g=9.81)
out = np.zeros((10, 2))
arm.acceleration(np.zeros((10, 2)), np.zeros((10, 2)), [0.0, 1.0], out=out)
arm.pose("tool", [0.0, 0.0])
linear = scenes.Pendulum(mass=1.0, length=1.0, g=9.81).linearize([0.0], [0.0], [0.0])
rows: int = linear.by_state.shape[0]
run = scenes.Torpedo(mass=1, center=[0] * 3, inertia=[1] * 3, added=[0] * 6, lift=1).simulate([0], [0], (0, 1))
times = run.t + run["t"]
pendulum = scenes.Pendulum(mass=1.0, length=1.0, g=9.81)
run = pendulum.simulate(
    [0.0], [0.0], (0, 1), method="taylor", largest_step=0.1, controller=lambda t, q, z: -z, period=0.1, delay=0.01,
    events=[("angle", 0.0), (lambda t, q, z: z[0], "rising")], until=("angle", 1.0, "falling"), progress=True,
)
found: float = run.events[0].t[0] + run.events[1].z[0, 0]
pendulum.ensemble([0.0], [0.0], (0, 1), progress=print)
states = pendulum.states((10, 2), angle=0.5)
q, z = pendulum.views(states)
names = pendulum.dtype.names
arm.reaction("elbow", q, z, [0.0, 1.0], out=np.zeros((10, 6), dtype=np.float32))
pendulum.linearize(q, z, [0.0], out=tuple(np.zeros(1, dtype=np.float32) for _ in range(4)))
functions = scenes.jax(pendulum)
q, z = pendulum.project([0.0], [0.0], t=1.0)
angles = [state["angle"] + run[0]["angle"] for state in run if "angle" in run]
ends = pendulum.ensemble([0.0], [0.0], (0, 1), max_steps=10)
column, end = ends["t"] + ends.steps, ends[-1]["t"] + 1.0
try:
    pendulum.simulate([0.0], [0.0], (0, 1))
except scenes.IntegrationError as error:
    last, package = error.run.t[-1], error.package
"""

WRONG = """
import numpy as np
import scenes
arm = scenes.Arm(mass=1.0)
arm.pose("hand", [0.0, 0.0])
arm.hessian([0.0], [0.0], [0.0], [0.0])
arm.acceleration([0.0, 0.0], [0.0, 0.0])
arm.reaction("wrist", [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
arm.simulate([0.0, 0.0], [0.0, 0.0], (0, 1), method="euler")
arm.simulate([0.0, 0.0], [0.0, 0.0], (0, 1), events=[("shoulder", "falling")])
arm.pose("tool", [0.0, 0.0], out=np.zeros((4, 4), dtype=np.int64))
"""


def test_the_stubs_in_the_package_are_those_of_the_module():
    assert FILE.read_text() == scenes.stubs(), 'python -c "import scenes; print(scenes.stubs(), end=str())" > scenes.pyi'


def check(tmp_path, source):
    (tmp_path / "scenes.pyi").write_text(scenes.stubs())
    (tmp_path / "use.py").write_text(source)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "scenes.pyi", "use.py"]
    return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).stdout


def test_type_checkers_read_them(tmp_path):
    pytest.importorskip("mypy")
    assert check(tmp_path, USE) == ""


def test_type_checkers_find_mistakes(tmp_path):
    pytest.importorskip("mypy")
    found = check(tmp_path, WRONG)
    for line, words in enumerate(['"mass"', "Literal['tool']", '"hessian"', '"input"', '"reaction"', '"method"'], start=4):
        assert any(words in text for text in found.splitlines() if text.startswith(f"use.py:{line}:")), words
    assert "use.py:10:" in found and "use.py:11:" in found and "use.py:3:" not in found
