"""Runs of needle roller bearings: on the shaft, with a cage between the lips, and full."""

from functools import cache

import numpy as np
import pytest
from needle_rollers import CUP_CASE

from flexcage.cages.window.faces import pocket_size
from flexcage.case import catalogue, load_case
from flexcage.case.new import new_case
from flexcage.simulate import simulate
from flexcage.stages import bearing_in_motion, cage_mesh, cage_modes

CAGED = """
[cage]
model = "rigid"
material = "steel"
bore = "20.8 mm"
outside_diameter = "23.6 mm"
width = "13.8 mm"
pocket_width = "2.1 mm"
pocket_length = "11.95 mm"
fillet_radius = "0.15 mm"
guidance = "outer"
"""
FULL = '[cage]\nmodel = "none"\n'


@cache
def needles(cage=CAGED, method="explicit", duration="2 ms", **changes):
    text = CUP_CASE.replace("roller_count = 22", f"roller_count = {22 if cage == CAGED else 34}")
    case = load_case(f'{text}{cage}[drive]\nspeed = "3000 rpm"\n')
    how = {"solver.method": method, "solver.duration": duration, "output.rate": "50 kHz"}
    return case.replace({**how, "mesh.fineness": "coarse", **changes})


@pytest.mark.parametrize("cage", [CAGED, FULL])
def test_needles_roll_and_their_energy_balances(cage):
    """The loaded needle orbits at 20/44 of the shaft's speed, as in pure rolling."""
    run = simulate(needles(cage))
    assert run.summary["energy_audit"] == "passed"
    psi = run.dataset["element_position"].sel(cyl="psi").isel(element=0).values
    time = run.dataset["time"].values
    half = len(time) // 2
    turned = (psi[-1] - psi[half]) / ((time[-1] - time[half]) * 2.0 * np.pi * 50.0)
    assert turned == pytest.approx(20.0 / 44.0, rel=0.01)


def test_a_cage_between_the_lips_takes_its_side_beams_from_their_distance():
    case = needles()
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    model = bearing.data.model
    assert model.outer_rib.half_gap == pytest.approx(0.5 * (14.2e-3 - (13.8e-3 - 11.95e-3)))
    assert (model.rib.first, model.rib.end) == (1, 0) or model.rib.end <= model.rib.first
    full = bearing_in_motion(needles(FULL), None, None).data.model
    assert full.outer_rib.half_gap == pytest.approx(7.1e-3)


@pytest.mark.slow
def test_both_integrators_move_needles_alike():
    one, other = (
        simulate(needles(method=m, duration="1 ms")).dataset.isel(time=slice(25, None))
        for m in ("explicit", "bdf")
    )
    for name, within in (("race_force", 2e-3), ("inner_position", 2e-3), ("element_omega", 5e-3)):
        a, b = (ds[name].mean("time").values for ds in (one, other))
        assert np.abs(a - b).max() < within * np.abs(a).max(), name


@pytest.mark.slow
def test_a_needle_cage_is_meshed_reduced_and_bent():
    """That of an HK2020: it ovalises alike both ways, and a bent crossbeam alters two pockets."""
    entry = catalogue.find("HK2020")
    case = load_case(new_case(entry.outline, entry.source).text).replace("mesh.fineness", "coarse")
    found = cage_modes(case).frequency
    assert found[0] == pytest.approx(found[1], rel=1e-6)
    assert found[0] == pytest.approx(2680.0, rel=0.05)  # of the default mesh
    bent = case.replace("defects", [{"type": "crossbeam", "crossbeam": 3, "displacement": "30 um"}])
    mesh, radius = cage_mesh(bent), bent.bearing.pitch_radius
    wide = [pocket_size(mesh, k, pitch_radius=radius)[0] for k in range(5)]
    assert wide == pytest.approx([2.1e-3, 2.1e-3, 2.07e-3, 2.13e-3, 2.1e-3], abs=3e-6)


def test_a_tilted_shaft_skews_needles_and_a_figure_says_so():
    straight, tilted = (
        simulate(needles(**{"load.misalignment": tilt})).summary["roller_skew"]
        for tilt in ("0 mrad", "1 mrad")
    )
    assert tilted > straight >= 0.0
