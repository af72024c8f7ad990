"""Tables of a paper's folder: what its runs gave, from which pages are redrawn and runs go on.

``settings_<map>.csv`` has a row a run of a map, ``starts.csv`` one a run of a reading: outputs in
SI to seven digits, empty where a run failed; processor time [s]; and the physics that computed it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from flexcage.study import Map, MapResults
from flexcage.study.maps import CONDITION as LABEL
from flexcage.study.maps import SAMPLE

SETTING, START, CONDITION, SECONDS, PHYSICS = "setting", "start", "condition", "seconds", "physics"
KEYS = [SETTING, START, CONDITION]
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
        front = [*KEYS, *shares.columns]
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
    table = pd.read_csv(path, dtype={CONDITION: str, PHYSICS: str})
    names = _columns(spec)
    needed = {*KEYS, SECONDS, PHYSICS, *names, *spec.outputs}
    if not needed <= set(table) or not _same(table, spec, names):
        print(f"{path.name} is of other settings or outputs: its runs are computed anew")
        return empty(spec)
    known = table[CONDITION].isin([str(c["label"]) for c in spec.conditions])
    return Settings(spec, table[known].drop(columns=names))


def _columns(spec: Map) -> list[str]:
    return [f"share of {name}" for name in spec.names[:-1]]


def _same(table: pd.DataFrame, spec: Map, names: Sequence[str]) -> bool:
    """Whether the table's settings are those of the map's design."""
    if len(table) and (table[SETTING].max() >= len(spec.shares) or table[START].max() >=
                       spec.starts):  # fmt: skip
        return False
    shares = spec.shares[table[SETTING].to_numpy(int), :-1]
    return bool(np.allclose(table[names].to_numpy(float), shares, atol=1e-4))


def settings_of(found: MapResults, spec: Map) -> Settings:
    """Runs that a map's folder holds, done or failed."""
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
    return dict(tuple(table.groupby("reading", sort=False))) if SECONDS in table else {}
