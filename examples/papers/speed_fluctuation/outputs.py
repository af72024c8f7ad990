"""What one run of the 7603025 shows: the numbers that the paper's figures and tables are made of.

Numbers that studies of this folder ask for. Means called "whole" begin at the very start, as the
paper's may; all else is over the whole settled record.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi

import numpy as np

from flexcage import register
from flexcage.results import metrics
from flexcage.results.reductions import main_line
from flexcage.results.statistics import element_passes

KEPT = 1e-3  # s, between the paper's own samples (Table 4: D3PLOT, D3THDT)
TURN = 30e-3  # s, of the ring at 2000 rpm
HARMONICS = 6  # of a ball's turn about the bearing, by which its force may follow its place
MINUTE = 60.0
RING_RPM = 2000.0 * pi / 30.0  # rad/s
APART = 0.1  # of their mean, by which halves of a record are not the same
UNITS = {
    "drifts": "",  # 1 where the cage's distance from the axis differs in the record's halves
    "speed_whole": "rpm",  # of the cage, mean over the whole record, start included
    "speed": "rpm",  # the same, settled
    "swing": "%",  # half the range of the cage's speed over its mean, at the paper's samples
    "swing_all": "%",  # the same of all samples
    "swing_whole": "%",  # at the paper's samples, but for the first, from the start on
    "follows": "%",  # share of the cage speed's variance that is a sine of the ring's frequency
    "main_frequency": "Hz",  # of the strongest line of the cage's speed
    "gain": "%",  # amplitude of that sine over the mean speed
    "ball_gain": "%",  # the same of the balls' mean orbital speed
    "kinematics": "%",  # largest error of the five quantities of Table 5
    "v_inner": "m/s",  # velocity of the inner contact points
    "v_ball": "m/s",  # of balls' centres
    "passes_inner": "",  # of balls over a place of the inner ring in a minute
    "passes_outer": "",
    "distance": "um",  # largest of the cage's centre from the axis
    "distance_whole": "um",
    "stray": "",  # of the orbit from an ellipse of one frequency, over its size (both rms)
    "one_force": "N",  # largest force of one ball on the cage, mean over the balls
    "most_force": "N",  # of any ball
    "ring_distance": "um",  # largest of the inner ring's centre from the axis
    "ring_range": "um",  # of its motion across the axis
    "ripple": "%",  # of a ball's force: rms of what its place does not make, over the mean
    "range_force": "N",  # largest less least force of one ball on the inner ring, mean over balls
    "by_place": "%",  # share of the variance of balls' forces that follows from their places
    "excursion": "um",  # half the range of a ball's place about even spacing, along the pitch
    "spread_speed": "%",  # standard deviation of balls' orbital speeds over their mean
    "lost_contact": "%",  # share of time in which a ball has no inner contact
    "tilt": "deg",  # of the cage, mean
    "slip": "%",  # mean sliding of loaded inner contacts over the rolling speed
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    case, whole = run.case, run.dataset
    ds = metrics.settled(whole, case.output.settle)
    time = ds["time"].values
    every = max(1, round(KEPT / float(np.median(np.diff(time)))))
    omega = ds["cage_omega"].sel(axis="x").values
    from_start = whole["cage_omega"].sel(axis="x").values
    period = case.drive.wave_period or TURN
    amplitude, share = wave_in(omega, time, period)
    force = ds["race_force"].sel(race="inner").transpose("time", "element").values.astype(float)
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    orbital = orbital_speeds(ds)
    balls = orbital.mean(axis=1)
    orbit = metrics.orbit(ds)
    ring = ds["inner_position"].transpose("time", "axis").values[:, 1:]
    pockets = metrics.pocket_peaks(ds).values.astype(float).max(axis=2)
    left, by = rest_of_place(force, psi)
    radius = 0.5 * case.bearing.pitch_diameter
    table_5 = kinematics(ds, case.bearing, float(omega.mean()))
    away = metrics.whirl_radius(ds, about="axis")
    return {
        "drifts": float(element_passes(ds, run.numbers).drifts(away, by=APART)),
        "speed_whole": float(from_start.mean()),
        "speed": float(omega.mean()),
        "swing": half_range(omega[::every]),
        "swing_all": half_range(omega),
        "swing_whole": half_range(from_start[every::every]),
        "follows": share,
        "main_frequency": main_line(omega, float(np.median(np.diff(time))))[0],
        "gain": amplitude / float(omega.mean()),
        "ball_gain": wave_in(balls, time, period)[0] / float(balls.mean()),
        **table_5,
        "distance": float(away.max()),
        "distance_whole": float(metrics.whirl_radius(whole, about="axis").max()),
        "stray": stray(orbit, float(np.median(np.diff(time)))),
        "one_force": float(pockets.max(axis=0).mean()),
        "most_force": float(pockets.max()),
        "ring_distance": float(np.hypot(ring[:, 0], ring[:, 1]).max()),
        "ring_range": float(np.ptp(ring, axis=0).max()),
        "ripple": float(left.std() / force.mean()),
        "range_force": float(np.ptp(force, axis=0).mean()),
        "by_place": by,
        "excursion": radius * excursion(psi),
        "spread_speed": float(orbital.std(axis=1).mean() / balls.mean()),
        "lost_contact": float((force <= 0.0).mean()),
        "tilt": float(metrics.tilt(ds).sel(component="total").values.mean()),
        "slip": sliding(ds, case.bearing),
    }


def orbital_speeds(ds) -> np.ndarray:
    """Speeds of balls about the bearing's axis (n, Z) [rad/s]."""
    place = ds["element_position"].transpose("time", "element", "cyl")
    moving = ds["element_velocity"].transpose("time", "element", "cyl")
    return moving.sel(cyl="psi").values / place.sel(cyl="r").values


