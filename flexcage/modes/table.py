"""The mode table: what each dynamic mode is, and how much pocket forces excite it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import POCKET_GROUPS, WALL_GROUPS, pocket_groups
from flexcage.modes.basis import ModeBasis
from flexcage.modes.pockets import pocket_frame, pocket_loads, vector_frames
from flexcage.modes.rows import row_models

_WINDOW = ("crossbeam", "side_beam")
_ROUND = ("web", "rim")
_NOTHING = 1e-15  # [kg] less is rounding, and shown as 0


@dataclass(frozen=True)
class ModeTable:
    """One row a dynamic mode.

    ``effective_mass`` [kg]: the part of the body's mass that translations along x, y, z couple to
    the mode; zero for modes of a free body, and a check that they are. ``share``: the part of the
    static deflection under a uniform force on a crossbeam (front face, pocket 0) and on a side
    beam (+x face) that the mode carries, of all dynamic modes and residual vectors together. With
    round pockets the forces are spread as a cosine over half of the wall, along +psi (on the web)
    and +x (on the rim).
    """

    frequency: np.ndarray  # (n,) Hz
    kind: tuple[str, ...]
    effective_mass: np.ndarray  # (n, 3)
    share: np.ndarray  # (n, 2)
    residual_share: np.ndarray  # (2,)
    loaded: tuple[str, str] = _WINDOW  # what the two forces act on

    def __str__(self) -> str:
        first, second = (name.replace("_", " ") for name in self.loaded)
        head = f"{'no':>4s}  {'kind':<12s} {'frequency':>12s} {'eff. mass':>10s}"
        lines = [
            f"{'':42s}  share of deflection under a force on",
            f"{head}  {first:>12s} {second:>12s}",
        ]
        for i, frequency in enumerate(self.frequency):
            row = f"{i + 1:4d}  {self.kind[i]:<12s} {frequency:9.1f} Hz"
            heaviest = self.effective_mass[i].max()
            mass = f"{1e3 * heaviest:8.1e} g" if heaviest > _NOTHING else f"{0:>8d} g"
            lines.append(f"{row} {mass}{_percent(self.share[i])}")
        lines.append(
            f"      {'residual':<12s} {'quasi-static':>12s} {'':10s}"
            + _percent(self.residual_share)
        )
        return "\n".join(lines)

    def columns(self) -> dict[str, np.ndarray]:
        """Named columns, for a file."""
        return {
            "frequency": self.frequency,
            "kind": np.array(self.kind),
            **{f"effective_mass_{a}": self.effective_mass[:, i] for i, a in enumerate("xyz")},
            **{f"share_{name}": self.share[:, i] for i, name in enumerate(self.loaded)},
        }


def _percent(shares: np.ndarray) -> str:
    return "  " + " ".join(f"{100.0 * share:10.2f} %" for share in shares)


def mode_table(model: FEModel, basis: ModeBasis, *, pocket_count: int) -> ModeTable:
    """Frequencies, kinds, effective masses and shares of static deflection of a basis."""
    shapes = basis.shapes.reshape(model.n_dof, -1)
    translation = np.einsum("i,ian->na", model.nodal_mass, basis.shapes)
    modal_mass = np.diag(basis.mass)
    names, loads = table_loads(model, pocket_count)
    work = shapes.T @ loads
    carried = work * np.linalg.solve(basis.stiffness, work)
    residual = np.zeros(2)
    if basis.residual is not None:
        assert basis.residual.shapes is not None, "a table is made with the basis"
        flat = basis.residual.shapes.reshape(model.n_dof, -1)
        pull = flat.T @ loads
        residual = np.sum(pull * np.linalg.solve(basis.residual.stiffness, pull), axis=0)
    total = carried.sum(axis=0) + residual
    return ModeTable(
        frequency=basis.frequencies,
        kind=basis.kind,
        effective_mass=translation**2 / modal_mass[:, None],
        share=carried / total,
        residual_share=residual / total,
        loaded=names,
    )


def table_loads(model: FEModel, pocket_count: int) -> tuple[tuple[str, str], np.ndarray]:
    """What the two forces of the table act on, and their nodal loads (3N, 2) [N]."""
    rows = row_models(model)
    return _LOADS[pocket_groups(model.groups)](rows[0], pocket_count // len(rows))


def _on_faces(model: FEModel, pocket_count: int) -> tuple[tuple[str, str], np.ndarray]:
    return _WINDOW, pocket_loads(model, 0, pocket_count)[:, [0, 4]]


def _on_wall(model: FEModel, pocket_count: int) -> tuple[tuple[str, str], np.ndarray]:
    frame, ways = pocket_frame(0, pocket_count), vector_frames(model, pocket_count)[0]

    def cosines(points: np.ndarray) -> np.ndarray:
        x, _, t = frame @ points.T
        return np.maximum(np.stack([t, x]), 0.0) / np.hypot(x, t)

    weights = model.face_weights(model.group("pocket0_wall"), cosines).toarray()
    spread = weights / weights.sum(axis=1, keepdims=True)
    loads = [np.outer(row, ways[axis]).ravel() for row, axis in zip(spread, (2, 0))]
    return _ROUND, np.stack(loads, axis=1)


_LOADS = {POCKET_GROUPS: _on_faces, WALL_GROUPS: _on_wall}
