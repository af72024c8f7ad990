"""What a run, or a study's many, will take of disk and time: said before they begin.

Time is that of the last run of its kind on this machine, which the cache keeps: seconds for a
second of bearing time and each rolling element. Loads and speeds change it by a factor of a few.
"""

from __future__ import annotations

import json
import logging
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from flexcage.bearings import recording_of
from flexcage.case import Case
from flexcage.core.cache import cache_root
from flexcage.core.hashing import content_hash
from flexcage.core.memory import in_bytes
from flexcage.core.progress import clock
from flexcage.core.reading import read_json, table_of
from flexcage.core.units import describe
from flexcage.core.writing import replace
from flexcage.integrate.foresight import LONG
from flexcage.integrate.recorded import new_store
from flexcage.results import disk_space
from flexcage.results.layout import StoreLayout
from flexcage.stages import bearing_to_compile

log = logging.getLogger(__name__)

_LEAST = 2.0  # s of solving that tell a pace
_MOST = 200  # kinds of runs whose pace is kept
_WITHIN = 0.9  # of the disk's room, that a remedy fills


class Cost:
    """Disk [bytes] and time [s] of all cases that were counted; ``keeps``: are their runs kept?"""

    def __init__(self, *, keeps: bool = True) -> None:
        self.keeps = keeps
        self.disk, self.seconds, self.cases = 0.0, 0.0, 0
        self.unknown = 0  # cases whose pace is not known
        self._first: Case | None = None

    def counted(self, case: Case) -> Case:
        """The case, which is counted."""
        if self._first is None:
            self._first = case
        if self.keeps:
            self.disk += self._bytes_of(case)
        seconds = expected_seconds(case)
        self.unknown += seconds is None
        self.seconds += seconds or 0.0
        self.cases += 1
        return case

    def _bytes_of(self, case: Case) -> float:
        flexible, output = case.cage_model == "flexible", case.output
        rate = disk_space.expected_rate(
            self._layout, output.rate, output.vibration_rate, flexible=flexible
        )
        return disk_space.expected_size(rate, case.solver.duration, flexible=flexible)

    @cached_property
    def _layout(self) -> StoreLayout:
        """What a run of the first case records; the others' differ little."""
        assert self._first is not None
        bearing, recording = bearing_to_compile(self._first), recording_of(self._first.bearing)
        output = self._first.output
        return new_store(None, bearing, recording, duration=0.0, output=output, attrs={}).layout

    def announce(
        self,
        folder: Path | None,
        *,
        workers: int = 1,
        each: float | None = None,
        quiet: bool = False,
    ) -> None:
        """Say what is worth saying; EnvironmentLacks where the disk has no room.

        ``folder`` receives the runs, None: they are not kept. ``each`` [s] is what a case takes,
        if cases of the study have shown it. ``quiet``: refuse only.
        """
        if folder is not None and self.keeps and self.cases:
            disk_space.announce(folder, self.disk, *self._words(folder), quiet=quiet)
        if each is not None:
            seconds = each * self.cases / workers
        elif not self.unknown:
            seconds = self.seconds / workers
        else:
            return
        if seconds > LONG and not quiet:
            log.info("%s", self._time(seconds, workers, measured=each is not None))

    def _words(self, folder: Path) -> tuple[str, str]:
        """What needs room, and what would be enough."""
        assert self._first is not None
        other = "or name a folder on another disk"
        share = _WITHIN * disk_space.free_bytes(folder) / self.disk
        if self.cases > 1:
            what = f"the runs of {self.cases:,} cases need"
            return what, f"keep = 'figures' keeps no runs, {int(share * self.cases):,} fit; {other}"
        one, output = self._first.solver.duration, self._first.output
        text = describe(float(f"{share * one:.2g}"), "ms")
        return (
            f"the results ({in_bytes(self.disk / one)} for a second of bearing time) need",
            f"there is room for solver.duration = {text}, or for the whole at output.rate = "
            f"{describe(float(f'{share * output.rate:.2g}'), 'kHz')}; {other}",
        )

    def _time(self, seconds: float, workers: int, *, measured: bool) -> str:
        assert self._first is not None
        by = "by the cases that are done" if measured else "as the last such run on this machine"
        if self.cases > 1:
            crew = f"{workers} worker{'s' * (workers != 1)}"
            return f"{self.cases:,} cases will take about {clock(seconds)} on {crew}, {by}"
        enough = float(f"{self._first.solver.duration * LONG / seconds:.2g}")
        return (
            f"solving will take about {clock(seconds)}, {by}; solver.duration = "
            f"{describe(enough, 'ms')} takes {clock(LONG)}"
        )


def report_cost(case: Case, folder: Path | None, *, quiet: bool) -> None:
    """Say what one run will take; EnvironmentLacks where the disk has no room. ``quiet``: only
    that."""
    cost = Cost(keeps=folder is not None)
    cost.counted(case)
    cost.announce(folder, quiet=quiet)


def expected_seconds(case: Case) -> float | None:
    """Seconds of solving, by the last run of the kind on this machine; None if there was none."""
    pace = _kept().get(_kind(case))
    if not isinstance(pace, (int, float)) or not pace > 0.0:
        return None
    return pace * case.bearing.total_elements * case.solver.duration


def note_pace(case: Case, seconds: float, solved: float) -> None:
    """Keep what a run took: ``seconds`` for ``solved`` [s] of bearing time."""
    if seconds < _LEAST or solved <= 0.0:
        return
    with suppress(OSError):  # it is a help, no more
        others = {k: v for k, v in _kept().items() if k != _kind(case)}
        table = dict([*others.items()][-_MOST:])
        table[_kind(case)] = seconds / (case.bearing.total_elements * solved)
        cache_root().mkdir(parents=True, exist_ok=True)
        replace(_file(), json.dumps(table).encode())


def _kind(case: Case) -> str:
    """Names what decides about the pace most."""
    return content_hash(
        case.bearing.type, case.cage.cage_type if case.cage else "", case.cage_model,
        case.rings_bend, case.solver.method, case.solver.tolerance, case.modes.kind,
        round(case.speed),
    )  # fmt: skip


def _kept() -> dict[str, Any]:
    try:
        return table_of(read_json(_file()))
    except (OSError, ValueError):
        return {}


def _file() -> Path:
    return cache_root() / "pace.json"
