"""Natural frequencies over speed, with the bearings' stiffness here or at each speed."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage import load_machine, solve_machine
from flexcage.machine.whirl import over_speeds

SPINDLE = {
    "drive": {"speed": "2000 rpm"},
    "shaft": {"sections": [{"length": "220 mm", "diameter": "50 mm"}], "elements": 16,
              "discs": [{"position": "0 mm", "mass": "2 kg", "unbalance": "20 g*mm"}]},
    "bearings": [
        {"name": n, "preset": "7010C-PI", "position": f"{x} mm", "facing": f,
         "preload_force": "150 N"} for n, x, f in (("A", 60, "+x"), ("B", 180, "-x"))
    ],
    "whirl": {"highest": "18000 rpm", "points": 3, "modes": 4},
}  # fmt: skip


def whirls(**more):
    m = load_machine({**SPINDLE, "whirl": {**SPINDLE["whirl"], **more}})
    return over_speeds(m, solve_machine(m))


def test_each_speed_has_the_stiffness_of_its_own_solution():
    speeds, found, orbits = whirls(stiffness="each_speed")
    assert speeds == pytest.approx(np.array([0.0, 9000.0, 18000.0]) * np.pi / 30.0)
    fast = load_machine({**SPINDLE, "drive": {"speed": "18000 rpm"}})
    lines = solve_machine(fast).linearised
    own, ways = lines.frequencies(speeds[-1], 4)
    assert found[-1][0] == pytest.approx(own, rel=1e-6) and found[-1][1] == ways
    here, there = whirls()[1][-1][0], found[-1][0]
    assert np.abs(there / here - 1.0).max() > 0.01  # balls that fly outwards change it
    assert orbits[0] == 0.0 and orbits[1] > 0.0


def test_a_speed_without_equilibrium_is_a_gap(caplog):
    _, found, orbits = whirls(stiffness="each_speed", highest="9e6 rpm")
    assert len(found[0][0]) == 4 and len(found[-1][0]) == 0 and np.isnan(orbits[-1])
    assert "no equilibrium at 2 of the 3 speeds of [whirl], from 4.5e+06 rpm on" in caplog.text
