"""The study over three meshes: the error of stresses, and the picture of the pinched roller."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from claims import BENT2, SHORTER, SOUND
from judging.page import Table
from judging.pictures import rendered
from judging.readings import NoRuns

from flexcage.study import StudyResults

STUDY, MPA = "mesh", 1e-6
MESHES = ("coarse", "medium", "fine")
NAMES = {SOUND: "undeformed", BENT2: "crossbeam 0.2 mm", SHORTER: "side beam -0.3 mm"}


def mesh_study(computed) -> StudyResults | None:
    """The study over three meshes, where it is there."""
    path = computed.out / STUDY
    return StudyResults(path) if path.is_dir() else None


def pinch(computed, folder: Path) -> str:
    """Roller j in the pocket whose side beam is moved by -0.3 mm, medium mesh; the file's name."""
    found = mesh_study(computed)
    if found is None:
        raise NoRuns("The study over three meshes is not there; compute it first.")
    row = next(r for r in found.rows if _at(r, SHORTER) and _fineness(r) == "medium")
    return rendered(found.run(row.planned.number), "stress_pocket", folder / "pinch.png")


def mesh_errors(computed) -> Table | None:
    """Stress of the corners, mean of the largest of every pass, on three meshes; none without the
    study."""
    found = mesh_study(computed)
    if found is None:
        return None
    rows = []
    for condition in (SOUND, BENT2, SHORTER):
        by = {_fineness(r): r.figures["corner"].value * MPA for r in found.rows
              if _at(r, condition) and r.state == "done"}  # fmt: skip
        error = by["coarse"] / by["fine"] - 1.0 if "coarse" in by and "fine" in by else np.nan
        cells = (f"{by[m]:.0f} MPa" if m in by else "-" for m in MESHES)
        rows.append((NAMES[condition], *cells, f"{error:+.0%}"))
    title = "Error of the mesh: stress of the corners, one start of 60 ms"
    return Table(title, ("cage", *MESHES, "coarse against fine"), rows)


def _at(row, condition: str) -> bool:
    return row.planned.point.labels["condition"] == condition


def _fineness(row) -> str:
    return row.planned.point.values["mesh.fineness"]
