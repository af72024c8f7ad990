"""Integrate a bearing block by block and record what happens: samples by name, checkpoint, log."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.core.progress import Silent
from flexcage.integrate.balance import AGAIN, NEITHER, TIGHTER, Weighed
from flexcage.integrate.foresight import EVERY, Foresight
from flexcage.integrate.recorder import Recorder, of_another
from flexcage.integrate.recording import Recording
from flexcage.results.options import OutputOptions
from flexcage.results.registry import TIME
from flexcage.results.store import MemoryRunStore
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
from flexcage.system.integrable import Integrable
from flexcage.system.problem import BearingSystem

log = logging.getLogger(__name__)

FIRST_STEP = 1e-7
BEHIND = 1e-13  # [s] that a run begins behind a corner: more than rounding puts a time beside it
CAREFUL = 1e-11  # [s] first step there of an integrator of several steps, which knows one slope
LOG_ROWS = EVERY  # steps that are logged at a time, at most
_FIRST_ROWS, _BETWEEN = 512, 1.0  # at first; more of them where they take less than so many s


class Attempt(NamedTuple):
    """A block as it was integrated: samples of the fine grid, what is stored of the main one."""

    times: np.ndarray  # (n,) [s]
    ys: np.ndarray  # (n, size)
    yds: np.ndarray  # (n, size)
    quads: np.ndarray  # (n, powers)
    arrays: list[dict[str, np.ndarray]]  # of each recorder, of ``done`` samples of the main grid
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
    """The integration of one run: goes on from a checkpoint if the store has one.

    Its ``system`` is a bearing, or several with what couples them; each has a ``Recorder``.
    ``store`` counts the run's blocks and holds its checkpoints: that of the first recorder, or one
    of its own, which ``keep_more`` writes after those of all recorders.
    """

    def __init__(
        self,
        system: Integrable,
        recorders: Sequence[Recorder],
        y: np.ndarray,
        yd: np.ndarray,
        *,
        solver: SolverOptions,
        output: OutputOptions,
        store: MemoryRunStore | None = None,
    ) -> None:
        self.system, self.recorders = system, recorders
        self.bearing, self.store = recorders[0].bearing, store or recorders[0].store
        self.solver, self.output = solver, output
        self.level, self.repeated = 0, 0  # of the tolerance, as ``tightened``; blocks done again
        self.bound = np.inf  # [s] least stability bound of explicit steps so far
        self._take("bdf" if solver.method == "auto" else solver.method, 0.0, y, yd)
        self._rows = _FIRST_ROWS
        self._foresight = Foresight(solver.max_steps, self.store.layout.n_time / output.rate)
        saved = self.store.checkpoint()
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
        weight = self.system.error_weights(tolerance, implicit=not self.integrator.bounded)
        self.state = self.integrator.new_state(
            time, y, yd, weight=weight, h0=step,
            quad_weight=self.system.work_weights(tolerance), modes=self.system.modes,
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
        step = self.system.stable_step(self.time, y, yd)
        self.bound = min(self.bound, step)
        method = self.system.cheaper(step, self.solver.stable_step)
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
        return self.system.corners(self.time - early, end - early)

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
        begun = self.checkpoint()
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

    def _again(self, index: int, begun: dict[str, np.ndarray], level: int) -> Attempt:
        """A block from its start with another tolerance; what this costs is counted."""
        spent, repeated = self.state.count.copy(), self.repeated
        self._restore({**begun, "level": np.array(level)})
        self.state.count[: len(COUNTS)] = spent[: len(COUNTS)]
        self.repeated = repeated + 1
        log.debug("block %d again with %g of the tolerance", index, self.tightened)
        return self._attempt(index)

    def _attempt(self, index: int) -> Attempt:
        ratio = self.output.vibration_ratio
        low, high = (ratio * sample for sample in self.store.layout.span(index, TIME))
        times = np.arange(low + 1, high + 1) / self.output.vibration_rate
        n, size = len(times), self.system.size
        ys, yds, quads = np.zeros((n, size)), np.zeros((n, size)), np.zeros((n, self.system.quads))
        self.integrator.refresh(self.state)  # a resumed run repeats an unbroken one bit by bit
        self._choose()
        for recorder in self.recorders:
            recorder.begin_block(self.time)
        outcome, sample, steps = self._advance(times, ys, yds, quads)
        done = sample // ratio
        found = [r.runaway(ys[ratio - 1 : sample : ratio]) for r in self.recorders]
        deep = min((each for each in found if each), key=lambda each: each[0], default=None)
        if deep:
            done = deep[0]
        main = slice(ratio - 1, done * ratio, ratio)
        arrays = []
        if done:  # a solver that stops before the first sample leaves nothing to write
            arrays = [r.arrays(ys[main], yds[main], quads[main]) for r in self.recorders]
        whole = outcome == DONE and not deep
        weighed = self._weighed(arrays) if whole else NEITHER
        return Attempt(times, ys, yds, quads, arrays, steps, done, outcome, deep, weighed)

    def _weighed(self, arrays: list[dict[str, np.ndarray]]) -> Weighed:
        """What a block did to the balance of any bearing."""
        each = [
            r.balance.weigh(a["energy"], a["work"])
            for r, a in zip(self.recorders, arrays, strict=True)
        ]
        return Weighed(any(w.over for w in each), all(w.spare for w in each))

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
                outcome, sample, rows = self.system.advance(
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

    def _keep(self, index: int, found: Attempt) -> None:
        """Store what an attempt found, and the last state before a divergence."""
        last = self.output.vibration_ratio * found.done - 1
        if found.done:
            if found.weighed.spare and self.level:
                self._restore({**self.checkpoint(), "level": np.array(self.level - 1)})
            steps = dict(zip(LOG_COLUMNS, found.steps.T, strict=True))
            for recorder, arrays in zip(self.recorders, found.arrays, strict=True):
                recorder.balance.keep(found.done)
                whole = found.whole and recorder.store is self.store
                checkpoint = self.checkpoint if whole else None
                recorder.keep(index, arrays, found.yds[: last + 1], checkpoint, steps)
            self.keep_more(index, found)
        if found.deep and found.done:
            self.store.keep_last(
                {"time": found.times[last], "y": found.ys[last], "yd": found.yds[last]}
            )

    def keep_more(self, index: int, found: Attempt) -> None:
        """Keep what else there is of a block."""

    def _stopped(self, outcome: int) -> str:
        """Keep the last accepted state; the sentence that says when and where this was."""
        y, yd = self.integrator.last(self.state)
        self.store.keep_last({"time": self.time, "y": y, "yd": yd})
        undefined = outcome == NOT_FINITE
        places = [r.look(self.time, y, yd, undefined=undefined) for r in self.recorders]
        return (
            f"the solver stopped at t = {self.time * 1e3:.4f} ms: {OUTCOMES[outcome]}; the "
            f"hardest contact then was {'; '.join(places)}; what was computed is kept"
        )

    def _parts(self) -> dict[str, np.ndarray]:
        found = dict(self.integrator.checkpoint(self.state))
        for recorder in self.recorders:
            found |= recorder.parts()
        return found

    def checkpoint(self) -> dict[str, np.ndarray]:
        """Arrays by name, from which the integration goes on as from now."""
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
            raise of_another(f"its checkpoint holds no '{name}'", name)
        self.level, self.repeated = int(saved["level"]), int(saved["repeated"])
        y, yd = self.integrator.last(self.state)
        self._take(str(saved["integrator"]), 0.0, y, yd)
        self.bound = float(saved["bound"])
        for name, array in self._parts().items():
            found = saved[name].shape if name in saved else "nothing"
            if found != array.shape:
                raise of_another(
                    f"its checkpoint holds {found} of '{name}', and this one needs {array.shape}",
                    name,
                )
            array[...] = saved[name]


def _behind(time: float) -> float:
    return BEHIND * (1.0 + 0.1 * time)


def integration_of(
    bearing: BearingSystem,
    recording: Recording[Any],
    start: Start,
    store: MemoryRunStore,
    *,
    solver: SolverOptions,
    output: OutputOptions,
) -> Integration:
    """The integration of one bearing's run."""
    recorder = Recorder(
        bearing, recording, store, output=output, span=slice(0, bearing.size),
        works=slice(0, bearing.quads),
    )  # fmt: skip
    return Integration(bearing, [recorder], start.y, start.yd, solver=solver, output=output)
