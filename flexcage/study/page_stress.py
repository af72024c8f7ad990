"""The stress of some cases of a study: which, their fields, and pictures that can be compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.case.extensions import not_loaded
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.progress import Silent
from flexcage.report.blocks import Image
from flexcage.report.cage_view import CageStress, common_limit
from flexcage.report.run_page import cage_stress
from flexcage.simulate import load_run
from flexcage.study.page_tables import point_names, stored_figure
from flexcage.study.spec import uses

if TYPE_CHECKING:
    from flexcage.study.record import ResultRow, StudyRecord

MOST = 6  # points whose stress is shown


@dataclass(frozen=True)
class Shown:
    """A case whose stress is shown, and where its picture looks."""

    cage: CageStress
    caption: str
    peak_place: str


def to_show(results: StudyRecord, points: Sequence[int] | None) -> tuple[list[ResultRow], str]:
    """First finished case with stress of the points to show, and a sentence on the choice."""
    done = [row for row in results.rows if row.state == "done"]
    kept_runs = [row for row in done if results.folder.has_run(row.planned.hash)]
    if done and not kept_runs:
        if points is not None:
            raise InputError("The study kept figures only, so no point's stress can be shown.")
        return [], "The study kept figures only, so no stress can be shown."
    able: dict[int, ResultRow] = {}
    for row in kept_runs:
        if stored_figure(results, row, "mode_count") is not None:  # a flexible cage
            able.setdefault(row.planned.number, row)
    if points is not None:
        missing = [p for p in points if p not in able]
        if missing:
            raise InputError(
                f"Point {missing[0]} has no kept run with a flexible cage; choose from "
                f"{', '.join(map(str, able)) or 'none'}.",
                where="points",
                value=missing[0],
            )
        return [able[p] for p in points], ""
    if not able:
        return [], "No kept run has a flexible cage, so there is no stress to show."
    numbers = list(able)
    if len(numbers) <= MOST:
        return list(able.values()), "Shown is the first kept run of every point with stress."
    spread = sorted({numbers[round(k)] for k in np.linspace(0, len(numbers) - 1, MOST)})
    return [able[p] for p in spread], (
        f"Shown are {len(spread)} of the {len(numbers)} points with stress, evenly spread, the "
        "first kept run of each; --points chooses others."
    )


def stress_of(
    results: StudyRecord, rows: list[ResultRow], progress: Callable[..., Any] | None
) -> tuple[list[Shown], str]:
    """Stress of these cases; a sentence on why there is none, if they need files of the user's own
    that are not loaded."""
    names, found = point_names(results), []
    shown = progress if progress and rows else Silent
    with shown(len(rows), "stress") as bar:
        for row in rows:
            try:
                scene = load_run(results.folder.case(row.planned.hash)).scene()
            except InputError:
                lacking = not_loaded(results.about.use)
                if not lacking:
                    raise
                return [], f"No stress is shown: the cases need {uses(lacking)}."
            scene = scene.first
            assert scene.stress is not None
            name = f"Point {row.planned.number}: {names[row.planned.number]}"
            cage = cage_stress(scene, scene.stress, name)
            found.append(Shown(cage, name, scene.stress.peak_place))
            bar.advance()
    return found, ""


def common_scale(cages: Sequence[Shown]) -> float:
    """Factor of deformation that suits all."""
    from flexcage.render.stress_pictures import nice_scale

    return min((nice_scale(s.cage.points, s.cage.displacement) for s in cages), default=1.0)


def stress_images(cages: Sequence[Shown], folder: Path) -> tuple[list[Image], str]:
    """Stress of the cases, drawn alike, and why there is no picture."""
    from flexcage.render.stress_pictures import stress_picture

    if not cages:
        return [], ""
    limit, _ = common_limit([shown.cage for shown in cages])
    scale, images = common_scale(cages), []
    for k, shown in enumerate(cages):
        cage = shown.cage
        try:
            path = stress_picture(
                cage.points, cage.tets, cage.displacement, cage.von_mises, folder / f"{k}.png",
                scale=scale, time=cage.time, note=shown.caption, peak_label=shown.peak_place,
                peak_node=cage.peak_vertex, pocket_count=cage.pocket_count,
                limit=limit,
            )  # fmt: skip
        except EnvironmentLacks as exc:
            return [], f"No pictures: {exc}"
        peak = f"{cage.von_mises[cage.peak_vertex] / 1e6:.3g} MPa"
        where = f" in {shown.peak_place}" if shown.peak_place else ""
        images.append(Image(path, f"{shown.caption}. Peak {peak}{where}, same colours in all."))
    return images, ""
