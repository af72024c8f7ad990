"""Runs of a deep groove bearing with a crown cage."""

import numpy as np
import pytest
from crown_cage import crown

from flexcage.case.description import in_words
from flexcage.simulate import load_run, simulate
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh

RIGID = {"cage.model": "rigid"}


@pytest.fixture(scope="module")
def flexible(tmp_path_factory):
    return simulate(crown(), out=tmp_path_factory.mktemp("crown"))


def test_balls_drive_the_cage(flexible):
    s, ds = flexible.summary, flexible.dataset
    assert s["energy_audit"] == "passed" and s["pocket_force_peak"] > 0.05
    for name, values in ds.data_vars.items():
        assert np.isfinite(values.values).all(), name


def test_a_stored_run_has_places_of_stress(flexible):
    run = load_run(flexible.folder)
    assert run.summary["stress_peak"] > 0.5e6
    assert run.stress_history.places.shape[1] == 9 * 7
    names = set(run.recovery.roots)
    assert {"pocket3_ring", "pocket3_bar_front", "pocket3_claw_rear", "pocket3_tip_front"} <= names


@pytest.mark.parametrize("way", [1.0, -1.0], ids=["ring", "tips"])
def test_claws_and_ring_hold_the_cage_axially(way):
    """A cage that goes towards +x comes with its pockets' bottoms against the balls after their
    play; one that goes towards -x with its claws' tips, where a ball reaches up to the throat."""
    case = crown(RIGID)
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    y, layout = assembled_start(case, bearing).y.copy(), bearing.layout
    for velocity in layout.u(y).values():
        velocity[...] = 0.0
    ball, pocket, throat = 0.5 * 7.938e-3, 0.5 * 8.17e-3, 0.5 * 7.3e-3
    tips = np.sqrt(pocket**2 - throat**2) - np.sqrt(ball**2 - throat**2)
    play = pocket - ball if way > 0.0 else tips
    pushed = []
    for share in (0.9, 1.1):
        layout.q(y)["cage"][:] = way * share * play, 0.0, 0.0
        pushed.append(-layout.u(bearing.residual(0.0, y, np.zeros_like(y)))["cage"][0])
    assert abs(pushed[0]) < 1e-9 and way * pushed[1] < -0.1


def test_a_cage_warmer_than_its_material_bears_is_told():
    """A run with pockets as soft as the warm material makes them, from its first step on."""
    warm = {"cage.temperature": "121 degC", "solver.duration": "0.05 ms"}
    run = simulate(crown({**RIGID, **warm}))
    (text,) = (w.text for w in run.warnings if w.key == "cage_temperature")
    assert "at 121 degC, where cages of PA66 are used up to 120 degC" in text
    assert "PA66 at 121°C (0.54 GPa; its strength is that at 23°C)" in " ".join(in_words(run.case))
    assert run.summary.row("cage_modulus").note == "of PA66 at 121°C, 19% of that at 23°C"
    assert run.summary["cage_modulus"] == pytest.approx(0.54e9)
    assert "Cage modulus, warm" in run.summary.text()


@pytest.mark.slow
def test_a_cage_without_a_claw_runs(flexible):
    """Its mass is missing where the claw was: beside the ball in front of pocket 4's middle."""
    defects = [{"type": "missing_claw", "pocket": 4, "claw": "front"}]
    run = simulate(crown(defects=defects))
    assert run.summary["energy_audit"] == "passed" and run.summary["pocket_force_peak"] > 0.05
    for name, values in run.dataset.data_vars.items():
        assert np.isfinite(values.values).all(), name
    lost = 1.0 - run.summary["cage_mass"] / flexible.summary["cage_mass"]
    assert 0.003 < lost < 0.03  # one of 18 claws, which are a small part of the cage
    corners = run.mesh.points[run.mesh.tets]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    centre = volumes @ corners.mean(axis=1) / volumes.sum()
    away = np.arctan2(-centre[2], -centre[1]) % (2.0 * np.pi)
    ball_and_claw = (0.5 * 7.938 + 0.5 * 1.03) / 19.25  # rad from the pocket's middle
    assert away == pytest.approx(4.0 * 2.0 * np.pi / 9.0 + ball_and_claw, abs=0.1)


@pytest.mark.slow
def test_a_cage_with_all_defects_runs():
    """Flexible, its mesh of uneven sectors and cracked; a bent claw presses its ball at once."""
    defects = [
        {"type": "missing_claw", "pocket": 4, "claw": "front"},
        {"type": "bent_claw", "pocket": 2, "claw": "rear", "deflection": "-0.15 mm"},
        {"type": "cracked_claw", "pocket": 7, "claw": "front", "share": 0.4},
        {"type": "worn_pocket", "pocket": 1, "depth": "0.1 mm"},
    ]
    run = simulate(crown({"solver.duration": "1 ms"}, defects=defects))
    assert run.summary["energy_audit"] == "passed" and run.summary["stress_peak"] > 0.5e6
    for name, values in run.dataset.data_vars.items():
        assert np.isfinite(values.values).all(), name
    sound = simulate(crown({"solver.duration": "0.1 ms"}))
    assert run.summary["cage_mass"] < 0.997 * sound.summary["cage_mass"]
