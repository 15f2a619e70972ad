"""What a run may be given besides its state: events, controllers, methods, progress."""

import numpy as np
import pytest
import scenes

from test_runs import period

FINE = {"rtol": 1e-11, "atol": 1e-11}


def test_events_do_not_end_a_run(pendulum):
    whole = period(1.0)
    events = [("angle", 0.0), ("angle", 0.0, "rising"), (lambda t, q, z: z[0], "falling")]
    run = pendulum.simulate([1.0], [0.0], (0.0, 2.9 * whole), input=[0.0], events=events, **FINE)
    assert run.stopped_by is None and run.t[-1] == 2.9 * whole
    zero, rising, turned = run.events
    # Steps keep the tolerance; some dozens of them.
    assert len(zero.t) == 6 and abs(zero.t - whole * (np.arange(6) + 0.5) / 2).max() < 1e-9
    assert len(rising.t) == 3 and abs(rising.t - whole * (np.arange(3) + 0.75)).max() < 1e-9
    # With the speed that the energy gives, at the bottom; at the top of the swing it is the angle of the start.
    assert zero.q.shape == zero.z.shape == (6, 1) and abs(zero.q).max() < 1e-9
    assert abs(abs(zero.z) - np.sqrt(2 * 9.81 / 0.5 * (1 - np.cos(1.0)))).max() < 1e-8
    assert len(turned.t) == 2 and abs(turned.q - 1.0).max() < 1e-9
    assert pendulum.simulate([1.0], [0.0], (0.0, 1.0), input=[0.0]).events == []


def test_events_beside_ends(pendulum):
    quarter = period(1.0) / 4
    ends = [("angle", -2.0), ("angle_dot", 0.0, "rising")]
    run = pendulum.simulate(
        [1.0], [-1e-9], (0.0, 9.0), input=[0.0], events=[("angle", 5.0), ("angle", 0.0)], until=ends, **FINE
    )
    assert run.stopped_by == 1 and abs(run.t[-1] - 2 * quarter) < 1e-7
    never, once = run.events
    assert never.t.shape == (0,) and never.q.shape == never.z.shape == (0, 1)
    assert abs(once.t - quarter).max() < 1e-7 and len(once.t) == 1


def by_hand(pendulum, law, pieces):
    """Runs with the input that is held in each piece: (from, to, the instant whose input acts, or none)."""
    q, z, sampled = np.array([0.5]), np.array([0.0]), {}
    for start, end, instant in pieces:
        sampled[start] = law(start, q, z)
        held = [0.0] if instant is None else sampled[instant]
        run = pendulum.simulate(q, z, (start, end), input=held, **FINE)
        q, z = run.q[-1], run.z[-1]
    return np.append(q, z)


def test_controllers_hold_from_instant_to_instant(pendulum):
    asked = []

    def law(t, q, z):
        return [-3.0 * q[0] - z[0]]

    def told(t, q, z):
        asked.append(t)
        return law(t, q, z)

    run = pendulum.simulate([0.5], [0.0], (0.0, 1.0), controller=told, period=0.125, **FINE)
    assert asked == list(np.arange(8) / 8)
    expected = by_hand(pendulum, law, [(k / 8, (k + 1) / 8, k / 8) for k in range(8)])
    # Tolerances of two runs of some dozens of steps.
    assert abs(np.append(run.q[-1], run.z[-1]) - expected).max() < 1e-9
    late = pendulum.simulate([0.5], [0.0], (0.0, 0.5), controller=law, period=0.125, delay=0.0625, **FINE)
    pieces, acts = [], None
    for k in range(4):
        pieces.append((k / 8, k / 8 + 0.0625, acts))
        acts = k / 8
        pieces.append((k / 8 + 0.0625, (k + 1) / 8, acts))
    assert abs(np.append(late.q[-1], late.z[-1]) - by_hand(pendulum, law, pieces)).max() < 1e-9
    # What is not sampled is added.
    both = pendulum.simulate([0.5], [0.0], (0.0, 1.0), controller=lambda t, q, z: [0.3], period=0.25, input=[0.4], **FINE)
    alone = pendulum.simulate([0.5], [0.0], (0.0, 1.0), input=[0.7], **FINE)
    assert abs(both.q[-1] - alone.q[-1]) < 1e-9


