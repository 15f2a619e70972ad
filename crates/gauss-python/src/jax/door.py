"""The methods of a kernel as functions of JAX, for `jit`, `vmap`, `jvp`, `grad`."""

import functools
import math

import jax
import jax.ffi
import jax.numpy as jnp
import numpy as np

registered = set()


class Functions:
    """The methods of a kernel as functions of JAX: arrays of shape (..., n), of which the leading axes are the batch."""

    def __init__(self, kernel):
        self.kernel = kernel

    def __repr__(self):
        return f"jax({self.kernel!r})"


class Method:
    """One method: arrays in, arrays out."""

    def __init__(self, target, number, spec):
        name, method, self.names, self.arguments, self.results, self.tuple = spec
        self.target, self.name = target, name
        self.attributes = {"kernel": np.int64(number), "method": np.int64(method)}

    def frame(self, name):
        if self.names is None:
            return 0
        if name not in self.names:
            raise KeyError(f"{self.name} is of {', '.join(self.names)}, and not of {name}")
        return self.names.index(name)

    def call(self, frame, t, *arrays, own=0):
        """All arrays with the same leading axes, those of `t`; the last ones are parameters whose bits are in `own`."""
        results = [jax.ShapeDtypeStruct(t.shape + tuple(axes), t.dtype) for _, axes in self.results]
        function = jax.ffi.ffi_call(self.target, results, vmap_method="broadcast_all")
        found = function(t, *arrays, frame=np.int64(frame), own=np.int64(own), **self.attributes)
        return self.tuple(*found) if self.tuple else found[0]

    def prepared(self, given, t, parameters):
        """Time and arrays in one type, with the leading axes of all; of parameters name, axes and value."""
        wanted = [(name, size) for name, size in self.arguments if size]
        given = [array for (_, size), array in zip(self.arguments, given) if size]
        for (name, _), array in zip(wanted, given):
            if array is None:
                raise TypeError(f"{self.name} needs {name}")
        wanted = wanted + [(name, axes) for name, axes, _ in parameters]
        given = [jnp.asarray(array) for array in (t, *given, *(value for *_, value in parameters))]
        dtype = jnp.promote_types(jnp.result_type(float, *given), jnp.float32)
        if not jnp.issubdtype(dtype, jnp.floating):
            raise TypeError(f"{self.name} takes real numbers, and not {dtype}")
        t, *arrays = (array.astype(dtype) for array in given)
        for place, ((name, axes), array) in enumerate(zip(wanted, arrays)):
            axes = axes if isinstance(axes, tuple) else (axes,)
            if array.shape[array.ndim - len(axes) :] != axes or array.ndim < len(axes):
                raise ValueError(f"{name} has shape {array.shape}; expected (..., {', '.join(map(str, axes))})")
            # The numbers of a parameter in one axis.
            arrays[place] = array.reshape(array.shape[: array.ndim - len(axes)] + (math.prod(axes),))
        leading = np.broadcast_shapes(t.shape, *(array.shape[:-1] for array in arrays))
        arrays = [jnp.broadcast_to(array, leading + array.shape[-1:]) for array in arrays]
        return jnp.broadcast_to(t, leading), *arrays


def plain(method, function, flat, parameters):
    """A function with the arguments of the method; time is a keyword, and parameters of rows are."""
    names = [name for name, _ in method.arguments]

    def called(*given, t=0.0, **named):
        frame, given = (method.frame(given[0]), given[1:]) if method.names is not None else (0, given)
        if len(given) > len(names):
            raise TypeError(f"{method.name} has {len(names)} arrays: {', '.join(names)}")
        for name in named:
            if name not in names[len(given) :] and name not in parameters:
                raise TypeError(f"{method.name} has no further argument {name}")
        given = [*given, *(named.get(name) for name in names[len(given) :])]
        of_rows = [(name, *parameters[name]) for name in parameters if name in named and name not in names]
        prepared = method.prepared(given, t, [(name, axes, named[name]) for name, _, axes in of_rows])
        if not flat and prepared[0].dtype != jnp.float64:
            raise TypeError('rotations need float64: jax.config.update("jax_enable_x64", True)')
        return function(frame, sum(1 << number for _, number, _ in of_rows), *prepared)

    called.__name__ = method.name
    return called


