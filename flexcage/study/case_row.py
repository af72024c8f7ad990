"""What a study keeps of a case: its row of figures, or why it has none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from flexcage.core.hashing import sealed
from flexcage.core.warning import RunWarning
from flexcage.study.origin import Origin, stored_origin
from flexcage.study.outputs import StudyFigure
from flexcage.study.spec import FORMAT


@dataclass(frozen=True)
class Failure:
    """Why a case has no figures. A final failure would come again: only ``retry`` tries it."""

    kind: str
    reason: str
    final: bool


@dataclass(frozen=True)
class CaseRow:
    """What is known of one finished case: ``seconds`` of processor time that it took, ``warnings``
    of its run, ``values`` that the study's axes gave it, by path, and the flexcage that computed
    it."""

    hash: str
    seconds: float
    figures: Mapping[str, StudyFigure]
    warnings: tuple[RunWarning, ...]
    values: Mapping[str, Any]
    origin: Origin

    def to_store(self) -> dict[str, Any]:
        """As its file holds it, sealed."""
        figures = {k: [f.value, f.unit, f.shown, f.margin] for k, f in self.figures.items()}
        return sealed({
            "format": FORMAT, "hash": self.hash, "seconds": self.seconds, "figures": figures,
            "warnings": [[w.key, w.text] for w in self.warnings],
            "values": dict(self.values), "origin": self.origin.to_store(),
        })  # fmt: skip


def row_from(stored: Mapping[str, Any]) -> CaseRow:
    """The row that a file holds; KeyError, TypeError or AttributeError for none."""
    figures = {key: StudyFigure(*values) for key, values in stored["figures"].items()}
    warnings = tuple(RunWarning(*values) for values in stored["warnings"])
    origin = stored_origin(stored["origin"])
    return CaseRow(stored["hash"], stored["seconds"], figures, warnings, stored["values"], origin)
