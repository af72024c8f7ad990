"""How long a ball is over a spall, and the two shocks of it, against length over speed.

Hertz's compliance, the speeds without slip and where edges are felt are computed here, from
dimensions alone.
"""

from __future__ import annotations

from functools import cache
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.signal import butter, find_peaks, hilbert, sosfiltfilt
from scipy.special import ellipe, ellipk

import flexcage
from flexcage.case import load_case
from flexcage.spec import Accelerometer

CASE = Path(__file__).parents[2] / "examples" / "6205_signals.toml"
PITCH, BALL, CLEARANCE, MODULUS = 38.5e-3, 7.938e-3, 10e-6, 206e9 / (1 - 0.3**2)
GROOVE = {"inner": 4.0881e-3, "outer": 4.1675e-3}
AHEAD = radians(12.0)  # of the most loaded ball at the start, to the spall's middle
SIDE = {"inner": -1.0, "outer": 1.0}  # of the ball that the race lies on
RADIUS = {ring: 0.5 * (PITCH + s * BALL) + s * CLEARANCE / 4 for ring, s in SIDE.items()}


def hertz(ring):
    """Force over penetration^1.5 (Harris, Rolling Bearing Analysis, 6)."""
    across, along = 1 / (BALL / 2) - 1 / GROOVE[ring], 1 / (BALL / 2) - SIDE[ring] / RADIUS[ring]
    total = across + along

    def excess(kappa):
        m = 1 - kappa**-2
        return ((kappa**2 + 1) * ellipe(m) - 2 * ellipk(m)) / ((kappa**2 - 1) * ellipe(m)) - (
            along - across
        ) / total

    kappa = brentq(excess, 1.001, 100.0)
    m = 1 - kappa**-2
    star = 2 * ellipk(m) / pi * (pi / (2 * kappa**2 * ellipe(m))) ** (1 / 3)
    return (star * total / 2) ** -1.5 * 2 * total * (0.5 * MODULUS) / 3


def effective(ring):
    """Radius [m] of a ball that rolls along a race, against a plane."""
    return 1 / (2 / BALL - SIDE[ring] / RADIUS[ring])


def half_width(ring):
    """Of a line contact of 1 GPa [m]: where an edge is felt."""
    return 4e9 * effective(ring) / MODULUS


def contact_speed(ring, rpm):
    """Of a ball's contact along a race [m/s], without slip."""
    return 0.5 * rpm * pi / 30 * (1 - SIDE[ring] * BALL / PITCH) * RADIUS[ring]


@cache
def passed(ring, rpm, length, law):
    """A run of the one pass of ball 0, and its contact's way from the spall's middle [m]."""
    azimuth = AHEAD if ring == "outer" else -AHEAD  # a ball falls back on the inner ring
    way = RADIUS[ring] * AHEAD + 0.5 * length * 1e-3 + 1.5e-3
    case = load_case(CASE, overrides={
        "bearing.outer_spall.length": "0 mm", f"bearing.{ring}_spall.length": f"{length} mm",
        f"bearing.{ring}_spall.azimuth": f"{azimuth} rad", f"bearing.{ring}_spall.depth": "50 um",
        "drive.speed": f"{rpm} rpm", "solver.duration": f"{way / contact_speed(ring, rpm)} s",
        "output.rate": "1 MHz", "output.vibration_rate": "1 MHz", "output.settle": 0.0,
        "contacts.race.normal.law": law,
    })  # fmt: skip
    run = flexcage.simulate(case, stress=False)
    own, ball = run.dataset[f"{ring}_position"].values, run.dataset["element_position"].values[:, 0]
    psi = ball[:, 2]
    y, z = ball[:, 1] * np.cos(psi) - own[:, 1], ball[:, 1] * np.sin(psi) - own[:, 2]
    turned = run.dataset["inner_angle"].values if ring == "inner" else 0.0
    off = np.unwrap(np.arctan2(z, y)) - turned - azimuth
    return run, SIDE[ring] * off * RADIUS[ring], np.hypot(y, z)


def near(length):
    """Speeds and lengths of quick tests, and all others marked as slow."""
    quick = {("outer", 1500, 1.0), ("outer", 6000, 2.0), ("inner", 1500, 2.0), ("inner", 6000, 0.5)}
    return [
        pytest.param(ring, rpm, mm, marks=[] if (ring, rpm, mm) in quick else pytest.mark.slow)
        for ring in ("outer", "inner") for rpm in (750, 1500, 3000, 6000) for mm in length
    ]  # fmt: skip


