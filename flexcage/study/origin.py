"""Which flexcage computed a case, so that what different ones computed is not mixed unseen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from flexcage._version import __version__
from flexcage.core.errors import InputError
from flexcage.core.sources import physics

_SHOWN = 8  # digits of the physics' hash that a sentence shows


@dataclass(frozen=True)
class Origin:
    """Version, and hash of the sources of physics (``core.sources.physics``)."""

    version: str
    physics: str

    def __str__(self) -> str:
        return f"{self.version} (physics {self.physics[:_SHOWN]})"

    def to_store(self) -> dict[str, str]:
        return asdict(self)


def stored_origin(table: Any) -> Origin:
    """The origin that a file holds; KeyError or TypeError for none."""
    return Origin(str(table["version"]), str(table["physics"]))


def this_one() -> Origin:
    """This process's flexcage."""
    return Origin(__version__, physics())


def origins_note(origins: Iterable[Origin]) -> str:
    """A sentence if cases are not all of one flexcage, or of another than this one; else
    nothing."""
    found = list(origins)
    counts = Counter(map(str, found))
    if len(counts) > 1:
        parts = [f"{count} by {name}" for name, count in counts.items()]
        return (
            "Different versions of flexcage computed these cases: "
            f"{', '.join(parts)}. Results may differ between them; to have all by one, run the "
            "study in a new folder."
        )
    if found and not same_physics(found[0]):
        return (
            f"Another flexcage, {found[0]}, computed these cases, and this is {this_one()}: "
            "computed anew they may differ."
        )
    return ""


def same_physics(origin: Origin) -> bool:
    """Whether this flexcage has the physics of that one."""
    return origin.physics == physics()


def check_origins(origins: Iterable[Origin], *, new: int, folder: Any, allowed: bool) -> str:
    """A sentence if finished cases are of other physics than the ``new`` ones that would now join
    them, or nothing; InputError unless ``allowed``."""
    found = list(origins)
    others = [origin for origin in found if not same_physics(origin)]
    if not others or not new:
        return ""
    names = ", ".join(dict.fromkeys(map(str, others)))
    text = (
        f"{len(others)} of the {len(found)} finished cases in '{folder}' were computed by flexcage "
        f"{names}, and this is {this_one()}: with the {new} still to compute, one table would mix "
        "different physics."
    )
    if allowed:
        return text
    raise InputError(
        f"{text[:-1]}. Go on with the one that began it, take a new folder, or take "
        "--other-version (in Python, other_version=True), which table and page then say.",
        where="resume",
        value=others[0].physics,
    )
