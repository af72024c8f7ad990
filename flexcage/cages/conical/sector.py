"""Half of one sector of a conical cage by gmsh's OpenCASCADE kernel.

A rectangle is turned about the bearing's axis from a pocket's middle to a bar's, and the pocket,
a solid between planes with rounded corners, is cut out. A cone across the wall divides the bar in
the middle of its length, where a broken one is cut.
"""

from __future__ import annotations

from math import ceil, pi
from typing import Any

import numpy as np

from flexcage.cages.conical.shape import ConeShaped
from flexcage.cages.conical.walls import pocket_walls
from flexcage.core.errors import RunFailed
from flexcage.mesh.gmsh_session import gmsh_model
from flexcage.mesh.joint import set_joint, spread_evenly
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.sector import (
    MM,
    Quarter,
    SizePlan,
    generate,
    grow_from,
    mesh_arrays,
    named_surfaces,
    remove_loose_faces,
    solids_of,
)

# size over the wall's thickness; size at the fillets over that; growth of the size with distance;
# edges along a fillet's arc
_NAMED = {
    "coarse": (1.8, 0.6, 1.0, 1),
    "medium": (1.1, 0.4, 0.7, 3),
    "fine": (0.7, 0.35, 0.5, 4),
    "paper": (0.4, 0.3, 0.4, 5),
}
_RING = ("cut_z", "cut_psi", "land_inner", "land_outer", "end+x", "end-x")
_POCKET = ("beam", "side+x", "side-x")
_FILLET, _MIDDLE = "fillet", "middle"


def conical_size_plan(cage: ConeShaped, options: MeshOptions) -> SizePlan:
    """Sizes that a named fineness, or the user's own, mean on this cage."""
    far, near, growth, arcs = _NAMED[options.fineness]
    size = options.size or far * cage.thickness
    near_fillet = near * size
    if options.fillet_size is not None:
        arcs = max(1, ceil(0.5 * pi * cage.fillet_radius / options.fillet_size - 1e-9))
        near_fillet = min(near_fillet, 3.0 * options.fillet_size)  # keeps slivers off the arc
    across = max(1, round(cage.thickness / near_fillet))
    return SizePlan(size, near_fillet, growth, arcs, across, 1.0)


def mesh_conical_half(
    cage: ConeShaped, *, pocket_count: int, options: MeshOptions, joint: bool = False
) -> Quarter:
    """Mesh the half sector; lengths go to gmsh in mm, where OpenCASCADE's tolerances fit.
    ``joint``: with an end at -x that meets another half's (``mesh.joint``)."""
    plan = conical_size_plan(cage, options)
    with gmsh_model("flexcage half sector of a conical cage") as gmsh:
        fillets = _shape(gmsh, cage, pocket_count)
        _set_sizes(gmsh, plan, fillets)
        if joint:
            set_joint(gmsh, plan, cage.ends[0])
        generate(gmsh, plan)
        points, tets, faces = mesh_arrays(gmsh)
    surfaces = named_surfaces(
        faces, points, lambda on: _surface_name(on, cage, pocket_count),
        (*_RING, *_POCKET, _FILLET, _MIDDLE),
    )  # fmt: skip
    del surfaces[_MIDDLE]
    if joint:
        points = spread_evenly(points, np.unique(surfaces["end-x"]), pocket_count)
    points[np.unique(surfaces["cut_z"]), 2] = 0.0  # exact, so that mirror images coincide
    return Quarter(points, tets, surfaces, plan)


def _shape(gmsh: Any, cage: ConeShaped, pocket_count: int) -> list[int]:
    """The half sector in (x, y, z) [mm]; tags of its fillets."""
    occ, at, step = gmsh.model.occ, cage.section, pi / pocket_count
    corners = (
        (cage.large_end(at.inside), at.inside), (at.small, at.inside), (at.small, at.outside),
        (cage.large_end(at.outside), at.outside),
    )  # fmt: skip
    points = [_point(occ, cage, s, n, 0.0) for s, n in corners]
    section = _face(occ, points)
    body = solids_of(occ.revolve([(2, section)], 0, 0, 0, 1, 0, 0, step))
    body = solids_of(occ.cut(body, _window(gmsh, cage))[0])
    ends = [_point(occ, cage, 0.0, n, 0.0) for n in (at.inside, at.outside)]
    middle = occ.revolve([(1, occ.addLine(*ends))], 0, 0, 0, 1, 0, 0, step)
    body = solids_of(occ.fragment(body, [e for e in middle if e[0] == 2])[0])
    occ.synchronize()
    if len(body) != 2:
        raise RunFailed(f"the cage's half sector falls into {len(body)} pieces")
    remove_loose_faces(gmsh, body)
    return _fillet_surfaces(gmsh)


