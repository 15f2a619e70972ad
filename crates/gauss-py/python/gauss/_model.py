"""Models and kernels: scenes and robots that are derived and compiled at run time."""

import os
import re
import tempfile
import weakref
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from . import _native
from ._calls import Plan, numbers
from ._errors import SceneError
from ._native import ContactError

#: Methods about contacts themselves; all others with an input lack their forces.
OF_CONTACTS = {"friction", "impulse_dynamics", "element_forces", "powers", "supplied_power"}


class Limit(NamedTuple):
    """The limits of a joint, each infinite where the file has none: of its coordinate (rad, m), of its speed and of its
    effort (N m, N)."""

    lower: float
    upper: float
    velocity: float
    effort: float


@dataclass(frozen=True)
class Field:
    """A parameter of a scene: its unit ("kg m^2", or None), its type as in Rust ("Vector3<f64>", "RigidBody<f64>"),
    what it is to the body ("gravity", "mass", "inertia", "body"), and what the equations say of it."""

    unit: str | None = None
    type: str = "f64"
    role: str | None = None
    doc: str = ""

    def line(self, name):
        """The field of the struct."""
        if not name.isidentifier():
            raise ValueError(f"{name!r} is no name of a parameter")
        quoted = {key: '"' + own.replace("\\", "\\\\").replace('"', '\\"') + '"' for key, own in self._texts()}
        doc = f"#[doc = {quoted['doc']}] " if self.doc else ""
        role = f"#[gauss({self.role})] " if self.role else ""
        unit = f"#[gauss(unit = {quoted['unit']})] " if self.unit else ""
        return f"    {doc}{role}{unit}{name}: {self.type},"

    def _texts(self):
        return (("doc", " ".join(self.doc.split())), ("unit", self.unit or ""))


class Model:
    """A scene with its equations. Called with its parameters as keywords, in their units, it gives a `Kernel`."""

    def __init__(self, native, recipe):
        self._native_model, self._recipe = native, recipe
        own = {"model": self, "__module__": Kernel.__module__}
        self._class = type(native.name, (Kernel,), native.attributes() | own)
        self._axes = {name: tuple(axes) for name, axes in native.axes}

    @property
    def name(self):
        return self._native_model.name

    @property
    def equations(self):
        return self._native_model.equations

    @property
    def latex(self):
        return self._native_model.latex

    @property
    def remarks(self):
        return self._native_model.remarks

    @property
    def methods(self):
        return self._native_model.methods

    @property
    def operations(self):
        kinds = ("additions", "multiplications", "divisions", "roots", "transcendentals")
        return {name: dict(zip(kinds, counts)) for name, counts in self._native_model.operations}

    @property
    def accuracy(self):
        return {name: tuple(lost) for name, lost in self._native_model.accuracy}

    @property
    def tables(self):
        """The arrays of its tables, by the names of their constants."""
        return {name: np.frombuffer(own).reshape(shape) for name, shape, own in self._recipe[1]}

    @property
    def parameters(self):
        """The parameters: of each how many numbers it has (matrices row after row), its unit, its documentation."""
        return {name: (count, unit, doc) for name, count, unit, doc in self._native_model.parameters}

    def __call__(self, **parameters):
        return self._class(**parameters)

    def casadi(self, path, methods=(), *, without_contacts=False):
        """Writes methods, or all, as C with the interface of CasADi's `external`: functions `arm_acceleration`, of
        the name of the model and the method, which take the parameters first, with sparse Jacobians and adjoints.

        `cc -O2 -shared -fPIC arm.c -o arm.so -lm` compiles it, `casadi.external("arm_acceleration", "./arm.so")` takes
        one. Forces of contacts are in none of them: in a scene with contacts that is to be said, `without_contacts`.
        Raises ValueError with the names of methods that are not there, ContactError, and OSError where nothing can be
        written.
        """
        methods = [methods] if isinstance(methods, str) else list(methods)
        source = self._native_model.casadi(methods)
        if self._native_model.contacts and not without_contacts:
            moved = [name for name in methods or self.methods if self._leaves_contacts_out(name)]
            if moved:
                raise ContactError(
                    f"{', '.join(moved)} would have no forces of contacts, and the scene has "
                    f"{', '.join(self._native_model.contacts)}; say `without_contacts=True` for all gaps open"
                )
        with open(path, "w", encoding="utf-8") as file:
            file.write(source)

    def _leaves_contacts_out(self, method):
        """Whether inputs act in a method, as forces of contacts would."""
        return method not in OF_CONTACTS and "input" in Plan(method, self._native_model.signature(method)).sizes

    def _repr_latex_(self):
        return f"$$\n{self.latex}\n$$"

    def __repr__(self):
        return f"<gauss.Model {self.name}({', '.join(self.parameters)})>"

    def __eq__(self, other):
        return self._recipe == other._recipe if isinstance(other, Model) else NotImplemented

    def __hash__(self):
        return hash(self._recipe)

    def __reduce__(self):
        return _restored, (self._recipe,)


