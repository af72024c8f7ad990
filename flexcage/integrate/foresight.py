"""How many steps a run will take, foreseen: one that would take days is refused, not waited for."""

from __future__ import annotations

from flexcage.core.errors import RunFailed
from flexcage.core.units import describe

#: Steps after which it is looked ahead, and how often in a row more must be seen than are allowed:
#: a start or a hard impact takes short steps for a while.
EVERY, IN_A_ROW = 20_000, 5
_REMEDY = (
    "look for a mass, a load, a speed or a stiffness far from those of bearings, shorten "
    "solver.duration, or raise solver.max_steps"
)


class Foresight:
    """Looks ahead from the steps of a run of ``duration`` [s] that may take ``most``."""

    def __init__(self, most: int, duration: float) -> None:
        self.most, self.duration = most, duration
        self._seen = 0

    def explicit(self, steps: int, time: float, step: float) -> None:
        """Before steps of at most ``step`` [s], from ``time`` [s] on; RunFailed for too many."""
        ahead = steps + (self.duration - time) / step
        if ahead > self.most:
            longest = f"explicit steps are stable up to {1e9 * step:.3g} ns"
            raise RunFailed(self._sentence(ahead, time, longest))

    def after(self, steps: int, time: float, mean: float) -> None:
        """After steps of ``mean`` [s]; RunFailed where too many are seen again and again."""
        ahead = steps + (self.duration - time) / max(mean, 1e-300)
        self._seen = self._seen + 1 if ahead > self.most else 0
        if self._seen >= IN_A_ROW:
            last = f"its last {EVERY:,} steps took {1e9 * mean:.3g} ns each"
            raise RunFailed(self._sentence(ahead, time, last))

    def _sentence(self, ahead: float, time: float, why: str) -> str:
        many = f"{ahead:,.0f}" if ahead < 1e7 else f"{ahead:.1e}"
        return (
            f"the run would take about {many} steps, more than solver.max_steps "
            f"({self.most:,}): at t = {1e3 * time:.4g} ms of "
            f"{describe(self.duration, 'ms')} {why}; {_REMEDY}"
        )
