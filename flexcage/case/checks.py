"""Do the sections of a case fit together? One sentence each, and what would be right."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping
from math import inf, pi
from pathlib import Path
from typing import Any

from flexcage.bearings import in_motion
from flexcage.cages import cage_type_of
from flexcage.cages.halves import find_apart
from flexcage.case.fit_checks import find_in_fit
from flexcage.case.heat_checks import find_in_heat
from flexcage.case.life_checks import find_in_life
from flexcage.case.read_values import files_of
from flexcage.case.ring_checks import find_bending_in_run, find_in_rings
from flexcage.case.sections import NO_CAGE, CaseSections, StaticSections
from flexcage.case.sensor_checks import find_in_sensors
from flexcage.core.binding import chosen_spec, default_of, join
from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.core.writing import unusable
from flexcage.geometry.bearing import Bearing, check_type
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import OVERLOAD, greatest_speed

Finding = tuple[str, str]  # where, sentence

_LAND_TOLERANCE = 5e-6  # m between a stated land clearance and the one that the dimensions leave
# m, allowed errors of a position: above what 16 digits of it and Newton's matrix leave, and below
# the few micrometres by which loaded rollers are pressed in
_TOLERANCES = (1e-13, 1e-6)
# kg/m^3; cages as good as weightless have 1e-3, and steel's is 7.85e-6 in kg/mm^3
_LEAST_DENSITY = 1e-4
_MOST_SAMPLES = 1e8  # of either grid: a run's file has some TB then
_MOST_ELEMENTS = 1e7  # assumption: more than a machine of 64 GB factors


def check_case(case: CaseSections) -> None:
    """Raise InputError for the first thing in the case that cannot be."""
    refuse_without_motion(case.bearing)
    _check_whether_caged(case)
    if case.cage is not None:
        _check_cage_type(case.bearing, case.cage)
    case.bearing.check(case.cage, case.all_defects)
    _raise_first(
        case,
        (
            *_OF_EVERY_CASE,
            _find_in_axial_load,
            _find_in_held_motions,
            *(_OF_CAGES if case.cage else (_find_without_cage,)),
            _find_in_mount,
            _find_in_waves,
            _find_in_solver,
            _find_in_output,
            _find_in_laws,
            find_bending_in_run,
            find_in_sensors,
        ),
    )


def _check_whether_caged(case: CaseSections) -> None:
    """A cage and its model go together."""
    if case.cage is None and case.cage_model != NO_CAGE:
        raise InputError(
            "[cage] is missing; give the cage's dimensions or bearing.preset, or for a full "
            'complement model = "none" in [cage].',
            where="cage",
        )
    if case.cage is not None and case.cage_model == NO_CAGE:
        raise InputError(
            "cage.model is 'none', but there is a cage; leave one of both out.", where="cage"
        )


def _find_in_rows(case: CaseSections) -> Iterator[Finding]:
    """A common cage that bends: it must be one body."""
    if case.cage is None or case.bearing.row_count == 1 or case.cage_model != "flexible":
        return
    yield from find_apart(case.cage, case.bearing.row_places)
    if case.mesh.file:
        yield (
            "mesh.file",
            "mesh.file is given, but a common cage of two rows that bends is meshed by flexcage; "
            'leave it out, or give model = "rigid" in [cage].',
        )


def _find_without_cage(case: CaseSections) -> Iterator[Finding]:
    """What a case without a cage cannot have."""
    for i, spec in enumerate(case.constraints):
        if spec.type.startswith("cage_"):
            yield (
                f"constraints.{i}.type",
                f"constraints.{i}.type is '{spec.type}', but cage.model is 'none'; leave it out.",
            )


def _check_cage_type(bearing: Bearing, cage: Cage) -> None:
    wanted: type[Cage] = bearing.cage_spec
    own = getattr(cage, "cage_type", "") == wanted.cage_type
    if not own and bearing.element not in cage_type_of(cage).holds:
        raise InputError(
            f"bearing.type is '{bearing.type}', whose cage is a {wanted.__name__}, but the case's "
            f"cage is a {type(cage).__name__}; give bearing and cage together, or take a preset.",
            where="cage",
        )


def check_static_case(case: StaticSections) -> None:
    """Raise InputError for the first thing that cannot be in the case of a static solution."""
    case.bearing.check()
    _raise_first(case, _OF_EVERY_CASE)


def _raise_first(case: Any, finders: Iterable[Callable[[Any], Iterator[Finding]]]) -> None:
    for find in finders:
        for where, sentence in find(case):
            raise InputError(sentence, where=where)


def refuse_without_motion(bearing: Any) -> None:
    """Raise InputError if a bearing, or a table of one, is of a type that cannot be simulated."""
    kind = type(bearing)
    if isinstance(bearing, Mapping):
        check_type(bearing.get("type"))
        kind = chosen_spec(Bearing, bearing)
    if issubclass(kind, Bearing) and not in_motion(kind):
        name = kind.__dataclass_fields__["type"].default
        raise InputError(
            f"bearing.type is '{name}', and the motion of {kind.kind}s is not computed yet; "
            "'flexcage static' gives their static solution.",
            where="bearing.type",
            value=name,
        )


def _find_infinite(spec: Any, where: str = "") -> Iterator[Finding]:
    """Infinite values, except where infinity is the default (no limit)."""
    for field in dataclasses.fields(spec):
        value, here = getattr(spec, field.name), join(where, field.name)
        for item in value if isinstance(value, tuple) else (value,):
            if dataclasses.is_dataclass(item):
                yield from _find_infinite(item, here)
            elif isinstance(item, float) and abs(item) == inf and default_of(field) != inf:
                yield here, f"{here} is infinite; give a finite value."


def _find_in_name(case: CaseSections) -> Iterator[Finding]:
    if wrong := unusable(case.name):
        yield "name", f"name is {wrong}."


def _find_in_materials(case: Any) -> Iterator[Finding]:
    for where in ("bearing.material", "bearing.element_material", "cage.material"):
        part, _, key = where.partition(".")
        material = getattr(getattr(case, part, None), key, None)
        if material is not None and material.density < _LEAST_DENSITY:
            here = f"{where}.density"
            yield (
                here,
                f"{here} is {describe(material.density, 'kg/m^3')}, far below that of any solid; "
                "a bare number is in kg/m^3: steel has 7850, polymers have about 1200.",
            )


def _find_in_temperature(case: CaseSections) -> Iterator[Finding]:
    temperature = case.its_cage.temperature
    if temperature is not None and case.modes.body:
        yield (
            "cage.temperature",
            f"cage.temperature is {describe(temperature, 'degC')}, but modes.body brings "
            "the stiffness; leave the temperature out, and give the body of the warm cage.",
        )


def _find_in_load(case: CaseSections) -> Iterator[Finding]:
    rating = case.bearing.static_rating
    load = case.load
    for where, value in (
        ("load.radial", load.radial),
        ("load.axial", abs(load.axial)),
        ("load.ramp_to", abs(load.ramp_to or 0.0)),
        ("load.values", max(map(abs, load.values), default=0.0)),
        ("load.wave_amplitude", abs(load.wave_amplitude)),
    ):
        if value > OVERLOAD * rating:
            yield (
                where,
                f"{where} is {describe(value, 'kN')}, but contacts are elastic, and steel gives "
                f"way: give {OVERLOAD:g} times the bearing's static rating of "
                f"{describe(round(rating, -2), 'kN')} (ISO 76) or less.",
            )


def _find_in_tilt(case: CaseSections) -> Iterator[Finding]:
    tilt, most = abs(case.load.misalignment), case.bearing.greatest_tilt
    beyond = "presses the rollers' ends into the races by more than 1 % of their diameter, and "
    beyond += "contacts are elastic"
    if case.bearing.self_aligning:
        beyond = f"moves {case.bearing.element}s over the edge of the outer race"
    if tilt > most:
        yield (
            "load.misalignment",
            f"load.misalignment is {describe(case.load.misalignment, 'mrad')}, which {beyond}; "
            f"give {describe(round(most, 4), 'mrad')} or less.",
        )


def _find_in_speed(case: CaseSections) -> Iterator[Finding]:
    drive, most = case.drive, greatest_speed(case.bearing)
    for where, value in (
        ("drive.speed", abs(drive.speed)),
        ("drive.ramp_to", abs(drive.ramp_to or 0.0)),
        ("drive.speeds", max(map(abs, drive.speeds), default=0.0)),
        ("drive.wave_amplitude", abs(drive.wave_amplitude)),
    ):
        if value > most:
            thousands = int(most * 30.0 / pi / 1e3)
            yield (
                where,
                f"{where} is {describe(value, 'rpm')}, where centrifugal force presses every "
                f"{case.bearing.element} on the outer race as hard as {OVERLOAD:g} times the "
                "bearing's static rating (ISO 76) would the most loaded one; give "
                f"{thousands}000 rpm or less.",
            )


def _find_in_held_motions(case: CaseSections) -> Iterator[Finding]:
    """Loads along motions of the inner ring that are held, and motions that cannot be free."""
    bears, tilt, spring = _bears_axially(case), case.load.tilt == "free", case.load.tilt_stiffness
    own = case.bearing.carries_axial_load and not case.bearing.self_aligning  # without springs
    if tilt and spring == 0.0 and not own:
        yield (
            "load.tilt",
            f"load.tilt is 'free', but nothing in the motion of a {case.bearing.kind} brings its "
            "inner ring back; give the shaft's load.tilt_stiffness, or take 'held'.",
        )
    if tilt and spring == 0.0 and case.load.misalignment != 0.0:
        yield (
            "load.misalignment",
            f"load.misalignment is {describe(case.load.misalignment, 'mrad')}, but load.tilt is "
            "'free'; take load.tilt = \"held\" for a tilt that is given, or give the "
            "load.tilt_stiffness of a shaft that is so tilted.",
        )
    yield from _find_in_shaft(case)
    yield from _find_in_held_centre(case)
    yield from _find_in_changes(case)
    shaft = "give the shaft's load.axial_stiffness"
    freed = 'take load.tilt = "free"' + ("" if own else " with the shaft's load.tilt_stiffness")
    for key, unit, free, held, remedy in (
        ("axial", "N", bears, "axial motion is", shaft),
        ("moment_y", "N*m", tilt, "tilts are", freed),
        ("moment_z", "N*m", tilt, "tilts are", freed),
    ):
        value = getattr(case.load, key)
        if value != 0.0 and not free:
            yield (
                f"load.{key}",
                f"load.{key} is {describe(value, unit)}, but in this run the inner ring's {held} "
                f"held; leave it out, {remedy}, or take 'flexcage static'.",
            )


def _bears_axially(case: CaseSections) -> bool:
    """Is the inner ring free along the axis in a run, with something that brings it back?"""
    return case.load.frees_axially(case.bearing)


def _find_in_axial_load(case: CaseSections) -> Iterator[Finding]:
    """Axial loads that neither the bearing nor its shaft carries."""
    load, where = case.load, "load.axial"
    if load.axial_stiffness > 0.0:
        return
    if load.varies == "axial" and (load.times or load.ramp_to is not None):
        where = "load.values" if load.times else "load.ramp_to"
    if load.wave_of == "axial" and load.wave != "none":
        where = "load.wave_amplitude"
    for force in load.axial_range:
        if refused := case.bearing.axial_refusal(force):
            says = "is" if where == "load.axial" else "makes the axial load"
            yield (
                where,
                f"{where} {says} {describe(force, 'N')}, but {refused}; leave it out, or give the "
                "shaft's load.axial_stiffness.",
            )


def _find_in_shaft(case: CaseSections) -> Iterator[Finding]:
    """Springs and dampers of the shaft that hold nothing, or too little."""
    load = case.load
    later = (load.ramp_to or 0.0, *load.values) if load.varies == "axial" else ()
    largest, most = max(map(abs, (load.axial, *later))), case.bearing.greatest_shift
    borne = not any(map(case.bearing.axial_refusal, load.axial_range))
    if load.axial_stiffness > 0.0 and largest > load.axial_stiffness * most and not borne:
        yield (
            "load.axial_stiffness",
            f"load.axial_stiffness is {describe(load.axial_stiffness, 'N/um')}, which lets "
            f"{describe(largest, 'N')} move the {case.bearing.element}s off the outer race; give "
            f"{describe(largest / most, 'N/um')} or more.",
        )
    if load.tilt_stiffness > 0.0 and load.tilt == "held":
        yield (
            "load.tilt_stiffness",
            f"load.tilt_stiffness is {describe(load.tilt_stiffness, 'N*m/rad')}, but load.tilt is "
            "'held'; leave it out, or take load.tilt = \"free\".",
        )
    for way, unit in (("axial", "N*s/m"), ("tilt", "N*m*s/rad")):
        damping = getattr(load, f"{way}_damping")
        if damping > 0.0 and getattr(load, f"{way}_stiffness") == 0.0:
            yield (
                f"load.{way}_damping",
                f"load.{way}_damping is {describe(damping, unit)}, but the shaft has no stiffness "
                f"that it goes with; give load.{way}_stiffness as well, or leave it out.",
            )


def _find_in_changes(case: CaseSections) -> Iterator[Finding]:
    """Axial loads that change over time where the inner ring's axial motion is held."""
    load = case.load
    changes = {"varies": load.ramp_to is not None or load.times, "wave_of": load.wave != "none"}
    for key, used in changes.items():
        if used and getattr(load, key) == "axial" and not _bears_axially(case):
            yield (
                f"load.{key}",
                f"load.{key} is 'axial', but in a run of a {case.bearing.kind} the inner ring's "
                "axial motion is held; take 'radial', or give the shaft's load.axial_stiffness.",
            )


