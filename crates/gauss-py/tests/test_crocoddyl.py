"""The guide's action model of Crocoddyl, beside Crocoddyl's own of the same file."""

import re
from pathlib import Path

import numpy as np
import pytest

crocoddyl = pytest.importorskip("crocoddyl", reason="Crocoddyl is not installed: `pip install crocoddyl`")
pinocchio = pytest.importorskip("pinocchio")

ROOT = Path(__file__).parents[3]
ARM = ROOT / "examples/python/arm.urdf"
START = np.array([2.0, 0.5, 0.0, 0.0])


@pytest.fixture(scope="module")
def guide():
    """The names of the program in the guide."""
    text = (ROOT / "guide/src/casadi.md").read_text().split("## Crocoddyl")[1]
    program = re.search(r"```python\n(.*?)```", text, re.DOTALL).group(1)
    names = {}
    exec(program.replace('"arm.urdf"', repr(str(ARM))), names)
    return names


def costs(state, weight):
    """Of being elsewhere than upright at rest, and of torques."""
    own = crocoddyl.CostModelSum(state, 2)
    residuals = {"goal": (crocoddyl.ResidualModelState(state, np.zeros(4), 2), weight)}
    residuals["effort"] = (crocoddyl.ResidualModelControl(state, 2), 1e-2)
    for name, (residual, weight) in residuals.items():
        own.addCost(name, crocoddyl.CostModelResidual(state, residual), weight)
    return own


def plan(dynamics, state):
    step, end = (
        crocoddyl.IntegratedActionModelEuler(dynamics(costs(state, weight)), h) for weight, h in [(0.1, 0.02), (1e3, 0)]
    )
    solver = crocoddyl.SolverFDDP(crocoddyl.ShootingProblem(START, [step] * 50, end))
    solver.th_stop = 1e-12
    assert solver.solve([], [], 100)
    return solver.iter, np.array(solver.xs), np.array(solver.us)


def test_plans_are_those_of_crocoddyl(guide):
    # Joints without end have two coordinates there, cosine and sine.
    limit = '<axis xyz="0 1 0"/><limit effort="40" velocity="3"/>\n  </joint>'
    text = ARM.read_text().replace("continuous", "revolute").replace('<axis xyz="0 1 0"/>\n  </joint>', limit)
    state = crocoddyl.StateMultibody(pinocchio.buildModelFromXML(text))

    def own(costs):
        model = crocoddyl.DifferentialActionModelFreeFwdDynamics(state, crocoddyl.ActuationModelFull(state), costs)
        # Through the mass matrix: accelerations of the other way, in wheels of version 3.2.1, know no weight.
        model.armature = np.zeros(2)
        return model

    theirs = plan(own, state)
    ours = plan(lambda costs: guide["Dynamics"](guide["arm"], guide["state"], costs), guide["state"])
    assert ours[0] == theirs[0]
    # Nine iterations, each of a product of fifty matrices with entries below a hundred.
    for found, expected in zip(ours[1:], theirs[1:]):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
    # It came where it was to.
    assert np.abs(ours[1][-1]).max() < 1e-3


def test_derivatives_are_those_of_differences(guide):
    model = guide["Dynamics"](guide["arm"], guide["state"], costs(guide["state"], 0.1))
    other = crocoddyl.DifferentialActionModelNumDiff(model, True)
    x, u = np.array([0.3, -0.8, 0.5, 1.0]), np.array([1.0, -2.0])
    found = []
    for own in (model, other):
        data = own.createData()
        own.calc(data, x, u)
        own.calcDiff(data, x, u)
        found.append(data)
    for name in ("Fx", "Fu", "Lx", "Lu"):
        ours, theirs = getattr(found[0], name), getattr(found[1], name)
        # Forward differences have half of the digits.
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-6 * (1 + np.abs(ours).max()))
