"""A case in words: what a reader must know to understand its figures, in a few sentences."""

from __future__ import annotations

from typing import Any

from flexcage.case.case import Case
from flexcage.case.extensions import sources
from flexcage.core import units
from flexcage.geometry.cages import CrossbeamDefect
from flexcage.geometry.presets import load_preset

_GUIDED = {"roller": "guided by its rollers", "inner": "guided by the inner ring's ribs",
           "outer": "guided by the outer ring"}  # fmt: skip


def describe(value: float, unit: str) -> str:
    """Short text of an SI value, its unit as print writes it."""
    text = units.describe(value, unit).replace("*", "·")
    return text.replace(" um", " µm").replace(" us", " µs")


def in_words(case: Case) -> list[str]:
    """Paragraphs: bearing, cage and defects; drive and load; and how it was computed."""
    asked = f"The case calls itself “{case.description}”." if case.description else ""
    what = f"{_bearing(case)} {_cage(case)} {_defects(case)}"
    return [text for text in (asked, what, f"{_motion(case)} {_method(case)}") if text]


def _bearing(case: Case) -> str:
    b = case.bearing
    sizes = " × ".join(describe(v, "mm").removesuffix(" mm") for v in (b.bore, b.outside_diameter))
    name = f"{b.designation}, a cylindrical" if b.designation else "A cylindrical"
    return (
        f"{name} roller bearing of {sizes} × {describe(b.width, 'mm')} with {b.roller_count} "
        f"rollers of {describe(b.roller_diameter, 'mm')}, radial clearance "
        f"{describe(b.radial_clearance, 'um')}."
    )


def _cage(case: Case) -> str:
    cage = case.cage
    return (
        f"Its cage is {case.cage_model}, of {cage.material.name}, "
        f"{_GUIDED.get(cage.guidance, cage.guidance)}; pockets are "
        f"{describe(cage.pocket_width, 'mm')} wide and {describe(cage.pocket_length, 'mm')} long."
    )


def _defects(case: Case) -> str:
    if not case.defects:
        return "The cage has no defect."
    texts = [_defect(d, case.bearing.element_count) for d in case.defects]
    return f"Deformed: {'; '.join(texts)}."


def _defect(defect: Any, pockets: int) -> str:
    size = describe(abs(defect.displacement), "mm")
    if isinstance(defect, CrossbeamDefect):
        before, after = (defect.crossbeam - 1) % pockets, defect.crossbeam
        if defect.displacement < 0.0:
            before, after = after, before
        how = "bent" if defect.shape == "bent" else "shifted as a whole"
        return (
            f"crossbeam {defect.crossbeam} is {how} by {size}, so that pocket {before} is narrower "
            f"and pocket {after} wider by as much"
        )
    change = "longer" if defect.displacement > 0.0 else "shorter"
    return (
        f"the side beam {defect.side} of pocket {defect.pocket} is displaced by {size}, so that "
        f"the pocket is {change} by as much"
    )


def _motion(case: Case) -> str:
    drive, load = case.drive, case.load
    speed = f"turns at {describe(drive.speed, 'rpm')}"
    if drive.times:
        speed = "turns at a speed that a table gives over time"
    elif drive.ramp_to is not None:
        speed += f", then up to {describe(drive.ramp_to, 'rpm')}"
    force = f"a radial load of {describe(load.radial, 'N')}"
    if load.times:
        force = "a radial load that a table gives over time"
    elif load.ramp_to is not None:
        force += f", then {describe(load.ramp_to, 'N')}"
    tilted = ""
    if load.misalignment:
        tilted = f", tilted by {describe(load.misalignment, 'mrad')}"
    held = "" if case.mount.kind == "fixed" else ", the outer ring in an elastic mount"
    return (
        f"The inner ring {speed} under {force}{tilted}{held}. Lubricant: {case.lubricant.name}, "
        f"{describe(case.lubricant.viscosity, 'mPa*s')}."
    )


def _method(case: Case) -> str:
    modes = ""
    if case.cage_model == "flexible":
        name = case.modes.kind.replace("_", "-")
        modes = (
            f"The cage's mesh is {case.mesh.file or case.mesh.fineness}, its basis {name} with "
            f"{case.modes.count} modes. "
        )
    return (
        f"{modes}{describe(case.solver.duration, 'ms')} of motion were asked for, integrated to "
        f"{describe(case.solver.tolerance, 'um')} of error in a position a step; the first "
        f"{100.0 * case.output.settle:g} % are left out of statistics."
    )


def settings(case: Case) -> dict[str, str]:
    """How the case was computed: path of a setting to its value, as a case file writes it."""
    table = case.to_table()
    rooms = ["solver", *(("mesh", "modes") if case.cage_model == "flexible" else ())]
    found = {f"{room}.{key}": _text(value) for room in rooms for key, value in table[room].items()}
    for place, laws in table["contacts"].items():
        for key in ("slices", "normal.law", "friction.law"):
            if value := _value(laws, key):
                found[f"contacts.{place}.{key}"] = value
    return {path: value for path, value in found.items() if value not in ("", "[]")}


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def assumed(case: Case) -> dict[str, tuple[str, str]]:
    """Values that no source gives: by path, the value as a case file writes it and the reason."""
    table = case.to_table()
    return {path: (_value(table, path), why) for path, why in case.assumptions.items()}


def _value(table: Any, path: str) -> str:
    for key in path.split("."):
        table = table.get(key, "") if isinstance(table, dict) else ""
    return str(table.get("name", "its own values") if isinstance(table, dict) else table)


def grounds(case: Case) -> dict[str, str]:
    """Where the values of a case come from: its preset's sources and those of its materials."""
    found = dict(load_preset(case.preset).sources) if case.preset else {}
    for material in (case.bearing.material, case.cage.material):
        if material.source:
            found[material.name] = material.source
    return found


def run_command(file: str) -> str:
    """The command that runs a case file, with the extensions that are loaded now."""
    return " ".join(["flexcage run", file, *(f"--use {source}" for source in sources())])
