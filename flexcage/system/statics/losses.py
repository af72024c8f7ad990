"""Losses of a bearing in its static solution: elements that rub on both races as a run's would.

The static solution gives forces, places and contact angles. How fast every element orbits and
turns follows from its own steady balance under the friction law and the rolling resistance of the
case, with the drag of the oil: nothing is left over that would speed it up. So what the inner
ring's drive puts in is what places lose, to rounding. An element that bears nothing on the inner
race rolls on the outer one at the others' speed, pushed by the cage.

Left out, as there is no cage in a static solution: pockets and lands. Rings' tilts and
displacements are left out of the speeds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, Protocol

import numpy as np
from scipy.optimize import root

from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant
from flexcage.core.errors import RunFailed
from flexcage.system.statics.state import StaticState

_SMOOTHED = (0.0, *(10.0 ** (-0.5 * k) for k in range(13)), 0.0)  # m/s, see ``settled_speeds``
_LEFT = 1e-9  # of the friction that there could be: unbalanced forces that count as none
RACES = ("inner race", "outer race")
Ratio = Callable[..., np.ndarray]


@dataclass(frozen=True)
class Losses:
    """Losses of a bearing at one speed.

    ``places`` [W] by place, as ``geometry.heat.network.SHARES`` names them; ``sliding`` and
    ``rolling`` (2,) [W] are the parts of both races; ``torque`` [N m] is the drive's; ``orbit``
    and ``spin`` [rad/s] are the elements' mean speeds about the bearing's and their own axis.
    """

    places: Mapping[str, float]
    sliding: np.ndarray
    rolling: np.ndarray
    torque: float
    orbit: float
    spin: float

    @property
    def total(self) -> float:
        """All losses [W]."""
        return float(sum(self.places.values()))


class LossesOf(Protocol):
    """What a bearing family supplies: the losses of a bearing's static solution."""

    def __call__(
        self, bearing: Any, solution: StaticState, *, contacts: Contacts, lubricant: Lubricant
    ) -> Losses: ...


def friction_over_speed(law: FrictionLaw) -> Ratio:
    """mu/u [s/m] of a friction law, a function of sliding speeds u [m/s] and of one by which it is
    smoothed: the law's at sqrt(u^2 + smooth^2)."""
    from flexcage.contacts import laws  # its kernels take seconds to load

    function, parameters = laws.FRICTION_LAWS[law.law], laws.friction_parameters(law)

    def ratio(u: np.ndarray, smooth: float = 0.0) -> np.ndarray:
        speeds = np.hypot(np.ascontiguousarray(u, float), smooth)
        found, slope = np.empty_like(speeds), np.empty_like(speeds)
        function(speeds.size, speeds, parameters, found, slope)
        return found

    return ratio


def settled_speeds(
    unbalance: Callable[[np.ndarray, float], np.ndarray], first: np.ndarray, size: float
) -> np.ndarray:
    """Speeds (k,) at which ``unbalance`` (k,), forces over the friction that there could be, is
    zero; sought from ``first``, by steps of the order of ``size``. Its second argument smooths the
    friction law: where a steep one lets the search astray, it is made steeper step by step.
    Raises RunFailed if no speeds are found."""
    speeds, left = first, inf
    for k, smooth in enumerate(_SMOOTHED):
        found = root(lambda x, at, by: unbalance(at + size * x, by), np.zeros_like(first),
                     args=(speeds, smooth), options={"xtol": 1e-13})  # fmt: skip
        left = float(np.abs(unbalance(speeds + size * found.x, 0.0)).max())
        if left < _LEFT:
            settled: np.ndarray = speeds + size * found.x
            return settled
        if k > 0 and found.success:
            speeds = speeds + size * found.x
    raise RunFailed(
        "no steady speeds of a rolling element were found: "
        f"{left:.1e} of its load stays unbalanced; is the friction of contacts.race too small to "
        "turn it against its rolling resistance and drag?"
    )


def together(each: Sequence[Losses], loaded: Sequence[int]) -> Losses:
    """Those of rows of elements of one bearing, with so many ``loaded`` elements each."""
    places: dict[str, float] = {}
    for own in each:
        for place, loss in own.places.items():
            places[place] = places.get(place, 0.0) + loss
    orbit, spin = (
        float(np.average([getattr(own, name) for own in each], weights=loaded))
        for name in ("orbit", "spin")
    )
    sliding, rolling = (sum(getattr(o, name) for o in each) for name in ("sliding", "rolling"))
    return Losses(places, sliding, rolling, sum(own.torque for own in each), orbit, spin)


def summed(
    places: dict[str, float], sliding: np.ndarray, rolling: np.ndarray, *, drive: float,
    speeds: np.ndarray,
) -> Losses:  # fmt: skip
    """Losses of powers on both races (2,) and of further ``places``, under a torque ``drive``;
    ``speeds`` (k, 2) of loaded elements about both axes."""
    races = dict(zip(RACES, map(float, sliding + rolling)))
    orbit, spin = (float(v) for v in np.mean(speeds, axis=0))
    return Losses({**races, **places}, sliding, rolling, drive, orbit, spin)
