"""Contact ellipses and the edges of their grooves, over a run: how near, or how far over."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch
from math import degrees, isfinite
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.ball_bearing import BallBearing, over_edge
from flexcage.geometry.bearing import Bearing
from flexcage.results.summary import Row, figure

if TYPE_CHECKING:
    import xarray

_RACES = ("inner", "outer")


@dataclass(frozen=True)
class Edge:
    """Where a run's ellipses come nearest to a groove's edge, or furthest over it."""

    race: str
    beyond: float  # rad, > 0: over the edge
    element: int
    time: float  # s
    force: float  # N
    angle: float  # rad, the contact angle there

    @property
    def warning(self) -> str:
        """One sentence if the ellipse runs over the edge, otherwise nothing."""
        if not self.beyond > 0.0:
            return ""
        return over_edge(
            f"ball {self.element}", self.race, self.beyond, force=self.force, angle=self.angle,
            when=f" at t = {self.time * 1e3:.4g} ms",
        )  # fmt: skip

    @property
    def row(self) -> Row:
        where = "over the edge: " if self.beyond > 0.0 else "within the groove by that much: "
        where += (
            f"ball {self.element}, {self.force:.4g} N at {degrees(self.angle):.4g} deg, "
            f"t = {self.time * 1e3:.3f} ms"
        )
        return figure(f"edge_{self.race}", self.beyond, where)


@singledispatch
def groove_edges(bearing: Bearing, ds: xarray.Dataset) -> list[Edge]:
    """The worst ellipse at each groove whose edge is known; none where bearings have no grooves."""
    return []


@groove_edges.register(BallBearing)
def _(bearing: BallBearing, ds: xarray.Dataset) -> list[Edge]:
    radii = bearing.inner_groove_radius, bearing.outer_groove_radius
    found = []
    for k, race in enumerate(_RACES):
        edge = bearing.groove_edges[k]
        force, angle = (
            ds[name].isel(race=k).transpose("time", "element").values
            for name in ("race_force", "contact_angle")
        )
        if not (isfinite(edge) and force.max() > 0.0):
            continue
        half = bearing.contacts[k].semi_axes(force)[0] / radii[k]
        beyond = np.where(force > 0.0, np.abs(angle) + half - edge, -np.inf)
        at = np.unravel_index(int(beyond.argmax()), beyond.shape)
        time, element = float(ds["time"][at[0]]), int(ds["element"][at[1]])
        found.append(
            Edge(race, float(beyond[at]), element, time, float(force[at]), float(angle[at]))
        )
    return found
