"""Marks on 3D pictures: places, axes, pocket numbers, lengths. Drawn by matplotlib in pixels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from flexcage.render import sheet
from flexcage.render.stage import Picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def halo(width: float = 2.2, colour: str = "white") -> list:
    """A rim round text or lines, so that they read on any colour."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=width, foreground=colour)]


def place_mark(ax: Axes, picture: Picture, at: np.ndarray, *, size: float = 15.0) -> None:
    """A ring round a place; dotted where the place lies behind something."""
    x, y = picture.place(at)[0]
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    radius = 0.5 * size * sheet.DPI / 72.0
    dashes = "-" if picture.sees(at) else (0, (1.6, 1.4))
    ax.plot(
        x + radius * np.cos(angle),
        y + radius * np.sin(angle),
        linestyle=dashes,
        color=sheet.BLACK,
        linewidth=1.5,
        path_effects=halo(3.6) if dashes == "-" else None,
    )


def triad(ax: Axes, picture: Picture, *, length: float = 62.0) -> None:
    """The axes x (bearing axis), y, z in the lower left corner, seen as the scene is."""
    focus = np.asarray(picture.view.focus)
    step = 0.05 * picture.view.height
    ends = picture.place(focus + step * np.eye(3)) - picture.place(focus)
    full = step / picture.view.height * picture.pixels.shape[0]
    low, high = ends.min(axis=0) / full * length, ends.max(axis=0) / full * length
    origin = np.array([26.0 - min(low[0], 0.0), ax.get_ylim()[0] - 26.0 - max(high[1], 0.0)])
    for name, end in zip("xyz", ends):
        arrow = end / full * length
        tip = origin + arrow
        ax.annotate(
            "",
            xy=tuple(tip),
            xytext=tuple(origin),
            arrowprops={
                "arrowstyle": "-|>",
                "lw": 1.1,
                "color": sheet.INK,
                "shrinkA": 0,
                "shrinkB": 0,
                "mutation_scale": 9,
            },
        )
        reach = np.linalg.norm(arrow)
        beyond = arrow / reach * 11.0 if reach > 6.0 else np.array([11.0, 9.0])
        ax.text(
            float(tip[0] + beyond[0]),
            float(tip[1] + beyond[1]),
            name,
            ha="center",
            va="center",
            fontsize=9,
            style="italic",
        )


def pocket_numbers(
    ax: Axes,
    picture: Picture,
    *,
    count: int,
    radius: float,
    width: float,
    colours: Mapping[int, str] | None = None,
) -> None:
    """Numbers of the pockets beside the ring: below the near half's rim, above the far half's.

    ``colours`` sets some of them off, bold.
    """
    for k in range(count):
        colour = (colours or {}).get(k)
        psi = 2.0 * np.pi * k / count
        radial = np.array([0.0, np.cos(psi), np.sin(psi)])
        near = radial @ np.asarray(picture.view.direction) > 0.0
        spot = 1.065 * radius * radial + np.array([-0.56 if near else 0.56, 0.0, 0.0]) * width
        x, y = picture.place(spot)[0]
        weight = "bold" if colour else "normal"
        ax.text(
            x,
            y,
            str(k),
            ha="center",
            va="center",
            fontsize=9.5 if colour else 8,
            weight=weight,
            color=colour or sheet.FAINT,
        )


def length_bar(ax: Axes, picture: Picture, *, share: float = 0.22) -> None:
    """A bar of a round number of millimetres at the scale of the scene's focus, lower left."""
    height, width = picture.pixels.shape[:2]
    per_metre = height / picture.view.height
    millimetres = sheet.rounded_down(share * width / per_metre * 1e3)
    pixels = millimetres * 1e-3 * per_metre
    x, y = 18.0, height - 18.0
    ax.plot(
        [x, x + pixels],
        [y, y],
        color=sheet.INK,
        lw=2.4,
        solid_capstyle="butt",
        path_effects=halo(4.4),
    )
    ax.text(
        x + 0.5 * pixels,
        y - 9.0,
        f"{millimetres:g} mm",
        ha="center",
        va="bottom",
        fontsize=8.5,
        path_effects=halo(3.0),
    )


def key(figure, rect: sheet.Rect, rows: list[tuple[str, str, str]]) -> None:
    """A legend of (kind, colour, text) rows in a rectangle; kinds: ring, line, dashes, patch."""
    left, top, width, _ = rect
    step = 28.0
    ax = sheet.axes_at(figure, (left, top, width, step * len(rows)))
    ax.set(xlim=(0, width), ylim=(step * len(rows), 0))
    ax.axis("off")
    for i, (kind, colour, text) in enumerate(rows):
        y = step * (i + 0.5)
        if kind == "ring":
            ax.plot([16], [y], "o", ms=9, mfc="none", mec=colour, mew=1.4)
        elif kind in ("line", "dashes"):
            dash = "-" if kind == "line" else (0, (3.0, 1.6))
            ax.plot([2, 30], [y, y], linestyle=dash, color=colour, lw=1.3)
        else:
            ax.fill_between([4, 28], [y - 8] * 2, [y + 8] * 2, color=colour, lw=0)
        artist = ax.text(44, y, text, va="center", fontsize=9)
        sheet.fit_width(figure, artist, width - 48.0)
