"""Why a claim holds or not: what the study's figures show, in words, by key and outcome.

Every number is taken from the figures when the text is written; a text that speaks of a variation
is left out where that was not computed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite, pi

from n1013_view import (
    AFTER,
    AT,
    BEFORE,
    BENT1,
    BENT2,
    LINE_AT,
    LINE_SHARE,
    LONGER,
    PITCH,
    REACH,
    RIGID,
    RIPPLE,
    SHORTER,
    SOUND,
    SPIKES,
    STRESS,
    WHIRL,
    View,
    shown,
    slip,
    spin,
    written,
)

from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED

Reason = Callable[[View], str]
PUSH = "pocket_force[pocket=4,face=front].mean"
PUSH_AT = "pocket_force[pocket=5,face=front].mean"
SQUEEZED = "Cq - Dw 0.15"  # the variation in which 0.2 mm pinches roller j-1


def figure(view: View, output: str, cage: str) -> str:
    """A figure with its margin and unit."""
    return written(shown(output, cage, view(output, cage)))


def row(view: View, output: str, *cages: str) -> str:
    """One figure of several cages, in their order."""
    return ", ".join(figure(view, output, cage) for cage in cages)


def change(view: View, output: str, cage: str, *, of: str = SOUND) -> str:
    """How far a figure differs from the sound cage's, with its margin."""
    ratio = view(output, cage) / view(output, of)
    percent = round(100.0 * (ratio.value - 1.0), 1) + 0.0  # no minus before a zero
    return f"{percent:+.1f} ± {100.0 * ratio.margin:.1f} %"


def orders(view: View, output: str, *cages: str) -> str:
    """Frequencies as multiples of the cage's own."""
    turns = [view("cage_speed", cage).value / (2.0 * pi) for cage in cages]
    return ", ".join(f"{view(output, c).value / n:.2f}" for c, n in zip(cages, turns))


def _when_squeezed(view: View, text: Reason) -> str:
    """A sentence on the variation in which the crossbeam pinches its roller, if it was computed."""
    there = View(view.rows, SQUEEZED)
    known = isfinite(there(slip(BEFORE), BENT2).value) and isfinite(there(STRESS, SOUND).value)
    return f" {text(there)}" if known else ""


def _stress_rise(v: View) -> str:
    return (
        "At the base clearances a crossbeam moved by 0.2 mm leaves its roller just free. The "
        f"hardest blow in any pocket is {row(v, 'pocket_force_peak', SOUND, BENT2)} (sound, "
        "0.2 mm), but the cage's stress comes from pushes and the land all around it: against the "
        f"sound cage its mean changes by {change(v, STRESS, BENT1)} at 0.1 mm and "
        f"{change(v, STRESS, BENT2)} at 0.2 mm."
    ) + _when_squeezed(
        v,
        lambda w: (
            "Where 0.2 mm is more than the clearance, the pinched pocket sets the stress: "
            f"{row(w, STRESS, SOUND, BENT1, BENT2)}."
        ),
    )


def _radial(v: View) -> str:
    return (
        "The rollers that leave the load push the cage onto the land, where it stays: its centre "
        f"is {figure(v, 'cage_radial_displacement.mean', SOUND)} from the axis, and that distance "
        f"can hardly vary ({row(v, REACH, SOUND, BENT1, BENT2)}). What the moved crossbeam adds is "
        "a swing along the land, which the whirl radius shows (000-3)."
    )


def _whirl(v: View) -> str:
    return (
        "The moved crossbeam is reached by roller j-1 before its neighbours reach theirs, and that "
        f"roller drives the cage alone for a part of every turn (its mean push: "
        f"{row(v, PUSH, SOUND, BENT1, BENT2)}; roller j's: {row(v, PUSH_AT, SOUND, BENT1, BENT2)})."
        " The further it is ahead the wider the cage swings along the land: the whirl radius goes "
        f"on growing, {row(v, WHIRL, SOUND, BENT1, BENT2)}."
    ) + _when_squeezed(
        v, lambda w: f"Where 0.2 mm pinches the roller: {row(w, WHIRL, SOUND, BENT1, BENT2)}."
    )


def _if_rigid(v: View) -> str:
    """How hard a rigid cage strikes, if that was computed."""
    rigid = View(v.rows, RIGID)
    if not isfinite(rigid(SPIKES, BENT2).value):
        return ""
    return (
        " An elastic cage softens the blows: with a rigid one a moved crossbeam does make them "
        f"felt, {row(rigid, SPIKES, SOUND, BENT1, BENT2)} (sound, 0.1 and 0.2 mm)."
    )


