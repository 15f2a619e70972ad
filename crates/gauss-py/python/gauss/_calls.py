"""Calls of methods: arrays of any shape become rows of numbers, and results arrays again."""

import math
from collections import namedtuple

import numpy as np

from . import _native

Evaluate = namedtuple("Evaluate", "velocity acceleration kinetic_energy potential_energy")
#: The tuples of programs that give several arrays, by their names; of others a tuple without names.
TUPLES = {
    "linearize": _native.Linearize,
    "linearize_inverse": _native.LinearizeInverse,
    "hessian": _native.Hessian,
    "evaluate": Evaluate,
}

#: Results of one number; all others are vectors and matrices, of which systems with one coordinate have small ones.
NUMBERS = {"kinetic_energy", "potential_energy", "total_mass", "constraint_function", "supplied_power", "regularity"}
MATRICES = {"mass_matrix", "centroidal_matrix", "center_jacobian", "regressor", "element_forces"}
MATRICES |= {"contact_jacobian", "columns", "delassus"}


def shape_of(name, rows, columns):
    """The axes of a result behind those of the batch."""
    if name in NUMBERS:
        return ()
    is_matrix = name in MATRICES or name.startswith("jacobian") or (name.startswith("by_") and name != "by_time")
    return (rows, columns) if is_matrix or columns != 1 else (rows,)


def numbers(name, value):
    """Real numbers as an array of float64 in C order, aligned; a copy where the value is none."""
    if type(value) is np.ndarray and value.dtype == np.float64 and value.flags.carray:
        return value
    if np.ma.is_masked(value):
        raise TypeError(f"{name} has masked entries, and every number counts; fill them, or leave those rows out")
    try:
        array = np.asarray(value)
        array = array.astype(np.float64, order="C", casting="same_kind", copy=False)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name} is no array of real numbers: {error}") from None
    return array if array.flags.c_contiguous and array.flags.aligned else array.copy("C")


class Plan:
    """A method with what it takes and gives."""

    def __init__(self, name, signature):
        arguments, results = signature
        self.name = name
        self.sizes = {argument: len(components) for argument, components in arguments[1:]}
        self.components = {argument: components for argument, components in arguments[1:]}
        # Time is a keyword, and the input comes last, since scenes without one leave it out.
        self.order = sorted(self.sizes, key=lambda argument: argument == "input")
        names = [name] if len(results) == 1 else [result for result, _, _ in results]
        self.shapes = [shape_of(own, rows, columns) for own, (_, rows, columns) in zip(names, results)]
        self.counts = [rows * columns for _, rows, columns in results]
        self.ends = [sum(self.counts[: place + 1]) for place in range(len(results))]

    def arguments(self, given, named):
        """Values by the names of arguments; None of an input without numbers that is left out."""
        takes = f"{self.name} takes {', '.join(self.order)}"
        if len(given) > len(self.order):
            raise TypeError(f"{takes}; {len(given)} arrays are given")
        values = dict(zip(self.order, given))
        for name, value in named.items():
            if name not in self.sizes:
                raise TypeError(f"{takes}; `{name}` is none of them")
            if name in values:
                raise TypeError(f"{takes}; `{name}` is given twice")
            values[name] = value
        for name, size in self.sizes.items():
            if values.get(name) is None:
                if size:
                    raise TypeError(f"{takes}; {name} is missing: {', '.join(self.components[name])}")
                values[name] = np.zeros(0)
        return values

    def call(self, native, given, named, t, threads, own):
        """Calls the method for a state, or for a batch of them; `own` has parameters of rows with their axes."""
        threads = int(threads)
        if threads < 1:
            raise ValueError(f"threads is {threads}; expected one or more")
        values = self.arguments(given, named)
        wanted = [("t", (), t), *((name, (size,), values[name]) for name, size in self.sizes.items())]
        wanted += [(name, axes, value) for name, (axes, value) in own.items()]
        batch, of, arrays = (), "", []
        for name, axes, value in wanted:
            array = numbers(name, value)
            leading = array.shape[: max(0, array.ndim - len(axes))]
            if leading + axes != array.shape:
                raise ValueError(f"{name} has shape {array.shape}; expected (...{''.join(f', {own}' for own in axes)})")
            if leading and batch and leading != batch:
                raise ValueError(f"leading axes differ: {batch} of {of}, {leading} of {name}")
            if leading:
                batch, of = leading, name
            arrays.append((array, leading, math.prod(axes)))
        rows = math.prod(batch)
        flat = [array.reshape(rows if leading else 1, size) for array, leading, size in arrays]
        count = len(flat) - len(own)
        computed = native.call(self.name, flat[:count], rows, threads, list(zip(own, flat[count:])))
        if len(self.shapes) == 1:
            return computed.reshape(batch + self.shapes[0])
        computed = computed.reshape(rows, self.ends[-1])
        parts = zip(self.counts, self.ends, self.shapes)
        results = [np.ascontiguousarray(computed[:, b - n : b]).reshape(batch + shape) for n, b, shape in parts]
        return TUPLES[self.name](*results) if self.name in TUPLES else tuple(results)

    def documentation(self):
        """What it takes and gives, number by number."""
        own = [f"{name} (..., {self.sizes[name]}): {', '.join(self.components[name])}" for name in self.order]
        shapes = ["(...)" if not shape else f"(..., {', '.join(map(str, shape))})" for shape in self.shapes]
        head = f"{self.name}({', '.join(self.order)}, *, t=0.0, threads=1) -> {', '.join(shapes)}"
        return "\n".join([head, "", *own])
