"""Runs that differ by a tolerance part ways, and agree within the intervals of their summaries."""

import numpy as np
import pytest
from simulate_cases import bent, n1013

from flexcage.simulate import simulate

STATISTICS = (
    "cage_speed", "cage_speed_ripple", "slip_loaded", "slip_unloaded", "whirl_radius",
    "pocket_force_mean", "pocket_force_pass_peak",
)  # fmt: skip


@pytest.fixture(scope="module")
def pair():
    long = {"cage.model": "rigid", "solver.duration": "140 ms"}
    cases = [
        n1013(long, {"solver.tolerance": t}, defects=bent("0.2 mm"))
        for t in ("0.01 um", "0.008 um")
    ]
    return [simulate(case) for case in cases]


def test_motions_part_ways(pair):
    one, other = (run.dataset["pocket_force"].values[2000:] for run in pair)
    assert np.linalg.norm(one - other) > 0.3 * np.linalg.norm(one)


def test_statistics_agree_within_their_intervals(pair):
    """One of seven 95 % intervals may miss, none by its own width."""
    apart = []
    for key in STATISTICS:
        one, other = (run.summary.row(key) for run in pair)
        assert 0.0 < one.margin < 0.5 * abs(one.value) and other.margin > 0.0, key
        apart.append(abs(one.value - other.value) / (one.margin + other.margin))
    assert np.sort(apart)[-2] < 1.0 and max(apart) < 2.0
