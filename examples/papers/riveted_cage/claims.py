"""What the paper on riveted cages claims, as rules and tests on figures of runs.

Thresholds were written down before any run of a map or of a reading.
"""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.study.claims import Between, Claim, Trend, Turn
from flexcage.study.decisions import Evidence, all_of, equal

FORCE = "pocket_peak.turn_max"  # mean over turns of the cage of the largest ball-cage force in each
ROOT = "fillet"  # range of stress at the roots of rivets' heads, by contact
DESIGN_AXES = ("cage.pocket_diameter", "cage.width")  # of the 49-point design, Table 3
BASE = "base"
RADII = ("Rp 3.43", "Rp 3.44", "Rp 3.45", BASE, "Rp 3.47", "Rp 3.48", "Rp 3.49")
WIDTHS = ("w 8.0", "w 7.4", "w 6.8", BASE, "w 5.9")
SHEETS = ("t 0.7", BASE, "t 1.0")
INNER = ("f_i 0.505", BASE, "f_i 0.525")
OUTER = ("f_e 0.515", BASE, "f_e 0.530")
CLEARANCES = ("Pd 5", BASE, "Pd 20")
SPEEDS = ("7000", "8000", "9000")  # rpm

ENDS_OF_RADII = (RADII[0], BASE, RADII[-1])  # a claim's rule compares ends and best: a map has one
ENDS_OF_WIDTHS = (WIDTHS[0], BASE, WIDTHS[-1])  # start a point, whose neighbours differ by chance
FLAT = 0.002  # "no significant change" of the slip: about a quarter of what parts the two cages
NEAR = 0.2  # of printed forces
LIKE = 0.15  # of printed slips: "the error was found to be less than 15 %"
CLEARLY = 0.1  # of rivets' stress


@dataclass(frozen=True)
class Unchanged:
    """An output is under all ``conditions`` within ``within`` of what it is under the first."""

    output: str
    conditions: tuple[str, ...]
    within: float

    def holds(self, at) -> bool:
        first, *others = (at(self.output, c) for c in self.conditions)
        return all(abs(other - first) < self.within for other in others)

    def evidence(self, values) -> Evidence:
        first, *others = (values(self.output, c) for c in self.conditions)
        return all_of(equal(first, o, within=self.within, absolute=True) for o in others)


def ends(conditions: tuple[str, ...]) -> tuple[str, str]:
    return conditions[0], conditions[-1]


def about(output: str, printed: dict[str, float], within: float) -> dict[str, Between]:
    """Printed numbers by condition, each within a share of it."""
    return {
        condition: Between(output, (condition,), (1.0 - within) * value, (1.0 + within) * value)
        for condition, value in printed.items()
    }


CLAIMS = (
    Claim(
        "001-1", "Over the pocket radius the ball-cage force has its least at 3.46 mm",
        "Figure 5a, Table 3", {"force": Turn(FORCE, ENDS_OF_RADII, 1)}, (FORCE,),
    ),
    Claim(
        "001-1b", "and so has the stress of the rivets",
        "Figure 5b", {"rivets": Turn(ROOT, ENDS_OF_RADII, 1)}, (ROOT,),
    ),
    Claim(
        "001-2", "Slip rises with the pocket radius, the cage's tilt falls",
        "Figure 5c",
        {"slip": Trend("slip", ENDS_OF_RADII), "tilt": Trend("psi", ENDS_OF_RADII, rising=False)},
        ("slip", "psi"),
    ),
    Claim(
        "001-3", "Over the width the force has its least at 6 to 6.5 mm",
        "Figure 6a, Table 3", {"force": Turn(FORCE, ENDS_OF_WIDTHS, 1)}, (FORCE,),
    ),
    Claim(
        "001-3b", "Slip is least there too, and the tilt falls with width",
        "Figure 6c",
        {"slip": Turn("slip", ENDS_OF_WIDTHS, 1),
         "tilt": Trend("psi", tuple(reversed(ENDS_OF_WIDTHS)), rising=False)},
        ("slip", "psi"),
    ),
    Claim(
        "001-4", "Over the sheet's thickness the force is least at 0.8 mm, the slip unchanged",
        "Figure 7",
        {"force": Turn(FORCE, SHEETS, 1), "slip": Unchanged("slip", SHEETS, FLAT)},
        (FORCE, "slip"),
    ),
    Claim(
        "001-4b", "The rivets' stress falls as the sheet gets thicker",
        "Figure 7a", {"rivets": Trend(ROOT, SHEETS, rising=False)}, (ROOT,),
    ),
    Claim(
        "001-5", "Wider grooves, inner or outer, lower tilt and slip",
        "Figure 9b, 9d",
        {f"{name}, {which}": Trend(name, ends(where), rising=False)
         for which, where in (("inner", INNER), ("outer", OUTER)) for name in ("psi", "slip")},
        ("psi", "slip"),
    ),
    Claim(
        "001-5b", "and the ball-cage force",
        "Figure 9a, 9c",
        {which: Trend(FORCE, ends(where), rising=False)
         for which, where in (("inner", INNER), ("outer", OUTER))},
        (FORCE,),
    ),
    Claim(
        "001-6", "Force, tilt and slip rise with the radial clearance",
        "Figure 9e, 9f",
        {name: Trend(name, ends(CLEARANCES)) for name in (FORCE, "psi", "slip")},
        (FORCE, "psi", "slip"),
    ),
    Claim(
        "001-8", "The original cage slips more than the modified one at 9000 rpm",
        "Table 4", {"slip": Trend("slip", ("modified 9000", "original 9000"))}, ("slip",),
    ),
    Claim(
        "001-9", "Measured slips: 1.13 % of the modified, 1.84 % of the original cage",
        "Table 4", about("slip", {"modified 9000": 0.0113, "original 9000": 0.0184}, LIKE),
        ("slip",),
    ),
    Claim(
        "001-10", "Forces of 25.1 N at best, 29.7 and 28.7 N at radii of 3.43 and 3.49 mm",
        "Table 3", about(FORCE, {BASE: 25.12, "Rp 3.43": 29.657, "Rp 3.49": 28.734}, NEAR),
        (FORCE,),
    ),
    Claim(
        "001-11", "The original cage fails before the modified one, at its rivets",
        "Figure 12",
        {"rivets": Trend(ROOT, ("modified 9000", "original 9000"), least=CLEARLY)},
        (ROOT,),
    ),
)  # fmt: skip
