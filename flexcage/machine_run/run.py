"""A machine's run: its bearings' runs, what happened to the shaft, and figures of both."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from flexcage._version import __version__
from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.listing import PAGE, aligned, wrapped
from flexcage.core.output_folders import SHAFT_STORE, holds_machine_run
from flexcage.core.timing import Stages
from flexcage.core.writing import write_text
from flexcage.machine.machine import Machine, load_machine
from flexcage.machine.solution import MachineSolution
from flexcage.machine.spec import BearingPlace
from flexcage.machine.whirl import over_speeds
from flexcage.machine.writing import MACHINE, draw_at_rest
from flexcage.machine_run.record import ShaftRecord, imbalance
from flexcage.results.metrics import settled
from flexcage.results.store import RunStore
from flexcage.run import Run
from flexcage.run.folder import kept, resume_command
from flexcage.simulate import load_run

SUMMARY = "machine_summary"
_SHARE = 1e-3  # of what the shaft exchanged, that its books may miss


@dataclass(frozen=True)
class BearingFigures:
    """Means and extremes of what the shaft presses a bearing with, in the machine's axes [N, N m],
    in the settled part, and the mean torque that turns its inner ring [N m]."""

    radial: float
    radial_largest: float
    axial: float
    axial_least: float
    axial_largest: float
    static_radial: float
    static_axial: float
    torque: float


@dataclass(frozen=True)
class PlaceFigures:
    """A place of the shaft [m]: mean displacement along x, y, z [m], and the largest distance from
    it across the axis [m]."""

    position: float
    x: float
    y: float
    z: float
    orbit: float


@dataclass(frozen=True)
class Column:
    """A column of a machine's tables: its head, and the figure and factor that it shows."""

    head: str
    name: str
    factor: float = 1.0

    def of(self, row: BearingFigures | PlaceFigures) -> float:
        """The number that it shows of a row."""
        return self.factor * float(getattr(row, self.name))


OF_BEARINGS = (
    Column("radial, N", "radial"), Column("largest, N", "radial_largest"),
    Column("static, N", "static_radial"), Column("axial, N", "axial"),
    Column("least, N", "axial_least"), Column("largest, N", "axial_largest"),
    Column("static, N", "static_axial"), Column("torque, N mm", "torque", 1e3),
)  # fmt: skip
OF_PLACES = (
    Column("at, mm", "position", 1e3), Column("x, um", "x", 1e6), Column("y, um", "y", 1e6),
    Column("z, um", "z", 1e6), Column("orbit, um", "orbit", 1e6),
)  # fmt: skip


def shown(value: float) -> str:
    """A number of a machine's tables; none is -0."""
    return f"{value + 0.0:.4g}"


def _rows(
    what: str, rows: Mapping[str, BearingFigures] | Mapping[str, PlaceFigures],
    columns: tuple[Column, ...],
) -> list[list[str]]:  # fmt: skip
    heads = [what, *(c.head for c in columns)]
    return [heads, *([name, *(shown(c.of(row)) for c in columns)] for name, row in rows.items())]


@dataclass(frozen=True, eq=False)
class MachineSummary:
    """Figures of a machine's run, SI."""

    bearings: Mapping[str, BearingFigures]
    places: Mapping[str, PlaceFigures]
    missed: float  # share of what the shaft exchanged, that its books miss
    steps: int
    warnings: tuple[str, ...]

    def text(self, width: int = 0) -> str:
        """Everything as text, in lines of at most ``width`` characters (0: as the terminal)."""
        bearings = _rows("bearing", self.bearings, OF_BEARINGS)
        places = _rows("place", self.places, OF_PLACES)
        parts = [
            wrapped("What the shaft presses the inner rings with: means of the settled part, "
                    "extremes, and the static solution", width=width)
            + "\n" + aligned(bearings, sides="lr", heads=True, width=width),
            wrapped("The shaft's axis: means, and the largest distance from them across it",
                    width=width)
            + "\n" + aligned(places, sides="lr", heads=True, width=width),
            wrapped(f"The shaft's books miss {self.missed:.1e} of what it exchanged; "
                    f"{self.steps:,} steps.", width=width),
        ]  # fmt: skip
        parts += [wrapped(f"Warning: {text}", width=width) for text in self.warnings]
        return "\n\n".join(parts)

    __str__ = text

    def to_dict(self) -> dict[str, Any]:
        """As nested tables of numbers, SI."""
        return {
            "flexcage": __version__,
            "bearings": {name: asdict(f) for name, f in self.bearings.items()},
            "places": {name: asdict(f) for name, f in self.places.items()},
            "shaft_books_miss": self.missed,
            "steps": self.steps,
            "warnings": list(self.warnings),
        }


