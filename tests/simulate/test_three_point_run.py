"""Split rings in motion: one arc in the outer or in the inner race, two in the other."""

from __future__ import annotations

from pathlib import Path

import pytest

import flexcage
from flexcage.case import load_case
from flexcage.static import solve_static
from flexcage.system.statics.options import AT_START

CASE = Path(__file__).parents[2] / "examples" / "qj208.toml"


@pytest.mark.parametrize("single", ["inner", "outer"])
def test_a_race_of_one_arc_bears_what_the_static_solution_says(single):
    """On each arc, all balls together: at the start within 0.1 %, in the second half
    within 3 %, when friction has its say; the arc that is not there bears nothing."""
    case = load_case(CASE, overrides={
        f"bearing.{single}_shim": "0 mm", "cage.model": "none", "solver.duration": "5 ms",
        "drive.speed": "1500 rpm",
    })  # fmt: skip
    due = {name: f.sum() for name, f in solve_static(case, options=AT_START).elements.arcs.items()}
    run = flexcage.simulate(case, stress=False)
    force = run.dataset["arc_force"].sum("element")
    other = "outer" if single == "inner" else "inner"
    assert set(due) == {single, f"{other} -x", f"{other} +x"} and min(due.values()) > 500.0
    late = force.isel(time=slice(force.sizes["time"] // 2, None)).mean("time")
    for now, share in ((force.isel(time=0), 1e-3), (late, 0.03)):
        for arc in ("-x", "+x"):
            found = float(now.sel(race=other, arc=arc))
            assert found == pytest.approx(due[f"{other} {arc}"], rel=share)
        one = now.sel(race=single)
        assert float(one.sum()) == pytest.approx(due[single], rel=share) and float(one.min()) == 0.0
    assert run.summary.row("energy_audit").value == "passed"
