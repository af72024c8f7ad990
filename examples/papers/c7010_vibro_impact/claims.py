"""What the vibro-impact paper claims, as findings with rules on figures of runs.

Its Table 1 has 1500 N in axial direction; a region without load, which the text describes, needs a
radial load beside it: the sweep of the load is one of the radial load, at 1500 N axial. Rules were
written down before the samples' runs; paper.py names what was changed after trials. Opposite the
load a ball may not touch the inner ring, so that it has no inner contact angle there: the outer
one is judged, which centrifugal force leaves.
"""

from judging.findings import Below, Claim, Same, Trend, Within

SPEEDS = ("4000", "8000", "12000")  # rpm
LOADS = ("radial 5000 N", "radial 12500 N")  # at 8000 rpm
STEPS = ("0.02", "0.14")  # mm
POCKETS, RACES, BOTH = (
    tuple(f"{of} {step}" for step in STEPS) for of in ("pockets", "races", "both")
)
WAVES = ("sine", "triangle", "rectangle")  # of the speed, the best first
RAMPS = ("slow", "medium", "fast")  # accelerations, for equal times
REGULAR = 0.5  # share of an orbit's variance in one line, from which it is regular
ROUND = 0.5  # (largest - least)/mean radius of a boundary, below which it is circular; 0.6: 2 to 1
GAPS = 0.01  # share of time without contact, from which there are "intermittent zeros"
TENUOUS = 0.075  # "tenuous effect" of speed on an angle, in either direction
SLIGHT = 0.05  # "a slight difference" from the test, which is near pure rolling
PRINTED = 0.2444  # deviation ratio at 12,500 N
NEAR = 0.2  # of it
#: Scatter of starts over their mean, of 26 November 2026 (eight starts).
SCATTER = {
    "one_peak": 0.005, "peak": 0.01, "gaps": 0.02, "line": 0.1, "boundary": 0.1, "deviation": 0.1,
    "inner_load": 0.005, "outer_load": 0.005, "outer_off": 0.005, "axial_rough": 0.05,
    "slip_ripple": 0.05, "distance": 0.1, "frequency": 0.1, "axial_rate": 0.1, "speed": 0.001,
    "slip": 0.1, "off_force": 0.02, "load_force": 0.005,
}  # fmt: skip


def falls(output: str, conditions: tuple[str, ...], by: float = 0.0) -> Trend:
    """An output falls along the conditions."""
    return Trend(output, conditions, rising=False, by=by)


def of_the_cage(conditions: tuple[str, str], of: str) -> dict:
    """Figures 15 and 16: what the cage does as a clearance grows, that ``of`` what is named."""
    return {
        f"steady whirl at 0.02 ({of})": Within("line", conditions[:1], low=REGULAR),
        f"whirl gone at 0.14 ({of})": Within("line", conditions[-1:], high=REGULAR),
        f"ratio rises ({of})": Trend("deviation", conditions),
    }


def of_the_balls(conditions: tuple[str, str]) -> dict:
    """Figures 14 and 17: what balls do as a clearance grows."""
    return {
        "zeros grow": Trend("gaps", conditions),
        "angle falls at the load": falls("inner_load", conditions),
        "angle falls opposite": falls("outer_off", conditions),
    }


