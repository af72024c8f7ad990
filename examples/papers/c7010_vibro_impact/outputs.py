"""What one run of the 7010C shows: the numbers that the paper's figures and text are made of.

Numbers that studies of this folder ask for. All are over the whole settled record; of a run that
accelerates, that is nearly all of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import radians

import numpy as np

from flexcage import register
from flexcage.results import metrics
from flexcage.results.reductions import main_line, mean_frequency

LOW_PASS = 2e3  # Hz, of the cage's speed beside the raw samples
SECTOR = radians(30.0)  # to either side of the load, and of the place opposite
FORCED = (0, 6, 12)  # balls whose forces' spectra are averaged
UNITS = {
    "speed": "rpm",  # of the cage, mean
    "slip": "%",  # of the cage against pure rolling at the nominal angle
    "slip_ripple": "%",  # standard deviation of that over time
    "peak": "N",  # largest force of a ball on the inner ring
    "one_peak": "N",  # the same of one ball, mean over all
    "load_force": "N",  # mean inner force within 30 degrees of the load
    "off_force": "N",  # and opposite
    "gaps": "%",  # share of time without inner contact of balls on the half off the load
    "frequency": "Hz",  # centre of gravity of the spectrum of a ball's force
    "deviation": "%",  # the paper's ratio: of the speed of the cage's mass centre
    "deviation_slow": "%",  # the same below 2 kHz
    "line": "%",  # share of the strongest line in the variance of the orbit
    "circle": "",  # largest less least radius of the orbit about its mean place, over the mean
    "turns": "",  # of the centre about the axis, over those of the cage
    "radius": "um",  # of the orbit about its mean place
    "distance": "um",  # largest of the centre from the axis
    "inner_load": "deg",  # contact angle within 30 degrees of the load
    "outer_load": "deg",
    "inner_off": "deg",  # and opposite
    "outer_off": "deg",
    "axial_range": "um",  # of the inner ring's axial motion
    "axial_rough": "um",  # rms of that motion about its own mean over a turn of the ring
    "axial_rate": "m/s",  # axial motion over the time it takes
    "largest_pocket_force": "N",  # largest on the cage
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    case = run.case
    assert case.cage.unbalance == 0.0  # so that the frame's origin is the mass centre
    ds = metrics.settled(run.dataset, case.output.settle)
    time = ds["time"].values
    step = float(np.median(np.diff(time)))
    force = ds["race_force"].transpose("time", "element", "race").values.astype(float)
    inner, outer = force[..., 0], force[..., 1]
    angle = ds["contact_angle"].transpose("time", "element", "race").values
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    towards = np.cos(psi - case.load.direction)
    near, far = towards > np.cos(SECTOR), towards < -np.cos(SECTOR)
    omega = ds["cage_omega"].sel(axis="x").values
    share = run.numbers.nominal.kinematics(1.0).cage_speed
    slip = 1.0 - omega / (share * ds["inner_speed"].values)
    orbit, radius = metrics.orbit(ds), metrics.whirl_radius(ds)
    axial = ds["inner_position"].sel(axis="x").values
    shares = [main_line(x, step)[1] for x in orbit.T]
    return {
        "speed": float(omega.mean()),
        "slip": float(slip.mean()),
        "slip_ripple": float(slip.std()),
        "peak": float(inner.max()),
        "one_peak": float(inner.max(axis=0).mean()),
        "load_force": _mean(inner, near),
        "off_force": _mean(inner, far),
        "gaps": float((inner <= 0.0)[towards < 0.0].mean()),
        "frequency": float(np.mean([mean_frequency(inner[:, b], step) for b in FORCED])),
        "deviation": ratio(metrics.centre_speed(ds)),
        "deviation_slow": ratio(metrics.centre_speed(ds, low_pass=LOW_PASS)),
        "line": float(np.average(shares, weights=orbit.var(axis=0))),
        "circle": float(np.ptp(radius) / radius.mean()),
        "turns": metrics.whirl(ds, about="axis").speed_ratio,
        "radius": float(radius.mean()),
        "distance": float(metrics.whirl_radius(ds, about="axis").max()),
        "inner_load": _mean(angle[..., 0], near & (inner > 0.0)),
        "outer_load": _mean(angle[..., 1], near & (outer > 0.0)),
        "inner_off": _mean(angle[..., 0], far & (inner > 0.0)),
        "outer_off": _mean(angle[..., 1], far & (outer > 0.0)),
        "axial_range": float(np.ptp(axial)),
        "axial_rough": rough(axial, time, float(ds["inner_speed"].values.mean())),
        "axial_rate": float(np.ptp(axial) / np.ptp(time)),
        "largest_pocket_force": float(metrics.pocket_peaks(ds).values.max()),
    }


def ratio(speed: np.ndarray) -> float:
    """The paper's deviation ratio of a speed (n,): standard deviation over mean."""
    return float(speed.std(ddof=1) / speed.mean())


def rough(axial: np.ndarray, time: np.ndarray, ring: float) -> float:
    """Rms of a motion (n,) about its running mean over a turn of the ring (speed in rad/s)."""
    window = max(3, round(2.0 * np.pi / abs(ring) / float(np.median(np.diff(time)))))
    if len(axial) <= 2 * window:
        return float("nan")
    mean = np.convolve(axial, np.full(window, 1.0 / window), "valid")
    first = (window - 1) // 2
    return float((axial[first : first + len(mean)] - mean).std())


def _mean(values: np.ndarray, where: np.ndarray) -> float:
    """Mean over the samples ``where`` of (time, ball); NaN if there are none."""
    return float(values[where].mean()) if where.any() else float("nan")


register.outputs(evaluate, UNITS)
