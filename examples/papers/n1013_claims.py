"""The claims of Lubricants 2025, 13(11), 495 as comparisons of a study's figures.

Thresholds that turn the paper's words into numbers were chosen before the study was computed:
"unchanged" is within 10 % (a roller's speed: 1 %), "clearly" is by a quarter or more (a roller's
speed: 5 %), and a plain "more" is beyond both intervals. They are this study's reading.
"""

from __future__ import annotations

from functools import partial

from n1013_claim import Claim, Test
from n1013_view import (
    AFTER,
    AT,
    BEFORE,
    BENT1,
    BENT2,
    CAGES,
    CORNER,
    CREST,
    CROSSBEAM,
    LINE_AT,
    LINE_SHARE,
    LONGER,
    PITCH,
    REACH,
    RIPPLE,
    SHORTER,
    SOUND,
    SPIKES,
    SPREAD,
    STRESS,
    WHIRL,
    View,
    slip,
    spin,
    spin_ripple,
)

from flexcage.study.verdicts import (
    Estimate,
    every,
    less,
    monotone,
    unchanged,
)

SAME, CLEARLY = 0.10, 0.25  # shares
SAME_SPEED, CLEAR_DROP = 0.01, 0.05  # of a roller's speed


def _magnitude(figure: Estimate) -> Estimate:
    """A roller's speed without its sign."""
    return Estimate(abs(figure.value), figure.margin)


def _speed(view: View, roller: int, cage: str) -> Estimate:
    return _magnitude(view(spin(roller), cage))


def _steady(view: View, roller: int, cage: str) -> str:
    return unchanged(_speed(view, roller, SOUND), _speed(view, roller, cage), within=SAME_SPEED)


def _drops(view: View, roller: int, cage: str) -> str:
    """The roller turns slower than in the sound cage by 5 % or more."""
    sound = _speed(view, roller, SOUND)
    allowed = Estimate(sound.value * (1.0 - CLEAR_DROP), sound.margin)
    return less(_speed(view, roller, cage), allowed)


def _same(view: View, output: str, cage: str) -> str:
    return unchanged(view(output, SOUND), view(output, cage), within=SAME)


def _more(view: View, output: str, cage: str, *, than: str = SOUND, by: float = 0.0) -> str:
    return less(view(output, than), view(output, cage), by=by)


def _rises(output: str) -> Test:
    return lambda v: less(v(output, SOUND), v(output, BENT1))


def _falls_again(output: str) -> Test:
    return lambda v: less(v(output, BENT2), v(output, BENT1))


def _all_rise(output: str) -> Test:
    return lambda v: monotone(v.along(output, CROSSBEAM))


