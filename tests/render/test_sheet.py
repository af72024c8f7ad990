"""Figures as files: pixels as they are, no transparency."""

import numpy as np
import PIL.Image
import pytest

from flexcage.render import sheet


def test_pixels_are_put_and_saved_as_they_are(tmp_path):
    pixels = np.random.default_rng(3).integers(0, 256, (40, 70, 3), np.uint8)
    with sheet.style():
        figure = sheet.new_figure(200, 150)
        ax = sheet.image_at(figure, (20, 30, 70, 40), pixels)
        ax.plot([35, 35], [10, 12], color="#ff00ff", lw=3.0)
        path = sheet.save(figure, tmp_path / "a.png")
    with PIL.Image.open(path) as saved:
        assert (saved.mode, saved.size) == ("RGB", (200, 150))
        assert saved.info["dpi"] == pytest.approx((sheet.DPI, sheet.DPI), abs=0.1)
        found = np.asarray(saved)
    here = found[30:70, 20:90]
    same = (here == pixels).all(axis=2)
    assert same[:, :30].all() and same[20:].all(), "not resampled"
    assert not same[9:13, 33:37].all(), "what is plotted lies on them"
    assert (found[:30] == 255).all() and (found[:, :20] == 255).all()


def test_other_formats_are_written_by_their_suffix(tmp_path):
    with sheet.style():
        figure = sheet.new_figure(200, 150)
        sheet.image_at(figure, (20, 30, 70, 40), np.zeros((40, 70, 3), np.uint8))
        assert sheet.save(figure, tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
