"""What a study has found, with the page that shows it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from flexcage.study.record import StudyRecord


class StudyResults(StudyRecord):
    """A study's folder: ``table``, ``statistics``, ``report()``, ``page(path)``, and ``run(point)``
    of a case."""

    def page(
        self,
        path: str | Path,
        *,
        points: Sequence[int] | None = None,
        progress: Callable[..., Any] | None = None,
    ) -> Path:
        """Write the study's report, one HTML file that needs no other; returns its path.

        ``points`` are those whose stress is shown (default: up to six, evenly spread).
        ``progress`` is a context like ``core.progress.Progress``.
        """
        from flexcage.study.page import write_study_page

        return write_study_page(self, path, points=points, progress=progress)
