"""A claim of a paper: parts that are tested on a study's figures, and the verdict on it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isfinite

from n1013_view import BASE, PAPER, Rows, View, shown

from flexcage.study.verdicts import UNDECIDED, Verdict, every, range_along, range_of

Test = Callable[[View], str]

#: What the paper does not say: the axes over which a claim's range is sought, their units, and the
#: variation at each value.
AXES = {
    "Cq - Dw": ("mm", {0.15: "Cq - Dw 0.15", 0.20: BASE, 0.25: "Cq - Dw 0.25"}),
    "Cp - Lw": ("mm", {0.20: "Cp - Lw 0.20", 0.25: BASE, 0.30: "Cp - Lw 0.30"}),
    "Z": ("", {21: "Z 21", 22: BASE}),
}


@dataclass(frozen=True)
class Claim:
    """One statement of the paper: the tests of its parts, all of which must hold, and the figures
    that show it."""

    key: str
    text: str
    parts: Mapping[str, Test]
    figures: tuple[str, ...]
    cages: tuple[str, ...]
    source: str = PAPER

    def verdict(self, rows: Rows, variations: tuple[str, ...]) -> Verdict:
        """The verdict at the base clearances, and where else it holds of what was computed."""
        views = {name: View(rows, name) for name in variations}
        computed = [name for name, v in views.items() if self._shown_by(v)]
        partly = [name for name in computed if not all(map(views[name].has, self.cages))]
        found = {
            part: {name: test(views[name]) for name in computed}
            for part, test in self.parts.items()
        }
        decided = {
            part: {n: o for n, o in outcomes.items() if n not in partly or o != UNDECIDED}
            for part, outcomes in found.items()
        }
        whole = {name: every(outcomes[name] for outcomes in found.values()) for name in computed}
        other = [name for name in variations if name not in computed]
        without = [name for name in other if all(map(views[name].has, self.cages))]
        missing = [name for name in other if name not in without]
        known = {n: o for n, o in whole.items() if n not in partly or o != UNDECIDED}
        texts = _over_axes(known)
        texts += [f"in part computed: {', '.join(partly)}"] if partly else []
        texts += [f"has no such figure: {', '.join(without)}"] if without else []
        texts += [f"{UNDECIDED}, not computed: {', '.join(missing)}"] if missing else []
        if len(self.parts) > 1 and computed:
            texts += [f"({part}) {range_of(outcomes)}" for part, outcomes in decided.items()]
        lines = [
            shown(output, cage, views[BASE](output, cage))
            for output in self.figures
            for cage in self.cages
        ]
        return Verdict(
            key=self.key,
            claim=self.text,
            outcome=whole.get(BASE, UNDECIDED),
            figures=tuple(line for line in lines if isfinite(line.value)),
            range=". ".join(texts),
            reason="" if BASE in computed else "not computed",
            source=self.source,
        )

    def _shown_by(self, view: View) -> bool:
        """Whether the sound cage and another were computed, and have what the claim is about: a
        rigid cage has no stress. A part that needs a cage which is missing stays undecided."""
        first, *others = (isfinite(view(self.figures[0], cage).value) for cage in self.cages)
        return first and any(others)


def _over_axes(outcomes: Mapping[str, str]) -> list[str]:
    """The range of a claim along every axis, and in the variations that lie on none."""
    texts, on_axes = [], set()
    for name, (unit, points) in AXES.items():
        along = {value: outcomes[at] for value, at in points.items() if at in outcomes}
        on_axes.update(points.values())
        if along:
            texts.append(range_along(name, along, unit=unit))
    rest = {name: outcome for name, outcome in outcomes.items() if name not in on_axes}
    return [*texts, range_of(rest)] if rest else texts
