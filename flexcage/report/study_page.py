"""The page of a study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from flexcage.report.blocks import (
    Block,
    Charts,
    Gallery,
    Image,
    Notices,
    Page,
    PageSection,
    PageTable,
    Prose,
    SideBySide,
    Text,
)
from flexcage.report.cage_view import CageStress, cage_chart
from flexcage.report.comparison import Abscissa, Output, comparison_charts
from flexcage.report.extras import extra_figures
from flexcage.report.tables import assumption_table

_FEWEST_CHARTS, _MOST_MARKS = 2, 16_000  # of comparisons, and of marks in all, to keep a page light
_MOST_OPEN = 12  # charts that are not folded away


@dataclass(frozen=True, kw_only=True)
class StudyAccount:
    """What the page of a study tells, as values."""

    name: str
    folder: Path
    status: str  # how many cases are done
    varied: Sequence[str]  # what was varied, in words
    base: Sequence[str]  # the base case, in words
    statistics: PageTable  # a row a point
    cases: PageTable  # a row a case
    audits: PageTable  # energy and work, a row a case
    outputs: Sequence[Output]
    abscissas: Sequence[Abscissa]
    points: Sequence[str]  # names of the points
    failures: Sequence[str]
    named: Sequence[PageTable] = ()  # what points with names of their own change
    stress: Sequence[CageStress] = ()  # of the cases shown
    scale: float = 1.0  # of their deformation
    images: Sequence[Image] = ()  # of their stress
    chosen: str = ""  # which cases are shown, and why not all
    assumptions: Mapping[str, tuple[str, str]]  # by path: a value, and the reason for it
    study_text: str  # study.toml
    commands: str


def study_page(account: StudyAccount) -> Page:
    """The page: what was varied and tables first; how to repeat it last."""
    sections = [
        PageSection("What was varied", [_varied(account), *account.named]),
        PageSection("Warnings", [Notices(account.failures, none="None.")]),
        PageSection("Results", [account.statistics, account.cases]),
        _comparison(account),
        *_stress(account),
        *filter(None, [extra_figures(account.folder)]),
        PageSection("Energy audit and solver", [account.audits]),
        PageSection("Base case", [
            Prose(account.base),
            assumption_table(account.assumptions, fold="Its values that no source gives"),
        ]),
        PageSection("How to reproduce", [
            Text("Commands", account.commands, open=True), Text("study.toml", account.study_text),
        ]),
    ]  # fmt: skip
    return Page(f"{account.name}: report of a study", account.status, sections)


def _varied(account: StudyAccount) -> Block:
    """What was varied, beside the first picture that there is."""
    prose = Prose(account.varied)
    return SideBySide(prose, account.images[0]) if account.images else prose


def _comparison(account: StudyAccount) -> PageSection:
    charts = comparison_charts(account.outputs, account.abscissas, account.points)
    if not charts:
        return PageSection("Comparison", [Prose(["There is nothing to compare yet."])])
    notes = ["Bars are 95 % intervals over the repetitions. Point at a mark for its case."]
    marks = len(account.points) * len(account.abscissas)  # of a chart
    kept = charts[: max(_FEWEST_CHARTS, _MOST_MARKS // marks)]
    if len(kept) < len(charts):
        notes.append(
            f"The first {len(kept)} of {len(charts)} outputs; statistics.csv has all figures."
        )
    blocks: list[Block] = [Prose(notes), Charts(kept[:_MOST_OPEN])]
    if folded := kept[_MOST_OPEN:]:
        blocks.append(Charts(folded, f"{len(folded)} more outputs"))
    return PageSection("Comparison", blocks)


def _stress(account: StudyAccount) -> list[PageSection]:
    blocks: list[Block] = [Prose([account.chosen])] if account.chosen else []
    if account.images:
        blocks.append(Gallery(account.images))
    if account.stress:
        title = "Equivalent stress at each case's peak"
        view = cage_chart(account.stress, scale=account.scale, title=title)
        # beside pictures of the same, the view is folded away
        blocks.append(
            Charts([view], "The same cages in 3D, to be turned") if account.images else view
        )
    return [PageSection("Stress in the cage", blocks)] if blocks else []
