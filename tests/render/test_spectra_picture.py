"""The picture of spectra: its lines are where the bearing's frequencies are, its names apart."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.text import Text
from test_pictures import NUMBERS, check, run

from flexcage import render
from flexcage.core.errors import InputError
from flexcage.render import sheet
from flexcage.render.spectra import spread

__all__ = ["run"]  # a fixture


@pytest.fixture
def figures(monkeypatch):
    """Figures that are saved, drawn."""
    found = []
    save = sheet.save
    monkeypatch.setattr(sheet, "save", lambda f, p: (found.append(f), save(f, p))[1])
    return found


def test_the_picture_of_spectra(run, figures, tmp_path):
    """8 ms at 6000 rpm with 12 rollers: bins of 125 Hz do not tell the shaft and the cage."""
    check(render.spectra_picture(run, tmp_path / "s.png", bearing=NUMBERS))
    (figure,) = figures
    texts = [t.get_text() for t in figure.findobj(Text) if t.get_visible()]
    for line in ("BSF\n510.8 Hz", "BPFO\n541.8 Hz", "2 BSF\n1,021.6 Hz", "BPFI\n658.2 Hz"):
        assert line in texts, line
    everything = "\n".join(texts)
    for words in ("not marked: FTF 45.2 Hz, shaft 100.0 Hz", "1 segment, Hann window", "µm/√Hz",
                  "lines without slip at 6,000 rpm", "Cage speed", "rpm/√Hz", "N/√Hz"):  # fmt: skip
        assert words in everything, words
    assert "Acceleration" not in everything, "this run has none"
    drawn = {
        float(line.get_xdata()[0]) for line in figure.axes[-1].lines if len(line.get_xdata()) == 2
    }
    assert sorted(drawn) == pytest.approx([510.7765, 541.8182, 658.1818, 1021.5530], abs=1e-3)


def test_legends_stand_beside_their_panels(run, figures, tmp_path):
    render.spectra_picture(run, tmp_path / "s.png", bearing=NUMBERS)
    (figure,) = figures
    renderer = figure.canvas.get_renderer()
    for ax in figure.axes:
        legend = ax.get_legend().get_window_extent(renderer)
        assert legend.x0 > ax.get_window_extent(renderer).x1
        assert legend.x1 < figure.bbox.x1


def test_names_of_lines_do_not_meet(run, figures, tmp_path):
    render.spectra_picture(run, tmp_path / "s.png", bearing=NUMBERS)
    (figure,) = figures
    renderer = figure.canvas.get_renderer()
    names = [t for t in figure.axes[0].texts if "Hz" in t.get_text()]
    boxes = sorted((t.get_window_extent(renderer) for t in names), key=lambda box: box.x0)
    assert len(boxes) == 4
    assert all(left.x1 < right.x0 for left, right in zip(boxes, boxes[1:]))


def test_a_speed_that_changes_is_said(run, figures, tmp_path):
    ramp = run.copy(deep=True)
    ramp["inner_speed"][:] *= np.linspace(0.9, 1.1, ramp.sizes["time"])
    render.spectra_picture(ramp, tmp_path / "s.png", bearing=NUMBERS)
    texts = [t.get_text() for t in figures[0].findobj(Text)]
    assert any("6,000 rpm, which runs from 5,400 to 6,600" in text for text in texts)


def test_too_short_a_run_is_one_sentence(run, tmp_path):
    with pytest.raises(InputError, match=r"1022 Hz; there are .* ms: raise solver.duration"):
        render.spectra_picture(run, tmp_path / "s.png", bearing=NUMBERS, settle=0.8)
    assert not (tmp_path / "s.png").exists()


def test_places_move_apart_as_little_as_they_must():
    assert spread(np.array([1.0, 5.0]), 2.0, low=0.0, high=9.0).tolist() == [1.0, 5.0]
    assert spread(np.array([4.0, 4.5]), 2.0, low=0.0, high=9.0).tolist() == [3.25, 5.25]
    assert spread(np.array([0.1, 0.2]), 2.0, low=0.0, high=9.0).tolist() == [0.0, 2.0]
    assert spread(np.array([8.5, 9.0]), 2.0, low=0.0, high=9.0).tolist() == [7.0, 9.0]
    assert spread(np.array([]), 2.0, low=0.0, high=9.0).tolist() == []
