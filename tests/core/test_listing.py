"""Tables and texts in lines no longer than the terminal is wide, with nothing lost."""

from __future__ import annotations

import random
from collections import Counter

import pytest

from flexcage.core.listing import Listing, aligned, line_width, wrapped

NUMBERS = [
    ["element", *(f"quantity {k}, MPa" for k in range(12))],
    *([str(n), *(f"{1234.5 * n + k:.2f}" for k in range(12))] for n in range(6)),
]
WORDS = [
    ["key", "unit or kind", "default", "meaning"],
    ["cage.material.thermal_expansion_of_the_cage", "1/K", "of the material", "how much " * 12],
    ["solver.duration", "ms", "required", "time of motion that the run computes"],
]


def characters(text: str) -> Counter:
    return Counter("".join(text.split()))


def table_of(seed: int) -> tuple[list[list[str]], str]:
    """Random words and numbers in 2 to 9 columns."""
    draw = random.Random(seed)
    sides = "".join(draw.choice("lr") for _ in range(draw.randint(2, 9)))
    words = ["a", "peak", "of the", "displacement", "cage.material.youngs_modulus"]
    cell = {
        "l": lambda: " ".join(draw.choices(words, k=draw.randint(0, 9))),
        "r": lambda: f"{draw.uniform(-1e4, 1e4):.{draw.randint(0, 4)}f}",
    }
    return [[cell[side]() for side in sides] for _ in range(draw.randint(1, 6))], sides


@pytest.mark.parametrize("width", [40, 80, 120])
@pytest.mark.parametrize("seed", range(40))
def test_no_line_is_longer_and_nothing_is_lost(seed, width):
    rows, sides = table_of(seed)
    text = aligned(rows, sides=sides, indent=2, width=width)
    assert max(map(len, text.splitlines())) <= width
    lost = characters(" ".join(map(" ".join, rows))) - characters(text)
    assert not lost, "what parts of a wide table repeat is more, never less"


def test_words_wrap_and_numbers_stay_in_one_piece():
    rows = [["figure", "value"], ["a name of very many words " * 4, "1,234.5"]]
    lines = aligned(rows, sides="lr", heads=True, width=50).splitlines()
    assert len(lines) > 3 and max(map(len, lines)) == 50
    assert lines[1].endswith("1,234.5") and lines[0].endswith("  value")
    assert all(len(line) < 44 for line in lines[2:]), "below the number stands nothing"
    assert all(line.startswith("  ") for line in lines[2:]), "further lines of a name hang"


def test_a_wide_table_of_numbers_stands_in_parts_that_all_name_their_rows():
    text = aligned(NUMBERS, sides="lr", heads=True, width=80)
    parts = text.split("\n\n")
    assert len(parts) == 2
    for part in parts:
        lines = part.splitlines()
        assert [line.split()[0] for line in lines[-6:]] == list("012345")
        assert any(line.startswith("element ") for line in lines[:2])
    assert "\n\n" not in aligned(NUMBERS, sides="lr", heads=True, width=160)


def test_sentences_stand_below_their_row_where_keys_take_the_line():
    lines = aligned(WORDS, width=80).splitlines()
    assert lines[:2] == [
        "key                                          unit or kind  default",
        "    meaning",
    ]
    assert lines[2].startswith("cage.material.thermal_expansion_of_the_cage  1/K")
    assert lines[3].startswith("    how much how much")


def test_titles_and_sentences_stretch_over_the_columns():
    rows = [["Speeds"], ["Cage speed", "100", "rpm"], ["Held", "free across the axis " * 5], []]
    lines = aligned(rows, sides="lrl", indent=2, width=60).splitlines()
    assert lines[:2] == ["Speeds", "  Cage speed  100  rpm"]
    assert lines[2].startswith("  Held        free across the axis free")
    assert len(lines) == 5 and all(line.startswith(" " * 14) for line in lines[3:])
    assert max(map(len, lines)) <= 60


def test_long_names_are_broken_after_their_marks():
    rows = [["runs/one/cases/4f1c8a0d3b5e", "bearing.inner_spall.length_of_the_first"]]
    lines = aligned(rows, width=46).splitlines()
    assert [line.split()[0][-1] for line in lines[:-1]] == ["/"] * (len(lines) - 1)


def test_a_text_keeps_its_first_words_and_hangs():
    text = wrapped("one two three four five six seven", first="  - ", width=14)
    assert text == "  - one two\n    three four\n    five six\n    seven"
    assert wrapped("short", first="  - ") == "  - short"


def test_the_terminal_says_how_wide_a_line_is(monkeypatch):
    rows = [[str(k), "sentence " * 30] for k in range(2)]
    found = {}
    for columns in ("80", "120"):
        monkeypatch.setenv("COLUMNS", columns)
        found[columns] = Listing("Title", ("no", "text"), rows).text()
        assert max(map(len, found[columns].splitlines())) in range(int(columns) - 9, int(columns))
    assert found["80"].count("\n") > found["120"].count("\n")
    monkeypatch.setenv("COLUMNS", "3")
    assert line_width() == 40, "no table has room in less"
