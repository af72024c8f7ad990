"""The page of a repeated paper, which its author should sign, and the appendix for a referee.

The page says in three sentences what was found, shows one picture of it, says what was printed,
inferred and swept, and then goes figure by figure: what the paper says, our figure, the verdict,
the mechanism. Statistics stand in the appendix. A page that nobody would read is refused.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from textwrap import wrap

from judging.judge import CONTRADICTED, REPRODUCED, UNDER, UNTESTABLE, Judged

MOST_LINES, MOST_NUMBERS, MOST_WORDS, WIDE = 150, 2, 25, 110
NUMBER = re.compile(r"(?<![\w.-])[-+±(]?\d[\d.,]*")
MARKS = {REPRODUCED: "✓", UNDER: "◐", CONTRADICTED: "✗", UNTESTABLE: "–"}
LEGEND = """✓ reproduced: at 80 % or more of the settings that the text allows. ◐ reproduced under a
condition: at 80 % or more of a region, named here, of a tenth of the settings or more. ✗
contradicted: at 10 % or less, and the runs say why. – not testable. All statistics are in the
[appendix](appendix.md)."""


@dataclass(frozen=True)
class Table:
    """A table of the page."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclass(frozen=True)
class Found:
    """A finding with its verdict; ``condition`` names the region under which it is reproduced."""

    claim: str  # key of its claim
    text: str  # what is claimed, a short paraphrase
    part: str  # of the claim
    where: str
    judged: Judged
    condition: str = ""

    @property
    def why(self) -> str:
        """The condition that it is reproduced under, or what contradicts it."""
        verdict = self.judged.verdict
        return {UNDER: self.condition, CONTRADICTED: self.judged.reason}.get(verdict, "")

    @property
    def marked(self) -> str:
        """The part with the mark of its verdict, and the condition that it is reproduced under."""
        under = f" ({self.condition})" if self.judged.verdict == UNDER else ""
        return f"{MARKS[self.judged.verdict]} {self.part}{under}"

    @property
    def said(self) -> str:
        """The verdict in a few words, with the reason of what is not testable."""
        verdict = self.judged.verdict
        under = f" {self.condition}" if verdict == UNDER else ""
        why = f": {self.judged.reason}" if verdict == UNTESTABLE and self.judged.reason else ""
        return f"{MARKS[verdict]} {verdict}{under}{why}"


@dataclass(frozen=True)
class Figure:
    """One figure of the paper: what it says in our words, our picture of it, the claims that are
    read from it, and the mechanism in two lines."""

    title: str
    says: str
    picture: str
    claims: Sequence[str]
    mechanism: str


@dataclass(frozen=True, kw_only=True)
class Page:
    """All that a page holds, in order."""

    title: str
    source: str
    summary: str  # three sentences of physics
    hero: tuple[str, str]  # picture and caption
    model: Sequence[str] = ()  # a sketch, equations that matter, in Markdown
    known: Table  # printed, inferred, swept
    figures: Sequence[Figure]
    found: Sequence[Found]
    asks: Sequence[str]  # what we would ask the authors
    cost: str  # processor time, version, date
    appendix: Sequence[Table] = field(default=())
    history: Sequence[str] = ()  # rules changed after results were seen, once
    files: Sequence[str] = ()


def compose(page: Page) -> str:
    """The page as Markdown; ValueError for one that is too long, or a cell that is too full."""
    by_claim: dict[str, list[Found]] = {}
    for found in page.found:
        by_claim.setdefault(found.claim, []).append(found)
    parts = [
        f"# {page.title}", wrapped(page.summary), f"![{page.hero[1]}]({page.hero[0]})",
        wrapped(page.hero[1]), *page.model, table(page.known), "## Figure by figure",
        *(_figure(figure, by_claim) for figure in page.figures),
        "## All claims", _claims(page.found), wrapped(LEGEND),
        "## What we would ask the authors", bullets(page.asks),
        wrapped(f"Paper: {page.source}. {page.cost}"),
    ]  # fmt: skip
    text = "\n\n".join(part for part in parts if part) + "\n"
    if text.count("\n") > MOST_LINES:
        raise ValueError(f"the page has {text.count(chr(10))} lines, more than {MOST_LINES}")
    return text


