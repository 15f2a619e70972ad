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
    def acceleration(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the speeds.
        """
        ...
    def inverse_dynamics(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised force, dual to the speeds, that must be added for the motion to have this acceleration.
        """
        ...
    def nonlinear_effects(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Inverse dynamics at acceleration zero.
        """
        ...
    def mass_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Second derivatives of the kinetic energy by z.
        """
        ...
    def kinematics(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The velocity of the configuration, seen from the body.
        """
        ...
    def rates(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rates of the numbers of q, then those of z, for any solver.
        """
        ...
    def momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the kinetic energy by z.
        """
        ...
    def velocity(self, q: ArrayLike, p: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The speeds with these momenta.
        """
        ...
    def momentum_rate(self, q: ArrayLike, p: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rates of the momenta.
        """
        ...
    def kinetic_energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The kinetic energy, that of a fluid included.
        """
        ...
    def potential_energy(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The potential energy.
        """
        ...
    def energy(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Kinetic and potential energy.
        """
        ...
    def regularity(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The distance from a singularity of the coordinates: 0 there, 1 at best.
        """
        ...
    def retract(self, q: ArrayLike, increment: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The configuration moved by an increment that is seen from the body.
        """
        ...
    def difference(self, q: ArrayLike, other: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The shortest increment from q to the other.
        """
        ...
    def linearize(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Linearize:
        """Velocity and acceleration with their derivatives by (increment, z), time and input.
        """
        ...
    def linearize_inverse(self, q: ArrayLike, z: ArrayLike, acceleration: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> LinearizeInverse:
        """Inverse dynamics with its derivatives.
        """
        ...
    def hessian(self, q: ArrayLike, z: ArrayLike, weights: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: tuple[Array, ...] | tuple[Single, ...] | None = None, **parameters: ArrayLike) -> Hessian:
        """Second derivatives of the weighted sum of velocity and acceleration.
        """
        ...
    def pose(self, frame: str, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Rotation and origin of a frame as a matrix of four rows, frame to observer.
        """
        ...
    def twist(self, frame: str, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Velocity of a frame's origin, then angular velocity, in axes of the frame.
        """
        ...
    def jacobian(self, frame: str, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of a frame's twist by z, in axes of the frame.
        """
        ...
    def bias(self, frame: str, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Acceleration of a frame's origin, then angular, at acceleration zero; its axes.
        """
        ...
    def jacobian_rate(self, frame: str, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The rate of a frame's Jacobian.
        """
        ...
    def multipliers(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Lagrange multipliers.
        """
        ...
    def gravity_torques(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The generalised forces that balance weight and buoyancy.
        """
        ...
    def center_of_mass(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The centre of mass, in observer's axes.
        """
        ...
    def centroidal_momentum(self, q: ArrayLike, z: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Momentum, then angular momentum about the centre of mass.
        """
        ...
    def centroidal_matrix(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the centroidal momentum by z.
        """
        ...
    def center_jacobian(self, q: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of the centre's velocity.
        """
        ...
    def reaction(self, joint: str, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Force, then torque about its origin, with which a joint holds what it carries, in axes of that.
        """
        ...
    def driving_forces(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Force and power that drive each coordinate of `motions`.
        """
        ...
    def tangent(self, q: ArrayLike, change: ArrayLike, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """The increment seen from the body that changes the numbers of q by so much, to first order.
        """
        ...
    def by_parameters(self, q: ArrayLike, z: ArrayLike, input: ArrayLike | None = None, *, t: ArrayLike = 0.0, out: Array | Single | None = None, **parameters: ArrayLike) -> Array:
        """Derivatives of velocity and acceleration by `parameter_names`.
        """
        ...

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