def _point(occ: Any, cage: ConeShaped, s: float, n: float, t: float) -> int:
    return int(occ.addPoint(cage.axial(s, n) / MM, cage.radius(s, n) / MM, t / MM))


def _face(occ: Any, points: list[int]) -> int:
    lines = [occ.addLine(points[i - 1], points[i]) for i in range(len(points))]
    return int(occ.addPlaneSurface([occ.addCurveLoop(lines)]))


def _window(gmsh: Any, cage: ConeShaped) -> list[tuple[int, int]]:
    """The solid that a pocket takes away, from beyond its middle plane to the bar, with rounded
    corners; it reaches through the wall, whose cones are lower beside the middle plane."""
    occ, at, half = gmsh.model.occ, cage.section, 0.5 * cage.pocket_length
    low = min(cage.face_heights(s)[0] for s in (-half, half)) - 0.2 * cage.thickness
    high = at.outside + 0.05 * cage.thickness
    corner = {
        (s, n, t): _point(occ, cage, s * half, n, t * cage.half_width(s * half, n))
        for s in (-1, 1) for n in (low, high) for t in (-1, 1)
    }  # fmt: skip
    loops = [[(s, low, -1), (s, low, 1), (s, high, 1), (s, high, -1)] for s in (-1, 1)]
    loops += [[(-1, low, t), (1, low, t), (1, high, t), (-1, high, t)] for t in (-1, 1)]
    loops += [[(-1, n, -1), (1, n, -1), (1, n, 1), (-1, n, 1)] for n in (low, high)]
    line: dict[frozenset, int] = {}
    faces = []
    for loop in loops:
        curves = []
        for a, b in zip(loop, loop[1:] + loop[:1]):
            if (edge := frozenset((a, b))) not in line:
                line[edge] = occ.addLine(corner[a], corner[b])
            curves.append(line[edge])
        faces.append(occ.addPlaneSurface([occ.addCurveLoop(curves)]))
    solid = occ.addVolume([occ.addSurfaceLoop(faces)])
    edges = [line[frozenset(((s, low, t), (s, high, t)))] for s in (-1, 1) for t in (-1, 1)]
    return solids_of(occ.fillet([solid], edges, [cage.fillet_radius / MM]))


def _fillet_surfaces(gmsh: Any) -> list[int]:
    tags = [t for _, t in gmsh.model.getEntities(2) if gmsh.model.getType(2, t) == "Cylinder"]
    if len(tags) != 2:
        raise RunFailed(f"two fillets were expected in the half sector, not {len(tags)}")
    return tags


def _set_sizes(gmsh: Any, plan: SizePlan, fillets: list[int]) -> None:
    """Regular grids on the fillets; away from them the size grows to the far one."""
    mesh = gmsh.model.mesh
    for fillet in fillets:
        for _, tag in gmsh.model.getBoundary([(2, fillet)], combined=False, oriented=False):
            straight = gmsh.model.getType(1, tag) == "Line"
            mesh.setTransfiniteCurve(tag, 1 + (plan.radial_edges if straight else plan.arc_edges))
        mesh.setTransfiniteSurface(fillet)
    distance = mesh.field.add("Distance")
    mesh.field.setNumbers(distance, "SurfacesList", fillets)
    mesh.field.setNumber(distance, "Sampling", 40)
    grow_from(gmsh, distance, plan)


def _surface_name(points: np.ndarray, cage: ConeShaped, pocket_count: int) -> str:
    """Which surface of the half sector all these points lie on; fillets lie on no other."""
    at, walls = cage.section, pocket_walls(cage)
    a, b = cage.in_section(points).T
    azimuth = np.arctan2(points[:, 2], points[:, 1])
    local = cage.in_pocket(points, 0, pocket_count)
    ring = (
        points[:, 2], cage.mean_radius * (azimuth - pi / pocket_count), b - at.inside,
        b - at.outside, a - at.small, cage.from_large_end(points),
    )  # fmt: skip
    pocket = [(local - walls.middle[k]) @ walls.normal[k] for k in (0, 2, 3)]
    for name, distance in zip((*_RING, *_POCKET, _MIDDLE), (*ring, *pocket, a)):
        if np.abs(distance).max() < 1e-6 * cage.outside_diameter:
            return name
    return _FILLET