class Kernel(_native.Kernel):
    """A model with numbers for its parameters, which were checked: it never changes, and threads share it.

    Its methods are those of the classes of compiled structs: q, z, input and others are arrays of shape (..., n), of
    which the last axis has the numbers of one state; one without leading axes is for all states. In q come, part by
    part, of rotations the unit quaternion x, y, z, w, of poses this and then the position, of poses in the plane
    cosine, sine and position; plain coordinates come last: `coordinate_names` has them all. Programs of the model that
    are no such methods (`regressor`, `powers`, those of contacts) are called by their names as well.
    """

    model = None

    @property
    def name(self):
        return self.model.name

    @property
    def methods(self):
        return self.model.methods

    @property
    def remarks(self):
        return self.model.remarks

    @cached_property
    def limits(self):
        """The `Limit` of each joint of a URDF file, by the name of its coordinate. They act where a clause says so."""
        kind, *_, files = self.model._recipe
        if kind != "file" or self.model._recipe[2] != "urdf":
            raise ValueError(f"limits are read from URDF files, and {self.name} is of none")
        called = dict(re.findall("the joint `(.*?)` is called `(.*?)`", "\n".join(self.remarks)))
        known = {}
        for joint in ElementTree.fromstring(files[0][1]).iter("joint"):
            # Joints of transmissions have no type.
            name, limit = joint.get("name"), joint.find("limit")
            if joint.get("type") and name is not None:
                known[called.get(name, name)] = _limit(joint.get("type"), {} if limit is None else limit.attrib)
        return {name: known[name] for name in self.coordinate_names if name in known}

    @cached_property
    def _programs(self):
        return self.model._native_model.programs(list(_flat(self.parameters).items()))

    @cached_property
    def _plans(self):
        return {}

    def _plan(self, method):
        plan = self._plans.get(method)
        if plan is None:
            if method not in self.methods:
                raise AttributeError(f"{self.name} has no method `{method}`; it has {', '.join(self.methods)}")
            plan = self._plans[method] = Plan(method, self.model._native_model.signature(method))
        return plan

    def call(self, method, *arguments, t=0.0, threads=1, **named):
        """Calls a program by its name; `threads` share the rows of a batch. Parameters are keywords in place of those
        of the kernel, one for all rows or one for each."""
        plan = self._plan(method)
        if "input" in plan.sizes and method not in OF_CONTACTS and self._touches:
            raise ContactError(
                f"{method} has no forces of contacts, and the scene has {', '.join(self.contact_names)}; with "
                f"`kernel.without_contacts().{method}` all gaps are open, and nothing rubs"
            )
        axes = self.model._axes
        own = {name: (axes[name], named.pop(name)) for name in axes if name in named and name not in plan.sizes}
        return plan.call(self._programs, arguments, named, t, threads, own)

    def fmu(self, path, *, start=None, fmi=2):
        """Writes the kernel as an FMU, of FMI 2.0 or 3.0: source code, and a binary where there is a C compiler.

        Its parameters are the start values; `start` has those of states by name, {"elbow": 0.3}. The name of the file,
        `arm.fmu`, is that of the binary. Gives the platform of the binary, None without one. Raises ValueError for what
        FMI has no counterpart for, with the clause, and OSError where nothing can be written.
        """
        parameters = list(_flat(self.parameters).items())
        start = [(name, float(value)) for name, value in (start or {}).items()]
        return _native.write_fmu(_text(self.model._recipe), parameters, start, fmi, os.fspath(path))

    def mjcf(self):
        """The kernel as an MJCF document, for MuJoCo: a joint for each coordinate, its parameters as numbers.

        Comments say what MuJoCo does in another way, such as contacts. Raises ValueError for what MJCF has no
        counterpart for, with the clause.
        """
        return _native.mjcf(_text(self.model._recipe), list(_flat(self.parameters).items()))

    def urdf(self):
        """The kernel as a URDF document: links with masses, joints with limits, damping, dry friction and mimics.

        Comments say what is lost: gravity, springs, contacts. Raises ValueError for what URDF has no counterpart for,
        with the clause.
        """
        return _native.urdf(_text(self.model._recipe), list(_flat(self.parameters).items()))

    def __getattr__(self, name):
        if name.startswith("_") or self.model is None or name not in self.methods:
            raise AttributeError(f"{type(self).__name__} has no `{name}`")

        def method(*arguments, t=0.0, threads=1, **named):
            return self.call(name, *arguments, t=t, threads=threads, **named)

        method.__name__ = name
        method.__doc__ = self._plan(name).documentation()
        return method

    def __setattr__(self, name, value):
        # Classes of the user's own may have what they like.
        if type(self) is self.model._class:
            raise AttributeError(f"`{name}` cannot be set: a kernel never changes, its model makes another")
        super().__setattr__(name, value)

    def __dir__(self):
        return sorted({*super().__dir__(), *self.methods})

    def __reduce__(self):
        make, nothing = super().__reduce__()
        # A class of the user's own is found by its name.
        return (_kernel, (self.model, make.keywords)) if type(self) is self.model._class else (make, nothing)


