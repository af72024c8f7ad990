"""A quarter of one sector of a riveted ribbon cage: half of one half's sheet round a ball.

The sheet is revolved about the axis through the ball's centre, cut by the cylinders of bore and
outside, and gets a rivet's head; where the head holds it down it belongs to the plane that both
halves share. The rest of its flats stands off that plane by a hair, so that mirrored vertices
are two.
"""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt
from typing import Any

import numpy as np

from flexcage.cages.ribbon.cage import HEAD_HEIGHT, RibbonCage
from flexcage.core.errors import RunFailed
from flexcage.mesh.gmsh_session import gmsh_model
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

# size over the sheet's thickness; size at the necks beside a pocket's side openings over their
# breadth, which the lowest frequencies hang on (tests/README.md); growth of the size away from them
_NAMED = {
    "coarse": (1.4, 1.0, 1.2),
    "medium": (1.1, 0.5, 0.9),
    "fine": (0.8, 0.28, 0.6),
    "paper": (0.4, 0.2, 0.5),
}
_GAP = 1e-3  # of the thickness, between each half's flat and the middle plane
SURFACES = ("cut_z", "cut_psi", "land_inner", "land_outer", "wall", "joint")


def stand_off(cage: RibbonCage) -> float:
    """How far [m] the loose flats of each half are off the middle plane."""
    return _GAP * cage.thickness


def ribbon_size_plan(cage: RibbonCage, pitch_radius: float, options: MeshOptions) -> SizePlan:
    """Sizes that a named fineness, or the user's own, mean on this cage."""
    share, near, growth = _NAMED[options.fineness]
    size = options.size or share * cage.thickness
    at_neck = size
    if cage.opening:
        radii = (0.5 * cage.outside_diameter - pitch_radius, pitch_radius - 0.5 * cage.bore)
        at_neck = min(size, near * (max(radii) - cage.opening))
    arcs = max(1, round(0.25 * pi * cage.pocket_diameter / size))
    return SizePlan(size, at_neck, growth, arcs, 1, 1.0)


def mesh_ribbon_quarter(
    cage: RibbonCage, *, pocket_count: int, pitch_diameter: float, options: MeshOptions
) -> Quarter:
    """Mesh the quarter sector; lengths go to gmsh in mm, where OpenCASCADE's tolerances fit."""
    plan = ribbon_size_plan(cage, 0.5 * pitch_diameter, options)
    with gmsh_model("flexcage quarter sector of a ribbon cage") as gmsh:
        _shape(gmsh, cage, pocket_count, 0.5 * pitch_diameter)
        _set_sizes(gmsh, plan, cage)
        generate(gmsh, plan)
        points, tets, faces = mesh_arrays(gmsh)
    surfaces = named_surfaces(
        faces, points, lambda on: _surface_name(on, cage, pocket_count, 0.5 * pitch_diameter),
        (*SURFACES, "cut_x", "end"),
    )  # fmt: skip
    held, loose = (np.unique(surfaces[name]) for name in ("cut_x", "joint"))
    points[loose, 0] = stand_off(cage)
    points[held, 0] = 0.0  # exact, so that mirror images coincide
    points[np.unique(surfaces["cut_z"]), 2] = 0.0
    return Quarter(points, tets, surfaces, plan)


def _shape(gmsh: Any, cage: RibbonCage, pocket_count: int, pitch_radius: float) -> None:
    """The quarter sector in (x, y, z) [mm], the ball's centre on the y axis."""
    occ = gmsh.model.occ
    middle, step = pitch_radius / MM, pi / pocket_count
    inner, outer = 0.5 * cage.bore / MM, 0.5 * cage.outside_diameter / MM
    high = cage.reach / MM + 1.0
    sheet = occ.addPlaneSurface([occ.addCurveLoop(_profile(occ, cage, middle, outer + middle))])
    body = solids_of(occ.revolve([(2, sheet)], 0.0, middle, 0.0, 1.0, 0.0, 0.0, pi))
    corners = ((0.0, inner), (high, inner), (high, outer), (0.0, outer))
    points = [occ.addPoint(x, r, 0.0) for x, r in corners]
    lines = [occ.addLine(points[i - 1], points[i]) for i in range(4)]
    section = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    wedge = solids_of(occ.revolve([(2, section)], 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, step))
    y, z = middle * cos(step), middle * sin(step)
    head, rise = cage.head_radius / MM, HEAD_HEIGHT * cage.rivet_diameter / MM
    half = 0.5 * cage.thickness / MM
    rivet = [(3, occ.addCylinder(half, y, z, half + rise, 0.0, 0.0, head))]
    body = occ.fuse(body, rivet)[0]
    body = occ.intersect(body, wedge)[0]
    disk = occ.addDisk(0.0, y, z, head, head, zAxis=[1.0, 0.0, 0.0])
    body = solids_of(occ.fragment(body, [(2, disk)])[0])
    occ.synchronize()
    if len(body) != 1:
        raise RunFailed("the cage's quarter sector falls into several pieces")
    remove_loose_faces(gmsh, body)


