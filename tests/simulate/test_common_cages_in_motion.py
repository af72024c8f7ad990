"""Runs of bearings whose common cage bends: both integrators, the rigid limit, momentum, defects of
either row, stress, and what a run's folder keeps."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import flexcage
from flexcage import load_case, simulate
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh, cage_reduction

NN3010 = {
    "type": "double_row_cylindrical_roller", "bore": "50 mm", "outside_diameter": "80 mm",
    "width": "23 mm", "inner_race_diameter": "58 mm", "outer_race_diameter": "72 mm",
    "roller_diameter": "7 mm", "roller_length": "7 mm", "effective_length": "6.4 mm",
    "roller_count": 12, "rib_diameter": "60 mm", "rib_gap": "7.05 mm", "row_distance": "9 mm",
}  # fmt: skip
WINDOW = {
    "type": "window", "bore": "61 mm", "outside_diameter": "66.4 mm", "width": "9 mm",
    "pocket_width": "7.2 mm", "pocket_length": "7.25 mm", "fillet_radius": "0.45 mm",
}  # fmt: skip
B3205 = {
    "type": "double_row_angular_contact_ball", "bore": "25 mm", "outside_diameter": "52 mm",
    "width": "20.6 mm", "pitch_diameter": "38.5 mm", "ball_diameter": "7.938 mm", "ball_count": 9,
    "inner_groove_radius": "4.088 mm", "outer_groove_radius": "4.167 mm",
    "contact_angle": "30 deg", "row_distance": "9.54 mm",
}  # fmt: skip
CROWN = {
    "type": "crown", "material": "PA66", "bore": "34.93 mm", "outside_diameter": "42.07 mm",
    "width": "6.615 mm", "pocket_diameter": "8.18 mm", "throat": "7.3 mm",
    "claw_thickness": "1.03 mm",
}  # fmt: skip
B22208 = {
    "type": "spherical_roller", "bore": "40 mm", "outside_diameter": "80 mm", "width": "23 mm",
    "contact_angle": "10.55 deg", "pitch_diameter": "61.36 mm", "roller_diameter": "10.7 mm",
    "roller_length": "8.5 mm", "effective_length": "7.33 mm", "roller_count": 12,
    "barrel_radius": "35.82 mm", "inner_groove_radius": "36.55 mm", "radial_clearance": "20 um",
}  # fmt: skip
BARREL = {
    "type": "barrel", "cone_angle": "10.55 deg", "pitch_diameter": "61.36 mm",
    "row_distance": "11.43 mm", "offset": "2.72 mm", "thickness": "2.35 mm", "rim": "0.87 mm",
    "pocket_length": "8.71 mm", "pocket_width": "9.91 mm", "flank_angle": "26 deg",
    "fillet_radius": "0.53 mm",
}  # fmt: skip
SPECS = {"rollers": (NN3010, WINDOW), "balls": (B3205, CROWN), "barrels": (B22208, BARREL)}


def case_of(kind, *, model="flexible", duration="1 ms", push="300 mm/s", **more):
    bearing, cage = SPECS[kind]
    solver = {"duration": duration, **more.pop("solver", {})}
    return load_case({
        "name": kind, "bearing": bearing, "cage": {**cage, "model": model, **more.pop("cage", {})},
        "drive": {"speed": "3000 rpm"}, "load": more.pop("load", {"radial": "500 N"}),
        "mesh": {"fineness": "coarse"}, "start": {"push": push}, "solver": solver, **more,
    })  # fmt: skip


@cache
def ran(kind, method="auto", **more):
    return simulate(case_of(kind, solver={"method": method}, **more), stress=False)


@pytest.mark.parametrize("kind", SPECS)
def test_both_integrators_agree_on_a_common_cage_that_bends(kind):
    """Until and after it meets elements of both rows; impacts magnify what tolerances allow."""
    one, other = (ran(kind, method).dataset for method in ("explicit", "bdf"))
    for ds in (one, other):
        force = ds["pocket_force"].values
        half = force.shape[1] // 2
        assert force[:, :half].max() > 1.0 and force[:, half:].max() > 1.0
    moved = np.linalg.norm(one["cage_position"].values[-1] - one["cage_position"].values[0])
    apart = np.abs(one["cage_position"].values - other["cage_position"].values).max()
    assert apart < 0.01 * moved
    bent = np.abs(one["modal_coordinates"].values).max()
    assert bent > 0.0
    assert ran(kind, "bdf").summary["energy_audit"] == "passed"


def touched_state(case, rigid):
    """y of a rigid cage pushed aside and along, at rest."""
    start = assembled_start(case, rigid)
    y = np.zeros(rigid.layout.size)
    q, own = rigid.layout.q(y), rigid.layout.q(start.y)
    for body in own:
        q[body][...] = own[body]
    q["cage"][:] += (1.0e-4, 1.3e-4, 0.9e-4)
    return y


@pytest.mark.parametrize(
    ("kind", "soft"),
    [("rollers", "compliance"), ("balls", "local"), ("barrels", "compliance")],
)
def test_a_stiff_common_cage_feels_what_a_rigid_one_does(kind, soft):
    """Forces in the pockets of both rows, at the same places, of a cage that hardly yields; and the
    forces of all contacts add up to nothing."""
    case = case_of(kind, push="0 mm/s", load={"radial": "500 N", "gravity": "0 m/s^2"})
    stiff = case.replace({"cage.model": "rigid"})
    mesh = cage_mesh(case)
    reduction = cage_reduction(case, mesh)
    own = reduction.interface
    rigid = bearing_in_motion(stiff, mesh, None)
    forces = {"rigid": rigid}
    # the law of a rigid cage does not leave out the strip of wall that a mesh has
    law = {"patch_half_width": 0.0} if soft == "compliance" else {}
    for name, share in (("soft", 1.0), ("stiff", 1e-6)):
        yielding = {soft: share * getattr(own, soft)}
        reduction.__dict__["interface"] = replace(own, **yielding, **law)
        forces[name] = bearing_in_motion(case, mesh, reduction)
    at, sums = touched_state(stiff, rigid), {}
    for name, system in forces.items():
        y = np.zeros(system.layout.size)
        for body, place in rigid.layout.q(at).items():
            if place.size:  # a rigid cage has no modal coordinates
                system.layout.q(y)[body][...] = place
        rows = system.residual(0.0, y, np.zeros_like(y), mode=2).copy()
        sums[name] = resultant(system, y, rows)
        forces[name] = system.data.work.report.pocket_normal.copy()
    touched = forces["rigid"] > 0.0
    half = len(touched) // 2
    assert touched[:half].any() and touched[half:].any()
    np.testing.assert_allclose(forces["stiff"], forces["rigid"], rtol=1e-3)
    assert forces["soft"].sum() < 0.95 * forces["rigid"].sum()
    for found in sums.values():
        np.testing.assert_allclose(found, 0.0, atol=1e-9 * forces["rigid"].max())


def resultant(system, y, rows):
    """Sum (3,) of the forces of contacts on all bodies at rest, from rows of the residual."""
    q, r = system.layout.q(y), system.layout.u(rows)
    psi, on = q["elements"][:, 2], -r["elements"][:, :3]
    c, s = np.cos(psi), np.sin(psi)
    force = np.array([on[:, 0].sum(), (c * on[:, 1] - s * on[:, 2]).sum(),
                      (s * on[:, 1] + c * on[:, 2]).sum()])  # fmt: skip
    load = system.data.model.bodies
    inner = -r["inner"][:3] - load.load[1, 0] * np.append(0.0, load.load_direction)
    outer = system.layout.border(system.data.work.scratch.border)["outer"][:3]
    return force + inner + outer - r["cage"]


def test_a_defect_of_the_second_row_changes_its_own_pockets():
    defects = ({"type": "crossbeam", "crossbeam": 15, "displacement": "0.15 mm"},)
    sound, bent = case_of("rollers"), case_of("rollers", defects=list(defects))
    pockets = []
    for case in (sound, bent):
        mesh = cage_mesh(case)
        system = bearing_in_motion(case, mesh, cage_reduction(case, mesh))
        pockets.append(system.data.model.pocket.offset.copy())
    changed = np.unique(np.nonzero(pockets[1] - pockets[0])[0])
    assert changed.tolist() == [14, 15]


@pytest.mark.slow
def test_stress_of_a_common_cage_is_kept_and_read_again(tmp_path):
    case = case_of("rollers", duration="1 ms", defects=[
        {"type": "crossbeam", "crossbeam": 15, "displacement": "0.15 mm"},
    ])  # fmt: skip
    run = simulate(case, out=tmp_path / "run")
    peak = run.summary["stress_peak"]
    assert peak > 0.0
    again = flexcage.load_run(tmp_path / "run")
    assert again.summary["stress_peak"] == pytest.approx(peak, rel=1e-4)
