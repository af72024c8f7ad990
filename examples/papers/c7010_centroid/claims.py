"""What the paper on lasers claims, as findings with rules on figures of runs.

Rules were written down before the samples' runs; paper.py names what was changed since. Claims on
the test are judged by what lasers would show of the cage (its form error included) and by what the
paper's equations make of that; claims on the simulation by the cage's centre itself, in the sample
of the paper's own model.
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
    "beyond_theory": 0.01, "solved": 0.05, "difference": 0.05, "solved_ratio": 0.1,
    "solved_radius": 0.05, "origin_error": 0.1,
}  # fmt: skip


def numbers(output: str, printed: dict[str, float], words: str) -> dict[str, Within]:
    """A printed number at each speed, within ``NEAR`` of it."""
    return {
        f"at {int(s):,} rpm, {words}": Within(
            output, (s,), (1.0 - NEAR) * printed[s], (1.0 + NEAR) * printed[s]
        )
        for s in printed
    }


def deflection(who: str, apart: str, of: str, error: str) -> dict[str, Below | Within | Turn]:
    """What both tables say of the deflection error."""
    return {
        f"{who}: larger": Below(of, apart, SPEEDS),
        f"{who}: slightly": Within(error, SPEEDS, high=SLIGHT),
        f"{who}: least at 10,000": Turn(error, SPEEDS, highest=False, at=RPM),
    }


def steadier(who: str, radius: str, ratio: str) -> dict[str, Trend | Within]:
    """What the figures of the centre in space say, up to 10,000 rpm."""
    return {
        f"{who}: radius grows": Trend(radius, TO_10000),
        f"{who}: tends to a circle": Trend(ratio, TO_10000, rising=False),
        f"{who}: a circle at 10,000": Within(ratio, ("10000",), high=ROUND),
    }


CLAIMS = (
    Claim(
        "003-1", "Measured: deflection makes differences slightly larger; the error is least at "
        "10,000 rpm", "Table 4", deflection("measured", "raw", "solved", "error"),
    ),
    Claim(
        "003-1b", "Simulated: the same", "Table 5",
        deflection("simulated", "origin", "difference", "origin_error"),
    ),
    Claim(
        "003-2", "Measured: the whirl ratio falls to 10,000 rpm, then rises", "Figure 11",
        {"measured: turns": Turn("solved_ratio", SPEEDS, highest=False, at=RPM)}, change=0.4,
    ),
    Claim(
        "003-2b", "Simulated: the same", "Figure 11",
        {"simulated: turns": Turn("ratio", SPEEDS, highest=False, at=RPM)}, change=0.4,
    ),
    Claim(
        "003-3", "Measured: up to 10,000 rpm the whirl radius grows and the orbit tends to a "
        "circle", "Figure 9", steadier("measured", "solved_radius", "solved_ratio"),
    ),
    Claim(
        "003-3b", "Simulated: the same", "Figure 10",
        steadier("simulated", "mean_radius", "ratio"),
    ),
    Claim(
        "003-4", "At 10,000 rpm an axial reading is periodic at the cage's frequency, the centre's "
        "motion is not", "Figure 6",
        {
            "raw": Within("axial_raw", ("10000",), low=PERIODIC),
            "solved": Within("axial_solved", ("10000",), high=PERIODIC),
            "less": Below("axial_solved", "axial_raw", ("10000",)),
        },
    ),
    Claim(
        "003-5", "The simulated cage's speed is within 1 % of the theory", "Table 3",
        {f"at {int(s):,} rpm": Within("beyond_theory", (s,), -THEORY, THEORY) for s in SPEEDS},
    ),
    Claim(
        "003-6", "Measured: whirl radii differ by 0.23 mm at either speed", "Table 4",
        numbers("solved", MEASURED, "solved"),
    ),
    Claim(
        "003-7", "Simulated: whirl radii differ by as much as printed (settled, or from the "
        "start on)", "Table 5",
        numbers("difference", SIMULATED, "settled") | numbers("whole", SIMULATED, "with the start"),
    ),
    Claim(
        "003-8", "The deflection error goes with the whirl ratio, as measured",
        "abstract, section 4.2", {"measured: together": Together("error", "solved_ratio", SPEEDS)},
        change=0.4,
    ),
    Claim(
        "003-8b", "and as simulated", "Figure 11, Table 5",
        {"simulated: together": Together("origin_error", "ratio", SPEEDS)}, change=0.4,
    ),
)  # fmt: skip
SIMULATIONS = ("003-1b", "003-2b", "003-3b", "003-5", "003-7", "003-8b")
