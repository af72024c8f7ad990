"""Defects of riveted ribbon cages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.round_pocket.defects import BallCageDefect, find_repeated
from flexcage.core.spec import option
from flexcage.geometry.defect import CageLine, Finding, Mark, Reading, defect_type

if TYPE_CHECKING:
    from flexcage.mesh.cage_mesh import CageMesh


@dataclass(frozen=True, kw_only=True)
class MissingRivet(BallCageDefect):
    """A rivet of a ribbon cage that broke or came off: its halves are free of each other there."""

    part: ClassVar[str] = "web"

    type: str = defect_type("missing_rivet")
    web: int = option(doc="web number, 0 .. Z-1; web k is between pockets k-1 and k", minimum=0)

    def extent(self, cage: Any) -> float:
        return float(cage.rivet_diameter)

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.ribbon.rivet import without_rivet
        from flexcage.cages.ribbon.sector import stand_off

        return without_rivet(mesh, self.web, stand_off(cage))

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        """Diameter of the circle in which the halves no more hold together."""
        from flexcage.mesh.halves import joined_vertices
        from flexcage.mesh.measure import in_pocket_frame

        joined = mesh.points[joined_vertices(mesh, self.web)]
        at = in_pocket_frame(joined, self.place, mesh.pocket_count)
        held = 2.0 * np.hypot(at[:, 1] - pitch_radius, at[:, 2]).max(initial=0.0)
        head = 2.0 * cage.head_radius
        return [Reading(self.type, head, [head - float(held)])]

    @property
    def legend(self) -> Sequence[Mark]:
        return (Mark("line", "crack", "place of the missing rivet"),)

    def lines(self, points: np.ndarray, count: int) -> list[CageLine]:
        """A ring round each of its heads."""
        psi = 2.0 * pi * self.place / count
        radial, around = (np.array([0.0, np.cos(a), np.sin(a)]) for a in (psi, psi + 0.5 * pi))
        r = np.hypot(points[:, 1], points[:, 2])
        middle, size = 0.5 * (r.max() + r.min()), 0.45 * (r.max() - r.min())
        near = np.linalg.norm(points[:, 1:] - middle * radial[1:], axis=1) < 0.5 * size
        high = float(np.abs(points[near, 0]).max())
        angle = np.linspace(0.0, 2.0 * pi, 73)[:, None]
        ring = size * (np.cos(angle) * radial + np.sin(angle) * around)
        centres = [np.array([x, 0.0, 0.0]) + middle * radial for x in (high, -high)]
        return [CageLine(centre + ring, centre) for centre in centres]

    @property
    def label(self) -> str:
        return f"web {self.web} without its rivet"

    def in_words(self, count: int) -> str:
        return (
            f"the rivet of web {self.web}, between pockets {(self.web - 1) % count} and "
            f"{self.web}, is missing"
        )

    @classmethod
    def check_together(cls, own: Sequence[MissingRivet], count: int) -> Iterator[Finding]:
        yield from find_repeated([rivet.web for rivet in own], "missing rivets")
        if len(own) == count:
            yield (
                "defects",
                f"All {count} rivets are missing; leave the halves one at least.",
                len(own),
            )
