"""Tables of a paper's folder: what its runs gave, from which pages are redrawn and runs go on.

``settings_<map>.csv`` has a row a run of a map, ``starts.csv`` one a run of a reading: outputs in
SI to seven digits, empty where a run failed; processor time [s]; and the physics that computed it.
Ranges, conditions and design of the map are known by their hash; a change of its base case is not
seen, so remove the table after one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from flexcage.core.hashing import content_hash
from flexcage.study import Map, MapResults
from flexcage.study.maps import CONDITION as LABEL
from flexcage.study.maps import SAMPLE

SETTING, START, CONDITION, SECONDS, PHYSICS = "setting", "start", "condition", "seconds", "physics"
KEYS = [SETTING, START, CONDITION]
MAP = "map"  # column of the hash
FEWEST = 32  # settings that a smaller sample may have
SHORT = 8  # characters of a version of the equations
DIGITS = "%.7g"


@dataclass(frozen=True)
class Settings:
    """Runs of a map: a row of ``table`` by setting, start and condition, also one that failed."""

    spec: Map
    table: pd.DataFrame

    @property
    def conditions(self) -> list[str]:
        return [str(c["label"]) for c in self.spec.conditions]

    def values(self, output: str, condition: str) -> np.ndarray:
        """An output (settings, starts) under a condition, SI; NaN where there is none."""
        found = np.full((len(self.spec.shares), self.spec.starts), np.nan)
        if output in self.table:
            rows = self.table[self.table[CONDITION] == condition]
            found[rows[SETTING], rows[START]] = rows[output]
        return found

    @property
    def lacking(self) -> list[int]:
        """Settings of which a run is not there."""
        runs = self.spec.starts * len(self.spec.conditions)
        count = self.table.groupby(SETTING).size()
        return [k for k in range(len(self.spec.shares)) if count.get(k, 0) < runs]

    @property
    def begun(self) -> Settings:
        """The first settings, a power of two, that have all their runs, if they are ``FEWEST`` or
        more: a smaller sample of the same sequence. Otherwise all."""
        first, size = min(self.lacking, default=len(self.spec.shares)), len(self.spec.shares)
        while size > first:
            size //= 2
        if size < FEWEST or self.spec.design != "sample":
            return self
        return Settings(replace(self.spec, count=size), self.table[self.table[SETTING] < size])

    @property
    def seconds(self) -> float:
        """Processor time of all runs [s]."""
        return float(self.table[SECONDS].sum())

    @property
    def physics(self) -> set[str]:
        """Versions of the equations that computed the runs."""
        return set(self.table[PHYSICS].dropna())

    def with_(self, newer: Settings) -> Settings:
        """Both, of which ``newer`` counts where it has a run."""
        both = pd.concat([self.table, newer.table]).drop_duplicates(KEYS, keep="last")
        return Settings(self.spec, both.sort_values(KEYS[:2], kind="stable"))

    def write(self, path: Path) -> str:
        """A table with the shares of all unknowns beside the outputs; the file's name."""
        shares = pd.DataFrame(self.spec.shares[:, :-1], columns=_columns(self.spec))
        table = self.table.join(shares.round(5), on=SETTING)
        table = table.assign(**{MAP: _hash(self.spec)})
        front = [MAP, *KEYS, *shares.columns]
        rest = [c for c in table if c not in front]
        table[[*front, *rest]].to_csv(path, index=False, float_format=DIGITS)
        return path.name


def empty(spec: Map) -> Settings:
    """No run of a map."""
    return Settings(spec, pd.DataFrame(columns=[*KEYS, SECONDS, PHYSICS]).astype({SETTING: int,
                    START: int}))  # fmt: skip


def read_settings(path: Path, spec: Map) -> Settings:
    """What a folder's table holds of a map: nothing, where there is no table, or one of other
    settings or outputs, which a line says."""
    if not path.is_file():
        return empty(spec)
    table = pd.read_csv(path, dtype={CONDITION: str, PHYSICS: str, MAP: str})
    needed = {MAP, *KEYS, SECONDS, PHYSICS, *_columns(spec), *spec.outputs}
    if not needed <= set(table) or set(table[MAP]) - {_hash(spec)}:
        print(f"{path.name} is of other settings or outputs: its runs are computed anew")
        return empty(spec)
    return Settings(spec, table.drop(columns=[MAP, *_columns(spec)]))


def _columns(spec: Map) -> list[str]:
    return [f"share of {name}" for name in spec.names[:-1]]


def _hash(spec: Map) -> str:
    """Of ranges, conditions and design."""
    ranges = [unknown.in_words() for unknown in spec.unknowns]
    shares, conditions = spec.shares.round(9).tolist(), [dict(c) for c in spec.conditions]
    return content_hash(ranges, conditions, shares, spec.starts)


def settings_of(found: MapResults, spec: Map) -> Settings:
    """Runs that a map's folder holds, done or failed; none of a folder of another map."""
    own = spec.stored()
    if any(found.about[k] != own[k] for k in ("names", "ranges", "shares", "starts", "conditions")):
        return empty(spec)
    rows = [_row(row, found.study.about.outputs) for row in found.study.rows
            if row.state in ("done", "failed")]  # fmt: skip
    return empty(spec).with_(Settings(spec, pd.DataFrame(rows))) if rows else empty(spec)


def _row(row: Any, outputs: Sequence[str]) -> dict[str, Any]:
    setting, start = row.planned.point.labels[SAMPLE].split(".")
    return {
        SETTING: int(setting), START: int(start), CONDITION: row.planned.point.labels[LABEL],
        **figures_of(row, outputs),
    }  # fmt: skip


def figures_of(row: Any, outputs: Sequence[str]) -> dict[str, Any]:
    """Outputs of a case's row in SI, with its processor time and physics; NaN if it failed."""
    done = row.state == "done"
    values = {o: row.figures[o].value if done and o in row.figures else None for o in outputs}
    return {
        **{o: np.nan if v is None else float(v) for o, v in values.items()},
        SECONDS: row.seconds if done else np.nan,
        PHYSICS: row.origin.physics[:SHORT] if done else None,
    }  # fmt: skip


def read_starts(path: Path) -> Mapping[str, pd.DataFrame]:
    """Rows of ``starts.csv`` by reading."""
    if not path.is_file():
        return {}
    table = pd.read_csv(path, dtype={"reading": str, CONDITION: str, PHYSICS: str})
    if SECONDS not in table:
        return {}
    parts = table.groupby("reading", sort=False)
    return {str(name): part.drop(columns="reading") for name, part in parts}