def _find_in_held_centre(case: CaseSections) -> Iterator[Finding]:
    """What a ring whose centre is held cannot have: another integrator, loads that vary."""
    load, method = case.load, case.solver.method
    if load.centre == "free":
        return
    if method not in ("explicit", "auto"):
        yield (
            "load.centre",
            f"load.centre is 'held', which needs solver.method = \"explicit\", not {method!r}.",
        )
    for key, idle in (("ramp_to", None), ("times", ()), ("wave", "none")):
        if getattr(load, key) != idle:
            yield (
                f"load.{key}",
                f"load.{key} is {getattr(load, key)!r}, but load.centre is 'held': the load says "
                "where the ring stands and cannot vary; leave it out, or take load.centre = "
                '"free".',
            )


def _find_in_mesh(case: CaseSections) -> Iterator[Finding]:
    mesh, cage = case.mesh, case.its_cage
    for where, file in files_of(case).items():
        yield from _find_in_path(file, where)
    if mesh.file:
        return
    volume = 0.25 * pi * (cage.outside_diameter**2 - cage.bore**2) * cage.width
    arc = 2.0 * pi * case.bearing.element_count * cage.fillet  # four quarters a pocket
    surface = arc * 0.5 * (cage.outside_diameter - cage.bore)
    # a regular tetrahedron of edge a has the volume a^3/(6 sqrt 2), its face the area a^2 sqrt(3)/4
    for key, size, count in (
        ("size", mesh.size, 8.5 * volume / (mesh.size or 1.0) ** 3),
        ("fillet_size", mesh.fillet_size, 2.3 * surface / (mesh.fillet_size or 1.0) ** 2),
    ):
        if size is not None and count > _MOST_ELEMENTS:
            yield (
                f"mesh.{key}",
                f"mesh.{key} is {describe(size, 'mm')}, which makes about {count:.0e} elements of "
                f"this cage; give a size that makes {_MOST_ELEMENTS:.0e} or fewer.",
            )
    least = cage.thinnest(case.bearing.pitch_diameter, case.bearing.element_count)
    if mesh.size is not None and mesh.size > 2.0 * least:
        yield (
            "mesh.size",
            f"mesh.size is {describe(mesh.size, 'mm')}, but the cage's thinnest part is only "
            f"{describe(least, 'mm')}; give a size up to twice that.",
        )


