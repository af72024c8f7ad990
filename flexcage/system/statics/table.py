"""The static solution as text, and as HTML for notebooks."""

from __future__ import annotations

from math import degrees, isfinite, pi

import numpy as np

from flexcage.core import html
from flexcage.core.listing import aligned, wrapped
from flexcage.geometry.fits.telling import clearance_lines, clearance_note
from flexcage.system.statics.life_table import lives_lines, spectrum_lines
from flexcage.system.statics.rings import BentRing
from flexcage.system.statics.state import StaticState

_AXES = ("x", "y", "z", "tilt y", "tilt z")
_SPECTRUM = "load spectrum: each point by its own static solution; all by Palmgren and Miner"
_SMALL = 1e-9  # of the largest of its kind: shown as 0


def table_of(s: StaticState, width: int = 0) -> str:
    """Displacements, stiffness, life, and a line for every rolling element; in lines of at most
    ``width`` characters (0: as the terminal is wide)."""

    def grid(lines: list[list[str]], sides: str = "lr") -> str:
        return aligned(lines, sides=sides, heads=True, width=width)

    def noted(note: str, lines: list[list[str]]) -> str:
        return f"{wrapped(note, width=width)}\n{grid(lines, 'r')}"

    parts = [wrapped(_head(s), width=width), grid(_ring_lines(s)), grid(_stiffness_lines(s))]
    if s.mounting is not None:
        note = wrapped(clearance_note(s.mounting), width=width)
        parts.insert(1, f"{note}\n{grid(clearance_lines(s.mounting))}")
    parts += [aligned(_life_lines(s), width=width)]
    if s.speed != 0.0 and s.frequencies:
        parts.append(grid(_frequency_lines(s)))
    if s.lives is not None and s.lives.points:
        parts.append(noted(_SPECTRUM, spectrum_lines(s.lives)))
    parts += [noted(_element_note(s), _element_lines(s))]
    parts += [noted(_bent_note(ring), _bent_lines(ring)) for ring in s.rings]
    parts += [grid(_support_lines(ring), "r") for ring in s.rings if len(ring.bears)]
    parts += [wrapped(f"Warning: {text}", width=width) for text in s.warnings]
    return "\n\n".join(parts)


def html_of(s: StaticState) -> str:
    """Warnings, displacements and life; stiffness and elements unfold."""
    title, *held = _head(s).split("\n")
    elements = html.paragraphs([_element_note(s)]) + _html_grid(_element_lines(s), sides="r")
    return html.block(
        title,
        html.bullets(f"Warning: {text}" for text in s.warnings),
        html.paragraphs(held),
        _html_grid(_ring_lines(s)),
        html.table([*_peaks(s), *_life_lines(s)]),
        *_clearance_html(s),
        *_spectrum_html(s),
        html.folded("Stiffness", _html_grid(_stiffness_lines(s))),
        *(
            [html.folded("Frequencies", _html_grid(_frequency_lines(s)))]
            if s.speed and s.frequencies
            else []
        ),
        html.folded("Elements", elements),
        *(
            html.folded(_bent_note(ring), _html_grid(_bent_lines(ring), sides="r"))
            for ring in s.rings
        ),
    )


def _clearance_html(s: StaticState) -> list[str]:
    if s.mounting is None:
        return []
    note = html.paragraphs(clearance_note(s.mounting).split("\n"))
    return [html.folded("Clearance", note + _html_grid(clearance_lines(s.mounting)))]


def _spectrum_html(s: StaticState) -> list[str]:
    if s.lives is None or not s.lives.points:
        return []
    grid = _html_grid(spectrum_lines(s.lives), sides="r")
    return [html.folded("Load spectrum", html.paragraphs([_SPECTRUM]) + grid)]


def _html_grid(lines: list[list[str]], *, sides: str = "lr") -> str:
    return html.table(lines[1:], heads=lines[0], sides=sides)


def _peaks(s: StaticState) -> list[list[str]]:
    return [
        ["loaded elements", f"{s.loaded} of {len(s.elements.azimuth)}"],
        ["largest force on a race", f"{s.largest_force:.5g} N"],
        ["largest pressure", f"{s.largest_pressure / 1e6:.5g} MPa"],
    ]


def _head(s: StaticState) -> str:
    held = f"\ninner ring: {s.held}" if s.held else ""
    return f"{s.title}, inner ring at {s.speed * 30.0 / pi:.6g} rpm{held}"


def _clean(values: np.ndarray) -> np.ndarray:
    """Displacements or forces (5,) with what is only rounding as 0; an arm of 10 mm for tilts."""
    size = np.abs(values) * np.array([1.0, 1.0, 1.0, 1e-2, 1e-2])
    return np.where(size <= _SMALL * size.max(), 0.0, values)


def _ring_lines(s: StaticState) -> list[list[str]]:
    force, moved = _clean(s.load), _clean(s.displacement)
    reaction = np.where(np.abs(s.reaction) > _SMALL * np.abs(s.load).max(), s.reaction, 0.0)
    lines = [["", *_AXES], ["load, N and N m", *map(_short, force)]]
    if reaction.any():
        lines.append(["reaction, N and N m", *map(_short, reaction)])
    unit = np.where(np.arange(5) < 3, 1e6, 1e3)
    lines.append(["displacement, um and mrad", *map(_short, unit * moved)])
    if s.outer.any():
        lines.append(["of it, the outer ring's", *map(_short, unit * _clean(s.outer))])
    return lines


