"""Text on terminals and in pipes that cannot show all of it: never an error after hours."""

from __future__ import annotations

import codecs
import sys

_HANDLER = "flexcage"
_PLAIN = {
    "µ": "u", "μ": "u", "±": "+-", "°": " deg ", "×": "x", "·": "*", "–": "-", "—": "-", "−": "-",
    "≤": "<=", "≥": ">=", "²": "^2", "³": "^3", "’": "'", "…": "...", "ö": "oe", "ü": "ue",
    "ä": "ae", "ß": "ss",
}  # fmt: skip


def on_any_terminal() -> None:
    """Let standard output and error write what their encoding lacks in other letters."""
    codecs.register_error(_HANDLER, _in_other_letters)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors=_HANDLER)


def _in_other_letters(error: UnicodeError) -> tuple[str, int]:
    """A handler of ``codecs``: what stands for the characters, and where to go on."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return "".join(_PLAIN.get(letter, "?") for letter in text), error.end
