"""What the paper on measured centroid trajectories claims, as rules and tests on figures of runs.

Thresholds were written down before any run of a map.
"""

from flexcage.study.claims import Below, Between, Claim, Together, Trend, Turn

SPEEDS = ("4000", "7000", "10000", "11000")  # rpm of the inner ring
TO_10000 = SPEEDS[:3]
SLIGHT = 0.11  # twice the largest error that is printed (5.4 %): "slightly larger"
ROUND = 0.5  # whirl ratio below which an orbit is called a circle
PERIODIC = 0.5  # share of a signal's variance at the cage's frequency from which it is periodic
THEORY = 0.01  # "the error did not exceed 1 %"
NEAR = 0.2  # simulation and test of the paper differ by as much
MEASURED = {"4000": 0.2311e-3, "10000": 0.2314e-3}  # m, Table 4, solved
SIMULATED = {"4000": 0.2549e-3, "10000": 0.1886e-3}  # m, Table 5, centroid


def numbers(output, printed):
    """A printed number at each speed, within ``NEAR`` of it."""
    return {
        f"{printed[s] * 1e3:g} mm at {int(s):,} rpm": Between(
            output, (s,), (1.0 - NEAR) * printed[s], (1.0 + NEAR) * printed[s]
        )
        for s in printed
    }


CLAIMS = (
    Claim(
        "003-1",
        "Deflection makes measured differences slightly larger; the error falls to 10,000 rpm, "
        "then rises",
        "Table 4 and its text",
        {
            "larger": Between("error", SPEEDS, low=0.0),
            "slightly": Between("error", SPEEDS, high=SLIGHT),
            "least at 10,000": Turn("error", SPEEDS, 2),
        },
        ("error", "raw", "solved"),
    ),
    Claim(
        "003-2",
        "The whirl ratio decreases to 10,000 rpm, then rises",
        "Figure 11",
        {"ratio": Turn("ratio", SPEEDS, 2)},
        ("ratio",),
    ),
    Claim(
        "003-3",
        "Up to 10,000 rpm the whirl radius grows and the orbit tends to a circle",
        "Figures 9 and 10",
        {
            "radius": Trend("mean_radius", TO_10000, least=0.05),
            "a circle at 10,000": Between("ratio", ("10000",), high=ROUND),
        },
        ("mean_radius", "ratio"),
    ),
    Claim(
        "003-4",
        "At 10,000 rpm an axial reading is periodic at the cage's frequency, the centre's motion "
        "is not",
        "Figures 6 and 7",
        {
            "raw": Between("axial_raw", ("10000",), low=PERIODIC),
            "solved": Between("axial_solved", ("10000",), high=PERIODIC),
            "less": Below("axial_solved", "axial_raw", "10000"),
        },
        ("axial_raw", "axial_solved"),
    ),
    Claim(
        "003-4b",
        "The same, if the cage's end face runs out by 20 um",
        "Figures 6 and 7",
        {
            "raw": Between("axial_raw_run_out", ("10000",), low=PERIODIC),
            "solved": Between("axial_solved_run_out", ("10000",), high=PERIODIC),
            "less": Below("axial_solved_run_out", "axial_raw_run_out", "10000"),
        },
        ("axial_raw_run_out", "axial_solved_run_out"),
    ),
    Claim(
        "003-5",
        "The cage's speed is within 1 % of equation 18",
        "Table 3",
        {"speed": Between("beyond_theory", SPEEDS, -THEORY, THEORY)},
        ("beyond_theory",),
    ),
    Claim(
        "003-6",
        "Measured: whirl radii differ by 0.23 mm at 4000 and at 10,000 rpm",
        "Table 4",
        numbers("solved", MEASURED),
        ("solved",),
    ),
    Claim(
        "003-7",
        "Simulated: whirl radii differ by 0.25 mm at 4000 and 0.19 mm at 10,000 rpm",
        "Table 5",
        numbers("difference", SIMULATED),
        ("difference",),
    ),
    Claim(
        "003-8",
        "The deflection error goes with the whirl ratio: the steadier, the less",
        "Abstract, section 4.2",
        {"together": Together("error", "ratio", SPEEDS)},
        ("error", "ratio"),
    ),
)
