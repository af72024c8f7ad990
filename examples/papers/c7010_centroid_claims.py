"""The five claims of the measured-cage paper, as tests on what runs and virtual lasers show."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import pi

from ball_claim import Claim, Shown, View, rising
from c7010_centroid_figures import Found

from flexcage.study.verdicts import (
    Estimate,
    Verdict,
    above,
    every,
    less,
    monotone,
    opposite,
)

PAPER = "Measurement and Dynamic Analysis of the Centroid Trajectories of ACBB Cages"
SPEEDS = ("4000", "7000", "10000", "11000")
BASE = "0.2 g mm"
ERRORS = (0.03, 0.054)  # the deflection errors of the paper's Tables 4 and 5
ROUND = 0.5  # whirl ratio below which an orbit is a circle
PERIODIC = 0.5  # share of a signal's variance at the cage's frequency from which it is periodic


def each(key: str, limit: float, *, over: bool = True) -> Callable[[View], str]:
    """Is a figure above (or below) a limit at every speed?"""

    def test(view: View) -> str:
        found = [above(view(key, s), limit) for s in SPEEDS]
        return every(found if over else map(opposite, found))

    return test


def least_at_10000(view: View) -> str:
    """Is the deflection error at 10,000 rpm less than at every other speed?"""
    there = view("error", "10000")
    return every(less(there, view("error", s)) for s in SPEEDS if s != "10000")


def falls_then_rises(view: View) -> str:
    """Does the whirl ratio fall to 10,000 rpm, and rise to 11,000?"""
    *down, last = view.all("ratio", SPEEDS)
    return every((monotone(down, rising=False), less(down[-1], last)))


def near_theory(view: View) -> str:
    """Is the cage within 1 % of equation 18 at every speed?"""
    away = (view("beyond_theory", s) for s in SPEEDS)
    return every(opposite(above(Estimate(abs(a.value), a.margin), 0.01)) for a in away)


CLAIMS = (
    Claim(
        "003-1",
        "The deflection error is positive, 3 to 5.4 %, least at 10,000 rpm",
        {
            "positive": each("error", 0.0),
            "3 % or more": each("error", ERRORS[0]),
            "5.4 % or less": each("error", ERRORS[1], over=False),
            "least at 10,000": least_at_10000,
        },
        SPEEDS,
        ("error", "raw", "solved"),
    ),
    Claim(
        "003-2",
        "The whirl ratio decreases to 10,000 rpm, then rises",
        {"ratio": falls_then_rises},
        SPEEDS,
        ("ratio", "difference"),
    ),
    Claim(
        "003-3",
        "The mean whirl radius grows with speed up to 10,000 rpm; the orbit tends to a circle",
        {
            "radius": rising("mean", SPEEDS[:3]),
            "a circle at 10,000": lambda view: opposite(above(view("ratio", "10000"), ROUND)),
        },
        SPEEDS,
        ("mean", "ratio"),
    ),
    Claim(
        "003-4",
        "The axial raw signal is periodic at the cage's frequency, the corrected is not",
        {
            "raw": each("axial_raw", PERIODIC),
            "corrected": each("axial_solved", PERIODIC, over=False),
        },
        SPEEDS,
        ("axial_raw", "axial_solved"),
    ),
    Claim(
        "003-5",
        "The cage's speed is within 1 % of equation 18",
        {"speed": near_theory},
        SPEEDS,
        ("speed", "beyond_theory"),
    ),
)
SHOWN: Shown = {
    "error": ("deflection error", "%", 100.0),
    "raw": ("whirl radius at the sensors, max - min", "mm", 1e3),
    "solved": ("the same, corrected", "mm", 1e3),
    "ratio": ("whirl ratio", "", 1.0),
    "difference": ("whirl radius, max - min", "mm", 1e3),
    "mean": ("mean whirl radius", "mm", 1e3),
    "axial_raw": ("axial reading at the cage's frequency", "%", 100.0),
    "axial_solved": ("axial motion at the cage's frequency", "%", 100.0),
    "speed": ("cage speed", "rpm", 30.0 / pi),
    "beyond_theory": ("beyond equation 18", "%", 100.0),
}
Table = Mapping[str, Mapping[str, Sequence[Found]]]  # by variation and speed


def verdicts(found: Table) -> list[Verdict]:
    """A verdict on every claim at 0.2 g mm, and by variation."""
    views = {name: View(f) for name, f in found.items()}
    return [claim.verdict(views, BASE, shown=SHOWN, source=PAPER) for claim in CLAIMS]
