"""The chapter of known answers, case by case: what ``flexcage verify`` runs for a user."""

import pytest
from known_rows import check

from flexcage.verification import CHAPTER, run_case


@pytest.mark.parametrize("name", CHAPTER)
def test_known_answers(name):
    outcome = run_case(CHAPTER[name])
    assert not outcome.error
    check(outcome.rows)
    assert outcome.passed


@pytest.mark.parametrize("name", CHAPTER)
def test_every_case_says_where_its_numbers_come_from(name):
    case = CHAPTER[name]
    assert len(case.source) > 20 and case.checks.endswith(".") and case.title