def _find_in_mount(case: CaseSections) -> Iterator[Finding]:
    if case.mount.body and case.mount.kind != "fixed":
        yield (
            "mount.body",
            f"mount.body is given, but mount.kind is '{case.mount.kind}', and a housing takes its "
            "place; leave one of both out.",
        )


def _find_in_path(file: str, where: str) -> Iterator[Finding]:
    """A file whose name none can have; one that is not there is told of when it is read."""
    try:
        Path(file).stat()
    except (FileNotFoundError, NotADirectoryError):
        return
    except OSError as exc:
        reason = (exc.strerror or str(exc)).lower()
        yield where, f"{where} is '{file}', which cannot be looked up ({reason})."


def _find_in_tables(case: CaseSections) -> Iterator[Finding]:
    for room, values, name in (
        ("drive", case.drive.speeds, "speeds"),
        ("load", case.load.values, "values"),
    ):
        times = getattr(case, room).times
        if len(times) != len(values):
            yield (
                f"{room}.times",
                f"{room}.times has {len(times)} entries and {room}.{name} {len(values)}; a table "
                "needs as many of each.",
            )
        if len(times) == 1:
            yield f"{room}.times", f"{room}.times has one entry; a table needs two or more."
        for n, (early, late) in enumerate(zip(times, times[1:]), 1):
            if late <= early:
                yield (
                    f"{room}.times",
                    f"{room}.times must rise from entry to entry, but entry {n} is {late:g} s, "
                    f"after {early:g} s; sort the table, with its {name}.",
                )
                break


