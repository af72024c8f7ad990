"""What a mesh is worth: counts, element quality, mass properties; and what is wrong with it."""

from __future__ import annotations

import difflib
import itertools
from collections.abc import Iterable
from dataclasses import dataclass
from math import pi

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from flexcage.core.errors import InputError
from flexcage.core.listing import aligned
from flexcage.mesh.cage_mesh import (
    POCKET_GROUPS,
    RING_GROUPS,
    WALL_GROUPS,
    CageMesh,
    group_names,
    pocket_groups,
    signed_volumes,
)
from flexcage.mesh.measure import in_pocket_frame

_PLACE = {POCKET_GROUPS: "side+x", WALL_GROUPS: "wall"}  # the group that says where a pocket is
_SIDES = {"front": (2, 1), "rear": (2, -1), "side+x": (0, 1), "side-x": (0, -1)}  # axis and sign
_EDGES = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])


@dataclass(frozen=True)
class MeshReport:
    """Counts, quality and mass properties of a mesh of straight tetrahedra, in SI.

    Quality is the mean ratio, 12 (3V)^(2/3) over the sum of squared edges: 1 for a regular
    tetrahedron, 0 for a flat one. ``inertia`` (3, 3) is about the mass centre; it and ``mass``
    are None without a density. An undamaged cage has its mass centre at the origin.
    """

    n_points: int
    n_tets: int
    quadratic_nodes: int
    min_quality: float
    mean_quality: float
    volume: float
    min_volume: float
    inverted: int
    mass_centre: np.ndarray
    mass: float | None = None
    inertia: np.ndarray | None = None
    defects: tuple[dict, ...] = ()

    @property
    def mass_centre_shift(self) -> float:
        """Distance [m] of the mass centre from the cage's centre."""
        return float(np.linalg.norm(self.mass_centre))

    def __str__(self) -> str:
        centre = ", ".join(f"{round(1e6 * c, 2) + 0.0:.2f}" for c in self.mass_centre)
        rows = [
            ("vertices", f"{self.n_points:,}"),
            ("tetrahedra", f"{self.n_tets:,}"),
            ("nodes if quadratic", f"{self.quadratic_nodes:,}"),
            ("element quality, least / mean", f"{self.min_quality:.3f} / {self.mean_quality:.3f}"),
            ("inverted elements", f"{self.inverted}"),
            ("volume", f"{self.volume * 1e9:.3f} mm^3"),
            ("smallest element", f"{self.min_volume * 1e9:.3e} mm^3"),
            ("mass centre x, y, z", f"{centre} um"),
        ]
        if self.mass is not None and self.inertia is not None:
            moments = " / ".join(f"{1e6 * m:.3f}" for m in np.diag(self.inertia))
            rows += [
                ("mass", f"{self.mass * 1e3:.3f} g"),
                ("moments of inertia xx / yy / zz", f"{moments} kg mm^2"),
            ]
        for d in self.defects:
            rows.append((f"defect {d['kind']}", _defect_text(d)))
        return aligned(rows)


def _defect_text(d: dict) -> str:
    text = f"asked {d['asked'] * 1e3:+.4f} mm, delivered {d['delivered'] * 1e3:+.4f} mm"
    change = d["volume_change"]
    return text if np.isnan(change) else f"{text}, volume {1e2 * change:+.2e} %"


def count_edges(tets: np.ndarray) -> int:
    """Number of distinct edges: mid-side nodes of the quadratic element."""
    pairs = np.sort(tets[:, _EDGES].reshape(-1, 2), axis=1).astype(np.int64)
    return len(np.unique(pairs[:, 0] * (int(tets.max()) + 1) + pairs[:, 1]))


def report_mesh(mesh: CageMesh, *, density: float | None = None) -> MeshReport:
    """Measure a mesh; ``density`` [kg/m^3] adds mass and inertia."""
    corners = mesh.points[mesh.tets]  # (n, 4, 3)
    volumes = signed_volumes(mesh.points, mesh.tets)
    edges = corners[:, _EDGES[:, 0]] - corners[:, _EDGES[:, 1]]
    quality = 12.0 * np.cbrt(3.0 * np.abs(volumes)) ** 2 / (edges**2).sum(axis=(1, 2))
    quality = quality * np.sign(volumes)
    volume = float(volumes.sum())
    centre = np.einsum("n,nij->j", volumes, corners) / (4.0 * volume)
    defects = mesh.info.get("defects", ())
    return MeshReport(
        n_points=len(mesh.points),
        n_tets=len(mesh.tets),
        quadratic_nodes=len(mesh.points) + count_edges(mesh.tets),
        min_quality=float(quality.min()),
        mean_quality=float(quality.mean()),
        volume=volume,
        min_volume=float(volumes.min()),
        inverted=int((volumes <= 0.0).sum()),
        mass_centre=centre,
        mass=None if density is None else density * volume,
        inertia=None if density is None else density * _inertia(corners - centre, volumes),
        defects=tuple(defects) if isinstance(defects, (list, tuple)) else (),
    )


