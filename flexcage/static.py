"""The corridor of the static solution: case -> rolling elements -> equilibrium -> files."""

from __future__ import annotations

import logging
from pathlib import Path

from flexcage.case import Case, StaticCase
from flexcage.core.errors import EnvironmentLacks
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solve_bearing

log = logging.getLogger(__name__)


def solve_static(case: StaticCase | Case) -> StaticSolution:
    """Equilibrium of the inner ring of a case, at the start of its drive and load.

    Of a simulation's case tilts are held or free as they are in the run, and no race controls
    balls.
    Raises InputError for a load that the bearing cannot bear, RunFailed if none is found.
    """
    if isinstance(case, Case):
        case = StaticCase(
            name=case.name, preset=case.preset, bearing=case.bearing, contacts=case.contacts,
            lubricant=case.lubricant, drive=case.drive, load=case.load,
            static=StaticOptions(tilt=case.load.tilt, gyroscopic="none"),
        )  # fmt: skip
    return solve_bearing(
        case.bearing, load=case.load, speed=case.speed, contacts=case.contacts,
        lubricant=case.lubricant, options=case.static,
    )  # fmt: skip


def write_static(case: StaticCase, solution: StaticSolution, folder: Path) -> list[Path]:
    """Write case.toml, static.txt, static.json and static.png into a folder; their paths.

    A machine that cannot draw costs the picture alone.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(case.to_toml(), encoding="utf-8")
    (folder / "static.txt").write_text(solution.table() + "\n", encoding="utf-8")
    solution.to_json(folder / "static.json")
    written = [folder / name for name in ("case.toml", "static.txt", "static.json")]
    try:
        from flexcage.render import static_picture

        e = solution.elements
        written.append(
            static_picture(
                e.azimuth, e.force, e.angle, e.pressure, folder / "static.png",
                load=solution.load, title=solution.title, speed=solution.speed,
            )
        )  # fmt: skip
    except EnvironmentLacks as exc:
        log.warning("no picture: %s", exc)
    return written
