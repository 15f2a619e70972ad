"""The package of `examples/python` without a compiler: its structs, read from their source and loaded.

With this folder before all others in the path, the tests of that package are those of loaded models.
"""

import re
import sys
from pathlib import Path

import gauss
from gauss import _native
from gauss._native import *  # noqa: F403

HERE = Path(__file__).resolve().parents[4] / "examples/python"
SOURCE = (HERE / "src/lib.rs").read_text()
STRUCT = re.compile(r"((?:^///.*\n)*)^#\[derive\(GaussDynamics\)\]\n(#\[gauss\(\n(?:.*\n)*?\)\]\npub struct (\w+)[^}]*})", re.M)
#: What a model at run time does not have: tables of Rust.
LEFT_OUT = {"Cart"}

for documentation, text, name in STRUCT.findall(SOURCE):
    if name not in LEFT_OUT:
        text = text.replace("    python,\n", "").replace('"arm.urdf"', f'"{HERE}/arm.urdf"')
        setattr(sys.modules[__name__], name, gauss.scene(documentation + text)._class)

_raised, stubs = _native._raised, _native.stubs
