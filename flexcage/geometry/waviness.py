"""Keys of a race's waves: amplitude, waves per turn, azimuth of a crest on its ring."""

from __future__ import annotations

from typing import Any

from flexcage.core.spec import GIVEN, option, quantity


def waviness(ring: str) -> Any:
    """The field ``{ring}_waviness``."""
    return quantity("um", 0.0, doc=f"amplitude of {ring} race waviness", minimum=0.0)


def waviness_order(ring: str) -> Any:
    """The field ``{ring}_waviness_order``."""
    return option(
        2, doc=f"waves per turn, {ring} race", minimum=1, when={f"{ring}_waviness": GIVEN}
    )


def waviness_azimuth(ring: str) -> Any:
    """The field ``{ring}_waviness_azimuth``."""
    return quantity(
        "deg", 0.0, doc=f"azimuth of a crest on the {ring} ring",
        when={f"{ring}_waviness": GIVEN},
    )  # fmt: skip
