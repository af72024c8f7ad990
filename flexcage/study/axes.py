"""Axes of a study: each is a list of points, and a study takes every combination of its axes.

A point maps paths of the case to their new values: texts with units, as in a case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, MISSING, dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.core.errors import InputError, shown
from flexcage.core.spec import option
from flexcage.core.units import describe, parse, split

Change = Callable[[str, Any], Any]  # of a path and a value: the value to put in its place

_DIGITS = 6  # significant digits of sampled values, so that tables and cases stay readable


@dataclass(frozen=True)
class Point:
    """Values by path, and labels by the column that shows them."""

    values: Mapping[str, Any]
    labels: Mapping[str, str] = field(default_factory=dict)

    def __or__(self, other: Point) -> Point:
        return Point({**self.values, **other.values}, {**self.labels, **other.labels})

    def __str__(self) -> str:
        words = [f"{k} = {v}" for k, v in {**self.labels, **self.values}.items()]
        return ", ".join(words) or "the base case"


_KINDS: dict[str, type] = {}
#: Specs of axes by the name that a study gives.
AXES = MappingProxyType(_KINDS)


def _axis_type(name: Any = MISSING) -> Any:
    """The field ``type`` of an axis."""
    return option(name, doc="kind of axis", choices=AXES)


@dataclass(frozen=True, kw_only=True)
class Axis:
    """An axis of a study; ``type`` picks one of the kinds below."""

    type: str = _axis_type()

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of the case that vary."""
        raise NotImplementedError

    def mapped(self, change: Change) -> Axis:
        """The axis with its values changed."""
        raise NotImplementedError

    def expand(self) -> list[Point]:
        """Its points."""
        raise NotImplementedError


@dataclass(frozen=True)
class Grid(Axis):
    """One path and its values."""

    path: str
    values: tuple[Any, ...]
    _: KW_ONLY
    type: str = _axis_type("grid")

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", _some(self.values, f"'{self.path}'"))

    @property
    def paths(self) -> tuple[str, ...]:
        return (self.path,)

    def mapped(self, change: Change) -> Grid:
        return replace(self, values=tuple(change(self.path, v) for v in self.values))

    def expand(self) -> list[Point]:
        return [Point({self.path: value}) for value in self.values]


@dataclass(frozen=True)
class Zip(Axis):
    """Several paths whose values go together: the first of each, the second of each, ..."""

    values: Mapping[str, tuple[Any, ...]]
    _: KW_ONLY
    type: str = _axis_type("zip")

    def __post_init__(self) -> None:
        _some(self.values, "of type 'zip'")
        lists = {path: _some(values, f"'{path}'") for path, values in self.values.items()}
        object.__setattr__(self, "values", lists)
        if len(set(map(len, lists.values()))) > 1:
            text = ", ".join(f"{len(values)} for '{path}'" for path, values in lists.items())
            raise InputError(
                f"A zip axis has {text}; give equally many values for each.", where="axes"
            )

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(self.values)

    def mapped(self, change: Change) -> Zip:
        return Zip({p: tuple(change(p, v) for v in values) for p, values in self.values.items()})

    def expand(self) -> list[Point]:
        return [Point(dict(zip(self.values, row))) for row in zip(*self.values.values())]


@dataclass(frozen=True)
class Points(Axis):
    """Points written out; what a point leaves out is as in the base case.

    A point's ``label`` is no path: tables show it in a column called ``name``.
    """

    points: tuple[Mapping[str, Any], ...]
    name: str = "label"
    _: KW_ONLY
    type: str = _axis_type("list")

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _some(self.points, "of type 'list'"))

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(p for point in self.points for p in point if p != "label"))

    def mapped(self, change: Change) -> Points:
        changed = [
            {path: value if path == "label" else change(path, value) for path, value in p.items()}
            for p in self.points
        ]
        return replace(self, points=tuple(changed))

    def expand(self) -> list[Point]:
        return [
            Point(
                {path: value for path, value in point.items() if path != "label"},
                {self.name: str(point["label"])} if "label" in point else {},
            )
            for point in self.points
        ]


