"""One HTML file with everything in it: style, scripts, pictures and data. It asks no network.

The page forbids itself any request by its own Content-Security-Policy.
"""

from __future__ import annotations

import base64
import datetime
import io
import re
from collections.abc import Iterable
from importlib.resources import files
from pathlib import Path
from typing import Any

from flexcage._version import __version__
from flexcage.core.binding import path_of
from flexcage.core.errors import InputError, unwritable
from flexcage.core.writing import check_own, replace
from flexcage.report.blocks import Image, Page

LIMIT = 15e6  # bytes of a page
_MADE, _HEAD = b'<meta name="generator" content="flexcage ', 2000  # in so many bytes of a page
_MOST_PICTURE = 150_000  # bytes of a picture above which it is packed tighter
_QUALITY = 88  # of a picture packed tighter (WebP)
_EFFORT = 2  # of 6 in packing: half the time of the usual 4, and 3 % more bytes


class PageTooLarge(InputError):
    """A page that would be larger than ``LIMIT``."""


def write_page(page: Page, path: str | Path) -> Path:
    """Write the page to ``path`` in one move; InputError if it is too big or cannot be written."""
    path = path_of(path, "path")
    if path.suffix != ".html":
        raise InputError(f"'{path}' should end in .html.", where="out", value=str(path))
    text = html(page).encode()
    if len(text) > LIMIT:
        raise PageTooLarge(
            f"The report would take {len(text) / 1e6:.1f} MB, more than {LIMIT / 1e6:.0f} MB; "
            "show fewer pictures, or fewer points of a study (--points).",
            where="report",
            value=len(text),
        )
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        replace(path, text)
    except OSError as exc:
        remedy = "name another file with -o"
        raise unwritable(f"The report '{path}'", exc, remedy=remedy, path=path) from exc
    return path


def is_page(path: Path) -> bool:
    """Whether a file is a page that flexcage wrote, and may be written anew."""
    try:
        with open(path, "rb") as file:
            return _MADE in file.read(_HEAD)
    except OSError:
        return False


def html(page: Page) -> str:
    """The page as the text of one HTML file."""
    import jinja2
    from plotly.offline import get_plotlyjs

    assets = files("flexcage.report") / "assets"
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(embedded=embedded, figures=figures, breakable=breakable)
    template = environment.from_string((assets / "page.html.j2").read_text("utf-8"))
    now = datetime.datetime.now(datetime.UTC)
    charts = any(b.kind in ("chart", "charts") for s in page.sections for b in s.blocks)
    return template.render(
        page=page,
        version=__version__,
        date=f"{now:%Y-%m-%d %H:%M} UTC",
        style=(assets / "page.css").read_text("utf-8"),
        script=(assets / "page.js").read_text("utf-8"),
        plotly=get_plotlyjs() if charts else "",
    )


def embedded(image: Image) -> str:
    """A picture as a data URI; a large one is packed as WebP. InputError for what is no picture,
    and for a link: a page is given away, and a link may lead to anything."""
    import PIL.Image

    check_own(image.path)
    try:
        data = image.path.read_bytes()
        kind = "png"
        if len(data) > _MOST_PICTURE:
            data, kind = _webp(data), "webp"
    except (OSError, ValueError, PIL.Image.DecompressionBombError) as exc:
        raise InputError(f"The picture '{image.path}' cannot be read as an image.") from exc
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def _webp(data: bytes) -> bytes:
    import PIL.Image

    packed = io.BytesIO()
    with PIL.Image.open(io.BytesIO(data)) as picture:
        picture.convert("RGB").save(packed, "WEBP", quality=_QUALITY, method=_EFFORT)
    return packed.getvalue()


def breakable(name: str) -> Any:
    """A name that may be broken after its dots, lines and brackets; escaped."""
    from markupsafe import Markup, escape

    marks = re.sub(r"([._=\]])(?=\S)", "\\1\u200b", name)
    return escape(marks).replace("\u200b", Markup("<wbr>"))


def figures(pairs: Iterable[tuple[str, Any]]) -> str:
    """Plotly figures as a JSON list that may stand inside a script element."""
    parts = [figure.to_json() for _, figure in pairs]
    text = f"[{','.join(parts)}]"
    for sign in "<>&":  # in JSON they stand in strings only, where an escape means the same
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return text
