"""The deformed cage with its stress, to be turned: one plotly figure from a mesh and arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from flexcage.mesh.rows import RowFrame, pockets_at
from flexcage.render import sheet
from flexcage.render.scene import surface_of, surface_vertices
from flexcage.report.blocks import Chart
from flexcage.report.plots import FONT
from flexcage.stress.midpoints import SHARP

ELEVATION = radians(34.0)  # of the first view above the ring's plane, as in the pictures
_CLOSE = 0.02  # of the colours' range: how far stress on an undivided edge may be from its own
_BAR = 70  # pixels of height that the colour bar takes
_OVER = 0.03  # share of the colour bar that stands for values beyond its range


@dataclass(frozen=True)
class CageStress:
    """The stress of one cage at one instant, at its nodes."""

    name: str
    points: np.ndarray  # (n, 3) [m], not deformed by load
    tets: np.ndarray  # (m, 4 or 10)
    displacement: np.ndarray  # (n, 3) [m]
    von_mises: np.ndarray  # (n,) [Pa]
    time: float  # [s]
    peak_vertex: int
    pocket_count: int
    rows: tuple[RowFrame, ...] = ()  # of pockets, of a common cage of several


def cage_chart(cages: Sequence[CageStress], *, scale: float, title: str) -> Chart:
    """One view for all cages: they share the deformation's scale, the colours and the camera."""
    limit, over = common_limit(cages)
    figures = [(_named(cage), cage_figure(cage, scale, limit, over)) for cage in cages]
    beyond = " Vermilion marks what lies beyond the colours' range." if over else ""
    return Chart(
        title,
        figures,
        f"Elastic deformation drawn {scale:g} times too large; the thin grey lines are the cage "
        "without load. Drag to turn, use the wheel or two fingers to zoom, point at the surface "
        f"to read the stress.{beyond}",
        height=560,
    )


def _named(cage: CageStress) -> str:
    return f"{cage.name}, t = {cage.time * 1e3:.3f} ms" if cage.name else ""


def common_limit(cages: Sequence[CageStress]) -> tuple[float, bool]:
    """Upper end [Pa] of a colour range that suits all cages, and whether values lie beyond it."""
    ends = [sheet.robust_limit(_at_vertices(cage) * 1e-6) for cage in cages]
    top = max(end for end, _ in ends)
    return top * 1e6, any(float(_at_vertices(cage).max()) > top * 1e6 for cage in cages)


def _at_vertices(cage: CageStress) -> np.ndarray:
    return cage.von_mises[surface_vertices(cage.tets)]


def cage_figure(cage: CageStress, scale: float, limit: float, over: bool) -> Any:
    """Surface of the cage deformed ``scale`` times, coloured over 0 ... ``limit`` [Pa]."""
    import plotly.graph_objects as go

    triangles = surface_of(cage.tets, cage.von_mises, within=_CLOSE * limit).triangles
    moved = cage.points + scale * cage.displacement
    corner, sharp = split_at_edges(cage.points, triangles)
    vertex = np.empty(int(corner.max()) + 1, int)
    vertex[corner.ravel()] = triangles.ravel()
    at, stress = moved[vertex], cage.von_mises[vertex] * 1e-6
    i, j, k = corner.T.astype(np.uint32)
    scales, top = _colours(limit * 1e-6, over)
    figure = go.Figure(
        go.Mesh3d(
            **_mm(at), i=i, j=j, k=k, intensity=stress.astype(np.float32), name="",
            colorscale=scales, cmin=0.0, cmax=top, colorbar=_bar(limit * 1e-6),
            customdata=_places(cage, vertex),
            hovertemplate="%{customdata[0]:.1f} MPa<br>at pocket %{customdata[1]}<extra></extra>",
            lighting={"ambient": 0.9, "diffuse": 0.3, "specular": 0.04, "roughness": 0.9,
                      "fresnel": 0.0},
            lightposition={"x": 1e3, "y": 1e3, "z": 1e3}, flatshading=False,
        )
    )  # fmt: skip
    figure.add_trace(_lines(moved[sharp], "rgba(16, 16, 16, 0.45)"))
    figure.add_trace(_lines(cage.points[sharp], "rgba(140, 140, 140, 0.9)"))
    return figure.update_layout(**_layout(cage, moved[cage.peak_vertex], np.ptp(moved, axis=0)))


