"""Every key of a machine that a case has not: unit, default, meaning, read from its specs."""

from __future__ import annotations

import dataclasses

from flexcage.case.keys import Group, Key, of_spec
from flexcage.machine.spec import BearingPlace, Gravity, Housing, Shaft, Whirl

SECTION = "machine"
_SECTIONS = (
    Key("drive", "table", "at rest", "what turns the shaft, as in a case; [drive]"),
    Key("bearings.bearing, fit, mount, lubricant, contacts, life, heat, static", "tables", "",
        "sections of a bearing's case, which count before those of case, preset or designation; "
        "[bearings.fit] below its [[bearings]]"),
    Key("bearings.cage, defects, mesh, modes, start, limits, seed", "tables", "",
        "the same of what its run reads, as [bearings.cage]"),
    Key("solver, output", "tables", "", "integrator and samples of the machine's run, as in a "
        "case; [solver]"),
)  # fmt: skip


def groups_of_machines() -> list[Group]:
    """Keys of shaft, places of bearings, gravity and whirl, all of the section "machine"."""
    found = [*of_spec(SECTION, "shaft", "[shaft]", Shaft, None)]
    found += of_spec(SECTION, "", "[[bearings]]", BearingPlace, None)
    found += of_spec(SECTION, "gravity", "[gravity]", Gravity, Gravity())
    found += of_spec(SECTION, "housing", "[housing]", Housing, Housing())
    found += of_spec(SECTION, "whirl", "[whirl]", Whirl, Whirl())
    found = [dataclasses.replace(g, title=f"{g.title} of a machine") for g in found]
    return [*found, Group(SECTION, "Further sections of a machine", _SECTIONS)]
