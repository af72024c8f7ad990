"""The machinery of repeated papers, and the first paper that is made by it."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.study import load_map, load_study
from flexcage.study.plan import make_plan
from flexcage.study.sensitivity import indices, share
from flexcage.study.unknowns import design_of
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED, read_verdicts

PAPERS = Path(__file__).parents[2] / "examples" / "papers"
CENTROID = PAPERS / "c7010_centroid"


@pytest.fixture(scope="module", autouse=True)
def as_scripts():
    """Modules of examples/papers import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    yield
    sys.path.remove(str(PAPERS))


@pytest.fixture(scope="module")
def paper(as_scripts):
    import repeat

    return repeat.load(CENTROID)


def page(**changes):
    from paper_page import Cell, Line, Page, Picture, Table

    cells = {"starts": Cell(HOLDS), "map": Cell(FAILS, "12 % (3 % to 30 %)")}
    plain = Page(
        title="A paper", summary="What it says. " * 20,
        lines=[Line("1", "a claim", "Figure 1", cells, "map", "a reason")],
        pictures=[Picture("a.png", "Figure 1", "what it shows")],
        tables=[Table("Table 1", ("a", "b"), [("1", "2")])], decides=["one thing"],
        readings=["one"], unknowns=Table("Open", ("unknown",), [("friction",)]), files=["x.csv"],
    )  # fmt: skip
    return replace(plain, **changes)


def test_a_page_has_its_parts_in_order_and_a_matrix(tmp_path):
    from paper_page import compose, draw_matrix

    text = compose(page())
    parts = ("# A paper", "What it says", "matrix.png", "| 1 | a claim (Figure 1) | ✓ | ✗ 12 %",
             "### Figure 1", "**Table 1**", "## What decides", "**Open**", "x.csv")  # fmt: skip
    places = [text.index(part) for part in parts]
    assert places == sorted(places)
    assert draw_matrix(page(), tmp_path / "matrix.png").stat().st_size > 3000


def test_pages_that_nobody_reads_are_refused():
    from paper_page import Table, compose

    with pytest.raises(ValueError, match="has 2.. lines, more than 250"):
        compose(page(tables=[Table("Long", ("a",), [("1",)] * 240)]))
    with pytest.raises(ValueError, match="more than 25 words"):
        compose(page(tables=[Table("Wide", ("a",), [("word " * 26,)])]))


def test_a_map_decides_beyond_its_interval_only():
    from paper_page import by_share, number

    assert by_share(share([True] * 30 + [False] * 5)).outcome == HOLDS
    assert by_share(share([False] * 30 + [True] * 5)).outcome == FAILS
    assert by_share(share([True, False] * 10)).outcome == UNDECIDED
    assert by_share(share([None] * 10)).outcome == UNDECIDED
    assert number(1.23456e-3, 2e-5, factor=1e3) == "1.235 ± 0.020"
    assert number(float("nan")) == "-"


class KnownMap:
    """A map whose output is known: ten times its first unknown; failed at its last point."""

    names = ["friction", "play", "(start)"]
    conditions = ["a"]

    def __init__(self, kind="sample", lifted=0.0):
        self.shares = design_of(kind, 64 if kind == "sample" else 6, 3, 5)
        self.about, self.lifted = {"design": kind}, lifted

    def means(self, output, condition):
        found = 10.0 * self.shares[:, 0] + self.lifted
        found[-1] = np.nan
        return found

    def indices(self, output, condition):
        return indices(self.about["design"], self.shares, self.names, self.means(output, condition))

    def judge(self, test):
        values = self.means("y", "a")
        return [None if np.isnan(v) else test(lambda *_, v=v: v) for v in values]


