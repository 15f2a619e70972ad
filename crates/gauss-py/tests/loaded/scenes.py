"""The package of `examples/python` without a compiler: its structs, read from their source and loaded.

With this folder before all others in the path, the tests of that package are those of loaded models.
"""

import ast
import re
import sys
from pathlib import Path

import gauss
from gauss import _native
from gauss._native import *  # noqa: F403

HERE = Path(__file__).resolve().parents[4] / "examples/python"
SOURCE = (HERE / "src/lib.rs").read_text()
STRUCT = re.compile(r"((?:^///.*\n)*)^#\[derive\(GaussDynamics\)\]\n(#\[gauss\(\n(?:.*\n)*?\)\]\npub struct (\w+)[^}]*})", re.M)
#: Constants are arrays of literals, as in Python.
CONSTANTS = {name: ast.literal_eval(own) for name, own in re.findall(r"const (\w+): \[.*?\] = (.*);", SOURCE)}

for documentation, text, name in STRUCT.findall(SOURCE):
    text = text.replace("    python,\n", "").replace('"arm.urdf"', f'"{HERE}/arm.urdf"')
    tables = {name: own for name, own in CONSTANTS.items() if f"= {name}" in text}
    setattr(sys.modules[__name__], name, gauss.scene(documentation + text, tables=tables)._class)

_raised, stubs = _native._raised, _native.stubs
