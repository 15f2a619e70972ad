"""The guide's model of do-mpc, in a closed loop beside that of equations by Lagrange."""

import re
import warnings

import pytest

from test_casadi import PARAMETERS, ROOT, ca, gauss, lagrange, library, np

with warnings.catch_warnings():
    # Of what it could do with further packages.
    warnings.simplefilter("ignore")
    do_mpc = pytest.importorskip("do_mpc", reason="do-mpc is not installed: `pip install do-mpc`")

H = 0.05


def loop(acceleration):
    """Pushes and states while the pole is balanced for 1.5 s."""
    text = (ROOT / "guide/src/casadi.md").read_text().split("## do-mpc")[1]
    program = re.search(r"```python\n(.*?)```", text, re.DOTALL).group(1)
    names = {"acceleration": acceleration}
    exec(program, names)
    model, q, z = names["model"], names["q"], names["z"]
    controller = do_mpc.controller.MPC(model)
    controller.settings.n_horizon, controller.settings.t_step = 20, H
    controller.settings.store_full_solution = False
    controller.settings.supress_ipopt_output()
    cost = ca.sumsqr(q) + 0.1 * ca.sumsqr(z)
    controller.set_objective(lterm=cost, mterm=10 * cost)
    controller.set_rterm(push=1e-3)
    controller.bounds["lower", "_u", "push"], controller.bounds["upper", "_u", "push"] = -20, 20
    controller.setup()
    simulator = do_mpc.simulator.Simulator(model)
    simulator.set_param(t_step=H, abstol=1e-10, reltol=1e-10)
    simulator.setup()
    x = np.array([[0.2], [0.4], [0.0], [0.0]])
    controller.x0 = simulator.x0 = x
    controller.set_initial_guess()
    path = []
    for _ in range(30):
        push = controller.make_step(x)
        x = simulator.make_step(push)
        path.append([push.item(), *x.ravel()])
    return np.array(path)


def test_a_pole_is_balanced_alike(gauss, lagrange):
    assert PARAMETERS == [1.0, 0.2, 0.6, 9.81]
    ours, theirs = (loop(lambda p, t, q, z, u, own=own: own(p, q, z, u)[0]) for own in (gauss, lagrange))
    # The solver's tolerance is 1e-8 of its cost, and both take the same steps on numbers that differ by rounding.
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())
    # IPOPT widens bounds by 1e-8 of them; after 1.5 s a quarter of the lean is left, at most.
    assert abs(ours[:, 0]).max() <= 20 * (1 + 1e-7) and abs(ours[-1, 2]) < 0.1, ours[-1]
