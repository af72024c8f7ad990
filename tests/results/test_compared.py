"""Two runs compared: ten figures first, ratios, and what intervals can tell."""

from __future__ import annotations

import json
import re
from math import pi

import pytest

from flexcage.core.errors import InputError
from flexcage.core.warning import RunWarning
from flexcage.results.compared import FIRST, TEN, ComparedPair, Comparison
from flexcage.results.figures.table import FIGURES
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Summary

RPM = pi / 30.0
NOTE = "of the settled part; with much more to say of it than a column holds"


def summary_of(scale: float, *, margin: float | None = 1.0, **values: object) -> Summary:
    """Figures of a run: forces of ``scale`` times 10 N, each known to ``margin``."""
    forces = ("pocket_force_mean", "pocket_force_pass_peak", "pocket_force_peak",
              "race_force_inner", "race_force_outer")  # fmt: skip
    rows = [
        SummaryRow("cage_speed", "Cage speed", 280.0 * RPM, "rpm", NOTE, 0.5 * RPM),
        *(SummaryRow(k, FIGURES[k].title, 10.0 * scale, "N", margin=margin) for k in forces),
        *(FIGURES[k].row(v) for k, v in values.items()),
    ]
    found = Summary(warnings=(RunWarning("short", f"It is short by {scale:g}."),))
    for row in rows:
        section = FIGURES[row.key].section
        kept = [r for s in found.sections if s.title == section for r in s.rows]
        found = found.with_section(section, [*kept, row])
    return found


def compared(**values: object) -> Comparison:
    return Comparison({"rigid": summary_of(8.0), "flexible": summary_of(5.0, **values)})


@pytest.mark.parametrize(
    ("first", "second", "beyond", "ratio"),
    [
        ((8.0, 1.0), (5.0, 1.0), "yes", 0.625),
        ((8.0, 3.0), (5.0, 1.0), "no", 0.625),  # 3 is less than the root of 10
        ((8.0, 2.0), (5.0, 2.0), "yes", 0.625),  # the intervals overlap; their difference is clear
        ((8.0, None), (5.0, 1.0), "no interval", 0.625),
        ((8.0, None), (8.0, None), "no interval", 1.0),
        ((0.0, 1.0), (5.0, 1.0), "yes", None),
        ((1e-9, 1.0), (5.0, 1.0), "yes", None),  # what rounding leaves of nothing
        ((-1.0, 1.0), (5.0, 1.0), "yes", None),
    ],
)
def test_a_difference_is_held_against_its_interval(first, second, beyond, ratio):
    rows = [SummaryRow("pocket_force_mean", "Force", v, "N", margin=m) for v, m in (first, second)]
    pair = ComparedPair("pocket_force_mean", *rows)
    assert pair.beyond == beyond
    assert pair.ratio_text == (f"{ratio:.3f}" if ratio else "-")


def test_texts_and_figures_of_one_run_alone_have_no_verdict():
    found = compared(stress_peak=20e6, energy_audit="passed")
    assert (found["stress_peak"].texts, found["stress_peak"].beyond) == (("-", "20.000"), "")
    assert found["energy_audit"].beyond == "" and found["energy_audit"].ratio_text == "-"
    with pytest.raises(InputError, match="Neither run has the figure 'steps'"):
        found["steps"]


@pytest.mark.parametrize("width", [80, 120])
@pytest.mark.parametrize("every", [False, True])
def test_lines_are_no_longer_than_the_terminal(width, every):
    names = ("runs/a_long_name_of_a_run/cases/4f1c8a", "runs/another/cases/b77d01")
    long = {"inner_held": "free across the axis; held along it and in tilt " * 3}
    summaries = dict(zip(names, (summary_of(8.0, **long), summary_of(5.0, margin=None))))
    text = Comparison(summaries, {"cage.model": ("rigid", "flexible")}).text(
        every=every, width=width
    )
    assert max(map(len, text.splitlines())) <= width
    assert "cage.model (rigid, flexible)" in " ".join(text.split())


def test_the_table_leads_with_at_most_ten_figures_that_both_have():
    every = {k: 1.0 for k in FIRST if k not in {r.key for r in summary_of(1.0)}}
    found = Comparison({n: summary_of(s, **every) for n, s in (("a", 1.0), ("b", 2.0))})
    assert [pair.key for pair in found.leading] == list(FIRST[:TEN])
    rigid = {k: v for k, v in every.items() if not k.startswith("stress")}
    found = Comparison({"rigid": summary_of(1.0, **rigid), "flexible": summary_of(2.0, **every)})
    assert [p.key for p in found.leading] == [k for k in FIRST if "stress" not in k][:TEN]
    lines = found.text(width=80).splitlines()
    end = lines.index("")
    assert re.search(r"Pocket force, mean \[N\] +10.0 ± 1.0 +20.0 ± 1.0 +2.000 +yes", lines[5])
    assert len([line for line in lines[:end] if re.search("  (yes|no|no interval)$", line)]) == TEN
    assert "Stress" not in found.text() and "Stress" in found.text(every=True)


def test_notes_and_warnings_stand_below_with_the_run_that_they_are_of():
    text = " ".join(compared().text(width=80).split())
    assert "Warnings - rigid: It is short by 8. - flexible: It is short by 5." in text
    assert "ratio: flexible over rigid" in text
    assert "Cage speed: of the settled part" in text, "once, as both runs have it"
    assert "more to say" not in text, "the table of ten has brief notes"


def test_all_of_it_comes_as_json():
    stored = json.loads(compared(stress_peak=20e6).to_json())
    force = stored["figures"]["pocket_force_peak"]
    assert force["values"] == [80.0, 50.0] and force["margins"] == [1.0, 1.0]
    assert (force["ratio"], force["beyond"], force["leading"]) == (0.625, "yes", True)
    assert stored["runs"]["flexible"]["Equivalent stress"]["stress_peak"]["value"] == 20e6
    assert "stress_peak" not in stored["figures"], "only one run has it"


def test_two_runs_are_compared_and_no_more():
    with pytest.raises(InputError, match="Two runs can be compared, not 1"):
        Comparison({"a": summary_of(1.0)})


def test_what_a_comparison_leads_with_are_known_figures():
    assert not set(FIRST) - set(FIGURES)
