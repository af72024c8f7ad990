"""What one run of the 7010C's cage is, and what lasers would show of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from ball_claim import by_parts, estimate

import flexcage
from flexcage.results import instrument, metrics
from flexcage.results.statistics import element_passes
from flexcage.study.verdicts import Estimate

PLANE = 9e-3  # assumption: axial distance of the radial sensors, which the paper does not give
PLANES = (5e-3, 8.2e-3, 9e-3, 9.8e-3)  # over which it is swept
RADII = (-5e-3, -2e-3, 2e-3, 5e-3)  # m, by which the radius that the correction takes is off


@dataclass(frozen=True)
class Found:
    """What one run's cage does, and what lasers would show of it [rad/s, m, 1]."""

    speed: Estimate
    beyond_theory: Estimate  # share by which it exceeds the paper's equation 18: 15 deg both races
    mean: Estimate  # whirl radius about the axis
    difference: Estimate  # largest less least of it
    ratio: Estimate
    turns: float  # of the centre about the axis, over those of the cage
    axial: Estimate  # range of the centre's axial motion
    tilt: Estimate  # mean, rad
    deviation: Estimate  # of the centre's speed over its mean, low pass 2 kHz
    raw: Estimate  # difference at the sensors' plane
    solved: Estimate  # difference of the centre by the paper's equation
    error: Estimate  # raw over solved, less one
    axial_raw: Estimate  # share of the axial reading's variance at the cage's frequency
    axial_solved: Estimate
    errors: tuple[float, ...]  # the error over the whole record, for ``PLANES``
    by_radius: tuple[float, ...]  # what a radius wrong by ``RADII`` changes in the solved one
    lost: float  # share of readings out of the sensors' range


def evaluate(run: flexcage.Run) -> Found:
    """Figures of one run, its settled part."""
    case, ds = run.case, metrics.settled(run.dataset, run.case.output.settle)
    speed, windows = metrics.cage_speed(ds, run.numbers), element_passes(ds, run.numbers)
    omega, radius = ds["cage_omega"].sel(axis="x").values, metrics.whirl_radius(ds, about="axis")
    centre, axis = instrument.of_run(ds)
    setup = instrument.LaserSetup(
        radius=0.5 * case.cage.outside_diameter, half_width=0.5 * case.cage.width, plane=PLANE,
        circle=case.cage.mean_radius, repeatability=0.02e-6, reach=3e-3,
    )  # fmt: skip
    shown = instrument.readings(centre, axis, setup, seed=1)
    full, _ = instrument.invert(shown, setup)
    solved = instrument.by_tilt_angles(shown, setup)
    turns = abs(speed.mean) / (2.0 * np.pi)
    rate, n = metrics.sampling_rate(ds), len(radius)
    mean = windows.mean(omega)
    return Found(
        speed=estimate(mean),
        beyond_theory=Estimate(mean.value / speed.nominal - 1.0, mean.margin / speed.nominal),
        mean=estimate(windows.mean(radius)),
        difference=by_parts(lambda k: float(np.ptp(radius[k])), n),
        ratio=by_parts(lambda k: float(np.ptp(radius[k]) / radius[k].mean()), n),
        turns=metrics.whirl(ds, about="axis").speed_ratio,
        axial=by_parts(lambda k: float(np.ptp(centre[k, 0])), n),
        tilt=estimate(windows.mean(metrics.tilt(ds).sel(component="total").values)),
        deviation=estimate(windows.deviation(metrics.centre_speed(ds, low_pass=2e3))),
        raw=by_parts(lambda k: difference(shown[k, :2]), n),
        solved=by_parts(lambda k: difference(solved[k]), n),
        error=by_parts(lambda k: difference(shown[k, :2]) / difference(solved[k]) - 1.0, n),
        axial_raw=by_parts(lambda k: _share(shown[k, 2], turns, rate), n),
        axial_solved=by_parts(lambda k: _share(full[k, 0], turns, rate), n),
        errors=tuple(_error(centre, axis, replace(setup, plane=p)) for p in PLANES),
        by_radius=tuple(
            difference(instrument.by_tilt_angles(shown, replace(setup, radius=setup.radius + r)))
            - difference(solved)
            for r in RADII
        ),
        lost=float(np.isnan(shown).any(axis=1).mean()),
    )


def _error(centre: np.ndarray, axis: np.ndarray, setup: instrument.LaserSetup) -> float:
    """Deflection error that sensors at another plane have."""
    shown = instrument.readings(centre, axis, setup, seed=1)
    return difference(shown[:, :2]) / difference(instrument.by_tilt_angles(shown, setup)) - 1.0


def difference(yz: np.ndarray) -> float:
    """Largest less least distance (n, 2) from the axis, of readings that are there."""
    away = np.hypot(yz[:, 0], yz[:, 1])
    return float(np.nanmax(away) - np.nanmin(away))


def _share(values: np.ndarray, frequency: float, rate: float) -> float:
    """Share of the variance within a tenth of a frequency."""
    values = np.where(np.isnan(values), np.nanmean(values), values)
    power = np.abs(np.fft.rfft(values - values.mean())) ** 2
    at = np.fft.rfftfreq(len(values), 1.0 / rate)
    near = np.abs(at - frequency) <= 0.1 * frequency
    return float(power[near].sum() / power.sum()) if power.sum() > 0.0 else 0.0