def of_starts(values, label="flexible"):
    """What a study has of one condition: outputs by name, each (starts,)."""

    def row(start):
        figures = {k: SimpleNamespace(value=v[start]) for k, v in values.items()}
        point = SimpleNamespace(labels={"reading": label, "condition": "a"})
        return SimpleNamespace(
            planned=SimpleNamespace(point=point), state="done", figures=figures, reason=""
        )

    starts = len(next(iter(values.values())))
    about = SimpleNamespace(outputs=tuple(values))
    return SimpleNamespace(rows=[row(k) for k in range(starts)], about=about)


def claim_of(output):
    """A claim that an output is positive under the condition "a"."""
    from flexcage.study.claims import Between, Claim

    return Claim(output, "is positive", "here", {"so": Between(output, ("a",), low=0.0)}, (output,))


def test_a_study_beside_a_reading_puts_out_more_of_it():
    """What neither puts out is NaN, and so is what the one beside has of too few starts."""
    from paper_results import Reading

    many, few = {"root": np.arange(8.0), "edge": np.ones(8)}, {"root": np.arange(5.0)}
    own = of_starts({"force": np.arange(10.0)})
    reading = Reading("flexible", own, Reading("flexible", of_starts(many)))
    at = reading.at_look(8)
    assert reading.look == 8
    np.testing.assert_array_equal(at("force", "a"), np.arange(8.0))
    np.testing.assert_array_equal(at("root", "a"), np.arange(8.0))
    assert np.isnan(at("tilt", "a")).all() and len(at("tilt", "a")) == 8
    less = Reading("flexible", own, Reading("flexible", of_starts(few))).at_look(8)
    assert np.isnan(less("root", "a")).all()


def test_claims_are_judged_by_the_starts_that_their_conditions_have():
    """Eight starts do not decide what sixteen do; more starts count where there are some."""
    from paper_results import Reading, cells_of_starts

    sound = np.array([2.0, 1.0, 3.0, 0.5, 2.5, 1.5, 0.2, 1.2])
    own = Reading("flexible", of_starts({"force": sound}))
    claim = claim_of("force")
    assert own.look_at(claim) == 8
    assert cells_of_starts([claim], own)["force"].outcome == UNDECIDED
    more = Reading("flexible", of_starts({"force": np.append(sound, sound + 0.01)}), beside=own)
    assert more.look_at(claim) == 16 and more.studies == [more.results, own.results]
    assert cells_of_starts([claim], more)["force"].outcome == HOLDS
    other = Reading("flexible", of_starts({"tilt": sound}), beside=more)
    assert other.look_at(claim) == 16 and other.look_at(claim_of("tilt")) == 8


def test_a_page_says_how_long_every_study_took():
    import repeat

    said = repeat._minutes({"readings": 90.0, "map": 3600.0})
    assert said == "62 minutes of processor time (readings 2, map 60)"


def test_a_paper_renews_its_own_rows_of_the_table_of_measured_numbers(tmp_path):
    from paper_index import Measured, write_index, write_measured

    for name, value in (("one", "1 mm"), ("other", "2 N")):
        (tmp_path / name).mkdir()
        write_measured([Measured(f"a, {name}", value, "3 ± 1", "2 (1 to 4)")], tmp_path / name)
    readme = tmp_path / "README.md"
    readme.write_text(
        "[p](other/README.md), [q](one/README.md)\n\n| measured | | better model | map |\n"
        "|---|---|---|---|\n| old | 0 | 0 | 0 |\n\nAfter it.\n"
    )
    for _ in range(2):  # a second time changes nothing
        write_index(readme)
        lines = readme.read_text().splitlines()
        assert lines[4:] == [
            "| a, other | 2 N | 3 ± 1 | 2 (1 to 4) |", "| a, one | 1 mm | 3 ± 1 | 2 (1 to 4) |",
            "", "After it.",
        ]  # fmt: skip


