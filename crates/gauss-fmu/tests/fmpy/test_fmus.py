"""FMUs in FMPy: valid, one motion by its solver and by the steps of the FMU, events at their times, two coupled."""

import os
import subprocess
from pathlib import Path

import pytest

np = pytest.importorskip("numpy")
fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed: `pip install fmpy`")

HERE = Path(__file__).parent
COMMAND = os.environ.get("CARGO_GAUSS", HERE.parents[3] / "target/debug/cargo-gauss")
SCENES = {
    "Cart": ["--set", "m=2"],
    "Pair": ["--set", "m=2", "--set", "k=8", "--start", "y=1.5"],
    "Ball": ["--set", "m=0.5", "--set", "e=0.8", "--set", "g=9.81", "--start", "height=1"],
    "Top": ["--set", "mass=1", "--set", "center=0,0,0.1", "--set", "inertia=0.02,0.02,0.005", "--set", "g=9.81",
            "--start", "omega_x=1", "--start", "omega_z=40"],
}


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    if not Path(COMMAND).is_file():
        pytest.skip(f"{COMMAND} is not built: `cargo build -p cargo-gauss`")
    folder = tmp_path_factory.mktemp("fmus")
    for name, numbers in SCENES.items():
        for version in "23":
            file = folder / f"{name.lower()}{version}.fmu"
            scene = ["--scene", HERE / "scenes.rs", "--of", name, "--fmi", version]
            made = subprocess.run([COMMAND, "gauss", "create", "--fmu", file, *scene, *numbers], capture_output=True)
            assert made.returncode == 0, made.stderr.decode()
            if b"source code alone" in made.stdout:
                pytest.skip("no C compiler")
    return folder


every = pytest.mark.parametrize("name", [f"{name.lower()}{version}" for name in SCENES for version in "23"])


@every
def test_valid(fmus, name):
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(fmus / f"{name}.fmu")) == []


def outputs(file):
    description = fmpy.read_model_description(file)
    return [variable.name for variable in description.modelVariables if variable.causality == "output"]


def run(file, kind, tolerance, **more):
    return fmpy.simulate_fmu(file, fmi_type=kind, stop_time=2, output_interval=0.05, relative_tolerance=tolerance,
                             output=outputs(file), **more)


@pytest.mark.parametrize("name", ["pair2", "pair3", "top2", "top3"])
def test_both_kinds_are_one_motion(fmus, name):
    """CVODE and the steps of the FMU share nothing but the rates. Of a top that turns 13 times in the run CVODE takes
    some thousand steps, each of which errs by the tolerance; a gyroscope hands errors on tenfold at most."""
    file = str(fmus / f"{name}.fmu")
    differences = []
    for tolerance in (1e-8, 1e-10):
        exchanged, stepped = (run(file, kind, tolerance) for kind in ("ModelExchange", "CoSimulation"))
        sizes = {output: 1 + np.abs(stepped[output]).max() for output in outputs(file)}
        differences.append(max(np.abs(exchanged[own] - stepped[own]).max() / size for own, size in sizes.items()))
    assert differences[1] < 1e-10 * 1e4 * 10 and differences[1] < differences[0] / 10, differences


@pytest.mark.parametrize("version", "23")
def test_a_spring_has_its_period(fmus, version):
    stepped = run(str(fmus / f"pair{version}.fmu"), "CoSimulation", 1e-11)
    expected = 1 + 0.5 * np.cos(np.sqrt(8 / 1) * stepped["time"])
    # Each of some hundred steps errs by 1e-11 of 1 + |x| at most, and errors grow with the time.
    assert np.abs(stepped["y"] - stepped["x"] - expected).max() < 1e-8


@pytest.mark.parametrize("version", "23")
def test_parameters_are_taken(fmus, version):
    file = str(fmus / f"pair{version}.fmu")
    stepped = run(file, "CoSimulation", 1e-11, start_values={"k": 2.0, "x": 0.2})
    expected = 1 + 0.3 * np.cos(np.sqrt(2 / 1) * stepped["time"])
    assert np.abs(stepped["y"] - stepped["x"] - expected).max() < 1e-8


