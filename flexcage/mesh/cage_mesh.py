"""The mesh of a cage: straight tetrahedra with named groups of boundary triangles."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Mapping

import numpy as np


@dataclass(frozen=True)
class CageMesh:
    """A cage of straight 4-node tetrahedra, in metres, in the cage frame (x: bearing axis).

    ``groups`` maps a name to (n, 3) vertex indices of boundary triangles, outward orientation.
    Names, for every pocket k: ``pocket{k}_front`` (crossbeam face at +psi of the pocket),
    ``pocket{k}_rear`` (at -psi), ``pocket{k}_side+x``, ``pocket{k}_side-x`` (side-beam faces),
    ``pocket{k}_fillet``; and ``land_inner``, ``land_outer`` (bore and outside), ``end+x``, ``end-x``.
    Pocket k is centred at azimuth 2 pi k/Z from y towards z.
    ``sector``: vertex and cell numbers repeat sector by sector, if the mesh is such a copy.
    """

    points: np.ndarray  # (n_points, 3) float64
    tets: np.ndarray  # (n_tets, 4) int64
    groups: Mapping[str, np.ndarray] = field(default_factory=lambda: MappingProxyType({}))
    pocket_count: int = 0
    info: Mapping[str, object] = field(default_factory=lambda: MappingProxyType({}))

    def __repr__(self) -> str:
        return (
            f"CageMesh({len(self.points):,} points, {len(self.tets):,} tetrahedra, "
            f"{self.pocket_count} pockets, {len(self.groups)} groups)"
        )

    @property
    def volume(self) -> float:
        """Volume [m^3], the sum of signed tetrahedra."""
        a, b, c, d = (self.points[self.tets[:, i]] for i in range(4))
        return float(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6.0)
