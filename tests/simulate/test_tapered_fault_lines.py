"""Where faults of tapered roller bearings show in the spectra of sensors, against the kinematics of
cones with one apex that roll without slip."""

from __future__ import annotations

from math import sin
from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage.case import load_case
from flexcage.results.metrics import settled

CASE = Path(__file__).parents[2] / "examples" / "30205_run.toml"
SEEN = {
    "mount.kind": "bushing", "mount.stiffness": "2e8 N/m", "mount.damping": "2000 N*s/m",
    "output.settle": 0.2, "drive.speed": "6000 rpm",
}  # fmt: skip
FAULTS = {
    "outer": {"bearing.outer_spall.length": "1.5 mm", "bearing.outer_spall.depth": "50 um"},
    "inner": {"bearing.inner_spall.length": "1.2 mm", "bearing.inner_spall.depth": "50 um"},
    "roller": {"bearing.roller_spot.size": "1 mm", "bearing.roller_spot.depth": "50 um"},
}


def passing(fault, bearing, speed):
    """Frequency [Hz] at which a place is struck, by the sines of the angles of cones."""
    inner, outer = bearing.race_angles
    whole = sin(inner) + sin(outer)
    turns = {
        "outer": bearing.roller_count * sin(inner) / whole,
        "inner": bearing.roller_count * sin(outer) / whole,
        "roller": 2.0 * sin(inner) * sin(outer) / (whole * sin(bearing.half_angle)),
    }
    return turns[fault] * speed / (2.0 * np.pi)


def squared_acceleration(run):
    """Frequencies [Hz] and amplitudes of the outer ring's squared acceleration along both radii,
    and how far two lines of it are apart."""
    ds = settled(run.dataset, 0.2)
    power = (ds["outer_acceleration_filtered"].sel(axis2=["y", "z"]) ** 2).sum("axis2").values
    step = float(np.diff(ds["time_hf"].values[:2])[0])
    lines = np.abs(np.fft.rfft((power - power.mean()) * np.hanning(len(power)), 8 * len(power)))
    return np.fft.rfftfreq(8 * len(power), step), lines, 1.0 / (len(power) * step)


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_faults_of_tapered_bearings_stand_at_their_passing_frequencies(fault):
    case = load_case(CASE, overrides={**SEEN, **FAULTS[fault], "solver.duration": "60 ms"})
    run = flexcage.simulate(case, stress=False)
    frequency, lines, apart = squared_acceleration(run)
    due = passing(fault, case.bearing, case.drive.speed)
    near = (frequency > 0.6 * due) & (frequency < 1.5 * due)
    found = frequency[near][lines[near].argmax()]
    assert found == pytest.approx(due, abs=0.5 * apart + 0.01 * due)
    assert run.summary.row("energy_audit").value == "passed"
