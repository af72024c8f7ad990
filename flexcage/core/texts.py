"""Texts that people wrote, in UTF-8: what another encoding is told, and what to do."""

from __future__ import annotations

from pathlib import Path

from flexcage.core.errors import InputError

_MARKS = (b"\xff\xfe", b"\xfe\xff")  # with which editors begin UTF-16


def text_of(path: Path, what: str, *, where: str = "") -> str:
    """The text of a file, which should be ``what``: "a case is TOML". A byte order mark, with which
    some editors begin, is left out.

    OSError from the disk; InputError for another encoding than UTF-8, and for what is no text.
    """
    raw = path.read_bytes()
    try:
        text = raw.decode("utf-8-sig")
        if "\0" not in text:
            return text
        line = 0
    except UnicodeDecodeError as exc:
        line = raw.count(b"\n", 0, exc.start) + 1
    if _is_utf_16(raw):
        found = "is text in UTF-16"
    elif b"\0" in raw:
        raise InputError(
            f"'{path}' is not a text file; {what} text in UTF-8.", where=where, value=str(path)
        )
    else:
        found = f"is not in UTF-8: its line {line} has a character of another encoding"
    raise InputError(
        f"'{path}' {found}; {what} text in UTF-8: save the file again with this encoding, which "
        "editors ask for under 'Save as'.",
        where=where,
        value=str(path),
    )


def _is_utf_16(raw: bytes) -> bool:
    """Text of two bytes a character, with a mark at its begin or without."""
    marked = raw.startswith(_MARKS)
    if not marked and raw[:2].count(0) != 1:
        return False
    coding = "utf-16" if marked else ("utf-16-be" if raw[0] == 0 else "utf-16-le")
    try:
        return "\0" not in raw.decode(coding)
    except UnicodeDecodeError:
        return False
