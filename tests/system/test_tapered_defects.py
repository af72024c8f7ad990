"""Waves and spalls of conical races, pits and flats of tapered rollers: slopes of one energy,
balance, powers, how deep they are."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from bearing_runs import march
from leaning_rollers import check_balance, shift, slope_of, stir
from tapered_parts import (
    DRY,
    ELASTIC,
    FRICTIONLESS,
    LIGHT,
    begun,
    frames,
    pressed,
    pushed,
    tapered,
)

from flexcage.system.data import RACE_FRICTION

#: Rollers 12 and 13, at 254.1 and 275.3 deg, are over an edge of the spalls; all spots are met.
UNEVEN = {
    "waves": {
        "bearing.inner_waviness": "2 um", "bearing.inner_waviness_order": 9,
        "bearing.outer_waviness": "1.5 um", "bearing.outer_waviness_order": 14,
        "bearing.outer_waviness_azimuth": "4 deg",
    },
    "spalls": {
        "bearing.outer_spall.length": "1.2 mm", "bearing.outer_spall.azimuth": "276.6 deg",
        "bearing.inner_spall.length": "1 mm", "bearing.inner_spall.azimuth": "255.6 deg",
        "bearing.inner_spall.width": "4 mm", "bearing.inner_spall.offset": "1.5 mm",
    },
    "pit": {
        "bearing.roller_spot.size": "0.8 mm", "bearing.roller_spot.others": [2, 12, 13, 14],
        "bearing.roller_spot.angle": "5.7 deg", "bearing.roller_spot.width": "5 mm",
    },
    "flat, inner race": {
        "bearing.roller_spot.size": "0.8 mm", "bearing.roller_spot.others": [2, 12, 13, 14],
        "bearing.roller_spot.kind": "flat", "bearing.roller_spot.angle": "174.5 deg",
    },
}  # fmt: skip


def power_of(motion, force, moment):
    return float(np.dot(force, motion[0]) + np.dot(moment, motion[1]))


@pytest.mark.parametrize("name", UNEVEN)
def test_forces_on_uneven_cones_are_slopes_of_one_energy(name):
    """Over all six coordinates of rollers, spin too, and of both rings."""
    _, bearing = tapered(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT, **UNEVEN[name])
    y, layout = pressed(bearing), bearing.layout
    pushed(bearing, y)
    work = bearing.data.work.scratch
    q, wrenches = layout.q(y)["elements"], work.wrenches.copy()
    border = {name: v.copy() for name, v in layout.border(work.border).items()}
    _, axes = frames(q)
    e, none = np.eye(3), np.zeros(3)

    spun = turned = 0.0
    for i in (0, 2, 12, 13, 14):
        r, a = q[i, 1], axes[i]
        motions = [
            (e[0], none),
            (e[1], none),
            (r * e[2], e[0]),
            (none, e[1]),
            (none, a[2]),
            (none, a[0]),
        ]
        steps = (1e-9, 1e-9, 5e-8, 1e-7, 1e-7, 1e-7)
        scale = np.abs(wrenches[i, :3]).max() * np.array([1.0, 1.0, r, r, r, r])
        found = np.array([power_of(m, wrenches[i, :3], wrenches[i, 3:]) for m in motions])
        due = np.array(
            [slope_of(bearing, y, shift("elements", i, c), h) for c, h in enumerate(steps)]
        )
        assert found / scale == pytest.approx(due / scale, abs=5e-5), i
        spun = max(spun, abs(found[5]))
    for name_of_ring in ("inner", "outer"):
        skew, tilt = layout.q(y)[name_of_ring][3:5]
        about = [e[1], np.array([sin(skew), 0.0, cos(skew)])]
        about += [np.array([cos(skew) * cos(tilt), sin(tilt), -sin(skew) * cos(tilt)])]
        motions = [(k, none) for k in e] + [(none, k) for k in about]
        force = border[name_of_ring]
        found = [power_of(m, force[:3], force[3:]) for m in motions]
        steps = (1e-9,) * 3 + (1e-7,) * 3
        due = [slope_of(bearing, y, shift(name_of_ring, c), h) for c, h in enumerate(steps)]
        scale = np.abs(force[:3]).max() * np.array([1.0] * 3 + [bearing.spec.pitch_radius] * 3)
        assert found / scale == pytest.approx(due / scale, abs=5e-5)
        turned = max(turned, abs(found[5]))
    assert (spun if "roller_spot" in str(UNEVEN[name]) else turned) > 1e-3  # N m


@pytest.mark.parametrize("name", UNEVEN)
def test_all_forces_on_uneven_cones_balance(name):
    _, bearing = tapered(**{"lubricant.oil_fraction": 0.0}, **LIGHT, **UNEVEN[name])
    y = pressed(bearing)
    stir(bearing, y)
    found = pushed(bearing, y)
    assert bearing.data.work.report.power[RACE_FRICTION] < -0.1
    check_balance(found)


def test_waves_of_the_outer_race_shake_the_ring_along_the_axis():
    """As many waves as rollers lift all of these at once: slowly turned, the inner ring goes along
    the axis by the amplitude over the sine of the contact angle, once a roller's passing."""
    amplitude, speed = 1e-6, 2000.0 * np.pi / 30.0
    case, bearing = tapered(
        **LIGHT, **DRY, **{
            "load.radial": 0.0, "drive.speed": "2000 rpm", "bearing.outer_waviness": amplitude,
            "bearing.outer_waviness_order": 17,
        },
    )  # fmt: skip
    spec = bearing.spec
    inner, outer = spec.race_angles
    passing = 17 * speed * sin(inner) / (sin(inner) + sin(outer)) / (2.0 * np.pi)
    h = march(bearing, *begun(case, bearing), duration=1.0 / passing, rate=40e3)
    x = bearing.layout.q(h.y)["inner"][:, 0]
    c = np.fft.rfft(x - x.mean()) / (0.5 * len(x))
    assert abs(c[1]) == pytest.approx(amplitude / sin(outer), rel=0.02)
    assert np.abs(c[2:]).max() < 0.05 * abs(c[1])


def test_rollers_cross_a_spall_of_the_outer_race_at_its_passing_frequency():
    """Each bears nothing there, one after the other, as often as cones in pure rolling pass."""
    case, bearing = tapered(**LIGHT, **{
        "bearing.outer_spall.length": "1.5 mm", "drive.speed": "6000 rpm", "load.radial": 0.0,
    })  # fmt: skip
    inner, outer = bearing.spec.race_angles
    orbit = case.drive.speed * sin(inner) / (sin(inner) + sin(outer))
    h = march(bearing, *begun(case, bearing), duration=6e-3, method="explicit")
    force, psi = h.samples.race[: len(h.time), :, 1, 0], bearing.layout.q(h.y)["elements"][:, :, 2]
    away = np.abs(np.angle(np.exp(1j * psi))) * 0.5 * bearing.spec.race_diameters[1]
    assert np.mean(force[away < 0.2e-3] == 0.0) > 0.9 and force[away > 2e-3].min() > 50.0
    empty = (force == 0.0) & (away < 0.75e-3)
    middles = np.array([h.time[k].mean() for k in empty.T if k.any() and not k[0] and not k[-1]])
    gaps = np.diff(np.sort(middles[middles > 0.5e-3]))  # one stands on it at the start
    assert len(gaps) >= 3
    assert gaps.mean() == pytest.approx(2.0 * np.pi / (17 * orbit), rel=0.01)
