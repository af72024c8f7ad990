"""Names in the picture of two runs compared."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from flexcage.results.summary import Row, Section, Summary
from flexcage.study.compare import compare_runs


@pytest.mark.parametrize(
    ("names", "shown"),
    [
        (["rigid", "flexible"], ["rigid", "flexible"]),
        (["/a/runs/one", "/a/runs/two"], ["one", "two"]),
        (["/a/one/cases/1", "/a/two/cases/1"], ["one/cases/1", "two/cases/1"]),
        (["runs/a", "runs/a/again"], ["a", "a/again"]),
    ],
)
def test_the_picture_names_the_cases_and_tells_folders_apart(names, shown, tmp_path, monkeypatch):
    told = {}

    def draw(datasets, path, *, settle, note):
        told.update(names=list(datasets), note=note)

    monkeypatch.setattr("flexcage.render.compare_forces", draw)
    case = SimpleNamespace(name="my $case", output=SimpleNamespace(settle=0.3))
    summary = Summary((Section("All", (Row("steps", "Steps", 3),)),))
    run = SimpleNamespace(summary=summary, case=case, dataset=None)
    compare_runs(dict.fromkeys(names, run), out=tmp_path)
    assert told == {"names": shown, "note": r"my \$case"}
