"""What one run of the 7603025 under a fluctuating speed shows: figures and their intervals."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan, pi

import numpy as np
from ball_claim import by_parts, estimate

import flexcage
from flexcage.results import metrics
from flexcage.results.reductions import main_line
from flexcage.results.statistics import element_passes
from flexcage.study.verdicts import Estimate

KEPT = 1e-3  # s, between the paper's own samples
HARMONICS = 6  # of a ball's turn about the bearing, by which its force may follow its place


@dataclass(frozen=True)
class Figures:
    """One run, its settled part; SI."""

    speed: Estimate  # of the cage, mean
    swing: Estimate  # half the range of the cage's speed over its mean, at the paper's samples
    swing_raw: Estimate  # the same of all samples
    follows: Estimate  # share of the cage speed's variance that is a sine of the ring's frequency
    gain: Estimate  # amplitude of that sine over the mean speed
    ball_gain: Estimate  # the same of the balls' mean orbital speed
    excursion: Estimate  # half the range of the balls' places about even spacing, along the pitch
    distance: Estimate  # largest of the cage's centre from the axis
    orbit_line: Estimate  # share of the strongest line in its orbit's variance, 0 to 1
    pocket_peak: Estimate  # largest force of a ball pass on the cage
    pocket_most: Estimate  # largest force on the cage
    ring_range: Estimate  # of the inner ring's centre across the axis
    ripple: Estimate  # of the largest inner contact force: standard deviation over mean
    by_place: Estimate  # share of a ball's force's variance that follows from where it is
    force_least: Estimate  # inner contact force of any ball
    force_most: Estimate
    cage_slip: Estimate
    stress: Estimate | None  # largest of a ball pass, at waists and rims


def evaluate(run: flexcage.Run, period: float) -> Figures:
    """Figures of a run whose ring's speed has waves of this ``period`` [s]."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    windows = element_passes(ds, run.numbers)
    time = ds["time"].values
    step = float(np.median(np.diff(time)))
    every = round(KEPT / step)
    omega = ds["cage_omega"].sel(axis="x").values
    force = ds["race_force"].sel(race="inner").transpose("time", "element").values.astype(float)
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    balls = ds["element_velocity"].transpose("time", "element", "cyl").sel(cyl="psi").values
    radius = 0.5 * run.case.bearing.pitch_diameter
    balls = (balls / radius).mean(axis=1)
    orbit = metrics.orbit(ds)
    away = metrics.whirl_radius(ds, about="axis")
    ring = ds["inner_position"].transpose("time", "axis").values[:, 1:]
    pockets = metrics.pocket_peaks(ds).transpose("time", "pocket", "face").values.astype(float)
    slip = metrics.cage_speed(ds, run.numbers)
    key = "stress_root_pass_peak"
    stressed = run.summary.row(key) if key in run.summary else None

    def of_parts(figure) -> Estimate:
        return by_parts(figure, len(time))

    speed = of_parts(lambda k: float(omega[k].mean()))
    return Figures(
        speed=speed,
        swing=of_parts(lambda k: half_range(omega[k][::every])),
        swing_raw=of_parts(lambda k: half_range(omega[k])),
        follows=of_parts(lambda k: wave_in(omega[k], time[k], period)[1]),
        gain=of_parts(lambda k: wave_in(omega[k], time[k], period)[0] / omega[k].mean()),
        ball_gain=of_parts(lambda k: wave_in(balls[k], time[k], period)[0] / balls[k].mean()),
        excursion=of_parts(lambda k: radius * excursion(psi[k])),
        distance=of_parts(lambda k: float(away[k].max())),
        orbit_line=of_parts(lambda k: _line(orbit[k], step)),
        pocket_peak=estimate(windows.peak(pockets.max(axis=(1, 2)))),
        pocket_most=of_parts(lambda k: float(pockets[k].max())),
        ring_range=of_parts(lambda k: float(np.ptp(ring[k], axis=0).max())),
        ripple=estimate(windows.deviation(force.max(axis=1))),
        by_place=of_parts(lambda k: place_in(force[k], psi[k])),
        force_least=of_parts(lambda k: float(force[k].min())),
        force_most=of_parts(lambda k: float(force[k].max())),
        cage_slip=Estimate(slip.nominal_slip, speed.margin / slip.nominal),
        stress=Estimate(float(stressed.value), stressed.margin or nan) if stressed else None,
    )  # fmt: skip


def half_range(x: np.ndarray) -> float:
    """Half the range over the mean."""
    return float(0.5 * np.ptp(x) / x.mean())


def wave_in(x: np.ndarray, time: np.ndarray, period: float) -> tuple[float, float]:
    """Amplitude of the sine of a period [s] in ``x`` (n,), by least squares, and its share of the
    variance."""
    turn = 2.0 * pi * time / period
    return _fit(x, [np.cos(turn), np.sin(turn)])


def excursion(psi: np.ndarray) -> float:
    """Half the range [rad], on average, of balls' azimuths (n, Z) about even spacing."""
    away = psi - 2.0 * pi / psi.shape[1] * np.arange(psi.shape[1])
    about = np.angle(np.exp(1j * (away - away[:, :1])))
    return float(0.5 * np.ptp(about, axis=1).mean())


def place_in(force: np.ndarray, psi: np.ndarray) -> float:
    """Share of the variance of balls' forces (n, Z) that their places ``psi`` (n, Z) make."""
    turn = psi.ravel()
    columns = [f(k * turn) for k in range(1, HARMONICS + 1) for f in (np.cos, np.sin)]
    return _fit(force.ravel(), columns)[1]


def _fit(x: np.ndarray, columns: list[np.ndarray]) -> tuple[float, float]:
    """Length of the first two coefficients of ``columns`` that fit ``x``, and the share of its
    variance that all of them take."""
    table = np.stack([np.ones_like(x), *columns], axis=1)
    found, *_ = np.linalg.lstsq(table, x, rcond=None)
    left = x - table @ found
    return float(np.hypot(found[1], found[2])), float(1.0 - left.var() / x.var())


def _line(orbit: np.ndarray, step: float) -> float:
    """Share of the strongest line of both components in their variance."""
    shares = [main_line(x, step)[1] for x in orbit.T]
    return float(np.average(shares, weights=orbit.var(axis=0)))