@pytest.mark.parametrize(("kind", "factor"), [("sample", 1.0), ("morris", 1e3)])
def test_unknowns_are_weighed_against_the_dummy(kind, factor, tmp_path):
    """What makes an output is named, with its share of variance or its effect in the number's
    unit; what too few runs have is left out."""
    pytest.importorskip("SALib")
    from paper_weighed import Asked, weigh, weighed_table, write_indices

    found = weigh(KnownMap(kind), [Asked("y [mm]", "y", "a", 1e3)])
    ((_, words, _, strong, dummy, runs),) = weighed_table({"m": found}).rows
    assert words == "y [mm]" and int(runs) == len(KnownMap(kind).shares) - 1
    name, value = strong.split()[:2]
    wanted = 1.0 if kind == "sample" else 10.0
    assert name == "friction" and "play" not in strong
    assert float(value.replace(",", "")) == pytest.approx(factor * wanted, rel=0.1)
    assert abs(float(dummy.split()[0].replace(",", ""))) < 0.5 * factor * wanted
    assert write_indices({"m": found}, tmp_path / "i.csv").read_text().count("friction") == 1
    few = KnownMap()
    few.means = lambda *_: np.full(64, np.nan)
    assert weigh(few, [Asked("y", "y", "a")]) == []


def test_a_flexible_cage_is_compared_point_by_point(tmp_path):
    """Of 63 points that are done, those between the limits of both maps change their outcome."""
    from types import SimpleNamespace

    from paper_results import Joined
    from paper_weighed import rechecked

    from flexcage.study.claims import Below, Between, Claim

    rigid, flexible = KnownMap(), KnownMap(lifted=1.0)
    claims = [
        Claim("x-1", "y is below 5", "-", {"y": Between("y", ("a",), high=5.0)}, ("y",)),
        Claim("x-2", "not computed", "-", {"y": Below("y", "y", "b")}, ("y",)),
    ]
    paper = SimpleNamespace(claims=claims)
    computed = SimpleNamespace(
        paper=paper, maps={"m": Joined([rigid])}, rechecks={"m.toml": flexible}
    )
    first = rigid.means("y", "a")
    changed = int(((first < 5.0) & (first + 1.0 >= 5.0)).sum())
    (said,) = rechecked(computed, "y")
    assert 3 < changed < 10
    assert f"63 points of m.toml with an elastic cage: {63 - changed} of 63" in said
    assert said.endswith(f"others: x-1 at {changed}.")
    assert rechecked(computed, "y", left_out=("x-1",)) == []


def test_readings_and_maps_of_the_measured_cage_are_plans(paper):
    study = load_study(CENTROID / paper.readings)
    assert study.repeat.count >= 8 and len(make_plan(study).cases) == 2 * 4 * study.repeat.count
    for files in paper.maps.values():
        for file in files:
            spec = load_map(CENTROID / file)
            assert len(make_plan(spec.study((0, 1))).cases) == 2 * 4
            assert all(len(unknown.reason) > 8 for unknown in spec.unknowns)
    assert {c.key for c in paper.claims} == set(paper.decided_by)


def test_claims_of_the_measured_cage_judge_numbers_of_known_order(paper):
    """The paper's own numbers hold its claims; a cage that whirls steadily does not."""
    claims = {c.key: c for c in paper.claims}
    speeds = ("4000", "7000", "10000", "11000")
    good = {
        "error": (0.054, 0.04, 0.029, 0.035), "ratio": (1.4, 0.9, 0.45, 0.6),
        "mean_radius": (0.15, 0.2, 0.25, 0.24), "axial_raw": (0.7,) * 4,
        "axial_solved": (0.2,) * 4, "beyond_theory": (-0.0025, 0.0, -0.0079, 0.005),
        "solved": (0.2311e-3, 0.2e-3, 0.2314e-3, 0.2e-3),
        "difference": (0.2549e-3, 0.2e-3, 0.1886e-3, 0.2e-3),
    }  # fmt: skip

    def at(output, condition):
        return good[output.removesuffix("_run_out")][speeds.index(condition)]

    assert [key for key, claim in claims.items() if not claim.holds(at)] == []
    good |= {"ratio": (0.1, 0.2, 0.6, 0.5), "beyond_theory": (0.0, 0.0, 0.02, 0.02)}
    good |= {"solved": (1e-5,) * 4}
    fails = [key for key, claim in claims.items() if not claim.holds(at)]
    assert fails == ["003-2", "003-3", "003-5", "003-6", "003-8"]


