"""A user's own defect of window cages: the wall of a side beam dented into its pocket."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage import register
from flexcage.core.units import mm
from flexcage.geometry.defect import Finding, defect_type, signed_mm
from flexcage.mesh.measure import in_pocket_frame
from flexcage.register import option, quantity
from flexcage.spec import WindowCage, WindowDefect


@dataclass(frozen=True, kw_only=True)
class Dent(WindowDefect):
    """The wall of the side beam at +x, bulged into the pocket; the cage's end stays plane."""

    type: str = defect_type("dent")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    depth: float = quantity("mm", doc="by how much the pocket is shorter in its middle", above=0.0)

    def displace(self, points: np.ndarray, cage: WindowCage, *, pocket_count: int) -> np.ndarray:
        x, radial, tangential = in_pocket_frame(points, self.pocket, pocket_count).T
        across = np.clip(1.0 - (2.0 * tangential / cage.pocket_width) ** 2, 0.0, 1.0) ** 2
        along = np.clip((0.5 * cage.width - x) / cage.side_beam_width, 0.0, 1.0)
        share = np.where((x > 0.0) & (radial > 0.0), across * along, 0.0)
        return np.multiply.outer(-self.depth * share, np.array([1.0, 0.0, 0.0]))

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, "side+x"): -self.depth}

    @property
    def label(self) -> str:
        return f"pocket {self.pocket} dented, {signed_mm(-self.depth)}"

    def in_words(self, count: int) -> str:
        return f"pocket {self.pocket} has a dent of {mm(self.depth)}"

    def check(self, where: str, cage: Any, count: int) -> Iterator[Finding]:
        yield from super().check(where, cage, count)
        if self.depth > 0.5 * cage.side_beam_width:
            yield (
                f"{where}.depth",
                f"{where}.depth is {mm(self.depth)}, more than half of the side beam's width, "
                f"{mm(0.5 * cage.side_beam_width)}.",
                self.depth,
            )


register.cage_defect(Dent, cages=("window",))
