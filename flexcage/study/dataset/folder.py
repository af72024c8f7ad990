"""A data set on disk.

    manifest.json, metadata.parquet   what ``bearing-datasets`` reads: a row a signal
    signals/part-<hash>.parquet       the signals of one recording, a row each
    truth.parquet                     a row a recording: what made it, and all figures of its run
    truth/<hash>.parquet              its hidden forces and motion over time
    splits.parquet                    train, validation or test, by bearing, by load, by seed
    README.md, croissant.json         a card for people, and one for programs
    checksums.json                    SHA-256 of all these files
    records/<hash>.json               a recording that is complete: its rows and its files' SHA-256
    settings.json                     what all its recordings share
    study/                            the figures of the cases, and their runs if these are kept
    shards/<i>-of-<n>/                a part that one process makes: recordings and study/, as here

A recording counts once its record is there, which is written last; every file is written aside and
moved into place. Recordings are only added. The tables and cards are made of the records.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.hashing import seal_holds, sealed
from flexcage.core.locks import LOCK, held
from flexcage.core.output_folders import check_no_file
from flexcage.core.reading import read_json, table_of
from flexcage.core.writing import check_own, holds_others, replace, written
from flexcage.study.dataset.recording import Recording, digest
from flexcage.study.folder import SHARDS

FORMAT = 1  # of a data set's folder
SCHEMA = 2  # of the metadata table: that of bearing-datasets 0.2 and 0.3
INDEX = (
    "manifest.json", "metadata.parquet", "truth.parquet", "splits.parquet", "README.md",
    "croissant.json",
)  # fmt: skip
CHECKSUMS = "checksums.json"
_FOLDERS = ("signals", "truth", "records")
_BEGUN = (LOCK, SHARDS, *_FOLDERS)  # what may be there before settings are


@dataclass(frozen=True)
class Settings:
    """What all recordings of a data set share: edges of severities [m], and words of its cards."""

    edges: tuple[float, ...] = ()
    title: str = ""
    license: str = "CC-BY-4.0"


class DatasetFolder:
    """Paths and files of a data set; nothing in it is read or written through a link."""

    def __init__(self, path: str | Path) -> None:
        self.path = path_of(path, "dataset")
        self.study = self.path / "study"

    @property
    def name(self) -> str:
        """What ``bearing-datasets`` calls it: its folder's name."""
        return self.path.resolve().name

    def held(self) -> AbstractContextManager[None]:
        """Let no other process write to it meanwhile."""
        return held(self.path, "a data set")

    def prepare(self, settings: Settings) -> Settings:
        """Make the folder, or take over a data set with the same settings, which are given back.
        InputError for a folder of other files, and for other settings."""
        check_no_file(self.path)
        check_own(self.path, *(self.path / f for f in (*_FOLDERS, *INDEX, CHECKSUMS)))
        file = self.path / "settings.json"
        if file.is_file():
            stored = self.settings()
            if settings not in (stored, Settings()):
                raise InputError(
                    f"'{self.path}' holds a data set with {_words(stored)}, and {_words(settings)} "
                    "are asked for; take the same, or another folder.",
                    where="dataset",
                )
            return stored
        if holds_others(self.path, _BEGUN):
            raise InputError(
                f"'{self.path}' holds files and no data set; name an empty or a new folder.",
                where="out", value=str(self.path),
            )  # fmt: skip
        for folder in _FOLDERS:
            (self.path / folder).mkdir(parents=True, exist_ok=True)
        table = sealed({"format": FORMAT, "schema": SCHEMA, **asdict(settings)})
        with written(file) as spare:  # shards may begin at the same moment
            spare.write_text(json.dumps(table, indent=1) + "\n", "utf-8")
        return settings

    def settings(self) -> Settings:
        """Its settings; InputError if it is no data set, or one of a newer format or schema."""
        file = self.path / "settings.json"
        if not file.is_file():
            raise InputError(
                f"'{self.path}' holds no data set (it has no settings.json); 'flexcage dataset "
                "STUDY -o DIR' makes one.",
                where="dataset", value=str(self.path),
            )  # fmt: skip
        stored = self._sealed("settings.json")
        for what, known in (("format", FORMAT), ("schema", SCHEMA)):
            if not isinstance(stored.get(what), int) or stored[what] > known:
                raise InputError(
                    f"'{self.path}' is of {what} {stored.get(what)}, and this flexcage knows "
                    f"{known}: take a newer flexcage.",
                    where=what, value=stored.get(what),
                )  # fmt: skip
        return Settings(tuple(stored["edges"]), stored["title"], stored["license"])

    def has(self, recording: str) -> bool:
        """Is a recording complete?"""
        return (self.path / "records" / f"{recording}.json").is_file()

    def add(self, recording: str, made: Recording) -> None:
        """Write a recording's files, then its record."""
        for name, content in made.files.items():
            replace(self.path / name, content)
        sums = {name: digest(content) for name, content in made.files.items()}
        self._write_json(
            f"records/{recording}.json",
            {"hash": recording, "files": sums, "rows": made.rows, "truth": made.truth},
        )

    def records(self) -> list[dict[str, Any]]:
        """Records of all complete recordings, by name; InputError for one that was edited."""
        names = sorted(p.name for p in (self.path / "records").glob("*.json"))
        return [self._sealed(f"records/{name}") for name in names]

    def record(self, recording: str) -> dict[str, Any]:
        """Record of one complete recording."""
        return self._sealed(f"records/{recording}.json")

    def write_index(self, files: Mapping[str, bytes]) -> None:
        """Write tables and cards, then the checksums of all."""
        for name, content in files.items():
            replace(self.path / name, content)
        sums = {name: digest(content) for name, content in files.items()}
        for record in self.records():
            sums |= record["files"]
            name = f"records/{record['hash']}.json"
            sums[name] = digest((self.path / name).read_bytes())
        self._write_json(CHECKSUMS, {"sha256": dict(sorted(sums.items()))})

    def checksums(self) -> dict[str, str]:
        """SHA-256 of every file by its path, as they were written."""
        found: dict[str, str] = self._sealed(CHECKSUMS)["sha256"]
        return found

    def _write_json(self, name: str, table: Mapping[str, Any]) -> None:
        replace(self.path / name, (json.dumps(sealed(table), indent=1) + "\n").encode())

    def _sealed(self, name: str) -> dict[str, Any]:
        file = self.path / name
        try:
            table = table_of(read_json(file))
            if not seal_holds(table):
                raise ValueError("it was edited")
        except (OSError, ValueError) as exc:
            reason = getattr(exc, "strerror", None) or exc
            raise InputError(
                f"'{file}' is not what was written ({reason}); a record may be removed, and "
                "'flexcage dataset STUDY' makes it anew.",
                where="dataset", value=str(file),
            ) from exc  # fmt: skip
        return table


def _words(settings: Settings) -> str:
    edges = ", ".join(f"{1e3 * edge:g} mm" for edge in settings.edges) or "none"
    title = f" the title '{settings.title}' and" if settings.title else ""
    return f"severity edges {edges},{title} the licence {settings.license}"
