"""What a summary says of the inner ring, against a motion whose figures are known."""

import numpy as np
import pytest

from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise


def test_drive_place_and_reactions_of_a_known_motion(known_run, bearing):
    ds = known_run.copy(deep=True)
    ds["inner_position"][:, 1], ds["inner_position"][:, 2] = 3e-6, 4e-6
    ds["inner_position"][:, 0] = -2e-6
    ds["inner_quaternion"][:] = [np.cos(0.25e-3), 0.0, 0.0, np.sin(0.25e-3)]  # 0.5 mrad about z
    ds["multiplier"].loc[{"constraint": "axial_force"}] = -200.0
    ds["multiplier"].loc[{"constraint": "moment_y"}] = 1e-6  # rounding
    summary = summarise(SettledRun(ds, bearing))
    assert summary["drive_power"] == pytest.approx(5.0)  # 5 J a second
    assert summary["drive_torque"] == pytest.approx(5.0 / (6000 * np.pi / 30))
    assert summary["inner_displacement"] == pytest.approx(5e-6)
    assert "towards 53.1 deg" in summary.row("inner_displacement").note
    assert summary["inner_axial"] == pytest.approx(-2e-6)
    assert summary["inner_tilt"] == pytest.approx(0.5e-3)
    assert "0.5 mrad towards y and 0 towards z" in summary.row("inner_tilt").note
    assert summary["reaction_axial_force"] == pytest.approx(-200.0)
    assert summary["reaction_moment_y"] == 0.0


def test_a_standing_ring_has_no_torque(known_run, bearing):
    ds = known_run.copy(deep=True)
    ds["inner_speed"][:] = 0.0
    summary = summarise(SettledRun(ds, bearing))
    assert summary["drive_power"] == pytest.approx(5.0) and summary["drive_torque"] is None
