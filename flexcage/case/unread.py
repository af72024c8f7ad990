"""Values that a user gave and nothing reads: named once, in one sentence.

Specs say which of their own values make another one count (``core.unread``); what depends on other
sections of the case stands here.
"""

from __future__ import annotations

from collections.abc import Iterator

from flexcage.case.sections import OF_CAGE, CaseSections, StaticSections
from flexcage.core.unread import unread, why_unread
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage

_WORDS = ("name", "description", "preset", "heat", "static", "given")  # for people, or no run
_RIGID = "cage.model is 'rigid'"
_NEVER = {  # of materials beside the cage's, whose strength and damping no figure needs
    "proof_stress": "no strength of rings and rolling elements is computed",
    "loss_factor": "rings and rolling elements have no modal damping",
}


def reasons(case: StaticSections) -> dict[str, str]:
    """Dotted paths of values that nothing reads in such a case, and why: half a sentence. The path
    of a section stands for all values in it."""
    found = dict(unread(case))
    for rule in (_in_contacts, _in_materials, _in_loads, _by_fit):
        found.update(rule(case))
    if isinstance(case, CaseSections):  # a static solution is one of no cage
        found.update(_of_no_cage() if case.cage is None else _of_cage(case, case.cage))
    if case.mount.body:  # whose damping it is
        found.pop("outer_ring.relaxation", None)
    return found


def not_used(case: StaticSections) -> Iterator[str]:
    """A sentence on all values that were given and that nothing reads; none if all are read.

    A rigid cage leaves those of a flexible one alone: a comparison runs one case as both.
    """
    why, by_reason = reasons(case), dict[str, list[str]]()
    given = {path for path in case.given or () if path.partition(".")[0] not in _WORDS}
    given.discard("cage.model")
    for path in sorted(given):
        reason = why_unread(path, why)
        if reason and reason != _RIGID:
            by_reason.setdefault(reason, []).append(path)
    if by_reason:
        parts = [f"{', '.join(paths)} ({reason})" for reason, paths in by_reason.items()]
        yield f"Given, but not used: {'; '.join(parts)}."


def _in_contacts(case: StaticSections) -> Iterator[tuple[str, str]]:
    bearing = case.bearing
    for place in ("race", "pocket", "side", "rib"):
        if place not in bearing.places:
            article = "an" if bearing.kind[0] in "aeiou" else "a"
            yield f"contacts.{place}", f"{article} {bearing.kind} has no such contact"
        elif place not in bearing.sliced:
            yield f"contacts.{place}.slices", f"{bearing.element}s touch there in points"


def _of_no_cage() -> Iterator[tuple[str, str]]:
    for path in (
        *OF_CAGE, "start.push", "start.seed", "limits.stress", "output.keep_cage",
        "contacts.pocket", "contacts.side", "contacts.land",
    ):  # fmt: skip
        yield path, "cage.model is 'none'"


def _of_cage(case: CaseSections, cage: Cage) -> Iterator[tuple[str, str]]:
    yield "cage.material.expansion", "cages do not grow with temperature"
    if case.bearing.row_count == 1:
        yield "cage.rows", f"the bearing has one row of {case.bearing.element}s"
    yield from _on_lands(case.bearing, cage)
    yield from _of_a_rigid_cage(case)
    if not cage.has_faces:
        why = "the cage's pockets are round"
        yield "modes.attachments", why
        yield "modes.crossbeams", why


def _on_lands(bearing: Bearing, cage: Cage) -> Iterator[tuple[str, str]]:
    if bearing.land(cage) is None:
        why = f"no ring guides the cage: cage.guidance is '{cage.guidance}'"
        if any(stop is not None for stop in bearing.stops(cage)):
            yield "contacts.land.clearance", why
            yield "contacts.land.width", why
        else:
            yield "contacts.land", f"the cage meets no land: cage.guidance is '{cage.guidance}'"


def _in_materials(case: StaticSections) -> Iterator[tuple[str, str]]:
    for name, why in _NEVER.items():
        yield f"bearing.material.{name}", why
        yield f"bearing.element_material.{name}", why
        for ring in ("inner_ring", "outer_ring"):
            yield f"{ring}.material.{name}", why
    for ring in ("inner_ring", "outer_ring"):
        yield f"{ring}.material.density", "rings have the mass that bearing.material gives them"


def _of_a_rigid_cage(case: CaseSections) -> Iterator[tuple[str, str]]:
    if case.cage_model == "rigid":
        for path in ("modes", "mesh.order", "limits.stress", "output.keep_cage"):
            yield path, _RIGID
        yield "cage.material.loss_factor", _RIGID
        yield "cage.material.proof_stress", _RIGID
    elif case.modes.damping is not None or case.modes.ratios:
        given = "damping" if case.modes.damping is not None else "ratios"
        yield "cage.material.loss_factor", f"modes.{given} is given"


def _by_fit(case: StaticSections) -> Iterator[tuple[str, str]]:
    if case.fit.clearance is not None:
        yield "bearing.radial_clearance", "fit.clearance gives it"
    if not any(case.fit.warmth.values()):
        for where in ("bearing.material", "fit.shaft_material", "fit.housing_material"):
            yield f"{where}.expansion", "[fit] has no temperatures that differ"


def _in_loads(case: StaticSections) -> Iterator[tuple[str, str]]:
    load = case.load
    if load.times:
        yield f"load.{load.varies}", "load.times is given"
    oscillates = load.wave != "none" and load.wave_of == "radial"
    changes = (load.ramp_to is not None or load.times) and load.varies == "radial"
    if not (load.radial or oscillates or changes):
        yield "load.direction", "there is no radial load"
