"""A roller strikes the crossbeam of a free cage: the reduced cage against the full mesh.

The roller moves along its orbit at 0.3 m/s onto the middle of the front face of pocket 0, nothing
else touches anything. The reference integrates all unknowns of the mesh by Newmark's rule with the
same normal law at the same slices. The blow lasts 28 us, the period of a crossbeam's own bending.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from full_mesh import Impact, station_rows
from verification_bearing import (
    FRICTIONLESS,
    NO_OIL,
    bearing_of,
    cage_of,
    log,
    march,
    n1013,
    relative_error,
    state_at_rest,
    station_reading,
)  # fmt: skip

SPEED, DURATION = 0.3, 100e-6
ALONE = {
    **FRICTIONLESS,
    **NO_OIL,
    "contacts.land.kind": "none",
    "contacts.pocket.normal.law": "elastic",
    "modes.damping": 0.0,
    "drive.speed": "0 rpm",
    "load.gravity": "0 m/s^2",
    "load.radial": "0 N",
    "solver.duration": "0.1 ms",
    "solver.tolerance": "0.0001 um",
    "solver.max_step": "0.5 us",
    "output.vibration_rate": "2000 kHz",
    "output.rate": "2000 kHz",
}


@dataclass(frozen=True)
class Blow:
    """Contact force over time (after 0) and what it amounts to."""

    time: np.ndarray
    force: np.ndarray

    @property
    def peak(self) -> float:
        return float(self.force.max())

    @property
    def impulse(self) -> float:
        return float(np.trapezoid(self.force, self.time))

    @property
    def duration(self) -> float:
        """Time during which the force exceeds a thousandth of its peak."""
        return float(np.count_nonzero(self.force > 1e-3 * self.peak) * np.diff(self.time)[0])

    def __str__(self) -> str:
        return (
            f"peak {self.peak:.1f} N, impulse {1e3 * self.impulse:.3f} mN s, "
            f"{1e6 * self.duration:.1f} us"
        )


def strike(case) -> Blow:
    """The blow in the program: the whole bearing, in which only roller 0 moves."""
    bearing = bearing_of(case)
    y, yd = state_at_rest(bearing)
    layout, radius = bearing.layout, case.bearing.pitch_radius
    gap = 0.5 * (case.cage.pocket_width - case.bearing.roller_diameter)
    layout.q(y)["elements"][0, 1:3] = radius, np.arcsin((gap - 1e-9) / radius)
    layout.u(y)["elements"][0, 2], layout.q(yd)["elements"][0, 2] = SPEED, SPEED / radius
    ds = march(case, bearing, y, yd)
    assert float(ds["race_force"].max()) == 0.0  # nothing else was touched
    assert float(ds["pocket_force"].values[:, 1:].max()) == 0.0
    force = ds["pocket_force"].values[:, 0, 0].astype(float)
    change = float(ds["element_velocity"][-1, 0, 2]) - SPEED
    blow = Blow(ds["time"].values, force)
    assert blow.impulse == pytest.approx(-case.bearing.roller_mass * change, rel=0.01)
    return blow


@pytest.fixture(scope="module")
def full_mesh():
    case = n1013(ALONE)
    _, cage = cage_of(case)
    bearing = bearing_of(case)
    pocket, stations = bearing.data.model.pocket, cage.interface.stations[0]
    spread = station_reading(stations, pocket.s)
    impact = Impact(
        cage,
        station_rows(cage, 0, 0),
        spread,
        pocket.drop,
        bearing.data.model.pocket.normal[0, :2],
        mass=case.bearing.roller_mass,
        step=1e-6,
    )
    blow = Blow(*impact.run(SPEED, DURATION))
    log.info("full mesh: %s", blow)
    return blow


def compared(case, full_mesh) -> tuple[Blow, float]:
    blow = strike(case)
    reference = np.interp(blow.time, full_mesh.time, full_mesh.force)
    error = relative_error(blow.force, reference)
    spec = case.modes
    log.info("%s %s, %d modes: %s, L2 %.3f", case.cage_model, spec.dynamic, spec.count, blow, error)
    return blow, error


def test_fully_dynamic_basis_strikes_as_the_full_mesh(full_mesh):
    blow, error = compared(n1013(ALONE, {"modes.dynamic": "all"}), full_mesh)
    assert blow.peak == pytest.approx(full_mesh.peak, rel=0.06)
    assert blow.impulse == pytest.approx(full_mesh.impulse, rel=0.01)
    assert blow.duration == pytest.approx(full_mesh.duration, rel=0.06)
    assert error < 0.11


def test_default_basis_strikes_as_the_full_mesh(full_mesh):
    """3 % more peak, 4 % more impulse, 6 % shorter; a rigid cage gives 85 % more peak."""
    blow, _ = compared(n1013(ALONE), full_mesh)
    assert blow.peak == pytest.approx(full_mesh.peak, rel=0.06)
    assert blow.impulse == pytest.approx(full_mesh.impulse, rel=0.06)
    assert blow.duration == pytest.approx(full_mesh.duration, rel=0.08)
    rigid, _ = compared(n1013(ALONE, {"cage.model": "rigid"}), full_mesh)
    assert rigid.peak > 1.6 * full_mesh.peak


def test_crossbeams_without_inertia_of_their_own_strike_harder(full_mesh):
    """What the crossbeams' shapes are for: without them, beyond 24 modes (12 kHz), the blow has
    21 % more peak and 11 % more impulse, and is shorter by 10 %."""
    blow, _ = compared(n1013(ALONE, {"modes.crossbeams": False}), full_mesh)
    assert 1.10 * full_mesh.peak < blow.peak < 1.25 * full_mesh.peak
    assert 1.06 * full_mesh.impulse < blow.impulse < 1.15 * full_mesh.impulse


def test_more_modes_bring_the_blow_nearer(full_mesh):
    """100 of them, to 45 kHz: 1 %, 0.4 % and 2 %."""
    blow, error = compared(n1013(ALONE, {"modes.count": 100}), full_mesh)
    assert blow.peak == pytest.approx(full_mesh.peak, rel=0.02)
    assert blow.impulse == pytest.approx(full_mesh.impulse, rel=0.01)
    assert blow.duration == pytest.approx(full_mesh.duration, rel=0.04)
    assert error < 0.12