def _spikes(v: View) -> str:
    return (
        "Blows in pockets reach the outer ring only through a roller that the cage strikes, and "
        "at the base clearances it feels no more of them, beyond the intervals, than in a sound "
        "cage: "
        "the kurtosis of the ring's acceleration is "
        f"{row(v, SPIKES, SOUND, BENT1, BENT2, LONGER)}. The roller that cannot turn in its "
        f"pocket does make spikes: {figure(v, SPIKES, SHORTER)}."
    ) + _if_rigid(v)


def _ripple(v: View) -> str:
    line = "cage_omega[axis=x].frequency"
    return (
        "A sound cage is driven in bursts of no fixed order "
        f"({orders(v, line, SOUND)} times its own frequency). One crossbeam that meets its roller "
        f"first ties the bursts to its turns (orders {orders(v, line, BENT1, BENT2)}) and makes "
        f"them smaller, not larger: {row(v, RIPPLE, SOUND, BENT1, BENT2)}."
    ) + _when_squeezed(
        v,
        lambda w: (
            "Where 0.2 mm pinches the roller the ripple is "
            f"{row(w, RIPPLE, SOUND, BENT2)} (sound, 0.2 mm), its mean frequency "
            f"{row(w, PITCH, SOUND, BENT2)}."
        ),
    )


def _roller_before(v: View) -> str:
    return (
        "A clearance of 0.20 mm less 0.2 mm pinches nothing: roller j-1 touches both crossbeams, "
        "and rolls on. It leads the cage where the others follow it (its mean push "
        f"{row(v, PUSH, SOUND, BENT1, BENT2)}) and slips less "
        f"({row(v, slip(BEFORE), SOUND, BENT1, BENT2)}), while roller j, whose rear crossbeam has "
        "moved away and catches it later, slips a little more "
        f"({row(v, slip(AT), SOUND, BENT1, BENT2)})."
    ) + _when_squeezed(
        v,
        lambda w: (
            "The drop at 0.2 mm comes as soon as the displacement exceeds the clearance: at "
            "Cq - Dw = 0.15 mm friction of the pinched pocket holds the roller in the cage, its "
            f"speed goes from {figure(w, spin(BEFORE), SOUND)} to "
            f"{figure(w, spin(BEFORE), BENT2)} and its slip from "
            f"{figure(w, slip(BEFORE), SOUND)} to {figure(w, slip(BEFORE), BENT2)}."
        ),
    )


def _side_stress(v: View) -> str:
    return (
        "A longer pocket changes nothing, since its roller is held by the ribs of the ring and "
        f"hardly meets the side beams ({change(v, STRESS, LONGER)}). A shorter one pinches the "
        f"roller with {figure(v, 'pocket_force[pocket=5,face=side+x].mean', SHORTER)} on average, "
        "a self-equilibrated pair that bends both side beams and does not change with the turning "
        f"of the cage: the stress stands at {figure(v, STRESS, SHORTER)}."
    )


def _sinusoid(v: View) -> str:
    return (
        "The pinched roller cannot turn in its pocket, slides on the races and pushes the cage "
        f"with {figure(v, PUSH_AT, SHORTER)} on average, in a direction that turns with the cage: "
        "the centre circles once a turn (whirl speed over cage speed "
        f"{v('whirl_speed_ratio', SHORTER).value:.2f}). Along the load its strongest line is of "
        f"order {orders(v, LINE_AT, SHORTER)} of the cage's turns and holds "
        f"{figure(v, LINE_SHARE, SHORTER)} of the variance (sound cage: "
        f"{figure(v, LINE_SHARE, SOUND)})."
    )


def _orbit(v: View) -> str:
    return (
        "The longer pocket does nothing, for the side beams are hardly met "
        f"({change(v, WHIRL, LONGER)} of whirl radius). The shorter one makes a regular whirl, but "
        f"a large one: {figure(v, WHIRL, SHORTER)} instead of {figure(v, WHIRL, SOUND)}, since the "
        "locked roller carries the cage around, where the sound cage lies still on the land."
    )


def _side_ripple(v: View) -> str:
    return (
        f"At +0.3 mm nothing changes ({change(v, RIPPLE, LONGER)}): the side beams are hardly met. "
        f"At -0.3 mm the locked roller drags and drives the cage once a turn: the ripple grows to "
        f"{figure(v, RIPPLE, SHORTER)} from {figure(v, RIPPLE, SOUND)}, at a lower, not a higher, "
        f"mean frequency ({row(v, PITCH, SOUND, SHORTER)})."
    )


