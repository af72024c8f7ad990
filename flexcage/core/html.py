"""What a notebook shows of an object (``_repr_html_``): plain HTML, no scripts, nothing fetched.

All functions take plain text and escape it; ``block`` and ``folded`` take parts that are HTML.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

_SIDES = {"l": "left", "r": "right"}


def block(title: str, *parts: str) -> str:
    """Parts below a title."""
    return f"<div><strong>{escape(title)}</strong>{''.join(parts)}</div>"


def folded(title: str, *parts: str) -> str:
    """Parts that a click on their title unfolds."""
    return f"<details><summary>{escape(title)}</summary>{''.join(parts)}</details>"


def paragraphs(texts: Iterable[str]) -> str:
    return "".join(f"<p>{escape(text)}</p>" for text in texts if text)


def bullets(texts: Iterable[str]) -> str:
    """A list; nothing if it is empty."""
    items = "".join(f"<li>{escape(text)}</li>" for text in texts)
    return items and f"<ul>{items}</ul>"


def table(rows: Sequence[Sequence[str]], *, heads: Sequence[str] = (), sides: str = "l") -> str:
    """A table; nothing without rows. ``sides`` aligns columns, "l" or "r" each; the last letter
    counts for all that follow."""
    body = "".join(_line(row, "td", sides) for row in rows)
    head = f"<thead>{_line(heads, 'th', sides)}</thead>" if heads else ""
    return body and f"<table>{head}<tbody>{body}</tbody></table>"


def _line(cells: Sequence[str], tag: str, sides: str) -> str:
    aligned = zip(cells, sides + sides[-1] * len(cells))
    texts = (f'<{tag} style="text-align:{_SIDES[s]}">{escape(c)}</{tag}>' for c, s in aligned)
    return f"<tr>{''.join(texts)}</tr>"