CLAIMS: tuple[Claim, ...] = (
    Claim(
        "000-1",
        "Cage stress rises with delta_q: 0 < 0.1 < 0.2 mm",
        {"mean of the peak": _all_rise(STRESS), "pocket corners": _all_rise(CORNER)},
        (STRESS, CORNER, "stress_peak"),
        CROSSBEAM,
    ),
    Claim(
        "000-2",
        "The amplitude of the cage's radial displacement rises from delta_q = 0 to 0.1 mm and "
        "falls at 0.2 mm",
        {"rises to 0.1": _rises(REACH), "falls at 0.2": _falls_again(REACH)},
        (REACH, "cage_radial_displacement.mean"),
        CROSSBEAM,
    ),
    Claim(
        "000-3",
        "The whirl radius grows from delta_q = 0 to 0.1 mm and falls at 0.2 mm, and the orbit is "
        "more dispersed",
        {
            "grows to 0.1": _rises(WHIRL),
            "falls at 0.2": _falls_again(WHIRL),
            "more dispersed": lambda v: _more(v, SPREAD, BENT2),
        },
        (WHIRL, SPREAD),
        CROSSBEAM,
    ),
    Claim(
        "000-4",
        "The outer ring's acceleration is a stable band in a sound cage and gets irregular spikes "
        "(kurtosis) with any deformation",
        {cage: partial(_more, output=SPIKES, cage=cage) for cage in CAGES[1:]},
        (SPIKES, CREST, "outer_acceleration_filtered[axis2=y].rms"),
        CAGES,
    ),
    Claim(
        "000-5",
        "Cage speed ripple: unchanged at delta_q = 0.1 mm; amplitude and frequency clearly up at "
        "0.2 mm",
        {
            "unchanged at 0.1": partial(_same, output=RIPPLE, cage=BENT1),
            "amplitude up at 0.2": partial(_more, output=RIPPLE, cage=BENT2, by=CLEARLY),
            "frequency up at 0.2": partial(_more, output=PITCH, cage=BENT2, by=CLEARLY),
        },
        (RIPPLE, PITCH, "cage_omega[axis=x].frequency"),
        CROSSBEAM,
    ),
    Claim(
        "000-6",
        "Speed of roller j-1: unchanged at delta_q = 0.1 mm, a large drop and more ripple at "
        "0.2 mm; rollers j and j+1 unchanged",
        {
            "j-1 unchanged at 0.1": partial(_steady, roller=BEFORE, cage=BENT1),
            "j-1 drops at 0.2": partial(_drops, roller=BEFORE, cage=BENT2),
            "j-1 more ripple at 0.2": partial(_more, output=spin_ripple(BEFORE), cage=BENT2),
            "j and j+1 unchanged": lambda v: every(
                _steady(v, r, cage) for r in (AT, AFTER) for cage in (BENT1, BENT2)
            ),
        },
        (spin(BEFORE), spin_ripple(BEFORE), spin(AT), spin(AFTER)),
        CROSSBEAM,
    ),
    Claim(
        "000-7",
        "Slip of roller j-1: slightly lower at delta_q = 0.1 mm, sharply higher at 0.2 mm; others "
        "unchanged",
        {
            "j-1 lower at 0.1": lambda v: less(v(slip(BEFORE), BENT1), v(slip(BEFORE), SOUND)),
            "j-1 sharply higher at 0.2": partial(
                _more, output=slip(BEFORE), cage=BENT2, by=CLEARLY
            ),
            "j and j+1 unchanged": lambda v: every(
                _same(v, slip(r), cage) for r in (AT, AFTER) for cage in (BENT1, BENT2)
            ),
        },
        (slip(BEFORE), slip(AT), slip(AFTER)),
        CROSSBEAM,
    ),
    Claim(
        "000-8",
        "Cage stress: unchanged at delta_p = +0.3 mm, a strong increase at -0.3 mm",
        {
            "unchanged at +0.3": partial(_same, output=STRESS, cage=LONGER),
            "strong increase at -0.3": partial(_more, output=STRESS, cage=SHORTER, by=CLEARLY),
        },
        (STRESS, CORNER, "stress_peak"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-9",
        "Radial displacement of the cage: unchanged at delta_p = +0.3 mm, sinusoidal at -0.3 mm, "
        "at one characteristic frequency",
        {
            "unchanged at +0.3": partial(_same, output=REACH, cage=LONGER),
            "one line at -0.3": partial(_more, output=LINE_SHARE, cage=SHORTER, by=CLEARLY),
        },
        (REACH, LINE_AT, LINE_SHARE, "whirl_speed_ratio"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-10",
        "Orbit: larger and more chaotic at delta_p = +0.3 mm; regular and smaller at -0.3 mm",
        {
            "larger at +0.3": partial(_more, output=WHIRL, cage=LONGER),
            "more chaotic at +0.3": partial(_more, output=SPREAD, cage=LONGER),
            "smaller at -0.3": lambda v: less(v(WHIRL, SHORTER), v(WHIRL, SOUND)),
            "regular at -0.3": lambda v: less(v(SPREAD, SHORTER), v(SPREAD, SOUND)),
        },
        (WHIRL, SPREAD, "whirl_ratio"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-11",
        "Cage speed ripple: smaller at delta_p = +0.3 mm; larger and of higher frequency at "
        "-0.3 mm",
        {
            "smaller at +0.3": lambda v: less(v(RIPPLE, LONGER), v(RIPPLE, SOUND)),
            "larger at -0.3": partial(_more, output=RIPPLE, cage=SHORTER),
            "of higher frequency at -0.3": partial(_more, output=PITCH, cage=SHORTER),
        },
        (RIPPLE, PITCH, "cage_omega[axis=x].frequency"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-12",
        "Speed of roller j: unchanged at delta_p = +0.3 mm, drops at -0.3 mm",
        {
            "unchanged at +0.3": partial(_steady, roller=AT, cage=LONGER),
            "drops at -0.3": partial(_drops, roller=AT, cage=SHORTER),
        },
        (spin(AT), spin_ripple(AT)),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-13",
        "A side-beam fault (-0.3 mm) raises the slip of rollers j-1 and j+1; a crossbeam fault "
        "(0.2 mm) leaves that of rollers j and j+1 as it was",
        {
            "side beam: j-1 and j+1 slip more": lambda v: every(
                _more(v, slip(r), SHORTER, by=SAME) for r in (BEFORE, AFTER)
            ),
            "crossbeam: j and j+1 unchanged": lambda v: every(
                _same(v, slip(r), BENT2) for r in (AT, AFTER)
            ),
        },
        (slip(BEFORE), slip(AT), slip(AFTER)),
        (SOUND, BENT2, SHORTER),
    ),
)
