"""Runs of machines: forces and places beside the static solution, books, folders, mistakes."""

import json

import numpy as np
import pytest
from PIL import Image
from turning_machines import spindle

from flexcage import load_run
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.machine import load_machine
from flexcage.machine_run import load_machine_run, simulate_machine


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("machine") / "pair"
    return simulate_machine(load_machine(spindle()), out=folder, stress=False)


def test_bearings_bear_what_the_static_solution_says(run):
    """Radially within 2 %; the preload grows while balls find how they spin, as in a bearing's own
    run, and both bearings have the same."""
    front, rear = (run.summary.bearings[name] for name in ("front", "rear"))
    for figures in (front, rear):
        assert figures.radial == pytest.approx(figures.static_radial, rel=0.02)
        assert abs(figures.axial) == pytest.approx(abs(figures.static_axial), rel=0.15)
        assert figures.torque > 0.0
    assert front.axial == pytest.approx(-rear.axial, rel=0.03)
    assert front.axial < 0.0 < rear.axial


def test_load_and_weight_are_borne_by_both(run):
    """Means of forces along y over the last 2 ms, and moments about the front bearing."""
    ds = run.record.settled(0.5)
    force = ds["force"].mean("time")
    front, rear = (force.sel(bearing=name) for name in ("front", "rear"))
    sections = run.machine.shaft.sections[0]
    mass = sections.area * sections.length * 7850.0 + 0.5
    weight = (mass - 0.5) * 9.80665 * (0.12 - 0.06) + 0.5 * 9.80665 * (0.005 - 0.06)
    along_y = float(front.sel(component="y") + rear.sel(component="y"))
    assert along_y == pytest.approx(200.0 + mass * 9.80665, rel=0.01)
    turned = float(rear.sel(component="y")) * 0.12
    turned += float((front + rear).sel(component="about z"))
    assert turned == pytest.approx(-200.0 * 0.06 + weight, abs=0.02 * 12.0)


def test_books_close(run):
    assert run.summary.missed < 1e-4
    for name in ("front", "rear"):
        assert run[name].summary["energy_audit"] == "passed"


def test_every_bearing_is_a_run_in_a_folder_of_its_own(run):
    rear = load_run(run.folder / "rear")
    assert rear.case.name == "pair-rear"
    np.testing.assert_array_equal(
        rear.dataset["race_force"].values, run["rear"].dataset["race_force"].values
    )
    assert "moves its inner ring" in load_run(run.folder / "front").case.description
    again = load_machine_run(run.folder)
    assert again.summary.bearings["front"] == run.summary.bearings["front"]
    assert again.summary.steps == run.summary.steps > 100
    stored = json.loads((run.folder / "machine_summary.json").read_text())
    assert stored["bearings"]["rear"]["radial"] == run.summary.bearings["rear"].radial


def test_the_shaft_and_the_machine_are_drawn(run, tmp_path):
    assert run.draw_shaft(tmp_path / "shaft.png").stat().st_size > 20_000
    picture = run.draw_machine(tmp_path / "machine.png")
    pixels = np.asarray(Image.open(picture).convert("RGB"), float)
    drawn = (pixels[96:816] < 240.0).any(axis=2).mean()
    assert 0.08 < drawn < 0.6  # shaft and bearings, on white


def test_the_page_has_bearings_shaft_and_pictures(run, tmp_path, capsys):
    page = tmp_path / "report.html"
    assert main(["report", str(run.folder), "-o", str(page)]) == 0
    text = page.read_text()
    for part in ("front", "rear", "tool", "radial, N", "orbit, um", "flexcage report"):
        assert part in text
    assert text.count("data:image") >= 3  # machine, shaft, and the static solution's
    figures = run.summary.bearings["front"]
    assert f"{figures.radial:.4g}" in text


@pytest.mark.parametrize("stiffness", ["0 N/um", "2 N/um"])
def test_a_spring_preloads_a_pair_with_its_force(stiffness):
    """The rear outer ring slides before a spring of 100 N: that is the axial force of both."""
    spring = {
        "bearings.rear.axial_seat": "floating", "bearings.rear.spring_force": "100 N",
        "bearings.rear.spring_stiffness": stiffness, "bearings.rear.axial_offset": "0 um",
        "bearings.front.axial_offset": "0 um",
    }  # fmt: skip
    run = simulate_machine(load_machine(spindle(), overrides=spring), stress=False)
    front, rear = (run.summary.bearings[name] for name in ("front", "rear"))
    moved = run["rear"].dataset["outer_position"].sel(axis="x").values
    stiff = 2e6 if stiffness == "2 N/um" else 0.0
    force = 100.0 + stiff * float(moved[len(moved) // 3 :].mean())
    assert rear.axial == pytest.approx(force, rel=0.05)
    assert front.axial == pytest.approx(-force, rel=0.05)
    assert np.ptp(moved) > 1e-8  # it slides


@pytest.mark.slow
def test_orbits_under_unbalance_are_those_of_the_linearised_machine():
    """An elastic shaft, 20 g mm at its end: synchronous amplitudes at all places within 10 % (the
    bearings' stiffness changes with the preload that balls find)."""
    machine = load_machine(spindle("elastic", 46, 20))
    run = simulate_machine(machine, stress=False)
    solution = run.solution
    speed = machine.speed
    response = solution.linearised.response(np.array([speed]))[0]
    time = run.shaft["time"].values
    kept = time > time[-1] - 3.0 * 2.0 * np.pi / speed
    turning = np.exp(-1j * speed * time[kept])
    for place in ("front", "rear", "tool", "right end"):
        at = run.shaft["displacement"].sel(place=place)
        k = int(np.argmin(abs(solution.position - float(at["position"]))))
        for axis, c in (("y", 1), ("z", 2)):
            moved = at.sel(component=axis).values[kept]
            found = 2.0 * abs(np.mean((moved - moved.mean()) * turning))
            assert found == pytest.approx(abs(response[k, c]), rel=0.1, abs=5e-9), (place, axis)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"drive.speed": "0 rpm"}, "drive.speed is 0: a run needs a shaft that turns"),
        ({"drive.kind": "shaft"}, "the speed of a machine's shaft is prescribed"),
    ],
)
def test_what_cannot_run_is_said_in_a_sentence(change, said):
    with pytest.raises(InputError, match=said):
        simulate_machine(load_machine(spindle(), overrides=change))


def test_a_folder_that_is_no_machines_run(tmp_path):
    with pytest.raises(InputError, match="is not the folder of a machine's run"):
        load_machine_run(tmp_path)
