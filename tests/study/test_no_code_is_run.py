"""Opening a study or a run never runs code of its folder: what is stored is enough to read it."""

import subprocess
import sys

import pytest
from study_cases import row_of, short_study

from flexcage.case import extensions
from flexcage.core.errors import InputError
from flexcage.study.axes import Grid
from flexcage.study.folder import Folder
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.spec import Study


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A finished study whose study.toml names a file that leaves a mark when it is run."""
    monkeypatch.setattr(extensions, "_loaded", type(extensions._loaded)())  # by other tests
    mark = tmp_path / "mark"
    out = Folder(tmp_path / "study")
    (tmp_path / "mine.py").write_text(f"from pathlib import Path\nPath({str(mark)!r}).touch()\n")
    written = Study.to_toml
    with_use = ("use = []", 'use = ["../mine.py"]')
    assert with_use[0] in written(short_study())
    monkeypatch.setattr(Study, "to_toml", lambda study: written(study).replace(*with_use))
    plan = make_plan(short_study(Grid("load.radial", ["500 N", "1 kN"])))
    out.prepare(plan)
    for k, planned in enumerate(plan.cases):
        out.case(planned.hash).mkdir()
        figures = {"cage_speed": StudyFigure(100.0 + k, "rad/s", "rpm")}
        out.write_row(out.case(planned.hash), row_of(planned, figures))
    return out


def flexcage(*words: object) -> subprocess.CompletedProcess:
    command = [sys.executable, "-m", "flexcage.cli", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.mark.parametrize("command", [("study", "status"), ("study", "report"), ("report",)])
def test_what_reads_a_study_runs_no_code(folder, tmp_path, command):
    done = flexcage(*command, folder.path)
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "mark").exists()


def test_a_study_of_a_law_that_is_unknown_here_is_read(folder, tmp_path, monkeypatch):
    """Its base case could not be built without the file that registers the law."""
    text = (folder.path / "study.toml").read_text()
    changed = text.replace('law = "lankarani_nikravesh"', 'law = "of_my_own"')
    if changed == text:
        changed = text.replace('guidance = "', 'guidance = "of_my_own_')
    assert changed != text
    monkeypatch.setattr(Study, "to_toml", lambda study: changed)
    folder.prepare(make_plan(short_study(Grid("load.radial", ["500 N", "1 kN"]))))
    results = StudyResults(folder.path)
    assert list(results.table["load.radial [N]"]) == [500.0, 1000.0]
    assert list(results.table["cage_speed [rad/s]"]) == [100.0, 101.0]
    assert "2 done" in results.status() and "cage_speed [rpm]" in results.report()
    assert results.page(tmp_path / "page.html").is_file()
    assert not (tmp_path / "mark").exists()


def test_resume_wants_the_file_named(folder, tmp_path):
    refused = flexcage("study", "resume", folder.path)
    assert refused.returncode == 2 and refused.stderr.count("\n") == 1
    assert "'mine.py'" in refused.stderr and "--use ../mine.py" in refused.stderr
    assert not (tmp_path / "mark").exists()
    done = flexcage("study", "resume", folder.path, "--use", tmp_path / "mine.py")
    assert done.returncode == 0, done.stderr
    assert "2 cases: 2 done" in done.stdout and (tmp_path / "mark").exists()


def test_in_python_the_cases_want_the_file_and_the_table_does_not(folder):
    results = StudyResults(folder.path)
    assert len(results.table) == 2
    with pytest.raises(InputError, match="load_extension"):
        results.study  # noqa: B018
