"""What one run of the 7010C's cage is, and what the paper's lasers would show of it.

Numbers that studies of this folder ask for. All are over the whole settled record, but ``whole``.

What lasers see is no part of a case, as no force depends on it. The form error of the cage is an
unknown all the same: a setting writes it into the case's ``description``, and it is read here.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np

from flexcage import register
from flexcage.core.units import parse
from flexcage.results import instrument, metrics
from flexcage.results.instrument import LaserSetup
from flexcage.results.rim import Rim
from flexcage.results.slip import at_own_angles, cage_speed
from flexcage.results.statistics import element_passes

#: Axial place of the radial sensors [m] from the cage's middle. The paper does not give it: they
#: must see the cage beside the ring, which ends at 8 mm, and the cage of the preset ends at 10 mm.
PLANE = 9e-3
PLANES = {"near": 8.2e-3, "far": 9.8e-3}  # m, how near and how far that leaves it
NOISE = 0.02e-6  # m, the sensors' repeatability, as the paper says
REACH = 3e-3  # m, and their range
SPOT = 25e-6  # m, of such a sensor by its maker
LOBES = 2  # of the rim: an oval is what clamping a thin ring leaves
CLEARLY, FAR = 2.0, 0.05  # of a drift, over its margin and the mean: of four speeds each by chance
# at one in twenty, every fifth setting would be left out
LINE = 2  # bins of a Hann window's spectrum on either side of a line that belong to it
UNITS = {
    "form": "um",  # error: height of the rim's lobes, and run-out of the end face
    "drifts": "",  # 1 where the whirl of the record's halves differs, clearly and by 5 % or more
    "speed": "rpm",  # of the cage, mean
    "beyond_theory": "%",  # share by which it exceeds equation 18: 15 deg at both races
    "by_angles": "%",  # the same of rolling by the mean of both races' own contact angles
    "by_outer": "%",  # and of balls that roll on the outer race and spin on the inner
    "mean_radius": "mm",  # of the cage's centre about the axis
    "difference": "mm",  # largest less least of that radius
    "whole": "mm",  # the same from the start on, where the cage is centred
    "ratio": "",  # difference over mean radius
    "origin": "mm",  # difference of the radius of the cage's axis in the sensors' plane
    "origin_error": "%",  # origin over difference, less one: the paper's Table 5
    "raw": "mm",  # difference of the sensors' readings
    "solved": "mm",  # difference by the paper's equations
    "solved_radius": "mm",  # mean radius by the paper's equations
    "solved_ratio": "",  # solved over that
    "error": "%",  # raw over solved, less one: the paper's Table 4
    "error_near": "%",
    "error_far": "%",
    "axial_raw": "%",  # share of an axial reading's variance at the cage's frequency
    "axial_solved": "%",  # of the centre's axial motion
    "axial_range": "um",
    "tilt": "deg",  # mean
    "turns": "",  # of the centre about the axis, over those of the cage
    "lost": "%",  # readings out of the sensors' range
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    centre, axis = instrument.of_run(ds)
    radius = np.hypot(centre[:, 1], centre[:, 2])
    apart = float(np.ptp(radius))
    start, _ = instrument.of_run(run.dataset)
    origin = difference(at_plane(centre, axis, PLANE))
    speed = cage_speed(ds, run.numbers)
    return {
        "speed": speed.mean,
        "beyond_theory": speed.mean / speed.nominal - 1.0,
        "by_angles": speed.epicyclic / speed.nominal - 1.0,
        "by_outer": by_outer(run, ds) / speed.nominal - 1.0,
        "drifts": float(element_passes(ds, run.numbers).drifts(radius, beyond=CLEARLY, by=FAR)),
        "mean_radius": float(radius.mean()),
        "difference": apart,
        "whole": difference(start[:, 1:]),
        "ratio": apart / float(radius.mean()),
        "origin": origin,
        "origin_error": origin / apart - 1.0,
        "axial_range": float(np.ptp(centre[:, 0])),
        "tilt": float(metrics.tilt(ds).sel(component="total").values.mean()),
        "turns": metrics.whirl(ds, about="axis").speed_ratio,
        **by_lasers(run.case, ds, abs(speed.mean) / (2.0 * pi)),
    }


def by_outer(run, ds) -> float:
    """Cage speed [rad/s] of outer raceway control at the run's own mean contact angles (Harris and
    Kotzalas, Advanced Concepts of Bearing Technology): w (1 - g cos a_i)/(1 + cos(a_i - a_o))."""
    inner, outer = at_own_angles(ds, run.numbers).angles
    ratio = run.case.bearing.ball_diameter / run.case.bearing.pitch_diameter
    share = (1.0 - ratio * np.cos(inner)) / (1.0 + np.cos(inner - outer))
    return abs(float(ds["inner_speed"].mean())) * share


def by_lasers(case, ds, frequency: float) -> dict[str, float]:
    """What the lasers show, and what the paper's equations make of it; ``frequency`` of the cage
    [Hz]."""
    form = form_of(case)
    shown, solved = seen(case, ds, form)
    away = np.hypot(solved[:, 0], solved[:, 1])
    rate, raw, apart = metrics.sampling_rate(ds), difference(shown[:, :2]), difference(solved)
    return {
        "form": form,
        "raw": raw,
        "solved": apart,
        "solved_radius": float(np.nanmean(away)),
        "solved_ratio": apart / float(np.nanmean(away)),
        "error": raw / apart - 1.0,
        **{f"error_{name}": error_at(case, ds, form, plane) for name, plane in PLANES.items()},
        "axial_raw": line_share(shown[:, 2], frequency, rate),
        "axial_solved": line_share(axial(shown), frequency, rate),
        "lost": float(np.isnan(shown).any(axis=1).mean()),
    }


def form_of(case) -> float:
    """Form error [m] that the case's description gives, as "43 um"; none without one."""
    return parse(case.description, "m", where="description") if case.description else 0.0


def seen(case, ds, form: float, plane: float = PLANE) -> tuple[np.ndarray, np.ndarray]:
    """Readings (n, 5) of the paper's five lasers, and the centre (n, 2) by its equations."""
    setup = setup_of(case.cage, form, plane)
    centre, axis = instrument.of_run(ds)
    face = instrument.run_out(ds, total=form, circle=setup.circle)
    mark = instrument.mark_of_run(ds)
    shown = instrument.readings(centre, axis, setup, face=face, mark=mark, seed=1)
    return shown, instrument.by_tilt_angles(shown, setup)


def setup_of(cage, form: float, plane: float = PLANE) -> LaserSetup:
    """The paper's five lasers around this cage, whose rim has ``LOBES`` of the height ``form``."""
    return LaserSetup(
        radius=0.5 * cage.outside_diameter, half_width=0.5 * cage.width, plane=plane,
        circle=cage.mean_radius, repeatability=NOISE, reach=REACH, spot=SPOT,
        rim=Rim(lobes=LOBES, amplitude=form),
    )  # fmt: skip


def error_at(case, ds, form: float, plane: float) -> float:
    """Deflection error that sensors in another plane have."""
    shown, solved = seen(case, ds, form, plane)
    return difference(shown[:, :2]) / difference(solved) - 1.0


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
