"""A user's mesh beside the cage that the case describes: is it in its place, are its groups whole?

Contact is computed from the case's geometry and the mesh only says how the cage gives way; so what
lies elsewhere, or leaves out part of a face, would couple forces to the wrong places in silence.
The described cage is meshed coarsely, with its defects, and held beside the file's boundary.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import degrees

import numpy as np
from scipy.spatial import cKDTree

from flexcage.core.errors import FlexcageError, InputError
from flexcage.mesh.cage_mesh import RING_GROUPS, CageMesh
from flexcage.mesh.files.sound import coincident
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import report_mesh

COARSE = MeshOptions(fineness="coarse")  # of the cage that the case describes

log = logging.getLogger(__name__)

# m, that the mesh may lie elsewhere: what sizes of pockets may differ by; and half of the 0.2 mm
# that a pocket's clearance usually is, beyond which forces act where there is no contact
_SAID, _MOST = 20e-6, 100e-6
# of a face's area that its group may lack: a pocket's face has seven contact stations or more, so
# that a twentieth leaves each most of its part; a hundredth is an odd triangle
_SAID_LACK, _MOST_LACK = 0.01, 0.05
_OWN_SHAPE = 0.1  # by which area, volume or inertia of a cage of one's own differs without a word
_ALIKE = 0.5  # largest difference of unit normals, about 30 deg, of one and the same face
_PLANE = 0.03  # the same of triangles of one plane
_SAMPLES = 5  # along a triangle's edge
_TURNS = 8  # of the search for how the mesh lies


def check_place(mesh: CageMesh, described: Callable[[], CageMesh], *, source: str) -> None:
    """Compare a file's mesh with that of the cage and defects that the case describes.

    InputError where groups are swapped or lack much of their faces, or the mesh lies elsewhere, and
    by how much; a warning where it is little, or where the cage has a shape of its own.
    """
    try:
        said = described()
    except FlexcageError as error:
        log.warning(
            "%s cannot be compared with the cage that the case describes, which has no mesh (%s); "
            "see that its pockets are where the case has them", source, error,
        )  # fmt: skip
        return
    found, wanted = Skin(mesh), Skin(said)
    _refuse_swapped(found, wanted, source)
    _refuse_short(found, wanted, source)
    moved = _check_motion(found, wanted, source)
    _check_cover(found, wanted, source)
    _check_rings(mesh, said, source, ends=not moved)
    _check_body(mesh, said, source)
    if (open_at := mesh.info.get("in_one_place")) and not len(coincident(said.points)):
        log.warning(
            "%s: %s lie in the place of others: the mesh is open between them as at a crack, and "
            "the case has none; merge them if they belong together", source, open_at,
        )  # fmt: skip


@dataclass(frozen=True)
class Skin:
    """The boundary of a mesh: its triangles and the groups that they are in."""

    mesh: CageMesh

    @cached_property
    def names(self) -> list[str]:
        return [name for name, rows in self.mesh.groups.items() if len(rows)]

    @cached_property
    def triangles(self) -> np.ndarray:
        """All boundary triangles (n, 3), seen from outside: those of groups first."""
        faces = self.mesh.tets[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
        named = np.vstack([self.mesh.groups[name] for name in self.names])
        rows = np.sort(np.vstack([named, faces]), axis=1).astype(np.int64)
        size = len(self.mesh.points)
        keys = (rows[:, 0] * size + rows[:, 1]) * size + rows[:, 2]
        _, first, count = np.unique(keys[len(named) :], return_index=True, return_counts=True)
        rest = first[(count == 1) & ~np.isin(keys[len(named) :][first], keys[: len(named)])]
        return np.vstack([named, faces[rest]])

    @cached_property
    def owner(self) -> np.ndarray:
        """Group (n,) of every triangle, its place in ``names``; -1 for none."""
        counts = [len(self.mesh.groups[name]) for name in self.names]
        owner = np.full(len(self.triangles), -1)
        owner[: sum(counts)] = np.repeat(np.arange(len(counts)), counts)
        return owner

    @cached_property
    def corners(self) -> np.ndarray:
        return self.mesh.points[self.triangles]

    @cached_property
    def normals(self) -> np.ndarray:
        """Outward normals (n, 3), as long as the triangles' areas [m^2]."""
        a, b, c = self.corners.transpose(1, 0, 2)
        return 0.5 * np.cross(b - a, c - a)

    @cached_property
    def areas(self) -> np.ndarray:
        return np.linalg.norm(self.normals, axis=1)

    @cached_property
    def centres(self) -> np.ndarray:
        return self.corners.mean(axis=1)

    @cached_property
    def units(self) -> np.ndarray:
        return self.normals / self.areas[:, None]

    def area(self, name: str) -> float:
        """Area [m^2] of a group."""
        return float(self.areas[self.owner == self.names.index(name)].sum())

    @cached_property
    def samples(self) -> tuple[np.ndarray, np.ndarray]:
        """Points (m, 3) all over the boundary, and the triangle (m,) of each."""
        step = (np.arange(_SAMPLES) + 1.0 / 3.0) / _SAMPLES
        u, v = (w.ravel() for w in np.meshgrid(step, step))
        u, v = u[u + v < 1.0], v[u + v < 1.0]
        places = np.einsum("kq,nkd->nqd", np.stack([1.0 - u - v, u, v]), self.corners)
        return places.reshape(-1, 3), np.repeat(np.arange(len(self.corners)), len(u))

    def nearest(self, places: np.ndarray, units: np.ndarray, length: float) -> np.ndarray:
        """The triangle (n,) nearest to each place; normals that differ by one count as much as
        a ``length`` [m]."""
        at, triangle = self.samples
        tree = cKDTree(np.hstack([at, length * self.units[triangle]]))
        return triangle[tree.query(np.hstack([places, length * units]))[1]]


