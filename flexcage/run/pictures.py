"""What pictures and the page show of a run, as values."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.case import description
from flexcage.core.writing import check_own
from flexcage.render import album
from flexcage.render.album import Scene, StressPictures
from flexcage.results import spectra
from flexcage.results.metrics import settled
from flexcage.run.rings import draw_rings, ring_pictures
from flexcage.stress.midpoints import at_nodes, largest_at_nodes
from flexcage.stress.series import ABOUT_PEAK
from flexcage.system.bodies import loads_over

if TYPE_CHECKING:
    from flexcage.render.look import Look
    from flexcage.report.run_page import RunAccount
    from flexcage.run.summarised import SummarisedRun


def picture_names_of(run: SummarisedRun) -> list[str]:
    """Names of the run's pictures."""
    part = settled(run.dataset, run.case.output.settle)
    names = album.picture_names(
        caged=run.case.cage is not None,
        flexible=run.cage is not None,
        resolved=spectra.resolves(part, run.numbers),
        rows=len(run.rows) if len(run.rows) > 1 else 0,
    )
    return [*names, *ring_pictures(run.case)]


def draw_pictures(
    run: SummarisedRun, folder: Path, *, animate: bool, look: Look, only: Sequence[str], format: str
) -> list[Path]:
    """Draw the run's pictures, or only some: paths of the files. InputError for a name that is
    none, before anything is computed."""
    run.store.check_there()
    if run.folder and folder.is_relative_to(run.folder):
        check_own(folder)
    album.check_names(only, [*picture_names_of(run), *(["stress"] if animate else [])])
    rings = [name for name in ring_pictures(run.case) if not only or name in only]
    paths: list[Path] = []
    if len(rings) < len(only) or not only:
        scene = scene_of(run, animate=animate, stress=album.need_stress(only))
        paths = album.draw_album(
            scene, folder, animate=animate, look=look, only=only, format=format,
            progress=run.stages.progress,
        )  # fmt: skip
    return [*paths, *draw_rings(run, folder, rings)] if rings else paths


def scene_of(run: SummarisedRun, *, animate: bool = False, stress: bool = True) -> Scene:
    """What pictures and reports show of the run; ``animate`` adds an animation's frames, and
    without ``stress`` that of a flexible cage is left out."""
    case, load, cage = run.case, run.case.load, run.case.cage
    radial, axial = loads_over(load, run.dataset["time"].values).T
    return Scene(
        name=case.name,
        dataset=run.dataset,
        bearing=run.bearing,
        mesh=run.mesh if cage else None,
        defects=case.defects,
        loads=np.stack(
            [axial, radial * np.cos(load.direction), radial * np.sin(load.direction)], axis=1
        ),
        clearance=case.land.clearance if cage and run.bearing.land(cage) else None,
        guide=cage.land_ring if cage else "",
        settle=case.output.settle,
        **_of_cages(run, animate=animate, stress=stress and run.cage is not None),
    )


def _of_cages(run: SummarisedRun, *, animate: bool, stress: bool) -> dict[str, Any]:
    """The stress of a scene's cage, or a scene for each row that has one."""
    if len(run.rows) > 1:
        return {"rows": [scene_of(row, animate=animate, stress=stress) for row in run.rows]}
    return {"stress": _stress_pictures(run, animate) if stress else None}


def _stress_pictures(run: SummarisedRun, animate: bool) -> StressPictures:
    history, peak = run.stress_history, run.stress()
    envelope = np.zeros(len(run.mesh.points))
    envelope[history.surface] = history.envelope
    assert run.cage is not None
    model, (nodes, cells) = run.cage.model, run.cage_stress.solid
    frames = []
    if animate:
        t = run.dataset["time"].values
        near = np.abs(t - peak.time) < ABOUT_PEAK
        for instant in t[near]:
            field = run.stress(time=instant)
            frames.append((field.time, field.displacement, at_nodes(model, field.stress)))
    return StressPictures(
        nodes=nodes,
        cells=cells,
        basis=run.cage.shown,
        time=peak.time,
        displacement=peak.displacement,
        von_mises=at_nodes(model, peak.stress),
        envelope=largest_at_nodes(model, envelope, history.edges, history.middles),
        peak_vertex=int(history.peak_vertex[history.peak_sample]),
        peak_place=run.cage_stress.peak_place,
        settled=history.settled,
        roots=history.places,
        root_names=history.place_names,
        root_kind=run.cage_stress.places.kind,
        frames=frames,
    )


def account_of(run: SummarisedRun, images: Sequence[Path], no_images: str) -> RunAccount:
    """What the run's page tells; ``no_images`` says why there are none."""
    from flexcage.report.run_page import RunAccount

    case = run.case
    command = description.run_command("case.toml")
    return RunAccount(
        scene=scene_of(run),
        summary=run.summary,
        numbers=run.numbers,
        statement=description.in_words(case),
        warnings=[warning.text for warning in run.warnings],
        steps=run.steps,
        settings=description.settings(case),
        assumptions=description.assumed(case),
        sources=description.grounds(case),
        case_text=case.to_toml(),
        commands=f"{command} -o runs/again\nflexcage report runs/again",
        images=images,
        no_images=no_images,
        folder=run.folder,
        hash=case.hash,
    )
