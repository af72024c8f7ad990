"""A crossbeam of a window cage that is broken in two: its mesh, and how it yields."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import frames_at

Z = 12
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=7e-3, pocket_length=8.25e-3
)
BROKEN = BrokenCrossbeam(crossbeam=3)


def mesh_of(*defects):
    return build_cage_mesh(
        CAGE, pocket_count=Z, pitch_diameter=43.5e-3, defects=defects,
        options=MeshOptions(fineness="coarse"),
    )  # fmt: skip


@pytest.fixture(scope="module")
def models():
    return [assemble(mesh_of(*d), MATERIALS["brass"]) for d in ((), (BROKEN,))]


def cut_area(model):
    corners = model.points[model.surface]
    flat = (np.abs(corners[:, :, 0]) < 1e-9).all(axis=1)
    sides = corners[flat, 1:] - corners[flat, :1]
    return 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum()


def test_the_break_has_two_faces_as_large_as_the_crossbeam(models):
    """Its section: of the sector between two radii, less a pocket as wide at all radii."""
    sound, broken = models
    assert cut_area(sound) == 0.0
    r1, r2, half = 20e-3, 23.5e-3, 3.5e-3

    def under(r):  # area of a sector beyond the line at distance ``half``, up to radius r
        return 0.5 * r**2 * np.arcsin(half / r) + 0.5 * half * np.sqrt(r**2 - half**2)

    section = np.pi / Z * (r2**2 - r1**2) - 2.0 * (under(r2) - under(r1))
    assert cut_area(broken) == pytest.approx(2.0 * section, rel=0.01)
    assert broken.mass == pytest.approx(sound.mass, rel=1e-12)
    info = mesh_of(BROKEN, CrossbeamDefect(crossbeam=7, displacement=0.1e-3)).info
    (first, second) = info["defects"]
    assert first["delivered"] == pytest.approx(3.5e-3, rel=1e-6)
    assert second["delivered"] == pytest.approx(0.1e-3, rel=0.02)


def test_its_ends_yield_as_cantilevers(models):
    """A force on one end moves this end and hardly the other; the sound beam is stiffer by far."""
    tangent = frames_at(2.0 * np.pi * 2.5 / Z)[2]
    tips = []
    for model in models:
        x, y, z = model.nodes.T
        turn = np.angle(np.exp(1j * (np.arctan2(z, y) - 2.0 * np.pi * 2.5 / Z)))
        tip = np.flatnonzero((np.abs(x) < 1e-9) & (np.abs(turn) < np.pi / Z))
        cells = model.cells[(model.points[model.tets].mean(axis=1)[:, 0] > 0.0)]
        ahead = np.intersect1d(tip, cells)
        load = np.zeros((len(model.nodes), 3))
        load[ahead] = tangent / len(ahead)
        moved = FreeBodySolver(model).solve(load.reshape(-1, 1)).reshape(-1, 3) @ tangent
        tips.append((moved[ahead].mean(), moved[np.setdiff1d(tip, ahead)]))
    (sound, none), (pushed, other) = tips
    assert not len(none) and len(other) > 5
    assert pushed > 2.5 * sound and abs(other.mean()) < 0.2 * pushed


def test_a_broken_crossbeam_in_a_case():
    table = {
        "bearing": {"preset": "N1013"},
        "defects": [{"type": "broken_crossbeam", "crossbeam": 3}],
    }
    case = load_case(table)
    assert case.defects[0] == BROKEN and load_case(case.to_toml()).hash == case.hash
    assert "crossbeam 3, between pockets 2 and 3, is broken in two" in case.defects[0].in_words(22)
    twice = {**table, "defects": table["defects"] * 2}
    with pytest.raises(InputError, match="Crossbeam 3 is broken 2 times"):
        load_case(twice)
    with pytest.raises(InputError, match="numbered 0 to 21"):
        load_case(table, overrides={"defects.0.crossbeam": 22})
    every = [{"type": "broken_crossbeam", "crossbeam": k} for k in range(22)]
    with pytest.raises(InputError, match="All 22 crossbeams are broken"):
        load_case({**table, "defects": every})
