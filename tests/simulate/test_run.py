"""What a run gives: its folder, its dataset, its summary, with figures of the expected size."""

import json
import time

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from simulate_cases import bent, n1013

from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.core.progress import Silent
from flexcage.render import album
from flexcage.render.look import Look
from flexcage.results.registry import VARIABLES, variables_of
from flexcage.results.store import RunStore
from flexcage.simulate import load_run, simulate

RPM = np.pi / 30.0
LONG = {"solver.duration": "10 ms"}


@pytest.fixture(scope="module")
def flexible(tmp_path_factory):
    folder = tmp_path_factory.mktemp("flexible")
    return simulate(n1013(LONG, defects=bent("0.2 mm")), out=folder)


@pytest.fixture(scope="module")
def rigid():
    return simulate(n1013(LONG, {"cage.model": "rigid"}, defects=bent("0.2 mm")))


def test_the_folder_of_a_run(flexible):
    folder = flexible.folder
    assert {"case.toml", "results.zarr", "summary.txt", "summary.json"} <= {
        p.name for p in folder.iterdir()
    }
    assert load_case(folder / "case.toml").hash == flexible.case.hash
    stored = json.loads((folder / "summary.json").read_text("utf-8"))
    assert stored["Speeds"]["cage_speed"]["value"] == flexible.summary["cage_speed"]
    text = (folder / "summary.txt").read_text("utf-8")
    assert "Cage speed" in text and "rpm" in text
    again = load_run(folder)
    assert again.case == flexible.case
    assert again.store.complete and again.dataset.attrs["complete"] == 1
    assert str(again.summary) == str(flexible.summary)


def test_pictures_are_among_the_stored_wall_times(flexible, tmp_path, monkeypatch):
    """Stages add up to no more than all of it, and the stored summary is the one in memory."""
    stages = ["mesh", "modes", "kernels", "start", "solve", "stress"]
    assert list(flexible.stages)[:6] == stages and "wall_pictures" not in flexible.summary
    monkeypatch.setattr(album, "draw_album", lambda *args, **options: time.sleep(0.05) or [])
    flexible.draw(tmp_path)
    stored = json.loads((flexible.folder / "summary.json").read_text("utf-8"))["Wall time"]
    assert [key.removeprefix("wall_") for key in stored] == [*stages, "pictures", "total"]
    seconds = {key: row["value"] for key, row in stored.items()}
    total = seconds.pop("wall_total")
    assert 0.05 <= seconds["wall_pictures"] and sum(seconds.values()) <= total
    assert "Wall time, pictures" in (flexible.folder / "summary.txt").read_text("utf-8")
    assert flexible.summary["wall_total"] == total


def test_text_with_units_says_how_pictures_look(flexible, tmp_path, monkeypatch):
    looks = []
    monkeypatch.setattr(album, "draw_album", lambda *_, look, **__: looks.append(look) or [])
    flexible.draw(tmp_path)
    flexible.draw(tmp_path, view="90 deg", stress_limit="25 MPa", scale=50)
    flexible.draw(tmp_path, view=0.5 * np.pi, stress_limit=25e6, scale=50.0)
    assert looks[0] == Look() and looks[1] == looks[2]
    assert looks[2] == Look(view=0.5 * np.pi, stress_limit=25e6, scale=50.0)
    with pytest.raises(InputError, match="stress_limit is '25 mm', but 'mm' is of another kind"):
        flexible.draw(tmp_path, stress_limit="25 mm")


class Shown(Silent):
    """Progress that notes what it was told."""

    seen: list = []

    def __init__(self, total, label):
        super().__init__(total, label)
        self.seen.append((label, total, self))


def test_every_long_stage_shows_itself(tmp_path):
    """By name where nobody knows how long it takes, else by what share is done."""
    Shown.seen = []
    case = n1013({"solver.duration": "0.4 ms"}, defects=bent("0.3 mm"))
    run = simulate(case, progress=Shown)
    known = {label: (total, bar.done) for label, total, bar in Shown.seen}
    assert list(known) == ["mesh", "modes", "kernels", "start", "solving", "stress"]
    assert known["mesh"][0] is known["modes"][0] is known["kernels"][0] is None
    assert known["start"] == (1.0, 1.0)
    assert known["solving"][1] == pytest.approx(known["solving"][0]) == pytest.approx(0.4e-3)
    assert known["stress"] == (1, 1)
    run.write_vtu(tmp_path / "vtu", times=[1e-4, 2e-4])
    assert Shown.seen[-1][0] == "VTU" and Shown.seen[-1][2].done == 2


