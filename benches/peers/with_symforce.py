"""C from equations written by hand, with the subexpressions that SymForce shares: `python with_symforce.py FOLDER`.

SymForce's own templates wrap the same lines in Eigen's types; scalars are left to the C compiler as they are here.
"""

import sys
from pathlib import Path

import symforce

symforce.set_symbolic_api("symengine")
import symforce.symbolic as sf  # noqa: E402  (the backend is chosen before)
from symforce import codegen  # noqa: E402
from symforce.codegen import codegen_util  # noqa: E402
from symforce.values import Values  # noqa: E402

from equations import SCENES  # noqa: E402
from scenes import SIZES  # noqa: E402
from straight_lines import HEADER, function  # noqa: E402


def main():
    text = HEADER
    config = codegen.CppConfig()
    for name, equations in SCENES.items():
        size = SIZES[name][0]
        loads = [f"x{index}_" for index in range(size)]
        state = [sf.Symbol(load) for load in loads]
        outputs = Values(out=sf.Matrix(equations(state, sf)))
        code = codegen_util.print_code(
            inputs=Values(**dict(zip(loads, state))), outputs=outputs, sparse_mat_data={}, config=config, cse=True
        )
        results = code.dense_terms[0].terms
        plain = lambda expression: expression.replace("Scalar(", "(double)(").replace("std::", "")  # noqa: E731
        intermediate = [(str(symbol), plain(line)) for symbol, line in code.intermediate_terms]
        text += function(name, size, intermediate, [plain(line) for _, line in results], loads)
    Path(sys.argv[1], "symforce_by_hand.c").write_text(text)


if __name__ == "__main__":
    main()
