"""What a study leaves open: unknowns with ranges and reasons, and designs that sample them.

A design is a table of shares, one row a point and one column an unknown; the last column is a dummy
that changes nothing. Every run of a design starts with another push of its cage, so that what the
dummy seems to do is the noise of starts, under which nothing can be told.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import exp, inf, log
from numbers import Real
from typing import Any

import numpy as np
from scipy.stats import qmc

from flexcage.core.digits import percent_text
from flexcage.core.errors import InputError, package_lacks
from flexcage.core.spec import option
from flexcage.study.axes import ends_in_si, written

DUMMY = "(start)"
LEVELS = 4  # of Morris' design, in every unknown
SCALES = ("linear", "log")
_ABOUT = ("label", "weight")  # keys of a choice that are no paths
DESIGNS = ("sample", "morris", "saltelli")


@dataclass(frozen=True, kw_only=True)
class Unknown:
    """One thing that is not known, and why its range is plausible.

    Either ``paths``, each with a factor, which all take a value of ``range`` (uniform along
    ``scale``) times their factor; or ``choices``, tables of paths and values with a ``label``, of
    equal weight unless they have a ``weight``.
    """

    name: str = option(doc="what it is, in words")
    reason: str = option(doc="why its range is plausible")
    paths: Mapping[str, float] = field(default_factory=dict)
    range: tuple[Any, ...] = ()
    scale: str = option("linear", doc="along which it is uniform", choices=SCALES)
    choices: tuple[Mapping[str, Any], ...] = ()

    def __post_init__(self) -> None:
        if bool(self.choices) == bool(self.paths) or bool(self.paths) != bool(self.range):
            raise InputError(
                f"The unknown '{self.name}' should have either paths and a range, or choices.",
                where="unknowns",
                value=self.name,
            )
        if not self.reason.strip():
            raise InputError(
                f"The unknown '{self.name}' has no reason; say why its range is plausible.",
                where="unknowns",
                value=self.name,
            )
        if any("label" not in choice for choice in self.choices):
            raise InputError(
                f"A choice of the unknown '{self.name}' has no label; give each one.",
                where="unknowns",
                value=self.name,
            )
        if not all(isinstance(w, Real) and 0.0 < w < inf for w in self.weights):
            raise InputError(
                f"The weights of the unknown '{self.name}' are {list(self.weights)}, but should be "
                "numbers above zero.",
                where="unknowns",
                value=self.name,
            )
        if self.range:
            low, _, unit = self._ends()
            if self.scale == "log" and not low > 0.0:
                raise InputError(
                    f"The unknown '{self.name}' begins at {self.range[0]}, but a range along "
                    "logarithms begins above zero.",
                    where="unknowns",
                    value=self.range[0],
                )

    @property
    def weights(self) -> tuple[float, ...]:
        """Weights of the choices."""
        return tuple(choice.get("weight", 1) for choice in self.choices)

    def in_words(self) -> str:
        """Its range, or its choices; with the share of the weight where weights differ."""
        if not self.choices:
            low, high = self.range
            return f"{low} to {high}" + (" (log)" if self.scale == "log" else "")
        uneven, whole = len(set(self.weights)) > 1, sum(self.weights)
        return ", ".join(
            f"{choice['label']} ({percent_text(weight / whole)})"
            if uneven
            else str(choice["label"])
            for choice, weight in zip(self.choices, self.weights)
        )

    def _ends(self) -> tuple[float, float, str]:
        return ends_in_si(self.name, self.range)

    def changes(self, share: float) -> tuple[Any, dict[str, Any]]:
        """What it is at a share 0 ... 1 of its range, in words or a number; and the values of the
        paths that it changes."""
        if self.choices:
            ends = np.cumsum(self.weights) / sum(self.weights)
            place = min(int(np.searchsorted(ends, share, side="right")), len(self.choices) - 1)
            choice = dict(self.choices[place])
            choice.pop("weight", None)
            return choice.pop("label"), choice
        low, high, unit = self._ends()
        if self.scale == "log":
            value = low * exp(share * log(high / low))
        else:
            value = low + share * (high - low)
        return written(value, unit), {p: written(value * f, unit) for p, f in self.paths.items()}

    @property
    def all_paths(self) -> tuple[str, ...]:
        """Paths that it may change."""
        chosen = (path for choice in self.choices for path in choice if path not in _ABOUT)
        return tuple(dict.fromkeys((*self.paths, *chosen)))


def check_unknowns(unknowns: Sequence[Unknown]) -> None:
    """Raise InputError if there are none, or two of a name, or two that change the same path."""
    if not unknowns:
        raise InputError("The map has no unknowns; name one or more.", where="unknowns")
    names = [u.name for u in unknowns]
    if len({*names, DUMMY}) <= len(names):
        twice = next((n for n in names if names.count(n) > 1), DUMMY)
        raise InputError(
            f"Two unknowns are called '{twice}', or the dummy's name is taken; rename one.",
            where="unknowns",
            value=twice,
        )
    owners: dict[str, str] = {}
    for unknown in unknowns:
        for path in unknown.all_paths:
            if path in owners:
                raise InputError(
                    f"The unknowns '{owners[path]}' and '{unknown.name}' both change '{path}'; "
                    "let one of them do it.",
                    where="unknowns",
                    value=path,
                )
            owners[path] = unknown.name


def require_salib() -> None:
    """Raise EnvironmentLacks, which says what to install, unless SALib is there."""
    if importlib.util.find_spec("SALib") is None:
        raise package_lacks("Sensitivity indices are computed", "SALib", extra="sensitivity")


def problem(columns: int) -> dict[str, Any]:
    """So many inputs from 0 to 1, as SALib wants them."""
    return {"num_vars": columns, "names": [f"u{k}" for k in range(columns)],
            "bounds": [[0.0, 1.0]] * columns}  # fmt: skip


def design_of(kind: str, count: int, columns: int, seed: int) -> np.ndarray:
    """Shares (rows, columns) of a design, the dummy's column included.

    "sample": ``count`` points, a power of two, of a scrambled Sobol sequence: a larger count begins
    with the same points. "morris": ``count`` trajectories, columns + 1 points each. "saltelli":
    columns + 2 points for each of ``count``, a power of two. The last two want SALib
    (EnvironmentLacks).
    """
    if kind not in DESIGNS:
        raise InputError(
            f"The design is '{kind}', but should be one of {', '.join(DESIGNS)}.",
            where="design", value=kind,
        )  # fmt: skip
    power = count.bit_length() - 1
    if kind != "morris" and count != 1 << power:
        raise InputError(
            f"The design '{kind}' has count {count}, but is balanced for powers of two; take "
            f"{1 << power} or {2 << power}.",
            where="count",
            value=count,
        )
    if kind == "sample":
        rng = np.random.default_rng(seed)
        return qmc.Sobol(columns, seed=rng).random_base2(power)
    require_salib()
    if kind == "morris":
        from SALib.sample import morris

        return np.asarray(morris.sample(problem(columns), count, num_levels=LEVELS, seed=seed))
    from SALib.sample import sobol

    return np.asarray(sobol.sample(problem(columns), count, calc_second_order=False, seed=seed))
