"""Equations of motion of multibody systems, derived, compiled and called without a compiler.

`load` reads a robot from a URDF or MJCF file, `scene` takes a scene in words; both compile in milliseconds.
"""

from ._errors import Mistake, SceneError
from ._lie import adjoint, exp6, log6, turned
from ._model import Field, Kernel, Limit, Model, load, scene
from ._native import ContactError, Ends, IntegrationError, ParameterError, Run, Stepper, jax

__version__ = "0.1.0"
__all__ = [
    "ContactError",
    "Ends",
    "Field",
    "IntegrationError",
    "Kernel",
    "Limit",
    "Mistake",
    "Model",
    "ParameterError",
    "Run",
    "SceneError",
    "Stepper",
    "adjoint",
    "exp6",
    "jax",
    "load",
    "log6",
    "scene",
    "turned",
]
