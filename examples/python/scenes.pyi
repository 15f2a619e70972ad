"""Rigid-body dynamics, generated. Stubs written by `stubs()` of the module."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Single = NDArray[np.float32]
Direction = Literal["any", "rising", "falling"]
Method = Literal["dormand_prince", "dormand_prince_5", "verner_9", "rosenbrock", "radau", "collocation", "collocation_4", "collocation_2", "runge_kutta_4", "commutator_free_4", "adams_10", "adams_12", "taylor"]
Function = Callable[[float, Array, Array], Any]
Input = ArrayLike | tuple[ArrayLike, ArrayLike] | Function
Contacts = Literal["events", "steps"]
Impact = Literal["newton", "moreau", "poisson", "sequential"]
Friction = Literal["coulomb", "relaxed"]
Scheme = Literal["midpoint", "moreau_jean"]
NumberEnd = tuple[str, float] | tuple[str, float, Direction]
End = NumberEnd | Function | tuple[Function, Direction]
Jump = tuple[End, Function] | tuple[End, Function, Literal["through"]]

class ParameterError(ValueError):
    """Parameters that cannot be: a pair (name, what is wrong) for each mistake."""
    fields: list[tuple[str, str]]
    package: str | None

class IntegrationError(RuntimeError):
    """A run that did not reach its end, with the states up to the last good one."""
    run: Run
    package: str | None

class ContactError(TypeError):
    """An answer that has no forces of contacts, of a scene with `contacts`, whose names these are."""
    contacts: list[str]
    package: str | None

class Run:
    """A run: its states in columns that NumPy and Arrow see without a copy."""
    @property
    def t(self) -> Array: ...
    @property
    def q(self) -> Array: ...
    @property
    def z(self) -> Array: ...
    @property
    def kinetic_energy(self) -> Array: ...
    @property
    def potential_energy(self) -> Array: ...
    @property
    def columns(self) -> list[str]: ...
    @property
    def events(self) -> list[Events]: ...
    @property
    def jumps(self) -> list[Events]: ...
    @property
    def contact_events(self) -> list[ContactEvent]: ...
    @property
    def contact_report(self) -> dict[str, float]: ...
    @property
    def sampled_gaps(self) -> list[tuple[str, float, float]]: ...
    @property
    def stopped_by(self) -> int | None: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def error(self) -> str | None: ...
    @property
    def steps(self) -> int: ...
    @property
    def rejected(self) -> int: ...
    def plot(self, *names: str | Sequence[str]) -> Any: ...
    def page(
        self,
        path: str | PathLike[str] | None = None,
        kernel: Kernel | None = None,
        *,
        title: str | None = None,
        rods: Iterable[tuple[str, str] | tuple[str, str, float]] | None = None,
        traces: Iterable[str | tuple[str, Sequence[float]]] | None = None,
        urdf: str | PathLike[str] | None = None,
        up: Sequence[float] | None = None,
        follow: str | None = None,
        si: bool = True,
    ) -> str | None:
        """The run as a page that any browser plays: curves, and the frames of a kernel; its text without a path."""
    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: int) -> dict[str, float]: ...
    def __iter__(self) -> Iterator[dict[str, float]]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

class Stepper:
    """A run that makes a step when it is asked to."""
    @property
    def t(self) -> float: ...
    @property
    def q(self) -> Array: ...
    @property
    def z(self) -> Array: ...
    @property
    def stopped_by(self) -> int | None: ...
    @property
    def steps(self) -> int: ...
    @property
    def rejected(self) -> int: ...
    def step(self, u: ArrayLike | None = None) -> Literal["step", "until", "end"]: ...
    def interpolate(self, t: float) -> tuple[Array, Array]: ...

class Events(NamedTuple):
    """Times and states of one event of a run."""
    t: Array
    q: Array
    z: Array

class ContactEvent(NamedTuple):
    """What happened at a contact: of an impact rates before and after it, the impulse, the energy that it took."""
    t: float
    contact: str
    kind: Literal["impact", "closes", "rests", "leaves", "sticks", "slides", "reverses"]
    before: Array | None
    after: Array | None
    impulse: Array | None
    energy_lost: float | None

class InContact(NamedTuple):
    """What contacts, ranges and dry joints do at a state, and their forces: normal, tangents, spin."""
    acceleration: Array
    modes: dict[str, Literal["open", "closed", "sticks", "slides"]]
    forces: dict[str, Array]

class Ends:
    """The ends of many runs, a row for each."""
    @property
    def t(self) -> Array: ...
    @property
    def q(self) -> Array: ...
    @property
    def z(self) -> Array: ...
    @property
    def steps(self) -> Array: ...
    @property
    def stopped(self) -> NDArray[np.bool_]: ...
    @property
    def errors(self) -> list[tuple[int, str]]: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def columns(self) -> list[str]: ...
    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: int) -> dict[str, float]: ...
    def __iter__(self) -> Iterator[dict[str, float]]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

def jax(kernel: Kernel) -> Any:
    """The methods of a kernel as functions of JAX: jit, vmap, jvp, grad."""

def stubs() -> str:
    """The text of the stubs of this module."""

class Kernel:
    """A kernel: parameters checked, constants computed once. It never changes, so that threads may share it."""
    @property
    def parameter_names(self) -> list[str]: ...
    @property
    def parameters(self) -> dict[str, Any]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def equations(self) -> str: ...
    @property
    def latex(self) -> str: ...
    @property
    def operations(self) -> str: ...
    @property
    def accuracy(self) -> str: ...
    @property
    def coordinate_names(self) -> list[str]: ...
    @property
    def speed_names(self) -> list[str]: ...
    @property
    def input_names(self) -> list[str]: ...
    @property
    def frames(self) -> list[str]: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def motions(self) -> list[str]: ...
    @property
    def dof(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[np.void]: ...
    def states(self, shape: int | tuple[int, ...] = (), **named: ArrayLike) -> NDArray[np.void]: ...
    def views(self, states: NDArray[np.void]) -> tuple[Array, Array]: ...
    def state(self, **named: ArrayLike) -> tuple[Array, Array]: ...
    @property
    def contact_names(self) -> list[str]: ...
    def without_contacts(self) -> Kernel: ...
    def in_contact(
        self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: float = 0.0
    ) -> InContact: ...
    def project(self, q: ArrayLike, z: ArrayLike, *, t: float = 0.0) -> tuple[Array, Array]: ...
    def simulate(
        self,
        q: ArrayLike,
        z: ArrayLike,
        interval: tuple[float, float],
        *,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        largest_step: float | None = None,
        method: Method | None = None,
        input: Input | None = None,
        controller: Function | None = None,
        period: float | None = None,
        delay: float = 0.0,
        until: End | Sequence[End] | None = None,
        events: End | Sequence[End] | None = None,
        jumps: Jump | Sequence[Jump] | None = None,
        times: ArrayLike | None = None,
        max_steps: int | None = None,
        contacts: Contacts | None = None,
        impact: Impact | None = None,
        friction: Friction | None = None,
        scheme: Scheme | None = None,
        progress: Callable[[float], object] | bool | None = None,
    ) -> Run: ...
    def stepper(
        self,
        q: ArrayLike,
        z: ArrayLike,
        interval: tuple[float, float],
        *,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        largest_step: float | None = None,
        method: Method | None = None,
        input: ArrayLike | None = None,
        until: NumberEnd | Sequence[NumberEnd] | None = None,
        max_steps: int | None = None,
    ) -> Stepper: ...
    def ensemble(
        self,
        q: ArrayLike,
        z: ArrayLike,
        interval: tuple[float, float],
        *,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        largest_step: float | None = None,
        input: ArrayLike | tuple[ArrayLike, ArrayLike] | None = None,
        until: NumberEnd | None = None,
        parameters: Mapping[str, ArrayLike] | None = None,
        max_steps: int | None = None,
        contacts: Contacts | None = None,
        impact: Impact | None = None,
        friction: Friction | None = None,
        scheme: Scheme | None = None,
        progress: Callable[[float], object] | bool | None = None,
    ) -> Ends: ...

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

class Pendulum(Kernel):
    """A pendulum with a motor in its hinge: a point on a rod.

    Parameters:
      mass: number (kg): Of the point.
      length: number (m): From the hinge to the point.
      g: number: Acceleration of free fall.

    Coordinates:
      angle: coordinate

    Speeds:
      angle_dot: rate of `angle`

    Inputs:
      motor: input, in N m
    """
    def __init__(self, *, mass: float, length: float, g: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 1), z (..., 1), acceleration (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 1) -> (..., 1, 1)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 1), z (..., 1) -> (..., 1)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 2)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 1), z (..., 1) -> (..., 1)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 1), p (..., 1) -> (..., 1)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 1), p (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 1), z (..., 1) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 1) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 1), z (..., 1) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 1) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 1), increment (..., 1) -> (..., 1)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 1), other (..., 1) -> (..., 1)
        """
        ...
    def linearize(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input.

        q (..., 1), z (..., 1), input (..., 1) -> rate (..., 2), by_state (..., 2, 2), by_time (..., 2), by_input (..., 2, 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def linearize_inverse(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> LinearizeInverse:
        """Inverse dynamics with its derivatives.

        q (..., 1), z (..., 1), acceleration (..., 1), input (..., 1) -> force (..., 1), by_configuration (..., 1, 1), by_speeds (..., 1, 1), by_acceleration (..., 1, 1), by_time (..., 1), by_input (..., 1, 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def hessian(self, q: ArrayLike, z: ArrayLike, weights: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Hessian:
        """Second derivatives of the weighted sum of velocity and acceleration.

        q (..., 1), z (..., 1), weights (..., 2), input (..., 1) -> by_state (..., 2, 2), by_input_and_state (..., 1, 2), by_input (..., 1, 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 1), change (..., 1) -> (..., 1)
        """
        ...
    def by_parameters(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of velocity and acceleration by `parameter_names`.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 2, 3)

        Inputs: motor (1,), input, in N m.
        """
        ...

class Torpedo(Kernel):
    """A torpedo as heavy as the water that it displaces; fins 0.8 m behind O hold its nose forward.

    Parameters:
      mass: number: Of the hull.
      center: array (3,): Centre of mass, from O.
      inertia: array (3,): About O, principal moments.
      added: array (6,): Of the water, about O.
      lift: number: Of the fins, in kg/m.

    Coordinates:
      pose (7 numbers): R and b of the body: x̂ = R x + b

    Speeds:
      u (3 numbers): velocity of O, body axes
      omega (3 numbers): angular velocity, body axes
    """
    def __init__(self, *, mass: float, center: ArrayLike, inertia: ArrayLike, added: ArrayLike, lift: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 7), z (..., 6), acceleration (..., 6) -> (..., 6)
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 7) -> (..., 6, 6)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 7), z (..., 6) -> (..., 13)
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 7), p (..., 6) -> (..., 6)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 7), p (..., 6) -> (..., 6)
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 7), z (..., 6) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 7) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 7), z (..., 6) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 7) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 7), increment (..., 6) -> (..., 7)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 7), other (..., 7) -> (..., 6)
        """
        ...
    def linearize(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input.

        q (..., 7), z (..., 6) -> rate (..., 12), by_state (..., 12, 12), by_time (..., 12), by_input (..., 12, 0)
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 7), change (..., 7) -> (..., 6)
        """
        ...
    def by_parameters(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of velocity and acceleration by `parameter_names`.

        q (..., 7), z (..., 6) -> (..., 12, 14)
        """
        ...

class Arm(Kernel):
    """An arm of two joints, read from its file.

    Parameters:
      g: number (m/s^2): Acceleration of free fall.

    Coordinates:
      shoulder: coordinate
      elbow: coordinate

    Speeds:
      shoulder_dot: rate of `shoulder`
      elbow_dot: rate of `elbow`

    Inputs:
      shoulder: input, in N m
      elbow: input, in N m

    The file:
      arm.urdf:26:3: the range -40 to 40 of `elbow` (`effort`) does not act; write `saturation = clamp` to cut off what is beyond, or `saturation = none`
      arm.urdf:31:24: not read, as it has no part in the motion, how many times: velocity (1)
    """
    def __init__(self, *, g: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 2), z (..., 2), input (..., 2) -> (..., 2)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 2), z (..., 2), acceleration (..., 2), input (..., 2) -> (..., 2)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 2), z (..., 2), input (..., 2) -> (..., 2)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 2) -> (..., 2, 2)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 2), z (..., 2), input (..., 2) -> (..., 4)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 2), p (..., 2) -> (..., 2)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 2), p (..., 2), input (..., 2) -> (..., 2)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 2) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 2) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 2), increment (..., 2) -> (..., 2)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 2), other (..., 2) -> (..., 2)
        """
        ...
    def pose(self, frame: Literal["tool"], q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rotation and origin of a frame as a matrix of four rows, frame to observer.

        q (..., 2) -> (..., 4, 4)
        """
        ...
    def twist(self, frame: Literal["tool"], q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Velocity of a frame's origin, then angular velocity, in axes of the frame.

        q (..., 2), z (..., 2) -> (..., 6)
        """
        ...
    def jacobian(self, frame: Literal["tool"], q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of a frame's twist by z, in axes of the frame.

        q (..., 2) -> (..., 6, 2)
        """
        ...
    def bias(self, frame: Literal["tool"], q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Acceleration of a frame's origin, then angular, at acceleration zero; its axes.

        q (..., 2), z (..., 2) -> (..., 6)
        """
        ...
    def jacobian_rate(self, frame: Literal["tool"], q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rate of a frame's Jacobian.

        q (..., 2), z (..., 2) -> (..., 6, 2)
        """
        ...
    def gravity_torques(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised forces that balance weight and buoyancy.

        q (..., 2) -> (..., 2)
        """
        ...
    def center_of_mass(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The centre of mass, in observer's axes.

        q (..., 2) -> (..., 3)
        """
        ...
    def centroidal_momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Momentum, then angular momentum about the centre of mass.

        q (..., 2), z (..., 2) -> (..., 6)
        """
        ...
    def centroidal_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the centroidal momentum by z.

        q (..., 2) -> (..., 6, 2)
        """
        ...
    def center_jacobian(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the centre's velocity.

        q (..., 2) -> (..., 3, 2)
        """
        ...
    def reaction(self, joint: Literal["shoulder", "elbow"], q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Force, then torque about its origin, with which a joint holds what it carries, in axes of that.

        q (..., 2), z (..., 2), input (..., 2) -> (..., 6)

        Inputs: shoulder (1,), input, in N m; elbow (1,), input, in N m.
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 2), change (..., 2) -> (..., 2)
        """
        ...

class Wire(Kernel):
    """A block that turns and slides on a wire around a circle: batches of a struct in `f64` go row by row.

    Parameters:
      block: mapping of mass, center_of_mass, inertia: The block.
      radius: number (m): Of the circle.
      g: array (3,): Acceleration of free fall, in the observer's axes.

    Coordinates:
      x: coordinate
      y: coordinate
      turn (4 numbers): coordinate: an element of SO(3)

    Speeds:
      x_dot: rate of `x`
      y_dot: rate of `y`
      turn_omega (3 numbers): angular velocity of `turn`, in its own axes
    """
    def __init__(self, *, block: Mapping[str, Any], radius: float, g: ArrayLike) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 6), z (..., 5) -> (..., 5)
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 6), z (..., 5), acceleration (..., 5) -> (..., 5)
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 6), z (..., 5) -> (..., 5)
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 6) -> (..., 5, 5)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 6), z (..., 5) -> (..., 5)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 6), z (..., 5) -> (..., 11)
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 6), z (..., 5) -> (..., 5)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 6), p (..., 5) -> (..., 5)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 6), p (..., 5) -> (..., 5)
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 6), z (..., 5) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 6) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 6), z (..., 5) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 6) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 6), increment (..., 5) -> (..., 6)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 6), other (..., 6) -> (..., 5)
        """
        ...
    def multipliers(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Lagrange multipliers.

        q (..., 6), z (..., 5) -> (..., 1)
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 6), change (..., 6) -> (..., 5)
        """
        ...

class Lander(Kernel):
    """A capsule that comes down on its parachute, through a wind that freshens with height.
    The canopy hangs at a fixed place above the capsule. Its drag grows with the square of its velocity against the air,
    along that velocity; the air that it carries along is a point there, which weighs nothing. The wind grows with the
    height h as h/√(h² + `layer`²): it is smooth at the ground, too, below which a step may try before it is cut at the
    touchdown. Not modelled: the weight of the canopy, its lift, slack lines, gusts, the drag of the capsule.

    Parameters:
      mass: number (kg): Of the capsule.
      inertia: array (3,): About its centre of mass, principal moments.
      drag_area: number (m^2): Of the canopy: coefficient of drag times area.
      air: number (kg): Mass of what it carries along.
      riser: number (m): From the centre of mass of the capsule up to the canopy.
      density: number (kg/m^3): Of the air.
      wind_x: number (m/s): High above the ground.
      wind_y: number (m/s): High above the ground.
      layer: number (m): Height in which the wind freshens.
      g: number (m/s^2): Acceleration of free fall.

    Coordinates:
      pose (7 numbers): R and b of the body: x̂ = R x + b

    Speeds:
      b_dot (3 numbers): velocity of O, observer's axes
      omega (3 numbers): angular velocity, body axes
    """
    def __init__(self, *, mass: float, inertia: ArrayLike, drag_area: float, air: float, riser: float, density: float, wind_x: float, wind_y: float, layer: float, g: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 7), z (..., 6), acceleration (..., 6) -> (..., 6)
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 7) -> (..., 6, 6)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 7), z (..., 6) -> (..., 13)
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 7), z (..., 6) -> (..., 6)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 7), p (..., 6) -> (..., 6)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 7), p (..., 6) -> (..., 6)
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 7), z (..., 6) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 7) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 7), z (..., 6) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 7) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 7), increment (..., 6) -> (..., 7)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 7), other (..., 7) -> (..., 6)
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 7), change (..., 7) -> (..., 6)
        """
        ...

class Puck(Kernel):
    """A puck on a floor: it bounces, slides and stays where it is.

    Parameters:
      mass: number (kg): Of the puck.
      friction: number: Between puck and floor.
      restitution: number: Of an impact on the floor.
      g: number: Acceleration of free fall.

    Coordinates:
      x: coordinate
      z: coordinate

    Speeds:
      x_dot: rate of `x`
      z_dot: rate of `z`

    Inputs:
      push: input, in N

    Contacts, whose forces `simulate`, `ensemble` and `in_contact` have:
      floor: a gap
    """
    def __init__(self, *, mass: float, friction: float, restitution: float, g: float) -> None: ...
    def without_contacts(self) -> Puck: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 2), z (..., 2), input (..., 1) -> (..., 2)

        Inputs: push (1,), input, in N.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 2), z (..., 2), acceleration (..., 2), input (..., 1) -> (..., 2)

        Inputs: push (1,), input, in N.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 2), z (..., 2), input (..., 1) -> (..., 2)

        Inputs: push (1,), input, in N.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 2) -> (..., 2, 2)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 2), z (..., 2), input (..., 1) -> (..., 4)

        Inputs: push (1,), input, in N.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 2), p (..., 2) -> (..., 2)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 2), p (..., 2), input (..., 1) -> (..., 2)

        Inputs: push (1,), input, in N.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 2) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 2) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 2), increment (..., 2) -> (..., 2)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 2), other (..., 2) -> (..., 2)
        """
        ...
    def linearize(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input.

        q (..., 2), z (..., 2), input (..., 1) -> rate (..., 4), by_state (..., 4, 4), by_time (..., 4), by_input (..., 4, 1)

        Inputs: push (1,), input, in N.
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 2), change (..., 2) -> (..., 2)
        """
        ...

