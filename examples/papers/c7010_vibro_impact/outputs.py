"""What one run of the 7010C shows: the numbers that the paper's figures and text are made of.

Numbers that studies of this folder ask for. All are over the whole settled record; of a run that
accelerates, that is nearly all of it. Orbit and speed are those of the cage's mass centre, which an
unbalance puts beside the centre of its pockets.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import radians

import numpy as np

import flexcage
from flexcage import register
from flexcage.results import metrics
from flexcage.results.lowpass import butterworth, low_passed_both_ways
from flexcage.results.reductions import main_line, mean_frequency
from flexcage.results.statistics import element_passes

LOW_PASS = 2e3  # Hz, of the cage's speed beside the raw samples
SECTOR = radians(30.0)  # to either side of the load, and of the place opposite
FORCED = (0, 6, 12)  # balls whose forces' spectra are averaged
APART = 0.1  # of their mean, by which halves of a record are not the same
PARTS = 12  # of the way round an orbit, in each of which its boundary is its largest radius
UNITS = {
    "drifts": "",  # 1 where the whirl of the record's halves differs
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
    "boundary": "",  # largest less least radius of the orbit's boundary, over the mean
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
    "static_force": "N",  # of the heaviest ball in equilibrium (equations 8 to 12)
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    axial = ds["inner_position"].sel(axis="x").values
    time = ds["time"].values
    return {
        **cage_motion(ds, run),
        **balls(ds, run.case.load.direction),
        "axial_range": float(np.ptp(axial)),
        "axial_rough": rough(axial, time, float(ds["inner_speed"].values.mean())),
        "axial_rate": float(np.ptp(axial) / np.ptp(time)),
        "largest_pocket_force": float(metrics.pocket_peaks(ds).values.max()),
        "static_force": float(flexcage.solve_static(run.case).elements.force[:, 0].max()),
    }


def cage_motion(ds, run) -> dict[str, float]:
    """Speed and slip of the cage, and the motion of its mass centre."""
    step = float(np.median(np.diff(ds["time"].values)))
    omega = ds["cage_omega"].sel(axis="x").values
    slip = 1.0 - omega / (run.numbers.nominal.kinematics(1.0).cage_speed * ds["inner_speed"].values)
    orbit, velocity = mass_centre(ds, run)
    about = orbit - orbit.mean(axis=0)
    radius = np.linalg.norm(about, axis=1)
    shares = [main_line(x, step)[1] for x in orbit.T]
    return {
        "drifts": float(element_passes(ds, run.numbers).drifts(radius, by=APART)),
        "speed": float(omega.mean()),
        "slip": float(slip.mean()),
        "slip_ripple": float(slip.std()),
        "deviation": ratio(np.linalg.norm(velocity, axis=1)),
        "deviation_slow": ratio(np.linalg.norm(slow(velocity, step), axis=1)),
        "line": float(np.average(shares, weights=orbit.var(axis=0))),
        "boundary": uneven_boundary(about),
        "turns": metrics.whirl(ds, about="axis").speed_ratio,
        "radius": float(radius.mean()),
        "distance": float(np.linalg.norm(orbit, axis=1).max()),
    }


def balls(ds, direction: float) -> dict[str, float]:
    """Forces and contact angles of balls at the load and opposite."""
    step = float(np.median(np.diff(ds["time"].values)))
    force = ds["race_force"].transpose("time", "element", "race").values.astype(float)
    inner, outer = force[..., 0], force[..., 1]
    angle = ds["contact_angle"].transpose("time", "element", "race").values
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    towards = np.cos(psi - direction)
    near, far = towards > np.cos(SECTOR), towards < -np.cos(SECTOR)
    return {
        "peak": float(inner.max()),
        "one_peak": float(inner.max(axis=0).mean()),
        "load_force": _mean(inner, near),
        "off_force": _mean(inner, far),
        "gaps": float((inner <= 0.0)[towards < 0.0].mean()),
        "frequency": float(np.mean([mean_frequency(inner[:, b], step) for b in FORCED])),
        "inner_load": _mean(angle[..., 0], near & (inner > 0.0)),
        "outer_load": _mean(angle[..., 1], near & (outer > 0.0)),
        "inner_off": _mean(angle[..., 0], far & (inner > 0.0)),
        "outer_off": _mean(angle[..., 1], far & (outer > 0.0)),
    }


def mass_centre(ds, run) -> tuple[np.ndarray, np.ndarray]:
    """Place across the axis (n, 2) [m] and velocity (n, 3) [m/s] of the cage's mass centre."""
    cage = run.case.cage
    away = cage.unbalance / float(run.summary["cage_mass"])
    at = metrics.carrier_angle(ds) + cage.unbalance_phase
    omega = ds["cage_omega"].sel(axis="x").values
    velocity = ds["cage_velocity"].transpose("time", "axis").values.copy()
    velocity[:, 1] -= away * omega * np.sin(at)
    velocity[:, 2] += away * omega * np.cos(at)
    return metrics.orbit(ds) + away * np.stack([np.cos(at), np.sin(at)], axis=1), velocity


def slow(velocity: np.ndarray, step: float) -> np.ndarray:
    """A velocity (n, 3) below ``LOW_PASS``."""
    return low_passed_both_ways(butterworth(2.0 * LOW_PASS * step), velocity)


def uneven_boundary(about: np.ndarray) -> float:
    """Largest less least radius over the mean of the boundary of an orbit (n, 2) about its mean
    place: its largest radius in each of ``PARTS``, 0 where it never is. A circle has 0, an ellipse
    of twice the length 0.6, a line 2 or more."""
    part = np.floor(np.arctan2(about[:, 1], about[:, 0]) / (2.0 * np.pi) * PARTS).astype(int)
    radius = np.linalg.norm(about, axis=1)
    reach = np.array([radius[part % PARTS == k].max(initial=0.0) for k in range(PARTS)])
    return float(np.ptp(reach) / reach.mean())


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
