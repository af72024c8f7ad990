"""What tables and pages say of a study, as its folder keeps it: to read it runs no code.

The base case may need a user's own file to be built; its text, its units and what it assumes are
stored beside the plan, so that nothing is built to look at what was computed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

from flexcage.case import description
from flexcage.core.binding import unit_at
from flexcage.study.axes import Axis
from flexcage.study.plan import Planned, points_of
from flexcage.study.spec import Repeat, Study, stored_axes, stored_repeat, stored_table


@dataclass(frozen=True)
class About:
    """A study without its case: what varies, how often it is repeated, and what is wanted."""

    name: str
    axes: tuple[Axis, ...]
    outputs: tuple[str, ...]
    repeat: Repeat
    use: tuple[str, ...]  # extensions with which it was planned
    base: Mapping[str, Any]  # the base case as nested tables
    units: Mapping[str, str]  # of every path that varies; "" for one without
    in_words: tuple[str, ...]  # the base case
    assumptions: Mapping[str, tuple[str, str]]  # by path: value and reason
    text: str  # study.toml

    def planned(self, hashes: list[str]) -> tuple[Planned, ...]:
        """The cases, whose hashes are known: nothing is built, nothing checked."""
        places = product(enumerate(points_of(self.axes)), range(self.repeat.count))
        return tuple(
            Planned(n, point, k, h) for ((n, point), k), h in zip(places, hashes, strict=True)
        )


def to_store(study: Study) -> dict[str, Any]:
    """What of the base case tables and pages want, as plain JSON values."""
    paths = (path for axis in study.axes for path in axis.paths)
    return {
        "units": {path: unit_at(study.case, path) for path in paths},
        "in_words": description.in_words(study.case),
        "assumptions": description.assumed(study.case),
    }


def from_store(file: Path, stored: Mapping[str, Any]) -> About:
    """What a study's folder says of it: by study.toml, and by what ``to_store`` gave."""
    table = stored_table(file)
    return About(
        name=str(table.get("name", "study")),
        axes=stored_axes(table),
        outputs=tuple(map(str, table["outputs"])),
        repeat=stored_repeat(table),
        use=tuple(table["use"]),
        base=table["case"],
        units={str(path): str(unit) for path, unit in stored["units"].items()},
        in_words=tuple(map(str, stored["in_words"])),
        assumptions={path: (value, why) for path, (value, why) in stored["assumptions"].items()},
        text=file.read_text("utf-8"),
    )
