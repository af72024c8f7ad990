"""Is a data set whole: every file as it was written, every row with its samples, no split leaks?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from flexcage.study.dataset.build import read_table
from flexcage.study.dataset.folder import CHECKSUMS, INDEX, DatasetFolder
from flexcage.study.dataset.recording import digest
from flexcage.study.dataset.splits import leaks


@dataclass(frozen=True)
class Verdict:
    """What was looked at, and what is wrong: a sentence each."""

    recordings: int
    signals: int
    files: int
    faults: tuple[str, ...]

    def text(self) -> str:
        """The verdict as a terminal shows it."""
        looked = f"{self.recordings} recordings, {self.signals} signals, {self.files} files"
        if not self.faults:
            return f"{looked}: all as written, no split leaks"
        return "\n".join([f"{looked}: {len(self.faults)} faults", *(f"- {f}" for f in self.faults)])


def check_dataset(path: str | Path) -> Verdict:
    """Verify a data set. InputError for a folder that holds none, or one of a newer schema."""
    folder = DatasetFolder(path)
    folder.settings()
    lacking = [name for name in (CHECKSUMS, *INDEX) if not (folder.path / name).is_file()]
    if lacking:
        again = "run 'flexcage dataset STUDY -o DIR' again, which goes on with it"
        return Verdict(0, 0, 0, (f"'{lacking[0]}' is not there; {again}",))
    sums, records = folder.checksums(), folder.records()
    faults = list(_changed(folder, sums))
    if faults:
        return Verdict(len(records), 0, len(sums), tuple(faults))
    rows, truth = read_table(folder, "metadata.parquet"), read_table(folder, "truth.parquet")
    splits = read_table(folder, "splits.parquet")
    known = {record["hash"] for record in records}
    for name, table in (("metadata", rows), ("truth", truth), ("splits", splits)):
        own = {row["recording_id"] for row in table}
        faults += [f"recording {r} is missing in {name}.parquet" for r in sorted(known - own)]
        faults += [f"{name}.parquet has {r}, which has no record" for r in sorted(own - known)]
    faults += _unlike(folder, rows)
    faults += [
        f"the split '{split}' has '{group}' on two sides" for split, group in leaks(splits, truth)
    ]
    return Verdict(len(records), len(rows), len(sums), tuple(faults))


def _changed(folder: DatasetFolder, sums: dict[str, str]) -> Iterator[str]:
    for name, wanted in sums.items():
        file = folder.path / name
        if file.is_symlink() or not file.is_file():
            yield f"'{name}' is not there"
        elif digest(file.read_bytes()) != wanted:
            yield f"'{name}' was changed"
    listed = {folder.path / name for name in sums}
    for part in ("signals", "truth"):
        for file in sorted((folder.path / part).iterdir()):
            if file not in listed and not file.name.endswith(".new"):
                yield f"'{part}/{file.name}' is of no recording"


def _unlike(folder: DatasetFolder, rows: list[dict]) -> Iterator[str]:
    """Signals whose samples are not where, or as many as, their rows say."""
    import pyarrow.parquet as pq

    files: dict[str, list[tuple[str, int]]] = {}
    for row in rows:
        name = row["signal_file"]
        if name not in files:
            table = pq.ParquetFile(folder.path / "signals" / name).read_row_group(0)
            lengths = [len(values) for values in table.column("signal")]
            files[name] = list(zip(table.column("signal_id").to_pylist(), lengths))
        found = files[name][row["signal_row"]] if row["signal_row"] < len(files[name]) else None
        if found != (row["signal_id"], row["n_samples"]):
            yield f"the samples of '{row['signal_id']}' are not where its row says"