def product(matrix, vector):
    return jnp.einsum("...ij,...j->...i", matrix, vector)


def make(kernel, target, capsule, number, specs, parameters, columns, increment, flat):
    """The functions of a kernel."""
    if target not in registered:
        jax.ffi.register_ffi_target(target, capsule, platform="cpu")
        registered.add(target)
    methods = {spec[0]: Method(target, number, spec) for spec in specs}

    def increments(t, q, change):
        """What a change of the numbers of q is as an increment: linear in it, and written so for `grad`."""
        if flat:
            return change
        wide = (*q.shape, q.shape[-1])
        units = jnp.broadcast_to(jnp.eye(q.shape[-1], dtype=q.dtype), wide)
        rows = jnp.broadcast_to(t[..., None], q.shape), jnp.broadcast_to(q[..., None, :], wide), units
        return jnp.einsum("...ki,...k->...i", methods["tangent"].call(0, *rows), change)

    def differentiable(method, rule):
        @functools.cache
        def function(frame, own):
            called = jax.custom_jvp(lambda t, *arrays: method.call(frame, t, *arrays, own=own))
            called.defjvp(functools.partial(rule, own) if rule else refused(method))
            return called

        return lambda frame, own, t, *arrays: function(frame, own)(t, *arrays)

    def refused(method):
        def rule(primals, tangents):
            needs = [f"{name} (clause {clause})" for name, (_, clause, _) in rules.items()]
            raise TypeError(f"{method.name} has no derivatives in JAX here; there are those of {', '.join(needs)}")

        return rule

    def by_parameters(own, primals, tangents):
        """The change of velocity and acceleration with parameters of rows."""
        if "by_parameters" not in methods:
            raise TypeError("derivatives by parameters need the clause linearize(parameters)")
        matrix = methods["by_parameters"].call(0, *primals, own=own)
        # Arrays of parameters come last, in the order of their bits.
        fields = [number for number in range(own.bit_length()) if own >> number & 1]
        changes = dict(zip(fields, tangents[-len(fields) :]))
        own_columns = [(k, *place) for k, place in enumerate(columns) if place and place[0] in changes]
        parts = [matrix[..., k] * changes[number][..., place, None] for k, number, place in own_columns]
        return sum(parts, jnp.zeros_like(matrix[..., 0]))

    def motion(own, primals, tangents):
        """Velocity and acceleration, and their changes."""
        linear = methods["linearize"].call(0, *primals, own=own)
        (t, q, z, *u), (dt, dq, dz, *du) = primals, tangents
        change = product(linear.by_state, jnp.concatenate([increments(t, q, dq), dz], axis=-1))
        change = change + linear.by_time * dt[..., None]
        change = change + by_parameters(own, primals, tangents) if own else change
        return linear.rate, change + product(linear.by_input, du[0]) if has_input else change

    def acceleration(own, primals, tangents):
        return tuple(part[..., increment:] for part in motion(own, primals, tangents))

    def inverse_dynamics(own, primals, tangents):
        if own:
            raise TypeError("inverse_dynamics has no derivatives by parameters; acceleration has them")
        (t, q, z, a, *u), (dt, dq, dz, da, *du) = primals, tangents
        linear = methods["linearize_inverse"].call(0, *primals)
        change = product(linear.by_configuration, increments(t, q, dq)) + product(linear.by_speeds, dz)
        change = change + product(linear.by_acceleration, da) + linear.by_time * dt[..., None]
        if u:
            change = change + product(linear.by_input, du[0])
        return linear.force, change

    rules = {
        "acceleration": ("linearize", "linearize", acceleration),
        "inverse_dynamics": ("linearize_inverse", "linearize(inverse)", inverse_dynamics),
    }
    if flat:
        rules["rates"] = ("linearize", "linearize", motion)
    has_input = dict(methods["acceleration"].arguments)["input"] > 0
    parameters = {name: (number, tuple(axes)) for number, name, axes in parameters}
    functions = Functions(kernel)
    for name, method in methods.items():
        needed, _, rule = rules.get(name, (None, None, None))
        function = differentiable(method, rule if needed in methods else None)
        setattr(functions, name, plain(method, function, flat, parameters))
    return functions
