"""Sheets: figures laid out in pixels, with one style for all of flexcage's pictures.

Nothing is placed by guess: every image, bar and line of text has its own rectangle. Figures are
made without pyplot, so that no global state is touched and no window is ever opened.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, log10
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError, unwritable
from flexcage.core.writing import written

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 150
_PACKED = 2  # of 9, of a picture's file: half the time of the usual 6, and a tenth more bytes
_LONGEST = 60  # characters of a name in a heading

#: Okabe and Ito's colours, told apart with any kind of colour vision.
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
INK, FAINT, HAIR = "#1a1a1a", "#5c5c5c", "#c9c9c9"

STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.labelsize": 9.0,
    "axes.edgecolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "lines.linewidth": 1.1,
    "text.color": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.formatter.useoffset": False,
    "pdf.fonttype": 42,  # TrueType, which journals take
    "svg.hashsalt": "flexcage",  # the same picture is the same file
}

Rect = tuple[float, float, float, float]  # left, top, width, height in pixels, from the top left


def style() -> Any:
    """Context in which figures must be made and saved."""
    import matplotlib as mpl

    return mpl.rc_context(STYLE)


def new_figure(width: float, height: float) -> Figure:
    """A figure of ``width`` by ``height`` pixels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def axes_at(figure: Figure, rect: Rect, **kwargs: Any) -> Axes:
    """Axes whose frame fills a rectangle of pixels."""
    w, h = (np.asarray(figure.get_size_inches()) * DPI).tolist()
    left, top, width, height = rect
    return figure.add_axes((left / w, 1.0 - (top + height) / h, width / w, height / h), **kwargs)


def put_pixels(figure: Figure, left: float, top: float, pixels: np.ndarray) -> None:
    """Pixels (height, width, 3) as they are, below all else; matplotlib would resample them."""
    from matplotlib.artist import Artist

    w, h = (np.asarray(figure.get_size_inches()) * DPI).tolist()
    corner = left / w, 1.0 - (top + len(pixels)) / h
    opaque = np.full((*pixels.shape[:2], 4), 255, np.uint8)
    opaque[..., :3] = pixels[::-1]

    class Pixels(Artist):
        zorder = -1.0

        def draw(self, renderer: Any) -> None:
            x, y = figure.transFigure.transform(corner)
            renderer.draw_image(renderer.new_gc(), round(x), round(y), opaque)

    figure.add_artist(Pixels())


def image_at(figure: Figure, rect: Rect, pixels: np.ndarray, *, frame: str | None = None) -> Axes:
    """An image in a rectangle; the axes' coordinates are the image's own pixels, y downwards."""
    put_pixels(figure, *rect[:2], pixels)
    ax = axes_at(figure, rect)
    h, w = pixels.shape[:2]
    ax.patch.set_visible(False)
    ax.set(xlim=(0, w), ylim=(h, 0), xticks=[], yticks=[])
    ax.grid(False)
    for spine in ax.spines.values():
        spine.set_visible(frame is not None)
        spine.set(edgecolor=frame or "none", linewidth=1.2)
    return ax


def text_at(figure: Figure, x: float, y: float, text: str, **kwargs: Any) -> Any:
    """Text at pixels from the top left, anchored at its top left by default."""
    w, h = (np.asarray(figure.get_size_inches()) * DPI).tolist()
    options = {"va": "top", "ha": "left", **kwargs}
    return figure.text(x / w, 1.0 - y / h, text, **options)


def heading(figure: Figure, title: str, subtitle: str = "", *, left: float = 36.0) -> None:
    """Title and a fainter line under it, in the top 88 pixels; shrunk to fit the width."""
    w = float(figure.get_size_inches()[0]) * DPI
    rows = ((title, 22.0, 14.0, "bold", INK), (subtitle, 58.0, 10.0, "normal", FAINT))
    for text, top, size, weight, colour in rows:
        if text:
            artist = text_at(figure, left, top, text, fontsize=size, weight=weight, color=colour)
            fit_width(figure, artist, w - 2.0 * left)


def fit_width(figure: Figure, artist: Any, width: float) -> None:
    """Make a text smaller until it fits into ``width`` pixels."""
    canvas: Any = figure.canvas
    wide = artist.get_window_extent(canvas.get_renderer()).width
    if wide > width:
        artist.set_fontsize(artist.get_fontsize() * width / wide)


