"""A case of the chapter, its rows, and what came of it: frozen values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import isfinite


@dataclass(frozen=True)
class Tolerance:
    """Largest difference that passes, and why: relative, or ``absolute`` in the row's unit."""

    size: float
    why: str
    absolute: bool = False

    def __str__(self) -> str:
        return f"{self.size:.2g}" if self.absolute else f"{100.0 * self.size:.2g} %"


@dataclass(frozen=True)
class Row:
    """One quantity: what the source says, and what flexcage computes, both in ``unit``."""

    quantity: str
    unit: str
    reference: float
    value: float
    tolerance: Tolerance

    @property
    def difference(self) -> float:
        """Value less reference, over the reference's size unless the tolerance is absolute."""
        difference = float(self.value - self.reference)
        if self.tolerance.absolute:
            return difference
        return difference / abs(self.reference) if self.reference else float("nan")

    @property
    def passed(self) -> bool:
        return isfinite(self.difference) and bool(abs(self.difference) <= self.tolerance.size)

    @property
    def difference_text(self) -> str:
        d = self.difference
        return f"{d:+.2g}" if self.tolerance.absolute else f"{100.0 * d:+.2g} %"


@dataclass(frozen=True, kw_only=True)
class KnownAnswer:
    """One case: what is checked, against which source, and the function that computes its rows.

    ``quick`` cases do without the compiled bearing, whose kernels take a while the first time.
    """

    name: str
    title: str
    source: str
    checks: str
    rows: Callable[[], Iterable[Row]]
    quick: bool = True


@dataclass(frozen=True)
class Outcome:
    """A case that was run: its rows, or the sentence of the error that stopped it."""

    case: KnownAnswer
    rows: tuple[Row, ...]
    seconds: float
    error: str = ""

    @property
    def failures(self) -> tuple[Row, ...]:
        return tuple(row for row in self.rows if not row.passed)

    @property
    def passed(self) -> bool:
        return bool(self.rows) and not self.error and not self.failures
