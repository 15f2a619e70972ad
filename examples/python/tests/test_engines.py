"""Studies by engines: draws are functions of seed and run, and a worker that is killed changes no bit."""

import os
import pathlib
import sys

import numpy as np
import pytest

pytest.importorskip("scipy", reason="NOT TESTED: scipy is not installed")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "study"))
import engines  # noqa: E402
import lander  # noqa: E402

WORD = 2**64 - 1


def philox(key, count):
    """Philox4x64-10 (Salmon, Moraes, Dror, Shaw 2011), written by its definition: four words."""
    words, key = [count, 0, 0, 0], list(key)
    for _ in range(10):
        a, b = 0xD2E7470EE14C6C93 * words[0], 0xCA5A826395121157 * words[2]
        words = [(b >> 64) ^ words[1] ^ key[0], b & WORD, (a >> 64) ^ words[3] ^ key[1], a & WORD]
        key = [(key[0] + 0x9E3779B97F4A7C15) & WORD, (key[1] + 0xBB67AE8584CAA73B) & WORD]
    return words


def test_draws_are_philox_by_seed_name_and_run():
    import hashlib

    name = int.from_bytes(hashlib.blake2b(b"mass", digest_size=8).digest(), "little")
    for seed, run in [(0, 0), (1, 5), (2, 6), (WORD, 10**9 + 3)]:
        # NumPy counts before it makes words.
        word = philox([seed, name], run // 4 + 1)[run % 4]
        assert lander.uniform(seed, "mass", run, run + 1) == [((word >> 12) + 0.5) / 2**52]


def test_chunks_have_the_bits_of_single_runs():
    whole = lander.touchdowns(3, 0, 24)
    parts = [lander.touchdowns(3, *part) for part in [(0, 1), (1, 7), (7, 20), (20, 24)]]
    assert np.isfinite(whole).all() and np.concatenate(parts).tobytes() == whole.tobytes()
    assert lander.touchdowns(4, 0, 24).tobytes() != whole.tobytes()
    flight = lander.flight(3, 21)
    assert flight.stopped_by == 0 and [flight.t[-1], *flight.q[-1, 4:6], flight.steps] == list(whole[21, [0, 1, 2, 7]])


def test_a_lander_comes_to_the_speed_at_which_drag_is_weight():
    drawn = lander.draw(3, 0, 24)
    steady = np.sqrt(2 * drawn["mass"] * 9.81 / (drawn["density"] * drawn["drag_area"]))
    down = lander.touchdowns(3, 0, 24)[:, lander.RESULTS.index("down")]
    # Across the canopy goes what the wind changes in height: some 2 m/s, a share of (2/7)²/2 of the drag's square.
    assert (abs(down / steady - 1) < 0.04).all()


@pytest.mark.parametrize("engine, module", [("dask", "distributed"), ("ray", "ray")])
def test_a_worker_that_is_killed_changes_no_bit(engine, module, tmp_path):
    pytest.importorskip(module, reason=f"NOT TESTED: {module} is not installed")
    # A run takes 0.1 ms, but 20 ms in the build for tests, which is not optimised.
    runs, size = int(os.environ.get("GAUSS_LANDERS", "1000")), 50
    dies_at, log = runs // 2, str(tmp_path / "begun")
    rows, _ = engines.ENGINES[engine](5, runs, size, workers=2, log=log, dies_at=dies_at)
    begun = [line.split() for line in pathlib.Path(log).read_text().splitlines()]
    assert {int(start) for start, _ in begun} == set(range(0, runs, size))
    # The chunk in which a worker was killed was made again, by another, and the killed one began nothing after it.
    killed, other = [pid for start, pid in begun if int(start) == dies_at]
    assert killed != other and [start for start, pid in begun if pid == killed][-1] == str(dies_at)
    expected, _ = engines.serial(5, runs, size)
    assert rows.shape == (runs, len(lander.RESULTS)) and np.isfinite(expected).all()
    assert rows.tobytes() == expected.tobytes()
