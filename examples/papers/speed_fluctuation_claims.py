"""The claims of the paper on fluctuating speed, as tests on the figures of a reading.

What counts was fixed before the study was computed: the cage's speed "follows" the ring's where a
sine of the ring's frequency has half of its variance or more; its fluctuation "is" the ring's
within 10 %; a mean is unchanged within 0.5 %, and a fluctuation independent of the frequency within
6 %, as the paper's own figures are; an orbit is regular if its strongest line has half of its
variance; "rises" is beyond the intervals, from each case to the next.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import pi

from ball_claim import Claim, Found, Shown, View, rising

from flexcage.study.verdicts import Estimate, Verdict, above, every, opposite, unchanged

PAPER = "Symmetry 2025, 17(10), 1761"
CONSTANT = "constant"
AMPLITUDES = {"A 3 %": 0.03, "A 6 %": 0.06, "A 9 %": 0.09}  # once a turn of the ring
FREQUENCIES = {"A 6 %": 1, "A 6 %, N 2": 2, "A 6 %, N 3": 3}  # waves a turn
CASES = {CONSTANT: 1, **dict.fromkeys(AMPLITUDES, 1), **FREQUENCIES}  # waves looked for, a turn
STRONG = {"A 6 %": 0.06, "A 9 %": 0.09}  # amplitudes at which the paper finds its law
HALF, NEARLY_ALL = 0.5, 0.9  # of a variance
OVER_A = (CONSTANT, *AMPLITUDES)
OVER_N = tuple(FREQUENCIES)

#: How figures are shown: name, unit, factor from SI.
SHOWN: Shown = {
    "speed": ("mean cage speed", "rpm", 30.0 / pi),
    "swing": ("cage speed fluctuation", "%", 100.0),
    "follows": ("share of the ring's sine in the cage's speed", "%", 100.0),
    "gain": ("amplitude of that sine", "%", 100.0),
    "distance": ("largest distance of the cage's centre", "um", 1e6),
    "orbit_line": ("strongest line of the orbit", "%", 100.0),
    "pocket_most": ("largest force on the cage", "N", 1.0),
    "ring_range": ("range of the inner ring's centre", "um", 1e6),
    "ripple": ("ripple of the largest inner contact force", "%", 100.0),
    "by_place": ("share of a ball's force that follows its place", "%", 100.0),
}

Test = Callable[[View], str]


def follows(label: str) -> Test:
    return lambda view: above(view("follows", label), HALF)


def regular(label: str) -> Test:
    return lambda view: above(view("orbit_line", label), HALF)


def not_(test: Test) -> Test:
    return lambda view: opposite(test(view))


def all_of(tests: Sequence[Test]) -> Test:
    return lambda view: every(test(view) for test in tests)


def is_the_rings(label: str, share: float) -> Test:
    """Is the cage's fluctuation the ring's?"""
    return lambda view: unchanged(Estimate(share, 0.0), view("swing", label), within=0.1)


def same(key: str, labels: Sequence[str], within: float) -> Test:
    """Is a figure the same at all these cases as at the first?"""
    first, *others = labels
    return lambda view: every(
        unchanged(view(key, first), view(key, label), within=within) for label in others
    )


def with_both(key: str) -> Mapping[str, Test]:
    """Does a figure rise with amplitude and with frequency?"""
    return {"with A": rising(key, OVER_A), "with N": rising(key, OVER_N)}


CLAIMS = (
    Claim(
        "002-1",
        "The cage's speed follows the ring's sine at the same frequency, fluctuates as much as the "
        "ring from 6 % on, and its mean does not change",
        {
            "same frequency": all_of([follows(label) for label in (*STRONG, *OVER_N[1:])]),
            "as much as the ring": all_of([is_the_rings(*pair) for pair in STRONG.items()]),
            "mean": same("speed", tuple(CASES), 0.005),
        },
        tuple(CASES),
        ("speed", "swing", "follows", "gain"),
    ),
    Claim(
        "002-2",
        "At 3 % the cage's speed has no pronounced period",
        {"no period": not_(follows("A 3 %"))},
        ("A 3 %",),
        ("follows", "gain"),
    ),
    Claim(
        "002-3 distance",
        "The cage's largest distance from the axis rises with A and with N",
        with_both("distance"),
        tuple(CASES),
        ("distance",),
    ),
    Claim(
        "002-3 force",
        "The largest force between balls and cage rises with A and with N",
        with_both("pocket_most"),
        tuple(CASES),
        ("pocket_most",),
    ),
    Claim(
        "002-4",
        "The cage's orbit is near an ellipse at small A and irregular at large A",
        {"regular at 3 %": regular("A 3 %"), "irregular at 9 %": not_(regular("A 9 %"))},
        ("A 3 %", "A 9 %"),
        ("orbit_line",),
    ),
    Claim(
        "002-5 orbit",
        "The range of the inner ring's orbit rises with A and with N",
        with_both("ring_range"),
        tuple(CASES),
        ("ring_range",),
    ),
    Claim(
        "002-5 force",
        "The ripple of the force between balls and inner ring rises with A and with N",
        with_both("ripple"),
        tuple(CASES),
        ("ripple",),
    ),
    Claim(
        "002-6",
        "The force between a ball and the inner ring has the period of the cage's turn, because "
        "the load is combined",
        {"follows its place": lambda view: above(view("by_place", CONSTANT), NEARLY_ALL)},
        (CONSTANT,),
        ("by_place",),
    ),
    Claim(
        "002-7",
        "The cage's fluctuation does not depend on N (at 6 %)",
        {"within 6 %": same("swing", OVER_N, 0.06)},
        OVER_N,
        ("swing",),
    ),
)


def verdicts(found: Mapping[str, Found], base: str) -> list[Verdict]:
    """A verdict on every claim by the base reading, and where else it holds."""
    views = {name: View(f) for name, f in found.items()}
    return [claim.verdict(views, base, shown=SHOWN, source=PAPER) for claim in CLAIMS]
