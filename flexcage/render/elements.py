"""What pictures and charts read of a run, by the kind of its bearing's rolling elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class ElementNames:
    """Names of the variables of one kind of elements, and of the faces of their pockets."""

    one: str  # the element, which is also its dimension
    position: str  # (time, element, cyl)
    force: str  # (time, element, race)
    tilt: str  # (time, element, tilt); "" where elements have no axis
    faces: tuple[tuple[str, tuple[str, ...]], ...]  # what is shown as one: its name, its faces

    @property
    def many(self) -> str:
        return f"{self.one}s"

    def loads(self, ds: xarray.Dataset) -> np.ndarray:
        """Normal forces of inner and outer race, (time, element, 2) [N]."""
        return ds[self.force].transpose(..., self.one, "race").sel(race=["inner", "outer"]).values


_NAMES = {
    "roller": ElementNames(
        "roller", "roller_position", metrics.RACE_NAMES["roller"].force, "roller_tilt",
        (
            ("front face", ("front",)),
            ("rear face", ("rear",)),
            ("side beams", ("side+x", "side-x")),
        ),
    ),
    "ball": ElementNames(
        "ball", "ball_position", metrics.RACE_NAMES["ball"].force, "",
        (("pocket wall", ("pocket",)),),
    ),
}  # fmt: skip


def elements_in(ds: xarray.Dataset) -> ElementNames:
    """Names in the dataset of a run."""
    return _NAMES[metrics.element(ds)]
