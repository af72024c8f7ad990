"""A study on disk: its text, one folder a case, one file a case that failed.

    study.toml            the study, complete
    plan.json             hashes of its cases, in order, and what tables say of the base case
    cases/<hash>/         a finished case: its run, and row.json with its figures
    cages/<digest>.zip    a cage that runs share (``results.cage_file``), one file each
    cases/<hash>.part/    a case that is running, or was when its process ended
    failed/<hash>.json    why a case has no figures
    running.lock          held by the process that runs it

A case's folder gets its name by one rename, once all in it is on disk, so a name without ``.part``
is a finished case. ``cases`` is one Zarr store, with a group a case (``xarray.open_datatree``).
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from flexcage.core.errors import InputError, unwritable
from flexcage.core.locks import LOCK, held
from flexcage.core.warning import RunWarning
from flexcage.core.writing import replace
from flexcage.study.about import About, from_store, to_store
from flexcage.study.outputs import Figure
from flexcage.study.plan import Plan, Planned
from flexcage.study.spec import FORMAT, Study, stored_study, stored_table

_ROW, _PART = "row.json", ".part"
_LEFT_OVER = (LOCK, "cases", "failed", "plan.json.new")  # of one killed before it had a plan
_NOT_THERE = (KeyError, TypeError, AttributeError)  # a text that is not what was written
_ZARR_GROUP = {"zarr_format": 3, "node_type": "group", "attributes": {}}


@dataclass(frozen=True)
class Failure:
    """Why a case has no figures. A final failure would come again: only ``retry`` tries it."""

    kind: str
    reason: str
    final: bool


@dataclass(frozen=True)
class CaseRow:
    """What is known of one finished case: ``seconds`` of processor time that it took, and
    ``warnings``, None where nobody looked for any."""

    hash: str
    seconds: float
    figures: Mapping[str, Figure]
    warnings: tuple[RunWarning, ...] | None = None


class Folder:
    """Paths and files of a study's folder."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.cases, self.failed = self.path / "cases", self.path / "failed"

    def case(self, name: str) -> Path:
        return self.cases / name

    def has_run(self, name: str) -> bool:
        """Whether the finished case of this hash kept its run, whatever the study keeps now."""
        return (self.case(name) / "results.zarr").is_dir()

    def part(self, name: str) -> Path:
        return self.cases / f"{name}{_PART}"

    def lock(self, name: str) -> Path:
        return self.cases / f"{name}.lock"

    def study(self) -> Study:
        """The study that the folder holds, which runs no code: InputError if it holds none, or of
        another format, or one that needs files of the user's own that are not loaded."""
        return stored_study(self._text_file())

    def _text_file(self) -> Path:
        if not (self.path / "study.toml").is_file():
            raise InputError(
                f"'{self.path}' is not the folder of a study: it has no study.toml.", where="study"
            )
        return self.path / "study.toml"

    def about(self) -> tuple[About, tuple[Planned, ...]]:
        """What the folder says of its study, and the cases as they were planned last; InputError
        if they are not there. Nothing of the user's own is needed to read it."""
        file = self._text_file()
        stored_table(file)  # refuses another format
        try:
            plan = json.loads((self.path / "plan.json").read_text("utf-8"))
            if isinstance(plan, list):  # of an earlier flexcage: hashes alone
                plan = {"hashes": plan, **to_store(self.study())}
            about = from_store(file, plan)
            return about, about.planned(plan["hashes"])
        except InputError:
            raise
        except (OSError, TypeError, ValueError, KeyError, AttributeError) as exc:
            raise InputError(
                f"'{self.path}' does not hold the plan of its study.toml; go on with 'flexcage "
                f"study resume {self.path}', which plans it anew.",
                where="study",
            ) from exc

    def plan(self) -> Plan:
        """The study's cases as they were planned last, to be built."""
        _, cases = self.about()
        return Plan(self.study(), cases)

    def prepare(self, plan: Plan) -> None:
        """Make the folder, or take over one that holds a study: its cases are found by content."""
        if self.path.exists() and not self.path.is_dir():
            raise InputError(f"'{self.path}' is a file; name a folder for the study.", where="out")
        if (self.path / "plan.json").is_file():  # a study.toml alone is the user's own
            if (self.path / "study.toml").is_file():
                stored_table(self.path / "study.toml")  # refuses another format
        elif self.path.is_dir() and any(p.name not in _LEFT_OVER for p in self.path.iterdir()):
            raise InputError(
                f"'{self.path}' holds files and no study; name an empty or a new folder with -o.",
                where="out",
                value=str(self.path),
            )
        try:
            for folder in (self.path, self.cases, self.failed):
                folder.mkdir(parents=True, exist_ok=True)
            with self.held():
                _write_json(self.cases / "zarr.json", _ZARR_GROUP)
                hashes = [planned.hash for planned in plan.cases]
                kept = {"format": FORMAT, "hashes": hashes, **to_store(plan.study)}
                _write_json(self.path / "plan.json", kept)
                replace(self.path / "study.toml", plan.study.to_toml().encode())
        except OSError as exc:
            what, remedy = f"The study's folder '{self.path}'", "name another with -o"
            raise unwritable(what, exc, remedy=remedy, path=self.path) from exc

    def held(self) -> AbstractContextManager[None]:
        """Let no other process run a study here meanwhile; InputError if one does.

        The tables of the first would be made by the plan of the second. A killed process holds
        nothing.
        """
        return held(self.path, "a study")

    def row(self, name: str) -> CaseRow | None:
        """The finished case of this hash, or None."""
        path = self.case(name) / _ROW
        stored = _read_json(path)
        if stored is None:
            return None
        if not isinstance(stored, dict) or "format" not in stored:
            raise _lacks(path, "the figures of a case")
        if stored["format"] != FORMAT:
            raise InputError(
                f"'{self.case(name)}' is a case of study format {stored['format']}, and this "
                f"flexcage reads format {FORMAT}: run the study anew in another folder.",
                where="format",
                value=stored["format"],
            )
        try:
            figures = {key: Figure(*values) for key, values in stored["figures"].items()}
            warned = stored.get("warnings")
            warnings = None if warned is None else tuple(RunWarning(*values) for values in warned)
            return CaseRow(name, stored["seconds"], figures, warnings)
        except _NOT_THERE as exc:
            raise _lacks(path, "the figures of a case") from exc

    def failure(self, name: str) -> Failure | None:
        """Why the case of this hash failed, or None."""
        path = self.failed / f"{name}.json"
        stored = _read_json(path)
        try:
            return None if stored is None else Failure(**stored)
        except _NOT_THERE as exc:
            raise _lacks(path, "the reason of a failure") from exc

    def write_row(self, where: Path, row: CaseRow) -> None:
        """Write a case's row into the folder ``where`` of its run."""
        figures = {k: [f.value, f.unit, f.shown, f.margin] for k, f in row.figures.items()}
        stored = {"format": FORMAT, "hash": row.hash, "seconds": row.seconds, "figures": figures}
        if row.warnings is not None:
            stored["warnings"] = [[w.key, w.text] for w in row.warnings]
        _write_json(where / _ROW, stored)

    def finish(self, name: str) -> None:
        """Give a case that is complete its name, once all in it is on disk."""
        part = self.part(name)
        _write_json(part / "zarr.json", _ZARR_GROUP)
        for file in part.iterdir():
            if file.is_file():
                _sync(file)
        if self.case(name).exists():  # its figures alone had been kept, and more are wanted
            shutil.rmtree(self.case(name))
        os.rename(part, self.case(name))
        _sync(self.cases)
        (self.failed / f"{name}.json").unlink(missing_ok=True)

    def write_failure(self, name: str, failure: Failure) -> None:
        _write_json(self.failed / f"{name}.json", asdict(failure))

    def forget_failure(self, name: str) -> None:
        """Forget a failure and what was computed until then."""
        (self.failed / f"{name}.json").unlink(missing_ok=True)
        shutil.rmtree(self.part(name), ignore_errors=True)

    def running(self) -> set[str]:
        """Hashes of cases that are running, or were when their process ended."""
        return {p.name.removesuffix(_PART) for p in self.cases.glob(f"*{_PART}")}


def _write_json(path: Path, value: Any) -> None:
    replace(path, json.dumps(value, indent=1).encode())


def _read_json(path: Path) -> Any:
    try:
        return json.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return None
    except (OSError, ValueError) as exc:
        raise InputError(
            f"'{path}' cannot be read ({exc}); remove it to compute the case anew.",
            where="study",
            value=str(path),
        ) from exc


def _lacks(path: Path, what: str) -> InputError:
    return InputError(
        f"'{path}' does not hold {what}; remove it to compute the case anew.",
        where="study",
        value=str(path),
    )


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
