"""The cage's mesh with its defects marked."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from pathlib import Path

import numpy as np

from flexcage.geometry.defect import CageDefect, CageLine
from flexcage.mesh.cage_mesh import POCKET_GROUPS, WALL_GROUPS, CageMesh, pocket_groups
from flexcage.mesh.rows import RowFrame, frame_of
from flexcage.render import marks, sheet
from flexcage.render.defects import COLOURS, azimuth_of, legend, pocket_colours
from flexcage.render.scene import (
    BodySurface,
    Layer,
    View,
    body_layer,
    outline_layer,
    ring_size,
    ring_view,
    surface_of,
)
from flexcage.render.stage import Picture, Stage

MAIN = (1180, 880)
SIDE = (520, 355)
TOP, GAP, EDGE = 96, 30, 36
BODY = "#d9dde3"
_DETAIL = {POCKET_GROUPS: "corner of pocket 0", WALL_GROUPS: "edge of pocket 0"}


def mesh_picture(
    mesh: CageMesh,
    path: str | Path,
    *,
    defects: Sequence[CageDefect] = (),
    title: str = "Mesh of the cage",
    note: str = "",
    azimuth: float | None = None,
) -> Path:
    """The whole mesh, damaged pockets coloured, and close-ups of the first two defects.

    Pockets made smaller are vermilion, those made larger blue, displaced ones purple, and cracks
    vermilion lines; dashed lines show where a pocket's outer rim would be without the defect. With
    fewer than two defects the close-ups show a pocket and its corner or edge instead.
    ``azimuth`` [rad] is the place turned to the viewer; if not given, that of the first defect, so
    that its mark is seen: meshes with other defects are then seen from elsewhere.
    """
    radius, width = ring_size(mesh.points)
    if azimuth is None:
        azimuth = azimuth_of(defects[0], mesh) if defects else 0.0
    view = ring_view(radius, width, aspect=MAIN[0] / MAIN[1], azimuth=azimuth)
    shown: list[CageDefect | str] = [*defects[:2], "pocket", "corner"]
    shown = shown[:2] if len(defects) != 1 else [defects[0], "corner"]
    with Stage(_mesh_layers(mesh)) as stage:
        main = stage.shoot(view, MAIN)
        closes = [stage.shoot(_close_view(d, mesh, radius), SIDE) for d in shown]
    left = EDGE + MAIN[0] + GAP
    with sheet.style():
        figure = sheet.new_figure(left + SIDE[0] + EDGE, TOP + MAIN[1] + EDGE)
        cells = f"{len(mesh.points):,} vertices, {len(mesh.tets):,} tetrahedra"
        sheet.heading(figure, title, sheet.join([note, cells, *(d.label for d in defects)]))
        ax = sheet.image_at(figure, (EDGE, TOP, *MAIN), main.pixels)
        marks.triad(ax, main)
        colours = pocket_colours(defects, mesh.pocket_count)
        marks.pocket_numbers(
            ax, main, count=mesh.pocket_count, radius=radius, width=width, colours=colours
        )
        for pocket, colour in colours.items():
            _fill_pocket(ax, main, mesh, pocket, colour)
        _mark_lines(defects, ax, main, mesh)
        for i, (defect, close) in enumerate(zip(shown, closes)):
            rect = (left, TOP + i * (SIDE[1] + 44), *SIDE)
            _close_panel(figure, rect, close, mesh, defect, defects)
        rows = legend(defects, mesh.pocket_count)
        if rows:
            marks.key(figure, (left, TOP + len(shown) * (SIDE[1] + 44) + 8, SIDE[0], 0), rows)
        return sheet.save(figure, path)


def _mesh_layers(mesh: CageMesh) -> list[Layer]:
    whole = BodySurface(surface_of(mesh.tets).triangles).polydata(mesh.points)
    return [
        body_layer(whole, colour=BODY, edges="#70777f", width=0.175),
        outline_layer(whole, width=0.35),
    ]


def _fill_pocket(ax, picture: Picture, mesh: CageMesh, pocket: int, colour: str) -> None:
    """Colour a pocket's opening if its outer rim faces the viewer."""
    chain = _chain(_rim(mesh, pocket))
    if chain is None:
        return
    centre = mesh.points[chain].mean(axis=0) * (0.0, 1.0, 1.0)
    eye = np.asarray(picture.view.focus) + picture.distance * np.asarray(picture.view.direction)
    if (eye - centre) @ centre <= 0.0:
        return
    xy = picture.place(mesh.points[chain])
    ax.fill(xy[:, 0], xy[:, 1], facecolor=colour, alpha=0.5, edgecolor="none")
    ax.plot(xy[:, 0], xy[:, 1], color=colour, lw=1.4)


