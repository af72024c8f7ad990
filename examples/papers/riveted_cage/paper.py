"""The paper on riveted cages under a moment: its readings, its maps, and what was found."""

from __future__ import annotations

import numpy as np
from claims import BASE, CLAIMS, FORCE, RADII
from figures import BETTER, CAGE, FLEXIBLE, MODEL, RACE, draw, mean, tables
from paper_page import number
from repeat import Computed, Paper, Words

from flexcage.study import StudyResults
from flexcage.study.surface import response_surface

BY_RIVETS = ("001-1b", "001-4b", "001-11")
BY_RACES = ("001-5", "001-5b", "001-6")
DECIDED_BY = (
    {claim.key: CAGE for claim in CLAIMS}
    | dict.fromkeys(BY_RIVETS, FLEXIBLE)
    | dict.fromkeys(BY_RACES, RACE)
)
"""Rivets are stressed in flexible cages alone, which no map has: eight starts of one reading."""


def said(reading, output: str, condition: str, factor: float = 1.0) -> str:
    """Mean of the starts ± half of its interval."""
    return number(*mean(reading, output, condition), factor=factor) if reading else "-"


def over(reading, output: str, conditions, factor: float = 1.0) -> str:
    """Means of the starts over conditions, without their intervals."""
    found = (mean(reading, output, c)[0] * factor for c in conditions)
    return ", ".join(f"{value:.3g}" for value in found)


def middle(computed: Computed, column: str, output: str, condition: str, factor: float) -> str:
    """Median of a map and its middle 80 %."""
    found = computed.maps[column].means(output, condition)
    if not np.isfinite(found).any():
        return "-"
    low, mid, high = np.nanpercentile(found, (10.0, 50.0, 90.0)) * factor
    return f"{mid:.2g} ({low:.2g} to {high:.2g})"


def by(computed: Computed, column: str, key: str) -> str:
    """What decides a claim over a map, in words."""
    clear = [d for d in computed.found[column][key].deciders if d.p < 0.05]
    if not clear:
        return "no unknown alone decides it"
    names = (f"{'large' if d.holds_above else 'small'} {d.name}" for d in clear[:3])
    return f"decided by {', '.join(names)}"


def part(computed: Computed, column: str, key: str, name: str) -> str:
    """Share of one part of a claim."""
    found = computed.found[column][key].parts
    known = name in found and found[name].decided
    return f"{found[name].value:.0%}".replace("%", " %") if known else "-"


def surface(computed: Computed):
    """The response surface through the 49 points of Table 3."""
    axes = ("cage.pocket_diameter", "cage.width")
    return response_surface(StudyResults(computed.out / "design"), FORCE, axes=axes)


def words(computed: Computed) -> Words:
    """Summary, reasons, what decides, and readings, with the numbers of what was computed."""
    return Words("", {c.key: "" for c in computed.paper.claims}, [], [])


PAPER = Paper(
    title="A riveted cage under an overturning moment",
    source="Failure Inducement Factor Analysis and Optimal Design Method of Ball Bearing Cage for "
    "Aviation Motor, Machines 2024, 12(7), 466",
    claims=CLAIMS,
    readings="reading_better.toml",
    columns={"better": BETTER},
    alone={MODEL: ("reading_printed.toml", "printed"),
           FLEXIBLE: ("reading_flexible.toml", "flexible")},
    maps={CAGE: ("map_cage_6747.toml", "map_cage_6470.toml"),
          RACE: ("map_race_6747.toml", "map_race_6470.toml")},
    decided_by=DECIDED_BY,
    studies=("design.toml",),
    rechecks={"map_cage_6747.toml": (0, 3, 6), "map_cage_6470.toml": (1, 4)},
    recheck_conditions=(RADII[0], BASE, RADII[-1], "modified 9000", "original 9000"),
    stress=("case.toml", {
        "cage.model": "flexible", "cage.pocket_diameter": "7.2 mm", "cage.width": "8 mm",
    }),
    draw=draw,
    tables=tables,
    words=words,
    files=("predictions.json", "printed.toml", "fits.csv", "lives.csv"),
)  # fmt: skip
