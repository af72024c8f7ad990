"""A rivet with two sheets round it: the section, meshed by gmsh, and the three bodies.

Lengths in the frame of the joint: x along the rivet, y (radial) and z (tangential) from its middle.
A round bar with two heads goes through two sheets that touch at x = 0. The sheets' holes have a
bevel under each head, which leaves room for the round at the head's root. Shank and holes, heads
and sheets lie on each other: play and interference are numbers of the contact, not of the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot, pi
from typing import Any

import numpy as np

from flexcage.geometry.riveted_joint import JointShape
from flexcage.mesh.gmsh_session import gmsh_model
from flexcage.mesh.revolved import HalfPlane, RevolvedBodies, revolved

RIVET, LOWER, UPPER = 0, 1, 2  # the bodies: the sheet at x < 0 and the one at x > 0
ROOT_ELEMENTS = 6  # over the round at a head's root
_MM = 1e-3
#: Curves of the section: where bodies touch, roots of the heads, edges of the holes.
CONTACTS = {
    "hole_lower": (RIVET, LOWER), "hole_upper": (RIVET, UPPER),
    "head_lower": (LOWER, RIVET), "head_upper": (UPPER, RIVET), "sheets": (LOWER, UPPER),
}  # fmt: skip
ROOTS = ("root_lower", "root_upper")
ENDS = ("end_lower", "end_upper")  # the sheets' cut edges, named where the strip is placed


@dataclass(frozen=True, kw_only=True)
class JointMesh:
    """How fine: ``sectors`` round the rivet, elements over a root's round, and sizes over the
    shank's radius: the largest, that of the shank and under the heads."""

    sectors: int = 16
    root: int = ROOT_ELEMENTS
    size: float = 0.5
    seat: float = 0.16
    growth: float = 0.55


def joint_bodies(shape: JointShape, mesh: JointMesh | None = None) -> RevolvedBodies:
    """Rivet, lower and upper sheet as curved tetrahedra, lengths in m."""
    mesh = mesh or JointMesh()
    found = revolved(joint_section(shape, mesh), mesh.sectors, _strip(shape, mesh.sectors))
    return found


def _strip(shape: JointShape, sectors: int) -> Any:
    """Where a point of the section at a radius and a turn lies: on circles up to the rim, on the
    strip's edge at the section's end."""
    half = 0.5 * shape.length
    corners = [(shape.outer, half), (shape.inner, half), (shape.inner, -half), (shape.outer, -half)]
    turns = [round(atan2(z, y) / (2.0 * pi) * sectors) % sectors for y, z in corners]
    ends = [*turns, turns[0] + sectors]
    places = np.array([*corners, corners[0]])
    far, rim = _end_radius(shape), shape.rim

    def place(radius: np.ndarray, turn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        angle = 2.0 * pi * turn / sectors
        circle = np.minimum(radius, rim)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        along = turns[0] + (turn - turns[0]) % sectors
        edge = np.stack([np.interp(along, ends, places[:, i]) for i in (0, 1)], axis=1)
        share = np.clip((radius - rim) / (far - rim), 0.0, None)[:, None]
        return tuple((circle + share * (edge - circle)).T)  # type: ignore[return-value]

    return place


def _end_radius(shape: JointShape) -> float:
    """Radius of the section's end, which becomes the strip's edge."""
    reach = 0.5 * (hypot(0.5 * shape.length, shape.outer) + min(shape.outer, 0.5 * shape.length))
    return max(reach, 1.2 * shape.rim)


def joint_section(shape: JointShape, mesh: JointMesh) -> HalfPlane:
    """The section of all three bodies, lengths in m."""
    with gmsh_model("flexcage section of a riveted joint") as gmsh:
        surfaces, curves = _draw(gmsh, shape)
        _set_sizes(gmsh, shape, mesh, curves)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)
        return _read(gmsh, surfaces, curves)


