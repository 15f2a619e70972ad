"""C by CasADi's code generator: `python with_casadi.py FOLDER [--saved]`.

`casadi_by_hand.c` is made from equations written by hand, `casadi_energies.c` from energies that CasADi differentiates; with `--saved` `pinocchio_casadi.c`
is made from the functions that Pinocchio left in the folder.
"""

import re
import sys
from pathlib import Path

import casadi

import energies
import equations
from scenes import SIZES

PREFIX = "scene_"


def plain(code):
    """Without the tests for absent arguments, which a caller with fixed arguments does not need."""
    code = re.sub(r"arg\[0\]\? (arg\[0\]\[\d+\]) : 0", r"\1", code)
    return re.sub(r"if \(res\[0\]!=0\) ", "", code)


def source(functions):
    """C of CasADi functions of one vector each, behind `void name(const double *state, double *out)`."""
    generator = casadi.CodeGenerator("generated", {"with_header": False})
    for function in functions:
        generator.add(function)
    code = plain(generator.dump())
    code = re.sub(rf"CASADI_SYMBOL_EXPORT (int {PREFIX}\w+\(const casadi_real)", r"static inline \1", code)
    for function in functions:
        name = function.name().removeprefix(PREFIX)
        code += (
            f"\nvoid {name}(const double *restrict state, double *restrict out) {{\n"
            f"  const double *arg[] = {{state}};\n  double *res[] = {{out}};\n  {function.name()}(arg, res, 0, 0, 0);\n}}\n"
        )
    return code


def functions(scenes):
    for name, accelerations in scenes.items():
        state = casadi.SX.sym("x", SIZES[name][0])
        result = casadi.vertcat(*accelerations(casadi.vertsplit(state), casadi))
        yield casadi.Function(PREFIX + name, [state], [result], {"cse": True})


def main():
    folder = Path(sys.argv[1])
    if "--saved" in sys.argv:
        files = [folder / f"{PREFIX}{name}.casadi" for name in SIZES]
        made = {"pinocchio_casadi": [casadi.Function.load(str(file)) for file in files if file.exists()]}
    else:
        made = {"casadi_by_hand": functions(equations.SCENES), "casadi_energies": functions(energies.SCENES)}
    for name, all_of_them in made.items():
        (folder / f"{name}.c").write_text(source(list(all_of_them)))


if __name__ == "__main__":
    main()
