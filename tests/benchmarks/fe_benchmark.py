"""From a case to its modes: wall times of every stage, and peak memory."""

from __future__ import annotations

import resource
import sys
import time
from typing import Any

import flexcage
from flexcage.cages.window.interface import cage_interface
from flexcage.core.timing import Stages
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.modes.registry import build_basis
from flexcage.stages import cage_mesh

QUICK: dict[str, Any] = {}  # whether it runs: what takes long is the case's


def measure(case: flexcage.Case, *, solver_kind: str = "auto") -> dict[str, Any]:
    """Figures of one pass without any cache."""
    import gmsh  # noqa: F401  (imports are not measured)
    import skfem  # noqa: F401

    started, stages = time.process_time(), Stages()
    mesh = stages("mesh", cage_mesh, case)
    model = stages("assemble", assemble, mesh, case.cage.material, order=case.mesh.order)
    solver = stages("modes", FreeBodySolver, model, kind=solver_kind)
    count = case.bearing.roller_count
    basis = stages("modes", build_basis, model, pocket_count=count, spec=case.modes, solver=solver)
    stages(
        "modes", cage_interface, model, basis, pocket_count=count, cage=case.cage,
        defects=case.defects,
    )  # fmt: skip
    spent = time.process_time() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return {
        "nodes": len(model.nodes),
        **{f"{name}_s": round(seconds, 3) for name, seconds in stages.items()},
        "total_s": round(sum(stages.values()), 3),
        "cpu_s": round(spent, 3),
        "peak_rss_gb": round(peak * (1 if sys.platform == "darwin" else 1024) / 1e9, 3),
        "tetrahedra": len(model.tets),
        "modes": basis.size,
        "first_frequency_hz": round(float(basis.frequencies[0]), 2),
        "solver": solver.solver.name,
    }
