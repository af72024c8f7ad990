"""One output of a finished study over its axes, as arrays that a surface is laid through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.binding import did_you_mean
from flexcage.core.errors import InputError

if TYPE_CHECKING:
    from flexcage.study.results import StudyResults


@dataclass(frozen=True, eq=False)
class Samples:
    """Values ``y`` (n,) [SI, ``unit``] of an output at ``x`` (n, d) in the units of tables."""

    output: str
    unit: str
    axes: tuple[str, ...]  # paths of the case
    titles: tuple[str, ...]  # with units
    x: np.ndarray
    y: np.ndarray
    cautions: tuple[str, ...] = ()

    @property
    def low(self) -> np.ndarray:
        return np.asarray(self.x.min(axis=0))

    @property
    def high(self) -> np.ndarray:
        return np.asarray(self.x.max(axis=0))

    @property
    def z(self) -> np.ndarray:
        """``x``, scaled to -1 ... 1 over its box."""
        return self.scaled(self.x)

    def scaled(self, x: np.ndarray) -> np.ndarray:
        return 2.0 * (x - self.low) / (self.high - self.low) - 1.0

    def unscaled(self, z: np.ndarray) -> np.ndarray:
        return self.low + 0.5 * (z + 1.0) * (self.high - self.low)


def samples_of(
    results: StudyResults,
    output: str,
    *,
    axes: Sequence[str] = (),
    where: Mapping[str, str] | None = None,
) -> Samples:
    """An output of a study over ``axes``, all that vary and are numbers if none are named, of the
    finished cases whose columns hold the texts that ``where`` gives by path or label."""
    if output not in results.titles:
        raise InputError(
            f"The study has no output '{output}'; "
            f"{did_you_mean(output, list(results.titles), 'its outputs are')}.",
            where="output",
            value=output,
        )
    names = {_path(title): title for title in results.axes_of(results.planned[0])}
    table = results.table
    table = table[(table["state"] == "done") & np.isfinite(table[results.titles[output]])]
    for name, value in (where or {}).items():
        table = _selected(table, _title_of(name, names), name, value)
    if table.empty:
        raise InputError(f"No finished case of the study has a value of '{output}'.", where="study")
    titles = _chosen(table, names, axes)
    return Samples(
        output, results.known[output].unit, tuple(map(_path, titles)), tuple(titles),
        table[titles].to_numpy(float), table[results.titles[output]].to_numpy(float),
        tuple(results.cautions()),
    )  # fmt: skip


def _path(title: str) -> str:
    return title.partition(" [")[0]


def _title_of(name: str, names: Mapping[str, str]) -> str:
    if name not in names:
        raise InputError(
            f"The study does not vary '{name}'; {did_you_mean(name, list(names), 'it varies')}.",
            where="axes",
            value=name,
        )
    return names[name]


def _selected(table: Any, title: str, name: str, value: str) -> Any:
    texts = table[title].map(_text)
    wanted = table[texts == value]
    if wanted.empty:
        known = list(dict.fromkeys(texts))
        raise InputError(
            f"No finished case has {name} = {value}; {did_you_mean(value, known, 'there are')}.",
            where=name,
            value=value,
        )
    return wanted


def _text(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _chosen(table: Any, names: Mapping[str, str], axes: Sequence[str]) -> list[str]:
    """Titles of the axes asked for, or of all that vary; what else varies raises InputError."""
    varied = {path: title for path, title in names.items() if table[title].nunique() > 1}
    numbers = {
        path: title for path, title in varied.items()
        if all(isinstance(v, (int, float, np.number)) and not isinstance(v, bool)
               for v in table[title])
    }  # fmt: skip
    titles = [_title_of(path, names) for path in axes] or list(numbers.values())
    for path in axes:
        if path not in numbers:
            what = "takes no numbers" if path in varied else "has one value only"
            raise InputError(f"The axis '{path}' {what} in these cases.", where="axes", value=path)
    own = table[titles]
    for path, title in varied.items():
        if title not in titles and not _follows(own, table[title]):
            raise InputError(
                f"'{path}' varies beside the surface's axes; choose one of its values with "
                f'--where "{path}={_text(table[title].iloc[0])}".',
                where="axes",
                value=path,
            )
    if not titles:
        raise InputError("No axis of the study that takes numbers varies.", where="axes")
    return titles


def _follows(own: Any, column: Any) -> bool:
    """Whether a column has one value for every combination of the axes'."""
    return int(column.groupby([own[c] for c in own.columns], observed=True).nunique().max()) == 1
