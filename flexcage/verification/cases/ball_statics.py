"""Angular contact ball bearings at rest, under axial and combined load."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.spec import StaticOptions
from flexcage.verification.bearings import RPM, angles, bearing_218, preset, solved
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# preset, axial load [N]: contact angle [deg], axial displacement [um], force of a ball [N]
AXIAL = (
    ("7010C-PI", 100, 15.73176, 6.3190, 20.4901),
    ("7010C-PA66", 100, 15.76589, 6.6669, 20.4468),
    ("7010C-PA66", 1500, 18.74616, 33.1183, 259.3017),
    ("7010C-PA66", 5000, 21.83308, 61.5219, 746.9076),
    ("7603025", 3500, 61.37582, 11.1265, 234.5487),
)
# 7603025 under 3500 N + 1200 N without tilt: forces [N] from the loaded side
SHARED = (542.523, 514.965, 439.615, 335.616, 226.814, 133.675, 67.710, 30.199, 15.004)
PRINTED = Tolerance(1e-5, "printed to six digits")
SHORT = Tolerance(5e-5, "printed to four or five digits")
CHANGE = Tolerance(0.1, "the reference says: less than 0.1 N", absolute=True)
STEEL = Tolerance(1e-3, "Harris's steel is not known to four digits")


def rows() -> Iterator[Row]:
    for name, force, angle, moved, ball in AXIAL:
        solution = solved(preset(name), axial=force)
        where = f"{name}, {force} N"
        yield Row(f"{where}: contact angle", "deg", angle, angles(solution)[0, 0], PRINTED)
        found = 1e6 * solution.displacement[0]
        yield Row(f"{where}: axial displacement", "um", moved, found, PRINTED)
        yield Row(f"{where}: force of a ball", "N", ball, solution.largest_force, PRINTED)
    solution = solved(bearing_218(), axial=17.8e3)
    yield Row("218, 17.8 kN: contact angle", "deg", 41.499, angles(solution)[0, 0], STEEL)
    yield Row("218, 17.8 kN: force of a ball", "N", 1678.99, solution.largest_force, STEEL)
    yield from _combined()


def _combined() -> Iterator[Row]:
    bearing, held = preset("7603025"), StaticOptions(tilt="held")
    solution = solved(bearing, options=held, axial=3500.0, radial=1200.0)
    where = "7603025, 3500 + 1200 N"
    x, y = 1e6 * solution.displacement[:2]
    yield Row(f"{where}: axial displacement", "um", 10.0592, x, PRINTED)
    yield Row(f"{where}: radial displacement", "um", 16.1790, y, PRINTED)
    for k, expected in enumerate(SHARED):
        found = solution.elements.force[k, 0]
        yield Row(f"{where}: force of ball {k}", "N", expected, found, SHORT)
    least, most = np.min(angles(solution)), np.max(angles(solution))
    yield Row(f"{where}: smallest contact angle", "deg", 57.846, least, PRINTED)
    yield Row(f"{where}: largest contact angle", "deg", 64.825, most, PRINTED)
    pressure = 1e-6 * solution.largest_pressure
    yield Row(f"{where}: largest pressure", "MPa", 2473.0, pressure, Tolerance(3e-4, "rounded"))
    # the reference takes moments about the plane of the inner groove's centres
    moment = abs(solution.reaction[4]) + bearing.inner_groove_centre[0] * 1200.0
    yield Row(f"{where}: moment that holds the tilt", "N m", 40.68, moment, SHORT)
    # likewise, it has no friction hold gyroscopic moments: outer race control gives 944.64 rpm
    free = StaticOptions(tilt="held", gyroscopic="none")
    turning = solved(bearing, options=free, axial=3500.0, radial=1200.0, rpm=2000.0)
    speeds = turning.elements.orbital_speed / RPM
    change = float(np.abs(turning.elements.force - solution.elements.force).max())
    yield Row(f"{where}, 2000 rpm: largest change of a force", "N", 0.0, change, CHANGE)
    yield Row(f"{where}, 2000 rpm: slowest ball", "rpm", 930.35, speeds.min(), PRINTED)
    yield Row(f"{where}, 2000 rpm: fastest ball", "rpm", 944.86, speeds.max(), PRINTED)


CASE: KnownAnswer = KnownAnswer(
    name="ball_statics",
    title="Angular contact ball bearings at rest",
    source="closed form for axial load, Fa = Z K A^1.5 sin(a) (cos(a0)/cos(a) - 1)^1.5 (T. A. "
    "Harris, Rolling Bearing Analysis), and an independent program for combined load; the 218 "
    "bearing is Harris's",
    checks="Contact angle, axial displacement and forces of three bearings of 15 and 60 degrees "
    "under axial load; one of them under axial and radial load without tilt, ball by ball, with "
    "the moment that holds it, and at 2000 rpm how little forces change and how fast each ball "
    "would go round by itself.",
    rows=rows,
)