def _find_in_ramps(case: CaseSections) -> Iterator[Finding]:
    yield from _find_in_acceleration(case)
    for room in ("drive", "load"):
        spec = getattr(case, room)
        by_time = room == "load" or case.drive.acceleration is None
        if spec.ramp_to is not None and spec.ramp_time <= 0.0 and by_time:
            yield (
                f"{room}.ramp_time",
                f"{room}.ramp_to is given, but {room}.ramp_time is 0 s; say how long the ramp "
                f"takes{', or give drive.acceleration' if room == 'drive' else ''}.",
            )
        if spec.ramp_to is None and spec.ramp_time > 0.0:
            yield (
                f"{room}.ramp_to",
                f"{room}.ramp_time is given, but not where the ramp ends; give {room}.ramp_to.",
            )
        if spec.ramp_to is not None and spec.times:
            yield f"{room}.times", f"[{room}] has both a ramp and a table; keep one of them."


def not_reached(case: CaseSections) -> Iterator[str]:
    """Sentences on ramps and tables that begin when the run is over: no mistake in a short look at
    a case, but one to be told of."""
    end = case.solver.duration
    over = f"but the run ends at {describe(end, 'ms')}, so that"
    for room in ("drive", "load"):
        spec = getattr(case, room)
        if spec.ramp_to is not None and spec.ramp_start >= end:
            yield f"{room}.ramp_start is {describe(spec.ramp_start, 'ms')}, {over} nothing ramps."
        elif spec.times and spec.times[0] >= end:
            begin = describe(spec.times[0], "ms")
            yield f"{room}.times begins at {begin}, {over} its first value holds all along."


