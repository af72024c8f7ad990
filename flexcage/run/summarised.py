"""A run with its summary, and with its warnings."""

from __future__ import annotations

from functools import cached_property

from flexcage.core import html
from flexcage.core.warning import RunWarning
from flexcage.results.figures.own import with_own
from flexcage.results.summary import SUMMARY, Summary
from flexcage.run.record import RunRecord
from flexcage.run.summary import part_of, summary_of, timed, warned, with_stress


class SummarisedRun(RunRecord):
    """One simulation, finished or not, with ``summary`` and ``warnings``."""

    def _repr_html_(self) -> str:
        """For notebooks: warnings and the figures that matter most."""
        title = f"Run {self.case.name}: {self._size()}"
        edited = html.bullets(f"Warning: {warning.text}" for warning in self.edited)
        return html.block(title, edited, self.summary_at_end.brief_html())

    @cached_property
    def summary(self) -> Summary:
        """Figures of the run: speeds, slip, motion, forces, stress, energy, solver, times."""
        if self.cage is None or "stress_peak" in self.summary_at_end:
            return self.summary_at_end
        return with_stress(self.summary_at_end, self)

    @cached_property
    def summary_at_end(self) -> Summary:
        """The summary as the run's end made it: one in a study may have left its stress out."""
        if self.folder and (self.folder / SUMMARY).exists():
            stored = Summary.read(self.folder / SUMMARY, vouched=self.store.vouches_for)
            stored = stored if stored.warnings is not None else warned(stored, self)
            return with_own(stored, lambda: part_of(self))
        return summary_of(self)

    @property
    def warnings(self) -> tuple[RunWarning, ...]:
        """What the reader of the run's figures must know, from its start and from its results."""
        return (*self.edited, *(self.summary_at_end.warnings or ()))

    def report_times(self) -> None:
        """Bring the wall times of a run just computed up to now in its summary, the stored one
        included."""
        self.summary = timed(self.summary, self)
        self._write_summary(self.summary)

    def _write_summary(self, summary: Summary) -> None:
        """Store it, for a run that has a folder; RunFailed if that is gone."""
        if self.folder:
            self.store.check_there()
            self.store.vouch_for(SUMMARY, summary.content)
            summary.write(self.folder)
