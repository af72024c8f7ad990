"""Cases of this folder: the N1013 on the coarse mesh, short runs."""

from __future__ import annotations

from collections.abc import Mapping

from flexcage.case import Case, load_case
from flexcage.core.progress import Silent

PLACES = ("race", "pocket", "side", "rib", "land")
BASE = {
    "bearing": {"preset": "N1013"},
    "mesh": {"fineness": "coarse"},
    "load": {"radial": "1000 N"},
    "output": {"block": 50},
    "solver": {"duration": "2 ms"},
}


def n1013(*tables: Mapping[str, object], **sections) -> Case:
    """The preset with a sound cage; ``tables`` map dotted paths to text, later ones win."""
    return load_case({**BASE, **sections}, overrides={k: v for t in tables for k, v in t.items()})


def bent(displacement: str, *, crossbeam: int = 5) -> list[dict]:
    return [{"type": "crossbeam", "crossbeam": crossbeam, "displacement": displacement}]


class Interrupted:
    """A progress context that presses Ctrl-C once ``blocks`` blocks of ``length`` [s] are done."""

    def __init__(self, blocks: int, length: float) -> None:
        self.stop_at, self.calls = (blocks - 0.5) * length, []

    def __call__(self, total: float | None, label: str) -> Interrupted | Silent:
        if label != "solving":
            return Silent(total, label)
        self.total, self.label = total, label
        return self

    def __enter__(self) -> Interrupted:
        return self

    def __exit__(self, *error) -> None:
        self.closed = True

    def begin_at(self, done: float) -> None:
        self.begun = done

    def to(self, done: float) -> None:
        self.calls.append(done)
        if done > self.stop_at:
            raise KeyboardInterrupt
