"""Pictures of a machine: its shaft in its bearings with what it bears, and how it whirls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.render import sheet

_LEFT, _WIDTH, _TOP, _BETWEEN = 150, 1180, 120, 56
_DRAWING, _PANEL = 380, 210
_RPM = 30.0 / pi
_FORCES = 12  # arrows that are drawn, the largest


@dataclass(frozen=True)
class Drawn:
    """A bearing as it is drawn [m]: its middle, bore, outside diameter and width. ``faces``: +1 or
    -1 along x, 0 where it bears axial load both ways or none. ``floats``: its outer ring slides.
    ``force`` (3,) [N] on the shaft."""

    name: str
    position: float
    bore: float
    outside: float
    width: float
    faces: int
    floats: bool
    force: np.ndarray


@dataclass(frozen=True)
class ShaftDrawing:
    """A shaft as it is drawn: sections (k, 4) of begin, end, outside and inside diameter [m],
    bearings, discs (k, 3) of place, diameter and width, and loads: place [m] and force (3,) [N]."""

    sections: np.ndarray
    bearings: Sequence[Drawn]
    discs: np.ndarray
    loads: Sequence[tuple[float, np.ndarray]]


@dataclass(frozen=True)
class ShaftCurves:
    """Places (n,) [m], displacements (n, 2) along y and z [m]; and at section ends (m,) [m], the
    bending moments (m, 2) about y and z [N m], and the stress (m,) [Pa]."""

    position: np.ndarray
    moved: np.ndarray
    ends: np.ndarray
    bending: np.ndarray
    stress: np.ndarray


def machine_picture(
    drawing: ShaftDrawing, curves: ShaftCurves, path: str | Path, *, title: str, note: str = ""
) -> Path:
    """The shaft with its bearings and loads, how it is displaced, its bending moment and stress."""
    stressed = bool(curves.stress.any())
    panels = 3 if stressed else 2
    length = float(curves.position[-1])
    span = (-0.04 * length, 1.04 * length)
    with sheet.style():
        height = _TOP + _DRAWING + panels * (_PANEL + _BETWEEN) + 90
        figure = sheet.new_figure(_LEFT + _WIDTH + 60, height)
        sheet.heading(figure, sheet.label(title), note)
        ax = sheet.axes_at(figure, (_LEFT, _TOP, _WIDTH, _DRAWING))
        _draw_shaft(ax, drawing, span, _WIDTH / _DRAWING)
        mm = 1e3 * curves.position
        ends = 1e3 * curves.ends
        rows: list[tuple[str, list[tuple[np.ndarray, np.ndarray, str]]]] = [
            ("displacement [µm]", [(mm, 1e6 * curves.moved[:, k], n) for k, n in enumerate("yz")]),
            ("bending moment [N m]", [
                (ends, curves.bending[:, 1], "about z (bends in y)"),
                (ends, curves.bending[:, 0], "about y (bends in z)"),
            ]),
            ("nominal stress [MPa]", [(ends, 1e-6 * curves.stress, "")]),
        ]  # fmt: skip
        for k, (name, lines) in enumerate(rows[:panels]):
            top = _TOP + _DRAWING + _BETWEEN + k * (_PANEL + _BETWEEN)
            own = sheet.axes_at(figure, (_LEFT, top, _WIDTH, _PANEL))
            _curves(own, name, lines, span)
            for b in drawing.bearings:
                own.axvline(1e3 * b.position, color=sheet.HAIR, lw=0.9, ls=(0, (4, 3)), zorder=1)
            if k == panels - 1:
                own.set_xlabel("x, from the shaft's left end [mm]")
            else:
                own.tick_params(labelbottom=False)
        return sheet.save(figure, path)


def _curves(
    ax: Any, name: str, lines: list[tuple[np.ndarray, np.ndarray, str]],
    span: tuple[float, float],
) -> None:  # fmt: skip
    largest = max((float(np.abs(v).max()) for _, v, _ in lines), default=0.0)
    for (x, values, label), colour, form in zip(lines, (sheet.BLUE, sheet.VERMILION), ("-", "--")):
        ax.plot(x, values, form, color=colour, lw=1.6, label=label or None)
    ax.set(xlim=(1e3 * span[0], 1e3 * span[1]), ylabel=name)
    if not largest > 0.0:
        sheet.nothing(ax, "none")
    if any(label for *_, label in lines):
        ax.legend(loc="upper right", ncols=2)
    ax.yaxis.set_label_coords(-0.075, 0.5)


def _draw_shaft(ax: Any, d: ShaftDrawing, span: tuple[float, float], shape: float) -> None:
    from matplotlib.patches import Rectangle

    def box(left: float, low: float, wide: float, high: float, **look: Any) -> None:
        ax.add_patch(Rectangle((1e3 * left, 1e3 * low), 1e3 * wide, 1e3 * high, **look))

    for begin, end, outside, inside in d.sections:
        for sign in (1.0, -1.0):
            low = min(sign * 0.5 * inside, sign * 0.5 * outside)
            box(begin, low, end - begin, 0.5 * (outside - inside), fc="#dfe5ea", ec=sheet.INK,
                lw=0.8)  # fmt: skip
    for place, diameter, width in d.discs:
        for sign in (1.0, -1.0):
            half = 0.5 * diameter
            box(place - 0.5 * width, min(0.0, sign * half), width, half, fc="#c6d3df", alpha=0.75,
                ec=sheet.INK, lw=0.8)  # fmt: skip
    for b in d.bearings:
        colour = sheet.GREEN if b.floats else sheet.BLUE
        for sign in (1.0, -1.0):
            low = min(sign * 0.5 * b.bore, sign * 0.5 * b.outside)
            high = 0.5 * (b.outside - b.bore)
            box(b.position - 0.5 * b.width, low, b.width, high, fc="white", ec=colour, lw=1.4)
            middle = sign * 0.25 * (b.bore + b.outside)
            if b.faces:  # the line of contact, outwards as it bears
                reach = 0.42 * min(b.width, high)
                ends = np.array([-reach, reach])
                along, out = 1e3 * (b.position + b.faces * ends), 1e3 * (middle + sign * ends)
                ax.plot(along, out, color=colour, lw=1.2)
            ax.add_patch(_dot(b, middle, colour))
    _names(ax, d.bearings, 0.07 * (span[1] - span[0]))
    half = 0.5 * max([float(d.sections[:, 2].max(initial=0.0)), *(b.outside for b in d.bearings),
                      *(float(x[1]) for x in d.discs)])  # fmt: skip
    tall = max(1.75 * half, 0.5 * (span[1] - span[0]) / shape)
    ax.set(xlim=(1e3 * span[0], 1e3 * span[1]), ylim=(-1e3 * tall, 1e3 * tall), ylabel="[mm]")
    _arrows(ax, d, half, tall)
    ax.axhline(0.0, color=sheet.FAINT, lw=0.7, ls=(0, (12, 3, 2, 3)), zorder=4)
    ax.grid(False)
    ax.tick_params(labelbottom=False)
    ax.yaxis.set_label_coords(-0.075, 0.5)


def _names(ax: Any, bearings: Sequence[Drawn], close: float) -> None:
    """Names beside the bearings, where their arrows are not; in two rows where they are close."""
    last: dict[float, tuple[float, int]] = {}
    for b in sorted(bearings, key=lambda b: b.position):
        side = 1.0 if b.force[1] >= 0.0 else -1.0
        place, row = last.get(side, (-np.inf, 0))
        row = 1 - row if b.position - place < close else 0
        last[side] = (b.position, row)
        ax.annotate(b.name, (1e3 * b.position, side * 500.0 * b.outside),
                    (0, side * (5 + 11 * row)), textcoords="offset points", ha="center",
                    va="bottom" if side > 0.0 else "top", weight="bold",
                    color=sheet.GREEN if b.floats else sheet.BLUE)  # fmt: skip


def _dot(b: Drawn, middle: float, colour: str) -> Any:
    from matplotlib.patches import Ellipse

    size = 0.3e3 * (b.outside - b.bore)
    return Ellipse((1e3 * b.position, 1e3 * middle), 0.7 * size, 0.7 * size, fc="#f4f4f4",
                   ec=colour, lw=1.0)  # fmt: skip


def _arrows(ax: Any, d: ShaftDrawing, half: float, tall: float) -> None:
    """Loads and bearings' forces in the plane x-y, y upwards; the others are in the tables."""
    found = [(x, f, sheet.VERMILION) for x, f in d.loads]
    found += [(b.position, b.force, sheet.PURPLE) for b in d.bearings]
    largest = max((float(np.abs(f[:2]).max()) for _, f, _ in found), default=0.0)
    if not largest > 0.0:
        return
    found = sorted(found, key=lambda row: -float(np.abs(row[1][:2]).max()))[:_FORCES]
    room = tall - half
    for x, force, colour in found:
        if abs(force[1]) > 1e-3 * largest:
            sign = np.sign(force[1])
            tip, length = -sign * 1.05 * half, room * (0.3 + 0.5 * abs(force[1]) / largest)
            _arrow(ax, (x, tip - sign * length), (x, tip), colour, f"{abs(force[1]):.4g} N")
    legend = (("loads", sheet.VERMILION), ("bearings on the shaft", sheet.PURPLE))
    for k, (name, colour) in enumerate(legend):
        ax.text(1.0 - 0.2 * k, 1.02, f"▸ {name}, in y", transform=ax.transAxes, ha="right",
                color=colour, fontsize=8.5)  # fmt: skip


