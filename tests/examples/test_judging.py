"""Judging published claims: rules that can win, and that do not win by chance or by looking."""

from __future__ import annotations

import sys
from collections import Counter
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from flexcage import InputError
from flexcage.study import Unknown
from flexcage.study.unknowns import design_of

PAPERS = Path(__file__).parents[2] / "examples" / "papers"
THREE = ("a", "b", "c")
POINTS = 128


@pytest.fixture(scope="module", autouse=True)
def as_scripts():
    """Modules of examples/papers import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    yield
    sys.path.remove(str(PAPERS))


def kinds():
    """Every kind of finding, with the scatter of starts beside a change of a quarter."""
    from judging.findings import Below, Differs, Same, Together, Trend, Turn, Within

    return [
        (Trend("x", THREE), 0.1),
        (Trend("x", THREE[:2], rising=False, by=0.1), 0.06),
        (Turn("x", THREE), 0.1),
        (Turn("x", ("a", "b", "c", "d", "e"), highest=False, at=(1.0, 2.0, 3.0, 5.0, 8.0)), 0.1),
        (Same("x", THREE, within=0.1), 0.02),
        (Same("x", THREE[:2], within=0.01, absolute=True), 0.02),
        (Differs("x", THREE[:2], by=0.1), 0.05),
        (Within("x", ("a",), 1.0, 3.0), 0.1),
        (Below("x", "y", THREE[:2]), 0.1),
        (Together("x", "y", THREE), 0.08),
    ]


@pytest.mark.parametrize("number", range(10))
def test_a_finding_that_is_true_is_found_to_be_reproduced(number):
    from judging.judge import REPRODUCED
    from judging.power import verdicts

    finding, scatter = kinds()[number]
    found = verdicts(finding, 0.25, points=POINTS, starts=1, scatter=scatter, trials=6)
    assert found[REPRODUCED] >= 5, found


def opposite(seed, *, scatter=0.05):
    """Two samples of one output under two conditions: one rises by a third, the other falls."""
    from judging.findings import Trend
    from judging.power import made

    rising, falling = (Trend("x", THREE[:2], rising=up) for up in (True, False))
    one, other = (
        made(f.example(0.33), points=POINTS, starts=1, scatter=scatter, seed=seed + k)
        for k, f in enumerate((rising, falling))
    )
    return rising, one, other


def test_a_region_that_decides_is_found_and_named():
    from judging.judge import UNDER, judge
    from judging.power import in_region

    found = Counter()
    for seed in range(0, 20, 2):
        finding, true, false = opposite(seed)
        judged = judge(finding, in_region(true, false, 0.4))
        found[judged.verdict] += 1
        assert set(judged.region.limits) == {"u0"} and judged.region.share > 0.95
        assert 0.25 <= judged.region.size <= 0.45  # of eighths, 3/8 is the nearest below 0.4
    assert found == {UNDER: 10}


def test_what_is_false_is_contradicted_only_with_a_mechanism():
    from judging.judge import CONTRADICTED, UNTESTABLE, judge

    finding, _, false = opposite(3)
    assert judge(finding, false, "the roller is held").verdict == CONTRADICTED
    plain = judge(finding, false)
    assert plain.verdict == UNTESTABLE and "nothing in the runs says why" in plain.reason


def test_chance_wins_nothing():
    """Of samples without any effect no trend, turn or region is found, although thousands of
    regions are looked at."""
    from judging.findings import Trend, Turn
    from judging.judge import UNTESTABLE, judge
    from judging.power import made

    nothing = {("x", c): 1.0 for c in THREE}
    found = Counter()
    for seed in range(6):
        sample = made(nothing, points=POINTS, starts=1, scatter=0.1, seed=seed)
        for finding in (Trend("x", THREE), Turn("x", THREE), Trend("x", THREE[:2])):
            found[judge(finding, sample, "named").verdict] += 1
    assert found == {UNTESTABLE: 18}


def test_shares_by_chance_are_those_of_permuted_labels():
    """Of three values in all six orders one half rises by tau and ends, one third turns."""
    from judging.findings import Below, Same, Trend, Turn

    values = {("x", "a"): 1.0, ("x", "b"): 2.0, ("x", "c"): 4.0, ("y", "a"): 3.0}
    at = lambda output, condition: values[output, condition]  # noqa: E731
    assert Trend("x", THREE).by_chance(at, THREE) == pytest.approx(1 / 2)
    assert Trend("x", THREE, by=2.0).by_chance(at, THREE) == pytest.approx(1 / 6)
    assert Turn("x", THREE).by_chance(at, THREE) == pytest.approx(1 / 3)
    assert Same("x", THREE[:2], within=0.7).by_chance(at, THREE) == pytest.approx(4 / 6)
    assert Below("x", "y", ("a",)).by_chance(at, THREE) == pytest.approx(1 / 2)


def test_the_probability_of_so_many_by_chance_is_binomial_where_chances_are_equal():
    from judging.judge import at_least
    from scipy.stats import binom

    assert at_least([0.3] * 20, 9) == pytest.approx(binom.sf(8, 20, 0.3))
    assert np.isnan(at_least([np.nan] * 3, 1))


def test_a_point_without_a_number_is_not_judged():
    from judging.judge import UNTESTABLE, judge

    finding, true, _ = opposite(1)
    values = {key: found.copy() for key, found in true.values.items()}
    values["x", "a"][: POINTS // 2] = np.nan
    judged = judge(finding, type(true)(true.names, true.shares, values, true.conditions))
    assert judged.verdict == UNTESTABLE and judged.reason == "64 of 128 points have it"
    assert judged.outcomes[:64] == [None] * 64


def test_regions_in_words():
    from judging.judge import Region
    from judging.sample import cuts_of, in_words

    clearance = Unknown(
        name="Cq - Dw", reason="why", paths={"cage.pocket_width": 1.0}, range=("0.1 mm", "0.2 mm")
    )
    law = Unknown(
        name="law", reason="why",
        choices=({"label": "dry", "weight": 2, "a.b": 1}, {"label": "oil", "a.b": 2}),
    )  # fmt: skip
    assert cuts_of([clearance, law]) == {"law": (pytest.approx(2 / 3),)}

    def said(**limits):
        return in_words(Region(limits, 20, 18, 100, 0.0), [clearance, law])

    assert said(**{"Cq - Dw": (0.0, 0.5), "law": (2 / 3, 1.0)}) == (
        "Cq - Dw below 0.15 mm and law oil"
    )
    assert said(**{"Cq - Dw": (0.25, 0.75)}) == "Cq - Dw 0.12 mm to 0.17 mm"


def test_designs_that_alias_are_seen():
    """The old 32 points of 13 unknowns had two whose middles coincide; 128 points have none."""
    from judging.sample import aliases

    names = [f"u{k}" for k in range(13)]
    assert aliases(design_of("sample", 32, 13, 5), names)
    assert aliases(design_of("sample", 128, 13, 5), names) == []
    twice = np.repeat(np.random.default_rng(0).random((400, 1)), 2, axis=1)
    assert aliases(twice, ["a", "b"]) == ["a and b: no point in 12 of 16 cells"]


def test_labels_must_differ():
    from judging.findings import Trend, Turn

    with pytest.raises(InputError, match="labels that differ"):
        Trend("x", ("a", "a"))
    with pytest.raises(InputError, match="should be 3 or more labels"):
        Turn("x", ("a", "b"))


def page(**changes):
    from judging.judge import REPRODUCED, Judged
    from judging.page import Figure, Found, Page, Table

    judged = Judged(REPRODUCED, [True] * 9 + [False], 0.55, 1.0, 0.5, 1e-5)
    found = [Found("1", "it rises", "rises", "Figure 1", judged)]
    plain = {
        "title": "A paper", "source": "Journal", "summary": "What it says. " * 20,
        "hero": ("hero.png", "what it shows"), "known": Table("Known", ("a", "b"), [("1", "2")]),
        "figures": [Figure("Figure 1", "it rises", "a.png", ("1",), "because it must")],
        "found": found, "asks": ["why?"], "cost": "1 minute.",
    }  # fmt: skip
    return Page(**{**plain, **changes})


def test_a_page_goes_figure_by_figure_and_its_appendix_has_the_statistics():
    from judging.page import compose, compose_appendix

    text = compose(page(history=["a limit"]))
    parts = ("# A paper", "What it says", "(hero.png)", "| 1 | 2 |", "### Figure 1",
             "*The paper:* it rises", "(a.png)", "**✓ Reproduced:** rises. because it must",
             "| 1 | it rises (Figure 1) | ✓ rises |", "- why?",
             "1 minute")  # fmt: skip
    places = [text.index(part) for part in parts]
    assert all(a < b for a, b in pairwise(places))
    assert "90%" not in text
    appendix = compose_appendix(page(history=["a limit"]))
    assert "90% (55% to 100%) of 10 | 50% |" in appendix and "- a limit" in appendix


def test_pages_that_nobody_reads_are_refused():
    from judging.page import Table, compose

    with pytest.raises(ValueError, match="has 1.. lines, more than 150"):
        compose(page(asks=["one line of asking"] * 140))
    with pytest.raises(ValueError, match="too full: 0.82"):
        compose(page(known=Table("Known", ("a",), [("0.82 (0.59 to 1.6)",)])))


def test_names_are_no_numbers_and_claims_may_have_as_many_as_they_need():
    from judging.page import NUMBER, Table, table

    assert NUMBER.findall("roller j-1 at -0.3 mm (0.59 to 1.6)") == ["-0.3", "(0.59", "1.6"]
    many = Table("", ("claim", "value"), [("at 0.1, 0.2 and 0.3 mm", "1 of 2")])
    assert "0.3 mm" in table(many, free=("claim",))
    with pytest.raises(ValueError, match="too full"):
        table(many)