def _limit(kind, given):
    def number(name, without):
        return float(given[name]) if name in given else without

    # Of a limit without numbers they are zero in URDF; a joint that turns on and on has no ends.
    ends = (-np.inf, np.inf) if kind == "continuous" else (number("lower", 0.0), number("upper", 0.0))
    return Limit(*ends, number("velocity", np.inf), number("effort", np.inf))


def _kernel(model, parameters):
    return model(**parameters)


def _flat(given):
    """The numbers of each parameter: of a body those of its parts."""
    flat = {}
    for name, value in given.items():
        parts = value.items() if isinstance(value, dict) else [("", value)]
        flat |= {f"{name}.{part}" if part else name: np.ravel(own).tolist() for part, own in parts}
    return flat


def scene(text, /, *, tables=None, **fields):
    """The model of a scene in words: clauses as in `#[gauss(...)]`, and its parameters as keywords, each with its unit
    (None where it has none) or a `Field`; or a text with the struct itself, and no keywords.

    `tables` has an array for each constant that a clause `table(...)` names, by that name: {"POWER": points} of
    `table(power, points = POWER)`. Points have the shape (n, 2), each of the `axes` the shape (n,), and `values` an
    axis for each of these; units are those of the law that the table stands in.

    Raises `SceneError` with all mistakes of the text, then `ParameterError` with all of the arrays.
    """
    tables = _arrays(tables)
    if "struct" in text.split():
        if fields:
            raise TypeError("a text with a struct has its parameters in it; remove the keywords")
        return _restored(("text", tables, text, 0, ()))
    values = [name for name, own in fields.items() if not (own is None or isinstance(own, (str, Field)))]
    if values:
        name = values[0]
        raise TypeError(
            f"{', '.join(values)}: a scene takes the unit of each parameter, None without one; values go to the model "
            f"that it gives: scene(..., {name}=None)({name}={fields[name]!r})"
        )
    lines = [(own if isinstance(own, Field) else Field(own)).line(name) for name, own in fields.items()]
    source = "\n".join(["#[gauss(", text, ")]", "struct Scene {", *lines, "}", ""])
    try:
        return _restored(("text", tables, source, 1, ()))
    except SceneError:
        _check_brackets(text)
        raise


def _check_brackets(text):
    """Raises what the brackets of clauses alone have wrong: what stands around them would close some."""
    try:
        _native.Model.of_text(text)
    except SceneError as error:
        if any(" closes " in message and "this `" in message for _, _, message in error.mistakes):
            raise error from None


def _arrays(tables):
    """Arrays of tables as what can be compared and pickled: name, shape and bytes of each."""
    arrays = [(str(name), numbers(f"tables[{name!r}]", own)) for name, own in (tables or {}).items()]
    return tuple((name, own.shape, own.tobytes()) for name, own in arrays)


def _with_tables(native, tables):
    # Each of a copy, which is aligned.
    return native.with_tables([(name, np.frombuffer(own).reshape(shape).copy()) for name, shape, own in tables])


