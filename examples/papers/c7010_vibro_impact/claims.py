"""What the vibro-impact paper claims, as findings with rules on figures of runs.

Its Table 1 has 1500 N in axial direction; a region without load, which the text describes, needs a
radial load beside it: the sweep of the load is one of the radial load, at 1500 N axial. Rules were
written down before any run of the samples.
"""

from judging.findings import Below, Claim, Same, Trend, Within

SPEEDS = ("4000", "12000")  # rpm, at 1500 N axial
LOADS = ("radial 5000 N", "radial 12500 N")  # at 8000 rpm
POCKETS = ("pocket 0.02", "pocket 0.14")  # mm
RADIAL = ("radial 0.02", "radial 0.14")
WAVES = ("sine", "triangle", "rectangle")  # of the speed, the best first
RAMPS = ("slow", "medium", "fast")  # accelerations, for equal times
REGULAR = 0.5  # share of an orbit's variance in one line, from which it is regular
ROUND = 0.75  # (largest - least)/mean radius, below which an orbit has a circular boundary
GAPS = 0.01  # share of time without contact, from which there are "intermittent zeros"
TENUOUS = 0.075  # "tenuous effect" of speed on an angle, in either direction
PRINTED = 0.2444  # deviation ratio at 12,500 N
NEAR = 0.2  # of it
#: Scatter of starts over their mean, of 26 November 2026 (eight starts).
SCATTER = {
    "one_peak": 0.005, "peak": 0.01, "gaps": 0.02, "line": 0.1, "circle": 0.1, "deviation": 0.1,
    "inner_load": 0.005, "outer_load": 0.005, "inner_off": 0.005, "axial_rough": 0.05,
    "slip_ripple": 0.05, "distance": 0.1, "frequency": 0.1, "axial_rate": 0.1,
}  # fmt: skip


def falls(output: str, conditions: tuple[str, ...], by: float = 0.0) -> Trend:
    """An output falls along the conditions."""
    return Trend(output, conditions, rising=False, by=by)


def with_clearance(conditions: tuple[str, str]) -> dict:
    """What is said to grow or fall with a clearance."""
    return {
        "steady at 0.02": Within("line", conditions[:1], low=REGULAR),
        "chaotic at 0.14": Within("line", conditions[-1:], high=REGULAR),
        "ratio rises": Trend("deviation", conditions),
        "zeros rise": Trend("gaps", conditions),
        "angle falls": falls("inner_load", conditions),
    }


CLAIMS = (
    Claim(
        "004-0", "Force on a ball is largest at the load, and so is its outer angle",
        "Figures 5, 9",
        {"outer angle": Below("outer_off", "outer_load", SPEEDS[:1])},
    ),
    Claim(
        "004-1", "The largest force of balls on the inner ring rises with speed; off the load it "
        "is zero from time to time", "Figure 6",
        {"rises": Trend("one_peak", SPEEDS), "zeros": Within("gaps", SPEEDS, low=GAPS)},
        change=0.02,
    ),
    Claim(
        "004-2", "The orbit is chaotic at 4000 rpm and has a circular boundary beyond 10,000 rpm",
        "Figure 7",
        {
            "chaotic at 4000": Within("line", ("4000",), high=REGULAR),
            "regular at 12,000": Within("line", ("12000",), low=REGULAR),
            "circular at 12,000": Within("circle", ("12000",), high=ROUND),
        },
    ),
    Claim(
        "004-2b", "The deviation ratio of the cage's speed falls with the ring's speed", "Figure 8",
        {"falls": falls("deviation", SPEEDS)},
    ),
    Claim(
        "004-3", "At one place contact angles hardly depend on speed; inner ones are larger",
        "Figure 9",
        {
            "inner": Same("inner_load", SPEEDS, within=TENUOUS),
            "outer": Same("outer_load", SPEEDS, within=TENUOUS),
            "inner is larger": Below("outer_load", "inner_load", ("12000",), by=0.01),
        },
    ),
    Claim(
        "004-4", "From 5000 to 12,500 N the deviation ratio rises and the orbit becomes chaotic",
        "Figures 11, 12",
        {
            "ratio rises": Trend("deviation", LOADS),
            "chaotic at 12,500": Within("line", LOADS[-1:], high=REGULAR),
        },
    ),
    Claim(
        "004-4b", "At 12,500 N the deviation ratio is 24.44 %", "conclusion 2",
        {"its size": Within("deviation", LOADS[-1:], (1 - NEAR) * PRINTED, (1 + NEAR) * PRINTED)},
    ),
    Claim(
        "004-4c", "With load contact angles rise in the loaded zone and fall opposite", "Figure 13",
        {"rise at the load": Trend("inner_load", LOADS),
         "fall opposite": falls("inner_off", LOADS)},
        change=0.05,
    ),
    Claim(
        "004-4d", "Force rises with load", "Figure 10", {"rises": Trend("one_peak", LOADS)},
        change=1.0,
    ),
    Claim(
        "004-5", "With the pockets' clearance steady whirl goes, and the deviation ratio rises",
        "Figures 14 to 17", with_clearance(POCKETS),
    ),
    Claim(
        "004-5b", "The same, read as the bearing's radial clearance", "Figures 14 to 17",
        with_clearance(RADIAL),
    ),
    Claim(
        "004-6", "Of three waves of the speed the rectangle is worst, the sine best",
        "Figures 19 to 21",
        {
            "force": Trend("peak", WAVES),
            "axial vibration": Trend("axial_rough", WAVES),
            "cage slip": Trend("slip_ripple", WAVES),
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
