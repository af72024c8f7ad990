"""Two runs compared: their names, and what is written."""

from __future__ import annotations

import json
from types import SimpleNamespace

import pytest

from flexcage.case import Case
from flexcage.core.errors import InputError
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary
from flexcage.study.compare import compare, compare_runs, short_names


@pytest.mark.parametrize(
    ("folders", "names"),
    [
        (["/a/runs/one", "/a/runs/two"], ("one", "two")),
        (["/a/one/cases/1", "/a/two/cases/1"], ("one/cases/1", "two/cases/1")),
        (["runs/a", "runs/a/again"], ("a", "a/again")),
        (["runs/a/", "runs/../runs/b"], ("a", "b")),
    ],
)
def test_folders_are_named_without_what_both_lie_in(folders, names):
    assert short_names(*folders) == names


def stand_in(case: Case, force: float) -> SimpleNamespace:
    row = SummaryRow("pocket_force_mean", "Pocket force, mean", force, "N", margin=1.0)
    return SimpleNamespace(summary=Summary((Section("Forces", (row,)),)), case=case, dataset=None)


def test_a_folder_holds_table_figures_picture_and_page(tmp_path, monkeypatch):
    """The page needs no more than its own file; the picture names both runs."""
    from PIL import Image

    drawn = {}

    def draw(datasets, path, *, settle, note):
        drawn.update(names=list(datasets), settle=settle, note=note)
        Image.new("RGB", (4, 4)).save(path)
        return path

    monkeypatch.setattr("flexcage.render.compare_forces", draw)
    case = Case.from_preset("N1013", name="my $case")
    runs = {
        "rigid": stand_in(case.replace("cage.model", "rigid"), 8.0),
        "flexible": stand_in(case.replace("output.settle", 0.4), 5.0),
    }
    found = compare_runs(runs, out=tmp_path)
    assert drawn == {"names": ["rigid", "flexible"], "settle": 0.4, "note": r"my \$case"}
    assert found["pocket_force_mean"].beyond == "yes"
    assert found.differences == {
        "cage.model": ("rigid", "flexible"), "output.settle": (0.3, 0.4),
    }  # fmt: skip
    assert "0.625  yes" in (tmp_path / "compare.txt").read_text("utf-8")
    stored = json.loads((tmp_path / "compare.json").read_text("utf-8"))
    assert stored["differences"]["cage.model"] == ["rigid", "flexible"]
    page = (tmp_path / "report.html").read_text("utf-8")
    places = [page.index(t) for t in ("Pocket force, mean", "data:image/png", 'id="all-figures"')]
    assert places == sorted(places)
    assert "<h1>my $case: rigid and flexible compared</h1>" in page


def test_without_a_folder_nothing_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case = Case.from_preset("N1013")
    compare_runs({"a": stand_in(case, 8.0), "b": stand_in(case, 5.0)})
    assert not list(tmp_path.iterdir())


def test_a_run_is_not_compared_with_itself(tmp_path):
    with pytest.raises(InputError, match="twice; name two runs"):
        compare(tmp_path, tmp_path / "." / "x" / "..")
