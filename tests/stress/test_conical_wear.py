"""Wear of a conical cage's pockets: constant force and sliding by hand, and a run's friction."""

from __future__ import annotations

from math import cos, sin, tan
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import flexcage
from flexcage.case import load_case
from flexcage.contacts.spec import LandSpec
from flexcage.results.statistics import Windows
from flexcage.stress.wear import wear
from flexcage.stress.wear_laws import WearLaw

CASE = Path(__file__).parents[2] / "examples" / "30205_run.toml"
NT, SLICES, STEP = 200, 8, 2e-5
ORBIT, SPIN, FORCE, MU = 130.0, -900.0, 12.0, 0.05  # rad/s, N
LAW = WearLaw(material="steel", coefficient=2e-15)
STRAIGHT = {"bearing.profile.kind": "straight"}


@pytest.fixture(scope="module")
def parts():
    case = load_case(CASE, overrides=STRAIGHT)
    return case.bearing, case.cage


@pytest.fixture
def spinning(parts):
    """Rollers that go round with the cage and spin about their own axes; the front bar of pocket 3
    is pressed by all slices alike, its side beam -x by an end."""
    bearing, _ = parts
    Z, beta = bearing.roller_count, bearing.axis_angle
    t, k = np.arange(NT) * STEP, np.arange(Z)
    angle, zero = ORBIT * t, np.zeros((NT, Z))
    centre = bearing.roller.centre
    radius = zero + bearing.pitch_radius - centre * sin(beta)
    position = np.stack(
        [zero + centre * cos(beta), radius, angle[:, None] + 2.0 * np.pi * k / Z], axis=-1
    )
    omega = np.stack([zero + SPIN + ORBIT * cos(beta), zero + ORBIT * sin(beta), zero], axis=-1)
    force, slices = np.zeros((NT, Z, 4)), np.zeros((NT, Z, 2, SLICES))
    slices[:, 3, 0], force[:, 3, 0], force[:, 3, 3] = FORCE / SLICES, FORCE, FORCE
    attitude = np.stack([np.cos(angle / 2), np.sin(angle / 2), 0 * t, 0 * t], axis=1)
    x = (np.arange(SLICES) + 0.5) / SLICES - 0.5
    body, element = ("time", "axis"), ("time", "element", "cyl")
    still = np.zeros((NT, 3))
    names = ("cage_position", "cage_velocity", "land_force", "inner_position", "inner_velocity")
    return xr.Dataset(
        {
            "element_position": (element, position),
            "element_velocity": (element, np.stack([zero, zero, ORBIT * radius], axis=-1)),
            "element_omega": (("time", "element", "spin_axis"), omega),
            "element_tilt": (("time", "element", "tilt"), np.stack([zero, zero - beta], axis=-1)),
            "cage_quaternion": (("time", "quaternion"), attitude),
            "cage_omega": (body, still + np.array([ORBIT, 0.0, 0.0])),
            "pocket_force": (("time", "pocket", "face"), force),
            "pocket_friction": (("time", "pocket", "face"), MU * force),
            "pocket_slice_force": (("time", "pocket", "crossbeam_face", "slice"), slices),
            "pocket_slice_friction": (("time", "pocket", "crossbeam_face", "slice"), MU * slices),
            "work": (("time", "channel"), -t[:, None]),
            "inner_speed": ("time", np.full(NT, 314.0)),
            **{name: (body, still.copy()) for name in names},
        },
        coords={
            "time": t, "pocket": k, "element": k, "face": ["front", "rear", "side+x", "side-x"],
            "slice": x * bearing.effective_length - bearing.roller.centre, "axis": ["x", "y", "z"],
            "channel": ["pocket_friction"],
        },
        attrs={"family": "tapered_roller", "element": "roller"},
    )  # fmt: skip


def test_constant_force_and_sliding_in_a_conical_pocket(spinning, parts):
    """Slices slide with their radius times the spin, an end with the mean distance of its points
    from the axis; nothing else rubs."""
    bearing, cage = parts
    found = wear(spinning, bearing, cage, LandSpec(), LAW, Windows(NT, np.arange(0, NT, 10)))
    places = ((np.arange(SLICES) + 0.5) / SLICES - 0.5) * bearing.effective_length
    speeds = abs(SPIN) * (0.5 * bearing.roller_diameter - places * tan(bearing.half_angle))
    cells = found.dataset["cell_volume_rate"].sel(pocket=3, face="front")
    np.testing.assert_allclose(cells, LAW.coefficient * FORCE / SLICES * speeds, rtol=2e-3)
    rate = found.dataset["volume_rate"]
    end = float(rate.sel(pocket=3, face="side-x")) / (LAW.coefficient * FORCE * abs(SPIN))
    assert 0.2 * bearing.roller_diameter < end < 0.5 * bearing.roller_diameter
    assert int((rate > 0.0).sum()) == 2


def test_sliding_of_tapered_rollers_explains_the_work_of_friction():
    """Recorded forces times speeds of rigid bodies are the work that friction took, but that an end
    counts with the mean speed of its points."""
    fine = {
        "solver.duration": "8 ms", "solver.tolerance": "0.001 um", "output.rate": "200 kHz",
    }  # fmt: skip
    found = flexcage.simulate(load_case(CASE, overrides=fine), stress=False).wear(LAW)
    assert found.friction_check == pytest.approx(1.0, abs=0.04)
    rate = found.dataset["volume_rate"]
    assert float(rate.sel(face=["front", "rear"]).sum()) > 0.5 * float(rate.sum())
