"""The static solution of a machine as text."""

from __future__ import annotations

from math import isfinite, pi

import numpy as np

from flexcage.core import html
from flexcage.core.listing import aligned, wrapped
from flexcage.core.units import describe, mm
from flexcage.machine.state import BearingResult, MachineState

_FRAME = (
    "x along the shaft from its left end, y and z across; forces and moments are those of the "
    "bearings on the shaft"
)
_INSIDE = (
    "offset that the inner ring is pressed in by; elements that both races load; Q and p: largest "
    "force and pressure of one; lives L10 by ISO 281, L10r by ISO/TS 16281"
)
_SMALL = 1e-9  # of the largest of its kind: shown as 0
_UNITS = np.array([1e6, 1e6, 1e6, 1e3, 1e3])
_CRITICALS = 6  # that are told


def table_of(s: MachineState, width: int = 0) -> str:
    """Bearings, shaft, critical speeds and warnings, in lines of at most ``width`` characters."""

    def grid(lines: list[list[str]], sides: str = "lr") -> str:
        return aligned(lines, sides=sides, heads=True, width=width)

    head, frame = _head(s), f"{_FRAME}; {_gravity(s)}"
    parts = [wrapped(head, width=width), f"{wrapped(frame, width=width)}\n{grid(_forces(s))}"]
    note = wrapped(
        "stiffness: of a bearing with its seat, other motions held; of the shaft, a force or "
        "moment alone over its own displacement, all bearings following", width=width,
    )  # fmt: skip
    parts += [
        f"{wrapped(_INSIDE, width=width)}\n{grid(_presses(s))}",
        f"{note}\n{grid(_stiffness(s))}",
        aligned(_shaft_lines(s), width=width),
    ]
    criticals = _critical_lines(s)
    if len(criticals) > 1:
        note = "critical speeds, with the bearings' stiffness at this load and speed"
        parts.append(f"{wrapped(note, width=width)}\n{grid(criticals, 'rl')}")
    parts += [wrapped(f"Warning: {text}", width=width) for text in s.warnings]
    return "\n\n".join(parts)


def html_of(s: MachineState) -> str:
    """Warnings, forces, contacts; stiffness, shaft and critical speeds unfold."""
    forces, presses, stiffness, criticals = (
        html.table(lines[1:], heads=lines[0], sides="lr")
        for lines in (_forces(s), _presses(s), _stiffness(s), _critical_lines(s))
    )
    return html.block(
        _head(s),
        html.bullets(f"Warning: {text}" for text in s.warnings),
        html.paragraphs([f"{_FRAME}; {_gravity(s)}"]),
        forces,
        html.paragraphs([_INSIDE]),
        presses,
        html.table(_shaft_lines(s)),
        html.folded("Stiffness", stiffness),
        html.folded("Critical speeds", criticals),
    )


def _head(s: MachineState) -> str:
    kind = "rigid" if s.shaft.rigid else "elastic"
    count = f"{len(s.bearings)} bearing{'s' if len(s.bearings) > 1 else ''}"
    return f"{s.name}: {kind} shaft in {count} at {s.speed * 30.0 / pi:.6g} rpm"


def _gravity(s: MachineState) -> str:
    """Which way weight acts, in words."""
    g = s.gravity
    if not g.acceleration:
        return "no gravity"
    if g.along != "across":
        return f"gravity towards {g.along}"
    return f"gravity at {describe(g.direction, 'deg')} from y towards z"


def _clean(values: np.ndarray, size: float) -> list[str]:
    return [_short(v if abs(v) > _SMALL * size else 0.0) for v in values]


def _forces(s: MachineState) -> list[list[str]]:
    size = max(float(np.abs(b.force[:3]).max()) for b in s.bearings)
    lines = [["bearing", "at, mm", "faces", "Fx, N", "Fy, N", "Fz, N", "My, N m", "Mz, N m",
              "x, um", "y, um", "z, um", "tilt y, mrad", "tilt z, mrad"]]  # fmt: skip
    for b in s.bearings:
        moved = _UNITS * b.displacement
        lines.append([
            b.name, f"{1e3 * b.position:.6g}", b.facing, *_clean(b.force, size),
            *_clean(moved, float(np.abs(moved).max())),
        ])  # fmt: skip
    return lines


def _presses(s: MachineState) -> list[list[str]]:
    lines = [["bearing", "what it is", "offset, um", "loaded", "Q, N", "p, MPa", "L10, 1e6 rev",
              "L10r, 1e6 rev", "L10r, h"]]  # fmt: skip
    for b in s.bearings:
        own = b.solution
        what = own.title.partition(",")[0]
        lines.append([
            b.name, what, _short(1e6 * b.offset), f"{own.loaded} of {len(own.elements.azimuth)}",
            f"{own.largest_force:.5g}", f"{own.largest_pressure / 1e6:.5g}",
            _life(own.ratings.life), _life(own.ratings.reference_life), _life(own.life_hours()),
        ])  # fmt: skip
    return lines


def _stiffness(s: MachineState) -> list[list[str]]:
    lines = [["at", "kx, N/um", "ky, N/um", "kz, N/um", "about y, N m/mrad",
              "about z, N m/mrad"]]  # fmt: skip
    lines += [[b.name, *_diagonal(b.stiffness)] for b in s.bearings]
    for place, name in zip(s.shaft.ends, ("shaft, left end", "shaft, right end")):
        yields = np.diag(s.compliance_at(place))
        lines.append([name, *(_short(1.0 / (u * v)) for u, v in zip(yields, _UNITS))])
    return lines


def _diagonal(stiffness: np.ndarray) -> list[str]:
    return [_short(v) for v in np.diag(stiffness) / _UNITS]


def _shaft_lines(s: MachineState) -> list[list[str]]:
    most, where = s.largest_deflection
    bending = int(s.sections.bending.argmax())
    lines = [
        ["largest displacement across the axis", f"{describe(most, 'um')} at {mm(where)}"],
        [
            "largest bending moment",
            f"{_short(s.sections.bending[bending])} N m at {mm(s.sections.position[bending])}",
        ],
    ]
    if s.shaft.beams:
        k = int(s.sections.stress.argmax())
        stress = describe(s.sections.stress[k], "MPa")
        lines.append(["largest nominal stress", f"{stress} at {mm(s.sections.position[k])}"])
    return lines


def _critical_lines(s: MachineState) -> list[list[str]]:
    found = [c for c in s.linearised.criticals() if c.way != "axial"][:_CRITICALS]
    return [["rpm", "whirl"], *([f"{c.speed * 30.0 / pi:.6g}", c.way] for c in found)]


def _life(value: float) -> str:
    return f"{value:.5g}" if isfinite(value) else "-"


def _short(value: float) -> str:
    return f"{value:.5g}"


def bearing_line(b: BearingResult) -> str:
    """One line on a bearing, for pictures."""
    return f"{b.name}: radially {describe(b.radial, 'N')}, axially {describe(b.force[0], 'N')}"
