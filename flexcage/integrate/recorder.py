"""One bearing's part of a run that is being integrated: its buffers, its books and its store."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.integrate.balance import Balance
from flexcage.integrate.divergence import first_undefined, hardest, runaway
from flexcage.integrate.recorded import recorded, recorded_names
from flexcage.integrate.recording import Recording
from flexcage.integrate.registered import computed_in, registered
from flexcage.results.lowpass import butterworth, low_passed
from flexcage.results.options import OutputOptions
from flexcage.results.registry import COMPUTED
from flexcage.results.store import LOADS, MemoryRunStore
from flexcage.system.data import EVENT_CLOSED, EVENT_ELEMENT, EVENT_PLACE, EVENT_TIME, MASS
from flexcage.system.problem import BearingSystem

FILTER_HZ = 10e3  # low-pass of outer_acceleration_filtered
_REMEMBERED = (
    "closed",
    "land",
    "force",
    "pocket_force",
    "pocket_force_before",
)  # of Events by checkpoints


class Recorder:
    """Records a bearing whose unknowns are the ``span`` of y, and whose works are the ``works`` of
    the integrals; ``mark`` stands before the names of its parts of a checkpoint."""

    def __init__(
        self, bearing: BearingSystem, recording: Recording[Any], store: MemoryRunStore, *,
        output: OutputOptions, span: slice, works: slice, mark: str = "",
    ) -> None:  # fmt: skip
        self.bearing, self.recording, self.store, self.output = bearing, recording, store, output
        self.span, self.works, self.mark = span, works, mark
        held = {v.name for v in store.layout.variables}
        own = (name for name in recorded_names(bearing, recording) if name not in COMPUTED)
        lacking = [name for name in own if name not in held]
        if lacking:
            raise of_another(f"it holds no '{lacking[0]}'", lacking[0])
        self._computed = computed_in(store)
        self.balance = Balance(store)
        self._filter = np.zeros((2, 2, 2))
        begun = store.blocks > 0  # by an earlier flexcage, if it has no loads
        self._keeps_loads = bearing.layout.modes > 0 and not (begun and not store.loads(0))

    def begin_block(self, time: float) -> None:
        """Empty the buffers of what happens between samples, from ``time`` [s] on."""
        events, between = self.bearing.data.events, self.bearing.data.between
        events.fill[0] = 0
        events.pocket_force_peak[...] = 0.0  # as in a run that is resumed here
        between.fill[:] = 0
        between.clock[:] = -np.inf, time + 1.0 / self.output.rate

    def runaway(self, ys: np.ndarray) -> tuple[int, str, str] | None:
        """The first of the main samples ``ys`` in which a contact is too deep, and why."""
        return runaway(self.bearing, self.recording, ys[:, self.span])

    def arrays(self, ys: np.ndarray, yds: np.ndarray, quads: np.ndarray) -> dict[str, np.ndarray]:
        """What is stored of main samples, by name."""
        found = recorded(self.bearing, self.recording, ys[:, self.span], yds[:, self.span])
        found["work"] = quads[:, self.works]
        return found

    def keep(
        self, index: int, arrays: dict[str, np.ndarray], yds: np.ndarray,
        checkpoint: Callable[[], dict[str, np.ndarray]] | None, steps: dict[str, np.ndarray],
    ) -> None:  # fmt: skip
        """Store a block: arrays of main samples, and by ``yds`` the fine ones. The ``checkpoint``
        is made once their filter has moved on; None: the block is not whole."""
        fine = self._fine(yds[:, self.span], len(yds))
        self.store.write_block(
            index,
            arrays | registered(self._computed, arrays, self.bearing, self.store),
            fine,
            checkpoint() if checkpoint else None,
            {"steps": steps, "events": self._events(), **self._loads()},
        )

    def look(self, t: float, y: np.ndarray, yd: np.ndarray, *, undefined: bool) -> str:
        """The contact whose force is no number as the motion goes on, or the hardest one."""
        find = first_undefined if undefined else hardest
        return find(self.bearing, t, y[self.span].copy(), yd[self.span].copy())

    def _fine(self, yd: np.ndarray, n: int) -> dict[str, np.ndarray]:
        """Outer ring's acceleration across its axis; of one that is held there, what its contact
        forces would give it."""
        ring = self.bearing.data.model.outer_ring
        raw = self.bearing.data.samples.force[:n] / ring.inertia[MASS]
        if ring.free[1:3].any():
            raw = np.ascontiguousarray(self.bearing.layout.u(yd)["outer"][:, 1:3])
        cut = min(FILTER_HZ / (0.5 * self.output.vibration_rate), 0.95)
        filtered = low_passed(butterworth(cut), raw, self._filter)
        return {"outer_acceleration": raw, "outer_acceleration_filtered": filtered}

    def _events(self) -> dict[str, np.ndarray]:
        rows = self.bearing.data.events.rows[: self.bearing.data.events.fill[0]]
        return {
            "time": rows[:, EVENT_TIME].copy(),
            "element": rows[:, EVENT_ELEMENT].astype(np.int16),
            "place": rows[:, EVENT_PLACE].astype(np.int8),
            "closed": rows[:, EVENT_CLOSED].astype(np.int8),
        }

    def _loads(self) -> dict[str, dict[str, np.ndarray]]:
        """The table of loads at steps; none of a cage that has no stress."""
        b = self.bearing.data.between
        if not self._keeps_loads:
            return {}
        n, rows = b.fill
        return {
            LOADS: {
                "time": b.time[:n].copy(),
                "modes": b.modes[:n].copy(),
                "land": b.land[:n].copy(),
                "touched": b.touched[:n].astype(np.int16),
                "face": b.face[:rows].astype(np.int16),
                "force": b.force[:rows].copy(),
            }
        }

    def parts(self) -> dict[str, np.ndarray]:
        """Arrays of a checkpoint, by name, which are the recorder's own."""
        memory = {f"memory_{k}": v for k, v in self.bearing.data.memory._asdict().items()}
        events = self.bearing.data.events
        kept = {f"events_{k}": getattr(events, k) for k in _REMEMBERED}
        found = {**memory, **kept, "filter": self._filter}
        return {f"{self.mark}{name}": array for name, array in found.items()}


def of_another(how: str, name: str) -> InputError:
    """A store that another flexcage began."""
    return InputError(
        f"The run was begun by another flexcage: {how}; finish it with the flexcage that began "
        "it, or begin it again.",
        where=name,
    )
