"""Where races and rolling elements are damaged, on pictures of the bearing: spalls, pits, flats."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.render import marks, sheet
from flexcage.render.shapes import Shapes, shapes_of

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing
    from flexcage.render.instant import Instant
    from flexcage.render.stage import Picture

_LEAST_ARC = 0.02  # rad, half of what a spall is drawn with: a small one is seen
_LEAST_SPOT = 0.35  # rad, likewise of a spot, about the middle of its element
_SPALL_NAME = 0.42  # of an element's diameter, from a race to the word
_SPOT_NAME = 0.5  # likewise, from a spot


def mark_spalls(ax: Any, picture: Picture, now: Instant, b: Bearing) -> None:
    """An arc along the race, at the near end of an element, where a race has a spall."""
    end = shapes_of(b).end
    for name, turned, sign in (("inner", now.inner_angle, -1.0), ("outer", 0.0, 1.0)):
        spall = getattr(b, f"{name}_spall", None)
        if spall is None or not spall.length:
            continue
        radius = 0.5 * (b.pitch_diameter + sign * b.element_diameter)
        half = max(0.5 * spall.length / radius, _LEAST_ARC)
        psi = spall.azimuth + turned + np.linspace(-half, half, 25)
        around = np.column_stack([np.zeros_like(psi), np.cos(psi), np.sin(psi)])
        middle = (
            np.array([end, *now.inner_position[1:]]) if sign < 0.0 else np.array([end, 0.0, 0.0])
        )
        x, y = picture.place(radius * around + middle).T
        ax.plot(x, y, color=sheet.VERMILION, lw=5.0, solid_capstyle="butt",
                path_effects=marks.halo(7.5))  # fmt: skip
        at = (radius + sign * _SPALL_NAME * b.element_diameter) * around[12] + middle
        _name(ax, picture.place(at)[0], "spall")


def mark_spots(ax: Any, picture: Picture, now: Instant, b: Bearing) -> None:
    """An arc where an element has a spot, on the rim of its side that faces the viewer; dotted
    behind something, such as the element itself."""
    radius = 0.5 * b.element_diameter
    rim = np.array([_near_rim(shapes_of(b)), 0.0, 0.0])
    spot = getattr(b, f"{b.element}_spot", None)
    for k, direction in now.spots.items():
        x, r, psi = now.position[k]
        centre = np.array([x, r * np.cos(psi), r * np.sin(psi)]) + rim
        half = max(0.5 * spot.size / radius if spot else 0.0, _LEAST_SPOT)
        turn = np.linspace(-half, half, 25)
        c, s = np.cos(turn), np.sin(turn)
        _, y, z = direction
        around = np.column_stack([np.full(25, direction[0]), c * y - s * z, s * y + c * z])
        seen = picture.sees(centre + 1.02 * radius * direction)
        line = {"lw": 5.0} if seen else {"lw": 3.0, "ls": (0, (1.0, 1.0))}
        ax.plot(*picture.place(centre + radius * around).T, color=sheet.VERMILION,
                solid_capstyle="butt", path_effects=marks.halo(7.5), **line)  # fmt: skip
        at = centre + (1.0 + 2.0 * _SPOT_NAME) * radius * direction
        _name(ax, picture.place(at)[0], spot.kind if spot else "spot")


def _name(ax: Any, at: np.ndarray, word: str) -> None:
    ax.text(*at, word, color=sheet.VERMILION, weight="bold", fontsize=9.5, ha="center",
            va="center", path_effects=marks.halo(3.0))  # fmt: skip


def _near_rim(shapes: Shapes) -> float:
    """Place [m] along an element's axis, from its centre towards the viewer, up to which it is as
    thick as anywhere."""
    most = max(r for _, r in shapes.element)
    return max(x for x, r in shapes.element if r > 0.999999 * most)
