"""The chapter of known answers, case by case: what ``flexcage verify`` runs for a user."""

import json
from pathlib import Path

import pytest
from known_rows import check

from flexcage.verification import CHAPTER, run_case
from flexcage.verification.cases import cage_modes


@pytest.mark.parametrize("name", CHAPTER)
def test_known_answers(name):
    outcome = run_case(CHAPTER[name])
    assert not outcome.error
    check(outcome.rows)
    assert outcome.passed


def test_frequencies_of_cages_are_those_that_calculix_gave():
    """On the same elements flexcage's are within 2e-5 (``test_calculix.py``)."""
    data = Path(__file__).parent / "data"
    roller, ball = (
        json.loads((data / f"calculix_{name}.json").read_text("utf-8"))
        for name in ("n1013", "7010c")
    )
    for name, stored in (("N1013", roller["cages"]["n1013_normal"]), ("7010C-PI", ball)):
        assert list(cage_modes.TABLE[name]) == stored["frequencies_hz"][:6:2]


@pytest.mark.parametrize("name", CHAPTER)
def test_every_case_says_where_its_numbers_come_from(name):
    case = CHAPTER[name]
    assert len(case.source) > 20 and case.checks.endswith(".") and case.title
