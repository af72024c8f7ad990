"""A bearing cut through its axis: rings, and the elements of every row where they stand."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import cos, sin
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import RowPlace
from flexcage.geometry.cage import EACH
from flexcage.render import sheet
from flexcage.render.shapes import Profile, shapes_of

_SIDE, _TOP, _LEFT = 760, 110, 96
_RING, _ELEMENT, _CAGE = "#c9d3de", "#f2d9a0", "#d8a24a"


def has_section(bearing: Any) -> bool:
    """Is it of rows, and of a family with profiles?"""
    family = FAMILIES.get(bearing.family)
    return family is not None and family.shapes is not None and bearing.row_count > 1


def section_picture(
    bearing: Any, path: str | Path, *, cage: Any = None, title: str = "", note: str = ""
) -> Path:
    """The half of a bearing of rows above its axis, in mm, with the lines of contact, and beside a
    pocket its ``cage``, if it is given; ``note`` says whose it is."""
    shapes, angle = shapes_of(bearing), bearing.nominal_contact_angle
    with sheet.style():
        figure = sheet.new_figure(2 * _LEFT + _SIDE, _TOP + _SIDE + 90)
        sheet.heading(figure, title or "Section through the axis", sheet.label(note))
        ax = sheet.axes_at(figure, (_LEFT, _TOP, _SIDE, _SIDE))
        for ring in (shapes.inner, shapes.outer):
            _fill(ax, ring, 0, _RING, lambda points: points)
        for row in bearing.row_places:
            lean = -row.sense * angle
            middle = np.array([row.place, 0.5 * bearing.pitch_diameter])
            turn = np.array([[cos(lean), sin(lean)], [-sin(lean), cos(lean)]])
            _fill(ax, shapes.element, 1, _ELEMENT, partial(_placed, turn, middle))
            _line(ax, bearing, row.place, lean)
            _half_of_cage(ax, cage, row)
        ax.axhline(0.0, color=sheet.INK, lw=0.9, ls="-.")
        _frame(ax)
        ax.set_xlabel("x [mm]")
        ax.set_ylabel("r [mm]")
        return sheet.save(figure, path)


def _frame(ax: Any) -> None:
    """All that is drawn, to one scale: the axes are a square."""
    drawn = ax.dataLim
    half = 0.53 * max(drawn.width, drawn.height)
    for limits, middle in (
        (ax.set_xlim, drawn.x0 + 0.5 * drawn.width),
        (ax.set_ylim, drawn.y0 + 0.5 * drawn.height),
    ):
        limits(middle - half, middle + half)


def _placed(turn: np.ndarray, middle: np.ndarray, points: np.ndarray) -> np.ndarray:
    placed: np.ndarray = points @ turn + middle
    return placed


def _fill(
    ax: Any, half: Profile, mirrored: int, colour: str, place: Callable[[np.ndarray], np.ndarray]
) -> None:
    """A body of which a profile is one half: the other has coordinate ``mirrored`` turned round,
    and no edge stands where they meet."""
    for sign in (1.0, -1.0):
        outline = np.array(half)
        outline[:, mirrored] *= sign
        ax.fill(*(1e3 * place(outline).T), facecolor=colour, edgecolor="none")
        ends = np.concatenate([outline, outline[:1]])
        for edge in zip(ends[:-1], ends[1:]):
            if any(point[mirrored] != 0.0 for point in edge):
                ax.plot(*(1e3 * place(np.array(edge)).T), color=sheet.INK, lw=1.0)


def _half_of_cage(ax: Any, cage: Any, row: RowPlace) -> None:
    """A row's half of a cage; those of mirror images end at -x in the middle, and cages of which
    each row has one to the outside."""
    corners = np.array(cage.half_section if cage is not None else ())
    if len(corners):
        way = -1.0 if cage.rows == EACH else 1.0
        corners[:, 0] *= way * np.sign(row.place) if cage.mirrored else 1.0
        corners[:, 0] += row.place
        ax.fill(*(1e3 * corners.T), facecolor=_CAGE, edgecolor=sheet.INK, lw=1.0, alpha=0.85)


def _line(ax: Any, bearing: Any, place: float, lean: float) -> None:
    """The line of contact, from the axis to the outside of the element."""
    reach = 0.6 * bearing.element_diameter
    ends = np.array([0.5 * bearing.pitch_diameter + reach * cos(lean), 0.0])
    x = place - np.tan(lean) * (ends - 0.5 * bearing.pitch_diameter)
    ax.plot(1e3 * x, 1e3 * ends, color=sheet.VERMILION, lw=1.1, ls="--")
