"""The page of one run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flexcage.mesh.rows import rows_in
from flexcage.render.album import Scene
from flexcage.report.blocks import (
    Block,
    Charts,
    Gallery,
    Image,
    Notices,
    Page,
    PageSection,
    Prose,
    SideBySide,
    Text,
    Tile,
    Tiles,
)
from flexcage.report.cage_view import CageStress, cage_chart
from flexcage.report.extras import extra_figures
from flexcage.report.histories import history_charts, imbalance_chart, step_chart
from flexcage.report.tables import (
    assumption_table,
    mapping_table,
    rows_table,
    summary_table,
    typeset,
)
from flexcage.results import metrics
from flexcage.results.figures.figure import LARGE, STATISTIC
from flexcage.results.figures.own import own_figures
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.row import SHOWN, SummaryRow
from flexcage.results.slip import BearingNumbers
from flexcage.results.summary import Summary

if TYPE_CHECKING:
    from flexcage.render.album import StressPictures

#: Sections of a summary that have their own place.
_OWN_PLACE = _ENERGY, _SOLVER, _TIMES = tuple(
    FIGURES[key].section for key in ("energy_audit", "steps", "wall_total")
)
#: Pictures that the page shows as charts.
_CHARTS = ("stress_peak", "histories", "orbit")
_LEADING = ("stress_peak", "bearing", "mesh")  # pictures, one of which is on the first screen
_WIDE = ("spectra",)  # pictures with fine print
#: Pictures of a run by file name: their captions ({elements}: rollers or balls), in the order in
#: which they stand.
CAPTIONS = {
    "stress_peak": "Stress at the instant of its peak, on the deformed cage",
    "stress_pocket": "The pocket of that peak with its rolling element, deformed in scale",
    "stress_envelope": "Largest stress of every place over the settled part",
    "deformation": "Elastic deformation at the same instant",
    "mesh": "Mesh, with defects marked",
    "modes": "Mode shapes and frequencies",
    "bearing": "Bearing at that instant, {elements} coloured by load",
    "orbit": "Orbit of the cage's centre",
    "histories": "Histories",
    "spectra": "Spectra, with the bearing's frequencies",
}


@dataclass(frozen=True, kw_only=True)
class RunAccount:
    """What the page of a run tells, as values."""

    scene: Scene
    summary: Summary
    numbers: BearingNumbers
    statement: Sequence[str]  # what was computed, in words
    warnings: Sequence[str]
    steps: Mapping[str, np.ndarray]  # the solver's: time, step [s]
    settings: Mapping[str, str]  # of the solver and the model
    assumptions: Mapping[str, tuple[str, str]]  # by path: a value, and the reason for it
    sources: Mapping[str, str]
    case_text: str  # case.toml
    commands: str  # that compute the run anew
    images: Sequence[Path] = ()
    no_images: str = ""  # why there are none
    folder: Path | None = None
    hash: str = field(default="")


def run_page(account: RunAccount) -> Page:
    """The page: what was computed and its figures first, how to repeat it last."""
    sections = [
        PageSection("What was computed", [_statement(account)]),
        PageSection("Warnings", [Notices(account.warnings, none="None.")]),
        _figures(account),
        *_stress(account),
        PageSection(
            "Histories", [Charts(history_charts(account.scene, account.numbers)), _THINNED]
        ),
        _pictures(account),
        *_extras(account),
        _energy(account),
        _solver(account),
        _grounds(account),
        PageSection("How to reproduce", [
            Text("Commands", account.commands, open=True), Text("case.toml", account.case_text),
        ]),
    ]  # fmt: skip
    ds = account.scene.dataset
    span = f"{float(ds['time'][-1]) * 1e3:g} ms of motion, {ds.sizes['time']:,} samples"
    return Page(f"{account.scene.name}: report of a run", f"{span}; case {account.hash}", sections)


_THINNED = Prose(
    ["Shaded: left out of statistics. Curves are thinned to what a screen can show; the least and "
     "the largest value of every stretch are kept, so no peak is lost."]
)  # fmt: skip


def _statement(account: RunAccount) -> Block:
    """What was computed, beside the first picture that there is."""
    prose = Prose(account.statement)
    return SideBySide(prose, first[0]) if (first := _leading(account)) else prose


def _leading(account: RunAccount) -> list[Image]:
    """The picture of the first screen, if there is any."""
    return _named(account, *_LEADING)[:1]


def _figures(account: RunAccount) -> PageSection:
    large = marked(LARGE)
    tiles = [_tile(row) for row in account.summary if row.key in large]
    kept = [s for s in account.summary.sections if s.title not in _OWN_PLACE]
    note = (
        "± is half of a 95 % interval. Figures without ± are counts, values of one instant, or "
        "means of too few passes; – is not known. A click on a heading sorts."
    )
    return PageSection("Key figures", [Tiles(tiles), summary_table(kept, note, fold="All figures")])


def _tile(row: SummaryRow) -> Tile:
    margin = row.margin_text
    if isinstance(row.value, str) or row.text == "-":
        return Tile(row.label, row.text.replace("-", "–"), row.note)
    value = row.text if margin else _rounded(row)
    note = ", ".join(filter(None, (margin, row.brief_note))) if margin else _without_margin(row)
    return Tile(row.label, f"{value} {typeset(row.shown)}".strip(), note)


def _rounded(row: SummaryRow) -> str:
    """A figure whose margin is not known: three digits, and all before the point."""
    value = float(row.value or 0.0) * SHOWN[row.shown][1]
    return f"{value:,.0f}" if abs(value) >= 100.0 else f"{value:#.3g}".removesuffix(".")


def _without_margin(row: SummaryRow) -> str:
    """Why a figure has no ±; of a user's own, its note."""
    if row.key in own_figures():
        return row.brief_note
    if STATISTIC in FIGURES[row.key].marks:
        return "± not known: the run is too short"
    return "one instant"


