"""Pictures of a machine in motion: orbits of its shaft, and its forces on the bearings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from flexcage.render import sheet

_LEFT, _TOP, _ROOM = 110, 120, 100
_WIDE, _HIGH, _BETWEEN = 1180, 180, 30
_MOST = 6  # orbits in a row, of _LARGEST pixels at the most
_LARGEST = 230
_AXES = (("y", sheet.BLUE), ("z", sheet.VERMILION), ("x", sheet.GREEN))


def shaft_picture(
    time: np.ndarray, moved: Mapping[str, np.ndarray], force: Mapping[str, np.ndarray],
    path: str | Path, *, title: str,
) -> Path:  # fmt: skip
    """Orbits (n, 2) along y and z [m] by place, about their means and on one scale, and forces
    (n, 3) along x, y, z [N] on the inner ring by bearing, over ``time`` (n,) [s]."""
    columns = min(len(moved), _MOST)
    rows, pitch = -(-len(moved) // columns), _WIDE / columns
    side = min(pitch - 60.0, _LARGEST)
    top = _TOP + rows * (side + _ROOM)
    height = top + len(force) * (_HIGH + _BETWEEN) + 40
    apart = {name: 1e6 * (values - values.mean(axis=0)) for name, values in moved.items()}
    reach = 1.1 * max(max(float(np.abs(values).max()) for values in apart.values()), 1e-3)
    with sheet.style():
        figure = sheet.new_figure(_LEFT + _WIDE + 60, height)
        note = "the shaft's axis about its mean places, on one scale; its forces on the inner rings"
        sheet.heading(figure, sheet.label(title), note)
        for k, (name, values) in enumerate(apart.items()):
            down = _TOP + (k // columns) * (side + _ROOM)
            ax = sheet.axes_at(figure, (_LEFT + (k % columns) * pitch, down, side, side))
            ax.plot(values[:, 1], -values[:, 0], color=sheet.BLUE, lw=0.7)
            ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", title=name,
                   xlabel="z [µm]", ylabel="-y [µm]" if k % columns == 0 else "")  # fmt: skip
        for k, (name, values) in enumerate(force.items()):
            ax = sheet.axes_at(figure, (_LEFT, top + k * (_HIGH + _BETWEEN), _WIDE, _HIGH))
            for axis, colour in _AXES:
                ax.plot(1e3 * time, values[:, "xyz".index(axis)], color=colour, lw=0.8, label=axis)
            ax.set(xlim=(1e3 * time[0], 1e3 * time[-1]), ylabel=f"force on {name} [N]")
            if k == 0:
                ax.legend(loc="upper right", ncol=3)
            if k == len(force) - 1:
                ax.set_xlabel("time [ms]")
            else:
                ax.tick_params(labelbottom=False)
        return sheet.save(figure, path)