def _refuse_swapped(found: Skin, wanted: Skin, source: str) -> None:
    """Lands or ends that lie where the case has the other one."""
    for pair, what in ((RING_GROUPS[:2], "a mean radius of"), (RING_GROUPS[2:], "a mean x of")):
        if not all(name in skin.names for skin in (found, wanted) for name in pair):
            continue
        a, b, first, second = (
            _middle(skin, name, pair) for skin in (found, wanted) for name in pair
        )
        if (a - first) * (second - first) > 0.5 * (second - first) ** 2:
            raise InputError(
                f"{source}: {pair[0]!r} has {what} {a * 1e3:.3f} mm and {pair[1]!r} {b * 1e3:.3f} "
                f"mm, but the case has them at {first * 1e3:.3f} and {second * 1e3:.3f} mm; their "
                "names are swapped",
                where="mesh.file",
                value=pair[0],
            )


def _middle(skin: Skin, name: str, pair: tuple[str, ...]) -> float:
    """Mean radius or mean x [m] of a land or an end."""
    own = skin.owner == skin.names.index(name)
    x, y, z = skin.centres[own].T
    along = np.hypot(y, z) if pair[0].startswith("land") else x
    return float(np.average(along, weights=skin.areas[own]))


def _refuse_short(found: Skin, wanted: Skin, source: str) -> None:
    """Groups with less than half of the area of their faces, of any shape that these have."""
    short = [
        name
        for name in wanted.names
        if not name.endswith("fillet") and found.area(name) < 0.5 * wanted.area(name)
    ]
    if short:
        name = min(short, key=lambda n: found.area(n) / wanted.area(n))
        more = f", and {len(short) - 1} more groups lack half or more" if short[1:] else ""
        raise InputError(
            f"{source}: group {name!r} has {found.area(name) * 1e6:.3g} mm^2 of a face that has "
            f"{wanted.area(name) * 1e6:.3g} mm^2 in the case{more}; give a group all triangles of "
            "its face",
            where="mesh.file",
            value=name,
        )


