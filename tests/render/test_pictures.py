"""Every picture is written, has its size, is not blank, and shows what it should."""

import errno
import sys
import threading
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import imageio.v3 as iio
import numpy as np
import pytest
import xarray as xr
from ring_with_pockets import Z, quadratic

from flexcage import render
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.core.errors import EnvironmentLacks, InputError, RunFailed
from flexcage.geometry.spall import Spall
from flexcage.render import bearing_pictures, damage, sheet
from flexcage.results.registry import VARIABLES
from flexcage.results.slip import BearingNumbers
from flexcage.results.store import RunStore

N1013 = RollerBearing(
    bore=65e-3,
    outside_diameter=100e-3,
    width=18e-3,
    inner_race_diameter=74.5e-3,
    outer_race_diameter=90.5e-3,
    roller_diameter=8e-3,
    roller_length=8e-3,
    effective_length=7.3e-3,
    roller_count=Z,
    rib_diameter=78.4e-3,
    rib_gap=8.03e-3,
)
NUMBERS = BearingNumbers(pitch_diameter=82.5e-3, element_diameter=8e-3, element_count=Z)


@pytest.fixture(scope="module")
def run():
    n = 400
    t = np.arange(n) / 50e3
    names = ["inner_speed", "inner_angle", "inner_position", "element_position", "element_tilt"]
    names += ["cage_position", "cage_quaternion", "cage_omega", "race_force", "pocket_force"]
    names += ["element_omega"]
    store = RunStore.create(
        None,
        coords={"time": t, "element": np.arange(Z), "pocket": np.arange(Z)},
        variables=names,
        n_time=n,
        block=n,
        attrs={"family": "cylindrical_roller", "element": "roller"},
    )
    a = {v: np.zeros(store.layout.shape(VARIABLES[v])) for v in names}
    cage = 2700 * np.pi / 30
    a["inner_speed"][:] = 6000 * np.pi / 30
    a["cage_quaternion"][:, 0] = np.cos(cage * t / 2)
    a["cage_quaternion"][:, 1] = np.sin(cage * t / 2)
    a["cage_omega"][:, 0] = cage
    a["cage_position"][:, 1] = 50e-6 * np.cos(3 * cage * t)
    a["cage_position"][:, 2] = 50e-6 * np.sin(3 * cage * t)
    a["element_position"][:, :, 1] = 41.25e-3
    a["element_position"][:, :, 2] = 2 * np.pi * np.arange(Z) / Z + (cage * t)[:, None]
    a["race_force"][:, :, 0] = 500 * np.clip(-np.cos(a["element_position"][:, :, 2]) - 0.6, 0, None)
    a["race_force"][:, :, 1] = a["race_force"][:, :, 0] + 10
    a["element_omega"][:, :, 0] = -27900 * np.pi / 30
    a["pocket_force"][:, :, 0] = 20 * np.clip(np.sin(900 * t)[:, None] - np.arange(Z) / Z, 0, None)
    store.write_block(0, a)
    return store.dataset()


@pytest.fixture(scope="module")
def field(ring):
    """Nodes, cells, an ovalising displacement, and a stress whose peak is at one outer node."""
    nodes, cells = quadratic(ring.points, ring.tets)
    psi = np.arctan2(nodes[:, 2], nodes[:, 1])
    radial = np.column_stack([0 * psi, np.cos(psi), np.sin(psi)])
    u = 5e-6 * np.cos(2 * psi)[:, None] * radial
    stress = 2e6 * (1.2 + np.cos(2 * psi))
    peak = int(np.argmax(nodes @ [1.0, 1.0, 0.3]))
    stress[peak] = 40e6
    return nodes, cells, u, stress, peak


