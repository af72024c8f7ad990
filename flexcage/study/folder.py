"""A study on disk: its text, one folder a case, one file a case that failed.

    study.toml            the study, complete
    plan.json             the study as it was planned: its text, the values and the hash of every
                          case, and what tables say of the base case; sealed
    cases/<hash>/         a finished case: its run, and row.json with its figures
    cages/<digest>.zip    a cage that runs share (``results.cage_file``), one file each
    cases/<hash>.part/    a case that is running, or was when its process ended
    failed/<hash>.json    why a case has no figures
    shards/<i>-of-<n>/    a part of it that one process computes: cases, cages, failed, as here
    running.lock          held by the process that runs it

A row says of which case it is, with which values and by which flexcage, and has a seal: an edited
one is refused. A case's folder gets its name by one rename, once all in it is on disk, so a name
without ``.part`` is a finished case. ``cases`` is one Zarr store, with a group a case
(``xarray.open_datatree``).
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator
from contextlib import AbstractContextManager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from flexcage.core.binding import path_of
from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.hashing import seal_holds
from flexcage.core.locks import LOCK, held
from flexcage.core.output_folders import check_no_file, check_study
from flexcage.core.reading import read_json
from flexcage.core.writing import check_own, holds_others, replace, sync, written
from flexcage.study.about import About, from_store, to_store
from flexcage.study.case_row import CaseRow, Failure, row_from
from flexcage.study.origin import this_one
from flexcage.study.plan import Plan, Planned
from flexcage.study.spec import FORMAT, Study, check_format, stored_study, stored_table

_ROW, _PART = "row.json", ".part"
SHARDS = "shards"
_ITS_OWN = ("study.toml", "plan.json", "cases", "failed", "cages", SHARDS)
_LEFT_OVER = (LOCK, "cases", "failed", SHARDS, "plan.json.new")  # killed before it had a plan
_NOT_THERE = (KeyError, TypeError, AttributeError)  # a text that is not what was written
_ZARR_GROUP = {"zarr_format": 3, "node_type": "group", "attributes": {}}


class Folder:
    """Paths and files of a study's folder. Nothing inside it is read or written through a link:
    InputError, which names the link."""

    def __init__(self, path: str | Path) -> None:
        self.path = path_of(path, "study")
        self.cases, self.failed = self.path / "cases", self.path / "failed"

    def case(self, name: str) -> Path:
        return _own(self.cases, self.cases / name)

    def has_run(self, name: str) -> bool:
        """Whether the finished case of this hash kept its run, whatever the study keeps now."""
        return (self.case(name) / "results.zarr").is_dir()

    def part(self, name: str) -> Path:
        return _own(self.cases, self.cases / f"{name}{_PART}")

    def lock(self, name: str) -> Path:
        return _own(self.cases, self.cases / f"{name}.lock")

    def reason(self, name: str) -> Path:
        """The file that says why a case failed."""
        return _own(self.failed, self.failed / f"{name}.json")

    def study(self) -> Study:
        """The study that the folder holds, which runs no code: InputError if it holds none, or of
        another format, or one that needs files of the user's own that are not loaded."""
        return stored_study(self._text_file())

    def _check_links(self) -> None:
        _own(*(self.path / name for name in _ITS_OWN))

    def _text_file(self) -> Path:
        self._check_links()
        check_study(self.path)
        return self.path / "study.toml"

    def about(self) -> tuple[About, tuple[Planned, ...]]:
        """What the folder says of its study, and the cases as they were planned last; InputError
        if they are not there. Nothing of the user's own is needed to read it."""
        return self._planned()[1:]

    def planned_by_this(self, study: Study) -> tuple[Planned, ...]:
        """The cases if this very flexcage planned them, of this study; none otherwise, also of a
        plan that cannot be read."""
        self._check_links()
        try:
            stored, about, cases = self._planned()
        except InputError:
            return ()
        own = stored.get("origin") == this_one().to_store()
        return cases if own and about.text == study.to_toml() else ()

    def _planned(self) -> tuple[dict[str, Any], About, tuple[Planned, ...]]:
        """What plan.json holds, and what it says."""
        file = self._text_file()
        try:
            plan = read_json(self.path / "plan.json")
            if not seal_holds(plan):
                raise ValueError("its seal is broken")
            check_format(plan.get("format", FORMAT), self.path / "plan.json")
            return plan, *from_store(file, plan)
        except InputError:
            raise
        except (OSError, TypeError, ValueError, KeyError, AttributeError, IndexError) as exc:
            raise InputError(
                f"'{self.path}' does not hold the plan of its study.toml, or an edited one; go on "
                f"with 'flexcage study resume {self.path}', which plans it anew.",
                where="study",
            ) from exc

    def plan(self) -> Plan:
        """The study's cases as they were planned last, to be built."""
        about, cases = self.about()
        return Plan(self.planned_study(about), cases)

    def planned_study(self, about: About) -> Study:
        """The study as it was planned, whatever its study.toml says now; errors as ``study``."""
        return stored_study(self._text_file(), about.text)

    def prepare(self, plan: Plan) -> None:
        """Make the folder, or take over one that holds a study: its cases are found by content."""
        self._check_place()
        try:
            self.make()
            with self.held():
                _write_json(self.path / "plan.json", to_store(plan))
                replace(self.path / "study.toml", plan.study.to_toml().encode())
        except OSError as exc:
            raise self._unwritable(exc) from exc

    def begin_shards(self, plan: Plan) -> None:
        """Leave the plan for its shards, of which many may begin at the same moment, if another is
        there or none."""
        self._check_place()
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            text = {"study.toml": plan.study.to_toml(), "plan.json": json.dumps(to_store(plan))}
            for name, content in text.items():
                with written(self.path / name) as file:
                    file.write_text(content, "utf-8")
        except OSError as exc:
            raise self._unwritable(exc) from exc

    def make(self) -> None:
        """Make the folders of cases and failures, as those of a shard."""
        for folder in (self.path, self.cases, self.failed):
            folder.mkdir(parents=True, exist_ok=True)
        _write_json(self.cases / "zarr.json", _ZARR_GROUP)

    def _check_place(self) -> None:
        check_no_file(self.path)
        self._check_links()
        if (self.path / "plan.json").is_file():  # a study.toml alone is the user's own
            if (self.path / "study.toml").is_file():
                stored_table(self.path / "study.toml")  # refuses another format
        elif holds_others(self.path, _LEFT_OVER):
            raise InputError(
                f"'{self.path}' holds files and no study; name an empty or a new folder with -o.",
                where="out",
                value=str(self.path),
            )

    def _unwritable(self, error: OSError) -> FlexcageError:
        what, remedy = f"The study's folder '{self.path}'", "name another with -o"
        return unwritable(what, error, remedy=remedy, path=self.path)

    def held(self) -> AbstractContextManager[None]:
        """Let no other process run a study here meanwhile; InputError if one does.

        The tables of the first would be made by the plan of the second. A killed process holds
        nothing.
        """
        return held(self.path, "a study")

    def row(self, name: str) -> CaseRow | None:
        """The finished case of this hash, or None."""
        path = _own(self.case(name) / _ROW)
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
        if not seal_holds(stored):
            raise _lacks(path, "the figures as they were computed: it was edited")
        try:
            if stored["hash"] != name:
                raise _lacks(path, f"the figures of this case but of {stored['hash']}")
            return row_from(stored)
        except _NOT_THERE as exc:
            raise _lacks(path, "the figures of a case") from exc

    def failure(self, name: str) -> Failure | None:
        """Why the case of this hash failed, or None."""
        path = self.reason(name)
        stored = _read_json(path)
        try:
            return None if stored is None else Failure(**stored)
        except _NOT_THERE as exc:
            raise _lacks(path, "the reason of a failure") from exc

    def write_row(self, where: Path, row: CaseRow) -> None:
        """Write a case's row into the folder ``where`` of its run."""
        _write_json(where / _ROW, row.to_store())

    def finish(self, name: str) -> None:
        """Give a case that is complete its name, once all in it is on disk."""
        part = self.part(name)
        _write_json(part / "zarr.json", _ZARR_GROUP)
        for file in part.iterdir():
            if file.is_file():
                sync(file)
        if self.case(name).exists():  # its figures alone had been kept, and more are wanted
            shutil.rmtree(self.case(name))
        os.rename(part, self.case(name))
        sync(self.cases)
        self.reason(name).unlink(missing_ok=True)

    def finish_begun(self, name: str) -> None:
        """Finish a case whose process was killed when all was computed, if there is one."""
        if self.is_whole(name):
            self.finish(name)

    def is_whole(self, name: str) -> bool:
        """Whether a case that is not finished lacks nothing but its name."""
        return (self.part(name) / _ROW).is_file()

    def write_failure(self, name: str, failure: Failure) -> None:
        _write_json(self.reason(name), asdict(failure))

    def forget_failure(self, name: str) -> None:
        """Forget a failure and what was computed until then."""
        self.reason(name).unlink(missing_ok=True)
        shutil.rmtree(self.part(name), ignore_errors=True)

    def finished(self) -> Iterator[str]:
        """Hashes of the cases that are finished, planned or not."""
        for path in sorted(self.cases.glob(f"*/{_ROW}")):
            if path.parent.suffix != _PART:
                yield path.parent.name

    def failures(self) -> Iterator[str]:
        """Hashes of the cases that failed."""
        yield from (path.stem for path in sorted(self.failed.glob("*.json")))

    def running(self) -> set[str]:
        """Hashes of cases that are running, or were when their process ended."""
        return {p.name.removesuffix(_PART) for p in self.cases.glob(f"*{_PART}")}


def _own(*paths: Path) -> Path:
    """The last of the paths, if none of them is a link; InputError for the first that is."""
    for path in paths:
        if path.is_symlink():
            check_own(path)
    return paths[-1]


def _write_json(path: Path, value: Any) -> None:
    replace(path, json.dumps(value, indent=1).encode())


def _read_json(path: Path) -> Any:
    try:
        return read_json(path)
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
