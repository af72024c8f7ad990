"""A test rig's file of laser readings, in columns of a CSV file."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.texts import text_of

CHANNELS = ("Y", "Z", "X1", "X2", "X3")
FARTHEST = 10.0  # mm, that a cage moves: tens of times the clearance of large bearings' cages
_NEAREST = 1e-3  # mm, that the readings of a rig reach at least: metres do not
_OF_TIMES = re.compile(r"time|zeit\b|sec|(?-i:t)\b", re.IGNORECASE)
TIME = "t"  # column of a rig's file that holds times in seconds


def load_readings(path: str | Path) -> np.ndarray:
    """Readings (n, 5) [m] of a test rig from a CSV file, in the order of ``CHANNELS``.

    Its first line names the columns Y, Z, X1, X2, X3 in any order; below are numbers in
    millimetres. Other columns are ignored; ``load_times`` reads one of times. Raises InputError
    for a file that has them not.
    """
    names, table = _columns(path)
    lacking = [name for name in CHANNELS if name not in names]
    if lacking:
        raise InputError(
            f"The readings '{path}' have no column '{lacking[0]}'; the first line must name "
            f"{', '.join(CHANNELS)}, then numbers in mm.",
            where=lacking[0],
        )
    found = table[:, [names.index(name) for name in CHANNELS]]
    farthest = float(np.abs(found).max())
    if 0.0 < farthest < _NEAREST:
        raise InputError(
            f"The readings '{path}' stay within {farthest:g} mm, less than any laser tells: write "
            "mm, as 0.15 for 150 um.",
            value=farthest,
        )
    if farthest > FARTHEST:
        raise InputError(
            f"The readings '{path}' go up to {farthest:g} mm, but no cage moves farther than "
            f"{FARTHEST:g} mm in its clearance: write mm, as 0.15 for 150 um, from the reading of "
            "a centred cage.",
            value=farthest,
        )
    return 1e-3 * found


def load_times(path: str | Path) -> np.ndarray | None:
    """Times (n,) [s] of a rig's readings: the column t of their file; None if it has none.

    Raises InputError for times of another name, and for those that do not rise.
    """
    names, table = _columns(path)
    if TIME not in names:
        if other := next((name for name in names if _OF_TIMES.match(name)), None):
            raise InputError(
                f"The readings '{path}' have a column '{other}'; name it t, and give seconds.",
                where=TIME,
                value=other,
            )
        return None
    times: np.ndarray = table[:, names.index(TIME)]
    if (late := np.flatnonzero(np.diff(times) <= 0.0)).size:
        row = int(late[0]) + 1
        raise InputError(
            f"The readings '{path}' have times that do not rise: reading {row + 1} is at "
            f"{times[row]:g} s, after {times[row - 1]:g} s; sort them, or write more digits.",
            where=TIME,
            value=float(times[row]),
        )
    return times


def _columns(path: str | Path) -> tuple[list[str], np.ndarray]:
    """Names of a CSV file's columns, and its numbers (n, columns)."""
    file = path_of(path, "readings")
    try:
        first, *rest = text_of(file, "readings are").splitlines() or [""]
    except OSError as exc:
        raise InputError(f"The readings '{path}' cannot be read: {exc.strerror}.") from exc
    names = [name.strip() for name in first.split(",")]
    if twice := next((name for name in names if name and names.count(name) > 1), None):
        raise InputError(
            f"The readings '{path}' have {names.count(twice)} columns '{twice}'; leave one of "
            "them.",
            where=twice,
        )
    lines = [(number, line) for number, line in enumerate(rest, 2) if line.strip()]
    other = next((f"'{mark}'" if mark == ";" else "tabs" for mark in ";\t" if mark in first), None)
    if other:
        raise InputError(
            f"The readings '{path}' have {other} between their columns; write commas there, and "
            "numbers with a point, as 0.15."
        )
    if not lines:
        raise InputError(
            f"The readings '{path}' hold 0 numbers below their first line, which names the columns."
        )
    try:
        table = np.loadtxt([line for _, line in lines], delimiter=",", ndmin=2)
    except ValueError:
        table = np.full((1, 1), np.nan)
    if table.shape[1] != len(names) or not np.isfinite(table).all():
        raise InputError(f"The readings '{path}' {_fault(names, lines)}.")
    return names, table


def _fault(names: list[str], lines: list[tuple[int, str]]) -> str:
    """What is wrong with the first line that is."""
    for number, line in lines:
        entries = [entry.strip() for entry in line.split(",")]
        if len(entries) != len(names):
            return (
                f"name {len(names)} columns, but their line {number} holds {len(entries)} numbers; "
                "write one number a column, with a point, as 0.15"
            )
        for name, entry in zip(names, entries):
            try:
                known = np.isfinite(float(entry))
            except ValueError:
                known = False
            if not known:
                return (
                    f"hold what is no number: '{entry}' in line {number}, column '{name}'; leave "
                    "out lines without a reading"
                )
    return "hold what is no number"
