"""Figures of the energy audit."""

from __future__ import annotations

from functools import partial
from math import isfinite

from flexcage.results import audit
from flexcage.results.figures.figure import BRIEF, EFFORT, LARGE, SIGNED, TEXT, Found, Table
from flexcage.results.figures.part import Part
from flexcage.system.data import POWERS

_KINDS = {"kinetic": "motion", "strain": "the cage's modes", "contact": "contacts",
          "mount": "shaft and housing springs"}  # fmt: skip

#: Of runs that record energy and work.
ENERGY = Table[Part]("Energy")


@ENERGY.figure("Energy audit", "", "passed, exceeded or not judged", TEXT, BRIEF, LARGE, EFFORT)
def energy_audit(part: Part) -> Found:
    bounds = f"at most {100.0 * audit.OF_DRIVE:g} % of the drive's work"
    if part.caged:
        bounds += f", {100.0 * audit.OF_CAGE:g} % of the cage's losses"
    verdict = part.audit.verdict
    note = {
        audit.PASSED: bounds,
        audit.UNJUDGED: "too little work to judge by",
        audit.EXCEEDED: f"{bounds}: tighten solver.tolerance",
    }[verdict]
    return Found(verdict, note)


def _stored(kind: str, part: Part) -> Found | None:
    if kind not in part.audit.stored:
        return None
    idle = not part.run["energy"].sel(energy_kind=kind).values.any()
    return Found(part.audit.stored[kind], "whole run", idle=idle)


for _kind, _what in _KINDS.items():
    ENERGY.add(
        f"stored_{_kind}", f"Gained: {_kind}", "mJ", f"energy of {_what}, end less beginning",
        SIGNED, take=partial(_stored, _kind),
    )  # fmt: skip


@ENERGY.figure("Energy moved", "mJ", "sum of all energies and works, each positive")
def energy_moved(part: Part) -> Found:
    return Found(part.audit.moved, "whole run")


@ENERGY.figure("Elastic energy, largest", "mJ", "in contacts, modes and springs")
def energy_elastic(part: Part) -> float:
    return part.audit.elastic


@ENERGY.figure("Energy imbalance, largest", "mJ", "energy gained less all work")
def energy_imbalance(part: Part) -> float:
    return part.audit.worst


@ENERGY.figure("Energy imbalance / energy moved", "%", "of the whole run")
def energy_relative(part: Part) -> float:
    return part.audit.relative


@ENERGY.figure("Energy imbalance / drive's work", "%", "the audit's first bound", EFFORT)
def energy_of_drive(part: Part) -> float:
    return part.audit.of_drive


@ENERGY.figure("Energy imbalance / loss in the cage", "%", "the audit's second bound", EFFORT)
def energy_of_cage(part: Part) -> Found:
    lacking = "" if isfinite(part.audit.of_cage) else ": too little"
    note = f"what pockets, lands and modes dissipate{lacking}"
    return Found(part.audit.of_cage, note, idle=not part.caged)


def _work(channel: str, part: Part) -> Found | None:
    if channel not in part.audit.channels:
        return None
    idle = not part.run["work"].sel(channel=channel).values.any()
    return Found(part.audit.channels[channel], idle=idle)


for _channel in POWERS:
    ENERGY.add(
        f"work_{_channel}", f"Work: {_channel.replace('_', ' ')}", "mJ",
        "on the bearing; losses are < 0", SIGNED, take=partial(_work, _channel),
    )  # fmt: skip
