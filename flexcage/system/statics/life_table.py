"""Lives as text."""

from __future__ import annotations

from math import isfinite, pi

from flexcage.system.statics.rated import Lives, RatedLife


def lives_lines(lives: Lives) -> list[list[str]]:
    """Names and values of the lives at the case's own speed and load."""
    here, n = lives.here, lives.symbol
    lines = [
        ["viscosity ratio kappa, ISO 281", _factor(here.kappa, here_oil(here))],
        ["reliability factor a1", f"{lives.reliability_factor:g} at {lives.reliability:g} %"],
    ]
    modified = ""
    if lives.contamination is not None:
        modified = "m"
        given = f"e_C {lives.contamination:g}, C_u {lives.fatigue_limit / 1e3:.4g} kN"
        lines.append(["life modification a_ISO at P", _factor(here.modification, given)])
        lines.append(["a_ISO at the elements' loads", _factor(here.reference_modification, "")])
    unit = "million revolutions"
    lines += [
        [f"life L{n}{modified}, ISO 281", _number(here.life, unit)],
        [f"life L{n}{modified}r, ISO/TS 16281", _number(here.reference_life, unit)],
    ]
    if isfinite(here.hours):
        lines.append(["", f"{here.hours:.6g} h at this speed"])
    return lines


def here_oil(point: RatedLife) -> str:
    """Both viscosities, and what starvation leaves, in words."""
    if not isfinite(point.kappa):
        return ""
    text = f"{1e6 * point.viscosity:.4g} of {1e6 * point.reference_viscosity:.4g} mm^2/s"
    return text if point.starved == 1.0 else f"{text}, film starved to {100 * point.starved:.3g} %"


def spectrum_lines(lives: Lives) -> list[list[str]]:
    """A row for every point of the spectrum, and the combined life."""
    modified = "" if lives.contamination is None else "m"
    heads = ["share, %", "rpm", "radial, N", "axial, N", "oil, degC", "P, N", "kappa", "a_ISO",
             f"L{lives.symbol}{modified}rh, h"]  # fmt: skip
    lines = [heads]
    for share, point in zip(lives.shares, lives.points):
        if point is None:
            lines.append([f"{100.0 * share:.4g}", "0", *["-"] * (len(heads) - 2)])
            continue
        values = (point.radial, point.axial)
        oil = "-" if point.temperature is None else f"{point.temperature - 273.15:.4g}"
        lines.append([
            f"{100.0 * share:.4g}", f"{point.speed * 30.0 / pi:.6g}",
            *(f"{value:.5g}" for value in values), oil, _short(point.equivalent_load),
            _short(point.kappa), _short(point.reference_modification), _short(point.hours, 6),
        ])  # fmt: skip
    return [*lines, ["all", *[""] * (len(heads) - 2), _short(lives.combined, 6)]]


def _number(value: float, note: str) -> str:
    return f"{_short(value, 6)} {note}".rstrip() if isfinite(value) else "none"


def _factor(value: float, note: str) -> str:
    return f"{_short(value)} ({note})" if isfinite(value) and note else _number(value, "")


def _short(value: float, digits: int = 4) -> str:
    return f"{value:.{digits}g}" if isfinite(value) else "-"