class MachineRun:
    """A machine's simulation: ``bearings`` are runs by name (summary, stress, pictures as of any
    run), ``shaft`` is a dataset (xarray) of the shaft, ``summary`` has figures of both."""

    def __init__(
        self, machine: Machine, solution: MachineSolution | None, bearings: Mapping[str, Run],
        record: ShaftRecord, folder: Path | None, stages: Stages,
    ) -> None:  # fmt: skip
        self.machine, self.solution, self.bearings = machine, solution, dict(bearings)
        self.record, self.folder, self.stages = record, folder, stages

    def __getitem__(self, name: str) -> Run:
        """The run of the bearing of this name."""
        if name not in self.bearings:
            raise InputError(
                f"The machine has no bearing '{name}'; they are {', '.join(self.bearings)}.",
                where="bearings", value=name,
            )  # fmt: skip
        return self.bearings[name]

    @property
    def shaft(self) -> xr.Dataset:
        """What happened to the shaft (``record.ShaftRecord``)."""
        return self.record.dataset

    @cached_property
    def summary(self) -> MachineSummary:
        """Figures of shaft and bearings."""
        return summary_of(self)

    def finish(self) -> MachineRun:
        """Complete a run that has come to its end: its summary, stored beside the results."""
        if self.folder is not None:
            write_text(self.folder / f"{SUMMARY}.txt", self.summary.text(PAGE) + "\n")
            text = json.dumps(self.summary.to_dict(), indent=1)
            write_text(self.folder / f"{SUMMARY}.json", text + "\n")
        return self

    def draw(self, folder: str | Path, **look: Any) -> list[Path]:
        """Draw the machine, and the shaft's orbits and forces, into ``folder``, and each bearing's
        pictures into a folder there; those of the static solution go into the run's own folder.
        ``look`` as ``Run.draw`` takes it. Paths of the files."""
        into = path_of(folder, "folder")
        into.mkdir(parents=True, exist_ok=True)
        made = [self.draw_machine(into / "machine.png"), self.draw_shaft(into / "shaft.png")]
        if self.folder is not None and self.solution is not None:
            made += draw_at_rest(
                self.machine, self.solution, over_speeds(self.machine, self.solution), self.folder
            )
        for name, run in self.bearings.items():
            made += run.draw(into / name, **look)
        return made

    def draw_machine(self, path: str | Path, *, index: int = -1) -> Path:
        """Picture of the whole machine at a sample (default: the last), elements by load."""
        from flexcage.machine.writing import discs_drawn, sections_drawn
        from flexcage.render.machine_scene import BearingInPlace, machine_scene

        placed = []
        for seated in self.machine.bearings:
            run, place = self[seated.place.name], seated.place
            mesh = run.mesh
            points, tets = (None, None) if mesh is None else (mesh.points, mesh.tets)
            placed.append(
                BearingInPlace(
                    place.name, run.dataset, run.case.bearing, place.position,
                    place.reversed, points, tets,
                )
            )  # fmt: skip
        shaft = self.machine.shaft
        outline = sections_drawn(shaft, [b.bearing.bore for b in placed])
        discs = discs_drawn(shaft.discs, shaft.whole_length)
        return machine_scene(placed, outline, discs, path, index=index, title=self.machine.name)

    def draw_shaft(self, path: str | Path) -> Path:
        """Picture of the shaft's orbits at named places, and of its forces on the bearings."""
        from flexcage.render.machine_run_pictures import shaft_picture

        ds = self.record.settled(self.machine.output.settle)
        moved = ds["displacement"].sel(component=["y", "z"]).transpose("place", ...).values
        force = ds["force"].sel(component=["x", "y", "z"]).transpose("bearing", ...).values
        return shaft_picture(
            ds["time"].values, dict(zip(ds["place"].values.tolist(), moved)),
            dict(zip(ds["bearing"].values.tolist(), force)), path, title=self.machine.name,
        )  # fmt: skip


