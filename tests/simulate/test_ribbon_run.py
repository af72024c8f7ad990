"""Runs of a deep groove bearing with a riveted ribbon cage."""

import numpy as np
import pytest
from PIL import Image

from flexcage.case import load_case
from flexcage.core.environment import offscreen_backend
from flexcage.core.errors import InputError
from flexcage.render.mesh_pictures import mesh_picture
from flexcage.results.audit import energy_audit
from flexcage.simulate import load_run, simulate
from flexcage.stress.rivets import Joints

BASE = {
    "bearing": {"preset": "15x37x10"},
    "mesh": {"fineness": "coarse"},
    "drive": {"speed": "9000 rpm"},
    "load": {"axial": "20 N", "moment_z": "8.25 N*m", "tilt": "free"},
    "solver": {"duration": "8 ms"},
}
RIGID = {"cage.model": "rigid"}
RIVET = [{"type": "missing_rivet", "web": 2}]


def ribbon(*tables, **more):
    return load_case(BASE | more, overrides={k: v for t in tables for k, v in t.items()})


@pytest.fixture(scope="module")
def flexible(tmp_path_factory):
    return simulate(ribbon(defects=RIVET), out=tmp_path_factory.mktemp("ribbon"))


def test_the_moment_tilts_the_ring_and_balls_meet_their_pockets(flexible):
    """As far as its static solution, and a little more: rings turn by finite angles."""
    s = flexible.summary
    assert s["inner_tilt"] == pytest.approx(8.65e-3, rel=0.03)
    assert s["energy_audit"] == "passed" and s["pocket_force_peak"] > 1.0
    ds = flexible.dataset
    for name, values in ds.data_vars.items():
        assert np.isfinite(values.values).all(), name


def test_balls_stay_within_their_pockets(flexible):
    """No ball goes deeper into its wall than contacts do: 5 um."""
    ds, cage = flexible.dataset, flexible.case.cage
    balls = ds["element_position"].values
    touched = ds["pocket_force"].sel(face="pocket").values > 0.0
    assert touched.any()
    away = np.hypot(balls[..., 0] - ds["cage_position"].values[:, None, 0], balls[..., 1] - 13e-3)
    assert away.max() < 0.5 * (cage.pocket_diameter - 6.47e-3) + 0.3e-3


def test_a_cage_begins_as_its_rotation_strains_it(flexible):
    """Before the first ball touches it, its modes hardly move: from rest they would ring by as much
    as the rotation displaces them."""
    ds = flexible.dataset
    first = int(np.argmax(ds["pocket_force"].values.max(axis=(1, 2)) > 0.0))
    modes = ds["modal_coordinates"].values[:first]
    strained = np.abs(modes).max(axis=0)
    largest = strained.argmax()
    assert first > 20 and np.ptp(modes[:, largest]) < 0.02 * strained[largest]


def test_a_tight_pocket_does_not_burst_at_the_start():
    """Balls that the moment displaced overlap their pockets; rotation alone strains the cage."""
    tight = {"cage.pocket_diameter": "6.6 mm", "solver.duration": "0.2 ms"}
    assert simulate(ribbon(tight)).dataset["pocket_peak"].values[0].max() < 60.0


def test_a_centred_ball_does_not_touch_a_narrow_pocket():
    narrow = {"cage.pocket_diameter": "6.474 mm", "load.moment_z": "0 N*m", "cage.model": "rigid",
              "solver.duration": "0.1 ms", "load.axial": "20 N"}  # fmt: skip
    assert simulate(ribbon(narrow)).dataset["pocket_force"].values[0].max() < 1.0


def test_a_stored_run_is_drawn_and_recovered(flexible, tmp_path):
    run = load_run(flexible.folder)
    field = run.stress()
    peak = run.summary["stress_peak"]
    assert field.von_mises.max() >= 0.999 * peak > 50e6
    assert run.stress_history.places.shape[1] == 7 * 4


