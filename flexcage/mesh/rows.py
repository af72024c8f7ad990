"""The rows of a cage for several rows of elements, and their halves side by side as one mesh.

Pockets of the second row count on from the first one's. Each row has a frame of its own, in which
its half is meshed, damaged and touched; sides of pockets (``side+x``) are those in it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from flexcage.geometry.bearing import RowPlace
from flexcage.mesh.cage_mesh import FACE_AXES, CageMesh
from flexcage.mesh.ring import turn_about_x

ROWS = "rows"  # in the ``info`` of a mesh of several rows
ENDS = {1.0: "end+x", -1.0: "end-x"}
_ALIKE = ("source", "size", "fillet_edges", FACE_AXES)  # in the ``info`` of all halves


@dataclass(frozen=True)
class RowFrame:
    """Where a row of pockets is: its middle on the axis [m], the azimuth [rad] of its first pocket,
    and the ``sign`` of its own x in the cage's frame, -1 of a mirror image."""

    place: float = 0.0
    turned: float = 0.0
    sign: float = 1.0

    @property
    def axes(self) -> np.ndarray:
        """Rows: the axes (3, 3) of the row's frame, in the cage's."""
        axes: np.ndarray = np.diag([self.sign, 1.0, 1.0]) @ turn_about_x(self.turned).T
        return axes

    def into(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 3) [m] of the cage in the row's frame."""
        return (points - np.array([self.place, 0.0, 0.0])) @ self.axes.T

    def out_of(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 3) [m] in the row's frame as points of the cage."""
        return points @ self.axes + np.array([self.place, 0.0, 0.0])


def row_frames(places: Sequence[RowPlace], signs: Sequence[float]) -> tuple[RowFrame, ...]:
    """Frames of the rows at these places."""
    return tuple(RowFrame(p.place, p.turned, sign) for p, sign in zip(places, signs))


def rows_in(info: Mapping[str, object]) -> tuple[RowFrame, ...]:
    """Frames of the rows of a mesh with such an ``info``; none of a mesh of one row."""
    rows: Sequence[Sequence[float]] = info.get(ROWS, ())  # type: ignore[assignment]
    return tuple(RowFrame(*map(float, row)) for row in rows)


def frame_of(info: Mapping[str, object], pocket: float, pocket_count: int) -> RowFrame:
    """The frame of the row of a pocket, or of a part beside it, in a mesh with so many pockets a
    row."""
    rows = rows_in(info)
    return rows[int(pocket + 0.5) // pocket_count] if rows else RowFrame()


def pockets_at(points: np.ndarray, pocket_count: int, rows: Sequence[RowFrame] = ()) -> np.ndarray:
    """Numbers (n,) of the pockets whose middles are nearest to points (n, 3): of the nearest row,
    in azimuth."""
    rows = rows or (RowFrame(),)
    azimuth = np.arctan2(points[:, 2], points[:, 1])
    row = np.argmin([np.abs(points[:, 0] - frame.place) for frame in rows], axis=0)
    turned = np.array([frame.turned for frame in rows])[row]
    own = np.round((azimuth - turned) * pocket_count / (2.0 * np.pi)).astype(int) % pocket_count
    found: np.ndarray = row * pocket_count + own
    return found


def in_rows(halves: Sequence[CageMesh], frames: Sequence[RowFrame]) -> CageMesh:
    """The ``halves``, each in its row's frame, beside each other: no elastic body."""
    first = np.cumsum([0, *[len(half.points) for half in halves[:-1]]])
    number = [np.arange(len(half.points)) + n for half, n in zip(halves, first)]
    return CageMesh(
        points=np.concatenate([f.out_of(half.points) for half, f in zip(halves, frames)]),
        tets=np.concatenate([cells_in(h, f, n) for h, f, n in zip(halves, frames, number)]),
        groups=groups_in(halves, frames, number),
        pocket_count=halves[0].pocket_count,
        info=info_of(halves, frames),
    )


def cells_in(half: CageMesh, frame: RowFrame, number: np.ndarray) -> np.ndarray:
    """Tetrahedra of a half by the ``number`` of its vertices in the whole, positive there."""
    return number[half.tets[:, [0, 1, 2, 3] if frame.sign > 0.0 else [1, 0, 2, 3]]]


def groups_in(
    halves: Sequence[CageMesh], frames: Sequence[RowFrame], number: Sequence[np.ndarray],
    *, without: Sequence[str] = (),
) -> Mapping[str, np.ndarray]:  # fmt: skip
    """Groups of the whole, outward there; ``without`` one of every half, by its name in it."""
    found: dict[str, list[np.ndarray]] = {}
    for row, (half, frame, own) in enumerate(zip(halves, frames, number)):
        for name, triangles in half.groups.items():
            if name in without[row : row + 1]:
                continue
            outward = triangles if frame.sign > 0.0 else triangles[:, ::-1]
            whole = _name(name, row * half.pocket_count, frame.sign)
            found.setdefault(whole, []).append(own[outward])
    return MappingProxyType({name: np.concatenate(made) for name, made in found.items()})


def _name(name: str, first: int, sign: float) -> str:
    """What a group of a half, whose pockets count from ``first``, is called in the whole cage."""
    pocket, _, part = name.partition("_")
    if pocket.startswith("pocket"):
        return f"pocket{int(pocket[6:]) + first}_{part}"
    return next((ENDS[sign * own] for own, end in ENDS.items() if name == end), name)


def info_of(halves: Sequence[CageMesh], frames: Sequence[RowFrame]) -> Mapping[str, object]:
    """What is known of the whole, but for how its vertices are numbered."""
    every = [half.info for half in halves]
    sizes = [float(i.get("undamaged_volume", h.volume)) for i, h in zip(every, halves)]  # type: ignore[arg-type]
    reports: list[object] = []
    for own in every:
        reports += own.get("defects", ())  # type: ignore[arg-type]
    return MappingProxyType({
        **{key: every[0][key] for key in _ALIKE if key in every[0]},
        ROWS: tuple((f.place, f.turned, f.sign) for f in frames),
        "defects": reports,
        "undamaged_volume": sum(sizes),
        "volume_change": sum(half.volume for half in halves) / sum(sizes) - 1.0,
    })  # fmt: skip
