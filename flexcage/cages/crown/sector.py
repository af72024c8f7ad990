"""Half of one sector of a crown cage: ring, half a bar and a claw beside a ball.

The body is revolved about the axis through the ball's centre, parallel to the bearing's, and cut by
the cylinders of bore and outside and by the plane between two balls.
"""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from flexcage.cages.crown.cage import CrownCage
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

# size over the thickness of claw, ring or wall, whichever is least; size at the claws' roots and
# under the pocket over that; growth of the size away from there
_NAMED = {
    "coarse": (1.5, 0.75, 0.6),
    "medium": (1.0, 0.5, 0.5),
    "fine": (0.6, 0.3, 0.4),
    "paper": (0.35, 0.2, 0.4),
}
NAMED = ("cut_z", "cut_psi", "land_inner", "land_outer", "wall", "end+x", "end-x")
_REST = "rest"  # bars' ends, claws' outsides and roots: no group


def crown_size_plan(cage: CrownCage, options: MeshOptions) -> SizePlan:
    """Sizes that a named fineness, or the user's own, mean on this cage."""
    far, near, growth = _NAMED[options.fineness]
    thin = cage.thinnest(0.0, 0)
    size = options.size or far * thin
    arcs = max(1, round(0.25 * pi * cage.pocket_diameter / size))
    return SizePlan(size, near * size, growth, arcs, 1, 1.0)


def mesh_crown_half(
    cage: CrownCage, *, pocket_count: int, pitch_diameter: float, options: MeshOptions,
    breaks: bool = False, fronts: tuple[float, ...] = (), joint: bool = False,
) -> Quarter:  # fmt: skip
    """Mesh the half sector; lengths go to gmsh in mm, where OpenCASCADE's tolerances fit.

    ``breaks``: have faces in the plane where the claw stands on its bar; and ``fronts``: arcs of
    edges in it at these radii [m] about the bearing's axis. ``joint``: have an end at -x that meets
    another half's (``mesh.joint``).
    """
    plan, pitch_radius = crown_size_plan(cage, options), 0.5 * pitch_diameter
    with gmsh_model("flexcage half sector of a crown cage") as gmsh:
        _shape(gmsh, cage, pocket_count, pitch_radius)
        if breaks:
            _divide(gmsh, cage, pocket_count, fronts)
        _set_sizes(gmsh, plan, cage, pitch_radius)
        if joint:
            set_joint(gmsh, plan, cage.back)
        generate(gmsh, plan)
        points, tets, faces = mesh_arrays(gmsh)
    surfaces = named_surfaces(
        faces, points, lambda on: _surface_name(on, cage, pocket_count, pitch_radius),
        (*NAMED, _REST),
    )  # fmt: skip
    del surfaces[_REST]
    if joint:
        points = spread_evenly(points, np.unique(surfaces["end-x"]), pocket_count)
    points[np.unique(surfaces["cut_z"]), 2] = 0.0  # exact, so that mirror images coincide
    return Quarter(points, tets, surfaces, plan)


def _shape(gmsh: Any, cage: CrownCage, pocket_count: int, pitch_radius: float) -> None:
    """The half sector in (x, y, z) [mm], the ball's centre on the y axis."""
    occ = gmsh.model.occ
    middle, step = pitch_radius / MM, pi / pocket_count
    inner, outer = 0.5 * cage.bore / MM, 0.5 * cage.outside_diameter / MM
    low, high = cage.back / MM, cage.tip / MM
    profile = occ.addPlaneSurface([occ.addCurveLoop(_profile(occ, cage, middle, outer + middle))])
    body = solids_of(occ.revolve([(2, profile)], 0.0, middle, 0.0, 1.0, 0.0, 0.0, pi))
    corners = ((low - 1.0, inner), (high + 1.0, inner), (high + 1.0, outer), (low - 1.0, outer))
    points = [occ.addPoint(x, r, 0.0) for x, r in corners]
    lines = [occ.addLine(points[i - 1], points[i]) for i in range(4)]
    section = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    wedge = solids_of(occ.revolve([(2, section)], 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, step))
    body = solids_of(occ.intersect(body, wedge)[0])
    occ.synchronize()
    if len(body) != 1:
        raise RunFailed("the cage's half sector falls into several pieces")


