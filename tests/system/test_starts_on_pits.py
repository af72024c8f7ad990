"""Roller bearings start in equilibrium on any spall of a race, pit or flat of a roller."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from bearing_runs import NU, NUP, assembled

from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.geometry.spall import Spall
from flexcage.system.spec import Load, Mount
from flexcage.system.start import find_start

LOAD = 1000.0
PITCH = 2.0 * np.pi / 22
DESIGNS = {
    "N": {},
    "NU": NU,
    "NJ": {**NUP, "design": "NJ"},
    "NUP": NUP,
    "NF": {"design": "NF", "counter_rib_diameter": 86.6e-3, "counter_rib_gap": 8.03e-3},
}
RADIUS = {"inner": 37.25e-3, "outer": 45.25e-3}
PLACES = ("under a roller", "its edge under one", "between two", "out of the load")


def azimuth(place, length, ring):
    """Of a spall's middle, in a ``place`` beside roller 0, which bears most."""
    half = 0.5 * length / RADIUS[ring]
    return dict(zip(PLACES, (0.0, 0.9 * half, 0.5 * PITCH, np.pi), strict=True))[place]


def unbalanced(build_parts, *, pits, design="N", axial=0.0, mount=None):
    """Force (2,) [N] across the axis that the inner ring lacks as the run begins, the residual of
    the search, and forces (Z, 2) on both races."""
    load = Load(radial=LOAD, axial=axial)
    contacts = Contacts(race=PairSpec(normal=NormalLaw(law="elastic")))  # moving edges are damped
    parts = build_parts(
        bearing={**DESIGNS[design], **pits}, contacts=contacts, load=load, mount=mount or Mount()
    )
    bearing = assembled(parts, contacts)
    start = find_start(bearing, limit_force=2e4)
    left = bearing.layout.u(bearing.residual(0.0, start.y, start.yd, 2))["inner"][1:3]
    return left, start.residual, bearing.data.work.report.race[:, :, 0].copy()


def check(left, residual):
    """Balanced to the search's accuracy, and on the pits, but for friction."""
    assert residual <= 1e-6
    assert np.abs(left).max() < 0.02 * LOAD


GRID = list(product(("inner", "outer"), (0.3e-3, 0.5e-3, 1.2e-3, 3e-3), (10e-6, 200e-6), PLACES))


@pytest.mark.parametrize(
    ("ring", "length", "depth", "place"), [*GRID[::7], *(g for g in GRID if g[1] == 0.5e-3)]
)
def test_spalls_of_an_n(build_parts, ring, length, depth, place):
    spall = Spall(length=length, depth=depth, azimuth=azimuth(place, length, ring))
    left, residual, force = unbalanced(build_parts, pits={f"{ring}_spall": spall})
    check(left, residual)
    if place == "under a roller":
        even = unbalanced(build_parts, pits={})[2]
        assert force[0].max() < 0.99 * even[0].max()  # it lies in the pit


@pytest.mark.slow
@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.parametrize(("ring", "length", "depth", "place"), GRID)
def test_spalls_of_every_design(build_parts, design, ring, length, depth, place):
    spall = Spall(length=length, depth=depth, azimuth=azimuth(place, length, ring))
    axial = 100.0 if design in ("NJ", "NUP", "NF") else 0.0
    for width in (None, 3e-3):
        pits = {f"{ring}_spall": Spall(**{**vars(spall), "width": width})}
        check(*unbalanced(build_parts, pits=pits, design=design, axial=axial)[:2])


@pytest.mark.parametrize("mount", [Mount(), Mount(kind="bushing"), Mount(kind="contact")],
                         ids=lambda mount: mount.kind)  # fmt: skip
@pytest.mark.parametrize("design", ["NU", "NJ", "NUP", "NF"])
def test_designs_and_mounts(build_parts, design, mount):
    spall = Spall(length=0.5e-3, depth=50e-6)
    axial = 100.0 if design in ("NJ", "NUP", "NF") else 0.0
    pits = {"outer_spall": spall, "inner_spall": spall}
    check(*unbalanced(build_parts, pits=pits, design=design, axial=axial, mount=mount)[:2])


@pytest.mark.parametrize("kind", ["pit", "flat"])
@pytest.mark.parametrize("size", [0.3e-3, 1e-3])
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("facing", [0.0, np.pi], ids=["outer race", "inner race"])
def test_spots_of_rollers(build_parts, kind, size, share, facing):
    angle = facing + share * 0.5 * size / 4e-3
    spot = RollerSpot(size=size, kind=kind, depth=50e-6, angle=angle)
    check(*unbalanced(build_parts, pits={"roller_spot": spot})[:2])
