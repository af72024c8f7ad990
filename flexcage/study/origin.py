"""Which flexcage computed a case, so that what different ones computed is not mixed unseen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from flexcage._version import __version__

_SHOWN = 8  # digits of the kernels' hash that a sentence shows


@dataclass(frozen=True)
class Origin:
    """Version and hash of the kernels' sources; both empty where an earlier flexcage kept none."""

    version: str = ""
    kernels: str = ""

    def __str__(self) -> str:
        return f"{self.version} (kernels {self.kernels[:_SHOWN]})" if self.version else ""

    def to_store(self) -> dict[str, str]:
        return asdict(self)


def stored_origin(table: Any) -> Origin:
    """The origin that a file holds, or one that is not known."""
    return Origin(**{k: str(v) for k, v in table.items()}) if table else Origin()


@cache
def this_one() -> Origin:
    """This process's flexcage."""
    from flexcage.core import jit

    return Origin(__version__, jit.source_hash(jit.kernel_sources()))


def told_apart(origins: Iterable[Origin]) -> str:
    """A sentence if cases are not all of one flexcage, or if nobody knows; else nothing."""
    counts = Counter(map(str, origins))
    unknown, total = counts.pop("", 0), sum(counts.values())
    if len(counts) + bool(unknown) > 1:
        parts = [f"{count} by {name}" for name, count in counts.items()]
        parts += [f"{unknown} by an earlier one that kept no version"] if unknown else []
        return (
            "Different versions of flexcage computed these cases: "
            f"{', '.join(parts)}. Results may differ between them; to have all by one, run the "
            "study in a new folder."
        )
    if unknown:
        return (
            f"Which version of flexcage computed the {unknown + total} finished cases is not known."
        )
    return ""
