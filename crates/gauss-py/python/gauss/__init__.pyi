"""Equations of motion of multibody systems, derived, compiled and called without a compiler."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._native import ContactError as ContactError
from ._native import Ends as Ends
from ._native import IntegrationError as IntegrationError
from ._native import ParameterError as ParameterError
from ._native import Run as Run
from ._native import Stepper as Stepper
from ._native import jax as jax

__version__: str

class Mistake(NamedTuple):
    """A mistake of a scene: line and column count from one, in the text of `SceneError.source`."""
    line: int
    column: int
    message: str

class SceneError(ValueError):
    """A scene that is none: `mistakes` has all of them, `source` the text that they are in."""
    mistakes: list[Mistake]
    source: str
    def __init__(self, mistakes: Iterable[tuple[int, int, str]], source: str) -> None: ...

class Limit(NamedTuple):
    """The limits of a joint, each infinite where the file has none."""
    lower: float
    upper: float
    velocity: float
    effort: float

@dataclass(frozen=True)
class Field:
    """A parameter of a scene: its unit, its type as in Rust, what it is to the body, what the equations say of it."""
    unit: str | None = None
    type: str = "f64"
    role: str | None = None
    doc: str = ""

class Model:
    """A scene with its equations. Called with its parameters as keywords, in their units, it gives a `Kernel`."""
    @property
    def name(self) -> str: ...
    @property
    def equations(self) -> str: ...
    @property
    def latex(self) -> str: ...
    @property
    def remarks(self) -> list[str]:
        """What of a robot's file does not act, and names that were changed."""
    @property
    def methods(self) -> list[str]: ...
    @property
    def operations(self) -> dict[str, dict[str, int]]: ...
    @property
    def accuracy(self) -> dict[str, tuple[float, float]]:
        """The rounding error of each method at the worst state that a search found, and the median."""
    @property
    def tables(self) -> dict[str, np.ndarray]:
        """The arrays of its tables, by the names of their constants."""
    @property
    def parameters(self) -> dict[str, tuple[int, str | None, str]]: ...
    def casadi(
        self, path: str | PathLike[str], methods: str | Iterable[str] = (), *, without_contacts: bool = False
    ) -> None:
        """Writes methods, or all, as C with the interface of CasADi's `external`, with sparse Jacobians and adjoints."""
    def __call__(self, **parameters: ArrayLike | Mapping[str, ArrayLike]) -> Kernel: ...

class Kernel(_native.Kernel):
    """A model with numbers for its parameters, which were checked: it never changes, and threads share it."""
    model: Model
    @property
    def name(self) -> str: ...
    @property
    def methods(self) -> list[str]: ...
    @property
    def remarks(self) -> list[str]: ...
    @property
    def limits(self) -> dict[str, Limit]:
        """The limits of the joints of a URDF file, by the names of their coordinates."""
    def without_contacts(self) -> Kernel: ...
    def call(
        self, method: str, *arguments: ArrayLike, t: ArrayLike = 0.0, threads: int = 1, **named: ArrayLike
    ) -> Any:
        """Calls a program by its name; `threads` share the rows of a batch."""
    def fmu(
        self, path: str | PathLike[str], *, start: Mapping[str, float] | None = None, fmi: int = 2
    ) -> str | None:
        """Writes the kernel as an FMU, of FMI 2.0 or 3.0: source code, and a binary where there is a C compiler."""
    def mjcf(self) -> str:
        """The kernel as an MJCF document, for MuJoCo."""
    def urdf(self) -> str:
        """The kernel as a URDF document: links, joints, limits, damping and dry friction."""
    def __getattr__(self, name: str) -> Any:
        """Programs that are no methods of all classes: `regressor`, `powers`, those of contacts."""

def scene(
    text: str, /, *, tables: Mapping[str, ArrayLike] | None = None, **fields: str | Field | None
) -> Model:
    """The model of a scene in words: clauses as in `#[gauss(...)]`, its parameters as keywords, and arrays of tables."""

def load(
    path: str | PathLike[str],
    clauses: str | Iterable[str] = (),
    *,
    gravity: ArrayLike | None = None,
    tables: Mapping[str, ArrayLike] | None = None,
) -> Kernel:
    """The robot of a URDF or MJCF file as a kernel, with clauses as of structs."""

def exp6(increment: ArrayLike) -> np.ndarray:
    """The motion (..., 4, 4) to which a body comes within a second at a twist (..., 6) in its own axes."""

def log6(pose: ArrayLike) -> np.ndarray:
    """The twist (..., 6) by which a body comes to a motion (..., 4, 4) within a second."""

def turned(pose: ArrayLike) -> np.ndarray:
    """The matrix (..., 6, 6) that turns twists and Jacobians from axes of a frame to the observer's."""

def adjoint(pose: ArrayLike) -> np.ndarray:
    """The same, with the pole moved to the observer's origin."""
