"""The cage's centre from the readings of five lasers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import radians, tan

import numpy as np

from flexcage.results.instrument import LaserSetup, by_tilt_angles, invert, readings
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

SETUP = LaserSetup(radius=33e-3, half_width=16e-3, plane=15e-3, circle=31e-3)
SENSOR = replace(SETUP, repeatability=0.02e-6, resolution=0.01e-6)  # of a laser, assumed
CAGES = 1000

DIGITS = Tolerance(5.1e-12, "arithmetic; printed to 1e-11", absolute=True)
TWO_DIGITS = Tolerance(5.1e-3, "arithmetic; printed to 1e-2", absolute=True)
ROUNDING = Tolerance(1e-6, "Newton's steps end at a picometre", absolute=True)
MICROMETRE = Tolerance(1.0, "what the published measurement claims", absolute=True)


def rows() -> Iterator[Row]:
    shown = readings(np.array([[0.0, 0.1e-3, 0.0]]), _axis(tan(radians(0.2)), 0.0), SETUP)
    yield Row("reading Y, 0.2 deg in its plane", "mm", 0.15256113874, 1e3 * shown[0, 0], DIGITS)
    back = by_tilt_angles(shown, SETUP)[0, 0]
    yield Row("centre by tilt angles, the same", "mm", 0.1, 1e3 * back, DIGITS)

    centre = np.array([[0.0, 0.1e-3, 0.12e-3]])
    shown = readings(centre, _axis(tan(radians(0.2)), tan(radians(0.3))), SETUP)
    off = by_tilt_angles(shown, SETUP)[0, 0] - centre[0, 1]
    yield Row("tilt angles miss y, 0.3 deg across", "um", -0.60, 1e6 * off, TWO_DIGITS)
    off = np.abs(invert(shown, SETUP)[0] - centre).max()
    yield Row("inversion misses the same", "um", 0.0, 1e6 * off, ROUNDING)

    rng = np.random.default_rng(1)
    centre = rng.uniform(-0.3e-3, 0.3e-3, (CAGES, 3))
    slope = rng.uniform(-4e-3, 4e-3, (CAGES, 2))
    shown = readings(centre, _axis(slope[:, 0], slope[:, 1]), SENSOR, seed=2)
    off = np.abs(invert(shown, SENSOR)[0] - centre).max()
    yield Row(f"inversion misses {CAGES} cages by noise, most", "um", 0.0, 1e6 * off, MICROMETRE)


def _axis(y: float | np.ndarray, z: float | np.ndarray) -> np.ndarray:
    """Unit axes (n, 3) with these slopes."""
    axis = np.column_stack(np.broadcast_arrays(np.ones(1), y, z))
    return axis / np.linalg.norm(axis, axis=1, keepdims=True)


CASE: KnownAnswer = KnownAnswer(
    name="laser_inversion",
    title="A cage's centre from five lasers",
    source="Measurement and Dynamic Analysis of the Centroid Trajectories of Angular-Contact Ball "
    "Bearing Cages, its equations; the reading and the miss from an independent program",
    checks="Lines of sight on a tilted cylinder and its end face; the published equation, exact "
    "for a tilt in the sensor's plane; and the inversion, exact for any tilt, with noise as well.",
    rows=rows,
)
