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
"""

WRONG = """
import scenes
arm = scenes.Arm(mass=1.0)
arm.pose("hand", [0.0, 0.0])
arm.hessian([0.0], [0.0], [0.0], [0.0])
arm.acceleration([0.0, 0.0], [0.0, 0.0])
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
    for words in ['"mass"', '"Literal[', '"hessian"', '"input"']:
        assert words in found
