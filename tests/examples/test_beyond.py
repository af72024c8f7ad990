"""Beyond the N1013's paper: the studies plan, and the page's figures are what rows say."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.study.outputs import Figure
from flexcage.study.plan import make_plan

PAPERS = Path(__file__).parents[2] / "examples" / "papers"


@pytest.fixture(scope="module")
def beyond():
    sys.path.insert(0, str(PAPERS))
    import n1013_beyond
    import n1013_beyond_page

    yield SimpleNamespace(script=n1013_beyond, page=n1013_beyond_page)
    sys.path.remove(str(PAPERS))


def results(points):
    """A study's rows with these figures by labels, from two starts each."""
    rows = [
        SimpleNamespace(
            planned=SimpleNamespace(point=SimpleNamespace(labels=dict(enumerate(labels)))),
            figures={k: Figure(v, "", "", 0.01 * abs(v)) for k, v in figures.items()},
            state="done",
        )
        for labels, figures in points.items()
        for _ in range(2)
    ]
    return SimpleNamespace(
        rows=rows,
        study=SimpleNamespace(name="n1013-test"),
        count=lambda state: sum(row.state == state for row in rows),
    )


def test_every_cage_at_every_speed_and_load_is_a_plan(beyond):
    plan = make_plan(beyond.script.load("peaks"))
    labels = {tuple(c.point.labels.values()) for c in plan.cases}
    page = beyond.page
    assert len(plan.cases) == 2 * len(labels) == 2 * 4 * 3 * 4
    kinds = {f"{m}, {k}" for m in page.MATERIALS for k in ("rigid", "flexible")}
    assert labels == {(s, p, k) for s in page.SPEEDS for p in page.LOADS for k in kinds}
    assert len(make_plan(beyond.script.load("peaks", quick=True)).cases) == 4


def test_every_cage_of_the_page_is_in_the_study(beyond):
    page, plan = beyond.page, make_plan(beyond.script.load("cages"))
    labels = {c.point.labels["cage"] for c in plan.cases}
    asked = {*page.GROWTH["dq"], *page.GROWTH["dp"], *page.SEVERAL, *page.TOGETHER, *page.CURVES}
    assert asked == labels
    outputs = {*page._GROWING, *page._BESIDE, *page._SHAKEN, *page.PARTS}
    assert outputs <= set(plan.study.outputs) and outputs - set(page.PARTS) <= set(page.NAMES)


def test_excess_is_of_the_rigid_cage(beyond):
    page = beyond.page
    peaks = results({
        ("6000", "1000", "brass, rigid"): {page.PEAK: 14.4},
        ("6000", "1000", "brass, flexible"): {page.PEAK: 10.0},
    })  # fmt: skip
    found = page.excess(peaks, page.PEAK, "6000", "1000", "brass")
    assert found.value == pytest.approx(0.44, rel=1e-12)
    assert found.margin == pytest.approx(1.44 * 0.01, rel=1e-6)  # two of 1 %, each of two starts
    assert np.isnan(page.excess(peaks, page.PEAK, "3000", "1000", "brass").value)


def test_share_of_the_middle_half(beyond):
    page = beyond.page
    ends = {s: float(k in (0, 15)) for k, s in enumerate(page.PARTS)}
    even = dict.fromkeys(page.PARTS, 2.0)
    cages = results({("dq 0.1",): ends, ("dq 0.2",): even})
    assert page.middle_share(cages, "dq 0.1") == 0.0
    assert page.middle_share(cages, "dq 0.2") == pytest.approx(0.5)


def test_page_of_half_a_study_is_written(beyond, tmp_path):
    """Every field of the page has its text, whatever is computed."""
    page = beyond.page
    at = {page.PEAK: 10.0, page.BLOW: 30.0, "energy_of_drive": 1e-4, "pocket_force_sum": 20.0}
    peaks = results(
        {
            ("6000", "1000", "PA66, rigid"): {**at, page.PEAK: 15.0},
            ("6000", "1000", "PA66, flexible"): at,
        }
    )
    cages = results(
        {("sound",): {page.CORNER: 2e7, "stress_root": 3e7, **dict.fromkeys(page.PARTS, 1.0)}}
    )
    text = page.page(peaks, cages)
    assert "{" not in text and "PA66: 50 to 50 %, median 50 %" in text
    assert "4 of 4 cases of `n1013-test`" in text
    assert all(path.stat().st_size > 2000 for path in page.draw(peaks, cages, tmp_path))
