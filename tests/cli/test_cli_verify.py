"""``flexcage verify``: its table, its files, and that a missed answer is reported as one."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from flexcage import cli, verification
from flexcage.core.errors import InputError
from flexcage.verification import KnownAnswer, Row, Tolerance, chapter, register_case, run_case

FAILING = """
from flexcage.verification import KnownAnswer, Row, Tolerance, register_case

NEAR = Tolerance(1e-3, "as printed")


def rows():
    yield Row("kept", "N", 2.0, 2.001, NEAR)
    yield Row("missed", "N", 2.0, 2.1, NEAR)


register_case(KnownAnswer(name="own", title="Own", source="a book", checks="Sums.", rows=rows))
"""


@pytest.fixture(autouse=True)
def own_chapter(monkeypatch, tmp_path):
    monkeypatch.setattr(chapter, "CHAPTER", dict(chapter.CHAPTER))
    monkeypatch.chdir(tmp_path)


def case(*rows, name="own"):
    def compute():
        for row in rows:
            if isinstance(row, Exception):
                raise row
            yield row

    return KnownAnswer(name=name, title="Own", source="a book", checks="Sums.", rows=compute)


def test_a_failing_case_from_outside_is_reported_and_exits_with_1(tmp_path, capsys):
    (tmp_path / "own.py").write_text(FAILING)
    argv = ["verify", "own", "ratings", "--use", str(tmp_path / "own.py"), "-o", "report.json"]
    assert cli.main(argv) == 1
    lines = capsys.readouterr().out.splitlines()
    missed = next(line for line in lines if "missed, N" in line)
    assert missed.split() == ["own", "missed,", "N", "2", "2.1", "+5", "%", "0.1", "%", "FAIL"]
    assert any("kept, N" in line and line.endswith("pass") for line in lines)
    assert any(line.startswith("1 of 2 cases passed") for line in lines)
    report = json.loads((tmp_path / "report.json").read_text())
    assert not report["passed"] and [c["passed"] for c in report["cases"]] == [False, True]
    assert [r["passed"] for r in report["cases"][0]["rows"]] == [True, False]


def test_the_case_of_the_page_passes(tmp_path, capsys):
    page = Path(verification.__file__).with_name("README.md").read_text("utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```", page, flags=re.S | re.M)
    (tmp_path / "my_case.py").write_text(block)
    assert cli.main(["verify", "my_rating", "--use", "my_case.py", "-o", "mine.json"]) == 0
    assert "1 of 1 cases passed, 1 of 1 rows" in capsys.readouterr().out


@pytest.mark.parametrize("number", [float, np.float64])
def test_a_report_is_written_of_numbers_of_numpy_as_well(number, tmp_path):
    row = Row("one", "", number(1.0), number(1.0), Tolerance(0.1, "near"))
    chapter.register_case(case(row))
    assert cli.main(["verify", "own", "-o", "report.json"]) == 0
    (written,) = json.loads((tmp_path / "report.json").read_text())["cases"]
    assert written["rows"][0]["passed"] is True


def test_cases_that_pass_exit_with_0(capsys, tmp_path):
    assert cli.main(["verify", "ratings", "-o", "report.md"]) == 0
    out = capsys.readouterr().out
    header = out.splitlines()[0].split()
    wanted = ["case", "quantity", "reference", "flexcage", "difference", "tolerance", "verdict"]
    assert header == wanted
    assert "FAIL" not in out
    text = (tmp_path / "report.md").read_text()
    assert "Source: ISO 76:2006" in text and "| f_c of the N1013 | 83.8 |" in text
    assert cli.main(["verify", "ratings", "-o", "report.md"]) == 2
    assert "--force" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["verify", "static_laod"], ["'static_laod' is not known", "nearest", "'static_load'"]),
        (["verify", "qqq"], ["'qqq' is not known", "--list"]),
        (["verify", "free_bearing"], ["'free_bearing' is not known", "--list"]),  # not 'ratings'
        (["verify", "-o", "report.txt"], ["'report.txt' should end in .json or .md"]),
        (["verify", "static_load", "--quick"], ["leave out --quick"]),
    ],
)
def test_mistakes_get_one_sentence(argv, words, capsys):
    assert cli.main(argv) == 2
    sentence = capsys.readouterr().err
    assert sentence.count("\n") == 1 and all(word in sentence for word in words)


def test_list_names_every_case_and_computes_nothing(monkeypatch, capsys):
    monkeypatch.setattr("flexcage.verification.run_case", None)
    assert cli.main(["verify", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(chapter.CHAPTER)
    assert cli.main(["verify", "--list", "--quick"]) == 0
    quick = capsys.readouterr().out.splitlines()
    assert quick and all(line.split()[1] == "quick" for line in quick) and len(quick) < len(lines)


@pytest.mark.parametrize("value", [1.0 + 2e-3, 1.0 - 2e-3, math.nan, math.inf])
@pytest.mark.parametrize("absolute", [False, True])
def test_a_value_that_is_off_or_no_number_fails(value, absolute):
    tolerance = Tolerance(1e-3, "as printed", absolute=absolute)
    assert Row("near", "", 1.0, 1.0 + 0.9e-3, tolerance).passed
    assert not Row("far", "", 1.0, value, tolerance).passed


def test_a_relative_tolerance_of_zero_is_no_answer():
    assert not Row("nothing", "", 0.0, 0.0, Tolerance(1e-3, "as printed")).passed


def test_a_case_that_stops_or_has_no_rows_fails_with_a_sentence(capsys):
    register_case(case(Row("one", "", 1.0, 1.0, Tolerance(0.1, "near")), ValueError("no mesh")))
    register_case(case(name="empty"))
    assert cli.main(["verify", "own", "empty"]) == 1
    out = capsys.readouterr().out
    assert "ValueError: no mesh" in out and "the case has no rows" in out
    assert "0 of 2 cases passed, 1 of 1 rows" in out
    assert not run_case(chapter.CHAPTER["empty"]).passed


def test_a_name_is_taken_once_and_a_source_is_wanted():
    with pytest.raises(InputError, match="'ratings' exists already"):
        register_case(case(name="ratings"))
    with pytest.raises(InputError, match="has no source"):
        register_case(KnownAnswer(name="x", title="X", source="", checks="X.", rows=tuple))