@pytest.mark.parametrize("version", "23")
def test_a_ball_bounces_at_its_times_and_rests(fmus, version):
    file = str(fmus / f"ball{version}.fmu")
    run = fmpy.simulate_fmu(file, stop_time=6, output_interval=0.001, relative_tolerance=1e-10, output=outputs(file))
    first, e = np.sqrt(2 / 9.81), 0.8
    times = [first]
    for bounce in range(1, 6):
        times.append(times[-1] + 2 * first * e**bounce)
    lowest = [k for k in range(1, len(run) - 1)
              if run["height_dot"][k - 1] < -1e-3 and run["height_dot"][k + 1] > 1e-3]
    found = sorted({round(run["time"][k], 2) for k in lowest})
    for time in times:
        assert min(abs(run["time"][k] - time) for k in lowest) < 2e-3, (time, found)
    # It rests from sqrt(2 h/g) (1 + e)/(1 - e) on, and the floor bears it.
    assert first * (1 + e) / (1 - e) < 6
    assert run["height_dot"][-1] == 0.0 and abs(run["height"][-1]) < 1e-12
    assert abs(run["floor.force"][-1] - 0.5 * 9.81) < 1e-12


def test_a_ball_has_no_steps_of_its_own(fmus):
    description = fmpy.read_model_description(str(fmus / "ball2.fmu"))
    assert description.coSimulation is None and description.numberOfEventIndicators == 1


def coupled(file, step):
    """Two carts, each an instance, on a spring between them that is evaluated at communication points."""
    description = fmpy.read_model_description(file)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    folder = fmpy.extract(file)
    carts = []
    for name, x in (("left", 0.0), ("right", 1.5)):
        cart = fmpy.fmi2.FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName=name,
                                   modelIdentifier=description.coSimulation.modelIdentifier)
        cart.instantiate()
        cart.setupExperiment(startTime=0.0, tolerance=1e-11)
        cart.setReal([references["x"]], [x])
        cart.enterInitializationMode()
        cart.exitInitializationMode()
        carts.append(cart)
    for k in range(round(1 / step)):
        left, right = (cart.getReal([references["x"]])[0] for cart in carts)
        pull = 8 * (right - left - 1)
        for cart, force in zip(carts, (pull, -pull)):
            cart.setReal([references["push"]], [force])
            cart.doStep(currentCommunicationPoint=k * step, communicationStepSize=step)
    left, right = (cart.getReal([references["x"]])[0] for cart in carts)
    for cart in carts:
        cart.terminate()
        cart.freeInstance()
    return right - left


def test_two_fmus_are_coupled(fmus):
    """The force is held within a step: the error is of first order in it, and goes to half with half of it."""
    expected = 1 + 0.5 * np.cos(np.sqrt(8))
    coarse, fine = (abs(coupled(str(fmus / "cart2.fmu"), step) - expected) for step in (1 / 256, 1 / 512))
    assert fine < 0.01 and 1.8 < coarse / fine < 2.2


@pytest.mark.parametrize("name", ["top2", "pair2"])
def test_what_is_not_a_number_is_refused(fmus, name):
    messages = []
    with pytest.raises(Exception):
        run(str(fmus / f"{name}.fmu"), "CoSimulation", 1e-8, start_values={"kinetic_energy": 1.0})
    parameter = {"top2": "mass", "pair2": "k"}[name]
    with pytest.raises(fmpy.fmi1.FMICallException):
        run(str(fmus / f"{name}.fmu"), "CoSimulation", 1e-8, start_values={parameter: float("nan")},
            logger=lambda *arguments: messages.append(str(arguments)))
    assert any(f"`{parameter}` is set to nan" in message.replace("-nan", "nan") for message in messages), messages