def _draw(gmsh: Any, shape: JointShape) -> tuple[list[int], dict[str, list[int]]]:
    """Surfaces of rivet, lower and upper sheet, and curves by name, in mm: (radius, x) drawn in
    gmsh's (x, y)."""
    geo = gmsh.model.geo
    a, head, r = (v / _MM for v in (0.5 * shape.shank_diameter, 0.5 * shape.head_diameter,
                                    shape.root_radius))  # fmt: skip
    t, high, c = (v / _MM for v in (shape.thickness, shape.head_height, shape.bevel))
    rim, far = shape.rim / _MM, _end_radius(shape) / _MM

    def point(radius: float, x: float) -> int:
        return int(geo.addPoint(radius, x, 0.0))

    def line(p: int, q: int) -> int:
        return int(geo.addLine(p, q))

    middle, edge = point(a, 0.0), {}
    curves: dict[str, list[int]] = {}
    rim_middle, far_middle = point(rim, 0.0), point(far, 0.0)
    curves["sheets"] = [line(middle, rim_middle), line(rim_middle, far_middle)]
    loops = {}
    for side, name in ((-1.0, "lower"), (1.0, "upper")):
        low, root = point(a, side * (t - c)), point(a, side * (t - r))
        under, seat = point(a + r, side * t), point(a + c, side * t)
        corner, top = point(head, side * t), point(head, side * (t + high))
        pole, centre = point(0.0, side * (t + high)), point(a + r, side * (t - r))
        far_top = point(far, side * t)
        rim_top = point(rim, side * t)
        hole, free = line(middle, low), line(low, root)
        arc = int(geo.addCircleArc(root, centre, under))
        bare, held = line(under, seat), line(seat, corner)
        curves |= {f"hole_{name}": [hole], f"head_{name}": [held], f"root_{name}": [arc]}
        rest = [line(corner, rim_top), line(rim_top, far_top), line(far_top, far_middle)]
        curves[f"end_{name}"] = [rest[-1]]
        curves[f"edge_{name}"] = [bevel := line(low, seat)]
        sheet = [hole, bevel, held, *rest, -curves["sheets"][1], -curves["sheets"][0]]
        loops[name] = geo.addCurveLoop(sheet)
        edge[name] = [hole, free, arc, bare, held, line(corner, top), line(top, pole)]
        edge[f"{name} pole"] = [pole]
    axis = line(edge["upper pole"][0], edge["lower pole"][0])
    outline = [*edge["upper"], axis, *(-e for e in reversed(edge["lower"]))]
    rivet = geo.addPlaneSurface([geo.addCurveLoop(outline)])
    surfaces = [rivet, *(geo.addPlaneSurface([loops[name]]) for name in ("lower", "upper"))]
    geo.synchronize()
    return surfaces, curves


def _set_sizes(gmsh: Any, shape: JointShape, mesh: JointMesh, curves: dict[str, list[int]]) -> None:
    """The roots' elements, growing away from them; finer where heads press."""
    field, radius = gmsh.model.mesh.field, 0.5 * shape.shank_diameter / _MM
    near = 0.5 * pi * shape.root_radius / _MM / mesh.root
    for name in ROOTS:
        gmsh.model.mesh.setTransfiniteCurve(curves[name][0], 1 + mesh.root)
    sizes = []
    seats = [c for name in ("head_lower", "head_upper") for c in curves[name]]
    roots = [c for name in ROOTS for c in curves[name]]
    for tags, small in ((roots, near), (seats, mesh.seat * radius)):
        distance = field.add("Distance")
        field.setNumbers(distance, "CurvesList", tags)
        field.setNumber(distance, "Sampling", 60)
        size = field.add("MathEval")
        far = mesh.size * radius
        field.setString(size, "F", f"Min({far}, {small} + {mesh.growth}*F{distance})")
        sizes.append(size)
    least = field.add("Min")
    field.setNumbers(least, "FieldsList", sizes)
    field.setAsBackgroundMesh(least)
    for name in ("ExtendFromBoundary", "FromPoints", "FromCurvature"):
        gmsh.option.setNumber(f"Mesh.MeshSize{name}", 0)


def _read(gmsh: Any, surfaces: list[int], curves: dict[str, list[int]]) -> HalfPlane:
    mesh = gmsh.model.mesh
    tags, coordinates, _ = mesh.getNodes()
    place = np.zeros((int(tags.max()) + 1, 2))
    place[tags] = coordinates.reshape(-1, 3)[:, :2] * _MM
    parts = [mesh.getElementsByType(9, tag)[1].reshape(-1, 6) for tag in surfaces]
    six = np.vstack(parts).astype(int)
    used = np.unique(six[:, :3])
    number = np.full(len(place), -1)
    number[used] = np.arange(len(used))
    middles = {}
    for name in ROOTS:
        for a, b, m in mesh.getElementsByType(8, curves[name][0])[1].reshape(-1, 3).astype(int):
            middles[tuple(sorted((int(number[a]), int(number[b]))))] = place[m]
    edges = {
        name: number[
            np.vstack([mesh.getElementsByType(8, t)[1].reshape(-1, 3)[:, :2] for t in own])
        ]
        for name, own in curves.items()
    }  # fmt: skip
    bodies = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return HalfPlane(place[used], number[six[:, :3]], bodies, middles, edges)  # type: ignore[arg-type]