def summary_of(run: MachineRun) -> MachineSummary:
    """Figures of a machine's run."""
    settle = run.machine.output.settle
    ds = run.record.settled(settle)
    missed, exchanged = imbalance(run.record)
    share = missed / exchanged if exchanged > 0.0 else 0.0
    warnings = [
        f"bearing {name}: {warning.text}"
        for name, own in run.bearings.items()
        for warning in own.warnings
    ]
    if share > _SHARE:
        warnings.append(
            f"the shaft's books miss {share:.1e} of what it exchanged, more than {_SHARE:g}; "
            "tighten solver.tolerance."
        )
    own = next(iter(run.bearings.values())).summary_at_end  # of the run's one solver
    steps = own["steps"] if "steps" in own else None
    return MachineSummary(
        bearings={b.place.name: _of_bearing(run, ds, b.place) for b in run.machine.bearings},
        places={str(name): _of_place(ds, str(name)) for name in ds["place"].values},
        missed=share, steps=steps if isinstance(steps, int) else 0, warnings=tuple(warnings),
    )  # fmt: skip


def _of_bearing(run: MachineRun, ds: xr.Dataset, place: BearingPlace) -> BearingFigures:
    name = place.name
    force = ds["force"].sel(bearing=name).transpose("time", "component").values
    radial = np.hypot(force[:, 1], force[:, 2])
    borne = -run.solution[name].force if run.solution else np.full(5, np.nan)
    own = settled(run[name].dataset, run.machine.output.settle)
    held = own["multiplier"].sel(constraint="drive_torque").values
    return BearingFigures(
        radial=float(np.hypot(*force[:, 1:3].mean(axis=0))), radial_largest=float(radial.max()),
        axial=float(force[:, 0].mean()), axial_least=float(force[:, 0].min()),
        axial_largest=float(force[:, 0].max()),
        static_radial=float(np.hypot(borne[1], borne[2])), static_axial=float(borne[0]),
        torque=(-1.0 if place.reversed else 1.0) * float(held.mean()),
    )  # fmt: skip


def _of_place(ds: xr.Dataset, name: str) -> PlaceFigures:
    moved = ds["displacement"].sel(place=name).transpose("time", "component").values
    mean = moved.mean(axis=0)
    apart = np.hypot(*(moved[:, 1:3] - mean[1:3]).T)
    return PlaceFigures(
        position=float(ds["position"].sel(place=name)), x=float(mean[0]), y=float(mean[1]),
        z=float(mean[2]), orbit=float(apart.max()),
    )  # fmt: skip


def load_machine_run(folder: str | Path) -> MachineRun:
    """A machine's stored run, finished or not; its ``solution`` is None where a file that the
    machine names is gone. Raises InputError for a folder that holds none."""
    path = path_of(folder, "run")
    if not holds_machine_run(path):
        raise InputError(
            f"'{path}' is not the folder of a machine's run: it has no {SHAFT_STORE}; "
            "'flexcage run MACHINE' makes one.",
            where="run", value=str(path),
        )  # fmt: skip
    from flexcage.machine.motion import as_it_begins
    from flexcage.machine.solve import solve_machine

    store = RunStore.open(path / SHAFT_STORE)
    if store.n_time < 2:
        raise InputError(
            f"The machine's run in '{path}' holds fewer than two samples; "
            f"'{resume_command(path, MACHINE)}' goes on with it.",
            where="run", value=str(path),
        )  # fmt: skip
    machine = load_machine(kept(store, "machine"))  # as it was run, whatever its file says by now
    runs = {b.place.name: load_run(path / b.place.name) for b in machine.bearings}
    record = ShaftRecord.of(store)
    there = all(Path(file).is_file() for file in machine.files.values())
    solution = solve_machine(as_it_begins(machine)) if there else None
    return MachineRun(machine, solution, runs, record, path, Stages(None))