def _check_motion(found: Skin, wanted: Skin, source: str) -> bool:
    """Refuse or tell of a mesh that as a whole is shifted or turned; whether it is."""
    shift, turn = _motion(found, wanted)
    reach = np.abs(found.mesh.points).max(axis=0)
    corners = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T * reach
    most = float(np.linalg.norm(shift + np.cross(turn, corners), axis=1).max())
    if most <= _SAID:
        return False
    parts = []
    for axis, s, w in zip("xyz", shift, turn):
        if abs(s) > 0.25 * most:
            parts.append(f"{s * 1e3:+.3f} mm along {axis}")
        if abs(w) * reach.max() > 0.25 * most:
            parts.append(f"{degrees(w):+.3f} deg about {axis}")
    text = (
        f"{source}: the mesh lies elsewhere than the case's cage, by {' and '.join(parts)} "
        f"({most * 1e3:.3f} mm at most)"
    )
    if most > _MOST:
        raise InputError(
            f"{text}; move it so that the bearing's axis is x, the rolling elements' centres are "
            "at x = 0 and pocket 0 is on the y axis",
            where="mesh.file",
            value=most,
        )
    log.warning("%s; contact is computed where the case has the cage", text)
    return True


def _motion(found: Skin, wanted: Skin) -> tuple[np.ndarray, np.ndarray]:
    """Shift [m] and turn [rad] (3,) that take the described cage to the file's mesh: the least
    squares of the distances of all groups' triangles from the planes of those nearest to them."""
    shift, turn = np.zeros(3), np.zeros(3)
    length = 0.1 * float(np.ptp(wanted.mesh.points, axis=0).max())
    for _ in range(_TURNS):
        rows, values = [], []
        for name in set(found.names) & set(wanted.names):
            own = found.owner == found.names.index(name)
            other = np.flatnonzero(wanted.owner == wanted.names.index(name))
            places = found.centres[own] - shift - np.cross(turn, found.centres[own])
            tree = cKDTree(np.hstack([wanted.centres[other], length * wanted.units[other]]))
            at = other[tree.query(np.hstack([places, length * found.units[own]]))[1]]
            normal, weight = wanted.units[at], np.sqrt(found.areas[own])[:, None]
            rows.append(weight * np.hstack([normal, np.cross(places, normal)]))
            off = np.einsum("ij,ij->i", places - wanted.centres[at], normal)
            values.append(weight[:, 0] * off)
        matrix = np.vstack(rows) * np.repeat([1.0, 1.0 / length], 3)
        step = np.linalg.lstsq(matrix, np.concatenate(values), rcond=1e-6)[0]
        shift, turn = shift + step[:3], turn + step[3:] / length
        if np.abs(step).max() < 0.1 * _SAID:
            break
    return shift, turn


def _check_cover(found: Skin, wanted: Skin, source: str) -> None:
    """Refuse or tell of groups that lack part of the face that they name, or have another area."""
    missing = _missing(found, wanted)
    lack = {
        name: min(float(found.areas[rows].sum()) / wanted.area(name), 1.0)
        for name, rows in missing.items()
    }
    some = [name for name in lack if lack[name] > _SAID_LACK]
    if some:
        name = max(some, key=lambda n: lack[n])
        rows = missing[name]
        holders = np.unique(found.owner[rows])[:3]
        held = ", ".join(repr(found.names[n]) if n >= 0 else "no group" for n in holders)
        text = (
            f"{source}: group {name!r} lacks {100 * lack[name]:.0f} % of its face ({rows.sum()} "
            f"triangles, {found.areas[rows].sum() * 1e6:.3g} mm^2, which are in {held})"
            + (f", and {len(some) - 1} more groups lack some" if some[1:] else "")
        )
        if lack[name] > _MOST_LACK:
            text = f"{text}; give a group all triangles of its face"
            raise InputError(text, where="mesh.file", value=name)
        log.warning("%s", text)
    ratio = {name: found.area(name) / wanted.area(name) for name in missing}
    ratio |= {n: min(r, 1.0) for n, r in ratio.items() if n.startswith("pocket")}  # with fillets
    name = max(ratio, key=lambda n: abs(ratio[n] - 1.0))
    if abs(ratio[name] - 1.0) > _OWN_SHAPE and not some:
        log.warning(
            "%s: group %r has an area of %.4g mm^2, and %.4g mm^2 in the case; contact is computed "
            "with the case's dimensions",
            source, name, found.area(name) * 1e6, wanted.area(name) * 1e6,
        )  # fmt: skip


