"""The seven claims of the vibro-impact paper, as tests on the figures of a reading.

What counts was fixed before anything was computed (but for the circle): "regular" is an orbit whose
strongest line has half of its variance or more, "chaotic" one that is not, a "circle" one whose
radius changes by less than half of its mean; "independent" is within 5 %; "rises" and "falls" are
beyond the intervals, from each point of a sweep to the next.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import degrees

from ball_claim import Claim, Found, Shown, View, rising
from c7010_vibro_figures import LINE

from flexcage.study.verdicts import (
    Estimate,
    Verdict,
    above,
    every,
    opposite,
    unchanged,
)

PAPER = "Lubricants 2025, 13(5), 216"
SPEEDS = tuple(f"{n} rpm" for n in (4000, 6000, 8000, 10000, 12000))
LOADS = ("5000 N", "9000 N", "12500 N")
POCKETS = tuple(f"pocket {c} mm" for c in ("0.02", "0.08", "0.14"))
RADIAL = tuple(f"radial {c} mm" for c in ("0.02", "0.08", "0.14"))
LOAD_WAVES = ("load sine", "load triangle", "load rectangle")
SPEED_WAVES = ("speed sine", "speed triangle", "speed rectangle")
RAMPS = ("slow ramp", "medium ramp", "fast ramp")
ROUND = 0.5  # (largest - least)/mean of the radius, below which an orbit is a circle
CLEAR = 0.01  # share of time without contact from which "intermittent zeros" are there


def regular(label: str) -> Callable[[View], str]:
    return lambda view: above(view("line", label), LINE)


def chaotic(label: str) -> Callable[[View], str]:
    return lambda view: opposite(regular(label)(view))


def round_(label: str) -> Callable[[View], str]:
    """Is an orbit a circle: does its radius change by less than half of its mean?"""
    return lambda view: opposite(above(view("circle", label), ROUND))


def same(key: str, labels: Sequence[str], within: float = 0.05) -> Callable[[View], str]:
    """Is a figure the same at all these cases?"""

    def test(view: View) -> str:
        first, *others = view.all(key, labels)
        return every(unchanged(first, other, within=within) for other in others)

    return test


def apart(view: View) -> str:
    """Do inner and outer contact angles differ at every speed?"""
    found = (view("inner_angle", s) - view("outer_angle", s) for s in SPEEDS)
    return every(above(Estimate(abs(d.value), d.margin), 0.0) for d in found)


def gaps(view: View) -> str:
    """Do balls lose the inner race off the load, at every speed?"""
    return every(above(view("empty_opposite", s), CLEAR) for s in SPEEDS)


#: How figures are shown: name, unit, factor from SI.
SHOWN: Shown = {
    "peak": ("inner contact force of a pass, peak", "N", 1.0),
    "empty_opposite": ("time without inner contact, off the load", "%", 100.0),
    "deviation": ("deviation ratio, 2 kHz", "%", 100.0),
    "line": ("strongest line of the orbit", "%", 100.0),
    "inner_angle": ("inner contact angle", "deg", degrees(1.0)),
    "outer_angle": ("outer contact angle", "deg", degrees(1.0)),
    "radius": ("orbit's mean radius", "um", 1e6),
    "axial_range": ("axial displacement, range", "um", 1e6),
    "axial_rate": ("axial displacement over time", "um/s", 1e6),
    "ball_ripple": ("slip ripple of loaded balls", "%", 100.0),
    "circle": ("orbit, (max - min)/mean of its radius", "", 1.0),
    "frequency": ("mean frequency of a ball's force", "Hz", 1.0),
}


Parts = Mapping[str, Callable[[View], str]]


def _with_clearance(labels: Sequence[str]) -> Parts:
    """What the paper says of growing clearance, in either reading."""
    return {
        "steady at 0.02": regular(labels[0]),
        "chaotic at 0.14": chaotic(labels[-1]),
        "ratio rises": rising("deviation", labels),
        "force falls": rising("peak", labels, up=False),
        "angle falls": rising("inner_angle", labels, up=False),
    }


def _with_waves(labels: Sequence[str]) -> Parts:
    """What the paper says of three waves, the best first."""
    return {
        "peak force": rising("peak", labels),
        "axial displacement": rising("axial_range", labels),
        "slip ripple": rising("ball_ripple", labels),
    }


CLAIMS = (
    Claim(
        "004-1",
        "The peak force of balls on the inner ring rises with speed; off the load zone it is zero "
        "from time to time",
        {"rises": rising("peak", SPEEDS), "zeros off the load": gaps},
        SPEEDS,
        ("peak", "empty_opposite"),
    ),
    Claim(
        "004-2",
        "The orbit is chaotic at 4000 rpm; the deviation ratio falls with speed; beyond 10,000 rpm "
        "the orbit is a circle",
        {
            "chaotic at 4000": chaotic(SPEEDS[0]),
            "ratio falls": rising("deviation", SPEEDS, up=False),
            "regular at 12,000": regular(SPEEDS[-1]),
            "a circle at 12,000": round_(SPEEDS[-1]),
        },
        SPEEDS,
        ("deviation", "line", "circle"),
    ),
    Claim(
        "004-3",
        "Contact angles hardly depend on speed; inner and outer differ",
        {
            "inner within 5 %": same("inner_angle", SPEEDS),
            "outer within 5 %": same("outer_angle", SPEEDS),
            "they differ": apart,
        },
        SPEEDS,
        ("inner_angle", "outer_angle"),
    ),
    Claim(
        "004-4",
        "From 5000 to 12,500 N the deviation ratio rises (to 24.44 %) and the orbit becomes "
        "chaotic",
        {"ratio rises": rising("deviation", LOADS), "chaotic at 12,500": chaotic(LOADS[-1])},
        LOADS,
        ("deviation", "line"),
    ),
    Claim(
        "004-5 pockets",
        "With clearance (0.02, 0.08, 0.14 mm, read as the pockets') steady whirl goes, the "
        "deviation ratio rises, contact force and angle fall",
        _with_clearance(POCKETS),
        POCKETS,
        ("deviation", "line", "peak", "inner_angle"),
    ),
    Claim(
        "004-5 radial",
        "The same, read as the radial internal clearance",
        _with_clearance(RADIAL),
        RADIAL,
        ("deviation", "line", "peak", "inner_angle"),
    ),
    Claim(
        "004-6 load",
        "Of three waves of the load the rectangle is worst and the sine best: peak force, axial "
        "displacement, slip ripple",
        _with_waves(LOAD_WAVES),
        LOAD_WAVES,
        ("peak", "axial_range", "ball_ripple"),
    ),
    Claim(
        "004-6 speed",
        "The same of three waves of the speed",
        _with_waves(SPEED_WAVES),
        SPEED_WAVES,
        ("peak", "axial_range", "ball_ripple"),
    ),
    Claim(
        "004-7",
        "With acceleration the orbit grows, forces and their frequency rise, the axial "
        "displacement is faster",
        {
            "orbit": rising("radius", RAMPS),
            "force": rising("peak", RAMPS),
            "frequency": rising("frequency", RAMPS),
            "axial displacement": rising("axial_rate", RAMPS),
        },
        RAMPS,
        ("radius", "peak", "frequency", "axial_rate"),
    ),
)


def verdicts(found: Mapping[str, Found], base: str) -> list[Verdict]:
    """A verdict on every claim by the base reading, and where else it holds."""
    views = {name: View(f) for name, f in found.items()}
    return [claim.verdict(views, base, shown=SHOWN, source=PAPER) for claim in CLAIMS]
