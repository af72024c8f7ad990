"""A pit on a ball of a running bearing: it strikes both races, as often as the ball turns."""

from __future__ import annotations

import numpy as np
import pytest
from test_ball_spall import NO_SPALL, envelope_lines, run_of, strongest

from flexcage.case import load_case
from flexcage.core.errors import InputError

AXIAL = {"load.radial": "0 N", "load.axial": "400 N", "solver.duration": "60 ms", **NO_SPALL}
PIT = {"bearing.ball_spot.size": "0.8 mm", "bearing.ball_spot.depth": "50 um",
       "bearing.ball_spot.ball": 3, "bearing.ball_spot.angle": "90 deg"}  # fmt: skip


@pytest.mark.slow
def test_a_pit_strikes_at_twice_the_spin_frequency_while_its_path_crosses_the_tracks():
    run = run_of(AXIAL, PIT)
    frequency, amplitude, resolution, own = envelope_lines(run)
    found, height = strongest(frequency, amplitude, 1.5 * own["BSF"], 2.5 * own["BSF"])
    assert found == pytest.approx(own["2 BSF"], abs=resolution)
    away = run_of(
        AXIAL, PIT, {"bearing.ball_spot.angle": "0 deg", "bearing.ball_spot.tilt": "88 deg"}
    )
    frequency, amplitude, _, own = envelope_lines(away)
    near = np.abs(frequency - own["2 BSF"]) < 2.0 * resolution
    assert amplitude[near].max() < 0.1 * height
    assert run.summary.row("energy_audit").value == "passed"


@pytest.mark.slow
def test_both_methods_turn_the_spot_alike():
    short = {**AXIAL, "solver.duration": "5 ms"}
    two = {**PIT, "bearing.ball_spot.others": [7]}  # opposite: the ring follows neighbours' dips
    runs = [run_of(short, two, {"solver.method": m}).dataset for m in ("bdf", "explicit")]
    for ball in (3, 7):
        forces = [ds["race_force"].isel(element=ball).values for ds in runs]
        dips = [np.mean(f < 0.6 * np.median(f)) for f in forces]
        assert dips[0] > 0.005 and dips[1] == pytest.approx(dips[0], rel=0.2)


def test_the_recorded_direction_turns_with_the_ball():
    """Central differences of the direction in space against the ball's angular velocity."""
    two = {**PIT, "bearing.ball_spot.others": [7], "bearing.ball_spot.tilt": "30 deg"}
    ds = run_of({**AXIAL, "solver.duration": "0.6 ms"}, two).dataset
    assert ds["spotted"].values.tolist() == [3, 7]
    direction = ds["spot_direction"].transpose("time", "spotted", "axis").values
    np.testing.assert_allclose(np.linalg.norm(direction, axis=-1), 1.0, rtol=1e-6)
    own = ds.isel(element=[3, 7])
    x, r, p = (own["element_omega"].isel(spin_axis=c).values for c in range(3))
    psi = own["element_position"].sel(cyl="psi").values
    omega = np.stack([x, np.cos(psi) * r - np.sin(psi) * p, np.sin(psi) * r + np.cos(psi) * p], -1)
    t = ds["time"].values
    change = (direction[2:] - direction[:-2]) / (t[2:] - t[:-2])[:, None, None]
    turned = np.cross(omega, direction)[1:-1]
    assert np.abs(turned).max() > 500.0
    np.testing.assert_allclose(change, turned, atol=2e-3 * np.abs(turned).max())


def test_spots_that_cannot_be_are_refused():
    from test_ball_spall import CASE

    for changes, words in (
        ({"ball": 9}, "the balls are numbered 0 to 8"),
        ({"others": [0, 9]}, "others is 9, but the balls are numbered 0 to 8"),
        ({"size": "3 mm"}, "a quarter of the ball's diameter"),
        ({"depth": "5 mm"}, "a tenth of the ball's diameter"),
        ({"kind": "hole"}, "pit"),
    ):
        spot = {**PIT, **{f"bearing.ball_spot.{k}": v for k, v in changes.items()}}
        with pytest.raises(InputError, match=words):
            load_case(CASE, overrides=spot)