def _find_in_acceleration(case: CaseSections) -> Iterator[Finding]:
    """A ramp of speed takes its time or its acceleration, not both."""
    drive = case.drive
    if drive.acceleration is None:
        return
    if drive.ramp_to is None:
        yield (
            "drive.ramp_to",
            "drive.acceleration is given, but not where the ramp ends; give drive.ramp_to.",
        )
    if drive.ramp_time > 0.0:
        yield (
            "drive.acceleration",
            "drive.acceleration and drive.ramp_time are both given, but each says how long the "
            "ramp takes; keep one of them.",
        )


def _find_in_waves(case: CaseSections) -> Iterator[Finding]:
    for room in ("drive", "load"):
        spec = getattr(case, room)
        if spec.wave == "none":
            if spec.wave_amplitude != 0.0:
                yield (
                    f"{room}.wave",
                    f"{room}.wave_amplitude is given, but {room}.wave is 'none'; say which shape.",
                )
            continue
        least = 2.0 / case.output.rate
        if spec.wave_period < least:
            yield (
                f"{room}.wave_period",
                f"{room}.wave_period is {describe(spec.wave_period, 'ms')}, but two samples of "
                f"output.rate take {describe(least, 'ms')}; give a longer period.",
            )


def _find_in_solver(case: CaseSections) -> Iterator[Finding]:
    solver = case.solver
    if solver.min_step > solver.max_step:
        yield (
            "solver.min_step",
            f"solver.min_step is {describe(solver.min_step, 'us')}, but must not exceed "
            f"solver.max_step, {describe(solver.max_step, 'us')}.",
        )
    if not 1e-3 <= solver.newton_tolerance <= 1.0:
        yield (
            "solver.newton_tolerance",
            f"solver.newton_tolerance is {solver.newton_tolerance:g}, but rounding allows "
            "0.001 or more and convergence 1 or less, such as 0.3.",
        )
    least, most = _TOLERANCES
    if not least <= solver.tolerance <= most:
        why = "rounding is as large" if solver.tolerance < least else "contacts are no deeper"
        yield (
            "solver.tolerance",
            f"solver.tolerance is {describe(solver.tolerance, 'um')}, but {why}; give "
            f"{describe(least, 'um')} to {describe(most, 'um')}, such as 0.01 um.",
        )
    if round(solver.duration * case.output.rate) < 2:
        yield (
            "solver.duration",
            f"solver.duration is {describe(solver.duration, 'us')}, but must hold two samples of "
            f"output.rate or more, {describe(2.0 / case.output.rate, 'us')}.",
        )
    for key, rate in (("rate", case.output.rate), ("vibration_rate", case.output.vibration_rate)):
        if solver.duration * rate > _MOST_SAMPLES:
            yield (
                "solver.duration",
                f"solver.duration is {describe(solver.duration, 's')}, which makes "
                f"{solver.duration * rate:.0e} samples of output.{key}; give "
                f"{describe(_MOST_SAMPLES / rate, 's')} or less, or a lower rate.",
            )


