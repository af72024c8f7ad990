"""What the paper on deformed cage pockets claims, as rules and tests on figures of runs.

Thresholds were written down before any run of a reading or map.
"""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.study.claims import At, Between, Claim, Trend, Turn, Unchanged, Values
from flexcage.study.decisions import Evidence, equal, less

SOUND, BENT1, BENT2, LONGER, SHORTER = "sound", "dq 0.1", "dq 0.2", "dp +0.3", "dp -0.3"
CAGES = (SOUND, BENT1, BENT2, LONGER, SHORTER)
CROSSBEAM = (SOUND, BENT1, BENT2)
SAME, CLEARLY = 0.10, 0.25  # shares of an amplitude or a stress: "unchanged", "clearly"
SAME_SPEED, DROP = 0.01, 0.05  # shares of a roller's speed: "unchanged", "drops"
SINE = 0.5  # share of the variance in one line from which a motion is called sinusoidal
PRINTED_STRESS = 320.51e6  # Pa, conclusion 2
WITHIN = 2.0  # factor: a linear cage of unknown clearance and fillet is an order of magnitude


@dataclass(frozen=True)
class Up:
    """An output is larger (or smaller) under the second condition than under the first, by the
    share ``by`` of the first or more. Its test is Welch's."""

    output: str
    conditions: tuple[str, str]
    by: float = 0.0
    rising: bool = True

    def _limit(self, value):
        """What the second must pass, of values (n,) of the first."""
        sign = 1.0 if self.rising else -1.0
        return value + sign * self.by * abs(value)

    def holds(self, at: At) -> bool:
        first, then = (at(self.output, c) for c in self.conditions)
        return then > self._limit(first) if self.rising else then < self._limit(first)

    def evidence(self, values: Values) -> Evidence:
        first, then = (values(self.output, c) for c in self.conditions)
        pair = (self._limit(first), then)
        return less(*pair) if self.rising else less(*reversed(pair))


@dataclass(frozen=True)
class Differs:
    """An output is apart from that under the first condition by more than the share ``within`` of
    it: the contrary of ``Unchanged``."""

    output: str
    conditions: tuple[str, str]
    within: float

    def holds(self, at: At) -> bool:
        first, then = (at(self.output, c) for c in self.conditions)
        return abs(then - first) > self.within * abs(first)

    def evidence(self, values: Values) -> Evidence:
        first, then = (values(self.output, c) for c in self.conditions)
        return equal(first, then, within=self.within).contrary


def steady(roller: str, *conditions: str) -> Unchanged:
    """A roller's speed stays as in the sound cage."""
    return Unchanged(f"speed_{roller}", (SOUND, *conditions), SAME_SPEED)


