"""Losses of runs by place: races add up to what the solver integrated, near the static ones."""

import numpy as np
import pytest

from flexcage.bearings import losses_of
from flexcage.case import load_case
from flexcage.contacts.evaluation import REPORT, RESIDUAL
from flexcage.core.errors import InputError
from flexcage.results.losses import losses_of_run
from flexcage.results.metrics import settled
from flexcage.simulate import simulate
from flexcage.stages import bearing_in_motion, cage_mesh
from flexcage.static import solve_static
from flexcage.system.statics.options import AT_START

RACES = ["race_damping", "race_friction", "rolling_resistance"]
CASES = {
    "balls": ("7010C-PI", {"axial": "300 N", "radial": "100 N"}),
    "rollers": ("N1013", {"radial": "1000 N"}),
}


@pytest.fixture(scope="module", params=CASES)
def run(request):
    preset, load = CASES[request.param]
    case = load_case(
        {
            "bearing": {"preset": preset}, "cage": {"model": "rigid"}, "load": load,
            "drive": {"speed": "4000 rpm"}, "solver": {"duration": "12 ms"},
        }
    )  # fmt: skip
    return simulate(case)


def test_both_races_lose_what_the_solver_integrated(run):
    ds = run.dataset
    rate = np.gradient(
        ds["work"].sel(channel=RACES).sum("channel").values, ds["time"].values
    )  # fmt: skip
    both = ds["race_power"].sum("race").values
    assert both[10:-10].mean() == pytest.approx(rate[10:-10].mean(), rel=0.01)
    assert (ds["race_power"].values < 0.0).all()


def test_places_add_up_to_the_drive_and_what_is_stored(run):
    places, drive = losses_of_run(run.dataset, 0.5)
    part = settled(run.dataset, 0.5)
    stored = part["energy"].sum("energy_kind").values
    stored_rate = (stored[-1] - stored[0]) / np.ptp(part["time"].values)
    assert sum(places.values()) == pytest.approx(drive - stored_rate, rel=0.005)
    assert places["inner race"] > 0.0 and places["pockets"] > 0.0


def test_the_static_solution_loses_nearly_as_much_at_races(run):
    case = run.case
    solution = solve_static(case, options=AT_START)
    static = losses_of(case.bearing)(
        case.bearing, solution, contacts=case.contacts, lubricant=case.lubricant
    )  # fmt: skip
    places, _ = losses_of_run(run.dataset, 0.5)
    for race in ("inner race", "outer race"):
        assert static.places[race] == pytest.approx(places[race], rel=0.1), race


def test_a_report_leaves_the_residual_as_it_is(run):
    """To the bit: what races report by themselves costs no trajectory anything."""
    bearing = bearing_in_motion(run.case, cage_mesh(run.case), None)
    y = run.start.y
    one, other = (bearing.residual(0.0, y, run.start.yd, mode=m).copy() for m in (RESIDUAL, REPORT))
    assert np.array_equal(one, other)


def test_a_run_without_its_work_says_so(run):
    with pytest.raises(InputError, match="The run has no variable 'race_power'"):
        losses_of_run(run.dataset.drop_vars("race_power"))
