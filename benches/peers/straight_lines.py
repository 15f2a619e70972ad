"""Writes straight-line C for a list of named scenes: how SymPy's and SymForce's expressions become functions."""

HEADER = "#include <math.h>\n"


def function(name, size, intermediate, results, loads):
    """C of `void name(const double *state, double *out)`.

    `intermediate`: pairs of a name and an expression in C, in order; `results`: expressions; `loads`: name of each component of the state.
    """
    lines = [f"  const double {symbol} = state[{index}];" for index, symbol in enumerate(loads)]
    lines += [f"  const double {symbol} = {code};" for symbol, code in intermediate]
    lines += [f"  out[{index}] = {code};" for index, code in enumerate(results)]
    body = "\n".join(lines)
    assert len(loads) == size
    return f"\nvoid {name}(const double *restrict state, double *restrict out) {{\n{body}\n}}\n"
