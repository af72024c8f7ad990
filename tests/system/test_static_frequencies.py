"""Passing frequencies of a static solution: by hand, and at the contact angles of a load."""

from __future__ import annotations

import json
from math import cos

import numpy as np
import pytest

from flexcage.case import StaticCase
from flexcage.case.presets import load_preset
from flexcage.static import solve_static
from flexcage.verification.cases.kinematics import TABLE

RPM = np.pi / 30.0


def solved(preset, rpm, **load):
    table = {"bearing": {"preset": preset}, "drive": {"speed": f"{rpm} rpm"}, "load": load}
    return solve_static(StaticCase.from_table(table))


def test_rollers_have_one_line_and_it_is_the_closed_form():
    s = solved("N1013", 6000, radial="1000 N")
    ratio = 8.0 / 82.5
    assert s.frequencies["BPFO"] == pytest.approx(100.0 * 11 * (1 - ratio), rel=1e-9)
    assert s.frequencies == s.nominal_frequencies
    line = next(x for x in s.table().splitlines() if x.startswith("pure rolling"))
    assert line.split()[2:4] == ["45.1515", "100"]


def test_balls_follow_the_contact_angles_of_their_load():
    """At 10 000 rpm centrifugal force parts the angles: orbit (w_i r_i)/(r_i + r_o)."""
    s = solved("7010C-PI", 10000, axial="250 N")
    inner, outer = np.abs(s.elements.angle).mean(axis=0)
    bearing = load_preset("7010C-PI").bearing
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    low, high = 1 - ratio * cos(inner), 1 + ratio * cos(outer)
    orbit = 10000 / 60.0 * low / (low + high)
    assert s.frequencies["FTF"] == pytest.approx(orbit, rel=1e-9)
    assert s.frequencies["BPFO"] == pytest.approx(18 * orbit, rel=1e-9)
    assert s.nominal_frequencies["BPFO"] == pytest.approx(TABLE["7010C at 10000"][7], abs=1e-3)
    assert inner > outer and s.frequencies["FTF"] != s.nominal_frequencies["FTF"]
    assert json.loads(s.to_json())["frequencies"]["BPFO"] == pytest.approx(18 * orbit)


def test_a_bearing_at_rest_has_no_line():
    s = solved("N1013", 0, radial="1000 N")
    assert "frequency" not in s.table()