CLAIMS = (
    Claim(
        "000-1",
        "Stress at the deformed pocket rises with the crossbeam's displacement",
        "Figure 8",
        {"rises": Trend("corner", CROSSBEAM, least=SAME)},
        ("corner", "stress"),
    ),
    Claim(
        "000-2",
        "The amplitude of the cage's radial displacement rises to 0.1 mm and falls at 0.2 mm",
        "Figure 9",
        {"amplitude": Turn("reach", CROSSBEAM, 1, lowest=False)},
        ("reach",),
    ),
    Claim(
        "000-3",
        "Whirl radius and its scatter grow with the crossbeam's displacement to 0.2 mm",
        "Figure 10, its text taken literally",
        {
            "radius": Trend("whirl", CROSSBEAM, least=SAME),
            "more dispersed": Trend("scatter", CROSSBEAM, least=SAME),
        },
        ("whirl", "scatter"),
    ),
    Claim(
        "000-3b",
        "The whirl radius grows to 0.1 mm and falls at 0.2 mm",
        "Figure 10, other reading",
        {"radius": Turn("whirl", CROSSBEAM, 1, lowest=False)},
        ("whirl",),
    ),
    Claim(
        "000-4",
        "Any deformation makes spikes in the outer ring's acceleration",
        "Figures 11 and 17",
        {cage: Up("spikes", (SOUND, cage), by=SAME) for cage in CAGES[1:]},
        ("spikes", "shake"),
    ),
    Claim(
        "000-5",
        "Cage speed: as before at 0.1 mm, larger and faster fluctuation at 0.2 mm",
        "Figure 12",
        {
            "unchanged at 0.1": Unchanged("ripple", (SOUND, BENT1), SAME),
            "larger at 0.2": Up("ripple", (SOUND, BENT2), by=CLEARLY),
            "faster at 0.2": Up("pitch", (SOUND, BENT2), by=CLEARLY),
        },
        ("ripple", "pitch"),
    ),
    Claim(
        "000-6",
        "Roller j-1 keeps its speed at 0.1 mm, drops and fluctuates at 0.2 mm; j and j+1 keep "
        "theirs",
        "Figure 13",
        {
            "j-1 keeps it at 0.1": steady("before", BENT1),
            "j-1 drops at 0.2": Up("speed_before", (SOUND, BENT2), by=DROP, rising=False),
            "j-1 fluctuates at 0.2": Up("swing_before", (SOUND, BENT2), by=CLEARLY),
            "j keeps it": steady("at", BENT1, BENT2),
            "j+1 keeps it": steady("after", BENT1, BENT2),
        },
        ("speed_before", "swing_before", "speed_at", "speed_after"),
    ),
    Claim(
        "000-7",
        "Slip of roller j-1 is lower at 0.1 mm and sharply higher at 0.2 mm; that of j and j+1 "
        "stays",
        "Table 2",
        {
            "lower at 0.1": Up("slip_before", (SOUND, BENT1), rising=False),
            "sharply higher at 0.2": Up("speed_before", (SOUND, BENT2), by=DROP, rising=False),
            "j stays": steady("at", BENT1, BENT2),
            "j+1 stays": steady("after", BENT1, BENT2),
        },
        ("slip_before", "slip_at", "slip_after"),
    ),
    Claim(
        "000-8",
        "Stress: as before in a longer pocket, much more in a shorter one",
        "Figure 14",
        {
            "unchanged at +0.3": Unchanged("corner", (SOUND, LONGER), SAME),
            "more at -0.3": Up("corner", (SOUND, SHORTER), by=CLEARLY),
        },
        ("corner", "stress"),
    ),
    Claim(
        "000-8b",
        "In the shorter pocket the root stress is 320.51 MPa, within a factor of two",
        "Conclusion 2",
        {
            "320.51 MPa": Between(
                "corner", (SHORTER,), PRINTED_STRESS / WITHIN, PRINTED_STRESS * WITHIN
            )
        },
        ("corner",),
    ),
    Claim(
        "000-9",
        "Radial displacement: as before in a longer pocket, sinusoidal in a shorter one",
        "Figure 15",
        {
            "unchanged at +0.3": Unchanged("reach", (SOUND, LONGER), SAME),
            "one line at -0.3": Between("line", (SHORTER,), low=SINE),
            "more so than sound": Up("line", (SOUND, SHORTER)),
        },
        ("reach", "line", "order"),
    ),
    Claim(
        "000-10",
        "Orbit: larger and more chaotic in a longer pocket, smaller and regular in a shorter one",
        "Figure 16",
        {
            "larger at +0.3": Up("whirl", (SOUND, LONGER)),
            "more chaotic at +0.3": Up("line", (SOUND, LONGER), rising=False),
            "smaller at -0.3": Up("whirl", (SOUND, SHORTER), rising=False),
            "regular at -0.3": Up("line", (SOUND, SHORTER)),
        },
        ("whirl", "line"),
    ),
    Claim(
        "000-11",
        "Cage speed fluctuates less in a longer pocket, more and faster in a shorter one",
        "Figure 18",
        {
            "less at +0.3": Up("ripple", (SOUND, LONGER), rising=False),
            "more at -0.3": Up("ripple", (SOUND, SHORTER)),
            "faster at -0.3": Up("pitch", (SOUND, SHORTER)),
        },
        ("ripple", "pitch"),
    ),
    Claim(
        "000-12",
        "Roller j keeps its speed in a longer pocket and drops in a shorter one",
        "Figure 19",
        {
            "keeps it at +0.3": steady("at", LONGER),
            "drops at -0.3": Up("speed_at", (SOUND, SHORTER), by=DROP, rising=False),
        },
        ("speed_at",),
    ),
    Claim(
        "000-13",
        "A shorter pocket changes the slip of j-1 and j+1; a moved crossbeam leaves j and j+1 "
        "alone",
        "Tables 2 and 3",
        {
            "shorter: j-1 changes": Differs("slip_before", (SOUND, SHORTER), SAME),
            "shorter: j+1 changes": Differs("slip_after", (SOUND, SHORTER), SAME),
            "crossbeam: j stays": steady("at", BENT2),
            "crossbeam: j+1 stays": steady("after", BENT2),
        },
        ("slip_before", "slip_at", "slip_after"),
    ),
)