def test_the_mode_table_is_stored_and_the_summary_says_where(flexible, rigid):
    """Elastic modes of a free body move no mass centre: their effective masses are zero."""
    row = flexible.summary.row("mode_count")
    assert row.value == flexible.cage.basis.size == 46 and row.note == "table: modes.csv"
    lines = (flexible.folder / "modes.csv").read_text("utf-8").splitlines()
    head, rows = lines[0].split(","), [line.split(",") for line in lines[1:]]
    assert head[0] == "number" and "share_crossbeam" in head
    assert [int(r[0]) for r in rows] == list(range(1, 47))
    at = head.index("frequency [Hz]")
    assert [float(r[at]) for r in rows] == list(flexible.cage.basis.frequencies)
    assert [r[head.index("kind")] for r in rows] == list(flexible.cage.basis.kind)
    masses = [[float(r[head.index(f"effective_mass_{a} [kg]")]) for a in "xyz"] for r in rows]
    assert np.abs(masses).max() < 1e-9 * flexible.summary["cage_mass"]
    assert "mode_count" not in rigid.summary
    with pytest.raises(InputError, match="rigid cage has no modes"):
        rigid.mode_table  # noqa: B018


def test_a_folder_with_a_run_is_not_overwritten(flexible):
    before = (flexible.folder / "results.zarr" / "_run" / "commit.json").read_text("utf-8")
    with pytest.raises(InputError):
        simulate(flexible.case, out=flexible.folder)
    assert RunStore.open(flexible.folder / "results.zarr").complete
    after = (flexible.folder / "results.zarr" / "_run" / "commit.json").read_text("utf-8")
    assert after == before


def test_a_run_in_memory(rigid, tmp_path, monkeypatch):
    assert rigid.folder is None and rigid.store.path is None
    assert "samples" in repr(rigid)
    with pytest.raises(InputError, match="rigid cage has no stress"):
        rigid.stress()


@pytest.mark.parametrize("which", ["flexible", "rigid"])
def test_every_variable_is_there_complete_and_finite(request, which):
    ds = request.getfixturevalue(which).dataset
    expected = {
        v
        for v in variables_of("cylindrical_roller")
        if (which == "flexible" or not v.startswith("modal_"))
        # of rings that bend, of spots, without a cage
        and not v.startswith(("ring_", "support_", "spot_", "neighbour_"))
    }
    assert set(ds.data_vars) == expected
    for name, values in ds.data_vars.items():
        assert np.isfinite(values.values).all(), name
        assert values.attrs["units"] == VARIABLES[name].unit
    assert ds.sizes["time"] == 500 and ds.sizes["time_hf"] == 2000
    np.testing.assert_allclose(ds["time"].values, np.arange(1, 501) / 50e3, rtol=1e-12)


@pytest.mark.parametrize("which", ["flexible", "rigid"])
def test_recorded_motion_agrees_with_itself(request, which):
    """Angles are the integrals of speeds, quaternions are unit, the drive keeps its speed."""
    ds = request.getfixturevalue(which).dataset
    t = ds["time"].values
    np.testing.assert_allclose(ds["inner_speed"], 6000 * RPM, rtol=1e-9)
    np.testing.assert_allclose(ds["inner_angle"], 6000 * RPM * t, rtol=1e-9)
    quaternion = ds["cage_quaternion"].values
    np.testing.assert_allclose(np.linalg.norm(quaternion, axis=1), 1.0, atol=1e-12)
    turned = np.unwrap(2.0 * np.arctan2(quaternion[:, 1], quaternion[:, 0]), period=2 * np.pi)
    spin = ds["cage_omega"].sel(axis="x").values
    gained = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(t) * (spin[1:] + spin[:-1]))])
    np.testing.assert_allclose(turned - turned[0], gained, atol=2e-4)
    centre, velocity = ds["cage_position"].values, ds["cage_velocity"].values
    moved = np.cumsum(0.5 * np.diff(t)[:, None] * (velocity[1:] + velocity[:-1]), axis=0)
    np.testing.assert_allclose(centre[1:] - centre[0], moved, atol=1e-6)


def test_the_cage_comes_to_ride_on_its_land(flexible):
    """Gravity and friction bring it there within 10 ms; its force is then newtons to tens."""
    force = np.linalg.norm(flexible.dataset["land_force"].values, axis=1)
    assert force[:100].max() == 0.0 and 1.0 < force.max() < 500.0