def _inertia(corners: np.ndarray, volumes: np.ndarray) -> np.ndarray:
    """Inertia (3, 3) at unit density about the origin; exact for straight tetrahedra.

    The integral of x x^T over one of volume V is V/20 (sum of x_a x_a^T + s s^T), s the sum.
    """
    total = corners.sum(axis=1)
    second = np.einsum("n,nai,naj->ij", volumes, corners, corners)
    second += np.einsum("n,ni,nj->ij", volumes, total, total)
    second /= 20.0
    return np.trace(second) * np.eye(3) - second


def check_mesh(mesh: CageMesh, *, where: str = "the mesh") -> None:
    """Refuse a mesh that is inverted, falls apart, or lacks a group, or has one misplaced."""
    if len(mesh.tets) == 0:
        raise InputError(f"{where} has no tetrahedra", where="mesh")
    volumes = signed_volumes(mesh.points, mesh.tets)
    inverted = int((volumes <= 0.0).sum())
    if inverted:
        first = int(np.argmax(volumes <= 0.0))
        raise InputError(
            f"{where} has {inverted} inverted or flat elements, the first is number {first}; "
            "repair or refine it",
            where="mesh",
            value=inverted,
        )
    _check_connected(mesh, where)
    _check_groups(mesh, where)


def _check_connected(mesh: CageMesh, where: str) -> None:
    a, b = mesh.tets[:, [0, 0, 0]].ravel(), mesh.tets[:, 1:].ravel()
    n = len(mesh.points)
    pieces, label = connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(n, n)))
    if pieces > 1:
        loose = int(np.bincount(label).min())
        raise InputError(
            f"{where} falls apart into {pieces} pieces, the smallest of {loose} vertices; weld "
            "coincident vertices and leave none unused",
            where="mesh",
            value=pieces,
        )


def _check_groups(mesh: CageMesh, where: str) -> None:
    """Every group must be there, with every pocket at its own azimuth; fillets may be missing where
    a pocket's faces meet at edges."""
    parts = pocket_groups(mesh.groups)
    for name in group_names(mesh.pocket_count, fillets=False, parts=parts):
        if len(mesh.groups.get(name, ())) == 0:
            near = nearest_hint(name, mesh.groups)
            raise InputError(
                f"{where} has no surface group {name!r}{near}",
                where="mesh.groups",
                value=name,
            )
    for k in range(mesh.pocket_count):
        vertices = np.unique(mesh.groups[f"pocket{k}_{_PLACE[parts]}"])
        _, y, t = in_pocket_frame(mesh.points[vertices], k, mesh.pocket_count).mean(axis=0)
        if abs(np.arctan2(t, y)) > pi / mesh.pocket_count:
            raise InputError(
                f"{where} has pocket {k} at azimuth "
                f"{np.rad2deg(np.arctan2(t, y)) + 360.0 * k / mesh.pocket_count:.1f} deg from y "
                f"towards z, where {360.0 * k / mesh.pocket_count:.1f} deg belongs",
                where=f"mesh.groups pocket{k}",
            )
        _check_sides(mesh, k, parts, where)
        if "fillet" in parts and len(mesh.groups.get(f"pocket{k}_fillet", ())) == 0:
            _check_edges(mesh, k, where)


def _check_edges(mesh: CageMesh, pocket: int, where: str) -> None:
    for beam, side in itertools.product(("front", "rear"), ("side+x", "side-x")):
        one, other = (mesh.groups[f"pocket{pocket}_{face}"] for face in (beam, side))
        if len(np.intersect1d(one, other)) == 0:
            name = f"pocket{pocket}_fillet"
            raise InputError(
                f"{where} has no surface group {name!r}, and 'pocket{pocket}_{beam}' and "
                f"'pocket{pocket}_{side}' do not meet at an edge; give the rounded corners between "
                "them that name",
                where="mesh.groups",
                value=name,
            )


def _check_sides(mesh: CageMesh, pocket: int, parts: tuple[str, ...], where: str) -> None:
    for face, (axis, sign) in _SIDES.items():
        if face not in parts:
            continue
        vertices = np.unique(mesh.groups[f"pocket{pocket}_{face}"])
        place = in_pocket_frame(mesh.points[vertices], pocket, mesh.pocket_count).mean(axis=0)
        if sign * place[axis] <= 0.0:
            raise InputError(
                f"{where} has 'pocket{pocket}_{face}' on the other side of the pocket; front is "
                "towards +psi (from y to z), side+x towards +x",
                where=f"mesh.groups pocket{pocket}_{face}",
            )


def nearest_hint(name: str, present: Iterable[str]) -> str:
    """ "; nearest is 'x'" for the present name most like ``name``, whatever its case; or ''."""
    lower = {n.lower(): n for n in present if n not in RING_GROUPS or name in RING_GROUPS}
    match = difflib.get_close_matches(name.lower(), list(lower), n=1, cutoff=0.6)
    return f"; nearest is {lower[match[0]]!r}" if match else ""
