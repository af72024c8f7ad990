"""The files of a machine's static solution."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from math import atan2, hypot, isfinite, pi
from pathlib import Path

import numpy as np

from flexcage.case import StaticCase
from flexcage.core.errors import pictures_alone
from flexcage.core.listing import PAGE
from flexcage.core.writing import write_text
from flexcage.machine.machine import Machine
from flexcage.machine.solution import BearingResult, MachineSolution
from flexcage.machine.spec import Disc, Shaft
from flexcage.machine.state import without_rounding
from flexcage.machine.whirl import Whirls, over_speeds
from flexcage.static import draw_static, write_static_numbers

log = logging.getLogger(__name__)

MACHINE = "machine.toml"
OURS = (MACHINE, "machine.json")
_FLAT = 0.15  # of its diameter: width of a disc that has none


def write_machine(machine: Machine, solution: MachineSolution, folder: Path) -> list[Path]:
    """Write machine.toml, machine.txt, machine.json, whirl.csv and pictures into a folder, and
    for every bearing a folder of its own with its static solution; their paths.

    A computer that cannot draw costs the pictures alone.
    """
    whirls = over_speeds(machine, solution)
    written = write_numbers(machine, solution, whirls, folder)
    with pictures_alone(log):
        written += draw_at_rest(machine, solution, whirls, folder)
    return written


def write_numbers(
    machine: Machine, solution: MachineSolution, whirls: Whirls | None, folder: Path
) -> list[Path]:
    """What ``write_machine`` writes, but for pictures; ``whirls`` are those of ``over_speeds``."""
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / "machine.toml", machine.to_toml())
    write_text(folder / "machine.txt", solution.table(PAGE) + "\n")
    solution.to_json(folder / "machine.json")
    written = [folder / name for name in ("machine.toml", "machine.txt", "machine.json")]
    for case, own in _loaded(machine, solution):
        written += write_static_numbers(case, own.solution, folder / own.name)
    if whirls is not None:
        write_text(folder / "whirl.csv", _as_csv(*whirls))
        written.append(folder / "whirl.csv")
    return written


def draw_at_rest(
    machine: Machine, solution: MachineSolution, whirls: Whirls | None, folder: Path
) -> list[Path]:
    """Draw machine.png and whirl.png into a folder, and every bearing's static.png into its own."""
    made = draw_whole(machine, solution, whirls, folder)
    for case, own in _loaded(machine, solution):
        made += draw_static(case, own.solution, folder / own.name)
    return made


def _loaded(
    machine: Machine, solution: MachineSolution
) -> Iterator[tuple[StaticCase, BearingResult]]:
    for seated, own in zip(machine.bearings, solution.bearings):
        yield as_loaded(seated.case, own.solution.load), own


def as_loaded(case: StaticCase, load: np.ndarray) -> StaticCase:
    """A bearing's case under the load (5,) that it bears in the machine, in its own axes, so that
    it can be solved alone."""
    x, y, z, about_y, about_z = map(float, without_rounding(load))
    return case.replace({
        "load.axial": x, "load.radial": hypot(y, z), "load.direction": atan2(z, y),
        "load.moment_y": about_y, "load.moment_z": about_z, "load.tilt": "free",
    })  # fmt: skip


