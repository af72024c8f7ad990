"""Modes and stress fields of a mesh from a file say how long they take; a built mesh's do not."""

import dataclasses
import logging

import numpy as np
import pytest
from own_mesh import renumbered

import flexcage
from flexcage.cages.build import reduction_of
from flexcage.cages.window.places import WINDOW_PLACES
from flexcage.core import pace
from flexcage.mesh.io import write_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.modes.reduction import CageReduction
from flexcage.stages import cage_mesh
from flexcage.stress.fields import StressFields
from flexcage.stress.recovery import StressRecovery


@pytest.fixture
def reduction(tmp_path, monkeypatch):
    """reduction(own, apart): a coarse cage's, nothing of it made yet, from a file if it is one's
    own; ``apart`` moves its points so that it does not repeat."""
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    case = flexcage.Case.from_preset("N1013", mesh=MeshOptions(fineness="coarse", order=1))

    def make(own: bool, apart: float = 0.0) -> CageReduction:
        mesh = cage_mesh(case)
        if own:
            mesh = renumbered(mesh)
            moves = np.random.default_rng(0).uniform(-apart, apart, mesh.points.shape)
            mesh = dataclasses.replace(mesh, points=mesh.points + moves)
            file = str(write_mesh(mesh, tmp_path / "own.msh"))
            mesh = cage_mesh(case.replace("mesh.file", file))
        return reduction_of(mesh, cage=case.cage, defects=(), spec=case.modes, order=1)

    return make


def test_a_built_mesh_says_nothing(reduction, caplog):
    with caplog.at_level(logging.INFO, "flexcage"):
        assert reduction(own=False).basis.size
    assert not [m for m in caplog.messages if "about" in m]


@pytest.mark.parametrize(
    ("apart", "words"), [(0.0, "repeats from pocket to pocket"), (1e-6, "does not repeat")]
)
def test_a_mesh_from_a_file_says_how_long_it_takes(reduction, caplog, monkeypatch, apart, words):
    monkeypatch.setattr(pace, "_EVERY", 0.0)
    made = reduction(own=True, apart=apart)
    with caplog.at_level(logging.INFO, "flexcage"):
        recovery = StressRecovery(
            made.model, made.basis, made.interface, places=WINDOW_PLACES, solver=made.solver
        )
        assert StressFields(recovery).forces.any()
    size = f"{made.model.n_dof:,} unknowns, {words}"
    begins = [m for m in caplog.messages if m.endswith(", once")]
    assert [m.split(" of ")[0] for m in begins] == ["modes", "stress fields"]
    assert all(f"own.msh ({size}): about" in m for m in begins)
    assert any(m.startswith("modes") and "left" in m for m in caplog.messages)
    assert any(m.startswith("stress") and "left" in m for m in caplog.messages)
    assert made.solver.solved is None
