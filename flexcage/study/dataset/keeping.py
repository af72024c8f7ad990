"""Recording cases as they finish: what a worker keeps of a run before it may go."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.run import Run
from flexcage.study.case_row import CaseRow
from flexcage.study.dataset.folder import DatasetFolder
from flexcage.study.dataset.recording import recording_of
from flexcage.study.plan import Planned


@dataclass(frozen=True)
class RecordingKeeper:
    """Keeps the recording of a case in the data set ``folder``, which people know as ``name``."""

    folder: str
    name: str
    edges: tuple[float, ...]
    planned: Planned

    def has(self) -> bool:
        """Is the recording complete?"""
        return DatasetFolder(self.folder).has(self.planned.hash)

    def keep(self, run: Run, row: CaseRow) -> None:
        """Add the recording."""
        made = recording_of(run, self.planned, row, self.name, self.edges)
        DatasetFolder(self.folder).add(self.planned.hash, made)