def _stop(v: View) -> str:
    return (
        "Two side beams that press with kilonewtons hold the roller by friction harder than the "
        f"races can turn it: it turns with the cage ({figure(v, spin(AT), SHORTER)} against "
        f"{figure(v, spin(AT), SOUND)} rolling, and in the other sense) and slides on both races."
    )


def _spread(v: View) -> str:
    return (
        "The locked roller drags the cage and through it its neighbours: the slip of roller j-1 "
        f"changes by {change(v, slip(BEFORE), SHORTER)}, that of roller j+1 by "
        f"{change(v, slip(AFTER), SHORTER)}. A crossbeam moved by 0.2 mm changes that of rollers j "
        f"and j+1 by {change(v, slip(AT), BENT2)} and {change(v, slip(AFTER), BENT2)}."
    )


_TEXTS: Mapping[str, Reason] = {
    "000-1": _stress_rise,
    "000-2": _radial,
    "000-3": _whirl,
    "000-4": _spikes,
    "000-5": _ripple,
    "000-6": _roller_before,
    "000-7": _roller_before,
    "000-8": _side_stress,
    "000-9": _sinusoid,
    "000-10": _orbit,
    "000-11": _side_ripple,
    "000-12": _stop,
    "000-13": _spread,
}

#: Texts by claim and the outcome that they explain. Should a later program find another outcome,
#: the verdict has no reason rather than a wrong one.
EXPLAINED: Mapping[str, tuple[str, ...]] = {
    "000-1": (UNDECIDED, FAILS),
    "000-2": (FAILS,),
    "000-3": (FAILS,),
    "000-4": (UNDECIDED, FAILS),
    "000-5": (FAILS,),
    "000-6": (FAILS,),
    "000-7": (FAILS,),
    "000-8": (HOLDS,),
    "000-9": (HOLDS, UNDECIDED),
    "000-10": (FAILS,),
    "000-11": (FAILS,),
    "000-12": (HOLDS,),
    "000-13": (HOLDS,),
}


def reason_of(key: str, outcome: str, view: View) -> str:
    """The reason for an outcome; nothing where none is known."""
    return _TEXTS[key](view) if outcome in EXPLAINED.get(key, ()) else ""


def _if_creeping(view: View) -> str:
    """The same with a tenth of the creep speed, if that was computed."""
    there = View(view.rows, "creep / 10")
    if not isfinite(there(slip(BEFORE), BENT2).value):
        return ""
    return f", {change(there, slip(BEFORE), BENT2)} with the creep speed divided by ten"


def findings(view: View) -> str:
    """What decides most of the claims, if the two pinched cages were computed."""
    there = View(view.rows, SQUEEZED)
    if not all(isfinite(v(STRESS, c).value) for v, c in ((view, SHORTER), (there, BENT2))):
        return ""
    return (
        "One thing decides most of it: whether the displacement exceeds the clearance. With "
        "clearance left, however little, a displaced beam shifts who drives the cage and changes "
        f"slips: {change(view, slip(BEFORE), BENT2)} for roller j-1 at 0.2 mm{_if_creeping(view)}. "
        "Once it is exceeded, friction holds the roller in its pocket, it turns with the cage, and "
        "stress, whirl, ripple and spikes come together:\n\n"
        f"- side beam, -0.3 mm of 0.25 mm: stress {figure(view, STRESS, SHORTER)}, slip of roller "
        f"j {figure(view, slip(AT), SHORTER)}, whirl radius {figure(view, WHIRL, SHORTER)}, cage "
        f"speed ripple {figure(view, RIPPLE, SHORTER)}, kurtosis {figure(view, SPIKES, SHORTER)};\n"
        f"- crossbeam, 0.2 mm of 0.15 mm: stress {figure(there, STRESS, BENT2)}, slip of roller "
        f"j-1 {figure(there, slip(BEFORE), BENT2)}, whirl radius {figure(there, WHIRL, BENT2)}, "
        f"cage speed ripple {figure(there, RIPPLE, BENT2)}, kurtosis "
        f"{figure(there, SPIKES, BENT2)}.\n\n"
        'So what the paper reports at delta_q = 0.2 mm ("squeezed", a sharp rise of slip, a drop '
        "of speed) is that of a bearing with Cq - Dw under 0.2 mm."
    )
