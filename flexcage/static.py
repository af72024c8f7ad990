"""The corridor of the static solution: case -> rolling elements -> equilibrium -> files."""

from __future__ import annotations

import logging
from dataclasses import replace
from math import nan
from pathlib import Path

import numpy as np

from flexcage.bearings import sections_of, statics_of
from flexcage.case import Case, StaticCase
from flexcage.case.plausibility import implausible_values
from flexcage.case.unread import not_used
from flexcage.contacts.spec import EhlTraction
from flexcage.core.binding import expect
from flexcage.core.errors import InputError, pictures_alone
from flexcage.core.listing import PAGE
from flexcage.core.writing import write_text
from flexcage.geometry.film import creep_speed
from flexcage.geometry.life.iso281 import reliability_factor
from flexcage.geometry.life.spec import Life
from flexcage.system.spec import Drive
from flexcage.system.statics.lives import combined_hours, limit_of, questioned_lives, rated
from flexcage.system.statics.options import AT_START, StaticOptions
from flexcage.system.statics.rated import Lives, RatedLife
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solve_bearing
from flexcage.system.statics.yielding import compliance_of, questioned

log = logging.getLogger(__name__)


def solve_static(case: StaticCase, *, options: StaticOptions | None = None) -> StaticSolution:
    """Equilibrium of the inner ring of a case, at the start of its drive and load.

    Tilts are held or free as in a run (load.tilt), unless the case's [static] says otherwise;
    ``options`` take the place of that section.
    Raises InputError for a load that the bearing cannot bear, RunFailed if none is found.
    """
    expect(case, (StaticCase, Case), "case", "flexcage.load_static reads one from a file")
    mounted = case.mounted
    bearing = mounted.bearing
    seat = compliance_of(case.mount, bearing)
    solution = solve_bearing(
        bearing, statics_of(bearing), load=mounted.load, speed=case.speed,
        contacts=case.contacts, lubricant=case.lubricant, options=options or case.static,
        rings=Rings(case.inner_ring, case.outer_ring, sections_of(bearing)),
        seat=seat,
    )  # fmt: skip
    unusual = (text for _, text in implausible_values(case))
    said = (*not_used(case), *unusual, *questioned(case.mount, bearing, seat))
    solution = replace(solution, mounting=case.mounting)
    if case.life.given:
        lives = lives_of(case, solution)
        said = (*said, *questioned_lives(lives, solution.ratings.dynamic))
        solution = replace(solution, lives=lives)
    return replace(solution, warnings=(*said, *solution.warnings)) if said else solution


def lives_of(case: StaticCase, solution: StaticSolution) -> Lives:
    """Lives as [life] asks, of a case's static solution and of its spectrum, each point by a static
    solution of its own. Raises InputError for a point whose load the bearing cannot bear."""
    life, bearing = case.life, case.mounted.bearing
    points = tuple(_at_point(case, k) for k in range(len(life.spectrum)))
    shares = tuple(point.share for point in life.spectrum)
    return Lives(
        reliability=life.reliability, reliability_factor=reliability_factor(life.reliability),
        contamination=life.contamination, fatigue_limit=limit_of(bearing, life),
        here=rated(bearing, solution, life, case.lubricant), shares=shares, points=points,
        combined=combined_hours(shares, points) if points else nan,
    )  # fmt: skip


def _at_point(case: StaticCase, k: int) -> RatedLife | None:
    """Life at a point of the spectrum; None of one that stands still."""
    point = case.life.spectrum[k]
    if point.speed == 0.0:
        return None
    steady = replace(
        case.load, radial=point.radial, axial=point.axial, ramp_to=None, ramp_time=0.0, times=(),
        values=(), wave="none", wave_amplitude=0.0,
    )  # fmt: skip
    try:
        own = case.replace(drive=Drive(speed=point.speed), load=steady, life=Life())
        solution = solve_static(own)
    except InputError as exc:
        raise InputError(f"In life.spectrum.{k}: {exc}", where="life.spectrum") from exc
    return rated(own.mounted.bearing, solution, case.life, own.lubricant, point.temperature)


