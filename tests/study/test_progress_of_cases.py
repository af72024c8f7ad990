"""What a study shows while it runs: workers, stages and shares, and an estimate from these."""

import io

import pytest

from flexcage.core.progress import Progress
from flexcage.study.progress import Board, ReportedProgress


def event(case, stage, share=None):
    return 0.0, {"case": case, "stage": stage, "share": share}


def test_the_line_names_workers_cases_and_stages_and_counts_parts_of_cases(monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    stream = io.StringIO()
    with Progress(4, "cases", stream=stream, enabled=True) as bar:
        bar.begin_at(1)
        board = Board(bar, {"a": 1, "b": 2, "c": 3}, 4, 1)
        board.workers(2)
        bar._drawn = 0.0
        board.on_event(event("b", "kernels"))
        board.on_event(event("a", "solving", 0.5))
        board.on_event(event("of another study", "solving", 0.9))
        bar._drawn = 0.0
        board.on_event(event("a", "solving", 0.6))
        assert bar.done == pytest.approx(1.0 + 0.95 * 0.6)
        assert bar.detail == "; 1 of 4 done, 2 workers, case 1 solving 60 %, case 2 kernels"
        assert f"39 %{bar.detail}" in stream.getvalue()
        board.finished("a")
        assert bar.done == 2.0 and "case 1" not in bar.detail and "2 of 4 done" in bar.detail
        board.on_event(event("a", "stress"))  # what comes late
        assert bar.done == 2.0
        board.close()
        said = stream.getvalue()
        bar._drawn = 0.0
        board.on_event(event("b", "solving", 0.9))
        assert stream.getvalue() == said


def test_a_line_is_no_wider_than_the_terminal(monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    stream = io.StringIO()
    with Progress(4, "cases", stream=stream, enabled=True) as bar:
        board = Board(bar, dict(zip("abcdefgh", range(8))), 8, 0)
        for case in "abcdefgh":
            bar._drawn = 0.0
            board.on_event(event(case, "solving", 0.25))
    drawn = stream.getvalue().strip().split("\r")
    assert max(map(len, drawn)) == 59 and any("case 0" in line for line in drawn)


def test_a_worker_tells_every_stage_and_few_of_its_steps():
    said = []
    with ReportedProgress(lambda stage, share: said.append((stage, share)), None, "mesh"):
        pass
    with ReportedProgress(
        lambda stage, share: said.append((stage, share)), 2.0, "solving"
    ) as solving:
        for step in range(100):
            solving.to(step / 50.0)
        solving._last -= 1.0
        solving.to(1.5)
    assert said == [("mesh", None), ("solving", 0.0), ("solving", 0.75)]
