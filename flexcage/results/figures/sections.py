"""The sections of a summary that follow from what a run recorded: motion, forces, energy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from flexcage.results.figures.energy import ENERGY
from flexcage.results.figures.figure import CAGED, SETTLING, Figure, FigureTable, rows_of
from flexcage.results.figures.forces import CONTACTS, FORCES, NEXT
from flexcage.results.figures.motion import MOTION
from flexcage.results.figures.own import SECTION, own_rows
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.rings import INNER, OUTER, constraint_rows
from flexcage.results.figures.speeds import SPEEDS, STATISTICS, Taken
from flexcage.results.figures.table import FIGURES
from flexcage.results.figures.vibration import FREQUENCIES, VIBRATION
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.row import SummaryRow, with_others
from flexcage.results.summary import Section, Summary


def summarise(part: SettledRun) -> Summary:
    """Summary of a run's motion and forces after its start; stress, solver and times come from
    those who know them, by :meth:`Summary.with_figures`."""
    sections = [section for section in _sections(part) if section.rows]
    records = {row.key: row.record for section in sections for row in section.rows}
    watched: dict[Figure, Any] = {
        figure: records[key]
        for key, figure in FIGURES.items()
        if SETTLING in figure.marks and records.get(key) is not None
    }
    first = Section(STATISTICS.section, STATISTICS.rows(Taken(part, watched), words=part.words))
    return Summary((first, *sections))


#: Sections whose figures of a cage are those of one, where each row has one.
_OF_A_CAGE = (SPEEDS, MOTION, CONTACTS)


def _of_each_cage(figures: Iterable[Figure], part: SettledRun) -> Iterator[SummaryRow]:
    """Rows of figures of a run in which each row of elements has a cage: of that at -x, with the
    values of the others in notes."""
    for figure in figures:
        of_cage = figure.needs == CAGED or figure.section == MOTION.section
        parts = part.each if of_cage else (part,)
        rows = [row for one in parts for row in rows_of([figure], one, part.lacks, part.words)]
        if rows:
            yield with_others(rows)


def _sections(part: SettledRun) -> Iterator[Section]:
    own, facts = part.of_family, (part, part.lacks, part.words)

    def of(table: FigureTable[SettledRun]) -> Section:
        """A section, which the family's own figures close."""
        added = [figure for figure in own.figures.values() if figure.section == table.section]
        figures = (*table.figures.values(), *added)
        if len(part.each) > 1 and table in _OF_A_CAGE:
            return Section(table.section, tuple(_of_each_cage(figures, part)))
        return Section(table.section, rows_of(figures, *facts))

    yield of(SPEEDS)
    yield of(FREQUENCIES)
    yield Section(own.slip_title, rows_of([FIGURES[key] for key in own.slip], *facts))
    if part.caged:
        yield of(MOTION)
    yield of(FORCES)
    yield of(CONTACTS)
    if NEIGHBOURS in part.run:
        yield of(NEXT)
    yield of(INNER)
    if "outer_force" in part.run:
        yield of(OUTER)
    if "outer_acceleration" in part.run:
        yield of(VIBRATION)
    yield Section("Constraints", tuple(constraint_rows(part)))
    if "energy" in part.run and "work" in part.run:
        yield of(ENERGY)
    yield Section(SECTION, own_rows(part))
