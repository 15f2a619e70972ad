"""`python -m gauss show arm.urdf`: the equations of a robot, what they cost and lose, what of its file does not act."""

import argparse
import sys

from . import SceneError, load
from ._model import Path, _format


def main():
    parser = argparse.ArgumentParser(prog="python -m gauss", description="Robots' files as equations of motion.")
    show = parser.add_subparsers(required=True).add_parser("show", help="print equations, costs, accuracy, remarks")
    show.add_argument("file", type=Path, help="a URDF or MJCF file")
    show.add_argument("--gravity", type=float, help="m/s², along -z; 9.81 for a URDF file where it is left out")
    show.add_argument("--clause", action="append", default=[], help="as of structs: 'base = floating', linearize")
    show.add_argument("--latex", action="store_true", help="the equations alone, as LaTeX")
    given = parser.parse_args()
    try:
        gravity = given.gravity
        if gravity is None and _format(given.file) == "urdf":
            gravity = 9.81
        robot = load(given.file, given.clause, gravity=gravity)
    except (SceneError, OSError, ValueError) as error:
        sys.exit(str(error))
    if given.latex:
        print(robot.latex)
        return
    print(robot.equations)
    print("\nOperations (additions, multiplications, divisions, roots, transcendental functions), and the rounding")
    print("error at the worst state that was found and the median, where all that is given changes by its last place:")
    accuracy = robot.model.accuracy
    for name, counts in robot.model.operations.items():
        worst, median = accuracy.get(name, (float("nan"), float("nan")))
        print(f"  {name:24} {' '.join(f'{count:5}' for count in counts.values())}  {worst:8.2g} {median:8.2g}")
    if gravity is not None:
        print(f"\nGravity: {gravity} m/s² along -z.")
    for remark in robot.remarks:
        print(f"remark: {remark}")


if __name__ == "__main__":
    main()
