"""The static solution of rollers and the start of a run: two programs, one equilibrium."""

import numpy as np
import pytest
from verification_bearing import bearing_of, n1013

from flexcage.static import solve_static
from flexcage.system.start import find_start

STILL = {"load.gravity": "0 m/s^2", "cage.model": "rigid"}


@pytest.mark.parametrize(("tilt", "rpm", "direction"), [(0.0, 6000, 20), (0.5, 0, 0), (1.0, 0, 70)])
def test_start_of_a_run_is_the_static_solution(tilt, rpm, direction):
    """Forces of every roller, displacement, and the moments that hold the tilt.

    The start has exact geometry: a ring moved d across a roller's line leaves d^2/2r more room,
    3 nm of a depth of 1 um. At speed the start has tilted rollers' gyroscopic moments as well.
    """
    case = n1013(
        STILL,
        {"load.misalignment": f"{tilt} mrad", "drive.speed": f"{rpm} rpm",
         "load.direction": f"{direction} deg"},
    )  # fmt: skip
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    bearing.residual(0.0, start.y, start.yd, 2)
    report, q = bearing.data.work.report, bearing.layout.q(start.y)
    solution = solve_static(case)
    force = report.race[:, :, 0]
    assert solution.elements.force == pytest.approx(force, abs=5e-3 * force.max())
    assert solution.displacement[1:3] == pytest.approx(q["inner"][1:3], abs=5e-8)
    # what the ring's constraints must add: no multiplier is set yet
    moment = bearing.layout.u(bearing.residual(0.0, start.y, start.yd))["inner"][4:6]
    if tilt:
        assert moment[1] > 0.05
        assert solution.reaction[3:] == pytest.approx(moment, abs=0.01 * np.abs(moment).max())
