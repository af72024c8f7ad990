"""What the elastic shape of a cage says of the model: warnings of rotations that are not small, and
of cages that rotation spreads into a ring."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees

from flexcage.core.warning import RunWarning
from flexcage.geometry.cage import Cage, RingLimit

MOST_OFF = 0.1  # of the largest displacement
#: Largest error of displacements that are linear in the modes, over the rotation [rad] of the
#: cage's sectors, without and with geometric stiffening: of crown cages that cone as they turn,
#: against geometrically nonlinear solutions (tests/verification/crown_coning.py).
PER_ROTATION, STIFFENED = 1.0, 0.62


@dataclass(frozen=True)
class ElasticShape:
    """How far a cage was deformed at most."""

    rotation: float = 0.0  # rad, of a sector
    inward: float = 0.0  # m, of its bore, towards the axis
    outward: float = 0.0  # m, of its outside
    stiffened: bool = False  # is the stress of rotation in the stiffness?


def large_rotation(shape: ElasticShape) -> Iterator[RunWarning]:
    """Rotations for which displacements linear in the modes are off by more than ``MOST_OFF``."""
    error = (STIFFENED if shape.stiffened else PER_ROTATION) * shape.rotation
    if error <= MOST_OFF:
        return
    left = 100.0 * STIFFENED * shape.rotation
    lower = f"; modes.geometric_stiffening = true leaves about {left:.0f} %"
    yield RunWarning(
        "large_rotation",
        f"Parts of the cage turn elastically by up to {degrees(shape.rotation):.2g} deg: its "
        f"displacements, which are linear in the modes, are off by about {100.0 * error:.0f} % "
        f"there{'' if shape.stiffened else lower}.",
    )


def grown_into_ring(
    shape: ElasticShape, cage: Cage, limits: tuple[RingLimit | None, RingLimit | None], guided: str
) -> Iterator[RunWarning]:
    """Elastic displacements that alone take the cage into a ring, which does not ``guided`` it."""
    ways = (("inner", shape.inward, cage.bore), ("outer", shape.outward, cage.outside_diameter))
    for (side, moved, own), limit in zip(ways, limits):
        if limit is None or side == guided:
            continue
        gap = 0.5 * (own - limit.diameter if side == "inner" else limit.diameter - own)
        if 0.0 < gap < moved:
            yield RunWarning(
                "grown_into_ring",
                f"The cage deforms by {1e3 * moved:.3g} mm towards {limit.name}, but the gap there "
                f"is {1e3 * gap:.3g} mm, and no contact between them is computed: it would rub.",
            )
