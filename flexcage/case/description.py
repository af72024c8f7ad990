"""A case in words: what a reader must know to understand its figures, in a few sentences."""

from __future__ import annotations

import dataclasses
from typing import Any

from flexcage.case.extensions import sources
from flexcage.case.presets import NAMED, load_preset
from flexcage.case.read_values import assumptions
from flexcage.case.sections import CaseSections
from flexcage.core.binding import to_table
from flexcage.core.units import typeset
from flexcage.geometry.cage import Cage
from flexcage.geometry.materials import EXPANSIONS
from flexcage.geometry.temperature import MODULUS_CURVES
from flexcage.system.spec import Load, Wave

_NO_CAGE = "It has no cage: its elements touch each other (full complement)."


def in_words(case: CaseSections) -> list[str]:
    """Paragraphs: bearing, cage and defects; drive and load; and how it was computed."""
    asked = f"The case calls itself “{case.description}”." if case.description else ""
    cage = f"{_cage(case, case.cage)} {_defects(case, case.cage)}" if case.cage else _NO_CAGE
    what = f"{case.mounted.bearing.in_words()} {_fit(case)}{cage}"
    return [text for text in (asked, what, f"{_motion(case)} {_method(case)}") if text]


def _fit(case: CaseSections) -> str:
    if (mounting := case.mounting) is None:
        return ""
    before = mounting.part("initial").values[mounting.taken]
    return (
        f"Its clearance is what fits, warmth and speed leave of {typeset(before, 'um', digits=3)} "
        "before mounting. "
    )


def _cage(case: CaseSections, cage: Cage) -> str:
    bearing = case.bearing
    guide = bearing.guides.get(cage.guidance, f"its {bearing.element}s")
    return (
        f"Its cage is {case.cage_model}, of {cage.material.name}{_warm(cage)}, guided by {guide}; "
        f"{cage.in_words()}."
    )


def _warm(cage: Cage) -> str:
    if cage.temperature is None:
        return ""
    modulus = typeset(cage.warm_material.youngs_modulus, "GPa", digits=3)
    return f" at {typeset(cage.temperature, 'degC')} ({modulus}; its strength is that at 23°C)"


def _defects(case: CaseSections, cage: Cage) -> str:
    if not case.defects:
        return "The cage has no defect."
    texts = [d.in_words(case.bearing.element_count) for d in case.defects]
    return f"{cage.altered}: {'; '.join(texts)}."


def _motion(case: CaseSections) -> str:
    drive, load = case.drive, case.load
    speed = f"turns at {typeset(drive.speed, 'rpm')}"
    if drive.times:
        speed = "turns at a speed that a table gives over time"
    elif drive.ramp_to is not None:
        speed += f", then up to {typeset(drive.ramp_to, 'rpm')}"
    if drive.wave != "none":
        speed += f" with {_wave(drive, typeset(drive.wave_amplitude, 'rpm'))}"
    tilted = ""
    if load.misalignment:
        tilted = f", tilted by {typeset(load.misalignment, 'mrad')}"
    if load.centre == "held":
        tilted += ", held at its centre where that puts it"
    if case.bearing.carries_axial_load:
        tilted += ", free in tilt" if load.tilt == "free" else ", held in tilt"
    springs = (("axial", "N/um", "axially"), ("tilt", "N*m/rad", "in tilt"))
    stiff = [(getattr(load, f"{key}_stiffness"), unit, way) for key, unit, way in springs]
    if any(value for value, _, _ in stiff):
        parts = [f"{typeset(value, unit)} {way}" for value, unit, way in stiff if value]
        tilted += f", on a shaft of {' and '.join(parts)}"
    held = "" if case.mount.kind == "fixed" else ", the outer ring in an elastic mount"
    return (
        f"The inner ring {speed} under {_load(case)}{tilted}{held}. {_constraints(case)}Lubricant: "
        f"{case.lubricant.name}, {typeset(case.lubricant.viscosity, 'mPa*s')}."
    )


def _constraints(case: CaseSections) -> str:
    """What holds or moves rings and cage besides: kinds, with what is not as it would be anyway."""
    parts = []
    for spec, table in zip(
        case.constraints, to_table(case, named=NAMED)["constraints"], strict=True
    ):
        usual = {f.name: f.default for f in dataclasses.fields(spec)}
        own = [f"{k} {v}" for k, v in table.items() if getattr(spec, k) != usual[k]]
        parts.append(f"{spec.type} ({', '.join(own)})" if own else spec.type)
    return f"Constraints: {', '.join(parts)}. " if parts else ""


