"""How many steps a run will take, foreseen: one that would take days is refused, not waited for."""

from __future__ import annotations

import logging
import time as clocks

from flexcage.core.errors import RunFailed
from flexcage.core.progress import clock
from flexcage.core.units import describe

log = logging.getLogger(__name__)

#: Steps after which it is looked ahead, and how often in a row more must be seen than are allowed:
#: a start or a hard impact takes short steps for a while.
EVERY, IN_A_ROW = 20_000, 5
#: s that a run may take without a word.
LONG = 300.0
_SHOWS, _SHARE = 10.0, 0.01  # s and share of a run that show its pace
_LATEST = 20.0  # s after which any share does
_REMEDY = (
    "look for a mass, a load, a speed or a stiffness far from those of bearings, shorten "
    "solver.duration, or raise solver.max_steps"
)


class Foresight:
    """Looks ahead from the steps of a run of ``duration`` [s] that may take ``most``."""

    def __init__(self, most: int, duration: float) -> None:
        self.most, self.duration = most, duration
        self._seen = 0
        self._window = 0, 0.0  # steps and time at the last look at steps
        self._begun: tuple[float, float] | None = None  # clock and time at the first look
        self._paced = False

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

    def look(self, steps: int, time: float) -> None:
        """After any number of steps, in all, up to ``time`` [s]."""
        before, since = self._window
        if time < since:  # a block is done again
            self._window = before, since = steps, time
        if steps - before >= EVERY:
            self._window = steps, time
            self.after(steps, time, (time - since) / (steps - before))
        self.pace(time)

    def spent(self, time: float) -> tuple[float, float]:
        """Seconds that it took, and bearing time [s], from the first look to ``time``."""
        if self._begun is None:
            return 0.0, 0.0
        return clocks.perf_counter() - self._begun[0], time - self._begun[1]

    def pace(self, time: float) -> None:
        """Say once how long the whole will take, if that is long. The first call begins, after some
        steps: kernels were loaded before."""
        if self._begun is None:
            self._begun = clocks.perf_counter(), time
            return
        spent, done = self.spent(time)
        shown = spent >= _SHOWS and done >= _SHARE * self.duration
        if self._paced or not (shown or spent >= _LATEST) or done <= 0.0:
            return
        left = spent / done * (self.duration - time)
        if left > LONG:
            self._paced = True
            enough = float(f"{time + done * LONG / spent:.2g}")
            log.info("at the pace of its %.0f s so far the run takes about %s more; "
                     "solver.duration = %s would take %s more",
                     spent, clock(left), describe(enough, "ms"), clock(LONG))  # fmt: skip

    def _sentence(self, ahead: float, time: float, why: str) -> str:
        many = f"{ahead:,.0f}" if ahead < 1e7 else f"{ahead:.1e}"
        return (
            f"the run would take about {many} steps, more than solver.max_steps "
            f"({self.most:,}): at t = {1e3 * time:.4g} ms of "
            f"{describe(self.duration, 'ms')} {why}; {_REMEDY}"
        )
