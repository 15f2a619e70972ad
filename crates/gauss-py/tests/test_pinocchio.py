"""The page "Pinocchio in Python": every line of it, beside Pinocchio."""

import re
from pathlib import Path

import gauss
import numpy as np
import pytest

PAGE = (Path(__file__).parents[3] / "guide/src/from_pinocchio_python.md").read_text()
ARM = Path(__file__).parent / "pinocchio/arm.urdf"
CODE = re.findall(r"```python\n(.*?)```", PAGE, re.S)
#: Rows of tables: the quantity, theirs, ours.
ROWS = re.findall(r"^\| (?!quantity)([^|]*) \| `([^`]*)` \| `([^`]*)` \|$", PAGE, re.M)


def states(random, model, pin):
    """A state of the arm, and one of it with a floating base, with names as on the page."""
    q, q2, v, a, tau = random.uniform(-0.3, 0.5, (5, 3))
    far = lambda: np.concatenate([random.normal(size=3), random.normal(size=4), random.uniform(-0.3, 0.5, 3)])
    p, p2 = far(), far()
    for one in (p, p2):
        one[3:7] /= np.linalg.norm(one[3:7])
    w, b = random.normal(size=(2, 9))
    return dict(q=q, q2=q2, v=v, a=a, tau=tau, p=p, p2=p2, w=w, b=b, twist=random.normal(size=6))


def value(words, names):
    """The last of statements; those before it are carried out."""
    *first, last = words.split("; ")
    for statement in first:
        exec(statement, names)
    return eval(last, names)


@pytest.fixture(scope="module")
def names():
    pytest.importorskip("pinocchio", reason="compared with Pinocchio: pip install pin")
    names = {}
    for block in CODE:
        exec(block.replace('"arm.urdf"', repr(str(ARM))), names)
    assert names["q"].shape == (1000, 3)
    return names


def test_the_page_has_tables():
    assert len(ROWS) == PAGE.count("\n| ") - PAGE.count("\n| quantity") and len(ROWS) > 35


@pytest.mark.parametrize("row", ROWS, ids=[f"{row[0]}: {row[1].split('(')[0]}" for row in ROWS])
def test_both_columns_are_the_same(row, names):
    _, theirs, ours = row
    random = np.random.default_rng(7)
    for _ in range(10):
        names |= states(random, names["model"], names["pin"])
        expected, found = value(theirs, names), value(ours, names)
        if isinstance(found, list) and isinstance(found[0], str):
            assert found == expected
            continue
        expected, found = np.asarray(expected), np.asarray(found)
        assert found.shape == expected.shape
        # Sums of some ten products a joint, on both sides, through the solution of a system whose condition is below a
        # hundred; derivatives have terms ten times as large.
        near = 2e-12 * max(1.0, np.abs(expected).max())
        np.testing.assert_allclose(found, expected, rtol=0, atol=near)


def test_configurations_at_random_are_within_limits(names):
    exec(CODE[1], names)
    q = names["q"]
    assert (q >= names["model"].lowerPositionLimit).all() and (q <= names["model"].upperPositionLimit).all()


def test_motions_of_any_size_and_shape():
    random = np.random.default_rng(2)
    twists = random.normal(size=(4, 5, 6)) * np.array([1e-9, 1e-3, 1, 1.5])[:, None, None]
    # Rotation vectors below half a turn are the shortest.
    twists[..., 3:] *= np.minimum(1, 3 / np.linalg.norm(twists[..., 3:], axis=-1, keepdims=True))
    poses = gauss.exp6(twists)
    assert poses.shape == (4, 5, 4, 4) and (poses[..., 3, :] == [0, 0, 0, 1]).all()
    # Near half a turn the logarithm loses what the sine of an angle next to pi does, a digit here.
    np.testing.assert_allclose(gauss.log6(poses), twists, rtol=1e-13, atol=1e-14)
    # ω × r at a pole that is carried along, by hand: a turn about z at a distance along x.
    pose = np.eye(4)
    pose[:3, 3] = [2.0, 0.0, 0.0]
    np.testing.assert_array_equal(gauss.adjoint(pose) @ [0, 0, 0, 0, 0, 1.0], [0, -2.0, 0, 0, 0, 1.0])
    np.testing.assert_array_equal(gauss.turned(pose), np.eye(6))
    assert gauss.exp6(np.zeros((0, 6))).shape == (0, 4, 4) and gauss.log6(np.eye(4)).tolist() == [0.0] * 6


def test_mistakes_with_motions():
    with pytest.raises(ValueError, match=r"increment has shape \(4,\); expected \(..., 6\)"):
        gauss.exp6(np.zeros(4))
    with pytest.raises(ValueError, match=r"pose has shape \(3, 3\); expected \(..., 4, 4\)"):
        gauss.log6(np.eye(3))
    for wrong in (2 * np.eye(4), np.diag([1.0, 1.0, -1.0, 1.0]), np.full((4, 4), np.nan)):
        with pytest.raises(ValueError, match="pose is no rigid motion"):
            gauss.adjoint(wrong)
    with pytest.raises(TypeError, match="no array of real numbers"):
        gauss.exp6(["a"] * 6)


def test_limits_are_those_of_the_file(tmp_path):
    text = ARM.read_text().replace('name="elbow"', 'name="el-bow"').replace(' type="revolute"', ' type="continuous"', 1)
    (tmp_path / "arm.urdf").write_text(text)
    limits = gauss.load(tmp_path / "arm.urdf", gravity=0).limits
    # Names are those of the coordinates; a joint without an end goes on for ever, though it has numbers for one.
    assert list(limits) == ["slide", "shoulder", "el_bow"]
    assert limits["el_bow"] == (-0.5, 2.2, 4.0, 40.0) and limits["slide"].lower == -0.3
    assert limits["shoulder"] == (-np.inf, np.inf, 3.0, 60.0)
    with pytest.raises(ValueError, match="limits are read from URDF files"):
        gauss.scene("coordinates(x), particle(mass = 1, position = [x, 0, 0])")().limits