def kinematics(ds, bearing, cage: float) -> dict[str, float]:
    """The paper's Table 5 as simulated, and its largest error against equations 6 to 10 at the mean
    speed of the ring."""
    place = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="r").values
    angle = ds["contact_angle"].sel(race="inner").transpose("time", "element").values
    ring = ds["inner_speed"].values
    inner = ring[:, None] * (place - 0.5 * bearing.ball_diameter * np.cos(angle))
    moving = ds["element_velocity"].transpose("time", "element", "cyl").sel(cyl="psi").values
    balls = float(orbital_speeds(ds).mean())
    turns = bearing.ball_count * MINUTE / (2.0 * pi)
    found = {
        "v_inner": float(inner.mean()),
        "v_ball": float(moving.mean()),
        "passes_inner": turns * (float(ring.mean()) - balls),
        "passes_outer": turns * balls,
    }
    theory = analytical(bearing, float(ring.mean()))
    errors = [abs(cage / theory["speed"] - 1.0)]
    errors += [abs(found[key] / theory[key] - 1.0) for key in found]
    return {"kinematics": max(errors), **found}


def analytical(bearing, ring: float = RING_RPM) -> dict[str, float]:
    """Equations 6 to 10 for a ring of a speed [rad/s]; passes in a minute."""
    pitch, gamma = bearing.pitch_diameter, bearing.ball_diameter * cos(bearing.contact_angle)
    cage = 0.5 * ring * (1.0 - gamma / pitch)
    passes = 0.5 * bearing.ball_count * ring * MINUTE / (2.0 * pi)
    return {
        "speed": cage,
        "v_inner": 0.5 * ring * (pitch - gamma),
        "v_ball": 0.5 * cage * pitch,
        "passes_inner": passes * (1.0 + gamma / pitch),
        "passes_outer": passes * (1.0 - gamma / pitch),
    }


def half_range(x: np.ndarray) -> float:
    """Half the range over the mean: the paper's A."""
    return float(0.5 * np.ptp(x) / x.mean())


def wave_in(x: np.ndarray, time: np.ndarray, period: float) -> tuple[float, float]:
    """Amplitude of the sine of a period [s] in ``x`` (n,), by least squares, and its share of the
    variance."""
    turn = 2.0 * pi * time / period
    found, left = _fit(x, [np.cos(turn), np.sin(turn)])
    return float(np.hypot(found[1], found[2])), float(1.0 - left.var() / max(x.var(), 1e-300))


def stray(orbit: np.ndarray, step: float) -> float:
    """Rms distance of an orbit (n, 2) from the ellipse that its strongest line makes, over the rms
    of its motion about its mean: 0 for an ellipse run through at an even pace, 1 for none."""
    shares = [main_line(x, step)[1] for x in orbit.T]
    return float(np.sqrt(max(1.0 - np.average(shares, weights=orbit.var(axis=0)), 0.0)))


def rest_of_place(force: np.ndarray, psi: np.ndarray) -> tuple[np.ndarray, float]:
    """What balls' places ``psi`` (n, Z) do not make of their forces (n, Z), and the share of the
    variance that they make."""
    turn = psi.ravel()
    columns = [f(k * turn) for k in range(1, HARMONICS + 1) for f in (np.cos, np.sin)]
    _, left = _fit(force.ravel(), columns)
    return left, float(1.0 - left.var() / force.var())


def excursion(psi: np.ndarray) -> float:
    """Half the range [rad], on average, of balls' azimuths (n, Z) about even spacing."""
    away = psi - 2.0 * pi / psi.shape[1] * np.arange(psi.shape[1])
    about = np.angle(np.exp(1j * (away - away[:, :1])))
    return float(0.5 * np.ptp(about, axis=1).mean())


def sliding(ds, bearing) -> float:
    """Mean sliding speed of inner contacts that bear more than the mean, over the velocity of
    balls' centres."""
    force = ds["race_force"].sel(race="inner").transpose("time", "element").values
    slip = np.abs(ds["race_slip"].sel(race="inner").transpose("time", "element", ...).values)
    slip = slip.reshape(*force.shape, -1).max(axis=2)
    moving = ds["element_velocity"].transpose("time", "element", "cyl").sel(cyl="psi").values
    loaded = force > force.mean()
    return float(slip[loaded].mean() / moving[loaded].mean())


def _fit(x: np.ndarray, columns: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of a constant and of ``columns`` that fit ``x``, and what is left."""
    table = np.stack([np.ones_like(x), *columns], axis=1)
    found, *_ = np.linalg.lstsq(table, x, rcond=None)
    return found, x - table @ found


register.outputs(evaluate, UNITS)