def _as_csv(
    speeds: np.ndarray, found: list[tuple[np.ndarray, list[str]]], amplitudes: np.ndarray
) -> str:
    count = max(len(f) for f, _ in found)
    heads = [f"{what}_{k + 1}{unit}" for k in range(count)
             for what, unit in (("frequency", "_Hz"), ("whirl", ""))]  # fmt: skip
    lines = [",".join(["speed_rpm", *heads, "largest_orbit_um"])]
    for w, (frequencies, ways), orbit in zip(speeds, found, amplitudes):
        cells = [f"{w * 30.0 / pi:.6g}"]
        for f, way in zip(frequencies, ways):
            cells += [f"{f / (2.0 * pi):.8g}", way]
        cells += [""] * (2 * count - 2 * len(ways)) + [
            f"{1e6 * orbit:.6g}" if isfinite(orbit) else ""
        ]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def draw_whole(
    machine: Machine, solution: MachineSolution, whirls: Whirls | None, folder: Path
) -> list[Path]:
    """Draw machine.png and, of a shaft with mass that turns, whirl.png into a folder."""
    from flexcage.render.machine_pictures import whirl_picture

    made = [draw_machine(machine, solution, folder / "machine.png")]
    if whirls is not None:
        speed = f"{solution.speed * 30.0 / pi:.5g} rpm"
        anew = machine.whirl.stiffness == "each_speed"
        note = f"bearings' stiffness at the machine's load and {'each speed' if anew else speed}"
        made.append(whirl_picture(*whirls, folder / "whirl.png", title=f"{machine.name}: whirl",
                                  note=note, speed=solution.speed))  # fmt: skip
    return made


def draw_machine(machine: Machine, solution: MachineSolution, path: str | Path) -> Path:
    """Picture of the shaft in its bearings: loads, displacement, bending moment, stress."""
    from flexcage.render.machine_pictures import (
        Drawn,
        ShaftCurves,
        ShaftDrawing,
        machine_picture,
    )

    shaft, sections = machine.shaft, solution.sections
    bearings = []
    for seated, own in zip(machine.bearings, solution.bearings):
        b, place = seated.case.bearing, seated.place
        one_way = bool(getattr(b, "one_sided", False)) or sum(getattr(b, "carried", ())) == 1
        faces = (1 if place.facing == "+x" else -1) if one_way else 0
        bearings.append(Drawn(own.name, own.position, b.bore, b.outside_diameter, b.width, faces,
                              place.floats, own.force[:3]))  # fmt: skip
    drawing = ShaftDrawing(
        sections_drawn(shaft, [b.bore for b in bearings]), bearings,
        discs_drawn(shaft.discs, shaft.whole_length),
        [(p.position, np.array(p.force)) for p in shaft.loads],
    )  # fmt: skip
    curves = ShaftCurves(
        solution.position, solution.displacement[:, 1:3], sections.position,
        sections.force[:, 3:], sections.stress,
    )  # fmt: skip
    small = 1e-6 * max(float(np.abs(b.force[:3]).max()) for b in solution.bearings)
    note = f"{solution.speed * 30.0 / pi:.5g} rpm   ·   " + "   ·   ".join(
        f"{b.name}: {b.radial:.4g} N radially, {axial if abs(axial) > small else 0.0:.4g} N along x"
        for b in solution.bearings
        for axial in (float(b.force[0]),)
    )
    return machine_picture(drawing, curves, path, title=machine.name, note=note)


def sections_drawn(shaft: Shaft, bores: Sequence[float]) -> np.ndarray:
    """Begin, end, outside and inside diameter (k, 4) [m] of a shaft's sections; of one without, as
    thick as the smallest of the bearings' ``bores``."""
    if not shaft.sections:
        return np.array([[0.0, shaft.whole_length, min(bores), 0.0]])
    ends = np.concatenate([[0.0], np.cumsum([s.length for s in shaft.sections])])
    return np.array([
        (a, b, s.diameter, s.bore) for a, b, s in zip(ends, ends[1:], shaft.sections)
    ])  # fmt: skip


def discs_drawn(discs: tuple[Disc, ...], length: float) -> np.ndarray:
    """Place, diameter and width (k, 3) [m]; those of a disc by mass as its inertia has them."""
    rows = []
    for disc in discs:
        mass, polar, _ = disc.inertia
        diameter = disc.diameter or (2.0 * np.sqrt(2.0 * polar / mass) if mass and polar else 0.0)
        diameter = diameter or 0.2 * length
        rows.append((disc.position, diameter, disc.width or _FLAT * diameter))
    return np.array(rows).reshape(-1, 3)
