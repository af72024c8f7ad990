"""Figures of forces: on pockets, on races, between neighbours; and how often contacts close."""

from __future__ import annotations

import numpy as np

from flexcage.results import metrics
from flexcage.results.contact_activity import EVENTS
from flexcage.results.figures.figure import (
    BRIEF,
    CAGED,
    CONVERGENCE,
    FULL,
    LARGE,
    SETTLING,
    STATISTIC,
    Found,
    Table,
)
from flexcage.results.figures.part import Part

FORCES = Table[Part]("Forces")


@FORCES.figure(
    "Pocket force, mean", "N", "of a pocket's face while in contact",
    CAGED, STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE,
)  # fmt: skip
def pocket_force_mean(part: Part) -> Found:
    total, faces, _ = part.pocket_series
    return Found(part.windows.ratio(total, faces), "while in contact")


@FORCES.figure(
    "Pocket forces, mean of sum", "N", "of all faces together", CAGED, STATISTIC, CONVERGENCE
)
def pocket_force_sum(part: Part) -> Found:
    return Found(part.windows.mean(part.pocket_series[0]))


@FORCES.figure(
    "Pocket force, peak of a pass", "N", "mean of the largest in each element pass",
    CAGED, STATISTIC, BRIEF, CONVERGENCE,
)  # fmt: skip
def pocket_force_pass_peak(part: Part) -> Found:
    return Found(part.windows.peak(part.pocket_series[2]), part.pass_peak)


@FORCES.figure("Pocket force, largest", "N", "largest of the settled part", CAGED, BRIEF, LARGE)
def pocket_force_peak(part: Part) -> Found:
    pocket = part.pockets
    face = f", {pocket.peak_face}" if part.ds.sizes["face"] > 1 else ""
    where = f"pocket {pocket.peak_pocket}{face}, t = {pocket.peak_time * 1e3:.3f} ms"
    return Found(pocket.peak, where if pocket.peak else "none is touched")


@FORCES.figure("Pocket force, largest / mean", "", "largest over mean while in contact", CAGED)
def pocket_force_ratio(part: Part) -> float:
    return part.pockets.ratio


@FORCES.figure("{Faces} in contact", "%", "share of faces and time", CAGED)
def pocket_contact(part: Part) -> Found:
    return Found(part.pockets.contact_share, "of the time")


@FORCES.figure("Inner race on an element, peak", "N", "largest normal force", BRIEF)
def race_force_inner(part: Part) -> float:
    return part.race_peaks["inner"]


@FORCES.figure("Outer race on an element, peak", "N", "largest normal force", BRIEF)
def race_force_outer(part: Part) -> float:
    return part.race_peaks["outer"]


CONTACTS = Table[Part]("Contacts of the cage", needs=CAGED)


@CONTACTS.figure(
    "Contacts begun, mean of a pocket", "Hz",
    "contacts with elements begun in a second; every face counts", STATISTIC,
)  # fmt: skip
def contact_frequency(part: Part) -> Found:
    source = "to a step of the solver"
    if part.contacts.source != EVENTS:
        source = f"at samples, {part.rate}, that miss shorter ones"
    each = part.contacts.begun / part.ds.sizes["pocket"]
    return Found(part.windows.mean(each), f"counted {source}")


@CONTACTS.figure("Contacts begun, all pockets", "Hz", "of all pockets together", STATISTIC)
def contact_frequency_total(part: Part) -> Found:
    return Found(part.windows.mean(part.contacts.begun))


@CONTACTS.figure(
    "Free flight", "%", "share of the time in which no pocket and no land touches the cage",
    STATISTIC,
)  # fmt: skip
def free_flight_share(part: Part) -> Found:
    note = "of the time: no pocket and no land touches the cage"
    return Found(part.windows.mean(part.contacts.free), note)


NEXT = Table[Part]("Contacts of neighbours")


@NEXT.figure(
    "Force on the next {element}, mean", "N", "of an element while it touches the next one",
    FULL, STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE,
)  # fmt: skip
def neighbour_force_mean(part: Part) -> Found:
    touching = part.neighbours > metrics.TOUCHING
    summed = np.where(touching, part.neighbours, 0.0).sum(axis=1)
    return Found(part.windows.ratio(summed, touching.sum(axis=1)), "while in contact")


@NEXT.figure(
    "Force on the next {element}, peak of a pass", "N", "mean of the largest in each element pass",
    FULL, STATISTIC, BRIEF, CONVERGENCE,
)  # fmt: skip
def neighbour_force_pass_peak(part: Part) -> Found:
    return Found(part.windows.peak(part.neighbours.max(axis=1)), part.pass_peak)


@NEXT.figure("Force on the next {element}, largest", "N", "largest of the settled part", FULL,
             BRIEF, LARGE)  # fmt: skip
def neighbour_force_peak(part: Part) -> Found:
    force = part.neighbours
    sample, element = np.unravel_index(int(np.argmax(force)), force.shape)
    where = f"{part.element} {element}, {part.at(int(sample))}, at the samples"
    return Found(float(force.max()), where if force.any() else "none touches")


@NEXT.figure("{Element}s that touch the next one", "%", "share of elements and time", FULL)
def neighbour_contact(part: Part) -> Found:
    return Found(float((part.neighbours > metrics.TOUCHING).mean()), "of the time")


@NEXT.figure(
    "Largest gap between {element}s, mean", "mm",
    "between neighbours, along the pitch circle; mean over time", FULL, STATISTIC,
)  # fmt: skip
def largest_gap(part: Part) -> Found:
    return Found(part.windows.mean(metrics.gaps(part.ds, part.bearing).max(axis=1)))


@NEXT.figure(
    "{Element}s touching the next one", "",
    "times in the settled part that an element met the next one; with a cage shown if there are "
    "any",
)  # fmt: skip
def element_touches(part: Part) -> Found:
    if part.events is None:
        closed = part.neighbours > 0.0
        count = int((closed[1:] & ~closed[:-1]).sum())
    else:
        time, place = part.events["time"].values, part.events["place"].values.astype(str)
        begin, end = (float(part.ds["time"][k]) for k in (0, -1))
        begun = part.events["closed"].values & np.char.startswith(place, "next ")
        count = int((begun & (time >= begin) & (time <= end)).sum())
    return Found(count, idle=count == 0 and part.caged)
