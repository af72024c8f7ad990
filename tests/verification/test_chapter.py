"""The chapter of known answers, case by case: what ``flexcage verify`` runs for a user."""

import pytest

from flexcage.verification import CHAPTER, run_case


@pytest.mark.parametrize("name", CHAPTER)
def test_known_answers(name):
    outcome = run_case(CHAPTER[name])
    assert not outcome.error
    missed = [
        f"{r.quantity}: {r.value:.8g} for {r.reference:.8g} ({r.difference_text}, {r.tolerance})"
        for r in outcome.failures
    ]
    assert outcome.passed, "\n".join(missed)


@pytest.mark.parametrize("name", CHAPTER)
def test_every_case_says_where_its_numbers_come_from(name):
    case = CHAPTER[name]
    assert len(case.source) > 20 and case.checks.endswith(".") and case.title
