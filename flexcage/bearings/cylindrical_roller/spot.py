"""A spot of a roller: a pit or a flat, its dimensions and where it stands at the start."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.core.spec import GIVEN, option, quantity
from flexcage.geometry.spall import covered
from flexcage.geometry.spot import spotted_in_words

_IS = {"size": GIVEN}


@dataclass(frozen=True, kw_only=True)
class RollerSpot:
    """A pit or a flat on one roller or more; none while its size is zero.

    A pit has sharp edges and one depth. A flat is as deep as its chord. On both, the roller sinks
    towards a race as a race's spall lets it, once a turn on each race; pockets do not feel it.
    """

    size: float = quantity("mm", 0.0, doc="length round the roller; 0: no spot", minimum=0.0)
    kind: str = option("pit", doc="what it is", choices=("pit", "flat"), when=_IS)
    roller: int = option(0, doc="roller that has it", minimum=0, when=_IS)
    others: tuple[int, ...] = option(
        (), doc="further rollers with a spot alike", minimum=0, when=_IS
    )
    depth: float = quantity(
        "um", 100e-6, doc="depth of a pit", above=0.0, when={**_IS, "kind": ("pit",)}
    )
    width: float | None = quantity(
        "mm", None, doc="axial width (default: all)", above=0.0, when=_IS
    )
    offset: float = quantity(
        "mm", 0.0, doc="axial distance of its middle from the roller's",
        when={**_IS, "width": GIVEN},
    )  # fmt: skip
    angle: float = quantity(
        "deg", 0.0, doc="where it is at the start: from outwards towards the sense of the orbit",
        when=_IS,
    )  # fmt: skip

    @property
    def rollers(self) -> tuple[int, ...]:
        """Numbers of the rollers that have one."""
        return tuple(sorted({self.roller, *self.others})) if self.size else ()

    def dimensions(self, radius: float, effective: float, felt: float) -> np.ndarray:
        """Half of its angle, 0, its depth, the drop over the square of an angle, and half of the
        angle over which its edges are felt, as ``contacts.uneven.spall_depth`` has them, of a
        roller of a radius [m] on a race with which it has the ``effective`` one [m]; ``felt`` [m]:
        half of that width."""
        half = 0.5 * self.size
        depth = half**2 / (2.0 * radius) if self.kind == "flat" else self.depth
        bend = radius**2 / (2.0 * effective)
        return np.array([half / radius, 0.0, depth, bend, felt / radius])

    def covered(self, centres: np.ndarray, slice_width: float) -> np.ndarray:
        """Share (n,) of slices that lie on it, by the places of their centres (n,) [m]."""
        return covered(centres, slice_width, self.width, self.offset)

    def in_words(self) -> str:
        """A sentence on it; empty if there is none."""
        return spotted_in_words("Roller", self.rollers, self)
