"""Rows of elements between the same two rings: a bearing of several rows, from those of one.

A row has its place along the axis, and its sense: +1 as a bearing of its own, -1 turned round, so
that what a row bears towards +x it bears towards -x.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from flexcage.system.statics.elements import ElementLoads, Elements, Response


@dataclass(frozen=True)
class Row:
    """A row's elements, as of a bearing of their own, with its middle at ``place`` [m] on the axis;
    ``late`` [m]: axial displacement, in the row's ``sense``, before which it is as that bearing is
    at none; ``turned`` [rad]: azimuth of its first element."""

    elements: Elements
    place: float
    sense: float = 1.0
    late: float = 0.0
    turned: float = 0.0

    @cached_property
    def moves(self) -> np.ndarray:
        """How the rings' v (axial, radial, tilt) in the middle of the bearing are the row's own."""
        return np.array([[self.sense, 0.0, 0.0], [0.0, 1.0, self.place], [0.0, 0.0, self.sense]])

    @property
    def azimuth(self) -> np.ndarray:
        return self.elements.azimuth + self.turned

    def own(self, v: np.ndarray) -> np.ndarray:
        """Displacements (n, 3) that a bearing of this row alone would have at v (n, 3)."""
        return v @ self.moves.T - np.array([self.late, 0.0, 0.0])

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        found, moves = self.elements.respond(self.own(v), w, share), self.moves
        return replace(
            found, ring=found.ring @ moves, ring_v=moves.T @ found.ring_v @ moves,
            ring_w=moves.T @ found.ring_w, unbalance_v=found.unbalance_v @ moves,
        )  # fmt: skip

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        """Contact angles and axial forces count from +x of the bearing."""
        found = self.elements.loads(self.own(v), w)
        axial = None if found.axial is None else self.sense * found.axial
        return replace(found, azimuth=self.azimuth, angle=self.sense * found.angle, axial=axial)


@dataclass(frozen=True)
class Rows:
    """Elements of all rows, one row after the other; implements ``elements.Elements``.

    ``exponent``: Weibull's e of ISO 281 (10/9 of balls, 9/8 of rollers), by which the lives of rows
    make that of the bearing.
    """

    rows: tuple[Row, ...]
    exponent: float
    pressure_limit: float  # where ISO 76 sets the static rating [Pa]
    scale: float  # a displacement that presses elements hard [m]
    carries: tuple[bool, ...] = (True, True, True, True, True)

    @cached_property
    def azimuth(self) -> np.ndarray:
        return np.concatenate([row.azimuth for row in self.rows])

    @property
    def conservative(self) -> bool:
        return all(row.elements.conservative for row in self.rows)

    @cached_property
    def _spans(self) -> list[slice]:
        ends = np.cumsum([0, *(len(row.elements.azimuth) for row in self.rows)])
        return [slice(a, b) for a, b in zip(ends[:-1], ends[1:])]

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """As many as a row has; rows with fewer repeat their last."""
        each = [row.elements.guesses(row.own(v[own])) for row, own in zip(self.rows, self._spans)]
        most = max(map(len, each))
        return [np.concatenate([g[min(k, len(g) - 1)] for g in each]) for k in range(most)]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        return np.concatenate([
            row.elements.moved(w[own], step[own]) for row, own in zip(self.rows, self._spans)
        ])  # fmt: skip

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        each = [row.respond(v[own], w[own], share) for row, own in zip(self.rows, self._spans)]
        return Response(**{name: _joined(each, name) for name in Response.__dataclass_fields__})

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        each = [row.loads(v[own], w[own]) for row, own in zip(self.rows, self._spans)]
        return ElementLoads(**{name: _joined(each, name) for name in _lists(each[0])})

    def check(self, loads: ElementLoads) -> None:
        for row, own in zip(self.rows, self._spans):
            row.elements.check(loads_of_row(loads, own, row.sense))

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        """Of rows of which the first that fails ends the bearing's life."""
        lives = [
            row.elements.reference_life(row.own(v[own]), w[own])
            for row, own in zip(self.rows, self._spans)
        ]
        worn = sum(life**-self.exponent for life in lives if np.isfinite(life))
        return float(worn ** (-1.0 / self.exponent)) if worn else float(np.inf)


def _lists(loads: ElementLoads) -> list[str]:
    """Names of what these loads hold of every element."""
    names = ElementLoads.__dataclass_fields__
    return [name for name in names if isinstance(getattr(loads, name), np.ndarray)]


def _joined(each: Sequence[Response] | Sequence[ElementLoads], name: str) -> Any:
    return np.concatenate([getattr(one, name) for one in each])


def loads_of_row(loads: ElementLoads, own: slice, sense: float) -> ElementLoads:
    """Loads of a row's elements as its own bearing has them."""
    found: dict[str, Any] = {name: getattr(loads, name)[own] for name in _lists(loads)}
    return ElementLoads(**{**found, "angle": sense * found["angle"]})