def test_lines_in_a_spectrum_are_seen_and_short_records_refused(paper):
    outputs = sys.modules["outputs"]
    t = np.arange(4000) / 10e3
    noise = np.random.default_rng(1).standard_normal(4000)
    sine = np.sin(2 * np.pi * 71.5 * t)
    assert outputs.line_share(sine + 0.1 * noise, 71.5, 10e3) > 0.9
    assert outputs.line_share(noise, 71.5, 10e3) < 0.05
    assert np.isnan(outputs.line_share(sine[:400], 71.5, 10e3))
    assert np.isnan(outputs.line_share(np.r_[sine, np.nan], 71.5, 10e3))


def test_predictions_are_the_rows_that_are_asked_for():
    """Every row of the paper's two tables that is not shown, with an interval around its value."""
    rows = json.loads((CENTROID / "predictions.json").read_text("utf-8"))
    asked = (("4", "measured"), ("4", "solved"), ("5", "origin"), ("5", "centroid"))
    wanted = {(t, n, q) for n in ("7000", "11000") for t, q in asked}
    assert {(r["table"], r["row"], r["quantity"]) for r in rows} == wanted
    for r in rows:
        assert r["paper"] == "003" and r["unit"] == "mm"
        assert 0.0 < r["low"] < r["value"] < r["high"]


def test_a_likelihood_follows_the_rows_that_are_shown():
    """Points of a map with the shown trend carry it ahead; a narrow trend gives a narrow row."""
    sys.path.insert(0, str(CENTROID))
    import predict

    sys.path.remove(str(CENTROID))
    rng = np.random.default_rng(2)
    shown = np.array([0.2, 0.1])
    at_shown = np.array([[0.2, 0.1], [0.01, 0.9]])
    ahead = np.array([[0.14, 0.09], [0.5, 0.5]])
    found = predict.drawn(shown, at_shown, ahead, rng)
    np.testing.assert_allclose(np.median(found, axis=0), [0.14, 0.09], rtol=0.1)
    low, high = np.percentile(found[:, 1], (5, 95))
    assert 1.0 < high / low < 3.0


def test_the_measured_cage_from_end_to_end(tmp_path, capsys):
    import c7010_centroid

    found = c7010_centroid.main(["--quick", "-o", str(tmp_path / "quick")])
    stored = read_verdicts(tmp_path / "quick" / "readings")
    assert [v.key for v in stored] == [line.key for line in found.lines]
    assert all(line.verdict.outcome == UNDECIDED for line in found.lines)  # no map, one start
    reading = next(iter(found.readings.values()))
    assert reading.starts == 1 and reading.look == 0
    assert reading.values("speed", "10000") == pytest.approx(458.0, rel=0.05)
    assert "003-5" in capsys.readouterr().out


def test_a_reading_that_lacks_conditions_judges_the_claims_that_it_can():
    from paper_results import cells_of_starts

    from flexcage.study.claims import Between, Claim

    class Half:
        look, conditions = 8, {"slow"}

        def look_at(self, claim):
            return 8

        def at_look(self, starts):
            known = {"slow": np.linspace(0.9, 1.1, starts)}
            return lambda output, condition: known.get(condition, np.full(starts, np.nan))

    slow, fast = (
        Claim(k, k, "", {"p": Between("x", (k,), low=0.5)}, ("x",)) for k in ("slow", "fast")
    )
    cells = cells_of_starts([slow, fast], Half())
    assert cells["slow"].outcome == HOLDS and cells["fast"].note == "not computed"
