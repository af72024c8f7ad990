"""Verdicts on figures whose order is known, and on constructed records with a known answer."""

import json
from math import isnan, nan

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.study.verdicts import (
    FAILS,
    HOLDS,
    UNDECIDED,
    Estimate,
    EvidenceLine,
    Verdict,
    above,
    every,
    less,
    monotone,
    opposite,
    pooled,
    range_along,
    range_of,
    read_verdicts,
    unchanged,
    write_verdicts,
)


def E(value, margin=0.1):
    return Estimate(value, margin)


@pytest.mark.parametrize(
    "one, other, by, outcome",
    [
        (E(1.0), E(2.0), 0.0, HOLDS),
        (E(1.0), E(1.15), 0.0, UNDECIDED),  # the intervals overlap
        (E(2.0), E(1.0), 0.0, FAILS),
        (E(1.0), E(1.5), 0.25, HOLDS),
        (E(1.0), E(1.3), 0.25, UNDECIDED),  # less, but perhaps not by a quarter
        (E(1.0, 0.01), E(1.1, 0.01), 0.25, FAILS),  # less, and surely not by a quarter
        (E(1.0), E(2.0, nan), 0.0, UNDECIDED),
        (E(nan), E(2.0), 0.0, UNDECIDED),
    ],
)
def test_less(one, other, by, outcome):
    assert less(one, other, by=by) == outcome


@pytest.mark.parametrize(
    "other, outcome",
    [
        (E(1.02, 0.01), HOLDS),
        (E(1.09, 0.05), UNDECIDED),
        (E(1.3, 0.05), FAILS),
        (E(0.7, 0.05), FAILS),
        (E(1.0, 0.5), UNDECIDED),  # the same, but nobody knows how nearly
        (E(1.0, nan), UNDECIDED),
    ],
)
def test_unchanged(other, outcome):
    assert unchanged(E(1.0, 0.01), other, within=0.1) == outcome


def test_above_a_limit():
    assert above(E(3.2), 3.0) == HOLDS and above(E(2.8), 3.0) == FAILS
    assert above(E(3.05), 3.0) == above(E(9.0, nan), 3.0) == UNDECIDED


def test_monotone_over_an_axis():
    rising = [E(1.0), E(2.0), E(3.0)]
    assert monotone(rising) == HOLDS and monotone(rising, rising=False) == FAILS
    assert monotone(rising[::-1], rising=False) == HOLDS
    assert monotone([E(1.0), E(2.0), E(2.1)]) == UNDECIDED
    assert monotone([E(1.0), E(3.0), E(2.0)]) == FAILS  # one step the wrong way is enough


def test_outcomes_together():
    assert every([HOLDS, HOLDS]) == HOLDS
    assert every([HOLDS, UNDECIDED]) == UNDECIDED and every([]) == UNDECIDED
    assert every([UNDECIDED, FAILS, HOLDS]) == FAILS
    assert [opposite(o) for o in (HOLDS, FAILS, UNDECIDED)] == [FAILS, HOLDS, UNDECIDED]
    text = range_of({"0.15": HOLDS, "0.20": HOLDS, "0.25": FAILS})
    assert text == "holds: 0.15, 0.20; does not hold: 0.25"
    along = {0.3: UNDECIDED, 0.2: HOLDS, 0.15: HOLDS, 0.25: FAILS}
    expected = "gap: holds at 0.15 and 0.2 mm, does not hold at 0.25 mm, undecided at 0.3 mm"
    assert range_along("gap", along, unit="mm") == expected
    assert range_along("Z", {21.0: FAILS}) == "Z: does not hold at 21"
    assert range_along("n", {1.0: HOLDS, 2.0: HOLDS, 3.0: HOLDS}) == "n: holds at 1 to 3"


def test_quotients_and_differences_carry_margins():
    ratio = Estimate(10.0, 0.3) / Estimate(2.0, 0.08)
    assert (ratio.value, ratio.margin) == (5.0, pytest.approx(5 * np.hypot(0.03, 0.04)))
    change = Estimate(10.0, 0.3) - Estimate(2.0, 0.4)
    assert (change.value, change.margin) == (8.0, pytest.approx(0.5))
    assert isnan((Estimate(1.0) / Estimate(2.0, 0.1)).margin)


def test_pooled_takes_the_wider_interval():
    assert pooled([1.0], [0.2]) == Estimate(1.0, 0.2)
    two = pooled([1.0, 1.2], [0.3, 0.4])
    assert (two.value, two.margin) == (pytest.approx(1.1), pytest.approx(0.25))
    # Student's t of three repetitions is 4.303, and their deviation 1: 4.303/sqrt(3)
    apart = pooled([1.0, 2.0, 3.0], [0.1, 0.1, 0.1])
    assert apart.margin == pytest.approx(2.4841, abs=1e-3)
    alike = pooled([2.0, 2.0, 2.0], [0.3, 0.3, 0.3])
    assert alike.margin == pytest.approx(0.3 / np.sqrt(3))
    assert pooled([1.0, 2.0, 3.0], [None, None, None]).margin == pytest.approx(2.4841, abs=1e-3)
    assert isnan(pooled([1.0], [None]).margin) and isnan(pooled([], []).value)


def test_pooled_intervals_hold_the_mean_as_often_as_they_say():
    """Three runs of a hundred independent windows each, 500 times."""
    rng = np.random.default_rng(3)
    inside = 0
    for _ in range(500):
        runs = rng.normal(5.0, 1.0, (3, 100))
        own = 1.96 * runs.std(axis=1, ddof=1) / 10.0
        found = pooled(runs.mean(axis=1), own)
        inside += found.low <= 5.0 <= found.high
    assert 0.93 < inside / 500 <= 1.0


def test_verdicts_on_disk(tmp_path):
    verdicts = [
        Verdict(key="1", claim="more < less", outcome=HOLDS,
                figures=(EvidenceLine("a", 1.5, 0.1, "N"),)),
        Verdict(key="2", claim="open", outcome=UNDECIDED,
                figures=(EvidenceLine("b", nan, nan, "MPa"),), range="none",
                reason="not computed", source="paper"),
    ]  # fmt: skip
    path = write_verdicts(tmp_path, verdicts)
    stored = json.loads(path.read_text())
    assert stored["format"] == 1 and stored["verdicts"][1]["figures"][0]["value"] is None
    assert set(stored["verdicts"][0]) == {
        "key", "claim", "outcome", "figures", "range", "reason", "source"
    }  # fmt: skip
    back = read_verdicts(tmp_path)
    assert back[0] == verdicts[0] and isnan(back[1].figures[0].value)
    assert read_verdicts(tmp_path / "nothing") == []


def test_mistakes_in_verdicts(tmp_path):
    with pytest.raises(InputError, match="outcome of verdict '7' is 'maybe'"):
        Verdict(key="7", claim="", outcome="maybe")
    (tmp_path / "verdicts.json").write_text('{"format": 2}')
    with pytest.raises(InputError, match="has format 2, and this flexcage reads format 1"):
        read_verdicts(tmp_path)
    for text in ("{", '{"format": 1}', '{"format": 1, "verdicts": [{"key": "1"}]}'):
        (tmp_path / "verdicts.json").write_text(text)
        with pytest.raises(InputError, match="does not hold verdicts"):
            read_verdicts(tmp_path)
