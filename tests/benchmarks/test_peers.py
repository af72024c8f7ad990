"""What other integrators are given to work on, without any of them."""

from pathlib import Path

import numpy as np
from c_functions import CFunctions

import flexcage
from flexcage.compiling import build_bearing
from flexcage.stages import assembled_start, cage_mesh
from flexcage.system.data import POWERS

CASE = Path(__file__).resolve().parents[2] / "examples" / "n1013.toml"


def test_c_functions_are_the_bearings_own():
    case = flexcage.load_case(CASE).replace({"cage.model": "rigid", "defects": ()})
    bearing = build_bearing(case, cage_mesh(case), None)
    start, c = assembled_start(case, bearing), CFunctions(bearing)
    y, yd, found = start.y, start.yd, np.empty_like(start.y)
    c.residual(0.0, y, yd, found)
    np.testing.assert_array_equal(found, bearing.residual(0.0, y, yd))
    rated = y.copy(), np.zeros_like(y)
    own = y.copy(), np.zeros_like(y)
    c.rates(0.0, *rated)
    bearing.function("rates")(0.0, *own, bearing.args, np.zeros(0))
    np.testing.assert_array_equal(rated, own)
    alpha, step = 1.0 / 2e-6, found.copy()
    c.setup(0.0, y, yd, alpha)
    c.solve(alpha, y, step)
    assert np.isfinite(step).all() and step.any()
    bearing.data.memory.race[...] = -1.0
    c.accepted(0.0, y, yd)  # contacts that are open remember how fast they close
    assert (
        (bearing.data.memory.race >= 0.0).any() and np.any(c.power) and len(c.power) == len(POWERS)
    )