CLAIMS = (
    Claim(
        "004-0", "The cage's speed rises with the ring's, as in the test but for a slight "
        "difference", "Figure 5",
        {"near rolling": Within("slip", SPEEDS, -SLIGHT, SLIGHT)}, change=1.0,
    ),
    Claim(
        "004-1", "Balls' largest force on the inner ring rises with speed", "Figure 6",
        {"peak rises": Trend("one_peak", SPEEDS)}, change=0.02,
    ),
    Claim(
        "004-1b", "Forces are largest at the load, and zero from time to time off it", "Figure 6",
        {
            "largest at the load": Below("off_force", "load_force", SPEEDS, by=0.1),
            "zeros": Within("gaps", SPEEDS, low=GAPS),
        },
        change=0.5,
    ),
    Claim(
        "004-2", "The orbit is chaotic at the lowest speed, circular in boundary at the highest",
        "Figure 7",
        {
            "chaotic at 4000": Within("line", SPEEDS[:1], high=REGULAR),
            "circular at 12,000": Within("boundary", SPEEDS[-1:], high=ROUND),
        },
    ),
    Claim(
        "004-2b", "The deviation ratio of the cage's speed falls with the ring's speed", "Figure 8",
        {"ratio falls": falls("deviation", SPEEDS)},
    ),
    Claim(
        "004-3", "At one place contact angles hardly depend on speed; inner and outer ones differ; "
        "the outer is largest at the load", "Figures 9, 17",
        {
            "inner angle stays": Same("inner_load", SPEEDS, within=TENUOUS),
            "outer angle stays": Same("outer_load", SPEEDS, within=TENUOUS),
            "inner angle larger": Below("outer_load", "inner_load", SPEEDS[-1:], by=0.01),
            "outer largest at the load": Below("outer_off", "outer_load", SPEEDS),
        },
    ),
    Claim(
        "004-4d", "Force rises with load at the load; opposite it is zero more often", "Figure 10",
        {"force rises": Trend("one_peak", LOADS), "zeros grow": Trend("gaps", LOADS)}, change=0.5,
    ),
    Claim(
        "004-4", "With load a regular orbit becomes chaotic, and the deviation ratio rises",
        "Figures 11, 12",
        {
            "regular at 5000": Within("line", LOADS[:1], low=REGULAR),
            "chaotic at 12,500": Within("line", LOADS[-1:], high=REGULAR),
            "ratio rises": Trend("deviation", LOADS),
        },
    ),
    Claim(
        "004-4b", "At the largest load the deviation ratio is 24.44 % (a fifth)", "conclusion 2",
        {"24.44 %": Within("deviation", LOADS[-1:], (1 - NEAR) * PRINTED, (1 + NEAR) * PRINTED)},
    ),
    Claim(
        "004-4c", "With load contact angles rise in the loaded zone and fall opposite", "Figure 13",
        {"angle rises at the load": Trend("inner_load", LOADS),
         "angle falls opposite": falls("outer_off", LOADS)},
        change=0.05,
    ),
    Claim(
        "004-5", "With the clearance of the pockets steady whirl goes, and the deviation ratio "
        "rises", "Figures 15, 16", of_the_cage(POCKETS, "pockets"),
    ),
    Claim(
        "004-5b", "With the races' clearance balls off the load are free more often, and "
        "contact angles fall", "Figures 14 to 17", of_the_balls(RACES),
    ),
    Claim(
        "004-5c", "The same with one clearance for pockets and races", "Figures 14 to 17",
        of_the_cage(BOTH, "both") | {"zeros grow (both)": Trend("gaps", BOTH)},
    ),
    Claim(
        "004-6", "Of three waves of the speed the rectangle is worst, the sine best",
        "Figures 19 to 21",
        {
            "force": Trend("peak", WAVES),
            "axial vibration": Trend("axial_rough", WAVES),
            "cage slip": Trend("slip_ripple", WAVES),
            "orbit": falls("line", WAVES),
        },
    ),
    Claim(
        "004-7", "In equal times a larger acceleration gives a larger orbit, larger and more "
        "frequent forces, a faster axial motion", "Figures 22 to 25",
        {
            "orbit": Trend("distance", RAMPS),
            "force": Trend("one_peak", RAMPS),
            "frequency": Trend("frequency", RAMPS),
            "axial": Trend("axial_rate", RAMPS),
        },
    ),
)  # fmt: skip
#: The map that judges a claim, by its key; all others are judged over the map of speeds.
JUDGED_BY = {
    **dict.fromkeys(("004-4", "004-4b", "004-4c", "004-4d", "004-7"), "loads"),
    **dict.fromkeys(("004-5", "004-5b", "004-5c"), "clearance"),
    "004-6": "waves",
}
