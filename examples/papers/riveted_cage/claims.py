"""What the paper on riveted cages claims, as findings with rules on figures of runs.

Rules were written down before the samples' runs; paper.py names what was changed since. Slip is
judged by its size |S_c|: equation 10 lacks the contact angle's cosine, so that its sign follows
from geometry. The signed one is an output beside it. Stress of rivets is nominal, in the shank of
the most stressed one: the head's root multiplies it by a number that is the same for one rivet.
"""

from __future__ import annotations

from judging.findings import Below, Claim, Same, Trend, Turn, Within

FORCE = "pocket_turn_largest"  # mean over turns of the cage of the largest ball-cage force in each
ROOT = "rivet"  # nominal stress of the most stressed rivet, mean of the largest of ball passes
SLIP, TILT = "slip_size", "psi"
BASE = "base"
RADII = ("Rp 3.43", BASE, "Rp 3.49")
WIDTHS = ("w 8.0", BASE, "w 4.4")
SHEETS = ("t 0.7", BASE, "t 1.0")
INNER = ("f_i 0.505", BASE, "f_i 0.525")
OUTER = ("f_e 0.515", BASE, "f_e 0.530")
CLEARANCES = ("Pd 5", BASE, "Pd 20")
NEAR = 0.2  # of printed forces
LIKE = 0.15  # of printed slips: "the error was found to be less than 15 %"
FLAT = 0.002  # "no significant change" of the slip: about a quarter of what parts the two cages
CLEARLY = 0.1  # of rivets' stress
#: Scatter of starts over their mean; of the largest force of each turn, over four turns, as that
#: over sixteen scatters by 0.6 to 1.1 N of 31. Slip scatters by 1.6 % in the rig's reading.
SCATTER = {FORCE: 0.06, ROOT: 0.15, SLIP: 0.02, TILT: 0.1,
           "root_tight": 0.1, "eave_tight": 0.1, "root_loose": 0.1, "eave_loose": 0.1}  # fmt: skip


def about(output: str, printed: dict[str, tuple[str, float]], within: float) -> dict[str, Within]:
    """Printed numbers by name: a condition and a value, each within a share of it."""
    return {
        name: Within(output, (condition,), (1.0 - within) * value, (1.0 + within) * value)
        for name, (condition, value) in printed.items()
    }


def falls(output: str, conditions: tuple[str, ...], by: float = 0.0) -> Trend:
    """An output falls along the conditions."""
    return Trend(output, (conditions[0], conditions[-1]), rising=False, by=by)


def rises(output: str, conditions: tuple[str, ...], by: float = 0.0) -> Trend:
    """An output rises along the conditions."""
    return Trend(output, (conditions[0], conditions[-1]), by=by)


CLAIMS = (
    Claim(
        "001-1", "Over the pocket radius the ball-cage force is least at 3.46 mm",
        "Figure 5a",
        {"force least near 3.46": Turn(FORCE, RADII, highest=False, at=(3.43, 3.46, 3.49))},
        change=0.16,
    ),
    Claim(
        "001-1b", "and so is the stress of the rivets", "Figure 5b",
        {"rivets least near 3.46": Turn(ROOT, RADII, highest=False, at=(3.43, 3.46, 3.49))},
        change=0.4,
    ),
    Claim(
        "001-2", "Slip rises with the pocket radius, the cage's tilt falls", "Figure 5c",
        {"slip rises": rises(SLIP, RADII), "tilt falls": falls(TILT, RADII)},
    ),
    Claim(
        "001-3", "Over the width the force is least near 6.2 mm", "Figure 6a",
        {"force over width": Turn(FORCE, WIDTHS, highest=False, at=(8.0, 6.5, 4.4))}, change=0.13,
    ),
    Claim(
        "001-3b", "Slip is least there too, and the tilt falls with width", "Figure 6c",
        {"slip over width": Turn(SLIP, WIDTHS, highest=False, at=(8.0, 6.5, 4.4)),
         "tilt over width": rises(TILT, WIDTHS)},
    ),
    Claim(
        "001-4", "Over the sheet's thickness the force is least at 0.8 mm, the slip unchanged",
        "Figure 7",
        {"force over sheet": Turn(FORCE, SHEETS, highest=False, at=(0.7, 0.8, 1.0)),
         "slip over sheet": Same(SLIP, SHEETS, within=FLAT, absolute=True)},
    ),
    Claim(
        "001-4b", "The rivets' stress falls as the sheet gets thicker", "Figure 7a",
        {"rivets over sheet": falls(ROOT, SHEETS)}, change=0.4,
    ),
    Claim(
        "001-5", "Wider grooves, inner or outer, lower tilt and slip", "Figures 9b, 9d",
        {f"{name}, {which}": falls(output, where)
         for which, where in (("inner", INNER), ("outer", OUTER))
         for name, output in (("tilt", TILT), ("slip", SLIP))},
    ),
    Claim(
        "001-5b", "and the ball-cage force", "Figures 9a, 9c",
        {"force, inner": falls(FORCE, INNER), "force, outer": falls(FORCE, OUTER)},
    ),
    Claim(
        "001-6", "Force, tilt and slip rise with the radial clearance", "Figures 9e, 9f",
        {f"{name}, clearance": rises(output, CLEARANCES)
         for name, output in (("force", FORCE), ("tilt", TILT), ("slip", SLIP))},
    ),
    Claim(
        "001-7", "Stress of a rivet peaks at its head's edge under interference, at the head's "
        "root with play, which relieves the edge", "Figure 10",
        {"edge under interference": Below("root_tight", "eave_tight", (BASE,)),
         "root with play": Below("eave_loose", "root_loose", (BASE,)),
         "edge relieved": Below("eave_loose", "eave_tight", (BASE,))},
    ),
    Claim(
        "001-8", "The original cage slips more than the modified one at 9000 rpm", "Table 4",
        {"original slips more": Trend(SLIP, ("modified 9000", "original 9000"))},
    ),
    Claim(
        "001-9", "Slips of both cages are as measured, within 15 %", "Table 4",
        about(SLIP, {"modified, 1.13 %": ("modified 9000", 0.0113),
                     "original, 1.84 %": ("original 9000", 0.0184)},
              LIKE),
    ),
    Claim(
        "001-10", "Forces at the best radius and the ends are as printed, within 20 %", "Table 3",
        about(FORCE, {"25.1 N at 3.46": (BASE, 25.12), "29.7 N at 3.43": (RADII[0], 29.657),
                      "28.7 N at 3.49": (RADII[-1], 28.734)}, NEAR),
    ),
    Claim(
        "001-11", "The original cage fails before the modified one, at its rivets", "Figure 12",
        {"original more stressed": Trend(ROOT, ("modified 9000", "original 9000"), by=CLEARLY)},
        change=0.4,
    ),
)  # fmt: skip
RACES = ("001-5", "001-5b", "001-6")  # judged where grooves and clearance vary
RIVETS = ("001-1b", "001-4b", "001-11")  # with a flexible cage
JOINTS = ("001-7",)  # with the most stressed rivet's joint as a contact problem
