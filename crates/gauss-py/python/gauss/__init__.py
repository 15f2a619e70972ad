"""Equations of motion of multibody systems, derived, compiled and called without a compiler.

`load` reads a robot from a URDF or MJCF file, `scene` takes a scene in words; both compile in milliseconds.
"""

from ._errors import ContactError, Mistake, ParameterError, SceneError, Violation
from ._model import Field, Kernel, Model, load, scene

__version__ = "0.1.0"
__all__ = [
    "ContactError",
    "Field",
    "Kernel",
    "Mistake",
    "Model",
    "ParameterError",
    "SceneError",
    "Violation",
    "load",
    "scene",
]
