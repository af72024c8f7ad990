"""The album of a run: what its pictures are given, so that those of two runs lie side by side."""

from __future__ import annotations

import inspect
from dataclasses import replace
from importlib import import_module
from math import pi
from types import SimpleNamespace

import numpy as np
import pytest
from test_pictures import N1013, run

from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.cages.window.places import WINDOW_PLACES
from flexcage.core.errors import InputError
from flexcage.render.album import Scene, StressPictures, check_names, draw_album, picture_names
from flexcage.render.look import Look

__all__ = ["run"]  # a fixture
PICTURES = {
    "mesh_pictures": ["mesh_picture"],
    "mode_pictures": ["mode_sheet"],
    "bearing_pictures": ["bearing_picture"],
    "curves": ["orbit", "histories"],
    "stress_pictures": ["stress_picture", "envelope_picture", "deformation_picture"],
    "pocket_pictures": ["pocket_picture"],
    "spectra": ["spectra_picture"],
    "animations": ["animate_bearing", "animate_stress"],
}
OF_CAGE = ("stress_picture", "envelope_picture", "deformation_picture", "animate_stress")


@pytest.fixture
def drawn(monkeypatch):
    """What every picture was given, by its name; nothing is drawn."""
    seen = {}

    def instead(name, function):
        def draw(*args, **options):
            seen[name] = inspect.signature(function).bind(*args, **options).arguments

        return draw

    for room, names in PICTURES.items():
        module = import_module(f"flexcage.render.{room}")
        for name in names:
            monkeypatch.setattr(module, name, instead(name, getattr(module, name)))
    return seen


def scene(run, ring, peak: int) -> Scene:
    """A run whose stress has its peak at the mesh's vertex ``peak``; root 1 bears most."""
    n, points = run.sizes["time"], ring.points
    stress = np.ones(len(points))
    stress[peak] = 3e7
    roots = np.abs(np.sin(np.arange(n)[:, None] * 1e-2)) * [3e6, 8e6, 1e6]
    pictures = StressPictures(
        nodes=points, cells=ring.tets, time=0.001, displacement=np.zeros_like(points),
        basis=SimpleNamespace(shapes=None, frequencies=None, kind=None),
        von_mises=stress, envelope=stress, peak_vertex=peak, peak_place="", settled=n // 3,
        roots=roots, root_names=["a", "b", "c"], root_kind=WINDOW_PLACES.kind,
        frames=[(0.001, np.zeros_like(points), stress)],
    )  # fmt: skip
    return Scene(
        name="n", dataset=run, bearing=N1013, mesh=ring, clearance=None, guide="inner",
        loads=np.tile([0.0, 1e3, 0.0], (n, 1)), settle=0.3, stress=pictures,
        defects=[CrossbeamDefect(crossbeam=5, displacement=1e-4)],
    )  # fmt: skip


@pytest.mark.parametrize("stressed", [True, False])
def test_only_the_pictures_that_are_named(run, ring, drawn, tmp_path, stressed):
    whole = scene(run, ring, 0)
    whole = whole if stressed else replace(whole, stress=None)
    draw_album(whole, tmp_path, only=["orbit", "mesh"], format="svg")
    assert {name: given["path"].name for name, given in drawn.items()} == {
        "mesh_picture": "mesh.png", "orbit": "orbit.svg"
    }  # fmt: skip
    draw_album(whole, tmp_path, format="pdf")
    files = {given["path"].name for given in drawn.values()}
    resolved = "spectra_picture" in drawn
    curves = {"orbit", "histories", *(["spectra"] if resolved else [])}
    names = picture_names(flexible=stressed, resolved=resolved)
    assert files == {f"{name}.{'pdf' if name in curves else 'png'}" for name in names}


def test_cameras_do_not_follow_the_peak(run, ring, drawn, tmp_path):
    near, far = int(ring.points[:, 1].argmax()), int(ring.points[:, 1].argmin())
    for peak in (near, far):
        draw_album(scene(run, ring, peak), tmp_path, animate=True)
        assert [drawn[name]["azimuth"] for name in OF_CAGE] == [0.0] * 4
        assert drawn["stress_picture"]["peak_node"] == peak  # where the close-up looks
        assert drawn["mesh_picture"]["azimuth"] is None  # turns to the defect