def colour_bar(
    figure: Figure,
    rect: Rect,
    *,
    cmap: Any,
    limits: tuple[float, float],
    label: str,
    over: bool = False,
    vertical: bool = False,
    ticks: int = 6,
) -> Axes:
    """A colour bar in a rectangle (the bar itself; its ticks lie below, or to the right).

    ``over``: the bar ends in an arrow, for values beyond the upper limit.
    """
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.ticker import MaxNLocator

    ax = axes_at(figure, rect)
    bar = figure.colorbar(
        ScalarMappable(Normalize(*limits), cmap),
        cax=ax,
        orientation="vertical" if vertical else "horizontal",
        extend="max" if over else "neither",
        extendfrac=0.035,
    )
    bar.locator = MaxNLocator(ticks, steps=[1, 2, 2.5, 5, 10])
    bar.update_ticks()
    bar.outline.set_linewidth(0.6)
    bar.set_label(label)
    return ax


def colour_map(name: str, over: str = VERMILION) -> Any:
    """A perceptually even map by name, with its own colour for what lies beyond the range."""
    import matplotlib as mpl

    return mpl.colormaps[name].with_extremes(over=over, under=mpl.colormaps[name](0.0))


def nothing(ax: Axes, words: str) -> None:
    """Say in the middle of a plot why it is empty; its values have no scale then."""
    ax.text(0.5, 0.5, words, transform=ax.transAxes, ha="center", va="center", color=FAINT)
    ax.set(ylim=(0.0, 1.0), yticks=[0.0])


def rounded_up(value: float) -> float:
    """The next round figure: two digits at most, steps of a fifth at most."""
    if not value > 0.0:
        return 1.0
    power = 10.0 ** floor(log10(value))
    steps = (1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0)
    return power * next(s for s in steps if s * power >= value * (1.0 - 1e-9))


def rounded_down(value: float) -> float:
    """The nearest of 1, 2, 5 times a power of ten not above ``value`` (1 for nothing)."""
    if not (value > 0.0 and np.isfinite(value)):
        return 1.0
    power = 10.0 ** floor(log10(value))
    return power * max(s for s in (1.0, 2.0, 5.0) if s * power <= value * (1.0 + 1e-9))


def robust_limit(values: np.ndarray, *, share: float = 0.995) -> tuple[float, bool]:
    """Upper end of a colour range, and whether values lie beyond it.

    The largest value sets the range unless it stands alone: then the range ends above
    ``share`` of the surface, so that the field can be read, and hot spots get their own colour.
    """
    top = float(np.max(values, initial=0.0))
    most = float(np.quantile(values, share)) if len(values) else 0.0
    if top > 1.4 * most > 0.0:
        return rounded_up(most * 1.1), True
    return rounded_up(top), False


def save(figure: Figure, path: str | Path) -> Path:
    """Write the figure; the folder is made if needed."""
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with written(path) as temporary:
            _write(figure, temporary)
    except OSError as error:
        raise unwritable(f"The picture '{path}'", error, path=path) from error
    except ValueError as error:
        raise InputError(
            f"The picture {path} cannot be written: {error}.", where="path", value=str(path)
        ) from error
    return path


def _write(figure: Figure, path: Path) -> None:
    """A .png without transparency, packed fast; what else matplotlib can write by its suffix."""
    if path.suffix.lower() != ".png":
        undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(path.suffix.lower())
        figure.savefig(path, dpi=DPI, metadata=undated)
        return
    from PIL import Image

    picture = Image.fromarray(pixels_of(figure))
    picture.save(path, dpi=(DPI, DPI), compress_level=_PACKED)


def pixels_of(figure: Figure) -> np.ndarray:
    """The drawn figure as (height, width, 3) uint8."""
    canvas: Any = figure.canvas
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def label(name: str) -> str:
    """A name that a user gave, as a heading shows it: one line, not too long, no formula. Of a long
    one both ends are kept, so that folders of one place can be told apart."""
    line, half = " ".join(name.split()), _LONGEST // 2
    shown = line if len(line) <= _LONGEST else f"{line[: half - 1]}…{line[-half:]}"
    return shown.replace("$", r"\$")


def join(parts: Sequence[str]) -> str:
    """Parts of a subtitle, the empty ones left out."""
    return "   ·   ".join(p for p in parts if p)