@dataclass(frozen=True)
class _Sampled(Axis):
    """``count`` points in the box of ``ranges`` (path to lowest and highest value)."""

    ranges: Mapping[str, tuple[Any, Any]]
    count: int = option(minimum=1)
    seed: int = option(0, minimum=0)

    def __post_init__(self) -> None:
        _some(self.ranges, f"of type '{self.type}'")
        for path, ends in self.ranges.items():
            ends_in_si(path, ends)

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(self.ranges)

    def mapped(self, change: Change) -> _Sampled:
        ranges = {p: (change(p, low), change(p, high)) for p, (low, high) in self.ranges.items()}
        return replace(self, ranges=ranges)

    def expand(self) -> list[Point]:
        scales = [ends_in_si(path, ends) for path, ends in self.ranges.items()]
        columns = [
            [written(low + share * (high - low), unit) for share in column]
            for column, (low, high, unit) in zip(self._unit_cube(len(scales)).T, scales)
        ]
        return [Point(dict(zip(self.ranges, row))) for row in zip(*columns)]

    def _unit_cube(self, dimensions: int) -> np.ndarray:
        """Points (count, dimensions) in the unit cube."""
        raise NotImplementedError


@dataclass(frozen=True)
class LatinHypercube(_Sampled):
    """Latin hypercube: every range is cut into ``count`` parts, each hit once."""

    _: KW_ONLY
    type: str = _axis_type("lhs")

    def _unit_cube(self, dimensions: int) -> np.ndarray:
        from scipy.stats import qmc

        rng = np.random.default_rng(self.seed)
        return qmc.LatinHypercube(dimensions, seed=rng).random(self.count)


@dataclass(frozen=True)
class Sobol(_Sampled):
    """Scrambled Sobol sequence; ``count`` is a power of two, for which it is balanced."""

    _: KW_ONLY
    type: str = _axis_type("sobol")

    def _unit_cube(self, dimensions: int) -> np.ndarray:
        from scipy.stats import qmc

        power = self.count.bit_length() - 1
        if self.count != 1 << power:
            raise InputError(
                f"A sobol axis has count {self.count}, but a Sobol sequence is balanced for powers "
                f"of two; take {1 << power} or {2 << power}.",
                where="axes",
                value=self.count,
            )
        rng = np.random.default_rng(self.seed)
        return qmc.Sobol(dimensions, seed=rng).random_base2(power)


_KINDS.update(grid=Grid, zip=Zip, list=Points, lhs=LatinHypercube, sobol=Sobol)


def _some(values: Any, what: str) -> Any:
    """The values as a tuple (a table as it is), which must hold something."""
    if isinstance(values, str) or not hasattr(values, "__len__"):
        raise InputError(f"The axis {what} is {shown(values)}, but should be a list.", where="axes")
    if not len(values):
        raise InputError(f"The axis {what} is empty; give it values.", where="axes")
    return values if isinstance(values, Mapping) else tuple(values)


def ends_in_si(path: str, ends: Any) -> tuple[float, float, str]:
    """Lowest and highest value in SI, and the unit of the lowest ("" for plain numbers)."""
    what = f"the range of '{path}'"
    if len(_some(ends, f"'{path}'")) != 2:
        raise InputError(f"{what} is {shown(ends)}, but should be two values, lowest and highest.")
    low, high = ends
    parts = split(low) if isinstance(low, str) else None
    unit = parts[1] if parts else ""
    if unit:
        low, high = (parse(value, unit, where=what) for value in ends)
    elif not all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in ends):
        raise InputError(
            f"{what} is {shown(ends)}, but should be two numbers with units.", where=path
        )
    if not low < high:
        raise InputError(f"{what} goes from {ends[0]} to {ends[1]}; give the lower first.")
    return low, high, unit


def written(value: float, unit: str) -> Any:
    """A sampled value as a case would write it, short enough for a table."""
    return describe(value, unit) if unit else float(f"{value:.{_DIGITS}g}")
