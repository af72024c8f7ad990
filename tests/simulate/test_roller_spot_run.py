"""A pit on a roller of a running bearing: it strikes both races, as often as the roller turns."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from simulate_cases import n1013
from test_ball_spall import envelope_lines, strongest

import flexcage
from flexcage.contacts.evaluation import REPORT
from flexcage.core.errors import InputError
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh

RIGID = {"cage.model": "rigid"}
PIT = {"bearing.roller_spot.size": "1 mm", "bearing.roller_spot.depth": "50 um"}
HOUSED = {
    "mount.kind": "bushing", "mount.stiffness": "2e8 N/m", "mount.damping": "2000 N*s/m",
    "solver.duration": "120 ms",
}  # fmt: skip


def spotted(*tables, roller=0):
    case = n1013(
        RIGID, PIT, *tables, bearing={"preset": "N1013", "roller_spot": {"roller": roller}}
    )
    return flexcage.simulate(case, stress=False)


def test_a_roller_whose_pit_is_over_a_race_bears_little_and_energy_balances():
    """1 mm lets a roller of 8 mm down by 30 um, more than the most loaded one is pressed in: over
    either race it lies on the other one with its weight alone."""
    run = spotted({"bearing.roller_spot.angle": "90 deg", "solver.duration": "3 ms"})
    force = run.dataset["race_force"].isel(element=0)
    inner, outer = (force.sel(race=r).values for r in ("inner", "outer"))
    psi = run.dataset["element_position"].isel(element=0).sel(cyl="psi")
    outwards = xr.concat([0.0 * psi, np.cos(psi), np.sin(psi)], "axis")
    for over, other in ((inner, outer), (outer, inner)):
        assert np.mean(over == 0.0) > 0.05
        lying, bearing = np.median(other[over == 0.0]), np.median(other[over > 0.0])
        assert lying < 0.1 * bearing  # but for blows as it falls in and out
    facing = (run.dataset["spot_direction"].isel(spotted=0) * outwards).sum("axis").values
    relieved = (inner == 0.0) & (psi.values < 0.5)  # the loaded zone ends at 0.8 rad
    assert np.abs(facing[relieved]).min() > np.cos(0.2)  # the pit reaches 0.125 rad to either side
    assert np.abs(facing[inner > 0.0]).max() < np.cos(0.05)
    others = run.dataset["race_force"].isel(element=[1, 21]).sel(race="outer")
    assert float(others.min()) > 0.0
    assert run.summary.row("energy_audit").value == "passed"


@pytest.mark.parametrize(
    ("angle", "low", "high", "mount", "residual"),
    [(0.0, 0.0, 0.0, {}, 1e-6), (0.0, 0.0, 0.0, HOUSED, 1e-3), (5.0, 0.05, 0.9, {}, 1e-6)],
    ids=["over", "over, between its edges", "at an edge"],
)
def test_a_run_starts_in_equilibrium_on_the_spot(angle, low, high, mount, residual):
    """The most loaded roller's pit faces the outer race: its neighbours bear what it does not, and
    the inner ring is balanced before the first step."""
    forces = {}
    for size in ("0 mm", "1 mm"):
        spot = {"bearing.roller_spot.size": size, "bearing.roller_spot.angle": f"{angle} deg"}
        roller = {"preset": "N1013", "roller_spot": {"roller": 0}}
        case = n1013(RIGID, PIT, spot, mount, bearing=roller)
        bearing = bearing_in_motion(case, cage_mesh(case), None)
        start = assembled_start(case, bearing)
        y, layout = start.y.copy(), bearing.layout
        for velocity in layout.u(y).values():
            velocity[...] = 0.0
        bearing.residual(0.0, y, np.zeros_like(y), mode=REPORT)
        forces[size] = bearing.data.work.report.race[:, 0, 0].copy()
        psi = layout.q(y)["elements"][:, 2]
        along = forces[size] @ np.column_stack([np.cos(psi), np.sin(psi)])
        assert np.hypot(*along) == pytest.approx(1000.0, rel=5e-3) and start.residual < residual
    even, pitted = forces["0 mm"], forces["1 mm"]
    assert even.argmax() == 0 and low <= pitted[0] / even[0] <= high
    assert (pitted[[1, 21]] > 1.02 * even[[1, 21]]).all()


@pytest.mark.slow
def test_a_pit_strikes_at_twice_the_spin_frequency_with_sidebands_of_the_cage():
    run = spotted(HOUSED)
    frequency, amplitude, resolution, own = envelope_lines(run)
    found, height = strongest(
        frequency, amplitude, own["2 BSF"] - 0.5 * own["FTF"], own["2 BSF"] + 0.5 * own["FTF"]
    )
    assert found == pytest.approx(own["2 BSF"], abs=resolution)
    for side in (-1.0, 1.0):
        middle = own["2 BSF"] + side * own["FTF"]
        beside, also = strongest(
            frequency, amplitude, middle - 0.4 * own["FTF"], middle + 0.4 * own["FTF"]
        )
        assert beside == pytest.approx(middle, abs=resolution) and also > 0.3 * height
    assert run.summary.row("energy_audit").value == "passed"


@pytest.mark.slow
def test_both_methods_turn_the_spot_alike():
    runs = [
        spotted({"solver.method": m, "solver.duration": "2 ms"}).dataset
        for m in ("bdf", "explicit")
    ]
    forces = [ds["race_force"].isel(element=0).values for ds in runs]
    dips = [np.mean(f == 0.0) for f in forces]
    assert dips[0] > 0.005 and dips[1] == pytest.approx(dips[0], rel=0.2)


def test_spots_that_cannot_be_are_refused():
    for changes, words in (
        ({"size": "3 mm"}, "a quarter of the roller's diameter"),
        ({"depth": "5 mm"}, "a tenth of the roller's diameter"),
        ({"width": "1 mm", "offset": "5 mm"}, "where the roller touches no race"),
        ({"kind": "hole"}, "pit"),
    ):
        spot = {**PIT, **{f"bearing.roller_spot.{k}": v for k, v in changes.items()}}
        with pytest.raises(InputError, match=words):
            n1013(RIGID, spot)
    for numbers in ({"roller": 22}, {"others": [3, 22]}):
        with pytest.raises(InputError, match="is 22, but the rollers are numbered 0 to 21"):
            n1013(PIT, bearing={"preset": "N1013", "roller_spot": numbers})


def test_several_rollers_may_have_one(build_parts):
    case = n1013(PIT, bearing={"preset": "N1013", "roller_spot": {"roller": 3, "others": [9, 5]}})
    assert "Rollers 3, 5 and 9 have a pit of 1 mm, 50 µm deep." in case.bearing.in_words()
    model = build_parts(bearing={"roller_spot": case.bearing.roller_spot})
    assert np.flatnonzero(model.spot.has).tolist() == [3, 5, 9]
    assert not build_parts().spot.has.any()
