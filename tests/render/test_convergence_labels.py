"""The picture of a convergence study has room for every title that stands in it."""

import matplotlib.image
import numpy as np

from flexcage.render import convergence_picture
from flexcage.results.figures.figure import CONVERGENCE
from flexcage.results.figures.table import FIGURES, marked


def test_no_title_is_cut_off(tmp_path):
    records = [
        {"axis": "mesh", "level": "coarse", "finest": "fine", "difference": 0.0, "spread": 0.01,
         "label": FIGURES[key].titled(place="a pocket corner")}
        for key in marked(CONVERGENCE)
    ]  # fmt: skip
    path = convergence_picture(records, tmp_path / "converge.png", name="n")
    edge = matplotlib.image.imread(path)[:, :4, :3]
    assert np.all(edge == edge[0, 0])
