"""Size and number of the rollers of a row inside a catalogue's double row roller bearing, whose
rollers are about as long as thick: those of a row by the share of the ratings that it has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.inference import candidates as of_one_row
from flexcage.bearings.double_row_roller.bearing import DoubleRowRollerBearing
from flexcage.bearings.two_rows import ROWS
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline

_SMALLEST, _LARGEST = 0.2, 0.3  # a roller over the rings' height (D - d)
_STEP = 0.5e-3  # m, of standard rollers
_BETWEEN = 0.3  # of the rib between the rows, over the roller's diameter


def candidates(outline: Outline) -> list[Candidate]:
    """Rollers of every standard diameter that has room under the outer race."""
    outer = outline.required("outer_race_diameter", "the race diameter E (--outer-race)")
    return [
        _pair(outline, one)
        for diameter in _diameters(outline)
        for one in of_one_row(_row_of(outline, outer - 2.0 * diameter))
    ]


def _diameters(outline: Outline) -> Iterator[float]:
    height = outline.outside_diameter - outline.bore
    for k in range(int(_SMALLEST * height / _STEP) + 1, int(_LARGEST * height / _STEP) + 1):
        yield round(k * _STEP, 6)


def _row_of(outline: Outline, inner: float) -> Outline:
    """The outline of a row, whose inner race has a diameter [m]."""
    power = DoubleRowRollerBearing.row_power
    return replace(
        outline, inner_race_diameter=round(inner, 6), width=outline.width / ROWS,
        static_rating=outline.static_rating / ROWS,
        dynamic_rating=outline.dynamic_rating / ROWS**power,
    )  # fmt: skip


def _pair(outline: Outline, one: Candidate) -> Candidate:
    row: Any = one.bearing
    own = {f.name: getattr(row, f.name) for f in fields(RollerBearing) if f.name != "type"}
    distance = round(row.rib_gap + _BETWEEN * row.roller_diameter, 5)
    bearing = DoubleRowRollerBearing(**{**own, "width": outline.width}, row_distance=distance)
    mean = 0.5 * (outline.bore + outline.outside_diameter)
    off = (row.pitch_diameter / mean - 1.0) / 0.01
    slender = (row.roller_length / row.roller_diameter - 1.0) / 0.1
    return Candidate(
        outline=outline, bearing=bearing, unlikely=one.unlikely + off**2 + slender**2,
        reasons={
            **one.reasons,
            "inner_race_diameter": "from E and the roller: E - 2 Dw",
            "roller_diameter": "inferred from C0: a standard roller about as long as thick, whose "
            "pitch circle is the mean of bore and outside diameter",
            "row_distance": f"assumption: the rib between the rows is {_BETWEEN:g} times the "
            "roller's diameter wide",
        },
    )  # fmt: skip


INFERENCE = Inference(
    candidates=candidates, cages={name_of(DoubleRowRollerBearing): "window"}, count="roller_count"
)
