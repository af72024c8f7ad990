"""Modes and stress fields of a mesh from another program, beside the ring factored as a whole."""

from __future__ import annotations

import dataclasses
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

import flexcage
from flexcage.cages import cage_type_of
from flexcage.cages.build import reduction_of
from flexcage.core.threads import on_one_core
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.linear import available_kinds
from flexcage.fem.model import assemble
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.stages import cage_mesh
from flexcage.stress.fields import StressFields
from flexcage.stress.recovery import StressRecovery

sys.path.append(str(Path(__file__).resolve().parents[1]))
from own_mesh import renumbered

QUICK: dict[str, Any] = {}  # whether it runs: what takes long is the case's
_WHOLE_LIMIT = 150_000  # unknowns up to which SuperLU was taken for the whole ring
_APART = 1e-6  # [m] by which points are moved for a mesh that does not repeat


@on_one_core
def measure(case: flexcage.Case) -> dict[str, Any]:
    """Processor seconds of both ways, one after the other, and their ratios, of the case's mesh
    renumbered: as it is ("repeats_"), and with its points moved at random ("free_")."""
    built = cage_mesh(case)
    figures: dict[str, Any] = {}
    for name, apart in (("repeats", 0.0), ("free", _APART)):
        mesh = _from_file(built, apart)
        plain = dataclasses.replace(mesh, info=MappingProxyType({}))
        ours = _seconds(case, mesh, "auto")
        whole = _seconds(case, plain, _kind_of_the_whole(case, plain))
        figures |= {f"{name}_{step}_s": round(s, 2) for step, s in ours.items()}
        figures |= {f"{name}_{step}_whole_s": round(s, 2) for step, s in whole.items()}
        figures |= {f"{name}_{step}_ratio": round(ours[step] / whole[step], 2) for step in ours}
    return figures


def _from_file(built: CageMesh, apart: float) -> CageMesh:
    mesh = renumbered(built)
    moves = np.random.default_rng(0).uniform(-apart, apart, mesh.points.shape)
    with tempfile.TemporaryDirectory() as folder:
        moved = dataclasses.replace(mesh, points=mesh.points + moves)
        return read_mesh(write_mesh(moved, Path(folder) / "own.msh"))


def _kind_of_the_whole(case: flexcage.Case, mesh: CageMesh) -> str:
    unknowns = assemble(mesh, case.cage.material, order=case.mesh.order).n_dof
    return "superlu" if unknowns <= _WHOLE_LIMIT else available_kinds()[0]


def _seconds(case: flexcage.Case, mesh: CageMesh, kind: str) -> dict[str, float]:
    cage = reduction_of(
        mesh, cage=case.cage, defects=case.all_defects, spec=case.modes, order=case.mesh.order
    )
    cage.__dict__["solver"] = FreeBodySolver(cage.model, kind=kind)
    modes = _timed(lambda: (cage._make_basis(), cage.solver.factor()))
    places = cage_type_of(case.cage).places()
    recovery = StressRecovery(
        cage.model, cage.basis, cage.interface, places=places, solver=cage.solver
    )
    fields = StressFields(recovery)
    return {"modes": modes, "stress": _timed(lambda: (fields.forces, fields.land_forces))}


def _timed(work: Callable[[], Any]) -> float:
    started = time.process_time()
    work()
    return time.process_time() - started