def split_at_edges(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices of a closed surface doubled along its sharp edges, so that shading breaks there.

    Returns for every corner of the triangles (n, 3) its new vertex, numbered from 0, and the
    sharp edges as pairs of the old ones (e, 2).
    """
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    n = len(triangles)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    starts = np.concatenate([np.arange(n) * 3 + k for k in range(3)])  # corners at edges' ends
    ends = np.concatenate([np.arange(n) * 3 + (k + 1) % 3 for k in range(3)])
    backwards = edges[:, 0] > edges[:, 1]
    first, last = np.where(backwards, ends, starts), np.where(backwards, starts, ends)
    key = np.sort(edges, axis=1)
    order = np.lexsort(key.T)
    here, there = order[:-1], order[1:]
    met = (key[here] == key[there]).all(axis=1)
    here, there = here[met], there[met]  # halves of one edge, on its two triangles
    smooth = (normal[here % n] * normal[there % n]).sum(axis=1) > cos(SHARP)
    sharp = key[here[~smooth]]
    one, two = here[smooth], there[smooth]
    rows = np.concatenate([first[one], last[one]])
    columns = np.concatenate([first[two], last[two]])
    links = coo_array((np.ones(len(rows)), (rows, columns)), shape=(3 * n, 3 * n))
    return connected_components(links, directed=False)[1].reshape(-1, 3), sharp


def _mm(points: np.ndarray) -> dict[str, np.ndarray]:
    """Coordinates in mm, in single precision, by the view's own axes.

    The view turns about its z, so that is the bearing's x; its x and y are the bearing's y and z.
    """
    return dict(zip("zxy", (points * 1e3).astype(np.float32).T))


def _places(cage: CageStress, vertex: np.ndarray) -> np.ndarray:
    """Stress [MPa] and nearest pocket of every vertex (n, 2), for pointing at them."""
    pocket = pockets_at(cage.points[vertex], cage.pocket_count, cage.rows)
    return np.stack([cage.von_mises[vertex] * 1e-6, pocket], axis=1).astype(np.float32)


def _lines(ends: np.ndarray, colour: str) -> Any:
    """Line segments (e, 2, 3) as one trace."""
    import plotly.graph_objects as go

    path = np.full((len(ends), 3, 3), np.nan)
    path[:, :2] = ends
    return go.Scatter3d(
        **_mm(path.reshape(-1, 3)), mode="lines", line={"color": colour, "width": 1.5},
        hoverinfo="skip", showlegend=False,
    )  # fmt: skip


def _peak_note(cage: CageStress, at: np.ndarray) -> dict[str, Any]:
    """The peak's value, with an arrow to its place [m]; it stays in front when the cage turns."""
    peak = cage.von_mises[cage.peak_vertex] * 1e-6
    return {
        **dict(zip("zxy", (1e3 * at).tolist())), "text": f"peak {peak:.3g} MPa",
        "ax": 60, "ay": 70, "arrowhead": 2, "arrowwidth": 1.5, "arrowcolor": sheet.INK,
        "font": FONT, "bgcolor": "rgba(255, 255, 255, 0.85)", "bordercolor": sheet.HAIR,
        "borderpad": 3,
    }  # fmt: skip


def _colours(top: float, over: bool) -> tuple[list[tuple[float, str]], float]:
    """Colours of the house's pictures, with a band of their own for what is beyond ``top``."""
    cmap = sheet.colour_map("viridis")
    shares = np.linspace(0.0, 1.0, 33)
    colours = ["rgb({},{},{})".format(*(int(255 * v) for v in cmap(s)[:3])) for s in shares]
    if not over:
        return list(zip(shares.tolist(), colours)), top
    body = 1.0 - _OVER
    scale = [(float(s) * body, c) for s, c in zip(shares, colours)]
    return [*scale, (body, sheet.VERMILION), (1.0, sheet.VERMILION)], top / body


def _bar(top: float) -> dict[str, Any]:
    return {
        "title": {"text": "equivalent stress [MPa]", "side": "top", "font": FONT},
        "orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.02, "yanchor": "top",
        "len": 0.9, "thickness": 16, "tickfont": FONT, "outlinewidth": 0.6,
        "tick0": 0.0, "dtick": sheet.rounded_down(top / 4.0),
    }  # fmt: skip


def _layout(cage: CageStress, peak: np.ndarray, span: np.ndarray) -> dict[str, Any]:
    """Layout of a view of a body that spans ``span`` (3,) [m] along x, y and z.

    ``meta`` tells the page's script how wide the body may be in shares of the view's height (its
    upright size must fit as well), and how many pixels the colour bar takes.
    """
    share = span / span.max()
    upright = sin(ELEVATION) + cos(ELEVATION) * float(share[0])
    hidden = {"visible": False, "showspikes": False}
    _, y, z = cage.points[cage.peak_vertex]
    azimuth = float(np.arctan2(z, y))
    eye = (sin(ELEVATION), cos(ELEVATION) * cos(azimuth), cos(ELEVATION) * sin(azimuth))
    camera = {
        "up": {"x": 0, "y": 0, "z": 1},
        "eye": dict(zip("zxy", (1.25 * e for e in eye))),
        "projection": {"type": "orthographic"},
    }
    return {
        "template": "none",
        "font": FONT,
        "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
        "meta": {"widest": min(0.84 / upright, 1.0), "spare": _BAR},
        "scene": {
            "xaxis": hidden, "yaxis": hidden, "zaxis": hidden,
            "aspectmode": "manual", "aspectratio": dict(zip("zxy", share.tolist())),
            "camera": camera, "dragmode": "turntable", "uirevision": "kept",
            "annotations": [_peak_note(cage, peak)],
        },
        "uirevision": "kept",
        "hoverlabel": {"bgcolor": "white", "font": FONT},
        "modebar": {"orientation": "v", "color": sheet.FAINT},
    }  # fmt: skip
