"""Sizes of the cage that a run's folder keeps: compared with the run's own before kernels read it.

Kernels do not look where an array ends, and a file may be crafted: one mode or pocket less there
than in the results would be read beyond its end.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.cages.build import rigid_interface_of
from flexcage.case import Case
from flexcage.core.arrays import SPARSE
from flexcage.core.errors import InputError
from flexcage.core.registry import source_of
from flexcage.results.cage_file import CageRecord

Arrays = Mapping[str, np.ndarray]
Shape = tuple[int, ...]

# names stand for sizes; arrays in the second table may be missing
_MODES = ("mode", "mode")
_SHAPES: Mapping[str, Mapping[str, tuple[str | int, ...]]] = {
    "mesh": {
        "points": ("point", 3), "tets": ("tet", 4), "triangles": ("triangle", 3),
        "group_names": ("group",), "group_sizes": ("group",), "pocket_count": (), "info": (),
    },
    "basis": {
        "steps": ("node", 3, "mode"), "step": ("mode",), "stiffness": _MODES, "mass": _MODES,
        "frequencies": ("mode",), "kind": ("mode",), "name": (), "digest": (),
    },
    "table": {
        "frequency": ("mode",), "kind": ("mode",), "effective_mass": ("mode", 3),
        "share": ("mode", 2), "residual_share": (2,), "loaded": (2,),
    },
    "body": {
        "mass": (), "c0": (3,), "C": (3, "mode"), "G0": (3, 3), "S": (6, "mode"),
        "X": (3, "mode"), "SS": ("mode", 6, "mode"), "XX": ("mode", 3, "mode"), "mff": _MODES,
        "kff": _MODES, "dff": _MODES, "gff": ("stiffening", "stiffening"), "plain": (),
    },
}  # fmt: skip
_OPTIONAL: Mapping[str, Mapping[str, tuple[str | int, ...]]] = {
    "basis": {
        "geometric": _MODES, "fit": ("fit",), "r_stiffness": ("residual", "residual"),
        "r_compliance": ("pocket", "own", "own"), "r_far": (),
    }
}  # fmt: skip


def check_sizes(record: CageRecord, case: Case, modes: int, path: Path) -> None:
    """InputError where an array of the record in ``path`` is missing or has another size than the
    case's cage with so many dynamic modes has in the results (0: rigid)."""
    wanted = {"mesh", "basis", "interface", "table", "body"} if modes else {"mesh"}
    found = record.groups
    large = {"mesh", "basis"} if "mesh" not in found and modes else set()  # output.keep_cage
    if set(found) != wanted - large:
        raise _another(path, f"it holds {', '.join(sorted(found)) or 'nothing'}")
    sizes = _Sizes(path, {"mode": modes, "pocket": case.bearing.total_elements})
    for group, shapes in _SHAPES.items():
        if group in found:
            sizes.check(group, found[group], shapes, _OPTIONAL.get(group, {}))
    sizes.of_mesh(found.get("mesh"), case)
    sizes.of_basis(found.get("basis"), found.get("body"))
    if "interface" in found:
        sizes.of_interface(found["interface"], case)


class _Sizes:
    """Sizes by name; one that is not known yet is that of the first array that has it."""

    def __init__(self, path: Path, known: dict[str, int]) -> None:
        self.path, self.known = path, known

    def check(
        self,
        group: str,
        arrays: Arrays,
        shapes: Mapping[str, tuple[str | int, ...]],
        optional: Mapping[str, tuple[str | int, ...]],
    ) -> None:
        """Compare the arrays of a group with shapes of numbers and names."""
        for name, shape in {**shapes, **optional}.items():
            if name not in arrays and name in optional:
                continue
            self.same(f"{group}.{name}", arrays.get(name), shape)

    def same(self, name: str, array: np.ndarray | None, shape: tuple[str | int, ...]) -> None:
        """Compare one array; a name that is new gets its size."""
        if array is None:
            raise _another(self.path, f"it has no {name}")
        if array.ndim == len(shape):
            for axis, size in zip(shape, array.shape):
                if isinstance(axis, str):
                    self.known.setdefault(axis, size)
        due = tuple(self.known.get(a, 0) if isinstance(a, str) else a for a in shape)
        if array.shape != due:
            raise _another(self.path, f"{name} has the shape {array.shape}, not {due}")

    def of_mesh(self, mesh: Arrays | None, case: Case) -> None:
        """Nodes of its elements, and as many pockets as the bearing has elements."""
        if mesh is None:
            return
        count = int(mesh["pocket_count"])
        if count != (due := case.bearing.element_count):
            raise _another(self.path, f"it has {count} pockets, not {due}")
        if mesh["group_sizes"].sum() != self.known["triangle"] or mesh["group_sizes"].min() < 0:
            raise _another(self.path, "its groups have other triangles than it holds")
        nodes = self.known["point"]
        if case.mesh.order == 2:
            nodes += _edges(mesh["tets"])
        if self.known.setdefault("node", nodes) != nodes:
            raise _another(self.path, f"its shapes have {self.known['node']} nodes, not {nodes}")

    def of_basis(self, basis: Arrays | None, body: Arrays | None) -> None:
        """Residual vectors of every pocket; and stiffening of all modes, or of none."""
        if basis is not None and "r_stiffness" in basis:
            own, pockets = self.known["own"], self.known["pocket"]
            if self.known["residual"] != own * pockets:
                raise _another(
                    self.path,
                    f"{self.known['residual']} residual vectors, not {own} for each of "
                    f"{pockets} pockets",
                )
        if body is not None and self.known["stiffening"] not in (0, self.known["mode"]):
            raise _another(self.path, f"body.gff has the shape {body['gff'].shape}")

    def of_interface(self, arrays: Arrays, case: Case) -> None:
        """The interface of the case's cage: that of a rigid one, with modes and nodes."""
        rigid: Any = rigid_interface_of(
            case.its_cage, pocket_count=case.bearing.element_count, defects=case.all_defects,
            places=case.bearing.row_places,
        )  # fmt: skip
        names = set()
        for field in fields(rigid):
            like = getattr(rigid, field.name)
            if like is not None:
                names.add(field.name)
                shape = tuple(size or "mode" for size in np.shape(like))
                self.same(f"interface.{field.name}", arrays.get(field.name), shape)
        sparse = [name for name in arrays if name.split(".")[-1] in SPARSE and "." in name]
        for name in {name.rpartition(".")[0] for name in sparse}:
            columns = int(arrays[f"{name}.shape"][-1])
            if self.known.setdefault("node", columns) != columns:
                raise _another(
                    self.path, f"interface.{name} has {columns} nodes, not {self.known['node']}"
                )
        over = set(arrays) - names - set(sparse)
        if over and not source_of(case.its_cage.cage_type):
            raise _another(self.path, f"it has interface.{min(over)}, which such a cage has not")


def _edges(tets: np.ndarray) -> int:
    """How many edges these tetrahedra (n, 4) have."""
    pairs = np.sort(tets[:, [0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3]].reshape(-1, 2), axis=1)
    keys = pairs[:, 0].astype(np.int64) * (int(tets.max(initial=0)) + 1) + pairs[:, 1]
    return len(np.unique(keys))


def _another(path: Path, what: str) -> InputError:
    return InputError(
        f"'{path}' is not the cage of this run: {what}; bring its own file back from a copy, or "
        "run the case again.",
        where="cage",
        value=str(path),
    )
