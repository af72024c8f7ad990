"""Two rows in motion with a cage each: balance, Newton's matrix, mirror images, and a row that is
the bearing that it would be alone."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from marching import march
from moving_rows import B3205, MM, NN3010, in_space, moving, reported
from scipy.spatial.transform import Rotation

from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.errors import InputError
from flexcage.spec import CrownCage, MeshOptions, OutputOptions, SolverOptions, WindowCage
from flexcage.system.data import POWERS
from flexcage.system.spec import CageSpeed

CROWN = CrownCage(
    rows="each", bore=34.93 * MM, outside_diameter=42.07 * MM, width=7.1 * MM,
    pocket_diameter=8.18 * MM, throat=7.3 * MM, claw_thickness=1.03 * MM, unbalance=2e-8,
    unbalance_phase=0.4, unbalance_offset=1 * MM,
)  # fmt: skip
WINDOW = WindowCage(
    rows="each", guidance="inner", bore=60.4 * MM, outside_diameter=67 * MM, width=8.9 * MM,
    pocket_width=7.2 * MM, pocket_length=7.25 * MM, fillet_radius=0.4 * MM,
)  # fmt: skip
KINDS = {"balls": (B3205, CROWN), "rollers": (NN3010, WINDOW)}
LOADED = {"radial": 1500.0, "axial": 300.0}
RADIAL = {"radial": 1500.0}
COARSE = {"mesh": MeshOptions(fineness="coarse")}


@cache
def at_start(kind, **changes):
    """Case, system and start of a bearing with a cage for each row, under load at speed."""
    bearing, cage = KINDS[kind]
    load = LOADED if kind == "balls" else RADIAL
    return moving(
        replace(bearing, **changes), cage=cage, speed=300.0, contacts=Contacts(), **load,
        lubricant=Lubricant(), sections=COARSE,
    )  # fmt: skip


def disturbed(kind, seed=3, shift=60e-6):
    """A state in which elements press walls of pockets of both rows, and cages lean and slide."""
    case, system, start = at_start(kind)
    y, rng = start.y.copy(), np.random.default_rng(seed)
    q, u = system.layout.q(y), system.layout.u(y)
    q["elements"][:, 2] += (
        (0.25 if kind == "balls" else 0.15)
        * MM
        / q["elements"][:, 1]
        * (rng.choice([-1.0, 1.0], system.layout.elements))
    )
    azimuth = rng.uniform(0.0, 2.0 * np.pi, 2)
    q["cage"][:, 1:] += shift * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=1)
    for quaternion in q["quaternion"]:
        own = Rotation.from_quat(quaternion, scalar_first=True)
        leant = own * Rotation.from_rotvec([1e-3, 2e-3, -1e-3] * rng.standard_normal(3))
        quaternion[:] = leant.as_quat(scalar_first=True)
    u["omega"][:] += [3.0, 1.0, 1.0] * rng.standard_normal((2, 3))
    u["cage"][:] += 0.05 * rng.standard_normal((2, 3))
    return case, system, y, start.yd.copy()


@pytest.mark.parametrize("kind", KINDS)
def test_elements_rings_and_both_cages_are_in_balance(kind):
    """Forces and moments of all contacts sum to nothing; each cage is pushed by its own row."""
    _, system, y, yd = disturbed(kind, shift=60e-6 if kind == "balls" else 205e-6)
    report = reported(system, y, yd)
    pushed = report.pocket_normal.sum(axis=1).reshape(2, -1)
    assert (pushed.max(axis=1) > 1.0).all()
    if kind == "rollers":
        assert (report.land_touch.reshape(2, -1)[:, 0:4].max(axis=1) > 1.0).all()
    force, moment, size = in_space(system, y)
    q, border = system.layout.q(y), system.layout.border(system.data.work.scratch.border)
    drag = system.data.model.bodies.drag[1] * np.abs(system.layout.u(y)["omega"]).max() ** 2
    for k in range(2):
        turn = Rotation.from_quat(q["quaternion"][k], scalar_first=True)
        force = force + border["cage"][k]
        moment = moment + turn.apply(border["omega"][k])
        moment = moment + np.cross(q["cage"][k], border["cage"][k])
    np.testing.assert_allclose(force, 0.0, atol=1e-10 * size)
    np.testing.assert_allclose(moment, 0.0, atol=1e-10 * size + 3.0 * drag)


def test_a_cage_is_pushed_by_its_own_row_alone():
    _, system, y, yd = disturbed("balls")
    other = system.layout.q(y)["cage"][1].copy()
    first = system.layout.u(system.residual(0.0, y, yd))["cage"][0].copy()
    system.layout.q(y)["cage"][1] = other + 50e-6
    moved = system.layout.u(system.residual(0.0, y, yd))["cage"]
    np.testing.assert_array_equal(moved[0], first)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("alpha", [3e5, 1e6])
def test_newtons_matrix_of_rows_in_cages_of_their_own(kind, alpha):
    """One Newton step back from a displacement of one allowed error everywhere."""
    _, system, y, yd = disturbed(kind)
    system.function("residual")(0.0, y, yd, system.args, np.zeros(len(y)), np.zeros(len(POWERS)))
    system.function("note")(0.0, y, system.args)
    weight, rng, layout = system.error_weights(1e-8), np.random.default_rng(1), system.layout
    d = np.zeros_like(y)
    tested = weight > 0.0
    d[tested] = rng.uniform(-1, 1, tested.sum()) / weight[tested]
    for quat, dq in zip(layout.q(y)["quaternion"], layout.q(d)["quaternion"], strict=True):
        dq -= quat * (quat @ dq) / (quat @ quat)  # a rotation, no change of the norm

    def along(e):
        return system.residual(0.0, y + e * d, yd + e * alpha * d)

    r = (along(1e-2) - along(-1e-2)) / 2e-2
    system.function("linearise")(0.0, y, yd, system.args)
    assert system.function("factor")(alpha, system.args)
    system.function("backsolve")(alpha, y, r, system.args)
    assert np.abs((r + d) * weight).max() < 0.2


def mirrored(ds, k):
    """What cage k does, of the second one in a mirror."""
    polar = np.array([1.0 - 2.0 * k, 1.0, 1.0])
    own = {name: ds[name].isel(cage=k).values for name in (
        "cage_position", "cage_velocity", "cage_quaternion", "cage_omega"
    )}  # fmt: skip
    axial = np.array([1.0, *(1.0 - 2.0 * k,) * 2])
    own["cage_position"] = own["cage_position"] * polar
    own["cage_velocity"] = own["cage_velocity"] * polar
    own["cage_quaternion"] = own["cage_quaternion"] * np.array([1.0, *axial])
    own["cage_omega"] = own["cage_omega"] * axial
    return own


@pytest.mark.parametrize("kind", KINDS)
def test_under_a_radial_load_both_cages_move_as_mirror_images(kind):
    """Of rows without stagger, with an unbalance of both; the cages begin aside."""
    bearing, cage = KINDS[kind]
    case, system, start = moving(
        replace(bearing, staggered=False), cage=cage, speed=300.0, contacts=Contacts(), **RADIAL,
        lubricant=Lubricant(),
        sections={**COARSE, "solver": SolverOptions(duration=0.5e-3, method="explicit")},
    )  # fmt: skip
    y, yd = start.y.copy(), start.yd.copy()
    system.layout.q(y)["cage"][:, 1] += 30e-6
    system.layout.u(y)["cage"][:, 2] = system.layout.q(yd)["cage"][:, 2] = 0.3
    ds = march(case, system, y, yd)
    assert float(ds["pocket_force"].max()) > 0.1
    first, second = mirrored(ds, 0), mirrored(ds, 1)
    for name, values in first.items():
        size = np.abs(values).max(axis=0) + 1e-9
        assert np.abs((second[name] - values) / size).max() < 1e-4, name
    moved = np.ptp(ds["cage_position"].sel(axis="z").values, axis=0)
    assert (moved > 50e-6).all()


@pytest.mark.parametrize("kind", KINDS)
def test_rows_that_do_not_feel_each_other_are_single_bearings(kind):
    """The inner ring's centre stands; the first row and its cage move as those of the bearing of
    one row alone, from the same state."""
    bearing, cage = KINDS[kind]
    if kind == "balls":
        bearing = replace(bearing, axial_clearance=0.0)
    load = {**(LOADED if kind == "balls" else RADIAL), "centre": "held"}
    solver = SolverOptions(duration=0.5e-3, method="explicit", tolerance=1e-9)
    common = {
        "speed": 300.0, "contacts": Contacts(), "lubricant": Lubricant(),
        "sections": {**COARSE, "solver": solver, "output": OutputOptions(rate=20e3)},
    }  # fmt: skip
    case, both, start = moving(bearing, cage=cage, **common, **load)
    alone_case, alone, begun = moving(
        bearing.row, cage=replace(cage, rows="common"), **common, **load
    )
    n, place = bearing.element_count, bearing.row_places[0].place
    own, whole = alone.layout, both.layout
    y, yd, first, rates = start.y.copy(), start.yd.copy(), begun.y.copy(), begun.yd.copy()
    whole.u(y)["cage"][0, 1:] = whole.q(yd)["cage"][0, 1:] = 0.2, -0.1
    for given, taken in (
        (whole.q(y), own.q(first)), (whole.u(y), own.u(first)),
        (whole.q(yd), own.q(rates)), (whole.u(yd), own.u(rates)),
    ):  # fmt: skip
        taken["elements"][:] = given["elements"][:n]
        for name in ("inner", "outer"):
            taken[name][:] = given[name]
        for name in ("cage", "quaternion", "omega"):
            if name in given:
                taken[name][:] = given[name][0]
    own.q(first)["elements"][:, 0] -= place
    own.q(first)["cage"][0] -= place
    found, due = march(case, both, y, yd), march(alone_case, alone, first, rates)
    aside = np.array([place, 0.0, 0.0])
    np.testing.assert_allclose(
        found["cage_position"].values[:, 0] - aside, due["cage_position"].values, atol=2e-8
    )
    np.testing.assert_allclose(
        found["element_position"].values[:, :n] - aside, due["element_position"].values, atol=1e-6
    )
    assert float(due["pocket_force"].max()) > 0.1
    np.testing.assert_allclose(
        found["cage_omega"].values[:, 0],
        due["cage_omega"].values,
        atol=2e-3 * float(np.abs(due["cage_omega"]).max()),
    )


def test_a_constraint_on_the_cage_is_refused():
    bearing, cage = KINDS["balls"]
    with pytest.raises(InputError, match="each row has one"):
        moving(
            bearing,
            cage=cage,
            speed=300.0,
            radial=500.0,
            sections={"constraints": (CageSpeed(ratio=0.4),)},
        )


def test_it_has_as_many_unknowns_as_two_rows_two_rings_and_two_cages():
    _, system, _ = at_start("balls")
    layout = system.layout
    assert layout.cages == 2 and layout.size == 18 * 12 + 2 * 12 + 2 * 13 + 7
    assert layout.q(np.zeros(layout.size))["quaternion"].shape == (2, 4)
