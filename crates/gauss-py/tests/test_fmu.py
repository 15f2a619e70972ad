"""Kernels as FMUs: what is in the file, and the same motion in FMPy, where that and a C compiler are there."""

import zipfile
from pathlib import Path
from xml.etree import ElementTree

import gauss
import numpy as np
import pytest

ARM = Path(__file__).parents[3] / "examples/python/arm.urdf"
SCENE = "coordinates(angle),\nparticle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)])"


@pytest.fixture(scope="module")
def pendulum():
    return gauss.scene(SCENE, m="kg", l="m", g=gauss.Field("m/s^2", role="gravity"))(m=2, l=0.5, g=9.81)


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_file_has_the_numbers_of_the_kernel(pendulum, tmp_path, fmi):
    file = tmp_path / "pendulum.fmu"
    platform = pendulum.fmu(file, start={"angle": 0.3}, fmi=fmi)
    with zipfile.ZipFile(file) as archive:
        names = archive.namelist()
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    assert root.get("fmiVersion") == f"{fmi}.0" and "sources/fmu.c" in names
    assert any(name.startswith("binaries/") for name in names) == (platform is not None)
    starts = {}
    for variable in root.find("ModelVariables"):
        own = variable if fmi == 3 else variable.find("Real")
        starts[variable.get("name")] = own.get("start")
    assert (starts["m"], starts["l"], starts["g"], starts["angle"]) == ("2.0", "0.5", "9.81", "0.3")


def test_what_cannot_be_is_refused(pendulum, tmp_path):
    with pytest.raises(ValueError, match="no state `angel`"):
        pendulum.fmu(tmp_path / "pendulum.fmu", start={"angel": 0.3})
    with pytest.raises(ValueError, match="versions 2 and 3"):
        pendulum.fmu(tmp_path / "pendulum.fmu", fmi=1)
    with pytest.raises(ValueError, match="names no binary"):
        pendulum.fmu(tmp_path / "a pendulum.fmu")
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(OSError):
        pendulum.fmu(tmp_path / "taken/pendulum.fmu")
    assert [own.name for own in tmp_path.iterdir()] == ["taken"]


def test_a_robot_moves_alike(tmp_path):
    fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed")
    arm = gauss.load(ARM, ["frames(tool)"], gravity=9.81)
    if arm.fmu(tmp_path / "arm.fmu", start={"elbow": 0.2}) is None:
        pytest.skip("no C compiler")
    found = fmpy.simulate_fmu(str(tmp_path / "arm.fmu"), fmi_type="CoSimulation", stop_time=1, relative_tolerance=1e-11)
    expected = arm.simulate([0, 0.2], [0, 0], (0, 1), input=[0, 0])
    # Steps of the FMU err by 1e-11, those of `simulate` by 1e-9 of each state by default; there are some hundred.
    assert abs(found["elbow"][-1] - expected["elbow"][-1]) < 1e-6
    assert np.isfinite(found["tool.position[1]"]).all()
