"""Cases of bearings without a cage: how they are asked for, what they keep, what they refuse."""

from __future__ import annotations

import pytest

from flexcage.case import load_case
from flexcage.case.description import in_words
from flexcage.case.unread import not_used
from flexcage.core.errors import InputError

FULL = """
[bearing]
preset = "N1013"
roller_count = 32
[cage]
model = "none"
"""


def test_a_full_complement_is_asked_for_by_the_model_of_the_cage():
    case = load_case(FULL)
    assert case.cage is None and case.cage_model == "none" and not list(not_used(case))
    assert "no cage" in repr(case) and "full complement" in " ".join(in_words(case))
    with pytest.raises(InputError, match=r"has no cage: cage\.model is 'none'"):
        case.its_cage  # noqa: B018


def test_its_text_reads_back_to_the_same_case():
    case = load_case(FULL)
    again = load_case(case.to_toml())
    assert again == case and again.hash == case.hash
    assert case.to_table()["cage"] == {"model": "none"}


def test_a_case_with_a_cage_loses_it_and_all_that_goes_with_it():
    text = {
        "bearing": {"preset": "N1013"},
        "cage": {"pocket_width": "8.2 mm"},
        "defects": [{"type": "crossbeam", "crossbeam": 1, "displacement": "0.1 mm"}],
    }
    caged = load_case(text)
    bare = caged.replace("cage.model", "none")
    assert bare.cage is None and not list(not_used(bare))
    assert bare.hash != caged.hash
    assert bare.hash == load_case({**text, "cage": {"model": "none"}}).hash


def test_values_of_a_cage_in_the_text_of_none_are_told_as_not_used():
    case = load_case(FULL + 'pocket_width = "8.2 mm"\n[mesh]\nfineness = "fine"\n')
    (told,) = not_used(case)
    assert "cage.pocket_width" in told and "mesh.fineness" in told
    assert "cage.model is 'none'" in told


def test_one_that_says_nothing_of_a_cage_is_refused_with_both_remedies():
    table = load_case(FULL).to_table()
    table.pop("cage")
    table["bearing"].pop("preset")
    with pytest.raises(InputError, match=r"\[cage\] is missing.*model = \"none\""):
        load_case(table)


def test_a_constraint_on_the_cage_is_refused():
    text = FULL + '[[constraints]]\ntype = "cage_tilt"\n'
    with pytest.raises(InputError, match=r"constraints\.0\.type is 'cage_tilt'.*'none'"):
        load_case(text)


def test_more_elements_than_fit_are_refused_with_the_most_that_do():
    with pytest.raises(InputError, match="at most 32 fit"):
        load_case(FULL.replace("32", "33"))
