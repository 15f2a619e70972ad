"""Equations of motion of multibody systems, derived, compiled and called without a compiler."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

__version__: str

class Mistake(NamedTuple):
    """A mistake of a scene: line and column count from one, in the text of `SceneError.source`."""
    line: int
    column: int
    message: str

class Violation(NamedTuple):
    """A parameter that no body has: the number that breaks a rule, the rule by its name, and both in words."""
    field: str
    value: float
    rule: str
    message: str

class SceneError(ValueError):
    """A scene that is none: `mistakes` has all of them, `source` the text that they are in."""
    mistakes: list[Mistake]
    source: str
    def __init__(self, mistakes: Iterable[tuple[int, int, str]], source: str) -> None: ...

class ParameterError(ValueError):
    """Parameters that no body has: `violations` has all of them, `fields` a pair (name, what is wrong) for each."""
    violations: list[Violation]
    fields: list[tuple[str, str]]
    message: str
    def __init__(self, violations: Iterable[tuple[str, float, str, str]], message: str) -> None: ...

class ContactError(TypeError):
    """An answer that has no forces of contacts, of a scene that has some: see `Kernel.without_contacts`."""

@dataclass(frozen=True)
class Field:
    """A parameter of a scene: its unit, its type as in Rust, what it is to the body, what the equations say of it."""
    unit: str | None = None
    type: str = "f64"
    role: str | None = None
    doc: str = ""

class Linearize(NamedTuple):
    rate: Array
    by_state: Array
    by_time: Array
    by_input: Array

class LinearizeInverse(NamedTuple):
    force: Array
    by_configuration: Array
    by_speeds: Array
    by_acceleration: Array
    by_time: Array
    by_input: Array

class Hessian(NamedTuple):
    by_state: Array
    by_input_and_state: Array
    by_input: Array

class _Described:
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
    def coordinate_names(self) -> list[str]: ...
    @property
    def speed_names(self) -> list[str]: ...
    @property
    def input_names(self) -> list[str]: ...

class Model(_Described):
    """A scene with its equations. Called with its parameters as keywords, in their units, it gives a `Kernel`."""
    @property
    def parameters(self) -> dict[str, tuple[int, str | None, str]]: ...
    def __call__(self, **parameters: ArrayLike | Mapping[str, ArrayLike]) -> Kernel: ...

class Kernel(_Described):
    """A model with numbers for its parameters, which were checked: it never changes, and threads share it."""
    model: Model
    @property
    def parameters(self) -> dict[str, float | Array]: ...
    def without_contacts(self) -> Kernel: ...
    def call(
        self, method: str, *arguments: ArrayLike, t: ArrayLike = 0.0, threads: int = 1, **named: ArrayLike
    ) -> Any: ...
    def acceleration(
        self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, threads: int = 1
    ) -> Array:
        """The rates of the speeds."""
    def inverse_dynamics(
        self,
        q: ArrayLike,
        z: ArrayLike,
        acceleration: ArrayLike,
        input: ArrayLike | None = None,
        *,
        t: ArrayLike = 0.0,
        threads: int = 1,
    ) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration."""
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, threads: int = 1) -> Array:
        """Second derivatives of the kinetic energy by z."""
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, threads: int = 1) -> Array:
        """The velocity of the configuration, seen from the body."""
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, threads: int = 1) -> Array:
        """Derivatives of the kinetic energy by z."""
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, threads: int = 1) -> Array:
        """The kinetic energy, that of a fluid included."""
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, threads: int = 1) -> Array:
        """The potential energy."""
    def linearize(
        self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, threads: int = 1
    ) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input."""
    def __getattr__(self, name: str) -> Any:
        """The other methods, those of clauses."""

def scene(text: str, /, **fields: str | Field | None) -> Model:
    """The model of a scene in words: clauses as in `#[gauss(...)]`, and its parameters as keywords."""

def load(
    path: str | PathLike[str], clauses: str | Iterable[str] = (), *, gravity: ArrayLike | None = None
) -> Kernel:
    """The robot of a URDF or MJCF file as a kernel, with clauses as of structs."""