def check(path: Path, *, least_colours: int = 40) -> np.ndarray:
    pixels = iio.imread(path)[..., :3]
    assert pixels.shape[0] >= 600 and pixels.shape[1] >= 700
    inked = (pixels < 245).any(axis=2)
    assert 0.01 < inked.mean() < 0.9, "neither blank nor full"
    assert not inked[:6].any() and not inked[-4:].any(), "nothing is cut above or below"
    assert not inked[:, :6].any() and not inked[:, -6:].any(), "nothing is cut at the sides"
    assert len(np.unique(pixels.reshape(-1, 3) // 8, axis=0)) > least_colours
    return pixels


def has_colour(pixels: np.ndarray, colour: str, tolerance: int = 12) -> bool:
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
    return bool((np.abs(pixels.astype(int) - rgb).max(axis=2) < tolerance).any())


def test_stress(field, canvas, tmp_path):
    nodes, cells, u, stress, peak = field
    path = render.stress_picture(
        nodes, cells, u, stress, tmp_path / "new" / "s.png", time=1e-3, pocket_count=Z
    )
    assert path == tmp_path / "new" / "s.png"
    pixels = check(path)
    assert pixels.shape == (1012, 1802, 3)
    spot = pixels[:, :1200].astype(int)
    reddish = (spot[..., 0] > 150) & (spot[..., 1] < 110) & (spot[..., 2] < 60)
    assert reddish.any(), "values over the range have their own colour on the cage"


def test_the_middles_of_edges_are_drawn_and_do_not_set_the_colours(field, canvas, tmp_path):
    """A stress that is nothing in the middles of edges: the picture of quadratic cells shows it,
    with the same colours as one that has vertices alone."""
    nodes, cells, u, stress, peak = field
    n = int(cells[:, :4].max()) + 1
    bent = np.concatenate([stress[:n], np.zeros(len(stress) - n)])
    bent[peak] = 40e6 if peak < n else 0.0
    shown = {}
    for name, (points, tets) in (("full", (nodes, cells)), ("plain", (nodes[:n], cells[:, :4]))):
        size = len(points)
        path = render.stress_picture(
            points, tets, 0 * u[:size], bent[:size], tmp_path / f"{name}.png"
        )
        shown[name] = iio.imread(path)[100:980, 40:1200, :3].astype(int)
    dark = {k: (np.abs(v - [68, 1, 84]).max(axis=2) < 60).mean() for k, v in shown.items()}
    assert dark["full"] > 2.0 * dark["plain"]


def test_a_fixed_range_and_an_undeformed_envelope(field, canvas, tmp_path):
    nodes, cells, _, stress, peak = field
    path = render.envelope_picture(
        nodes, cells, stress, tmp_path / "e.png", span=(0, 0.1), peak_node=peak, limit=50e6
    )
    assert not has_colour(check(path), sheet.VERMILION, 6)


def test_deformation_of_linear_tets(ring, canvas, tmp_path):
    u = 1e-6 * np.cos(ring.points[:, :1] * 300) * [[1.0, 0.0, 0.0]]
    check(render.deformation_picture(ring.points, ring.tets, u, tmp_path / "d.png", scale=500))


def test_a_wrong_field_is_refused(ring, tmp_path):
    with pytest.raises(InputError, match="one displacement and one value per node"):
        render.stress_picture(
            ring.points, ring.tets, ring.points[:-1], ring.points[:, 0], tmp_path / "x.png"
        )


def test_mesh_with_defects(ring, canvas, tmp_path):
    defects = (
        CrossbeamDefect(crossbeam=2, displacement=0.2e-3),
        SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3),
    )
    pixels = check(render.mesh_picture(ring, tmp_path / "m.png", defects=defects))
    assert has_colour(pixels, sheet.VERMILION) and has_colour(pixels, sheet.BLUE)
    sound = check(render.mesh_picture(ring, tmp_path / "m0.png"), least_colours=20)
    assert not has_colour(sound, sheet.VERMILION) and not has_colour(sound, sheet.BLUE)


def test_mode_sheet(ring, canvas, tmp_path):
    psi = np.arctan2(ring.points[:, 2], ring.points[:, 1])
    radial = np.column_stack([0 * psi, np.cos(psi), np.sin(psi)])
    shapes = np.stack([np.cos(n * psi)[:, None] * radial for n in range(2, 7)], axis=2)
    path = render.mode_sheet(
        ring.points, ring.tets, shapes, np.arange(5) * 1e3 + 860, ["free"] * 5, tmp_path / "s.png"
    )
    check(path)


def test_bearing(run, ring, canvas, tmp_path):
    path = render.bearing_picture(
        run,
        N1013,
        -1,
        tmp_path / "b.png",
        cage_points=ring.points,
        cage_tets=ring.tets,
        load=(-1000.0, 0.0),
    )
    check(path)
    with pytest.raises(InputError, match="no sample 400"):
        render.bearing_picture(run, N1013, 400, tmp_path / "x.png")


def test_spalls_are_where_their_races_are(run):
    """Seen along the axis, an arc lies on its race's radius; that of the inner race has turned
    with its ring."""
    import matplotlib.pyplot as plt

    spalls = {"inner_spall": Spall(length=3e-3, azimuth=0.2), "outer_spall": Spall(length=2e-3)}
    spalled, figure = replace(N1013, **spalls), plt.figure()
    seen = SimpleNamespace(place=lambda points: np.atleast_2d(points)[:, 1:])
    now = replace(bearing_pictures.instant(run, 0), inner_angle=1.1)
    damage.mark_spalls(axes := figure.gca(), seen, now, spalled)
    inner, outer = (line.get_xydata() for line in axes.lines)
    for arc, middle, radius, half in (
        (inner, 1.3, 37.25e-3, 1.5e-3 / 37.25e-3), (outer, 0.0, 45.25e-3, 1e-3 / 45.25e-3),
    ):  # fmt: skip
        np.testing.assert_allclose(np.hypot(*arc.T), radius, rtol=1e-9)
        angle = np.arctan2(arc[:, 1], arc[:, 0])
        np.testing.assert_allclose([angle.min(), angle.max()], [middle - half, middle + half])
    assert [text.get_text() for text in axes.texts] == ["spall", "spall"]
    damage.mark_spalls(bare := plt.figure().gca(), seen, now, N1013)
    assert not bare.lines and not bare.texts
    plt.close("all")


def test_spots_are_on_their_elements(run):
    """Seen along the axis, an arc lies on its roller's circle, in the spot's direction."""
    import matplotlib.pyplot as plt

    seen = SimpleNamespace(place=lambda points: np.atleast_2d(points)[:, 1:], sees=lambda at: True)
    hidden = SimpleNamespace(place=seen.place, sees=lambda at: False)
    spotted = replace(N1013, roller_spot=RollerSpot(size=3.2e-3, kind="flat", roller=5))
    turned, half = 0.7, 0.4  # of a roller with a radius of 4 mm
    spots = {5: np.array([0.0, np.cos(turned), np.sin(turned)])}
    now = replace(bearing_pictures.instant(run, 0), spots=spots)
    damage.mark_spots(axes := plt.figure().gca(), seen, now, spotted)
    (arc,) = axes.lines
    psi = 2.0 * np.pi * 5 / Z
    own = arc.get_xydata() - 41.25e-3 * np.array([np.cos(psi), np.sin(psi)])
    np.testing.assert_allclose(np.hypot(*own.T), 4e-3, rtol=1e-9)
    angle = np.arctan2(own[:, 1], own[:, 0])
    np.testing.assert_allclose([angle.min(), angle.max()], [turned - half, turned + half])
    assert [text.get_text() for text in axes.texts] == ["flat"] and arc.get_linestyle() == "-"
    damage.mark_spots(axes := plt.figure().gca(), hidden, now, spotted)
    assert axes.lines[0].get_linestyle() != "-"
    damage.mark_spots(bare := plt.figure().gca(), seen, bearing_pictures.instant(run, 0), N1013)
    assert not bare.lines and not bare.texts
    plt.close("all")


def test_curves_need_no_window(run, tmp_path):
    stress = xr.DataArray(
        run["pocket_force"].isel(face=0).values * 3e5,
        dims=("time", "place"),
        coords={"time": run["time"], "place": [f"pocket {k}" for k in range(Z)]},
    )
    check(render.orbit(run, tmp_path / "o.png", clearance=250e-6, guide="inner"))
    check(render.orbit(run, tmp_path / "o1.png", clearance=60e-6, settle=0.2))
    check(
        render.histories(run, tmp_path / "h.png", bearing=NUMBERS, root_stress=stress, settle=0.3)
    )
    check(render.histories(run, tmp_path / "h1.png"), least_colours=20)
    check(render.compare_forces({"rigid": run, "flexible": run}, tmp_path / "c.png"))


def test_an_orbit_outside_the_clearance_says_why(run, tmp_path, monkeypatch):
    """It goes round at 50 um, about the outer ring's centre."""
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    flexible = run.assign(modal_coordinates=("time", np.zeros(run.sizes["time"])))
    for ds, clearance in ((run, 60e-6), (flexible, 60e-6), (run, 40e-6), (flexible, 40e-6)):
        render.orbit(ds, tmp_path / "o.png", clearance=clearance)
    said = [[t.get_text() for t in f.texts if "beyond the circle" in t.get_text()] for f in shown]
    assert said[:2] == [[], []]
    (rigid,), (bent,) = said[2:]
    assert rigid.startswith("The orbit reaches 10 µm beyond") and "guiding ring moves" in rigid
    assert bent.startswith("The orbit reaches 10 µm beyond") and "flexible, and bends" in bent


def test_forces_compared_show_the_whole_range_of_both_runs(run, tmp_path, monkeypatch):
    """Whichever comes first, no axis ends at the smaller run's peak."""
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    weak = run.assign(pocket_force=0.1 * run["pocket_force"])
    for runs in ({"a": run, "b": weak}, {"a": weak, "b": run}):
        render.compare_forces(runs, tmp_path / "c.png", settle=0.0)
    largest = float(run["pocket_force"].max())
    for figure in shown:
        history, often, pockets = figure.axes
        assert often.get_xlim()[1] >= largest
        assert history.get_ylim()[1] >= largest and pockets.get_ylim()[1] >= largest


def test_the_highest_place_is_that_of_the_settled_part(run, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    values = np.ones((run.sizes["time"], 3))
    values[0, 2], values[-1, 1] = 9.0, 5.0  # the start's highest, and the one after
    stress = xr.DataArray(
        values, dims=("time", "place"), coords={"time": run["time"], "place": ["a", "b", "c"]}
    )
    for settle, label in ((0.3, "highest once settled: b"), (0.0, "highest: c")):
        render.histories(run, tmp_path / "h.png", root_stress=stress, settle=settle)
        assert [line.get_label() for line in shown[-1].axes[2].lines] == [label]


def test_an_empty_plot_says_why_and_has_no_line_in_its_legend(run, tmp_path, monkeypatch):
    """No pocket is touched: no scale of hundredths of a newton; no roller is loaded: no such line.
    Places are named in words."""
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    free = run.copy(deep=True)
    free["pocket_force"] = 0.0 * run["pocket_force"]
    free["race_force"] = 0.0 * run["race_force"]
    stress = xr.DataArray(
        np.ones((run.sizes["time"], 1)), dims=("time", "place"),
        coords={"time": run["time"], "place": ["pocket3_root_rear-x"]},
    )  # fmt: skip
    render.histories(free, tmp_path / "h.png", bearing=NUMBERS, root_stress=stress)
    _, pockets, corners, spin = shown[-1].axes
    assert [text.get_text() for text in pockets.texts] == ["no pocket is touched"]
    assert pockets.get_yticks().tolist() == [0.0]
    names = [text.get_text() for text in spin.get_legend().get_texts()]
    assert names == ["all", "roller 0", "pure rolling"]
    names = [text.get_text() for text in corners.get_legend().get_texts()]
    assert names == ["all places", "highest: pocket 3, corner rear -x"]
    render.histories(run, tmp_path / "h.png", bearing=NUMBERS)
    assert not shown[-1].axes[1].texts


def test_the_circle_of_a_land_is_about_its_ring(run):
    from flexcage.render.curves import land_circle

    moved = run.copy(deep=True)
    moved["inner_position"][:, 1:] = [20e-6, -5e-6]
    assert land_circle(moved, 0.1e-3, "inner") == pytest.approx((20.0, -5.0, 100.0))
    assert land_circle(moved, 0.1e-3, "outer") == pytest.approx((0.0, 0.0, 100.0))
    assert land_circle(moved, None, "inner") is None


def test_a_roller_locked_in_its_pocket_is_drawn_below_zero(run, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    locked = run.copy(deep=True)
    locked["element_omega"][:, 2, 0] = locked["cage_omega"].sel(axis="x").values
    for sense in (1.0, -1.0):
        turned = locked.copy(deep=True)
        for name in ("inner_speed", "element_omega", "cage_omega"):
            turned[name] = sense * locked[name]
        render.histories(turned, tmp_path / "h.png", bearing=NUMBERS, element=2)
        lines = {line.get_label(): line.get_ydata() for line in shown[-1].axes[-1].lines}
        assert np.allclose(lines["roller 2"], -2700.0)
        assert np.allclose(lines["pure rolling"], 27937.5)


def test_labels_of_histories_stand_clear_of_five_digit_ticks(run, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(sheet, "save", lambda figure, path: shown.append(figure))
    render.histories(run, tmp_path / "h.png", bearing=NUMBERS)
    (figure,) = shown
    figure.canvas.draw()
    ticks = figure.axes[-1].yaxis.get_ticklabels()
    assert max(len(tick.get_text()) for tick in ticks) == 5
    for ax in figure.axes:
        label = ax.yaxis.label.get_window_extent()
        assert label.x0 > 0.0
        for tick in ax.yaxis.get_ticklabels():
            assert tick.get_window_extent().x0 - label.x1 > 4.0, tick.get_text()


def test_animations(run, field, canvas, tmp_path):
    nodes, cells, u, stress, _ = field
    path = render.animate_stress(
        nodes,
        cells,
        [0 * u, u, -u],
        [0 * stress, stress, stress],
        [0, 1e-4, 2e-4],
        tmp_path / "s.gif",
    )
    frames = iio.imread(path)
    assert len(frames) == 3 and np.abs(frames[0].astype(int) - frames[1]).max() > 100
    path = render.animate_bearing(run, N1013, tmp_path / "b.gif", frames=3)
    assert len(iio.imread(path)) == 3


def test_animation_formats(tmp_path, monkeypatch):
    frames = [np.zeros((10, 10, 3), np.uint8)]
    with pytest.raises(InputError, match=r"\.gif or \.mp4"):
        render.write_animation(frames, tmp_path / "a.avi")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(EnvironmentLacks, match="imageio-ffmpeg"):
        render.write_animation(frames, tmp_path / "a.mp4")


def test_no_backend_is_a_sentence(field, tmp_path, monkeypatch):
    from flexcage.core import environment
    from flexcage.render import stage

    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(environment, "offscreen_backend", lambda: None)
    monkeypatch.setattr(stage, "_OF_THREAD", threading.local())
    nodes, cells, u, stress, _ = field
    with pytest.raises(EnvironmentLacks, match="apt-get install"):
        render.stress_picture(nodes, cells, u, stress, tmp_path / "x.png")


def test_a_full_disk_is_no_mistake_in_the_input(run, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr("flexcage.core.writing.os.replace", full)
        with pytest.raises(RunFailed, match=r"picture .*h.png' cannot be written: the disk is"):
            render.histories(run, tmp_path / "h.png")
    assert not list(tmp_path.iterdir())
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        render.histories(run, tmp_path / "file" / "h.png")


def test_importing_render_loads_nothing_heavy():
    import subprocess

    code = (
        "import flexcage.render, sys; "
        "print([m for m in ('matplotlib', 'pyvista', 'xarray', 'vtkmodules') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("value", "up", "down"),
    [(4.02, 4.5, 2.0), (6.5, 7.0, 5.0), (0.011, 0.012, 0.01), (1e3, 1e3, 1e3)],
)
def test_round_figures(value, up, down):
    assert sheet.rounded_up(value) == pytest.approx(up)
    assert sheet.rounded_down(value) == pytest.approx(down)
