"""What one run of the 7010C's cage is, and what the paper's lasers would show of it.

Numbers that studies of this folder ask for. All are over the whole settled record.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np

from flexcage import register
from flexcage.results import instrument, metrics
from flexcage.results.instrument import LaserSetup
from flexcage.results.slip import cage_speed

#: Axial place of the radial sensors [m] from the cage's middle. The paper does not give it: they
#: must see the cage beside the ring, which ends at 8 mm, and the cage of the preset ends at 10 mm.
PLANE = 9e-3
PLANES = {"near": 8.2e-3, "far": 9.8e-3}  # m, how near and how far that leaves it
RUN_OUT = 20e-6  # m, assumption: run-out of a machined polymer's end face
NOISE = 0.02e-6  # m, the sensors' repeatability, as the paper says
REACH = 3e-3  # m, and their range
LINE = 2  # bins of a Hann window's spectrum on either side of a line that belong to it
UNITS = {
    "speed": "rpm",  # of the cage, mean
    "beyond_theory": "%",  # share by which it exceeds equation 18: 15 deg at both races
    "mean_radius": "mm",  # of the cage's centre about the axis
    "difference": "mm",  # largest less least of that radius
    "ratio": "",  # difference over mean radius
    "origin": "mm",  # difference of the radius of the cage's axis in the sensors' plane
    "origin_error": "%",  # origin over difference, less one: the paper's Table 5
    "raw": "mm",  # difference of the sensors' readings
    "solved": "mm",  # difference by the paper's equations
    "error": "%",  # raw over solved, less one: the paper's Table 4
    "error_near": "%",
    "error_far": "%",
    "axial_raw": "%",  # share of an axial reading's variance at the cage's frequency
    "axial_solved": "%",  # of the centre's axial motion
    "axial_raw_run_out": "%",  # the same of an end face that runs out
    "axial_solved_run_out": "%",
    "axial_range": "um",
    "tilt": "deg",  # mean
    "turns": "",  # of the centre about the axis, over those of the cage
    "lost": "%",  # readings out of the sensors' range
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    case, ds = run.case, metrics.settled(run.dataset, run.case.output.settle)
    speed = cage_speed(ds, run.numbers)
    centre, axis = instrument.of_run(ds)
    radius = np.hypot(centre[:, 1], centre[:, 2])
    setup = setup_of(case.cage)
    shown = instrument.readings(centre, axis, setup, seed=1)
    solved = difference(instrument.by_tilt_angles(shown, setup))
    face = instrument.run_out(ds, total=RUN_OUT, circle=setup.circle)
    askew = instrument.readings(centre, axis, setup, face=face, seed=1)
    frequency, rate = abs(speed.mean) / (2.0 * pi), metrics.sampling_rate(ds)
    apart, raw = float(np.ptp(radius)), difference(shown[:, :2])
    origin = difference(at_plane(centre, axis, PLANE))
    return {
        "speed": speed.mean,
        "beyond_theory": speed.mean / speed.nominal - 1.0,
        "mean_radius": float(radius.mean()),
        "difference": apart,
        "ratio": apart / float(radius.mean()),
        "origin": origin,
        "origin_error": origin / apart - 1.0,
        "raw": raw,
        "solved": solved,
        "error": raw / solved - 1.0,
        **{f"error_{name}": error_at(centre, axis, case.cage, p) for name, p in PLANES.items()},
        "axial_raw": line_share(shown[:, 2], frequency, rate),
        "axial_solved": line_share(axial(shown), frequency, rate),
        "axial_raw_run_out": line_share(askew[:, 2], frequency, rate),
        "axial_solved_run_out": line_share(axial(askew), frequency, rate),
        "axial_range": float(np.ptp(centre[:, 0])),
        "tilt": float(metrics.tilt(ds).sel(component="total").values.mean()),
        "turns": metrics.whirl(ds, about="axis").speed_ratio,
        "lost": float(np.isnan(shown).any(axis=1).mean()),
    }


def setup_of(cage, plane: float = PLANE) -> LaserSetup:
    """The paper's five lasers around this cage."""
    return LaserSetup(
        radius=0.5 * cage.outside_diameter, half_width=0.5 * cage.width, plane=plane,
        circle=cage.mean_radius, repeatability=NOISE, reach=REACH,
    )  # fmt: skip


def error_at(centre: np.ndarray, axis: np.ndarray, cage, plane: float) -> float:
    """Deflection error that sensors in another plane have."""
    setup = setup_of(cage, plane)
    shown = instrument.readings(centre, axis, setup, seed=1)
    return difference(shown[:, :2]) / difference(instrument.by_tilt_angles(shown, setup)) - 1.0


def at_plane(centre: np.ndarray, axis: np.ndarray, plane: float) -> np.ndarray:
    """Where the cage's axis passes (n, 2) the plane across the bearing at ``plane`` [m]."""
    along = (plane - centre[:, 0]) / axis[:, 0]
    return centre[:, 1:] + along[:, None] * axis[:, 1:]


def axial(shown: np.ndarray) -> np.ndarray:
    """The paper's equation 10: the mean of three axial readings on a circle, from which the tilt
    drops out."""
    return shown[:, 2:].mean(axis=1)


def difference(yz: np.ndarray) -> float:
    """Largest less least distance (n, 2) from the axis, of readings that are there."""
    away = np.hypot(yz[:, 0], yz[:, 1])
    return float(np.nanmax(away) - np.nanmin(away))


def line_share(values: np.ndarray, frequency: float, rate: float) -> float:
    """Share of the variance at a frequency, under a Hann window; NaN where the record is too short
    to tell the line from the mean, or readings are missing."""
    n = len(values)
    place = frequency * n / rate  # in bins
    if place < 2 * LINE or not np.isfinite(values).all() or not np.ptp(values) > 0.0:
        return float("nan")
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(n))) ** 2
    bins = np.arange(len(power))
    near = np.abs(bins - place) <= LINE
    return float(power[near].sum() / power[1:].sum())


register.outputs(evaluate, UNITS)