def _find_in_output(case: CaseSections) -> Iterator[Finding]:
    output = case.output
    ratio = output.vibration_rate / output.rate
    if abs(ratio - round(ratio)) > 1e-9 * ratio or ratio < 1.0:
        yield (
            "output.vibration_rate",
            f"output.vibration_rate ({output.vibration_rate / 1e3:g} kHz) must be a whole multiple "
            f"of output.rate ({output.rate / 1e3:g} kHz), for instance "
            f"{max(round(ratio), 1) * output.rate / 1e3:g} kHz.",
        )


def _find_in_laws(case: CaseSections) -> Iterator[Finding]:
    places = ("race", "pocket", "side", "rib", "land")
    for place in places:
        spec = getattr(case.contacts, place)
        where, friction = f"contacts.{place}", spec.friction
        if friction.v_dynamic <= friction.v_static:
            yield (
                f"{where}.friction.v_dynamic",
                f"{where}.friction.v_dynamic is {describe(friction.v_dynamic, 'm/s')}, but must be "
                f"greater than v_static, {describe(friction.v_static, 'm/s')}.",
            )
        if friction.law == "traction" and not friction.high_speed < friction.peak:
            yield (
                f"{where}.friction.high_speed",
                f"{where}.friction.high_speed is {friction.high_speed:g}, but must be less than "
                f"the traction's peak, {friction.peak:g}.",
            )
        if spec.normal.law in ("impact", "impact_step") and spec.normal.damping == 0.0:
            yield (
                f"{where}.normal.damping",
                f"{where}.normal.law is {spec.normal.law}, but its damping is 0; give "
                f"{where}.normal.damping, or take the law 'elastic'.",
            )