def test_mistakes_with_controllers(pendulum, torpedo):
    def law(t, q, z):
        return [0.0]

    def run(**given):
        return pendulum.simulate([0.5], [0.0], (0.0, 1.0), **given)

    with pytest.raises(TypeError, match="a controller needs its period"):
        run(controller=law)
    with pytest.raises(TypeError, match="period is that of a controller"):
        run(period=0.1, input=[0.0])
    with pytest.raises(TypeError, match="delay is that of a controller"):
        run(delay=0.1, input=[0.0])
    with pytest.raises(TypeError, match="a function of"):
        run(controller=[0.0], period=0.1)
    with pytest.raises(ValueError, match="period must be positive, found 0"):
        run(controller=law, period=0.0)
    with pytest.raises(ValueError, match="delay must not be negative, found -1"):
        run(controller=law, period=0.1, delay=-1.0)
    with pytest.raises(ValueError, match=r"input has shape \(2,\)"):
        run(controller=lambda t, q, z: [0.0, 1.0], period=0.1)
    with pytest.raises(ZeroDivisionError):
        run(controller=lambda t, q, z: [1 / 0], period=0.1)
    with pytest.raises(TypeError, match="Torpedo has no input for a controller"):
        torpedo.simulate(*torpedo.state(), (0, 1), controller=law, period=0.1)
    # Instants go forward.
    with pytest.raises(scenes.IntegrationError):
        pendulum.simulate([0.5], [0.0], (1.0, 0.0), controller=law, period=0.1)


def test_methods_agree(torpedo, pendulum):
    q, z = torpedo.state(pose_z=-5.0)
    z[:] = [1.5, 0, 0, 0.1, 0.2, 0.3]
    ends = {}
    for method in ["dormand_prince", "taylor", "rosenbrock", "radau"]:
        # A method of order 4 takes short steps: a thousand of them may each lose the tolerance.
        run = torpedo.simulate(q, z, (0, 3), method=method, rtol=1e-9, atol=1e-9)
        ends[method] = np.append(run.q[-1], run.z[-1])
        assert abs(ends[method] - ends["dormand_prince"]).max() < 1e-6 and run.steps > 1
    assert not np.array_equal(ends["taylor"], ends["dormand_prince"])
    bounded = torpedo.simulate(q, z, (0, 3), method="taylor", largest_step=0.01)
    assert bounded.steps >= 300 and abs(bounded.q[-1] - ends["taylor"][: len(q)]).max() < 1e-6


def test_collocation_is_of_order_6(pendulum):
    def error(step):
        run = pendulum.simulate([1.0], [0.0], (0.0, period(1.0)), method="collocation", step=step, input=[0.0])
        return abs(run.q[-1, 0] - 1.0) + abs(run.z[-1, 0])

    whole = period(1.0)
    # Steps that fit, in the region where the leading term is most of the error: 2⁶ = 64.
    ratio = error(whole / 16) / error(whole / 32)
    assert 40 < ratio < 90


OF_ONE_LENGTH = ["collocation_2", "collocation_4", "runge_kutta_4", "commutator_free_4", "adams_10", "adams_12"]


