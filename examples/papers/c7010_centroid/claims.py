"""What the paper on lasers claims, as findings with rules on figures of runs.

Rules were written down before any run of the samples.
"""

from judging.findings import Below, Claim, Together, Trend, Turn, Within

SPEEDS = ("4000", "7000", "10000", "11000")  # rpm of the inner ring
RPM = (4000.0, 7000.0, 10000.0, 11000.0)
TO_10000 = SPEEDS[:3]
SLIGHT = 0.11  # twice the largest error that is printed (5.4 %): "slightly larger"
ROUND = 0.5  # whirl ratio below which an orbit is called a circle
PERIODIC = 0.5  # share of a signal's variance at the cage's frequency from which it is periodic
THEORY = 0.01  # "the error did not exceed 1 %"
NEAR = 0.2  # simulation and test of the paper differ by as much
MEASURED = {"4000": 0.2311e-3, "10000": 0.2314e-3}  # m, Table 4, solved
SIMULATED = {"4000": 0.2549e-3, "10000": 0.1886e-3}  # m, Table 5, centroid
#: Scatter of starts over their mean, of 26 November 2026 (eight starts).
SCATTER = {
    "error": 0.1, "ratio": 0.1, "mean_radius": 0.05, "axial_raw": 0.05, "axial_solved": 0.1,
    "beyond_theory": 0.01, "solved": 0.05, "difference": 0.05,
}  # fmt: skip


def numbers(output: str, printed: dict[str, float]) -> dict[str, Within]:
    """A printed number at each speed, within ``NEAR`` of it."""
    return {
        f"{printed[s] * 1e3:.2g} mm at {int(s):,} rpm": Within(
            output, (s,), (1.0 - NEAR) * printed[s], (1.0 + NEAR) * printed[s]
        )
        for s in printed
    }


CLAIMS = (
    Claim(
        "003-1", "Deflection makes measured differences slightly larger; the error is least at "
        "10,000 rpm", "Table 4",
        {
            "larger": Below("solved", "raw", SPEEDS),
            "slightly": Within("error", SPEEDS, high=SLIGHT),
            "least at 10,000": Turn("error", SPEEDS, highest=False, at=RPM),
        },
    ),
    Claim(
        "003-2", "The whirl ratio falls to 10,000 rpm, then rises", "Figure 11",
        {"turns": Turn("ratio", SPEEDS, highest=False, at=RPM)}, change=0.4,
    ),
    Claim(
        "003-3", "Up to 10,000 rpm the whirl radius grows and the orbit tends to a circle",
        "Figures 9, 10",
        {
            "radius grows": Trend("mean_radius", TO_10000),
            "tends to a circle": Trend("ratio", TO_10000, rising=False),
            "a circle at 10,000": Within("ratio", ("10000",), high=ROUND),
        },
    ),
    Claim(
        "003-4", "At 10,000 rpm an axial reading is periodic at the cage's frequency, the centre's "
        "motion is not", "Figures 6, 7",
        {
            "raw": Within("axial_raw", ("10000",), low=PERIODIC),
            "solved": Within("axial_solved", ("10000",), high=PERIODIC),
            "less": Below("axial_solved", "axial_raw", ("10000",)),
        },
    ),
    Claim(
        "003-5", "The cage's speed is within 1 % of equation 18", "Table 3",
        {f"at {int(s):,} rpm": Within("beyond_theory", (s,), -THEORY, THEORY) for s in SPEEDS},
    ),
    Claim(
        "003-6", "Measured: whirl radii differ by 0.23 mm at either speed", "Table 4",
        numbers("solved", MEASURED),
    ),
    Claim(
        "003-7", "Simulated: whirl radii differ by 0.25 and 0.19 mm", "Table 5",
        numbers("difference", SIMULATED),
    ),
    Claim(
        "003-8", "The deflection error goes with the whirl ratio", "abstract, section 4.2",
        {"together": Together("error", "ratio", SPEEDS)}, change=0.4,
    ),
)  # fmt: skip
