"""Contact ellipses and the edges of their grooves, over a run: how near, or how far over."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.hertz import over_edge
from flexcage.results.figures.figure import Found

if TYPE_CHECKING:
    import xarray

_RACES = ("inner", "outer")


@dataclass(frozen=True, kw_only=True)
class Edge:
    """Where a run's ellipses come nearest to a groove's edge, or furthest over it."""

    race: str
    beyond: float  # rad, > 0: over the edge
    kind: str  # of element: "ball"
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
            f"{self.kind} {self.element}",
            self.race,
            self.beyond,
            force=self.force,
            angle=self.angle,
            when=f" at t = {self.time * 1e3:.4g} ms",
        )

    @property
    def key(self) -> str:
        """Its figure."""
        return f"edge_{self.race}"

    @property
    def found(self) -> Found:
        """Its angle, and where and when."""
        where = "over the edge: " if self.beyond > 0.0 else "within the groove by that much: "
        angle = round(degrees(self.angle), 3) + 0.0  # no dust about zero
        where += (
            f"{self.kind} {self.element}, {self.force:.4g} N at {angle:.4g} deg, "
            f"t = {self.time * 1e3:.3f} ms"
        )
        return Found(self.beyond, where)


def groove_edges(bearing: Bearing, ds: xarray.Dataset) -> list[Edge]:
    """The worst ellipse at each groove whose edge is known; none where bearings have no grooves."""
    known = np.isfinite(bearing.groove_edges)
    if not known.any():
        return []
    force, angle = (
        ds[name].transpose("time", "element", "race").values
        for name in ("race_force", "contact_angle")
    )
    beyond = np.where(force > 0.0, bearing.beyond_edges(force, angle), -np.inf)
    found = []
    for k, race in enumerate(_RACES):
        if not (known[k] and force[..., k].max() > 0.0):
            continue
        time, one = np.unravel_index(int(beyond[..., k].argmax()), beyond.shape[:2])
        found.append(
            Edge(
                race=race,
                beyond=float(beyond[time, one, k]),
                kind=bearing.element,
                element=int(ds["element"][one]),
                time=float(ds["time"][time]),
                force=float(force[time, one, k]),
                angle=float(angle[time, one, k]),
            )
        )
    return found
