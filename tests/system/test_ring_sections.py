"""Ribs and lands of rings with modes, in a run."""

import numpy as np
import pytest
from bearing_runs import NUP, unbalanced
from ring_cases import at_rest, housing_file, soft

import flexcage
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh
from flexcage.static import solve_static
from flexcage.system.data import IN_CONTACTS, STRAIN
from flexcage.system.rings.neglected import (
    neglected_at_lands,
    neglected_at_ribs,
    neglected_deflection,
)
from flexcage.system.statics.options import AT_START

ARCS = {
    "outer_ring.ring": "flexible", "outer_ring.seat": "arcs",
    "outer_ring.supports": tuple(np.radians([40.0, -40.0])),
}  # fmt: skip
SMOOTH = {
    f"contacts.{place}.{law}": name
    for place in ("race", "rib", "land", "pocket", "side")
    for law, name in (("normal.law", "elastic"), ("friction.law", "none"))
}
LAND = {"cage.guidance": "outer", "contacts.land.kind": "dry"}
RIBS = {f"bearing.{key}": value for key, value in {**NUP, "rib_diameter": 87.2e-3}.items()}


@pytest.fixture
def housing(tmp_path):
    return housing_file(tmp_path, along=5e7, coupled=1e6)


INNER = soft("inner", **{"load.shaft_mass": 1.0})
LAND_INSIDE = {"cage.guidance": "inner", "contacts.land.kind": "dry"}


class Bent:
    """A bearing whose elements are away from the race of the ``side`` that bends, some on ribs and
    land."""

    def __init__(self, case, *, side="outer", lands=False, aside=0.0):
        self.side = f"{side}_modes"
        self.bearing = bearing_in_motion(case, cage_mesh(case), None)
        self.layout, start = self.bearing.layout, assembled_start(case, self.bearing)
        self.y, self.yd, rng = start.y.copy(), 0.0 * start.yd, np.random.default_rng(2)
        self.layout.u(self.y)["elements"][:] = 0.0
        for name in ("inner", "cage", "omega"):
            self.layout.u(self.y)[name][:] = 0.0
        elements = self.layout.q(self.y)["elements"]
        elements[:, 1] += {"outer": -1e-4, "inner": 3e-4}[side]
        elements[:, 0] += aside * rng.choice([-1.0, 1.0], len(elements))
        elements[:, 3:5] += 1e-4 * rng.standard_normal((len(elements), 2))
        self.layout.ring_forces(self.y)[:] = 0.0
        if lands:
            reach = self.bearing.data.model.land.clearance + 8e-6
            self.layout.q(self.y)["cage"][1:] = reach * np.array([0.8, 0.6])
        a = self.layout.q(self.y)[self.side]
        a += 2e-8 * rng.standard_normal(len(a))

    def forces(self, y=None):
        """Forces on the ring's modes, from their rows."""
        out = self.bearing.residual(0.0, self.y if y is None else y, self.yd)
        return -self.layout.u(out)[self.side]

    def energy(self, y):
        self.bearing.residual(0.0, y, self.yd, 2)
        stored = self.bearing.data.work.report.energy
        return stored[IN_CONTACTS] + stored[STRAIN]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("preset", "more", "where"),
    [
        ("N1013", {**RIBS, **SMOOTH}, {"aside": 22e-6}),
        ("N1013", {**RIBS, **LAND, **SMOOTH}, {"lands": True, "aside": 22e-6}),
        ("7010C-PI", {**LAND, **SMOOTH}, {"lands": True}),
        ("N1013", {**SMOOTH, "load.gravity": 0.0}, {"side": "inner", "aside": 22e-6}),
        ("7010C-PI", {**LAND_INSIDE, **SMOOTH}, {"side": "inner", "lands": True}),
    ],
)
def test_ribs_and_lands_push_along_the_slopes_of_their_energy(preset, more, where):
    """On the ring's coordinates, the cage, and elements along their orbit; third law."""
    inner = where.get("side") == "inner"
    bent = Bent(at_rest(preset, **(INNER if inner else ARCS), **more), **where)
    forces, y, layout = bent.forces(), bent.y, bent.layout
    work = bent.bearing.data.work.scratch
    wrenches, pushed = work.wrenches.copy(), layout.border(work.border.copy())
    assert np.abs(getattr(bent.bearing.data.model, bent.side).borne).max() > 1.0
    assert np.abs(unbalanced(bent.bearing, layout.q(y)["elements"])).max() < 1e-12
    scale = np.abs(forces).max()
    for m in range(len(forces)):
        ends = []
        for h in (1e-12, -1e-12):
            moved = y.copy()
            layout.q(moved)[bent.side][m] += h
            ends.append(bent.energy(moved))
        assert -(ends[0] - ends[1]) / 2e-12 == pytest.approx(forces[m], abs=2e-4 * scale), m
    if "aside" in where:
        radius = layout.q(y)["elements"][:, 1]
        # rollers turn about the bearing's centre, the slope is one about the ring's
        allowed = 1e-3 * np.abs(wrenches[:, 2]).max() + 1e-4 * np.abs(wrenches[:, 0]).max()
        for i in range(layout.elements):
            ends = []
            for h in (1e-8, -1e-8):
                moved = y.copy()
                layout.q(moved)["elements"][i, 2] += h
                ends.append(bent.energy(moved))
            slope = -(ends[0] - ends[1]) / 2e-8
            assert slope / radius[i] == pytest.approx(wrenches[i, 2], abs=allowed), i
    if "lands" in where:
        assert np.abs(pushed["cage"]).max() > 1.0
        for c in (1, 2):
            ends = []
            for h in (1e-10, -1e-10):
                moved = y.copy()
                layout.q(moved)["cage"][c] += h
                ends.append(bent.energy(moved))
            slope = -(ends[0] - ends[1]) / 2e-10
            assert slope == pytest.approx(
                pushed["cage"][c], abs=1e-3 * np.abs(pushed["cage"]).max()
            )


