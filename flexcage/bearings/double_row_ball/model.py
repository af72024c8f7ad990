"""A double row ball bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from flexcage.bearings.ball.model import (
    BallModel,
    SpottedBalls,
    ball_work,
    build_ball_model,
    groove_of,
)
from flexcage.bodies.floating_frame import BodyData
from flexcage.contacts.ball_ball import BallBallContact
from flexcage.contacts.ball_pocket import BallPockets
from flexcage.contacts.groove import Groove
from flexcage.contacts.land import LandData
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.contacts.uneven import is_uneven
from flexcage.geometry.bearing import RowPlace
from flexcage.system.data import Bodies, RingBody, Work
from flexcage.system.layout import Layout

_APART = 1.02  # balls' diameters between rows that never meet: they move along the axis by less


class BallRows(NamedTuple):
    """How many balls a row has; those of the second row follow the first one's. And may balls of
    one row touch those of the other?"""

    each: int
    meet: int


class DoubleRowModel(NamedTuple):
    """Everything constant that the residual reads: a ball bearing's, whose grooves are those of the
    row at -x, and the grooves of the other row."""

    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: Groove
    outer: Groove
    pocket: BallPockets
    neighbours: BallBallContact
    spot: SpottedBalls
    land: LandData
    inner_other: Groove
    outer_other: Groove
    rows: BallRows

    def balls(self) -> BallModel:
        """A ball bearing's model whose grooves stand where those of every ball are, (2Z,)."""
        own: dict[str, Any] = {name: getattr(self, name) for name in BallModel._fields}
        for ring in ("inner", "outer"):
            own[ring] = own[ring]._replace(axial=self.axial(ring))
        return BallModel(**own)

    def axial(self, ring: str) -> np.ndarray:
        """Axial places (2Z,) [m] of the centres of the grooves of every ball in a ring."""
        both = (getattr(self, ring).axial, getattr(self, f"{ring}_other").axial)
        return np.repeat(both, self.rows.each)


def build_double_row_model(
    bearing: Any, cage: Any, body: Any, interface: Any, *, contacts: Contacts,
    lubricant: Lubricant, **specs: Any,
) -> DoubleRowModel:  # fmt: skip
    """Arrays of a bearing for the kernels; arguments as those of ``build_ball_model``."""
    balls = build_ball_model(
        bearing, cage, body, interface, contacts=contacts, lubricant=lubricant, **specs
    )
    grooves = {
        f"{ring}{name}": _in_row(
            groove_of(bearing.row, contacts, lubricant, inner=ring == "inner"), place,
            late=bearing.late if ring == "inner" else 0.0,
            spalled=getattr(bearing, f"{ring}_spall").row == row,
        )
        for ring in ("inner", "outer")
        for row, (name, place) in enumerate(zip(("", "_other"), bearing.row_places))
    }  # fmt: skip
    own = balls._asdict() | grooves
    return DoubleRowModel(**own, rows=BallRows(bearing.element_count, int(_meet(bearing))))


def _in_row(groove: Groove, place: RowPlace, *, late: float, spalled: bool) -> Groove:
    """The groove of a row's own bearing where the row stands; ``late`` [m]: how much further the
    ring goes before the row bears; is the ring's spall one of the row?"""
    spall = groove.spall if spalled else np.zeros_like(groove.spall)
    return groove._replace(
        axial=place.place + place.sense * (groove.axial - late), spall=spall,
        sides=np.sort(place.sense * groove.sides), uneven=is_uneven(groove.wave, spall),
    )  # fmt: skip


def _meet(bearing: Any) -> bool:
    """May balls of one row touch those of the other, which stand between them?"""
    first, second = (row.place for row in bearing.row_places)
    return bool(abs(second - first) < _APART * bearing.ball_diameter)


def double_row_work(model: DoubleRowModel, layout: Layout) -> Work:
    """Fresh workspaces for one thread."""
    return ball_work(model.balls(), layout)