def compose_appendix(page: Page) -> str:
    """The appendix as Markdown: shares, chances, regions, power, ranges, and what was changed."""
    rows = [
        (f.claim, f.part, f.judged.verdict, _share(f.judged), _chance(f.judged), _region(f))
        for f in page.found
    ]
    shares = Table(
        "Shares of settings",
        ("claim", "finding", "verdict", "holds (95 %)", "by chance", "clearest region"),
        rows,
    )
    parts = [
        f"# Appendix: {page.title}",
        wrapped("The [page](README.md) has the figures. Here are the statistics behind its "
                "verdicts; [how claims are judged](../README.md#how-a-claim-is-judged)."),
        table(shares, full=True), *(table(t, full=True) for t in page.appendix),
    ]  # fmt: skip
    if page.history:
        parts += ["## Changed after results were seen", bullets(page.history)]
    if page.files:
        parts += ["All numbers: " + ", ".join(f"[{file}]({file})" for file in page.files) + "."]
    return "\n\n".join(parts) + "\n"


def _share(judged: Judged) -> str:
    if not judged.decided:
        return "-"
    return f"{judged.share:.0%} ({judged.low:.0%} to {judged.high:.0%}) of {judged.decided}"


def _chance(judged: Judged) -> str:
    return "-" if judged.chance != judged.chance else f"{judged.chance:.0%}"


def _region(found: Found) -> str:
    region = found.judged.region
    if region is None:
        return "-"
    return f"{found.condition}: {region.share:.0%} of {region.size:.0%}, p {region.p:.1g}"


def _figure(figure: Figure, by_claim: dict[str, list[Found]]) -> str:
    found = [one for key in figure.claims for one in by_claim[key]]
    lines = [f"### {figure.title}", wrapped(f"*The paper:* {figure.says}")]
    lines += [f"![{figure.title}]({figure.picture})"] if figure.picture else []
    lines += [wrapped(" ".join([*_by_verdict(found), figure.mechanism]))]
    return "\n\n".join(lines)


def _by_verdict(found: Sequence[Found]) -> list[str]:
    """Sentences: each verdict with the findings that have it."""
    sentences = []
    for verdict, mark in MARKS.items():
        parts = [f.part + (f" ({f.why})" if f.why else "")
                 for f in found if f.judged.verdict == verdict]  # fmt: skip
        if parts:
            word = "reproduced under a condition" if verdict == UNDER else verdict
            sentences.append(f"**{mark} {word.capitalize()}:** {'; '.join(parts)}.")
    return sentences


def _claims(found: Sequence[Found]) -> str:
    """One row a claim: its findings, each with the mark of its verdict, and the condition if it
    has one."""
    claims = {one.claim: one for one in found}
    rows = [
        (key, f"{one.text} ({one.where})", "; ".join(f.marked for f in found if f.claim == key))
        for key, one in claims.items()
    ]
    # claims and conditions need the words and numbers that they have
    return table(Table("", ("", "claim", "findings"), rows), free=("claim", "findings"))


def wrapped(text: str) -> str:
    """One paragraph in lines of a page's width."""
    return "\n".join(wrap(" ".join(text.split()), WIDE, break_long_words=False))


def bullets(items: Sequence[str]) -> str:
    """A list."""
    return "\n".join(
        "\n".join(wrap(" ".join(item.split()), WIDE, initial_indent="- ", subsequent_indent="  ",
                       break_long_words=False)) for item in items
    )  # fmt: skip


def table(found: Table, *, full: bool = False, free: Sequence[str] = ()) -> str:
    """A table in Markdown; ValueError for a cell of too many words or, unless ``full``, numbers;
    columns that are ``free`` may hold any."""
    strict = [k for k, name in enumerate(found.head) if name not in free]
    for cell in (str(row[k]) for row in found.rows for k in strict):
        numbers = len(NUMBER.findall(cell))
        if not full and (len(cell.split()) > MOST_WORDS or numbers > MOST_NUMBERS):
            raise ValueError(f"a cell of '{found.title}' is too full: {cell}")
    lines = [f"| {' | '.join(found.head)} |", "|" + " --- |" * len(found.head)]
    lines += [f"| {' | '.join(map(str, row))} |" for row in found.rows]
    head = f"**{found.title}**\n\n" if found.title else ""
    return head + "\n".join(lines)