def _missing(found: Skin, wanted: Skin) -> dict[str, np.ndarray]:
    """Of every group but fillets, which boundary triangles (n,) of the file's mesh lie on its face
    and are not in it."""
    length = float(np.sqrt(np.median(wanted.areas)))
    at = wanted.nearest(found.centres, found.units, length)
    off = np.einsum("ij,ij->i", found.centres - wanted.centres[at], wanted.units[at])
    turned = np.linalg.norm(found.units - wanted.units[at], axis=1)
    fillets = [i for i, name in enumerate(found.names) if name.endswith("fillet")]
    begins = np.isin(found.owner, fillets)  # where one begins, a face's normals change little
    same = (turned < np.where(begins, _PLANE, _ALIKE)) & (np.abs(off) < 0.5 * length)
    return {
        name: same & (wanted.owner[at] == i) & (found.owner != found.names.index(name))
        for i, name in enumerate(wanted.names)
        if not name.endswith("fillet")  # which may be in the faces that meet there
    }


def _check_rings(mesh: CageMesh, said: CageMesh, source: str, *, ends: bool) -> None:
    """Refuse or tell of lands, and ``ends``, that are not where the case has them, where those are
    cylinders and planes."""
    for name in RING_GROUPS if ends else RING_GROUPS[:2]:
        if name not in mesh.groups or name not in said.groups:
            continue
        at = [_along(m, name) for m in (mesh, said)]
        if np.ptp(at[1]) > 0.1 * _SAID:
            continue
        off = float(at[0].mean() - at[1].mean())
        what = "a mean radius of" if name.startswith("land") else "a mean x of"
        text = (
            f"{source}: {name!r} has {what} {at[0].mean() * 1e3:.3f} mm, but the case says "
            f"{at[1].mean() * 1e3:.3f} mm"
        )
        if abs(off) > _MOST:
            raise InputError(
                f"{text}; give the cage that the file contains", where="mesh.file", value=name
            )
        if abs(off) > _SAID:
            log.warning("%s; contact is computed with the case's dimensions", text)


def _along(mesh: CageMesh, name: str) -> np.ndarray:
    x, y, z = mesh.points[np.unique(mesh.groups[name])].T
    return np.hypot(y, z) if name.startswith("land") else x


def _check_body(mesh: CageMesh, said: CageMesh, source: str) -> None:
    """Tell of a body that differs from the case's: its volume, mass centre and axes of inertia."""
    found, wanted = (report_mesh(m, density=1.0) for m in (mesh, said))
    assert found.inertia is not None and wanted.inertia is not None
    words = []
    volume = found.volume / wanted.volume - 1.0
    if abs(volume) > _OWN_SHAPE:
        words.append(f"{100 * volume:+.0f} % of volume")
    off = found.mass_centre - wanted.mass_centre
    if np.linalg.norm(off) > _MOST:
        places = ", ".join(f"{c * 1e3:+.3f}" for c in off)
        words.append(f"the mass centre ({places}) mm away")
    tilt = _tilt(found.inertia) - _tilt(wanted.inertia)
    if np.abs(tilt).max() * np.abs(mesh.points).max() > _MOST:
        words.append(f"the main axis of inertia {degrees(np.abs(tilt).max()):.2f} deg aside")
    if words:
        log.warning(
            "%s: the cage differs from the one that the case describes by %s; the mesh counts",
            source, " and ".join(words),
        )  # fmt: skip


def _tilt(inertia: np.ndarray) -> np.ndarray:
    """Angles [rad] (2,) of the axis of the greatest moment of inertia with x, towards y and z."""
    axis = np.linalg.eigh(inertia)[1][:, 2]
    return axis[1:] / axis[0]
