"""The one list of a summary's figures: title, unit, meaning, which runs have them, what gives them.

Summaries take their rows from it, studies what they may ask for, terminals and plots what to show,
and documentation prints it (``flexcage figures``).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from flexcage.core.binding import near_names
from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.core.wings import FAMILIES, Parts
from flexcage.results.figures.cage import CAGE, MODES, PINCH, SUPPORT
from flexcage.results.figures.effort import SOLVER, TIMES
from flexcage.results.figures.energy import ENERGY
from flexcage.results.figures.figure import STATISTIC, TEXT, Figure
from flexcage.results.figures.film import FILM
from flexcage.results.figures.fits import FITS
from flexcage.results.figures.forces import CONTACTS, FORCES, NEXT
from flexcage.results.figures.life import LIFE
from flexcage.results.figures.motion import MOTION
from flexcage.results.figures.part import OwnFigures
from flexcage.results.figures.rings import INNER, OUTER
from flexcage.results.figures.speeds import SLIP, SPEEDS, STATISTICS
from flexcage.results.figures.stress import (
    DAMAGE,
    RIVETS,
    RIVETS_TIME,
    STRESS,
    STRESS_TIME,
    TRACKS,
)
from flexcage.results.figures.vibration import FREQUENCIES, VIBRATION
from flexcage.results.registry import whose

#: The sections of a summary, in order.
_TABLES = (
    STATISTICS, SPEEDS, FREQUENCIES, SLIP, MOTION, FORCES, CONTACTS, NEXT, INNER, OUTER,
    VIBRATION, ENERGY, FILM, FITS, LIFE, SUPPORT, CAGE, PINCH, MODES, STRESS, STRESS_TIME,
    RIVETS, RIVETS_TIME, DAMAGE, TRACKS, SOLVER, TIMES,
)  # fmt: skip


class _BySection(Parts[Figure]):
    """Figures in the order of a summary: those of a family close their section, and
    sections of its own come last."""

    def _all(self) -> dict[str, Figure]:
        found = super()._all()
        place = {s: k for k, s in enumerate(dict.fromkeys(f.section for f in found.values()))}
        return dict(sorted(found.items(), key=lambda item: place[item[1].section]))


def of_family(family: Any) -> Mapping[str, Figure]:
    """Figures of one family by name; none if it has no motion."""
    found: OwnFigures | None = family.figures() if family.figures else None
    return found.figures if found else {}


#: Every figure by name, in the order of a summary.
FIGURES: Parts[Figure] = _BySection(
    FAMILIES, of_family, what="figure",
    common={key: figure for table in _TABLES for key, figure in table.figures.items()},
)  # fmt: skip


def marked(mark: str) -> tuple[str, ...]:
    """Names of the figures that have a mark, in the order of a summary."""
    return tuple(key for key, figure in FIGURES.items() if mark in figure.marks)


#: What the list says of marks.
_KINDS = {TEXT: "a text", STATISTIC: "with an interval"}
PAGE = """# Figures of a run

Printed by `flexcage figures`.

A summary holds them (`run.summary["NAME"]`, in SI units), and studies take those that are
numbers as outputs. A figure "with an interval" comes with half of its 95 % interval
(`run.summary.row("NAME").margin`) where the run is long enough. All but the energies are of the
settled part.
"""


def near_figure(text: str) -> str:
    """The figure whose name is nearest to a text, as a part of a sentence; empty if none is."""
    close = near_names(text, FIGURES, 1)
    return f"; the nearest name is '{close[0]}'" if close else ""


def listing(text: str = "") -> Listing:
    """Figures whose name, title or meaning holds the text. InputError if there are none."""
    wanted = text.lower()
    found = [
        figure
        for figure in FIGURES.values()
        if wanted in " ".join((figure.key, figure.title, figure.meaning, figure.section)).lower()
    ]
    if not found:
        raise InputError(
            f"No figure has the text '{text}'{near_figure(text)}; 'flexcage figures' lists all.",
            where="figures",
            value=text,
        )
    rows = []
    for f in found:
        needs = f"needs {f.needs}" if f.needs else ""
        kind = [word for mark, word in _KINDS.items() if mark in f.marks]
        said = "; ".join(filter(None, (f.meaning, *kind, whose(FIGURES.owners(f.key)), needs)))
        rows.append((f.key, f.shown, f"{f.title}: {said}" if said else f.title))
    return Listing("Figures of a run", ("figure", "unit", "meaning"), rows)
