"""A spot of a ball: a pit or a flat, its dimensions and where it stands at the start."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from flexcage.core.spec import GIVEN, option, quantity
from flexcage.geometry.spot import spotted_in_words

_IS = {"size": GIVEN}


@dataclass(frozen=True, kw_only=True)
class BallSpot:
    """A pit or a flat on one ball or more; none while its size is zero.

    A pit has sharp edges and one depth. A flat is as deep as its chord; on both, a ball sinks into
    a race as a race's spall lets it. A spot is as wide as long, its sides along and across the
    groove. It is met while the path of the ball's contact crosses it; pockets do not feel it.
    """

    size: float = quantity("mm", 0.0, doc="length and width; 0: no spot", minimum=0.0)
    kind: str = option("pit", doc="what it is", choices=("pit", "flat"), when=_IS)
    ball: int = option(0, doc="ball that has it", minimum=0, when=_IS)
    others: tuple[int, ...] = option((), doc="further balls with a spot alike", minimum=0, when=_IS)
    depth: float = quantity(
        "um", 100e-6, doc="depth of a pit", above=0.0, when={**_IS, "kind": ("pit",)}
    )
    angle: float = quantity(
        "deg", 0.0, doc="where it is at the start: from outwards towards the sense of the orbit",
        when=_IS,
    )  # fmt: skip
    tilt: float = quantity("deg", 0.0, doc="likewise, from that plane towards +x", when=_IS)

    @property
    def balls(self) -> tuple[int, ...]:
        """Numbers of the balls that have one."""
        return tuple(sorted({self.ball, *self.others})) if self.size else ()

    def dimensions(self, radius: float, effective: float, felt: float) -> np.ndarray:
        """Half of its size, its depth, the drop over the square of a length [m], on a race with
        which a ball of a radius has the ``effective`` one [m], and half of the width ``felt`` [m]
        over which its edges are felt."""
        half = 0.5 * self.size
        depth = half**2 / (2.0 * radius) if self.kind == "flat" else self.depth
        return np.array([half, depth, 1.0 / (2.0 * effective), felt])

    def direction(self) -> np.ndarray:
        """Unit direction (x, r, psi) at the start."""
        across = cos(self.tilt)
        return np.array([sin(self.tilt), across * cos(self.angle), across * sin(self.angle)])

    def in_words(self) -> str:
        """A sentence on it; empty if there is none."""
        return spotted_in_words("Ball", self.balls, self)
