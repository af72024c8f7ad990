"""What the paper plots, from the runs that the study kept: histories, orbits, stress images."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from n1013_pinch import CLAIMED, DISPLACEMENT, PinchMap
from n1013_view import AFTER, AT, BASE, BEFORE, CAGES, Rows

import flexcage
from flexcage import Run, StudyResults
from flexcage.render import sheet
from flexcage.render.stress_pictures import nice_scale, stress_picture
from flexcage.results import metrics

RPM = 30.0 / pi
NAMES = {
    "sound": "sound cage",
    "dq +0.1": "crossbeam moved by 0.1 mm",
    "dq +0.2": "crossbeam moved by 0.2 mm",
    "dp +0.3": "pocket 0.3 mm longer",
    "dp -0.3": "pocket 0.3 mm shorter",
}
_EDGE, _TOP, _WIDTH, _HEIGHT, _GAP = 120, 118, 1400, 170, 44

Draw = Callable[[Any, Run], None]


def draw(results: StudyResults, rows: Rows, squeezed: PinchMap, folder: Path) -> list[Path]:
    """Every figure of the base runs that were kept, with ``captions.json`` beside them."""
    runs = base_runs(results, rows)
    captions: dict[str, str] = {"pinch.png": _CAPTION_PINCH}
    paths = [pinch_picture(squeezed, folder / "pinch.png")]
    if runs:
        for name, curve in HISTORIES.items():
            path = folder / f"{name}.png"
            paths.append(_histories(runs, curve, path))
            captions[path.name] = curve.caption
        paths.append(orbits(runs, folder / "orbits.png"))
        captions["orbits.png"] = (
            "Orbit of the cage centre after settling, every cage, relative to the outer ring."
        )
        for cage, run in runs.items():
            path = folder / f"stress_{slug(cage)}.png"
            paths.append(_stress_image(run, cage, path))
            captions[path.name] = f"Equivalent stress at its largest after settling: {NAMES[cage]}."
    (folder / "captions.json").write_text(
        json.dumps(captions, indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
    return paths


def slug(cage: str) -> str:
    """The cage's name as a file's."""
    return cage.replace(" +", "_plus_").replace(" -", "_minus_").replace(".", "")


def base_runs(results: StudyResults, rows: Rows) -> dict[str, Run]:
    """The first kept run of every cage at the base clearances."""
    found = {}
    for cage in CAGES:
        for row in rows.get((cage, BASE), ()):
            folder = results.folder.case(row.planned.hash)
            if cage not in found and (folder / "results.zarr").is_dir():
                found[cage] = flexcage.load_run(folder)
    return found


def _settled(run: Run) -> Any:
    return metrics.settled(run.dataset, run.case.output.settle)


def _histories(runs: Mapping[str, Run], curve: Curve, path: Path) -> Path:
    """One panel a cage, one below the other."""
    with sheet.style():
        height = _TOP + len(runs) * (_HEIGHT + _GAP) + 50
        figure = sheet.new_figure(_EDGE + _WIDTH + 50, height)
        scales = "" if curve.shared else "every panel has its own scale"
        facts = ["6000 rpm, 1000 N", "shaded: left out of statistics", scales]
        sheet.heading(figure, curve.title, sheet.join(facts))
        axes = []
        for i, (cage, run) in enumerate(runs.items()):
            top = _TOP + i * (_HEIGHT + _GAP)
            ax = sheet.axes_at(figure, (_EDGE, top, _WIDTH, _HEIGHT))
            curve.panel(ax, run)
            end = 1e3 * run.case.solver.duration
            ax.axvspan(0.0, run.case.output.settle * end, color="#eeeeee", zorder=0, lw=0)
            ax.set_title(_name(cage), loc="left", weight="bold")
            ax.yaxis.set_label_coords(-78 / _WIDTH, 0.5)
            ax.set_ylabel(curve.label)
            if i == 0 and ax.get_legend_handles_labels()[1]:
                ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)
            axes.append(ax)
        low = min(ax.get_ylim()[0] for ax in axes)
        high = max(ax.get_ylim()[1] for ax in axes)
        longest = max(1e3 * run.case.solver.duration for run in runs.values())
        for ax in axes:
            if curve.shared:
                ax.set_ylim(low, high)
            ax.set_xlim(0.0, longest)
            ax.tick_params(labelbottom=ax is axes[-1])
        axes[-1].set_xlabel("time [ms]")
        return sheet.save(figure, path)


def _name(cage: str) -> str:
    return NAMES[cage] if cage == "sound" else f"{cage}: {NAMES[cage]}"


def _extremes(ax: Any, t: np.ndarray, values: np.ndarray, **style: Any) -> None:
    """A long record as the band between its lowest and highest values: no peak is lost."""
    step = max(len(t) // 1400, 1)
    n = len(t) // step * step
    cut = np.asarray(values[:n], float).reshape(-1, step)
    at = np.asarray(t[:n]).reshape(-1, step).mean(axis=1) * 1e3
    label = style.pop("label", None)
    ax.fill_between(at, cut.min(axis=1), cut.max(axis=1), lw=0.5, edgecolor=style["color"], **style)
    if label:
        ax.plot([], [], color=style["color"], label=label, lw=3)


def _stress(ax: Any, run: Run) -> None:
    values = run.stress_history.peak * 1e-6
    _extremes(ax, run.dataset["time"].values, values, color=sheet.BLUE)
    ax.set_ylim(bottom=0.0)


def _radial(ax: Any, run: Run) -> None:
    values = metrics.whirl_radius(run.dataset, about="axis") * 1e6
    _extremes(ax, run.dataset["time"].values, values, color=sheet.BLUE)
    ax.set_ylim(bottom=0.0)


def _acceleration(ax: Any, run: Run) -> None:
    values = run.dataset["outer_acceleration_filtered"].sel(axis2="y")
    _extremes(ax, values["time_hf"].values, values.values, color=sheet.BLUE)


def _cage_speed(ax: Any, run: Run) -> None:
    values = run.dataset["cage_omega"].sel(axis="x").values * RPM
    _extremes(ax, run.dataset["time"].values, values, color=sheet.BLUE)


def _roller_speeds(ax: Any, run: Run) -> None:
    spin = (
        np.abs(run.dataset["element_omega"].isel(spin_axis=0)).transpose("time", "element").values
    )
    colours = {AFTER: (sheet.GREEN, "j+1"), BEFORE: (sheet.BLUE, "j-1"), AT: (sheet.VERMILION, "j")}
    for roller, (colour, name) in colours.items():
        values = spin[:, roller] * RPM / 1e3
        _extremes(ax, run.dataset["time"].values, values, color=colour, alpha=0.8,
                  label=f"roller {name}")  # fmt: skip


@dataclass(frozen=True)
class Curve:
    """One figure of histories: what a panel draws, its unit, and whether panels share a scale."""

    panel: Draw
    label: str
    title: str
    caption: str
    shared: bool = True


HISTORIES: Mapping[str, Curve] = {
    "stress": Curve(
        _stress,
        "stress [MPa]",
        "Largest equivalent stress in the cage",
        "Largest equivalent stress in the cage over time, contact zones left out; own scales.",
        shared=False,
    ),
    "radial_displacement": Curve(
        _radial,
        "distance [um]",
        "Radial displacement of the cage centre",
        "Distance of the cage centre from the outer ring's axis over time.",
    ),
    "acceleration": Curve(
        _acceleration,
        "m/s²",
        "Acceleration of the outer ring along the load",
        "Acceleration of the outer ring in its housing along the load, low-passed at 10 kHz.",
    ),
    "cage_speed": Curve(_cage_speed, "speed [rpm]", "Cage speed", "Speed of the cage over time."),
    "roller_speeds": Curve(
        _roller_speeds,
        "10³ rpm",
        "Speeds of rollers j-1, j and j+1",
        "Speeds of the rollers beside the defect over time, inertial frame; own scales.",
        shared=False,
    ),
}


def orbits(runs: Mapping[str, Run], path: Path) -> Path:
    """Orbit of the cage centre, one column a cage: on one scale with the land's clearance, and
    each on its own."""
    side, gap, between = 320, 84, 70
    paths = {cage: metrics.orbit(_settled(run)) * 1e6 for cage, run in runs.items()}
    reach = 1.12 * max(float(np.abs(yz).max()) for yz in paths.values())
    with sheet.style():
        width = _EDGE + len(runs) * (side + gap) + 10
        figure = sheet.new_figure(width, _TOP + 2 * side + between + 80)
        facts = ["load along y", "circle: clearance of the land", "below, on scales of their own"]
        sheet.heading(figure, "Orbit of the cage centre after settling", sheet.join(facts))
        for i, (cage, yz) in enumerate(paths.items()):
            left = _EDGE + i * (side + gap)
            ax = sheet.axes_at(figure, (left, _TOP, side, side))
            _land(ax, runs[cage])
            ax.plot(yz[:, 0], yz[:, 1], color=sheet.BLUE, lw=0.4)
            ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
            ax.set_title(cage, loc="left", weight="bold")
            ax.tick_params(labelleft=i == 0)
            near = sheet.axes_at(figure, (left, _TOP + side + between, side, side))
            near.plot(yz[:, 0], yz[:, 1], color=sheet.BLUE, lw=0.4)
            middle = 0.5 * (yz.max(axis=0) + yz.min(axis=0))
            half = 0.55 * float(np.ptp(yz, axis=0).max())
            near.set(xlim=middle[0] + [-half, half], ylim=middle[1] + [-half, half])
            near.set_xlabel("y [um]")
            if i == 0:
                ax.set_ylabel("z [um]")
                near.set_ylabel("z [um]")
        return sheet.save(figure, path)


def _land(ax: Any, run: Run) -> None:
    """The circle in which the land lets the cage centre move."""
    angle = np.linspace(0.0, 2.0 * pi, 200)
    clearance = run.case.land.clearance * 1e6
    ax.plot(clearance * np.cos(angle), clearance * np.sin(angle), color=sheet.FAINT, lw=0.8)


def _stress_image(run: Run, cage: str, path: Path) -> Path:
    field, history, mesh = run.stress(), run.stress_history, run.mesh
    vertex = int(history.peak_vertex[history.peak_sample])
    moved = field.displacement[: len(mesh.points)]
    return stress_picture(
        mesh.points, mesh.tets, moved, field.von_mises, path,
        scale=nice_scale(mesh.points, moved), time=field.time,
        title=f"Equivalent stress, {NAMES[cage]}", note=cage, peak_node=vertex,
        pocket_count=mesh.pocket_count,
        azimuth=float(np.arctan2(*mesh.points[vertex, [2, 1]])),
    )  # fmt: skip


_CAPTION_PINCH = (
    "Root stress of the pocket that is 0.3 mm shorter against its axial clearance: a static pair "
    "of axial forces, and assembled bearings."
)


_NARROWEST = 0.19e-3  # m, the least clearance that is drawn


def pinch_picture(found: PinchMap, path: Path) -> Path:
    """Corner stress of the pinched pocket against the clearance."""
    clearances = np.linspace(_NARROWEST, DISPLACEMENT, 61)
    pair = np.array([found.static(c).corner for c in clearances]) * 1e-6
    with sheet.style():
        figure = sheet.new_figure(1100, 760)
        sheet.heading(
            figure,
            "A pocket 0.3 mm shorter: stress in its corners",
            f"axial compliance of the pocket {found.compliance * 1e9:.1f} um/kN",
        )
        ax = sheet.axes_at(figure, (110, 110, 930, 540))
        ax.plot(clearances * 1e3, pair, color=sheet.BLUE, label="static pair of axial forces")
        ax.plot(
            [s.clearance * 1e3 for s in found.assembled],
            [s.corner * 1e-6 for s in found.assembled],
            "o",
            color=sheet.VERMILION,
            label="assembled bearing",
        )
        lines = ((CLAIMED, "the paper: 320.51 MPa"), (found.proof, "proof stress of cast brass"))
        for level, text in lines:
            ax.axhline(level * 1e-6, color=sheet.FAINT, ls="--", lw=1.0)
            ax.text(_NARROWEST * 1e3, level * 1e-6, f" {text}", va="bottom", color=sheet.FAINT)
        ax.set(xlabel="axial clearance Cp - Lw of a sound pocket [mm]", ylabel="stress [MPa]")
        ax.set(xlim=(_NARROWEST * 1e3, 0.305), ylim=(0.0, None))
        ax.legend(loc="upper right")
        return sheet.save(figure, path)
