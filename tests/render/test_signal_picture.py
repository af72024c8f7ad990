"""The picture of a signal: its panels show what is in it, and no text lies on another."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from test_pictures import check

from flexcage import render
from flexcage.render import sheet

RATE = 51.2e3
LINES = {"FTF": 39.7, "2 BSF": 464.4, "BPFO": 357.2, "BPFI": 542.8}


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    """Draw blows at BPFO under forces (time, element): the figure."""
    found = []
    save = sheet.save
    monkeypatch.setattr(sheet, "save", lambda f, p: (found.append(f), save(f, p))[1])
    t = np.arange(6000) / RATE
    since = t % (1.0 / LINES["BPFO"])
    noise = 0.02 * np.random.default_rng(1).normal(size=len(t))
    x = np.exp(-since / 2e-4) * np.sin(2 * np.pi * 9e3 * since) + noise
    attrs = {"units": "m/s^2", "long_name": "acceleration, accelerometer at outer ring"}
    signal = xr.DataArray(x, dims="time", coords={"time": t}, attrs=attrs)

    def draw(**options):
        check(render.signal_picture(signal, tmp_path / "s.png", lines=LINES, **options))
        return found[-1]

    return draw


def forces(count):
    t = np.arange(0.0, 0.117, 2e-5)
    values = 400.0 + 100.0 * np.sin(40.0 * t[:, None] + np.arange(count))
    attrs = {"long_name": "force of the outer race on each ball"}
    return xr.DataArray(values, dims=("time", "element"), coords={"time": t}, attrs=attrs)


def of(figure):
    return {ax.get_title(loc="left"): ax for ax in figure.axes}


def test_every_panel_shows_what_its_title_says(drawn):
    panels = of(drawn(force=forces(3)))
    hidden = panels["Hidden under it: force of the outer race on each ball"]
    assert len(hidden.lines) == 3 and hidden.get_ylim()[0] == 0.0
    signal, spectrogram = panels["Signal"], panels["Spectrogram"]
    assert signal.get_xlim() == hidden.get_xlim() == spectrogram.get_xlim()
    (image,) = spectrogram.images
    strongest = image.get_array()[4:].max(axis=1).argmax() + 4
    assert strongest * RATE / 256 == pytest.approx(9e3, rel=0.05)
    (curve,) = (x for x in panels["Envelope spectrum, 2 to 20 kHz"].lines if len(x.get_xdata()) > 2)
    assert curve.get_xdata()[curve.get_ydata().argmax()] == pytest.approx(
        LINES["BPFO"], abs=RATE / 6000
    )
    assert "Amplitude spectrum" in panels and len(of(drawn())) == len(panels) - 1


def test_no_text_of_it_lies_on_another(drawn):
    figure = drawn(force=forces(9).isel(element=0))
    renderer = figure.canvas.get_renderer()
    legends = [ax.get_legend() for ax in figure.axes if ax.get_legend()]
    named = [text for ax in figure.axes for text in (ax.xaxis.label, ax.yaxis.label, *ax.texts)]
    titles = [title for ax in figure.axes for title in (ax.title, ax._left_title)]
    said = [*figure.texts, *named, *titles, *(t for g in legends for t in g.get_texts())]
    texts = [t for t in said if t.get_text()]
    boxes = [(t.get_text(), t.get_window_extent(renderer)) for t in texts]
    within = figure.bbox
    for i, (text, box) in enumerate(boxes):
        assert within.x0 <= box.x0 and box.x1 <= within.x1, text
        for other, another in boxes[:i]:
            assert not box.overlaps(another), (text, other)