def _stiffness_lines(s: StaticState) -> list[list[str]]:
    unit = np.where(np.arange(5) < 3, 1e6, 1e3)  # per um, per mrad
    matrix = s.stiffness / unit
    diagonal = np.sqrt(np.abs(np.outer(np.diag(matrix), np.diag(matrix))))
    matrix = np.where(np.abs(matrix) > 1e-9 * diagonal.max(), matrix, 0.0)
    lines = [["stiffness", *(f"per {'um' if k < 3 else 'mrad'} {a}" for k, a in enumerate(_AXES))]]
    for k, row in enumerate(matrix):
        name = f"force {_AXES[k]}, N" if k < 3 else f"moment {_AXES[k][-1]}, N m"
        lines.append([name, *map(_short, row)])
    return lines


def _frequency_lines(s: StaticState) -> list[list[str]]:
    """Passing frequencies without slip; one line where the load leaves the contact angles."""
    lines = [["frequency, Hz", *s.frequencies]]
    rows = {"at these contact angles": s.frequencies, "at the nominal angle": s.nominal_frequencies}
    if s.frequencies == s.nominal_frequencies:
        rows = {"pure rolling": s.frequencies}
    return [*lines, *([name, *map(_short, row.values())] for name, row in rows.items())]


def _life_lines(s: StaticState) -> list[list[str]]:
    r = s.ratings
    static, dynamic = r.names
    lines = [
        [f"static rating {static}", f"{r.static / 1e3:.4g} kN"],
        [f"dynamic rating {dynamic}", f"{r.dynamic / 1e3:.4g} kN"],
        [
            "equivalent load P, ISO 281",
            _or_none(r.equivalent_load, "N", "no factors for this load"),
        ],
        ["life L10, ISO 281", _or_none(r.life, "million revolutions", "none")],
        ["life L10r, ISO/TS 16281", _or_none(r.reference_life, "million revolutions", "none")],
    ]
    if isfinite(s.life_hours()):
        lines.append(["", f"{s.life_hours():.6g} h at this speed"])
    return lines if s.lives is None else lines + lives_lines(s.lives)


def _element_note(s: StaticState) -> str:
    note = (
        "Q force, p largest pressure, a and b half of the contact across and in rolling direction"
    )
    if s.elements.arcs is not None:
        note += ", both of the arc of a race that bears most"
    if s.elements.axial is not None:
        note += ", axial force that ribs carry through a roller towards +x"
    if s.speed != 0.0:
        note += ", h least film (isothermal, fully flooded), Fc centrifugal force"
    return note


def _element_lines(s: StaticState) -> list[list[str]]:
    e = s.elements
    balls = bool(np.isfinite(e.edge).any() or np.nanmax(np.abs(e.angle), initial=0.0) > 0.0)
    forces = list(e.force.T) if e.arcs is None else list(e.arcs.values())
    names = ["element", "azimuth, deg"]
    names += [f"Q {name}, N" for name in (("inner", "outer") if e.arcs is None else e.arcs)]
    if balls:
        names += ["angle i, deg", "angle o, deg"]
    names += ["p inner, MPa", "p outer, MPa", "a inner, mm", "b inner, mm"]
    names += ["axial, N"] if e.axial is not None else []
    turning = s.speed != 0.0
    if turning:
        names += ["h inner, um", "h outer, um", "Fc, N"]
        names += ["Mg, N mm", "friction"] if balls else []
    lines = [names]
    for k in range(len(e.azimuth)):
        cells = [str(k), f"{degrees(e.azimuth[k]):.4g}", *(f"{q[k]:.5g}" for q in forces)]
        if balls:
            cells += [_or_dash(degrees(a), ".3f") for a in e.angle[k]]
        cells += [f"{p / 1e6:.5g}" for p in e.pressure[k]]
        cells += [f"{1e3 * e.across[k, 0]:.4g}", f"{1e3 * e.along[k, 0]:.4g}"]
        cells += [f"{e.axial[k]:.5g}"] if e.axial is not None else []
        if turning:
            cells += [_or_dash(1e6 * h, ".4g") for h in s.film.least[k]]
            cells.append(f"{e.centrifugal[k]:.4g}")
            if balls:
                asked = np.nanmax(e.friction[k], initial=0.0)
                cells += [f"{1e3 * e.gyroscopic[k]:.4g}", f"{asked:.4f}"]
        lines.append(cells)
    return lines


def _bent_note(ring: BentRing) -> str:
    return (
        f"{ring.side} ring: how far its race yields from where its seat has it "
        f"({len(ring.seated.reduction.compliance) - 1} harmonics)"
    )


def _bent_lines(ring: BentRing) -> list[list[str]]:
    lines = [["element", "azimuth, deg", "axially, um", "radially, um", "tilt, mrad"]]
    for k, (azimuth, yields) in enumerate(zip(ring.azimuth, ring.deflection)):
        values = (f"{v:.4g}" for v in yields * np.array([1e6, 1e6, 1e3]))
        lines.append([str(k), f"{degrees(azimuth):.4g}", *values])
    return lines


def _support_lines(ring: BentRing) -> list[list[str]]:
    """The supports that press, or pull: where each is, its force, and where that acts."""
    lines = [["support at, deg", "presses, N", "its middle at, deg"]]
    seated = ring.seated
    for k in np.unique(seated.of_support):
        strips = seated.of_support == k
        azimuth, force = seated.support[strips], ring.support_force[strips]
        if force.any():
            middle = degrees(azimuth.mean() + force @ (azimuth - azimuth.mean()) / force.sum())
            lines.append([f"{degrees(azimuth.mean()):.4g}", f"{force.sum():.5g}", f"{middle:.4g}"])
    return lines


def _or_none(value: float, unit: str, otherwise: str) -> str:
    return f"{value:.6g} {unit}" if isfinite(value) else otherwise


def _or_dash(value: float, form: str) -> str:
    return format(value, form) if isfinite(value) else "-"


def _short(value: float) -> str:
    return f"{value:.6g}"
