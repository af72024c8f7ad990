"""Integrate a bearing block by block and record what happens: samples by name, checkpoint, log."""

from __future__ import annotations

import logging
from collections.abc import Callable
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from flexcage.core.errors import InputError, RunFailed
from flexcage.core.progress import Silent
from flexcage.integrate.balance import AGAIN, NEITHER, TIGHTER, Balance, Weighed
from flexcage.integrate.divergence import first_undefined, hardest, runaway
from flexcage.integrate.foresight import EVERY, Foresight
from flexcage.integrate.recorded import recorded, recorded_names
from flexcage.integrate.recording import Recording
from flexcage.integrate.registered import computed_in, registered
from flexcage.results.lowpass import butterworth, low_passed
from flexcage.results.options import OutputOptions
from flexcage.results.registry import COMPUTED
from flexcage.results.store import LOADS, MemoryRunStore
from flexcage.solve.contract import (
    COUNTS,
    DONE,
    LOG_COLUMNS,
    LOG_FULL,
    NOT_FINITE,
    OUTCOMES,
    Effort,
    H,
    T,
)
from flexcage.solve.integrators import INTEGRATORS
from flexcage.solve.options import SolverOptions
from flexcage.system.begun import Start
from flexcage.system.data import (
    EVENT_CLOSED,
    EVENT_ELEMENT,
    EVENT_PLACE,
    EVENT_TIME,
    MASS,
    POWERS,
)
from flexcage.system.problem import BearingSystem
from flexcage.system.scales import work_weights

log = logging.getLogger(__name__)

FILTER_HZ = 10e3  # low-pass of outer_acceleration_filtered
FIRST_STEP = 1e-7
BEHIND = 1e-13  # [s] that a run begins behind a corner: more than rounding puts a time beside it
CAREFUL = 1e-11  # [s] first step there of an integrator of several steps, which knows one slope
_REMEMBERED = (
    "closed",
    "land",
    "force",
    "pocket_force",
    "pocket_force_before",
)  # of Events by checkpoints
LOG_ROWS = EVERY  # steps that are logged at a time, at most
_FIRST_ROWS, _BETWEEN = 512, 1.0  # at first; more of them where they take less than so many s


class _Attempt(NamedTuple):
    """A block as it was integrated: samples of the fine grid, what is stored of the main one."""

    times: np.ndarray  # (n,) [s]
    ys: np.ndarray  # (n, size)
    yds: np.ndarray  # (n, size)
    arrays: dict[str, np.ndarray]  # by name, of ``done`` samples of the main grid
    steps: np.ndarray  # rows of the log
    done: int
    outcome: int
    deep: Any  # (sample, what, why) of a divergence, or nothing
    weighed: Weighed

    @property
    def whole(self) -> bool:
        """Whether the block came to its end."""
        return self.outcome == DONE and not self.deep


