"""Crossbeams of window cages that are broken in two."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.window.defects import WindowDefect, find_repeated
from flexcage.cages.window.windowed import WindowedCage
from flexcage.core.spec import option
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import CageLine, Finding, Mark, Reading, defect_type
from flexcage.mesh.measure import in_pocket_frame

if TYPE_CHECKING:
    from flexcage.mesh.cage_mesh import CageMesh


@dataclass(frozen=True, kw_only=True)
class BrokenCrossbeam(WindowDefect):
    """Crossbeam k (between pockets k-1 and k) broken in two in the middle of its length.

    Its ends stay in place and exert no force on each other. A roller at the break presses on both.
    A rigid cage has no break.
    """

    part: ClassVar[str] = "crossbeam"

    type: str = defect_type("broken_crossbeam")
    crossbeam: int = option(doc="crossbeam number, 0 .. Z-1", minimum=0)

    def extent(self, cage: Cage) -> float:
        assert isinstance(cage, WindowedCage)
        return cage.wall

    def displace(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        return np.zeros_like(points)

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: WindowedCage) -> CageMesh:
        from flexcage.cages.window.morph import break_crossbeam

        return break_crossbeam(sound, mesh, self.crossbeam, cage)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> Sequence[Reading]:
        """Height of the cut: that of the wall."""
        from flexcage.cages.window.morph import cut_height

        return [Reading(self.type, self.extent(cage), [cut_height(mesh, self.crossbeam, cage)])]

    @property
    def legend(self) -> Sequence[Mark]:
        return (Mark("line", "crack", "break through the crossbeam"),)

    def lines(self, points: np.ndarray, count: int) -> list[CageLine]:
        """Across the crossbeam, on the outside: there its ends have vertices of one place."""
        placed, times = np.unique(points, axis=0, return_counts=True)
        x, radial, tangential = in_pocket_frame(placed[times > 1], self.place, count).T
        turn, r = np.arctan2(tangential, radial), np.hypot(radial, tangential)
        near = np.abs(turn) < pi / count
        outside = near & (r > (1.0 - 1e-6) * r[near].max(initial=0.0))
        if not outside.any():
            return []
        a = 2.0 * pi * self.place / count + np.linspace(turn[near].min(), turn[near].max(), 9)
        middle, high = x[outside].mean(), r[outside].mean()
        line = np.stack([middle + 0.0 * a, high * np.cos(a), high * np.sin(a)], axis=1)
        return [CageLine(line, line[4])]

    @property
    def label(self) -> str:
        return f"crossbeam {self.crossbeam} broken"

    def in_words(self, count: int) -> str:
        before, after = self.pockets(count)
        return f"crossbeam {self.crossbeam}, between pockets {before} and {after}, is broken in two"

    @classmethod
    def check_together(cls, own: Sequence[BrokenCrossbeam], count: int) -> Iterator[Finding]:
        yield from find_repeated(f"Crossbeam {d.crossbeam} is broken" for d in own)
        if len(own) == count:
            yield (
                "defects",
                f"All {count} crossbeams are broken; leave one at least, or the cage falls apart.",
                len(own),
            )
