"""A quarter of one cage sector, meshed by gmsh: what all cages' quarters share.

A sector is symmetric about the pocket's radial mid-plane (z = 0) and about the cage's middle
(x = 0), so a quarter of it, mirrored twice and turned Z times, is the whole ring (``ring``).
Mirrored meshes match node by node at every cut, which a periodic constraint would only ask for,
and the ring has the full symmetry of the body: its mass centre is zero to rounding and both
senses of rotation see the same mesh.

Machined cages are meshed in the coordinates (x, radius/stretch, t), t the tangential distance from
the pocket's radial mid-plane. There lands, cuts and plane pocket walls are planes, so that vertices
lie exactly on every surface once turned back; and the isotropic elements that gmsh makes become
longer along the radius by the stretch.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from flexcage.core.errors import InputError, RunFailed
from flexcage.core.memory import in_bytes, total_memory
from flexcage.core.units import describe
from flexcage.geometry.cage import Cage

MM = 1e-3
RING_SURFACES = ("cut_x", "cut_z", "cut_psi", "land_inner", "land_outer", "end")
# elements in a cube of their size; further ones where a body is thin, for each of its surface over
# size and cube root of volume; and at each edge of a curved wall: within a factor of 1.5 of 142
# meshes of all cage types and finenesses, of 80 to 50,000 elements. Bytes that gmsh takes for one:
# 800 to 1,100 where there are more than 5,000
_PER_CUBE, _OF_SURFACE, _AT_WALL, _BYTES = 4.5, 15.0, 4.2, 1000.0
_STRAIGHT = 1e-3  # mm: a radial edge's extent along x, in which boxes are rounded


@dataclass(frozen=True)
class SizePlan:
    """Element sizes [m] and the numbers of edges along and across a fillet."""

    size: float
    near_fillet: float
    growth: float
    arc_edges: int
    radial_edges: int
    stretch: float  # of elements along the radius


@dataclass(frozen=True)
class Quarter:
    """The quarter x >= 0, 0 <= psi <= pi/Z of the sector around pocket 0; without ``cut_x``, and
    with the ends as ``end+x`` and ``end-x``, the half of one that has no symmetry in x."""

    points: np.ndarray  # (n, 3) [m]
    tets: np.ndarray  # (m, 4), positive volumes
    surfaces: dict[str, np.ndarray]  # name -> (., 3) outward triangles: the cuts, then groups
    plan: SizePlan


def section_prism(
    occ: Any, radii: tuple[float, float], slope: float, length: float, stretch: float
) -> list[tuple[int, int]]:
    """The quarter sector without its pocket, [(3, tag)], in (x, radius/stretch, t) [mm].

    ``slope`` is that of the psi cut: t = slope * radius.
    """
    inner, outer = radii
    corners = ((inner, 0.0), (outer, 0.0), (outer, slope * outer), (inner, slope * inner))
    points = [occ.addPoint(0.0, radius / stretch, t) for radius, t in corners]
    lines = [occ.addLine(points[i - 1], points[i]) for i in range(4)]
    section = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return [e for e in occ.extrude([(2, section)], length, 0.0, 0.0) if e[0] == 3]


def only_cylinder(gmsh: Any, what: str, fits: Callable[[int], bool] = lambda tag: True) -> int:
    """Tag of the one cylinder among the surfaces that fits; RunFailed if there is not just one.
    ``what`` names it in the error ("pocket wall")."""
    cylinders = (
        tag for dim, tag in gmsh.model.getEntities(2) if gmsh.model.getType(dim, tag) == "Cylinder"
    )
    tags = [tag for tag in cylinders if fits(tag)]
    if len(tags) != 1:
        raise RunFailed(f"one {what} was expected in the quarter sector, not {len(tags)}")
    return tags[0]


def solids_of(entities: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The solids among gmsh's entities."""
    return [e for e in entities if e[0] == 3]


