"""Bodies between which heat flows, and their temperatures in a steady state.

Every body has one temperature. What flows from one to another is their conductance times the
difference, so that temperatures solve one linear system, sum_b G_ab (T_a - T_b) = loss_a, with the
temperatures of the surroundings given. What flows out is then what is lost inside, to rounding.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from flexcage.core.errors import InputError

INNER, OUTER, ELEMENTS, CAGE, OIL, SHAFT, HOUSING = NODES = (
    "inner", "outer", "elements", "cage", "oil", "shaft", "housing",
)  # fmt: skip
AMBIENT, INLET = "ambient", "inlet"
#: What people call them.
TITLES: Mapping[str, str] = {
    INNER: "inner ring", OUTER: "outer ring", ELEMENTS: "elements", CAGE: "cage", OIL: "oil",
    SHAFT: "shaft", HOUSING: "housing", AMBIENT: "ambient", INLET: "oil that flows",
}  # fmt: skip
_HALVES = {INNER: 0.5, ELEMENTS: 0.5}, {OUTER: 0.5, ELEMENTS: 0.5}
#: Bodies that a loss at a place heats, and their shares: both surfaces alike (assumption).
SHARES: Mapping[str, Mapping[str, float]] = {
    "inner race": _HALVES[0],
    "outer race": _HALVES[1],
    "inner ribs": _HALVES[0],
    "outer ribs": _HALVES[1],
    "ribs": {ELEMENTS: 0.5, INNER: 0.25, OUTER: 0.25},
    "pockets": {ELEMENTS: 0.5, CAGE: 0.5},
    "neighbours": {ELEMENTS: 1.0},
    "lands": {CAGE: 0.5, INNER: 0.25, OUTER: 0.25},
    "inner lands": {CAGE: 0.5, INNER: 0.5},
    "outer lands": {CAGE: 0.5, OUTER: 0.5},
    "cage modes": {CAGE: 1.0},
    "drag": {OIL: 1.0},
    "churning": {OIL: 1.0},
    "seals": {INNER: 1.0},
    "mount": {HOUSING: 1.0},
    "shaft heat": {SHAFT: 1.0},
    "housing heat": {HOUSING: 1.0},
}


@dataclass(frozen=True)
class Network:
    """Conductances [W/K] by pairs of names, and the temperatures [K] that are given by name."""

    conductances: Mapping[tuple[str, str], float]
    given: Mapping[str, float]

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies whose temperature is sought, in the order of ``NODES``, others
        after."""
        named = dict.fromkeys(name for pair in self.conductances for name in pair)
        own = [name for name in named if name not in self.given]
        return tuple(sorted(own, key=lambda name: (*NODES, *own).index(name)))

    def temperatures(self, losses: Mapping[str, float]) -> dict[str, float]:
        """Temperatures [K] of all bodies under losses [W] by body. Raises InputError for a body
        from which no heat gets out."""
        self._check_ways_out()
        names = self.bodies
        matrix, right = np.zeros((len(names), len(names))), np.zeros(len(names))
        for (a, b), conductance in self.conductances.items():
            for one, other in ((a, b), (b, a)):
                if one in self.given:
                    continue
                k = names.index(one)
                matrix[k, k] += conductance
                if other in self.given:
                    right[k] += conductance * self.given[other]
                else:
                    matrix[k, names.index(other)] -= conductance
        for name, loss in losses.items():
            right[names.index(name)] += loss
        found = np.linalg.solve(matrix, right)
        return {name: float(value) for name, value in zip(names, found)}

    def out(self, temperatures: Mapping[str, float]) -> dict[tuple[str, str], float]:
        """Heat [W] that flows from bodies to the surroundings at these temperatures, by pair."""
        return {
            (body, around): conductance * (temperatures[body] - self.given[around])
            for pair, conductance in self.conductances.items()
            for body, around in (pair, pair[::-1])
            if around in self.given
        }

    def _check_ways_out(self) -> None:
        reached, more = set(self.given), True
        while more:
            new = {
                name
                for pair, conductance in self.conductances.items()
                if conductance > 0.0 and reached & set(pair)
                for name in pair
            }
            more, reached = not new <= reached, reached | new
        closed = [name for name in self.bodies if name not in reached]
        if closed:
            names = ", ".join(TITLES.get(name, name) for name in closed)
            raise InputError(
                f"No heat gets out of {names}: all conductances of [heat] on the way to the "
                "surroundings are 0; give one of them, such as heat.housing_ambient or an "
                "oil_flow.",
                where="heat",
            )


def by_body(places: Mapping[str, float]) -> dict[str, float]:
    """Losses [W] by body of losses by place."""
    found: dict[str, float] = {}
    for place, loss in places.items():
        for body, share in SHARES[place].items():
            found[body] = found.get(body, 0.0) + share * loss
    return found
