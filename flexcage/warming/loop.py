"""The loop: losses at temperatures, temperatures under losses, until both agree.

Temperatures change over minutes and contacts over microseconds, so that heat is no unknown of the
equations of motion: a static solution, or a short run, is repeated at new temperatures. These are
found by Anderson's method (J. ACM 12 (1965) 547): from the last changes it learns how losses
answer, as a secant would, so that losses that fall steeply with warmth do not make it swing.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from typing import Any, cast

import numpy as np

from flexcage.case import Case, StaticCase
from flexcage.case.heat_checks import find_without_oil
from flexcage.core.binding import expect
from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.progress import Silent
from flexcage.core.units import describe
from flexcage.geometry.heat.network import ELEMENTS, INNER, OIL, OUTER, TITLES
from flexcage.geometry.heat.spec import Heat
from flexcage.run.foreseen import foreseen, reported_at_once
from flexcage.static import solve_static
from flexcage.warming.at_temperatures import Evaluated, evaluate, film_of, warmed
from flexcage.warming.warmth import RUNAWAY, SETTLED, UNSETTLED, ZERO, Iteration, Warmth

_FIRST, _MEMORY = 0.5, 3  # share of the first change that is taken; changes that are remembered
_STEP = 40.0  # K: no temperature changes by more at once
_HALVINGS = 7  # of a step that leads where the bearing cannot turn
_BALANCED = 0.01  # heat that leaves is the losses within this share
_GUESS = 40.0  # K above what is around, if the case names no temperature


def warm(case: StaticCase, *, progress: Any = None) -> Warmth:
    """Temperatures at which a bearing's losses and the heat that leaves it agree.

    ``case.heat`` says where heat leaves and whether losses are of static solutions or of runs,
    which need a :class:`Case`. A bearing that does not settle below what oil and steel bear, or
    whose clearance closes, is a result too: see :class:`Warmth`. Raises InputError for a case
    without a speed or the oil's viscosities, and for what cannot be at the first temperatures.
    """
    expect(case, (StaticCase, Case), "case", "flexcage.load_case reads one from a file")
    for where, sentence in find_without_oil(case):
        raise InputError(sentence, where=where)
    if case.heat.losses == "run" and not isinstance(case, Case):
        raise InputError(
            "heat.losses is 'run', which needs a case that can be run, with its cage; complete it, "
            'or take heat.losses = "static".',
            where="heat.losses",
        )
    heat, search = case.heat, _Search(_first(case))
    done: list[Evaluated] = []
    verdict, sentence = UNSETTLED, ""
    with _told_once(case, search), (progress or Silent)(heat.iterations, "settling") as shown:
        for k in range(heat.iterations):
            try:
                done.append(_evaluated(case, search))
            except FlexcageError as exc:
                if not done:
                    raise
                verdict, sentence = RUNAWAY, _stopped(exc, done[-1].iteration)
                break
            shown.to(k + 1)
            verdict, sentence = _judged(heat, done[-1].iteration, k + 1)
            if verdict != UNSETTLED:
                break
            search.go_on(done[-1].iteration)
    return _result(case, done, verdict, sentence)


def _told_once(case: StaticCase, search: _Search) -> AbstractContextManager[None]:
    """What is foreseen of runs is logged once, not at every turn."""
    if case.heat.losses == "static":
        return nullcontext()
    first, _ = warmed(case, search.temperatures)
    return reported_at_once((cast(Case, first),), stress=False)


def _evaluated(case: StaticCase, search: _Search) -> Evaluated:
    """What is at the temperatures to try or, where the bearing cannot turn there, nearer to the
    last ones at which it could. Raises the first reason where it cannot near them either."""
    reason: FlexcageError | None = None
    for _ in range(_HALVINGS):
        try:
            return evaluate(case, search.temperatures)
        except FlexcageError as exc:
            reason = reason or exc
            if not search.go_back():
                break
    assert reason is not None
    raise reason


def _judged(heat: Heat, found: Iteration, count: int) -> tuple[str, str]:
    """Verdict on an iteration, and its sentence."""
    if found.change <= heat.tolerance and abs(found.imbalance) <= _BALANCED:
        return SETTLED, _settled(found, count)
    beyond = _past(heat, found)
    return (RUNAWAY, beyond) if beyond else (UNSETTLED, _unsettled(heat, found))


class _Search:
    """The temperatures to try next."""

    def __init__(self, first: Mapping[str, float]) -> None:
        self.temperatures = dict(first)
        self._tried: list[tuple[np.ndarray, np.ndarray]] = []

    def go_on(self, found: Iteration) -> None:
        """Take a step, from where the network goes under the losses of an iteration."""
        names = list(found.towards)
        at, towards = (np.array([t[n] for n in names]) for t in (found.temperatures, found.towards))
        self._tried = [*self._tried, (at, towards - at)]
        self._tried = self._tried[-_MEMORY:]
        step = self._step()
        step *= min(1.0, _STEP / max(float(np.abs(step).max()), 1e-300))
        self.temperatures = dict(zip(names, map(float, at + step)))

    def go_back(self) -> bool:
        """Take half of the last step; False before the first one."""
        if not self._tried:
            return False
        at = dict(zip(self.temperatures, self._tried[-1][0]))
        self.temperatures = {n: 0.5 * (t + float(at[n])) for n, t in self.temperatures.items()}
        return True

    def _step(self) -> np.ndarray:
        """Anderson's step; against the way that the network goes, towards temperatures that would
        not last, none: there a share of that way."""
        change: np.ndarray = self._tried[-1][1]
        if len(self._tried) == 1:
            return _FIRST * change
        moved, answered = (np.diff([pair[i] for pair in self._tried], axis=0).T for i in (0, 1))
        share = np.linalg.lstsq(answered, change, rcond=1e-3)[0]
        found: np.ndarray = change - (moved + answered) @ share
        return found if found @ change > 0.0 else _FIRST * change


def _first(case: StaticCase) -> dict[str, float]:
    start = case.life.temperature
    start = case.heat.ambient + _GUESS if start is None else start
    return dict.fromkeys((INNER, OUTER, ELEMENTS, OIL, "shaft", "housing"), start)


def _past(heat: Heat, found: Iteration) -> str:
    """A sentence on what is past its limit, and stays there; empty where nothing is."""
    limits = dict.fromkeys((INNER, OUTER, ELEMENTS), ("steel_limit", heat.steel_limit))
    limits |= {OIL: ("oil_limit", heat.oil_limit)}
    film = film_of(found.towards)
    if min(found.film, film) > heat.oil_limit:
        return _beyond("oil in contacts", film, "oil_limit", heat.oil_limit, found)
    for body, (key, limit) in limits.items():
        if min(found.temperatures[body], found.towards[body]) > limit:
            return _beyond(TITLES[body], found.towards[body], key, limit, found)
    return ""


def _beyond(what: str, towards: float, key: str, limit: float, found: Iteration) -> str:
    return (
        f"Runaway: the {what} is past heat.{key}, {describe(limit, 'degC')}, and under the losses "
        f"there, {found.loss:.4g} W, goes to {towards - ZERO:.0f} degC; more heat has to leave, or "
        "less to arise."
    )


def _stopped(exc: FlexcageError, before: Iteration) -> str:
    rings = ", ".join(f"{TITLES[b]} {before.temperatures[b] - ZERO:.0f}" for b in (INNER, OUTER))
    return (
        f"Runaway: beyond these temperatures ({rings} degC) the bearing cannot turn: "
        f"{str(exc).rstrip('.')}."
    )


def _times(count: int) -> str:
    return f"{count} iteration{'s' if count > 1 else ''}"


def _settled(found: Iteration, count: int) -> str:
    return (
        f"Settled after {_times(count)} within {found.change:.2g} K: inner ring "
        f"{found.temperatures[INNER] - ZERO:.1f} degC, outer ring "
        f"{found.temperatures[OUTER] - ZERO:.1f} degC, losses {found.loss:.4g} W."
    )


def _unsettled(heat: Heat, found: Iteration) -> str:
    return (
        f"Not settled after {_times(heat.iterations)} (heat.iterations): the last one still "
        f"asks for {found.change:.2g} K."
    )


def _result(case: StaticCase, done: list[Evaluated], verdict: str, sentence: str) -> Warmth:
    """The value of iterations, with the case and its static solution at their end."""
    last = done[-1]
    written = {b: round(t, 2) for b, t in last.iteration.temperatures.items()}  # as people write
    final, notes = warmed(case, written)
    solution = solve_static(final)
    if case.heat.losses == "run":
        said = (warning.text for warning in foreseen(cast(Case, final), stress=False))
        more = (text for text in said if text not in solution.warnings)
        solution = replace(solution, warnings=(*solution.warnings, *more))
    return Warmth(
        name=case.name, verdict=verdict, sentence=sentence,
        iterations=tuple(e.iteration for e in done), case=final, solution=solution,
        network=last.network, notes=notes,
    )  # fmt: skip
