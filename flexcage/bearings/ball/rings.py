"""Sections of grooved rings, for rings that bend.

Both shoulders of a ring are as high as the loaded one, also of bearings that are open on one side:
an assumption, as makers do not publish the other one. Chamfers and seals are left out.
"""

from __future__ import annotations

from math import acos, asin, cos, sin

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.geometry.ring import Raceway, RingSection

_POINTS = 29  # of a groove's arc


def ball_rings(
    b: BallBearing,
    *,
    angle: tuple[float, float],
    across: tuple[float, float],
    seat: tuple[float, float],
) -> tuple[RingSection, RingSection]:
    """Sections of inner and outer ring of a bearing; balls press where the angles say."""
    centres = b.inner_groove_centre, b.outer_groove_centre
    radii = b.inner_groove_radius, b.outer_groove_radius
    inner, outer = (
        grooved_section(
            centres[k], radii[k], 2.0 * k - 1.0, shoulder=0.5 * b.shoulder_diameters[k],
            half=0.5 * b.width, seat=0.5 * seat[k], angle=angle[k], across=across[k],
        )
        for k in range(2)
    )  # fmt: skip
    return inner, outer


def grooved_section(
    centre: tuple[float, float],
    radius: float,
    side: float,
    *,
    shoulder: float,
    half: float,
    seat: float,
    angle: float,
    across: float,
) -> RingSection:
    """A groove, shoulders beside it, ends and seat; ``side`` is 1 for the outer ring, -1 for the
    inner one."""
    x, r = centre
    height = min(side * (r - shoulder) + radius, radius)
    edge = acos(1.0 - height / radius)
    ends = [asin(min((half + s * x) / radius, 1.0)) for s in (1.0, -1.0)]
    turns = np.linspace(-min(edge, ends[0]), min(edge, ends[1]), _POINTS)
    groove = [(x + radius * sin(a), r + side * radius * cos(a)) for a in turns]
    outline, names = list(groove), ["race"] * (_POINTS - 1)
    if groove[-1][0] < half:
        outline.append((half, groove[-1][1]))
        names.append("")
    outline += [(half, seat), (-half, seat)]
    names += ["", "seat", ""]
    if groove[0][0] > -half:
        outline.append((-half, groove[0][1]))
        names.append("")
    normal = side * sin(angle), side * cos(angle)
    place = x + radius * normal[0], r + radius * normal[1]
    return RingSection(
        outline=tuple(outline),
        names=tuple(names),
        raceway=Raceway(place=place, normal=normal, extent=across, line=False),
        wall=side * (seat - r) - radius,
    )