class Integration:
    """The integration of one run: goes on from a checkpoint if the store has one."""

    def __init__(
        self,
        bearing: BearingSystem,
        recording: Recording[Any],
        start: Start,
        store: MemoryRunStore,
        *,
        solver: SolverOptions,
        output: OutputOptions,
    ) -> None:
        self.bearing, self.recording, self.store = bearing, recording, store
        self.solver, self.output = solver, output
        held = {v.name for v in store.layout.variables}
        own = (name for name in recorded_names(bearing, recording) if name not in COMPUTED)
        lacking = [name for name in own if name not in held]
        if lacking:
            raise _of_another(f"it holds no '{lacking[0]}'", lacking[0])
        self._computed = computed_in(store)
        self._balance = Balance(store)
        self.level, self.repeated = 0, 0  # of the tolerance, as ``tightened``; blocks done again
        self.bound = np.inf  # [s] least stability bound of explicit steps so far
        self._take("bdf" if solver.method == "auto" else solver.method, 0.0, start.y, start.yd)
        self._filter = np.zeros((2, 2, 2))
        self._rows = _FIRST_ROWS
        self._foresight = Foresight(solver.max_steps, store.layout.n_time / output.rate)
        begun = store.blocks > 0  # by an earlier flexcage, if it has no loads
        self._keeps_loads = bearing.layout.modes > 0 and not (begun and not store.loads(0))
        saved = store.checkpoint()
        if saved is not None:
            self._restore(saved)

    def _take(
        self, method: str, time: float, y: np.ndarray, yd: np.ndarray, step: float = FIRST_STEP
    ) -> None:
        """Go on with this integrator from (time, y, y'); integrals and counters are kept."""
        before = getattr(self, "state", None)
        self.integrator = INTEGRATORS[method]
        self.options = self.integrator.options(self.solver)
        tolerance = self.tightened * self.solver.tolerance
        weight = self.bearing.error_weights(tolerance, implicit=not self.integrator.bounded)
        self.state = self.integrator.new_state(
            time, y, yd, weight=weight, h0=step,
            quad_weight=work_weights(self.bearing.data.model, tolerance), modes=self.bearing.modes,
        )  # fmt: skip
        if before is not None:
            self.state.quad[:] = before.quad
            self.state.count[: len(COUNTS)] = before.count[: len(COUNTS)]

    def _choose(self) -> None:
        """The integrator of the next block and its steps, by the stability bound of explicit steps
        there."""
        auto = self.solver.method == "auto"
        if not (auto or self.integrator.bounded):
            return
        y, yd = self.integrator.last(self.state)
        step = self.bearing.stable_step(self.time, y, yd)
        self.bound = min(self.bound, step)
        method = cheaper(self.bearing, step, self.solver)
        if auto and method != self.integrator.name:
            log.debug("%s from t = %.4f ms on: explicit steps up to %.3g us are stable", method,
                      self.time * 1e3, step * 1e6)  # fmt: skip
            self._take(method, self.time, y, yd)
        if self.integrator.bounded:
            self._foresight.explicit(self.effort.counts["steps"], self.time, step)
        self.options = self.integrator.within(self.integrator.options(self.solver), step)

    def _corners(self, end: float) -> np.ndarray:
        """Corners of the drive and the loads from now on to before ``end``; one that rounding puts
        just before the end, where a sample waits, is left to what follows."""
        early = 2.0 * _behind(end)
        return self.bearing.corners(self.time - early, end - early)

    def _turn(self) -> None:
        """Begin anew behind a corner of the drive or a load, where y' jumps: from y, integrals and
        counters; an integrator of several steps has no history there."""
        y, yd = self.integrator.last(self.state)
        time, options = self.time + _behind(self.time), self.options
        step = max(CAREFUL, self.solver.min_step)
        if self.integrator.bounded:  # of single steps: as long as the last
            step = float(self.state.real[H])
        self._take(self.integrator.name, time, y, yd, step)
        self.options = options

    @property
    def effort(self) -> Effort:
        """What the integration took so far."""
        counts = {k: int(self.state.count[i]) for k, i in COUNTS.items()}
        return Effort({**counts, "repeated_blocks": self.repeated}, self.bound)

    @property
    def tightened(self) -> float:
        """The tolerance of the steps over the case's."""
        return TIGHTER**self.level

    @property
    def pace(self) -> tuple[float, float]:
        """Seconds, and the bearing time [s] that they took, without the loading of kernels."""
        return self._foresight.spent(self.time)

    @property
    def time(self) -> float:
        """Bearing time reached [s]."""
        return float(self.state.real[T])

    def march(self, progress: Callable[..., Any] | None = None) -> None:
        """Integrate the blocks that the store lacks; ``progress`` as core.progress.Progress."""
        duration = self.store.layout.n_time / self.output.rate
        with (progress or Silent)(duration, "solving") as bar:
            bar.begin_at(self.time)
            while not self.store.complete:
                before = self.store.n_time
                self._block(self.store.blocks)
                assert self.store.n_time > before, "a block that ends where it began"
                bar.to(self.time)
                self._foresight.look(self.effort.counts["steps"], self.time)

    def _block(self, index: int) -> None:
        """Integrate and store a block; again with a tighter tolerance where energy leaks."""
        begun = self._checkpoint()
        found = self._attempt(index)
        while found.weighed.over and self.level < AGAIN:
            found = self._again(index, begun, self.level + 1)
            if not found.whole:  # steps became too short, say: as it was
                found = self._again(index, begun, self.level - 1)
                break
        self._keep(index, found)
        if found.deep:
            first = found.times[self.output.vibration_ratio * (found.done + 1) - 1]
            raise RunFailed(
                f"{found.deep[1]} at t = {first * 1e3:.4f} ms; {found.deep[2]}; what was computed "
                "before is kept"
            )
        if not found.whole:
            raise RunFailed(self._stopped(found.outcome))

    def _again(self, index: int, begun: dict[str, np.ndarray], level: int) -> _Attempt:
        """A block from its start with another tolerance; what this costs is counted."""
        spent, repeated = self.state.count.copy(), self.repeated
        self._restore({**begun, "level": np.array(level)})
        self.state.count[: len(COUNTS)] = spent[: len(COUNTS)]
        self.repeated = repeated + 1
        log.debug("block %d again with %g of the tolerance", index, self.tightened)
        return self._attempt(index)

    def _attempt(self, index: int) -> _Attempt:
        ratio, layout = self.output.vibration_ratio, self.bearing.layout
        low, high = self.store.layout.span(index, "time_hf")
        times = np.arange(low + 1, high + 1) / self.output.vibration_rate
        n = len(times)
        ys, yds = np.zeros((n, layout.size)), np.zeros((n, layout.size))
        quads = np.zeros((n, len(POWERS)))
        self.integrator.refresh(self.state)  # a resumed run repeats an unbroken one bit by bit
        self._choose()
        self.bearing.data.events.fill[0] = 0
        self.bearing.data.events.pocket_force_peak[...] = 0.0  # as in a run that is resumed here
        self.bearing.data.between.fill[:] = 0
        self.bearing.data.between.clock[:] = -np.inf, self.time + 1.0 / self.output.rate
        outcome, sample, steps = self._advance(times, ys, yds, quads)
        done = sample // ratio
        deep = runaway(self.bearing, self.recording, ys[ratio - 1 : sample : ratio])
        if deep:
            done = deep[0]
        main = slice(ratio - 1, done * ratio, ratio)
        arrays = {}
        if done:  # a solver that stops before the first sample leaves nothing to write
            arrays = recorded(self.bearing, self.recording, ys[main], yds[main])
            arrays["work"] = quads[main]
        whole = outcome == DONE and not deep
        weighed = self._balance.weigh(arrays["energy"], arrays["work"]) if whole else NEITHER
        return _Attempt(times, ys, yds, arrays, steps, done, outcome, deep, weighed)

    def _advance(
        self, times: np.ndarray, ys: np.ndarray, yds: np.ndarray, quads: np.ndarray
    ) -> tuple[int, int, np.ndarray]:
        """Fill a block's samples; (outcome, samples filled, rows of the log)."""
        logs, sample, outcome = [], 0, DONE
        log, used = np.zeros((self._rows, len(LOG_COLUMNS))), 0
        for stop in [*self._corners(times[-1]), times[-1]]:
            outcome = LOG_FULL
            while outcome == LOG_FULL:
                begin = perf_counter()
                outcome, sample, rows = self.bearing.advance(
                    self.integrator, self.state, self.options, stop, times, ys, yds, sample,
                    log[used:], quads,
                )  # fmt: skip
                used += rows
                if outcome == LOG_FULL:
                    logs.append(log)
                    self._foresight.look(self.effort.counts["steps"], self.time)
                    if perf_counter() - begin < _BETWEEN:
                        self._rows = min(8 * self._rows, LOG_ROWS)
                    log, used = np.zeros((self._rows, len(LOG_COLUMNS))), 0
            if outcome != DONE:
                break
            if stop < times[-1]:
                self._turn()
        return outcome, sample, np.concatenate([*logs, log[:used]])

    def _keep(self, index: int, found: _Attempt) -> None:
        """Store what an attempt found, and the last state before a divergence."""
        last = self.output.vibration_ratio * found.done - 1
        if found.done:
            fine = self._fine(found.yds[: last + 1], last + 1)
            if found.weighed.spare and self.level:
                self._restore({**self._checkpoint(), "level": np.array(self.level - 1)})
            self._balance.keep(found.done)
            steps = dict(zip(LOG_COLUMNS, found.steps.T, strict=True))
            self.store.write_block(
                index,
                found.arrays | registered(self._computed, found.arrays, self.bearing, self.store),
                fine,
                self._checkpoint() if found.whole else None,
                {"steps": steps, "events": self._events(), **self._loads()},
            )
        if found.deep and found.done:
            self.store.keep_last(
                {"time": found.times[last], "y": found.ys[last], "yd": found.yds[last]}
            )

    def _stopped(self, outcome: int) -> str:
        """Keep the last accepted state; the sentence that says when and where this was."""
        y, yd = self.integrator.last(self.state)
        self.store.keep_last({"time": self.time, "y": y, "yd": yd})
        look = first_undefined if outcome == NOT_FINITE else hardest
        place = look(self.bearing, self.time, y, yd)
        return (
            f"the solver stopped at t = {self.time * 1e3:.4f} ms: {OUTCOMES[outcome]}; the "
            f"hardest contact then was {place}; what was computed is kept"
        )

    def _fine(self, yd: np.ndarray, n: int) -> dict[str, np.ndarray]:
        """Outer ring's acceleration; of a fixed ring, what its contact forces would give it."""
        ring = self.bearing.data.model.outer_ring
        raw = self.bearing.data.samples.force[:n] / ring.inertia[MASS]
        if ring.free.any():
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

    def _parts(self) -> dict[str, np.ndarray]:
        state = self.integrator.checkpoint(self.state)
        memory = {f"memory_{k}": v for k, v in self.bearing.data.memory._asdict().items()}
        events = self.bearing.data.events
        kept = {f"events_{k}": getattr(events, k) for k in _REMEMBERED}
        return {**state, **memory, **kept, "filter": self._filter}

    def _checkpoint(self) -> dict[str, np.ndarray]:
        kept = {k: v.copy() for k, v in self._parts().items()}
        return {
            **kept,
            "integrator": np.array(self.integrator.name),
            "bound": np.array(self.bound),
            "level": np.array(self.level),
            "repeated": np.array(self.repeated),
        }

    def _restore(self, saved: dict[str, np.ndarray]) -> None:
        lacking = {"integrator", "bound", "level", "repeated"} - set(saved)
        if lacking:
            name = min(lacking)
            raise _of_another(f"its checkpoint holds no '{name}'", name)
        self.level, self.repeated = int(saved["level"]), int(saved["repeated"])
        y, yd = self.integrator.last(self.state)
        self._take(str(saved["integrator"]), 0.0, y, yd)
        self.bound = float(saved["bound"])
        for name, array in self._parts().items():
            found = saved[name].shape if name in saved else "nothing"
            if found != array.shape:
                raise _of_another(
                    f"its checkpoint holds {found} of '{name}', and this one needs {array.shape}",
                    name,
                )
            array[...] = saved[name]


def cheaper(bearing: BearingSystem, step: float, solver: SolverOptions) -> str:
    """The integrator that "auto" takes where explicit steps up to ``step`` [s] are stable."""
    if bearing.data.model.inner_ring.stands:  # a held centre has no implicit equation
        return "explicit"
    return "bdf" if step < bearing.motion.implicit_share * solver.stable_step else "explicit"


def _of_another(how: str, name: str) -> InputError:
    return InputError(
        f"The run was begun by another flexcage: {how}; finish it with the flexcage that began "
        "it, or begin it again.",
        where=name,
    )


def _behind(time: float) -> float:
    return BEHIND * (1.0 + 0.1 * time)