@pytest.mark.parametrize(("ring", "rpm", "length"), near((0.5, 1.0, 2.0, 3.0)))
def test_a_ball_is_over_a_spall_for_its_length_over_the_speed_of_its_contact(ring, rpm, length):
    """Of elastic contacts: from how far the ball stands out and how hard it presses follows how far
    it has sunk. At the edge itself that is b^2/(12 R), 0.1 um, as its contact is 2 b wide: it has
    sunk by more for the length over the speed."""
    run, x, radius = passed(ring, rpm, length, "elastic")
    t, force = run.dataset["time"].values, run.dataset["race_force"].sel(race=ring).values[:, 0]
    pressed = (force / hertz(ring)) ** (2 / 3)
    before = x < -0.5e-3 * length - 0.4e-3
    sunk = SIDE[ring] * radius - pressed
    sunk -= sunk[before].mean()
    assert np.abs(sunk[before]).max() < 2e-9
    over = np.flatnonzero(sunk > half_width(ring) ** 2 / (12 * effective(ring)))
    took, way = t[over[-1]] - t[over[0]], 1e-3 * length
    assert took == pytest.approx(way / contact_speed(ring, rpm), rel=0.05)
    assert x[over[-1]] - x[over[0]] == pytest.approx(way, rel=0.03)  # by the ball's own speed


def shocks(rpm, length):
    """Instants [s] at which the signal's envelope has its first peak over an outer race's spall,
    and the highest in its last third; ways [m] from the middle at which it has them, and at which
    the race lets go of the ball and bears it again; the run."""
    run, x, _ = passed("outer", rpm, length, "restitution")
    signal = run.signals_of([Accelerometer(name="a")])["a"]
    sections = butter(4, (15e3, 80e3), "bandpass", fs=1e6, output="sos")
    height = np.abs(hilbert(sosfiltfilt(sections, signal.values)))
    t, time = signal["time"].values, run.dataset["time"].values
    at = np.interp(t, time, x)
    height[np.abs(at) > 0.5e-3 * length] = 0.0
    peaks, _ = find_peaks(height, prominence=0.02 * height.max())
    found = [peaks[0], np.where(at > length * 1e-3 / 6, height, 0.0).argmax()]
    force = run.dataset["race_force"].sel(race="outer").values[:, 0]
    free = x[(force <= 0.0) & (np.abs(x) < 0.5e-3 * length)]
    return t[found], at[found], free[[0, -1]], run


@pytest.mark.parametrize("rpm", [1500, pytest.param(750, marks=pytest.mark.slow)])
def test_the_two_shocks_of_a_long_spall_are_apart_by_its_length_over_speed(rpm):
    """One where the race lets go of the ball, and one where it bears it again: both come from the
    edges by sqrt(2 R d - b^2/3), over which the ball sinks by the d that it was pressed in by both
    races and the inner ring went after it. 1 mm more parts them by 1 mm over the ball's speed."""
    apart, way = [], []
    for length in (2.0, 3.0):
        times, ways, free, run = shocks(rpm, length)
        np.testing.assert_allclose(ways, free, atol=0.05e-3)
        inset = let_go(run)
        assert free[0] + 0.5e-3 * length == pytest.approx(inset, rel=0.05)
        assert 0.5e-3 * length - free[1] == pytest.approx(inset, rel=0.15)
        apart.append((times[1] - times[0]) * contact_speed("outer", rpm))
        way.append(ways[1] - ways[0])
    assert way[1] - way[0] == pytest.approx(1e-3, rel=0.05)
    assert apart[1] - apart[0] == pytest.approx(1e-3, rel=0.1)  # by the speed without slip


def let_go(run):
    """How far behind the edge [m] the outer race should let go of ball 0."""
    force = run.dataset["race_force"].sel(element=0)
    gone = int(np.flatnonzero(force.sel(race="outer").values <= 0.0)[0])
    ring = (run.dataset["inner_position"] - run.dataset["outer_position"]).sel(axis="y").values
    pressed = sum((float(force.sel(race=r)[0]) / hertz(r)) ** (2 / 3) for r in SIDE)
    sunk = pressed + ring[gone] - ring[0]
    return np.sqrt(2 * effective("outer") * sunk - half_width("outer") ** 2 / 3)


def test_a_ball_of_a_short_spall_is_never_free():
    """Half a millimetre lets it down by 6.5 um, less than the outer race alone has it pressed."""
    run, x, _ = passed("outer", 1500, 0.5, "restitution")
    force = run.dataset["race_force"].sel(race="outer").values[:, 0]
    assert force.min() > 0.5 * force[0]
