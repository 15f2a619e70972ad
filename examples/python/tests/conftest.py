"""The kernels of the tests, one of each class."""

import numpy as np
import pytest
import scenes


@pytest.fixture(scope="session")
def pendulum():
    return scenes.Pendulum(mass=2.0, length=0.5, g=9.81)


@pytest.fixture(scope="session")
def torpedo():
    return scenes.Torpedo(
        mass=30.0, center=[0, 0, -0.02], inertia=[0.2, 3.5, 3.5], added=[0.9, 35, 35, 0.07, 4.9, 4.9], lift=60.0
    )


@pytest.fixture(scope="session")
def arm():
    return scenes.Arm(g=9.81)


@pytest.fixture(scope="session")
def wire():
    return scenes.Wire(block={"mass": 2.0, "inertia": [0.1, 0.2, 0.3]}, radius=1.5, g=[0, -9.81, 0])


@pytest.fixture
def random():
    return np.random.default_rng(7)