def test_every_picture_names_its_case(run, ring, drawn, tmp_path, monkeypatch):
    monkeypatch.setattr("flexcage.results.spectra.resolves", lambda *_: True)
    names = [name for room in PICTURES.values() for name in room]
    for name, shown in (
        ("my case", "my case"), ("a $x_1\n$ case", r"a \$x_1 \$ case"),
        ("x" * 50 + "y" * 49, "x" * 29 + "…" + "y" * 30),
    ):  # fmt: skip
        draw_album(replace(scene(run, ring, 0), name=name), tmp_path, animate=True)
        assert {name: given["note"] for name, given in drawn.items()} == dict.fromkeys(names, shown)


def test_what_is_drawn_has_the_middles_of_edges(run, ring, drawn, tmp_path):
    """Stress and displacement go to the pictures at all nodes, with the quadratic cells."""
    shown = scene(run, ring, 0)
    draw_album(shown, tmp_path, animate=True)
    for name in OF_CAGE:
        assert drawn[name]["points"] is shown.stress.nodes
        assert drawn[name]["tets"] is shown.stress.cells


def test_the_load_is_that_of_the_instant(run, ring, drawn, tmp_path):
    ramp = np.outer(run["time"].values, [3.0, 4.0, 5.0]) * 1e3
    draw_album(replace(scene(run, ring, 0), loads=ramp), tmp_path)
    given = drawn["bearing_picture"]
    at = float(run["time"][given["index"]]) * 1e3
    assert at == pytest.approx(1.0, abs=0.1)  # where the stress has its peak
    assert (given["axial"], *given["load"]) == pytest.approx((3.0 * at, 4.0 * at, 5.0 * at))


def test_a_look_holds_for_all_pictures_of_the_cage(run, ring, drawn, tmp_path):
    look = Look(view=pi / 3, stress_limit=25e6, scale=50.0)
    draw_album(scene(run, ring, 0), tmp_path, animate=True, look=look)
    assert all(drawn[name]["azimuth"] == pi / 3 for name in (*OF_CAGE, "mesh_picture"))
    limited = ("stress_picture", "envelope_picture", "animate_stress")
    assert all(drawn[name]["limit"] == 25e6 for name in limited)
    moved = ("stress_picture", "deformation_picture", "animate_stress")
    assert all(drawn[name]["scale"] == 50.0 for name in moved)
    assert "limit" not in drawn["deformation_picture"]


def test_histories_are_given_the_stress_of_all_places(run, ring, drawn, tmp_path):
    shown = scene(run, ring, 0)
    draw_album(shown, tmp_path)
    root = drawn["histories"]["root_stress"]
    assert list(root["place"].values) == ["a", "b", "c"]
    assert np.array_equal(root.values, shown.stress.roots)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"view": 7.0}, "view is 401.07 deg, but must be 360 deg or less"),
        ({"view": "120 deg"}, "view is '120 deg', but should be a number in SI"),
        ({"stress_limit": 0.0}, "stress_limit is 0 MPa, but must be greater than 0 MPa"),
        ({"scale": float("nan")}, "scale is nan, but must be a number"),
    ],
)
def test_a_look_that_cannot_be(wrong, words):
    with pytest.raises(InputError, match=words):
        Look(**wrong)


def test_several_pictures_in_one_word_are_told():
    with pytest.raises(InputError, match="name each by itself: orbit mesh; its pictures are"):
        check_names(["orbit,mesh"], ["orbit", "mesh", "spectra"])


def test_animations_are_drawn_beside_the_pictures_that_are_named(monkeypatch, tmp_path):
    """--animate with --only drew no animation, and said nothing."""
    from flexcage.render import album

    def drawing(name, ending):
        def draw(path):
            path.touch()
            return path

        return album.Drawing(name, ending, draw)

    for part, found in (
        ("_geometry", [drawing("mesh", "png")]),
        ("_motion", []),
        ("_orbits", [drawing("orbit", "png")]),
        ("_animations", [drawing("bearing", "gif")]),
    ):
        monkeypatch.setattr(album, part, lambda *_, found=found: found)
    scene = SimpleNamespace(stress=None, rows=())
    drawn = draw_album(scene, tmp_path, animate=True, only=["orbit"])
    assert [path.name for path in drawn] == ["orbit.png", "bearing.gif"]