def test_slices_and_stations_sum_to_the_faces(flexible):
    ds = flexible.dataset
    faces = ds["pocket_force"].values
    np.testing.assert_allclose(
        ds["pocket_slice_force"].sum("slice").values, faces[:, :, :2], rtol=1e-4, atol=1e-4
    )
    np.testing.assert_allclose(
        ds["pocket_point_force"].sum("end_point").values, faces[:, :, 2:], rtol=1e-4, atol=1e-4
    )
    stations = ds["station_force"].sum("station")
    for face, (component, sign) in enumerate((("psi", 1), ("psi", -1), ("x", 1), ("x", -1))):
        along = sign * stations.isel(face=face).sel(cyl=component).values
        np.testing.assert_allclose(along, faces[:, :, face], rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("which", ["flexible", "rigid"])
def test_orders_of_magnitude(request, which):
    """The N1013 at 6000 rpm and 1000 N, from different prototypes."""
    run = request.getfixturevalue(which)
    s, ds = run.summary, run.dataset
    assert s["epicyclic_speed"] == pytest.approx(2709.09 * RPM, rel=1e-5)
    assert s["roller_spin_ideal"] == pytest.approx(27937.5 * RPM, rel=1e-5)
    assert -0.01 < s["cage_slip_ratio"] < 0.05
    assert abs(s["slip_loaded"]) < 0.02
    assert 0.0 < s["slip_unloaded"] < 0.1
    assert 300.0 < s["race_force_inner"] < 345.0
    assert 0.5 < s["pocket_force_mean"] < 20.0
    assert 10.0 < s["pocket_force_peak"] < 200.0
    assert s["energy_relative"] < 1e-3
    assert 0.075 < s["cage_mass"] < 0.1
    away = ds["race_force"].sel(race="outer").values[:, 9:14]  # opposite the load
    assert np.median(away) == pytest.approx(10.48, rel=0.05)


def test_stress_has_the_expected_size(flexible):
    """0.2 to 0.3 MPa at a crossbeam's root per newton on its middle, forces up to about 100 N."""
    s, h = flexible.summary, flexible.stress_history
    assert 600.0 < s["first_frequency"] < 1200.0
    assert 1e6 < s["stress_root"] <= s["stress_peak"] < 60e6
    force = flexible.dataset["pocket_force"].values[..., :2].max(axis=(1, 2))
    per_newton = h.places.max(axis=1)[force > 20.0] / force[force > 20.0]
    assert 0.03e6 < np.median(per_newton) < 0.5e6
    field = flexible.stress()
    assert field.von_mises.max() >= 0.999 * h.peak[h.settled :].max()
    assert np.abs(field.displacement).max() < 0.1e-3


def test_the_summary_says_what_its_peaks_and_cuts_leave_out(flexible):
    """The peak is the largest off the flat walls, which hold more at some instant of the run."""
    row, h = flexible.summary.row("stress_peak"), flexible.stress_history
    assert "flat pocket walls" in row.label and "off the fillets are never searched" in row.note
    walls = flexible.recovery.contact_zone
    assert not np.isin(h.peak_vertex, walls).any()
    assert np.isin(h.surface, walls).sum() == len(walls)
    searched = h.envelope[~np.isin(h.surface, walls)]
    assert searched.max() == pytest.approx(row.value, rel=1e-6)
    cut = flexible.summary.row("far_coupling")
    assert "what others would feel" in cut.note and "under 0.5 %" in cut.note


def test_inner_ring_carries_the_load(rigid):
    """Race forces on the rollers, summed as vectors, hold 1000 N and the rings' weight."""
    ds = rigid.dataset.isel(time=slice(100, None))
    psi = ds["element_position"].sel(cyl="psi")
    force = ds["race_force"].sel(race="inner")
    weight = rigid.case.bearing.inner_ring_mass * 9.80665
    assert float((force * np.cos(psi)).sum("element").mean()) == pytest.approx(
        1000 + weight, rel=2e-3
    )
    assert abs(float((force * np.sin(psi)).sum("element").mean())) < 10.0


def test_events_are_the_contacts_that_close_and_open(flexible):
    """Each place closes and opens by turns, and while its force is above zero it is closed."""
    events, ds = flexible.events, flexible.dataset
    assert set(events["place"].values) >= {"outer race", "front", "rear", "land +x"}
    roller, place = events["element"].values, events["place"].values
    for k in range(22):
        closed = events["closed"].values[(roller == k) & (place == "front")]
        assert np.all(closed[1:] != closed[:-1])
    assert np.all(roller[np.char.startswith(place, "land")] == -1)
    assert np.all(np.diff(events["time"].values) >= 0.0)
    assert events["time"].values[-1] <= ds["time"].values[-1] + 1e-12
    assert flexible.steps["step"].sum() == pytest.approx(ds["time"].values[-1])


def test_orientations_turn_with_the_angular_velocities(flexible):
    """Two samples' quaternions differ by the angular velocity between them, in the body's frame."""
    ds = flexible.dataset
    dt = float(ds["time"][1] - ds["time"][0])
    for name, speed in (("inner", ds["inner_speed"].values), ("element", None)):
        q = ds[f"{name}_quaternion"].values
        first, second = q[100:200:7], q[101:201:7]
        turn = Rotation.from_quat(first.reshape(-1, 4), scalar_first=True).inv()
        turn = turn * Rotation.from_quat(second.reshape(-1, 4), scalar_first=True)
        about_axis = turn.as_rotvec()[:, 0] / dt
        if speed is None:
            omega = ds["element_omega"].values[..., 0]
            speed = 0.5 * (omega[100:200:7] + omega[101:201:7])
        else:
            speed = speed[100:200:7]
        np.testing.assert_allclose(about_axis, speed.ravel(), rtol=2e-4)


def test_a_vtu_series_holds_what_stress_gives(flexible, tmp_path):
    """Read back by meshio and by VTK, which takes its times from the .pvd."""
    import meshio
    import pyvista

    folder = tmp_path / "vtu"
    path = flexible.write_vtu(folder, times=[4.5e-3, 6.011e-3, 6.012e-3])
    assert path == folder / "cage.pvd"
    reader = pyvista.get_reader(path)
    assert reader.time_values == pytest.approx([4.5e-3, 6.02e-3])
    field = flexible.stress(time=6.02e-3)
    read = meshio.read(folder / "cage_0001.vtu")
    np.testing.assert_allclose(read.points, flexible.mesh.points)
    np.testing.assert_array_equal(read.cells_dict["tetra"], flexible.mesh.tets)
    for name, values in (
        ("displacement", field.displacement[: len(read.points)]),
        ("von_mises", field.von_mises),
        ("stress", field.stress),
    ):
        largest = np.abs(values).max()
        np.testing.assert_allclose(read.point_data[name], values, atol=1e-6 * largest)
    reader.set_active_time_value(reader.time_values[1])
    shown = reader.read()[0]
    assert shown.point_data["von_mises"].max() == pytest.approx(field.von_mises.max(), rel=1e-6)


def test_what_a_vtu_series_refuses(flexible, rigid, tmp_path):
    with pytest.raises(InputError, match="rigid cage has no stress; run the case with"):
        rigid.write_vtu(tmp_path / "vtu")
    assert not (tmp_path / "vtu").exists()
    with pytest.raises(InputError, match=r"no sample at 11 ms; the run has 0\.02 to 10 ms"):
        flexible.write_vtu(tmp_path / "vtu", times=[11e-3])
    (tmp_path / "notes.txt").write_text("precious")
    with pytest.raises(InputError, match="exists already"):
        flexible.write_vtu(tmp_path, times=[5e-3])


def test_export_writes_the_samples_asked_for(flexible, tmp_path, capsys):
    from flexcage import cli

    run, out = str(flexible.folder), tmp_path / "out"
    argv = ["export", run, "-o", str(out), "--from", "5 ms", "--to", "5.1 ms"]
    assert cli.main(argv) == 0
    assert len(list(out.glob("cage_*.vtu"))) == 6 and "cage.pvd" in capsys.readouterr().out
    assert cli.main(argv) == 2 and "exists already" in capsys.readouterr().err
    assert cli.main([*argv, "--count", "3", "--force"]) == 0
    assert len(list(out.glob("cage_*.vtu"))) == 3
    assert cli.main(["export", run, "-o", run, "--force"]) == 2
    assert "did not write" in capsys.readouterr().err
    assert RunStore.open(flexible.folder / "results.zarr").complete
    assert cli.main(["export", run, "--from", "20 ms"]) == 2
    assert "the run has 0.02 to 10 ms" in capsys.readouterr().err
    assert not (flexible.folder / "vtu").exists()


def test_places_of_forces_have_units(flexible):
    ds = flexible.dataset
    np.testing.assert_allclose(ds["station_place"], flexible.cage.interface.stations, atol=1e-12)
    assert ds["slice"].attrs["units"] == ds["station_place"].attrs["units"] == "m"
    assert ds["station_place"].dims == ("face", "station")
    assert ds["end_point_place"].attrs["units"] == "m"
