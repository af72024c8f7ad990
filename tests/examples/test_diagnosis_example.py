"""The example that tells faults from signals: its judging on features made up, and all of it."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from test_examples import example

pytest.importorskip("sklearn")
pytest.importorskip("bearing_datasets")

FAULTS = ("normal", "outer", "inner")


@pytest.fixture(scope="module")
def module():
    return example("ex11_diagnosis")


def made_up(value):
    """Eight bearings with each fault four times; ``value`` (bearing, fault, rng) is the feature."""
    rng = np.random.default_rng(3)
    rows = [
        {"casing: a": value(b, k, rng), "cage_laser: b": rng.normal(), "bearing": b,
         "fault": fault, "label": fault}
        for b in range(8) for k, fault in enumerate(FAULTS) for _ in range(4)
    ]  # fmt: skip
    return pd.DataFrame(rows)


def right(module, table, **options):
    return float((module.judged(table, ("casing",), **options) == table["fault"]).mean())


def test_faults_are_told_by_a_feature_that_bearings_share_and_by_no_other(module):
    """One that is each bearing's own is learnt by heart, and of no use for the others."""
    shared = made_up(lambda b, k, rng: k + 0.1 * rng.normal())
    assert right(module, shared) > 0.95
    secret = np.random.default_rng(4).permutation(24).reshape(8, 3)
    assert right(module, made_up(lambda b, k, rng: secret[b, k])) < 0.6
    chance = np.mean([right(module, shared, shuffle=k) for k in range(8)])
    assert chance == pytest.approx(1 / 3, abs=0.12)


def test_intervals(module):
    """8 of 10: as R. G. Newcombe's tables of Wilson's method have it."""
    assert module.wilson(8, 10) == pytest.approx((0.4902, 0.9433), abs=1e-4)
    assert module.wilson(0, 20)[0] == 0.0 and module.wilson(20, 20)[1] == pytest.approx(1.0)
    bearing = pd.Series(np.repeat(range(10), 20))
    alike = pd.Series(np.tile([True] * 15 + [False] * 5, 10))
    assert module.by_bearing(alike, bearing) == (0.75, 0.75)
    half = pd.Series(np.repeat([True, False], 100))  # five bearings wholly right, five wholly wrong
    low, high = module.by_bearing(half, bearing)
    assert low == pytest.approx(0.2, abs=0.01) and high == pytest.approx(0.8, abs=0.01)


def test_the_recipe_is_a_study_of_200_recordings():
    from test_examples import EXAMPLES

    from flexcage.study.dataset.labels import fault_of
    from flexcage.study.plan import make_plan
    from flexcage.study.spec import load_study

    plan = make_plan(load_study(EXAMPLES / "diagnosis_study.toml"))
    cases = [plan.case(planned) for planned in plan.cases]
    count = {}
    for case in cases:
        kinds = fault_of(case).name
        count[kinds] = count.get(kinds, 0) + 1
    assert count == {"normal": 20, "outer": 40, "inner": 40, "rolling_element": 40, "cage": 40,
                     "outer+rolling_element": 20}  # fmt: skip
    assert {case.seed for case in cases} == set(range(1, 11))
    assert {case.load.radial for case in cases} == {700.0, 1300.0}


@pytest.mark.slow
def test_faults_are_told_of_bearings_that_were_not_learnt_from(module, tmp_path, capsys):
    """Of four bearings with three classes each, from signals of 64 ms."""
    picture = tmp_path / "diagnosis.png"
    shares = module.main(tmp_path / "small", str(picture), quick=True)
    assert shares["casing alone"] > 0.8 > shares["shuffled labels"]
    assert "outer race, 0.8 mm" in capsys.readouterr().out
    assert picture.stat().st_size > 20_000