@pytest.mark.slow
def test_ribs_move_with_a_housing_as_in_the_static_solution(housing):
    """Under an axial load through ribs: forces and displacements within 0.2 %."""
    load = {"load.axial": 600.0, "load.radial": 3000.0}
    case = at_rest("N1013", duration=4e-3, **RIBS, **load, **{"mount.body": housing})
    run, static = flexcage.simulate(case, stress=False), solve_static(case, options=AT_START)
    ds = run.dataset
    assert abs(static.outer[0]) > 5e-6
    outer, inner = ds["outer_position"].values[-1], ds["inner_position"].values[-1]
    assert outer == pytest.approx(static.outer[:3], abs=2e-3 * np.abs(static.outer[:3]).max())
    largest = np.abs(static.displacement[:3]).max()
    assert inner == pytest.approx(static.displacement[:3], abs=5e-3 * largest)


@pytest.mark.parametrize(
    ("seat", "clearance", "told"),
    [("foundation", 10e-6, True), ("foundation", 1e-3, False), ("rigid", 10e-6, False)],
)
def test_a_warning_names_what_a_land_leaves_out(seat, clearance, told):
    """Of an inner ring on a soft seat, beside a land that is narrow."""
    case = at_rest("7010C-PI", **{
        "inner_ring.ring": "flexible", "inner_ring.seat": seat, "inner_ring.foundation": 3e10,
        "cage.guidance": "inner", "contacts.land.clearance": clearance,
    })  # fmt: skip
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    (side, *_), left = bearing.rings.start.rings, neglected_deflection(bearing.rings)
    # modes of two waves and more carry little of it: the ring moves as a whole
    whole = np.abs(side.deflection[:, :2]).max()
    assert left[0] == pytest.approx(side.deflection[:, :2], abs=0.1 * whole) and not left[1].any()
    sentences = list(neglected_at_lands(bearing.rings, bearing.data.model.land))
    assert len(sentences) == told
    if told:
        share = np.abs(left[0][:, 1]).max() / clearance
        assert f"{share:.0%} of the lands' clearance" in sentences[0]
        assert "the lands of the inner ring" in sentences[0]


def test_ribs_leave_out_little_of_a_ring_on_arcs():
    """Its coordinates carry the race's radial deflection but for a little; its section rolls by so
    little that a rib of ordinary play does not matter."""
    case = at_rest("N1013", **RIBS, **ARCS, **{"load.axial": 600.0})
    moving = bearing_in_motion(case, cage_mesh(case), None).rings
    whole = np.abs(moving.start.rings[0].deflection[:, 1:]).max(axis=0)
    rest = np.abs(neglected_deflection(moving)[1]).max(axis=0)
    assert 0.0 < rest[0] < 0.1 * whole[0] and rest[1] < whole[1]
    assert not list(neglected_at_ribs(moving, 1, 2e-3, 60e-6))
    (said,) = neglected_at_ribs(moving, 1, 2e-3, 1e-9)
    assert "the ribs of the outer ring follow" in said
