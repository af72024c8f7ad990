"""What the pictures of a cage have in common, so that those of several runs lie side by side."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from flexcage.core.binding import check_spec
from flexcage.core.spec import option, quantity


@dataclass(frozen=True, kw_only=True)
class Look:
    """From where a cage is seen, over which range it is coloured, and how far it is deformed.

    What is None is chosen: the view is the same for all runs, pocket 0 in front, but in the mesh's
    picture, which turns to the first defect; colours and deformation follow what a picture shows.
    """

    view: float | None = quantity(
        "deg", None, doc="azimuth turned to the viewer", minimum=-2.0 * pi, maximum=2.0 * pi
    )
    stress_limit: float | None = quantity(
        "MPa", None, doc="stress at the end of the colours", above=0.0, maximum=1e12
    )
    scale: float | None = option(
        None, doc="factor of the deformation that is drawn", minimum=0.0, maximum=1e9
    )

    def __post_init__(self) -> None:
        check_spec(self)

    @property
    def azimuth(self) -> float:
        """Place on the cage that is nearest to the viewer [rad]."""
        return 0.0 if self.view is None else self.view
