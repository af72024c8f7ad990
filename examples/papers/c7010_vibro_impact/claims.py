"""What the vibro-impact paper claims, as rules and tests on figures of runs.

Thresholds were written down before any run of a map.
"""

from flexcage.study.claims import Below, Between, Claim, Trend, Unchanged

SPEEDS = ("4000", "12000")  # rpm, at 1500 N: the ends, which maps have as well
ALL_SPEEDS = ("4000", "8000", "10000", "12000")
LOADS = ("5000 N", "12500 N")  # at 8000 rpm
ALL_LOADS = ("8000", "5000 N", "9000 N", "12500 N")  # the first has 1500 N
POCKETS = tuple(f"pocket {c}" for c in ("0.02", "0.08", "0.14"))  # mm
RADIAL = tuple(f"radial {c}" for c in ("0.02", "0.08", "0.14"))
WAVES = ("sine", "triangle", "rectangle")  # of the speed, the best first
RAMPS = ("slow", "medium", "fast")  # accelerations, for equal times
MAPPED = (*SPEEDS, *LOADS, "pocket 0.14", "radial 0.14")  # conditions of the maps
REGULAR = 0.5  # share of an orbit's variance in one line, from which it is regular
ROUND = 0.5  # (largest - least)/mean radius, below which an orbit is a circle
GAPS = 0.01  # share of time without contact, from which there are "intermittent zeros"
TENUOUS = 0.05  # "tenuous effect" of speed on an angle: within the share 0.05 of it
PRINTED = 0.2444  # deviation ratio at 12,500 N
NEAR = 0.2  # of it
SLIGHT = 0.05  # change from first to last below which nothing rises


def rises(output, conditions, rising=True, least=SLIGHT):
    return Trend(output, conditions, rising, least)


def with_clearance(conditions):
    """What grows or falls with clearance."""
    return {
        "steady at 0.02": Between("line", conditions[:1], low=REGULAR),
        "chaotic at 0.14": Between("line", conditions[-1:], high=REGULAR),
        "ratio rises": rises("deviation", conditions),
        "force falls": rises("one_peak", conditions, False, 0.01),
        "angle falls": rises("inner_load", conditions, False, 0.01),
    }


CLAIMS = (
    Claim(
        "004-1",
        "The largest force of balls on the inner ring rises with speed; off the load it is zero "
        "from time to time",
        "Figure 6",
        {
            "rises": rises("one_peak", SPEEDS, least=0.01),
            "zeros off the load": Between("gaps", SPEEDS, low=GAPS),
        },
        ("one_peak", "gaps"),
    ),
    Claim(
        "004-2",
        "The orbit is chaotic at 4000 rpm and a circle beyond 10,000 rpm",
        "Figure 7",
        {
            "chaotic at 4000": Between("line", ("4000",), high=REGULAR),
            "regular at 12,000": Between("line", ("12000",), low=REGULAR),
            "a circle at 12,000": Between("circle", ("12000",), high=ROUND),
        },
        ("line", "circle"),
    ),
    Claim(
        "004-2b",
        "The deviation ratio of the cage's speed falls with the ring's speed",
        "Figure 8",
        {"falls": rises("deviation", SPEEDS, False)},
        ("deviation",),
    ),
    Claim(
        "004-3",
        "At one place contact angles hardly depend on speed; inner and outer ones differ",
        "Figure 9",
        {
            "inner": Unchanged("inner_load", SPEEDS, TENUOUS),
            "outer": Unchanged("outer_load", SPEEDS, TENUOUS),
            "inner is larger": Below("outer_load", "inner_load", "12000", by=0.01),
        },
        ("inner_load", "outer_load"),
    ),
    Claim(
        "004-4",
        "From 5000 to 12,500 N the deviation ratio rises, and the orbit becomes chaotic",
        "Figures 11 and 12",
        {
            "rises": rises("deviation", LOADS),
            "chaotic at 12,500": Between("line", LOADS[-1:], high=REGULAR),
        },
        ("deviation", "line"),
    ),
    Claim(
        "004-4b",
        "At 12,500 N the deviation ratio is 24.44 %",
        "Conclusion 2",
        {"number": Between("deviation", LOADS[-1:], (1 - NEAR) * PRINTED, (1 + NEAR) * PRINTED)},
        ("deviation",),
    ),
    Claim(
        "004-4c",
        "With load contact angles rise in the loaded zone and fall opposite",
        "Figure 13",
        {
            "rise at the load": rises("inner_load", LOADS, least=0.01),
            "fall opposite": rises("inner_off", LOADS, False, 0.01),
        },
        ("inner_load", "inner_off"),
    ),
    Claim(
        "004-5",
        "With clearance, read as the pockets', steady whirl goes, the deviation ratio rises, "
        "force and angle fall",
        "Figures 14 to 17",
        with_clearance(POCKETS),
        ("line", "deviation", "one_peak", "inner_load"),
    ),
    Claim(
        "004-5b",
        "The same, read as the bearing's radial clearance",
        "Figures 14 to 17",
        with_clearance(RADIAL),
        ("line", "deviation", "one_peak", "inner_load"),
    ),
    Claim(
        "004-6",
        "Of three waves of the speed the rectangle is worst, the sine best: force, axial "
        "vibration, slip of the cage",
        "Figures 19 to 21",
        {
            "force": rises("peak", WAVES, least=0.0),
            "axial": rises("axial_rough", WAVES, least=0.0),
            "cage slip": rises("slip_ripple", WAVES, least=0.0),
        },
        ("peak", "axial_rough", "slip_ripple"),
    ),
    Claim(
        "004-7",
        "In equal times a larger acceleration gives a larger orbit, larger and more frequent "
        "forces, and a faster axial motion",
        "Figures 22 to 24",
        {
            "orbit": rises("distance", RAMPS),
            "force": rises("one_peak", RAMPS, least=0.01),
            "frequency": rises("frequency", RAMPS),
            "axial": rises("axial_rate", RAMPS),
        },
        ("distance", "one_peak", "frequency", "axial_rate"),
    ),
)