def _arrow(
    ax: Any, tail: tuple[float, float], tip: tuple[float, float], colour: str, words: str
) -> None:
    form = {"arrowstyle": "-|>", "color": colour, "lw": 1.7, "shrinkA": 0, "shrinkB": 0}
    ends = [tuple(1e3 * v for v in p) for p in (tip, tail)]
    ax.annotate("", ends[0], ends[1], arrowprops=form)
    ax.annotate(words, ends[1], (4, 0), textcoords="offset points", color=colour, fontsize=8.0,
                va="center")  # fmt: skip


def whirl_picture(
    speeds: np.ndarray, frequencies: Sequence[tuple[np.ndarray, Sequence[str]]],
    amplitudes: np.ndarray, path: str | Path, *, title: str, note: str = "", speed: float = 0.0,
) -> Path:  # fmt: skip
    """Campbell diagram: natural frequencies [rad/s] at speeds (s,) [rad/s] with the ways of their
    whirls; below, where there is any, the largest amplitude (s,) [m] under unbalance."""
    forced = bool(np.nan_to_num(amplitudes).any())
    colours = {"forward": sheet.BLUE, "backward": sheet.VERMILION, "straight": sheet.GREEN,
               "axial": sheet.PURPLE}  # fmt: skip
    with sheet.style():
        figure = sheet.new_figure(_LEFT + _WIDTH + 60, _TOP + 560 + forced * 330 + 90)
        sheet.heading(figure, sheet.label(title), note)
        ax = sheet.axes_at(figure, (_LEFT, _TOP, _WIDTH, 560))
        for way, colour in colours.items():
            points = [(w * _RPM, f / (2.0 * pi)) for w, (found, ways) in zip(speeds, frequencies)
                      for f, own in zip(found, ways) if own == way]  # fmt: skip
            if points:
                ax.plot(*zip(*points), "o", ms=3.5, color=colour, label=way)
        top = 1.08 * max((float(f.max()) for f, _ in frequencies if len(f)), default=1.0)
        ax.plot(speeds * _RPM, speeds / (2.0 * pi), color=sheet.INK, lw=1.0, label="turns (1x)")
        ax.set(ylabel="natural frequency [Hz]", ylim=(0.0, top / (2.0 * pi)))
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=5)
        axes = [ax]
        if forced:
            ax.tick_params(labelbottom=False)
            axes.append(sheet.axes_at(figure, (_LEFT, _TOP + 600, _WIDTH, 290)))
            moves = amplitudes > 0.0
            axes[1].semilogy(speeds[moves] * _RPM, 1e6 * amplitudes[moves], color=sheet.BLUE)
            axes[1].set_ylabel("largest orbit [µm]")
        for own in axes:
            own.set_xlim(0.0, float(speeds[-1]) * _RPM)
            if speed:
                own.axvline(abs(speed) * _RPM, color=sheet.FAINT, lw=0.9, ls=(0, (4, 3)))
        axes[-1].set_xlabel("speed of the shaft [rpm]; dashed: the machine's")
        return sheet.save(figure, path)
