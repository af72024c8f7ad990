"""A four-point contact bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from typing import Any, NamedTuple

from flexcage.bearings.ball.model import BallModel, SpottedBalls, ball_work, build_ball_model
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.bodies.floating_frame import BodyData
from flexcage.contacts.ball_ball import BallBallContact
from flexcage.contacts.ball_pocket import BallPockets
from flexcage.contacts.groove import Groove
from flexcage.contacts.land import LandData
from flexcage.system.data import Bodies, RingBody, Work
from flexcage.system.layout import Layout

# what a ball may touch beside races and pocket, in this order: arc k of the list is rib 1 + k
RIBS = ("next ball", "inner arc -x", "inner arc +x", "outer arc +x", "outer arc -x")


class Arcs(NamedTuple):
    """How many arcs each race has."""

    inner: int
    outer: int


class FourPointModel(NamedTuple):
    """Everything constant that the residual reads: a ball bearing's, whose grooves are the arcs
    that bear an inner ring pushed towards +x, and the other arcs, used where a race has two."""

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
    arcs: Arcs

    def balls(self, *, other: bool = False) -> BallModel:
        """A ball bearing's model with these arcs, or the ``other`` ones, as its grooves."""
        own: dict[str, Any] = {name: getattr(self, name) for name in BallModel._fields}
        if other:
            own |= {"inner": self.inner_other, "outer": self.outer_other}
        return BallModel(**own)


def build_four_point_model(
    bearing: FourPointContactBearing, cage: Any, body: Any, interface: Any, **specs: Any
) -> FourPointModel:
    """Arrays of a bearing for the kernels; arguments as those of ``build_ball_model``."""
    balls = build_ball_model(bearing, cage, body, interface, **specs)
    inner, outer = bearing.arcs("inner"), bearing.arcs("outer")
    own = balls._asdict() | {
        name: getattr(balls, ring)._replace(axial=float(places[k]))
        for ring, places in (("inner", inner), ("outer", outer))
        for name, k in ((ring, 0), (f"{ring}_other", -1))
    }
    return FourPointModel(**own, arcs=Arcs(len(inner), len(outer)))


def four_point_work(model: FourPointModel, layout: Layout) -> Work:
    """Fresh workspaces for one thread."""
    return ball_work(model.balls(), layout, ribs=len(RIBS))
