"""A user's own type of ball bearing in motion, whose elements are there already."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.geometry.bearing import type_name
from flexcage.register import bearing_type


@bearing_type
@dataclass(frozen=True, kw_only=True)
class MagnetoBearing(DeepGrooveBallBearing):
    """A separable ball bearing: its outer ring has a shoulder on one side alone."""

    kind: ClassVar[str] = "magneto bearing"
    one_sided: ClassVar[bool] = True
    type: str = type_name("magneto")
