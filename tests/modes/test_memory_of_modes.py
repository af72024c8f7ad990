"""Memory is estimated before it is taken, and refused in one sentence."""

from __future__ import annotations

import dataclasses
import logging

import pytest
from modes_cage import CAGE, POCKETS, cage_mesh

from flexcage.cages.build import build_cage_mesh, reduce_cage
from flexcage.core.errors import InputError
from flexcage.fem import effort
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh import sector
from flexcage.mesh.options import MeshOptions
from flexcage.modes.spec import ModesSpec


@pytest.fixture(scope="module")
def model():
    return assemble(cage_mesh(), MATERIALS["brass"])


def test_a_mesh_that_does_not_repeat_needs_more(model):
    """23 GB were taken by 590,000 nodes that did not repeat, 1.44 GB by 165,920 that did."""
    whole = dataclasses.replace(model, info={})
    assert effort.modes_bytes(whole, 24) > 1.1 * effort.modes_bytes(model, 24)
    size = len(model.nodes)
    per_node = effort.modes_bytes(model, 24) / size
    assert per_node * 165_920 == pytest.approx(1.44e9, rel=0.1)
    factor = effort.modes_bytes(whole, 24) / size - per_node
    large = 590_000 * (per_node + factor * (590_000 / size) ** (1.0 / 3.0))
    assert large == pytest.approx(23e9, rel=0.2)


def test_modes_beyond_the_machine_are_refused_before_they_are_made(monkeypatch, tmp_path):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(effort, "total_memory", lambda: 50e6)
    monkeypatch.setattr("flexcage.fem.free.FreeBodySolver.solve", None)  # nothing is solved
    with pytest.raises(InputError, match="8,748 nodes .* 50 MB; give a larger mesh.size") as caught:
        reduce_cage(cage_mesh(), cage=CAGE, defects=(), spec=ModesSpec())
    assert str(caught.value).count(". ") <= 1 and "take about" in str(caught.value)


def test_modes_beyond_what_is_free_are_warned_of(model, monkeypatch, caplog):
    monkeypatch.setattr(effort, "free_memory", lambda: 50e6)
    with caplog.at_level(logging.WARNING):
        effort.check_memory(model, 24)
    assert "8,748 nodes take about" in caplog.text and "50 MB are free" in caplog.text


@pytest.mark.parametrize("size", [1e-6, 1e-9])
def test_elements_beyond_the_machine_are_refused_before_meshing(size, monkeypatch):
    monkeypatch.setattr(sector, "mesh_arrays", None)  # nothing is meshed
    with pytest.raises(InputError, match="give a larger mesh.size") as caught:
        build_cage_mesh(
            CAGE, pocket_count=POCKETS, pitch_diameter=43.5e-3, options=MeshOptions(size=size)
        )
    assert caught.value.where == "mesh.size"