def cage_stress(scene: Scene, stress: StressPictures, name: str = "") -> CageStress:
    """What the 3D view needs of a run."""
    assert scene.mesh is not None, "stress is that of a cage"
    return CageStress(
        name, stress.nodes, stress.cells, stress.displacement, stress.von_mises, stress.time,
        stress.peak_vertex, scene.mesh.pocket_count, rows_in(scene.mesh.info),
    )  # fmt: skip


def _stress(account: RunAccount) -> list[PageSection]:
    from flexcage.render.stress_pictures import nice_scale

    stress, mesh = account.scene.stress, account.scene.mesh
    if mesh is None:
        return []
    if stress is None:
        none = Prose(["The cage of this run is rigid: it has no stress."])
        return [PageSection("Stress in the cage", [none])]
    cage = cage_stress(account.scene, stress)
    scale = nice_scale(cage.points, cage.displacement)
    title = f"Equivalent stress at its peak, t = {stress.time * 1e3:.3f} ms"
    blocks: list[Block] = [cage_chart([cage], scale=scale, title=title)]
    pictures = _named(account, "stress_envelope")
    return [
        PageSection("Stress in the cage", [*blocks, *([Gallery(pictures)] if pictures else [])])
    ]


def _named(account: RunAccount, *names: str) -> list[Image]:
    found = {path.stem: path for path in account.images}
    return [Image(found[n], _caption(account, n), wide=n in _WIDE) for n in names if n in found]


def _caption(account: RunAccount, name: str) -> str:
    elements = f"{metrics.element(account.scene.dataset)}s"
    return CAPTIONS[name].format(elements=elements) if name in CAPTIONS else name


def _pictures(account: RunAccount) -> PageSection:
    known = [name for name in CAPTIONS if name not in (*_CHARTS, "stress_envelope")]
    own = sorted({path.stem for path in account.images} - set(CAPTIONS))
    leading = _leading(account)
    images = [image for image in _named(account, *known, *own) if image not in leading]
    if not images and not leading:
        return PageSection(
            "Pictures", [Notices([f"No pictures: {account.no_images or 'none found'}"])]
        )
    return PageSection(
        "Pictures", [Gallery(images), Prose(["A click shows a picture in full size."])]
    )


def _extras(account: RunAccount) -> list[PageSection]:
    found = extra_figures(account.folder) if account.folder else None
    return [found] if found else []


def _energy(account: RunAccount) -> PageSection:
    rows = [row for section in _sections(account, _ENERGY) for row in section.shown]
    blocks: list[Block] = [rows_table(rows)]
    if {"energy", "work"} <= set(account.scene.dataset.data_vars):
        blocks.append(Charts([imbalance_chart(account.scene.dataset)]))
    return PageSection(FIGURES["energy_audit"].title, blocks)


def _sections(account: RunAccount, *titles: str) -> list:
    return [s for s in account.summary.sections if s.title in titles]


def _solver(account: RunAccount) -> PageSection:
    blocks: list[Block] = [
        rows_table(section.shown, section.title) for section in _sections(account, _SOLVER, _TIMES)
    ]
    if len(account.steps.get("time", ())):
        blocks.append(Charts([step_chart(account.steps["time"], account.steps["step"])]))
    blocks.append(mapping_table(("path in the case", "value"), account.settings, fold="Settings"))
    return PageSection("Solver and model", blocks)


def _grounds(account: RunAccount) -> PageSection:
    return PageSection("Assumptions and sources", [
        assumption_table(account.assumptions, fold="Values that no source gives"),
        mapping_table(("source", "what it gave"), account.sources, "Sources"),
    ])  # fmt: skip
