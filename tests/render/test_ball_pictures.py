"""Pictures of ball bearing runs: written, not blank, and labelled for balls, never for rollers."""

from __future__ import annotations

from math import hypot

import imageio.v3 as iio
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text
from test_pictures import check, has_colour

from flexcage import render
from flexcage.bearings.ball import slip as ball_slip
from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.defects import (
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import Bearing
from flexcage.mesh.options import MeshOptions
from flexcage.render import sheet
from flexcage.render.shapes import shapes_of
from flexcage.render.solids import revolved
from flexcage.results.registry import VARIABLES
from flexcage.results.slip import BearingNumbers, element_spin
from flexcage.results.store import RunStore

PRESET = load_preset("7010C-PI")
BEARING, CAGE = PRESET.bearing, PRESET.cage
Z, PITCH = BEARING.ball_count, BEARING.pitch_diameter
NUMBERS = BearingNumbers(
    pitch_diameter=PITCH, element_diameter=BEARING.ball_diameter, element_count=Z,
    contact_angle=BEARING.nominal_contact_angle,
)  # fmt: skip


@pytest.fixture(scope="module")
def run():
    """4 ms at 4000 rpm; ball 3 bears most, and ball 9 leaves the inner race for a while."""
    n = 200
    t = np.arange(n) / 50e3
    names = ["inner_speed", "inner_position", "element_position", "element_omega", "race_force"]
    names += ["inner_angle"]
    names += ["contact_angle", "race_slip", "cage_position", "cage_quaternion", "cage_omega"]
    names += ["pocket_force"]
    store = RunStore.create(
        None,
        coords={"time": t, "element": np.arange(Z), "pocket": np.arange(Z), "face": ["pocket"]},
        variables=names, n_time=n, block=n, attrs={"family": "ball", "element": "ball"},
    )  # fmt: skip
    a = {v: np.zeros(store.layout.shape(VARIABLES[v])) for v in names}
    inner = 4000 * np.pi / 30
    ideal = NUMBERS.kinematics(inner)
    a["inner_speed"][:] = inner
    a["cage_quaternion"][:, 0] = np.cos(ideal.cage_speed * t / 2)
    a["cage_quaternion"][:, 1] = np.sin(ideal.cage_speed * t / 2)
    a["cage_omega"][:, 0] = ideal.cage_speed
    a["cage_position"][:, 1] = 50e-6 * np.cos(ideal.cage_speed * t)
    a["element_position"][:, :, 1] = 0.5 * PITCH
    a["element_position"][:, :, 2] = 2 * np.pi * np.arange(Z) / Z + (ideal.cage_speed * t)[:, None]
    a["element_omega"][:, :, 0] = ideal.cage_speed + ideal.element_spin_in_cage
    a["race_force"][:] = 12.0
    a["race_force"][:, 3] = 25.0
    a["race_force"][80:120, 9, 0] = 0.0
    a["contact_angle"][:, :, 0], a["contact_angle"][:, :, 1] = 0.30, 0.25
    a["contact_angle"][80:120, 9, 0] = 9.0  # means nothing without contact
    a["race_slip"][:] = 0.01 * np.sin(2e3 * t)[:, None, None]
    a["pocket_force"][:, 5, 0] = 3.0 * np.clip(np.sin(2e3 * t), 0.0, None)
    store.write_block(0, a)
    return store.dataset()


@pytest.fixture
def texts(monkeypatch):
    """All texts of the figures that are saved."""
    found: list[str] = []
    save = sheet.save

    def listen(figure, path):
        found.extend(t.get_text() for t in figure.findobj(Text) if t.get_visible())
        return save(figure, path)

    monkeypatch.setattr(sheet, "save", listen)
    return found


def about_balls(texts: list[str], *wanted: str) -> None:
    everything = "\n".join(texts)
    assert "roller" not in everything.lower()
    for words in wanted:
        assert words in everything, words


def test_the_bearing_with_its_balls(run, texts, canvas, tmp_path):
    mesh = build_cage_mesh(CAGE, pocket_count=Z, pitch_diameter=PITCH, options=COARSE)
    path = render.bearing_picture(
        run, BEARING, 100, tmp_path / "b.png", cage_points=mesh.points, cage_tets=mesh.tets,
        load=(50.0, 0.0), axial=100.0,
    )  # fmt: skip
    pixels = check(path)
    assert has_colour(pixels[:, :1100], "#c4c8ce"), "the ball without load is grey"
    about_balls(
        texts, "The bearing, balls coloured by load", "most loaded: ball 3, 25 N", "radial 50 N",
        "axial load +100 N", "normal force of the inner race on a ball [N]", "pocket wall",
    )  # fmt: skip


COARSE = MeshOptions(fineness="coarse")


def test_grooves_are_arcs_between_their_shoulders():
    shapes = shapes_of(BEARING)
    inner, outer = shapes.inner, shapes.outer
    radii = (BEARING.inner_groove_radius, BEARING.outer_groove_radius)
    centres = (BEARING.inner_groove_centre, BEARING.outer_groove_centre)
    arcs = (inner[2:-1], outer[1:-2])
    for arc, radius, (x, r) in zip(arcs, radii, centres):
        assert [hypot(px - x, pr - r) for px, pr in arc] == pytest.approx([radius] * len(arc))
        assert max(px for px, _ in arc) == 0.0
    assert arcs[0][-1][1] == pytest.approx(0.5 * BEARING.shoulder_diameters[0])
    assert arcs[1][0][1] == pytest.approx(0.5 * BEARING.shoulder_diameters[1])


def test_a_ball_is_a_sphere(canvas):
    ball = revolved(shapes_of(BEARING).element, segments=48)
    assert np.linalg.norm(ball.points, axis=1) == pytest.approx(0.5 * BEARING.ball_diameter)
    exact = np.pi / 6 * BEARING.ball_diameter**3
    assert ball.triangulate().volume == pytest.approx(exact, rel=0.02)


def test_a_bearing_of_no_family_has_no_picture():
    with pytest.raises(InputError, match="There is no picture of a Bearing"):
        shapes_of(Bearing())


def test_histories_show_balls_slip_and_contact_angles(run, texts, tmp_path):
    plain = check(render.histories(run, tmp_path / "h.png", bearing=NUMBERS, element=9))
    about_balls(
        texts, "Ball speed about its own axis, cage frame", "ball 9 in the loaded zone",
        "pure rolling", "Sliding speed at the races", "Contact angles", "inner race, all",
        "outer race, ball 9", "angle [°]", "speed [m/s]", "pocket wall",
    )  # fmt: skip
    assert plain.shape[0] > 1500, "five panels"
    with pytest.raises(InputError, match="no ball 18"):
        render.histories(run, tmp_path / "x.png", element=Z)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_ball_that_turns_backwards_has_a_negative_speed(run, sense):
    rolling = abs(NUMBERS.kinematics(4000 * np.pi / 30).element_spin_in_cage)
    ds = run.copy(deep=True)
    ds["element_omega"][:, 5, 0] = 2.0 * ds["cage_omega"][:, 0] - ds["element_omega"][:, 5, 0]
    for name in ("inner_speed", "element_omega", "cage_omega"):
        ds[name] = sense * ds[name]
    spin = element_spin(ds)
    assert np.allclose(spin[:, 5], -rolling) and np.allclose(spin[:, 4], rolling)
    assert np.allclose(ball_slip.slip_ratio(ds, NUMBERS, nominal=True)[:, 5], 2.0)


def test_angles_count_only_where_balls_touch(run, monkeypatch, tmp_path):
    from flexcage.render import curves

    limits = []
    save = sheet.save
    monkeypatch.setattr(
        curves.sheet, "save", lambda f, p: (limits.append(f.axes[-1].get_ylim()), save(f, p))[1]
    )
    render.histories(run, tmp_path / "h.png")
    assert limits[0][1] < 20.0, "degrees; 9 rad of a ball in the air is not shown"


def test_histories_show_a_speed_and_a_load_that_change(run, texts, tmp_path):
    def shown(ds, loads):
        texts.clear()
        render.histories(ds, tmp_path / "h.png", loads=loads)
        return [t for t in texts if t in ("Inner ring", "radial load [N], right",
                                          "axial load [N], right")]  # fmt: skip

    n = run.sizes["time"]
    steady, growing = np.tile([100.0, 30.0, 40.0], (n, 1)), np.zeros((n, 3))
    growing[:, 0] = np.linspace(100.0, 200.0, n)
    assert not shown(run, steady) and not shown(run, None)
    assert shown(run, growing) == ["Inner ring", "axial load [N], right"]
    faster = run.assign(inner_speed=run["inner_speed"] * xr.DataArray(
        np.linspace(1.0, 1.5, n), dims="time"))  # fmt: skip
    both = ["Inner ring", "radial load [N], right", "axial load [N], right"]
    assert shown(faster, steady) == both and shown(faster, None) == ["Inner ring"]


def test_orbit_and_comparison(run, texts, tmp_path):
    check(render.orbit(run, tmp_path / "o.png", clearance=None, settle=0.2))
    check(render.compare_forces({"rigid": run, "flexible": run}, tmp_path / "c.png"))
    about_balls(texts, "y [µm]", "Largest pocket force")


def test_the_bearing_moves(run, canvas, tmp_path):
    frames = iio.imread(render.animate_bearing(run, BEARING, tmp_path / "b.gif", frames=2))
    assert len(frames) == 2 and np.abs(frames[0].astype(int) - frames[1]).max() > 100


@pytest.mark.parametrize(
    ("defects", "colours", "words"),
    [
        ((), (), ("edge of pocket 0",)),
        (
            (
                EnlargedPocket(pocket=3, increase=-0.2e-3),
                ElongatedPocket(pocket=6, direction="axial", elongation=1e-3),
            ),
            (sheet.VERMILION, sheet.BLUE),
            ("pocket 3 made smaller, diameter −0.2 mm", "pocket 6 elongated, axial +1 mm",
             "pocket made smaller", "pocket made larger", "rim without the defect"),
        ),
        (
            (
                DisplacedPocket(pocket=0, circumferential=0.2e-3),
                WebCrack(web=0, side="-x", share=0.4),
            ),
            (sheet.PURPLE, sheet.VERMILION),
            ("pocket 0 displaced, +0.2 mm along ψ", "crack through the whole wall",
             "web 0 cracked from the end −x, 40 % of the width", "arrow: way of the pocket"),
        ),
    ],
)  # fmt: skip
def test_meshes_with_their_defects(defects, colours, words, texts, canvas, tmp_path):
    mesh = build_cage_mesh(
        CAGE, pocket_count=Z, pitch_diameter=PITCH, defects=defects, options=COARSE
    )
    pixels = check(render.mesh_picture(mesh, tmp_path / "m.png", defects=defects), least_colours=20)
    about_balls(texts, *words)
    for colour in (sheet.VERMILION, sheet.BLUE, sheet.PURPLE):
        assert has_colour(pixels, colour) == (colour in colours)