def ehl_traction(
    case: StaticCase, *, limit: float = 0.06, shear_modulus: float = 50e6
) -> EhlTraction:
    """Traction law of the lubricant's film at the heaviest contacts of a case, for
    ``case.replace("contacts.race.friction", ehl_traction(case))``.

    Film thickness, pressure and speed are the static solution's, for a simulation's case as its run
    begins; the law's creep speed is the mean
    of those of the heaviest contact on either race. ``limit`` is the limiting shear stress over the
    pressure; ``shear_modulus`` [Pa] is that of the film with what the surfaces yield, an assumption
    of the order that disc machines show. Raises InputError for a bearing that stands still.
    """
    expect(case, StaticCase, "case", "flexcage.load_static reads one from a file")
    if case.speed == 0.0:
        raise InputError(
            "The bearing stands still at the start (drive.speed): without motion there is no film "
            "whose traction could be given.",
            where="drive.speed",
        )
    options = AT_START if isinstance(case, Case) else case.static
    bearing, solution = case.mounted.bearing, solve_static(case, options=options)
    balls = solution.elements
    entrained = bearing.rolling_entrainment(balls.angle, balls.orbital_speed, case.speed)
    found = []
    for race in range(2):
        k = int(np.argmax(balls.force[:, race]))
        pressure, half = bearing.contact_patch(balls.force[k, race], balls.pressure[k, race], race)
        found.append(
            creep_speed(
                limit=limit, pressure=pressure, film=float(solution.film.central[k, race]),
                half_length=half, speed=float(entrained[k, race]), oil=case.lubricant.oil,
                shear_modulus=shear_modulus,
            )
        )  # fmt: skip
    return EhlTraction(limit=limit, creep_speed=float(np.mean(found)))


def draw_ring(
    ring: BentRing, path: str | Path, *, scale: float | None = None,
    when: str = "in the static solution", name: str = "",
) -> Path:  # fmt: skip
    """Picture of a ring of a static solution, or of an instant of a run (``when``, in words), of
    the case ``name``: stress on its deformed shape (``scale`` times; chosen if not given),
    forces, and how far its race yields. Beneath the elements Hertz's own stress is not resolved."""
    from flexcage.render import ring_picture
    from flexcage.stress.rings import ring_field

    field = ring_field(ring)
    points = field.points().reshape(-1, 3)
    radial = 0 if ring.seated.reduction.raceway.line else 1  # the port of the radial force
    supports = ring.seated.support if len(ring.bears) else None
    return ring_picture(
        points, field.points(1.0).reshape(-1, 3) - points, field.quadrangles(),
        field.von_mises.ravel(), path, azimuth=ring.azimuth, force=ring.force[:, radial],
        deflection=ring.deflection[:, 1], support=supports, support_force=ring.support_force,
        title=f"{ring.side.capitalize()} ring {when}", scale=scale,
        name=name, note="stress beneath the elements is that of the ring, without Hertz's own",
    )  # fmt: skip


def write_static(case: StaticCase, solution: StaticSolution, folder: Path) -> list[Path]:
    """Write case.toml, static.txt, static.json and static.png into a folder, section.png of a
    bearing of rows, and a picture of every ring that bends; their paths.

    A machine that cannot draw costs the pictures alone.
    """
    written = write_static_numbers(case, solution, folder)
    with pictures_alone(log):
        written += draw_static(case, solution, folder)
    return written


def write_static_numbers(case: StaticCase, solution: StaticSolution, folder: Path) -> list[Path]:
    """Write case.toml, static.txt and static.json into a folder; their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / "case.toml", case.to_toml())
    write_text(folder / "static.txt", solution.table(PAGE) + "\n")
    solution.to_json(folder / "static.json")
    return [folder / name for name in ("case.toml", "static.txt", "static.json")]


def draw_static(case: StaticCase, solution: StaticSolution, folder: Path) -> list[Path]:
    """Draw static.png into a folder, section.png of a bearing of rows, and a picture of every ring
    that bends; their paths."""
    from flexcage.render import has_section, section_picture, static_picture

    e = solution.elements
    picture = static_picture(
        e.azimuth, e.force, e.angle, e.pressure, folder / "static.png", load=solution.load,
        title=solution.title, note=case.name, speed=solution.speed,
    )  # fmt: skip
    rings = [draw_ring(ring, folder / f"{ring.side}_ring.png", name=case.name)
             for ring in solution.rings]  # fmt: skip
    drawn = has_section(case.bearing)
    cut = [section_picture(case.bearing, folder / "section.png", note=case.name)] if drawn else []
    return [picture, *cut, *rings]
