"""What a bearing family supplies to the record of a run: one value, a ``Recording``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic

import numpy as np

from flexcage.system.layout import Layout
from flexcage.system.motion import M
from flexcage.system.problem import BearingSystem


@dataclass(frozen=True, kw_only=True)
class Recording(Generic[M]):
    """What runs of one family hold besides that which all do (``recorded``).

    ``coords(model)``: labels of the dimensions that only they have, and places that go with them,
    as ``RunStore.create`` takes both. ``variables(bearing, y)``: the elements' main-grid variables
    of one block by name, from states (n, size) and the samples kept.

    ``overlaps(model, layout, y)``: depths (n, Z, places) [m] of elements in what they touch, in
    the order of ``Motion.places`` but for the lands, negative when apart, in states (n, size): by
    them a run that goes wrong is found. A further place says how far outside the cage's wall an
    element is, and ``remedy(model)`` what would hold a cage that comes off. Bodies are as they
    were made, without waves and deflection.

    ``spots(model)``: numbers of the elements that have a spot, whose directions (n, spots, 3) are
    then among the variables, as "spot_direction". ``touch``: may elements touch the next ones with
    a cage between them, so that "neighbour_force" is always among the variables?
    """

    coords: Callable[[M], dict[str, Any]]
    variables: Callable[[BearingSystem, np.ndarray], dict[str, np.ndarray]]
    overlaps: Callable[[M, Layout, np.ndarray], np.ndarray]
    remedy: Callable[[M], str] = lambda model: "a land (cage.guidance) would hold it"
    spots: Callable[[M], np.ndarray] = lambda model: np.zeros(0, np.int64)
    touch: bool = False