def test_all_methods_by_name_agree(torpedo):
    q, z = torpedo.state(pose_z=-5.0)
    z[:] = [1.5, 0, 0, 0.1, 0.2, 0.3]
    run = torpedo.simulate(q, z, (0, 3), rtol=1e-11, atol=1e-11)
    exact = np.append(run.q[-1], run.z[-1])
    for method in ["dormand_prince_5", "verner_9"]:
        run = torpedo.simulate(q, z, (0, 3), method=method, rtol=1e-9, atol=1e-9)
        assert abs(np.append(run.q[-1], run.z[-1]) - exact).max() < 1e-6, method
    tolerant = ["dormand_prince", "dormand_prince_5", "verner_9", "rosenbrock", "radau"]
    for method in [*OF_ONE_LENGTH, "collocation", *tolerant]:
        # Of order 2 at least: its error falls to a fourth or less in half of the length.
        of_length = [torpedo.simulate(q, z, (0, 3), method=method, step=step) for step in (0.02, 0.01)]
        assert [run.steps for run in of_length] == [150, 300], method
        coarse, fine = [abs(np.append(run.q[-1], run.z[-1]) - exact).max() for run in of_length]
        assert fine < max(0.3 * coarse, 1e-9) and fine < 1e-3, method
    for method in OF_ONE_LENGTH:
        with pytest.raises(ValueError, match=f"the method {method} needs step"):
            torpedo.simulate(q, z, (0, 3), method=method)


def test_mistakes_with_methods(pendulum, arm):
    def run(**given):
        return pendulum.simulate([0.5], [0.0], (0.0, 1.0), input=[0.0], **given)

    with pytest.raises(ValueError, match='"eular" is no such method; there are dormand_prince, .*, rosenbrock, radau, .*, taylor$'):
        run(method="eular")
    with pytest.raises(ValueError, match='"RK45" is no such method; .*; is dormand_prince_5 meant'):
        run(method="RK45")
    with pytest.raises(ValueError, match="collocation needs step"):
        run(method="collocation")
    with pytest.raises(ValueError, match="taylor chooses its steps"):
        run(method="taylor", step=0.1)
    with pytest.raises(ValueError, match="give one of them"):
        run(step=0.1, largest_step=0.2)
    for words in (dict(rtol=1e-6), dict(atol=1e-6), dict(rtol=1e-6, method="collocation")):
        with pytest.raises(ValueError, match="steps of one length, step, keep no rtol and atol"):
            run(step=0.1, **words)
    with pytest.raises(ValueError, match="largest_step must be positive, found 0"):
        run(largest_step=0.0)
    with pytest.raises(ValueError, match=r"taylor needs `#\[gauss\(taylor\)\]` at the struct"):
        run(method="taylor")
    for method in ["rosenbrock", "radau"]:
        with pytest.raises(ValueError, match=rf"{method} needs `#\[gauss\(linearize\)\]` at the struct"):
            arm.simulate([0.0, 0.0], [0.0, 0.0], (0, 1), input=[0.0, 0.0], method=method)


def test_progress_tells_the_time(pendulum):
    told = []
    run = pendulum.simulate([1.0], [0.0], (0.0, 300.0), input=lambda t, q, z: [0.0], progress=told.append)
    assert told == sorted(told) and told[-1] == run.t[-1] == 300.0 and len(told) > 1

    def stop(t):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        pendulum.simulate([1.0], [0.0], (0.0, 1e9), input=[0.0], max_steps=10**12, progress=stop)
    with pytest.raises(TypeError, match="progress is a function"):
        pendulum.simulate([1.0], [0.0], (0.0, 1.0), input=[0.0], progress=3)
    told.clear()
    pendulum.ensemble(np.zeros((40, 1)), [0.0], (0.0, 1.0), input=[0.0], progress=told.append)
    assert told[-1] == 40


def test_progress_as_a_bar(pendulum, capsys):
    pytest.importorskip("tqdm", reason="NOT TESTED: tqdm is not installed")
    pendulum.simulate([1.0], [0.0], (0.0, 2.0), input=[0.0], progress=True)
    assert "2.00/2.00" in capsys.readouterr().err
    pendulum.ensemble(np.zeros((40, 1)), [0.0], (0.0, 1.0), input=[0.0], progress=True)
    assert "40.0/40.0" in capsys.readouterr().err
    # A run that is refused shows none.
    with pytest.raises(ValueError):
        pendulum.simulate([1.0, 2.0], [0.0], (0.0, 2.0), input=[0.0], progress=True)
    assert capsys.readouterr().err == ""
    pendulum.simulate([1.0], [0.0], (0.0, 2.0), input=[0.0], progress=False)
    assert capsys.readouterr().err == ""