def test_rivets_bear_what_the_full_mesh_gives(flexible):
    """Superposed, at an instant with contact, against the displacement of the whole mesh there; and
    a summary whose largest values come from between samples, too."""
    ds, s = flexible.rivets.dataset, flexible.summary
    assert list(ds["rivet"].values) == [0, 1, 3, 4, 5, 6]
    busy = int(flexible.dataset["pocket_force"].sum(("pocket", "face")).values.argmax())
    field = flexible.stress(time=float(ds["time"][busy]))
    joints = Joints(flexible.recovery.model, 7, 13e-3)(field.displacement[:, :, None])[:, 0]
    for name, found in (("force", joints[:, :3]), ("moment", joints[:, 3:])):
        expected = ds[name].values[busy]
        assert np.abs(found - expected).max() < 2e-3 * np.abs(expected).max()
    settled = ds.isel(time=slice(flexible.rivets.settled, None))
    assert s["rivet_shear"] == pytest.approx(float(settled["shear"].max()))
    assert s["rivet_shear"] >= np.hypot(*np.moveaxis(settled["force"].values[..., 1:], -1, 0)).max()
    assert str(flexible.rivets).count("\n") == 6


def test_other_cages_have_no_rivets():
    machined = {"bearing": {"preset": "7010C-PI"}, "load": {"axial": "100 N"}}
    run = simulate(ribbon({"solver.duration": "0.1 ms"}, **machined))
    with pytest.raises(InputError, match="has no rivets"):
        _ = run.rivets


def test_the_picture_of_its_mesh_rings_the_missing_rivet(flexible, tmp_path):
    """In vermilion, on the whole cage and in the close-up."""
    if offscreen_backend() is None:
        pytest.skip("nothing to draw with on this machine")
    path = mesh_picture(flexible.mesh, tmp_path / "mesh.png", defects=flexible.case.defects)
    pixels = np.asarray(Image.open(path).convert("RGB")).astype(int)
    marked = np.abs(pixels - (213, 94, 0)).sum(axis=2) < 12
    half = pixels.shape[1] * 2 // 3
    assert marked[:, :half].sum() > 200 and marked[:, half:].sum() > 200


def test_a_missing_rivet_softens_the_cage_that_rotation_spreads(flexible):
    """At the first sample, before any ball touches the cage."""
    sound = simulate(ribbon({"solver.duration": "0.5 ms"}))
    assert flexible.summary["first_frequency"] < 0.5 * sound.summary["first_frequency"]
    spread = [run.stress(time=run.dataset["time"].values[0]) for run in (sound, flexible)]
    assert spread[1].von_mises.max() > 2.0 * spread[0].von_mises.max()


def test_rims_hold_an_unbalanced_cage():
    """Spherical pockets end at rims, which keep the cage in the bearing: the balls' play in the
    pocket in front and behind is 0.215 mm, and they pass the rims inwards by 0.41 mm."""
    run = simulate(ribbon(RIGID, {"cage.unbalance": "1 g*mm", "solver.duration": "40 ms"}))
    off = np.hypot(*run.dataset["cage_position"].values[:, 1:].T)
    assert 0.1e-3 < off.max() < 0.45e-3
    audit = energy_audit(run.dataset)
    assert audit.passed and audit.of_drive < 1e-4


@pytest.mark.slow
def test_the_joint_of_a_stored_run(flexible):
    """The most stressed rivet's joint, coarsely: with play the shank stays free of its holes, and
    the root's range of stress is that of its loads."""
    from flexcage.mesh.riveted_joint import JointMesh

    run = load_run(flexible.folder)
    mesh = JointMesh(sectors=6, root=2, size=1.5, seat=0.6, growth=2.0)
    fits = run.rivet_joint("-3 um", "10 um", clamp="60 N", mesh=mesh)
    tight, loose = fits
    rivet, largest, _ = run.rivets.cycle()
    assert fits.rivet == rivet == run.rivets.largest("stress")[1]
    assert np.allclose(loose.instants["largest"].load, largest)
    assert loose.largest_pressure["hole_upper"] == 0.0 < tight.largest_pressure["hole_upper"]
    assert 0.0 < loose.K_t < 10.0 and "rivet" in str(fits)
    with pytest.raises(InputError, match="clamp is '60 mm'"):
        run.rivet_joint(clamp="60 mm")
