"""What families of double row bearings have in common: each row is a single-row bearing.

i rows have i times the static rating of one by ISO 76, and i^0.7 (balls) or i^(7/9) (rollers) times
its dynamic rating by ISO 281.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from math import pi, sin, sqrt
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.halves import is_one_piece
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm
from flexcage.geometry.bearing import Bearing, RowPlace
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import Finding, check_cage_defects, raise_first
from flexcage.geometry.spall import Spall, find_row

if TYPE_CHECKING:
    from flexcage.contacts.spec import Contacts
    from flexcage.system.statics.elements import Elements
    from flexcage.system.statics.options import StaticOptions
    from flexcage.system.statics.rows import Rows

ROWS = 2
_PRESSED = 0.01  # of an element's diameter: presses it hard
ARRANGEMENTS = ("back_to_back", "face_to_face")


@dataclass(frozen=True, kw_only=True)
class RowFields:
    """Keys of where rows stand, and what a spec says of its rows, for the functions below."""

    row_count: ClassVar[int] = ROWS
    # power of i, the number of rows, in ISO 281's rating, and Weibull's e
    row_power: ClassVar[float]
    weibull: ClassVar[float]
    carries: ClassVar[tuple[bool, ...]]
    pressure_limit: ClassVar[float]  # at which ISO 76 sets the static rating [Pa]

    if TYPE_CHECKING:

        @property
        def row(self) -> Any:
            """The bearing of one row alone, which bears axial load, if any, towards +x."""

        @property
        def row_places(self) -> tuple[RowPlace, RowPlace]: ...
        @property
        def late(self) -> float:
            """Axial displacement [m] in a row's sense before it bears, from the middle."""

    @property
    def one_row(self) -> Any:
        return self.row

    row_distance: float = quantity("mm", doc="axial distance of the two rows' middles", above=0.0)
    staggered: bool = option(
        True, doc="are the rows half an element's pitch apart around the axis?"
    )

    def _places(
        self, count: int, *, sense: float, distance: float | None = None
    ) -> tuple[RowPlace, RowPlace]:
        """Rows at -x and +x; ``sense`` of the first, of which the second is the mirror image."""
        half = 0.5 * (self.row_distance if distance is None else distance)
        turned = pi / count if self.staggered else 0.0
        return RowPlace(-half, sense, 0.0), RowPlace(half, -sense, turned)


def single(bearing: Bearing, kind: type[Bearing], **changes: Any) -> Any:
    """The single-row bearing ``kind`` with the values that a bearing has of its keys, or with
    ``changes``."""
    names = [f.name for f in fields(kind) if f.name != "type" and hasattr(bearing, f.name)]
    own = {name: getattr(bearing, name) for name in names}
    spalls = {name: replace(s, row=0) for name, s in own.items() if isinstance(s, Spall)}
    return kind(**{**own, **spalls, **changes})


def rows_of(bearing: Any, *, speed: float, contacts: Contacts, options: StaticOptions) -> Rows:
    """Elements of both rows; a row has its share of the dynamic rating."""
    from flexcage.bearings.family import statics_of

    row = bearing.row
    rating = (options.dynamic_rating or bearing.dynamic_rating) / ROWS**bearing.row_power
    own = replace(options, dynamic_rating=rating)
    return rows_from(bearing, statics_of(row)(row, speed=speed, contacts=contacts, options=own))


def rows_from(bearing: Any, elements: Elements) -> Rows:
    """Both rows of a bearing, from the elements of one."""
    from flexcage.system.statics.rows import Row, Rows

    rows = tuple(
        Row(elements, p.place, sense=p.sense, late=bearing.late, turned=p.turned)
        for p in bearing.row_places
    )
    return Rows(
        rows, exponent=bearing.weibull, pressure_limit=bearing.pressure_limit,
        scale=_PRESSED * bearing.element_diameter, carries=bearing.carries,
    )  # fmt: skip


def static_rating(bearing: Any) -> float:
    """C0 of both rows, by that of one."""
    return ROWS * float(bearing.row.static_rating)


def dynamic_rating(bearing: Any) -> float:
    """C of both rows, by that of one."""
    return float(ROWS**bearing.row_power * bearing.row.dynamic_rating)


def check(bearing: Any, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in a row, in where both are, or in the cage."""
    bearing.row.check(cage)
    check_rows(bearing)
    check_cage(bearing, cage, defects)


def check_cage(bearing: Bearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in one cage for both rows."""
    if cage is not None:
        raise_first(_find_in_cage(bearing, cage))
        check_cage_defects(bearing, cage, defects)


def check_rows(bearing: Any) -> None:
    """Raise InputError where rows meet, or reach out of the bearing."""
    raise_first(_find_in_rows(bearing))
    for ring in ("inner", "outer"):
        if hasattr(bearing, f"{ring}_spall"):
            raise_first(find_row(bearing, ring))


def _find_in_rows(b: Any) -> Iterator[Finding]:
    chord = b.pitch_diameter * sin(0.5 * pi / b.element_count) if b.staggered else 0.0
    least = sqrt(max(b.element_diameter**2 - chord**2, 0.0))
    if b.element != "ball" or not b.staggered:
        least = b.element_length
    if b.row_distance < least:
        yield (
            "bearing.row_distance",
            f"bearing.row_distance is {mm(b.row_distance)}, so the {b.element}s of both rows "
            f"overlap; give {mm(least)} or more.",
        )
    if b.row_distance + b.element_length > b.width:
        yield (
            "bearing.row_distance",
            f"bearing.row_distance is {mm(b.row_distance)}, so {b.element}s reach out of a bearing "
            f"{mm(b.width)} wide; give {mm(max(b.width - b.element_length, 0.0))} or less.",
        )


def _find_in_cage(b: Any, cage: Cage) -> Iterator[Finding]:
    """``cage`` is that of one row: a common one is both, held together."""
    if b.element == "ball" and cage.guidance != "ball":
        yield (
            "cage.guidance",
            f"cage.guidance is '{cage.guidance}', but a cage for two rows of balls is guided by "
            'these; give "ball".',
        )
    one = is_one_piece(cage, b.row_places)
    if not one and cage.axial_width - cage.axial_reach > 0.5 * b.row_distance:
        yield (
            "cage.width",
            f"cage.width is {mm(cage.width)}, so the halves of a cage for both rows overlap, which "
            f"are {mm(b.row_distance)} apart (bearing.row_distance); give a narrower cage.",
        )


def row_labels(count: int) -> dict[str, Any]:
    """Coordinate of a run's elements, ``count`` a row: the row of each, 0 at -x."""
    rows = np.repeat(np.arange(ROWS), count)
    return {"row": (("element",), rows, {"long_name": "row of the element; 0 at -x"})}