def _divide(gmsh: Any, cage: CrownCage, pocket_count: int, fronts: tuple[float, ...]) -> None:
    """Part claw and bar in the plane where the bar ends, which has arcs at the fronts."""
    occ, x = gmsh.model.occ, cage.bar_height / MM
    inner, outer = 0.5 * cage.bore / MM, 0.5 * cage.outside_diameter / MM
    radii = [inner - 1.0, *(radius / MM for radius in fronts), outer + 1.0]
    faces = []
    for low, high in zip(radii, radii[1:]):
        line = occ.addLine(occ.addPoint(x, low, 0.0), occ.addPoint(x, high, 0.0))
        swept = occ.revolve([(1, line)], 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, pi / pocket_count)
        faces += [e for e in swept if e[0] == 2]
    solids = occ.getEntities(3)
    occ.fragment(solids, faces)
    occ.synchronize()
    remove_loose_faces(gmsh, occ.getEntities(3))


def _profile(occ: Any, cage: CrownCage, middle: float, far: float) -> list[int]:
    """Lines and arcs round the body's section, in the plane z = 0 above the ball's centre [mm]."""
    radius, outside = 0.5 * cage.pocket_diameter / MM, cage.claw_outside / MM
    back, tip, bar = cage.back / MM, cage.tip / MM, cage.bar_height / MM
    x, rho = (value / MM for value in cage.root_centre)
    touch = cage.claw_begin / MM / x  # where claw and root meet, on the line of their middles

    def at(x: float, rho: float) -> int:
        return occ.addPoint(x, middle + rho, 0.0)

    ball, root = at(0.0, 0.0), at(x, rho)
    pole, below, edge = at(-radius, 0.0), at(back, 0.0), at(back, far - middle)
    top, foot = at(bar, far - middle), at(bar, rho)
    met = at(touch * x, touch * rho)
    over = at(tip, (outside**2 - tip**2) ** 0.5)
    mouth, side = at(tip, 0.5 * cage.throat / MM), at(0.0, radius)
    return [
        occ.addLine(below, edge), occ.addLine(edge, top), occ.addLine(top, foot),
        occ.addCircleArc(foot, root, met), occ.addCircleArc(met, ball, over),
        occ.addLine(over, mouth), occ.addCircleArc(mouth, ball, side),
        occ.addCircleArc(side, ball, pole), occ.addLine(pole, below),
    ]  # fmt: skip


def _set_sizes(gmsh: Any, plan: SizePlan, cage: CrownCage, pitch_radius: float) -> None:
    """Fine round the claws' roots and where the ring is thinnest, growing to the size elsewhere."""
    field = gmsh.model.mesh.field
    roots = [
        tag for dim, tag in gmsh.model.getEntities(2) if gmsh.model.getType(dim, tag) == "Torus"
    ]
    bottom = gmsh.model.occ.addPoint(-0.5 * cage.pocket_diameter / MM, pitch_radius / MM, 0.0)
    gmsh.model.occ.synchronize()
    distance = field.add("Distance")
    field.setNumbers(distance, "SurfacesList", roots)
    field.setNumbers(distance, "PointsList", [bottom])
    field.setNumber(distance, "Sampling", 40)
    grow_from(gmsh, distance, plan)


def _surface_name(
    points: np.ndarray, cage: CrownCage, pocket_count: int, pitch_radius: float
) -> str:
    """Which surface of the half sector all these points lie on."""
    x, y, z = points.T
    radius, step = np.hypot(y, z), pi / pocket_count
    tests = (
        z,
        radius * (np.arctan2(z, y) - step),
        radius - 0.5 * cage.bore,
        radius - 0.5 * cage.outside_diameter,
        np.sqrt(x**2 + (y - pitch_radius) ** 2 + z**2) - 0.5 * cage.pocket_diameter,
        x - cage.tip,
        x - cage.back,
    )
    tiny = 1e-6 * cage.outside_diameter
    for name, distance in zip(NAMED, tests):
        if np.abs(distance).max() < tiny:
            return name
    return _REST
