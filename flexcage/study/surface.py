"""A response surface over the axes of a study: its least value, where, and how sure.

Two models: a quadratic by least squares (``quadratic``) and Kriging with noise (``kriging``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.stats import qmc

from flexcage.core.digits import number_text, texts_with_margin
from flexcage.core.errors import InputError
from flexcage.results.export import frame_to_csv
from flexcage.study.kriging import Kriging, fit_kriging
from flexcage.study.quadratic import Quadratic, fit_quadratic
from flexcage.study.samples import Samples, samples_of

if TYPE_CHECKING:
    import pandas

    from flexcage.study.results import StudyResults

MODELS = ("quadratic", "kriging")
FLAT = 0.05  # probability by chance, above which a surface counts as flat within noise
_GRID = {1: 201, 2: 31, 3: 9}  # candidates an axis; beyond, a Sobol sequence of
_MANY = 1024
_ZOOMS = 3  # times that a region is looked at closer
_FEW = 40  # candidates in a region, below which it is
_POOR = 0.01  # probability of a lack of fit below which a quadratic is said not to fit


@dataclass(frozen=True, eq=False)
class Optimum:
    """Where a model's surface is best: place (d,), value and its half width, and the least box
    (2, d) round the region of confidence. ``inside`` (n,): which of the surface's places are in
    it. ``whole``: the region is the whole box, as the surface is flat within noise."""

    place: np.ndarray
    value: float
    half: float
    box: np.ndarray
    inside: np.ndarray
    whole: bool


@dataclass(frozen=True, eq=False)
class Surface:
    """Models through the samples of a study, each with its optimum on scaled ``places`` (n, d)."""

    samples: Samples
    highest: bool
    models: Mapping[str, Quadratic | Kriging]
    places: np.ndarray
    optima: Mapping[str, Optimum]

    def values(self, model: str) -> tuple[np.ndarray, np.ndarray]:
        """The model's surface and the half widths of its 95 % intervals (n,) at all places."""
        mean, half = self.models[model].mean(self.places), self.models[model].half(self.places)
        return self._sign * mean, half

    @property
    def _sign(self) -> float:
        return -1.0 if self.highest else 1.0

    @cached_property
    def frame(self) -> pandas.DataFrame:
        """One row a place: axes in the units of tables, and a model's value, half width of its
        interval and whether the optimum may be there."""
        import pandas as pd

        columns: dict[str, Any] = dict(
            zip(self.samples.titles, self.samples.unscaled(self.places).T)
        )
        title = f"{self.samples.output} [{self.samples.unit}]"
        for model, optimum in self.optima.items():
            mean, half = self.values(model)
            columns |= {f"{model}: {title}": mean, f"{model}: +- {title}": half}
            columns[f"{model}: optimum"] = optimum.inside
        return pd.DataFrame(columns)

    def write(self, folder: str | Path) -> list[Path]:
        """Write table and picture into a folder; their paths."""
        from flexcage.render.surface import surface_picture

        stem = "surface_" + "".join(c if c.isalnum() else "_" for c in self.samples.output)
        path = frame_to_csv(self.frame, Path(folder) / f"{stem}.csv")
        return [path, surface_picture(self, path.with_suffix(".png"))]

    def report(self) -> str:
        """Models and optima with their regions, as lines of text."""
        s, way = self.samples, "highest" if self.highest else "least"
        lines = [
            *s.cautions,
            f"{s.output} over {', '.join(s.titles)}: {len(s.y)} values at "
            f"{len(np.unique(s.x, axis=0))} points",
        ]
        for model, optimum in self.optima.items():
            lines += [f"\n{model}: {way} at {self._place(optimum)}", *self._about(model)]
            value, half = texts_with_margin(optimum.value, optimum.half)
            lines.append(f"  value there {value} ± {half or '-'} {s.unit}")
            if optimum.whole:
                lines.append("  flat within noise: the optimum may be anywhere")
                continue
            for title, (low, high) in zip(s.titles, optimum.box.T):
                lines.append(f"  95 % region: {title} {_short(low)} to {_short(high)}")
            share = 100.0 * optimum.inside.mean()
            known = f"{share:.2g} %" if share else f"less than {100.0 / len(self.places):.1g} %"
            lines.append(f"  it holds {known} of the box")
        return "\n".join(lines)

    def _place(self, optimum: Optimum) -> str:
        return ", ".join(f"{t} = {_short(v)}" for t, v in zip(self.samples.titles, optimum.place))

    def _about(self, model: str) -> list[str]:
        fit = self.models[model]
        scatter = f"  noise of one value: {number_text(fit.noise**0.5)} {self.samples.unit}"
        chance = f"  noise alone would look as uneven with p = {fit.level:.2g}"
        if isinstance(fit, Kriging):
            half = 0.5 * fit.lengths * (self.samples.high - self.samples.low)
            lines = [f"{scatter}; correlation lengths {', '.join(map(_short, half))}"]
            return [*lines, chance]
        lines = [scatter, chance]
        if fit.misfit < _POOR:
            lines.append(
                f"  it misses the points by more than their noise (p = {fit.misfit:.2g}): trust "
                "Kriging, or a smaller box"
            )
        return lines


