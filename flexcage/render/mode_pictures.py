"""Sheets of mode shapes."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from pathlib import Path

import numpy as np

from flexcage.render import marks, sheet
from flexcage.render.scene import (
    coloured_layer,
    outline_layer,
    ring_size,
    ring_view,
    surface_of,
)
from flexcage.render.stage import shoot

TOP, EDGE = 96, 36
_CELL = (420, 318)
_CAPTION = 44


def mode_sheet(
    points: np.ndarray,
    tets: np.ndarray,
    shapes: np.ndarray,
    frequencies: np.ndarray,
    kinds: Sequence[str],
    path: str | Path,
    *,
    count: int = 12,
    columns: int = 4,
    title: str = "Modes of the cage",
    note: str = "",
) -> Path:
    """A grid of mode shapes (n_nodes, 3, n) with frequency [Hz] and kind, each to its own scale."""
    count = min(count, shapes.shape[2])
    columns = min(columns, count)
    rows = ceil(count / columns)
    surface = surface_of(tets)
    radius, width = ring_size(points)
    view = ring_view(radius, width, aspect=_CELL[0] / _CELL[1], elevation=38.0, margin=1.32)
    cmap = sheet.colour_map("viridis")
    pictures = []
    ghost = outline_layer(surface.polydata(points), colour="#9a9a9a", width=0.25)
    for i in range(count):
        size = np.linalg.norm(shapes[:, :, i], axis=1)
        relative = size / size.max()
        moved = surface.polydata(points + 0.13 * radius / size.max() * shapes[:, :, i], relative)
        body = coloured_layer(moved, cmap=cmap, limits=(0.0, 1.0))
        pictures.append(shoot([body, ghost], view, _CELL).pixels)
    with sheet.style():
        w, h = columns * _CELL[0] + 2 * EDGE, TOP + rows * (_CELL[1] + _CAPTION) + 104
        figure = sheet.new_figure(w, h)
        more = f"first {count} of {shapes.shape[2]}" if shapes.shape[2] > count else f"{count}"
        sheet.heading(figure, title, sheet.join([note, f"{more} modes", "shapes to no scale"]))
        for i, pixels in enumerate(pictures):
            x = EDGE + (i % columns) * _CELL[0]
            y = TOP + (i // columns) * (_CELL[1] + _CAPTION)
            sheet.put_pixels(figure, x, y, pixels)
            sheet.text_at(
                figure,
                x + 0.5 * _CELL[0],
                y + _CELL[1] + 4,
                f"$\\bf{{{i + 1}}}$   {hertz(float(frequencies[i]))}   {kinds[i]}",
                ha="center",
                fontsize=10,
            )
        sheet.colour_bar(
            figure,
            (w - EDGE - 440, h - 88, 420, 18),
            cmap=cmap,
            limits=(0.0, 1.0),
            label="displacement / its largest in the mode",
        )
        marks.key(figure, (EDGE, h - 92, 420, 0), [("line", "#9a9a9a", "cage at rest")])
        return sheet.save(figure, path)


def hertz(frequency: float) -> str:
    """A frequency with its unit, four figures."""
    if frequency >= 10e3:
        return f"{frequency * 1e-3:.2f} kHz"
    return f"{frequency:.1f} Hz" if frequency < 1e3 else f"{frequency:.0f} Hz"