def _find_in_land(case: CaseSections) -> Iterator[Finding]:
    land, guidance = case.contacts.land, case.its_cage.guidance
    if guidance in ("inner", "outer") and land.kind == "none":
        yield (
            "contacts.land.kind",
            f"cage.guidance is '{guidance}', but contacts.land.kind is 'none'; take "
            "'dry' or 'film'.",
        )
    if land.kind != "none":
        yield from _find_in_clearance(case)
        yield from _find_in_width(case)


def _find_in_clearance(case: CaseSections) -> Iterator[Finding]:
    """Clearances of the land that no dimensions give, or that they contradict."""
    where, given = "contacts.land.clearance", case.contacts.land.clearance
    guidance, ring = case.its_cage.guidance, case.bearing.land(case.its_cage)
    there = None if ring is None else ring.clearance
    if ring is None or there is None:
        if guidance in ("inner", "outer") and given is None:
            shoulder = f" or bearing.{guidance}_shoulder" if ring is not None else ""
            yield (
                where,
                f"cage.guidance is '{guidance}', but the case does not say how far the cage is "
                f"from the ring; give {where}{shoulder}.",
            )
    elif given is None and there <= 0.0:
        yield (
            where,
            f"{ring.of} leave no clearance for the cage's land, {describe(there, 'mm')}; change "
            "them" + ("." if ring.strict else f", or give {where}."),
        )
    elif given is not None and ring.strict and abs(given - there) > _LAND_TOLERANCE:
        yield (
            where,
            f"{where} is {describe(given, 'mm')}, but {ring.of} leave {describe(there, 'mm')}; "
            "leave it out, or change the dimensions.",
        )


def _find_in_width(case: CaseSections) -> Iterator[Finding]:
    """Lands wider than where cage and ring face each other, or a guided cage that faces none."""
    where, given = "contacts.land.width", case.contacts.land.width
    cage = case.its_cage
    ring, guided = case.bearing.land(cage), cage.guidance in ("inner", "outer")
    if ring is None:
        if guided and given is not None and given > 0.5 * cage.axial_width:
            yield (
                where,
                f"{where} is {describe(given, 'mm')}, but a cage {describe(cage.width, 'mm')} "
                f"wide has two lands; give {describe(0.5 * cage.axial_width, 'mm')} or less.",
            )
    elif ring.facing <= 0.0 and guided:
        yield (
            "cage.guidance",
            f"cage.guidance is '{cage.guidance}', but beside its pockets the cage does not "
            "face that ring; make it wider, or choose another guidance.",
        )
    elif given is not None and given > max(ring.facing, 0.0) * (1.0 + 1e-9):
        yield (
            where,
            f"{where} is {describe(given, 'mm')}, but beside the pockets an end of the cage faces "
            f"the ring over {describe(max(ring.facing, 0.0), 'mm')} only; give that or less, or "
            "leave it out.",
        )


def land_clearance_mismatch(case: CaseSections) -> Iterator[str]:
    """A sentence on a clearance that is not what the shoulder of the guiding ring leaves: no
    mistake, as the ring may have a land of its own, but one to know of."""
    given, ring = case.contacts.land.clearance, case.bearing.land(case.its_cage)
    if given is None or ring is None or ring.clearance is None or ring.strict:
        return
    if abs(given - ring.clearance) > _LAND_TOLERANCE:
        yield (
            f"contacts.land.clearance is {describe(given, 'mm')}, where {ring.of} leave "
            f"{describe(ring.clearance, 'mm')}: the cage's land is on another part of the ring"
        )


_OF_EVERY_CASE = (
    _find_infinite,
    _find_in_name,
    _find_in_materials,
    _find_in_tables,
    _find_in_ramps,
    _find_in_load,
    _find_in_tilt,
    _find_in_speed,
    find_in_rings,
    find_in_fit,
    find_in_life,
    find_in_heat,
)
_OF_CAGES = (_find_in_rows, _find_in_mesh, _find_in_temperature, _find_in_land)