class Gate(Kernel):
    """A gate between two stops, whose hinge rubs.

    Parameters:
      mass: number (kg): In the middle of the gate.
      width: number (m): From the hinge to that.
      most: number (rad): To both sides.
      restitution: number: At the stops.
      rub: number (N m): The torque of the hinge at most.

    Coordinates:
      angle: coordinate

    Speeds:
      angle_dot: rate of `angle`

    Inputs:
      motor: input, in N m

    Contacts, whose forces `simulate`, `ensemble` and `in_contact` have:
      angle_from: a gap
      angle_to: a gap
      hinge: dry friction
    """
    def __init__(self, *, mass: float, width: float, most: float, restitution: float, rub: float) -> None: ...
    def without_contacts(self) -> Gate: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 1), z (..., 1), acceleration (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 1) -> (..., 1, 1)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 1), z (..., 1) -> (..., 1)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 1), z (..., 1), input (..., 1) -> (..., 2)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 1), z (..., 1) -> (..., 1)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 1), p (..., 1) -> (..., 1)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 1), p (..., 1), input (..., 1) -> (..., 1)

        Inputs: motor (1,), input, in N m.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 1), z (..., 1) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 1) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 1), z (..., 1) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 1) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 1), increment (..., 1) -> (..., 1)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 1), other (..., 1) -> (..., 1)
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 1), change (..., 1) -> (..., 1)
        """
        ...

class Cart(Kernel):
    """A cart whose motor comes to its thrust with a lag, and gives less the faster it goes.

    Parameters:
      mass: number (kg): Of the cart.
      lag: number (s): Until the motor follows.

    Coordinates:
      x: coordinate
      thrust: state of an element

    Speeds:
      x_dot: rate of `x`

    Inputs:
      throttle: input
    """
    def __init__(self, *, mass: float, lag: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 2), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: throttle (1,), input.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 2), z (..., 1), acceleration (..., 1), input (..., 1) -> (..., 1)

        Inputs: throttle (1,), input.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 2), z (..., 1), input (..., 1) -> (..., 1)

        Inputs: throttle (1,), input.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 2) -> (..., 1, 1)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 2), z (..., 1) -> (..., 2)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 2), z (..., 1), input (..., 1) -> (..., 3)

        Inputs: throttle (1,), input.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 2), z (..., 1) -> (..., 1)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 2), p (..., 1) -> (..., 1)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 2), p (..., 1), input (..., 1) -> (..., 1)

        Inputs: throttle (1,), input.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 2), z (..., 1) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 2) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 2), z (..., 1) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 2) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 2), increment (..., 2) -> (..., 2)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 2), other (..., 2) -> (..., 2)
        """
        ...
    def linearize(self, q: ArrayLike, z: ArrayLike, input: ArrayLike, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input.

        q (..., 2), z (..., 1), input (..., 1) -> rate (..., 3), by_state (..., 3, 3), by_time (..., 3), by_input (..., 3, 1)

        Inputs: throttle (1,), input.
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 2), change (..., 2) -> (..., 2)
        """
        ...

class Bead(Kernel):
    """A bead on a ring that two laws hold, of which one would do.

    Parameters:
      mass: number (kg): Of the bead.
      radius: number (m): Of the ring.
      g: number: Acceleration of free fall.

    Coordinates:
      x: coordinate
      z: coordinate

    Speeds:
      x_dot: rate of `x`
      z_dot: rate of `z`
    """
    def __init__(self, *, mass: float, radius: float, g: float) -> None: ...
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.

        q (..., 2), z (..., 2), acceleration (..., 2) -> (..., 2)
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.

        q (..., 2) -> (..., 2, 2)
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.

        q (..., 2), z (..., 2) -> (..., 4)
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.

        q (..., 2), p (..., 2) -> (..., 2)
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.

        q (..., 2), p (..., 2) -> (..., 2)
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.

        q (..., 2) -> (...)
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.

        q (..., 2), z (..., 2) -> (...)
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.

        q (..., 2) -> (...)
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.

        q (..., 2), increment (..., 2) -> (..., 2)
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.

        q (..., 2), other (..., 2) -> (..., 2)
        """
        ...
    def multipliers(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Lagrange multipliers.

        q (..., 2), z (..., 2) -> (..., 2)
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.

        q (..., 2), change (..., 2) -> (..., 2)
        """
        ...
