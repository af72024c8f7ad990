"""Figures of the energy audit."""

from __future__ import annotations

from functools import partial
from math import isfinite

from flexcage.results.audit import EXCEEDED, OF_CAGE, OF_DRIVE, PASSED, UNJUDGED
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.system.data import POWERS

_KINDS = {"kinetic": "motion", "strain": "the cage's modes", "contact": "contacts",
          "mount": "shaft and housing springs"}  # fmt: skip


def _verdict(part: SettledRun) -> Found:
    bounds = f"at most {100.0 * OF_DRIVE:g} % of the drive's work"
    if part.caged:
        bounds += f", {100.0 * OF_CAGE:g} % of the cage's losses"
    note = {
        PASSED: bounds,
        UNJUDGED: "too little work to judge by",
        EXCEEDED: f"{bounds}: tighten solver.tolerance",
    }
    return Found(part.audit.verdict, note[part.audit.verdict])


def _stored(kind: str, part: SettledRun) -> Found | None:
    if kind not in part.audit.stored:
        return None
    idle = not part.run["energy"].sel(energy_kind=kind).values.any()
    return Found(part.audit.stored[kind], "whole run", idle=idle)


def _of_cage(part: SettledRun) -> Found:
    lacking = "" if isfinite(part.audit.of_cage) else ": too little"
    note = f"what pockets, lands and modes dissipate{lacking}"
    return Found(part.audit.of_cage, note, idle=not part.caged)


def _work(channel: str, part: SettledRun) -> Found | None:
    if channel not in part.audit.channels:
        return None
    idle = not part.run["work"].sel(channel=channel).values.any()
    return Found(part.audit.channels[channel], idle=idle)


# fmt: off
#: Of runs that record energy and work.
ENERGY = FigureTable[SettledRun]("Energy")
ENERGY.add("energy_audit", "Energy audit", "", "passed, exceeded or not judged",
           "text", "brief", "large", "effort", take=_verdict)
for _kind, _what in _KINDS.items():
    ENERGY.add(f"stored_{_kind}", f"Gained: {_kind}", "mJ",
               f"energy of {_what}, end less beginning", "signed", take=partial(_stored, _kind))
ENERGY.add("energy_moved", "Energy moved", "mJ", "sum of all energies and works, each positive",
           take=lambda part: Found(part.audit.moved, "whole run"))
ENERGY.add("energy_elastic", "Elastic energy, largest", "mJ", "in contacts, modes and springs",
           take=lambda part: part.audit.elastic)
ENERGY.add("energy_imbalance", "Energy imbalance, largest", "mJ", "energy gained less all work",
           take=lambda part: part.audit.worst)
ENERGY.add("energy_relative", "Energy imbalance / energy moved", "%", "of the whole run",
           take=lambda part: part.audit.relative)
ENERGY.add("energy_of_drive", "Energy imbalance / drive's work", "%", "the audit's first bound",
           "effort", take=lambda part: part.audit.of_drive)
ENERGY.add("energy_of_cage", "Energy imbalance / loss in the cage", "%", "the audit's second bound",
           "effort", take=_of_cage)
for _channel in POWERS:
    ENERGY.add(f"work_{_channel}", f"Work: {_channel.replace('_', ' ')}", "mJ",
               "on the bearing; losses are < 0", "signed", take=partial(_work, _channel))
