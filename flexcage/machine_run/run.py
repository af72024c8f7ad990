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
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.listing import PAGE, aligned, wrapped
from flexcage.core.timing import Stages
from flexcage.core.writing import write_text
from flexcage.machine.machine import Machine, load_machine
from flexcage.machine.solution import MachineSolution
from flexcage.machine_run.record import FILE, ShaftRecord, imbalance
from flexcage.run import Run
from flexcage.simulate import load_run
from flexcage.solve.contract import Effort

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
        heads = ["bearing", "radial, N", "largest", "static", "axial, N", "least", "largest",
                 "static", "torque, N mm"]  # fmt: skip
        rows = [heads] + [
            [name, *(f"{v + 0.0:.4g}" for v in (
                f.radial, f.radial_largest, f.static_radial, f.axial, f.axial_least,
                f.axial_largest, f.static_axial, 1e3 * f.torque))]
            for name, f in self.bearings.items()
        ]  # fmt: skip
        places = [["place", "at, mm", "x, um", "y, um", "z, um", "orbit, um"]] + [
            [name, *(f"{v + 0.0:.4g}" for v in (
                1e3 * f.position, 1e6 * f.x, 1e6 * f.y, 1e6 * f.z, 1e6 * f.orbit))]
            for name, f in self.places.items()
        ]  # fmt: skip
        parts = [
            wrapped("What the shaft presses the inner rings with: means of the settled part, "
                    "extremes, and the static solution", width=width)
            + "\n" + aligned(rows, sides="lr", heads=True, width=width),
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
        return summary_of(self, None)

    def finish(self, effort: Effort) -> MachineRun:
        """Complete a run that has come to its end: its summary, stored beside the results."""
        self.summary = summary_of(self, effort)
        if self.folder is not None:
            write_text(self.folder / f"{SUMMARY}.txt", self.summary.text(PAGE) + "\n")
            text = json.dumps(self.summary.to_dict(), indent=1)
            write_text(self.folder / f"{SUMMARY}.json", text + "\n")
        return self

    def draw(self, folder: str | Path, **look: Any) -> list[Path]:
        """Draw the machine, and the shaft's orbits and forces, into ``folder``, and each bearing's
        pictures into a folder there; ``look`` as ``Run.draw`` takes it. Paths of the files."""
        into = path_of(folder, "folder")
        into.mkdir(parents=True, exist_ok=True)
        made = [self.draw_machine(into / "machine.png"), self.draw_shaft(into / "shaft.png")]
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
                    place.facing == "-x", points, tets,
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


def summary_of(run: MachineRun, effort: Effort | None) -> MachineSummary:
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
    steps = effort.counts["steps"] if effort else 0
    return MachineSummary(
        bearings={name: _of_bearing(run, ds, name) for name in run.bearings},
        places={str(name): _of_place(ds, str(name)) for name in ds["place"].values},
        missed=share, steps=steps, warnings=tuple(warnings),
    )  # fmt: skip


def _of_bearing(run: MachineRun, ds: xr.Dataset, name: str) -> BearingFigures:
    force = ds["force"].sel(bearing=name).transpose("time", "component").values
    radial = np.hypot(force[:, 1], force[:, 2])
    borne = -run.solution[name].force if run.solution else np.full(5, np.nan)
    held = run[name].dataset["multiplier"].sel(constraint="drive_torque").values
    turned = (
        -1.0 if run.machine.bearings[list(run.bearings).index(name)].place.facing == "-x" else 1
    )
    settled = held[int(len(held) * run.machine.output.settle) :]
    return BearingFigures(
        radial=float(np.hypot(*force[:, 1:3].mean(axis=0))), radial_largest=float(radial.max()),
        axial=float(force[:, 0].mean()), axial_least=float(force[:, 0].min()),
        axial_largest=float(force[:, 0].max()),
        static_radial=float(np.hypot(borne[1], borne[2])), static_axial=float(borne[0]),
        torque=turned * float(settled.mean()),
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
    """A machine's stored run. Raises InputError for a folder that holds none."""
    path = path_of(folder, "run")
    if not (path / FILE).is_file() or not (path / "machine.toml").is_file():
        raise InputError(
            f"'{path}' is not the folder of a machine's run: it has no {FILE}; 'flexcage run "
            "MACHINE' makes one.",
            where="run", value=str(path),
        )  # fmt: skip
    from flexcage.machine.motion import as_it_begins
    from flexcage.machine.solve import solve_machine

    machine = load_machine(path / "machine.toml")
    runs = {b.place.name: load_run(path / b.place.name) for b in machine.bearings}
    record = ShaftRecord.read(path)
    return MachineRun(
        machine, solve_machine(as_it_begins(machine)), runs, record, path, Stages(None)
    )


def draw_or_say(run: MachineRun, folder: Path, **look: Any) -> str:
    """Draw a run's pictures; why not, in words, where this computer cannot draw."""
    try:
        run.draw(folder, **look)
    except EnvironmentLacks as exc:
        return str(exc)
    return ""
