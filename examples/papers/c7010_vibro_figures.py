"""What one run of the 7010C under vibro-impacts shows: figures and halves of their intervals."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
from ball_claim import by_parts, estimate

import flexcage
from flexcage.bearings.ball.slip import slip_ratio
from flexcage.results import metrics
from flexcage.results.reductions import main_line, mean_frequency
from flexcage.results.statistics import Windows, element_passes
from flexcage.study.verdicts import Estimate

LOW_PASS = 2e3  # Hz, of the cage's speed beside the raw 20 kHz
LINE = 0.5  # an orbit is regular if its strongest line has this share of its variance


@dataclass(frozen=True)
class Figures:
    """One run, its settled part over whole turns of the cage; SI."""

    peak: Estimate  # largest inner contact force of a ball pass
    empty_loaded: Estimate  # share of time without inner contact, balls on the load's side
    empty_opposite: Estimate  # the same on the other side
    deviation: Estimate  # of the cage centre's speed over its mean, low pass
    deviation_raw: Estimate
    radius: Estimate  # of the orbit about its mean
    displacement: Estimate  # of the cage's centre from the axis
    line: Estimate  # share of the strongest line in the orbit's variance, 0 to 1
    circle: Estimate  # (largest - least)/mean of the radius about the orbit's mean
    inner_angle: Estimate  # of loaded balls
    outer_angle: Estimate
    axial: Estimate  # inner ring's displacement
    axial_range: Estimate
    axial_rate: Estimate  # range over the time it took
    ball_ripple: Estimate  # of the loaded balls' slip ratio: its standard deviation
    cage_slip: Estimate
    frequency: Estimate  # centre of gravity of the spectrum of the forces of a ball
    pocket_peak: Estimate  # largest force of a ball pass on the cage
    stress: Estimate | None  # largest of a ball pass, at waists and rims


def evaluate(run: flexcage.Run) -> Figures:
    """Figures of a run."""
    ds = metrics.whole_revolutions(metrics.settled(run.dataset, run.case.output.settle))
    numbers = run.numbers
    windows = element_passes(ds, numbers)
    time = ds["time"].values
    step = float(np.median(np.diff(time)))
    force = ds["race_force"].transpose("time", "element", "race").values.astype(float)
    inner = force[..., 0]
    towards = _towards_load(run, ds)
    orbit = metrics.orbit(ds)
    radius = metrics.whirl_radius(ds)
    axial = ds["inner_position"].sel(axis="x").values
    slip = slip_ratio(ds, numbers, nominal=True).values
    angle = ds["contact_angle"].transpose("time", "element", "race").values
    loaded = metrics.loaded_zone(ds).transpose("time", "element").values
    pockets = ds["pocket_force"].transpose("time", "pocket", "face").values.astype(float)
    omega = ds["cage_omega"].sel(axis="x").values
    speed = metrics.cage_speed(ds, numbers)
    key = "stress_root_pass_peak"
    stressed = run.summary.row(key) if key in run.summary else None
    return Figures(
        peak=estimate(windows.peak(inner.max(axis=1))),
        empty_loaded=_share(windows, inner <= 0.0, towards),
        empty_opposite=_share(windows, inner <= 0.0, ~towards),
        deviation=estimate(windows.deviation(metrics.centre_speed(ds, low_pass=LOW_PASS))),
        deviation_raw=estimate(windows.deviation(metrics.centre_speed(ds))),
        radius=estimate(windows.mean(radius)),
        displacement=estimate(windows.mean(metrics.whirl_radius(ds, about="axis"))),
        line=by_parts(lambda k: _line(orbit[k], step), len(time)),
        circle=by_parts(lambda k: float(np.ptp(radius[k]) / radius[k].mean()), len(time)),
        inner_angle=_mean(windows, angle[..., 0], loaded & (inner > 0.0)),
        outer_angle=_mean(windows, angle[..., 1], loaded & (force[..., 1] > 0.0)),
        axial=estimate(windows.mean(axial)),
        axial_range=by_parts(lambda k: float(np.ptp(axial[k])), len(time)),
        axial_rate=by_parts(lambda k: float(np.ptp(axial[k]) / np.ptp(time[k])), len(time)),
        ball_ripple=_spread(windows, slip, loaded),
        cage_slip=Estimate(speed.nominal_slip, windows.mean(omega).margin / speed.nominal),
        frequency=by_parts(
            lambda k: float(np.mean([mean_frequency(inner[k, b], step) for b in (0, 6, 12)])),
            len(time),
        ),
        pocket_peak=estimate(windows.peak(pockets.max(axis=(1, 2)))),
        stress=Estimate(float(stressed.value), stressed.margin or nan) if stressed else None,
    )  # fmt: skip


def by_azimuth(run: flexcage.Run, count: int = 18) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middles of ``count`` sectors from the load's line [rad], mean inner force [N] and mean inner
    contact angle [rad] (NaN: never touched) of balls that pass them."""
    ds = metrics.whole_revolutions(metrics.settled(run.dataset, run.case.output.settle))
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    at = np.round((psi - run.case.load.direction) * count / (2.0 * np.pi)).astype(int) % count
    force = ds["race_force"].sel(race="inner").transpose("time", "element").values.astype(float)
    angle = ds["contact_angle"].sel(race="inner").transpose("time", "element").values
    mean = np.array([force[at == k].mean() for k in range(count)])
    touching = [(at == k) & (force > 0.0) for k in range(count)]
    angles = np.array([angle[m].mean() if m.any() else nan for m in touching])
    return 2.0 * np.pi * np.arange(count) / count, mean, angles


def _towards_load(run: flexcage.Run, ds) -> np.ndarray:
    """(time, ball): is the ball on the half that a radial load presses on?"""
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    return np.cos(psi - run.case.load.direction) > 0.0


def _line(orbit: np.ndarray, step: float) -> float:
    """Share of the strongest line of both components in their variance."""
    shares = [main_line(x, step)[1] for x in orbit.T]
    return float(np.average(shares, weights=orbit.var(axis=0)))


def _share(windows: Windows, what: np.ndarray, where: np.ndarray) -> Estimate:
    """Share of the samples ``where`` (time, ball) in which ``what`` is true."""
    return estimate(windows.ratio((what & where).sum(axis=1), where.sum(axis=1)))


def _mean(windows: Windows, values: np.ndarray, where: np.ndarray) -> Estimate:
    """Mean of ``values`` (time, ball) over the samples ``where``."""
    return estimate(windows.ratio(np.where(where, values, 0.0).sum(axis=1), where.sum(axis=1)))


def _spread(windows: Windows, values: np.ndarray, where: np.ndarray) -> Estimate:
    """Standard deviation of ``values`` (time, ball) over the samples ``where``."""
    mean = values[where].mean()
    square = _mean(windows, (values - mean) ** 2, where)
    root = float(np.sqrt(square.value))
    return Estimate(root, 0.5 * square.margin / root if root else nan)
