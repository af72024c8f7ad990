"""The mesh of a cage: straight tetrahedra with named groups of boundary triangles."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import numpy as np

POCKET_GROUPS = ("front", "rear", "side+x", "side-x", "fillet")  # of window cages
WALL_GROUPS = ("wall",)  # of cages with round pockets
RING_GROUPS = ("land_inner", "land_outer", "end+x", "end-x")
FACE_AXES = "face_axes"  # in a mesh's ``info``
_WALL = re.compile(r"pocket\d+_wall")


def pocket_groups(names: Iterable[str]) -> tuple[str, ...]:
    """What the groups of one pocket are called in a mesh that has groups of these names."""
    return WALL_GROUPS if any(_WALL.fullmatch(name) for name in names) else POCKET_GROUPS


def group_names(
    pocket_count: int, *, fillets: bool = True, parts: Sequence[str] = POCKET_GROUPS
) -> list[str]:
    """Names of all groups of a cage, rings first, then pocket by pocket; their order is fixed."""
    parts = [part for part in parts if fillets or part != "fillet"]
    return [*RING_GROUPS, *(f"pocket{k}_{part}" for k in range(pocket_count) for part in parts)]


def signed_volumes(points: np.ndarray, tets: np.ndarray) -> np.ndarray:
    """Signed volumes (n_tets,) [m^3]; negative for an inverted tetrahedron."""
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0


@dataclass(frozen=True)
class CageMesh:
    """A cage of straight 4-node tetrahedra, in metres, in the cage frame (x: bearing axis).

    ``groups`` maps a name to (n, 3) vertex indices of boundary triangles, outward orientation.
    Names, for every pocket k: ``pocket{k}_front`` (crossbeam face at +psi of the pocket),
    ``pocket{k}_rear`` (at -psi), ``pocket{k}_side+x``, ``pocket{k}_side-x`` (side-beam faces),
    ``pocket{k}_fillet`` (all four corners), or ``pocket{k}_wall`` alone where pockets are round;
    and ``land_inner``, ``land_outer`` (bore and outside),
    ``end+x``, ``end-x`` (of a crown cage: the claws' tips and the ring's back). Pocket k is
    centred at azimuth 2 pi k/Z from y towards z.

    ``info`` of a built mesh holds ``sector_points`` and ``sector_cells``: vertex i of sector k is
    ``i + k sector_points`` (modulo the whole), cell c of it ``c + k sector_cells``, and every
    sector is the first one turned by 2 pi k/Z, except those in ``altered_sectors``, whose
    vertices a defect moved. Where cracks and missing rivets doubled vertices, the copies come last,
    and ``doubled`` says of which. Of a mesh from a file that repeats, ``following`` (n_points,) is
    the vertex that has a vertex's place in the next sector, and ``sector_tets`` (Z, n) the cells of
    all sectors. ``defects`` lists what each defect delivered. ``face_axes`` says how pockets' faces
    lie in cages that are no cylinders (``modes.pockets.FaceAxes``).
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

    def __getstate__(self) -> dict:
        # a mapping proxy cannot be pickled, and workers receive meshes by pickle
        return {**self.__dict__, "groups": dict(self.groups), "info": dict(self.info)}

    def __setstate__(self, state: dict) -> None:
        proxies = {key: MappingProxyType(state[key]) for key in ("groups", "info")}
        self.__dict__.update({**state, **proxies})

    @cached_property
    def volume(self) -> float:
        """Volume [m^3], the sum of signed tetrahedra."""
        return float(signed_volumes(self.points, self.tets).sum())
