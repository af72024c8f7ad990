"""Reading TOML: what is no TOML, or none that anybody writes, is one sentence, whoever reads it."""

import pytest

from flexcage.case.presets import register_preset
from flexcage.cli.settings import parse_setting
from flexcage.core.errors import InputError, in_one_line
from flexcage.core.toml import read_toml
from flexcage.study.spec import load_study

BAD = {
    "no value": ("a = \n", "not valid TOML"),
    "digits without end": (f"a = {'1' * 4400}", "thousands of digits"),
    "lists in lists": (f"a = {'[' * 1500}{']' * 1500}", "20 deep"),
    "lists in tables": (f"a{'.a' * 30} = [1]", "20 deep"),
}


SLIPS = {
    "curly quotes": ("radial = \u201c1 kN\u201d", 'write straight ones, as "1 kN"'),
    "low quotes": ("radial = \u201e1 kN\u201c", "typographic"),
    "no quotes": ("[load]\nradial = 1.5 kN", 'in quotes: radial = "1.5 kN"'),
    "no quotes, a comment": ("radial = 1kN # heavy", 'in quotes: radial = "1kN"'),
    "no end": ('radial = "1 kN\n[drive]', "a quote is missing at the end"),
    "a table twice": ("[load]\na = 1\n[load]\nb = 2", r"[load] stands twice: write all its"),
    "one twice below": ("[a.b]\n[a.b]", "[a.b] stands twice"),
    "windows": ("a = 1\r\nradial = 1 kN\r\n", 'radial = "1 kN"'),
    "yaml": ("load:\n  radial: 5\n", "a section begins in brackets: [load]"),
    "a colon": (
        '[load]\nradial: "1 kN"',
        """'=' stands between a name and its value: radial = "1 kN\"""",
    ),
    "json": ('{"load": {"radial": "1 kN"}}', "TOML is no JSON or XML: [load] begins a section"),
    "a word": ("[bearing]\npreset = N1013  # mine", 'text stands in quotes: preset = "N1013"'),
    "a blank of print": ('[load]\nradial\u00a0= "1 kN"', "a no-break space"),
    "two on a line": ('a = "1 N" b = "2 N"', "begin a new one at b = "),
    "a comma": ('radial = "1 kN",\naxial = "0 N"', "leave out the mark at the line's end"),
    "C": ("// mine\n", "a comment begins with #"),
    "a path": ('file = "c:\\users\\a"', "single quotes"),
}


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_of_the_pen_is_told_what_to_write(name):
    text, words = SLIPS[name]
    with pytest.raises(InputError) as caught:
        read_toml(text, "It")
    assert words in str(caught.value) and "not valid TOML" in str(caught.value)


@pytest.mark.parametrize("text", ["a = \n", "a == 1", "= 3", "[a"])
def test_other_mistakes_are_told_no_wrong_remedy(text):
    with pytest.raises(InputError) as caught:
        read_toml(text, "It")
    assert str(caught.value).count(";") == 0


@pytest.mark.parametrize("name", BAD)
def test_every_reader_says_it_in_one_sentence(name, tmp_path):
    text, words = BAD[name]
    path = tmp_path / "file.toml"
    path.write_text(text)
    for read in (
        lambda: read_toml(text, "It"),
        lambda: register_preset(path),
        lambda: load_study(path),
    ):
        with pytest.raises(InputError, match=words) as caught:
            read()
        assert str(caught.value).count("file.toml") <= 1 and "\n" not in str(caught.value)


def test_what_is_as_deep_as_cases_are_is_read():
    assert read_toml("a.b.c.d = [{e = [1]}]", "It")["a"]["b"]["c"]["d"] == [{"e": [1]}]


@pytest.mark.parametrize("value", ["1" * 4400, "[" * 1500 + "]" * 1500])
def test_a_setting_that_is_no_toml_is_text(value):
    assert parse_setting(f"seed={value}") == ("seed", value)


def test_sentences_lose_the_middle_of_long_values_and_control_characters():
    path = "/a" * 100 + "/case.toml"  # as long as paths may be
    assert in_one_line(f"There is no '{path}'.") == f"There is no '{path}'."
    told = in_one_line(f"x is '{'y' * 5000}\nand \0', but should be z.")
    assert len(told) < 300 and told.endswith("but should be z.") and "characters)" in told
    words = f"the ball's 'a' {'is here ' * 40}'b' of the ball's."  # long between two values
    assert in_one_line(words) == words
    assert in_one_line("a\0b\nc") == r"a\x00b\nc"
    assert len(in_one_line("word " * 9999)) < 1300