def load(path, clauses=(), *, gravity=None, tables=None):
    """The robot of a URDF or MJCF file as a kernel, with clauses as of structs: "linearize", "base = floating".

    `gravity` is a number, along -z, in m/s², or three. A URDF file says none, so it must be given (0 is none); an MJCF
    file has its own. `tables` are those of clauses, as of `scene`. Raises `SceneError` with all mistakes,
    `ParameterError` with all of the arrays of tables, OSError where no file can be read.
    """
    clauses = [clauses] if isinstance(clauses, str) else list(clauses)
    path = Path(path)
    format = _format(path)
    if gravity is not None:
        clauses.append(f"gravity = {_written(gravity)}")
    elif format == "urdf" and not any(clause.replace(" ", "").startswith("gravity=") for clause in clauses):
        raise TypeError("a URDF file says nothing of gravity: give gravity=9.81, or gravity=0 for none")
    return _of_file(format, path, tuple(clauses), _arrays(tables))()


def _written(gravity):
    own = numbers("gravity", gravity)
    if own.shape not in ((), (3,)) or not np.isfinite(own).all():
        raise ValueError(f"gravity is {gravity!r}; expected a finite number, or three")
    return repr(float(own)) if own.shape == () else f"[{', '.join(repr(float(x)) for x in own)}]"


def _format(path):
    """By the root of its elements; by its name where there is none, so that its mistakes are told with their places."""
    with open(path, "rb") as file:
        try:
            _, root = next(ElementTree.iterparse(file, ("start",)))
        except (ElementTree.ParseError, StopIteration):
            return "urdf" if path.suffix == ".urdf" else "mjcf"
    known = {"robot": "urdf", "mujoco": "mjcf"}
    if root.tag not in known:
        raise ValueError(f"{path} is no robot: its root is <{root.tag}>; expected <robot> (URDF) or <mujoco> (MJCF)")
    return known[root.tag]


def _of_file(format, path, clauses, tables):
    native = _with_tables(_native.Model.of_file(format, str(path), list(clauses)), tables)
    files = tuple((own, Path(own).read_bytes()) for own in native.files)
    return _model(native, ("file", tables, format, clauses, files))


#: Models that are in use, by their recipes: a scene that comes again is the same.
_MODELS = weakref.WeakValueDictionary()


def _model(native, recipe):
    model = _MODELS.get(recipe)
    if model is None:
        model = _MODELS[recipe] = Model(native, recipe)
    return model


def _restored(recipe):
    """The model of a recipe: a text, or all files that were read, which are written anew where they have changed."""
    if recipe in _MODELS:
        return _MODELS[recipe]
    if recipe[0] == "text":
        _, tables, source, offset, files = recipe
        changed = [own for own, content in files if not _is(own, content)]
        if changed:
            raise OSError(f"the scene reads {', '.join(changed)}, which is not as it was")
        try:
            native = _native.Model.of_text(source)
        except SceneError as error:
            # Lines are those of the text that was given.
            lines = [(max(1, line - offset), column, message) for line, column, message in error.mistakes]
            raise SceneError(lines, "\n".join(source.split("\n")[offset:])) from None
        files = tuple((own, Path(own).read_bytes()) for own in native.files)
        return _model(_with_tables(native, tables), ("text", tables, source, offset, files))
    _, tables, format, clauses, files = recipe
    first = files[0][0]
    if all(_is(own, content) for own, content in files):
        native = _native.Model.of_file(format, first, list(clauses))
        return _model(_with_tables(native, tables), recipe)
    common = os.path.commonpath([os.path.dirname(own) for own, _ in files])
    with tempfile.TemporaryDirectory() as folder:
        for own, content in files:
            place = Path(folder, os.path.relpath(own, common))
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        native = _native.Model.of_file(format, str(Path(folder, os.path.relpath(first, common))), list(clauses), False)
    return _model(_with_tables(native, tables), recipe)


def _text(recipe):
    """The struct of a recipe, whose files are as they were."""
    files = recipe[-1]
    changed = [own for own, content in files if not _is(own, content)]
    if changed:
        raise OSError(f"the scene reads {', '.join(changed)}, which is not as it was")
    if recipe[0] == "text":
        return recipe[2]
    _, _, format, clauses, _ = recipe
    path = files[0][0].replace("\\", "\\\\").replace('"', '\\"')
    lines = [f'#[gauss({format} = "{path}",', *(f"{clause}," for clause in clauses), ")]", "struct Robot;", ""]
    return "\n".join(lines)


def _is(path, content):
    try:
        return Path(path).read_bytes() == content
    except OSError:
        return False
