"""Static solutions of hybrid bearings beside a solver of A. B. Jones's equations of its own, and
what ceramic elements change by closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from jones import Balls, Solid, solve

from flexcage import load_case, solve_static

STEEL, CERAMIC = Solid(206e9, 0.3, 7850.0), Solid(310e9, 0.27, 3200.0)
RPM = np.pi / 30.0


def case_of(ball, rpm, axial, radial):
    """7010C-PI of bearing steel, with balls of a material."""
    material = {"bearing.material": "GCr15"}
    if ball is CERAMIC:
        material["bearing.element_material"] = "Si3N4"
    tables = {
        "bearing": {"preset": "7010C-PI"},
        "drive": {"speed": f"{rpm} rpm"},
        "load": {"axial": f"{axial} N", "radial": f"{radial} N", "gravity": "0 m/s^2"},
    }
    return load_case(tables, overrides=material)


@pytest.mark.parametrize("ball", [STEEL, CERAMIC], ids=["steel", "Si3N4"])
@pytest.mark.parametrize(("rpm", "axial", "radial"), [(10000, 300, 0), (15000, 500, 150)])
def test_forces_and_angles_are_those_of_an_independent_solver(ball, rpm, axial, radial):
    case = case_of(ball, rpm, axial, radial)
    b = case.bearing
    other = Balls(
        b.ball_count, b.ball_diameter, b.pitch_diameter, (b.inner_conformity, b.outer_conformity),
        b.free_contact_angle, ball, STEEL,
    )  # fmt: skip
    found, wanted = (
        solve_static(case),
        solve(other, speed=rpm * RPM, axial=axial, radial=radial),
    )
    assert found.displacement[:2] == pytest.approx(wanted.displacement, rel=1e-5, abs=1e-12)
    assert found.elements.force == pytest.approx(wanted.force, rel=1e-5)
    assert found.elements.angle == pytest.approx(wanted.angle, rel=1e-5)
