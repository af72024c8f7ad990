"""Places of stress of a cage of several rows: those that each row has in its own frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.mesh.rows import RowFrame, rows_in
from flexcage.modes.rows import row_models
from flexcage.stress.fillets import Arrays, Fillet
from flexcage.stress.places import StressPlaces

Kept = Callable[[str, Callable[[], Arrays]], Arrays]


def roots_of(places: StressPlaces, model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """Vertices of every named place; pockets of further rows count on."""
    found: dict[str, np.ndarray] = {}
    for first, frame, row, count in _rows(model, pocket_count):
        for name, vertices in places.roots(row, count).items():
            pocket, _, part = name.partition("_")
            own = vertices if frame is None else vertices[_on_side(row, frame)[vertices]]
            found[f"pocket{int(pocket[6:]) + first}_{part}"] = own
    return found


def contact_zone_of(places: StressPlaces, model: FEModel, pocket_count: int) -> np.ndarray:
    """Vertices that the search for a peak leaves out, of all rows."""
    rows = _rows(model, pocket_count)
    found: np.ndarray = np.unique(
        np.concatenate([places.contact_zone(row, count) for _, _, row, count in rows])
    )
    return found


def fillets_of(
    places: StressPlaces, model: FEModel, interface: Any, pocket_count: int, keep: Kept
) -> list[Fillet]:
    """Submodels of the pockets' corners, each row's kept under a name of its own."""
    found: list[Fillet] = []
    for first, frame, row, count in _rows(model, pocket_count):
        name = f"fillets{first}" if first else "fillets"
        own = places.fillets(row, interface, count, lambda make, n=name: keep(n, make))  # type: ignore[misc]
        found += own if frame is None else [_in_cage(fillet, first, frame) for fillet in own]
    return found


def _rows(model: FEModel, pocket_count: int) -> Iterator[tuple[int, RowFrame | None, FEModel, int]]:
    """First pocket, frame (None of a single row), model in it and number of pockets of each row."""
    models, frames = row_models(model), rows_in(model.info) or (None,)
    count = pocket_count // len(models)
    for k, (row, frame) in enumerate(zip(models, frames)):
        yield k * count, frame, row, count


def _on_side(row: FEModel, frame: RowFrame) -> np.ndarray:
    """Which vertices lie on the row's side of the middle plane, or in it."""
    middle = -frame.sign * frame.place  # in the row's frame
    outward = np.sign(frame.sign * frame.place)
    beyond: np.ndarray = outward * (row.points[:, 0] - middle) > -1e-6 * abs(middle)
    return beyond


def _in_cage(fillet: Fillet, first: int, frame: RowFrame) -> Fillet:
    """A row's fillet by the cage's pockets and frame."""
    corner = fillet.corner
    return replace(
        fillet,
        corner=replace(
            corner, pocket=corner.pocket + first, frame=corner.frame @ frame.axes, sign=frame.sign
        ),
    )  # fmt: skip
