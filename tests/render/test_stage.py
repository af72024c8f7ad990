"""The off-screen window: what is in front, what faces away, sizes, threads."""

from concurrent.futures import ThreadPoolExecutor

import matplotlib as mpl
import numpy as np
import pytest

from flexcage.render.scene import Layer, View, load_pyvista
from flexcage.render.stage import Stage, shoot

pytestmark = pytest.mark.usefixtures("canvas")
VIEW = View((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), 2.0, up=(0.0, 0.0, 1.0))
SIZE = (60, 40)
SHEETS = {0.2: 1.0, -0.2: 0.0}  # place on x, and value


def sheets(places, *, away=False):
    """Squares across x, of side 1, with a value each, facing the viewer or ``away`` from it."""
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    points = np.concatenate([np.column_stack([np.full(4, x), corners]) for x in places])
    order = (3, 2, 1, 0) if away else (0, 1, 2, 3)
    faces = np.array([[4, *(4 * i + k for k in order)] for i in range(len(places))])
    mesh = load_pyvista().PolyData(points, faces.ravel())
    mesh.point_data["v"] = np.repeat([SHEETS.get(x, 0.0) for x in places], 4)
    return mesh


def middle(picture):
    h, w = picture.pixels.shape[:2]
    return picture.pixels[h // 2, w // 2].astype(int)


@pytest.mark.parametrize("places", [(0.2, -0.2), (-0.2, 0.2)])
def test_translucent_faces_are_drawn_from_back_to_front(places):
    cmap = mpl.colors.ListedColormap(["blue", "red"])
    layer = Layer(
        sheets(places), opacity=0.5, values="v", cmap=cmap, lit=False, limits=(0.0, 1.0)
    )  # fmt: skip
    behind = 0.5 * np.array([0.0, 0.0, 255.0]) + 0.5 * 255.0
    expected = 0.5 * np.array([255.0, 0.0, 0.0]) + 0.5 * behind
    assert np.allclose(middle(shoot([layer], VIEW, SIZE)), expected, atol=3.0)


def test_of_a_closed_body_only_what_faces_the_viewer_is_drawn():
    for closed, away, seen in ((True, True, False), (True, False, True), (False, True, True)):
        layer = Layer(sheets([0.0], away=away), closed=closed, lit=False)
        assert (middle(shoot([layer], VIEW, SIZE)) < 10).all() == seen


def test_edges_are_smooth_and_places_exact_in_every_size():
    with Stage([Layer(sheets([0.0]), lit=False)]) as stage:
        for size in (SIZE, (121, 83), SIZE):
            picture = stage.shoot(VIEW, size)
            assert picture.pixels.shape == (size[1], size[0], 3)
            assert picture.buffer.shape == (size[1], size[0])
            shares = 1.0 - picture.pixels[..., 0] / 255.0
            side = size[1] / VIEW.height
            assert shares.sum() == pytest.approx(side**2, rel=0.03), "pixels cut are grey in part"
            left, top = picture.place(np.array([0.0, -0.5, 0.5]))[0]
            assert np.argmax(shares.max(axis=0) > 0.5) == pytest.approx(left, abs=1.0)
            assert np.argmax(shares.max(axis=1) > 0.5) == pytest.approx(top, abs=1.0)
            assert picture.shows(np.zeros(3)) and not picture.sees(np.array([-0.1, 0.0, 0.0]))


def test_nothing_is_left_on_the_stage():
    shoot([Layer(sheets([0.0]), lit=False)], VIEW, SIZE)
    assert (shoot([], VIEW, SIZE).pixels == 255).all()


def test_every_thread_has_its_own_window():
    layer = Layer(sheets([0.0]), colour="#3060a0")
    here = shoot([layer], VIEW, SIZE).pixels
    with ThreadPoolExecutor(2) as pool:
        for there in pool.map(lambda _: shoot([layer], VIEW, SIZE).pixels, range(4)):
            assert np.array_equal(here, there)