def _short(value: float) -> str:
    return f"{value:.4g}"


def response_surface(
    results: StudyResults | str | Path,
    output: str,
    *,
    axes: Sequence[str] = (),
    where: Mapping[str, str] | None = None,
    highest: bool = False,
    models: Sequence[str] = MODELS,
) -> Surface:
    """Surfaces through an output of a finished study, which its folder may name; other arguments as
    in ``samples_of`` and ``surface_through``."""
    if isinstance(results, (str, Path)):
        from flexcage.study.results import StudyResults

        results = StudyResults(results)
    samples = samples_of(results, output, axes=axes, where=where)
    return surface_through(samples, highest=highest, models=models)


def surface_through(
    samples: Samples,
    *,
    highest: bool = False,
    models: Sequence[str] = MODELS,
) -> Surface:
    """Surfaces through samples and where they are least, or ``highest``."""
    for model in models:
        if model not in MODELS:
            raise InputError(
                f"There is no model '{model}'; choose from {', '.join(MODELS)}.", where="models"
            )
    y = -samples.y if highest else samples.y
    fits: dict[str, Quadratic | Kriging] = {}
    for model in models:
        fits[model] = (fit_quadratic if model == "quadratic" else fit_kriging)(samples.z, y)
    places = _grid(np.array([[-1.0], [1.0]]).repeat(len(samples.axes), axis=1))
    optima = {
        name: _optimum(fit, places, samples, -1.0 if highest else 1.0)
        for name, fit in fits.items()
    }  # fmt: skip
    return Surface(samples, highest, fits, places, optima)


def _grid(box: np.ndarray) -> np.ndarray:
    """Places (n, d) spread over a box (2, d)."""
    d = box.shape[1]
    if d in _GRID:
        steps = np.linspace(0.0, 1.0, _GRID[d])
        lines = np.meshgrid(*(low + steps * (high - low) for low, high in box.T), indexing="ij")
        return np.stack([line.ravel() for line in lines], axis=1)
    cube = qmc.Sobol(d, rng=0).random(_MANY)
    return np.asarray(box[0] + cube * (box[1] - box[0]))


def _optimum(
    fit: Quadratic | Kriging, places: np.ndarray, samples: Samples, sign: float
) -> Optimum:
    """The least value of a model, looked for ever closer, and the region that may hold it."""
    best = places[[np.argmin(fit.mean(places))]]
    whole = fit.level > FLAT
    inside = np.ones(len(places), bool) if whole else _inside(fit, places, best)
    region = np.vstack([places[inside], best])
    d = places.shape[1]
    step = np.full(d, 2.0 / (_GRID.get(d, 4) - 1))
    for _ in range(_ZOOMS):
        near = np.clip(np.array([best[0] - step, best[0] + step]), -1.0, 1.0)
        closer = _grid(near)
        best = np.vstack([best, closer])[[np.argmin(fit.mean(np.vstack([best, closer])))]]
        if len(region) < _FEW:
            box = np.array([region.min(axis=0) - step, region.max(axis=0) + step])
            fine = _grid(np.clip(box, -1.0, 1.0))
            region = np.vstack([fine[_inside(fit, fine, best, places)], best])
        step = 2.0 * step / (_GRID.get(d, 4) - 1)
    value, half = fit.mean(best)[0], fit.half(best)[0]
    box = np.array([region.min(axis=0), region.max(axis=0)])
    return Optimum(
        samples.unscaled(best)[0], float(sign * value), float(half),
        np.sort(samples.unscaled(box), axis=0), inside, whole,
    )  # fmt: skip


def _inside(
    fit: Quadratic | Kriging,
    places: np.ndarray,
    best: np.ndarray,
    others: np.ndarray | None = None,
) -> np.ndarray:
    """Which places (n, d) are in the region of confidence: the least among ``others`` as well."""
    if isinstance(fit, Kriging):
        among = places if others is None else np.vstack([places, others])
        return fit.least_in(among)[: len(places)]
    return fit.least_in(places, np.vstack([places if others is None else others, best]))