def _wave(spec: Wave, amplitude: str) -> str:
    return f"a {spec.wave} wave of {amplitude} and {typeset(spec.wave_period, 'ms')}"


def _load(case: CaseSections) -> str:
    """What loads the inner ring."""
    load = case.load
    moments = {"about y": load.moment_y, "about z": load.moment_z}
    parts = [_load_along(load, along) for along in ("axial", "radial")]
    parts = [text for text in parts if text] or [f"a radial load of {typeset(0.0, 'N')}"]
    if load.wave != "none":
        parts.append(f"{_wave(load, typeset(load.wave_amplitude, 'N'))} of the {load.wave_of} load")
    parts += [f"a moment of {typeset(m, 'N*m')} {way}" for way, m in moments.items() if m]
    return " and ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))


def _load_along(load: Load, along: str) -> str:
    """The "axial" or "radial" load and how it changes, without its wave; "" where there is none."""
    value, article = getattr(load, along), "an" if along == "axial" else "a"
    varies = load.varies == along
    if load.times and varies:
        return f"{article} {along} load that a table gives over time"
    if load.ramp_to is not None and varies:
        return f"{article} {along} load of {typeset(value, 'N')}, then {typeset(load.ramp_to, 'N')}"
    return f"{article} {along} load of {typeset(value, 'N')}" if value else ""


def _method(case: CaseSections) -> str:
    modes = ""
    if case.cage_model == "flexible":
        name = case.modes.kind.replace("_", "-")
        basis = f"its basis {name} with {case.modes.count} eigenmodes"
        if case.modes.body:
            basis = f"its stiffness and modes those of {case.modes.body}"
        modes = f"The cage's mesh is {case.mesh.file or case.mesh.fineness}, {basis}. "
    return (
        f"{modes}{typeset(case.solver.duration, 'ms')} of motion were asked for, integrated to "
        f"{typeset(case.solver.tolerance, 'um')} of error in a position a step; the first "
        f"{100.0 * case.output.settle:g} % are left out of statistics."
    )


def settings(case: CaseSections) -> dict[str, str]:
    """How the case was computed: path of a setting to its value, as a case file writes it."""
    table = to_table(case, named=NAMED)
    rooms = ["solver", *(("mesh", "modes") if case.cage_model == "flexible" else ())]
    found = {f"{room}.{key}": _text(value) for room in rooms for key, value in table[room].items()}
    for place, laws in table["contacts"].items():
        for key in ("slices", "normal.law", "friction.law"):
            if value := _value(laws, key):
                found[f"contacts.{place}.{key}"] = value
    return {path: value for path, value in found.items() if value not in ("", "[]")}


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def assumed(case: CaseSections) -> dict[str, tuple[str, str]]:
    """Values that no source gives: by path, the value as a case file writes it and the reason."""
    table = to_table(case, named=NAMED)
    table["contacts"]["land"] = to_table(case.land)
    if case.cage is not None:
        table["modes"] = to_table(case.modes.damped_as(case.cage.warm_material))
    return {path: (_value(table, path), why) for path, why in assumptions(case).items()}


def _value(table: Any, path: str) -> str:
    for key in path.split("."):
        table = table.get(key, "") if isinstance(table, dict) else ""
    return str(table.get("name", "its own values") if isinstance(table, dict) else table)


def grounds(case: CaseSections) -> dict[str, str]:
    """Where the values of a case come from: its preset's sources and those of its materials."""
    found = dict(load_preset(case.preset).sources) if case.preset else {}
    if any(case.fit.warmth.values()):
        bodies = (case.bearing.material, case.fit.shaft_material, case.fit.housing_material)
        for name in (body.name for body in bodies if body.name in EXPANSIONS):
            found[f"expansion of {name}"] = EXPANSIONS[name][1]
    for material in (case.bearing.material, case.bearing.rolling_material):
        if material.source:
            found[material.name] = material.source
    if case.cage is None:
        return found
    if case.cage.material.source:
        found[case.cage.material.name] = case.cage.material.source
    if case.cage.temperature is not None:
        name = case.cage.material.name
        found[f"{name} over temperature"] = MODULUS_CURVES[name].source
    return found


def run_command(file: str) -> str:
    """The command that runs a case file, with the extensions that are loaded now."""
    return " ".join(["flexcage run", file, *(f"--use {source}" for source in sources())])
