"""Sobol' indices by SALib from the results of a study with the plan `Saltelli`.

python sensitivity.py DIR/study.parquet RESULT     (pip install SALib pyarrow)
"""

import json
import sys

import pyarrow.parquet
from SALib.analyze import sobol


def indices(file: str, result: str) -> dict:
    """The parameters that vary, first-order and total indices, and 95 % of each."""
    table = pyarrow.parquet.read_table(file)
    study = json.loads(table.schema.metadata[b"gauss_study"])
    if study["plan"] != "saltelli":
        raise SystemExit(f"the plan of this study is {study['plan']}, not saltelli")
    if table[result].null_count:
        raise SystemExit(f"{table[result].null_count} runs have no {result}: SALib needs all of them")
    names = [parameter["name"] for parameter in study["parameters"] if "fixed" not in parameter["distribution"]]
    # Bounds are not asked for by the analysis, which looks at results alone.
    problem = {"num_vars": len(names), "names": names, "bounds": [[0, 1]] * len(names)}
    found = sobol.analyze(problem, table[result].to_numpy(), calc_second_order=False, seed=1)
    return {"names": names} | {key: found[key].tolist() for key in ("S1", "S1_conf", "ST", "ST_conf")}


if __name__ == "__main__":
    found = indices(*sys.argv[1:3])
    if "--json" in sys.argv:
        print(json.dumps(found))
    else:
        print(f"{'parameter':12} first order        total")
        for name, first, low, total, wide in zip(*found.values()):
            print(f"{name:12} {first:7.3f} ± {low:.3f}  {total:7.3f} ± {wide:.3f}")
