"""Keywords, what is wrong with them, kernels as values."""

import inspect
import pickle

import numpy as np
import pytest
import scenes


def test_keywords_have_the_documentation_of_the_struct(pendulum):
    assert list(inspect.signature(scenes.Pendulum).parameters) == ["mass", "length", "g"]
    assert "mass: number (kg): Of the point." in scenes.Pendulum.__doc__
    assert "motor: input, in N m" in scenes.Pendulum.__doc__
    assert repr(pendulum) == "Pendulum(mass=2.0, length=0.5, g=9.81)"


def test_all_mistakes_come_at_once():
    with pytest.raises(scenes.ParameterError) as caught:
        scenes.Pendulum(mass="heavy", length=[1, 2], weight=3)
    wrong = dict(caught.value.fields)
    assert set(wrong) == {"mass", "length", "g", "weight"}
    assert wrong["length"] == "has shape (2,); expected one number"
    assert wrong["weight"].startswith("is no parameter")
    assert wrong["g"].startswith("is missing")
    with pytest.raises(scenes.ParameterError) as caught:
        scenes.Torpedo(mass=-30.0, center=np.zeros(3), inertia=[1, 1, 3], added=np.ones(6), lift=np.nan)
    assert {name for name, _ in caught.value.fields} >= {"mass", "inertia", "lift"}
    assert issubclass(scenes.ParameterError, ValueError)


def test_complex_numbers_are_no_parameters():
    with pytest.raises(scenes.ParameterError):
        scenes.Pendulum(mass=1j, length=1.0, g=9.81)


def test_bodies_are_mappings(wire):
    assert wire.parameters["block"]["inertia"].tolist() == np.diag([0.1, 0.2, 0.3]).tolist()
    for block in [{"mass": 2.0}, {"mass": 2.0, "inertia": np.eye(4)}, {"mass": 2.0, "inertia": 1, "size": 3}, 5.0]:
        with pytest.raises(scenes.ParameterError) as caught:
            scenes.Wire(block=block, radius=1.5, g=[0, -9.81, 0])
        assert [name for name, _ in caught.value.fields] == ["block"]


def test_warnings(torpedo):
    assert torpedo.warnings == []
    assert scenes.Pendulum(mass=2.0, length=0.5, g=-9.81).warnings != []


def test_what_of_a_file_does_not_act_is_told(arm):
    (told,) = arm.warnings
    assert "the range -40 to 40 of `elbow` (`effort`) does not act; write `saturation = clamp`" in told
    assert told in scenes.Arm.__doc__
    upward = scenes.Arm(g=-9.81).warnings
    assert upward[0] == told and "fall upward" in upward[1] and len(upward) == 2


def test_pickles_are_parameters(torpedo, wire):
    for kernel in (torpedo, wire):
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            again = pickle.loads(pickle.dumps(kernel, protocol))
            assert again == kernel and hash(again) == hash(kernel) and again is not kernel
            assert repr(again.parameters) == repr(kernel.parameters)
    assert torpedo != wire


def test_what_was_derived_is_told(pendulum):
    assert "p_angle = mass*length^2*angle_dot" in pendulum.equations
    assert pendulum._repr_latex_().startswith("$$")
    assert "acceleration" in pendulum.operations and "acceleration" in pendulum.accuracy


def test_states_by_name(torpedo, wire, pendulum):
    q, z = wire.state(x=1.5, turn=[0, 0, 1, 0], turn_w=0.0)
    assert dict(zip(wire.coordinate_names, q))["x"] == 1.5
    assert q.tolist() == [0, 0, 1, 0, 1.5, 0] and not z.any()
    assert torpedo.state()[0].tolist() == [0, 0, 0, 1, 0, 0, 0]
    assert pendulum.input_names == ["motor"] and pendulum.dof == 1
    with pytest.raises(TypeError, match="no coordinate or speed is called heave"):
        torpedo.state(heave=1.0)
    with pytest.raises(ValueError, match="turn has 4 numbers, found 3"):
        wire.state(turn=[0, 0, 1])


def test_the_base_class_is_no_scene():
    with pytest.raises(TypeError, match="none itself"):
        scenes.Kernel()
