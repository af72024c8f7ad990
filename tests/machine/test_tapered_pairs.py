"""Tapered roller bearings in pairs: preload, and the axial force that a radial load makes."""

from math import tan

import numpy as np
import pytest
from machines import load
from scipy.optimize import brentq

from flexcage.bearings import statics_of
from flexcage.machine import load_machine
from flexcage.machine.solve import solve_machine
from flexcage.system.spec import Load
from flexcage.system.statics.solve import solve_bearing


def tapered_pair(faces=("+x", "-x"), *, loads=(), apart=60.0, rpm=0, **place):
    rows = [
        {"name": name, "designation": "30205", "position": f"{x} mm", "facing": face, **place}
        for name, x, face in zip("AB", (100.0, 100.0 + apart), faces)
    ]
    return load_machine({
        "drive": {"speed": f"{rpm} rpm"}, "gravity": {"acceleration": "0 m/s^2"},
        "shaft": {"kind": "rigid", "length": "300 mm", "loads": list(loads)}, "bearings": rows,
    })  # fmt: skip


def axially(bearing, force):
    """Displacement under an axial force alone [m]."""
    return solve_bearing(bearing, statics_of(bearing), load=Load(axial=force)).displacement[0]


@pytest.mark.parametrize("faces", [("+x", "-x"), ("-x", "+x")])
def test_preload_and_push_share_as_both_compliances_say(faces):
    m = tapered_pair(faces, preload_force="500 N", loads=[load(0, 800, 0, 0)])
    found, b = solve_machine(m), m.bearings[0].case.bearing
    first = axially(b, 500.0)

    def gap(force):  # of the bearing that the push presses; the other bears 800 N less
        return axially(b, force) - first + axially(b, force - 800.0) - first

    pressed = brentq(gap, 801.0, 1500.0, rtol=1e-9)
    u = axially(b, pressed) - first
    assert found.displacement[0, 0] == pytest.approx(u, rel=1e-5)
    borne = (-pressed, pressed - 800.0) if faces[0] == "+x" else (pressed - 800.0, -pressed)
    for name, force in zip("AB", borne):
        assert found[name].force[0] == pytest.approx(force, rel=1e-5)


def test_a_radial_load_on_one_presses_the_other():
    """No play, no preload: the loaded bearing pushes away by about Fr tan(alpha) times 1.2 to 1.3
    (half of its rollers), or more where the other holds it tighter, and the other bears that."""
    m = tapered_pair(loads=[load(100, 0, 3000, 0)], apart=120.0)
    found, b = solve_machine(m), m.bearings[0].case.bearing
    push = abs(found["A"].force[0])
    assert push == pytest.approx(abs(found["B"].force[0]), rel=1e-9)
    assert 1.1 < push / (3000.0 * tan(b.contact_angle)) < 1.6
    assert found["B"].solution.loaded > 12  # nearly axial load alone
    forces = np.array([found[name].force for name in "AB"])
    assert forces[:, 1].sum() == pytest.approx(-3000.0)


def test_fits_preload_a_pair():
    """A tight shaft brings back-to-back bearings into preload by the wedge of their cones."""
    loose = solve_machine(tapered_pair(loads=[load(0, 200, 0, 0)], preload_force="100 N"))
    tight = solve_machine(tapered_pair(
        loads=[load(0, 200, 0, 0)], preload_force="100 N", fit={"shaft": "n5"},
    ))  # fmt: skip
    assert abs(tight["B"].force[0]) > 3.0 * abs(loose["B"].force[0])