def _mark_lines(defects: Sequence[CageDefect], ax, picture: Picture, mesh: CageMesh) -> None:
    """Draw what is seen of the lines that mark defects, such as cracks."""
    for defect in defects:
        lines = _lines_of(defect, mesh)
        seen = [picture.place(line.points) for line in lines if picture.sees(line.seen_at)]
        for width, colour in ((4.0, "white"), (2.2, COLOURS["crack"])):  # all rims below all lines
            for xy in seen:
                ax.plot(*xy.T, color=colour, lw=width, solid_capstyle="round")


def _lines_of(defect: CageDefect, mesh: CageMesh) -> Sequence[CageLine]:
    """Lines that mark a defect, found in the frame of its row."""
    count, number = mesh.pocket_count, defect.number
    frame = frame_of(mesh.info, number, count)
    own = defect.moved_by(number % count - number).lines(frame.into(mesh.points), count)
    return [
        CageLine(frame.out_of(line.points), frame.out_of(line.seen_at[None])[0]) for line in own
    ]


def _close_view(shown: CageDefect | str, mesh: CageMesh, radius: float) -> View:
    """Nearly radial view of a beam that moved, or of pocket 0; axis upwards, +psi to the right."""
    psi = 0.0 if isinstance(shown, str) else azimuth_of(shown, mesh)
    radial, axis = np.array([0.0, np.cos(psi), np.sin(psi)]), np.array([1.0, 0.0, 0.0])
    width = 2.0 * float(np.abs(mesh.points[:, 0]).max())
    frame = RowFrame()
    if not isinstance(shown, str):
        frame = frame_of(mesh.info, shown.number, mesh.pocket_count)
    focus = 0.96 * radius * radial + frame.place * axis
    height, direction = 0.8 * width, radial + 0.22 * axis
    if shown == "pocket":
        height = 1.16 * width
    elif shown == "corner":
        rim = mesh.points[np.unique(_rim(mesh, 0))]
        focus, height = rim[np.argmax(rim[:, 0] + rim[:, 2])], 0.22 * width
        direction = radial - 0.45 * axis - np.array([0.0, 0.0, 0.45])
    elif not isinstance(shown, str) and (way := shown.way(mesh.pocket_count)):
        aside = frame.sign * way[0] * width * axis
        focus = focus + 0.16 / 0.78 * aside  # a fifth of the way to its place
    return View(tuple(direction / np.linalg.norm(direction)), tuple(focus), height)


def _close_panel(
    figure,
    rect: sheet.Rect,
    picture: Picture,
    mesh: CageMesh,
    shown: CageDefect | str,
    defects: Sequence[CageDefect],
) -> None:
    ax = sheet.image_at(figure, rect, picture.pixels, frame=sheet.FAINT)
    marks.length_bar(ax, picture, share=0.12)
    if isinstance(shown, str):
        text = {"corner": _DETAIL[pocket_groups(mesh.groups)]}.get(shown, "pocket 0")
    else:
        text = shown.label
        colours = pocket_colours(defects, mesh.pocket_count)
        for pocket in shown.pockets(mesh.pocket_count):
            if pocket in colours:
                _fill_pocket(ax, picture, mesh, pocket, colours[pocket])
                _sound_outline(ax, picture, mesh, pocket, defects)
            _pocket_name(ax, picture, mesh, pocket)
        _mark_lines(defects, ax, picture, mesh)
        _arrow(ax, picture, mesh, shown)
    caption = sheet.text_at(
        figure, rect[0], rect[1] + rect[3] + 8, text, fontsize=9.5, weight="bold"
    )
    sheet.fit_width(figure, caption, rect[2])