def remove_loose_faces(gmsh: Any, solids: list[tuple[int, int]]) -> None:
    """Remove the faces that cutting left behind, which bound none of the solids."""
    own = set(gmsh.model.getBoundary(solids, combined=False, oriented=False))
    over = [e for e in gmsh.model.getEntities(2) if e not in own]
    gmsh.model.occ.remove(over, recursive=True)
    gmsh.model.occ.synchronize()


def x_extent(gmsh: Any, dim: int, tag: int) -> float:
    box = gmsh.model.getBoundingBox(dim, tag)
    return box[3] - box[0]


def set_sizes(gmsh: Any, plan: SizePlan, curved: int) -> None:
    """A regular grid on the curved surface, a fillet or a pocket's wall, long along the radius
    where stress varies slowly; away from it the size grows to the far one."""
    mesh = gmsh.model.mesh
    for dim, tag in gmsh.model.getBoundary([(2, curved)], combined=False, oriented=False):
        arc = x_extent(gmsh, dim, tag) > _STRAIGHT
        mesh.setTransfiniteCurve(tag, 1 + (plan.arc_edges if arc else plan.radial_edges))
    mesh.setTransfiniteSurface(curved)
    distance = mesh.field.add("Distance")
    mesh.field.setNumbers(distance, "SurfacesList", [curved])
    mesh.field.setNumber(distance, "Sampling", 40)
    grow_from(gmsh, distance, plan)


def grow_from(gmsh: Any, distance: int, plan: SizePlan) -> None:
    """Size everywhere by a field of distance: the near one, growing to the far one."""
    field, option = gmsh.model.mesh.field, gmsh.option
    size = field.add("MathEval")
    near, far = plan.near_fillet / MM, plan.size / MM
    field.setString(size, "F", f"Min({far}, {near} + {plan.growth}*F{distance})")
    field.setAsBackgroundMesh(size)
    for name in ("ExtendFromBoundary", "FromPoints", "FromCurvature"):
        option.setNumber(f"Mesh.MeshSize{name}", 0)
    option.setNumber("Mesh.Optimize", 1)
    option.setNumber("Mesh.OptimizeNetgen", 1)


def generate(gmsh: Any, plan: SizePlan) -> None:
    """Mesh the solids; InputError before that for more elements than this machine has room for."""
    count, memory = expected_tets(gmsh, plan), total_memory()
    if _BYTES * count > memory:
        raise InputError(
            f"Elements of {describe(plan.size, 'mm')} make about {count:.2g} of them in a part of "
            f"one pocket's sector, which take {in_bytes(_BYTES * count)} of memory, and this "
            f"machine has {in_bytes(memory)}; give a larger mesh.size.",
            where="mesh.size",
            value=plan.size,
        )
    gmsh.model.mesh.generate(3)


def expected_tets(gmsh: Any, plan: SizePlan) -> float:
    """How many tetrahedra the solids will have, about, by their sizes."""
    volume, surface = (
        sum(gmsh.model.occ.getMass(*e) for e in gmsh.model.getEntities(dim)) for dim in (3, 2)
    )
    cubes = _cubes(volume, _fine_area(gmsh), plan)
    size = (volume / cubes) ** (1.0 / 3.0)  # mean
    thin = _OF_SURFACE * surface / (size * volume ** (1.0 / 3.0))
    return _PER_CUBE * cubes + thin + _AT_WALL * plan.arc_edges * plan.radial_edges


def _fine_area(gmsh: Any) -> float:
    """Area [mm^2] of the surfaces from which sizes grow."""
    field = gmsh.model.mesh.field
    distances = [tag for tag in field.list() if field.getType(tag) == "Distance"]
    faces = [int(face) for tag in distances for face in field.getNumbers(tag, "SurfacesList")]
    return sum(gmsh.model.occ.getMass(2, face) for face in faces)


def _cubes(volume: float, area: float, plan: SizePlan) -> float:
    """Integral of 1/size^3 over a volume [mm^3] whose size grows from an area [mm^2]."""
    far, near = plan.size / MM, plan.near_fillet / MM
    if area <= 0.0 or far <= near:
        return volume / far**3
    depth = min((far - near) / plan.growth, volume / area)
    last = near + plan.growth * depth
    layer = 0.5 * area * (near**-2 - last**-2) / plan.growth
    return layer + max(volume - area * depth, 0.0) / far**3


def mesh_arrays(
    gmsh: Any, stretch: float | None = None
) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    """Points [m], positive tets, and the outward triangles of each surface, compactly numbered.

    ``stretch``: that of the coordinates (x, radius/stretch, t); without it they are (x, y, z).
    """
    mesh = gmsh.model.mesh
    tags, coordinates, _ = mesh.getNodes()
    cells = mesh.getElementsByType(4)[1].reshape(-1, 4)
    used = np.unique(cells)
    number = np.full(int(tags.max()) + 1, -1)
    number[used] = np.arange(len(used))
    position = np.empty((len(number), 3))
    position[tags] = coordinates.reshape(-1, 3) * MM
    points, tets = position[used], number[cells]
    if stretch is not None:  # radius to height
        points[:, 1] = np.sqrt((stretch * points[:, 1]) ** 2 - points[:, 2] ** 2)
    faces = [
        orient_outward(points, tets, number[mesh.getElementsByType(2, tag)[1].reshape(-1, 3)])
        for _, tag in gmsh.model.getEntities(2)
    ]
    return points, tets, faces


def surface_of_ring(
    points: np.ndarray, cage: Cage, pocket_count: int, own: Mapping[str, np.ndarray]
) -> str | None:
    """Which surface of a machined cage's quarter all these points lie on: one of ``RING_SURFACES``
    or of the pocket's ``own``, by the points' distances [m] to each; None if on none of them."""
    x, y, z = points.T
    radius = np.hypot(y, z)
    distances = (
        x,
        z,
        radius * (np.arctan2(z, y) - pi / pocket_count),
        radius - 0.5 * cage.bore,
        radius - 0.5 * cage.outside_diameter,
        x - 0.5 * cage.width,
    )
    for name, distance in {**dict(zip(RING_SURFACES, distances)), **own}.items():
        if np.abs(distance).max() < 1e-6 * cage.width:
            return name
    return None


def named_surfaces(
    faces: Iterable[np.ndarray],
    points: np.ndarray,
    name_of: Callable[[np.ndarray], str],
    expected: Iterable[str],
) -> dict[str, np.ndarray]:
    """Triangles of all faces by the names that their points have; RunFailed for other names."""
    found: dict[str, list[np.ndarray]] = {}
    for triangles in faces:
        found.setdefault(name_of(points[np.unique(triangles)]), []).append(triangles)
    if set(found) != set(expected):
        raise RunFailed(f"the quarter sector has unexpected surfaces: {sorted(found)}")
    return {name: np.vstack(parts) for name, parts in found.items()}


def orient_outward(points: np.ndarray, tets: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The triangles (n, 3) with normals away from their tetrahedron; -1 rows where none has it.

    Needs every triangle to be a face of a tetrahedron of positive volume.
    """
    if len(triangles) == 0:
        return triangles.reshape(0, 3)
    opposite = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # outward for a positive tet
    faces = np.vstack([tets[:, corners] for corners in opposite])
    n = len(points)
    key = _face_keys(faces, n)
    order = np.argsort(key, kind="stable")
    wanted = _face_keys(triangles, n)
    place = np.minimum(np.searchsorted(key[order], wanted), len(order) - 1)
    found = order[place]
    return np.where((key[found] == wanted)[:, None], faces[found], -1)


def _face_keys(faces: np.ndarray, n_points: int) -> np.ndarray:
    a, b, c = np.sort(faces, axis=1).astype(np.int64).T
    return (a * n_points + b) * n_points + c
