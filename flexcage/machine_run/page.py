"""The page of a machine's run: its figures, its pictures, and where its bearings' pages are."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory

from flexcage.core.errors import EnvironmentLacks
from flexcage.machine.whirl import over_speeds
from flexcage.machine.writing import draw_whole
from flexcage.machine_run.run import (
    OF_BEARINGS,
    OF_PLACES,
    BearingFigures,
    Column,
    MachineRun,
    PlaceFigures,
    shown,
)
from flexcage.report.blocks import (
    Block,
    Cell,
    Gallery,
    Image,
    Notices,
    Page,
    PageSection,
    PageTable,
    Prose,
    Text,
)
from flexcage.report.page import write_page

#: Pictures of a machine by file name, with captions, in the order in which they stand.
CAPTIONS = {
    "machine": "The machine at the last sample, elements coloured by load",
    "shaft": "The shaft's axis about its mean places, and its forces on the inner rings",
}
AT_REST = {
    "machine": "Static solution: loads, displacement, bending moment, stress",
    "whirl": "Natural frequencies over the speed, and the unbalance response",
}


def write_machine_page(run: MachineRun, path: str | Path) -> Path:
    """Write the page of a machine's run, one HTML file that needs no other; its path.

    Pictures that its folder lacks are drawn for it; where this computer cannot draw, the page says
    why.
    """
    with TemporaryDirectory() as spare:
        try:
            images, lacking = _pictures(run, Path(spare)), ""
        except EnvironmentLacks as exc:
            images, lacking = [], str(exc)
        return write_page(_page(run, images, lacking), path)


def _pictures(run: MachineRun, spare: Path) -> list[Image]:
    folder, found = run.folder, []
    draw = {"machine": run.draw_machine, "shaft": run.draw_shaft}
    for name, caption in CAPTIONS.items():
        stored = folder / "images" / f"{name}.png" if folder else spare
        picture = stored if stored.is_file() else draw[name](spare / f"{name}.png")
        found.append(Image(picture, caption, wide=True))
    return found + [Image(file, AT_REST[file.stem]) for file in _at_rest(run, spare)]


def _at_rest(run: MachineRun, spare: Path) -> list[Path]:
    """Pictures of the static solution: those that its folder holds, else drawn for the page."""
    stored = [run.folder / f"{name}.png" for name in AT_REST] if run.folder else []
    found = [file for file in stored if file.is_file()]
    if found or run.solution is None:
        return found
    (spare / "rest").mkdir()
    return draw_whole(
        run.machine, run.solution, over_speeds(run.machine, run.solution), spare / "rest"
    )


def _page(run: MachineRun, images: list[Image], lacking: str) -> Page:
    machine, summary = run.machine, run.summary
    shaft = machine.shaft
    names = ", ".join(
        f"{b.place.name} ({_designation(run, b.place.name)})" for b in machine.bearings
    )
    said = [
        f"A{'n elastic' if shaft.kind == 'elastic' else ' rigid'} shaft of "
        f"{1e3 * shaft.whole_length:.4g} mm in {len(machine.bearings)} bearings: {names}; "
        f"{machine.speed * 30.0 / pi:,.0f} rpm at the start.",
        f"The shaft's books miss {summary.missed:.1e} of what it exchanged.",
    ]
    drawn: Block = Gallery(images) if images else Notices([f"No pictures: {lacking}"])
    pages = [
        f"{name}: flexcage report {run.folder / name if run.folder else name}"
        for name in run.bearings
    ]
    sections = [
        PageSection("What was computed", [
            Prose([*([machine.description] if machine.description else []), *said]),
            Notices(list(summary.warnings), none="No warnings."),
        ]),
        PageSection("Bearings", [
            _table("bearing", summary.bearings, OF_BEARINGS,
                   "What the shaft presses inner rings with: means of the settled part, extremes, "
                   "and the static solution."),
            Text("Their own pages", "\n".join(pages), open=True),
        ]),
        PageSection("Shaft", [
            _table("place", summary.places, OF_PLACES,
                   "Means of the axis, and its largest distance from them across it."),
        ]),
        PageSection("Pictures", [drawn]),
        PageSection("How to reproduce", [Text("machine.toml", machine.to_toml())]),
    ]  # fmt: skip
    time = run.shaft["time"].values
    span = f"{1e3 * time[-1]:g} ms of motion, {len(time):,} samples"
    return Page(f"{machine.name}: report of a machine", span, sections)


def _designation(run: MachineRun, name: str) -> str:
    bearing = run[name].case.bearing
    return bearing.designation or bearing.kind


def _table(
    what: str, rows: Mapping[str, BearingFigures] | Mapping[str, PlaceFigures],
    columns: tuple[Column, ...], caption: str,
) -> PageTable:  # fmt: skip
    cells = [[Cell(name), *(_cell(c.of(row)) for c in columns)] for name, row in rows.items()]
    return PageTable([what, *(c.head for c in columns)], cells, caption)


def _cell(value: float) -> Cell:
    return Cell(shown(value), value)