def _sound_outline(
    ax, picture: Picture, mesh: CageMesh, pocket: int, defects: Sequence[CageDefect]
) -> None:
    """Outer rim of a sound pocket, turned to where this one would be, as dashed lines."""
    touched = {p for d in defects for p in d.pockets(mesh.pocket_count)}
    first = pocket // mesh.pocket_count * mesh.pocket_count  # of its row
    row = range(first, first + mesh.pocket_count)
    sound = next((k for k in row if k not in touched), None)
    if sound is None:
        return
    rim = _rim(mesh, sound)
    turn = 2.0 * pi * (pocket - sound) / mesh.pocket_count
    c, s = np.cos(turn), np.sin(turn)
    points = mesh.points @ np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]).T
    chain = _chain(rim)
    if chain is None:
        return
    xy = picture.place(points[chain])
    for width, colour, dash in ((2.2, "white", "-"), (1.1, sheet.BLACK, (0, (3.5, 2.0)))):
        ax.plot(xy[:, 0], xy[:, 1], color=colour, lw=width, ls=dash)


def _rim(mesh: CageMesh, pocket: int) -> np.ndarray:
    """Edges (n, 2) of a pocket's wall on the outside of the cage."""
    parts = pocket_groups(mesh.groups)
    names = [f"pocket{pocket}_{face}" for face in parts]
    triangles = np.concatenate([mesh.groups[n] for n in names if n in mesh.groups])
    edges = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    edges, count = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    edges = edges[count == 1]
    if parts == POCKET_GROUPS and "land_outer" in mesh.groups:
        return edges[np.isin(edges, mesh.groups["land_outer"]).all(axis=1)]
    r = np.hypot(mesh.points[:, 1], mesh.points[:, 2])
    return edges[r[edges].min(axis=1) > 0.5 * (r.min() + r.max())]


def _chain(edges: np.ndarray) -> np.ndarray | None:
    """Vertices of a closed loop of edges in order; None if the edges are no single loop."""
    neighbours: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    if any(len(n) != 2 for n in neighbours.values()) or not neighbours:
        return None
    start = next(iter(neighbours))
    loop, previous = [start], -1
    while len(loop) <= len(neighbours):
        a, b = neighbours[loop[-1]]
        following = b if a == previous else a
        previous = loop[-1]
        loop.append(following)
        if following == start:
            break
    return np.array(loop) if len(loop) == len(neighbours) + 1 else None


def _pocket_name(ax, picture: Picture, mesh: CageMesh, pocket: int) -> None:
    frame = frame_of(mesh.info, pocket, mesh.pocket_count)
    psi, radius = frame.turned + 2.0 * pi * pocket / mesh.pocket_count, ring_size(mesh.points)[0]
    middle = np.array([frame.place, radius * np.cos(psi), radius * np.sin(psi)])
    x, y = picture.place(middle)[0]
    h, w = picture.pixels.shape[:2]
    x = float(np.clip(x, 62, w - 62))
    if 0 < y < h:
        ax.text(
            x,
            y,
            f"pocket {pocket}",
            ha="center",
            va="center",
            fontsize=9,
            path_effects=marks.halo(3.0),
        )


def _arrow(ax, picture: Picture, mesh: CageMesh, defect: CageDefect) -> None:
    """Where beam or pocket went, on the outside of the cage; its length is not to scale."""
    way = defect.way(mesh.pocket_count)
    if way is None:
        return
    psi = azimuth_of(defect, mesh)
    radius, width = ring_size(mesh.points)
    frame = frame_of(mesh.info, defect.number, mesh.pocket_count)
    half = 0.5 * width - abs(frame.place)  # of the cage of its row
    middle = radius * np.array([0.0, np.cos(psi), np.sin(psi)])
    middle[0] = frame.place + frame.sign * way[0] * half
    step = 1.1e-3 * way[1] @ frame.axes
    a, b = picture.place(np.array([middle - step, middle + step]))
    ax.annotate(
        "",
        xy=b,
        xytext=a,
        arrowprops={
            "arrowstyle": "simple,head_width=0.9,head_length=0.8,tail_width=0.28",
            "facecolor": sheet.BLACK,
            "edgecolor": "white",
            "linewidth": 1.0,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )
