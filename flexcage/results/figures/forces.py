"""Figures of forces: on pockets, on races, between neighbours; and how often contacts close."""

from __future__ import annotations

import numpy as np

from flexcage.results import metrics
from flexcage.results.contact_activity import EVENTS
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.metrics import TOUCHING


def _peak(part: SettledRun) -> Found:
    pocket = part.pockets
    face = f", {pocket.peak_face}" if part.ds.sizes["face"] > 1 else ""
    where = f"pocket {pocket.peak_pocket}{face}, t = {pocket.peak_time * 1e3:.3f} ms"
    return Found(pocket.peak, where if pocket.peak else "none is touched")


# fmt: off
FORCES = FigureTable[SettledRun]("Forces")
FORCES.add("pocket_force_mean", "Pocket force, mean", "N", "of a pocket's face while in contact",
           "a cage", "statistic", "brief", "large", "settling", "convergence",
           take=lambda part: Found(part.windows.ratio(*part.pocket_series[:2]),
                                   "while in contact"))
FORCES.add("pocket_force_sum", "Pocket forces, mean of sum", "N", "of all faces together",
           "a cage", "statistic", "convergence",
           take=lambda part: part.windows.mean(part.pocket_series[0]))
FORCES.add("pocket_force_pass_peak", "Pocket force, peak of a pass", "N",
           "mean of the largest in each element pass",
           "a cage", "statistic", "brief", "convergence",
           take=lambda part: Found(part.windows.peak(part.pocket_series[2]), part.pass_peak))
FORCES.add("pocket_force_peak", "Pocket force, largest", "N", "largest of the settled part",
           "a cage", "brief", "large", take=_peak)
FORCES.add("pocket_force_ratio", "Pocket force, largest / mean", "",
           "largest over mean while in contact", "a cage", take=lambda part: part.pockets.ratio)
FORCES.add("pocket_contact", "{Faces} in contact", "%", "share of faces and time", "a cage",
           take=lambda part: Found(part.pockets.contact_share, "of the time"))
FORCES.add("race_force_inner", "Inner race on an element, peak", "N", "largest normal force",
           "brief", take=lambda part: part.race_peaks["inner"])
FORCES.add("race_force_outer", "Outer race on an element, peak", "N", "largest normal force",
           "brief", take=lambda part: part.race_peaks["outer"])
# fmt: on


def _frequency(part: SettledRun) -> Found:
    source = "to a step of the solver"
    if part.contacts.source != EVENTS:
        source = f"at samples, {part.rate}, that miss shorter ones"
    each = part.contacts.begun / part.ds.sizes["pocket"]
    return Found(part.windows.mean(each), f"counted {source}")


# fmt: off
CONTACTS = FigureTable[SettledRun]("Contacts of the cage", "a cage")
CONTACTS.add("contact_frequency", "Contacts begun, mean of a pocket", "Hz",
             "contacts with elements begun in a second; every face counts", "statistic",
             take=_frequency)
CONTACTS.add("contact_frequency_total", "Contacts begun, all pockets", "Hz",
             "of all pockets together", "statistic",
             take=lambda part: part.windows.mean(part.contacts.begun))
CONTACTS.add("free_flight_share", "Free flight", "%",
             "share of the time in which no pocket and no land touches the cage", "statistic",
             take=lambda part: Found(part.windows.mean(part.contacts.free),
                                     "of the time: no pocket and no land touches the cage"))
# fmt: on


def _next_mean(part: SettledRun) -> Found:
    touching = part.neighbours > TOUCHING
    summed = np.where(touching, part.neighbours, 0.0).sum(axis=1)
    return Found(part.windows.ratio(summed, touching.sum(axis=1)), "while in contact")


def _next_peak(part: SettledRun) -> Found:
    force = part.neighbours
    sample, element = np.unravel_index(int(np.argmax(force)), force.shape)
    time = float(part.ds["time"][sample]) * 1e3
    where = f"{part.element} {element}, t = {time:.3f} ms, at the samples"
    return Found(float(force.max()), where if force.any() else "none touches")


def _gaps(part: SettledRun) -> np.ndarray:
    """How far (time, element) [m] the next element is from every one, along the pitch circle; below
    zero by what two are pressed together."""
    psi = part.ds["element_position"].sel(cyl="psi").transpose("time", "element").values
    following, more = metrics.following_in_row(part.ds)
    ahead = psi[:, following] + more - psi
    half = 0.5 * part.bearing.pitch_diameter
    return np.asarray(half * (ahead - 2.0 * np.arcsin(0.5 * part.bearing.element_diameter / half)))


def _touches(part: SettledRun) -> Found:
    if part.events is None:
        closed = part.neighbours > 0.0
        count = int((closed[1:] & ~closed[:-1]).sum())
    else:
        time, place = part.events["time"].values, part.events["place"].values.astype(str)
        begin, end = (float(part.ds["time"][k]) for k in (0, -1))
        begun = part.events["closed"].values & np.char.startswith(place, "next ")
        count = int((begun & (time >= begin) & (time <= end)).sum())
    return Found(count, idle=count == 0 and part.caged)


# fmt: off
#: Of runs whose elements may touch each other.
NEXT = FigureTable[SettledRun]("Contacts of neighbours")
NEXT.add("neighbour_force_mean", "Force on the next {element}, mean", "N",
         "of an element while it touches the next one",
         "full complement", "statistic", "brief", "large", "settling", "convergence",
         take=_next_mean)
NEXT.add("neighbour_force_pass_peak", "Force on the next {element}, peak of a pass", "N",
         "mean of the largest in each element pass",
         "full complement", "statistic", "brief", "convergence",
         take=lambda part: Found(part.windows.peak(part.neighbours.max(axis=1)), part.pass_peak))
NEXT.add("neighbour_force_peak", "Force on the next {element}, largest", "N",
         "largest of the settled part", "full complement", "brief", "large", take=_next_peak)
NEXT.add("neighbour_contact", "{Element}s that touch the next one", "%",
         "share of elements and time", "full complement",
         take=lambda part: Found(float((part.neighbours > TOUCHING).mean()), "of the time"))
NEXT.add("largest_gap", "Largest gap between {element}s, mean", "mm",
         "between neighbours, along the pitch circle; mean over time",
         "full complement", "statistic",
         take=lambda part: part.windows.mean(_gaps(part).max(axis=1)))
NEXT.add("element_touches", "{Element}s touching the next one", "",
         "times in the settled part that an element met the next one; with a cage shown if there "
         "are any", take=_touches)