def _profile(occ: Any, cage: RibbonCage, middle: float, far: float) -> list[int]:
    """Lines and arcs round the sheet's section, in the plane z = 0 above the ball's centre [mm]."""
    radius, thick = 0.5 * cage.pocket_diameter / MM, cage.thickness / MM
    outside, end, flat = radius + thick, cage.reach / MM, far - middle
    x, rho = (value / MM for value in cage.bend_centre)
    touch = outside / hypot(x, rho)  # where sphere and bend meet, on the line of their middles

    def at(x: float, rho: float) -> int:
        return occ.addPoint(x, middle + rho, 0.0)

    def arc(a: int, b: int, centre: int) -> int:
        return occ.addCircleArc(a, centre, b)

    ball, bend = at(0.0, 0.0), at(x, rho)
    mouth, corner, low = at(0.0, radius), at(0.0, flat), at(thick, flat)
    # a closed pocket's sheet ends on the axis itself: a point off it by rounding's square root, as
    # sqrt(outside**2 - end**2) is, is near OpenCASCADE's tolerance, and no solid is revolved
    side = sqrt(outside**2 - end**2) if cage.opening else 0.0
    inside = at(end if cage.opening else radius, cage.opening / MM)
    top = at(end if cage.opening else outside, side)
    met, foot = at(touch * x, touch * rho), at(thick, rho)
    return [
        arc(mouth, inside, ball), occ.addLine(inside, top), arc(top, met, ball),
        arc(met, foot, bend), occ.addLine(foot, low), occ.addLine(low, corner),
        occ.addLine(corner, mouth),
    ]  # fmt: skip


def _set_sizes(gmsh: Any, plan: SizePlan, cage: RibbonCage) -> None:
    """Fine round the side opening, growing to the size of all else."""
    field, end = gmsh.model.mesh.field, cage.reach / MM - 1e-3
    rims = [tag for _, tag in gmsh.model.getEntities(1) if _lowest(gmsh, tag) > end]
    distance = field.add("Distance")
    field.setNumbers(distance, "CurvesList", rims)
    field.setNumber(distance, "Sampling", 60)
    grow_from(gmsh, distance, plan)


def _lowest(gmsh: Any, curve: int) -> float:
    """Least x [mm] of a curve."""
    return gmsh.model.getBoundingBox(1, curve)[0]


def _surface_name(
    points: np.ndarray, cage: RibbonCage, pocket_count: int, pitch_radius: float
) -> str:
    """Which surface of the quarter all these points lie on."""
    x, y, z = points.T
    radius, step = np.hypot(y, z), pi / pocket_count
    tests = (
        z,
        radius * (np.arctan2(z, y) - step),
        radius - 0.5 * cage.bore,
        radius - 0.5 * cage.outside_diameter,
        np.sqrt(x**2 + (y - pitch_radius) ** 2 + z**2) - 0.5 * cage.pocket_diameter,
        x,
    )
    tiny = 1e-6 * cage.outside_diameter
    for name, distance in zip(SURFACES, tests):
        if np.abs(distance).max() < tiny:
            away = np.hypot(y - pitch_radius * cos(step), z - pitch_radius * sin(step))
            held = name == "joint" and away.max() < cage.head_radius + tiny
            return "cut_x" if held else name
    return "end"
